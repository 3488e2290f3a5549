//! `pathbuild init`: a configuration with every key, commented; or a small library to learn on.

use camino::Utf8PathBuf;
use pathbuild_db::system::join;

use crate::context::Context;
use crate::exit::ExitStatus;
use pathbuild_workspace::config::{FILE_NAME, template};
use pathbuild_workspace::files;

macro_rules! example {
    ($($name:literal),* $(,)?) => {
        &[$(($name, include_bytes!(concat!("../../example/", $name)))),*]
    };
}

/// The library to learn on. Its drawings are written as text beside them, and held against it by the tests of the book.
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

/// Writes it into the working directory, unless a file is there already.
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
