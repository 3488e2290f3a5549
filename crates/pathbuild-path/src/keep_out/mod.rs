//! Keep-outs: clamps that the tool must not enter below their height. (book: language/keep-outs)

mod map;
mod outline;

use std::fmt;

use pathbuild_diagnostic::Diagnostic;
use smol_str::SmolStr;

use crate::geometry::{Curve, Placement, Xy};
use crate::names::{LazyRegex, PatternError};

pub use map::{KeepOutMap, Way};
pub(crate) use outline::{Outline, around};

/// The pattern for names of layers with clamps. It must match the whole name, ignoring case.
#[derive(Clone)]
pub struct KeepOutPattern {
    source: Box<str>,
    whole: LazyRegex,
}

/// A clamp.
#[derive(Clone, Debug, PartialEq)]
pub struct KeepOut {
    /// Its layer.
    pub layer: SmolStr,
    /// The start of its outline; for a circle, the centre.
    pub at: Xy,
    /// Its height in mm, above the plate or above the level that its drawing is raised to.
    pub height: f64,
    /// Its outline: a closed sequence of curves. A circle is a single arc.
    pub outline: Vec<Curve>,
}

/// The clamps of a drawing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct KeepOuts {
    /// The valid clamps, layer by layer in file order.
    pub all: Vec<KeepOut>,
    /// Findings with their positions in the file. If any is an error, the clamps are not fully known.
    pub problems: Vec<Diagnostic>,
}

impl KeepOutPattern {
    /// Creates a pattern from the configuration.
    ///
    /// # Errors
    /// If it is not a valid regular expression.
    pub fn new(pattern: &str) -> Result<Self, PatternError> {
        let whole = LazyRegex::new(format!("^(?:{pattern})$"));
        whole.check()?;
        Ok(Self { source: pattern.into(), whole })
    }

    /// Whether a layer holds clamps.
    pub fn is_layer(&self, layer: &str) -> bool {
        self.whole.get().is_match(layer)
    }

    /// The regular expression as given.
    pub fn as_str(&self) -> &str {
        &self.source
    }
}

impl KeepOut {
    /// The clamp after placing and raising its drawing.
    pub fn placed(&self, placement: &Placement, raised: f64) -> Self {
        Self {
            layer: self.layer.clone(),
            at: placement.place(self.at),
            height: self.height + raised,
            outline: self.outline.iter().map(|curve| placement.place_curve(curve)).collect(),
        }
    }
}

impl fmt::Debug for KeepOutPattern {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "/{}/", self.source)
    }
}
