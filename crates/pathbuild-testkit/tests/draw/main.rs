//! Tests of the public interface.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod elements;
mod errors;
mod ezdxf;
mod files;
mod fixtures;
mod library;
mod placement;
mod q_projects;
mod reader;
mod records;
