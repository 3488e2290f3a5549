//! Tests post-processors through their public interface.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod built_in;
mod cad6;
mod cambam_definition;
mod cambam_lines;
mod cambam_moves;
mod cambam_outputs;
mod control_text_ways;
mod jobs;
mod messages;
mod mutilated;
mod others_texts;
mod read_programs;
mod robustness;
mod support;
mod target;
mod tools;
