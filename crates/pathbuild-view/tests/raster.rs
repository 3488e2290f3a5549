//! PNG and PDF have letters: an empty font database gives pictures without any, silently.
#![cfg(feature = "pictures")]
#![allow(clippy::unwrap_used, reason = "a test that cannot set up has failed")]

use pathbuild_diagnostic::Lang;
use pathbuild_view::{Scene, Shown, pdf, png};

fn picture(title: &str) -> Vec<u8> {
    png(&Scene::new(title), Shown::all(Lang::En)).unwrap()
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
    let made = pdf(&Scene::new("Ø ß →"), Shown::all(Lang::En)).unwrap();
    let has = |part: &[u8]| made.windows(part.len()).any(|window| window == part);
    assert!(has(b"DejaVuSans") && has(b"/ToUnicode"));
}
