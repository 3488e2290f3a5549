//! Q-projects: rows of subpath segments, each with its text. (book: language/q-projects)

use crate::draft::Draft;
use crate::error::DrawError;
use crate::model::{Entity, Point};
use crate::sheet::Sheet;

/// Distance in mm between the end of a segment and the start of the next.
const GAP: f64 = 20.0;

/// Distance in mm between the ends of a path below which it counts as closed.
const CLOSED: f64 = 1e-3;

/// Radius in mm of the circle that represents a closed path, since a line without length could not have a text.
const CIRCLE: f64 = 5.0;

/// Vertical distance in mm between the starts of consecutive paths.
const ROW: f64 = 60.0;

/// A path that embeds others, to be drawn.
#[derive(Clone, Debug)]
pub struct EmbeddingPath<'a> {
    /// The layer, which is also the path's name.
    pub layer: &'a str,
    /// The text at the start.
    pub parameters: &'a str,
    /// The segments: length in mm, and text.
    pub segments: Vec<(f64, &'a str)>,
}

/// Draws paths that embed others. Each path is a row to the right; the first starts at (0, 0), and each further one below the one before.
///
/// # Errors
/// A segment is too short for its text.
pub fn q_project(paths: &[EmbeddingPath<'_>]) -> Result<Sheet, Vec<DrawError>> {
    let mut draft = Draft::new();
    let mut start = Point::new(0.0, 0.0);
    for path in paths {
        draft.layer(path.layer);
        draw(&mut draft, path, start);
        start = start - Point::new(0.0, ROW);
    }
    draft.finish()
}

fn draw(draft: &mut Draft, path: &EmbeddingPath<'_>, start: Point) {
    draft.add(Entity::start(start).note(&escaped(path.parameters)));
    let mut at = start;
    for (index, (length, text)) in path.segments.iter().enumerate() {
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
}

/// A segment that begins at a point, and its end point. For a closed path it is a full circle.
fn segment(from: Point, length: f64) -> (Entity, Point) {
    if length < CLOSED {
        let centre = from + Point::new(0.0, CIRCLE);
        return (Entity::arc(centre, CIRCLE, 270.0, 270.0), from);
    }
    let to = from + Point::new(length, 0.0);
    (Entity::line(from, to), to)
}

/// Escapes a text for MTEXT.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '\\' | '{' | '}' => escaped.extend(['\\', character]),
            '\u{a0}' => escaped.push_str("\\~"),
            // Otherwise a caret would turn the next character into a control character.
            '^' => escaped.push_str("^ "),
            character => escaped.push(character),
        }
    }
    escaped
}
