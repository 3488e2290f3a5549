//! The language of control texts as tables for the book. (book: reference/post-definitions)

use pathbuild_diagnostic::{Lang, Text};

use super::control_text::ControlTextKind;
use super::definition::SETTINGS;
use super::evaluate::STATEMENTS;
use super::numbers::FORMS;
use super::term::{FUNCTIONS, LEVELS, Rule};
use super::variables::VARIABLES;
use crate::reference::{Row, code};

/// The keys of `[post]`: name, permitted values, meaning.
pub(crate) fn settings(lang: Lang) -> Vec<Row> {
    let row = |entry: &super::definition::Setting| {
        vec![code(entry.name), entry.expected.in_lang(lang).to_owned(), entry.about.in_lang(lang).to_owned()]
    };
    SETTINGS.iter().map(row).collect()
}

/// The keys of `[text]`: name, when the text is called.
pub(crate) fn texts(lang: Lang) -> Vec<Row> {
    let row = |kind: &ControlTextKind| vec![code(kind.name()), kind.when().in_lang(lang).to_owned()];
    ControlTextKind::ALL.iter().map(row).collect()
}

/// The variables: name, content, where they are available.
pub(crate) fn variables(lang: Lang) -> Vec<Row> {
    let row = |entry: &super::variables::Variable| {
        let presence = entry.presence.word().in_lang(lang).to_owned();
        vec![code(&format!("~{}~", entry.name)), entry.about.in_lang(lang).to_owned(), presence]
    };
    VARIABLES.iter().map(row).collect()
}

/// The statements: notation, result.
pub(crate) fn statements(lang: Lang) -> Vec<Row> {
    let others = STATEMENTS.iter().map(|entry| vec![code(entry.form), entry.about.in_lang(lang).to_owned()]);
    let shortest = vec![code("{Term}"), SHORTEST.in_lang(lang).to_owned()];
    let numbers = FORMS
        .iter()
        .map(|(sign, _, about)| vec![code(&format!("{{{sign}Term}}")), about.in_lang(lang).to_owned()]);
    let as_in_c = vec![code("{f Term}"), AS_IN_C.in_lang(lang).to_owned()];
    others.chain([shortest]).chain(numbers).chain([as_in_c]).collect()
}

/// The operators, from lowest to highest precedence.
pub(crate) fn operators() -> Vec<Row> {
    let level = |level: &&[&str]| level.iter().map(|operator| code(operator)).collect::<Vec<_>>().join(" ");
    LEVELS.iter().map(|operators| vec![level(operators)]).collect()
}

/// The functions: notation, result.
pub(crate) fn functions(lang: Lang) -> Vec<Row> {
    let arguments = |rule| match rule {
        Rule::One(_) => "x",
        Rule::Two(_) => "x, y",
        Rule::Any(_) => "x, ...",
    };
    let row = |entry: &super::term::Function| {
        vec![
            code(&format!("{}({})", entry.name, arguments(entry.rule))),
            entry.about.in_lang(lang).to_owned(),
        ]
    };
    FUNCTIONS.iter().map(row).collect()
}

const SHORTEST: Text =
    Text { en: "the number with all its decimals", de: "die Zahl mit allen Nachkommastellen" };
const AS_IN_C: Text = Text {
    en: "as in C, also with `g`, `d`, `x`, `b` or `s`; flags, width and precision come before the letter (pathbuild's own)",
    de: "wie in C, auch mit `g`, `d`, `x`, `b` oder `s`; Schalter, Breite und Genauigkeit stehen vor dem Buchstaben (Zusatz von pathbuild)",
};
