//! Translates the lines of a post to RS274/NGC, so that its text can be read back if it declares no dialect.

use std::fmt::Write;

use crate::job::Units;
use crate::words::{Word, Words};

/// A program that moves and switches like the lines passed to it, line by line.
#[derive(Debug)]
pub(crate) struct Shadow {
    text: String,
    line: u32,
    unfollowed: Vec<Unfollowed>,
    /// Whether the blank of a Heidenhain program has been started (G30) and not completed (G31).
    is_blank_open: bool,
}

/// A G or M word whose effect the shadow cannot express.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Unfollowed {
    /// Line number, counted from 1.
    pub(crate) line: u32,
    /// Such as `G41`.
    pub(crate) word: String,
    /// Whether it changes the tool path or the program flow on some controls.
    pub(crate) is_dangerous: bool,
}

/// Maximum number reported.
const MOST_UNFOLLOWED: usize = 20;

impl Shadow {
    /// Creates an empty shadow. Unit and arc centres are those of the definition, until a line changes them.
    pub(crate) fn new(units: Units, absolute_centres: bool) -> Self {
        let units = if units == Units::Inches { "G20" } else { "G21" };
        let centres = if absolute_centres { "G90.1" } else { "G91.1" };
        let text = format!("{units} {centres} G90 G17 ");
        Self { text, line: 1, unfollowed: Vec::new(), is_blank_open: false }
    }

    /// Adds a line with these words. `motion` is the G number of a macro in it. If one axis of the plane is reversed, the direction of arcs
    /// is
    /// reversed too.
    pub(crate) fn line(&mut self, line: &Words, motion: Option<u32>, is_mirrored: bool) {
        if self.is_blank(line) {
            return self.end_line();
        }
        let codes = |word: &&Word| word.letter == 'G';
        let is_motion = |word: &Word| matches!(tenths(word), 0..=30 | 310 | 382..=385 | 730 | 810..=890);
        // The coordinates of G4 are not positions.
        if !line.words.iter().filter(codes).any(|word| tenths(word) == 40) {
            let has_motion = line.words.iter().filter(codes).any(is_motion);
            if let Some(motion) = motion.filter(|_| !has_motion) {
                self.code(i64::from(motion) * 10, is_mirrored);
            }
            for word in &line.words {
                match word.letter {
                    'G' => self.code(tenths(word), is_mirrored),
                    'M' => self.switch(tenths(word)),
                    'X' | 'Y' | 'Z' | 'I' | 'J' | 'K' | 'R' | 'F' | 'P' | 'Q' | 'L' => {
                        self.word(word.letter, word.number);
                    }
                    'S' | 'T' if word.number >= 0.0 => self.word(word.letter, word.number),
                    'A' | 'B' | 'C' | 'U' | 'V' | 'W' => self.report(word.letter.to_string(), false),
                    _ => {}
                }
            }
        }
        self.end_line();
    }

    fn end_line(&mut self) {
        self.text.push('\n');
        self.line += 1;
    }

    /// Whether a line defines the blank: on a Heidenhain control that is G30 with the plane and all axes, followed by G31. Other controls
    /// have no
    /// plane in the same line as G30.
    fn is_blank(&mut self, line: &Words) -> bool {
        let has = |letter: char, number: i64| {
            line.words.iter().any(|word| word.letter == letter && tenths(word) == number)
        };
        let has_all_axes =
            ['X', 'Y', 'Z'].iter().all(|axis| line.words.iter().any(|word| word.letter == *axis));
        let begins = has('G', 300) && [170, 180, 190].iter().any(|plane| has('G', *plane)) && has_all_axes;
        let ends = self.is_blank_open && has('G', 310) && has_all_axes;
        self.is_blank_open = begins || self.is_blank_open && !ends;
        begins || ends
    }

    /// Handles an M word. The shadow follows spindle, coolant, tool, stops and ends.
    fn switch(&mut self, tenths: i64) {
        match tenths {
            0 | 10 | 20 | 30 | 40 | 50 | 60 | 70 | 80 | 90 | 300 => {
                #[expect(clippy::cast_precision_loss, reason = "codes are small")]
                self.word('M', tenths as f64 / 10.0);
            }
            // Overrides, and pallets, which do not affect the moves.
            480 | 490 | 600 => {}
            _ => self.leave('M', tenths, matches!(tenths, 190 | 470 | 610 | 970..=990)),
        }
    }

    fn leave(&mut self, letter: char, tenths: i64, is_dangerous: bool) {
        let word = match tenths % 10 {
            0 => format!("{letter}{}", tenths / 10),
            tenth => format!("{letter}{}.{tenth}", tenths / 10),
        };
        self.report(word, is_dangerous);
    }

    fn report(&mut self, word: String, is_dangerous: bool) {
        let is_known = self.unfollowed.iter().any(|known| known.word == word);
        if !is_known && self.unfollowed.len() < MOST_UNFOLLOWED {
            self.unfollowed.push(Unfollowed { line: self.line, word, is_dangerous });
        }
    }

    /// Handles a G word that affects the moves. Units are those of RS274; those of DIN are translated.
    fn code(&mut self, tenths: i64, is_mirrored: bool) {
        let tenths = match tenths {
            20 if is_mirrored => 30,
            30 if is_mirrored => 20,
            700 => 200,
            710 => 210,
            310 => 382,
            other => other,
        };
        match tenths {
            0
            | 10
            | 20
            | 30
            | 100
            | 170
            | 180
            | 190
            | 200
            | 210
            | 280
            | 300
            | 382..=385
            | 520
            | 530
            | 540..=593
            | 730
            | 800
            | 810
            | 820
            | 830
            | 850
            | 890
            | 900
            | 901
            | 910
            | 911
            | 920..=923
            | 940
            | 980
            | 990 => {
                #[expect(clippy::cast_precision_loss, reason = "codes are small")]
                self.word('G', tenths as f64 / 10.0);
            }
            // Modes that are off anyway, or that do not affect the position of the tool tip: exact stops, rounded corners, lengths from
            // the tool table.
            40 | 80 | 90 | 150 | 281 | 301 | 400 | 430 | 490 | 500 | 610 | 611 | 640 | 690 | 970 => {}
            _ => self.leave('G', tenths, true),
        }
    }

    fn word(&mut self, letter: char, number: f64) {
        write!(self.text, "{letter}{number} ").expect("a String takes everything");
    }

    /// Returns the program, and the words that it cannot express.
    pub(crate) fn finish(self) -> (String, Vec<Unfollowed>) {
        (self.text, self.unfollowed)
    }
}

/// Ten times the number of a code, or -10 if no code has such a number.
fn tenths(word: &Word) -> i64 {
    let tenths = (word.number * 10.0).round();
    #[expect(clippy::cast_possible_truncation, reason = "the range is checked")]
    if (0.0..=10_000.0).contains(&tenths) { tenths as i64 } else { -10 }
}
