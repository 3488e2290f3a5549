use camino::{Utf8Path, Utf8PathBuf};

use pathbuild_db::system::ConfinedSystem;
use pathbuild_diagnostic::Lang;

use super::origin::Origin;
use super::sections::{emit, general, limits, machine, tables, warnings, watch};
use super::types::{Severities, ZModel};

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
    pub general: general::Settings,
    pub emit: emit::Settings,
    pub limits: limits::Settings,
    pub machine: machine::Settings,
    pub warnings: warnings::Settings,
    pub watch: watch::Settings,
    pub tables: tables::Settings,
}

impl Settings {
    /// Where the value of an option comes from that holds where drawings say nothing: `feed`, `sweep-height` or `probe-feed`.
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
        super::Options::default().resolve()
    }
}
