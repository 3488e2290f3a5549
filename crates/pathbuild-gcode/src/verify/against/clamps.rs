//! Checks whether a program hits the clamps of its drawing. (book: language/keep-outs)

use pathbuild_diagnostic::messages::walk as say;
use pathbuild_diagnostic::{Diagnostic, Point, Text, words};
use pathbuild_motion::{Action, Axes, Move, Pace, Path, Plane, Step};
use pathbuild_path::{Arc, Curve, KeepOut, KeepOutMap, Line, Way, Xy};

use super::cuts::{CHORD, PLACE};
use crate::dialect::Dialect;
use crate::read::Problems;

/// Clamps in program coordinates, and the tool that must not hit them.
#[derive(Debug)]
pub struct Clamps {
    all: Vec<KeepOut>,
    map: KeepOutMap,
    radius: f64,
}

/// Compares the steps of a program with clamps: pass every step, then call [`finish`](Self::finish).
#[derive(Debug)]
pub struct PastClamps<'c> {
    clamps: &'c Clamps,
    /// The effect of rounding in mm. A move that touches a clamp in the drawing may be written slightly inside it.
    slack: f64,
    problems: Problems,
}

impl Clamps {
    /// Creates clamps at their positions, for a cutter with the given diameter in mm.
    pub fn new(clamps: Vec<KeepOut>, cutter: f64) -> Self {
        let map = KeepOutMap::new(clamps.iter().map(|clamp| (clamp.height, &*clamp.outline)));
        Self { all: clamps, map, radius: cutter / 2.0 }
    }
}

impl<'c> PastClamps<'c> {
    /// Starts at the beginning of a program in this dialect.
    pub fn new(clamps: &'c Clamps, dialect: Dialect) -> Self {
        let chord = if dialect.rules().arcs.helix { 0.0 } else { CHORD };
        Self { clamps, slack: PLACE + chord, problems: Problems::default() }
    }

    /// Passes the next step of the program.
    pub fn step(&mut self, step: &Step) {
        let Action::Move(it) = &step.action else { return };
        let Some(way) = way(it) else { return };
        let Clamps { all, map, radius } = self.clamps;
        for clamp in map.entered(&way, *radius, self.slack) {
            let KeepOut { layer, at, height, .. } = &all[clamp];
            self.problems.add_at_line(&say::LINE_INTO_CLAMP, step.line, |found| {
                found
                    .with("tool", 2.0 * radius)
                    .quoting("layer", layer.as_str())
                    .with("clamp", Point::new(at.x, at.y))
                    .with("height", *height)
                    .with("what", word(it))
                    .with("z", way.lowest())
            });
        }
    }

    /// Returns the collisions found, ordered by line.
    pub fn finish(self) -> Vec<Diagnostic> {
        self.problems.into_diagnostics()
    }
}

/// The movement of a move, as far as it is known. If only its end is known, that point; `None` if even that is unknown.
fn way(it: &Move) -> Option<Way> {
    let [from, to] = [it.from, it.to].map(|end| Xy::new(end.x(), end.y()));
    if !it.to.known.has(Axes::ALL) {
        return None;
    }
    let to_z = it.to.z();
    let from_z = if it.from.known.has(Axes::Z) { it.from.z() } else { to_z };
    if !it.from.known.has(Axes::XY) {
        return Some(Way { curve: Curve::Line(Line { start: to, end: to }), from_z, to_z });
    }
    let straight = Curve::Line(Line { start: from, end: to });
    let Path::Arc(arc) = it.path else { return Some(Way { curve: straight, from_z, to_z }) };
    let radius = arc.radius(&it.from);
    if arc.plane != Plane::Xy {
        // Seen from above the arc is a straight line. Use its lowest point for all of it.
        let lowest = from_z.min(to_z).min(arc.centre[1] - radius).min(arc.centre[0] - radius);
        return Some(Way { curve: straight, from_z: lowest, to_z: lowest });
    }
    let degrees = arc.sweep(&it.from, &it.to).to_degrees().min(360.0);
    let centre = Xy::new(arc.centre[0], arc.centre[1]);
    let curve = Curve::Arc(Arc { centre, radius, start: from, end: to, clockwise: arc.clockwise, degrees });
    let lowest = from_z.min(to_z);
    // An arc with several turns reaches each point at several heights.
    let (from_z, to_z) = if arc.extra_turns > 0 { (lowest, lowest) } else { (from_z, to_z) };
    Some(Way { curve, from_z, to_z })
}

fn word(it: &Move) -> &'static Text {
    match it.pace {
        Pace::Rapid => &words::RAPID_MOVE,
        Pace::Probe { .. } => &words::PROBING_MOVE,
        Pace::Feed(_) if it.from.at[..2] == it.to.at[..2] && it.path == Path::Line => &words::PLUNGE,
        Pace::Feed(_) => &words::CUT,
    }
}
