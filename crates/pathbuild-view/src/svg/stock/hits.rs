//! Rapid moves through material.

use pathbuild_gcode::interpret::Program;
use pathbuild_gcode::verify::{Cutter, Stock, StockSpan, rapid_hits};
use pathbuild_motion::{Move, MoveShape, Pace, Position, Step};

use super::Blank;
use super::strokes::{CuttingConditions, MovePiece, Piece, cutting_conditions};
use crate::extent::enclosing_box;
use crate::scene::{MoveKind, Point, Scene, SceneMove, ScenePath};

/// Length, in cutter diameters, of the pieces of a rapid move that are checked for material.
const SEARCH_PIECE_DIAMETERS: f64 = 0.25;

/// Maximum number of pieces of a rapid move.
const MAX_PIECES: f64 = 400.0;

/// Returns the pieces of a path's rapid moves that hit material. `index` is that of the path. Several blanks, whose upper faces are in ascending
/// order, may overlap: away from cuts, material is certain only up to the lowest of their upper faces.
pub(super) fn hits(scene: &Scene, path: &ScenePath, index: u32, blanks: &[Blank]) -> Vec<MovePiece> {
    let Some((_, lowest)) = blanks.first() else { return Vec::new() };
    let everywhere =
        blanks.iter().map(|(corners, _)| *corners).reduce(enclosing_box).map(|all| (all, *lowest));
    let mut hits = hits_in(scene, path, index, everywhere);
    if blanks.len() > 1 {
        hits.extend(hits_in(scene, path, index, None));
        hits.sort_unstable();
        hits.dedup();
    }
    hits
}

/// Returns the pieces that hit material near cuts or in this blank.
fn hits_in(scene: &Scene, path: &ScenePath, index: u32, blank: Option<Blank>) -> Vec<MovePiece> {
    let tops = path.moves.iter().filter_map(|movement| cutting_conditions(scene, path, movement));
    let highest = tops.map(|setting| setting.top).fold(f64::NEG_INFINITY, f64::max);
    let touch = blank.map(|blank| move_touching_blank(blank, path.zero));
    let search = HitSearch { scene, path, highest, touch };
    let goes_down = |movement: &SceneMove| movement.way.to.z() <= movement.way.from.z();
    if !path.moves.iter().any(|movement| search.is_low(movement) && goes_down(movement)) {
        return Vec::new();
    }
    let mut lines = rapid_hits(&search, &Stock::of_pieces(search.spans())).into_iter().peekable();
    let mut hits = Vec::new();
    search.each_piece(&mut |line, _, found| {
        if lines.next_if_eq(&line).is_some() {
            hits.extend(found.map(|(movement, piece, _)| MovePiece { path: index, movement, piece }));
        }
    });
    hits
}

/// The moves of a path, prepared for the search for hits: rapid moves below a surface are divided into pieces, so that only the pieces that hit
/// material are reported.
struct HitSearch<'s> {
    scene: &'s Scene,
    path: &'s ScenePath,
    /// Z in mm of the highest upper face.
    highest: f64,
    /// A move that makes the blank known to the search (see [`move_touching_blank`]), and its stock.
    touch: Option<(Move, StockSpan)>,
}

/// A piece of a move, by the index of the move, with its conditions.
type FoundPiece<'c> = (u32, Piece, &'c CuttingConditions);

impl HitSearch<'_> {
    fn is_low(&self, movement: &SceneMove) -> bool {
        matches!(movement.kind, MoveKind::Sweep | MoveKind::Lift)
            && movement.depth().is_some_and(|z| z < self.highest)
    }

    /// Passes each piece to `take`, with the number of its step, which is 1 for the move that touches the blank.
    fn each_piece(&self, take: &mut dyn FnMut(u32, &Move, Option<FoundPiece<'_>>)) {
        let mut last = 0;
        if let Some((way, _)) = &self.touch {
            last = 1;
            take(last, way, None);
        }
        for (index, movement) in (0..).zip(&self.path.moves) {
            let setting = cutting_conditions(self.scene, self.path, movement);
            let Some(setting) = setting.filter(|_| movement.kind != MoveKind::Probe) else { continue };
            let count = self.pieces(movement, &setting);
            for number in 0..count {
                let piece = if count == 1 { Piece::Whole } else { Piece::Part { number, count } };
                last += 1;
                take(last, &piece.of(&movement.way), Some((index, piece, &setting)));
            }
        }
    }

    fn pieces(&self, movement: &SceneMove, setting: &CuttingConditions) -> u16 {
        if !self.is_low(movement) || movement.way.is_vertical() {
            return 1;
        }
        let count = (movement.way.length() / (setting.diameter * SEARCH_PIECE_DIAMETERS))
            .ceil()
            .clamp(1.0, MAX_PIECES);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
        let count = count as u16;
        count
    }

    /// Returns the stock of the steps, with a span for each change.
    fn spans(&self) -> Vec<StockSpan> {
        let mut spans: Vec<StockSpan> = self.touch.iter().map(|(_, span)| *span).collect();
        self.each_piece(&mut |line, _, found| {
            let Some((.., setting)) = found else { return };
            let (surface, cutter) = (setting.top, Cutter::flat(setting.diameter));
            if spans.last().is_none_or(|last| (last.surface, last.cutter) != (surface, cutter)) {
                spans.push(StockSpan { order: line, surface, cutter });
            }
        });
        spans
    }
}

impl Program for HitSearch<'_> {
    fn each(&self, take: &mut dyn FnMut(&Step)) {
        self.each_piece(&mut |line, way, _| take(&Step::of_move(line, *way)));
    }
}

/// Returns a move that touches the upper face of a blank, with a cutter so wide that the material around the move is the entire blank. It
/// makes the blank known to the search for hits.
fn move_touching_blank(([low, high], surface): Blank, zero: Point) -> (Move, StockSpan) {
    let [x, y] = [0, 1].map(|axis| [low[axis] - zero[axis], high[axis] - zero[axis]]);
    let z = surface - TOUCH_DEPTH;
    let (from, to, reach) = if x[1] - x[0] > y[1] - y[0] {
        let middle = f64::midpoint(y[0], y[1]);
        ([x[0], middle, z], [x[1], middle, z], y[1] - middle)
    } else {
        let middle = f64::midpoint(x[0], x[1]);
        ([middle, y[0], z], [middle, y[1], z], x[1] - middle)
    };
    let end = |[x, y, z]: [f64; 3]| Position::known(x, y, z);
    let way =
        Move { from: end(from), to: end(to), shape: MoveShape::Line, pace: Pace::Feed(1.0), named: None };
    let cutter = Cutter { removed: 0.0, colliding: 0.0, ..Cutter::flat(reach) };
    (way, StockSpan { order: 1, surface, cutter })
}

/// Depth in mm of the move that touches a blank, too small to count as material.
const TOUCH_DEPTH: f64 = 1e-4;
