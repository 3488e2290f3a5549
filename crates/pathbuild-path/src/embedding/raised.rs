//! Material raised by H, and the sweeps above it. (book: language/letters)

use pathbuild_diagnostic::messages::parameters as messages;
use pathbuild_diagnostic::{Diagnostic, TextFault};

use super::signature::{PathSignature, SubpathCall};
use crate::approx::above;
use crate::element::Origin;
use crate::letter::Letter;
use crate::path::Path;

/// A Z-probe, which the tool approaches at sweep height.
#[derive(Clone, Debug, PartialEq)]
pub struct ProbeTop {
    origin: Origin,
    /// T + H in mm, above the plane of the path.
    height: f64,
    fault: Option<TextFault>,
}

impl ProbeTop {
    /// The probes of a path that are raised by H. T of the others is checked together with S.
    pub(super) fn raised(path: &Path) -> Vec<Self> {
        let top = |probe: &crate::path::Probe| {
            let fault = path.drawn.text(probe.text)?.fault_of(Letter::H)?;
            Some(Self { origin: probe.origin.clone(), height: probe.height, fault: Some(fault) })
        };
        path.probes.iter().filter_map(top).collect()
    }
}

impl PathSignature {
    /// Height in mm of the highest point of its own material and probes, above its plane.
    pub fn own_top(&self) -> f64 {
        self.raised_probes.iter().map(|probe| probe.height).fold(self.thickness, f64::max)
    }

    /// PB203 for each of its own probes that reaches the sweep height, in mm.
    pub fn raised_probe_problems(&self, sweep_height: f64) -> Vec<Diagnostic> {
        let too_high = self.raised_probes.iter().filter(|probe| !above(sweep_height, probe.height));
        let problem =
            |probe: &ProbeTop| self.reached(sweep_height, probe.height, probe.fault.clone(), &probe.origin);
        too_high.map(problem).collect()
    }

    /// PB203 if the path embedded by a segment reaches the sweep height. `top`: height in mm of everything embedded, above the plane of
    /// this path.
    pub fn raised_subpath_problem(
        &self,
        call: &SubpathCall,
        sweep_height: f64,
        top: f64,
    ) -> Option<Diagnostic> {
        let fault = call.fault(Letter::H).or_else(|| call.fault(Letter::Embed)).cloned();
        (!above(sweep_height, top)).then(|| self.reached(sweep_height, top, fault, &call.origin))
    }

    fn reached(&self, sweep_height: f64, top: f64, fault: Option<TextFault>, origin: &Origin) -> Diagnostic {
        let mut problem = Diagnostic::new(&messages::RAISED_INTO_SWEEPS)
            .with("value", sweep_height)
            .with("limit", top)
            .in_path(self.name.as_str());
        problem.text = fault;
        origin.at(problem)
    }
}
