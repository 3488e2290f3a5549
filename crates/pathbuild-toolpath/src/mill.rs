//! Generates the moves along a curve, with support bars, and along the helix of a circle. (book: program/gcode)

use std::f64::consts::PI;

use pathbuild_path::approx::{above, at_least};
use pathbuild_path::{Arc, Bars, Curve, Helix, Origin, Placement, Xy};

use crate::fold::{Fold, FoldPaths, MAX_RESERVED_STEPS, PlacedPath};
use crate::moves::LAST_DIGIT;
use crate::program::{Count, ElementKind, Height, MoveClass, PlannedMove};

/// A part of a segment with the heights at its ends, in mm.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Section {
    pub(crate) curve: Curve,
    pub(crate) from_z: f64,
    pub(crate) to_z: f64,
}

impl Section {
    pub(crate) fn reversed(self) -> Self {
        Self { curve: self.curve.reversed(), from_z: self.to_z, to_z: self.from_z }
    }
}

impl<P: FoldPaths> Fold<'_, P> {
    /// Mills a section, which is in program coordinates, after moving to the height of its start.
    pub(crate) fn mill_section(&mut self, section: &Section, surface: f64, feed: f64) {
        self.plunge(section.from_z, surface, feed);
        let to = section.curve.end();
        let z = Height { z: section.to_z, at: section.curve.start() };
        let count = Count { class: MoveClass::Milling, length: section.curve.length(), feed: Some(feed) };
        // Beside a bar on an arc, a slope may have almost no length. Three decimals cannot distinguish such an arc from a full turn of a helix, so it
        // becomes a line.
        let is_slope = section.from_z != section.to_z;
        let is_line = is_slope && section.curve.length() < LAST_DIGIT && !self.compatible;
        let to = match section.curve {
            Curve::Arc(arc) if !is_line => {
                let centre = (arc.centre - arc.start).into();
                PlannedMove::Arc { feed, clockwise: arc.clockwise, centre, to, z, is_spiral: false }
            }
            _ => PlannedMove::Line { feed, to, z },
        };
        self.step(to, count);
    }
}

// Support bars along a segment. (book: program/gcode)

/// Returns the parts of a curve along which a cutter of diameter `tool` stays at the height of the bars; the whole curve if there is no room for
/// gaps.
pub fn support_bars(bars: &Bars, bottom: f64, tool: f64, curve: &Curve) -> Vec<Curve> {
    let Some(plan) = BarPlan::new(bars, bottom, tool, curve.length()) else { return vec![*curve] };
    plan.bars().map(|(from, to)| curve.section(from, to)).collect()
}

/// The levels of the parts of a segment with bars, by position along the segment in mm.
#[derive(Clone, Debug)]
pub(crate) struct BarPlan {
    pieces: Vec<BarSpan>,
}

/// A range of positions along the segment. If its ends are at different levels, it is a slope.
#[derive(Clone, Copy, Debug)]
struct BarSpan {
    from: f64,
    to: f64,
    starts_low: bool,
    ends_low: bool,
}

impl BarPlan {
    /// Plans a segment of this length with B at `bottom`. Returns `None` if there is no room for gaps, so that the whole segment remains at
    /// the height of the bars.
    pub(crate) fn new(bars: &Bars, bottom: f64, tool: f64, length: f64) -> Option<Self> {
        let count = bars.count(length);
        if count <= 0.0 {
            return None;
        }
        let pitch = length / count;
        // The slopes rise at 45 degrees, or more steeply if they would otherwise not fit into the gap or be longer than half a bar.
        let room = ((pitch - bars.length - tool) / 2.0).max(0.0);
        let slope = (bars.top - bottom).min(bars.length / 2.0).min(room);
        let edge = bars.length / 2.0 + tool / 2.0;
        let between = (pitch - bars.length - 2.0 * slope - tool).max(0.0);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a whole number, 1 or more"
        )]
        let gaps = count as usize;
        let mut plan = Self {
            pieces: Vec::with_capacity(SPANS_PER_BAR.saturating_mul(gaps).min(MAX_RESERVED_STEPS) + 1),
        };
        plan.add_span(0.0, edge, false, false);
        for k in 0..gaps - 1 {
            let start = edge + k as f64 * pitch;
            let end = plan.add_gap(start, slope, between);
            plan.add_span(end, end + bars.length + tool, false, false);
        }
        let end = plan.add_gap(length - edge - 2.0 * slope - between, slope, between);
        plan.add_span(end, length, false, false);
        Some(plan)
    }

    /// Returns the positions of the bars along the segment in mm, including half of O at each end.
    pub(crate) fn bars(&self) -> impl Iterator<Item = (f64, f64)> {
        let tops = self.pieces.iter().filter(|piece| !piece.starts_low && !piece.ends_low);
        tops.map(|piece| (piece.from, piece.to))
    }

    /// Adds a gap: down, along the bottom, and up. Returns the position of the gap's end.
    fn add_gap(&mut self, start: f64, slope: f64, between: f64) -> f64 {
        let (low, high) = (start + slope, start + slope + between);
        self.add_span(start, low, false, true);
        self.add_span(low, high, true, true);
        self.add_span(high, high + slope, true, false);
        high + slope
    }

    fn add_span(&mut self, from: f64, to: f64, starts_low: bool, ends_low: bool) {
        self.pieces.push(BarSpan { from, to, starts_low, ends_low });
    }

    /// Returns the sections along a curve in order from its start, with gaps at `low` and bars at `high`.
    pub(crate) fn sections(&self, curve: &Curve, low: f64, high: f64) -> Vec<Section> {
        let level = |is_low| if is_low { low } else { high };
        let section = |piece: &BarSpan| Section {
            curve: curve.section(piece.from, piece.to),
            from_z: level(piece.starts_low),
            to_z: level(piece.ends_low),
        };
        self.pieces.iter().map(section).collect()
    }
}

/// Number of pieces from one bar to the next: down, along the bottom, up, and the bar.
const SPANS_PER_BAR: usize = 4;

// Helical circles. (book: program/gcode)

/// The circle followed by the cutter's centre, in program coordinates.
#[derive(Clone, Copy)]
struct Circle {
    centre: Xy,
    radius: f64,
    feed: f64,
}

impl Circle {
    fn new(helix: &Helix, tool: f64, feed: f64, placement: &Placement) -> Self {
        Self { centre: placement.place(helix.centre), radius: helix.axis_radius(tool), feed }
    }

    /// Returns the point with the least Y, where full circles begin and end.
    fn least_y_point(&self) -> Xy {
        Xy::new(self.centre.x, self.centre.y - self.radius)
    }

    fn greatest_y_point(&self) -> Xy {
        Xy::new(self.centre.x, self.centre.y + self.radius)
    }

    /// Returns the full circle, clockwise from its point with the least Y.
    fn curve(&self) -> Curve {
        let start = self.least_y_point();
        Curve::Arc(Arc {
            centre: self.centre,
            radius: self.radius,
            start,
            end: start,
            clockwise: true,
            degrees: 360.0,
        })
    }
}

impl<P: FoldPaths> Fold<'_, P> {
    pub(crate) fn mill_helix(&mut self, place: &PlacedPath<'_>, origin: &Origin, helix: &Helix) {
        let feed = self.feed_or_default(helix.feed);
        let circle = Circle::new(helix, place.path.tool, feed, &place.placement);
        let bottom = place.raised + helix.bottom;
        self.add_element_comment(ElementKind::HelicalCircle, origin, bottom, place, None);
        self.plunge(place.surface + place.path.tool, place.surface, feed);
        self.add_question_comment(helix.comment.as_deref());
        self.sweep(circle.least_y_point(), circle.radius);
        let mut done = self.mill_half_circles(&circle, place.surface, helix.infeed, bottom);
        if let Some((depth, bars)) = &helix.bars {
            done = self.mill_circles_with_bars(place, &circle, (done, helix.infeed), *depth, bars);
        }
        if !at_least(place.path.tool, helix.radius) {
            self.lift_corrected_at(place.sweep_height, circle.centre, place.sweep_height - done);
        }
        self.sweep(circle.centre, circle.radius);
    }

    /// Mills half circles down to the bottom, the last two at the bottom. Returns the depth from which the last two were computed, which may be below
    /// the bottom.
    fn mill_half_circles(&mut self, circle: &Circle, surface: f64, infeed: f64, bottom: f64) -> f64 {
        let mut depth = surface;
        if at_least(bottom, surface) {
            return surface;
        }
        loop {
            let half = (depth - infeed / 2.0).max(bottom);
            self.mill_half_circle(circle, circle.greatest_y_point(), circle.radius, half);
            self.mill_half_circle(
                circle,
                circle.least_y_point(),
                -circle.radius,
                (half - infeed / 2.0).max(bottom),
            );
            if at_least(bottom, depth) {
                return depth;
            }
            depth -= infeed;
        }
    }

    fn mill_half_circle(&mut self, circle: &Circle, to: Xy, j: f64, z: f64) {
        let height = Height { z, at: circle.centre };
        let half = PlannedMove::Arc {
            feed: circle.feed,
            clockwise: true,
            centre: Xy::new(0.0, j),
            to,
            z: height,
            is_spiral: true,
        };
        let count = Count { class: MoveClass::Milling, length: PI * circle.radius, feed: Some(circle.feed) };
        self.step(half, count);
    }

    /// Mills full circles with bars below D, pass by pass down to B. Returns the depth of the last circle, or of the spiral if there is no circle.
    fn mill_circles_with_bars(
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
        // PathDxf2GCode continues from the end of its spiral, which may already be below B.
        let mut z = if self.compatible { done } else { high };
        while above(z, low) {
            self.checkpoint();
            z = if above(z - infeed, low) { z - infeed } else { low };
            for section in plan.sections(&circle.curve(), z, high) {
                self.mill_section(&section, place.surface, circle.feed);
            }
        }
        z
    }
}

/// Returns the full circle on which the cutter's axis moves, clockwise from its point with the least Y in the program. The first support bar stands
/// there, however the path is turned.
pub fn axis_circle(helix: &Helix, tool: f64, placement: &Placement) -> Curve {
    Circle::new(helix, tool, 0.0, placement).curve()
}

/// Returns the last turns of a helix along its [`axis_circle`] and, if it has support bars, the circle that leaves them, as if each were milled in a
/// single pass.
pub(crate) fn last_turns(helix: &Helix, surface: f64, tool: f64, curve: &Curve) -> Vec<Section> {
    let half = curve.length() / 2.0;
    let mut sections = Vec::new();
    if !at_least(helix.bottom, surface) {
        let middle = (surface - helix.infeed.max(surface - helix.bottom) / 2.0).max(helix.bottom);
        let heights = [surface, middle, helix.bottom, helix.bottom, helix.bottom];
        let halves = [curve.section(0.0, half), curve.section(half, 2.0 * half)];
        sections.extend(heights.windows(2).zip(halves.into_iter().cycle()).map(|(ends, curve)| Section {
            curve,
            from_z: ends[0],
            to_z: ends[1],
        }));
    }
    if let Some((low, bars)) = &helix.bars
        && above(bars.top, *low)
        && let Some(plan) = BarPlan::new(bars, *low, tool, curve.length())
    {
        sections.extend(plan.sections(curve, *low, bars.top));
    }
    sections
}
