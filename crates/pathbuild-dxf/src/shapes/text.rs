//! TEXT and MTEXT. (book: language/parameter-texts)

use std::borrow::Cow;

use smol_str::{SmolStr, SmolStrBuilder};

use crate::encoding::{Decoder, caret_character, without_carets};
use crate::faults::EntityError;
use crate::fields::{BadGroup, Fields};
use crate::placement::{angle_of, opposite};
use crate::shapes::{from_object_coordinates, is_mirrored, repeated_number};
use crate::{Circle, Geometry, HorizontalAlign, LayoutObstacle, MText, Options, Point3, Text, VerticalAlign};

pub(crate) fn text<'a>(
    fields: &Fields<'a>,
    decoder: &mut Decoder<'_>,
    options: &Options<'_>,
) -> Result<Geometry, EntityError<'a>> {
    let string = fields.get(1).ok_or(BadGroup::Missing { code: 1 })?;
    if string.bytes.len() > options.max_text {
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
        counts_invisible: options.compatible,
    };
    from_object_coordinates(Geometry::Text(text), fields)
}

/// Reads an MTEXT. Its point and direction are in world coordinates.
pub(crate) fn mtext<'a>(
    fields: &Fields<'a>,
    decoder: &mut Decoder<'_>,
    options: &Options<'_>,
) -> Result<Geometry, EntityError<'a>> {
    let attachment = fields.whole_number(71)?.unwrap_or(1);
    let (horizontal, vertical) = attachment_align(attachment);
    let nominal = fields.length(40)?;
    let width = fields.number(41)?.filter(|width| *width > 0.0 && !options.compatible);
    let text = PlainText::read(&joined_chunks(fields, decoder, options.max_text)?, nominal, horizontal);
    let (height, paragraphs) = text.first.filter(|_| !options.compatible).unwrap_or((nominal, horizontal));
    let plain = text.plain.finish();
    let obstacle = match text.obstacle {
        _ if options.compatible => None,
        Some(obstacle) => Some(obstacle),
        None if has_tab(&plain) => Some(LayoutObstacle::Tab),
        None if has_columns(fields) => Some(LayoutObstacle::Columns),
        None if has_empty_end(&plain) && vertical != VerticalAlign::Top => Some(LayoutObstacle::EmptyRows),
        None => (text.has_several_alignments && width.is_some()).then_some(LayoutObstacle::Alignment),
    };
    let is_mirrored = is_mirrored(fields)?;
    let rotation = rotation(fields, is_mirrored)?;
    let seen = |side| if is_mirrored { opposite(side) } else { side };
    Ok(Geometry::MText(MText {
        plain,
        anchor: fields.point(10)?,
        height,
        width,
        rotation,
        horizontal: seen(horizontal),
        vertical,
        paragraphs: seen(paragraphs),
        obstacle,
        counts_invisible: options.compatible,
    }))
}

/// Reads the text of a multileader or dimension, without formatting, with its [tip](crate::Label::tip). `None` for an entity without a point or a
/// text of its own, or with a text longer than `max_text` bytes, which cannot hold parameters.
pub(crate) fn label(fields: &Fields<'_>, max_text: usize) -> Option<(SmolStr, Circle)> {
    let text = fields.get(1).filter(|text| !text.bytes.is_empty() && text.bytes.len() <= max_text)?;
    let numbers = |code: i32| {
        let of_code = fields.repeated.iter().filter(move |pair| pair.code == code);
        of_code.map(|pair| repeated_number(pair).ok())
    };
    let height = numbers(41).next().flatten().unwrap_or_default();
    // The points of a multileader are the origin of its text, the end of the leader and the points of its lines, of which the first is the tip.
    let tip = |code: i32| numbers(code).nth(2).flatten();
    let tip = tip(10).zip(tip(20)).map(|(x, y)| Point3 { x, y, z: 0.0 });
    // A dimension has no repeated groups. Its text is at 11.
    let centre = tip.or_else(|| fields.point(if fields.repeated.is_empty() { 11 } else { 10 }).ok())?;
    // An undecodable character is not reported, since no parameter contains one.
    let text = PlainText::read(&String::from_utf8_lossy(text.bytes), 1.0, HorizontalAlign::Left);
    let radius = tip.map_or(0.0, |_| height / 2.0);
    Some((text.plain.finish(), Circle { centre, radius }))
}

/// Whether a tab is before the last visible character of a row.
fn has_tab(plain: &str) -> bool {
    plain.contains('\t') && plain.split('\n').any(|row| row.trim_end().contains('\t'))
}

/// Whether empty rows follow the last visible character.
fn has_empty_end(plain: &str) -> bool {
    let end = plain.trim_end().len();
    end > 0 && plain[end..].contains('\n')
}

/// Whether the embedded object of an MTEXT has several columns.
fn has_columns(fields: &Fields<'_>) -> bool {
    fields.whole_number(101).is_ok_and(|count| count > Some(1))
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
            Ok((midpoint(first, second), direction(second.x - first.x, second.y - first.y)))
        }
        _ => Ok((fields.point(11)?, None)),
    }
}

fn midpoint(a: Point3, b: Point3) -> Point3 {
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

/// Returns the rotation of an MTEXT seen from above, from group 50 or 11/21, whichever comes later in the file. A mirrored MTEXT runs from right to
/// left, so the opposite of its direction is returned.
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

/// The text of an MTEXT without its formatting, and what the formatting tells about the places of the letters.
struct PlainText {
    /// The text, with line breaks as `\n`.
    plain: SmolStrBuilder,
    /// Height of the next letters in mm.
    height: f64,
    /// Whether the next letters are struck out, and therefore void.
    is_struck_out: bool,
    /// `height` and `is_struck_out` outside of the open braces, innermost last.
    outer: Vec<(f64, bool)>,
    /// Alignment of paragraphs that do not state one.
    default_alignment: HorizontalAlign,
    /// Alignment of the next letters.
    alignment: HorizontalAlign,
    /// Height and alignment of the first letter.
    first: Option<(f64, HorizontalAlign)>,
    /// Whether letters are aligned differently, or distributed.
    has_several_alignments: bool,
    /// Whether a column break precedes the next letters.
    is_in_new_column: bool,
    /// The last character that is not struck out.
    last: Option<char>,
    obstacle: Option<LayoutObstacle>,
}

impl PlainText {
    /// Reads joined, decoded chunks. Height and alignment are those of letters without formatting.
    ///
    /// A command without its end is kept as text: dropping the rest of a parameter text would be worse.
    fn read(raw: &str, height: f64, default_alignment: HorizontalAlign) -> Self {
        let mut text = Self {
            plain: SmolStrBuilder::new(),
            height,
            is_struck_out: false,
            outer: Vec::new(),
            default_alignment,
            alignment: default_alignment,
            first: None,
            has_several_alignments: false,
            is_in_new_column: false,
            last: None,
            obstacle: None,
        };
        // Search for the last `;` only once: thousands of unterminated commands would otherwise each search the whole rest.
        let behind_last = raw.rfind(';').map_or(raw.len(), |last| raw.len() - last - 1);
        let mut rest = raw;
        while let Some(special) = rest.bytes().position(is_special) {
            text.push(&rest[..special]);
            rest = &rest[special..];
            let length = match rest.as_bytes()[0] {
                b'\\' => text.push_command(rest, rest.len() > behind_last),
                b'^' => text.push_caret(rest),
                brace => {
                    text.pass_brace(brace);
                    1
                }
            };
            rest = &rest[length..];
        }
        text.push(rest);
        text
    }

    /// Appends letters, and compares their height and alignment with those of the first letter.
    fn push(&mut self, letters: &str) {
        if self.is_struck_out {
            // Blanks in place of the void letters keep the remaining parameters apart and in their places.
            letters.chars().for_each(|letter| self.plain.push(if letter == '\n' { letter } else { ' ' }));
            return;
        }
        self.plain.push_str(letters);
        self.last = letters.chars().next_back().or(self.last);
        if letters.chars().all(char::is_whitespace) {
            return;
        }
        let (height, alignment) = *self.first.get_or_insert((self.height, self.alignment));
        if (self.height - height).abs() > HEIGHT_TOLERANCE * height {
            self.obstacle = Some(LayoutObstacle::Heights);
        }
        if self.is_in_new_column {
            self.obstacle = Some(LayoutObstacle::Columns);
        }
        self.has_several_alignments |= self.alignment != alignment;
    }

    /// Keeps the properties of letters at an opening brace, and returns to them at the closing one.
    fn pass_brace(&mut self, brace: u8) {
        if brace == b'{' {
            self.outer.push((self.height, self.is_struck_out));
        } else if let Some(outer) = self.outer.pop() {
            (self.height, self.is_struck_out) = outer;
        }
    }

    /// Appends what the command at the start of `text` stands for, and returns the length of the command in bytes. `may_end` tells whether a `;`
    /// follows.
    fn push_command(&mut self, text: &str, may_end: bool) -> usize {
        let Some(letter) = text[1..].chars().next() else {
            self.push("\\");
            return 1;
        };
        let short = 1 + letter.len_utf8();
        match letter {
            'P' | 'X' => self.push("\n"),
            // A new column is read as a new line.
            'N' => {
                self.push("\n");
                self.is_in_new_column = true;
            }
            '~' => self.push("\u{a0}"),
            '\\' | '{' | '}' => self.push(&text[1..short]),
            'K' => self.is_struck_out = true,
            'k' => self.is_struck_out = false,
            'L' | 'l' | 'O' | 'o' => {}
            'S' => {
                self.obstacle = Some(LayoutObstacle::Stack);
                let (stacked, length) = parse_stacked_text(&text[short..]);
                let is_behind_digit = self.last.is_some_and(|last| last.is_ascii_digit());
                if is_behind_digit && stacked.starts_with(|letter: char| letter.is_ascii_digit()) {
                    // The caret keeps a raised or lowered digit from being read as a further digit of the number before it.
                    self.push("^");
                }
                self.push(&stacked);
                return short + length;
            }
            _ => {
                let Some(end) = may_end.then(|| text.find(';')).flatten() else {
                    self.push("\\");
                    return 1;
                };
                match letter {
                    'H' => self.set_height(&text[short..end]),
                    'p' => self.set_paragraph(&text[short..end]),
                    _ => {}
                }
                return end + 1;
            }
        }
        short
    }

    /// Sets the height of the next letters: `0.5` in mm, or `0.2x` times the present height.
    fn set_height(&mut self, height: &str) {
        let (number, unit) = height.strip_suffix('x').map_or((height, 1.0), |factor| (factor, self.height));
        let height = number.trim().parse().map_or(0.0, |number: f64| number * unit);
        if height > 0.0 && height.is_finite() {
            self.height = height;
        }
    }

    /// Applies the properties of a paragraph, such as `xqc` or `i-3,l3,t3`: first-line, left and right indent, alignment, tab stops.
    fn set_paragraph(&mut self, properties: &str) {
        for property in properties.split(',') {
            let mut characters = property.trim_start_matches('x').chars();
            match (characters.next(), characters.as_str()) {
                (Some('q'), "c") => self.alignment = HorizontalAlign::Centre,
                (Some('q'), "r") => self.alignment = HorizontalAlign::Right,
                // The last row of a justified paragraph is aligned to the left, and the others fill the width.
                (Some('q'), "l" | "j") => self.alignment = HorizontalAlign::Left,
                (Some('q'), "*") => self.alignment = self.default_alignment,
                (Some('q'), _) => self.has_several_alignments = true,
                (Some('i' | 'l' | 'r'), distance) if distance != "*" && distance.parse() != Ok(0.0) => {
                    self.obstacle = Some(LayoutObstacle::Indent);
                }
                // Tab stops come last.
                (Some('t'), _) => return,
                _ => {}
            }
        }
    }

    /// Appends the character that the caret code at the start of `text` stands for, and returns the length of the code in bytes.
    fn push_caret(&mut self, text: &str) -> usize {
        if text.starts_with("^M^J") {
            self.push("\n");
            return 4;
        }
        let (character, length) = caret_character(text).unwrap_or(('^', 1));
        self.push(character.encode_utf8(&mut [0; 4]));
        length
    }
}

/// Relative difference of letter heights that does not matter.
const HEIGHT_TOLERANCE: f64 = 0.01;

/// Whether a byte may start something that is not plain text.
fn is_special(byte: u8) -> bool {
    matches!(byte, b'\\' | b'{' | b'}' | b'^')
}

/// Returns the stacked text at the start of `text`, and its length in bytes, including the `;` that ends it.
fn parse_stacked_text(text: &str) -> (String, usize) {
    let mut stacked = String::new();
    let mut characters = text.char_indices().peekable();
    while let Some((index, character)) = characters.next() {
        match character {
            ';' => return (stacked, index + 1),
            '#' => stacked.push('/'),
            '^' if characters.next_if(|(_, next)| *next == ' ').is_some() => {}
            '\\' => stacked.extend(characters.next().map(|(_, literal)| literal)),
            other => stacked.push(other),
        }
    }
    (stacked, text.len())
}
