use std::collections::BTreeMap;

use pathbuild_path::Xy;
use rstar::RTree;
use rstar::primitives::GeomWithData;

/// Number of probes used for a point.
const HEAVIEST: usize = 4;

/// Weights with a smaller relative difference are considered equal by the tree and ordered by index.
const ROUNDING: f64 = 1e-12;

/// The model of the original tool. (book: language/probes)
#[derive(Clone, Debug)]
pub(super) struct Nearest {
    /// Positions with the indices of their probes. Only the first few at the same position can be used.
    places: RTree<GeomWithData<[f64; 2], Vec<usize>>>,
}

impl Nearest {
    pub(super) fn new(probes: &[Xy]) -> Self {
        let mut places: BTreeMap<[u64; 2], GeomWithData<[f64; 2], Vec<usize>>> = BTreeMap::new();
        for (number, at) in probes.iter().enumerate() {
            let place = places
                .entry([at.x.to_bits(), at.y.to_bits()])
                .or_insert_with(|| GeomWithData::new([at.x, at.y], Vec::new()));
            if place.data.len() < HEAVIEST {
                place.data.push(number);
            }
        }
        Self { places: RTree::bulk_load(places.into_values().collect()) }
    }

    /// The probes with the greatest weights in descending order; equal weights are ordered by index.
    pub(super) fn weights(&self, at: Xy) -> Vec<(usize, f64)> {
        let mut weights: Vec<(usize, f64)> = Vec::new();
        for place in self.places.nearest_neighbor_iter([at.x, at.y]) {
            let weight = 1.0 / ((Xy::from(*place.geom()) - at).norm() + 0.001);
            // All further probes have lower weights.
            if weights.get(HEAVIEST - 1).is_some_and(|(_, least)| weight < least * (1.0 - ROUNDING)) {
                break;
            }
            weights.extend(place.data.iter().map(|probe| (*probe, weight)));
        }
        weights.sort_unstable_by(|(a, of_a), (b, of_b)| of_b.total_cmp(of_a).then(a.cmp(b)));
        weights.truncate(HEAVIEST);
        let sum: f64 = weights.iter().map(|(_, weight)| weight).sum();
        weights.into_iter().map(|(probe, weight)| (probe, weight / sum)).collect()
    }
}
