//! Runs the program on a recorded case and compares the outcome with the expected one.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Output;

use tempfile::TempDir;

use super::files_below;
use super::recorded::{Form, Run, What};
use super::reduced::{is_same_line, of_default, reduced};
use super::travelled::statistics_difference;
use crate::support::program;

/// Runs pathbuild and returns the differences from the recorded results; none if they are equal.
pub(crate) fn differences(run: &Run) -> Vec<String> {
    match &run.what {
        What::Compile(arguments) => compile_differences(run, arguments),
        What::Adjust(max_correction) => adjust_differences(run, *max_correction),
    }
}

fn compile_differences(run: &Run, arguments: &[String]) -> Vec<String> {
    let expected = run.case.join(run.form.folder()).join(run.number.to_string());
    let compatible = (run.form == Form::Recorded).then_some("--compatible");
    let place = copy_of(&run.case);
    let before = files_below(place.path());
    let output = match program()
        .args([&arguments[0], "--no-cache", "--format=json"])
        .args(compatible)
        .args(&arguments[1..])
        .current_dir(place.path())
        .output()
    {
        Ok(output) => output,
        Err(error) => return vec![format!("not started: {error}")],
    };
    let mut differences = Vec::new();
    differences.extend(odd_end(&output));
    let fails = fs::read_to_string(expected.join("exit")).unwrap().trim() != "0";
    differences.extend(exit_difference(&output, fails));
    differences.extend(code_difference(&output, &fs::read_to_string(expected.join("codes")).unwrap()));
    let written: BTreeSet<String> = &files_below(place.path()) - &before;
    let wanted = if fails { BTreeSet::new() } else { recorded_files(&expected) };
    if written != wanted {
        differences.push(format!("files {written:?}, expected {wanted:?}"));
    }
    let both = written.intersection(&wanted);
    for name in both {
        differences.extend(file_difference(name, run.form, &expected, place.path()));
    }
    differences
}

/// Returns the messages with this code, of any severity, if the run is checked without `--compatible`; `None` for runs that do not compile.
pub(crate) fn messages(run: &Run, code: &str) -> Option<Vec<String>> {
    let What::Compile(arguments) = &run.what else { return None };
    let place = copy_of(&run.case);
    let mut command = program();
    command.args(["check", "--no-cache", "--format=json"]).args(&arguments[1..]).current_dir(place.path());
    let output = String::from_utf8(command.output().unwrap().stdout).unwrap();
    let lines = output.lines().map(|line| serde_json::from_str(line).unwrap());
    let found = lines.filter(|line: &serde_json::Value| line["code"] == code);
    Some(found.map(|finding| finding["message"].as_str().unwrap().to_owned()).collect())
}

/// Compares the adjusted program byte for byte, except for line ends.
fn adjust_differences(run: &Run, max_correction: f64) -> Vec<String> {
    let expected = run.case.join("expected");
    let place = copy_of(&run.case);
    let input = files_below(place.path()).into_iter().find(|name| name.ends_with("_Clean.gcode")).unwrap();
    let name = input.strip_suffix("_Clean.gcode").unwrap();
    let output = match program()
        .args(["adjust", &format!("--max-correction={max_correction}"), name])
        .current_dir(place.path())
        .output()
    {
        Ok(output) => output,
        Err(error) => return vec![format!("not started: {error}")],
    };
    let mut differences = Vec::new();
    differences.extend(odd_end(&output));
    let fails = fs::read_to_string(expected.join("exit")).unwrap().trim() != "0";
    differences.extend(exit_difference(&output, fails));
    let program = format!("{name}_Milling.gcode");
    let read = |directory: &Path| {
        fs::read_to_string(directory.join(&program)).ok().map(|text| text.replace("\r\n", "\n"))
    };
    if read(&expected) != read(place.path()) {
        differences.push(format!("{program} differs"));
    }
    differences
}

/// Copies a case's drawings to a temporary directory.
fn copy_of(case: &Path) -> TempDir {
    let place = TempDir::new().unwrap();
    for name in files_below(case) {
        if name != "case.json" && !name.starts_with("expected/") && !name.starts_with("default/") {
            let copy = place.path().join(&name);
            fs::create_dir_all(copy.parent().unwrap()).unwrap();
            fs::write(copy, fs::read(case.join(&name)).unwrap()).unwrap();
        }
    }
    place
}

fn recorded_files(expected: &Path) -> BTreeSet<String> {
    let mut names = files_below(expected);
    names.retain(|name| name != "exit" && name != "codes");
    names
}

fn odd_end(output: &Output) -> Option<String> {
    let is_panic = String::from_utf8_lossy(&output.stderr).contains("panicked at");
    let is_odd = output.status.code().is_none_or(|status| status > 2);
    (is_panic || is_odd).then(|| format!("a panic, or an odd end: {}", output.status))
}

/// Compares the exit status. Unlike pathbuild, the reference does not distinguish between 1 and 2.
fn exit_difference(output: &Output, fails: bool) -> Option<String> {
    let expected = if fails { "failure" } else { "success" };
    (output.status.success() == fails).then(|| format!("{}, expected {expected}", output.status))
}

fn code_difference(output: &Output, expected: &str) -> Option<String> {
    let expected: BTreeSet<&str> = expected.split_whitespace().collect();
    if expected.contains("usage") {
        return None;
    }
    let text = [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes));
    let lines = text.iter().flat_map(|text| text.lines()).filter(|line| line.starts_with('{'));
    let found: BTreeSet<String> = lines.filter_map(error_code).filter(|code| code != "PB511").collect();
    let is_same = found.iter().map(String::as_str).eq(expected.iter().copied());
    (!is_same).then(|| format!("codes {found:?}, expected {expected:?}"))
}

/// Returns the code of an error in a line of JSON.
fn error_code(line: &str) -> Option<String> {
    let diagnostic: serde_json::Value = serde_json::from_str(line).unwrap();
    (diagnostic["severity"] == "error").then(|| diagnostic["code"].as_str().unwrap().to_owned())
}

/// Returns the first line in which a file differs.
fn file_difference(name: &str, form: Form, expected: &Path, written: &Path) -> Option<String> {
    let text = |directory: &Path| fs::read_to_string(directory.join(name)).unwrap();
    let lines = |directory: &Path| {
        let lines = reduced(name, &text(directory));
        if form == Form::Default { of_default(lines) } else { lines }
    };
    if form == Form::Default
        && let Some(difference) = statistics_difference(name, &text(written))
    {
        return Some(difference);
    }
    let (expected, written) = (lines(expected), lines(written));
    (0..expected.len().max(written.len())).find_map(|index| {
        let line = |lines: &[String]| lines.get(index).cloned().unwrap_or_else(|| "<nothing>".to_owned());
        let (expected, written) = (line(&expected), line(&written));
        (!is_same_line(&expected, &written))
            .then(|| format!("{name}, line {} of its moves: expected {expected}, got {written}", index + 1))
    })
}
