//! Kills runs at random moments: every file then equals that of some complete run, and the next run leaves nothing behind. `PATHBUILD_KILLS` sets
//! how often each command is killed (default 20). (docs/reliability.md)

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};

use crate::support::{Place, program};
use pathbuild_testkit::sheet;

fn kills() -> u64 {
    std::env::var("PATHBUILD_KILLS").map_or(20, |count| count.parse().unwrap())
}

/// Deterministic pseudo-random numbers (xorshift).
struct Chance(u64);

impl Chance {
    /// Returns a random number from 0 to 1.
    fn part(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        f64::from(u32::try_from(self.0 >> 33).unwrap()) / f64::from(u32::MAX >> 1)
    }
}

fn configuration(feed: u32) -> String {
    format!("feed = {feed}\nrapid = 1000\nsweep-height = 20\nlibrary = [\".\"]\n[emit]\ntargets = [\"*\"]\n")
}

/// Creates a library with many programs, so that many kills occur while a program is being written.
fn library() -> Place {
    let mut place = Place::new();
    for path in 10..40 {
        let mills: Vec<String> = (0..10).map(|x| format!("mill {x},0 {},0\n", x + 1)).collect();
        let mills = mills.concat();
        let text = format!("layer 10{path}.1P\nstart 0,0 \"T5 O2 I0.5 B0 MX\"\n{mills}end 10,0");
        place = place.file(&format!("10{path}.1P.dxf"), sheet(&text).unwrap().to_dxf());
    }
    place
}

/// Returns the names of temporary files in the directory, and the other files besides drawings and configuration with their bytes.
fn files(place: &Place) -> (Vec<String>, BTreeMap<String, Vec<u8>>) {
    let (mut debris, mut outputs) = (Vec::new(), BTreeMap::new());
    for entry in fs::read_dir(place.path()).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        if Path::new(&name).extension().is_some_and(|extension| extension == "tmp") {
            debris.push(name);
        } else if name.ends_with("_Milling.gcode") {
            let bytes = fs::read(place.path().join(&name)).unwrap();
            outputs.insert(name, bytes);
        }
    }
    (debris, outputs)
}

fn start(place: &Place, arguments: &[&str]) -> Child {
    let mut command = program();
    command.args(arguments).current_dir(place.path()).env("XDG_CACHE_HOME", place.caches());
    command.stdout(Stdio::null()).stderr(Stdio::piped());
    command.spawn().unwrap()
}

/// Kills a command at random moments while its output changes between two states. `change` puts the tree into a state.
#[expect(clippy::print_stdout, reason = "how many kills met a running program is a part of the result")]
fn kill_at_any_moment(place: &Place, arguments: &[&str], last: &[&str], change: impl Fn(&Place, u64)) {
    let mut states = Vec::new();
    let mut time = Duration::ZERO;
    for state in 0..2 {
        change(place, state);
        let begun = Instant::now();
        assert_eq!(start(place, last).wait().unwrap().code(), Some(0));
        time = begun.elapsed();
        states.push(files(place).1);
    }
    assert!(!states[0].is_empty() && states[0] != states[1]);
    let mut chance = Chance(0x2545_f491_4f6c_dd1d);
    let (mut hit, mut left) = (0, 0);
    for kill in 0..kills() {
        change(place, kill % 2);
        let mut child = start(place, arguments);
        drop(child.stderr.take());
        std::thread::sleep(time.mul_f64(1.1 * chance.part()));
        hit += u32::from(child.try_wait().unwrap().is_none());
        child.kill().unwrap();
        child.wait().unwrap();
        let (debris, outputs) = files(place);
        left += debris.len();
        for (name, bytes) in outputs {
            assert!(
                states.iter().any(|state| state.get(&name) == Some(&bytes)),
                "{name} is none of a whole run"
            );
        }
    }
    for state in 0..2 {
        change(place, state);
        // A run for which everything is current writes and removes nothing.
        fs::remove_file(place.path().join(states[0].keys().next().unwrap())).unwrap();
        assert_eq!(start(place, last).wait().unwrap().code(), Some(0));
        let (debris, outputs) = files(place);
        assert_eq!(debris, [""; 0], "the next run that writes leaves nothing behind");
        assert!(
            outputs == states[usize::try_from(state).unwrap()],
            "the next run writes what it would have written"
        );
    }
    println!(
        "{arguments:?}: {} kills, {hit} of them while it ran, {left} files left behind until the next run",
        kills()
    );
}

#[test]
fn emit_that_is_killed_leaves_whole_programs() {
    let place = library();
    kill_at_any_moment(&place, &["emit", "."], &["emit", "."], |place, state| {
        fs::write(place.path().join("pathbuild.toml"), configuration(150 + u32::try_from(state).unwrap()))
            .unwrap();
    });
}

#[test]
fn watch_that_is_killed_leaves_whole_programs() {
    let place = library();
    kill_at_any_moment(&place, &["watch", "--emit"], &["emit"], |place, state| {
        fs::write(place.path().join("pathbuild.toml"), configuration(150 + u32::try_from(state).unwrap()))
            .unwrap();
    });
}

#[test]
fn adjust_that_is_killed_leaves_a_whole_program() {
    let line = |x| format!("G01 F150.000 X{x}.000 Y0.000 Z1.000(=1.000+1.000*[#51-5.000])\n");
    let lines = (0..2_000).map(line).collect::<Vec<_>>().concat();
    let place = Place::new().file("a_Clean.gcode", format!("%\nG00 Z20.000\n{lines}M30\n%\n"));
    let adjust = ["adjust", "a", "--max-correction", "1"];
    kill_at_any_moment(&place, &adjust, &adjust, |place, state| {
        fs::write(place.path().join("a_Z.txt"), format!("([0.000 0.000]/T=5.000) #51=5.{}\n", state + 1))
            .unwrap();
    });
}

/// A cached result is either complete or absent: findings are the same as without a cache.
#[test]
fn a_check_that_is_killed_keeps_nothing_wrong() {
    let place = library().file("pathbuild.toml", configuration(150));
    let drawing = |thickness: u64| {
        let text = format!(
            "layer 2000.1P\nstart 0,0 \"T{thickness} O2 I1 B0 MX\"\nmill 0,0 5,0\nend 5,{}",
            thickness % 2
        );
        sheet(&text).unwrap().to_dxf()
    };
    let mut chance = Chance(0x9e37_79b9_7f4a_7c15);
    for kill in 0..kills() {
        fs::write(place.path().join("2000.1P.dxf"), drawing(4 + kill)).unwrap();
        let mut child = start(&place, &["check"]);
        std::thread::sleep(Duration::from_millis(120).mul_f64(chance.part()));
        child.kill().unwrap();
        child.wait().unwrap();
        if kill % 4 == 0 {
            let [kept, fresh] =
                ["check --format json", "check --format json --no-cache"].map(|line| place.run(line).stdout);
            assert_eq!(kept, fresh);
        }
    }
}

/// Two to four runs use the same directory at the same time. During most of them, the cache is cleaned as well.
#[test]
fn runs_beside_each_other_write_whole_programs() {
    let place = library().file("pathbuild.toml", configuration(150));
    assert_eq!(start(&place, &["emit", "."]).wait().unwrap().code(), Some(0));
    let expected = files(&place).1;
    for round in 0..kills().div_ceil(4) {
        let count = 2 + round % 3;
        for name in expected.keys() {
            fs::remove_file(place.path().join(name)).unwrap();
        }
        let commands: [&[&str]; 4] = [&["emit", "."], &["check"], &["emit", "."], &["cache", "clean"]];
        let children = (0..count).map(|number| start(&place, commands[usize::try_from(number).unwrap()]));
        for child in children.collect::<Vec<_>>() {
            let output = child.wait_with_output().unwrap();
            assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
        }
        assert!(files(&place) == (Vec::new(), expected.clone()), "{count} runs");
    }
}
