//! Files that change, go or cannot be read while a check goes on, at the moments that a [`System`] chooses: what later runs find with what was
//! kept is what a run without it finds. `PATHBUILD_STEPS` says how many steps each of two libraries takes (60 without it).
//! (docs/reliability.md)

#![expect(
    clippy::unwrap_used,
    clippy::disallowed_methods,
    reason = "a test that cannot set up its files has failed"
)]

use std::fmt::Write;
use std::fs;
use std::ops::ControlFlow;
use std::rc::Rc;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::SystemTime;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_cache::Stamp;
use pathbuild_db::System;
use pathbuild_db::system::{Entry, FileKind, Listing, OsSystem, ReadError, Written};
use pathbuild_diagnostic::Value;
use pathbuild_testkit::Workshop;
use pathbuild_workspace::config::{self, Overrides};
use pathbuild_workspace::{CacheHome, Inputs, Silent, Workspace, check};
use tempfile::TempDir;

/// What happens to a file.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Event {
    /// It is removed.
    Vanish,
    /// Other bytes are written into it.
    Change,
    /// Another file, as old as it, takes its name.
    Replace,
    /// It cannot be read, this once.
    Fail,
    /// Whoever reads it shows a bug.
    Panic,
}

/// The files of the operating system, and one event: just before or after the file of a name is read, or a directory listed, for the n-th time.
#[derive(Debug)]
struct Mischief {
    trigger: String,
    countdown: AtomicU32,
    is_before: bool,
    event: Event,
    victim: Utf8PathBuf,
    bytes: Vec<u8>,
}

impl Mischief {
    /// Runs what reads a path; whether it must fail.
    fn around<T>(
        &self,
        path: &Utf8Path,
        read: impl FnOnce() -> Result<T, ReadError>,
    ) -> Result<T, ReadError> {
        let is_now =
            path.as_str().ends_with(&self.trigger) && self.countdown.fetch_sub(1, Ordering::SeqCst) == 1;
        match (is_now, self.is_before) {
            (false, _) => read(),
            (true, true) => {
                self.happen();
                read()
            }
            (true, false) if self.event == Event::Fail => Err(ReadError::Other("too many open files".into())),
            (true, false) => {
                let result = read();
                self.happen();
                result
            }
        }
    }

    fn happen(&self) {
        match self.event {
            Event::Vanish => _ = fs::remove_file(&self.victim),
            Event::Change => _ = fs::write(&self.victim, &self.bytes),
            Event::Replace => {
                let modified = fs::metadata(&self.victim).and_then(|data| data.modified());
                let beside = self.victim.with_extension("new");
                fs::write(&beside, &self.bytes).unwrap();
                if let Ok(modified) = modified {
                    fs::File::options().write(true).open(&beside).unwrap().set_modified(modified).unwrap();
                }
                fs::rename(beside, &self.victim).unwrap();
            }
            Event::Fail => {}
            Event::Panic => panic!("a bug that {} shows", self.victim),
        }
    }
}

impl System for Mischief {
    fn read(&self, path: &Utf8Path, limit: u64) -> Result<Vec<u8>, ReadError> {
        self.around(path, || OsSystem.read(path, limit))
    }

    fn read_stamped<'r>(
        &self,
        path: &Utf8Path,
        limit: u64,
        room: &'r mut Vec<u8>,
    ) -> Result<(&'r [u8], Stamp), ReadError> {
        self.around(path, || OsSystem.read_stamped(path, limit, room))
    }

    fn head(&self, path: &Utf8Path, length: usize) -> Result<Vec<u8>, ReadError> {
        OsSystem.head(path, length)
    }

    fn modified(&self, path: &Utf8Path) -> Option<SystemTime> {
        OsSystem.modified(path)
    }

    fn list(&self, directory: &Utf8Path) -> Result<Listing, ReadError> {
        self.around(directory, || OsSystem.list(directory))
    }

    fn each_entry(
        &self,
        directory: &Utf8Path,
        take: &mut dyn FnMut(Entry<'_>) -> ControlFlow<()>,
    ) -> Result<(), ReadError> {
        self.around(directory, || OsSystem.each_entry(directory, take))
    }

    fn kind(&self, path: &Utf8Path) -> FileKind {
        OsSystem.kind(path)
    }

    fn canonical(&self, path: &Utf8Path) -> Utf8PathBuf {
        OsSystem.canonical(path)
    }

    fn write(&self, path: &Utf8Path, bytes: &[u8]) -> Result<Written, Value> {
        OsSystem.write(path, bytes)
    }

    fn remove(&self, path: &Utf8Path) -> Result<(), Value> {
        OsSystem.remove(path)
    }
}

/// Numbers without a pattern, the same in every run (xorshift).
struct Chance(u64);

impl Chance {
    fn below(&mut self, bound: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        usize::try_from(self.0 % bound as u64).unwrap()
    }

    fn pick<'t, T>(&mut self, all: &'t [T]) -> &'t T {
        &all[self.below(all.len())]
    }
}

/// A library on disk, with a place for what is kept of it.
struct OnDisk {
    directory: TempDir,
    caches: TempDir,
}

impl OnDisk {
    fn new(workshop: &Workshop) -> Self {
        let place = Self { directory: TempDir::new().unwrap(), caches: TempDir::new().unwrap() };
        let rules = workshop.rules();
        let restrict: Vec<String> =
            rules.restrict.iter().map(|(parent, child)| format!("{parent}:{child}")).collect();
        let mut text = String::from("library = [\"lib\"]\nfeed = 100\n");
        writeln!(text, "search = {:?}\nrestrict = {restrict:?}", rules.search).unwrap();
        fs::write(place.path().join("pathbuild.toml"), text).unwrap();
        fs::create_dir_all(place.path().join("spare")).unwrap();
        workshop.files().keys().for_each(|path| place.put(workshop, path));
        place
    }

    fn path(&self) -> &Utf8Path {
        Utf8Path::from_path(self.directory.path()).unwrap()
    }

    /// Makes a file what the library says it is.
    fn put(&self, workshop: &Workshop, path: &str) {
        let on_disk = self.path().join(path);
        match workshop.files().get(path) {
            Some(bytes) => {
                fs::create_dir_all(on_disk.parent().unwrap()).unwrap();
                fs::write(on_disk, bytes).unwrap();
            }
            None => _ = fs::remove_file(on_disk),
        }
    }

    /// What a check of the library finds, each once, in order.
    fn check(&self, system: Arc<dyn System>, is_kept: bool, jobs: Option<u16>) -> Vec<String> {
        let given = Overrides { config: Some(self.path().join("pathbuild.toml")), ..Overrides::default() };
        let inputs = Inputs::default();
        let (settings, faults) = config::load(&OsSystem::shared(), &given, &inputs, self.path());
        assert!(faults.is_empty(), "{faults:?}");
        let caches = Utf8PathBuf::from_path_buf(self.caches.path().join("kept")).unwrap();
        let workspace = Workspace {
            settings,
            system,
            own_lang: None,
            working_directory: Utf8PathBuf::new(),
            jobs,
            cache: is_kept.then_some(CacheHome::Named(caches)),
            reporter: Rc::new(Silent),
        };
        let request = check::Request { inputs: &inputs, with_all_values: false, changed: None };
        let mut session = request.session(&workspace);
        let checked = request.run(&mut session).unwrap();
        let mut found: Vec<String> = checked.diagnostics.iter().map(|it| format!("{it:?}")).collect();
        found.extend(checked.files.iter().map(|it| format!("{it:?}")));
        found.sort();
        found.dedup();
        found
    }
}

fn steps() -> usize {
    std::env::var("PATHBUILD_STEPS").map_or(60, |steps| steps.parse().unwrap())
}

/// One library, step by step: an edit, a run in which something happens, and then two runs that must find the same.
fn library(seed: u64) {
    let mut workshop = Workshop::new(seed);
    let place = OnDisk::new(&workshop);
    let mut chance = Chance(0x9e37_79b9_7f4a_7c15 ^ seed);
    let mut spoilt: Option<String> = None;
    for step in 0..steps() {
        // What happened is put right again, or left, so that both ways are tried.
        for path in workshop.edit().into_iter().chain(spoilt.take()) {
            place.put(&workshop, &path);
        }
        let files: Vec<String> = workshop.files().keys().cloned().collect();
        let victim = chance.pick(&files).clone();
        let trigger = match chance.below(3) {
            0 => victim.clone(),
            1 => chance.pick(&["lib", "lib/parts", "lib/projects", "spare"]).to_string(),
            _ => chance.pick(&files).clone(),
        };
        let mischief = Mischief {
            trigger,
            countdown: AtomicU32::new(1 + u32::try_from(chance.below(3)).unwrap()),
            is_before: chance.below(2) == 0,
            event: *chance.pick(&[Event::Vanish, Event::Change, Event::Replace, Event::Fail]),
            victim: place.path().join(&victim),
            bytes: workshop.files()[chance.pick(&files)].clone(),
        };
        let said = format!("library {seed}, step {step}: {mischief:?}");
        let jobs = [None, Some(1)][chance.below(2)];
        place.check(Arc::new(mischief), true, jobs);
        if chance.below(2) == 0 {
            place.put(&workshop, &victim);
        } else {
            spoilt = Some(victim);
        }
        let expected = place.check(Arc::new(OsSystem), false, None);
        for jobs in [None, Some(1)] {
            let kept = place.check(Arc::new(OsSystem), true, jobs);
            let differing = kept.iter().zip(&expected).find(|(kept, expected)| kept != expected);
            assert!(kept == expected, "{said}\n{differing:#?}\n{} and {}", kept.len(), expected.len());
        }
    }
}

#[test]
fn nothing_wrong_is_kept_of_a_library_that_changes_meanwhile() {
    library(1);
}

#[test]
fn nothing_wrong_is_kept_of_another() {
    library(2);
}

/// A bug that one drawing shows is said of that drawing; all others are checked, and nothing of it is kept.
#[test]
fn a_bug_in_one_drawing_keeps_no_other_from_being_checked() {
    let workshop = Workshop::new(3);
    for victim in workshop.files().keys().filter(|path| Utf8Path::new(path).extension() == Some("dxf")) {
        for jobs in [None, Some(1)] {
            // Nothing is kept yet: every drawing is read.
            let place = OnDisk::new(&workshop);
            let expected = place.check(Arc::new(OsSystem), false, None);
            let bug = Mischief {
                trigger: victim.clone(),
                countdown: AtomicU32::new(1),
                is_before: true,
                event: Event::Panic,
                victim: place.path().join(victim),
                bytes: Vec::new(),
            };
            let found = place.check(Arc::new(bug), true, jobs);
            let is_of_victim = |found: &&String| found.contains(victim.as_str());
            let said = found.iter().filter(|found| found.contains("a bug that")).collect::<Vec<_>>();
            assert!(!said.is_empty() && said.iter().all(is_of_victim), "{victim}: {found:#?}");
            let files = |found: &[String]| found.iter().filter(|it| it.starts_with('"')).count();
            assert_eq!(files(&found), files(&expected), "{victim}: all drawings are checked");
            assert_eq!(place.check(Arc::new(OsSystem), true, jobs), expected, "{victim}");
        }
    }
}

/// The same of a directory that cannot be listed for a bug.
#[test]
fn a_bug_in_listing_a_directory_keeps_no_other_from_being_checked() {
    let workshop = Workshop::new(3);
    for victim in ["lib/parts", "lib/projects"] {
        for jobs in [None, Some(1)] {
            let place = OnDisk::new(&workshop);
            let expected = place.check(Arc::new(OsSystem), false, None);
            let bug = Mischief {
                trigger: victim.to_owned(),
                countdown: AtomicU32::new(1),
                is_before: true,
                event: Event::Panic,
                victim: place.path().join(victim),
                bytes: Vec::new(),
            };
            let found = place.check(Arc::new(bug), true, jobs);
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
