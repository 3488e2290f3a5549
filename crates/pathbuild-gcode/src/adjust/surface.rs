//! Compares the moves of a corrected program with the measured surface. (book: language/probes)

use std::collections::BTreeMap;

use pathbuild_diagnostic::messages::probes as messages;
use pathbuild_diagnostic::{Diagnostic, Message, Point};
use pathbuild_motion::{Move, MoveShape, Pace, Position};
use pathbuild_path::Xy;
use pathbuild_path::approx::above;
use pathbuild_toolpath::{MIN_REPORTED_DEVIATION, Surface, ZModel};

use super::Source;
use super::check::{MIN_DIFFERENCE, Values};
use super::scan::lines;
use crate::dialect::Dialect;
use crate::interpret::{Options, interpret_each};
use crate::native::ProgramProbe;

/// The surface of the material according to the measured heights.
pub(super) struct MeasuredSurface {
    model: Surface,
    probes: Vec<MeasuredProbe>,
    /// Least height in mm at which a probe was drawn.
    lowest_drawn: f64,
    /// Greatest difference in mm between a measured and a drawn height.
    greatest_correction: f64,
}

struct MeasuredProbe {
    at: Xy,
    correction: f64,
}

/// A correction of a program's heights: it applies from this line, counted from 1, up to the next correction.
#[derive(Clone, Copy, Debug)]
pub(super) struct AppliedCorrection {
    pub(super) line: u32,
    /// Difference in mm between the corrected and the drawn height.
    pub(super) correction: f64,
}

/// Distance in mm between the points of a rapid move at which it is compared with the surface.
const SAMPLE_DISTANCE: f64 = 1.0;

/// Maximum number of these points, which limits the time that a very long move takes.
const MAX_SAMPLES: f64 = 2000.0;

impl MeasuredSurface {
    /// Creates the surface; `None` unless all probes of the program have a place and a measured height.
    pub(super) fn new(
        stated: &BTreeMap<u32, ProgramProbe>,
        measured: &Values,
        model: ZModel,
    ) -> Option<Self> {
        let probe = |(number, probe): (&u32, &ProgramProbe)| {
            Some(MeasuredProbe { at: probe.at?, correction: measured.get(number)? - probe.height })
        };
        let probes: Vec<MeasuredProbe> = stated.iter().map(probe).collect::<Option<_>>()?;
        let places: Vec<Xy> = probes.iter().map(|probe| probe.at).collect();
        let lowest_drawn = stated.values().map(|probe| probe.height).reduce(f64::min)?;
        let greatest_correction = probes.iter().map(|probe| probe.correction).reduce(f64::max)?;
        Some(Self { model: Surface::new(model, &places), probes, lowest_drawn, greatest_correction })
    }

    fn correction(&self, at: Xy) -> f64 {
        self.model.weights(at).into_iter().map(|(probe, weight)| weight * self.probes[probe].correction).sum()
    }

    /// Returns PB602 for the rapid move that is farthest below the surface over which it leads, if there is one. Descents are not examined: they end
    /// on the surface. Neither are moves that were drawn at the surface or below it: the material there has been milled away.
    pub(super) fn rapid_below_surface_problem(
        &self,
        program: Source<'_>,
        applied: &[AppliedCorrection],
    ) -> Option<Diagnostic> {
        let mut deepest: Option<(u32, f64, SurfacePoint)> = None;
        each_move(program, &mut |line, motion| {
            if motion.pace != Pace::Rapid || motion.is_vertical() {
                return;
            }
            let z = motion.from.z().min(motion.to.z());
            if !above(z - correction_at(applied, line), self.lowest_drawn) {
                return;
            }
            let Some(point) = self.highest_along(motion, z).filter(|point| !above(z, point.z)) else {
                return;
            };
            if deepest.as_ref().is_none_or(|(_, known, below)| point.z - z > below.z - known) {
                deepest = Some((line, z, point));
            }
        });
        let (line, z, point) = deepest?;
        let problem = problem_of_line(program, line, &messages::SWEEP_INTO_MEASURED)?;
        Some(problem.with("z", z).with("surface", point.z).with("at", Point::new(point.at.x, point.at.y)))
    }

    /// Returns the highest point of the surface under a rapid move; `None` if even the greatest correction leaves the surface below this height.
    fn highest_along(&self, motion: &Move, z: f64) -> Option<SurfacePoint> {
        let [from, to] = [xy(&motion.from), xy(&motion.to)];
        let point = |at: Xy| SurfacePoint { at, z: self.lowest_drawn + self.correction(at) };
        let (start, end) = (point(from), point(to));
        let highest = (self.lowest_drawn + self.greatest_correction).max(start.z).max(end.z);
        if above(z, highest) {
            return None;
        }
        let way = to - from;
        let beside = self.probes.iter().map(|probe| (probe.at - from).dot(&way) / way.norm_squared());
        let count = (way.norm() / SAMPLE_DISTANCE).ceil().min(MAX_SAMPLES);
        let evenly = (1..).map(f64::from).take_while(|number| *number < count).map(|number| number / count);
        let shares = beside.filter(|share| (0.0..=1.0).contains(share)).chain(evenly);
        let points = shares.map(|share| point(from + share * way)).chain([end]);
        Some(points.fold(start, |highest, point| if point.z > highest.z { point } else { highest }))
    }

    /// Returns PB606 for the cut whose end is corrected most differently from what was measured there, if the difference matters.
    pub(super) fn stale_correction_problem(
        &self,
        program: Source<'_>,
        applied: &[AppliedCorrection],
    ) -> Option<Diagnostic> {
        let mut greatest: Option<(u32, f64, Xy)> = None;
        each_move(program, &mut |line, motion| {
            let at = xy(&motion.to);
            let off = correction_at(applied, line) - self.correction(at);
            let is_cut = matches!(motion.pace, Pace::Feed(_));
            if is_cut
                && above(off.abs(), MIN_REPORTED_DEVIATION)
                && greatest.is_none_or(|(_, known, _)| off.abs() > known.abs())
            {
                greatest = Some((line, off, at));
            }
        });
        let (line, off, at) = greatest?;
        let message = if off > 0.0 { &messages::END_TOO_HIGH } else { &messages::END_TOO_LOW };
        let problem = problem_of_line(program, line, message)?;
        Some(problem.with("off", off.abs()).with("at", Point::new(at.x, at.y)))
    }
}

/// The heights to which the cuts of a program go, by place.
pub(super) struct CutDepths {
    /// The place of the move in each line that cuts.
    places: BTreeMap<u32, CutPlace>,
    /// The least height in mm at each place.
    lowest: BTreeMap<CutPlace, f64>,
}

/// The ends of a move in ascending order, and the centre of its arc, in micrometres. All passes along an element have the same ends. A vertical move
/// begins and ends at one point, which is also that of the other moves that begin or end there.
type CutPlace = [i64; 6];

impl CutDepths {
    pub(super) fn of(program: Source<'_>) -> Self {
        let mut depths = Self { places: BTreeMap::new(), lowest: BTreeMap::new() };
        each_move(program, &mut |line, motion| {
            if !matches!(motion.pace, Pace::Feed(_)) {
                return;
            }
            depths.places.insert(line, cut_place(motion));
            let ends = [motion.from, motion.to];
            let points = ends.map(|end| (point_place(&end), end.z()));
            let whole = (cut_place(motion), motion.from.z().min(motion.to.z()));
            for (place, z) in points.into_iter().chain([whole]) {
                let lowest = depths.lowest.entry(place).or_insert(z);
                *lowest = lowest.min(z);
            }
        });
        depths
    }

    /// Whether some cut goes deeper at the place of the cut in a line, which ends at this height.
    pub(super) fn is_deeper(&self, line: u32, height: f64) -> bool {
        let lowest = self.places.get(&line).and_then(|place| self.lowest.get(place));
        lowest.is_some_and(|lowest| *lowest < height - MIN_DIFFERENCE)
    }
}

fn cut_place(motion: &Move) -> CutPlace {
    let [from, to] = [&motion.from, &motion.to].map(|end| [end.x(), end.y()].map(micrometres));
    let (first, last) = (from.min(to), from.max(to));
    let centre = match motion.shape {
        MoveShape::Arc(arc) => arc.centre.map(micrometres),
        MoveShape::Line => [0, 0],
    };
    [first[0], first[1], last[0], last[1], centre[0], centre[1]]
}

fn point_place(at: &Position) -> CutPlace {
    let [x, y] = [at.x(), at.y()].map(micrometres);
    [x, y, x, y, 0, 0]
}

#[expect(clippy::cast_possible_truncation, reason = "saturates")]
fn micrometres(length: f64) -> i64 {
    (1000.0 * length).round() as i64
}

/// Returns the correction that applies in a line.
fn correction_at(applied: &[AppliedCorrection], line: u32) -> f64 {
    let number = applied.partition_point(|correction| correction.line <= line);
    number.checked_sub(1).map_or(0.0, |last| applied[last].correction)
}

struct SurfacePoint {
    at: Xy,
    z: f64,
}

fn xy(position: &Position) -> Xy {
    Xy::new(position.x(), position.y())
}

/// Passes each move of a native program whose ends are known to `take`, with its line. The heights are those in the text, to which the machine moves.
fn each_move(program: Source<'_>, take: &mut dyn FnMut(u32, &Move)) {
    interpret_each(program.bytes, Dialect::Native, &Options::default(), &mut |step| {
        if let Some((line, motion)) = step.as_move().filter(|(_, motion)| motion.is_known()) {
            take(line, &motion);
        }
    });
}

fn problem_of_line(program: Source<'_>, number: u32, message: &'static Message) -> Option<Diagnostic> {
    let line = lines(program).find(|line| line.number == number)?;
    Some(line.fault(message, 0..line.content().len()))
}
