//! The elements of a path: their shapes and their meanings. (book: language/line-types, book: language/markers)

use pathbuild_diagnostic::{Diagnostic, ElementId, EntityKind, Point, Text, words};
use rstar::AABB;
use smol_str::SmolStr;

use crate::approx::at_least;
use crate::boxes::{square, widened_box};
use crate::geometry::{Curve, Xy};
use crate::letter::{ElementClass, Letter};
use crate::line_type::LineType;
use crate::text::TextId;

/// A line, arc or circle on a path's layer that represents a part of the path.
#[derive(Clone, Debug, PartialEq)]
pub struct Element {
    /// The entity in the file that draws the element.
    pub source: Source,
    /// The shape as drawn.
    pub shape: Shape,
    /// The element's meaning in the drawing language.
    pub role: Role,
    /// The element's parameter text, see [`DrawnElements::texts`](crate::DrawnElements::texts).
    pub text: Option<TextId>,
}

/// Identifies an entity of the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Source {
    /// Number of the entity in the path's source map.
    pub id: ElementId,
    /// Type of the entity.
    pub entity: EntityKind,
    /// Layer of the entity, as an index into [`DrawnElements::layers`](crate::DrawnElements::layers).
    pub layer: u32,
}

/// A circle that marks the start, the end, a turn or a Z-probe.
#[derive(Clone, Debug, PartialEq)]
#[expect(missing_docs, reason = "as in Element")]
pub struct Marker {
    pub origin: Origin,
    pub at: Xy,
    pub text: Option<TextId>,
}

/// The location of an element, for diagnostics.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Origin {
    /// Number of the element in the path's source map.
    pub id: ElementId,
    /// Type of the element's entity in the file.
    pub entity: EntityKind,
    /// Name of the element's layer.
    pub layer: SmolStr,
    /// The start of a line or arc, or the centre of a circle.
    pub point: Point,
}

/// The shape of an element: a line, an arc or a circle.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "a circle's parts")]
pub enum Shape {
    Curve(Curve),
    Circle { centre: Xy, radius: f64 },
}

/// The meaning of an element, by its line type.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Role {
    /// A cut: milled, marked, or milled with bars. On a circle: a hole or a helical circle.
    Cut(Cut),
    /// DASHED: a sweep.
    Sweep,
    /// HIDDEN: a sweep without a text.
    SilentSweep,
    /// DOT: a disabled subpath, traversed as a sweep. It keeps its text, which is ignored, so that it can be enabled again.
    SkippedSubpath,
    /// DASHDOT: a subpath.
    Subpath,
}

/// The kind of a cut, which determines its depth.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Cut {
    /// Cuts down to B.
    Mill,
    /// Cuts down to D.
    Mark,
    /// Cuts down to B and leaves bars up to D.
    Support,
}

/// The meaning of a circle, by its line type and diameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum CircleMeaning {
    Start,
    Turn,
    End,
    Probe,
    IgnoredProbe,
    Cut(Cut),
    UnknownDiameter,
    UnknownLineType,
}

/// The marker that a meaningless circle was probably meant to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum IntendedMarker {
    Start,
    End,
    Other,
}

impl Origin {
    /// Creates the location of an entity that starts, or has its centre, at a point.
    pub(crate) fn new(source: Source, layer: &SmolStr, point: Xy) -> Self {
        let Source { id, entity, .. } = source;
        Self { id, entity, layer: layer.clone(), point: diagnostic_point(point) }
    }

    /// Places a diagnostic at this element.
    pub fn at(&self, diagnostic: Diagnostic) -> Diagnostic {
        diagnostic.at_element(self.id, self.entity, &self.layer, self.point)
    }
}

impl Shape {
    /// Returns the radius of a circle in mm; `None` for lines and arcs.
    pub(crate) fn radius(&self) -> Option<f64> {
        match self {
            Self::Circle { radius, .. } => Some(*radius),
            Self::Curve(_) => None,
        }
    }

    /// The start of a line or arc, or the centre of a circle.
    pub fn point(&self) -> Xy {
        match self {
            Self::Curve(curve) => curve.start(),
            Self::Circle { centre, .. } => *centre,
        }
    }

    /// Returns the bounding box, for an arc that of the whole circle, with its sides moved outwards by `margin` mm.
    pub fn extent(&self, margin: f64) -> AABB<[f64; 2]> {
        match self {
            Self::Curve(curve) => widened_box(curve, margin),
            Self::Circle { centre, radius } => square(*centre, radius + margin),
        }
    }

    /// Returns the name of the shape in messages.
    pub fn word(&self) -> &'static Text {
        match self {
            Self::Curve(Curve::Line(_)) => &words::LINE,
            Self::Curve(Curve::Arc(_)) => &words::ARC,
            Self::Circle { .. } => &words::CIRCLE,
        }
    }
}

impl Element {
    /// Returns the element's class for the table of letters, with a cutter of diameter `tool`.
    pub fn class(&self, tool: Option<f64>) -> ElementClass {
        match (self.role, self.shape) {
            (Role::Cut(cut), Shape::Circle { radius, .. }) => circle_class(cut, radius, tool),
            (Role::Cut(Cut::Mill), _) => ElementClass::Mill,
            (Role::Cut(Cut::Mark), _) => ElementClass::Mark,
            (Role::Cut(Cut::Support), _) => ElementClass::Support,
            (Role::Sweep, _) => ElementClass::Sweep,
            (Role::SilentSweep | Role::SkippedSubpath, _) => ElementClass::Unread,
            (Role::Subpath, _) => ElementClass::Subpath,
        }
    }
}

impl Cut {
    /// Returns the letter that gives the cut's depth.
    pub(crate) fn depth(self) -> Letter {
        match self {
            Self::Mill | Self::Support => Letter::B,
            Self::Mark => Letter::D,
        }
    }
}

impl ElementClass {
    /// Returns the name of elements of this class in messages.
    pub fn word(self) -> &'static Text {
        match self {
            Self::PathStart => &words::PATH_START,
            Self::Mill => &words::MILLING_SEGMENT,
            Self::Mark => &words::MARKING_SEGMENT,
            Self::Support => &words::SUPPORT_SEGMENT,
            Self::Sweep => &words::SWEEP,
            Self::DrilledHole => &words::DRILLED_HOLE,
            Self::DrilledMark => &words::DRILLED_MARK,
            Self::HelicalCircle => &words::HELICAL_CIRCLE,
            Self::HelicalMark => &words::HELICAL_MARK,
            Self::HelicalSupport => &words::HELICAL_SUPPORT,
            Self::UnknownCircle => &words::CIRCLE,
            Self::Subpath => &words::SUBPATH,
            Self::Probe => &words::PROBE,
            Self::Unread => &words::ELEMENT,
        }
    }
}

/// Largest difference in mm between diameters that count as equal, of circles, cutters and markers: numbers with three decimals do not show a smaller
/// one.
const DIAMETER_TOLERANCE: f64 = 0.001;

/// Whether a circle of this radius in mm has the same diameter as one of another radius.
pub fn has_diameter_of(radius: f64, other: f64) -> bool {
    at_least(DIAMETER_TOLERANCE, 2.0 * (radius - other).abs())
}

/// Units in which drawings are made by mistake, each with its length in mm.
const OTHER_UNITS: [(&Text, f64); 3] =
    [(&words::INCHES, 25.4), (&words::CENTIMETRES, 10.0), (&words::METRES, 1000.0)];

/// Share by which a marker that is drawn in another unit may differ from the exact diameter, because files may give few decimals.
const UNIT_TOLERANCE: f64 = 0.01;

/// A PHANTOM circle that would be a marker if the drawing's lengths were in another unit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MarkerInOtherUnit {
    /// The name of the unit.
    pub(crate) unit: &'static Text,
    /// The length of the unit in mm.
    pub(crate) factor: f64,
    /// The radius of the marker in mm.
    pub(crate) radius: f64,
}

impl MarkerInOtherUnit {
    /// Returns the marker that a circle of this radius would be in another unit.
    pub(crate) fn of_radius(drawn: f64) -> Option<Self> {
        OTHER_UNITS.into_iter().find_map(|(unit, factor)| {
            let markers = [START_RADIUS, TURN_RADIUS, END_RADIUS, PROBE_RADIUS];
            let is_drawn = |radius: &f64| (drawn * factor / radius - 1.0).abs() < UNIT_TOLERANCE;
            Some(Self { unit, factor, radius: markers.into_iter().find(is_drawn)? })
        })
    }
}

/// Returns the class of a circle. One with the cutter's diameter is drilled, whatever its line type.
fn circle_class(cut: Cut, radius: f64, tool: Option<f64>) -> ElementClass {
    let Some(tool) = tool else { return ElementClass::UnknownCircle };
    if has_diameter_of(radius, tool / 2.0) {
        if cut == Cut::Mark { ElementClass::DrilledMark } else { ElementClass::DrilledHole }
    } else if radius < tool / 2.0 {
        ElementClass::UnknownCircle
    } else {
        match cut {
            Cut::Mill => ElementClass::HelicalCircle,
            Cut::Mark => ElementClass::HelicalMark,
            Cut::Support => ElementClass::HelicalSupport,
        }
    }
}

/// Returns the meaning of a line or arc with this line type; `None` if it has none.
pub(crate) fn curve_role(line_type: LineType) -> Option<Role> {
    Some(match line_type {
        LineType::Continuous => Role::Cut(Cut::Mill),
        LineType::Divide => Role::Cut(Cut::Mark),
        LineType::Border | LineType::Center => Role::Cut(Cut::Support),
        LineType::Dashed => Role::Sweep,
        LineType::Hidden => Role::SilentSweep,
        LineType::Dot => Role::SkippedSubpath,
        LineType::Dashdot => Role::Subpath,
        LineType::Phantom => return None,
    })
}

/// Radius in mm of the circle at which a path starts. (book: language/markers)
pub const START_RADIUS: f64 = 0.5;
/// Radius in mm of the circle at which a chain turns.
pub const TURN_RADIUS: f64 = 0.75;
/// Radius in mm of the circle at which a path ends.
pub const END_RADIUS: f64 = 1.0;
/// Radius in mm of a probe's circle.
pub const PROBE_RADIUS: f64 = 3.0;

/// Returns the meaning of a circle by its line type and its radius in mm.
pub(crate) fn circle_meaning(line_type: LineType, radius: f64) -> CircleMeaning {
    let is = |marker: f64| has_diameter_of(radius, marker);
    let is_probe = is(PROBE_RADIUS);
    match line_type {
        LineType::Continuous => CircleMeaning::Cut(Cut::Mill),
        LineType::Divide => CircleMeaning::Cut(Cut::Mark),
        LineType::Border | LineType::Center => CircleMeaning::Cut(Cut::Support),
        LineType::Dashed | LineType::Hidden => CircleMeaning::UnknownLineType,
        LineType::Dashdot | LineType::Phantom if is_probe => CircleMeaning::Probe,
        LineType::Dot if is_probe => CircleMeaning::IgnoredProbe,
        LineType::Phantom if is(START_RADIUS) => CircleMeaning::Start,
        LineType::Phantom if is(TURN_RADIUS) => CircleMeaning::Turn,
        LineType::Phantom if is(END_RADIUS) => CircleMeaning::End,
        LineType::Dashdot | LineType::Dot | LineType::Phantom => CircleMeaning::UnknownDiameter,
    }
}

/// Largest difference in mm between the radius of a PHANTOM circle and that of the marker it was probably meant as.
const MAX_RADIUS_SLIP: f64 = 0.1;

impl IntendedMarker {
    /// Returns the marker that a PHANTOM circle was probably meant as, although it does not have the radius of any marker.
    pub(crate) fn of_radius(radius: f64) -> Self {
        let is_about = |known: f64| (radius - known).abs() <= MAX_RADIUS_SLIP;
        if is_about(START_RADIUS) {
            Self::Start
        } else if is_about(END_RADIUS) {
            Self::End
        } else {
            Self::Other
        }
    }

    /// Returns the marker that a circle of unknown line type would be if it had a marker's line type.
    pub(crate) fn of(line_type: LineType, radius: f64) -> Self {
        match circle_meaning(line_type, radius) {
            CircleMeaning::Start => Self::Start,
            CircleMeaning::End => Self::End,
            _ => Self::Other,
        }
    }
}

pub(crate) fn diagnostic_point(point: Xy) -> Point {
    Point::new(point.x, point.y)
}
