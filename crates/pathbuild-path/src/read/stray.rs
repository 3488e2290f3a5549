//! Finds entities that were drawn for a path, a clamp or a finished part, but on a layer that does not belong to it: texts on other layers (PB119),
//! and layers with similar names (PB120). (book: language/layers-and-names, book: language/parameter-texts, book: language/keep-outs)

use std::collections::{BTreeMap, HashMap};

use pathbuild_diagnostic::messages::drawing as messages;
use pathbuild_diagnostic::{Diagnostic, Value};
use pathbuild_dxf::{Drawing, Geometry, OmittedCurve};

use crate::element::{CircleMeaning, Shape, circle_meaning, diagnostic_point};
use crate::language::Language;
use crate::letter::{ElementClass, Letter, Letters};
use crate::line_type::LineType;
use crate::look_alikes;
use crate::names::PathName;
use crate::read::candidates::{Candidate, Owner, SearchBudget, find_shape};
use crate::read::collect::{self, PathCollector, PathLayers};
use crate::read::entities::{AnyText, at_entity, begin, xy};
use crate::read::keep_outs::unread_clamps;
use crate::text::{ParameterText, ParameterTexts, ValueKind, is_special_space};

/// Letters that spoil a part if they are missing. A stray text must contain one of them to be reported.
const ESSENTIAL_LETTERS: Letters = Letters::of(&[Letter::B, Letter::D, Letter::F, Letter::I, Letter::W]);

/// Maximum number of candidates examined for the stray texts of a drawing.
const MAX_EXAMINED_CANDIDATES: usize = 1_000_000;

/// Maximum number of characters after a path name that are taken for a typing error.
const MAX_SLIP_CHARACTERS: usize = 2;

/// Words that precede or follow the name of a layer in that of a layer with another version of it, in English and German.
const VERSIONS: [&str; 8] = ["old", "new", "copy", "copy of", "alt", "neu", "Kopie", "Kopie von"];

/// Whether the undecoded bytes of a text may be a parameter text that [`stray_findings`] reports. If not, it is certain that nothing is reported.
pub fn may_be_stray_text(text: &[u8]) -> bool {
    let is_weighty =
        |byte: u8| byte == b'Z' || matches!(byte.to_ascii_uppercase(), b'B' | b'D' | b'F' | b'I' | b'W');
    // Bytes beyond ASCII, and a code such as `\\U+2212`, may be a dash instead of a minus.
    let is_value =
        |byte: u8| byte.is_ascii_digit() || matches!(byte, b'+' | b'-' | b'.' | b',' | b'=' | b'\\' | 128..);
    // A colon begins a variable, as in `:D0.5`, which is never reported; a backslash begins a format code of MTEXT, as in `\\W0.8;`, or a
    // line break: `\\P`. A bar separates the properties of a font: `\\fArial|b0|i0;`.
    let is_inside = |byte: &u8| byte.is_ascii_alphanumeric() || matches!(byte, b'\\' | b':' | b'|');
    let is_begin = |before: &[u8]| {
        !before.last().is_some_and(is_inside) || BEGINNING_CODES.iter().any(|code| before.ends_with(code))
    };
    let has_value = |after: &[u8]| {
        after.iter().find(|byte| !matches!(byte, b' ' | b':')).is_some_and(|byte| is_value(*byte))
    };
    let mut letters = text.iter().enumerate().filter(|(_, byte)| is_weighty(**byte));
    letters.any(|(at, _)| is_begin(&text[..at]) && has_value(&text[at + 1..])) || may_be_probe_text(text)
}

/// Codes after which a text can begin, other than those that end with a sign: a line break, and lines over, under and through letters.
const BEGINNING_CODES: [&[u8]; 13] =
    [b"\\P", b"\\L", b"\\l", b"\\O", b"\\o", b"\\K", b"\\k", b"%%u", b"%%U", b"%%o", b"%%O", b"%%k", b"%%K"];

/// Maximum length in bytes of a text that is taken for that of a probe. Longer ones are remarks.
const MAX_PROBE_TEXT: usize = 24;

/// Whether the undecoded bytes of a text may be the text of a probe, such as `LA T2.5`: a short text that consists of values for L, T, H and Z.
fn may_be_probe_text(text: &[u8]) -> bool {
    let is_parameter = |word: &[u8]| match word {
        [b'L', value, ..] => value.is_ascii_uppercase() || value.is_ascii_digit(),
        [b'T' | b'H' | b'Z', value, ..] => value.is_ascii_digit() || matches!(value, b'.' | b'-' | b'='),
        _ => false,
    };
    let mut words = text.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty()).peekable();
    text.len() <= MAX_PROBE_TEXT && words.peek().is_some() && words.all(is_parameter)
}

/// Returns a text without the mistakes that would be errors on the layer of a path, but do not hide its meaning: lower-case letters, dashes instead of
/// a minus, spaces, colons and equals signs before numbers, signs or nothing between parameters, signs around them, units, and marks at the end.
fn without_mistakes(text: &str) -> String {
    let text = look_alikes::with_keyboard_characters(text);
    let mut meant = String::with_capacity(text.len());
    let mut rest = text.chars().peekable();
    let mut is_begin = true;
    while let Some(character) = rest.next() {
        let begins_value = |next: &char| next.is_ascii_digit() || matches!(next, '-' | '.');
        let follows_number = meant.ends_with(|last: char| last.is_ascii_digit());
        if follows_number && character.is_ascii_uppercase() && rest.peek().is_some_and(begins_value) {
            meant.push(' ');
            is_begin = true;
        }
        let is_lone_letter = is_begin && character.is_ascii_alphabetic();
        let is_between = matches!(character, ',' | ';' | '/')
            && rest.clone().find(|next| *next != ' ').is_some_and(char::is_alphabetic);
        let is_around = matches!(character, '(' | ')' | '[' | ']' | '"' | '\'');
        let is_separator = is_between || is_around || is_special_space(character);
        is_begin = is_separator || character.is_whitespace();
        meant.push(if is_separator { ' ' } else { character.to_ascii_uppercase() });
        if is_lone_letter {
            let is_number =
                rest.clone().find(|next| !matches!(next, ' ' | '=')).is_some_and(|next| begins_value(&next));
            while rest
                .next_if(|next| {
                    matches!(next, ' ' | ':') || is_special_space(*next) || *next == '=' && is_number
                })
                .is_some()
            {}
        }
    }
    let words = meant.split(' ').filter(|word| !matches!(*word, "MM" | "-"));
    let numbers = words.map(|word| {
        let word = word.trim_end_matches(['!', ',', ';', ':']);
        word.strip_suffix("MM")
            .filter(|number| number.ends_with(|last: char| last.is_ascii_digit()))
            .unwrap_or(word)
    });
    numbers.collect::<Vec<_>>().join(" ")
}

/// Whether a text is meant as parameters that spoil a part if they are missing.
fn is_parameter_text(text: &str) -> bool {
    let mut texts = ParameterTexts::default();
    let readings = [texts.push_drawn(text), texts.push_drawn(&without_mistakes(text))];
    readings.into_iter().filter_map(|id| texts.get(id)).any(looks_like_parameters)
}

/// Path names, for comparison with the names of other layers.
pub struct NearNames {
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
    /// character. Case and all characters but letters and digits
    /// are ignored; letters that look like digits are treated as those digits.
    pub fn path(&self, layer: &str) -> Option<&PathName> {
        let layer = case_folded(layer);
        let before_tilde = layer.find('~').and_then(|tilde| self.by_folded.get(&layer[..tilde]));
        let ends = layer.char_indices().rev().map(|(at, _)| at);
        let mut ends = std::iter::once(layer.len()).chain(ends).take(MAX_SLIP_CHARACTERS + 1);
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

    /// Returns the path with the longest name with which the name of another layer begins.
    fn beginning(&self, layer: &str) -> Option<&PathName> {
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

/// Returns PB119 and PB120 for a drawing that was read with all its layers.
pub fn stray_findings(drawing: &Drawing, language: &Language) -> Vec<Diagnostic> {
    let layers = PathLayers::find(drawing, &language.path_pattern);
    let mut paths = collect::paths(drawing, language);
    paths.retain(|path| path.has_elements);
    for path in &mut paths {
        path.assign_texts(language);
        path.texts.prepare();
    }
    let names = NearNames::new(paths.iter().map(|path| &path.name));
    let is_other: Vec<bool> = (0_u32..)
        .zip(&drawing.layers)
        .map(|(number, layer)| {
            layers.membership(number).is_none() && !layer.hidden && !language.is_keep_out(&layer.name)
        })
        .collect();
    let mut near_layers: Vec<Option<NearLayer<'_>>> = drawing
        .layers
        .iter()
        .zip(&is_other)
        .map(|(layer, is_other)| is_other.then(|| NearLayer::of(&layer.name, &names, language)).flatten())
        .collect();
    add_layers_with_texts(drawing, &names, &is_other, &mut near_layers);
    let budget = SearchBudget::new(MAX_EXAMINED_CANDIDATES);
    let probes = if paths.is_empty() { Vec::new() } else { probe_circles(drawing, language) };
    let mut on_near_layers: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
    let mut findings = Vec::new();
    for (number, entity) in drawing.entities.iter().enumerate() {
        if near_layers[entity.layer as usize].is_some() {
            on_near_layers.entry(entity.layer).or_default().push(number);
        } else if let Some(text) = AnyText::of(&entity.geometry)
            && is_other[entity.layer as usize]
        {
            let stray = stray_text(drawing, number, text, &paths, &budget);
            findings.extend(stray.or_else(|| stray_probe(drawing, number, text, &probes, &budget)));
        }
    }
    let mut left_out: BTreeMap<u32, Vec<&OmittedCurve>> = BTreeMap::new();
    for curve in &drawing.left_out {
        left_out.entry(curve.layer).or_default().push(curve);
    }
    for (layer, near) in (0_u32..).zip(&near_layers) {
        let (entities, left_out) = (on_near_layers.remove(&layer), left_out.remove(&layer));
        let (entities, left_out) = (entities.unwrap_or_default(), left_out.unwrap_or_default());
        findings
            .extend(near.as_ref().and_then(|near| near_layer(drawing, near, layer, &entities, &left_out)));
    }
    findings.extend(unread_clamps(drawing, language, |layer| {
        let is_part = language.is_part(&drawing.layers[layer as usize].name);
        is_other[layer as usize] && !is_part && near_layers[layer as usize].is_none()
    }));
    findings
}

/// The path or the kind of layer that a layer without a meaning resembles by its name.
enum NearLayer<'n> {
    Path(&'n PathName),
    Clamps,
    Parts,
}

impl<'n> NearLayer<'n> {
    fn of(layer: &str, names: &'n NearNames, language: &Language) -> Option<Self> {
        names.path(layer).map(Self::Path).or_else(|| Self::of_clamps_or_parts(layer, language))
    }

    fn of_clamps_or_parts(layer: &str, language: &Language) -> Option<Self> {
        let first = layer.trim_start().chars().next()?;
        let first = look_alikes::ascii(first).unwrap_or(first);
        if !language.may_begin_with(first) || language.is_part(layer) {
            return None;
        }
        let similar = similar_names(layer);
        if similar.iter().any(|name| language.is_keep_out(name)) {
            return Some(Self::Clamps);
        }
        similar.iter().any(|name| language.is_part(name)).then_some(Self::Parts)
    }
}

/// Whether the name of a layer resembles that of a layer with clamps or finished parts. [`stray_findings`] reports the entities on such layers.
pub fn is_near_clamps_or_parts(layer: &str, language: &Language) -> bool {
    NearLayer::of_clamps_or_parts(layer, language).is_some()
}

/// Length in characters below which a name resembles too many others.
const MIN_NAME_CHARACTERS: usize = 4;

/// Adds the layers that begin with a path's name and hold elements with a parameter text: they are those of the path, whatever follows the name.
fn add_layers_with_texts<'n>(
    drawing: &Drawing,
    names: &'n NearNames,
    is_other: &[bool],
    near_layers: &mut [Option<NearLayer<'n>>],
) {
    let layers = drawing.layers.iter().zip(is_other).zip(&*near_layers);
    let beginnings: Vec<Option<&PathName>> = layers
        .map(|((layer, is_other), near)| names.beginning(&layer.name).filter(|_| *is_other && near.is_none()))
        .collect();
    if beginnings.iter().all(Option::is_none) {
        return;
    }
    let mut has_elements = vec![false; beginnings.len()];
    for entity in &drawing.entities {
        has_elements[entity.layer as usize] |= AnyText::of(&entity.geometry).is_none();
    }
    for entity in &drawing.entities {
        let layer = entity.layer as usize;
        if let Some(path) = beginnings[layer].filter(|_| has_elements[layer] && near_layers[layer].is_none())
            && AnyText::of(&entity.geometry).is_some_and(|text| is_parameter_text(text.string()))
        {
            near_layers[layer] = Some(NearLayer::Path(path));
        }
    }
}

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
    let ends = plain.char_indices().rev().map(|(at, _)| at).take(MAX_SLIP_CHARACTERS);
    let shorter = std::iter::once(plain.len()).chain(ends).map(|end| plain[..end].trim_end());
    let shorter = shorter.filter(|name| is_long(name)).map(str::to_owned);
    let longer = PLURALS.iter().chain(&NUMBERS).map(|ending| [plain, ending].concat());
    let versions = VERSIONS.iter().filter_map(|word| without_version(plain, word));
    let others = versions.chain(with_swapped_characters(plain)).chain(with_space(plain));
    shorter.chain(longer).chain([plain.split_whitespace().collect()]).chain(others).collect()
}

/// Returns a name without the word for a version at its end: `Part` for `Part_OLD` and `Part (old)`.
fn without_version(name: &str, word: &str) -> Option<String> {
    let is_separator = |character: char| !character.is_alphanumeric();
    let name = name.trim_end_matches(is_separator);
    let (before, last) = name.split_at_checked(name.len().checked_sub(word.len())?)?;
    last.eq_ignore_ascii_case(word).then(|| before.trim_end_matches(is_separator).to_owned())
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

/// Returns PB119 if a text would have an effect on the layer of a path.
fn stray_text(
    drawing: &Drawing,
    entity: usize,
    text: AnyText<'_>,
    paths: &[PathCollector<'_>],
    budget: &SearchBudget,
) -> Option<Diagnostic> {
    let mut texts = ParameterTexts::default();
    let [drawn, meant] =
        [texts.push_drawn(text.string()), texts.push_drawn(&without_mistakes(text.string()))];
    let (drawn, meant) = (texts.get(drawn)?, texts.get(meant)?);
    let is_read = |read: &ParameterText<'_>| {
        looks_like_parameters(*read) || may_be_probe_text(read.as_str().as_bytes())
    };
    let read = [drawn, meant].into_iter().find(is_read)?;
    let circle = text.circle();
    let over = paths.iter().find_map(|path| {
        let mut takers = path.texts.free_candidates(&circle, budget);
        Some((path, takers.find(|(_, taker)| path.would_apply(read, taker))?))
    });
    let beside = || {
        paths.iter().find_map(|path| {
            let mut missed = path.texts.candidates_beside(&circle, circle.radius, budget);
            let is_taker =
                |taker: &Candidate| matches!(taker.owner, Owner::Element(_)) && path.would_apply(read, taker);
            Some((path, missed.find(|(_, taker)| is_taker(taker))?))
        })
    };
    let (path, (layer, candidate)) = over.or_else(beside)?;
    let problem = Diagnostic::new(&messages::TEXT_ON_OTHER_LAYER)
        .quoting("text", drawn.as_str().replace('\n', " "))
        .quoting("layer", &*drawing.layers[drawing.entities[entity].layer as usize].name)
        .quoting("path_layer", layer)
        .with("element", candidate.word())
        .with("point", diagnostic_point(candidate.shape.point()))
        .with_text(drawn.whole_text_fault());
    Some(at_entity(drawing, entity, text.anchor(), problem.in_path(path.name.as_str())))
}

/// Returns the circles that would be probes on the layer of a path, each with its layer number.
fn probe_circles(drawing: &Drawing, language: &Language) -> Vec<(u32, Shape)> {
    let circles = drawing.entities.iter().filter_map(|entity| {
        let Geometry::Circle(circle) = &entity.geometry else { return None };
        let line_type = LineType::of(&entity.line_type, &language.line_types)?;
        let is_probe = circle_meaning(line_type, circle.radius) == CircleMeaning::Probe;
        is_probe.then(|| (entity.layer, Shape::Circle { centre: xy(circle.centre), radius: circle.radius }))
    });
    circles.collect()
}

/// Returns PB119 if a text and the circle that it overlaps would be a probe on the layer of a path.
fn stray_probe(
    drawing: &Drawing,
    entity: usize,
    text: AnyText<'_>,
    probes: &[(u32, Shape)],
    budget: &SearchBudget,
) -> Option<Diagnostic> {
    if probes.is_empty() || !may_be_probe_text(text.string().as_bytes()) {
        return None;
    }
    let layer = drawing.entities[entity].layer;
    let on_layer = probes.iter().map(|(other, shape)| (*other == layer).then_some(*shape));
    let (_, circle) = probes[find_shape(&text.circle(), on_layer, budget)?];
    let texts = ParameterTexts::from(text.string());
    let problem = Diagnostic::new(&messages::PROBE_ON_OTHER_LAYER)
        .quoting("text", text.string().replace('\n', " "))
        .quoting("layer", &*drawing.layers[layer as usize].name)
        .with("point", diagnostic_point(circle.point()))
        .with_text(texts.first().map(ParameterText::whole_text_fault));
    Some(at_entity(drawing, entity, text.anchor(), problem))
}

/// Whether a text consists of letters with numbers or variables, and perhaps a remark with Q, and gives a letter that would spoil a part if it were
/// missing.
pub(super) fn looks_like_parameters(text: ParameterText<'_>) -> bool {
    let is_number = |written: ValueKind| matches!(written, ValueKind::Number(_) | ValueKind::Reference);
    text.letters.has_any(ESSENTIAL_LETTERS)
        && text.pieces().iter().all(|piece| {
            piece
                .letter
                .is_some_and(|letter| letter == Letter::Q || !letter.is_text() && is_number(piece.written))
        })
}

impl PathCollector<'_> {
    /// Whether a text would have an effect that spoils a part if it is missing, on an element without a text.
    fn would_apply(&self, text: ParameterText<'_>, candidate: &Candidate) -> bool {
        let (class, text_of_owner, essential) = match candidate.owner {
            Owner::Element(element) => {
                let element = &self.elements[element];
                (element.class(self.tool()), element.text, ESSENTIAL_LETTERS)
            }
            // The height of a probe corrects all others.
            Owner::Probe(probe) => (ElementClass::Probe, self.probes[probe].text, Letters::ALL),
            Owner::Start | Owner::Faulty => return false,
        };
        let mut letters = text.pieces().iter().filter_map(|piece| piece.letter);
        let has_effect = |letter| essential.contains(letter) && class.use_of(letter).counts();
        text_of_owner.is_none() && letters.any(has_effect)
    }

    /// The cutter's diameter, if the start text gives it.
    fn tool(&self) -> Option<f64> {
        let text = self.given.get(self.start.as_ref()?.text?)?;
        match text.piece(Letter::O)?.written {
            ValueKind::Number(number) => Some(number),
            _ => None,
        }
    }
}

/// Returns PB120 for a layer with these entities, or with elements that are left out of a path.
fn near_layer(
    drawing: &Drawing,
    near: &NearLayer<'_>,
    layer: u32,
    entities: &[usize],
    left_out: &[&OmittedCurve],
) -> Option<Diagnostic> {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    // The pieces of a polyline, which follow each other, are one entity.
    let is_piece = |one: &usize, other: &usize| {
        let [one, other] = [*one, *other].map(|number| drawing.entities[number].group);
        one.is_some() && one == other
    };
    for entity in entities.chunk_by(is_piece) {
        *counts.entry(drawing.entities[entity[0]].kind.name()).or_default() += 1;
    }
    for left_out in left_out {
        *counts.entry(left_out.kind.name()).or_default() += 1;
    }
    let elements: Value = counts.into_iter().map(|(kind, count)| format!("{count} {kind}")).collect();
    let problem = match near {
        NearLayer::Path(path) => Diagnostic::new(&messages::NEARLY_PATH_LAYER)
            .quoting("path", path.as_str())
            .in_path(path.as_str()),
        NearLayer::Clamps => Diagnostic::new(&messages::NEARLY_CLAMP_LAYER),
        NearLayer::Parts => Diagnostic::new(&messages::NEARLY_PART_LAYER),
    };
    let name = &*drawing.layers[layer as usize].name;
    let problem = problem.quoting("layer", name).with("elements", elements);
    let problem = match look_alikes::first_look_alike(name) {
        Some(character) => problem.note(&messages::LOOK_ALIKE_IN_NAME, character),
        None => problem,
    };
    match entities.first() {
        Some(first) => Some(at_entity(drawing, *first, begin(&drawing.entities[*first].geometry), problem)),
        None => Some(Diagnostic { place: left_out.first()?.diagnostic.place.clone(), ..problem }),
    }
}
