//! Tests bugs that are triggered by reading a drawing or listing a directory, and directories that cannot be listed: each is reported for the file
//! or directory, and does not affect anything else.

use std::fs;
use std::sync::Arc;
use std::sync::atomic::{AtomicI64, Ordering};

use camino::Utf8Path;
use pathbuild_db::system::OsSystem;
use pathbuild_db::{Role, System};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_testkit::RandomLibrary;
use pathbuild_workspace::emit::Task;
use pathbuild_workspace::session::Session;
use pathbuild_workspace::{Inputs, Workspace, check, emit, list};

use crate::mischief::{Event, Mischief};
use crate::on_disk::{OnDisk, sorted};

/// Returns a file system in which reading or listing the victim triggers a bug the n-th time.
fn bug(place: &OnDisk, victim: &str, time: i64, lasts: bool) -> Arc<Mischief> {
    trouble(Event::Panic, place, victim, time, lasts)
}

/// Like [`bug`], for any event.
fn trouble(event: Event, place: &OnDisk, victim: &str, time: i64, lasts: bool) -> Arc<Mischief> {
    Arc::new(Mischief {
        trigger: victim.to_owned(),
        countdown: AtomicI64::new(time),
        lasts,
        is_before: event == Event::Panic,
        event,
        victim: place.path().join(victim),
        bytes: Vec::new(),
    })
}

/// A bug triggered by one drawing is reported for that drawing. All others are checked, and the bug is not cached.
#[test]
fn a_bug_in_one_drawing_keeps_no_other_from_being_checked() {
    let workshop = RandomLibrary::new(3);
    for victim in workshop.files().keys().filter(|path| Utf8Path::new(path).extension() == Some("dxf")) {
        for jobs in [None, Some(1)] {
            // Nothing is cached yet, so every drawing is read.
            let place = OnDisk::new(&workshop);
            let expected = place.check(Arc::new(OsSystem), false, None);
            let found = place.check(bug(&place, victim, 1, false), true, jobs);
            let is_of_victim = |found: &&String| found.contains(victim.as_str());
            let said = found.iter().filter(|found| found.contains("a bug that")).collect::<Vec<_>>();
            assert!(!said.is_empty() && said.iter().all(is_of_victim), "{victim}: {found:#?}");
            let files = |found: &[String]| found.iter().filter(|it| it.starts_with('"')).count();
            assert_eq!(files(&found), files(&expected), "{victim}: all drawings are checked");
            assert_eq!(place.check(Arc::new(OsSystem), true, jobs), expected, "{victim}");
        }
    }
}

/// A bug triggered by listing a directory is reported for that directory. All other directories are checked, and the bug is not cached.
#[test]
fn a_bug_in_listing_a_directory_keeps_no_other_from_being_checked() {
    let workshop = RandomLibrary::new(3);
    for victim in ["lib/parts", "lib/projects"] {
        for jobs in [None, Some(1)] {
            let place = OnDisk::new(&workshop);
            let expected = place.check(Arc::new(OsSystem), false, None);
            let found = place.check(bug(&place, victim, 1, false), true, jobs);
            let said: Vec<_> = found.iter().filter(|found| found.contains("a bug that")).collect();
            assert!(said.iter().any(|found| found.contains("InternalError")), "{victim}: {found:#?}");
            assert!(said.iter().all(|found| found.contains(victim)), "{victim}: {found:#?}");
            let others = if victim == "lib/parts" { "lib/projects/" } else { "lib/parts/" };
            assert!(found.iter().any(|found| found.contains(others)), "{victim}: {found:#?}");
            assert_eq!(
                place.check(Arc::new(OsSystem), true, jobs),
                expected,
                "{victim}: nothing of it is kept"
            );
        }
    }
}

fn paths(place: &OnDisk) -> Vec<(String, String)> {
    let inputs = Inputs::default();
    let workspace = place.workspace(&inputs, Arc::new(OsSystem), false);
    let mut session = Session::new(&workspace);
    let listed = list::Request { inputs: &inputs, post: None }.run(&mut session).unwrap();
    listed.paths.into_iter().map(|path| (path.name.as_str().to_owned(), path.drawing.into_string())).collect()
}

/// A command, and a function that returns its findings.
type Finding = (&'static str, fn(&Workspace, &Inputs) -> Vec<Diagnostic>);

/// Commands that list directories for different reasons.
const COMMANDS: [Finding; 5] = [
    ("check", |workspace, inputs| {
        let request = check::Request { inputs, with_all_values: false, changed: None };
        request.run(&mut Session::open(workspace, workspace.caches_results())).unwrap().diagnostics
    }),
    ("emit", |workspace, inputs| emitted(workspace, inputs, Task::Print)),
    ("emit --check", |workspace, inputs| emitted(workspace, inputs, Task::Compare { moves_only: false })),
    ("list", |workspace, inputs| {
        let listed = list::Request { inputs, post: None }.run(&mut Session::new(workspace)).unwrap();
        let of_paths = listed.paths.into_iter().flat_map(|path| path.diagnostics);
        of_paths.chain(listed.diagnostics).collect()
    }),
    ("graph", |workspace, inputs| {
        let session = Session::new(workspace);
        let wanted = session.select(inputs);
        let files = wanted.whole_drawings(&session);
        let mut targets: Vec<_> =
            files.iter().flat_map(|file| session.targets(*file, &Role::Checked)).collect();
        targets.extend(
            wanted.paths.iter().map(|path| session.db().target(path.file, path.name.as_str(), Role::Checked)),
        );
        let graph = session.graph(&targets);
        session.with_hints(wanted.problems.into_iter().chain(graph.problems).collect())
    }),
];

fn emitted(workspace: &Workspace, inputs: &Inputs, task: Task) -> Vec<Diagnostic> {
    let request = emit::Request { task, ..emit::Request::default() };
    request
        .run(&mut Session::open(workspace, workspace.caches_results()), inputs)
        .map(|made| made.diagnostics)
        .unwrap_or_default()
}

/// No command is aborted by a bug in listing a directory, whether it occurs the first, second, ... time or always. The bug is reported, or
/// the findings are the same as without it, except for hints.
#[test]
fn a_bug_in_listing_ends_no_command() {
    in_each_listing(Event::Panic, "InternalError");
}

/// The unreadable directory is reported: otherwise a path in it would not be found, or another path of that name would seem to be the only one.
#[test]
fn a_directory_that_cannot_be_listed_is_told() {
    in_each_listing(Event::Fail, "UnreadableFile");
}

fn in_each_listing(event: Event, code: &str) {
    let workshop = RandomLibrary::new(3);
    let place = OnDisk::new(&workshop);
    let paths = paths(&place);
    let (name, drawing) = paths.iter().find(|(_, drawing)| drawing.contains("lib/projects/")).unwrap();
    let directory = place.path().join("lib/parts").into_string();
    let all: [&[&str]; 5] = [&[], &[name], &[drawing], &[&directory], &[name, &directory, "no such path"]];
    let jobs = [None, Some(1)];
    let mut troubles = 0;
    for (command, run) in COMMANDS {
        for arguments in all {
            let inputs = Inputs { inputs: arguments.iter().map(|it| (*it).to_owned()).collect() };
            let find = |system, is_kept, jobs| {
                let workspace = Workspace { jobs, ..place.workspace(&inputs, system, is_kept) };
                let found = run(&workspace, &inputs).into_iter();
                let without_hints = found.map(|it| Diagnostic { notes: Vec::new(), ..it });
                sorted(without_hints.map(|it| format!("{it:?}")).collect())
            };
            let expected = find(Arc::new(OsSystem), false, None);
            for victim in ["lib", "lib/parts", "lib/projects", "spare"] {
                for (time, lasts) in [(1, false), (2, false), (3, false), (4, false), (1, true), (2, true)] {
                    let trouble = trouble(event, &place, victim, time, lasts);
                    let found = find(trouble.clone(), false, jobs[troubles % 2]);
                    if trouble.countdown.load(Ordering::SeqCst) > 0 {
                        continue;
                    }
                    troubles += 1;
                    let said = format!("{command} {arguments:?}: {victim}, time {time}, {lasts}: {found:#?}");
                    let is_said = found.iter().any(|it| it.contains(code) && it.contains(victim));
                    assert!(is_said || found == expected, "{said}");
                }
            }
        }
    }
    assert!(troubles > 200, "only {troubles} showed");
}

/// The drawings in a directory that cannot be listed are unknown, so programs that may belong to one of them are not removed.
#[test]
fn a_bug_in_listing_removes_no_program() {
    let workshop = RandomLibrary::new(3);
    let place = OnDisk::new(&workshop);
    let file = place.path().join("pathbuild.toml");
    let text = fs::read_to_string(&file).unwrap();
    fs::write(&file, format!("out-dir = \"out\"\n{text}\n[emit]\ntargets = [\"1*\"]\n")).unwrap();
    let programs = || {
        let listing = OsSystem.list(&place.path().join("out")).unwrap().files;
        sorted(listing.iter().map(str::to_owned).collect())
    };
    place.emit(Arc::new(OsSystem), false, true);
    let before = programs();
    assert!(before.len() > 1, "{before:?}");
    for time in 1..8 {
        let made = place.emit(bug(&place, "lib/parts", time, true), false, true);
        assert!(made.removed.is_empty() && programs() == before, "time {time}: {:?}", made.removed);
    }
}
