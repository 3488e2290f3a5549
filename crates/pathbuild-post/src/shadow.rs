//! What the lines of a post say, in the words of RS274/NGC: so its text is read back where no dialect is named.

use std::fmt::Write;

use crate::job::Units;
use crate::words::{Word, Words};

/// A program that moves and switches as the lines do that it was told of, line for line.
#[derive(Debug)]
pub(crate) struct Shadow {
    text: String,
    line: u32,
    unfollowed: Vec<Unfollowed>,
    /// The blank of a Heidenhain program has begun (G30), and ends with G31.
    is_blank_open: bool,
}

/// A G or M word whose effect the shadow does not have.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Unfollowed {
    /// From 1.
    pub(crate) line: u32,
    /// Such as `G41`.
    pub(crate) word: String,
    /// It changes where the tool goes on some controls, or what is run.
    pub(crate) is_dangerous: bool,
}

/// More of them are no news.
const MOST_UNFOLLOWED: usize = 20;

impl Shadow {
    /// No lines yet. The unit and the centres of arcs are the definition's, until a line says otherwise.
    pub(crate) fn new(units: Units, absolute_centres: bool) -> Self {
        let units = if units == Units::Inches { "G20" } else { "G21" };
        let centres = if absolute_centres { "G90.1" } else { "G91.1" };
        let text = format!("{units} {centres} G90 G17 ");
        Self { text, line: 1, unfollowed: Vec::new(), is_blank_open: false }
    }

    /// A line with these words. `motion` is the number behind G of the move that a macro stands for in it. In a plane of which one axis is
    /// turned round, arcs turn the other way.
    pub(crate) fn line(&mut self, line: &Words, motion: Option<u32>, is_mirrored: bool) {
        if self.is_blank(line) {
            return self.end_line();
        }
        let codes = |word: &&Word| word.letter == 'G';
        let is_motion = |word: &Word| matches!(tenths(word), 0..=30 | 310 | 382..=385 | 730 | 810..=890);
        // G4 has coordinates that are none.
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

    /// Whether a line says how large the blank is: on a Heidenhain control G30 with the plane and all axes, then G31. Elsewhere a plane
    /// does not stand beside G30.
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

    /// An M word: spindle, coolant, tool, stops and ends are followed.
    fn switch(&mut self, tenths: i64) {
        match tenths {
            0 | 10 | 20 | 30 | 40 | 50 | 60 | 70 | 80 | 90 | 300 => {
                #[expect(clippy::cast_precision_loss, reason = "codes are small")]
                self.word('M', tenths as f64 / 10.0);
            }
            // Overrides, and pallets that nobody moves.
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

    /// A code that says where or how the tool moves. Units are those of RS274, DIN's are translated.
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
            // What is off already, and what does not change where the tool's tip goes: exact stops, rounded corners, lengths of the table.
            40 | 80 | 90 | 150 | 281 | 301 | 400 | 430 | 490 | 500 | 610 | 611 | 640 | 690 | 970 => {}
            _ => self.leave('G', tenths, true),
        }
    }

    fn word(&mut self, letter: char, number: f64) {
        write!(self.text, "{letter}{number} ").expect("a String takes everything");
    }

    /// The program, and the words that it does not have.
    pub(crate) fn finish(self) -> (String, Vec<Unfollowed>) {
        (self.text, self.unfollowed)
    }
}

/// Ten times the number of a code; -10 for numbers that no code has.
fn tenths(word: &Word) -> i64 {
    let tenths = (word.number * 10.0).round();
    #[expect(clippy::cast_possible_truncation, reason = "the range is checked")]
    if (0.0..=10_000.0).contains(&tenths) { tenths as i64 } else { -10 }
}
