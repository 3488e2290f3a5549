//! Tests `init --example`, which creates the library for learning, and the messages that point to it.

use crate::support::Place;

#[test]
fn the_example_library_is_right_as_it_comes() {
    let place = Place::new();
    let written = place.run("init --example");
    assert_eq!((written.status, written.stdout.lines().count()), (Some(0), 8), "{written}");
    for command in
        ["check --error-on-warning", "check starter.dxf --error-on-warning", "emit", "emit --check"]
    {
        let run = place.run(command);
        assert_eq!(run.status, Some(0), "{run}");
    }
    let program = place.read("gcode/8001.1P_Milling.gcode");
    assert!(program.contains("M3 S12000"), "it is for a spindle that the program switches on");
}

#[test]
fn a_template_lacks_nothing_but_a_path() {
    let place = Place::new();
    place.run("init --example");
    for name in ["librecad", "qcad", "cad6"] {
        let run = place.run(&format!("check templates/{name}.dxf --format concise"));
        let errors: Vec<&str> = run.stderr.lines().filter(|line| line.contains("[PB")).collect();
        assert!(matches!(&errors[..], [one] if one.contains("[PB404]")), "{run}");
    }
}

#[test]
fn the_example_leaves_files_alone() {
    let place = Place::new().file("components/2002.1P.dxf", "mine");
    let run = place.run("init --example");
    assert!(run.stderr.contains("2002.1P.dxf: it already exists"), "{run}");
    assert_eq!((run.status, place.read("components/2002.1P.dxf").as_str()), (Some(1), "mine"));
    assert!(!place.path().join("pathbuild.toml").exists(), "nothing is written where one file cannot be");
}

#[test]
fn without_a_configuration_check_mentions_init() {
    let run = Place::new().run("check");
    assert!(run.stderr.contains("`pathbuild init --example`"), "{run}");
    let run = Place::new().file("pathbuild.toml", "feed = 150").run("check");
    assert!(run.stderr.contains("set `library` in pathbuild.toml") && !run.stderr.contains("init"), "{run}");
}

/// The file size limit of 2 kB acts as a full disk. No partial file remains that would block the next attempt.
#[cfg(unix)]
#[test]
fn files_that_cannot_be_written_whole_are_gone() {
    for (blocks, arguments) in [(4, "init --example"), (1, "init")] {
        let place = Place::new();
        let program = crate::support::program();
        let limited = format!("trap '' XFSZ; ulimit -f {blocks}; exec \"$0\" {arguments}");
        let mut shell = std::process::Command::new("sh");
        shell.arg("-c").arg(limited).arg(program.get_program()).current_dir(place.path());
        let run = shell.output().unwrap();
        assert!(String::from_utf8_lossy(&run.stderr).contains("PB004"), "{run:?}");
        let left = |directory: &str| {
            let entries = std::fs::read_dir(place.path().join(directory)).into_iter().flatten();
            entries.filter(|entry| entry.as_ref().unwrap().path().is_file()).count()
        };
        assert_eq!(["", "components", "templates"].map(left), [0; 3]);
        assert_eq!(place.run(arguments).status, Some(0));
    }
}
