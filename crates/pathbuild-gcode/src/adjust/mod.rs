//! Puts measured heights into a program. (book: language/probes)
//!
//! The program is read twice, line by line: first every formula is checked and its probes are recorded, then each formula is evaluated.
//! Therefore little memory is needed besides the texts of both programs, and nothing is written if there is an error.

mod check;
mod heights;
mod scan;
mod surface;
mod values;

use std::collections::BTreeMap;
use std::ops::Range;

use camino::Utf8Path;
use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::gcode::PROGRAM_IN_UTF_16;
use pathbuild_diagnostic::messages::probes as messages;
use pathbuild_path::Xy;
use pathbuild_toolpath::ZModel;

use crate::native::{ProgramProbe, probe_entry, push_exact, three_decimals};
use crate::provenance::{is_same_program, without_comment_marks};
use crate::read::is_utf_16;

use check::{Check, MIN_DIFFERENCE, Values};
use heights::HeightRules;
pub use heights::corrected_heights;
use scan::{
    Fault, FormulaSpan, Line, Probes, byte_order_mark, fault_diagnostic, fault_in_line, formula_spans, lines,
    number, probe_uses, value_of,
};
use surface::MeasuredSurface;
pub use values::lost_values_message;
use values::{entry_of_line, header_entries, is_header, probe_table};

/// A file in memory. Its text may be in any encoding that extends ASCII; other bytes are preserved.
#[derive(Clone, Copy, Debug)]
pub struct Source<'a> {
    /// Path of the file.
    pub file: &'a Utf8Path,
    /// Content of the file.
    pub bytes: &'a [u8],
}

/// The program and the measured values from which [`adjust`] makes an adjusted program.
#[derive(Clone, Copy, Debug)]
pub struct Inputs<'a> {
    /// The program with formulas, `DRAWING_Clean.gcode`.
    pub program: Source<'a>,
    /// The file of measured values, `DRAWING_Z.txt`, with one line per probe.
    pub values: Source<'a>,
    /// The log of a sender that ran the probing program. Its values are used for probes without a value in `values`.
    pub log: Option<Source<'a>>,
    /// Maximum difference between a measured and a drawn height, in mm.
    pub max_correction: f64,
    /// Depth in mm below the plate beyond which a lowered height is reported.
    pub below_plate: f64,
    /// The model of the surface between the probes with which the program was written.
    pub model: ZModel,
    /// The heights in mm by which embedded paths are raised, in the order in which they begin in the program. Empty if the drawing is unknown.
    pub shims: &'a [f64],
}

/// The result of [`adjust`]: a program with measured heights, and findings about its probes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AdjustedProgram {
    /// Content of the adjusted program, `DRAWING_Milling.gcode`.
    pub program: Vec<u8>,
    /// Number of corrected heights.
    pub heights: u64,
    /// Least and greatest correction in mm; (0, 0) if there is none.
    pub corrections: (f64, f64),
    /// Warnings about probes whose heights do not fit those of their neighbours, and about cuts that no longer end where the plate is.
    pub warnings: Vec<Diagnostic>,
    /// Errors for probes that no formula uses. Such a program must not be milled, because its formulas were removed or changed.
    pub unused: Vec<Diagnostic>,
}

/// Returns the first line, counted from 1, with a formula that has not been applied: `Z1.000(=...)` as opposed to `(==...)`.
pub fn first_unapplied_formula(program: &[u8]) -> Option<u32> {
    let is_open = |line: &[u8]| formula_spans(line).any(|spot| line.get(spot.formula.start) != Some(&b'='));
    (1..).zip(program.split(|byte| *byte == b'\n')).find(|(_, line)| is_open(line)).map(|(number, _)| number)
}

/// Text of a formula, or of a probe listed in the header, with the number of its line, counted from 1.
#[derive(Debug)]
pub(crate) struct FormulaText {
    pub(crate) line: u32,
    /// The text without brackets and without the second `=` that marks applied formulas.
    pub(crate) text: String,
    pub(crate) is_applied: bool,
}

pub(crate) fn formula_texts(program: &[u8]) -> impl Iterator<Item = FormulaText> {
    (1..).zip(program.split(|byte| *byte == b'\n')).flat_map(|(line, content)| {
        formula_spans(content).map(move |spot| {
            let text = String::from_utf8_lossy(&content[spot.formula]).into_owned();
            let applied = text.strip_prefix('=').map(str::to_owned);
            FormulaText { line, is_applied: applied.is_some(), text: applied.unwrap_or(text) }
        })
    })
}

/// Returns the probes listed in the header of a program, without measured heights.
pub(crate) fn probe_entries(program: &[u8]) -> Vec<FormulaText> {
    let text = |(line, number, probe): (u32, u32, ProgramProbe)| FormulaText {
        line,
        text: format!("#{number} {probe}"),
        is_applied: false,
    };
    header_entries(program).map(text).collect()
}

/// Removes the comments from a line. Formulas are kept.
pub(crate) fn without_comments(line: &str) -> String {
    let bytes = line.as_bytes();
    let mut formulas =
        formula_spans(bytes).map(|spot| spot.formula.start - 2..spot.formula.end + 1).peekable();
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

/// Whether a program equals the result of [`adjust`] for `clean` with the measured heights listed in its header, except for the version of pathbuild.
pub fn is_adjusted_from(program: Source<'_>, clean: Source<'_>) -> bool {
    adjust_with_listed_heights(program, clean)
        .is_some_and(|expected| is_same_program(program.bytes, &expected))
}

/// Returns the result of [`adjust`] for `clean` with the measured heights listed in the header of a program; `None` if heights are missing or
/// formulas are faulty.
pub fn adjust_with_listed_heights(program: Source<'_>, clean: Source<'_>) -> Option<Vec<u8>> {
    let stated = probe_table(program.bytes);
    let measured = |(number, probe): (&u32, &ProgramProbe)| Some((*number, probe.measured?));
    let values = stated.iter().map(measured).collect::<Option<Values>>()?;
    let mut problems = Vec::new();
    let uses = probe_uses(clean, &mut problems);
    let has_all = problems.is_empty() && uses.keys().all(|probe| values.contains_key(probe));
    let (max_correction, below_plate) = (f64::INFINITY, f64::INFINITY);
    let model = ZModel::default();
    let inputs =
        Inputs { program: clean, values: program, log: None, max_correction, below_plate, model, shims: &[] };
    has_all.then(|| evaluate_formulas(&inputs, &values).ok()).flatten().map(|(adjusted, _)| adjusted.program)
}

/// Returns the measured heights that comments of a program list, by the numbers of their probes. Unlike in [`has_measured_heights`], the program
/// may have been converted by a post-processor, which writes the comments further down.
pub fn listed_heights(program: &[u8]) -> BTreeMap<u32, f64> {
    let text = String::from_utf8_lossy(program);
    let comments = text.lines().map(without_comment_marks);
    let entries = comments.filter_map(|comment| probe_entry(&comment.replacen("PROBE #", "Probe #", 1)));
    entries.filter_map(|(number, probe)| Some((number, probe.measured?))).collect()
}

/// Returns the probes listed in a program's header, each with its line, its position, and the height in mm at which it was drawn.
pub fn listed_probes(program: &[u8]) -> Vec<(u32, Xy, f64)> {
    header_entries(program)
        .map(|(line, _, probe)| (line, probe.at.unwrap_or(probe.drawn_at), probe.height))
        .collect()
}

/// Returns the corrections in the formulas of a program, such as `+0.34*[#51-2]`, each with its line.
pub fn corrections(program: &[u8]) -> Vec<(u32, String)> {
    let correction = |FormulaText { line, text, .. }: FormulaText| {
        let start = text.char_indices().skip(1).find(|(_, character)| matches!(character, '+' | '-'));
        Some((line, text[start?.0..].to_owned()))
    };
    formula_texts(program).filter_map(correction).collect()
}

/// Whether the header of a program lists measured heights, that is, whether it was adjusted.
pub fn has_measured_heights(program: Source<'_>) -> bool {
    probe_table(program.bytes).values().any(|probe| probe.measured.is_some())
}

/// Whether a file of values contains a height that differs from the one the program was adjusted with.
pub fn has_differing_values(program: Source<'_>, values: Source<'_>) -> bool {
    let stated = probe_table(program.bytes);
    let lines = values::read(values, &mut Vec::new());
    lines.iter().any(|line| match (line.value, stated.get(&line.probe).and_then(|probe| probe.measured)) {
        (values::EnteredValue::Value(value), Some(measured)) => (value - measured).abs() > MIN_DIFFERENCE,
        _ => false,
    })
}

/// Puts measured heights into a program.
///
/// # Errors
/// All errors in the files, with line and column if they have a place: PB601 to PB604, or PB701 for a program in UTF-16. Then no program is produced.
pub fn adjust(inputs: &Inputs<'_>) -> Result<AdjustedProgram, Vec<Diagnostic>> {
    if is_utf_16(inputs.program.bytes) {
        return Err(vec![Diagnostic::new(&PROGRAM_IN_UTF_16).in_file(inputs.program.file)]);
    }
    let mut problems = Vec::new();
    let table = probe_table(inputs.program.bytes);
    let uses = probe_uses(inputs.program, &mut problems);
    let mut lines = values::read(inputs.values, &mut problems);
    if let Some(log) = inputs.log {
        values::fill_from_log(&mut lines, inputs.values, log, &mut problems);
    }
    let check = Check { inputs, table: &table, uses: &uses };
    let values = check.values(&lines, &mut problems);
    if !problems.is_empty() {
        return Err(problems);
    }
    let (mut adjusted, rules) = evaluate_formulas(inputs, &values)?;
    let surface = MeasuredSurface::new(&table, &values, inputs.model);
    let corrected = Source { file: inputs.program.file, bytes: &adjusted.program };
    let stale =
        surface.as_ref().and_then(|surface| surface.stale_correction_problem(corrected, &rules.applied));
    adjusted.warnings = rules.finish(corrected, surface.as_ref()).into_iter().chain(stale).collect();
    if adjusted.warnings.iter().any(Diagnostic::is_error) {
        return Err(adjusted.warnings);
    }
    adjusted.warnings.extend(check.odd_probes(&lines));
    adjusted.unused = check.report_unused_probes(&lines);
    Ok(adjusted)
}

/// Tolerance of the limit for corrections: a factor, and an amount in mm. A formula's correction may exceed the limit by this much although no
/// probe's does, because weights with three decimals need not sum to 1.
const CORRECTION_SLACK: (f64, f64) = (1.002, 0.002);

/// Evaluates all formulas and adds the measured heights to the header. Everything else is preserved byte for byte. Also returns the rules for the
/// corrected heights, which have seen all of them.
///
/// # Errors
/// Formulas that cannot be evaluated, or whose result is too large.
fn evaluate_formulas<'a>(
    inputs: &Inputs<'a>,
    values: &Values,
) -> Result<(AdjustedProgram, HeightRules<'a>), Vec<Diagnostic>> {
    let bytes = inputs.program.bytes;
    let adjusted = AdjustedProgram::default();
    let rules = HeightRules::new(inputs.below_plate, values.values().copied(), inputs.shims);
    let mut writer = Writer { inputs, values, adjusted, rules, problems: Vec::new() };
    writer.adjusted.program.reserve(bytes.len() + bytes.len() / 32);
    writer.adjusted.program.extend_from_slice(byte_order_mark(bytes));
    let mut is_in_header = true;
    for line in lines(inputs.program) {
        is_in_header &= is_header(line.content());
        if is_in_header {
            writer.header_line(line);
        } else {
            writer.line(line);
        }
    }
    if !writer.problems.is_empty() {
        return Err(writer.problems);
    }
    Ok((writer.adjusted, writer.rules))
}

struct Writer<'w, 'a> {
    inputs: &'w Inputs<'a>,
    values: &'w Values,
    adjusted: AdjustedProgram,
    rules: HeightRules<'a>,
    problems: Vec<Diagnostic>,
}

impl<'a> Writer<'_, 'a> {
    /// Copies a line of the header. The line of a probe gets the measured height, so that `verify` can evaluate the formulas again.
    fn header_line(&mut self, line: Line<'a>) {
        let content = line.content();
        let entry = entry_of_line(content);
        let value = entry.and_then(|(probe, _)| self.values.get(&probe));
        let Some((value, end)) = value.zip(content.iter().rposition(|byte| *byte == b')')) else {
            return self.line(line);
        };
        let mut text = String::from(" Z");
        push_exact(&mut text, *value);
        let (before, behind) = line.bytes.split_at(end);
        let before =
            entry.filter(|(_, probe)| probe.measured.is_some()).map_or(before, |_| without_last_word(before));
        self.adjusted.program.extend_from_slice(before);
        self.adjusted.program.extend_from_slice(text.as_bytes());
        self.adjusted.program.extend_from_slice(behind);
    }

    fn line(&mut self, line: Line<'a>) {
        self.rules.line(line);
        let mut done = 0;
        for spot in formula_spans(line.content()) {
            match self.height(line, &spot) {
                Ok(height) => {
                    let program = &mut self.adjusted.program;
                    program.extend_from_slice(&line.bytes[done..spot.number.start]);
                    program.extend_from_slice(three_decimals(height).as_bytes());
                    program.extend_from_slice(b"(==");
                    done = spot.formula.start;
                }
                Err(problem) => {
                    self.problems.push(*problem);
                    return;
                }
            }
        }
        self.adjusted.program.extend_from_slice(&line.bytes[done..]);
    }

    fn height(&mut self, line: Line<'a>, spot: &FormulaSpan) -> Result<f64, Box<Diagnostic>> {
        let formula = &line.content()[spot.formula.clone()];
        let to_problem = |fault: Fault| Box::new(fault_diagnostic(line, &fault));
        let height = value_of(formula, &mut MeasuredHeights(self.values))
            .map_err(|fault| to_problem(fault_in_line(&fault, spot)))?;
        if !height.is_finite() {
            return Err(to_problem(Fault { message: &messages::NOT_FINITE, at: spot.formula.clone() }));
        }
        self.adjusted.heights += 1;
        if is_height(line.content(), spot) {
            let drawn = number(line.content(), spot).unwrap_or(height);
            self.check(line, spot, height - drawn)?;
            self.rules.check_corrected_height(line, spot, drawn, height);
        }
        Ok(height)
    }

    /// Checks that a correction is within the limit, because far outside the probes, a plane can exceed all measured heights.
    fn check(&mut self, line: Line<'_>, spot: &FormulaSpan, correction: f64) -> Result<(), Box<Diagnostic>> {
        let limit = self.inputs.max_correction;
        if correction.abs() > CORRECTION_SLACK.0 * limit + CORRECTION_SLACK.1 {
            let whole = spot.number.start..spot.formula.end;
            let problem = line.fault(&messages::HEIGHT_TOO_FAR, whole).with("off", correction.abs());
            return Err(Box::new(problem.with("limit", limit)));
        }
        let (lowest, highest) = &mut self.adjusted.corrections;
        if self.adjusted.heights == 1 {
            (*lowest, *highest) = (correction, correction);
        }
        *lowest = lowest.min(correction);
        *highest = highest.max(correction);
        Ok(())
    }
}

/// Removes the last word of a text and the blank before it.
fn without_last_word(text: &[u8]) -> &[u8] {
    text.iter().rposition(|byte| *byte == b' ').map_or(text, |end| &text[..end])
}

/// Whether the number before a formula belongs to a Z word.
fn is_height(line: &[u8], spot: &FormulaSpan) -> bool {
    line[..spot.number.start].trim_ascii_end().last().is_some_and(|letter| letter.eq_ignore_ascii_case(&b'Z'))
}

/// The measured heights by probe. [`Check::values`](check::Check::values) has ensured that every probe used by a formula has one.
struct MeasuredHeights<'v>(&'v Values);

impl Probes for MeasuredHeights<'_> {
    fn value(&mut self, probe: u32, _at: Range<usize>) -> f64 {
        self.0.get(&probe).copied().unwrap_or(f64::NAN)
    }
}
