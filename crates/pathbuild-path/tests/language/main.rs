//! Tests the rules of the drawing language, each with one drawing that just complies and one that just does not. (book: language/layers-and-names
//! to language/q-projects)
#![allow(clippy::unwrap_used, reason = "a test that cannot set up its drawing has failed")]

mod assignment;
mod at_once;
mod chains;
mod changes;
mod circles;
mod crowded;
mod default_patterns;
mod doubts;
mod embedding;
mod file_name;
mod files;
mod full_circles;
mod keep_outs;
mod letters;
mod limits;
mod line_types;
mod mistakes;
mod names;
mod parameters;
mod placement;
mod range_table;
mod stars;
mod stray;
mod text_circle;
mod texts;
mod turns;
mod variables;
mod walk;

mod support;
