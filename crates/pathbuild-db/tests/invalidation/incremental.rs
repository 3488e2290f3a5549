//! After any sequence of edits, the database gives the same results as a new one. Each step also states which targets it must change and
//! which it must not. A third of the steps make a path ambiguous, missing or cyclic.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::sync::Arc;

use camino::Utf8Path;
use pathbuild_db::system::{MemorySystem, System};
use pathbuild_db::{Database, Db, Role, Target, locate};
use proptest::prelude::*;

use crate::library::{DIRECTORIES, Drawing, Library, Prediction, file_name};
use crate::world::{Outcome, dxf, outcome, set_up};

const PATHS: usize = 6;

/// An edit. Numbers are taken modulo the number of candidates, so that any part of a sequence is a valid sequence.
#[derive(Clone, Debug)]
enum Step {
    /// Raises B of a path by 0.1 mm.
    RaiseBottom(usize),
    /// Inserts a remark before a path.
    Remark(usize),
    /// Draws a path in a second file as well, in its own directory or in the search directory.
    Double(usize, usize),
    Remove(usize),
    /// Renames a file so that, according to its name, it cannot define its path.
    Hide(usize),
    /// Makes a path embed one that embeds it, which closes a cycle.
    Close(usize),
    /// Removes one embedding from a path.
    Unembed(usize),
    /// Draws missing paths again under their usual names, and removes additional files.
    Mend,
}

fn step() -> impl Strategy<Value = Step> {
    prop_oneof![
        4 => (0..PATHS).prop_map(Step::RaiseBottom),
        2 => (0..PATHS).prop_map(Step::Remark),
        2 => (0..PATHS, 0..2_usize).prop_map(|(path, directory)| Step::Double(path, directory)),
        1 => (0..PATHS).prop_map(Step::Remove),
        1 => (0..PATHS).prop_map(Step::Hide),
        1 => (0..PATHS).prop_map(Step::Close),
        1 => (0..PATHS).prop_map(Step::Unembed),
        3 => Just(Step::Mend),
    ]
}

impl Step {
    fn apply(&self, library: &mut Library) {
        match *self {
            Self::RaiseBottom(path) => each(library, path, |drawing| drawing.bottom += 1),
            Self::Remark(path) => each(library, path, |drawing| drawing.remarks += 1),
            Self::Unembed(path) => each(library, path, |drawing| _ = drawing.embeds.pop()),
            Self::Double(path, directory) => {
                if let Some(file) = first_file(library, path) {
                    let copy = Drawing { bottom: 5, ..library.files[&file].clone() };
                    library.files.insert(file_name(DIRECTORIES[directory], path, " copy"), copy);
                }
            }
            Self::Remove(path) => _ = first_file(library, path).and_then(|file| library.files.remove(&file)),
            Self::Hide(path) => {
                if let Some(file) = first_file(library, path) {
                    let drawing = library.files.remove(&file).expect("it is there");
                    library.files.insert(format!("lib/hidden{path}.dxf"), drawing);
                }
            }
            Self::Close(path) => {
                let user = library.files.values().find(|drawing| drawing.embeds.contains(&path));
                let user = user.map_or(path, |drawing| drawing.path);
                each(library, path, |drawing| {
                    if !drawing.embeds.contains(&user) {
                        drawing.embeds.push(user);
                    }
                });
            }
            Self::Mend => *library = Library::new(),
        }
    }
}

fn each(library: &mut Library, path: usize, edit: impl Fn(&mut Drawing)) {
    library.files.values_mut().filter(|drawing| drawing.path == path).for_each(edit);
}

fn first_file(library: &Library, path: usize) -> Option<String> {
    library.files.iter().find(|(_, drawing)| drawing.path == path).map(|(file, _)| file.clone())
}

/// A long-lived database, with one target for each file that ever existed.
struct Kept {
    system: Arc<MemorySystem>,
    db: Database,
    targets: HashMap<String, Target>,
}

thread_local! {
    /// Cache of written drawings, since writing takes longer than compiling.
    static WRITTEN: RefCell<HashMap<String, Vec<u8>>> = RefCell::default();
}

fn written(drawing: &Drawing) -> Vec<u8> {
    let text = drawing.text();
    WRITTEN.with_borrow_mut(|known| known.entry(text).or_insert_with_key(|text| dxf(text)).clone())
}

impl Kept {
    fn new(library: &Library) -> Self {
        let system = Arc::new(MemorySystem::default());
        for (file, drawing) in &library.files {
            system.put(file, written(drawing));
        }
        let db = Database::new(system.clone());
        set_up(&db, &DIRECTORIES[1..]);
        Self { system, db, targets: HashMap::new() }
    }

    /// Changes the files from one state of the library to the next.
    fn edit(&mut self, before: &Library, after: &Library) {
        let names: BTreeSet<&String> = before.files.keys().chain(after.files.keys()).collect();
        for name in names {
            let (old, new) = (before.files.get(name), after.files.get(name));
            let file = Utf8Path::new(name.as_str());
            match new {
                _ if old == new => continue,
                Some(drawing) => self.system.put(file, written(drawing)),
                None => self.system.remove(file).unwrap(),
            }
            self.db.touch_file(file);
            if old.is_some() != new.is_some() {
                self.db.touch_directory(file.parent().unwrap());
            }
        }
    }

    fn outcomes(&mut self, library: &Library) -> BTreeMap<String, Outcome> {
        let outcome = |(file, drawing): (&String, &Drawing)| {
            let target = self.targets.entry(file.clone()).or_insert_with(|| {
                let name = crate::library::name(drawing.path).into_boxed_str();
                Target::new(&self.db, self.db.file(file.as_str().into()), name, Role::Emitted)
            });
            (file.clone(), outcome(&self.db, *target))
        };
        library.files.iter().map(outcome).collect()
    }

    /// Fills in the lines and handles of an outcome.
    fn located(&self, outcome: Outcome) -> Outcome {
        let located = outcome.diagnostics.into_iter().map(|found| locate(&self.db, found)).collect();
        Outcome { diagnostics: located, program: outcome.program }
    }
}

/// Compares the findings with those that the model predicts.
fn check_prediction(library: &Library, file: &str, outcome: &Outcome) -> Result<(), TestCaseError> {
    let codes: BTreeSet<String> = outcome.diagnostics.iter().map(|found| found.code().to_string()).collect();
    match library.predict(file) {
        Prediction::Milled(_) => {
            prop_assert!(outcome.program.is_some(), "{file}: {codes:?}");
        }
        Prediction::Wrong(wrong) => {
            let found: BTreeSet<&str> =
                codes.iter().map(String::as_str).filter(|code| *code != "PB511").collect();
            prop_assert_eq!(found, wrong, "{}", file);
            prop_assert!(outcome.program.is_none());
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn incremental_results_are_those_from_scratch(steps in prop::collection::vec(step(), 1..10)) {
        let mut library = Library::new();
        let mut kept = Kept::new(&library);
        let mut before = kept.outcomes(&library);
        for step in steps {
            let mut next = library.clone();
            step.apply(&mut next);
            kept.edit(&library, &next);
            let after = kept.outcomes(&next);
            let mut fresh = Kept::new(&next);
            for (file, from_scratch) in fresh.outcomes(&next) {
                let incremental = &after[&file];
                check_prediction(&next, &file, incremental)?;
                prop_assert_eq!(kept.located(incremental.clone()), fresh.located(from_scratch), "{:?}: {}", step, file);
                let Some(old) = before.get(&file) else { continue };
                if library.predict(&file) != next.predict(&file) {
                    prop_assert_ne!(old, incremental, "{:?} must change {}", step, file);
                } else if library.reach(&file) == next.reach(&file) && library.files.len() == next.files.len() {
                    prop_assert_eq!(old, incremental, "{:?} must not change {}", step, file);
                }
            }
            (library, before) = (next, after);
        }
    }
}
