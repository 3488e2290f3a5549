//! Tests with drawings that are removed between two steps of a session. They do not depend on events of the watcher and their timing.

use std::sync::Arc;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::System;
use pathbuild_db::system::MemorySystem;
use pathbuild_diagnostic::{Code, Diagnostic};
use pathbuild_testkit::sheet;

use super::events::{Changes, Update};
use super::library::Library;
use crate::config::{self, Overrides};
use crate::session::Session;
use crate::{Inputs, SilentReporter, Workspace};

const DRAWING: &str = "layer 1001.1P\nstart 0,0 \"T5 O2 I1 B0 MX\"\nmill 0,0 40,0\nend 40,0";

/// A library in memory, with its workspace.
struct Place {
    system: Arc<MemorySystem>,
    inputs: Inputs,
    workspace: Workspace,
}

impl Place {
    fn new() -> Self {
        let system = Arc::new(MemorySystem::default());
        system.put("pathbuild.toml", "library = [\"lib\"]\nfeed = 100\n");
        let inputs = Inputs::default();
        let shared: Arc<dyn System> = Arc::<MemorySystem>::clone(&system);
        let given = Overrides { config: Some("pathbuild.toml".into()), ..Overrides::default() };
        let (settings, faults) = config::load(&shared, &given, &inputs, Utf8Path::new(""));
        assert!(faults.is_empty(), "{faults:?}");
        let workspace = Workspace {
            settings,
            system: shared,
            own_lang: None,
            system_lang: None,
            working_directory: Utf8PathBuf::new(),
            jobs: Some(1),
            cache: None,
            reporter: Arc::new(SilentReporter),
            is_date_decisive: Arc::default(),
        };
        let place = Self { system, inputs, workspace };
        place.draw("lib/1001.1P.dxf");
        place
    }

    fn draw(&self, file: &str) {
        let name = file.rsplit('/').next().unwrap().trim_end_matches(".dxf");
        self.system.put(file, sheet(&DRAWING.replace("1001.1P", name)).unwrap().to_dxf());
    }

    /// Draws path 1001.1P in a file of another name.
    fn draw_again(&self, file: &str) {
        self.system.put(file, sheet(DRAWING).unwrap().to_dxf());
    }

    fn remove(&self, file: &str) {
        self.system.remove(Utf8Path::new(file)).unwrap();
    }

    /// Returns the watched library, after its first check.
    fn watched(&self) -> Library<'_> {
        let mut library = Library::new(Session::open(&self.workspace, true), &self.inputs);
        let mut found = library.find();
        check_all(&mut library, &mut found);
        assert!(found.now.is_empty(), "{found:#?}");
        library
    }
}

fn check_all(library: &mut Library<'_>, found: &mut Update) {
    while library.has_backlog() {
        library.check_portion(64, found);
    }
    library.check_common(found);
}

/// Applies changes, checks what they affect, and returns the codes of the findings before and now.
fn update(library: &mut Library<'_>, paths: &[&str]) -> [Vec<Code>; 2] {
    let before = library.all_problems();
    let mut found = library.apply(&changed(paths));
    check_all(library, &mut found);
    assert_eq!(found.has_other_problems, before != library.all_problems());
    [codes(&found.before), codes(&found.now)]
}

#[test]
fn a_second_definition_of_a_path_is_noticed() {
    let place = Place::new();
    let mut library = place.watched();
    let twice = vec![Code::PathDefinedTwice];
    let other = ["lib/1001.dxf"];
    place.draw_again(other[0]);
    assert_eq!(update(&mut library, &other), [vec![], twice.clone()]);
    assert_eq!(update(&mut library, &other), [vec![], vec![]], "nothing has changed");
    place.draw(other[0]);
    assert_eq!(update(&mut library, &other)[0], twice);
    place.draw_again(other[0]);
    assert_eq!(update(&mut library, &other)[1], twice);
    place.remove(other[0]);
    assert_eq!(update(&mut library, &other), [twice, vec![]]);
    place.draw_again("lib/apart/1001.dxf");
    assert_eq!(update(&mut library, &["lib/apart/1001.dxf"]), [vec![], vec![]], "nothing finds both");
}

/// A configuration below the library does not apply, and is reported for as long as it is there.
#[test]
fn a_configuration_without_effect_is_noticed() {
    let place = Place::new();
    let mut library = place.watched();
    place.draw("lib/sub/1002.1P.dxf");
    assert_eq!(update(&mut library, &["lib/sub"]), [vec![], vec![]]);
    let unused = vec![Code::UnusedConfiguration];
    let file = ["lib/sub/pathbuild.toml"];
    place.system.put(file[0], "feed = 99\n");
    assert_eq!(update(&mut library, &file), [vec![], unused.clone()]);
    place.remove(file[0]);
    assert_eq!(update(&mut library, &["lib/sub"]), [unused, vec![]], "only the directory is reported");
    place.system.put("lib/sub/pathbuild.txt", "feed = 99\n");
    assert_eq!(update(&mut library, &["lib/sub/pathbuild.txt"]), [vec![], vec![]]);
}

fn changed(paths: &[&str]) -> Changes {
    Changes { paths: paths.iter().map(Utf8PathBuf::from).collect(), ..Changes::default() }
}

fn codes(found: &[Diagnostic]) -> Vec<Code> {
    found.iter().map(Diagnostic::code).collect()
}

/// Adds two drawings and checks the first. Removes the drawings `removed` before the second one is checked.
fn removed_before_the_check(removed: &[&str], events: &[&str]) {
    let place = Place::new();
    let mut library = place.watched();
    let new = ["lib/new/3001.1P.dxf", "lib/new/3002.1P.dxf"];
    for file in new {
        place.draw(file);
    }
    let mut found = library.apply(&changed(&["lib/new"]));
    library.check_portion(1, &mut found);
    library.postpone_rest(&mut found);
    assert_eq!((found.open, library.counts().0), (1, 2));

    for file in removed {
        place.remove(file);
    }
    let mut found = library.apply(&changed(events));
    check_all(&mut library, &mut found);
    assert!(found.now.is_empty() && found.before.is_empty(), "{found:#?}");
    let gone: Vec<&str> = found.removed.iter().map(|path| path.as_str()).collect();
    assert_eq!(gone, removed);
    assert_eq!(library.counts().0, 3 - removed.len());
}

/// Regression test: if drawings that still had to be checked were removed, their PB001 remained for as long as the session ran.
#[test]
fn a_new_drawing_may_be_removed_before_it_is_checked() {
    let both = ["lib/new/3001.1P.dxf", "lib/new/3002.1P.dxf"];
    removed_before_the_check(&both, &both);
    removed_before_the_check(&both, &["lib/new"]);
    removed_before_the_check(&both[1..], &both[1..]);
    removed_before_the_check(&both[1..], &["lib/new"]);
    removed_before_the_check(&[], &both);
}

/// The system cannot report changes in a directory that it does not watch yet.
#[test]
fn a_drawing_whose_removal_was_not_told_is_dropped_after_the_next_change() {
    let place = Place::new();
    let mut library = place.watched();
    place.draw("lib/3001.1P.dxf");
    let mut found = library.apply(&changed(&["lib/3001.1P.dxf"]));
    place.remove("lib/3001.1P.dxf");
    check_all(&mut library, &mut found);
    assert_eq!(codes(&found.now), [Code::UnreadableFile]);

    let again = library.mark_transient(&[].into(), &found.checked_files);
    assert_eq!(codes(&again.before), [Code::UnreadableFile]);
    assert!(again.removed.iter().eq(["lib/3001.1P.dxf"]), "{again:#?}");
    assert!(again.now.is_empty() && !library.has_backlog() && library.counts().0 == 1, "{again:#?}");
}
