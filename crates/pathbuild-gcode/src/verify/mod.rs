//! Whether a program is what it should be: the same as another, and safe to run. (spec/90-gcode-import.md, "verify")

mod compare;
mod walk;

pub use compare::{Difference, Ends, Kind, Tolerance, compare};
