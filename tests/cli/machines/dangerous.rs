//! Makes random dangerous changes to programs of the example library, and checks that `verify --against`, run as by users, reports each.
//! (book: program/reading)
//!
//! Programs are emitted natively and through every built-in post. Bytes, words, lines and comments are changed at random. Whether a change is
//! dangerous is decided by independent readers if available: LinuxCNC's interpreter for linuxcnc, mach3, fanuc, haas, estlcam and din, and the same
//! with GRBL's line parsing for grbl and the native program. Marlin and XpertMILL are read by our own interpreter: gcode-toolpath follows the moves
//! of Marlin, but neither its spindle nor its offsets. A change is dangerous if a cut goes elsewhere or deeper, or is made under another offset,
//! tool, length or spindle state, or if a rapid move below S0 goes elsewhere. If the reader rejects the program, nothing is cut, so the change does
//! not count.
//!
//! `PATHBUILD_DANGEROUS=10000` sets the number of changes, `PATHBUILD_DANGEROUS_SEED` the seed; undetected changes are listed by dialect.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::interpret::{Options, interpret};
use pathbuild_motion as motion;
use pathbuild_motion::{Action, Pace, Step};
use pathbuild_post::BUILT_IN;
use rayon::prelude::*;
use tempfile::NamedTempFile;

use super::changes::{ANYWHERE, BETWEEN, Dice, words};
use super::independent::oracle;
use super::say;
use crate::support::{self, Place};

/// Number of changes, unless `PATHBUILD_DANGEROUS` is set.
const CHANGES: usize = 600;

/// Number of programs verified by one process.
const AT_ONCE: usize = 100;

/// Interval at which reported changes are also read by an independent reader.
const SAMPLED: usize = 10;

/// Distance in mm above which a move is considered to go elsewhere. It exceeds the tolerance of any dialect that is written with arcs.
const ELSEWHERE: f64 = 0.01;

/// Tolerance in mm of chords that replace a helix: the post permits 0.01 mm, and the ends are rounded. A program may stay within this tolerance even
/// if one of two chords is missing.
const CHORDS: f64 = 0.0125;

/// Short paths of the library with lines, arcs, bars, helices, holes, sweeps and subpaths.
const PATHS: [&str; 6] = ["2050.1P", "2052.1P", "2056.1P", "2058.1P", "2062.1P", "2066.1P"];

/// A path with probes, whose native program is adjusted.
const PROBED: &str = "8003.1P";

const TOOLS: &str = "\n[tool.2mm]\ndiameter = 2\nnumber = 1\nspindle = 12000\n\
                     [tool.3mm]\ndiameter = 3\nnumber = 2\nspindle = 9400\n";

/// A program that a post has written.
struct Good {
    post: &'static str,
    /// Name of the path that the program is verified against.
    path: String,
    file: String,
    text: Vec<u8>,
}

/// A program after a random change.
struct Changed {
    good: usize,
    what: String,
    text: Vec<u8>,
}

/// LinuxCNC's interpreter with tools of different lengths, so that it distinguishes G43 and G49.
struct Rs274 {
    program: PathBuf,
    tools: NamedTempFile,
}

impl Rs274 {
    fn new() -> Option<Self> {
        let (program, mut tools) = (oracle::rs274()?, NamedTempFile::new().unwrap());
        writeln!(tools, "T1 P1 Z7.5 D2.0 ;a\nT2 P2 Z9.5 D3.0 ;b\nT9 P9 Z3.25 D1.0 ;c").unwrap();
        Some(Self { program, tools })
    }

    fn effects_of(&self, good: &Good) -> Vec<Effect> {
        let effects = read(self, good.post.parse().unwrap(), &good.text).unwrap_or_default();
        assert!(!effects.is_empty(), "{} is refused", good.file);
        effects
    }

    fn finds_danger(&self, good: &Good, before: &[Effect], text: &[u8]) -> bool {
        let dialect = good.post.parse().unwrap();
        read(self, dialect, text).is_some_and(|after| !is_alike(before, &after, dialect))
    }
}

fn number(variable: &str, otherwise: usize) -> usize {
    std::env::var(variable).ok().and_then(|count| count.parse().ok()).unwrap_or(otherwise)
}

#[test]
fn no_dangerous_change_passes_and_no_good_program_has_a_finding() {
    let Some(reader) = Rs274::new() else { return };
    let place = library();
    let goods = goods(&place);
    let unchanged: Vec<(usize, Vec<u8>)> =
        goods.iter().enumerate().map(|(index, good)| (index, good.text.clone())).collect();
    let reported = verify(&place, &goods, &unchanged, true);
    let clean: Vec<&str> = reported.iter().map(|index| goods[unchanged[*index].0].file.as_str()).collect();
    assert!(clean.is_empty(), "findings in {clean:?}");

    let (count, seed) = (number("PATHBUILD_DANGEROUS", CHANGES), number("PATHBUILD_DANGEROUS_SEED", 1));
    let per_program = count.div_ceil(goods.len());
    let changes: Vec<Changed> = goods
        .iter()
        .enumerate()
        .flat_map(|(index, good)| changes_of(good, index, seed, per_program))
        .collect();
    let programs: Vec<(usize, Vec<u8>)> = changes.iter().map(|it| (it.good, it.text.clone())).collect();
    let reported = verify(&place, &goods, &programs, false);

    // Readers take longer than `verify`, so they only judge unreported changes and a sample of the others.
    let before: Vec<Vec<Effect>> = goods.par_iter().map(|good| reader.effects_of(good)).collect();
    let is_judged = |index: &usize| !reported.contains(index) || index.is_multiple_of(SAMPLED);
    let judged: Vec<(usize, bool)> = (0..changes.len())
        .into_par_iter()
        .filter(is_judged)
        .map(|index| {
            let it = &changes[index];
            (index, reader.finds_danger(&goods[it.good], &before[it.good], &it.text))
        })
        .collect();
    let (sampled, unreported): (Vec<_>, Vec<_>) =
        judged.into_iter().partition(|(index, _)| reported.contains(index));
    let dangerous = sampled.iter().filter(|(_, is_dangerous)| *is_dangerous).count();
    say(&format!(
        "{} changes, seed {seed}: {} reported, of which {dangerous} of {} judged are dangerous; {} judged harmless",
        changes.len(),
        reported.len(),
        sampled.len(),
        unreported.iter().filter(|(_, is_dangerous)| !is_dangerous).count(),
    ));
    let passed: Vec<String> = unreported
        .iter()
        .filter(|(_, is_dangerous)| *is_dangerous)
        .map(|(index, _)| format!("{}: {}", goods[changes[*index].good].file, changes[*index].what))
        .collect();
    assert!(passed.is_empty(), "{} passed\n{}", passed.len(), passed.join("\n"));
    assert!(10 * dangerous >= sampled.len(), "nearly nothing that was tried is dangerous");
}

/// Changes to a program with chords instead of helices, and whether each is found. A chord may deviate from its helix as far as the post
/// permits, by 0.01 mm, and its ends may be rounded.
const OF_CHORDS: [(&str, &str, bool); 6] = [
    // The chord that remains is 0.0109 mm away from the arc.
    ("G01 X16.918 Y13.29 Z0.75\r\n", "", true),
    ("G01 X16.918 Y13.29 Z0.75", "G01 X16.624 Y13.349 Z0.625\r\nG01 X16.918 Y13.29 Z0.75", false),
    ("G01 X16.918 Y13.29 Z0.75", "G01 X16.919 Y13.29 Z0.75", false),
    ("G01 X16.918 Y13.29 Z0.75", "G01 X16.918 Y13.286 Z0.75", true),
    ("G01 X7.503 Y40.274", "G01!X7.503 Y40.274", true),
    // The program must select its layer, even if it is the first one.
    ("M06 01\r\n", "", true),
];

#[test]
fn chords_are_as_fine_as_the_post_writes_them() {
    let place = library();
    let run = place.run("emit 2062.1P --post xpertmill --out-dir out --no-cache");
    assert_eq!(run.status, Some(0), "{run}");
    let good = place.read("out/2062.1P_Milling.nc");
    for (from, to, is_found) in OF_CHORDS {
        assert!(good.contains(from), "{from}");
        fs::write(place.path().join("a.nc"), good.replacen(from, to, 1)).unwrap();
        let run = place.run("verify a.nc --against 2062.1P --dialect xpertmill --no-cache");
        assert_eq!(run.status, Some(i32::from(is_found)), "{from} -> {to}\n{run}");
    }
}

/// Changes to programs: the text that is changed, the line to insert before it, the text that takes its place, and the posts in whose programs the
/// change is found.
const PUT_IN: [(&str, &str, &str, &[&str]); 5] = [
    ("G1 X13.7", "M0", "G1 X13.7", &["grbl", "linuxcnc", "haas", "estlcam"]),
    ("G0 X10.0 Y18.0", "M0", "G0 X10.0 Y18.0", &["haas"]),
    // Without M6 the tool is selected, but not inserted; GRBL has no M6.
    ("T1 M6", "", "T1", &["linuxcnc", "estlcam"]),
    ("G1 X13.7", "", "G0.9999 X13.7", &["grbl", "linuxcnc", "haas", "estlcam"]),
    ("G1 X13.7", "G21", "G1 X13.7", &[]),
];

#[test]
fn stops_and_tools_that_are_not_inserted_are_found() {
    let place = library();
    for post in ["grbl", "linuxcnc", "haas", "estlcam"] {
        let run = place.run(&format!("emit 2052.1P --post {post} --out-dir {post} --no-cache"));
        assert_eq!(run.status, Some(0), "{run}");
        let mut all = place.path().join(post).read_dir().unwrap();
        let name = all.next().unwrap().unwrap().file_name().into_string().unwrap();
        let good = place.read(&format!("{post}/{name}"));
        for (line, before, instead, found_in) in PUT_IN {
            let changed = good.replacen(line, &format!("{before}\n{instead}"), 1);
            if changed == good {
                continue;
            }
            fs::write(place.path().join("a.nc"), changed.replace('\r', "")).unwrap();
            let run = place.run(&format!("verify a.nc --against 2052.1P --dialect {post} --no-cache"));
            let is_found = found_in.contains(&post);
            assert_eq!(run.status, Some(i32::from(is_found)), "{post}: {before} {instead}\n{run}");
        }
    }
}

/// Creates the example library, with numbered tools and spindle speeds.
fn library() -> Place {
    let place = Place::new();
    copy(&support::project().join("fixtures/library"), place.path());
    let configuration = place.path().join("pathbuild.toml");
    let text = fs::read_to_string(&configuration).unwrap();
    // Holes are written as single moves, because single moves are changed.
    let text = text.replace("cycles = true", "cycles = false");
    fs::write(configuration, format!("{text}{TOOLS}")).unwrap();
    place
}

fn copy(from: &Path, to: &Path) {
    for entry in from.read_dir().unwrap().map(Result::unwrap) {
        let target = to.join(entry.file_name());
        if entry.path().is_dir() {
            fs::create_dir_all(&target).unwrap();
            copy(&entry.path(), &target);
        } else {
            fs::copy(entry.path(), target).unwrap();
        }
    }
}

fn goods(place: &Place) -> Vec<Good> {
    let mut goods = Vec::new();
    for post in BUILT_IN.iter().map(|post| post.name) {
        let directory = format!("{post}-good");
        let native = if post == "native" { "" } else { "--post " };
        let post_option = if post == "native" { "" } else { post };
        let run = place
            .run(&format!("emit {} {native}{post_option} --out-dir {directory} --no-cache", PATHS.join(" ")));
        assert_eq!(run.status, Some(0), "{run}");
        for path in PATHS {
            let stem = format!("{path}_Milling.");
            let all = place.path().join(&directory).read_dir().unwrap();
            let names = all.map(|entry| entry.unwrap().file_name().into_string().unwrap());
            let name = names.into_iter().find(|name| name.starts_with(&stem)).unwrap();
            goods.push(good(place, post, path, &format!("{directory}/{name}")));
        }
    }
    goods.extend(probed(place));
    goods
}

/// Returns the native programs of a path with probes, measured and adjusted.
fn probed(place: &Place) -> Vec<Good> {
    let directory = "native-probed";
    let run = place.run(&format!("emit {PROBED} --out-dir {directory} --no-cache"));
    assert_eq!(run.status, Some(0), "{run}");
    let values = format!("{directory}/{PROBED}_Z.txt");
    // Nowhere higher than drawn: there, cuts down to the plate would end above it, which is a finding.
    let mut off = [-0.04, -0.02, -0.05, -0.01].into_iter().cycle();
    let measured = |line: &str| {
        let drawn = line
            .split("/T=")
            .nth(1)
            .unwrap()
            .split(|c: char| c != '.' && c != '-' && !c.is_ascii_digit())
            .next()
            .unwrap();
        format!("{line}{:.3}\n", drawn.parse::<f64>().unwrap() + off.next().unwrap())
    };
    let text: String = place.read(&values).lines().map(measured).collect();
    fs::write(place.path().join(&values), text).unwrap();
    let run = place
        .run(&format!("adjust {directory}/{PROBED}_Clean.gcode --max-correction 0.5 --out-dir {directory}"));
    assert_eq!(run.status, Some(0), "{run}");
    let names = ["Milling", "Clean"].map(|kind| format!("{directory}/{PROBED}_{kind}.gcode"));
    names.iter().map(|name| good(place, "native", PROBED, name)).collect()
}

fn good(place: &Place, post: &'static str, path: &str, file: &str) -> Good {
    let text = fs::read(place.path().join(file)).unwrap();
    Good { post, path: path.to_owned(), file: file.to_owned(), text }
}

/// Returns the indices of the programs in which `verify --against` finds an error or, if `is_strict`, anything at all.
fn verify(place: &Place, goods: &[Good], programs: &[(usize, Vec<u8>)], is_strict: bool) -> BTreeSet<usize> {
    let mut jobs: BTreeMap<(&str, &str), Vec<usize>> = BTreeMap::new();
    for (index, (good, text)) in programs.iter().enumerate() {
        let good = &goods[*good];
        fs::write(place.path().join(format!("{index}.gc")), text).unwrap();
        jobs.entry((good.post, &good.path)).or_default().push(index);
    }
    let chunks: Vec<(&str, &str, &[usize])> = jobs
        .iter()
        .flat_map(|((post, path), all)| all.chunks(AT_ONCE).map(|chunk| (*post, *path, chunk)))
        .collect();
    let reported = chunks.par_iter().flat_map_iter(|(post, path, chunk)| {
        let files: Vec<String> = chunk.iter().map(|index| format!("{index}.gc")).collect();
        let run = place.run(&format!(
            "verify {} --against {path} --dialect {post} --format concise --no-cache",
            files.join(" ")
        ));
        let of_line = |line: &str| {
            let (file, said) = line.split_once(".gc:")?;
            let is_finding = said.contains(": error[") || said.trim_start().starts_with("error[");
            // PB769: the program that is still to be adjusted.
            let is_doubt = said.contains("warning[") && !said.contains("PB769");
            (is_finding || is_strict && is_doubt).then(|| file.parse().ok()).flatten()
        };
        let both = format!("{}\n{}", run.stdout, run.stderr);
        assert!(run.status.is_some_and(|status| status < 2), "{run}");
        both.lines().filter_map(of_line).collect::<Vec<usize>>()
    });
    reported.collect()
}

/// Returns random changes of a program, without duplicates.
fn changes_of(good: &Good, index: usize, seed: usize, count: usize) -> Vec<Changed> {
    let mut dice = Dice::new((seed * 1_000_003 + index) as u64);
    let (mut found, mut tries, mut known) = (Vec::new(), 0, BTreeSet::from([good.text.clone()]));
    while found.len() < count && tries < 8 * count {
        tries += 1;
        let Some((what, text)) = change(&good.text, &mut dice) else { continue };
        if known.insert(text.clone()) {
            found.push(Changed { good: index, what, text });
        }
    }
    found
}

/// A cut with the state of the machine, or a rapid move below S0.
#[derive(Clone, Debug)]
struct Effect {
    kind: u8,
    from: [f64; 3],
    numbers: Vec<f64>,
    state: String,
}

fn is_alike(before: &[Effect], after: &[Effect], dialect: Dialect) -> bool {
    if !dialect.rules().arcs.helix {
        return are_alike_in_runs(before, after);
    }
    before.len() == after.len() && before.iter().zip(after).all(|(a, b)| is_same(a, b, ELSEWHERE))
}

fn is_same(a: &Effect, b: &Effect, slack: f64) -> bool {
    let is_near = |(a, b): (&f64, &f64)| (a - b).abs() <= slack;
    (a.kind, &a.state) == (b.kind, &b.state) && a.numbers.iter().zip(&b.numbers).all(is_near)
}

/// Whether the effects are alike in a program with chords instead of helices: each run of straight cuts stays near the line of the other one,
/// wherever the chords end.
fn are_alike_in_runs(before: &[Effect], after: &[Effect]) -> bool {
    let is_chord = |a: &Effect, b: &Effect| (a.kind, b.kind) == (1, 1) && a.state == b.state;
    let runs =
        |all: &'_ [Effect]| -> Vec<Vec<Effect>> { all.chunk_by(is_chord).map(<[_]>::to_vec).collect() };
    let (before, after) = (runs(before), runs(after));
    let keeps_near = |run: &[Effect], other: &[Effect]| {
        run.iter().all(|effect| {
            let nearest = other.iter().map(|chord| distance(effect, &chord.from, &chord.numbers));
            nearest.fold(f64::INFINITY, f64::min) <= CHORDS
        })
    };
    let is_same_run = |(one, other): (&Vec<Effect>, &Vec<Effect>)| {
        let ends_alike = one.last().zip(other.last()).is_some_and(|(a, b)| is_same(a, b, CHORDS));
        ends_alike && (one[0].kind != 1 || keeps_near(one, other) && keeps_near(other, one))
    };
    before.len() == after.len() && before.iter().zip(&after).all(is_same_run)
}

fn distance(effect: &Effect, from: &[f64], to: &[f64]) -> f64 {
    let part = |a: &[f64], axis: usize| a[axis] - from[axis];
    let dot = |a: &[f64], b: &[f64]| (0..3).map(|axis| part(a, axis) * part(b, axis)).sum::<f64>();
    let length = dot(to, to);
    let share = if length > 0.0 { (dot(&effect.numbers, to) / length).clamp(0.0, 1.0) } else { 0.0 };
    (0..3).map(|axis| (part(&effect.numbers, axis) - share * part(to, axis)).powi(2)).sum::<f64>().sqrt()
}

/// Returns the effects of a program according to the reader for its dialect; `None` if the reader rejects the program.
fn read(reader: &Rs274, dialect: Dialect, text: &[u8]) -> Option<Vec<Effect>> {
    let text = match dialect {
        Dialect::Native | Dialect::Grbl => lines_of_grbl(text),
        Dialect::LinuxCnc => text.to_vec(),
        Dialect::Mach3 | Dialect::Fanuc | Dialect::Haas | Dialect::Estlcam | Dialect::Din => {
            super::independent::common_words(str::from_utf8(text).ok()?, dialect).into_bytes()
        }
        _ => return Some(our_effects(text, dialect)),
    };
    effects_of(&oracle::output(&reader.program, reader.tools.path(), &text)?)
}

/// Preprocesses received bytes as GRBL does: lines end at CR or LF, a comment in brackets at the first `)`, one after `;` at the end of the line;
/// spaces, `/` and real-time characters are dropped, and letters are converted to upper case.
fn lines_of_grbl(text: &[u8]) -> Vec<u8> {
    let (mut lines, mut comment) = (Vec::with_capacity(text.len()), 0_u8);
    for &byte in text {
        match byte {
            b'\n' | b'\r' => {
                lines.push(b'\n');
                comment = 0;
            }
            b')' if comment == b'(' => comment = 0,
            _ if comment != 0 => {}
            b'(' | b';' => comment = byte,
            b'/' | b'%' | b'?' | b'!' | b'~' | 0..=b' ' | 128.. => {}
            _ => lines.push(byte.to_ascii_uppercase()),
        }
    }
    lines
}

/// Canonical calls of rs274 that change settings which affect cuts. Overrides and coolant are not among them.
const SETTINGS: [&str; 12] = [
    "SET_G5X_OFFSET",
    "SET_G92_OFFSET",
    "SET_XY_ROTATION",
    "USE_TOOL_LENGTH_OFFSET",
    "CHANGE_TOOL",
    "SET_SPINDLE_SPEED",
    "START_SPINDLE_CLOCKWISE",
    "START_SPINDLE_COUNTERCLOCKWISE",
    "STOP_SPINDLE_TURNING",
    "SET_MOTION_CONTROL_MODE",
    "SET_FEED_MODE",
    "SET_SPINDLE_MODE",
];

/// Returns the effects of the canonical calls in rs274's output.
fn effects_of(output: &str) -> Option<Vec<Effect>> {
    let (mut unit, mut at) = (1.0, [0.0; 3]);
    let mut settings: BTreeMap<&str, &str> = BTreeMap::new();
    let mut effects = Vec::new();
    for line in output.lines() {
        let Some((front, arguments)) = line.split_once('(') else { continue };
        let name = front.rsplit(' ').next().unwrap_or_default();
        let words: Vec<&str> = arguments.trim_end_matches(')').split(',').map(str::trim).collect();
        let numbers =
            || words.iter().map(|word| word.parse().unwrap_or(f64::NAN) * unit).collect::<Vec<f64>>();
        let turning = ["START_SPINDLE_CLOCKWISE", "START_SPINDLE_COUNTERCLOCKWISE", "STOP_SPINDLE_TURNING"];
        match name {
            "USE_LENGTH_UNITS" => unit = if words[0].ends_with("INCHES") { 25.4 } else { 1.0 },
            _ if turning.contains(&name) => {
                settings.insert("SPINDLE", if name == turning[2] { "" } else { &name[..16] });
            }
            "SET_G5X_OFFSET" | "SET_G92_OFFSET"
                if words.iter().all(|word| {
                    !word.contains(['1', '2', '3', '4', '5', '6', '7', '8', '9']) || *word == "1"
                }) =>
            {
                settings.remove(name);
            }
            // Exact corners are the default, so they are not recorded.
            "SET_MOTION_CONTROL_MODE" if is_exact(arguments) => {
                settings.remove(name);
            }
            _ if SETTINGS.contains(&name) => {
                settings.insert(SETTINGS.iter().find(|known| **known == name)?, arguments);
            }
            "STRAIGHT_TRAVERSE" => {
                let to = numbers();
                let to = [to[0], to[1], to[2]];
                let low = to[2].min(at[2]) < LOW;
                if low && !is_still(&at, &to) {
                    effects.push(Effect { kind: 0, from: at, numbers: to.to_vec(), state: String::new() });
                }
                at = to;
            }
            "STRAIGHT_FEED" | "STRAIGHT_PROBE" => {
                let to = numbers();
                let to = [to[0], to[1], to[2]];
                if !is_still(&at, &to) {
                    let (numbers, state) = (to.to_vec(), format!("{settings:?}"));
                    effects.push(Effect { kind: 1, from: at, numbers, state });
                }
                at = to;
            }
            "ARC_FEED" => {
                let all = numbers();
                effects.push(Effect {
                    kind: 2,
                    from: at,
                    numbers: [&all[..4], &all[5..6]].concat(),
                    state: format!("{} {settings:?}", words[4]),
                });
                at = [all[0], all[1], all[5]];
            }
            _ => {}
        }
    }
    Some(effects)
}

/// Whether corners are exact, or rounded by no more mm than our posts permit.
fn is_exact(arguments: &str) -> bool {
    let last = arguments.trim_end_matches(')').rsplit(' ').next().unwrap_or_default();
    let is_near = last.parse::<f64>().is_ok_and(|tolerance| tolerance > 0.0 && tolerance <= 0.01);
    arguments.starts_with("CANON_EXACT") || is_near
}

/// Height in mm below which rapid moves may hit material; it is below every S0 of the library.
const LOW: f64 = 10.0;

fn is_still(from: &[f64; 3], to: &[f64; 3]) -> bool {
    from.iter().zip(to).all(|(a, b)| (a - b).abs() < ELSEWHERE / 2.0)
}

/// Returns the effects according to our own interpreter.
fn our_effects(text: &[u8], dialect: Dialect) -> Vec<Effect> {
    let mut settings: BTreeMap<&str, String> = BTreeMap::new();
    let mut effects = Vec::new();
    for Step { action, .. } in interpret(text, dialect, &Options::default()).steps {
        match action {
            Action::Move(it) if is_still(&it.from.at, &it.to.at) && it.shape == motion::MoveShape::Line => {}
            Action::Move(it) if it.pace == Pace::Rapid && it.to.z().min(it.from.z()) >= LOW => {}
            Action::Move(it) if it.pace == Pace::Rapid => {
                let numbers = it.to.at.to_vec();
                effects.push(Effect { kind: 0, from: it.from.at, numbers, state: String::new() });
            }
            Action::Move(it) => {
                let (kind, mut numbers, mut way) = (1, it.to.at.to_vec(), String::new());
                if let motion::MoveShape::Arc(arc) = it.shape {
                    numbers.extend(arc.centre);
                    way = format!("{} {} {:?}", arc.clockwise, arc.extra_turns, arc.plane);
                }
                let state = format!("{way} {settings:?}");
                effects.push(Effect { kind, from: it.from.at, numbers, state });
            }
            Action::Spindle(spindle) => {
                settings.insert("spindle", format!("{spindle:?}"));
            }
            Action::ChangeTool(tool) => {
                settings.insert("tool", format!("{tool:?}"));
            }
            Action::System { system, .. } => {
                settings.insert("system", format!("{system:?}"));
            }
            // The speed of rapid moves does not affect the material.
            Action::Change(motion::Change::RapidFeed(_)) => {}
            Action::Change(change) => {
                settings.insert("change", format!("{change:?}"));
            }
            _ => {}
        }
    }
    effects
}

/// Bytes that a random change puts in place of another byte.
const BYTES: &[u8] = b"0123456789.-+GMXYZIJKFSTRHPLNO()[];/%#=*!:,\"' \t\r\n<>\x00\xff";

/// Text that a changed comment may hide or expose.
const HIDDEN: [&str; 4] = ["G0 Z-5", "G1 X-7 F100", "M5", "G91"];

/// Offsets by which numbers are changed.
const STEPS: [f64; 8] = [0.1, 0.25, 1.0, 7.5, -0.1, -0.3, -2.0, -12.0];

/// Returns a text with a random change, and the description of the change.
fn change(text: &[u8], dice: &mut Dice) -> Option<(String, Vec<u8>)> {
    match dice.below(8) {
        0 | 1 => Some(changed_byte(text, dice)),
        2 | 3 => changed_word(text, dice),
        4 | 5 => Some(changed_line(text, dice)),
        6 => Some(changed_comment(text, dice)),
        _ => {
            // Make two changes at once, which may hide each other.
            let (first, text) = changed_word(text, dice)?;
            let (second, text) = changed_line(&text, dice);
            Some((format!("{first}; {second}"), text))
        }
    }
}

fn changed_byte(text: &[u8], dice: &mut Dice) -> (String, Vec<u8>) {
    let (at, byte) = (dice.below(text.len()), BYTES[dice.below(BYTES.len())]);
    let mut changed = text.to_vec();
    let what = match dice.below(4) {
        0 => {
            changed.insert(at, byte);
            "put in"
        }
        1 => {
            changed.remove(at);
            "removed"
        }
        2 => {
            changed.insert(at, text[at]);
            "doubled"
        }
        _ => {
            changed[at] = byte;
            "replaced"
        }
    };
    (format!("byte {at} {what}: {}", around(&changed, at)), changed)
}

/// Returns the line that contains a byte, with special characters escaped.
fn around(text: &[u8], at: usize) -> String {
    let at = at.min(text.len().saturating_sub(1));
    let begin = text[..at].iter().rposition(|byte| *byte == b'\n').map_or(0, |at| at + 1);
    let end = text[at..].iter().position(|byte| *byte == b'\n').map_or(text.len(), |end| at + end);
    text[begin..end.max(begin)].escape_ascii().to_string()
}

fn lines(text: &[u8]) -> Vec<String> {
    String::from_utf8_lossy(text).split('\n').map(str::to_owned).collect()
}

fn joined(what: String, lines: &[String]) -> (String, Vec<u8>) {
    (what, lines.join("\n").into_bytes())
}

fn changed_word(text: &[u8], dice: &mut Dice) -> Option<(String, Vec<u8>)> {
    let mut lines = lines(text);
    let at = dice.below(lines.len());
    let was = lines[at].clone();
    let found = words(&was);
    let &(begin, end) = found.get(dice.below(found.len().max(1)))?;
    let number: f64 = was[begin + 1..end].parse().ok()?;
    let letter = &was[begin..=begin];
    let by = STEPS[dice.below(STEPS.len())];
    let other =
        ["X", "Y", "Z", "I", "J", "K", "R", "F", "S", "G", "M", "P", "H", "A", "x", "z"][dice.below(16)];
    let now = match dice.below(9) {
        0..=2 => format!("{letter}{:.3}", number + by),
        3 => String::new(),
        4 => format!("{other}{}", &was[begin + 1..end]),
        5 => format!("{}{:.3}", letter.to_lowercase(), number + by),
        6 => format!("{letter} {:+.1}", number + by),
        7 => format!("{letter}{}e1", &was[begin + 1..end]),
        _ => format!("{} {other}{:.3}", &was[begin..end], by),
    };
    lines[at].replace_range(begin..end, &now);
    let what = format!("`{was}` became `{}`", lines[at]);
    Some(joined(what, &lines))
}

fn changed_line(text: &[u8], dice: &mut Dice) -> (String, Vec<u8>) {
    let mut lines = lines(text);
    let at = dice.below(lines.len() - 1);
    let was = lines[at].clone();
    let what = match dice.below(6) {
        0 => format!("line {} removed: `{}`", at + 1, lines.remove(at)),
        1 => {
            lines.insert(at, was.clone());
            format!("line {} doubled: `{was}`", at + 1)
        }
        2 => {
            lines.swap(at, at + 1);
            format!("lines {0} and {1} swapped: `{2}`, `{was}`", at + 1, at + 2, lines[at])
        }
        3 => {
            let to = dice.below(lines.len() - 1);
            let line = lines.remove(at);
            lines.insert(to, line);
            format!("line {} moved to {}: `{was}`", at + 1, to + 1)
        }
        _ => {
            let all = if dice.below(2) == 0 { ANYWHERE } else { BETWEEN };
            let word = all[dice.below(all.len())];
            lines.insert(at, word.to_owned());
            format!("`{word}` put in as line {}", at + 1)
        }
    };
    joined(what, &lines)
}

fn changed_comment(text: &[u8], dice: &mut Dice) -> (String, Vec<u8>) {
    let mut lines = lines(text);
    let at = dice.below(lines.len() - 1);
    let was = lines[at].clone();
    let code = HIDDEN[dice.below(HIDDEN.len())];
    lines[at] = match dice.below(10) {
        0 => format!("{was} ; x\r{code}"),
        1 => format!("{was} (x\r{code}\r)"),
        2 => format!("{was} // x\r{code}"),
        3 => format!("({was})"),
        4 => format!(";{was}"),
        5 => format!("/{was}"),
        6 => format!("(x) {code} (y) {was}"),
        7 => was.replacen(')', "", 1) + code,
        8 => was.replacen('(', &format!("() {code} ("), 1),
        _ => format!("{was}\r{code}"),
    };
    let what = format!("line {}: {:?}", at + 1, lines[at]);
    joined(what, &lines)
}
