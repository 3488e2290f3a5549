//! Collects changes on disk in batches. Events are debounced, and drawings that a CAD program is still writing are held back for a later batch.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::{Duration, Instant};

use camino::{Utf8Path, Utf8PathBuf};
use notify::event::{AccessKind, AccessMode, EventKind};
use notify::{Config, Event, PollWatcher, RecommendedWatcher, Watcher as _};
use pathbuild_db::system::{FileSystemTime, Stamp, is_drawing};
use pathbuild_db::{Db, SourceFile, System, content};

use super::directories::{EventPath, WatchedDirectories, event_path};
use super::events::{Changes, Request, Restart, Signal, WakeHandle};
use super::library::Library;
use crate::session::{Session, is_ignore_file};

/// A watcher of a library's directories, which collects changes in batches.
pub(super) struct Watcher {
    signals: Receiver<Signal>,
    pub(super) wake_handle: WakeHandle,
    source: Box<dyn notify::Watcher>,
    debounce: Duration,
    /// The files of the configuration and of the post-processor, and the baseline, as the paths that events report.
    configuration: BTreeSet<Utf8PathBuf>,
    directories: WatchedDirectories,
    /// Path of the working directory at the start; `None` if no watched path is relative.
    working_directory: Option<Utf8PathBuf>,
    /// Time at which to check again that the working directory still has this path.
    next_directory_check: Instant,
    system: Arc<dyn System>,
    /// Changes that arrived while a batch was processed.
    pending: Changes,
    /// Time at which the pending changes are due, if no more arrive.
    due: Instant,
    /// Whether a wake-up was requested and not yet handled.
    is_woken: bool,
    /// Whether the end of watching was requested.
    is_over: bool,
    /// Time of the next check of the configuration and of the known files while polling; `None` if the system reports all changes.
    next_poll: Option<Instant>,
    polled: PolledFiles,
    /// Incomplete drawings, each with the time after which it is read although it is incomplete.
    unfinished: BTreeMap<Utf8PathBuf, Instant>,
}

/// The outcome of waiting for changes.
pub(super) enum WaitOutcome {
    Changes(Changes),
    Restart(Restart),
    /// A change of the configuration may not have been reported.
    ConfigurationInDoubt,
    /// A wake-up was requested through the [`WakeHandle`].
    WokenUp,
    /// The end of watching was requested.
    Over,
}

/// Interval at which directories are polled if that is requested, as for network drives.
const POLL_INTERVAL: Duration = Duration::from_secs(1);

/// Interval at which the configuration and the known files are checked while polling. [`PollWatcher`] does not suffice: it compares modification
/// times in whole seconds, so it misses a further change within the same second. Slightly longer than a second, to be on the safe side.
const POLL_RESOLUTION: Duration = Duration::from_millis(1100);

/// Interval at which the path of the working directory is checked.
const DIRECTORY_CHECK_INTERVAL: Duration = Duration::from_secs(1);

/// Time to wait for an incomplete drawing after its last change. Some programs never write the end marker.
const INCOMPLETE_DRAWING_TIMEOUT: Duration = Duration::from_secs(2);

/// Interval at which incomplete drawings are checked.
const INCOMPLETE_DRAWING_INTERVAL: Duration = Duration::from_millis(50);

impl Watcher {
    /// Starts watching. `post` lists the files that make up the post-processor, and the baseline.
    pub(super) fn new(
        session: &Session<'_>,
        request: &Request<'_>,
        post: &[Utf8PathBuf],
    ) -> notify::Result<Self> {
        let workspace = session.workspace();
        let settings = &workspace.settings;
        let (sender, signals) = channel();
        let wake_handle = WakeHandle(sender.clone());
        let tell = move |event| _ = sender.send(Signal::Changed(event));
        let is_polling = request.polls || settings.watch.poll.value;
        let mut watcher: Box<dyn notify::Watcher> = if is_polling {
            Box::new(PollWatcher::new(tell, Config::default().with_poll_interval(POLL_INTERVAL))?)
        } else {
            Box::new(RecommendedWatcher::new(tell, Config::default())?)
        };
        let mut directories = WatchedDirectories::new(session, request, post);
        directories.watch(&mut *watcher, &*workspace.system)?;
        let configuration = settings.file.iter().chain(post).map(|file| event_path(session, file));
        let configuration: BTreeSet<Utf8PathBuf> = configuration.collect();
        // Best effort: a link among the configuration's files may be dangling, like a link among the drawings.
        _ = directories.follow(&mut *watcher, session, configuration.iter().cloned());
        Ok(Self {
            signals,
            wake_handle,
            source: watcher,
            debounce: settings.watch.debounce.value,
            working_directory: (directories.are_relative()
                || configuration.iter().any(|file| file.is_relative()))
            .then(|| current_directory(&*workspace.system)),
            next_directory_check: Instant::now() + DIRECTORY_CHECK_INTERVAL,
            next_poll: is_polling.then(|| Instant::now() + POLL_RESOLUTION),
            polled: PolledFiles::default(),
            configuration,
            directories,
            pending: Changes::default(),
            due: Instant::now(),
            is_woken: false,
            is_over: false,
            system: Arc::clone(&workspace.system),
            unfinished: BTreeMap::new(),
        })
    }

    /// Watches the targets of those files that are links. If the system refuses to watch a target, returns the file with the system's reason.
    pub(super) fn watch_link_targets(
        &mut self,
        session: &Session<'_>,
        files: impl IntoIterator<Item = Utf8PathBuf>,
    ) -> Vec<(Utf8PathBuf, String)> {
        let refused = self.directories.follow(&mut *self.source, session, files);
        refused.into_iter().map(|(file, error)| (file, error.to_string())).collect()
    }

    /// Waits for changes. Due changes take precedence over wake-ups, which a page may request without end.
    pub(super) fn next(&mut self, library: &Library<'_>) -> WaitOutcome {
        loop {
            self.poll_signals(library.session());
            if self.is_over {
                return WaitOutcome::Over;
            }
            if self.has_working_directory_moved() {
                return WaitOutcome::Restart(Restart::Directories);
            }
            if self.next_poll.is_some_and(|due| due <= Instant::now()) {
                self.next_poll = Some(Instant::now() + POLL_RESOLUTION);
                self.poll_files(library);
                return WaitOutcome::ConfigurationInDoubt;
            }
            let timeout = self.time_to_deadline(library);
            if timeout.is_zero()
                && let Some(outcome) = self.take_due_changes(library)
            {
                return outcome;
            }
            if self.take_wake_up() {
                return WaitOutcome::WokenUp;
            }
            match self.wait(self.time_to_deadline(library)) {
                Ok(signal) => self.add(signal, library.session()),
                Err(RecvTimeoutError::Disconnected) => return WaitOutcome::Over,
                Err(RecvTimeoutError::Timeout) => {}
            }
        }
    }

    /// Returns the time until the next deadline, if no more events arrive; [`Duration::MAX`] if nothing is pending.
    fn time_to_deadline(&self, library: &Library<'_>) -> Duration {
        if self.pending.is_empty() && self.unfinished.is_empty() && !library.has_backlog() {
            return Duration::MAX;
        }
        self.due.saturating_duration_since(Instant::now())
    }

    /// Takes the changes that are due, except for incomplete drawings, which are checked again soon.
    fn take_due_changes(&mut self, library: &Library<'_>) -> Option<WaitOutcome> {
        let mut changes = std::mem::take(&mut self.pending);
        if let Some(restart) = changes.restart {
            return Some(WaitOutcome::Restart(restart));
        }
        self.hold_back(&mut changes);
        self.due = Instant::now() + INCOMPLETE_DRAWING_INTERVAL;
        (!changes.is_empty() || library.has_backlog()).then_some(WaitOutcome::Changes(changes))
    }

    /// Whether there is a reason to end the batch early: drawings have changed, events were lost, or watching must start again or end.
    pub(super) fn has_news(&mut self, session: &Session<'_>) -> bool {
        self.poll_signals(session);
        let pending = &self.pending;
        let has_drawings = pending.paths.iter().any(|path| is_drawing(path));
        self.is_over || pending.is_incomplete || pending.restart.is_some() || has_drawings
    }

    pub(super) fn is_over(&mut self, session: &Session<'_>) -> bool {
        self.poll_signals(session);
        self.is_over
    }

    /// Whether a wake-up was requested since the last call.
    pub(super) fn take_wake_up(&mut self) -> bool {
        std::mem::take(&mut self.is_woken)
    }

    fn poll_signals(&mut self, session: &Session<'_>) {
        while let Ok(signal) = self.signals.try_recv() {
            self.add(signal, session);
        }
    }

    /// Adds the files that changed although no event reported it.
    fn poll_files(&mut self, library: &Library<'_>) {
        let changed = self.polled.changed(library.session(), library.known_files());
        if !changed.is_empty() {
            self.pending.paths.extend(changed);
            self.restart_debounce();
        }
    }

    /// Whether the working directory was moved or removed. The process keeps the old directory, in which its relative paths are resolved. The path
    /// is polled because events report its change only if every directory above can be watched.
    fn has_working_directory_moved(&mut self) -> bool {
        let now = Instant::now();
        let Some(before) = self.working_directory.as_ref().filter(|_| now >= self.next_directory_check)
        else {
            return false;
        };
        self.next_directory_check = now + DIRECTORY_CHECK_INTERVAL;
        current_directory(&*self.system) != *before
    }

    fn wait(&self, timeout: Duration) -> Result<Signal, RecvTimeoutError> {
        let until_check = |due: Instant| due.saturating_duration_since(Instant::now());
        let timeout = timeout.min(self.next_poll.map_or(Duration::MAX, until_check));
        if self.working_directory.is_some() {
            return self.signals.recv_timeout(timeout.min(DIRECTORY_CHECK_INTERVAL));
        }
        if timeout == Duration::MAX {
            return self.signals.recv().map_err(|_| RecvTimeoutError::Disconnected);
        }
        self.signals.recv_timeout(timeout)
    }

    fn add(&mut self, signal: Signal, session: &Session<'_>) {
        match signal {
            Signal::WokenUp => self.is_woken = true,
            Signal::Over => self.is_over = true,
            Signal::Changed(Ok(event)) if !event.need_rescan() => self.add_event(event, session),
            // Events were lost, or the watcher failed: some changes may be unknown.
            Signal::Changed(_) => {
                self.pending.is_incomplete = true;
                self.restart_debounce();
            }
        }
    }

    fn restart_debounce(&mut self) {
        self.due = Instant::now() + self.debounce;
    }

    fn add_event(&mut self, event: Event, session: &Session<'_>) {
        // Ignore read accesses: they do not change the file.
        let is_change = match event.kind {
            EventKind::Access(kind) => kind == AccessKind::Close(AccessMode::Write),
            _ => true,
        };
        for path in event.paths.into_iter().filter(|_| is_change) {
            if let Ok(path) = Utf8PathBuf::from_path_buf(path) {
                self.add_path(event.kind, &EventPath::new(session, &path));
            }
        }
    }

    fn add_path(&mut self, kind: EventKind, path: &EventPath) {
        let linked = self.directories.linked_drawings(path, &*self.system);
        let is_configuration = |name: &Utf8PathBuf| self.configuration.contains(name);
        let restart = if is_configuration(&path.reported) || linked.iter().any(is_configuration) {
            Some(Restart::Configuration)
        } else {
            self.directories.are_changed_by(kind, path, &*self.system).then_some(Restart::Directories)
        };
        let is_regarded = may_affect_results(&path.reported) && self.directories.is_relevant(path);
        if is_regarded {
            self.pending.paths.extend(self.directories.session_names(path));
        }
        let is_change = is_regarded || !linked.is_empty();
        self.pending.paths.extend(linked);
        if restart.is_some() || is_change {
            self.pending.restart = self.pending.restart.max(restart);
            self.restart_debounce();
        }
    }

    /// Removes incomplete drawings from the changes and keeps them back. Adds drawings kept back earlier that are complete now or have been waited
    /// for long enough.
    fn hold_back(&mut self, changes: &mut Changes) {
        let now = Instant::now();
        for path in std::mem::take(&mut changes.paths) {
            if is_unfinished(&*self.system, &path) {
                self.unfinished.insert(path, now + INCOMPLETE_DRAWING_TIMEOUT);
            } else {
                self.unfinished.remove(&path);
                changes.paths.insert(path);
            }
        }
        let system = &*self.system;
        let is_ready =
            |path: &Utf8PathBuf, until: &mut Instant| now >= *until || !is_unfinished(system, path);
        changes.paths.extend(self.unfinished.extract_if(.., is_ready).map(|(path, _)| path));
    }
}

/// Returns the current path of the working directory; `.` if it was removed.
fn current_directory(system: &dyn System) -> Utf8PathBuf {
    system.canonical(Utf8Path::new("."))
}

/// Whether a change at this path can affect results: it is a drawing, a configuration, an ignore file, or possibly a directory with drawings.
fn may_affect_results(path: &Utf8Path) -> bool {
    let name = path.file_name().unwrap_or_default();
    match path.extension() {
        _ if is_drawing(path) || name == "pathbuild.toml" || is_ignore_file(name) => true,
        Some("gcode" | "tmp" | "txt" | "results") => false,
        _ => !name.starts_with('.') && !path.components().any(|part| part.as_str() == ".pathbuild"),
    }
}

/// Length in bytes of the end of a drawing in which the end marker is searched for.
const END_MARKER_BYTES: usize = 256;

/// Whether a drawing exists but lacks the end marker.
fn is_unfinished(system: &dyn System, path: &Utf8Path) -> bool {
    is_drawing(path)
        && system
            .read_tail(path, END_MARKER_BYTES)
            .is_ok_and(|tail| !tail.windows(3).any(|word| word == b"EOF"))
}

/// The files on which results depend, each with the state in which polling last found it.
///
/// [`PollWatcher`] compares modification times in whole seconds and only notices later ones, but a file may change twice within a second, or be
/// replaced by an older one. (book: reference/decisions)
#[derive(Debug, Default)]
struct PolledFiles(HashMap<SourceFile, PolledFile>);

#[derive(Debug)]
struct PolledFile {
    stamp: Stamp,
    /// Time at which the file was first found with this stamp.
    since: Instant,
    /// Whether the file was compared since then, or needs no comparison.
    is_compared: bool,
}

/// Time for which a file must keep its stamp before it is compared: a change after that time alters the stamp, because the times of all file systems
/// in use have a resolution of at most two seconds.
const MIN_STABLE_TIME: Duration = Duration::from_millis(2100);

impl PolledFiles {
    /// Returns the files whose contents are not those that their results were computed from. A file is read only once after each change of its stamp.
    fn changed(
        &mut self,
        session: &Session<'_>,
        files: impl Iterator<Item = SourceFile>,
    ) -> Vec<Utf8PathBuf> {
        let (db, now) = (session.db(), Instant::now());
        let mut changed = Vec::new();
        for file in files {
            let path = file.path(db);
            let stamp = Stamp::of(path);
            let polled = self.0.entry(file).or_insert_with(|| PolledFile {
                stamp,
                since: now,
                is_compared: stamp.for_storing(FileSystemTime::an_hour_ago()) != Stamp::UNKNOWN
                    && content(db, file).is_some_and(|(_, read)| read == stamp),
            });
            if polled.stamp != stamp {
                *polled = PolledFile { stamp, since: now, is_compared: false };
            }
            if !polled.is_compared && now.duration_since(polled.since) >= MIN_STABLE_TIME {
                polled.is_compared = true;
                if !is_unchanged_since_read(session, file) {
                    changed.push(path.clone());
                }
            }
        }
        changed
    }
}

/// Whether a file still has the contents that its results were computed from, or could be read neither then nor now.
fn is_unchanged_since_read(session: &Session<'_>, file: SourceFile) -> bool {
    let db = session.db();
    let limit = session.workspace().settings.limits.file_size.value;
    let hash = db.system().read(file.path(db), limit).ok().map(|bytes| *blake3::hash(&bytes).as_bytes());
    hash == content(db, file).map(|(read, _)| read)
}
