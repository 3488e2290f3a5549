use toml::de::DeTable;

use super::reader::TomlReader;
use super::sections::{emit, general, limits, machine, tables, warnings, watch};
use super::settings::Settings;

/// Settings from one source: the configuration or the command line. Keys that the source does not set are `None`.
#[derive(Clone, Debug, Default)]
#[expect(missing_docs, reason = "the tables of the configuration, by name")]
pub struct Options {
    pub general: general::Options,
    pub emit: emit::Options,
    pub limits: limits::Options,
    pub machine: machine::Options,
    pub warnings: warnings::Options,
    pub watch: watch::Options,
    pub tables: tables::Options,
}

impl Options {
    /// Reads a parsed configuration. Diagnostics stay in the reader.
    pub(super) fn read(root: &DeTable<'_>, reader: &mut TomlReader<'_>) -> Self {
        reader.suggest_tables();
        reader.table(root, "", |table| {
            let options = Self {
                general: general::Options::read(table),
                emit: table.section("emit", emit::Options::read),
                limits: table.section("limits", limits::Options::read_lowered),
                machine: table.section("machine", machine::Options::read),
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
            is_unexpected: false,
            confined: None,
            general: self.general.resolve(),
            emit: self.emit.resolve(),
            limits: self.limits.resolve(),
            machine: self.machine.resolve(),
            warnings: self.warnings.resolve(),
            watch: self.watch.resolve(),
            tables: self.tables.resolve(),
        }
    }
}
