//! Tests the circle by which a text is matched with its element. (book: language/parameter-texts)

use pathbuild_dxf::{HorizontalAlign, MText, Point3, Text, VerticalAlign};
use pathbuild_path::TextCircle;

const ANCHOR: Point3 = Point3 { x: 100.0, y: 200.0, z: 0.0 };

/// Returns a text of ten characters with a height of 2 mm: w = 12.
fn text() -> Text {
    Text {
        string: "0123456789".into(),
        anchor: ANCHOR,
        height: 2.0,
        rotation: 0.0,
        horizontal: HorizontalAlign::Left,
        vertical: VerticalAlign::Baseline,
        backwards: false,
        upside_down: false,
        counts_invisible: false,
    }
}

/// Returns a text of two lines of at most ten characters with a height of 2 mm: w = 12, H = 4.
fn mtext() -> MText {
    MText {
        plain: "0123456789\n012".into(),
        anchor: ANCHOR,
        height: 2.0,
        width: None,
        rotation: 0.0,
        horizontal: HorizontalAlign::Left,
        vertical: VerticalAlign::Top,
        paragraphs: HorizontalAlign::Left,
        obstacle: None,
        counts_invisible: false,
    }
}

/// Returns the centre of a text's circle relative to the anchor.
fn offset(circle: TextCircle) -> (f64, f64) {
    let round = |number: f64| (number * 1e9).round() / 1e9;
    (round(circle.centre.x - ANCHOR.x), round(circle.centre.y - ANCHOR.y))
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-12
}

#[test]
fn the_radius_of_a_text_is_half_its_diagonal() {
    assert!(close(TextCircle::of_text(&text()).radius, (12.0_f64 * 12.0 + 4.0).sqrt() / 2.0));
}

#[test]
fn the_radius_of_an_mtext_is_half_its_diagonal_but_at_most_0_7_of_its_height() {
    assert!(close(TextCircle::of_mtext(&mtext()).radius, 0.7 * 4.0));
    let narrow = MText { plain: "012\n012".into(), ..mtext() };
    assert!(close(TextCircle::of_mtext(&narrow).radius, (3.6_f64 * 3.6 + 16.0).sqrt() / 2.0));
    let one_line = MText { plain: "0".into(), ..mtext() };
    assert!(close(TextCircle::of_mtext(&one_line).radius, (1.2_f64 * 1.2 + 4.0).sqrt() / 2.0));
}

#[test]
fn rows_longer_than_the_width_are_broken_at_blanks() {
    let size = |plain: &str, width: f64| {
        let text = MText { plain: plain.into(), width: Some(width), ..mtext() };
        let unbroken = |plain: &str| TextCircle::of_mtext(&MText { plain: plain.into(), ..mtext() });
        move |rows: &str| TextCircle::of_mtext(&text) == unbroken(rows)
    };
    // A character is 1.2 mm wide: nine of them take 10.8 mm.
    assert!(size("B4.5 F50 QTeil-Eins", 10.8)("B4.5 F50\nQTeil-Eins"));
    assert!(size("B4.5 F50 Q", 9.6)("B4.5 F50\nQ"), "just room for eight");
    assert!(size("B4.5 F50 Q", 9.5)("B4.5\nF50 Q"), "just none");
    assert!(size("B4.5 QTeil-Eins-Zwei B", 6.0)("B4.5\nQTeil-Eins-Zwei\nB"), "a word is never broken");
    assert!(size("B1\nC2 D3", 3.0)("B1\nC2\nD3"), "each line by itself");
    assert!(size("B4.5 F50", 100.0)("B4.5 F50"));
}

#[test]
fn alignment_moves_the_centre() {
    let horizontal =
        [(HorizontalAlign::Left, 6.0), (HorizontalAlign::Centre, 0.0), (HorizontalAlign::Right, -6.0)];
    let vertical = [
        (VerticalAlign::Baseline, 0.5),
        (VerticalAlign::Bottom, 0.5),
        (VerticalAlign::Middle, 0.0),
        (VerticalAlign::Top, -0.5),
    ];
    for (horizontal, x) in horizontal {
        for (vertical, up) in vertical {
            let one_line = TextCircle::of_text(&Text { horizontal, vertical, ..text() });
            assert_eq!(offset(one_line), (x, 2.0 * up), "TEXT {horizontal:?} {vertical:?}");
            let paragraphs = horizontal;
            let two_lines = TextCircle::of_mtext(&MText { horizontal, vertical, paragraphs, ..mtext() });
            assert_eq!(offset(two_lines), (x, 4.0 * up), "MTEXT {horizontal:?} {vertical:?}");
        }
    }
}

#[test]
fn rotation_turns_the_offset() {
    let turned = |rotation| offset(TextCircle::of_text(&Text { rotation, ..text() }));
    assert_eq!(turned(90.0), (-1.0, 6.0));
    assert_eq!(turned(180.0), (-6.0, -1.0));
    assert_eq!(turned(-90.0), (1.0, -6.0));
    assert_eq!(turned(450.0), (-1.0, 6.0));
    assert_eq!(offset(TextCircle::of_mtext(&MText { rotation: 90.0, ..mtext() })), (2.0, 6.0));
}

#[test]
fn mirrored_texts_mirror_the_offset() {
    let drawn =
        |backwards, upside_down| offset(TextCircle::of_text(&Text { backwards, upside_down, ..text() }));
    assert_eq!(drawn(true, false), (-6.0, 1.0));
    assert_eq!(drawn(false, true), (6.0, -1.0));
    assert_eq!(drawn(true, true), (-6.0, -1.0));
    // The text is mirrored first and then rotated.
    let turned = Text { backwards: true, rotation: 90.0, ..text() };
    assert_eq!(offset(TextCircle::of_text(&turned)), (-1.0, -6.0));
}

#[test]
fn paragraphs_are_aligned_within_the_width() {
    let sides = [HorizontalAlign::Left, HorizontalAlign::Centre, HorizontalAlign::Right];
    let x = |horizontal, paragraphs| {
        offset(TextCircle::of_mtext(&MText { horizontal, paragraphs, width: Some(60.0), ..mtext() })).0
    };
    // The text is 12 mm wide. Its box is 0 to 60, -30 to 30, or -60 to 0.
    for (horizontal, expected) in
        sides.into_iter().zip([[6.0, 30.0, 54.0], [-24.0, 0.0, 24.0], [-54.0, -30.0, -6.0]])
    {
        assert_eq!(sides.map(|paragraphs| x(horizontal, paragraphs)), expected, "{horizontal:?}");
    }
}

#[test]
fn blanks_at_the_ends_do_not_count() {
    let text_of = |string: &str, counts_invisible| {
        TextCircle::of_text(&Text { string: string.into(), counts_invisible, ..text() })
    };
    assert_eq!(text_of("0123456789 \u{a0}\t ", false), text_of("0123456789", false));
    // A character is 1.2 mm wide.
    let indented = text_of("  01234567", false);
    assert_eq!(offset(indented), (7.2, 1.0));
    assert_eq!(indented.radius, text_of("01234567", false).radius);
    assert_eq!(text_of("  012345  ", true), text_of("0123456789", true));
    assert_eq!(text_of("   ", false), text_of("   ", true), "nothing but blanks");
    let right = Text { string: "  01234567  ".into(), horizontal: HorizontalAlign::Right, ..text() };
    assert_eq!(offset(TextCircle::of_text(&right)), (-4.8, 1.0));
}

#[test]
fn blanks_and_empty_rows_at_the_ends_of_an_mtext_do_not_count() {
    let circle = |plain: &str, counts_invisible| {
        TextCircle::of_mtext(&MText { plain: plain.into(), counts_invisible, ..mtext() })
    };
    assert_eq!(circle("012  \n0 ", false), circle("012\n0", false));
    assert_eq!(circle("012\n\n \n", false), circle("012", false));
    // The second row is seen; the first and the third count for the height of the box.
    let (seen, alone) = (circle(" \n012\n", false), circle("012", false));
    assert_eq!((offset(seen), seen.radius), ((1.8, -3.0), alone.radius));
    assert_eq!(offset(circle("  01\n  012", false)), (4.2, -2.0));
    assert_eq!(offset(circle("  01\n 012", false)), (3.0, -2.0), "indented by one");
    assert_eq!(circle("01  \n ", true), circle("0123\n0", true));
    assert_eq!(circle(" \n ", false), circle(" \n ", true), "nothing but blanks");
    // Blanks at the end of a row start no other row.
    let narrow = MText { plain: "B4.5 F50   ".into(), width: Some(9.6), ..mtext() };
    assert_eq!(TextCircle::of_mtext(&narrow), circle("B4.5 F50", false));
}

/// `%%d` is displayed as one character, and `%%u` underlines; PathDxf2GCode counts both as three characters.
#[test]
fn a_percent_code_counts_as_displayed() {
    let text_of = |string: &str, counts_invisible| {
        TextCircle::of_text(&Text { string: string.into(), counts_invisible, ..text() })
    };
    assert_eq!(text_of("%%u1234567%%d%%U", false), text_of("12345678", false));
    assert_eq!(text_of("1234567%%d", true), text_of("0123456789", true));
    let mtext_of = |plain: &str, counts_invisible| {
        TextCircle::of_mtext(&MText { plain: plain.into(), counts_invisible, ..mtext() })
    };
    assert_eq!(mtext_of("%%u1234567%%d%%u\n012", false), mtext_of("12345678\n012", false));
    assert_eq!(mtext_of("1234567%%d\n012", true), mtext_of("0123456789\n012", true));
}

/// The length is in characters, not in bytes.
#[test]
fn every_character_counts_once() {
    let umlauts = Text { string: "äöüß€äöüß€".into(), ..text() };
    assert_eq!(offset(TextCircle::of_text(&umlauts)), (6.0, 1.0));
}
