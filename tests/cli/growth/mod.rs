//! Checks that the work grows linearly with the input: four times as much takes at most six times as long, plus a little. (docs/reliability.md)

pub mod drawings;

use std::time::Duration;

use drawings::{
    broken_insertions, chain, circular_variables, fan, fan_behind_gap, gaps, lost_texts, lost_texts_apart,
    open_commands, polyline, probed, spots, star,
};

use crate::support::{Place, Run};
use pathbuild_testkit::sheet;

type Drawing = fn(usize) -> String;

const CONFIGURATION: &str = "feed = 150\nrapid = 1000\nsweep-height = 40\nspindle = \"manual\"\n";

#[test]
fn work_grows_with_what_is_drawn() {
    for (name, drawing, count) in [
        ("a fan of lines", fan as Drawing, 1000),
        ("a star with turn markers", star, 500),
        ("a long chain", chain, 1000),
        ("a chain with gaps", gaps, 500),
        ("a chain with gaps to and fro between two spots", spots, 1000),
        ("lines on each other behind a gap", fan_behind_gap, 1000),
        ("a polyline", polyline, 1000),
    ] {
        let place = |count| drawn("join-tolerance = 0.01\n", &drawing(count));
        for run in of_one_and_four(name, count, place, "emit 1202.1P.dxf --format concise") {
            assert_eq!(run.status, Some(0), "{name}: {run}");
        }
    }
}

/// Each element has a problem, so that the output grows as well.
#[test]
fn work_grows_with_what_is_wrong() {
    for (name, drawing, count) in [
        ("lost texts before layers with an element for each", lost_texts as Drawing, 300),
        ("lost texts before layers with an element for one", lost_texts_apart, 300),
        ("broken insertions of a block on many layers", broken_insertions, 150),
        ("variables that lead back to themselves", circular_variables, 300),
        ("commands that do not end", open_commands, 5000),
    ] {
        let place = |count| drawn("[limits]\ntext-length = 1_000_000\n", &drawing(count));
        let runs = of_one_and_four(name, count, place, "check 1202.1P.dxf --format concise");
        let [few, many] = runs.map(|run| {
            assert!(matches!(run.status, Some(0 | 1)), "{name}: {run}");
            run.stdout.len() + run.stderr.len()
        });
        assert!(many < 6 * few + 10_000, "{name}: {few}, {many}");
    }
}

/// Programs record each tool and each feed once.
#[test]
fn work_grows_with_what_a_program_uses() {
    let tool = |number: usize| format!("T{0} M6\nG0 X{0}\nG1 Z9 F100\nG0 Z10\n", number + 1);
    let feed = |number: usize| format!("G1 X{number} F{}\n", number + 1);
    for (name, kind) in [("tools", &tool as &dyn Fn(usize) -> String), ("feeds", &feed)] {
        let place = |count| {
            let head = "G17 G21 G40 G49 G54 G80 G90 G94\nT1 M6\nM3 S1000\nG0 Z10\n";
            let lines: String = (0..count).map(kind).collect();
            Place::new().file("a.gcode", format!("{head}{lines}M30\n"))
        };
        for run in of_one_and_four(name, 2000, place, "import a.gcode --dialect linuxcnc") {
            assert!(!run.stdout.is_empty(), "{name}: {run}");
        }
    }
}

/// Each move searches for probes in its neighbourhood.
#[test]
fn work_grows_with_the_probes() {
    for model in ["idw4", "tin"] {
        let place = |count| drawn(&format!("z-model = \"{model}\"\n"), &probed(count));
        for run in of_one_and_four(model, 1000, place, "emit 1202.1P.dxf") {
            assert!(run.stderr.contains("_Probing.gcode: written"), "{model}: {run}");
        }
    }
}

/// The output of a post is read back and compared with the program.
#[test]
fn work_grows_with_what_a_post_writes() {
    let way = |index: usize| format!("G0 X{} Y{}\nG0 Z1\n", index % 1000, index / 1000);
    let turn = |_| "G2 X0 Y0 Z1 I5 J0 P5\nG0 Z4\n".to_owned();
    let ways = |count: usize| (0..count).map(way).collect::<String>();
    let turns = |count: usize| "G1 Z4 F100\n".to_owned() + &(0..count).map(turn).collect::<String>();
    let holes = |count: usize| format!("G91\nG81 X1 Y0 Z-1 R1 F100 L{count}\nG80\nG90\n");
    for (name, body, post, count) in [
        ("rapids between two cuts", &ways as &dyn Fn(usize) -> String, "grbl", 2000),
        ("rapids between two cuts", &ways, "xpertmill", 2000),
        ("holes of one line", &holes, "grbl", 4000),
        ("arcs that a job cannot say", &turns, "grbl", 2000),
    ] {
        let place = |count| {
            let head = "G17 G21 G40 G49 G54 G80 G90 G94\nT1 M6\nM3 S1000\nG0 Z10\nG0 X0 Y0\n";
            Place::new().file("a.gcode", format!("{head}{}G0 Z20\nM5\nM30\n", body(count)))
        };
        let arguments =
            format!("post a.gcode --post {post} -o b.gcode --surface 5 --dialect linuxcnc --format concise");
        for run in of_one_and_four(name, count, place, &arguments) {
            assert!(matches!(run.status, Some(0 | 1)), "{name}: {run}");
        }
    }
}

/// Definitions contain many macros, elements and mistakes. At most 100 mistakes are reported.
#[test]
fn work_grows_with_what_a_definition_holds() {
    type Definition<'d> = &'d dyn Fn(usize) -> String;
    let cambam = |macros: String| {
        format!("<PostProcessor><PostProcessorMacros>\n{macros}</PostProcessorMacros></PostProcessor>")
    };
    let texts = |line: String| format!("[text]\nline='''\n{line}'''\n");
    let lines = |line: &dyn Fn(usize) -> String, count| (0..count).map(line).collect::<String>();
    for (name, file, count, definition) in [
        (
            "macros",
            "a.cbpp",
            4000,
            &(|count| cambam(lines(&|n| format!("$m{n}=x\n"), count))) as Definition<'_>,
        ),
        ("macros in macros", "a.cbpp", 2500, &|count| {
            cambam(lines(&|n| format!("$m{n}={{$m{}}}\n", n + 1), count))
        }),
        ("unknown macros", "a.cbpp", 2500, &|count| cambam(lines(&|n| format!("$m{n}={{$n{n}}}\n"), count))),
        ("lines that are no macros", "a.cbpp", 4000, &|count| cambam(lines(&|n| format!("m{n}=x\n"), count))),
        ("repeated elements", "a.cbpp", 500, &|count| {
            format!("<PostProcessor>{}</PostProcessor>", lines(&|n| format!("<MOP>\n{n}</MOP>\n"), count))
        }),
        ("keys", "a.toml", 4000, &|count| format!("[text]\n{}", lines(&|n| format!("k{n}=\"x\"\n"), count))),
        ("numbers without a format", "a.toml", 4000, &|count| texts("~X1~\n".repeat(count))),
        ("variables that are assigned", "a.toml", 1500, &|count| {
            texts(lines(&|n| format!("{{=a{n} {{\"1\"}}}}~b{n}~\n"), count))
        }),
    ] {
        let place = |count| {
            let place = drawn(&format!("post = \"{file}\"\n"), &polyline(2));
            place.file(file, definition(count))
        };
        for run in of_one_and_four(name, count, place, "emit 1202.1P.dxf --untrusted --format concise") {
            assert!(matches!(run.status, Some(0 | 1)), "{name}: {run}");
            assert!(run.stdout.lines().count() <= 110, "{name}: {run}");
        }
    }
}

/// The output indents a chain of embeddings only up to a limit.
#[test]
fn what_is_said_grows_with_how_deep_paths_are_embedded() {
    let size = |count: usize| {
        let place = (0..count).fold(Place::new(), |place, index| {
            let element = match index {
                0 => "mill 0,0 40,0".to_owned(),
                _ => format!("subpath 0,0 40,0 \">{}.1P\"", 1000 + index - 1),
            };
            let name = format!("{}.1P", 1000 + index);
            let drawn = format!("layer {name}\nstart 0,0 \"T5 O2 I1 B0 MX\"\n{element}\nend 40,0\n");
            place.file(&format!("{name}.dxf"), sheet(&drawn).unwrap().to_dxf())
        });
        let run = place.run("rdeps 1000.1P");
        assert_eq!(run.stdout.lines().count(), count, "{run}");
        run.stdout.len()
    };
    let (few, many) = (size(150), size(600));
    assert!(many < 6 * few, "{few}, {many}");
}

fn drawn(settings: &str, drawing: &str) -> Place {
    Place::new().file("pathbuild.toml", format!("{CONFIGURATION}{settings}")).file("1202.1P.dxf", drawing)
}

/// Runs a command on one amount and on four times as much, and asserts that the second run does not take too long in comparison.
#[track_caller]
fn of_one_and_four(name: &str, count: usize, place: impl Fn(usize) -> Place, arguments: &str) -> [Run; 2] {
    // Take the faster of two runs, because other processes slow the machine down.
    let better = |count: usize| {
        let [one, other] = [(); 2].map(|()| place(count).run_timed(arguments));
        if one.1 < other.1 { one } else { other }
    };
    let ((few, one), (many, four)) = (better(count), better(4 * count));
    assert!(four < one * 6 + Duration::from_millis(500), "{name}: {one:?}, {four:?}");
    [few, many]
}
