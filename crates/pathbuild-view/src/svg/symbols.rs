//! Draws the elements of a scene, below and above its moves, and the markers.

use super::canvas::{
    Anchor, BAR_COLOUR, Canvas, ERROR_COLOUR, INK_COLOUR, OTHER_COLOUR, PROBE_COLOUR, RAPID_COLOUR,
    TEXT_COLOUR, WARNING_COLOUR, svg_number,
};
use super::frame::{Frame, OccupiedSpace, PageTransform, Rectangle, VisibleParts, text_width};
use super::moves::{arc_pieces, point_at_fraction};
use crate::extent::with_margin;
use crate::scene::{
    ArcShape, Element, ElementKind, Label, MoveKind, OtherShape, Point, Scene, SceneMove, ScenePath, Shape,
};
use pathbuild_motion::MoveShape;

/// Minimum size in px of texts that belong to the path itself.
const MIN_TEXT_SIZE: f64 = 7.5;

/// Size in px below which texts are illegible and omitted.
const MIN_LEGIBLE_SIZE: f64 = 4.5;

/// SVG attributes of a white outline that keeps texts legible over lines.
const HALO: &str = "stroke=\"#fff\" stroke-width=\"2.5\" stroke-opacity=\"0.8\" paint-order=\"stroke\"";

/// Draws the shapes below the moves: other layers and clamps.
pub(super) fn draw_below_moves(canvas: &mut Canvas, scene: &Scene, frame: &Frame, room: &mut OccupiedSpace) {
    let (place, [_, [_, bottom]]) = (frame.of_drawing(), frame.area());
    canvas.open(&format!("id=\"other-layers\" fill=\"none\" stroke=\"{OTHER_COLOUR}\" stroke-width=\"0.7\""));
    for other in &scene.other_layers {
        match other {
            OtherShape::Shape { shape: piece, .. } => canvas.path(&shape_path_data(piece, &place), ""),
            OtherShape::Text { text, at, height, rotation, .. } => {
                let (size, mut at) = (height * place.scale(), place.to_page(*at));
                if *rotation == 0.0 {
                    // The legend would cover the lower half of a text across the lower edge.
                    if at[1] < bottom {
                        at[1] = at[1].min(bottom - size * rows(text) / 2.0);
                    }
                    room.occupy(text_rectangle(at, size, text));
                }
                draw_other_text(canvas, at, size, *rotation, text);
            }
        }
    }
    canvas.close();
    draw_keep_outs(canvas, scene, &place, room);
}

/// Returns the approximate rectangle of a text that is centred on a point.
fn text_rectangle([x, y]: Point, size: f64, text: &str) -> Rectangle {
    let width = text.lines().map(|line| text_width(line, size)).fold(0.0, f64::max);
    let half = [width / 2.0, size * rows(text) / 2.0];
    [[x - half[0], y - half[1]], [x + half[0], y + half[1]]]
}

/// Returns the number of lines of a text, at least one.
fn rows(text: &str) -> f64 {
    text.lines().count().max(1) as f64
}

/// Returns each line of a text with the distance of its middle below the middle of the text, in lines.
fn rows_from_middle(text: &str) -> impl Iterator<Item = (f64, &str)> {
    let middle = (rows(text) - 1.0) / 2.0;
    text.lines().enumerate().map(move |(row, line)| (row as f64 - middle, line))
}

/// Draws clamps, each with its height in the middle.
fn draw_keep_outs(canvas: &mut Canvas, scene: &Scene, place: &PageTransform, room: &mut OccupiedSpace) {
    canvas.open(&format!("id=\"keep-outs\" fill=\"none\" stroke=\"{ERROR_COLOUR}\" stroke-width=\"1.2\""));
    let style = format!("stroke-dasharray=\"8 2 2 2\" fill=\"{ERROR_COLOUR}\" fill-opacity=\"0.14\"");
    for clamp in &scene.keep_outs {
        canvas.path(&outline_path_data(&clamp.outline, place), &style);
    }
    let style = format!("stroke=\"none\" fill=\"{ERROR_COLOUR}\"");
    for clamp in &scene.keep_outs {
        let Some([low, high]) = clamp.extent() else { continue };
        let [x, y] = place.to_page([0, 1].map(|axis| f64::midpoint(low[axis], high[axis])));
        let label = format!("Z{}", svg_number(clamp.height));
        room.occupy(text_rectangle([x, y], 11.0, &label));
        canvas.text([x, y + 4.0], 11.0, Anchor::Middle, &style, &label);
    }
    canvas.close();
}

/// Returns the adjacent shapes of an outline as one piece of SVG path data.
pub(super) fn outline_path_data(shapes: &[Shape], place: &PageTransform) -> String {
    let mut data = String::new();
    for piece in shapes {
        let next = shape_path_data(piece, place);
        let begin = if data.is_empty() { 0 } else { next.find(['L', 'A']).unwrap_or(0) };
        data.push_str(&next[begin..]);
    }
    data + "Z"
}

fn draw_other_text(canvas: &mut Canvas, [x, y]: Point, size: f64, rotation: f64, text: &str) {
    if size < MIN_LEGIBLE_SIZE {
        return;
    }
    let turn = if rotation == 0.0 {
        String::new()
    } else {
        format!(" transform=\"rotate({} {} {})\"", svg_number(-rotation), svg_number(x), svg_number(y))
    };
    let style = format!("stroke=\"none\" fill=\"{OTHER_COLOUR}\" dominant-baseline=\"central\"{turn}");
    for (row, line) in rows_from_middle(text) {
        canvas.text([x, y + row * size], size, Anchor::Middle, &style, line);
    }
}

/// Draws the shapes above the moves: elements, support bars, markers, probes, numbers, and names of embedded paths. Returns the numbers for
/// which there is no room.
pub(super) fn draw_above_moves(
    canvas: &mut Canvas,
    path: &ScenePath,
    place: &PageTransform,
    shown: VisibleParts,
    room: &mut OccupiedSpace,
) -> Vec<u32> {
    draw_elements(canvas, path, place);
    canvas.open(&format!(
        "id=\"bars\" fill=\"none\" stroke=\"{BAR_COLOUR}\" stroke-width=\"4\" stroke-opacity=\"0.75\""
    ));
    for bar in &path.bars {
        canvas.path(&shape_path_data(&bar.shape, place), "");
    }
    canvas.close();
    draw_ends(canvas, path, place, shown, room);
    draw_probes(canvas, path, place, room);
    let hidden = if shown.order { draw_order_numbers(canvas, path, place, room) } else { Vec::new() };
    draw_embedded_names(canvas, path, place, room);
    hidden
}

/// Draws the elements that no move shows. If the path has no program, these are all elements except for the start and end markers;
/// otherwise, for example, subpaths and turn markers.
fn draw_elements(canvas: &mut Canvas, path: &ScenePath, place: &PageTransform) {
    canvas.open("id=\"elements\" fill=\"none\" stroke-width=\"1.4\"");
    for element in &path.elements {
        let style = match element.kind {
            ElementKind::Subpath => "stroke=\"#7b8a97\" stroke-width=\"1\" stroke-dasharray=\"9 3 2 3\"",
            ElementKind::SkippedSubpath => "stroke=\"#b8bfc6\" stroke-width=\"1\" stroke-dasharray=\"1 4\"",
            ElementKind::Turn => "stroke=\"#14202b\" stroke-width=\"0.8\"",
            ElementKind::Unclear => "stroke=\"#c45200\" stroke-dasharray=\"3 3\"",
            ElementKind::Probe if path.probes.is_empty() => "stroke=\"#007a58\"",
            ElementKind::Mill | ElementKind::Mark | ElementKind::Support | ElementKind::Sweep
                if path.moves.is_empty() =>
            {
                style_without_program(element)
            }
            _ => continue,
        };
        canvas.path(&shape_path_data(&element.shape, place), style);
    }
    canvas.close();
}

fn style_without_program(element: &Element) -> &'static str {
    match element.kind {
        ElementKind::Mark => "stroke=\"#1868ac\" stroke-dasharray=\"2 3\"",
        ElementKind::Support => "stroke=\"#1868ac\" stroke-dasharray=\"12 3 3 3\"",
        ElementKind::Sweep => "stroke=\"#c07800\" stroke-dasharray=\"6 4\"",
        _ => "stroke=\"#1868ac\"",
    }
}

/// Draws texts. They lie above the width of the cutter and holes, and below moves and elements, which their halos would erase.
pub(super) fn draw_texts(
    canvas: &mut Canvas,
    path: &ScenePath,
    place: &PageTransform,
    room: &mut OccupiedSpace,
) {
    canvas.open(&format!("id=\"texts\" fill=\"{TEXT_COLOUR}\""));
    // Skip the text at the start of an embedded path: it only concerns that path's own drawing.
    let is_start = |index: &u32| path.elements[*index as usize].kind == ElementKind::Start;
    let is_shown = |label: &&Label| label.path == 0 || !label.elements.iter().any(is_start);
    let mut labels: Vec<&Label> = path.texts.iter().filter(is_shown).collect();
    // Place short texts first. They keep their positions, so that the circle of a text still encloses the text; long texts give way.
    labels.sort_by_key(|label| longest_line(label));
    for label in labels {
        let longest = longest_line(label).max(1);
        let size = (label.height * place.scale()).min(14.0);
        // The path's own texts are always legible; those of embedded paths are shown only if they are large enough.
        let size = if label.path == 0 { size.max(MIN_TEXT_SIZE) } else { size };
        if size < MIN_LEGIBLE_SIZE {
            continue;
        }
        let extent = [0.62 * size * longest as f64, rows(&label.text) * size];
        let Some(at) = room.occupy_near(place.to_page(label.at), extent) else { continue };
        for element in &label.elements {
            let to = place.to_page(nearest(&path.elements[*element as usize].shape, label.at));
            canvas.line(
                at,
                to,
                &format!("stroke=\"{TEXT_COLOUR}\" stroke-width=\"0.5\" stroke-opacity=\"0.6\""),
            );
        }
        for (row, line) in rows_from_middle(&label.text) {
            canvas.text([at[0], at[1] + (row + 0.35) * size], size, Anchor::Middle, HALO, line);
        }
    }
    canvas.close();
}

/// Returns the number of characters of the longest line of a text.
fn longest_line(label: &Label) -> usize {
    label.text.lines().map(|line| line.chars().count()).max().unwrap_or(0)
}

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

/// Draws the names of embedded paths at their starts, unless there is no space.
fn draw_embedded_names(
    canvas: &mut Canvas,
    path: &ScenePath,
    place: &PageTransform,
    room: &mut OccupiedSpace,
) {
    canvas.open(&format!("id=\"embedded\" fill=\"{INK_COLOUR}\" font-style=\"italic\""));
    for inner in path.embedded.iter().skip(1) {
        if let Some(at) = room.occupy_beside(place.to_page(inner.ends[0]), [6.0, -6.0], 9.0, &inner.name) {
            canvas.text(at, 9.0, Anchor::Start, HALO, &inner.name);
        }
    }
    canvas.close();
}

fn draw_probes(canvas: &mut Canvas, path: &ScenePath, place: &PageTransform, room: &mut OccupiedSpace) {
    canvas.open(&format!("id=\"probes\" stroke=\"{PROBE_COLOUR}\" fill=\"none\""));
    for probe in &path.probes {
        let at = place.to_page(probe.at);
        let size = probe_radius(place);
        canvas.circle(at, size, "stroke-width=\"1.4\"");
        canvas.line([at[0] - size, at[1]], [at[0] + size, at[1]], "stroke-width=\"0.8\"");
        canvas.line([at[0], at[1] - size], [at[0], at[1] + size], "stroke-width=\"0.8\"");
        let label = probe.label.as_deref().map(|label| format!(" {label}")).unwrap_or_default();
        let (style, label) =
            (format!("stroke=\"none\" fill=\"{PROBE_COLOUR}\""), format!("#{}{label}", probe.number));
        let at = room.place_beside(at, [size + 2.0, -3.0], 9.0, &label);
        canvas.text(at, 9.0, Anchor::Start, &style, &label);
    }
    canvas.close();
}

/// Returns a shape as SVG path data.
pub(super) fn shape_path_data(shape: &Shape, place: &PageTransform) -> String {
    let point = |at: Point| {
        let [x, y] = place.to_page(at);
        format!("{} {}", svg_number(x), svg_number(y))
    };
    let pieces = |arc: &ArcShape| {
        let radius = svg_number(arc.radius * place.scale());
        let sweep = i32::from(arc.clockwise);
        let pieces = arc_pieces(arc.degrees);
        let piece = |piece: u32| {
            let to = point(arc.point(f64::from(piece) / f64::from(pieces)));
            format!("A{radius} {radius} 0 0 {sweep} {to}")
        };
        format!("M{}{}", point(arc.from), (1..=pieces).map(piece).collect::<String>())
    };
    match shape {
        Shape::Line { from, to } => format!("M{}L{}", point(*from), point(*to)),
        Shape::Arc(arc) => pieces(arc),
        Shape::Circle { centre, radius } => {
            let right = [centre[0] + radius, centre[1]];
            pieces(&ArcShape {
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

pub(super) const SWEEP_COLOUR: &str = RAPID_COLOUR;

/// Radius in px of the circle around a number.
const NUMBER_RADIUS: f64 = 7.0;

/// Reserves the space of symbols with fixed positions.
pub(super) fn reserve_symbols(path: &ScenePath, place: &PageTransform, room: &mut OccupiedSpace) {
    for marker in markers(path).into_iter().flatten() {
        room.occupy(with_margin([place.to_page(marker.shape.start()); 2], 5.0));
    }
    for probe in &path.probes {
        room.occupy(with_margin([place.to_page(probe.at); 2], probe_radius(place)));
    }
}

fn markers(path: &ScenePath) -> [Option<&Element>; 2] {
    let marker = |kind| path.elements.iter().find(|element| element.path == 0 && element.kind == kind);
    [marker(ElementKind::Start), marker(ElementKind::End)]
}

/// Returns the radius of a probe's symbol in px.
fn probe_radius(place: &PageTransform) -> f64 {
    (3.0 * place.scale()).clamp(5.0, 16.0)
}

/// Distances in px from an element at which a number with a leader line is tried, and number of directions that are tried.
const LEADER_LENGTHS: [f64; 4] = [18.0, 26.0, 36.0, 48.0];
const LEADER_DIRECTIONS: u32 = 12;

/// Draws the numbers of the cutting order, on each element or beside it with a leader line. Returns the numbers for which there is no room.
pub(super) fn draw_order_numbers(
    canvas: &mut Canvas,
    path: &ScenePath,
    place: &PageTransform,
    room: &mut OccupiedSpace,
) -> Vec<u32> {
    let mut numbered: Vec<(u32, &Element)> =
        path.elements.iter().filter_map(|element| Some((element.order?, element))).collect();
    numbered.sort_by_key(|(order, _)| *order);
    let kerf = path.tool.unwrap_or(0.0) / 2.0 * place.scale();
    let mut remaining = Vec::new();
    let mut placed: Vec<(u32, Point)> = Vec::new();
    for (order, element) in numbered {
        match occupy_number_position(room, order, &places(&element.shape, place, kerf)) {
            Some(at) => placed.push((order, at)),
            None => remaining.push((order, element)),
        }
    }
    canvas.open(&format!("id=\"order\" fill=\"{INK_COLOUR}\""));
    let mut hidden = Vec::new();
    for (order, element) in remaining {
        let anchor = place.to_page(anchor_point(&element.shape));
        let around = LEADER_LENGTHS.iter().flat_map(|distance| points_around(anchor, *distance));
        // Check only the outer part of a leader line: near the element, it may touch another number.
        let outer = |at: &Point| [[0, 1].map(|axis| anchor[axis] + (at[axis] - anchor[axis]) / 3.0), *at];
        let around: Vec<Point> = around.filter(|at| !room.is_crossed_by(outer(at))).collect();
        match occupy_number_position(room, order, &around) {
            Some(at) => {
                canvas.line(at, anchor, &format!("stroke=\"{INK_COLOUR}\" stroke-width=\"0.6\""));
                placed.push((order, at));
            }
            None => hidden.push(order),
        }
    }
    placed.sort_by_key(|(order, _)| *order);
    for (order, at) in placed {
        draw_number(canvas, order, at);
    }
    canvas.close();
    hidden
}

/// Finds the first free position for a number, occupies it, and returns it.
fn occupy_number_position(room: &mut OccupiedSpace, order: u32, places: &[Point]) -> Option<Point> {
    let half = [number_width(order) / 2.0 + 1.0, NUMBER_RADIUS + 1.0];
    let corner = |[x, y]: &Point, sign: f64| [x + sign * half[0], y + sign * half[1]];
    let taken: Vec<Rectangle> = places.iter().map(|at| [corner(at, -1.0), corner(at, 1.0)]).collect();
    room.occupy_first_free(&taken).map(|found| places[found])
}

fn draw_number(canvas: &mut Canvas, order: u32, at: Point) {
    let style = format!("fill=\"#fff\" fill-opacity=\"0.85\" stroke=\"{INK_COLOUR}\" stroke-width=\"0.6\"");
    let width = number_width(order);
    if width > 2.0 * NUMBER_RADIUS {
        let corner = [at[0] - width / 2.0, at[1] - NUMBER_RADIUS];
        canvas.rect(corner, [width, 2.0 * NUMBER_RADIUS], &format!("rx=\"{NUMBER_RADIUS}\" {style}"));
    } else {
        canvas.circle(at, NUMBER_RADIUS, &style);
    }
    let size = if order > 99 { SMALL_NUMBER_SIZE } else { 8.5 };
    canvas.text([at[0], at[1] + size * 0.36], size, Anchor::Middle, "", &order.to_string());
}

/// Letter size in px of numbers with more than two digits.
const SMALL_NUMBER_SIZE: f64 = 7.0;

/// Returns the width of a number with its frame, which is a circle for up to three digits.
fn number_width(order: u32) -> f64 {
    if order > 999 { text_width(&order.to_string(), SMALL_NUMBER_SIZE) + 5.0 } else { 2.0 * NUMBER_RADIUS }
}

/// Returns the point of a shape that its number refers to: the middle of a curve, or the rightmost point of a circle.
fn anchor_point(shape: &Shape) -> Point {
    match shape {
        Shape::Circle { centre: [x, y], radius } => [x + radius, *y],
        Shape::Line { .. } | Shape::Arc(_) => shape.middle(),
    }
}

/// Returns points at this distance around a point, one in each of [`LEADER_DIRECTIONS`] directions.
fn points_around([x, y]: Point, distance: f64) -> impl Iterator<Item = Point> {
    (0..LEADER_DIRECTIONS).map(move |direction| {
        let (sin, cos) =
            libm::sincos(f64::from(direction) * std::f64::consts::TAU / f64::from(LEADER_DIRECTIONS));
        [x + distance * cos, y + distance * sin]
    })
}

/// Returns possible positions for the number of a shape: at the middle, or nearer to an end. For a circle, the centre if the circle is
/// visible around the number, otherwise beside it. The cutter removes `kerf` px on either side of the line.
fn places(shape: &Shape, place: &PageTransform, kerf: f64) -> Vec<Point> {
    let along =
        |point: &dyn Fn(f64) -> Point| [0.5, 0.35, 0.65, 0.2, 0.8].map(|share| place.to_page(point(share)));
    match shape {
        Shape::Line { from, to } => {
            along(&|share| [0, 1].map(|axis| from[axis] + share * (to[axis] - from[axis]))).to_vec()
        }
        Shape::Arc(arc) => along(&|share| arc.point(share)).to_vec(),
        Shape::Circle { centre, radius } => {
            let ([x, y], radius) = (place.to_page(*centre), radius * place.scale());
            let out = radius.max(kerf) + NUMBER_RADIUS + 3.0;
            // A drilled hole is drawn as a disc. A number inside would make it look like a ring.
            let is_seen = radius > NUMBER_RADIUS + 4.0 && radius > kerf * 1.05;
            let centre = is_seen.then_some([x, y]);
            centre.into_iter().chain([[x + out, y], [x, y + out], [x, y - out], [x - out, y]]).collect()
        }
    }
}

/// Draws the program's zero point, and the start and the end of the path.
pub(super) fn draw_ends(
    canvas: &mut Canvas,
    path: &ScenePath,
    place: &PageTransform,
    shown: VisibleParts,
    room: &mut OccupiedSpace,
) {
    let [start, end] = markers(path);
    let known = room.lines.len();
    room.lines.extend(lines(path, place, shown));
    canvas.open("id=\"ends\"");
    if let Some(start) = start {
        let at = place.to_page(start.shape.start());
        canvas.circle(at, 5.0, &format!("fill=\"{PROBE_COLOUR}\" stroke=\"#fff\" stroke-width=\"1\""));
        draw_label(canvas, room, at, [-8.0, 17.0], shown.choose("start X0 Y0", "Start X0 Y0"), PROBE_COLOUR);
    } else if path.elements.is_empty() && !path.moves.is_empty() {
        let at = place.to_page([0.0, 0.0]);
        canvas.line([at[0] - 7.0, at[1]], [at[0] + 7.0, at[1]], &format!("stroke=\"{PROBE_COLOUR}\""));
        canvas.line([at[0], at[1] - 7.0], [at[0], at[1] + 7.0], &format!("stroke=\"{PROBE_COLOUR}\""));
        draw_label(canvas, room, at, [4.0, 13.0], "X0 Y0", PROBE_COLOUR);
    }
    if let Some(end) = end {
        let [x, y] = place.to_page(end.shape.start());
        canvas.rect([x - 4.5, y - 4.5], [9.0, 9.0], &format!("fill=\"{INK_COLOUR}\" stroke=\"#fff\""));
        draw_label(canvas, room, [x, y], [-8.0, -11.0], shown.choose("end", "Ende"), INK_COLOUR);
    }
    canvas.close();
    room.lines.truncate(known);
}

/// Returns the moves of a path as straight lines, which labels avoid. Arcs are divided into pieces.
fn lines<'a>(
    path: &'a ScenePath,
    place: &'a PageTransform,
    shown: VisibleParts,
) -> impl Iterator<Item = [Point; 2]> + 'a {
    let is_drawn = move |movement: &&SceneMove| {
        movement.is_placed() && (movement.kind.cuts() || movement.kind == MoveKind::Sweep && shown.rapids)
    };
    path.moves.iter().filter(is_drawn).flat_map(move |movement| {
        let pieces = if matches!(movement.way.shape, MoveShape::Line) { 1 } else { ARC_PIECES };
        let at = move |piece: u32| {
            place.to_page(point_at_fraction(movement, f64::from(piece) / f64::from(pieces)))
        };
        (0..pieces).map(move |piece| [at(piece), at(piece + 1)])
    })
}

/// Number of straight lines that approximate an arc.
const ARC_PIECES: u32 = 8;

fn draw_label(
    canvas: &mut Canvas,
    room: &mut OccupiedSpace,
    at: Point,
    offset: Point,
    text: &str,
    color: &str,
) {
    let halo = "stroke=\"#fff\" stroke-width=\"2.5\" paint-order=\"stroke\"";
    let at = room.place_beside(at, offset, 9.5, text);
    canvas.text(at, 9.5, Anchor::Start, &format!("fill=\"{color}\" {halo}"), text);
}

/// Circles the places of findings, and numbers the first `numbered` findings. Findings at the same place share a circle.
pub(super) fn draw_findings(
    canvas: &mut Canvas,
    scene: &Scene,
    frame: &Frame,
    room: &mut OccupiedSpace,
    numbered: usize,
) {
    let place = frame.of_drawing();
    let mut circles: Vec<(Point, Vec<usize>, bool)> = Vec::new();
    for (index, finding) in scene.findings.iter().enumerate() {
        let Some(at) = finding.at else { continue };
        let at = place.to_page(at);
        let number = (index < numbered).then_some(finding.number);
        let is_same = |known: &&mut (Point, Vec<usize>, bool)| {
            libm::hypot(known.0[0] - at[0], known.0[1] - at[1]) < 6.0
        };
        match circles.iter_mut().find(is_same) {
            Some((_, numbers, is_error)) => {
                numbers.extend(number);
                *is_error |= finding.is_error;
            }
            None => circles.push((at, number.into_iter().collect(), finding.is_error)),
        }
    }
    canvas.open("id=\"findings\"");
    for (at, numbers, is_error) in circles {
        let color = if is_error { ERROR_COLOUR } else { WARNING_COLOUR };
        canvas.circle(at, 13.0, &format!("fill=\"none\" stroke=\"{color}\" stroke-width=\"2.4\""));
        if numbers.is_empty() {
            continue;
        }
        let numbers = numbers.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
        let halo = "stroke=\"#fff\" stroke-width=\"3\" paint-order=\"stroke\" font-weight=\"bold\"";
        let style = format!("fill=\"{color}\" {halo}");
        let at = room.place_beside(at, [12.0, -11.0], 13.0, &numbers);
        canvas.text(at, 13.0, Anchor::Start, &style, &numbers);
    }
    canvas.close();
}
