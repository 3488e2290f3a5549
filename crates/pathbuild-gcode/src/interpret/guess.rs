//! Guesses the dialect of a file, and gives the reason. (book: program/reading, "Dialects")

use memchr::memmem;
use pathbuild_diagnostic::{Code, Text};

use super::{Options, interpret_each};
use crate::dialect::Dialect;
use crate::provenance::Provenance;

/// Number of bytes inspected at the beginning of a file.
const LOOKED_AT: usize = 65_536;

/// A dialect, and the evidence for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct Guess {
    pub dialect: Dialect,
    pub evidence: Evidence,
}

/// Evidence for a dialect.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Evidence {
    /// A phrase such as "it has correction formulas".
    pub reason: &'static Text,
    /// The line that contains it, counted from 1.
    pub line: Option<u32>,
    /// What kind of evidence it is.
    pub kind: EvidenceKind,
}

/// How certain a guess is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EvidenceKind {
    /// The program's header names the dialect.
    Header,
    /// A line has a sign that only this dialect has.
    Sign,
    /// Other dialects know the program's words as well.
    Words,
}

/// Guesses the dialect of a file from features that only one dialect has, otherwise from the dialect that accepts most of its words.
pub fn guess(text: &[u8]) -> Guess {
    let head = &text[..text.len().min(LOOKED_AT)];
    by_header(head).or_else(|| by_sign(head)).unwrap_or_else(|| by_words(head))
}

/// Files written by pathbuild name their dialect.
fn by_header(head: &[u8]) -> Option<Guess> {
    let (provenance, _) = Provenance::of_head(head)?;
    let reason = &Text { en: "its header names it", de: "sein Kopf nennt es" };
    Some(Guess {
        dialect: provenance.dialect?,
        evidence: Evidence { reason, line: None, kind: EvidenceKind::Header },
    })
}

/// A feature of a dialect, with a function that detects it in a line.
type Sign = (Dialect, fn(&[u8]) -> bool, &'static Text);

const SIGNS: &[Sign] = &[
    (
        Dialect::Native,
        |line| has(line, b"(=") && line.first().is_some_and(u8::is_ascii_alphabetic),
        &Text { en: "it has correction formulas", de: "es hat Korrekturformeln" },
    ),
    (
        Dialect::Native,
        |line| line == b"G17 G21 G40 G49 G54 G80 G90 G94",
        &Text { en: "it has the native program's head", de: "es hat den Kopf des eigenen Programms" },
    ),
    (
        Dialect::Xpertmill,
        |line| without_round_comments(line).windows(2).any(|pair| pair == b"//"),
        &Text { en: "it has comments with //", de: "es hat Kommentare mit //" },
    ),
    (
        Dialect::Xpertmill,
        |line| {
            line.starts_with(b"M6 ") && is_number(&line[3..])
                || line.starts_with(b"M06 ") && is_number(&line[4..])
        },
        &Text {
            en: "it has a tool number without T behind M6",
            de: "es hat hinter M6 eine Werkzeugnummer ohne T",
        },
    ),
    (
        Dialect::Din,
        is_title,
        &Text { en: "its first line is `%` and a name", de: "seine erste Zeile ist `%` und ein Name" },
    ),
    (
        Dialect::Fanuc,
        |line| matches!(line, [b'O', b'0'..=b'9', ..]) && !ends_in_keyword(line),
        &Text { en: "it has a program number", de: "es hat eine Programmnummer" },
    ),
    (
        Dialect::Marlin,
        |line| {
            [&b"M104"[..], b"M106", b"M107", b"M117", b"M400", b"M82", b"M84"]
                .iter()
                .any(|word| line.starts_with(word))
        },
        &Text { en: "it has words of Marlin", de: "es hat Wörter von Marlin" },
    ),
    (
        Dialect::LinuxCnc,
        |line| has(line, b"#<"),
        &Text { en: "it has parameters with names", de: "es hat Parameter mit Namen" },
    ),
    (
        Dialect::LinuxCnc,
        |line| matches!(line, [b'O' | b'o', b'0'..=b'9' | b'<', ..]) && ends_in_keyword(line),
        &Text { en: "it has O words", de: "es hat O-Wörter" },
    ),
    (
        Dialect::Grbl,
        |line| matches!(line.first(), Some(b'(' | b';')) && has(&line.to_ascii_lowercase(), b"grbl"),
        &Text { en: "a comment names it", de: "ein Kommentar nennt es" },
    ),
];

fn by_sign(head: &[u8]) -> Option<Guess> {
    let lines = || (1_u32..).zip(head.split(|byte| *byte == b'\n').map(<[u8]>::trim_ascii));
    SIGNS.iter().find_map(|&(dialect, has_sign, reason)| {
        let (line, _) = lines().find(|(_, line)| has_sign(line))?;
        Some(Guess { dialect, evidence: Evidence { reason, line: Some(line), kind: EvidenceKind::Sign } })
    })
}

/// The first dialect that accepts most of the words.
fn by_words(head: &[u8]) -> Guess {
    let candidates = [Dialect::Rs274, Dialect::LinuxCnc, Dialect::Grbl];
    let strangers = candidates.map(|dialect| unknown_words(head, dialect));
    let fewest = strangers.iter().min().copied().unwrap_or(0);
    let dialect =
        candidates.into_iter().zip(strangers).find(|(_, count)| *count == fewest).map(|(dialect, _)| dialect);
    let reason = if fewest == 0 {
        &Text { en: "it knows every word", de: "es kennt jedes Wort" }
    } else {
        &Text { en: "it knows most of the words", de: "es kennt die meisten Wörter" }
    };
    Guess {
        dialect: dialect.unwrap_or(Dialect::Rs274),
        evidence: Evidence { reason, line: None, kind: EvidenceKind::Words },
    }
}

fn unknown_words(head: &[u8], dialect: Dialect) -> usize {
    let problems = interpret_each(head, dialect, &Options::default(), &mut |_| {});
    let is_stranger =
        |code| matches!(code, Code::UnknownWord | Code::UnknownCharacter | Code::InvalidComment);
    problems.iter().filter(|problem| is_stranger(problem.code())).count()
}

fn has(line: &[u8], sign: &[u8]) -> bool {
    memmem::find(line, sign).is_some()
}

fn without_round_comments(line: &[u8]) -> &[u8] {
    &line[..memchr::memchr(b'(', line).unwrap_or(line.len())]
}

/// `%NAME`, even after a block number.
fn is_title(line: &[u8]) -> bool {
    let digits = |line: &[u8]| line.iter().take_while(|byte| byte.is_ascii_digit()).count();
    let line = match line {
        [b'N', rest @ ..] => rest[digits(rest)..].trim_ascii_start(),
        line => line,
    };
    matches!(line, [b'%', name, ..] if name.is_ascii_alphanumeric())
}

fn is_number(text: &[u8]) -> bool {
    let text = text.trim_ascii();
    !text.is_empty() && text.iter().all(u8::is_ascii_digit)
}

/// Subroutines and branches. A bare `O1234` is the program number of another control.
fn ends_in_keyword(line: &[u8]) -> bool {
    const KEYWORDS: [&[u8]; 10] =
        [b"sub", b"endsub", b"call", b"if", b"else", b"endif", b"while", b"do", b"repeat", b"return"];
    let lower = line.to_ascii_lowercase();
    KEYWORDS.iter().any(|keyword| has(&lower, keyword))
}
