//! Tests the output for each mistake, word for word, by running the examples of `explain`.

use crate::support::Place;
use insta::assert_snapshot;
use pathbuild_diagnostic::Code;
use pathbuild_testkit::Fixture;

/// Codes without an example: it would require a bug, or a block, which examples do not contain.
const WITHOUT_EXAMPLE: &[&str] = &["PB006", "PB525"];

fn examples() -> impl Iterator<Item = (String, Option<&'static str>)> {
    Code::ALL.iter().map(|code| (code.to_string(), code.example()))
}

#[test]
fn every_code_has_an_example() {
    let without = examples().filter(|(_, text)| text.is_none()).map(|(code, _)| code);
    assert_eq!(without.collect::<Vec<_>>(), WITHOUT_EXAMPLE);
}

#[test]
fn what_is_said_of_each_mistake() {
    for (code, text) in examples() {
        if let Some(text) = text {
            assert_snapshot!(code, said(text, &[]));
        }
    }
}

/// Messages differ between the languages: an untranslated text would be the same in both.
#[test]
fn each_mistake_is_told_in_german_too() {
    let is_told_alike = |text| messages(&said(text, &["--lang=de"])) == messages(&said(text, &[]));
    let told_alike = examples().filter(|(_, text)| text.is_some_and(is_told_alike)).map(|(code, _)| code);
    assert_eq!(told_alike.collect::<Vec<_>>(), Vec::<String>::new());
}

/// Returns the output of a fixture's commands.
fn said(text: &str, options: &[&str]) -> String {
    let place = Place::of(text);
    let fixture = Fixture::parse(text).unwrap();
    let runs = fixture.commands.iter().map(|command| {
        let arguments: Vec<&str> =
            command.arguments.iter().map(String::as_str).chain(options.iter().copied()).collect();
        place.run_with(&arguments).to_string()
    });
    runs.collect::<Vec<_>>().join("\n")
}

fn messages(said: &str) -> Vec<String> {
    let is_message = |line: &&str| line.starts_with("  × ") || line.starts_with("  ⚠ ");
    said.lines().filter(is_message).map(str::to_owned).collect()
}
