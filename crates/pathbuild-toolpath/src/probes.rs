//! The order in which Z-probes are measured. (book: language/probes)

use std::collections::{BTreeMap, VecDeque};

use pathbuild_path::Xy;
use rstar::RTree;
use rstar::primitives::GeomWithData;

use crate::program::ProbePoint;

/// Distances in the tree with a smaller relative difference are considered equal and compared exactly.
const ROUNDING: f64 = 1e-12;

/// Starts at (0, 0) and repeatedly goes to the nearest probe not yet visited; the first of these if there are several.
pub(crate) fn in_order(found: &[ProbePoint]) -> Vec<ProbePoint> {
    let mut waiting = Waiting::new(found);
    let mut at = Xy::origin();
    let next = || {
        let probe = &found[waiting.take_nearest(at)?];
        at = probe.at;
        Some(probe.clone())
    };
    std::iter::from_fn(next).collect()
}

/// Probes that have not been visited yet.
struct Waiting {
    /// The probes of each place, by index.
    places: Vec<VecDeque<usize>>,
    tree: RTree<GeomWithData<[f64; 2], usize>>,
}

impl Waiting {
    fn new(found: &[ProbePoint]) -> Self {
        let mut places = BTreeMap::<_, VecDeque<usize>>::new();
        for (number, probe) in found.iter().enumerate() {
            places.entry([probe.at.x, probe.at.y].map(f64::to_bits)).or_default().push_back(number);
        }
        let points = places.keys().enumerate();
        let points = points.map(|(place, at)| GeomWithData::new(at.map(f64::from_bits), place)).collect();
        Self { tree: RTree::bulk_load(points), places: places.into_values().collect() }
    }

    fn take_nearest(&mut self, at: Xy) -> Option<usize> {
        let near = self.tree.nearest_neighbor_iter([at.x, at.y]);
        let mut near = near.map(|place| ((Xy::from(*place.geom()) - at).norm(), place)).peekable();
        let (least, _) = *near.peek()?;
        let near = near.take_while(|(distance, _)| *distance <= least * (1.0 + ROUNDING));
        let first = |place: &GeomWithData<[f64; 2], usize>| self.places[place.data].front();
        let place = *near.min_by(|(a, p), (b, q)| a.total_cmp(b).then(first(p).cmp(&first(q))))?.1;
        let number = self.places[place.data].pop_front();
        if self.places[place.data].is_empty() {
            self.tree.remove(&place);
        }
        number
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn probe((x, y): (i32, i32), number: usize) -> ProbePoint {
        let at = Xy::new(f64::from(x), f64::from(y));
        ProbePoint { at, drawn_at: at, height: 0.0, feed: 1.0, label: Some(number.to_string().into()) }
    }

    /// Compares all remaining probes in each step.
    fn one_by_one(mut found: Vec<ProbePoint>) -> Vec<ProbePoint> {
        let (mut ordered, mut at) = (Vec::new(), Xy::origin());
        while !found.is_empty() {
            let distances: Vec<f64> = found.iter().map(|probe| (probe.at - at).norm()).collect();
            let least = distances.iter().copied().fold(f64::INFINITY, f64::min);
            let next = distances.iter().position(|distance| *distance <= least).expect("the least is one");
            ordered.push(found.remove(next));
            at = ordered[ordered.len() - 1].at;
        }
        ordered
    }

    #[test]
    fn the_nearest_is_found_wherever_it_lies() {
        let grid = (0..400).map(|index| (index % 20 - 7, index / 20 - 7));
        let anywhere = (0..500).map(|index| (index * 7919 % 613, index * 104_729 % 577));
        let one_place = (0..50).map(|index| (5, index % 2));
        for points in [grid.collect::<Vec<_>>(), anywhere.collect(), one_place.collect(), Vec::new()] {
            let probes: Vec<ProbePoint> =
                points.into_iter().enumerate().map(|(number, at)| probe(at, number)).collect();
            assert_eq!(in_order(&probes), one_by_one(probes.clone()));
        }
    }
}
