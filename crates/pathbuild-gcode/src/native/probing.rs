//! The probing program, and the file into which the user enters the measured values. (book: language/probes)

use std::fmt::Write;

use pathbuild_toolpath::{ProbePoint, Program, Xy};

use super::correction::FIRST_PARAMETER;
use super::number::f3;
use super::program::{Header, WriteOptions, setup};

/// A pause in seconds after each probe, so that the user can read the value.
const DWELL: &str = "G04 P4";

/// Writes the probing program.
pub fn probing_program(program: &Program, header: &Header, options: &WriteOptions) -> String {
    let clearance = f3(program.sweep_height);
    let remarks = options.remarks(program);
    let mut text = String::from("%\n");
    for line in header.lines(program) {
        _ = writeln!(text, "{}", remarks.comment(&line));
    }
    text.push_str(setup(program));
    _ = writeln!(text, "G00 Z{clearance}\nG00 X0.000 Y0.000");
    let mut at = Xy::origin();
    for (index, probe) in program.probes.iter().enumerate() {
        let name = name_and_place(probe, program);
        _ = writeln!(text, "{}", remarks.comment(&format!("Probe #{} {name}", FIRST_PARAMETER + index)));
        if !pathbuild_path::approx::is_nothing((probe.at - at).norm()) {
            _ = writeln!(text, "G00 X{} Y{}", f3(probe.at.x), f3(probe.at.y));
        }
        at = probe.at;
        _ = writeln!(text, "G00 Z{}", f3(probe.height + program.tool));
        _ = writeln!(text, "{} Z0 F{}\n{DWELL}\nG00 Z{clearance}", code(program), f3(probe.feed));
    }
    _ = writeln!(text, "G00 X0.000 Y0.000\nG00 Z{clearance}\nM30\n%");
    text
}

/// Writes the file of values, with one line per probe and nothing after the `=` yet.
pub fn values_file(program: &Program, options: &WriteOptions) -> String {
    let remarks = options.remarks(program);
    let mut text = String::new();
    for (index, probe) in program.probes.iter().enumerate() {
        let name = name_and_place(probe, program);
        _ = writeln!(text, "{} #{}=", remarks.comment(&name), FIRST_PARAMETER + index);
    }
    text
}

/// The name of a probe in files: its position in the drawing, its label and the expected height.
pub fn probe_name(probe: &ProbePoint) -> String {
    let label = probe.label.as_ref().map(|label| format!("/L:{label}")).unwrap_or_default();
    let (x, y) = (f3(probe.drawn_at.x), f3(probe.drawn_at.y));
    format!("[{x} {y}]{label}/T={}", f3(probe.height))
}

/// The name, and the position in the emitted drawing, because a path that is embedded twice has each of its probes twice.
fn name_and_place(probe: &ProbePoint, program: &Program) -> String {
    let name = probe_name(probe);
    if program.compatible {
        return name;
    }
    format!("{name} @ [{}|{}]", f3(probe.at.x), f3(probe.at.y))
}

/// G38.2 is an alarm if the tool makes no contact. With G38.3, which the original tool writes, the machine continues.
fn code(program: &Program) -> &'static str {
    if program.compatible { "G38.3" } else { "G38.2" }
}
