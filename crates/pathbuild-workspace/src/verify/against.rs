//! Compares a program with a path's drawing. (book: program/reading, `verify --against`)

use std::sync::Arc;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::{Db, Role, Target, Trace, check_file, heights_of_shims, placed_keep_outs, program};
use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_diagnostic::{Code, Diagnostic, Lang, Message};
use pathbuild_gcode::adjust::{Source, adjust_with_listed_heights, has_measured_heights};
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::interpret::{self, Options, Text};
use pathbuild_gcode::native::{self, OtherLine, Parts};
use pathbuild_gcode::provenance::Provenance;
use pathbuild_gcode::read::quote;
use pathbuild_gcode::verify::{Clamps, ComparisonResult, ExpectedProgram, ToolUse, text_beyond_machine};
use pathbuild_motion::{Axes, Move, Pace, Position};
use pathbuild_path::KeepOut;
use pathbuild_post::{Job, ToolTable, program_number};

use super::MoveComparison;
use crate::config::Settings;
use crate::config::types::DwellTime;
use crate::emit::{Provenances, missing_values, native_text, program_remarks, write_settings};
use crate::post_processor::{PostProcessor, machine};
use crate::program::Program;
use crate::session::{NamedPaths, NotOnePath, OutputKind, Session, several_paths_error};
use crate::workspace::Failure;

/// The program of a path according to its drawing, with which other programs are compared.
#[derive(Debug)]
pub(super) struct ReferenceProgram {
    drawn: Arc<pathbuild_toolpath::Program>,
    /// Path of the drawing's file.
    file: Utf8PathBuf,
    /// The clamps around the program, if its drawings contain any.
    clamps: Option<Clamps>,
    /// The heights in mm by which embedded paths are raised.
    shims: Vec<f64>,
    /// PB111 for elements on the layers of the program's paths that are not milled.
    left_out: Vec<Diagnostic>,
    /// The inputs that the program depends on; `None` unless the session traces them.
    trace: Option<Trace>,
}

/// The program that a post-processor with a definition currently writes for a path.
pub(super) struct RewrittenProgram {
    /// Number of the first line in which the verified program differs, and the expected line.
    other_line: Option<(u32, String)>,
    /// The first position that is stated in all axes.
    start: Option<Position>,
    /// The moves after `start`, with their lines.
    moves: Vec<(u32, Move)>,
    /// Tool and spindle of the cuts.
    tool: ToolUse,
    /// Whether the post-processor compares its output with the drawing.
    is_read_back: bool,
}

impl RewrittenProgram {
    pub(super) fn is_same(&self) -> bool {
        self.other_line.is_none()
    }

    pub(super) fn is_read_back(&self) -> bool {
        self.is_read_back
    }
}

/// Returns the clamps around the program of a target; `None` if there are none.
fn clamps(db: &dyn Db, target: Target) -> Option<Clamps> {
    let placed: Vec<KeepOut> = placed_keep_outs(db, target).into_iter().map(|clamp| clamp.placed).collect();
    let cutter = program(db, target).as_ref()?.largest_cutter();
    (!placed.is_empty()).then(|| Clamps::new(placed, cutter))
}

/// Returns the heights in mm by which embedded paths are raised in the program of a target, in the order in which they begin.
///
/// # Errors
/// PB006 if a query triggers a bug.
pub fn shims(session: &Session<'_>, target: Target) -> Result<Vec<f64>, Box<Diagnostic>> {
    session.query_target(target, |db| heights_of_shims(db, target))
}

/// Returns the errors of a native program that cannot run on the machine, because it exceeds the machine's capabilities (PB747, PB748) or hits clamps
/// around the program of this target (PB407). Heights are those to which the tool moves, with their corrections.
///
/// # Errors
/// PB006 if a query triggers a bug.
pub fn unmillable_moves(
    session: &Session<'_>,
    target: Option<Target>,
    program: Source<'_>,
) -> Result<Vec<Diagnostic>, Box<Diagnostic>> {
    let machine = machine(&session.workspace().settings);
    let clamps = target.map(|target| session.query_target(target, |db| clamps(db, target))).transpose()?;
    let text = Text { text: program.bytes, dialect: Dialect::Native, options: Options::default() };
    let collisions = clamps.flatten().map(|clamps| clamps.collisions(&text));
    let beyond = machine.map(|machine| text_beyond_machine(program.bytes, &machine));
    let mut found: Vec<Diagnostic> = collisions.into_iter().chain(beyond).flatten().collect();
    quote(found.iter_mut(), program.bytes);
    Ok(found.into_iter().map(|problem| problem.in_file(program.file)).collect())
}

impl ReferenceProgram {
    pub(super) fn new(session: &Session<'_>, name: &str) -> Result<Self, Failure> {
        let target = target(session, name)?;
        let checked = session.check(&[target]);
        let [checked] = checked.as_slice() else { return Err(Failure::Found(Vec::new())) };
        if checked.diagnostics.iter().any(Diagnostic::is_error) {
            return Err(Failure::Found(checked.diagnostics.clone()));
        }
        if !checked.missing_options.is_empty() {
            let names = checked.missing_options.iter().map(|option| option.name());
            return Err(Failure::Usage(missing_values(session.workspace(), names)));
        }
        let outcome = session.query_target(target, |db| {
            Some((program(db, target).clone()?, clamps(db, target), heights_of_shims(db, target)))
        });
        let found = outcome.map_err(|problem| Failure::Found(vec![*problem]))?;
        let (drawn, clamps, shims) = found.ok_or_else(|| Failure::Found(Vec::new()))?;
        let file = target.file(session.db()).path(session.db()).clone();
        let is_left_out =
            |found: &&Diagnostic| !drawn.left_out.is_empty() && found.code() == Code::UnsupportedCurve;
        let left_out = checked.diagnostics.iter().filter(is_left_out).cloned().collect();
        Ok(Self { drawn, file, clamps, shims, left_out, trace: checked.trace.clone() })
    }

    pub(super) fn left_out(&self) -> &[Diagnostic] {
        &self.left_out
    }

    pub(super) fn shims(&self) -> &[f64] {
        &self.shims
    }

    pub(super) fn file(&self) -> &Utf8Path {
        &self.file
    }

    pub(super) fn trace(&self) -> Option<&Trace> {
        self.trace.as_ref()
    }

    /// Returns the diameter O in mm, if all cuts use the same tool.
    pub(super) fn cutter(&self) -> Option<f64> {
        self.drawn.cutter()
    }

    /// Returns the height of the upper face of the material in mm, if it is the same for all cuts.
    pub(super) fn surface(&self) -> Option<f64> {
        self.drawn.surface()
    }

    /// Returns the program with which a program in a dialect must agree according to the drawing: the milling program, at nominal heights before
    /// correction, or the probing program.
    pub(super) fn expected(
        &self,
        settings: &Settings,
        table: &ToolTable,
        dialect: Dialect,
        is_probing: bool,
        rewritten: Option<&RewrittenProgram>,
    ) -> ExpectedProgram<impl Iterator<Item = (u32, Move)>> {
        let clearance = self.drawn.start_height();
        let above_zero = Position::known(0.0, 0.0, clearance);
        let (start, written) = rewritten.map_or((above_zero, None), |known| {
            (known.start.unwrap_or(above_zero), Some(known.moves.clone()))
        });
        let is_milling = written.is_none() && !is_probing;
        let milling = is_milling.then(|| self.drawn.moves());
        let probing = is_probing.then(|| self.probing_moves(dialect));
        ExpectedProgram {
            moves: milling
                .into_iter()
                .flatten()
                .chain(probing.into_iter().flatten())
                .chain(written.into_iter().flatten()),
            pecks: if is_milling && settings.general.cycles.value && dialect != Dialect::Native {
                self.drawn.pecks()
            } else {
                Vec::new()
            },
            start,
            clearance,
            is_probing,
            tool: self
                .tool(table)
                .filled_from(rewritten.map_or(ToolUse::default(), |rewritten| rewritten.tool)),
            number: self.number(settings),
            spin_up: settings.machine.spin_up.value,
        }
    }

    /// Returns the moves of the probing program as a control with this dialect makes them.
    fn probing_moves(&self, dialect: Dialect) -> impl Iterator<Item = (u32, Move)> {
        // Controls without G38.2 have G31, which goes on if it touches nothing.
        let has_alarm = dialect.rules().words.has_g(382);
        let mut was_probe = false;
        (1..).zip(self.drawn.probing_moves()).map(move |(number, (_, mut movement))| {
            if was_probe {
                // Only the machine knows the height at which the probe has stopped.
                movement.from.known = Axes::XY;
            }
            was_probe = matches!(movement.pace, Pace::Probe { .. });
            if let Pace::Probe { must_answer, .. } = &mut movement.pace {
                *must_answer = has_alarm;
            }
            (number, movement)
        })
    }

    /// Returns the extent of the comparison, and the differences; there are none if the program has exactly the lines that its definition writes.
    /// The output of an unchecked definition serves as the reference for its programs, but does not prove that they match the drawing.
    pub(super) fn finish_comparison(
        &self,
        program: &Program,
        lang: Lang,
        agreement: ComparisonResult,
        is_probing: bool,
        rewritten: Option<&RewrittenProgram>,
    ) -> (Option<MoveComparison>, Vec<Diagnostic>) {
        let comparison = |equal, moves| {
            let (path, drawing) = ((*self.drawn.path).to_owned(), self.file.clone());
            let (dialect, read_as) = (program.reading_name().to_owned(), program.describe_reading(lang));
            Some(MoveComparison { path, drawing, dialect, read_as, moves, equal })
        };
        let drawn = if is_probing { self.drawn.probing_moves().count() } else { self.drawn.moves().count() };
        let Some(rewritten) = rewritten else {
            return (comparison(agreement.equal, drawn), agreement.differences);
        };
        let (mut differences, equal, moves) = match &rewritten.other_line {
            None => (Vec::new(), drawn, drawn),
            Some(_) => (agreement.differences, agreement.equal, rewritten.moves.len()),
        };
        let compared = rewritten.is_read_back.then(|| comparison(equal, moves)).flatten();
        if compared.is_none() {
            let unread = Diagnostic::new(&say::MOVES_NOT_COMPARED).quoting("path", &*self.drawn.path);
            differences.push(unread.quoting("post", program.describe_reading(lang)));
        }
        // Words that the translation leaves out can be compared only as text.
        if let Some((line, expected)) = &rewritten.other_line
            && program.words_left_out().next().is_some()
        {
            let problem = Diagnostic::new(&say::LINE_NOT_WRITTEN).quoting("expected", expected.as_str());
            differences.push(problem.at_line(*line, None));
        }
        (compared, differences)
    }

    /// Writes the program of the path through a post-processor with a definition.
    ///
    /// # Errors
    /// If the definition cannot write the program.
    pub(super) fn rewrite_with_definition(
        &self,
        settings: &Settings,
        writer: &PostProcessor,
        program: &Program,
    ) -> Result<RewrittenProgram, Vec<Diagnostic>> {
        let programs = std::slice::from_ref(&*self.drawn);
        let (mut job, _) =
            Job::from_programs(&self.drawn.path, programs, &writer.tools, writer.options.cycles);
        job.remarks = self.remarks(settings, writer);
        let text = writer.write(&job, None, &mut Vec::new())?.text;
        let translated = writer.translate(&text).map(|translated| translated.text.into_bytes());
        let code = translated.as_deref().unwrap_or(&text);
        let options = Options {
            milliseconds: settings.machine.dwell.value == DwellTime::Milliseconds,
            ..Options::default()
        };
        let read = interpret::interpret(code, program.dialect, &options);
        let (all, tool) = (read.moves(), ToolUse::of_cuts(&read.steps, program.dialect));
        let begins = all.iter().position(|(_, movement)| movement.to.known == Axes::ALL);
        let start = begins.map(|index| all[index].1.to);
        let moves = all.into_iter().skip(begins.map_or(0, |index| index + 1)).collect();
        let other_line = writer.first_other_line(&program.text, &text);
        Ok(RewrittenProgram { other_line, start, moves, tool, is_read_back: !writer.is_unchecked() })
    }

    /// Returns the comments that `emit` writes at the head of the path's program, because line numbers count them.
    fn remarks(&self, settings: &Settings, writer: &PostProcessor) -> Vec<Box<str>> {
        let provenance = Provenances::new(settings, Some(writer)).of(&[&*self.drawn]).to_string();
        let title = native::title(self.file.file_name().unwrap_or_default(), &self.drawn.path);
        program_remarks(&provenance, &title, [&*self.drawn], settings.comment_lang())
    }

    /// Whether the path has probes, and hence a probing run.
    pub(super) fn has_probes(&self) -> bool {
        !self.drawn.probes.is_empty()
    }

    /// Compares the text of a native program with what `emit` would write. Differences in formulas and probes, and in the lines of a probing run,
    /// are errors. If nothing else was found and the options are the same, a different comment is a warning.
    ///
    /// # Errors
    /// PB005 if the text that `emit` would write is too large.
    pub(super) fn text_differences(
        &self,
        settings: &Settings,
        program: &Program,
        is_probing: bool,
        is_sound: bool,
    ) -> Result<Vec<Diagnostic>, Box<Diagnostic>> {
        let kind = match (is_probing, self.has_probes()) {
            (true, _) => OutputKind::Probing,
            (false, true) => OutputKind::Clean,
            (false, false) => OutputKind::Milling,
        };
        let text = native_text(settings, &self.drawn, kind)?.into_bytes();
        if is_probing && let Some(other) = native::first_other_line(&program.text, &text, Parts::Code) {
            return Ok(vec![other_line([&say::PROBING_NOT_DRAWN, &say::PROBING_ENDED], other)]);
        }
        let correction = write_settings(settings).options.correction;
        let mut differences = Vec::new();
        if !is_probing {
            differences = native::formula_differences(&program.text, &self.drawn, correction);
        }
        let header = Provenance::of_head(&program.text).map(|(provenance, _)| provenance);
        let now = Provenances::new(settings, None).of(&[&*self.drawn]);
        // A program that pathbuild wrote keeps its title if its first line, with the header, was removed or damaged.
        let has_same_options =
            header.map_or_else(|| native::has_title(&program.text), |header| header.options == now.options);
        if !differences.is_empty() || !is_sound || !has_same_options {
            return Ok(differences);
        }
        let source = |bytes| Source { file: &program.file, bytes };
        let is_adjusted = has_measured_heights(source(&program.text));
        let text = if is_adjusted {
            adjust_with_listed_heights(source(&program.text), source(&text))
        } else {
            Some(text)
        };
        let other = text.and_then(|text| native::first_other_line(&program.text, &text, Parts::Comments));
        differences.extend(other.map(|other| other_line([&say::TEXT_DIFFERS, &say::TEXT_ADDED], other)));
        Ok(differences)
    }

    /// Returns PB407 for moves of a program into the clamps around it, at the heights to which the machine moves.
    pub(super) fn moves_into_clamps(&self, program: &Program) -> Vec<Diagnostic> {
        self.clamps.as_ref().map_or_else(Vec::new, |clamps| clamps.collisions(&program.as_executed()))
    }

    /// Returns the program number that posts write.
    fn number(&self, settings: &Settings) -> Option<u32> {
        let configured = settings.general.post.value.program_number;
        configured.or_else(|| program_number(&self.drawn.path))
    }

    /// Returns the configured tool for the path.
    fn tool(&self, table: &ToolTable) -> ToolUse {
        let Some(entry) = table.find(&self.drawn.path, self.drawn.tool) else { return ToolUse::default() };
        ToolUse { number: entry.index, turning: entry.spindle, speed: entry.speed, coolant: entry.coolant }
    }
}

/// Returns a finding about a line that differs: with the first message, or with the second if the expected text ends before this line.
fn other_line([differs, has_ended]: [&'static Message; 2], other: OtherLine) -> Diagnostic {
    let message = if other.expected.is_empty() { has_ended } else { differs };
    Diagnostic::new(message).quoting("expected", other.expected).at_line(other.line, None)
}

fn target(session: &Session<'_>, name: &str) -> Result<Target, Failure> {
    session.one_path(name, Role::Emitted).map_err(|not_one| match not_one {
        NotOnePath::Wrong(found) => Failure::Found(found),
        NotOnePath::Several(NamedPaths { file, names }) => {
            let db = session.db();
            let mut found = check_file(db, file).to_vec();
            if !found.iter().any(Diagnostic::is_error) {
                found.push(several_paths_error(file.path(db), &names));
            }
            Failure::Found(found)
        }
        NotOnePath::Directory => Failure::Usage(session.workspace().phrase(
            "--against takes one path: `{}` is a directory",
            "--against braucht einen Pfad: `{}` ist ein Verzeichnis",
            name,
        )),
    })
}
