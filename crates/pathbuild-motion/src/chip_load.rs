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

/// Relative difference within which a chip load is considered equal to its limit.
const RELATIVE_TOLERANCE: f64 = 1e-9;

impl ChipLoad {
    /// Reports a chip load outside the limits, for a feed in mm/min and a spindle speed in 1/min. Without a speed, that of the tool is used; nothing
    /// is reported if the tool has none either, or if the spindle stands still.
    pub fn check(&self, feed: f64, speed: Option<f64>) -> Option<Diagnostic> {
        let speed = speed.or(self.speed).filter(|speed| *speed > 0.0)?;
        let load = feed / (speed * f64::from(self.flutes));
        let is_small = load < self.least * (1.0 - RELATIVE_TOLERANCE);
        let is_large = load > self.most * (1.0 + RELATIVE_TOLERANCE);
        let message = if is_small { &say::CHIP_LOAD_SMALL } else { &say::CHIP_LOAD_LARGE };
        let limit = if is_small { self.least } else { self.most };
        let problem = Diagnostic::new(message).with("load", rounded(load, limit)).with("feed", feed);
        let problem = problem.with("speed", speed).with("flutes", u64::from(self.flutes));
        (is_small || is_large).then(|| problem.with("least", self.least).with("most", self.most))
    }
}

/// Rounds a chip load for a message, finely enough that it differs from the limit.
fn rounded(load: f64, limit: f64) -> f64 {
    const DIGITS: [f64; 5] = [1e4, 1e5, 1e6, 1e7, 1e8];
    let mut rounded = DIGITS.into_iter().map(|digits| libm::round(load * digits) / digits);
    rounded.find(|rounded| *rounded != limit).unwrap_or(load)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_load_is_told_so_that_it_differs_from_the_limit() {
        assert_eq!(rounded(0.012_345, 0.01), 0.0123);
        assert_eq!(rounded(0.004_95, 0.005), 0.004_95);
    }

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
