//! `[limits]` of programs: each with an input just inside and one just outside, and shapes that would come to gigabytes.
//! (docs/reliability.md)

use std::fs;
use std::sync::LazyLock;
use std::time::{Duration, Instant};

use crate::support::{Place, Run};
use pathbuild_testkit::sheet;

const CONFIGURATION: &str = "feed = 150\nrapid = 1000\nsweep-height = 20\nspindle = \"manual\"\n";

/// A control text, and a definition of CamBam's language: each writes its own native moves.
const CAMBAM: &str = "m.cbpp";

fn place(limits: &str, parameters: &str) -> Place {
    let drawn = format!("layer 1202.1P\nstart 0,0 \"{parameters}\"\nmill 0,0 40,0\nend 40,0");
    let post = "<PostProcessor><PostFile>{$mops}</PostFile><MOP>{$blocks}</MOP><Rapid>{$_g0} {$_x} {$_y} {$_z}</Rapid>\
        <FeedMove>{$_g1} {$_f} {$_x} {$_y} {$_z}</FeedMove></PostProcessor>";
    Place::new()
        .file("pathbuild.toml", format!("{CONFIGURATION}[limits]\n{limits}\n"))
        .file("1202.1P.dxf", sheet(&drawn).unwrap().to_dxf())
        .file(CAMBAM, post)
}

fn programs(place: &Place) -> Vec<u64> {
    let files = fs::read_dir(place.path()).unwrap().map(|entry| entry.unwrap());
    let programs = files.filter(|file| file.file_name().to_string_lossy().contains("_Milling"));
    programs.map(|file| file.metadata().unwrap().len()).collect()
}

#[track_caller]
fn assert_exceeds(run: &Run, key: &str) {
    assert_eq!(run.status, Some(1), "{run}");
    assert!(run.stderr.contains("PB005") && run.stderr.contains(&format!("`{key}`")), "{run}");
}

/// What takes so much passes with that limit, and exceeds one that is less by one: then nothing is written.
#[track_caller]
fn assert_limited(key: &str, most: u64, parameters: &str, commands: &[&str]) {
    for command in commands {
        let inside = place(&format!("{key} = {most}"), parameters);
        let run = inside.run(command);
        assert_eq!(run.status, Some(0), "{run}");
        assert_eq!(programs(&inside).len(), usize::from(command.starts_with("emit")), "{run}");
        let outside = place(&format!("{key} = {}", most - 1), parameters);
        assert_exceeds(&outside.run(command), key);
        assert_eq!(programs(&outside), [0; 0]);
    }
}

#[test]
fn the_memory_of_a_program_is_limited() {
    let parameters = "T5 O2 I0.01 B0 MX";
    let asked = place("program-memory = 1", parameters).run("check 1202.1P.dxf --no-cache");
    assert_exceeds(&asked, "program-memory");
    let (_, rest) = asked.stderr.split_once("about ").unwrap();
    let size = rest.split(' ').next().unwrap().parse().unwrap();
    let commands = ["check 1202.1P.dxf", "emit 1202.1P.dxf", "emit 1202.1P.dxf --post linuxcnc"];
    assert_limited("program-memory", size, parameters, &commands);
}

#[test]
fn what_is_written_is_limited() {
    let control_text = format!("--post ./{CAMBAM} --dialect linuxcnc");
    for options in ["", "--post linuxcnc", "--post xpertmill", &control_text] {
        let command = format!("emit 1202.1P.dxf {options}");
        let parameters = "T5 O2 I0.1 B0 MX";
        let whole = place("", parameters);
        let run = whole.run(&command);
        assert_eq!(run.status, Some(0), "{run}");
        let [size] = programs(&whole)[..] else { panic!("{run}") };
        let inside = place(&format!("output-size = {size}"), parameters);
        let run = inside.run(&command);
        assert_eq!((run.status, programs(&inside)), (Some(0), vec![size]), "{run}");
        let outside = place(&format!("output-size = {}", size - 1), parameters);
        assert_exceeds(&outside.run(&command), "output-size");
        assert_eq!(programs(&outside), [0; 0]);
    }
}

/// Counted before they are made.
#[test]
fn the_moves_of_a_program_are_limited() {
    let parameters = "T5 O2 I1 B0 MX";
    let asked = place("embedding-moves = 1", parameters).run("check 1202.1P.dxf --no-cache");
    assert_exceeds(&asked, "embedding-moves");
    let (before, _) = asked.stderr.split_once(" moves").unwrap();
    let count = before.rsplit(' ').next().unwrap().parse().unwrap();
    assert_limited("embedding-moves", count, parameters, &["check 1202.1P.dxf", "emit 1202.1P.dxf"]);
}

/// Some hundred bytes of drawing each: whoever checks or emits them hears of it at once.
#[test]
fn few_bytes_do_not_become_gigabytes() {
    for parameters in ["T5 O2 I1 B-10000000 MX", "T5 O2 I0.0000001 B0 MX", "T5 O2 I0.0000001 B0 W4 MX"] {
        for command in [
            "check 1202.1P.dxf",
            "emit 1202.1P.dxf",
            "emit 1202.1P.dxf --post grbl",
            "view 1202.1P.dxf -o v.svg",
        ] {
            let place = place("", parameters);
            let begun = Instant::now();
            let run = place.run(command);
            assert_exceeds(
                &run,
                if run.stderr.contains("memory") { "program-memory" } else { "embedding-moves" },
            );
            assert!(begun.elapsed() < Duration::from_secs(20), "{parameters} {command}");
            assert_eq!(programs(&place), [0; 0]);
        }
    }
}

/// A comment that every pass repeats.
#[test]
fn a_comment_does_not_fill_the_disk() {
    let drawn = format!(
        "layer 1202.1P\nstart 0,0 \"T5 O2 I0.05 B0 MX\"\nmill 0,0 40,0 \"Q{}\"\nend 40,0",
        "x".repeat(20_000)
    );
    let drawing = sheet(&drawn).unwrap().to_dxf();
    for command in ["emit 1202.1P.dxf", "emit 1202.1P.dxf --post linuxcnc", "view 1202.1P.dxf -o v.svg"] {
        let place = place("output-size = \"1 MiB\"", "T5 O2 I1 B0 MX").file("1202.1P.dxf", &drawing);
        assert_exceeds(&place.run(command), "output-size");
        assert_eq!(programs(&place), [0; 0]);
    }
}

/// A thousand faults of one text do not keep it a thousand times.
#[test]
fn faults_of_a_long_text_take_no_square_of_it() {
    let words = "X ".repeat(20_000);
    let drawing = format!(
        "0\nSECTION\n2\nENTITIES\n0\nCIRCLE\n8\n1202.1P\n6\nPHANTOM\n10\n0\n20\n0\n40\n0.5\n\
         0\nTEXT\n8\n1202.1P\n10\n0\n20\n0\n40\n1\n1\nT5 O2 {words}\n0\nENDSEC\n0\nEOF\n"
    );
    let place = Place::new().file("1202.1P.dxf", drawing);
    let begun = Instant::now();
    let run = place.run("check 1202.1P.dxf --format json");
    assert_eq!(run.status, Some(1), "{run}");
    assert!(begun.elapsed() < Duration::from_secs(30), "{:?}", begun.elapsed());
    assert!(run.stdout.lines().all(|line| line.len() < 20_000));
}

/// `entities`: what is looked at in blocks, 16 of them for each entity. Here 40 blocks, each inserted in the next and, outermost first, by
/// itself: to find what they come to, and to put it in its place, is to look at 40 + 39 + ... + 1 insertions, twice.
#[test]
fn what_is_looked_at_in_blocks_is_limited() {
    const DEPTH: usize = 40;
    let steps = DEPTH * (DEPTH + 1);
    let insert = |block: usize| format!("0\nINSERT\n8\n1202.1P\n2\nB{block}\n10\n0\n20\n0\n");
    let block = |number: usize| {
        let inside = number.checked_sub(1).map_or_else(|| line((0.0, 0.0), (40.0, 0.0)), insert);
        format!("0\nBLOCK\n8\n0\n2\nB{number}\n10\n0\n20\n0\n{inside}0\nENDBLK\n")
    };
    let blocks: String = (0..DEPTH).map(block).collect();
    let inserted: String = (0..DEPTH).rev().map(insert).collect();
    let drawing = format!("0\nSECTION\n2\nBLOCKS\n{blocks}0\nENDSEC\n{}", entities(&inserted, (40.0, 0.0)));
    let check = |most: usize| {
        let limits = format!("entities = {most}");
        place(&limits, "T5 O2 I1 B0 MX").file("1202.1P.dxf", &drawing).run("check 1202.1P.dxf")
    };
    let most = steps.div_ceil(16);
    assert!(!check(most).stderr.contains("PB005"), "{}", check(most));
    assert_exceeds(&check(most - 1), "entities");
}

/// `verify-pieces`: what arcs and slopes are cut into.
#[test]
fn arcs_that_are_followed_are_limited() {
    let circles = "G2 X0 Y0 I50 J0\n".repeat(4);
    let program = format!("G17 G21 G90\nF500\nG0 Z20\nG0 X0 Y0\nG1 Z-1\n{circles}G0 Z20\nM30\n");
    let verify = |most: u64| {
        let place = Place::new()
            .file("pathbuild.toml", format!("[limits]\nverify-pieces = {most}\n"))
            .file("a.gcode", &program);
        place.run("verify a.gcode --cutter 2 --surface 0 --dialect linuxcnc")
    };
    let asked = verify(1);
    assert_exceeds(&asked, "verify-pieces");
    let (_, rest) = asked.stderr.split_once("cut into ").unwrap();
    let count: u64 = rest.split(' ').next().unwrap().parse().unwrap();
    assert!(!verify(count).stderr.contains("PB005"), "{}", verify(count));
    assert_exceeds(&verify(count - 1), "verify-pieces");
}

/// What grows with the input: four times as much takes at most five times as long, and a little more.
#[test]
fn work_grows_with_what_is_drawn() {
    for (name, kind, count) in [
        ("a fan of lines", fan as fn(usize) -> String, 1000),
        ("a star with turn markers", star, 500),
        ("a long chain", chain, 1000),
        ("a chain with gaps", gaps, 500),
        ("a chain with gaps to and fro between two spots", spots, 1000),
        ("lines on each other behind a gap", fan_behind_gap, 1000),
        ("a polyline", polyline, 1000),
    ] {
        let time = |count: usize| {
            let place = place("", "T5 O2 I1 B0 MX")
                .file("pathbuild.toml", format!("join-tolerance = 0.01\n{CONFIGURATION}"))
                .file("1202.1P.dxf", kind(count));
            let begun = time_of_runs();
            let run = place.run("emit 1202.1P.dxf --format concise");
            assert_eq!(run.status, Some(0), "{name}: {run}");
            time_of_runs().saturating_sub(begun)
        };
        // The better of two: other work on the machine is no part of it.
        let least = |count: usize| time(count).min(time(count));
        let (one, four) = (least(count), least(4 * count));
        assert!(four < one * 6 + Duration::from_millis(500), "{name}: {one:?}, {four:?}");
    }
}

/// The same where something is wrong with each thing.
#[test]
fn work_grows_with_what_is_wrong() {
    for (name, kind, count) in [
        ("lost texts before layers with an element for each", lost_texts as fn(usize) -> String, 300),
        ("lost texts before layers with an element for one", lost_texts_apart, 300),
        ("broken insertions of a block on many layers", broken_insertions, 150),
        ("variables that lead back to themselves", circular_variables, 300),
        ("commands that do not end", open_commands, 5000),
    ] {
        let check = |count: usize| {
            let place = place("text-length = 1_000_000", "T5 O2 I1 B0 MX").file("1202.1P.dxf", kind(count));
            let begun = time_of_runs();
            let run = place.run("check 1202.1P.dxf --format concise");
            assert!(matches!(run.status, Some(0 | 1)), "{name}: {run}");
            (time_of_runs().saturating_sub(begun), run.stdout.len() + run.stderr.len())
        };
        let least = |count: usize| check(count).min(check(count));
        let ((one, few), (four, many)) = (least(count), least(4 * count));
        assert!(four < one * 6 + Duration::from_millis(500), "{name}: {one:?}, {four:?}");
        assert!(many < 6 * few + 10_000, "{name}: {few}, {many}");
    }
}

/// The same with programs: tools and feeds are noted once each.
#[test]
fn work_grows_with_what_a_program_uses() {
    let tool = |number: usize| format!("T{0} M6\nG0 X{0}\nG1 Z9 F100\nG0 Z10\n", number + 1);
    let feed = |number: usize| format!("G1 X{number} F{}\n", number + 1);
    for (name, kind) in [("tools", &tool as &dyn Fn(usize) -> String), ("feeds", &feed)] {
        let time = |count: usize| {
            let head = "G17 G21 G40 G49 G54 G80 G90 G94\nT1 M6\nM3 S1000\nG0 Z10\n";
            let lines: String = (0..count).map(kind).collect();
            let place = Place::new().file("a.gcode", format!("{head}{lines}M30\n"));
            let begun = time_of_runs();
            let run = place.run("import a.gcode --dialect linuxcnc");
            assert!(!run.stdout.is_empty(), "{name}: {run}");
            time_of_runs().saturating_sub(begun)
        };
        let least = |count: usize| time(count).min(time(count));
        let (one, four) = (least(2000), least(8000));
        assert!(four < one * 6 + Duration::from_millis(500), "{name}: {one:?}, {four:?}");
    }
}

/// The same with probes: each move asks for those that are near.
#[test]
fn work_grows_with_the_probes() {
    for model in ["idw4", "tin"] {
        let settings = format!("feed = 150\nrapid = 1000\nsweep-height = 40\nz-model = \"{model}\"\n");
        let time = |count: usize| {
            let place = Place::new().file("pathbuild.toml", &settings).file("1202.1P.dxf", probed(count));
            let begun = time_of_runs();
            let run = place.run("emit 1202.1P.dxf");
            assert!(run.stderr.contains("_Probing.gcode: written"), "{model}: {run}");
            time_of_runs().saturating_sub(begun)
        };
        let least = |count: usize| time(count).min(time(count));
        let (one, four) = (least(1000), least(4000));
        assert!(four < one * 6 + Duration::from_millis(500), "{model}: {one:?}, {four:?}");
    }
}

/// What the runs so far took of the processors: other work on the machine is no part of it. Where the system does not tell, what time it is.
fn time_of_runs() -> Duration {
    static BEGUN: LazyLock<Instant> = LazyLock::new(Instant::now);
    // The 14th and 15th number behind the name: hundredths of a second that ended children took, for themselves and in the system.
    let of_children = |stat: String| {
        let (_, numbers) = stat.rsplit_once(')')?;
        let mut numbers = numbers.split_whitespace().skip(13).map_while(|number| number.parse::<u64>().ok());
        Some(Duration::from_millis(10 * (numbers.next()? + numbers.next()?)))
    };
    fs::read_to_string("/proc/self/stat").ok().and_then(of_children).unwrap_or_else(|| BEGUN.elapsed())
}

fn entities(drawn: &str, end: (f64, f64)) -> String {
    format!(
        "0\nSECTION\n2\nENTITIES\n{}{}0\nTEXT\n8\n1202.1P\n10\n0\n20\n0\n40\n1\n1\nT5 O2 I5 B0 MX\n{drawn}0\nENDSEC\n0\nEOF\n",
        circle((0.0, 0.0), 0.5),
        circle(end, 1.0),
    )
}

fn circle((x, y): (f64, f64), radius: f64) -> String {
    format!("0\nCIRCLE\n8\n1202.1P\n6\nPHANTOM\n10\n{x}\n20\n{y}\n40\n{radius}\n")
}

fn line((x, y): (f64, f64), (u, v): (f64, f64)) -> String {
    format!("0\nLINE\n8\n1202.1P\n6\nCONTINUOUS\n10\n{x}\n20\n{y}\n11\n{u}\n21\n{v}\n")
}

fn at(index: usize) -> (f64, f64) {
    let index = u32::try_from(index).unwrap();
    (f64::from(index) * 0.25, f64::from(index % 2) * 3.0)
}

/// Lines from one point to one other.
fn fan(count: usize) -> String {
    entities(&line((0.0, 0.0), (10.0, 0.0)).repeat(count + 1), (10.0, 0.0))
}

/// Lines of one point, with a turn marker at each tip.
fn star(count: usize) -> String {
    let spoke = |index: usize| {
        let angle = 6.0 * f64::from(u32::try_from(index).unwrap()) / f64::from(u32::try_from(count).unwrap());
        let tip = (50.0 * angle.cos(), 50.0 * angle.sin());
        line((0.0, 0.0), tip) + &circle(tip, 0.75)
    };
    let spokes: String = (0..count).map(spoke).collect();
    entities(&(spokes + &line((0.0, 0.0), (100.0, 0.0))), (100.0, 0.0))
}

fn chain(count: usize) -> String {
    entities(&(0..count).map(|index| line(at(index), at(index + 1))).collect::<String>(), at(count))
}

/// A chain, half of it among as many probes, in rows of 20.
fn probed(count: usize) -> String {
    let place = |index: usize| {
        let [row, place] = [index / 20, index % 20].map(|it| 8.0 * f64::from(u32::try_from(it).unwrap()));
        circle((row, 4.25 + place), 3.0)
    };
    let probes: String = (0..count).map(place).collect();
    let lines: String = (0..count).map(|index| line(at(index), at(index + 1))).collect();
    entities(&(probes + &lines), at(count))
}

/// Ends that do not quite meet.
fn gaps(count: usize) -> String {
    let with_gap = |index: usize| {
        let ((x, y), to) = (at(index), at(index + 1));
        line((x + 0.004, y), to)
    };
    entities(&(0..count).map(with_gap).collect::<String>(), at(count))
}

/// Ends within a hundredth of a mm, none of which meet.
fn spots(count: usize) -> String {
    const IN_A_ROW: usize = 30;
    let spot = |index: usize| {
        let (row, place) = (index / 2 / IN_A_ROW, index / 2 % IN_A_ROW);
        let [row, place] = [row, place].map(|it| 0.000_1 * f64::from(u32::try_from(it).unwrap()));
        (place, row + if index.is_multiple_of(2) { 0.0 } else { 3.0 })
    };
    let with_gap = |index: usize| {
        let ((x, y), to) = (spot(index), spot(index + 1));
        line((x + 0.000_05, y), to)
    };
    entities(&(0..count).map(with_gap).collect::<String>(), spot(count))
}

fn fan_behind_gap(count: usize) -> String {
    entities(&line((0.004, 0.0), (10.0, 0.0)).repeat(count + 1), (10.0, 0.0))
}

fn polyline(count: usize) -> String {
    let vertices: Vec<String> = (0..=count).map(at).map(|(x, y)| format!("10\n{x}\n20\n{y}\n")).collect();
    let vertices = vertices.concat();
    let drawn = format!("0\nLWPOLYLINE\n8\n1202.1P\n6\nCONTINUOUS\n90\n{}\n70\n0\n{vertices}", count + 1);
    entities(&drawn, at(count))
}

/// A layer's number in letters: names of layers have no digits behind the tilde.
fn letters(number: usize) -> String {
    [number / 676, number / 26 % 26, number % 26]
        .map(|digit| (b'A'..=b'Z').nth(digit).map_or('A', char::from))
        .iter()
        .collect()
}

/// One of the path's layers.
fn on_layer(number: usize, drawn: &str) -> String {
    drawn.replace("\n8\n1202.1P\n", &format!("\n8\n1202.1P~{}\n", letters(number)))
}

fn text((x, y): (f64, f64), text: &str) -> String {
    format!("0\nTEXT\n8\n1202.1P\n10\n{x}\n20\n{y}\n40\n1\n1\n{text}\n72\n1\n11\n{x}\n21\n{y}\n73\n2\n")
}

fn with_line(drawn: &str) -> String {
    entities(&(line((0.0, 0.0), (9.0, 0.0)) + drawn), (9.0, 0.0))
}

/// Layers with a line, and as many texts that lie on each.
fn lost_texts(count: usize) -> String {
    let lines: String = (0..count).map(|layer| on_layer(layer, &line((20.0, 0.0), (30.0, 0.0)))).collect();
    with_line(&(lines + &on_layer(count, &text((25.0, 0.0), "B1")).repeat(count)))
}

/// Layers with a line, and a text for each on a layer of its own.
fn lost_texts_apart(count: usize) -> String {
    let height = |layer: usize| 9.0 * f64::from(u32::try_from(layer).unwrap());
    let drawn = |layer: usize| {
        on_layer(layer, &line((20.0, height(layer)), (30.0, height(layer))))
            + &on_layer(count + layer, &text((25.0, height(layer)), "B1"))
    };
    with_line(&(0..count).map(drawn).collect::<String>())
}

/// Circles around as many texts, all equally far.
fn broken_insertions(count: usize) -> String {
    let insert = "0\nINSERT\n8\n1202.1P\n2\nX\n10\na\n20\n0\n".repeat(count);
    let lines: String = (0..count).map(|layer| on_layer(layer, &line((0.0, 0.0), (1.0, 0.0)))).collect();
    let block = format!("0\nBLOCK\n8\n0\n2\nX\n10\n0\n20\n0\n{lines}0\nENDBLK\n");
    format!("0\nSECTION\n2\nBLOCKS\n{block}0\nENDSEC\n{}", with_line(&insert))
}

/// Each has itself as its value, and a text refers to the last often.
fn circular_variables(count: usize) -> String {
    let names: Vec<char> = (0x4e00..).map_while(char::from_u32).take(count).collect();
    let defined = names.iter().map(|name| format!(" :{name}={name},={name}")).collect::<Vec<_>>().concat();
    let drawn =
        with_line(&text((4.5, 0.0), &format!("Q{}", format!("={}", names[count - 1]).repeat(2 * count))));
    let header = "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1021\n0\nENDSEC\n";
    format!("{header}{}", drawn.replacen("B0 MX", &format!("B0 MX{defined}"), 1))
}

fn open_commands(count: usize) -> String {
    with_line(&format!(
        "0\nMTEXT\n8\n1202.1P\n10\n4.5\n20\n0\n40\n0.001\n71\n5\n1\nB1 Q{}\n",
        "\\A".repeat(count)
    ))
}
