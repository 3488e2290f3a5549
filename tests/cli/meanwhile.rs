//! Tests drawings that change during a command. They are read again: no command panics, and none combines the elements of one version with the
//! positions of another. (ARCHITECTURE.md, "Invariants")

use std::fs;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

use camino::{Utf8Path, Utf8PathBuf};
use clap::Parser;
use pathbuild::args::Cli;
use pathbuild::printer::{ColorChoice, Printer, Verbosity};
use pathbuild::{Context, ExitStatus, commands};
use pathbuild_db::System;
use pathbuild_db::system::Stamp;
use pathbuild_db::system::{Entry, FileKind, Listing, OsSystem, ReadError, WriteOutcome};
use pathbuild_diagnostic::Value;
use pathbuild_workspace::{Workspace, config};

use crate::support::Place;

const BEFORE: &str = r#"
== a 8001.1P.dxf ==
layer 8001.1P
start 0,0 "T5 O2 MPlate S20"
subpath 0,0 40,0 ">1234.1P"
end 40,0
== 1234.dxf ==
layer 1234.1P
start 0,0 "T5 O2 I1 B4 MPlate"
mill 0,0 40,0
end 40,0
"#;

/// The files of the operating system. After one drawing was read for the n-th time, it is replaced.
#[derive(Debug)]
struct Changing {
    left: AtomicU32,
    victim: Utf8PathBuf,
    bytes: Vec<u8>,
}

impl Changing {
    fn change<T>(&self, path: &Utf8Path, read: T) -> T {
        if path == self.victim && self.left.fetch_sub(1, Ordering::SeqCst) == 1 {
            fs::write(&self.victim, &self.bytes).unwrap();
        }
        read
    }
}

impl System for Changing {
    fn read_into(&self, path: &Utf8Path, limit: u64, room: &mut Vec<u8>) -> Result<Stamp, ReadError> {
        self.change(path, OsSystem.read_into(path, limit, room))
    }

    fn read_head(&self, path: &Utf8Path, length: usize) -> Result<Vec<u8>, ReadError> {
        OsSystem.read_head(path, length)
    }

    fn list(&self, directory: &Utf8Path) -> Result<Listing, ReadError> {
        OsSystem.list(directory)
    }

    fn each_entry(
        &self,
        directory: &Utf8Path,
        take: &mut dyn FnMut(Entry<'_>) -> ControlFlow<()>,
    ) -> Result<(), ReadError> {
        OsSystem.each_entry(directory, take)
    }

    fn kind(&self, path: &Utf8Path) -> FileKind {
        OsSystem.kind(path)
    }

    fn canonical(&self, path: &Utf8Path) -> Utf8PathBuf {
        OsSystem.canonical(path)
    }

    fn write(&self, path: &Utf8Path, bytes: &[u8]) -> Result<WriteOutcome, Value> {
        OsSystem.write(path, bytes)
    }

    fn remove(&self, path: &Utf8Path) -> Result<(), Value> {
        OsSystem.remove(path)
    }
}

/// Runs a command while a drawing changes after its n-th read. Returns the status, and whether the drawing was read that often.
fn run(line: &str, victim: &str, reads: u32) -> (ExitStatus, bool) {
    let place = Place::of(BEFORE);
    let root = Utf8Path::from_path(place.path()).unwrap();
    // An additional element before all others changes every number and line.
    let changed = Place::of(&BEFORE.replace("layer ", "layer REMARKS\nmill 90,90 91,91\nlayer "));
    let bytes = fs::read(changed.path().join(victim)).unwrap();
    let system = Arc::new(Changing { left: AtomicU32::new(reads), victim: root.join(victim), bytes });
    let line = line.replace("DIR", root.as_str());
    let Ok(cli) = Cli::try_parse_from(["pathbuild"].into_iter().chain(line.split('|'))) else {
        panic!("{line}")
    };
    let (settings, faults) = config::load(
        &OsSystem::shared(),
        &cli.common.overrides(),
        &cli.command.inputs(),
        &Utf8PathBuf::new(),
    );
    assert!(faults.is_empty());
    let printer = Arc::new(Printer::new(Verbosity::Silent, ColorChoice::Never));
    let workspace = Workspace {
        settings,
        system: Arc::<Changing>::clone(&system),
        own_lang: None,
        system_lang: None,
        working_directory: Utf8PathBuf::new(),
        jobs: Some(1),
        cache: None,
        reporter: Arc::<Printer>::clone(&printer),
        is_date_decisive: Arc::default(),
    };
    let context = Context::new(&cli, cli.common.overrides(), printer, workspace);
    let status = commands::run(&context, &cli.command);
    (status, system.left.load(Ordering::SeqCst) == 0 || system.left.load(Ordering::SeqCst) > reads)
}

#[test]
fn commands_look_again_at_a_drawing_that_changes_meanwhile() {
    let lines = [
        "graph|DIR",
        "deps|DIR/a 8001.1P.dxf",
        "rdeps|DIR/1234.dxf",
        "where|DIR",
        "texts|DIR",
        "check|DIR",
        "q-project|DIR/1234.dxf",
        "emit|DIR/a 8001.1P.dxf|-o|-|--rapid|1000|--feed|150",
    ];
    let mut changes = 0;
    for line in lines {
        for victim in ["a 8001.1P.dxf", "1234.dxf"] {
            for reads in 1..4 {
                let (status, has_changed) = run(line, victim, reads);
                assert_eq!(status, ExitStatus::Success, "{line}: {victim} after {reads} reads");
                changes += u32::from(has_changed);
            }
        }
    }
    assert!(changes >= 16, "{changes}");
}
