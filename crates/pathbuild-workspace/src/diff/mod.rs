//! `diff`: compares the programs of all paths in two trees. (book: program/comparing)

mod reasons;
mod states;

use std::collections::{BTreeMap, HashMap};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::{Database, SourceFile, check_file, path_names, program};
use pathbuild_diagnostic::{Diagnostic, Lang};
use pathbuild_gcode::verify::Machine;
use pathbuild_path::PathName;
use pathbuild_toolpath::{Correction, Program as PathProgram};
use pathbuild_view::{
    Group, Picture, ScenePath, StockChange, Totals, changes_svg, compare, groups, stock_change_svg,
};

use crate::emit::ShownText;
use crate::inputs::Inputs;
use crate::post_processor::{PostArguments, PostProcessor, machine};
use crate::program::{DefinitionTranslation, ProgramReader, ReadingOptions};
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
    pub outcome: PathChangeKind,
}

/// The kind of difference of a path between the sides.
#[derive(Debug)]
pub enum PathChangeKind {
    /// The path exists on the new side only, without errors.
    Added,
    /// The path exists on the old side only.
    Removed,
    /// The path has errors on the new side only; it may not exist on the old side.
    Broken,
    /// The path has errors on the old side only.
    Mended,
    /// The path has errors on both sides, so its moves are unknown.
    StillBroken,
    /// The path has the same moves, but is defined in another drawing.
    OtherDrawing,
    /// The path's programs differ on the two sides, in their moves or in what they state besides moves.
    Changed(Box<ProgramDiff>),
}

impl PathChangeKind {
    /// Returns the outcome if the old or the new side has errors; `None` if neither has.
    pub fn of_errors(has_errors: [bool; 2]) -> Option<Self> {
        match has_errors {
            [false, false] => None,
            [false, true] => Some(Self::Broken),
            [true, false] => Some(Self::Mended),
            [true, true] => Some(Self::StillBroken),
        }
    }
}

/// Differences between the old and the new program of a path.
#[derive(Debug, Default)]
pub struct ProgramDiff {
    /// Changed moves, grouped by the kind of change.
    pub groups: Vec<Group>,
    /// Whether moves were compared as a whole, because there are too many pieces. The groups may then include more than what changed.
    pub has_undivided_moves: bool,
    /// Whether a post-processor cannot write one of the programs. Then only what the drawings define was compared, not the words of the programs.
    pub is_unwritten: bool,
    /// Changes of cutters, tools, spindle, work offsets, stops and the like, as far as they are known on both sides.
    pub states: Vec<StateChange>,
    /// Reasons for the changes; empty if no element and no setting differs. `None` if a side is not a drawing, if the drawings could not be compared,
    /// or if only `states` changed and no reason was found.
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
    /// Pictures of the stock that only the new program removes, and of the stock that only the old one removes.
    pub stock: Vec<String>,
}

/// Compares the moves of two programs. `pictures` is the language of the legends; `None` if no pictures are requested.
pub fn compare_moves(old: &ScenePath, new: &ScenePath, pictures: Option<Lang>) -> ProgramDiff {
    let compared = compare(&old.moves, &new.moves);
    let picture = |which, lang| changes_svg(&compared, which, lang);
    ProgramDiff {
        groups: groups(&compared),
        has_undivided_moves: compared.has_undivided_moves,
        is_unwritten: false,
        states: Vec::new(),
        reasons: None,
        totals: [old.totals, new.totals],
        pictures: pictures.filter(|_| !compared.changes.is_empty() || old.tool != new.tool).map(|lang| {
            PictureSet {
                changes: picture(Picture::Changes, lang),
                old: picture(Picture::Old, lang),
                new: picture(Picture::New, lang),
                stock: [StockChange::Removed, StockChange::Left]
                    .into_iter()
                    .filter_map(|change| stock_change_svg(old, new, change, lang))
                    .collect(),
            }
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
    let [old_paths, new_paths] = [old.paths(), new.paths()];
    let path_count = new_paths.paths.len();
    let unreadable = [old_paths.unreadable, new_paths.unreadable];
    let mut problems = [old_paths.problems, new_paths.problems];
    let [old_post, new_post] = [&*old.session, &*new.session]
        .map(|session| PostProcessor::for_run(session.workspace(), None, PostArguments::default()));
    let sides = [(&*old.session, old_post), (&*new.session, new_post)];
    let sides = [0, 1].map(|side| {
        let (session, post_processor) = &sides[side];
        let post_processor =
            post_processor.as_ref().map_err(|found| problems[side].extend(found.iter().cloned()));
        CompiledSide { session, post_processor: post_processor.ok().and_then(Option::as_ref) }
    });
    let [old, new] = sides;
    let is_written_alike = writer_identity(old) == writer_identity(new) && correction(old) == correction(new);
    let mut paths: Vec<PathDiff> = pair_up(old_paths.paths, new_paths.paths)
        .into_iter()
        .map(|pair| pair.with_unreadable(&unreadable))
        .filter_map(|pair| pair.compare(sides, is_written_alike, pictures, &mut problems))
        .collect();
    paths.sort_by(|a, b| compare_names(&a.name, &b.name).then_with(|| a.files.cmp(&b.files)));
    Comparison { paths, path_count, problems }
}

/// Returns everything that the programs of a post-processor depend on besides the drawings, and the machine whose travel programs must not exceed.
fn writer_identity(side: CompiledSide<'_>) -> (Option<Vec<u8>>, Option<Machine>) {
    (side.post_processor.map(PostProcessor::identity), machine(&side.session.workspace().settings))
}

/// Returns how the heights of programs with probes are corrected.
fn correction(side: CompiledSide<'_>) -> Correction {
    let settings = &side.session.workspace().settings;
    Correction { model: settings.general.z_model.value, longest: settings.z_split() }
}

/// The session and the post-processor that build the programs of one side.
#[derive(Clone, Copy)]
struct CompiledSide<'a> {
    session: &'a Session<'a>,
    /// The configured post-processor; `None` if programs are native, or if it has errors, which are reported.
    post_processor: Option<&'a PostProcessor>,
}

/// The paths of one side.
struct SidePaths {
    paths: Vec<HashedPath>,
    /// Drawings with errors in which no path can be found, relative to the root.
    unreadable: BTreeMap<Utf8PathBuf, SourceFile>,
    /// Diagnostics of the inputs and the drawings, and of programs that could not be built.
    problems: Vec<Diagnostic>,
}

impl Tree<'_, '_> {
    /// Finds the paths of this side, and hashes the moves of their programs.
    fn paths(&mut self) -> SidePaths {
        let selection = self.session.select(self.inputs);
        let files = selection.whole_drawings(self.session);
        let mut problems = selection.problems;
        let root = self.session.absolute(self.root);
        let mut unreadable = BTreeMap::new();
        let size = self.session.programs_per_batch(files.len());
        let paths = self.session.in_batches(&files, size, |session, files| {
            session.parse_ahead(files);
            let db = session.db();
            for file in files {
                let errors = check_file(db, *file).iter().filter(|problem| problem.is_error());
                let count = problems.len();
                problems.extend(errors.cloned());
                if problems.len() > count && path_names(db, *file).is_empty() {
                    unreadable.insert(session.place_below(&root, file.path(db)), *file);
                }
            }
            let mut paths = session.move_hashes(files, &root);
            problems.extend(paths.iter_mut().flat_map(|path| std::mem::take(&mut path.problems)));
            paths
        });
        SidePaths { paths, unreadable, problems }
    }
}

struct PathPair {
    old: Option<HashedPath>,
    new: Option<HashedPath>,
}

impl PathPair {
    /// Adds a path with errors on the side that lacks the path, if the drawing is there but cannot be read.
    fn with_unreadable(self, [old, new]: &[BTreeMap<Utf8PathBuf, SourceFile>; 2]) -> Self {
        let with_errors = |path: &HashedPath, unreadable: &BTreeMap<_, SourceFile>| {
            let file = *unreadable.get(&path.place)?;
            let (place, name) = (path.place.clone(), path.name.clone());
            let (problems, raised) = (Vec::new(), Vec::new());
            Some(HashedPath { file, place, name, target: path.target, moves: None, problems, raised })
        };
        match self {
            Self { old: Some(path), new: None } => Self { new: with_errors(&path, new), old: Some(path) },
            Self { old: None, new: Some(path) } => Self { old: with_errors(&path, old), new: Some(path) },
            pair => pair,
        }
    }
}

/// Pairs the paths of both sides: first those with the same name in the same drawing, then those with a name that remains exactly once on each side.
fn pair_up(old: Vec<HashedPath>, new: Vec<HashedPath>) -> Vec<PathPair> {
    let mut by_file: HashMap<(Utf8PathBuf, PathName), HashedPath> =
        old.into_iter().map(|known| ((known.place.clone(), known.name.clone()), known)).collect();
    let mut pairs = Vec::new();
    let mut alone = Vec::new();
    for known in new {
        match by_file.remove(&(known.place.clone(), known.name.clone())) {
            Some(old) => pairs.push(PathPair { old: Some(old), new: Some(known) }),
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
        pairs.push(PathPair { old, new: Some(known) });
    }
    pairs.extend(by_name.into_values().flatten().map(|old| PathPair { old: Some(old), new: None }));
    pairs
}

impl PathPair {
    fn compare(
        self,
        sides: [CompiledSide<'_>; 2],
        is_written_alike: bool,
        pictures: Option<Lang>,
        problems: &mut [Vec<Diagnostic>; 2],
    ) -> Option<PathDiff> {
        let Self { old, new } = self;
        let outcome = match (&old, &new) {
            (Some(old_path), Some(new_path)) => {
                let paths = [old_path, new_path];
                let is_same = is_written_alike && old_path.moves == new_path.moves;
                let changed =
                    PathChangeKind::of_errors(paths.map(|path| path.moves.is_none())).or_else(|| {
                        if is_same {
                            problems[1].extend_from_slice(&new_path.raised);
                            PathChangeKind::of_errors(paths.map(|path| !path.raised.is_empty()))
                        } else {
                            compare_programs(sides, paths, pictures, problems)
                        }
                    });
                match changed {
                    Some(outcome) => outcome,
                    None if old_path.place == new_path.place => return None,
                    None => PathChangeKind::OtherDrawing,
                }
            }
            (None, Some(path)) if path.moves.is_none() => PathChangeKind::Broken,
            (None, Some(path)) => {
                let refusals = sides[1].refusals(path);
                let outcome =
                    if refusals.is_empty() { PathChangeKind::Added } else { PathChangeKind::Broken };
                problems[1].extend(refusals);
                outcome
            }
            (Some(_), None) => PathChangeKind::Removed,
            (None, None) => return None,
        };
        let name = new.as_ref().or(old.as_ref())?.name.to_string();
        let files = [old, new].map(|known| known.map(|known| known.place));
        Some(PathDiff { name, files, outcome })
    }
}

/// Compares the two programs of a path; returns `None` if they do the same. If a limit prevents one of them from being built, there are no moves to
/// compare, and if the post-processor cannot write one of them, only the moves are compared. The diagnostics say why.
fn compare_programs(
    sides: [CompiledSide<'_>; 2],
    paths: [&HashedPath; 2],
    pictures: Option<Lang>,
    problems: &mut [Vec<Diagnostic>; 2],
) -> Option<PathChangeKind> {
    let programs = [0, 1].map(|side| sides[side].compile(paths[side]));
    let has_errors =
        programs.each_ref().map(|program| !matches!(program, Ok(compiled) if compiled.refusals.is_empty()));
    let changed = match &programs {
        [Ok(old), Ok(new)] => {
            let changes = compare_moves(&old.path, &new.path, pictures);
            let mut states = old.states.changes(&new.states);
            if changes.groups.is_empty() && states.is_empty() {
                states.extend(new.first_other_line(old, sides[1].post_processor));
            }
            (!changes.groups.is_empty() || !states.is_empty()).then(|| {
                let reasons = explain_change(sides.map(|side| side.session), paths, problems);
                // If only states changed and no reason was found, the states themselves show what changed in pathbuild.toml.
                let reasons = reasons.filter(|reasons| !reasons.is_empty() || !changes.groups.is_empty());
                let is_unwritten =
                    has_errors.contains(&true) && sides.iter().any(|side| side.post_processor.is_some());
                PathChangeKind::Changed(Box::new(ProgramDiff { is_unwritten, states, reasons, ..changes }))
            })
        }
        _ => None,
    };
    for (problems, program) in problems.iter_mut().zip(programs) {
        problems.extend(program.map_or_else(|errors| errors, |compiled| compiled.refusals));
    }
    changed.or_else(|| PathChangeKind::of_errors(has_errors))
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

/// The program of a path on one side.
struct CompiledPath {
    /// The scene of the path, with its native moves.
    path: ScenePath,
    states: MachineStates,
    /// The text that the post-processor writes; `None` for a native program, and if the post-processor refuses to write it.
    posted: Option<Vec<u8>>,
    /// Errors that keep `emit` from writing the program.
    refusals: Vec<Diagnostic>,
}

impl CompiledSide<'_> {
    /// Builds the program of a path.
    ///
    /// # Errors
    /// The errors that prevent the program from being built.
    fn compile(&self, known: &HashedPath) -> Result<CompiledPath, Vec<Diagnostic>> {
        let text = ShownText::Emitted(self.post_processor);
        let report = self.session.scene(known.file, std::slice::from_ref(&known.name), text);
        let Some(path) = report.scene.paths.into_iter().next().filter(|path| path.gcode.is_some()) else {
            // Errors of the drawing as a whole have been reported already.
            let is_of_path = |problem: &Diagnostic| problem.is_error() && problem.path.is_some();
            return Err(report.diagnostics.into_iter().filter(is_of_path).collect());
        };
        let posted = path.gcode.clone().filter(|_| path.native.is_some()).map(String::into_bytes);
        let states = self.states(known, &path, posted.as_deref()).map_err(|problem| vec![*problem])?;
        let refusals = [&*report.refusals, &known.raised].concat();
        Ok(CompiledPath { path, states, posted, refusals })
    }

    /// Returns the errors that keep `emit` from writing the program of a path.
    fn refusals(&self, known: &HashedPath) -> Vec<Diagnostic> {
        let mut refusals = self.session.refusals(known.file, &known.name, self.post_processor);
        refusals.extend_from_slice(&known.raised);
        refusals
    }

    /// Returns what the program states besides moves, according to the text that the post-processor writes, or else to the drawing.
    fn states(
        &self,
        known: &HashedPath,
        path: &ScenePath,
        posted: Option<&[u8]>,
    ) -> Result<MachineStates, Box<Diagnostic>> {
        let settings = &self.session.workspace().settings;
        let mut states = match self.post_processor.zip(posted) {
            None => MachineStates::of_drawing(path.tool),
            Some((post_processor, text)) => {
                let reading =
                    ReadingOptions { dialect: post_processor.reading_dialect(), ..ReadingOptions::default() };
                let translate = |text: &[u8], _: Option<&_>| {
                    let (name, translated) = (post_processor.name(), post_processor.translate(text)?);
                    Some(DefinitionTranslation { name, translated })
                };
                let reader = ProgramReader { settings, options: reading, definition: &translate };
                let program = reader.store((&*path.file).into(), text.to_vec())?;
                MachineStates::of(&program).with_drawn_cutter(path.tool)
            }
        };
        states.set_post_processor(&settings.general.post.value.name);
        let pecks =
            |db: &Database| program(db, known.target).as_deref().map_or_else(Vec::new, PathProgram::pecks);
        let writes_pecks = self.post_processor.is_some() && settings.general.cycles.value;
        let pecks = self.session.query_target(known.target, pecks)?;
        states.set_pecks(pecks.into_iter().map(|(_, depth)| depth.filter(|_| writes_pecks)));
        let probes = |db: &Database| program(db, known.target).as_deref().map(|found| found.probes.clone());
        let probes = self.session.query_target(known.target, probes)?.unwrap_or_default();
        states.set_probes(&probes);
        if !probes.is_empty() {
            states.set_correction(settings.general.z_model.value, settings.z_split());
        }
        Ok(states)
    }
}

impl CompiledPath {
    /// Returns the first line that differs from the old program and is no comment.
    fn first_other_line(&self, old: &Self, post_processor: Option<&PostProcessor>) -> Option<StateChange> {
        let (new, old) = (self.posted.as_ref()?, old.posted.as_ref()?);
        let (line, was) = post_processor?.first_other_line(new, old)?;
        let is = String::from_utf8_lossy(new);
        let is = is.lines().nth(line as usize - 1).unwrap_or_default().to_owned();
        Some(StateChange { kind: StateKind::OtherLine, words: [was, is], line: Some(line) })
    }
}
