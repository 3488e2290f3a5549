//! Pictures of the part of a drawing around a finding.

use super::canvas::{Anchor, Canvas, ERROR_COLOUR, INK_COLOUR, TEXT_COLOUR, WARNING_COLOUR, mm};
use super::frame::{Frame, OccupiedSpace, PageTransform, VisibleParts};
use super::stock::{self, MilledStock};
use super::symbols;
use crate::extent::{Corners, bounding_box, with_margin};
use crate::scene::{KeepOut, Label, OtherShape, Point, Scene, ScenePath, Shape};
use pathbuild_diagnostic::Lang;

/// Size of the picture in px.
const SIZE: Point = [420.0, 280.0];

/// Minimum extent shown in mm, and factor by which the picture exceeds the extent of the related points.
const MIN_EXTENT: f64 = 36.0;
const ENLARGEMENT: f64 = 1.4;

/// Extent shown for a small gap: this multiple of the gap, but at least `MIN_GAP_EXTENT` mm.
const GAP_MULTIPLE: f64 = 40.0;
const MIN_GAP_EXTENT: f64 = 4.0;

/// Radius in px of the circle that marks the place.
const CIRCLE_RADIUS: f64 = 17.0;

/// Distance in mm from a text's circle up to which a finding is considered to be about the text, so that the circle is drawn.
const LABEL_DISTANCE: f64 = 1.0;

/// Number of a drawing's first paths that are included even if they have no elements nearby. Including all of them would put thousands into
/// each picture.
const MAX_EMPTY_PATHS: usize = 200;

/// Maximum number of texts in a picture. There is no space for more, and searching for space takes long.
const MAX_TEXTS: usize = 200;

/// The place of a finding, and the things that a picture must show with it.
#[derive(Clone, Debug, PartialEq)]
pub struct FindingPlace {
    /// Position of the finding in the drawing.
    pub at: Point,
    /// Related points, such as the nearest open end or the position of a text.
    pub related: Vec<Point>,
    /// For a text that belongs to no element: centre and radius of the circle by which it is matched with elements.
    pub circle: Option<(Point, f64)>,
    /// Whether the finding is an error rather than a warning.
    pub is_error: bool,
}

/// Draws the surroundings of a finding and circles its place. Distant elements are omitted.
pub fn cutout_svg(scene: &Scene, spot: &FindingPlace, lang: Lang) -> String {
    draw_surroundings(spot, |canvas, frame, window| {
        let near = scene_near(scene, window);
        let mut room = OccupiedSpace::new([[0.0; 2], SIZE]);
        symbols::draw_below_moves(canvas, &near, frame, &mut room);
        stock::draw_uncut_parts(canvas, &near, &frame.of_drawing());
        let shown = VisibleParts { rapids: false, order: false, arrows: false, ..VisibleParts::all(lang) };
        for path in &near.paths {
            let place = frame.of_path(path);
            draw_text_circles(canvas, path, spot, &place);
            symbols::draw_texts(canvas, path, &place, &mut room);
            symbols::draw_above_moves(canvas, path, &place, shown, &mut room);
        }
    })
}

/// Draws the stock around a finding as it is when all moves are done. `number` makes ids unique if a document contains several pictures.
/// `has_corners`: whether to fill corners that the cutter does not reach.
pub fn stock_cutout_svg(scene: &Scene, spot: &FindingPlace, has_corners: bool, number: usize) -> String {
    draw_surroundings(spot, |canvas, frame, window| {
        let mut stock = MilledStock::of(scene).keep_near(window);
        stock.has_corners = has_corners;
        stock.draw(canvas, frame, &format!("stock{number}"));
    })
}

/// Draws the area around a finding by calling `draw`, and marks the place.
fn draw_surroundings(spot: &FindingPlace, draw: impl FnOnce(&mut Canvas, &Frame, Corners)) -> String {
    let window = window(spot);
    let scale = SIZE[0] / (window[1][0] - window[0][0]);
    let frame = Frame::at_scale(window, scale, [0.0, 0.0]);
    let mut canvas = Canvas::new(SIZE[0], SIZE[1]);
    canvas.open("id=\"drawing\"");
    draw(&mut canvas, &frame, window);
    canvas.close();
    draw_mark(&mut canvas, spot, &frame.of_drawing());
    draw_scale_bar(&mut canvas, scale);
    canvas.finish()
}

/// Returns the corners of the area shown. It is centred on the place and its related points.
fn window(spot: &FindingPlace) -> Corners {
    let places = spot.related.iter().chain([&spot.at]);
    let [low, high] = bounding_box(places.map(|at| [*at; 2])).unwrap_or_default();
    let tall = SIZE[1] / SIZE[0];
    let across = libm::hypot(high[0] - low[0], high[1] - low[1]);
    let least =
        if across > 0.0 { (GAP_MULTIPLE * across).clamp(MIN_GAP_EXTENT, MIN_EXTENT) } else { MIN_EXTENT };
    let width = ((high[0] - low[0]) * ENLARGEMENT).max((high[1] - low[1]) * ENLARGEMENT / tall).max(least);
    let half = [width / 2.0, width * tall / 2.0];
    let middle = [0, 1].map(|axis| f64::midpoint(low[axis], high[axis]));
    [[0, 1].map(|axis| middle[axis] - half[axis]), [0, 1].map(|axis| middle[axis] + half[axis])]
}

/// Returns the elements, texts and clamps of a scene that lie in an area. Without this selection, the picture of each finding would contain the whole
/// drawing.
fn scene_near(scene: &Scene, [low, high]: Corners) -> Scene {
    let is_in = |[from, to]: Corners| (0..2).all(|axis| from[axis] <= high[axis] && to[axis] >= low[axis]);
    let is_near = |shape: &Shape| is_in(shape.extent());
    let is_other_near = |other: &&OtherShape| match other {
        OtherShape::Shape { shape, .. } => is_near(shape),
        OtherShape::Text { at, height, text, .. } => {
            let reach = height * text.chars().count().max(1) as f64;
            is_in(with_margin([*at; 2], reach))
        }
    };
    let is_clamp_near = |clamp: &&KeepOut| clamp.outline.iter().any(is_near);
    let paths = scene.paths.iter().map(|path| path_near(path, is_near, is_in)).enumerate();
    let is_shown = |(number, path): &(usize, ScenePath)| {
        *number < MAX_EMPTY_PATHS || !path.elements.is_empty() || !path.texts.is_empty()
    };
    let mut paths: Vec<ScenePath> = paths.filter(is_shown).map(|(_, path)| path).collect();
    keep_first_texts(&mut paths);
    Scene {
        paths,
        other_layers: scene.other_layers.iter().filter(is_other_near).cloned().collect(),
        keep_outs: scene.keep_outs.iter().filter(is_clamp_near).cloned().collect(),
        uncut: scene.uncut.iter().filter(|ring| ring.iter().any(is_near)).cloned().collect(),
        ..Scene::new(&scene.title)
    }
}

fn keep_first_texts(paths: &mut [ScenePath]) {
    let mut remaining = MAX_TEXTS;
    for path in paths {
        path.texts.truncate(remaining);
        remaining -= path.texts.len();
    }
}

fn path_near(
    path: &ScenePath,
    is_near: impl Fn(&Shape) -> bool,
    is_in: impl Fn(Corners) -> bool,
) -> ScenePath {
    let kept = path.elements.iter().zip(0_u32..).filter(|(element, _)| is_near(&element.shape));
    let (elements, numbers): (Vec<_>, Vec<u32>) =
        kept.map(|(element, number)| (element.clone(), number)).unzip();
    let renumbered = |old: &u32| numbers.binary_search(old).ok().and_then(|new| u32::try_from(new).ok());
    let label = |label: &Label| {
        is_in(with_margin([label.at; 2], label.radius)).then(|| Label {
            elements: label.elements.iter().filter_map(renumbered).collect(),
            ..label.clone()
        })
    };
    ScenePath {
        name: path.name.clone(),
        tool: path.tool,
        embedded: path.embedded.iter().take(1).cloned().collect(),
        texts: path.texts.iter().filter_map(label).collect(),
        elements,
        ..ScenePath::default()
    }
}

/// Draws the matching circles of the texts at the place of the finding.
fn draw_text_circles(canvas: &mut Canvas, path: &ScenePath, spot: &FindingPlace, place: &PageTransform) {
    for label in &path.texts {
        let away = libm::hypot(label.at[0] - spot.at[0], label.at[1] - spot.at[1]);
        if away <= label.radius + LABEL_DISTANCE {
            let style = format!("fill=\"none\" stroke=\"{TEXT_COLOUR}\" stroke-dasharray=\"3 3\"");
            canvas.circle(place.to_page(label.at), label.radius * place.scale(), &style);
        }
    }
}

/// Circles the place of the finding, and draws lines to related points.
fn draw_mark(canvas: &mut Canvas, spot: &FindingPlace, place: &PageTransform) {
    let color = if spot.is_error { ERROR_COLOUR } else { WARNING_COLOUR };
    let at = place.to_page(spot.at);
    canvas.open(&format!("id=\"finding\" fill=\"none\" stroke=\"{color}\""));
    for related in &spot.related {
        let to = place.to_page(*related);
        canvas.line(at, to, "stroke-width=\"1.2\" stroke-dasharray=\"4 3\"");
        canvas.circle(to, 5.0, "stroke-width=\"1.6\"");
    }
    if let Some((centre, radius)) = spot.circle {
        canvas.circle(place.to_page(centre), radius * place.scale(), "stroke-dasharray=\"3 3\"");
    }
    canvas.circle(at, CIRCLE_RADIUS, "stroke-width=\"2.6\"");
    canvas.circle(at, 1.5, &format!("stroke=\"none\" fill=\"{color}\""));
    canvas.close();
}

/// Draws a scale bar of a round length in the lower left corner.
fn draw_scale_bar(canvas: &mut Canvas, scale: f64) {
    let decades = (-1..6).map(|decade| libm::pow(10.0, f64::from(decade)));
    let lengths = decades.flat_map(|decade| [1.0, 2.0, 5.0].map(|step| step * decade));
    let Some(length) = lengths.take_while(|length| length * scale <= SIZE[0] / 4.0).last() else { return };
    let y = SIZE[1] - 8.0;
    canvas.line(
        [8.0, y],
        [8.0 + length * scale, y],
        &format!("stroke=\"{INK_COLOUR}\" stroke-width=\"1.5\""),
    );
    let text = format!("{} mm", mm(length));
    canvas.text([8.0, y - 4.0], 10.0, Anchor::Start, &format!("fill=\"{INK_COLOUR}\""), &text);
}
