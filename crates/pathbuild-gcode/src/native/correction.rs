//! The formula by which measured probes correct a height. (spec/70-z-probes.md, "The formula")

use pathbuild_toolpath::{ProbePoint, Xy};

use super::number::push_f3;

/// Numbers of the parameters: the first probe is #51.
pub(crate) const FIRST_PARAMETER: usize = 51;

/// How many probes count at a point.
const HEAVIEST: usize = 4;

/// Appends `(=z+w*[#51-th]...)` for a height at a point; nothing without probes.
pub(super) fn push_formula(text: &mut String, probes: &[ProbePoint], z: f64, at: Xy) {
    if probes.is_empty() {
        return;
    }
    text.push_str("(=");
    push_f3(text, z);
    for (index, weight) in weights(probes, at) {
        text.push('+');
        push_f3(text, weight);
        text.push_str("*[#");
        text.push_str(&(FIRST_PARAMETER + index).to_string());
        text.push('-');
        push_f3(text, probes[index].height);
        text.push(']');
    }
    text.push(')');
}

/// The heaviest probes at a point in falling order (in order of number where equal), with weights that sum to 1.
fn weights(probes: &[ProbePoint], at: Xy) -> Vec<(usize, f64)> {
    let weight = |probe: &ProbePoint| 1.0 / ((probe.at - at).norm() + 0.001);
    let mut weights: Vec<(usize, f64)> = probes.iter().map(weight).enumerate().collect();
    weights.sort_by(|(_, a), (_, b)| b.total_cmp(a));
    weights.truncate(HEAVIEST);
    let sum: f64 = weights.iter().map(|(_, weight)| weight).sum();
    weights.iter_mut().for_each(|(_, weight)| *weight /= sum);
    weights
}
