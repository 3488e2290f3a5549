//! The directories that are watched, and those that lead to them. The system watches what is under a name, not the name: that a directory came,
//! went or is another one is told by the directory above it alone.

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

/// Directories, as events name them.
pub(super) struct Places {
    /// Those in which changes count, with all below or without.
    wanted: BTreeMap<Utf8PathBuf, RecursiveMode>,
    /// The same, each with how the session names it, which may begin with `..`.
    own_names: BTreeSet<[Utf8PathBuf; 2]>,
    /// Those of which it counts that they come, go or are others: these, and those that lead to them.
    names: BTreeSet<Utf8PathBuf>,
    /// Those that the system does not let anybody watch, since they cannot be listed.
    refused: BTreeSet<Utf8PathBuf>,
}

impl Places {
    /// Those of what is watched. `post`: the files that a post is read from.
    pub(super) fn new(session: &Session<'_>, request: &Request<'_>, post: &[Utf8PathBuf]) -> Self {
        let (mut wanted, mut own_names) = (BTreeMap::new(), BTreeSet::new());
        for (directory, mode) in directories(session, request, post) {
            let told = as_told(session, &directory);
            let known = wanted.entry(told.clone()).or_insert(mode);
            if mode == RecursiveMode::Recursive {
                *known = mode;
            }
            own_names.insert([told, session.normal(&directory)]);
        }
        let names = wanted.keys().flat_map(|directory| directory.ancestors());
        // The working directory and the root are there as long as the program.
        let names = names.filter(|name| name.parent().is_some()).map(Utf8Path::to_owned).collect();
        Self { wanted, own_names, names, refused: BTreeSet::new() }
    }

    /// Begins to watch them.
    ///
    /// # Errors
    /// Why the system does not, but for directories that cannot be listed.
    pub(super) fn watch(&mut self, source: &mut dyn Watcher, system: &dyn System) -> notify::Result<()> {
        // First, so that no directory comes unseen. Not all that lead somewhere may be listed.
        for way in self.names.iter().filter_map(|name| name.parent()).filter(|way| !is_root(way)) {
            _ = source.watch(spelt(way).as_std_path(), RecursiveMode::NonRecursive);
        }
        for (directory, mode) in self.wanted.clone() {
            let is_there = directory.as_str().is_empty() || system.kind(&directory) == FileKind::Directory;
            if is_there && !self.is_below(&directory) {
                self.watch_one(source, system, &directory, mode, &mut BTreeSet::new())?;
            }
        }
        Ok(())
    }

    /// Whether a change under a name counts: those that lead somewhere have other names too.
    pub(super) fn regard(&self, path: &Utf8Path) -> bool {
        self.names.contains(path) || path.ancestors().skip(1).any(|directory| self.holds(directory, path))
    }

    /// Whether a name is in a directory that is watched, or below it where all below is.
    fn holds(&self, directory: &Utf8Path, path: &Utf8Path) -> bool {
        match self.wanted.get(directory) {
            Some(RecursiveMode::Recursive) => path != directory && path.starts_with(directory),
            Some(RecursiveMode::NonRecursive) => path.parent() == Some(directory),
            None => false,
        }
    }

    /// What the session calls what an event names. A drawing may have two names: as an argument, and where paths are looked for.
    pub(super) fn own_names(&self, path: &Utf8Path) -> Vec<Utf8PathBuf> {
        let pairs = self.own_names.iter().filter(|[told, _]| self.holds(told, path));
        let own = pairs.filter_map(|[told, own]| Some(join(own, path.strip_prefix(told).ok()?)));
        let own: BTreeSet<Utf8PathBuf> = own.collect();
        if own.is_empty() { vec![path.to_owned()] } else { own.into_iter().collect() }
    }

    /// Whether after that event something else is to be watched than before it. Files that come and go are nothing of that kind, nor is what
    /// changes in a directory: programs may be written into it.
    pub(super) fn are_changed(&self, kind: EventKind, path: &Utf8Path, system: &dyn System) -> bool {
        if comes_or_goes(kind) {
            return self.names.contains(path);
        }
        self.refused.contains(path) && system.list(path).is_ok()
    }

    /// Whether all below a directory above is watched.
    fn is_below(&self, path: &Utf8Path) -> bool {
        let is_whole = |above: &Utf8Path| self.wanted.get(above) == Some(&RecursiveMode::Recursive);
        path.ancestors().skip(1).any(is_whole)
    }

    /// Watches a directory. Where one below cannot be listed, the others are watched one by one: it is told that it cannot be.
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
        // The directory itself is watched by now, since the system was asked for it before what lies below.
        for name in listing.directories.iter().filter(|_| mode == RecursiveMode::Recursive) {
            let below = join(directory, name);
            // A link may lead back.
            if seen.insert(system.canonical(&below)) {
                self.watch_one(source, system, &below, mode, seen)?;
            }
        }
        Ok(())
    }
}

/// The working directory has no name of its own.
fn spelt(directory: &Utf8Path) -> &Utf8Path {
    if directory.as_str().is_empty() { Utf8Path::new(".") } else { directory }
}

fn is_root(directory: &Utf8Path) -> bool {
    directory.has_root() && directory.parent().is_none()
}

fn comes_or_goes(kind: EventKind) -> bool {
    matches!(kind, EventKind::Create(_) | EventKind::Remove(_) | EventKind::Modify(ModifyKind::Name(_)))
}

/// Whether a directory cannot be listed, or is gone by now.
fn is_refusal(error: &notify::Error) -> bool {
    match &error.kind {
        ErrorKind::Io(reason) => {
            matches!(reason.kind(), io::ErrorKind::PermissionDenied | io::ErrorKind::NotFound)
        }
        ErrorKind::PathNotFound => true,
        _ => false,
    }
}

/// The directories to watch: those that hold drawings, those that are searched, that of the configuration, and those of the post. Also those
/// that are missing: they may come.
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
    // There may be paths of those names.
    if request.inputs.iter().any(|input| matches!(input, Input::Name(_))) {
        alone.push(Utf8Path::new(""));
    }
    let with = |mode| move |directory: &Utf8Path| (directory.to_owned(), mode);
    let whole = whole.into_iter().map(with(RecursiveMode::Recursive));
    whole.chain(alone.into_iter().map(with(RecursiveMode::NonRecursive))).collect()
}

/// A path as events name it.
pub(super) fn as_told(session: &Session<'_>, path: &Utf8Path) -> Utf8PathBuf {
    session.normal(&clean(&session.workspace().working_directory.join(path)))
}
