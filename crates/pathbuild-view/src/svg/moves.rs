//! Draws moves of the tool.

use std::collections::BTreeMap;
use std::fmt::Write;

use pathbuild_motion::{Move, MoveShape};

use super::canvas::{Canvas, Depths, KERF_COLOUR, RAPID_COLOUR, svg_number};
use super::frame::{PageTransform, VisibleParts};
use crate::scene::{MoveKind, Point, SceneMove, ScenePath};

/// Minimum length in px of a move that gets an arrow.
const MIN_ARROW_LENGTH: f64 = 26.0;

/// Number of lines that replace an arc whose plane is not XY.
const PIECES_PER_ARC: u32 = 24;

/// All moves along one line, regardless of direction. The line has the direction of the first move, the depth of the deepest one, and the width of
/// the widest cutter.
pub(super) struct CutLine<'a> {
    way: &'a SceneMove,
    depth: Option<f64>,
    /// Diameter of the cutter in mm, if known.
    diameter: Option<f64>,
}

/// Draws the width of the cutter along cuts, and holes. Texts lie above it, because they are usually drawn on or beside their element.
pub(super) fn draw_kerf(
    canvas: &mut Canvas,
    path: &ScenePath,
    cuts: &[CutLine<'_>],
    place: &PageTransform,
    depths: &Depths,
) {
    canvas.open("id=\"kerf\" fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\"");
    for cut in cuts.iter().filter(|cut| cut.way.kind != MoveKind::Plunge) {
        let Some(diameter) = cut.diameter else { continue };
        let width = svg_number((diameter * place.scale()).max(0.5));
        canvas.merged_path(
            &path_data(&cut.way.way, place),
            &format!("stroke=\"{KERF_COLOUR}\" stroke-width=\"{width}\""),
        );
    }
    for cut in cuts {
        if let Some(radius) = hole_radius(cut, path, place) {
            draw_disc(canvas, cut, radius, place, depths);
        }
    }
    canvas.close();
}

/// Draws the moves of a path. Moves along the same line are drawn as one [`CutLine`].
pub(super) fn draw(
    canvas: &mut Canvas,
    path: &ScenePath,
    cuts: &[CutLine<'_>],
    place: &PageTransform,
    depths: &Depths,
    shown: VisibleParts,
) {
    if shown.rapids {
        draw_rapids(canvas, path, place, shown);
    }
    canvas.open("id=\"cuts\" fill=\"none\" stroke-width=\"1.8\" stroke-linecap=\"round\"");
    for movement in cuts {
        draw_cut(canvas, movement, path, place, depths);
    }
    canvas.close();
    if shown.arrows {
        canvas.open("id=\"arrows\"");
        let bottoms = path.depths(|kind| matches!(kind, MoveKind::Mill | MoveKind::Mark));
        let is_bottom = |movement: &&CutLine<'_>| {
            movement.way.element.is_none_or(|element| movement.depth <= bottoms[element as usize])
        };
        for movement in cuts.iter().filter(is_bottom) {
            draw_arrow(canvas, movement.way, place, &depths.color(movement.depth));
        }
        canvas.close();
    }
}

fn draw_cut(
    canvas: &mut Canvas,
    cut: &CutLine<'_>,
    path: &ScenePath,
    place: &PageTransform,
    depths: &Depths,
) {
    let movement = cut.way;
    if movement.kind == MoveKind::Plunge {
        if hole_radius(cut, path, place).is_none() {
            draw_disc(canvas, cut, 1.8, place, depths);
        }
        return;
    }
    let color = depths.color(cut.depth);
    let dashes = if movement.kind == MoveKind::Mark { " stroke-dasharray=\"2 3\"" } else { "" };
    canvas.merged_path(&path_data(&movement.way, place), &format!("stroke=\"{color}\"{dashes}"));
}

fn draw_disc(canvas: &mut Canvas, cut: &CutLine<'_>, radius: f64, place: &PageTransform, depths: &Depths) {
    let style = format!("fill=\"{}\" fill-opacity=\"0.8\"", depths.color(cut.depth));
    canvas.circle(place.to_page(cut.way.to()), radius, &style);
}

/// Returns the radius of a plunge that is drawn as a hole: its cutter is known, and its element is a circle, or it has no element.
fn hole_radius(cut: &CutLine<'_>, path: &ScenePath, place: &PageTransform) -> Option<f64> {
    let is_circle =
        |element: u32| matches!(path.elements[element as usize].shape, crate::scene::Shape::Circle { .. });
    let is_hole = cut.way.kind == MoveKind::Plunge && cut.way.element.is_none_or(is_circle);
    cut.diameter.filter(|_| is_hole).map(|diameter| (diameter / 2.0 * place.scale()).max(2.0))
}

/// Returns the cuts of a path, from shallow to deep.
pub(super) fn cuts(path: &ScenePath) -> Vec<CutLine<'_>> {
    let mut places: BTreeMap<LineKey, usize> = BTreeMap::new();
    let mut cuts: Vec<CutLine<'_>> = Vec::new();
    for way in path.moves.iter().filter(|movement| movement.kind.cuts() && movement.is_placed()) {
        let index = *places.entry(line_key(&way.way)).or_insert(cuts.len());
        let diameter = path.cutter(way).map(|(diameter, _)| diameter);
        match cuts.get_mut(index) {
            Some(cut) => {
                cut.depth = deeper(cut.depth, way.depth());
                cut.diameter = cut.diameter.into_iter().chain(diameter).reduce(f64::max);
            }
            None => cuts.push(CutLine { way, depth: way.depth(), diameter }),
        }
    }
    cuts.sort_by(|a, b| b.depth.unwrap_or_default().total_cmp(&a.depth.unwrap_or_default()));
    cuts
}

/// Returns the lower of two heights, either of which may be unknown.
fn deeper(a: Option<f64>, b: Option<f64>) -> Option<f64> {
    a.into_iter().chain(b).reduce(f64::min)
}

/// A line seen from above, regardless of direction: its ends in micrometres and, for arcs, the centre and the side on which the arc runs.
pub(super) type LineKey = ([[i64; 2]; 2], Option<([i64; 2], bool)>);

/// Returns the line along which a move runs.
pub(super) fn line_key(way: &Move) -> LineKey {
    let [from, to] = [way.from, way.to].map(|end| [end.x(), end.y()].map(micrometres));
    let is_backwards = from > to;
    let arc = match way.shape {
        MoveShape::Line => None,
        // Both directions of a full circle are the same line.
        MoveShape::Arc(arc) => {
            Some((arc.centre.map(micrometres), from != to && arc.clockwise != is_backwards))
        }
    };
    (if is_backwards { [to, from] } else { [from, to] }, arc)
}

#[expect(clippy::cast_possible_truncation, reason = "saturates")]
pub(super) fn micrometres(value: f64) -> i64 {
    (value * 1000.0).round() as i64
}

fn draw_rapids(canvas: &mut Canvas, path: &ScenePath, place: &PageTransform, shown: VisibleParts) {
    canvas.open("id=\"rapids\" fill=\"none\" stroke-width=\"0.9\" stroke-dasharray=\"6 4\"");
    let colour = format!("stroke=\"{RAPID_COLOUR}\"");
    let sweeps =
        || path.moves.iter().filter(|movement| movement.kind == MoveKind::Sweep && movement.is_placed());
    for movement in sweeps() {
        canvas.merged_path(&path_data(&movement.way, place), &colour);
    }
    canvas.close();
    if shown.arrows {
        canvas.open("id=\"rapid-arrows\"");
        for movement in sweeps() {
            draw_arrow(canvas, movement, place, RAPID_COLOUR);
        }
        canvas.close();
    }
}

/// Draws a small triangle at three fifths of a move, pointing in its direction. A short move gets none.
fn draw_arrow(canvas: &mut Canvas, movement: &SceneMove, place: &PageTransform, color: &str) {
    let (before, at) =
        (place.to_page(point_at_fraction(movement, 0.59)), place.to_page(point_at_fraction(movement, 0.61)));
    let [dx, dy] = [at[0] - before[0], at[1] - before[1]];
    let length = libm::hypot(dx, dy);
    if length * 50.0 < MIN_ARROW_LENGTH {
        return;
    }
    let [dx, dy] = [dx / length, dy / length];
    let tip = [at[0] + dx * 4.0, at[1] + dy * 4.0];
    let foot = [at[0] - dx * 4.0, at[1] - dy * 4.0];
    let (left, right) = ([foot[0] - dy * 3.4, foot[1] + dx * 3.4], [foot[0] + dy * 3.4, foot[1] - dx * 3.4]);
    let [tip, left, right] = [tip, left, right].map(|[x, y]| format!("{} {}", svg_number(x), svg_number(y)));
    canvas.merged_path(&format!("M{tip}L{left}L{right}Z"), &format!("fill=\"{color}\""));
}

/// Returns the point at a fraction (0 to 1) of a move's length.
pub(super) fn point_at_fraction(movement: &SceneMove, share: f64) -> Point {
    let [x, y, _] = movement.way.point(share);
    [x, y]
}

/// Returns the number of pieces in which an arc is drawn, at least two. SVG computes the centre from the ends; if these were opposite each
/// other, their rounding would move the centre by up to 1 px. A single piece also cannot be a full circle.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
pub(super) fn arc_pieces(degrees: f64) -> u32 {
    ((degrees.abs() / 120.0 - 1e-6).ceil() as u32).max(2)
}

/// Returns a move as SVG path data. Arcs in the XY plane stay arcs.
pub(super) fn path_data(way: &Move, place: &PageTransform) -> String {
    let point = |at: Point| {
        let [x, y] = place.to_page(at);
        format!("{} {}", svg_number(x), svg_number(y))
    };
    let in_plane = |[x, y, _]: [f64; 3]| point([x, y]);
    let mut data = format!("M{}", in_plane(way.from.at));
    match way.shape {
        MoveShape::Line => _ = write!(data, "L{}", in_plane(way.to.at)),
        MoveShape::Arc(arc) if arc.plane.axes() == [0, 1] => {
            let pieces = arc_pieces(arc.sweep(&way.from, &way.to).to_degrees());
            let radius = svg_number(arc.radius(&way.from) * place.scale());
            let sweep = i32::from(arc.clockwise);
            for piece in 1..=pieces {
                let to = in_plane(way.point(f64::from(piece) / f64::from(pieces)));
                _ = write!(data, "A{radius} {radius} 0 0 {sweep} {to}");
            }
        }
        MoveShape::Arc(_) => {
            for piece in 1..=PIECES_PER_ARC {
                _ = write!(data, "L{}", in_plane(way.point(f64::from(piece) / f64::from(PIECES_PER_ARC))));
            }
        }
    }
    data
}
