//! The files that a program becomes. (book: program/gcode)

use pathbuild_diagnostic::Diagnostic;
use pathbuild_gcode::native::{self, Header, WriteOptions};
use pathbuild_toolpath::Program;

/// The kinds of files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OutputKind {
    /// The program, where there are no probes.
    Milling,
    /// The program with correction formulas.
    Clean,
    /// The probing run.
    Probing,
    /// Where a person writes measured values, which must not be lost.
    Values,
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
    /// Each, at the place of its number.
    pub const ALL: [Self; 4] = [Self::Milling, Self::Clean, Self::Probing, Self::Values];

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
            Self::Values => Ok(()),
        }
    }

    /// The whole text.
    ///
    /// # Errors
    /// PB005: where it is too large.
    pub fn text(
        self,
        program: &Program,
        provenance: &str,
        writing: &Writing,
    ) -> Result<String, Box<Diagnostic>> {
        let header = Header { provenance: provenance.to_owned() };
        match self {
            Self::Milling | Self::Clean => writing.text(program, &header),
            Self::Probing => Ok(native::probing_program(program, &header, &writing.options)),
            Self::Values => Ok(native::values_file(program, &writing.options)),
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

/// Whether a name, which R is a part of, cannot be a file's.
pub fn stem_fault(stem: &str) -> bool {
    stem.contains(['/', '\\']) || stem.contains(char::is_control)
}

/// The text of a file of values with everything behind `=` taken away, whatever its line ends are.
pub fn without_values(bytes: &[u8]) -> String {
    let text = String::from_utf8_lossy(bytes);
    let line = |line: &str| line.split_inclusive('=').filter(|part| part.ends_with('=')).collect::<String>();
    text.lines().map(line).collect::<Vec<_>>().join("\n")
}
