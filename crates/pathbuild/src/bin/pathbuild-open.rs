//! Opens the page of `pathbuild watch --serve` without a console: for files dropped on this program, or for the folder that contains it.
//! The program `pathbuild` beside it does all the work, and therefore never has to guess how it was started. (book: program/live)
#![windows_subsystem = "windows"]
#![expect(clippy::disallowed_methods, reason = "no result depends on its own location and arguments")]

use std::env;
use std::ffi::OsString;
use std::io::{self, Write};
use std::path::{self, Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};

fn main() -> ExitCode {
    let dropped: Vec<PathBuf> = env::args_os().skip(1).map(absolute).collect();
    let own = env::current_exe().ok().and_then(|program| program.parent().map(Path::to_owned));
    match run(&dropped, own.as_deref()) {
        Ok(None) => ExitCode::SUCCESS,
        Ok(Some(message)) => show(&message),
        Err(error) => show(&format!("{MISSING}\n{error}\n")),
    }
}

const MISSING: &str = "pathbuild-open needs the program pathbuild in its own folder.\npathbuild-open braucht das Programm pathbuild im selben Ordner.\n";

/// Starts `pathbuild`. Returns its error output if it failed without showing a page.
fn run(dropped: &[PathBuf], own: Option<&Path>) -> io::Result<Option<String>> {
    let mut command = Command::new(program(own));
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped());
    without_console(&mut command);
    match dropped {
        [file] if !is_drawing(file) && !file.is_dir() => _ = command.arg("view").arg(file),
        _ => _ = command.args(["watch", "--serve", "--open", "--until-closed"]),
    }
    match dropped {
        [] => _ = own.map(|own| command.current_dir(own)),
        [folder] if folder.join("pathbuild.toml").is_file() => _ = command.current_dir(folder),
        [file] if !is_drawing(file) && !file.is_dir() => {}
        _ => _ = command.arg("--").args(dropped),
    }
    let output = command.spawn()?.wait_with_output()?;
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    // If a page was written in spite of errors, it shows the errors as well.
    let is_shown = message.lines().any(|line| ends_in(Path::new(line), "html"));
    Ok(if output.status.success() || is_shown { None } else { Some(message) })
}

/// Returns the path of the program `pathbuild` beside this one. If there is none, returns only its name, which the system looks up in the
/// search path.
fn program(own: Option<&Path>) -> PathBuf {
    let name = format!("pathbuild{}", env::consts::EXE_SUFFIX);
    let beside = own.map(|own| own.join(&name)).filter(|beside| beside.is_file());
    beside.unwrap_or_else(|| PathBuf::from(name))
}

/// Makes an argument absolute, because a bare name could be taken for the name of a path in a drawing.
fn absolute(argument: OsString) -> PathBuf {
    path::absolute(&argument).unwrap_or_else(|_| argument.into())
}

fn is_drawing(file: &Path) -> bool {
    ends_in(file, "dxf")
}

fn ends_in(file: &Path, extension: &str) -> bool {
    file.extension().is_some_and(|own| own.eq_ignore_ascii_case(extension))
}

#[cfg(windows)]
fn without_console(command: &mut Command) {
    use std::os::windows::process::CommandExt;

    const CREATE_NO_WINDOW: u32 = 0x0800_0000;
    command.creation_flags(CREATE_NO_WINDOW);
}

#[cfg(not(windows))]
fn without_console(_: &mut Command) {}

/// Shows a text to a user without a console: writes it to a temporary file, which the system opens. The file is not removed.
fn show(text: &str) -> ExitCode {
    let shown = || -> io::Result<()> {
        let file = tempfile::Builder::new().prefix("pathbuild-").suffix(".txt").tempfile()?;
        file.as_file().write_all(text.as_bytes())?;
        let (_, path) = file.keep()?;
        open::that_detached(path)
    };
    // Users who started this program from a console see the text there.
    _ = io::stderr().write_all(text.as_bytes());
    _ = shown();
    ExitCode::FAILURE
}
