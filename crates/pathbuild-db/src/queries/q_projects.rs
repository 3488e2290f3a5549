//! Q-projects: `NAME_Q` embeds every path of `NAME` as given by its proxy lines. (book: language/q-projects)

use pathbuild_diagnostic::Diagnostic;
use pathbuild_path::{Bindings, Component, Path, ProxyLine, QProject, judge_q_project, plan_q_project};

use super::binding::bind;
use super::raw::raw_file;
use super::report::check_file;
use super::rereading::read_layers;
use crate::db::Db;
use crate::inputs::SourceFile;
use crate::settings::Settings;

/// The Q-project of a drawing.
#[salsa::tracked]
pub fn q_project(db: &dyn Db, drawing: SourceFile) -> Vec<QProject> {
    plan_q_project(&component(db, drawing))
}

/// Disagreements between the proxy lines of a drawing and its Q-project.
#[salsa::tracked]
pub fn q_project_findings(db: &dyn Db, drawing: SourceFile, q_project: SourceFile) -> Vec<Diagnostic> {
    let paths = sound_paths(db, q_project);
    let name = drawing.path(db).file_name().unwrap_or_default();
    let found = judge_q_project(&component(db, drawing), name, paths.as_deref());
    let in_component = found.in_component.into_iter().map(|problem| problem.in_file(drawing.path(db)));
    let in_q_project = found.in_q_project.into_iter().map(|problem| problem.in_file(q_project.path(db)));
    in_component.chain(in_q_project).collect()
}

fn component(db: &dyn Db, drawing: SourceFile) -> Component<'_> {
    let language = Settings::get(db).language(db);
    Component::new(raw_file(db, drawing).paths(), proxy_lines(db, drawing), language)
}

/// The proxy lines of a drawing, which is read again with all its layers.
#[salsa::tracked]
fn proxy_lines(db: &dyn Db, file: SourceFile) -> Vec<ProxyLine> {
    let drawing = read_layers(db, file, &|_| true);
    pathbuild_path::proxy_lines(&drawing, Settings::get(db).language(db))
}

/// The paths of a Q-project with example values. `None` if one of them has errors.
fn sound_paths(db: &dyn Db, file: SourceFile) -> Option<Vec<Path>> {
    let language = Settings::get(db).language(db);
    let is_readable = !check_file(db, file).iter().any(Diagnostic::is_error);
    let paths = raw_file(db, file).paths();
    let sound = |raw| bind(raw, &Bindings::check_values(&raw.definitions), language).path;
    is_readable.then(|| paths.map(sound).collect())?
}
