//! Helical circles. (book: program/gcode)

use std::f64::consts::PI;

use pathbuild_path::approx::{above, at_least};
use pathbuild_path::{Arc, Bars, Curve, Helix, Origin, Xy};

use crate::bars::BarPlan;
use crate::fold::{Fold, Parts, PlacedPath, Tip};
use crate::program::{Class, Count, ElementKind, Height, Move};

/// The circle followed by the cutter's centre, in program coordinates.
#[derive(Clone, Copy)]
struct Circle {
    centre: Xy,
    radius: f64,
    feed: f64,
}

impl Circle {
    /// The lowest point in the plane, where full circles begin and end.
    fn low(&self) -> Xy {
        Xy::new(self.centre.x, self.centre.y - self.radius)
    }

    fn high(&self) -> Xy {
        Xy::new(self.centre.x, self.centre.y + self.radius)
    }

    /// The full circle, clockwise from its lowest point.
    fn curve(&self) -> Curve {
        let low = self.low();
        Curve::Arc(Arc {
            centre: self.centre,
            radius: self.radius,
            start: low,
            end: low,
            clockwise: true,
            degrees: 360.0,
        })
    }
}

impl<P: Parts> Fold<'_, P> {
    pub(crate) fn helix(&mut self, place: &PlacedPath<'_>, origin: &Origin, helix: &Helix) {
        let circle = Circle {
            centre: place.placement.place(helix.centre),
            radius: helix.axis_radius(place.path.tool),
            feed: self.feed(helix.feed),
        };
        let bottom = place.raised + helix.bottom;
        self.element(ElementKind::HelicalCircle, origin, bottom, place, None);
        self.plunge(place.surface + place.path.tool, place.surface, circle.feed);
        self.question(helix.comment.as_deref());
        self.sweep(circle.low(), circle.radius);
        let mut done = self.spiral(&circle, place.surface, helix.infeed, bottom);
        if let Some((depth, bars)) = &helix.bars {
            done = self.circles_with_bars(place, &circle, (done, helix.infeed), *depth, bars);
        }
        if !at_least(place.path.tool, helix.radius) {
            self.lift_corrected_at(place.sweep_height, circle.centre, place.sweep_height - done);
        }
        self.sweep(circle.centre, circle.radius);
    }

    /// Mills half circles down to the bottom, the last two at the bottom. Returns the depth at which the last full circle began.
    fn spiral(&mut self, circle: &Circle, surface: f64, infeed: f64, bottom: f64) -> f64 {
        let mut depth = surface;
        if at_least(bottom, surface) {
            return surface;
        }
        loop {
            let half = (depth - infeed / 2.0).max(bottom);
            self.half_circle(circle, circle.high(), circle.radius, half);
            self.half_circle(circle, circle.low(), -circle.radius, (half - infeed / 2.0).max(bottom));
            if at_least(bottom, depth) {
                return depth;
            }
            depth -= infeed;
        }
    }

    fn half_circle(&mut self, circle: &Circle, to: Xy, j: f64, z: f64) {
        let height = Height { z, at: circle.centre };
        let half = Move::Arc {
            feed: circle.feed,
            clockwise: true,
            centre: Xy::new(0.0, j),
            to,
            z: height,
            is_spiral: true,
        };
        let count = Count { class: Class::Milling, length: PI * circle.radius, feed: Some(circle.feed) };
        self.step(half, count, Tip { at: to, z });
    }

    /// Mills full circles with bars below D, pass by pass down to B. Returns the depth of the last one, or that of the spiral if there is
    /// none.
    fn circles_with_bars(
        &mut self,
        place: &PlacedPath<'_>,
        circle: &Circle,
        (done, infeed): (f64, f64),
        depth: f64,
        bars: &Bars,
    ) -> f64 {
        let length = 2.0 * PI * circle.radius;
        let Some(plan) = BarPlan::new(bars, depth, place.path.tool, length) else { return done };
        let (low, high) = (place.raised + depth, place.raised + bars.top);
        // The original tool continues from the end of its spiral, which may already be below B.
        let mut z = if self.compatible { done } else { high };
        while above(z, low) {
            self.checkpoint();
            z = if above(z - infeed, low) { z - infeed } else { low };
            for section in plan.sections(&circle.curve(), z, high) {
                self.mill(&section, place.surface, circle.feed);
            }
        }
        z
    }
}
