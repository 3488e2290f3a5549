//! The data model of drawings.

use std::fmt;

use pathbuild_diagnostic::Handle;
use pathbuild_draw::pairs::Record;

pub use pathbuild_draw::geometry::{Arc, Circle, Line, Point};

/// A group code with its value, as in the file.
pub type Pair = pathbuild_draw::pairs::Pair<'static>;

/// An entity of a drawing: a shape, its attributes, and its parameter text.
#[derive(Clone, Debug, PartialEq)]
pub struct Entity {
    /// The shape, in world coordinates.
    pub shape: Shape,
    /// The layer; `None` for the draft's current one.
    pub layer: Option<String>,
    /// The name of the line type; `None` for BYLAYER, which is not written.
    pub line_type: Option<String>,
    /// A text that `Draft::finish` positions so that it belongs to this entity.
    pub note: Option<Note>,
    /// The plane that the shape lies in.
    pub orientation: Orientation,
    /// Whether the entity is in paper space.
    pub paper: bool,
    /// Whether the entity is hidden (group 60).
    pub invisible: bool,
    /// AutoCAD colour number (group 62).
    pub colour: Option<u8>,
    /// The text style of TEXT and MTEXT.
    pub style: Option<String>,
    /// An explicit handle; `None` for the next free one.
    pub handle: Option<Handle>,
    /// Changes to the written pairs, for tests with malformed entities.
    pub changes: Vec<Change>,
    /// The line of the text form that draws the entity; 0 if there is none.
    pub line: u32,
}

/// The normal of the plane that an entity lies in.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Orientation {
    /// (0, 0, 1), the default, which is not written.
    #[default]
    Upright,
    /// (0, 0, -1), as CAD programs leave it after mirroring. The shape is given in world coordinates; the writer converts it to object
    /// coordinates.
    Mirrored,
    /// Any other normal. The shape's coordinates are written unchanged.
    Tilted(Point),
}

/// A parameter text next to its element.
#[derive(Clone, Debug, PartialEq)]
pub struct Note {
    /// The string as it appears in the file; MTEXT interprets formatting codes.
    pub value: String,
    /// The kind of entity to write; `None` for the sheet's default.
    pub kind: Option<NoteKind>,
    /// Letter height in mm; `None` for the sheet's default, reduced if there is no room.
    pub height: Option<f64>,
}

/// The kinds of text entities.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[expect(missing_docs, reason = "the DXF names say it")]
pub enum NoteKind {
    Text,
    #[default]
    MText,
}

/// A change to the pairs of an entity.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Change {
    /// Sets the first pair of this code, or appends the pair.
    Set(Pair),
    /// Removes all pairs of this code.
    Unset(i32),
}

impl Entity {
    /// Creates an entity with this shape on the current layer. Curves have line type CONTINUOUS, all other shapes BYLAYER.
    pub fn new(shape: Shape) -> Self {
        let line_type = match shape {
            Shape::Insert(_)
            | Shape::Text(_)
            | Shape::MText(_)
            | Shape::Raw(_)
            | Shape::Solid(_)
            | Shape::Dimension(_) => None,
            _ => Some("CONTINUOUS".to_owned()),
        };
        Self {
            shape,
            layer: None,
            line_type,
            note: None,
            orientation: Orientation::Upright,
            paper: false,
            invisible: false,
            colour: None,
            style: None,
            handle: None,
            changes: Vec::new(),
            line: 0,
        }
    }

    /// Creates a straight line with line type CONTINUOUS.
    pub fn line(from: impl Into<Point>, to: impl Into<Point>) -> Self {
        Self::new(Shape::Line(Line { from: from.into(), to: to.into() }))
    }

    /// Creates an arc with line type CONTINUOUS, counterclockwise from `start` to `end` in degrees.
    pub fn arc(centre: impl Into<Point>, radius: f64, start: f64, end: f64) -> Self {
        Self::new(Shape::Arc(Arc { centre: centre.into(), radius, start, end }))
    }

    /// Creates a circle with line type CONTINUOUS from its diameter in mm.
    pub fn circle(centre: impl Into<Point>, diameter: f64) -> Self {
        Self::new(Shape::Circle(Circle { centre: centre.into(), radius: diameter / 2.0 }))
    }

    /// Creates a start marker: a PHANTOM circle 1 mm in diameter.
    pub fn start(at: impl Into<Point>) -> Self {
        Self::circle(at, 1.0).with_line_type("PHANTOM")
    }

    /// Creates an end marker: a PHANTOM circle 2 mm in diameter.
    pub fn end(at: impl Into<Point>) -> Self {
        Self::circle(at, 2.0).with_line_type("PHANTOM")
    }

    /// Creates a turn marker: a PHANTOM circle 1.5 mm in diameter.
    pub fn turn(at: impl Into<Point>) -> Self {
        Self::circle(at, 1.5).with_line_type("PHANTOM")
    }

    /// Creates a Z-probe: a PHANTOM circle 6 mm in diameter.
    pub fn probe(at: impl Into<Point>) -> Self {
        Self::circle(at, 6.0).with_line_type("PHANTOM")
    }

    /// Sets the line type.
    pub fn with_line_type(mut self, line_type: &str) -> Self {
        self.line_type = Some(line_type.to_owned());
        self
    }

    /// Sets the layer.
    pub fn on_layer(mut self, layer: &str) -> Self {
        self.layer = Some(layer.to_owned());
        self
    }

    /// Adds a parameter text, unless it is empty.
    pub fn note(mut self, value: &str) -> Self {
        self.note = (!value.is_empty()).then(|| Note { value: value.to_owned(), kind: None, height: None });
        self
    }
}

/// A record of the layer table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Layer {
    /// Name of the layer, in the spelling of the drawing.
    pub name: String,
    /// The line type of BYLAYER entities.
    pub line_type: String,
    /// AutoCAD colour number (group 62).
    pub colour: u8,
    /// Unusual states of the layer.
    pub states: Vec<LayerState>,
}

/// An unusual state of a layer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LayerState {
    /// The layer is switched off.
    Off,
    /// The layer is frozen.
    Frozen,
    /// The layer is locked.
    Locked,
    /// The layer is used by entities, but missing from the layer table.
    Unlisted,
}

impl Layer {
    /// Creates a visible white layer with line type CONTINUOUS.
    pub fn new(name: &str) -> Self {
        Self { name: name.to_owned(), line_type: "CONTINUOUS".to_owned(), colour: 7, states: Vec::new() }
    }

    /// Whether the layer is in this state.
    pub fn is(&self, state: LayerState) -> bool {
        self.states.contains(&state)
    }
}

/// Options for writing a sheet.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// The DXF version, written as $ACADVER.
    pub version: Version,
    /// $DWGCODEPAGE, which is also the encoding of texts before R2007 with [`TextEncoding::Proper`]. `None` omits the variable; such texts are then
    /// encoded as `ANSI_1252`.
    pub code_page: Option<String>,
    /// The encoding of texts.
    pub encoding: TextEncoding,
    /// $INSUNITS; `None` omits the variable.
    pub units: Option<i16>,
    /// The line ends of ASCII DXF.
    pub line_ends: LineEnds,
    /// Whether to write binary DXF.
    pub binary: bool,
    /// Whether to start with a byte order mark.
    pub byte_order_mark: bool,
    /// Parts of the file to omit.
    pub left_out: Vec<Part>,
    /// Header variables to add or override.
    pub header: Vec<(String, Pair)>,
    /// The type of entity as which notes are written.
    pub note_kind: NoteKind,
    /// Letter height of notes in mm, if there is room.
    pub note_height: f64,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            version: Version::default(),
            code_page: Some("ANSI_1252".to_owned()),
            encoding: TextEncoding::default(),
            units: Some(4),
            line_ends: LineEnds::default(),
            binary: false,
            byte_order_mark: false,
            left_out: Vec::new(),
            header: Vec::new(),
            note_kind: NoteKind::default(),
            note_height: 2.0,
        }
    }
}

/// The supported versions of DXF.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
#[expect(missing_docs, reason = "the names say it")]
pub enum Version {
    R10,
    R12,
    R13,
    R14,
    #[default]
    R2000,
    R2004,
    R2007,
    R2010,
    R2013,
    R2018,
}

impl Version {
    /// All versions, oldest first.
    pub const ALL: [Self; 10] = [
        Self::R10,
        Self::R12,
        Self::R13,
        Self::R14,
        Self::R2000,
        Self::R2004,
        Self::R2007,
        Self::R2010,
        Self::R2013,
        Self::R2018,
    ];

    /// The usual name, for example `R2000`.
    pub fn name(self) -> &'static str {
        match self {
            Self::R10 => "R10",
            Self::R12 => "R12",
            Self::R13 => "R13",
            Self::R14 => "R14",
            Self::R2000 => "R2000",
            Self::R2004 => "R2004",
            Self::R2007 => "R2007",
            Self::R2010 => "R2010",
            Self::R2013 => "R2013",
            Self::R2018 => "R2018",
        }
    }
}

/// The encoding of names and texts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TextEncoding {
    /// As the version demands: UTF-8 from R2007 on, and before that the code page, with `\U+XXXX` for missing characters.
    #[default]
    Proper,
    /// UTF-8 regardless of the version, as careless scripts do.
    Utf8,
    /// `\U+XXXX` for everything outside ASCII, as QCAD does.
    Escaped,
}

/// The line ends of ASCII DXF.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum LineEnds {
    #[default]
    CrLf,
    Lf,
    Cr,
}

/// Parts of a DXF file that simple writers omit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the DXF names say it")]
pub enum Part {
    Header,
    Tables,
    Blocks,
    Objects,
    Handles,
    /// The final pair 0/EOF.
    Eof,
}

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

/// A polyline of lines and arcs.
#[derive(Clone, Debug, PartialEq)]
pub struct Polyline {
    /// The DXF entity to write.
    pub kind: PolylineKind,
    /// The vertices, in order.
    pub vertices: Vec<Vertex>,
    /// Whether the last vertex is connected to the first.
    pub closed: bool,
}

/// A vertex of a polyline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// Position of the vertex.
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
    /// The end of the major axis, relative to the centre.
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
    /// The control points; none if the spline is defined by fit points.
    pub control: Vec<Point>,
    /// The knots: as many as control points + degree + 1.
    pub knots: Vec<f64>,
    /// The weights: one for each control point, or none.
    pub weights: Vec<f64>,
    /// Fit points, through which the curve passes.
    pub fit: Vec<Point>,
    /// Whether the flag for closed splines is set.
    pub closed: bool,
}

/// A block reference.
#[derive(Clone, Debug, PartialEq)]
pub struct Insert {
    /// Name of the block that is inserted.
    pub block: String,
    /// The position of the block's base point.
    pub at: Point,
    /// Scale factors in x, y and z.
    pub scale: Point,
    /// Rotation in degrees, counterclockwise.
    pub rotation: f64,
    /// Numbers of columns and rows.
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
    /// The text of the label.
    pub label: String,
    /// The centre of the label.
    pub text: Point,
    /// Name of the block with the visible parts.
    pub block: String,
}

impl Polyline {
    /// Returns the segments, each with its start, its end and its bulge.
    pub fn pieces(&self) -> impl Iterator<Item = (Point, Point, f64)> + '_ {
        let next = self.vertices.iter().skip(1).chain(self.vertices.first().filter(|_| self.closed));
        self.vertices.iter().zip(next).map(|(a, b)| (a.point, b.point, a.bulge))
    }
}

/// Returns the arc of a segment with this bulge; `None` if the segment is straight or has no length.
pub fn arc_of_bulge(from: Point, to: Point, bulge: f64) -> Option<Arc> {
    let chord = from.distance(to);
    if bulge == 0.0 || chord == 0.0 {
        return None;
    }
    let radius = chord * (1.0 + bulge * bulge) / (4.0 * bulge.abs());
    // From the midpoint of the chord to the centre, positive to the left of the chord.
    let offset = chord * (1.0 - bulge * bulge) / (4.0 * bulge);
    let unit = (to - from) * (1.0 / chord);
    let middle = (from + to) * 0.5;
    let centre = Point::new(middle.x - unit.y * offset, middle.y + unit.x * offset).at_height(from.z);
    let (start, end) = if bulge > 0.0 { (from, to) } else { (to, from) };
    Some(Arc { centre, radius, start: centre.direction(start), end: centre.direction(end) })
}

/// A single-line text.
#[derive(Clone, Debug, PartialEq)]
pub struct Text {
    /// The string as it appears in the file.
    pub value: String,
    /// The alignment point; the left one of the two for aligned and fitted texts.
    pub anchor: Point,
    /// Letter height in mm.
    pub height: f64,
    /// Rotation in degrees, counterclockwise.
    pub rotation: f64,
    /// Horizontal alignment (group 72).
    pub horizontal: Horizontal,
    /// Vertical alignment (group 73).
    pub vertical: Vertical,
    /// Whether the text is mirrored horizontally (group 71, bit 2).
    pub backwards: bool,
    /// Whether the text is upside down (group 71, bit 4).
    pub upside_down: bool,
}

/// Horizontal alignment of a TEXT (group 72).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Horizontal {
    /// 0: the anchor is at the left end.
    #[default]
    Left,
    /// 1: the anchor is in the middle.
    Centre,
    /// 2: the anchor is at the right end.
    Right,
    /// 3: the text fits between the anchor and this point, and its height follows its width.
    Aligned(Point),
    /// 4: centred in both directions.
    Middle,
    /// 5: the text fits between the anchor and this point, with a fixed height.
    Fit(Point),
}

/// Vertical alignment of a TEXT (group 73).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum Vertical {
    #[default]
    Baseline,
    Bottom,
    Middle,
    Top,
}

/// A multi-line text.
#[derive(Clone, Debug, PartialEq)]
pub struct MText {
    /// The string with its formatting codes, as in the file.
    pub value: String,
    /// Insertion point.
    pub anchor: Point,
    /// Letter height in mm.
    pub height: f64,
    /// The point of the text that lies at the anchor.
    pub attachment: Attachment,
    /// The rotation, as an angle or a vector.
    pub direction: Direction,
    /// Maximum length in characters of a chunk: longer texts are split, and all chunks but the last are in groups 3. `None` for 250, as in CAD
    /// programs.
    pub chunk: Option<usize>,
    /// Width of the box (group 41); 0 for no limit.
    pub width: f64,
}

/// The point of an MTEXT that lies at its anchor (group 71): 1 to 9, row by row from the upper left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum Attachment {
    TopLeft,
    TopCentre,
    TopRight,
    MiddleLeft,
    MiddleCentre,
    MiddleRight,
    BottomLeft,
    BottomCentre,
    BottomRight,
}

/// The direction of an MTEXT, as it is written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Direction {
    /// A rotation in degrees (group 50).
    Rotation(f64),
    /// A vector in the text's direction (groups 11, 21 and 31).
    Vector(Point),
}

impl Direction {
    /// Returns the rotation in degrees, whichever form is used.
    pub fn degrees(self) -> f64 {
        match self {
            Self::Rotation(degrees) => degrees,
            Self::Vector(vector) => Point::default().direction(vector),
        }
    }
}

impl Attachment {
    /// The value of group 71.
    pub fn number(self) -> i16 {
        self as i16 + 1
    }

    /// Returns the attachment in a row (0 top to 2 bottom) and a column (0 left to 2 right).
    pub fn from_row_column(row: usize, column: usize) -> Self {
        use Attachment::{
            BottomCentre, BottomLeft, BottomRight, MiddleCentre, MiddleLeft, MiddleRight, TopCentre, TopLeft,
            TopRight,
        };
        [
            [TopLeft, TopCentre, TopRight],
            [MiddleLeft, MiddleCentre, MiddleRight],
            [BottomLeft, BottomCentre, BottomRight],
        ][row.min(2)][column.min(2)]
    }
}

/// A block definition.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// Name of the block, by which inserts refer to it.
    pub name: String,
    /// The block's base point.
    pub base: Point,
    /// The block's entities.
    pub entities: Vec<Entity>,
}

/// The surroundings of a drawing, as written by the crate `dxf`, without handles: created once and shared by many drawings.
#[derive(Clone, Debug, PartialEq)]
pub struct Template {
    pub(crate) tables: Vec<Record<'static>>,
    pub(crate) blocks: Vec<Record<'static>>,
    pub(crate) early: Vec<Record<'static>>,
    pub(crate) late: Vec<Record<'static>>,
}

/// An error in a drawing in text form.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DrawError {
    /// The line, counted from 1; 0 if the drawing was not read from a text.
    pub line: u32,
    /// The column in characters, counted from 1; 0 for errors that concern the whole line.
    pub column: u32,
    /// Description of the mistake and of what was expected, in one sentence.
    pub message: String,
}

impl DrawError {
    /// Creates an error at a place.
    pub fn new(line: u32, column: u32, message: impl Into<String>) -> Self {
        Self { line, column, message: message.into() }
    }
}

impl fmt::Display for DrawError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.line, self.column) {
            (0, _) => write!(f, "{}", self.message),
            (line, 0) => write!(f, "line {line}: {}", self.message),
            (line, column) => write!(f, "line {line}, column {column}: {}", self.message),
        }
    }
}

impl std::error::Error for DrawError {}
