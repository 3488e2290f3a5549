//! Whether a program is what it should be: the same as another, and safe to run. (spec/90-gcode-import.md, "verify")

mod compare;
mod lines;
mod walk;

pub use compare::{Difference, Ends, Kind, Tolerance, compare};
pub use lines::same_move_lines;
