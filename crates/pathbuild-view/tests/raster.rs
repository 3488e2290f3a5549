//! Tests that PNG and PDF files contain letters, which rendering silently omits if the font database is empty, and that pages request nothing and
//! do not interpret texts as markup.
#![cfg(feature = "pictures")]
#![allow(clippy::unwrap_used, reason = "a test that cannot set up has failed")]

use pathbuild_diagnostic::Lang;
use pathbuild_view::{BilingualText, Finding, Scene, VisibleParts, page, pdf, png, svg};

fn picture(title: &str) -> Vec<u8> {
    png(Scene::new(title), VisibleParts::all(Lang::En)).unwrap()
}

#[test]
fn letters_and_arrows_are_in_pictures() {
    let (nothing, unknown) = (picture(""), picture("\u{4e00}"));
    for letter in ["A", "Ø", "ß", "ä", "→", "↑", "①", "·"] {
        let seen = picture(letter);
        assert!(seen != nothing && seen != unknown, "{letter}");
    }
}

#[test]
fn a_pdf_brings_its_font() {
    let made = pdf(Scene::new("Ø ß →"), VisibleParts::all(Lang::En)).unwrap();
    let has = |part: &[u8]| made.windows(part.len()).any(|window| window == part);
    assert!(has(b"DejaVuSans") && has(b"/ToUnicode"));
}

#[test]
fn a_page_is_whole_and_takes_no_name_for_markup() {
    let title = "{{script}}</script><script>alert(1)</script>\u{2028}<!--";
    let made = page(&Scene::new(title), Lang::De);
    assert!(made.starts_with("<!doctype html>\n<html lang=\"de\">"));
    assert!(!made.contains("alert(1)</script>"));
    // A page has one script element for the scene, and one for the code.
    assert_eq!((made.matches("<script").count(), made.matches("</script").count()), (2, 2));
    assert!(made.contains("default-src 'none'") && made.contains("data-word=\"rapids\""));
    assert_eq!(made, page(&Scene::new(title), Lang::De));
}

/// The size of a picture must not depend on the number of findings: otherwise, the picture of a drawing with many mistakes would take a
/// megabyte of memory for each finding.
#[test]
fn a_picture_does_not_grow_with_the_number_of_findings() {
    let text = |text: &str| BilingualText { en: text.to_owned(), de: text.to_owned() };
    let finding = |number: usize| Finding {
        number,
        code: "PB107".to_owned(),
        is_error: true,
        message: text("the text belongs to no element"),
        help: text("delete it"),
        notes: Vec::new(),
        file: None,
        path: None,
        line: None,
        at: Some([(number % 50) as f64, (number / 50) as f64]),
    };
    let picture = |count: usize| {
        // The last finding is at the same position in all scenes.
        let findings = (1..count).chain([1999]).map(finding).collect();
        let scene = Scene { findings, ..Scene::new("x") };
        svg(&scene, VisibleParts::all(Lang::En))
    };
    let height =
        |svg: &str| svg.split("height=\"").nth(1).unwrap().split('"').next().unwrap().parse::<f64>().unwrap();
    let [few, most, more, many] = [19, 20, 21, 2000].map(picture);
    assert!(height(&few) < height(&most) && height(&most) < height(&more));
    assert!((height(&more) - height(&many)).abs() < 30.0, "{} {}", height(&more), height(&many));
    assert!(!most.contains("further findings") && more.contains("… 1 further finding"));
    assert!(
        many.contains("… 1980 further findings")
            && many.contains(">20</text>")
            && !many.contains(">21</text>")
    );
    assert_eq!(many.matches("r=\"13\"").count(), 1999);
}
