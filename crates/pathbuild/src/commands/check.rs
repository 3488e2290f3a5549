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
    let mut checked = check(&session, session.wanted(&args.inputs), args.all_bindings);
    checked.time = begun.elapsed();
    conclude(context, args, checked)
}

fn check(session: &Session<'_>, wanted: Wanted, with_all_values: bool) -> Checked {
    let db = session.db();
    let whole: Vec<SourceFile> = wanted.drawings.iter().map(|drawing| drawing.file).collect();
    session.read_ahead(&whole);
    let mut checked = Checked { diagnostics: wanted.problems, ..Checked::default() };
    let named = wanted.paths.into_iter().filter(|path| !whole.contains(&path.file));
    let of_whole = |file: &SourceFile| path_names(db, *file).iter().map(|name| (*file, name.clone()));
    let paths: Vec<(SourceFile, PathName)> =
        whole.iter().flat_map(of_whole).chain(named.map(|path| (path.file, path.name))).collect();
    let mut files = whole.clone();
    if with_all_values {
        let (targets, warnings): (Vec<_>, Vec<_>) =
            paths.iter().map(|(file, name)| session.combined_targets(*file, name)).unzip();
        checked.diagnostics.extend(warnings.into_iter().flatten());
        let mut results = session.check(&targets.concat()).into_iter();
        for targets in targets {
            let results: Vec<CheckedTarget> = results.by_ref().take(targets.len()).collect();
            checked.diagnostics.extend(session.merged(&results));
            files.extend(results.into_iter().flat_map(|result| result.files));
        }
    } else {
        let targets: Vec<Target> = paths
            .iter()
            .map(|(file, name)| Target::new(db, *file, name.as_str().into(), Role::Checked))
            .collect();
        for result in session.check(&targets) {
            files.extend(result.files);
            checked.diagnostics.extend(result.diagnostics);
        }
    }
    files.sort_by(|a, b| a.path(db).cmp(b.path(db)));
    files.dedup();
    for file in files {
        checked.diagnostics.extend_from_slice(check_file(db, file));
        let asked = paths.iter().filter(|(asked, _)| *asked == file);
        let paths: Vec<CheckedPath> =
            asked.map(|(_, name)| CheckedPath { name: name.as_str().into(), time: None }).collect();
        if !paths.is_empty() || path_names(db, file).is_empty() {
            checked.files.push(CheckedFile { file: file.path(db).clone(), paths });
        }
    }
    checked
}
