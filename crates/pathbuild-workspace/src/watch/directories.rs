//! The watched directories and their parents. The system watches a directory itself, not its name: only events in the parent directory report that
//! a directory appeared, disappeared or was replaced.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::io;

use camino::{Utf8Path, Utf8PathBuf};
use notify::event::{EventKind, ModifyKind};
use notify::{ErrorKind, RecursiveMode, Watcher};
use pathbuild_db::System;
use pathbuild_db::system::{FileKind, FileLink, is_drawing, join, or_current_directory};

use super::events::Request;
use crate::Input;
use crate::config::clean;
use crate::files::MAX_LINKS;
use crate::session::Session;

/// Directories to watch, with the paths that events report.
pub(super) struct WatchedDirectories {
    /// Watched directories, and whether everything below them is watched as well.
    watched: BTreeMap<Utf8PathBuf, RecursiveMode>,
    /// For each watched directory: the path that events report, its canonical path, and its path in the session, which may begin with `..`.
    roots: BTreeSet<[Utf8PathBuf; 3]>,
    /// Directories whose replacement must be noticed: the watched directories and their parents.
    names: BTreeSet<Utf8PathBuf>,
    /// Directories that the system refuses to watch because they cannot be listed.
    refused: BTreeSet<Utf8PathBuf>,
    links: Links,
    /// Directories and files that are watched because links point to them.
    linked: BTreeSet<Utf8PathBuf>,
}

/// The path of an event, as reported and with the links of its directory resolved. A directory that is reached by two paths has one watch, which
/// reports only one of them.
pub(super) struct EventPath {
    pub(super) reported: Utf8PathBuf,
    resolved: Utf8PathBuf,
}

impl EventPath {
    /// Normalises the absolute path that an event reports.
    pub(super) fn new(session: &Session<'_>, path: &Utf8Path) -> Self {
        let reported = event_path(session, path);
        let resolved = match reported.parent().zip(reported.file_name()) {
            Some((parent, name)) => join(&real_directory(session, parent), name),
            None => reported.clone(),
        };
        Self { reported, resolved }
    }
}

impl WatchedDirectories {
    /// Collects the directories of a request. `post` lists the files that make up the post-processor, and the baseline.
    pub(super) fn new(session: &Session<'_>, request: &Request<'_>, post: &[Utf8PathBuf]) -> Self {
        let (mut watched, mut roots, mut names) = (BTreeMap::new(), BTreeSet::new(), BTreeSet::new());
        let workspace = session.workspace();
        let (system, working_directory) = (&*workspace.system, &workspace.working_directory);
        for (directory, mode) in directories_to_watch(session, request, post) {
            let event_name = event_path(session, &directory);
            let known = watched.entry(event_name.clone()).or_insert(mode);
            if mode == RecursiveMode::Recursive {
                *known = mode;
            }
            names.extend(directory_and_parents(&event_name));
            for name in followed_links(system, &working_directory.join(&event_name)) {
                names.extend(directory_and_parents(&event_path(session, &name)));
            }
            roots.insert([
                event_name.clone(),
                real_directory(session, &event_name),
                session.normalize(&directory),
            ]);
        }
        let (links, linked) = (Links::default(), BTreeSet::new());
        Self { watched, roots, names, refused: BTreeSet::new(), links, linked }
    }

    /// Starts watching the directories.
    ///
    /// # Errors
    /// If the system refuses, with its reason. Directories that cannot be listed are not an error.
    pub(super) fn watch(&mut self, source: &mut dyn Watcher, system: &dyn System) -> notify::Result<()> {
        // Watch the parents first, so that no new directory is missed. Best effort: some of them may not be listable.
        for parent in self.names.iter().filter_map(|name| name.parent()).filter(|parent| !is_root(parent)) {
            _ = source.watch(or_current_directory(parent).as_std_path(), RecursiveMode::NonRecursive);
        }
        for (directory, mode) in self.watched.clone() {
            let is_there = directory.as_str().is_empty() || system.kind(&directory) == FileKind::Directory;
            if is_there && !self.is_below(&directory) {
                self.watch_one(source, system, &directory, mode, &mut BTreeSet::new())?;
            }
        }
        Ok(())
    }

    /// Watches the targets of those files that are links. If the system refuses to watch a target, returns the file with the system's reason.
    pub(super) fn follow(
        &mut self,
        source: &mut dyn Watcher,
        session: &Session<'_>,
        files: impl IntoIterator<Item = Utf8PathBuf>,
    ) -> Vec<(Utf8PathBuf, notify::Error)> {
        let workspace = session.workspace();
        let system = &*workspace.system;
        let as_event = |path: &Utf8Path| event_path(session, path);
        let mut refused = Vec::new();
        for file in files {
            let places = self.links.follow(system, &file, &workspace.working_directory, as_event);
            let outcomes = places.into_iter().map(|place| self.watch_link(source, place));
            // Ignore directories that cannot be listed: the links that lead through them are followed again after the next change.
            let errors = outcomes.filter_map(Result::err).filter(|error| !is_inaccessible(error));
            refused.extend(errors.last().map(|error| (file, error)));
        }
        refused
    }

    fn watch_link(&mut self, source: &mut dyn Watcher, place: LinkPlace) -> notify::Result<()> {
        let directory = match place {
            LinkPlace::File(file) => return self.watch_linked(source, &file),
            LinkPlace::Name(file) => file.parent().unwrap_or(Utf8Path::new("")).to_owned(),
            LinkPlace::Directory(directory) => directory,
        };
        for name in directory_and_parents(&directory) {
            let above = name.parent().filter(|above| !is_root(above) && !self.is_covered(above));
            if let Some(above) = above {
                // Best effort: some of these directories may not be listable.
                _ = self.watch_linked(source, above);
            }
            self.names.insert(name);
        }
        if self.is_covered(&directory) { Ok(()) } else { self.watch_linked(source, &directory) }
    }

    fn watch_linked(&mut self, source: &mut dyn Watcher, path: &Utf8Path) -> notify::Result<()> {
        if !self.linked.contains(path) {
            source.watch(or_current_directory(path).as_std_path(), RecursiveMode::NonRecursive)?;
            self.linked.insert(path.to_owned());
        }
        Ok(())
    }

    /// Whether a directory is watched already. Watching it again without its subdirectories would end the recursive watch.
    fn is_covered(&self, directory: &Utf8Path) -> bool {
        let is_covered_by = |event_name: &Utf8PathBuf, root: &Utf8PathBuf| {
            root == directory
                || self.watched.get(event_name) == Some(&RecursiveMode::Recursive)
                    && directory.starts_with(root)
        };
        self.roots.iter().any(|[event_name, real, _]| {
            is_covered_by(event_name, event_name) || is_covered_by(event_name, real)
        })
    }

    pub(super) fn are_relative(&self) -> bool {
        self.watched.keys().any(|directory| directory.is_relative())
    }

    /// Whether a change at this path matters. Parents of watched directories also report irrelevant names.
    pub(super) fn is_relevant(&self, path: &EventPath) -> bool {
        self.names.contains(&path.reported)
            || self.roots.iter().any(|[event_name, real, _]| {
                self.holds(event_name, event_name, &path.reported)
                    || self.holds(event_name, real, &path.resolved)
            })
    }

    /// Whether the path is in the directory that is watched as `event_name`, or below it if it is watched recursively. `root` is one of the
    /// directory's paths.
    fn holds(&self, event_name: &Utf8Path, root: &Utf8Path, path: &Utf8Path) -> bool {
        match self.watched.get(event_name) {
            Some(RecursiveMode::Recursive) => path != root && path.starts_with(root),
            Some(RecursiveMode::NonRecursive) => path.parent() == Some(root),
            None => false,
        }
    }

    /// Returns the names that the session uses for the path of an event. A drawing may have two: one as an argument, and one in a search directory.
    pub(super) fn session_names(&self, path: &EventPath) -> Vec<Utf8PathBuf> {
        let below =
            |own: &Utf8Path, root: &Utf8Path, path: &Utf8Path| Some(join(own, path.strip_prefix(root).ok()?));
        let real =
            self.roots.iter().filter(|[event_name, real, _]| self.holds(event_name, real, &path.resolved));
        let mut own: BTreeSet<Utf8PathBuf> =
            real.filter_map(|[_, real, own]| below(own, real, &path.resolved)).collect();
        if own.is_empty() {
            let event_name = self
                .roots
                .iter()
                .filter(|[event_name, ..]| self.holds(event_name, event_name, &path.reported));
            own.extend(event_name.filter_map(|[event_name, _, own]| below(own, event_name, &path.reported)));
        }
        if own.is_empty() { vec![path.reported.clone()] } else { own.into_iter().collect() }
    }

    /// Returns the names of linked drawings that may have other content after a change at this path.
    pub(super) fn linked_drawings(&self, path: &EventPath, system: &dyn System) -> BTreeSet<Utf8PathBuf> {
        let mut drawings = self.links.drawings_at(system, &path.reported);
        drawings.extend(self.links.drawings_at(system, &path.resolved));
        drawings
    }

    /// Whether the set of directories to watch changes with this event. Ordinary files do not affect the set, nor do changes inside a directory, for
    /// example when programs are written into it.
    pub(super) fn are_changed_by(&self, kind: EventKind, path: &EventPath, system: &dyn System) -> bool {
        if is_creation_or_removal(kind) {
            // The watches of a moved directory end even if it is moved back.
            let is_working_directory = path.reported.as_str().is_empty() && self.are_relative();
            return is_working_directory
                || self.names.contains(&path.reported)
                || self.names.contains(&path.resolved);
        }
        self.refused.contains(&path.reported) && system.list(&path.reported).is_ok()
    }

    /// Whether a parent of this path is watched recursively.
    fn is_below(&self, path: &Utf8Path) -> bool {
        let is_whole = |above: &Utf8Path| self.watched.get(above) == Some(&RecursiveMode::Recursive);
        path.ancestors().skip(1).any(is_whole)
    }

    /// Watches a directory. If a subdirectory cannot be listed, watches the other ones individually; the check reports the unreadable one.
    fn watch_one(
        &mut self,
        source: &mut dyn Watcher,
        system: &dyn System,
        directory: &Utf8Path,
        mode: RecursiveMode,
        seen: &mut BTreeSet<Utf8PathBuf>,
    ) -> notify::Result<()> {
        match source.watch(or_current_directory(directory).as_std_path(), mode) {
            Err(error) if is_inaccessible(&error) => {}
            done => return done,
        }
        let Ok(listing) = system.list(directory) else {
            self.refused.insert(directory.to_owned());
            return Ok(());
        };
        // The directory itself is watched already, because the system adds it before its subdirectories.
        for name in listing.directories.iter().filter(|_| mode == RecursiveMode::Recursive) {
            let below = join(directory, name);
            // A symbolic link may point to a directory that has been seen.
            if seen.insert(system.canonical(&below)) {
                self.watch_one(source, system, &below, mode, seen)?;
            }
        }
        Ok(())
    }
}

/// Returns a directory and its parents, except the root and the working directory.
fn directory_and_parents(directory: &Utf8Path) -> impl Iterator<Item = Utf8PathBuf> {
    directory.ancestors().filter(|name| name.parent().is_some()).map(Utf8Path::to_owned)
}

/// Returns the canonical path of a directory, as events report it.
fn real_directory(session: &Session<'_>, directory: &Utf8Path) -> Utf8PathBuf {
    event_path(session, &session.workspace().system.canonical(or_current_directory(directory)))
}

fn is_root(directory: &Utf8Path) -> bool {
    directory.has_root() && directory.parent().is_none()
}

fn is_creation_or_removal(kind: EventKind) -> bool {
    matches!(kind, EventKind::Create(_) | EventKind::Remove(_) | EventKind::Modify(ModifyKind::Name(_)))
}

/// Whether the error says that a directory cannot be listed or no longer exists.
fn is_inaccessible(error: &notify::Error) -> bool {
    match &error.kind {
        ErrorKind::Io(reason) => {
            matches!(reason.kind(), io::ErrorKind::PermissionDenied | io::ErrorKind::NotFound)
        }
        ErrorKind::PathNotFound => true,
        _ => false,
    }
}

/// Returns the directories to watch: those of drawings, the search directories, and those of the configuration, the post-processor and the baseline.
/// Missing directories are included because they may appear later.
fn directories_to_watch(
    session: &Session<'_>,
    request: &Request<'_>,
    post: &[Utf8PathBuf],
) -> Vec<(Utf8PathBuf, RecursiveMode)> {
    let settings = &session.workspace().settings;
    let general = &settings.general;
    let mut whole: Vec<&Utf8Path> = general.library.value.iter().map(Utf8PathBuf::as_path).collect();
    let mut alone: Vec<&Utf8Path> = general.search.value.iter().map(Utf8PathBuf::as_path).collect();
    alone.extend(settings.directory().into_iter().chain(post.iter().filter_map(|file| file.parent())));
    for input in request.inputs.iter() {
        let place = match input {
            Input::Place(place) => place,
            Input::Name(name) => Utf8Path::new(name),
        };
        if session.is_directory(place) || !is_drawing(place) {
            whole.push(place);
        } else {
            alone.extend(place.parent());
        }
    }
    // A name may refer to a path in the working directory.
    if request.inputs.iter().any(|input| matches!(input, Input::Name(_))) {
        alone.push(Utf8Path::new(""));
    }
    let with = |mode| move |directory: &Utf8Path| (directory.to_owned(), mode);
    let whole = whole.into_iter().map(with(RecursiveMode::Recursive));
    whole.chain(alone.into_iter().map(with(RecursiveMode::NonRecursive))).collect()
}

/// Converts a path to the form in which events report it.
pub(super) fn event_path(session: &Session<'_>, path: &Utf8Path) -> Utf8PathBuf {
    session.normalize(&clean(&session.workspace().working_directory.join(path)))
}

/// Links among the dependencies of results. All paths have the form in which events report them.
#[derive(Default)]
pub(super) struct Links {
    /// Linked drawings, by each path that determines their content.
    by_place: BTreeMap<Utf8PathBuf, BTreeSet<Utf8PathBuf>>,
    /// The reverse of `by_place`, for removing a drawing.
    places: HashMap<Utf8PathBuf, Vec<Utf8PathBuf>>,
    /// Hard links by device and inode number.
    by_file: HashMap<[u64; 2], BTreeSet<Utf8PathBuf>>,
    /// The reverse of `by_file`, for removing a drawing.
    files: HashMap<Utf8PathBuf, [u64; 2]>,
}

/// A path to watch for a linked drawing.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum LinkPlace {
    /// A symbolic link that is followed, or the file to which the last link points.
    Name(Utf8PathBuf),
    /// A followed symbolic link to a directory.
    Directory(Utf8PathBuf),
    /// A file with hard links, through any of which it may be written.
    File(Utf8PathBuf),
}

impl Links {
    /// Resolves a drawing's links again and returns the paths to watch. `as_event` converts an absolute path to the form in events.
    pub(super) fn follow(
        &mut self,
        system: &dyn System,
        drawing: &Utf8Path,
        working_directory: &Utf8Path,
        as_event: impl Fn(&Utf8Path) -> Utf8PathBuf,
    ) -> Vec<LinkPlace> {
        self.forget(drawing);
        let mut to_watch = Vec::new();
        let mut file = drawing.to_owned();
        let mut link = system.link(&file);
        if let Some(FileLink::Symbolic(_)) = link {
            for name in followed_links(system, &working_directory.join(drawing)) {
                file = as_event(&name);
                if system.kind(&file) == FileKind::Directory {
                    to_watch.push(LinkPlace::Directory(file.clone()));
                } else {
                    self.add(&file, drawing);
                    to_watch.push(LinkPlace::Name(file.clone()));
                }
            }
            link = system.link(&file);
        }
        if let Some(FileLink::Hard(shared)) = link {
            self.add(&file, drawing);
            self.by_file.entry(shared).or_default().insert(drawing.to_owned());
            self.files.insert(drawing.to_owned(), shared);
            to_watch.push(LinkPlace::File(file));
        }
        to_watch
    }

    /// Returns the linked drawings that may have other content after a change at this path.
    pub(super) fn drawings_at(&self, system: &dyn System, place: &Utf8Path) -> BTreeSet<Utf8PathBuf> {
        let mut drawings = self.by_place.get(place).cloned().unwrap_or_default();
        if !drawings.is_empty()
            && let Some(FileLink::Hard(shared)) = system.link(place)
        {
            // A file with hard links has one watch, which always reports the same name.
            drawings.extend(self.by_file.get(&shared).into_iter().flatten().cloned());
        }
        drawings
    }

    fn forget(&mut self, drawing: &Utf8Path) {
        for place in self.places.remove(drawing).unwrap_or_default() {
            if let Some(names) = self.by_place.get_mut(&place) {
                names.remove(drawing);
            }
        }
        if let Some(names) = self.files.remove(drawing).and_then(|shared| self.by_file.get_mut(&shared)) {
            names.remove(drawing);
        }
    }

    fn add(&mut self, place: &Utf8Path, drawing: &Utf8Path) {
        self.by_place.entry(place.to_owned()).or_default().insert(drawing.to_owned());
        self.places.entry(drawing.to_owned()).or_default().push(place.to_owned());
    }
}

/// Returns the symbolic links that are followed on an absolute path, and last the path with all of them resolved.
pub(super) fn followed_links(system: &dyn System, path: &Utf8Path) -> Vec<Utf8PathBuf> {
    let parts = |path: &Utf8Path| -> Vec<Utf8PathBuf> {
        path.components().rev().map(|part| part.as_str().into()).collect()
    };
    let (mut here, mut names, mut open) = (Utf8PathBuf::new(), Vec::new(), parts(path));
    while let Some(part) = open.pop() {
        match part.as_str() {
            "." => continue,
            ".." => _ = here.pop(),
            _ => here.push(&part),
        }
        if part != ".."
            && names.len() < MAX_LINKS
            && let Some(FileLink::Symbolic(target)) = system.link(&here)
        {
            names.push(here.clone());
            here.pop();
            open.extend(parts(&target));
        }
    }
    names.push(here);
    names
}
