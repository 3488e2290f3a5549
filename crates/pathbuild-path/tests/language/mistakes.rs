//! Tests typical mistakes, each reported as a single error with a correction.

use pathbuild_diagnostic::{Diagnostic, Lang};
use pathbuild_path::{ElementClass, ParameterTexts};

use crate::support::{compile, path};

const P: &str = "T5 O3 I1 B0";

fn messages_with_help(found: &[Diagnostic]) -> Vec<String> {
    let with_help = |found: &Diagnostic| {
        format!("{} {}; {}", found.code(), found.text(Lang::En), found.help(Lang::En).unwrap_or_default())
    };
    found.iter().map(with_help).collect()
}

fn of_text(text: &str, class: ElementClass) -> Vec<String> {
    messages_with_help(&ParameterTexts::from(text).first().unwrap().problems(class))
}

#[track_caller]
fn assert_one(found: &[String], begin: &str, end: &str) {
    assert!(found.len() == 1 && found[0].starts_with(begin) && found[0].ends_with(end), "{found:?}");
}

#[test]
fn a_text_in_lower_case_is_one_error() {
    let found = of_text("o2 t2 i0.5 B0", ElementClass::PathStart);
    assert_one(&found, "PB202 the letters of this text", "write \"O2 T2 I0.5 B0\", with upper-case letters");
    assert_eq!(of_text("o2 T2 B0", ElementClass::PathStart).len(), 1, "one letter is an error of its own");
    assert_eq!(of_text("x2 y2", ElementClass::PathStart).len(), 2, "no letters in upper case either");
}

#[test]
fn commas_between_parameters_are_one_error() {
    let found = of_text("O2,T2,B0", ElementClass::PathStart);
    assert_one(&found, "PB202 parameters are separated by commas", "write \"O2 T2 B0\"");
    let found = of_text("O2,5,T2 B-0,5", ElementClass::PathStart);
    assert_one(&found, "PB202 parameters are", "write \"O2,5 T2 B-0,5\"");
    assert_eq!(of_text("B2,5 QA,B", ElementClass::Mill), [""; 0], "numbers and texts have commas");
    assert_eq!(of_text("O2,5 T2 :aP,Q", ElementClass::PathStart), [""; 0], "lists, too");
}

#[test]
fn a_zero_may_be_meant_as_o() {
    assert_one(
        &of_text("02 T2", ElementClass::PathStart),
        "PB202 ",
        "if the zero is meant as the letter O, write \"O2\"",
    );
    assert_one(&of_text("02", ElementClass::Mill), "PB202 ", "values follow their letter without a space");
    assert_one(
        &of_text("12 T2", ElementClass::PathStart),
        "PB202 ",
        "values follow their letter without a space",
    );
}

#[test]
fn a_path_is_embedded_with_its_sign() {
    assert_one(
        &of_text("2050.1P", ElementClass::Subpath),
        "PB202 this is a path's name without",
        "write \">2050.1P\"",
    );
    assert_one(&of_text("> 2050.1P", ElementClass::Subpath), "PB202 ", "write \">2050.1P\"");
    assert_one(
        &of_text("5", ElementClass::Subpath),
        "PB202 a subpath does not accept \"5\"",
        "without a space",
    );
    // The sign `>` is already followed by its name.
    assert_one(
        &of_text(">2050.1P 5", ElementClass::Subpath),
        "PB202 ",
        "values follow their letter without a space",
    );
    assert_one(
        &of_text("2050.1P", ElementClass::Mill),
        "PB202 ",
        "values follow their letter without a space",
    );
}

#[test]
fn a_remark_is_no_parameter() {
    assert_one(
        &of_text("Deckel links", ElementClass::Mill),
        "PB202 \"Deckel links\" looks like a remark",
        "into the program",
    );
    assert_one(
        &of_text("Halter rechts, 2 St\u{fc}ck", ElementClass::Support),
        "PB202 \"Halter rechts, 2 St\u{fc}ck\" looks like a remark",
        "into the program",
    );
    assert_eq!(of_text("Deckel B1", ElementClass::Mill).len(), 1);
    assert_eq!(of_text("QTeil", ElementClass::Mill), [""; 0]);
    assert_eq!(
        of_text("Bx", ElementClass::Mill),
        [""; 0],
        "too short for a word: PB205, once there are values"
    );
}

/// Q is recommended only where it is accepted, and only once.
#[test]
fn a_comment_is_recommended_where_it_is_accepted() {
    for class in [ElementClass::Sweep, ElementClass::PathStart, ElementClass::Subpath, ElementClass::Probe] {
        assert_one(&of_text("hinten links", class), "PB202 ", "a remark to a layer without a path");
    }
    let word = |text: &str, class| of_text(text, class).concat();
    assert!(word("B1 rechts", ElementClass::Mill).ends_with("for example Qrechts"));
    assert!(
        word("B1 Qrechts aussen", ElementClass::Mill)
            .ends_with("for example Qrechts_aussen: a comment ends at the first space")
    );
    assert!(!word("T5 O2 tief", ElementClass::PathStart).contains('@'), "@ needs a text of its own");
    assert!(word("S7 hoch", ElementClass::Sweep).ends_with("or put it on a layer without a path"));
}

/// Upper case is recommended only where it makes the text valid.
#[test]
fn upper_case_is_recommended_where_it_helps() {
    assert_one(&of_text("s7", ElementClass::Sweep), "PB202 ", "\"S\"; a sweep accepts N, S");
    assert_one(&of_text("b2", ElementClass::Sweep), "PB202 ", "values follow their letter without a space");
    assert_one(&of_text("bohrung fertig", ElementClass::Mill), "PB202 \"bohrung fertig\" looks", "program");
    assert_one(
        &of_text("b2 f100", ElementClass::Mill),
        "PB202 ",
        "write \"B2 F100\", with upper-case letters",
    );
}

#[test]
fn at_names_a_path_with_parameters_of_its_own() {
    let found = |others: &str| {
        let drawing = format!("{}\n{others}", path("@1234.9P", "mill 0,0 40,0\nend 40,0"));
        messages_with_help(&compile(&drawing).found)
    };
    let of =
        |name: &str, text: &str| format!("layer {name}\nstart 0,50 \"{text}\"\nmill 0,50 40,50\nend 40,50\n");
    assert_one(
        &found(&(of("1234.2P", P) + &of("1234.3P", "@1234.2P"))),
        "PB208 there is no path 1234.9P",
        "name a path that has parameters of its own (1234.2P), or write the parameters here",
    );
    assert_one(
        &found(&of("1234.3P", "@1234.2P")),
        "PB208 there is no path 1234.9P",
        "write the parameters here; @ can only name a path of the same drawing",
    );
}

#[test]
fn a_variable_that_no_path_defines_is_not_recommended() {
    let found =
        |start: &str| messages_with_help(&compile(&path(start, "mill 0,0 20,0 \"B=X\"\nend 20,0")).found);
    assert_one(&found("T5 O3 I1"), "PB303 ", "for example :A-0.5~1.2 for =A");
    assert!(found("T5 O3 I1 :A0~1").concat().contains("start marker defines (A); a reference is ="));
    let number = messages_with_help(&compile(&path("T5 O3 I1", "mill 0,0 20,0 \"B=2\"\nend 20,0")).found);
    assert!(number.concat().contains("write \"B2\" for the number"), "{number:?}");
    let definition =
        messages_with_help(&compile(&path(&format!("{P} :A?"), "mill 0,0 20,0\nend 20,0")).found);
    assert_one(&definition, "PB301 \"?\" does not define", "or single characters (:C?PQRS)");
}

#[test]
fn a_single_bar_needs_a_smaller_length() {
    let bars = |u: &str| {
        let start = format!("T5 O3 I1 B0 D2 P8 U{u}");
        messages_with_help(&compile(&path(&start, "bars 0,0 20,0\nsweep 20,0 40,0\nend 40,0")).found)
    };
    assert_one(&bars("1"), "PB406 there are only 2 mm between support bars", "or shorten P");
    let single = compile(&path("T5 O3 I1 B0 D2 P18 U1", "bars 0,0 20,0\nsweep 20,0 40,0\nend 40,0")).found;
    assert_one(
        &messages_with_help(&single),
        "PB406 beside the support bar there are only 2 mm",
        "without bars",
    );
}

#[test]
fn a_special_space_is_named() {
    for space in ['\u{a0}', '\u{202f}', '\u{2009}'] {
        let drawn = format!("mill 0,0 20,0 \"B1{space}F100\"\nend 20,0");
        assert_one(
            &messages_with_help(&compile(&path(P, &drawn)).found),
            "PB205 B needs a number, not \"1\u{2423}F100\": \u{2423} is a special space",
            "an ordinary space instead",
        );
    }
}

#[test]
fn a_parameter_in_a_text_value_is_doubted() {
    for text in ["Qslot,B1", "Qslot;F100", "Q2/I0,5", "Qa:B-1", "Qslot\u{a0}B1", "Qslot,left,B1"] {
        assert_one(&of_text(text, ElementClass::Mill), "PB211 ", "without the sign before it");
    }
    for text in ["Qslot,left", "QB1", "Qslot B1", "Qslot,T2", "Qslot,Bx", "Qslot,Q1", "Qslot.B1"] {
        assert_eq!(of_text(text, ElementClass::Mill), [""; 0], "{text}");
    }
    assert_one(&of_text("LA,T2.5", ElementClass::Probe), "PB211 T2.5 belongs to the text of L", "before it");
}

#[test]
fn a_parameter_after_a_tilde_and_blanks_is_doubted() {
    for text in [
        "Qslot~\n B1",
        "Qslot~\n\tB1",
        "Qslot~\n\nB1",
        "Qslot~ \r\n B1 F100",
        "Qa~\nb~\n B1",
        "Qa~\n b~\n B1",
    ] {
        assert_one(
            &of_text(text, ElementClass::Mill),
            "PB211 B1 belongs to the text of Q",
            "without a space",
        );
    }
    for text in [
        "Qslot~\nB1",
        "Qslot~\r\nB1",
        "Qslot~\n left",
        "Qslot~\n T2",
        "Qslot~\n Bx",
        "Qslot~ B1",
        "Qslot\n B1",
    ] {
        let found = of_text(text, ElementClass::Mill);
        assert!(!found.iter().any(|found| found.contains("PB211")), "{text}: {found:?}");
    }
}

#[test]
fn a_value_above_0_has_an_example() {
    let found = messages_with_help(&compile(&path(P, "mill 0,0 20,0 \"F0\"\nend 20,0")).found);
    assert_one(&found, "PB203 F is 0", "for example F150");
    let example = |text: &str| {
        messages_with_help(&compile(&path(P, &format!("mill 0,0 20,0 {text:?}\nend 20,0"))).found)
    };
    assert_one(&example("W1x"), "PB205 W needs a number", "for example W0.3");
    assert_one(&example("B1x"), "PB205 B needs a number", "for example B-0.3");
    assert_one(
        &messages_with_help(&compile(&path("T5 O3 I1 B0 S1x", "mill 0,0 20,0\nend 20,0")).found),
        "PB205 S needs a number",
        "for example S5.5",
    );
}

#[test]
fn a_line_drawn_twice_is_not_an_end_marker_out_of_place() {
    let found = |drawn: &str| messages_with_help(&compile(&path(P, drawn)).found);
    assert_one(&found("mill 0,0 20,0\nmill 0,0 20,0\nend 20,0"), "PB403 ", "delete one of the two");
    assert_one(&found("mill 0,0 20,0\nmill 20,0 0,0\nend 20,0"), "PB403 ", "delete one of the two");
    assert_one(
        &found("mill 0,0 20,0\nmill 20,0 0,5\nend 20,0"),
        "PB403 the path runs past its end marker at (20, 0) and stops at (0, 5); draw the missing segments",
        "only if the path is to end there",
    );
    assert_one(
        &found("mill 0,0 20,0\nend 40,0"),
        "PB403 the path stops at (20, 0), but its end marker is at (40, 0); draw the missing segments",
        "only if the path is to end there",
    );
    // The last line of a closed outline is missing: its end is also its start.
    let open = found("mill 0,0 20,0\nmill 20,0 20,20\nend 0,0");
    assert_one(&open, "PB403 the path stops at (20, 20), but its end", "only if the path is to end there");
}

#[test]
fn a_dead_end_wants_a_turn_marker() {
    let found = |drawn: &str| messages_with_help(&compile(&path(P, drawn)).found);
    let branch = "mill 0,0 20,0\nmill 20,0 20,10\nmill 20,0 50,0\nend 50,0";
    assert_one(
        &found(branch),
        "PB401 the path breaks off here, at the tip of a dead end; segments not reached: 1; draw the segment that",
        "only if the tool is to go along it and back",
    );
    assert_one(
        &found("mill 0,0 20,0\nmill 20.2,0 50,0\nend 50,0"),
        "PB401 the path breaks off here;",
        "the path's layer",
    );
    // A line drawn twice leads back to its start.
    let twice = "mill 0,0 20,0\nmill 20,0 40,0\nmill 20,0 40,0\nmill 40,0 60,0 \"N9999\"\nend 60,0";
    assert_one(&found(twice), "PB401 a milling segment at (20, 0) is drawn twice", "delete one of the two");
}

#[test]
fn a_hole_along_a_line_wants_the_line_split() {
    let found = |drawn: &str| messages_with_help(&compile(&path(P, drawn)).found);
    assert_one(
        &found("mill 0,0 40,0\ncircle 20,0 d 3\nend 40,0"),
        "PB402 ",
        "split the line or arc at (20, 0)",
    );
    assert_one(
        &found("mill 0,0 40,0\ncircle 20,0.0005 d 3\nend 40,0"),
        "PB402 ",
        "split the line or arc at (20, 0.001)",
    );
    assert_one(
        &found("mill 0,0 40,0\ncircle 20,0.002 d 3\nend 40,0"),
        "PB402 ",
        "move them to another layer",
    );
    let arc = "mill arc centre 20,0 r 20 from 0 to 180\ncircle 20,20 d 3\nend 40,0";
    assert_one(&found(arc), "PB402 ", "split the line or arc at (20, 20)");
}

/// If two bars are too close, the second one is reported as well, because each must be corrected.
#[test]
fn the_same_fault_is_said_of_each_element() {
    let bars = "bars 0,0 8,0 \"D2 P2 U2\"\nbars 8,0 16,0 \"D2 P2 U2\"\nend 16,0";
    let found = compile(&path(P, bars)).found;
    let places: Vec<_> = found.iter().map(|it| (it.code().to_string(), it.place.point)).collect();
    assert_eq!(places.len(), 2, "{places:?}");
    assert!(places[0] != places[1] && places.iter().all(|(code, _)| code == "PB406"), "{places:?}");
}

/// Returns the codes of a drawing's findings, and their notes.
fn noted(drawing: &str) -> (Vec<String>, Vec<String>) {
    let found = compile(drawing).found;
    let codes = found.iter().map(|found| found.code().to_string()).collect();
    let notes = found.iter().flat_map(|found| &found.notes).map(|note| note.text(Lang::En)).collect();
    (codes, notes)
}

fn codes_of(shapes: &str) -> Vec<String> {
    noted(&path(P, shapes)).0
}

#[test]
fn a_line_without_length_is_left_over() {
    let with = |line: &str| codes_of(&format!("mill 0,0 20,0\n{line}\nsweep 20,0 40,0\nend 40,0"));
    for line in ["line CONTINUOUS 20,0 20,0", "line HIDDEN 20,0 20,0"] {
        assert_eq!(with(line), ["PB121"], "{line}");
    }
    // A program has three decimals, so a smaller difference is not visible in it.
    assert_eq!(codes_of("mill 0,0 20,0 20.0004,0\nend 20.0004,0"), ["PB121"]);
    assert_eq!(codes_of("sweep 0,0 20,0 20.0006,0\nmill 20.0006,0 40,0\nend 40,0"), [""; 0]);
}

#[test]
fn a_cut_of_almost_no_length_is_left_over() {
    let found = |length: f64| {
        messages_with_help(
            &compile(&path(P, &format!("mill 0,0 20,0\nmill 20,0 {x},0\nend {x},0", x = 20.0 + length)))
                .found,
        )
    };
    for length in [0.001, 0.002, 0.009] {
        let begin = format!("PB121 a line here is only {length} mm long");
        assert_one(&found(length), &begin, "it is milled with its own depth or that of the path");
    }
    assert_eq!(found(0.0101), [""; 0]);
    assert_eq!(codes_of("polyline CONTINUOUS 0,0 20,0 20.002,0\nend 20.002,0"), [""; 0], "one depth");
    let arc = |radius: f64| {
        codes_of(&format!("mill 0,0 20,0\nmill arc centre 20,0 r {radius} from 0 to 180\nend 0,0"))
    };
    assert!(arc(0.003).contains(&"PB121".to_owned()) && !arc(0.0033).contains(&"PB121".to_owned()));
}

/// A groove that leads to a dead end is drawn twice, so that the walk returns along the copy, which has no text.
#[test]
fn a_line_drawn_twice_is_milled_at_two_depths() {
    let groove =
        |copies: &str| codes_of(&format!("mill 0,0 40,0\n{copies}\nmill 40,0 60,0 \"N9999\"\nend 60,0"));
    let twice = |found: &[String]| found.iter().filter(|code| *code == "PB121").count();
    assert_eq!(twice(&groove("mill 40,0 40,20 \"B2\"\nmill 40,0 40,20")), 1);
    assert_eq!(twice(&groove("mill 40,0 40,20 \"B2\"\nmill 40,20 40,0")), 1);
    assert_eq!(
        twice(&groove("mill arc 40,0 to 40,20 centre 40,10\nmill arc 40,20 to 40,0 centre 40,10 cw")),
        1
    );
    // The two lines have different depths on purpose, or are two half circles, or a sweep returns along the line.
    assert_eq!(twice(&groove("mill 40,0 40,20 \"B2 N1\"\nmill 40,0 40,20 \"B1 N2\"")), 0);
    assert_eq!(groove("mill arc 40,0 to 40,20 centre 40,10\nmill arc 40,20 to 40,0 centre 40,10"), [""; 0]);
    assert_eq!(groove("mill 40,0 40,20 \"B2\"\nsweep 40,20 40,0"), [""; 0]);
    // The deeper of two line types removes what the other leaves, unless each has its own text.
    assert_eq!(twice(&groove("mill 40,0 40,20\nbars 40,20 40,0")), 1);
    assert_eq!(twice(&groove("mill 40,0 40,20 \"B2\"\nmark 40,20 40,0")), 1);
    assert_eq!(twice(&groove("mill 40,0 40,20 \"B2 N1\"\nbars 40,20 40,0 \"B0 N2\"")), 0);
    // Of three copies, the second and the third are reported.
    assert_eq!(twice(&codes_of(&format!("{}\nend 20,0", "mill 0,0 20,0\n".repeat(3)))), 2);
}

#[test]
fn the_halves_of_a_ring_are_not_one_arc() {
    let ring =
        "mill 0,0 20,0\nmill arc 40,0 to 40,20 centre 40,10\nmill arc 40,20 to 40,0 centre 40,10\nend 20,0";
    let found = messages_with_help(&compile(&path(P, ring)).found);
    assert_one(&found, "PB402 the path ends here; segments not", "move them to another layer");
    let twice = ring.replace("40,20 to 40,0 centre 40,10", "40,20 to 40,0 centre 40,10 cw");
    assert_one(
        &messages_with_help(&compile(&path(P, &twice)).found),
        "PB402 a milling segment at (40, 0) is drawn twice",
        "delete one of the two",
    );
}

/// The longer arm has no N, so the path takes the way to the end first and does not come back.
#[test]
fn a_dead_end_that_is_passed_wants_a_smaller_n() {
    let found = |way: &str, arm: &str| {
        let drawn = format!("mill 0,0 20,0\nmill 20,0 40,0{way}\nmill 20,0 20,30{arm}\nturn 20,30\nend 40,0");
        messages_with_help(&compile(&path(P, &drawn)).found)
    };
    let passed = found(" \"N1\"", " \"N2\"");
    assert_one(&passed, "PB402 segments not reached: 1; the path went past (20, 0)", "of 1.5 mm) there");
    assert_eq!(found(" \"N2\"", " \"N1\""), [""; 0]);
}

/// The arm may have the N of a text that is not read, so that the path did not go past it. Another letter does not put it first.
#[test]
fn an_arm_whose_n_is_not_read_is_not_told_to_get_one() {
    let found = |arm: &str| {
        let drawn = format!("mill 0,0 20,0\nmill 20,0 40,0\nmill 20,0 20,30{arm}\nturn 20,30\nend 40,0");
        codes_of(&drawn)
    };
    let beside = |string: &str| found(&format!("\ntext 30,15 \"{string}\" height 1 align centre middle"));
    assert_eq!(beside("N1"), ["PB107"]);
    assert_eq!(beside("F90"), ["PB107", "PB402"]);
    assert_eq!(found(" \"n1\""), ["PB202"]);
    assert_eq!(found(" \"f90\""), ["PB202", "PB402"]);
    assert_eq!(found(""), ["PB402"]);
}

/// A text near the start marker takes it before the text with O and T, which comes later.
#[test]
fn a_text_that_took_the_start_marker_is_told() {
    let notes = |near: &str| {
        let drawing = format!(
            "layer 1234.1P\nstart 0,0\nmill 0,0 40,0\nend 40,0\n{near}\nmtext 0,-0.2 \"T5 O3 I1 B0\" height 2 align top centre"
        );
        let found = compile(&drawing).found;
        let missing = found.iter().filter(|found| found.code().to_string() == "PB201");
        let notes = missing.flat_map(|found| &found.notes).map(|note| note.text(Lang::En));
        notes.collect::<Vec<_>>().concat()
    };
    let took = notes("text 0,0.2 \"B1\" height 2 align left baseline");
    assert!(took.contains("O and T are in the text \"T5 O3 I1 B0\" at (0, -0.2)"), "{took}");
    assert_eq!(notes("text 9,0.6 \"B1\" height 2 align left baseline"), "");
}

#[test]
fn a_subpath_drawn_twice_is_named() {
    let found = compile(&path(
        P,
        "mill 0,0 20,0\nsubpath 20,0 40,0 \">1234.1P\"\nsubpath 20,0 40,0 \">1234.1P\"\nend 40,0",
    ))
    .found;
    let found = messages_with_help(&found);
    let begin = "PB403 the path stops at (20, 0), but its end marker is at (40, 0): a subpath at (20, 0) is drawn twice";
    assert!(found.iter().any(|found| found.starts_with(begin)), "{found:?}");
}

/// Some programs export a circle as a closed polyline, or as one or two arcs.
#[test]
fn a_hole_drawn_as_arcs_is_named() {
    let with = |arcs: &str| {
        let text = format!("sweep 0,0 20,0\n{arcs}\nsweep 20,0 40,0\nend 40,0");
        messages_with_help(&compile(&path(P, &text)).found)
    };
    let half = "mill arc centre 20,0 r 4 from 0 to 180";
    for arcs in [
        format!("{half}\nmill arc centre 20,0 r 4 from 180 to 360"),
        "mill arc centre 20,0 r 4 from 0 to 360".to_owned(),
    ] {
        let found = with(&arcs);
        let is_named = |found: &String| {
            found.contains("form a circle of 8 mm around (20, 0)")
                && found.contains("draw a hole as a CIRCLE")
        };
        assert!(found.len() == 1 && is_named(&found[0]), "{found:?}");
    }
    for others in [half.to_owned(), format!("{half}\nmill arc centre 20,0 r 4 from 180 to 350")] {
        let found = with(&others);
        assert!(!found.is_empty() && !found.iter().any(|found| found.contains("form a circle")), "{found:?}");
    }
    // A round outline with a gap before it.
    let outline = "mill arc centre 20,50 r 4 from 0 to 180\nmill arc centre 20,50 r 4 from 180 to 360";
    let found = with(outline);
    assert!(!found.is_empty() && !found.iter().any(|found| found.contains("form a circle")), "{found:?}");
}

#[test]
fn a_circle_on_another_is_left_over() {
    let with = |circle: &str| codes_of(&format!("circle 0,0 d 3\n{circle}\nsweep 0,0 20,0\nend 20,0"));
    assert_eq!(with("circle 0,0 d 3"), ["PB121"]);
    assert_eq!(with("circle 0.0004,0 d 3"), ["PB121", "PB402"]);
    assert_eq!(with("circle 0,0 d 6"), [""; 0], "a counterbore");
}

#[test]
fn a_segment_that_begins_on_another_is_named() {
    let found = messages_with_help(&compile(&path(P, "mill 0,0 20,0\nmill 15,0 40,0\nend 40,0")).found);
    assert_one(
        &found,
        "PB401 the path breaks off here: a milling segment begins at (15, 0), in the middle of another segment",
        "so that the two meet end to end",
    );
    let found = messages_with_help(&compile(&path(P, "mill 0,0 20,0\nmill 20.1,0 40,0\nend 40,0")).found);
    assert_one(&found, "PB401 the path breaks off here; segments", "move it to the path's layer");
}

#[test]
fn a_sweep_drawn_twice_is_named() {
    let found = messages_with_help(
        &compile(&path(P, "mill 0,0 20,0\nsweep 20,0 40,0\nsweep 40,0 20,0\nmill 40,0 60,0\nend 60,0")).found,
    );
    assert_one(&found, "PB402 a sweep at (40, 0) is drawn twice", "delete one of the two");
    let outline = "bars 0,0 40,0 40,30 0,30 0,0";
    let found = messages_with_help(
        &compile(&path("T5 O3 I1 B0 D1 P4 U9", &format!("{outline}\n{outline}\nend 0,0"))).found,
    );
    assert_one(&found, "PB402 a segment with support bars at ", "delete one of the two");
    // A line that is milled in one direction and swept back is intended: an infeed is drawn in this way.
    assert_eq!(codes_of("mill 0,0 20,0\nsweep 20,0 0,0\nend 0,0"), [""; 0]);
}

#[test]
fn markers_that_lost_their_line_type_are_recognised() {
    let path = |start: &str, end: &str| {
        noted(&format!("layer 1234.1P\n{start} \"T5 O3 I1 B0\"\nmill 0,0 20,0 20,30\n{end}"))
    };
    let start = "the circle at (0, 0) has a text with O and T, but its line type is not PHANTOM; \
                 if it is meant as the start marker, draw it as a PHANTOM circle of 1 mm";
    let end = "the circle at (20, 30) has a diameter of 2 mm, but its line type is not PHANTOM: \
               is it meant as the end marker?";
    let strings = |strings: &[&str]| strings.iter().map(ToString::to_string).collect::<Vec<_>>();
    assert_eq!(path("circle 0,0 d 1", "end 20,30"), (strings(&["PB101"]), strings(&[start])));
    assert_eq!(
        path("circle 0,0 d 1", "circle 20,30 d 2"),
        (strings(&["PB101", "PB102"]), strings(&[start, end]))
    );
    // The circle nearly has a marker's diameter: only this is reported, and not its consequences.
    assert_eq!(path("circle PHANTOM 0,0 d 1.1", "circle PHANTOM 20,30 d 1.9").0, ["PB105", "PB105"]);
    assert_eq!(path("start 0,0", "circle PHANTOM 20,30 d 1.7").0, ["PB105", "PB102"]);
    // One circle is not both markers.
    assert!(path("circle PHANTOM 0,0 d 1.9", "").0.contains(&"PB102".to_owned()));
}

#[test]
fn a_second_text_on_an_element_says_so() {
    let second = |at: &str| {
        noted(&path(P, &format!("sweep 0,0 20,0\ncircle 20,0 d 5\ntext 20,-1 \"B1\" height 1\ntext {at} \"F50\" height 1\nend 20,0"))).1
    };
    assert_eq!(second("20,0.5"), ["a circle at (20, 0) already has a text: write all letters into one text"]);
    assert_eq!(second("20,9"), [""; 0], "it overlaps nothing");
    let equal = "mill 0,0 20,0\ntext 10,-0.3 \"B1\" height 1\ntext 10,-0.3 \"B1\" height 1\nend 20,0";
    assert_eq!(
        noted(&path(P, equal)).1,
        ["a line at (0, 0) already has the same text: delete one of the two"]
    );
    let polyline =
        "polyline 0,0 20,0 20,20\ntext 10,-0.3 \"B1\" height 1\ntext 19.7,10 \"B2\" height 1\nend 20,20";
    let explode = "is part of a polyline, which already has a text: explode the polyline if its parts need different texts";
    assert!(
        noted(&path(P, polyline)).1.iter().any(|note| note.ends_with(explode)),
        "{:?}",
        noted(&path(P, polyline)).1
    );
}

/// The gap is too small to be visible with three decimals.
#[test]
fn points_that_look_alike_are_told_apart() {
    let text = |drawing: &str| compile(&path(P, drawing)).found[0].text(Lang::En);
    assert_eq!(
        text("mill 0,0 20,0\nend 20,0.0004"),
        "the path stops at (20, 0), 0.0004 mm away from its end marker at (20, 0.0004)"
    );
    assert_eq!(
        text("mill 0,0 61.5,36.4996\nend 61.5,36.5"),
        "the path stops at (61.5, 36.4996), 0.0004 mm away from its end marker at (61.5, 36.5)"
    );
    let (_, notes) = noted(&path(P, "mill 0,0 20,0\nmill 20.0004,0 40,0\nend 40,0"));
    assert_eq!(notes, ["the nearest open end is at (20, 0), 0.0004 mm away (a milling segment)"]);
}

/// A marker that was drawn with the diameter of another one is called neither a second start nor a second end alone.
#[test]
fn a_marker_of_another_diameter_may_be_the_missing_one() {
    let found = |drawn: &str| {
        let found = compile(&path(P, drawn)).found;
        let notes = found.iter().flat_map(|found| &found.notes).map(|note| note.text(Lang::En));
        (messages_with_help(&found), notes.collect::<Vec<_>>().concat())
    };
    let (end, notes) = found("mill 0,0 20,0\ncircle PHANTOM 20,0 d 1");
    assert_one(&end, "PB102 path 1234.1P has no end marker", "");
    assert!(
        notes.starts_with("the circle at (20, 0) has the diameter of a start marker, 1 mm, but no text"),
        "{notes}"
    );
    // With the text of a start it is one.
    let (second, notes) = found("mill 0,0 20,0\nstart 20,0 \"T5 O3 I1 B0\"\nend 20,0");
    assert_one(&second, "PB103 path 1234.1P has a second start marker", "another path's layer");
    assert_eq!(notes, "");
    let branch = |marker: &str| {
        found(&format!("mill 0,0 20,0\nmill 20,0 20,10\nmill 20,0 50,0\nend 50,0\n{marker}")).0
    };
    assert_one(
        &branch("circle PHANTOM 20,10 d 1"),
        "PB103 path 1234.1P has a second circle with",
        "a diameter of 1.5 mm",
    );
    assert_one(
        &branch("circle PHANTOM 20,10 d 2"),
        "PB104 path 1234.1P has a second end",
        "a diameter of 1.5 mm",
    );
}

#[test]
fn a_subpath_that_is_drawn_twice_is_one_error() {
    let found = |second: &str| {
        let drawn = format!("subpath 0,0 20,0 \">1111.1P\"\n{second}\nend 20,0");
        messages_with_help(&compile(&path("T5 O3", &drawn)).found)
    };
    for second in ["subpath 0,0 20,0", "subpath 20,0 0,0"] {
        let problem = "PB501 this subpath is drawn twice: the text \">1111.1P\" belongs to the other one";
        assert_one(&found(second), problem, "delete one of the two");
    }
    for second in ["subpath arc 0,0 to 20,0 centre 10,0", "subpath 0,0 20.01,0", "sweep 0,0 20,0"] {
        assert!(!found(second).concat().contains("PB501"), "{second}");
    }
}

/// An outline that was pasted in its place. Its sides are 20 mm long, so that neither one side nor its copy has room for a gap.
#[test]
fn all_copies_of_an_outline_are_counted_once() {
    let bars = |lines: &str| lines.replace("mill", "bars");
    let side = "mill 0,0 20,0\nmill 20,0 20,20\n";
    let with = |copies: &str| {
        let shapes = format!("{side}mill 20,20 0,20\nmill 0,20 0,0\n{copies}sweep 0,0 -20,0\nend -20,0");
        noted(&path("T5 O3 I1 B0 D2 P3 U45", &bars(&shapes)))
    };
    let (codes, notes) = with("");
    assert_eq!((codes, notes.len()), (vec!["PB408".to_owned()], 0));
    let (codes, notes) = with(side);
    assert_eq!(
        notes.iter().filter(|note| note.starts_with("segments drawn on top of others: 2;")).count(),
        1
    );
    assert!(codes.iter().any(|code| code.starts_with("PB40")), "{codes:?}");
    let (_, notes) = with("mill 0,0 20,0\n");
    assert!(!notes.iter().any(|note| note.contains("on top of others")), "one copy: {notes:?}");
}

/// The errors about the markers prevent the walk, which would find the lines.
#[test]
fn a_path_that_was_pasted_twice_is_one_finding_beside_its_markers() {
    let lines = |count: usize| {
        "mill 0,0 20,0\nmill 20,0 20,20\nmill 20,20 40,20\n"
            .lines()
            .take(count)
            .collect::<Vec<_>>()
            .join("\n")
    };
    let found = |copies: &str| {
        let whole = path(P, &format!("{}\nend 40,20", lines(3)));
        let mut found = messages_with_help(&compile(&format!("{whole}\n{copies}")).found);
        found.retain(|found| found.starts_with("PB121"));
        found
    };
    let markers = "start 0,0 \"T5 O3 I1 B0\"\nend 40,20";
    let begin = "PB121 lines and arcs that are drawn twice: 3, the first at (0, 0)";
    assert_one(&found(&format!("{markers}\n{}", lines(3))), begin, "pasted twice");
    assert_one(&found(&format!("end 40,20\n{}", lines(3))), begin, "pasted twice");
    assert_one(
        &found(&format!("{markers}\n{}", lines(1))),
        "PB121 a milling segment at (0, 0) is drawn twice",
        "(a PHANTOM circle of 1.5 mm)",
    );
    assert_eq!(found(markers), [""; 0]);
}
