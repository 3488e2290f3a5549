//! Probes that do not fit their neighbours. (PB607)
//!
//! Each probe is held against the plane through all the others. It is odd when it lies more than [`LEAST`] from that plane, and more
//! than [`FACTOR`] times as far as the others scatter about it (the externally studentized residual): a bent sheet, where all scatter,
//! has no odd probes, and one slip of the pen stands out. That takes five probes, because three others always lie on a plane, and then
//! nobody can say which one is wrong.

use nalgebra::Matrix2;
use pathbuild_path::Xy;

use super::scatter::Scatter;

/// What a probe may be off in mm, however well the others fit.
const LEAST: f64 = 0.1;

/// How much farther off than the others scatter.
const FACTOR: f64 = 4.0;

/// A plane has so many degrees of freedom.
const FREEDOM: f64 = 3.0;

/// A probe that does not fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OddProbe {
    /// Its number in the order in which the probes were given.
    pub probe: usize,
    /// How much higher it is than the plane through the others, in mm.
    pub off: f64,
}

/// The odd ones among probes, in order. Each is its place and how much higher than drawn it was measured, in mm.
pub fn odd_probes(probes: &[(Xy, f64)]) -> Vec<OddProbe> {
    if probes.len() < 5 {
        return Vec::new();
    }
    let fit = Fit::new(probes);
    let odd = probes.iter().enumerate().filter_map(|(probe, measured)| {
        let off = fit.odd(*measured)?;
        Some(OddProbe { probe, off })
    });
    odd.collect()
}

/// The plane through all probes, and how they scatter about it.
struct Fit {
    scatter: Scatter,
    inverse: Matrix2<f64>,
    mean: f64,
    slope: nalgebra::Vector2<f64>,
    /// Sum of squares, mm².
    residue: f64,
}

impl Fit {
    fn new(probes: &[(Xy, f64)]) -> Self {
        let places: Vec<Xy> = probes.iter().map(|(place, _)| *place).collect();
        let scatter = Scatter::new(&places);
        let inverse = scatter.inverse();
        let mean = probes.iter().map(|(_, off)| off).sum::<f64>() / scatter.count;
        let slope = inverse
            * probes
                .iter()
                .map(|(place, off)| (place - scatter.middle) * (off - mean))
                .sum::<nalgebra::Vector2<f64>>();
        let mut fit = Self { scatter, inverse, mean, slope, residue: 0.0 };
        fit.residue = probes.iter().map(|probe| fit.residual(*probe)).map(|off| off * off).sum();
        fit
    }

    fn residual(&self, (place, off): (Xy, f64)) -> f64 {
        off - self.mean - self.slope.dot(&(place - self.scatter.middle))
    }

    /// How far a probe is from the plane through the others, where that is odd. The plane through the others need not be fitted: what a
    /// probe contributes to the plane through all says how far it has drawn that plane towards itself.
    fn odd(&self, probe: (Xy, f64)) -> Option<f64> {
        let place = probe.0 - self.scatter.middle;
        if !self.scatter.without(probe.0).is_wide() {
            return None;
        }
        let free = 1.0 - 1.0 / self.scatter.count - place.dot(&(self.inverse * place));
        let residual = self.residual(probe);
        let off = residual / free;
        let others = (self.residue - residual * off).max(0.0) / (self.scatter.count - 1.0 - FREEDOM);
        let expected = libm::sqrt(others / free);
        (off.abs() > LEAST && off.abs() > FACTOR * expected).then_some(off)
    }
}
