//! The statistics at the end of a program, which are read by tools. (book: program/gcode)

use pathbuild_diagnostic::Lang;
use pathbuild_toolpath::{Statistics, Total};

use super::comment::{Charset, Remarks};
use crate::dialect::{Dialect, within_comment};

pub(super) fn lines(statistics: &Statistics, lang: Lang, remarks: Remarks) -> Vec<String> {
    let [milling, drilling, sweeps, sum, commands] = labels(lang);
    let totals = [
        (milling, statistics.milling),
        (drilling, statistics.drilling),
        (sweeps, statistics.sweeps),
        (sum, statistics.sum()),
    ];
    let mut lines: Vec<String> =
        totals.iter().map(|(label, total)| remarks.comment(&total_line(label, total))).collect();
    lines.push(remarks.comment(&format!("{commands} {}", statistics.commands)));
    lines
}

fn total_line(label: &str, total: &Total) -> String {
    let minutes = total.minutes();
    // If the rapid feed is unknown or some feed is 0, the time is unknown.
    let time = if minutes.is_finite() { format!("   ca.{minutes:3.0} min") } else { String::new() };
    format!("{label:<12} {:5.0} mm{time}", total.length)
}

fn labels(lang: Lang) -> [&'static str; 5] {
    match lang {
        Lang::En => ["Milling length:", "Drill length:", "Sweeps:", "Sum:", "Command count:"],
        Lang::De => ["Fräslänge:", "Bohrungen:", "Leerfahrten:", "Summe:", "Befehlszahl:"],
    }
}

/// Label and length in mm of a comment with a length.
pub(crate) fn stated_length(comment: &str) -> Option<(&str, f64)> {
    let (label, rest) = comment.split_once(':')?;
    let (length, _) = rest.split_once(" mm ")?;
    Some((label, length.trim().parse().ok()?))
}

/// The length denoted by a label, in either language: 0 milling, 1 drilling, 2 sweeps, 3 their sum.
pub(crate) fn kind_of_label(label: &str) -> Option<usize> {
    let is_meant = |known: &str| {
        let known = known.trim_end_matches(':');
        known == label || within_comment(known, Some(Dialect::Native), Charset::Ascii) == label
    };
    [Lang::En, Lang::De].iter().find_map(|lang| labels(*lang)[..4].iter().position(|known| is_meant(known)))
}
