//! Lists directories and reads drawings before they are needed. Listing a directory of ten thousand drawings takes longer than building a
//! program from ten of them, so the drawings that are most likely embedded are read in the meantime.

use std::collections::HashSet;
use std::thread::Builder;

use camino::Utf8Path;
use pathbuild_db::{Db as _, Directory, PendingListing, SourceFile, likely_file, prefetch, search_path};

use super::Session;
use crate::inputs::{Input, Inputs};

impl Session<'_> {
    /// Starts listing the directories that named drawings and paths need, and reads the drawings that are most likely needed. Drawings with
    /// a cached result are skipped, since they have probably not changed.
    pub fn prefetch(&self, inputs: &Inputs, is_known: &dyn Fn(SourceFile) -> bool) {
        // Bugs are ignored here: the query that needs the drawing will report them.
        _ = self.db.guarded(self.limit(), || self.prefetch_likely(inputs, is_known));
    }

    fn prefetch_likely(&self, inputs: &Inputs, is_known: &dyn Fn(SourceFile) -> bool) {
        let mut listed = HashSet::new();
        for input in inputs.iter() {
            let Some((file, directory)) = self.likely_drawing(input, is_known) else { continue };
            let directories = search_path(&self.db, directory).iter();
            let new: Vec<Directory> =
                directories.copied().filter(|directory| listed.insert(*directory)).collect();
            self.list_ahead(&new);
            if let Some(file) = file {
                prefetch(&self.db, file);
            }
        }
    }

    /// The drawing that an argument most likely refers to, and the directory from which paths are searched for; `None` if no names are
    /// needed, or if a recursive search lists the directories anyway.
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

    /// Lists directories on a thread of its own. If the system has no thread left, the queries that need the names list them.
    fn list_ahead(&self, directories: &[Directory]) {
        let pending: Vec<PendingListing> =
            directories.iter().map(|directory| self.db.list_ahead(directory.path(&self.db))).collect();
        if !pending.is_empty() {
            let list = move || pending.into_iter().for_each(PendingListing::run);
            _ = Builder::new().name("listing".into()).spawn(list);
        }
    }
}
