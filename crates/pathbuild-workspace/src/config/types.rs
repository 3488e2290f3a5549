//! Configuration values that are more complex than a number or a string.

use camino::Utf8PathBuf;
use globset::{GlobBuilder, GlobSet};
use pathbuild_diagnostic::limits::text_too_long;
use pathbuild_diagnostic::{Code, Lang, Severity, Value};
use pathbuild_dxf::Units;
use pathbuild_gcode::dialect::Charset;
use pathbuild_gcode::verify::Cutter;
use pathbuild_motion::{ChipLoad, Coolant, Turning};
use pathbuild_path::LineType;
use pathbuild_toolpath::ZModel;
use serde::{Deserialize, Serialize};

use crate::waivers::Waiver;

/// Declares a choice: an enum with the texts that stand for its variants.
macro_rules! choice {
    ($(#[$doc:meta])* $name:ident { $($(#[$variant_doc:meta])* $variant:ident = $text:literal,)* }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
        pub enum $name { $($(#[$variant_doc])* $variant,)* }

        impl Choice for $name {
            const ALL: &[(&str, Self)] = &[$(($text, Self::$variant),)*];
        }
    };
}

/// A configuration value from a fixed list.
pub(crate) trait Choice: Copy + PartialEq + 'static {
    const ALL: &[(&str, Self)];
}

impl Choice for Units {
    const ALL: &[(&str, Self)] =
        &[("header", Self::Header), ("drawing", Self::Drawing), ("mm", Self::Millimetres)];
}

impl Choice for Charset {
    const ALL: &[(&str, Self)] = &[("ascii", Self::Ascii), ("utf-8", Self::Utf8)];
}

impl Choice for ZModel {
    const ALL: &[(&str, Self)] = &[("idw4", Self::Idw4), ("plane", Self::Plane), ("tin", Self::Tin)];
}

impl Choice for Turning {
    const ALL: &[(&str, Self)] = &[("cw", Self::Clockwise), ("ccw", Self::CounterClockwise)];
}

impl Choice for Coolant {
    const ALL: &[(&str, Self)] = &[("off", Self::OFF), ("mist", Self::MIST), ("flood", Self::FLOOD)];
}

impl Choice for LineType {
    const ALL: &[(&str, Self)] = &Self::NAMES;
}

impl Choice for Lang {
    const ALL: &[(&str, Self)] = &[("en", Self::En), ("de", Self::De)];
}

choice! {
    /// The means by which a part is held while it is cut out of the plate. (book: language/part)
    PartHolding {
        /// Support bars hold the part.
        Bars = "bars",
        /// The part is held by something that no drawing shows, for example tape or vacuum.
        Otherwise = "otherwise",
    }
}

choice! {
    /// The shape of a cutter, which determines the area that it cuts. (book: language/part)
    CutterShape {
        /// A cylinder: it cuts the area that its diameter sweeps.
        EndMill = "end-mill",
        /// A T-slot or side milling cutter: it cuts a slot beside or below the area that its diameter sweeps.
        Slot = "slot",
        /// A V-bit, drill or engraver: the width of the cut depends on the depth.
        Other = "other",
    }
}

choice! {
    /// A check that `verify` must make. (book: program/reading)
    Requirement {
        /// Rapid moves must not enter material. Values from comments of the program do not suffice for this check.
        Rapids = "rapids",
        /// Rapid moves must not enter material. Values from comments of the program suffice for this check.
        AssumedRapids = "rapids=assumed",
        /// Moves must stay within the travel of the machine.
        Envelope = "envelope",
        /// Feeds must not exceed the machine's maximum.
        Feeds = "feeds",
        /// The spindle speed must be within the machine's range.
        Spindle = "spindle",
        /// The moves must be those of the drawing.
        Drawing = "drawing",
        /// Moves must not enter the clamps in the drawing.
        Clamps = "clamps",
        /// The control must round corners by no more than the program permits. Applies only to controls that take such a limit.
        Corners = "corners",
        /// The coolant must be that of the drawing's tool, if the program switches any on.
        Coolant = "coolant",
    }
}

impl Requirement {
    /// Iterates over the names of all requirements.
    pub fn names() -> impl Iterator<Item = &'static str> {
        Self::ALL.iter().map(|(name, _)| *name)
    }

    /// Finds the requirement with this name.
    pub fn named(text: &str) -> Option<Self> {
        Self::ALL.iter().find(|(name, _)| *name == text).map(|(_, requirement)| *requirement)
    }

    /// Returns the requirement's name in the configuration.
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|(_, requirement)| *requirement == self).map_or("", |(name, _)| name)
    }
}

choice! {
    /// File format of the setup sheet. (book: program/sheet)
    SheetFormat {
        /// No setup sheet is written.
        No = "none",
        /// Pages for printing.
        Pdf = "pdf",
        /// The content of the PDF as a page for a browser.
        Html = "html",
        /// The content of the PDF as a single picture.
        Svg = "svg",
    }
}

choice! {
    /// The level at which a diagnostic is reported, or `Ignore` to suppress it.
    Level {
        /// The diagnostic is reported as an error.
        Error = "error",
        /// The diagnostic is reported as a warning.
        Warning = "warning",
        /// The diagnostic is not reported.
        Ignore = "ignore",
    }
}

impl Level {
    /// Returns the severity; `None` if the diagnostic is ignored.
    pub fn severity(self) -> Option<Severity> {
        match self {
            Self::Error => Some(Severity::Error),
            Self::Warning => Some(Severity::Warning),
            Self::Ignore => None,
        }
    }
}

/// A further name for a line type.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LineTypeAlias {
    /// Name of the line type in drawings.
    pub name: Box<str>,
    /// The line type that the name stands for.
    pub line_type: LineType,
}

/// A rule for embedding: paths matched by `parent` may embed only paths matched by `child`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Restriction {
    /// Regular expression searched in the embedding path's name.
    pub parent: Box<str>,
    /// Regular expression searched in the embedded path's name.
    pub child: Box<str>,
}

/// A glob for names of paths, or for files relative to the configuration's directory. Ignores case.
#[derive(Clone, Debug)]
pub struct Pattern {
    text: Box<str>,
    set: GlobSet,
}

/// Upper bound on the length of a glob in bytes: nested braces need a deep stack.
const MAX_GLOB_BYTES: usize = 1000;

impl Pattern {
    /// Compiles a glob, in which `*` does not match `/`.
    ///
    /// # Errors
    /// If the glob is invalid or too long, with a description of the fault.
    pub fn new(text: &str) -> Result<Self, Value> {
        if text.len() > MAX_GLOB_BYTES {
            return Err(text_too_long(MAX_GLOB_BYTES).into());
        }
        let glob = GlobBuilder::new(text).literal_separator(true).case_insensitive(true).build();
        // Build a set because a single matcher would panic where a set returns an error: if the expression is too large or its braces are
        // nested too deeply.
        let set = glob.and_then(|glob| GlobSet::builder().add(glob).build());
        set.map(|set| Self { text: text.into(), set }).map_err(|error| Value::foreign(error.kind()))
    }

    /// Whether the glob matches a name.
    pub fn matches(&self, name: &str) -> bool {
        self.set.is_match(name)
    }

    /// Returns the only name that the glob matches; `None` if the glob contains a wildcard.
    pub fn literal(&self) -> Option<&str> {
        (!self.text.contains(['*', '?', '[', '{', '\\'])).then_some(&*self.text)
    }

    /// Returns the glob as it was written.
    pub fn text(&self) -> &str {
        &self.text
    }
}

/// Severity levels for the diagnostics of some drawings or programs.
#[derive(Clone, Debug, Default)]
pub struct FileSeverities {
    /// Globs of the drawings or programs, relative to the configuration's directory.
    pub files: Vec<Pattern>,
    /// Levels by code.
    pub levels: Vec<(Code, Level)>,
    /// The reason for these levels, and the last day on which they hold.
    pub waiver: Waiver,
}

impl FileSeverities {
    /// Whether the entry applies to `file`, a name relative to the configuration's directory, with slashes.
    pub fn concerns(&self, file: &str) -> bool {
        self.files.iter().any(|pattern| pattern.matches(file))
    }
}

pub(crate) fn level_in(levels: &[(Code, Level)], code: Code) -> Option<Level> {
    levels.iter().find(|(known, _)| *known == code).map(|(_, level)| *level)
}

/// A configured tool: its cutter, its number on the machine, and the spindle speed and coolant to use. (book: program/posts)
#[derive(Clone, Debug, PartialEq)]
pub struct Tool {
    /// Name of the tool's table.
    pub name: Box<str>,
    /// Diameter in mm; the tool suits paths with this O.
    pub diameter: f64,
    /// Regular expression searched in path names, to find the paths that the tool is for; `None` means all paths with its diameter.
    pub paths: Option<Box<str>>,
    /// Shape of the cutter.
    pub shape: CutterShape,
    /// Number of the tool in the machine's tool table or magazine.
    pub number: Option<u32>,
    /// Spindle speed in 1/min.
    pub spindle: Option<f64>,
    /// Direction of rotation; `None` means clockwise, or the operator's choice if there is no speed either.
    pub direction: Option<Turning>,
    /// Coolant; `None` leaves the choice to the operator.
    pub coolant: Option<Coolant>,
    /// Number of cutting edges.
    pub flutes: Option<u32>,
    /// Limits of the chip load in mm per tooth.
    pub chip_load: Option<NumberRange>,
    /// Radius in mm of the corners of a bull nose or ball end mill.
    pub corner_radius: f64,
    /// Length in mm of the cutting edges.
    pub length: Option<f64>,
}

impl Tool {
    /// Returns the limits of the chip load together with the number of flutes; `None` if either is not configured.
    pub fn chip_load(&self) -> Option<ChipLoad> {
        let NumberRange { from, to } = self.chip_load?;
        Some(ChipLoad { flutes: self.flutes?, speed: self.spindle, least: from, most: to })
    }

    /// Returns the length in mm of the cutting edges, which no cut should exceed in depth; `None` if it is not configured, and for a slot cutter,
    /// whose cutting edges lie below the surface.
    pub fn cutting_length(&self) -> Option<f64> {
        self.length.filter(|_| self.shape != CutterShape::Slot)
    }

    /// Returns the direction of rotation; `None` if the operator chooses it.
    pub fn turning(&self) -> Option<Turning> {
        self.direction.or(self.spindle.map(|_| Turning::Clockwise))
    }

    /// Returns the cutter for the check of rapid moves, in which only the flat part of the tip counts, both for removing material and for hitting it.
    /// A tool without a flat tip fits into the cut that it made, so only the centre line of its moves is considered.
    pub fn cutter(&self) -> Cutter {
        let corner_radius = (self.shape != CutterShape::Other).then_some(self.corner_radius);
        let flat = corner_radius.map_or(0.0, |radius| (self.diameter - 2.0 * radius).max(0.0));
        Cutter { diameter: self.diameter, removed: flat, colliding: flat, corner_radius }
    }
}

/// The configured post-processor. (book: program/posts)
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PostChoice {
    /// Name of a built-in post-processor, or path of a file that defines one.
    pub name: Box<str>,
    /// Whether to write programs that cannot be read back. The user takes responsibility for them.
    pub unchecked: bool,
    /// Program number for controls that call programs by number; `None` derives it from the path's name.
    pub program_number: Option<u32>,
}

impl From<&str> for PostChoice {
    fn from(name: &str) -> Self {
        Self { name: name.into(), unchecked: false, program_number: None }
    }
}

choice! {
    /// The control of the spindle: by the program or by the operator.
    SpindleControl {
        /// The program controls the spindle, with the speeds of the configured tools.
        Tool = "tool",
        /// The operator controls the spindle: programs neither start nor stop it.
        Manual = "manual",
    }
}

choice! {
    /// Unit of dwell times in programs, for controls on which it can be configured.
    DwellTime {
        /// Seconds, as in the controls' manuals.
        Seconds = "seconds",
        /// Milliseconds, an option of Mach3 (Config > Logic).
        Milliseconds = "milliseconds",
    }
}

/// A range with a lower and an upper end, such as the travel of an axis in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NumberRange {
    /// Lower end of the range.
    pub from: f64,
    /// Upper end of the range.
    pub to: f64,
}

/// Directories, absolute or relative to the working directory.
pub type Directories = Vec<Utf8PathBuf>;
