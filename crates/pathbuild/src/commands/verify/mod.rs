//! `pathbuild verify`: checks that a G-code program is safe to run and matches its drawing. (book: program/reading)

mod against;
mod checks;
mod stock;

use against::{ReferenceProgram, Rewritten};
use camino::Utf8Path;
use checks::CheckReport;
use pathbuild_diagnostic::messages::gcode::FEED_IGNORED;
use pathbuild_diagnostic::{Code, Diagnostic, Severity};
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::header::HeaderReader;
use pathbuild_gcode::interpret::{EvidenceKind, Guess};
use pathbuild_gcode::native;
use pathbuild_gcode::provenance::Provenance;
use pathbuild_gcode::verify::{
    Checks, MachineRules, PastClamps, StatedStatistics, WordRules, coarse_arcs, verify_with,
};
use pathbuild_motion::Pace;
use pathbuild_workspace::config::{number, positive};
use pathbuild_workspace::posting::machine;
use pathbuild_workspace::posting::{PostArguments, PostProcessor, known_words};
use pathbuild_workspace::session::Session;

use super::program::{ByDefinition, Program};
use crate::args::VerifyArgs;
use crate::context::Context;
use crate::exit::ExitStatus;

/// Runs the command.
pub fn run(context: &Context, args: &VerifyArgs) -> ExitStatus {
    let stock_options = match StockOptions::new(args) {
        Ok(stock_options) => stock_options,
        Err(fault) => return context.refuse(vec![*fault]),
    };
    let writers = match Writers::new(context, args) {
        Ok(writers) => writers,
        Err(problems) => return context.fail(problems),
    };
    context.output.figure("programs", args.files.len());
    context.output.figure("configuration", context.settings.file.as_deref().map(|file| context.file(file)));
    let mut session = Session::new(context);
    let mut diagnostics = Vec::new();
    let drawn = |name| session.with_stable_files(|session| ReferenceProgram::new(context, session, name));
    let against = match args.against.as_deref().map(drawn).transpose() {
        Ok(against) => against,
        Err(against::Failure::Usage(reason)) => return context.usage(&reason),
        Err(against::Failure::Found(found)) => return conclude(context, &session, found),
    };
    let mut report = CheckReport::default();
    for file in &args.files {
        match check(context, file, args, &stock_options, against.as_ref(), &writers, &mut report) {
            Ok(found) => diagnostics.extend(found),
            Err(problem) => diagnostics.push(*problem),
        }
    }
    let status = conclude(context, &session, diagnostics);
    report.finish(context);
    status
}

/// Cutter and material from the command line.
struct StockOptions {
    /// Diameter in mm.
    cutter: Option<f64>,
    /// Height of the upper face in mm.
    surface: Option<f64>,
}

impl StockOptions {
    fn new(args: &VerifyArgs) -> Result<Self, Box<Diagnostic>> {
        let cutter = args.cutter.as_deref().map(|text| positive("cutter", text)).transpose()?;
        let surface = args.surface.as_deref().map(|text| number("surface", text)).transpose()?;
        Ok(Self { cutter, surface })
    }
}

/// Checks a program. If its heights are corrected, the material is assumed where it was drawn: rapid moves that follow an uneven plate do
/// not mill it. The machine's limits apply to the actual moves.
///
/// The text is interpreted twice instead of keeping its steps, because the rules need to know the material first.
fn check(
    context: &Context,
    file: &Utf8Path,
    args: &VerifyArgs,
    stock_options: &StockOptions,
    against: Option<&ReferenceProgram>,
    writers: &Writers,
    report: &mut CheckReport,
) -> Result<Vec<Diagnostic>, Box<Diagnostic>> {
    let mut reading = args.reading.clone();
    reading.dialect = writers.dialect();
    let machine = machine(context);
    let mut limits = machine.as_ref().map(MachineRules::new);
    let mut header = HeaderReader::default();
    let mut stated = StatedStatistics::default();
    let mut has_probed = false;
    let by_definition = |text: &[u8], guess: Option<&Guess>| writers.translate(text, guess);
    let program = Program::open_each(context, file, &reading, &by_definition, &mut |step| {
        header.step(&step);
        stated.step(&step);
        has_probed |= step.as_move().is_some_and(|(_, motion)| matches!(motion.pace, Pace::Probe { .. }));
        if let Some(limits) = &mut limits {
            limits.step(&step);
        }
    })?;
    let drawn = program.drawn();
    if program.by_definition.is_some() {
        header.head_of(&program.text);
    }
    let header = header.finish(program.inch_word());
    let sources = stock::Sources::new(context, &program, &header, stock_options, against);
    let stock = sources.stock();
    let evidence = program.evidence.map(|evidence| evidence.kind);
    let writer = writers.of(program.shown, evidence);
    let words = known_words(context, writer, program.dialect);
    let mut foreign = against.is_none().then(|| WordRules::new(&words, program.dialect));
    // The probing run of a drawing is a separate program.
    let is_probing = has_probed && program.dialect == Dialect::Native;
    let milled = against.filter(|against| !is_probing || !against.has_probes());
    let definition = writer.filter(|writer| writer.file().is_some());
    let rewritten =
        milled.zip(definition).map(|(against, writer)| against.rewritten(context, writer, &program));
    let rewritten = match rewritten.transpose() {
        Ok(rewritten) => rewritten,
        Err(problems) => return Ok(problems),
    };
    let is_rewritten = rewritten.as_ref().is_some_and(Rewritten::is_same);
    let mut comparison =
        milled.map(|against| against.comparison(context, program.dialect, &words, rewritten.as_ref()));
    let mut past = against.and_then(|against| against.past_clamps(program.dialect));
    let mut found = verify_with(&drawn, &Checks { stock: stock.as_ref(), machine: None }, &mut |step| {
        if let Some(comparison) = &mut comparison {
            comparison.step(step);
        }
        if let Some(foreign) = &mut foreign {
            foreign.step(step);
        }
        if let Some(past) = &mut past {
            past.step(step);
        }
    });
    let doubts = sources.doubtful_rapids(&found);
    found.extend(doubts);
    for word in program.words_left_out() {
        if let Some(foreign) = &mut foreign {
            foreign.left_out(word.line, &word.word);
        }
        if let Some(comparison) = &mut comparison {
            comparison.left_out(word.line, &word.word);
        }
    }
    found.extend(foreign.into_iter().flat_map(WordRules::finish));
    found.extend(past.into_iter().flat_map(PastClamps::finish));
    found.extend(coarse_arcs(program.code(), program.dialect));
    found.extend(limits.map(MachineRules::finish).unwrap_or_default());
    found.extend(sources.unknown_tools());
    if program.dialect == Dialect::Native {
        found.extend(native::unstated_heights(&program.text));
        // PathDxf2GCode states planned lengths, and it is unknown what other programs count.
        if Provenance::of_head(&program.text).is_some() && !native::is_compatible(&program.text) {
            found.extend(stated.finish());
        }
    }
    found.extend(sources.disagreements());
    found.extend(header.problems.iter().cloned());
    if let Some((against, comparison)) = milled.zip(comparison) {
        found.extend(against.conclude(context, &program, comparison.finish(), rewritten.as_ref()));
    }
    if let Some(against) = against.filter(|_| program.dialect == Dialect::Native) {
        let is_sound = !found.iter().chain(&program.read.problems).any(Diagnostic::is_error);
        found.extend(against.text_differences(context, &program, is_probing, is_sound)?);
    }
    let required =
        if args.require.is_empty() { &context.settings.verify.require.value } else { &args.require };
    report.add(context, &sources, machine.as_ref(), &mut found, required);
    program.place(&mut found);
    let mut diagnostics = program.read.problems;
    if is_rewritten {
        // What is doubtful about the definition's words is said when it writes them.
        diagnostics.retain(|diagnostic| diagnostic.is_error() && program.by_definition.is_none());
    } else if against.is_some() {
        let unsaid = diagnostics.iter_mut().filter(|diagnostic| is_unsaid(diagnostic));
        let unchecked = found.iter_mut().filter(|diagnostic| diagnostic.code() == Code::UncheckedFormula);
        unsaid.chain(unchecked).for_each(|diagnostic| diagnostic.severity = Severity::Error);
    }
    diagnostics.append(&mut found);
    Ok(diagnostics)
}

/// Whether a warning is about something that the drawing's program does not contain. The fineness of arcs is up to the drawing, and
/// ignoring feeds was requested.
fn is_unsaid(doubt: &Diagnostic) -> bool {
    doubt.code() != Code::DoubtfulArc && doubt.message.key != FEED_IGNORED.key
}

fn conclude(context: &Context, session: &Session<'_>, diagnostics: Vec<Diagnostic>) -> ExitStatus {
    let findings = context.findings(session.with_hints(diagnostics));
    context.show(&findings);
    let (errors, warnings) = (findings.errors(), findings.warnings());
    let phrase = |en: &'static str, de: &'static str| context.choose(en, de);
    context.printer.status(format_args!(
        "{}: {errors}, {}: {warnings}",
        phrase("errors", "Fehler"),
        phrase("warnings", "Warnungen")
    ));
    if errors > 0 { ExitStatus::Errors } else { ExitStatus::Success }
}

/// The posts that may have written the programs of a run.
pub(super) struct Writers {
    /// `--post`.
    named: Option<PostProcessor>,
    /// The one of the configuration.
    configured: Option<PostProcessor>,
    dialect: Option<Dialect>,
}

impl Writers {
    /// Those of the command line and the configuration.
    ///
    /// # Errors
    /// The named post does not exist, or is broken.
    pub(super) fn new(context: &Context, args: &VerifyArgs) -> Result<Self, Vec<Diagnostic>> {
        let dialect = args.reading.dialect;
        let post = |name| {
            let dialect = dialect.map(|dialect| dialect.name().into());
            PostProcessor::for_run(context, name, PostArguments { dialect, ..PostArguments::default() })
        };
        let named = args.post.as_deref().map(|name| post(Some(name))).transpose()?.flatten();
        // Of a broken one `emit` tells.
        let configured = if named.is_some() { None } else { post(None).ok().flatten() };
        Ok(Self { named, configured, dialect })
    }

    /// The dialect that the command line says, by itself or by the post.
    pub(super) fn dialect(&self) -> Option<Dialect> {
        self.dialect.or(self.named.as_ref().and_then(PostProcessor::reader))
    }

    /// The post that wrote a program of this dialect, as far as it is known. A program that shows no dialect by its header is one of a
    /// configured definition that names none.
    pub(super) fn of(&self, dialect: Dialect, evidence: Option<EvidenceKind>) -> Option<&PostProcessor> {
        let is_without_header = evidence.is_some_and(|kind| kind != EvidenceKind::Header);
        let may_have_written = |post: &&PostProcessor| match post.reader() {
            Some(reader) => reader == dialect,
            None => is_without_header && dialect != Dialect::Native,
        };
        self.named.as_ref().or(self.configured.as_ref().filter(may_have_written))
    }

    /// A text as the definition reads it that wrote it, where that names no dialect.
    pub(super) fn translate(&self, text: &[u8], guess: Option<&Guess>) -> Option<ByDefinition> {
        let dialect = guess.map(|guess| guess.dialect).or(self.dialect)?;
        let writer = self.of(dialect, guess.map(|guess| guess.evidence.kind))?;
        Some(ByDefinition { name: writer.name(), translated: writer.translate(text)? })
    }
}
