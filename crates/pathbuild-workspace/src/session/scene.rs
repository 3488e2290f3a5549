//! Scenes of paths for display, computed by the same queries as their programs.

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::{
    Database, Db, DrawnPath, Settings, SourceFile, Target, TracedProgram, assigned_texts, drawn_path,
    effective_parameters, keep_outs, path_names, placed_parts, program, remaining_layers, uncut_rings,
};
use pathbuild_diagnostic::{Code, Diagnostic, Number};
use pathbuild_gcode::native::{WriteOptions, write_program};
use pathbuild_gcode::provenance::Provenance;
use pathbuild_path::{ElementParameters, PathName, PathRole};
use pathbuild_toolpath::{Correction, PlannedMove, Program, ProgramStep};
use pathbuild_view::{
    self as view, DrawnSource, Example, FinishedPart, GcodeText, ProgramSource, Scene, ScenePath,
};

use super::work::with_file_and_path;
use super::{CheckedTarget, Session, WriteSettings};

/// A path with a hash of its moves, so that paths can be compared without drawing them.
#[derive(Debug)]
pub struct HashedPath {
    /// The drawing that defines the path.
    pub file: SourceFile,
    /// Path of that drawing, relative to the root of the tree.
    pub place: Utf8PathBuf,
    /// Name of the path.
    pub name: PathName,
    /// The target for which the hashed program was built.
    pub target: Target,
    /// Hash of the moves of the path's program; `None` if the path has errors, or if its program could not be built.
    pub moves: Option<Box<str>>,
    /// Diagnostics of exceeded limits and bugs that kept the program from being built.
    pub problems: Vec<Diagnostic>,
    /// Warnings that the configuration turns into errors, so that `emit` writes no program although its moves are known.
    pub raised: Vec<Diagnostic>,
}

impl Session<'_> {
    /// Returns scenes of the geometry in some drawings, without programs; `None` for a drawing that triggers a bug.
    pub fn drawn_scenes(&self, files: &[&Utf8Path]) -> Vec<Option<Scene>> {
        let files: Vec<SourceFile> = files.iter().map(|file| self.file(file)).collect();
        let scenes = self.map_guarded(&files, |db: &Database, file: &SourceFile| drawn_scene(db, *file));
        scenes.into_iter().map(Result::ok).collect()
    }

    /// Hashes the moves of each path in some drawings of the tree below `root`. The programs are those that [`scene`](Self::scene) shows.
    pub fn move_hashes(&self, files: &[SourceFile], root: &Utf8Path) -> Vec<HashedPath> {
        let names = files.iter().map(|file| (*file, path_names(&self.db, *file)));
        let paths: Vec<(SourceFile, PathName)> =
            names.flat_map(|(file, names)| names.iter().map(move |name| (file, name.clone()))).collect();
        let checked =
            self.map_with_checker(&paths, |checker, (file, name)| checker.check_leniently(*file, name));
        let hash =
            |db: &Database, checked: &CheckedTarget| program(db, checked.target).as_deref().map(move_hash);
        let hashes = self.map_guarded(&checked, hash);
        let hashed =
            |(((file, name), checked), hash): (((SourceFile, _), CheckedTarget), Result<_, Box<_>>)| {
                let target = checked.target;
                let raised = self.context.raised_to_errors(self.path_diagnostics(&checked));
                let mut problems: Vec<Diagnostic> =
                    checked.diagnostics.into_iter().filter(prevents_program).collect();
                let moves = hash.unwrap_or_else(|problem| {
                    let problem = with_file_and_path(&self.db, target, *problem);
                    // The check may have reported the same timeout already.
                    problems.extend((!problems.contains(&problem)).then_some(problem));
                    None
                });
                let drawing = file.path(&self.db);
                let place = self.place_below(root, drawing);
                HashedPath { file, place, name, target, moves, problems, raised }
            };
        paths.into_iter().zip(checked).zip(hashes).map(hashed).collect()
    }
}

/// Hashes everything in a program that can change what a machine does: its moves, its pecks, which only post-processors write, and the feeds of its
/// probes.
fn move_hash(program: &Program) -> Box<str> {
    let moves = Provenance::of_programs(&[program], &[], None).moves;
    let pecks: Vec<(u32, f64)> =
        program.pecks().into_iter().filter_map(|(step, peck)| Some((step, peck?))).collect();
    let feeds: Vec<f64> = program.probes.iter().map(|probe| probe.feed).collect();
    if pecks.is_empty() && feeds.is_empty() { moves } else { format!("{moves} {pecks:?} {feeds:?}").into() }
}

/// Whether a limit or a bug kept a program from being built, which does not mean that the drawing is wrong.
fn prevents_program(problem: &Diagnostic) -> bool {
    matches!(problem.code(), Code::LimitReached | Code::InternalError) && problem.is_error()
}

/// Returns values that were chosen only for display: those of variables, of the sweep height (S), and of options that are not set.
pub(crate) fn examples(
    db: &dyn Db,
    TracedProgram { program, paths, .. }: &TracedProgram,
    writing: &WriteSettings,
) -> Vec<Example> {
    let Some(root) = paths.first() else { return Vec::new() };
    let example = |name: String, value: Option<&str>| Example { name, value: value.map(str::to_owned) };
    let mut examples: Vec<Example> =
        root.bindings.iter().map(|(name, value)| example(name.to_string(), Some(value))).collect();
    if root.path.sweep_height(&Settings::get(db).fold(db), PathRole::Emitted) != Some(program.sweep_height) {
        let height = Number(program.sweep_height).to_string();
        examples.push(example("S".to_owned(), Some(&height)));
    }
    let has_no_feed = |step: &ProgramStep| {
        let ProgramStep::Move { to, .. } = step else { return false };
        matches!(to, PlannedMove::Drill { feed, .. } | PlannedMove::Line { feed, .. } | PlannedMove::Arc { feed, .. } if *feed <= 0.0)
    };
    if program.steps.iter().any(has_no_feed) {
        examples.push(example("feed".to_owned(), None));
    }
    if writing.options.rapid <= 0.0 {
        examples.push(example("rapid".to_owned(), None));
    }
    examples
}

fn drawn_scene(db: &dyn Db, file: SourceFile) -> Scene {
    let mut scene = Scene::new(file.path(db).file_name().unwrap_or_default());
    scene.keep_outs.extend(keep_outs(db, file).iter().map(|clamp| view::keep_out(clamp, [0.0, 0.0])));
    let paths = path_names(db, file).iter().filter_map(|name| drawn_path(db, file, name));
    scene.paths.extend(paths.map(|drawn| view::drawn_path(&drawn_source(db, file, drawn, &[]))));
    scene.other_layers = view::other_layers(remaining_layers(db, file));
    scene.uncut = uncut_rings(db, file).into_iter().map(view::outline).collect();
    scene
}

/// The details of a program that pages show and pictures do not.
pub(crate) struct ProgramDetails<'a> {
    /// Whether to add the native text.
    pub(crate) has_native: bool,
    /// The text as written by `emit`, if it is to be added.
    pub(crate) emitted: Option<GcodeText<'a>>,
}

/// Returns the scene of a program, with the elements from which its moves come; `None` if a drawing changed in the meantime. `details` selects the
/// texts to add; with it, the parameters of the elements are added too, which take more memory than the moves.
///
/// # Errors
/// PB005 if its text is too large.
pub(crate) fn program_scene(
    db: &dyn Db,
    traced: &TracedProgram,
    writing: &WriteSettings,
    details: Option<ProgramDetails<'_>>,
) -> Result<Option<ScenePath>, Box<Diagnostic>> {
    let TracedProgram { program, trace, paths } = traced;
    // The first path is the emitted path itself.
    let known = paths.iter().zip(0..).map(|(bound, number)| {
        let is_shown = details.is_some();
        is_shown.then(|| effective_parameters(db, bound.file, &bound.path.name, &bound.bindings, number == 0))
    });
    let known: Vec<Vec<ElementParameters>> = known.map(Option::unwrap_or_default).collect();
    let sources = paths.iter().zip(&known).map(|(bound, known)| {
        let drawn = drawn_path(db, bound.file, &bound.path.name)?;
        Some((drawn_source(db, bound.file, drawn, known), &*bound.path))
    });
    let Some(sources) = sources.collect::<Option<Vec<_>>>() else { return Ok(None) };
    // Do not split moves for height correction: each line of the text must correspond to one move.
    let correction = Correction { longest: 0.0, ..writing.options.correction };
    let options = WriteOptions { correction, ..writing.options };
    let native = details
        .as_ref()
        .is_some_and(|details| details.has_native)
        .then(|| write_program(program, "", &options, writing.most_bytes));
    let native = native.transpose()?;
    let rapid = (options.rapid > 0.0).then_some(options.rapid);
    Ok(Some(view::program_path(&ProgramSource {
        program,
        trace,
        parts: &sources,
        native: native.as_deref(),
        emitted: details.and_then(|details| details.emitted),
        rapid,
    })))
}

pub(crate) fn drawn_source<'db>(
    db: &'db dyn Db,
    file: SourceFile,
    drawn: DrawnPath<'db>,
    in_force: &'db [ElementParameters],
) -> DrawnSource<'db> {
    let DrawnPath { raw, positions } = drawn;
    DrawnSource {
        file: file.path(db).as_str(),
        raw,
        positions,
        texts: assigned_texts(db, file),
        parameters: in_force,
    }
}

pub(crate) fn finished_parts(db: &Database, target: Target) -> Vec<FinishedPart> {
    placed_parts(db, target).iter().map(view::finished_part).collect()
}
