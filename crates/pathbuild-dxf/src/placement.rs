//! Similarity transforms of the plane: object coordinates, insertions, units. (book: reference/dxf)

use crate::{Arc, Circle, Geometry, HorizontalAlign, Line, MText, Point3, Text};

/// A similarity transform: it moves, turns, scales and possibly mirrors. A mirroring placement maps (x, y) to (x, -y) before it turns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Placement {
    /// Image of the origin.
    origin: Point3,
    /// Image of the unit vector in x: direction times scale.
    x_axis: (f64, f64),
    /// Angle of `x_axis` in degrees.
    turn: f64,
    /// Scale of lengths, positive.
    scale: f64,
    z_scale: f64,
    mirrored: bool,
}

impl Placement {
    /// The placement that leaves everything where it is.
    pub(crate) const IDENTITY: Self = Self {
        origin: Point3 { x: 0.0, y: 0.0, z: 0.0 },
        x_axis: (1.0, 0.0),
        turn: 0.0,
        scale: 1.0,
        z_scale: 1.0,
        mirrored: false,
    };

    /// The placement that maps object coordinates with extrusion (0, 0, -1) to world coordinates: x and z change sign.
    pub(crate) const MIRRORED: Self =
        Self { x_axis: (-1.0, 0.0), turn: 180.0, z_scale: -1.0, mirrored: true, ..Self::IDENTITY };

    /// Returns a placement that scales about the origin.
    pub(crate) fn scaled(scale: f64) -> Self {
        Self { x_axis: (scale, 0.0), scale, z_scale: scale, ..Self::IDENTITY }
    }

    /// Returns the placement that applies `first` and then this one.
    pub(crate) fn composed_after(&self, first: &Self) -> Self {
        let (x, y) = first.x_axis;
        Self {
            origin: self.point(first.origin),
            x_axis: self.direction(x, y),
            turn: libm::fmod(self.angle(first.turn), 360.0),
            scale: self.scale * first.scale,
            z_scale: self.z_scale * first.z_scale,
            mirrored: self.mirrored != first.mirrored,
        }
    }

    /// Returns a placement that moves the origin to a point.
    pub(crate) fn translated(origin: Point3) -> Self {
        Self { origin, ..Self::IDENTITY }
    }

    /// Returns a placement that turns about the origin, in degrees counterclockwise.
    pub(crate) fn rotated(turn: f64) -> Self {
        Self { x_axis: cos_sin(turn), turn, ..Self::IDENTITY }
    }

    /// Returns a placement that scales x, y and z; `None` if x is 0, or if x and y differ in more than sign.
    pub(crate) fn scaled_by(x: f64, y: f64, z: f64) -> Option<Self> {
        /// Relative difference up to which computed scales are considered equal.
        const SCALE_TOLERANCE: f64 = 2e-7;
        let scale = x.abs();
        let is_uniform = scale > 0.0 && (scale - y.abs()).abs() <= SCALE_TOLERANCE * scale;
        let mirrored = (x < 0.0) != (y < 0.0);
        let turn = if x < 0.0 { 180.0 } else { 0.0 };
        is_uniform.then_some(Self { x_axis: (x, 0.0), turn, scale, z_scale: z, mirrored, ..Self::IDENTITY })
    }

    /// Whether the placement mirrors, so that left and right change places.
    pub(crate) fn is_mirrored(&self) -> bool {
        self.mirrored
    }

    pub(crate) fn point(&self, point: Point3) -> Point3 {
        let (x, y) = self.direction(point.x, point.y);
        Point3 { x: self.origin.x + x, y: self.origin.y + y, z: self.origin.z + self.z_scale * point.z }
    }

    /// Transforms a vector: unlike a point, it is not moved.
    pub(crate) fn direction(&self, x: f64, y: f64) -> (f64, f64) {
        let (cos, sin) = self.x_axis;
        let y = if self.mirrored { -y } else { y };
        (cos * x - sin * y, sin * x + cos * y)
    }

    pub(crate) fn apply(&self, geometry: &mut Geometry) {
        match geometry {
            Geometry::Line(line) => *line = Line { start: self.point(line.start), end: self.point(line.end) },
            Geometry::Arc(arc) => *arc = self.arc(*arc),
            Geometry::Circle(circle) => {
                *circle = Circle { centre: self.point(circle.centre), radius: circle.radius * self.scale };
            }
            Geometry::Text(text) => self.place_text(text),
            Geometry::MText(text) => self.place_mtext(text),
        }
    }

    fn arc(&self, arc: Arc) -> Arc {
        Arc {
            centre: self.point(arc.centre),
            radius: arc.radius * self.scale,
            start_angle: self.angle(arc.start_angle),
            end_angle: self.angle(arc.end_angle),
            clockwise: arc.clockwise != self.mirrored,
        }
    }

    /// Transforms a direction given as an angle in degrees.
    fn angle(&self, angle: f64) -> f64 {
        if self.mirrored { self.turn - angle } else { self.turn + angle }
    }

    /// Places a text. Mirroring makes its letters run backwards along its own, turned baseline.
    fn place_text(&self, text: &mut Text) {
        text.anchor = self.point(text.anchor);
        text.height *= self.scale;
        text.rotation = self.text_rotation(text.rotation);
        text.backwards ^= self.mirrored;
    }

    /// Places an MTEXT. A mirrored one covers the same area as an unmirrored one but has its anchor on the other side.
    fn place_mtext(&self, text: &mut MText) {
        text.anchor = self.point(text.anchor);
        text.height *= self.scale;
        text.width = text.width.map(|width| width * self.scale);
        text.rotation = self.text_rotation(text.rotation);
        if self.mirrored {
            text.horizontal = opposite(text.horizontal);
            text.paragraphs = opposite(text.paragraphs);
        }
    }

    fn text_rotation(&self, rotation: f64) -> f64 {
        if self.mirrored { (self.turn + 180.0 - rotation) % 360.0 } else { self.turn + rotation }
    }
}

/// Largest coordinate or length of a path in mm: one kilometre, which exceeds any machine and leaves enough digits for all computations.
pub(crate) const MAX_COORDINATE: f64 = 1e6;

impl Geometry {
    /// Whether this is a text of blanks, which is invisible.
    pub(crate) fn is_blank(&self) -> bool {
        match self {
            Self::Text(text) => text.string.trim().is_empty(),
            Self::MText(text) => text.plain.trim().is_empty(),
            Self::Line(_) | Self::Arc(_) | Self::Circle(_) => false,
        }
    }

    /// Whether all coordinates and lengths are within [`MAX_COORDINATE`] and all lengths positive.
    pub(crate) fn is_sound(&self) -> bool {
        let is_near = |point: &Point3| {
            [point.x, point.y, point.z].iter().all(|coordinate| coordinate.abs() <= MAX_COORDINATE)
        };
        let is_length = |length: f64| length > 0.0 && length <= MAX_COORDINATE;
        match self {
            Self::Line(line) => is_near(&line.start) && is_near(&line.end),
            Self::Arc(arc) => is_near(&arc.centre) && is_length(arc.radius),
            Self::Circle(circle) => is_near(&circle.centre) && is_length(circle.radius),
            Self::Text(text) => is_near(&text.anchor) && is_length(text.height),
            Self::MText(text) => is_near(&text.anchor) && is_length(text.height),
        }
    }
}

pub(crate) fn opposite(side: HorizontalAlign) -> HorizontalAlign {
    match side {
        HorizontalAlign::Left => HorizontalAlign::Right,
        HorizontalAlign::Centre => HorizontalAlign::Centre,
        HorizontalAlign::Right => HorizontalAlign::Left,
    }
}

/// Computes the cosine and sine of an angle in degrees. They are exact for multiples of 90 degrees, the most frequent angles in drawings.
fn cos_sin(degrees: f64) -> (f64, f64) {
    let turned = libm::fmod(degrees, 360.0);
    let turned = if turned < 0.0 { turned + 360.0 } else { turned };
    match turned {
        0.0 | 360.0 => (1.0, 0.0),
        90.0 => (0.0, 1.0),
        180.0 => (-1.0, 0.0),
        270.0 => (0.0, -1.0),
        _ => {
            let (sin, cos) = libm::sincos(turned.to_radians());
            (cos, sin)
        }
    }
}

/// Returns the angle in degrees of a vector of non-zero length.
pub(crate) fn angle_of(x: f64, y: f64) -> f64 {
    libm::atan2(y, x).to_degrees()
}
