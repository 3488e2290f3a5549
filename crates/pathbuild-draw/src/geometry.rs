//! Points, lines, arcs and circles of drawings, in mm and degrees.

use std::ops::{Add, Mul, Sub};

/// A point or vector in world coordinates, in mm.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[expect(missing_docs, reason = "coordinates")]
pub struct Point {
    pub x: f64,
    pub y: f64,
    pub z: f64,
}

impl Point {
    /// Creates a point in the plane of the drawing.
    pub const fn new(x: f64, y: f64) -> Self {
        Self { x, y, z: 0.0 }
    }

    /// Returns the point moved to another height.
    pub const fn at_height(self, z: f64) -> Self {
        Self { z, ..self }
    }

    /// Returns the point at a distance in a direction (degrees, counterclockwise from the x axis).
    pub fn polar(self, distance: f64, degrees: f64) -> Self {
        let (sin, cos) = sin_cos(degrees);
        Self { x: self.x + distance * cos, y: self.y + distance * sin, ..self }
    }

    /// Returns the distance to another point in the plane, regardless of the heights.
    pub fn distance(self, other: Self) -> f64 {
        libm::hypot(other.x - self.x, other.y - self.y)
    }

    /// Returns the direction to another point, in degrees from -180 to 180.
    pub fn direction(self, other: Self) -> f64 {
        libm::atan2(other.y - self.y, other.x - self.x).to_degrees()
    }

    /// Returns the vector rotated around the origin, counterclockwise.
    pub fn rotated(self, degrees: f64) -> Self {
        let (sin, cos) = sin_cos(degrees);
        Self { x: self.x * cos - self.y * sin, y: self.x * sin + self.y * cos, ..self }
    }
}

/// Returns sine and cosine of an angle in degrees, exact for multiples of 90 degrees, which occur most often in drawings.
pub fn sin_cos(degrees: f64) -> (f64, f64) {
    match degrees.rem_euclid(360.0) {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        angle => libm::sincos(angle.to_radians()),
    }
}

impl From<(f64, f64)> for Point {
    fn from((x, y): (f64, f64)) -> Self {
        Self::new(x, y)
    }
}

impl Add for Point {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y, z: self.z + other.z }
    }
}

impl Sub for Point {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y, z: self.z - other.z }
    }
}

impl Mul<f64> for Point {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self { x: self.x * factor, y: self.y * factor, z: self.z * factor }
    }
}

/// A straight line between two points.
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

/// A circle in the plane of the drawing.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct Circle {
    pub centre: Point,
    pub radius: f64,
}

impl Arc {
    /// Returns the point at an angle in degrees.
    pub fn point(&self, degrees: f64) -> Point {
        self.centre.polar(self.radius, degrees)
    }

    /// Returns the swept angle, greater than 0 and at most 360 degrees.
    pub fn sweep(&self) -> f64 {
        let sweep = (self.end - self.start).rem_euclid(360.0);
        if sweep == 0.0 { 360.0 } else { sweep }
    }
}
