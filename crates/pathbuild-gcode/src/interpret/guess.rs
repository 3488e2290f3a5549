//! Guesses the dialect of a file and gives the evidence. (book: program/reading, "Dialects")

use std::collections::BTreeMap;

use memchr::memmem;
use pathbuild_diagnostic::{Code, Diagnostic, Text};
use pathbuild_motion::Group;

use super::codes::{Command, name};
use super::switches::{is_executed_m, is_unsupported_m};
use super::{Options, interpret_each};
use crate::dialect::{Dialect, DwellUnit, Rules};
use crate::provenance::Provenance;
use crate::read::{BlockReader, Value, Word};

/// Number of bytes inspected at the beginning of a file.
const INSPECTED_BYTES: usize = 65_536;

/// A dialect, and the evidence for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct Guess {
    pub dialect: Dialect,
    pub evidence: Evidence,
}

/// Evidence for a dialect: the reason, and the line where it was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Evidence {
    /// A phrase such as "it has correction formulas".
    pub reason: &'static Text,
    /// The line that contains the evidence, counted from 1.
    pub line: Option<u32>,
    /// The kind of evidence, which determines how certain the guess is.
    pub kind: EvidenceKind,
}

/// Kinds of evidence for a dialect.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EvidenceKind {
    /// The program's header names the dialect.
    Header,
    /// A line has a feature that only this dialect has.
    Feature,
    /// The dialect knows all or most of the program's words, but other dialects may know them as well.
    Words,
}

/// Guesses the dialect that the program's header names, or else one with a feature that no other dialect has. If there is neither, guesses the
/// dialect that accepts most words of the program.
pub fn guess(text: &[u8]) -> Guess {
    let head = &text[..text.len().min(INSPECTED_BYTES)];
    let whole_lines = memchr::memrchr(b'\n', head).filter(|_| head.len() < text.len());
    let head = &head[..whole_lines.unwrap_or(head.len())];
    guess_by_header(head).or_else(|| guess_by_feature(head)).unwrap_or_else(|| guess_by_words(head))
}

/// Returns the dialect that the header of a program written by pathbuild names.
fn guess_by_header(head: &[u8]) -> Option<Guess> {
    let (provenance, _) = Provenance::of_head(head)?;
    let reason = &Text { en: "named in its header", de: "im Programmkopf genannt" };
    Some(Guess {
        dialect: provenance.dialect?,
        evidence: Evidence { reason, line: None, kind: EvidenceKind::Header },
    })
}

/// A feature of a dialect, with a function that detects it in a line.
type DialectFeature = (Dialect, fn(&[u8]) -> bool, &'static Text);

macro_rules! signs {
    ($($dialect:ident $has_sign:expr, $en:literal, $de:literal;)*) => {
        const FEATURES: &[DialectFeature] = &[$((Dialect::$dialect, $has_sign, &Text { en: $en, de: $de }),)*];
    };
}

signs! {
    Native |line| contains(line, b"(=") && line.first().is_some_and(u8::is_ascii_alphabetic),
        "it has correction formulas", "es hat Korrekturformeln";
    Xpertmill |line| without_round_comments(line).windows(2).any(|pair| pair == b"//"),
        "it has comments with //", "es hat Kommentare mit //";
    Xpertmill |line| {
        line.starts_with(b"M6 ") && is_number(&line[3..])
            || line.starts_with(b"M06 ") && is_number(&line[4..])
    },
        "it has a tool number without T after M6", "es hat hinter M6 eine Werkzeugnummer ohne T";
    Din is_title, "its first line is `%` and a name", "seine erste Zeile ist `%` und ein Name";
    Fanuc |line| matches!(line, [b'O', b'0'..=b'9', ..]) && !ends_in_keyword(line),
        "it has a program number", "es hat eine Programmnummer";
    Marlin |line| {
        [&b"M104"[..], b"M106", b"M107", b"M117", b"M400", b"M82", b"M84"]
            .iter()
            .any(|word| line.starts_with(word))
    },
        "it has words of Marlin", "es enthält Wörter von Marlin";
    LinuxCnc |line| contains(line, b"#<"), "it has parameters with names", "es hat Parameter mit Namen";
    LinuxCnc |line| matches!(line, [b'O' | b'o', b'0'..=b'9' | b'<', ..]) && ends_in_keyword(line),
        "it has O words", "es hat O-Wörter";
    Native |line| line == b"G17 G21 G40 G49 G54 G80 G90 G94",
        "it has the native program's head", "es hat den Kopf des eigenen Programms";
    Mach3 |line| {
        let names = [&b"mach2/3"[..], b"mach3", b"mach4"];
        line.first() == Some(&b'(') && names.iter().any(|name| contains(&line.to_ascii_lowercase(), name))
    },
        "a comment names it", "ein Kommentar nennt es";
    Grbl |line| matches!(line.first(), Some(b'(' | b';')) && contains(&line.to_ascii_lowercase(), b"grbl"),
        "a comment names it", "ein Kommentar nennt es";
}

fn guess_by_feature(head: &[u8]) -> Option<Guess> {
    let lines = || (1_u32..).zip(head.split(|byte| *byte == b'\n').map(<[u8]>::trim_ascii));
    FEATURES.iter().find_map(|&(dialect, has_sign, reason)| {
        let (line, _) = lines().find(|(_, line)| has_sign(line))?;
        if dialect == Dialect::Xpertmill && sets_modes(head) {
            return None;
        }
        let guess =
            Guess { dialect, evidence: Evidence { reason, line: Some(line), kind: EvidenceKind::Feature } };
        Some(if dialect == Dialect::Fanuc { with_all_words(head, guess) } else { guess })
    })
}

/// Replaces a guess of Fanuc with another control with program numbers, if that control accepts every line of the program and Fanuc does not.
fn with_all_words(head: &[u8], guess: Guess) -> Guess {
    if accepts_every_line(head, guess.dialect) {
        return guess;
    }
    let reason = &Text {
        en: "it has a program number, and this dialect has all of its words",
        de: "es hat eine Programmnummer, und dieser Dialekt kennt alle seine Wörter",
    };
    [Dialect::Haas, Dialect::Mach3]
        .into_iter()
        .find(|dialect| accepts_every_line(head, *dialect))
        .map_or(guess, |dialect| Guess { dialect, evidence: Evidence { reason, ..guess.evidence } })
}

/// Whether a program sets the unit or the distance mode with G20, G21, G90 or G91, which XpertMILL does not know. XpertMILL would interpret the
/// inches of such a program as millimetres.
fn sets_modes(head: &[u8]) -> bool {
    let mut reader = BlockReader::new(head, Dialect::Xpertmill.rules());
    while let Some(block) = reader.next_block() {
        let is_mode = |word: &Word| {
            let Value::Number(number) = word.value else { return false };
            word.letter == b'G' && [20.0, 21.0, 90.0, 91.0].contains(&number.value)
        };
        if block.words.iter().any(is_mode) {
            return true;
        }
    }
    false
}

/// Guesses the dialect with the fewest unknown words; among equals, the first. If that dialect does not accept every line of the program, guesses the
/// first one that does.
fn guess_by_words(head: &[u8]) -> Guess {
    let (mut dialect, mut fewest, mut is_complete) = (Dialect::Rs274, usize::MAX, false);
    for candidate in [Dialect::Rs274, Dialect::LinuxCnc, Dialect::Grbl] {
        let problems = problems(head, candidate);
        let count = problems.iter().filter(|problem| is_unknown(problem.code())).count();
        if count < fewest {
            (dialect, fewest, is_complete) = (candidate, count, are_in_accepted_lines(&problems));
        }
        if fewest == 0 {
            break;
        }
    }
    if !is_complete {
        let others = [Dialect::LinuxCnc, Dialect::Grbl, Dialect::Mach3, Dialect::Fanuc, Dialect::Haas];
        if let Some(complete) = others.into_iter().find(|dialect| accepts_every_line(head, *dialect)) {
            (dialect, fewest) = (complete, 0);
        }
    }
    let reason = if fewest == 0 {
        &Text {
            en: "this dialect knows all words of the program",
            de: "dieser Dialekt kennt alle Wörter des Programms",
        }
    } else {
        &Text {
            en: "this dialect knows most words of the program",
            de: "dieser Dialekt kennt die meisten Wörter des Programms",
        }
    };
    Guess { dialect, evidence: Evidence { reason, line: None, kind: EvidenceKind::Words } }
}

fn problems(head: &[u8], dialect: Dialect) -> Vec<Diagnostic> {
    interpret_each(head, dialect, &Options::default(), &mut |_| {})
}

fn is_unknown(code: Code) -> bool {
    matches!(code, Code::UnknownWord | Code::UnknownCharacter | Code::InvalidComment)
}

/// Whether a control of the dialect knows and uses all words in `head`, the beginning of a program, and refuses none of its lines for containing two
/// words that exclude each other.
fn accepts_every_line(head: &[u8], dialect: Dialect) -> bool {
    are_in_accepted_lines(&problems(head, dialect))
}

/// Whether none of these problems makes a control refuse a line or ignore a word.
fn are_in_accepted_lines(problems: &[Diagnostic]) -> bool {
    let is_taken = |code| !is_unknown(code) && !matches!(code, Code::UnusedWord | Code::ConflictingWords);
    problems.iter().all(|problem| is_taken(problem.code()))
}

fn contains(line: &[u8], sign: &[u8]) -> bool {
    memmem::find(line, sign).is_some()
}

fn without_round_comments(line: &[u8]) -> &[u8] {
    &line[..memchr::memchr(b'(', line).unwrap_or(line.len())]
}

/// Whether a line is `%NAME`, even after a block number.
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

/// Whether a line with an O word is part of a subroutine, a branch or a loop. A bare `O1234` is the program number of another control.
fn ends_in_keyword(line: &[u8]) -> bool {
    const KEYWORDS: [&[u8]; 10] =
        [b"sub", b"endsub", b"call", b"if", b"else", b"endif", b"while", b"do", b"repeat", b"return"];
    let lower = line.to_ascii_lowercase();
    KEYWORDS.iter().any(|keyword| contains(&lower, keyword))
}

/// The interpretation of a word if no dialect is named.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeaningWithoutDialect {
    /// The word means the same as this code of LinuxCNC.
    Followed(u16),
    /// The word is ignored: it switches off something that is already off, or does not affect the position of the tool tip.
    Neutral,
    /// The word is ignored because its effect is unknown.
    NotFollowed {
        /// Whether the word changes the tool's path or the order of lines on some controls.
        is_dangerous: bool,
    },
}

/// Returns the interpretation of a word if no dialect is named. `code` is ten times its number.
pub fn meaning_without_dialect(letter: char, code: u16) -> MeaningWithoutDialect {
    if letter == 'M' { m_meaning_without_dialect(code) } else { g_meaning_without_dialect(code) }
}

fn m_meaning_without_dialect(code: u16) -> MeaningWithoutDialect {
    match code {
        // M48 enables the operator's overrides, as they are by default. M49 disables them.
        480 => MeaningWithoutDialect::Neutral,
        490 => MeaningWithoutDialect::NotFollowed { is_dangerous: false },
        _ if is_unsupported_m(code) || code == 190 => {
            MeaningWithoutDialect::NotFollowed { is_dangerous: true }
        }
        _ if is_executed_m(code) => MeaningWithoutDialect::Followed(code),
        _ => MeaningWithoutDialect::NotFollowed { is_dangerous: false },
    }
}

fn g_meaning_without_dialect(code: u16) -> MeaningWithoutDialect {
    let code = match code {
        // G70 and G71 select the units in DIN 66025.
        700 => 200,
        710 => 210,
        // G31 ("skip") is like G38.3: if the probe makes no contact, the program continues.
        310 => 383,
        other => other,
    };
    match Command::of(code) {
        Command::NotFollowed(_) | Command::LengthByNumber | Command::NumberedSystem => {
            MeaningWithoutDialect::NotFollowed { is_dangerous: true }
        }
        Command::System(_) if !Dialect::LinuxCnc.rules().words.has_g(code) => {
            MeaningWithoutDialect::NotFollowed { is_dangerous: true }
        }
        Command::NoEffect(_) if code == 432 => MeaningWithoutDialect::NotFollowed { is_dangerous: true },
        Command::NoEffect(Group::CutterCompensation | Group::ToolLength | Group::PathControl)
            if Dialect::LinuxCnc.rules().words.has_g(code) =>
        {
            MeaningWithoutDialect::Followed(code)
        }
        Command::NoEffect(_) | Command::StoreHome(_) => MeaningWithoutDialect::Neutral,
        _ => MeaningWithoutDialect::Followed(code),
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum WordMeaning {
    Command(Command),
    Dwell(DwellUnit),
    /// A meaning that no other dialect has.
    Own,
}

/// Collector of a program's G words whose meanings differ among the dialects that know all of its words.
#[derive(Clone, Debug, Default)]
pub struct DisputedWords {
    /// G and M words by letter and ten times their number, each with its first line.
    words: BTreeMap<(char, u16), u32>,
}

impl DisputedWords {
    /// Adds a G or M word; `code` is ten times its number.
    pub fn add(&mut self, line: u32, letter: char, code: u16) {
        self.words.entry((letter, code)).or_insert(line);
    }

    /// Returns the first line that has a disputed word, and the names of all disputed words; `None` if there are none.
    pub fn finish(&self) -> Option<(u32, Vec<String>)> {
        let rules: Vec<&Rules> = Dialect::ALL.iter().map(|dialect| dialect.rules()).collect();
        let knows = |rules: &&&Rules| self.words.keys().all(|(letter, code)| is_known(rules, *letter, *code));
        let candidates: Vec<&Rules> = rules.iter().filter(knows).copied().collect();
        let is_disputed = |code: u16| {
            let mut meanings = candidates.iter().filter_map(|rules| word_meaning(rules, code));
            meanings.next().is_some_and(|first| meanings.any(|other| other != first))
        };
        let disputed: Vec<(u32, u16)> = self
            .words
            .iter()
            .filter(|((letter, code), _)| *letter == 'G' && is_disputed(*code))
            .map(|((_, code), line)| (*line, *code))
            .collect();
        let line = disputed.iter().map(|(line, _)| *line).min()?;
        Some((line, disputed.into_iter().map(|(_, code)| name('G', code)).collect()))
    }
}

fn is_known(rules: &Rules, letter: char, code: u16) -> bool {
    let words = rules.words;
    if letter == 'M' { words.has_m(code) || words.m_ignored.contains(&code) } else { words.has_g(code) }
}

fn word_meaning(rules: &Rules, code: u16) -> Option<WordMeaning> {
    let [inch, mm] = rules.unit_words;
    if !rules.words.has_g(code) {
        return None;
    }
    Some(match Command::of(code) {
        _ if code == inch || code == mm => WordMeaning::Command(Command::Inches(code == inch)),
        _ if rules.words.g_own.contains(&code) => WordMeaning::Own,
        Command::Dwell => WordMeaning::Dwell(match rules.dwell.p {
            // The configuration selects the unit, so the difference is not disputed.
            DwellUnit::BySetting => DwellUnit::Seconds,
            unit => unit,
        }),
        command => WordMeaning::Command(command),
    })
}
