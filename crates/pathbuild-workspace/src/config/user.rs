//! The user's own configuration, `config.toml`: settings that no repository may decide. (book: reference/configuration)

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::System;
use pathbuild_diagnostic::messages::configuration as messages;
use pathbuild_diagnostic::{Diagnostic, Lang};
use toml::de::DeTable;

use super::kinds::text::{ABSOLUTE, ABSOLUTES, choice};
use super::load::{LARGEST, read_table};
use super::reader::TomlReader;
use super::types::Directories;
use crate::files;

/// Settings of the user for all trees.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct User {
    /// `lang`: language of messages. Programs are written in the language that their tree configures.
    pub lang: Option<Lang>,
    /// `[cache] dir`: where results are cached, in a subdirectory for each tree.
    pub cache_dir: Option<Utf8PathBuf>,
    /// `[trust] roots`: trees elsewhere are treated as with `--untrusted`.
    pub trusted: Option<Directories>,
}

impl User {
    /// Reads the file if it exists, and returns all its diagnostics.
    pub fn load(system: &dyn System, file: &Utf8Path) -> (Self, Vec<Diagnostic>) {
        if !files::is_named(file) {
            return (Self::default(), Vec::new());
        }
        match files::read(system, file, LARGEST) {
            Ok(text) => read_table(file, &text, None, Self::read),
            Err(reason) => {
                let fault = Diagnostic::new(&messages::CONFIGURATION_UNREADABLE).in_file(file);
                (Self::default(), vec![fault.with("reason", reason)])
            }
        }
    }

    fn read(root: &DeTable<'_>, reader: &mut TomlReader<'_>) -> Self {
        reader.table(root, "", |table| Self {
            lang: table.take("lang", &choice()).map(|lang| lang.value),
            cache_dir: table.section("cache", |cache| cache.take("dir", &ABSOLUTE)).map(|value| value.value),
            trusted: table.section("trust", |trust| trust.take("roots", &ABSOLUTES)).map(|value| value.value),
        })
    }
}
