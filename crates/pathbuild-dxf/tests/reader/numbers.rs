//! Tests numbers as CAD programs write them. (book: reference/dxf: "numbers")

use pathbuild_dxf::Geometry;
use proptest::prelude::*;

use crate::support::{entities, faults, read_all};

/// Reads a number from a text, in the place of an angle, which may have any value.
fn number(text: &str) -> Result<f64, String> {
    let drawing = read_all(entities(&format!("0 TEXT\n8 A\n50 {text}\n10 0\n20 0\n40 1\n1 x")));
    match drawing.entities.first().map(|entity| &entity.geometry) {
        Some(Geometry::Text(text)) => Ok(text.rotation),
        _ => Err(faults(&drawing).join("; ")),
    }
}

#[test]
fn usual_forms_are_read() {
    for (text, value) in [
        ("1", 1.0),
        ("-1.5", -1.5),
        ("+1.5", 1.5),
        (".5", 0.5),
        ("-.5", -0.5),
        ("1.", 1.0),
        ("  7.25 ", 7.25),
        ("\t7.25", 7.25),
        ("1.0E+2", 100.0),
        ("1e-3", 0.001),
        ("1.0D+2", 100.0),
        ("1.5d-1", 0.15),
        ("000000000000000000000000012.5", 12.5),
        ("0.1000000000000000055511151231257827", 0.1),
        ("9007199254740993", 9_007_199_254_740_992.0),
        ("-9007199254740995", -9_007_199_254_740_996.0),
        ("9999999999999999", 1e16),
        ("9.99999999999999", 9.999_999_999_999_99),
    ] {
        assert_eq!(number(text), Ok(value), "{text:?}");
    }
}

#[test]
fn other_forms_are_errors() {
    for text in ["", " ", "x", "1x", "1 2", "-", ".", "-.", "1.2.3", "--1", "1e", "0x10", "1_000", "D2", "1D"]
    {
        let fault = format!("PB002 10 A: TEXT: group 50 must be a number, not \"{}\"", text.trim());
        assert_eq!(number(text), Err(fault), "{text:?}");
    }
}

#[test]
fn a_decimal_comma_is_named_as_such() {
    let fault = "PB002 10 A: TEXT: \"1,5\" in group 50 has a decimal comma, but DXF numbers need a point";
    assert_eq!(number("1,5"), Err(fault.into()));
    assert_eq!(number("1,5,0"), Err("PB002 10 A: TEXT: group 50 must be a number, not \"1,5,0\"".into()));
    let drawing = read_all(entities("0 CIRCLE\n8 A\n10 1,5\n20 0\n40 1"));
    let text = drawing.faults[0].diagnostic.text.as_ref().expect("the value");
    assert_eq!((&*text.text, text.span()), ("1,5", 1..2));
}

#[test]
fn numbers_that_are_not_finite_are_errors() {
    for text in ["nan", "NaN", "inf", "-inf", "infinity", "1e400", "-1e400", "1D999"] {
        let fault = format!("PB002 10 A: TEXT: \"{text}\" in group 50 is not a finite number");
        assert_eq!(number(text), Err(fault), "{text:?}");
    }
    assert_eq!(number("1e308"), Ok(1e308));
}

/// No machine reaches farther than a kilometre.
#[test]
fn coordinates_and_lengths_are_at_most_a_kilometre() {
    let is_sound = |entity: &str| read_all(entities(entity)).faults.is_empty();
    for (number, is_within) in
        [("1000000", true), ("-1000000", true), ("1000000.001", false), ("-1e37", false)]
    {
        assert_eq!(is_sound(&format!("0 CIRCLE\n8 A\n10 {number}\n20 0\n40 1")), is_within, "{number}");
        assert_eq!(is_sound(&format!("0 LINE\n8 A\n10 0\n20 0\n11 0\n21 {number}")), is_within, "{number}");
        assert_eq!(
            is_sound(&format!("0 ARC\n8 A\n10 0\n20 {number}\n40 1\n50 0\n51 9")),
            is_within,
            "{number}"
        );
        assert_eq!(is_sound(&format!("0 TEXT\n8 A\n10 {number}\n20 0\n40 1\n1 x")), is_within, "{number}");
    }
    for (length, is_within) in [("1000000", true), ("1000000.001", false), ("1e308", false)] {
        assert_eq!(is_sound(&format!("0 CIRCLE\n8 A\n10 0\n20 0\n40 {length}")), is_within, "{length}");
        assert_eq!(
            is_sound(&format!("0 ARC\n8 A\n10 0\n20 0\n40 {length}\n50 0\n51 9")),
            is_within,
            "{length}"
        );
        assert_eq!(is_sound(&format!("0 TEXT\n8 A\n10 0\n20 0\n40 {length}\n1 x")), is_within, "{length}");
        assert_eq!(is_sound(&format!("0 MTEXT\n8 A\n10 0\n20 0\n40 {length}\n1 x")), is_within, "{length}");
    }
    let fault = |layer: &str, line: u32, kind: &str, count: u32| {
        format!(
            "PB002 {line} {layer}: {kind} lies or reaches more than 1,000,000 mm from the origin, or its size is 0; \
             elements of this layer with such a problem: {count}"
        )
    };
    let circle = |layer: &str| format!("0 CIRCLE\n8 {layer}\n10 1e7\n20 0\n40 1\n");
    assert_eq!(faults(&read_all(entities(circle("A").trim_end()))), [fault("A", 5, "CIRCLE", 1)]);
    // A drawing far away is one finding for each layer.
    let drawn = ["0 LINE\n8 A\n10 1e7\n20 0\n11 0\n21 0\n".to_owned(), circle("B"), circle("A"), circle("A")]
        .concat();
    let expected = [fault("A", 5, "LINE", 3), fault("B", 17, "CIRCLE", 1)];
    assert_eq!(faults(&read_all(entities(drawn.trim_end()))), expected);
}

#[test]
fn whole_numbers_may_be_written_as_reals() {
    let flags = |text: &str| read_all(entities(&format!("0 TEXT\n8 A\n10 0\n20 0\n40 1\n1 x\n71 {text}")));
    for (text, is_sound) in
        [("2", true), (" 2 ", true), ("2.0", true), ("2.5", false), ("x", false), ("1e300", false)]
    {
        assert_eq!(flags(text).faults.is_empty(), is_sound, "{text:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    /// The fast path for plain decimals gives the same result as the general parser.
    #[test]
    fn decimals_are_exact(text in "-?[0-9]{0,16}(\\.[0-9]{0,16})?") {
        match text.parse::<f64>() {
            Ok(value) => prop_assert_eq!(number(&text).map(f64::to_bits), Ok(value.to_bits())),
            Err(_) => prop_assert!(number(&text).is_err()),
        }
    }

    #[test]
    fn printed_numbers_are_read_back(value in proptest::num::f64::NORMAL) {
        prop_assert_eq!(number(&format!("{value:?}")), Ok(value));
        prop_assert_eq!(number(&format!("{value:.6}")), format!("{value:.6}").parse().map_err(|_| String::new()));
    }
}
