//! Positions each text so that it belongs to its element by the rules of book: language/parameter-texts.

mod candidate;
mod circle;
mod piece;
mod plain;
mod seat;

pub(crate) use candidate::candidates;
pub use circle::{TextCircle, text_circle};
pub(crate) use seat::seat_notes;
