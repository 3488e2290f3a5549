//! The language of CamBam definitions as tables for the book. (book: reference/post-definitions)

use pathbuild_diagnostic::{Lang, Text};

use super::macros::{FIXED, Macro, WITH};
use super::options::OPTIONS;
use super::section::Section;
use crate::reference::{Row, code};

/// Elements that contain a template: name, whether it is an extension of pathbuild, default.
pub(crate) fn sections(lang: Lang) -> Vec<Row> {
    let own = |section: &Section| if section.is_own() { OWN.in_lang(lang) } else { "" }.to_owned();
    Section::ALL
        .iter()
        .map(|section| vec![code(section.name()), own(section), code(section.default_text())])
        .collect()
}

/// Elements that contain a value: name, permitted values, default, meaning.
pub(crate) fn options(lang: Lang) -> Vec<Row> {
    let row = |option: &super::options::ElementOption| {
        let own = if option.is_own() { format!("{}: ", OWN.in_lang(lang)) } else { String::new() };
        let about = format!("{own}{}", option.about.in_lang(lang));
        vec![
            code(option.element),
            option.expected().map_or("", |text| text.in_lang(lang)).to_owned(),
            code(option.default),
            about,
        ]
    };
    OPTIONS.iter().map(row).collect()
}

/// Macros without arguments: name, meaning.
pub(crate) fn macros(lang: Lang) -> Vec<Row> {
    FIXED.iter().map(|(name, what)| vec![code(&format!("{{${name}}}")), meaning(what, lang)]).collect()
}

/// Macros with arguments: name, permitted arguments.
pub(crate) fn macros_with_arguments(lang: Lang) -> Vec<Row> {
    WITH.iter()
        .map(|with| vec![code(&format!("{{${}(...)}}", with.name)), with.expected.in_lang(lang).to_owned()])
        .collect()
}

const OWN: Text = Text { en: "pathbuild's own", de: "Zusatz von pathbuild" };
const TEXT_OF: Text = Text { en: "the text of the element", de: "der Text des Elements" };
const SPEED: Text =
    Text { en: "`S` with the speed, if one is given", de: "`S` mit der Drehzahl, wenn eine vorliegt" };
const OPEN: Text = Text { en: "; a user macro may set it", de: "; ein eigenes Makro kann es setzen" };

fn meaning(what: &Macro, lang: Lang) -> String {
    match what {
        Macro::Section(section) => format!("{} `{}`", TEXT_OF.in_lang(lang), section.name()),
        Macro::Value(value) if value.is_open() => {
            format!("{}{}", value.word().in_lang(lang), OPEN.in_lang(lang))
        }
        Macro::Value(value) => value.word().in_lang(lang).to_owned(),
        Macro::Block(block) => block.word().in_lang(lang).to_owned(),
        Macro::State(state) => state.word().in_lang(lang).to_owned(),
        Macro::Choice(choice) => choice.word().in_lang(lang).to_owned(),
        Macro::Speed => SPEED.in_lang(lang).to_owned(),
        // The others have no fixed name: they take arguments, or are registers and codes.
        _ => String::new(),
    }
}
