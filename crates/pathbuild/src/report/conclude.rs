use std::mem::ManuallyDrop;
use std::time::Duration;

use camino::Utf8Path;
use pathbuild_diagnostic::{Diagnostic, Lang};

use super::baseline::Compared;
use super::{Baseline, Findings, summary};
use crate::args::{CheckArgs, ReportFile};
use crate::context::Context;
use crate::exit::ExitStatus;
use crate::render::{View, render};
use pathbuild_workspace::check::Checked;
use pathbuild_workspace::files;

/// Ends a check that took so long: severities and baseline applied, findings shown, reports written, the summary, the exit status.
pub fn conclude(context: &Context, args: &CheckArgs, checked: Checked, time: Duration) -> ExitStatus {
    let findings = Findings { checked: checked.files, ..context.findings(checked.diagnostics) };
    match &args.baseline {
        Some(file) if args.update_baseline => {
            update(context, &context.working_directory.join(file), &findings)
        }
        Some(file) => match Baseline::read(
            &*context.system,
            &context.working_directory.join(file),
            context.settings.limits.file_size.value,
        ) {
            Ok(baseline) => deliver(context, args, &baseline.compare(findings), time),
            Err(faults) => context.refuse(faults),
        },
        None => {
            // The run is over: what it looked at is not taken apart.
            let compared = ManuallyDrop::new(Compared { new: findings, known: 0, gone: 0 });
            deliver(context, args, &compared, time)
        }
    }
}

fn deliver(context: &Context, args: &CheckArgs, compared: &Compared, time: Duration) -> ExitStatus {
    let findings = &compared.new;
    context.show_as_result(findings);
    let failed = write_reports(context, &args.report, findings);
    if compared.gone > 0 {
        let (en, de) = (
            "entries of the baseline that are no longer found",
            "bekannte Meldungen, die nicht mehr auftreten",
        );
        let phrase = context.choose(en, de);
        context.printer.detail(format_args!("{phrase}: {}", compared.gone));
    }
    context.printer.status(summary(findings, compared.known, time, context.lang()));
    let is_wrong = findings.errors() > 0 || args.error_on_warning && findings.warnings() > 0;
    let status = if is_wrong { ExitStatus::Errors } else { ExitStatus::Success };
    if failed.is_empty() { status } else { context.fail(failed) }
}

fn write_reports(context: &Context, reports: &[ReportFile], findings: &Findings) -> Vec<Diagnostic> {
    let view = plain_view(context, context.lang());
    let write = |report: &ReportFile| {
        let file = context.working_directory.join(&report.file);
        files::replace(context, &file, render(report.format, findings, &view).as_str())
            .err()
            .map(|fault| *fault)
    };
    reports.iter().filter_map(write).collect()
}

fn update(context: &Context, file: &Utf8Path, findings: &Findings) -> ExitStatus {
    // In English, so that the file does not change with the language of who writes it.
    let text = Baseline::text(findings, &plain_view(context, Lang::En));
    match files::replace(context, file, &text) {
        Ok(()) => {
            let (name, count) = (file.file_name().unwrap_or_default(), findings.diagnostics.len());
            context.printer.status(format_args!(
                "{name}: {count} {}",
                context.choose("known findings", "bekannte Meldungen")
            ));
            ExitStatus::Success
        }
        Err(fault) => context.fail(vec![*fault]),
    }
}

/// The view of somebody who reads a file.
fn plain_view(context: &Context, lang: Lang) -> View {
    View { lang, color: false, width: None, base: context.working_directory.clone() }
}
