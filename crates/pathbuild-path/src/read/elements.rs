//! The elements of a path while they are read in file order: kept apart by what comes first as a segment.
//! (spec/50-path-building.md, "Segments")

use crate::element::{Element, Shape};
use crate::geometry::Curve;

/// All circles, lines and arcs.
#[derive(Default)]
pub(crate) struct Elements {
    circles: Vec<Element>,
    lines: Vec<Element>,
    arcs: Vec<Element>,
}

/// Where an element is among them.
#[derive(Clone, Copy)]
pub(crate) enum Place {
    Circle(usize),
    Line(usize),
    Arc(usize),
}

impl Elements {
    /// The place of the next element of this shape.
    pub(super) fn next(&self, shape: &Shape) -> Place {
        match shape {
            Shape::Circle { .. } => Place::Circle(self.circles.len()),
            Shape::Curve(Curve::Line(_)) => Place::Line(self.lines.len()),
            Shape::Curve(Curve::Arc(_)) => Place::Arc(self.arcs.len()),
        }
    }

    pub(super) fn push(&mut self, element: Element) {
        match element.shape {
            Shape::Circle { .. } => self.circles.push(element),
            Shape::Curve(Curve::Line(_)) => self.lines.push(element),
            Shape::Curve(Curve::Arc(_)) => self.arcs.push(element),
        }
    }

    pub(super) fn get_mut(&mut self, place: Place) -> &mut Element {
        match place {
            Place::Circle(index) => &mut self.circles[index],
            Place::Line(index) => &mut self.lines[index],
            Place::Arc(index) => &mut self.arcs[index],
        }
    }

    /// Takes all of them in the order of segments.
    pub(super) fn take_in_order(&mut self, elements: &mut Vec<Element>) {
        let kinds = [&mut self.circles, &mut self.lines, &mut self.arcs];
        elements.reserve(kinds.iter().map(|kind| kind.len()).sum());
        for kind in kinds {
            elements.append(kind);
        }
    }

    /// For how many there is room.
    pub(super) fn room(&self) -> usize {
        self.circles.capacity() + self.lines.capacity() + self.arcs.capacity()
    }
}
