//! Drawings and their Q-projects. (spec/20-paths-and-files.md, "Q-projects")

use std::collections::HashMap;

use camino::Utf8Path;
use pathbuild_db::{Database, SourceFile, q_project_findings};
use pathbuild_diagnostic::Diagnostic;

use super::Session;

impl Session<'_> {
    /// What drawings and the Q-projects among them say against each other.
    pub fn q_projects(&self, drawings: &[SourceFile]) -> Vec<Diagnostic> {
        let paths: Vec<&Utf8Path> = drawings.iter().map(|file| file.path(self.db()).as_path()).collect();
        let pairs: Vec<Pair> = pairs(&paths)
            .into_iter()
            .map(|[drawing, q_project]| [drawings[drawing], drawings[q_project]])
            .collect();
        self.judge_q_projects(&pairs).concat()
    }

    /// The same for each pair.
    pub fn judge_q_projects(&self, pairs: &[Pair]) -> Vec<Vec<Diagnostic>> {
        let judge = |db: &Database, [drawing, q_project]: &Pair| {
            let found = q_project_findings(db, *drawing, *q_project).iter().cloned();
            found.map(|problem| pathbuild_db::locate(db, problem)).collect::<Vec<_>>()
        };
        let given_up = |(result, [drawing, _]): (Result<_, Box<Diagnostic>>, &Pair)| {
            result.unwrap_or_else(|problem| vec![problem.in_file(drawing.path(self.db()))])
        };
        self.guarded(pairs, judge).into_iter().zip(pairs).map(given_up).collect()
    }
}

/// A drawing and its Q-project.
pub type Pair = [SourceFile; 2];

/// The drawings that have a Q-project among them, each with it, by their numbers.
pub fn pairs(drawings: &[&Utf8Path]) -> Vec<[usize; 2]> {
    let stem = |path: &'_ Utf8Path| Some((path.parent()?.to_owned(), path.file_stem()?.to_owned()));
    let may_be_q_project = |path: &Utf8Path| path.as_str().contains("_Q.") || path.as_str().contains("_q.");
    // A library of ten thousand drawings has few of them, or none.
    if !drawings.iter().any(|path| may_be_q_project(path)) {
        return Vec::new();
    }
    let by_stem: HashMap<_, usize> =
        drawings.iter().zip(0..).filter_map(|(path, number)| Some((stem(path)?, number))).collect();
    let pair = |(q_project, number): (&&Utf8Path, usize)| {
        let (directory, name) = stem(q_project)?;
        let name = name.strip_suffix("_Q").or_else(|| name.strip_suffix("_q"))?.to_owned();
        Some([*by_stem.get(&(directory, name))?, number])
    };
    drawings.iter().zip(0..).filter_map(pair).collect()
}
