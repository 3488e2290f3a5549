//! The types that values of keys can have.

pub(super) mod number;
pub(super) mod pattern;
pub(super) mod table;
pub(super) mod text;
