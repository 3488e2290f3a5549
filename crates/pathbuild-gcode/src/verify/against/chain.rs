//! Checks the rapid moves between two cuts.
//!
//! It is the way that is expected, point for point, because an editor may have changed any of them. (What posts write is held against what
//! a way may touch, since a definition may lift the tool higher: `ways` in pathbuild-post.) Only on the way to where that begins, and once
//! all is milled, a program may go to places of the machine, or leave out places at S0; there nothing is in the way.

use pathbuild_motion::{Axes, Move, MoveShape, Position};

/// A move and its line.
type Numbered = (u32, Move);

/// The rapid moves of a program since the last cut.
#[derive(Debug)]
pub(super) struct Chain {
    moves: Vec<Numbered>,
    /// Whether it begins the program.
    is_head: bool,
}

/// The expected moves between two cuts.
#[derive(Debug)]
pub(super) struct Way<'w> {
    /// Start of the moves.
    pub(super) start: Position,
    pub(super) expected: &'w [Numbered],
    /// Whether it ends the program.
    pub(super) is_foot: bool,
    /// Whether the program may go to machine positions, which the native one does not.
    pub(super) may_go_home: bool,
    /// S0.
    pub(super) clearance: f64,
    pub(super) slack: f64,
}

impl Chain {
    /// The chain at the beginning of a program.
    pub(super) fn new() -> Self {
        Self { moves: Vec::new(), is_head: true }
    }

    /// The chain after a cut.
    pub(super) fn behind() -> Self {
        Self { moves: Vec::new(), is_head: false }
    }

    pub(super) fn push(&mut self, line: u32, movement: &Move) {
        self.moves.push((line, *movement));
    }

    /// Checks the chain against the expected moves. The error is the first move that deviates.
    pub(super) fn check(&self, way: &Way<'_>) -> Result<(), Option<Numbered>> {
        if !self.is_head {
            return Self::check_rest(&self.moves, way.expected, way);
        }
        let mut outcome = Err(self.moves.first().copied());
        for (passed, place) in way.clear_places().enumerate() {
            let Some(rest) = self.arrived(&place, passed > 0, way)? else { continue };
            outcome = Self::check_rest(rest, &way.expected[passed..], way);
            if outcome.is_ok() {
                break;
            }
        }
        outcome
    }

    /// Whether moves go as expected, and no further.
    fn check_rest(moves: &[Numbered], expected: &[Numbered], way: &Way<'_>) -> Result<(), Option<Numbered>> {
        let mut found = moves.iter().filter(|(_, movement)| !way.stands(movement));
        for (_, expected) in expected.iter().filter(|(_, movement)| !way.stands(movement)) {
            let next = found.next();
            let is_same = |(_, movement): &Numbered| way.is_same(movement, expected);
            if !next.is_some_and(is_same) {
                return Err(next.copied());
            }
        }
        match found.find(|(_, movement)| !(way.is_foot && way.is_harmless(movement))) {
            None => Ok(()),
            Some(other) => Err(Some(*other)),
        }
    }

    /// The moves behind a place where the way may begin; those before it are harmless. `None` if the program does not come there, or not
    /// from a known height where that `is_later` than the first one.
    fn arrived(
        &self,
        place: &Position,
        is_later: bool,
        way: &Way<'_>,
    ) -> Result<Option<&[Numbered]>, Option<Numbered>> {
        let begins = |(_, movement): &Numbered| {
            let is_raised = !is_later || movement.from.known.has(Axes::Z);
            movement.to.known == Axes::ALL && way.is_near(&movement.to, place) && is_raised
        };
        let Some(arrival) = self.moves.iter().position(begins) else { return Ok(None) };
        let (head, rest) = self.moves.split_at(arrival + 1);
        let mut is_parked = false;
        for (line, movement) in head {
            is_parked |= movement.named.is_some();
            // The position at the beginning is unknown, so the tool must be raised before it moves anywhere.
            let is_raised = movement.from.known.has(Axes::Z) || movement.to.known.has(Axes::Z) || is_parked;
            if !is_raised || !way.is_harmless(movement) {
                return Err(Some((*line, *movement)));
            }
        }
        Ok(Some(rest))
    }
}

impl Way<'_> {
    /// Whether a move before the start or after the end is harmless: at S0 over positions of the expected moves, or to a machine position.
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

    /// Where the way begins, and the places that it comes to before it goes below S0.
    fn clear_places(&self) -> impl Iterator<Item = Position> {
        let ends = self.expected.iter().map(|(_, it)| it.to);
        let is_clear = |at: &Position| at.known == Axes::ALL && self.is_clear(at.z());
        std::iter::once(self.start).chain(ends.take_while(is_clear))
    }

    /// Whether a move is only due to rounding.
    fn stands(&self, movement: &Move) -> bool {
        movement.from.known.and(movement.to.known) == Axes::ALL && self.is_near(&movement.from, &movement.to)
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

    /// Compares positions in the plane.
    fn is_at(&self, a: &Position, b: &Position) -> bool {
        libm::fabs(a.x() - b.x()) <= self.slack && libm::fabs(a.y() - b.y()) <= self.slack
    }

    fn is_near(&self, a: &Position, b: &Position) -> bool {
        self.is_at(a, b) && self.is_same_height(a.z(), b.z())
    }
}
