use pathbuild_path::Xy;

/// How many probes count at a point.
const HEAVIEST: usize = 4;

/// The compatible model. (book: language/probes)
#[derive(Clone, Debug)]
pub(super) struct Nearest {
    places: Vec<Xy>,
}

impl Nearest {
    pub(super) fn new(places: Vec<Xy>) -> Self {
        Self { places }
    }

    /// The heaviest probes in falling order, in order of number where equal.
    pub(super) fn weights(&self, at: Xy) -> Vec<(usize, f64)> {
        let weight = |place: &Xy| 1.0 / ((place - at).norm() + 0.001);
        let mut weights: Vec<(usize, f64)> = self.places.iter().map(weight).enumerate().collect();
        weights.sort_by(|(_, a), (_, b)| b.total_cmp(a));
        weights.truncate(HEAVIEST);
        let sum: f64 = weights.iter().map(|(_, weight)| weight).sum();
        weights.into_iter().map(|(probe, weight)| (probe, weight / sum)).collect()
    }
}
