//! Compares drawings with their Q-projects. (book: language/q-projects)

use std::collections::HashMap;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::{Database, SourceFile, q_project_findings};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_path::{is_q_project, tested_by_q_project};

use super::Session;

impl Session<'_> {
    /// For each pair, the discrepancies between the drawing and its Q-project.
    pub fn compare_q_projects(&self, pairs: &[Pair]) -> Vec<Vec<Diagnostic>> {
        let judge = |db: &Database, [drawing, q_project]: &Pair| {
            let found = q_project_findings(db, *drawing, *q_project).iter().cloned();
            found.map(|problem| pathbuild_db::locate(db, problem)).collect::<Vec<_>>()
        };
        let given_up = |(result, [drawing, _]): (Result<_, Box<Diagnostic>>, &Pair)| {
            result.unwrap_or_else(|problem| vec![problem.in_file(drawing.path(self.db()))])
        };
        self.map_guarded(pairs, judge).into_iter().zip(pairs).map(given_up).collect()
    }
}

/// A drawing and its Q-project.
pub type Pair = [SourceFile; 2];

/// Pairs each drawing with its Q-project, if that is among the drawings too.
pub fn pairs<'a>(drawings: impl Iterator<Item = &'a Utf8PathBuf> + Clone) -> Vec<[&'a Utf8PathBuf; 2]> {
    // Fast path: a library of ten thousand drawings has few Q-projects or none.
    if !drawings.clone().any(|drawing| may_be_q_project(drawing)) {
        return Vec::new();
    }
    let stem = |path: &'a Utf8PathBuf| Some((path.parent()?, path.file_stem()?));
    let by_stem: HashMap<_, &Utf8PathBuf> =
        drawings.clone().filter_map(|path| Some((stem(path)?, path))).collect();
    let pair = |q_project: &'a Utf8PathBuf| {
        let (directory, name) = stem(q_project)?;
        Some([*by_stem.get(&(directory, tested_by_q_project(name)?))?, q_project])
    };
    drawings.filter_map(pair).collect()
}

/// A cheap test that does not split the path into components.
fn may_be_q_project(drawing: &Utf8Path) -> bool {
    let stem = drawing.as_str().rsplit_once('.').map_or(drawing.as_str(), |(stem, _)| stem);
    is_q_project(stem)
}
