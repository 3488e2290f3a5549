//! The database: the system, and the inputs that stand for its files.

use std::borrow::Cow;
use std::fmt;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use camino::{Utf8Path, Utf8PathBuf};
use rustc_hash::FxHashMap;
use salsa::Setter;

use crate::arrivals::{Arrivals, Lister};
use crate::inputs::{Directory, Insight, SourceFile};
use crate::queries;
use crate::settings::Settings;
use crate::system::{Names, System};

/// What queries may ask besides each other.
#[salsa::db]
pub trait Db: salsa::Database {
    /// The outside world.
    fn system(&self) -> &dyn System;

    /// The input that stands for a file, there or not. The path must be normalised.
    fn file(&self, path: &Utf8Path) -> SourceFile;

    /// The input that stands for a directory, there or not. The path must be normalised.
    fn directory(&self, path: &Utf8Path) -> Directory;

    /// Whether drawings are surveyed: [`Database::survey_drawings`].
    fn is_surveying(&self) -> bool;

    /// Whether paths are kept: [`Database::keep_paths`].
    fn keeps_paths(&self) -> bool;

    /// Directories that are being listed.
    fn arrivals(&self) -> &Arrivals;
}

/// All queries' results. Clones share them; each thread needs its own.
#[salsa::db]
#[derive(Clone)]
pub struct Database {
    system: Arc<dyn System>,
    inputs: Arc<Mutex<Inputs>>,
    is_surveying: bool,
    keeps_paths: bool,
    arrivals: Arc<Arrivals>,
    /// Last: it must be dropped after everything that its threads could still use.
    storage: salsa::Storage<Self>,
}

/// The inputs by path. Paths are normalised, so that equal ones are equal texts, which are compared sooner than their parts.
#[derive(Default)]
struct Inputs {
    files: FxHashMap<Box<str>, SourceFile>,
    directories: FxHashMap<Box<str>, Directory>,
}

impl Database {
    /// A database without settings: [`Settings`](crate::Settings) must be made before the first query.
    pub fn new(system: Arc<dyn System>) -> Self {
        Self::over(system, salsa::Storage::default())
    }

    /// A database that tells which queries run, for tests: the name of each query function as it is about to execute.
    pub fn with_log(system: Arc<dyn System>, log: Arc<Mutex<Vec<String>>>) -> Self {
        let listener = move |event: salsa::Event| {
            if let salsa::EventKind::WillExecute { database_key } = event.kind {
                log.lock().unwrap_or_else(PoisonError::into_inner).push(format!("{database_key:?}"));
            }
        };
        Self::over(system, salsa::Storage::new(Some(Box::new(listener))))
    }

    fn over(system: Arc<dyn System>, storage: salsa::Storage<Self>) -> Self {
        Self {
            system,
            inputs: Arc::default(),
            arrivals: Arc::default(),
            is_surveying: false,
            keeps_paths: false,
            storage,
        }
    }

    /// The directories in which paths were looked for, in order.
    pub fn directories(&self) -> Vec<Directory> {
        let inputs = self.inputs();
        let mut known: Vec<(&Utf8Path, &Directory)> =
            inputs.directories.iter().map(|(path, directory)| (Utf8Path::new(path), directory)).collect();
        known.sort_by_key(|(path, _)| *path);
        known.into_iter().map(|(_, directory)| *directory).collect()
    }

    /// The inputs that stand for files, there or not. The paths must be normalised.
    pub fn files(&self, paths: Vec<Utf8PathBuf>) -> Vec<SourceFile> {
        let mut inputs = self.inputs();
        inputs.files.reserve(paths.len());
        paths.into_iter().map(|path| self.file_among(&mut inputs, Cow::Owned(path))).collect()
    }

    /// Tells that a file may have changed, appeared or gone.
    pub fn touch_file(&mut self, path: &Utf8Path) {
        let file = self.file(path);
        let next = file.revision(self) + 1;
        file.set_revision(self).to(next);
    }

    /// Tells that a directory may hold other names.
    pub fn touch_directory(&mut self, path: &Utf8Path) {
        let directory = self.directory(path);
        let next = directory.revision(self) + 1;
        directory.set_revision(self).to(next);
    }

    /// From now on where paths are in a directory is guessed by the names of paths alone, while another thread lists it.
    pub fn begin_guessing(&mut self, path: &Utf8Path) -> Lister {
        let directory = self.set_insight(path, Insight::Unlisted);
        self.arrivals.begin(directory, Settings::get(self).lookup(self).file_pattern.clone());
        Lister {
            system: Arc::clone(&self.system),
            arrivals: Arc::clone(&self.arrivals),
            directory,
            path: path.to_owned(),
        }
    }

    /// The names of files in a directory that somebody listed already, so that it is not listed once more when they are first wanted. For runs that
    /// nobody tells when they change.
    pub fn know_names(&self, path: &Utf8Path, names: Names) {
        let pattern = Settings::get(self).lookup(self).file_pattern.clone();
        self.arrivals.put(self.directory(path), pattern, names);
    }

    /// How much is known of the names in a directory. What was found by knowing less is asked again.
    pub fn set_insight(&mut self, path: &Utf8Path, insight: Insight) -> Directory {
        let directory = self.directory(path);
        directory.set_insight(self).to(insight);
        directory
    }

    /// From now on large values that can be made again are dropped when [`Self::drop_large`] says so: what was read from drawings, and what
    /// was made of single paths. What others ask of them stays. For runs that go through a library once; where drawings change, a value that
    /// is made again could be that of a file as nobody has told it is.
    pub fn bound_memory(&mut self) {
        queries::bound(self, 1);
    }

    /// Drops the large values, where memory is bounded.
    pub fn drop_large(&mut self) {
        salsa::Database::trigger_lru_eviction(self);
    }

    /// From now on paths are kept as they were bound and walked along to judge them: for runs that make programs of them. Before the first query.
    pub fn keep_paths(&mut self) {
        self.keeps_paths = true;
    }

    /// From now on all that is asked of a drawing is found when it is first read, and its content is dropped then: for runs that go through a
    /// library once. Nothing that is found differs. After an edit more is found anew than would have to be.
    pub fn survey_drawings(&mut self) {
        self.is_surveying = true;
    }

    fn file_among(&self, inputs: &mut Inputs, path: Cow<'_, Utf8Path>) -> SourceFile {
        if let Some(file) = inputs.files.get(path.as_str()) {
            return *file;
        }
        let text = path.as_str().into();
        let file = SourceFile::new(self, path.into_owned(), 0);
        inputs.files.insert(text, file);
        file
    }

    fn inputs(&self) -> MutexGuard<'_, Inputs> {
        // Nothing panics while holding the lock but an allocation that fails, after which the maps are still whole.
        self.inputs.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[salsa::db]
impl salsa::Database for Database {}

#[salsa::db]
impl Db for Database {
    fn system(&self) -> &dyn System {
        &*self.system
    }

    fn file(&self, path: &Utf8Path) -> SourceFile {
        self.file_among(&mut self.inputs(), Cow::Borrowed(path))
    }

    fn directory(&self, path: &Utf8Path) -> Directory {
        let mut inputs = self.inputs();
        if let Some(directory) = inputs.directories.get(path.as_str()) {
            return *directory;
        }
        let directory = Directory::new(self, path.to_owned(), 0, Insight::Listed);
        inputs.directories.insert(path.as_str().into(), directory);
        directory
    }

    fn is_surveying(&self) -> bool {
        self.is_surveying
    }

    fn keeps_paths(&self) -> bool {
        self.keeps_paths
    }

    fn arrivals(&self) -> &Arrivals {
        &self.arrivals
    }
}

impl fmt::Debug for Database {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Database").field("system", &self.system).finish_non_exhaustive()
    }
}
