//! Tests that values are checked against their limits: PB203. (book: language/letters)

use pathbuild_diagnostic::{Code, Diagnostic, Lang};
use pathbuild_path::{ElementClass, Letter, LetterUse, Path, PathRole, PathSignature};

use crate::letters::POSITIVE;
use crate::support::{codes, compile, path, wrong};

/// Returns the findings about a path with a milled line and this text at its start.
fn start(text: &str) -> Vec<String> {
    wrong(&path(text, "mill 0,0 40,0\nend 40,0"))
}

/// Returns the findings about a statement on a path from (0, 0) to (40, 0).
fn on(statement: &str, parameters: &str) -> Vec<String> {
    let errors = wrong(&path(parameters, &format!("{statement}\nend 40,0")));
    errors.into_iter().filter(|found| !found.starts_with("PB210")).collect()
}

/// Numbers just above and just below the limit of 0.000000001, from which a number is considered positive.
const INSIDE: &str = "0.0000000011";
const OUTSIDE: &str = "0.0000000009";

/// Returns a value of a letter that is just large enough. Programs have three decimals for feeds.
fn inside(letter: char) -> &'static str {
    if matches!(letter, 'F' | 'Z') { "0.0005" } else { INSIDE }
}

/// Returns a value of a letter that is just too small.
fn outside(letter: char) -> &'static str {
    if matches!(letter, 'F' | 'Z') { "0.00049" } else { OUTSIDE }
}

#[test]
fn a_paths_values_are_greater_than_0() {
    for letter in POSITIVE.chars() {
        let with = |value: &str| {
            let others: Vec<&str> =
                ["T5", "O3", "I1", "B-1"].into_iter().filter(|piece| !piece.starts_with(letter)).collect();
            start(&format!("{} {letter}{value}", others.join(" ")))
        };
        assert_eq!(with(inside(letter)), [""; 0], "{letter}");
        for outside in [outside(letter), "0", "-1"] {
            assert_eq!(with(outside), [format!("PB203 {letter}")], "{letter}{outside}");
        }
    }
}

/// A T that the segment does not accept is not compared with the values of the path.
#[test]
fn a_thickness_on_a_segment_has_no_limits() {
    for text in ["T1", "T0", "T9"] {
        assert_eq!(on(&format!("mill 0,0 40,0 \"{text}\""), "T2 O2 I0.5 B0 D1"), ["PB202 T"], "{text}");
    }
    assert_eq!(on("mill 0,0 40,0 \"T1 B3\"", "T2 O2 I0.5 B0 D1"), ["PB202 T", "PB203 B"]);
}

/// The help contains a usual value for the letter.
#[test]
fn a_value_that_must_be_greater_than_0_has_an_example() {
    let is_number = |letter: &Letter| ElementClass::PathStart.use_of(*letter).counts() && !letter.is_text();
    let piece = |letter: Letter| format!("{}{}", letter.as_char(), if letter == Letter::B { -1 } else { 0 });
    let text = Letter::all().filter(is_number).map(piece).collect::<Vec<_>>().join(" ");
    let compiled = compile(&path(&text, "mill 0,0 40,0\nend 40,0"));
    let argument = |found: &Diagnostic, name: &str| {
        let found = found.arguments.iter().find(|(argument, _)| *argument == name);
        found.map(|(_, value)| value.render(Lang::En)).unwrap_or_default()
    };
    let examples = compiled.found.iter().filter(|found| found.code() == Code::ParameterOutOfRange);
    let mut letters: Vec<String> = examples
        .map(|found| {
            let (letter, example) = (argument(found, "letter"), argument(found, "example"));
            assert!(example.starts_with(&letter) && example.len() > 1, "{letter}: {example}");
            letter
        })
        .collect();
    letters.sort();
    assert_eq!(letters.concat(), POSITIVE);
}

/// All parts of a polyline share its text, so a mistake in it is reported once. Another polyline or line may have an equal text of its own.
#[test]
fn what_a_text_says_wrong_is_said_once_of_each_text() {
    for (text, fault) in [("B9", "PB203 B"), ("BX", "PB205 B"), ("G1", "PB202 G")] {
        let polyline =
            |x: u32| format!("mill polyline {x},0 {},0 bulge 0.5 {},0 \"{text}\"\n", x + 20, x + 40);
        let (first, second) = (polyline(0), polyline(40));
        // Findings about the end of the path do not matter here.
        let is_of_text = |found: &String| !found.starts_with("PB4");
        let with = |drawn: &str| -> Vec<String> {
            let found = wrong(&path("T5 O3 I1 B0", &format!("{drawn}end 99,0")));
            found.into_iter().filter(is_of_text).collect()
        };
        assert_eq!(with(&first), [fault; 1]);
        assert_eq!(with(&format!("{first}{second}")), [fault; 2]);
        assert_eq!(with(&format!("mill 0,90 40,90 \"{text}\"\n{first}{second}")), [fault; 3]);
    }
}

#[test]
fn an_elements_values_are_greater_than_0() {
    use ElementClass::{DrilledHole, HelicalCircle, HelicalSupport, Mark, Mill, Probe, Subpath, Support};

    let parameters = "T5 O3 I1 B0 D2 P1 U4 Mx";
    let table = [
        (Mill, "mill 0,0 40,0 \"#\""),
        (Mark, "mark 0,0 40,0 \"D0 #\""),
        (Support, "bars 0,0 40,0 \"#\""),
        (DrilledHole, "sweep 0,0 40,0\ncircle 40,0 d 3 \"#\""),
        (HelicalCircle, "sweep 0,0 40,0\ncircle 40,0 d 8 \"#\""),
        (HelicalSupport, "sweep 0,0 40,0\ncircle BORDER 40,0 d 10 \"#\""),
        (Subpath, "subpath 0,0 40,0 \">1111.1P #\""),
        (Probe, "mill 0,0 40,0\nprobe 20,40 \"#\""),
    ];
    for (class, statement) in table {
        let is_known = |letter: &char| {
            let usage = class.use_of(Letter::new(*letter).unwrap());
            !matches!(usage, LetterUse::Unknown | LetterUse::PathOnly)
        };
        for letter in POSITIVE.chars().filter(is_known) {
            let with = |value: &str| on(&statement.replace('#', &format!("{letter}{value}")), parameters);
            let problem = format!("PB203 {letter}");
            // A value that is just inside may be too small for another rule.
            assert!(!with(inside(letter)).contains(&problem), "{letter} {statement}");
            assert_eq!(with(outside(letter))[0], problem, "{statement}");
        }
    }
}

#[test]
fn s_is_above_t() {
    assert_eq!(start("T5 O3 I1 B0 S5.0006"), [""; 0]);
    for outside in ["5.0004", "5", "4"] {
        assert_eq!(start(&format!("T5 O3 I1 B0 S{outside}")), ["PB203 S"]);
    }
    let sweep = |text: &str| on(&format!("sweep 0,0 40,0 \"{text}\""), "T5 O3 S20");
    assert_eq!(sweep("S5.1"), [""; 0]);
    assert_eq!(sweep("S5"), ["PB203 S"]);
}

#[test]
fn b_and_d_are_below_t() {
    for letter in ['B', 'D'] {
        let with = |value: &str| {
            start(&format!("T5 O3 I1 {letter}{value} {}", if letter == 'B' { "" } else { "B0" }))
        };
        assert_eq!(with("4.9994"), [""; 0], "{letter}");
        for outside in ["4.9996", "5", "6"] {
            assert_eq!(with(outside), [format!("PB203 {letter}")], "{letter}{outside}");
        }
    }
    assert_eq!(on("mill 0,0 40,0 \"B4.9\"", "T5 O3 I1"), [""; 0]);
    assert_eq!(on("mill 0,0 40,0 \"B5\"", "T5 O3 I1"), ["PB203 B"]);
    assert_eq!(on("mark 0,0 40,0 \"D4.9\"", "T5 O3 I1"), [""; 0]);
    assert_eq!(on("mark 0,0 40,0 \"D5\"", "T5 O3 I1"), ["PB203 D"]);
}

#[test]
fn heights_that_are_equal_in_a_program_are_named() {
    let notes = |text: &str| {
        let compiled = compile(&path(text, "mill 0,0 40,0\nend 40,0"));
        let notes = compiled.found.iter().flat_map(|found| &found.notes);
        notes.map(|note| note.text(Lang::En)).collect::<Vec<_>>()
    };
    let equal = ["programs have three decimals: rounded to these, the two heights are equal"];
    assert_eq!(notes("T5 O3 I1 B0 S5.0004"), equal);
    assert_eq!(notes("T5 O3 I1 B4.9996"), equal);
    assert_eq!(notes("T5 O3 I1 B0 S5"), [""; 0]);
}

/// A letter without effect is checked too, since an impossible value is always a mistake.
#[test]
fn letters_without_effect_are_checked_too() {
    assert_eq!(on("mark 0,0 40,0 \"B4.9\"", "T5 O3 I1 D2"), [""; 0]);
    assert_eq!(on("mark 0,0 40,0 \"B5\"", "T5 O3 I1 D2"), ["PB203 B"]);
    assert_eq!(on("mill 0,0 40,0 \"D5\"", "T5 O3 I1 B0"), ["PB203 D"]);
    assert_eq!(on("mill 0,0 40,0 \"S5\"", "T5 O3 I1 B0"), ["PB203 S"]);
}

/// T of a probe or a subpath is the thickness at that position: it must be below the path's S, and is not compared with B and D, which the element
/// does not have.
#[test]
fn an_elements_own_t_is_compared_with_the_paths_s_alone() {
    let probe =
        |text: &str, parameters: &str| on(&format!("mill 0,0 40,0\nprobe 20,40 \"{text}\""), parameters);
    assert_eq!(probe("T9.9", "T5 O3 I1 B0 S10"), [""; 0]);
    assert_eq!(probe("T10", "T5 O3 I1 B0 S10"), ["PB203 S"]);
    let subpath =
        |text: &str, parameters: &str| on(&format!("subpath 0,0 40,0 \">1111.1P {text}\""), parameters);
    for parameters in ["T5 O3 I1 B1", "T5 O3 I1 B0 D2", "T5 O3 I1 B1 D4"] {
        assert_eq!(probe("T0.5", parameters), [""; 0], "{parameters}");
        assert_eq!(subpath("T0.5", parameters), [""; 0], "{parameters}");
    }
    assert_eq!(subpath("T9.9", "T5 O3 I1 B1 S10"), [""; 0]);
    assert_eq!(subpath("T10", "T5 O3 I1 B1 S10"), ["PB203 S"]);
}

/// Faulty values of the path are reported at its start, and not again at every element.
#[test]
fn the_paths_own_faults_are_reported_once() {
    assert_eq!(on("mill 0,0 40,0 \"F100\"", "T5 O3 I1 B6"), ["PB203 B"]);
    assert_eq!(on("mill 0,0 40,0 \"B1\"", "T5 O3 I1 B6"), ["PB203 B"]);
}

#[test]
fn d_is_above_b_on_paths_and_where_there_are_bars() {
    assert_eq!(start("T5 O3 I1 B1 D1.0006"), [""; 0]);
    for outside in ["1.0004", "1", "0"] {
        assert_eq!(start(&format!("T5 O3 I1 B1 D{outside}")), ["PB203 D"]);
    }
    let parameters = "T5 O3 I1 B1 P1 U4";
    assert_eq!(on("bars 0,0 40,0 \"D1.1\"", parameters), [""; 0]);
    assert_eq!(on("bars 0,0 40,0 \"D1\"", parameters), ["PB203 D"]);
    assert_eq!(on("bars 0,0 40,0 \"B2\"", "T5 O3 I1 D2 P1 U4"), ["PB203 D"]);
    assert_eq!(on("sweep 0,0 40,0\ncircle BORDER 40,0 d 10 \"D1\"", parameters), ["PB203 D"]);
    // On different elements, the values are unrelated.
    assert_eq!(on("mill 0,0 40,0 \"B3\"", "T5 O3 I1 D2"), [""; 0]);
    assert_eq!(on("mark 0,0 40,0 \"D0.5\"", "T5 O3 I1 B1"), [""; 0]);
}

#[test]
fn p_and_u_are_greater_than_0_on_paths_and_where_there_are_bars() {
    assert_eq!(start("T5 O3 I1 B0 P0"), ["PB203 P"]);
    assert_eq!(start("T5 O3 I1 B0 U-1"), ["PB203 U"]);
}

/// The S that follows from the role of a path without S must also exceed every T of an element.
#[test]
fn the_default_sweep_height_is_above_every_t() {
    let path_of = |text: &str| -> Path {
        let statements = format!("subpath 0,0 40,0 \">1111.1P\"\nprobe 20,40 \"{text}\"\nend 40,0");
        compile(&path("T5 O3 I1 B0", &statements)).path.unwrap()
    };
    let check = |path: &Path, height: f64| {
        codes(&PathSignature::of(path).low_sweep_problems(height, PathRole::Emitted))
    };
    assert_eq!(check(&path_of("Lx"), 5.1), [""; 0]);
    assert_eq!(check(&path_of("Lx"), 5.0), ["PB203"]);
    assert_eq!(check(&path_of("T7"), 7.1), [""; 0]);
    assert_eq!(check(&path_of("T7"), 7.0), ["PB203"]);
    let subpath = compile(&path("T5 O3 I1 B0", "subpath 0,0 40,0 \">1111.1P T7\"\nend 40,0")).path.unwrap();
    assert_eq!(check(&subpath, 7.1), [""; 0]);
    assert_eq!(check(&subpath, 7.0), ["PB203"]);
    // An explicit S is checked with the other values when the path is compiled.
    let with = compile(&path("T5 O3 I1 B0 S20", "mill 0,0 40,0\nend 40,0")).path.unwrap();
    assert_eq!(check(&with, 1.0), [""; 0]);
}

#[test]
fn there_is_room_for_the_cutter_between_bars() {
    // With two bars on 10 mm, the distance between them is 10 / 2 - P.
    let bars = |p: &str, u: &str| on("bars 0,0 10,0\nsweep 10,0 40,0", &format!("T5 O3 I1 B0 D2 P{p} U{u}"));
    assert_eq!(bars("2", "3"), [""; 0]);
    assert_eq!(bars("2.00001", "2.9"), ["PB406"]);
    let polyline = on("bars polyline 0,0 10,0 10,10 \"P2.00001\"\nsweep 10,10 40,0", "T5 O3 I1 B0 D2 U2.9");
    assert_eq!(polyline, ["PB406", "PB406"], "of each part, as they are drawn");
    // If there is no room for a bar and its distance, the line has no gap at all.
    assert_eq!(bars("5", "5"), [""; 0]);
    assert_eq!(bars("5.001", "5"), ["PB408"]);
    // A short edge may be left standing between longer ones. If no edge has a gap, that is reported once.
    let edges = |length: u32| {
        let elements = format!(
            "bars 0,0 {length},0\nbars {length},0 {length},4\nbars {length},4 {length},8\nsweep {length},8 40,0"
        );
        on(&elements, "T5 O3 I1 B0 D2 P2 U3")
    };
    assert_eq!(edges(5), [""; 0]);
    assert_eq!(edges(4), ["PB408"]);
    assert_eq!(edges(2), ["PB408"], "together they are longer than P + U");
    let circle = |u: &str| on("sweep 0,0 40,0\ncircle BORDER 40,0 d 11", &format!("T5 O3 I1 B0 D2 P1 U{u}"));
    // The cutter's centre runs along a circle of 8 mm: 25.13 mm.
    assert_eq!(circle("4"), [""; 0]);
    assert_eq!(circle("2.5"), ["PB406"]);
    assert_eq!(circle("24.1"), [""; 0]);
    assert_eq!(circle("24.2"), ["PB408"]);
}

/// A curve of many short segments is left standing as a whole, even if other segments of the path have gaps.
#[test]
fn a_run_of_short_support_segments_is_cut_through_somewhere() {
    let beside = |drawn: &str| {
        on(&format!("bars 0,0 20,0\nsweep 20,0 30,0\n{drawn}\nsweep 34,6 40,0"), "T5 O3 I1 B0 D2 P2 U8")
    };
    assert_eq!(beside("bars 30,0 34,0\nbars 34,0 34,5.9\nsweep 34,5.9 34,6"), [""; 0]);
    assert_eq!(beside("bars 30,0 34,0\nbars 34,0 34,6"), ["PB408"]);
    // One edge with a gap is enough, unless a polyline is drawn without any.
    assert_eq!(beside("bars 30,0 34,0\nbars 34,0 34,16\nsweep 34,16 34,6"), [""; 0]);
    assert_eq!(beside("bars polyline 30,0 34,0 34,4 34,8\nbars 34,8 34,18\nsweep 34,18 34,6"), ["PB408"]);
    assert_eq!(beside("bars 30,0 34,0 34,4 34,8\nbars 34,8 34,18\nsweep 34,18 34,6"), [""; 0]);
    // A run as long as two bars with their distances is no corner, whatever comes before and after it.
    let long = |last: f64| {
        beside(&format!("bars 30,0 34,0 34,5 40,5 40,{last}\nbars 40,{last} 40,30\nsweep 40,30 34,6"))
    };
    assert_eq!(long(9.999), [""; 0]);
    assert_eq!(long(10.0), ["PB408"]);
    let round = "bars 30,0 34,0 38,1 41,4 42,8 41,12\nbars 41,12 41,30\nsweep 41,30 34,6";
    assert_eq!(beside(round), ["PB408"]);
    // Ends that do not meet are two runs.
    assert_eq!(beside("bars 30,0 34,0\nsweep 34,0 34.01,0\nbars 34.01,0 34,6"), [""; 0]);
}

/// A short segment between cuts that go as deep as its gaps would is a bar as a whole.
#[test]
fn a_short_segment_between_cuts_is_a_bar() {
    let between = |before: &str, bars: &str, after: &str| {
        on(&format!("mill 0,0 16,0 \"{before}\"\n{bars}\nmill 20,0 40,0 \"{after}\""), "T5 O3 I1 B0 D2 P5 U8")
    };
    assert_eq!(between("N1", "bars 16,0 20,0", "N1"), [""; 0]);
    assert_eq!(between("B-1", "bars 16,0 20,0", "B0"), [""; 0]);
    assert_eq!(between("B0.1", "bars 16,0 20,0", "B0"), ["PB408"], "not as deep as a gap");
    assert_eq!(between("N1", "bars 16,0 20,0 \"B-0.1\"", "N1"), ["PB408"], "the gap would be deeper");
    assert_eq!(between("N1", "bars 16,0 18,2 20,0", "N1"), [""; 0], "a bar of two segments");
    assert_eq!(between("N1", "bars 16,0 18,9 20,0", "N1"), ["PB408"], "longer than P + U");
    let beside = |after: &str| {
        on(&format!("mill 0,0 16,0\nbars 16,0 20,0\n{after} 20,0 40,0"), "T5 O3 I1 B0 D2 P5 U8")
    };
    assert_eq!(beside("mill"), [""; 0]);
    assert_eq!(beside("sweep"), ["PB408"], "a cut at one end only");
    assert_eq!(beside("mark"), ["PB408"]);
}
