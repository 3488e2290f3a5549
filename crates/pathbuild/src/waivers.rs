//! Handles accepted findings at the end of `check` and `verify`: applies the baseline, warns about waivers that match nothing, and writes
//! new ones.
//! (book: howto/ci)

use camino::Utf8Path;
use pathbuild_db::system::FileKind;
use pathbuild_diagnostic::messages::configuration as messages;
use pathbuild_diagnostic::{Code, Diagnostic};
use pathbuild_workspace::baseline::Baseline;
use pathbuild_workspace::files;
use pathbuild_workspace::findings::Findings;
use pathbuild_workspace::waivers::{Coverage, RunDate, Waiver};

use crate::args::WaiverArgs;
use crate::context::Context;
use crate::exit::ExitStatus;
use crate::text::counted;

/// Splits findings into those to report and those that are accepted, and adds warnings about waivers that match nothing any more. With
/// `--update-baseline` or `--accept`, writes the baseline instead.
///
/// # Errors
/// The status with which the run ends: the baseline was written, or it cannot be read or written, or the options are invalid.
pub(crate) fn settle(
    context: &Context,
    args: &WaiverArgs,
    findings: Findings,
    coverage: impl FnOnce(&Findings) -> Coverage,
) -> Result<Findings, ExitStatus> {
    let file = context.baseline_file(args.baseline.as_deref());
    if args.update_baseline {
        return Err(update(context, &file, &findings.diagnostics, &coverage(&findings)));
    }
    if let Some((code, waiver)) = acceptance(args) {
        return Err(accept(context, &file, code, &waiver, &findings.diagnostics));
    }
    context.settle(findings, args.baseline.as_deref(), coverage).map_err(|faults| context.refuse(faults))
}

fn acceptance(args: &WaiverArgs) -> Option<(Code, Waiver)> {
    Some((args.accept?, Waiver { reason: args.reason.as_deref().map(Box::from), until: args.until, line: 0 }))
}

/// Reads the baseline that is to be changed, or returns an empty one if the file does not exist yet.
fn read_or_new(context: &Context, file: &Utf8Path) -> Result<(Baseline, Vec<Diagnostic>), Vec<Diagnostic>> {
    match context.system.kind(file) {
        FileKind::File => Baseline::read(&*context.system, file, context.settings.limits.file_size.value),
        _ => Ok((Baseline::new(file), Vec::new())),
    }
}

/// Rewrites the baseline. Lines without a fingerprint are dropped. A reason or date that cannot be read is an error.
fn update(context: &Context, file: &Utf8Path, findings: &[Diagnostic], coverage: &Coverage) -> ExitStatus {
    let (baseline, mut faults) =
        read_or_new(context, file).unwrap_or_else(|_| (Baseline::new(file), Vec::new()));
    faults.retain(|fault| fault.message.key != messages::BASELINE_LINE.key);
    if !faults.is_empty() {
        return context.refuse(faults);
    }
    let known = [["known finding", "known findings"], ["bekannter Befund", "bekannte Befunde"]];
    let known = counted(findings.len(), known, context.lang());
    write(context, file, &baseline.rewritten_text(findings, context, coverage), &known)
}

/// Adds waivers for all findings with a code to the baseline.
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
    let (text, count) = baseline.text_accepting(findings, code, waiver, context);
    if count == 0 {
        return context.usage(&context.phrase(
            "there is no finding {} to accept",
            "es gibt keinen Befund {}, der hinzunehmen wäre",
            &code.to_string(),
        ));
    }
    let accepted = [["finding accepted", "findings accepted"], ["Befund hingenommen", "Befunde hingenommen"]];
    let accepted = counted(count, accepted, context.lang());
    write(context, file, &text, &accepted)
}

/// Returns the reason why a waiver would have no effect; `None` if it would have an effect.
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
    match files::replace_report(context, file, text) {
        Ok(()) => {
            context.printer.status(format_args!("{}: {outcome}", file.file_name().unwrap_or_default()));
            ExitStatus::Success
        }
        Err(fault) => context.fail(vec![*fault]),
    }
}
