//! Everything that a target reaches through embeddings. All graph-wide questions (cycles, depth, limits, diagnostics and dependencies) are
//! answered by the traversal in this file.

use std::borrow::Cow;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::slice;

use camino::Utf8PathBuf;
use pathbuild_diagnostic::messages::{files, paths as messages};
use pathbuild_diagnostic::{Code, Diagnostic, Point, TraceStep};
use pathbuild_path::{Bindings, PathName, PathOptions, PathRole, PathSignature, SubpathCall};
use pathbuild_toolpath::estimated_bytes;
use rustc_hash::{FxHashMap, FxHashSet};

use super::embedding::{Instance, path, summary};
use crate::database::Db;
use crate::inputs::{Limits, Role, Settings, SourceFile, Target};
use crate::queries::embedding::{Embedding, Outcome, direct_embeddings, is_about_misfit};
use crate::queries::index::{NameKey, PathSummary, keep_out_problems, path_index};
use crate::queries::lookup::{find_path, own_directory, search_path};
use crate::queries::part::{is_about_waste, part_problems};
use crate::queries::raw::raw_path;

/// The paths that a target reaches, including its own.
#[derive(Clone, Debug, Default, PartialEq, salsa::SalsaValue)]
pub struct Closure<'db> {
    /// The target's path with its values; `None` if the file has no such path.
    pub root: Option<Instance<'db>>,
    /// Every path, in the order in which it is first reached.
    pub reached: Vec<Instance<'db>>,
    /// Diagnostics of all paths in `reached`, without duplicates.
    pub diagnostics: Vec<Diagnostic>,
    /// Estimated number of moves in the program.
    pub moves: u64,
    /// Options that the program requires and that are not set.
    pub missing_options: Vec<MissingOption>,
}

/// An option that must be given because a path lacks the corresponding parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MissingOption {
    /// The option `--feed`, because a path needs a feed and gives none.
    Feed,
    /// The option `--sweep-height`, because the emitted path gives no S.
    SweepHeight,
}

impl MissingOption {
    /// The option's name in the configuration, and on the command line after the hyphens.
    pub fn name(self) -> &'static str {
        match self {
            Self::Feed => "feed",
            Self::SweepHeight => "sweep-height",
        }
    }
}

/// Maximum depth of embedding below the emitted path.
const MAX_EMBEDDING_DEPTH: u32 = 10;

/// Collects everything that a target embeds, directly or indirectly.
#[salsa::tracked]
pub fn closure(db: &dyn Db, target: Target) -> Closure<'_> {
    let Some((root, missing)) = root(db, target) else { return Closure::default() };
    if let Some(closure) = closure_without_embeddings(db, target, root) {
        return closure;
    }
    let mut walk = ClosureWalk::new(db, target.role(db));
    if missing.is_empty() {
        walk.visit(root, 0);
        walk.estimate_moves(root);
    } else {
        walk.reached.push(root);
        walk.report_all(root, &missing);
    }
    Closure {
        root: Some(root),
        reached: walk.reached,
        diagnostics: walk.diagnostics,
        moves: walk.moves,
        missing_options: walk.missing_options,
    }
}

/// Returns the closure of a checked path without embeddings and findings, which is by far the most common case; `None` for any other path.
fn closure_without_embeddings<'db>(
    db: &'db dyn Db,
    target: Target,
    root: Instance<'db>,
) -> Option<Closure<'db>> {
    let (own, limits) = (summary(db, root), Settings::get(db).limits(db));
    let has_raised = own.signature.as_ref().is_some_and(PathSignature::compares_probes);
    let is_plain = own.is_clean()
        && keep_out_problems(db, target.file(db)).is_empty()
        && part_problems(db, root).is_empty();
    let is_lone = *target.role(db) == Role::Checked && is_plain && !own.has_subpaths() && !has_raised;
    let is_within = size_limit_problem(own.moves, limits).is_none() && limits.paths > 0;
    let reached = vec![root];
    let closure = || Closure { root: Some(root), reached, moves: own.moves, ..Closure::default() };
    (is_lone && is_within).then(closure)
}

/// Returns a target's path with its values, and errors about missing values. If the path has errors of its own, these are reported first, with the
/// values of a check in place of missing ones. `None` if the file has no such path.
pub(super) fn root(db: &dyn Db, target: Target) -> Option<(Instance<'_>, Vec<Diagnostic>)> {
    let name = NameKey::of(db, &PathName::new(target.name(db)));
    let file = target.file(db);
    let index = path_index(db, file, name).as_ref()?;
    let bindings = match target.role(db) {
        Role::Emitted => Bindings::default(),
        Role::Checked => index.examples.clone(),
        Role::CheckedWith(bindings) => bindings.clone(),
    };
    if bindings.has_all(&index.header.definitions) {
        return Some((Instance::new(db, file, name, bindings), Vec::new()));
    }
    let missing =
        if index.header.is_sound { raw_path(db, file, name)?.missing_values(&bindings) } else { Vec::new() };
    Some((Instance::new(db, file, name, index.examples.clone()), missing))
}

impl Closure<'_> {
    /// Whether any path of the closure has errors, or the target names no path of its file.
    pub fn has_errors(&self) -> bool {
        self.root.is_none() || self.diagnostics.iter().any(Diagnostic::is_error)
    }

    /// Whether errors or missing options leave the program's moves unknown. Cuts into a part or through a support bar are errors too, but leave the
    /// moves known.
    pub fn has_unknown_moves(&self) -> bool {
        let is_harm = |problem: &Diagnostic| matches!(problem.code(), Code::GougedPart | Code::BarCutAway);
        let is_other = |problem: &Diagnostic| problem.is_error() && !is_harm(problem);
        self.root.is_none() || !self.missing_options.is_empty() || self.diagnostics.iter().any(is_other)
    }

    /// Returns the drawings that define the reached paths, each once.
    pub fn files(&self, db: &dyn Db) -> Vec<SourceFile> {
        let mut seen = FxHashSet::default();
        let files = self.reached.iter().map(|reached| reached.file(db));
        files.filter(|file| seen.insert(*file)).collect()
    }
}

struct ClosureWalk<'db> {
    db: &'db dyn Db,
    is_emitted: bool,
    options: PathOptions,
    missing_options: Vec<MissingOption>,
    limits: Limits,
    reached: Vec<Instance<'db>>,
    diagnostics: Vec<Diagnostic>,
    /// Indices of the reported diagnostics, by hash of their identity.
    known: FxHashMap<u64, Vec<usize>>,
    moves: u64,
    /// The errors of a path and of everything that it embeds. The depth is part of the key because embedding may be too deep at one depth only.
    visited: FxHashMap<(Instance<'db>, u32), PathErrors<'db>>,
    /// Height in mm of the highest point of a path and of everything that the path embeds, above the plane of the path.
    tops: FxHashMap<Instance<'db>, f64>,
    seen: FxHashSet<Instance<'db>>,
    /// The embeddings that lead to the path being visited.
    stack: Vec<VisitedPath<'db>>,
    /// Whether the limit on the number of paths was exceeded, and this was reported.
    is_full: bool,
}

/// The most serious error of a path and everything that it embeds. It decides whether an embedding path reports an error of its own.
#[derive(Clone, Copy, PartialEq)]
enum PathErrors<'db> {
    /// Neither the path nor anything that it embeds has errors.
    None,
    /// Embedding is too deep below the target. The fault is the target's alone, not that of the paths in between.
    TooDeep,
    /// The path is part of a cycle that begins with the given path; all embeddings of the cycle are reported.
    Cycle(Instance<'db>),
    /// The path, or one that it embeds, has other errors.
    Own,
}

impl PathErrors<'_> {
    fn of(has_errors: bool) -> Self {
        if has_errors { Self::Own } else { Self::None }
    }

    fn are_none(self) -> bool {
        self == Self::None
    }

    /// Returns the more serious one of two errors.
    fn and(self, other: Self) -> Self {
        let rank = |errors: &Self| match errors {
            Self::None => 0,
            Self::TooDeep => 1,
            Self::Cycle(_) => 2,
            Self::Own => 3,
        };
        if rank(&other) > rank(&self) { other } else { self }
    }
}

struct VisitedPath<'db> {
    instance: Instance<'db>,
    name: PathName,
    point: Point,
}

impl<'db> ClosureWalk<'db> {
    fn new(db: &'db dyn Db, role: &Role) -> Self {
        let settings = Settings::get(db);
        Self {
            db,
            is_emitted: *role == Role::Emitted,
            options: settings.fold(db),
            missing_options: Vec::new(),
            limits: settings.limits(db),
            reached: Vec::new(),
            diagnostics: Vec::new(),
            known: FxHashMap::default(),
            moves: 0,
            visited: FxHashMap::default(),
            tops: FxHashMap::default(),
            seen: FxHashSet::default(),
            stack: Vec::new(),
            is_full: false,
        }
    }

    /// Visits a path and everything that it embeds, each once per depth. Returns their most serious error.
    fn visit(&mut self, instance: Instance<'db>, depth: u32) -> PathErrors<'db> {
        if let Some(errors) = self.visited.get(&(instance, depth)) {
            return *errors;
        }
        self.db.unwind_if_revision_cancelled();
        if self.seen.insert(instance) {
            self.reached.push(instance);
        }
        if self.exceeds_path_limit(instance) {
            return PathErrors::Own;
        }
        let errors = self.visit_stages(instance, depth);
        self.visited.insert((instance, depth), errors);
        errors
    }

    /// Reports the findings in one path, stage by stage, and visits what it embeds. Returns their most serious error. Each stage skips errors that
    /// merely follow from those of earlier stages.
    fn visit_stages(&mut self, instance: Instance<'db>, depth: u32) -> PathErrors<'db> {
        let db = self.db;
        let summary = summary(db, instance);
        let mut has_errors = self.report_all(instance, keep_out_problems(db, instance.file(db)));
        let problems = summary.problems.iter().filter(|found| !is_about_waste(db, instance, found));
        has_errors |= self.report_all(instance, problems);
        if let Some(signature) = &summary.signature {
            self.check_feed(instance, signature);
            let sweep_problems = self.sweep_problems(summary, signature, depth);
            has_errors |= self.report_all(instance, sweep_problems.iter());
        }
        let problems = summary.walk_problems.iter().filter(|found| !is_about_misfit(db, instance, found));
        has_errors |= self.report_all(instance, problems);
        has_errors |= self.report_all(instance, part_problems(self.db, instance));
        let Some(signature) = summary.known_signature() else { return PathErrors::Own };
        let mut errors = PathErrors::of(has_errors || summary.signature.is_none());
        for embedding in direct_embeddings(self.db, instance) {
            errors = errors.and(self.visit_embedding(instance, &signature.name, embedding, depth));
        }
        if errors.are_none() {
            errors = PathErrors::of(self.check_raised_heights(instance, signature, depth));
        }
        errors
    }

    /// Checks that the sweeps of a path clear the probes and subpaths that H raises. Returns whether there are errors.
    fn check_raised_heights(
        &mut self,
        instance: Instance<'db>,
        signature: &PathSignature,
        depth: u32,
    ) -> bool {
        let calls = signature.subpaths.iter().zip(direct_embeddings(self.db, instance));
        let raised = calls.filter_map(|(call, embedding)| match &embedding.outcome {
            Outcome::Found { child, .. } => Some((call, call.subpath.height + self.tops.get(child)?)),
            _ => None,
        });
        let raised: Vec<(&SubpathCall, f64)> = raised.collect();
        let top = raised.iter().map(|(_, top)| *top).fold(signature.own_top(), f64::max);
        self.tops.insert(instance, top);
        if self.options.compatible {
            return false;
        }
        let mut problems = signature.own_sweep_problems(top);
        let Some(height) = self.sweep_height(signature, depth) else {
            return self.report_all(instance, &problems);
        };
        problems.extend(signature.raised_probe_problems(height));
        let of_subpath =
            |(call, top): &(&SubpathCall, f64)| signature.raised_subpath_problem(call, height, *top);
        problems.extend(raised.iter().filter_map(of_subpath));
        self.report_all(instance, &problems)
    }

    /// Returns S of a path in its role; `None` if it is unknown: a path that is checked on its own may later be emitted with another S than T + O.
    fn sweep_height(&self, signature: &PathSignature, depth: u32) -> Option<f64> {
        match (depth, self.is_emitted) {
            (0, true) => signature.sweep_height(&self.options, PathRole::Emitted),
            (0, false) => signature.sweep_height,
            _ => signature.sweep_height(&self.options, PathRole::Embedded),
        }
    }

    /// Checks S of a path in its role, and records `--sweep-height` as missing if S is needed but set nowhere.
    fn sweep_problems(
        &mut self,
        summary: &'db PathSummary,
        signature: &PathSignature,
        depth: u32,
    ) -> Cow<'db, [Diagnostic]> {
        if !self.is_emitted || depth > 0 {
            return Cow::Borrowed(&summary.sweep_problems);
        }
        let Some(height) = signature.sweep_height(&self.options, PathRole::Emitted) else {
            self.record_missing_option(MissingOption::SweepHeight);
            return Cow::default();
        };
        Cow::Owned(signature.low_sweep_problems(height, PathRole::Emitted))
    }

    /// Checks the feed that a path without F of its own gets in an emitted program, and records `--feed` as missing if there is none.
    fn check_feed(&mut self, instance: Instance<'db>, signature: &PathSignature) {
        if !self.is_emitted || !signature.needs_feed {
            return;
        }
        let Some(feed) = self.options.feed else { return self.record_missing_option(MissingOption::Feed) };
        let language = Settings::get(self.db).language(self.db);
        let limits = language.tools.chip_load(signature.name.as_str(), signature.tool);
        let chips = limits.and_then(|limits| limits.check(feed, None));
        let doubts = language.doubts.fallback_feed(feed).into_iter().chain(chips);
        let doubts: Vec<_> = doubts.map(|problem| problem.in_path(signature.name.as_str())).collect();
        self.report_all(instance, &doubts);
    }

    fn record_missing_option(&mut self, option: MissingOption) {
        if !self.missing_options.contains(&option) {
            self.missing_options.push(option);
        }
    }

    fn visit_embedding(
        &mut self,
        instance: Instance<'db>,
        outer: &PathName,
        embedding: &Embedding<'db>,
        depth: u32,
    ) -> PathErrors<'db> {
        self.report_all(instance, &embedding.warnings);
        let origin = &embedding.origin;
        let frame = VisitedPath { instance, name: outer.clone(), point: origin.point };
        let has_errors = match &embedding.outcome {
            Outcome::Refused(problem) => self.report_all(instance, slice::from_ref(problem)),
            _ if depth >= MAX_EMBEDDING_DEPTH => {
                let problem = self.depth_error(&frame, embedding);
                self.report_all(instance, &[origin.at(problem)]);
                return PathErrors::TooDeep;
            }
            Outcome::NotFound(problem) => self.report_all(instance, slice::from_ref(problem)),
            Outcome::Unread(problems) | Outcome::Unbound(problems) => self.report_all(instance, problems),
            Outcome::Found { child, .. } if self.is_being_visited(*child, instance) => {
                let problem = self.cycle_error(&frame, *child);
                self.report_all(instance, &[origin.at(problem)]);
                return PathErrors::Cycle(*child);
            }
            Outcome::Found { child, problems } => {
                self.stack.push(frame);
                let errors = self.visit(*child, depth + 1);
                self.stack.pop();
                let is_reported = match errors {
                    PathErrors::None | PathErrors::Own => false,
                    PathErrors::TooDeep => true,
                    PathErrors::Cycle(first) => self.is_part_of_cycle(first, instance),
                };
                if is_reported {
                    return errors;
                }
                if !errors.are_none() {
                    // Errors in the embedded path may hide whether it fits.
                    let problem = Diagnostic::new(&messages::HAS_ERRORS)
                        .quoting("name", self.name_of(*child))
                        .quoting("file", child.file(self.db).path(self.db).as_str())
                        .in_path(outer.as_str());
                    self.report_all(instance, &[origin.at(problem)]);
                    return PathErrors::Own;
                }
                self.report_all(instance, problems)
            }
        };
        PathErrors::of(has_errors)
    }

    /// Whether the path being visited is part of a cycle that begins with `first`, whatever values its variables have.
    fn is_part_of_cycle(&self, first: Instance<'db>, visiting: Instance<'db>) -> bool {
        let place = |instance: Instance<'db>| (instance.file(self.db), instance.name(self.db));
        place(first) == place(visiting)
            || self.stack.iter().any(|frame| place(frame.instance) == place(first))
    }

    /// Whether a path is already being visited, so that embedding it again would recurse for ever.
    fn is_being_visited(&self, child: Instance<'db>, visiting: Instance<'db>) -> bool {
        child == visiting || self.stack.iter().any(|frame| frame.instance == child)
    }

    fn cycle_error(&self, frame: &VisitedPath<'db>, child: Instance<'db>) -> Diagnostic {
        let open = self.stack.iter().skip_while(|open| open.instance != child);
        let mut names: Vec<String> = open.map(|open| open.name.to_string()).collect();
        names.push(frame.name.to_string());
        names.push(self.name_of(child));
        Diagnostic::new(&messages::CYCLE)
            .quoting("name", self.name_of(child))
            .quoting("chain", names.join(" > "))
            .in_path(frame.name.as_str())
    }

    fn depth_error(&self, frame: &VisitedPath<'db>, embedding: &Embedding<'db>) -> Diagnostic {
        let mut names: Vec<String> = self.stack.iter().map(|open| open.name.to_string()).collect();
        names.push(frame.name.to_string());
        let name = match &embedding.outcome {
            Outcome::Found { child, .. } => self.name_of(*child),
            _ => "?".to_owned(),
        };
        Diagnostic::new(&messages::TOO_DEEP)
            .quoting("name", name)
            .with("limit", u64::from(MAX_EMBEDDING_DEPTH))
            .quoting("chain", names.join(" > "))
            .in_path(frame.name.as_str())
    }

    fn name_of(&self, instance: Instance<'db>) -> String {
        let name = instance.name(self.db);
        let index = path_index(self.db, instance.file(self.db), name).as_ref();
        index.map_or_else(|| name.folded(self.db).to_owned(), |index| index.header.name.to_string())
    }

    /// Reports the findings in a path, skipping duplicates. Returns whether any is an error.
    fn report_all<'f>(
        &mut self,
        instance: Instance<'db>,
        found: impl IntoIterator<Item = &'f Diagnostic>,
    ) -> bool {
        let mut has_errors = false;
        for mut diagnostic in found.into_iter().cloned() {
            has_errors |= diagnostic.is_error();
            diagnostic.file.get_or_insert_with(|| instance.file(self.db).path(self.db).clone());
            let same = self.known.entry(hash(&identity(&diagnostic))).or_default();
            if !same.iter().any(|index| identity(&self.diagnostics[*index]) == identity(&diagnostic)) {
                same.push(self.diagnostics.len());
                diagnostic.trace = self.current_trace();
                self.diagnostics.push(diagnostic);
            }
        }
        has_errors
    }

    fn current_trace(&self) -> Vec<TraceStep> {
        let step = |frame: &VisitedPath<'db>| TraceStep {
            file: frame.instance.file(self.db).path(self.db).clone(),
            path: frame.name.as_str().into(),
            point: frame.point,
        };
        self.stack.iter().map(step).collect()
    }

    /// Whether the number of distinct paths exceeds the limit, which is reported once.
    fn exceeds_path_limit(&mut self, instance: Instance<'db>) -> bool {
        let Limits { paths, .. } = self.limits;
        if self.reached.len() as u64 <= paths {
            return false;
        }
        if !std::mem::replace(&mut self.is_full, true) {
            let problem = Diagnostic::new(&files::TOO_MANY_PATHS).quoting("key", "embedded-paths");
            self.report_limit(instance, problem.with("limit", paths));
        }
        true
    }

    /// Estimates the number of moves in the program before generating them.
    fn estimate_moves(&mut self, root: Instance<'db>) {
        if self.diagnostics.iter().any(Diagnostic::is_error) {
            return;
        }
        self.moves = self.moves_of(root, &mut FxHashMap::default());
        if let Some(problem) = size_limit_problem(self.moves, self.limits) {
            self.report_limit(root, problem);
        }
    }

    fn moves_of(&self, instance: Instance<'db>, known: &mut FxHashMap<Instance<'db>, u64>) -> u64 {
        if let Some(moves) = known.get(&instance) {
            return *moves;
        }
        let own = summary(self.db, instance).moves;
        let embedded =
            direct_embeddings(self.db, instance).iter().filter_map(|embedding| match &embedding.outcome {
                Outcome::Found { child, .. } => Some(*child),
                _ => None,
            });
        let moves = embedded.fold(own, |sum, child| sum.saturating_add(self.moves_of(child, known)));
        known.insert(instance, moves);
        moves
    }

    fn report_limit(&mut self, instance: Instance<'db>, mut problem: Diagnostic) {
        if let Some(path) = &path(self.db, instance).path {
            problem = path.start_origin.at(problem.in_path(path.name.as_str()));
        }
        self.report_all(instance, &[problem]);
    }
}

/// Returns PB005 if a program of this many moves would be too long or take too much memory.
fn size_limit_problem(count: u64, limits: Limits) -> Option<Diagnostic> {
    let size = estimated_bytes(count);
    let problem = if count > limits.moves {
        Diagnostic::new(&files::TOO_MANY_MOVES).quoting("key", "embedding-moves").with("limit", limits.moves)
    } else if size > limits.memory {
        let problem = Diagnostic::new(&files::TOO_MUCH_MEMORY).quoting("key", "program-memory");
        problem.with("size", size).with("limit", limits.memory)
    } else {
        return None;
    };
    Some(problem.with("count", count))
}

/// Returns the identity of a diagnostic for removing duplicates, which does not include its notes and the embeddings that lead to it.
fn identity(diagnostic: &Diagnostic) -> impl Hash + PartialEq + '_ {
    let Diagnostic { message, place, path, file, arguments, text, .. } = diagnostic;
    (message, place, path, file, arguments, text)
}

fn hash(value: &impl Hash) -> u64 {
    let mut hasher = DefaultHasher::new();
    value.hash(&mut hasher);
    hasher.finish()
}

/// A subpath segment of a path in a closure.
#[derive(Clone, Debug, PartialEq)]
pub struct Edge<'db> {
    /// The path that contains the segment.
    pub from: Instance<'db>,
    /// The start of the segment, in the drawing of the path that contains it.
    pub point: Point,
    /// The path that the segment embeds.
    pub to: Destination<'db>,
}

/// The path that a subpath segment leads to.
#[derive(Clone, Debug, PartialEq)]
pub enum Destination<'db> {
    /// A path with the values of its variables.
    Path(Instance<'db>),
    /// No path. If there are several reasons, only the first one is kept.
    Nowhere {
        /// The name that the segment gives, if any.
        name: Option<PathName>,
        /// The code of the finding that gives the reason.
        code: Code,
    },
}

impl<'db> Closure<'db> {
    /// Returns all embeddings, ordered by path as first reached, then by segment.
    pub fn edges(&self, db: &'db dyn Db) -> Vec<Edge<'db>> {
        let of_path = |from: Instance<'db>| {
            direct_embeddings(db, from).iter().map(move |embedding| edge(from, embedding))
        };
        self.reached.iter().flat_map(|reached| of_path(*reached)).collect()
    }
}

fn edge<'db>(from: Instance<'db>, embedding: &Embedding<'db>) -> Edge<'db> {
    let nowhere = |code| Destination::Nowhere { name: embedding.name.as_deref().cloned(), code };
    let to = match &embedding.outcome {
        Outcome::Found { child, .. } => Destination::Path(*child),
        Outcome::Refused(problem) | Outcome::NotFound(problem) => nowhere(problem.code()),
        // A segment that could not be read or bound has at least one problem.
        Outcome::Unread(problems) | Outcome::Unbound(problems) => {
            nowhere(problems.first().map_or(Code::MissingVariableValue, Diagnostic::code))
        }
    };
    Edge { from, point: embedding.origin.point, to }
}

/// Everything that a target depends on, apart from the settings.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Trace {
    /// The drawings that were read, starting with the target's own, including those that were searched without a match.
    pub files: Vec<SourceFile>,
    /// The names that were looked up, with the searched directories.
    pub lookups: Vec<NameLookup>,
}

/// A lookup of a path by its name, with the directories that were searched.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct NameLookup {
    /// Name of the path.
    pub name: PathName,
    /// The directories that were searched for the path, in order.
    pub directories: Vec<Utf8PathBuf>,
}

/// Returns the trace of a target. An edit outside of it cannot change the target's results.
#[salsa::tracked]
pub fn trace(db: &dyn Db, target: Target) -> Trace {
    let (mut files, mut lookups) = (UniqueList::default(), UniqueList::default());
    files.push(target.file(db));
    for reached in &closure(db, target).reached {
        let from = reached.file(db);
        files.push(from);
        for name in direct_embeddings(db, *reached).iter().filter_map(|embedding| embedding.name.as_ref()) {
            let resolved = find_path(db, from, NameKey::of(db, name));
            resolved.searched.iter().for_each(|file| files.push(*file));
            let directories =
                search_path(db, own_directory(db, from)).iter().map(|directory| directory.path(db).clone());
            lookups.push(NameLookup { name: (**name).clone(), directories: directories.collect() });
        }
    }
    Trace { files: files.all, lookups: lookups.all }
}

/// A list without duplicates, in the order in which items were added.
struct UniqueList<T> {
    all: Vec<T>,
    seen: FxHashSet<T>,
}

impl<T: Clone + Eq + Hash> UniqueList<T> {
    fn push(&mut self, one: T) {
        if self.seen.insert(one.clone()) {
            self.all.push(one);
        }
    }
}

impl<T> Default for UniqueList<T> {
    fn default() -> Self {
        Self { all: Vec::new(), seen: FxHashSet::default() }
    }
}
