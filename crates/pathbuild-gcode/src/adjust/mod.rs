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

use crate::provenance::is_same_program;

use check::{Check, Values};
use survey::Survey;
use table::ProbeTable;
pub(crate) use table::{ProgramProbe, probe_entry};

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
    /// Errors: probes that no formula uses. The program is not to be milled then, since its formulas were removed or changed.
    pub unused: Vec<Diagnostic>,
}

/// The first line, from 1, with a formula that has not been worked out: `Z1.000(=...)`, not `(==...)`.
pub fn first_open_formula(program: &[u8]) -> Option<u32> {
    let is_open = |line: &[u8]| scan::spots(line).any(|spot| line.get(spot.formula.start) != Some(&b'='));
    (1..).zip(program.split(|byte| *byte == b'\n')).find(|(_, line)| is_open(line)).map(|(number, _)| number)
}

/// A formula or a probe of a program, and the line that it stands in, from 1.
#[derive(Debug)]
pub(crate) struct FormulaText {
    pub(crate) line: u32,
    /// Without brackets and the sign that says that it was worked out.
    pub(crate) text: String,
    /// Whether it has that sign.
    pub(crate) is_applied: bool,
}

/// The formulas of a program, in order.
pub(crate) fn formula_texts(program: &[u8]) -> impl Iterator<Item = FormulaText> {
    (1..).zip(program.split(|byte| *byte == b'\n')).flat_map(|(line, content)| {
        scan::spots(content).map(move |spot| {
            let text = String::from_utf8_lossy(&content[spot.formula]).into_owned();
            let applied = text.strip_prefix('=').map(str::to_owned);
            FormulaText { line, is_applied: applied.is_some(), text: applied.unwrap_or(text) }
        })
    })
}

/// The probes that a program's header states, without measured heights.
pub(crate) fn probe_entries(program: &[u8]) -> Vec<FormulaText> {
    let program = &program[lines::mark(program).len()..];
    let lines =
        (1..).zip(program.split(|byte| *byte == b'\n')).take_while(|(_, line)| table::is_header(line));
    let entries = lines.filter_map(|(line, content)| {
        let (number, probe) = table::entry_of_line(content)?;
        Some(FormulaText { line, text: format!("#{number} {probe}"), is_applied: false })
    });
    entries.collect()
}

/// A line without its comments; formulas stay, since they are none.
pub(crate) fn without_comments(line: &str) -> String {
    let bytes = line.as_bytes();
    let mut formulas = scan::spots(bytes).map(|spot| spot.formula.start - 2..spot.formula.end + 1).peekable();
    let (mut kept, mut at) = (String::with_capacity(line.len()), 0);
    while at < line.len() {
        if let Some(formula) = formulas.next_if(|formula| formula.start == at) {
            let end = formula.end.min(line.len());
            kept.push_str(line.get(at..end).unwrap_or_default());
            at = end;
        } else if bytes[at] == b';' {
            break;
        } else if bytes[at] == b'(' {
            at += bytes[at..].iter().position(|byte| *byte == b')').map_or(line.len(), |end| end + 1);
        } else {
            let next = line[at..].chars().next().map_or(1, char::len_utf8);
            kept.push_str(&line[at..at + next]);
            at += next;
        }
    }
    kept
}

/// Whether a program is what [`adjust`] makes of `clean` with the measured heights that the program's header states.
pub fn is_adjusted_from(program: Source<'_>, clean: Source<'_>) -> bool {
    adjusted_again(program, clean).is_some_and(|expected| is_same_program(program.bytes, &expected))
}

/// What [`adjust`] makes of `clean` with the measured heights that a program's header states; `None` where it does not state each.
pub fn adjusted_again(program: Source<'_>, clean: Source<'_>) -> Option<Vec<u8>> {
    let stated = ProbeTable::read(program).probes;
    let measured = |(probe, made): (&u32, &ProgramProbe)| Some((*probe, made.measured?));
    let values = stated.iter().map(measured).collect::<Option<Values>>()?;
    let mut problems = Vec::new();
    let survey = Survey::of(clean, &mut problems);
    let has_all = problems.is_empty() && survey.probes.keys().all(|probe| values.contains_key(probe));
    let inputs = Inputs { program: clean, values: program, log: None, max_correction: f64::INFINITY };
    has_all.then(|| write::adjusted(&inputs, &values).ok()).flatten().map(|adjusted| adjusted.program)
}

/// Whether a program's header states a measured height: then it was adjusted.
pub fn states_heights(program: Source<'_>) -> bool {
    ProbeTable::read(program).probes.values().any(|probe| probe.measured.is_some())
}

/// Whether a file of values has another height for a probe than a program states that it was adjusted with.
pub fn states_other_values(program: Source<'_>, values: Source<'_>) -> bool {
    let stated = ProbeTable::read(program).probes;
    let lines = values::read(values, &mut Vec::new());
    lines.iter().any(|line| match (line.value, stated.get(&line.probe).and_then(|probe| probe.measured)) {
        (values::Entered::Value(value), Some(measured)) => (value - measured).abs() > check::DIFFERENT,
        _ => false,
    })
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
    adjusted.unused = check.unused(&lines);
    Ok(adjusted)
}
