//! The scene: everything visible of paths, drawings and programs, as data.
//!
//! Lengths are in mm. Each path has its own coordinates, which are those of its program; [`ScenePath::zero`] is their origin in the
//! drawing. Everything outside of paths is in the coordinates of the drawing.

use std::sync::Arc;

use pathbuild_diagnostic::{Lang, escaping};
use pathbuild_gcode::verify::Cutter;
use pathbuild_motion as motion;
use pathbuild_motion::{Axes, MoveShape, Pace};
use serde::ser::SerializeSeq;
use serde::{Serialize, Serializer};

pub use crate::extent::Point;
use crate::extent::{Corners, bounding_box, enclosing_box, with_margin};

/// Name of the JSON form of a scene.
pub const SCHEMA: &str = "pathbuild-scene";

/// Version of the JSON form. It is incremented when a reader of the older form would misread the new one.
pub const VERSION: u32 = 1;

/// The visible content of a path, a drawing or a program.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Scene {
    /// Always [`SCHEMA`].
    pub schema: &'static str,
    /// Always [`VERSION`].
    pub version: u32,
    /// Name of the path, drawing or program that is shown.
    pub title: String,
    /// Height in mm above the plate. A cut that goes down to this height or lower goes through the material.
    #[serde(serialize_with = "millimetres")]
    pub through: f64,
    /// The paths shown, or a single program.
    pub paths: Vec<ScenePath>,
    /// Shapes on other layers, shown in grey.
    pub other_layers: Vec<OtherShape>,
    /// Clamps, which the tool must not enter below their height.
    pub keep_outs: Vec<KeepOut>,
    /// Outlines of parts that no path cuts.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub uncut: Vec<Vec<Shape>>,
    /// Findings, numbered from 1.
    pub findings: Vec<Finding>,
    /// Record of how the program was read and checked; `None` for drawings.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub program: Option<ProgramRecord>,
}

/// A record of how a program of any origin was read and checked.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ProgramRecord {
    /// Name of the dialect in which the program was read.
    pub dialect: &'static str,
    /// The dialects in which the program can be read again; empty on a page that cannot read it again.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub dialects: Vec<&'static str>,
    /// The dialect in which the program was read and, if it was guessed, the reason.
    pub read_as: BilingualText,
    /// The checks of `verify`, made or not.
    pub checks: Vec<ShownCheck>,
    /// The cutters that the program itself states.
    pub cutters: Vec<ToolSpan>,
    /// Z in mm of the material's upper face; `None` if it is unknown or not level.
    pub surface: Option<f64>,
    /// Whether the material lies on Z 0, so that cuts down to Z 0 go through it. Otherwise its thickness is unknown.
    pub is_on_zero: bool,
    /// Description of dwells, stops and tool changes, which the totals do not include; `None` if there are none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub waits: Option<BilingualText>,
}

/// A check of `verify`, with the values that it used or the reason why it was not made.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ShownCheck {
    /// Name of the check, as for `--require`.
    pub check: &'static str,
    /// `made`, `assumed` or `not-made`.
    pub outcome: &'static str,
    /// Description of the check.
    pub text: BilingualText,
}

/// A path of a drawing with its program, if it has one; or a program that was read.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ScenePath {
    /// Name of the path or program.
    pub name: String,
    /// Display name of the drawing, or of the program's file.
    pub file: String,
    /// Position in the drawing of the program's X0 Y0.
    #[serde(serialize_with = "point")]
    pub zero: Point,
    /// Cutter diameter O in mm.
    pub tool: Option<f64>,
    /// Shape of the tip of that cutter.
    #[serde(skip_serializing_if = "Tip::is_flat")]
    pub tip: Tip,
    /// Cutters of a program that was read, if it uses several or its material is known; otherwise empty.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub tools: Vec<ToolSpan>,
    /// Z in mm of the upper face of the material (T).
    pub thickness: Option<f64>,
    /// Sweep height S in mm.
    pub sweep_height: Option<f64>,
    /// Material (M), as named in the drawing.
    pub material: Option<String>,
    /// Speed of rapid moves in mm/min.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rapid: Option<f64>,
    /// The path itself, and all paths that it embeds directly or indirectly.
    pub embedded: Vec<EmbeddedPath>,
    /// Elements on the layers of the embedded paths.
    pub elements: Vec<Element>,
    /// Parameter texts of the embedded paths.
    pub texts: Vec<Label>,
    /// Support bars of the embedded paths.
    pub bars: Vec<Bar>,
    /// Finished parts that the path cuts.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub parts: Vec<FinishedPart>,
    /// Z-probes of the program, in measuring order.
    pub probes: Vec<ProbeMark>,
    /// The tool's moves, in order. Empty if the path has errors, unless all of them are about cuts into a part or through a support bar.
    pub moves: Vec<SceneMove>,
    /// Lengths and times of the program; `None` if the path has no program.
    pub totals: Option<Totals>,
    /// The G-code whose lines the moves refer to, with LF as line ends: the text that `emit` writes, the native text if there is no other, or the
    /// program that was read.
    pub gcode: Option<String>,
    /// Path of the file that `emit` writes; `None` if it writes none.
    pub written: Option<String>,
    /// Reason why `emit` refuses to write the program although the path has no errors.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub refusal: Option<BilingualText>,
    /// Native text of the program, if a post writes a different one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub native: Option<NativeText>,
    /// Example values assumed for parameters that the program needs but that have no value.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub examples: Vec<Example>,
}

/// A part of a program during which one cutter is used.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ToolSpan {
    /// Line from which the cutter is in the spindle.
    pub line: u32,
    /// Position in the order of execution from which the cutter is in the spindle.
    #[serde(skip)]
    pub order: u32,
    /// Diameter of the cutter in mm.
    pub diameter: f64,
    /// Shape of the cutter's tip.
    #[serde(skip_serializing_if = "Tip::is_flat")]
    pub tip: Tip,
    /// Z in mm of the upper face of the material under this cutter; `None` if that of the path applies.
    #[serde(skip)]
    pub surface: Option<f64>,
}

/// The shape of a cutter's tip.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Tip {
    /// The cutter is flat over its whole diameter.
    #[default]
    Flat,
    /// A ball or bull nose: the corners are rounded with this radius in mm.
    Round(#[serde(serialize_with = "millimetres")] f64),
    /// The shape is unknown, as that of a V-bit or a drill.
    Unknown,
}

impl ScenePath {
    /// Returns the diameter in mm and the tip of the cutter of a move.
    pub(crate) fn cutter(&self, movement: &SceneMove) -> Option<(f64, Tip)> {
        let own = self.tool.map(|diameter| (diameter, self.tip));
        self.tool_span(movement).map(|tool| (tool.diameter, tool.tip)).or(own)
    }

    /// Returns the lowest Z at each element, reached by moves of these kinds.
    pub(crate) fn depths(&self, is_such: impl Fn(MoveKind) -> bool) -> Vec<Option<f64>> {
        let mut depths: Vec<Option<f64>> = vec![None; self.elements.len()];
        for movement in self.moves.iter().filter(|movement| is_such(movement.kind)) {
            if let Some(depth) = movement.element.and_then(|element| depths.get_mut(element as usize)) {
                *depth = (*depth).into_iter().chain(movement.depth()).reduce(f64::min);
            }
        }
        depths
    }

    /// Returns the entry of [`tools`](Self::tools) for a move.
    pub(crate) fn tool_span(&self, movement: &SceneMove) -> Option<&ToolSpan> {
        self.tools.get(movement.tool? as usize)
    }
}

impl Tip {
    /// Whether the cutter is flat over its whole diameter.
    pub fn is_flat(&self) -> bool {
        *self == Self::Flat
    }
}

impl From<Cutter> for Tip {
    fn from(cutter: Cutter) -> Self {
        match cutter.corner_radius {
            None => Self::Unknown,
            Some(radius) if radius > 0.0 => Self::Round(radius),
            Some(_) => Self::Flat,
        }
    }
}

/// The native text of a program.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NativeText {
    /// G-code of the program, with LF as line ends.
    pub gcode: String,
    /// Line of each move of [`ScenePath::moves`] in this text.
    pub lines: Vec<Option<u32>>,
}

/// An example value, assumed in order to build a program for display.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Example {
    /// Letter of the parameter, or name of the option.
    pub name: String,
    /// The value; `None` if no example exists, in which case everything that depends on it is omitted.
    pub value: Option<String>,
}

/// A path with its place in a program: the outermost path, or an embedded one.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct EmbeddedPath {
    /// Name of the path.
    pub name: String,
    /// Display name of the path's drawing.
    pub file: String,
    /// Element that embeds the path, as an index into [`ScenePath::elements`]; `None` for the outermost path.
    pub by: Option<u32>,
    /// Start and end of the path.
    #[serde(serialize_with = "points")]
    pub ends: [Point; 2],
    /// Height in mm by which the path is raised.
    pub raised: f64,
    /// Z in mm of the upper face of the path's material, raised by [`raised`](EmbeddedPath::raised).
    pub thickness: f64,
    /// Sweep height in mm, raised by [`raised`](EmbeddedPath::raised).
    pub sweep_height: f64,
    /// Name of the path's material (M), for setup sheets.
    #[serde(skip)]
    pub material: Option<String>,
}

/// A drawn element, a marker or a probe.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Element {
    /// Path that the element belongs to, as an index into [`ScenePath::embedded`].
    pub path: u32,
    /// Kind of the element.
    pub kind: ElementKind,
    /// The type of entity in the drawing, for example LINE.
    pub entity: &'static str,
    /// Layer of the element in the drawing.
    pub layer: String,
    /// Handle of the entity in the drawing.
    pub handle: Option<String>,
    /// Line of the drawing's file at which the entity begins, counted from 1.
    pub line: Option<u32>,
    /// Geometry of the element in the plane.
    pub shape: Shape,
    /// Position in cutting order, counted from 1.
    pub order: Option<u32>,
    /// Effective parameters of the element. Consecutive elements that have the same parameters share this list.
    #[serde(skip_serializing_if = "has_none", serialize_with = "serialize_shared_slice")]
    pub parameters: Arc<[Parameter]>,
}

/// An effective parameter of an element.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Parameter {
    /// Letter of the parameter.
    pub letter: char,
    /// Value of the parameter, with variables substituted.
    pub value: String,
    /// Source of the value: own, chain, path, lender, option or default.
    pub from: &'static str,
    /// Name of the lending path or of the option that supplies the value.
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
    /// An element with a line type that has no meaning.
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

/// A parameter text with the elements that it belongs to.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Label {
    /// Path that the text belongs to, as an index into [`ScenePath::embedded`].
    pub path: u32,
    /// Content of the text.
    pub text: String,
    /// Centre of the circle by which the text is matched with elements.
    #[serde(serialize_with = "point")]
    pub at: Point,
    /// Radius in mm of the circle by which the text is matched with elements.
    #[serde(serialize_with = "millimetres")]
    pub radius: f64,
    /// Height of a line of the text in mm.
    #[serde(skip)]
    pub height: f64,
    /// Elements that the text belongs to, as indices into [`ScenePath::elements`].
    pub elements: Vec<u32>,
}

/// A support bar, which remains standing under the cutter.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Bar {
    /// Element that has the bar, as an index into [`ScenePath::elements`].
    pub element: u32,
    /// Path of the cutter's centre over the bar.
    pub shape: Shape,
    /// Z in mm of the top of the bar.
    #[serde(serialize_with = "millimetres")]
    pub top: f64,
}

/// A finished part that a path cuts out, with its defects.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FinishedPart {
    /// Outermost ring of the outline, followed by the rings of the openings.
    pub rings: Vec<Vec<Shape>>,
    /// Z in mm of the upper face of the part.
    #[serde(serialize_with = "millimetres")]
    pub top: f64,
    /// Distance in mm by which a cut may miss the outline.
    #[serde(serialize_with = "millimetres")]
    pub tolerance: f64,
    /// Material that the path leaves at the outline.
    pub left: Vec<LeftoverMaterial>,
    /// For each ring, the index of the outermost opening that contains it, or its own index if none does.
    #[serde(skip)]
    pub nests: Vec<usize>,
    /// Inner corners that the cutter does not reach.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub corners: Vec<Corner>,
    /// Pieces of cuts that go into the part.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub gouges: Vec<Shape>,
    /// Centre lines of support bars that are cut away.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub lost_bars: Vec<Shape>,
    /// Half the diameter in mm of the cutter: how far cuts and bars extend on either side of their lines.
    #[serde(skip)]
    pub radius: f64,
    /// Whether nothing holds the part once it is cut.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub is_loose: bool,
}

/// An inner corner of a part's outline that the cutter does not reach.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Corner {
    /// Position of the corner.
    #[serde(serialize_with = "point")]
    pub at: Point,
    /// Distance in mm from the corner at which the cutter touches both of its sides.
    #[serde(serialize_with = "millimetres")]
    pub reach: f64,
}

/// Material that the cutter leaves at an outline although it should be removed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LeftoverMaterial {
    /// Part of the outline at which the material is left.
    pub outline: Vec<Shape>,
    /// Maximum distance in mm of the material from the outline.
    #[serde(serialize_with = "millimetres")]
    pub reach: f64,
}

/// A point that is measured before milling.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ProbeMark {
    /// Number of the control's parameter that stores the measured height: 51 for #51.
    pub number: usize,
    /// Position of the probe in the plane.
    #[serde(serialize_with = "point")]
    pub at: Point,
    /// Expected height in mm.
    #[serde(serialize_with = "millimetres")]
    pub height: f64,
    /// Probing feed in mm/min.
    pub feed: f64,
    /// Label of the probe (L).
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
        /// Centre of the text.
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
    /// Layer of the clamp in the drawing.
    pub layer: String,
    /// Outline of the clamp, which is closed.
    pub outline: Vec<Shape>,
    /// Height of the clamp above the plate in mm.
    #[serde(serialize_with = "millimetres")]
    pub height: f64,
}

/// A finding: an error, a warning or a note.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// Number that marks the finding in the picture, from 1.
    pub number: usize,
    /// Code of the message, for example PB203.
    pub code: String,
    /// Whether the finding is an error, not a warning or a note.
    pub is_error: bool,
    /// Message in both languages.
    pub message: BilingualText,
    /// Help in both languages; may be empty.
    pub help: BilingualText,
    /// Notes that explain the finding.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<BilingualText>,
    /// Display name of the file that the finding is about.
    pub file: Option<String>,
    /// Name of the path that the finding is about.
    pub path: Option<String>,
    /// Line in the file, counted from 1.
    pub line: Option<u32>,
    /// Position in the drawing shown. A finding in an embedded path is placed where that path is embedded.
    pub at: Option<Point>,
}

/// A sentence in both languages.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
#[expect(missing_docs, reason = "the names say it")]
pub struct BilingualText {
    pub en: String,
    pub de: String,
}

impl BilingualText {
    /// Asks for a text in each language.
    pub fn of(text: impl Fn(Lang) -> String) -> Self {
        Self { en: text(Lang::En), de: text(Lang::De) }
    }
}

impl Scene {
    /// Creates an empty scene.
    pub fn new(title: &str) -> Self {
        Self {
            schema: SCHEMA,
            version: VERSION,
            title: title.to_owned(),
            through: pathbuild_path::THROUGH_HEIGHT,
            paths: Vec::new(),
            other_layers: Vec::new(),
            keep_outs: Vec::new(),
            uncut: Vec::new(),
            findings: Vec::new(),
            program: None,
        }
    }

    /// Returns the places of the findings, as boxes without extent.
    pub(crate) fn finding_places(&self) -> impl Iterator<Item = Corners> {
        self.findings.iter().filter_map(|finding| finding.at).map(|at| [at; 2])
    }

    /// Returns the scene as JSON on one line. Characters with special effects, such as control characters, are escaped.
    pub fn to_json(&self) -> String {
        escaping::json(&serde_json::to_string(self).expect("every part of a scene is plain data"))
            .into_owned()
    }
}

impl KeepOut {
    /// Returns the bounding box of the outline; `None` without an outline.
    pub(crate) fn extent(&self) -> Option<Corners> {
        bounding_box(self.outline.iter().map(Shape::extent))
    }
}

impl Shape {
    /// Returns the start of a curve, or the centre of a circle.
    pub fn start(&self) -> Point {
        match self {
            Self::Line { from, .. } | Self::Arc(ArcShape { from, .. }) => *from,
            Self::Circle { centre, .. } => *centre,
        }
    }

    /// Returns the end of a curve, or the centre of a circle.
    pub fn end(&self) -> Point {
        match self {
            Self::Line { to, .. } | Self::Arc(ArcShape { to, .. }) => *to,
            Self::Circle { centre, .. } => *centre,
        }
    }

    /// Returns the middle of a curve, or the centre of a circle.
    pub fn middle(&self) -> Point {
        match self {
            Self::Line { from, to } => [0, 1].map(|axis| f64::midpoint(from[axis], to[axis])),
            Self::Arc(arc) => arc.point(0.5),
            Self::Circle { centre, .. } => *centre,
        }
    }

    /// Returns the directions at the start and at the end, as vectors of any length; zero for a circle.
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

    /// Returns the lower left and upper right corner of the bounding box.
    pub fn extent(&self) -> Corners {
        match self {
            Self::Line { from, to } => enclosing_box([*from; 2], [*to; 2]),
            Self::Circle { centre, radius } => with_margin([*centre; 2], *radius),
            Self::Arc(arc) => arc.extent(),
        }
    }
}

impl ArcShape {
    /// Returns the point at a fraction (0 to 1) of the arc's length.
    pub fn point(&self, share: f64) -> Point {
        let [x, y] = [self.from[0] - self.centre[0], self.from[1] - self.centre[1]];
        let way = if self.clockwise { -self.degrees } else { self.degrees };
        let (sin, cos) = libm::sincos((way * share).to_radians());
        [self.centre[0] + x * cos - y * sin, self.centre[1] + x * sin + y * cos]
    }

    fn extent(&self) -> Corners {
        let [mut low, mut high] = enclosing_box([self.from; 2], [self.to; 2]);
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

/// A move of the tool tip.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneMove {
    /// Purpose of the move.
    pub kind: MoveKind,
    /// Geometry of the move: start, end and curve. Arcs and helices are not flattened.
    pub way: motion::Move,
    /// Length of the move in mm; 0 if the statistics do not count it.
    pub length: f64,
    /// Element from which the move comes, as an index into [`ScenePath::elements`](crate::scene::ScenePath::elements).
    pub element: Option<u32>,
    /// Line of the move in the G-code, counted from 1.
    pub line: Option<u32>,
    /// Cutter of the move, as an index into [`ScenePath::tools`](crate::scene::ScenePath::tools).
    pub tool: Option<u32>,
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
    /// Creates a move of which only the geometry is known.
    pub fn new(way: motion::Move, line: Option<u32>) -> Self {
        Self { kind: MoveKind::of(&way), length: way.length(), way, element: None, line, tool: None }
    }

    /// Whether both ends are known in the plane, and the program does not name the target (G28, G30, G53).
    pub fn is_placed(&self) -> bool {
        self.way.from.known.and(self.way.to.known).has(Axes::XY) && self.way.named.is_none()
    }

    /// Returns the start in the plane.
    pub fn from(&self) -> Point {
        [self.way.from.x(), self.way.from.y()]
    }

    /// Returns the end in the plane.
    pub fn to(&self) -> Point {
        [self.way.to.x(), self.way.to.y()]
    }

    /// Returns the lowest Z in mm, which may lie between the ends of an arc in a vertical plane; `None` if the height of neither end is known.
    pub fn depth(&self) -> Option<f64> {
        let [.., z] = self.way.extent();
        z.map(|(low, _)| low)
    }

    /// Returns the corners of the bounding box in the plane; `None` if the position is unknown.
    pub fn extent(&self) -> Option<Corners> {
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

    /// Whether a move of this kind removes material.
    pub fn cuts(self) -> bool {
        matches!(self, Self::Plunge | Self::Mill | Self::Mark)
    }
}

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
    #[serde(skip_serializing_if = "Option::is_none")]
    tool: Option<u32>,
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
        // A probing move ends wherever the probe makes contact.
        let is_reached = |axis: usize| {
            !matches!(pace, Pace::Probe { .. })
                || from.known.has(Axes::of(axis)) && from.at[axis] == to.at[axis]
        };
        let mut end = place(to);
        (0..3).filter(|axis| !is_reached(*axis)).for_each(|axis| end[axis] = None);
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
            to: end,
            arc,
            feed: pace.feed(),
            length: rounded(self.length),
            element: self.element,
            line: self.line,
            tool: self.tool,
        };
        written.serialize(serializer)
    }
}

/// Precision of numbers in JSON, in units per mm: numbers have six decimals, so that a scene has the same bytes everywhere.
const UNITS_PER_MM: f64 = 1e6;

/// Rounds a coordinate or length, and avoids a negative 0.
fn rounded(value: f64) -> f64 {
    (value * UNITS_PER_MM).round() / UNITS_PER_MM + 0.0
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

fn has_none(parameters: &Arc<[Parameter]>) -> bool {
    parameters.is_empty()
}

fn serialize_shared_slice<S: Serializer>(
    parameters: &Arc<[Parameter]>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(parameters.iter())
}
