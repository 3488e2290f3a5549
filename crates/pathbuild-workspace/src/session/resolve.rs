//! Which drawings and paths the arguments mean. (spec/05-command-line.md)

use std::cell::LazyCell;
use std::collections::hash_map::Entry;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_cache::Listings;
use pathbuild_db::system::Kind;
use pathbuild_db::{Db, SourceFile, holders, path_names};
use pathbuild_diagnostic::messages::{outputs as messages, subpaths};
use pathbuild_diagnostic::{Diagnostic, Value};
use pathbuild_path::PathName;
use rayon::prelude::*;
use rustc_hash::{FxHashMap, FxHashSet};

use super::{Session, library};
use crate::inputs::{Input, Inputs};

/// What arguments come to.
#[derive(Debug, Default)]
pub struct Wanted {
    /// Drawings that were named, or lie in directories that were.
    pub drawings: Vec<WantedDrawing>,
    /// Paths that were named.
    pub paths: Vec<WantedPath>,
    /// Directories that were named; without arguments, those of the library.
    pub directories: Vec<Utf8PathBuf>,
    /// Names that mean nothing, or too much.
    pub problems: Vec<Diagnostic>,
    /// What is in directories that were looked through.
    pub listings: Listings,
    /// The directories that were looked through, each with whether there is a drawing in it or below.
    walked: Vec<(Utf8PathBuf, bool)>,
    /// Where each drawing stands in `drawings`.
    places: FxHashMap<SourceFile, usize>,
}

/// The drawings in directories.
#[derive(Debug, Default)]
pub struct Found {
    /// Each once, in order.
    pub drawings: Vec<Utf8PathBuf>,
    /// The directories themselves, and those below.
    pub directories: Vec<Utf8PathBuf>,
    /// What is in each directory, as far as it was looked at.
    pub listings: Listings,
    /// Directories that are not there, or hold no drawing.
    pub problems: Vec<Diagnostic>,
}

/// A drawing that was asked for.
#[derive(Clone, Copy, Debug)]
pub struct WantedDrawing {
    /// The drawing.
    pub file: SourceFile,
    /// Whether it was named itself, not the directory that it lies in.
    pub is_named: bool,
}

/// A path that was asked for by its name.
#[derive(Clone, Debug)]
pub struct WantedPath {
    /// The drawing that defines it.
    pub file: SourceFile,
    /// As the drawing spells it.
    pub name: PathName,
}

impl Session<'_> {
    /// What the arguments mean; without any, the library.
    pub fn wanted(&self, inputs: &Inputs) -> Wanted {
        let mut wanted = Wanted { problems: self.missing_directories(), ..Wanted::default() };
        let directories = LazyCell::new(|| self.name_directories());
        for input in inputs.iter() {
            match input {
                Input::Place(place) => self.add_place(place, &mut wanted),
                Input::Name(name) => self.add_name(name, &directories, &mut wanted),
            }
        }
        if inputs.inputs.is_empty() {
            for directory in &self.context.settings.general.library.value {
                self.add_directory(self.normal(directory), &mut wanted);
            }
        }
        if !wanted.problems.iter().any(Diagnostic::is_error) {
            wanted.problems.extend(Self::without_drawings(inputs, &wanted.walked));
        }
        wanted
    }

    /// Drawings that were found in directories, as what arguments mean.
    pub fn wanted_drawings(&self, drawings: Vec<Utf8PathBuf>) -> Wanted {
        let mut wanted = Wanted::default();
        wanted.add_drawings(self.db.files(drawings));
        wanted
    }

    /// Directories that were just listed need not be listed once more for their names, if nothing about them is in doubt.
    pub fn know_names(&self, listings: &Listings) {
        for (directory, listing) in listings.iter().filter(|(_, listing)| !listing.is_doubtful) {
            self.db.know_names(directory, listing.names.iter().collect());
        }
    }

    /// Whether a name is a drawing's.
    pub fn is_drawing(path: &Utf8Path) -> bool {
        library::is_drawing(path)
    }

    /// The drawings that arguments mean, if all of them are directories that can be walked through; without arguments, those of the
    /// library.
    pub fn directories_only(&self, inputs: &Inputs) -> Option<Found> {
        let directory = |input| match input {
            Input::Place(place) if self.is_directory(place) && !library::is_drawing(place) => {
                Some(self.normal(place))
            }
            Input::Name(name) if self.means_directory(name) => Some(self.normal(Utf8Path::new(name))),
            _ => None,
        };
        let directories: Vec<Utf8PathBuf> = if inputs.inputs.is_empty() {
            let library = self.context.settings.general.library.value.iter();
            library.map(|directory| self.normal(directory)).collect()
        } else {
            inputs.iter().map(directory).collect::<Option<_>>()?
        };
        let mut found = Found { problems: self.missing_directories(), ..Found::default() };
        let mut asked = Vec::new();
        for (walked, directory) in self.walked_each(&directories).into_iter().zip(directories) {
            if !walked.problems.is_empty() {
                return None;
            }
            asked.push((directory, !walked.drawings.is_empty()));
            found.drawings.extend(walked.drawings.into_iter().map(|drawing| self.normalised(drawing)));
            found.directories.extend(walked.directories.into_iter().map(|below| self.normalised(below)));
            let listed = walked.listings.into_iter();
            found.listings.extend(listed.map(|(directory, listing)| (self.normalised(directory), listing)));
        }
        found.drawings.sort_by(|a, b| library::by_place(a, b));
        found.drawings.dedup();
        if found.problems.is_empty() {
            found.problems = Self::without_drawings(inputs, &asked);
        }
        Some(found)
    }

    /// Whether the configuration says what to do without arguments.
    pub fn has_library(&self) -> bool {
        !self.context.settings.general.library.value.is_empty()
    }

    /// The drawings of the configured library.
    pub fn library(&self) -> Vec<Utf8PathBuf> {
        let directories = self.context.settings.general.library.value.iter();
        directories.flat_map(|directory| self.drawings_below(&self.normal(directory))).collect()
    }

    /// Every drawing that there is to know of: those of the library, or without one those in the working directory and below.
    pub fn everything(&self) -> Vec<SourceFile> {
        let drawings = if self.has_library() {
            self.library()
        } else {
            self.drawings_below(Utf8Path::new("")).collect()
        };
        drawings.iter().map(|drawing| self.file(drawing)).collect()
    }

    /// These directories and all below them, each once.
    pub fn directories_below(&self, directories: &[Utf8PathBuf]) -> Vec<Utf8PathBuf> {
        let below = self.walked_each(directories).into_iter().flat_map(|walked| walked.directories);
        distinct(below.map(|directory| self.normalised(directory)))
    }

    /// The drawings in a directory and below.
    pub fn drawings_below(&self, directory: &Utf8Path) -> impl Iterator<Item = Utf8PathBuf> + use<> {
        self.walked(directory).drawings.into_iter()
    }

    fn walked(&self, directory: &Utf8Path) -> library::Walked {
        self.walk().through(directory)
    }

    fn walked_each(&self, directories: &[Utf8PathBuf]) -> Vec<library::Walked> {
        let walk = self.walk();
        if walk.is_parallel && directories.len() > 1 {
            directories.par_iter().map(|directory| walk.through(directory)).collect()
        } else {
            directories.iter().map(|directory| walk.through(directory)).collect()
        }
    }

    fn walk(&self) -> library::Walk<'_> {
        let limits = &self.context.settings.limits;
        library::Walk {
            system: &*self.context.system,
            limit: limits.library_entries.value,
            rules_limit: limits.ignore_file_size.value,
            is_parallel: self.context.jobs != Some(1),
        }
    }

    /// What keeps the library, or without one the working directory, from being looked through.
    pub fn library_problems(&self) -> Vec<Diagnostic> {
        let library = &self.context.settings.general.library.value;
        let working_directory = Utf8PathBuf::new();
        let directories =
            if self.has_library() { library.as_slice() } else { std::slice::from_ref(&working_directory) };
        let problems = |directory: &Utf8PathBuf| self.walked(&self.normal(directory)).problems;
        directories.iter().flat_map(problems).collect()
    }

    fn add_place(&self, place: &Utf8Path, wanted: &mut Wanted) {
        let normal = self.normal(place);
        if self.is_directory(place) && !library::is_drawing(&normal) {
            self.add_directory(normal, wanted);
        } else {
            wanted.add_drawing(self.db.file(&normal), true);
        }
    }

    fn add_directory(&self, directory: Utf8PathBuf, wanted: &mut Wanted) {
        self.rouse_workers();
        let walked = self.walked(&directory);
        wanted.problems.extend(walked.problems);
        wanted.walked.push((directory.clone(), !walked.drawings.is_empty()));
        wanted.add_drawings(self.db.files(walked.drawings));
        wanted.listings.extend(walked.listings);
        wanted.directories.push(directory);
    }

    /// Whether a place is a directory.
    pub fn is_directory(&self, place: &Utf8Path) -> bool {
        self.db.system().kind(&self.normal(place)) == Kind::Directory
    }

    /// Whether a name without a separator means a directory: there is neither a path nor a drawing of that name.
    fn means_directory(&self, name: &str) -> bool {
        if !self.is_directory(Utf8Path::new(name)) {
            return false;
        }
        let directories = self.name_directories();
        self.definitions(&PathName::new(name), &directories).is_empty()
            && self.drawing_of_name(name, &directories).is_none()
    }

    fn add_name(&self, name: &str, directories: &[Utf8PathBuf], wanted: &mut Wanted) {
        match self.definitions(&PathName::new(name), directories).as_slice() {
            [] => match self.drawing_of_name(name, directories) {
                Some(drawing) => wanted.add_drawing(drawing, true),
                // `check components` is what people type; nothing else of that name was meant.
                None if self.is_directory(Utf8Path::new(name)) => self.add_place(Utf8Path::new(name), wanted),
                None => {
                    wanted.problems.extend(self.library_problems());
                    wanted.problems.push(nowhere(name, directories));
                }
            },
            [file] => {
                let spelt = path_names(&self.db, *file).iter().find(|known| **known == PathName::new(name));
                let name = spelt.cloned().unwrap_or_else(|| PathName::new(name));
                wanted.paths.push(WantedPath { file: *file, name });
            }
            [first, second, ..] => {
                let problem = Diagnostic::new(&subpaths::DEFINED_TWICE)
                    .with("name", name)
                    .with("first", first.path(&self.db).as_str())
                    .with("second", second.path(&self.db).as_str());
                wanted.problems.push(problem.in_file(first.path(&self.db)));
            }
        }
    }

    /// Where names are looked for: the working directory, the search directories, the library and what is below it.
    pub fn name_directories(&self) -> Vec<Utf8PathBuf> {
        let searched = self.context.settings.general.search.value.iter();
        let searched = searched.map(|directory| self.normal(directory));
        distinct(std::iter::once(Utf8PathBuf::new()).chain(searched).chain(self.library_directories()))
    }

    /// The directories of the library that hold drawings.
    pub fn library_directories(&self) -> Vec<Utf8PathBuf> {
        let drawings = self.library().into_iter();
        distinct(drawings.filter_map(|drawing| drawing.parent().map(|directory| self.normal(directory))))
    }

    /// The drawings in some directories that define a path, each once.
    pub fn definitions(&self, name: &PathName, directories: &[Utf8PathBuf]) -> Vec<SourceFile> {
        let mut files: Vec<SourceFile> = Vec::new();
        let mut seen = FxHashSet::default();
        for directory in directories {
            for file in holders(&self.db, self.db.directory(directory), name) {
                let canonical = self.db.system().canonical(file.path(&self.db));
                if seen.insert(canonical) {
                    files.push(file);
                }
            }
        }
        files
    }

    fn drawing_of_name(&self, name: &str, directories: &[Utf8PathBuf]) -> Option<SourceFile> {
        directories.iter().find_map(|directory| {
            let is_meant = |file: &&str| {
                let file = Utf8Path::new(file);
                file.file_stem() == Some(name) && library::is_drawing(file)
            };
            let listed = self.db.system().list(directory).ok()?;
            // In whatever case the extension is: of several the first.
            let file = listed.files.iter().filter(is_meant).min()?;
            Some(self.file(&directory.join(file)))
        })
    }
}

impl Wanted {
    /// Adds drawings that lie in a directory.
    fn add_drawings(&mut self, files: Vec<SourceFile>) {
        self.drawings.reserve(files.len());
        self.places.reserve(files.len());
        for file in files {
            self.add_drawing(file, false);
        }
    }

    fn add_drawing(&mut self, file: SourceFile, is_named: bool) {
        match self.places.entry(file) {
            Entry::Occupied(known) => self.drawings[*known.get()].is_named |= is_named,
            Entry::Vacant(place) => {
                place.insert(self.drawings.len());
                self.drawings.push(WantedDrawing { file, is_named });
            }
        }
    }
}

fn nowhere(name: &str, directories: &[Utf8PathBuf]) -> Diagnostic {
    let shown = |directory: &Utf8PathBuf| {
        if directory.as_str().is_empty() { ".".to_owned() } else { directory.to_string() }
    };
    let directories: Value = directories.iter().map(shown).collect();
    Diagnostic::new(&messages::NO_SUCH_PATH).with("name", name).with("directories", directories)
}

/// Each of them once, in their order.
fn distinct(directories: impl Iterator<Item = Utf8PathBuf>) -> Vec<Utf8PathBuf> {
    let mut seen = FxHashSet::default();
    directories.filter(|directory| seen.insert(directory.clone())).collect()
}
