//! Comments, and the characters allowed in them.

use pathbuild_diagnostic::Lang;
use pathbuild_toolpath::{Statistics, Total};

use crate::dialect::{Dialect, within_comment};

/// The characters that may be written. (book: reference/configuration, `charset`)
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Charset {
    /// Umlauts and the like are transliterated, anything else becomes `?`, because some controllers take bytes above 127 for commands.
    #[default]
    Ascii,
    /// All characters are written as they are.
    Utf8,
}

/// How comments are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Remarks {
    pub(super) charset: Charset,
    /// Whether "(" is kept within a comment, as `PathDxf2GCode` does.
    pub(super) compatible: bool,
}

impl Remarks {
    /// Formats a comment of the native dialect.
    pub(super) fn comment(self, text: &str) -> String {
        if !self.compatible {
            return Dialect::Native.comment(text, self.charset);
        }
        let parts: Vec<String> =
            text.split('(').map(|part| within_comment(part, Some(Dialect::Native), self.charset)).collect();
        format!("({})", parts.join("("))
    }
}

/// The ASCII replacement of a character.
pub fn transliterated(character: char) -> &'static str {
    match character {
        'ä' | 'æ' => "ae",
        'ö' | 'œ' => "oe",
        'ü' => "ue",
        'Ä' | 'Æ' => "Ae",
        'Ö' | 'Œ' => "Oe",
        'Ü' => "Ue",
        'ß' => "ss",
        'à' | 'á' | 'â' | 'ã' | 'å' => "a",
        'è' | 'é' | 'ê' | 'ë' => "e",
        'ì' | 'í' | 'î' | 'ï' => "i",
        'ò' | 'ó' | 'ô' | 'õ' | 'ø' => "o",
        'ù' | 'ú' | 'û' | 'µ' | 'μ' => "u",
        'À' | 'Á' | 'Â' | 'Ã' | 'Å' => "A",
        'È' | 'É' | 'Ê' | 'Ë' => "E",
        'Ì' | 'Í' | 'Î' | 'Ï' => "I",
        'Ò' | 'Ó' | 'Ô' | 'Õ' | 'Ø' => "O",
        'Ù' | 'Ú' | 'Û' => "U",
        'ç' => "c",
        'Ç' => "C",
        'ñ' => "n",
        'Ñ' => "N",
        '°' => "deg",
        '±' => "+-",
        '⌀' => "D",
        '×' => "x",
        '–' | '—' => "-",
        '\u{a0}' => " ",
        _ => "?",
    }
}

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
