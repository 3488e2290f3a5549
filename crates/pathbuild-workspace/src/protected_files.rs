//! Files that reports and other outputs must not replace (PB004): what a user has drawn, written or measured, and programs.

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::messages::files as messages;
use pathbuild_diagnostic::reasons::{
    IS_BASELINE, NAME_OF_CONFIGURATION, NAME_OF_DEFINITION, NAME_OF_DRAWING, NAME_OF_IGNORE_FILE,
    NAME_OF_PROGRAM, NAME_OF_VALUES, PROGRAM_THAT_IS_READ, SOURCE_OF_POST,
};
use pathbuild_diagnostic::{Diagnostic, Text};

use crate::files::{FILE_NAME, is_program, replace};
use crate::post_processor::{PostArguments, PostProcessor};
use crate::session::{OutputKind, is_ignore_file};
use crate::workspace::Workspace;

/// Atomically replaces a report, unless the file is a source or a program.
///
/// # Errors
/// A diagnostic with the reason why the file cannot be written.
pub fn replace_report(context: &Workspace, file: &Utf8Path, text: &str) -> Result<(), Box<Diagnostic>> {
    match reason_to_keep(context, None, file) {
        Some(reason) => Err(Box::new(replace_error(file, reason))),
        None => replace(context, file, text),
    }
}

/// Returns the reason why an output must not replace a file: it is a source, or has the name of a program, with a common extension or as `post` or
/// the configured post-processor names programs. `None` for other files.
pub(crate) fn reason_to_keep(
    context: &Workspace,
    post: Option<&PostProcessor>,
    file: &Utf8Path,
) -> Option<&'static Text> {
    let configured = configured_post(context);
    let mut posts = post.into_iter().chain(&configured);
    let mut is_named = || is_program(file) || posts.any(|post| post.has_name_of_program(file));
    reason_to_keep_source(context, post, file).or_else(|| is_named().then_some(&NAME_OF_PROGRAM))
}

/// Returns the reason why an output must not replace a file: it is a drawing, a configuration, a post's definition, an ignore file, measured values
/// or the baseline, or belongs to `post` or to the configured post. `None` if it is none of these. For most of them the name decides, whether or not
/// the file exists; a link counts as the file to which it leads.
pub(crate) fn reason_to_keep_source(
    context: &Workspace,
    post: Option<&PostProcessor>,
    file: &Utf8Path,
) -> Option<&'static Text> {
    let target = canonical(context, file);
    let named = [file, &target].into_iter().find_map(name_of_source);
    if named.is_some() {
        return named;
    }
    let is_target = |file: &Utf8Path| canonical(context, file) == target;
    if context.settings.file.as_deref().is_some_and(is_target) {
        return Some(&NAME_OF_CONFIGURATION);
    }
    if is_target(&context.baseline_file(None)) {
        return Some(&IS_BASELINE);
    }
    let configured = configured_post(context);
    let mut sources = post.into_iter().chain(&configured).flat_map(PostProcessor::sources);
    sources.any(|source| is_target(&source)).then_some(&SOURCE_OF_POST)
}

/// Returns the reason why an output must not replace a file: it is `input`, the program that the command `post` reads. A link counts as the file to
/// which it leads. `None` for other files.
pub(crate) fn reason_to_keep_input(
    context: &Workspace,
    input: &Utf8Path,
    file: &Utf8Path,
) -> Option<&'static Text> {
    (canonical(context, file) == canonical(context, input)).then_some(&PROGRAM_THAT_IS_READ)
}

/// Returns the path of a file without links.
fn canonical(context: &Workspace, file: &Utf8Path) -> Utf8PathBuf {
    context.system.canonical(&context.working_directory.join(file))
}

/// Returns the configured post; `None` if there is none, or if it is broken, which `emit` reports.
fn configured_post(context: &Workspace) -> Option<PostProcessor> {
    PostProcessor::for_run(context, None, PostArguments::default()).ok().flatten()
}

/// Returns the reason why an output must not replace a file with this name: it is the name of a source. `None` for other names.
fn name_of_source(file: &Utf8Path) -> Option<&'static Text> {
    let is = |extension: &str| file.extension().is_some_and(|own| own.eq_ignore_ascii_case(extension));
    let name = file.file_name().unwrap_or_default().to_ascii_lowercase();
    if is("dxf") || is("dwg") {
        return Some(&NAME_OF_DRAWING);
    }
    if name == FILE_NAME {
        return Some(&NAME_OF_CONFIGURATION);
    }
    if is("cbpp") || is("toml") {
        return Some(&NAME_OF_DEFINITION);
    }
    if is_ignore_file(&name) {
        return Some(&NAME_OF_IGNORE_FILE);
    }
    name.ends_with(&OutputKind::Values.suffix().to_ascii_lowercase()).then_some(&NAME_OF_VALUES)
}

/// Returns PB004 for an output that would replace a file that must be kept.
pub fn replace_error(file: &Utf8Path, reason: &'static Text) -> Diagnostic {
    let name = file.file_name().unwrap_or_default();
    Diagnostic::new(&messages::WOULD_REPLACE).quoting("name", name).with("reason", reason).in_file(file)
}
