//! The moves of a path, and the fold that places, joins and merges them into a program.
//!
//! [`fold`] walks over a path and all its embedded paths and records every step of the machine. It gets the embedded paths from a
//! [`Parts`]. This crate does not format text. (book: program/gcode, book: language/probes)

mod bars;
mod chain;
mod correction;
mod cost;
mod fold;
mod helix;
mod mill;
mod moves;
mod nearest;
mod pieces;
mod probes;
mod program;
mod statistics;
mod trace;
mod z_model;

pub use bars::support_bars;
pub use correction::{Correction, Outside};
pub use cost::{memory, own_moves};
pub use fold::{Parts, fold, fold_traced};
pub use moves::{LAST_DIGIT, ToolTip, is_doubtful, is_point, kind_of_move, way};
pub use pathbuild_path::Xy;
pub use program::{
    Class, Comment, Count, ElementKind, Height, LeftOut, Move, NameId, Names, ProbePoint, Program, Step,
};
pub use statistics::{Statistics, Total};
pub use trace::{Occurrence, StepOrigin, Trace};
pub use z_model::{OddProbe, Surface, ZModel, odd_probes};
