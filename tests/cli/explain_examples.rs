//! Checks that the examples on the pages of `explain` give exactly the diagnostics that are noted in them.

use crate::support::fixture;
use pathbuild_diagnostic::Code;

#[test]
fn every_example_gives_what_it_says() {
    let wrong: Vec<String> =
        Code::ALL.iter().filter_map(|code| code.example().and_then(|text| verdict(*code, text))).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Returns the fault of an example, if it has one.
fn verdict(code: Code, text: &str) -> Option<String> {
    let faults = fixture::faults(text);
    (!faults.is_empty()).then(|| format!("{code}:\n  {}", faults.join("\n  ")))
}
