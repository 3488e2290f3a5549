use super::cursor::{Cursor, Parsed};
use pathbuild_draw::Draft;
use pathbuild_draw::LINE_TYPES;

/// Parses `linetype NAME [dash ...]`, which declares a further line type.
pub(crate) fn declare(cursor: &mut Cursor, draft: &mut Draft) -> Parsed<()> {
    cursor.keyword("linetype")?;
    let name = cursor.name("a line type's name")?;
    let mut pattern = Vec::new();
    while cursor.is_at_number() {
        pattern.push(cursor.number("the length of a dash, a gap (less than 0) or a dot (0)")?);
    }
    list(name, pattern, draft);
    Ok(())
}

/// Parses an optional line type: a usual one, a declared one, or any name in quotes.
pub(crate) fn option(cursor: &mut Cursor, draft: &mut Draft) -> Parsed<Option<String>> {
    let Some(token) = cursor.peek() else { return Ok(None) };
    let name = token.text.clone();
    let pattern = pattern(&name, draft);
    if pattern.is_none() && !token.quoted {
        return Ok(None);
    }
    cursor.next("a line type")?;
    list(name.clone(), pattern.unwrap_or_else(|| vec![6.35, -3.175]), draft);
    Ok(Some(name))
}

/// Parses a line type.
pub(crate) fn expect(cursor: &mut Cursor, draft: &mut Draft) -> Parsed<String> {
    if let Some(name) = option(cursor, draft)? {
        return Ok(name);
    }
    let name = cursor.name("a line type")?;
    Err(cursor.error(unknown(&name)))
}

fn unknown(name: &str) -> String {
    format!("{name:?} is no known line type; list it with `linetype {name}`, or put it in quotation marks")
}

/// The pattern of a usual or declared line type.
fn pattern(name: &str, draft: &Draft) -> Option<Vec<f64>> {
    if let Some((_, pattern)) = draft.line_types.iter().find(|(known, _)| known.eq_ignore_ascii_case(name)) {
        return Some(pattern.clone());
    }
    let upper = name.to_ascii_uppercase();
    let usual =
        |wanted: &str| LINE_TYPES.iter().find(|(known, _)| *known == wanted).map(|(_, pattern)| *pattern);
    let suffixed = |suffix: &str, factor: f64| {
        let pattern = usual(upper.strip_suffix(suffix)?)?;
        Some(pattern.iter().map(|part| part * factor).collect())
    };
    usual(&upper)
        .map(<[f64]>::to_vec)
        .or_else(|| suffixed("X2", 2.0))
        .or_else(|| suffixed("2", 0.5))
        .or_else(|| suffixed("TINY", 0.15))
}

fn list(name: String, pattern: Vec<f64>, draft: &mut Draft) {
    let usual = LINE_TYPES.iter().any(|(known, _)| known.eq_ignore_ascii_case(&name));
    let listed = draft.line_types.iter().any(|(known, _)| known.eq_ignore_ascii_case(&name));
    if !usual && !listed {
        draft.line_types.push((name, pattern));
    }
}
