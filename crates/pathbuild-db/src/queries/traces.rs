//! Dependencies of a target. After an edit they tell a driver which targets to query again, and a cache whether a result is up to date.

use camino::Utf8PathBuf;
use pathbuild_path::PathName;
use rustc_hash::FxHashSet;

use super::closures::closure;
use super::embedding::embeds;
use super::index::NameKey;
use super::lookup::{find_path, own_directory, search_path};
use crate::db::Db;
use crate::inputs::{SourceFile, Target};

/// Everything outside of the settings that a target depends on.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Trace {
    /// The drawings that were read, starting with its own, including those that were searched without a match.
    pub files: Vec<SourceFile>,
    /// The names that were looked up, with the searched directories.
    pub lookups: Vec<NameLookup>,
}

/// A name that was looked up.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct NameLookup {
    /// The path.
    pub name: PathName,
    /// The directories.
    pub directories: Vec<Utf8PathBuf>,
}

/// The trace of a target. An edit outside of it cannot change the target's results.
#[salsa::tracked]
pub fn trace(db: &dyn Db, target: Target) -> Trace {
    let (mut files, mut lookups) = (UniqueList::default(), UniqueList::default());
    files.push(target.file(db));
    for reached in &closure(db, target).reached {
        let from = reached.instance.file(db);
        files.push(from);
        for name in embeds(db, reached.instance).iter().filter_map(|embedding| embedding.name.as_ref()) {
            let Some(resolved) = find_path(db, from, NameKey::of(db, name)) else { continue };
            resolved.searched.iter().for_each(|file| files.push(*file));
            let directories =
                search_path(db, own_directory(db, from)).iter().map(|directory| directory.path(db).clone());
            lookups.push(NameLookup { name: (**name).clone(), directories: directories.collect() });
        }
    }
    Trace { files: files.all, lookups: lookups.all }
}

/// A list without duplicates.
struct UniqueList<T> {
    all: Vec<T>,
    seen: FxHashSet<T>,
}

impl<T: Clone + Eq + std::hash::Hash> UniqueList<T> {
    fn push(&mut self, one: T) {
        if self.seen.insert(one.clone()) {
            self.all.push(one);
        }
    }
}

impl<T> Default for UniqueList<T> {
    fn default() -> Self {
        Self { all: Vec::new(), seen: FxHashSet::default() }
    }
}
