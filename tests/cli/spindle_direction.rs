//! Tests the direction of the spindle against the direction that the tool table gives for a tool (PB783).

use crate::support::Place;

/// Returns the lines with a wrong direction, and the exit status.
fn verify(tools: &str, program: &str, options: &str) -> (Vec<String>, Option<i32>) {
    let place = Place::new().file("pathbuild.toml", tools).file("a.nc", program);
    let run = place.run(&format!("verify a.nc --format concise {options}"));
    let lines = run.stdout.lines().chain(run.stderr.lines()).filter(|line| line.contains("PB783"));
    (lines.map(str::to_owned).collect(), run.status)
}

fn tool(name: &str, keys: &str) -> String {
    format!("[tool.{name}]\ndiameter = {}\n{keys}\n", name.len())
}

/// Returns a program that changes to T1, cuts, and does the same with T2.
fn program(first: &str, second: &str) -> String {
    let cuts = |tool: u32, word: &str| {
        format!("T{tool} M6\n{word} S1000\nG0 Z5\nG0 X0 Y0\nG1 Z-1 F100\nG1 X9\nG1 X18\nG0 Z5\nM5\n")
    };
    format!("G17 G21 G90 G94\n{}{}M30\n", cuts(1, first), cuts(2, second))
}

const FINE: [&str; 0] = [];

#[test]
fn a_spindle_that_turns_against_its_tool_is_an_error() {
    let tools = format!(
        "{}{}",
        tool("a", "number = 1\ndirection = \"cw\""),
        tool("bb", "number = 2\ndirection = \"ccw\"")
    );
    let found = |first, second| verify(&tools, &program(first, second), "--dialect linuxcnc");
    assert_eq!(found("M3", "M4"), (FINE.map(String::from).to_vec(), Some(0)));
    let (lines, status) = found("M4", "M4");
    assert!(status == Some(1) && lines.len() == 1 && lines[0].starts_with("a.nc:6:"), "{lines:?}");
    assert!(lines[0].contains("M4") && lines[0].contains("cw"), "{lines:?}");
    let (lines, _) = found("M3", "M3");
    assert!(lines.len() == 1 && lines[0].starts_with("a.nc:15:"), "{lines:?}");
    assert_eq!(found("M4", "M3").0.len(), 2);
}

#[test]
fn a_tool_with_a_speed_turns_clockwise() {
    let found = |keys: &str, word| {
        let tools = tool("a", &format!("number = 1\n{keys}"));
        verify(&tools, &program(word, "M3").replace("T2 M6\n", ""), "--dialect linuxcnc").0.len()
    };
    assert_eq!([found("spindle = 1000", "M3"), found("spindle = 1000", "M4")], [0, 1]);
    assert_eq!(found("", "M4"), 0);
}

/// GRBL has no M6, so that only the direction common to all tools can be compared.
#[test]
fn without_numbers_the_common_direction_counts() {
    let found = |second: &str| {
        let tools = format!("{}{}", tool("a", "direction = \"cw\""), tool("bb", second));
        let program = program("M4", "M4").replace("T1 M6\n", "").replace("T2 M6\n", "");
        verify(&tools, &program, "--dialect grbl").0.len()
    };
    assert_eq!([found("direction = \"cw\""), found("direction = \"ccw\""), found("")], [1, 0, 0]);
}
