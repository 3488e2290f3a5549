//! The statistics at a program's end, which tools read. (book: program/gcode)

use pathbuild_diagnostic::Lang;
use pathbuild_toolpath::{Statistics, Total};

use super::comment::Remarks;

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
    format!("{label:<12} {:5.0} mm   ca.{:3.0} min", total.length, total.minutes())
}

fn labels(lang: Lang) -> [&'static str; 5] {
    match lang {
        Lang::En => ["Milling length:", "Drill length:", "Sweeps:", "Sum:", "Command count:"],
        Lang::De => ["Fräslänge:", "Bohrungen:", "Leerfahrten:", "Summe:", "Befehlszahl:"],
    }
}
