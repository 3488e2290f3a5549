//! PNG and PDF contain letters: with an empty font database, rendering silently omits them. Pages request nothing and do not interpret
//! texts as markup.
#![cfg(feature = "pictures")]
#![allow(clippy::unwrap_used, reason = "a test that cannot set up has failed")]

use pathbuild_diagnostic::Lang;
use pathbuild_view::{Scene, VisibleParts, page, pdf, png};

fn picture(title: &str) -> Vec<u8> {
    png(&Scene::new(title), VisibleParts::all(Lang::En)).unwrap()
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
    let made = pdf(&Scene::new("Ø ß →"), VisibleParts::all(Lang::En)).unwrap();
    let has = |part: &[u8]| made.windows(part.len()).any(|window| window == part);
    assert!(has(b"DejaVuSans") && has(b"/ToUnicode"));
}

#[test]
fn a_page_is_whole_and_takes_no_name_for_markup() {
    let title = "{{script}}</script><script>alert(1)</script>\u{2028}<!--";
    let made = page(&Scene::new(title), Lang::De);
    assert!(made.starts_with("<!doctype html>\n<html lang=\"de\">"));
    assert!(!made.contains("alert(1)</script>"));
    // One script element for the scene, and one with the code.
    assert_eq!((made.matches("<script").count(), made.matches("</script").count()), (2, 2));
    assert!(made.contains("default-src 'none'") && made.contains("data-word=\"rapids\""));
    assert_eq!(made, page(&Scene::new(title), Lang::De));
}
