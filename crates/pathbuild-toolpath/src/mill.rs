//! Milling along a curve. (book: program/gcode)

use pathbuild_path::Curve;

use crate::fold::{Fold, Parts, Tip};
use crate::program::{Class, Count, Height, Move};

/// A part of a segment with the heights at its ends, in mm.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Section {
    pub(crate) curve: Curve,
    pub(crate) from_z: f64,
    pub(crate) to_z: f64,
}

impl Section {
    /// The section in the opposite direction.
    pub(crate) fn reversed(self) -> Self {
        Self { curve: self.curve.reversed(), from_z: self.to_z, to_z: self.from_z }
    }
}

impl<P: Parts> Fold<'_, P> {
    /// Mills a section, which is in program coordinates, after moving to the height of its start.
    pub(crate) fn mill(&mut self, section: &Section, surface: f64, feed: f64) {
        self.plunge(section.from_z, surface, feed);
        let to = section.curve.end();
        let z = Height { z: section.to_z, at: section.curve.start() };
        let count = Count { class: Class::Milling, length: section.curve.length(), feed: Some(feed) };
        let tip = Tip { at: to, z: section.to_z };
        let to = match section.curve {
            Curve::Line(_) => Move::Line { feed, to, z },
            Curve::Arc(arc) => {
                let centre = (arc.centre - arc.start).into();
                Move::Arc { feed, clockwise: arc.clockwise, centre, to, z, is_spiral: false }
            }
        };
        self.step(to, count, tip);
    }
}
