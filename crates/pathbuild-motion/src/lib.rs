//! The moves and other actions of a machine. (book: program/reading)
//!
//! All parts of pathbuild use these [`Step`]s to describe the effects of a program: writers, reader, `verify`, posts, pictures and
//! statistics. Everything is absolute and in millimetres. This crate knows neither drawings nor texts.

mod arc;
mod moves;
mod position;
mod step;
mod written_arc;

pub use arc::{Arc, Course, is_same_direction, turn, widest_chord};
pub use moves::{Move, Named, Pace, Path};
pub use position::{Axes, Plane, Position};
pub use step::{
    Action, Change, Coolant, Corners, Group, Spindle, StatedWord, Step, ToolLength, Turning, WordEffect,
    WorkSystem,
};
pub use written_arc::WrittenArc;
