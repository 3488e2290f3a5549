use super::{MText, Point, Text};

/// The shape of an entity, in world coordinates: that of a mirrored one is given as it is seen.
#[derive(Clone, Debug, PartialEq)]
#[expect(missing_docs, reason = "the DXF names say it")]
pub enum Shape {
    Line(Line),
    Arc(Arc),
    Circle(Circle),
    Polyline(Polyline),
    Ellipse(Ellipse),
    Spline(Spline),
    Insert(Insert),
    Text(Text),
    MText(MText),
    Solid([Point; 4]),
    Dimension(Dimension),
    Raw(Vec<Pair>),
}

/// A straight line.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct Line {
    pub from: Point,
    pub to: Point,
}

/// A part of a circle, counterclockwise from `start` to `end` (degrees).
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct Arc {
    pub centre: Point,
    pub radius: f64,
    pub start: f64,
    pub end: f64,
}

/// A whole circle.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct Circle {
    pub centre: Point,
    pub radius: f64,
}

/// Lines and arcs in one piece.
#[derive(Clone, Debug, PartialEq)]
pub struct Polyline {
    /// As which DXF entity it is written.
    pub kind: PolylineKind,
    /// The corners.
    pub vertices: Vec<Vertex>,
    /// Whether the last corner is joined to the first.
    pub closed: bool,
}

/// A corner of a polyline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// Where.
    pub point: Point,
    /// Of the piece from here to the next corner: tan of a quarter of the arc's angle, positive counterclockwise; 0 is a line.
    pub bulge: f64,
}

/// The DXF entities that are polylines.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PolylineKind {
    /// LWPOLYLINE, or POLYLINE in versions before R14.
    #[default]
    Light,
    /// POLYLINE with VERTEX entities.
    Heavy,
    /// POLYLINE in space.
    Spatial,
}

/// An ellipse or a part of one, from parameter `start` to `end` in degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct Ellipse {
    pub centre: Point,
    /// From the centre to the end of the longer axis.
    pub major: Point,
    /// The shorter axis divided by the longer one.
    pub ratio: f64,
    pub start: f64,
    pub end: f64,
}

/// A B-spline by its control points, or by fit points alone.
#[derive(Clone, Debug, PartialEq)]
pub struct Spline {
    /// 3 for the usual cubic.
    pub degree: u8,
    /// The control points.
    pub control: Vec<Point>,
    /// As many as control points + degree + 1.
    pub knots: Vec<f64>,
    /// One for each control point, or none.
    pub weights: Vec<f64>,
    /// Points on the curve.
    pub fit: Vec<Point>,
    /// Whether the flag says closed.
    pub closed: bool,
}

/// A block put into the drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Insert {
    /// The block's name.
    pub block: String,
    /// Where the block's base point comes to lie.
    pub at: Point,
    /// Factors in x, y and z.
    pub scale: Point,
    /// Degrees, counterclockwise.
    pub rotation: f64,
    /// Columns, rows.
    pub count: (i16, i16),
    /// Between columns, between rows.
    pub spacing: (f64, f64),
}

/// A horizontal dimension. What is seen of it stands in its block.
#[derive(Clone, Debug, PartialEq)]
pub struct Dimension {
    /// The first point that is measured from.
    pub from: Point,
    /// The other one.
    pub to: Point,
    /// A point on the dimension line.
    pub line: Point,
    /// What is written on it.
    pub label: String,
    /// The middle of the label.
    pub text: Point,
    /// The block.
    pub block: String,
}

/// A group code with its value, as they stand in the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pair {
    /// The group code.
    pub code: i32,
    /// The value, of any type.
    pub value: String,
}

impl Pair {
    /// A pair.
    pub fn new(code: i32, value: impl Into<String>) -> Self {
        Self { code, value: value.into() }
    }
}

impl Arc {
    /// The point at an angle in degrees.
    pub fn point(&self, degrees: f64) -> Point {
        self.centre.polar(self.radius, degrees)
    }

    /// The angle it covers, more than 0 and at most 360 degrees.
    pub fn sweep(&self) -> f64 {
        let sweep = (self.end - self.start).rem_euclid(360.0);
        if sweep == 0.0 { 360.0 } else { sweep }
    }

    /// The arc of a bulge; `None` where it is straight or without length.
    pub fn bulged(from: Point, to: Point, bulge: f64) -> Option<Self> {
        let chord = from.distance(to);
        if bulge == 0.0 || chord == 0.0 {
            return None;
        }
        let radius = chord * (1.0 + bulge * bulge) / (4.0 * bulge.abs());
        // From the chord's middle to the centre, to the left of the chord.
        let offset = chord * (1.0 - bulge * bulge) / (4.0 * bulge);
        let unit = (to - from) * (1.0 / chord);
        let middle = (from + to) * 0.5;
        let centre = Point::new(middle.x - unit.y * offset, middle.y + unit.x * offset).at(from.z);
        let (start, end) = if bulge > 0.0 { (from, to) } else { (to, from) };
        Some(Self { centre, radius, start: centre.direction(start), end: centre.direction(end) })
    }
}

impl Polyline {
    /// The pieces: from, to, bulge.
    pub fn pieces(&self) -> impl Iterator<Item = (Point, Point, f64)> + '_ {
        let next = self.vertices.iter().skip(1).chain(self.vertices.first().filter(|_| self.closed));
        self.vertices.iter().zip(next).map(|(a, b)| (a.point, b.point, a.bulge))
    }
}
