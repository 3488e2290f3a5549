//! Types of configuration tables with user-defined keys.

use camino::Utf8Path;
use std::sync::LazyLock;

use pathbuild_diagnostic::messages::configuration as messages;
use pathbuild_diagnostic::{Code, Severity, nearest};
use pathbuild_path::LineType;
use serde_json::{Value as Json, json};
use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

use super::kinds::{
    COUNT, NOT_NEGATIVE, NUMBER_RANGE, PATTERNS, POSITIVE, REGEX, SPEED, SWITCH, TEXT, choice, choice_schema,
    name_of, quoted, read_choice,
};
use crate::config::reader::{Table, TomlReader, ValueType};
use crate::config::types::{CutterShape, FileSeverities, Level, LineTypeAlias, PostChoice, Tool};
use crate::waivers::{Date, Waiver};
use pathbuild_motion::{Coolant, Turning};
use pathbuild_post::PostMacro;

pub(in crate::config) const LINE_TYPES: ValueType<Vec<LineTypeAlias>> = ValueType {
    read: |value, reader| {
        let entries = own_entries(value, reader)?;
        let mut known: Vec<(String, &str)> = Vec::new();
        for (name, _) in &entries {
            let folded = name.get_ref().trim().to_uppercase();
            match known.iter().find(|(other, _)| *other == folded) {
                Some((_, first)) => {
                    let fault = reader.fault(&messages::SAME_LINE_TYPE, name.span());
                    reader.report(fault.quoting("name", &**name.get_ref()).quoting("first", *first));
                }
                None => known.push((folded, name.get_ref())),
            }
        }
        Some(entries.into_iter().filter_map(|entry| alias(entry, reader)).collect())
    },
    show: |aliases| inline(aliases.iter().map(|alias| (&*alias.name, name_of(alias.line_type).map(quoted)))),
    schema: || json!({ "type": "object", "additionalProperties": choice_schema::<LineType>() }),
};

pub(in crate::config) const SEVERITY: ValueType<Vec<(Code, Level)>> = ValueType {
    read: |value, reader| {
        let entries = own_entries(value, reader)?;
        Some(entries.into_iter().filter_map(|entry| severity(entry, reader)).collect())
    },
    show: |levels| inline(shown_levels(levels)),
    schema: || json!({ "type": "object", "propertyNames": code_schema(), "additionalProperties": choice_schema::<Level>() }),
};

/// A list of tables, each with severity levels for some drawings or programs.
pub(in crate::config) const SEVERITY_IN: ValueType<Vec<FileSeverities>> = ValueType {
    read: |value, reader| {
        let tables =
            value.get_ref().as_array().map(|array| array.iter().map(|item| item.get_ref().as_table()));
        match tables.and_then(Iterator::collect::<Option<Vec<_>>>) {
            Some(tables) => Some(tables.into_iter().map(|table| severities_in(table, reader)).collect()),
            None => reader.report_unexpected(&messages::LIST_OF_TABLES, value),
        }
    },
    show: |parts| {
        let shown = parts.iter().filter_map(|part| {
            let files = ("files".to_owned(), (PATTERNS.show)(&part.files));
            let Waiver { reason, until, .. } = &part.waiver;
            let reason = ("reason".to_owned(), reason.as_deref().map(quoted));
            let until = ("until".to_owned(), until.map(|date| quoted(&date.to_string())));
            inline(std::iter::once(files).chain(shown_levels(&part.levels)).chain([reason, until]))
        });
        let shown: Vec<_> = shown.collect();
        (!shown.is_empty()).then(|| format!("[{}]", shown.join(", ")))
    },
    schema: || {
        json!({ "type": "array", "items": {
            "type": "object",
            "required": ["files"],
            "properties": {
                "files": (PATTERNS.schema)(),
                "reason": (TEXT.schema)(),
                "until": { "type": "string", "format": "date" },
            },
            "propertyNames": { "anyOf": [{ "enum": ["files", "reason", "until"] }, code_schema()] },
            "additionalProperties": choice_schema::<Level>(),
        } })
    },
};

/// The name of a built-in post-processor, or the path of a file that defines one.
const POST_NAME: ValueType<Box<str>> = ValueType {
    read: |value, reader| {
        let name = (TEXT.read)(value, reader)?;
        if is_file_name(&name) {
            reader.path(&name, value)?;
        }
        Some(name)
    },
    ..TEXT
};

/// Whether the user takes responsibility for programs that cannot be read back. An untrusted configuration may not set this.
const UNCHECKED: ValueType<bool> = ValueType {
    read: |value, reader| {
        let is_unchecked = (SWITCH.read)(value, reader)?;
        if is_unchecked && reader.is_untrusted() {
            reader.report(reader.fault(&messages::UNCHECKED_BY_STRANGER, value.span()));
        }
        Some(is_unchecked)
    },
    ..SWITCH
};

pub(in crate::config) const TOOLS: ValueType<Vec<Tool>> = ValueType {
    read: |value, reader| {
        let mut tools: Vec<Tool> = Vec::new();
        let mut entries = own_entries(value, reader)?;
        // The order of the tools in the file decides which one is used and which numbers they get, but the parser sorts them by name.
        entries.sort_by_key(|(name, _)| name.span().start);
        for entry in entries {
            tools.extend(reader.read_within(entry.0.get_ref(), |reader| {
                let tool = tool(entry, reader)?;
                report_shared_number(&tool, entry, &tools, reader);
                Some(tool)
            }));
        }
        Some(tools)
    },
    show: |tools| inline(tools.iter().map(|tool| (&*tool.name, inline_tool(tool)))),
    schema: || {
        json!({ "type": "object", "additionalProperties": {
            "type": "object",
            "required": ["diameter"],
            "additionalProperties": false,
            "properties": {
                "diameter": (POSITIVE.schema)(),
                "paths": (REGEX.schema)(),
                "shape": choice_schema::<CutterShape>(),
                "number": (COUNT.schema)(),
                "spindle": (SPEED.schema)(),
                "direction": choice_schema::<Turning>(),
                "coolant": choice_schema::<Coolant>(),
                "flutes": (COUNT.schema)(),
                "chip-load": (NUMBER_RANGE.schema)(),
                "corner-radius": (NOT_NEGATIVE.schema)(),
                "length": (POSITIVE.schema)(),
            },
        } })
    },
};

/// A post-processor: its name, or a table with further settings.
pub(in crate::config) const POST: ValueType<PostChoice> = ValueType {
    read: |value, reader| {
        let Some(table) = value.get_ref().as_table() else {
            return (POST_NAME.read)(value, reader).map(|name| (&*name).into());
        };
        let prefix = format!("{}.", reader.key());
        Some(reader.table(table, &prefix, |table| PostChoice {
            name: table.take("name", &POST_NAME).map_or_else(|| "native".into(), |value| value.value),
            unchecked: table.take("unchecked", &UNCHECKED).is_some_and(|value| value.value),
            program_number:
                table.take("program-number", &COUNT).and_then(|value| u32::try_from(value.value).ok()),
        }))
    },
    show: |post| match post {
        PostChoice { name, unchecked: false, program_number: None } => Some(quoted(name)),
        PostChoice { name, unchecked, program_number } => inline([
            ("name", Some(quoted(name))),
            ("unchecked", Some(unchecked.to_string())),
            ("program-number", program_number.map(|number| number.to_string())),
        ]),
    },
    schema: || {
        json!({ "oneOf": [(TEXT.schema)(), {
            "type": "object",
            "additionalProperties": false,
            "properties": {
                "name": (TEXT.schema)(),
                "unchecked": (SWITCH.schema)(),
                "program-number": (COUNT.schema)(),
            },
        }] })
    },
};

pub(in crate::config) const MACROS: ValueType<Vec<PostMacro>> = ValueType {
    read: |value, reader| {
        let entries = entries(value, reader)?;
        Some(entries.into_iter().filter_map(|entry| post_macro(entry, reader)).collect())
    },
    show: |macros| {
        inline(macros.iter().map(|post_macro| (&*post_macro.name, Some(quoted(&post_macro.value)))))
    },
    schema: || json!({ "type": "object", "additionalProperties": { "type": "string" } }),
};

type Entry<'v, 't> = (&'v Spanned<DeString<'t>>, &'v Spanned<DeValue<'t>>);

/// Returns the entries of a table; reports a value of another type.
fn entries<'v, 't>(
    value: &'v Spanned<DeValue<'t>>,
    reader: &mut TomlReader<'_>,
) -> Option<Vec<Entry<'v, 't>>> {
    match value.get_ref().as_table() {
        Some(table) => Some(table.iter().collect()),
        None => reader.report_unexpected(&messages::TABLE, value),
    }
}

/// Returns the entries of a table, and reports those that belong before all tables.
fn own_entries<'v, 't>(
    value: &'v Spanned<DeValue<'t>>,
    reader: &mut TomlReader<'_>,
) -> Option<Vec<Entry<'v, 't>>> {
    let mut entries = entries(value, reader)?;
    entries.retain(|(name, _)| !reader.report_key_of_top(name));
    Some(entries)
}

fn alias((name, value): Entry<'_, '_>, reader: &mut TomlReader<'_>) -> Option<LineTypeAlias> {
    let line_type = reader.read_within(name.get_ref(), |reader| read_choice(value, reader))?;
    if is_inherited(name.get_ref()) {
        let fault = reader.fault(&messages::INHERITED_LINE_TYPE, name.span());
        reader.report(fault.quoting("name", &**name.get_ref()));
    }
    Some(LineTypeAlias { name: (**name.get_ref()).into(), line_type })
}

/// Whether the name is `BYLAYER` or `BYBLOCK`: such a line type is inherited and has no meaning of its own.
fn is_inherited(name: &str) -> bool {
    ["BYLAYER", "BYBLOCK"].iter().any(|inherited| name.trim().eq_ignore_ascii_case(inherited))
}

fn post_macro((name, value): Entry<'_, '_>, reader: &mut TomlReader<'_>) -> Option<PostMacro> {
    let text = reader.read_within(name.get_ref(), |reader| reader.text(value))?;
    Some(PostMacro { name: (**name.get_ref()).into(), value: text.into() })
}

fn severity((name, value): Entry<'_, '_>, reader: &mut TomlReader<'_>) -> Option<(Code, Level)> {
    let level = reader.read_within(name.get_ref(), |reader| read_choice(value, reader));
    let text = &**name.get_ref();
    let Ok(code) = text.parse::<Code>() else {
        let fault = match nearest_code(text) {
            Some(near) => reader.fault(&messages::UNKNOWN_CODE, name.span()).quoting("near", near),
            None => reader.fault(&messages::UNLIKE_CODE, name.span()),
        };
        reader.report(fault.quoting("code", text));
        return None;
    };
    let level = level?;
    if code.severity() == Severity::Error && level != Level::Error && !code.can_be_lowered() {
        let fault = reader.fault(&messages::CANNOT_BE_LOWERED, value.span());
        let fault = fault.quoting("code", code.to_string()).quoting("name", code.name());
        reader.report(fault.quoting("level", name_of(level).unwrap_or_default()));
        return None;
    }
    Some((code, level))
}

/// Returns the number or name of a code that is most similar to `name`; the first one if several are equally similar, and `None` if none is similar.
pub fn nearest_code(name: &str) -> Option<String> {
    static CODES: LazyLock<Vec<(String, &str)>> =
        LazyLock::new(|| Code::ALL.iter().map(|code| (code.to_string(), code.name())).collect());
    let names = CODES.iter().flat_map(|(code, name)| [code.as_str(), name]);
    nearest(name, names).map(str::to_owned)
}

fn severities_in(table: &DeTable<'_>, reader: &mut TomlReader<'_>) -> FileSeverities {
    let mut part = FileSeverities::default();
    part.waiver.line = table.keys().map(|name| reader.line(name.span())).min().unwrap_or_default();
    for (name, value) in table {
        match &**name.get_ref() {
            "files" => {
                if value.get_ref().as_array().is_some_and(|globs| globs.is_empty()) {
                    reader.read_within("files", |reader| {
                        reader.report_unexpected::<()>(&messages::GLOBS, value)
                    });
                }
                part.files = (PATTERNS.read)(value, reader).unwrap_or_default();
            }
            "reason" => part.waiver.reason = (TEXT.read)(value, reader),
            "until" => part.waiver.until = date(value, reader),
            _ => part.levels.extend(severity((name, value), reader)),
        }
    }
    if !table.contains_key("files") {
        reader.report_missing("files", table.keys().next().map(Spanned::span).unwrap_or_default());
    }
    part
}

/// Reads a date, from a string or a TOML date.
fn date(value: &Spanned<DeValue<'_>>, reader: &mut TomlReader<'_>) -> Option<Date> {
    let text = match value.get_ref() {
        DeValue::Datetime(date) => Some(date.to_string()),
        other => other.as_str().map(str::to_owned),
    };
    let date = text.and_then(|text| text.parse().ok());
    if date.is_none() {
        return reader.read_within("until", |reader| reader.report_unexpected(&messages::DATE, value));
    }
    date
}

fn tool((name, value): Entry<'_, '_>, reader: &mut TomlReader<'_>) -> Option<Tool> {
    let Some(table) = value.get_ref().as_table() else {
        return reader.report_unexpected(&messages::TABLE, value);
    };
    if !table.contains_key("diameter") {
        reader.report_missing("diameter", name.span());
    }
    let prefix = format!("{}.", reader.key());
    reader.table(table, &prefix, |table| read_tool(name.get_ref(), table))
}

/// Reports PB003 if two different cutters have the same number. A program selects its cutter by the number alone, so the machine would not change
/// the tool.
fn report_shared_number(
    tool: &Tool,
    (_, value): Entry<'_, '_>,
    others: &[Tool],
    reader: &mut TomlReader<'_>,
) {
    let cutter = |tool: &Tool| (tool.diameter, tool.shape, tool.corner_radius);
    let shared = others.iter().find(|other| other.number == tool.number && cutter(other) != cutter(tool));
    let number = value.get_ref().as_table().and_then(|table| table.get("number"));
    if let (Some(other), Some(number)) = (shared, number) {
        let fault =
            reader.read_within("number", |reader| reader.fault(&messages::NUMBER_SHARED, number.span()));
        let fault = fault.with("number", u64::from(tool.number.unwrap_or_default()));
        reader.report(fault.quoting("other", format!("tool.{}", other.name)));
    }
}

/// Reads a tool. A tool without a diameter is dropped, because it fits no path; so is one with an impossible corner radius.
fn read_tool(name: &str, table: &mut Table<'_, '_, '_>) -> Option<Tool> {
    let diameter = table.take("diameter", &POSITIVE).and_then(|value| value.value);
    let paths = table.take("paths", &REGEX).map(|value| value.value);
    let shape =
        table.take("shape", &choice::<CutterShape>()).map_or(CutterShape::EndMill, |value| value.value);
    let number = table.take("number", &COUNT).and_then(|value| u32::try_from(value.value).ok());
    let spindle = table.take("spindle", &SPEED).and_then(|value| value.value);
    let direction = table.take("direction", &choice::<Turning>()).map(|value| value.value);
    let coolant = table.take("coolant", &choice::<Coolant>()).map(|value| value.value);
    let flutes = table.take("flutes", &COUNT).and_then(|value| u32::try_from(value.value).ok());
    let chip_load = table.take("chip-load", &NUMBER_RANGE).and_then(|value| value.value);
    let corner_radius = table.take("corner-radius", &NOT_NEGATIVE).map_or(0.0, |value| value.value);
    let length = table.take("length", &POSITIVE).and_then(|value| value.value);
    if diameter.is_some_and(|diameter| is_too_round(corner_radius, diameter)) {
        table.report_incompatible("corner-radius", &messages::CORNER_RADIUS);
        return None;
    }
    Some(Tool {
        name: name.into(),
        diameter: diameter?,
        paths,
        shape,
        number,
        spindle,
        direction,
        coolant,
        flutes,
        chip_load,
        corner_radius,
        length,
    })
}

/// Whether a corner radius is more than half of the diameter, both in mm.
pub(crate) fn is_too_round(corner_radius: f64, diameter: f64) -> bool {
    /// Rounding error in mm that converting both values from inches may add.
    const ROUNDING_TOLERANCE: f64 = 2e-6;
    2.0 * corner_radius > diameter + ROUNDING_TOLERANCE
}

fn inline_tool(tool: &Tool) -> Option<String> {
    let number = |number: Option<f64>| number.map(|number| number.to_string());
    inline([
        ("diameter", number(Some(tool.diameter))),
        ("paths", tool.paths.as_deref().map(quoted)),
        ("shape", (tool.shape != CutterShape::EndMill).then(|| name_of(tool.shape)).flatten().map(quoted)),
        ("number", tool.number.map(|number| number.to_string())),
        ("spindle", number(tool.spindle)),
        ("direction", tool.direction.and_then(name_of).map(quoted)),
        ("coolant", tool.coolant.and_then(name_of).map(quoted)),
        ("flutes", tool.flutes.map(|flutes| flutes.to_string())),
        ("chip-load", (NUMBER_RANGE.show)(&tool.chip_load)),
        (
            "corner-radius",
            Some(tool.corner_radius).filter(|radius| *radius > 0.0).map(|radius| radius.to_string()),
        ),
        ("length", number(tool.length)),
    ])
}

fn shown_levels(levels: &[(Code, Level)]) -> impl Iterator<Item = (String, Option<String>)> {
    levels.iter().map(|(code, level)| (code.to_string(), name_of(*level).map(quoted)))
}

/// Formats the entries that have values as an inline table; `None` if there are none.
fn inline(entries: impl IntoIterator<Item = (impl AsRef<str>, Option<String>)>) -> Option<String> {
    let entry =
        |(name, value): (_, Option<String>)| Some(format!("{} = {}", key(AsRef::as_ref(&name)), value?));
    let entries = entries.into_iter().filter_map(entry);
    let entries: Vec<_> = entries.collect();
    (!entries.is_empty()).then(|| format!("{{ {} }}", entries.join(", ")))
}

fn key(name: &str) -> String {
    let is_bare =
        !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || matches!(c, '-' | '_'));
    if is_bare { name.to_owned() } else { quoted(name) }
}

fn code_schema() -> Json {
    let codes = Code::ALL.iter().flat_map(|code| [code.to_string(), code.name().to_owned()]);
    json!({ "enum": codes.collect::<Vec<_>>() })
}

/// Whether the name of a post is a file name, which has an extension or a directory.
pub(crate) fn is_file_name(name: &str) -> bool {
    name.contains(std::path::is_separator) || Utf8Path::new(name).extension().is_some()
}
