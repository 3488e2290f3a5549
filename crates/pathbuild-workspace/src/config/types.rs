//! Values that are more than a number or a text.

use camino::{Utf8Path, Utf8PathBuf};
use globset::{GlobBuilder, GlobSet};
use pathbuild_diagnostic::{Code, Lang, Severity};
use pathbuild_path::LineType;

/// Declares a choice: what can be written, and what it means.
macro_rules! choice {
    ($(#[$doc:meta])* $name:ident { $($(#[$variant_doc:meta])* $variant:ident = $text:literal,)* }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $name { $($(#[$variant_doc])* $variant,)* }

        impl Choice for $name {
            const ALL: &[(&str, Self)] = &[$(($text, Self::$variant),)*];
        }
    };
}

/// A value out of a few.
pub(crate) trait Choice: Copy + PartialEq + 'static {
    /// Each with its name.
    const ALL: &[(&str, Self)];
}

impl Choice for LineType {
    const ALL: &[(&str, Self)] = &Self::NAMES;
}

impl Choice for Lang {
    const ALL: &[(&str, Self)] = &[("en", Self::En), ("de", Self::De)];
}

choice! {
    /// Which unit the numbers of a drawing have.
    Units {
        /// Millimetres, which the header must not contradict.
        Header = "header",
        /// The header's, converted.
        Drawing = "drawing",
        /// Millimetres, whatever the header says.
        Millimetres = "mm",
    }
}

choice! {
    /// Which characters are written.
    Charset {
        /// ASCII; others are transliterated.
        Ascii = "ascii",
        /// All.
        Utf8 = "utf-8",
    }
}

choice! {
    /// How heights are interpolated between probes. (book: language/probes)
    ZModel {
        /// Inverse distance to the nearest four.
        Idw4 = "idw4",
        /// The plane of least squares.
        Plane = "plane",
        /// A triangulation.
        Tin = "tin",
    }
}

choice! {
    /// What the sheet for who stands at the machine is written as. (book: program/sheet)
    SheetFormat {
        /// It is not.
        No = "none",
        /// Pages to print.
        Pdf = "pdf",
        /// The same in a browser.
        Html = "html",
        /// The same as one picture.
        Svg = "svg",
    }
}

choice! {
    /// What becomes of a diagnostic.
    Level {
        /// It stops what it is in.
        Error = "error",
        /// It is shown.
        Warning = "warning",
        /// It is not.
        Ignore = "ignore",
    }
}

choice! {
    /// Which way a spindle turns.
    Direction {
        /// Clockwise.
        Clockwise = "cw",
        /// Counterclockwise.
        Counterclockwise = "ccw",
    }
}

choice! {
    /// What cools.
    Coolant {
        /// Nothing.
        Off = "off",
        /// Mist.
        Mist = "mist",
        /// Flood.
        Flood = "flood",
    }
}

impl Level {
    /// The severity, unless it is not shown.
    pub fn severity(self) -> Option<Severity> {
        match self {
            Self::Error => Some(Severity::Error),
            Self::Warning => Some(Severity::Warning),
            Self::Ignore => None,
        }
    }
}

/// A name of a line type in drawings, and which one it stands for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LineTypeAlias {
    /// The name in drawings.
    pub name: Box<str>,
    /// What it means.
    pub means: LineType,
}

/// A rule of embedding: paths that `parent` matches embed only those that `child` matches.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Restriction {
    /// A regular expression, searched in the embedding path's name.
    pub parent: Box<str>,
    /// One that is searched in the embedded path's name.
    pub child: Box<str>,
}

/// A pattern of names: of paths, or of files relative to the configuration's directory. Case does not count.
#[derive(Clone, Debug)]
pub struct Pattern {
    text: Box<str>,
    set: GlobSet,
}

/// Bytes of a glob: braces in each other need a stack of their depth.
const LONGEST: usize = 1000;

impl Pattern {
    /// Reads a glob, in which `*` does not match `/`.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn new(text: &str) -> Result<Self, String> {
        if text.len() > LONGEST {
            return Err(format!("it is longer than {LONGEST} bytes"));
        }
        let glob = GlobBuilder::new(text).literal_separator(true).case_insensitive(true).build();
        // A set says what a matcher by itself panics of: that the expression is too large, or its braces too deep.
        let set = glob.and_then(|glob| GlobSet::builder().add(glob).build());
        set.map(|set| Self { text: text.into(), set }).map_err(|error| error.kind().to_string())
    }

    /// Whether a name matches.
    pub fn matches(&self, name: &str) -> bool {
        self.set.is_match(name)
    }

    /// The pattern as it was written.
    pub fn text(&self) -> &str {
        &self.text
    }
}

/// Severities that differ from the catalogue's.
#[derive(Clone, Debug, Default)]
pub struct Severities {
    /// For every drawing.
    pub everywhere: Vec<(Code, Level)>,
    /// For some drawings; where several name a code, the last counts.
    pub in_files: Vec<SeveritiesIn>,
}

/// Severities for some drawings.
#[derive(Clone, Debug, Default)]
pub struct SeveritiesIn {
    /// Which drawings, relative to the configuration's directory.
    pub files: Vec<Pattern>,
    /// What differs there.
    pub levels: Vec<(Code, Level)>,
}

impl Severities {
    /// What becomes of a diagnostic with this code in this file (relative to the configuration's directory); `None`: as the
    /// catalogue says.
    pub fn level(&self, code: Code, file: Option<&Utf8Path>) -> Option<Level> {
        let of =
            |levels: &[(Code, Level)]| levels.iter().find(|(it, _)| *it == code).map(|(_, level)| *level);
        let file = file.map(|file| file.as_str().replace('\\', "/"));
        let is_in = |part: &&SeveritiesIn| {
            file.as_ref().is_some_and(|file| part.files.iter().any(|it| it.matches(file)))
        };
        let in_file = self.in_files.iter().rev().filter(is_in).find_map(|part| of(&part.levels));
        in_file.or_else(|| of(&self.everywhere))
    }
}

/// A tool, as post-processors know it. (book: program/posts)
#[derive(Clone, Debug, PartialEq)]
pub struct Tool {
    /// The name of its table.
    pub name: Box<str>,
    /// Its diameter in mm: the O of paths that it is for.
    pub diameter: f64,
    /// A regular expression searched in the names of paths that it is for; `None`: all of that diameter.
    pub paths: Option<Box<str>>,
    /// Its place in the machine.
    pub number: Option<u32>,
    /// Revolutions a minute.
    pub spindle: Option<f64>,
    /// Which way it turns; `None`: clockwise, or whoever stands at the machine sees to it where there is no speed either.
    pub direction: Option<Direction>,
    /// What cools it; `None`: whoever stands at the machine sees to it.
    pub coolant: Option<Coolant>,
}

/// The post-processor, and what its owner says about its programs. (book: program/posts)
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PostChoice {
    /// A built-in post-processor or a file.
    pub name: Box<str>,
    /// What cannot be read back is written all the same: its owner answers for it.
    pub unchecked: bool,
    /// The number of the program, for controls that call programs by numbers; `None`: the path's.
    pub program_number: Option<u32>,
}

impl From<&str> for PostChoice {
    fn from(name: &str) -> Self {
        Self { name: name.into(), unchecked: false, program_number: None }
    }
}

choice! {
    /// Who sees to the spindle.
    SpindleControl {
        /// The program, by the tools of the configuration.
        Tool = "tool",
        /// Whoever stands at the machine.
        Manual = "manual",
    }
}

choice! {
    /// What a machine counts dwells in, where its control can be set either way.
    DwellTime {
        /// As the manuals have it.
        Seconds = "seconds",
        /// Mach3 by its Config > Logic dialogue.
        Milliseconds = "milliseconds",
    }
}

/// A text for post-processors, by name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Macro {
    /// What it is called in definitions.
    pub name: Box<str>,
    /// What stands for it.
    pub value: Box<str>,
}

/// How far an axis goes, in mm of the emitted program's coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// The lower end.
    pub from: f64,
    /// The upper end.
    pub to: f64,
}

/// Directories, absolute or relative to the working directory.
pub type Directories = Vec<Utf8PathBuf>;
