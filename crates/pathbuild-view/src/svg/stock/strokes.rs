//! The areas that cutters sweep, as strokes.

use pathbuild_motion::{Move, MoveShape, Position};

use crate::extent::{Corners, with_margin};
use crate::scene::{MoveKind, Point, Scene, SceneMove, ScenePath, Tip};
use crate::svg::moves::{LineKey, line_key, micrometres};

/// Number of steps into which the deepest slope is divided. Each step has one colour.
pub(super) const SLOPE_STEPS: f64 = 64.0;

/// The area swept by a cutter during a move, in the coordinates of the drawing.
pub(super) struct SweptArea {
    pub(super) way: Move,
    pub(super) diameter: f64,
}

/// A move of a path, or a piece of it. The area that it sweeps is computed whenever it is drawn, because the areas of a long program would take more
/// memory than its moves.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct MovePiece {
    /// Index of the path.
    pub(super) path: u32,
    /// Index into [`ScenePath::moves`].
    pub(super) movement: u32,
    pub(super) piece: Piece,
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Piece {
    Whole,
    /// One of `count` pieces of the same length, counted from 0.
    Part {
        number: u16,
        count: u16,
    },
    /// The lower end.
    Bottom,
}

impl Piece {
    pub(super) fn of(self, way: &Move) -> Move {
        match self {
            Self::Whole => *way,
            Self::Part { number, count } => {
                let part = way.piece(number.into(), count.into());
                if is_vertical_arc(way) { Move { shape: MoveShape::Line, ..part } } else { part }
            }
            Self::Bottom => {
                let bottom = if way.from.z() < way.to.z() { way.from } else { way.to };
                Move { from: bottom, to: bottom, shape: MoveShape::Line, ..*way }
            }
        }
    }
}

/// Whether a move is an arc in a plane other than XY: seen from above, a straight line, whose height changes along it.
fn is_vertical_arc(way: &Move) -> bool {
    matches!(way.shape, MoveShape::Arc(arc) if arc.plane.axes() != [0, 1])
}

/// A stroke to paint. Higher strokes are painted first, and an edge before the cuts at the same height.
pub(super) struct Stroke {
    pub(super) at: MovePiece,
    /// Width in mm: less than the cutter's diameter towards the bottom of a round cut.
    pub(super) diameter: f64,
    pub(super) z: f64,
    pub(super) kind: StrokeKind,
    /// Whether the stroke has the colour of a mark, instead of that of its depth.
    pub(super) is_marked: bool,
}

impl SweptArea {
    /// Returns a key that is equal for areas that look the same: the line and the diameter in micrometres.
    pub(super) fn key(&self) -> (LineKey, i64) {
        (line_key(&self.way), micrometres(self.diameter))
    }

    /// Returns the keys of the area and of the discs at its ends. A plunge sweeps only such a disc.
    pub(super) fn keys(&self) -> [(LineKey, i64); 3] {
        let disc = |end: Position| {
            let way = Move { from: end, to: end, shape: MoveShape::Line, ..self.way };
            Self { way, diameter: self.diameter }.key()
        };
        [self.key(), disc(self.way.from), disc(self.way.to)]
    }
}

impl Stroke {
    pub(super) fn area(&self, paths: &[&ScenePath]) -> SweptArea {
        SweptArea { diameter: self.diameter, ..swept_area(paths, self.at) }
    }

    /// Returns the Z in mm of the ground after the cut. All cuts through the material count as equally deep.
    pub(super) fn height(&self) -> f64 {
        if self.kind >= StrokeKind::ThroughEdge { f64::NEG_INFINITY } else { self.z }
    }
}

/// Sorts strokes in painting order: cuts through the material last, all others from high to low. At the same height, marked strokes are
/// painted first, beneath the others.
pub(super) fn sort(strokes: &mut [Stroke]) {
    let is_through = |stroke: &Stroke| stroke.kind >= StrokeKind::ThroughEdge;
    strokes.sort_by(|one, other| {
        let by_height = is_through(one).cmp(&is_through(other)).then(other.z.total_cmp(&one.z));
        by_height.then(other.is_marked.cmp(&one.is_marked)).then(one.kind.cmp(&other.kind))
    });
}

/// Number of levels of cuts above which the picture counts as that of a relief.
const RELIEF_LEVELS: usize = 16;

/// Height in mm up to which a step has no edge.
const SMALLEST_STEP: f64 = 0.02;

/// Raises the edges of cuts by the height of a step, so that the cuts beside them paint over those of smaller steps. In a relief, whose levels follow
/// a surface, edges of all passes would cover it: there, a step is as high as one of [`RELIEF_LEVELS`] levels. `depth` is that of the deepest cut.
pub(super) fn raise_edges(strokes: &mut [Stroke], depth: f64) {
    let is_edge = |stroke: &&Stroke| stroke.kind == StrokeKind::Edge;
    let mut levels: Vec<f64> = strokes.iter().filter(is_edge).map(|stroke| stroke.z).collect();
    levels.sort_by(f64::total_cmp);
    levels.dedup();
    let is_relief = levels.len() > RELIEF_LEVELS;
    let step = if is_relief { depth / RELIEF_LEVELS as f64 } else { SMALLEST_STEP };
    for stroke in strokes.iter_mut().filter(|stroke| stroke.kind == StrokeKind::Edge) {
        stroke.z = rounded(stroke.z + step);
    }
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum StrokeKind {
    Edge,
    Cut,
    ThroughEdge,
    Through,
}

/// The cutter and the stock that apply to a move.
pub(super) struct CuttingConditions {
    pub(super) diameter: f64,
    pub(super) tip: Tip,
    /// Z in mm of the upper face of the stock.
    pub(super) top: f64,
    /// Z in mm at or below which a cut goes through the stock.
    pub(super) through: f64,
}

pub(super) fn is_known(way: &Move) -> bool {
    way.is_known() && way.named.is_none()
}

/// Returns the area swept by a piece of a move of one of these paths.
pub(super) fn swept_area(paths: &[&ScenePath], MovePiece { path, movement, piece }: MovePiece) -> SweptArea {
    let path = paths[path as usize];
    let movement = &path.moves[movement as usize];
    let way = piece.of(&in_drawing_coordinates(&movement.way, path.zero));
    SweptArea { way, diameter: path.cutter(movement).map_or(0.0, |(diameter, _)| diameter) }
}

/// A move that has a known place and known material.
pub(super) struct StockMove<'s> {
    pub(super) path: &'s ScenePath,
    pub(super) movement: &'s SceneMove,
    pub(super) at: MovePiece,
    pub(super) setting: CuttingConditions,
}

impl StockMove<'_> {
    /// Returns the corners of the stock that the move needs, in the coordinates of the drawing: the cutter's diameter around it.
    pub(super) fn extent(&self) -> Option<Corners> {
        let zero = self.path.zero;
        let corners = self.movement.extent()?.map(|[x, y]| [x + zero[0], y + zero[1]]);
        Some(with_margin(corners, self.setting.diameter))
    }
}

pub(super) fn cuts(scene: &Scene) -> impl Iterator<Item = StockMove<'_>> {
    moves(scene).filter(|cut| cut.movement.kind.cuts())
}

/// Returns the rapid moves that go below both this upper face and the upper face of the stock that applies to them.
pub(super) fn low_rapids(scene: &Scene, top: f64) -> impl Iterator<Item = StockMove<'_>> {
    moves(scene).filter(move |cut| {
        matches!(cut.movement.kind, MoveKind::Sweep | MoveKind::Lift)
            && cut.movement.depth().is_some_and(|z| z < top.min(cut.setting.top))
    })
}

/// Returns the moves with a known place, cutter and material.
fn moves(scene: &Scene) -> impl Iterator<Item = StockMove<'_>> {
    let all = (0..).zip(&scene.paths).flat_map(|(index, path)| {
        (0..).zip(&path.moves).map(move |(movement, way)| (index, path, movement, way))
    });
    let known = all.filter(|(.., movement)| is_known(&movement.way) && movement.extent().is_some());
    known.filter_map(move |(index, path, number, movement)| {
        let at = MovePiece { path: index, movement: number, piece: Piece::Whole };
        Some(StockMove { path, movement, at, setting: cutting_conditions(scene, path, movement)? })
    })
}

pub(super) fn cutting_conditions(
    scene: &Scene,
    path: &ScenePath,
    movement: &SceneMove,
) -> Option<CuttingConditions> {
    let element = movement.element.and_then(|element| path.elements.get(element as usize));
    let component = path.embedded.get(element.map_or(0, |element| element.path as usize));
    let stated = path.tool_span(movement).and_then(|tool| tool.surface);
    let top = stated.or(component.map(|component| component.thickness)).or(path.thickness)?;
    let raised = component.map_or(0.0, |component| component.raised);
    let is_on_zero = scene.program.as_ref().is_none_or(|program| program.is_on_zero);
    let through = if is_on_zero && top > raised { raised + scene.through } else { f64::NEG_INFINITY };
    let (diameter, tip) = path.cutter(movement)?;
    Some(CuttingConditions { diameter, tip, top, through })
}

fn in_drawing_coordinates(way: &Move, zero: Point) -> Move {
    let place =
        |end: &Position| Position { at: [end.at[0] + zero[0], end.at[1] + zero[1], end.at[2]], ..*end };
    let mut moved = Move { from: place(&way.from), to: place(&way.to), ..*way };
    if let MoveShape::Arc(arc) = &mut moved.shape {
        for (axis, coordinate) in arc.plane.axes().into_iter().zip(&mut arc.centre) {
            *coordinate += zero.get(axis).copied().unwrap_or(0.0);
        }
    }
    moved
}

pub(super) struct StrokeBuilder {
    pub(super) strokes: Vec<Stroke>,
    /// Height in mm of the steps of slopes.
    pub(super) step: f64,
    /// Height in mm of the steps of round cuts, which is larger in long programs.
    pub(super) band: f64,
}

impl StrokeBuilder {
    /// Adds the strokes that a cut paints. A slope is divided into pieces, each of which has the height of its upper end; so is an arc that bulges up
    /// or down. Only level cuts and plunges have an edge: the edges of neighbouring slopes would cover each other's surfaces.
    pub(super) fn add_cut(&mut self, at: MovePiece, way: &Move, setting: &CuttingConditions) {
        let step = self.step;
        let [from, to] = [way.from.z(), way.to.z()];
        let [.., Some((low, high))] = way.extent() else { return };
        if low >= setting.top {
            return;
        }
        let bottom = MovePiece { piece: Piece::Bottom, ..at };
        if way.is_vertical() {
            self.add(bottom, low, setting, true);
        } else if high - low < step / 4.0 {
            self.add(at, high, setting, rounded(low) == rounded(high));
        } else {
            let count = if is_vertical_arc(way) { SLOPE_STEPS } else { (high - low) / step };
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "at most the number of steps"
            )]
            let count = count.ceil().clamp(1.0, SLOPE_STEPS) as u16;
            for (number, way) in (0..).zip(way.split(count.into())) {
                let z = way.from.z().max(way.to.z());
                if z < setting.top {
                    self.add(MovePiece { piece: Piece::Part { number, count }, ..at }, z, setting, false);
                }
            }
            let end = from.min(to);
            if end < setting.top {
                self.add(bottom, end, setting, false);
            }
        }
    }

    /// Adds the strokes of a piece. A round cut is divided into steps, each of which has the height of its middle and ends at its exact width.
    fn add(&mut self, at: MovePiece, z: f64, setting: &CuttingConditions, has_edge: bool) {
        let Tip::Round(radius) = setting.tip else {
            return self.add_stroke(at, z, setting.diameter, setting, has_edge);
        };
        let radius = radius.min(setting.diameter / 2.0);
        let flat = setting.diameter - 2.0 * radius;
        if flat > 0.0 {
            self.add_stroke(at, z, flat, setting, false);
        }
        let rise = radius.min(setting.top - z);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
        let count = (rise / self.band).ceil().clamp(1.0, SLOPE_STEPS) as u16;
        for step in 1..=count {
            let upper = rise * f64::from(step) / f64::from(count);
            let middle = upper - rise / f64::from(2 * count);
            let width = flat + 2.0 * libm::sqrt(upper * (2.0 * radius - upper));
            self.add_stroke(at, z + middle, width, setting, has_edge && step == count);
        }
    }

    fn add_stroke(
        &mut self,
        at: MovePiece,
        z: f64,
        diameter: f64,
        setting: &CuttingConditions,
        has_edge: bool,
    ) {
        let (z, edge, kind) = if z <= setting.through {
            (setting.through, StrokeKind::ThroughEdge, StrokeKind::Through)
        } else {
            (rounded(z), StrokeKind::Edge, StrokeKind::Cut)
        };
        let stroke = |kind| Stroke { at, diameter, z, kind, is_marked: false };
        self.strokes.extend(has_edge.then_some(stroke(edge)));
        self.strokes.push(stroke(kind));
    }
}

pub(super) fn number(index: usize) -> u32 {
    u32::try_from(index).unwrap_or(u32::MAX)
}

/// Rounds a height to a micrometre, so that cuts at the same height can be drawn as one path.
fn rounded(z: f64) -> f64 {
    (z * 1000.0).round() / 1000.0
}
