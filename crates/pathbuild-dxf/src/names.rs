//! Names of layers, line types and blocks: how they are compared. (spec/10-drawing.md)

use std::cmp::Ordering;

/// A name without blanks around it and without the prefix of an external reference (`FILE$0$NAME`, `FILE|NAME`).
pub(crate) fn without_xref(name: &str) -> &str {
    let name = name.trim();
    if !name.bytes().any(|byte| matches!(byte, b'|' | b'$')) {
        return name;
    }
    let after_bar = name.rfind('|').map_or(0, |bar| bar + 1);
    let after_bound = bound_prefix(name);
    name[after_bar.max(after_bound)..].trim()
}

/// What names are compared by.
pub(crate) fn folded(name: &str) -> String {
    if name.is_ascii() { name.to_ascii_uppercase() } else { name.to_uppercase() }
}

/// The order of ASCII names without regard to case. (Names that are already folded may be anything.)
pub(crate) fn compare_ascii(a: &str, b: &str) -> Ordering {
    a.bytes().map(|byte| byte.to_ascii_uppercase()).cmp(b.bytes().map(|byte| byte.to_ascii_uppercase()))
}

/// Length of everything up to and including the last `$digits$`.
fn bound_prefix(name: &str) -> usize {
    let Some(last) = name.rfind('$') else { return 0 };
    let before = name[..last].trim_end_matches(|c: char| c.is_ascii_digit());
    let has_digits = before.len() < last;
    match before.strip_suffix('$') {
        Some(prefix) if has_digits && !prefix.is_empty() => last + 1,
        _ => 0,
    }
}
