//! Numbers, sizes and times.

use std::time::Duration;

use pathbuild_diagnostic::Value;
use pathbuild_diagnostic::messages::configuration as messages;
use serde_json::json;
use toml::Spanned;
use toml::de::DeValue;

use crate::config::kind::ValueType;
use crate::config::reader::TomlReader;
use crate::config::types::Extent;

/// An optional number greater than 0.
pub(in crate::config) const POSITIVE: ValueType<Option<f64>> = ValueType {
    read: |value, reader| match number(value).filter(|number| *number > 0.0) {
        Some(number) => Some(Some(number)),
        None => reader.expected(Value::Prose(&messages::POSITIVE), value),
    },
    show: |number| number.map(|number| number.to_string()),
    schema: || json!({ "type": "number", "exclusiveMinimum": 0 }),
};

/// A time in seconds greater than 0.
pub(in crate::config) const SECONDS: ValueType<Duration> = ValueType {
    read: |value, reader| match number(value).and_then(|number| Duration::try_from_secs_f64(number).ok()) {
        Some(time) if !time.is_zero() => Some(time),
        _ => reader.expected(Value::Prose(&messages::POSITIVE), value),
    },
    show: |time| Some(time.as_secs_f64().to_string()),
    schema: || json!({ "type": "number", "exclusiveMinimum": 0 }),
};

/// A number of at least 0.
pub(in crate::config) const NOT_NEGATIVE: ValueType<f64> = ValueType {
    read: |value, reader| match number(value).filter(|number| *number >= 0.0) {
        Some(number) => Some(number),
        None => reader.expected(Value::Prose(&messages::NOT_NEGATIVE), value),
    },
    show: |number| Some(number.to_string()),
    schema: || json!({ "type": "number", "minimum": 0 }),
};

/// Optional upper bound on the length of pieces of moves in mm; 0 means any length. Pieces that a machine cannot distinguish would only
/// fill the disk.
pub(in crate::config) const PIECE: ValueType<Option<f64>> = ValueType {
    read: |value, reader| match number(value).filter(|number| *number == 0.0 || *number >= SHORTEST_PIECE) {
        Some(number) => Some(Some(number)),
        None => reader.expected(Value::Prose(&messages::PIECE), value),
    },
    show: |number| number.map(|number| number.to_string()),
    schema: || json!({ "oneOf": [{ "const": 0 }, { "type": "number", "minimum": SHORTEST_PIECE }] }),
};

/// Lower bound on that length in mm.
const SHORTEST_PIECE: f64 = 0.1;

/// A positive whole number.
pub(in crate::config) const COUNT: ValueType<u64> = ValueType {
    read: |value, reader| match whole_number(value).filter(|count| *count > 0) {
        Some(count) => Some(count),
        None => reader.expected(Value::Prose(&messages::COUNT), value),
    },
    show: |count| Some(count.to_string()),
    schema: || json!({ "type": "integer", "minimum": 1 }),
};

/// A size in bytes: a whole number, or a text such as "256 MiB".
pub(in crate::config) const SIZE: ValueType<u64> = ValueType {
    read: |value, reader| match size(value).filter(|size| *size > 0) {
        Some(size) => Some(size),
        None => reader.expected(Value::Prose(&messages::SIZE), value),
    },
    show: |size| Some(shown_size(*size)),
    schema: || json!({ "oneOf": [{ "type": "integer", "minimum": 1 }, { "type": "string", "pattern": SIZE_PATTERN }] }),
};

/// A duration, written as a text such as "50 ms".
pub(in crate::config) const DURATION: ValueType<Duration> = ValueType {
    read: |value, reader| match value.get_ref().as_str().and_then(duration) {
        Some(duration) => Some(duration),
        None => reader.expected(Value::Prose(&messages::DURATION), value),
    },
    show: |duration| Some(format!("\"{} ms\"", duration.as_millis())),
    schema: || json!({ "type": "string", "pattern": "^[0-9]+ ?(ms|s|min)$" }),
};

/// Two numbers, the smaller one first.
pub(in crate::config) const EXTENT: ValueType<Option<Extent>> = ValueType {
    read: |value, reader| match extent(value) {
        Some(extent) => Some(Some(extent)),
        None => reader.expected(Value::Prose(&messages::EXTENT), value),
    },
    show: |extent| extent.map(|extent| format!("[{}, {}]", extent.from, extent.to)),
    schema: || json!({ "type": "array", "items": { "type": "number" }, "minItems": 2, "maxItems": 2 }),
};

/// A positive number for each of X, Y and Z.
pub(in crate::config) const AXES: ValueType<Option<[f64; 3]>> = ValueType {
    read: |value, reader| match axes(value) {
        Some(axes) => Some(Some(axes)),
        None => reader.expected(Value::Prose(&messages::AXES), value),
    },
    show: |axes| axes.map(|[x, y, z]| format!("[{x}, {y}, {z}]")),
    schema: || json!({ "type": "array", "items": { "type": "number", "exclusiveMinimum": 0 }, "minItems": 3, "maxItems": 3 }),
};

/// A boolean.
pub(in crate::config) const SWITCH: ValueType<bool> =
    ValueType { read: switch, show: |on| Some(on.to_string()), schema: || json!({ "type": "boolean" }) };

fn switch(value: &Spanned<DeValue<'_>>, reader: &mut TomlReader<'_>) -> Option<bool> {
    value.get_ref().as_bool().or_else(|| reader.expected(Value::Prose(&messages::SWITCH), value))
}

/// Parses a number as written in drawings: an optional sign, digits, at most one decimal point or comma. (book: language/letters)
pub(in crate::config) fn number_from_text(text: &str) -> Option<f64> {
    let digits = text.strip_prefix(['+', '-']).unwrap_or(text);
    let is_number = digits.contains(|c: char| c.is_ascii_digit())
        && digits.chars().all(|c| c.is_ascii_digit() || matches!(c, '.' | ','))
        && digits.matches(['.', ',']).count() <= 1;
    is_number.then(|| text.replace(',', ".").parse().ok()).flatten().filter(|number: &f64| number.is_finite())
}

fn number(value: &Spanned<DeValue<'_>>) -> Option<f64> {
    let value = value.get_ref();
    let text = match value.as_float() {
        Some(float) => float.as_str(),
        None => value.as_integer().filter(|integer| integer.radix() == 10)?.as_str(),
    };
    text.replace('_', "").parse().ok().filter(|number: &f64| number.is_finite())
}

fn whole_number(value: &Spanned<DeValue<'_>>) -> Option<u64> {
    let integer = value.get_ref().as_integer()?;
    u64::from_str_radix(&integer.as_str().replace('_', ""), integer.radix()).ok()
}

fn extent(value: &Spanned<DeValue<'_>>) -> Option<Extent> {
    let array = value.get_ref().as_array()?;
    match (array.len(), array.first().and_then(number), array.get(1).and_then(number)) {
        (2, Some(from), Some(to)) if from < to => Some(Extent { from, to }),
        _ => None,
    }
}

fn axes(value: &Spanned<DeValue<'_>>) -> Option<[f64; 3]> {
    let array = value.get_ref().as_array()?;
    let numbers: Option<Vec<f64>> =
        array.iter().map(|item| number(item).filter(|number| *number > 0.0)).collect();
    numbers?.try_into().ok()
}

const SIZE_PATTERN: &str = "^[0-9]+ ?(B|kB|KiB|MB|MiB|GB|GiB)$";
const UNITS: &[(&str, u64)] = &[
    ("GiB", 1 << 30),
    ("MiB", 1 << 20),
    ("KiB", 1 << 10),
    ("GB", 1_000_000_000),
    ("MB", 1_000_000),
    ("kB", 1000),
    ("B", 1),
];

fn size(value: &Spanned<DeValue<'_>>) -> Option<u64> {
    let Some(text) = value.get_ref().as_str() else { return whole_number(value) };
    let (digits, unit) = digits_and_unit(text)?;
    let factor = UNITS.iter().find(|(name, _)| *name == unit).map(|(_, factor)| *factor)?;
    digits.checked_mul(factor)
}

fn shown_size(size: u64) -> String {
    let is_whole = |(_, factor): &&(&str, u64)| size.is_multiple_of(*factor);
    match UNITS.iter().filter(|(name, _)| name.ends_with("iB")).find(is_whole) {
        Some((unit, factor)) => format!("\"{} {unit}\"", size / factor),
        None => size.to_string(),
    }
}

fn duration(text: &str) -> Option<Duration> {
    let (count, unit) = digits_and_unit(text)?;
    match unit {
        "ms" => Some(Duration::from_millis(count)),
        "s" => Some(Duration::from_secs(count)),
        "min" => Some(Duration::from_secs(count.checked_mul(60)?)),
        _ => None,
    }
}

/// Splits `256 MiB` into 256 and `MiB`.
fn digits_and_unit(text: &str) -> Option<(u64, &str)> {
    let (digits, unit) = text.split_at(text.find(|c: char| !c.is_ascii_digit())?);
    Some((digits.parse().ok()?, unit.strip_prefix(' ').unwrap_or(unit)))
}
