//! Measured heights put into a program. (book: language/probes)
//!
//! The program is read twice, line by line: first every formula is checked and what it uses is noted, then each is worked out. So a
//! program of any size takes no memory but its own, and nothing comes out of one with an error in it.

mod check;
mod formula;
mod lines;
mod log;
mod scan;
mod survey;
mod table;
mod values;
mod write;

use camino::Utf8Path;
use pathbuild_diagnostic::Diagnostic;

use check::Check;
use survey::Survey;
use table::ProbeTable;

/// A file that was read. Its text may be in any encoding that has ASCII in it; what is not ASCII stays as it is.
#[derive(Clone, Copy, Debug)]
pub struct Source<'a> {
    /// Where it lies.
    pub file: &'a Utf8Path,
    /// All of it.
    pub bytes: &'a [u8],
}

/// What a program is adjusted from.
#[derive(Clone, Copy, Debug)]
pub struct Inputs<'a> {
    /// `DRAWING_Clean.gcode`, with formulas.
    pub program: Source<'a>,
    /// `DRAWING_Z.txt`, one line a probe.
    pub values: Source<'a>,
    /// What a sender logged when the probing run was made: its values are used where `values` has none.
    pub log: Option<Source<'a>>,
    /// The largest difference between a measured and a drawn height, in mm.
    pub max_correction: f64,
}

/// A program with measured heights.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Adjusted {
    /// `DRAWING_Milling.gcode`.
    pub program: Vec<u8>,
    /// How many heights were corrected.
    pub heights: u64,
    /// The lowest and the highest correction in mm; (0, 0) where there is none.
    pub corrections: (f64, f64),
    /// Probes that do not fit their neighbours.
    pub warnings: Vec<Diagnostic>,
}

/// The first line, from 1, with a formula that has not been worked out: `Z1.000(=...)`, not `(==...)`.
pub fn first_open_formula(program: &[u8]) -> Option<u32> {
    let is_open = |line: &[u8]| scan::spots(line).any(|spot| line.get(spot.formula.start) != Some(&b'='));
    (1..).zip(program.split(|byte| *byte == b'\n')).find(|(_, line)| is_open(line)).map(|(number, _)| number)
}

/// Puts measured heights into a program.
///
/// # Errors
/// Everything that is wrong with the files, each with its line and column: PB601 to PB604. There is no program then.
pub fn adjust(inputs: &Inputs<'_>) -> Result<Adjusted, Vec<Diagnostic>> {
    let mut problems = Vec::new();
    let table = ProbeTable::read(inputs.program);
    let survey = Survey::of(inputs.program, &mut problems);
    let mut lines = values::read(inputs.values, &mut problems);
    if let Some(log) = inputs.log {
        log::fill(&mut lines, inputs.values, log, &mut problems);
    }
    let check = Check { inputs, table: &table, survey: &survey };
    let values = check.values(&lines, &mut problems);
    if !problems.is_empty() {
        return Err(problems);
    }
    let mut adjusted = write::adjusted(inputs, &values)?;
    adjusted.warnings = check.odd_probes(&lines);
    Ok(adjusted)
}
