//! Whether programs that move otherwise do so because they are as `PathDxf2GCode` writes them. (book: program/compatible)

use camino::Utf8PathBuf;
use pathbuild_diagnostic::Note;
use pathbuild_diagnostic::messages::outputs;

use super::{Delivered, Request, State, Task};
use crate::session::Session;
use crate::workspace::Workspace;

/// Names `--compatible` under the differences of each program that moves as the paths do with it. They are made once more for that, if any
/// moves otherwise at all.
pub(super) fn name(workspace: &Workspace, request: &Request<'_>, delivered: &mut [Delivered]) {
    let is_asked = request.task == Task::Compare { moves_only: true };
    let differs = delivered.iter().any(|it| !it.problems.is_empty());
    if !is_asked || !differs || workspace.settings.general.compatible.value {
        return;
    }
    let same = current_if_compatible(workspace, request);
    for problem in delivered.iter_mut().flat_map(|it| &mut it.problems) {
        if problem.file.as_ref().is_some_and(|file| same.contains(file)) {
            problem.notes.push(Note { message: &outputs::SAME_IF_COMPATIBLE, arguments: Vec::new() });
        }
    }
}

/// The files that are current with `--compatible`.
fn current_if_compatible(workspace: &Workspace, request: &Request<'_>) -> Vec<Utf8PathBuf> {
    let workspace = workspace.in_mode(true);
    let request = Request { deps: None, removes_stale: false, ..*request };
    let emission = request.run(&mut Session::new(&workspace));
    let delivered = emission.map(|emission| emission.delivered).unwrap_or_default();
    let files = delivered.into_iter().flat_map(|it| it.files);
    files.filter(|(_, state)| matches!(state, State::Current)).map(|(file, _)| file).collect()
}
