//! Imports descriptions of machines and tools, as controllers and CAM programs store them, into `[machine]` and `[tool]`. (book: howto/machine)

mod edit;
mod entries;
mod fluidnc;
mod grbl;
mod linuxcnc;
mod merge;
mod tools;

use std::io::Read;

use camino::Utf8Path;
use flate2::bufread::DeflateDecoder;
use pathbuild_db::System;
use pathbuild_diagnostic::messages::import as say;
use pathbuild_diagnostic::{Diagnostic, Text, Value as MessageValue};
use rawzip::{CompressionMethod, ZipArchive};

use crate::files::decode_utf8;

pub use self::edit::{Change, EditedConfiguration, edit};
use self::entries::Entries;
pub use self::entries::Entry;
pub use self::merge::merge;

/// Upper bound on the size of a description in bytes. The settings of a machine take a few kilobytes.
pub const MAX_DESCRIPTION_BYTES: u64 = 4 << 20;

/// The unit of lengths, for descriptions that do not name it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LengthUnit {
    /// The millimetre, as in metric descriptions.
    Millimetre,
    /// The inch of 25.4 mm.
    Inch,
}

impl LengthUnit {
    fn millimetres(self) -> f64 {
        match self {
            Self::Millimetre => 1.0,
            Self::Inch => 25.4,
        }
    }
}

/// The values, tools and remaining entries of a description.
#[derive(Debug, Default)]
pub struct Description {
    /// Name of the controller or program that writes this format.
    pub format: &'static str,
    /// Values for keys of `[machine]`.
    pub values: Vec<DescribedValue>,
    /// The tools, in the order of the description.
    pub tools: Vec<DescribedTool>,
    /// The entries for which there is no key.
    pub unused: Vec<Entry>,
    /// Diagnostics of the entries and tools, for example of values that a key cannot take.
    pub problems: Vec<Diagnostic>,
}

impl Description {
    fn new(format: &'static str) -> Self {
        Self { format, ..Self::default() }
    }
}

/// A tool of a description.
#[derive(Debug, Default)]
pub struct DescribedTool {
    /// Number of the tool in the machine.
    pub number: Option<u32>,
    /// Name of the tool, which may be empty, or the same as that of another tool.
    pub name: String,
    /// Line of the tool in the description, if known.
    pub line: Option<u32>,
    /// Values for the keys of the tool's table.
    pub values: Vec<DescribedValue>,
}

/// A value from a description, for a key of the configuration.
#[derive(Clone, Debug)]
pub struct DescribedValue {
    /// Name of the key in its table of the configuration.
    pub key: &'static str,
    /// The value, in the configuration's units.
    pub value: Quantity,
    /// Names of the entries that the value was read from.
    pub source: String,
    /// Whether the value is only for tools that the configuration does not contain yet.
    pub is_for_new_tools: bool,
}

/// A table of the configuration that takes values.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Target {
    /// The table `[machine]`.
    Machine,
    /// The table of `[tool]` with this number, or else with this name.
    Tool {
        /// Number of the tool in the machine.
        number: Option<u32>,
        /// Name of the tool in the description.
        name: String,
    },
}

/// A value of one of the types that keys of the configuration take.
#[derive(Clone, Debug, PartialEq)]
pub enum Quantity {
    /// A number, in the unit of the key.
    Number(f64),
    /// A list of numbers, in the unit of the key.
    Numbers(Vec<f64>),
    /// A string, such as the shape of a cutter.
    Text(String),
}

/// Returns the unit of the tool tables among the texts: `named` if given, otherwise the unit of an ini file among the texts.
///
/// # Errors
/// If the unit of an ini file differs from `named`, or from the unit of another ini file.
pub fn table_unit(
    named: Option<LengthUnit>,
    texts: &[(&Utf8Path, String)],
) -> Result<Option<LengthUnit>, Box<Diagnostic>> {
    let mut unit = named;
    for (file, text) in texts {
        let Some(stated) = linuxcnc::length_unit(text) else { continue };
        if *unit.get_or_insert(stated) != stated {
            return Err(Box::new(Diagnostic::new(&say::UNITS_CONTRADICT).in_file(file)));
        }
    }
    Ok(unit)
}

/// Reads the text of a description, which may be in an archive of Fusion 360.
///
/// # Errors
/// The reason why it cannot be read.
pub fn text(system: &dyn System, file: &Utf8Path) -> Result<String, MessageValue> {
    let bytes =
        system.read(file, MAX_DESCRIPTION_BYTES).map_err(|error| error.reason(MAX_DESCRIPTION_BYTES))?;
    let bytes = if bytes.starts_with(b"PK\x03\x04") { unpack(&bytes)? } else { bytes };
    // Some editors begin a file with a byte order mark.
    decode_utf8(bytes).map(|text| text.trim_start_matches('\u{feff}').to_owned())
}

/// Parses a description; its format is recognized by its content. `unit` is the unit of a tool table that does not name it. `bit` returns the text of
/// a tool bit that a FreeCAD library names.
///
/// # Errors
/// If the text is in none of the known formats, or is broken.
pub fn read(
    file: &Utf8Path,
    text: &str,
    unit: Option<LengthUnit>,
    bit: &dyn Fn(&str) -> Result<String, MessageValue>,
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

/// Returns the content of a tool library that Fusion 360 exported as `.tools`: a zip archive with a single entry, `tools.json`.
///
/// # Errors
/// If the archive is broken or has several entries, or if the content is too large.
fn unpack(bytes: &[u8]) -> Result<Vec<u8>, MessageValue> {
    let archive = ZipArchive::from_slice(bytes).map_err(MessageValue::foreign)?;
    let mut entries = archive.entries();
    let first = entries.next_entry().map_err(MessageValue::foreign)?;
    let second = entries.next_entry().map_err(MessageValue::foreign)?;
    let (Some(entry), None) = (first, second) else { return Err(MessageValue::Prose(&SEVERAL_FILES)) };
    let local = archive.get_entry(entry.wayfinder()).map_err(MessageValue::foreign)?;
    match entry.compression_method() {
        CompressionMethod::STORE => read_entry(local.verifying_reader(local.data())),
        CompressionMethod::DEFLATE => read_entry(local.verifying_reader(DeflateDecoder::new(local.data()))),
        _ => Err(MessageValue::Prose(&OTHER_METHOD)),
    }
}

fn read_entry(content: impl Read) -> Result<Vec<u8>, MessageValue> {
    let mut bytes = Vec::new();
    content.take(MAX_DESCRIPTION_BYTES + 1).read_to_end(&mut bytes).map_err(MessageValue::foreign)?;
    if bytes.len() as u64 > MAX_DESCRIPTION_BYTES {
        return Err(MessageValue::Prose(&TOO_LARGE));
    }
    Ok(bytes)
}

static SEVERAL_FILES: Text = Text {
    en: "the archive does not contain exactly one file",
    de: "das Archiv enthält nicht genau eine Datei",
};
static OTHER_METHOD: Text = Text {
    en: "the archive is compressed by a method other than Deflate",
    de: "das Archiv ist mit einem anderen Verfahren als Deflate komprimiert",
};
static TOO_LARGE: Text =
    Text { en: "its unpacked content is too large", de: "sein entpackter Inhalt ist zu groß" };

fn broken_description(reason: &str, line: usize) -> Box<Diagnostic> {
    let problem = Diagnostic::new(&say::BROKEN_DESCRIPTION).with("reason", MessageValue::foreign(reason));
    Box::new(problem.at_line(u32::try_from(line).unwrap_or(u32::MAX), None))
}
