//! The value of a setting with its source, and facts about its key.

use std::fmt::{self, Debug};

use serde_json::Value as Json;

/// Source of a setting's value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// The built-in default: nothing sets the value.
    Default,
    /// A line of the configuration, counted from 1.
    File(u32),
    /// The command-line option of this name, without hyphens.
    CommandLine(&'static str),
    /// The configuration, and an option that adds items to its list.
    Extended {
        /// Line of the configuration, counted from 1.
        line: u32,
        /// Number of items from the configuration; those of the option follow.
        configured: usize,
        /// Name of the option, without hyphens.
        option: &'static str,
    },
}

impl Origin {
    /// Returns the line of the configuration, if the value, or a part of it, comes from the configuration.
    pub fn line(self) -> Option<u32> {
        match self {
            Self::File(line) | Self::Extended { line, .. } => Some(line),
            Self::Default | Self::CommandLine(_) => None,
        }
    }

    /// Returns the source of an item of a list, by the index of the item.
    pub fn of_item(self, index: usize) -> Self {
        match self {
            Self::Extended { line, configured, .. } if index < configured => Self::File(line),
            Self::Extended { option, .. } => Self::CommandLine(option),
            whole => whole,
        }
    }
}

/// A value with its source.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SourcedValue<T> {
    /// The value itself.
    pub value: T,
    /// The source that set the value.
    pub origin: Origin,
}

impl<T> SourcedValue<T> {
    /// Wraps a default value.
    pub fn default(value: T) -> Self {
        Self { value, origin: Origin::Default }
    }

    /// Wraps the value of the command-line option `name`.
    pub fn option(name: &'static str, value: T) -> Self {
        Self { value, origin: Origin::CommandLine(name) }
    }
}

impl<T> SourcedValue<Vec<T>> {
    pub(super) fn extend(&mut self, name: &'static str, items: Vec<T>) {
        self.origin = match self.origin {
            Origin::File(line) => Origin::Extended { line, configured: self.value.len(), option: name },
            _ => Origin::CommandLine(name),
        };
        self.value.extend(items);
    }
}

impl fmt::Display for Origin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Default => f.write_str("default"),
            Self::File(line) => write!(f, "line {line}"),
            Self::CommandLine(name) => write!(f, "--{name}"),
            Self::Extended { line, option, .. } => write!(f, "line {line}, --{option}"),
        }
    }
}

/// The commands with cached results that depend on a setting.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ResultKind {
    /// The results of `check`, and therefore also those of `emit`, depend on the setting.
    Check,
    /// Only the results of `emit` depend on the setting.
    Emit,
    /// No cached result depends on the setting: it changes only what is requested or how it is reported.
    Neither,
}

impl ResultKind {
    /// Whether the cached results of the command `result_kind` depend on this setting.
    pub(in crate::config) fn is_part_of(self, result_kind: Self) -> bool {
        self != Self::Neither && self <= result_kind
    }
}

/// The properties of a key that do not depend on its type.
pub(super) struct Key {
    /// Name within its table.
    pub(super) name: &'static str,
    /// Description of the key, in one or more lines.
    pub(super) meaning: &'static [&'static str],
    /// Description in German, with the default in words behind ` | ` if the book cannot show the value.
    pub(super) german: &'static str,
    /// A value as TOML: the default, or an example if there is no default.
    pub(super) example: &'static str,
    pub(super) schema: fn() -> Json,
}

/// A configuration key with its value.
#[derive(Clone, Debug)]
pub struct ShownSetting {
    /// Name of the key within its table.
    pub name: &'static str,
    /// The value as TOML; `None` if not set.
    pub value: Option<String>,
    /// Source of the value.
    pub origin: Origin,
}
