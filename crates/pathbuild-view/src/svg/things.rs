//! Draws the elements, below and above the moves.

use super::VisibleParts;
use super::canvas::{Anchor, Canvas, n};
use super::frame::{Frame, PageTransform};
use super::marks;
use super::palette::{BAR, ERROR, INK, OTHER, PROBE, RAPID, TEXT};
use super::room::{Rectangle, Room, width};
use crate::scene::{Arc, Element, ElementKind, OtherShape, Point, Scene, ScenePath, Shape};

/// Minimum size in px of the path's own texts.
const LEAST: f64 = 7.5;

/// Size in px below which texts are illegible and omitted.
const READABLE: f64 = 4.5;

/// A white outline that keeps texts legible over lines.
const HALO: &str = "stroke=\"#fff\" stroke-width=\"2.5\" stroke-opacity=\"0.8\" paint-order=\"stroke\"";

/// Draws other layers and clamps.
pub(super) fn under(canvas: &mut Canvas, scene: &Scene, frame: &Frame, room: &mut Room) {
    let place = frame.of_drawing();
    canvas.open(&format!("id=\"other-layers\" fill=\"none\" stroke=\"{OTHER}\" stroke-width=\"0.7\""));
    for other in &scene.other_layers {
        match other {
            OtherShape::Shape { shape: piece, .. } => canvas.path(&shape(piece, &place), ""),
            OtherShape::Text { text, at, height, rotation, .. } => {
                other_text(canvas, &place, text, *at, *height, *rotation);
                if *rotation == 0.0 {
                    room.take(written(place.at(*at), height * place.scale(), text));
                }
            }
        }
    }
    canvas.close();
    keep_outs(canvas, scene, &place, room);
}

/// The approximate rectangle of a text centred on a point.
fn written([x, y]: Point, size: f64, text: &str) -> Rectangle {
    let half = width(text, size) / 2.0;
    [[x - half, y - size / 2.0], [x + half, y + size / 2.0]]
}

/// Draws clamps, with their heights in the middle.
fn keep_outs(canvas: &mut Canvas, scene: &Scene, place: &PageTransform, room: &mut Room) {
    canvas.open(&format!("id=\"keep-outs\" fill=\"none\" stroke=\"{ERROR}\" stroke-width=\"1.2\""));
    let style = format!("stroke-dasharray=\"8 2 2 2\" fill=\"{ERROR}\" fill-opacity=\"0.14\"");
    for clamp in &scene.keep_outs {
        canvas.path(&outline(&clamp.outline, place), &style);
    }
    let style = format!("stroke=\"none\" fill=\"{ERROR}\"");
    for clamp in &scene.keep_outs {
        let corners = clamp.outline.iter().flat_map(Shape::extent);
        let hull = |[low, high]: [Point; 2], at: Point| {
            [[low[0].min(at[0]), low[1].min(at[1])], [high[0].max(at[0]), high[1].max(at[1])]]
        };
        let Some([low, high]) = corners.map(|at| [at, at]).reduce(|all, [at, _]| hull(all, at)) else {
            continue;
        };
        let [x, y] = place.at([0, 1].map(|axis| f64::midpoint(low[axis], high[axis])));
        let label = format!("Z{}", n(clamp.height));
        room.take(written([x, y], 11.0, &label));
        canvas.text([x, y + 4.0], 11.0, Anchor::Middle, &style, &label);
    }
    canvas.close();
}

/// Adjacent shapes of an outline as one piece of path data.
fn outline(shapes: &[Shape], place: &PageTransform) -> String {
    let mut data = String::new();
    for piece in shapes {
        let next = shape(piece, place);
        let begin = if data.is_empty() { 0 } else { next.find(['L', 'A']).unwrap_or(0) };
        data.push_str(&next[begin..]);
    }
    data + "Z"
}

fn other_text(canvas: &mut Canvas, place: &PageTransform, text: &str, at: Point, height: f64, rotation: f64) {
    let size = height * place.scale();
    if size < READABLE {
        return;
    }
    let [x, y] = place.at(at);
    let turn = if rotation == 0.0 {
        String::new()
    } else {
        format!(" transform=\"rotate({} {} {})\"", n(-rotation), n(x), n(y))
    };
    let style = format!("stroke=\"none\" fill=\"{OTHER}\" dominant-baseline=\"central\"{turn}");
    canvas.text([x, y], size, Anchor::Middle, &style, text);
}

/// Draws elements, texts, support bars, probes and markers.
pub(super) fn over(
    canvas: &mut Canvas,
    path: &ScenePath,
    place: &PageTransform,
    shown: VisibleParts,
    room: &mut Room,
) {
    elements(canvas, path, place);
    canvas.open(&format!(
        "id=\"bars\" fill=\"none\" stroke=\"{BAR}\" stroke-width=\"4\" stroke-opacity=\"0.75\""
    ));
    for bar in &path.bars {
        canvas.path(&shape(&bar.shape, place), "");
    }
    canvas.close();
    if shown.texts {
        texts(canvas, path, place, room);
    }
    marks::ends(canvas, path, place, shown, room);
    probes(canvas, path, place, room);
    if shown.order {
        marks::order(canvas, path, place, room);
    }
    embedded(canvas, path, place, room);
}

/// Draws elements that are not moves: with a program, subpaths and skipped elements; without one, everything.
fn elements(canvas: &mut Canvas, path: &ScenePath, place: &PageTransform) {
    canvas.open("id=\"elements\" fill=\"none\" stroke-width=\"1.4\"");
    for element in &path.elements {
        let style = match element.kind {
            ElementKind::Subpath => "stroke=\"#7b8a97\" stroke-width=\"1\" stroke-dasharray=\"9 3 2 3\"",
            ElementKind::SkippedSubpath => "stroke=\"#b8bfc6\" stroke-width=\"1\" stroke-dasharray=\"1 4\"",
            ElementKind::Turn => "stroke=\"#14202b\" stroke-width=\"0.8\"",
            ElementKind::Probe if path.probes.is_empty() => "stroke=\"#009e73\"",
            ElementKind::Mill | ElementKind::Mark | ElementKind::Support | ElementKind::Sweep
                if path.moves.is_empty() =>
            {
                style_without_program(element)
            }
            _ => continue,
        };
        canvas.path(&shape(&element.shape, place), style);
    }
    canvas.close();
}

fn style_without_program(element: &Element) -> &'static str {
    match element.kind {
        ElementKind::Mark => "stroke=\"#1868ac\" stroke-dasharray=\"2 3\"",
        ElementKind::Support => "stroke=\"#1868ac\" stroke-dasharray=\"12 3 3 3\"",
        ElementKind::Sweep => "stroke=\"#e69f00\" stroke-dasharray=\"6 4\"",
        _ => "stroke=\"#1868ac\"",
    }
}

fn texts(canvas: &mut Canvas, path: &ScenePath, place: &PageTransform, room: &mut Room) {
    canvas.open(&format!("id=\"texts\" fill=\"{TEXT}\""));
    for label in &path.texts {
        let lines: Vec<&str> = label.text.lines().collect();
        let longest = lines.iter().map(|line| line.chars().count()).max().unwrap_or(0).max(1);
        // The radius of a text's circle is half the diagonal of the text.
        let (rows, letters) = (lines.len().max(1) as f64, 0.6 * longest as f64);
        let height = 2.0 * label.radius / libm::hypot(rows, letters);
        let size = (height * place.scale()).min(14.0);
        // The path's own texts are always legible; those of embedded paths are shown only if they are large enough.
        let size = if label.path == 0 { size.max(LEAST) } else { size };
        if size < READABLE {
            continue;
        }
        let extent = [0.62 * size * longest as f64, rows * size];
        let Some(at) = room.find_near(place.at(label.at), extent) else { continue };
        for element in &label.elements {
            let to = place.at(nearest(&path.elements[*element as usize].shape, label.at));
            canvas.line(at, to, &format!("stroke=\"{TEXT}\" stroke-width=\"0.5\" stroke-opacity=\"0.6\""));
        }
        for (row, line) in lines.iter().enumerate() {
            let down = (row as f64 - (rows - 1.0) / 2.0 + 0.35) * size;
            canvas.text([at[0], at[1] + down], size, Anchor::Middle, HALO, line);
        }
    }
    canvas.close();
}

/// The point of a shape that is nearest to another point.
fn nearest(shape: &Shape, at: Point) -> Point {
    let onto_circle = |centre: Point, radius: f64| {
        let out = [at[0] - centre[0], at[1] - centre[1]];
        let distance = libm::hypot(out[0], out[1]);
        if distance == 0.0 { centre } else { [0, 1].map(|axis| centre[axis] + out[axis] / distance * radius) }
    };
    match shape {
        Shape::Line { from, to } => {
            let way = [to[0] - from[0], to[1] - from[1]];
            let square = way[0] * way[0] + way[1] * way[1];
            let foot = (at[0] - from[0]) * way[0] + (at[1] - from[1]) * way[1];
            let share = if square == 0.0 { 0.0 } else { (foot / square).clamp(0.0, 1.0) };
            [0, 1].map(|axis| from[axis] + way[axis] * share)
        }
        Shape::Circle { centre, radius } => onto_circle(*centre, *radius),
        Shape::Arc(arc) => onto_circle(arc.centre, arc.radius),
    }
}

/// Draws the names of embedded paths at their starts, as far as there is room.
fn embedded(canvas: &mut Canvas, path: &ScenePath, place: &PageTransform, room: &mut Room) {
    canvas.open(&format!("id=\"embedded\" fill=\"{INK}\" font-style=\"italic\""));
    for inner in path.embedded.iter().skip(1) {
        if let Some(at) = room.find_beside(place.at(inner.ends[0]), [6.0, -6.0], 9.0, &inner.name) {
            canvas.text(at, 9.0, Anchor::Start, HALO, &inner.name);
        }
    }
    canvas.close();
}

fn probes(canvas: &mut Canvas, path: &ScenePath, place: &PageTransform, room: &mut Room) {
    canvas.open(&format!("id=\"probes\" stroke=\"{PROBE}\" fill=\"none\""));
    for probe in &path.probes {
        let at = place.at(probe.at);
        let size = marks::probe_radius(place);
        canvas.circle(at, size, "stroke-width=\"1.4\"");
        canvas.line([at[0] - size, at[1]], [at[0] + size, at[1]], "stroke-width=\"0.8\"");
        canvas.line([at[0], at[1] - size], [at[0], at[1] + size], "stroke-width=\"0.8\"");
        let label = probe.label.as_deref().map(|label| format!(" {label}")).unwrap_or_default();
        let (style, label) =
            (format!("stroke=\"none\" fill=\"{PROBE}\""), format!("#{}{label}", probe.number));
        let at = room.beside(at, [size + 2.0, -3.0], 9.0, &label);
        canvas.text(at, 9.0, Anchor::Start, &style, &label);
    }
    canvas.close();
}

/// A shape as SVG path data.
pub(super) fn shape(shape: &Shape, place: &PageTransform) -> String {
    let point = |at: Point| {
        let [x, y] = place.at(at);
        format!("{} {}", n(x), n(y))
    };
    let halves = |arc: &Arc| {
        let radius = n(arc.radius * place.scale());
        let sweep = i32::from(arc.clockwise);
        let half = |share| format!("A{radius} {radius} 0 0 {sweep} {}", point(arc.point(share)));
        format!("M{}{}{}", point(arc.from), half(0.5), half(1.0))
    };
    match shape {
        Shape::Line { from, to } => format!("M{}L{}", point(*from), point(*to)),
        Shape::Arc(arc) => halves(arc),
        Shape::Circle { centre, radius } => {
            let right = [centre[0] + radius, centre[1]];
            halves(&Arc {
                from: right,
                to: right,
                centre: *centre,
                radius: *radius,
                clockwise: false,
                degrees: 360.0,
            })
        }
    }
}

/// The colour of sweeps, for the legend.
pub(super) const SWEEP: &str = RAPID;
