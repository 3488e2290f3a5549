//! A comparison as text for users.

use std::fmt::Write;

use crate::numbers::counted;
use camino::Utf8Path;
use pathbuild_diagnostic::{Diagnostic, Lang, Number, shown};
use pathbuild_view::{Group, Totals, moves, phrase};
use pathbuild_workspace::diff::{Comparison, Outcome, PathDiff, ProgramDiff};

/// The whole comparison: the outcome of each path, and a summary.
pub(super) fn text(comparison: &Comparison, lang: Lang) -> String {
    let mut text = String::new();
    for path in &comparison.paths {
        _ = writeln!(
            text,
            "{} · {}: {}",
            shown::line(&path.name),
            shown::line(&place(path)),
            outcome(path, comparison, lang)
        );
        if let Outcome::Changed(program) = &path.outcome {
            for line in details(program, lang) {
                _ = writeln!(text, "  {line}");
            }
        }
    }
    _ = writeln!(text, "{}", summary(comparison, lang));
    text
}

/// The drawing of a path, or both if it moved to another drawing.
pub(super) fn place(path: &PathDiff) -> String {
    let [old, new] = path.files.each_ref().map(|file| file.as_deref().map(Utf8Path::as_str));
    match (old, new) {
        (Some(old), Some(new)) if old != new => format!("{old} → {new}"),
        (_, Some(file)) | (Some(file), None) => file.to_owned(),
        (None, None) => String::new(),
    }
}

/// The outcome of a path, in a few words.
pub(super) fn outcome(path: &PathDiff, comparison: &Comparison, lang: Lang) -> &'static str {
    let (en, de) = match &path.outcome {
        // `check` builds no programs, so it does not report limits that only programs exceed.
        Outcome::Broken if comparison.tells_of(path) => ("has errors now", "hat jetzt Fehler"),
        Outcome::Added => ("new", "neu"),
        Outcome::Removed => ("gone", "weg"),
        Outcome::Broken => {
            ("has errors now (pathbuild check shows them)", "hat jetzt Fehler (pathbuild check zeigt sie)")
        }
        Outcome::Mended => ("had errors, has none now", "hatte Fehler, jetzt keine mehr"),
        Outcome::StillBroken => ("has errors, before and now", "hat Fehler, vorher und jetzt"),
        Outcome::OtherDrawing => {
            ("the same moves, from another drawing", "dieselben Bewegungen, aus anderer Zeichnung")
        }
        Outcome::Changed(_) => ("changed", "geändert"),
    };
    lang.choose(en, de)
}

/// Errors that kept paths and drawings from being compared, one per line.
pub(super) fn problems(comparison: &Comparison, lang: Lang) -> Vec<String> {
    let errors = comparison.problems.iter().flatten().filter(|problem| problem.is_error());
    let line = |problem: &Diagnostic| {
        let file = problem.file.as_deref().map(Utf8Path::as_str);
        let places: Vec<&str> = [file, problem.path.as_deref()].into_iter().flatten().collect();
        let text = problem.text(lang);
        match problem.help(lang) {
            Some(help) => format!("{}: {}: {text} ({help})", places.join(" · "), problem.code()),
            None => format!("{}: {}: {text}", places.join(" · "), problem.code()),
        }
    };
    errors.map(line).collect()
}

/// One line for each kind of change, and one for the totals.
pub(super) fn details(program: &ProgramDiff, lang: Lang) -> Vec<String> {
    let mut lines: Vec<String> = program.groups.iter().map(|group| line(group, lang)).collect();
    if let [Some(old), Some(new)] = program.totals {
        lines.push(totals(&old, &new, lang));
    }
    lines
}

fn line(group: &Group, lang: Lang) -> String {
    let first = lang.choose("the first to", "die erste nach");
    let at = group.at.map(|[x, y]| format!(", {first} ({}, {})", Number(x), Number(y))).unwrap_or_default();
    format!("{}: {}, {} mm{at}", phrase(group, lang), moves(group, lang), tenths(group.length).prose(lang))
}

fn totals(old: &Totals, new: &Totals, lang: Lang) -> String {
    let length = |totals: &Totals| tenths(totals.milling + totals.drilling).prose(lang);
    let minutes = match (old.minutes, new.minutes) {
        (Some(old), Some(new)) if (old - new).abs() > f64::EPSILON => {
            format!(", {} → {} min", Number(old).prose(lang), Number(new).prose(lang))
        }
        (_, Some(new)) => format!(", {} min", Number(new).prose(lang)),
        _ => String::new(),
    };
    format!("{}: {} → {} mm{minutes}", lang.choose("cutting", "Fräsweg"), length(old), length(new))
}

/// "2 of 35 paths changed, 1 new".
pub(super) fn summary(comparison: &Comparison, lang: Lang) -> String {
    let count = |is: fn(&Outcome) -> bool| comparison.paths.iter().filter(|path| is(&path.outcome)).count();
    let changed = count(|outcome| matches!(outcome, Outcome::Changed(_)));
    let mut parts = vec![match lang {
        Lang::En => {
            format!("{changed} of {} changed", counted(comparison.looked_at, lang, ["path", "paths"]))
        }
        Lang::De => {
            format!("{changed} von {} geändert", counted(comparison.looked_at, lang, ["Pfad", "Pfaden"]))
        }
    }];
    let mut add = |number: usize, en: &str, de: &str| {
        if number > 0 {
            parts.push(format!("{number} {}", lang.choose(en, de)));
        }
    };
    add(count(|outcome| matches!(outcome, Outcome::Added)), "new", "neu");
    add(count(|outcome| matches!(outcome, Outcome::Removed)), "gone", "weg");
    add(count(|outcome| matches!(outcome, Outcome::Broken)), "with errors now", "jetzt mit Fehlern");
    add(count(|outcome| matches!(outcome, Outcome::Mended)), "without errors now", "jetzt ohne Fehler");
    add(
        count(|outcome| matches!(outcome, Outcome::StillBroken)),
        "with errors before and now",
        "vorher und jetzt mit Fehlern",
    );
    add(
        count(|outcome| matches!(outcome, Outcome::OtherDrawing)),
        "from another drawing",
        "aus anderer Zeichnung",
    );
    parts.join(", ")
}

fn tenths(value: f64) -> Number {
    Number((value * 10.0).round() / 10.0)
}
