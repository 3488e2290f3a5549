//! Drawings with several names: symbolic links and hard links. An event has the name through which a file was changed, if that name is watched.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::System;
use pathbuild_db::system::{FileKind, FileLink};

/// Links among the dependencies of the results. Paths are spelt as in events.
#[derive(Default)]
pub(super) struct Links {
    /// Linked drawings by each path that determines their content.
    by_place: BTreeMap<Utf8PathBuf, BTreeSet<Utf8PathBuf>>,
    /// The reverse of `by_place`, for removing a drawing.
    places: HashMap<Utf8PathBuf, Vec<Utf8PathBuf>>,
    /// Hard links by device and inode number.
    by_file: HashMap<[u64; 2], BTreeSet<Utf8PathBuf>>,
    /// The reverse of `by_file`.
    files: HashMap<Utf8PathBuf, [u64; 2]>,
}

/// A path to watch for a linked drawing.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum LinkPlace {
    /// A symbolic link on the way, or the file at the end.
    Name(Utf8PathBuf),
    /// A symbolic link to a directory on the way.
    Directory(Utf8PathBuf),
    /// A file with hard links, through any of which it may be written.
    File(Utf8PathBuf),
}

/// Upper bound for the number of links on the way to a file, as on Linux.
const MAX_LINKS: usize = 40;

impl Links {
    /// Resolves a drawing's links anew and returns the paths to watch. `as_event` spells an absolute path as in events.
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
            for name in trail(system, &working_directory.join(drawing)) {
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

    /// Linked drawings whose content may differ after a change at this path.
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

/// The symbolic links on the way of an absolute path, and last the path with all of them resolved.
pub(super) fn trail(system: &dyn System, path: &Utf8Path) -> Vec<Utf8PathBuf> {
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
