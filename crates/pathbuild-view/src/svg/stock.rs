//! The stock as it is when all moves are done, seen from above. (book: program/pictures)
//!
//! The area that a cutter sweeps is drawn as a stroke as wide as the cutter. Strokes are painted from high to low, so that each place
//! shows its lowest cut. All sizes are exact at any scale.

mod hits;
mod parts;
mod strokes;

use std::collections::BTreeMap;

use pathbuild_diagnostic::{Code, Lang};

use super::canvas::{Anchor, Canvas, INK_COLOUR, gradient, mm, svg_number};
use super::frame::{Frame, LINE_HEIGHT, PageTransform, VisibleParts};
use super::moves::path_data;
use super::symbols;
use crate::extent::{Corners, bounding_box, enclosing_box};
use crate::scene::{FinishedPart, Point, Scene, ScenePath, Tip};
use hits::hits;
use parts::{draw_corners, draw_defects, draw_leftovers};
use strokes::{
    MovePiece, SLOPE_STEPS, StockMove, Stroke, StrokeBuilder, StrokeKind, SweptArea, cuts,
    cutting_conditions, is_known, low_rapids, number, raise_edges, sort, swept_area,
};

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

/// Width in px of a colour swatch in the legend, including the gap before its label.
const SWATCH_WIDTH: f64 = 17.0;

/// Approximate maximum number of strokes into which the level cuts of round cutters are divided in one picture. If a program needs more, the steps of
/// its round cuts are coarser.
const MAX_ROUND_STROKES: f64 = 200_000.0;

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
type Blank = (Corners, f64);

impl<'s> MilledStock<'s> {
    pub(super) fn of(scene: &'s Scene) -> Self {
        let mut blanks: Vec<Blank> = Vec::new();
        let (mut low, mut count) = (f64::INFINITY, 0);
        for cut in cuts(scene) {
            let Some(extent) = cut.extent() else { continue };
            match blanks.iter_mut().find(|(_, top)| *top == cut.setting.top) {
                Some((blank, _)) => *blank = enclosing_box(*blank, extent),
                None => blanks.push((extent, cut.setting.top)),
            }
            low = cut.movement.depth().map_or(low, |z| low.min(z));
            count += 1;
        }
        blanks.sort_by(|one, other| one.1.total_cmp(&other.1));
        // Extend the stock to the rapid moves that go below every upper face: if the real stock reaches that far, these moves run through material.
        if let Some((blank, top)) = blanks.first_mut() {
            for extent in low_rapids(scene, *top).filter_map(|rapid| rapid.extent()) {
                *blank = enclosing_box(*blank, extent);
            }
        }
        let low = if count > 0 { low } else { 0.0 };
        let top = blanks.last().map_or(low, |(_, top)| *top);
        let step = ((top - low) / SLOPE_STEPS).max(1e-3);
        let hits =
            (0..).zip(&scene.paths).flat_map(|(index, path)| hits(scene, path, index, &blanks)).collect();
        let band = step.max((top - low) * count as f64 / MAX_ROUND_STROKES);
        let mut painter = StrokeBuilder { strokes: Vec::with_capacity(2 * count), step, band };
        for StockMove { at, movement, setting, .. } in cuts(scene) {
            painter.add_cut(at, &movement.way, &setting);
        }
        let mut strokes = painter.strokes;
        raise_edges(&mut strokes, top - low);
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
            for key in stroke.area(&other.paths).keys() {
                let height = heights.entry(key).or_insert(f64::INFINITY);
                *height = height.min(stroke.height());
            }
        }
        let paths = self.paths.as_slice();
        let is_deeper =
            |stroke: &Stroke| heights.get(&stroke.area(paths).key()).is_none_or(|z| stroke.height() < *z);
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
    pub(super) fn keep_near(mut self, [low, high]: Corners) -> Self {
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
    pub(super) fn extent(&self) -> Option<Corners> {
        let blanks = self.blanks.iter().map(|(blank, _)| *blank);
        bounding_box(blanks.chain(self.scene.finding_places()))
    }

    /// Draws the stock with its defects, and the outlines of the parts. `id` makes the ids of clip paths unique.
    pub(super) fn draw(&self, canvas: &mut Canvas, frame: &Frame, id: &str) {
        let place = frame.of_drawing();
        self.draw_blanks(canvas, &place, id);
        canvas.open(&format!(
            "clip-path=\"url(#{id})\" fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\""
        ));
        let middle = self.strokes.partition_point(|stroke| stroke.kind < StrokeKind::ThroughEdge);
        self.draw_strokes(canvas, &place, &self.strokes[..middle]);
        self.each_part(|part, path, number| {
            draw_leftovers(canvas, part, &frame.of_path(path), &format!("{id}-outside-{number}"));
        });
        if self.has_corners {
            self.each_part(|part, path, number| {
                draw_corners(canvas, part, &frame.of_path(path), &format!("{id}-corners-{number}"));
            });
        }
        self.draw_strokes(canvas, &place, &self.strokes[middle..]);
        self.each_part(|part, path, number| {
            draw_defects(canvas, part, &frame.of_path(path), &format!("{id}-inside-{number}"));
        });
        let hits: Vec<SweptArea> = self.hits.iter().map(|hit| swept_area(&self.paths, *hit)).collect();
        for run in hits.chunk_by(|hit, next| hit.diameter == next.diameter) {
            let data: String = run.iter().map(|hit| path_data(&hit.way, &place)).collect();
            stroke(canvas, &data, run[0].diameter * place.scale(), WRONG_COLOUR);
        }
        canvas.close();
        draw_uncut_parts(canvas, self.scene, &place);
        canvas.open(&format!("fill=\"none\" stroke=\"{OUTLINE_COLOUR}\" stroke-width=\"1.2\""));
        self.each_part(|part, path, _| {
            for ring in &part.rings {
                canvas.path(&symbols::outline_path_data(ring, &frame.of_path(path)), "");
            }
        });
        canvas.close();
    }

    fn draw_blanks(&self, canvas: &mut Canvas, place: &PageTransform, id: &str) {
        let all: String = self.blanks.iter().map(|(corners, _)| rectangle(place, *corners)).collect();
        canvas.raw(&format!("<clipPath id=\"{id}\"><path d=\"{all}\"/></clipPath>"));
        canvas.path(&all, &format!("fill=\"{UNTOUCHED_COLOUR}\""));
    }

    /// Draws strokes, combining consecutive ones that look alike to a single path, up to [`MAX_COMBINED_STROKES`].
    fn draw_strokes(&self, canvas: &mut Canvas, place: &PageTransform, strokes: &[Stroke]) {
        let look = |stroke: &Stroke| (stroke.kind, stroke.z, stroke.is_marked, stroke.diameter);
        let alike = strokes.chunk_by(|stroke, next| look(stroke) == look(next));
        for combined in alike.flat_map(|alike| alike.chunks(MAX_COMBINED_STROKES)) {
            let areas = combined.iter().map(|stroke| stroke.area(&self.paths));
            let data: String = areas.map(|area| path_data(&area.way, place)).collect();
            let (kind, z, is_marked, diameter) = look(&combined[0]);
            let width = diameter * place.scale();
            match kind {
                StrokeKind::Edge | StrokeKind::ThroughEdge => {
                    stroke(canvas, &data, width + 2.0 * EDGE_WIDTH, EDGE_COLOUR);
                }
                StrokeKind::Cut | StrokeKind::Through => {
                    let through = (kind == StrokeKind::Through).then_some(THROUGH_COLOUR);
                    let mark = is_marked.then_some(self.mark);
                    let color = mark.or(through).map_or_else(|| self.color(z), str::to_owned);
                    stroke(canvas, &data, width, &color);
                }
            }
        }
    }

    /// Whether the shape of any cutter, and so the cross-section of its cuts, is unknown.
    fn has_unknown_tip(&self) -> bool {
        cuts(self.scene).any(|cut| cut.setting.tip == Tip::Unknown)
    }

    fn color(&self, z: f64) -> String {
        let [top, low] = self.range;
        gradient(&DEPTH_COLOURS, ((top - z) / (top - low).max(1e-6)).clamp(0.0, 1.0))
    }

    fn each_part(&self, mut each: impl FnMut(&FinishedPart, &ScenePath, usize)) {
        let parts = self.scene.paths.iter().flat_map(|path| path.parts.iter().map(move |part| (part, path)));
        for (number, (part, path)) in parts.enumerate() {
            each(part, path, number);
        }
    }

    /// Draws the meaning of the colours, from `at` to `right` and continuing on further lines.
    pub(super) fn draw_legend(&self, canvas: &mut Canvas, shown: VisibleParts, at: Point, right: f64) {
        for LegendEntry { at: [x, y], color, name } in self.legend_entries(shown, at, right) {
            let mut left = x;
            if !color.is_empty() {
                let style = format!("fill=\"{color}\" stroke=\"{EDGE_COLOUR}\" stroke-width=\"0.5\"");
                canvas.path(&format!("M{} {}h12v10h-12Z", svg_number(x), svg_number(y - 9.0)), &style);
                left += SWATCH_WIDTH;
            }
            canvas.text([left, y], 10.5, Anchor::Start, &format!("fill=\"{INK_COLOUR}\""), &name);
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
            (has(StrokeKind::Cut), gradient(&DEPTH_COLOURS, 0.0), depths.as_str()),
            (
                has(StrokeKind::Cut),
                gradient(&DEPTH_COLOURS, 1.0),
                shown.choose("the darker, the lower Z", "je dunkler, desto kleiner Z"),
            ),
            (
                self.has_unknown_tip(),
                String::new(),
                shown.choose(
                    "cutter of unknown shape, drawn with a flat bottom",
                    "Fräser unbekannter Form, mit flachem Grund gezeichnet",
                ),
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

/// A colour of the legend, with its meaning, or a remark.
struct LegendEntry {
    /// Start of the baseline, in px.
    at: Point,
    /// Empty for a remark.
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
    // Programs are compared in their own coordinates, regardless of the position of the path in the drawing, and by the areas that their cutters
    // sweep, regardless of the shapes of the tips.
    let [old, new] = [old, new].map(|path| {
        let mut path = ScenePath { zero: [0.0; 2], parts: Vec::new(), tip: Tip::Flat, ..path.clone() };
        path.tools.iter_mut().for_each(|tool| tool.tip = Tip::Flat);
        Scene { paths: vec![path], ..Scene::new("") }
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
    // Both pictures lie side by side on the page, at half their size.
    let y = frame.bottom() - 10.0;
    canvas.path(&format!("M40 {}h20v18h-20Z", svg_number(y - 18.0)), &format!("fill=\"{color}\""));
    canvas.text([70.0, y], 26.0, Anchor::Start, &format!("fill=\"{INK_COLOUR}\""), lang.choose(en, de));
    Some(canvas.finish())
}

/// Whether the stock of a scene can be drawn: for at least one cut, the cutter and the upper face of the material are known.
pub fn has_stock(scene: &Scene) -> bool {
    scene.paths.iter().any(|path| {
        let mut cuts = path.moves.iter().filter(|movement| movement.kind.cuts() && is_known(&movement.way));
        cuts.any(|movement| cutting_conditions(scene, path, movement).is_some())
    })
}

pub(super) fn draw_uncut_parts(canvas: &mut Canvas, scene: &Scene, place: &PageTransform) {
    let style = format!("fill=\"{LEFTOVER_COLOUR}\" fill-opacity=\"0.35\"");
    for ring in &scene.uncut {
        canvas.path(&symbols::outline_path_data(ring, place), &style);
    }
}

fn stroke(canvas: &mut Canvas, data: &str, width: f64, color: &str) {
    canvas.path(data, &format!("stroke=\"{color}\" stroke-width=\"{}\"", svg_number(width.max(0.5))));
}

/// Returns the path of a rectangle, given by its lower left and upper right corner.
fn rectangle(place: &PageTransform, corners: Corners) -> String {
    let [[left, bottom], [right, top]] =
        corners.map(|corner| place.to_page(corner)).map(|corner| corner.map(svg_number));
    format!("M{left} {top}H{right}V{bottom}H{left}Z")
}
