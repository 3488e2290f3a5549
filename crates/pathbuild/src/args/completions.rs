//! Completes arguments in a shell: names of paths, posts, dialects and codes.

use std::ffi::OsStr;

use clap_complete::engine::ValueCompleter;
use clap_complete::{ArgValueCandidates, ArgValueCompleter, CompletionCandidate, PathCompleter};
use pathbuild_diagnostic::{Code, escaping};
use pathbuild_gcode::dialect::Dialect;
use pathbuild_post::BUILT_IN;
use pathbuild_workspace::Inputs;
use pathbuild_workspace::config::Overrides;
use pathbuild_workspace::session::Session;

use crate::environment;

/// Name of the environment variable by which a shell requests completions.
pub(crate) const VARIABLE: &str = "PATHBUILD_COMPLETE";

/// Completes names of paths, and file names of drawings and directories.
pub(crate) fn paths() -> ArgValueCompleter {
    ArgValueCompleter::new(|current: &OsStr| {
        #[expect(clippy::disallowed_methods, reason = "completions are no input of a run")]
        let files = PathCompleter::any().filter(|path| {
            path.is_dir() || path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("dxf"))
        });
        let mut candidates = path_names(current);
        candidates.extend(keep_harmless(files.complete(current)));
        candidates
    })
}

/// Completes names of built-in posts, and file names.
pub(crate) fn posts() -> ArgValueCompleter {
    ArgValueCompleter::new(|current: &OsStr| {
        let begins = |name: &str| name.starts_with(&*current.to_string_lossy());
        let built_in = BUILT_IN.iter().filter(|post| begins(post.name));
        let built_in =
            built_in.map(|post| CompletionCandidate::new(post.name).help(Some(post.description.into())));
        built_in.chain(keep_harmless(PathCompleter::file().complete(current))).collect()
    })
}

pub(crate) fn dialects() -> ArgValueCandidates {
    ArgValueCandidates::new(|| {
        Dialect::ALL.iter().map(|dialect| CompletionCandidate::new(dialect.name())).collect()
    })
}

pub(crate) fn codes() -> ArgValueCandidates {
    let candidate = |code: &Code| CompletionCandidate::new(code.to_string()).help(Some(code.name().into()));
    ArgValueCandidates::new(move || Code::ALL.iter().map(candidate).collect())
}

/// Returns the candidates that can be inserted into a command line as they are, because they contain nothing that controls a terminal or
/// is special to a shell. For other names, the shell's own file completion adds the quotes.
fn keep_harmless(candidates: Vec<CompletionCandidate>) -> impl Iterator<Item = CompletionCandidate> {
    candidates.into_iter().filter(|candidate| candidate.get_value().to_str().is_some_and(is_harmless))
}

fn is_harmless(name: &str) -> bool {
    let is_special = |c: char| c.is_whitespace() || c.is_ascii_punctuation() && !"+,-./:@_".contains(c);
    !name.chars().any(|c| escaping::is_active(c) || is_special(c) && !(cfg!(windows) && c == '\\'))
}

/// Returns the paths of the working directory's library whose names begin with the current word.
fn path_names(current: &OsStr) -> Vec<CompletionCandidate> {
    let (user, mut faults) = environment::load_user_settings();
    let overrides = Overrides { trusted: user.trusted.clone(), ..Overrides::default() };
    let (workspace, more) = environment::workspace(&overrides, &user, &Inputs::default());
    faults.extend(more);
    if !faults.is_empty() {
        return Vec::new();
    }
    let begin = current.to_string_lossy().to_lowercase();
    let names = Session::new(&workspace).names_of_library().into_iter();
    let matching = names.filter(|name| name.as_str().to_lowercase().starts_with(&begin));
    matching
        .filter(|name| is_harmless(name.as_str()))
        .map(|name| CompletionCandidate::new(name.as_str()))
        .collect()
}
