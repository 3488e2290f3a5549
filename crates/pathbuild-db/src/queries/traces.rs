//! What a target was made from: by which a driver knows after an edit which targets to ask again, and a cache whether a result is up to date.

use camino::Utf8PathBuf;
use pathbuild_path::PathName;
use rustc_hash::FxHashSet;

use super::closures::closure;
use super::embedding::embeds;
use super::index::NameKey;
use super::lookup::{find_path, own_directory, search_path};
use crate::db::Db;
use crate::inputs::{SourceFile, Target};

/// Everything outside that a target depends on, besides the settings.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Trace {
    /// The drawings that were read, its own first: those that it reaches, and those that were searched in vain.
    pub files: Vec<SourceFile>,
    /// The paths that were looked for by name, each with the directories that were asked for files that may hold it.
    pub lookups: Vec<Sought>,
}

/// A path that was looked for.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Sought {
    /// The path.
    pub name: PathName,
    /// The directories.
    pub directories: Vec<Utf8PathBuf>,
}

/// The trace of a target. An edit outside it does not change what comes of the target.
#[salsa::tracked]
pub fn trace(db: &dyn Db, target: Target) -> Trace {
    let (mut files, mut lookups) = (Distinct::default(), Distinct::default());
    files.push(target.file(db));
    for reached in &closure(db, target).reached {
        let from = reached.instance.file(db);
        files.push(from);
        for name in embeds(db, reached.instance).iter().filter_map(|embedding| embedding.name.as_ref()) {
            let Some(resolved) = find_path(db, from, NameKey::of(db, name)) else { continue };
            resolved.searched.iter().for_each(|file| files.push(*file));
            let directories = search_path(db, own_directory(db, from)).iter().map(|it| it.path(db).clone());
            lookups.push(Sought { name: (**name).clone(), directories: directories.collect() });
        }
    }
    Trace { files: files.all, lookups: lookups.all }
}

/// A list of things, each once.
struct Distinct<T> {
    all: Vec<T>,
    seen: FxHashSet<T>,
}

impl<T: Clone + Eq + std::hash::Hash> Distinct<T> {
    fn push(&mut self, one: T) {
        if self.seen.insert(one.clone()) {
            self.all.push(one);
        }
    }
}

impl<T> Default for Distinct<T> {
    fn default() -> Self {
        Self { all: Vec::new(), seen: FxHashSet::default() }
    }
}
