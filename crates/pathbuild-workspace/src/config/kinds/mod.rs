//! Types of values.

pub(super) mod number;
pub(super) mod pattern;
pub(super) mod table;
pub(super) mod text;
