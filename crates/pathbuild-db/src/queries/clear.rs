//! Paths of surveyed drawings of which there is nothing to say: seen without asking for all that a closure would tell.

use std::panic::{AssertUnwindSafe, catch_unwind};

use pathbuild_path::{Path, PathName, Segment, SegmentKind, Subpath, SubpathName};

use super::brief::{Brief, Summary, summary};
use super::fit::{Outer, bindings};
use super::instance::Instance;
use super::lookup::Search;
use super::raw::NameKey;
use super::surveys::{Survey, surveyed};
use super::traces::Trace;
use crate::database::Db;
use crate::inputs::SourceFile;
use crate::settings::{Limits, Settings};

/// A path that a check finds nothing in.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Clear {
    /// The drawings of what it embeds of which there is something to say.
    pub faulty: Vec<SourceFile>,
    /// What was looked for and found, where that is noted.
    pub trace: Option<Trace>,
}

/// Whether a check would find nothing in a path of a surveyed drawing, so far as that is seen at once: nothing is to be said of the path, and the
/// paths it embeds are there, fit, are clear themselves and embed nothing more. `None` says nothing.
pub fn clear(
    db: &dyn Db,
    file: SourceFile,
    survey: &Survey,
    name: &PathName,
    is_traced: bool,
) -> Option<Clear> {
    let trace = is_traced.then(|| Trace { files: vec![file], lookups: Vec::new() });
    // What shows a bug shows it again when the path is checked as all others are.
    catch_unwind(AssertUnwindSafe(|| clear_path(db, file, survey, name, trace))).ok().flatten()
}

fn clear_path(
    db: &dyn Db,
    file: SourceFile,
    survey: &Survey,
    name: &PathName,
    trace: Option<Trace>,
) -> Option<Clear> {
    let (summary, path) = survey.path(name)?.with_examples()?;
    let mut moves = clear_brief(summary)?.moves;
    let mut clear = Clear { faulty: Vec::new(), trace };
    // Itself is a path too.
    let mut paths = 1;
    if let Some(path) = path {
        let (search, outer) = (Search::new(db, file, survey.names()), Outer { db, path });
        for (segment, subpath) in subpaths(path) {
            moves = moves.saturating_add(embedded(&search, outer, segment, subpath, &mut clear)?.moves);
            paths += 1;
        }
    }
    let limits: Limits = Settings::get(db).limits(db);
    (moves <= limits.moves && paths <= limits.paths).then_some(clear)
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
    subpath: &Subpath,
    clear: &mut Clear,
) -> Option<&'db Brief> {
    let db = outer.db;
    let SubpathName::Found { name, has_more: None, .. } = &subpath.name else { return None };
    if outer.forbidden(name).is_some() {
        return None;
    }
    let found = search.find(name);
    let [file] = *found.files.as_slice() else { return None };
    let survey = surveyed(db, file)?;
    let path = survey.path(name)?;
    if !outer.binding_problems(segment, subpath, &path.head).is_empty() {
        return None;
    }
    let values = bindings(subpath);
    let with_values = || summary(db, Instance::new(db, file, NameKey::of(db, name), values.clone()));
    let summary = path.summary_with(&values).unwrap_or_else(with_values);
    let brief = clear_brief(summary).filter(|brief| !brief.has_subpaths)?;
    if !outer.misfits(segment, subpath, brief).is_empty() {
        return None;
    }
    if !survey.diagnostics().is_empty() {
        clear.faulty.push(file);
    }
    if let Some(trace) = &mut clear.trace {
        trace.add_found(db, name, &found);
    }
    Some(brief)
}

fn clear_brief(summary: &Summary) -> Option<&Brief> {
    summary.brief.as_ref().filter(|_| summary.is_clear())
}
