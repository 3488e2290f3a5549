//! Findings about the cuts of a drawing's paths beside and into its parts. (book: language/part)

use pathbuild_diagnostic::{Diagnostic, Severity};
use pathbuild_path::{DrawnParts, Part, PartFindings, Path, PathCuts, WalkedPath, check_parts, check_path};
use pathbuild_toolpath::part_cuts;

use crate::bugs::catch_bugs;
use crate::database::Db;
use crate::inputs::Settings;

/// The cuts of a sound path, if the drawing has parts. A panic was reported by the index already if the path gives no program either.
pub(super) fn cuts_of(db: &dyn Db, path: &Path, walked: &WalkedPath) -> Option<PathCuts> {
    let is_compatible = Settings::get(db).fold(db).compatible;
    catch_bugs(|| part_cuts(path, walked, is_compatible)).ok()
}

/// Checks all paths of a drawing against its parts. `is_complete`: whether the cuts of all its paths are known.
pub(super) fn judge(db: &dyn Db, drawn: &DrawnParts, cuts: &[PathCuts], is_complete: bool) -> PartFindings {
    let Some(settings) = &Settings::get(db).language(db).part else { return PartFindings::default() };
    let cuts: Vec<&PathCuts> = cuts.iter().collect();
    let mut findings = check_parts(drawn, &cuts, is_complete, settings);
    findings.of_file.extend(drawn.problems.iter().cloned());
    let of_paths = findings.of_paths.iter_mut().flatten();
    for problem in findings.of_file.iter_mut().chain(of_paths) {
        soften(db, problem);
    }
    findings
}

/// Checks one path against the parts of its drawing, for other values than those of its index.
pub(super) fn judge_path(db: &dyn Db, parts: &[Part], path: &Path, walked: &WalkedPath) -> Vec<Diagnostic> {
    let (Some(settings), false) = (&Settings::get(db).language(db).part, parts.is_empty()) else {
        return Vec::new();
    };
    let cuts = cuts_of(db, path, walked);
    let mut found = cuts.map(|cuts| check_path(parts, &cuts, settings)).unwrap_or_default();
    for problem in &mut found {
        soften(db, problem);
    }
    found
}

/// In compatible mode everything about parts is a warning.
pub(super) fn soften(db: &dyn Db, problem: &mut Diagnostic) {
    if Settings::get(db).fold(db).compatible {
        problem.severity = Severity::Warning;
    }
}
