//! `verify`: checks that G-code programs are safe to run and match their drawing. (book: program/reading)

mod against;
mod checks;
mod possible_posts;
mod run;
mod stock;

use std::sync::{Arc, Mutex, PoisonError};

use against::{ReferenceProgram, RewrittenProgram};
use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::System;
use pathbuild_diagnostic::messages::gcode::{self as say, FEED_IGNORED, NO_DECIMAL_POINT};
use pathbuild_diagnostic::{Code, Diagnostic, Lang, Message, Severity};
use pathbuild_gcode::adjust::{Source, corrected_heights, first_unapplied_formula, listed_heights};
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::header::{Header, HeaderReader};
use pathbuild_gcode::interpret::Guess;
use pathbuild_gcode::native;
use pathbuild_gcode::provenance::Provenance;
use pathbuild_gcode::verify::{
    BentRapidRules, BlindRapidRules, ChipLoadRules, CornerRules, CuttingLengthRules, DepthRules,
    DirectionRules, DrawingComparison, LengthRules, Machine, MachineRules, PostWords, StatedStatistics,
    Stock, WordRules, coarse_arc_finding, verify,
};
use pathbuild_motion::{Action, Group, Move, Pace, StatedWord, Step};
use pathbuild_path::approx::above;
use pathbuild_post::ToolTable;
use serde::{Deserialize, Serialize};

use crate::config::types::{Requirement, SpindleControl, Tool};
use crate::config::{Settings, number, positive};
use crate::post_processor::{PostProcessor, known_words, machine, tool_table};
use crate::program::{Program, ProgramReader, ReadingOptions, Translate};
use crate::session::Session;
use crate::workspace::Failure;

pub use against::{shims, unmillable_moves};
pub use checks::{
    APPROACH_ABOVE_MATERIAL, Assumption, CheckRecord, MissingCheckReason, Outcome, RapidValues, ValueSource,
    blind_text, summary,
};
use possible_posts::PossiblePosts;
pub use run::{Request, Verification};
use stock::Sources;

/// Options for verifying programs.
#[derive(Clone, Debug, Default)]
pub struct VerifyOptions {
    /// Options for reading the programs.
    pub reading: ReadingOptions,
    /// Name of a path; the programs are compared with its drawing.
    pub against: Option<String>,
    /// Diameter of the cutter in mm.
    pub cutter: Option<f64>,
    /// Height of the material's upper face in mm.
    pub surface: Option<f64>,
    /// The checks that the run requires, besides those that the configuration requires.
    pub required: Vec<Requirement>,
    /// Name or file of the post-processor that wrote the programs.
    pub post: Option<String>,
    /// The control for which the programs will be rewritten. Rapid moves are checked as this control makes them, and not as the control of a
    /// program's dialect does.
    pub target: Option<Dialect>,
}

impl VerifyOptions {
    /// Sets the diameter of the cutter and the height of the material's upper face, if they are given.
    ///
    /// # Errors
    /// The diagnostic of the first text that is not a valid number.
    pub fn with_stock(
        mut self,
        cutter: Option<&str>,
        surface: Option<&str>,
    ) -> Result<Self, Box<Diagnostic>> {
        self.cutter = cutter.map(|text| positive("cutter", text)).transpose()?;
        self.surface = surface.map(|text| number("surface", text)).transpose()?;
        Ok(self)
    }
}

/// The findings about a program, and the checks that were made.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct VerifiedProgram {
    /// All findings about the program.
    pub diagnostics: Vec<Diagnostic>,
    /// The checks; empty if the program could not be checked at all.
    pub checks: Vec<CheckRecord>,
    /// The comparison with the drawing, if one was named.
    pub comparison: Option<MoveComparison>,
    /// The number by which a control identifies a program that pathbuild wrote.
    pub number: Option<u32>,
}

/// A comparison of a program's moves with a drawing.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct MoveComparison {
    /// Name of the path.
    pub path: String,
    /// Path of the drawing's file.
    pub drawing: Utf8PathBuf,
    /// Name of the dialect or the definition with which the program was read.
    pub dialect: String,
    /// Name of the dialect or of the definition, with the evidence for the dialect, in the language of messages.
    pub read_as: String,
    /// Number of moves in the drawing's program, as drawn or as a post-processor with a definition writes it.
    pub moves: usize,
    /// Number of these moves that the verified program contains before the first difference.
    pub equal: usize,
}

/// A verifier of programs, with the data that all programs of a run share.
#[derive(Debug)]
pub struct Verifier<'w> {
    settings: &'w Settings,
    system: Arc<dyn System>,
    lang: Lang,
    options: VerifyOptions,
    writers: PossiblePosts,
    against: Option<ReferenceProgram>,
    table: ToolTable,
    machine: Option<Machine>,
    /// The known words, by dialect and by whether a post-processor wrote the program.
    words: Mutex<Vec<(Dialect, bool, Arc<PostWords>)>>,
}

impl<'w> Verifier<'w> {
    /// Prepares a verification with the settings of the session's workspace.
    ///
    /// # Errors
    /// If the post-processor, or the path to compare with, cannot be used.
    pub fn new(session: &mut Session<'w>, options: VerifyOptions) -> Result<Self, Failure> {
        let workspace = session.workspace();
        let writers = PossiblePosts::new(workspace, &options).map_err(Failure::Post)?;
        let drawn = |name| session.with_stable_files(|session| ReferenceProgram::new(session, name));
        let against = options.against.as_deref().map(drawn).transpose()?;
        let reading = ReadingOptions { dialect: writers.dialect(), ..options.reading };
        Ok(Self {
            settings: &workspace.settings,
            system: Arc::clone(&workspace.system),
            lang: workspace.lang(),
            options: VerifyOptions { reading, ..options },
            writers,
            against,
            table: tool_table(&workspace.settings).with_numbers(),
            machine: machine(&workspace.settings),
            words: Mutex::default(),
        })
    }

    /// Verifies a program. If the program's heights are corrected, the check of rapid moves uses the nominal heights and the material as drawn: rapid
    /// moves that follow an uneven plate do not mill it. The machine's limits and the clamps apply to the actual moves.
    ///
    /// The text is interpreted twice instead of keeping its steps, because the rules need to know the material first.
    pub fn verify(&self, file: &Utf8Path, text: Vec<u8>) -> VerifiedProgram {
        let mut as_written = AsWrittenSteps::new(self.machine.as_ref());
        let definition = |text: &[u8], guess: Option<&Guess>| self.writers.translate(text, guess);
        let program = self.reader(&definition).each(file, text, &mut |step| as_written.step(&step));
        self.examine_with_required(&program, as_written)
    }

    /// Reads a program as [`verify`](Self::verify) does, and stores its steps.
    ///
    /// # Errors
    /// If the program has more steps than may be stored.
    pub fn read(&self, file: &Utf8Path, text: Vec<u8>) -> Result<Program, Box<Diagnostic>> {
        let definition = |text: &[u8], guess: Option<&Guess>| self.writers.translate(text, guess);
        self.reader(&definition).store(file, text)
    }

    fn reader<'a>(&'a self, definition: &'a Translate<'a>) -> ProgramReader<'a> {
        ProgramReader { settings: self.settings, options: self.options.reading, definition }
    }

    /// Verifies a program with stored steps.
    pub fn verify_stored(&self, program: &Program) -> VerifiedProgram {
        self.examine_with_required(program, self.stored_as_written(program))
    }

    /// Returns the findings about a program with stored steps. Required checks that could not be made are not reported.
    pub fn findings(&self, program: &Program) -> Vec<Diagnostic> {
        self.examine(program, self.stored_as_written(program)).diagnostics
    }

    fn stored_as_written(&self, program: &Program) -> AsWrittenSteps<'_> {
        let mut as_written = AsWrittenSteps::new(self.machine.as_ref());
        program.read.steps.iter().for_each(|step| as_written.step(step));
        as_written
    }

    /// Examines a program, and reports required checks that could not be made.
    fn examine_with_required(&self, program: &Program, as_written: AsWrittenSteps<'_>) -> VerifiedProgram {
        let mut verified = self.examine(program, as_written);
        let required = self.required();
        let missing_checks =
            verified.checks.iter().filter_map(|record| record.missing_check_error(&required));
        let mut missing_checks: Vec<Diagnostic> = missing_checks.collect();
        program.attach_source(&mut missing_checks);
        verified.diagnostics.append(&mut missing_checks);
        verified
    }

    fn examine(&self, program: &Program, as_written: AsWrittenSteps<'_>) -> VerifiedProgram {
        let has_probed = as_written.has_probed;
        let number = as_written.number.filter(|_| Provenance::of_head(&program.text).is_some());
        let (header, stated) = as_written.finish(program);
        let verified = Examination::new(self, program, &header, has_probed).run(stated);
        let failed = |diagnostics| VerifiedProgram { diagnostics, ..VerifiedProgram::default() };
        VerifiedProgram { number, ..verified.unwrap_or_else(failed) }
    }

    /// Returns the material that a program cuts, if its cutters and its surface are known.
    pub fn stock(&self, program: &Program, header: &Header) -> Option<Stock> {
        Sources::new(self, program, header).stock().cloned()
    }

    /// Returns the words that programs of this dialect may contain.
    fn known_words(&self, writer: Option<&PostProcessor>, dialect: Dialect) -> Arc<PostWords> {
        let is_posted = writer.is_some();
        let mut all = self.words.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((.., words)) = all.iter().find(|(d, posted, _)| (*d, *posted) == (dialect, is_posted)) {
            return Arc::clone(words);
        }
        let words = Arc::new(known_words(self.settings, &self.system, writer, dialect));
        all.push((dialect, is_posted, Arc::clone(&words)));
        words
    }

    /// Returns the checks that the configuration or the run requires. If either of them excludes assumed values for the check of rapid moves, assumed
    /// values do not suffice, even if the other accepts them.
    fn required(&self) -> Vec<Requirement> {
        let sources = [&self.settings.verify.require.value, &self.options.required];
        let is_strict = |source: &&Vec<Requirement>| {
            source.contains(&Requirement::Rapids) && !source.contains(&Requirement::AssumedRapids)
        };
        let mut required: Vec<Requirement> = sources.into_iter().flatten().copied().collect();
        if sources.iter().any(is_strict) {
            required.retain(|requirement| *requirement != Requirement::AssumedRapids);
        }
        required
    }
}

/// A collector of facts about the steps of a program at the heights in its file, which may include corrections by probes.
struct AsWrittenSteps<'m> {
    header: HeaderReader,
    stated: StatedStatistics,
    limits: Option<MachineRules<'m>>,
    has_probed: bool,
    number: Option<u32>,
}

/// Findings about the steps of a program at the heights in its file.
struct AsWrittenFindings {
    statistics: Vec<Diagnostic>,
    limits: Vec<Diagnostic>,
    travel_doubt: Option<MissingCheckReason>,
}

impl<'m> AsWrittenSteps<'m> {
    fn new(machine: Option<&'m Machine>) -> Self {
        Self {
            header: HeaderReader::default(),
            stated: StatedStatistics::default(),
            limits: machine.map(MachineRules::new),
            has_probed: false,
            number: None,
        }
    }

    fn step(&mut self, step: &Step) {
        self.header.step(step);
        self.stated.step(step);
        if let Action::ProgramNumber(number) = step.action {
            self.number = self.number.or(Some(number));
        }
        self.has_probed |=
            step.as_move().is_some_and(|(_, motion)| matches!(motion.pace, Pace::Probe { .. }));
        if let Some(limits) = &mut self.limits {
            limits.step(step);
        }
    }

    fn finish(self, program: &Program) -> (Header, AsWrittenFindings) {
        // The stated statistics are compared only if pathbuild computed them in its own way: PathDxf2GCode states planned lengths, and other programs
        // may count differently.
        let has_own_statistics = program.dialect == Dialect::Native
            && Provenance::of_head(&program.text).is_some()
            && !native::is_compatible(&program.text);
        let statistics = if has_own_statistics { self.stated.finish() } else { Vec::new() };
        let travel_doubt = self.limits.as_ref().and_then(travel_doubt);
        let limits = self.limits.map(MachineRules::finish).unwrap_or_default();
        (header_of(self.header, program), AsWrittenFindings { statistics, limits, travel_doubt })
    }
}

/// Returns the data that the comments of a program state. The surface is left out if the program was corrected by probes and then converted: its
/// header states the surface of the drawing, but its heights are those of the measured surface.
fn header_of(reader: HeaderReader, program: &Program) -> Header {
    let header = program.finish_header(reader);
    if is_converted_correction(program) {
        Header { surface: None, is_of_pathbuild: false, ..header }
    } else {
        header
    }
}

/// Whether a post-processor wrote the program from one that was corrected by probes. It no longer states how much of its heights is correction.
fn is_converted_correction(program: &Program) -> bool {
    program.dialect != Dialect::Native
        && Provenance::of_head(&program.text).is_some()
        && !listed_heights(&program.text).is_empty()
}

/// Returns the reason why the travel that a program needs is not known; `None` if it is.
fn travel_doubt(limits: &MachineRules<'_>) -> Option<MissingCheckReason> {
    if limits.has_several_frames() {
        Some(MissingCheckReason::SeveralZeros)
    } else {
        limits.has_unknown_axis().then_some(MissingCheckReason::NoPosition)
    }
}

/// The rules that examine the steps of a program at their nominal heights. Each is `None` if it does not apply.
struct NominalRules<'w, I: Iterator<Item = (u32, Move)>> {
    comparison: Option<DrawingComparison<'w, I>>,
    words: Option<WordRules<'w>>,
    chip_loads: ChipLoadRules,
    cutting_lengths: CuttingLengthRules<'w>,
    directions: Option<DirectionRules>,
    lengths: Option<LengthRules<'w>>,
    depths: DepthRules,
    bent_rapids: Option<BentRapidRules<'w>>,
}

impl<I: Iterator<Item = (u32, Move)>> NominalRules<'_, I> {
    fn step(&mut self, step: &Step) {
        self.comparison.iter_mut().for_each(|rules| rules.step(step));
        self.words.iter_mut().for_each(|rules| rules.step(step));
        self.chip_loads.step(step);
        self.cutting_lengths.step(step);
        self.directions.iter_mut().for_each(|rules| rules.step(step));
        self.lengths.iter_mut().for_each(|rules| rules.step(step));
        self.depths.step(step);
        self.bent_rapids.iter_mut().for_each(|rules| rules.step(step));
    }

    /// Applies the rules about words to a word that the translation by means of a definition leaves out.
    fn check_omitted_word(&mut self, line: u32, word: &str) {
        if let Some(words) = &mut self.words {
            words.check_omitted_word(line, word);
        }
        if let Some(comparison) = &mut self.comparison {
            comparison.check_omitted_word(line, word);
        }
    }
}

/// Returns the findings about bent rapid moves in lines without another finding about a rapid move.
fn new_bent_rapids(bent: impl Iterator<Item = Diagnostic>, found: &[Diagnostic]) -> Vec<Diagnostic> {
    let is_of_rapid = |problem: &&Diagnostic| {
        matches!(problem.code(), Code::RapidInMaterial | Code::RapidPlunge | Code::DiagonalRapid)
    };
    let lines: Vec<_> = found.iter().filter(is_of_rapid).map(|problem| problem.place.line).collect();
    bent.filter(|bent| !lines.contains(&bent.place.line)).collect()
}

/// The findings about cuts for which the program has set no spindle speed.
static CUTS_WITHOUT_SPEED: [&Message; 2] = [&say::SPINDLE_OFF, &say::SPINDLE_WITHOUT_SPEED];

/// Facts about the steps seen so far: whether any of them cuts, and whether any starts the spindle with a speed.
#[derive(Clone, Copy, Debug, Default)]
struct SpindleStarts {
    has_cut: bool,
    has_started: bool,
}

impl SpindleStarts {
    fn step(&mut self, step: &Step) {
        match &step.action {
            Action::Move(movement) => self.has_cut |= matches!(movement.pace, Pace::Feed(_)),
            Action::Spindle(spindle) => {
                self.has_started |= spindle.turning.is_on() && spindle.speed.is_some_and(|speed| speed > 0.0);
            }
            _ => {}
        }
    }
}

/// Facts about the steps of a program that decide whether checks are recorded as made.
struct CheckEvidence {
    /// Rapid moves from unknown positions, if the material is known.
    blind: Option<BlindRapidRules>,
    speeds: SpindleStarts,
    corners: CornerRules,
    /// The lowest height in mm that a cut reaches, with the first line that reaches it.
    lowest_cut: Option<(f64, u32)>,
    /// The lowest height in mm to which a probe goes down if it meets nothing, with the first line that reaches it.
    lowest_probe: Option<(f64, u32)>,
    /// The line of the first word that selects inches.
    inch_line: Option<u32>,
    /// Ten times the G code that selects inches.
    inch_word: u16,
    /// The reason why the travel that the program needs is not known; `None` if it is.
    travel_doubt: Option<MissingCheckReason>,
    /// Whether the program's coolant could not be compared with that of the drawing's tool.
    has_uncompared_coolant: bool,
}

impl CheckEvidence {
    fn step(&mut self, step: &Step) {
        self.speeds.step(step);
        self.corners.step(step);
        if let Action::Move(movement) = &step.action
            && let [_, _, Some((low, _))] = movement.extent()
        {
            let lowest = match movement.pace {
                Pace::Feed(_) => Some(&mut self.lowest_cut),
                Pace::Probe { .. } => Some(&mut self.lowest_probe),
                Pace::Rapid => None,
            };
            if let Some(lowest) = lowest.filter(|lowest| lowest.is_none_or(|(known, _)| low < known)) {
                *lowest = Some((low, step.line));
            }
        }
        if let Action::Word(StatedWord { group: Some(Group::Units), code, .. }) = &step.action
            && *code == self.inch_word
        {
            self.inch_line.get_or_insert(step.line);
        }
        if let Some(blind) = &mut self.blind {
            blind.step(step);
        }
    }
}

/// Whether the program joins several paths, according to its title.
fn joins_paths(program: &Program) -> bool {
    Provenance::of_head(&program.text).is_some_and(|(_, title)| native::joined_paths(&title).is_some())
}

/// Returns an error for a program that `diff` cannot compare with the milling program of a path.
pub fn incomparable_with_path(program: &Program) -> Option<Diagnostic> {
    let message = match joins_paths(program) {
        true => &say::JOINED_PROGRAM,
        false if program.header().is_probing => &say::PROBING_PROGRAM,
        false => return None,
    };
    Some(Diagnostic::new(message).in_file(&program.file))
}

/// A program that is being verified, with everything that the rules need.
struct Examination<'v> {
    verifier: &'v Verifier<'v>,
    program: &'v Program,
    header: &'v Header,
    sources: Sources<'v>,
    /// The post-processor that wrote the program, if known.
    writer: Option<&'v PostProcessor>,
    words: Arc<PostWords>,
    /// Whether the program may be the probing run of the path that it is compared with, which is a separate program.
    is_probing: bool,
    /// The path to compare moves with; `None` if there is none, or if the program is the native probing run of the path, which is compared as text.
    reference: Option<&'v ReferenceProgram>,
}

impl<'v> Examination<'v> {
    fn new(verifier: &'v Verifier<'v>, program: &'v Program, header: &'v Header, has_probed: bool) -> Self {
        let evidence = program.evidence.map(|evidence| evidence.kind);
        let writer = verifier.writers.writer_of(program.shown, evidence);
        let is_native = program.dialect == Dialect::Native;
        let against = verifier.against.as_ref();
        let may_probe = header.is_probing || is_native && has_probed;
        let is_probing = may_probe && against.is_some_and(ReferenceProgram::has_probes);
        Self {
            verifier,
            program,
            header,
            sources: Sources::new(verifier, program, header),
            writer,
            words: verifier.known_words(writer, program.dialect),
            is_probing,
            reference: against.filter(|_| !(is_probing && is_native)),
        }
    }

    /// Applies all rules and returns the findings with the checks.
    ///
    /// # Errors
    /// The problem that prevents the verification.
    fn run(&self, written: AsWrittenFindings) -> Result<VerifiedProgram, Vec<Diagnostic>> {
        let read = &self.program.read.problems;
        if read.iter().any(|problem| problem.code() == Code::NotGCode) {
            return Err(read.clone());
        }
        self.refuse_incomparable()?;
        let rewritten = self.rewritten_program()?;
        let mut evidence = CheckEvidence {
            blind: self.sources.stock().and_then(BlindRapidRules::new),
            speeds: SpindleStarts::default(),
            corners: CornerRules::new(self.verifier.settings.general.part_tolerance.value),
            lowest_cut: None,
            lowest_probe: None,
            inch_line: None,
            inch_word: self.program.inch_word(),
            travel_doubt: written.travel_doubt,
            has_uncompared_coolant: false,
        };
        let (mut found, comparison) = self.findings(written, rewritten.as_ref(), &mut evidence);
        if let Some(against) =
            self.verifier.against.as_ref().filter(|_| self.program.dialect == Dialect::Native)
        {
            let is_sound = !found.iter().chain(&self.program.read.problems).any(Diagnostic::is_error);
            let settings = self.verifier.settings;
            let differences = against.text_differences(settings, self.program, self.is_probing, is_sound);
            found.extend(differences.map_err(|problem| vec![*problem])?);
        }
        let drawing_doubt = self.drawing_doubt(comparison.as_ref(), rewritten.as_ref());
        let checks = self.checks(&mut found, drawing_doubt, evidence);
        self.program.attach_source(&mut found);
        let mut diagnostics = self.doubts(rewritten.as_ref(), &mut found);
        diagnostics.append(&mut found);
        diagnostics.extend(self.verifier.against.iter().flat_map(ReferenceProgram::left_out).cloned());
        Ok(VerifiedProgram { diagnostics, checks, comparison, number: None })
    }

    /// Refuses to compare a program with a path if they differ without a fault of the program: if the program joins several paths, was converted
    /// after its heights were corrected, or is a probing program that a definition of the user's own wrote.
    fn refuse_incomparable(&self) -> Result<(), Vec<Diagnostic>> {
        let message = match joins_paths(self.program) {
            _ if self.verifier.against.is_none() => return Ok(()),
            true => &say::JOINED_PROGRAM,
            false if self.is_probing && self.reference.and(self.definition()).is_some() => {
                &say::PROBING_CONVERTED
            }
            false if is_converted_correction(self.program) => &say::CONVERTED_CORRECTION,
            false => return Ok(()),
        };
        let mut problems = vec![Diagnostic::new(message)];
        self.program.attach_source(&mut problems);
        Err(problems)
    }

    /// Returns the post-processor that wrote the program, if its definition is the user's own.
    fn definition(&self) -> Option<&'v PostProcessor> {
        self.writer.filter(|writer| writer.file().is_some())
    }

    /// Returns the drawing's program as the post-processor's definition writes it.
    fn rewritten_program(&self) -> Result<Option<RewrittenProgram>, Vec<Diagnostic>> {
        let rewritten = self.reference.zip(self.definition()).map(|(reference, writer)| {
            reference.rewrite_with_definition(self.verifier.settings, writer, self.program)
        });
        rewritten.transpose()
    }

    /// Returns the rules that apply to the program. `rewritten` is the drawing's program as the post-processor's definition writes it.
    fn rules(
        &self,
        rewritten: Option<&RewrittenProgram>,
    ) -> NominalRules<'_, impl Iterator<Item = (u32, Move)>> {
        let Self { verifier, program, .. } = self;
        let compared = |reference: &'v ReferenceProgram| {
            let (settings, table) = (verifier.settings, &verifier.table);
            let expected = reference.expected(settings, table, program.dialect, self.is_probing, rewritten);
            DrawingComparison::new(expected, program.dialect, &self.words)
        };
        let tools = self.sources.cutting_tools();
        let loads = tools.iter().map(|(order, tool)| (*order, tool.and_then(Tool::chip_load)));
        let edges = tools.iter().map(|(order, tool)| (*order, tool.and_then(Tool::cutting_length)));
        let stock = self.sources.stock();
        let control = verifier.options.target.unwrap_or(program.dialect);
        // The comparison with a drawing reports wrong words, wrong directions and wrong tool lengths itself.
        NominalRules {
            comparison: self.reference.map(compared),
            words: verifier.against.is_none().then(|| WordRules::new(&self.words, program.dialect)),
            chip_loads: ChipLoadRules::new(loads.collect()),
            cutting_lengths: CuttingLengthRules::new(edges.collect(), stock),
            directions: self.reference.is_none().then(|| DirectionRules::new(self.sources.directions())),
            lengths: self.reference.is_none().then(|| LengthRules::new(program.dialect, stock)),
            depths: DepthRules::default(),
            bent_rapids: stock.and_then(|stock| BentRapidRules::new(control, stock)),
        }
    }

    /// Applies the rules and returns their findings, with the comparison if a drawing was named.
    fn findings(
        &self,
        written: AsWrittenFindings,
        rewritten: Option<&RewrittenProgram>,
        evidence: &mut CheckEvidence,
    ) -> (Vec<Diagnostic>, Option<MoveComparison>) {
        let Self { verifier, program, .. } = self;
        let mut rules = self.rules(rewritten);
        let nominal = program.at_nominal_heights();
        let mut found = verify(&nominal, program.dialect, self.sources.stock(), &mut |step| {
            rules.step(step);
            evidence.step(step);
        });
        for word in program.words_left_out() {
            rules.check_omitted_word(word.line, &word.word);
        }
        found.extend(rules.lengths.into_iter().flat_map(LengthRules::finish));
        found.extend(self.sources.doubtful_rapids(rules.depths, &found));
        let bent_rapids = rules.bent_rapids.into_iter().flat_map(|rules| rules.finish(&nominal));
        found.extend(new_bent_rapids(bent_rapids, &found));
        found.extend(rules.words.into_iter().flat_map(WordRules::finish));
        found.extend(verifier.against.iter().flat_map(|against| against.moves_into_clamps(program)));
        found.extend(coarse_arc_finding(program.code(), program.dialect));
        found.extend(written.limits);
        found.extend(rules.chip_loads.finish());
        found.extend(rules.cutting_lengths.finish());
        let is_switched = verifier.settings.general.spindle.value != SpindleControl::Manual
            && !matches!(program.dialect, Dialect::Xpertmill | Dialect::Native);
        let directions = rules.directions;
        found.extend(
            directions.iter().filter(|_| is_switched).find_map(DirectionRules::never_started_finding),
        );
        found.extend(directions.into_iter().flat_map(DirectionRules::finish));
        found.extend(self.sources.unknown_tool_warnings());
        if program.dialect == Dialect::Native {
            found.extend(native::unstated_heights(&program.text));
            found.extend(self.unadjusted_heights());
            let source = Source { file: &program.file, bytes: &program.text };
            let below_plate = verifier.settings.warnings.below_plate.value;
            let model = verifier.settings.general.z_model.value;
            let shims = verifier.against.as_ref().map_or(&[][..], ReferenceProgram::shims);
            found.extend(corrected_heights(source, below_plate, model, shims));
        }
        found.extend(written.statistics);
        found.extend(self.sources.disagreements());
        found.extend(self.header.problems.iter().cloned());
        let Some((reference, comparison)) = self.reference.zip(rules.comparison) else {
            return (found, None);
        };
        let agreement = comparison.finish();
        evidence.has_uncompared_coolant =
            agreement.has_uncompared_coolant && !rewritten.is_some_and(RewrittenProgram::is_same);
        let (comparison, differences) =
            reference.finish_comparison(program, verifier.lang, agreement, self.is_probing, rewritten);
        found.extend(differences);
        (found, comparison)
    }

    /// Returns the reason why not all moves were compared with those of the drawing; `None` if they were.
    fn drawing_doubt(
        &self,
        comparison: Option<&MoveComparison>,
        rewritten: Option<&RewrittenProgram>,
    ) -> Option<MissingCheckReason> {
        if self.verifier.against.is_none() {
            Some(MissingCheckReason::NoDrawing)
        } else if rewritten.is_some_and(|rewritten| !rewritten.is_read_back()) {
            Some(MissingCheckReason::Unchecked)
        } else {
            let is_cut_short = comparison.is_some_and(|comparison| comparison.equal != comparison.moves);
            is_cut_short.then_some(MissingCheckReason::OtherMoves)
        }
    }

    /// Returns the checks with their outcomes. Adds further findings that follow from the evidence, and turns errors about exceeded limits into
    /// warnings.
    fn checks(
        &self,
        found: &mut Vec<Diagnostic>,
        drawing_doubt: Option<MissingCheckReason>,
        evidence: CheckEvidence,
    ) -> Vec<CheckRecord> {
        let mut is_limit_reached = false;
        for problem in found.iter_mut().filter(|problem| problem.code() == Code::LimitReached) {
            is_limit_reached = true;
            // A check that was not made is an error only if it is required.
            problem.severity = Severity::Warning;
        }
        found.extend(self.likely_mistakes_in_own_program(&evidence));
        let CheckEvidence {
            blind, speeds, corners, lowest_cut, travel_doubt, has_uncompared_coolant, ..
        } = evidence;
        let lowest_cut = lowest_cut.map(|(lowest, _)| lowest);
        let verifier = self.verifier;
        let references = checks::References {
            drawing_doubt,
            has_keep_out: verifier.settings.general.keep_out.value.is_some(),
            are_moves_known: self.sources.are_moves_known(),
            travel_doubt,
        };
        let has_bare_cut = found.iter().any(|problem| CUTS_WITHOUT_SPEED.contains(&problem.message));
        let starts_first = !speeds.has_cut || speeds.has_started && !has_bare_cut;
        // XpertMILL sets the speeds by layer, and not in the program.
        let states_speed = starts_first || self.program.dialect == Dialect::Xpertmill;
        let machine = verifier.machine.as_ref();
        let rapids =
            self.sources.rapids(is_limit_reached, blind.and_then(BlindRapidRules::finish), lowest_cut, found);
        found.extend(self.sources.cuts_above_surface_problem(lowest_cut));
        let mut records = checks::records(rapids, machine, references, states_speed);
        // Only LinuxCNC has a word that limits the rounding of corners.
        if self.program.dialect == Dialect::LinuxCnc {
            records.push(checks::corner_record(corners.has_limit()));
        }
        records.extend(has_uncompared_coolant.then(checks::coolant_not_compared));
        found.extend(corners.finish());
        records
    }

    /// Returns doubts about a program of pathbuild that was not compared with its drawing: such a program has Z 0 on the plate, and millimetres
    /// unless a definition of the user's own wrote it.
    fn likely_mistakes_in_own_program(&self, evidence: &CheckEvidence) -> Vec<Diagnostic> {
        if self.verifier.against.is_some() || Provenance::of_head(&self.program.text).is_none() {
            return Vec::new();
        }
        let limit = self.verifier.settings.warnings.below_plate.value;
        let reached =
            [(&say::CUT_BELOW_PLATE, evidence.lowest_cut), (&say::PROBE_BELOW_PLATE, evidence.lowest_probe)];
        let below = reached.into_iter().filter_map(|(message, reached)| {
            let (lowest, line) = reached.filter(|(lowest, _)| above(-lowest, limit))?;
            let problem = Diagnostic::new(message).with("z", lowest).with("depth", -lowest);
            Some(problem.with("limit", limit).at_line(line, None))
        });
        let is_built_in = self.writer.is_none_or(|writer| writer.file().is_none());
        let inches = evidence.inch_line.filter(|_| is_built_in);
        let inches = inches.map(|line| Diagnostic::new(&say::INCHES_OF_PATHBUILD).at_line(line, None));
        below.chain(inches).collect()
    }

    /// Warns about a native program whose heights `adjust` has not corrected. If its header states measured heights, each such height is an error of
    /// its own (PB776).
    fn unadjusted_heights(&self) -> Option<Diagnostic> {
        let mut problems = self.program.read.problems.iter();
        let line = first_unapplied_formula(&self.program.text)?;
        let is_reported = problems.any(|problem| problem.code() == Code::UncheckedFormula);
        (!is_reported).then(|| Diagnostic::new(&say::UNADJUSTED).at_line(line, None))
    }

    /// Returns doubts about the program's words. If there is a drawing to compare with, doubts about words that the drawing's program does not
    /// contain become errors, and so do unchecked formulas in `found`.
    fn doubts(&self, rewritten: Option<&RewrittenProgram>, found: &mut [Diagnostic]) -> Vec<Diagnostic> {
        let mut doubts = self.program.read.problems.clone();
        if rewritten.is_some_and(RewrittenProgram::is_same) {
            // Doubts about the words that a definition writes are reported when a program is written through it.
            let is_own = self.program.by_definition.is_none();
            doubts.retain(|doubt| {
                doubt.is_error() && is_own
                    || matches!(doubt.code(), Code::UnitsNotStated | Code::ModesNotStated)
                    || doubt.message.key == NO_DECIMAL_POINT.key
            });
        } else if self.verifier.against.is_some() {
            let absent = doubts.iter_mut().filter(|doubt| is_absent_from_drawing(doubt));
            let unchecked = found.iter_mut().filter(|problem| problem.code() == Code::UncheckedFormula);
            absent.chain(unchecked).for_each(|problem| problem.severity = Severity::Error);
        }
        doubts
    }
}

/// Whether the doubt concerns words that the drawing's program does not contain. Two kinds never do: doubts about arcs, because the drawing does not
/// determine how fine they are, and about ignored feeds, because the user asked to ignore them.
fn is_absent_from_drawing(doubt: &Diagnostic) -> bool {
    doubt.code() != Code::DoubtfulArc && doubt.message.key != FEED_IGNORED.key
}
