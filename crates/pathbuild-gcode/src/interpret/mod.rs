//! Interprets G-code programs. (book: program/reading)
//!
//! The result is a list of canonical [`Step`]s in absolute millimetres, each with the positions before and after it, regardless of the
//! units, distance mode, coordinate systems and cycles used by the program. Every problem is a diagnostic with its line. Lines that
//! cannot be understood are omitted, so later steps may be wrong.

mod calls;
mod codes;
mod cycle;
mod evaluate;
mod execute;
mod formulas;
mod guess;
mod half_circles;
mod motion;
mod state;
mod switches;
mod words;

use std::ops::ControlFlow;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::gcode::{EMPTY_PROGRAM, NOT_G_CODE, PROGRAM_IN_UTF_16};
use pathbuild_motion::{Move, Step};

pub use self::guess::{DisputedWords, MeaningWithoutDialect, meaning_without_dialect};
pub use self::state::{Heights, MachineOffsets, Options, UnitCodes};
pub use codes::name as code_name;
pub use cycle::PECK_CLEARANCE;
pub use guess::{Evidence, EvidenceKind, Guess, guess};
pub(crate) use motion::LOWEST_RETRACT;
pub(crate) use state::INCH;

use crate::dialect::Dialect;
use crate::read::{BlockReader, is_utf_16};

/// The result of interpreting a program.
#[derive(Clone, Debug, Default)]
pub struct Interpretation {
    /// The actions of the machine, in order.
    pub steps: Vec<Step>,
    /// The problems in the file, ordered by line.
    pub problems: Vec<Diagnostic>,
}

impl Interpretation {
    /// Returns the moves of the program, with their lines.
    pub fn moves(&self) -> Vec<(u32, Move)> {
        self.steps.iter().filter_map(Step::as_move).collect()
    }
}

/// Interprets a file and collects all steps.
pub fn interpret(text: &[u8], dialect: Dialect, options: &Options) -> Interpretation {
    let mut steps = Vec::new();
    let problems = interpret_each(text, dialect, options, &mut |step| steps.push(step));
    Interpretation { steps, problems }
}

/// Interprets a file of any size and passes each step to `each`.
pub fn interpret_each(
    text: &[u8],
    dialect: Dialect,
    options: &Options,
    each: &mut dyn FnMut(Step),
) -> Vec<Diagnostic> {
    let mut all = |step| {
        each(step);
        ControlFlow::Continue(())
    };
    interpret_until(text, dialect, options, &mut all)
}

/// Like [`interpret_each`], but stops when `each` returns `Break`. Nothing is reported about the lines after that.
pub fn interpret_until(
    text: &[u8],
    dialect: Dialect,
    options: &Options,
    each: &mut dyn FnMut(Step) -> ControlFlow<()>,
) -> Vec<Diagnostic> {
    if text.trim_ascii().is_empty() {
        return vec![Diagnostic::new(&EMPTY_PROGRAM)];
    }
    if is_utf_16(text) {
        return vec![Diagnostic::new(&PROGRAM_IN_UTF_16)];
    }
    let (problems, has_words) = interpret_parts([text], dialect, options, each);
    let is_other = !has_words && problems.iter().any(Diagnostic::is_error);
    if is_other { vec![no_g_code_error(text)] } else { problems }
}

/// A program that can pass on its steps repeatedly, so that they need not be stored.
pub trait Program {
    /// Passes all steps to `take`, in order.
    fn each(&self, take: &mut dyn FnMut(&Step));
}

impl Program for [Step] {
    fn each(&self, take: &mut dyn FnMut(&Step)) {
        self.iter().for_each(take);
    }
}

impl Program for Vec<Step> {
    fn each(&self, take: &mut dyn FnMut(&Step)) {
        self.as_slice().each(take);
    }
}

/// A program given as text, which is interpreted anew on every call of [`each`](Program::each). That call discards the problems found;
/// [`interpret_each`] returns them.
#[derive(Clone, Debug)]
pub struct Text<'t> {
    /// Content of the file.
    pub text: &'t [u8],
    /// Dialect of the file.
    pub dialect: Dialect,
    /// Options for the interpretation.
    pub options: Options,
}

impl Program for Text<'_> {
    fn each(&self, take: &mut dyn FnMut(&Step)) {
        interpret_each(self.text, self.dialect, &self.options, &mut |step| take(&step));
    }
}

/// Interprets a file given in parts of whole lines, until `each` returns `Break`. Returns its problems, and whether any line contains a word.
pub(crate) fn interpret_parts(
    parts: impl IntoIterator<Item = impl AsRef<[u8]>>,
    dialect: Dialect,
    options: &Options,
    each: &mut dyn FnMut(Step) -> ControlFlow<()>,
) -> (Vec<Diagnostic>, bool) {
    let rules = dialect.rules();
    let mut interpreter = execute::Interpreter::new(rules, options);
    let mut has_words = false;
    let mut before: Option<BlockReader<'static>> = None;
    for part in parts {
        let text = part.as_ref();
        let mut reader = match before.take() {
            None => BlockReader::new(text, rules),
            Some(reader) => reader.continue_with(text),
        };
        let mut runner = calls::Runner::new(&mut interpreter, &mut *each);
        runner.run_file(&mut reader);
        has_words |= runner.has_words;
        before = Some(reader.continue_with(&[]));
    }
    let reader = before.unwrap_or_else(|| BlockReader::new(&[], rules));
    let mut problems = interpreter.finish(reader.line(), reader.is_ended());
    problems.append(reader.into_problems());
    (problems.into_diagnostics(), has_words)
}

/// Creates the single report for a file without any words, instead of one per line.
fn no_g_code_error(text: &[u8]) -> Diagnostic {
    let lines = text.split(|byte| matches!(byte, b'\n' | b'\r')).map(<[u8]>::trim_ascii);
    let first = lines.into_iter().find(|line| !line.is_empty()).unwrap_or_default();
    let shown: String =
        String::from_utf8_lossy(&first[..first.len().min(EXCERPT_BYTES)]).escape_debug().collect();
    Diagnostic::new(&NOT_G_CODE).quoting("found", format!("`{shown}`")).at_line(1, None)
}

/// Number of bytes of a line shown to illustrate the content of the file.
const EXCERPT_BYTES: usize = 40;
