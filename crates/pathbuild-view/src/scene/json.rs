//! Numbers in JSON: millimetres rounded to a millionth, so that a scene has the same bytes everywhere.

use serde::Serializer;
use serde::ser::SerializeSeq;

/// The precision: six decimals.
const MILLIONTHS: f64 = 1e6;

/// Rounds a coordinate or length, and avoids a negative 0.
pub(super) fn rounded(value: f64) -> f64 {
    (value * MILLIONTHS).round() / MILLIONTHS + 0.0
}

#[cfg_attr(target_pointer_width = "64", expect(clippy::trivially_copy_pass_by_ref, reason = "serde's form"))]
pub(super) fn millimetres<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_f64(rounded(*value))
}

pub(super) fn millimetres_each<S: Serializer>(values: &[f64], serializer: S) -> Result<S::Ok, S::Error> {
    let mut list = serializer.serialize_seq(Some(values.len()))?;
    for value in values {
        list.serialize_element(&rounded(*value))?;
    }
    list.end()
}

pub(super) fn point<S: Serializer>(value: &[f64; 2], serializer: S) -> Result<S::Ok, S::Error> {
    millimetres_each(value, serializer)
}

pub(super) fn points<S: Serializer>(values: &[[f64; 2]; 2], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(values.iter().map(|value| value.map(rounded)))
}
