//! Options that programs need.

use pathbuild_db::MissingOption;
use pathbuild_diagnostic::Diagnostic;
use pathbuild_gcode::native::{Charset, WriteOptions};
use pathbuild_toolpath::{Correction, ZModel};

use super::outcome::Task;
use crate::config::types;
use crate::session::{CheckedTarget, WriteSettings};
use crate::workspace::Workspace;

/// Reports missing values that an error-free path needs. This is an error in usage.
pub(super) fn missing(context: &Workspace, task: Task, checked: &[CheckedTarget]) -> Option<String> {
    let sound = || checked.iter().filter(|checked| !checked.diagnostics.iter().any(Diagnostic::is_error));
    let is_missing = |option: &MissingOption| sound().any(|checked| checked.missing_options.contains(option));
    let has_no_rapid = context.settings.general.rapid.value.is_none() && sound().next().is_some();
    let options = [MissingOption::Feed, MissingOption::SweepHeight].into_iter().filter(is_missing);
    let rapid = (has_no_rapid && task.writes_times()).then_some("rapid");
    let names: Vec<&str> = options.map(MissingOption::name).chain(rapid).collect();
    (!names.is_empty()).then(|| missing_values(context, names))
}

/// Explains which values are missing and where to give them, one line each, with a further line if no configuration applies.
pub fn missing_values(context: &Workspace, names: impl IntoIterator<Item = &'static str>) -> String {
    let template = context.choose(
        "missing: {what}; give --{name}, or set `{name}` in pathbuild.toml",
        "es fehlt: {what}; --{name} angeben oder `{name}` in pathbuild.toml setzen",
    );
    let line = |name: &str| template.replace("{what}", meaning(context, name)).replace("{name}", name);
    let lines = names.into_iter().map(line).chain(no_configuration(context));
    lines.collect::<Vec<_>>().join("\n")
}

/// Names a configuration that does not apply here, so that users do not set keys in vain.
fn no_configuration(context: &Workspace) -> Option<String> {
    if context.settings.file.is_some() {
        return None;
    }
    Some(match context.unused_configuration() {
        Some(file) => context.phrase(
            "no configuration applies to this drawing: it lies outside the tree of {}; give --config {}, or move the drawing into the tree",
            "für diese Zeichnung gilt keine Konfiguration: sie liegt außerhalb des Verzeichnisbaums von {}; --config {} angeben oder die Zeichnung dorthin verschieben",
            file.as_str(),
        ),
        None => context
            .choose(
                "there is no pathbuild.toml beside or above the drawing: `pathbuild init` creates one in the working directory",
                "neben oder über der Zeichnung gibt es keine pathbuild.toml: `pathbuild init` legt eine im Arbeitsverzeichnis an",
            )
            .to_owned(),
    })
}

fn meaning<'a>(context: &'a Workspace, name: &str) -> &'a str {
    match name {
        "feed" => context.choose(
            "the milling feed in mm/min for paths without F",
            "der Fräsvorschub in mm/min für Pfade ohne F",
        ),
        "sweep-height" => context
            .choose("the sweep height in mm for paths without S", "die Leerfahrthöhe in mm für Pfade ohne S"),
        _ => context.choose(
            "the speed of rapid moves in mm/min, to estimate times",
            "die Eilganggeschwindigkeit in mm/min, um Zeiten zu schätzen",
        ),
    }
}

/// Settings for writing files.
pub fn writing(context: &Workspace) -> WriteSettings {
    let limits = &context.settings.limits;
    WriteSettings {
        options: write_options(context),
        most_moves: limits.embedding_moves.value,
        most_bytes: limits.output_size(),
        most_memory: limits.program_memory.value,
    }
}

/// Settings for writing native programs.
fn write_options(context: &Workspace) -> WriteOptions {
    let general = &context.settings.general;
    let charset = match general.charset.value {
        types::Charset::Ascii => Charset::Ascii,
        types::Charset::Utf8 => Charset::Utf8,
    };
    let rapid = general.rapid.value.unwrap_or_default();
    WriteOptions { lang: context.settings.comment_lang(), charset, rapid, correction: correction(context) }
}

/// How heights are corrected between probes.
fn correction(context: &Workspace) -> Correction {
    let model = match context.settings.general.z_model.value {
        types::ZModel::Idw4 => ZModel::Idw4,
        types::ZModel::Plane => ZModel::Plane,
        types::ZModel::Tin => ZModel::Tin,
    };
    Correction { model, longest: context.settings.z_split() }
}
