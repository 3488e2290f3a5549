//! What a change of drawings does to programs: the paths of two trees, held against each other. (docs: "Comparing")

use std::collections::HashMap;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::{SourceFile, check_file};
use pathbuild_diagnostic::{Diagnostic, Lang};
use pathbuild_path::PathName;
use pathbuild_view::{Group, Picture, ScenePath, Totals, changes_svg, compare, groups};

use crate::inputs::Inputs;
use crate::session::{Session, ShownText, by_name};

/// One of the two sides: drawings below a directory.
#[derive(Debug)]
pub struct Tree<'s, 'w> {
    /// Where their configuration holds.
    pub session: &'s mut Session<'w>,
    /// Which drawings.
    pub inputs: &'s Inputs,
    /// Files of both sides that are spelt alike below their roots are each other's.
    pub root: &'s Utf8Path,
}

/// How pictures of changes are drawn.
#[derive(Clone, Copy, Debug)]
pub struct Pictures {
    /// The language of their legends.
    pub lang: Lang,
}

/// What came of a comparison.
#[derive(Debug, Default)]
pub struct Comparison {
    /// Paths that are not the same on both sides, in order of name.
    pub paths: Vec<PathDiff>,
    /// How many paths the new side has.
    pub looked_at: usize,
    /// What could not be looked at, on the old and on the new side.
    pub problems: [Vec<Diagnostic>; 2],
}

impl Comparison {
    /// Whether errors of a path are among the problems of a side: they are told with the comparison.
    pub fn tells_of(&self, path: &PathDiff) -> bool {
        let is_of = |problem: &Diagnostic| {
            let name = problem.path.as_deref().map(PathName::new);
            problem.is_error() && name == Some(PathName::new(&path.name))
        };
        self.problems.iter().flatten().any(is_of)
    }
}

/// A path that is not the same on both sides.
#[derive(Debug)]
pub struct PathDiff {
    /// Its name, as the newer drawing spells it.
    pub name: String,
    /// The drawing that defines it on the old side, below its root, and on the new side.
    pub files: [Option<Utf8PathBuf>; 2],
    /// What became of it.
    pub outcome: Outcome,
}

/// What became of a path.
#[derive(Debug)]
pub enum Outcome {
    /// It is new.
    Added,
    /// It is gone.
    Removed,
    /// It has errors on the new side, where it had none.
    Broken,
    /// It had errors on the old side, and has none now.
    Mended,
    /// It has errors on both sides: nothing is known of its moves.
    StillBroken,
    /// Its moves are the same, but another drawing defines it.
    OtherDrawing,
    /// Its moves changed.
    Changed(Box<ProgramDiff>),
}

/// What changed between two programs.
#[derive(Debug, Default)]
pub struct ProgramDiff {
    /// Its changes by kind.
    pub groups: Vec<Group>,
    /// Lengths and times before and after, where they are known.
    pub totals: [Option<Totals>; 2],
    /// Pictures as SVG, where they were asked for.
    pub pictures: Option<PictureSet>,
}

/// The pictures of a change; all have one scale.
#[derive(Debug)]
pub struct PictureSet {
    /// Old and new in one.
    pub changes: String,
    /// Old alone.
    pub old: String,
    /// New alone.
    pub new: String,
}

/// Compares what two programs do.
pub fn programs(old: &ScenePath, new: &ScenePath, pictures: Option<Pictures>) -> ProgramDiff {
    let changes = compare(&old.moves, &new.moves);
    let picture =
        |which, Pictures { lang }: Pictures| changes_svg(&old.moves, &new.moves, &changes, which, lang);
    ProgramDiff {
        groups: groups(&changes, &old.moves, &new.moves),
        totals: [old.totals, new.totals],
        pictures: pictures.filter(|_| !changes.is_empty()).map(|pictures| PictureSet {
            changes: picture(Picture::Changes, pictures),
            old: picture(Picture::Old, pictures),
            new: picture(Picture::New, pictures),
        }),
    }
}

/// Compares all paths of two trees.
pub fn trees(old: &mut Tree<'_, '_>, new: &mut Tree<'_, '_>, pictures: Option<Pictures>) -> Comparison {
    let Tree { session, inputs, root } = new;
    session.settled(|session| {
        let mut new = Tree { session, inputs, root };
        let Tree { session, inputs, root } = &mut *old;
        session.settled(|session| settled(&mut Tree { session, inputs, root }, &mut new, pictures))
    })
}

fn settled(old: &mut Tree<'_, '_>, new: &mut Tree<'_, '_>, pictures: Option<Pictures>) -> Comparison {
    let (was, old_problems) = old.paths();
    let (is, new_problems) = new.paths();
    let mut problems = [old_problems, new_problems];
    let looked_at = is.len();
    let mut paths: Vec<PathDiff> = pairs(was, is)
        .into_iter()
        .filter_map(|pair| pair.judged([old.session, new.session], pictures, &mut problems))
        .collect();
    paths.sort_by(|a, b| by_name(&a.name, &b.name).then_with(|| a.files.cmp(&b.files)));
    Comparison { paths, looked_at, problems }
}

/// A path of a side.
#[derive(Clone, Debug)]
struct Known {
    file: SourceFile,
    /// Below the root.
    place: Utf8PathBuf,
    name: PathName,
    /// A hash of its program's moves; `None` where it has errors, or its program could not be made.
    moves: Option<Box<str>>,
}

impl Tree<'_, '_> {
    /// Its paths, and what is wrong with the drawings themselves.
    fn paths(&mut self) -> (Vec<Known>, Vec<Diagnostic>) {
        let wanted = self.session.wanted(self.inputs);
        let files = wanted.whole(self.session);
        let mut problems = wanted.problems;
        let root = self.session.normal(self.root);
        let found = self.session.in_batches_of_programs(&files, |session, files| {
            session.read_ahead(files);
            let broken = files.iter().flat_map(|file| check_file(session.db(), *file));
            problems.extend(broken.filter(|problem| problem.is_error()).cloned());
            known(session, files, &root, &mut problems)
        });
        (found, problems)
    }
}

fn known(
    session: &Session<'_>,
    files: &[SourceFile],
    root: &Utf8Path,
    problems: &mut Vec<Diagnostic>,
) -> Vec<Known> {
    let db = session.db();
    let programs = session.move_hashes(files);
    let known = programs.into_iter().map(|hashed| {
        problems.extend(hashed.problems);
        let (file, name, moves) = (hashed.file, hashed.name, hashed.moves);
        let path = file.path(db);
        Known { file, place: path.strip_prefix(root).unwrap_or(path).to_owned(), name, moves }
    });
    known.collect()
}

/// A path on the sides where it is.
struct Pair {
    old: Option<Known>,
    new: Option<Known>,
}

/// Which paths are each other's: those of the same name in the same drawing, then those whose name each side has but once more.
fn pairs(old: Vec<Known>, new: Vec<Known>) -> Vec<Pair> {
    let mut by_file: HashMap<(Utf8PathBuf, PathName), Known> =
        old.into_iter().map(|known| ((known.place.clone(), known.name.clone()), known)).collect();
    let mut pairs = Vec::new();
    let mut alone = Vec::new();
    for known in new {
        match by_file.remove(&(known.place.clone(), known.name.clone())) {
            Some(old) => pairs.push(Pair { old: Some(old), new: Some(known) }),
            None => alone.push(known),
        }
    }
    let mut by_name: HashMap<PathName, Vec<Known>> = HashMap::new();
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
        pairs.push(Pair { old, new: Some(known) });
    }
    pairs.extend(by_name.into_values().flatten().map(|old| Pair { old: Some(old), new: None }));
    pairs
}

impl Pair {
    fn judged(
        self,
        sessions: [&Session<'_>; 2],
        pictures: Option<Pictures>,
        problems: &mut [Vec<Diagnostic>; 2],
    ) -> Option<PathDiff> {
        let Self { old, new } = self;
        let outcome = match (&old, &new) {
            (Some(was), Some(is)) => match (&was.moves, &is.moves) {
                (Some(before), Some(after)) if before == after && was.place == is.place => return None,
                (Some(before), Some(after)) if before == after => Outcome::OtherDrawing,
                (Some(_), Some(_)) => {
                    let [before, after] = sessions;
                    changed([seen(before, was), seen(after, is)], pictures, problems)
                }
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

/// What became of a path whose moves are not the same. A side that a limit kept from being seen has no moves to compare, and says why.
fn changed(
    sides: [Result<ScenePath, Vec<Diagnostic>>; 2],
    pictures: Option<Pictures>,
    problems: &mut [Vec<Diagnostic>; 2],
) -> Outcome {
    let outcome = match &sides {
        [Ok(was), Ok(is)] => Outcome::Changed(Box::new(programs(was, is, pictures))),
        [Ok(_), Err(_)] => Outcome::Broken,
        [Err(_), Ok(_)] => Outcome::Mended,
        [Err(_), Err(_)] => Outcome::StillBroken,
    };
    for (problems, side) in problems.iter_mut().zip(sides) {
        problems.extend(side.err().into_iter().flatten());
    }
    outcome
}

/// A path with its program.
///
/// # Errors
/// What kept the program from being made: then there is but the drawing, which has no moves.
fn seen(session: &Session<'_>, known: &Known) -> Result<ScenePath, Vec<Diagnostic>> {
    let seen = session.scene(known.file, std::slice::from_ref(&known.name), ShownText::Native);
    let path = seen.scene.paths.into_iter().next().filter(|path| path.gcode.is_some());
    // What is wrong with the drawing as a whole is told already.
    let is_of_path = |problem: &Diagnostic| problem.is_error() && problem.path.is_some();
    path.ok_or_else(|| seen.diagnostics.into_iter().filter(is_of_path).collect())
}
