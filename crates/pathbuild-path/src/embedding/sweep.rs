//! Lower limits for the sweep height of paths whose S depends on their role. (book: language/letters)

use std::iter;

use pathbuild_diagnostic::messages::parameters as messages;
use pathbuild_diagnostic::{Diagnostic, TextFault};

use crate::approx::above;
use crate::element::Origin;
use crate::letter::Letter;
use crate::names::SpeltName;
use crate::path::{Path, Segment, SegmentKind};
use crate::text::TextId;

/// The upper faces that a path's sweeps must clear. Empty if the path gives its own S, which is checked together with its other values.
#[derive(Clone, Debug, PartialEq)]
pub struct SweepLimits {
    path: SpeltName,
    faces: Box<[Face]>,
}

/// An upper face of the material.
#[derive(Clone, Debug, PartialEq)]
struct Face {
    /// The element that gives T.
    origin: Origin,
    /// T in mm.
    thickness: f64,
    fault: Option<TextFault>,
}

impl SweepLimits {
    /// The limits of a path: T of the path itself, of its probes and of its subpath segments.
    pub fn of(path: &Path) -> Self {
        let Some(surface) = &path.surface else {
            return Self { path: path.name.clone(), faces: Box::default() };
        };
        let face = |origin: Origin, thickness: f64, text: Option<TextId>| {
            let fault = path.drawn.text(text).and_then(|text| text.fault_of(Letter::T));
            Face { origin, thickness, fault }
        };
        let own = iter::once(surface).chain(&path.probe_surfaces);
        let own = own.map(|surface| face(surface.origin.clone(), surface.thickness, surface.text));
        let of_segment = |segment: &Segment| match &segment.kind {
            SegmentKind::Subpath(subpath) if path.drawn.text(subpath.text)?.letters.contains(Letter::T) => {
                Some(face(path.origin(segment), subpath.thickness, subpath.text))
            }
            _ => None,
        };
        let faces = own.chain(path.segments.iter().filter_map(of_segment)).collect();
        Self { path: path.name.clone(), faces }
    }

    /// PB203 for each face that a sweep height in mm does not clear.
    pub fn check(&self, height: f64) -> Vec<Diagnostic> {
        let too_high = self.faces.iter().filter(|face| !above(height, face.thickness));
        let problem = |face: &Face| {
            let mut problem = Diagnostic::new(&messages::DEFAULT_SWEEP_TOO_LOW)
                .with("value", height)
                .with("limit", face.thickness)
                .in_path(self.path.as_str());
            problem.text.clone_from(&face.fault);
            face.origin.at(problem)
        };
        too_high.map(problem).collect()
    }
}
