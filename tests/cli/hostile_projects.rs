//! Tests projects with excessive embedding: they give the correct result or exceed a limit that is reported, in bounded time and memory.
//! (book: language/embedding; book: reference/configuration, [limits])

use std::fmt::Write;
use std::time::{Duration, Instant};

use crate::support::{Place, Run};
use pathbuild_testkit::sheet;

/// Maximum duration of a run, in a debug build on a busy machine.
const LONGEST: Duration = Duration::from_mins(1);

const CONFIGURATION: &str = "feed = 150\nrapid = 1000\nsweep-height = 20\n";

fn name(level: usize) -> String {
    format!("{}.{}P", 1000 + level / 1000, level % 1000)
}

fn file(level: usize) -> String {
    format!("{}.{}.dxf", 1000 + level / 1000, level % 1000)
}

/// Returns a path that mills 10 mm at depth B in five passes; `start` is appended to the text of its start.
fn component(level: usize, start: &str) -> String {
    format!("layer {}\nstart 0,0 \"T5 O2 I1 B0 MX {start}\"\nmill 0,0 10,0\nend 10,0\n", name(level))
}

/// Returns a path from (0, 0) to (10, 0) that embeds others, one above the other.
fn project(level: usize, start: &str, texts: &[String]) -> String {
    let mut text = format!("layer {}\nstart 0,0 \"T5 O2 MX {start}\"\nsweep 0,0 0,5\n", name(level));
    for (embedded, y) in texts.iter().zip((5..).step_by(5)) {
        writeln!(text, "subpath 0,{y} 10,{y} \"{embedded}\"\nsweep 10,{y} 0,{}", y + 5).unwrap();
    }
    let top = 5 * texts.len() + 5;
    text + &format!("sweep 0,{top} 10,0\nend 10,0\n")
}

fn embedded(level: usize) -> String {
    format!(">{}", name(level))
}

fn place(drawings: impl IntoIterator<Item = (usize, String)>, limits: &str) -> Place {
    let place = Place::new().file("pathbuild.toml", format!("{CONFIGURATION}[limits]\n{limits}"));
    drawings
        .into_iter()
        .fold(place, |place, (level, text)| place.file(&file(level), sheet(&text).unwrap().to_dxf()))
}

/// Runs the program with a limit on its duration.
fn timed(place: &Place, arguments: &str) -> Run {
    let begun = Instant::now();
    let run = place.run(&format!("{arguments} --format concise --no-cache"));
    assert!(begun.elapsed() < LONGEST, "{arguments} took {:?}", begun.elapsed());
    run
}

fn times(count: usize, text: &str) -> Vec<String> {
    vec![text.to_owned(); count]
}

fn written(place: &Place, level: usize) -> String {
    place.read(&file(level).replace(".dxf", "_Milling.gcode"))
}

fn cuts(program: &str) -> usize {
    program.lines().filter(|line| line.starts_with("G01 F") && line.contains(" X")).count()
}

/// Ten embeddings at each of ten levels give ten thousand million components.
#[test]
fn ten_levels_of_ten_embeddings_exceed_the_limit_of_moves() {
    let levels = (1..=10).map(|it| (it, project(it, "", &times(10, &embedded(it - 1)))));
    let place = place([(0, component(0, ""))].into_iter().chain(levels), "");
    for command in ["check", "emit"] {
        let run = timed(&place, &format!("{command} {}", file(10)));
        assert_eq!(run.status, Some(1), "{run}");
        assert!(run.stderr.contains("error[PB005] this path has"), "{run}");
        assert!(run.stderr.contains("exceeds the limit of 50000000"), "{run}");
    }
    let run = timed(&place, &format!("check {} {}", file(4), file(5)));
    assert_eq!(run.status, Some(0), "a hundred thousand components are no more than the limit: {run}");
}

#[test]
fn the_limit_of_moves_is_that_of_the_configuration() {
    let drawings = || [(0, component(0, "")), (1, project(1, "", &times(10, &embedded(0))))];
    let status =
        |limit: u64| timed(&place(drawings(), &format!("embedding-moves = {limit}")), "emit 1000.1P").status;
    let (least, most) = (10, 10_000);
    assert_eq!((status(least), status(most)), (Some(1), Some(0)));
}

#[test]
fn a_thousand_embeddings_of_one_component_are_compiled() {
    let place = place([(0, component(0, "")), (1, project(1, "", &times(1000, &embedded(0))))], "");
    let run = timed(&place, "emit 1000.1P");
    assert_eq!(run.status, Some(0), "{run}");
    let program = written(&place, 1);
    assert_eq!(cuts(&program), 5 * 1000, "each in five passes");
    assert_eq!(program.matches("START Subpath 1000.0P").count(), 1000);
}

/// Each level passes its value on twice, so that the tenth has 2^9 copies.
#[test]
fn values_that_double_nine_times_are_handed_down() {
    let lengths = (0..=9).map(|power| "x".repeat(1 << power)).collect::<Vec<_>>().join(",");
    let definition = format!(":A{lengths}");
    let commented = component(0, &definition).replace("mill 0,0 10,0", "mill 0,0 10,0 \"Q=A\"");
    let doubling = |it| (it, project(it, &definition, &[format!("{} :A=A=A", embedded(it - 1))]));
    let outermost = (10, project(10, "", &[format!("{} :Ax", embedded(9))]));
    let levels = (1..=9).map(doubling).chain([outermost]);
    let place = place([(0, commented)].into_iter().chain(levels), "");
    let run = timed(&place, "emit 1000.10P");
    assert_eq!(run.status, Some(0), "{run}");
    let comment = format!("(Q:{})", "x".repeat(512));
    assert_eq!(written(&place, 10).matches(&comment).count(), 5, "one a pass");
}

/// The values of one path refer to each other, so that the text doubles with each variable.
#[test]
fn a_text_that_doubles_with_every_variable_ends_at_the_limit() {
    let path = |doublings: usize| {
        let names: Vec<char> = ('A'..='Z').take(doublings + 1).collect();
        let double = |pair: &[char]| format!(":{1}={0}={0},={0}={0}", pair[0], pair[1]);
        let definitions: Vec<String> = names.windows(2).map(double).collect();
        let start = format!(":A{0},{0} {1}", "x".repeat(100), definitions.join(" "));
        component(0, &start).replace("mill 0,0 10,0", &format!("mill 0,0 10,0 \"Q={}\"", names[doublings]))
    };
    let run = timed(&place([(0, path(9))], ""), "check 1000.0P");
    assert_eq!(run.status, Some(0), "51,200 characters are not too many: {run}");
    let run = timed(&place([(0, path(25))], ""), "check 1000.0P");
    assert_eq!(run.status, Some(1), "{run}");
    assert!(run.stderr.contains("PB005") && run.stderr.contains("65536"), "{run}");
}

/// Four values at each of ten levels give a million different paths.
#[test]
fn paths_with_very_many_values_exceed_the_limit_of_paths() {
    let names: Vec<char> = ('A'..='J').collect();
    let start =
        |count: usize| names[..count].iter().fold(String::new(), |text, name| format!("{text} :{name}0~1"));
    let values = |count: usize, own: f64| {
        let handed = names[..count].iter().fold(String::new(), |text, name| format!("{text} :{name}={name}"));
        format!("{handed} :{}{own}", names[count])
    };
    let level = |it: usize| {
        let texts: Vec<String> =
            [0.0, 0.25, 0.5, 1.0].iter().map(|own| embedded(it - 1) + &values(10 - it, *own)).collect();
        (it, project(it, &start(10 - it), &texts))
    };
    let drawings = || [(0, component(0, &start(10)))].into_iter().chain((1..=10).map(level));
    let limited = place(drawings(), "embedded-paths = 2000");
    let run = timed(&limited, "check 1000.10P");
    assert_eq!(run.status, Some(1), "{run}");
    assert!(run.stderr.contains("PB005") && run.stderr.contains("exceeds the limit of 2000"), "{run}");
    let few = timed(&limited, "check 1000.4P");
    assert_eq!(few.status, Some(0), "85 are not too many: {few}");
}

/// In a chain of four hundred embeddings, everything below ten levels is rejected, and nothing overflows.
#[test]
fn a_chain_of_very_many_levels_ends_at_the_tenth() {
    let levels = (1..400).map(|it| (it, project(it, "", &[embedded(it - 1)])));
    let place = place([(0, component(0, ""))].into_iter().chain(levels), "");
    let run = timed(&place, "check .");
    assert!(run.stderr.contains("400 paths in 400 drawings"), "{run}");
    let too_deep: Vec<&str> = run.stderr.lines().filter(|line| line.contains("[PB508]")).collect();
    assert_eq!(too_deep.len(), 389, "those of levels 11 to 399, each at its tenth level");
    let run = timed(&place, "emit 1000.10P");
    assert_eq!((run.status, cuts(&written(&place, 10))), (Some(0), 5), "{run}");
    let run = timed(&place, "emit 1000.11P");
    assert!(run.status == Some(1) && run.stderr.contains("PB508"), "{run}");
}

/// Unlike a program, the graph of embeddings is not limited to ten levels.
#[test]
fn a_graph_shows_chains_of_any_depth_whole() {
    let levels = (1..100).map(|it| (it, project(it, "", &[embedded(it - 1)])));
    let place = place([(0, component(0, ""))].into_iter().chain(levels), "");
    let above = timed(&place, "rdeps 1000.0P");
    assert_eq!(above.stdout.lines().count(), 100, "{above}");
    let all = timed(&place, "graph .");
    assert_eq!(all.stdout.lines().filter(|line| !line.contains("PB508")).count(), 99, "{all}");
}

#[test]
fn a_cycle_through_ten_files_is_said_with_its_names() {
    let levels = (0..10).map(|it| (it, project(it, "", &[embedded((it + 1) % 10)])));
    let place = place(levels, "");
    let run = timed(&place, "check 1000.3P");
    let chain: Vec<String> = (0..=10).map(|it| name((it + 3) % 10)).collect();
    assert!(run.stderr.contains(&format!("path 1000.3P embeds itself: {}", chain.join(" > "))), "{run}");
}

/// A cycle that is longer than the maximum depth is reported as too deep.
#[test]
fn a_cycle_through_a_hundred_files_ends() {
    let levels = (0..100).map(|it| (it, project(it, "", &[embedded((it + 1) % 100)])));
    let run = timed(&place(levels, ""), "check .");
    assert_eq!(run.status, Some(1));
    assert!(!run.stderr.contains("PB509"));
    assert_eq!(run.stderr.lines().filter(|line| line.contains("[PB508]")).count(), 100);
}

/// The eleventh level below two projects is the same segment, which is reported once.
#[test]
fn a_segment_that_is_too_deep_below_several_projects_is_reported_once() {
    let levels = (1..=10).map(|it| (it, project(it, "", &[embedded(it - 1)])));
    let above = [11, 12].map(|it| (it, project(it, "", &[embedded(10)])));
    let place = place([(0, component(0, ""))].into_iter().chain(levels).chain(above), "");
    let run = timed(&place, "check .");
    let too_deep: Vec<&str> = run.stderr.lines().filter(|line| line.contains("PB508")).collect();
    assert_eq!(too_deep.len(), 1, "{run}");
    assert!(too_deep[0].starts_with("1000.1.dxf"), "{run}");
}

#[test]
fn each_of_very_many_wrong_embeddings_is_reported() {
    let texts: Vec<String> = (0..600).map(|number| format!(">{}.{number}P", 2000 + number / 100)).collect();
    let run = timed(&place([(0, project(0, "", &texts))], ""), "check .");
    assert_eq!(run.stderr.lines().filter(|line| line.contains("[PB503]")).count(), 600);
}

#[test]
fn a_directory_with_too_much_below_it_is_not_walked_through() {
    let files = (0..40).map(|it| (it, component(it, "")));
    let place = place(files, "library-entries = 40");
    // The directory contains forty drawings and pathbuild.toml.
    for command in ["check .", "emit .", "graph .", "rdeps 1000.0P", "check 1000.99P"] {
        let run = timed(&place, command);
        assert_eq!(run.status, Some(1), "{run}");
        assert!(run.stderr.contains("PB005") && run.stderr.contains("more than 40 files"), "{run}");
    }
    let place = place.file("pathbuild.toml", format!("{CONFIGURATION}[limits]\nlibrary-entries = 41\n"));
    let run = timed(&place, "check .");
    assert!(run.stderr.starts_with("40 paths in 40 drawings: no errors"), "{run}");
}
