//! Runs the program as users do. All modules are in one binary, since linking several takes long; each module tests one subject.
#![allow(
    clippy::unwrap_used,
    clippy::disallowed_methods,
    reason = "a test that cannot set up its files has failed"
)]

mod agreement;
mod api;
mod book;
#[cfg(unix)]
mod build_systems;
mod cache;
mod cascades;
mod check;
mod chip_loads;
mod compat;
mod config;
mod conformance;
mod definitions;
mod dependencies;
mod depfiles;
mod diagnostics;
mod diff;
mod diff_limits;
mod diff_reasons;
mod documents;
mod edited_programs;
mod elsewhere;
mod emit;
mod emit_check_kept;
mod example;
mod explain_examples;
mod faults;
mod gate;
mod gcode;
mod german;
mod german_messages;
mod growth;
mod headers;
mod help;
mod hostile;
mod hostile_projects;
mod keep_outs;
mod kills;
mod language;
mod left_out;
mod library;
mod limits;
mod list;
mod machine_import;
mod machines;
mod many_programs;
mod meanwhile;
mod mistakes;
mod nesting;
mod nothing;
mod pictures;
mod posts;
mod prefetch;
mod probes;
mod program_reports;
mod programs;
mod progress;
mod projects;
mod q_project;
mod render;
mod report;
mod serve;
mod severities;
mod sheet;
mod shown;
mod since;
mod spindle_direction;
mod stock;
mod strangers;
mod subprograms;
mod support;
mod texts;
mod untrusted;
mod untrusted_roots;
mod usage;
mod view;
mod waivers;
mod watch;
mod why;
mod windows;
mod words;
