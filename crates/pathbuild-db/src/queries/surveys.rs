//! What a check of a library asks of a drawing, found while what was read is at hand, and kept in one value. What is large is dropped at once, so
//! that it never leaves the processor's caches. Each of the functions that others ask (`path_names`, `head`, `summary` ...) looks here first where
//! drawings are surveyed, and finds what the query of its name would.

use std::panic::{AssertUnwindSafe, catch_unwind};

use pathbuild_diagnostic::Diagnostic;
use pathbuild_path::{Bindings, Path, PathName, RawPath, SourceMap};

use super::brief::{Head, Summary, new_summary};
use super::raw::FileReport;
use super::reading::read;
use crate::database::Db;
use crate::inputs::SourceFile;

/// What is known of a drawing.
#[derive(Clone, Debug)]
pub struct Survey {
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
    /// The path with these values, where it embeds others.
    path: Option<Box<Path>>,
    /// What was read, where it has variables.
    raw: Option<Box<RawPath>>,
    /// Where its elements are, if there is something to say of them already; else the drawing is read once more for that.
    map: Option<SourceMap>,
}

/// The survey of a drawing, where drawings are surveyed.
pub(super) fn surveyed(db: &dyn Db, file: SourceFile) -> Option<&Survey> {
    db.is_surveying().then(|| survey(db, file))
}

/// Surveys a drawing.
#[salsa::tracked(no_eq)]
pub fn survey(db: &dyn Db, file: SourceFile) -> Survey {
    let (paths, report) = read(db, file);
    let names = paths.iter().map(|(raw, _)| raw.name.clone()).collect();
    let mut paths: Vec<SurveyedPath> =
        paths.into_iter().map(|(raw, map)| SurveyedPath::new(db, file, raw, map)).collect();
    paths.sort_unstable_by(|a, b| a.head.name.cmp(&b.head.name));
    Survey { report, names, paths }
}

impl Survey {
    /// The names of its paths, in order of first appearance.
    pub fn names(&self) -> &[PathName] {
        &self.names
    }

    /// What is wrong with the drawing as a whole.
    pub fn diagnostics(&self) -> &[Diagnostic] {
        &self.report.diagnostics
    }

    /// What is known of the drawing as a whole.
    pub(super) fn report(&self) -> &FileReport {
        &self.report
    }

    /// One of its paths.
    pub(super) fn path(&self, name: &PathName) -> Option<&SurveyedPath> {
        let place = self.paths.binary_search_by(|path| path.head.name.cmp(name)).ok()?;
        Some(&self.paths[place])
    }
}

impl SurveyedPath {
    fn new(db: &dyn Db, file: SourceFile, raw: RawPath, map: SourceMap) -> Self {
        let head = Head::new(&raw);
        let examples = Bindings::check_values(&head.definitions);
        let has_variables = !examples.is_empty();
        let summary = || new_summary(db, file, &raw, &examples);
        let (summary, path) = catch_unwind(AssertUnwindSafe(summary)).ok().unzip();
        let is_clear = summary.as_ref().is_some_and(Summary::is_clear);
        let has_subpaths = summary.as_ref().is_some_and(Summary::has_subpaths);
        Self {
            head,
            path: path.flatten().filter(|_| has_subpaths).map(Box::new),
            raw: has_variables.then(|| Box::new(raw)),
            map: (!is_clear).then_some(map),
            examples,
            summary,
        }
    }

    /// What comes of it with these values, if they are the example values.
    pub(super) fn summary_with(&self, bindings: &Bindings) -> Option<&Summary> {
        self.summary.as_ref().filter(|_| self.examples == *bindings)
    }

    /// The path with these values, if they are the example values and it embeds others.
    pub(super) fn path_with(&self, bindings: &Bindings) -> Option<&Path> {
        self.path.as_deref().filter(|_| self.examples == *bindings)
    }

    /// What comes of it with the example values, and the path if it embeds others.
    pub(super) fn with_examples(&self) -> Option<(&Summary, Option<&Path>)> {
        Some((self.summary.as_ref()?, self.path.as_deref()))
    }

    /// What was read, where it was kept.
    pub(super) fn raw(&self) -> Option<&RawPath> {
        self.raw.as_deref()
    }

    /// Where its elements are, where that was kept.
    pub(super) fn map(&self) -> Option<&SourceMap> {
        self.map.as_ref()
    }
}
