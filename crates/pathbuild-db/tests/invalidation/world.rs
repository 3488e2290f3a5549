//! A database over files in memory that records which queries ran, labelled by the target for which each first ran.

use std::collections::{BTreeSet, HashMap};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::{MemorySystem, System};
use pathbuild_db::{
    Database, Db, Limits, Reading, Role, Settings, SourceFile, Target, check_target, locate, program,
};
use pathbuild_diagnostic::{Diagnostic, Place};
use pathbuild_dxf::Units;
use pathbuild_path::{FilePattern, Language, LineTypeAliases, PathOptions, PathPattern};
use pathbuild_testkit::sheet;

/// Files, a database over them, and the targets that are queried repeatedly.
pub(crate) struct World {
    system: Arc<MemorySystem>,
    pub(crate) db: Database,
    log: Arc<Mutex<Vec<String>>>,
    /// For each query, the label of the target for which it ran first.
    labels: HashMap<String, &'static str>,
    targets: Vec<(&'static str, Target)>,
    /// The queries that ran for the last target, each with its label.
    ran: BTreeSet<String>,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Outcome {
    /// The findings, which are not located, so they have no lines.
    pub(crate) diagnostics: Vec<Diagnostic>,
    /// The program as text, with every number.
    pub(crate) program: Option<String>,
}

pub(crate) fn dxf(text: &str) -> Vec<u8> {
    sheet(text).expect("the text is right").to_dxf()
}

/// Options for reading drawings. No drawing of these tests exceeds the limits.
pub(crate) const READING: Reading = Reading {
    units: Units::Header,
    approximate_curves: 0.0,
    file_size: 1 << 20,
    entities: 10_000,
    text_length: 65_536,
    walk_time: Duration::from_mins(1),
    is_hashed: false,
    compatible: false,
};

/// Limits that no path here exceeds.
pub(crate) const LIMITS: Limits = Limits { moves: 1_000_000, memory: 1 << 30, paths: 1000 };

/// Applies the settings with which all tests here begin, and further search directories.
pub(crate) fn set_up(db: &Database, search: &[&str]) {
    let language = Language {
        path_pattern: PathPattern::default(),
        keep_out: None,
        part: None,
        line_types: LineTypeAliases::default(),
        text_limit: 65_536,
        doubts: pathbuild_path::DoubtThresholds::default(),
        tools: pathbuild_path::PathTools::default(),
        join_tolerance: 0.0,
    };
    let search = search.iter().map(Utf8PathBuf::from).collect();
    let fold = PathOptions { feed: Some(100.0), sweep_height: Some(20.0), ..PathOptions::default() };
    Settings::new(db, READING, Arc::new(language), FilePattern::default(), search, Vec::new(), fold, LIMITS);
}

/// Queries everything that a client gets for a target.
pub(crate) fn outcome(db: &Database, target: Target) -> Outcome {
    Outcome {
        diagnostics: check_target(db, target).cloned().collect(),
        program: program(db, target).as_ref().map(|program| format!("{program:?}")),
    }
}

impl World {
    /// Creates files from drawings in text form, and a database over them.
    pub(crate) fn new(files: &[(&str, &str)]) -> Self {
        let system = Arc::new(MemorySystem::default());
        for (name, text) in files {
            system.put(*name, dxf(text));
        }
        let log = Arc::default();
        let db = Database::with_log(system.clone(), Arc::clone(&log));
        set_up(&db, &[]);
        Self { system, db, log, labels: HashMap::new(), targets: Vec::new(), ran: BTreeSet::new() }
    }

    /// Queries a path for emitting, and records the queries that ran for the first time.
    pub(crate) fn ask(&mut self, label: &'static str, file: &str, path: &str) {
        let target = self.new_target(label, file, path, Role::Emitted);
        outcome(&self.db, target);
        self.note(label);
    }

    /// Returns the codes of a path's findings, without querying its program.
    pub(crate) fn judge(&mut self, label: &'static str, file: &str, path: &str, role: Role) -> Vec<String> {
        let target = self.new_target(label, file, path, role);
        let codes = check_target(&self.db, target).map(|found| found.code().to_string()).collect();
        self.note(label);
        codes
    }

    pub(crate) fn ran(&self) -> &BTreeSet<String> {
        &self.ran
    }

    pub(crate) fn file(&self, file: &str) -> SourceFile {
        self.db.file(file.into())
    }

    /// Runs work that may be abandoned.
    pub(crate) fn guarded<R>(&self, work: impl Fn(&Database) -> R) -> Result<R, Box<Diagnostic>> {
        self.db.run_guarded(Duration::MAX, || work(&self.db))
    }

    pub(crate) fn put_unnoticed(&self, file: &str, text: &str) {
        self.system.put(file, dxf(text));
    }

    pub(crate) fn remove_unnoticed(&self, file: &str) {
        self.system.remove(file.into()).unwrap();
    }

    fn new_target(&mut self, label: &'static str, file: &str, path: &str, role: Role) -> Target {
        let target = Target::new(&self.db, self.db.file(file.into()), path.into(), role);
        self.targets.push((label, target));
        self.log.lock().unwrap().clear();
        target
    }

    fn note(&mut self, label: &'static str) {
        let log: Vec<String> = self.log.lock().unwrap().drain(..).collect();
        self.ran = log
            .into_iter()
            .map(|query| named(&query, self.labels.entry(query.clone()).or_insert(label)))
            .collect();
    }

    /// Writes a drawing and notifies the database.
    pub(crate) fn draw(&mut self, file: &str, text: &str) {
        self.put(file, dxf(text));
    }

    /// Writes bytes and notifies the database.
    pub(crate) fn put(&mut self, file: &str, bytes: Vec<u8>) {
        let is_new = self.system.read(file.into(), u64::MAX).is_err();
        self.system.put(file, bytes);
        self.touch(file, is_new);
    }

    pub(crate) fn remove(&mut self, file: &str) {
        self.system.remove(file.into()).unwrap();
        self.touch(file, true);
    }

    fn touch(&mut self, file: &str, is_other_name: bool) {
        let file = Utf8Path::new(file);
        self.db.touch_file(file);
        if is_other_name {
            self.db.touch_directory(file.parent().unwrap());
        }
    }

    pub(crate) fn bytes(&self, file: &str) -> Vec<u8> {
        self.system.read(file.into(), u64::MAX).unwrap()
    }

    pub(crate) fn outcome(&self, label: &str) -> Outcome {
        outcome(&self.db, self.target(label))
    }

    /// Returns the codes of a target's findings, in order.
    pub(crate) fn codes(&self, label: &str) -> Vec<String> {
        self.outcome(label).diagnostics.iter().map(|found| found.code().to_string()).collect()
    }

    /// Returns the place of a target's first finding.
    pub(crate) fn place(&self, label: &str) -> Place {
        let found = self.outcome(label).diagnostics.first().cloned().expect("there is a finding");
        locate(&self.db, found).place
    }

    fn target(&self, label: &str) -> Target {
        self.targets.iter().find(|(known, _)| *known == label).expect("the target was asked for").1
    }

    /// Queries everything again and asserts that exactly the queries in `ran` ran, and so none of `spared`. Both contain texts of the form
    /// `query label`; a query that runs for the first time has the label `new`.
    #[track_caller]
    pub(crate) fn expect(&mut self, ran: &[&str], spared: &[&str]) {
        let found = self.run_again();
        let wanted: BTreeSet<String> = ran.iter().map(|query| (*query).to_owned()).collect();
        assert_eq!(found, wanted);
        let known: BTreeSet<String> = self.labels.iter().map(|(query, label)| named(query, label)).collect();
        for query in spared {
            assert!(
                known.contains(*query),
                "{query} never runs: that it did not says nothing; there are {known:?}"
            );
            assert!(!found.contains(*query), "{query} ran");
        }
    }

    /// Queries everything again and returns the queries that ran.
    pub(crate) fn run_again(&mut self) -> BTreeSet<String> {
        self.log.lock().unwrap().clear();
        for (_, target) in &self.targets {
            outcome(&self.db, *target);
        }
        let log: Vec<String> = self.log.lock().unwrap().drain(..).collect();
        log.into_iter()
            .map(|query| named(&query, self.labels.entry(query.clone()).or_insert("new")))
            .collect()
    }
}

/// Returns the name of a query without its key, followed by the label.
fn named(query: &str, label: &str) -> String {
    format!("{} {label}", query.split('(').next().unwrap_or_default())
}
