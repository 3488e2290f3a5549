//! Compares pathbuild with recorded runs of `PathDxf2GCode` and `PathGCodeAdjustZ`, move by move: it must do the same with the same drawings.
//! fixtures/conformance/README.md describes the recordings and what counts as equal.

mod compare;
pub(crate) mod recorded;
mod reduced;
mod travelled;

use std::collections::BTreeSet;
use std::fs;
use std::io::Write;
use std::mem;
use std::path::Path;

use rayon::prelude::*;

use self::recorded::{Form, Run};
use crate::support;

/// Runs with known differences, each with the reason. A run without differences must not be listed.
const DIFFERENT: [(&str, Form, &str); 2] = [
    (
        "reference-drawings/3",
        Form::Recorded,
        "PB202 beside PB101, PB102 and PB105: a milling segment has a T",
    ),
    ("reference-drawings/35", Form::Recorded, "PB201 beside PB202: B is missing as well, on other segments"),
];

#[test]
fn recorded_runs_are_equal() {
    let fixtures = support::project().join("fixtures/conformance");
    let runs = recorded::runs(&["cases", "turns", "adjust"].map(|name| fixtures.join(name)));
    let of_form = |form| runs.iter().filter(|run| run.form == form).count();
    assert_eq!((of_form(Form::Recorded), of_form(Form::Default)), (640, 152), "in {}", fixtures.display());
    let single: BTreeSet<String> =
        fs::read_to_string(fixtures.join("single.txt")).unwrap().lines().map(str::to_owned).collect();
    let differences = compare_all("recorded", &runs);
    let chosen = runs.iter().zip(&differences).filter(|(run, _)| single.contains(&run.name()));
    say("recorded, of a single path", &chosen.map(|(_, differences)| differences).collect::<Vec<_>>());
}

/// The reference's own test drawings may not be published here, so they are read from its directory, if it exists.
#[test]
fn foreign_runs_are_equal() {
    let Some(foreign) = support::shared("conformance/foreign") else { return };
    let runs = recorded::runs(&[foreign]);
    assert_eq!(runs.len(), 36);
    compare_all("foreign", &runs);
}

/// PB506 also compares the cutter of an embedded path with that of the path that embeds it, whatever the segment says. PathDxf2GCode does not, so
/// no recorded run may cause this message.
#[test]
fn no_recorded_run_embeds_a_path_for_another_cutter() {
    let fixtures = support::project().join("fixtures/conformance");
    let runs = recorded::runs(&["cases", "turns"].map(|name| fixtures.join(name)));
    let compiled = runs.iter().filter(|run| run.form == Form::Recorded);
    let findings: Vec<(String, Vec<String>)> = compiled
        .collect::<Vec<_>>()
        .par_iter()
        .filter_map(|run| Some((run.name(), compare::messages(run, "PB506")?)))
        .collect();
    assert!(findings.len() > 600, "{} runs", findings.len());
    let is_cutter = |message: &String| {
        ["is drawn for a cutter of", "ist für einen Fräser von"].iter().any(|text| message.contains(text))
    };
    for (run, messages) in &findings {
        assert!(!messages.iter().any(is_cutter), "{run}: {messages:#?}");
    }
    // The other messages compare the segment with the path that it embeds.
    let others = findings.iter().filter(|(_, messages)| !messages.is_empty());
    let cases: BTreeSet<&str> = others.map(|(run, _)| run.split('/').next().unwrap()).collect();
    assert_eq!(cases, BTreeSet::from(["subpath_wrong_m", "subpath_wrong_o", "subpath_wrong_t"]));
}

/// Returns the differences of each run. Fails if any of them is not a known one.
fn compare_all(what: &str, runs: &[Run]) -> Vec<Vec<String>> {
    let mut differences: Vec<Vec<String>> = runs.par_iter().map(compare::differences).collect();
    if cfg!(windows) {
        compare_again(runs, &mut differences);
    }
    say(what, &differences.iter().collect::<Vec<_>>());
    let faults: Vec<String> =
        runs.iter().zip(&differences).filter_map(|(run, found)| fault(run, found)).collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    differences
}

/// Wine loses one of several hundred processes, and more on a busy machine: it does not start, or its exit status is lost
/// (tests/tools/windows.sh). Therefore, if only a few runs differ, they are compared again one by one and listed.
#[allow(clippy::explicit_write, reason = "likewise eprintln!")]
fn compare_again(runs: &[Run], differences: &mut [Vec<String>]) {
    let different: Vec<usize> = (0..runs.len()).filter(|&index| !differences[index].is_empty()).collect();
    if different.len() > 1 + runs.len() / 100 {
        return;
    }
    for index in different {
        let first = mem::replace(&mut differences[index], compare::differences(&runs[index]));
        let found = first.join("; ");
        writeln!(std::io::stderr(), "compared again: {}: {found}", runs[index].name()).unwrap();
    }
}

/// Reports how many runs are equal. Bypasses println!, which the test harness hides for passing tests.
#[allow(clippy::explicit_write, reason = "likewise eprintln!")]
fn say(what: &str, differences: &[&Vec<String>]) {
    let equal = differences.iter().filter(|differences| differences.is_empty()).count();
    writeln!(std::io::stderr(), "{what}: {equal} of {} runs equal", differences.len()).unwrap();
}

/// Returns the problem with the outcome of a run: it differs unexpectedly, or is equal although it is listed as different.
fn fault(run: &Run, differences: &[String]) -> Option<String> {
    let known = DIFFERENT.iter().find(|(name, form, _)| *name == run.name() && *form == run.form);
    match (known, differences) {
        (None, []) | (Some(_), [_, ..]) => None,
        (Some(_), []) => Some(format!("{}: equal now, and to be taken off the list", run.name())),
        (None, _) => Some(format!("{run}:\n    {}", differences.join("\n    "))),
    }
}

/// Returns the files below a directory, as names relative to it.
fn files_below(directory: &Path) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    let mut open = vec![directory.to_owned()];
    while let Some(next) = open.pop() {
        for entry in fs::read_dir(next).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                open.push(path);
            } else {
                names.insert(path.strip_prefix(directory).unwrap().to_str().unwrap().replace('\\', "/"));
            }
        }
    }
    names
}
