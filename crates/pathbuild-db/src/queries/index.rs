//! A compact index of a drawing: the names of its paths, and the data of each path that other paths and a check need.

use std::cell::{Cell, RefCell};
use std::panic::resume_unwind;
use std::sync::Arc;

use pathbuild_diagnostic::messages::drawing as messages;
use pathbuild_diagnostic::{Code, Diagnostic, Note, Point, Severity};
use pathbuild_dxf::Drawing;
use pathbuild_files::Stamp;
use pathbuild_path::{
    Bindings, DrawnParts, Item, KeepOut, KeepOuts, Language, NearNames, Part, PartiallyBoundPath, Path,
    PathCuts, PathHeader, PathName, PathRole, PathSignature, RawFile, RawPath, WalkedPath, Xy,
    check_file_name, has_text_on_part, is_near_clamps_or_parts, stray_findings,
};
use pathbuild_toolpath::{own_moves, part_cuts};
use smol_str::SmolStr;

use crate::database::{Db, TimeoutPanic, catch_bugs};
use crate::inputs::{Reading, Settings, SourceFile};
use crate::queries::nearby_ends::LayerHints;
use crate::queries::reading::{Fingerprint, entities, read, read_entities};

/// The index of a drawing. It contains no positions: an edit that only shifts lines and handles leaves it equal, so invalidation ends here.
#[derive(Clone, Debug, Default)]
pub struct FileIndex {
    /// Names in order of first appearance.
    names: Vec<PathName>,
    /// Paths sorted by name for binary search, because a drawing may have as many paths as layers.
    paths: Vec<Arc<PathIndex>>,
    diagnostics: Vec<Diagnostic>,
    /// The clamps; `None` if the drawing has no layer for clamps.
    keep_outs: Option<Arc<KeepOuts>>,
    /// Whether any layer holds finished parts.
    has_part_layer: bool,
    /// The parts and cuts. `None` if the settings name no layers with parts, or if the drawing neither has parts nor embeds paths that may have some.
    pub(super) parts: Option<Arc<FileParts>>,
    content: Content,
}

/// Fingerprint of the bytes that an index was built from. Ignored in comparisons, since other bytes may give the same index.
#[derive(Clone, Debug, Default)]
struct Content {
    fingerprint: Option<Fingerprint>,
    /// The hash and the stamp of the bytes, if the settings ask for hashes.
    hash: Option<([u8; 32], Stamp)>,
}

/// The data of a path in the index of its drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct PathIndex {
    /// The properties of the path that do not depend on the values of its variables.
    pub header: PathHeader,
    /// Example values for the path's variables.
    pub examples: Bindings,
    /// The path's summary for the example values.
    pub summary: PathSummary,
}

/// A path's name folded for comparison, as a key.
#[salsa::interned(debug)]
pub struct NameKey<'db> {
    /// The name in upper case.
    #[returns(deref)]
    pub folded: Box<str>,
}

/// Reads a drawing, keeps its index and drops the rest.
#[salsa::tracked]
pub fn file_index(db: &dyn Db, file: SourceFile) -> FileIndex {
    let settings = Settings::get(db);
    let (reading, language) = (settings.reading(db), settings.language(db));
    let index = read(db, file, |bytes, stamp, drawing| {
        let has_keep_outs = Cell::new(false);
        let has_parts = Cell::new(false);
        let is_near = Cell::new(false);
        let others = RefCell::new(Vec::new());
        let is_wanted = |layer: &str| {
            let is_keep_out = language.is_keep_out(layer);
            if is_keep_out {
                has_keep_outs.set(true);
            }
            let is_path = language.path_pattern.is_layer(layer);
            let is_part = !is_path && language.is_part(layer);
            if !is_path && !is_part && !is_keep_out && is_near_clamps_or_parts(layer, language) {
                is_near.set(true);
            }
            if is_part {
                has_parts.set(true);
            } else if !is_path && language.path_pattern.may_resemble(layer) {
                others.borrow_mut().push(SmolStr::new(layer));
            }
            is_path || is_part
        };
        let read = catch_bugs(|| {
            read_entities(bytes, drawing, reading, &is_wanted);
            let mut raw = pathbuild_path::raw_file(drawing, language);
            let is_noted = drawing.has_noted_text || has_text_on_part(drawing, language);
            if is_noted || is_near.get() || has_near_layer(&raw, &others.borrow()) {
                let all = entities(bytes, reading, &|_| true);
                raw.diagnostics.extend(stray_findings(&all, language));
            }
            let drawn_parts = has_parts.get().then(|| drawn_parts(bytes, drawing, reading, language));
            (raw, drawn_parts, has_keep_outs.get().then(|| read_keep_outs(bytes, reading, language)))
        });
        let content = Content::of(bytes, stamp, reading);
        match read {
            Ok((raw, drawn_parts, keep_outs)) => {
                let read_all = || entities(bytes, reading, &|_| true);
                let hints = LayerHints::new(&read_all);
                let index = FileIndex::new(db, raw, drawn_parts, &hints, content);
                index.with_file_name_findings(db, file, &hints).with_keep_outs(keep_outs)
            }
            Err(bug) => FileIndex::unreadable(*bug, content),
        }
    });
    let mut index = index.unwrap_or_else(|problem| FileIndex::unreadable(*problem, Content::default()));
    for diagnostic in &mut index.diagnostics {
        diagnostic.file = Some(file.path(db).clone());
    }
    index
}

/// Whether any of these layers, which belong to no path, has a name similar to that of a path.
fn has_near_layer(raw: &RawFile, others: &[SmolStr]) -> bool {
    if others.is_empty() {
        return false;
    }
    let names = NearNames::new(raw.paths.iter().map(|(raw, _)| &*raw.name));
    others.iter().any(|layer| names.path(layer).is_some())
}

/// Reads clamps. Unsupported curves among them are reported even in compatible mode, where paths skip them.
fn read_keep_outs(bytes: &[u8], reading: &Reading, language: &Language) -> KeepOuts {
    let reading = Reading { compatible: false, ..reading.clone() };
    pathbuild_path::keep_outs(&entities(bytes, &reading, &|layer| language.is_keep_out(layer)), language)
}

/// Reads parts. In compatible mode, entities that paths skip may still be part of an outline, so they are read.
fn drawn_parts(bytes: &[u8], drawing: &Drawing, reading: &Reading, language: &Language) -> DrawnParts {
    if !reading.compatible {
        return pathbuild_path::parts(drawing, language);
    }
    let reading = Reading { compatible: false, ..reading.clone() };
    pathbuild_path::parts(&entities(bytes, &reading, &|layer| language.is_part(layer)), language)
}

/// Returns the data of one path from the index of its drawing, unaffected by edits of other paths.
#[salsa::tracked]
pub fn path_index<'db>(db: &'db dyn Db, file: SourceFile, name: NameKey<'db>) -> Option<Arc<PathIndex>> {
    file_index(db, file).path(&name.name(db)).cloned()
}

/// Returns the names of a drawing's paths, in order of first appearance.
pub fn path_names(db: &dyn Db, file: SourceFile) -> &[PathName] {
    &file_index(db, file).names
}

/// Returns the hash of the bytes from which a drawing was indexed. `None` if it could not be read or the settings ask for no hashes.
pub fn content_hash(db: &dyn Db, file: SourceFile) -> Option<[u8; 32]> {
    content(db, file).map(|(hash, _)| hash)
}

/// Returns the hash of the indexed bytes, with their stamp.
pub fn content(db: &dyn Db, file: SourceFile) -> Option<([u8; 32], Stamp)> {
    file_index(db, file).content.hash
}

/// Returns the clamps of a drawing.
pub fn keep_outs(db: &dyn Db, file: SourceFile) -> &[KeepOut] {
    keep_outs_of_file(db, file).map_or(&[], |found| &found.all)
}

/// Returns the findings about the clamps of a drawing. If one of them is an error, no path of the drawing becomes a program.
pub(super) fn keep_out_problems(db: &dyn Db, file: SourceFile) -> &[Diagnostic] {
    keep_outs_of_file(db, file).map_or(&[], |found| &found.problems)
}

/// Whether a drawing has a layer with clamps.
pub fn has_clamp_layer(db: &dyn Db, file: SourceFile) -> bool {
    file_index(db, file).keep_outs.is_some()
}

/// Whether a drawing has a layer with finished parts.
pub fn has_part_layer(db: &dyn Db, file: SourceFile) -> bool {
    file_index(db, file).has_part_layer
}

fn keep_outs_of_file(db: &dyn Db, file: SourceFile) -> Option<&KeepOuts> {
    // Most libraries have no clamps; no query is needed then.
    Settings::get(db).language(db).keep_out.as_ref()?;
    indexed_keep_outs(db, file).as_deref()
}

/// Returns the clamps in a drawing's index, unaffected by edits of its paths.
#[salsa::tracked]
fn indexed_keep_outs(db: &dyn Db, file: SourceFile) -> Option<Arc<KeepOuts>> {
    file_index(db, file).keep_outs.clone()
}

impl FileIndex {
    fn new(
        db: &dyn Db,
        raw: RawFile,
        parts: Option<DrawnParts>,
        hints: &LayerHints<'_>,
        content: Content,
    ) -> Self {
        let names: Vec<PathName> = raw.paths.iter().map(|(raw, _)| (*raw.name).clone()).collect();
        let is_checked = Settings::get(db).language(db).part.is_some();
        let has_part_layer = parts.is_some();
        let has_parts = parts.as_ref().is_some_and(|drawn| !drawn.parts.is_empty());
        // In a drawing without parts, only paths that embed others need their cuts here. A project queries those of embedded paths when needed.
        let is_needed = |walked: &WalkedPath| {
            has_parts || walked.items.iter().any(|item| matches!(item, Item::Subpath(_)))
        };
        let mut cuts = Vec::new();
        let mut add_cuts = |path: &Path, walked: &WalkedPath| {
            if is_checked && is_needed(walked) {
                cuts.extend(cuts_of(db, path, walked));
            }
        };
        let path = |(raw, _): (RawPath, _)| PathIndex::new(db, &raw, hints, &mut add_cuts);
        // Push the paths one by one: `collect` would keep the raw paths' allocation.
        let mut paths: Vec<PathIndex> = Vec::with_capacity(raw.paths.len());
        paths.extend(raw.paths.into_iter().map(path));
        paths.sort_unstable_by(|a, b| a.header.name.cmp(&b.header.name));
        let mut diagnostics = raw.diagnostics;
        let is_complete = cuts.len() == paths.len();
        let mut parts = parts.unwrap_or_default();
        parts.judge_outlines(&cuts, is_complete);
        let DrawnParts { parts, mut problems, .. } = parts;
        lower_to_warnings(db, &mut problems);
        diagnostics.append(&mut problems);
        cuts.sort_unstable_by(|one, other| one.name.cmp(&other.name));
        let parts = (has_parts || !cuts.is_empty()).then(|| Arc::new(FileParts { parts, cuts, is_complete }));
        // `collect` would reuse the allocation of `paths`, which is fifty times as large as needed.
        let mut shared = Vec::with_capacity(paths.len());
        shared.extend(paths.into_iter().map(Arc::new));
        let paths = shared;
        Self { names, paths, diagnostics, keep_outs: None, has_part_layer, parts, content }
    }

    /// Adds findings about the file's name, unless errors leave the drawing's paths unknown.
    fn with_file_name_findings(mut self, db: &dyn Db, file: SourceFile, hints: &LayerHints<'_>) -> Self {
        if !self.diagnostics.iter().any(Diagnostic::is_error) {
            let settings = Settings::get(db);
            let stem = file.path(db).file_stem().unwrap_or_default();
            let (files, paths) = (settings.file_pattern(db), &settings.language(db).path_pattern);
            let found = check_file_name(stem, &self.names, files, paths);
            self.diagnostics.extend(found.into_iter().map(|found| hints.with_near_layer(found)));
        }
        self
    }

    /// Adds the clamps, and the findings about them to the drawing's diagnostics.
    fn with_keep_outs(mut self, keep_outs: Option<KeepOuts>) -> Self {
        self.diagnostics.extend(keep_outs.iter().flat_map(|found| found.problems.iter().cloned()));
        self.keep_outs = keep_outs.map(Arc::new);
        self
    }

    fn unreadable(problem: Diagnostic, content: Content) -> Self {
        Self { diagnostics: vec![problem], content, ..Self::default() }
    }

    /// Returns the names of the drawing's paths, in order of first appearance.
    pub fn names(&self) -> &[PathName] {
        &self.names
    }

    /// Returns the data of one of the drawing's paths; `None` if the drawing has no path of that name.
    pub fn path(&self, name: &PathName) -> Option<&Arc<PathIndex>> {
        let place = self.paths.binary_search_by(|path| path.header.name.cmp(name)).ok()?;
        Some(&self.paths[place])
    }

    /// Returns the data of the drawing's paths, in order of name.
    pub fn paths(&self) -> impl Iterator<Item = &PathIndex> {
        self.paths.iter().map(|path| &**path)
    }

    /// Findings about the drawing as a whole.
    pub fn diagnostics(&self) -> &[Diagnostic] {
        &self.diagnostics
    }

    /// Returns the fingerprint of the bytes that the index was built from, if they could be read.
    pub(super) fn fingerprint(&self) -> Option<Fingerprint> {
        self.content.fingerprint
    }
}

impl PartialEq for FileIndex {
    fn eq(&self, other: &Self) -> bool {
        let Self { names, paths, diagnostics, keep_outs, has_part_layer, parts, content: _ } = self;
        *names == other.names
            && *paths == other.paths
            && *diagnostics == other.diagnostics
            && *keep_outs == other.keep_outs
            && *has_part_layer == other.has_part_layer
            && *parts == other.parts
    }
}

impl Content {
    fn of(bytes: &[u8], stamp: Stamp, reading: &Reading) -> Self {
        let hash = || (*blake3::hash(bytes).as_bytes(), stamp);
        Self { fingerprint: Some(Fingerprint::of(bytes)), hash: reading.is_hashed.then(hash) }
    }
}

impl PathIndex {
    /// Builds the index of a path. Passes the path to `use_path` if its cuts are known.
    fn new(
        db: &dyn Db,
        raw: &RawPath,
        hints: &LayerHints<'_>,
        use_path: &mut dyn FnMut(&Path, &WalkedPath),
    ) -> Self {
        let header = PathHeader::of(raw);
        let examples = Bindings::check_values(&header.definitions);
        let summary = PathSummary::new(db, raw, &examples, hints, use_path);
        Self { header, examples, summary }
    }
}

impl<'db> NameKey<'db> {
    /// Returns the key of a name, which is equal for names that differ only in case.
    pub fn of(db: &'db dyn Db, name: &PathName) -> Self {
        Self::new(db, name.canonical().into_boxed_str())
    }

    /// Returns the name in upper case.
    pub(super) fn name(self, db: &dyn Db) -> PathName {
        PathName::new(self.folded(db))
    }
}

/// The summary of a path with bound variables.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PathSummary {
    /// Findings about the path's drawing or the values of its variables.
    pub problems: Vec<Diagnostic>,
    /// The properties on which paths that embed this one depend; `None` if the drawing of the path or the values have errors.
    pub signature: Option<PathSignature>,
    /// The known part of the signature of a path with errors, used to judge what it embeds. `None` for a path without errors, and
    /// if nothing is drawn.
    pub faulty_signature: Option<Box<PathSignature>>,
    /// Findings about the sweep height that the path gets when embedded or checked. Empty if the path has errors.
    pub sweep_problems: Vec<Diagnostic>,
    /// Findings about the walk.
    pub walk_problems: Vec<Diagnostic>,
    /// Estimated number of moves, without embedded paths.
    pub moves: u64,
}

impl PathSummary {
    /// Binds and walks a path. Passes it to `use_path` if its cuts are known.
    pub(super) fn new(
        db: &dyn Db,
        raw: &RawPath,
        bindings: &Bindings,
        hints: &LayerHints<'_>,
        use_path: &mut dyn FnMut(&Path, &WalkedPath),
    ) -> Self {
        let language = Settings::get(db).language(db);
        let with_hint = |found: Diagnostic| hints.with_hint(&raw.name, language, found);
        let BindResult { path, diagnostics } = bind_leniently(raw, bindings, language);
        let mut problems: Vec<Diagnostic> = diagnostics.into_iter().map(with_hint).collect();
        let Some(path) = path else { return Self { problems, ..Self::default() } };
        let walked = walk(db, &path, language);
        if let Some(end) = walked.open_end {
            add_path_end(&mut problems, end);
        }
        let signature = PathSignature::of(&path);
        let moves = if path.has_faults() { 0 } else { own_moves(&path, &walked) };
        if path.are_cuts_known() && !walked.diagnostics.iter().any(Diagnostic::is_error) {
            use_path(&path, &walked);
        }
        let walk_problems = walked.diagnostics.into_iter().map(with_hint).collect();
        if path.has_faults() {
            let faulty_signature = Some(Box::new(signature));
            return Self { problems, faulty_signature, walk_problems, ..Self::default() };
        }
        Self {
            problems,
            sweep_problems: signature.low_sweep_problems(path.embedded_sweep_height(), PathRole::Embedded),
            walk_problems,
            moves,
            signature: Some(signature),
            faulty_signature: None,
        }
    }

    /// Returns the signature as far as it is known, with or without errors.
    pub(super) fn known_signature(&self) -> Option<&PathSignature> {
        self.signature.as_ref().or(self.faulty_signature.as_deref())
    }

    /// Whether the path itself has no findings.
    pub(super) fn is_clean(&self) -> bool {
        let Self { problems, sweep_problems, walk_problems, .. } = self;
        self.signature.is_some()
            && problems.is_empty()
            && sweep_problems.is_empty()
            && walk_problems.is_empty()
    }

    pub(super) fn has_subpaths(&self) -> bool {
        self.known_signature().is_some_and(|signature| !signature.subpaths.is_empty())
    }
}

/// Adds the point at which the path ends to PB102.
fn add_path_end(problems: &mut [Diagnostic], end: Xy) {
    for problem in problems.iter_mut().filter(|problem| problem.code() == Code::MissingEnd) {
        let note = Note {
            message: &messages::ENDS_HERE,
            arguments: vec![("point", Point::new(end.x, end.y).into())],
        };
        problem.notes.push(note);
    }
}

/// A bound path and its diagnostics.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BindResult {
    /// The path as far as it is known. A program gets it only if no diagnostic is an error.
    pub path: Option<Arc<Path>>,
    /// Diagnostics of the drawing and of the values.
    pub diagnostics: Vec<Diagnostic>,
}

/// Binds and checks the parameters of a path for its program.
pub(super) fn bind(raw: &RawPath, bindings: &Bindings, language: &Language) -> BindResult {
    let BindResult { path, diagnostics } = bind_leniently(raw, bindings, language);
    BindResult { path: path.filter(|path| !path.has_faults()), diagnostics }
}

/// Binds a path as far as it is known, even if it has errors, so that its other errors are found as well.
fn bind_leniently(raw: &RawPath, bindings: &Bindings, language: &Language) -> BindResult {
    let examined = catch_bugs(|| pathbuild_path::bind_leniently(raw, bindings, language));
    let PartiallyBoundPath { path, problems } = examined.unwrap_or_else(|bug| PartiallyBoundPath {
        path: None,
        problems: vec![bug.in_path(raw.name.as_str())],
    });
    let mut diagnostics = raw.findings_except(&problems);
    diagnostics.extend(problems);
    BindResult { path: path.map(Arc::new), diagnostics }
}

/// Walks a path. PB005 if that takes too long: indexes are built before the time limit of a target applies.
pub(super) fn walk(db: &dyn Db, path: &Path, language: &Language) -> WalkedPath {
    catch_bugs(|| walk_within_limit(db, path, language)).unwrap_or_else(|problem| {
        // The machine may be less busy next time, so the result is not memoized beyond this revision.
        db.report_untracked_read();
        WalkedPath::from_failure(problem.in_path(path.name.as_str()))
    })
}

/// Walks a path. Unwinds at the time limit: [`walk`] turns that into a finding, and elsewhere it ends the work on the target.
pub(super) fn walk_within_limit(db: &dyn Db, path: &Path, language: &Language) -> WalkedPath {
    let limit = Settings::get(db).reading(db).walk_time;
    let begun = db.system().now();
    let checkpoint = || {
        db.unwind_if_revision_cancelled();
        if begun.is_some_and(|begun| begun.elapsed() > limit) {
            resume_unwind(Box::new(TimeoutPanic(limit)));
        }
    };
    pathbuild_path::walk_with_checkpoints(path, language.join_tolerance, &checkpoint)
}

/// The data of a drawing that the part check needs. Lines and handles are left out, so that edits elsewhere in the drawing leave it equal.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct FileParts {
    pub(super) parts: Vec<Part>,
    /// The known cuts of the paths with example values, in order of name. If the drawing has no parts, only the cuts of paths that embed
    /// others.
    pub(super) cuts: Vec<PathCuts>,
    /// Whether the cuts of all the drawing's paths are known.
    pub(super) is_complete: bool,
}

impl FileParts {
    /// Returns the index of a path in [`FileParts::cuts`].
    pub(super) fn index_of_path(&self, name: &PathName) -> Option<usize> {
        self.cuts.binary_search_by(|cuts| (*cuts.name).cmp(name)).ok()
    }
}

/// Returns the cuts of a sound path; `None` after a panic, which is not reported here.
pub(super) fn cuts_of(db: &dyn Db, path: &Path, walked: &WalkedPath) -> Option<PathCuts> {
    let settings = Settings::get(db);
    let is_compatible = settings.reading(db).compatible;
    let tool = settings.language(db).tools.of(path.name.as_str(), path.tool);
    catch_bugs(|| part_cuts(path, walked, tool.as_ref(), is_compatible)).ok()
}

/// Turns errors about parts into warnings in compatible mode.
pub(super) fn lower_to_warnings<'p>(db: &dyn Db, problems: impl IntoIterator<Item = &'p mut Diagnostic>) {
    if Settings::get(db).reading(db).compatible {
        for problem in problems {
            problem.severity = Severity::Warning;
        }
    }
}
