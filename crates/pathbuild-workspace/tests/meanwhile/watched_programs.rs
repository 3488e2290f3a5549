//! Tests that `watch --emit` reports after each change what `check` and `emit` report for the same files, and that it writes the same programs as
//! `emit`.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;
use std::{fs, thread};

use pathbuild_db::system::OsSystem;
use pathbuild_diagnostic::messages::outputs::STALE_UNSELECTED;
use pathbuild_diagnostic::{Code, Diagnostic};
use pathbuild_workspace::emit::{self, State, Task};
use pathbuild_workspace::session::Session;
use pathbuild_workspace::watch::{FirstCheck, Listener, Request, Update, WakeHandle, WatchEnd};
use pathbuild_workspace::{Inputs, check};

use crate::on_disk::OnDisk;
use crate::{Chance, steps};

const CONFIGURATION: &str = "library = [\"lib\"]\nsearch = [\"lib/search\"]\nfeed = 100\nrapid = 1000\nsweep-height = 20\nspindle = \"manual\"\n[watch]\ndebounce = \"10ms\"\n[emit]\ntargets = [\"8*\", \"8003*\"]\n";

const FILES: [&str; 7] = [
    "lib/8001.1P.dxf",
    "lib/8002.1P.dxf",
    "lib/8001-8003 x.dxf",
    "lib/deep/8001.1P.dxf",
    "lib/search/1001.1P.dxf",
    "lib/search/8003.1P.dxf",
    "lib/1001.dxf",
];

const NAMES: [&str; 4] = ["8001.1P", "8002.1P", "8003.1P", "1001.1P"];

/// A listener that compares the findings after each change, and then makes the next change.
struct Comparer {
    place: OnDisk,
    bell: RefCell<Option<WakeHandle>>,
    chance: RefCell<Chance>,
    /// How often each finding is counted.
    state: RefCell<BTreeMap<String, usize>>,
    edits: RefCell<Vec<String>>,
    /// Description of the difference at the last comparison.
    difference: RefCell<String>,
    codes: RefCell<BTreeMap<Code, usize>>,
    has_unselected: Cell<bool>,
    steps: Cell<usize>,
}

fn key(found: &Diagnostic) -> String {
    let Diagnostic { message, file, path, place, arguments, .. } = found;
    format!("{:?} {file:?} {path:?} {place:?} {} {arguments:?}", found.code(), message.key)
}

impl Comparer {
    fn new(configuration: &str, seed: u64) -> Self {
        let path = "layer 8001.1P\nstart 0,0 \"T5 O2 I1 B0 MX\"\nmill 0,0 40,0\nend 40,0";
        let place = OnDisk::configured(configuration, &[(FILES[0], path)]);
        for directory in ["deep", "search"] {
            fs::create_dir(place.path().join("lib").join(directory)).unwrap();
        }
        // No configured target matches this path.
        for directory in ["lib", "gcode"] {
            let directory = place.path().join(directory);
            fs::create_dir_all(&directory).unwrap();
            let head = "(pathbuild 0.2.0 3f2a9c0d41b7e685-09c1d2e3 native O2 T5)";
            for drawing in ["1001", "8001.1P", "8001-8003 x"] {
                let program = format!("%\n{head}\n(Path 1001.1P, drawing {drawing}.dxf)\nM30\n%\n");
                fs::write(directory.join(format!("old {drawing}.gcode")), program).unwrap();
            }
        }
        let chance = RefCell::new(Chance(0x9e37_79b9_7f4a_7c15 ^ seed));
        let (bell, state, edits, difference, codes, has_unselected, steps) = Default::default();
        Self { place, bell, chance, state, edits, difference, codes, has_unselected, steps }
    }

    /// Returns the findings of `check` and `emit --check`, and the programs that differ from what `emit` would write.
    fn expected(&self) -> Vec<String> {
        let inputs = Inputs::default();
        let workspace = self.place.workspace(&inputs, Arc::new(OsSystem), false);
        let request = check::Request { inputs: &inputs, with_all_values: false, changed: None };
        let mut found = request.run(&mut Session::open(&workspace, false)).unwrap().diagnostics;
        let task = Task::Compare { moves_only: false };
        let request = emit::Request { task, ..emit::Request::default() };
        let emission = request.run(&mut Session::new(&workspace), &inputs).unwrap();
        found.extend(emission.diagnostics);
        let mut expected: Vec<String> = found.iter().map(key).collect();
        for outcome in emission.delivered {
            let is_older = outcome.problems.iter().any(|found| found.code() == Code::OlderOutput);
            let is_other = |state: &State| !matches!(state, State::Current);
            let other = outcome.files.iter().filter(|(_, state)| !is_older && is_other(state));
            expected.extend(other.map(|(file, state)| format!("{file}: {state:?}")));
        }
        expected.sort();
        expected.dedup();
        expected
    }

    /// Compares the findings. If they are equal, makes the next change; otherwise, more findings may follow.
    fn compare(&self) {
        let found: Vec<String> = self.state.borrow().keys().cloned().collect();
        let expected = self.expected();
        if found != expected {
            self.difference.replace(format!("{found:#?}\n{expected:#?}"));
        } else if self.steps.replace(self.steps.get() + 1) == steps() {
            self.bell.borrow().as_ref().unwrap().end();
        } else {
            self.difference.borrow_mut().clear();
            let edit = self.edit();
            self.edits.borrow_mut().push(edit);
        }
    }

    /// Changes, removes or renames a drawing. Returns a description.
    fn edit(&self) -> String {
        let mut chance = self.chance.borrow_mut();
        let place = |name: &str| self.place.path().join(name);
        let file = *chance.pick(&FILES);
        let other = *chance.pick(&FILES);
        match chance.below(6) {
            0 if place(file).exists() => {
                fs::remove_file(place(file)).unwrap();
                format!("remove {file}")
            }
            1 if place(file).exists() && file != other => {
                fs::rename(place(file), place(other)).unwrap();
                format!("rename {file} to {other}")
            }
            2 if chance.below(3) == 0 => {
                fs::write(place(file), "no drawing EOF").unwrap();
                format!("spoil {file}")
            }
            _ => {
                let paths: Vec<String> =
                    (0..=chance.below(2)).map(|row| path(&mut chance, 20 * row)).collect();
                self.place.draw(file, &paths.concat());
                format!("draw {file}: {paths:?}")
            }
        }
    }

    fn change(&self, before: &[Diagnostic], now: &[Diagnostic]) {
        let mut state = self.state.borrow_mut();
        for found in now {
            *state.entry(key(found)).or_default() += 1;
            *self.codes.borrow_mut().entry(found.code()).or_default() += 1;
            self.has_unselected.set(self.has_unselected.get() || found.message == &STALE_UNSELECTED);
        }
        for found in before.iter().map(key) {
            let count = state.get_mut(&found).expect("the finding was not reported");
            *count -= 1;
            if *count == 0 {
                state.remove(&found);
            }
        }
    }
}

/// Returns a path in the text form, which has an error, mills, or embeds another path.
fn path(chance: &mut Chance, y: usize) -> String {
    let (name, other) = (*chance.pick(&NAMES), *chance.pick(&NAMES));
    let depth = chance.below(7);
    let middle = match chance.below(4) {
        0 => format!("subpath 0,{y} 40,{y} \">{other}\""),
        _ => format!("mill 0,{y} 40,{y}"),
    };
    format!("layer {name}\nstart 0,{y} \"T5 O2 I1 B{depth} MX\"\n{middle}\nend 40,{y}\n")
}

impl Listener for Comparer {
    fn set_wake_handle(&self, bell: WakeHandle) {
        self.bell.replace(Some(bell.clone()));
        thread::spawn(move || {
            thread::sleep(Duration::from_secs(100));
            bell.end();
        });
    }

    fn first_check_done(&self, check: &FirstCheck) {
        self.change(&[], &check.diagnostics);
        self.compare();
    }

    fn batch_done(&self, update: &Update) {
        self.change(&update.before, &update.now);
        self.compare();
    }
}

#[track_caller]
fn compare(configuration: &str, seed: u64) {
    let comparer = Comparer::new(configuration, seed);
    let inputs = Inputs::default();
    let workspace = comparer.place.workspace(&inputs, Arc::new(OsSystem), false);
    let request = Request { inputs: &inputs, emits: true, lists: false, polls: false };
    assert!(matches!(request.run(&workspace, &comparer), WatchEnd::Over));
    let done = comparer.steps.get();
    let edits = comparer.edits.borrow();
    assert!(done > steps(), "after {done} edits:\n{:#?}\n{}", edits, comparer.difference.borrow());
    let codes = comparer.codes.borrow();
    let expected =
        [Code::SameOutput, Code::StaleOutput, Code::OlderOutput, Code::NoPath, Code::PathDefinedTwice];
    assert!(expected.iter().all(|code| codes.contains_key(code)), "{codes:?}");
    assert!(comparer.has_unselected.get());
}

#[test]
fn watching_says_of_programs_beside_their_drawings_what_emit_says() {
    compare(CONFIGURATION, 1);
}

#[test]
fn watching_says_of_programs_in_one_directory_what_emit_says() {
    compare(&format!("out-dir = \"gcode\"\n{CONFIGURATION}"), 2);
}
