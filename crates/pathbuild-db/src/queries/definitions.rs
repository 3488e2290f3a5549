//! Paths that two drawings define. (book: language/embedding)

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::paths as messages;
use pathbuild_path::PathName;

use crate::database::Db;
use crate::inputs::SourceFile;
use crate::queries::closures::{NameLookup, Trace};
use crate::queries::index::{NameKey, path_names};
use crate::queries::lookup::{candidate_files, own_directory, resolve_path, search_path};
use crate::queries::raw::raw_path;

/// Returns PB504 for each path of a drawing that two drawings define, if a project beside the drawing would find both by their file names.
/// Drawings for which it would find the same two give the same finding.
#[salsa::tracked]
pub fn second_definitions(db: &dyn Db, file: SourceFile) -> Vec<Diagnostic> {
    let names = path_names(db, file).iter();
    names.filter_map(|name| second_definition(db, file, name)).collect()
}

/// Returns the inputs of [`second_definitions`]: the drawings that may define a path of this one, and the names that are looked up.
pub fn definitions_trace(db: &dyn Db, file: SourceFile) -> Trace {
    let directories = search_path(db, own_directory(db, file)).iter();
    let directories: Vec<_> = directories.map(|directory| directory.path(db).clone()).collect();
    let names = path_names(db, file);
    let lookup = |name: &PathName| NameLookup { name: name.clone(), directories: directories.clone() };
    let mut files = vec![file];
    for other in names.iter().flat_map(|name| others(db, file, name)) {
        if !files.contains(&other) {
            files.push(other);
        }
    }
    Trace { files, lookups: names.iter().map(lookup).collect() }
}

fn second_definition(db: &dyn Db, file: SourceFile, name: &PathName) -> Option<Diagnostic> {
    // Most paths have a file name of their own; no query is needed for them.
    others(db, file, name).next()?;
    let key = NameKey::of(db, name);
    let mut files = resolve_path(db, own_directory(db, file), key).files.clone();
    files.sort_unstable_by_key(|file| file.path(db).as_str());
    let [first, second, ..] = files[..] else { return None };
    let raw = raw_path(db, first, key)?;
    let problem = Diagnostic::new(&messages::DEFINED_TWICE)
        .quoting("name", raw.name.as_str())
        .quoting("first", first.path(db).as_str())
        .quoting("second", second.path(db).as_str())
        .in_file(first.path(db))
        .in_path(raw.name.as_str());
    Some(match &raw.start {
        Some(start) => start.origin.at(problem),
        None => problem,
    })
}

/// Returns the other drawings that may define a path of this drawing, according to their file names.
fn others<'db>(
    db: &'db dyn Db,
    file: SourceFile,
    name: &'db PathName,
) -> impl Iterator<Item = SourceFile> + 'db {
    let directories = search_path(db, own_directory(db, file)).iter();
    directories
        .flat_map(move |directory| candidate_files(db, *directory, name))
        .filter(move |other| *other != file)
}
