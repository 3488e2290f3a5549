//! Reads the G-code programs that commands are given, and guesses their dialect if it is not specified. (book: program/reading)

use std::fmt::Write;
use std::ops::ControlFlow;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::messages::{files, gcode};
use pathbuild_diagnostic::{Code, Diagnostic};
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::interpret::{
    Disputes, Evidence, EvidenceKind, Guess, Heights, Interpretation, Options, Text, UnitCodes, guess,
    interpret_until,
};
use pathbuild_gcode::read::quote;
use pathbuild_motion::{Action, StatedWord, Step};
use pathbuild_post::{DoubtfulWord, TranslatedText};
use pathbuild_toolpath::memory;
use pathbuild_view::{GcodeSource, ScenePath, gcode_path};

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
    /// The dialect that was named or guessed. A program that is read by a definition is read in another.
    pub(super) shown: Dialect,
    /// Steps and diagnostics.
    pub(super) read: Interpretation,
    /// How it was read, if by the definition that wrote it instead of a dialect.
    pub(super) by_definition: Option<ByDefinition>,
    options: Options,
}

/// Translates a text by the definition that wrote it, if one is known; it gets the guess if no dialect is named.
pub(super) type Translate<'t> = dyn Fn(&[u8], Option<&Guess>) -> Option<ByDefinition> + 't;

/// A program read by the definition that wrote it.
pub(super) struct ByDefinition {
    /// The definition's name.
    pub(super) name: String,
    /// The program in the words of RS274, line for line.
    pub(super) translated: TranslatedText,
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
        let mut program = Self::open_until(context, file, args, &|_, _| None, &mut |step| {
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

    /// Reads a file and passes on its steps without keeping them; large programs are interpreted again instead. `definition` translates the
    /// text if a post's definition says what its words mean; it gets the guess if no dialect is named.
    ///
    /// # Errors
    /// If the file cannot be read at all.
    pub(super) fn open_each(
        context: &Context,
        file: &Utf8Path,
        args: &ReadingArgs,
        definition: &Translate<'_>,
        each: &mut dyn FnMut(Step),
    ) -> Result<Self, Box<Diagnostic>> {
        Self::open_until(context, file, args, definition, &mut |step| {
            each(step);
            ControlFlow::Continue(())
        })
    }

    fn open_until(
        context: &Context,
        file: &Utf8Path,
        args: &ReadingArgs,
        definition: &Translate<'_>,
        each: &mut dyn FnMut(Step) -> ControlFlow<()>,
    ) -> Result<Self, Box<Diagnostic>> {
        let limit = context.settings.limits.file_size.value;
        let text = context
            .system
            .read(file, limit)
            .map_err(|error| Box::new(error.diagnostic(limit, "file-size").in_file(file)))?;
        let guessed = args.dialect.is_none().then(|| guess(&text));
        let by_definition = definition(&text, guessed.as_ref());
        let dialect = args.dialect.or(guessed.map(|guess| guess.dialect)).unwrap_or(Dialect::Rs274);
        let shown = dialect;
        let dialect = if by_definition.is_some() { Dialect::LinuxCnc } else { dialect };
        let options = options(context, args);
        let mut disputes = Disputes::default();
        let code = by_definition.as_ref().map_or(&*text, |by| by.translated.text.as_bytes());
        let mut problems = interpret_until(code, dialect, &options, &mut |step| {
            if let Action::Word(StatedWord { letter, code, .. }) = step.action {
                disputes.add(step.line, letter, code);
            }
            each(step)
        });
        if by_definition.is_some() {
            // When M5 acts is for the dialect to say.
            problems.retain(|problem| problem.message.key != gcode::STOP_BEFORE_MOTION.key);
            // Columns are those of the translation.
            for problem in &mut problems {
                problem.text = None;
                problem.place.column = None;
            }
        }
        let is_weak = guessed.is_some_and(|guess| guess.evidence.kind == EvidenceKind::Words);
        if is_weak && by_definition.is_none() {
            problems.extend(dialect_not_named(&disputes, dialect));
        }
        place(&mut problems, file, &text);
        let evidence = guessed.map(|guess| guess.evidence);
        let read = Interpretation { steps: Vec::new(), problems };
        Ok(Self { file: file.to_owned(), text, dialect, evidence, shown, read, by_definition, options })
    }

    /// The program at its nominal heights, without the correction formulas.
    pub(super) fn drawn(&self) -> Text<'_> {
        let options = Options { heights: Heights::Nominal, ..self.options.clone() };
        Text { text: self.code(), dialect: self.dialect, options }
    }

    /// The number of the word for inches, times ten.
    pub(super) fn inch_word(&self) -> u16 {
        self.options.unit_words(self.dialect.rules())[0]
    }

    /// The text that is read in its dialect.
    pub(super) fn code(&self) -> &[u8] {
        self.by_definition.as_ref().map_or(&self.text, |by| by.translated.text.as_bytes())
    }

    /// Words that the reader of its definition leaves out.
    pub(super) fn words_left_out(&self) -> impl Iterator<Item = &DoubtfulWord> {
        self.by_definition.iter().flat_map(|by| &by.translated.doubtful)
    }

    /// The name of the dialect or the definition by which it was read.
    pub(super) fn manner(&self) -> &str {
        self.by_definition.as_ref().map_or_else(|| self.dialect.name(), |by| &by.name)
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
        let mut text = self.manner().to_owned();
        if let Some(evidence) = self.evidence.filter(|_| self.by_definition.is_none()) {
            let reason = evidence.reason.in_lang(context.lang());
            _ = write!(text, " ({}: {reason}", context.choose("guessed", "vermutet"));
            if let Some(line) = evidence.line {
                _ = write!(text, ", {} {line}", context.choose("line", "Zeile"));
            }
            text.push(')');
        }
        text
    }

    /// The first line whose moves are unknown, such as a call of a subprogram: lengths and times are then unknown as well.
    pub(super) fn first_unfollowed_line(&self) -> Option<u32> {
        let is_unfollowed =
            |problem: &&Diagnostic| problem.is_error() && problem.code() == Code::WordNotFollowed;
        self.read.problems.iter().find(is_unfollowed).map(|problem| problem.place.line.unwrap_or(0))
    }

    /// The program as a path of a scene. It has no totals if some of its moves are unknown.
    pub(super) fn scene_path(&self, context: &Context) -> ScenePath {
        let source = GcodeSource {
            file: self.file.as_str(),
            steps: &self.read.steps,
            text: &self.text,
            tool: None,
            rapid: context.settings.general.rapid.value,
        };
        let path = gcode_path(&source);
        let totals = path.totals.filter(|_| self.first_unfollowed_line().is_none());
        ScenePath { totals, ..path }
    }

    /// Number of lines.
    pub(super) fn lines(&self) -> usize {
        self.text.split_inclusive(|byte| *byte == b'\n').count()
    }
}

/// PB779: words on which the dialects disagree that a program may be in.
fn dialect_not_named(disputes: &Disputes, dialect: Dialect) -> Option<Diagnostic> {
    let (line, words) = disputes.finish()?;
    let found = Diagnostic::new(&gcode::DIALECT_NOT_NAMED).quoting("words", words.join(", "));
    Some(found.quoting("dialect", dialect.name()).at_line(line, None))
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
