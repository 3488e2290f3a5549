//! Checks for values that are permitted but suspicious to a machinist: PB211. (book: language/letters)

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::parameters as messages;

use crate::approx::above;
use crate::letter::Letter;
use crate::matrix::{ElementClass, Use};
use crate::values::Values;

/// Thresholds beyond which something is doubtful.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DoubtThresholds {
    /// Depth in mm that B may extend below the plate.
    pub below_plate: f64,
    /// Maximum infeed as a multiple of T.
    pub infeed: f64,
    /// Maximum depth of a mark as a fraction of T.
    pub mark_depth: f64,
    /// The machine's largest feed in mm/min.
    pub maximum_feed: Option<f64>,
    /// Minimum difference in mm between the distances of a text from its element and from another one.
    pub text_margin: f64,
    /// Excess in mm over the cutter's diameter up to which a circle is suspected to be meant as a drilled hole.
    pub hole_margin: f64,
}

impl Default for DoubtThresholds {
    fn default() -> Self {
        Self::DEFAULT
    }
}

impl DoubtThresholds {
    /// The thresholds used if the configuration sets none.
    pub const DEFAULT: Self = Self {
        below_plate: 0.5,
        infeed: 1.0,
        mark_depth: 0.5,
        maximum_feed: None,
        text_margin: 0.1,
        hole_margin: 0.05,
    };

    /// The finding about the feed in mm/min that applies to paths without F.
    pub fn fallback_feed(&self, feed: f64) -> Option<Diagnostic> {
        let maximum = self.maximum_feed.filter(|maximum| above(feed, *maximum))?;
        let problem = Diagnostic::new(&messages::FALLBACK_FEED_ABOVE_MACHINE).with("value", feed);
        Some(problem.with("limit", maximum))
    }
}

/// The finding about a mark with this bottom in mm. `is_path`: whether that is the path's D rather than the mark's own.
pub(crate) fn check_mark(
    bottom: f64,
    own: &Values<'_>,
    path: &Values<'_>,
    limits: &DoubtThresholds,
) -> Option<(Diagnostic, bool)> {
    let thickness = path.number(Letter::T).number()?;
    let depth = thickness - bottom;
    if !above(depth, limits.mark_depth * thickness) {
        return None;
    }
    let is_own = own.has(Letter::D);
    let message = if is_own { &messages::DEEP_MARK } else { &messages::DEEP_MARKS_OF_PATH };
    let problem = Diagnostic::new(message)
        .with("value", bottom)
        .with("depth", depth)
        .with("thickness", thickness)
        .with("example", thickness - thickness.min(SHALLOW));
    let says = if is_own { own } else { path };
    Some((says.underline(Letter::D, problem), !is_own))
}

/// A usual depth of a mark in mm, for help.
const SHALLOW: f64 = 0.2;

/// Findings about the values that `own` gives and that have an effect on the element. `path`: the values of the path.
pub(crate) fn check(
    own: &Values<'_>,
    path: &Values<'_>,
    class: ElementClass,
    limits: &DoubtThresholds,
) -> Vec<Diagnostic> {
    let value = |letter| {
        let has_effect = !matches!(class.use_of(letter), Use::Unknown | Use::Ignored | Use::PathOnly);
        own.number(letter).number().filter(|_| has_effect)
    };
    let thickness = path.number(Letter::T).number();
    let below = value(Letter::B).filter(|bottom| above(-bottom, limits.below_plate)).map(|bottom| {
        let depth = -bottom;
        let problem = match thickness.filter(|thickness| above(*thickness, depth)) {
            Some(thickness) => Diagnostic::new(&messages::BELOW_PLATE_BY_DEPTH)
                .with("thickness", thickness)
                .with("example", thickness - depth),
            None => Diagnostic::new(&messages::BELOW_PLATE),
        };
        let problem = problem.with("value", bottom).with("depth", depth).with("limit", limits.below_plate);
        own.underline(Letter::B, problem)
    });
    let infeed = value(Letter::I)
        .zip(thickness)
        .filter(|(infeed, thickness)| above(*infeed, limits.infeed * thickness));
    let infeed = infeed.map(|(infeed, thickness)| {
        let problem = Diagnostic::new(&messages::INFEED_ABOVE_THICKNESS).with("value", infeed);
        own.underline(Letter::I, problem.with("thickness", thickness))
    });
    let feed = value(Letter::F).zip(limits.maximum_feed).filter(|(feed, maximum)| above(*feed, *maximum));
    let feed = feed.map(|(feed, maximum)| {
        let problem = Diagnostic::new(&messages::FEED_ABOVE_MACHINE).with("value", feed);
        own.underline(Letter::F, problem.with("limit", maximum))
    });
    [below, infeed, feed].into_iter().flatten().collect()
}
