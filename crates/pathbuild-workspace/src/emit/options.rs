//! The options that programs need.

use pathbuild_db::MissingOption;
use pathbuild_diagnostic::Diagnostic;
use pathbuild_gcode::native::{Charset, WriteOptions};
use pathbuild_toolpath::{Correction, ZModel};

use super::deliver::Task;
use crate::config::types;
use crate::session::{CheckedTarget, Writing};
use crate::workspace::Workspace;

/// A value that a program needs and nobody gives is wrong usage; what has errors is not asked for it.
pub(super) fn missing(context: &Workspace, task: Task, checked: &[CheckedTarget]) -> Option<String> {
    let sound = || checked.iter().filter(|checked| !checked.diagnostics.iter().any(Diagnostic::is_error));
    let is_missing = |option| sound().any(|checked| checked.missing_options.contains(&option));
    let has_no_rapid = context.settings.general.rapid.value.is_none() && sound().next().is_some();
    let missing = [
        (is_missing(MissingOption::Feed), "feed", "the milling feed in mm/min of paths without F"),
        (is_missing(MissingOption::SweepHeight), "sweep-height", "the sweep height in mm of paths without S"),
        (has_no_rapid && task.writes_times(), "rapid", "the rapid feed in mm/min, for times"),
    ];
    let lines = missing.iter().filter(|(is_missing, ..)| *is_missing);
    let lines: Vec<String> = lines
        .map(|(_, name, what)| format!("missing {what}: give --{name}, or set `{name}` in pathbuild.toml"))
        .collect();
    (!lines.is_empty()).then(|| lines.join("\n"))
}

/// How files are written.
pub(crate) fn writing(context: &Workspace) -> Writing {
    let limits = &context.settings.limits;
    Writing {
        options: write_options(context),
        most_moves: limits.embedding_moves.value,
        most_bytes: limits.output_size(),
        most_memory: limits.program_memory.value,
    }
}

/// How texts are written.
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
