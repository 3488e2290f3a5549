//! What a check of a library asks of a drawing, found while what was read is at hand, and kept in one value. What is large is dropped at once, so
//! that it never leaves the processor's caches. Each of the functions that others ask (`path_names`, `head`, `summary` ...) looks here first where
//! drawings are surveyed, and finds what the query of its name would.

use std::panic::{AssertUnwindSafe, catch_unwind};

use pathbuild_path::{Bindings, PathName, RawPath, SourceMap};

use super::brief::{Brief, Head, Summary, new_summary};
use super::raw::{FileReport, read};
use crate::database::Db;
use crate::inputs::SourceFile;
use crate::settings::{Limits, Settings};

/// What is known of a drawing.
#[derive(Clone, Debug)]
pub(super) struct Survey {
    report: FileReport,
    /// In order of first appearance.
    names: Vec<PathName>,
    /// In order of name: a drawing may have as many as it has layers.
    paths: Vec<SurveyedPath>,
}

/// What is known of a path.
#[derive(Clone, Debug)]
pub(super) struct SurveyedPath {
    pub(super) head: Head,
    /// Example values for its variables.
    examples: Bindings,
    /// What comes of it with these; nothing where that shows a bug, which is reported when it shows again.
    summary: Option<Summary>,
    /// What was read, if it will be asked for: where it has variables, or embeds others.
    raw: Option<RawPath>,
    /// Where its elements are, if that will be asked for.
    map: Option<SourceMap>,
}

/// The survey of a drawing, where drawings are surveyed.
pub(super) fn surveyed(db: &dyn Db, file: SourceFile) -> Option<&Survey> {
    db.is_surveying().then(|| survey(db, file))
}

/// Whether it is known of a drawing's path that checking it finds nothing: drawings are surveyed, the path embeds nothing, and nothing is to be
/// said of it.
pub fn is_clear(db: &dyn Db, file: SourceFile, name: &PathName) -> bool {
    let Limits { moves, paths } = Settings::get(db).limits(db);
    let summary = surveyed(db, file).and_then(|survey| survey.path(name.as_str())?.summary.as_ref());
    summary.is_some_and(|summary| summary.is_clear_within(moves) && paths > 0)
}

#[salsa::tracked(no_eq)]
fn survey(db: &dyn Db, file: SourceFile) -> Survey {
    let (paths, report) = read(db, file);
    let names = paths.iter().map(|(raw, _)| raw.name.clone()).collect();
    let mut paths: Vec<SurveyedPath> =
        paths.into_iter().map(|(raw, map)| SurveyedPath::new(db, file, raw, map)).collect();
    paths.sort_unstable_by(|a, b| a.head.name.cmp(&b.head.name));
    Survey { report, names, paths }
}

impl Survey {
    /// The names of its paths, in order of first appearance.
    pub(super) fn names(&self) -> &[PathName] {
        &self.names
    }

    /// What is known of the drawing as a whole.
    pub(super) fn report(&self) -> &FileReport {
        &self.report
    }

    /// One of its paths.
    pub(super) fn path(&self, name: &str) -> Option<&SurveyedPath> {
        let name = PathName::new(name);
        let place = self.paths.binary_search_by(|path| path.head.name.cmp(&name)).ok()?;
        Some(&self.paths[place])
    }
}

impl SurveyedPath {
    fn new(db: &dyn Db, file: SourceFile, raw: RawPath, map: SourceMap) -> Self {
        let head = Head::new(&raw);
        let examples = Bindings::check_values(&head.definitions);
        let summary = || new_summary(db, file, &raw, &examples);
        let summary = catch_unwind(AssertUnwindSafe(summary)).ok();
        let brief = summary.as_ref().and_then(|summary| summary.brief.as_ref());
        let has_more = !examples.is_empty() || brief.is_some_and(|brief| brief.has_subpaths);
        let is_clear = summary.as_ref().is_some_and(|summary| summary.is_clear_within(u64::MAX));
        Self {
            head,
            examples,
            raw: has_more.then_some(raw),
            map: (has_more || !is_clear).then_some(map),
            summary,
        }
    }

    /// What comes of it with these values, if they are the example values.
    pub(super) fn summary_with(&self, bindings: &Bindings) -> Option<&Summary> {
        self.summary.as_ref().filter(|_| self.examples == *bindings)
    }

    /// What was read, where it was kept.
    pub(super) fn raw(&self) -> Option<&RawPath> {
        self.raw.as_ref()
    }

    /// Where its elements are, where that was kept.
    pub(super) fn map(&self) -> Option<&SourceMap> {
        self.map.as_ref()
    }
}

impl Summary {
    /// Whether there is nothing to say of the path itself, and it embeds nothing.
    fn is_clear_within(&self, limit: u64) -> bool {
        let is_clear = |brief: &Brief| {
            !brief.has_subpaths
                && brief.moves <= limit
                && [&brief.sweep_problems, &brief.walk_problems].into_iter().all(Vec::is_empty)
        };
        self.problems.is_empty() && self.brief.as_ref().is_some_and(is_clear)
    }
}
