//! What the lines of a post say, in the words of RS274/NGC: so its text is read back where no dialect is named.

use std::fmt::Write;

use crate::job::Units;
use crate::words::{Word, Words};

/// A program that moves as the lines do that it was told of, line for line.
#[derive(Debug)]
pub(crate) struct Shadow {
    text: String,
}

impl Shadow {
    /// No lines yet. The unit and the centres of arcs are the definition's, until a line says otherwise.
    pub(crate) fn new(units: Units, absolute_centres: bool) -> Self {
        let units = if units == Units::Inches { "G20" } else { "G21" };
        let centres = if absolute_centres { "G90.1" } else { "G91.1" };
        Self { text: format!("{units} {centres} G90 G17 ") }
    }

    /// A line with these words. `motion` is the number behind G of the move that a macro stands for in it. In a plane of which one axis is
    /// turned round, arcs turn the other way.
    pub(crate) fn line(&mut self, line: &Words, motion: Option<u32>, is_mirrored: bool) {
        let codes = |word: &&Word| word.letter == 'G';
        let is_motion = |word: &Word| matches!(tenths(word), 0..=30 | 310 | 382..=385 | 730 | 810..=890);
        // G4 and G10 have coordinates that are none.
        if !line.words.iter().filter(codes).any(|word| matches!(tenths(word), 40 | 100)) {
            let has_motion = line.words.iter().filter(codes).any(is_motion);
            if let Some(motion) = motion.filter(|_| !has_motion) {
                self.code(i64::from(motion) * 10, is_mirrored);
            }
            for word in &line.words {
                match word.letter {
                    'G' => self.code(tenths(word), is_mirrored),
                    'X' | 'Y' | 'Z' | 'I' | 'J' | 'K' | 'R' | 'F' | 'P' | 'Q' => {
                        self.word(word.letter, word.number);
                    }
                    _ => {}
                }
            }
        }
        self.text.push('\n');
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
        let is_known = matches!(
            tenths,
            0..=30 | 170..=190 | 200 | 210 | 280 | 300 | 382..=385 | 520 | 530 | 730 | 800..=911 | 920..=923 | 980 | 990
        );
        if is_known {
            #[expect(clippy::cast_precision_loss, reason = "codes are small")]
            self.word('G', tenths as f64 / 10.0);
        }
    }

    fn word(&mut self, letter: char, number: f64) {
        write!(self.text, "{letter}{number} ").expect("a String takes everything");
    }

    /// The program.
    pub(crate) fn finish(self) -> String {
        self.text
    }
}

/// Ten times the number of a code; -1 for numbers that no code has.
fn tenths(word: &Word) -> i64 {
    let tenths = (word.number * 10.0).round();
    #[expect(clippy::cast_possible_truncation, reason = "the range is checked")]
    if (0.0..=10_000.0).contains(&tenths) { tenths as i64 } else { -1 }
}
