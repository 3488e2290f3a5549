//! Checks whether differing programs would match with `--compatible`. (book: program/compatible)

use camino::Utf8PathBuf;
use pathbuild_diagnostic::Note;
use pathbuild_diagnostic::messages::outputs;

use super::{ProgramOutcome, Request, State, Task};
use crate::session::Session;
use crate::workspace::Workspace;

/// Adds a note to each difference that `--compatible` would remove. If there are any differences, the programs are generated a second time
/// for this.
pub(super) fn name(workspace: &Workspace, request: &Request<'_>, delivered: &mut [ProgramOutcome]) {
    let is_asked = request.task == Task::Compare { moves_only: true };
    let differs = delivered.iter().any(|outcome| !outcome.problems.is_empty());
    if !is_asked || !differs || workspace.settings.general.compatible.value {
        return;
    }
    let same = current_if_compatible(workspace, request);
    for problem in delivered.iter_mut().flat_map(|delivered| &mut delivered.problems) {
        if problem.file.as_ref().is_some_and(|file| same.contains(file)) {
            problem.notes.push(Note { message: &outputs::SAME_IF_COMPATIBLE, arguments: Vec::new() });
        }
    }
}

/// The files that are up to date with `--compatible`.
fn current_if_compatible(workspace: &Workspace, request: &Request<'_>) -> Vec<Utf8PathBuf> {
    let workspace = workspace.in_mode(true);
    let request = Request { deps: None, removes_stale: false, ..*request };
    let emission = request.run(&mut Session::new(&workspace));
    let delivered = emission.map(|emission| emission.delivered).unwrap_or_default();
    let files = delivered.into_iter().flat_map(|delivered| delivered.files);
    files.filter(|(_, state)| matches!(state, State::Current)).map(|(file, _)| file).collect()
}
