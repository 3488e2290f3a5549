//! The pages of `explain`: every code has one in both languages, and all have the same structure.

use pathbuild_diagnostic::{Code, Lang};

/// Codes without an example: the first would require a bug, the second a block, which the tables of examples do not show.
const WITHOUT_EXAMPLE: [Code; 2] = [Code::InternalError, Code::MirroredSubpath];

fn codes() -> impl Iterator<Item = Code> {
    Code::ALL.iter().copied()
}

fn headings(page: &str) -> Vec<&str> {
    page.lines().filter(|line| line.starts_with("## ")).collect()
}

#[test]
fn every_code_has_a_page_in_both_languages() {
    for code in codes() {
        for (lang, expected) in [
            (Lang::En, ["## Usual causes", "## What to do", "## Example"]),
            (Lang::De, ["## Häufige Ursachen", "## Was hilft", "## Beispiel"]),
        ] {
            let page = code.page(lang);
            assert_eq!(page.lines().next(), Some(&*format!("# {code} {}", code.name())));
            let parts = if WITHOUT_EXAMPLE.contains(&code) { 2 } else { 3 };
            assert_eq!(headings(page), expected[..parts], "{code}");
        }
    }
}

#[test]
fn an_example_says_which_diagnostic_it_gives() {
    for code in codes().filter(|code| !WITHOUT_EXAMPLE.contains(code)) {
        let example = code.example().unwrap_or_else(|| panic!("{code} has no example"));
        assert!(example.starts_with("$ "), "{code} has no command");
        assert!(example.contains(&format!("#! {code}")), "{code} is not noted");
        for lang in [Lang::En, Lang::De] {
            let said = code.page(lang).contains(&format!("\n- {code}"));
            assert!(
                said,
                "{code} is not said in {lang:?}: PATHBUILD_UPDATE=1 cargo test --locked --test cli book::examples"
            );
        }
    }
}

#[test]
fn lines_fit_on_a_terminal() {
    for page in codes().flat_map(|code| [code.page(Lang::En), code.page(Lang::De)]) {
        for line in page.lines() {
            assert!(line.chars().count() <= 110, "{line}");
        }
    }
}
