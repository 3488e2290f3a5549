//! Checks the chip load: the thickness of the chip that each cutting edge takes.

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::parameters as say;

/// The chip load that a user allows for a tool. pathbuild recommends no values: a tool without limits causes no finding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChipLoad {
    /// The number of cutting edges.
    pub flutes: u32,
    /// Spindle speed of the tool in 1/min, used where a program sets none.
    pub speed: Option<f64>,
    /// The least chip load in mm per tooth.
    pub least: f64,
    /// The greatest chip load in mm per tooth.
    pub most: f64,
}

/// Relative difference within which a chip load counts as equal to its limit.
const RELATIVE_TOLERANCE: f64 = 1e-9;

impl ChipLoad {
    /// Reports a chip load outside the limits, for a feed in mm/min and a spindle speed in 1/min. Without a speed, the tool's own speed is used.
    pub fn check(&self, feed: f64, speed: Option<f64>) -> Option<Diagnostic> {
        let speed = speed.or(self.speed).filter(|speed| *speed > 0.0)?;
        let load = feed / (speed * f64::from(self.flutes));
        let is_small = load < self.least * (1.0 - RELATIVE_TOLERANCE);
        let is_large = load > self.most * (1.0 + RELATIVE_TOLERANCE);
        let message = if is_small { &say::CHIP_LOAD_SMALL } else { &say::CHIP_LOAD_LARGE };
        let problem = Diagnostic::new(message).with("load", rounded(load)).with("feed", feed);
        let problem = problem.with("speed", speed).with("flutes", u64::from(self.flutes));
        (is_small || is_large).then(|| problem.with("least", self.least).with("most", self.most))
    }
}

fn rounded(load: f64) -> f64 {
    const DIGITS: f64 = 1e4;
    libm::round(load * DIGITS) / DIGITS
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_limits_themselves_are_allowed() {
        let load = ChipLoad { flutes: 2, speed: Some(10_000.0), least: 0.01, most: 0.03 };
        let is_found = |feed, speed| load.check(feed, speed).is_some();
        assert_eq!([199.9, 200.0, 600.0, 600.1].map(|feed| is_found(feed, None)), [true, false, false, true]);
        assert!(is_found(600.0, Some(5_000.0)));
        assert!(!is_found(600.0, Some(0.0)), "a spindle that stands still is reported elsewhere");
        let unknown = ChipLoad { speed: None, ..load };
        assert_eq!(unknown.check(600.1, None), None);
    }
}
