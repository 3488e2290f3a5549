//! Line types, which determine the meaning of lines, arcs and circles. (book: language/line-types)

use std::collections::BTreeMap;

/// The line types with a meaning, by their usual names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[expect(missing_docs, reason = "the meaning depends on the entity: book: language/line-types")]
pub enum LineType {
    Continuous,
    Divide,
    Border,
    Center,
    Dashed,
    Hidden,
    Dashdot,
    Dot,
    Phantom,
}

/// Additional names of line types from the configuration, in upper case.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LineTypeAliases(BTreeMap<Box<str>, LineType>);

impl LineType {
    /// All line types with their names, in the order of the help.
    pub const NAMES: [(&str, Self); 9] = [
        ("CONTINUOUS", Self::Continuous),
        ("DIVIDE", Self::Divide),
        ("BORDER", Self::Border),
        ("CENTER", Self::Center),
        ("DASHED", Self::Dashed),
        ("HIDDEN", Self::Hidden),
        ("DASHDOT", Self::Dashdot),
        ("DOT", Self::Dot),
        ("PHANTOM", Self::Phantom),
    ];

    /// Returns the usual name, in upper case.
    pub fn name(self) -> &'static str {
        Self::NAMES.iter().find(|(_, known)| *known == self).map_or("", |(name, _)| name)
    }

    /// Returns the names of the line type in other programs and languages.
    pub fn other_names(self) -> impl Iterator<Item = &'static str> {
        names_in(ALIASES).filter(move |(_, known)| *known == self).map(|(name, _)| name)
    }

    /// Returns the line type that an unknown name in upper case most likely means: by the longest known word in the name, or else by the same
    /// beginning or a single typing error.
    pub fn guess(name: &str) -> Option<Self> {
        // Names such as `STRICH-PUNKT` and `STRICH PUNKT` mean `STRICHPUNKT`.
        let squeezed: String = name.chars().filter(|character| character.is_alphanumeric()).collect();
        let names = || Self::NAMES.into_iter().chain(names_in(ALIASES)).chain(names_in(NAME_PARTS));
        let in_name = names().filter(|(word, _)| {
            word.len() >= MIN_WORD_BYTES && (name.contains(word) || squeezed.contains(word))
        });
        let longest = in_name.max_by_key(|(word, _)| word.len());
        let abbreviated = || names().find(|(word, _)| name.len() >= MIN_WORD_BYTES && word.starts_with(name));
        let misspelt =
            || names().find(|(word, _)| word.len() > MIN_WORD_BYTES + 1 && differs_little(name, word));
        // A different digit in a numbered name is not a typing error.
        let misspelt = || misspelt().filter(|_| !name.bytes().any(|byte| byte.is_ascii_digit()));
        longest.or_else(abbreviated).or_else(misspelt).map(|(_, line_type)| line_type)
    }

    /// Returns the line type for a name in upper case: by an exact match, without a suffix, or through an alias. It is never guessed from the dash
    /// pattern, since DASHED2 and HIDDEN have the same pattern.
    pub fn of(name: &str, aliases: &LineTypeAliases) -> Option<Self> {
        let exact = |name: &str| aliases.0.get(name).copied().or_else(|| find_by_name(name));
        exact(name).or_else(|| SUFFIXES.iter().find_map(|suffix| exact(name.strip_suffix(suffix)?)))
    }
}

impl LineTypeAliases {
    /// Adds a name for a line type, in any case.
    pub fn insert(&mut self, name: &str, line_type: LineType) {
        self.0.insert(name.trim().to_uppercase().into(), line_type);
    }
}

/// Cache of the line types for the names in a drawing. There are few names, shared by many entities.
pub(crate) struct LineTypes<'l, 'd> {
    aliases: &'l LineTypeAliases,
    known: Vec<(&'d str, Option<LineType>)>,
}

impl<'l, 'd> LineTypes<'l, 'd> {
    pub(crate) fn new(aliases: &'l LineTypeAliases) -> Self {
        Self { aliases, known: Vec::new() }
    }

    /// Returns the line type for a name, from the cache if the name is known; `None` if the name is no line type.
    pub(crate) fn get(&mut self, name: &'d str) -> Option<LineType> {
        if let Some((_, line_type)) = self.known.iter().find(|(known, _)| *known == name) {
            return *line_type;
        }
        let line_type = LineType::of(name, self.aliases);
        if self.known.len() < MAX_CACHED_NAMES {
            self.known.push((name, line_type));
        }
        line_type
    }
}

/// Maximum number of cached names, more than a usual drawing has. Further names are looked up each time.
const MAX_CACHED_NAMES: usize = 32;

/// Suffixes, longest first: `DASHEDX2` must not be reduced to `DASHEDX`.
const SUFFIXES: [&str; 3] = ["TINY", "X2", "2"];

fn find_by_name(name: &str) -> Option<LineType> {
    let mut names = LineType::NAMES.into_iter().chain(names_in(ALIASES));
    names.find(|(known, _)| *known == name).map(|(_, line_type)| line_type)
}

fn names_in(table: &[(LineType, &[&'static str])]) -> impl Iterator<Item = (&'static str, LineType)> {
    table.iter().flat_map(|(line_type, names)| names.iter().map(|name| (*name, *line_type)))
}

/// Minimum length in bytes of a word by which a name is recognised.
const MIN_WORD_BYTES: usize = 3;

/// Whether two names differ by a missing, additional or different character, or by two transposed ones.
fn differs_little(name: &str, other: &str) -> bool {
    let (name, other): (Vec<char>, Vec<char>) = (name.chars().collect(), other.chars().collect());
    let same_start = name.iter().zip(&other).take_while(|(a, b)| a == b).count();
    let (name, other) = (&name[same_start..], &other[same_start..]);
    let same_end = name.iter().rev().zip(other.iter().rev()).take_while(|(a, b)| a == b).count();
    match (&name[..name.len() - same_end], &other[..other.len() - same_end]) {
        ([] | [_], [] | [_]) => true,
        ([a, b], [c, d]) => a == d && b == c,
        _ => false,
    }
}

/// Parts of names in several languages. They are used for suggestions only.
const NAME_PARTS: &[(LineType, &[&str])] = &[
    (LineType::Continuous, &["CONTINU", "KONTINU", "VOLL"]),
    (LineType::Divide, &["DIVI", "TEIL"]),
    (LineType::Border, &["BORD", "GRENZ", "RAHMEN", "KANTE"]),
    (LineType::Center, &["CENT", "MITTE", "ACHS", "AXE"]),
    (LineType::Dashdot, &["STRICHPUNKT"]),
    (LineType::Dashed, &["STRICH", "TRATT", "INTERROMP", "TIRET"]),
    (LineType::Hidden, &["CACHE", "OCULT", "VERSTECK", "UNSICHTBAR"]),
    (LineType::Dot, &["PUNKT", "POINT", "PUNT"]),
    (LineType::Phantom, &["FANT", "PHANT"]),
];

/// Names of the line types in other programs and languages (book: reference/dxf). ISO types are mapped as LibreCAD's import does; those of
/// AutoCAD Mechanical are ISO types by number.
const ALIASES: &[(LineType, &[&str])] = &[
    (LineType::Continuous, &["SOLID", "AUSGEZOGEN", "DURCHGEHEND", "FORTLAUFEND"]),
    (LineType::Divide, &["GETRENNT", "TEILEN", "GETEILT"]),
    (LineType::Border, &["RAND"]),
    (LineType::Center, &["MITTE", "CENTRO", "ОСЕВАЯ"]),
    (LineType::Dashed, &["GESTRICHELT", "STRICHLINIE", "TRATTEGGIATA", "ШТРИХОВАЯ"]),
    (LineType::Hidden, &["VERDECKT", "NASCOSTA"]),
    (LineType::Dashdot, &["STRICHPUNKT"]),
    (LineType::Dot, &["PUNKT", "DOTTED", "ПУНКТИРНАЯ"]),
    (LineType::Phantom, &["FANTASMA", "ONS_PHANTOM"]),
    (LineType::Dashdot, &["ONS_DASHDOT"]),
    (LineType::Dot, &["ONS_DOTTED"]),
    (LineType::Dashed, &["ACAD_ISO02W100", "ACAD_ISO03W100"]),
    (LineType::Dashdot, &["ACAD_ISO04W100"]),
    (LineType::Divide, &["ACAD_ISO05W100"]),
    (LineType::Dot, &["ACAD_ISO07W100"]),
    (LineType::Center, &["ACAD_ISO08W100"]),
    (LineType::Phantom, &["ACAD_ISO09W100"]),
    (LineType::Dashdot, &["ACAD_ISO10W100"]),
    (LineType::Divide, &["ACAD_ISO12W100"]),
    (LineType::Dashed, &["AM_ISO02W050"]),
    (LineType::Center, &["AM_ISO08W050"]),
    (LineType::Phantom, &["AM_ISO09W050"]),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_ones_own_have_the_same_endings() {
        let mut aliases = LineTypeAliases::default();
        aliases.insert("foo", LineType::Hidden);
        aliases.insert("Bar2", LineType::Divide);
        aliases.insert("DOT", LineType::Center);
        for (name, expected) in [
            ("FOO", Some(LineType::Hidden)),
            ("FOO2", Some(LineType::Hidden)),
            ("FOOX2", Some(LineType::Hidden)),
            ("FOO3", None),
            ("BAR2", Some(LineType::Divide)),
            ("BAR", None),
            ("DOT2", Some(LineType::Center)),
            ("HIDDEN2", Some(LineType::Hidden)),
        ] {
            assert_eq!(LineType::of(name, &aliases), expected, "{name}");
        }
    }
}
