//! Runs the programs in `examples/` on the library of the fixtures.

use std::process::{Command, Output};

use pathbuild_testkit::project;

fn run(name: &str, arguments: &[&str]) -> Output {
    // Cargo builds examples beside the tests.
    let tests = std::env::current_exe().unwrap();
    let examples = tests.ancestors().nth(2).unwrap().join("examples");
    let program = examples.join(format!("{name}{}", std::env::consts::EXE_SUFFIX));
    Command::new(program).args(arguments).current_dir(project().join("fixtures")).output().unwrap()
}

fn lines(output: &Output) -> Vec<&str> {
    assert!(output.status.success(), "{output:?}");
    std::str::from_utf8(&output.stdout).unwrap().lines().collect()
}

#[test]
fn feeds_of_every_path_are_printed() {
    let output = run("feeds", &["library"]);
    let lines = lines(&output);
    assert!(lines.contains(&"2050.1P (components/2050.1P.dxf), M 20x2"), "{lines:?}");
    assert!(lines.iter().any(|line| line.ends_with("mm at 150 mm/min")), "{lines:?}");
}

#[test]
fn moves_are_printed_as_csv() {
    let output = run("moves_csv", &["library", "2050.1P"]);
    let lines = lines(&output);
    assert_eq!(lines[0], "kind,x,y,z,feed,length,element");
    assert!(lines.len() > 20 && lines.iter().all(|line| line.split(',').count() == 7), "{lines:?}");
    assert!(!run("moves_csv", &["library", "9999.1P"]).status.success());
}

/// In aluminium, a feed of 200 mm/min is allowed; a higher one is only allowed in wood.
#[test]
fn a_check_of_ones_own_finds_feeds() {
    assert!(lines(&run("custom_check", &["library"])).is_empty());
    for (material, feed, is_good) in [("Al", 200, true), ("Al", 201, false), ("Wood", 201, true)] {
        let directory = tempfile::TempDir::new().unwrap();
        let text =
            format!("layer 8001.1P\nstart 0,0 \"T5 O2 I1 B0 F{feed} M{material}\"\nmill 0,0 9,0\nend 9,0");
        let drawing = pathbuild_testkit::sheet(&text).unwrap().to_dxf();
        std::fs::write(directory.path().join("8001.1P.dxf"), drawing).unwrap();
        let output = run("custom_check", &[directory.path().to_str().unwrap()]);
        let said = String::from_utf8_lossy(&output.stdout);
        assert_eq!(
            (output.status.success(), said.contains("LINE is milled")),
            (is_good, !is_good),
            "{output:?}"
        );
    }
}
