//! Finds the files and directories that arguments may refer to, as the first step of resolving arguments. This step looks at file names alone; it
//! reads drawings only to match patterns of path names. (book: reference/commands)
//!
//! Directories are also listed, and drawings read, before they are needed: listing a directory of ten thousand drawings takes longer than building a
//! program from ten of them, so the drawings that are most likely embedded are read in the meantime.

use std::collections::HashSet;
use std::ops::ControlFlow;
use std::thread::Builder;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_cache::Listings;
use pathbuild_db::system::{Entry, FileKind, is_drawing, join};
use pathbuild_db::{
    Db as _, Directory, PendingListing, SourceFile, candidate_files, catch_bugs, drawing_names, likely_file,
    prefetch, search_path,
};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::outputs as messages;
use pathbuild_path::PathName;
use rayon::prelude::*;
use rustc_hash::FxHashSet;

use super::library::FileFilter;
use super::{Session, library, no_drawing_error};
use crate::config::types::Pattern;
use crate::inputs::{Input, Inputs};

/// The files and directories that the arguments may refer to.
#[derive(Debug, Default)]
pub struct ArgumentMatches {
    /// The matches of each argument; without arguments, the directories of the library.
    pub arguments: Vec<Argument>,
    /// Whether there are no arguments, which selects the library.
    pub is_library: bool,
    /// Contents of the directories that were listed.
    pub listings: Listings,
    /// Diagnostics of configured directories that do not exist, of directories that cannot be queried, and of patterns that match no path.
    pub problems: Vec<Diagnostic>,
    /// Directories in which names were searched for; empty if no argument is a name.
    pub(super) name_directories: Vec<Utf8PathBuf>,
    /// Errors while searching the library for names.
    pub(super) name_problems: Vec<Diagnostic>,
}

/// The files or the directory that one argument may refer to.
#[derive(Debug)]
pub enum Argument {
    /// A directory with the drawings in and below it.
    Directory(SearchedDirectory),
    /// A drawing, identified by its file, which need not exist.
    Drawing(SourceFile),
    /// A name without a separator. It refers to the first of these that exists: a path, a drawing without its `.dxf`, or a directory.
    Name {
        /// The name as the user wrote it.
        name: PathName,
        /// Drawings that may define the path, judging by their file names.
        candidates: Vec<SourceFile>,
        /// The drawing with this file name plus `.dxf`.
        drawing: Option<SourceFile>,
        /// The directory with this name.
        directory: Option<SearchedDirectory>,
    },
}

/// A directory that was searched recursively.
#[derive(Debug)]
pub struct SearchedDirectory {
    /// Path of the directory.
    pub path: Utf8PathBuf,
    /// All drawings in and below the directory, sorted.
    pub drawings: Vec<Utf8PathBuf>,
    /// The directory itself and all below it.
    pub directories: Vec<Utf8PathBuf>,
    /// Errors for directories that cannot be listed or contain too many entries.
    pub problems: Vec<Diagnostic>,
}

impl ArgumentMatches {
    /// Returns the directories that the arguments may refer to.
    pub fn directories(&self) -> impl Iterator<Item = &SearchedDirectory> {
        self.arguments.iter().filter_map(Argument::directory)
    }

    /// Returns the names of the arguments that may be paths, and of the paths that match a pattern.
    pub fn names(&self) -> impl Iterator<Item = &PathName> {
        self.arguments.iter().filter_map(|argument| match argument {
            Argument::Name { name, .. } => Some(name),
            Argument::Drawing(_) | Argument::Directory(_) => None,
        })
    }

    /// Returns the drawings that were named, or that may define a named path.
    pub fn named_drawings(&self) -> impl Iterator<Item = SourceFile> {
        let named = self.arguments.iter().filter_map(|argument| match argument {
            Argument::Drawing(file) => Some(*file),
            Argument::Name { drawing, .. } => *drawing,
            Argument::Directory(_) => None,
        });
        named.chain(self.candidates())
    }

    /// Returns the drawings that may define a named path.
    pub fn candidates(&self) -> impl Iterator<Item = SourceFile> {
        let candidates = self.arguments.iter().filter_map(|argument| match argument {
            Argument::Name { candidates, .. } => Some(candidates),
            Argument::Drawing(_) | Argument::Directory(_) => None,
        });
        candidates.flatten().copied()
    }
}

impl Argument {
    fn is_unknown(&self) -> bool {
        matches!(self, Self::Name { candidates, drawing: None, directory: None, .. } if candidates.is_empty())
    }

    fn directory(&self) -> Option<&SearchedDirectory> {
        match self {
            Self::Directory(directory) => Some(directory),
            Self::Name { directory, .. } => directory.as_ref(),
            Self::Drawing(_) => None,
        }
    }
}

impl Session<'_> {
    /// Finds the files and directories that the arguments may refer to; without arguments, those of the library.
    pub fn match_arguments(&self, inputs: &Inputs) -> ArgumentMatches {
        let is_library = inputs.inputs.is_empty();
        let mut found = ArgumentMatches {
            problems: self.missing_directories(),
            is_library,
            ..ArgumentMatches::default()
        };
        if is_library {
            let library = self.walk_library(&mut found.listings);
            found.arguments = library.into_iter().map(Argument::Directory).collect();
            return found;
        }
        if inputs.iter().any(|input| matches!(input, Input::Name(_))) {
            (found.name_directories, found.name_problems) = self.listed_name_directories(&mut found.listings);
        }
        for input in inputs.iter() {
            match input {
                Input::Place(place) => {
                    let places = self.expand_pattern(place, &is_drawing);
                    let argument = |place: &Utf8PathBuf| self.match_place(place, &mut found.listings);
                    found.arguments.extend(places.iter().map(argument));
                }
                Input::Name(name) => {
                    let argument = self.match_name(name, &mut found);
                    match argument.is_unknown().then(|| pattern_of(name)).flatten() {
                        Some(pattern) => self.add_matching_paths(&pattern, &mut found),
                        None => found.arguments.push(argument),
                    }
                }
            }
        }
        found
    }

    /// Expands a pattern that the shell passed on unexpanded, as Windows shells do. The last component of the pattern is matched with the names of
    /// directories and of files that `is_wanted` accepts. Returns `place` itself if a file with exactly that name exists, or if nothing matches.
    pub(super) fn expand_pattern(&self, place: &Utf8Path, is_wanted: FileFilter<'_>) -> Vec<Utf8PathBuf> {
        let pattern = place.file_name().and_then(pattern_of);
        let is_missing = || self.db.system().kind(&self.normalize(place)) == FileKind::Missing;
        let Some(pattern) = pattern.filter(|_| is_missing()) else { return vec![place.to_owned()] };
        let directory = place.parent().unwrap_or(Utf8Path::new(""));
        let entries = self.entries(&self.normalize(directory), is_wanted).into_iter();
        let matching = entries.filter(|name| pattern.matches(name)).map(|name| join(directory, name));
        let matching: Vec<Utf8PathBuf> = matching.collect();
        if matching.is_empty() { vec![place.to_owned()] } else { matching }
    }

    /// Adds the paths of the library with names that match a pattern, and the errors of drawings without any known path, because these may contain
    /// such paths.
    fn add_matching_paths(&self, pattern: &Pattern, found: &mut ArgumentMatches) {
        let paths = self.paths_of_library(usize::MAX);
        let (files, problems) = self.all_drawings();
        if !self.has_library() {
            found.problems.extend(problems);
        }
        let known: FxHashSet<SourceFile> = paths.iter().map(|(_, file)| *file).collect();
        let unknown = files.into_iter().filter(|file| !known.contains(file));
        found.problems.extend(unknown.flat_map(|file| self.errors_without_paths(file)).cloned());
        let matching = paths.into_iter().filter(|(name, _)| pattern.matches(name.as_str()));
        let before = found.arguments.len();
        for (path, file) in matching {
            match &mut found.arguments[before..] {
                [.., Argument::Name { name, candidates, .. }] if *name == path => candidates.push(file),
                _ => found.arguments.push(Argument::Name {
                    name: path,
                    candidates: vec![file],
                    drawing: None,
                    directory: None,
                }),
            }
        }
        if found.arguments.len() == before {
            found.problems.push(Diagnostic::new(&messages::NO_PATH_LIKE).quoting("name", pattern.text()));
        }
    }

    fn match_place(&self, place: &Utf8Path, listings: &mut Listings) -> Argument {
        if self.is_directory(place) && !is_drawing(place) {
            return Argument::Directory(self.search_directory(self.normalize(place), listings));
        }
        Argument::Drawing(self.file(place))
    }

    fn match_name(&self, name: &str, found: &mut ArgumentMatches) -> Argument {
        let directories = &found.name_directories;
        let path = PathName::new(name);
        let mut candidates = Vec::new();
        for directory in directories {
            match self.query_directory(directory, |directory| candidate_files(&self.db, directory, &path)) {
                Ok(files) => candidates.extend(files),
                Err(problem) => found.problems.push(*problem),
            }
        }
        let drawing = self.drawing_of_name(name, directories);
        let place = Utf8Path::new(name);
        let directory = self
            .is_directory(place)
            .then(|| self.search_directory(self.normalize(place), &mut found.listings));
        Argument::Name { name: path, candidates, drawing, directory }
    }

    /// Finds the drawing with the file name `name` plus an extension, in the first directory that contains one; if there are several, the first by
    /// name.
    fn drawing_of_name(&self, name: &str, directories: &[Utf8PathBuf]) -> Option<SourceFile> {
        directories.iter().find_map(|directory| {
            let is_meant = |file: &&str| file.rsplit_once('.').is_some_and(|(stem, _)| stem == name);
            let names = drawing_names(&self.db, self.db.directory(directory));
            Some(self.file(&join(directory, names.iter().filter(is_meant).min()?)))
        })
    }

    fn search_directory(&self, directory: Utf8PathBuf, listings: &mut Listings) -> SearchedDirectory {
        self.start_workers();
        let walked = self.walk(&is_drawing).search(&directory);
        self.found_directory(directory, walked, listings)
    }

    fn found_directory(
        &self,
        path: Utf8PathBuf,
        walked: library::WalkResult,
        listings: &mut Listings,
    ) -> SearchedDirectory {
        let listed = walked.listings.into_iter();
        listings.extend(listed.map(|(directory, listing)| (self.normalize_owned(directory), listing)));
        let normalised =
            |paths: Vec<Utf8PathBuf>| paths.into_iter().map(|path| self.normalize_owned(path)).collect();
        let (drawings, directories) = (normalised(walked.drawings), normalised(walked.directories));
        SearchedDirectory { path, drawings, directories, problems: walked.problems }
    }

    /// Searches the directories of the library. A directory without any entry is an error (PB518), because it may be a share that is not mounted or a
    /// submodule that was not checked out.
    fn walk_library(&self, listings: &mut Listings) -> Vec<SearchedDirectory> {
        let library = self.context.settings.general.library.value.iter();
        let library: Vec<Utf8PathBuf> = library.map(|directory| self.normalize(directory)).collect();
        let walk = self.walk(&is_drawing);
        let walked: Vec<library::WalkResult> = if walk.is_parallel && library.len() > 1 {
            library.par_iter().map(|directory| walk.search(directory)).collect()
        } else {
            library.iter().map(|directory| walk.search(directory)).collect()
        };
        let each = library.into_iter().zip(walked);
        let found = each.map(|(path, walked)| self.found_directory(path, walked, listings));
        let with_problem = |mut found: SearchedDirectory| {
            if found.drawings.is_empty() && self.is_empty_directory(&found.path) {
                found.problems.push(no_drawing_error(&[&found.path]));
            }
            found
        };
        found.map(with_problem).collect()
    }

    fn is_empty_directory(&self, directory: &Utf8Path) -> bool {
        let mut is_empty = true;
        let mut take = |_: Entry<'_>| {
            is_empty = false;
            ControlFlow::Break(())
        };
        matches!(catch_bugs(|| self.db.system().each_entry(directory, &mut take)), Ok(Ok(()))) && is_empty
    }

    /// Returns the directories in which names are searched for: the working directory, the search directories, and the directories of the library
    /// that contain drawings.
    pub fn name_directories(&self) -> Vec<Utf8PathBuf> {
        self.listed_name_directories(&mut Listings::new()).0
    }

    /// Like [`name_directories`](Self::name_directories), with the errors of searching the library.
    fn listed_name_directories(&self, listings: &mut Listings) -> (Vec<Utf8PathBuf>, Vec<Diagnostic>) {
        let searched = self.context.settings.general.search.value.iter();
        let searched = searched.map(|directory| self.normalize(directory));
        let walked = self.walk_library(listings);
        let library = directories_with_drawings(&walked);
        self.provide_names(listings);
        let directories = distinct(std::iter::once(Utf8PathBuf::new()).chain(searched).chain(library));
        (directories, walked.into_iter().flat_map(|directory| directory.problems).collect())
    }

    /// Returns the directories of the library that contain drawings.
    pub fn library_directories(&self) -> Vec<Utf8PathBuf> {
        directories_with_drawings(&self.walk_library(&mut Listings::new()))
    }

    /// Returns the drawings of the configured library, and errors while listing it.
    pub fn library(&self) -> (Vec<Utf8PathBuf>, Vec<Diagnostic>) {
        let (mut drawings, mut problems) = (Vec::new(), Vec::new());
        for mut directory in self.walk_library(&mut Listings::new()) {
            drawings.append(&mut directory.drawings);
            problems.append(&mut directory.problems);
        }
        (drawings, problems)
    }

    /// Whether a result of [`library`](Self::library) has drawings and is complete: all of its directories exist and were listed.
    pub(crate) fn is_whole_library(
        &self,
        (drawings, problems): &(Vec<Utf8PathBuf>, Vec<Diagnostic>),
    ) -> bool {
        !drawings.is_empty() && problems.is_empty() && self.missing_directories().is_empty()
    }

    /// Returns the names of all drawings in the directories of the library, including drawings that ignore files exclude.
    pub fn names_in_library(&self) -> impl Iterator<Item = Box<str>> + use<> {
        let mut listings = Listings::new();
        self.walk_library(&mut listings);
        listings.into_values().flat_map(|listing| listing.names)
    }

    /// Returns all known drawings: those of the library, or without a library those in and below the working directory. Also returns errors while
    /// listing them.
    pub fn all_drawings(&self) -> (Vec<SourceFile>, Vec<Diagnostic>) {
        let (drawings, problems) = if self.has_library() {
            self.library()
        } else {
            let walked = self.walk(&is_drawing).search(Utf8Path::new(""));
            (walked.drawings, walked.problems)
        };
        (drawings.iter().map(|drawing| self.file(drawing)).collect(), problems)
    }

    /// Returns the drawings in and below a directory.
    pub fn drawings_below(&self, directory: &Utf8Path) -> impl Iterator<Item = Utf8PathBuf> + use<> {
        self.walk(&is_drawing).search(directory).drawings.into_iter()
    }

    /// Passes the names of freshly listed directories to the database, so that it need not list them again. Listings that are incomplete or contain
    /// symbolic links are left out.
    pub fn provide_names(&self, listings: &Listings) {
        for (directory, listing) in
            listings.iter().filter(|(_, listing)| !listing.is_doubtful && listing.links.is_empty())
        {
            self.db.provide_names(directory, listing.names.iter().map(|name| &**name).collect());
        }
    }

    /// Whether the configuration names a library, so that commands work without arguments.
    pub fn has_library(&self) -> bool {
        self.context.has_library()
    }

    /// Whether the path is an existing directory.
    pub fn is_directory(&self, place: &Utf8Path) -> bool {
        self.db.system().kind(&self.normalize(place)) == FileKind::Directory
    }

    pub(super) fn walk<'w>(&'w self, is_wanted: FileFilter<'w>) -> library::Walk<'w> {
        let limits = &self.context.settings.limits;
        library::Walk {
            system: &*self.context.system,
            limit: limits.library_entries.value,
            rules_limit: limits.ignore_file_size.value,
            is_parallel: self.context.jobs != Some(1),
            is_wanted,
            obeys_git: true,
            top: self.context.settings.directory(),
            working_directory: &self.context.working_directory,
        }
    }
}

fn pattern_of(name: &str) -> Option<Pattern> {
    name.contains(['*', '?', '[']).then(|| Pattern::new(name).ok()).flatten()
}

fn directories_with_drawings(walked: &[SearchedDirectory]) -> Vec<Utf8PathBuf> {
    let drawings = walked.iter().flat_map(|directory| &directory.drawings);
    let parents = drawings.filter_map(|drawing| drawing.parent());
    let mut seen = FxHashSet::default();
    parents.filter(|directory| seen.insert(*directory)).map(Utf8Path::to_owned).collect()
}

/// Removes duplicates, keeping the order.
fn distinct(directories: impl Iterator<Item = Utf8PathBuf>) -> Vec<Utf8PathBuf> {
    let mut seen = FxHashSet::default();
    directories.filter(|directory| seen.insert(directory.clone())).collect()
}

impl Session<'_> {
    /// Starts listing the directories that named drawings and paths need, and reads the drawings that are most likely needed. Drawings with
    /// a cached result are skipped, since they have probably not changed.
    pub fn prefetch(&self, inputs: &Inputs, is_known: &dyn Fn(SourceFile) -> bool) {
        // Bugs are ignored here: the query that needs the drawing will report them.
        _ = self.db.run_guarded(self.limit(), || self.prefetch_likely(inputs, is_known));
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

    /// Returns the drawing that an argument most likely refers to, and the directory from which paths are searched for; `None` if no names are
    /// needed, or if a recursive search lists the directories anyway.
    fn likely_drawing(
        &self,
        input: Input<'_>,
        is_known: &dyn Fn(SourceFile) -> bool,
    ) -> Option<(Option<SourceFile>, Directory)> {
        match input {
            Input::Place(place) if is_drawing(place) => {
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

    /// Lists directories on a separate thread. If the system has no thread left, the queries that need the names list them.
    fn list_ahead(&self, directories: &[Directory]) {
        let pending: Vec<PendingListing> =
            directories.iter().map(|directory| self.db.list_ahead(directory.path(&self.db))).collect();
        if !pending.is_empty() {
            let list = move || pending.into_iter().for_each(PendingListing::run);
            _ = Builder::new().name("listing".into()).spawn(list);
        }
    }
}
