//! `diff`: compares the programs of all paths in two trees. (book: program/comparing)

mod reasons;
mod states;

use std::collections::HashMap;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::check_file;
use pathbuild_diagnostic::{Diagnostic, Lang};
use pathbuild_path::PathName;
use pathbuild_view::{
    Group, Picture, ScenePath, StockChange, Totals, changes_svg, compare, groups, stock_change_svg,
};

use crate::emit::ShownText;
use crate::inputs::Inputs;
use crate::session::{HashedPath, Session, compare_names};

pub use reasons::{Reason, ValueChange};
use reasons::{Side, reasons};
pub use states::{MachineStates, StateChange, StateKind};

/// One side of the comparison: drawings below a directory.
#[derive(Debug)]
pub struct Tree<'s, 'w> {
    /// Session with the configuration of this side.
    pub session: &'s mut Session<'w>,
    /// The drawings to compare.
    pub inputs: &'s Inputs,
    /// Root directory. Files with the same path below both roots correspond to each other.
    pub root: &'s Utf8Path,
}

/// The paths that differ between two trees, with diagnostics of everything that could not be compared.
#[derive(Debug, Default)]
pub struct Comparison {
    /// Paths that differ between the sides, sorted by name.
    pub paths: Vec<PathDiff>,
    /// Number of paths on the new side.
    pub path_count: usize,
    /// Diagnostics of what could not be compared, on the old and on the new side.
    pub problems: [Vec<Diagnostic>; 2],
}

impl Comparison {
    /// Whether the problems of either side include errors of this path, or of the file that defines it.
    pub fn has_error_of(&self, path: &PathDiff) -> bool {
        let is_of = |problem: &Diagnostic| {
            let is_named = match problem.path.as_deref() {
                Some(name) => PathName::new(name) == PathName::new(&path.name),
                None => path.files.contains(&problem.file),
            };
            problem.is_error() && is_named
        };
        self.problems.iter().flatten().any(is_of)
    }
}

/// A path that differs between the sides.
#[derive(Debug)]
pub struct PathDiff {
    /// Name of the path, as the newer drawing spells it.
    pub name: String,
    /// Path of the drawing that defines the path on the old and on the new side, relative to the root; `None` if the side lacks the path.
    pub files: [Option<Utf8PathBuf>; 2],
    /// The kind of difference.
    pub outcome: Outcome,
}

/// The kind of difference of a path between the sides.
#[derive(Debug)]
pub enum Outcome {
    /// The path exists on the new side only.
    Added,
    /// The path exists on the old side only.
    Removed,
    /// The path has errors on the new side only.
    Broken,
    /// The path has errors on the old side only.
    Mended,
    /// The path has errors on both sides, so its moves are unknown.
    StillBroken,
    /// The path has the same moves, but is defined in another drawing.
    OtherDrawing,
    /// The path has different moves on the two sides.
    Changed(Box<ProgramDiff>),
}

/// Differences between the old and the new program of a path.
#[derive(Debug, Default)]
pub struct ProgramDiff {
    /// Changed moves, grouped by the kind of change.
    pub groups: Vec<Group>,
    /// Changes of tools, spindle, work offsets, stops and the like; empty unless both sides are programs.
    pub states: Vec<StateChange>,
    /// Reasons for the changes; `None` unless both sides are drawings, empty if no element and no setting differs.
    pub reasons: Option<Vec<Reason>>,
    /// Lengths and times before and after, if known.
    pub totals: [Option<Totals>; 2],
    /// Pictures as SVG, if requested.
    pub pictures: Option<PictureSet>,
}

/// Pictures of a change, at the same scale.
#[derive(Debug)]
pub struct PictureSet {
    /// Old and new moves in one picture, as SVG.
    pub changes: String,
    /// The old moves only, as SVG.
    pub old: String,
    /// The new moves only, as SVG.
    pub new: String,
    /// Pictures of the stock that the change removes, and of the stock that it leaves.
    pub stock: Vec<String>,
}

/// Compares the moves of two programs. `pictures` is the language of the legends; `None` if no pictures are requested.
pub fn compare_moves(old: &ScenePath, new: &ScenePath, pictures: Option<Lang>) -> ProgramDiff {
    let changes = compare(&old.moves, &new.moves);
    let picture = |which, lang| changes_svg(&old.moves, &new.moves, &changes, which, lang);
    ProgramDiff {
        groups: groups(&changes, &old.moves, &new.moves),
        states: Vec::new(),
        reasons: None,
        totals: [old.totals, new.totals],
        pictures: pictures.filter(|_| !changes.is_empty()).map(|lang| PictureSet {
            changes: picture(Picture::Changes, lang),
            old: picture(Picture::Old, lang),
            new: picture(Picture::New, lang),
            stock: [StockChange::Removed, StockChange::Left]
                .into_iter()
                .filter_map(|change| stock_change_svg(old, new, change, lang))
                .collect(),
        }),
    }
}

/// Compares all paths of two trees. `pictures` is the language of the legends; `None` if no pictures are requested.
pub fn compare_trees(old: &mut Tree<'_, '_>, new: &mut Tree<'_, '_>, pictures: Option<Lang>) -> Comparison {
    let Tree { session, inputs, root } = new;
    session.with_stable_files(|session| {
        let mut new = Tree { session, inputs, root };
        let Tree { session, inputs, root } = &mut *old;
        session.with_stable_files(|session| {
            compare_stable(&mut Tree { session, inputs, root }, &mut new, pictures)
        })
    })
}

fn compare_stable(old: &mut Tree<'_, '_>, new: &mut Tree<'_, '_>, pictures: Option<Lang>) -> Comparison {
    let (old_path, old_problems) = old.paths();
    let (new_path, new_problems) = new.paths();
    let mut problems = [old_problems, new_problems];
    let path_count = new_path.len();
    let mut paths: Vec<PathDiff> = pair_up(old_path, new_path)
        .into_iter()
        .filter_map(|pair| pair.compare([old.session, new.session], pictures, &mut problems))
        .collect();
    paths.sort_by(|a, b| compare_names(&a.name, &b.name).then_with(|| a.files.cmp(&b.files)));
    Comparison { paths, path_count, problems }
}

impl Tree<'_, '_> {
    /// Returns the paths of this side, and the diagnostics of the drawings themselves.
    fn paths(&mut self) -> (Vec<HashedPath>, Vec<Diagnostic>) {
        let selection = self.session.select(self.inputs);
        let files = selection.whole(self.session);
        let mut problems = selection.problems;
        let root = self.session.normal(self.root);
        let found = self.session.in_batches_of_programs(&files, |session, files| {
            session.parse_ahead(files);
            let broken = files.iter().flat_map(|file| check_file(session.db(), *file));
            problems.extend(broken.filter(|problem| problem.is_error()).cloned());
            let mut paths = session.move_hashes(files, &root);
            problems.extend(paths.iter_mut().flat_map(|path| std::mem::take(&mut path.problems)));
            paths
        });
        (found, problems)
    }
}

struct PathPair {
    old: Option<HashedPath>,
    new: Option<HashedPath>,
}

/// Pairs the paths of both sides: first those with the same name in the same drawing, then those with a name that remains exactly once on each side.
fn pair_up(old: Vec<HashedPath>, new: Vec<HashedPath>) -> Vec<PathPair> {
    let mut by_file: HashMap<(Utf8PathBuf, PathName), HashedPath> =
        old.into_iter().map(|known| ((known.place.clone(), known.name.clone()), known)).collect();
    let mut pair_up = Vec::new();
    let mut alone = Vec::new();
    for known in new {
        match by_file.remove(&(known.place.clone(), known.name.clone())) {
            Some(old) => pair_up.push(PathPair { old: Some(old), new: Some(known) }),
            None => alone.push(known),
        }
    }
    let mut by_name: HashMap<PathName, Vec<HashedPath>> = HashMap::new();
    for known in by_file.into_values() {
        by_name.entry(known.name.clone()).or_default().push(known);
    }
    let mut count: HashMap<PathName, usize> = HashMap::new();
    for known in &alone {
        *count.entry(known.name.clone()).or_default() += 1;
    }
    for known in alone {
        let is_only = count[&known.name] == 1;
        let old = by_name.get_mut(&known.name).filter(|old| is_only && old.len() == 1).and_then(Vec::pop);
        pair_up.push(PathPair { old, new: Some(known) });
    }
    pair_up.extend(by_name.into_values().flatten().map(|old| PathPair { old: Some(old), new: None }));
    pair_up
}

impl PathPair {
    fn compare(
        self,
        sessions: [&Session<'_>; 2],
        pictures: Option<Lang>,
        problems: &mut [Vec<Diagnostic>; 2],
    ) -> Option<PathDiff> {
        let Self { old, new } = self;
        let outcome = match (&old, &new) {
            (Some(old_path), Some(new_path)) => match (&old_path.moves, &new_path.moves) {
                (Some(before), Some(after)) if before == after && old_path.place == new_path.place => {
                    return None;
                }
                (Some(before), Some(after)) if before == after => Outcome::OtherDrawing,
                (Some(_), Some(_)) => compare_programs(sessions, [old_path, new_path], pictures, problems)?,
                (Some(_), None) => Outcome::Broken,
                (None, Some(_)) => Outcome::Mended,
                (None, None) => Outcome::StillBroken,
            },
            (None, Some(_)) => Outcome::Added,
            (Some(_), None) => Outcome::Removed,
            (None, None) => return None,
        };
        let name = new.as_ref().or(old.as_ref())?.name.to_string();
        let files = [old, new].map(|known| known.map(|known| known.place));
        Some(PathDiff { name, files, outcome })
    }
}

/// Compares the two different programs of a path; returns `None` if they differ in comments only and the drawings are the same. If a limit prevents a
/// side from being built, there are no moves to compare, and the diagnostics say why.
fn compare_programs(
    sessions: [&Session<'_>; 2],
    paths: [&HashedPath; 2],
    pictures: Option<Lang>,
    problems: &mut [Vec<Diagnostic>; 2],
) -> Option<Outcome> {
    let ([before, after], [old, new]) = (sessions, paths);
    let sides = [scene_path(before, old), scene_path(after, new)];
    let outcome = match &sides {
        [Ok(old_path), Ok(new_path)] => {
            let reasons = explain_change(sessions, paths, problems);
            let changes = ProgramDiff { reasons, ..compare_moves(old_path, new_path, pictures) };
            if changes.groups.is_empty() && changes.reasons.as_ref().is_some_and(Vec::is_empty) {
                return None;
            }
            Outcome::Changed(Box::new(changes))
        }
        [Ok(_), Err(_)] => Outcome::Broken,
        [Err(_), Ok(_)] => Outcome::Mended,
        [Err(_), Err(_)] => Outcome::StillBroken,
    };
    for (problems, side) in problems.iter_mut().zip(sides) {
        problems.extend(side.err().into_iter().flatten());
    }
    Some(outcome)
}

/// Returns the reasons why the moves of a path changed; `None`, with diagnostics, if the drawings could not be compared.
fn explain_change(
    [before, after]: [&Session<'_>; 2],
    [old, new]: [&HashedPath; 2],
    problems: &mut [Vec<Diagnostic>; 2],
) -> Option<Vec<Reason>> {
    let reasons = before.query_target(old.target, |old_db| {
        let old = Side { db: old_db, settings: &before.workspace().settings, target: old.target };
        after.query_target(new.target, |new_db| {
            reasons(old, Side { db: new_db, settings: &after.workspace().settings, target: new.target })
        })
    });
    let [old_problems, new_problems] = problems;
    let reasons = reasons.map_err(|problem| old_problems.push(*problem)).ok()?;
    reasons.map_err(|problem| new_problems.push(*problem)).ok()
}

/// Builds the scene of a path with its program.
///
/// # Errors
/// The errors that prevent the program from being built.
fn scene_path(session: &Session<'_>, known: &HashedPath) -> Result<ScenePath, Vec<Diagnostic>> {
    let scene_path = session.scene(known.file, std::slice::from_ref(&known.name), ShownText::Native);
    let path = scene_path.scene.paths.into_iter().next().filter(|path| path.gcode.is_some());
    // Errors of the drawing as a whole have been reported already.
    let is_of_path = |problem: &Diagnostic| problem.is_error() && problem.path.is_some();
    path.ok_or_else(|| scene_path.diagnostics.into_iter().filter(is_of_path).collect())
}
