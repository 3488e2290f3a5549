//! Runs a fixture (crates/pathbuild-testkit, README.md): writes its files, runs its commands, and compares the diagnostics with those noted in it.
//! Each of the noted diagnostics must occur once, and no others may occur.

use pathbuild_testkit::{Expect, Fixture};
use serde_json::Value as Json;

use super::{Place, Run};

/// Runs a fixture and returns the deviations.
pub fn faults(text: &str) -> Vec<String> {
    let fixture = match Fixture::parse(text) {
        Ok(fixture) => fixture,
        Err(errors) => return errors.iter().map(|error| format!("{error:?}")).collect(),
    };
    let place = fixture.files.iter().fold(Place::new(), |place, file| place.file(&file.name, file.bytes()));
    let mut faults = Vec::new();
    let mut open: Vec<&Expect> = fixture.expects.iter().collect();
    for (index, command) in fixture.commands.iter().enumerate() {
        let arguments: Vec<&str> = command.arguments.iter().map(String::as_str).collect();
        let run = place.run_with(&[&["--format=json", "--no-cache"], &*arguments].concat());
        if command.exit.is_some_and(|exit| run.status != Some(exit)) || !matches!(run.status, Some(0..=2)) {
            faults.push(format!("exit status {:?}\n{run}", run.status));
        }
        for found in findings(&run) {
            match open.iter().position(|expect| agrees(expect, index, &found)) {
                Some(position) => _ = open.remove(position),
                None => faults.push(format!("not expected: {found}")),
            }
        }
    }
    faults.extend(open.iter().map(|expect| format!("missing: {expect:?}")));
    for (name, content) in &fixture.expected_files {
        if !place.path().join(name).exists() || place.read(name).trim_end() != content.trim_end() {
            faults.push(format!("{name} is not as expected"));
        }
    }
    faults
}

/// Returns the diagnostics in the output on both streams.
pub fn findings(run: &Run) -> Vec<Json> {
    let lines = run.stdout.lines().chain(run.stderr.lines());
    let objects = lines.filter(|line| line.starts_with('{')).map(|line| serde_json::from_str(line).unwrap());
    objects.filter(|object: &Json| object["type"] == "finding").collect()
}

fn agrees(expect: &Expect, command: usize, found: &Json) -> bool {
    let is = |key: &str, value: &str| found[key].as_str() == Some(value);
    let has_handle = || expect.handles.iter().any(|handle| is("handle", &handle.to_string()));
    is("code", &expect.code.to_string())
        && expect.command.is_none_or(|it| it == command)
        && expect.file.as_ref().is_none_or(|file| is("file", file))
        && (expect.handles.is_empty() || has_handle())
        && found["message"].as_str().unwrap_or_default().contains(&expect.text)
}
