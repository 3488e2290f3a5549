//! Q-projects: a row of subpath segments, each with its text. (book: language/q-projects)

use crate::draft::Draft;
use crate::error::DrawError;
use crate::model::{Entity, Point};
use crate::sheet::Sheet;

/// The way between one segment's end and the next one's start, in mm.
const GAP: f64 = 20.0;

/// A path whose ends are nearer to each other than this, in mm, is closed.
const CLOSED: f64 = 1e-3;

/// The radius in mm of the circle that stands for a closed path: a line without length could have no text.
const CIRCLE: f64 = 5.0;

/// Draws one path that embeds others one after the other, to the right from (0, 0).
///
/// `parameters` is the text at its start; a segment is its length in mm and its text.
///
/// # Errors
/// A segment that is too short for its text.
pub fn q_project(layer: &str, parameters: &str, segments: &[(f64, &str)]) -> Result<Sheet, Vec<DrawError>> {
    let mut draft = Draft::new();
    draft.layer(layer).add(Entity::start((0.0, 0.0)).note(&escaped(parameters)));
    let mut at = Point::new(0.0, 0.0);
    for (index, (length, text)) in segments.iter().enumerate() {
        if index > 0 {
            let next = at + Point::new(GAP, 0.0);
            draft.add(Entity::line(at, next).typed("HIDDEN"));
            at = next;
        }
        let (segment, end) = segment(at, *length);
        draft.add(segment.typed("DASHDOT").note(&escaped(text)));
        at = end;
    }
    draft.add(Entity::end(at));
    draft.finish()
}

/// A segment from a point on, and where it ends. That of a closed path is a whole turn.
fn segment(from: Point, length: f64) -> (Entity, Point) {
    if length < CLOSED {
        let centre = from + Point::new(0.0, CIRCLE);
        return (Entity::arc(centre, CIRCLE, 270.0, 270.0), from);
    }
    let to = from + Point::new(length, 0.0);
    (Entity::line(from, to), to)
}

/// A text as MTEXT has it.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '\\' | '{' | '}' => escaped.extend(['\\', character]),
            '\u{a0}' => escaped.push_str("\\~"),
            // Else a control character would be read with what follows.
            '^' => escaped.push_str("^ "),
            character => escaped.push(character),
        }
    }
    escaped
}
