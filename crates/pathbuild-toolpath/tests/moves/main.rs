//! Tests all moves of a program, with their order and numbers. (book: program/gcode)
//!
//! Moves are abbreviated: `S x,y` sweeps (G00 X Y), `L z` lifts (G00 Z), `D z` drills (G01 Z), `M x,y z` mills a line (G01), `A x,y z` and
//! `C x,y z` mill an arc counterclockwise or clockwise (G03, G02).
#![allow(clippy::unwrap_used, reason = "a test that cannot set up its drawing has failed")]

mod arcs;
mod bars;
mod chains;
mod feeds;
mod helices;
mod holes;
mod merging;
mod nearest;
mod probes;
mod statistics;
mod subpaths;
mod sweepless;
mod sweeps;

mod support;
