use pathbuild_diagnostic::{Diagnostic, EntityKind, Handle, Point};
use smol_str::SmolStr;

/// What the reader is told.
pub struct Options<'a> {
    /// Whether entities on the layer of this name (trimmed, xref prefix dropped, `\U+` decoded) are wanted. Numbers of all others are not
    /// even parsed, so they can not be wrong.
    pub keep_layer: &'a dyn Fn(&str) -> bool,
    /// What to do with $INSUNITS.
    pub units: Units,
    /// Tolerance in mm within which ELLIPSE and SPLINE become arcs; 0: they are left out with PB111.
    pub approximate_curves: f64,
    /// Most entities (after expansion of blocks) that are read before PB005.
    pub max_entities: usize,
    /// Longest text in bytes before PB005.
    pub max_text: usize,
    /// As PathDxf2GCode reads: only LINE, ARC, CIRCLE, TEXT and MTEXT count, and nothing in blocks (what else is drawn on wanted layers is
    /// left out with one warning a drawing), and no MTEXT has a width.
    pub compatible: bool,
}

/// What $INSUNITS means. (book: reference/configuration, `units`)
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Units {
    /// Millimetres (4), none (0) or missing are fine, else PB113.
    #[default]
    Header,
    /// Converted to millimetres.
    Drawing,
    /// The header is not believed: everything is millimetres.
    Millimetres,
}

/// What was read. `entities[i]` began at `origins[i]`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drawing {
    /// The wanted entities of model space in file order.
    pub entities: Vec<Entity>,
    /// Where each entity is in the file.
    pub origins: Vec<Origin>,
    /// The layers that hold wanted entities (or faults, or left-out curves), in order of first use.
    pub layers: Vec<Layer>,
    /// Broken wanted entities: faults of their layer's path.
    pub faults: Vec<Fault>,
    /// Curves on wanted layers that are not understood (PB111).
    pub left_out: Vec<LeftOut>,
    /// What concerns the file as a whole. When one of them is an error there are no entities.
    pub diagnostics: Vec<Diagnostic>,
}

impl Drawing {
    /// Nothing is in it any more.
    pub(crate) fn clear(&mut self) {
        self.entities.clear();
        self.origins.clear();
        self.layers.clear();
        self.faults.clear();
        self.left_out.clear();
        self.diagnostics.clear();
    }
}

/// A layer as the entities on it see it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Layer {
    /// The name as first spelt on an entity: trimmed, decoded, without xref prefix.
    pub name: Box<str>,
    /// Frozen or off (PB112 when a path is on it).
    pub hidden: bool,
}

/// Where an entity begins in the file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Origin {
    /// 1-based line of the `0` group code; in binary files the number of the pair times two, less one.
    pub line: u32,
    /// Its handle, if it has one. Parts of a polyline or block share those of the whole.
    pub handle: Option<Handle>,
}

/// A broken entity on a wanted layer (PB002, PB110 for a tilted extrusion).
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// Index into [`Drawing::layers`].
    pub layer: u32,
    /// With the line and handle filled in.
    pub diagnostic: Diagnostic,
}

/// A curve that is no part of the path.
#[derive(Clone, Debug, PartialEq)]
pub struct LeftOut {
    /// Index into [`Drawing::layers`].
    pub layer: u32,
    /// What it is.
    pub kind: EntityKind,
    /// Where it begins, as far as that is known.
    pub point: Option<Point>,
    /// PB111, with the line and handle filled in.
    pub diagnostic: Diagnostic,
}

/// An entity that the drawing language knows.
#[derive(Clone, Debug, PartialEq)]
pub struct Entity {
    /// Index into [`Drawing::layers`].
    pub layer: u32,
    /// The line type: its own, or its layer's where it says BYLAYER or nothing; CONTINUOUS for BYBLOCK in model space. Trimmed, without
    /// xref prefix, upper case.
    pub line_type: SmolStr,
    /// The entity in the file that it comes from: LINE, or LWPOLYLINE for a part of one.
    pub kind: EntityKind,
    /// Parts of the same polyline (or approximated curve) have the same number: a text that overlaps one of them belongs to all.
    pub group: Option<u32>,
    /// The shape.
    pub geometry: Geometry,
}

/// A point in world coordinates, in mm. A path element whose z is not 0 is PB110, which is for the path to say.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[expect(missing_docs, reason = "coordinates")]
pub struct Point3 {
    pub x: f64,
    pub y: f64,
    pub z: f64,
}

/// The shapes.
#[derive(Clone, Debug, PartialEq)]
#[expect(missing_docs, reason = "the DXF names say it")]
pub enum Geometry {
    Line(Line),
    Arc(Arc),
    Circle(Circle),
    Text(Text),
    MText(MText),
}

/// A straight line.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "its ends")]
pub struct Line {
    pub start: Point3,
    pub end: Point3,
}

/// A circular arc, drawn from its start to its end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc {
    /// Centre.
    pub centre: Point3,
    /// Radius, > 0.
    pub radius: f64,
    /// Angle of the start, in degrees as in the file (mirrored where the entity is).
    pub start_angle: f64,
    /// Angle of the end.
    pub end_angle: f64,
    /// Whether it runs clockwise from start to end: so for mirrored arcs and negative bulges, else counterclockwise.
    pub clockwise: bool,
}

/// A full circle.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "a circle's parts")]
pub struct Circle {
    pub centre: Point3,
    pub radius: f64,
}

/// A one-line text.
#[derive(Clone, Debug, PartialEq)]
pub struct Text {
    /// The string: decoded, `%%c` and the like not yet replaced.
    pub string: SmolStr,
    /// The point that the alignment is relative to: 11/21 where 72 or 73 say so, the middle of 10/20 and 11/21 for 72 = 3 and 5.
    pub anchor: Point3,
    /// Height in mm.
    pub height: f64,
    /// Rotation in degrees, counterclockwise.
    pub rotation: f64,
    /// From 72 and 73; 72 = 4 is centre, middle; aligned and fitted texts are centre, baseline.
    pub horizontal: HorizontalAlign,
    /// From 73.
    pub vertical: VerticalAlign,
    /// Mirrored in x: its letters run from right to left (71 bit 2, or extrusion 0,0,-1; both cancel each other).
    pub backwards: bool,
    /// Mirrored in y: upside down (71 bit 4).
    pub upside_down: bool,
}

/// A text of several lines.
#[derive(Clone, Debug, PartialEq)]
pub struct MText {
    /// Plain text as `docs/en/src/reference/dxf.md` defines it: line breaks as `\n`, `%%c` and the like not yet replaced.
    pub plain: SmolStr,
    /// Insertion point.
    pub anchor: Point3,
    /// Height of a line's letters in mm.
    pub height: f64,
    /// Width in mm (41) in which the CAD breaks lines that are longer; none where it does not.
    pub width: Option<f64>,
    /// Rotation in degrees, from 50 or the direction 11/21.
    pub rotation: f64,
    /// From 71.
    pub horizontal: HorizontalAlign,
    /// From 71.
    pub vertical: VerticalAlign,
}

/// Where the anchor is in a text, from left to right.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum HorizontalAlign {
    #[default]
    Left,
    Centre,
    Right,
}

/// Where the anchor is in a text, from bottom to top.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum VerticalAlign {
    #[default]
    Baseline,
    Bottom,
    Middle,
    Top,
}
