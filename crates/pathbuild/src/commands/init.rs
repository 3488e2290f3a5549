//! `pathbuild init`: creates a commented configuration with every key, or a small example library.

use camino::Utf8PathBuf;
use pathbuild_db::system::join;

use crate::context::Context;
use crate::exit::ExitStatus;
use pathbuild_workspace::config::template;
use pathbuild_workspace::files::{self, FILE_NAME};

macro_rules! example {
    ($($name:literal),* $(,)?) => {
        &[$(($name, include_bytes!(concat!("../../example/", $name)))),*]
    };
}

/// Files of the example library with their contents. The drawings are derived from the text files (.draw) beside them; a test of the book
/// compares the two.
const EXAMPLE: &[(&str, &[u8])] = example![
    "pathbuild.toml",
    "starter.dxf",
    "components/2001.1P.dxf",
    "components/2002.1P.dxf",
    "projects/8001.1P.dxf",
    "templates/cad6.dxf",
    "templates/librecad.dxf",
    "templates/qcad.dxf",
];

/// Writes the files into the working directory. If one of them already exists, nothing is written.
pub fn run(context: &Context, example: bool) -> ExitStatus {
    let template = template();
    let configuration = [(FILE_NAME, template.as_bytes())];
    let files = if example { EXAMPLE } else { &configuration };
    let placed: Vec<(Utf8PathBuf, &[u8])> =
        files.iter().map(|(name, content)| (join(&context.working_directory, name), *content)).collect();
    match files::create(context, &placed) {
        Ok(()) => {
            for (name, _) in files {
                context.printer.result_line(name);
            }
            ExitStatus::Success
        }
        Err(reasons) => context.fail(reasons),
    }
}
