//! The settings of a run, each with its source, and which cached results depend on them.

use std::fmt::Debug;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::ConfinedSystem;
use pathbuild_diagnostic::Lang;
use pathbuild_toolpath::ZModel;
use toml::de::DeTable;

use super::origin::{Origin, ResultKind};
use super::reader::TomlReader;
use super::sections::{emit, general, limits, machine, tables, verify, warnings, watch};
use super::types::Severities;
use crate::waivers::RunDate;

/// The settings of a run, each with its source.
#[derive(Clone, Debug)]
#[expect(missing_docs, reason = "the tables of the configuration, by name")]
pub struct Settings {
    /// The configuration that was read. If `None`, only options and defaults apply, and nothing is cached.
    pub file: Option<Utf8PathBuf>,
    /// The working directory's configuration if it does not apply, because the arguments lie outside its tree and below no other
    /// configuration.
    pub not_used: Option<Utf8PathBuf>,
    /// Whether `file` applies to a program although the working directory has another configuration, or the program lies outside its tree.
    pub is_unexpected: bool,
    /// The repositories that an untrusted run must not leave; `None` if the run is trusted.
    pub confined: Option<ConfinedSystem>,
    /// The date that waivers are compared with; without one, waivers with a date do not hold. No cached result depends on it.
    pub date: Option<RunDate>,
    pub general: general::Settings,
    pub emit: emit::Settings,
    pub limits: limits::Settings,
    pub machine: machine::Settings,
    /// `[verify]`
    pub verify: verify::Settings,
    pub warnings: warnings::Settings,
    pub watch: watch::Settings,
    pub tables: tables::Settings,
}

impl Settings {
    /// Source of an option's value that applies where drawings give none: `feed`, `sweep-height` or `probe-feed`.
    pub fn origin_of_option(&self, name: &str) -> Origin {
        let general = &self.general;
        [&general.feed, &general.sweep_height, &general.probe_feed]
            .into_iter()
            .zip(["feed", "sweep-height", "probe-feed"])
            .find(|(_, known)| *known == name)
            .map_or(Origin::Default, |(option, _)| option.origin)
    }

    /// Directory that paths in the configuration are relative to, if there is a configuration.
    pub fn directory(&self) -> Option<&Utf8Path> {
        self.file.as_deref().and_then(Utf8Path::parent)
    }

    /// Severities that differ from the defaults of the codes.
    pub fn severities(&self) -> Severities {
        Severities {
            everywhere: self.tables.severity.value.clone(),
            in_files: self.tables.severity_in.value.clone(),
        }
    }

    /// Language of comments in programs.
    pub fn comment_lang(&self) -> Lang {
        match self.general.comment_lang.origin {
            Origin::Default => self.general.lang.value,
            Origin::File(_) | Origin::CommandLine(_) => self.general.comment_lang.value,
        }
    }

    /// Upper bound in mm on pieces of moves for height correction; 0 disables splitting. (book: language/probes)
    pub fn z_split(&self) -> f64 {
        let default = if self.general.z_model.value == ZModel::Idw4 { 0.0 } else { 20.0 };
        self.general.z_split.value.unwrap_or(default)
    }
}

impl Default for Settings {
    fn default() -> Self {
        Options::default().resolve()
    }
}

/// Settings from one source: the configuration or the command line. Keys that the source does not set are `None`.
#[derive(Clone, Debug, Default)]
#[expect(missing_docs, reason = "the tables of the configuration, by name")]
pub struct Options {
    pub general: general::Options,
    pub emit: emit::Options,
    pub limits: limits::Options,
    pub machine: machine::Options,
    /// `[verify]`
    pub verify: verify::Options,
    pub warnings: warnings::Options,
    pub watch: watch::Options,
    pub tables: tables::Options,
}

impl Options {
    /// Reads a parsed configuration. Diagnostics stay in the reader.
    pub(super) fn read(root: &DeTable<'_>, reader: &mut TomlReader<'_>) -> Self {
        reader.table(root, "", |table| {
            let options = Self {
                general: general::Options::read(table),
                emit: table.section("emit", emit::Options::read),
                limits: table.section("limits", limits::Options::read_lowered),
                machine: table.section("machine", machine::Options::read),
                verify: table.section("verify", verify::Options::read),
                warnings: table.section("warnings", warnings::Options::read),
                watch: table.section("watch", watch::Options::read),
                tables: tables::Options::read(table),
            };
            table.refuse("remote");
            options
        })
    }

    /// Merges two sources; these settings take precedence over `below`.
    pub fn over(self, below: Self) -> Self {
        Self {
            general: self.general.over(below.general),
            emit: self.emit.over(below.emit),
            limits: self.limits.over(below.limits),
            machine: self.machine.over(below.machine),
            verify: self.verify.over(below.verify),
            warnings: self.warnings.over(below.warnings),
            watch: self.watch.over(below.watch),
            tables: self.tables.over(below.tables),
        }
    }

    /// Fills in the defaults.
    pub fn resolve(self) -> Settings {
        Settings {
            file: None,
            not_used: None,
            date: None,
            is_unexpected: false,
            confined: None,
            general: self.general.resolve(),
            emit: self.emit.resolve(),
            limits: self.limits.resolve(),
            machine: self.machine.resolve(),
            verify: self.verify.resolve(),
            warnings: self.warnings.resolve(),
            watch: self.watch.resolve(),
            tables: self.tables.resolve(),
        }
    }
}

impl Settings {
    /// Passes each setting that a command's cached results depend on to `add`, with its name. `result_kind` is [`ResultKind::Check`] or
    /// [`ResultKind::Emit`].
    pub fn visit_inputs(&self, result_kind: ResultKind, add: &mut dyn FnMut(&'static str, &dyn Debug)) {
        self.general.visit_inputs(result_kind, add);
        self.emit.visit_inputs(result_kind, add);
        self.limits.visit_inputs(result_kind, add);
        self.machine.visit_inputs(result_kind, add);
        self.verify.visit_inputs(result_kind, add);
        self.warnings.visit_inputs(result_kind, add);
        self.watch.visit_inputs(result_kind, add);
        self.tables.visit_inputs(result_kind, add);
    }
}
