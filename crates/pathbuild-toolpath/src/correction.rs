//! Decides which moves are corrected by probes, and splits them. (book: language/probes)

use std::borrow::Cow;

use nalgebra::{Complex, UnitComplex};
use pathbuild_path::Xy;

use crate::program::{Count, Height, MoveClass, PlannedMove, Program, ProgramStep, Tip};
use crate::z_model::{Triangulation, ZModel};

/// The method by which the heights of a program with probes are corrected.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Correction {
    /// Model of the surface between the probes.
    pub model: ZModel,
    /// Maximum length in mm of the parts into which moves are split, each with a corrected height of its own; with 0, moves are not split.
    pub longest: f64,
}

/// A point at which the program mills outside the area of the probes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnprobedPoint {
    /// The point in program coordinates.
    pub at: Xy,
    /// Distance from the convex hull of the probes, in mm.
    pub distance: f64,
}

/// Distance in mm outside the area of the probes up to which milling is not reported. Numbers in programs are not more precise.
const NEGLIGIBLE_DISTANCE: f64 = 0.001;

/// Length in mm of the parts that [`Correction::farthest_unprobed_point`] examines if moves are not split.
const SAMPLE_LENGTH: f64 = 20.0;

impl Correction {
    /// Whether the correction is that of PathDxf2GCode, which corrects a move by the value at its start, and a helical circle by the
    /// value at its centre.
    pub fn is_compatible(self) -> bool {
        self.model == ZModel::Idw4 && self.longest <= 0.0
    }

    /// Returns the steps of a program with probes, split and with each height corrected at the end of its move. Programs without probes, and those
    /// corrected as by PathDxf2GCode, are returned unchanged.
    pub fn steps(self, program: &Program) -> Cow<'_, [ProgramStep]> {
        if program.probes.is_empty() || self.is_compatible() {
            return Cow::Borrowed(&program.steps);
        }
        Cow::Owned(split_steps(program, self.longest).collect())
    }

    /// Returns the number of steps returned by [`steps`](Self::steps), without computing them; saturates.
    pub fn count(self, program: &Program) -> u64 {
        if program.probes.is_empty() || self.is_compatible() {
            return program.steps.len() as u64;
        }
        let steps = steps_or_moves(program, self.longest).map(|(before, cut)| {
            u64::from(before.is_some()).saturating_add(cut.map_or(0, |cut| cut.pieces()))
        });
        steps.fold(0, u64::saturating_add)
    }

    /// Whether the probes of a program do not determine a slope that the model needs.
    pub fn lacks_slope(self, program: &Program) -> bool {
        let places: Vec<Xy> = program.probes.iter().map(|probe| probe.at).collect();
        self.model.lacks_slope(&places)
    }

    /// Returns the point farthest outside the area of the probes (their convex hull) at which the program mills; `None` if it mills only inside, if
    /// there are no probes, and for [`ZModel::Idw4`].
    pub fn farthest_unprobed_point(self, program: &Program) -> Option<UnprobedPoint> {
        if program.probes.is_empty() || self.model == ZModel::Idw4 {
            return None;
        }
        let places: Vec<Xy> = program.probes.iter().map(|probe| probe.at).collect();
        let hull = Triangulation::new(&places);
        let longest = if self.longest > 0.0 { self.longest } else { SAMPLE_LENGTH };
        let milled = split_steps(program, longest).filter_map(|step| milled_point(&step));
        let distances = milled.map(|at| UnprobedPoint { at, distance: hull.distance(at) });
        let farthest = distances.reduce(|far, other| if other.distance > far.distance { other } else { far });
        farthest.filter(|outside| outside.distance > NEGLIGIBLE_DISTANCE)
    }
}

fn split_steps(program: &Program, longest: f64) -> impl Iterator<Item = ProgramStep> + '_ {
    steps_or_moves(program, longest).flat_map(|(before, cut)| {
        let pieces = cut.into_iter().flat_map(|cut| (1..=cut.pieces()).map(move |number| cut.piece(number)));
        before.into_iter().chain(pieces)
    })
}

/// Yields comments unchanged, and moves as moves to be split, each with the corrected lift that must precede it, if any.
fn steps_or_moves(
    program: &Program,
    longest: f64,
) -> impl Iterator<Item = (Option<ProgramStep>, Option<SplitMove>)> {
    let mut tool = Tip { at: Xy::origin(), z: program.start_height() };
    let mut is_settled = true;
    program.steps.iter().map(move |step| match step {
        ProgramStep::Comment(_) => (Some(*step), None),
        ProgramStep::Move { to, count } => {
            let begins_here = matches!(to, PlannedMove::Line { .. } | PlannedMove::Arc { .. });
            let settling = (begins_here && !is_settled).then(|| corrected_lift(tool));
            is_settled = !matches!(to, PlannedMove::Sweep { .. });
            let cut = SplitMove::new(tool, *to, *count, longest);
            tool = to.end(tool);
            (settling, Some(cut))
        }
    })
}

/// Creates a lift to the height corrected for the tool's current position: after a sweep the tool is still at the corrected height of its previous
/// position, but a step that mills at once, such as a helical circle, must begin at the height corrected for its own position.
fn corrected_lift(tool: Tip) -> ProgramStep {
    let count = Count { class: MoveClass::Sweep, length: 0.0, feed: None };
    ProgramStep::Move { to: PlannedMove::Lift { z: Height { z: tool.z, at: tool.at } }, count }
}

/// Returns the point at which a step cuts material; `None` if it cuts nothing.
fn milled_point(step: &ProgramStep) -> Option<Xy> {
    match step {
        ProgramStep::Move { to: PlannedMove::Line { to, .. } | PlannedMove::Arc { to, .. }, .. } => Some(*to),
        ProgramStep::Move { to: PlannedMove::Drill { z: Height { at, .. }, .. }, .. } => Some(*at),
        _ => None,
    }
}

// Splits a move into parts, each of which ends at the height that the move has at that point.

/// Deviation of a part of an arc from its chord, as a fraction of the maximum length, up to which the part is not divided. Within a part the height
/// changes linearly along the arc, whereas that of a tilted plate changes linearly along the chord. The error is at most the tilt times this
/// deviation.
const MAX_CHORD_DEPARTURE: f64 = 0.01;

/// Largest rounding error in the number of parts: a move of exactly n maximum lengths is not divided into n + 1 parts.
const PART_COUNT_TOLERANCE: f64 = 1e-9;

/// A move and the number of parts it is split into.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SplitMove {
    from: Tip,
    to: PlannedMove,
    count: Count,
    pieces: u64,
}

impl SplitMove {
    /// Divides a move that begins at the position `from`. `longest` is the maximum length of a part in mm; with 0, the move stays whole.
    pub(crate) fn new(from: Tip, to: PlannedMove, count: Count, longest: f64) -> Self {
        let parts = match to {
            _ if longest <= 0.0 => 1.0,
            PlannedMove::Line { .. } => count.length / longest,
            PlannedMove::Arc { centre, .. } => {
                let radius = centre.coords.norm();
                // The deviation of an arc is radius * (1 - cos(angle / 2)), approximately radius * angle² / 8.
                let angle = libm::sqrt(8.0 * MAX_CHORD_DEPARTURE * longest / radius);
                (count.length / longest).max(count.length / radius / angle)
            }
            PlannedMove::Sweep { .. } | PlannedMove::Lift { .. } | PlannedMove::Drill { .. } => 1.0,
        };
        Self { from, to, count, pieces: round_up(parts - PART_COUNT_TOLERANCE) }
    }

    /// Returns the number of parts, at least 1.
    pub(crate) fn pieces(&self) -> u64 {
        self.pieces
    }

    /// Returns the part with this number, from 1, with the height corrected at its end.
    pub(crate) fn piece(&self, number: u64) -> ProgramStep {
        let Tip { at: to, z } = self.position_after(number);
        let z = Height { z, at: to };
        let moved = match self.to {
            PlannedMove::Sweep { .. } => PlannedMove::Sweep { to },
            PlannedMove::Lift { .. } => PlannedMove::Lift { z },
            PlannedMove::Drill { feed, .. } => PlannedMove::Drill { feed, z },
            PlannedMove::Line { feed, .. } => PlannedMove::Line { feed, to, z },
            PlannedMove::Arc { feed, clockwise, centre, is_spiral, .. } => {
                let centre = (self.from.at + centre.coords - self.position_after(number - 1).at).into();
                // The native dialect writes half circles of a spiral with I0, but parts of half circles with their real I.
                let is_spiral = is_spiral && self.pieces == 1;
                PlannedMove::Arc { feed, clockwise, centre, to, z, is_spiral }
            }
        };
        ProgramStep::Move {
            to: moved,
            count: Count { length: self.count.length / self.pieces as f64, ..self.count },
        }
    }

    /// Returns the position of the tool after this number of parts.
    fn position_after(&self, number: u64) -> Tip {
        let end = self.to.end(self.from);
        if number == self.pieces {
            return end;
        }
        let part = number as f64 / self.pieces as f64;
        let at = match self.to {
            PlannedMove::Arc { centre, clockwise, .. } => self.along_arc(centre, clockwise, part),
            _ => self.from.at + (end.at - self.from.at) * part,
        };
        Tip { at, z: self.from.z + (end.z - self.from.z) * part }
    }

    fn along_arc(&self, centre: Xy, clockwise: bool, part: f64) -> Xy {
        let angle = self.count.length / centre.coords.norm() * part;
        let (sin, cos) = libm::sincos(if clockwise { -angle } else { angle });
        self.from.at + centre.coords + UnitComplex::new_unchecked(Complex::new(cos, sin)) * -centre.coords
    }
}

/// Rounds up, to at least 1.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates, and is positive")]
fn round_up(parts: f64) -> u64 {
    parts.ceil().max(1.0) as u64
}
