use serde_json::Value as Json;
use toml::Spanned;
use toml::de::DeValue;

use super::reader::TomlReader;

/// Type of a value: how to read it from TOML, to format it as TOML, and to describe it in the JSON schema.
pub(super) struct ValueType<T> {
    /// Reads a value, or reports why it is invalid.
    pub(super) read: fn(&Spanned<DeValue<'_>>, &mut TomlReader<'_>) -> Option<T>,
    /// Formats the value as TOML; `None` if there is nothing to show.
    pub(super) show: fn(&T) -> Option<String>,
    /// The type's JSON schema.
    pub(super) schema: fn() -> Json,
}

/// Facts about a key that do not depend on its type.
pub(super) struct Key {
    /// Name within its table.
    pub(super) name: &'static str,
    /// Description, in one or more lines.
    pub(super) meaning: &'static [&'static str],
    /// A value as TOML: the default, or an example if there is no default.
    pub(super) example: &'static str,
    /// JSON schema of its value.
    pub(super) schema: fn() -> Json,
}
