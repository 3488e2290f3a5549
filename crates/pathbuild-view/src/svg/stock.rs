//! The stock as it is when all moves are done, seen from above. (book: program/pictures)
//!
//! The area that a cutter sweeps is drawn as a stroke as wide as the cutter. Strokes are painted from high to low, so that each place
//! shows its lowest cut. All sizes are exact at any scale.

use std::collections::BTreeMap;

use pathbuild_diagnostic::{Code, Lang};
use pathbuild_gcode::interpret::Program;
use pathbuild_gcode::verify::{Cutter, Stock, StockSpan, rapid_hits};
use pathbuild_motion::{Axes, Move, MoveShape, Pace, Position, Step};

use super::canvas::{Anchor, Canvas, INK_COLOUR, mm, svg_number};
use super::frame::{Frame, PageTransform, VisibleParts, widen};
use super::legend::LINE_HEIGHT;
use super::moves::path_data;
use super::symbols;
use crate::scene::{FinishedPart, MoveKind, Point, Scene, SceneMove, ScenePath, Shape, ToolSpan};

const UNTOUCHED_COLOUR: &str = "#dbbd85";
const EDGE_COLOUR: &str = "#4a3012";
const THROUGH_COLOUR: &str = "#ccd6e0";
/// Colour of defects: rapid moves through material, cuts into parts, and support bars that are cut away.
const WRONG_COLOUR: &str = "#e50d1a";
const LEFTOVER_COLOUR: &str = "#9628c8";
const REMOVED_NOW_COLOUR: &str = "#0072b2";
const LOOSE_COLOUR: &str = "#e69f00";
const OUTLINE_COLOUR: &str = "#0b57c4";

/// Colours of the shallowest and the deepest cut, as red, green and blue.
const DEPTH_COLOURS: [[f64; 3]; 2] = [[189.0, 148.0, 92.0], [115.0, 77.0, 41.0]];

/// Width in px of the line along the edges of cuts.
const EDGE_WIDTH: f64 = 0.7;

/// Number of steps into which the deepest slope is divided. Each step has one colour.
const SLOPE_STEPS: f64 = 64.0;

/// Length, in cutter diameters, of the pieces of a rapid move that are checked for material.
const SEARCH_PIECE: f64 = 0.25;

/// Maximum number of pieces of a rapid move.
const MAX_PIECES: f64 = 400.0;

/// Maximum number of strokes that are combined to one SVG path. The time for rendering a path grows with the square of its strokes, and
/// the memory with their number.
const MAX_COMBINED_STROKES: usize = 512;

/// The cuts of a scene, and the stock that surrounds them.
pub(super) struct MilledStock<'s> {
    pub(super) scene: &'s Scene,
    /// The paths to which the pieces of moves refer.
    paths: Vec<&'s ScenePath>,
    blanks: Vec<Blank>,
    strokes: Vec<Stroke>,
    /// Pieces of rapid moves that hit material.
    hits: Vec<MovePiece>,
    /// Colour of the marked strokes, instead of the colour of their depth.
    mark: &'static str,
    /// Z in mm of the highest upper face and of the deepest cut.
    range: [f64; 2],
    /// Whether corners that the cutter does not reach are filled, because a finding of the scene mentions some or the caller asks for it.
    pub(super) has_corners: bool,
}

/// Corners of a rectangle of stock, and Z in mm of its upper face.
type Blank = ([Point; 2], f64);

/// The area swept by a cutter during a move, in the coordinates of the drawing.
struct SweptArea {
    way: Move,
    diameter: f64,
}

/// A move of a path, or a piece of it. The area that it sweeps is computed whenever it is drawn, because the areas of a long program would take more
/// memory than its moves.
#[derive(Clone, Copy)]
struct MovePiece {
    /// Index into [`MilledStock::paths`].
    path: u32,
    /// Index into [`ScenePath::moves`].
    movement: u32,
    piece: Piece,
}

#[derive(Clone, Copy)]
enum Piece {
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
    fn of(self, way: &Move) -> Move {
        match self {
            Self::Whole => *way,
            Self::Part { number, count } => {
                let part = way.piece(number.into(), count.into());
                if is_upright(way) { Move { shape: MoveShape::Line, ..part } } else { part }
            }
            Self::Bottom => {
                let bottom = if way.from.z() < way.to.z() { way.from } else { way.to };
                Move { from: bottom, to: bottom, shape: MoveShape::Line, ..*way }
            }
        }
    }
}

/// Whether a move is an arc in a plane other than XY: seen from above, a straight line, whose height changes along it.
fn is_upright(way: &Move) -> bool {
    matches!(way.shape, MoveShape::Arc(arc) if arc.plane.axes() != [0, 1])
}

/// A stroke to paint. Higher strokes are painted first, and an edge before the cuts at the same height.
struct Stroke {
    at: MovePiece,
    z: f64,
    kind: StrokeKind,
    /// Whether the stroke has the colour of [`MilledStock::mark`].
    is_marked: bool,
}

impl SweptArea {
    /// Returns a key that is equal for areas that look the same: the move in micrometres, without heights, and the diameter.
    fn key(&self) -> [i64; 7] {
        let Move { from, to, shape, .. } = &self.way;
        let centre = if let MoveShape::Arc(arc) = shape { arc.centre } else { [0.0; 2] };
        let ([a, b, _], [c, d, _]) = (from.at, to.at);
        #[expect(clippy::cast_possible_truncation, reason = "saturates")]
        let micrometres = |value: f64| (value * 1000.0).round() as i64;
        [a, b, c, d, centre[0], centre[1], self.diameter].map(micrometres)
    }
}

impl Stroke {
    /// Returns the height that remains after the cut. All cuts through the material have the same height.
    fn height(&self) -> f64 {
        if self.kind >= StrokeKind::ThroughEdge { f64::NEG_INFINITY } else { self.z }
    }
}

/// Sorts strokes in painting order: cuts through the material last, all others from high to low. At the same height, marked strokes are
/// painted first, beneath the others.
fn sort(strokes: &mut [Stroke]) {
    let is_through = |stroke: &Stroke| stroke.kind >= StrokeKind::ThroughEdge;
    strokes.sort_by(|one, other| {
        let by_height = is_through(one).cmp(&is_through(other)).then(other.z.total_cmp(&one.z));
        by_height.then(other.is_marked.cmp(&one.is_marked)).then(one.kind.cmp(&other.kind))
    });
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum StrokeKind {
    Edge,
    Cut,
    ThroughEdge,
    Through,
}

/// The cutter and the stock that apply to a move.
struct CuttingConditions {
    diameter: f64,
    /// Z in mm of the upper face of the stock.
    top: f64,
    /// Z in mm at or below which a cut goes through the stock.
    through: f64,
}

impl<'s> MilledStock<'s> {
    pub(super) fn of(scene: &'s Scene) -> Self {
        let mut blanks: Vec<Blank> = Vec::new();
        let (mut low, mut count) = (f64::INFINITY, 0);
        for Cut { path, movement, setting, .. } in cuts(scene) {
            let Some([from, to]) = movement.extent() else { continue };
            let zero = path.zero;
            let extent = [
                [0, 1].map(|axis| from[axis] + zero[axis] - setting.diameter),
                [0, 1].map(|axis| to[axis] + zero[axis] + setting.diameter),
            ];
            match blanks.iter_mut().find(|(_, top)| *top == setting.top) {
                Some((blank, _)) => {
                    let mut corners = Some(*blank);
                    widen(&mut corners, extent);
                    *blank = corners.unwrap_or(*blank);
                }
                None => blanks.push((extent, setting.top)),
            }
            low = movement.depth().map_or(low, |z| low.min(z));
            count += 1;
        }
        blanks.sort_by(|one, other| one.1.total_cmp(&other.1));
        let low = if count > 0 { low } else { 0.0 };
        let top = blanks.last().map_or(low, |(_, top)| *top);
        let step = ((top - low) / SLOPE_STEPS).max(1e-3);
        let blank = if let [blank] = blanks[..] { Some(blank) } else { None };
        let hits =
            (0..).zip(&scene.paths).flat_map(|(index, path)| hits(scene, path, index, blank)).collect();
        let mut painter = StrokeBuilder { strokes: Vec::with_capacity(2 * count) };
        for Cut { at, movement, setting, .. } in cuts(scene) {
            painter.cut(at, &movement.way, &setting, step);
        }
        let mut strokes = painter.strokes;
        sort(&mut strokes);
        let unreachable = Code::UnreachableCorner.to_string();
        let has_corners = scene.findings.iter().any(|finding| finding.code == unreachable);
        let (paths, mark) = (scene.paths.iter().collect(), THROUGH_COLOUR);
        Self { scene, paths, blanks, strokes, hits, mark, range: [top, low], has_corners }
    }

    /// Combines two stocks, and marks the cuts of this one that are deeper than those of the other. Returns `None` if there are none,
    /// because the other stock has all these cuts, or deeper ones along the same lines.
    fn compare_with(mut self, other: Self, mark: &'static str) -> Option<Self> {
        let mut heights: BTreeMap<_, f64> = BTreeMap::new();
        for stroke in &other.strokes {
            let height = heights.entry(other.area(stroke.at).key()).or_insert(f64::INFINITY);
            *height = height.min(stroke.height());
        }
        let paths = self.paths.as_slice();
        let is_deeper = |stroke: &Stroke| {
            heights.get(&swept_area(paths, stroke.at).key()).is_none_or(|z| stroke.height() < *z)
        };
        self.strokes.retain(|stroke| matches!(stroke.kind, StrokeKind::Cut | StrokeKind::Through));
        self.strokes.retain(is_deeper);
        if self.strokes.is_empty() {
            return None;
        }
        self.mark = mark;
        for stroke in &mut self.strokes {
            stroke.is_marked = true;
        }
        let first = number(self.paths.len());
        self.paths.extend(other.paths);
        let others = other.strokes.into_iter();
        let moved = |at: MovePiece| MovePiece { path: first + at.path, ..at };
        self.strokes.extend(others.map(|stroke| Stroke { at: moved(stroke.at), ..stroke }));
        sort(&mut self.strokes);
        self.blanks.extend(other.blanks);
        self.range = [self.range[0].max(other.range[0]), self.range[1].min(other.range[1])];
        self.hits.clear();
        Some(self)
    }

    /// Removes the strokes and hits outside of an area.
    pub(super) fn keep_near(mut self, [low, high]: [Point; 2]) -> Self {
        let paths = self.paths.as_slice();
        let is_near = |at: MovePiece| {
            let swept = swept_area(paths, at);
            let radius = swept.diameter / 2.0;
            let sides = swept.way.extent().into_iter().zip(low.into_iter().zip(high));
            sides.into_iter().all(|(side, (low, high))| {
                side.is_none_or(|(from, to)| from - radius <= high && to + radius >= low)
            })
        };
        self.strokes.retain(|stroke| is_near(stroke.at));
        self.hits.retain(|hit| is_near(*hit));
        self
    }

    /// Returns the bounding box of the stock and of the places of findings.
    pub(super) fn extent(&self) -> Option<[Point; 2]> {
        let mut corners = None;
        for (blank, _) in &self.blanks {
            widen(&mut corners, *blank);
        }
        for at in self.scene.findings.iter().filter_map(|finding| finding.at) {
            widen(&mut corners, [at, at]);
        }
        corners
    }

    /// Draws the stock with its defects, and the outlines of the parts. `id` makes the ids of clip paths unique.
    pub(super) fn draw(&self, canvas: &mut Canvas, frame: &Frame, id: &str) {
        let place = frame.of_drawing();
        self.blanks(canvas, &place, id);
        canvas.open(&format!(
            "clip-path=\"url(#{id})\" fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\""
        ));
        let middle = self.strokes.partition_point(|stroke| stroke.kind < StrokeKind::ThroughEdge);
        self.strokes(canvas, &place, &self.strokes[..middle]);
        self.parts(|part, path, number| {
            draw_leftovers(canvas, part, &frame.of_path(path), &format!("{id}-outside-{number}"));
        });
        if self.has_corners {
            self.parts(|part, path, number| {
                draw_corners(canvas, part, &frame.of_path(path), &format!("{id}-corners-{number}"));
            });
        }
        self.strokes(canvas, &place, &self.strokes[middle..]);
        self.parts(|part, path, number| {
            draw_defects(canvas, part, &frame.of_path(path), &format!("{id}-inside-{number}"));
        });
        let mut hits = String::new();
        for (index, hit) in self.hits.iter().enumerate() {
            let SweptArea { way, diameter } = self.area(*hit);
            hits.push_str(&path_data(&way, &place));
            if self.hits.get(index + 1).is_none_or(|next| self.area(*next).diameter != diameter) {
                stroke(canvas, &std::mem::take(&mut hits), diameter * place.scale(), WRONG_COLOUR);
            }
        }
        canvas.close();
        draw_uncut_parts(canvas, self.scene, &place);
        canvas.open(&format!("fill=\"none\" stroke=\"{OUTLINE_COLOUR}\" stroke-width=\"1.2\""));
        self.parts(|part, path, _| {
            for ring in &part.rings {
                canvas.path(&symbols::outline(ring, &frame.of_path(path)), "");
            }
        });
        canvas.close();
    }

    fn blanks(&self, canvas: &mut Canvas, place: &PageTransform, id: &str) {
        let all: String = self.blanks.iter().map(|(corners, _)| rectangle(place, *corners)).collect();
        canvas.raw(&format!("<clipPath id=\"{id}\"><path d=\"{all}\"/></clipPath>"));
        canvas.path(&all, &format!("fill=\"{UNTOUCHED_COLOUR}\""));
    }

    /// Draws strokes, combining consecutive ones that look alike to a single path, up to [`MAX_COMBINED_STROKES`].
    fn strokes(&self, canvas: &mut Canvas, place: &PageTransform, strokes: &[Stroke]) {
        let mut all = String::new();
        let mut count = 0;
        for (index, next) in strokes.iter().enumerate() {
            let SweptArea { way, diameter } = self.area(next.at);
            all.push_str(&path_data(&way, place));
            count += 1;
            let is_alike = |other: &Stroke| {
                other.kind == next.kind
                    && other.z == next.z
                    && other.is_marked == next.is_marked
                    && self.area(other.at).diameter == diameter
            };
            if count < MAX_COMBINED_STROKES && strokes.get(index + 1).is_some_and(is_alike) {
                continue;
            }
            count = 0;
            let width = diameter * place.scale();
            let data = std::mem::take(&mut all);
            match next.kind {
                StrokeKind::Edge | StrokeKind::ThroughEdge => {
                    stroke(canvas, &data, width + 2.0 * EDGE_WIDTH, EDGE_COLOUR);
                }
                StrokeKind::Cut | StrokeKind::Through => {
                    let through = (next.kind == StrokeKind::Through).then_some(THROUGH_COLOUR);
                    let mark = next.is_marked.then_some(self.mark);
                    let color = mark.or(through).map_or_else(|| self.color(next.z), str::to_owned);
                    stroke(canvas, &data, width, &color);
                }
            }
        }
    }

    fn area(&self, at: MovePiece) -> SweptArea {
        swept_area(&self.paths, at)
    }

    fn color(&self, z: f64) -> String {
        let [top, low] = self.range;
        depth_color(((top - z) / (top - low).max(1e-6)).clamp(0.0, 1.0))
    }

    fn parts(&self, mut each: impl FnMut(&FinishedPart, &ScenePath, usize)) {
        let parts = self.scene.paths.iter().flat_map(|path| path.parts.iter().map(move |part| (part, path)));
        for (number, (part, path)) in parts.enumerate() {
            each(part, path, number);
        }
    }

    /// Draws the meaning of the colours, from `left` to `right` and continuing on further lines.
    pub(super) fn legend(&self, canvas: &mut Canvas, shown: VisibleParts, at: Point, right: f64) {
        for LegendEntry { at: [x, y], color, name } in self.legend_entries(shown, at, right) {
            let style = format!("fill=\"{color}\" stroke=\"{EDGE_COLOUR}\" stroke-width=\"0.5\"");
            canvas.path(&format!("M{} {}h12v10h-12Z", svg_number(x), svg_number(y - 9.0)), &style);
            canvas.text([x + 17.0, y], 10.5, Anchor::Start, &format!("fill=\"{INK_COLOUR}\""), &name);
        }
    }

    /// Returns the height in px of the legend's lines after the first one.
    pub(super) fn legend_overhang(&self, shown: VisibleParts, [left, top]: Point, right: f64) -> f64 {
        self.legend_entries(shown, [left, top], right).last().map_or(0.0, |entry| entry.at[1] - top)
    }

    fn legend_entries(&self, shown: VisibleParts, [left, mut y]: Point, right: f64) -> Vec<LegendEntry> {
        let [top, low] = self.range;
        let has = |kind| self.strokes.iter().any(|stroke| stroke.kind == kind);
        let has_part = |is_such: fn(&FinishedPart) -> bool| {
            self.scene.paths.iter().flat_map(|path| &path.parts).any(is_such)
        };
        let depths = format!("Z {} … {}", mm(top), mm(low));
        let all = [
            (true, UNTOUCHED_COLOUR.to_owned(), shown.choose("untouched", "unberührt")),
            (has(StrokeKind::Cut), depth_color(0.0), depths.as_str()),
            (
                has(StrokeKind::Cut),
                depth_color(1.0),
                shown.choose("the darker, the deeper", "je dunkler, desto tiefer"),
            ),
            (
                has(StrokeKind::Through),
                THROUGH_COLOUR.to_owned(),
                shown.choose("cut through", "durchgefräst"),
            ),
            (
                has_part(|_| true),
                OUTLINE_COLOUR.to_owned(),
                shown.choose("outline of the part", "Umriss des Teils"),
            ),
            (
                has_part(|part| !part.gouges.is_empty()),
                WRONG_COLOUR.to_owned(),
                shown.choose("cut into the part", "Schnitt ins Teil"),
            ),
            (
                has_part(|part| !part.left.is_empty()),
                LEFTOVER_COLOUR.to_owned(),
                shown.choose("left at the part", "bleibt am Teil stehen"),
            ),
            (
                self.has_corners,
                LEFTOVER_COLOUR.to_owned(),
                shown.choose("corner out of the cutter's reach", "Ecke, die der Fräser nicht erreicht"),
            ),
            (
                !self.scene.uncut.is_empty(),
                LEFTOVER_COLOUR.to_owned(),
                shown.choose("outline that is not cut", "nicht gefräster Umriss"),
            ),
            (
                has_part(|part| part.is_loose),
                LOOSE_COLOUR.to_owned(),
                shown.choose("loose part", "loses Teil"),
            ),
            (
                has_part(|part| !part.lost_bars.is_empty()),
                WRONG_COLOUR.to_owned(),
                shown.choose("support bar cut away", "abgetrennter Stützsteg"),
            ),
            (
                !self.hits.is_empty(),
                WRONG_COLOUR.to_owned(),
                shown.choose("rapid move through material", "Eilgang durch Material"),
            ),
        ];
        let mut x = left;
        let present = all.into_iter().filter(|(is_there, ..)| *is_there);
        let entries = present.map(|(_, color, name)| {
            let width = 38.0 + 6.6 * name.chars().count() as f64;
            if x + width > right {
                (x, y) = (left, y + LINE_HEIGHT);
            }
            let at = [x, y];
            x += width;
            LegendEntry { at, color, name: name.to_owned() }
        });
        entries.collect()
    }
}

/// A colour of the legend, with its meaning.
struct LegendEntry {
    /// Start of the baseline, in px.
    at: Point,
    color: String,
    name: String,
}

/// The two pictures that show how a change affects the stock.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StockChange {
    /// Shows the material that is removed now but was not before.
    Removed,
    /// Shows the material that is left now but was removed before.
    Left,
}

/// Draws the material that a change additionally removes from the stock, or additionally leaves. Returns `None` if there is none, or if
/// the stock is unknown.
pub fn stock_change_svg(old: &ScenePath, new: &ScenePath, change: StockChange, lang: Lang) -> Option<String> {
    // Programs are compared in their own coordinates, wherever the path is in the drawing.
    let [old, new] = [old, new].map(|path| Scene {
        paths: vec![ScenePath { zero: [0.0; 2], parts: Vec::new(), ..path.clone() }],
        ..Scene::new("")
    });
    let [old, new] = [&old, &new].map(MilledStock::of);
    if old.blanks.is_empty() || new.blanks.is_empty() {
        return None;
    }
    let (stock, other, id, color) = match change {
        StockChange::Removed => (new, old, "stock-removed", REMOVED_NOW_COLOUR),
        StockChange::Left => (old, new, "stock-left", LEFTOVER_COLOUR),
    };
    let stock = stock.compare_with(other, color)?;
    let frame = Frame::around(stock.extent());
    let mut canvas = Canvas::new(Frame::WIDTH, frame.bottom());
    stock.draw(&mut canvas, &frame, id);
    let (en, de) = match change {
        StockChange::Removed => ("removed now, not before", "jetzt weggefräst, vorher nicht"),
        StockChange::Left => ("left now, removed before", "bleibt jetzt stehen, vorher weggefräst"),
    };
    let y = frame.bottom() - 14.0;
    canvas.path(&format!("M40 {}h12v10h-12Z", svg_number(y - 9.0)), &format!("fill=\"{color}\""));
    canvas.text([57.0, y], 13.0, Anchor::Start, &format!("fill=\"{INK_COLOUR}\""), lang.choose(en, de));
    Some(canvas.finish())
}

/// Whether the stock of a scene can be drawn: for at least one cut, the cutter and the upper face of the material are known.
pub fn has_stock(scene: &Scene) -> bool {
    scene.paths.iter().any(|path| {
        let mut cuts = path.moves.iter().filter(|movement| movement.kind.cuts() && is_known(&movement.way));
        cuts.any(|movement| cutting_conditions(scene, path, movement).is_some())
    })
}

fn is_known(way: &Move) -> bool {
    way.from.known.and(way.to.known) == Axes::ALL && way.named.is_none()
}

/// Returns the area swept by a piece of a move of one of these paths.
fn swept_area(paths: &[&ScenePath], MovePiece { path, movement, piece }: MovePiece) -> SweptArea {
    let path = paths[path as usize];
    let movement = &path.moves[movement as usize];
    let way = piece.of(&in_drawing_coordinates(&movement.way, path.zero));
    SweptArea { way, diameter: cutter(path, movement).unwrap_or_default() }
}

/// A cut that has a known place and known material.
struct Cut<'s> {
    path: &'s ScenePath,
    movement: &'s SceneMove,
    at: MovePiece,
    setting: CuttingConditions,
}

fn cuts(scene: &Scene) -> impl Iterator<Item = Cut<'_>> {
    let all = (0..).zip(&scene.paths).flat_map(|(index, path)| {
        (0..).zip(&path.moves).map(move |(movement, way)| (index, path, movement, way))
    });
    let known = all.filter(|(.., movement)| {
        movement.kind.cuts() && is_known(&movement.way) && movement.extent().is_some()
    });
    known.filter_map(move |(index, path, number, movement)| {
        let at = MovePiece { path: index, movement: number, piece: Piece::Whole };
        Some(Cut { path, movement, at, setting: cutting_conditions(scene, path, movement)? })
    })
}

fn cutting_conditions(scene: &Scene, path: &ScenePath, movement: &SceneMove) -> Option<CuttingConditions> {
    let element = movement.element.and_then(|element| path.elements.get(element as usize));
    let component = path.embedded.get(element.map_or(0, |element| element.path as usize));
    let stated = tool_span(path, movement).and_then(|tool| tool.surface);
    let top = stated.or(component.map(|component| component.thickness)).or(path.thickness)?;
    let raised = component.map_or(0.0, |component| component.raised);
    let is_on_zero = scene.program.as_ref().is_none_or(|program| program.is_on_zero);
    let through = if is_on_zero && top > raised { raised + scene.through } else { f64::NEG_INFINITY };
    Some(CuttingConditions { diameter: cutter(path, movement)?, top, through })
}

/// Returns the diameter in mm of the cutter of a move.
fn cutter(path: &ScenePath, movement: &SceneMove) -> Option<f64> {
    tool_span(path, movement).map(|tool| tool.diameter).or(path.tool)
}

fn tool_span<'s>(path: &'s ScenePath, movement: &SceneMove) -> Option<&'s ToolSpan> {
    let line = movement.line.unwrap_or(0);
    let later = path.tools.partition_point(|tool| tool.line <= line);
    later.checked_sub(1).map(|index| &path.tools[index])
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

struct StrokeBuilder {
    strokes: Vec<Stroke>,
}

impl StrokeBuilder {
    /// Adds the strokes that a cut paints. A slope is divided into pieces, each of which has the height of its upper end; so is an arc that bulges up or
    /// down. Only level cuts have an edge: those of neighbouring slopes would cover each other's surfaces.
    fn cut(&mut self, at: MovePiece, way: &Move, setting: &CuttingConditions, step: f64) {
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
            let count = if is_upright(way) { SLOPE_STEPS } else { (high - low) / step };
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

    fn add(&mut self, at: MovePiece, z: f64, setting: &CuttingConditions, has_edge: bool) {
        let (z, edge, kind) = if z <= setting.through {
            (setting.through, StrokeKind::ThroughEdge, StrokeKind::Through)
        } else {
            (rounded(z), StrokeKind::Edge, StrokeKind::Cut)
        };
        let stroke = |kind| Stroke { at, z, kind, is_marked: false };
        self.strokes.extend(has_edge.then_some(stroke(edge)));
        self.strokes.push(stroke(kind));
    }
}

fn number(index: usize) -> u32 {
    u32::try_from(index).unwrap_or(u32::MAX)
}

/// Rounds a height to a micrometre, so that cuts at the same height can be drawn as one path.
fn rounded(z: f64) -> f64 {
    (z * 1000.0).round() / 1000.0
}

/// Returns the pieces of a path's rapid moves that hit material. If not all cuts share one blank, the material is only known near cuts. `index` is that
/// of the path.
fn hits(scene: &Scene, path: &ScenePath, index: u32, blank: Option<Blank>) -> Vec<MovePiece> {
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

/// The moves of a path in the form in which hits are searched: rapid moves below a surface are divided into pieces, so that only those pieces are found
/// that hit material.
struct HitSearch<'s> {
    scene: &'s Scene,
    path: &'s ScenePath,
    /// Z in mm of the highest upper face.
    highest: f64,
    /// A move that makes the blank known, and its stock.
    touch: Option<(Move, StockSpan)>,
}

/// A piece of a move, by the index of the move, with its conditions.
type FoundPiece<'c> = (u32, Piece, &'c CuttingConditions);

impl HitSearch<'_> {
    fn is_low(&self, movement: &SceneMove) -> bool {
        matches!(movement.kind, MoveKind::Sweep | MoveKind::Lift)
            && movement.depth().is_some_and(|z| z < self.highest)
    }

    /// Passes on each piece with the number of its step, which is 1 for the move that touches the blank.
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
        let count = (movement.length / (setting.diameter * SEARCH_PIECE)).ceil().clamp(1.0, MAX_PIECES);
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
                spans.push(StockSpan { line, surface, cutter });
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
    let cutter = Cutter { diameter: reach, removed: 0.0, colliding: 0.0 };
    (way, StockSpan { line: 1, surface, cutter })
}

/// Depth in mm of the move that touches a blank, too small to count as material.
const TOUCH_DEPTH: f64 = 1e-4;

pub(super) fn draw_uncut_parts(canvas: &mut Canvas, scene: &Scene, place: &PageTransform) {
    let style = format!("fill=\"{LEFTOVER_COLOUR}\" fill-opacity=\"0.35\"");
    for ring in &scene.uncut {
        canvas.path(&symbols::outline(ring, place), &style);
    }
}

fn stroke(canvas: &mut Canvas, data: &str, width: f64, color: &str) {
    canvas.path(data, &format!("stroke=\"{color}\" stroke-width=\"{}\"", svg_number(width.max(0.5))));
}

/// Draws the material left around a part, outside of its outline.
fn draw_leftovers(canvas: &mut Canvas, part: &FinishedPart, place: &PageTransform, id: &str) {
    if part.left.is_empty() {
        return;
    }
    let reach = part.left.iter().map(|left| left.reach).fold(0.0, f64::max);
    clip_outside(canvas, part, place, reach, id);
    canvas.open(&format!("clip-path=\"url(#{id})\""));
    for stretch in &part.left {
        let data: String = stretch.outline.iter().map(|shape| symbols::shape(shape, place)).collect();
        stroke(canvas, &data, 2.0 * stretch.reach * place.scale(), LEFTOVER_COLOUR);
    }
    canvas.close();
}

/// Fills the inner corners of a part, outside of its outline. The cuts are drawn over them, so that only the areas that the cutter does not
/// reach remain.
fn draw_corners(canvas: &mut Canvas, part: &FinishedPart, place: &PageTransform, id: &str) {
    let sharp = |ring: &Vec<Shape>| {
        let next = ring.iter().cycle().skip(1);
        let corners = ring.iter().zip(next).filter_map(|(shape, next)| {
            let reach = part.radius * corner_reach(shape.directions()[1], next.directions()[0])?;
            part.corners.iter().any(|stretch| touches(stretch, next.start())).then_some((next.start(), reach))
        });
        corners.collect::<Vec<_>>()
    };
    let sharp: Vec<(Point, f64)> = part.rings.iter().flat_map(sharp).collect();
    let reach = sharp.iter().map(|(_, reach)| *reach).fold(0.0, f64::max);
    clip_outside(canvas, part, place, reach, id);
    canvas.open(&format!("clip-path=\"url(#{id})\" fill=\"{LEFTOVER_COLOUR}\""));
    for (corner, reach) in sharp {
        canvas.circle(place.to_page(corner), reach * place.scale(), "");
    }
    canvas.close();
}

/// Distance in mm up to which a stretch of an outline touches a corner.
const CORNER_DISTANCE: f64 = 0.001;

/// Whether a stretch of an outline begins or ends at a corner.
fn touches(stretch: &Shape, [x, y]: Point) -> bool {
    let ends = [stretch.start(), stretch.end()];
    ends.into_iter().any(|end| libm::hypot(end[0] - x, end[1] - y) <= CORNER_DISTANCE)
}

/// Returns the distance from a corner at which a round cutter on the right of the outline touches both sides, in radii of the cutter. The
/// arguments are the directions before and after the corner. Returns `None` if the outline does not turn to the right.
fn corner_reach([x, y]: Point, [next_x, next_y]: Point) -> Option<f64> {
    let (across, along) = (x * next_y - y * next_x, x * next_x + y * next_y);
    let norm = libm::hypot(x, y) * libm::hypot(next_x, next_y);
    (across < -SMOOTH_SINE * norm)
        .then(|| (-across / (norm + along).max(SMOOTH_SINE * norm)).min(MAX_CORNER_REACH))
}

/// Sine of the largest turn at which an outline is still considered smooth.
const SMOOTH_SINE: f64 = 0.01;

/// Maximum extent of a corner, in radii of the cutter.
const MAX_CORNER_REACH: f64 = 10.0;

/// Draws the defects of a part: cuts into it, support bars that are cut away, and a colour if nothing holds the part.
fn draw_defects(canvas: &mut Canvas, part: &FinishedPart, place: &PageTransform, id: &str) {
    let material = || -> String {
        // Rings within an opening are left out, because an opening is not filled.
        let rings =
            part.rings.iter().enumerate().zip(&part.nests).filter(|((index, _), nest)| index == *nest);
        rings.map(|((_, ring), _)| symbols::outline(ring, place)).collect()
    };
    if part.is_loose {
        canvas.path(&material(), &format!("fill=\"{LOOSE_COLOUR}\" fill-opacity=\"0.45\""));
    }
    let width = 2.0 * part.radius * place.scale();
    let data = |shapes: &[Shape]| shapes.iter().map(|shape| symbols::shape(shape, place)).collect::<String>();
    if !part.gouges.is_empty() {
        canvas.raw(&format!("<clipPath id=\"{id}\"><path d=\"{}\"/></clipPath>", material()));
        canvas.open(&format!("clip-path=\"url(#{id})\""));
        stroke(canvas, &data(&part.gouges), width, WRONG_COLOUR);
        canvas.close();
    }
    if !part.lost_bars.is_empty() {
        canvas.open("stroke-linecap=\"butt\"");
        stroke(canvas, &data(&part.lost_bars), width, WRONG_COLOUR);
        canvas.close();
    }
}

/// Returns the path of a rectangle, given by its lower left and upper right corner.
fn rectangle(place: &PageTransform, corners: [Point; 2]) -> String {
    let [[left, bottom], [right, top]] =
        corners.map(|corner| place.to_page(corner)).map(|corner| corner.map(svg_number));
    format!("M{left} {top}H{right}V{bottom}H{left}Z")
}

/// Defines a clip path for the outside of a part: a frame around the rings of the part. The rings run with their material on the left.
fn clip_outside(canvas: &mut Canvas, part: &FinishedPart, place: &PageTransform, reach: f64, id: &str) {
    let mut corners = None;
    for shape in part.rings.iter().flatten() {
        widen(&mut corners, shape.extent());
    }
    let [low, high] = corners.unwrap_or_default();
    let frame = rectangle(place, [low.map(|at| at - reach), high.map(|at| at + reach)]);
    let rings: String = part.rings.iter().map(|ring| symbols::outline(ring, place)).collect();
    canvas.raw(&format!("<clipPath id=\"{id}\"><path d=\"{frame}{rings}\"/></clipPath>"));
}

fn depth_color(share: f64) -> String {
    let [red, green, blue] = [0, 1, 2].map(|part| {
        let value = DEPTH_COLOURS[0][part] + (DEPTH_COLOURS[1][part] - DEPTH_COLOURS[0][part]) * share;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 255")]
        let value = value.round() as u8;
        value
    });
    format!("#{red:02x}{green:02x}{blue:02x}")
}

#[cfg(test)]
mod tests {
    use super::{MAX_CORNER_REACH, corner_reach};

    /// A round cutter touches the sides of a right angle at one radius from the corner, whatever the directions of the sides.
    #[test]
    fn the_reach_of_a_corner_does_not_depend_on_directions() {
        for turned in 0..12 {
            let along = |degrees: f64| {
                let (sin, cos) = libm::sincos((f64::from(turned) * 30.0 + degrees).to_radians());
                [cos, sin]
            };
            let reach = |degrees: f64| corner_reach(along(0.0), along(-degrees));
            assert!(reach(90.0).is_some_and(|reach| (reach - 1.0).abs() < 1e-9), "{turned}");
            assert!(
                reach(60.0).is_some_and(|reach| (reach - libm::sqrt(1.0 / 3.0)).abs() < 1e-9),
                "{turned}"
            );
            assert_eq!(reach(170.0), Some(MAX_CORNER_REACH));
            assert_eq!([reach(0.5), reach(-90.0)], [None; 2], "smooth, or to the other side");
        }
    }
}
