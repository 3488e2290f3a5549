//! Compiles drawings of milling paths to G-code.

use std::process::ExitCode;

fn main() -> ExitCode {
    pathbuild::run(std::env::args_os()).into()
}
