//! Tests that, while a library is watched, drawings with transient findings are checked again after the next change of any file.

use std::cell::{Cell, RefCell};
use std::sync::Arc;
use std::sync::atomic::{AtomicI64, Ordering};
use std::thread;
use std::time::Duration;

use camino::Utf8PathBuf;
use pathbuild_db::system::OsSystem;
use pathbuild_diagnostic::{Code, Diagnostic};
use pathbuild_workspace::watch::{FirstCheck, Listener, Request, Update, WakeHandle, WatchEnd};
use pathbuild_workspace::{Inputs, Workspace};

use crate::mischief::{Event, Mischief};
use crate::on_disk::{EMITTING, OnDisk, long};

const OTHER: (&str, &str) =
    ("lib/1001.1P.dxf", "layer 1001.1P\nstart 0,0 \"T5 O2 I1 B0 MX\"\nmill 0,0 40,0\nend 40,0");
const VICTIM: &str = "lib/8001.1P.dxf";

/// A listener that changes a drawing after the first check, and another one after the retry of the first findings. Ends watching soon after that, or
/// on a timeout.
struct Editor {
    /// The drawing that is changed, with its new content.
    edit: (&'static str, String),
    /// Whether the event stops happening after the first check.
    passes: bool,
    place: OnDisk,
    mischief: Arc<Mischief>,
    bell: RefCell<Option<WakeHandle>>,
    found: RefCell<Vec<Code>>,
    is_written: Cell<bool>,
    told: RefCell<Vec<Update>>,
}

impl Editor {
    fn end_after(&self, time: Duration) {
        let bell = self.bell.borrow().clone().unwrap();
        thread::spawn(move || {
            thread::sleep(time);
            bell.end();
        });
    }

    fn has_program(&self) -> bool {
        self.place.path().join("lib/8001.1P_Milling.gcode").exists()
    }
}

impl Listener for Editor {
    fn set_wake_handle(&self, bell: WakeHandle) {
        self.bell.replace(Some(bell));
        self.end_after(Duration::from_secs(20));
    }

    fn first_check_done(&self, beginning: &FirstCheck) {
        self.found.replace(beginning.diagnostics.iter().map(Diagnostic::code).collect());
        self.is_written.set(self.has_program());
        if beginning.diagnostics.is_empty() {
            self.end_after(Duration::ZERO);
        }
        if self.passes {
            self.mischief.countdown.store(i64::MAX, Ordering::SeqCst);
        }
        self.place.draw(self.edit.0, &self.edit.1);
    }

    fn batch_done(&self, update: &Update) {
        self.told.borrow_mut().push(update.clone());
        match self.told.borrow().len() {
            1 if self.passes && update.before.is_empty() => {}
            2 => self.place.draw(OTHER.0, OTHER.1),
            // Another retry would happen within this time.
            _ => self.end_after(Duration::from_secs(1)),
        }
    }
}

/// Watches a library in which an event happens the n-th time, or from then on, until another drawing changes.
fn watch(event: Event, time: i64, lasts: bool, emits: bool) -> Editor {
    watch_edit(event, time, lasts, emits, (OTHER.0, OTHER.1.replace("B0", "B1")), true)
}

fn watch_edit(
    event: Event,
    time: i64,
    lasts: bool,
    emits: bool,
    edit: (&'static str, String),
    passes: bool,
) -> Editor {
    let place = OnDisk::configured(EMITTING, &[OTHER, (VICTIM, &long("8001.1P"))]);
    watch_place(place, VICTIM, event, time, lasts, emits, edit, passes)
}

#[expect(clippy::too_many_arguments, reason = "what may happen, one by one")]
fn watch_place(
    place: OnDisk,
    trigger: &str,
    event: Event,
    time: i64,
    lasts: bool,
    emits: bool,
    edit: (&'static str, String),
    passes: bool,
) -> Editor {
    let mischief = Arc::new(Mischief {
        trigger: trigger.to_owned(),
        countdown: AtomicI64::new(time),
        lasts,
        is_before: false,
        event,
        victim: place.path().join(VICTIM),
        bytes: Vec::new(),
    });
    let (bell, found, is_written, told) = Default::default();
    let editor = Editor { edit, passes, place, mischief, bell, found, is_written, told };
    let inputs = Inputs::default();
    let workspace = editor.place.workspace(&inputs, Arc::<Mischief>::clone(&editor.mischief), false);
    let workspace = Workspace { jobs: Some(1), ..workspace };
    let request = Request { inputs: &inputs, emits, lists: false, polls: false };
    assert!(matches!(request.run(&workspace, &editor), WatchEnd::Over));
    editor
}

/// Returns the update in which the transient finding disappeared. It must follow the update of the edit, without any further retry.
#[track_caller]
fn tried_again(editor: &Editor) -> Update {
    let told = editor.told.borrow();
    let [of_edit, again, of_other] = &**told else { panic!("{told:#?}") };
    let changed: Vec<&Utf8PathBuf> = of_edit.changed.iter().collect();
    assert!(matches!(&*changed, [file] if file.ends_with(OTHER.0)), "{of_edit:#?}");
    assert!(again.changed.is_empty() && again.now.is_empty(), "{again:#?}");
    assert!(again.tried_again.iter().all(|file| file.ends_with(VICTIM)), "{again:#?}");
    assert!(of_other.tried_again.is_empty(), "{of_other:#?}");
    again.clone()
}

#[test]
fn what_may_pass_is_tried_again_after_any_change() {
    for (event, lasts, code) in
        [(Event::Busy, true, Code::LimitReached), (Event::Fail, false, Code::UnreadableFile)]
    {
        let editor = watch(event, 1, lasts, false);
        assert_eq!(*editor.found.borrow(), [code]);
        let before: Vec<Code> = tried_again(&editor).before.iter().map(Diagnostic::code).collect();
        assert_eq!(before, [code]);
    }
}

/// The machine is busy only while programs are generated.
#[test]
fn a_program_that_was_given_up_is_tried_again() {
    let is_of_program = |time| {
        let editor = watch(Event::Busy, time, false, true);
        assert!(editor.has_program());
        let is_given_up = !editor.found.borrow().is_empty();
        assert!(is_given_up != editor.is_written.get());
        let passed = |again: &Update| again.before.iter().map(Diagnostic::code).collect::<Vec<_>>();
        is_given_up && passed(&tried_again(&editor)) == [Code::LimitReached]
    };
    assert!((1..10).any(is_of_program));
}

/// A drawing that was just checked is not retried: otherwise each save of a drawing that exceeds the time limit would take that time twice.
#[test]
fn what_was_just_tried_is_not_tried_again() {
    let edit = (VICTIM, long("8001.1P").replace("B0", "B1"));
    let editor = watch_edit(Event::Busy, 1, true, false, edit, false);
    assert_eq!(*editor.found.borrow(), [Code::LimitReached]);
    let told = editor.told.borrow();
    assert!(matches!(&**told, [only] if only.tried_again.is_empty() && only.now.len() == 1), "{told:#?}");
}

/// A drawing embeds another one in its directory, which cannot be listed when the embedded path is looked up.
#[test]
fn a_directory_in_which_something_was_looked_for_in_vain_is_listed_again() {
    let project = "layer 8001.1P\nstart 0,0 \"T5 O2 MX\"\nsubpath 0,0 40,0 \">1001.1P\"\nend 40,0";
    let place = OnDisk::configured(EMITTING, &[OTHER, (VICTIM, project)]);
    let edit = (OTHER.0, OTHER.1.replace("B0", "B1"));
    // The event happens the second time, because the first listing finds the drawings.
    let editor = watch_place(place, "lib", Event::Fail, 2, false, false, edit, true);
    assert_eq!(*editor.found.borrow(), [Code::UnreadableFile]);
    let told = editor.told.borrow();
    let before: Vec<Code> = told.iter().flat_map(|update| &update.before).map(Diagnostic::code).collect();
    let now: Vec<&Diagnostic> = told.iter().flat_map(|update| &update.now).collect();
    assert!(before == [Code::UnreadableFile] && now.is_empty(), "{told:#?}");
}

/// A listener that adds a drawing after the first check, and ends watching after two batches.
struct Adder {
    place: OnDisk,
    bell: RefCell<Option<WakeHandle>>,
    told: RefCell<Vec<Update>>,
}

impl Listener for Adder {
    fn set_wake_handle(&self, bell: WakeHandle) {
        self.bell.replace(Some(bell));
    }

    fn first_check_done(&self, beginning: &FirstCheck) {
        assert!(beginning.diagnostics.is_empty() && beginning.drawings == 2, "{beginning:#?}");
        self.place.draw("lib/1002.1P.dxf", &OTHER.1.replace("1001", "1002"));
    }

    fn batch_done(&self, update: &Update) {
        self.told.borrow_mut().push(update.clone());
        if self.told.borrow().len() == 2 {
            self.bell.borrow().as_ref().unwrap().end();
        }
    }
}

/// Drawings in a directory that temporarily cannot be listed are not treated as removed; new ones are found once it can be listed again.
#[test]
fn a_directory_that_cannot_be_listed_for_a_moment_loses_no_drawing() {
    let place = OnDisk::configured(EMITTING, &[OTHER, (VICTIM, &long("8001.1P"))]);
    let mischief = Arc::new(Mischief {
        trigger: "lib".to_owned(),
        // The first listing happens at the start.
        countdown: AtomicI64::new(2),
        lasts: false,
        is_before: false,
        event: Event::Fail,
        victim: place.path().join("lib"),
        bytes: Vec::new(),
    });
    let adder = Adder { place, bell: RefCell::default(), told: RefCell::default() };
    let inputs = Inputs::default();
    let workspace = adder.place.workspace(&inputs, mischief, false);
    let request = Request { inputs: &inputs, emits: false, lists: false, polls: false };
    assert!(matches!(request.run(&workspace, &adder), WatchEnd::Over));
    let told = adder.told.borrow();
    let [failed, again] = &**told else { panic!("{told:#?}") };
    let codes = |found: &[Diagnostic]| found.iter().map(Diagnostic::code).collect::<Vec<_>>();
    assert!(failed.removed.is_empty() && codes(&failed.now) == [Code::UnreadableFile], "{failed:#?}");
    assert_eq!(codes(&failed.problems), [Code::UnreadableFile]);
    assert!(codes(&again.before) == [Code::UnreadableFile] && again.now.is_empty(), "{again:#?}");
    assert!(again.has_other_problems && again.problems.is_empty(), "{again:#?}");
    assert_eq!(again.checked_files.len(), 1, "{again:#?}");
    assert!(again.tried_again.iter().any(|path| path.ends_with("lib")), "{again:#?}");
}

/// A listener that gives the prepared answers, the last one first, and then reports that the configuration has changed.
struct Doubter {
    answers: RefCell<Vec<bool>>,
}

impl Listener for Doubter {
    fn is_configuration_current(&self) -> bool {
        self.answers.borrow_mut().pop().unwrap_or(false)
    }
}

/// The configuration may change between being loaded and being watched. Polling does not notice a change within a second after its first look.
#[test]
fn a_configuration_that_changed_before_it_was_watched_begins_anew() {
    for (polls, answers) in [(false, vec![]), (true, vec![true])] {
        let place = OnDisk::configured(EMITTING, &[OTHER]);
        let inputs = Inputs::default();
        let workspace = place.workspace(&inputs, OsSystem::shared(), false);
        let request = Request { inputs: &inputs, emits: false, lists: false, polls };
        let doubter = Doubter { answers: answers.into() };
        assert!(matches!(request.run(&workspace, &doubter), WatchEnd::ConfigurationChanged), "{polls}");
        assert!(doubter.answers.borrow().is_empty());
    }
}
