//! Languages, texts in all of them, and the names of elements and moves in messages. (Glossary in book: reference/glossary)

use std::collections::{HashMap, HashSet};
use std::fmt::Display;
use std::sync::{LazyLock, Mutex, PoisonError};

use serde::{Deserialize, Deserializer, Serialize};

/// The languages of messages, help and pages.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Lang {
    /// English.
    #[default]
    En,
    /// German.
    De,
}

/// A text in every language: a word, a phrase or a sentence, with `{name}` in the place of an argument.
///
/// This is the only type of prose: a message takes prose as a `Text`, never as a string. Strings are for text from drawings
/// ([`Diagnostic::quoting`](crate::Diagnostic::quoting)).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
pub struct Text {
    /// The text in English.
    pub en: &'static str,
    /// The text in German.
    pub de: &'static str,
}

impl Text {
    /// Returns the text in one language, with its placeholders.
    pub fn in_lang(&self, lang: Lang) -> &'static str {
        lang.choose(self.en, self.de)
    }
}

impl Lang {
    /// Returns one of two values, depending on the language.
    pub fn choose<T>(self, en: T, de: T) -> T {
        match self {
            Self::En => en,
            Self::De => de,
        }
    }
}

/// Formats a count with thousands separators: `2,014`, in German `2.014`.
pub fn format_count(number: impl Display, lang: Lang) -> String {
    let separator = lang.choose(',', '.');
    let digits = number.to_string();
    let mut grouped = String::with_capacity(digits.len() + digits.len() / 3);
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            grouped.push(separator);
        }
        grouped.push(digit);
    }
    grouped
}

/// A noun in English and German, each in singular and plural.
pub type Noun = [[&'static str; 2]; 2];

/// Formats a count with its noun: `1 path`, `2,014 paths`.
pub fn counted(number: impl Display, [en, de]: Noun, lang: Lang) -> String {
    let [one, many] = lang.choose(en, de);
    let count = format_count(number, lang);
    let noun = if count == "1" { one } else { many };
    format!("{count} {noun}")
}

/// Declares texts, each with its documentation, and a list of all of them.
macro_rules! words {
    ($($(#[$doc:meta])* $key:ident: $en:literal, $de:literal;)*) => {
        $($(#[$doc])* pub static $key: crate::Text = crate::Text { en: $en, de: $de };)*

        pub(crate) static TEXTS: &[&crate::Text] = &[$(&$key),*];
    };
}
pub(crate) use words;

words! {
    /// Text for an empty list.
    NONE: "none", "keine";
    /// Name of the text of a start marker, which gives the path's own parameters.
    PATH_START: "a path start", "ein Pfadanfang";
    /// Name of a CONTINUOUS line or arc.
    MILLING_SEGMENT: "a milling segment", "ein Frässegment";
    /// Name of a DIVIDE line or arc.
    MARKING_SEGMENT: "a marking segment", "ein Markierungssegment";
    /// Name of a BORDER or CENTER line or arc.
    SUPPORT_SEGMENT: "a segment with support bars", "ein Segment mit Stützstegen";
    /// Name of a DASHED line or arc.
    SWEEP: "a sweep", "eine Leerfahrt";
    /// Name of a circle of the cutter's diameter.
    DRILLED_HOLE: "a drilled hole", "ein Bohrloch";
    /// Name of a hole to marking depth.
    DRILLED_MARK: "a drilled mark", "eine Bohrmarkierung";
    /// Name of a circle larger than the cutter.
    HELICAL_CIRCLE: "a helical circle", "ein Helixkreis";
    /// Name of a helical circle to marking depth.
    HELICAL_MARK: "a helical mark", "eine Helixmarkierung";
    /// Name of a helical circle with support bars.
    HELICAL_SUPPORT: "a helical circle with support bars", "ein Helixkreis mit Stützstegen";
    /// Name of a circle that may be a hole or a helical circle.
    CIRCLE: "a circle", "ein Kreis";
    /// Name of a DASHDOT line or arc.
    SUBPATH: "a subpath", "ein Unterpfad";
    /// Name of a PHANTOM circle of 6 mm.
    PROBE: "a Z-probe", "eine Z-Probe";
    /// Name of an element of any kind.
    ELEMENT: "an element", "ein Element";
    /// Elements that share the problem of a message, before their number.
    ELEMENTS_LIKE_THIS: "elements like this", "betroffene Elemente";
    /// Texts that share the problem of a message, before their number.
    TEXTS_LIKE_THIS: "texts like this", "betroffene Texte";
    /// Name of a line, whatever its meaning.
    LINE: "a line", "eine Linie";
    /// Name of an arc, whatever its meaning.
    ARC: "an arc", "ein Bogen";
    /// Formatting of a text: paragraphs with different alignments, or distributed ones.
    SEVERAL_ALIGNMENTS: "distributed or differently aligned paragraphs", "verteilte oder verschieden ausgerichtete Absätze";
    /// Formatting of a text: columns.
    COLUMNS: "columns", "Spalten";
    /// Formatting of a text: empty rows after its last letter.
    EMPTY_ROWS: "empty rows at its end", "leere Zeilen am Ende";
    /// Formatting of a text: letters of different heights.
    SEVERAL_HEIGHTS: "letters of different heights", "verschieden hohe Buchstaben";
    /// Formatting of a text: an indented paragraph.
    INDENT: "an indent", "einen Einzug";
    /// Formatting of a text: stacked characters, such as fractions.
    STACKED_CHARACTERS: "stacked characters", "gestapelte Zeichen";
    /// Formatting of a text: a tab.
    TAB: "a tab", "einen Tabulator";
    /// Name of a move with G00.
    RAPID_MOVE: "rapid move", "Eilgang";
    /// Name of a move straight down with G01.
    PLUNGE: "plunge", "Eintauchen";
    /// Name of a move with G01, G02 or G03.
    CUT: "cut", "Schnitt";
    /// Name of a move with G38.2 or G31.
    PROBING_MOVE: "probing move", "Antastbewegung";
    /// Unit of a drawing.
    INCHES: "inches", "Zoll";
    /// Unit of a drawing.
    CENTIMETRES: "centimetres", "Zentimetern";
    /// Unit of a drawing.
    METRES: "metres", "Metern";
    /// Source of a value: the element's own text.
    OWN_TEXT: "own text", "eigener Text";
    /// Source of a value: the text of the chain's first segment.
    CHAIN_TEXT: "first segment of the chain", "erstes Segment der Kette";
    /// Source of a value: the text of the path's start.
    PATH_TEXT: "text of the path", "Text des Pfads";
    /// Source of a value: the text of the path that @ names.
    LENDER_TEXT: "text of the path that @ names", "Text des Pfads, den @ nennt";
    /// Source of a value: an option or the configuration.
    OPTION: "option", "Option";
    /// Source of a value: the default.
    DEFAULT: "default", "Vorgabe";
    /// Place of a clamp in the drawing that a message is about.
    CLAMP_OF_DRAWING: "at {point}", "bei {point}";
    /// Place of a clamp that belongs to the drawing of an embedded path.
    CLAMP_OF_COMPONENT: "from {drawing} at {point} of this drawing", "aus {drawing} bei {point} dieser Zeichnung";
}

/// Deserializes a text as a `&'static Text`. Each distinct text is leaked once; there are only a few dozen.
pub(crate) fn interned_text<'de, D: Deserializer<'de>>(deserializer: D) -> Result<&'static Text, D::Error> {
    static INTERNED_TEXTS: LazyLock<Mutex<HashMap<(&'static str, &'static str), &'static Text>>> =
        LazyLock::new(Mutex::default);
    let (en, de) = <(&str, &str)>::deserialize(deserializer)?;
    let (en, de) = (interned_str(en), interned_str(de));
    let mut all = INTERNED_TEXTS.lock().unwrap_or_else(PoisonError::into_inner);
    Ok(all.entry((en, de)).or_insert_with(|| Box::leak(Box::new(Text { en, de }))))
}

/// Returns a copy of a text that lives until the process ends. Equal texts share one copy.
pub(crate) fn interned_str(text: &str) -> &'static str {
    static INTERNED_NAMES: LazyLock<Mutex<HashSet<&'static str>>> = LazyLock::new(Mutex::default);
    let mut all = INTERNED_NAMES.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(known) = all.get(text) {
        return known;
    }
    let leaked: &'static str = Box::leak(text.to_owned().into_boxed_str());
    all.insert(leaked);
    leaked
}
