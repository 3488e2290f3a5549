//! The results for clients: the program and the findings of a target, and Q-projects. (book: language/q-projects)

use std::sync::Arc;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_path::{
    Bindings, Component, Path, PathName, ProxyLine, QProject, compare_q_project, plan_q_project,
};
use pathbuild_toolpath::{Program, fold};

use crate::database::Db;
use crate::inputs::{Settings, SourceFile, Target};
use crate::queries::closures::closure;
use crate::queries::index::{bind, file_index};
use crate::queries::keep_outs::keep_out_collisions;
use crate::queries::neighbours::{neighbour_findings, neighbour_problems};
use crate::queries::part::{doubtful_outlines, example_findings, has_doubtful_outlines};
use crate::queries::programs::{ClosurePaths, fold_options};
use crate::queries::raw::{locate_in, raw_file, read_layers};

/// Folds a path and everything it embeds into a program. `None` if one of them has errors, an option is missing, or the tool hits a
/// clamp or cuts into a part. Programs are large and used once, so only the last few are kept.
#[salsa::tracked(lru = 16)]
pub fn program(db: &dyn Db, target: Target) -> Option<Arc<Program>> {
    let closure = closure(db, target);
    let is_right = !closure.has_errors() && closure.missing_options.is_empty();
    let is_harmful = || neighbour_problems(db, target).iter().any(Diagnostic::is_error);
    if !is_right || !keep_out_collisions(db, target).is_empty() || is_harmful() {
        return None;
    }
    let drawing = target.file(db).path(db).file_name().unwrap_or_default();
    let root = closure.root?;
    let program = fold(&ClosurePaths { db }, root, drawing, fold_options(db, target, root), closure.moves);
    Some(Arc::new(program))
}

/// Returns the findings about a file as a whole. Its paths are targets of their own.
pub fn check_file(db: &dyn Db, file: SourceFile) -> &[Diagnostic] {
    if example_findings(db, file).is_some_and(has_doubtful_outlines) {
        problems_with_outlines(db, file)
    } else {
        file_index(db, file).diagnostics()
    }
}

#[salsa::tracked]
fn problems_with_outlines(db: &dyn Db, file: SourceFile) -> Vec<Diagnostic> {
    let outlines = doubtful_outlines(db, file);
    file_index(db, file).diagnostics().iter().cloned().chain(outlines).collect()
}

/// Returns the findings about a path, everything it embeds, clamps in its way, and parts that it cuts into. They have no lines and handles yet, see
/// [`locate`].
pub fn check_target(db: &dyn Db, target: Target) -> impl Iterator<Item = &Diagnostic> {
    let found = closure(db, target).diagnostics.iter();
    found.chain(keep_out_collisions(db, target)).chain(neighbour_problems(db, target))
}

/// Returns the findings (PB214, PB217, PB218, PB221, PB222) about how the programs of these targets cut the parts of each other if they are joined
/// into one: all of them then begin at the same place. Cuts of a program into its own parts are not reported again.
pub fn check_joined_parts(db: &dyn Db, targets: &[Target]) -> Vec<Diagnostic> {
    neighbour_findings(db, targets).into_iter().map(|problem| locate(db, problem)).collect()
}

/// Fills in line and handle of the element that a diagnostic is about. Called last, so that no query depends on lines.
pub fn locate(db: &dyn Db, mut diagnostic: Diagnostic) -> Diagnostic {
    if let (Some(file), Some(path), Some(_)) = (&diagnostic.file, &diagnostic.path, diagnostic.place.element)
    {
        let (file, path) = (db.file(file), PathName::new(path));
        locate_in(db, file, &path, &mut diagnostic);
    }
    diagnostic.place.element = None;
    diagnostic
}

/// Plans the Q-project of a drawing: one path for each cutter.
#[salsa::tracked]
pub fn q_project(db: &dyn Db, drawing: SourceFile) -> Vec<QProject> {
    plan_q_project(&component(db, drawing))
}

/// Returns the disagreements between the proxy lines of a drawing and its Q-project.
#[salsa::tracked]
pub fn q_project_findings(db: &dyn Db, drawing: SourceFile, q_project: SourceFile) -> Vec<Diagnostic> {
    let paths = sound_paths(db, q_project);
    let found = compare_q_project(&component(db, drawing), drawing.path(db).as_str(), paths.as_deref());
    let in_component = found.in_component.into_iter().map(|problem| problem.in_file(drawing.path(db)));
    let in_q_project = found.in_q_project.into_iter().map(|problem| problem.in_file(q_project.path(db)));
    in_component.chain(in_q_project).collect()
}

fn component(db: &dyn Db, drawing: SourceFile) -> Component<'_> {
    let language = Settings::get(db).language(db);
    Component::new(raw_file(db, drawing).paths(), proxy_lines(db, drawing), language)
}

/// Returns the proxy lines of a drawing, which is read again with all its layers.
#[salsa::tracked]
fn proxy_lines(db: &dyn Db, file: SourceFile) -> Vec<ProxyLine> {
    let drawing = read_layers(db, file, &|_| true);
    pathbuild_path::proxy_lines(&drawing, Settings::get(db).language(db))
}

/// Returns the paths of a Q-project with example values. `None` if one of them has errors.
fn sound_paths(db: &dyn Db, file: SourceFile) -> Option<Vec<Path>> {
    let language = Settings::get(db).language(db);
    let is_readable = !check_file(db, file).iter().any(Diagnostic::is_error);
    let paths = raw_file(db, file).paths();
    let sound =
        |raw| bind(raw, &Bindings::check_values(&raw.definitions), language).path.map(Arc::unwrap_or_clone);
    is_readable.then(|| paths.map(sound).collect())?
}
