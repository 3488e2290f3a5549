//! Simulates faults of the machine: a full disk, a directory of another user, a clock that goes backwards, a cache that is cleaned during a run.
//! Tests that the machine does not permit are skipped, with a note. (docs/reliability.md)
#![cfg(target_os = "linux")]

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::{Command, Stdio};

use crate::support::{Place, program};
use pathbuild_testkit::{sheet, skip};

const CONFIGURATION: &str = "feed = 150\nrapid = 1000\nsweep-height = 20\nlibrary = [\".\"]\n";

fn dxf(infeed: &str) -> Vec<u8> {
    let drawn = format!("layer 1202.1P\nstart 0,0 \"T5 O2 I{infeed} B0 MX\"\nmill 0,0 40,0\nend 40,0");
    sheet(&drawn).unwrap().to_dxf()
}

fn place() -> Place {
    Place::new().file("pathbuild.toml", CONFIGURATION).file("1202.1P.dxf", dxf("1"))
}

/// Returns the names in a directory that end in `.tmp`.
fn debris(directory: &Path) -> Vec<String> {
    let names = fs::read_dir(directory).unwrap().map(|entry| entry.unwrap().file_name());
    let names = names.map(|name| name.into_string().unwrap());
    names.filter(|name| Path::new(name).extension().is_some_and(|it| it == "tmp")).collect()
}

/// A file system of 64 KiB that exists as long as this value.
struct Small<'a>(&'a Path);

impl<'a> Small<'a> {
    fn mount(at: &'a Path) -> Option<Self> {
        fs::create_dir_all(at).unwrap();
        let mut mount = Command::new("mount");
        mount.args(["-t", "tmpfs", "-o", "size=64k,mode=700", "none"]).arg(at).stderr(Stdio::null());
        mount.status().is_ok_and(|status| status.success()).then_some(Self(at))
    }
}

impl Drop for Small<'_> {
    fn drop(&mut self) {
        _ = Command::new("umount").arg(self.0).status();
    }
}

/// Whatever amount of space is free, a program is either complete or the previous one, and no partial file is left.
#[test]
fn a_full_disk_leaves_whole_programs() {
    let place = place().file("1202.1P.dxf", dxf("0.02"));
    let expected = place.run("emit .");
    assert_eq!(expected.status, Some(0), "{expected}");
    let whole = place.read("1202.1P_Milling.gcode");
    let disk = place.path().join("disk");
    let Some(small) = Small::mount(&disk) else {
        return skip("full-disk", "no file system can be mounted");
    };
    let (mut refused, mut written) = (0, 0);
    for free in 1..=14 {
        let out = disk.join("1202.1P_Milling.gcode");
        fs::write(&out, "before").unwrap();
        fs::write(disk.join("filler"), vec![b'x'; (15 - free) * 4096]).unwrap();
        let run = place.run("emit . --out-dir disk");
        let found = fs::read_to_string(&out).unwrap();
        if run.status == Some(0) {
            written += 1;
            assert_eq!(found.len(), whole.len(), "{run}");
        } else {
            refused += 1;
            assert_eq!(run.status, Some(1), "{run}");
            assert!(run.stderr.contains("PB004"), "{run}");
            assert_eq!(found, "before");
        }
        assert_eq!(debris(&disk), [""; 0]);
        fs::remove_file(disk.join("filler")).unwrap();
        fs::remove_file(out).unwrap();
    }
    assert!(refused > 0 && written > 0, "{refused} refused, {written} written");
    drop(small);
}

/// If the disk of the cache is full, the findings are the same as without a cache.
#[test]
fn a_full_cache_changes_nothing() {
    let place = place();
    let caches = place.path().join("caches");
    let Some(small) = Small::mount(&caches) else {
        return skip("full-disk", "no file system can be mounted");
    };
    let without = place.run("check --no-cache --format json");
    for pages in 0..=16 {
        // Best effort: the disk may be full before the filler is complete.
        _ = fs::write(caches.join("filler"), vec![b'x'; pages * 4096]);
        let kept = place.run("check --cache-dir caches/kept --format json");
        assert_eq!((kept.status, &kept.stdout), (Some(0), &without.stdout), "{kept}");
        // With enough space the cache must contain something; otherwise the test proves nothing.
        assert!(pages > 0 || fs::read_dir(caches.join("kept")).unwrap().count() > 1, "{kept}");
        fs::remove_dir_all(caches.join("kept")).ok();
    }
    drop(small);
}

/// The user has read-only access to the tree.
#[test]
fn a_directory_of_somebody_else_is_left_alone() {
    let place = place();
    let open = |path: &Path, mode| fs::set_permissions(path, fs::Permissions::from_mode(mode)).unwrap();
    open(place.path(), 0o755);
    let as_nobody = |arguments: &[&str]| {
        let mut command = Command::new("setpriv");
        command.args(["--reuid=65534", "--regid=65534", "--clear-groups"]);
        command.arg(program().get_program()).args(arguments).current_dir(place.path());
        command.env_clear().env("PATH", "/usr/bin:/bin").stdin(Stdio::null()).output()
    };
    match as_nobody(&["--version"]) {
        Ok(output) if output.status.success() => {}
        _ => return skip("other-user", "no other user can be (setpriv), or may not run the program"),
    }
    let emitted = as_nobody(&["emit", ".", "--format", "concise"]).unwrap();
    let said = String::from_utf8(emitted.stderr).unwrap();
    assert_eq!(emitted.status.code(), Some(1), "{said}");
    assert!(said.contains("PB004"), "{said}");
    let checked = as_nobody(&["check"]).unwrap();
    assert_eq!(checked.status.code(), Some(0), "{}", String::from_utf8_lossy(&checked.stderr));
    let adjusted = as_nobody(&["check", "--cache-dir", "kept"]).unwrap();
    assert_eq!(adjusted.status.code(), Some(0), "{}", String::from_utf8_lossy(&adjusted.stderr));
    let mut left: Vec<_> = fs::read_dir(place.path()).unwrap().map(|it| it.unwrap().file_name()).collect();
    left.sort();
    assert_eq!(left, ["1202.1P.dxf", "pathbuild.toml"]);
}

/// Modification times are in the future, and then in the past. The cache compares file contents and does not rely on the clock.
#[test]
fn a_clock_that_goes_back_hides_no_change() {
    let place = place();
    let drawing = place.path().join("1202.1P.dxf");
    let year = std::time::Duration::from_hours(365 * 24);
    let now = std::time::SystemTime::now();
    for (round, time) in [now + year, now, now - year, now + year, now].into_iter().enumerate() {
        let is_wrong = round % 2 == 1;
        // The new content has the same length as the old one.
        fs::write(&drawing, dxf(if is_wrong { "X" } else { "1" })).unwrap();
        fs::File::options().write(true).open(&drawing).unwrap().set_modified(time).unwrap();
        for _ in 0..2 {
            let [kept, fresh] =
                ["check --format json", "check --format json --no-cache"].map(|line| place.run(line));
            assert_eq!(kept.stdout, fresh.stdout, "round {round}");
            assert_eq!(kept.status, Some(i32::from(is_wrong)), "{kept}");
        }
    }
}

/// While there is a cache, the clock of the process goes back by a year.
#[test]
fn a_run_under_an_older_clock_finds_the_same() {
    let faketime =
        ["/usr/lib/x86_64-linux-gnu/faketime/libfaketime.so.1", "/usr/lib/faketime/libfaketime.so.1"];
    let Some(library) = faketime.iter().find(|path| Path::new(path).exists()) else {
        return skip("faketime", "libfaketime is not there");
    };
    let place = place();
    for (round, shift) in ["+0", "-365d", "+365d", "-1d", "+0"].into_iter().enumerate() {
        let is_wrong = round % 2 == 1;
        fs::write(place.path().join("1202.1P.dxf"), dxf(if is_wrong { "X" } else { "1" })).unwrap();
        let shifted = || {
            let mut command = program();
            command.arg("check").current_dir(place.path()).env("XDG_CACHE_HOME", place.caches());
            command.env("LD_PRELOAD", library).env("FAKETIME", shift).output().unwrap()
        };
        for _ in 0..2 {
            assert_eq!(shifted().status.code(), Some(i32::from(is_wrong)), "{shift}");
            assert_eq!(place.run("check").status, Some(i32::from(is_wrong)), "{shift}");
        }
    }
}

/// `cache clean` runs during checks that use the cache: both succeed, and the findings stay the same.
#[test]
fn a_cache_may_be_cleaned_beside_checks() {
    let drawings = (0..40).map(|path| {
        let drawn = format!(
            "layer {}.1P\nstart 0,0 \"T5 O2 I1 B0 MX\"\nmill 0,0 5,0\nend 5,{}",
            2000 + path,
            path % 2
        );
        (format!("{}.1P.dxf", 2000 + path), sheet(&drawn).unwrap().to_dxf())
    });
    let place = drawings.fold(place(), |place, (name, bytes)| place.file(&name, bytes));
    let expected = place.run("check --no-cache --format json");
    let start = |arguments: &[&str]| {
        let mut command = program();
        command.args(arguments).current_dir(place.path()).env("XDG_CACHE_HOME", place.caches());
        command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
    };
    for round in 0..20 {
        let checks = [start(&["check", "--format", "json"]), start(&["check", "--format", "json"])];
        let cleans = [start(&["cache", "clean"]), start(&["cache", "prune"])];
        for child in cleans {
            let output = child.wait_with_output().unwrap();
            assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
        }
        for child in checks {
            let output = child.wait_with_output().unwrap();
            assert_eq!(output.status.code(), Some(1), "{}", String::from_utf8_lossy(&output.stderr));
            assert!(output.stdout == expected.stdout.as_bytes(), "round {round}");
        }
        assert_eq!(place.run("check --format json").stdout, expected.stdout);
    }
}
