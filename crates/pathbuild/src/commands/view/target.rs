//! Resolves the argument of `view`.

use camino::Utf8Path;
use pathbuild_diagnostic::{Diagnostic, shown};
use pathbuild_view::Scene;
use pathbuild_workspace::emit::{SceneReport, ShownText};
use pathbuild_workspace::files::is_there;
use pathbuild_workspace::posting::{PostArguments, PostProcessor};
use pathbuild_workspace::session::{NamedPaths, Session};

use crate::args::ViewArgs;
use crate::commands::program::Program;
use crate::context::Context;

/// The scene of an argument.
pub(super) struct TargetScene {
    pub(super) report: SceneReport,
    /// The drawing or program that is shown.
    pub(super) file: String,
}

/// Why nothing can be shown.
pub(super) enum Failure {
    Usage(String),
    Found(Vec<Diagnostic>),
}

/// The scene of the argument. A file that is not a drawing is read as a program.
pub(super) fn target_scene(context: &Context, args: &ViewArgs) -> Result<TargetScene, Failure> {
    let file = Utf8Path::new(&args.what);
    let is_drawing = file.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("dxf"));
    if !is_drawing && is_there(file) {
        return program(context, file, args);
    }
    Session::new(context).with_stable_files(|session| drawing(session, &args.what))
}

fn program(context: &Context, file: &Utf8Path, args: &ViewArgs) -> Result<TargetScene, Failure> {
    let program =
        Program::open(context, file, &args.reading).map_err(|problem| Failure::Found(vec![*problem]))?;
    let mut scene = Scene::new(file.file_name().unwrap_or_default());
    scene.paths.push(program.scene_path(context));
    let report = SceneReport { scene, diagnostics: program.read.problems };
    Ok(TargetScene { report, file: file.to_string() })
}

fn drawing(session: &Session<'_>, what: &str) -> Result<TargetScene, Failure> {
    let Some(NamedPaths { file, names }) = session.named_paths(what).map_err(Failure::Found)? else {
        let reason = session.workspace().phrase(
            "view shows one path, drawing or program: `{}` is a directory",
            "view zeigt einen Pfad, eine Zeichnung oder ein Programm: `{}` ist ein Verzeichnis",
            &shown::line(what),
        );
        return Err(Failure::Usage(reason));
    };
    let db = session.db();
    let post_processor = PostProcessor::for_run(session.workspace(), None, PostArguments::default());
    let post_processor = post_processor.map_err(Failure::Found)?;
    let mut report = session.scene(file, &names, ShownText::Emitted(post_processor.as_ref()));
    let missing = session.no_path(file.path(db), &names, &report.diagnostics);
    report.diagnostics.extend(missing);
    if names.is_empty() {
        // An empty picture could replace one that shows something.
        return Err(Failure::Found(report.diagnostics));
    }
    report.diagnostics = session.with_hints(report.diagnostics);
    Ok(TargetScene { report, file: file.path(db).to_string() })
}
