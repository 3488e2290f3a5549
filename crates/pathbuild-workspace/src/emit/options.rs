//! Inputs of programs besides their paths: the options that programs need, and the settings for writing them.

use std::borrow::Borrow;
use std::fmt::Debug;

use pathbuild_db::MissingOption;
use pathbuild_diagnostic::{Diagnostic, Lang};
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::native::WriteOptions;
use pathbuild_gcode::provenance::Provenance;
use pathbuild_gcode::verify::Machine;
use pathbuild_post::ToolTable;
use pathbuild_toolpath::{Correction, Program};

use super::outcome::Task;
use crate::config::{Settings, types};
use crate::findings::Severities;
use crate::post_processor::{PostProcessor, machine, tool_table};
use crate::session::{CheckedTarget, WriteSettings};
use crate::workspace::Workspace;

/// Returns the usage error about option values that paths without errors need but that are not given; `None` if there are none.
pub(super) fn missing_options_error(
    context: &Workspace,
    task: Task,
    checked: &[CheckedTarget],
) -> Option<String> {
    let sound = || checked.iter().filter(|checked| !checked.diagnostics.iter().any(Diagnostic::is_error));
    let is_missing = |option: &MissingOption| sound().any(|checked| checked.missing_options.contains(option));
    let has_no_rapid = context.settings.general.rapid.value.is_none() && sound().next().is_some();
    let options = [MissingOption::Feed, MissingOption::SweepHeight].into_iter().filter(is_missing);
    let rapid = (has_no_rapid && task.writes_times()).then_some("rapid");
    let names: Vec<&str> = options.map(MissingOption::name).chain(rapid).collect();
    (!names.is_empty()).then(|| missing_values(context, names))
}

/// Explains which option values are missing and where to give them, one line each, with a further line if no configuration applies.
pub fn missing_values(context: &Workspace, names: impl IntoIterator<Item = &'static str>) -> String {
    let template = context.choose(
        "missing: {what}; give --{name}, or set `{name}` in pathbuild.toml",
        "es fehlt: {what}; --{name} angeben oder `{name}` in pathbuild.toml setzen",
    );
    let line = |name: &str| template.replace("{what}", option_meaning(context, name)).replace("{name}", name);
    let lines = names.into_iter().map(line).chain(no_configuration(context));
    lines.collect::<Vec<_>>().join("\n")
}

/// Returns a sentence that says why no configuration applies to this run, so that users do not set keys without effect; `None` if one applies.
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

fn option_meaning<'a>(context: &'a Workspace, name: &str) -> &'a str {
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

/// Returns the settings for writing files, taken from the configuration.
pub fn write_settings(settings: &Settings) -> WriteSettings {
    let limits = &settings.limits;
    WriteSettings {
        options: write_options(settings),
        most_moves: limits.embedding_moves.value,
        most_bytes: limits.output_size(),
        most_memory: limits.program_memory.value,
    }
}

fn write_options(settings: &Settings) -> WriteOptions {
    let general = &settings.general;
    let rapid = general.rapid.value.unwrap_or_default();
    let correction = Correction { model: general.z_model.value, longest: settings.z_split() };
    WriteOptions { lang: settings.comment_lang(), charset: general.charset.value, rapid, correction }
}

/// The settings for writing programs, natively or through a post-processor.
pub(super) struct OutputSettings<'a> {
    pub(super) writing: WriteSettings,
    pub(super) severities: Severities<'a>,
    pub(super) post_processor: Option<&'a PostProcessor>,
    pub(super) provenances: Provenances,
    pub(super) sheets: SheetSettings,
    pub(super) machine: Option<Machine>,
    /// Whether drilled holes are to be written as canned cycles, or pecked.
    pub(super) has_cycles: bool,
}

impl<'a> OutputSettings<'a> {
    pub(super) fn new(workspace: &'a Workspace, post_processor: Option<&'a PostProcessor>) -> Self {
        let settings = &workspace.settings;
        let provenances = Provenances::new(settings, post_processor);
        let sheets = SheetSettings::new(settings, tool_table(settings), post_processor);
        Self {
            writing: write_settings(settings),
            severities: workspace.severities(),
            post_processor,
            provenances,
            sheets,
            machine: machine(settings),
            has_cycles: settings.general.cycles.value,
        }
    }
}

/// Settings shared by all sheets of a run.
#[derive(Debug)]
pub(super) struct SheetSettings {
    pub(super) lang: Lang,
    pub(super) tools: ToolTable,
    /// The configured tools, in the same order as `tools`.
    pub(super) configured_tools: Vec<types::Tool>,
    pub(super) starts_spindle: bool,
    pub(super) has_manual_changes: bool,
    pub(super) selects_g54: bool,
}

impl SheetSettings {
    pub(super) fn new(settings: &Settings, tools: ToolTable, post_processor: Option<&PostProcessor>) -> Self {
        let starts_spindle = post_processor.is_some_and(PostProcessor::starts_spindle);
        let has_manual_changes = post_processor.is_some_and(PostProcessor::has_manual_changes);
        let selects_g54 = post_processor.is_none_or(PostProcessor::selects_g54);
        let configured_tools = settings.tables.tools.value.clone();
        let lang = settings.comment_lang();
        Self { lang, tools, configured_tools, starts_spindle, has_manual_changes, selects_g54 }
    }
}

/// The part of the provenance that is the same for all programs of a run.
#[derive(Clone, Debug)]
pub struct Provenances {
    /// Serialized options that influence a program's text in addition to its moves.
    options: Vec<u8>,
    dialect: Option<Dialect>,
}

impl Provenances {
    /// Determines the provenance of programs that are written with these settings, natively or through a post-processor.
    pub fn new(settings: &Settings, post_processor: Option<&PostProcessor>) -> Self {
        let general = &settings.general;
        let mut options = Vec::new();
        let mut add = |value: &dyn Debug| options.extend(format!("{value:?}\n").into_bytes());
        add(&(general.rapid.value, general.compatible.value));
        add(&(general.z_model.value, settings.z_split()));
        add(&(settings.comment_lang(), general.charset.value));
        options.extend(post_processor.map(PostProcessor::identity).unwrap_or_default());
        let dialect = match post_processor {
            None => Some(Dialect::Native),
            Some(post_processor) => post_processor.reading_dialect(),
        };
        Self { options, dialect }
    }

    /// Returns the provenance of the programs in one file.
    pub fn of<P: Borrow<Program>>(&self, programs: &[P]) -> Provenance {
        Provenance::of_programs(programs, &self.options, self.dialect)
    }
}
