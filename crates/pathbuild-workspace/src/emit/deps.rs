//! Dependency files for `make` and `ninja`. (book: reference/commands, `emit --deps`)

use std::collections::BTreeSet;
use std::fmt::Write;
use std::iter::repeat_n;

use camino::Utf8Path;
use pathbuild_db::Db;
use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::files as messages;

use super::outcome::write_error;
use super::plan::Job;
use crate::post_processor::PostProcessor;
use crate::protected_files::{reason_to_keep, replace_error};
use crate::session::Session;

/// Writes one rule per job: its output files depend on its drawings, the configuration, the post definition and the files that the post-processor
/// inserted. If a name cannot be expressed, writes nothing and returns an error.
///
/// An empty rule for each input follows, as `gcc -MP` writes it: without one, `make` refuses to run the rule of a program once a drawing is renamed.
pub(super) fn write<'p>(
    session: &Session<'_>,
    file: &Utf8Path,
    jobs: impl Iterator<Item = &'p Job>,
    post_processor: Option<&PostProcessor>,
) -> Option<Diagnostic> {
    let db = session.db();
    let configuration = session.workspace().settings.file.as_ref().map(|file| session.normalize(file));
    let (mut text, mut inputs) = (String::new(), BTreeSet::new());
    let post = post_processor.and_then(PostProcessor::file).map(|file| session.normalize(file));
    let file = session.normalize(file);
    if let Some(reason) = reason_to_keep(session.workspace(), post_processor, &file) {
        return Some(replace_error(&file, reason));
    }
    for job in jobs {
        let outputs: Vec<&Utf8Path> = job.files.iter().map(|(_, path)| path.as_path()).collect();
        let inserted = job.outcome.iter().flat_map(|outcome| &outcome.inserted);
        let sources = job.sources.iter().map(|source| source.path(db).as_path());
        let sources = sources.chain(configuration.as_deref()).chain(post.as_deref());
        let sources: Vec<&Utf8Path> = sources.chain(inserted.map(|file| file.path.as_path())).collect();
        if let Some(name) = outputs.iter().chain(&sources).find(|name| is_unescapable(name.as_str())) {
            let problem = Diagnostic::new(&messages::UNNAMEABLE).quoting("name", name.as_str());
            return Some(problem.in_file(&file));
        }
        let all = |names: &[&Utf8Path]| names.iter().map(|name| escaped(name)).collect::<Vec<_>>().join(" ");
        _ = writeln!(text, "{}: {}", all(&outputs), all(&sources));
        inputs.extend(sources.iter().map(|source| escaped(source)));
    }
    text.extend(inputs.iter().flat_map(|input| [input, ":\n"]));
    let written = db.system().write(&file, text.as_bytes());
    written.err().map(|reason| write_error(file.as_str(), reason))
}

/// Whether the name cannot be written in a makefile, because no escaping keeps `make` from interpreting it: assignments (even `!=`), patterns and
/// wildcards, order-only prerequisites, home directories, archive members, and line continuations.
fn is_unescapable(name: &str) -> bool {
    name.contains(['=', '%', '|', '*', '?', '[']) || name.starts_with('~') || name.ends_with([')', '\\'])
}

/// Escapes a name for `make`, and for Ninja as far as it can express the name. Line feeds and other control characters cannot be expressed; their
/// escaped form names a file that does not exist.
fn escaped(path: &Utf8Path) -> String {
    let mut escaped = String::with_capacity(path.as_str().len());
    let mut backslashes = 0;
    for character in path.as_str().chars() {
        // Double the preceding backslashes, which would otherwise escape each other, and add one for the character itself.
        let further = match character {
            // On Windows a colon occurs only after a drive letter, which `make` recognizes.
            ':' if cfg!(windows) => 0,
            ' ' | '#' | ':' => backslashes + 1,
            // An unescaped semicolon starts a command. `make` unescapes it twice.
            ';' => 3 * (backslashes + 1),
            _ => 0,
        };
        escaped.extend(repeat_n('\\', further));
        match character {
            '$' => escaped.push_str("$$"),
            control if control.is_ascii_control() => escaped.extend(control.escape_default()),
            character => escaped.push(character),
        }
        backslashes = if character == '\\' { backslashes + 1 } else { 0 };
    }
    escaped
}
