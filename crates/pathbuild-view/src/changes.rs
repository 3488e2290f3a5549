//! Classifies how the moves of a path change with its drawing: added, removed, deeper, faster, shifted.
//!
//! Moves are compared in the coordinates of the program, so moving a drawing on the sheet changes nothing. (book: program/comparing)

mod phrases;
mod pieces;

use std::borrow::Cow;
use std::collections::{BTreeSet, HashMap};
use std::ops::Range;

use imara_diff::{Algorithm, Diff, InternedInput, Interner};
use pathbuild_motion::{Axes, MoveShape, NamedPosition, Plane, Position};

use crate::scene::{MoveKind, Point, SceneMove};
pub use phrases::{moves, phrase};
use pieces::{CURVE_TOLERANCE, Divider, END_TOLERANCE, Snapper};

/// The moves of two programs, with the changes from one to the other.
#[derive(Clone, Debug, Default)]
pub struct ComparedMoves {
    /// Moves of the old program.
    pub old: Vec<ComparedMove>,
    /// Moves of the new program.
    pub new: Vec<ComparedMove>,
    /// The changes, in the order of the new program; empty if both do the same.
    pub changes: Vec<Change>,
    /// Whether moves were compared as a whole, because there are too many pieces. The changes may then include more than what changed.
    pub has_undivided_moves: bool,
}

/// A move, or a piece of a move if its pieces changed differently.
#[derive(Clone, Debug)]
pub struct ComparedMove {
    /// The geometry of the move or piece.
    pub movement: SceneMove,
    /// Number of the move to which it belongs, from 0.
    pub number: usize,
}

/// Consecutive moves that changed in the same way.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// Kind of the change.
    pub kind: ChangeKind,
    /// Indices into [`ComparedMoves::old`] of the moves that changed; an empty range if moves were added.
    pub old: Range<usize>,
    /// Indices into [`ComparedMoves::new`] of the moves that changed; an empty range if moves were removed.
    pub new: Range<usize>,
}

/// Kinds of changes between two programs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ChangeKind {
    /// The moves are only in the new program.
    Added,
    /// The moves are only in the old program.
    Removed,
    /// The moves follow the same lines as before, but the depth, the feed or the number of passes differs.
    Altered {
        /// Least and greatest height in mm by which the milled ground is raised along the moves; negative where it is deeper.
        raised: [f64; 2],
        /// Feed of the deepest pass in mm/min before and after, if it changed.
        feed: Option<[f64; 2]>,
        /// Number of passes before and after, if it changed.
        passes: Option<[u32; 2]>,
    },
    /// The moves are the same but at another place, shifted by this offset in mm.
    Shifted(Point),
    /// The moves lead to the same final result, but their order, direction or intermediate heights changed.
    Reordered,
}

/// Ranges of moves in the old and in the new program.
type Rows = (Range<usize>, Range<usize>);

const ORIGIN: Point = [0.0; 2];

/// Compares two programs.
///
/// Equal moves are ignored, except for the deepest pass along a line on which other passes changed. Among the others, a run of moves that recurs at
/// another place counts as shifted. All other cuts are divided where cuts end on them, unless they are too many, and each piece is classified by
/// comparing the final depth, the feed and the number of passes along its line in the plane.
pub fn compare(old: &[SceneMove], new: &[SceneMove]) -> ComparedMoves {
    let [old, new] = [old, new].map(without_standstills);
    let (old, new) = (&*old, &*new);
    let mut identities = Identities::default();
    let rows = hunks(&mut identities, old, new);
    let sides = [old, new];
    let differing = rows.iter().flat_map(|(was, is)| old[was.clone()].iter().chain(&new[is.clone()]));
    let mut divider = Divider::new(differing);
    let mut milled = |divider: &mut Divider| {
        if rows.is_empty() {
            return [MillingResults::default(), MillingResults::default()];
        }
        sides.map(|moves| MillingResults::of(moves, divider, &mut identities))
    };
    let mut milling = milled(&mut divider);
    let has_undivided_moves = divider.is_exhausted();
    if has_undivided_moves {
        // Compare whole moves: where only one of the programs was divided before the limit, the pieces would count as changes.
        milling = milled(&mut divider);
    }
    divider.restart();
    let rows = with_deepest_passes(rows, &milling);
    let mut comparison = Comparison {
        sides,
        milled: milling,
        identities,
        divider,
        done: [0; 2],
        result: ComparedMoves::default(),
    };
    for (was, is) in rows {
        comparison.classify_runs(was, is);
    }
    comparison.copy_unchanged([old.len(), new.len()]);
    unite_slopes(&mut comparison.result.changes);
    ComparedMoves { has_undivided_moves, ..comparison.result }
}

/// Adds the moves that are in both programs, but are the deepest pass of the new program along a line whose result changed. Without them, a program
/// from which the deepest passes were removed would have no changed move.
fn with_deepest_passes(mut rows: Vec<Rows>, [old, new]: &[MillingResults; 2]) -> Vec<Rows> {
    let is_altered = |line, is| old.lines.get(line).is_some_and(|was| was.change(is).is_some());
    let altered = new.lines.iter().filter(|(line, is)| is_altered(*line, *is));
    let deepest: BTreeSet<usize> = altered.map(|(_, is)| is.deepest).collect();
    let equal = |number: usize| {
        let before = rows.partition_point(|(_, is)| is.start <= number);
        let (old, new) = rows[..before].last().map_or((0, 0), |(was, is)| (was.end, is.end));
        let old = old + number.checked_sub(new)?;
        Some((old..old + 1, number..number + 1))
    };
    let added: Vec<Rows> = deepest.into_iter().filter_map(equal).collect();
    rows.extend(added);
    rows.sort_unstable_by_key(|(was, is)| (is.start, was.start));
    rows
}

/// Gives alterations along slopes that differ only in their heights the same range of heights: otherwise, each move of a relief would have a kind of
/// change of its own.
fn unite_slopes(changes: &mut [Change]) {
    let slope = |kind: &ChangeKind| match *kind {
        ChangeKind::Altered { raised: [least, most], feed, passes } if least != most => {
            let feed = feed.map(|feed| feed.map(f64::to_bits));
            Some(([least, most], (least < 0.0, most > 0.0, feed, passes)))
        }
        _ => None,
    };
    let mut ranges = HashMap::new();
    for ([least, most], key) in changes.iter().filter_map(|change| slope(&change.kind)) {
        let range = ranges.entry(key).or_insert([least, most]);
        *range = [range[0].min(least), range[1].max(most)];
    }
    for change in changes {
        if let Some((_, key)) = slope(&change.kind)
            && let ChangeKind::Altered { raised, .. } = &mut change.kind
        {
            *raised = ranges[&key];
        }
    }
}

/// Returns the ranges in which two sequences of moves differ.
fn hunks(identities: &mut Identities, old: &[SceneMove], new: &[SceneMove]) -> Vec<Rows> {
    let interner = Interner::new(old.len() + new.len());
    let mut input = InternedInput { before: Vec::new(), after: Vec::new(), interner };
    input.update_before(old.iter().map(|movement| identities.of(movement, ORIGIN)));
    input.update_after(new.iter().map(|movement| identities.of(movement, ORIGIN)));
    let row = |row: &Range<u32>| row.start as usize..row.end as usize;
    let diff = Diff::compute(Algorithm::Histogram, &input);
    diff.hunks().map(|hunk| (row(&hunk.before), row(&hunk.after))).collect()
}

/// Removes rapid moves that end where they begin, which drilling cycles make above their holes. Heights from which a correction was subtracted are not
/// exact, so the ends are compared like those of other moves.
fn without_standstills(moves: &[SceneMove]) -> Cow<'_, [SceneMove]> {
    let stands = |movement: &SceneMove| {
        let (from, to) = (&movement.way.from, &movement.way.to);
        let is_near = |axis: usize| (from.at[axis] - to.at[axis]).abs() <= END_TOLERANCE;
        let has_moved = from.known != to.known || !(0..3).all(is_near);
        is_rapid(movement) && movement.way.named.is_none() && !has_moved
    };
    if moves.iter().any(stands) {
        Cow::Owned(moves.iter().filter(|movement| !stands(movement)).cloned().collect())
    } else {
        Cow::Borrowed(moves)
    }
}

struct Comparison<'a> {
    /// The moves of the old and the new program.
    sides: [&'a [SceneMove]; 2],
    /// The results of the old and the new program along each line.
    milled: [MillingResults; 2],
    identities: Identities,
    divider: Divider,
    /// Number of moves of each program that are in the result.
    done: [usize; 2],
    result: ComparedMoves,
}

impl Comparison<'_> {
    /// Adds moves up to these numbers to the result, without a change.
    fn copy_unchanged(&mut self, ends: [usize; 2]) {
        let lists = [&mut self.result.old, &mut self.result.new];
        for (side, list) in lists.into_iter().enumerate() {
            let moves = (self.done[side]..ends[side]).map(|number| (number, &self.sides[side][number]));
            list.extend(moves.map(|(number, movement)| ComparedMove { movement: movement.clone(), number }));
        }
        self.done = ends;
    }

    fn classify_runs(&mut self, old: Range<usize>, new: Range<usize>) {
        self.copy_unchanged([old.start, new.start]);
        let Some((by, was, is)) = self.shift_of_runs(&old, &new) else {
            return self.classify_moves([old, new]);
        };
        self.classify_moves([old.start..was.start, new.start..is.start]);
        let [first_old, first_new] = [self.result.old.len(), self.result.new.len()];
        self.copy_unchanged([was.end, is.end]);
        let (old_range, new_range) = (first_old..self.result.old.len(), first_new..self.result.new.len());
        self.add(ChangeKind::Shifted(by), old_range, new_range);
        self.classify_moves([was.end..old.end, is.end..new.end]);
    }

    /// Returns the offset and the shifted moves if the cuts of both runs and the moves between the cuts are equal except for their position. The
    /// approach and the departure are not compared, because their outer ends did not move.
    fn shift_of_runs(
        &mut self,
        old: &Range<usize>,
        new: &Range<usize>,
    ) -> Option<(Point, Range<usize>, Range<usize>)> {
        let [before, after] = self.sides;
        let (old, new) = (cut_range(before, old)?, cut_range(after, new)?);
        let by = [0, 1].map(|axis| after[new.start].to()[axis] - before[old.start].to()[axis]);
        if old.len() != new.len() || by.iter().all(|way| way.abs() <= END_TOLERANCE) {
            return None;
        }
        let mut pairs = before[old.clone()].iter().zip(&after[new.clone()]);
        let is_shifted = pairs.all(|(was, is)| self.identities.of(was, ORIGIN) == self.identities.of(is, by));
        is_shifted.then_some((by, old, new))
    }

    /// Classifies the pieces of moves by the lines that they follow.
    fn classify_moves(&mut self, runs: [Range<usize>; 2]) {
        let pieces = [0, 1].map(|side| self.pieces(side, runs[side].clone()));
        let moves = pieces
            .each_ref()
            .map(|pieces| pieces.iter().map(|piece| piece.movement.clone()).collect::<Vec<SceneMove>>());
        let mut kinds = moves.each_ref().map(|moves| vec![None; moves.len()]);
        for (old, new) in hunks(&mut self.identities, &moves[0], &moves[1]) {
            for index in old {
                kinds[0][index] = self.kind_of_old(&moves[0][index]);
            }
            for index in new {
                kinds[1][index] = Some(self.kind_of_new(&moves[1][index]));
            }
        }
        for (kind, piece) in kinds[1].iter_mut().zip(&pieces[1]) {
            *kind = kind.or_else(|| self.kind_of_equal(piece));
        }
        for (side, (pieces, kinds)) in pieces.into_iter().zip(kinds).enumerate() {
            self.add_pieces(side, &pieces, &kinds);
        }
        self.done = runs.map(|run| run.end);
    }

    fn pieces(&mut self, side: usize, run: Range<usize>) -> Vec<ComparedMove> {
        let mut pieces = Vec::new();
        for number in run {
            let divided = self.divider.divide(&self.sides[side][number]);
            pieces.extend(divided.into_iter().map(|movement| ComparedMove { movement, number }));
        }
        pieces
    }

    /// Adds the pieces of consecutive moves. A move of which all pieces changed in the same way stays whole.
    fn add_pieces(&mut self, side: usize, pieces: &[ComparedMove], kinds: &[Option<ChangeKind>]) {
        let mut first = 0;
        for group in pieces.chunk_by(|a, b| a.number == b.number) {
            let kinds = &kinds[first..first + group.len()];
            first += group.len();
            if kinds.iter().all(|kind| *kind == kinds[0]) {
                let number = group[0].number;
                let movement = self.sides[side][number].clone();
                self.add_piece(side, ComparedMove { movement, number }, kinds[0]);
            } else {
                for (piece, kind) in group.iter().zip(kinds) {
                    self.add_piece(side, piece.clone(), *kind);
                }
            }
        }
    }

    fn add_piece(&mut self, side: usize, piece: ComparedMove, kind: Option<ChangeKind>) {
        let [old, new] = [self.result.old.len(), self.result.new.len()];
        let list = if side == 0 { &mut self.result.old } else { &mut self.result.new };
        list.push(piece);
        let Some(kind) = kind else { return };
        match side {
            0 => self.add(kind, old..old + 1, new..new),
            _ => self.add(kind, old..old, new..new + 1),
        }
    }

    /// Adds a change; merges it with the previous one if that is adjacent and of the same kind.
    fn add(&mut self, kind: ChangeKind, old: Range<usize>, new: Range<usize>) {
        match self.result.changes.last_mut() {
            Some(last) if last.kind == kind && last.old.end == old.start && last.new.end == new.start => {
                (last.old.end, last.new.end) = (old.end, new.end);
            }
            _ => self.result.changes.push(Change { kind, old, new }),
        }
    }

    /// Returns the kind of change of an old piece; `None` if the new program mills the same line: then, the new pieces there are classified instead.
    fn kind_of_old(&mut self, piece: &SceneMove) -> Option<ChangeKind> {
        let is_milled = !is_rapid(piece)
            && (self.milled[1].lines.contains_key(&self.identities.line(piece))
                || self.milled[1].reaches(piece, &mut self.identities));
        (!is_milled).then_some(ChangeKind::Removed)
    }

    /// Returns the kind of change of a new piece.
    fn kind_of_new(&mut self, piece: &SceneMove) -> ChangeKind {
        if is_rapid(piece) {
            return ChangeKind::Added;
        }
        let line = self.identities.line(piece);
        let [was, is] = &self.milled;
        let (Some(was), Some(is)) = (was.lines.get(&line), is.lines.get(&line)) else {
            let is_milled = self.milled[0].reaches(piece, &mut self.identities);
            return if is_milled { ChangeKind::Reordered } else { ChangeKind::Added };
        };
        was.change(is).unwrap_or(ChangeKind::Reordered)
    }

    /// Returns the kind of change of a piece that is in both programs: if the piece is the deepest pass along its line, the change of the line's
    /// result.
    fn kind_of_equal(&mut self, piece: &ComparedMove) -> Option<ChangeKind> {
        if is_rapid(&piece.movement) {
            return None;
        }
        let line = self.identities.line(&piece.movement);
        let [was, is] = &self.milled;
        let is = is.lines.get(&line).filter(|is| is.deepest == piece.number)?;
        was.lines.get(&line)?.change(is)
    }
}

/// Returns the range from the first to the last cut of a run; `None` if nothing is cut.
fn cut_range(moves: &[SceneMove], row: &Range<usize>) -> Option<Range<usize>> {
    let is_cut = |index: &usize| moves[*index].kind.cuts();
    let first = row.clone().find(is_cut)?;
    let last = row.clone().rfind(is_cut)?;
    Some(first..last + 1)
}

/// All moves of a path that changed in the same way.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    /// Kind of change; `None` for rapid moves, of which only the number is reported.
    pub kind: Option<ChangeKind>,
    /// Number of the moves: in the old program for removed moves, otherwise in the new one.
    pub moves: usize,
    /// Total length of the moves in mm.
    pub length: f64,
    /// End of the first of the moves, in the coordinates of the program.
    pub at: Option<Point>,
}

/// Groups changes by kind, in order of first occurrence. Rapid moves come last.
pub fn groups(compared: &ComparedMoves) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    let mut rapids = Group { kind: None, moves: 0, length: 0.0, at: None };
    // For each group, the number of the last move that was counted: a move may have several pieces in the group.
    let mut counted: Vec<(Option<ChangeKind>, usize)> = Vec::new();
    for change in &compared.changes {
        let moves = match change.kind {
            ChangeKind::Removed => &compared.old[change.old.clone()],
            _ => &compared.new[change.new.clone()],
        };
        for ComparedMove { movement, number } in moves {
            let kind = (!is_rapid(movement)).then_some(change.kind);
            let group = if kind.is_none() { &mut rapids } else { group_of_kind(&mut groups, change.kind) };
            match counted.iter_mut().find(|(known, _)| kind.is_some() && *known == kind) {
                Some((_, last)) if last == number => {}
                Some((_, last)) => {
                    *last = *number;
                    group.moves += 1;
                }
                None => {
                    counted.extend(kind.map(|kind| (Some(kind), *number)));
                    group.moves += 1;
                }
            }
            group.length += movement.way.length();
            if group.at.is_none() && movement.is_placed() {
                group.at = Some(movement.to());
            }
        }
    }
    groups.extend((rapids.moves > 0).then_some(rapids));
    groups
}

fn group_of_kind(groups: &mut Vec<Group>, kind: ChangeKind) -> &mut Group {
    let known = groups.iter().position(|group| group.kind == Some(kind));
    let index = known.unwrap_or_else(|| {
        groups.push(Group { kind: Some(kind), moves: 0, length: 0.0, at: None });
        groups.len() - 1
    });
    &mut groups[index]
}

/// A key that is equal for equal moves.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct MoveIdentity {
    kind: MoveKind,
    /// Numbers of the start and the end, with the axes that are known there.
    ends: [(u32, [bool; 3]); 2],
    /// Number of the middle; 0 for rapid moves.
    middle: u32,
    /// Direction and additional turns of an arc of more than half a turn, which its ends and its middle do not determine.
    turn: Option<(bool, u32)>,
    feed: Option<u32>,
    named: Option<NamedPosition>,
}

/// A key that is equal for moves along the same line in the plane, regardless of direction and height.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct Line {
    /// Whether the move is straight up or down, a probe, or an arc that leaves the plane XY.
    is_vertical: bool,
    is_probe: bool,
    is_vertical_arc: bool,
    ends: [u32; 2],
    middle: u32,
}

/// Assigns numbers to points, and derives from them the keys of moves. Points are the same within tolerances, so that rounding in programs makes no
/// difference.
#[derive(Debug)]
struct Identities {
    ends: Snapper,
    middles: Snapper,
}

impl Default for Identities {
    fn default() -> Self {
        Self { ends: Snapper::new(END_TOLERANCE), middles: Snapper::new(CURVE_TOLERANCE) }
    }
}

impl Identities {
    /// Returns the identity of a move, with coordinates relative to a point in the plane.
    fn of(&mut self, movement: &SceneMove, origin: Point) -> MoveIdentity {
        let way = &movement.way;
        let relative = |at: [f64; 3]| [at[0] - origin[0], at[1] - origin[1], at[2]];
        let mut end = |end: &Position, machine_axes: Axes| {
            let at = relative(end.at);
            let is_stated = |axis: usize| end.known.with(machine_axes).has(Axes::of(axis));
            let known = [0, 1, 2].map(|axis| end.known.has(Axes::of(axis)));
            (self.ends.number([0, 1, 2].map(|axis| if is_stated(axis) { at[axis] } else { 0.0 })), known)
        };
        let machine_axes = match way.named {
            Some(NamedPosition::Machine(axes)) => axes,
            _ => Axes::NONE,
        };
        let to = end(&way.to, machine_axes);
        let named = way.named;
        let feed = way.pace.feed();
        // A rapid move is identified by its end only: it starts where the previous move ends, which is unknown at the beginning of a program.
        if is_rapid(movement) {
            let kind = MoveKind::Sweep;
            return MoveIdentity { kind, ends: [to; 2], middle: 0, turn: None, feed: None, named };
        }
        let ends = [end(&way.from, Axes::NONE), to];
        let turn = match (way.shape, way.course()) {
            (MoveShape::Arc(arc), Some(course)) if course.sweep() > std::f64::consts::PI => {
                Some((arc.clockwise, arc.extra_turns))
            }
            _ => None,
        };
        let feed = feed.map(|feed| self.ends.number([feed, 0.0, 0.0]));
        let middle = self.middles.number(relative(way.point(0.5)));
        MoveIdentity { kind: machine_kind(movement.kind), ends, middle, turn, feed, named }
    }

    /// Returns the line that a move follows.
    fn line(&mut self, movement: &SceneMove) -> Line {
        let way = &movement.way;
        let mut ends = [self.point(&way.from), self.point(&way.to)];
        ends.sort_unstable();
        let [x, y, _] = way.point(0.5);
        Line {
            is_vertical: movement.kind == MoveKind::Plunge,
            is_probe: movement.kind == MoveKind::Probe,
            is_vertical_arc: matches!(way.shape, MoveShape::Arc(arc) if arc.plane != Plane::Xy),
            ends,
            middle: self.middles.number([x, y, 0.0]),
        }
    }

    /// Returns the number of an end in the plane.
    fn point(&mut self, end: &Position) -> u32 {
        self.ends.number([end.x(), end.y(), 0.0])
    }
}

/// Returns one kind for all cuts along elements, which are the same for the machine.
fn machine_kind(kind: MoveKind) -> MoveKind {
    if kind == MoveKind::Mark { MoveKind::Mill } else { kind }
}

/// Number of places along a line at which its depth is compared: the ends, the middle, and the middles between these.
const DEPTH_SAMPLES: usize = 5;

#[derive(Clone, Copy, Debug, PartialEq)]
struct MillingResult {
    /// Lowest Z in mm at places along the line, beginning at the end of the line with the smaller number.
    bottom: [f64; DEPTH_SAMPLES],
    /// Feed in mm/min of the pass that is deepest in the middle.
    feed: f64,
    /// Number of the first move that is deepest in the middle.
    deepest: usize,
    passes: u32,
}

impl MillingResult {
    /// Returns the change to a new result along the same line; `None` if nothing changed.
    fn change(&self, new: &Self) -> Option<ChangeKind> {
        let raised = self.raised(new);
        let feed = ((new.feed - self.feed).abs() > END_TOLERANCE).then_some([self.feed, new.feed]);
        let passes = (new.passes != self.passes).then_some([self.passes, new.passes]);
        let is_equal = raised == [0.0; 2] && feed.is_none() && passes.is_none();
        (!is_equal).then_some(ChangeKind::Altered { raised, feed, passes })
    }

    /// Returns the least and the greatest height in mm by which a new result is higher.
    fn raised(&self, new: &Self) -> [f64; 2] {
        let raised = std::array::from_fn::<f64, DEPTH_SAMPLES, _>(|place| {
            let raised = new.bottom[place] - self.bottom[place];
            if raised.abs() <= END_TOLERANCE { 0.0 } else { (raised * 1000.0).round() / 1000.0 }
        });
        [raised.into_iter().fold(f64::MAX, f64::min), raised.into_iter().fold(f64::MIN, f64::max)]
    }
}

/// The results of milling along each line in the plane that a program's moves follow. Rapid moves are ignored.
#[derive(Debug, Default)]
struct MillingResults {
    lines: HashMap<Line, MillingResult>,
    /// Lowest Z in mm that is milled at each end of a line.
    points: HashMap<u32, f64>,
}

impl MillingResults {
    fn of(moves: &[SceneMove], divider: &mut Divider, identities: &mut Identities) -> Self {
        let mut milled = Self::default();
        for (number, movement) in moves.iter().enumerate().filter(|(_, movement)| !is_rapid(movement)) {
            for piece in divider.divide(movement) {
                milled.add(number, &piece, identities);
            }
        }
        let Self { lines, points } = &mut milled;
        let vertical = lines.iter_mut().filter(|(line, _)| line.is_vertical);
        vertical.for_each(|(line, result)| {
            // Other cuts may mill the ground below a plunge.
            let ground = points.get(&line.ends[0]).copied().unwrap_or(f64::MAX);
            result.bottom = result.bottom.map(|bottom| bottom.min(ground));
        });
        milled
    }

    fn add(&mut self, number: usize, piece: &SceneMove, identities: &mut Identities) {
        let way = &piece.way;
        let line = identities.line(piece);
        let [from, to] = [&way.from, &way.to].map(|end| identities.point(end));
        let bottom = if line.is_vertical || !way.is_known() {
            [piece.depth().unwrap_or_default(); DEPTH_SAMPLES]
        } else {
            let is_reversed = if from == to { is_clockwise(way.shape) } else { from > to };
            std::array::from_fn(|place| {
                let share = place as f64 / (DEPTH_SAMPLES - 1) as f64;
                way.point(if is_reversed { 1.0 - share } else { share })[2]
            })
        };
        if !line.is_probe {
            for end in [&way.from, &way.to] {
                let z = if line.is_vertical { bottom[0] } else { end.z() };
                let lowest = self.points.entry(identities.point(end)).or_insert(z);
                *lowest = lowest.min(z);
            }
        }
        let feed = way.pace.feed().unwrap_or_default();
        let first = MillingResult { bottom, feed, deepest: number, passes: 0 };
        let milled = self.lines.entry(line).or_insert(first);
        milled.passes += 1;
        if bottom[DEPTH_SAMPLES / 2] < milled.bottom[DEPTH_SAMPLES / 2] {
            (milled.feed, milled.deepest) = (feed, number);
        }
        milled.bottom = std::array::from_fn(|place| milled.bottom[place].min(bottom[place]));
    }

    /// Whether a move straight down ends in ground that other cuts mill as deep.
    fn reaches(&self, piece: &SceneMove, identities: &mut Identities) -> bool {
        let bottom = piece.depth().unwrap_or_default();
        let ground = self.points.get(&identities.point(&piece.way.to));
        piece.kind == MoveKind::Plunge && ground.is_some_and(|z| *z <= bottom + END_TOLERANCE)
    }
}

fn is_clockwise(shape: MoveShape) -> bool {
    matches!(shape, MoveShape::Arc(arc) if arc.clockwise)
}

fn is_rapid(movement: &SceneMove) -> bool {
    matches!(movement.kind, MoveKind::Sweep | MoveKind::Lift)
}

#[cfg(test)]
mod tests {
    use pathbuild_diagnostic::Lang;
    use pathbuild_gcode::dialect::Dialect;
    use pathbuild_gcode::interpret::{Options, interpret};
    use pathbuild_motion::Step;

    use super::{ChangeKind, compare, groups, phrase};
    use crate::scene::SceneMove;

    pub(super) fn moves(text: &str) -> Vec<SceneMove> {
        let read = interpret(text.as_bytes(), Dialect::LinuxCnc, &Options::default());
        read.steps
            .iter()
            .filter_map(Step::as_move)
            .map(|(line, way)| SceneMove::new(way, Some(line)))
            .collect()
    }

    const BEGIN: &str = "G21 G90 G17 G94\nG0 Z5\nG0 X0 Y0\n";
    const LINE: &str = "G1 Z-1 F150\nG1 X10 Y0 F150\nG1 X10 Y10 F150\nG0 Z5\n";
    const OTHER: &str = "G0 X20 Y0\nG1 Z-1 F150\nG1 X30 Y0 F150\nG0 Z5\n";

    /// Returns the phrases for the changes from one program to another, each with number of moves and length.
    fn described(old: &str, new: &str) -> Vec<String> {
        let (old, new) = (moves(&format!("{BEGIN}{old}")), moves(&format!("{BEGIN}{new}")));
        let groups = groups(&compare(&old, &new));
        groups
            .iter()
            .map(|group| format!("{} {} {}", phrase(group, Lang::En), group.moves, group.length))
            .collect()
    }

    #[test]
    fn the_same_moves_are_no_change() {
        assert_eq!(described(LINE, LINE), Vec::<String>::new());
        // Half a micrometre is below the precision of printed programs; two micrometres are a change.
        assert_eq!(described(LINE, &LINE.replace("X10 Y0", "X10.0004 Y0")), Vec::<String>::new());
        assert_eq!(described(LINE, &LINE.replace("X10 Y0", "X10.002 Y0")).len(), 2);
    }

    /// All moves count from the first one, at which no position or only that of some axes is known.
    #[test]
    fn the_approach_is_compared() {
        let described = |old: &str, new: &str| {
            let [old, new] =
                [old, new].map(|approach| moves(&format!("G21 G90 G17 G94\n{approach}G0 Z5\n{LINE}")));
            groups(&compare(&old, &new)).iter().map(|group| phrase(group, Lang::En)).collect::<Vec<_>>()
        };
        let usual = "G0 Z15\nG0 X0 Y0\n";
        assert_eq!(described(usual, &usual.replace("Z15", "Z15.0004")), Vec::<String>::new());
        for other in
            ["G0 Z15.002\nG0 X0 Y0\n", "G0 Z-5\nG0 X0 Y0\nG0 Z15\n", "G0 X0 Y0\nG0 Z15\n", "G0 X0 Y0 Z15\n"]
        {
            assert_eq!(described(usual, other), ["other rapid moves"], "{other}");
            assert_eq!(described(other, usual), ["other rapid moves"], "{other}");
        }
        let home = "G53 G0 Z0\nG0 X0 Y0\nG0 Z5\n";
        assert_eq!(described(home, home), Vec::<String>::new());
        for other in ["G53 G0 Z-80\n", "G28 G91 Z0\nG90\n", "G30 G91 Z0\nG90\n", ""] {
            let other = home.replace("G53 G0 Z0\n", other);
            assert_eq!(described(home, &other), ["other rapid moves"], "{other}");
        }
    }

    #[test]
    fn depth_and_feed() {
        assert_eq!(described(LINE, &LINE.replace("Z-1", "Z-1.5")), ["0.5 mm deeper 3 26.5"]);
        assert_eq!(described(LINE, &LINE.replace("Z-1", "Z-0.5"))[0], "0.5 mm higher 3 25.5");
        assert_eq!(
            described(LINE, &LINE.replace("Y10 F150", "Y10 F300")),
            ["faster: F300 instead of F150 1 10"]
        );
        assert_eq!(
            described(LINE, &LINE.replace("Y10 F150", "Y10 F100")),
            ["slower: F100 instead of F150 1 10"]
        );
    }

    #[test]
    fn arcs_between_the_same_ends_differ_by_their_way() {
        let arc = |words: &str| format!("G1 Z-1 F150\n{words} F150\nG0 Z5\n");
        let described = |other: &str| described(&arc("G2 X10 Y0 I5 J0"), &arc(other)).len();
        assert_eq!(described("G2 X10.0002 Y0 I5 J0"), 0);
        assert_ne!(described("G3 X10 Y0 I5 J0"), 0, "the other half of the circle");
        assert_ne!(described("G2 X10 Y0 I5 J-2"), 0, "another centre");
    }

    /// A cycle that begins above its hole makes a move to where the tool is.
    #[test]
    fn rapid_moves_that_stand_still_are_no_change() {
        let there = LINE.replace("G1 Z-1", "G0 X0 Y0 Z5\nG1 Z-1");
        assert_eq!(described(LINE, &there), Vec::<String>::new());
        assert_eq!(described(&there, LINE), Vec::<String>::new());
        let nearly = LINE.replace("G1 Z-1", "G0 Z5.0009\nG1 Z-1");
        assert_eq!(described(LINE, &nearly), Vec::<String>::new());
        assert_ne!(described(LINE, &nearly.replace("5.0009", "5.002")), Vec::<String>::new());
        let elsewhere = there.replace("G0 X0 Y0 Z5", "G0 X0 Y0 Z5\nG0 Z6\nG0 Z5");
        assert_eq!(described(&there, &elsewhere), ["other rapid moves 2 2"]);
    }

    /// Lines and arcs may be divided in any way, as long as the tool takes the same way.
    #[test]
    fn divided_moves_are_no_change() {
        let whole = "G1 Z-1 F150\nG1 X20 Y0\nG2 X40 Y0 I10 J0\nG1 X40 Y10 Z-2\nG0 Z5\n";
        let divided = "G1 Z-1 F150\nG1 X5 Y0\nG1 X20\nG2 X30 Y10 I10 J0\nG2 X40 Y0 I0 J-10\nG1 Y5 Z-1.5\nG1 Y10 Z-2\nG0 Z5\n";
        assert_eq!(described(whole, divided), Vec::<String>::new());
        assert_eq!(described(divided, whole), Vec::<String>::new());
        // Only the changed piece of a line is named.
        let faster = divided.replace("G1 X5 Y0\nG1 X20\n", "G1 X5 Y0\nG1 X20 F300\nF150\n");
        assert_eq!(described(whole, &faster), ["faster: F300 instead of F150 1 15"]);
        let higher = divided.replace("Z-1.5", "Z-1.4");
        let higher = described(whole, &higher);
        assert!(higher.len() == 1 && higher[0].starts_with("up to 0.1 mm higher 2 10.05"), "{higher:?}");
        let shorter =
            whole.replace("X20 Y0\nG2 X40 Y0 I10 J0", "X15 Y0\nG0 Z5\nG0 X20 Y0\nG1 Z-1\nG2 X40 Y0 I10 J0");
        assert!(described(whole, &shorter).contains(&"removed 1 5".to_owned()));
    }

    #[test]
    fn ramps_are_compared_along_their_length() {
        let ramp = |from: &str, to: &str| format!("G1 Z{from} F150\nG1 X40 Z{to}\nG0 Z5\n");
        let flat = ramp("-6", "-6");
        assert!(described(&flat, &ramp("-6", "0"))[0].starts_with("up to 6 mm higher 1 "));
        assert!(
            described(&ramp("0", "-6"), &flat).iter().any(|line| line.starts_with("up to 6 mm deeper 1 "))
        );
        let crossed = described(&ramp("-4", "-6"), &ramp("-6", "-4"));
        assert!(
            crossed.iter().any(|line| line.starts_with("up to 2 mm deeper, up to 2 mm higher 1 ")),
            "{crossed:?}"
        );
        // The way back at full depth makes the ramp irrelevant.
        let ground = |depth: &str| format!("G1 Z0 F150\nG1 X40 Z-6\nG1 X0 Z{depth}\nG0 Z5\n");
        let there_and_back = format!("{flat}G0 X40\nG1 Z-6 F150\nG1 X0\nG0 Z5\n");
        assert!(described(&there_and_back, &ground("-6")).iter().all(|line| !line.contains("higher")));
        assert!(
            described(&there_and_back, &ground("-5"))
                .iter()
                .any(|line| line.starts_with("up to 1 mm higher"))
        );
    }

    #[test]
    fn further_turns_of_an_arc_are_added() {
        let arc = |words: &str| format!("G1 Z-1 F150\nG2 X10 Y0 I5 J0 {words}\nG0 Z5\n");
        assert_eq!(described(&arc("P1"), &arc("")), Vec::<String>::new());
        let turned = described(&arc(""), &arc("P2"));
        assert!(turned.iter().any(|line| line.starts_with("added 1 15.7")), "{turned:?}");
        assert!(turned.iter().any(|line| line.starts_with("passes: 2 instead of 1 1 ")), "{turned:?}");
    }

    /// Support bars leave the ground between them as it was.
    #[test]
    fn only_the_ground_that_changes_is_named() {
        let flat = "G1 Z-2 F150\nG1 X40\nG0 Z5\n";
        let bar = "G1 Z-2 F150\nG1 X18\nG1 Z-1\nG1 X22\nG1 Z-2\nG1 X40\nG0 Z5\n";
        assert_eq!(
            described(flat, bar),
            ["the same in the end, in another order or by other passes 2 2", "1 mm higher 1 4"]
        );
        assert_eq!(described(bar, flat), ["1 mm deeper 1 4"]);
    }

    /// Posts write four decimals, and the centre of an arc as the sum of two numbers.
    #[test]
    fn rounding_is_no_change() {
        let native = "G1 Z-1 F150\nG1 X21.259 Y10.123\nG2 X21.259 Y10.123 I5.111 J3.333\nG0 Z5\n";
        let posted = "G1 Z-1 F150\nG1 X21.2595 Y10.1235\nG2 X21.2595 Y10.1235 I5.1114 J3.3334\nG0 Z5\n";
        assert_eq!(described(native, posted), Vec::<String>::new());
        assert_ne!(described(native, &posted.replace("I5.1114", "I5.115")), Vec::<String>::new());
    }

    #[test]
    fn added_and_removed() {
        let both = format!("{LINE}{OTHER}");
        assert_eq!(described(LINE, &both)[0], "added 2 16");
        assert_eq!(described(&both, LINE)[0], "removed 2 16");
    }

    #[test]
    fn shifted_by_as_much_everywhere_and_not_otherwise() {
        let both = |other: &str| format!("{LINE}{other}G0 X0 Y0\n");
        let shifted = OTHER.replace("Y0", "Y2");
        assert_eq!(described(&both(OTHER), &both(&shifted))[0], "shifted by (0, 2) mm 2 16");
        // If the line also gets longer, it is not shifted.
        let longer = shifted.replace("X30", "X31");
        assert!(!described(&both(OTHER), &both(&longer))[0].contains("shifted"));
    }

    #[test]
    fn another_order() {
        let third = OTHER.replace("X20", "X50").replace("X30", "X60");
        let (before, after) = (format!("{OTHER}{third}"), format!("{third}{OTHER}"));
        let described = described(&before, &after);
        assert!(
            described
                .iter()
                .any(|line| line.starts_with("the same in the end, in another order or by other passes 2")),
            "{described:?}"
        );
    }

    #[test]
    fn passes_count_and_only_the_lowest_is_compared() {
        let groove = |levels: &[&str]| {
            let pass = |z: &&str| format!("G0 X20 Y0\nG1 Z{z} F150\nG1 X30 Y0 F150\nG0 Z5\n");
            levels.iter().map(pass).collect::<String>()
        };
        let passes = described(&groove(&["-1", "-2"]), &groove(&["-0.5", "-1", "-1.5", "-2"]));
        assert_eq!(passes.len(), 2, "{passes:?}");
        assert!(passes[0].starts_with("passes: 4 instead of 2"), "{passes:?}");
        let deeper = described(&groove(&["-1", "-2"]), &groove(&["-1", "-2.2"]));
        assert!(deeper[0].starts_with("0.2 mm deeper"), "{deeper:?}");
        // The intermediate heights differ, but the final depth is the same.
        let other = described(&groove(&["-1", "-2"]), &groove(&["-0.5", "-2"]));
        assert!(other[0].starts_with("the same in the end"), "{other:?}");
    }

    /// The remaining moves are in both programs, but the line that they follow has another depth.
    #[test]
    fn removed_passes_change_the_pass_that_is_now_deepest() {
        let path = |levels: &[&str]| {
            let pass = |z: &&str| format!("G1 Z{z} F150\nG1 X10\nG1 Y10\nG1 X0\nG1 Y0\n");
            format!("{}G0 Z5\n", levels.iter().map(pass).collect::<String>())
        };
        let changes = |old: &[&str], new: &[&str]| described(&path(old), &path(new));
        let raised = changes(&["-1", "-2"], &["-1"]);
        assert!(raised[0].starts_with("1 mm higher, passes: 1 instead of 2 5 "), "{raised:?}");
        let lowered = changes(&["-1"], &["-1", "-2"]);
        assert!(lowered[0].starts_with("1 mm deeper, passes: 2 instead of 1 5 "), "{lowered:?}");
        let fewer = changes(&["-0.5", "-1", "-1.5", "-2"], &["-1", "-2"]);
        assert!(fewer[0].starts_with("passes: 2 instead of 4 6 "), "{fewer:?}");
        let part = format!("{}{OTHER}", path(&["-1", "-2"]));
        let raised = described(&part, &format!("{}{OTHER}", path(&["-1"])));
        assert!(raised.iter().all(|line| !line.contains("the same in the end")), "{raised:?}");
    }

    #[test]
    fn every_change_names_moves_that_are_there() {
        let (old, new) =
            (moves(&format!("{BEGIN}{LINE}{OTHER}")), moves(&format!("{BEGIN}{OTHER}{LINE}{LINE}")));
        let compared = compare(&old, &new);
        for change in &compared.changes {
            assert!(change.old.end <= compared.old.len() && change.new.end <= compared.new.len());
            let is_gone = change.kind == ChangeKind::Removed;
            assert!(if is_gone { change.new.is_empty() } else { !change.new.is_empty() }, "{change:?}");
        }
    }
}
