//! The language of control texts as tables for the book. (book: reference/post-definitions)

use pathbuild_diagnostic::{Lang, Text};

use super::control_text::ControlTextKind;
use super::definition::SETTINGS;
use super::evaluate::STATEMENTS;
use super::numbers::FORMS;
use super::term::{FUNCTIONS, LEVELS, Rule};
use super::variables::VARIABLES;
use crate::{Row, code};

/// Returns the rows of a table, or `None` if no table has this name.
pub(crate) fn table(name: &str, lang: Lang) -> Option<Vec<Row>> {
    let say = |text: Text| text.in_lang(lang).to_owned();
    Some(match name {
        "post-keys" => SETTINGS
            .iter()
            .map(|entry| vec![code(entry.name), say(*entry.expected), say(entry.about)])
            .collect(),
        "control-texts" => {
            ControlTextKind::ALL.iter().map(|kind| vec![code(kind.name()), say(kind.when())]).collect()
        }
        "control-variables" => VARIABLES
            .iter()
            .map(|entry| {
                vec![code(&format!("~{}~", entry.name)), say(entry.about), say(entry.presence.word())]
            })
            .collect(),
        "control-statements" => statements(lang),
        // The levels are listed from lowest to highest precedence.
        "control-operators" => LEVELS
            .iter()
            .map(|level| vec![level.iter().map(|operator| code(operator)).collect::<Vec<_>>().join(" ")])
            .collect(),
        "control-functions" => FUNCTIONS
            .iter()
            .map(|entry| {
                let arguments = match entry.rule {
                    Rule::One(_) => "x",
                    Rule::Two(_) => "x, y",
                    Rule::Any(_) => "x, ...",
                };
                vec![code(&format!("{}({arguments})", entry.name)), say(entry.about)]
            })
            .collect(),
        _ => return None,
    })
}

/// Returns a row for each statement, with its notation and result.
fn statements(lang: Lang) -> Vec<Row> {
    let row = |form: &str, about: &Text| vec![code(form), about.in_lang(lang).to_owned()];
    let others = STATEMENTS.iter().map(|entry| row(entry.form, &entry.about));
    let numbers = FORMS.iter().map(|(sign, _, about)| row(&format!("{{{sign}Term}}"), about));
    let shortest = row("{Term}", &SHORTEST);
    others.chain([shortest]).chain(numbers).chain([row("{f Term}", &AS_IN_C)]).collect()
}

const SHORTEST: Text =
    Text { en: "the number with all its decimals", de: "die Zahl mit allen Nachkommastellen" };
const AS_IN_C: Text = Text {
    en: "as in C, also with `g`, `d`, `x`, `b` or `s`; flags, width and precision come before the letter (an extension of pathbuild)",
    de: "wie in C, auch mit `g`, `d`, `x`, `b` oder `s`; Schalter, Breite und Genauigkeit stehen vor dem Buchstaben (Zusatz von pathbuild)",
};
