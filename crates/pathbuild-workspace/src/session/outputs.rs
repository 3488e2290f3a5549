//! The files that a program becomes. (book: program/gcode)

use pathbuild_diagnostic::Diagnostic;
use pathbuild_gcode::native::{self, Header, WriteOptions};
use pathbuild_toolpath::Program;

use crate::config::types::SheetFormat;

/// The kinds of files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum OutputKind {
    /// The program, where there are no probes.
    Milling,
    /// The program with correction formulas.
    Clean,
    /// The probing run.
    Probing,
    /// Where a person writes measured values, which must not be lost.
    Values,
    /// The sheet for who stands at the machine.
    SheetPdf,
    #[expect(missing_docs, reason = "see above")]
    SheetHtml,
    #[expect(missing_docs, reason = "see above")]
    SheetSvg,
}

/// How files are written, whatever is in them.
#[derive(Clone, Copy, Debug)]
pub struct Writing {
    /// Language, characters, rapid feed.
    pub options: WriteOptions,
    /// Most moves of a program, after cutting.
    pub most_moves: u64,
    /// Most bytes that its moves may take in memory. (`[limits] program-memory`)
    pub most_memory: u64,
    /// Most bytes of a program's text. (`[limits] output-size`)
    pub most_bytes: usize,
}

impl OutputKind {
    /// Each.
    pub const ALL: [Self; 7] = [
        Self::Milling,
        Self::Clean,
        Self::Probing,
        Self::Values,
        Self::SheetPdf,
        Self::SheetHtml,
        Self::SheetSvg,
    ];

    /// The sheet of a format.
    pub fn of_sheet(format: SheetFormat) -> Option<Self> {
        match format {
            SheetFormat::No => None,
            SheetFormat::Pdf => Some(Self::SheetPdf),
            SheetFormat::Html => Some(Self::SheetHtml),
            SheetFormat::Svg => Some(Self::SheetSvg),
        }
    }

    /// The format of a sheet; of other files none.
    pub fn sheet(self) -> Option<SheetFormat> {
        match self {
            Self::Milling | Self::Clean | Self::Probing | Self::Values => None,
            Self::SheetPdf => Some(SheetFormat::Pdf),
            Self::SheetHtml => Some(SheetFormat::Html),
            Self::SheetSvg => Some(SheetFormat::Svg),
        }
    }

    /// Whether it mills.
    pub fn is_program(self) -> bool {
        matches!(self, Self::Milling | Self::Clean)
    }

    /// The files of a program.
    pub fn of(has_probes: bool) -> &'static [Self] {
        if has_probes { &[Self::Clean, Self::Probing, Self::Values] } else { &[Self::Milling] }
    }

    /// What their names end in, behind the drawing's or path's name and R.
    pub fn suffix(self) -> &'static str {
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

    /// Whether a text, read back, makes the machine do what the program says.
    ///
    /// # Errors
    /// PB006: where it does not.
    pub fn read_back(self, text: &str, program: &Program) -> Result<(), Box<Diagnostic>> {
        match self {
            Self::Milling | Self::Clean => native::read_back(text, program),
            Self::Probing => native::read_probing_back(text, &program.probes),
            Self::Values | Self::SheetPdf | Self::SheetHtml | Self::SheetSvg => Ok(()),
        }
    }

    /// The whole text; `None` of a sheet, which is no text of the program.
    ///
    /// # Errors
    /// PB005: where it is too large.
    pub fn text(
        self,
        program: &Program,
        provenance: &str,
        writing: &Writing,
    ) -> Result<Option<String>, Box<Diagnostic>> {
        let header = Header { provenance: provenance.to_owned() };
        match self {
            Self::Milling | Self::Clean => writing.text(program, &header).map(Some),
            Self::Probing => Ok(Some(native::probing_program(program, &header, &writing.options))),
            Self::Values => Ok(Some(native::values_file(program, &writing.options))),
            Self::SheetPdf | Self::SheetHtml | Self::SheetSvg => Ok(None),
        }
    }
}

impl Writing {
    /// The text of a program.
    ///
    /// # Errors
    /// PB005: where it is too large.
    pub fn text(&self, program: &Program, header: &Header) -> Result<String, Box<Diagnostic>> {
        native::program_within(program, header, &self.options, self.most_bytes)
    }
}

/// Whether a name cannot be a file's. `rest` is the part of it that is not the name of a file already, such as R: it must suit every system, and
/// look like what it is. On Windows `x:y` is a part of the file `x` that no listing shows.
pub fn stem_fault(name: &str, rest: &str) -> bool {
    name.contains(['/', '\\'])
        || name.contains(char::is_control)
        || rest.contains([':', '<', '>', '"', '|', '?', '*'])
        || rest.contains(is_direction)
}

/// Characters that turn what stands beside them, as it is shown, the other way round.
fn is_direction(c: char) -> bool {
    matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// The text of a file of values with everything behind `=` taken away, whatever its line ends are.
pub fn without_values(bytes: &[u8]) -> String {
    let text = String::from_utf8_lossy(bytes);
    let line = |line: &str| line.split_inclusive('=').filter(|part| part.ends_with('=')).collect::<String>();
    text.lines().map(line).collect::<Vec<_>>().join("\n")
}

/// The lines of a file of values without the places in the emitted drawing.
pub fn without_places(values: &str) -> String {
    let line = |line: &str| match line.rsplit_once(PLACE) {
        Some((before, place)) => format!("{before}{}", place.split_once(']').unwrap_or_default().1),
        None => line.to_owned(),
    };
    values.lines().map(line).collect::<Vec<_>>().join("\n")
}

/// What stands between the name of a probe and its place in the emitted drawing.
const PLACE: &str = " @ [";
