//! Writes, reads, checks and adjusts programs in G-code. (book: program/gcode, book: program/reading, book: language/probes)

pub mod adjust;
pub mod dialect;
pub mod estimate;
pub mod header;
pub mod interpret;
pub mod native;
pub mod provenance;
pub mod read;
pub mod statistics;
pub mod verify;
