//! Views of a path for other commands: its scene, the text of its program, and its setup sheet.

use std::slice;
use std::sync::Arc;

use camino::{Utf8Component, Utf8Path, Utf8PathBuf};
use pathbuild_db::{
    Database, Role, SourceFile, Target, assigned_texts, check_file, drawn_path, effective_parameters,
    file_index, keep_outs, path_names, placed_keep_outs, remaining_layers, traced_program, uncut_rings,
};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_gcode::dialect::Dialect;
use pathbuild_path::{KeepOut, PathName};
use pathbuild_view::{self as view, BilingualText, GcodeText, Parameter, Scene, ScenePath, Sheet};

use super::build::{BuiltProgram, build};
use super::options::{self, OutputSettings, write_settings};
use super::outcome::Task;
use super::plan::{Job, JobBuilder, Plan};
use super::sheet::sheet;
use crate::config::Origin;
use crate::config::types::SheetFormat;
use crate::findings::Findings;
use crate::post_processor::{PostProcessor, tip};
use crate::session::{
    CheckedTarget, NamedPaths, NotOnePath, ProgramDetails, Session, drawn_source, examples, finished_parts,
    program_scene,
};
use crate::workspace::{Workspace, relative};

/// A scene, with the diagnostics of its paths.
#[derive(Debug)]
pub struct SceneReport {
    /// The scene, without findings until [`with_findings`](Self::with_findings) adds them.
    pub scene: Scene,
    /// Diagnostics with their locations.
    pub diagnostics: Vec<Diagnostic>,
    /// Errors that keep `emit` from writing programs of the paths, besides the errors in `diagnostics`. Empty unless the texts of the written
    /// programs were requested.
    pub refusals: Vec<Diagnostic>,
}

/// The program text that is shown beside the moves.
#[derive(Clone, Copy, Debug)]
pub enum ShownText<'a> {
    /// No program, and no parameters of elements: pictures show neither.
    Omitted,
    /// The native program, even if `emit` writes another one.
    Native,
    /// The program that `emit` writes, natively or through a post-processor. The native program is shown beside that of a post-processor, and in
    /// place of a program that `emit` does not write.
    Emitted(Option<&'a PostProcessor>),
}

impl SceneReport {
    /// Adds the findings to the scene, with configured severities. `file` is the drawing that is shown.
    pub fn with_findings(self, workspace: &Workspace, file: &str) -> (Scene, Findings) {
        let (mut scene, findings) = (self.scene, workspace.findings(self.diagnostics));
        scene.set_findings(&findings.diagnostics, file);
        (scene, findings)
    }

    /// Like [`with_findings`](Self::with_findings), for a document that is sent to others: absolute file names become relative to the shown file,
    /// so that they do not reveal the user's directories.
    pub fn for_sharing(mut self, workspace: &Workspace, file: &str) -> (Scene, Findings) {
        let findings = workspace.findings(self.diagnostics);
        let directory = Utf8Path::new(file).parent().unwrap_or(Utf8Path::new(""));
        let mut shown = findings.diagnostics.clone();
        for diagnostic in &mut shown {
            diagnostic.rename_files(|text| near_name(text, directory));
        }
        let own_name = |file: &str| near_name(file, directory).unwrap_or_else(|| shortened_name(file));
        for path in &mut self.scene.paths {
            if path.name == path.file {
                path.name = own_name(&path.name);
            }
            path.file = own_name(&path.file);
            path.written = path.written.take().map(|file| own_name(&file));
            path.embedded.iter_mut().for_each(|embedded| embedded.file = own_name(&embedded.file));
        }
        self.scene.set_findings(&shown, &own_name(file));
        (self.scene, findings)
    }
}

/// Returns the name of a file or directory relative to a directory, if both are absolute and have more in common than the root.
fn near_name(name: &str, directory: &Utf8Path) -> Option<String> {
    let name = Utf8Path::new(name);
    let common = name.components().zip(directory.components()).take_while(|(one, other)| one == other);
    let is_near = name.is_absolute() && common.filter(|(one, _)| is_normal(one)).count() > 0;
    is_near.then(|| relative(name, directory).into_string())
}

fn is_normal(component: &Utf8Component<'_>) -> bool {
    matches!(component, Utf8Component::Normal(_))
}

/// Returns the last component of an absolute name; any other name unchanged.
fn shortened_name(name: &str) -> String {
    let path = Utf8Path::new(name);
    path.file_name().filter(|_| path.is_absolute()).unwrap_or(name).to_owned()
}

impl Session<'_> {
    /// Returns the scene of some paths of a drawing, with the texts of their programs. If options are missing, or if a path has variables, its
    /// program is the one that `check` examines: with example values, and with the sweep height (S) of an embedded path.
    pub fn scene(&self, file: SourceFile, names: &[PathName], text: ShownText<'_>) -> SceneReport {
        let name = file.path(self.db()).as_str();
        let title = match names {
            [path] => path.as_str(),
            _ => file.path(self.db()).file_name().unwrap_or(name),
        };
        let mut scene = Scene::new(title);
        let mut diagnostics = check_file(self.db(), file).to_vec();
        let mut refusals = Vec::new();
        scene
            .keep_outs
            .extend(keep_outs(self.db(), file).iter().map(|clamp| view::keep_out(clamp, [0.0, 0.0])));
        // Collect these layers and texts before the paths are built: the drawing is read again for them, which would otherwise add to the memory that
        // the paths take.
        scene.other_layers = view::other_layers(remaining_layers(self.db(), file));
        assigned_texts(self.db(), file);
        for path in names {
            let (seen, found, clamps) = self.scene_path(file, path, text, &mut refusals);
            let zero = seen.as_ref().map_or([0.0, 0.0], |seen| seen.zero);
            scene.keep_outs.extend(clamps.iter().map(|clamp| view::keep_out(clamp, zero)));
            scene.paths.extend(seen);
            diagnostics.extend(found);
        }
        scene.uncut = uncut_rings(self.db(), file).into_iter().map(view::outline).collect();
        self.add_origins(&mut scene);
        SceneReport { scene, diagnostics, refusals }
    }

    /// Returns the scene of a path, given the drawing's file and the path's name; `None` if the drawing has no such path.
    pub fn scene_of(&self, drawing: &Utf8Path, name: &str) -> Option<Scene> {
        let file = self.file(drawing);
        let name = path_names(self.db(), file).iter().find(|path| path.as_str() == name)?;
        Some(self.scene(file, slice::from_ref(name), ShownText::Omitted).scene)
    }

    /// Adds the line in pathbuild.toml to each parameter whose value is a default from the configuration.
    fn add_origins(&self, scene: &mut Scene) {
        let with_origin = |parameter: &Parameter| {
            let option = parameter.which.as_deref().filter(|_| parameter.from == "option");
            let origin = option.map(|option| self.workspace().settings.origin_of_option(option));
            Parameter { line: origin.and_then(Origin::line), ..parameter.clone() }
        };
        // Consecutive elements often share their parameters. Reusing the result lets them share the new ones as well.
        let mut last: Option<[Arc<[Parameter]>; 2]> = None;
        for element in scene.paths.iter_mut().flat_map(|path| &mut path.elements) {
            let known = last.take().filter(|[without, _]| Arc::ptr_eq(without, &element.parameters));
            let [without, with] = known.unwrap_or_else(|| {
                [Arc::clone(&element.parameters), element.parameters.iter().map(with_origin).collect()]
            });
            element.parameters = Arc::clone(&with);
            last = Some([without, with]);
        }
    }

    /// Returns the scene of a path, its diagnostics, and the clamps of the paths that it embeds, at their positions in the program. Adds the errors
    /// that keep its program from being written to `refusals`.
    fn scene_path(
        &self,
        file: SourceFile,
        name: &PathName,
        text: ShownText<'_>,
        refusals: &mut Vec<Diagnostic>,
    ) -> (Option<ScenePath>, Vec<Diagnostic>, Vec<KeepOut>) {
        let Some(checked) = self.check_leniently(file, name) else { return (None, Vec::new(), Vec::new()) };
        let settings = &self.workspace().settings;
        let writing = &write_settings(settings);
        let at = |problem: Diagnostic| problem.in_file(file.path(self.db())).in_path(name.as_str());
        let (emitted, refused) = match text {
            ShownText::Omitted | ShownText::Native => (None, Vec::new()),
            ShownText::Emitted(post_processor) => self.emitted_text(post_processor, &checked),
        };
        let refusal = refused.first().map(|problem| BilingualText::of(|lang| problem.text(lang)));
        refusals.extend(refused);
        let emitted = emitted.as_ref().map(|emitted| GcodeText {
            file: self.is_written(&checked).then_some(emitted.file.as_str()),
            bytes: &emitted.bytes,
            dialect: emitted.dialect,
        });
        let details = || {
            let has_native = match text {
                ShownText::Omitted => return None,
                ShownText::Native => true,
                // A native text that `emit` writes is not shown twice.
                ShownText::Emitted(post_processor) => emitted.is_none() || post_processor.is_some(),
            };
            Some(ProgramDetails { has_native, emitted })
        };
        let work = |db: &Database, target: &Target| -> Result<_, Box<Diagnostic>> {
            let Some(traced) = traced_program(db, *target) else { return Ok(None) };
            let mut scene = program_scene(db, traced, writing, details())?;
            if let Some(scene) = &mut scene {
                scene.examples = examples(db, traced, writing);
                scene.refusal.clone_from(&refusal);
                scene.parts = finished_parts(db, *target);
                scene.tip = tip(settings, &traced.program.path, traced.program.tool);
            }
            let embedded = placed_keep_outs(db, *target).into_iter().filter(|clamp| clamp.occurrence > 0);
            Ok(scene.map(|scene| (scene, embedded.map(|clamp| clamp.placed).collect::<Vec<KeepOut>>())))
        };
        let mut diagnostics = checked.diagnostics;
        let result = self.map_guarded(slice::from_ref(&checked.target), work).pop();
        match result {
            Some(Ok(Ok(Some((scene, clamps))))) => return (Some(scene), diagnostics, clamps),
            Some(Err(problem) | Ok(Err(problem))) => diagnostics.push(at(*problem)),
            Some(Ok(Ok(None))) | None => {}
        }
        let drawn = drawn_path(self.db(), file, name);
        let examples = file_index(self.db(), file).path(name).map(|path| path.examples.clone());
        let parameters = effective_parameters(self.db(), file, name, &examples.unwrap_or_default(), true);
        let drawn = drawn.map(|drawn| view::drawn_path(&drawn_source(self.db(), file, drawn, &parameters)));
        (drawn, diagnostics, Vec::new())
    }
}

impl Session<'_> {
    /// Returns the errors that keep `emit` from writing the program of a path that has no errors.
    pub fn refusals(
        &self,
        file: SourceFile,
        name: &PathName,
        post_processor: Option<&PostProcessor>,
    ) -> Vec<Diagnostic> {
        let checked = self.check_leniently(file, name);
        checked.map_or_else(Vec::new, |checked| self.emitted_text(post_processor, &checked).1)
    }

    fn check_leniently(&self, file: SourceFile, name: &PathName) -> Option<CheckedTarget> {
        self.map_with_checker(slice::from_ref(name), |checker, name| checker.check_leniently(file, name))
            .pop()
    }

    /// Whether `emit` writes a program for the path. Without `rapid`, or for a path that is only checked, its text is a preview.
    fn is_written(&self, checked: &CheckedTarget) -> bool {
        *checked.target.role(self.db()) == Role::Emitted
            && self.workspace().settings.general.rapid.value.is_some()
    }

    /// Returns the text of the program that `emit` writes, and the errors for which it refuses to.
    fn emitted_text(
        &self,
        post_processor: Option<&PostProcessor>,
        checked: &CheckedTarget,
    ) -> (Option<ProgramText>, Vec<Diagnostic>) {
        let (emitted, mut refused) = match program_text(self, post_processor, checked) {
            Ok(emitted) => (emitted, Vec::new()),
            Err(problems) => (None, problems),
        };
        let is_error = |problem: &Diagnostic| problem.is_error() || self.workspace().has_error([problem]);
        refused.retain(|problem| is_error(problem) && self.is_written(checked));
        let (db, target) = (self.db(), checked.target);
        let with_place = |problem: Diagnostic| match problem.file {
            Some(_) => problem,
            None => problem.in_file(target.file(db).path(db)).in_path(target.name(db)),
        };
        (emitted, refused.into_iter().map(with_place).map(Diagnostic::as_error).collect())
    }
}

/// A sheet with the diagnostics of its path.
#[derive(Debug)]
pub struct SheetOutcome {
    /// The sheet; `None` if the path has errors.
    pub sheet: Option<Sheet>,
    /// All diagnostics of the path.
    pub diagnostics: Vec<Diagnostic>,
}

/// Creates the setup sheet of a path, or of a drawing's only path.
///
/// # Errors
/// If the argument is invalid or options are missing, with the message.
pub fn sheet_of(
    session: &mut Session<'_>,
    post_processor: Option<&PostProcessor>,
    what: &str,
) -> Result<SheetOutcome, String> {
    session.with_stable_files(|session| match resolve_target(session, what)? {
        Ok(target) => sheet_of_target(session, post_processor, target),
        Err(diagnostics) => Ok(SheetOutcome { sheet: None, diagnostics: session.with_hints(diagnostics) }),
    })
}

/// Resolves an argument to a path, or returns the diagnostics of its drawing.
fn resolve_target(session: &Session<'_>, what: &str) -> Result<Result<Target, Vec<Diagnostic>>, String> {
    let context = session.workspace();
    match session.one_path(what, Role::Emitted) {
        Ok(target) => Ok(Ok(target)),
        Err(NotOnePath::Wrong(diagnostics)) => Ok(Err(diagnostics)),
        Err(NotOnePath::Several(NamedPaths { names, .. })) => {
            let names: Vec<&str> = names.iter().map(PathName::as_str).collect();
            Err(context.phrase(
                "a setup sheet shows a single path: name one of {}",
                "ein Einrichteblatt zeigt einen einzelnen Pfad: einen von diesen nennen: {}",
                &names.join(", "),
            ))
        }
        Err(NotOnePath::Directory) => Err(context
            .choose(
                "a setup sheet shows a single path: this is a directory",
                "ein Einrichteblatt zeigt einen einzelnen Pfad: das ist ein Verzeichnis",
            )
            .into()),
    }
}

fn sheet_of_target(
    session: &Session<'_>,
    post_processor: Option<&PostProcessor>,
    target: Target,
) -> Result<SheetOutcome, String> {
    let context = session.workspace();
    let checked = session.check(&[target]);
    if let Some(refusal) = options::missing_options_error(context, Task::Write { force: false }, &checked) {
        return Err(refusal);
    }
    let builder = JobBuilder { session, post_processor, join: None, sheet: SheetFormat::No };
    let Plan { mut diagnostics, refusals, job } = builder.plan(&checked);
    diagnostics.extend(refusals);
    let sheet = job.and_then(|job| sheet_of_job(session, &job, post_processor, &mut diagnostics));
    let sheet = sheet.filter(|_| !context.has_error(&diagnostics));
    if sheet.is_none() {
        diagnostics.extend(context.lowered_error(&diagnostics));
    }
    Ok(SheetOutcome { sheet, diagnostics: session.with_hints(diagnostics) })
}

/// Returns the sheet of a job; `None` if its program would not be written.
fn sheet_of_job(
    session: &Session<'_>,
    job: &Job,
    post_processor: Option<&PostProcessor>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Sheet> {
    let settings = OutputSettings::new(session.workspace(), post_processor);
    let work = |db: &Database, job: &&Job| {
        let result = build(db, job, &settings);
        let sheet = if result.outcome.is_refused { Ok(None) } else { sheet(db, job, &settings) };
        (result.outcome.problems, sheet)
    };
    let result = session.map_guarded(&[job], work).pop()?;
    let sheet = result.and_then(|(problems, sheet)| {
        diagnostics.extend(problems);
        sheet
    });
    sheet.unwrap_or_else(|problem| {
        diagnostics.push(problem.in_file(job.drawing(session.db()).path(session.db())));
        None
    })
}

/// The bytes of a program file that is not on disk.
struct ProgramText {
    /// Path to which `emit` would write the program.
    file: Utf8PathBuf,
    bytes: Vec<u8>,
    dialect: Dialect,
}

/// Generates the program of a checked path; returns `None` if the path has errors, with the configured severities.
///
/// # Errors
/// If `emit` would refuse to write the program, with the reasons.
fn program_text(
    session: &Session<'_>,
    post_processor: Option<&PostProcessor>,
    checked: &CheckedTarget,
) -> Result<Option<ProgramText>, Vec<Diagnostic>> {
    let builder = JobBuilder { session, post_processor, join: None, sheet: SheetFormat::No };
    let Some(job) = builder.own_job(checked)? else { return Ok(None) };
    let settings = OutputSettings::new(session.workspace(), post_processor);
    let work = |db: &Database, job: &Job| build(db, job, &settings);
    let files =
        session.map_guarded(slice::from_ref(&job), work).pop().unwrap_or_else(|| Ok(BuiltProgram::default()));
    let files = files.map_err(|problem| vec![*problem])?;
    // If the dialect is unknown, assume that of LinuxCNC, as for reading the text back.
    let dialect = post_processor.map_or(Dialect::Native, |post_processor| {
        post_processor.reading_dialect().unwrap_or(Dialect::LinuxCnc)
    });
    match files.outputs.into_iter().find(|output| output.kind.is_program()) {
        Some(output) => Ok(Some(ProgramText { file: output.path, bytes: output.text, dialect })),
        None => Err(files.outcome.problems),
    }
}
