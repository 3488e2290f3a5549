//! Changes values in the text of a configuration, and preserves the comments, order and spelling of everything else.

use camino::Utf8Path;
use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::import as say;
use rustc_hash::{FxHashMap, FxHashSet};
use toml_edit::{Array, DocumentMut, Item, Key, Table, TableLike, Value};

use super::{DescribedValue, Quantity, Target};

/// A value that is imported from a description, with the value that the configuration had before.
#[derive(Debug)]
pub struct Change {
    /// Name of the table, with dots.
    pub table: String,
    /// Name of the key in that table.
    pub key: &'static str,
    /// Previous value in the configuration, as TOML; `None` if it had none.
    pub old: Option<String>,
    /// Value from the description, as TOML.
    pub new: String,
    /// Names of the entries that the value was read from.
    pub source: String,
    /// Whether the new value differs from the previous one.
    pub is_new: bool,
}

/// A configuration into which values were inserted.
#[derive(Debug)]
pub struct EditedConfiguration {
    /// The new text.
    pub text: String,
    /// All imported values, including those that the configuration had already.
    pub changes: Vec<Change>,
    /// Warnings about tools that seem to replace others.
    pub problems: Vec<Diagnostic>,
}

/// Inserts values into the text of a configuration.
///
/// # Errors
/// If the text is not valid TOML, or declares a table in a way that cannot take the values.
pub fn edit(
    file: &Utf8Path,
    text: &str,
    values: &[(Target, DescribedValue)],
) -> Result<EditedConfiguration, Box<Diagnostic>> {
    let fault = || Box::new(Diagnostic::new(&say::NOT_EDITABLE).in_file(file));
    let mut document: DocumentMut = text.parse().map_err(|_| fault())?;
    let (mut changes, mut problems) = (Vec::new(), Vec::new());
    // Tools that had no table in the configuration.
    let mut added = FxHashSet::default();
    let mut by_number = tools_by_number(&document);
    for (target, value) in values {
        let path = table_path(&by_number, target);
        let is_added = added.contains(&path);
        if value.is_for_new_tools && !is_added && table(&document, &path).is_some() {
            continue;
        }
        if !is_added && table(&document, &path).is_none() {
            added.insert(path.clone());
        }
        let table = table_mut(&mut document, &path).ok_or_else(fault)?;
        let new = toml_value(&value.value);
        let old = table.get(value.key).and_then(Item::as_value);
        let is_new = old.and_then(quantity).as_ref() != Some(&value.value);
        changes.push(Change {
            table: path.iter().map(|name| Key::new(name).to_string()).collect::<Vec<_>>().join("."),
            key: value.key,
            old: old.map(|old| old.clone().decorated("", "").to_string()),
            new: new.to_string(),
            source: value.source.clone(),
            is_new,
        });
        if !is_new {
            continue;
        }
        if let (Target::Tool { number: Some(number), .. }, "number") = (target, value.key) {
            by_number.entry(i64::from(*number)).or_insert_with(|| path[1].clone());
        }
        problems.extend(replaced_tool(target, value, path.last().map_or("", String::as_str), old));
        match table.get_mut(value.key).and_then(Item::as_value_mut) {
            Some(old) => *old = with_decor_of(new, old),
            None => _ = table.insert(value.key, Item::Value(new)),
        }
    }
    let problems = problems.into_iter().map(|problem: Diagnostic| problem.in_file(file)).collect();
    Ok(EditedConfiguration { text: with_line_ends(document.to_string(), text), changes, problems })
}

/// Returns a warning if a value replaces the diameter in a table that has the tool's number but another name. The machine then has another tool under
/// this number, and the other keys of the table are still those of the former tool.
fn replaced_tool(
    target: &Target,
    value: &DescribedValue,
    table: &str,
    old: Option<&Value>,
) -> Option<Diagnostic> {
    let Target::Tool { number: Some(number), name } = target else { return None };
    let (Some(Quantity::Number(old)), Quantity::Number(new)) = (old.and_then(quantity), &value.value) else {
        return None;
    };
    // A tool without a name in the description is named after its number.
    let is_same = name == table || *name == format!("T{number}");
    let problem = Diagnostic::new(&say::TOOL_REPLACED).quoting("name", &**name).quoting("table", table);
    let problem = problem.with("number", u64::from(*number)).with("new", *new).with("old", old);
    (value.key == "diameter" && !is_same).then_some(problem)
}

/// Returns the path of a target's table: the names of the tables, outermost first. A tool with a number gets the configured table with the same
/// number, whatever its name is.
fn table_path(by_number: &FxHashMap<i64, String>, target: &Target) -> Vec<String> {
    let Target::Tool { number, name } = target else { return vec!["machine".to_owned()] };
    let known = number.and_then(|number| by_number.get(&i64::from(number)));
    vec!["tool".to_owned(), known.unwrap_or(name).clone()]
}

/// Returns the name of the first configured tool with each number.
fn tools_by_number(document: &DocumentMut) -> FxHashMap<i64, String> {
    let mut by_number = FxHashMap::default();
    for (name, tool) in document.get("tool").and_then(Item::as_table_like).into_iter().flat_map(|t| t.iter())
    {
        if let Some(number) = tool.get("number").and_then(Item::as_integer) {
            by_number.entry(number).or_insert_with(|| name.to_owned());
        }
    }
    by_number
}

fn table<'d>(document: &'d DocumentMut, path: &[String]) -> Option<&'d Item> {
    path.iter().try_fold(document.as_item(), |item, name| item.get(name))
}

/// Returns the table of this path, and adds it if it is missing; `None` if a part of the path is not a table.
fn table_mut<'d>(document: &'d mut DocumentMut, path: &[String]) -> Option<&'d mut dyn TableLike> {
    let mut table: &mut dyn TableLike = document.as_table_mut();
    for (depth, name) in path.iter().enumerate() {
        let is_last = depth + 1 == path.len();
        let mut new = Table::new();
        new.set_implicit(!is_last);
        table = table.entry(name).or_insert(Item::Table(new)).as_table_like_mut()?;
    }
    Some(table)
}

/// Gives a new value the whitespace and comments of the value that it replaces, including those between the numbers of a list.
fn with_decor_of(mut new: Value, old: &Value) -> Value {
    match (&new, old) {
        (Value::Array(numbers), Value::Array(old)) if numbers.len() == old.len() => {
            let mut kept = old.clone();
            for (slot, number) in kept.iter_mut().zip(numbers) {
                *slot = with_decor_of(number.clone(), slot);
            }
            Value::Array(kept)
        }
        _ => {
            *new.decor_mut() = old.decor().clone();
            new
        }
    }
}

fn with_line_ends(text: String, old: &str) -> String {
    if old.contains("\r\n") { text.replace("\r\n", "\n").replace('\n', "\r\n") } else { text }
}

fn toml_value(value: &Quantity) -> Value {
    match value {
        Quantity::Number(number) => toml_number(*number),
        Quantity::Text(text) => Value::from(text.as_str()),
        Quantity::Numbers(numbers) => {
            Value::Array(numbers.iter().map(|number| toml_number(*number)).collect::<Array>())
        }
    }
}

/// Converts a number to TOML, as a user would write it: whole numbers without decimals.
#[expect(clippy::cast_possible_truncation, reason = "small whole numbers only")]
fn toml_number(number: f64) -> Value {
    const MAX_INTEGER: f64 = 1e15;
    if number.fract() == 0.0 && number.abs() < MAX_INTEGER {
        Value::from(number as i64)
    } else {
        Value::from(number)
    }
}

fn quantity(value: &Value) -> Option<Quantity> {
    let number = |value: &Value| value.as_float().or_else(|| value.as_integer().map(|number| number as f64));
    if let Some(text) = value.as_str() {
        return Some(Quantity::Text(text.to_owned()));
    }
    match value.as_array() {
        Some(array) => array.iter().map(number).collect::<Option<_>>().map(Quantity::Numbers),
        None => number(value).map(Quantity::Number),
    }
}
