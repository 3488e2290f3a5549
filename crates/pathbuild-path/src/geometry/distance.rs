//! Exact distances between curves, found from their ends, their crossings, and the common perpendiculars.

use nalgebra::Vector2;

use super::{Arc, Curve, Line, Xy};

impl Curve {
    /// The distance in mm between two curves; 0 if they cross or touch.
    pub fn distance(&self, other: &Self) -> f64 {
        if self.crosses(other) {
            return 0.0;
        }
        let to_other = [self.start(), self.end()].into_iter().chain(self.towards(other));
        let to_self = [other.start(), other.end()].into_iter().chain(other.towards(self));
        let to_other = to_other.map(|point| other.distance_to(point));
        to_other.chain(to_self.map(|point| self.distance_to(point))).fold(f64::INFINITY, f64::min)
    }

    /// The distance in mm between a point and the curve.
    pub fn distance_to(&self, point: Xy) -> f64 {
        match self {
            Self::Line(line) => (line.nearest(point) - point).norm(),
            Self::Arc(arc) => arc.distance_to(point),
        }
    }

    /// The interior points of a curve that may be nearest to another arc.
    fn towards(&self, other: &Self) -> Vec<Xy> {
        match (self, other) {
            (Self::Line(line), Self::Arc(arc)) => vec![line.nearest(arc.centre)],
            (Self::Arc(arc), Self::Arc(other)) => arc.on_line_through(other.centre),
            (_, Self::Line(_)) => Vec::new(),
        }
    }

    fn crosses(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Line(one), Self::Line(other)) => one.crosses(other),
            (Self::Line(line), Self::Arc(arc)) | (Self::Arc(arc), Self::Line(line)) => arc.crosses_line(line),
            (Self::Arc(one), Self::Arc(other)) => one.crosses(other),
        }
    }
}

impl Line {
    fn nearest(&self, point: Xy) -> Xy {
        let along = self.end - self.start;
        let squared = along.norm_squared();
        if squared == 0.0 {
            return self.start;
        }
        self.start + along * (along.dot(&(point - self.start)) / squared).clamp(0.0, 1.0)
    }

    /// Whether each curve has ends on both sides of the other. Lines that only touch have an end on the other line.
    fn crosses(&self, other: &Self) -> bool {
        let divides = |one: &Self, other: &Self| {
            let along = one.end - one.start;
            let side = |point: Xy| along.perp(&(point - one.start));
            side(other.start) * side(other.end) < 0.0
        };
        divides(self, other) && divides(other, self)
    }
}

impl Arc {
    fn distance_to(&self, point: Xy) -> f64 {
        let out = point - self.centre;
        if out != Vector2::zeros() && self.spans(out) {
            return (out.norm() - self.radius).abs();
        }
        (point - self.start).norm().min((point - self.end).norm())
    }

    /// Whether the arc contains the point of its circle in that direction from the centre.
    pub(crate) fn spans(&self, out: Vector2<f64>) -> bool {
        let from = self.start - self.centre;
        let angle = libm::atan2(from.perp(&out), from.dot(&out)).to_degrees();
        let ahead = if self.clockwise { -angle } else { angle };
        (if ahead < 0.0 { ahead + 360.0 } else { ahead }) <= self.degrees
    }

    /// The points of the arc on the line through its centre and another point.
    fn on_line_through(&self, other: Xy) -> Vec<Xy> {
        let way = other - self.centre;
        let Some(out) = way.try_normalize(0.0) else { return Vec::new() };
        let points = [out, -out].into_iter().filter(|out| self.spans(*out));
        points.map(|out| self.centre + out * self.radius).collect()
    }

    fn crosses_line(&self, line: &Line) -> bool {
        let along = line.end - line.start;
        let squared = along.norm_squared();
        if squared == 0.0 {
            return false;
        }
        let out = line.start - self.centre;
        let foot = -along.dot(&out) / squared;
        let upright = (out + along * foot).norm_squared();
        let half = self.radius * self.radius - upright;
        if half < 0.0 {
            return false;
        }
        let half = libm::sqrt(half / squared);
        let is_on_both = |at: f64| (0.0..=1.0).contains(&at) && self.spans(out + along * at);
        is_on_both(foot - half) || is_on_both(foot + half)
    }

    fn crosses(&self, other: &Self) -> bool {
        let way = other.centre - self.centre;
        let squared = way.norm_squared();
        if squared == 0.0 {
            return false;
        }
        // The position of the radical line on the way between the centres, as a fraction of the way.
        let along = (squared + self.radius * self.radius - other.radius * other.radius) / (2.0 * squared);
        let half = self.radius * self.radius / squared - along * along;
        if half < 0.0 {
            return false;
        }
        let across = Vector2::new(-way.y, way.x) * libm::sqrt(half);
        [across, -across].into_iter().any(|across| {
            let out = way * along + across;
            self.spans(out) && other.spans(out - way)
        })
    }
}
