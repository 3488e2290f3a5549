//! Tests messages: their keys, and the numbers, sentences and foreign texts in them.

use std::collections::BTreeSet;

use pathbuild_diagnostic::{Diagnostic, Lang, Number, Value, counted, limits, messages};

#[test]
fn each_message_has_a_key_of_its_own() {
    let mut keys = BTreeSet::new();
    let twice: Vec<&str> =
        messages::all().map(|message| message.key).filter(|key| !keys.insert(*key)).collect();
    assert!(twice.is_empty(), "{twice:?}");
    assert!(keys.len() > 100, "all of them are looked at");
}

/// A missing file and a missing parameter have different messages.
#[test]
fn messages_of_one_name_in_two_subjects_are_not_the_same() {
    assert_ne!(messages::files::MISSING, messages::parameters::MISSING);
    assert_ne!(messages::drawing::NOT_POSITIVE, messages::parameters::NOT_POSITIVE);
}

#[test]
fn numbers_of_one_message_are_told_apart() {
    let said = |diameter: f64, limit: f64| {
        let problem = Diagnostic::new(&messages::paths::HELIX_TOO_LARGE);
        problem.with("diameter", diameter).with("limit", limit).text(Lang::En)
    };
    assert!(said(8.0001, 8.0).contains("diameter 8.0001 mm is greater than A, which is 8"));
    assert!(said(8.001, 8.0).contains("diameter 8.001 mm is greater than A, which is 8"));
    assert!(said(8.000_000_01, 8.0).contains("diameter 8.00000001 mm"));
    assert!(said(8.000_000_000_01, 8.0).contains("diameter 8 mm"), "an invisible difference");
    assert!(said(8.0, 8.0).contains("diameter 8 mm"));
}

/// The error text of a dependency is English, so it is put in quotes in German messages.
#[test]
fn words_of_a_library_are_quoted_in_german() {
    let problem =
        Diagnostic::new(&messages::configuration::TOML_SYNTAX).with("reason", Value::foreign("invalid key"));
    assert_eq!(problem.text(Lang::En), "this is not valid TOML: invalid key");
    assert_eq!(problem.text(Lang::De), "das ist kein gültiges TOML: „invalid key“");
}

#[test]
fn a_sentence_within_a_message_is_in_its_language() {
    let problem = limits::file_too_large(17_219, 1000, "file-size");
    assert_eq!(problem.text(Lang::En), "the file's size of 17219 bytes exceeds the limit of 1000 bytes");
    assert_eq!(
        problem.text(Lang::De),
        "die Dateigröße von 17219 Bytes überschreitet die Grenze von 1000 Bytes"
    );
}

#[test]
fn a_noun_agrees_with_its_count() {
    let counted = |number: u64, lang| counted(number, [["arc", "arcs"], ["Bogen", "Bögen"]], lang);
    assert_eq!([0, 1, 2].map(|number| counted(number, Lang::En)), ["0 arcs", "1 arc", "2 arcs"]);
    assert_eq!(counted(1001, Lang::En), "1,001 arcs");
    assert_eq!([1, 1_000_000].map(|number| counted(number, Lang::De)), ["1 Bogen", "1.000.000 Bögen"]);
}

/// Numbers below 0.0005 are written with two significant digits and without powers of ten.
#[test]
fn small_numbers_are_no_powers_of_ten() {
    let shown = |number: f64| Number(number).to_string();
    assert_eq!(
        [0.0005, 0.000_499, 0.0004, -0.000_04, 0.000_012_34, 0.000_096, 2e-9, -5.3e-15].map(shown),
        ["0.001", "0.0005", "0.0004", "-0.00004", "0.000012", "0.000096", "0.000000002", "0"]
    );
}
