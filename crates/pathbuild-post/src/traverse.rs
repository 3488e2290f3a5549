//! Checks that a parsed text makes exactly the cuts of a job, and between them only moves that cannot touch material.
//!
//! The rapids of a post need not equal those of the job, although they must when a program is compared with its drawing (`verify --against`). A post
//! may retract the tool higher, or omit moves in the air. A position is considered free of material if the job itself has a rapid at or directly
//! below it, or if it is above the clearance plane.

use std::collections::HashSet;

use pathbuild_diagnostic::messages::posts;
use pathbuild_diagnostic::{Diagnostic, Text, Value};
use pathbuild_gcode::verify::{Difference, DifferenceKind, Tolerance, compare};
use pathbuild_motion::{Axes, Move, MoveShape, Pace, Position};
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

type NumberedMoves<'m> = &'m [(u32, Move)];
type TraverseResult<T> = Result<T, Box<Diagnostic>>;

/// A cut that was found in the text: its line, and the number (from 1) of the job's step that it belongs to. All cuts of a line belong to
/// the same step.
pub(crate) type MatchedCut = (u32, u32);

/// Compares parsed moves with those of the job and returns the matched cuts in order. `clearance` is the height in mm of the clearance
/// plane.
pub(crate) fn check(
    found: NumberedMoves<'_>,
    expected: NumberedMoves<'_>,
    clearance: f64,
    tolerance: &Tolerance,
) -> TraverseResult<Vec<MatchedCut>> {
    if let Some(blind) = first_unknown_cut(expected) {
        return Err(Box::new(Diagnostic::new(&posts::CUT_AT_UNKNOWN_PLACE).with("step", u64::from(blind))));
    }
    let found = without_excursions(found, 2.0 * tolerance.place);
    let (mut found, mut expected) = (found.as_slice(), expected);
    let mut matched: Vec<MatchedCut> = Vec::new();
    // End of the last cut, and the step of the job that it belongs to.
    let (mut end, mut step) = (None, None);
    loop {
        let (rapids, cuts) = split(expected, is_rapid);
        let traverse = ExpectedTraverse::new(rapids, clearance, 2.0 * tolerance.place);
        let Some(next) = cuts.first() else {
            traverse.check_after_last_cut(found, end)?;
            return Ok(matched);
        };
        let length = traverse.length(found, next)?;
        traverse.check(&found[..length])?;
        if step == Some(next.0) {
            traverse.check_peck(&found[..length])?;
        }
        let (run, rest) = split(cuts, |movement| !is_rapid(movement));
        found = &found[length..];
        let (run_moves, after) = found.split_at(matching_cut_length(found, run, tolerance)?);
        match_cuts(run_moves, run, tolerance, &mut matched);
        end = run_moves.last().map(|(_, movement)| movement.to).or(end);
        step = run.last().map(|(step, _)| *step);
        found = after;
        expected = rest;
    }
}

/// Returns the number of the first cut from or to an unknown position, which cannot be compared. Only the machine knows where a probe has stopped, so
/// the move away from there is compared by its end alone.
fn first_unknown_cut(moves: NumberedMoves<'_>) -> Option<u32> {
    let mut has_probed = false;
    for (number, movement) in moves {
        let is_known = movement.to.known == Axes::ALL && (movement.from.known == Axes::ALL || has_probed);
        if !is_rapid(movement) && !is_known {
            return Some(*number);
        }
        has_probed = matches!(movement.pace, Pace::Probe { .. });
    }
    None
}

fn is_rapid(movement: &Move) -> bool {
    movement.pace == Pace::Rapid
}

/// Splits moves into those at the beginning that satisfy a condition, and the rest.
fn split(
    moves: NumberedMoves<'_>,
    is_wanted: impl Fn(&Move) -> bool,
) -> (NumberedMoves<'_>, NumberedMoves<'_>) {
    let length = moves.iter().take_while(|(_, movement)| is_wanted(movement)).count();
    moves.split_at(length)
}

/// Removes excursions: rapids that retract the tool and return it to the same position.
fn without_excursions(moves: NumberedMoves<'_>, slack: f64) -> Vec<(u32, Move)> {
    let mut kept = Vec::with_capacity(moves.len());
    let mut rest = moves;
    while let Some((_, first)) = rest.first() {
        let (run, behind) = split(rest, |movement| is_rapid(movement) == is_rapid(first));
        rest = behind;
        let returns = is_rapid(first)
            && run.iter().all(|(_, movement)| {
                movement.named.is_none()
                    && movement.from.known == Axes::ALL
                    && is_above(&movement.to, &first.from, slack)
            })
            && run.last().is_some_and(|(_, last)| last.to.z() <= first.from.z() + slack);
        if !returns {
            kept.extend_from_slice(run);
        }
    }
    kept
}

/// Whether a position equals another one or is directly above it.
fn is_above(place: &Position, other: &Position, slack: f64) -> bool {
    is_same_in_plane(&place.at, &other.at, slack) && place.z() >= other.z() - slack
}

fn is_same_in_plane(a: &[f64; 3], b: &[f64; 3], slack: f64) -> bool {
    (a[0] - b[0]).abs() <= slack && (a[1] - b[1]).abs() <= slack
}

/// Returns the number of moves at the beginning of `found` that make the expected cuts.
fn matching_cut_length(
    found: NumberedMoves<'_>,
    expected: NumberedMoves<'_>,
    tolerance: &Tolerance,
) -> TraverseResult<usize> {
    // A move to an unknown position is not a cut of the job. The check of the moves between cuts decides whether it is allowed.
    let (run, _) = split(found, |movement| !is_rapid(movement) && movement.to.known == Axes::ALL);
    match compare(run, expected, tolerance) {
        None => Ok(run.len()),
        // The expected cuts are complete. The remaining moves may be rapids of the job that the post writes at feed.
        Some(Difference { found: Some(next), expected: None, .. }) => {
            Ok(run.iter().position(|movement| *movement == next).unwrap_or(run.len()))
        }
        Some(difference) => Err(Box::new(describe(&difference))),
    }
}

/// Maximum number of steps that one move may comprise if the post joins straight moves.
const MAX_JOINED_STEPS: usize = 64;

/// Finds the step of each move in a run of cuts that equals the expected one. The runs may be divided into moves differently, so moves are
/// matched by their ends.
fn match_cuts(
    found: NumberedMoves<'_>,
    expected: NumberedMoves<'_>,
    tolerance: &Tolerance,
    matched: &mut Vec<MatchedCut>,
) {
    let mut rest = expected;
    for (line, movement) in found {
        let Some((step, _)) = rest.first().or(expected.last()) else { return };
        if matched.last().is_none_or(|(last, _)| last != line) {
            matched.push((*line, *step));
        }
        let slack = 2.0 * tolerance.place;
        let ends_there = |(_, step): &(u32, Move)| {
            (0..3).all(|axis| (step.to.at[axis] - movement.to.at[axis]).abs() <= slack)
        };
        if let Some(index) = rest.iter().take(MAX_JOINED_STEPS).position(ends_there) {
            rest = &rest[index + 1..];
        }
    }
}

/// Converts a difference to a diagnostic. It has the line of the text, because the job has no lines.
fn describe(difference: &Difference) -> Diagnostic {
    let diagnostic = match (&difference.found, &difference.expected) {
        (Some((_, found)), Some((_, expected))) => match difference.kind {
            DifferenceKind::Place if place(found) == place(expected) => {
                Diagnostic::new(&posts::GOES_ANOTHER_WAY).with("place", place(found))
            }
            DifferenceKind::Place => Diagnostic::new(&posts::GOES_ELSEWHERE)
                .with("found", place(found))
                .with("expected", place(expected)),
            DifferenceKind::Shape => Diagnostic::new(&posts::GOES_ANOTHER_WAY).with("place", place(found)),
            DifferenceKind::Pace => Diagnostic::new(&posts::GOES_AT_ANOTHER_PACE)
                .with("found", found.pace.word())
                .with("expected", expected.pace.word()),
            DifferenceKind::Feed => Diagnostic::new(&posts::GOES_WITH_ANOTHER_FEED)
                .with("found", found.pace.feed().unwrap_or(0.0))
                .with("expected", expected.pace.feed().unwrap_or(0.0)),
        },
        (Some((_, found)), None) => {
            Diagnostic::new(&posts::GOES_TOO_FAR).with("found", found.pace.word()).with("place", place(found))
        }
        (None, _) => Diagnostic::new(&posts::MOVES_LOST),
    };
    diagnostic.at_line(difference.found.map(|(line, _)| line), None)
}

/// Returns the error for a cut after the last one of the job.
fn extra_cut_error(cut: (u32, Move)) -> Box<Diagnostic> {
    let found = Some(cut);
    Box::new(describe(&Difference { kind: DifferenceKind::Place, found, expected: None }))
}

/// Returns the end of a move for a message, without its unknown axes.
fn place(movement: &Move) -> Value {
    place_of(&movement.to)
}

fn place_of(at: &Position) -> Value {
    let known = (0..3).filter(|axis| at.known.has(Axes::of(*axis)));
    let axis = |axis: usize| format!("{}{:.3}", ["X", "Y", "Z"][axis], at.at[axis]);
    let known: Vec<String> = known.map(axis).collect();
    if known.is_empty() {
        return Value::Prose(&Text { en: "an unknown place", de: "einem unbekannten Ort" });
    }
    Value::quoted(known.join(" "))
}

/// The rapids of the job between two consecutive cuts.
struct ExpectedTraverse<'m> {
    expected: NumberedMoves<'m>,
    clearance: f64,
    slack: f64,
    /// Spatial index of the moves. There may be thousands of them, and each parsed move is compared with those nearby.
    places: RTree<GeomWithData<Rectangle<[f64; 2]>, usize>>,
}

impl<'m> ExpectedTraverse<'m> {
    fn new(expected: NumberedMoves<'m>, clearance: f64, slack: f64) -> Self {
        // Skip repeated moves: they add no information.
        let mut seen = HashSet::new();
        let mut is_new = |movement: &Move| {
            let places = [movement.from, movement.to].map(|at| (at.known, at.at.map(f64::to_bits)));
            seen.insert((places, movement.named.is_some()))
        };
        let indexed = expected.iter().enumerate().filter(|(_, (_, movement))| is_new(movement));
        let place = |(index, (_, movement)): (usize, &(u32, Move))| {
            GeomWithData::new(
                Rectangle::from_corners(in_plane(&movement.from), in_plane(&movement.to)),
                index,
            )
        };
        let places = RTree::bulk_load(indexed.map(place).collect());
        Self { expected, clearance, slack, places }
    }

    /// Returns the moves of the job that may pass over the rectangle between two corners.
    fn near(&self, corners: [[f64; 2]; 2]) -> impl Iterator<Item = &Move> {
        let [low, high] = [f64::min as fn(f64, f64) -> f64, f64::max]
            .map(|choose| [0, 1].map(|axis| choose(corners[0][axis], corners[1][axis])));
        let area = AABB::from_corners(low.map(|at| at - self.slack), high.map(|at| at + self.slack));
        self.places.locate_in_envelope_intersecting(area).map(|place| &self.expected[place.data].1)
    }

    /// Returns the number of moves at the beginning of `found` that lead to the start of the next cut.
    fn length(&self, found: NumberedMoves<'_>, next: &(u32, Move)) -> TraverseResult<usize> {
        let begin = &next.1.from;
        if begin.known != Axes::ALL {
            return Ok(split(found, is_rapid).0.len());
        }
        let is_there = |at: &Position| {
            at.known == Axes::ALL
                && is_same_in_plane(&at.at, &begin.at, self.slack)
                && (at.z() - begin.z()).abs() <= self.slack
        };
        let place = |index: usize| match found.get(index) {
            Some((_, movement)) => Some(movement.from),
            None => found.last().map(|(_, movement)| movement.to),
        };
        let goes_on = |index: usize| found.get(index).is_some_and(|(_, movement)| is_rapid(movement));
        let is_end = |index: &usize| !goes_on(*index) && place(*index).as_ref().is_some_and(is_there);
        let begins = (0..=found.len()).find(is_end);
        // The line of the cut is nearer to the fault than the first of the moves that lead to it.
        let first_cut = || found.iter().find(|(_, movement)| !is_rapid(movement)).or(found.first());
        begins.ok_or_else(|| self.difference(first_cut().copied(), Some(*next)))
    }

    fn difference(&self, found: Option<(u32, Move)>, expected: Option<(u32, Move)>) -> Box<Diagnostic> {
        let expected = expected.or_else(|| self.expected.last().copied());
        Box::new(describe(&Difference { kind: DifferenceKind::Place, found, expected }))
    }

    /// Checks that each move is one of the job's own rapids, a straight lift to a machine position, or free of obstacles.
    fn check(&self, found: NumberedMoves<'_>) -> TraverseResult<()> {
        let mut is_home = false;
        for &(line, movement) in found {
            let is_fine = match movement.named {
                Some(_) => self.is_lift(&movement) || self.is_free(&movement, is_home),
                None if self.is_expected(&movement) => true,
                None => {
                    matches!(movement.pace, Pace::Rapid | Pace::Feed(_))
                        && movement.shape == MoveShape::Line
                        && self.is_free(&movement, is_home)
                }
            };
            if !is_fine {
                return Err(self.not_free_error(line, &movement));
            }
            // After a move to a machine position, the height is unknown, but the tool is above everything.
            is_home = !movement.to.known.has(Axes::Z) && (movement.named.is_some() || is_home);
        }
        Ok(())
    }

    /// Checks that the tool leaves the hole between two pecks: only holes have several cuts in one step of the job.
    fn check_peck(&self, found: NumberedMoves<'_>) -> TraverseResult<()> {
        let highest = |moves: NumberedMoves<'_>| {
            moves.iter().map(|(_, movement)| movement.to.z()).fold(f64::NEG_INFINITY, f64::max)
        };
        let (found_height, expected) = (highest(found), highest(self.expected));
        let leaves = found.iter().any(|(_, movement)| !movement.to.known.has(Axes::Z));
        if leaves || found_height >= expected - self.slack {
            return Ok(());
        }
        let problem = Diagnostic::new(&posts::PECK_STAYS_IN_HOLE).with("found", found_height);
        let line = found.first().map(|(line, _)| *line);
        Err(Box::new(problem.with("expected", expected).at_line(line, None)))
    }

    /// Returns the error for a move between two cuts that the job does not contain and that may hit material.
    fn not_free_error(&self, line: u32, movement: &Move) -> Box<Diagnostic> {
        if !is_rapid(movement) && self.expected.is_empty() {
            return extra_cut_error((line, *movement));
        }
        let diagnostic = Diagnostic::new(&posts::WAY_NOT_FREE).with("found", movement.pace.word());
        let diagnostic = diagnostic.with("from", place_of(&movement.from)).with("to", place(movement));
        Box::new(diagnostic.at_line(line, None))
    }

    /// Checks the moves after the last cut. There must be no further cuts, and the tool must end as high as in the job, or at the clearance plane if
    /// that is lower. As between two cuts, a rapid of the job may be written at feed.
    fn check_after_last_cut(&self, found: NumberedMoves<'_>, end: Option<Position>) -> TraverseResult<()> {
        let is_high = |movement: &Move| movement.from.z().min(movement.to.z()) >= self.clearance - self.slack;
        if let Some(cut) = found.iter().find(|(_, movement)| !is_rapid(movement) && is_high(movement)) {
            return Err(extra_cut_error(*cut));
        }
        self.check(found)?;
        let Some((end, (_, expected))) = end.zip(self.expected.last()) else { return Ok(()) };
        // A rapid that does not move is not in the output: the tool is there already.
        let end = found.last().map_or(end, |(_, movement)| movement.to);
        let is_high = !end.known.has(Axes::Z) || end.z() >= expected.to.z().min(self.clearance) - self.slack;
        if is_high { Ok(()) } else { Err(self.difference(found.last().copied(), None)) }
    }

    /// Whether a move is one of the job's own rapids, with the same start and end.
    fn is_expected(&self, movement: &Move) -> bool {
        let is_same = |a: &Position, b: &Position| {
            let is_near =
                |axis: usize| (a.at[axis] - b.at[axis]).abs() <= self.slack || !a.known.has(Axes::of(axis));
            a.known == b.known && (0..3).all(is_near)
        };
        let end = in_plane(&movement.to);
        is_rapid(movement)
            && self.near([end, end]).any(|expected| {
                is_same(&expected.from, &movement.from) && is_same(&expected.to, &movement.to)
            })
    }

    /// Whether a move leads straight up to a machine position.
    fn is_lift(&self, movement: &Move) -> bool {
        let stays = movement.to.known.has(Axes::XY)
            && is_same_in_plane(&movement.from.at, &movement.to.at, self.slack);
        let is_unknown = !movement.from.known.has(Axes::XY) && !movement.to.known.has(Axes::XY);
        (stays || is_unknown) && !movement.to.known.has(Axes::Z)
    }

    /// Whether a straight move is free of obstacles. `is_home` means that it begins at an unknown height above everything.
    fn is_free(&self, movement: &Move, is_home: bool) -> bool {
        let height = |at: &Position| {
            if at.known.has(Axes::Z) { Some(at.z()) } else { is_home.then_some(f64::INFINITY) }
        };
        let is_vertical = movement.from.known.has(Axes::XY)
            && movement.to.known.has(Axes::XY)
            && is_same_in_plane(&movement.from.at, &movement.to.at, self.slack)
            || !movement.from.known.has(Axes::XY) && !movement.to.known.has(Axes::XY);
        let lowest = match (height(&movement.from), height(&movement.to)) {
            (Some(from), Some(to)) => from.min(to),
            // Of a move from an unknown height, only the end is compared.
            (None, Some(to)) => to,
            _ => return false,
        };
        if lowest >= self.clearance - self.slack {
            return true;
        }
        if !movement.is_known() {
            if self.job_has_lower_move(movement, lowest) {
                return true;
            }
            // A descent from above everything must be vertical and end above a known position.
            return movement.to.known == Axes::ALL
                && is_vertical
                && self
                    .lowest_rapid_height(&movement.to.at)
                    .is_some_and(|floor| lowest >= floor - self.slack);
        }
        if is_vertical {
            if movement.to.z() >= movement.from.z() {
                return true;
            }
            return self
                .lowest_rapid_height(&movement.to.at)
                .is_some_and(|floor| lowest >= floor - self.slack);
        }
        self.is_covered(&movement.from.at, &movement.to.at)
    }

    /// Whether the job itself has a move to the same position that is no higher and whose start is known in the same axes.
    fn job_has_lower_move(&self, movement: &Move, lowest: f64) -> bool {
        let end = in_plane(&movement.to);
        self.near([end, end]).any(|expected| {
            let highest = expected.from.z().max(expected.to.z());
            expected.named.is_none()
                && expected.from.known.has(Axes::Z)
                && expected.from.known == movement.from.known
                && expected.to.known == Axes::ALL
                && movement.to.known == Axes::ALL
                && is_same_in_plane(&expected.to.at, &movement.to.at, self.slack)
                && highest <= lowest + self.slack
        })
    }

    /// Returns the straight moves of the job between known positions that may pass over the rectangle between two corners.
    fn straight_moves_near(&self, corners: [[f64; 2]; 2]) -> impl Iterator<Item = ([f64; 3], [f64; 3])> {
        self.near(corners)
            .filter(|movement| movement.is_known() && movement.named.is_none())
            .map(|movement| (movement.from.at, movement.to.at))
    }

    /// Returns the lowest height at which the job moves across a position, seen from above; `None` if it does not.
    fn lowest_rapid_height(&self, place: &[f64; 3]) -> Option<f64> {
        let here = [[place[0], place[1]]; 2];
        let ends =
            self.near(here).map(|movement| movement.to).filter(|to| to.known == Axes::ALL).map(|to| to.at);
        let begins = self.straight_moves_near(here).map(|(from, _)| from);
        let over = ends.chain(begins).filter(|at| is_same_in_plane(at, place, self.slack)).map(|at| at[2]);
        let along = self.straight_moves_near(here).filter_map(|(from, to)| {
            let share = nearest_fraction(&from, &to, place)?.clamp(0.0, 1.0);
            let at = point_at_fraction(&from, &to, share);
            is_same_in_plane(&at, place, self.slack).then_some(at[2])
        });
        over.chain(along).reduce(f64::min)
    }

    /// Whether the part of a straight move that is below the clearance plane runs above moves of the job everywhere.
    fn is_covered(&self, from: &[f64; 3], to: &[f64; 3]) -> bool {
        let length = libm::hypot(to[0] - from[0], to[1] - from[1]);
        let grain = self.slack / length;
        let low = range_below(from[2], to[2], self.clearance - self.slack);
        let legs = self.straight_moves_near([[from[0], from[1]], [to[0], to[1]]]);
        let mut spans: Vec<[f64; 2]> = legs.filter_map(|leg| self.span(from, to, low, leg)).collect();
        spans.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let reached = spans.iter().fold(low[0], |reached, span| {
            if span[0] <= reached + grain { reached.max(span[1]) } else { reached }
        });
        reached >= low[1] - grain
    }

    /// Returns the range of a move, as fractions of its length, in which it runs above `leg`, a straight move of the job. `low` is the
    /// range below the clearance plane.
    fn span(
        &self,
        from: &[f64; 3],
        to: &[f64; 3],
        low: [f64; 2],
        leg: ([f64; 3], [f64; 3]),
    ) -> Option<[f64; 2]> {
        let shares = [nearest_fraction(from, to, &leg.0)?, nearest_fraction(from, to, &leg.1)?];
        let begin = shares[0].min(shares[1]).max(low[0]);
        let end = shares[0].max(shares[1]).min(low[1]);
        let is_above_leg = |share: f64| {
            let at = point_at_fraction(from, to, share);
            let along = nearest_fraction(&leg.0, &leg.1, &at).map_or(0.0, |along| along.clamp(0.0, 1.0));
            let other = point_at_fraction(&leg.0, &leg.1, along);
            is_same_in_plane(&at, &other, self.slack) && at[2] >= other[2] - self.slack
        };
        (begin <= end && is_above_leg(begin) && is_above_leg(end)).then_some([begin, end])
    }
}

/// Projects a position to the plane; unknown coordinates become 0.
fn in_plane(at: &Position) -> [f64; 2] {
    [0, 1].map(|axis| if at.known.has(Axes::of(axis)) { at.at[axis] } else { 0.0 })
}

/// Returns the range, as fractions of a move, in which a linearly changing height is below `height`.
fn range_below(from: f64, to: f64, height: f64) -> [f64; 2] {
    let crossing = if from == to { 0.0 } else { ((height - from) / (to - from)).clamp(0.0, 1.0) };
    match (from < height, to < height) {
        (true, true) => [0.0, 1.0],
        (true, false) => [0.0, crossing],
        (false, true) => [crossing, 1.0],
        (false, false) => [0.0, 0.0],
    }
}

/// Returns the fraction of a line's length, in the plane, at which it is nearest to a position; `None` for a vertical line.
fn nearest_fraction(from: &[f64; 3], to: &[f64; 3], place: &[f64; 3]) -> Option<f64> {
    let along = [to[0] - from[0], to[1] - from[1]];
    let square = along[0] * along[0] + along[1] * along[1];
    (square > 0.0).then(|| ((place[0] - from[0]) * along[0] + (place[1] - from[1]) * along[1]) / square)
}

fn point_at_fraction(from: &[f64; 3], to: &[f64; 3], share: f64) -> [f64; 3] {
    [0, 1, 2].map(|axis| from[axis] + share * (to[axis] - from[axis]))
}

#[cfg(test)]
mod tests {
    use pathbuild_gcode::dialect::Dialect::LinuxCnc;
    use pathbuild_gcode::interpret::{Options, interpret};
    use pathbuild_gcode::verify::Tolerance;
    use pathbuild_motion::Move;

    use super::check;

    /// Height in mm of the clearance plane.
    const CLEARANCE: f64 = 20.0;

    /// Value in mm of the last digit; a rapid may deviate by two roundings of it.
    const DIGIT: f64 = 0.001;

    fn moves(program: &str) -> Vec<(u32, Move)> {
        interpret(program.as_bytes(), LinuxCnc, &Options::default()).moves()
    }

    /// A program of two cuts, 10 mm long at Z0; the second begins at (X50, Y0). The arguments are the rapids to the first cut, between the
    /// cuts, and after the second.
    fn program([to, between, away]: [&str; 3]) -> String {
        let line = |words: &str| words.replace(", ", "\n") + "\n";
        format!(
            "G21 G90 G17 G94\n{}G1 Z0 F100\nX10\n{}G1 Z0\nX60\n{}M2\n",
            line(to),
            line(between),
            line(away)
        )
    }

    /// Rapids of the job. After the first cut it moves up to Z10, to X30, up to Z12, to X50 and down to Z5; after the second, up to Z20
    /// and to X80.
    const JOB: [&str; 3] =
        ["G0 Z20, G0 X0 Y0, G0 Z5", "G0 Z10, G0 X30, G0 Z12, G0 X50, G0 Z5", "G0 Z20, G0 X80"];

    #[track_caller]
    fn is_allowed(ways: [&str; 3]) -> bool {
        let check = |ways| {
            check(&moves(&program(ways)), &moves(&program(JOB)), CLEARANCE, &Tolerance::of_decimals(3))
                .is_ok()
        };
        assert!(check(JOB), "the job itself");
        check(ways)
    }

    /// Whether a text is accepted if these are its rapids from the first cut to the second, and all others are those of the job.
    #[track_caller]
    fn may_go(between: &str) -> bool {
        is_allowed([JOB[0], between, JOB[2]])
    }

    #[test]
    fn a_way_is_judged_wherever_the_part_lies() {
        let [to, between, away] = JOB;
        let to = to.replace("Y0", "Y100");
        let job = moves(&program([&to, between, away]));
        let may_go = |between: &str| {
            let found = moves(&program([&to, between, away]));
            check(&found, &job, CLEARANCE, &Tolerance::of_decimals(3)).is_ok()
        };
        assert!(may_go("G0 Z12, G0 X50, G0 Z5"));
        assert!(!may_go("G0 Z11.9, G0 X50, G0 Z5"));
    }

    #[test]
    fn a_way_may_be_higher_or_leave_out_steps() {
        assert!(may_go("G0 Z20, G0 X50, G0 Z5"));
        assert!(may_go("G0 Z12, G0 X50, G0 Z5"));
        assert!(may_go("G0 Z12, G0 X20, G0 X45, G0 X50, G0 Z5"));
        // Above the clearance plane there is no material.
        assert!(may_go("G0 Z20, G0 X20 Y30, G0 X50 Y0, G0 Z5"));
        assert!(!may_go("G0 Z19.9, G0 X20 Y30, G0 X50 Y0, G0 Z5"));
    }

    #[test]
    fn a_way_runs_nowhere_below_the_jobs() {
        let low = 10.0 - DIGIT;
        assert!(may_go(&format!("G0 Z{:.4}, G0 X30, G0 Z12, G0 X50, G0 Z5", low + DIGIT / 10.0)));
        assert!(!may_go(&format!("G0 Z{:.4}, G0 X30, G0 Z12, G0 X50, G0 Z5", low - DIGIT / 10.0)));
        // Between X30 and X50 the job is at Z12.
        assert!(!may_go("G0 Z11.9, G0 X50, G0 Z5"));
        assert!(!may_go("G0 Z10, G0 X50 Z12, G0 Z5"));
        assert!(may_go("G0 Z10, G0 X30 Z12, G0 X50, G0 Z5"));
    }

    #[test]
    fn a_way_runs_nowhere_beside_the_jobs() {
        assert!(!may_go("G0 Z12, G0 X30 Y0.1, G0 X50 Y0, G0 Z5"));
        assert!(may_go(&format!("G0 Z12, G0 X30 Y{:.4}, G0 X50 Y0, G0 Z5", 0.9 * DIGIT)));
        assert!(!may_go("G0 Z12, G0 X55, G0 X50, G0 Z5"));
        // An arc that begins and ends on a rapid of the job runs beside this rapid.
        assert!(may_go("G0 Z12, G1 X50 F100, G0 Z5"));
        assert!(!may_go("G0 Z12, G2 X50 I20 J0 F100, G0 Z5"));
        assert!(!may_go("G0 Z12, G0 X5, G0 X50, G0 Z5"));
    }

    #[test]
    fn a_way_down_ends_where_the_job_has_been() {
        assert!(may_go("G0 Z12, G0 X40, G0 Z12, G0 X50, G0 Z5"));
        assert!(!may_go("G0 Z20, G0 X40, G0 Z11.9, G0 Z12, G0 X50, G0 Z5"));
        assert!(!may_go("G0 Z12, G0 X50, G0 Z4.9, G0 Z5"));
        // A feed instead of a rapid is slower, but not dangerous.
        assert!(may_go("G0 Z12, G0 X50, G1 Z5 F100"));
    }

    /// After a move straight up to a machine position, the tool is above everything.
    #[test]
    fn a_place_of_the_machine_is_above_everything() {
        assert!(is_allowed(["G53 G0 Z0, G0 X0 Y0, G0 Z5", JOB[1], JOB[2]]));
        assert!(may_go("G53 G0 Z0, G0 X50, G0 Z5"));
        assert!(!may_go("G53 G0 Z0, G0 X40, G0 Z5, G0 X50"));
        assert!(!may_go("G53 G0 X0 Z0, G0 X50 Y0, G0 Z5"));
    }

    #[test]
    fn the_tool_ends_as_high_as_in_the_job() {
        assert!(is_allowed([JOB[0], JOB[1], "G0 Z20"]));
        assert!(is_allowed([JOB[0], JOB[1], "G0 Z25, G0 X90"]));
        assert!(!is_allowed([JOB[0], JOB[1], "G0 Z19.9"]));
        assert!(!is_allowed([JOB[0], JOB[1], "G0 Z20, G1 X70"]));
    }

    /// The output leaves out a rapid that does not move.
    #[test]
    fn a_cut_may_end_as_high_as_the_last_rapid() {
        let may_end = |found: &str, job: &str| {
            let program = |away| format!("G21 G90 G17 G94\nG0 Z20\nG0 X0 Y0\nG1 Z0 F100\nX10\n{away}\nM2\n");
            let [found, job] = [found, job].map(|away| moves(&program(away)));
            check(&found, &job, CLEARANCE, &Tolerance::of_decimals(3)).is_ok()
        };
        assert!(may_end("G1 Z20", "G1 Z20\nG0 Z20"));
        assert!(!may_end("G1 Z19.9", "G1 Z19.9\nG0 Z20"));
    }

    /// The job comes to (X0, Y0) from an unknown position at Z19.
    #[test]
    fn the_first_rapid_may_descend_to_the_height_of_the_jobs() {
        let [_, between, away] = JOB;
        let may_come = |to: &str| {
            let [found, job] = [to, "G0 Z19, G0 X0 Y0, G0 Z5"].map(|to| moves(&program([to, between, away])));
            check(&found, &job, CLEARANCE, &Tolerance::of_decimals(3)).is_ok()
        };
        assert!(may_come("G0 Z20, G0 X0 Y0 Z19, G0 Z5"));
        assert!(!may_come("G0 Z20, G0 X0 Y0 Z18.9, G0 Z5"));
        assert!(!may_come("G0 Z20, G0 X1 Y0 Z19, G0 X0, G0 Z5"));
    }

    #[test]
    fn the_tool_may_be_lifted_from_a_cut() {
        let lifted = |lift: &str| {
            let text = program(JOB);
            let first = text.find("X10\n").expect("the end of the first cut");
            format!("{}X4\n{lift}\nG1 {}", &text[..first], &text[first..])
        };
        let is_same = |text: &str| {
            check(&moves(text), &moves(&program(JOB)), CLEARANCE, &Tolerance::of_decimals(3)).is_ok()
        };
        for lift in ["G0 Z3\nG0 Z0", "G0 Z3\nG0 X4.0005\nG0 Z0.0005", "G0 Z30\nG0 Z-0.0005"] {
            assert!(is_same(&lifted(lift)), "{lift}");
        }
        for lift in ["G0 Z3", "G0 Z3\nG0 Z0.0015", "G0 X4.0015\nG0 X4", "G0 Z-0.0015\nG0 Z0"] {
            assert!(!is_same(&lifted(lift)), "{lift}");
        }
    }
}
