//! Compares our reader with independent ones: LinuxCNC's interpreter and gcode-toolpath.
//!
//! There is no known reader for XpertMILL, for DIN 66025 or for Estlcam's controller. All words that our posts write for DIN 66025 and for Estlcam's
//! controller are words of RS274, except for the units and the title of DIN 66025: rs274 reads their programs with these words replaced.

#[path = "../../../crates/pathbuild-gcode/tests/common/oracle.rs"]
pub(super) mod oracle;

use std::path::{Path, PathBuf};
use std::process::Command;

use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::interpret::{Options, interpret};
use pathbuild_motion as motion;
use pathbuild_motion::{Axes, Move, Pace};
use pathbuild_post::load;
use rayon::prelude::*;

use super::changes::words;
use super::programs::{Named, programs};
use super::{say, shown, texts, written};

/// Posts whose programs rs274 can read, with their dialects. The program number and the return to home are removed, because rs274 does not know
/// them.
const OF_RS274: [(&str, Dialect); 7] = [
    ("linuxcnc", Dialect::LinuxCnc),
    ("grbl", Dialect::Grbl),
    ("mach3", Dialect::Mach3),
    ("fanuc", Dialect::Fanuc),
    ("haas", Dialect::Haas),
    ("estlcam", Dialect::Estlcam),
    ("din", Dialect::Din),
];

/// Number of programs that one process of rs274 reads.
const PROGRAMS_PER_START: usize = 60;

#[test]
fn linuxcnc_reads_the_posts_as_we_do() {
    let Some(rs274) = oracle::rs274() else { return };
    let programs = programs();
    for (post, dialect) in OF_RS274 {
        let faults_of = |programs: &[Named]| {
            let ours: Vec<String> = programs.iter().map(|it| without_way_up(&text_of(post, it))).collect();
            let theirs: Vec<String> = ours.iter().map(|ours| common_words(ours, dialect)).collect();
            let read = oracle::ask_all(&rs274, &theirs);
            let compare = |((it, ours), read): ((&Named, &String), &oracle::Oracle)| {
                let difference = oracle::difference_from(read, ours, dialect);
                difference.map(|difference| format!("{}: {difference}", it.name))
            };
            programs.iter().zip(&ours).zip(&read).filter_map(compare).collect::<Vec<_>>()
        };
        let faults: Vec<String> = programs.par_chunks(PROGRAMS_PER_START).flat_map_iter(faults_of).collect();
        assert!(faults.is_empty(), "{post}: {} of {}\n{}", faults.len(), programs.len(), shown(&faults));
    }
    say(&format!("{} programs of {} posts through rs274", programs.len(), OF_RS274.len()));
}

#[test]
fn gcode_toolpath_reads_the_posts_as_we_do() {
    let Some(modules) = toolpath() else { return };
    let programs = programs();
    for (post, dialect) in [("grbl", Dialect::Grbl), ("marlin", Dialect::Marlin)] {
        let directory = tempfile::tempdir().unwrap();
        let files: Vec<PathBuf> =
            (0..programs.len()).map(|index| directory.path().join(index.to_string())).collect();
        for (file, it) in files.iter().zip(programs) {
            std::fs::write(file, text_of(post, it)).unwrap();
        }
        let read = ask(&modules, &files);
        assert_eq!(read.len(), programs.len(), "{post}");
        let fault = |(it, theirs): (&Named, &Vec<Vec<f64>>)| {
            let ours = our_moves(&text_of(post, it), dialect);
            differ(theirs, &ours).map(|difference| format!("{}: {difference}", it.name))
        };
        let faults: Vec<String> = programs.par_iter().zip(&read).filter_map(fault).collect();
        assert!(faults.is_empty(), "{post}: {} of {}\n{}", faults.len(), programs.len(), shown(&faults));
    }
    say(&format!("{} programs of 2 posts through gcode-toolpath", programs.len()));
}

fn text_of(post: &str, it: &Named) -> String {
    let definition = load(post).unwrap();
    let text = written(&definition, &it.program).unwrap_or_else(|errors| panic!("{}", texts(&errors)));
    String::from_utf8(text).unwrap()
}

/// Returns a program as rs274 can read it: without its number or title, and without the retract to the machine's zero, because rs274 does
/// not know its position.
pub(super) fn common_words(text: &str, dialect: Dialect) -> String {
    let text = without_way_up(text);
    if dialect != Dialect::Din {
        return text;
    }
    let is_title = |line: &&str| {
        line.trim_start_matches(|c: char| c == 'N' || c.is_ascii_digit() || c == ' ').starts_with('%')
    };
    let line = |line: &str| line.replace("G71", "G21").replace("G70", "G20") + "\n";
    text.lines().filter(|line| !is_title(line)).map(line).collect()
}

fn without_way_up(text: &str) -> String {
    let is_own = |line: &&str| line.starts_with('O') || is_way_up(line);
    text.lines().filter(|line| !is_own(line)).flat_map(|line| [line, "\n"]).collect()
}

/// Whether a line only retracts the tool to a position of the machine. M0 and M1 in the line are ignored, because stopping there changes
/// nothing.
fn is_way_up(line: &str) -> bool {
    let mut found: Vec<(u8, f64)> = words(line)
        .into_iter()
        .filter_map(|(begin, end)| Some((line.as_bytes()[begin], line[begin + 1..end].parse().ok()?)))
        .collect();
    found.retain(|word| !matches!(*word, (b'M', 0.0 | 1.0)));
    found.sort_by(|a, b| a.partial_cmp(b).expect("numbers"));
    let ways: [&[(u8, f64)]; 4] = [
        &[(b'G', 0.0), (b'G', 53.0), (b'Z', 0.0)],
        &[(b'G', 53.0), (b'Z', 0.0)],
        &[(b'G', 28.0), (b'G', 91.0), (b'Z', 0.0)],
        &[(b'G', 28.0), (b'G', 91.0)],
    ];
    ways.contains(&found.as_slice())
}

/// Returns the directory in which gcode-toolpath is installed.
#[expect(clippy::disallowed_methods, reason = "tests ask the environment where their oracles are")]
fn toolpath() -> Option<PathBuf> {
    let Ok(directory) = std::env::var("PATHBUILD_TOOLPATH") else {
        pathbuild_testkit::skip("toolpath", "PATHBUILD_TOOLPATH is not set (npm install gcode-toolpath)");
        return None;
    };
    let modules = Path::new(&directory).join("node_modules");
    assert!(modules.is_dir(), "{} is missing", modules.display());
    Some(modules)
}

/// Returns the moves of each program according to gcode-toolpath: the motion code 0, 1 or 2, the end point, and for arcs the centre.
fn ask(modules: &Path, files: &[PathBuf]) -> Vec<Vec<Vec<f64>>> {
    let script = crate::support::project().join("tests/tools/toolpath.js");
    let output =
        Command::new("node").arg(script).args(files).env("NODE_PATH", modules).output().expect("node runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).unwrap();
    let numbers = |line: &str| line.split(' ').map(|number| number.parse().unwrap()).collect();
    text.trim_end().split("\n\n").map(|program| program.lines().map(numbers).collect()).collect()
}

fn our_moves(text: &str, dialect: Dialect) -> Vec<Vec<f64>> {
    let read = interpret(text.as_bytes(), dialect, &Options::default());
    let numbers = |it: &Move| {
        let code = match (it.pace, it.shape) {
            (Pace::Rapid, _) => 0.0,
            (_, motion::MoveShape::Line) => 1.0,
            (_, motion::MoveShape::Arc(arc)) => return arc_of(it, arc),
        };
        [vec![code], it.to.at.to_vec()].concat()
    };
    read.moves().iter().map(|(_, it)| numbers(it)).collect()
}

fn arc_of(it: &Move, arc: motion::Arc) -> Vec<f64> {
    assert_eq!(it.from.known, Axes::ALL);
    let code = if arc.clockwise { 2.0 } else { 3.0 };
    [vec![code], it.to.at.to_vec(), arc.centre.to_vec()].concat()
}

/// Returns the first move in which two programs differ by more than accumulated rounding.
fn differ(theirs: &[Vec<f64>], ours: &[Vec<f64>]) -> Option<String> {
    let is_same =
        |a: &[f64], b: &[f64]| a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6);
    let parted = theirs.iter().zip(ours).find(|(theirs, ours)| !is_same(theirs, ours));
    match parted {
        Some((theirs, ours)) => Some(format!("gcode-toolpath {theirs:?}, ours {ours:?}")),
        None if theirs.len() != ours.len() => Some(format!("{} moves, ours {}", theirs.len(), ours.len())),
        None => ours.is_empty().then(|| "it has no moves".to_owned()),
    }
}
