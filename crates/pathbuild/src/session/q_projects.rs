//! Drawings and their Q-projects. (spec/20-paths-and-files.md, "Q-projects")

use std::collections::HashMap;

use camino::Utf8Path;
use pathbuild_db::{SourceFile, q_project_findings};
use pathbuild_diagnostic::Diagnostic;

use super::Session;

impl Session<'_> {
    /// What drawings and the Q-projects among them say against each other.
    pub fn q_projects(&self, drawings: &[SourceFile]) -> Vec<Diagnostic> {
        let db = self.db();
        let stem = |file: SourceFile| Some((file.path(db).parent()?, file.path(db).file_stem()?));
        let by_stem: HashMap<(&Utf8Path, &str), SourceFile> =
            drawings.iter().filter_map(|file| Some((stem(*file)?, *file))).collect();
        let pair = |q_project: &SourceFile| {
            let (directory, name) = stem(*q_project)?;
            let name = name.strip_suffix("_Q").or_else(|| name.strip_suffix("_q"))?;
            Some((*by_stem.get(&(directory, name))?, *q_project))
        };
        let pairs: Vec<(SourceFile, SourceFile)> = drawings.iter().filter_map(pair).collect();
        let judged = self.guarded(&pairs, |db, (drawing, q_project)| {
            let found = q_project_findings(db, *drawing, *q_project).iter().cloned();
            found.map(|problem| pathbuild_db::locate(db, problem)).collect::<Vec<_>>()
        });
        let given_up = |(result, (drawing, _)): (Result<_, Box<Diagnostic>>, &(SourceFile, SourceFile))| {
            result.unwrap_or_else(|problem| vec![problem.in_file(drawing.path(db))])
        };
        judged.into_iter().zip(&pairs).flat_map(given_up).collect()
    }
}
