//! The picture on a setup sheet. It has its true size if that fits on the paper, and is enlarged if it would be very small; otherwise it is reduced.
//! The scale is always round, and stated.

use pathbuild_diagnostic::Lang;

use crate::extent::{Corners, with_margin, with_min_extent};
use crate::scene::Point;
use crate::svg::canvas::{
    Anchor, Canvas, Depths, INK_COLOUR, PROBE_COLOUR, TEXT_COLOUR, mm, svg_number, text_width,
};
use crate::svg::frame::{Frame, OccupiedSpace, PageTransform, VisibleParts};
use crate::svg::stock::{MilledStock, has_stock};
use crate::svg::{draw_scene, legend, moves, symbols};

use super::data::{Sheet, UNITS_PER_MM, removed_box, shown_box};
use super::flow::{Column, MAX_PICTURE_HEIGHT};

/// Margins around the drawing in units. Dimensions are to the left and below, and their last numbers extend to the right.
const LEFT_MARGIN: f64 = 56.0;
const RIGHT_MARGIN: f64 = 46.0;
const TOP_MARGIN: f64 = 18.0;
const BOTTOM_MARGIN: f64 = 50.0;

/// Height of the legend in units: scale, kinds of lines, depths.
const LEGEND_HEIGHT: f64 = 54.0;

/// Fraction of the available space below which a drawing is enlarged and gets a true-size inset.
const MIN_SPACE_SHARE: f64 = 0.34;

/// Minimum extent shown in mm, for drawings without an extent.
const MIN_EXTENT: f64 = 4.0;

/// A picture with its position and scale on a page.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlacedPicture {
    area: Column,
    corners: Corners,
    scale: Scale,
    /// Whether the picture has a true-size inset.
    has_inset: bool,
    height: f64,
    /// Whether the picture shows the stock after milling instead of the moves.
    is_stock: bool,
    /// Position of the lower left corner, if the picture is rotated to landscape.
    turned: Option<Point>,
}

/// A scale, in mm of paper per mm of the drawing.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Scale(f64);

impl Scale {
    /// Returns the largest round scale up to this limit.
    fn within(limit: f64) -> Self {
        const STEPS: [f64; 4] = [1.0, 2.0, 2.5, 5.0];
        let decades = (0..9).map(|decade| libm::pow(10.0, f64::from(decade)));
        let reductions = decades.flat_map(|decade| STEPS.map(|step| step * decade));
        let enlargements = [100.0, 50.0, 20.0, 10.0, 5.0, 2.0];
        let all = enlargements.into_iter().chain(reductions.map(|step| 1.0 / step));
        Self(all.into_iter().find(|scale| *scale <= limit).unwrap_or(limit))
    }

    fn text(self) -> String {
        if self.0 >= 1.0 { format!("{}:1", mm(self.0)) } else { format!("1:{}", mm(1.0 / self.0)) }
    }
}

/// Returns the picture for the first page: in true size if there is enough space, otherwise reduced; enlarged if it would be very small.
pub(super) fn first_page_picture(sheet: &Sheet, area: Column) -> PlacedPicture {
    let corners = with_min_extent(shown_box(sheet), MIN_EXTENT);
    let limit = max_scale(corners, area);
    let is_small = limit * MIN_SPACE_SHARE >= 1.0;
    let limit = if is_small { max_scale_beside_inset(corners, area) } else { limit.min(1.0) };
    PlacedPicture::new(area, corners, Scale::within(limit), is_small)
}

/// Returns the picture for a whole page, if it is larger there than on the first page.
pub(super) fn larger_picture(sheet: &Sheet, area: Column) -> Option<PlacedPicture> {
    let placed = upright_or_turned(area, |area| first_page_picture(sheet, area));
    let on_first = first_page_picture(sheet, Column { bottom: area.top + MAX_PICTURE_HEIGHT, ..area });
    (placed.scale.0 > on_first.scale.0).then_some(placed)
}

/// Returns a picture of the stock after milling for a whole page; `None` if nothing is cut.
pub(super) fn stock_picture(sheet: &Sheet, area: Column) -> Option<PlacedPicture> {
    let radius = sheet.tools.iter().map(|tool| tool.diameter / 2.0).fold(0.0, f64::max);
    let removed = removed_box(sheet).filter(|_| has_stock(&sheet.scene))?;
    let corners = with_min_extent(with_margin(removed, radius), MIN_EXTENT);
    Some(upright_or_turned(area, |area| {
        let scale = Scale::within(max_scale(corners, area));
        PlacedPicture { is_stock: true, ..PlacedPicture::new(area, corners, scale, false) }
    }))
}

/// Returns the larger of two pictures: upright on a page, or rotated to landscape.
fn upright_or_turned(area: Column, placed: impl Fn(Column) -> PlacedPicture) -> PlacedPicture {
    let beneath = Column { left: 0.0, width: area.bottom - area.top, top: 0.0, bottom: area.width };
    let turned = PlacedPicture { turned: Some([area.left, area.bottom]), ..placed(beneath) };
    let upright = placed(area);
    if turned.scale.0 > upright.scale.0 { turned } else { upright }
}

/// Returns the scale at which the corners fill the area.
fn max_scale([low, high]: Corners, area: Column) -> f64 {
    let room = [
        area.width - LEFT_MARGIN - RIGHT_MARGIN,
        area.bottom - area.top - TOP_MARGIN - BOTTOM_MARGIN - LEGEND_HEIGHT,
    ];
    (room[0] / (high[0] - low[0])).min(room[1] / (high[1] - low[1])) / UNITS_PER_MM
}

/// Returns the scale at which the corners fill the part of the area that a true-size inset on the right leaves free.
fn max_scale_beside_inset(corners: Corners, area: Column) -> f64 {
    let inset = inset_width(corners);
    max_scale(corners, Column { width: area.width - inset, ..area })
}

fn inset_width([low, high]: Corners) -> f64 {
    ((high[0] - low[0]) * UNITS_PER_MM).max(40.0) + 30.0
}

impl PlacedPicture {
    fn new(area: Column, corners: Corners, scale: Scale, has_inset: bool) -> Self {
        let [low, high] = corners;
        let height = TOP_MARGIN + (high[1] - low[1]) * scale.0 * UNITS_PER_MM + BOTTOM_MARGIN + LEGEND_HEIGHT;
        Self { area, corners, scale, has_inset, height, is_stock: false, turned: None }
    }

    pub(super) fn bottom(&self) -> f64 {
        self.area.top + self.height
    }

    /// Whether the picture has at least its true size, so that a larger one would have no benefit.
    pub(super) fn is_whole(&self) -> bool {
        self.scale.0 >= 1.0
    }

    fn frame(&self) -> Frame {
        let Self { area, corners: [low, high], scale, .. } = *self;
        let inset = if self.has_inset { inset_width(self.corners) } else { 0.0 };
        let spare =
            area.width - inset - LEFT_MARGIN - RIGHT_MARGIN - (high[0] - low[0]) * scale.0 * UNITS_PER_MM;
        Frame::at_scale(
            [low, high],
            scale.0 * UNITS_PER_MM,
            [area.left + LEFT_MARGIN + spare / 2.0, area.top + TOP_MARGIN],
        )
    }

    pub(super) fn draw(&self, canvas: &mut Canvas, sheet: &Sheet, lang: Lang) {
        let draw = |canvas: &mut Canvas| {
            if self.is_stock {
                self.draw_stock(canvas, sheet, lang);
            } else {
                self.draw_upright(canvas, sheet, lang);
            }
        };
        let Some([left, bottom]) = self.turned else { return draw(canvas) };
        canvas.open(&format!("transform=\"matrix(0 -1 1 0 {} {})\"", svg_number(left), svg_number(bottom)));
        draw(canvas);
        canvas.close();
    }

    fn draw_upright(&self, canvas: &mut Canvas, sheet: &Sheet, lang: Lang) {
        let frame = self.frame();
        let place = frame.of_drawing();
        let [low, high] = self.corners;
        let ([left, bottom], [right, top]) = (place.to_page(low), place.to_page(high));
        let shown = VisibleParts { texts: false, ..VisibleParts::all(lang) };
        let depths = Depths::of(&sheet.scene);
        canvas.open("id=\"drawing\" clip-path=\"url(#frame)\"");
        let clip = [[self.area.left, self.area.top], [self.area.left + self.area.width, bottom + 20.0]];
        canvas.clip(clip);
        let axes = draw_axes(
            canvas,
            place.to_page([0.0; 2]),
            [[left - 6.0, top - 6.0], [right + 6.0, bottom + 6.0]],
        );
        // Reserve space: dimensions are to the left and below, and the name of the axis is above.
        let mut room = OccupiedSpace::new([[left - 14.0, top - 6.0], [right + RIGHT_MARGIN, bottom + 20.0]]);
        room.lines.extend(axes);
        room.lines.extend(removed_box(sheet).into_iter().flat_map(|corners| sides(corners, &place)));
        let hidden = draw_scene(canvas, &sheet.scene, &frame, &depths, shown, &mut room);
        symbols::draw_findings(canvas, &sheet.scene, &frame, &mut room, sheet.scene.findings.len());
        canvas.close();
        if let Some(box_) = removed_box(sheet) {
            draw_dimensions(canvas, box_, &place, [left, bottom]);
        }
        if self.has_inset {
            self.draw_inset(canvas, sheet, lang);
        }
        self.draw_legend(canvas, sheet, &depths, shown, &hidden);
    }

    fn draw_stock(&self, canvas: &mut Canvas, sheet: &Sheet, lang: Lang) {
        let stock = MilledStock::of(&sheet.scene);
        stock.draw(canvas, &self.frame(), "stock");
        let top = self.bottom() - LEGEND_HEIGHT + 12.0;
        canvas.open(&format!("id=\"stock-legend\" fill=\"{INK_COLOUR}\""));
        let scale = self.scale.text();
        let title =
            lang.choose(format!("after milling, scale {scale}"), format!("nach dem Fräsen, Maßstab {scale}"));
        canvas.text([self.area.left, top], 11.0, Anchor::Start, "font-weight=\"bold\"", &title);
        let right = self.area.left + self.area.width;
        stock.draw_legend(canvas, VisibleParts::all(lang), [self.area.left, top + 17.0], right);
        canvas.close();
    }

    fn draw_legend(
        &self,
        canvas: &mut Canvas,
        sheet: &Sheet,
        depths: &Depths,
        shown: VisibleParts,
        hidden: &[u32],
    ) {
        let top = self.bottom() - LEGEND_HEIGHT + 12.0;
        canvas.open(&format!("id=\"legend\" fill=\"{INK_COLOUR}\""));
        let scale = self.scale.text();
        let scale = shown.lang.choose(format!("scale {scale}"), format!("Maßstab {scale}"));
        let bold = "font-weight=\"bold\"";
        canvas.text([self.area.left, top], 11.0, Anchor::Start, bold, &scale);
        legend::draw_depths(canvas, depths, [self.area.left + 110.0, top]);
        let below = legend::draw_line_kinds(
            canvas,
            &sheet.scene,
            shown,
            [self.area.left, top + 17.0],
            self.area.left + self.area.width + 30.0,
        );
        legend::draw_hidden_numbers(canvas, hidden, shown, [self.area.left, below + 15.0], self.area.width);
        canvas.close();
    }

    /// Draws the true-size inset, omitting details that would be too small to read.
    fn draw_inset(&self, canvas: &mut Canvas, sheet: &Sheet, lang: Lang) {
        let [low, high] = removed_box(sheet).unwrap_or(self.corners);
        let left = self.area.left + self.area.width - inset_width(self.corners) + 20.0;
        let frame = Frame::at_scale([low, high], UNITS_PER_MM, [left, self.area.top + TOP_MARGIN]);
        let depths = Depths::of(&sheet.scene);
        let shown =
            VisibleParts { rapids: false, order: false, arrows: false, texts: false, stock: false, lang };
        canvas.open("id=\"true-size\"");
        for path in &sheet.scene.paths {
            let (cuts, place) = (moves::cuts(path), frame.of_path(path));
            moves::draw_kerf(canvas, path, &cuts, &place, &depths);
            moves::draw(canvas, path, &cuts, &place, &depths, shown);
        }
        let y = self.area.top + TOP_MARGIN + (high[1] - low[1]) * UNITS_PER_MM + 14.0;
        canvas.text([left, y], 10.0, Anchor::Start, &format!("fill=\"{TEXT_COLOUR}\""), "1:1");
        canvas.close();
    }
}

fn sides([low, high]: Corners, place: &PageTransform) -> [[Point; 2]; 4] {
    let corners = [low, [high[0], low[1]], high, [low[0], high[1]]].map(|corner| place.to_page(corner));
    [0, 1, 2, 3].map(|side| [corners[side], corners[(side + 1) % 4]])
}

/// Draws the axes X0 and Y0 of the program, and returns their lines.
fn draw_axes(canvas: &mut Canvas, [x, y]: Point, [[left, top], [right, bottom]]: Corners) -> [[Point; 2]; 2] {
    let style = format!("stroke=\"{PROBE_COLOUR}\" stroke-width=\"0.7\" stroke-dasharray=\"10 3 2 3\"");
    canvas.open(&format!("id=\"axes\" fill=\"{PROBE_COLOUR}\""));
    let lines = [[[left, y], [right, y]], [[x, bottom], [x, top]]];
    for [from, to] in lines {
        canvas.line(from, to, &style);
    }
    for (name, at) in [("X", [right + 3.0, y + 3.0]), ("Y", [x - 3.0, top - 2.0])] {
        canvas.text(at, 9.0, Anchor::Start, "font-weight=\"bold\"", name);
    }
    canvas.close();
    lines
}

/// Letter size of the numbers in dimensions, and minimum distance between two numbers, in units.
const NUMBER_SIZE: f64 = 9.5;
const MIN_NUMBER_DISTANCE: f64 = 11.0;

/// Distance from the picture to the dimension lines, in units.
const DIMENSION_DISTANCE: f64 = 22.0;

/// Draws the dimensions of the removed material: its size, and the coordinates of its edges. The dimension lines are to the left of `left` and below
/// `bottom`, which are positions on the page.
fn draw_dimensions(canvas: &mut Canvas, [low, high]: Corners, place: &PageTransform, [left, bottom]: Point) {
    let ([x0, y1], [x1, y0]) = (place.to_page(low), place.to_page(high));
    canvas.open(&format!("id=\"measures\" fill=\"none\" stroke=\"{INK_COLOUR}\" stroke-width=\"0.7\""));
    canvas.rect([x0, y0], [x1 - x0, y1 - y0], "stroke-dasharray=\"5 3\"");
    let y = bottom + DIMENSION_DISTANCE;
    draw_double_arrow(canvas, [x0, y], [x1, y]);
    draw_extension_line(canvas, [x0, y1], [x0, y + 4.0]);
    draw_extension_line(canvas, [x1, y1], [x1, y + 4.0]);
    let x = left - DIMENSION_DISTANCE;
    draw_double_arrow(canvas, [x, y1], [x, y0]);
    draw_extension_line(canvas, [x0, y1], [x - 4.0, y1]);
    draw_extension_line(canvas, [x0, y0], [x - 4.0, y0]);
    canvas.close();
    let number = |axis: usize, value: f64| format!("{}{}", ["X", "Y"][axis], mm(value));
    canvas.open(&format!("id=\"numbers\" fill=\"{INK_COLOUR}\""));
    let size = mm(high[0] - low[0]);
    let has_room = text_width(&size, NUMBER_SIZE) < x1 - x0 - 12.0;
    let down = if has_room { 12.0 } else { 23.0 };
    draw_text(canvas, [f64::midpoint(x0, x1), y + down], Side::Middle, &size);
    draw_text(canvas, [x0 - 3.0, y + 12.0], Side::End, &number(0, low[0]));
    draw_text(canvas, [x1 + 3.0, y + 12.0], Side::Start, &number(0, high[0]));
    let middle = f64::midpoint(y0, y1);
    let third = NUMBER_SIZE / 3.0;
    draw_text(canvas, [x - 4.0, middle + third], Side::End, &mm(high[1] - low[1]));
    draw_text(
        canvas,
        [x - 6.0, y0.min(middle - MIN_NUMBER_DISTANCE) + third],
        Side::End,
        &number(1, high[1]),
    );
    draw_text(canvas, [x - 6.0, y1.max(middle + MIN_NUMBER_DISTANCE) + third], Side::End, &number(1, low[1]));
    canvas.close();
}

#[derive(Clone, Copy)]
enum Side {
    Start,
    Middle,
    End,
}

fn draw_text(canvas: &mut Canvas, at: Point, side: Side, text: &str) {
    let (anchor, style) = match side {
        Side::Start => (Anchor::Start, ""),
        Side::Middle => (Anchor::Middle, ""),
        Side::End => (Anchor::Start, "text-anchor=\"end\""),
    };
    canvas.text(at, NUMBER_SIZE, anchor, style, text);
}

/// Draws a line with arrows at both ends.
fn draw_double_arrow(canvas: &mut Canvas, from: Point, to: Point) {
    canvas.line(from, to, "");
    let length = libm::hypot(to[0] - from[0], to[1] - from[1]);
    if length < 12.0 {
        return;
    }
    let [dx, dy] = [(to[0] - from[0]) / length, (to[1] - from[1]) / length];
    for (tip, sign) in [(from, 1.0), (to, -1.0)] {
        let foot = [tip[0] + sign * dx * 5.0, tip[1] + sign * dy * 5.0];
        let points =
            [tip, [foot[0] - dy * 1.8, foot[1] + dx * 1.8], [foot[0] + dy * 1.8, foot[1] - dx * 1.8]];
        let [tip, left, right] = points.map(|[x, y]| format!("{} {}", svg_number(x), svg_number(y)));
        canvas.path(&format!("M{tip}L{left}L{right}Z"), &format!("fill=\"{INK_COLOUR}\""));
    }
}

fn draw_extension_line(canvas: &mut Canvas, from: Point, to: Point) {
    canvas.line(from, to, "stroke-width=\"0.4\"");
}
