//! TEXT and MTEXT. (book: language/parameter-texts)

use std::borrow::Cow;

use smol_str::{SmolStr, SmolStrBuilder};

use crate::encoding::{Decoder, control, without_carets};
use crate::faults::EntityError;
use crate::fields::{BadGroup, Fields};
use crate::placement::{angle_of, opposite};
use crate::shapes::{from_object_coordinates, is_mirrored};
use crate::{Geometry, HorizontalAlign, MText, Options, Point3, Text, VerticalAlign};

pub(crate) fn text<'a>(
    fields: &Fields<'a>,
    decoder: &mut Decoder<'_>,
    longest: usize,
) -> Result<Geometry, EntityError<'a>> {
    let string = fields.get(1).ok_or(BadGroup::Missing { code: 1 })?;
    if string.bytes.len() > longest {
        return Err(EntityError::TextTooLong);
    }
    let horizontal = fields.whole_number(72)?.unwrap_or(0);
    let vertical = fields.whole_number(73)?.unwrap_or(0);
    let (anchor, direction) = anchor(fields, horizontal, vertical)?;
    let generation = fields.whole_number(71)?.unwrap_or(0);
    let text = Text {
        string: without_carets(decoder.decode(string.bytes, string.line)).into(),
        anchor,
        height: fields.length(40)?,
        rotation: direction.map_or_else(|| fields.number(50), |angle| Ok(Some(angle)))?.unwrap_or(0.0),
        horizontal: horizontal_align(horizontal),
        vertical: if horizontal == MIDDLE_CODE { VerticalAlign::Middle } else { vertical_align(vertical) },
        backwards: generation & 2 != 0,
        upside_down: generation & 4 != 0,
    };
    from_object_coordinates(Geometry::Text(text), fields)
}

/// Reads an MTEXT. Its point and direction are in world coordinates.
pub(crate) fn mtext<'a>(
    fields: &Fields<'a>,
    decoder: &mut Decoder<'_>,
    options: &Options<'_>,
) -> Result<Geometry, EntityError<'a>> {
    let plain = plain_text(&joined_chunks(fields, decoder, options.max_text)?);
    let attachment = fields.whole_number(71)?.unwrap_or(1);
    let (horizontal, vertical) = attachment_align(attachment);
    let is_mirrored = is_mirrored(fields)?;
    let rotation = rotation(fields, is_mirrored)?;
    Ok(Geometry::MText(MText {
        plain,
        anchor: fields.point(10)?,
        height: fields.length(40)?,
        width: fields.number(41)?.filter(|width| *width > 0.0 && !options.compatible),
        rotation,
        horizontal: if is_mirrored { opposite(horizontal) } else { horizontal },
        vertical,
    }))
}

const ALIGNED_CODE: i64 = 3;
const MIDDLE_CODE: i64 = 4;
const FITTED_CODE: i64 = 5;

/// Returns the anchor of a TEXT, and its direction if two points define it.
fn anchor<'a>(
    fields: &Fields<'a>,
    horizontal: i64,
    vertical: i64,
) -> Result<(Point3, Option<f64>), BadGroup<'a>> {
    let first = fields.point(10)?;
    match horizontal {
        0 if vertical == 0 => Ok((first, None)),
        ALIGNED_CODE | FITTED_CODE => {
            let second = fields.point(11)?;
            Ok((between(first, second), direction(second.x - first.x, second.y - first.y)))
        }
        _ => Ok((fields.point(11)?, None)),
    }
}

fn between(a: Point3, b: Point3) -> Point3 {
    Point3 { x: f64::midpoint(a.x, b.x), y: f64::midpoint(a.y, b.y), z: f64::midpoint(a.z, b.z) }
}

/// Returns the angle of a vector in degrees; `None` for a vector of zero length.
fn direction(x: f64, y: f64) -> Option<f64> {
    (x != 0.0 || y != 0.0).then(|| angle_of(x, y))
}

fn horizontal_align(code: i64) -> HorizontalAlign {
    match code {
        1 | ALIGNED_CODE | MIDDLE_CODE | FITTED_CODE => HorizontalAlign::Centre,
        2 => HorizontalAlign::Right,
        _ => HorizontalAlign::Left,
    }
}

fn vertical_align(code: i64) -> VerticalAlign {
    match code {
        1 => VerticalAlign::Bottom,
        2 => VerticalAlign::Middle,
        3 => VerticalAlign::Top,
        _ => VerticalAlign::Baseline,
    }
}

/// Returns the alignment for an attachment of an MTEXT: 1 to 9 are three rows of three, from top left to bottom right.
fn attachment_align(code: i64) -> (HorizontalAlign, VerticalAlign) {
    let horizontal = match code {
        2 | 5 | 8 => HorizontalAlign::Centre,
        3 | 6 | 9 => HorizontalAlign::Right,
        _ => HorizontalAlign::Left,
    };
    let vertical = match code {
        4..=6 => VerticalAlign::Middle,
        7..=9 => VerticalAlign::Bottom,
        _ => VerticalAlign::Top,
    };
    (horizontal, vertical)
}

/// Returns the rotation of an MTEXT seen from above: 50 or 11/21, whichever comes later. A mirrored MTEXT runs from right to left, so the opposite of
/// its direction is returned.
fn rotation<'a>(fields: &Fields<'a>, is_mirrored: bool) -> Result<f64, BadGroup<'a>> {
    let by_angle = fields.get(50).map(|value| value.line);
    let by_point = fields.get(11).map(|value| value.line).filter(|line| Some(*line) > by_angle);
    let angle = match (by_point, by_angle) {
        (Some(_), _) => direction(fields.required(11)?, fields.required(21)?).unwrap_or(0.0),
        (None, Some(_)) => fields.required(50)?,
        (None, None) => 0.0,
    };
    Ok(match (is_mirrored, by_point) {
        (false, _) => angle,
        (true, Some(_)) => (angle + 180.0) % 360.0,
        (true, None) => -angle,
    })
}

/// Joins the chunks of an MTEXT as bytes before decoding, since a character or `\U+` may be split between two.
fn joined_chunks<'a>(
    fields: &Fields<'a>,
    decoder: &mut Decoder<'_>,
    longest: usize,
) -> Result<Cow<'a, str>, EntityError<'a>> {
    let chunks = || fields.repeated.iter().map(|pair| pair.value);
    let first = fields.repeated.first().ok_or(BadGroup::Missing { code: 1 })?;
    if fields.is_full() || chunks().map(<[u8]>::len).sum::<usize>() > longest {
        return Err(EntityError::TextTooLong);
    }
    if chunks().nth(1).is_none() {
        return Ok(decoder.decode(first.value, first.line));
    }
    let joined = chunks().collect::<Vec<_>>().concat();
    Ok(Cow::Owned(decoder.decode(&joined, first.line).into_owned()))
}

/// Removes the formatting from joined, decoded chunks, and what is struck out, because it is void. Line breaks become `\n`.
///
/// A command without its end is kept as text: dropping the rest of a parameter text would be worse.
fn plain_text(raw: &str) -> SmolStr {
    if !raw.bytes().any(is_special) {
        return raw.into();
    }
    let (mut plain, mut void) = (SmolStrBuilder::new(), SmolStrBuilder::new());
    let (mut is_struck, mut outer) = (false, Vec::new());
    // Search for the last `;` only once: thousands of unterminated commands would otherwise each search the whole rest.
    let behind_last = raw.rfind(';').map_or(raw.len(), |last| raw.len() - last - 1);
    let mut rest = raw;
    while let Some(special) = rest.bytes().position(is_special) {
        let seen = if is_struck { &mut void } else { &mut plain };
        seen.push_str(&rest[..special]);
        rest = &rest[special..];
        let length = match rest.as_bytes()[0] {
            b'\\' => append_command(rest, rest.len() > behind_last, seen),
            b'^' => append_caret(rest, seen),
            _ => 1,
        };
        match rest.as_bytes() {
            [b'{', ..] => outer.push(is_struck),
            [b'}', ..] => is_struck = outer.pop().unwrap_or(is_struck),
            [b'\\', b'K', ..] => {
                // A space keeps the parameters around the void ones apart.
                plain.push(' ');
                is_struck = true;
            }
            [b'\\', b'k', ..] => is_struck = false,
            _ => {}
        }
        rest = &rest[length..];
    }
    if !is_struck {
        plain.push_str(rest);
    }
    plain.finish()
}

/// Whether a byte may start something that is not plain text.
fn is_special(byte: u8) -> bool {
    matches!(byte, b'\\' | b'{' | b'}' | b'^')
}

/// Appends what the command at the start of `text` stands for, and returns the length of the command in bytes. `may_end` tells whether a `;` follows.
fn append_command(text: &str, may_end: bool, plain: &mut SmolStrBuilder) -> usize {
    let Some(letter) = text[1..].chars().next() else {
        plain.push('\\');
        return 1;
    };
    let short = 1 + letter.len_utf8();
    match letter {
        // `\N` starts a new column, which is read as a new line.
        'P' | 'X' | 'N' => plain.push('\n'),
        '~' => plain.push('\u{a0}'),
        '\\' | '{' | '}' => plain.push(letter),
        'L' | 'l' | 'O' | 'o' | 'K' | 'k' => {}
        'S' => return short + append_stacked(&text[short..], plain),
        _ => {
            let Some(end) = may_end.then(|| text.find(';')).flatten() else {
                plain.push('\\');
                return 1;
            };
            return end + 1;
        }
    }
    short
}

/// Appends the stacked text at the start of `text`, and returns its length in bytes, including the `;` that ends it.
fn append_stacked(text: &str, plain: &mut SmolStrBuilder) -> usize {
    let mut characters = text.char_indices().peekable();
    while let Some((index, character)) = characters.next() {
        match character {
            ';' => return index + 1,
            '#' => plain.push('/'),
            '^' if characters.next_if(|(_, next)| *next == ' ').is_some() => {}
            '\\' => {
                if let Some((_, literal)) = characters.next() {
                    plain.push(literal);
                }
            }
            other => plain.push(other),
        }
    }
    text.len()
}

/// Appends the character that the caret code at the start of `text` stands for, and returns the length of the code in bytes.
fn append_caret(text: &str, plain: &mut SmolStrBuilder) -> usize {
    if text.starts_with("^M^J") {
        plain.push('\n');
        return 4;
    }
    let (character, length) = control(text).unwrap_or(('^', 1));
    plain.push(character);
    length
}
