//! Scenes of paths for display, computed by the same queries as their programs.

use std::slice;

use camino::Utf8Path;
use pathbuild_db::{
    Db, DrawnPath, Role, Settings, SourceFile, Target, TracedProgram, assigned_texts, check_file, drawn_path,
    file_index, in_force, keep_outs, other_layers, path_names, placed_keep_outs, program, traced_program,
};
use pathbuild_diagnostic::{Code, Diagnostic, Lang, Number};
use pathbuild_gcode::native::{Header, WriteOptions};
use pathbuild_gcode::provenance::Provenance;
use pathbuild_path::{ElementParameters, KeepOut, PathName, PathRole};
use pathbuild_toolpath::{Correction, Move, Step};
use pathbuild_view::{
    self as view, BilingualText, DrawnSource, EmittedText, Example, ProgramSource, Scene, ScenePath,
};

use super::work::about;
use super::{CheckedTarget, Session, WriteSettings};
use crate::config::Origin;
use crate::emit::{program_text, writing};
use crate::findings::Findings;
use crate::posting::PostProcessor;
use crate::workspace::Workspace;

/// A scene, with the diagnostics of its paths.
#[derive(Debug)]
pub struct SceneReport {
    /// The scene. Its findings are empty until severities are applied.
    pub scene: Scene,
    /// Diagnostics with their locations.
    pub diagnostics: Vec<Diagnostic>,
}

/// Which program text is shown beside the moves.
#[derive(Clone, Copy, Debug)]
pub enum ShownText<'a> {
    /// The native program.
    Native,
    /// What `emit` writes, natively or through a post-processor. Falls back to the native program if `emit` writes nothing.
    Emitted(Option<&'a PostProcessor>),
}

/// A hash of a path's moves, to compare paths without drawing them.
#[derive(Debug)]
pub struct HashedPath {
    /// The drawing that defines the path.
    pub file: SourceFile,
    /// Name of the path.
    pub name: PathName,
    /// Hash of its program's moves; `None` if the path has errors, or if its program could not be built.
    pub moves: Option<Box<str>>,
    /// Limits and bugs that kept the program from being built.
    pub problems: Vec<Diagnostic>,
}

impl SceneReport {
    /// Completes the scene with its findings, according to the configured severities. `file` is the drawing that is shown.
    pub fn with_findings(self, workspace: &Workspace, file: &str) -> (Scene, Findings) {
        let (mut scene, findings) = (self.scene, workspace.findings(self.diagnostics));
        scene.findings = view::findings(&findings.diagnostics, file);
        (scene, findings)
    }
}

impl Session<'_> {
    /// The scene of some paths of a drawing, with their texts. If options are missing, or if a path has variables, its program is that of a
    /// check: with example values, and with S as if it were embedded.
    pub fn scene(&self, file: SourceFile, names: &[PathName], text: ShownText<'_>) -> SceneReport {
        let name = file.path(&self.db).as_str();
        let title = match names {
            [path] => path.as_str(),
            _ => file.path(&self.db).file_name().unwrap_or(name),
        };
        let mut scene = Scene::new(title);
        let mut diagnostics = check_file(&self.db, file).to_vec();
        scene
            .keep_outs
            .extend(keep_outs(&self.db, file).iter().map(|clamp| view::keep_out(clamp, [0.0, 0.0])));
        for path in names {
            let (seen, found, clamps) = self.scene_path(file, path, text);
            let zero = seen.as_ref().map_or([0.0, 0.0], |seen| seen.zero);
            scene.keep_outs.extend(clamps.iter().map(|clamp| view::keep_out(clamp, zero)));
            scene.paths.extend(seen);
            diagnostics.extend(found);
        }
        scene.other_layers = view::other_layers(other_layers(&self.db, file));
        self.add_origins(&mut scene);
        SceneReport { scene, diagnostics }
    }

    /// Says of each parameter that an option gives where in pathbuild.toml that stands.
    fn add_origins(&self, scene: &mut Scene) {
        let elements = scene.paths.iter_mut().flat_map(|path| &mut path.elements);
        for parameter in elements.flat_map(|element| &mut element.parameters) {
            let option = parameter.which.as_deref().filter(|_| parameter.from == "option");
            let origin = option.map(|option| self.context.settings.origin_of_option(option));
            parameter.line = match origin {
                Some(Origin::File(line)) => Some(line),
                Some(Origin::Default | Origin::CommandLine(_)) | None => None,
            };
        }
    }

    /// Scenes of the geometry in some drawings, without programs; `None` for a drawing that triggers a bug.
    pub fn drawn_scenes(&self, files: &[&Utf8Path]) -> Vec<Option<Scene>> {
        let files: Vec<SourceFile> = files.iter().map(|file| self.file(file)).collect();
        let scenes =
            self.map_guarded(&files, |db: &pathbuild_db::Database, file: &SourceFile| drawn_scene(db, *file));
        scenes.into_iter().map(Result::ok).collect()
    }

    /// The scene of a path, its diagnostics, and the clamps that it embeds, at their places in the program.
    fn scene_path(
        &self,
        file: SourceFile,
        name: &PathName,
        text: ShownText<'_>,
    ) -> (Option<ScenePath>, Vec<Diagnostic>, Vec<KeepOut>) {
        let checked = self
            .map_with_checker(slice::from_ref(name), |checker, name| checker.check_leniently(file, name))
            .pop();
        let Some(checked) = checked else { return (None, Vec::new(), Vec::new()) };
        let writing = &writing(self.context);
        // Without a rapid feed, or for a path that is only checked, `emit` writes nothing: the text is a preview.
        let is_written = *checked.target.role(&self.db) == Role::Emitted
            && self.context.settings.general.rapid.value.is_some();
        let (emitted, refusal) = match text {
            ShownText::Native => (None, None),
            ShownText::Emitted(post_processor) => match program_text(self, post_processor, &checked) {
                Ok(emitted) => (emitted, None),
                Err(problems) => {
                    (None, problems.iter().find(|problem| problem.is_error() && is_written).map(bilingual))
                }
            },
        };
        let shown = emitted.as_ref().map(|emitted| EmittedText {
            file: is_written.then_some(emitted.file.as_str()),
            bytes: &emitted.bytes,
            dialect: emitted.dialect,
            is_posted: matches!(text, ShownText::Emitted(Some(_))),
        });
        let work = |db: &pathbuild_db::Database, target: &Target| -> Result<_, Box<Diagnostic>> {
            let Some(traced) = traced_program(db, *target) else { return Ok(None) };
            let mut scene = program_scene(db, traced, writing, shown)?;
            if let Some(scene) = &mut scene {
                scene.examples = examples(db, traced, writing);
                scene.refusal.clone_from(&refusal);
            }
            let embedded = placed_keep_outs(db, *target).into_iter().filter(|clamp| clamp.occurrence > 0);
            Ok(scene.map(|scene| (scene, embedded.map(|clamp| clamp.placed).collect::<Vec<KeepOut>>())))
        };
        let mut diagnostics = checked.diagnostics;
        let at = |problem: Diagnostic| problem.in_file(file.path(&self.db)).in_path(name.as_str());
        let result = self.map_guarded(slice::from_ref(&checked.target), work).pop();
        match result {
            Some(Ok(Ok(Some((scene, clamps))))) => return (Some(scene), diagnostics, clamps),
            Some(Err(problem) | Ok(Err(problem))) => diagnostics.push(at(*problem)),
            Some(Ok(Ok(None))) | None => {}
        }
        let drawn = drawn_path(&self.db, file, name);
        let examples = file_index(&self.db, file).path(name).map(|path| path.examples.clone());
        let parameters = in_force(&self.db, file, name, &examples.unwrap_or_default(), true);
        let drawn = drawn.map(|drawn| view::drawn_path(&drawn_source(&self.db, file, drawn, &parameters)));
        (drawn, diagnostics, Vec::new())
    }

    /// Hashes the moves of each path in some drawings. The programs are those that [`scene`](Self::scene) shows.
    pub fn move_hashes(&self, files: &[SourceFile]) -> Vec<HashedPath> {
        let names = files.iter().map(|file| (*file, path_names(&self.db, *file)));
        let paths: Vec<(SourceFile, PathName)> =
            names.flat_map(|(file, names)| names.iter().map(move |name| (file, name.clone()))).collect();
        let checked =
            self.map_with_checker(&paths, |checker, (file, name)| checker.check_leniently(*file, name));
        let hash = |db: &pathbuild_db::Database, checked: &CheckedTarget| {
            program(db, checked.target)
                .as_deref()
                .map(|program| Provenance::of_programs(&[program], &[], None).moves)
        };
        let hashes = self.map_guarded(&checked, hash);
        let hashed = |(((file, name), checked), hash): ((_, CheckedTarget), Result<_, Box<Diagnostic>>)| {
            let mut problems: Vec<Diagnostic> =
                checked.diagnostics.into_iter().filter(stops_making).collect();
            let moves = hash.unwrap_or_else(|problem| {
                let problem = about(&self.db, checked.target, *problem);
                // A timeout of the check has caused the same diagnostic.
                problems.extend((!problems.contains(&problem)).then_some(problem));
                None
            });
            HashedPath { file, name, moves, problems }
        };
        paths.into_iter().zip(checked).zip(hashes).map(hashed).collect()
    }
}

/// Whether a limit or a bug kept a program from being built. This says nothing about the drawing, which may be correct.
fn stops_making(problem: &Diagnostic) -> bool {
    matches!(problem.code(), Code::LimitReached | Code::InternalError) && problem.is_error()
}

/// The message of a diagnostic in both languages.
fn bilingual(problem: &Diagnostic) -> BilingualText {
    BilingualText { en: problem.text(Lang::En), de: problem.text(Lang::De) }
}

/// Values that were chosen only for display: of variables, of S, and of options that are not set.
fn examples(
    db: &dyn Db,
    TracedProgram { program, parts, .. }: &TracedProgram,
    writing: &WriteSettings,
) -> Vec<Example> {
    let Some(root) = parts.first() else { return Vec::new() };
    let example = |name: String, value: Option<&str>| Example { name, value: value.map(str::to_owned) };
    let mut examples: Vec<Example> =
        root.bindings.iter().map(|(name, value)| example(name.to_string(), Some(value))).collect();
    if root.path.sweep_height(&Settings::get(db).fold(db), PathRole::Emitted).is_none() {
        let height = Number(program.sweep_height).to_string();
        examples.push(example("S".to_owned(), Some(&height)));
    }
    let has_no_feed = |step: &Step| {
        let Step::Move { to, .. } = step else { return false };
        matches!(to, Move::Drill { feed, .. } | Move::Line { feed, .. } | Move::Arc { feed, .. } if *feed <= 0.0)
    };
    if program.steps.iter().any(has_no_feed) {
        examples.push(example("feed".to_owned(), None));
    }
    if writing.options.rapid <= 0.0 {
        examples.push(example("rapid".to_owned(), None));
    }
    examples
}

/// The scene of a drawing's geometry.
fn drawn_scene(db: &dyn Db, file: SourceFile) -> Scene {
    let mut scene = Scene::new(file.path(db).file_name().unwrap_or_default());
    scene.keep_outs.extend(keep_outs(db, file).iter().map(|clamp| view::keep_out(clamp, [0.0, 0.0])));
    let paths = path_names(db, file).iter().filter_map(|name| drawn_path(db, file, name));
    scene.paths.extend(paths.map(|drawn| view::drawn_path(&drawn_source(db, file, drawn, &[]))));
    scene.other_layers = view::other_layers(other_layers(db, file));
    scene
}

/// The scene of a program with the origin of its moves; `None` if a drawing changed in the meantime.
///
/// # Errors
/// PB005 if its text is too large.
pub(crate) fn program_scene(
    db: &dyn Db,
    traced: &TracedProgram,
    writing: &WriteSettings,
    emitted: Option<EmittedText<'_>>,
) -> Result<Option<ScenePath>, Box<Diagnostic>> {
    let TracedProgram { program, trace, parts } = traced;
    // The first part is the path that is emitted.
    let known = parts
        .iter()
        .zip(0..)
        .map(|(part, number)| in_force(db, part.file, &part.path.name, &part.bindings, number == 0));
    let known: Vec<Vec<ElementParameters>> = known.collect();
    let sources = parts.iter().zip(&known).map(|(part, known)| {
        let drawn = drawn_path(db, part.file, &part.path.name)?;
        Some((drawn_source(db, part.file, drawn, known), &part.path))
    });
    let Some(sources) = sources.collect::<Option<Vec<_>>>() else { return Ok(None) };
    // Disable z-split: each line of the text must correspond to one move.
    let correction = Correction { longest: 0.0, ..writing.options.correction };
    let options = WriteOptions { correction, ..writing.options };
    let text = WriteSettings { options, ..*writing }.text(program, &Header::default())?;
    let rapid = (options.rapid > 0.0).then_some(options.rapid);
    Ok(Some(view::program_path(&ProgramSource {
        program,
        trace,
        parts: &sources,
        text: &text,
        emitted,
        rapid,
    })))
}

fn drawn_source<'db>(
    db: &'db dyn Db,
    file: SourceFile,
    drawn: DrawnPath<'db>,
    in_force: &'db [ElementParameters],
) -> DrawnSource<'db> {
    let DrawnPath { raw, positions } = drawn;
    DrawnSource { file: file.path(db).as_str(), raw, positions, texts: assigned_texts(db, file), in_force }
}
