//! `pathbuild check`: every path of drawings, paths or the library. Writes nothing. (spec/05-command-line.md)

use std::time::Instant;

use pathbuild_db::{Role, SourceFile, Target, check_file, path_names};

use crate::args::CheckArgs;
use crate::context::Context;
use crate::exit::ExitStatus;
use crate::report::{Checked, CheckedFile, CheckedPath, conclude};
use crate::session::{Session, Wanted};

/// Runs the command.
pub fn run(context: &Context, args: &CheckArgs) -> ExitStatus {
    let begun = Instant::now();
    let session = Session::new(context);
    if args.inputs.inputs.is_empty() && !session.has_library() {
        return context.nothing_named("check");
    }
    let mut checked = check(&session, session.wanted(&args.inputs));
    checked.time = begun.elapsed();
    conclude(context, args, checked)
}

fn check(session: &Session<'_>, wanted: Wanted) -> Checked {
    let db = session.db();
    let whole: Vec<SourceFile> = wanted.drawings.iter().map(|drawing| drawing.file).collect();
    session.read_ahead(&whole);
    let mut targets: Vec<Target> =
        whole.iter().flat_map(|file| session.targets(*file, &Role::Checked)).collect();
    targets.extend(wanted.paths.iter().map(|path| session.target(path, Role::Checked)));
    let mut checked = Checked { diagnostics: wanted.problems, ..Checked::default() };
    let mut files = whole;
    for result in session.check(&targets) {
        files.extend(result.files);
        checked.diagnostics.extend(result.diagnostics);
    }
    files.sort_by(|a, b| a.path(db).cmp(b.path(db)));
    files.dedup();
    for file in files {
        checked.diagnostics.extend_from_slice(check_file(db, file));
        let asked = targets.iter().filter(|target| target.file(db) == file);
        let paths: Vec<CheckedPath> =
            asked.map(|target| CheckedPath { name: target.name(db).clone(), time: None }).collect();
        if !paths.is_empty() || path_names(db, file).is_empty() {
            checked.files.push(CheckedFile { file: file.path(db).clone(), paths });
        }
    }
    checked
}
