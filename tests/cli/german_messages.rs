//! Checks that no German message contains an English sentence. (book: reference/diagnostics)

use std::sync::LazyLock;

use pathbuild_diagnostic::{Code, messages, texts};
use pathbuild_testkit::Fixture;
use regex::Regex;

use crate::support::Place;
use crate::support::fixture::findings;

/// Words that are common in English sentences and do not exist in German ones.
const ENGLISH: &[&str] = &[
    "and", "are", "be", "been", "but", "by", "can", "cannot", "does", "each", "for", "from", "has", "have",
    "is", "it", "its", "longer", "no", "not", "of", "or", "than", "that", "the", "there", "these", "this",
    "to", "which", "with", "without", "expected", "invalid", "missing",
];

/// Parts of a text that are not prose: input, quotations, and names of files.
static TYPED: LazyLock<Regex> = LazyLock::new(|| {
    Regex::new(r#"`[^`]*`|"[^"]*"|„[^“]*“|«[^»]*»|\{[^}]*\}|--?[-a-z]+|\S*[./\\]\S+"#).unwrap()
});

/// Returns the first English word of a German text.
fn english(text: &str) -> Option<String> {
    let prose = TYPED.replace_all(text, " ").into_owned();
    let mut words = prose.split(|c: char| !c.is_alphanumeric());
    let word = words.find(|word| ENGLISH.contains(word))?;
    Some(format!("{word:?} in {text:?}"))
}

#[track_caller]
fn assert_german<S: AsRef<str>>(texts: impl IntoIterator<Item = S>) -> usize {
    let mut count = 0;
    let found: Vec<String> =
        texts.into_iter().inspect(|_| count += 1).filter_map(|text| english(text.as_ref())).collect();
    assert!(found.is_empty(), "{found:#?}");
    count
}

/// Returns the German findings of a fixture's commands, with their help.
fn german_findings(text: &str) -> Vec<String> {
    let place = Place::of(text);
    let run = |arguments: Vec<&str>| {
        let run = place.run_with(&[&["--format=json", "--no-cache", "--lang=de"], &*arguments].concat());
        let texts = findings(&run).into_iter().flat_map(|finding| {
            ["message", "help"].map(|key| finding[key].as_str().unwrap_or_default().to_owned())
        });
        texts.collect::<Vec<_>>()
    };
    let commands = Fixture::parse(text).unwrap().commands;
    commands.iter().flat_map(|command| run(command.arguments.iter().map(String::as_str).collect())).collect()
}

#[test]
fn english_is_recognised() {
    assert_eq!(english("die Datei überschreitet die Grenze von 1000 Bytes"), None);
    assert_eq!(english("das ist kein gültiges TOML: „this is quoted“; did you mean `the key`?"), None);
    assert!(english("the file's size of 17219 bytes überschreitet die Grenze").is_some());
}

#[test]
fn the_catalogue_is_german() {
    let sentences = messages::all().flat_map(|message| [message.text.de, message.help.de]);
    assert!(assert_german(sentences.chain(texts().map(|text| text.de))) > 1000);
}

#[test]
fn the_examples_of_all_codes_are_told_in_german() {
    let told: Vec<String> =
        Code::ALL.iter().filter_map(|code| code.example()).flat_map(german_findings).collect();
    assert!(assert_german(told) > 300);
}

/// Each message is a sentence within another one, or contains words of a library.
#[test]
fn configurations_that_are_wrong_are_told_in_german() {
    let drawing =
        "== 1234.1P.dxf ==\nlayer 1234.1P\nstart 0,0 \"T5 O2 I1 B0 MPlate\"\nmill 0,0 40,0\nend 40,0\n";
    let keys = [
        "[limits]\nfile-size = 100",
        "[limits]\nembedding-moves = 5\n[machine]\nz-split = 0.1",
        "feed = 1 2",
        "feed = \"fast\"",
        "path-pattern = '('",
        "restrict = ['(:x']",
        "restrict = ['x']",
        "exclude = ['{']",
        "exclude = ['[']",
        "library = ['nowhere']",
        "lang = 'fr'",
        "severity = { PB999 = 'error' }",
        "severity = { PB101 = 'off' }",
        "unknown = 1",
        "[unknown]\nkey = 1",
        "post = 'nothing'",
        "post = 'nowhere.toml'",
        "[limits]\nseconds-per-path = 'x'",
        "[tool.2]\nindex = 'x'",
        "feed = [",
        "= 1",
        "feed = 1\nfeed = 2",
        "feed = nan",
    ];
    for keys in keys {
        let fixture = format!("$ check .\n$ emit .\n== pathbuild.toml ==\n{keys}\n{drawing}");
        let texts = german_findings(&fixture);
        assert!(!texts.is_empty(), "{keys} is not wrong");
        assert_german(texts);
    }
    let long = "x".repeat(20_000);
    let told = german_findings(&format!("$ check .\n== .gitignore ==\n{long}\n{drawing}"));
    assert!(!told.is_empty());
    assert_german(told);
}

#[test]
fn options_that_are_wrong_are_told_in_german() {
    let place = Place::of("== 1234.1P.dxf ==\nlayer 1234.1P\nstart 0,0 \"T5 O2 I1 B0 MX\"\nend 0,0\n");
    let commands = [
        "check . --path-pattern (",
        "check . --restrict (:x",
        "check . --feed fast",
        "emit 1234.1P --post nothing",
        "emit 1234.1P --post nowhere.toml",
        "check nowhere.dxf",
        "check . --baseline nowhere.txt",
        "check . --config nowhere.toml",
        "gcode nowhere.nc",
        "list (",
    ];
    for command in commands {
        let run = place.run(&format!("{command} --lang de --format concise --no-cache"));
        assert_german(run.stderr.lines().chain(run.stdout.lines()));
    }
}
