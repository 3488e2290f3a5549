//! Scenes from programs, drawings and G-code.

mod drawn;
mod finding;
mod gcode;
mod lines;
mod other;
mod program;

pub use drawn::{DrawnSource, drawn_path, keep_out};
pub use finding::findings;
pub use gcode::{GcodeSource, gcode_path};
pub use other::other_layers;
pub use program::{EmittedText, ProgramSource, program_path};
