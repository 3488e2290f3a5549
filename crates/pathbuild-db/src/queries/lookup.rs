//! Where paths are: file names to files. (spec/20-paths-and-files.md)

use std::borrow::Cow;
use std::cell::{LazyCell, OnceCell};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_path::{PathKey, PathName};

use super::names::{EXTENSION, NameTable, joined, name_table};
use super::raw::{NameKey, defines, path_names};
use crate::database::Db;
use crate::inputs::{Directory, Insight, SourceFile};
use crate::settings::Settings;
use crate::system::Kind;

/// Where a path is, or where it was looked for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Found {
    /// The files that define it. One is right, none or several are errors.
    pub files: Vec<SourceFile>,
    /// The files that may hold it by their names.
    pub searched: Vec<SourceFile>,
    /// The directories that were looked through.
    pub directories: Vec<Directory>,
}

/// Where a path is that a drawing refers to: in itself, else in any file of its directory and the search directories.
pub fn find_path<'db>(db: &'db dyn Db, from: SourceFile, name: NameKey<'db>) -> Cow<'db, Found> {
    if db.is_surveying() {
        // What is asked once need not be kept.
        Cow::Owned(Search::new(db, from, path_names(db, from)).find(&name.name(db)))
    } else {
        Cow::Borrowed(query::find_path(db, from, name))
    }
}

/// As they are asked where drawings are not surveyed.
mod query {
    use super::{Found, Place, Search, files_of};
    use crate::database::Db;
    use crate::inputs::{Directory, SourceFile};
    use crate::queries::raw::{NameKey, path_names};

    #[salsa::tracked]
    pub(super) fn find_path<'db>(db: &'db dyn Db, from: SourceFile, name: NameKey<'db>) -> Found {
        let files = |place: &Place<'_>| files_for(db, place.directory, name).clone();
        Search::new(db, from, path_names(db, from)).find_among(&name.name(db), files)
    }

    /// The files of a directory that may hold a path by their names: unchanged by files that cannot.
    #[salsa::tracked]
    fn files_for<'db>(db: &'db dyn Db, directory: Directory, name: NameKey<'db>) -> Vec<SourceFile> {
        files_of(db, directory, name.folded(db))
    }
}

/// Where paths are looked for that a drawing refers to.
pub(super) struct Search<'db> {
    db: &'db dyn Db,
    from: SourceFile,
    /// The paths of the drawing itself.
    own: &'db [PathName],
    places: Vec<Place<'db>>,
}

/// A directory that is looked through.
struct Place<'db> {
    directory: Directory,
    /// The names in it, once they are wanted.
    names: OnceCell<&'db NameTable>,
}

impl<'db> Search<'db> {
    /// `own`: the paths of that drawing.
    pub(super) fn new(db: &'db dyn Db, from: SourceFile, own: &'db [PathName]) -> Self {
        let directories = search_directories(db, from);
        let place = |path: &Utf8PathBuf| Place { directory: db.directory(path), names: OnceCell::new() };
        Self { db, from, own, places: directories.iter().map(place).collect() }
    }

    /// Where a path is; nothing of it is kept.
    pub(super) fn find(&self, name: &PathName) -> Found {
        let pattern = &Settings::get(self.db).language(self.db).path_pattern;
        let key = LazyCell::new(|| PathKey::new(&name.folded(), pattern));
        self.find_among(name, |place| {
            let names = || place.names.get_or_init(|| name_table(self.db, place.directory));
            key.as_ref().map(|key| names().files(self.db, place.directory, key)).unwrap_or_default()
        })
    }

    /// The same, when it is known which files of a directory may hold it by their names.
    fn find_among(&self, name: &PathName, files: impl Fn(&Place<'db>) -> Vec<SourceFile>) -> Found {
        let Self { db, from, .. } = *self;
        if self.own.contains(name) {
            return Found { files: vec![from], searched: vec![from], directories: Vec::new() };
        }
        let mut searched: Vec<SourceFile> = Vec::new();
        for place in &self.places {
            // A guess need not be told of all.
            if !searched.is_empty() && place.directory.insight(db) != Insight::Listed {
                break;
            }
            for file in files(place) {
                if !searched.contains(&file) {
                    searched.push(file);
                }
            }
        }
        let mut files: Vec<SourceFile> =
            searched.iter().copied().filter(|file| defines(db, *file, name)).collect();
        if files.len() > 1 {
            // The same file reached under two names is no duplicate.
            let mut seen = Vec::new();
            files.retain(|file| {
                let canonical = db.system().canonical(file.path(db));
                let is_new = !seen.contains(&canonical);
                seen.push(canonical);
                is_new
            });
        }
        Found { files, searched, directories: self.places.iter().map(|place| place.directory).collect() }
    }
}

/// The directories in which paths are looked for that a drawing refers to, in order.
pub fn search_directories(db: &dyn Db, from: SourceFile) -> Vec<Utf8PathBuf> {
    let own = from.path(db).parent().unwrap_or(Utf8Path::new("")).to_owned();
    let mut directories = vec![own];
    for searched in &Settings::get(db).lookup(db).search {
        if !directories.contains(searched) {
            directories.push(searched.clone());
        }
    }
    directories
}

/// The files of a directory that define a path, for whoever asks by name from outside. (Not through an interned name, which nobody would
/// reclaim there.)
pub fn holders(db: &dyn Db, directory: Directory, name: &PathName) -> Vec<SourceFile> {
    let files = files_of(db, directory, name.as_str()).into_iter();
    files.filter(|file| path_names(db, *file).contains(name)).collect()
}

/// The drawing of a directory that most likely holds a path: the one of its name, if there is one.
pub fn likely_file(db: &dyn Db, directory: &Utf8Path, name: &str) -> Option<SourceFile> {
    let path = joined(directory, &format!("{name}{EXTENSION}"));
    (db.system().kind(&path) == Kind::File).then(|| db.file(&path))
}

/// Where a path is, as far as one knows before the directory is listed.
fn guessed(db: &dyn Db, directory: Directory, name: &str, key: &PathKey) -> Vec<SourceFile> {
    if let Some(file) = likely_file(db, directory.path(db), name) {
        return vec![file];
    }
    if directory.insight(db) == Insight::Unlisted {
        return Vec::new();
    }
    let names = db.arrivals().find(directory, key).into_iter();
    names.map(|name| db.file(&joined(directory.path(db), &name))).collect()
}

fn files_of(db: &dyn Db, directory: Directory, name: &str) -> Vec<SourceFile> {
    let pattern = &Settings::get(db).language(db).path_pattern;
    let Some(key) = PathKey::new(name, pattern) else { return Vec::new() };
    if directory.insight(db) == Insight::Listed {
        return name_table(db, directory).files(db, directory, &key);
    }
    guessed(db, directory, name, &key)
}

/// The names of paths in files that were searched, for proposing near ones.
pub(super) fn names_in(db: &dyn Db, files: &[SourceFile]) -> Vec<PathName> {
    files.iter().flat_map(|file| path_names(db, *file)).cloned().collect()
}
