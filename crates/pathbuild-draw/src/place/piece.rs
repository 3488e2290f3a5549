use crate::model::{Arc, Circle, Line, Point};

/// A part of an element, as used for matching texts.
#[derive(Clone, Copy, Debug)]
pub(crate) enum ElementPart {
    Circle(Circle),
    Arc(Arc),
    Line(Line),
}

/// Priority of an element's part: circles before arcs before lines, regardless of distance.
pub(crate) type Rank = u8;

impl ElementPart {
    /// Rank and distance if a text circle overlaps this part. (book: language/parameter-texts)
    pub(crate) fn overlapped(&self, centre: Point, radius: f64) -> Option<(Rank, f64)> {
        match self {
            Self::Circle(circle) => {
                let distance = centre.distance(circle.centre);
                (distance < radius + circle.radius).then_some((0, distance))
            }
            Self::Arc(arc) => {
                let distance = (centre.distance(arc.centre) - arc.radius).abs();
                (covers(arc, centre) && distance <= radius).then_some((1, distance))
            }
            Self::Line(line) => {
                let foot = foot(line, centre)?;
                let distance = centre.distance(foot);
                (distance < radius).then_some((2, distance))
            }
        }
    }

    /// The distance of a point from the part; negative inside a circle.
    pub(crate) fn clearance(&self, point: Point) -> f64 {
        let to_ends = |a: Point, b: Point| point.distance(a).min(point.distance(b));
        match self {
            Self::Circle(circle) => point.distance(circle.centre) - circle.radius,
            Self::Arc(arc) if covers(arc, point) => (point.distance(arc.centre) - arc.radius).abs(),
            Self::Arc(arc) => to_ends(arc.point(arc.start), arc.point(arc.end)),
            Self::Line(line) => {
                foot(line, point).map_or_else(|| to_ends(line.from, line.to), |foot| point.distance(foot))
            }
        }
    }

    /// Centres at which a text circle of this radius overlaps the part, the best looking first.
    pub(crate) fn seats(&self, radius: f64) -> Vec<Point> {
        const ALONG: [f64; 11] = [0.5, 0.35, 0.65, 0.2, 0.8, 0.42, 0.58, 0.28, 0.72, 0.1, 0.9];
        const ASIDE: [f64; 3] = [0.6, -0.6, 0.0];
        const ROUND: [f64; 16] = [
            45.0, 135.0, 225.0, 315.0, 0.0, 90.0, 180.0, 270.0, 22.5, 67.5, 112.5, 157.5, 202.5, 247.5,
            292.5, 337.5,
        ];
        match self {
            Self::Circle(circle) => {
                let outside = circle.radius + 0.8 * radius;
                let inside = circle.radius - 0.6 * radius;
                let rings = [outside, inside.max(0.0), 0.0].into_iter();
                rings.flat_map(|d| ROUND.map(|angle| circle.centre.polar(d, angle))).collect()
            }
            Self::Arc(arc) => {
                let sweep = arc.sweep();
                let ring = |aside: f64| (arc.radius + aside * radius).max(arc.radius / 2.0);
                let at = |t: f64, aside: f64| arc.centre.polar(ring(aside), arc.start + t * sweep);
                ALONG.iter().flat_map(|t| ASIDE.map(|aside| at(*t, aside))).collect()
            }
            Self::Line(line) => {
                let length = line.from.distance(line.to);
                let unit =
                    if length > 0.0 { (line.to - line.from) * (1.0 / length) } else { Point::new(1.0, 0.0) };
                let normal = Point::new(-unit.y, unit.x);
                let at =
                    |t: f64, aside: f64| line.from + (line.to - line.from) * t + normal * (aside * radius);
                ALONG.iter().flat_map(|t| ASIDE.map(|aside| at(*t, aside))).collect()
            }
        }
    }
}

/// Whether a point's direction from the centre lies within the arc.
fn covers(arc: &Arc, point: Point) -> bool {
    (arc.centre.direction(point) - arc.start).rem_euclid(360.0) <= arc.sweep()
}

/// The foot of the perpendicular, if it lies on the line.
fn foot(line: &Line, point: Point) -> Option<Point> {
    let (along, to) = (line.to - line.from, point - line.from);
    let length2 = along.x * along.x + along.y * along.y;
    let t = (to.x * along.x + to.y * along.y) / length2;
    (0.0..=1.0).contains(&t).then(|| line.from + along * t)
}
