//! The moves of a path, and the fold that places, joins and merges them into a program.
//!
//! [`fold`] walks over a path and all its embedded paths and records every step of the machine. It gets the embedded paths from a
//! [`FoldPaths`]. This crate does not format text. (book: program/gcode, book: language/probes)

mod chain;
mod correction;
mod fold;
mod mill;
mod moves;
mod part_cuts;
mod program;
mod z_model;

pub use correction::{Correction, UnprobedPoint};
pub use fold::{FoldPaths, fold, fold_traced};
pub use mill::{axis_circle, support_bars};
pub use moves::{
    LAST_DIGIT, LAST_DIGIT_SLACK, ToolTip, is_doubtful_arc, is_point_arc, is_short_arc, kind_of_move,
    tip_move,
};
pub use part_cuts::part_cuts;
pub use pathbuild_path::Xy;
pub use program::{
    Comment, Count, ElementKind, Height, MoveClass, NameId, Names, Occurrence, OmittedCurves, PlannedMove,
    ProbeOrigin, ProbePoint, Program, ProgramStep, StepOrigin, Trace, estimated_bytes, own_moves,
};
pub use program::{Statistics, Total};
pub use z_model::{MIN_REPORTED_DEVIATION, OddProbe, Surface, ZModel, odd_probes};
