use super::{MText, Point, Text};

/// The shape of an entity in world coordinates, even if the entity is mirrored.
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

/// A polyline of lines and arcs.
#[derive(Clone, Debug, PartialEq)]
pub struct Polyline {
    /// The DXF entity to write.
    pub kind: PolylineKind,
    /// The vertices.
    pub vertices: Vec<Vertex>,
    /// Whether the last vertex is connected to the first.
    pub closed: bool,
}

/// A vertex of a polyline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// The position.
    pub point: Point,
    /// Bulge of the segment to the next vertex: the tangent of a quarter of the arc's angle, positive counterclockwise; 0 for a line.
    pub bulge: f64,
}

/// The DXF entities for polylines.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PolylineKind {
    /// LWPOLYLINE, or POLYLINE in versions before R14.
    #[default]
    Light,
    /// POLYLINE with VERTEX entities.
    Heavy,
    /// Three-dimensional POLYLINE.
    Spatial,
}

/// An ellipse or a part of one, from parameter `start` to `end` in degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct Ellipse {
    pub centre: Point,
    /// From the centre to the end of the major axis.
    pub major: Point,
    /// The ratio of the minor axis to the major axis.
    pub ratio: f64,
    pub start: f64,
    pub end: f64,
}

/// A B-spline, defined by control points or only by fit points.
#[derive(Clone, Debug, PartialEq)]
pub struct Spline {
    /// The degree; usually 3.
    pub degree: u8,
    /// The control points.
    pub control: Vec<Point>,
    /// The knots: as many as control points + degree + 1.
    pub knots: Vec<f64>,
    /// The weights: one for each control point, or none.
    pub weights: Vec<f64>,
    /// Points on the curve.
    pub fit: Vec<Point>,
    /// Whether the flag for closed splines is set.
    pub closed: bool,
}

/// A block reference.
#[derive(Clone, Debug, PartialEq)]
pub struct Insert {
    /// The block's name.
    pub block: String,
    /// The position of the block's base point.
    pub at: Point,
    /// Factors in x, y and z.
    pub scale: Point,
    /// Rotation in degrees, counterclockwise.
    pub rotation: f64,
    /// Number of columns and rows.
    pub count: (i16, i16),
    /// Distance between columns and between rows.
    pub spacing: (f64, f64),
}

/// A horizontal dimension. Its visible parts are in its block.
#[derive(Clone, Debug, PartialEq)]
pub struct Dimension {
    /// The first measured point.
    pub from: Point,
    /// The second measured point.
    pub to: Point,
    /// A point on the dimension line.
    pub line: Point,
    /// The label.
    pub label: String,
    /// The centre of the label.
    pub text: Point,
    /// The name of the block.
    pub block: String,
}

/// A group code with its value, as in the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pair {
    /// The group code.
    pub code: i32,
    /// The value as text, whatever its type.
    pub value: String,
}

impl Pair {
    /// Creates a pair.
    pub fn new(code: i32, value: impl Into<String>) -> Self {
        Self { code, value: value.into() }
    }
}

impl Arc {
    /// The point at an angle in degrees.
    pub fn point(&self, degrees: f64) -> Point {
        self.centre.polar(self.radius, degrees)
    }

    /// The angle covered, greater than 0 and at most 360 degrees.
    pub fn sweep(&self) -> f64 {
        let sweep = (self.end - self.start).rem_euclid(360.0);
        if sweep == 0.0 { 360.0 } else { sweep }
    }

    /// The arc of a bulge; `None` if it is straight or has no length.
    pub fn bulged(from: Point, to: Point, bulge: f64) -> Option<Self> {
        let chord = from.distance(to);
        if bulge == 0.0 || chord == 0.0 {
            return None;
        }
        let radius = chord * (1.0 + bulge * bulge) / (4.0 * bulge.abs());
        // From the midpoint of the chord to the centre, positive to the left of the chord.
        let offset = chord * (1.0 - bulge * bulge) / (4.0 * bulge);
        let unit = (to - from) * (1.0 / chord);
        let middle = (from + to) * 0.5;
        let centre = Point::new(middle.x - unit.y * offset, middle.y + unit.x * offset).at(from.z);
        let (start, end) = if bulge > 0.0 { (from, to) } else { (to, from) };
        Some(Self { centre, radius, start: centre.direction(start), end: centre.direction(end) })
    }
}

impl Polyline {
    /// The segments as (start, end, bulge).
    pub fn pieces(&self) -> impl Iterator<Item = (Point, Point, f64)> + '_ {
        let next = self.vertices.iter().skip(1).chain(self.vertices.first().filter(|_| self.closed));
        self.vertices.iter().zip(next).map(|(a, b)| (a.point, b.point, a.bulge))
    }
}
