//! Finished parts: their outlines, and the check that the cuts of a drawing leave them as drawn. (book: language/part)

mod bars;
mod boxes;
mod check;
mod cuts;
mod gouge;
mod intervals;
mod leftover;
mod loose;
mod prepared;

use std::fmt;

use pathbuild_diagnostic::{Diagnostic, Place};
use smol_str::SmolStr;

use crate::geometry::{Curve, Placement};
use crate::names::{LazyRegex, PathName, PatternError};

pub use check::{PartFindings, check_parts, check_path};
pub use cuts::{CutElement, PartCut, PathCuts, StandingBar};
pub use gouge::cuts_into;

/// The pattern for names of layers with finished parts. It must match the whole name, ignoring case.
#[derive(Clone)]
pub struct PartPattern {
    source: Box<str>,
    whole: LazyRegex,
}

/// Settings of the part check.
#[derive(Clone, Debug)]
pub struct PartSettings {
    /// The layers with finished parts.
    pub pattern: PartPattern,
    /// How far in mm a cut may miss the outline on either side.
    pub tolerance: f64,
    /// Whether something other than support bars holds the parts.
    pub is_held_otherwise: bool,
}

/// A finished part: its outermost ring and the openings inside it.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// The layer of its outermost ring.
    pub layer: SmolStr,
    /// The paths that may cut it: the name captured by the pattern, in upper case and with points. `None` if the pattern captures nothing.
    pub paths: Option<SmolStr>,
    /// The outermost ring, counterclockwise, then the openings, clockwise: the material is on the left.
    pub rings: Vec<PartRing>,
}

/// A closed ring of a part.
#[derive(Clone, Debug, PartialEq)]
pub struct PartRing {
    /// Its curves.
    pub curves: Vec<Curve>,
    /// Index among the rings of the opening that contains it; of an opening in no other, its own. Rings of the same nest are alternatives: a
    /// circle for the thread round a hole.
    pub nest: usize,
}

/// The parts as drawn.
#[derive(Clone, Debug, Default)]
pub struct DrawnParts {
    /// The parts in file order.
    pub parts: Vec<Part>,
    /// The places of the rings of each part in the file.
    pub places: Vec<Vec<Place>>,
    /// PB219 with its positions in the file.
    pub problems: Vec<Diagnostic>,
}

impl PartPattern {
    /// Creates a pattern from the configuration.
    ///
    /// # Errors
    /// If it is not a valid regular expression.
    pub fn new(pattern: &str) -> Result<Self, PatternError> {
        let whole = LazyRegex::new(format!("^(?:{pattern})$"));
        whole.check()?;
        Ok(Self { source: pattern.into(), whole })
    }

    /// Whether a layer holds parts.
    pub fn is_layer(&self, layer: &str) -> bool {
        self.whole.get().is_match(layer)
    }

    /// The name of a path captured from the name of a layer, see [`Part::paths`].
    pub(crate) fn paths(&self, layer: &str) -> Option<SmolStr> {
        let captures = self.whole.get().captures(layer)?;
        let name = captures.iter().skip(1).flatten().next()?.as_str();
        Some(name.replace('_', ".").to_uppercase().into())
    }
}

impl Part {
    /// Whether a path may cut the part: by default any path, otherwise the one captured by the pattern, with letters after its name at
    /// most.
    pub fn may_belong_to(&self, path: &PathName) -> bool {
        let Some(name) = &self.paths else { return true };
        let path = path.folded();
        path.strip_prefix(name.as_str()).is_some_and(|rest| rest.chars().all(char::is_alphabetic))
    }

    /// The part after placing its drawing.
    pub fn placed(&self, placement: &Placement) -> Self {
        let ring = |ring: &PartRing| PartRing {
            curves: ring.curves.iter().map(|curve| placement.place_curve(curve)).collect(),
            nest: ring.nest,
        };
        Self { rings: self.rings.iter().map(ring).collect(), ..self.clone() }
    }
}

impl fmt::Debug for PartPattern {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "/{}/", self.source)
    }
}
