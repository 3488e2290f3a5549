//! Finds probes that do not fit their neighbours. (PB607)
//!
//! Each probe is compared with the plane through all the others. It is odd if its distance from that plane exceeds [`LEAST`] and also
//! [`FACTOR`] times the scatter of the others around it (externally studentized residual). So a bent sheet, on which all probes
//! scatter, has no odd probes, but a single typing error stands out. This requires five probes: three others always lie on a plane,
//! so that with four it is impossible to tell which one is wrong.

use nalgebra::Matrix2;
use pathbuild_path::Xy;

use super::scatter::Scatter;

/// Distance in mm below which a probe is never odd, however well the others fit.
const LEAST: f64 = 0.1;

/// Minimum ratio of the distance to the scatter of the others.
const FACTOR: f64 = 4.0;

/// Degrees of freedom of a plane.
const FREEDOM: f64 = 3.0;

/// A probe that does not fit its neighbours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OddProbe {
    /// Index of the probe, in the given order.
    pub probe: usize,
    /// Height above the plane through the others, in mm.
    pub off: f64,
}

/// Returns the odd probes in order. Each probe is given by its position and by how much higher than drawn it was measured, in mm.
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

/// The plane through all probes, and their scatter around it.
struct Fit {
    scatter: Scatter,
    inverse: Matrix2<f64>,
    mean: f64,
    slope: nalgebra::Vector2<f64>,
    /// Sum of squared distances, in mm².
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

    /// The distance of a probe from the plane through the others, if it is odd. That plane need not be fitted: the influence of a probe on
    /// the
    /// plane through all of them tells how far it has pulled that plane.
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
