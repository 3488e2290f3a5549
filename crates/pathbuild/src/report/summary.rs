use std::collections::BTreeSet;
use std::time::Duration;

use pathbuild_diagnostic::{Lang, in_prose};

use super::Findings;
use crate::numbers;

/// The last line of a check: `2,014 paths in 812 drawings: 3 errors in 2 drawings, 14 warnings (0.4 s)`. `known` is the number of findings
/// suppressed by a baseline.
pub fn summary(findings: &Findings, known: usize, time: Duration, lang: Lang) -> String {
    let words = match lang {
        Lang::En => &EN,
        Lang::De => &DE,
    };
    let paths = findings.checked.iter().map(|file| file.paths.len()).sum();
    let drawings = findings.checked.len();
    let errors = match findings.errors() {
        0 => words.no_errors.to_owned(),
        errors => format!(
            "{} in {}",
            words.count(errors, words.errors),
            words.count(erroneous(findings), words.drawings)
        ),
    };
    let warnings = match findings.warnings() {
        0 => words.no_warnings.to_owned(),
        warnings => words.count(warnings, words.warnings),
    };
    let known =
        if known == 0 { String::new() } else { format!(", {} {}", numbers::count(known, lang), words.known) };
    let seconds = in_prose(format!("{:.1}", time.as_secs_f64()), lang);
    let [paths, drawings] = [words.count(paths, words.paths), words.count(drawings, words.drawings)];
    format!("{paths} in {drawings}: {errors}, {warnings}{known} ({seconds} s)")
}

/// Number of drawings with errors.
fn erroneous(findings: &Findings) -> usize {
    let errors = findings.diagnostics.iter().filter(|diagnostic| diagnostic.is_error());
    errors.filter_map(|diagnostic| diagnostic.file.as_deref()).collect::<BTreeSet<_>>().len()
}

struct Words {
    paths: [&'static str; 2],
    drawings: [&'static str; 2],
    errors: [&'static str; 2],
    warnings: [&'static str; 2],
    no_errors: &'static str,
    no_warnings: &'static str,
    known: &'static str,
    lang: Lang,
}

const EN: Words = Words {
    paths: ["path", "paths"],
    drawings: ["drawing", "drawings"],
    errors: ["error", "errors"],
    warnings: ["warning", "warnings"],
    no_errors: "no errors",
    no_warnings: "no warnings",
    known: "known",
    lang: Lang::En,
};

const DE: Words = Words {
    paths: ["Pfad", "Pfade"],
    drawings: ["Zeichnung", "Zeichnungen"],
    errors: ["Fehler", "Fehler"],
    warnings: ["Warnung", "Warnungen"],
    no_errors: "keine Fehler",
    no_warnings: "keine Warnungen",
    known: "bekannt",
    lang: Lang::De,
};

impl Words {
    fn count(&self, count: usize, noun: [&str; 2]) -> String {
        numbers::counted(count, self.lang, noun)
    }
}
