use serde_json::Value as Json;
use toml::Spanned;
use toml::de::DeValue;

use super::reader::TomlReader;

/// A type of values: how one is read from TOML, shown as TOML, and described in the JSON schema.
pub(super) struct ValueType<T> {
    /// Reads a value, or reports why it is none.
    pub(super) read: fn(&Spanned<DeValue<'_>>, &mut TomlReader<'_>) -> Option<T>,
    /// The value as TOML; `None` when there is none to show.
    pub(super) show: fn(&T) -> Option<String>,
    /// The type in the schema.
    pub(super) schema: fn() -> Json,
}

/// What is known of a key without its type.
pub(super) struct Key {
    /// The name within its table.
    pub(super) name: &'static str,
    /// What it means, one line or several.
    pub(super) meaning: &'static [&'static str],
    /// A value as TOML: the default, or an example where there is none.
    pub(super) example: &'static str,
    /// The type in the schema.
    pub(super) schema: fn() -> Json,
}
