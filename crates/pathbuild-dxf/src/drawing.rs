use std::sync;

use pathbuild_diagnostic::{Diagnostic, EntityKind, Handle, Place, Point};
use smol_str::SmolStr;

/// Options of the reader.
pub struct Options<'a> {
    /// Decides by a layer's name (trimmed, xref prefix dropped, `\U+` decoded) whether its entities are wanted. Numbers of entities on other layers
    /// are not parsed, so that errors in them are not reported.
    pub keep_layer: &'a dyn Fn(&str) -> bool,
    /// A test for the undecoded bytes of each TEXT, or last part of an MTEXT, on an unwanted layer, and of each label on any layer. If one passes,
    /// [`Drawing::has_noted_text`] is set.
    pub note_text: Option<TextTest<'a>>,
    /// The treatment of $INSUNITS.
    pub units: Units,
    /// Tolerance in mm for approximating ELLIPSE and SPLINE by arcs; 0 leaves them out with PB111.
    pub approximate_curves: f64,
    /// Maximum number of entities, after expanding blocks. More are an error (PB005).
    pub max_entities: usize,
    /// Maximum length of a text in bytes. A longer text is an error (PB005).
    pub max_text: usize,
    /// Whether to read as PathDxf2GCode does: only LINE, ARC, CIRCLE, TEXT and MTEXT outside of blocks. Anything else on a wanted layer is then left
    /// out with one warning per drawing, no MTEXT has a width, and the formatting and blanks of texts have no effect on their places.
    pub compatible: bool,
}

/// A predicate on the bytes of a text.
pub type TextTest<'a> = &'a dyn Fn(&[u8]) -> bool;

/// The treatment of $INSUNITS, which states the unit of a drawing. (book: reference/configuration, `units`)
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Units {
    /// Millimetres (4), none (0) and a missing value are accepted; PB113 for all others.
    #[default]
    Header,
    /// Lengths are converted from the unit of the header to millimetres.
    Drawing,
    /// The header is ignored, and all numbers are taken as millimetres.
    Millimetres,
}

/// The wanted content of a drawing. `entities[i]` starts in the file at `origins[i]`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drawing {
    /// The wanted entities of model space in file order.
    pub entities: Vec<Entity>,
    /// The place of each entity in the file.
    pub origins: Vec<Origin>,
    /// The layers with wanted entities, faults or left-out curves, in order of first use.
    pub layers: Vec<Layer>,
    /// Broken entities on wanted layers.
    pub faults: Vec<Fault>,
    /// Unsupported curves and insertions on wanted layers (PB111).
    pub left_out: Vec<OmittedCurve>,
    /// The places of the hatches on wanted layers, which draw nothing themselves. The point of a place is on the hatch's boundary, or is the centre
    /// of one of the boundary's arcs.
    pub hatches: Vec<Place>,
    /// The texts of multileaders and dimensions in model space on wanted layers.
    pub labels: Vec<Label>,
    /// Findings about the file, and warnings that are given only once per layer, block or drawing. If one of them is an error, there are no
    /// entities.
    pub diagnostics: Vec<Diagnostic>,
    /// Whether a text on an unwanted layer, or a label, satisfied [`Options::note_text`]. If the drawing has insertions, the texts of all blocks are
    /// tested.
    pub has_noted_text: bool,
}

impl Drawing {
    pub(crate) fn clear(&mut self) {
        self.entities.clear();
        self.origins.clear();
        self.layers.clear();
        self.faults.clear();
        self.left_out.clear();
        self.hatches.clear();
        self.labels.clear();
        self.diagnostics.clear();
        self.has_noted_text = false;
    }
}

/// A layer with wanted entities, faults or left-out curves.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Layer {
    /// The name as first spelt by an entity: trimmed, decoded, without xref prefix.
    pub name: Box<str>,
    /// Whether the layer is frozen or off (PB112 when a path is on it).
    pub hidden: bool,
}

/// The place of an entity in the file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Origin {
    /// 1-based line of the group code `0`. In binary files, twice the number of the pair minus one.
    pub line: u32,
    /// The handle, if any. Parts of a polyline or block have the handle of the whole.
    pub handle: Option<Handle>,
}

/// A broken entity on a wanted layer (PB002, or PB110 for a tilted extrusion).
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// Index into [`Drawing::layers`].
    pub layer: u32,
    /// The finding, with line and handle.
    pub diagnostic: Diagnostic,
}

/// An unsupported curve on a wanted layer, or an insertion whose block is missing, clipped, scaled differently in x and y, or drawn only on other
/// layers.
#[derive(Clone, Debug, PartialEq)]
pub struct OmittedCurve {
    /// Index into [`Drawing::layers`].
    pub layer: u32,
    /// Type of the entity that was left out.
    pub kind: EntityKind,
    /// First point of the entity, if known.
    pub point: Option<Point>,
    /// If the entity inserts a block that draws only on unwanted layers, the names of those layers; otherwise empty. A caller that
    /// reads one of them for another purpose, for example as clamps, need not report the insertion.
    pub layers: sync::Arc<[SmolStr]>,
    /// PB111, with line and handle.
    pub diagnostic: Diagnostic,
}

/// The text of a multileader or dimension, which gives no parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    /// Index into [`Drawing::layers`].
    pub layer: u32,
    /// The text without its formatting; `%%c` and similar codes are not replaced yet.
    pub text: SmolStr,
    /// The tip of a multileader's arrow, with half the height of the text as radius. The radius is 0 for a dimension, which points at nothing.
    pub tip: Circle,
    /// The place of the multileader or dimension.
    pub place: Place,
}

/// An entity that the drawing language knows.
#[derive(Clone, Debug, PartialEq)]
pub struct Entity {
    /// Index into [`Drawing::layers`].
    pub layer: u32,
    /// The line type, trimmed, without xref prefix, in upper case. BYLAYER or none is replaced by the layer's, BYBLOCK in model space by
    /// CONTINUOUS.
    pub line_type: SmolStr,
    /// The entity type in the file. A part of a polyline has the type of the polyline.
    pub kind: EntityKind,
    /// Number shared by all parts of one polyline or approximated curve: a text that overlaps one part belongs to all of them.
    pub group: Option<u32>,
    /// Whether the entity is in a block that is inserted mirrored.
    pub is_mirrored: bool,
    /// The shape, in world coordinates.
    pub geometry: Geometry,
}

/// A point in world coordinates, in mm. If `z` is not 0 on the layer of a path, the path reports PB110.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[expect(missing_docs, reason = "coordinates")]
pub struct Point3 {
    pub x: f64,
    pub y: f64,
    pub z: f64,
}

/// The shape of an entity.
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
    /// Centre in world coordinates.
    pub centre: Point3,
    /// Radius in mm, positive.
    pub radius: f64,
    /// Start angle in degrees, in world coordinates. It may lie outside of 0 to 360.
    pub start_angle: f64,
    /// End angle in degrees, which may be smaller than the start angle.
    pub end_angle: f64,
    /// Whether the arc runs clockwise from start to end, as mirrored arcs and negative bulges do.
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
    /// The decoded string; `%%c` and similar codes are not replaced yet.
    pub string: SmolStr,
    /// The alignment point: 10/20 if the groups 72 and 73 are 0, the middle of 10/20 and 11/21 if group 72 is 3 or 5, else 11/21.
    pub anchor: Point3,
    /// Height in mm.
    pub height: f64,
    /// Rotation in degrees, counterclockwise.
    pub rotation: f64,
    /// Horizontal alignment from group 72; aligned, middle and fitted texts (3 to 5) are centred.
    pub horizontal: HorizontalAlign,
    /// Vertical alignment from group 73, except for middle texts (group 72 is 4).
    pub vertical: VerticalAlign,
    /// Whether the text is mirrored in x, so that letters run from right to left (71 bit 2, or extrusion 0,0,-1; both together cancel out).
    pub backwards: bool,
    /// Whether the text is mirrored in y, so that it is upside down (71 bit 4).
    pub upside_down: bool,
    /// Whether blanks at the ends and all letters of `%%` codes count for the size, as they do for PathDxf2GCode.
    pub counts_invisible: bool,
}

/// A text of several lines.
#[derive(Clone, Debug, PartialEq)]
pub struct MText {
    /// The text without its formatting, with line breaks as `\n`; `%%c` and similar codes are not replaced yet. (book: reference/dxf)
    pub plain: SmolStr,
    /// Insertion point.
    pub anchor: Point3,
    /// Height of the letters in mm: that of the first letter if `\H` changes it, else that of group 40.
    pub height: f64,
    /// Width in mm (group 41) at which the CAD program breaks lines, if it does.
    pub width: Option<f64>,
    /// Rotation in degrees, from group 50 or the direction 11/21.
    pub rotation: f64,
    /// Horizontal position of the anchor (group code 71).
    pub horizontal: HorizontalAlign,
    /// Vertical position of the anchor (group code 71).
    pub vertical: VerticalAlign,
    /// Alignment of the paragraphs within the width: that of group 71, unless `\p` changes it.
    pub paragraphs: HorizontalAlign,
    /// Formatting that makes the places of the letters unknown, if there is any.
    pub obstacle: Option<LayoutObstacle>,
    /// Whether blanks at the ends of rows and all letters of `%%` codes count for the size, as they do for PathDxf2GCode.
    pub counts_invisible: bool,
}

/// Formatting of an MTEXT that moves letters by an unknown distance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LayoutObstacle {
    /// Paragraphs in a width that are aligned differently, or distributed over it.
    Alignment,
    /// Columns, or a column break.
    Columns,
    /// Empty rows at the end of a text that is not attached at its top.
    EmptyRows,
    /// Letters with heights that differ by more than 1 %.
    Heights,
    /// An indented paragraph.
    Indent,
    /// Stacked characters.
    Stack,
    /// A tab before letters.
    Tab,
}

/// Horizontal position of the anchor in a text.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum HorizontalAlign {
    #[default]
    Left,
    Centre,
    Right,
}

/// Vertical position of the anchor in a text.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum VerticalAlign {
    #[default]
    Baseline,
    Bottom,
    Middle,
    Top,
}
