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

/// The way from the start of one path down to that of the next, in mm.
const ROW: f64 = 60.0;

/// A path that embeds others.
#[derive(Clone, Debug)]
pub struct EmbeddingPath<'a> {
    /// The layer, which is its name.
    pub layer: &'a str,
    /// The text at its start.
    pub parameters: &'a str,
    /// Its segments: the length in mm, and the text.
    pub segments: Vec<(f64, &'a str)>,
}

/// Draws paths that embed others one after the other, each to the right, the first from (0, 0), the next below it.
///
/// # Errors
/// A segment that is too short for its text.
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
