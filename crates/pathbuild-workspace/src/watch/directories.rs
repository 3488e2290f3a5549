//! The watched directories, and the directories on the way to them. The system watches a directory itself, not its name: only events in the
//! parent directory tell that it appeared, disappeared or was replaced.

use std::collections::{BTreeMap, BTreeSet};
use std::io;

use camino::{Utf8Path, Utf8PathBuf};
use notify::event::{EventKind, ModifyKind};
use notify::{ErrorKind, RecursiveMode, Watcher};
use pathbuild_db::System;
use pathbuild_db::system::{FileKind, join};

use super::Request;
use crate::Input;
use crate::config::clean;
use crate::session::Session;

/// Directories, as named in events.
pub(super) struct WatchedDirectories {
    /// Watched directories, with or without everything below them.
    watched: BTreeMap<Utf8PathBuf, RecursiveMode>,
    /// The watched directories, each with its name in the session, which may begin with `..`.
    own_names: BTreeSet<[Utf8PathBuf; 2]>,
    /// Directories whose replacement matters: the watched ones, and those on the way to them.
    names: BTreeSet<Utf8PathBuf>,
    /// Directories that the system refuses to watch because they cannot be listed.
    refused: BTreeSet<Utf8PathBuf>,
}

impl WatchedDirectories {
    /// Collects the directories of a request. `post` lists the files that the post-processor is read from.
    pub(super) fn new(session: &Session<'_>, request: &Request<'_>, post: &[Utf8PathBuf]) -> Self {
        let (mut watched, mut own_names) = (BTreeMap::new(), BTreeSet::new());
        for (directory, mode) in directories(session, request, post) {
            let event_name = event_path(session, &directory);
            let known = watched.entry(event_name.clone()).or_insert(mode);
            if mode == RecursiveMode::Recursive {
                *known = mode;
            }
            own_names.insert([event_name, session.normal(&directory)]);
        }
        let names = watched.keys().flat_map(|directory| directory.ancestors());
        // The working directory and the root exist as long as the program runs.
        let names = names.filter(|name| name.parent().is_some()).map(Utf8Path::to_owned).collect();
        Self { watched, own_names, names, refused: BTreeSet::new() }
    }

    /// Starts watching the directories.
    ///
    /// # Errors
    /// Why the system refuses. Directories that cannot be listed are no error.
    pub(super) fn watch(&mut self, source: &mut dyn Watcher, system: &dyn System) -> notify::Result<()> {
        // Watch the parents first, so that no new directory is missed. Some of them may not be listable.
        for way in self.names.iter().filter_map(|name| name.parent()).filter(|way| !is_root(way)) {
            _ = source.watch(spelt(way).as_std_path(), RecursiveMode::NonRecursive);
        }
        for (directory, mode) in self.watched.clone() {
            let is_there = directory.as_str().is_empty() || system.kind(&directory) == FileKind::Directory;
            if is_there && !self.is_below(&directory) {
                self.watch_one(source, system, &directory, mode, &mut BTreeSet::new())?;
            }
        }
        Ok(())
    }

    /// Whether a change of this path matters; directories on the way contain unrelated names as well.
    pub(super) fn is_relevant(&self, path: &Utf8Path) -> bool {
        self.names.contains(path) || path.ancestors().skip(1).any(|directory| self.holds(directory, path))
    }

    /// Whether the path is in a watched directory, or below one that is watched recursively.
    fn holds(&self, directory: &Utf8Path, path: &Utf8Path) -> bool {
        match self.watched.get(directory) {
            Some(RecursiveMode::Recursive) => path != directory && path.starts_with(directory),
            Some(RecursiveMode::NonRecursive) => path.parent() == Some(directory),
            None => false,
        }
    }

    /// Names that the session uses for the path of an event. A drawing may have two names: as an argument, and in a search directory.
    pub(super) fn own_names(&self, path: &Utf8Path) -> Vec<Utf8PathBuf> {
        let pairs = self.own_names.iter().filter(|[event_name, _]| self.holds(event_name, path));
        let own = pairs.filter_map(|[event_name, own]| Some(join(own, path.strip_prefix(event_name).ok()?)));
        let own: BTreeSet<Utf8PathBuf> = own.collect();
        if own.is_empty() { vec![path.to_owned()] } else { own.into_iter().collect() }
    }

    /// Whether the set of directories to watch differs after this event. Ordinary files do not matter, nor do changes inside a directory:
    /// programs may be written into it.
    pub(super) fn are_changed(&self, kind: EventKind, path: &Utf8Path, system: &dyn System) -> bool {
        if comes_or_goes(kind) {
            return self.names.contains(path);
        }
        self.refused.contains(path) && system.list(path).is_ok()
    }

    /// Whether a directory above is watched recursively.
    fn is_below(&self, path: &Utf8Path) -> bool {
        let is_whole = |above: &Utf8Path| self.watched.get(above) == Some(&RecursiveMode::Recursive);
        path.ancestors().skip(1).any(is_whole)
    }

    /// Watches a directory. If a subdirectory cannot be listed, watches the others one by one; the check reports the unreadable one.
    fn watch_one(
        &mut self,
        source: &mut dyn Watcher,
        system: &dyn System,
        directory: &Utf8Path,
        mode: RecursiveMode,
        seen: &mut BTreeSet<Utf8PathBuf>,
    ) -> notify::Result<()> {
        match source.watch(spelt(directory).as_std_path(), mode) {
            Err(error) if is_refusal(&error) => {}
            done => return done,
        }
        let Ok(listing) = system.list(directory) else {
            self.refused.insert(directory.to_owned());
            return Ok(());
        };
        // The directory itself is watched already, since the system added it before its subdirectories.
        for name in listing.directories.iter().filter(|_| mode == RecursiveMode::Recursive) {
            let below = join(directory, name);
            // A symbolic link may lead back.
            if seen.insert(system.canonical(&below)) {
                self.watch_one(source, system, &below, mode, seen)?;
            }
        }
        Ok(())
    }
}

/// Spelling for system calls: the working directory is `.`.
fn spelt(directory: &Utf8Path) -> &Utf8Path {
    if directory.as_str().is_empty() { Utf8Path::new(".") } else { directory }
}

fn is_root(directory: &Utf8Path) -> bool {
    directory.has_root() && directory.parent().is_none()
}

fn comes_or_goes(kind: EventKind) -> bool {
    matches!(kind, EventKind::Create(_) | EventKind::Remove(_) | EventKind::Modify(ModifyKind::Name(_)))
}

/// Whether the error says that a directory cannot be listed or no longer exists.
fn is_refusal(error: &notify::Error) -> bool {
    match &error.kind {
        ErrorKind::Io(reason) => {
            matches!(reason.kind(), io::ErrorKind::PermissionDenied | io::ErrorKind::NotFound)
        }
        ErrorKind::PathNotFound => true,
        _ => false,
    }
}

/// The directories to watch: those of drawings, the search directories, and those of the configuration and the post-processor. Missing
/// directories are included because they may appear later.
fn directories(
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
        if session.is_directory(place) || !Session::is_drawing(place) {
            whole.push(place);
        } else {
            alone.extend(place.parent());
        }
    }
    // A name may be that of a path in the working directory.
    if request.inputs.iter().any(|input| matches!(input, Input::Name(_))) {
        alone.push(Utf8Path::new(""));
    }
    let with = |mode| move |directory: &Utf8Path| (directory.to_owned(), mode);
    let whole = whole.into_iter().map(with(RecursiveMode::Recursive));
    whole.chain(alone.into_iter().map(with(RecursiveMode::NonRecursive))).collect()
}

/// The path as events name it.
pub(super) fn event_path(session: &Session<'_>, path: &Utf8Path) -> Utf8PathBuf {
    session.normal(&clean(&session.workspace().working_directory.join(path)))
}
