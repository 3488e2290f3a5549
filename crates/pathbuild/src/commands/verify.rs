//! `pathbuild verify`: checks that G-code programs are safe to run and match their drawing. (book: program/reading)

use std::io::Read;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::ReadError;
use pathbuild_diagnostic::{Diagnostic, Lang};
use pathbuild_workspace::Failure;
use pathbuild_workspace::findings::Findings;
use pathbuild_workspace::session::Session;
use pathbuild_workspace::verify::{
    ABOVE_FIRST, CheckRecord, MoveComparison, Outcome, Request, VerifyOptions, blind_text, summary,
};
use pathbuild_workspace::waivers::Coverage;
use serde_json::{Value, json};

use crate::args::VerifyArgs;
use crate::context::Context;
use crate::exit::ExitStatus;
use crate::text::count;
use crate::waivers;

/// Runs the command: checks each program, and reports findings and the checks made.
pub fn run(context: &Context, args: &VerifyArgs) -> ExitStatus {
    let options = match options(args) {
        Ok(options) => options,
        Err(fault) => return context.refuse(vec![*fault]),
    };
    let standard_input = Utf8Path::new(STANDARD_INPUT);
    let text = args.files.iter().any(|file| file == standard_input).then(|| read_standard_input(context));
    let text = match text.transpose() {
        Ok(text) => text.map(|text| (standard_input, text)),
        Err(problem) => return context.fail(vec![*problem]),
    };
    let places: Vec<Utf8PathBuf> =
        args.files.iter().filter(|file| *file != standard_input).cloned().collect();
    let request = Request { places: &places, text, options };
    let mut session = request.session(context);
    let verified = match request.run(&mut session) {
        Err(failure @ Failure::Post(_)) => return context.failed(failure),
        verified => verified,
    };
    let programs = verified.as_ref().map_or(args.files.len(), |verified| verified.programs.len());
    context.output.add_figure("programs", programs);
    context
        .output
        .add_figure("configuration", context.settings.file.as_deref().map(|file| context.file(file)));
    let verified = match verified {
        Ok(verified) => verified,
        Err(Failure::Found(found)) => return conclude(context, args, &session, &args.files, found),
        Err(failure) => return context.failed(failure),
    };
    let (mut report, mut diagnostics) = (CheckReport::default(), verified.problems);
    let mut files = Vec::new();
    for (file, verified) in verified.programs {
        if let Some(comparison) = &verified.comparison {
            report_comparison(context, &file, comparison);
        }
        report.add(file.to_string(), verified.checks);
        diagnostics.extend(verified.diagnostics);
        files.push(file);
    }
    let status = conclude(context, args, &session, &files, diagnostics);
    report.finish(context);
    status
}

const STANDARD_INPUT: &str = "-";

/// Reads a program from standard input.
///
/// # Errors
/// Standard input cannot be read, or is too large.
fn read_standard_input(context: &Context) -> Result<Vec<u8>, Box<Diagnostic>> {
    let limit = context.settings.limits.file_size.value;
    let mut text = Vec::new();
    let read = std::io::stdin().take(limit.saturating_add(1)).read_to_end(&mut text);
    let fault = match read {
        Ok(_) if text.len() as u64 <= limit => return Ok(text),
        Ok(_) => ReadError::TooLarge { size: text.len() as u64 },
        Err(error) => ReadError::from(error),
    };
    Err(Box::new(fault.diagnostic(limit, "file-size").in_file(Utf8Path::new(STANDARD_INPUT))))
}

fn options(args: &VerifyArgs) -> Result<VerifyOptions, Box<Diagnostic>> {
    let options = VerifyOptions {
        reading: args.reading.options(),
        against: args.against.clone(),
        required: args.require.clone(),
        post: args.post.clone(),
        ..VerifyOptions::default()
    };
    options.with_stock(args.cutter.as_deref(), args.surface.as_deref())
}

fn conclude(
    context: &Context,
    args: &VerifyArgs,
    session: &Session<'_>,
    files: &[Utf8PathBuf],
    diagnostics: Vec<Diagnostic>,
) -> ExitStatus {
    let findings = context.findings(session.with_hints(diagnostics));
    let coverage = |_: &Findings| Coverage { files: files.to_vec(), ..Coverage::default() };
    let findings = match waivers::settle(context, &args.waivers, findings, coverage) {
        Ok(findings) => findings,
        Err(status) => return status,
    };
    context.show(&findings);
    context.name_date();
    let (errors, warnings) = (findings.errors(), findings.warnings());
    let phrase = |en: &'static str, de: &'static str| context.choose(en, de);
    let known = match findings.waived.len() {
        0 => String::new(),
        known => format!(", {}: {}", phrase("known", "bekannt"), count(known, context.lang())),
    };
    context.output.add_figure("known", findings.waived.len());
    context.printer.status(format_args!(
        "{}: {errors}, {}: {warnings}{known}",
        phrase("errors", "Fehler"),
        phrase("warnings", "Warnungen")
    ));
    ExitStatus::of(&findings)
}

/// The checks made for each program of a run.
#[derive(Default)]
struct CheckReport(Vec<(String, Vec<CheckRecord>)>);

impl CheckReport {
    fn add(&mut self, file: String, checks: Vec<CheckRecord>) {
        if !checks.is_empty() {
            self.0.push((file, checks));
        }
    }

    /// Prints a summary for all programs with the same checks, and adds the checks of each program to the machine-readable document.
    fn finish(self, context: &Context) {
        for (line, files) in self.summaries(context.lang()) {
            let programs = match &*files {
                [file] => (*file).to_owned(),
                files => context.phrase("{} programs", "{} Programme", &files.len().to_string()),
            };
            context.printer.status(format_args!("{programs}: {line}"));
        }
        if context.output.has_figures() {
            let record = |(file, checks): &(String, Vec<CheckRecord>)| {
                let checks: Vec<Value> = checks.iter().map(|record| row(record, context.lang())).collect();
                json!({ "program": file, "checks": checks })
            };
            context.output.add_figure("checks", self.0.iter().map(record).collect::<Vec<_>>());
        }
    }

    /// Returns a summary for each distinct list of checks, with the programs that it applies to.
    fn summaries(&self, lang: Lang) -> Vec<(String, Vec<&str>)> {
        let mut texts: Vec<(&[CheckRecord], usize)> = Vec::new();
        let mut lines: Vec<(String, Vec<&str>)> = Vec::new();
        for (file, checks) in &self.0 {
            let known = texts.iter().find(|(known, _)| known == checks).map(|(_, line)| *line);
            let line = known.unwrap_or_else(|| {
                let text = summary(checks, lang);
                let line = lines.iter().position(|(known, _)| *known == text).unwrap_or(lines.len());
                if line == lines.len() {
                    lines.push((text, Vec::new()));
                }
                texts.push((checks, line));
                line
            });
            lines[line].1.push(file);
        }
        lines
    }
}

fn row(record: &CheckRecord, lang: Lang) -> Value {
    let check = record.requirement.name();
    match &record.outcome {
        Outcome::Made(values) => {
            let with = values.as_ref().map(|values| values.in_lang(lang)).unwrap_or_default();
            json!({ "check": check, "outcome": "made", "with": with })
        }
        Outcome::Assumed(values, _) => {
            json!({ "check": check, "outcome": "assumed", "with": values.in_lang(lang) })
        }
        Outcome::Incomplete(values, blind) => json!({
            "check": check,
            "outcome": "not-made",
            "with": values.in_lang(lang),
            "moves": blind.count,
            "reason": blind_text(*blind, lang),
            "option": ABOVE_FIRST.in_lang(lang),
        }),
        Outcome::NotMade(reason) => json!({
            "check": check,
            "outcome": "not-made",
            "reason": reason.text().in_lang(lang),
            "option": record.option(*reason).in_lang(lang),
        }),
    }
}

/// Reports which moves were compared with the drawing, and how many of them are equal.
fn report_comparison(context: &Context, file: &Utf8Path, comparison: &MoveComparison) {
    let MoveComparison { path, drawing, dialect, read_as, moves, equal } = comparison;
    context.json_row(|| {
        let row = json!({
            "file": context.file(file),
            "path": path,
            "drawing": context.file(drawing),
            "dialect": dialect,
            "moves": moves,
            "equal": equal,
        });
        ("agreement", row)
    });
    let lang = context.lang();
    let rest = context.choose("; the rest is not compared", "; der Rest ist nicht verglichen");
    let rest = if equal < moves { rest } else { "" };
    let [equal, all] = [*equal, *moves].map(|number| count(number, lang));
    let line = match lang {
        Lang::En => format!("{equal} of {all} moves as in path {path} of {drawing}{rest}; read as {read_as}"),
        Lang::De => format!(
            "{equal} von {all} Bewegungen wie im Pfad {path} aus {drawing}{rest}; gelesen als {read_as}"
        ),
    };
    context.printer.status(format_args!("{file}: {line}"));
}
