//! Runs the program as a shell would, in a separate directory and with an empty environment.
#![allow(unreachable_pub, reason = "one binary's own module")]

pub mod fixture;
mod stderr_lines;

use std::fmt;
use std::fs;
use std::io::{Read as _, Seek as _};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::Duration;

use pathbuild_testkit::Fixture;
pub use pathbuild_testkit::{project, shared};
use regex::Regex;
pub use stderr_lines::StderrLines;
use tempfile::TempDir;
use wait4::Wait4 as _;

/// Converts a drawing in the text form of the test kit to DXF.
pub fn dxf(drawing: &str) -> Vec<u8> {
    pathbuild_testkit::sheet(drawing).unwrap_or_else(|faults| panic!("{faults:?} in\n{drawing}")).to_dxf()
}

/// A directory with files, in which the program runs.
pub struct Place {
    directory: TempDir,
    /// The user's cache directory.
    caches: TempDir,
    /// The user's configuration directory.
    configurations: TempDir,
}

impl Place {
    pub fn new() -> Self {
        Self {
            directory: TempDir::new().unwrap(),
            caches: TempDir::new().unwrap(),
            configurations: TempDir::new().unwrap(),
        }
    }

    /// Creates a directory with the files of a fixture (crates/pathbuild-testkit, README.md).
    pub fn of(fixture: &str) -> Self {
        let fixture = Fixture::parse(fixture).unwrap();
        fixture.files.iter().fold(Self::new(), |place, file| place.file(&file.name, file.bytes()))
    }

    /// Adds a file and its parent directories.
    pub fn file(self, name: &str, content: impl AsRef<[u8]>) -> Self {
        let path = self.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, content).unwrap();
        self
    }

    /// Writes the user's own configuration.
    pub fn users(self, configuration: &str) -> Self {
        let directory = self.configurations.path().join("pathbuild");
        fs::create_dir_all(&directory).unwrap();
        fs::write(directory.join("config.toml"), configuration).unwrap();
        self
    }

    pub fn path(&self) -> &Path {
        self.directory.path()
    }

    pub fn caches(&self) -> &Path {
        self.caches.path()
    }

    pub fn configurations(&self) -> &Path {
        self.configurations.path()
    }

    /// Returns the cache directory of this tree.
    pub fn cache(&self) -> PathBuf {
        let below = if cfg!(windows) { "pathbuild/cache" } else { "pathbuild" };
        let mut trees = fs::read_dir(self.caches.path().join(below)).into_iter().flatten();
        trees.next().map_or_else(|| self.caches.path().join("none"), |tree| tree.unwrap().path())
    }

    pub fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path().join(name)).unwrap()
    }

    /// Runs `pathbuild` with arguments separated by spaces.
    pub fn run(&self, arguments: &str) -> Run {
        self.run_with(&arguments.split_whitespace().collect::<Vec<_>>())
    }

    pub fn run_with(&self, arguments: &[&str]) -> Run {
        self.run_in(".", arguments)
    }

    pub fn run_in(&self, directory: &str, arguments: &[&str]) -> Run {
        self.to_run(arguments, self.command(directory, arguments).output().unwrap())
    }

    /// Runs `pathbuild` with arguments separated by spaces. Also returns the processor time of that run.
    pub fn run_timed(&self, arguments: &str) -> (Run, Duration) {
        let arguments: Vec<&str> = arguments.split_whitespace().collect();
        // Use files instead of pipes, which would have to be read while waiting for the end.
        let [mut stdout, mut stderr] = [(); 2].map(|()| tempfile::tempfile().unwrap());
        let mut command = self.command(".", &arguments);
        command.stdout(stdout.try_clone().unwrap()).stderr(stderr.try_clone().unwrap());
        let used = command.spawn().unwrap().wait4().unwrap();
        let [stdout, stderr] = [&mut stdout, &mut stderr].map(|file| {
            let mut bytes = Vec::new();
            file.rewind().unwrap();
            file.read_to_end(&mut bytes).unwrap();
            bytes
        });
        let output = Output { status: used.status, stdout, stderr };
        (self.to_run(&arguments, output), used.rusage.utime + used.rusage.stime)
    }

    /// Runs `pathbuild` and returns whether it succeeded, and its peak memory in bytes. The system never reports less for a process than for the
    /// process that started it.
    #[cfg(target_os = "linux")]
    pub fn peak_memory(&self, arguments: &str) -> (bool, u64) {
        let mut command = self.command(".", &arguments.split_whitespace().collect::<Vec<_>>());
        let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        let status = format!("/proc/{}/status", child.id());
        let mut peak = 0;
        loop {
            let text = fs::read_to_string(&status).unwrap_or_default();
            let kilobytes =
                text.lines().find_map(|line| line.strip_prefix("VmHWM:")?.split_whitespace().next());
            peak = peak.max(kilobytes.map_or(0, |number| number.parse::<u64>().unwrap()) << 10);
            if let Some(status) = child.try_wait().unwrap() {
                return (status.success(), peak);
            }
            std::thread::sleep(Duration::from_millis(1));
        }
    }

    fn command(&self, directory: &str, arguments: &[&str]) -> Command {
        let mut program = program();
        let (caches, configurations) =
            if cfg!(windows) { ("LOCALAPPDATA", "APPDATA") } else { ("XDG_CACHE_HOME", "XDG_CONFIG_HOME") };
        program.env(caches, self.caches.path()).env(configurations, self.configurations.path());
        program.args(arguments).current_dir(self.path().join(directory));
        program
    }

    fn to_run(&self, arguments: &[&str], output: Output) -> Run {
        let text = |bytes: Vec<u8>| {
            let text = String::from_utf8(bytes).unwrap().replace(&shown(self.path()), "<PLACE>");
            let text = text.replace(&shown(&self.cache()), "<CACHE>");
            // The duration varies.
            Regex::new(r"(?m)\(\d+([.,])\d s\)$").unwrap().replace_all(&text, "(0${1}0 s)").into_owned()
        };
        Run {
            arguments: arguments.join(" "),
            status: output.status.code(),
            stdout: text(output.stdout),
            stderr: text(output.stderr),
        }
    }
}

/// Returns a path as the program displays it.
pub fn shown(path: &Path) -> String {
    let path = path.to_string_lossy();
    if cfg!(windows) { path.replace('\\', "/") } else { path.into_owned() }
}

/// Returns a command for the program, with an environment that chooses English: otherwise Windows would use the language of its user.
pub fn program() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_pathbuild"));
    command.env_clear().env("LC_ALL", "C").stdin(Stdio::null());
    command
}

/// The output and exit status of a run. Displayed as a single text, for snapshots.
#[derive(Debug, PartialEq, Eq)]
pub struct Run {
    pub arguments: String,
    pub status: Option<i32>,
    pub stdout: String,
    pub stderr: String,
}

impl fmt::Display for Run {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let status = self.status.map_or("killed".to_owned(), |status| status.to_string());
        writeln!(f, "$ pathbuild {}\nstatus: {status}", self.arguments)?;
        for (name, text) in [("stdout", &self.stdout), ("stderr", &self.stderr)] {
            if !text.is_empty() {
                writeln!(f, "--- {name}\n{}", text.trim_end_matches('\n'))?;
            }
        }
        Ok(())
    }
}

/// Runs several commands in turn and returns their output.
pub fn runs<'a>(place: &Place, lines: impl IntoIterator<Item = &'a str>) -> String {
    lines.into_iter().map(|line| place.run(line).to_string()).collect::<Vec<_>>().join("\n")
}
