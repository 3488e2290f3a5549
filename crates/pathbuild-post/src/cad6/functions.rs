//! Functions of terms. They are pathbuild's own: which ones CAD6 has is not known. Angles are degrees.

use std::ops::Range;

use pathbuild_diagnostic::messages::posts;

use super::fault::Fault;

/// Why a function has no value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Wrong {
    Name,
    Arguments,
}

impl Wrong {
    /// The fault where the function's name stands.
    pub(super) fn at(self, span: Range<usize>) -> Box<Fault> {
        match self {
            Self::Name => Fault::new(&posts::TERM_FUNCTION, span),
            Self::Arguments => Fault::new(&posts::TERM_ARGUMENTS, span),
        }
    }
}

/// The value of a function.
pub(super) fn call(name: &str, arguments: &[f64]) -> Result<f64, Wrong> {
    match (name, arguments) {
        ("min", [_, ..]) => Ok(arguments.iter().copied().fold(f64::INFINITY, f64::min)),
        ("max", [_, ..]) => Ok(arguments.iter().copied().fold(f64::NEG_INFINITY, f64::max)),
        ("mod", &[a, b]) => Ok(a - b * (a / b).floor()),
        ("atan2", &[y, x]) => Ok(libm::atan2(y, x).to_degrees()),
        ("min" | "max" | "mod" | "atan2", _) => Err(Wrong::Arguments),
        _ => of_one(name).and_then(|function| match arguments {
            &[x] => Ok(function(x)),
            _ => Err(Wrong::Arguments),
        }),
    }
}

fn of_one(name: &str) -> Result<fn(f64) -> f64, Wrong> {
    Ok(match name {
        "abs" => f64::abs,
        "sqrt" => f64::sqrt,
        "int" => f64::trunc,
        "round" => f64::round,
        "floor" => f64::floor,
        "ceil" => f64::ceil,
        "sin" => |x| libm::sin(x.to_radians()),
        "cos" => |x| libm::cos(x.to_radians()),
        "tan" => |x| libm::tan(x.to_radians()),
        "asin" => |x| libm::asin(x).to_degrees(),
        "acos" => |x| libm::acos(x).to_degrees(),
        "atan" => |x| libm::atan(x).to_degrees(),
        _ => return Err(Wrong::Name),
    })
}
