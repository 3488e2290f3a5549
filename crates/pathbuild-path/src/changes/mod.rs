//! The drawn differences between two versions of a path, as far as they can change the moves of its program. (book: program/comparing)
//!
//! Elements are paired by kind and place first, then by handle, and then by those parts of their geometry that did not change. Their order and
//! their numbers in the file do not matter, nor does the place of the whole path on its sheet.

mod item;
mod pairing;

use std::collections::BTreeMap;

use pathbuild_diagnostic::{Point, Sentence, Text, Value, drawn_changes as texts};

use crate::element::diagnostic_point;
use crate::element_parameters::ElementParameters;
use crate::geometry::Xy;
use crate::raw::{RawPath, SourceMap};

use item::{Item, items, shape_changes};
use pairing::{Frame, pair};

/// One side of a comparison: a path as drawn.
#[derive(Clone, Copy, Debug)]
pub struct DrawnSide<'a> {
    /// The path as drawn.
    pub raw: &'a RawPath,
    /// The positions of the path's elements in the file.
    pub positions: &'a SourceMap,
    /// The effective parameters of the path: [`element_parameters`](crate::element_parameters).
    pub parameters: &'a [ElementParameters],
}

/// The drawn differences between two versions of a path.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DrawnChanges {
    /// The changes that can affect the moves, ordered by kind of element and place. Equal changes of several elements count as one change.
    pub changes: Vec<DrawnChange>,
    /// Whether only the order of the elements in the file has changed, which decides between segments that the walk could traverse equally well.
    pub is_reordered: bool,
}

/// A change that applies to one or more elements alike.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnChange {
    /// The kind of the elements.
    pub kind: ElementKind,
    /// The change that all of these elements have in common.
    pub change: ElementChange,
    /// Number of elements with this change.
    pub count: usize,
    /// The start or centre of the first element in the new drawing; in the old one if it was removed.
    pub at: Point,
    /// The end of that element, if it is a line or an arc: at a corner, several elements have the same start.
    pub end: Option<Point>,
}

/// The kind of an element, as the user of a CAD program knows it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[expect(missing_docs, reason = "glossary in book: reference/glossary")]
pub enum ElementKind {
    Start,
    End,
    Turn,
    Probe,
    Circle,
    Line,
    Arc,
}

/// A change of an element. Lengths are in mm.
#[derive(Clone, Debug, PartialEq)]
pub enum ElementChange {
    /// The element is only in the new drawing.
    Added,
    /// The element is only in the old drawing.
    Removed,
    /// The element was moved by this vector, relative to the path's start.
    Moved([f64; 2]),
    /// One end of the element was moved by this vector.
    EndMoved([f64; 2]),
    /// The shape of the element was changed in another way.
    Reshaped,
    /// The circle's diameter before and after.
    Diameter([f64; 2]),
    /// The arc's radius before and after.
    Radius([f64; 2]),
    /// The line type before and after, by its usual name.
    LineType([&'static str; 2]),
    /// The parameters in the element's text that differ, before and after. Either may be empty.
    Text([String; 2]),
}

/// Compares two versions of a path. Changes that cannot affect its moves are left out: comments, materials, texts or line types with the same
/// meaning, and the place of the whole path.
pub fn drawn_changes(old: DrawnSide<'_>, new: DrawnSide<'_>) -> DrawnChanges {
    let (old_items, new_items) = (items(old), items(new));
    let frame = Frame::between(&old_items, &new_items);
    let pairs = pair(&old_items, &new_items, &frame);
    let mut found: Vec<ItemChange<'_>> = Vec::new();
    for (was, is) in &pairs.both {
        found.extend(element_changes(was, is, &frame).into_iter().map(|change| (*is, change)));
    }
    found.extend(item::start_text(old, new).and_then(|change| {
        let start = new_items.iter().find(|item| item.kind == ElementKind::Start)?;
        Some((start, change))
    }));
    found.extend(pairs.removed.iter().map(|item| (*item, ElementChange::Removed)));
    found.extend(pairs.added.iter().map(|item| (*item, ElementChange::Added)));
    let is_reordered = found.is_empty() && pairs.is_reordered();
    DrawnChanges { changes: group_changes(found), is_reordered }
}

/// A change with its element in the new drawing, or in the old drawing if the element was removed.
type ItemChange<'i> = (&'i Item<'i>, ElementChange);

fn element_changes(old: &Item<'_>, new: &Item<'_>, frame: &Frame) -> Vec<ElementChange> {
    let mut changes: Vec<ElementChange> = shape_changes(&old.shape, &new.shape, frame.shift).collect();
    changes.extend(old.line_type_change(new).map(ElementChange::LineType));
    changes.extend(old.text_change(new).map(ElementChange::Text));
    changes
}

/// Groups equal changes of elements of one kind. A group has the position of its first element, by X and then by Y.
fn group_changes(mut found: Vec<ItemChange<'_>>) -> Vec<DrawnChange> {
    found.sort_by(|(one, _), (other, _)| compare_positions(one.kind, one.at(), other.kind, other.at()));
    let mut groups: Vec<DrawnChange> = Vec::new();
    let mut numbers: BTreeMap<(ElementKind, String), usize> = BTreeMap::new();
    for (item, change) in found {
        let number = *numbers.entry((item.kind, change.key())).or_insert(groups.len());
        match groups.get_mut(number) {
            Some(group) => group.count += 1,
            None => {
                groups.push(DrawnChange {
                    kind: item.kind,
                    change,
                    count: 1,
                    at: diagnostic_point(item.at()),
                    end: item.end().map(diagnostic_point),
                });
            }
        }
    }
    groups
}

fn compare_positions(kind: ElementKind, at: Xy, other_kind: ElementKind, other: Xy) -> std::cmp::Ordering {
    kind.cmp(&other_kind).then(at.x.total_cmp(&other.x)).then(at.y.total_cmp(&other.y))
}

impl ElementChange {
    /// The name of the change in JSON.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Added => "added",
            Self::Removed => "removed",
            Self::Moved(_) => "moved",
            Self::EndMoved(_) => "end-moved",
            Self::Reshaped => "reshaped",
            Self::Diameter(_) => "diameter",
            Self::Radius(_) => "radius",
            Self::LineType(_) => "line-type",
            Self::Text(_) => "text",
        }
    }

    /// A key that is equal for changes with the same text.
    fn key(&self) -> String {
        format!("{}{:?}", self.name(), self.arguments())
    }

    fn text(&self) -> &'static Text {
        match self {
            Self::Added => &texts::ADDED,
            Self::Removed => &texts::REMOVED,
            Self::Moved(_) => &texts::MOVED,
            Self::EndMoved(_) => &texts::END_MOVED,
            Self::Reshaped => &texts::RESHAPED,
            Self::Diameter(_) => &texts::DIAMETER,
            Self::Radius(_) => &texts::RADIUS,
            Self::LineType(_) => &texts::LINE_TYPE,
            Self::Text([was, _]) if was.is_empty() => &texts::TEXT_ADDED,
            Self::Text([_, now]) if now.is_empty() => &texts::TEXT_REMOVED,
            Self::Text(_) => &texts::TEXT,
        }
    }

    fn arguments(&self) -> Vec<(&'static str, Value)> {
        let pair = |[was, now]: [Value; 2]| vec![("was", was), ("now", now)];
        match self {
            Self::Added | Self::Removed | Self::Reshaped => Vec::new(),
            Self::Moved([x, y]) | Self::EndMoved([x, y]) => vec![("by", Point::new(*x, *y).into())],
            Self::Diameter(values) | Self::Radius(values) => pair(values.map(Value::from)),
            Self::LineType(names) => pair(names.map(Value::quoted)),
            Self::Text(texts) => pair(texts.each_ref().map(Value::quoted)),
        }
    }
}

impl DrawnChange {
    /// Returns a sentence that describes the change.
    pub fn sentence(&self) -> Sentence {
        let arguments = self.change.arguments();
        let sentence = Sentence::new(self.change.text()).with("what", self.subject());
        arguments.into_iter().fold(sentence, |sentence, (name, value)| sentence.with(name, value))
    }

    /// Returns the subject of the sentence: the number of elements and the place of the first.
    fn subject(&self) -> Sentence {
        let [one, several] = self.kind.texts();
        let text = if self.count == 1 { one } else { several };
        let sentence = Sentence::new(text).with("count", self.count).with("point", self.at);
        self.end.into_iter().fold(sentence, |sentence, end| sentence.with("end", end))
    }
}

impl ElementKind {
    /// The name of the kind in JSON.
    pub fn name(self) -> &'static str {
        match self {
            Self::Start => "start",
            Self::End => "end",
            Self::Turn => "turn",
            Self::Probe => "probe",
            Self::Circle => "circle",
            Self::Line => "line",
            Self::Arc => "arc",
        }
    }

    /// The texts for one element and for several elements of this kind.
    fn texts(self) -> [&'static Text; 2] {
        match self {
            Self::Start => [&texts::START, &texts::START],
            Self::End => [&texts::END, &texts::END],
            Self::Turn => [&texts::TURN, &texts::TURNS],
            Self::Probe => [&texts::PROBE, &texts::PROBES],
            Self::Circle => [&texts::CIRCLE, &texts::CIRCLES],
            Self::Line => [&texts::LINE, &texts::LINES],
            Self::Arc => [&texts::ARC, &texts::ARCS],
        }
    }
}
