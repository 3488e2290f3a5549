use camino::{Utf8Path, Utf8PathBuf};

use pathbuild_db::system::Confined;
use pathbuild_diagnostic::Lang;

use super::origin::Origin;
use super::sections::{emit, general, limits, machine, tables, warnings, watch};
use super::types::{Severities, ZModel};

/// What holds in a run, each value with where it comes from.
#[derive(Clone, Debug)]
#[expect(missing_docs, reason = "the tables of the configuration, by name")]
pub struct Settings {
    /// The configuration that was read; `None`: options and defaults hold, and nothing is cached.
    pub file: Option<Utf8PathBuf>,
    /// That of the working directory, where the arguments lie outside of its tree, and in no other's.
    pub not_used: Option<Utf8PathBuf>,
    /// The repository that nothing leads out of, where it is a stranger's.
    pub confined: Option<Confined>,
    pub general: general::Settings,
    pub emit: emit::Settings,
    pub limits: limits::Settings,
    pub machine: machine::Settings,
    pub warnings: warnings::Settings,
    pub watch: watch::Settings,
    pub tables: tables::Settings,
}

impl Settings {
    /// The directory that names in the configuration are relative to, where there is a configuration.
    pub fn directory(&self) -> Option<&Utf8Path> {
        self.file.as_deref().and_then(Utf8Path::parent)
    }

    /// Severities that differ from the catalogue's.
    pub fn severities(&self) -> Severities {
        Severities {
            everywhere: self.tables.severity.value.clone(),
            in_files: self.tables.severity_in.value.clone(),
        }
    }

    /// The language of comments in programs.
    pub fn comment_lang(&self) -> Lang {
        match self.general.comment_lang.origin {
            Origin::Default => self.general.lang.value,
            Origin::File(_) | Origin::CommandLine(_) => self.general.comment_lang.value,
        }
    }

    /// The longest piece in mm that is corrected as one; 0: moves are never split. (book: language/probes)
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
