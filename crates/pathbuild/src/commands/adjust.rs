//! `pathbuild adjust`: inserts measured heights into programs. (book: language/probes)

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::{FileKind, WriteOutcome, join};
use pathbuild_db::{Target, catch_bugs};
use pathbuild_diagnostic::messages::probes;
use pathbuild_diagnostic::{Code, Diagnostic, with_decimal_separator};
use pathbuild_gcode::adjust::{AdjustedProgram, Inputs, Source, adjust};
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::interpret::{Options, interpret_each};
use pathbuild_gcode::native;
use pathbuild_gcode::provenance::Provenance;
use pathbuild_gcode::read::quote;
use regex::Regex;
use serde_json::json;

use super::{output_row, state_word};
use crate::args::AdjustArgs;
use crate::context::Context;
use crate::exit::ExitStatus;
use pathbuild_workspace::config::{positive, regex};
use pathbuild_workspace::emit::{DrawingComparison, compare_with_drawing};
use pathbuild_workspace::files::write_error;
use pathbuild_workspace::findings::Findings;
use pathbuild_workspace::session::{OutputKind, Session};
use pathbuild_workspace::verify::{shims, unmillable_moves};

/// Runs the command. If there are several programs, an error in one does not prevent writing the others.
pub fn run(context: &Context, args: &AdjustArgs) -> ExitStatus {
    let mut adjustment = match Adjustment::new(context, args) {
        Ok(adjustment) => adjustment,
        Err(fault) => return context.refuse(vec![*fault]),
    };
    let mut jobs: Vec<Job> = Vec::new();
    let out_dir = context.settings.general.out_dir.value.as_deref();
    for file in &args.files {
        match Job::jobs_of_argument(context, file, out_dir) {
            Ok(all) => {
                for job in all {
                    if jobs.iter().all(|known| known.clean != job.clean) {
                        jobs.push(job);
                    }
                }
            }
            Err(problem) => adjustment.fail(vec![*problem]),
        }
    }
    if args.log.is_some() && jobs.len() > 1 {
        return context.usage_error(context.choose(
            "--log holds the results of one probing run: name only one program",
            "--log enthält die Ergebnisse eines einzigen Antastprogramms: nur ein Programm nennen",
        ));
    }
    for job in &jobs {
        if let Err(problems) = adjustment.run(job) {
            adjustment.fail(problems);
        }
    }
    adjustment.conclude()
}

struct Adjustment<'a> {
    context: &'a Context,
    max_correction: f64,
    shown: Option<Regex>,
    log: Option<&'a Utf8Path>,
    errors: Vec<Diagnostic>,
    warnings: Vec<Diagnostic>,
    has_failed: bool,
}

/// Returns the errors that show that formulas of a program were removed or changed.
fn edited_heights(job: &Job, adjusted: &AdjustedProgram) -> Vec<Diagnostic> {
    let read = interpret_each(&adjusted.program, Dialect::Native, &Options::default(), &mut |_| {});
    let is_of_heights = |problem: &Diagnostic| {
        matches!(problem.code(), Code::UncheckedFormula | Code::InvalidWord) && problem.is_error()
    };
    let of_heights = read.into_iter().filter(is_of_heights);
    let mut wrong: Vec<Diagnostic> = of_heights.map(|problem| problem.in_file(&job.clean)).collect();
    quote(wrong.iter_mut(), &adjusted.program);
    [adjusted.unused.clone(), wrong].concat()
}

/// The files of a program that is adjusted.
#[derive(Clone, Debug)]
struct Job {
    /// The drawing, if the argument is the name of one.
    drawing: Option<Utf8PathBuf>,
    clean: Utf8PathBuf,
    values: Utf8PathBuf,
    milling: Utf8PathBuf,
}

const CLEAN_SUFFIX: &str = OutputKind::Clean.suffix();
const VALUES_SUFFIX: &str = OutputKind::Values.suffix();

impl Job {
    /// Returns the programs that an argument refers to. The argument names a file of a program, or a drawing. The programs of a drawing are
    /// where `emit` writes them. Their names may contain more than the drawing's name (the text of the letter R, or the name of the path
    /// if the drawing has several); such programs are recognised by their headers, which identify the drawing.
    ///
    /// # Errors
    /// PB006 if listing the programs' directory triggers a bug.
    fn jobs_of_argument(
        context: &Context,
        argument: &Utf8Path,
        out_dir: Option<&Utf8Path>,
    ) -> Result<Vec<Self>, Box<Diagnostic>> {
        let job = Self::new(argument, out_dir);
        let is_there = |job: &Self| context.system.kind(&job.clean) != FileKind::Missing;
        let Some(drawing) = drawing_of(argument).filter(|_| !is_there(&job)) else {
            return Ok(vec![job]);
        };
        // The program may be beside the drawing, although this configuration would write it elsewhere.
        let beside = Self::new(Utf8Path::new(&format!("{argument}{CLEAN_SUFFIX}")), out_dir);
        if is_there(&beside) {
            return Ok(vec![beside]);
        }
        let directory = job.clean.parent().unwrap_or(Utf8Path::new("")).to_owned();
        let listed = catch_bugs(|| context.system.list(&directory));
        let listed = listed.map_err(|bug| Box::new(bug.in_file(&directory)))?;
        let Ok(listing) = listed else { return Ok(vec![job]) };
        let programs = listing.files.iter().filter(|name| without_suffix(name, CLEAN_SUFFIX).is_some());
        let mut named: Vec<&str> = programs
            .filter(|name| is_program_of_drawing(context, &join(&directory, name), &drawing))
            .collect();
        named.sort_unstable();
        let found = |name: &&str| Self {
            drawing: job.drawing.clone(),
            ..Self::new(&join(&directory, name), out_dir)
        };
        let found: Vec<Self> = named.iter().map(found).collect();
        Ok(if found.is_empty() { vec![job] } else { found })
    }

    fn new(argument: &Utf8Path, out_dir: Option<&Utf8Path>) -> Self {
        let name = argument.file_name().unwrap_or_default();
        let beside = argument.parent().unwrap_or(Utf8Path::new(""));
        let written = out_dir.unwrap_or(beside);
        let (stem, from) = match stem_of_program(name) {
            Some(stem) => (stem, beside),
            None => (without_suffix(name, ".dxf").unwrap_or(name), written),
        };
        let is_drawing = without_suffix(name, ".dxf").is_some();
        Self {
            drawing: is_drawing.then(|| argument.to_owned()),
            clean: join(from, OutputKind::Clean.file(stem)),
            values: join(from, OutputKind::Values.file(stem)),
            milling: join(written, OutputKind::Milling.file(stem)),
        }
    }
}

/// Returns the file name of the drawing that an argument names, with or without extension; `None` if the argument is a file of a program.
fn drawing_of(argument: &Utf8Path) -> Option<String> {
    let name = argument.file_name()?;
    let stem = without_suffix(name, ".dxf").unwrap_or(name);
    stem_of_program(name).is_none().then(|| format!("{stem}.dxf"))
}

/// Returns the part of a file name that the files of a program have in common; `None` if the name is neither that of a program nor that of its
/// measured values.
pub(super) fn stem_of_program(name: &str) -> Option<&str> {
    [CLEAN_SUFFIX, VALUES_SUFFIX].iter().find_map(|suffix| without_suffix(name, suffix))
}

/// Whether the header of a program names this drawing.
fn is_program_of_drawing(context: &Context, program: &Utf8Path, drawing: &str) -> bool {
    let text = context.system.read(program, context.settings.limits.file_size.value).unwrap_or_default();
    Provenance::of_head(&text).is_some_and(|(_, title)| native::is_title_of(&title, drawing))
}

/// Strips a suffix from a name, ignoring case.
fn without_suffix<'n>(name: &'n str, suffix: &str) -> Option<&'n str> {
    let (stem, end) = name.split_at_checked(name.len().checked_sub(suffix.len())?)?;
    end.eq_ignore_ascii_case(suffix).then_some(stem)
}

impl<'a> Adjustment<'a> {
    fn new(context: &'a Context, args: &'a AdjustArgs) -> Result<Self, Box<Diagnostic>> {
        let max_correction = positive("max-correction", &args.max_correction)?;
        let shown = args.show.as_deref().map(|pattern| regex("show", pattern)).transpose()?;
        Ok(Self {
            context,
            max_correction,
            // The pattern was validated above, so this cannot fail.
            shown: shown.and_then(|pattern| Regex::new(pattern).ok()),
            log: args.log.as_deref(),
            errors: Vec::new(),
            warnings: Vec::new(),
            has_failed: false,
        })
    }

    fn fail(&mut self, problems: Vec<Diagnostic>) {
        self.has_failed = true;
        self.errors.extend(problems);
    }

    fn run(&mut self, job: &Job) -> Result<(), Vec<Diagnostic>> {
        let (clean, values, log) = self.read(job)?;
        self.show(&clean);
        let mut session = Session::new(self.context);
        let target = self.compare(&mut session, job, &clean)?;
        let shims = target.map(|target| shims(&session, target)).transpose();
        let shims = shims.map_err(|problem| vec![*problem])?.unwrap_or_default();
        let source = |file, bytes| Source { file, bytes };
        let adjusted = adjust(&Inputs {
            program: source(&job.clean, &clean),
            values: source(&job.values, &values),
            log: self.log.zip(log.as_deref()).map(|(file, bytes)| source(file, bytes)),
            max_correction: self.max_correction,
            below_plate: self.context.settings.warnings.below_plate.value,
            model: self.context.settings.general.z_model.value,
            shims: &shims,
        })?;
        if target.is_none() {
            let edited = edited_heights(job, &adjusted);
            if !edited.is_empty() {
                return Err(edited);
            }
        }
        let corrected = source(&job.clean, &adjusted.program);
        let unmillable = unmillable_moves(&session, target, corrected).map_err(|problem| vec![*problem])?;
        let (errors, warnings): (Vec<_>, Vec<_>) = unmillable.into_iter().partition(Diagnostic::is_error);
        if !errors.is_empty() {
            return Err(errors);
        }
        self.warnings.extend(warnings);
        let written = self.context.system.write(&job.milling, &adjusted.program);
        let written = written.map_err(|reason| vec![write_error(&job.milling, reason)])?;
        self.report_written(&job.milling, written, &adjusted);
        self.warnings.extend(adjusted.warnings);
        Ok(())
    }

    /// Compares a program with its drawing. Returns the target whose program it is, if the program is known to be up to date.
    ///
    /// # Errors
    /// The drawing has errors or now produces a different program, or the program was edited.
    fn compare(
        &self,
        session: &mut Session<'_>,
        job: &Job,
        clean: &[u8],
    ) -> Result<Option<Target>, Vec<Diagnostic>> {
        let context = self.context;
        let not_compared =
            context.choose("not compared with its drawing", "nicht mit der Zeichnung verglichen");
        let beside = job.clean.parent().unwrap_or(Utf8Path::new(""));
        let comparison = compare_with_drawing(session, clean, beside, job.drawing.as_deref());
        let is_other = matches!(
            comparison,
            DrawingComparison::Other { .. } | DrawingComparison::Edited { .. } | DrawingComparison::Wrong(_)
        );
        if is_other && let Some(problem) = self.other_mode_problem(job, clean) {
            return Err(vec![problem]);
        }
        let outdated = |message, drawing: &Utf8Path| {
            Diagnostic::new(message)
                .quoting("name", job.clean.file_name().unwrap_or_default())
                .quoting("drawing", drawing.as_str())
                .in_file(&job.clean)
        };
        match comparison {
            DrawingComparison::Same(target) => return Ok(Some(target)),
            DrawingComparison::Unknown => {}
            DrawingComparison::Wrong(problems) => return Err(problems),
            DrawingComparison::Other { drawing } => {
                return Err(vec![outdated(&probes::OLD_PROGRAM, &drawing)]);
            }
            DrawingComparison::Edited { drawing, other } => {
                let mut problem = outdated(&probes::EDITED_PROGRAM, &drawing).at_line(other.line, None);
                quote([&mut problem], clean);
                return Err(vec![problem]);
            }
            DrawingComparison::NoDrawing { drawing } => {
                let is_missing = context.choose("was not found", "wurde nicht gefunden");
                context.printer.status(format_args!("{}: {not_compared}: {drawing} {is_missing}", job.clean));
            }
            DrawingComparison::NeedsOptions(missing) => {
                let options: Vec<&str> = missing.iter().map(|option| option.name()).collect();
                let give = context.choose("give", "es fehlt");
                let options = options.join(" --");
                context.printer.status(format_args!("{}: {not_compared}: {give} --{options}", job.clean));
            }
        }
        Ok(None)
    }

    /// Returns PB608 if the program is up to date with the opposite setting of `--compatible`.
    fn other_mode_problem(&self, job: &Job, clean: &[u8]) -> Option<Diagnostic> {
        let is_compatible = self.context.settings.general.compatible.value;
        let workspace = self.context.with_compatible_mode(!is_compatible);
        let beside = job.clean.parent().unwrap_or(Utf8Path::new(""));
        let comparison =
            compare_with_drawing(&mut Session::new(&workspace), clean, beside, job.drawing.as_deref());
        let message =
            if is_compatible { &probes::NOT_COMPATIBLE_PROGRAM } else { &probes::COMPATIBLE_PROGRAM };
        let name = job.clean.file_name().unwrap_or_default();
        let problem = || Diagnostic::new(message).quoting("name", name).in_file(&job.clean);
        matches!(comparison, DrawingComparison::Same(_)).then(problem)
    }

    /// Reads the program, the measured values and the log. Reports every file that cannot be read.
    #[expect(clippy::type_complexity, clippy::result_large_err, reason = "destructured by its only caller")]
    fn read(&self, job: &Job) -> Result<(Vec<u8>, Vec<u8>, Option<Vec<u8>>), Vec<Diagnostic>> {
        let limit = self.context.settings.limits.file_size.value;
        let read = |file: &Utf8Path| {
            self.context
                .system
                .read(file, limit)
                .map_err(|error| error.diagnostic(limit, "file-size").in_file(file))
        };
        match (read(&job.clean), read(&job.values), self.log.map(read).transpose()) {
            (Ok(clean), Ok(values), Ok(log)) => Ok((clean, values, log)),
            (clean, values, log) => {
                Err([clean.err(), values.err(), log.err()].into_iter().flatten().collect())
            }
        }
    }

    fn show(&self, program: &[u8]) {
        let Some(pattern) = &self.shown else { return };
        let text = String::from_utf8_lossy(program);
        for line in text.lines().filter(|line| pattern.is_match(line)) {
            self.context.printer.result_line(line);
        }
    }

    fn report_written(&self, file: &Utf8Path, written: WriteOutcome, adjusted: &AdjustedProgram) {
        self.context.json_row(|| {
            let (kind, mut row) = output_row(self.context, file, written);
            row["heights"] = adjusted.heights.into();
            row["corrections"] = json!([adjusted.corrections.0, adjusted.corrections.1]);
            (kind, row)
        });
        let state = state_word(self.context, written);
        let heights = match adjusted.heights {
            1 => self.context.choose("height corrected by", "Höhe korrigiert um"),
            _ => self.context.choose("heights corrected by", "Höhen korrigiert um"),
        };
        let to = self.context.choose("to", "bis");
        let signed = |height: f64| with_decimal_separator(format!("{height:+.3}"), self.context.lang());
        let [lowest, highest] = [adjusted.corrections.0, adjusted.corrections.1].map(signed);
        let count = adjusted.heights;
        self.context
            .printer
            .status(format_args!("{file}: {state}, {count} {heights} {lowest} {to} {highest} mm"));
    }

    /// Shows all diagnostics and returns the exit status. Errors keep their severity regardless of the configuration, because they prevent
    /// a program from being written.
    fn conclude(self) -> ExitStatus {
        let mut diagnostics = self.context.findings(self.warnings).diagnostics;
        diagnostics.extend(self.errors);
        let findings = Findings::new(diagnostics);
        self.context.show(&findings);
        if self.has_failed || findings.error_count() > 0 { ExitStatus::Errors } else { ExitStatus::Success }
    }
}
