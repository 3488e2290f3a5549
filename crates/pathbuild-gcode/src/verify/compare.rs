//! Checks whether two programs move identically: along the same path in the plane and in Z, at the same feeds, in the same order.
//!
//! Their moves may be divided differently: a circle may consist of two halves, or of chords within a tolerance.

use std::borrow::Cow;

use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_diagnostic::{Diagnostic, Message};
use pathbuild_motion::{Axes, Course, Move, MoveShape, Pace, Position};
use pathbuild_toolpath::LAST_DIGIT_SLACK;

/// Tolerances in mm and mm/min within which two programs are equal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Tolerance in mm for the coordinates of ends. Between the ends of a line, twice this is permitted, because both ends are rounded. Within an
    /// arc, it is six times this: the centre is the sum of two rounded numbers, and the far side of a circle moves twice as far as the centre.
    pub place: f64,
    /// Tolerance in mm/min for feeds.
    pub feed: f64,
    /// Greatest distance in mm between an arc and the chords that replace it.
    pub chord: f64,
    /// Selection of the rapid moves that are compared at the ends of the programs.
    pub ends: Ends,
}

/// Selection of the rapid moves that are compared at the ends of programs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ends {
    /// All moves. As long as the position is not fully known, each move must be the same.
    All,
    /// Moves once the position is known, because the axes become known in an order that the other program does not state.
    Placed,
    /// Rapid moves between the first and the last cut, because the beginning and the end of a program written by a post depend on the machine.
    Cutting,
}

impl Tolerance {
    /// Returns the tolerance for numbers with this number of decimals: half a unit of the last digit, plus the error of doubles.
    pub fn of_decimals(decimals: i32) -> Self {
        let half = 0.5 * libm::pow(10.0, f64::from(-decimals)) * (1.0 + 1e-6);
        Self { place: half, feed: half, chord: 0.0, ends: Ends::Placed }
    }
}

/// Factor for the distance of two arcs between their ends: see [`Tolerance::place`].
const ARC_SLACK: f64 = 6.0;

/// The first difference between two programs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// The kind of difference.
    pub kind: DifferenceKind,
    /// The move that was found, with its line; `None` if there is none left.
    pub found: Option<(u32, Move)>,
    /// The expected move, with its line; `None` if there is none left.
    pub expected: Option<(u32, Move)>,
}

/// The property in which two moves differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DifferenceKind {
    /// The moves lead to different positions, or one is missing.
    Place,
    /// The moves differ between their ends.
    Shape,
    /// One move is a rapid, the other is not.
    Pace,
    /// The feeds differ.
    Feed,
}

/// Compares the moves found with those expected. Returns `None` if they are equal.
pub fn compare(found: &[(u32, Move)], expected: &[(u32, Move)], tolerance: &Tolerance) -> Option<Difference> {
    if tolerance.ends == Ends::All
        && let Some(difference) = compare_unplaced(found, expected, tolerance)
    {
        return Some(difference);
    }
    let (found, expected) =
        (comparable_moves(found, tolerance.ends), comparable_moves(expected, tolerance.ends));
    let (mut found, mut expected) = (Walker::new(&found), Walker::new(&expected));
    if let Err(kind) = advance_to_common_start(&mut found, &mut expected, tolerance) {
        return Some(difference(kind, &found, &expected));
    }
    loop {
        let pair = (found.stretch(), expected.stretch());
        let belong_together =
            matches!(pair, (Some(ours), Some(theirs)) if ours.end_together(&theirs, tolerance.place));
        if !belong_together
            && (skip_rounding_move(&mut found, &expected, tolerance)
                || skip_rounding_move(&mut expected, &found, tolerance))
        {
            continue;
        }
        let (Some(ours), Some(theirs)) = pair else { break };
        if let Err(kind) = step(&mut found, &ours, &mut expected, &theirs, tolerance) {
            return Some(difference(kind, &found, &expected));
        }
    }
    let both_are_done = found.stretch().is_none() && expected.stretch().is_none();
    (!both_are_done).then(|| difference(DifferenceKind::Place, &found, &expected))
}

/// Whether two moves that begin at the same position are equal throughout.
pub(crate) fn is_same_move(found: &Move, expected: &Move, tolerance: &Tolerance) -> bool {
    if let (MoveShape::Line, MoveShape::Line) = (found.shape, expected.shape) {
        return is_near(&found.to.at, &expected.to.at, tolerance.place)
            && check_pace(found, expected, tolerance).is_ok();
    }
    if let (MoveShape::Arc(ours), MoveShape::Arc(theirs)) = (found.shape, expected.shape)
        && found.from.known.and(expected.from.known) == Axes::ALL
    {
        let ours = Course::new(ours, &found.from, &found.to);
        let theirs = Course::new(theirs, &expected.from, &expected.to);
        return is_near(&found.to.at, &expected.to.at, tolerance.place)
            && are_similar_lengths(ours.length(), theirs.length(), tolerance.place)
            && check_pace(found, expected, tolerance).is_ok()
            && is_same_course(&ours, &theirs, tolerance);
    }
    let (ours, theirs) = (Stretch::whole(*found), Stretch::whole(*expected));
    ours.end_together(&theirs, tolerance.place)
        && check_pace(found, expected, tolerance).is_ok()
        && check_shape(&ours, &theirs, 1.0, 0.0, tolerance).is_ok()
}

impl Difference {
    /// Converts the difference to a diagnostic in the line of the move that was found.
    pub fn diagnostic(&self) -> Diagnostic {
        let diagnostic = match (&self.found, &self.expected) {
            (Some(found), Some(expected)) => diagnostic_of_kind(self.kind, found, expected),
            (None, Some((line, _))) => Diagnostic::new(&say::MOVES_MISSING).with("line", u64::from(*line)),
            (Some(_), None) => Diagnostic::new(&say::MOVES_TOO_MANY),
            (None, None) => Diagnostic::new(&say::SHAPES_DIFFER).with("line", 0_u64),
        };
        diagnostic.at_line(self.found.map(|(line, _)| line), None)
    }

    /// Converts the difference to a diagnostic for a comparison with a drawing, whose moves have no lines.
    pub(super) fn diagnostic_against_drawing(&self) -> Diagnostic {
        let diagnostic = match (&self.found, &self.expected) {
            (Some((_, found)), Some((_, expected))) => match self.kind {
                DifferenceKind::Place => Diagnostic::new(&say::DRAWN_ELSEWHERE)
                    .quoting("found", place(&found.to))
                    .quoting("expected", place(&expected.to)),
                DifferenceKind::Shape => Diagnostic::new(&say::DRAWN_OTHERWISE),
                DifferenceKind::Pace => Diagnostic::new(&say::DRAWN_AT_ANOTHER_PACE)
                    .with("found", found.pace.word())
                    .with("expected", expected.pace.word()),
                DifferenceKind::Feed => Diagnostic::new(&say::DRAWN_WITH_ANOTHER_FEED)
                    .with("found", found.pace.feed().unwrap_or(0.0))
                    .with("expected", expected.pace.feed().unwrap_or(0.0)),
            },
            (None, Some((_, expected))) => {
                Diagnostic::new(&say::DRAWN_FURTHER).quoting("expected", place(&expected.to))
            }
            (Some((_, found)), None) => Diagnostic::new(&say::NOT_DRAWN).quoting("found", place(&found.to)),
            (None, None) => Diagnostic::new(&say::DRAWN_OTHERWISE),
        };
        diagnostic.at_line(self.found.map(|(line, _)| line), None)
    }
}

fn diagnostic_of_kind(kind: DifferenceKind, found: &(u32, Move), expected: &(u32, Move)) -> Diagnostic {
    let report = |message: &'static Message| Diagnostic::new(message).with("line", u64::from(expected.0));
    match kind {
        DifferenceKind::Place => report(&say::PATHS_DIFFER)
            .quoting("found", place(&found.1.to))
            .quoting("expected", place(&expected.1.to)),
        DifferenceKind::Shape => report(&say::SHAPES_DIFFER),
        DifferenceKind::Pace => report(&say::KINDS_DIFFER)
            .with("found", found.1.pace.word())
            .with("expected", expected.1.pace.word()),
        DifferenceKind::Feed => {
            let feed = |movement: &Move| movement.pace.feed().unwrap_or(0.0);
            report(&say::FEEDS_DIFFER).with("found", feed(&found.1)).with("expected", feed(&expected.1))
        }
    }
}

/// Formats the axes that are known at a position; if there are none, the coordinates of the machine.
fn place(at: &Position) -> String {
    let is_shown = |axis: &usize| at.known.is_empty() || at.known.has(Axes::of(*axis));
    (0..3)
        .filter(is_shown)
        .map(|axis| format!("{}{:.3}", ['X', 'Y', 'Z'][axis], at.at[axis]))
        .collect::<Vec<_>>()
        .join(" ")
}

fn difference(kind: DifferenceKind, found: &Walker<'_>, expected: &Walker<'_>) -> Difference {
    // If one program ends within a move of the other one, its last move, which ended too early, is shown instead of a missing move.
    let shown = |one: &Walker<'_>, other: &Walker<'_>| {
        one.current().or_else(|| other.is_within().then(|| one.last()).flatten())
    };
    Difference { kind, found: shown(found, expected), expected: shown(expected, found) }
}

/// Compares the moves from or to positions that are not fully known, such as the approach, one by one.
fn compare_unplaced(
    found: &[(u32, Move)],
    expected: &[(u32, Move)],
    tolerance: &Tolerance,
) -> Option<Difference> {
    let is_unplaced = |(_, movement): &&(u32, Move)| !movement.is_known();
    let mut found = found.iter().filter(is_unplaced).copied();
    let mut expected = expected.iter().filter(is_unplaced).copied();
    loop {
        let (found, expected) = (found.next(), expected.next());
        let kind = match (&found, &expected) {
            (None, None) => return None,
            (Some((_, ours)), Some((_, theirs))) => check_unplaced(ours, theirs, tolerance).err(),
            _ => Some(DifferenceKind::Place),
        };
        if let Some(kind) = kind {
            return Some(Difference { kind, found, expected });
        }
    }
}

fn check_unplaced(ours: &Move, theirs: &Move, tolerance: &Tolerance) -> Result<(), DifferenceKind> {
    check_pace(ours, theirs, tolerance)?;
    // An axis that is not known is at a coordinate of the machine, or at 0.
    let is_same = ours.to.known == theirs.to.known
        && ours.named == theirs.named
        && is_near(&ours.to.at, &theirs.to.at, tolerance.place);
    if is_same { Ok(()) } else { Err(DifferenceKind::Place) }
}

/// Selects the moves to be compared along their course: those to known positions, and at both ends of the program only those that `ends` requires.
fn comparable_moves(moves: &[(u32, Move)], ends: Ends) -> Cow<'_, [(u32, Move)]> {
    let is_known = |(_, movement): &(u32, Move)| movement.to.known == Axes::ALL;
    let is_cut = |movement: &(u32, Move)| is_known(movement) && movement.1.pace != Pace::Rapid;
    let (first, end) = match ends {
        Ends::All | Ends::Placed => {
            let begins = |(_, movement): &(u32, Move)| movement.is_known();
            (moves.iter().position(begins), moves.len())
        }
        Ends::Cutting => {
            let last = moves.iter().rposition(is_cut);
            (moves.iter().position(is_cut), last.map_or(0, |last| last + 1))
        }
    };
    let counting = first.map_or(&[][..], |first| &moves[first..end]);
    if counting.iter().all(is_known) {
        Cow::Borrowed(counting)
    } else {
        counting.iter().filter(|movement| is_known(movement)).copied().collect()
    }
}

/// Advances both programs to their first common position, skipping rapid moves of one of them.
fn advance_to_common_start(
    found: &mut Walker<'_>,
    expected: &mut Walker<'_>,
    tolerance: &Tolerance,
) -> Result<(), DifferenceKind> {
    let (Some(here), Some(there)) = (found.place(), expected.place()) else { return Ok(()) };
    let is_there = |a: &[f64; 3], b: &[f64; 3]| is_near(a, b, tolerance.place);
    let may_skip = tolerance.ends != Ends::All;
    if is_there(&here, &there)
        || may_skip && expected.skip_rapids_to(|at| is_there(at, &here))
        || may_skip && found.skip_rapids_to(|at| is_there(at, &there))
    {
        return Ok(());
    }
    Err(DifferenceKind::Place)
}

/// Skips a move that is too short to be anything but rounding, if it ends at the position reached in the other program. Returns whether a move was
/// skipped.
fn skip_rounding_move(one: &mut Walker<'_>, other: &Walker<'_>, tolerance: &Tolerance) -> bool {
    let Some(stretch) = one.stretch() else { return false };
    let here = other.place().unwrap_or(stretch.end());
    // The rounded end of a short arc must differ from its start, or the arc would be a full circle; the writer therefore extends the arc by
    // one unit of the last digit. The rest of a longer move, however, is a real excess.
    let slack = if stretch.begin > 0.0 { tolerance.place } else { 3.0 * tolerance.place };
    let is_standing = stretch.length <= 4.0 * tolerance.place && is_near(&stretch.end(), &here, slack);
    if is_standing {
        one.finish_move();
    }
    is_standing
}

/// Advances both programs to the end of the move that ends first.
fn step(
    found: &mut Walker<'_>,
    ours: &Stretch,
    expected: &mut Walker<'_>,
    theirs: &Stretch,
    tolerance: &Tolerance,
) -> Result<(), DifferenceKind> {
    check_pace(&ours.movement, &theirs.movement, tolerance)?;
    if ours.end_together(theirs, tolerance.place) {
        check_shape(ours, theirs, 1.0, theirs.radius_error(), tolerance)?;
        found.finish_move();
        expected.finish_move();
        return Ok(());
    }
    if ours.length < theirs.length {
        let share = meeting_fraction(ours, theirs, theirs.radius_error(), tolerance)?;
        found.finish_move();
        expected.go_to(share);
    } else {
        let share = meeting_fraction(theirs, ours, theirs.radius_error(), tolerance)?;
        expected.finish_move();
        found.go_to(share);
    }
    Ok(())
}

/// Returns the fraction of the longer stretch at which the shorter one ends.
pub(super) fn meeting_fraction(
    shorter: &Stretch,
    longer: &Stretch,
    radius_error: f64,
    tolerance: &Tolerance,
) -> Result<f64, DifferenceKind> {
    let end = shorter.end();
    let share = longer.nearest(&end, shorter.length).ok_or(DifferenceKind::Place)?;
    let slack =
        if longer.is_arc() { ARC_SLACK } else { 2.0 } * tolerance.place + tolerance.chord + radius_error;
    let [x, y, z] = longer.point(share);
    // A position on an arc is determined in its plane; on a steep arc, a rounding error there means a difference in height.
    let height = slack + ARC_SLACK * tolerance.place * longer.steepness();
    if !is_near(&[x, y, 0.0], &[end[0], end[1], 0.0], slack) || libm::fabs(z - end[2]) > height {
        return Err(DifferenceKind::Place);
    }
    check_shape(shorter, longer, share, radius_error, tolerance)?;
    Ok(share)
}

pub(super) fn check_pace(ours: &Move, theirs: &Move, tolerance: &Tolerance) -> Result<(), DifferenceKind> {
    match (ours.pace, theirs.pace) {
        (Pace::Rapid, Pace::Rapid) => Ok(()),
        (Pace::Feed(ours), Pace::Feed(theirs)) if libm::fabs(ours - theirs) <= tolerance.feed => Ok(()),
        (
            Pace::Probe { feed: ours, toward, must_answer },
            Pace::Probe { feed: theirs, toward: toward_too, must_answer: must_answer_too },
        ) if (toward, must_answer) == (toward_too, must_answer_too) => {
            if libm::fabs(ours - theirs) <= tolerance.feed { Ok(()) } else { Err(DifferenceKind::Feed) }
        }
        (Pace::Feed(_), Pace::Feed(_)) => Err(DifferenceKind::Feed),
        _ => Err(DifferenceKind::Pace),
    }
}

/// Compares the shape of a stretch with that of another one, which ends at the fraction `other_end` of its move. `radius_error`, the difference in
/// mm between the radii at the start and the end of the expected stretch, extends the tolerance, because its centre is not known more exactly.
pub(super) fn check_shape(
    one: &Stretch,
    other: &Stretch,
    other_end: f64,
    radius_error: f64,
    tolerance: &Tolerance,
) -> Result<(), DifferenceKind> {
    if !one.is_arc() && !other.is_arc() {
        return Ok(());
    }
    let chord = if one.is_arc() && other.is_arc() { 0.0 } else { tolerance.chord };
    let slack = ARC_SLACK * tolerance.place + chord + radius_error;
    let agrees = |share: f64| {
        let at = |stretch: &Stretch, end: f64| stretch.point(stretch.begin + share * (end - stretch.begin));
        is_near(&at(one, 1.0), &at(other, other_end), slack)
    };
    if [0.25, 0.5, 0.75].into_iter().all(agrees) { Ok(()) } else { Err(DifferenceKind::Shape) }
}

/// Whether two whole arcs are equal, compared at a quarter, half and three quarters of their length.
fn is_same_course(one: &Course, other: &Course, tolerance: &Tolerance) -> bool {
    let slack = ARC_SLACK * tolerance.place;
    one.quarters().iter().zip(&other.quarters()).all(|(ours, theirs)| is_near(ours, theirs, slack))
}

pub(crate) fn is_near(a: &[f64; 3], b: &[f64; 3], slack: f64) -> bool {
    a.iter().zip(b).all(|(a, b)| libm::fabs(a - b) <= slack)
}

/// A position in a list of moves: a move, and the fraction of it that has been passed.
pub(super) struct Walker<'m> {
    moves: &'m [(u32, Move)],
    index: usize,
    /// The fraction of the current move that has been passed.
    done: f64,
}

/// The remaining part of a move.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    pub(super) movement: Move,
    /// The fraction of the move at which the stretch begins.
    pub(super) begin: f64,
    /// Length of the stretch in mm, without axes that are unknown at either end.
    pub(super) length: f64,
}

impl<'m> Walker<'m> {
    pub(super) fn new(moves: &'m [(u32, Move)]) -> Self {
        Self { moves, index: 0, done: 0.0 }
    }

    pub(super) fn current(&self) -> Option<(u32, Move)> {
        self.moves.get(self.index).copied()
    }

    pub(super) fn last(&self) -> Option<(u32, Move)> {
        self.moves.last().copied()
    }

    pub(super) fn is_within(&self) -> bool {
        self.done > 0.0
    }

    /// Returns the rest of the current move.
    pub(super) fn stretch(&self) -> Option<Stretch> {
        let (_, movement) = self.current()?;
        Some(Stretch::rest(movement, self.done))
    }

    /// Returns the current position, or the end of the current move if its start is unknown; `None` if there are no moves.
    pub(super) fn place(&self) -> Option<[f64; 3]> {
        match self.stretch() {
            Some(stretch) if stretch.movement.from.known == Axes::ALL => Some(stretch.point(stretch.begin)),
            Some(stretch) => Some(stretch.end()),
            None => self.last().map(|(_, movement)| movement.to.at),
        }
    }

    pub(super) fn finish_move(&mut self) {
        self.index += 1;
        self.done = 0.0;
    }

    pub(super) fn go_to(&mut self, share: f64) {
        self.done = share;
    }

    /// Advances over rapid moves to the first position that satisfies the condition. Returns false, without advancing, if there is none.
    fn skip_rapids_to(&mut self, is_target: impl Fn(&[f64; 3]) -> bool) -> bool {
        let rapids = self.moves[self.index..].iter().take_while(|(_, movement)| movement.pace == Pace::Rapid);
        let found = rapids.clone().position(|(_, movement)| is_target(&movement.to.at));
        self.index += found.map_or(0, |passed| passed + 1);
        found.is_some()
    }
}

impl Stretch {
    pub(super) fn whole(movement: Move) -> Self {
        Self::rest(movement, 0.0)
    }

    /// Creates the part of a move from a fraction to its end.
    pub(super) fn rest(movement: Move, begin: f64) -> Self {
        Self { movement, begin, length: movement.length() * (1.0 - begin) }
    }

    pub(super) fn end(&self) -> [f64; 3] {
        self.movement.to.at
    }

    pub(super) fn is_arc(&self) -> bool {
        matches!(self.movement.shape, MoveShape::Arc(_))
    }

    /// Returns the difference in mm between the radii at both ends of an arc, which rounding causes; 0 for a line.
    pub(super) fn radius_error(&self) -> f64 {
        match self.movement.shape {
            MoveShape::Arc(arc) if self.movement.from.known == Axes::ALL => {
                libm::fabs(arc.radius(&self.movement.to) - arc.radius(&self.movement.from))
            }
            _ => 0.0,
        }
    }

    /// Returns the position at a fraction of the whole move.
    pub(super) fn point(&self, share: f64) -> [f64; 3] {
        self.movement.point(share)
    }

    /// Whether both stretches end at the same position, and not one of them a full turn later.
    pub(super) fn end_together(&self, other: &Self, slack: f64) -> bool {
        let from_unknown = self.movement.from.known != Axes::ALL || other.movement.from.known != Axes::ALL;
        is_near(&self.end(), &other.end(), slack)
            && (from_unknown || are_similar_lengths(self.length, other.length, slack))
    }

    /// Returns the fraction of the move at which it is nearest to a position about `along` mm ahead; `None` if the move has no length.
    pub(super) fn nearest(&self, place: &[f64; 3], along: f64) -> Option<f64> {
        let whole = self.movement.length();
        if whole <= 0.0 {
            return None;
        }
        let share = match self.movement.shape {
            MoveShape::Line => {
                let way: [f64; 3] =
                    std::array::from_fn(|axis| self.movement.to.at[axis] - self.movement.from.at[axis]);
                (0..3).map(|axis| (place[axis] - self.movement.from.at[axis]) * way[axis]).sum::<f64>()
                    / (whole * whole)
            }
            MoveShape::Arc(arc) => {
                let guess = (self.begin + along / whole).min(1.0);
                let course = Course::new(arc, &self.movement.from, &self.movement.to);
                guess + arc.angle_ahead(&course.point(guess), place) / course.sweep()
            }
        };
        Some(share.clamp(self.begin, 1.0))
    }

    /// Returns the rise or fall of an arc per mm in its plane; 0 for a line.
    pub(super) fn steepness(&self) -> f64 {
        let rise = libm::fabs(self.movement.to.z() - self.movement.from.z());
        let way = libm::sqrt((self.movement.length() * self.movement.length() - rise * rise).max(0.0));
        if self.is_arc() && way > 0.0 { rise / way } else { 0.0 }
    }
}

/// Whether the lengths in mm of two paths between the same ends are so similar that neither path has a full turn more.
pub(super) fn are_similar_lengths(one: f64, other: f64, slack: f64) -> bool {
    one.max(other) <= 1.25 * one.min(other) + 10.0 * slack
}

/// Whether two programs have the same lines that determine moves: the same words, with numbers within one unit of the third decimal, and
/// with equal G words.
///
/// Comments (including correction formulas), blanks, leading zeros, line breaks, and lines with only T and S are ignored.
pub fn same_move_lines(found: &str, expected: &str) -> bool {
    let (mut found, mut expected) = (move_lines(found), move_lines(expected));
    loop {
        match (found.next(), expected.next()) {
            (None, None) => return true,
            (Some(Some(found)), Some(Some(expected))) if is_same_line(&found, &expected) => {}
            _ => return false,
        }
    }
}

type Word = (char, f64);

/// Returns the words of each line that moves the tool or sets a mode; `None` for a line that cannot be read.
fn move_lines(text: &str) -> impl Iterator<Item = Option<Vec<Word>>> {
    let is_move = |words: &Option<Vec<Word>>| {
        let counts = |(letter, _): &Word| !matches!(letter, 'T' | 'S');
        words.as_ref().is_none_or(|words| words.iter().any(counts))
    };
    text.lines().map(words).filter(is_move)
}

fn words(line: &str) -> Option<Vec<Word>> {
    let plain = without_comments(line);
    let mut rest = plain.as_str();
    let mut words = Vec::new();
    while let Some(letter) = rest.chars().next() {
        let digits = &rest[letter.len_utf8()..];
        let end =
            digits.find(|digit: char| !matches!(digit, '0'..='9' | '.' | '+' | '-')).unwrap_or(digits.len());
        let number = if letter == '%' && end == 0 { 0.0 } else { digits[..end].parse().ok()? };
        words.push((letter.to_ascii_uppercase(), number));
        rest = &digits[end..];
    }
    Some(words)
}

/// Removes blanks, comments in parentheses and text after a semicolon from a line.
fn without_comments(line: &str) -> String {
    let mut plain = String::with_capacity(line.len());
    let mut is_comment = false;
    for character in line.chars() {
        match character {
            '(' => is_comment = true,
            ')' => is_comment = false,
            _ if is_comment => {}
            ';' => break,
            blank if blank.is_whitespace() => {}
            other => plain.push(other),
        }
    }
    plain
}

fn is_same_line(found: &[Word], expected: &[Word]) -> bool {
    let same_word = |((a, found), (b, expected)): (&Word, &Word)| {
        let slack = if *a == 'G' { 0.0 } else { LAST_DIGIT_SLACK };
        a == b && libm::fabs(found - expected) <= slack
    };
    found.len() == expected.len() && found.iter().zip(expected).all(same_word)
}
