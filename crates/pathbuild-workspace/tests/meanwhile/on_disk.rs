//! Libraries on disk, and functions that run commands on them.

use std::fmt::Write;
use std::fs;
use std::sync::Arc;
use std::time::SystemTime;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::System;
use pathbuild_db::system::OsSystem;
use pathbuild_testkit::{RandomLibrary, sheet};
use pathbuild_workspace::config::{self, Overrides};
use pathbuild_workspace::emit::{self, Emission};
use pathbuild_workspace::session::Session;
use pathbuild_workspace::{CacheHome, Inputs, SilentReporter, Workspace, check};
use tempfile::TempDir;

/// Configuration of a library for which programs are emitted.
pub(crate) const EMITTING: &str = "library = [\"lib\"]\nfeed = 100\nrapid = 1000\nsweep-height = 20\nspindle = \"manual\"\n[emit]\ntargets = [\"8*\"]\n";

/// A library on disk, with a directory for its cache.
pub(crate) struct OnDisk {
    directory: TempDir,
    caches: TempDir,
}

impl OnDisk {
    pub(crate) fn new(workshop: &RandomLibrary) -> Self {
        let place = Self { directory: TempDir::new().unwrap(), caches: TempDir::new().unwrap() };
        let rules = workshop.rules();
        let restrict: Vec<String> =
            rules.restrict.iter().map(|(parent, child)| format!("{parent}:{child}")).collect();
        let mut text = String::from(
            "library = [\"lib\"]\nfeed = 100\nrapid = 1000\nsweep-height = 20\nspindle = \"manual\"\n",
        );
        writeln!(text, "search = {:?}\nrestrict = {restrict:?}", rules.search).unwrap();
        fs::write(place.path().join("pathbuild.toml"), text).unwrap();
        fs::create_dir_all(place.path().join("spare")).unwrap();
        workshop.files().keys().for_each(|path| place.put(workshop, path));
        place
    }

    /// Creates a library of these drawings, given in text form.
    pub(crate) fn of(drawings: &[(&str, &str)]) -> Self {
        Self::configured("library = [\"lib\"]\nfeed = 100\n", drawings)
    }

    pub(crate) fn configured(configuration: &str, drawings: &[(&str, &str)]) -> Self {
        let place = Self { directory: TempDir::new().unwrap(), caches: TempDir::new().unwrap() };
        fs::write(place.path().join("pathbuild.toml"), configuration).unwrap();
        fs::create_dir(place.path().join("lib")).unwrap();
        for (file, text) in drawings {
            place.draw(file, text);
        }
        place
    }

    pub(crate) fn draw(&self, file: &str, text: &str) {
        fs::write(self.path().join(file), sheet(text).unwrap().to_dxf()).unwrap();
    }

    /// Returns the files of cached results, with their modification times and sizes.
    pub(crate) fn kept(&self) -> Vec<(Utf8PathBuf, SystemTime, u64)> {
        let directory = Utf8Path::from_path(self.caches.path()).unwrap().join("kept");
        let entries = directory.read_dir_utf8().unwrap().map(|entry| entry.unwrap().into_path());
        let results = entries.filter(|path| path.extension() == Some("results"));
        let known = |path: Utf8PathBuf| {
            let data = fs::metadata(&path).unwrap();
            (path, data.modified().unwrap(), data.len())
        };
        results.map(known).collect()
    }

    pub(crate) fn path(&self) -> &Utf8Path {
        Utf8Path::from_path(self.directory.path()).unwrap()
    }

    /// Writes a file of the random library to disk, or removes it from disk if the library no longer contains it.
    pub(crate) fn put(&self, workshop: &RandomLibrary, path: &str) {
        let on_disk = self.path().join(path);
        match workshop.files().get(path) {
            Some(bytes) => {
                fs::create_dir_all(on_disk.parent().unwrap()).unwrap();
                fs::write(on_disk, bytes).unwrap();
            }
            None => _ = fs::remove_file(on_disk),
        }
    }

    /// Checks the library. Returns the findings and the checked files, sorted and without duplicates.
    pub(crate) fn check(&self, system: Arc<dyn System>, is_kept: bool, jobs: Option<u16>) -> Vec<String> {
        self.check_of(&[], system, is_kept, jobs)
    }

    /// Like [`check`](Self::check), for these arguments; without any, for the library.
    pub(crate) fn check_of(
        &self,
        arguments: &[&str],
        system: Arc<dyn System>,
        is_kept: bool,
        jobs: Option<u16>,
    ) -> Vec<String> {
        let inputs = Inputs { inputs: arguments.iter().map(|it| (*it).to_owned()).collect() };
        let workspace = Workspace { jobs, ..self.workspace(&inputs, system, is_kept) };
        let request = check::Request { inputs: &inputs, with_all_values: false, changed: None };
        let mut session = Session::open(&workspace, workspace.caches_results());
        let checked = request.run(&mut session).unwrap();
        let found = checked.diagnostics.iter().map(|it| format!("{it:?}"));
        sorted(found.chain(checked.files.iter().map(|it| format!("{it:?}"))).collect())
    }

    /// Writes the programs that the configuration names; removes stale ones if `removes_stale`.
    pub(crate) fn emit(&self, system: Arc<dyn System>, is_kept: bool, removes_stale: bool) -> Emission {
        let inputs = Inputs::default();
        let workspace = Workspace { jobs: Some(1), ..self.workspace(&inputs, system, is_kept) };
        let request = emit::Request { removes_stale, ..emit::Request::default() };
        request.run(&mut Session::open(&workspace, workspace.caches_results()), &inputs).unwrap()
    }

    pub(crate) fn workspace(&self, inputs: &Inputs, system: Arc<dyn System>, is_kept: bool) -> Workspace {
        let given = Overrides { config: Some(self.path().join("pathbuild.toml")), ..Overrides::default() };
        let (settings, faults) = config::load(&OsSystem::shared(), &given, inputs, self.path());
        assert!(faults.is_empty(), "{faults:?}");
        let caches = Utf8PathBuf::from_path_buf(self.caches.path().join("kept")).unwrap();
        Workspace {
            settings,
            system,
            own_lang: None,
            system_lang: None,
            working_directory: Utf8PathBuf::new(),
            jobs: None,
            cache: is_kept.then_some(CacheHome::Named(caches)),
            reporter: Arc::new(SilentReporter),
            is_date_decisive: Arc::default(),
        }
    }
}

/// Returns a path with so many segments that walking along it queries the clock.
pub(crate) fn long(name: &str) -> String {
    let segments: Vec<String> = (0..300).map(|x| format!("mill {x},0 {},0\n", x + 1)).collect();
    format!("layer {name}\nstart 0,0 \"T5 O2 I1 B0 MX\"\n{}end 300,0", segments.concat())
}

/// Sorts the findings and removes duplicates.
pub(crate) fn sorted(mut found: Vec<String>) -> Vec<String> {
    found.sort();
    found.dedup();
    found
}
