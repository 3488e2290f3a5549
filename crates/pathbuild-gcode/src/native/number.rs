//! Formats numbers with three decimals, or with up to six.

use std::f64::consts::PI;
use std::fmt::Write;

use pathbuild_motion::turn_angle;
use pathbuild_toolpath::{Correction, Height, LAST_DIGIT, ProbePoint, Program, ProgramStep, Surface, Xy};

/// Formats a number with three decimals. The exact binary value is rounded, with ties to even, and zero has no sign.
pub fn three_decimals(number: f64) -> String {
    let mut text = String::with_capacity(10);
    push_three_decimals(&mut text, number);
    text
}

/// Appends a number with three decimals. `{:.3}` needs a long division for numbers as close to a thousandth as those of drawings, which took a
/// quarter of the time for compiling a project.
pub(super) fn push_three_decimals(text: &mut String, number: f64) {
    let Some(thousandths) = thousandths(number) else {
        _ = write!(text, "{number:.3}");
        return;
    };
    if number < 0.0 && thousandths > 0 {
        text.push('-');
    }
    let (whole, fraction) = (thousandths / 1000, thousandths_offset(thousandths % 1000));
    if whole < 1000 {
        let digits = 1 + usize::from(whole > 9) + usize::from(whole > 99);
        let end = thousandths_offset(whole) + 4;
        text.push_str(&THOUSANDTHS[end - digits..end]);
    } else {
        _ = write!(text, "{whole}");
    }
    text.push_str(&THOUSANDTHS[fraction..fraction + 4]);
}

/// Rounds a number to the three decimals that are printed.
pub(super) fn round_to_three_decimals(number: f64) -> f64 {
    let rounded = |thousandths: u64| (thousandths as f64 / 1000.0).copysign(number) + 0.0;
    thousandths(number).map_or(number, rounded)
}

/// The texts `.000`, `.001` and so on to `.999` in a row, so that no digit, before or after the point, has to be computed.
static THOUSANDTHS: &str = match str::from_utf8(&all_thousandths()) {
    Ok(text) => text,
    Err(_) => "",
};

#[expect(clippy::cast_possible_truncation, reason = "digits")]
const fn all_thousandths() -> [u8; 4000] {
    let mut text = [b'.'; 4000];
    let mut number = 0;
    while number < 1000 {
        text[4 * number + 1] = b'0' + (number / 100) as u8;
        text[4 * number + 2] = b'0' + (number / 10 % 10) as u8;
        text[4 * number + 3] = b'0' + (number % 10) as u8;
        number += 1;
    }
    text
}

/// Returns the offset of a number below a thousand, with its point, in [`THOUSANDTHS`].
#[expect(clippy::cast_possible_truncation, reason = "below 4000")]
fn thousandths_offset(number: u64) -> usize {
    4 * number as usize
}

/// Returns the absolute value in thousandths, with ties to even; `None` if it is 2^53 or more, or not finite.
fn thousandths(number: f64) -> Option<u64> {
    const FRACTION_BITS: u64 = 52;
    let bits = number.abs().to_bits();
    let (exponent, fraction) = (bits >> FRACTION_BITS, bits & ((1 << FRACTION_BITS) - 1));
    // The number is mantissa / 2^shift.
    let mantissa = if exponent == 0 { fraction } else { fraction | 1 << FRACTION_BITS };
    let shift = (1023 + FRACTION_BITS).checked_sub(exponent.max(1)).filter(|shift| *shift > 0)?;
    // The product is less than 2^63.
    let product = mantissa * 1000;
    if shift > 63 {
        return Some(0);
    }
    let (whole, rest, half) = (product >> shift, product & ((1 << shift) - 1), 1_u64 << (shift - 1));
    let is_up = rest > half || rest == half && whole % 2 == 1;
    Some(whole + u64::from(is_up))
}

/// Appends a number with six decimals, without trailing zeros after the third.
pub(crate) fn push_exact(text: &mut String, number: f64) {
    let start = text.len();
    _ = write!(text, "{number:.6}");
    let zeros = text.bytes().rev().take(3).take_while(|byte| *byte == b'0').count();
    text.truncate(text.len() - zeros);
    if &text[start..] == "-0.000" {
        text.remove(start);
    }
}

/// An arc from the printed position of the tool, with values rounded as they are printed.
pub(super) struct PrintedArc {
    pub(super) from: Xy,
    /// Centre of the arc relative to `from`.
    pub(super) centre: Xy,
    pub(super) clockwise: bool,
}

impl PrintedArc {
    pub(super) fn new(from: Xy, centre: Xy, clockwise: bool) -> Self {
        Self { from: round_point(from), centre: round_point(centre), clockwise }
    }

    /// Returns the end to print for an arc of this length in mm: `to`, or, if rounding would make the controller mill almost a turn too much or too
    /// little, the nearest printable point with which it does not. `None` if there is no such point.
    pub(super) fn end(&self, to: Xy, length: f64) -> Option<Xy> {
        if self.sweeps(to, length) {
            return Some(to);
        }
        let beside = |middle: Xy| {
            let steps = || [-LAST_DIGIT, 0.0, LAST_DIGIT].into_iter();
            steps().flat_map(move |x| steps().map(move |y| round_point(Xy::new(middle.x + x, middle.y + y))))
        };
        let distance = |end: &Xy| (end - to).norm();
        let candidates =
            beside(round_point(to)).chain(beside(self.from)).filter(|end| self.sweeps(*end, length));
        candidates.min_by(|a, b| distance(a).total_cmp(&distance(b)))
    }

    /// Whether a controller sweeps the angle of an arc of this length in mm to an end, and not a full turn more or less.
    pub(super) fn sweeps(&self, end: Xy, length: f64) -> bool {
        (self.angle(round_point(end)) - length / self.centre.coords.norm()).abs() <= PI
    }

    /// Returns the angle in radians that a controller sweeps to an end; 2 pi if the end equals the start.
    fn angle(&self, end: Xy) -> f64 {
        let (spoke, other) = (-self.centre.coords, end - (self.from + self.centre.coords));
        turn_angle(spoke.into(), other.into(), self.clockwise)
    }
}

fn round_point(at: Xy) -> Xy {
    Xy::new(round_to_three_decimals(at.x), round_to_three_decimals(at.y))
}

/// Number of the parameter for the first probe.
pub const FIRST_PARAMETER: usize = 51;

/// Writer of correction formulas for the heights of a program with probes.
pub(super) struct Formulas<'a> {
    probes: &'a [ProbePoint],
    surface: Surface,
    /// Whether weights have three decimals, as in programs of PathDxf2GCode. Such rounding distorts planes.
    is_rounded: bool,
}

/// Weight below which a probe is omitted from a formula, except in compatible programs.
const ZERO_WEIGHT: f64 = 0.000_000_5;

impl<'a> Formulas<'a> {
    /// Creates the writer; `None` for a program without probes.
    pub(super) fn new(program: &'a Program, correction: Correction) -> Option<Self> {
        let places: Vec<_> = program.probes.iter().map(|probe| probe.at).collect();
        (!program.probes.is_empty()).then(|| Self {
            probes: &program.probes,
            surface: Surface::new(correction.model, &places),
            is_rounded: correction.is_compatible(),
        })
    }

    /// Appends the formula of a height, with its brackets: `(=z+w*[#51-t]...)`, with the weight w of the probe and the height t at which it is drawn.
    pub(super) fn push(&self, text: &mut String, height: Height) {
        text.push_str("(=");
        self.push_number(text, height.z);
        for (probe, weight) in self.surface.weights(height.at) {
            if !self.is_rounded && weight.abs() < ZERO_WEIGHT {
                continue;
            }
            text.push(if weight < 0.0 { '-' } else { '+' });
            self.push_number(text, weight.abs());
            text.push_str("*[#");
            text.push_str(&(FIRST_PARAMETER + probe).to_string());
            text.push('-');
            push_three_decimals(text, self.probes[probe].height);
            text.push(']');
        }
        text.push(')');
    }

    /// Returns the formula of a height, without its brackets.
    pub(super) fn text(&self, height: Height) -> String {
        let mut text = String::new();
        self.push(&mut text, height);
        text["(=".len()..text.len() - 1].to_owned()
    }

    /// Returns the indices of the probes that do not correct any height of the given steps.
    pub(super) fn unused(&self, steps: &[ProgramStep]) -> Vec<usize> {
        let mut is_used = vec![false; self.probes.len()];
        for height in steps.iter().filter_map(ProgramStep::height) {
            for (probe, weight) in self.surface.weights(height.at) {
                is_used[probe] |= self.is_rounded || weight.abs() >= ZERO_WEIGHT;
            }
        }
        (0..is_used.len()).filter(|probe| !is_used[*probe]).collect()
    }

    fn push_number(&self, text: &mut String, number: f64) {
        if self.is_rounded { push_three_decimals(text, number) } else { push_exact(text, number) }
    }
}

/// Returns the indices of the probes of a program that have no weight in the formula of any height.
pub fn unused_probes(program: &Program, correction: Correction) -> Vec<usize> {
    let formulas = Formulas::new(program, correction);
    formulas.map_or_else(Vec::new, |formulas| formulas.unused(&correction.steps(program)))
}
