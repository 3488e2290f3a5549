//! Reports the findings at the end of a run: waivers, display, summary, pictures. (book: reference/commands, book: reference/diagnostics)

use std::collections::{BTreeMap, BTreeSet};
use std::mem::ManuallyDrop;
use std::time::Duration;

use pathbuild_api::CheckReport;
use pathbuild_diagnostic::{Code, Diagnostic, Lang, Severity, escaping, with_decimal_separator};
use pathbuild_path::PathName;
use pathbuild_workspace::check::CheckedFile;
use pathbuild_workspace::findings::Findings;

use crate::args::CheckArgs;
use crate::context::{Context, for_rendering};
use crate::exit::ExitStatus;
use crate::render::{WrittenPictures, write_pictures};
use crate::text::{DRAWING, ERROR, PATH, WARNING, counted, format_count, table};
use crate::waivers;

/// Ends a check that took the given time: writes pictures, shows findings and the summary, and returns the exit status.
pub fn conclude(context: &Context, args: &CheckArgs, report: CheckReport, time: Duration) -> ExitStatus {
    let CheckReport { findings, accepted, files, baseline, timings, .. } = report;
    let status = if let Some(written) = baseline {
        waivers::report_written(context, &args.waivers, &written)
    } else {
        let checked = files.into_iter().map(|drawing| CheckedFile {
            file: drawing.file.into(),
            paths: drawing.paths.iter().map(|path| PathName::new(path)).collect(),
        });
        let findings = Findings { checked: checked.collect(), ..for_rendering(findings, accepted) };
        // Leak instead of dropping: freeing a million values takes longer than process exit.
        deliver(context, args, &ManuallyDrop::new(findings), time)
    };
    for line in timings {
        context.printer.status(line);
    }
    status
}

fn deliver(context: &Context, args: &CheckArgs, findings: &Findings, time: Duration) -> ExitStatus {
    let pictures = args.pictures.as_ref();
    let WrittenPictures { problems: failed, others } =
        pictures.map(|directory| write_pictures(context, directory, findings)).unwrap_or_default();
    show(context, args.max_errors, findings);
    if findings.diagnostics.len() > MAX_LISTED_FINDINGS && !context.format.is_for_machines() {
        context.printer.status_lines(table_by_code(context, findings));
    }
    context.output.add_figure("paths", findings.checked.iter().map(|file| file.paths.len()).sum::<usize>());
    context.output.add_figure("drawings", findings.checked.len());
    context.output.add_figure("known", findings.waived.len());
    context.report_date();
    context.printer.status(summary(findings, findings.waived.len(), time, context.lang()));
    if let (Some(directory), Some(first)) = (pictures, others.first()) {
        let pictures = counted(others.len(), [["picture", "pictures"], ["Bild", "Bilder"]], context.lang());
        let phrase = context.choose("of other runs in", "anderer Läufe in");
        let advice = context.choose(
            "delete those of findings that are gone, such as",
            "die von behobenen Befunden löschen, zum Beispiel",
        );
        let [directory, first] = [directory.as_str(), first.as_str()].map(escaping::line);
        context.printer.status(format_args!("{pictures} {phrase} {directory}: {advice} {first}"));
    }
    if !failed.is_empty() {
        return context.fail(failed);
    }
    let is_wrong = findings.error_count() > 0 || args.error_on_warning && findings.warning_count() > 0;
    if is_wrong { ExitStatus::Errors } else { ExitStatus::Success }
}

/// Number of findings above which a table counts them by code, because users do not read that many.
const MAX_LISTED_FINDINGS: usize = 100;

/// Shows findings. Output for users stops after `most` errors.
fn show(context: &Context, most: Option<usize>, findings: &Findings) {
    let Some(most) = most.filter(|_| !context.format.is_for_machines()) else {
        return context.show(findings);
    };
    let mut errors = 0;
    let is_shown = |found: &&Diagnostic| {
        errors += usize::from(found.is_error());
        errors <= most
    };
    let shown: Vec<Diagnostic> = findings.diagnostics.iter().take_while(is_shown).cloned().collect();
    let hidden = findings.diagnostics.len() - shown.len();
    context.show_only(findings, &Findings { diagnostics: shown, ..Findings::default() });
    if hidden > 0 {
        let findings = counted(hidden, [["finding", "findings"], ["Befund", "Befunde"]], context.lang());
        let phrase = context.choose("not shown (--max-errors)", "nicht gezeigt (--max-errors)");
        context.printer.status(format_args!("{findings} {phrase}"));
    }
}

/// Formats a table of how often each code was found, the most frequent first.
fn table_by_code(context: &Context, findings: &Findings) -> String {
    let mut counts: BTreeMap<(Code, Severity), usize> = BTreeMap::new();
    for found in &findings.diagnostics {
        *counts.entry((found.code(), found.severity)).or_default() += 1;
    }
    let mut counts: Vec<_> = counts.into_iter().collect();
    counts.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    let rows = counts.into_iter().map(|((code, severity), number)| {
        let severity = severity.word(context.lang()).to_owned();
        vec![format_count(number, context.lang()), severity, code.to_string(), code.name().to_owned()]
    });
    table(&[(context.choose("count", "Anzahl"), true), ("", false), ("", false), ("", false)], rows)
}

/// Formats the last line of a check: `2,014 paths in 812 drawings: 3 errors in 2 drawings, 14 warnings (0.4 s)`. `known` is the number of
/// findings accepted by waivers.
pub fn summary(findings: &Findings, known: usize, time: Duration, lang: Lang) -> String {
    let counted = |number, noun| counted(number, noun, lang);
    let errors = match findings.error_count() {
        0 => lang.choose("no errors", "keine Fehler").to_owned(),
        errors => {
            let errors = counted(errors, ERROR);
            match count_faulty_drawings(findings) {
                0 => errors,
                drawings => format!("{errors} in {}", counted(drawings, DRAWING)),
            }
        }
    };
    let warnings = match findings.warning_count() {
        0 => lang.choose("no warnings", "keine Warnungen").to_owned(),
        warnings => counted(warnings, WARNING),
    };
    let known = match known {
        0 => String::new(),
        known => format!(", {} {}", format_count(known, lang), lang.choose("known", "bekannt")),
    };
    let seconds = with_decimal_separator(format!("{:.1}", time.as_secs_f64()), lang);
    let paths = counted(findings.checked.iter().map(|file| file.paths.len()).sum(), PATH);
    let drawings = counted(findings.checked.len(), DRAWING);
    format!("{paths} in {drawings}: {errors}, {warnings}{known} ({seconds} s)")
}

fn count_faulty_drawings(findings: &Findings) -> usize {
    let errors = findings.diagnostics.iter().filter(|diagnostic| diagnostic.is_error());
    errors.filter_map(|diagnostic| diagnostic.file.as_deref()).collect::<BTreeSet<_>>().len()
}
