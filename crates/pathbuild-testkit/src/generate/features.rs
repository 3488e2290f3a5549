use super::pen::Pen;
use super::plan::{PathPlan, comma};
use crate::random::Random;
use pathbuild_draw::model::Point;

/// Parameters that the texts of a path depend on.
pub(super) struct Tool {
    pub(super) thickness: f64,
    cutter: f64,
    infeed: f64,
    /// The value of B: a number or the path's variable.
    bottom: String,
    /// Whether the text at the start gives B, so that elements need not.
    bottom_is_inherited: bool,
}

impl Tool {
    pub(super) fn of(path: &PathPlan, random: &mut Random) -> Self {
        let bottom = random.pick(&[0.0, -0.1, -0.3, 0.4]);
        Self {
            thickness: path.signature.thickness,
            cutter: path.signature.cutter,
            infeed: random.pick(&[0.5, 0.8, 1.0, 1.5]),
            bottom: if path.variable.is_some() { "=B".to_owned() } else { comma(bottom) },
            bottom_is_inherited: random.once_in(3),
        }
    }

    pub(super) fn start_text(&self, path: &PathPlan) -> String {
        let (t, o, i) = (comma(self.thickness), comma(self.cutter), comma(self.infeed));
        let bottom = if self.bottom_is_inherited { format!("\\PB{}", self.bottom) } else { String::new() };
        let range = |(low, high)| format!("\\P:B{}~{}", comma(low), comma(high));
        let variable = path.variable.map(range).unwrap_or_default();
        format!("{}\\PO{o}\\PT{t}\\PI{i}{bottom}{variable}", path.signature.material)
    }

    /// The text of an element milled to B.
    fn bottom_text(&self, more: &str) -> String {
        let own = if self.bottom_is_inherited { String::new() } else { format!("B{}", self.bottom) };
        format!("{own} {more}").trim().to_owned()
    }

    /// A marking depth, above every B.
    fn mark(&self) -> String {
        comma(self.thickness - 0.4)
    }
}

/// Draws a random feature in the field with this lower left corner.
pub(super) fn draw_feature(pen: &mut Pen<'_>, tool: &Tool, field: Point) {
    match pen.random.below(6) {
        0 => contour(pen, tool, field),
        1 => groove(pen, tool, field),
        2 => bars(pen, tool, field),
        3 => marks(pen, tool, field),
        4 => holes(pen, tool, field),
        _ => helixes(pen, tool, field),
    }
}

fn corner(field: Point, x: f64, y: f64) -> Point {
    field + Point::new(x, y)
}

/// Draws a closed contour with rounded corners.
fn contour(pen: &mut Pen<'_>, tool: &Tool, field: Point) {
    let width = pen.random.between(14.0, 26.0, 0.5);
    let height = pen.random.between(10.0, 18.0, 0.5);
    pen.sweep(corner(field, 3.0, 0.0), tool.thickness);
    let text = tool.bottom_text("");
    pen.line(corner(field, width, 0.0), "CONTINUOUS", &tool.bottom_text("F180"));
    pen.line(corner(field, width, height - 3.0), "CONTINUOUS", &text);
    pen.arc(corner(field, width - 3.0, height), 0.414_213_562_373, "CONTINUOUS", &text);
    pen.line(corner(field, 0.0, height), "CONTINUOUS", &text);
    pen.line(corner(field, 0.0, 3.0), "CONTINUOUS", &text);
    pen.arc(corner(field, 3.0, 0.0), 0.414_213_562_373, "CONTINUOUS", &text);
}

/// Draws an open chain of lines and arcs with increasing depth.
fn groove(pen: &mut Pen<'_>, tool: &Tool, field: Point) {
    pen.sweep(field, tool.thickness);
    let steps = 3 + pen.random.below(4);
    for step in 0..steps {
        let to = corner(field, 4.5 * (step + 1) as f64, pen.random.between(0.0, 12.0, 0.25));
        let text = tool.bottom_text(if step == 0 { "Q(Nut)" } else { "" });
        if pen.random.once_in(3) {
            let bulge = pen.random.pick(&[-0.5, -0.25, 0.25, 0.5]);
            pen.arc(to, bulge, "CONTINUOUS", &text);
        } else {
            pen.line(to, "CONTINUOUS", &text);
        }
    }
}

/// Draws lines with support bars that leave room for the cutter.
fn bars(pen: &mut Pen<'_>, tool: &Tool, field: Point) {
    pen.sweep(field, tool.thickness);
    let length = pen.random.between(20.0, 28.0, 0.5);
    let (bar, distance) = (pen.random.pick(&[1.0, 2.0]), tool.cutter + pen.random.pick(&[3.0, 5.0]));
    let text = format!("B{} D{} P{} U{}", tool.bottom, tool.mark(), comma(bar), comma(distance));
    pen.line(corner(field, length, 0.0), "BORDER", &text);
    pen.line(corner(field, length, 15.0), "CENTER", &text);
}

/// Draws marks, some of them on a layer with a suffix.
fn marks(pen: &mut Pen<'_>, tool: &Tool, field: Point) {
    pen.sweep(field, tool.thickness);
    let text = format!("D{}", tool.mark());
    pen.line(corner(field, 8.0, 6.0), "DIVIDE", &text);
    pen.arc(corner(field, 18.0, 6.0), -0.5, "DIVIDE", &text);
    pen.line(corner(field, 24.0, 0.0), "DIVIDE", &text);
}

/// Draws a row of drilled holes; the last one is only marked.
fn holes(pen: &mut Pen<'_>, tool: &Tool, field: Point) {
    let count = 2 + pen.random.below(3);
    for hole in 0..count {
        pen.sweep(corner(field, 7.5 * hole as f64, 3.0), tool.thickness);
        if hole + 1 == count {
            pen.circle(tool.cutter, "DIVIDE", &format!("D{}", tool.mark()));
        } else {
            pen.circle(tool.cutter, "CONTINUOUS", &tool.bottom_text(""));
        }
    }
}

/// Draws two helical circles, one of them for marking.
fn helixes(pen: &mut Pen<'_>, tool: &Tool, field: Point) {
    pen.sweep(corner(field, 6.0, 8.0), tool.thickness);
    let diameter = tool.cutter * pen.random.pick(&[1.5, 2.0, 3.0]);
    pen.circle(diameter, "CONTINUOUS", &tool.bottom_text("I0,4"));
    pen.sweep(corner(field, 24.0, 8.0), tool.thickness);
    pen.circle(diameter, "DIVIDE", &format!("D{} I0,2", tool.mark()));
}
