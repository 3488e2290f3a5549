//! Adds, removes and changes files in a library while one session watches it. After each step, the session's reports must add up to the findings of
//! a check from scratch. Each step waits for the previous one, so that all of them happen to the same session.

use std::cell::{Cell, RefCell};
use std::sync::Arc;
use std::time::Duration;
use std::{fs, thread};

use pathbuild_db::system::OsSystem;
use pathbuild_diagnostic::Diagnostic;
use pathbuild_testkit::{RandomLibrary, sheet};
use pathbuild_workspace::session::Session;
use pathbuild_workspace::watch::{FirstCheck, Listener, Request, Update, WakeHandle, WatchEnd};
use pathbuild_workspace::{Inputs, check};

use crate::Chance;
use crate::on_disk::{OnDisk, sorted};

/// A drawing that is changed after each step: once the session reports this change, it has processed the step as well.
const TICK: &str = "lib/ticks/9999.1P.dxf";

/// A function that performs the next step of a test; returns `false` if none is left.
type Step<'s> = Box<dyn FnMut(&OnDisk) -> bool + 's>;

/// A listener that performs the steps of a test one after the other.
struct Driver<'s> {
    name: String,
    place: OnDisk,
    step: RefCell<Step<'s>>,
    bell: RefCell<Option<WakeHandle>>,
    told: RefCell<Vec<String>>,
    ticks: Cell<u32>,
    is_patient: Cell<bool>,
}

/// Time slightly longer than the watcher waits for an incomplete drawing.
const PATIENCE: Duration = Duration::from_millis(2_100);

impl Driver<'_> {
    fn tick(&self) {
        self.ticks.set(self.ticks.get() + 1);
        let text = format!("layer 9999.1P\nstart 0,0 \"T5 O2 I1 B0 MX\"\nmill 0,0 {},0", self.ticks.get());
        self.place.draw(TICK, &format!("{text}\nend {},0", self.ticks.get()));
    }

    /// Compares the reported findings with the expected ones, and performs the next step.
    fn settle(&self) {
        let expected = self.checked_anew();
        let told = sorted(self.told.borrow().clone());
        // The watcher may still be waiting for a drawing without an end marker.
        if told != expected && !self.is_patient.replace(true) {
            thread::sleep(PATIENCE);
            return self.tick();
        }
        self.is_patient.set(false);
        assert_eq!(told, expected, "{}, after {} steps", self.name, self.ticks.get());
        if (self.step.borrow_mut())(&self.place) {
            self.tick();
        } else if let Some(bell) = &*self.bell.borrow() {
            bell.end();
        }
    }

    fn checked_anew(&self) -> Vec<String> {
        let inputs = Inputs::default();
        let workspace = self.place.workspace(&inputs, Arc::new(OsSystem), false);
        let request = check::Request { inputs: &inputs, with_all_values: false, changed: None };
        let checked = request.run(&mut Session::open(&workspace, workspace.caches_results())).unwrap();
        sorted(checked.diagnostics.iter().map(shown).collect())
    }
}

fn shown(found: &Diagnostic) -> String {
    format!("{:?} {:?} {:?}", found.code(), found.file, found.arguments)
}

impl Listener for Driver<'_> {
    fn set_wake_handle(&self, bell: WakeHandle) {
        self.bell.replace(Some(bell.clone()));
        thread::spawn(move || {
            thread::sleep(Duration::from_mins(3));
            bell.end();
        });
    }

    fn first_check_done(&self, beginning: &FirstCheck) {
        self.told.borrow_mut().extend(beginning.diagnostics.iter().map(shown));
        self.settle();
    }

    fn batch_done(&self, update: &Update) {
        {
            let mut told = self.told.borrow_mut();
            for before in update.before.iter().map(shown) {
                let index = told.iter().position(|found| *found == before).expect("it was told");
                told.swap_remove(index);
            }
            told.extend(update.now.iter().map(shown));
        }
        let is_ticked = update.changed.iter().any(|path| path.ends_with(TICK));
        if is_ticked && update.open == 0 {
            self.settle();
        }
    }
}

/// Watches a library until no step is left. Returns the number of steps performed.
fn drive(name: String, place: OnDisk, step: Step<'_>) -> u32 {
    fs::create_dir_all(place.path().join("lib/ticks")).unwrap();
    let (bell, told, ticks, is_patient) = Default::default();
    let driver = Driver { name, place, step: RefCell::new(step), bell, told, ticks, is_patient };
    driver.tick();
    driver.ticks.set(0);
    let inputs = Inputs::default();
    let mut workspace = driver.place.workspace(&inputs, Arc::new(OsSystem), false);
    workspace.settings.watch.debounce.value = Duration::from_millis(10);
    let request = Request { inputs: &inputs, emits: false, lists: false, polls: false };
    let ended = request.run(&workspace, &driver);
    assert!(matches!(ended, WatchEnd::Over), "{ended:?}");
    driver.ticks.get()
}

fn component(names: &[&str]) -> String {
    let layer =
        |name: &&str| format!("layer {name}\nstart 0,0 \"T5 O2 I1 B0 MX\"\nmill 0,0 40,0\nend 40,0\n");
    names.iter().map(layer).collect()
}

fn project(name: &str, embeds: &[&str]) -> String {
    let at = |index: usize| 40 * index;
    let part = |(index, name)| format!("subpath {},0 {},0 \">{name}\"\n", at(index), at(index + 1));
    let parts: String = embeds.iter().enumerate().map(part).collect();
    format!("layer {name}\nstart 0,0 \"T5 O2 MX\"\n{parts}end {},0\n", at(embeds.len()))
}

const CONFIGURATION: &str = "library = [\"lib\"]\nsearch = [\"spare\"]\nfeed = 100\nspindle = \"manual\"\n";

/// Creates projects that embed components, some of which exist.
fn place() -> OnDisk {
    let place = OnDisk::configured(CONFIGURATION, &[]);
    for directory in ["spare", "lib/more", "away"] {
        fs::create_dir(place.path().join(directory)).unwrap();
    }
    place.draw("lib/1001.dxf", &component(&["1001.1P"]));
    place.draw("lib/8001.1P.dxf", &project("8001.1P", &["1001.1P", "1002.1P"]));
    place.draw("lib/more/8002.1P.dxf", &project("8002.1P", &["1003.1P", "1001.1P"]));
    place
}

/// Files that may be added: the missing components, second definitions of existing ones, in files for one path and for ranges, and drawings
/// unrelated to the projects.
const ARRIVALS: [(&str, &[&str]); 13] = [
    ("lib/1002.1P.dxf", &["1002.1P"]),
    ("lib/1002 b.dxf", &["1002.1P"]),
    ("lib/1001-1003.dxf", &["1001.1P", "1002.1P", "1003.1P"]),
    ("lib/4148.1P.dxf", &["4148.1P"]),
    ("lib/4149.1P.dxf", &["4149.1P"]),
    ("lib/more/1003.dxf", &["1003.1P"]),
    ("lib/more/1001.1P.DXF", &["1001.1P"]),
    ("lib/more/4150.1P.dxf", &["4150.1P"]),
    ("spare/1002.1P.dxf", &["1002.1P"]),
    ("spare/1001-1003.dxf", &["1003.1P"]),
    ("spare/4151.1P.dxf", &["4151.1P"]),
    ("lib/1002.2P.dxf", &[]),
    ("lib/1001.dxf", &["1001.1P"]),
];

/// Adds, removes or renames a drawing, or moves it with its directory.
fn take_step(place: &OnDisk, chance: &mut Chance) {
    let path = |name: &str| place.path().join(name);
    let (file, names) = *chance.pick(&ARRIVALS);
    match chance.below(10) {
        0..7 if path(file).parent().unwrap().is_dir() => {
            // Some programs save by writing a new file and renaming it.
            let bytes = sheet(&component(names)).unwrap().to_dxf();
            fs::write(path("away/new"), bytes).unwrap();
            fs::rename(path("away/new"), path(file)).unwrap();
        }
        7 => _ = fs::remove_file(path(file)),
        8 => _ = fs::rename(path(file), path(chance.pick(&ARRIVALS).0)),
        _ if path("lib/more").exists() => fs::rename(path("lib/more"), path("away/more")).unwrap(),
        _ => fs::rename(path("away/more"), path("lib/more")).unwrap(),
    }
}

#[test]
fn one_session_takes_over_any_sequence_of_arrivals() {
    for seed in 0..12 {
        let mut chance = Chance(0x9e37_79b9_7f4a_7c15 ^ seed);
        let mut left = crate::steps() / 5;
        let step = move |place: &OnDisk| {
            // Most steps make one change, some make several.
            for _ in 0..=(chance.below(3) / 2 * chance.below(3)) {
                take_step(place, &mut chance);
            }
            left -= 1;
            left > 0
        };
        drive(format!("arrivals {seed}"), place(), Box::new(step));
    }
}

/// Regression test: the first file caused the directory's names to be listed late, so that the second file was taken for a known one.
#[test]
fn a_component_that_arrives_after_another_drawing_is_found() {
    for (first, second) in [(3, 0), (3, 2), (7, 5), (10, 8), (10, 9), (3, 1)] {
        let mut arrivals = [first, second].into_iter();
        let step = move |place: &OnDisk| {
            let arrival = arrivals.next().map(|index: usize| ARRIVALS[index]);
            arrival.inspect(|(file, names)| place.draw(file, &component(names))).is_some()
        };
        assert_eq!(drive(format!("{first}, then {second}"), place(), Box::new(step)), 2);
    }
}

/// Edits a whole library repeatedly. The edits make paths ambiguous, missing or cyclic.
#[test]
fn one_session_takes_over_edits_of_a_library() {
    for seed in 0..2 {
        let mut workshop = RandomLibrary::new(seed);
        let place = OnDisk::new(&workshop);
        let mut left = crate::steps() / 3;
        let step = move |place: &OnDisk| {
            for path in workshop.edit() {
                place.put(&workshop, &path);
            }
            left -= 1;
            left > 0
        };
        drive(format!("library {seed}"), place, Box::new(step));
    }
}
