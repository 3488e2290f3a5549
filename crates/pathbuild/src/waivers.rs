//! Accepted findings at the end of `check` and `verify`: applies the baseline, warns about waivers that match nothing, and writes new ones.
//! (book: howto/ci)

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::FileKind;
use pathbuild_diagnostic::messages::configuration as messages;
use pathbuild_diagnostic::{Code, Diagnostic, Lang};
use pathbuild_workspace::files;
use pathbuild_workspace::findings::Findings;
use pathbuild_workspace::waivers::{Coverage, RunDate, Waiver};

use crate::args::WaiverArgs;
use crate::baseline::{Baseline, FILE_NAME, Run};
use crate::context::Context;
use crate::exit::ExitStatus;
use crate::numbers::counted;
use crate::render::View;

/// Splits findings into those to report and those that are accepted, and adds warnings about waivers that match nothing any more. With
/// `--update-baseline` or `--accept`, writes the baseline instead.
///
/// # Errors
/// The status with which the run ends, because the baseline was written, or cannot be read or written.
pub(crate) fn settle(
    context: &Context,
    args: &WaiverArgs,
    findings: Findings,
    coverage: impl FnOnce(&Findings) -> Coverage,
) -> Result<Findings, ExitStatus> {
    let file = baseline_file(context, args);
    if args.update_baseline {
        let run = Run::new(&*context.system, &context.working_directory, &coverage(&findings));
        return Err(update(context, &file, &findings.diagnostics, &run));
    }
    if let Some((code, waiver)) = acceptance(args) {
        return Err(accept(context, &file, code, &waiver, &findings.diagnostics));
    }
    let has_baseline = args.baseline.is_some() || context.system.kind(&file) == FileKind::File;
    if !has_baseline && !context.has_waivers() {
        return Ok(findings);
    }
    let coverage = coverage(&findings);
    let mut unused = context.unused_waivers(&findings, &coverage);
    let mut findings = findings;
    if has_baseline {
        let (baseline, faults) = read(context, &file).map_err(|faults| context.refuse(faults))?;
        if !faults.is_empty() {
            return Err(context.refuse(faults));
        }
        let run = Run::new(&*context.system, &context.working_directory, &coverage);
        unused.extend(baseline.unused(&findings.diagnostics, &run));
        findings = baseline.apply(findings, context.settings.date);
    }
    if !unused.is_empty() {
        findings.diagnostics.extend(context.findings(unused).diagnostics);
        findings.diagnostics = Findings::new(findings.diagnostics).diagnostics;
    }
    Ok(findings)
}

/// The status line that names the date of the run, if a waiver that ends was compared with it.
pub(crate) fn date_line(context: &Context, findings: &Findings) -> Option<String> {
    let has_end = findings.waived.iter().any(|waived| waived.waiver.until.is_some());
    let date = context.settings.date.filter(|_| has_end)?.text(context.lang());
    Some(context.phrase(
        "waivers with an end were compared with {}",
        "befristete Ausnahmen wurden mit {} verglichen",
        &date,
    ))
}

/// The named baseline, else the one beside the configuration, else the one in the working directory.
fn baseline_file(context: &Context, args: &WaiverArgs) -> Utf8PathBuf {
    match &args.baseline {
        Some(file) => context.working_directory.join(file),
        None => context.settings.directory().unwrap_or(&context.working_directory).join(FILE_NAME),
    }
}

fn acceptance(args: &WaiverArgs) -> Option<(Code, Waiver)> {
    Some((args.accept?, Waiver { reason: args.reason.as_deref().map(Box::from), until: args.until, line: 0 }))
}

fn read(context: &Context, file: &Utf8Path) -> Result<(Baseline, Vec<Diagnostic>), Vec<Diagnostic>> {
    Baseline::read(&*context.system, file, context.settings.limits.file_size.value)
}

/// The baseline that is to be changed, which need not exist yet.
fn read_or_new(context: &Context, file: &Utf8Path) -> Result<(Baseline, Vec<Diagnostic>), Vec<Diagnostic>> {
    match context.system.kind(file) {
        FileKind::File => read(context, file),
        _ => Ok((Baseline::new(file), Vec::new())),
    }
}

/// Rewrites the baseline. Lines without a fingerprint are dropped; a reason or date that cannot be read is an error.
fn update(context: &Context, file: &Utf8Path, findings: &[Diagnostic], run: &Run<'_>) -> ExitStatus {
    let (baseline, mut faults) =
        read_or_new(context, file).unwrap_or_else(|_| (Baseline::new(file), Vec::new()));
    faults.retain(|fault| fault.message.key != messages::BASELINE_LINE.key);
    if !faults.is_empty() {
        return context.refuse(faults);
    }
    let known = match context.lang() {
        Lang::En => counted(findings.len(), Lang::En, ["known finding", "known findings"]),
        Lang::De => counted(findings.len(), Lang::De, ["bekannte Meldung", "bekannte Meldungen"]),
    };
    write(context, file, &baseline.rewritten(findings, run, &view(context)), &known)
}

/// Adds waivers of all findings with a code to the baseline.
fn accept(
    context: &Context,
    file: &Utf8Path,
    code: Code,
    waiver: &Waiver,
    findings: &[Diagnostic],
) -> ExitStatus {
    if let Some(reason) = refusal(context, waiver, context.settings.date) {
        return context.usage(&reason);
    }
    let baseline = match read_or_new(context, file) {
        Ok((baseline, faults)) if faults.is_empty() => baseline,
        Ok((_, faults)) | Err(faults) => return context.refuse(faults),
    };
    let (text, count) = baseline.accepting(findings, code, waiver, &view(context));
    if count == 0 {
        return context.usage(&context.phrase(
            "there is no finding {} to accept",
            "es gibt keine Meldung {}, die hinzunehmen wäre",
            &code.to_string(),
        ));
    }
    let accepted = match context.lang() {
        Lang::En => counted(count, Lang::En, ["finding accepted", "findings accepted"]),
        Lang::De => counted(count, Lang::De, ["Meldung hingenommen", "Meldungen hingenommen"]),
    };
    write(context, file, &text, &accepted)
}

/// Why a waiver would have no effect.
fn refusal(context: &Context, waiver: &Waiver, run: Option<RunDate>) -> Option<String> {
    if waiver.reason.as_ref().is_some_and(|reason| reason.trim().is_empty()) {
        let reason = context.choose("--reason must not be empty", "--reason darf nicht leer sein");
        return Some(reason.to_owned());
    }
    let run = run.filter(|_| !waiver.holds(run))?.text(context.lang());
    Some(context.phrase(
        "--until lies before the date of this run, {}",
        "--until liegt vor dem Datum dieses Laufs, {}",
        &run,
    ))
}

fn write(context: &Context, file: &Utf8Path, text: &str, outcome: &str) -> ExitStatus {
    match files::replace(context, file, text) {
        Ok(()) => {
            context.printer.status(format_args!("{}: {outcome}", file.file_name().unwrap_or_default()));
            ExitStatus::Success
        }
        Err(fault) => context.fail(vec![*fault]),
    }
}

/// The view for baselines, always in English, so that the file does not depend on the user's language.
fn view(context: &Context) -> View {
    View { lang: Lang::En, color: false, width: None, base: context.working_directory.clone(), root: None }
}
