//! The examples on the pages of `explain` give exactly the diagnostics that are noted in them.

mod support;

use pathbuild_diagnostic::{Code, example};
use support::fixture;

/// What is not built yet. Whoever builds it takes the code off this list: a code on it must still fail.
const NOT_YET: &[&str] = &["PB515", "PB516", "PB517"];

#[test]
fn every_example_gives_what_it_says() {
    let mut wrong = String::new();
    for code in Code::ALL {
        let Some(text) = example(*code) else { continue };
        let faults = fixture::faults(text);
        let is_pending = NOT_YET.contains(&&*code.to_string());
        if is_pending && faults.is_empty() {
            wrong.push_str(&format!("{code} works: take it off the list\n"));
        } else if !is_pending && !faults.is_empty() {
            wrong.push_str(&format!("{code}:\n  {}\n", faults.join("\n  ")));
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}
