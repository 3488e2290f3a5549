//! Compares the names of layers without a meaning with those of paths, clamps and finished parts. (book: language/layers-and-names)

use std::collections::HashMap;

use crate::language::Language;
use crate::look_alikes;
use crate::names::{LayerPattern, PathName};

/// Maximum number of characters after a path name that are taken for a typing error.
const MAX_TYPO_CHARACTERS: usize = 2;

/// Words before or after the name of a layer that mark another version of its content, in English and German.
const VERSIONS: [&str; 8] = ["old", "new", "copy", "copy of", "alt", "neu", "Kopie", "Kopie von"];

/// Path names, for comparison with the names of other layers.
pub struct NearNames {
    /// Paths by their names, normalized with [`case_folded`].
    by_folded: HashMap<String, PathName>,
    /// Paths by their names without the letters at the end, such as `1234.1` for `1234.1P`, normalized as well.
    without_letters: HashMap<String, PathName>,
    /// Paths by their names without one of the characters, normalized as well.
    without_character: HashMap<String, PathName>,
    /// The words for versions, normalized like the names.
    versions: [String; 8],
}

impl NearNames {
    /// Collects the names of a drawing's paths.
    pub fn new<'n>(paths: impl Iterator<Item = &'n PathName>) -> Self {
        let (mut by_folded, mut without_letters, mut without_character) =
            (HashMap::new(), HashMap::new(), HashMap::new());
        for path in paths {
            let name = case_folded(path.as_str());
            let shorter = name.trim_end_matches(char::is_alphabetic);
            if !shorter.is_empty() {
                without_letters.insert(shorter.to_owned(), path.clone());
            }
            for (at, character) in name.char_indices() {
                let rest = [&name[..at], &name[at + character.len_utf8()..]].concat();
                without_character.insert(rest, path.clone());
            }
            by_folded.insert(name, path.clone());
        }
        Self { by_folded, without_letters, without_character, versions: VERSIONS.map(case_folded) }
    }

    /// Returns the path with a name that resembles the name of another layer: the layer has the path's name, followed by a tilde and any text, by at
    /// most two more characters, or by a word for another version, or has that word in front, or it lacks the letters at the end or any one
    /// character. Case and all characters but letters and digits are ignored; letters that look like digits are treated as those digits.
    pub fn path(&self, layer: &str) -> Option<&PathName> {
        let layer = case_folded(layer);
        let before_tilde = layer.find('~').and_then(|tilde| self.by_folded.get(&layer[..tilde]));
        let ends = layer.char_indices().rev().map(|(at, _)| at);
        let mut ends = std::iter::once(layer.len()).chain(ends).take(MAX_TYPO_CHARACTERS + 1);
        let version = || {
            let name = |word: &String| {
                let others = [layer.strip_suffix(word.as_str()), layer.strip_prefix(word.as_str())];
                others.into_iter().flatten().find_map(|name| self.by_folded.get(name))
            };
            self.versions.iter().find_map(name)
        };
        let longer = before_tilde.or_else(|| ends.find_map(|end| self.by_folded.get(&layer[..end])));
        let shorter = || self.without_letters.get(&layer).or_else(|| self.without_character.get(&layer));
        longer.or_else(version).or_else(shorter)
    }

    /// Returns the path with the longest name that is a proper prefix of another layer's name. Names are compared as in [`path`](Self::path).
    pub(super) fn path_at_beginning(&self, layer: &str) -> Option<&PathName> {
        let layer = case_folded(layer);
        layer.char_indices().rev().find_map(|(end, _)| self.by_folded.get(&layer[..end]))
    }
}

/// Normalizes a name for comparison: only letters, digits and tildes, in upper case, with look-alikes replaced by plain characters and digits.
fn case_folded(name: &str) -> String {
    let plain = look_alikes::plain_name(name);
    let tildes =
        plain.chars().map(|letter| if matches!(letter, '\u{2dc}' | '\u{223c}') { '~' } else { letter });
    let seen = tildes.filter(|letter| letter.is_alphanumeric() || *letter == '~');
    seen.flat_map(char::to_uppercase).collect()
}

/// The path or the kind of layer that a layer without a meaning resembles by its name.
pub(super) enum NearLayer<'n> {
    Path(&'n PathName),
    Clamps,
    Parts,
}

impl<'n> NearLayer<'n> {
    pub(super) fn of(layer: &str, names: &'n NearNames, language: &Language) -> Option<Self> {
        names.path(layer).map(Self::Path).or_else(|| Self::of_clamps_or_parts(layer, language))
    }

    fn of_clamps_or_parts(layer: &str, language: &Language) -> Option<Self> {
        if language.is_part(layer) {
            return None;
        }
        let names: Vec<&str> = std::iter::once(layer.trim_start())
            .chain(VERSIONS.iter().filter_map(|word| after_version(layer, word)))
            .filter(|name| {
                let first = name.chars().next().map(|first| look_alikes::ascii(first).unwrap_or(first));
                first.is_some_and(|first| language.may_begin_with(first))
            })
            .collect();
        if names.is_empty() {
            return None;
        }
        let similar: Vec<String> = names.iter().flat_map(|name| similar_names(name)).collect();
        let letters: String = language.patterns_beside_paths().map(LayerPattern::letters).collect();
        let longer: Vec<String> =
            names.iter().flat_map(|name| with_inserted_letter(name, &letters)).collect();
        let is_near = |is_layer: &dyn Fn(&str) -> bool| {
            // `Part.*` matches `Partameters`, but `Parameters` does not lack a `t`.
            let lacks_letter = |name: &String| {
                let before_last = name.char_indices().next_back().map_or("", |(last, _)| &name[..last]);
                is_layer(name) && !is_layer(before_last)
            };
            similar.iter().any(|name| is_layer(name)) || longer.iter().any(lacks_letter)
        };
        if is_near(&|name| language.is_keep_out(name)) {
            return Some(Self::Clamps);
        }
        is_near(&|name| language.is_part(name)).then_some(Self::Parts)
    }
}

/// Whether the name of a layer resembles that of a layer with clamps or finished parts. [`super::stray_findings`] reports the entities on such layers.
pub fn is_near_clamps_or_parts(layer: &str, language: &Language) -> bool {
    NearLayer::of_clamps_or_parts(layer, language).is_some()
}

/// Length in characters below which a name resembles too many others.
const MIN_NAME_CHARACTERS: usize = 4;

/// Returns the names that may have been meant by a layer's name: without a tilde and the text after it, without up to two characters or a word for
/// another version at the end, with the ending of a plural or a number, and with two neighbouring characters swapped. Look-alikes are replaced by
/// plain characters; one of the names has no spaces, and one has a space before its first digit.
fn similar_names(layer: &str) -> Vec<String> {
    let plain = look_alikes::with_keyboard_characters(layer);
    let plain = plain.split('~').next().unwrap_or_default().trim_end();
    let is_long = |name: &str| name.chars().count() >= MIN_NAME_CHARACTERS;
    if !is_long(plain) {
        return Vec::new();
    }
    let ends = plain.char_indices().rev().map(|(at, _)| at).take(MAX_TYPO_CHARACTERS);
    let shorter = std::iter::once(plain.len()).chain(ends).map(|end| plain[..end].trim_end());
    let shorter = shorter.filter(|name| is_long(name)).map(str::to_owned);
    let longer = PLURALS.iter().chain(&NUMBERS).map(|ending| [plain, ending].concat());
    let versions = VERSIONS.iter().filter_map(|word| without_version(plain, word));
    let others = versions.chain(with_swapped_characters(plain)).chain(with_space(plain));
    shorter.chain(longer).chain([plain.split_whitespace().collect()]).chain(others).collect()
}

/// Returns a name without this word for a version at its end: `Part` for `Part_OLD` and `Part (old)`. `None` if it does not end with the word.
fn without_version(name: &str, word: &str) -> Option<String> {
    let is_separator = |character: char| !character.is_alphanumeric();
    let name = name.trim_end_matches(is_separator);
    let (before, last) = name.split_at_checked(name.len().checked_sub(word.len())?)?;
    last.eq_ignore_ascii_case(word).then(|| before.trim_end_matches(is_separator).to_owned())
}

/// Returns a name without this word for a version in front of it: `Part` for `old Part` and `Kopie von Part`. `None` if it does not begin with the
/// word.
fn after_version<'n>(name: &'n str, word: &str) -> Option<&'n str> {
    let is_separator = |character: char| !character.is_alphanumeric();
    let (first, name) = name.trim_start_matches(is_separator).split_at_checked(word.len())?;
    first.eq_ignore_ascii_case(word).then(|| name.trim_start_matches(is_separator))
}

/// Returns the names with one of these letters inserted behind the first character: `Part` for `Par` and `Prt`.
fn with_inserted_letter(name: &str, letters: &str) -> Vec<String> {
    let plain = look_alikes::with_keyboard_characters(name);
    let plain = plain.trim_end();
    if plain.chars().count() + 1 < MIN_NAME_CHARACTERS {
        return Vec::new();
    }
    let places = plain.char_indices().skip(1).map(|(at, _)| at).chain([plain.len()]);
    let inserted =
        |at: usize| letters.chars().map(move |letter| format!("{}{letter}{}", &plain[..at], &plain[at..]));
    places.flat_map(inserted).collect()
}

/// Returns the names with two neighbouring characters swapped: `Part` for `Prat`.
fn with_swapped_characters(name: &str) -> impl Iterator<Item = String> {
    let characters: Vec<char> = name.chars().collect();
    (1..characters.len()).map(move |second| {
        let mut swapped = characters.clone();
        swapped.swap(second - 1, second);
        swapped.into_iter().collect()
    })
}

/// Returns a name with a space before its first digit, which must follow a letter: `Part 1` for `Part1`.
fn with_space(name: &str) -> Option<String> {
    let (letters, number) = name.split_at(name.find(|character: char| character.is_ascii_digit())?);
    letters.ends_with(char::is_alphabetic).then(|| format!("{letters} {number}"))
}

/// Endings of plurals, in English and German.
const PLURALS: [&str; 4] = ["s", "e", "n", "en"];

/// Numbers that a pattern may require after a name.
const NUMBERS: [&str; 3] = ["1", " 1", "_1"];
