//! Kinds of output files of a program. (book: program/gcode)

use std::fmt::Display;

use camino::Utf8PathBuf;
use pathbuild_db::system::is_windows_device;
use pathbuild_diagnostic::reasons::{DEVICE_NAME, NO_FILE_NAME};
use pathbuild_diagnostic::{Diagnostic, Text};
use pathbuild_gcode::native::{self, WriteOptions};
use pathbuild_toolpath::Program;

use crate::config::types::SheetFormat;

/// A kind of output file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum OutputKind {
    /// The program of a path without probes.
    Milling,
    /// The program of a path with probes, with correction formulas.
    Clean,
    /// The program that measures the probes.
    Probing,
    /// The file into which users enter measured values, which must never be lost.
    Values,
    /// The setup sheet for the machine operator.
    SheetPdf,
    #[expect(missing_docs, reason = "see above")]
    SheetHtml,
    #[expect(missing_docs, reason = "see above")]
    SheetSvg,
}

/// Settings for writing files, whatever their contents.
#[derive(Clone, Copy, Debug)]
pub struct WriteSettings {
    /// Language, character set, speed of rapid moves, and height correction.
    pub options: WriteOptions,
    /// Upper bound on a program's moves, counted after splitting them into pieces.
    pub most_moves: u64,
    /// Upper bound on the memory of a program's moves, in bytes. (`[limits] program-memory`)
    pub most_memory: u64,
    /// Upper bound on the size of a file's text, in bytes. (`[limits] output-size`)
    pub most_bytes: usize,
}

impl OutputKind {
    /// All kinds of output files.
    pub const ALL: [Self; 7] = [
        Self::Milling,
        Self::Clean,
        Self::Probing,
        Self::Values,
        Self::SheetPdf,
        Self::SheetHtml,
        Self::SheetSvg,
    ];

    /// The kinds that are G-code.
    pub const GCODE: [Self; 3] = [Self::Milling, Self::Clean, Self::Probing];

    /// Returns the kind of setup sheets in this format.
    pub fn of_sheet(format: SheetFormat) -> Option<Self> {
        match format {
            SheetFormat::No => None,
            SheetFormat::Pdf => Some(Self::SheetPdf),
            SheetFormat::Html => Some(Self::SheetHtml),
            SheetFormat::Svg => Some(Self::SheetSvg),
        }
    }

    /// Returns the format of a setup sheet; `None` for other kinds.
    pub fn sheet(self) -> Option<SheetFormat> {
        match self {
            Self::Milling | Self::Clean | Self::Probing | Self::Values => None,
            Self::SheetPdf => Some(SheetFormat::Pdf),
            Self::SheetHtml => Some(SheetFormat::Html),
            Self::SheetSvg => Some(SheetFormat::Svg),
        }
    }

    /// Whether the file contains milling moves.
    pub fn is_program(self) -> bool {
        matches!(self, Self::Milling | Self::Clean)
    }

    /// Returns the kinds of files of a program, apart from its setup sheet.
    pub fn of(has_probes: bool) -> &'static [Self] {
        if has_probes { &[Self::Clean, Self::Probing, Self::Values] } else { &[Self::Milling] }
    }

    /// Returns the ending of the file name, which follows the name of the drawing or path and the value of R.
    pub const fn suffix(self) -> &'static str {
        match self {
            Self::Milling => "_Milling.gcode",
            Self::Clean => "_Clean.gcode",
            Self::Probing => "_Probing.gcode",
            Self::Values => "_Z.txt",
            Self::SheetPdf => "_Sheet.pdf",
            Self::SheetHtml => "_Sheet.html",
            Self::SheetSvg => "_Sheet.svg",
        }
    }

    /// Returns the ending of the file name without its extension, which a post may choose.
    pub fn mark(self) -> &'static str {
        self.suffix().split_once('.').map_or("", |(mark, _)| mark)
    }

    /// Returns the native file with this stem, which may include its directory.
    pub fn file(self, stem: impl Display) -> Utf8PathBuf {
        format!("{stem}{}", self.suffix()).into()
    }

    /// Reads the text back and checks that the machine would do what the program says.
    ///
    /// # Errors
    /// PB006 if the text differs from the program.
    pub fn read_back(self, text: &str, program: &Program) -> Result<(), Box<Diagnostic>> {
        match self {
            Self::Milling | Self::Clean => native::read_back(text, program),
            Self::Probing => native::read_probing_back(text, &program.probes),
            Self::Values | Self::SheetPdf | Self::SheetHtml | Self::SheetSvg => Ok(()),
        }
    }

    /// Generates the text of the file; `None` for setup sheets, which are not derived from the program alone.
    ///
    /// # Errors
    /// PB005 if it is too large.
    pub fn text(
        self,
        program: &Program,
        provenance: &str,
        writing: &WriteSettings,
    ) -> Result<Option<String>, Box<Diagnostic>> {
        match self {
            Self::Milling | Self::Clean => {
                native::write_program(program, provenance, &writing.options, writing.most_bytes).map(Some)
            }
            Self::Probing => Ok(Some(native::probing_program(program, provenance, &writing.options))),
            Self::Values => Ok(Some(native::values_file(program, &writing.options))),
            Self::SheetPdf | Self::SheetHtml | Self::SheetSvg => Ok(None),
        }
    }
}

/// The name of an output file, taken apart.
#[derive(Clone, Copy, Debug)]
pub struct OutputName<'n> {
    /// The part before the ending, which the files of a program have in common; with the directory if there is one.
    pub stem: &'n str,
    /// The kind of file that the ending names.
    pub kind: OutputKind,
    /// Whether the extension is that of native files. A program may have the extension of any post.
    pub is_native: bool,
}

impl<'n> OutputName<'n> {
    /// Takes a name or a path apart; `None` if it is not that of an output file.
    pub fn parse(file: &'n str) -> Option<Self> {
        let (name, _) = file.rsplit_once('.')?;
        let of_kind = |kind: OutputKind| {
            let stem = name.strip_suffix(kind.mark())?;
            let is_native = file.ends_with(kind.suffix());
            (is_native || OutputKind::GCODE.contains(&kind)).then_some(Self { stem, kind, is_native })
        };
        OutputKind::ALL.into_iter().find_map(of_kind)
    }
}

/// Returns the reason why a name is not allowed as a file name, if it is not. `rest` is the part that does not stem from an existing file name,
/// such as R: it must be valid on every system, and must not deceive the reader. On Windows, `x:y` is a hidden stream of the file `x`.
pub fn stem_fault(name: &str, rest: &str) -> Option<&'static Text> {
    let is_invalid = name.contains(['/', '\\'])
        || name.contains(char::is_control)
        || rest.contains([':', '<', '>', '"', '|', '?', '*'])
        || rest.contains(is_direction);
    if is_invalid {
        return Some(&NO_FILE_NAME);
    }
    // A name without a dot is no device, because a suffix such as `_Milling` follows it.
    (name == rest && name.contains('.') && is_windows_device(name)).then_some(&DEVICE_NAME)
}

/// Whether a character changes the writing direction of the characters around it.
fn is_direction(c: char) -> bool {
    matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// Returns the text of a file of measured values without the text after each `=`, without a byte order mark, and with normalized line ends.
pub fn without_values(bytes: &[u8]) -> String {
    let text = String::from_utf8_lossy(bytes);
    let line = |line: &str| line.split_inclusive('=').filter(|part| part.ends_with('=')).collect::<String>();
    text.trim_start_matches('\u{feff}').lines().map(line).collect::<Vec<_>>().join("\n")
}

/// Returns the text of a file of measured values without the positions of the probes in the emitted drawing.
pub fn without_positions(values: &str) -> String {
    let line = |line: &str| match line.rsplit_once(POSITION_SEPARATOR) {
        Some((before, place)) => format!("{before}{}", place.split_once(']').unwrap_or_default().1),
        None => line.to_owned(),
    };
    values.lines().map(line).collect::<Vec<_>>().join("\n")
}

/// Text that separates the name of a probe from its position in the emitted drawing.
const POSITION_SEPARATOR: &str = " @ [";
