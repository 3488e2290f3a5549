//! Listing directories and reading drawings before they are needed. To list a directory of ten thousand drawings takes longer than to make the
//! program of a project out of ten of them, so the drawings that it most likely embeds are read meanwhile.

use std::collections::HashSet;
use std::thread::Builder;

use camino::Utf8Path;
use pathbuild_db::{Db as _, Directory, PendingListing, SourceFile, likely_file, prefetch, search_path};

use super::Session;
use crate::inputs::{Input, Inputs};

impl Session<'_> {
    /// Begins to list the directories that named drawings and paths need, and reads the drawings that are most likely needed.
    /// Those of which something is known from an earlier run are likely to be as they were.
    pub fn prefetch(&self, inputs: &Inputs, is_known: &dyn Fn(SourceFile) -> bool) {
        // A bug that this shows is left to whoever wants what is read here.
        _ = self.db.guarded(self.limit(), || self.prefetch_likely(inputs, is_known));
    }

    fn prefetch_likely(&self, inputs: &Inputs, is_known: &dyn Fn(SourceFile) -> bool) {
        let mut known = HashSet::new();
        for input in inputs.iter() {
            let Some((file, directory)) = self.likely_drawing(input, is_known) else { continue };
            let directories = search_path(&self.db, directory).iter();
            let new: Vec<Directory> =
                directories.copied().filter(|directory| known.insert(*directory)).collect();
            self.list_ahead(&new);
            if let Some(file) = file {
                prefetch(&self.db, file);
            }
        }
    }

    /// The drawing that an argument most likely means, and the directory in which paths are looked for; `None` where no names are needed,
    /// or a walk through directories lists them.
    fn likely_drawing(
        &self,
        input: Input<'_>,
        is_known: &dyn Fn(SourceFile) -> bool,
    ) -> Option<(Option<SourceFile>, Directory)> {
        match input {
            Input::Place(place) if Self::is_drawing(place) => {
                let file = Some(self.file(place)).filter(|file| !is_known(*file))?;
                let directory = self.db.directory(file.path(&self.db).parent().unwrap_or(Utf8Path::new("")));
                pathbuild_db::embeds_others(&self.db, file).then_some((Some(file), directory))
            }
            Input::Place(_) => None,
            Input::Name(_) if self.has_library() => None,
            Input::Name(name) => {
                let directory = self.db.directory(Utf8Path::new(""));
                let file = likely_file(&self.db, directory, name);
                (!file.is_some_and(is_known)).then_some((file, directory))
            }
        }
    }

    /// Lists directories on a thread of its own. Where the system has no thread left, the queries that want the names list them.
    fn list_ahead(&self, directories: &[Directory]) {
        let pending: Vec<PendingListing> =
            directories.iter().map(|directory| self.db.list_ahead(directory.path(&self.db))).collect();
        if !pending.is_empty() {
            let list = move || pending.into_iter().for_each(PendingListing::run);
            _ = Builder::new().name("listing".into()).spawn(list);
        }
    }
}
