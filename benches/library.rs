//! The program on libraries of 100, 1,000 and 10,000 components: a check without a cache, a check when nothing has changed, Git's time for
//! detecting that, `emit --check` with a cache; and the memory of a check without a cache. (benches/README.md)
//!
//! Each library is generated in a temporary directory; the largest takes 500 MB, and half as much again for Git.
#![expect(clippy::disallowed_methods, reason = "it measures what the system does too")]
#![expect(clippy::unwrap_used, reason = "a benchmark that cannot set up its files cannot go on")]
#![expect(clippy::print_stdout, reason = "memory is no time, and Criterion has no place for it")]

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, BenchmarkId, Criterion, criterion_group, criterion_main};
use pathbuild_testkit::generate::Library;
use rayon::prelude::*;
use tempfile::TempDir;

criterion_group!(benches, libraries);
criterion_main!(benches);

const SIZES: [usize; 3] = [100, 1_000, 10_000];

fn libraries(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("library");
    group.sample_size(10).warm_up_time(Duration::from_millis(500)).measurement_time(Duration::from_secs(5));
    let peaks = SIZES.map(|components| {
        let directory = library(components);
        let directory = directory.path();
        measure(&mut group, "check --no-cache", components, || {
            pathbuild(directory, &["check", "--no-cache", "-qq"]);
        });
        let peak = peak_memory(directory);
        pathbuild(directory, &["emit", "-qq"]);
        pathbuild(directory, &["check", "-qq"]);
        // Files are identified by their stamps once they have not changed for two seconds.
        sleep(Duration::from_secs(3));
        pathbuild(directory, &["emit", "--check", "-qq"]);
        measure(&mut group, "check, nothing changed", components, || pathbuild(directory, &["check", "-qq"]));
        measure(&mut group, "emit --check, nothing changed", components, || {
            pathbuild(directory, &["emit", "--check", "-qq"]);
        });
        if repository(directory) {
            measure(&mut group, "git status", components, || {
                git(directory, &["-c", "core.untrackedCache=false", "status", "--porcelain"]);
            });
        }
        peak
    });
    group.finish();
    report(&peaks);
}

fn measure(group: &mut BenchmarkGroup<'_, WallTime>, what: &str, components: usize, mut work: impl FnMut()) {
    group.bench_function(BenchmarkId::new(what, components), |bencher| bencher.iter(&mut work));
}

/// A library with this number of components, and everything needed to emit its projects.
fn library(components: usize) -> TempDir {
    let place = TempDir::new().unwrap();
    let library = Library::new(components, 1);
    for name in library.directories() {
        fs::create_dir_all(place.path().join(name)).unwrap();
    }
    let configuration = format!("{}\n[emit]\ntargets = [\"8*.1P\"]\n", library.configuration());
    fs::write(place.path().join("pathbuild.toml"), configuration).unwrap();
    (0..library.len()).into_par_iter().for_each(|index| {
        let (name, sheet) = library.drawing(index);
        fs::write(place.path().join(name), sheet.to_dxf()).unwrap();
    });
    place
}

fn pathbuild(directory: &Path, arguments: &[&str]) {
    let status = program(directory).args(arguments).status().unwrap();
    assert!(status.success(), "{arguments:?}: {status}");
}

fn program(directory: &Path) -> Command {
    let mut program = Command::new(env!("CARGO_BIN_EXE_pathbuild"));
    program.current_dir(directory).stdout(Stdio::null()).stderr(Stdio::null());
    program
}

/// Commits everything to a Git repository. Returns whether Git is available.
fn repository(directory: &Path) -> bool {
    let commit = ["-c", "user.name=bench", "-c", "user.email=bench@localhost", "commit", "-qm", "library"];
    git(directory, &["init", "-q"]) && git(directory, &["add", "-A"]) && git(directory, &commit)
}

fn git(directory: &Path, arguments: &[&str]) -> bool {
    let mut git = Command::new("git");
    git.current_dir(directory).args(arguments).stdout(Stdio::null()).stderr(Stdio::null());
    git.status().is_ok_and(|status| status.success())
}

/// Peak memory of a check in KB; `None` if the system does not report it as Linux does.
fn peak_memory(directory: &Path) -> Option<u64> {
    let mut child = program(directory).args(["check", "--no-cache", "-qq"]).spawn().unwrap();
    let status = format!("/proc/{}/status", child.id());
    let mut peak = None;
    // It only grows, and is unavailable after the process has ended.
    while child.try_wait().unwrap().is_none() {
        peak = fs::read_to_string(&status).ok().as_deref().and_then(high_water).or(peak);
        sleep(Duration::from_millis(1));
    }
    peak
}

fn high_water(status: &str) -> Option<u64> {
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.split_whitespace().next()?.parse().ok()
}

fn report(peaks: &[Option<u64>]) {
    for (components, peak) in SIZES.iter().zip(peaks) {
        if let Some(peak) = peak {
            println!("memory of check --no-cache, {components} components: {peak} KB");
        }
    }
    if let [.., Some(small), Some(large)] = peaks {
        let drawings = SIZES.map(|components| Library::new(components, 1).len());
        let each = large.saturating_sub(*small) / (drawings[2] - drawings[1]) as u64;
        println!("memory for each further drawing: {each} KB");
    }
}
