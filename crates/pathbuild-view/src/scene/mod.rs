//! The scene: what there is to see, as data.
//!
//! Lengths are mm. Each path has coordinates of its own, those of its program; [`ScenePath::zero`] says where their zero lies in the
//! drawing. What belongs to no path is in the drawing's coordinates.

mod json;
mod moves;

use pathbuild_diagnostic::shown;
use serde::Serialize;

use json::{millimetres, point, points};
pub use moves::{Move, MoveKind};

/// The name of the JSON form.
pub const SCHEMA: &str = "pathbuild-scene";

/// The version of the JSON form: it grows when a reader of the older form would misread the newer.
pub const VERSION: u32 = 1;

/// A place in the plane: x, y.
pub type Point = [f64; 2];

/// Everything that there is to see of a path, a drawing or a program.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Scene {
    /// [`SCHEMA`].
    pub schema: &'static str,
    /// [`VERSION`].
    pub version: u32,
    /// What is shown: a path's name, a drawing, a program.
    pub title: String,
    /// The paths, or the one program.
    pub paths: Vec<ScenePath>,
    /// What else is drawn, in grey.
    pub other_layers: Vec<OtherShape>,
    /// Clamps, which the tool must not enter below their height.
    pub keep_outs: Vec<KeepOut>,
    /// What is wrong, numbered from 1.
    pub findings: Vec<Finding>,
}

/// A path of a drawing with its program, where it has one; or a program that was read.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ScenePath {
    /// Its name.
    pub name: String,
    /// The drawing, or the program's file.
    pub file: String,
    /// Where the program's X0 Y0 lies in the drawing.
    #[serde(serialize_with = "point")]
    pub zero: Point,
    /// Cutter diameter O.
    pub tool: Option<f64>,
    /// Upper face T of the material.
    pub thickness: Option<f64>,
    /// Sweep height S.
    pub sweep_height: Option<f64>,
    /// M.
    pub material: Option<String>,
    /// The path itself and all that it embeds, wherever it lies.
    pub embedded: Vec<Embedded>,
    /// What is drawn on the layers of all these paths.
    pub elements: Vec<Element>,
    /// Parameter texts.
    pub texts: Vec<Label>,
    /// Support bars.
    pub bars: Vec<Bar>,
    /// Z-probes of the program in the order in which they are measured.
    pub probes: Vec<ProbeMark>,
    /// What the tool does, in order. Empty where the path has errors.
    pub moves: Vec<Move>,
    /// Lengths and times.
    pub totals: Option<Totals>,
    /// The G-code as `emit` writes it, with LF at the ends of lines, which are counted from 1.
    pub gcode: Option<String>,
    /// The file that `emit` writes it to; `None` where it writes none.
    pub written: Option<String>,
    /// Why `emit` refuses to write a path without errors.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub refusal: Option<Said>,
    /// The native program, where a post writes another one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub native: Option<NativeText>,
    /// Values without which there would be no program, and that nothing gives.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub examples: Vec<Example>,
}

/// The native text of a program.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NativeText {
    /// Its text.
    pub gcode: String,
    /// The line of each of [`ScenePath::moves`].
    pub lines: Vec<Option<u32>>,
}

/// A value that a program was made with only to be shown.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Example {
    /// A letter, or the name of an option.
    pub name: String,
    /// The value; `None` where there is none either, and what depends on it is not shown.
    pub value: Option<String>,
}

/// A path where it lies in a program.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Embedded {
    /// Its name.
    pub name: String,
    /// Its drawing.
    pub file: String,
    /// The element that embeds it: index into [`ScenePath::elements`].
    pub by: Option<u32>,
    /// Where it starts and ends.
    #[serde(serialize_with = "points")]
    pub ends: [Point; 2],
    /// What it is raised by.
    pub raised: f64,
    /// Upper face of its material, raised.
    pub thickness: f64,
    /// Sweep height, raised.
    pub sweep_height: f64,
}

/// A drawn element, or a special circle.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Element {
    /// The path that it belongs to: index into [`ScenePath::embedded`].
    pub path: u32,
    /// What it means.
    pub kind: ElementKind,
    /// Its type in the drawing: LINE.
    pub entity: &'static str,
    /// Its layer.
    pub layer: String,
    /// Its handle in the drawing.
    pub handle: Option<String>,
    /// Where it begins in the file.
    pub line: Option<u32>,
    /// Where it lies.
    pub shape: Shape,
    /// The how manieth it is that the tool cuts, from 1.
    pub order: Option<u32>,
    /// The parameters that hold for it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub parameters: Vec<Parameter>,
}

/// A parameter that holds for an element.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Parameter {
    /// Its letter.
    pub letter: char,
    /// Its value, with variables put in.
    pub value: String,
    /// Where it comes from: own, chain, path, lender, option, default.
    pub from: &'static str,
    /// Which path lends it, or which option gives it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub which: Option<String>,
}

/// What an element means.
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
    Start,
    End,
    Turn,
    Probe,
}

/// A shape in the plane. Arcs stay arcs; those who draw flatten them.
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
    Arc(Arc),
    Circle {
        #[serde(serialize_with = "point")]
        centre: Point,
        #[serde(serialize_with = "millimetres")]
        radius: f64,
    },
}

/// A circular arc from one end to the other.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[expect(missing_docs, reason = "the parts of an arc")]
pub struct Arc {
    #[serde(serialize_with = "point")]
    pub from: Point,
    #[serde(serialize_with = "point")]
    pub to: Point,
    #[serde(serialize_with = "point")]
    pub centre: Point,
    #[serde(serialize_with = "millimetres")]
    pub radius: f64,
    pub clockwise: bool,
    /// How far it goes round, in degrees, above 0 up to 360.
    #[serde(serialize_with = "millimetres")]
    pub degrees: f64,
}

/// A parameter text and what it belongs to.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Label {
    /// The path that it belongs to: index into [`ScenePath::embedded`].
    pub path: u32,
    /// What it says.
    pub text: String,
    /// The centre of the circle by which it finds its element.
    #[serde(serialize_with = "point")]
    pub at: Point,
    /// The radius of that circle.
    #[serde(serialize_with = "millimetres")]
    pub radius: f64,
    /// The elements that have it: indices into [`ScenePath::elements`].
    pub elements: Vec<u32>,
}

/// A support bar.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Bar {
    /// The element that it is left along.
    pub element: u32,
    /// The way of the cutter's centre over it.
    pub shape: Shape,
    /// Z of its top.
    #[serde(serialize_with = "millimetres")]
    pub top: f64,
}

/// A point whose height is measured before milling.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ProbeMark {
    /// The parameter that holds its height: 51 for #51.
    pub number: usize,
    /// Where.
    #[serde(serialize_with = "point")]
    pub at: Point,
    /// The height that is expected.
    #[serde(serialize_with = "millimetres")]
    pub height: f64,
    /// Probing feed in mm/min.
    pub feed: f64,
    /// L.
    pub label: Option<String>,
}

/// Lengths in mm and times in minutes, as the program's statistics have them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[expect(missing_docs, reason = "the names say it")]
pub struct Totals {
    #[serde(serialize_with = "millimetres")]
    pub milling: f64,
    #[serde(serialize_with = "millimetres")]
    pub drilling: f64,
    #[serde(serialize_with = "millimetres")]
    pub sweeps: f64,
    /// Whole minutes that a person has to reckon with; `None` where the rapid feed is not known.
    pub minutes: Option<f64>,
}

/// What is drawn on a layer that is no path layer.
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
        /// The middle.
        #[serde(serialize_with = "point")]
        at: Point,
        #[serde(serialize_with = "millimetres")]
        height: f64,
        /// In degrees, counterclockwise.
        #[serde(serialize_with = "millimetres")]
        rotation: f64,
    },
}

/// A clamp: an outline that the tool must not enter below its height.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct KeepOut {
    /// Its layer.
    pub layer: String,
    /// Its outline, closed.
    pub outline: Vec<Shape>,
    /// Its height above the plate.
    #[serde(serialize_with = "millimetres")]
    pub height: f64,
}

/// Something that is wrong, or doubtful.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// The number by which it stands in the picture.
    pub number: usize,
    /// PB203.
    pub code: String,
    /// Whether it is an error; else a warning or a note.
    pub is_error: bool,
    /// What is wrong.
    pub message: Said,
    /// What to do about it; may be empty.
    pub help: Said,
    /// The file that it is in.
    pub file: Option<String>,
    /// The path that it is in.
    pub path: Option<String>,
    /// Its line in the file.
    pub line: Option<u32>,
    /// Where it is in the drawing that is shown; of what is wrong in an embedded path, where that is embedded.
    pub at: Option<Point>,
}

/// A sentence in both languages.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
#[expect(missing_docs, reason = "the names say it")]
pub struct Said {
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
            paths: Vec::new(),
            other_layers: Vec::new(),
            keep_outs: Vec::new(),
            findings: Vec::new(),
        }
    }

    /// The scene in JSON, on one line, with characters that act escaped: the same for every one who shows it.
    pub fn to_json(&self) -> String {
        shown::json(&serde_json::to_string(self).expect("every part of a scene is plain data")).into_owned()
    }
}

impl Shape {
    /// Where it begins; of a circle its centre.
    pub fn start(&self) -> Point {
        match self {
            Self::Line { from, .. } | Self::Arc(Arc { from, .. }) => *from,
            Self::Circle { centre, .. } => *centre,
        }
    }

    /// Its lowest and its highest corner.
    pub fn extent(&self) -> [Point; 2] {
        match self {
            Self::Line { from, to } => hull(*from, *to),
            Self::Circle { centre: [x, y], radius: r } => [[x - r, y - r], [x + r, y + r]],
            Self::Arc(arc) => arc.extent(),
        }
    }
}

impl Arc {
    /// The point after that share (0 to 1) of the way.
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
