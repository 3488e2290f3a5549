//! Everything that a target reaches through embeddings. The one place that walks the embedding: cycles, depth, limits, diagnostics and
//! dependencies all come from here.

use std::borrow::Cow;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::slice;

use pathbuild_diagnostic::messages::{files, subpaths as messages};
use pathbuild_diagnostic::{Diagnostic, Point, TraceStep};
use pathbuild_path::{Bindings, PathName, PathOptions, PathRole, PathSignature, SubpathCall};
use pathbuild_toolpath::memory;
use rustc_hash::{FxHashMap, FxHashSet};

use super::embedding::{Embedding, Outcome, embeds};
use super::index::{NameKey, path_index};
use super::instance::{Instance, path, summary};
use super::keep_outs::keep_out_problems;
use super::raw::raw_path;
use super::summary::PathSummary;
use crate::db::Db;
use crate::inputs::{Role, SourceFile, Target};
use crate::settings::{Limits, Settings};

/// What a target reaches, itself included.
#[derive(Clone, Debug, Default, PartialEq, salsa::SalsaValue)]
pub struct Closure<'db> {
    /// The target's path with its values; `None` when the file has no such path.
    pub root: Option<Instance<'db>>,
    /// Every path, in the order in which it is reached first.
    pub reached: Vec<Reached<'db>>,
    /// What is wrong with any of them, each once.
    pub diagnostics: Vec<Diagnostic>,
    /// About how many moves the program comes to.
    pub moves: u64,
    /// Values of the options that the program cannot be made without, and that are not given.
    pub missing_options: Vec<MissingOption>,
}

/// An option that must be given because a path does not say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MissingOption {
    /// `--feed`.
    Feed,
    /// `--sweep-height`.
    SweepHeight,
}

impl MissingOption {
    /// Its name on the command line, without hyphens, and in the configuration.
    pub fn name(self) -> &'static str {
        match self {
            Self::Feed => "feed",
            Self::SweepHeight => "sweep-height",
        }
    }
}

/// A path that a target reaches.
#[derive(Clone, Debug, PartialEq, salsa::SalsaValue)]
pub struct Reached<'db> {
    /// The path with its values.
    pub instance: Instance<'db>,
    /// How far below the target it is reached first.
    pub depth: u32,
}

/// How deep embedding may be below the emitted path.
const DEEPEST: u32 = 10;

/// Walks what a target embeds.
#[salsa::tracked]
pub fn closure(db: &dyn Db, target: Target) -> Closure<'_> {
    let Some((root, missing)) = root(db, target) else { return Closure::default() };
    if let Some(closure) = lone(db, target, root) {
        return closure;
    }
    let mut walk = Walk::new(db, target.role(db));
    if missing.is_empty() {
        walk.visit(root, 0);
        walk.count(root);
    } else {
        walk.reached.push(Reached { instance: root, depth: 0 });
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

/// The closure of a checked path that embeds nothing and has no findings, as nearly all are.
fn lone<'db>(db: &'db dyn Db, target: Target, root: Instance<'db>) -> Option<Closure<'db>> {
    let (own, limits) = (summary(db, root), Settings::get(db).limits(db));
    let has_raised = own.signature.as_ref().is_some_and(|it| !it.raised_probes.is_empty());
    let is_plain = own.is_clean() && keep_out_problems(db, target.file(db)).is_empty();
    let is_lone = *target.role(db) == Role::Checked && is_plain && !own.has_subpaths() && !has_raised;
    let is_within = too_much(own.moves, limits).is_none() && limits.paths > 0;
    let reached = vec![Reached { instance: root, depth: 0 }];
    let closure = || Closure { root: Some(root), reached, moves: own.moves, ..Closure::default() };
    (is_lone && is_within).then(closure)
}

/// A target's path with its values, and what is wrong with the values that it has not; `None` when the file has no such path.
pub(super) fn root(db: &dyn Db, target: Target) -> Option<(Instance<'_>, Vec<Diagnostic>)> {
    let name = NameKey::of(db, &PathName::new(target.name(db)));
    let file = target.file(db);
    let index = path_index(db, file, name).as_ref()?;
    let bindings = match target.role(db) {
        Role::Emitted => Bindings::default(),
        Role::Checked => index.examples.clone(),
        Role::CheckedWith(bindings) => bindings.clone(),
    };
    let missing = if index.header.is_sound && !bindings.cover(&index.header.definitions) {
        raw_path(db, file, name)?.missing_values(&bindings)
    } else {
        Vec::new()
    };
    Some((Instance::new(db, file, name, bindings), missing))
}

impl Closure<'_> {
    /// Whether any path in it has errors.
    pub fn has_errors(&self) -> bool {
        self.root.is_none() || self.diagnostics.iter().any(Diagnostic::is_error)
    }

    /// The files that it was made from.
    pub fn files(&self, db: &dyn Db) -> Vec<SourceFile> {
        let mut seen = FxHashSet::default();
        let files = self.reached.iter().map(|reached| reached.instance.file(db));
        files.filter(|file| seen.insert(*file)).collect()
    }
}

struct Walk<'db> {
    db: &'db dyn Db,
    is_emitted: bool,
    options: PathOptions,
    missing_options: Vec<MissingOption>,
    limits: Limits,
    reached: Vec<Reached<'db>>,
    diagnostics: Vec<Diagnostic>,
    /// Hashes of what makes them different from each other.
    known: FxHashMap<u64, Vec<usize>>,
    moves: u64,
    /// Whether a path at a depth has errors, itself or below: the depth counts since it may be too deep there.
    visited: FxHashMap<(Instance<'db>, u32), bool>,
    /// The highest that a path and all that it embeds stand, in mm above the plane that it lies on.
    tops: FxHashMap<Instance<'db>, f64>,
    seen: FxHashSet<Instance<'db>>,
    /// The embeddings that lead to the path being visited.
    stack: Vec<Frame<'db>>,
    is_full: bool,
}

struct Frame<'db> {
    instance: Instance<'db>,
    name: PathName,
    point: Point,
}

impl<'db> Walk<'db> {
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

    /// Visits a path and what it embeds; whether there are errors in any of them.
    fn visit(&mut self, instance: Instance<'db>, depth: u32) -> bool {
        if let Some(has_errors) = self.visited.get(&(instance, depth)) {
            return *has_errors;
        }
        self.db.unwind_if_revision_cancelled();
        if self.seen.insert(instance) {
            self.reached.push(Reached { instance, depth });
        }
        if self.is_crowded(instance) {
            return true;
        }
        let has_errors = self.visit_stages(instance, depth);
        self.visited.insert((instance, depth), has_errors);
        has_errors
    }

    /// The stages of one path. Each reports what does not follow from what earlier stages found.
    fn visit_stages(&mut self, instance: Instance<'db>, depth: u32) -> bool {
        let summary = summary(self.db, instance);
        let mut has_errors = self.report_all(instance, keep_out_problems(self.db, instance.file(self.db)));
        has_errors |= self.report_all(instance, &summary.problems);
        if let Some(signature) = &summary.signature {
            self.check_feed(instance, signature);
            let sweep_problems = self.sweep_problems(summary, signature, depth);
            has_errors |= self.report_all(instance, &sweep_problems);
        }
        has_errors |= self.report_all(instance, &summary.walk_problems);
        let Some(signature) = summary.known_signature() else { return true };
        for embedding in embeds(self.db, instance) {
            has_errors |= self.visit_embedding(instance, &signature.name, embedding, depth);
        }
        has_errors |= summary.signature.is_none();
        if !has_errors {
            has_errors |= self.visit_raised(instance, signature, depth);
        }
        has_errors
    }

    /// Holds what H raises against the sweeps of a path; whether there are errors.
    fn visit_raised(&mut self, instance: Instance<'db>, signature: &PathSignature, depth: u32) -> bool {
        let calls = signature.subpaths.iter().zip(embeds(self.db, instance));
        let raised = calls.filter_map(|(call, embedding)| match &embedding.outcome {
            Outcome::Found { child, .. } => Some((call, call.subpath.height + self.tops.get(child)?)),
            _ => None,
        });
        let raised: Vec<(&SubpathCall, f64)> = raised.collect();
        let top = raised.iter().map(|(_, top)| *top).fold(signature.own_top(), f64::max);
        self.tops.insert(instance, top);
        let Some(height) = self.sweep_height(signature, depth).filter(|_| !self.options.compatible) else {
            return false;
        };
        let mut problems = signature.raised_probe_problems(height);
        let of_subpath =
            |(call, top): &(&SubpathCall, f64)| signature.raised_subpath_problem(call, height, *top);
        problems.extend(raised.iter().filter_map(of_subpath));
        self.report_all(instance, &problems)
    }

    /// S of a path in its role, where somebody says it: a path that is checked by itself may be emitted with another than T + O.
    fn sweep_height(&self, signature: &PathSignature, depth: u32) -> Option<f64> {
        match (depth, self.is_emitted) {
            (0, true) => signature.sweep_height(&self.options, PathRole::Emitted),
            (0, false) => signature.sweep_height,
            _ => signature.sweep_height(&self.options, PathRole::Embedded),
        }
    }

    /// What is wrong with S of a path in its role. Where nobody says S and it is needed, that is noted.
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
            self.miss(MissingOption::SweepHeight);
            return Cow::default();
        };
        Cow::Owned(signature.sweep_limits.check(height))
    }

    /// The feed of a path that has no F of its own.
    fn check_feed(&mut self, instance: Instance<'db>, signature: &PathSignature) {
        if !self.is_emitted || !signature.needs_feed {
            return;
        }
        let Some(feed) = self.options.feed else { return self.miss(MissingOption::Feed) };
        let doubt = Settings::get(self.db).language(self.db).doubts.fallback_feed(feed);
        let doubt = doubt.map(|problem| problem.in_path(signature.name.as_str()));
        self.report_all(instance, doubt.as_slice());
    }

    fn miss(&mut self, option: MissingOption) {
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
    ) -> bool {
        self.report_all(instance, &embedding.warnings);
        let origin = &embedding.origin;
        let frame = Frame { instance, name: outer.clone(), point: origin.point };
        match &embedding.outcome {
            Outcome::Refused(problem) => self.report_all(instance, slice::from_ref(problem)),
            _ if depth >= DEEPEST => {
                let problem = self.too_deep(&frame, embedding);
                self.report_all(instance, &[origin.at(problem)])
            }
            Outcome::NotFound(problem) => self.report_all(instance, slice::from_ref(problem)),
            Outcome::Unlisted(problems) | Outcome::Unbound(problems) => self.report_all(instance, problems),
            Outcome::Found { child, .. } if self.is_open(*child, instance) => {
                let problem = self.cycle(&frame, *child);
                self.report_all(instance, &[origin.at(problem)])
            }
            Outcome::Found { child, problems } => {
                self.stack.push(frame);
                let has_errors = self.visit(*child, depth + 1);
                self.stack.pop();
                if has_errors {
                    // Whether the two fit may depend on what is wrong there.
                    let problem = Diagnostic::new(&messages::HAS_ERRORS)
                        .with("name", self.name_of(*child))
                        .with("file", child.file(self.db).path(self.db).as_str())
                        .in_path(outer.as_str());
                    return self.report_all(instance, &[origin.at(problem)]);
                }
                self.report_all(instance, problems)
            }
        }
    }

    /// Whether a path is being visited: to embed it once more would never end.
    fn is_open(&self, child: Instance<'db>, visiting: Instance<'db>) -> bool {
        child == visiting || self.stack.iter().any(|frame| frame.instance == child)
    }

    fn cycle(&self, frame: &Frame<'db>, child: Instance<'db>) -> Diagnostic {
        let open = self.stack.iter().skip_while(|open| open.instance != child);
        let mut names: Vec<String> = open.map(|open| open.name.to_string()).collect();
        names.push(frame.name.to_string());
        names.push(self.name_of(child));
        Diagnostic::new(&messages::CYCLE)
            .with("name", self.name_of(child))
            .with("chain", names.join(" > "))
            .in_path(frame.name.as_str())
    }

    fn too_deep(&self, frame: &Frame<'db>, embedding: &Embedding<'db>) -> Diagnostic {
        let mut names: Vec<String> = self.stack.iter().map(|open| open.name.to_string()).collect();
        names.push(frame.name.to_string());
        let name = match &embedding.outcome {
            Outcome::Found { child, .. } => self.name_of(*child),
            _ => "?".to_owned(),
        };
        Diagnostic::new(&messages::TOO_DEEP)
            .with("name", name)
            .with("limit", u64::from(DEEPEST))
            .with("chain", names.join(" > "))
            .in_path(frame.name.as_str())
    }

    fn name_of(&self, instance: Instance<'db>) -> String {
        let name = instance.name(self.db);
        let index = path_index(self.db, instance.file(self.db), name).as_ref();
        index.map_or_else(|| name.folded(self.db).to_owned(), |index| index.header.name.to_string())
    }

    /// Reports what is found in a path, each once; whether there are errors.
    fn report_all(&mut self, instance: Instance<'db>, found: &[Diagnostic]) -> bool {
        let has_errors = found.iter().any(Diagnostic::is_error);
        for mut diagnostic in found.iter().cloned() {
            diagnostic.file.get_or_insert_with(|| instance.file(self.db).path(self.db).clone());
            let same = self.known.entry(hash(&identity(&diagnostic))).or_default();
            if !same.iter().any(|index| identity(&self.diagnostics[*index]) == identity(&diagnostic)) {
                same.push(self.diagnostics.len());
                diagnostic.trace = self.trace();
                self.diagnostics.push(diagnostic);
            }
        }
        has_errors
    }

    fn trace(&self) -> Vec<TraceStep> {
        let step = |frame: &Frame<'db>| TraceStep {
            file: frame.instance.file(self.db).path(self.db).clone(),
            path: frame.name.as_str().into(),
            point: frame.point,
        };
        self.stack.iter().map(step).collect()
    }

    /// Whether there are more distinct paths than can be meant; said once.
    fn is_crowded(&mut self, instance: Instance<'db>) -> bool {
        let Limits { paths, .. } = self.limits;
        if self.reached.len() as u64 <= paths {
            return false;
        }
        if !std::mem::replace(&mut self.is_full, true) {
            let problem = Diagnostic::new(&files::TOO_MANY_PATHS).with("key", "embedded-paths");
            self.report_limit(instance, problem.with("limit", paths));
        }
        true
    }

    /// Counts the moves that the program comes to, before anybody makes them.
    fn count(&mut self, root: Instance<'db>) {
        if self.diagnostics.iter().any(Diagnostic::is_error) {
            return;
        }
        self.moves = self.moves_of(root, &mut FxHashMap::default());
        if let Some(problem) = too_much(self.moves, self.limits) {
            self.report_limit(root, problem);
        }
    }

    fn moves_of(&self, instance: Instance<'db>, known: &mut FxHashMap<Instance<'db>, u64>) -> u64 {
        if let Some(moves) = known.get(&instance) {
            return *moves;
        }
        let own = summary(self.db, instance).moves;
        let embedded = embeds(self.db, instance).iter().filter_map(|embedding| match &embedding.outcome {
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

/// PB005: a program of so many moves, which is too long, or would take too much memory while it is made.
fn too_much(count: u64, limits: Limits) -> Option<Diagnostic> {
    let size = memory(count);
    let problem = if count > limits.moves {
        Diagnostic::new(&files::TOO_MANY_MOVES).with("key", "embedding-moves").with("limit", limits.moves)
    } else if size > limits.memory {
        let problem = Diagnostic::new(&files::TOO_MUCH_MEMORY).with("key", "program-memory");
        problem.with("size", size).with("limit", limits.memory)
    } else {
        return None;
    };
    Some(problem.with("count", count))
}

/// What makes two diagnostics the same: everything but how they were come by.
fn identity(diagnostic: &Diagnostic) -> impl Hash + PartialEq + '_ {
    let Diagnostic { message, place, path, file, arguments, text, .. } = diagnostic;
    (message, place, path, file, arguments, text)
}

fn hash(value: &impl Hash) -> u64 {
    let mut hasher = DefaultHasher::new();
    value.hash(&mut hasher);
    hasher.finish()
}
