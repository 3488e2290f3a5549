//! Descriptions of machines and tools that controllers and CAM programs keep, turned into `[machine]` and `[tool]`. (book: howto/machine)

mod archive;
mod edit;
mod entries;
mod fluidnc;
mod grbl;
mod linuxcnc;
mod merge;
mod tools;

use camino::Utf8Path;
use pathbuild_db::System;
use pathbuild_diagnostic::messages::import as say;
use pathbuild_diagnostic::{Diagnostic, Value as Shown};

use crate::files::utf_8;

pub use self::edit::{Change, edit};
use self::entries::Entries;
pub use self::entries::Entry;
pub use self::merge::merge;

/// Upper bound on the size of a description in bytes. The settings of a machine take a few kilobytes.
pub const LARGEST: u64 = 4 << 20;

/// The unit of lengths that a description does not name itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LengthUnit {
    /// Millimetres.
    Millimetre,
    /// Inches.
    Inch,
}

impl LengthUnit {
    /// The length of the unit in mm.
    fn millimetres(self) -> f64 {
        match self {
            Self::Millimetre => 1.0,
            Self::Inch => 25.4,
        }
    }
}

/// The contents of a description.
#[derive(Debug)]
pub struct Description {
    /// The controller or program that writes this format.
    pub format: &'static str,
    /// Values for keys of `[machine]`.
    pub values: Vec<DescribedValue>,
    /// The tools.
    pub tools: Vec<DescribedTool>,
    /// The entries for which there is no key.
    pub unused: Vec<Entry>,
    /// Entries that a key should take, but whose values it cannot.
    pub problems: Vec<Diagnostic>,
}

/// A tool of a description.
#[derive(Debug)]
pub struct DescribedTool {
    /// Its number in the machine.
    pub number: Option<u32>,
    /// Its name, which may be empty or that of another tool.
    pub name: String,
    /// The line of the file, if known.
    pub line: Option<u32>,
    /// Values for keys of its table.
    pub values: Vec<DescribedValue>,
}

/// A value for the configuration.
#[derive(Clone, Debug)]
pub struct DescribedValue {
    /// The table that has the key.
    pub target: Target,
    /// Name of the key.
    pub key: &'static str,
    /// The value, in the configuration's units.
    pub value: Quantity,
    /// Names of the entries that the value was read from.
    pub source: String,
    /// Whether the value does not concern a tool that the configuration has already.
    pub is_for_new_tools: bool,
}

/// A table of the configuration.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Target {
    /// `[machine]`
    Machine,
    /// A table of `[tool]`: the one of this number, or else of this name.
    Tool {
        /// Its number in the machine.
        number: Option<u32>,
        /// Its name in the description.
        name: String,
    },
}

/// A value as the configuration takes it.
#[derive(Clone, Debug, PartialEq)]
pub enum Quantity {
    /// A number.
    Number(f64),
    /// A list of numbers.
    Numbers(Vec<f64>),
    /// A name.
    Text(String),
}

/// The unit of lengths that a text names for other files as well: that of an ini file of `LinuxCNC`.
pub fn machine_unit(text: &str) -> Option<LengthUnit> {
    if linuxcnc::is_ini(text) { linuxcnc::length_unit(text) } else { None }
}

/// The text of a description, which may be in an archive of Fusion 360.
///
/// # Errors
/// The reason why it cannot be read.
pub fn text(system: &dyn System, file: &Utf8Path) -> Result<String, Shown> {
    let bytes = system.read(file, LARGEST).map_err(|error| error.reason(LARGEST))?;
    let bytes = if archive::is_archive(&bytes) { archive::unpack(&bytes, LARGEST)? } else { bytes };
    utf_8(bytes)
}

/// Reads a description. The format is recognized by the content. `unit` is that of a tool table, and `bit` gives the text of a tool bit that
/// a FreeCAD library names.
///
/// # Errors
/// The text is in none of the known formats, or is broken.
pub fn read(
    file: &Utf8Path,
    text: &str,
    unit: Option<LengthUnit>,
    bit: &dyn Fn(&str) -> Result<String, Shown>,
) -> Result<Description, Box<Diagnostic>> {
    let read = if text.trim_start().starts_with('{') {
        tools::read_json(text, bit)
    } else if grbl::is_listing(text) {
        Ok(grbl::read(text))
    } else if linuxcnc::is_ini(text) {
        linuxcnc::read(text)
    } else if fluidnc::is_configuration(text) {
        fluidnc::read(text)
    } else if tools::is_table(text) {
        tools::read_table(text, unit)
    } else {
        Err(Box::new(Diagnostic::new(&say::UNKNOWN_FORMAT)))
    };
    let place = |problem: Diagnostic| problem.in_file(file);
    match read {
        Ok(description) => {
            let problems = description.problems.into_iter().map(place).collect();
            Ok(Description { problems, ..description })
        }
        Err(problem) => Err(Box::new(place(*problem))),
    }
}

/// PB612 at a line: the description is broken.
fn broken(reason: &str, line: usize) -> Box<Diagnostic> {
    let problem = Diagnostic::new(&say::BROKEN_DESCRIPTION).with("reason", Shown::foreign(reason));
    Box::new(problem.at_line(u32::try_from(line).unwrap_or(u32::MAX), None))
}
