//! The values of a parameter text: their bounds, and values that are permitted but suspicious to a machinist. (book: language/letters)

use std::borrow::Cow;
use std::ops::Range;

use pathbuild_diagnostic::messages::parameters as messages;
use pathbuild_diagnostic::{Diagnostic, Message, TextFault};

use crate::approx::{above, at_least, is_written_above};
use pathbuild_motion::ChipLoad;

use crate::language::DoubtThresholds;
use crate::letter::{Bound, ElementClass, Letter, LetterUse, Letters, ValueType};
use crate::look_alikes;
use crate::part::MAX_WEAK_BRIDGE;
use crate::text::{
    LetterValue, ParameterText, ValueKind, equals_sign_mistake, is_special_space, is_variable_without_value,
    is_without_value, mistake_in_text, unit_mistake, with_visible_spaces,
};
use crate::variables::Interpolation;

/// The value that a text gives a letter.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) enum GivenNumber {
    #[default]
    Absent,
    /// A value with a problem that is reported; problems that follow from it are not reported.
    Faulty,
    Number(f64),
}

/// The values that a parameter text gives to its letters.
#[derive(Clone, Debug, Default)]
pub(crate) struct Values<'t> {
    text: ParameterText<'t>,
    /// The values of the text's pieces with variables substituted; empty if all values are literal.
    filled: Vec<FilledValue<'t>>,
    /// Letters that the text lacks, but that an unreadable piece of it may have been meant to give.
    pub(crate) unread: Letters,
    /// Problems with the values: PB205, PB303, PB305 and PB005, without places.
    pub(crate) problems: Vec<Diagnostic>,
}

/// The value of a piece with variables substituted.
#[derive(Clone, Debug)]
enum FilledValue<'t> {
    Value(ValueKind, Cow<'t, str>),
    /// No value, because of a reported problem or because the piece is ignored.
    Nothing,
}

impl GivenNumber {
    pub(crate) fn number(self) -> Option<f64> {
        match self {
            Self::Number(number) => Some(number),
            Self::Absent | Self::Faulty => None,
        }
    }

    pub(crate) fn or_value(self, other: Self) -> Self {
        if self == Self::Absent { other } else { self }
    }
}

impl<'t> Values<'t> {
    /// Determines the values of the text of an element of this class. Pieces with problems found by [`ParameterText::problems`] have no value.
    pub(crate) fn of(
        text: ParameterText<'t>,
        class: ElementClass,
        interpolation: &Interpolation<'_>,
    ) -> Self {
        let mut values = Self { text, ..Self::default() };
        if text.is_plain {
            return values;
        }
        if let Some(misreading) = mistake_in_text(text, class) {
            values.filled.resize_with(text.pieces().len(), || FilledValue::Nothing);
            values.unread = misreading.unread;
            return values;
        }
        values.unread = text.unread_letters();
        // A definition is not a value: its "=" is not a reference.
        let is_definition = |letter| class == ElementClass::PathStart && letter == Letter::Variable;
        let is_value = |letter: &Letter| {
            !matches!(class.use_of(*letter), LetterUse::Unknown | LetterUse::PathOnly)
                && !is_definition(*letter)
                && (*letter == Letter::Variable || !text.repeats(*letter))
        };
        let has_unread = values.unread != Letters::default();
        let is_apart = |piece: &LetterValue| {
            has_unread && (is_without_value(text, piece) || is_variable_without_value(text, piece, class))
        };
        let mut filled = Vec::with_capacity(text.pieces().len());
        for piece in text.pieces() {
            filled.push(match piece.letter.filter(is_value) {
                Some(letter) if letter.is_literal() && text.value(piece).contains('=') => {
                    FilledValue::Nothing
                }
                // The number is separated from its letter, which is reported elsewhere.
                Some(_) if is_apart(piece) => FilledValue::Nothing,
                Some(letter) => values.fill(letter, piece, interpolation),
                None => FilledValue::Nothing,
            });
        }
        values.filled = filled;
        values
    }

    fn fill(
        &mut self,
        letter: Letter,
        piece: &LetterValue,
        interpolation: &Interpolation<'_>,
    ) -> FilledValue<'t> {
        match interpolation.fill(self.text.value(piece)) {
            Ok(value) => match ValueKind::of(letter, &value) {
                ValueKind::NoNumber => self.report(piece, not_a_number(letter, &value)),
                written => return FilledValue::Value(written, value),
            },
            Err(Some(problem)) => {
                let problem =
                    equals_sign_mistake(letter, self.text.value(piece), &problem).unwrap_or(*problem);
                self.report(piece, problem);
            }
            Err(None) => {}
        }
        FilledValue::Nothing
    }

    fn report(&mut self, piece: &LetterValue, problem: Diagnostic) {
        self.problems.push(problem.with_text(self.text.fault(piece)));
    }

    /// Returns the number of a letter. A repeated letter is faulty, and reported elsewhere.
    pub(crate) fn number(&self, letter: Letter) -> GivenNumber {
        let Some(index) = self.text.index(letter) else {
            return if self.unread.contains(letter) { GivenNumber::Faulty } else { GivenNumber::Absent };
        };
        let written = match self.filled.get(index) {
            None => self.text.pieces()[index].written,
            Some(FilledValue::Value(written, _)) => *written,
            Some(FilledValue::Nothing) => return GivenNumber::Faulty,
        };
        match written {
            ValueKind::Number(number) => GivenNumber::Number(number),
            ValueKind::NoNumber => GivenNumber::Faulty,
            ValueKind::Text | ValueKind::Reference => GivenNumber::Absent,
        }
    }

    /// Returns the text value of a letter; `None` if it is absent or has a reported problem.
    pub(crate) fn text(&self, letter: Letter) -> Option<&str> {
        self.value(self.text.index(letter)?)
    }

    /// Returns T. A value that is not positive counts as faulty: with the surface at Z0, no other height can be compared with it.
    pub(crate) fn thickness(&self) -> GivenNumber {
        match self.number(Letter::T) {
            GivenNumber::Number(thickness) if !above(thickness, 0.0) => GivenNumber::Faulty,
            thickness => thickness,
        }
    }

    /// Whether the text may give the letter, but with an unknown value.
    pub(crate) fn is_unknown(&self, letter: Letter) -> bool {
        match self.text.index(letter) {
            Some(index) => self.value(index).is_none(),
            None => self.unread.contains(letter),
        }
    }

    /// Returns the values of variables in the order written, each with its piece.
    pub(crate) fn variables(&self) -> impl Iterator<Item = (&str, &'t LetterValue)> {
        let pieces = self.text.pieces().iter().enumerate();
        let variables = pieces.filter(|(_, piece)| piece.letter == Some(Letter::Variable));
        variables.filter_map(|(index, piece)| Some((self.value(index)?, piece)))
    }

    fn value(&self, index: usize) -> Option<&str> {
        match self.filled.get(index) {
            None => Some(self.text.value(&self.text.pieces()[index])),
            Some(FilledValue::Value(_, value)) => Some(value),
            Some(FilledValue::Nothing) => None,
        }
    }

    pub(crate) fn has(&self, letter: Letter) -> bool {
        self.text.letters.contains(letter)
    }

    /// Whether the text contains the letter, or a faulty piece that may stand for it.
    pub(crate) fn may_give(&self, letter: Letter) -> bool {
        self.has(letter) || self.unread.contains(letter)
    }

    pub(crate) fn letters(&self) -> Letters {
        self.text.letters
    }

    /// Returns the text with the piece of the letter underlined.
    pub(crate) fn fault(&self, letter: Letter) -> Option<TextFault> {
        self.text.fault_of(letter)
    }

    pub(crate) fn underlined(&self, piece: &LetterValue) -> TextFault {
        self.text.fault(piece)
    }

    /// Adds the text with the letter's piece underlined to a diagnostic, if the text contains the letter.
    pub(crate) fn underline(&self, letter: Letter, diagnostic: Diagnostic) -> Diagnostic {
        diagnostic.with_text(self.fault(letter))
    }
}

fn not_a_number(letter: Letter, value: &str) -> Diagnostic {
    if let Some(problem) = unit_mistake(letter, value) {
        return problem;
    }
    if let Some(problem) = look_alike_mistake(letter, value) {
        return problem;
    }
    let message = match letter.value_type() {
        _ if value.contains(is_special_space) => &messages::SPECIAL_SPACE,
        ValueType::Integer => &messages::NOT_AN_INTEGER,
        _ => &messages::NOT_A_NUMBER,
    };
    let visible = with_visible_spaces(value);
    // A decimal point, which may be what is wrong, suits every length above 0.
    let example = match letter.value_type() {
        ValueType::Length if letter.is_positive() => "0.3",
        _ => letter.usual_value(),
    };
    let problem = Diagnostic::new(message).with("letter", letter.as_char()).quoting("value", visible);
    problem.quoting("example", example)
}

/// Recognises a number with characters that look like others, or with letters instead of digits.
fn look_alike_mistake(letter: Letter, value: &str) -> Option<Diagnostic> {
    let meant = |value: &str| format!("{}{value}", letter.as_char());
    let is_number = |value: &str| matches!(ValueKind::of(letter, value), ValueKind::Number(_));
    let (plain, digits) = (look_alikes::with_keyboard_characters(value), look_alikes::with_digits(value));
    let problem = if plain != value && is_number(&plain) {
        look_alikes::look_alike_problem(&messages::LOOK_ALIKE, value)?.quoting("meant", meant(&plain))
    } else if is_number(&digits) {
        Diagnostic::new(&messages::LETTERS_FOR_DIGITS).quoting("meant", meant(&digits))
    } else {
        return None;
    };
    Some(problem.with("letter", letter.as_char()).quoting("value", value))
}

/// Feed in mm/min below which a program, which gives three decimals, would give a feed of 0.
const MIN_FEED: f64 = 0.0005;

/// Returns findings about values of `own` that are outside their limits. If such a limit is another letter that `own` does not give, the path's value
/// counts.
pub(crate) fn check_limits(own: &Values<'_>, path: &Values<'_>, class: ElementClass) -> Vec<Diagnostic> {
    let mut limits = LimitCheck { own, path, class, problems: Vec::new() };
    let is_positive = |letter: &Letter| match letter.bound() {
        Bound::Any => false,
        Bound::Positive => !matches!(class.use_of(*letter), LetterUse::Unknown | LetterUse::PathOnly),
        Bound::PositiveForBars => class.has_bars(),
    };
    limits.check_positive(Letter::all().filter(is_positive));
    limits.check_above(Letter::S, Letter::T, &messages::NOT_ABOVE);
    // For a probe or a subpath, T is the thickness at its place, which is unrelated to the path's depths.
    for depth in [Letter::B, Letter::D].into_iter().filter(|depth| class.use_of(*depth) != LetterUse::Unknown)
    {
        limits.check_above(Letter::T, depth, &messages::NOT_BELOW);
    }
    if class.has_bars() {
        limits.check_above(Letter::D, Letter::B, &messages::NOT_ABOVE);
    }
    limits.problems
}

struct LimitCheck<'a> {
    own: &'a Values<'a>,
    path: &'a Values<'a>,
    class: ElementClass,
    problems: Vec<Diagnostic>,
}

impl LimitCheck<'_> {
    fn check_positive(&mut self, letters: impl Iterator<Item = Letter>) {
        for letter in letters {
            let GivenNumber::Number(value) = self.own.number(letter) else { continue };
            let is_feed = letter.value_type() == ValueType::Feed;
            let is_rounded_off = is_feed && value > 0.0 && value < MIN_FEED;
            if is_rounded_off || !above(value, 0.0) {
                let message = match letter {
                    _ if is_rounded_off => &messages::FEED_ROUNDED_OFF,
                    Letter::T => &messages::THICKNESS_NOT_POSITIVE,
                    _ => &messages::NOT_POSITIVE,
                };
                let problem = Diagnostic::new(message)
                    .with("letter", letter.as_char())
                    .with("value", value)
                    .quoting("example", format!("{}{}", letter.as_char(), letter.usual_value()));
                self.problems.push(self.own.underline(letter, problem));
            }
        }
    }

    /// Checks that `upper` is greater than `lower`, if the element's own text gives either; otherwise the problem is reported at the path.
    fn check_above(&mut self, upper: Letter, lower: Letter, message: &'static Message) {
        let is_own =
            |letter| self.own.has(letter) && !matches!(self.class.use_of(letter), LetterUse::PathOnly);
        if !is_own(upper) && !is_own(lower) {
            return;
        }
        let number = |values: &Values<'_>, letter| match letter {
            Letter::T => values.thickness(),
            _ => values.number(letter),
        };
        let value = |letter| -> GivenNumber {
            let own = if is_own(letter) { number(self.own, letter) } else { GivenNumber::Absent };
            own.or_value(number(self.path, letter))
        };
        let (GivenNumber::Number(high), GivenNumber::Number(low)) = (value(upper), value(lower)) else {
            return;
        };
        if is_written_above(high, low) {
            return;
        }
        // `NOT_ABOVE` blames the upper value, `NOT_BELOW` the lower one.
        let says_upper = *message == messages::NOT_ABOVE;
        let (subject, limit) = if says_upper { (upper, lower) } else { (lower, upper) };
        let (subject_value, limit_value) = if says_upper { (high, low) } else { (low, high) };
        let message = match (self.class.use_of(subject), says_upper) {
            (LetterUse::Ignored, true) => &messages::UNUSED_NOT_ABOVE,
            (LetterUse::Ignored, false) => &messages::UNUSED_NOT_BELOW,
            _ => message,
        };
        let problem = Diagnostic::new(message)
            .with("letter", subject.as_char())
            .with("value", subject_value)
            .with("limit_letter", limit.as_char())
            .with("limit", limit_value);
        let problem =
            if high > low { problem.note(&messages::EQUAL_IN_PROGRAM, Vec::new()) } else { problem };
        let underlined = if is_own(subject) { subject } else { limit };
        self.problems.push(self.own.underline(underlined, problem));
    }
}

/// Returns the finding about a mark with this bottom in mm, if the mark is suspiciously deep.
pub(crate) fn check_mark(
    bottom: f64,
    own: &Values<'_>,
    path: &Values<'_>,
    limits: &DoubtThresholds,
) -> Option<Diagnostic> {
    let thickness = path.thickness().number()?;
    let depth = thickness - bottom;
    let is_own = own.has(Letter::D);
    // The D of bars is usually half of T, and hardly meant for marks: for these, the limit itself is too deep.
    let is_of_bars = !is_own && (path.has(Letter::P) || path.has(Letter::U));
    let limit = limits.mark_depth * thickness;
    if !above(depth, if is_of_bars { limit - HALF_DECIMAL } else { limit }) {
        return None;
    }
    let message = if is_own { &messages::DEEP_MARK } else { &messages::DEEP_MARKS_OF_PATH };
    let usual = USUAL_MARK_DEPTH.min(limit);
    let problem = Diagnostic::new(message)
        .with("value", bottom)
        .with("depth", depth)
        .with("thickness", thickness)
        .with("usual", usual)
        .with("example", thickness - usual);
    Some(problem)
}

/// Half of the last of three decimals, in mm.
const HALF_DECIMAL: f64 = 0.0005;

/// A usual depth of a mark in mm, for help.
const USUAL_MARK_DEPTH: f64 = 0.2;

/// A usual thickness of support bars in mm, for help.
const USUAL_BAR_THICKNESS: f64 = 1.0;

/// Height of sweeps above the surface in mm that no clamp needs, and that exceeds the Z travel of a small machine. A speed of the spindle, for which S
/// may be mistaken, is above it.
const MAX_SWEEP_CLEARANCE: f64 = 100.0;

/// A usual height of sweeps above the surface in mm, as an example in help texts.
const USUAL_SWEEP_CLEARANCE: f64 = 5.0;

/// A usual infeed in mm, as an example in help texts.
const USUAL_INFEED: f64 = 0.5;

/// Thickness in mm below which a support bar is too weak to hold a part, in material of twice that thickness or more.
const MIN_BAR_THICKNESS: f64 = 0.1;

/// Returns the finding about support bars with this upper edge in mm, if they are too thin to hold a part.
pub(crate) fn check_bar(top: f64, path: &Values<'_>) -> Option<Diagnostic> {
    let thickness = path.thickness().number()?;
    if !above(MIN_BAR_THICKNESS.min(thickness / 2.0), top) {
        return None;
    }
    let problem = Diagnostic::new(&messages::THIN_BARS).with("value", top);
    Some(problem.with("example", USUAL_BAR_THICKNESS.min(thickness / 2.0)))
}

/// Returns the finding about support bars of this length in mm, if they are too short to hold a part.
pub(crate) fn check_bar_length(length: f64) -> Option<Diagnostic> {
    let is_weak = !above(length, MAX_WEAK_BRIDGE);
    is_weak.then(|| Diagnostic::new(&messages::SHORT_BARS).with("value", length))
}

/// Returns the findings about suspicious values among those that `own` gives and that have an effect on the element. `path`: the values of the path.
pub(crate) fn check_doubts(
    own: &Values<'_>,
    path: &Values<'_>,
    class: ElementClass,
    limits: &DoubtThresholds,
    chip_load: Option<ChipLoad>,
) -> Vec<Diagnostic> {
    let doubts = DoubtCheck { own, path, class, limits };
    let found = [
        doubts.below_plate(),
        doubts.high_sweep(),
        doubts.large_infeed(),
        doubts.feed_above_machine(),
        doubts.chip_load(chip_load),
        doubts.negative_height(),
        doubts.pecks_without_cycles(),
        doubts.feed_with_thousands(),
    ];
    let lengths = Letter::all().filter(|letter| letter.value_type() == ValueType::Length);
    let zeros = lengths.filter_map(|letter| doubts.zero_before_number(letter));
    found.into_iter().flatten().chain(zeros).collect()
}

struct DoubtCheck<'a> {
    own: &'a Values<'a>,
    path: &'a Values<'a>,
    class: ElementClass,
    limits: &'a DoubtThresholds,
}

impl DoubtCheck<'_> {
    /// Returns the value that the element's own text gives, if it has an effect on the element.
    fn value(&self, letter: Letter) -> Option<f64> {
        let has_effect = !matches!(
            self.class.use_of(letter),
            LetterUse::Unknown | LetterUse::Ignored | LetterUse::PathOnly
        );
        self.own.number(letter).number().filter(|_| has_effect)
    }

    fn thickness(&self) -> Option<f64> {
        self.path.thickness().number()
    }

    fn below_plate(&self) -> Option<Diagnostic> {
        let is_surface_zero = self.path.thickness() == GivenNumber::Faulty
            && self.path.number(Letter::T) != GivenNumber::Faulty;
        let bottom = self.value(Letter::B)?;
        let depth = -bottom;
        if is_surface_zero || !above(depth, self.limits.below_plate) {
            return None;
        }
        let problem = match self.thickness().filter(|thickness| at_least(*thickness, depth)) {
            Some(thickness) => Diagnostic::new(&messages::BELOW_PLATE_BY_DEPTH)
                .with("thickness", thickness)
                .with("example", thickness - depth),
            None => Diagnostic::new(&messages::BELOW_PLATE),
        };
        let problem = problem.with("value", bottom).with("depth", depth);
        Some(self.own.underline(Letter::B, problem.with("limit", self.limits.below_plate)))
    }

    fn high_sweep(&self) -> Option<Diagnostic> {
        let (height, thickness) = (self.value(Letter::S)?, self.thickness()?);
        if !above(height, thickness + MAX_SWEEP_CLEARANCE) {
            return None;
        }
        let problem = Diagnostic::new(&messages::HIGH_SWEEP)
            .with("value", height)
            .with("clearance", height - thickness)
            .with("example", thickness + USUAL_SWEEP_CLEARANCE);
        Some(self.own.underline(Letter::S, problem))
    }

    fn large_infeed(&self) -> Option<Diagnostic> {
        let (infeed, thickness) = (self.value(Letter::I)?, self.thickness()?);
        let limit = self.limits.infeed * thickness;
        let message = match above(infeed, thickness) {
            _ if !above(infeed, limit) => return None,
            true => &messages::INFEED_ABOVE_THICKNESS,
            false => &messages::INFEED_ABOVE_SHARE,
        };
        let problem = Diagnostic::new(message).with("value", infeed).with("thickness", thickness);
        let problem = problem.with("limit", limit).with("example", USUAL_INFEED.min(limit));
        Some(self.own.underline(Letter::I, problem))
    }

    fn feed_above_machine(&self) -> Option<Diagnostic> {
        let (feed, maximum) = (self.value(Letter::F)?, self.limits.maximum_feed?);
        let problem = || Diagnostic::new(&messages::FEED_ABOVE_MACHINE).with("value", feed);
        above(feed, maximum).then(|| self.own.underline(Letter::F, problem().with("limit", maximum)))
    }

    /// Returns the finding about a feed that does not suit the chip load of the tool. A drill cuts along its axis, so its feed is not checked.
    fn chip_load(&self, limits: Option<ChipLoad>) -> Option<Diagnostic> {
        let is_drilled = matches!(self.class, ElementClass::DrilledHole | ElementClass::DrilledMark);
        let problem = limits.filter(|_| !is_drilled)?.check(self.value(Letter::F)?, None)?;
        Some(self.own.underline(Letter::F, problem))
    }

    fn negative_height(&self) -> Option<Diagnostic> {
        let height = self.value(Letter::H).filter(|height| above(0.0, *height))?;
        let is_probe = self.class == ElementClass::Probe;
        let message = if is_probe { &messages::LOWERED_PROBE } else { &messages::LOWERED };
        let problem = Diagnostic::new(message).with("value", height).with("depth", -height);
        Some(self.own.underline(Letter::H, problem))
    }

    fn pecks_without_cycles(&self) -> Option<Diagnostic> {
        self.value(Letter::C).filter(|_| !self.limits.has_cycles)?;
        let problem = Diagnostic::new(&messages::PECKS_WITHOUT_CYCLES).with("letter", Letter::C.as_char());
        Some(self.own.underline(Letter::C, problem))
    }

    /// Returns the finding about a feed like F1.200 or F1,200, which was probably meant as 1200 mm/min.
    fn feed_with_thousands(&self) -> Option<Diagnostic> {
        let (feed, written) = (self.value(Letter::F)?, self.own.text(Letter::F)?);
        if !has_thousands(written, feed) {
            return None;
        }
        let meant = written.replace(['.', ','], "");
        let meant = meant.trim_start_matches(['+', '0']);
        let problem = Diagnostic::new(&messages::FEED_WITH_THOUSANDS)
            .quoting("written", written)
            .with("value", feed)
            .quoting("meant", format!("F{meant}"));
        Some(self.own.underline(Letter::F, problem))
    }

    /// Returns the finding about a length like I03, which was probably meant as 0.3 mm.
    fn zero_before_number(&self, letter: Letter) -> Option<Diagnostic> {
        let (length, written) = (self.value(letter)?, self.own.text(letter)?);
        let sign = if length < 0.0 { "-" } else { "" };
        let digits = written.trim_start_matches(['+', '-']).trim_end_matches(['.', ',']).strip_prefix('0')?;
        if length == 0.0 || digits.is_empty() || !digits.bytes().all(|digit| digit.is_ascii_digit()) {
            return None;
        }
        let problem = Diagnostic::new(&messages::ZERO_BEFORE_NUMBER)
            .with("letter", letter.as_char())
            .quoting("written", written)
            .with("value", length)
            .quoting("meant", format!("{}{sign}0.{digits}", letter.as_char()));
        Some(self.own.underline(letter, problem))
    }
}

/// Whether a speed in mm/min or 1/min was probably written with a thousands separator, such as 1.200 or 12,000.
pub fn has_thousands(written: &str, speed: f64) -> bool {
    let decimals = written.split_once(['.', ',']).map_or(0, |(_, decimals)| decimals.len());
    decimals == 3 && SPEEDS_WITH_THOUSANDS.contains(&speed)
}

/// Speeds that are so low that three decimals were probably meant as thousands, F0.150 as F150. Nobody writes 0.050 for 50.
const SPEEDS_WITH_THOUSANDS: Range<f64> = 0.1..100.0;
