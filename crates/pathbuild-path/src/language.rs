//! Settings of the drawing language. (book: reference/configuration)

use std::fmt;
use std::sync::Arc;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::parameters as messages;
use pathbuild_dxf::{Drawing, OmittedCurve};
use pathbuild_motion::ChipLoad;
use smol_str::SmolStr;

use crate::approx::above;
use crate::line_type::LineTypeAliases;
use crate::names::{LayerPattern, PathPattern};
use crate::part::PartSettings;

/// Settings of the drawing language.
#[derive(Clone, Debug)]
pub struct Language {
    /// The names of path layers.
    pub path_pattern: PathPattern,
    /// The names of layers with clamps, if configured.
    pub keep_out: Option<LayerPattern>,
    /// Settings of the part check, if configured.
    pub part: Option<PartSettings>,
    /// Additional names of line types.
    pub line_types: LineTypeAliases,
    /// Largest gap in mm that the walk closes with a warning (PB115); 0 requires ends to coincide.
    pub join_tolerance: f64,
    /// Maximum length in bytes of a value with variables substituted.
    pub text_limit: usize,
    /// Thresholds beyond which values are reported as doubtful.
    pub doubts: DoubtThresholds,
    /// Lookup of the configured tools by path.
    pub tools: PathTools,
}

/// The properties of a configured tool that checks of a path need.
#[derive(Clone, Debug, PartialEq)]
pub struct PathTool {
    /// Name of the tool: NAME in `[tool.NAME]`.
    pub name: SmolStr,
    /// Whether the configuration assigns the tool by the path's name and not only by its diameter.
    pub is_named: bool,
    /// The chip load that the user allows.
    pub chip_load: Option<ChipLoad>,
    /// Length in mm of the cutting edges, which no cut should exceed; `None` to check nothing.
    pub cutting_length: Option<f64>,
    /// Whether the tool is a slot cutter, which cuts slots that the outlines of parts do not show.
    pub is_slot_cutter: bool,
    /// Radius in mm of the corners of a bull nose or ball end mill; 0 for other tools.
    pub corner_radius: f64,
}

/// Function that finds the tool of a path by the path's name and its O in mm.
#[derive(Clone)]
pub struct PathTools(Arc<FindTool>);

type FindTool = dyn Fn(&str, f64) -> Option<PathTool> + Send + Sync;

impl PathTools {
    /// Creates a lookup from a function of a path's name and its O in mm, which returns `None` for a path without a configured tool.
    pub fn new(find: impl Fn(&str, f64) -> Option<PathTool> + Send + Sync + 'static) -> Self {
        Self(Arc::new(find))
    }

    /// Returns the tool of a path by the path's name and its O in mm; `None` if no tool is configured for it.
    pub fn of(&self, path: &str, diameter: f64) -> Option<PathTool> {
        (self.0)(path, diameter)
    }

    /// Returns the chip load that the user allows for the tool of a path.
    pub fn chip_load(&self, path: &str, diameter: f64) -> Option<ChipLoad> {
        self.of(path, diameter)?.chip_load
    }
}

impl Default for PathTools {
    fn default() -> Self {
        Self::new(|_, _| None)
    }
}

impl fmt::Debug for PathTools {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("PathTools")
    }
}

/// Thresholds beyond which values are reported as doubtful.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DoubtThresholds {
    /// Depth in mm below the plate beyond which B is doubtful.
    pub below_plate: f64,
    /// Infeed beyond which I is doubtful, as a multiple of T.
    pub infeed: f64,
    /// Depth of a mark beyond which D is doubtful, as a fraction of T.
    pub mark_depth: f64,
    /// The machine's maximum feed in mm/min.
    pub maximum_feed: Option<f64>,
    /// Whether the target may write drilled holes as canned cycles. Without canned cycles, C has no effect.
    pub has_cycles: bool,
    /// Difference in mm below which a text is doubtful because it is almost as near to another element as to its own.
    pub text_margin: f64,
    /// Excess in mm over the cutter's diameter up to which a circle is suspected to be meant as a drilled hole.
    pub hole_margin: f64,
}

impl Default for DoubtThresholds {
    fn default() -> Self {
        Self::DEFAULT
    }
}

impl DoubtThresholds {
    /// The thresholds used if the configuration sets none.
    pub const DEFAULT: Self = Self {
        below_plate: 0.5,
        infeed: 1.0,
        mark_depth: 0.5,
        maximum_feed: None,
        has_cycles: false,
        text_margin: 0.1,
        hole_margin: 0.05,
    };

    /// Returns the finding about a feed in mm/min that paths without F use, if it exceeds the machine's maximum.
    pub fn fallback_feed(&self, feed: f64) -> Option<Diagnostic> {
        let maximum = self.maximum_feed.filter(|maximum| above(feed, *maximum))?;
        let problem = Diagnostic::new(&messages::FALLBACK_FEED_ABOVE_MACHINE).with("value", feed);
        Some(problem.with("limit", maximum))
    }
}

impl Language {
    /// Whether a layer holds clamps.
    pub fn is_keep_out(&self, layer: &str) -> bool {
        self.keep_out.as_ref().is_some_and(|pattern| pattern.is_layer(layer))
    }

    /// Whether the name of a layer with clamps or finished parts may begin with this character.
    pub(crate) fn may_begin_with(&self, first: char) -> bool {
        self.patterns_beside_paths().any(|pattern| pattern.may_begin_with(first))
    }

    /// Returns the patterns for layers with clamps and with finished parts.
    pub(crate) fn patterns_beside_paths(&self) -> impl Iterator<Item = &LayerPattern> {
        self.keep_out.iter().chain(self.part.as_ref().map(|part| &part.pattern))
    }

    /// Whether the contents of a layer have a meaning: the layer belongs to a path, to clamps or to finished parts.
    fn is_read(&self, layer: &str) -> bool {
        self.path_pattern.is_layer(layer) || self.is_keep_out(layer) || self.is_part(layer)
    }

    /// Returns the curves that were left out of a drawing, except for blocks that draw on a layer with a meaning.
    pub(crate) fn left_out<'d>(&self, drawing: &'d Drawing) -> impl Iterator<Item = &'d OmittedCurve> {
        drawing.left_out.iter().filter(|left_out| !left_out.layers.iter().any(|layer| self.is_read(layer)))
    }

    /// Whether a layer holds finished parts. Layers of paths and clamps never do.
    pub fn is_part(&self, layer: &str) -> bool {
        self.part.as_ref().is_some_and(|part| part.pattern.is_layer(layer))
            && !self.path_pattern.is_layer(layer)
            && !self.is_keep_out(layer)
    }
}
