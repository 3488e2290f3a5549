//! Evaluates parameters, expressions and correction formulas. (book: program/reading, book: language/probes)

use std::collections::BTreeMap;

use pathbuild_diagnostic::Text;

use super::state::{INCH, State};
use crate::native::ProgramProbe;
use crate::read::{Binary, Block, Code, Function, Op, Span};

/// LinuxCNC considers numbers equal if they differ by less than this.
const EQUALITY_TOLERANCE: f64 = 1e-6;

#[derive(Clone, Copy, Debug)]
pub(super) struct Fault(pub(super) &'static Text);

/// The parameters of a program. A parameter that the program has not set has no value, unless it holds a state of the machine: its value may be left
/// over from a previous program.
#[derive(Debug, Default)]
pub(super) struct Parameters {
    numbered: BTreeMap<u32, f64>,
    named: BTreeMap<Box<str>, f64>,
    stack: Vec<f64>,
    /// Names, such as `#5221` or `#<_x>`, of parameters that were read although only the machine knows their values.
    pub(super) machine_values: Vec<Box<str>>,
}

/// The data to which expressions may refer.
pub(super) struct Scope<'s> {
    /// Largest number of a parameter; the smallest is 1.
    pub(super) most: u32,
    /// Whether the control has named parameters for values of the machine, such as `#<_x>`.
    pub(super) has_names: bool,
    pub(super) state: &'s State,
}

/// Parameters that each subroutine has for itself: `#1` to `#30`, and names that do not begin with `_`.
pub(super) struct LocalParameters {
    numbered: BTreeMap<u32, f64>,
    named: BTreeMap<Box<str>, f64>,
}

const LAST_LOCAL_PARAMETER: u32 = 30;

/// The last parameter that programs may use freely. Parameters above it hold positions, offsets and the state of the machine.
const LAST_PROGRAM_PARAMETER: u32 = 5000;

impl Parameters {
    pub(super) fn set(&mut self, number: u32, value: f64) {
        self.numbered.insert(number, value);
    }

    pub(super) fn set_named(&mut self, name: Box<str>, value: f64) {
        self.named.insert(name, value);
    }

    /// Saves the caller's local parameters, sets those of a subroutine, and returns the saved parameters.
    pub(super) fn enter(&mut self, values: &[f64]) -> LocalParameters {
        let own = (1..=LAST_LOCAL_PARAMETER).zip(values.iter().copied().chain(std::iter::repeat(0.0)));
        let numbered = own.filter_map(|(number, value)| Some((number, self.numbered.insert(number, value)?)));
        let numbered = numbered.collect();
        let (global, named) =
            std::mem::take(&mut self.named).into_iter().partition(|(name, _)| name.starts_with('_'));
        self.named = global;
        LocalParameters { numbered, named }
    }

    /// Restores the caller's local parameters, which [`enter`](Self::enter) has returned.
    pub(super) fn leave(&mut self, saved: LocalParameters) {
        self.numbered.retain(|number, _| *number > LAST_LOCAL_PARAMETER);
        self.named.retain(|name, _| name.starts_with('_'));
        self.numbered.extend(saved.numbered);
        self.named.extend(saved.named);
    }

    pub(super) fn evaluate(
        &mut self,
        block: &Block<'_>,
        code: Code,
        scope: &Scope<'_>,
    ) -> Result<f64, Fault> {
        let mut stack = std::mem::take(&mut self.stack);
        stack.clear();
        let result = self.run(block, block.code(code), scope, &mut stack);
        self.stack = stack;
        result
    }

    fn run(
        &mut self,
        block: &Block<'_>,
        code: &[Op],
        scope: &Scope<'_>,
        stack: &mut Vec<f64>,
    ) -> Result<f64, Fault> {
        for op in code {
            let value = match *op {
                Op::Number(value) => value,
                Op::Named(name) => self.parameter_by_name(&name_of(block, name), scope)?,
                Op::Exists(name) => {
                    let name = name_of(block, name);
                    f64::from(u8::from(self.named.contains_key(&name) || is_predefined(&name)))
                }
                Op::Parameter => {
                    let index = pop(stack);
                    self.parameter_by_number(index, scope)?
                }
                Op::Function(function) => apply(function, pop(stack))?,
                Op::Atan => {
                    let x = pop(stack);
                    libm::atan2(pop(stack), x).to_degrees()
                }
                Op::Binary(operator) => {
                    let right = pop(stack);
                    combine(operator, pop(stack), right)?
                }
            };
            if !value.is_finite() {
                return Err(NOT_FINITE);
            }
            stack.push(value);
        }
        Ok(pop(stack))
    }

    fn parameter_by_number(&mut self, index: f64, scope: &Scope<'_>) -> Result<f64, Fault> {
        let number = parameter_number(index, scope.most)?;
        if let Some(value) = self.numbered.get(&number) {
            return Ok(*value);
        }
        if number <= LAST_PROGRAM_PARAMETER {
            return Err(NEVER_SET);
        }
        let known = match number {
            5220 => Some(f64::from(scope.state.offsets.active.number())),
            5420 if scope.has_names => scope.state.coordinate(0),
            5421 if scope.has_names => scope.state.coordinate(1),
            5422 if scope.has_names => scope.state.coordinate(2),
            _ => None,
        };
        Ok(known.unwrap_or_else(|| self.machine_value(format!("#{number}"))))
    }

    fn parameter_by_name(&mut self, name: &str, scope: &Scope<'_>) -> Result<f64, Fault> {
        if let Some(value) = self.named.get(name) {
            return Ok(*value);
        }
        if !is_predefined(name) {
            return Err(NEVER_SET);
        }
        let state = scope.state;
        let truth = |is_true: bool| f64::from(u8::from(is_true));
        let known = match name {
            "_x" => state.coordinate(0),
            "_y" => state.coordinate(1),
            "_z" => state.coordinate(2),
            "_metric" => state.stated.units.then(|| truth(state.unit != INCH)),
            "_imperial" => state.stated.units.then(|| truth(state.unit == INCH)),
            "_absolute" => state.stated.distance.then(|| truth(!state.incremental)),
            "_incremental" => state.stated.distance.then(|| truth(state.incremental)),
            _ => None,
        };
        Ok(known.unwrap_or_else(|| self.machine_value(format!("#<{name}>"))))
    }

    /// Records a parameter that only the machine knows, and returns the value assumed for it.
    fn machine_value(&mut self, parameter: String) -> f64 {
        self.machine_values.push(parameter.into());
        0.0
    }
}

/// Names that LinuxCNC defines itself (`interp_namedparams.cc` and the chapter "Predefined Named Parameters" of its manual).
const PREDEFINED: &[&str] = &[
    "_a",
    "_abs_a",
    "_abs_b",
    "_abs_c",
    "_abs_u",
    "_abs_v",
    "_abs_w",
    "_abs_x",
    "_abs_y",
    "_abs_z",
    "_absolute",
    "_adaptive_feed",
    "_b",
    "_c",
    "_call_level",
    "_ccomp",
    "_coord_system",
    "_current_pocket",
    "_current_tool",
    "_feed",
    "_feed_hold",
    "_feed_override",
    "_flood",
    "_ijk_absolute_mode",
    "_imperial",
    "_incremental",
    "_inverse_time",
    "_lathe_diameter_mode",
    "_lathe_radius_mode",
    "_line",
    "_metric",
    "_mist",
    "_motion_mode",
    "_plane",
    "_remap_level",
    "_retract_old_z",
    "_retract_r_plane",
    "_rpm",
    "_selected_pocket",
    "_selected_tool",
    "_speed_override",
    "_spindle_css_mode",
    "_spindle_cw",
    "_spindle_on",
    "_spindle_rpm_mode",
    "_task",
    "_tool_offset",
    "_u",
    "_units_per_minute",
    "_units_per_rev",
    "_v",
    "_value",
    "_value_returned",
    "_vmajor",
    "_vminor",
    "_w",
    "_x",
    "_y",
    "_z",
];

/// Whether LinuxCNC itself defines a name: for a state of the machine, an entry of its configuration, or a signal of its HAL.
fn is_predefined(name: &str) -> bool {
    let is_entry = ["_ini[", "_hal["].iter().any(|start| name.starts_with(start));
    is_entry || PREDEFINED.binary_search(&name).is_ok()
}

/// Normalizes a name; case and blanks are irrelevant.
pub(super) fn name_of(block: &Block<'_>, name: Span) -> Box<str> {
    let name = block.text_of(name);
    name.chars().filter(|letter| !letter.is_whitespace()).flat_map(char::to_lowercase).collect()
}

pub(super) fn parameter_number(index: f64, most: u32) -> Result<u32, Fault> {
    let whole = libm::round(index);
    if libm::fabs(index - whole) > 0.0001 || whole < 1.0 || whole > f64::from(most) {
        return Err(NO_SUCH_PARAMETER);
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole, from 1 to a u32")]
    Ok(whole as u32)
}

/// Removes the top value. The stack cannot be empty, because the reader has compiled the code, so every operator has its operands.
fn pop(stack: &mut Vec<f64>) -> f64 {
    stack.pop().unwrap_or(0.0)
}

fn apply(function: Function, x: f64) -> Result<f64, Fault> {
    let within_one = |x: f64| if (-1.0..=1.0).contains(&x) { Ok(x) } else { Err(OUTSIDE_ONE) };
    Ok(match function {
        Function::Negate => -x,
        Function::Abs => x.abs(),
        Function::Acos => libm::acos(within_one(x)?).to_degrees(),
        Function::Asin => libm::asin(within_one(x)?).to_degrees(),
        Function::Cos => libm::cos(x.to_radians()),
        Function::Exp => libm::exp(x),
        Function::Fix => x.floor(),
        Function::Fup => x.ceil(),
        Function::Ln if x > 0.0 => libm::log(x),
        Function::Ln => return Err(LOGARITHM),
        Function::Round => libm::round(x),
        Function::Sin => libm::sin(x.to_radians()),
        Function::Sqrt if x >= 0.0 => libm::sqrt(x),
        Function::Sqrt => return Err(NEGATIVE_ROOT),
        Function::Tan => libm::tan(x.to_radians()),
    })
}

fn combine(operator: Binary, left: f64, right: f64) -> Result<f64, Fault> {
    let truth = |is_true: bool| Ok(f64::from(u8::from(is_true)));
    let equal = libm::fabs(left - right) < EQUALITY_TOLERANCE;
    match operator {
        Binary::Power if left < 0.0 && libm::floor(right) != right => Err(NEGATIVE_POWER),
        Binary::Power => Ok(libm::pow(left, right)),
        Binary::Times => Ok(left * right),
        Binary::Divide | Binary::Modulo if right == 0.0 => Err(DIVISION_BY_ZERO),
        Binary::Divide => Ok(left / right),
        Binary::Modulo => {
            let rest = libm::fmod(left, right);
            Ok(if rest < 0.0 { rest + right.abs() } else { rest })
        }
        Binary::Plus => Ok(left + right),
        Binary::Minus => Ok(left - right),
        Binary::And => truth(left != 0.0 && right != 0.0),
        Binary::Or => truth(left != 0.0 || right != 0.0),
        Binary::Xor => truth((left != 0.0) != (right != 0.0)),
        Binary::Equal => truth(equal),
        Binary::NotEqual => truth(!equal),
        Binary::Less => truth(left < right),
        Binary::LessOrEqual => truth(left <= right || equal),
        Binary::Greater => truth(left > right),
        Binary::GreaterOrEqual => truth(left >= right || equal),
    }
}

const NOT_FINITE: Fault = Fault(&Text { en: "the result is too large", de: "das Ergebnis ist zu groß" });
const NEVER_SET: Fault =
    Fault(&Text { en: "the parameter was never set", de: "der Parameter wurde nie gesetzt" });
const NO_SUCH_PARAMETER: Fault = Fault(&Text {
    en: "there is no parameter with that number",
    de: "es gibt keinen Parameter mit dieser Nummer",
});
const OUTSIDE_ONE: Fault =
    Fault(&Text { en: "the number is not between -1 and 1", de: "die Zahl liegt nicht zwischen -1 und 1" });
const LOGARITHM: Fault = Fault(&Text {
    en: "the logarithm of a number that is not positive",
    de: "der Logarithmus einer nicht positiven Zahl",
});
const NEGATIVE_ROOT: Fault =
    Fault(&Text { en: "the root of a negative number", de: "die Wurzel einer negativen Zahl" });
const NEGATIVE_POWER: Fault = Fault(&Text {
    en: "a negative number with a fractional exponent",
    de: "eine negative Zahl mit gebrochenem Exponenten",
});
const DIVISION_BY_ZERO: Fault = Fault(&Text { en: "division by zero", de: "Division durch null" });

/// The probes that a native program lists before its first word.
#[derive(Debug, Default)]
pub(super) struct StatedProbes {
    pub(super) probes: BTreeMap<u32, ProgramProbe>,
    /// Whether pathbuild wrote the program, so that every probe is listed in its header.
    pub(super) is_ours: bool,
    pub(super) has_begun: bool,
    /// The start height S0 of the drawing in mm, slightly above the sweep height S, which is the only height that is never corrected.
    pub(super) start_height: Option<f64>,
    stack: Vec<f64>,
}

/// The height of each probe, as drawn or as measured, with which a formula is evaluated.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum ProbeHeight {
    Drawn,
    Measured,
}

pub(super) enum NoValue {
    /// The program does not list this probe.
    UnknownProbe(u32),
    /// The program does not list the measured height of this probe.
    Unmeasured(u32),
    Infinite,
}

impl StatedProbes {
    pub(super) fn evaluate(&mut self, code: &[Op], height: ProbeHeight) -> Result<f64, NoValue> {
        let mut stack = std::mem::take(&mut self.stack);
        stack.clear();
        let value = self.run(code, height, &mut stack);
        self.stack = stack;
        value.and_then(|value| if value.is_finite() { Ok(value) } else { Err(NoValue::Infinite) })
    }

    fn run(&self, code: &[Op], height: ProbeHeight, stack: &mut Vec<f64>) -> Result<f64, NoValue> {
        for (index, op) in code.iter().enumerate() {
            // The reader has compiled the formula, so every operator has its operands.
            let mut pop = || stack.pop().unwrap_or(f64::NAN);
            let value = match *op {
                Op::Number(number) => number,
                Op::Parameter => {
                    let number = pop();
                    #[expect(
                        clippy::cast_possible_truncation,
                        clippy::cast_sign_loss,
                        reason = "it saturates"
                    )]
                    self.probe(number as u32, height, &code[index + 1..])?
                }
                Op::Function(Function::Negate) => -pop(),
                Op::Binary(operator) => {
                    let right = pop();
                    let left = pop();
                    match operator {
                        Binary::Plus => left + right,
                        Binary::Minus => left - right,
                        Binary::Times => left * right,
                        Binary::Divide => left / right,
                        _ => f64::NAN,
                    }
                }
                _ => f64::NAN,
            };
            stack.push(value);
        }
        Ok(stack.pop().unwrap_or(f64::NAN))
    }

    /// Returns the height of a probe. In programs that do not list their probes, `[#51-2.000]` gives the height at which it was drawn.
    fn probe(&self, number: u32, height: ProbeHeight, behind: &[Op]) -> Result<f64, NoValue> {
        match (self.probes.get(&number), height) {
            (Some(probe), ProbeHeight::Drawn) => Ok(probe.height),
            (Some(probe), ProbeHeight::Measured) => probe.measured.ok_or(NoValue::Unmeasured(number)),
            (None, ProbeHeight::Drawn) if !self.is_ours => match behind {
                [Op::Number(drawn), Op::Binary(Binary::Minus), ..] => Ok(*drawn),
                _ => Err(NoValue::UnknownProbe(number)),
            },
            (None, _) => Err(NoValue::UnknownProbe(number)),
        }
    }

    pub(super) fn has_measured(&self) -> bool {
        self.probes.values().any(|probe| probe.measured.is_some())
    }
}
