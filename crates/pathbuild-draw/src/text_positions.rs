//! Positions parameter texts so that each belongs to its element. (book: language/parameter-texts)

use crate::geometry::{Arc, Circle, Line, Point};

/// Usual letter height in mm.
pub const LETTER_HEIGHT: f64 = 2.0;

/// Returns a letter height, followed by smaller ones to try if there is no room.
pub fn letter_heights(height: f64) -> [f64; 7] {
    [1.0, 0.7, 0.5, 0.35, 0.25, 0.15, 0.1].map(|factor| factor * height)
}

/// A part of an element, as used for matching texts.
#[derive(Clone, Copy, Debug)]
#[expect(missing_docs, reason = "the names say it")]
pub enum ElementPart {
    Circle(Circle),
    Arc(Arc),
    Line(Line),
}

/// Priority of an element's part: circles before arcs before lines, regardless of distance.
type Rank = u8;

impl ElementPart {
    /// Returns the rank of this part and its distance in mm from a text circle's centre, if the circle overlaps the part. (book:
    /// language/parameter-texts)
    fn overlapped(&self, centre: Point, radius: f64) -> Option<(Rank, f64)> {
        match self {
            Self::Circle(circle) => {
                let distance = centre.distance(circle.centre);
                (distance < radius + circle.radius).then_some((0, distance))
            }
            Self::Arc(arc) => {
                let distance = (centre.distance(arc.centre) - arc.radius).abs();
                (contains_direction(arc, centre) && distance <= radius).then_some((1, distance))
            }
            Self::Line(line) => {
                let foot = perpendicular_foot(line, centre)?;
                let distance = centre.distance(foot);
                (distance < radius).then_some((2, distance))
            }
        }
    }

    /// Returns the distance of a point from the part in mm; negative inside a circle.
    fn clearance(&self, point: Point) -> f64 {
        let to_ends = |a: Point, b: Point| point.distance(a).min(point.distance(b));
        match self {
            Self::Circle(circle) => point.distance(circle.centre) - circle.radius,
            Self::Arc(arc) if contains_direction(arc, point) => {
                (point.distance(arc.centre) - arc.radius).abs()
            }
            Self::Arc(arc) => to_ends(arc.point(arc.start), arc.point(arc.end)),
            Self::Line(line) => perpendicular_foot(line, point)
                .map_or_else(|| to_ends(line.from, line.to), |foot| point.distance(foot)),
        }
    }

    /// Returns candidates for the centre of a text circle of this radius that is to overlap this part of the element, those that look best first.
    fn text_positions(&self, radius: f64) -> Vec<Point> {
        const LENGTH_FRACTIONS: [f64; 11] = [0.5, 0.35, 0.65, 0.2, 0.8, 0.42, 0.58, 0.28, 0.72, 0.1, 0.9];
        const SIDE_OFFSETS: [f64; 3] = [0.6, -0.6, 0.0];
        const CIRCLE_ANGLES: [f64; 16] = [
            45.0, 135.0, 225.0, 315.0, 0.0, 90.0, 180.0, 270.0, 22.5, 67.5, 112.5, 157.5, 202.5, 247.5,
            292.5, 337.5,
        ];
        match self {
            Self::Circle(circle) => {
                let outside = circle.radius + 0.8 * radius;
                let inside = circle.radius - 0.6 * radius;
                let rings = [outside, inside.max(0.0), 0.0].into_iter();
                rings.flat_map(|d| CIRCLE_ANGLES.map(|angle| circle.centre.polar(d, angle))).collect()
            }
            Self::Arc(arc) => {
                let sweep = arc.sweep();
                let ring = |aside: f64| (arc.radius + aside * radius).max(arc.radius / 2.0);
                let at = |t: f64, aside: f64| arc.centre.polar(ring(aside), arc.start + t * sweep);
                LENGTH_FRACTIONS.iter().flat_map(|t| SIDE_OFFSETS.map(|aside| at(*t, aside))).collect()
            }
            Self::Line(line) => {
                let length = line.from.distance(line.to);
                let unit =
                    if length > 0.0 { (line.to - line.from) * (1.0 / length) } else { Point::new(1.0, 0.0) };
                let normal = Point::new(-unit.y, unit.x);
                let at =
                    |t: f64, aside: f64| line.from + (line.to - line.from) * t + normal * (aside * radius);
                LENGTH_FRACTIONS.iter().flat_map(|t| SIDE_OFFSETS.map(|aside| at(*t, aside))).collect()
            }
        }
    }
}

/// Whether a point's direction from the centre lies within the arc.
fn contains_direction(arc: &Arc, point: Point) -> bool {
    (arc.centre.direction(point) - arc.start).rem_euclid(360.0) <= arc.sweep()
}

/// Returns the foot of the perpendicular from a point to a line, if it lies on the line.
fn perpendicular_foot(line: &Line, point: Point) -> Option<Point> {
    let (along, to) = (line.to - line.from, point - line.from);
    let length2 = along.x * along.x + along.y * along.y;
    let t = (to.x * along.x + to.y * along.y) / length2;
    (0.0..=1.0).contains(&t).then(|| line.from + along * t)
}

/// An element to which a text may belong.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// Index of the element among the entities; `None` if it comes from a block.
    pub entity: Option<usize>,
    /// Layer of the element in lower case.
    pub layer: String,
    /// Whether the element accepts a text; lines of type HIDDEN, end markers and turn markers do not.
    pub takes_text: bool,
    /// The parts that a text circle may overlap.
    pub pieces: Vec<ElementPart>,
}

/// Width, height and circle radius of a text.
#[derive(Clone, Copy, Debug)]
#[expect(missing_docs, reason = "the names say it")]
pub struct TextSize {
    pub width: f64,
    pub height: f64,
    pub radius: f64,
}

impl TextSize {
    /// Estimates the extent of a TEXT with this string and letter height in mm.
    pub fn of_text(value: &str, height: f64) -> Self {
        let width = 0.6 * height * visible_length(value) as f64;
        Self { width, height, radius: libm::hypot(width, height) / 2.0 }
    }

    /// Estimates the extent of an MTEXT with these lines.
    pub fn of_mtext<S: AsRef<str>>(lines: &[S], letters: f64) -> Self {
        let longest = lines.iter().map(|line| visible_length(line.as_ref())).max().unwrap_or(0);
        let width = 0.6 * letters * longest as f64;
        let height = letters * lines.len() as f64;
        Self { width, height, radius: (libm::hypot(width, height) / 2.0).min(0.7 * height) }
    }
}

/// Returns the number of visible characters: without the blanks at the end, unless there are only blanks, and with each `%%` code as it is displayed.
fn visible_length(row: &str) -> usize {
    let visible = row.trim_end();
    let row = if visible.is_empty() { row } else { visible };
    let hidden = |code: &[u8]| match code {
        [b'%', b'%', b'c' | b'C' | b'd' | b'D' | b'p' | b'P'] => 2,
        [b'%', b'%', b'u' | b'U' | b'o' | b'O'] => 3,
        _ => 0,
    };
    row.chars().count() - row.as_bytes().windows(3).map(hidden).sum::<usize>()
}

/// A test of whether a text circle with this centre and radius suits the target element on this layer.
type Rule<'a> = fn(&TextPositions<'a>, usize, &str, Point, f64) -> bool;

/// The elements of a drawing; for each, whether it already has a text.
#[derive(Debug)]
pub struct TextPositions<'a> {
    candidates: &'a [Candidate],
    taken: Vec<bool>,
}

impl<'a> TextPositions<'a> {
    /// Creates the state in which no element has a text.
    pub fn new(candidates: &'a [Candidate]) -> Self {
        Self { candidates, taken: vec![false; candidates.len()] }
    }

    /// Finds the element to which a text of the drawing belongs, and records that it has a text.
    pub fn mark_element_with_text(&mut self, layer: &str, centre: Point, radius: f64) {
        if let Some(found) = self.matched_element(layer, centre, radius) {
            self.taken[found] = true;
        }
    }

    /// Finds a position for an entity's text and returns its centre, its extent, and the height of its letters: preferably far from all other
    /// elements, otherwise anywhere that the rules assign to the entity. The letter heights are tried in the given order.
    pub fn find_position(
        &mut self,
        entity: usize,
        layer: &str,
        heights: &[f64],
        extent: impl Fn(f64) -> TextSize,
    ) -> Option<(Point, TextSize, f64)> {
        let target = self.candidates.iter().position(|candidate| candidate.entity == Some(entity))?;
        if self.taken[target] {
            return None;
        }
        let rules: [Rule<'a>; 2] = [Self::is_clear_of_others, Self::is_assigned_by_rules];
        let position = rules.iter().find_map(|rule| {
            heights.iter().find_map(|height| {
                let extent = extent(*height);
                let mut positions = self.candidates[target]
                    .pieces
                    .iter()
                    .flat_map(|piece| piece.text_positions(extent.radius));
                let centre =
                    positions.find(|position| rule(self, target, layer, *position, extent.radius))?;
                Some((centre, extent, *height))
            })
        });
        self.taken[target] |= position.is_some();
        position
    }

    /// Whether the circle overlaps the target and keeps well clear of all other elements on the layer that take texts.
    fn is_clear_of_others(&self, target: usize, layer: &str, centre: Point, radius: f64) -> bool {
        let others = self
            .candidates
            .iter()
            .enumerate()
            .filter(|(index, other)| *index != target && other.takes_text && other.layer == layer);
        let mut pieces = others.flat_map(|(_, other)| &other.pieces);
        overlaps(&self.candidates[target], centre, 0.9 * radius)
            && pieces.all(|piece| piece.clearance(centre) > 1.1 * radius + 0.05)
    }

    /// Whether the rules assign the text to the target when texts are read in order, even if the estimated size of the text is slightly off. If the
    /// target takes no text: whether the circle overlaps it, and the rules assign the text to no element.
    fn is_assigned_by_rules(&self, target: usize, layer: &str, centre: Point, radius: f64) -> bool {
        let near = |factor: f64| self.matched_element(layer, centre, factor * radius);
        if self.candidates[target].takes_text {
            [0.95, 1.0, 1.05].into_iter().all(|factor| near(factor) == Some(target))
        } else {
            overlaps(&self.candidates[target], centre, 0.9 * radius) && near(1.05).is_none()
        }
    }

    /// Returns the element that a text circle matches among those that have no text yet.
    fn matched_element(&self, layer: &str, centre: Point, radius: f64) -> Option<usize> {
        let free = self.candidates.iter().enumerate().filter(|(index, candidate)| {
            candidate.takes_text && !self.taken[*index] && candidate.layer == layer
        });
        let overlapped = free.flat_map(|(index, candidate)| {
            let ranks = candidate.pieces.iter().filter_map(|piece| piece.overlapped(centre, radius));
            ranks.map(move |(rank, distance)| (rank, distance, index))
        });
        overlapped.min_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))).map(|(.., index)| index)
    }
}

fn overlaps(candidate: &Candidate, centre: Point, radius: f64) -> bool {
    candidate.pieces.iter().any(|piece| piece.overlapped(centre, radius).is_some())
}

/// Formats the message that there is no room for an element's text.
pub fn no_space_message(text: &str) -> String {
    format!(
        "no place found where the text {text:?} would belong to this element and to no other; \
         give the neighbours texts of their own first, move them apart, or write a `text` or `mtext` line"
    )
}
