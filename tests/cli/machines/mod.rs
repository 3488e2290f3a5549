//! Writes every program of the conformance cases through every built-in post: the reader for its dialect sees the native program's moves,
//! independent readers see the same, and no rule of `verify` finds an error. (book: program/posts)

mod chains;
mod changes;
mod dangerous;
mod independent;
mod programs;

use std::io::Write;

use pathbuild_diagnostic::{Diagnostic, Lang};
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::interpret::{Options, interpret};
use pathbuild_gcode::verify::{Ends, Stock, Tolerance, compare, verify};
use pathbuild_post::{BUILT_IN, Job, Language, PostDefinition, PostOptions, ToolTable, load};
use pathbuild_toolpath::Program;
use rayon::prelude::*;

use programs::{Named, programs};

#[test]
fn every_post_moves_as_the_native_program_does() {
    let programs = programs();
    for post in BUILT_IN.iter().filter(|post| post.language != Language::Native) {
        let definition = load(post.name).unwrap();
        let faults: Vec<String> =
            programs.par_iter().filter_map(|it| fault(post.name, &definition, it)).collect();
        assert!(
            faults.is_empty(),
            "{}: {} of {}\n{}",
            post.name,
            faults.len(),
            programs.len(),
            shown(&faults)
        );
    }
    say(&format!("{} programs through {} posts", programs.len(), BUILT_IN.len() - 1));
}

#[test]
fn no_rule_finds_an_error() {
    let fault = |it: &Named| {
        let steps = programs::steps_of(&it.program);
        let stock = Stock::of(&it.program);
        let found = verify(&steps[..], Dialect::Native, Some(&stock), &mut |_| {});
        let errors: Vec<Diagnostic> = found.into_iter().filter(Diagnostic::is_error).collect();
        (!errors.is_empty()).then(|| format!("{}: {}", it.name, texts(&errors)))
    };
    let programs = programs();
    let faults: Vec<String> = programs.par_iter().filter_map(fault).collect();
    assert!(faults.is_empty(), "{} of {}\n{}", faults.len(), programs.len(), shown(&faults));
}

/// Returns the fault in a post's output, if there is one.
fn fault(post: &str, definition: &PostDefinition, it: &Named) -> Option<String> {
    let at = |reason: String| Some(format!("{}: {reason}", it.name));
    let text = match written(definition, &it.program) {
        Ok(text) => text,
        Err(errors) => return at(texts(&errors)),
    };
    let dialect = definition.reading_dialect(None)?;
    let read = interpret(&text, dialect, &Options::default());
    let errors: Vec<Diagnostic> = read.problems.iter().filter(|it| it.is_error()).cloned().collect();
    if !errors.is_empty() {
        return at(texts(&errors));
    }
    let difference = compare(&read.moves(), &it.program.moves().collect::<Vec<_>>(), &tolerance(post))?;
    at(difference.diagnostic().text(Lang::En))
}

fn written(definition: &PostDefinition, program: &Program) -> Result<Vec<u8>, Vec<Diagnostic>> {
    let programs = std::slice::from_ref(program);
    let (job, _) = Job::from_programs(&program.path, programs, &ToolTable::default(), false);
    // The programs have no spindle speeds.
    let options = PostOptions { manual_spindle: true, ..PostOptions::default() };
    definition.write(&job, &options).map(|output| output.text)
}

/// Returns the tolerance for a post's output: half a unit of the last digit. `XpertMILL` has no helices, so they become lines. Header and footer
/// are up to the post.
fn tolerance(post: &str) -> Tolerance {
    let (decimals, chord) = match post {
        "xpertmill" => (3, 0.01),
        "fanuc" | "haas" | "din" => (3, 0.0),
        _ => (4, 0.0),
    };
    Tolerance { ends: Ends::Cutting, chord, ..Tolerance::of_decimals(decimals) }
}

fn texts(diagnostics: &[Diagnostic]) -> String {
    let text = |it: &Diagnostic| {
        let notes = it.notes.iter().map(|note| format!(" ({})", note.text(Lang::En)));
        format!("{} {}{}", it.code(), it.text(Lang::En), notes.collect::<String>())
    };
    diagnostics.iter().map(text).collect::<Vec<_>>().join("; ")
}

fn shown(faults: &[String]) -> String {
    faults.iter().take(10).map(String::as_str).collect::<Vec<_>>().join("\n")
}

/// Prints a line. Bypasses println!, which the test harness hides for passing tests.
#[allow(clippy::explicit_write, reason = "likewise eprintln!")]
fn say(text: &str) {
    writeln!(std::io::stderr(), "{text}").unwrap();
}
