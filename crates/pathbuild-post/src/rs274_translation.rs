//! Translates the lines of a post to RS274/NGC, so that a text can be read back if its definition declares no dialect.

use std::fmt::Write;

use pathbuild_diagnostic::messages::{gcode, posts};
use pathbuild_diagnostic::{Diagnostic, Severity};
use pathbuild_gcode::interpret::{DisputedWords, MeaningWithoutDialect, code_name, meaning_without_dialect};

use crate::job::Units;
use crate::line_words::{LineWords, Word};

/// Maximum number of warnings reported about the output of a post.
pub(crate) const MAX_WARNINGS: usize = 50;

/// The RS274 translation of a program, built line by line. It makes the same moves and switches the same functions as the lines passed to it, as far
/// as controls agree on the meaning of their words.
#[derive(Debug)]
pub(crate) struct Rs274Translation {
    text: String,
    /// The word for the units of the definition.
    units: &'static str,
    line: u32,
    doubtful: Vec<DoubtfulWord>,
    disputes: DisputedWords,
    dwells: Vec<(u32, f64)>,
    /// Whether the definition of the blank (workpiece) has begun in a Heidenhain program. Such a definition begins with G30 and ends with G31.
    is_blank_open: bool,
    modes: ModeWords,
    /// Lines that are no G-code; `None` if the definition says that it writes such lines.
    unreadable: Option<Vec<Diagnostic>>,
    /// Whether any line has had words.
    has_words: bool,
    /// Whether a `%` follows the first words. Some controls end the program there.
    has_ended: bool,
}

/// Facts about the lines so far: whether they state the unit, the distance mode and the plane, and whether they contain a G word of a
/// motion.
#[derive(Debug, Default)]
struct ModeWords {
    stated: [bool; 3],
    has_motion: bool,
    /// Whether the text is in inches, so that a control in millimetres would make other moves unless the text states the unit.
    is_inches: bool,
    unstated: Vec<Diagnostic>,
}

impl ModeWords {
    /// Reports modes that a line depends on if neither it nor an earlier line states them. Lines before the first motion word are ignored: a text
    /// without motion words is not in the words of RS274.
    fn line(&mut self, number: u32, line: &LineWords, motion: Option<u32>) {
        let mut codes: Vec<i64> = line.words.iter().filter(|word| word.letter == 'G').map(tenths).collect();
        codes.extend(motion.map(|code| 10 * i64::from(code)));
        let states = |known: &[i64]| codes.iter().any(|code| known.contains(code));
        let stated = [states(&[200, 210, 700, 710]), states(&[900, 910]), states(&[170, 180, 190])];
        self.stated = [0, 1, 2].map(|mode| self.stated[mode] || stated[mode]);
        self.has_motion |= states(&[0, 10, 20, 30]);
        let moves = line.words.iter().any(|word| matches!(word.letter, 'X' | 'Y' | 'Z'));
        if !moves || !self.has_motion {
            return;
        }
        if !std::mem::replace(&mut self.stated[0], true) {
            let mut unit =
                Diagnostic::new(&gcode::UNITS_NOT_STATED).quoting("inch", "G20").quoting("mm", "G21");
            if self.is_inches {
                unit.severity = Severity::Error;
            }
            self.unstated.push(unit.at_line(number, None));
        }
        let is_arc = states(&[20, 30]);
        if !std::mem::replace(&mut self.stated[1], true) {
            self.unstated.push(Diagnostic::new(&gcode::DISTANCE_NOT_STATED).at_line(number, None));
        }
        if is_arc && !std::mem::replace(&mut self.stated[2], true) {
            let plane = Diagnostic::new(&gcode::MODES_NOT_STATED).quoting("words", "G17");
            self.unstated.push(plane.quoting("taken", "G17").at_line(number, None));
        }
    }
}

/// A program translated line by line to the words of RS274/NGC.
#[derive(Clone, Debug, Default)]
pub struct TranslatedText {
    /// The translation, to be read in the dialect `LinuxCnc`.
    pub text: String,
    /// Words with an effect that the translation lacks, each with its first occurrence. Their number is limited.
    pub doubtful: Vec<DoubtfulWord>,
    /// Words whose meaning differs between controls, with the line number of the first one.
    pub disputed: Option<(u32, Vec<String>)>,
    /// The G4 words, which the translation omits: line number and duration. It is unknown whether a duration is in seconds or
    /// milliseconds.
    pub dwells: Vec<(u32, f64)>,
    /// Problems: lines that are no G-code, and a unit, distance mode or plane that the program does not state although it
    /// depends on them.
    pub problems: Vec<Diagnostic>,
}

/// A word with an effect that the translation lacks.
#[derive(Clone, Debug, PartialEq)]
pub struct DoubtfulWord {
    /// Number of the line, counted from 1.
    pub line: u32,
    /// The word, such as `G41`.
    pub word: String,
    /// The effect that the word may have.
    pub doubt: Doubt,
}

/// Possible effect of a word, if no dialect defines its meaning.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Doubt {
    /// The word is not translated, and on some controls it changes where the tool moves or which lines are executed.
    Dangerous,
    /// The word is not translated, and its effect is unknown.
    Unknown,
}

const MAX_DOUBTFUL_WORDS: usize = 20;

/// The statements of Siemens controls that move, turn, scale or mirror the coordinate system, repeat a cycle at each position that follows, or
/// jump.
const DANGEROUS_STATEMENTS: [&str; 18] = [
    "TRANS", "ATRANS", "ROT", "AROT", "ROTS", "AROTS", "SCALE", "ASCALE", "MIRROR", "AMIRROR", "CYCLE800",
    "PRESETON", "MCALL", "GOTO", "GOTOF", "GOTOB", "GOTOC", "GOTOS",
];

/// The names to which Siemens controls assign the tool, its edge and length, the spindle and switches of the machine. Any other assignment
/// moves an axis, rounds corners or sets a parameter.
const HARMLESS_ASSIGNMENTS: [&str; 6] = ["T", "D", "H", "S", "SPOS", "M"];

impl Rs274Translation {
    /// Creates an empty translation. The units are those of the definition until a line changes them; the centres of arcs are distances from
    /// the start, on which all controls agree. `has_other_lines` is set if the definition says that it writes lines that are no G-code.
    pub(crate) fn new(units: Units, has_other_lines: bool) -> Self {
        Self {
            text: String::new(),
            units: if units == Units::Inches { "G20" } else { "G21" },
            line: 1,
            doubtful: Vec::new(),
            disputes: DisputedWords::default(),
            dwells: Vec::new(),
            is_blank_open: false,
            modes: ModeWords { is_inches: units == Units::Inches, ..ModeWords::default() },
            unreadable: (!has_other_lines).then(Vec::new),
            has_words: false,
            has_ended: false,
        }
    }

    /// Translates a line with this text and these words. If the line contains a word that the definition uses instead of a G word for a motion,
    /// `motion` is the number of that G word. If `is_mirrored`, one axis of the plane is reversed, so the direction of arcs is reversed too.
    pub(crate) fn line(&mut self, text: &str, line: &LineWords, motion: Option<u32>, is_mirrored: bool) {
        if self.enter_blank_definition(line) {
            return self.end_line();
        }
        let codes = |word: &&Word| word.letter == 'G';
        let is_motion = |word: &Word| matches!(tenths(word), 0..=30 | 310 | 382..=385 | 730 | 810..=890);
        let motion = motion.filter(|_| !line.words.iter().filter(codes).any(is_motion));
        self.report_unreadable(text, line);
        self.report_dangerous(text, line, motion.is_some());
        self.modes.line(self.line, line, motion);
        if line.is_optional {
            self.text.push('/');
        }
        // The coordinates of G4 are not positions.
        if line.words.iter().filter(codes).any(|word| tenths(word) == 40) {
            let time = line.words.iter().find(|word| matches!(word.letter, 'P' | 'X' | 'U' | 'F' | 'S'));
            self.dwells.extend(time.map(|time| (self.line, time.number)));
            // Only Siemens controls read F or S beside G4 as the dwell time. On others, F is the feed of the cuts that follow.
            if let Some(time) = time.filter(|time| matches!(time.letter, 'F' | 'S')) {
                self.report(format!("G4 {}", time.letter), Doubt::Unknown);
            }
        } else {
            if let Some(motion) = motion {
                self.code(i64::from(motion) * 10, is_mirrored);
            }
            for word in &line.words {
                match word.letter {
                    'G' => self.code(tenths(word), is_mirrored),
                    'M' => self.translate_code('M', tenths(word)),
                    'X' | 'Y' | 'Z' | 'I' | 'J' | 'K' | 'R' | 'F' | 'P' | 'Q' | 'L' | 'H' => {
                        self.word(word.letter, word.number);
                    }
                    'S' | 'T' if word.number >= 0.0 => self.word(word.letter, word.number),
                    'A' | 'B' | 'C' | 'U' | 'V' | 'W' => {
                        self.report(word.letter.to_string(), Doubt::Dangerous);
                    }
                    'D' | 'E' => self.report(word.letter.to_string(), Doubt::Unknown),
                    'O' if has_coordinate(line) => self.report(word.letter.to_string(), Doubt::Unknown),
                    _ => {}
                }
            }
        }
        self.end_line();
    }

    /// Reports constructs that may change where the tool goes, or which lines are run, and that cannot be recognised by a G or M word alone. Some
    /// controls end a line at a CR and run the rest, even in a comment. If `has_own_motion`, text that is no G-code is the definition's own word for
    /// a motion.
    fn report_dangerous(&mut self, text: &str, line: &LineWords, has_own_motion: bool) {
        if let Some(foreign) = &line.foreign {
            let name = foreign.split(['(', '=']).next().unwrap_or_default();
            let is_dangerous = DANGEROUS_STATEMENTS.iter().any(|known| known.eq_ignore_ascii_case(name));
            if is_dangerous || has_coordinate(line) && !has_own_motion && line.formula.is_none() {
                self.report(name.to_owned(), Doubt::Dangerous);
            }
        }
        let is_harmless =
            |name: &str| HARMLESS_ASSIGNMENTS.iter().any(|known| known.eq_ignore_ascii_case(name));
        if let Some(name) = line.assigned.iter().find(|name| !is_harmless(name)) {
            self.report(format!("{name}="), Doubt::Dangerous);
        }
        if text.trim_end_matches('\r').contains('\r') {
            self.report("CR".to_owned(), Doubt::Dangerous);
        }
        // `line` ends at a `//` of a control text, although the comment may be closed by a `)` after that.
        if line.is_comment_open && text.rfind(')') < text.rfind('(') {
            self.report("(".to_owned(), Doubt::Unknown);
        }
        if let Some(sign) = line.formula {
            self.report(sign.to_string(), Doubt::Dangerous);
        }
        // An O word with anything after it calls or defines a subroutine, as in `o100 call`.
        if let Some(Word { letter: 'O', number }) = line.words.first().filter(|_| line.foreign.is_some()) {
            self.report(format!("O{number}"), Doubt::Dangerous);
        }
        if let Some(number) = line.unusual_number_prefix.as_ref().filter(|_| has_coordinate(line)) {
            self.report(number.clone(), Doubt::Unknown);
        }
        let has = |letter: char, numbers: &[i64]| {
            line.words.iter().any(|word| word.letter == letter && numbers.contains(&(tenths(word) / 10)))
        };
        // G10 L1, L10 and L11 write into the tool table, and without L it means something else on each control. R turns the coordinates.
        if has('G', &[10]) && (!has('L', &[2, 20]) || line.words.iter().any(|word| word.letter == 'R')) {
            self.report("G10 L".to_owned(), Doubt::Dangerous);
        }
        self.has_ended |= line.is_percent && self.has_words;
        if self.has_ended && !line.words.is_empty() || line.has_percent_behind_words {
            self.report("%".to_owned(), Doubt::Dangerous);
        }
        self.has_words |= !line.words.is_empty();
    }

    /// Reports a line that is no G-code, unless the same line was reported before.
    fn report_unreadable(&mut self, text: &str, line: &LineWords) {
        let Some(reported) = self.unreadable.as_mut().filter(|reported| reported.len() < MAX_WARNINGS) else {
            return;
        };
        if line.foreign.is_none() || line.is_percent || line.formula.is_some() {
            return;
        }
        let found = Diagnostic::new(&posts::LINE_UNREADABLE).quoting("line", text.trim());
        if !reported.iter().any(|known| known.arguments == found.arguments) {
            reported.push(found.at_line(self.line, None));
        }
    }

    fn end_line(&mut self) {
        if self.line == 1 {
            self.state_modes();
        }
        self.text.push('\n');
        self.line += 1;
    }

    /// Adds to the first line the modes that it does not state itself.
    fn state_modes(&mut self) {
        let begin = usize::from(self.text.starts_with('/'));
        let first: Vec<&str> = self.text[begin..].split(' ').collect();
        let modes: [(&str, &[&str]); 4] = [
            (self.units, &["G20", "G21"]),
            ("G91.1", &["G90.1", "G91.1"]),
            ("G90", &["G90", "G91"]),
            ("G17", &["G17", "G18", "G19"]),
        ];
        let missing = modes.iter().filter(|(_, words)| !words.iter().any(|word| first.contains(word)));
        let missing: String = missing.flat_map(|(mode, _)| [mode, " "]).collect();
        self.text.insert_str(begin, &missing);
    }

    /// Follows the definition of the blank (workpiece), and returns whether the line begins or ends it. On a Heidenhain control, a line with G30, the
    /// plane and all axes begins the definition, and the following G31 ends it. Other controls have no plane in the same line as G30.
    fn enter_blank_definition(&mut self, line: &LineWords) -> bool {
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

    /// Translates a G code that concerns positions or motions, given as ten times its number. If one axis is mirrored, G2 and G3 are
    /// exchanged.
    fn code(&mut self, tenths: i64, is_mirrored: bool) {
        let tenths = match tenths {
            20 if is_mirrored => 30,
            30 if is_mirrored => 20,
            other => other,
        };
        self.translate_code('G', tenths);
    }

    fn translate_code(&mut self, letter: char, tenths: i64) {
        let Ok(code) = u16::try_from(tenths) else {
            return self.report(name(letter, tenths), Doubt::Dangerous);
        };
        self.disputes.add(self.line, letter, code);
        match meaning_without_dialect(letter, code) {
            MeaningWithoutDialect::Followed(code) => self.word(letter, f64::from(code) / 10.0),
            MeaningWithoutDialect::Neutral => {}
            MeaningWithoutDialect::NotFollowed { is_dangerous: true } => {
                self.report(name(letter, tenths), Doubt::Dangerous);
            }
            MeaningWithoutDialect::NotFollowed { is_dangerous: false } => {
                self.report(name(letter, tenths), Doubt::Unknown);
            }
        }
    }

    fn report(&mut self, word: String, doubt: Doubt) {
        let is_known = self.doubtful.iter().any(|known| known.word == word);
        if !is_known && self.doubtful.len() < MAX_DOUBTFUL_WORDS {
            self.doubtful.push(DoubtfulWord { line: self.line, word, doubt });
        }
    }

    fn word(&mut self, letter: char, number: f64) {
        write!(self.text, "{letter}{number} ").expect("a String takes everything");
    }

    /// Returns the translation, with the doubtful and disputed words, the dwells and the problems.
    pub(crate) fn finish(self) -> TranslatedText {
        let Self { text, doubtful, disputes, dwells, modes, unreadable, .. } = self;
        let problems = unreadable.into_iter().flatten().chain(modes.unstated).collect();
        TranslatedText { text, doubtful, disputed: disputes.finish(), dwells, problems }
    }
}

/// Whether a line contains a coordinate.
fn has_coordinate(line: &LineWords) -> bool {
    line.words.iter().any(|word| matches!(word.letter, 'X' | 'Y' | 'Z'))
}

/// Returns the name of a code, such as `G38.2`, from ten times its number.
fn name(letter: char, tenths: i64) -> String {
    u16::try_from(tenths).map_or_else(|_| letter.to_string(), |code| code_name(letter, code))
}

/// Returns ten times the number of a code; -10 for numbers that no code has.
fn tenths(word: &Word) -> i64 {
    let tenths = (word.number * 10.0).round();
    #[expect(clippy::cast_possible_truncation, reason = "the range is checked")]
    if (0.0..=10_000.0).contains(&tenths) { tenths as i64 } else { -10 }
}
