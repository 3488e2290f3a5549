//! Finds paths that two drawings define, among the drawings that the caller passes; no directory is listed to find more. (book: language/embedding)

use std::collections::hash_map::Entry;
use std::collections::{BTreeMap, BTreeSet};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::paths as messages;
use pathbuild_path::{PathKey, PathName};
use rustc_hash::{FxHashMap, FxHashSet};

use crate::database::Db;
use crate::inputs::Settings;

/// A path that two drawings define.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct SecondDefinition {
    /// Name of the path, as the first drawing spells it.
    pub name: PathName,
    /// File paths of the two drawings. PB504 is reported at the first.
    pub files: [Utf8PathBuf; 2],
}

impl SecondDefinition {
    /// Whether this is about a path of a drawing.
    pub fn is_of(&self, drawing: &Utf8Path, path: &PathName) -> bool {
        self.name == *path && self.files.iter().any(|file| file == drawing)
    }

    /// Returns PB504 at the first drawing.
    pub fn diagnostic(&self) -> Diagnostic {
        let [first, second] = &self.files;
        Diagnostic::new(&messages::DEFINED_TWICE)
            .quoting("name", self.name.as_str())
            .quoting("first", first.as_str())
            .quoting("second", second.as_str())
            .in_file(first)
    }
}

/// Returns the paths that two of these drawings define, if a project in the directory of one of them would find both by their file names, or if
/// `are_together`, which means that the programs of all drawings are written into one directory. Each drawing comes with the names of its paths.
pub fn second_definitions<'a>(
    db: &dyn Db,
    drawings: impl IntoIterator<Item = (&'a Utf8Path, &'a [PathName])>,
    are_together: bool,
) -> BTreeSet<SecondDefinition> {
    let mut first: FxHashMap<&PathName, &Utf8Path> = FxHashMap::default();
    let mut repeated: BTreeMap<&PathName, BTreeMap<&str, &PathName>> = BTreeMap::new();
    for (file, names) in drawings {
        for name in names {
            match first.entry(name) {
                Entry::Vacant(entry) => _ = entry.insert(file),
                Entry::Occupied(entry) => {
                    let files =
                        repeated.entry(name).or_insert_with(|| [(entry.get().as_str(), *entry.key())].into());
                    files.insert(file.as_str(), name);
                }
            }
        }
    }
    repeated.into_values().flat_map(|files| ambiguous_definitions(db, files, are_together)).collect()
}

/// Returns the ambiguous definitions among drawings that define the same path: for a project in the directory of each drawing, the first drawing that
/// the project would find, paired with every other one that it would find. If `are_together`, a project would find all of them.
fn ambiguous_definitions(
    db: &dyn Db,
    mut files: BTreeMap<&str, &PathName>,
    are_together: bool,
) -> impl Iterator<Item = SecondDefinition> {
    files.retain(|file, name| may_define(db, Utf8Path::new(*file), name));
    let directories: BTreeSet<&Utf8Path> = files.keys().map(|file| directory(file)).collect();
    directories.into_iter().flat_map(move |from| {
        let search = Settings::get(db).search(db);
        let is_searched =
            |at: &Utf8Path| are_together || at == from || search.iter().any(|searched| searched == at);
        // Keep a file that is reached under two names only once.
        let mut seen = FxHashSet::default();
        let mut found = files
            .iter()
            .filter(|(file, _)| is_searched(directory(file)))
            .filter(|(file, _)| seen.insert(db.system().canonical(Utf8Path::new(*file))));
        let first = found.next();
        let definition = |(second, _): (&&str, _)| {
            let (first, name) = first?;
            let files = [first, second].map(|file| Utf8PathBuf::from(*file));
            Some(SecondDefinition { name: (*name).clone(), files })
        };
        found.filter_map(definition).collect::<Vec<_>>()
    })
}

/// Whether the name of a drawing's file says that it may define a path.
pub fn may_define(db: &dyn Db, file: &Utf8Path, name: &PathName) -> bool {
    let settings = Settings::get(db);
    let Some(key) = PathKey::new(name.as_str(), &settings.language(db).path_pattern) else { return false };
    let ranges = settings.file_pattern(db).ranges(file.file_stem().unwrap_or_default());
    ranges.iter().any(|range| range.holds(&key))
}

fn directory(file: &str) -> &Utf8Path {
    Utf8Path::new(file).parent().unwrap_or(Utf8Path::new(""))
}
