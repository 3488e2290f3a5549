//! `pathbuild verify`: checks that G-code programs are safe to run and match their drawing. (book: program/reading)

use std::io::Read;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_api::{
    CheckState, DrawingComparison, Error, ProgramCheck, VerifiedProgram, VerifyOptions, VerifyReport,
};
use pathbuild_db::system::ReadError;
use pathbuild_diagnostic::{Diagnostic, Lang};
use pathbuild_gcode::interpret::UnitCodes;
use pathbuild_workspace::findings::Findings;
use pathbuild_workspace::{Failure, verify};
use serde_json::{Value, json};

use crate::args::VerifyArgs;
use crate::context::{Context, for_rendering};
use crate::exit::ExitStatus;
use crate::text::format_count;
use crate::waivers;

/// Runs the command: checks each program, and reports findings and the checks made.
///
/// # Errors
/// If an option is invalid, or if standard input cannot be read.
pub fn run(context: &Context, args: &VerifyArgs) -> Result<ExitStatus, Failure> {
    let options = options(args).map_err(|fault| Failure::Refused(vec![*fault]))?;
    let options = with_standard_input(context, args, options);
    let options = options.map_err(|problem| Failure::Found(vec![*problem]))?;
    let places: Vec<&str> =
        args.files.iter().map(|file| file.as_str()).filter(|file| *file != STANDARD_INPUT).collect();
    let verified = match context.library().and_then(|library| library.verify(&places, &options)) {
        Err(error @ Error::Post(_)) => return Ok(context.show_request_error(error)),
        verified => verified,
    };
    let programs = verified.as_ref().map_or(args.files.len(), |verified| verified.programs.len());
    context.output.add_figure("programs", programs);
    context
        .output
        .add_figure("configuration", context.settings.file.as_deref().map(|file| context.file(file)));
    Ok(match verified {
        Ok(verified) => show(context, args, verified),
        // The drawing to compare with has errors, so nothing was verified.
        Err(Error::Findings(found)) if args.against.is_some() => {
            conclude(context, &for_rendering(found, Vec::new())).max(ExitStatus::Errors)
        }
        Err(error) => context.show_request_error(error),
    })
}

/// Shows the comparisons, the findings and the checks.
fn show(context: &Context, args: &VerifyArgs, verified: VerifyReport) -> ExitStatus {
    let VerifyReport { findings, accepted, programs, baseline, .. } = verified;
    for program in &programs {
        if let Some(comparison) = &program.comparison {
            report_comparison(context, &program.file, comparison);
        }
    }
    let status = if let Some(written) = baseline {
        waivers::report_written(context, &args.waivers, &written)
    } else {
        let files = programs.iter().map(|program| Utf8PathBuf::from(&*program.file)).collect();
        conclude(context, &Findings { programs: files, ..for_rendering(findings, accepted) })
    };
    report_checks(context, &programs);
    status
}

const STANDARD_INPUT: &str = "-";

/// Adds the program on standard input to the options, if it is among the files.
///
/// # Errors
/// Standard input cannot be read, or is too large.
fn with_standard_input(
    context: &Context,
    args: &VerifyArgs,
    options: VerifyOptions,
) -> Result<VerifyOptions, Box<Diagnostic>> {
    if args.files.iter().all(|file| file != STANDARD_INPUT) {
        return Ok(options);
    }
    Ok(options.text(STANDARD_INPUT, read_standard_input(context)?))
}

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
    let (reading, stock) = (&args.reading, verify::VerifyOptions::default());
    let stock = stock.with_stock(args.cutter.as_deref(), args.surface.as_deref())?;
    let mut options = VerifyOptions::new().baseline(waivers::options(&args.waivers));
    options = args.against.iter().fold(options, VerifyOptions::against);
    options = args.post.iter().fold(options, VerifyOptions::post);
    options = args.require.iter().fold(options, |options, check| options.require(check.name()));
    options = reading.dialect.iter().fold(options, |options, dialect| options.dialect(dialect.name()));
    options = stock.cutter.iter().fold(options, |options, diameter| options.cutter(*diameter));
    options = stock.surface.iter().fold(options, |options, height| options.surface(*height));
    if reading.unit_codes == Some(UnitCodes::Table) {
        options = options.table_unit_codes();
    }
    if reading.absolute_arc_centres {
        options = options.absolute_arc_centres();
    }
    Ok(if reading.ignore_feed { options.ignore_feed() } else { options })
}

/// Shows findings and their number, and returns the exit status.
fn conclude(context: &Context, findings: &Findings) -> ExitStatus {
    let status = context.conclude_findings(findings);
    context.report_date();
    let (errors, warnings) = (findings.error_count(), findings.warning_count());
    let phrase = |en: &'static str, de: &'static str| context.choose(en, de);
    let known = match findings.waived.len() {
        0 => String::new(),
        known => format!(", {}: {}", phrase("known", "bekannt"), format_count(known, context.lang())),
    };
    context.output.add_figure("known", findings.waived.len());
    context.printer.status(format_args!(
        "{}: {errors}, {}: {warnings}{known}",
        phrase("errors", "Fehler"),
        phrase("warnings", "Warnungen")
    ));
    status
}

/// Prints one summary for each group of programs with the same checks, and adds the checks of each program to the machine-readable document.
fn report_checks(context: &Context, programs: &[VerifiedProgram]) {
    let mut summaries: Vec<(&str, Vec<&str>)> = Vec::new();
    let checked = || programs.iter().filter(|program| !program.checks.is_empty());
    for VerifiedProgram { file, summary, .. } in checked() {
        match summaries.iter_mut().find(|(known, _)| known == summary) {
            Some((_, files)) => files.push(file),
            None => summaries.push((summary, vec![file])),
        }
    }
    for (summary, files) in summaries {
        let programs = match &*files {
            [file] => (*file).to_owned(),
            files => context.phrase("{} programs", "{} Programme", &files.len().to_string()),
        };
        context.printer.status(format_args!("{programs}: {summary}"));
    }
    if context.output.writes_json() {
        let record = |program: &VerifiedProgram| {
            let checks: Vec<Value> = program.checks.iter().map(row).collect();
            json!({ "program": program.file, "checks": checks })
        };
        context.output.add_figure("checks", checked().map(record).collect::<Vec<_>>());
    }
}

fn row(check: &ProgramCheck) -> Value {
    let ProgramCheck { name, state, detail, values, advice, open_moves, .. } = check;
    match (state, open_moves) {
        (CheckState::Made, _) => json!({ "check": name, "outcome": "made", "with": detail }),
        (CheckState::Assumed, _) => json!({ "check": name, "outcome": "assumed", "with": detail }),
        (_, Some(moves)) => json!({
            "check": name,
            "outcome": "not-made",
            "with": values,
            "moves": moves,
            "reason": detail,
            "option": advice,
        }),
        (_, None) => {
            json!({ "check": name, "outcome": "not-made", "reason": detail, "option": advice })
        }
    }
}

/// Reports how many moves are the same as in the program of the drawing, up to the first difference.
fn report_comparison(context: &Context, file: &str, comparison: &DrawingComparison) {
    let DrawingComparison { path, drawing, dialect, read_as, moves, equal, .. } = comparison;
    context.json_row(|| {
        let row = json!({
            "file": context.file(file.as_ref()),
            "path": path,
            "drawing": context.file(drawing.as_ref()),
            "dialect": dialect,
            "moves": moves,
            "equal": equal,
        });
        ("agreement", row)
    });
    let lang = context.lang();
    let rest = context.choose("; the rest is not compared", "; der Rest ist nicht verglichen");
    let rest = if equal < moves { rest } else { "" };
    let [equal, all] = [*equal, *moves].map(|number| format_count(number, lang));
    let line = match lang {
        Lang::En => format!("{equal} of {all} moves as in path {path} of {drawing}{rest}; read as {read_as}"),
        Lang::De => format!(
            "{equal} von {all} Bewegungen wie im Pfad {path} aus {drawing}{rest}; gelesen als {read_as}"
        ),
    };
    context.printer.status(format_args!("{file}: {line}"));
}
