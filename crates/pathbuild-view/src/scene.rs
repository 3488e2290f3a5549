//! The scene: everything visible, as data.
//!
//! Lengths are in mm. Each path has its own coordinates, which are those of its program; [`ScenePath::zero`] is their origin in the
//! drawing. Everything outside of paths is in the coordinates of the drawing.

use pathbuild_diagnostic::shown;
use pathbuild_motion as motion;
use pathbuild_motion::{Axes, MoveShape, Pace};
use serde::ser::SerializeSeq;
use serde::{Serialize, Serializer};

/// The name of the JSON form.
pub const SCHEMA: &str = "pathbuild-scene";

/// The version of the JSON form. It is incremented when a reader of the older form would misread the new one.
pub const VERSION: u32 = 1;

/// A point in the plane: x, y.
pub type Point = [f64; 2];

/// The visible content of a path, a drawing or a program.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Scene {
    /// [`SCHEMA`].
    pub schema: &'static str,
    /// [`VERSION`].
    pub version: u32,
    /// Its subject: the name of a path, drawing or program.
    pub title: String,
    /// Height in mm above the plate below which a cut counts as going through it.
    #[serde(serialize_with = "millimetres")]
    pub through: f64,
    /// The paths, or the single program.
    pub paths: Vec<ScenePath>,
    /// Shapes on other layers, shown in grey.
    pub other_layers: Vec<OtherShape>,
    /// Clamps, which the tool must not enter below their height.
    pub keep_outs: Vec<KeepOut>,
    /// Outlines of parts that no path comes near.
    #[serde(skip)]
    pub uncut: Vec<Vec<Shape>>,
    /// Findings, numbered from 1.
    pub findings: Vec<Finding>,
}

/// A path of a drawing with its program, if it has one; or a program that was read.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ScenePath {
    /// Its name.
    pub name: String,
    /// The drawing, or the file of the program.
    pub file: String,
    /// The position of the program's X0 Y0 in the drawing.
    #[serde(serialize_with = "point")]
    pub zero: Point,
    /// Cutter diameter O.
    pub tool: Option<f64>,
    /// The cutters of a program with several, each from a line on.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub tools: Vec<ToolSpan>,
    /// Upper face T of the material.
    pub thickness: Option<f64>,
    /// Sweep height S.
    pub sweep_height: Option<f64>,
    /// Material M.
    pub material: Option<String>,
    /// Speed of rapid moves in mm/min.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rapid: Option<f64>,
    /// The path itself and everything it embeds, directly or indirectly.
    pub embedded: Vec<EmbeddedPath>,
    /// The elements on the layers of all these paths.
    pub elements: Vec<Element>,
    /// Parameter texts.
    pub texts: Vec<Label>,
    /// Support bars.
    pub bars: Vec<Bar>,
    /// Finished parts that it cuts.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub parts: Vec<FinishedPart>,
    /// Z-probes of the program, in measuring order.
    pub probes: Vec<ProbeMark>,
    /// The moves of the tool, in order. Empty if the path has errors.
    pub moves: Vec<SceneMove>,
    /// Lengths and times.
    pub totals: Option<Totals>,
    /// The G-code as written by `emit`, with LF as line ends. Lines are counted from 1.
    pub gcode: Option<String>,
    /// The file that `emit` writes; `None` if it writes none.
    pub written: Option<String>,
    /// Why `emit` refuses to write a path without errors.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub refusal: Option<BilingualText>,
    /// The native program, if a post writes a different one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub native: Option<NativeText>,
    /// Example values for parameters that nothing else gives and that the program needs.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub examples: Vec<Example>,
}

/// A cutter of a program with several.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ToolSpan {
    /// The line from which it is in the spindle.
    pub line: u32,
    /// Its diameter in mm.
    pub diameter: f64,
    /// The upper face of the material under it; `None` where that of the path applies.
    #[serde(skip)]
    pub surface: Option<f64>,
}

/// The native text of a program.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NativeText {
    /// The text.
    pub gcode: String,
    /// The line for each of [`ScenePath::moves`].
    pub lines: Vec<Option<u32>>,
}

/// An example value that was assumed to build a program for display.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Example {
    /// A letter, or the name of an option.
    pub name: String,
    /// The value; `None` if there is none, in which case everything that depends on it is omitted.
    pub value: Option<String>,
}

/// An embedded path with its place in a program.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct EmbeddedPath {
    /// Its name.
    pub name: String,
    /// Its drawing.
    pub file: String,
    /// The element that embeds it, as an index into [`ScenePath::elements`].
    pub by: Option<u32>,
    /// Its start and end.
    #[serde(serialize_with = "points")]
    pub ends: [Point; 2],
    /// The height in mm that it is raised by.
    pub raised: f64,
    /// Upper face of its material, raised.
    pub thickness: f64,
    /// Sweep height, raised.
    pub sweep_height: f64,
}

/// A drawn element, or a special circle.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Element {
    /// Its path, as an index into [`ScenePath::embedded`].
    pub path: u32,
    /// The kind of element.
    pub kind: ElementKind,
    /// The type of entity in the drawing, for example LINE.
    pub entity: &'static str,
    /// Its layer.
    pub layer: String,
    /// Its handle in the drawing.
    pub handle: Option<String>,
    /// The line of the file at which it begins.
    pub line: Option<u32>,
    /// The shape.
    pub shape: Shape,
    /// Position in cutting order, counted from 1.
    pub order: Option<u32>,
    /// The effective parameters.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub parameters: Vec<Parameter>,
}

/// An effective parameter of an element.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Parameter {
    /// Its letter.
    pub letter: char,
    /// Its value, with variables substituted.
    pub value: String,
    /// Its origin: own, chain, path, lender, option or default.
    pub from: &'static str,
    /// The lending path or the option.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub which: Option<String>,
    /// The line of pathbuild.toml, counted from 1, if the option's value comes from there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub line: Option<u32>,
}

/// The kind of an element.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
#[expect(missing_docs, reason = "the names of the drawing language")]
pub enum ElementKind {
    Mill,
    Mark,
    Support,
    Sweep,
    SkippedSubpath,
    Subpath,
    /// Its line type has no meaning.
    Unclear,
    Start,
    End,
    Turn,
    Probe,
}

/// A shape in the plane. Arcs are kept; renderers flatten them if necessary.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(tag = "type", rename_all = "kebab-case")]
#[expect(missing_docs, reason = "the parts of a shape")]
pub enum Shape {
    Line {
        #[serde(serialize_with = "point")]
        from: Point,
        #[serde(serialize_with = "point")]
        to: Point,
    },
    Arc(ArcShape),
    Circle {
        #[serde(serialize_with = "point")]
        centre: Point,
        #[serde(serialize_with = "millimetres")]
        radius: f64,
    },
}

/// A circular arc.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[expect(missing_docs, reason = "the parts of an arc")]
pub struct ArcShape {
    #[serde(serialize_with = "point")]
    pub from: Point,
    #[serde(serialize_with = "point")]
    pub to: Point,
    #[serde(serialize_with = "point")]
    pub centre: Point,
    #[serde(serialize_with = "millimetres")]
    pub radius: f64,
    pub clockwise: bool,
    /// The angle covered in degrees, greater than 0 and at most 360.
    #[serde(serialize_with = "millimetres")]
    pub degrees: f64,
}

/// A parameter text and its elements.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Label {
    /// Its path, as an index into [`ScenePath::embedded`].
    pub path: u32,
    /// The content.
    pub text: String,
    /// The centre of the circle by which it is matched with elements.
    #[serde(serialize_with = "point")]
    pub at: Point,
    /// The radius of that circle.
    #[serde(serialize_with = "millimetres")]
    pub radius: f64,
    /// The height of a text line in mm.
    #[serde(skip)]
    pub height: f64,
    /// Its elements, as indices into [`ScenePath::elements`].
    pub elements: Vec<u32>,
}

/// A support bar.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Bar {
    /// Its element, as an index into [`ScenePath::elements`].
    pub element: u32,
    /// The path of the cutter's centre over the bar.
    pub shape: Shape,
    /// Z of the top.
    #[serde(serialize_with = "millimetres")]
    pub top: f64,
}

/// A finished part.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FinishedPart {
    /// The outermost ring of its outline, then the openings.
    pub rings: Vec<Vec<Shape>>,
    /// Z of its upper face.
    #[serde(serialize_with = "millimetres")]
    pub top: f64,
    /// How far a cut may miss its outline.
    #[serde(serialize_with = "millimetres")]
    pub tolerance: f64,
    /// Material that the path leaves at its parts.
    pub left: Vec<LeftMaterial>,
    /// For each ring, the index of the opening that it lies in; of one in no other, its own.
    #[serde(skip)]
    pub nests: Vec<usize>,
    /// The stretches of cuts that go into it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub gouges: Vec<Shape>,
    /// The middle lines of support bars that are cut away.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub lost_bars: Vec<Shape>,
    /// Half the diameter of the cutter, by which cuts and bars reach to either side of these lines.
    #[serde(skip)]
    pub radius: f64,
    /// Whether nothing holds it.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub is_loose: bool,
}

/// Material that is left at an outline.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LeftMaterial {
    /// The part of the outline at which it is left.
    pub outline: Vec<Shape>,
    /// How far the material extends from the outline, in mm.
    #[serde(serialize_with = "millimetres")]
    pub reach: f64,
}

/// A point that is measured before milling.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ProbeMark {
    /// The parameter that holds its height: 51 for #51.
    pub number: usize,
    /// The position.
    #[serde(serialize_with = "point")]
    pub at: Point,
    /// The expected height.
    #[serde(serialize_with = "millimetres")]
    pub height: f64,
    /// Probing feed in mm/min.
    pub feed: f64,
    /// The label L.
    pub label: Option<String>,
}

/// Lengths in mm and times in minutes, from the program's statistics.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[expect(missing_docs, reason = "the names say it")]
pub struct Totals {
    #[serde(serialize_with = "millimetres")]
    pub milling: f64,
    #[serde(serialize_with = "millimetres")]
    pub drilling: f64,
    #[serde(serialize_with = "millimetres")]
    pub sweeps: f64,
    /// Estimated working time in whole minutes; `None` if the rapid feed is unknown.
    pub minutes: Option<f64>,
}

/// A shape on a layer without a path.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "type", rename_all = "kebab-case")]
#[expect(missing_docs, reason = "the parts of a shape")]
pub enum OtherShape {
    Shape {
        layer: String,
        shape: Shape,
    },
    Text {
        layer: String,
        text: String,
        /// The centre.
        #[serde(serialize_with = "point")]
        at: Point,
        #[serde(serialize_with = "millimetres")]
        height: f64,
        /// Rotation in degrees, counterclockwise.
        #[serde(serialize_with = "millimetres")]
        rotation: f64,
    },
}

/// A clamp: an outline that the tool must not enter below its height.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct KeepOut {
    /// Its layer.
    pub layer: String,
    /// Its closed outline.
    pub outline: Vec<Shape>,
    /// Its height above the plate.
    #[serde(serialize_with = "millimetres")]
    pub height: f64,
}

/// A finding: an error, a warning or a note.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// The number that marks it in the picture.
    pub number: usize,
    /// The code, for example PB203.
    pub code: String,
    /// Whether it is an error.
    pub is_error: bool,
    /// The message.
    pub message: BilingualText,
    /// The help; may be empty.
    pub help: BilingualText,
    /// Facts that explain it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<BilingualText>,
    /// The file.
    pub file: Option<String>,
    /// The path.
    pub path: Option<String>,
    /// The line in the file.
    pub line: Option<u32>,
    /// The position in the drawing shown. A finding in an embedded path is placed where that is embedded.
    pub at: Option<Point>,
}

/// A sentence in both languages.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
#[expect(missing_docs, reason = "the names say it")]
pub struct BilingualText {
    pub en: String,
    pub de: String,
}

impl Scene {
    /// An empty scene.
    pub fn new(title: &str) -> Self {
        Self {
            schema: SCHEMA,
            version: VERSION,
            title: title.to_owned(),
            through: pathbuild_path::THROUGH,
            paths: Vec::new(),
            other_layers: Vec::new(),
            keep_outs: Vec::new(),
            uncut: Vec::new(),
            findings: Vec::new(),
        }
    }

    /// The scene as JSON on one line. Characters with special effects are escaped in the same way for all clients.
    pub fn to_json(&self) -> String {
        shown::json(&serde_json::to_string(self).expect("every part of a scene is plain data")).into_owned()
    }
}

impl Shape {
    /// The start; for a circle, the centre.
    pub fn start(&self) -> Point {
        match self {
            Self::Line { from, .. } | Self::Arc(ArcShape { from, .. }) => *from,
            Self::Circle { centre, .. } => *centre,
        }
    }

    /// The middle of a curve, or the centre of a circle.
    pub fn middle(&self) -> Point {
        match self {
            Self::Line { from, to } => [0, 1].map(|axis| f64::midpoint(from[axis], to[axis])),
            Self::Arc(arc) => arc.point(0.5),
            Self::Circle { centre, .. } => *centre,
        }
    }

    /// The directions at its start and at its end, of any length; zero for a circle.
    pub(crate) fn directions(&self) -> [Point; 2] {
        match self {
            Self::Line { from, to } => [[to[0] - from[0], to[1] - from[1]]; 2],
            Self::Arc(arc) => [arc.from, arc.to].map(|[x, y]| {
                let sign = if arc.clockwise { -1.0 } else { 1.0 };
                [-sign * (y - arc.centre[1]), sign * (x - arc.centre[0])]
            }),
            Self::Circle { .. } => [[0.0; 2]; 2],
        }
    }

    /// The lower left and upper right corner of the bounding box.
    pub fn extent(&self) -> [Point; 2] {
        match self {
            Self::Line { from, to } => hull(*from, *to),
            Self::Circle { centre: [x, y], radius: r } => [[x - r, y - r], [x + r, y + r]],
            Self::Arc(arc) => arc.extent(),
        }
    }
}

impl ArcShape {
    /// The point at a fraction (0 to 1) of the arc's length.
    pub fn point(&self, share: f64) -> Point {
        let [x, y] = [self.from[0] - self.centre[0], self.from[1] - self.centre[1]];
        let way = if self.clockwise { -self.degrees } else { self.degrees };
        let (sin, cos) = libm::sincos((way * share).to_radians());
        [self.centre[0] + x * cos - y * sin, self.centre[1] + x * sin + y * cos]
    }

    fn extent(&self) -> [Point; 2] {
        let [mut low, mut high] = hull(self.from, self.to);
        let start = libm::atan2(self.from[1] - self.centre[1], self.from[0] - self.centre[0]).to_degrees();
        for (axis, outermost, sign) in [(0, 0.0, 1.0), (1, 90.0, 1.0), (0, 180.0, -1.0), (1, 270.0, -1.0)] {
            let ahead = if self.clockwise { start - outermost } else { outermost - start };
            if ahead - 360.0 * (ahead / 360.0).floor() <= self.degrees {
                let at = self.centre[axis] + sign * self.radius;
                low[axis] = low[axis].min(at);
                high[axis] = high[axis].max(at);
            }
        }
        [low, high]
    }
}

fn hull(a: Point, b: Point) -> [Point; 2] {
    [[a[0].min(b[0]), a[1].min(b[1])], [a[0].max(b[0]), a[1].max(b[1])]]
}

// Moves of the tool.

/// A move of the tool tip.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneMove {
    /// The purpose.
    pub kind: MoveKind,
    /// The geometry: start, end and curve. Arcs and helices are kept.
    pub way: motion::Move,
    /// Its length in mm.
    pub length: f64,
    /// Its element, as an index into [`ScenePath::elements`](crate::scene::ScenePath::elements).
    pub element: Option<u32>,
    /// Its line in the G-code.
    pub line: Option<u32>,
}

/// The purpose of a move.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum MoveKind {
    /// Rapid move in the plane.
    Sweep,
    /// Rapid move straight up or down.
    Lift,
    /// Cut straight down or up.
    Plunge,
    /// Cut along an element.
    Mill,
    /// Cut along an element that is only marked.
    Mark,
    /// Move until the probe triggers.
    Probe,
}

impl SceneMove {
    /// A move about which only its geometry is known.
    pub fn new(way: motion::Move, line: Option<u32>) -> Self {
        Self { kind: MoveKind::of(&way), length: way.length(), way, element: None, line }
    }

    /// Whether its position in the plane is known.
    pub fn is_placed(&self) -> bool {
        self.way.from.known.and(self.way.to.known).has(Axes::XY) && self.way.named.is_none()
    }

    /// The start in the plane.
    pub fn from(&self) -> Point {
        [self.way.from.x(), self.way.from.y()]
    }

    /// The end in the plane.
    pub fn to(&self) -> Point {
        [self.way.to.x(), self.way.to.y()]
    }

    /// Its lowest Z in mm; `None` if the height of neither end is known.
    pub fn depth(&self) -> Option<f64> {
        let ends = [&self.way.from, &self.way.to].into_iter().filter(|end| end.known.has(Axes::Z));
        ends.map(motion::Position::z).reduce(f64::min)
    }

    /// The corners of its bounding box in the plane; `None` if unknown.
    pub fn extent(&self) -> Option<[Point; 2]> {
        let [Some(x), Some(y), _] = self.way.extent() else { return None };
        self.is_placed().then_some([[x.0, y.0], [x.1, y.1]])
    }
}

impl MoveKind {
    fn of(way: &motion::Move) -> Self {
        let is_vertical = way.is_vertical();
        match way.pace {
            Pace::Probe { .. } => Self::Probe,
            Pace::Rapid if is_vertical => Self::Lift,
            Pace::Rapid => Self::Sweep,
            Pace::Feed(_) if is_vertical => Self::Plunge,
            Pace::Feed(_) => Self::Mill,
        }
    }

    /// Whether it removes material.
    pub fn cuts(self) -> bool {
        matches!(self, Self::Plunge | Self::Mill | Self::Mark)
    }
}

/// The JSON form of a move.
#[derive(Serialize)]
struct MoveJson {
    kind: MoveKind,
    from: [Option<f64>; 3],
    to: [Option<f64>; 3],
    #[serde(skip_serializing_if = "Option::is_none")]
    arc: Option<ArcJson>,
    #[serde(skip_serializing_if = "Option::is_none")]
    feed: Option<f64>,
    length: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    element: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    line: Option<u32>,
}

/// The JSON form of an arc: the axes of its plane, its centre on these axes, and the angle it covers.
#[derive(Serialize)]
struct ArcJson {
    axes: [usize; 2],
    centre: [f64; 2],
    clockwise: bool,
    degrees: f64,
}

impl Serialize for SceneMove {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let place = |end: &motion::Position| {
            [0, 1, 2].map(|axis| end.known.has(Axes::of(axis)).then(|| rounded(end.at[axis])))
        };
        let motion::Move { from, to, shape, pace, .. } = &self.way;
        let arc = match shape {
            MoveShape::Line => None,
            MoveShape::Arc(arc) => Some(ArcJson {
                axes: arc.plane.axes(),
                centre: arc.centre.map(rounded),
                clockwise: arc.clockwise,
                degrees: rounded(arc.sweep(from, to).to_degrees()),
            }),
        };
        let written = MoveJson {
            kind: self.kind,
            from: place(from),
            to: place(to),
            arc,
            feed: pace.feed(),
            length: rounded(self.length),
            element: self.element,
            line: self.line,
        };
        written.serialize(serializer)
    }
}

// Numbers in JSON: millimetres rounded to a millionth, so that a scene has the same bytes everywhere.

/// The precision: six decimals.
const MILLIONTHS: f64 = 1e6;

/// Rounds a coordinate or length, and avoids a negative 0.
fn rounded(value: f64) -> f64 {
    (value * MILLIONTHS).round() / MILLIONTHS + 0.0
}

#[cfg_attr(target_pointer_width = "64", expect(clippy::trivially_copy_pass_by_ref, reason = "serde's form"))]
fn millimetres<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_f64(rounded(*value))
}

fn millimetres_each<S: Serializer>(values: &[f64], serializer: S) -> Result<S::Ok, S::Error> {
    let mut list = serializer.serialize_seq(Some(values.len()))?;
    for value in values {
        list.serialize_element(&rounded(*value))?;
    }
    list.end()
}

pub(super) fn point<S: Serializer>(value: &[f64; 2], serializer: S) -> Result<S::Ok, S::Error> {
    millimetres_each(value, serializer)
}

pub(super) fn points<S: Serializer>(values: &[[f64; 2]; 2], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(values.iter().map(|value| value.map(rounded)))
}
