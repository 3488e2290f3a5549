//! Finds arcs given by R that are nearly half circles, whose centres depend on the last digit of R. (book: program/reading)
//!
//! Posts omit trailing zeros: in a program with `X20.1234`, `R10.` means 10.0000. The last digit is therefore that of the program's finest
//! length, which is known only at its end.

use std::collections::BTreeMap;

use pathbuild_diagnostic::messages::gcode as say;

use crate::read::{Problems, SourcePosition};

/// Shift of the centre in mm, caused by the last digit of R, above which an arc is doubtful.
const MAX_CENTRE_SHIFT: f64 = 0.05;

/// Shift of the centre, in units of the last digit, up to which an arc is not doubtful: the coordinates of the program are hardly more exact.
/// With this value, arcs of up to about 120° are not doubtful.
const MAX_AMPLIFICATION: f64 = 2.0;

/// Number of decimals with which no arc that a machine can mill is doubtful.
const SUFFICIENT_DECIMALS: u8 = 9;

/// The arcs of a program that may be doubtful.
#[derive(Debug, Default)]
pub(super) struct DoubtfulArcs {
    /// The largest number of decimals among the lengths that were read.
    finest: u8,
    /// The problems of arcs, by the number of decimals from which on an arc is no longer doubtful.
    found: BTreeMap<u8, Problems>,
}

/// An arc given by R, with lengths in mm.
#[derive(Clone, Copy, Debug)]
pub(super) struct ArcByRadius {
    pub(super) radius: f64,
    pub(super) half_chord: f64,
    /// Length of the program's unit.
    pub(super) unit: f64,
    pub(super) decimals: u8,
}

impl DoubtfulArcs {
    pub(super) fn add_length(&mut self, decimals: u8) {
        self.finest = self.finest.max(decimals);
    }

    pub(super) fn add_arc(&mut self, arc: ArcByRadius, at: SourcePosition<'_>) {
        if arc.half_chord > arc.radius {
            return;
        }
        let known = self.finest.max(arc.decimals);
        let Some(coarse) = (known..SUFFICIENT_DECIMALS).rfind(|decimals| arc.is_doubtful(*decimals)) else {
            return;
        };
        self.found.entry(coarse + 1).or_default().add(&say::NEAR_HALF_CIRCLE, at, |d| {
            d.with("shift", arc.shift(coarse)).with("change", arc.unit_of_last_digit(coarse))
        });
    }

    /// Returns the problems of arcs for which the program has too few decimals.
    pub(super) fn finish(self) -> Problems {
        let mut problems = Problems::default();
        let doubtful = self.found.into_iter().filter(|(needed, _)| *needed > self.finest);
        doubtful.for_each(|(_, found)| problems.append(found));
        problems
    }
}

impl ArcByRadius {
    fn unit_of_last_digit(&self, decimals: u8) -> f64 {
        self.unit * libm::pow(10.0, -f64::from(decimals))
    }

    fn is_doubtful(&self, decimals: u8) -> bool {
        self.shift(decimals) > MAX_CENTRE_SHIFT.max(MAX_AMPLIFICATION * self.unit_of_last_digit(decimals))
    }

    /// Returns how far the centre moves if R is greater by one unit of its last digit.
    fn shift(&self, decimals: u8) -> f64 {
        let greater = self.radius + self.unit_of_last_digit(decimals);
        height_over_chord(greater, self.half_chord) - height_over_chord(self.radius, self.half_chord)
    }
}

/// Returns the distance from the centre of an arc to its chord.
pub(super) fn height_over_chord(radius: f64, half_chord: f64) -> f64 {
    libm::sqrt((radius * radius - half_chord * half_chord).max(0.0))
}
