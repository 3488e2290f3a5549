//! Compares cuts move by move, and the rapid moves between two cuts as a whole.

use std::iter::Peekable;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_motion::{Move, MoveShape, Pace, Position};

use super::chain::{Chain, Way};
use crate::dialect::Dialect;
use crate::verify::compare::{Difference, DifferenceKind, Ends, Tolerance, check_pace, check_shape, meet};
use crate::verify::is_near;
use crate::verify::walk::{Stretch, are_alike};

/// Two roundings to the third decimal, and the unit by which an arc may be extended to keep it from becoming a full circle.
pub(super) const PLACE: f64 = 0.0015 * (1.0 + 1e-6);

/// One unit of the last printed digit.
const FEED: f64 = 0.001 * (1.0 + 1e-6);

/// A centre is the sum of two rounded numbers, and its arc begins at the end of the previous one.
const CENTRE: f64 = 3.0 * PLACE;

/// How far chords may leave their arc, in mm, for a control that takes no helices: as far as the post for it allows. The post writes as few
/// chords as that takes, so where one is missing, the next one leaves the arc further.
pub(super) const CHORD: f64 = 0.01;

#[derive(Debug)]
pub(super) struct Cuts<M: Iterator<Item = (u32, Move)>> {
    expected: Peekable<M>,
    /// The fraction of the next expected move that has been done.
    done: f64,
    /// The expected position before that move.
    at: Position,
    chain: Chain,
    clearance: f64,
    tolerance: Tolerance,
    /// Whether the control takes helices; otherwise chords replace them.
    takes_helices: bool,
    difference: Option<Difference>,
    /// Number of expected moves found so far.
    equal: usize,
    /// Whether lines may be split, as those corrected by probes are.
    may_split: bool,
    /// Whether the program may go to machine positions before its first and after its last cut.
    may_go_home: bool,
}

impl<M: Iterator<Item = (u32, Move)>> Cuts<M> {
    pub(super) fn new(expected: M, start: Position, clearance: f64, dialect: Dialect) -> Self {
        Self {
            expected: expected.peekable(),
            done: 0.0,
            at: start,
            chain: Chain::new(),
            clearance,
            tolerance: Tolerance { place: PLACE, feed: FEED, chord: 0.0, ends: Ends::All },
            takes_helices: dialect.rules().arcs.helix,
            difference: None,
            equal: 0,
            may_split: dialect == Dialect::Native,
            may_go_home: dialect != Dialect::Native,
        }
    }

    /// Passes the next move of the program.
    pub(super) fn take(&mut self, line: u32, movement: &Move) {
        if self.difference.is_some() {
            return;
        }
        if movement.pace == Pace::Rapid {
            self.chain.push(line, movement);
        } else if let Err(difference) =
            self.rapids(Some((line, movement))).and_then(|()| self.cut(line, movement))
        {
            self.difference = Some(*difference);
        }
    }

    /// Returns the first difference, and the number of expected moves found before it.
    pub(super) fn finish(mut self) -> (Option<Diagnostic>, usize) {
        if self.difference.is_none() {
            self.difference = self.rapids(None).err().map(|difference| *difference);
        }
        let difference = self.difference.or_else(|| {
            let expected = self.expected.next();
            expected.map(|expected| Difference {
                kind: DifferenceKind::Place,
                found: None,
                expected: Some(expected),
            })
        });
        (difference.map(|difference| difference.against_drawing()), self.equal)
    }

    /// Compares the rapid moves before this cut, or at the end, with the expected ones.
    fn rapids(&mut self, cut: Option<(u32, &Move)>) -> Result<(), Box<Difference>> {
        let chain = std::mem::replace(&mut self.chain, Chain::behind());
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
        let way = Way {
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
        match chain.check(&way) {
            Err(found) => Err(Box::new(Difference { kind: DifferenceKind::Place, found, expected: next })),
            Ok(()) if cut.is_none_or(|(_, movement)| reaches(movement) || movement.is_nothing()) => {
                self.equal += expected.len();
                Ok(())
            }
            Ok(()) => Err(Box::new(Difference { kind: DifferenceKind::Place, found, expected: next })),
        }
    }

    /// Permitted difference in height within the next expected move. Its position is determined in the plane, where a rounding error on a
    /// steep arc
    /// means a difference in height.
    fn slack_of_height(&mut self) -> f64 {
        let within = self.expected.peek().filter(|_| self.done > 0.0);
        let steepness = within.map_or(0.0, |(_, movement)| {
            Stretch { movement: *movement, begin: 0.0, length: 0.0 }.steepness()
        });
        2.0 * self.tolerance.place * (1.0 + steepness)
    }

    /// The expected position of the tool.
    fn place(&mut self) -> Position {
        match self.expected.peek() {
            Some((_, movement)) if self.done > 0.0 => {
                let stretch = Stretch { movement: *movement, begin: self.done, length: 0.0 };
                let [x, y, z] = stretch.point(self.done);
                Position::known(x, y, z)
            }
            _ => self.at,
        }
    }

    fn cut(&mut self, line: u32, movement: &Move) -> Result<(), Box<Difference>> {
        let mut begin = 0.0;
        loop {
            let ours = Stretch { movement: *movement, begin, length: movement.length() * (1.0 - begin) };
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
            let theirs = Stretch {
                movement: expected,
                begin: self.done,
                length: expected.length() * (1.0 - self.done),
            };
            let is_helix = theirs.is_arc() && expected.from.z() != expected.to.z();
            let is_chord = is_helix && !self.takes_helices && !ours.is_arc();
            if ours.end_together(&theirs, slack) && !is_chord {
                check_pace(movement, &expected, &self.tolerance).map_err(differs)?;
                check_shape(&ours, 1.0, &theirs, 1.0, &self.tolerance).map_err(differs)?;
                check_centres(movement, &expected).map_err(differs)?;
                self.pass(&expected);
                return Ok(());
            }
            if stands(&ours) {
                return Ok(());
            }
            if stands(&theirs) {
                self.pass(&expected);
                continue;
            }
            if is_chord {
                check_pace(movement, &expected, &self.tolerance).map_err(differs)?;
                let end = check_chord(&ours, &theirs).map_err(differs)?;
                if end < 1.0 {
                    self.done = end;
                } else {
                    self.pass(&expected);
                }
                return Ok(());
            }
            // The parts of a move are of the same kind. An arc that continues in a line is a different one.
            if ours.is_arc() != theirs.is_arc() {
                return Err(differs(DifferenceKind::Place));
            }
            check_pace(movement, &expected, &self.tolerance).map_err(differs)?;
            check_centres(movement, &expected).map_err(differs)?;
            let are_lines = !ours.is_arc() && !theirs.is_arc();
            let splits = ours.length < theirs.length;
            if are_lines && !(splits && self.may_split) {
                return Err(differs(DifferenceKind::Place));
            }
            if splits {
                self.done = meet(&ours, &theirs, &self.tolerance).map_err(differs)?;
                return Ok(());
            }
            begin = meet(&theirs, &ours, &self.tolerance).map_err(differs)?;
            self.pass(&expected);
        }
    }

    fn pass(&mut self, expected: &Move) {
        self.expected.next();
        self.equal += 1;
        self.at = expected.to;
        self.done = 0.0;
    }
}

/// The fraction of a helix at which a chord of the rest of it ends.
fn check_chord(chord: &Stretch, rest: &Stretch) -> Result<f64, DifferenceKind> {
    let (end, Some(course)) = (chord.end(), rest.movement.course()) else {
        return Err(DifferenceKind::Shape);
    };
    let is_last = is_near(&end, &rest.end(), PLACE) && are_alike(chord.length, rest.length, PLACE);
    let share = if is_last { 1.0 } else { rest.nearest(&end, chord.length).ok_or(DifferenceKind::Place)? };
    let [x, y, z] = rest.point(share);
    let height = 2.0 * PLACE * (1.0 + rest.steepness());
    if !is_near(&[x, y, 0.0], &[end[0], end[1], 0.0], PLACE) || libm::fabs(z - end[2]) > height {
        return Err(DifferenceKind::Place);
    }
    let sweep = course.sweep() * (share - rest.begin);
    let sagitta = course.radius() * (1.0 - libm::cos(sweep / 2.0));
    // The ends are rounded, and the further apart they are, the more that counts.
    let rounding = PLACE * libm::sqrt(CHORD / (2.0 * course.radius()));
    if sweep < std::f64::consts::PI && sagitta <= CHORD + rounding {
        Ok(share)
    } else {
        Err(DifferenceKind::Shape)
    }
}

/// Two arcs must have the same centre, because the points of a short one hardly determine it.
fn check_centres(found: &Move, expected: &Move) -> Result<(), DifferenceKind> {
    let (MoveShape::Arc(ours), MoveShape::Arc(theirs)) = (found.shape, expected.shape) else { return Ok(()) };
    let are_near = ours.centre.iter().zip(theirs.centre).all(|(a, b)| libm::fabs(a - b) <= CENTRE);
    let turn_alike = ours.clockwise == theirs.clockwise && ours.plane == theirs.plane;
    if are_near && turn_alike { Ok(()) } else { Err(DifferenceKind::Shape) }
}
