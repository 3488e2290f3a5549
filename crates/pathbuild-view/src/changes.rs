//! Classifies how the moves of a path change with its drawing: added, removed, deeper, faster, shifted.
//!
//! Moves are compared in the coordinates of the program, so moving a drawing on the sheet changes nothing. (book: program/comparing)

use std::collections::HashMap;
use std::ops::Range;

use imara_diff::{Algorithm, Diff, InternedInput, Interner};
use pathbuild_diagnostic::{Lang, Number, counted};
use pathbuild_motion::{Axes, MoveShape, Position};

use crate::scene::{MoveKind, Point, SceneMove};

/// Consecutive moves that changed in the same way.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// Kind of the change.
    pub kind: ChangeKind,
    /// The old moves that changed; an empty range if moves were added.
    pub old: Range<usize>,
    /// The new moves that changed; an empty range if moves were removed.
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
        /// Height in mm by which the deepest pass is raised; negative if it is deeper.
        raised: f64,
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

const ORIGIN: Point = [0.0; 2];

/// Returns the changes from one program to another, in the order of the new one; empty if both are equivalent.
///
/// Equal moves are ignored. Among the others, a run of moves that occurs at another place is shifted; every other move is classified by
/// comparing the final depth, the feed and the number of passes along its line in the plane.
pub fn compare(old: &[SceneMove], new: &[SceneMove]) -> Vec<Change> {
    let rows = differing_runs(old, new);
    if rows.is_empty() {
        return Vec::new();
    }
    let comparison = Comparison { old, new, was: lines(old), is: lines(new) };
    rows.into_iter().flat_map(|(old, new)| comparison.classify_runs(&old, &new)).collect()
}

/// Returns the runs of moves in which two programs differ, as pairs of ranges in the old and the new one.
fn differing_runs(old: &[SceneMove], new: &[SceneMove]) -> Vec<(Range<usize>, Range<usize>)> {
    // Moves before the first fully known position depend on the machine and are not compared.
    let begin = |moves: &[SceneMove]| {
        moves.iter().take_while(|movement| !movement.way.from.known.has(Axes::ALL)).count()
    };
    let (was, is) = (begin(old), begin(new));
    let interner = Interner::new(old.len() + new.len());
    let mut input = InternedInput { before: Vec::new(), after: Vec::new(), interner };
    input.update_before(old[was..].iter().map(|movement| MoveIdentity::of(movement, ORIGIN)));
    input.update_after(new[is..].iter().map(|movement| MoveIdentity::of(movement, ORIGIN)));
    let row = |start: usize, row: &Range<u32>| start + row.start as usize..start + row.end as usize;
    let diff = Diff::compute(Algorithm::Histogram, &input);
    diff.hunks().map(|hunk| (row(was, &hunk.before), row(is, &hunk.after))).collect()
}

struct Comparison<'a> {
    old: &'a [SceneMove],
    new: &'a [SceneMove],
    was: HashMap<Line, MillingResult>,
    is: HashMap<Line, MillingResult>,
}

impl Comparison<'_> {
    fn classify_runs(&self, old: &Range<usize>, new: &Range<usize>) -> Vec<Change> {
        let mut changes = Vec::new();
        match self.shift_of_runs(old, new) {
            Some(core) => {
                self.classify_moves(old.start..core.old.start, new.start..core.new.start, &mut changes);
                let behind = (core.old.end..old.end, core.new.end..new.end);
                changes.push(core);
                self.classify_moves(behind.0, behind.1, &mut changes);
            }
            None => self.classify_moves(old.clone(), new.clone(), &mut changes),
        }
        changes
    }

    /// Returns a shift if the cuts of both runs and the moves between the cuts are equal except for their position. The approach and the
    /// departure are not compared, because their outer ends did not move.
    fn shift_of_runs(&self, old: &Range<usize>, new: &Range<usize>) -> Option<Change> {
        let (old, new) = (cuts(self.old, old)?, cuts(self.new, new)?);
        let by = [0, 1].map(|axis| self.new[new.start].to()[axis] - self.old[old.start].to()[axis]);
        let is_same =
            |(was, is): (&SceneMove, &SceneMove)| MoveIdentity::of(was, ORIGIN) == MoveIdentity::of(is, by);
        let mut pairs = self.old[old.clone()].iter().zip(&self.new[new.clone()]);
        let is_shifted = old.len() == new.len() && by != ORIGIN && pairs.all(is_same);
        is_shifted.then_some(Change { kind: ChangeKind::Shifted(by), old, new })
    }

    /// Classifies each move by the line that it follows.
    fn classify_moves(&self, old: Range<usize>, new: Range<usize>, changes: &mut Vec<Change>) {
        let (behind, before) = (old.end, new.start);
        for index in old {
            let movement = &self.old[index];
            // If the line is still milled, its move in the new program is classified instead.
            if is_rapid(movement) || !self.is.contains_key(&Line::of(movement)) {
                add(changes, ChangeKind::Removed, index..index + 1, before..before);
            }
        }
        for index in new {
            let movement = &self.new[index];
            let kind = if is_rapid(movement) { ChangeKind::Added } else { self.kind(&Line::of(movement)) };
            add(changes, kind, behind..behind, index..index + 1);
        }
    }

    /// Returns the kind of change of a line that the new program mills.
    fn kind(&self, line: &Line) -> ChangeKind {
        let (Some(was), Some(is)) = (self.was.get(line), self.is.get(line)) else { return ChangeKind::Added };
        let raised = ((is.bottom - was.bottom) * 1000.0).round() / 1000.0 + 0.0;
        let feed = ((is.feed - was.feed).abs() >= 0.001).then_some([was.feed, is.feed]);
        let passes = (is.passes != was.passes).then_some([was.passes, is.passes]);
        match (feed, passes) {
            (None, None) if raised == 0.0 => ChangeKind::Reordered,
            _ => ChangeKind::Altered { raised, feed, passes },
        }
    }
}

/// Adds a move; merges it with the previous change if that is adjacent and of the same kind.
fn add(changes: &mut Vec<Change>, kind: ChangeKind, old: Range<usize>, new: Range<usize>) {
    match changes.last_mut() {
        Some(last) if last.kind == kind && last.old.end == old.start && last.new.end == new.start => {
            (last.old.end, last.new.end) = (old.end, new.end);
        }
        _ => changes.push(Change { kind, old, new }),
    }
}

/// Returns the range from the first to the last cut of a run; `None` if nothing is cut.
fn cuts(moves: &[SceneMove], row: &Range<usize>) -> Option<Range<usize>> {
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
pub fn groups(changes: &[Change], old: &[SceneMove], new: &[SceneMove]) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    let mut rapids = Group { kind: None, moves: 0, length: 0.0, at: None };
    for change in changes {
        let moves = match change.kind {
            ChangeKind::Removed => &old[change.old.clone()],
            _ => &new[change.new.clone()],
        };
        for movement in moves {
            let group = if is_rapid(movement) { &mut rapids } else { of_kind(&mut groups, change.kind) };
            group.moves += 1;
            group.length += movement.length;
            if group.at.is_none() && movement.is_placed() {
                group.at = Some(movement.to());
            }
        }
    }
    groups.extend((rapids.moves > 0).then_some(rapids));
    groups
}

fn of_kind(groups: &mut Vec<Group>, kind: ChangeKind) -> &mut Group {
    let known = groups.iter().position(|group| group.kind == Some(kind));
    let index = known.unwrap_or_else(|| {
        groups.push(Group { kind: Some(kind), moves: 0, length: 0.0, at: None });
        groups.len() - 1
    });
    &mut groups[index]
}

/// A key that is equal for equal moves. Its numbers are in µm and µm/min, so that rounding in printed programs makes no difference.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct MoveIdentity {
    kind: MoveKind,
    ends: [[Option<i64>; 3]; 2],
    arc: Option<Turn>,
    feed: Option<i64>,
}

/// The key of an arc, without its end points.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct Turn {
    axes: [usize; 2],
    centre: [i64; 2],
    is_clockwise: bool,
    extra_turns: u32,
}

impl MoveIdentity {
    /// Returns the identity of a move, with coordinates relative to a point in the plane.
    pub(super) fn of(movement: &SceneMove, origin: Point) -> Self {
        let shift = |axis: usize| origin.get(axis).copied().unwrap_or_default();
        let end = |end: &Position| {
            [0, 1, 2].map(|axis| known_coordinate(end, axis).map(|at| micrometres(at - shift(axis))))
        };
        // A rapid move is identified by its end only: it starts where the previous move ends, which is unknown at the beginning of a
        // program.
        let (kind, from) = if is_rapid(movement) {
            (MoveKind::Sweep, [None; 3])
        } else {
            (movement.kind, end(&movement.way.from))
        };
        let arc = match movement.way.shape {
            MoveShape::Line => None,
            MoveShape::Arc(arc) => {
                let axes = arc.plane.axes();
                let centre = [0, 1].map(|index| micrometres(arc.centre[index] - shift(axes[index])));
                let (is_clockwise, extra_turns) = (arc.clockwise, arc.extra_turns);
                Some(Turn { axes, centre, is_clockwise, extra_turns })
            }
        };
        Self {
            kind,
            ends: [from, end(&movement.way.to)],
            arc,
            feed: movement.way.pace.feed().map(micrometres),
        }
    }
}

/// A key that is equal for moves along the same line in the plane, regardless of direction and height.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct Line {
    kind: MoveKind,
    ends: [[i64; 2]; 2],
    centre: Option<[i64; 2]>,
    /// Distinguishes the two arcs with the same ends and centre: whether this one runs clockwise from the first end.
    is_clockwise: bool,
}

impl Line {
    pub(super) fn of(movement: &SceneMove) -> Self {
        let drawn = [movement.from(), movement.to()].map(|end| end.map(micrometres));
        let mut ends = drawn;
        ends.sort_unstable();
        let (centre, is_clockwise) = match movement.way.shape {
            MoveShape::Line => (None, false),
            MoveShape::Arc(arc) => (Some(arc.centre.map(micrometres)), arc.clockwise == (drawn == ends)),
        };
        Self { kind: movement.kind, ends, centre, is_clockwise }
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct MillingResult {
    /// Lowest Z in mm.
    pub(super) bottom: f64,
    /// Feed of the deepest pass in mm/min.
    pub(super) feed: f64,
    pub(super) passes: u32,
}

/// Returns the result of milling along each line of a program. Rapid moves are ignored.
pub(super) fn lines(moves: &[SceneMove]) -> HashMap<Line, MillingResult> {
    let mut lines: HashMap<Line, MillingResult> = HashMap::new();
    for movement in moves.iter().filter(|movement| !is_rapid(movement)) {
        let (bottom, feed) =
            (movement.depth().unwrap_or_default(), movement.way.pace.feed().unwrap_or_default());
        let milled = lines.entry(Line::of(movement)).or_insert(MillingResult { bottom, feed, passes: 0 });
        milled.passes += 1;
        if bottom < milled.bottom {
            (milled.bottom, milled.feed) = (bottom, feed);
        }
    }
    lines
}

fn is_rapid(movement: &SceneMove) -> bool {
    matches!(movement.kind, MoveKind::Sweep | MoveKind::Lift)
}

fn known_coordinate(end: &Position, axis: usize) -> Option<f64> {
    end.known.has(Axes::of(axis)).then(|| end.at[axis])
}

#[expect(clippy::cast_possible_truncation, reason = "saturates")]
fn micrometres(value: f64) -> i64 {
    (value * 1000.0).round() as i64
}

/// Describes the change of a group of moves, for example "0.5 mm deeper, feed 150 instead of 300".
pub fn phrase(group: &Group, lang: Lang) -> String {
    let choose = |en, de| lang.choose(en, de);
    match group.kind {
        None => choose("other rapid moves", "andere Eilgänge").into(),
        Some(ChangeKind::Added) => choose("added", "dazugekommen").into(),
        Some(ChangeKind::Removed) => choose("removed", "weggefallen").into(),
        Some(ChangeKind::Reordered) => choose(
            "the same in the end, in another order or by other passes",
            "am Ende dasselbe, in anderer Reihenfolge oder anderen Durchgängen",
        )
        .into(),
        Some(ChangeKind::Shifted([x, y])) => {
            let by = format!("({}, {}) mm", Number(x), Number(y));
            choose("shifted by {}", "um {} verschoben").replace("{}", &by)
        }
        Some(ChangeKind::Altered { raised, feed, passes }) => {
            let height = (raised != 0.0).then(|| {
                let way = if raised < 0.0 { choose("deeper", "tiefer") } else { choose("higher", "höher") };
                format!("{} mm {way}", Number(raised.abs()).prose(lang))
            });
            let instead = choose("instead of", "statt");
            let feed = feed.map(|[was, is]| {
                let way =
                    if is > was { choose("faster", "schneller") } else { choose("slower", "langsamer") };
                format!("{way}: F{} {instead} F{}", Number(is), Number(was))
            });
            let passes =
                passes.map(|[was, is]| format!("{}: {is} {instead} {was}", choose("passes", "Durchgänge")));
            height.into_iter().chain(feed).chain(passes).collect::<Vec<_>>().join(", ")
        }
    }
}

/// Describes the number of moves in a group, for example `12 moves`.
pub fn moves(group: &Group, lang: Lang) -> String {
    counted(group.moves, [["move", "moves"], ["Bewegung", "Bewegungen"]], lang)
}

#[cfg(test)]
mod tests {
    use pathbuild_diagnostic::Lang;
    use pathbuild_gcode::dialect::Dialect;
    use pathbuild_gcode::interpret::{Options, interpret};
    use pathbuild_motion::Step;

    use super::{ChangeKind, compare, groups, phrase};
    use crate::scene::SceneMove;

    fn moves(text: &str) -> Vec<SceneMove> {
        let read = interpret(text.as_bytes(), Dialect::Rs274, &Options::default());
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
        let groups = groups(&compare(&old, &new), &old, &new);
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

    #[test]
    fn every_change_names_moves_that_are_there() {
        let (old, new) =
            (moves(&format!("{BEGIN}{LINE}{OTHER}")), moves(&format!("{BEGIN}{OTHER}{LINE}{LINE}")));
        for change in compare(&old, &new) {
            assert!(change.old.end <= old.len() && change.new.end <= new.len());
            let is_gone = change.kind == ChangeKind::Removed;
            assert!(if is_gone { change.new.is_empty() } else { !change.new.is_empty() }, "{change:?}");
        }
    }
}
