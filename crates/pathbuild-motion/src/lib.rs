//! Moves of a machine: where its tool goes and how, and what else it does. (book: program/reading)
//!
//! Every part of pathbuild that asks what a program does asks these [`Step`]s: the writers, the reader, `verify`, posts, pictures and
//! statistics. Everything is in millimetres and absolute. Nothing here knows drawings or texts.

mod arc;
mod moves;
mod position;
mod step;
mod written_arc;

pub use arc::{Arc, Course, turn, widest_chord};
pub use moves::{Move, Named, Pace, Path};
pub use position::{Axes, Plane, Position};
pub use step::{
    Action, Change, Coolant, Corners, Group, Spindle, StatedWord, Step, ToolLength, Turning, WordEffect,
    WorkSystem,
};
pub use written_arc::WrittenArc;
