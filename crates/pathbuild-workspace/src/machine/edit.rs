//! Changes values in the text of a configuration. Comments, order and spelling of everything else remain.

use camino::Utf8Path;
use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::import as say;
use toml_edit::{Array, DocumentMut, Item, Table, Value};

use super::{DescribedValue, Quantity};

/// A value of a description beside that of the configuration.
#[derive(Debug)]
pub struct Change {
    /// Name of the table.
    pub table: String,
    /// Name of the key.
    pub key: &'static str,
    /// Value in the configuration as TOML; `None` if it has none.
    pub old: Option<String>,
    /// Value of the description as TOML.
    pub new: String,
    /// Names of the entries that the value was read from.
    pub source: String,
    /// Whether the values differ.
    pub is_new: bool,
}

/// Puts values into the text of a configuration. Returns the new text, and each value beside the old one.
///
/// # Errors
/// The configuration declares a table in a way that cannot take the values.
pub fn edit(
    file: &Utf8Path,
    text: &str,
    values: &[DescribedValue],
) -> Result<(String, Vec<Change>), Box<Diagnostic>> {
    let fault = || Box::new(Diagnostic::new(&say::NOT_EDITABLE).in_file(file));
    let mut document: DocumentMut = text.parse().map_err(|_| fault())?;
    let mut changes = Vec::new();
    for value in values {
        let table = document.entry("machine").or_insert(Item::Table(Table::new()));
        let table = table.as_table_like_mut().ok_or_else(fault)?;
        let new = toml(&value.value);
        let old = table.get(value.key).and_then(Item::as_value);
        let is_new = old.and_then(quantity).as_ref() != Some(&value.value);
        changes.push(Change {
            table: "machine".to_owned(),
            key: value.key,
            old: old.map(|old| old.clone().decorated("", "").to_string()),
            new: new.to_string(),
            source: value.source.clone(),
            is_new,
        });
        if !is_new {
            continue;
        }
        match table.get_mut(value.key).and_then(Item::as_value_mut) {
            Some(old) => *old = with_decor(new, old),
            None => _ = table.insert(value.key, Item::Value(new)),
        }
    }
    Ok((with_line_ends(document.to_string(), text), changes))
}

/// A value with the spaces and comments around the one that it replaces.
fn with_decor(mut new: Value, old: &Value) -> Value {
    *new.decor_mut() = old.decor().clone();
    new
}

/// The text with the line ends of the old one.
fn with_line_ends(text: String, old: &str) -> String {
    if old.contains("\r\n") { text.replace("\r\n", "\n").replace('\n', "\r\n") } else { text }
}

fn toml(value: &Quantity) -> Value {
    match value {
        Quantity::Number(number) => toml_number(*number),
        Quantity::Numbers(numbers) => {
            Value::Array(numbers.iter().map(|number| toml_number(*number)).collect::<Array>())
        }
    }
}

/// Writes whole numbers as a user would, without decimals.
#[expect(clippy::cast_possible_truncation, reason = "small whole numbers only")]
fn toml_number(number: f64) -> Value {
    const MOST: f64 = 1e15;
    if number.fract() == 0.0 && number.abs() < MOST {
        Value::from(number as i64)
    } else {
        Value::from(number)
    }
}

fn quantity(value: &Value) -> Option<Quantity> {
    let number = |value: &Value| value.as_float().or_else(|| value.as_integer().map(|number| number as f64));
    match value.as_array() {
        Some(array) => array.iter().map(number).collect::<Option<_>>().map(Quantity::Numbers),
        None => number(value).map(Quantity::Number),
    }
}
