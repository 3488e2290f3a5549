//! The database: its interface for queries, the results of all queries, the system, the inputs that stand for files, directories that are
//! listed ahead of their queries, and the scratch buffers for drawings. Work on one target is guarded by a time limit and a panic handler,
//! so that one target cannot stop the others.

use std::any::Any;
use std::borrow::Cow;
use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::limits::{TIME_OF_PATH, limit_error, seconds};
use pathbuild_diagnostic::messages::files as messages;
use pathbuild_diagnostic::{Diagnostic, Value};
use pathbuild_dxf::Drawing;
use rustc_hash::{FxHashMap, FxHashSet};
use salsa::{CancellationToken, Cancelled, Database as _, Setter};

use crate::inputs::{Directory, Role, SourceFile, Target};
use crate::system::{Names, System};

/// The interface of queries to the database.
#[salsa::db]
pub trait Db: salsa::Database {
    /// The file system and the clock.
    fn system(&self) -> &dyn System;

    /// Returns the input of a file, which need not exist. The path must be normalised.
    fn file(&self, path: &Utf8Path) -> SourceFile;

    /// Returns the input of a directory, which need not exist. The path must be normalised.
    fn directory(&self, path: &Utf8Path) -> Directory;

    /// Returns the names in a directory that was listed in advance, and waits for a listing in progress. `None` if no listing was started,
    /// or if it failed.
    fn take_listing(&self, directory: Directory) -> Option<Names>;

    /// Records that a file's bytes no longer match its index.
    fn note_changed(&self, file: SourceFile);

    /// Scratch buffers for reading drawings.
    fn scratch(&self) -> &ScratchPool;
}

/// The results of all queries. Clones share them; each thread needs its own clone.
#[salsa::db]
#[derive(Clone)]
pub struct Database {
    shared: Arc<SharedState>,
    /// Declared last, so that it is dropped last: its drop tells threads that wait for exclusive access that this clone is gone.
    storage: salsa::Storage<Self>,
}

/// State shared by all clones besides query results.
struct SharedState {
    system: Arc<dyn System>,
    inputs: Mutex<Inputs>,
    listings: Listings,
    /// Drawings found not to match their indexes since the last [`Database::apply_noted_changes`]; may contain duplicates.
    changed: Mutex<Vec<SourceFile>>,
    /// All drawings that ever changed after they were indexed.
    drifted: Mutex<FxHashSet<SourceFile>>,
    scratch: ScratchPool,
}

/// The inputs by path. Paths are normalised, so they can be compared as plain strings, which is faster than by components.
#[derive(Default)]
struct Inputs {
    files: FxHashMap<Box<str>, SourceFile>,
    directories: FxHashMap<Box<str>, Directory>,
    targets: FxHashMap<(SourceFile, Box<str>, Role), Target>,
}

impl Database {
    /// Creates a database. [`Settings`](crate::Settings) must be set before the first query.
    pub fn new(system: Arc<dyn System>) -> Self {
        Self::with_storage(system, salsa::Storage::default())
    }

    /// Creates a database that logs the name of each query function before it executes, for tests.
    pub fn with_log(system: Arc<dyn System>, log: Arc<Mutex<Vec<String>>>) -> Self {
        let listener = move |event: salsa::Event| {
            if let salsa::EventKind::WillExecute { database_key } = event.kind {
                lock(&log).push(format!("{database_key:?}"));
            }
        };
        Self::with_storage(system, salsa::Storage::new(Some(Box::new(listener))))
    }

    fn with_storage(system: Arc<dyn System>, storage: salsa::Storage<Self>) -> Self {
        let shared = SharedState {
            system,
            inputs: Mutex::default(),
            listings: Listings::default(),
            changed: Mutex::default(),
            drifted: Mutex::default(),
            scratch: ScratchPool::default(),
        };
        Self { shared: Arc::new(shared), storage }
    }

    /// Returns the inputs of these files, which need not exist. The paths must be normalised.
    pub fn files(&self, paths: Vec<Utf8PathBuf>) -> Vec<SourceFile> {
        let mut inputs = self.inputs();
        inputs.files.reserve(paths.len());
        paths.into_iter().map(|path| self.intern_file(&mut inputs, Cow::Owned(path))).collect()
    }

    /// Returns the input for a path of a drawing in a role. The same arguments always give the same input.
    pub fn target(&self, file: SourceFile, name: &str, role: Role) -> Target {
        let key = (file, name.into(), role);
        let new = |(file, name, role): &(SourceFile, Box<str>, Role)| {
            Target::new(self, *file, name.clone(), role.clone())
        };
        *self.inputs().targets.entry(key).or_insert_with_key(new)
    }

    /// Marks a file as possibly changed, created or removed.
    pub fn touch_file(&mut self, path: &Utf8Path) {
        let file = self.file(path);
        self.touch(file);
    }

    fn touch(&mut self, file: SourceFile) {
        let next = file.revision(self) + 1;
        file.set_revision(self).to(next);
    }

    /// Marks the names in a directory as possibly changed.
    pub fn touch_directory(&mut self, path: &Utf8Path) {
        let directory = self.directory(path);
        self.shared.listings.forget(directory);
        let next = directory.revision(self) + 1;
        directory.set_revision(self).to(next);
    }

    /// Starts a new revision for drawings that no longer match their indexes. Returns whether there were any; if so, earlier results must
    /// be queried again.
    pub fn apply_noted_changes(&mut self) -> bool {
        let changed = std::mem::take(&mut *lock(&self.shared.changed));
        let has_changes = !changed.is_empty();
        lock(&self.shared.drifted).extend(&changed);
        for file in changed {
            self.touch(file);
        }
        has_changes
    }

    /// Whether the bytes of a drawing ever changed after it was indexed. Results from before and after the change may have been computed from
    /// different bytes.
    pub fn has_drifted(&self, file: SourceFile) -> bool {
        lock(&self.shared.drifted).contains(&file)
    }

    /// Announces that another thread will list a directory. The query for its names waits for that listing.
    pub fn list_ahead(&self, path: &Utf8Path) -> PendingListing {
        let system = Arc::clone(&self.shared.system);
        self.shared.listings.begin(self.directory(path), path.to_owned(), system)
    }

    /// Provides the names in a directory that was just listed, so that the query need not list it again.
    pub fn provide_names(&self, path: &Utf8Path, names: Names) {
        self.shared.listings.put(self.directory(path), names);
    }

    /// The system, for code that runs outside of queries.
    pub fn shared_system(&self) -> Arc<dyn System> {
        Arc::clone(&self.shared.system)
    }

    /// Evicts large values that were not used recently: parsed drawings, single paths, programs. They are recomputed on demand.
    pub fn drop_unused(&mut self) {
        salsa::Database::trigger_lru_eviction(self);
    }

    fn intern_file(&self, inputs: &mut Inputs, path: Cow<'_, Utf8Path>) -> SourceFile {
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

/// Locks a mutex and ignores poisoning: only a failed allocation can panic while it is held, and the data stays consistent.
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
        self.intern_file(&mut self.inputs(), Cow::Borrowed(path))
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

    fn take_listing(&self, directory: Directory) -> Option<Names> {
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

/// Records that a drawing has changed and abandons the query.
pub(crate) fn abandon_query(db: &dyn Db, file: SourceFile) -> ! {
    db.note_changed(file);
    // `resume_unwind` bypasses the panic hook, since this is not a bug.
    resume_unwind(Box::new(DriftPanic))
}

/// Work in progress on one handle of the database.
#[derive(Debug)]
pub struct WorkInProgress {
    /// Start time; `None` without a clock.
    begun: Option<Instant>,
    token: CancellationToken,
}

impl WorkInProgress {
    /// Cancels the work if it has taken longer than this limit.
    pub fn stop_after(&self, limit: Duration) {
        if self.begun.is_some_and(|begun| begun.elapsed() > limit) {
            self.token.cancel();
        }
    }
}

impl Database {
    /// Clears a cancellation that arrived after its work had ended, so that it does not cancel the next query.
    pub fn clear_cancellation(&self) {
        // Salsa clears it at the end of every outermost query.
        self.attach(|_| ());
    }

    /// Unwinds if the current work was cancelled because it exceeded its time limit. Called between queries, which check this themselves.
    pub fn check_time_limit(&self) {
        self.unwind_if_revision_cancelled();
    }

    /// Starts the clock for work on this handle.
    pub fn begin_work(&self) -> WorkInProgress {
        WorkInProgress { begun: self.system().now(), token: self.cancellation_token() }
    }

    /// Runs work on this handle. `limit` is only quoted in PB005; [`WorkInProgress::stop_after`] enforces it. `work` runs again if a query that it
    /// waited for panicked on another thread.
    ///
    /// # Errors
    /// PB005 if the work exceeded the time limit, PB001 if a drawing changed meanwhile, PB006 if the work panicked; all without a place.
    pub fn run_guarded<R>(&self, limit: Duration, work: impl Fn() -> R) -> Result<R, Box<Diagnostic>> {
        loop {
            let payload = match catch_unwind(AssertUnwindSafe(&work)) {
                Ok(result) => return Ok(result),
                Err(payload) => payload,
            };
            let problem = match payload.downcast_ref::<Cancelled>() {
                // The query panicked on another thread. Running it here gives the reason, if it panics again.
                Some(Cancelled::PropagatedPanic) => continue,
                Some(_) => time_limit_error(limit),
                None if payload.is::<DriftPanic>() => Diagnostic::new(&messages::CHANGES_WHILE_READ),
                None if payload.is::<TimeoutPanic>() => time_limit_error(limit),
                None => internal_error(&*payload),
            };
            return Err(Box::new(problem));
        }
    }
}

/// Buffers for reading one drawing, reused for the next.
#[derive(Default)]
pub(crate) struct Scratch {
    pub(crate) bytes: Vec<u8>,
    pub(crate) drawing: Drawing,
}

/// Scratch buffers that are not in use.
#[derive(Default)]
pub struct ScratchPool(Mutex<Vec<Scratch>>);

/// Size in bytes up to which a buffer is kept for reuse. Few drawings need more.
const MAX_BUFFER_BYTES: usize = 1 << 20;
/// Number of entities for which a buffer that is kept for reuse may have room.
const MAX_BUFFER_ENTITIES: usize = 1 << 12;

impl ScratchPool {
    /// Calls `work` with a scratch buffer, which still holds the content of an earlier drawing.
    pub(crate) fn with<R>(&self, work: impl FnOnce(&mut Scratch) -> R) -> R {
        let mut scratch = self.unused_buffers().pop().unwrap_or_default();
        let result = work(&mut scratch);
        if scratch.bytes.len() <= MAX_BUFFER_BYTES
            && scratch.drawing.entities.capacity() <= MAX_BUFFER_ENTITIES
        {
            self.unused_buffers().push(scratch);
        }
        result
    }

    fn unused_buffers(&self) -> MutexGuard<'_, Vec<Scratch>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl fmt::Debug for ScratchPool {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ScratchPool").finish_non_exhaustive()
    }
}

/// Listings that no query has taken yet.
#[derive(Debug, Default)]
pub(crate) struct Listings(Mutex<FxHashMap<Directory, ListingState>>);

#[derive(Debug)]
enum ListingState {
    Known(Names),
    /// The listing is in progress on another thread. The channel closes without names if the listing fails or never runs.
    Pending(Receiver<Names>),
}

/// A listing to run on any thread. If it is dropped, the query lists the directory itself.
pub struct PendingListing {
    system: Arc<dyn System>,
    path: Utf8PathBuf,
    names: Sender<Names>,
}

impl PendingListing {
    /// Lists the directory. A panic is ignored here, since it would end the run: the query then lists the directory itself.
    pub fn run(self) {
        if let Ok(Ok(listing)) = catch_bugs(|| self.system.list(&self.path)) {
            // Sending fails if the directory has changed since and the listing was discarded.
            _ = self.names.send(listing.files);
        }
    }
}

impl fmt::Debug for PendingListing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("PendingListing").field("path", &self.path).finish_non_exhaustive()
    }
}

impl Listings {
    /// Registers a listing in progress.
    pub(crate) fn begin(
        &self,
        directory: Directory,
        path: Utf8PathBuf,
        system: Arc<dyn System>,
    ) -> PendingListing {
        let (names, pending) = channel();
        self.states().insert(directory, ListingState::Pending(pending));
        PendingListing { system, path, names }
    }

    pub(crate) fn put(&self, directory: Directory, names: Names) {
        self.states().entry(directory).or_insert(ListingState::Known(names));
    }

    /// Discards the listing of a directory that has changed.
    pub(crate) fn forget(&self, directory: Directory) {
        self.states().remove(&directory);
    }

    /// Returns and removes the names in a directory; waits for a listing in progress.
    pub(crate) fn take(&self, directory: Directory) -> Option<Names> {
        let state = self.states().remove(&directory)?;
        match state {
            ListingState::Known(names) => Some(names),
            ListingState::Pending(names) => names.recv().ok(),
        }
    }

    fn states(&self) -> MutexGuard<'_, FxHashMap<Directory, ListingState>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

// Reasons why a query ends without a result: bugs, time limits, and drawings that change during a run.

/// Panic payload of work that exceeded this time limit.
pub(crate) struct TimeoutPanic(pub(crate) Duration);

/// Runs work that usually makes no queries. If a query in it unwinds because its drawing has changed, that is reported as a bug. Cancellation is
/// passed on.
///
/// # Errors
/// PB006 if the work panicked, PB005 if it exceeded its time limit; both without a place.
pub fn catch_bugs<R>(work: impl FnOnce() -> R) -> Result<R, Box<Diagnostic>> {
    catch_unwind(AssertUnwindSafe(work)).map_err(|payload| {
        if payload.is::<Cancelled>() {
            resume_unwind(payload);
        }
        let too_long = payload.downcast_ref().map(|TimeoutPanic(limit)| time_limit_error(*limit));
        Box::new(too_long.unwrap_or_else(|| internal_error(&*payload)))
    })
}

/// Returns PB006 with the message of a panic.
pub(crate) fn internal_error(payload: &(dyn Any + Send)) -> Diagnostic {
    let text = payload.downcast_ref::<&str>().map(|text| (*text).to_owned());
    let reason = text.or_else(|| payload.downcast_ref::<String>().cloned()).unwrap_or_default();
    bug(&reason)
}

/// Returns PB006 with this reason, without a place.
pub fn bug(reason: &str) -> Diagnostic {
    Diagnostic::new(&messages::INTERNAL).with("reason", Value::foreign(reason))
}

/// Panic payload of a query that read other bytes than those from which its drawing was indexed. No result may mix old and new bytes.
pub(crate) struct DriftPanic;

/// Returns PB005 for work that exceeded this time limit, without a place.
pub fn time_limit_error(limit: Duration) -> Diagnostic {
    limit_error(&TIME_OF_PATH, seconds(limit), "seconds-per-path")
}
