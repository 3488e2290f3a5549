//! Values more complex than a number or a string.

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

/// A value from a fixed list.
pub(crate) trait Choice: Copy + PartialEq + 'static {
    /// All values with their texts.
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

/// The directions in which a tool may turn.
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
    /// What holds a part that is cut out of the plate. (book: language/part)
    PartHolding {
        /// Support bars.
        Bars = "bars",
        /// Something that no drawing shows: tape, vacuum.
        Otherwise = "otherwise",
    }
}

choice! {
    /// What a cutter cuts. (book: language/part)
    CutterShape {
        /// The area that its diameter sweeps.
        EndMill = "end-mill",
        /// A slot beside or below that area: T-slot and side milling cutters.
        Slot = "slot",
        /// A shape that depends on the depth: V-bits, drills, engravers.
        Other = "other",
    }
}

choice! {
    /// A check that `verify` must make. (book: program/reading)
    Requirement {
        /// Rapid moves into material; values from comments of the program do not suffice.
        Rapids = "rapids",
        /// Rapid moves into material; values from comments suffice.
        AssumedRapids = "rapids=assumed",
        /// The travel of the machine.
        Envelope = "envelope",
        /// The machine's largest feed.
        Feeds = "feeds",
        /// The range of the spindle's speed.
        Spindle = "spindle",
        /// The moves of the drawing.
        Drawing = "drawing",
        /// The clamps in the drawing.
        Clamps = "clamps",
    }
}

impl Requirement {
    /// All names.
    pub fn names() -> impl Iterator<Item = &'static str> {
        Self::ALL.iter().map(|(name, _)| *name)
    }

    /// The requirement with this name.
    pub fn named(text: &str) -> Option<Self> {
        Self::ALL.iter().find(|(name, _)| *name == text).map(|(_, requirement)| *requirement)
    }

    /// The name.
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|(_, requirement)| *requirement == self).map_or("", |(name, _)| name)
    }
}

choice! {
    /// File format of the setup sheet. (book: program/sheet)
    SheetFormat {
        /// No setup sheet.
        No = "none",
        /// Pages to print.
        Pdf = "pdf",
        /// The same content for a browser.
        Html = "html",
        /// The same content as a single picture.
        Svg = "svg",
    }
}

choice! {
    /// How a diagnostic is reported.
    Level {
        /// Reported as an error.
        Error = "error",
        /// Reported as a warning.
        Warning = "warning",
        /// Not reported.
        Ignore = "ignore",
    }
}

impl Level {
    /// The severity; `None` if the diagnostic is ignored.
    pub fn severity(self) -> Option<Severity> {
        match self {
            Self::Error => Some(Severity::Error),
            Self::Warning => Some(Severity::Warning),
            Self::Ignore => None,
        }
    }
}

/// An alias of a line type.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LineTypeAlias {
    /// Name in drawings.
    pub name: Box<str>,
    /// The line type that it stands for.
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
    /// A description of the error.
    pub fn new(text: &str) -> Result<Self, Value> {
        if text.len() > MAX_GLOB_BYTES {
            return Err(text_too_long(MAX_GLOB_BYTES).into());
        }
        let glob = GlobBuilder::new(text).literal_separator(true).case_insensitive(true).build();
        // Build a set because a single matcher would panic where a set returns an error: if the expression is too large or its braces are
        // nested too deep.
        let set = glob.and_then(|glob| GlobSet::builder().add(glob).build());
        set.map(|set| Self { text: text.into(), set }).map_err(|error| Value::foreign(error.kind()))
    }

    /// Whether a name matches.
    pub fn matches(&self, name: &str) -> bool {
        self.set.is_match(name)
    }

    /// The only name that it matches, if it contains no wildcard.
    pub fn literal(&self) -> Option<&str> {
        (!self.text.contains(['*', '?', '[', '{', '\\'])).then_some(&*self.text)
    }

    /// The glob as it was written.
    pub fn text(&self) -> &str {
        &self.text
    }
}

/// Levels for some drawings.
#[derive(Clone, Debug, Default)]
pub struct FileSeverities {
    /// The drawings, relative to the configuration's directory.
    pub files: Vec<Pattern>,
    /// Levels of codes.
    pub levels: Vec<(Code, Level)>,
    /// Why, and for how long.
    pub waiver: Waiver,
}

impl FileSeverities {
    /// Whether the entry concerns a file, which is named relative to the configuration's directory, with slashes.
    pub fn concerns(&self, file: &str) -> bool {
        self.files.iter().any(|pattern| pattern.matches(file))
    }
}

pub(crate) fn level_in(levels: &[(Code, Level)], code: Code) -> Option<Level> {
    levels.iter().find(|(known, _)| *known == code).map(|(_, level)| *level)
}

/// A tool, as post-processors know it. (book: program/posts)
#[derive(Clone, Debug, PartialEq)]
pub struct Tool {
    /// Name of its table.
    pub name: Box<str>,
    /// Diameter in mm; the tool suits paths with this O.
    pub diameter: f64,
    /// Regular expression searched in the names of the paths that the tool is for; `None` means all paths with its diameter.
    pub paths: Option<Box<str>>,
    /// What it cuts.
    pub shape: CutterShape,
    /// Number of its place in the machine.
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
    pub chip_load: Option<Extent>,
    /// Radius in mm of the corners of a bull nose or ball end mill.
    pub corner_radius: f64,
    /// Length in mm of the cutting edges.
    pub length: Option<f64>,
}

impl Tool {
    /// The limits of the chip load, if they and the number of flutes are known.
    pub fn chip_load(&self) -> Option<ChipLoad> {
        let Extent { from, to } = self.chip_load?;
        Some(ChipLoad { flutes: self.flutes?, speed: self.spindle, least: from, most: to })
    }

    /// Direction of rotation; `None` if the operator chooses it.
    pub fn turning(&self) -> Option<Turning> {
        self.direction.or(self.spindle.map(|_| Turning::Clockwise))
    }

    /// The widths for the check of rapid moves. A tip that is not flat counts as the centre line of the moves, both in removing material
    /// and in hitting it: the tool fits into its own cut.
    pub fn cutter(&self) -> Cutter {
        let flat = match self.shape {
            CutterShape::Other => 0.0,
            CutterShape::EndMill | CutterShape::Slot => (self.diameter - 2.0 * self.corner_radius).max(0.0),
        };
        Cutter { diameter: self.diameter, removed: flat, colliding: flat }
    }
}

/// The configured post-processor. (book: program/posts)
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PostChoice {
    /// Name of a built-in post-processor, or a file.
    pub name: Box<str>,
    /// Whether to write programs that cannot be read back. The user takes responsibility for them.
    pub unchecked: bool,
    /// Program number for controls that call programs by number; `None` takes it from the path.
    pub program_number: Option<u32>,
}

impl From<&str> for PostChoice {
    fn from(name: &str) -> Self {
        Self { name: name.into(), unchecked: false, program_number: None }
    }
}

choice! {
    /// Who controls the spindle.
    SpindleControl {
        /// The program, using the tools of the configuration.
        Tool = "tool",
        /// The operator.
        Manual = "manual",
    }
}

choice! {
    /// Unit of dwell times, for controls on which it can be configured.
    DwellTime {
        /// Seconds, as the manuals describe it.
        Seconds = "seconds",
        /// Milliseconds, which Mach3 can be set to (Config > Logic).
        Milliseconds = "milliseconds",
    }
}

/// Travel of an axis in mm, in coordinates of the emitted program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// Lower end.
    pub from: f64,
    /// Upper end.
    pub to: f64,
}

/// Directories, absolute or relative to the working directory.
pub type Directories = Vec<Utf8PathBuf>;
