//! Colours. Kinds also differ in line style, and depths in lightness, so that they can be distinguished in print and by the colour-blind.
//! (Okabe and Ito's palette; depths from light to dark)

use crate::scene::Scene;

pub(super) const RAPID: &str = "#e69f00";
pub(super) const BAR: &str = "#cc79a7";
pub(super) const PROBE: &str = "#009e73";
pub(super) const ERROR: &str = "#d55e00";
pub(super) const WARNING: &str = "#b58900";
pub(super) const TEXT: &str = "#4a5a68";
pub(super) const OTHER: &str = "#b8bfc6";
pub(super) const INK: &str = "#14202b";
pub(super) const KERF: &str = "#e6edf3";

/// Red, green and blue from shallow to deep.
const DEPTHS: [[f64; 3]; 5] = [
    [115.0, 192.0, 232.0],
    [52.0, 148.0, 209.0],
    [24.0, 104.0, 172.0],
    [30.0, 61.0, 130.0],
    [42.0, 20.0, 84.0],
];

/// The depths of a scene.
#[derive(Clone, Copy, Debug)]
pub(super) struct Depths {
    /// The highest and the lowest Z of all cuts in mm; `None` without cuts.
    pub(super) range: Option<(f64, f64)>,
}

impl Depths {
    pub(super) fn of(scene: &Scene) -> Self {
        let moves = scene.paths.iter().flat_map(|path| &path.moves);
        let depths = moves.filter(|movement| movement.kind.cuts()).filter_map(crate::scene::Move::depth);
        let range = depths.fold(None, |range: Option<(f64, f64)>, z| {
            Some(range.map_or((z, z), |(high, low)| (high.max(z), low.min(z))))
        });
        Self { range }
    }

    /// The colour of a depth.
    pub(super) fn color(&self, z: Option<f64>) -> String {
        let share = match (self.range, z) {
            (Some((high, low)), Some(z)) if high > low => ((high - z) / (high - low)).clamp(0.0, 1.0),
            _ => 0.5,
        };
        color(share)
    }
}

/// The colour at a fraction (0 to 1) of the depth.
pub(super) fn color(share: f64) -> String {
    let last = (DEPTHS.len() - 1) as f64;
    let place = share * last;
    let stop = place.floor().min(last - 1.0);
    let [below, above] = [stop, stop + 1.0].map(|stop| DEPTHS[index(stop)]);
    let [red, green, blue] =
        [0, 1, 2].map(|part| index((below[part] + (above[part] - below[part]) * (place - stop)).round()));
    format!("#{red:02x}{green:02x}{blue:02x}")
}

/// Converts a small whole number to an index.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 255")]
fn index(value: f64) -> usize {
    value as usize
}
