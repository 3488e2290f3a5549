//! The examples on the pages of `explain` give exactly the diagnostics that are noted in them.

mod support;

use pathbuild_diagnostic::{Code, example};
use support::fixture;

/// What is not built yet. Whoever builds it takes the code off this list: a code on it must still fail.
const NOT_YET: &[&str] = &["PB515", "PB516", "PB517"];

#[test]
fn every_example_gives_what_it_says() {
    let wrong: Vec<String> =
        Code::ALL.iter().filter_map(|code| example(*code).and_then(|text| verdict(*code, text))).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// What is wrong with an example.
fn verdict(code: Code, text: &str) -> Option<String> {
    let faults = fixture::faults(text);
    match (NOT_YET.contains(&&*code.to_string()), faults.is_empty()) {
        (true, true) => Some(format!("{code} works: take it off the list")),
        (false, false) => Some(format!("{code}:\n  {}", faults.join("\n  "))),
        (true, false) | (false, true) => None,
    }
}
