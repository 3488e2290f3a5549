//! The README and `docs/first-steps.md` say what somebody typed and what was printed: here it is typed again.

use std::fmt::Write;
use std::fs;

use crate::support::{Place, project};
use pathbuild_testkit::sheet;

/// The drawing before the first command, and after each change in the CAD: before which command, and what it then is.
const DRAWINGS: &[(usize, &str)] = &[
    (1, "mill 0,0 20,0 \"b0.5 I0,5\"\nmill 20.2,0 40,0 \"B2.5 I0,5\""),
    (2, "mill 0,0 20,0 \"B0.5 I0,5\"\nmill 20.2,0 40,0 \"B2.5 I0,5\""),
    (3, "mill 0,0 20,0 \"B0.5 I0,5\"\nmill 20.2,0 40,0 \"B0.5 I0,5\""),
    (4, "mill 0,0 20,0 \"B0.5 I0,5\"\nmill 20,0 40,0 \"B0.5 I0,5\""),
];

/// Before this command the feeds are uncommented in `pathbuild.toml`.
const WITH_FEEDS: usize = 6;

#[test]
fn what_is_written_down_is_what_is_printed() {
    let path = project().join("docs/first-steps.md");
    let page = fs::read_to_string(&path).unwrap();
    let now = replayed(&page);
    if std::env::var_os("PATHBUILD_UPDATE").is_some() {
        fs::write(path, now).unwrap();
        return;
    }
    assert_eq!(now, page, "PATHBUILD_UPDATE=1 writes it anew: read what changed");
}

#[test]
fn what_the_readme_shows_is_what_is_printed() {
    let page = fs::read_to_string(project().join("README.md")).unwrap();
    let (_, block) = page.split_once("```console\n$ pathbuild check ").unwrap();
    let (block, _) = block.split_once("```").unwrap();
    let (file, shown) = block.split_once('\n').unwrap();
    let output = crate::support::program().args(["check", file]).current_dir(project()).output().unwrap();
    let printed = String::from_utf8(output.stderr).unwrap();
    // Its last line says how long it took.
    assert_eq!(printed.rsplit_once('(').unwrap().0, shown.rsplit_once('(').unwrap().0);
}

/// The page with what its commands print now, and the beginning of the program that they write.
fn replayed(page: &str) -> String {
    let mut place = Place::new();
    let mut commands = 0;
    let mut now = String::new();
    let mut rest = page;
    while let Some((before, block)) = rest.split_once("\n```") {
        let (content, after) = block.split_once("\n```").unwrap();
        let (language, content) = content.split_once('\n').unwrap();
        let content = if language == "console" {
            place = changed(place, commands);
            commands += 1;
            typed(&place, content.lines().next().unwrap())
        } else {
            let program = place.read("1234.1P_Milling.gcode");
            program.lines().take(content.lines().count()).collect::<Vec<_>>().join("\n")
        };
        write!(now, "{before}\n```{language}\n{content}\n```").unwrap();
        rest = after;
    }
    now + rest
}

/// The directory as it is before a command.
fn changed(place: Place, command: usize) -> Place {
    if command == WITH_FEEDS {
        let configuration = place.read("pathbuild.toml");
        return place.file("pathbuild.toml", with_feeds(&configuration));
    }
    match DRAWINGS.iter().find(|(before, _)| *before == command) {
        Some((_, lines)) => place.file("1234.1P.dxf", drawing(lines)),
        None => place,
    }
}

fn typed(place: &Place, command: &str) -> String {
    let run = place.run(command.strip_prefix("$ pathbuild ").unwrap());
    format!("{command}\n{}", format!("{}{}", run.stdout, run.stderr).trim_end())
}

fn drawing(lines: &str) -> Vec<u8> {
    sheet(&format!("layer 1234.1P\nstart 0,0 \"O2 T2\"\n{lines}\nend 40,0")).unwrap().to_dxf()
}

fn with_feeds(configuration: &str) -> String {
    let is_wanted = |line: &str| {
        ["feed", "rapid", "sweep-height"].iter().any(|key| line.starts_with(&format!("#{key} = ")))
    };
    let lines = configuration.lines().map(|line| if is_wanted(line) { &line[1..] } else { line });
    lines.map(|line| format!("{line}\n")).collect::<Vec<_>>().concat()
}
