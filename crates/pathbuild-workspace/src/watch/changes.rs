//! What changed on disk, in batches: events are gathered until nothing has come for a while, and files that a CAD is still writing are waited for.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::time::{Duration, Instant};

use camino::{Utf8Path, Utf8PathBuf};
use notify::event::{AccessKind, AccessMode, EventKind};
use notify::{Config, Event, PollWatcher, RecommendedWatcher, RecursiveMode, Watcher as _};
use pathbuild_db::System;

use super::Request;
use super::library::Library;
use crate::Input;
use crate::config::clean;
use crate::session::Session;

/// Watches the directories of a library.
pub(super) struct Watcher {
    signals: Receiver<Signal>,
    bell: Bell,
    /// Kept, since nothing is watched once it is dropped.
    _source: Box<dyn notify::Watcher>,
    debounce: Duration,
    /// The configuration, and what belongs to it.
    configuration: BTreeSet<Utf8PathBuf>,
    working_directory: Utf8PathBuf,
    system: Arc<dyn System>,
    /// What came while a batch was worked on.
    news: Changes,
    /// When that has come to rest, if nothing more comes.
    due: Instant,
    /// Whether somebody rang and was not heard yet.
    is_rung: bool,
    /// Whether it is to end.
    is_over: bool,
    /// Files without their end, and when they are taken as they are.
    unfinished: BTreeMap<Utf8PathBuf, Instant>,
}

/// What comes from other threads.
enum Signal {
    Changed(notify::Result<Event>),
    Rung,
    Over,
}

/// Wakes the thread that watches. Any thread may have one.
#[derive(Clone, Debug)]
pub struct Bell(Sender<Signal>);

impl Bell {
    /// Makes [`Listener::rung`](super::Listener::rung) be called as soon as the session has time. Without effect once watching has ended.
    pub fn ring(&self) {
        _ = self.0.send(Signal::Rung);
    }

    /// Ends watching as soon as the work in hand is done.
    pub fn end(&self) {
        _ = self.0.send(Signal::Over);
    }
}

/// What came of waiting.
pub(super) enum Batch {
    /// Something changed.
    Changes(Changes),
    /// The configuration did.
    ConfigurationChanged,
    /// Somebody rang.
    Rung,
    /// Nothing more will come.
    Over,
}

/// What changed: names that were written, made, renamed or removed, normalised.
#[derive(Debug, Default)]
pub(super) struct Changes {
    pub(super) paths: BTreeSet<Utf8PathBuf>,
    /// Whether more may have changed than is said.
    pub(super) is_incomplete: bool,
}

/// How often is looked on network drives.
const POLL_INTERVAL: Duration = Duration::from_secs(1);

/// How long a drawing without its end is waited for after its last change: it may be that its program never writes one.
const PATIENCE: Duration = Duration::from_secs(2);

/// How often unfinished drawings are looked at.
const GLANCE: Duration = Duration::from_millis(50);

impl Watcher {
    /// Begins to watch. `post`: the files that a post is read from.
    pub(super) fn new(
        session: &Session<'_>,
        request: &Request<'_>,
        post: &[Utf8PathBuf],
    ) -> notify::Result<Self> {
        let workspace = session.workspace();
        let settings = &workspace.settings;
        let (sender, signals) = channel();
        let bell = Bell(sender.clone());
        let tell = move |event| _ = sender.send(Signal::Changed(event));
        let is_polling = request.polls || settings.watch.poll.value;
        let mut watcher: Box<dyn notify::Watcher> = if is_polling {
            Box::new(PollWatcher::new(tell, Config::default().with_poll_interval(POLL_INTERVAL))?)
        } else {
            Box::new(RecommendedWatcher::new(tell, Config::default())?)
        };
        let post: Vec<Utf8PathBuf> = post.iter().map(|file| session.normal(file)).collect();
        for (directory, mode) in directories(session, request, &post) {
            let place = if directory.as_str().is_empty() { Utf8Path::new(".") } else { &directory };
            watcher.watch(place.as_std_path(), mode)?;
        }
        Ok(Self {
            signals,
            bell,
            _source: watcher,
            debounce: settings.watch.debounce.value,
            configuration: settings.file.iter().map(|file| session.normal(file)).chain(post).collect(),
            news: Changes::default(),
            due: Instant::now(),
            is_rung: false,
            is_over: false,
            working_directory: workspace.working_directory.clone(),
            system: Arc::clone(&workspace.system),
            unfinished: BTreeMap::new(),
        })
    }

    /// What wakes it.
    pub(super) fn bell(&self) -> Bell {
        self.bell.clone()
    }

    /// Waits for changes.
    pub(super) fn next(&mut self, library: &Library<'_>) -> Batch {
        loop {
            if self.is_over {
                return Batch::Over;
            }
            if self.has_been_rung() {
                return Batch::Rung;
            }
            let is_idle = self.news.is_empty() && !library.is_behind();
            let patience = match (is_idle, self.unfinished.is_empty()) {
                (false, _) => self.due.saturating_duration_since(Instant::now()),
                (true, false) => GLANCE,
                (true, true) => Duration::MAX,
            };
            match self.wait(patience) {
                Ok(signal) => self.add(signal, library.session()),
                Err(RecvTimeoutError::Disconnected) => return Batch::Over,
                Err(RecvTimeoutError::Timeout) => {
                    if !self.configuration.is_disjoint(&self.news.paths) {
                        return Batch::ConfigurationChanged;
                    }
                    let mut changes = std::mem::take(&mut self.news);
                    self.hold_back(&mut changes);
                    if !changes.is_empty() || library.is_behind() {
                        return Batch::Changes(changes);
                    }
                }
            }
        }
    }

    /// Whether drawings changed since the last batch was given out, or it is to end.
    pub(super) fn has_news(&mut self, session: &Session<'_>) -> bool {
        self.look(session);
        self.is_over || self.news.is_incomplete || self.news.paths.iter().any(|path| self.is_news(path))
    }

    /// Whether it is to end.
    pub(super) fn is_over(&mut self, session: &Session<'_>) -> bool {
        self.look(session);
        self.is_over
    }

    /// Whether somebody rang since this was asked last.
    pub(super) fn has_been_rung(&mut self) -> bool {
        std::mem::take(&mut self.is_rung)
    }

    /// Takes in what has come without waiting for more.
    fn look(&mut self, session: &Session<'_>) {
        while let Ok(signal) = self.signals.try_recv() {
            self.add(signal, session);
        }
    }

    fn is_news(&self, path: &Utf8PathBuf) -> bool {
        Session::is_drawing(path) || self.configuration.contains(path)
    }

    fn wait(&self, patience: Duration) -> Result<Signal, RecvTimeoutError> {
        if patience == Duration::MAX {
            return self.signals.recv().map_err(|_| RecvTimeoutError::Disconnected);
        }
        self.signals.recv_timeout(patience)
    }

    fn add(&mut self, signal: Signal, session: &Session<'_>) {
        match signal {
            Signal::Rung => self.is_rung = true,
            Signal::Over => self.is_over = true,
            Signal::Changed(event) => {
                self.add_event(event, session);
                self.due = Instant::now() + self.debounce;
            }
        }
    }

    fn add_event(&mut self, event: notify::Result<Event>, session: &Session<'_>) {
        // Whoever reads tells nothing.
        let tells = |kind: EventKind| match kind {
            EventKind::Access(AccessKind::Close(AccessMode::Write)) => true,
            EventKind::Access(_) => false,
            _ => true,
        };
        match event {
            Ok(event) if event.need_rescan() => self.news.is_incomplete = true,
            Ok(event) if tells(event.kind) => {
                let paths = event.paths.into_iter().filter_map(|path| Utf8PathBuf::from_path_buf(path).ok());
                let paths = paths.map(|path| session.normal(&clean(&self.working_directory.join(path))));
                let configuration = &self.configuration;
                self.news.paths.extend(paths.filter(|path| matters(path) || configuration.contains(path)));
            }
            Ok(_) => {}
            Err(_) => self.news.is_incomplete = true,
        }
    }

    /// Keeps back drawings that are being written, and gives out those that were waited for.
    fn hold_back(&mut self, changes: &mut Changes) {
        let now = Instant::now();
        for path in std::mem::take(&mut changes.paths) {
            if is_unfinished(&*self.system, &path) {
                self.unfinished.insert(path, now + PATIENCE);
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

impl Changes {
    fn is_empty(&self) -> bool {
        self.paths.is_empty() && !self.is_incomplete
    }
}

/// The directories to watch: those that hold drawings, those that are searched, that of the configuration, and those of the post.
fn directories(
    session: &Session<'_>,
    request: &Request<'_>,
    post: &[Utf8PathBuf],
) -> Vec<(Utf8PathBuf, RecursiveMode)> {
    let settings = &session.workspace().settings;
    let general = &settings.general;
    let mut all: BTreeMap<Utf8PathBuf, RecursiveMode> = BTreeMap::new();
    let mut add = |directory: Utf8PathBuf, mode: RecursiveMode| {
        let known = all.entry(directory).or_insert(mode);
        if mode == RecursiveMode::Recursive {
            *known = mode;
        }
    };
    for input in request.inputs.iter() {
        match input {
            Input::Name(name) if session.is_directory(name.into()) => {
                add(session.normal(name.into()), RecursiveMode::Recursive);
                // There may be a path of that name as well.
                add(Utf8PathBuf::new(), RecursiveMode::NonRecursive);
            }
            Input::Place(place) if session.is_directory(place) => {
                add(session.normal(place), RecursiveMode::Recursive);
            }
            Input::Place(place) => {
                add(
                    session.normal(place).parent().unwrap_or(Utf8Path::new("")).to_owned(),
                    RecursiveMode::NonRecursive,
                );
            }
            Input::Name(name) => {
                // What is no name of a path may be that of a directory.
                if session.is_directory(Utf8Path::new(name)) {
                    add(session.normal(Utf8Path::new(name)), RecursiveMode::Recursive);
                }
                add(Utf8PathBuf::new(), RecursiveMode::NonRecursive);
            }
        }
    }
    for directory in &general.library.value {
        add(session.normal(directory), RecursiveMode::Recursive);
    }
    let beside = settings.directory().map(|directory| session.normal(directory));
    let posts = post.iter().filter_map(|file| file.parent().map(Utf8Path::to_owned));
    let searched = general.search.value.iter().map(|directory| session.normal(directory));
    for directory in searched.chain(beside).chain(posts) {
        add(directory, RecursiveMode::NonRecursive);
    }
    let is_there = |directory: &Utf8PathBuf| directory.as_str().is_empty() || session.is_directory(directory);
    all.into_iter().filter(|(directory, _)| is_there(directory)).collect()
}

/// Whether a name can change a result: that of a drawing, of what says which drawings count, or of what may be a directory of them.
fn matters(path: &Utf8Path) -> bool {
    let name = path.file_name().unwrap_or_default();
    match path.extension() {
        Some(extension) if extension.eq_ignore_ascii_case("dxf") => true,
        _ if matches!(name, "pathbuild.toml" | ".gitignore" | ".ignore") => true,
        Some("gcode" | "tmp" | "txt" | "results") => false,
        _ => !name.starts_with('.') && !path.components().any(|part| part.as_str() == ".pathbuild"),
    }
}

/// Where the end of a drawing says so.
const TAIL: usize = 256;

/// Whether a drawing is there and does not end as drawings do.
fn is_unfinished(system: &dyn System, path: &Utf8Path) -> bool {
    let is_drawing = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("dxf"));
    is_drawing && system.tail(path, TAIL).is_ok_and(|tail| !tail.windows(3).any(|word| word == b"EOF"))
}
