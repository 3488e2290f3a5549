//! Tests the plain text of an MTEXT. (book: language/parameter-texts)

use pathbuild_dxf::Geometry;

use crate::support::{entities, only_geometry};

fn plain(raw: &str) -> String {
    match only_geometry(entities(&format!("0 MTEXT\n8 A\n10 1\n20 2\n40 2.5\n1 {raw}"))) {
        Geometry::MText(text) => text.plain.to_string(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn the_end_of_a_text_is_never_lost() {
    assert_eq!(plain(r"\W1.135111;T3\PO2"), "T3\nO2");
    assert_eq!(plain(r"\PS5"), "\nS5");
    assert_eq!(plain(r"A\P"), "A\n");
    assert_eq!(plain(r"\W1.135081;M2x20\PO2\PT2\PI1,2\PB-0,3"), "M2x20\nO2\nT2\nI1,2\nB-0,3");
}

#[test]
fn line_breaks_and_tabs() {
    assert_eq!(plain(r"a\Pb\Xc\Nd^Je^M^Jf^Ig"), "a\nb\nc\nd\ne\nf\tg");
    assert_eq!(plain(r"a\pb"), r"a\pb");
}

#[test]
fn escaped_characters_stand_for_themselves() {
    assert_eq!(plain(r"a\\b\{c\}"), r"a\b{c}");
    assert_eq!(plain(r"a\\P"), r"a\P");
    assert_eq!(plain(r"a\~b"), "a\u{a0}b");
}

#[test]
fn switches_are_dropped() {
    assert_eq!(plain(r"\La\lb\Oc\od\kf"), "abcdf");
}

#[test]
fn what_is_struck_out_is_void() {
    assert_eq!(plain(r"B1 {\KF1000} I2"), "B1       I2");
    assert_eq!(plain(r"F1\K2\P\~\S1/2;^I\k3"), "F1 \n      3");
    assert_eq!(plain(r"\KB1"), "  ");
    // Braces limit the effect of both switches.
    assert_eq!(plain(r"{\Ka{\kb}c}d"), " b d");
    assert_eq!(plain(r"\Ka}b\kc"), "  c");
}

#[test]
fn stacked_texts_are_flat() {
    assert_eq!(plain(r"a\S1/2;b"), "a1/2b");
    assert_eq!(plain(r"a\S1#2;b"), "a1/2b");
    assert_eq!(plain(r"a\S+0.1^ -0.2;b"), "a+0.1-0.2b");
    assert_eq!(plain(r"a\S1^2;b"), "a1^2b");
    assert_eq!(plain(r"a\S1\;2\#3;b"), "a1;2#3b");
    assert_eq!(plain(r"a\S1/2"), "a1/2");
    assert_eq!(plain(r"a\S1\"), "a1");
}

#[test]
fn a_raised_or_lowered_digit_is_no_further_digit() {
    assert_eq!(plain(r"B1 F100{\H0.7x;\S1^ ;}"), "B1 F100^1");
    assert_eq!(plain(r"B1\S^ 5;"), "B1^5");
    assert_eq!(plain(r"B\S1^ ; \S2^ ;"), "B1 2");
    assert_eq!(plain(r"B1\Sst^ ;"), "B1st");
}

#[test]
fn commands_run_to_their_semicolon() {
    assert_eq!(plain(r"{\fArial|b0|i0;T3} \A1;\H2.5x;\C1;O2"), "T3 O2");
    assert_eq!(plain(r"\pxqc,t12;x"), "x");
    assert_eq!(plain(r"\Qü;x"), "x");
}

#[test]
fn a_command_without_its_semicolon_stays() {
    assert_eq!(plain(r"C:\x"), r"C:\x");
    assert_eq!(plain(r"T3\"), r"T3\");
    assert_eq!(plain(r"T3\W1.1 O2"), r"T3\W1.1 O2");
    // The code is after the last `;` in the first case, and before it in the second.
    assert_eq!(plain(r"\A1;T3\A1\A1"), r"T3\A1\A1");
    assert_eq!(plain(r"T3\A1\A1;"), "T3");
}

#[test]
fn braces_are_dropped_and_carets_decoded() {
    assert_eq!(plain("{a{b}c"), "abc");
    assert_eq!(plain("}a"), "a");
    assert_eq!(plain("a^ b"), "a^b");
    assert_eq!(plain("a^b^"), "a^b^");
    assert_eq!(plain(r"a^\Pb"), "a^\nb");
}

#[test]
fn signs_are_left_to_the_parameters() {
    assert_eq!(plain("%%c5 %%d %%p"), "%%c5 %%d %%p");
}
