//! Strings, file names and choices.

use std::fmt::Write;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::messages::configuration as messages;
use pathbuild_diagnostic::{Value, nearest, shown};
use serde_json::{Value as Json, json};
use toml::Spanned;
use toml::de::DeValue;

use crate::config::kind::ValueType;
use crate::config::reader::TomlReader;
use crate::config::types::{Choice, Directories};

/// A non-empty string.
pub(in crate::config) const TEXT: ValueType<Box<str>> = ValueType {
    read: |value, reader| match reader.text(value)? {
        "" => reader.expected(Value::Prose(&messages::NOT_EMPTY), value),
        text => Some(text.into()),
    },
    show: |text| Some(quoted(text)),
    schema: || json!({ "type": "string", "minLength": 1 }),
};

/// An optional directory; the empty string means none.
pub(in crate::config) const DIRECTORY: ValueType<Option<Utf8PathBuf>> = ValueType {
    read: |value, reader| match reader.text(value)? {
        "" => Some(None),
        text => reader.path(text, value).map(Some),
    },
    show: |directory| Some(quoted(directory.as_ref().map_or("", |directory| directory.as_str()))),
    schema: || json!({ "type": "string" }),
};

/// A list of directories.
pub(in crate::config) const DIRECTORIES: ValueType<Directories> = ValueType {
    read: |value, reader| {
        let names = texts(value, reader)?;
        Some(names.into_iter().filter_map(|(name, value)| reader.path(name, value)).collect())
    },
    show: |directories| Some(list(directories.iter().map(|directory| directory.as_str()))),
    schema: || json!({ "type": "array", "items": { "type": "string" } }),
};

/// An absolute directory.
pub(in crate::config) const ABSOLUTE: ValueType<Utf8PathBuf> = ValueType {
    read: |value, reader| match reader.text(value).map(Utf8PathBuf::from)? {
        path if path.is_absolute() => Some(path),
        _ => reader.expected(Value::Prose(&messages::ABSOLUTE), value),
    },
    show: |path| Some(quoted(path.as_str())),
    schema: || json!({ "type": "string" }),
};

/// A list of absolute directories.
pub(in crate::config) const ABSOLUTES: ValueType<Directories> = ValueType {
    read: |value, reader| {
        let names = texts(value, reader)?;
        if names.iter().all(|(name, _)| Utf8Path::new(name).is_absolute()) {
            Some(names.into_iter().map(|(name, _)| name.into()).collect())
        } else {
            reader.expected(Value::Prose(&messages::ABSOLUTES), value)
        }
    },
    ..DIRECTORIES
};

/// One of the texts of a choice.
pub(in crate::config) const fn choice<T: Choice>() -> ValueType<T> {
    ValueType { read: read_choice, show: |choice| name_of(*choice).map(quoted), schema: choice_schema::<T> }
}

pub(in crate::config) fn read_choice<T: Choice>(
    value: &Spanned<DeValue<'_>>,
    reader: &mut TomlReader<'_>,
) -> Option<T> {
    let text = reader.text(value)?;
    let choice = T::ALL.iter().find(|(name, _)| *name == text).map(|(_, choice)| *choice);
    if choice.is_none() {
        let names = || T::ALL.iter().map(|(name, _)| *name);
        let fault = match nearest(text, names()) {
            Some(near) => reader.fault(&messages::NEAR_CHOICE, value.span()).quoting("near", near),
            None => reader
                .fault(&messages::INVALID_CHOICE, value.span())
                .with("choices", names().collect::<Value>()),
        };
        reader.report(fault.quoting("found", quoted(text)));
    }
    choice
}

pub(in crate::config) fn choice_schema<T: Choice>() -> Json {
    json!({ "enum": T::ALL.iter().map(|(name, _)| *name).collect::<Vec<_>>() })
}

/// The text of a choice.
pub(in crate::config) fn name_of<T: Choice>(choice: T) -> Option<&'static str> {
    T::ALL.iter().find(|(_, value)| *value == choice).map(|(name, _)| *name)
}

/// The strings in a list, with their values; reports a value of another type.
pub(in crate::config) fn texts<'v, 't>(
    value: &'v Spanned<DeValue<'t>>,
    reader: &mut TomlReader<'_>,
) -> Option<Vec<(&'v str, &'v Spanned<DeValue<'t>>)>> {
    let items = value
        .get_ref()
        .as_array()
        .map(|array| array.iter().map(|item| item.get_ref().as_str().map(|text| (text, item))));
    match items.and_then(Iterator::collect::<Option<Vec<_>>>) {
        Some(texts) => Some(texts),
        None => reader.expected(Value::Prose(&messages::LIST_OF_TEXTS), value),
    }
}

/// Whether a string can be written in single quotes, where nothing is escaped.
pub(in crate::config) fn is_literal(text: &str) -> bool {
    !text.contains('\'') && !text.contains("##") && !text.contains(shown::acts)
}

/// Formats a string as TOML, in single quotes if that avoids escapes. Otherwise uses JSON escapes, which are valid in TOML, except those of
/// characters beyond U+FFFF.
pub(in crate::config) fn quoted(text: &str) -> String {
    if text.contains(['\\', '"']) && is_literal(text) {
        return format!("'{text}'");
    }
    let mut quoted = String::with_capacity(text.len() + 2);
    for character in json!(text).to_string().chars() {
        if character > '\u{ffff}' && shown::acts(character) {
            _ = write!(quoted, "\\U{:08x}", u32::from(character));
        } else {
            quoted.push(character);
        }
    }
    shown::json(&quoted).into_owned()
}

/// Formats strings as a TOML list.
pub(in crate::config) fn list<'a>(texts: impl IntoIterator<Item = &'a str>) -> String {
    format!("[{}]", texts.into_iter().map(quoted).collect::<Vec<_>>().join(", "))
}
