//! What a target was made from: by which a driver knows after an edit which targets to ask again, and a cache whether a result still holds.

use camino::Utf8PathBuf;
use pathbuild_path::PathName;

use super::embedding::embeds;
use super::instance::Instance;
use super::lookup::{Found, find_path};
use super::raw::NameKey;
use super::reach::closure;
use crate::database::Db;
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
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sought {
    /// The path.
    pub name: PathName,
    /// The directories.
    pub directories: Vec<Utf8PathBuf>,
}

/// The trace of a target. An edit outside it does not change what comes of the target.
#[salsa::tracked]
pub fn trace(db: &dyn Db, target: Target) -> Trace {
    let mut trace = Trace { files: vec![target.file(db)], lookups: Vec::new() };
    for reached in &closure(db, target).reached {
        trace.add(db, reached.instance);
    }
    trace
}

impl Trace {
    fn add(&mut self, db: &dyn Db, instance: Instance<'_>) {
        let from = instance.file(db);
        self.add_file(from);
        for name in embeds(db, instance).iter().filter_map(|embedding| embedding.name.as_ref()) {
            self.add_found(db, name, &find_path(db, from, NameKey::of(db, name)));
        }
    }

    /// Adds what was looked for.
    pub(super) fn add_found(&mut self, db: &dyn Db, name: &PathName, found: &Found) {
        for file in &found.searched {
            self.add_file(*file);
        }
        if !found.directories.is_empty() {
            let directories = found.directories.iter().map(|directory| directory.path(db).clone());
            let sought = Sought { name: name.clone(), directories: directories.collect() };
            if !self.lookups.contains(&sought) {
                self.lookups.push(sought);
            }
        }
    }

    fn add_file(&mut self, file: SourceFile) {
        if !self.files.contains(&file) {
            self.files.push(file);
        }
    }
}
