//! The settings of a run, each with its source, and which cached results depend on them.

use std::fmt::Debug;
use std::sync::Arc;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::System;
use pathbuild_db::system::ConfinedSystem;
use pathbuild_diagnostic::{Diagnostic, Lang};
use pathbuild_toolpath::ZModel;
use toml::de::DeTable;

use super::origin::{Key, Origin, ResultKind, ShownSetting};
use super::reader::TomlReader;
use super::sections::{emit, general, limits, machine, tables, verify, warnings, watch};
use crate::waivers::RunDate;

/// A table of the configuration.
pub(super) struct TableEntry {
    /// Name of its module in [`sections`](super::sections).
    pub(super) name: &'static str,
    /// Its header; empty if its keys come before all headers, or are tables with headers of their own.
    pub(super) header: &'static str,
    pub(super) keys: &'static [Key],
    pub(super) shown: fn(&Settings) -> Vec<ShownSetting>,
}

/// Declares the tables of the configuration, each with its header and the function that reads it. Keys of a table without a header come
/// before all headers.
macro_rules! tables {
    ($($table:ident $header:literal $read:ident;)*) => {
        /// The settings of a run, each with its source.
        #[derive(Clone, Debug)]
        #[expect(missing_docs, reason = "the tables of the configuration, by name")]
        pub struct Settings {
            /// The configuration that was read. If `None`, only options and defaults apply, and nothing is cached.
            pub file: Option<Utf8PathBuf>,
            /// The working directory's configuration, if it is ignored because the arguments are outside its tree and no other configuration applies
            /// to them.
            pub not_used: Option<Utf8PathBuf>,
            /// A file with a name like that of a configuration, where one is searched, if there is no configuration.
            pub misnamed: Option<Utf8PathBuf>,
            /// Whether `file` applies to a program unexpectedly: the working directory has another configuration, or the program lies outside the
            /// tree of this configuration.
            pub is_unexpected: bool,
            /// The repositories that an untrusted run must not leave; `None` if the run is trusted.
            pub confined: Option<ConfinedSystem>,
            /// The date that waivers are compared with; without one, waivers with a date do not hold. No cached result depends on it.
            pub date: Option<RunDate>,
            $(pub $table: $table::Settings,)*
        }

        /// Values from the configuration and, once they are applied, from the options of the command line. Keys that neither the configuration nor an
        /// option sets are `None`.
        #[derive(Clone, Debug, Default)]
        #[expect(missing_docs, reason = "the tables of the configuration, by name")]
        pub struct Options {
            $(pub $table: $table::Options,)*
        }

        impl Options {
            /// Reads a parsed configuration. Diagnostics are collected in the reader.
            pub(super) fn read(root: &DeTable<'_>, reader: &mut TomlReader<'_>) -> Self {
                reader.table(root, "", |table| {
                    let options = Self { $($table: table.section($header, $table::Options::$read),)* };
                    table.refuse_reserved("remote");
                    options
                })
            }

            /// Fills in the defaults of keys that are not set.
            pub fn resolve(self) -> Settings {
                Settings {
                    file: None,
                    not_used: None,
                    misnamed: None,
                    date: None,
                    is_unexpected: false,
                    confined: None,
                    $($table: self.$table.resolve(),)*
                }
            }
        }

        impl Settings {
            /// Passes to `add` the name and value of each setting on which the cached results of a command depend. `result_kind` is
            /// [`ResultKind::Check`] or [`ResultKind::Emit`].
            pub fn visit_inputs(&self, result_kind: ResultKind, add: &mut dyn FnMut(&'static str, &dyn Debug)) {
                $(self.$table.visit_inputs(result_kind, add);)*
            }
        }

        pub(super) const TABLES: &[TableEntry] =
            &[$(TableEntry {
                name: stringify!($table),
                header: $header,
                keys: $table::KEYS,
                shown: |settings| settings.$table.shown(),
            },)*];
    };
}

tables! {
    general "" read;
    emit "emit" read;
    limits "limits" read_lowered;
    machine "machine" read;
    verify "verify" read;
    warnings "warnings" read;
    watch "watch" read;
    tables "" read;
}

impl Settings {
    /// Wraps a system so that the run accesses only the files that its configuration may refer to; returns it unchanged if the run is trusted.
    pub fn confine(&self, system: Arc<dyn System>) -> Arc<dyn System> {
        self.confined.clone().map_or(system, |confined| Arc::new(confined))
    }

    /// Returns the source of the value of a key outside any table.
    pub fn origin_of_option(&self, name: &str) -> Origin {
        let mut options = self.general.shown().into_iter();
        options.find(|option| option.name == name).map_or(Origin::Default, |option| option.origin)
    }

    /// Adds the configuration's file and line to a diagnostic if the configuration sets the value with this origin.
    pub(crate) fn locate(&self, problem: Diagnostic, origin: Origin) -> Diagnostic {
        match (&self.file, origin.line()) {
            (Some(file), Some(line)) => problem.in_file(file).at_line(line, None),
            _ => problem,
        }
    }

    /// Returns the directory that paths in the configuration are relative to; `None` without a configuration.
    pub fn directory(&self) -> Option<&Utf8Path> {
        self.file.as_deref().and_then(Utf8Path::parent)
    }

    /// Returns the language of comments in programs.
    pub fn comment_lang(&self) -> Lang {
        match self.general.comment_lang.origin {
            Origin::Default => self.general.lang.value,
            _ => self.general.comment_lang.value,
        }
    }

    /// Returns the upper bound in mm on the length of the pieces into which moves are split for height correction; 0 disables splitting. (book:
    /// language/probes)
    pub fn z_split(&self) -> f64 {
        let default = if self.general.z_model.value == ZModel::Idw4 { 0.0 } else { general::Z_SPLIT };
        self.general.z_split.value.unwrap_or(default)
    }
}

impl Default for Settings {
    fn default() -> Self {
        Options::default().resolve()
    }
}
