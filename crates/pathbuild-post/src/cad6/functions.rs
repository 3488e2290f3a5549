//! Functions in terms. They are an extension of pathbuild, because it is unknown which functions CAD6 has. Angles are in degrees.

use std::ops::Range;

use pathbuild_diagnostic::Text;
use pathbuild_diagnostic::messages::posts;

use super::fault::Fault;

/// Why a function cannot be evaluated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Wrong {
    Name,
    Arguments,
}

impl Wrong {
    /// Converts it to a fault at the name of the function.
    pub(super) fn at(self, span: Range<usize>) -> Box<Fault> {
        match self {
            Self::Name => Fault::new(&posts::TERM_FUNCTION, span),
            Self::Arguments => Fault::new(&posts::TERM_ARGUMENTS, span),
        }
    }
}

/// The arguments a function takes.
#[derive(Clone, Copy, Debug)]
pub(super) enum Rule {
    /// One argument.
    One(fn(f64) -> f64),
    /// Two arguments.
    Two(fn(f64, f64) -> f64),
    /// Any number of arguments, but at least one.
    Any(fn(&[f64]) -> f64),
}

/// A function available in terms.
#[derive(Debug)]
pub(super) struct Function {
    pub(super) name: &'static str,
    pub(super) rule: Rule,
    /// Description of the result, for the book.
    pub(super) about: Text,
}

/// All functions, in the order in which they are documented.
pub(super) static FUNCTIONS: &[Function] = &[
    Function { name: "abs", rule: Rule::One(f64::abs), about: Text { en: "absolute value", de: "Betrag" } },
    Function {
        name: "sqrt",
        rule: Rule::One(f64::sqrt),
        about: Text { en: "square root", de: "Quadratwurzel" },
    },
    Function {
        name: "int",
        rule: Rule::One(f64::trunc),
        about: Text { en: "without decimals", de: "ohne Nachkommastellen" },
    },
    Function {
        name: "round",
        rule: Rule::One(f64::round),
        about: Text {
            en: "nearest whole number, halves away from 0",
            de: "nächste ganze Zahl, Hälften von 0 weg",
        },
    },
    Function {
        name: "floor",
        rule: Rule::One(f64::floor),
        about: Text { en: "next smaller whole number", de: "nächstkleinere ganze Zahl" },
    },
    Function {
        name: "ceil",
        rule: Rule::One(f64::ceil),
        about: Text { en: "next larger whole number", de: "nächstgrößere ganze Zahl" },
    },
    Function {
        name: "sin",
        rule: Rule::One(|x| libm::sin(x.to_radians())),
        about: Text { en: "sine", de: "Sinus" },
    },
    Function {
        name: "cos",
        rule: Rule::One(|x| libm::cos(x.to_radians())),
        about: Text { en: "cosine", de: "Kosinus" },
    },
    Function {
        name: "tan",
        rule: Rule::One(|x| libm::tan(x.to_radians())),
        about: Text { en: "tangent", de: "Tangens" },
    },
    Function {
        name: "asin",
        rule: Rule::One(|x| libm::asin(x).to_degrees()),
        about: Text { en: "arc sine", de: "Arkussinus" },
    },
    Function {
        name: "acos",
        rule: Rule::One(|x| libm::acos(x).to_degrees()),
        about: Text { en: "arc cosine", de: "Arkuskosinus" },
    },
    Function {
        name: "atan",
        rule: Rule::One(|x| libm::atan(x).to_degrees()),
        about: Text { en: "arc tangent", de: "Arkustangens" },
    },
    Function {
        name: "atan2",
        rule: Rule::Two(|y, x| libm::atan2(y, x).to_degrees()),
        about: Text { en: "angle of the point (second, first)", de: "Winkel des Punktes (zweites, erstes)" },
    },
    Function {
        name: "mod",
        rule: Rule::Two(|a, b| a - b * (a / b).floor()),
        about: Text {
            en: "remainder, with the sign of the second",
            de: "Rest, mit dem Vorzeichen des zweiten",
        },
    },
    Function {
        name: "min",
        rule: Rule::Any(|all| all.iter().copied().fold(f64::INFINITY, f64::min)),
        about: Text { en: "the smallest", de: "das Kleinste" },
    },
    Function {
        name: "max",
        rule: Rule::Any(|all| all.iter().copied().fold(f64::NEG_INFINITY, f64::max)),
        about: Text { en: "the largest", de: "das Größte" },
    },
];

/// Evaluates a function.
pub(super) fn call(name: &str, arguments: &[f64]) -> Result<f64, Wrong> {
    let function = FUNCTIONS.iter().find(|function| function.name == name).ok_or(Wrong::Name)?;
    match (function.rule, arguments) {
        (Rule::One(value), &[x]) => Ok(value(x)),
        (Rule::Two(value), &[x, y]) => Ok(value(x, y)),
        (Rule::Any(value), [_, ..]) => Ok(value(arguments)),
        _ => Err(Wrong::Arguments),
    }
}
