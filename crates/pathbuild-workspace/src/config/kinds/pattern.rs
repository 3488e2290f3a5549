//! Regular expressions, globs, and embedding rules.

use std::ops::Range;

use pathbuild_diagnostic::Value;
use pathbuild_diagnostic::messages::configuration as messages;
use pathbuild_path::regex_reason;
use regex::RegexBuilder;
use serde_json::json;

use super::text::{is_literal, list, quoted, texts};
use crate::config::kind::ValueType;
use crate::config::reader::{LimitedKind, TomlReader};
use crate::config::types::{Pattern, Restriction};

/// A regular expression.
pub(in crate::config) const REGEX: ValueType<Box<str>> = ValueType {
    read: |value, reader| {
        let text = reader.text(value)?;
        check_regex(text, value.span(), reader).then(|| text.into())
    },
    show: |text| Some(literal(text)),
    schema: || json!({ "type": "string", "format": "regex" }),
};

/// An optional regular expression.
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
        all(rules)
    },
    show: |rules| {
        let texts: Vec<_> =
            rules.iter().map(|rule| literal(&format!("{}:{}", rule.parent, rule.child))).collect();
        Some(format!("[{}]", texts.join(", ")))
    },
    schema: || json!({ "type": "array", "items": { "type": "string", "pattern": ":" } }),
};

/// A list of globs.
pub(in crate::config) const PATTERNS: ValueType<Vec<Pattern>> = ValueType {
    read: |value, reader| {
        let patterns =
            texts(value, reader)?.into_iter().map(|(text, item)| pattern(text, item.span(), reader));
        all(patterns)
    },
    show: |patterns| Some(list(patterns.iter().map(Pattern::text))),
    schema: || json!({ "type": "array", "items": { "type": "string" } }),
};

/// A short description of the error in a regular expression, if there is one.
pub(in crate::config) fn regex_fault(text: &str) -> Option<Value> {
    let error = RegexBuilder::new(text).size_limit(REGEX_SIZE).build().err()?;
    Some(regex_reason(&error))
}

/// Splits a rule into PARENT and CHILD at the first colon.
pub(in crate::config) fn split_restriction(text: &str) -> Option<Restriction> {
    let (parent, child) = text.split_once(':')?;
    Some(Restriction { parent: parent.into(), child: child.into() })
}

/// Upper bound on the size of a compiled regular expression in bytes. Patterns for names need far less.
const REGEX_SIZE: usize = 1 << 19;

fn check_regex(text: &str, span: Range<usize>, reader: &mut TomlReader<'_>) -> bool {
    if !reader.counts(LimitedKind::Regex, span.clone()) {
        return false;
    }
    let Some(reason) = regex_fault(text) else { return true };
    let fault = reader.fault(&messages::BROKEN_REGEX, span).with("reason", reason);
    reader.report(fault);
    false
}

fn restriction(text: &str, span: Range<usize>, reader: &mut TomlReader<'_>) -> Option<Restriction> {
    let Some(rule) = split_restriction(text) else {
        let fault = reader.fault(&messages::RESTRICT_WITHOUT_COLON, span);
        reader.report(fault);
        return None;
    };
    let parent = check_regex(&rule.parent, span.clone(), reader);
    let child = check_regex(&rule.child, span, reader);
    (parent && child).then_some(rule)
}

fn pattern(text: &str, span: Range<usize>, reader: &mut TomlReader<'_>) -> Option<Pattern> {
    if !reader.counts(LimitedKind::Glob, span.clone()) {
        return None;
    }
    match Pattern::new(text) {
        Ok(pattern) => Some(pattern),
        Err(reason) => {
            let fault = reader.fault(&messages::BROKEN_GLOB, span).with("reason", reason);
            reader.report(fault);
            None
        }
    }
}

/// Collects all items, or returns `None` if one is missing. Evaluates every item first, since each may report errors.
fn all<T>(items: impl Iterator<Item = Option<T>>) -> Option<Vec<T>> {
    let items: Vec<Option<T>> = items.collect();
    items.into_iter().collect()
}

/// Quotes a pattern without escapes if possible, for readability.
fn literal(text: &str) -> String {
    if is_literal(text) { format!("'{text}'") } else { quoted(text) }
}
