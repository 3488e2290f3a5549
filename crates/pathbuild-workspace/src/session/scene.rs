//! What there is to see of paths, made by the same queries as their programs.

use std::slice;

use camino::Utf8Path;
use pathbuild_db::{
    Db, DrawnPath, Role, Settings, SourceFile, Target, Traced, assigned_texts, check_file, drawn_path,
    file_index, in_force, keep_outs, other_layers, path_names, placed_keep_outs, program, traced_program,
};
use pathbuild_diagnostic::{Code, Diagnostic, Lang, Number};
use pathbuild_gcode::native::{Header, WriteOptions};
use pathbuild_gcode::provenance::Provenance;
use pathbuild_path::{InForce, KeepOut, PathName, PathRole};
use pathbuild_toolpath::{Correction, Move, Step};
use pathbuild_view::{
    self as view, DrawnSource, EmittedText, Example, ProgramSource, Said, Scene, ScenePath,
};

use super::work::about;
use super::{CheckedTarget, Session, Writing};
use crate::emit::{program_text, writing};
use crate::findings::Findings;
use crate::posting::PostProcessor;
use crate::workspace::Workspace;

/// A scene, and what is wrong with what it shows.
#[derive(Debug)]
pub struct Seen {
    /// What there is to see. Its findings are still to be filled in by who judges them.
    pub scene: Scene,
    /// What is wrong, located.
    pub diagnostics: Vec<Diagnostic>,
}

/// Which text of a program is shown with its moves.
#[derive(Clone, Copy, Debug)]
pub enum ShownText<'a> {
    /// The native one.
    Native,
    /// What `emit` writes, natively or through a post; the native one where it writes nothing.
    Emitted(Option<&'a PostProcessor>),
}

/// What is known of a path's moves without a picture of them.
#[derive(Debug)]
pub struct HashedPath {
    /// The drawing that defines it.
    pub file: SourceFile,
    /// Its name.
    pub name: PathName,
    /// A hash of its program's moves; `None` where it has errors, or its program could not be made.
    pub moves: Option<Box<str>>,
    /// The limits and bugs that kept its program from being made.
    pub problems: Vec<Diagnostic>,
}

impl Seen {
    /// The scene with its findings, by the configuration's severities. `file` is the drawing that is shown.
    pub fn judged(self, workspace: &Workspace, file: &str) -> (Scene, Findings) {
        let (mut scene, findings) = (self.scene, workspace.findings(self.diagnostics));
        scene.findings = view::findings(&findings.diagnostics, file);
        (scene, findings)
    }
}

impl Session<'_> {
    /// What there is to see of some paths of a drawing, with their texts. Where options are missing, and of paths with variables, the program is that of a
    /// check: with example values, and S as if it were embedded.
    pub fn scene(&self, file: SourceFile, names: &[PathName], text: ShownText<'_>) -> Seen {
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
        Seen { scene, diagnostics }
    }

    /// What is drawn in some drawings, without programs: of each, unless it shows a bug.
    pub fn drawn_scenes(&self, files: &[&Utf8Path]) -> Vec<Option<Scene>> {
        let files: Vec<SourceFile> = files.iter().map(|file| self.file(file)).collect();
        let scenes =
            self.guarded(&files, |db: &pathbuild_db::Database, file: &SourceFile| drawn_scene(db, *file));
        scenes.into_iter().map(Result::ok).collect()
    }

    /// A path, what is wrong with it, and the clamps that it embeds, where they stand in its program.
    fn scene_path(
        &self,
        file: SourceFile,
        name: &PathName,
        text: ShownText<'_>,
    ) -> (Option<ScenePath>, Vec<Diagnostic>, Vec<KeepOut>) {
        let checked =
            self.each(slice::from_ref(name), |asking, name| asking.check_as_known(file, name)).pop();
        let Some(checked) = checked else { return (None, Vec::new(), Vec::new()) };
        let writing = &writing(self.context);
        // Without a rapid feed, and of what is only checked, `emit` writes nothing: the text is a preview.
        let is_written = *checked.target.role(&self.db) == Role::Emitted
            && self.context.settings.general.rapid.value.is_some();
        let (emitted, refusal) = match text {
            ShownText::Native => (None, None),
            ShownText::Emitted(poster) => match program_text(self, poster, &checked) {
                Ok(emitted) => (emitted, None),
                Err(problems) => (None, problems.iter().find(|it| it.is_error() && is_written).map(said)),
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
        let made = self.guarded(slice::from_ref(&checked.target), work).pop();
        match made {
            Some(Ok(Ok(Some((scene, clamps))))) => return (Some(scene), diagnostics, clamps),
            Some(Err(problem) | Ok(Err(problem))) => diagnostics.push(at(*problem)),
            Some(Ok(Ok(None))) | None => {}
        }
        let drawn = drawn_path(&self.db, file, name);
        let examples = file_index(&self.db, file).path(name).map(|path| path.examples.clone());
        let known = in_force(&self.db, file, name, &examples.unwrap_or_default(), true);
        let drawn = drawn.map(|drawn| view::drawn_path(&drawn_source(&self.db, file, drawn, &known)));
        (drawn, diagnostics, Vec::new())
    }

    /// A hash of the moves of each path of some drawings, of the programs that [`scene`](Self::scene) shows.
    pub fn move_hashes(&self, files: &[SourceFile]) -> Vec<HashedPath> {
        let names = files.iter().map(|file| (*file, path_names(&self.db, *file)));
        let wanted: Vec<(SourceFile, PathName)> =
            names.flat_map(|(file, names)| names.iter().map(move |name| (file, name.clone()))).collect();
        let checked = self.each(&wanted, |asking, (file, name)| asking.check_as_known(*file, name));
        let hash = |db: &pathbuild_db::Database, checked: &CheckedTarget| {
            program(db, checked.target)
                .as_deref()
                .map(|program| Provenance::of_programs(&[program], &[], None).moves)
        };
        let hashes = self.guarded(&checked, hash);
        let hashed = |(((file, name), checked), hash): ((_, CheckedTarget), Result<_, Box<Diagnostic>>)| {
            let mut problems: Vec<Diagnostic> =
                checked.diagnostics.into_iter().filter(stops_making).collect();
            let moves = hash.unwrap_or_else(|problem| {
                let problem = about(&self.db, checked.target, *problem);
                // A check that took too long has said the same.
                problems.extend((!problems.contains(&problem)).then_some(problem));
                None
            });
            HashedPath { file, name, moves, problems }
        };
        wanted.into_iter().zip(checked).zip(hashes).map(hashed).collect()
    }
}

/// Whether a limit or a bug kept something from being made: then nothing is said of the drawing, which may be right.
fn stops_making(problem: &Diagnostic) -> bool {
    matches!(problem.code(), Code::LimitReached | Code::InternalError) && problem.is_error()
}

/// A finding's message in both languages.
fn said(problem: &Diagnostic) -> Said {
    Said { en: problem.text(Lang::En), de: problem.text(Lang::De) }
}

/// The values that a program has only because it is shown: of variables, of S and of options that nothing gives.
fn examples(db: &dyn Db, Traced { program, parts, .. }: &Traced, writing: &Writing) -> Vec<Example> {
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

/// What is drawn in a drawing.
fn drawn_scene(db: &dyn Db, file: SourceFile) -> Scene {
    let mut scene = Scene::new(file.path(db).file_name().unwrap_or_default());
    scene.keep_outs.extend(keep_outs(db, file).iter().map(|clamp| view::keep_out(clamp, [0.0, 0.0])));
    let paths = path_names(db, file).iter().filter_map(|name| drawn_path(db, file, name));
    scene.paths.extend(paths.map(|drawn| view::drawn_path(&drawn_source(db, file, drawn, &[]))));
    scene.other_layers = view::other_layers(other_layers(db, file));
    scene
}

/// A program with where it comes from; `None` where a drawing changed meanwhile.
///
/// # Errors
/// PB005: where its text is too large.
pub(crate) fn program_scene(
    db: &dyn Db,
    traced: &Traced,
    writing: &Writing,
    emitted: Option<EmittedText<'_>>,
) -> Result<Option<ScenePath>, Box<Diagnostic>> {
    let Traced { program, trace, parts } = traced;
    // The first is the path that is emitted.
    let known = parts
        .iter()
        .zip(0..)
        .map(|(part, number)| in_force(db, part.file, &part.path.name, &part.bindings, number == 0));
    let known: Vec<Vec<InForce>> = known.collect();
    let sources = parts.iter().zip(&known).map(|(part, known)| {
        let drawn = drawn_path(db, part.file, &part.path.name)?;
        Some((drawn_source(db, part.file, drawn, known), &part.path))
    });
    let Some(sources) = sources.collect::<Option<Vec<_>>>() else { return Ok(None) };
    // Each line is to be one move.
    let correction = Correction { longest: 0.0, ..writing.options.correction };
    let options = WriteOptions { correction, ..writing.options };
    let text = Writing { options, ..*writing }.text(program, &Header::default())?;
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
    in_force: &'db [InForce],
) -> DrawnSource<'db> {
    let DrawnPath { raw, positions } = drawn;
    DrawnSource { file: file.path(db).as_str(), raw, positions, texts: assigned_texts(db, file), in_force }
}
