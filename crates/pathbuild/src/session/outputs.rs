//! The files that a program becomes. (spec/60-gcode.md, "Files")

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_gcode::native::{self, Header, WriteOptions};
use pathbuild_toolpath::Program;

/// A file to be written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Output {
    /// Where.
    pub path: Utf8PathBuf,
    /// Its whole text.
    pub text: String,
    /// Whether a person writes measured values into it, which must not be lost.
    pub holds_values: bool,
}

/// The files of a program: one without probes, three with. `stem`: the drawing's name, or the path's where a drawing holds several,
/// with what R adds. `feed`: for probing where the drawing gives no Z.
pub fn outputs(
    program: &Program,
    directory: &Utf8Path,
    stem: &str,
    header: &Header,
    feed: f64,
    options: &WriteOptions,
) -> Vec<Output> {
    let output = |suffix: &str, text: String| Output {
        path: directory.join(format!("{stem}{suffix}")),
        text,
        holds_values: suffix == VALUES,
    };
    let milling = native::program(program, header, options);
    if program.probes.is_empty() {
        return vec![output("_Milling.gcode", milling)];
    }
    vec![
        output("_Clean.gcode", milling),
        output("_Probing.gcode", native::probing_program(program, header, feed, options)),
        output(VALUES, native::values_file(program, options.charset)),
    ]
}

const VALUES: &str = "_Z.txt";
