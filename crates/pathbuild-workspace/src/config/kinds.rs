//! Types of configuration values: numbers, sizes, times, texts, choices and patterns.

use std::fmt::Write;
use std::ops::{Range, RangeInclusive};
use std::time::Duration;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::messages::configuration as messages;
use pathbuild_diagnostic::{Value, escaping, nearest};
use pathbuild_path::{has_thousands, regex_reason};
use regex::RegexBuilder;
use serde_json::{Value as Json, json};
use toml::Spanned;
use toml::de::DeValue;

use crate::config::reader::{LimitedKind, TomlReader, ValueType};
use crate::config::types::{Choice, Directories, NumberRange, Pattern, Restriction};

/// An optional number greater than 0.
pub(in crate::config) const POSITIVE: ValueType<Option<f64>> = ValueType {
    read: |value, reader| {
        reader.require(number(value).filter(|number| *number > 0.0), &messages::POSITIVE, value).map(Some)
    },
    show: |number| number.map(|number| number.to_string()),
    schema: || json!({ "type": "number", "exclusiveMinimum": 0 }),
};

/// A speed in mm/min or 1/min. A slow one with three decimals was probably meant as thousands: TOML reads 12.000 as 12.
pub(in crate::config) const SPEED: ValueType<Option<f64>> = ValueType {
    read: |value, reader| {
        let speed = (MEASURE.read)(value, reader)?;
        let is_grouped = |speed| has_thousands(written_number(value).unwrap_or_default(), speed);
        reader.require((!speed.is_some_and(is_grouped)).then_some(speed), &messages::SPEED, value)
    },
    show: MEASURE.show,
    schema: MEASURE.schema,
};

/// A length in mm that programs state with three decimals.
pub(in crate::config) const MEASURE: ValueType<Option<f64>> = ValueType {
    read: |value, reader| {
        let measure = number(value).filter(|number| MEASURE_BOUNDS.contains(number));
        reader.require(measure, &messages::MEASURE, value).map(Some)
    },
    show: |number| number.map(|number| number.to_string()),
    schema: || json!({ "type": "number", "minimum": MEASURE_BOUNDS.start(), "maximum": MEASURE_BOUNDS.end() }),
};

/// Bounds of a [`MEASURE`]: it must be greater than 0 after rounding to three decimals, and no machine is larger or faster than the upper bound.
pub(super) const MEASURE_BOUNDS: RangeInclusive<f64> = 0.001..=1e6;

/// A time in seconds greater than 0.
pub(in crate::config) const SECONDS: ValueType<Duration> = ValueType {
    read: |value, reader| match number(value).and_then(|number| Duration::try_from_secs_f64(number).ok()) {
        Some(time) if !time.is_zero() => Some(time),
        _ => reader.report_unexpected(&messages::POSITIVE, value),
    },
    show: |time| Some(time.as_secs_f64().to_string()),
    schema: || json!({ "type": "number", "exclusiveMinimum": 0 }),
};

pub(in crate::config) const NOT_NEGATIVE: ValueType<f64> = ValueType {
    read: |value, reader| {
        reader.require(number(value).filter(|number| *number >= 0.0), &messages::NOT_NEGATIVE, value)
    },
    show: |number| Some(number.to_string()),
    schema: || json!({ "type": "number", "minimum": 0 }),
};

/// A time in seconds for which the machine waits. A longer one was probably meant in milliseconds.
pub(in crate::config) const WAIT: ValueType<f64> = ValueType {
    read: |value, reader| {
        let seconds = number(value).filter(|seconds| (0.0..=MAX_WAIT).contains(seconds));
        reader.require(seconds, &messages::WAIT, value)
    },
    show: NOT_NEGATIVE.show,
    schema: || json!({ "type": "number", "minimum": 0, "maximum": MAX_WAIT }),
};

/// Largest value of a [`WAIT`], in seconds: no spindle takes longer to reach its speed.
const MAX_WAIT: f64 = 60.0;

/// Optional upper bound on the length of pieces of moves in mm; 0 means any length. Very short pieces are refused: a machine cannot distinguish
/// them, so they would only fill the disk.
pub(in crate::config) const PIECE: ValueType<Option<f64>> = ValueType {
    read: |value, reader| {
        let length = number(value).filter(|number| *number == 0.0 || *number >= MIN_PIECE);
        reader.require(length, &messages::PIECE, value).map(Some)
    },
    show: |number| number.map(|number| number.to_string()),
    schema: || json!({ "oneOf": [{ "const": 0 }, { "type": "number", "minimum": MIN_PIECE }] }),
};

/// Smallest value of a [`PIECE`] other than 0, in mm.
const MIN_PIECE: f64 = 0.1;

/// Tolerance of the part check in mm. With a tolerance below `MIN_PART_TOLERANCE`, the rounding of coordinates would be reported.
pub(in crate::config) const PART_TOLERANCE: ValueType<f64> = ValueType {
    read: |value, reader| {
        let tolerance = number(value).filter(|number| *number >= MIN_PART_TOLERANCE);
        reader.require(tolerance, &messages::PART_TOLERANCE, value)
    },
    show: |number| Some(number.to_string()),
    schema: || json!({ "type": "number", "minimum": MIN_PART_TOLERANCE }),
};

/// Smallest value of [`PART_TOLERANCE`], in mm.
const MIN_PART_TOLERANCE: f64 = 0.005;

pub(in crate::config) const COUNT: ValueType<u64> = ValueType {
    read: |value, reader| {
        reader.require(whole_number(value).filter(|count| *count > 0), &messages::COUNT, value)
    },
    show: |count| Some(count.to_string()),
    schema: || json!({ "type": "integer", "minimum": 1 }),
};

/// A size in bytes: a whole number, or a text such as "256 MiB".
pub(in crate::config) const SIZE: ValueType<u64> = ValueType {
    read: |value, reader| reader.require(size(value).filter(|size| *size > 0), &messages::SIZE, value),
    show: |size| Some(format_size(*size)),
    schema: || json!({ "oneOf": [{ "type": "integer", "minimum": 1 }, { "type": "string", "pattern": SIZE_PATTERN }] }),
};

/// A duration, written as a text such as "50 ms".
pub(in crate::config) const DURATION: ValueType<Duration> = ValueType {
    read: |value, reader| {
        reader.require(value.get_ref().as_str().and_then(duration), &messages::DURATION, value)
    },
    show: |duration| Some(format!("\"{} ms\"", duration.as_millis())),
    schema: || json!({ "type": "string", "pattern": "^[0-9]+ ?(ms|s|min)$" }),
};

/// Two numbers, the smaller one first.
pub(in crate::config) const NUMBER_RANGE: ValueType<Option<NumberRange>> = ValueType {
    read: |value, reader| reader.require(number_range(value), &messages::EXTENT, value).map(Some),
    show: |extent| extent.map(|extent| format!("[{}, {}]", extent.from, extent.to)),
    schema: || json!({ "type": "array", "items": { "type": "number" }, "minItems": 2, "maxItems": 2 }),
};

/// A positive number for each of X, Y and Z.
pub(in crate::config) const AXES: ValueType<Option<[f64; 3]>> = ValueType {
    read: |value, reader| reader.require(axes(value), &messages::AXES, value).map(Some),
    show: |axes| axes.map(|[x, y, z]| format!("[{x}, {y}, {z}]")),
    schema: || json!({ "type": "array", "items": { "type": "number", "exclusiveMinimum": 0 }, "minItems": 3, "maxItems": 3 }),
};

pub(in crate::config) const SWITCH: ValueType<bool> =
    ValueType { read: switch, show: |on| Some(on.to_string()), schema: || json!({ "type": "boolean" }) };

fn switch(value: &Spanned<DeValue<'_>>, reader: &mut TomlReader<'_>) -> Option<bool> {
    reader.require(value.get_ref().as_bool(), &messages::SWITCH, value)
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
    written_number(value)?.replace('_', "").parse().ok().filter(|number: &f64| number.is_finite())
}

fn written_number<'v>(value: &'v Spanned<DeValue<'_>>) -> Option<&'v str> {
    let value = value.get_ref();
    match value.as_float() {
        Some(float) => Some(float.as_str()),
        None => Some(value.as_integer().filter(|integer| integer.radix() == 10)?.as_str()),
    }
}

fn whole_number(value: &Spanned<DeValue<'_>>) -> Option<u64> {
    let integer = value.get_ref().as_integer()?;
    u64::from_str_radix(&integer.as_str().replace('_', ""), integer.radix()).ok()
}

fn number_range(value: &Spanned<DeValue<'_>>) -> Option<NumberRange> {
    let array = value.get_ref().as_array()?;
    match (array.len(), array.first().and_then(number), array.get(1).and_then(number)) {
        (2, Some(from), Some(to)) if from < to => Some(NumberRange { from, to }),
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

fn format_size(size: u64) -> String {
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

/// A non-empty string.
pub(in crate::config) const TEXT: ValueType<Box<str>> = ValueType {
    read: |value, reader| match reader.text(value)? {
        "" => reader.report_unexpected(&messages::NOT_EMPTY, value),
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

pub(in crate::config) const DIRECTORIES: ValueType<Directories> = ValueType {
    read: |value, reader| {
        let names = texts(value, reader)?;
        Some(names.into_iter().filter_map(|(name, value)| reader.path(name, value)).collect())
    },
    show: |directories| Some(list(directories.iter().map(|directory| directory.as_str()))),
    schema: || json!({ "type": "array", "items": { "type": "string" } }),
};

pub(in crate::config) const ABSOLUTE_DIRECTORY: ValueType<Utf8PathBuf> = ValueType {
    read: |value, reader| match reader.text(value)? {
        name if Utf8Path::new(name).is_absolute() => reader.path(name, value),
        _ => reader.report_unexpected(&messages::ABSOLUTE, value),
    },
    show: |path| Some(quoted(path.as_str())),
    schema: || json!({ "type": "string" }),
};

pub(in crate::config) const ABSOLUTE_DIRECTORIES: ValueType<Directories> = ValueType {
    read: |value, reader| {
        let names = texts(value, reader)?;
        if names.iter().all(|(name, _)| Utf8Path::new(name).is_absolute()) {
            Some(names.into_iter().filter_map(|(name, value)| reader.path(name, value)).collect())
        } else {
            reader.report_unexpected(&messages::ABSOLUTES, value)
        }
    },
    ..DIRECTORIES
};

pub(in crate::config) const fn choice<T: Choice>() -> ValueType<T> {
    ValueType { read: read_choice, show: |choice| name_of(*choice).map(quoted), schema: choice_schema::<T> }
}

pub(in crate::config) const fn choices<T: Choice>() -> ValueType<Vec<T>> {
    ValueType {
        read: |value, reader| {
            let Some(items) = value.get_ref().as_array() else {
                return reader.report_unexpected(&messages::LIST_OF_TEXTS, value);
            };
            collect_all(items.iter().map(|item| read_choice(item, reader)))
        },
        show: |choices| Some(list(choices.iter().filter_map(|choice| name_of(*choice)))),
        schema: || json!({ "type": "array", "items": choice_schema::<T>() }),
    }
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

/// Returns the text that stands for a choice in the configuration.
pub(in crate::config) fn name_of<T: Choice>(choice: T) -> Option<&'static str> {
    T::ALL.iter().find(|(_, value)| *value == choice).map(|(name, _)| *name)
}

/// Returns the strings in a list, each with its TOML value; reports a value of another type.
pub(in crate::config) fn texts<'v, 't>(
    value: &'v Spanned<DeValue<'t>>,
    reader: &mut TomlReader<'_>,
) -> Option<Vec<(&'v str, &'v Spanned<DeValue<'t>>)>> {
    let items = value
        .get_ref()
        .as_array()
        .map(|array| array.iter().map(|item| item.get_ref().as_str().map(|text| (text, item))));
    reader.require(items.and_then(Iterator::collect::<Option<Vec<_>>>), &messages::LIST_OF_TEXTS, value)
}

/// Whether a string can be written in single quotes, in which TOML escapes nothing. `##` is excluded because CI runners may take it for a command, so
/// it may have to be escaped.
pub(in crate::config) fn is_literal(text: &str) -> bool {
    !text.contains('\'') && !text.contains("##") && !text.contains(escaping::is_active)
}

/// Formats a string as TOML, in single quotes if that avoids escapes. Otherwise uses JSON escapes, which TOML accepts too, and TOML's own escapes
/// for characters beyond U+FFFF.
pub(in crate::config) fn quoted(text: &str) -> String {
    if text.contains(['\\', '"']) && is_literal(text) {
        return format!("'{text}'");
    }
    let mut quoted = String::with_capacity(text.len() + 2);
    for character in json!(text).to_string().chars() {
        if character > '\u{ffff}' && escaping::is_active(character) {
            _ = write!(quoted, "\\U{:08x}", u32::from(character));
        } else {
            quoted.push(character);
        }
    }
    escaping::json(&quoted).into_owned()
}

/// Formats strings as a TOML list.
pub(in crate::config) fn list<'a>(texts: impl IntoIterator<Item = &'a str>) -> String {
    format!("[{}]", texts.into_iter().map(quoted).collect::<Vec<_>>().join(", "))
}

pub(in crate::config) const REGEX: ValueType<Box<str>> = ValueType {
    read: |value, reader| {
        let text = reader.text(value)?;
        check_regex(text, value.span(), reader).then(|| text.into())
    },
    show: |text| Some(literal(text)),
    schema: || json!({ "type": "string", "format": "regex" }),
};

pub(in crate::config) const OPTIONAL_REGEX: ValueType<Option<Box<str>>> = ValueType {
    read: |value, reader| (REGEX.read)(value, reader).map(Some),
    show: |text| text.as_deref().map(literal),
    schema: REGEX.schema,
};

/// A list of rules of the form PARENT:CHILD.
pub(in crate::config) const RESTRICTIONS: ValueType<Vec<Restriction>> = ValueType {
    read: |value, reader| {
        let rules =
            texts(value, reader)?.into_iter().map(|(text, item)| restriction(text, item.span(), reader));
        collect_all(rules)
    },
    show: |rules| {
        let texts: Vec<_> =
            rules.iter().map(|rule| literal(&format!("{}:{}", rule.parent, rule.child))).collect();
        Some(format!("[{}]", texts.join(", ")))
    },
    schema: || json!({ "type": "array", "items": { "type": "string", "pattern": ":" } }),
};

pub(in crate::config) const PATTERNS: ValueType<Vec<Pattern>> = ValueType {
    read: |value, reader| {
        let patterns =
            texts(value, reader)?.into_iter().map(|(text, item)| pattern(text, item.span(), reader));
        collect_all(patterns)
    },
    show: |patterns| Some(list(patterns.iter().map(Pattern::text))),
    schema: || json!({ "type": "array", "items": { "type": "string" } }),
};

/// Describes briefly what is wrong with a regular expression; `None` if it is valid.
pub(in crate::config) fn regex_fault(text: &str) -> Option<Value> {
    let error = RegexBuilder::new(text).size_limit(MAX_COMPILED_REGEX_BYTES).build().err()?;
    Some(regex_reason(&error))
}

pub(in crate::config) fn split_restriction(text: &str) -> Option<Restriction> {
    let (parent, child) = text.split_once(':')?;
    Some(Restriction { parent: parent.into(), child: child.into() })
}

/// Upper bound on the size of a compiled regular expression in bytes. Patterns for names need far less.
const MAX_COMPILED_REGEX_BYTES: usize = 1 << 19;

fn check_regex(text: &str, span: Range<usize>, reader: &mut TomlReader<'_>) -> bool {
    if !reader.count_limited(LimitedKind::Regex, span.clone()) {
        return false;
    }
    let Some(reason) = regex_fault(text) else { return true };
    reader.report(reader.fault(&messages::BROKEN_REGEX, span).with("reason", reason));
    false
}

fn restriction(text: &str, span: Range<usize>, reader: &mut TomlReader<'_>) -> Option<Restriction> {
    let Some(rule) = split_restriction(text) else {
        reader.report(reader.fault(&messages::RESTRICT_WITHOUT_COLON, span));
        return None;
    };
    let parent = check_regex(&rule.parent, span.clone(), reader);
    let child = check_regex(&rule.child, span, reader);
    (parent && child).then_some(rule)
}

fn pattern(text: &str, span: Range<usize>, reader: &mut TomlReader<'_>) -> Option<Pattern> {
    if !reader.count_limited(LimitedKind::Glob, span.clone()) {
        return None;
    }
    match Pattern::new(text) {
        Ok(pattern) => Some(pattern),
        Err(reason) => {
            reader.report(reader.fault(&messages::BROKEN_GLOB, span).with("reason", reason));
            None
        }
    }
}

/// Collects all items, or returns `None` if one is missing. Evaluates every item first, since each may report errors.
fn collect_all<T>(items: impl Iterator<Item = Option<T>>) -> Option<Vec<T>> {
    let items: Vec<Option<T>> = items.collect();
    items.into_iter().collect()
}

/// Quotes a pattern without escapes if possible, for readability.
fn literal(text: &str) -> String {
    if is_literal(text) { format!("'{text}'") } else { quoted(text) }
}
