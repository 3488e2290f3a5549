//! Compares cuts move by move, and the rapid moves between two cuts as a whole.

use std::iter::Peekable;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::gcode;
use pathbuild_motion::{Axes, Move, MoveShape, Pace, Position};
use pathbuild_toolpath::LAST_DIGIT_SLACK;

use crate::dialect::Dialect;
use crate::verify::compare::{
    Difference, DifferenceKind, Ends, Stretch, Tolerance, are_similar_lengths, check_pace, check_shape,
    meeting_fraction,
};
use crate::verify::is_near;

/// Permitted difference of positions in mm: two roundings to the third decimal, and the unit by which an arc may be extended to keep it from becoming
/// a full circle.
pub(super) const POSITION_TOLERANCE: f64 = 0.0015 * (1.0 + 1e-6);

/// Permitted difference of arc centres in mm: a centre is the sum of two rounded numbers, and its arc begins at the end of the previous one.
const CENTRE_TOLERANCE: f64 = 3.0 * POSITION_TOLERANCE;

/// Greatest distance in mm of chords from their arc, for controls that do not support helices; the post for such controls uses the same value. The
/// post writes as few chords as this permits, so if one is missing, the chord across the gap exceeds it.
pub(super) const CHORD_TOLERANCE: f64 = 0.01;

#[derive(Debug)]
pub(super) struct CutComparison<M: Iterator<Item = (u32, Move)>> {
    expected: Peekable<M>,
    /// Peck depths in mm, each with the number of the expected move from which it applies; `None` if the tool may go down in one stroke.
    pecks: Vec<(u32, Option<f64>)>,
    /// The fraction of the next expected move that the program has already made.
    done: f64,
    /// Height in mm of the bottom of a begun hole when the tool last rose from it; `None` if it has not risen yet.
    left_at: Option<f64>,
    /// The last expected move, if it was a plunge that the program has made.
    finished_plunge: Option<Plunge>,
    /// The finding about the first stroke that is deeper than a peck.
    deep_stroke: Option<Diagnostic>,
    /// The expected position before the next expected move.
    at: Position,
    chain: RapidSequence,
    clearance: f64,
    tolerance: Tolerance,
    /// Whether the control supports helices; otherwise chords replace them.
    takes_helices: bool,
    difference: Option<Difference>,
    /// Number of expected moves that were found.
    equal: usize,
    /// Whether lines may be split, as those corrected by probes are.
    may_split: bool,
    /// Whether the program may go to machine positions before its first and after its last cut.
    may_go_home: bool,
}

impl<M: Iterator<Item = (u32, Move)>> CutComparison<M> {
    pub(super) fn new(
        expected: M,
        pecks: Vec<(u32, Option<f64>)>,
        start: Position,
        clearance: f64,
        dialect: Dialect,
    ) -> Self {
        Self {
            expected: expected.peekable(),
            pecks,
            done: 0.0,
            left_at: None,
            finished_plunge: None,
            deep_stroke: None,
            at: start,
            chain: RapidSequence::new(),
            clearance,
            tolerance: Tolerance {
                place: POSITION_TOLERANCE,
                feed: LAST_DIGIT_SLACK,
                chord: 0.0,
                ends: Ends::All,
            },
            takes_helices: dialect.rules().arcs.helix,
            difference: None,
            equal: 0,
            may_split: dialect == Dialect::Native,
            may_go_home: dialect != Dialect::Native,
        }
    }

    /// Compares the next move of the program.
    pub(super) fn take(&mut self, line: u32, movement: &Move) {
        if self.difference.is_some() {
            return;
        }
        if movement.pace == Pace::Rapid {
            self.chain.push(line, movement);
        } else if self.repeats_last_stroke(movement) {
            self.chain = RapidSequence::after_cut();
        } else if let Err(difference) =
            self.compare_rapids(Some((line, movement))).and_then(|()| self.cut(line, movement))
        {
            self.difference = Some(*difference);
        }
    }

    /// Returns the first difference and the first stroke that is too deep, and the number of expected moves found before the difference.
    pub(super) fn finish(mut self) -> (Vec<Diagnostic>, usize) {
        if self.difference.is_none() {
            self.difference = self.compare_rapids(None).err().map(|difference| *difference);
        }
        let difference = self.difference.or_else(|| {
            let expected = self.expected.next();
            expected.map(|expected| Difference {
                kind: DifferenceKind::Place,
                found: None,
                expected: Some(expected),
            })
        });
        let difference = difference.map(|difference| difference.diagnostic_against_drawing());
        (difference.into_iter().chain(self.deep_stroke).collect(), self.equal)
    }

    /// Compares the rapid moves before this cut, or at the end of the program, with the expected ones.
    fn compare_rapids(&mut self, cut: Option<(u32, &Move)>) -> Result<(), Box<Difference>> {
        let mut chain = std::mem::replace(&mut self.chain, RapidSequence::after_cut());
        let plunge = self.partial_plunge().filter(|_| cut.is_some());
        if let Some((plunge, share)) = plunge.and_then(|plunge| Some((plunge, chain.peck_fraction(&plunge)?)))
        {
            // A lift inside the hole breaks the chip, but does not clear it.
            if chain.highest() >= plunge.movement.from.z() - self.slack_of_height() {
                self.left_at = Some(self.place().z());
            }
            (self.done, chain) = (share, RapidSequence::after_cut());
        }
        let start = self.at;
        let mut expected = Vec::new();
        if self.done == 0.0 {
            while let Some((line, movement)) =
                self.expected.next_if(|(_, movement)| movement.pace == Pace::Rapid)
            {
                self.at = movement.to;
                expected.push((line, movement));
            }
        }
        let is_foot = cut.is_none() && self.expected.peek().is_none();
        let at = self.place();
        let traverse = ExpectedTraverse {
            start,
            expected: &expected,
            is_foot,
            may_go_home: self.may_go_home,
            clearance: self.clearance,
            slack: self.tolerance.place,
        };
        let found = cut.map(|(line, movement)| (line, *movement));
        let next = self.expected.peek().copied().or_else(|| expected.last().copied());
        let (slack, height) = (2.0 * self.tolerance.place, self.slack_of_height());
        let reaches = |movement: &Move| {
            let [x, y, z] = at.at;
            is_near(&movement.from.at, &[x, y, movement.from.z()], slack)
                && libm::fabs(z - movement.from.z()) <= height
        };
        match chain.check(&traverse) {
            Err(deviation) => {
                let RapidDeviation { found, expected } = *deviation;
                let expected = expected.or(next);
                Err(Box::new(Difference { kind: DifferenceKind::Place, found, expected }))
            }
            Ok(()) if cut.is_none_or(|(_, movement)| reaches(movement) || movement.is_standstill()) => {
                self.equal += expected.len();
                Ok(())
            }
            Ok(()) => Err(Box::new(Difference { kind: DifferenceKind::Place, found, expected: next })),
        }
    }

    /// Whether a cut goes once more to the bottom of the hole that the program has just finished. Because of rounding, a cycle may do so if its pecks
    /// reach the bottom exactly.
    fn repeats_last_stroke(&mut self, movement: &Move) -> bool {
        let Some(plunge) = self.finished_plunge else { return false };
        let highest = self.chain.highest();
        let leaves = self
            .expected
            .peek()
            .is_none_or(|(_, next)| next.pace == Pace::Rapid && next.to.z() > highest + self.tolerance.place);
        let slack = 2.0 * self.tolerance.place;
        leaves
            && self.chain.peck_fraction(&plunge).is_some()
            && highest <= plunge.movement.from.z() + slack
            && matches!(movement.pace, Pace::Feed(_))
            && (is_plunge(movement) || movement.is_standstill())
            && is_near(&movement.to.at, &plunge.movement.to.at, slack)
    }

    /// Reports the first stroke of the program that is deeper than a peck of the drawing.
    fn check_stroke(&mut self, line: u32, bottom: f64) {
        let Some((number, expected)) = self.expected.peek().filter(|(_, expected)| is_plunge(expected))
        else {
            return;
        };
        let index = self.pecks.partition_point(|(first, _)| first <= number);
        let Some(peck) = index.checked_sub(1).and_then(|index| self.pecks[index].1) else { return };
        let depth = self.left_at.unwrap_or(expected.from.z()) - bottom;
        if depth > peck + 2.0 * self.tolerance.place && self.deep_stroke.is_none() {
            let found = Diagnostic::new(&gcode::STROKE_TOO_DEEP).with("found", depth).with("expected", peck);
            self.deep_stroke = Some(found.at_line(line, None));
        }
    }

    /// Returns the next expected move if it is a plunge that the program has made in part, and may continue in pecks.
    fn partial_plunge(&mut self) -> Option<Plunge> {
        let (done, slack) = (self.done, self.tolerance.place);
        let (_, movement) = self.expected.peek().filter(|_| done > 0.0)?;
        is_plunge(movement).then_some(Plunge { movement: *movement, done, slack })
    }

    /// Returns the permitted difference in height within the next expected move. The position on that move is determined in the plane, where a
    /// rounding error on a steep arc means a difference in height.
    fn slack_of_height(&mut self) -> f64 {
        let within = self.expected.peek().filter(|_| self.done > 0.0);
        let steepness = within.map_or(0.0, |(_, movement)| Stretch::whole(*movement).steepness());
        2.0 * self.tolerance.place * (1.0 + steepness)
    }

    /// Returns the expected position of the tool.
    fn place(&mut self) -> Position {
        match self.expected.peek() {
            Some((_, movement)) if self.done > 0.0 => {
                let [x, y, z] = movement.point(self.done);
                Position::known(x, y, z)
            }
            _ => self.at,
        }
    }

    fn cut(&mut self, line: u32, movement: &Move) -> Result<(), Box<Difference>> {
        let mut begin = 0.0;
        loop {
            let ours = Stretch::rest(*movement, begin);
            let next = self.expected.peek().copied();
            let differs =
                |kind| Box::new(Difference { kind, found: Some((line, *movement)), expected: next });
            let here = self.place();
            let slack = self.tolerance.place;
            let stands = |stretch: &Stretch| {
                stretch.length <= 4.0 * slack && is_near(&stretch.end(), &here.at, 3.0 * slack)
            };
            let Some((_, expected)) = next.filter(|(_, movement)| movement.pace != Pace::Rapid) else {
                return if stands(&ours) {
                    Ok(())
                } else {
                    Err(differs(next.map_or(DifferenceKind::Place, |_| DifferenceKind::Pace)))
                };
            };
            let theirs = Stretch::rest(expected, self.done);
            let is_helix = theirs.is_arc() && expected.from.z() != expected.to.z();
            let is_chord = is_helix && !self.takes_helices && !ours.is_arc();
            if ours.end_together(&theirs, slack) && !is_chord {
                check_pace(movement, &expected, &self.tolerance).map_err(differs)?;
                self.check_stroke(line, movement.to.z());
                check_shape(&ours, &theirs, 1.0, theirs.radius_error(), &self.tolerance).map_err(differs)?;
                check_centres(movement, &expected).map_err(differs)?;
                self.pass_expected_move(&expected);
                return Ok(());
            }
            if stands(&ours) {
                return Ok(());
            }
            if stands(&theirs) {
                self.pass_expected_move(&expected);
                continue;
            }
            if is_chord {
                check_pace(movement, &expected, &self.tolerance).map_err(differs)?;
                let end = check_chord(&ours, &theirs).map_err(differs)?;
                if end < 1.0 {
                    self.done = end;
                } else {
                    self.pass_expected_move(&expected);
                }
                return Ok(());
            }
            // The parts of a move are of the same kind. An arc that is continued by a line is a different move.
            if ours.is_arc() != theirs.is_arc() {
                return Err(differs(DifferenceKind::Place));
            }
            check_pace(movement, &expected, &self.tolerance).map_err(differs)?;
            check_centres(movement, &expected).map_err(differs)?;
            let are_lines = !ours.is_arc() && !theirs.is_arc();
            let splits = ours.length < theirs.length;
            if are_lines && !(splits && (self.may_split || is_plunge(&expected))) {
                return Err(differs(DifferenceKind::Place));
            }
            if splits {
                self.check_stroke(line, movement.to.z());
                self.done = meeting_fraction(&ours, &theirs, theirs.radius_error(), &self.tolerance)
                    .map_err(differs)?;
                return Ok(());
            }
            begin =
                meeting_fraction(&theirs, &ours, theirs.radius_error(), &self.tolerance).map_err(differs)?;
            self.pass_expected_move(&expected);
        }
    }

    fn pass_expected_move(&mut self, expected: &Move) {
        self.expected.next();
        self.equal += 1;
        self.at = expected.to;
        (self.done, self.left_at) = (0.0, None);
        let plunge = Plunge { movement: *expected, done: 1.0, slack: self.tolerance.place };
        self.finished_plunge = is_plunge(expected).then_some(plunge);
    }
}

/// Checks a chord that replaces the next part of a helix, and returns the fraction of the helix at which it ends.
fn check_chord(chord: &Stretch, rest: &Stretch) -> Result<f64, DifferenceKind> {
    let (end, Some(course)) = (chord.end(), rest.movement.course()) else {
        return Err(DifferenceKind::Shape);
    };
    let is_last = is_near(&end, &rest.end(), POSITION_TOLERANCE)
        && are_similar_lengths(chord.length, rest.length, POSITION_TOLERANCE);
    let share = if is_last { 1.0 } else { rest.nearest(&end, chord.length).ok_or(DifferenceKind::Place)? };
    let [x, y, z] = rest.point(share);
    let height = 2.0 * POSITION_TOLERANCE * (1.0 + rest.steepness());
    if !is_near(&[x, y, 0.0], &[end[0], end[1], 0.0], POSITION_TOLERANCE) || libm::fabs(z - end[2]) > height {
        return Err(DifferenceKind::Place);
    }
    let sweep = course.sweep() * (share - rest.begin);
    let sagitta = course.radius() * (1.0 - libm::cos(sweep / 2.0));
    // The ends of a chord are rounded. An error e of the chord c changes the sagitta s = c^2 / 8r by ce / 4r, for the longest chord allowed
    // e * sqrt(s / 2r).
    let rounding = POSITION_TOLERANCE * libm::sqrt(CHORD_TOLERANCE / (2.0 * course.radius()));
    if sweep < std::f64::consts::PI && sagitta <= CHORD_TOLERANCE + rounding {
        Ok(share)
    } else {
        Err(DifferenceKind::Shape)
    }
}

/// Checks that two arcs have the same centre, which the points of a short arc hardly determine, and the same direction and plane.
fn check_centres(found: &Move, expected: &Move) -> Result<(), DifferenceKind> {
    let (MoveShape::Arc(ours), MoveShape::Arc(theirs)) = (found.shape, expected.shape) else { return Ok(()) };
    let are_near = ours.centre.iter().zip(theirs.centre).all(|(a, b)| libm::fabs(a - b) <= CENTRE_TOLERANCE);
    let turn_alike = ours.clockwise == theirs.clockwise && ours.plane == theirs.plane;
    if are_near && turn_alike { Ok(()) } else { Err(DifferenceKind::Shape) }
}

/// Whether a move goes straight down while it cuts.
fn is_plunge(movement: &Move) -> bool {
    let is_straight = movement.from.x() == movement.to.x() && movement.from.y() == movement.to.y();
    movement.is_known()
        && movement.pace != Pace::Rapid
        && matches!(movement.shape, MoveShape::Line)
        && is_straight
        && movement.to.z() < movement.from.z()
}

/// An expected plunge that the program has partly made.
#[derive(Clone, Copy, Debug)]
struct Plunge {
    movement: Move,
    /// The fraction that the program has made.
    done: f64,
    slack: f64,
}

impl Plunge {
    /// Returns the fraction of the plunge at a height; `None` outside the plunge, or below what the program has cut so far.
    fn fraction_at(&self, z: f64) -> Option<f64> {
        let (top, bottom) = (self.movement.from.z(), self.movement.to.z());
        let share = (top - z) / (top - bottom);
        let slack = self.slack / (top - bottom);
        (-slack..=self.done + slack).contains(&share).then(|| share.clamp(0.0, self.done))
    }

    /// Whether a rapid move stays on the axis of the hole and goes no deeper than the program has cut.
    fn is_in_hole(&self, movement: &Move) -> bool {
        let [x, y, _] = self.movement.from.at;
        let deepest = self.movement.from.z() + self.done * (self.movement.to.z() - self.movement.from.z());
        let is_above =
            |at: &Position| is_near(&at.at, &[x, y, at.z()], self.slack) && at.z() >= deepest - self.slack;
        movement.is_known() && movement.named.is_none() && is_above(&movement.from) && is_above(&movement.to)
    }
}

type NumberedMove = (u32, Move);

/// The first rapid move that deviates from the expected ones.
#[derive(Clone, Copy, Debug)]
struct RapidDeviation {
    /// The move of the program; `None` if an expected move is missing.
    found: Option<NumberedMove>,
    /// The expected move; `None` if none is expected.
    expected: Option<NumberedMove>,
}

/// The rapid moves of a program since the last cut.
#[derive(Debug)]
pub(super) struct RapidSequence {
    moves: Vec<NumberedMove>,
    /// Whether the moves begin the program.
    is_head: bool,
}

/// The expected rapid moves before a cut, or at the end of the program.
#[derive(Debug)]
pub(super) struct ExpectedTraverse<'w> {
    pub(super) start: Position,
    pub(super) expected: &'w [NumberedMove],
    /// Whether the moves end the program.
    pub(super) is_foot: bool,
    /// Whether the program may move to machine positions. The native program may not.
    pub(super) may_go_home: bool,
    /// The start height S0 of the drawing in mm, slightly above the sweep height S. There are no obstacles at or above it.
    pub(super) clearance: f64,
    pub(super) slack: f64,
}

impl RapidSequence {
    pub(super) fn new() -> Self {
        Self { moves: Vec::new(), is_head: true }
    }

    pub(super) fn after_cut() -> Self {
        Self { moves: Vec::new(), is_head: false }
    }

    pub(super) fn push(&mut self, line: u32, movement: &Move) {
        self.moves.push((line, *movement));
    }

    /// Returns the greatest height in mm that the moves reach.
    fn highest(&self) -> f64 {
        self.moves.iter().map(|(_, movement)| movement.to.z()).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Returns the fraction of a plunge at which these moves end, if they are the moves between two pecks: up in the hole and down again, no deeper
    /// than the program has cut.
    fn peck_fraction(&self, plunge: &Plunge) -> Option<f64> {
        let (_, last) = self.moves.last()?;
        let stays = self.moves.iter().all(|(_, movement)| plunge.is_in_hole(movement));
        plunge.fraction_at(last.to.z()).filter(|_| stays)
    }

    /// Checks the moves against the expected ones. The error is the first deviation.
    fn check(&self, traverse: &ExpectedTraverse<'_>) -> Result<(), Box<RapidDeviation>> {
        if !self.is_head {
            return Self::check_rest(&self.moves, traverse.expected, traverse);
        }
        let begins_elsewhere =
            |found| Box::new(RapidDeviation { found, expected: Some(traverse.arrival_at_start()) });
        let mut outcome = Err(begins_elsewhere(self.moves.first().copied()));
        for (passed, place) in traverse.clear_places().enumerate() {
            let rest = self.moves_after_arrival(&place, passed > 0, traverse);
            let Some(rest) = rest.map_err(|found| begins_elsewhere(Some(found)))? else { continue };
            outcome = Self::check_rest(rest, &traverse.expected[passed..], traverse);
            if outcome.is_ok() {
                break;
            }
        }
        outcome
    }

    /// Checks that moves are the expected ones; at the end of the program, further harmless moves are permitted.
    fn check_rest(
        moves: &[NumberedMove],
        expected: &[NumberedMove],
        traverse: &ExpectedTraverse<'_>,
    ) -> Result<(), Box<RapidDeviation>> {
        let mut found = moves.iter().filter(|(_, movement)| !traverse.is_too_short(movement));
        for expected in expected.iter().filter(|(_, movement)| !traverse.is_too_short(movement)) {
            let next = found.next();
            let is_same = |(_, movement): &NumberedMove| traverse.is_same(movement, &expected.1);
            if !next.is_some_and(is_same) {
                return Err(Box::new(RapidDeviation { found: next.copied(), expected: Some(*expected) }));
            }
        }
        match found.find(|(_, movement)| !(traverse.is_foot && traverse.is_harmless(movement))) {
            None => Ok(()),
            Some(other) => Err(Box::new(RapidDeviation { found: Some(*other), expected: None })),
        }
    }

    /// Returns the moves after the program has reached `place`, where the expected moves may begin; `None` if the program does not reach it. If the
    /// place `is_later` than the start, it must be reached from a known height. The error is an earlier move that is not harmless.
    fn moves_after_arrival(
        &self,
        place: &Position,
        is_later: bool,
        traverse: &ExpectedTraverse<'_>,
    ) -> Result<Option<&[NumberedMove]>, NumberedMove> {
        let begins = |(_, movement): &NumberedMove| {
            let is_raised = !is_later || movement.from.known.has(Axes::Z);
            movement.to.known == Axes::ALL && traverse.is_near(&movement.to, place) && is_raised
        };
        let Some(arrival) = self.moves.iter().position(begins) else { return Ok(None) };
        let (head, rest) = self.moves.split_at(arrival + 1);
        let mut is_parked = false;
        for (line, movement) in head {
            is_parked |= movement.named.is_some();
            // The height at the beginning is unknown, so the tool must be raised before it moves in the plane.
            let is_raised = movement.from.known.has(Axes::Z) || movement.to.known.has(Axes::Z) || is_parked;
            if !is_raised || !traverse.is_harmless(movement) {
                return Err((*line, *movement));
            }
        }
        Ok(Some(rest))
    }
}

impl ExpectedTraverse<'_> {
    /// Whether a move before the start or after the end is harmless: at the start height S0 over positions of the expected moves, or to a machine
    /// position.
    fn is_harmless(&self, movement: &Move) -> bool {
        let is_raised = !movement.from.known.has(Axes::Z) || self.is_clear(movement.from.z());
        let stays = movement.to.known.has(Axes::XY)
            && movement.from.known.has(Axes::XY)
            && self.is_at(&movement.from, &movement.to);
        if movement.named.is_some() {
            return self.may_go_home && (is_raised || stays);
        }
        let is_height =
            !movement.to.known.has(Axes::Z) || self.is_same_height(movement.to.z(), self.clearance);
        let is_place = !movement.to.known.has(Axes::XY)
            || stays
            || self.clear_places().any(|place| self.is_at(&movement.to, &place));
        matches!(movement.shape, MoveShape::Line) && (is_raised || stays) && is_height && is_place
    }

    fn arrival_at_start(&self) -> NumberedMove {
        let (from, to) = (self.start, self.start);
        (0, Move { from, to, shape: MoveShape::Line, pace: Pace::Rapid, named: None })
    }

    /// Returns the start of the expected moves, and the positions that they reach before they go below the start height S0.
    fn clear_places(&self) -> impl Iterator<Item = Position> {
        let ends = self.expected.iter().map(|(_, movement)| movement.to);
        let is_clear = |at: &Position| at.known == Axes::ALL && self.is_clear(at.z());
        std::iter::once(self.start).chain(ends.take_while(is_clear))
    }

    /// Whether a move is so short that it is only due to rounding.
    fn is_too_short(&self, movement: &Move) -> bool {
        movement.is_known() && self.is_near(&movement.from, &movement.to)
    }

    fn is_same(&self, found: &Move, expected: &Move) -> bool {
        let knows_the_same = found.from.known == expected.from.known && found.to.known == expected.to.known;
        knows_the_same
            && found.named == expected.named
            && self.is_near(&found.from, &expected.from)
            && self.is_near(&found.to, &expected.to)
    }

    fn is_same_height(&self, a: f64, b: f64) -> bool {
        libm::fabs(a - b) <= self.slack
    }

    fn is_clear(&self, z: f64) -> bool {
        z >= self.clearance - self.slack
    }

    /// Whether two positions agree in the plane.
    fn is_at(&self, a: &Position, b: &Position) -> bool {
        libm::fabs(a.x() - b.x()) <= self.slack && libm::fabs(a.y() - b.y()) <= self.slack
    }

    fn is_near(&self, a: &Position, b: &Position) -> bool {
        self.is_at(a, b) && self.is_same_height(a.z(), b.z())
    }
}
