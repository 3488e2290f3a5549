//! G-code text: writing, reading, checking and post-processing programs. (spec/60-gcode.md, spec/85-post-processors.md,
//! spec/90-gcode-import.md)

pub mod adjust;
pub mod dialect;
pub mod estimate;
pub mod interpret;
pub mod native;
pub mod provenance;
pub mod read;
pub mod summary;
pub mod verify;
