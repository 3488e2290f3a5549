//! What an argument of `view` means.

use camino::Utf8Path;
use pathbuild_db::{SourceFile, path_names};
use pathbuild_diagnostic::messages::outputs;
use pathbuild_diagnostic::{Diagnostic, shown};
use pathbuild_path::PathName;
use pathbuild_view::{GcodeSource, Scene, gcode_path};
use pathbuild_workspace::Inputs;
use pathbuild_workspace::files::is_there;
use pathbuild_workspace::session::{self, Session};

use crate::args::ViewArgs;
use crate::commands::program::Program;
use crate::context::Context;

/// A scene, and what is wrong with what it shows.
pub(super) struct Seen {
    pub(super) scene: Scene,
    /// The drawing or program that is shown.
    pub(super) file: String,
    pub(super) diagnostics: Vec<Diagnostic>,
}

/// Why there is nothing to see.
pub(super) enum Failure {
    Usage(String),
    Found(Vec<Diagnostic>),
}

/// What there is to see of the argument: of a file that is no drawing the program in it.
pub(super) fn seen(context: &Context, args: &ViewArgs) -> Result<Seen, Failure> {
    let file = Utf8Path::new(&args.what);
    let is_drawing = file.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("dxf"));
    if !is_drawing && is_there(file) {
        return program(context, file, args);
    }
    Session::new(context).settled(|session| drawing(session, &args.what))
}

fn program(context: &Context, file: &Utf8Path, args: &ViewArgs) -> Result<Seen, Failure> {
    let program =
        Program::open(context, file, &args.reading).map_err(|problem| Failure::Found(vec![*problem]))?;
    let mut scene = Scene::new(file.file_name().unwrap_or_default());
    let source =
        GcodeSource { file: file.as_str(), steps: &program.read.steps, text: &program.text, tool: None };
    scene.paths.push(gcode_path(&source));
    Ok(Seen { scene, file: file.to_string(), diagnostics: program.read.problems })
}

fn drawing(session: &Session<'_>, what: &str) -> Result<Seen, Failure> {
    let wanted = session.wanted(&Inputs { inputs: vec![what.to_owned()] });
    if !wanted.problems.is_empty() {
        return Err(Failure::Found(wanted.problems));
    }
    let db = session.db();
    let (file, names): (SourceFile, Vec<PathName>) =
        match (wanted.directories.as_slice(), wanted.paths.as_slice(), wanted.named.as_slice()) {
            ([], [path], []) => (path.file, vec![path.name.clone()]),
            ([], [], [file]) => (*file, path_names(db, *file).to_vec()),
            _ => {
                let what = shown::line(what);
                let reason = format!("view shows one path, drawing or program: `{what}` is a directory");
                return Err(Failure::Usage(reason));
            }
        };
    let session::Seen { scene, mut diagnostics } = session.scene(file, &names);
    if names.is_empty() && !diagnostics.iter().any(Diagnostic::is_error) {
        let problem = Diagnostic::new(&outputs::NO_PATH).with("pattern", "path-pattern");
        diagnostics.push(problem.in_file(file.path(db)));
    }
    Ok(Seen { scene, file: file.path(db).to_string(), diagnostics })
}
