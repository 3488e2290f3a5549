//! Descriptions of the configuration: `config show`, the JSON schema, and the file that `init` writes.

use std::fmt::Write;

use pathbuild_diagnostic::escaping;
use serde_json::{Map, Value as Json, json};

use super::origin::{Key, ShownSetting};
use super::sections::{general, tables};
use super::settings::{Settings, TABLES, TableEntry};

/// Formats the settings as TOML, optionally with their sources as comments.
pub fn show(settings: &Settings, with_origin: bool) -> String {
    let mut text = match &settings.file {
        Some(file) => format!("# {}\n", escaping::line(file.as_str())),
        None => "# no pathbuild.toml\n".to_owned(),
    };
    for table in without_header() {
        write(&mut text, (table.shown)(settings), with_origin);
    }
    for table in with_header() {
        _ = write!(text, "\n[{}]\n", table.header);
        write(&mut text, (table.shown)(settings), with_origin);
    }
    text
}

/// Returns the tables without a header. Their keys come first in the file.
fn without_header() -> impl Iterator<Item = &'static TableEntry> {
    TABLES.iter().filter(|table| table.header.is_empty())
}

fn with_header() -> impl Iterator<Item = &'static TableEntry> {
    TABLES.iter().filter(|table| !table.header.is_empty())
}

/// Lists all keys of the configuration with their values, each with the header of its table, which is empty for keys before the first table.
pub fn settings(settings: &Settings) -> impl Iterator<Item = (&'static str, ShownSetting)> {
    let all = without_header().chain(with_header());
    all.flat_map(|table| (table.shown)(settings).into_iter().map(|setting| (table.header, setting)))
}

fn write(text: &mut String, entries: Vec<ShownSetting>, with_origin: bool) {
    for ShownSetting { name, value, origin } in entries {
        let line = value.map_or_else(|| format!("# {name} is not set"), |value| format!("{name} = {value}"));
        let origin =
            if with_origin && !line.starts_with('#') { format!("  # {origin}") } else { String::new() };
        _ = writeln!(text, "{line}{origin}");
    }
}

/// Returns the JSON schema (draft 2020-12) of `pathbuild.toml`.
pub fn schema() -> Json {
    let mut root: Map<String, Json> = without_header().flat_map(|table| properties(table.keys)).collect();
    root.extend(with_header().map(|table| (table.header.to_owned(), object(&properties(table.keys)))));
    let mut schema = object(&root);
    schema["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    schema["title"] = json!("pathbuild.toml");
    schema
}

fn object(properties: &Map<String, Json>) -> Json {
    json!({ "type": "object", "additionalProperties": false, "properties": properties })
}

fn properties(keys: &[Key]) -> Map<String, Json> {
    keys.iter().map(property).collect()
}

fn property(key: &Key) -> (String, Json) {
    let mut schema = (key.schema)();
    let meaning: Vec<&str> = key.meaning.iter().map(|line| line.trim()).collect();
    schema["description"] = json!(meaning.join(" "));
    (key.name.to_owned(), schema)
}

/// Returns the text of a configuration with every key, its description, and its default or an example. All keys but `library` are commented out.
pub fn template() -> String {
    let mut text = TEMPLATE_HEADER.to_owned();
    for key in general::KEYS {
        entry(&mut text, key, if key.name == "library" { "" } else { "#" });
    }
    for key in tables::KEYS {
        table(&mut text, key);
    }
    for section in with_header() {
        _ = write!(text, "\n[{}]\n", section.header);
        for key in section.keys {
            entry(&mut text, key, "#");
        }
    }
    text
}

const TEMPLATE_HEADER: &str = "\
# Configuration of pathbuild. File names are relative to this file. Command-line options take precedence over it; --search and --restrict add to it.
# Lines that begin with # and no blank are the defaults, or examples if there is no default: remove the # and change them.
# `pathbuild config show` prints the values in force.

";

fn entry(text: &mut String, key: &Key, mark: &str) {
    let line = format!("{mark}{} = {}", key.name, key.example);
    let [first, further @ ..] = key.meaning else { return };
    _ = writeln!(text, "{line:<28} #{first}");
    for meaning in further {
        _ = writeln!(text, "{:<28} #{meaning}", "");
    }
}

fn table(text: &mut String, key: &Key) {
    text.push('\n');
    for meaning in key.meaning {
        _ = writeln!(text, "#{meaning}");
    }
    for line in key.example.lines() {
        _ = writeln!(text, "#{line}");
    }
}

/// Returns the German descriptions of the keys of a section, which is named like its module: name, meaning and default of each key.
pub fn german_rows(section: &str) -> Vec<[String; 3]> {
    let Some(table) = TABLES.iter().find(|table| table.name == section) else { return Vec::new() };
    let defaults = (table.shown)(&Settings::default());
    table.keys.iter().zip(defaults).map(|(key, default)| german_row(key, default.value.as_deref())).collect()
}

fn german_row(key: &Key, default: Option<&str>) -> [String; 3] {
    let shown = match default {
        None => "",
        Some("[]") => "keine",
        Some(_) => key.example,
    };
    let (meaning, default) = key.german.split_once(" | ").unwrap_or((key.german, shown));
    let name = key.example.split_once('\n').map_or(key.name, |(header, _)| header);
    [format!("`{name}`"), meaning.to_owned(), default.to_owned()]
}
