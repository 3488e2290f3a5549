//! Tests programs in the formats of other CAM programs (fixtures/programs): none has an error, and mistakes that are put into them are found.
//! (book: howto/any-program)

mod mistakes;
mod translated;

use std::collections::BTreeMap;
use std::fmt::Write;
use std::fs;

use insta::assert_snapshot;
use pathbuild_gcode::interpret::{Options, guess, interpret_each};
use pathbuild_motion::Pace;

use crate::support::{Place, project};

/// A program with facts about it that its text does not state.
struct Known {
    name: &'static str,
    /// The numbers of its tools, with their diameters in mm.
    tools: &'static [(u32, f64)],
    /// Diameter in mm for `--cutter`, if the program numbers no tools.
    cutter: Option<f64>,
    /// Height in mm of the stock's upper face.
    surface: f64,
}

const fn numbered(name: &'static str, tools: &'static [(u32, f64)]) -> Known {
    Known { name, tools, cutter: None, surface: 0.0 }
}

const fn unnumbered(name: &'static str, cutter: f64) -> Known {
    Known { name, tools: &[], cutter: Some(cutter), surface: 0.0 }
}

const TWO: &[(u32, f64)] = &[(1, 6.0), (2, 3.0)];

const PROGRAMS: &[Known] = &[
    unnumbered("bcnc.ngc", 3.175),
    numbered("cambam.nc", TWO),
    numbered("carbide-create.nc", &[(201, 6.0)]),
    numbered("dxf2gcode.ngc", TWO),
    unnumbered("easel.nc", 3.175),
    unnumbered("estlcam.nc", 6.0),
    unnumbered("flatcam-cutout.nc", 1.0),
    numbered("freecad-grbl.nc", TWO),
    numbered("freecad-linuxcnc.ngc", TWO),
    numbered("fusion-grbl.nc", TWO),
    numbered("fusion-linuxcnc.ngc", TWO),
    unnumbered("inkscape-gcodetools.ngc", 3.0),
    numbered("kiri-moto.nc", TWO),
    numbered("linuxcnc-subroutines.ngc", &[(1, 4.0)]),
    Known { surface: 3.0, ..numbered("pathbuild-grbl.gcode", &[(3, 3.0)]) },
    Known { surface: 3.0, ..numbered("pathbuild-linuxcnc.ngc", &[(3, 3.0)]) },
    numbered("pcb2gcode.ngc", &[(1, 2.0), (2, 1.0)]),
    numbered("sheetcam.ngc", TWO),
    numbered("vcarve-grbl.gcode", &[(1, 6.0)]),
    numbered("vcarve-mach3.tap", &[(1, 6.35), (2, 3.175)]),
];

impl Known {
    fn text(&self) -> String {
        fs::read_to_string(project().join("fixtures/programs").join(self.name)).unwrap()
    }

    /// Returns the configuration of a machine with these tools that can just run the program, with some margin in the plane.
    fn configuration(&self) -> String {
        let needs = Needs::of(&self.text());
        let mut text = format!(
            "[machine]\nx = [-20, 200]\ny = [-20, 150]\nz = [{}, {}]\nmaximum-feed = {}\nrates = [9999, 9999, {}]\n\
             spindle-speeds = [5000, 25000]\n",
            needs.low - 1.0,
            self.surface + 40.0,
            needs.feed * 1.5,
            needs.feed_down * 1.05,
        );
        for (number, diameter) in self.tools {
            _ = write!(
                text,
                "[tool.t{number}]\nnumber = {number}\ndiameter = {diameter}\ndirection = \"cw\"\n"
            );
        }
        text
    }

    /// Returns the options that state everything the program does not.
    fn options(&self) -> String {
        let cutter = self.cutter.map_or(String::new(), |cutter| format!(" --cutter {cutter}"));
        format!("--surface {}{cutter}", self.surface)
    }
}

/// The lowest point of a program in mm, and its greatest feeds in mm/min.
#[derive(Default)]
struct Needs {
    low: f64,
    feed: f64,
    feed_down: f64,
}

impl Needs {
    fn of(text: &str) -> Self {
        let mut needs = Self::default();
        interpret_each(text.as_bytes(), guess(text.as_bytes()).dialect, &Options::default(), &mut |step| {
            let Some((_, movement)) = step.as_move() else { return };
            let Pace::Feed(feed) = movement.pace else { return };
            needs.low = needs.low.min(movement.to.z());
            needs.feed = needs.feed.max(feed);
            needs.feed_down = needs.feed_down.max(feed * movement.axis_speed_fractions()[2]);
        });
        needs
    }
}

/// Returns for each file how often each code was found. Errors end with `!`.
fn counts(place: &Place, arguments: &str) -> BTreeMap<String, BTreeMap<String, usize>> {
    let run = place.run(&format!("verify {arguments} --no-cache --format concise"));
    let mut counts: BTreeMap<String, BTreeMap<String, usize>> = BTreeMap::new();
    for line in run.stdout.lines().chain(run.stderr.lines()) {
        let Some((file, rest)) = line.split_once(": ").filter(|(_, rest)| rest.contains("[PB")) else {
            continue;
        };
        let file = file.split(':').next().unwrap();
        let severity = if rest.starts_with("error") { "!" } else { "" };
        let code = rest.split_once('[').unwrap().1.split(']').next().unwrap();
        *counts.entry(file.into()).or_default().entry(format!("{code}{severity}")).or_default() += 1;
    }
    counts
}

fn shown(counts: Option<&BTreeMap<String, usize>>) -> String {
    let counts = counts.into_iter().flatten();
    let words: Vec<String> = counts
        .map(|(code, count)| if *count == 1 { code.clone() } else { format!("{code} x{count}") })
        .collect();
    if words.is_empty() { "-".into() } else { words.join(", ") }
}

#[test]
fn every_program_is_listed() {
    let files = fs::read_dir(project().join("fixtures/programs")).unwrap();
    let mut files: Vec<String> = files.map(|file| file.unwrap().file_name().into_string().unwrap()).collect();
    files.retain(|file| file != "README.md");
    files.sort();
    assert_eq!(files, PROGRAMS.iter().map(|known| known.name).collect::<Vec<_>>());
    let readme = fs::read_to_string(project().join("fixtures/programs/README.md")).unwrap();
    for file in files {
        assert!(readme.contains(&file), "{file} is not in the README");
    }
}

#[test]
fn no_program_has_an_error() {
    let mut table = String::new();
    for known in PROGRAMS {
        let place = Place::new().file(known.name, known.text());
        let bare = counts(&place, known.name);
        let place = place.file("pathbuild.toml", known.configuration());
        let full = counts(&place, &format!("{} {}", known.name, known.options()));
        let (bare, full) = (shown(bare.get(known.name)), shown(full.get(known.name)));
        assert!(!bare.contains('!') && !full.contains('!'), "{}: {bare} / {full}", known.name);
        _ = writeln!(table, "{:26}{bare:24}{full}", known.name);
    }
    assert_snapshot!(format!(
        "{:26}{:24}{}\n{table}",
        "program", "by itself", "with machine, tools and surface"
    ));
}
