//! Paths of surveyed drawings of which there is nothing to say: seen without asking for all that a closure would tell.

use std::panic::{AssertUnwindSafe, catch_unwind};

use pathbuild_path::{Path, PathName, Segment, SegmentKind, Subpath, SubpathName};

use super::brief::{Brief, Summary, summary};
use super::fit::{Outer, bindings};
use super::instance::Instance;
use super::lookup::{Found, Search};
use super::raw::NameKey;
use super::survey::surveyed;
use super::traces::Trace;
use crate::database::Db;
use crate::inputs::SourceFile;
use crate::settings::{Limits, Settings};

/// A path that a check finds nothing in: what it embeds.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Clear {
    /// Each path that it embeds, and where that is: in one file.
    embedded: Vec<(PathName, Found)>,
}

impl Clear {
    /// The drawings of what it embeds.
    pub fn files(&self) -> impl Iterator<Item = SourceFile> {
        self.embedded.iter().flat_map(|(_, found)| &found.files).copied()
    }

    /// What was looked for in vain or found, from the drawing that has the path.
    pub fn trace(&self, db: &dyn Db, file: SourceFile) -> Trace {
        let mut trace = Trace { files: vec![file], lookups: Vec::new() };
        for (name, found) in &self.embedded {
            trace.add_found(db, name, found);
        }
        trace
    }
}

/// Whether a check would find nothing in a drawing's path, so far as that is seen at once: drawings are surveyed, nothing is to be said of the
/// path, and the paths it embeds are there, fit, are clear themselves and embed nothing more. `None` says nothing.
pub fn clear(db: &dyn Db, file: SourceFile, name: &PathName) -> Option<Clear> {
    // What shows a bug shows it again when the path is checked as all others are.
    catch_unwind(AssertUnwindSafe(|| clear_path(db, file, name))).ok().flatten()
}

fn clear_path(db: &dyn Db, file: SourceFile, name: &PathName) -> Option<Clear> {
    let (summary, path) = surveyed(db, file)?.path(name)?.with_examples()?;
    let mut moves = clear_brief(summary)?.moves;
    let mut clear = Clear::default();
    if let Some(path) = path {
        let (search, outer) = (Search::new(db, file), Outer { db, path });
        for (segment, subpath) in subpaths(path) {
            let (name, found, brief) = embedded(&search, outer, segment, subpath)?;
            moves = moves.saturating_add(brief.moves);
            clear.embedded.push((name.clone(), found));
        }
    }
    let limits: Limits = Settings::get(db).limits(db);
    // Itself is one more path.
    (moves <= limits.moves && (clear.embedded.len() as u64) < limits.paths).then_some(clear)
}

fn subpaths(path: &Path) -> impl Iterator<Item = (&Segment, &Subpath)> {
    path.segments.iter().filter_map(|segment| match &segment.kind {
        SegmentKind::Subpath(subpath) => Some((segment, &**subpath)),
        _ => None,
    })
}

/// A path that fits where it is embedded, and that embeds nothing.
fn embedded<'db>(
    search: &Search<'db>,
    outer: Outer<'db>,
    segment: &Segment,
    subpath: &'db Subpath,
) -> Option<(&'db PathName, Found, &'db Brief)> {
    let db = outer.db;
    let SubpathName::Found { name, has_more: None, .. } = &subpath.name else { return None };
    if outer.forbidden(name).is_some() {
        return None;
    }
    let found = search.find(name);
    let [file] = *found.files.as_slice() else { return None };
    let path = surveyed(db, file)?.path(name)?;
    if !outer.binding_problems(segment, subpath, &path.head).is_empty() {
        return None;
    }
    let values = bindings(subpath);
    let with_values = || summary(db, Instance::new(db, file, NameKey::of(db, name), values.clone()));
    let summary = path.summary_with(&values).unwrap_or_else(with_values);
    let brief = clear_brief(summary).filter(|brief| !brief.has_subpaths)?;
    outer.misfits(segment, subpath, brief).is_empty().then_some((name, found, brief))
}

fn clear_brief(summary: &Summary) -> Option<&Brief> {
    summary.brief.as_ref().filter(|_| summary.is_clear())
}
