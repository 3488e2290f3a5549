//! G and M words where no dialect is named. (book: program/reading, "Without a dialect")
//!
//! The words are those of RS274 and of the controls that extend it. What each does is what the interpreter says of it, so that a word is
//! added in one place.

use std::collections::BTreeMap;

use pathbuild_motion::Group;

use super::codes::{Command, name};
use super::switches::{is_followed_m, is_jump};
use crate::dialect::{Acceptance, Dialect, DwellUnit, Rules};

/// How a word is followed where no dialect is named.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnionWord {
    /// The reader of LinuxCNC follows it, under this code.
    Followed(u16),
    /// It switches off what is off already, or leaves the way of the tool's tip alone.
    Neutral,
    /// What it does is unknown.
    NotFollowed {
        /// It changes where the tool goes on some controls, or which line is run next.
        is_dangerous: bool,
    },
}

/// What a word does where no dialect is named. `code` is ten times its number.
pub fn union_word(letter: char, code: u16) -> UnionWord {
    if letter == 'M' { union_m_word(code) } else { union_g_word(code) }
}

fn union_m_word(code: u16) -> UnionWord {
    match code {
        // Overrides.
        480 | 490 => UnionWord::Neutral,
        _ if is_jump(code) || code == 190 => UnionWord::NotFollowed { is_dangerous: true },
        _ if is_followed_m(code) => UnionWord::Followed(code),
        _ => UnionWord::NotFollowed { is_dangerous: false },
    }
}

fn union_g_word(code: u16) -> UnionWord {
    let code = match code {
        // The units of DIN 66025.
        700 => 200,
        710 => 210,
        // "Skip" probes as G38.2 does.
        310 => 382,
        other => other,
    };
    let is_tool_offset = matches!(code, 431 | 432);
    match Command::of(code) {
        Command::NotFollowed(_) => UnionWord::NotFollowed { is_dangerous: true },
        Command::NoEffect(_) if is_tool_offset => UnionWord::NotFollowed { is_dangerous: true },
        Command::NoEffect(Group::CutterCompensation | Group::ToolLength | Group::PathControl)
            if Dialect::LinuxCnc.rules().words.g(code) == Acceptance::Taken =>
        {
            UnionWord::Followed(code)
        }
        Command::NoEffect(_) | Command::StoreHome(_) => UnionWord::Neutral,
        _ => UnionWord::Followed(code),
    }
}

/// What a dialect takes a G word for.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Meaning {
    Command(Command),
    Dwell(DwellUnit),
    /// Something that no other dialect has.
    Own,
}

/// Looks for G words on which the dialects disagree that know all words of a program.
#[derive(Clone, Debug, Default)]
pub struct Disputes {
    /// G and M words by letter and ten times their number, each with its first line.
    words: BTreeMap<(char, u16), u32>,
}

impl Disputes {
    /// Adds a G or M word; `code` is ten times its number.
    pub fn add(&mut self, line: u32, letter: char, code: u16) {
        self.words.entry((letter, code)).or_insert(line);
    }

    /// The names of the disputed words, with the first line of the first one.
    pub fn finish(&self) -> Option<(u32, Vec<String>)> {
        let rules: Vec<&Rules> = Dialect::ALL.iter().map(|dialect| dialect.rules()).collect();
        let knows = |rules: &&&Rules| self.words.keys().all(|(letter, code)| is_known(rules, *letter, *code));
        let candidates: Vec<&Rules> = rules.iter().filter(knows).copied().collect();
        let is_disputed = |code: u16| {
            let mut meanings = candidates.iter().filter_map(|rules| meaning(rules, code));
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
    let acceptance = if letter == 'M' { rules.words.m(code) } else { rules.words.g(code) };
    acceptance != Acceptance::Unknown
}

fn meaning(rules: &Rules, code: u16) -> Option<Meaning> {
    let [inch, mm] = rules.unit_words;
    if rules.words.g(code) != Acceptance::Taken {
        return None;
    }
    Some(match Command::of(code) {
        _ if code == inch || code == mm => Meaning::Command(Command::Inches(code == inch)),
        _ if rules.words.g_own.contains(&code) => Meaning::Own,
        Command::Dwell => Meaning::Dwell(match rules.dwell.p {
            // The configuration says which.
            DwellUnit::BySetting => DwellUnit::Seconds,
            unit => unit,
        }),
        command => Meaning::Command(command),
    })
}
