//! The database: the system, and the inputs that stand for its files.

use std::borrow::Cow;
use std::fmt;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use camino::{Utf8Path, Utf8PathBuf};
use rustc_hash::{FxHashMap, FxHashSet};
use salsa::Setter;

use crate::db::Db;
use crate::inputs::{Directory, Role, SourceFile, Target};
use crate::listing::{Listings, PendingListing};
use crate::scratch::ScratchPool;
use crate::system::{Names, System};

/// All queries' results. Clones share them; each thread needs its own.
#[salsa::db]
#[derive(Clone)]
pub struct Database {
    shared: Arc<Shared>,
    /// Last: it must be dropped after everything that its threads could still use.
    storage: salsa::Storage<Self>,
}

/// What all clones share besides results.
struct Shared {
    system: Arc<dyn System>,
    inputs: Mutex<Inputs>,
    listings: Listings,
    /// Drawings with other bytes than their indexes were made from, some more than once.
    changed: Mutex<Vec<SourceFile>>,
    /// Those that ever did.
    drifted: Mutex<FxHashSet<SourceFile>>,
    scratch: ScratchPool,
}

/// The inputs by path. Paths are normalised, so that equal ones are equal texts, which are compared sooner than their parts.
#[derive(Default)]
struct Inputs {
    files: FxHashMap<Box<str>, SourceFile>,
    directories: FxHashMap<Box<str>, Directory>,
    targets: FxHashMap<(SourceFile, Box<str>, Role), Target>,
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
                lock(&log).push(format!("{database_key:?}"));
            }
        };
        Self::over(system, salsa::Storage::new(Some(Box::new(listener))))
    }

    fn over(system: Arc<dyn System>, storage: salsa::Storage<Self>) -> Self {
        let shared = Shared {
            system,
            inputs: Mutex::default(),
            listings: Listings::default(),
            changed: Mutex::default(),
            drifted: Mutex::default(),
            scratch: ScratchPool::default(),
        };
        Self { shared: Arc::new(shared), storage }
    }

    /// The inputs that stand for files, there or not. The paths must be normalised.
    pub fn files(&self, paths: Vec<Utf8PathBuf>) -> Vec<SourceFile> {
        let mut inputs = self.inputs();
        inputs.files.reserve(paths.len());
        paths.into_iter().map(|path| self.file_among(&mut inputs, Cow::Owned(path))).collect()
    }

    /// The input that stands for a path of a drawing in a role: the same one whenever it is asked for.
    pub fn target(&self, file: SourceFile, name: &str, role: Role) -> Target {
        let key = (file, name.into(), role);
        let new = |(file, name, role): &(SourceFile, Box<str>, Role)| {
            Target::new(self, *file, name.clone(), role.clone())
        };
        *self.inputs().targets.entry(key).or_insert_with_key(new)
    }

    /// Tells that a file may have changed, appeared or gone.
    pub fn touch_file(&mut self, path: &Utf8Path) {
        let file = self.file(path);
        self.touch(file);
    }

    fn touch(&mut self, file: SourceFile) {
        let next = file.revision(self) + 1;
        file.set_revision(self).to(next);
    }

    /// Tells that a directory may hold other names.
    pub fn touch_directory(&mut self, path: &Utf8Path) {
        let directory = self.directory(path);
        self.shared.listings.forget(directory);
        let next = directory.revision(self) + 1;
        directory.set_revision(self).to(next);
    }

    /// Raises the revision of the drawings that turned out to have other bytes than those that they were indexed by. Whether there were any:
    /// then what was asked meanwhile must be asked again.
    pub fn take_over_changes(&mut self) -> bool {
        let changed = std::mem::take(&mut *lock(&self.shared.changed));
        let has_changes = !changed.is_empty();
        lock(&self.shared.drifted).extend(&changed);
        for file in changed {
            self.touch(file);
        }
        has_changes
    }

    /// Whether a drawing turned out to have other bytes than those that it was indexed by, however long ago: what was made before that
    /// and what was made after it may be of different bytes.
    pub fn has_drifted(&self, file: SourceFile) -> bool {
        lock(&self.shared.drifted).contains(&file)
    }

    /// A directory will be listed by another thread. The query that wants its names waits for them.
    pub fn list_ahead(&self, path: &Utf8Path) -> PendingListing {
        let system = Arc::clone(&self.shared.system);
        self.shared.listings.begin(self.directory(path), path.to_owned(), system)
    }

    /// The names of files in a directory that was just listed, so that it is not listed once more when a query wants them.
    pub fn know_names(&self, path: &Utf8Path, names: Names) {
        self.shared.listings.put(self.directory(path), names);
    }

    /// What reads and writes files, for who works beside the queries.
    pub fn shared_system(&self) -> Arc<dyn System> {
        Arc::clone(&self.shared.system)
    }

    /// Drops the large values that were not used lately: what was read from drawings, what was made of single paths, programs. They are made
    /// again where they are asked for again.
    pub fn drop_unused(&mut self) {
        salsa::Database::trigger_lru_eviction(self);
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
        lock(&self.shared.inputs)
    }
}

/// What is locked is whole whenever the lock is free: nothing panics in between but an allocation that fails.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

#[salsa::db]
impl salsa::Database for Database {}

#[salsa::db]
impl Db for Database {
    fn system(&self) -> &dyn System {
        &*self.shared.system
    }

    fn file(&self, path: &Utf8Path) -> SourceFile {
        self.file_among(&mut self.inputs(), Cow::Borrowed(path))
    }

    fn directory(&self, path: &Utf8Path) -> Directory {
        let mut inputs = self.inputs();
        if let Some(directory) = inputs.directories.get(path.as_str()) {
            return *directory;
        }
        let directory = Directory::new(self, path.to_owned(), 0);
        inputs.directories.insert(path.as_str().into(), directory);
        directory
    }

    fn listed(&self, directory: Directory) -> Option<Names> {
        self.shared.listings.take(directory)
    }

    fn note_changed(&self, file: SourceFile) {
        lock(&self.shared.changed).push(file);
    }

    fn scratch(&self) -> &ScratchPool {
        &self.shared.scratch
    }
}

impl fmt::Debug for Database {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Database").field("system", &self.shared.system).finish_non_exhaustive()
    }
}
