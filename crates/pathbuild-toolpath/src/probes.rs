//! The order in which Z-probes are measured. (book: language/probes)

use pathbuild_path::Xy;

use crate::program::ProbePoint;

/// From (0, 0) always to the nearest probe not yet visited; the first found on a tie.
pub(crate) fn in_order(mut found: Vec<ProbePoint>) -> Vec<ProbePoint> {
    let mut ordered = Vec::with_capacity(found.len());
    let mut at = Xy::origin();
    while let Some(next) = nearest(&found, at) {
        let probe = found.remove(next);
        at = probe.at;
        ordered.push(probe);
    }
    ordered
}

fn nearest(probes: &[ProbePoint], at: Xy) -> Option<usize> {
    let distances = probes.iter().map(|probe| (probe.at - at).norm()).enumerate();
    distances.reduce(|best, other| if other.1 < best.1 { other } else { best }).map(|(index, _)| index)
}
