//! Tests the content of parameter texts. (book: language/parameter-texts)

use pathbuild_diagnostic::{Code, Lang};
use pathbuild_path::{ElementClass, Letter, ParameterTexts, parse_integer, parse_number};

use crate::support::{codes, compile, path, raw, wrong};

/// Returns the pieces of a text: letters with their values, and `?` for other characters.
fn pieces(text: &str) -> Vec<String> {
    let texts = ParameterTexts::from(text);
    let text = texts.first().unwrap();
    let piece = |piece: &pathbuild_path::LetterValue| {
        format!("{}={}", piece.letter.map_or('?', Letter::as_char), text.value(piece))
    };
    text.pieces().iter().map(piece).collect()
}

#[test]
fn the_first_piece_of_a_letter_is_found_however_many_come_before() {
    for before in [0, 1, 65_534, 65_535, 65_536, 70_000] {
        let texts = ParameterTexts::from(&*("F1 ".repeat(before) + "B2 B3 T4"));
        let text = texts.first().unwrap();
        let first = |letter| text.piece(letter).map(|piece| text.value(piece));
        assert_eq!(
            (first(Letter::B), first(Letter::T), first(Letter::D)),
            (Some("2"), Some("4"), None),
            "{before}"
        );
        assert_eq!(first(Letter::F).is_some(), before > 0);
    }
}

#[test]
fn pieces_are_separated_by_blanks_and_line_breaks() {
    for blank in [" ", "   ", "\t", "\n", "\r\n", " \n\t "] {
        assert_eq!(pieces(&format!("{blank}B-0,3{blank}Qa.b{blank}")), ["B=-0,3", "Q=a.b"]);
    }
    assert_eq!(pieces(""), [""; 0]);
}

/// A comment contains non-breaking spaces, because ordinary ones would end it.
#[test]
fn a_non_breaking_space_separates_nothing() {
    assert_eq!(pieces("Qa\u{a0}b B1"), ["Q=a\u{a0}b", "B=1"]);
}

#[test]
fn a_tilde_at_a_lines_end_continues_the_value() {
    assert_eq!(pieces("Qlong~\nvalue B1"), ["Q=longvalue", "B=1"]);
    assert_eq!(pieces("Qlong~\r\n \t value B1"), ["Q=longvalue", "B=1"]);
    assert_eq!(pieces("Qlong~\n\n\nvalue"), ["Q=longvalue"]);
    assert_eq!(pieces("Qone~\ntwo~\nthree"), ["Q=onetwothree"]);
    // In other positions, a tilde is an ordinary character.
    assert_eq!(pieces(":a1~2 Qx~"), [":=a1~2", "Q=x~"]);
    assert_eq!(pieces("Qlong~ B1"), ["Q=long~", "B=1"]);
}

/// Spaces after a tilde are invisible in a CAD program.
#[test]
fn a_tilde_and_blanks_at_a_lines_end_continue_the_value() {
    for blanks in [" ", "  ", "\t", " \t ", "\u{a0}", "\u{2003}"] {
        assert_eq!(pieces(&format!(":a1,~{blanks}\n 2 B1")), [":=a1,2", "B=1"], "{blanks:?}");
        assert_eq!(pieces(&format!(":a1,~{blanks}\r\n2")), [":=a1,2"], "{blanks:?}");
    }
    assert_eq!(pieces(":a1,~  2"), [":=a1,~", "?="]);
    assert_eq!(pieces(":a1,~  "), [":=a1,~"]);
    assert_eq!(pieces("Qa~ ~\nb"), ["Q=a~", "?="]);
    // The beginning of the next line belongs to the value.
    assert_eq!(pieces("Qa~ \n\u{a0}b"), ["Q=a\u{a0}b"]);
}

#[test]
fn the_first_character_is_the_letter() {
    assert_eq!(pieces(">1234.1P @x :a1 B"), [">=1234.1P", "@=x", ":=a1", "B="]);
    assert_eq!(pieces("ß1 b1 _D"), ["?=1", "?=1", "?=D"]);
}

#[test]
fn percent_codes_are_replaced() {
    let text = |codes: &str| {
        let raw = raw(&path("T5 O3 I1 B0", &format!("mill 0,0 40,0 \"Q{codes}\"\nend 40,0")));
        raw.drawn.text(raw.drawn.elements[0].text).unwrap().as_str().to_owned()
    };
    assert_eq!(text("%%c%%d%%p"), "Q_D_G_+");
    assert_eq!(text("%%C%%D%%P"), "Q_D_G_+");
    assert_eq!(text("5%%%c"), "Q5%_D");
    assert_eq!(text("%%ua%%U%%ob%%O"), "Qab");
    assert_eq!(text("%%k%%"), "Q%%k%%");
}

/// Tests long and short texts, recent and earlier ones, in a path with more texts than a new one is compared with.
#[test]
fn each_element_has_the_text_that_is_drawn_beside_it() {
    let same = |length: usize| "a".repeat(length);
    let texts: Vec<String> = (0..25)
        .flat_map(|length| ["x", "y", "x"].map(|last| format!("Q{}{last}", same(length))))
        .chain([0, 24].map(|length| format!("Q{}x", same(length))))
        .collect();
    let line = |(number, text): (usize, &String)| {
        let from = 50 * number;
        format!("mill {from},0 {},0 \"{text}\"\n", from + 50)
    };
    let lines: String = texts.iter().enumerate().map(line).collect();
    let raw = raw(&path("T5 O3 I1 B0", &format!("{lines}end {},0", 50 * texts.len())));
    let text = |element: &pathbuild_path::Element| raw.drawn.text(element.text).unwrap().as_str();
    assert_eq!(raw.drawn.elements.iter().map(text).collect::<Vec<_>>(), texts);
}

fn problems_of(text: &str, class: ElementClass) -> Vec<pathbuild_diagnostic::Diagnostic> {
    ParameterTexts::from(text).first().unwrap().problems(class)
}

fn problems(text: &str) -> Vec<String> {
    codes(&problems_of(text, ElementClass::Mill))
}

#[test]
fn a_letter_stands_once_in_a_text() {
    assert_eq!(problems("B1 F100"), [""; 0]);
    assert_eq!(problems("B1 F100 B1"), ["PB204 B"]);
    let variables = |text: &str| codes(&problems_of(text, ElementClass::PathStart));
    assert_eq!(variables(":a1~2 :b1~2"), [""; 0]);
    assert_eq!(variables(":a1~2 :b1~2 :a3~4"), ["PB204"]);
}

#[test]
fn letters_are_upper_case_and_the_help_says_so() {
    let found = problems_of("b1", ElementClass::Mill);
    assert_eq!(codes(&found), ["PB202 b"]);
    assert!(found[0].help(Lang::En).unwrap().starts_with("write letters in upper case: \"B\";"));
    let found = problems_of("X1", ElementClass::Mill);
    assert_eq!(
        found[0].help(Lang::En).unwrap(),
        "use one of B, F, I, N, Q, W; values follow their letter without a space"
    );
}

#[test]
fn the_offending_piece_is_underlined() {
    let found = problems_of("F100 X1 B0", ElementClass::Mill);
    let text = found[0].text.as_ref().unwrap();
    assert_eq!(&text.text[text.span()], "X1");
}

#[test]
fn n_o_and_at_use_no_variables() {
    let start = |parameters: &str| wrong(&path(parameters, "mill 0,0 40,0\nend 40,0"));
    assert_eq!(start("T=a O3 I1 B0 :a5~6"), [""; 0]);
    assert_eq!(start("T5 O=a I1 B0 :a5~6"), ["PB206 O"]);
    assert_eq!(start("@=a"), ["PB208"]);
    let mill = |text: &str| wrong(&path("T5 O3 I1 B0 :a1~2", &format!("mill 0,0 40,0 \"{text}\"\nend 40,0")));
    assert_eq!(mill("B=a"), [""; 0]);
    assert_eq!(mill("N=a"), ["PB206 N"]);
}

#[test]
fn numbers_have_a_sign_digits_and_one_mark() {
    for (text, number) in
        [("5", 5.0), ("-0,3", -0.3), ("+1.25", 1.25), ("007", 7.0), (".5", 0.5), ("5.", 5.0), ("-,5", -0.5)]
    {
        assert_eq!(parse_number(text), Some(number), "{text}");
    }
    let wrong = [
        "", "-", "+-1", "1e3", "1.2.3", "1,2.3", "1'000", "1 000", "0x10", "inf", "NaN", "٣", "1_0", ".", ",",
    ];
    for text in wrong {
        assert_eq!(parse_number(text), None, "{text}");
    }
    assert_eq!(parse_number(&"9".repeat(308)).map(f64::is_finite), Some(true));
    assert_eq!(parse_number(&"9".repeat(310)), None);
}

#[test]
fn n_is_a_whole_number() {
    assert_eq!(
        (parse_integer("12"), parse_integer("-3"), parse_integer("+4")),
        (Some(12), Some(-3), Some(4))
    );
    for text in ["1.5", "1,0", "1.", "", "a", "99999999999999999999"] {
        assert_eq!(parse_integer(text), None, "{text}");
    }
    let mill = |text: &str| wrong(&path("T5 O3 I1 B0", &format!("mill 0,0 40,0 \"{text}\"\nend 40,0")));
    assert_eq!(mill("N1"), [""; 0]);
    assert_eq!(mill("N1.5"), ["PB205 N"]);
}

/// A value that is not a number is not reported as missing as well.
#[test]
fn what_is_no_number_is_reported_alone() {
    let mill = |text: &str| wrong(&path("T5 O3 I1", &format!("mill 0,0 40,0 \"{text}\"\nend 40,0")));
    assert_eq!(mill("B1"), [""; 0]);
    assert_eq!(mill("Bx"), ["PB205 B"]);
    assert_eq!(mill("F1"), ["PB201 B"]);
    assert_eq!(wrong(&path("Tx O3 I1 B0", "mill 0,0 40,0\nend 40,0")), ["PB205 T"]);
    // An invalid value is not compared with its limits either.
    assert_eq!(wrong(&path("T5 O3 I1 Bx S4", "mill 0,0 40,0\nend 40,0")), ["PB205 B", "PB203 S"]);
}

#[test]
fn a_start_has_a_text() {
    assert_eq!(wrong("layer 1234.1P\nstart 0,0\nmill 0,0 40,0\nend 40,0"), ["PB207"]);
}

/// The middle of a text decides to which element it belongs, even if the text begins on the start marker.
#[test]
fn a_long_start_text_is_told_where_its_middle_is() {
    let said = |at: &str, rest: &str| {
        let start = "\"O2 T2 I0.5 F150 B-0.2 D1 P4 U10\" height 2.5 align left baseline";
        let compiled = compile(&format!("layer 1234.1P\nstart 0,0\ntext {at} {start}\n{rest}"));
        let found = compiled.found.iter().find(|found| found.code() == Code::MissingPathParameters);
        found.expect("PB207").notes[0].text(Lang::En)
    };
    let hole = "sweep 0,0 35,10\ncircle 35,10 d 2\nend 35,10";
    assert!(
        said("0,0", hole).contains("its middle is at (23.25, 1.25): move it so that its middle lies on"),
        "{}",
        said("0,0", hole)
    );
    assert!(said("0,0", &hole.replace("d 2", "d 8")).contains("its middle is at (23.25, 1.25)"));
    assert!(said("0,40", "mill 0,0 40,0\nend 40,0").contains("its middle is at (23.25, 41.25)"));
}

#[test]
fn e_is_a_regular_expression() {
    let e = |text: &str| wrong(&path(&format!("T5 O3 I1 B0 E{text}"), "mill 0,0 40,0\nend 40,0"));
    assert_eq!(e("^20[0-9]+"), [""; 0]);
    assert_eq!(e("20[0-9"), ["PB209"]);
}

#[test]
fn other_values_are_taken_as_they_are() {
    let compiled = compile(&path("T5 O3 I1 B0 Rx-1 MÄ", "mill 0,0 40,0 \"Qa,b\"\nend 40,0"));
    let path = compiled.path.unwrap();
    assert_eq!((&*path.output_suffix, path.material.as_deref()), ("x-1", Some("Ä")));
}
