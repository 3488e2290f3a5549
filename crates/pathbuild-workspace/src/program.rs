//! Reads the G-code programs that commands are given, and guesses their dialect if it is not specified. (book: program/reading)

use std::fmt::Write;
use std::ops::ControlFlow;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::System;
use pathbuild_db::system::ReadError;
use pathbuild_diagnostic::messages::{files, gcode};
use pathbuild_diagnostic::{Code, Diagnostic, Lang};
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::header::{Header, HeaderReader};
use pathbuild_gcode::interpret::{
    DisputedWords, Evidence, EvidenceKind, Guess, Heights, Interpretation, Options, Text, guess,
    interpret_until,
};
use pathbuild_gcode::read::{BYTE_ORDER_MARK, is_utf_16, quote};
use pathbuild_motion::{Action, StatedWord, Step};
use pathbuild_post::{Doubt, DoubtfulWord, TranslatedText};
use pathbuild_toolpath::estimated_bytes;
use pathbuild_view::{GcodeSource, ScenePath, gcode_path};

use crate::config::Settings;
use crate::config::types::DwellTime;
use crate::workspace::Workspace;

pub use pathbuild_gcode::interpret::UnitCodes;

/// Options for reading programs.
#[derive(Clone, Copy, Debug, Default)]
pub struct ReadingOptions {
    /// The dialect; `None` means to guess it.
    pub dialect: Option<Dialect>,
    /// Meaning of G70 and G71.
    pub unit_codes: UnitCodes,
    /// Whether I and J are the absolute position of an arc's centre.
    pub absolute_arc_centres: bool,
    /// Whether F words are ignored.
    pub ignore_feed: bool,
}

impl ReadingOptions {
    fn with_settings(self, settings: &Settings) -> Options {
        Options {
            unit_codes: self.unit_codes,
            absolute_arc_centres: self.absolute_arc_centres,
            ignore_feed: self.ignore_feed,
            milliseconds: settings.machine.dwell.value == DwellTime::Milliseconds,
            ..Options::default()
        }
    }

    /// Returns a finding for each option that has no effect in this dialect; an error if the dialect was named.
    fn ineffective_option_findings(self, dialect: Dialect) -> impl Iterator<Item = Diagnostic> {
        let of_xpertmill = [
            ("--unit-codes table", self.unit_codes == UnitCodes::Table),
            ("--absolute-arc-centres", self.absolute_arc_centres),
            ("--ignore-feed", self.ignore_feed),
        ];
        let idle = of_xpertmill.into_iter().filter(move |(_, is_given)| *is_given && !dialect.rules().layers);
        idle.map(move |(option, _)| {
            let found = Diagnostic::new(&gcode::OPTION_OF_XPERTMILL).quoting("option", option);
            let found = found.quoting("dialect", dialect.name());
            if self.dialect.is_some() { found.as_error() } else { found }
        })
    }
}

/// A program that was read from a file.
#[derive(Debug)]
pub struct Program {
    /// Name of the file, as given.
    pub file: Utf8PathBuf,
    /// Contents of the file.
    pub text: Vec<u8>,
    /// Dialect in which the program was read.
    pub dialect: Dialect,
    /// The evidence for the dialect, if it was guessed.
    pub evidence: Option<Evidence>,
    /// The dialect that was named or guessed; it may differ from `dialect` if the program is read by means of a post definition.
    pub shown: Dialect,
    /// Steps and diagnostics of the program.
    pub read: Interpretation,
    /// The translation of the program, if it was read by means of the post definition that wrote it and not in a dialect.
    pub by_definition: Option<DefinitionTranslation>,
    options: Options,
}

/// A function that translates a text by means of the post definition that wrote it, if the definition is known. The second argument is the guessed
/// dialect; `None` if a dialect was specified.
pub type Translate<'t> = dyn Fn(&[u8], Option<&Guess>) -> Option<DefinitionTranslation> + 't;

/// The translation of a program by means of the post definition that wrote it.
#[derive(Debug)]
pub struct DefinitionTranslation {
    /// Name of the definition.
    pub name: String,
    /// The program in the words of RS274, line for line.
    pub translated: TranslatedText,
}

/// A reader of programs, with everything that decides how their texts are understood.
#[derive(Clone, Copy)]
pub(crate) struct ProgramReader<'a> {
    pub(crate) settings: &'a Settings,
    pub(crate) options: ReadingOptions,
    /// Translates texts in words that only a post definition defines.
    pub(crate) definition: &'a Translate<'a>,
}

impl ProgramReader<'_> {
    /// Interprets the text of a file and stores its steps.
    ///
    /// # Errors
    /// If the program has more steps than may be stored.
    pub(crate) fn store(self, file: &Utf8Path, text: Vec<u8>) -> Result<Program, Box<Diagnostic>> {
        let (mut steps, limit) = (Vec::new(), self.settings.limits.program_memory.value);
        let mut stopped = None;
        let mut program = self.interpret(file, text, &mut |step| {
            if estimated_bytes(steps.len() as u64 + 1) > limit {
                stopped = Some(step.line);
                return ControlFlow::Break(());
            }
            steps.push(step);
            ControlFlow::Continue(())
        });
        if let Some(line) = stopped {
            let mut problem = too_much_memory(steps.len(), limit).at_line(line, None);
            program.attach_source(std::slice::from_mut(&mut problem));
            return Err(Box::new(problem));
        }
        program.read.steps = steps;
        Ok(program)
    }

    /// Interprets the text of a file and passes each step to `each` without storing it. A caller that needs the steps of a large program twice calls
    /// this twice.
    pub(crate) fn each(self, file: &Utf8Path, text: Vec<u8>, each: &mut dyn FnMut(Step)) -> Program {
        self.interpret(file, text, &mut |step| {
            each(step);
            ControlFlow::Continue(())
        })
    }

    fn interpret(
        self,
        file: &Utf8Path,
        text: Vec<u8>,
        each: &mut dyn FnMut(Step) -> ControlFlow<()>,
    ) -> Program {
        let named = self.options.dialect;
        let guessed = named.is_none().then(|| guess(&text));
        let translate = || (self.definition)(&text, guessed.as_ref());
        let by_definition = if is_utf_16(&text) { None } else { translate() };
        let shown = named.or(guessed.map(|guess| guess.dialect)).unwrap_or(Dialect::Rs274);
        let dialect = if by_definition.is_some() { Dialect::LinuxCnc } else { shown };
        let options = self.options.with_settings(self.settings);
        let mut disputes = DisputedWords::default();
        let code = by_definition.as_ref().map_or(&*text, |by| by.translated.text.as_bytes());
        let mut problems = interpret_until(code, dialect, &options, &mut |step| {
            if let Action::Word(StatedWord { letter, code, .. }) = step.action {
                disputes.add(step.line, letter, code);
            }
            each(step)
        });
        let is_weak = guessed.is_some_and(|guess| guess.evidence.kind == EvidenceKind::Words);
        match &by_definition {
            Some(by) => by.complete_problems(&mut problems),
            None if is_weak => problems.extend(unnamed_dialect_warning(&disputes, dialect)),
            None => {}
        }
        problems.extend(self.options.ineffective_option_findings(shown));
        if text.starts_with(BYTE_ORDER_MARK) {
            problems.push(Diagnostic::new(&gcode::BYTE_ORDER_MARK).at_line(1, None));
        }
        place(&mut problems, file, &text);
        let evidence = guessed.map(|guess| guess.evidence);
        let read = Interpretation { steps: Vec::new(), problems };
        Program { file: file.to_owned(), text, dialect, evidence, shown, read, by_definition, options }
    }
}

impl DefinitionTranslation {
    /// Turns the problems of the translated text into problems of the program: adds those of the translation itself, and removes what applies only to
    /// the translated text.
    fn complete_problems(&self, problems: &mut Vec<Diagnostic>) {
        problems.extend(self.translated.problems.iter().cloned());
        // The definition does not say when M5 takes effect, which this problem depends on.
        problems.retain(|problem| problem.message.key != gcode::STOP_BEFORE_MOTION.key);
        // The columns and the quoted lines are those of the translation, which the user does not see.
        for problem in problems {
            problem.text = None;
            problem.place.column = None;
        }
    }
}

impl Program {
    /// Reads a file and stores its steps.
    ///
    /// # Errors
    /// If the file cannot be read at all, or has more steps than may be stored. Diagnostics of its lines are in [`read`](Self::read).
    pub fn open(
        workspace: &Workspace,
        file: &Utf8Path,
        reading: ReadingOptions,
    ) -> Result<Self, Box<Diagnostic>> {
        let text = read(&workspace.settings, &*workspace.system, file)?;
        let reader =
            ProgramReader { settings: &workspace.settings, options: reading, definition: &|_, _| None };
        reader.store(file, text)
    }

    /// Returns the tools and the stock that the program states.
    pub fn header(&self) -> Header {
        let mut reader = HeaderReader::default();
        self.read.steps.iter().for_each(|step| reader.step(step));
        self.finish_header(reader)
    }

    /// Finishes a header that has read all steps. The steps of a translation have no comments, so those of the text are read here.
    pub(crate) fn finish_header(&self, mut reader: HeaderReader) -> Header {
        if self.by_definition.is_some() {
            reader.read_head_comments(&self.text);
        }
        reader.finish(self.inch_word())
    }

    /// Returns the program at its nominal heights, without the correction formulas.
    pub fn at_nominal_heights(&self) -> Text<'_> {
        let options = Options { heights: Heights::Nominal, ..self.options.clone() };
        Text { text: self.code(), dialect: self.dialect, options }
    }

    /// Returns the program at the heights to which the machine moves.
    pub fn as_executed(&self) -> Text<'_> {
        Text { text: self.code(), dialect: self.dialect, options: self.options.clone() }
    }

    /// Returns ten times the number of the G code that selects inches: 200 for G20.
    pub fn inch_word(&self) -> u16 {
        self.options.unit_words(self.dialect.rules())[0]
    }

    /// Returns the text in the program's dialect: the translation, if there is one.
    pub fn code(&self) -> &[u8] {
        self.by_definition.as_ref().map_or(&self.text, |by| by.translated.text.as_bytes())
    }

    /// Returns the words that the translation left out.
    pub fn words_left_out(&self) -> impl Iterator<Item = &DoubtfulWord> {
        self.by_definition.iter().flat_map(|by| &by.translated.doubtful)
    }

    /// Returns the name of the dialect or the definition with which the program was read.
    pub fn reading_name(&self) -> &str {
        self.by_definition.as_ref().map_or_else(|| self.dialect.name(), |by| &by.name)
    }

    /// Adds the file's name to diagnostics, and the text of the lines that they refer to.
    pub fn attach_source(&self, diagnostics: &mut [Diagnostic]) {
        place(diagnostics, &self.file, &self.text);
    }

    /// Like [`attach_source`](Self::attach_source), but only for diagnostics without a file: the others refer to lines of another file.
    pub fn attach_own_source(&self, diagnostics: &mut [Diagnostic]) {
        place(diagnostics.iter_mut().filter(|diagnostic| diagnostic.file.is_none()), &self.file, &self.text);
    }

    /// Returns the name of the post definition with which the program was read, or else of the dialect, with the reason if it was guessed.
    pub fn describe_reading(&self, lang: Lang) -> String {
        let mut text = self.reading_name().to_owned();
        if let Some(evidence) = self.evidence.filter(|_| self.by_definition.is_none()) {
            let reason = evidence.reason.in_lang(lang);
            text.push_str(" (");
            if evidence.kind != EvidenceKind::Header {
                text.push_str(lang.choose("guessed: ", "vermutet: "));
            }
            text.push_str(reason);
            if let Some(line) = evidence.line {
                _ = write!(text, ", {} {line}", lang.choose("line", "Zeile"));
            }
            text.push(')');
        }
        text
    }

    /// Whether all lines were read, the dialect knows all words that may move the tool, and the reader interprets them.
    pub fn are_moves_known(&self) -> bool {
        let hides_moves = |problem: &Diagnostic| {
            let is_number_of_program = problem.message.key == gcode::PROGRAM_NUMBER.key;
            problem.is_error() && HIDING_MOVES.contains(&problem.code()) && !is_number_of_program
        };
        !self.read.problems.iter().any(hides_moves)
            && self.words_left_out().all(|word| word.doubt != Doubt::Dangerous)
    }

    /// Returns the first line with unknown moves, for example a call of a subprogram; 0 if its number is unknown. If there is such a line, lengths
    /// and times are unknown as well.
    pub fn first_line_with_unknown_moves(&self) -> Option<u32> {
        let is_unfollowed =
            |problem: &&Diagnostic| problem.is_error() && problem.code() == Code::WordNotFollowed;
        self.read.problems.iter().find(is_unfollowed).map(|problem| problem.place.line.unwrap_or(0))
    }

    /// Returns the program as a path of a scene. It has no totals if some of its moves are unknown.
    pub fn scene_path(&self, workspace: &Workspace) -> ScenePath {
        let source = GcodeSource {
            file: self.file.as_str(),
            steps: &self.read.steps,
            text: &self.text,
            tool: None,
            rapid: workspace.settings.general.rapid.value,
        };
        let path = gcode_path(&source);
        let totals = path.totals.filter(|_| self.first_line_with_unknown_moves().is_none());
        ScenePath { totals, ..path }
    }

    /// Returns the number of lines.
    pub fn lines(&self) -> usize {
        self.text.split_inclusive(|byte| *byte == b'\n').count()
    }
}

/// Errors after which the reader ignores a line or a word, so that the moves are not known.
const HIDING_MOVES: [Code; 13] = [
    Code::NotGCode,
    Code::UnknownCharacter,
    Code::InvalidWord,
    Code::InvalidComment,
    Code::InvalidExpression,
    Code::LongLine,
    Code::UnknownWord,
    Code::WordNotFollowed,
    Code::ConflictingWords,
    Code::MissingWord,
    Code::ValueOutOfRange,
    Code::CannotEvaluate,
    Code::InvalidArc,
];

/// Reads the bytes of a program from a file.
///
/// # Errors
/// If the file cannot be read, or is too large.
pub fn read(settings: &Settings, system: &dyn System, file: &Utf8Path) -> Result<Vec<u8>, Box<Diagnostic>> {
    let limit = settings.limits.file_size.value;
    let unreadable = |error: ReadError| Box::new(error.diagnostic(limit, "file-size").in_file(file));
    system.read(file, limit).map_err(unreadable)
}

/// Returns PB779 for words that have different meanings in the dialects that the program may be in.
fn unnamed_dialect_warning(disputes: &DisputedWords, dialect: Dialect) -> Option<Diagnostic> {
    let (line, words) = disputes.finish()?;
    let found = Diagnostic::new(&gcode::DIALECT_NOT_NAMED).quoting("words", words.join(", "));
    Some(found.quoting("dialect", dialect.name()).at_line(line, None))
}

/// Returns PB005 for a program of which `count` steps are stored, if a further step would exceed `limit`, the memory in bytes for one program.
fn too_much_memory(count: usize, limit: u64) -> Diagnostic {
    let count = count as u64;
    Diagnostic::new(&files::PROGRAM_TOO_LONG)
        .with("count", count)
        .with("size", estimated_bytes(count + 1))
        .with("limit", limit)
        .quoting("key", "program-memory")
}

fn place<'d>(diagnostics: impl IntoIterator<Item = &'d mut Diagnostic>, file: &Utf8Path, text: &[u8]) {
    let mut all: Vec<&mut Diagnostic> = diagnostics.into_iter().collect();
    // Locate all diagnostics together, so that the lines are counted only once.
    quote(all.iter_mut().map(|diagnostic| &mut **diagnostic), text);
    for diagnostic in all {
        diagnostic.file = Some(file.to_owned());
    }
}
