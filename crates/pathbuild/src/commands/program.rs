//! Reads the G-code programs that commands are given, and guesses their dialect if it is not specified. (book: program/reading)

use std::fmt::Write;
use std::ops::ControlFlow;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::files;
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::interpret::{
    Evidence, Heights, Interpretation, Options, Text, UnitCodes, guess, interpret_until,
};
use pathbuild_gcode::read::quote;
use pathbuild_motion::Step;
use pathbuild_toolpath::memory;

use crate::args::{ReadingArgs, UnitCodesArg};
use crate::context::Context;
use pathbuild_workspace::config::types::DwellTime;

/// A program that was read.
pub(super) struct Program {
    /// File name as given.
    pub(super) file: Utf8PathBuf,
    /// Contents of the file.
    pub(super) text: Vec<u8>,
    /// Dialect in which it was read.
    pub(super) dialect: Dialect,
    /// The evidence for the dialect, if it was guessed.
    pub(super) evidence: Option<Evidence>,
    /// Steps and diagnostics.
    pub(super) read: Interpretation,
    options: Options,
}

impl Program {
    /// Reads a file and keeps its steps.
    ///
    /// # Errors
    /// If the file cannot be read at all; diagnostics of its lines are in [`read`](Self::read).
    pub(super) fn open(
        context: &Context,
        file: &Utf8Path,
        args: &ReadingArgs,
    ) -> Result<Self, Box<Diagnostic>> {
        let (mut steps, limit) = (Vec::new(), context.settings.limits.program_memory.value);
        let mut stopped = None;
        let mut program = Self::open_until(context, file, args, &mut |step| {
            if memory(steps.len() as u64 + 1) > limit {
                stopped = Some(step.line);
                return ControlFlow::Break(());
            }
            steps.push(step);
            ControlFlow::Continue(())
        })?;
        if let Some(line) = stopped {
            let mut problem = too_much_memory(steps.len(), limit).at_line(line, None);
            program.place(std::slice::from_mut(&mut problem));
            return Err(Box::new(problem));
        }
        program.read.steps = steps;
        Ok(program)
    }

    /// Reads a file and passes on its steps without keeping them; large programs are interpreted again instead.
    ///
    /// # Errors
    /// If the file cannot be read at all.
    pub(super) fn open_each(
        context: &Context,
        file: &Utf8Path,
        args: &ReadingArgs,
        each: &mut dyn FnMut(Step),
    ) -> Result<Self, Box<Diagnostic>> {
        Self::open_until(context, file, args, &mut |step| {
            each(step);
            ControlFlow::Continue(())
        })
    }

    fn open_until(
        context: &Context,
        file: &Utf8Path,
        args: &ReadingArgs,
        each: &mut dyn FnMut(Step) -> ControlFlow<()>,
    ) -> Result<Self, Box<Diagnostic>> {
        let limit = context.settings.limits.file_size.value;
        let text = context
            .system
            .read(file, limit)
            .map_err(|error| Box::new(error.diagnostic(limit, "file-size").in_file(file)))?;
        let guessed = args.dialect.is_none().then(|| guess(&text));
        let dialect = args.dialect.or(guessed.map(|guess| guess.dialect)).unwrap_or(Dialect::Rs274);
        let options = options(context, args);
        let mut problems = interpret_until(&text, dialect, &options, each);
        place(&mut problems, file, &text);
        let evidence = guessed.map(|guess| guess.evidence);
        let read = Interpretation { steps: Vec::new(), problems };
        Ok(Self { file: file.to_owned(), text, dialect, evidence, read, options })
    }

    /// The program at its nominal heights, without the correction formulas.
    pub(super) fn drawn(&self) -> Text<'_> {
        let options = Options { heights: Heights::Nominal, ..self.options.clone() };
        Text { text: &self.text, dialect: self.dialect, options }
    }

    /// Adds the file, and the line of text, to diagnostics.
    pub(super) fn place(&self, diagnostics: &mut [Diagnostic]) {
        place(diagnostics, &self.file, &self.text);
    }

    /// The same for diagnostics that have no file yet; the others refer to lines of another file.
    pub(super) fn place_own(&self, diagnostics: &mut [Diagnostic]) {
        place(diagnostics.iter_mut().filter(|diagnostic| diagnostic.file.is_none()), &self.file, &self.text);
    }

    /// The dialect, and why it was guessed.
    pub(super) fn read_as(&self, context: &Context) -> String {
        let mut text = self.dialect.to_string();
        if let Some(evidence) = self.evidence {
            let reason = evidence.reason.in_lang(context.lang());
            _ = write!(text, " ({}: {reason}", context.choose("guessed", "vermutet"));
            if let Some(line) = evidence.line {
                _ = write!(text, ", {} {line}", context.choose("line", "Zeile"));
            }
            text.push(')');
        }
        text
    }

    /// Number of lines.
    pub(super) fn lines(&self) -> usize {
        self.text.split_inclusive(|byte| *byte == b'\n').count()
    }
}

/// PB005: the program has more steps than an emitted program may have moves.
fn too_much_memory(count: usize, limit: u64) -> Diagnostic {
    let count = count as u64;
    Diagnostic::new(&files::PROGRAM_TOO_LONG)
        .with("count", count)
        .with("size", memory(count + 1))
        .with("limit", limit)
        .quoting("key", "program-memory")
}

fn options(context: &Context, args: &ReadingArgs) -> Options {
    Options {
        unit_codes: match args.unit_codes {
            Some(UnitCodesArg::Table) => UnitCodes::Table,
            Some(UnitCodesArg::Din) | None => UnitCodes::Din,
        },
        absolute_arc_centres: args.absolute_arc_centres,
        ignore_feed: args.ignore_feed,
        milliseconds: context.settings.machine.dwell.value == DwellTime::Milliseconds,
        ..Options::default()
    }
}

fn place<'d>(diagnostics: impl IntoIterator<Item = &'d mut Diagnostic>, file: &Utf8Path, text: &[u8]) {
    let mut all: Vec<&mut Diagnostic> = diagnostics.into_iter().collect();
    // Count the lines once for all diagnostics.
    quote(all.iter_mut().map(|diagnostic| &mut **diagnostic), text);
    for diagnostic in all {
        diagnostic.file = Some(file.to_owned());
    }
}
