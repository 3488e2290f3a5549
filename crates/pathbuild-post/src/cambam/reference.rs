//! The language of CamBam definitions as tables for the book. (book: reference/post-definitions)

use pathbuild_diagnostic::{Lang, Text};

use super::macros::{MACROS_WITH_ARGUMENTS, MACROS_WITHOUT_ARGUMENTS, Macro};
use super::options::{ElementOption, OPTIONS};
use super::section::Section;
use crate::{Row, code};

/// Returns the rows of a table, or `None` if no table has this name.
pub(crate) fn table(name: &str, lang: Lang) -> Option<Vec<Row>> {
    Some(match name {
        "cambam-sections" => sections(lang),
        "cambam-options" => OPTIONS.iter().map(|option| option_row(option, lang)).collect(),
        "cambam-macros" => MACROS_WITHOUT_ARGUMENTS
            .iter()
            .map(|(name, what)| vec![code(&format!("{{${name}}}")), meaning(what, lang)])
            .collect(),
        "cambam-calls" => MACROS_WITH_ARGUMENTS
            .iter()
            .map(|with| {
                vec![code(&format!("{{${}(...)}}", with.name)), with.expected.in_lang(lang).to_owned()]
            })
            .collect(),
        _ => return None,
    })
}

/// Returns a row for each element that contains a template: name, whether it is an extension of pathbuild, default.
fn sections(lang: Lang) -> Vec<Row> {
    let own = |section: &Section| {
        if section.is_own() { EXTENSION_OF_PATHBUILD.in_lang(lang) } else { "" }.to_owned()
    };
    Section::ALL
        .iter()
        .map(|section| vec![code(section.name()), own(section), code(section.default_text())])
        .collect()
}

/// Returns the row of an element that contains a value: name, permitted values, default, meaning.
fn option_row(option: &ElementOption, lang: Lang) -> Row {
    let own =
        if option.is_own() { format!("{}: ", EXTENSION_OF_PATHBUILD.in_lang(lang)) } else { String::new() };
    let expected = option.expected().map_or("", |text| text.in_lang(lang)).to_owned();
    let about = format!("{own}{}", option.about.in_lang(lang));
    vec![code(option.element), expected, code(option.default), about]
}

const EXTENSION_OF_PATHBUILD: Text = Text { en: "an extension of pathbuild", de: "Zusatz von pathbuild" };
const TEXT_OF: Text = Text { en: "the text of the element", de: "der Text des Elements" };
const SPEED: Text =
    Text { en: "`S` with the speed, if one is given", de: "`S` mit der Drehzahl, wenn eine vorliegt" };
const MAY_BE_SET: Text = Text { en: "; a user macro may set it", de: "; ein eigenes Makro kann es setzen" };

fn meaning(what: &Macro, lang: Lang) -> String {
    match what {
        Macro::Section(section) => format!("{} `{}`", TEXT_OF.in_lang(lang), section.name()),
        Macro::Value(value) if value.may_be_missing() => {
            format!("{}{}", value.word().in_lang(lang), MAY_BE_SET.in_lang(lang))
        }
        Macro::Value(value) => value.word().in_lang(lang).to_owned(),
        Macro::Block(block) => block.word().in_lang(lang).to_owned(),
        Macro::State(state) => state.word().in_lang(lang).to_owned(),
        Macro::Choice(choice) => choice.word().in_lang(lang).to_owned(),
        Macro::Speed => SPEED.in_lang(lang).to_owned(),
        // The other macros have no fixed name: they take arguments, or are registers and codes.
        _ => String::new(),
    }
}
