//! Checks randomly edited libraries with all kinds of faults in several ways, all of which must give the same findings: a plain model that reads
//! every file and caches nothing, a new database, a database that is notified of the edits, path by path, on several threads, and the program with
//! its cache. ([`pathbuild_testkit::naive`])

use std::collections::BTreeMap;
use std::fs;
use std::sync::Arc;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::MemorySystem;
use pathbuild_db::{
    Database, Db, Role, SecondDefinition, Settings, SourceFile, Target, check_file, check_target, closure,
    locate, path_names, q_project_findings, second_definitions,
};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_path::{FilePattern, PathOptions, Restriction};
use pathbuild_testkit::RandomLibrary;
use pathbuild_testkit::naive::{Finding, Model, Rules, differences, language};
use pathbuild_workspace::config;
use pathbuild_workspace::session::{limits, reading};
use rayon::prelude::*;
use serde_json::Value as Json;

use crate::support::Place;

const LIBRARIES: u64 = 300;
const EDITS: usize = 10;

/// One in this many libraries is also checked by running the program, which takes longer than all other checks together.
const OF_PROGRAM: u64 = 20;

/// Kinds of faults, each of which must occur in at least 5 % of the states.
const KINDS: [&str; 27] = [
    "PB002", "PB107", "PB117", "PB201", "PB202", "PB203", "PB207", "PB301", "PB302", "PB303", "PB304",
    "PB401", "PB407", "PB501", "PB502", "PB503", "PB504", "PB505", "PB506", "PB507", "PB508", "PB509",
    "PB510", "PB511", "PB515", "PB516", "PB517",
];

#[test]
fn every_way_to_ask_finds_what_a_plain_model_finds() {
    let seen: Vec<Vec<Finding>> = (0..LIBRARIES).into_par_iter().flat_map_iter(states).collect();
    assert_eq!(seen.len() as u64, LIBRARIES * (EDITS as u64 + 1));
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for kind in KINDS {
        let with_it = seen.iter().filter(|found| found.iter().any(|it| it.code == kind)).count();
        counts.insert(kind, with_it);
    }
    let rare: Vec<_> = counts.iter().filter(|(_, count)| 20 * **count < seen.len()).collect();
    assert!(rare.is_empty(), "in fewer than 5 % of {} states: {rare:?}", seen.len());
}

/// Returns the findings in each state of a library.
fn states(seed: u64) -> Vec<Vec<Finding>> {
    let mut library = RandomLibrary::new(seed);
    let system = Arc::new(MemorySystem::default());
    for (path, bytes) in library.files() {
        system.put(path.as_str(), bytes.clone());
    }
    let mut incremental = TargetDatabase::new(Arc::clone(&system), library.rules());
    let place = seed.is_multiple_of(OF_PROGRAM).then(|| OnDisk::new(&library));
    let mut seen = Vec::new();
    for step in 0..=EDITS {
        if step > 0 {
            for path in library.edit() {
                change(&library, &path, &system, &mut incremental, place.as_ref());
            }
        }
        let said = |what: &str| format!("library {seed}, edit {step}: {what}");
        let model = Model::new(library.files(), library.rules());
        let expected = model.check("lib");
        let mut fresh = TargetDatabase::new(Arc::clone(&system), library.rules());
        let found = fresh.library(&library);
        same(&expected, &findings(&found), &said("the model and a new database"));
        let [again, found] = [incremental.library(&library), found].map(|found| in_order(&found));
        let differing = again.iter().zip(&found).find(|(a, b)| a != b);
        assert!(again == found, "{}: {differing:#?}", said("a database that was told of the edits"));
        let paths = model.paths("lib");
        let (file, name) = &paths[(usize::try_from(seed).unwrap() + step) % paths.len()];
        let alone = TargetDatabase::new(Arc::clone(&system), library.rules()).path(file, name);
        same_but_cycles(&model.check_alone(file, name), &findings(&alone), &said(&format!("{name} alone")));
        if let Some(place) = &place {
            same(&expected, &place.check(""), &said("the program with what it kept"));
            same(&expected, &place.check("--no-cache -j1"), &said("the program on one thread"));
        }
        seen.push(expected);
    }
    seen
}

#[track_caller]
fn same(model: &[Finding], program: &[Finding], what: &str) {
    // The model has no probing program, and no rule about the whole configuration (PB527): tests/cli/keep_outs.rs tests both. Nor does it know
    // Q-projects without their drawing (PB515): tests/cli/q_project.rs tests them.
    let foreign = ["in the probing program", "beside this Q-project"];
    let is_of_model = |found: &&Finding| {
        let is_foreign = |word: &String| foreign.iter().any(|part| word.contains(part));
        found.code != "PB527" && !found.words.iter().any(is_foreign)
    };
    let program: Vec<Finding> = program.iter().filter(is_of_model).cloned().collect();
    let differences = differences(model, &program);
    assert!(differences.is_empty(), "{what}:\n{}", differences.join("\n"));
}

/// Asserts that findings are the same. If there is a cycle among them, only asserts that both sides report one: a cycle may be entered in
/// several ways, and each path takes only one of them.
#[track_caller]
fn same_but_cycles(model: &[Finding], program: &[Finding], what: &str) {
    let is_cyclic = |found: &[Finding]| found.iter().any(|it| it.code == "PB509");
    assert_eq!(is_cyclic(model), is_cyclic(program), "{what}");
    if !is_cyclic(model) {
        same(model, program, what);
    }
}

fn findings(found: &[Diagnostic]) -> Vec<Finding> {
    found.iter().map(Finding::of).collect()
}

fn in_order(found: &[Diagnostic]) -> Vec<String> {
    let mut found: Vec<String> = found.iter().map(|it| format!("{it:?}")).collect();
    found.sort();
    found
}

fn change(
    library: &RandomLibrary,
    path: &str,
    system: &MemorySystem,
    incremental: &mut TargetDatabase,
    place: Option<&OnDisk>,
) {
    let path = Utf8Path::new(path);
    match library.files().get(path.as_str()) {
        Some(bytes) => system.put(path, bytes.clone()),
        None => _ = pathbuild_db::system::System::remove(system, path),
    }
    incremental.db.touch_file(path);
    incremental.db.touch_directory(path.parent().unwrap());
    if let Some(place) = place {
        place.put(library, path);
    }
}

struct TargetDatabase {
    db: Database,
    targets: BTreeMap<(String, String), Target>,
}

impl TargetDatabase {
    fn new(system: Arc<MemorySystem>, rules: &Rules) -> Self {
        let db = Database::new(system);
        let search = rules.search.iter().map(Utf8PathBuf::from).collect();
        let restrict = rules.restrict.iter().map(|(parent, child)| Restriction::new(parent, child).unwrap());
        let settings = config::Settings::default();
        Settings::new(
            &db,
            reading(&settings, false),
            Arc::new(language()),
            FilePattern::default(),
            search,
            restrict.collect(),
            PathOptions { feed: Some(100.0), sweep_height: None, ..PathOptions::default() },
            limits(&settings),
        );
        Self { db, targets: BTreeMap::new() }
    }

    /// Returns the findings in the library, sorted and without duplicates.
    fn library(&mut self, library: &RandomLibrary) -> Vec<Diagnostic> {
        let files: Vec<&String> = library.files().keys().filter(|path| path.starts_with("lib/")).collect();
        let mut found = Vec::new();
        for path in &files {
            let file = self.db.file(Utf8Path::new(path));
            found.extend(check_file(&self.db, file).iter().cloned());
            let names: Vec<String> =
                path_names(&self.db, file).iter().map(|name| name.as_str().to_owned()).collect();
            for name in names {
                found.extend(self.path(path, &name));
            }
        }
        let drawings = files.iter().map(|path| Utf8Path::new(path.as_str()));
        let drawings = drawings.map(|path| (path, path_names(&self.db, self.db.file(path))));
        found.extend(second_definitions(&self.db, drawings, false).iter().map(SecondDefinition::diagnostic));
        for path in &files {
            let Some(q_project) = files.iter().find(|it| **it == &path.replace(".dxf", "_Q.dxf")) else {
                continue;
            };
            let [drawing, q_project] = [path, q_project].map(|it| self.db.file(Utf8Path::new(it)));
            if drawing != q_project {
                found.extend(q_project_findings(&self.db, drawing, q_project).iter().cloned());
            }
        }
        let mut found: Vec<Diagnostic> = found.into_iter().map(|it| locate(&self.db, it)).collect();
        found.sort_by_cached_key(|it| format!("{it:?}"));
        found.dedup();
        found
    }

    /// Returns the findings in a path, and in the drawings that it depends on.
    fn path(&mut self, file: &str, name: &str) -> Vec<Diagnostic> {
        let drawing = self.db.file(Utf8Path::new(file));
        let new = || Target::new(&self.db, drawing, name.into(), Role::Checked);
        let target = *self.targets.entry((file.to_owned(), name.to_owned())).or_insert_with(new);
        let closure = closure(&self.db, target);
        let files: Vec<SourceFile> = closure.files(&self.db);
        let faults = files.iter().flat_map(|file| check_file(&self.db, *file));
        let found = check_target(&self.db, target).chain(faults).cloned();
        found.map(|it| locate(&self.db, it)).collect()
    }
}

/// The library on disk, for runs of the program.
struct OnDisk(Place);

impl OnDisk {
    fn new(library: &RandomLibrary) -> Self {
        let rules = library.rules();
        let restrict: Vec<String> =
            rules.restrict.iter().map(|(parent, child)| format!("{parent}:{child}")).collect();
        let configuration = format!(
            "library = [\"lib\"]\nsearch = {:?}\nrestrict = {restrict:?}\nfeed = 100\nkeep-out = 'clamps'\n",
            rules.search
        );
        let place = Place::new().file("pathbuild.toml", configuration).file("spare/nothing", "");
        let files = library.files().iter();
        Self(files.fold(place, |place, (path, bytes)| place.file(path, bytes)))
    }

    fn put(&self, library: &RandomLibrary, path: &Utf8Path) {
        let on_disk = self.0.path().join(path);
        match library.files().get(path.as_str()) {
            Some(bytes) => fs::write(on_disk, bytes).unwrap(),
            None => _ = fs::remove_file(on_disk),
        }
    }

    fn check(&self, options: &str) -> Vec<Finding> {
        let run = self.0.run(&format!("check --format=json {options}"));
        assert!(matches!(run.status, Some(0 | 1)), "{run}");
        let of = |line: &str| {
            let found: Json = serde_json::from_str(line).unwrap();
            let text = |key: &str| found[key].as_str().map(str::to_owned);
            Finding {
                code: text("code").unwrap(),
                file: text("file").unwrap_or_default(),
                path: text("path"),
                handle: text("handle"),
                words: vec![text("message").unwrap()],
            }
        };
        run.stdout.lines().filter(|line| line.starts_with(r#"{"type":"finding""#)).map(of).collect()
    }
}
