//! The moves and other actions of a machine. (book: program/reading)
//!
//! All parts of pathbuild use these [`Step`]s to describe the effects of a program: writers, reader, `verify`, posts, pictures and
//! statistics. Everything is absolute and in millimetres. This crate knows neither drawings nor texts.

mod chip_load;
mod cutting_length;
mod geometry;
mod step;

pub use chip_load::ChipLoad;
pub use cutting_length::check_cutting_length;
pub use geometry::{
    Arc, Axes, Course, MAX_RADIUS_DIFFERENCE_INCHES, MAX_RADIUS_DIFFERENCE_MM, Plane, Position, WrittenArc,
    is_full_turn, turn_angle, widest_chord,
};
pub use step::{
    Action, Change, Coolant, Corners, Frame, Group, Move, MoveShape, NamedPosition, Pace, Spindle,
    StatedWord, Step, ToolLength, Turning, WordEffect, WorkSystem,
};
