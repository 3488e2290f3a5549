//! What `emit` writes, checks and removes. (spec/05-command-line.md, spec/60-gcode.md "Files")

mod support;
