//! Where the text of an element goes, so that by the rules of book: language/parameter-texts it belongs to that element.

mod candidate;
mod circle;
mod piece;
mod plain;
mod seat;

pub(crate) use candidate::candidates;
pub use circle::{TextCircle, text_circle};
pub(crate) use seat::seat_notes;
