//! Support bars along a segment. (book: program/gcode)

use pathbuild_path::{Bars, Curve};

use crate::mill::Section;

/// The parts of a curve along which bars are left standing with a cutter of diameter `tool`; the whole curve if there is no room for gaps.
pub fn support_bars(bars: &Bars, bottom: f64, tool: f64, curve: &Curve) -> Vec<Curve> {
    let Some(plan) = BarPlan::new(bars, bottom, tool, curve.length()) else { return vec![*curve] };
    let tops = plan.pieces.iter().filter(|piece| !piece.starts_low && !piece.ends_low);
    tops.map(|piece| curve.section(piece.from, piece.to)).collect()
}

/// How deep the parts of a segment with bars are milled, by position along the segment in mm.
#[derive(Clone, Debug)]
pub(crate) struct BarPlan {
    pieces: Vec<BarSpan>,
}

/// A range of positions along the segment. A slope leads from one level to the other.
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
        // The slopes have 45 degrees if there is room for that, otherwise they are steeper.
        let slope = (bars.top - bottom).min(bars.length / 2.0).min((pitch - bars.length - tool) / 2.0);
        let edge = bars.length / 2.0 + tool / 2.0;
        let between = (pitch - bars.length - 2.0 * slope - tool).max(0.0);
        let mut plan = Self { pieces: Vec::new() };
        plan.piece(0.0, edge, false, false);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a whole number, 1 or more"
        )]
        let gaps = count as u64;
        for k in 0..gaps - 1 {
            let start = edge + k as f64 * pitch;
            let end = plan.gap(start, slope, between);
            plan.piece(end, end + bars.length + tool, false, false);
        }
        let end = plan.gap(length - edge - 2.0 * slope - between, slope, between);
        plan.piece(end, length, false, false);
        Some(plan)
    }

    /// Adds a gap: down, along the bottom, and up. Returns its end position.
    fn gap(&mut self, start: f64, slope: f64, between: f64) -> f64 {
        let (low, high) = (start + slope, start + slope + between);
        self.piece(start, low, false, true);
        self.piece(low, high, true, true);
        self.piece(high, high + slope, true, false);
        high + slope
    }

    fn piece(&mut self, from: f64, to: f64, starts_low: bool, ends_low: bool) {
        self.pieces.push(BarSpan { from, to, starts_low, ends_low });
    }

    /// The sections along a curve in order from its start, with gaps at `low` and bars at `high`.
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
