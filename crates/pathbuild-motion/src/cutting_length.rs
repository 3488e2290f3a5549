//! Checks the depth of cuts against the length of the cutting edges.

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::parameters as say;

/// Excess in mm up to which a cut counts as no deeper than the cutting edges are long: programs round Z, those in inches to four decimals.
const TOLERANCE: f64 = 0.005;

/// Reports a cut that is deeper than the cutting edges of its tool are long: above them, the shank rubs against the material. `length` is the length
/// of the edges in mm; `bottom` and `surface` are Z in mm of the lowest point of the cut and of the material's upper face.
pub fn check_cutting_length(length: f64, bottom: f64, surface: f64) -> Option<Diagnostic> {
    let depth = surface - bottom;
    let problem = || Diagnostic::new(&say::CUT_DEEPER_THAN_EDGES).with("bottom", bottom).with("depth", depth);
    (depth > length + TOLERANCE).then(|| problem().with("length", length))
}
