//! Keep-outs: clamps that the tool must not come into below their height. (book: language/keep-outs)

mod map;
mod outline;

use std::fmt;

use pathbuild_diagnostic::Diagnostic;
use smol_str::SmolStr;

use crate::geometry::{Curve, Placement, Xy};
use crate::pattern::{LazyRegex, PatternError};

pub use map::{KeepOutMap, Way};

/// Which layers hold clamps: the name matches as a whole, without regard to case.
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
    /// Where its outline begins; of a circle the centre.
    pub at: Xy,
    /// Its height in mm, above the plate or what its drawing is raised to.
    pub height: f64,
    /// Its outline: curves that meet, end to start, all around. A circle is one arc.
    pub outline: Vec<Curve>,
}

/// The clamps of a drawing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct KeepOuts {
    /// Those of which nothing is wrong, layer by layer in the order of the file.
    pub all: Vec<KeepOut>,
    /// What is wrong, with its place in the file. While there is an error, it is not known where clamps are.
    pub problems: Vec<Diagnostic>,
}

impl KeepOutPattern {
    /// A pattern of the configuration.
    ///
    /// # Errors
    /// When it is no regular expression.
    pub fn new(pattern: &str) -> Result<Self, PatternError> {
        let whole = LazyRegex::new(format!("^(?:{pattern})$"));
        whole.check()?;
        Ok(Self { source: pattern.into(), whole })
    }

    /// Whether a layer holds clamps.
    pub fn is_layer(&self, layer: &str) -> bool {
        self.whole.get().is_match(layer)
    }

    /// The regular expression as it was given.
    pub fn as_str(&self) -> &str {
        &self.source
    }
}

impl KeepOut {
    /// The clamp where it stands when its drawing is placed and raised.
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
