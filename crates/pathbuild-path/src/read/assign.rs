//! Assigns each text of a path to its element. (book: language/parameter-texts)

use std::cell::OnceCell;
use std::mem::discriminant;
use std::ops::Range;

use pathbuild_diagnostic::messages::drawing as messages;
use pathbuild_diagnostic::{Diagnostic, Message, Value, words};
use pathbuild_dxf::LayoutObstacle;

use crate::approx::above;
use crate::element::{END_RADIUS, Element, Marker, Role, Shape, TURN_RADIUS, diagnostic_point};
use crate::letter::{Letter, LetterUse, Letters};
use crate::names::is_tilde_layer;
use crate::read::candidates::{
    AssignedCandidate, Candidate, Doubt, Owner, Rival, SearchBudget, find, find_rival, find_shape,
    find_with_text, is_overlapped, nearest_miss,
};
use crate::read::collect::PathCollector;
use crate::read::entities::{FoundText, TextCircle};
use crate::read::texts::{LayerTexts, MAX_EXAMINED_ELEMENTS, MAX_SEARCHED_LAYERS, TextWithCandidate, Texts};
use crate::text::{ParameterText, ParameterTexts, TextId, without_percent_codes};

/// Maximum number of other layers with a suitable element that the finding about a text without an element lists.
const MAX_LISTED_LAYERS: usize = 3;

/// Upper bound on the elements that are examined for hints about texts without an element, in addition to those examined to assign texts.
const MAX_EXAMINED_FOR_HINTS: usize = 1_000_000;

/// Bounds the search for hints about texts without an element.
struct HintBudgets {
    candidates: SearchBudget,
    /// For HIDDEN elements, end markers and turn markers, which take no text.
    silent: SearchBudget,
}

impl Default for HintBudgets {
    fn default() -> Self {
        let [candidates, silent] = [MAX_EXAMINED_FOR_HINTS; 2].map(SearchBudget::new);
        Self { candidates, silent }
    }
}

impl<'d> Texts<'d> {
    /// Assigns each text to its element. Reports PB107 for a text without an element, and PB116 if another element is nearer, or less than `margin`
    /// mm farther away.
    pub(crate) fn assign(&mut self, path: &mut PathCollector<'_>, margin: f64) {
        let budget = SearchBudget::new(MAX_EXAMINED_ELEMENTS);
        let has_several = self.layers.iter().filter(|layer| !layer.candidates.is_empty()).nth(1).is_some();
        let given = &mut self.given;
        for layer in &mut self.layers {
            let remember = |text: &FoundText<'d>, found| given.push(TextWithCandidate { text: *text, found });
            if let Some(problem) = layer.assign(path, margin, &budget, remember) {
                // The elements of the remaining texts are unknown.
                path.diagnostics.push(problem);
                path.uncertainty.stray_letters = Letters::ALL;
                return;
            }
        }
        if !has_several && self.layers.iter().all(|layer| layer.texts.is_empty()) {
            return;
        }
        self.prepare();
        if has_several {
            self.check_other_layers(path);
        }
        let budgets = HintBudgets::default();
        for (number, layer) in self.layers.iter().enumerate() {
            for text in &layer.texts {
                let others = self.layers.iter().enumerate().filter(|(other, _)| *other != number);
                let problem =
                    layer.missing_element_problem(text, others.map(|(_, other)| other), path, &budgets);
                let problem = path.with_left_out(problem);
                path.diagnostics.push(problem);
                let texts = ParameterTexts::from(&*without_percent_codes(text.string()));
                if let Some(read) = texts.first() {
                    path.note_start_text(read, text);
                }
                let letters = texts.first().map(ParameterText::possible_letters);
                path.uncertainty.stray_letters =
                    path.uncertainty.stray_letters.union(letters.unwrap_or_default());
            }
        }
    }

    /// Reports PB116 for each text if an element without a text, on another layer of the path, is nearer than the text's own element.
    fn check_other_layers(&self, path: &mut PathCollector<'_>) {
        let budget = SearchBudget::new(MAX_EXAMINED_FOR_HINTS);
        for TextWithCandidate { text, found } in &self.given {
            let number = text.source.layer as usize;
            let others = self.layers.iter().enumerate().filter(|(other, _)| *other != number);
            let rivals = others.map(|(_, layer)| Rivals { layer, path: &*path, margin: 0.0 });
            let doubt = self.layers[number].doubt_by_other_layer(text, found, rivals, &budget, |_| true);
            path.diagnostics.extend(doubt);
        }
    }
}

/// Reports PB116 for each text with a centre within `margin` mm of an element of another path of the drawing, but not of its own element: it was
/// probably drawn on the wrong path's layer.
pub(super) fn check_other_paths(paths: &mut [PathCollector<'_>], margin: f64) {
    if paths.len() < 2 {
        return;
    }
    for path in &mut *paths {
        path.texts.prepare();
    }
    let budget = SearchBudget::new(MAX_EXAMINED_FOR_HINTS);
    for number in 0..paths.len() {
        let path = &paths[number];
        if path.uncertainty.has_broken_entity {
            continue;
        }
        let others = || paths.iter().enumerate().filter(|(other, _)| *other != number);
        let doubt = |TextWithCandidate { text, found }: &TextWithCandidate<'_>| {
            let is_on = |distance| !above(distance, margin);
            let layers =
                others().flat_map(|(_, path)| path.texts.layers.iter().map(move |layer| (layer, path)));
            let rivals = layers.map(|(layer, path)| Rivals { layer, path, margin: 0.0 });
            let layer = &path.texts.layers[text.source.layer as usize];
            let doubt = layer.doubt_by_other_layer(text, found, rivals, &budget, |rival| {
                is_on(found.visible_distance + rival.farther) && !is_on(found.visible_distance)
            })?;
            Some(doubt.in_path(path.name.as_str()))
        };
        let doubts: Vec<Diagnostic> = path.texts.given.iter().filter_map(doubt).collect();
        paths[number].diagnostics.extend(doubts);
    }
}

/// The elements of a layer that a text may have been meant for.
struct Rivals<'r> {
    layer: &'r LayerTexts<'r>,
    path: &'r PathCollector<'r>,
    /// See [`find_rival`].
    margin: f64,
}

impl<'d> LayerTexts<'d> {
    /// Assigns each text to its element. Texts without an element stay in `texts`. Returns PB005 if the budget is exhausted.
    fn assign(
        &mut self,
        path: &mut PathCollector<'_>,
        margin: f64,
        budget: &SearchBudget,
        mut remember: impl FnMut(&FoundText<'d>, AssignedCandidate),
    ) -> Option<Diagnostic> {
        // A candidate that the text does not overlap is no rival if a later text belongs to it.
        let mut beside_text = Vec::new();
        let last = self.each_match(budget, |layer, text, circle, owners, found| {
            let has_owner = !owners.is_empty();
            let doubt = found.and_then(|found| {
                let is_of_layer = |rival: &Rival| {
                    let owners =
                        [found.candidate, rival.candidate].map(|index| layer.candidates[index].owner);
                    rival.doubt != Doubt::NearerOfSameKind && !are_copies_of_subpath(owners, &path.elements)
                };
                layer.ambiguity_problem(text, &found, &Rivals { layer, path, margin }, budget, is_of_layer)
            });
            match doubt {
                Some((rival, doubt)) if !is_overlapped(&circle, &layer.candidates[rival.candidate].shape) => {
                    beside_text.push((rival.candidate, doubt));
                }
                doubt => path.diagnostics.extend(doubt.map(|(_, doubt)| doubt)),
            }
            if let Some(found) = found {
                remember(text, found);
            }
            if let (Some(found), Some(obstacle)) = (found, text.text.obstacle()) {
                path.diagnostics.push(layer.unknown_place_problem(text, found, obstacle));
            }
            if has_owner {
                let id = path.given.push_drawn(text.string());
                layer.give_text(id, owners.clone(), path);
                let is_start = |owner: &Candidate| matches!(owner.owner, Owner::Start);
                if !layer.candidates[owners].iter().any(is_start) {
                    path.note_given_start_text(id, text);
                }
            }
            has_owner
        });
        let beside_text = beside_text.into_iter().filter(|(rival, _)| !self.candidates[*rival].is_taken);
        path.diagnostics.extend(beside_text.map(|(_, doubt)| doubt));
        let problem = Diagnostic::new(&messages::TEXTS_IN_A_CROWD).with("limit", MAX_EXAMINED_ELEMENTS);
        last.map(|last| self.origin(last.source, last.anchor()).at(problem))
    }

    fn give_text(&self, text: TextId, owners: Range<usize>, path: &mut PathCollector<'_>) {
        for owner in &self.candidates[owners] {
            let owner = match owner.owner {
                Owner::Start => path.start.as_mut().map(|start| &mut start.text),
                Owner::Probe(probe) => Some(&mut path.probes[probe].text),
                Owner::Element(element) => Some(&mut path.elements[element].text),
                Owner::Faulty => None,
            };
            if let Some(owner) = owner {
                *owner = Some(text);
            }
        }
    }

    /// Returns PB116 if the text could belong to an element of the rivals' layer as well. Ignores elements on which the text would be an error: a
    /// marker instead of an element or the reverse, and elements that do not accept one of its letters.
    fn ambiguity_problem(
        &self,
        text: &FoundText<'_>,
        found: &AssignedCandidate,
        rivals: &Rivals<'_>,
        budget: &SearchBudget,
        is_reported: impl Fn(&Rival) -> bool,
    ) -> Option<(Rival, Diagnostic)> {
        let Rivals { layer: rivals, path, margin } = *rivals;
        let element = &self.candidates[found.candidate];
        let string = without_percent_codes(text.string());
        let texts = OnceCell::new();
        let read = || texts.get_or_init(|| ParameterTexts::from(&*string)).first();
        let is_possible = |rival: &Rival| {
            let other = &rivals.candidates[rival.candidate];
            let refuses = |text: ParameterText<'_>| refuses(other.owner, text, &path.elements);
            let is_part =
                std::ptr::eq(self, rivals) && self.parts(found.candidate).contains(&rival.candidate);
            is_reported(rival)
                && !is_part
                && discriminant(&element.owner) == discriminant(&other.owner)
                && !read().is_some_and(refuses)
        };
        let index = (&*rivals.candidates, &rivals.boxes);
        let rival = find_rival(&text.circle(), found, margin, index, budget, is_possible)?;
        let other = &rivals.candidates[rival.candidate];
        let message = match rival.doubt {
            Doubt::NearerWithText => &messages::NEARER_HAS_A_TEXT,
            Doubt::EquallyNear => &messages::FIRST_OF_EQUALS,
            Doubt::HardlyFarther => &messages::NEARLY_OTHER_ELEMENT,
            Doubt::NearerOfLaterKind | Doubt::NearerOfSameKind => &messages::NEARER_OF_OTHER_KIND,
            Doubt::NearerBesideText => &messages::NEARER_BESIDE_TEXT,
        };
        let mut doubt = Diagnostic::new(message)
            .quoting("text", string.replace('\n', " "))
            .with("element", element.word())
            .with("point", diagnostic_point(element.shape.point()))
            .with("other", other.word())
            .with("other_point", diagnostic_point(other.shape.point()))
            .with("margin", at_least_a_micrometre(rival.farther));
        if let Doubt::NearerWithText = rival.doubt {
            // An element with an error of its own keeps no text, and needs no further finding.
            let given = path.text_of(other.owner)?;
            doubt = doubt.quoting("other_text", given.as_str().replace('\n', " "));
        }
        doubt.text = read().map(ParameterText::whole_text_fault);
        Some((rival, self.origin(text.source, text.anchor()).at(doubt)))
    }

    /// Returns PB116 if an element without a text, on another layer than the text, is nearer than the text's own element. Texts on tilde layers are
    /// exempt: they are kept apart from the elements of other layers on purpose.
    fn doubt_by_other_layer<'r>(
        &self,
        text: &FoundText<'_>,
        found: &AssignedCandidate,
        others: impl Iterator<Item = Rivals<'r>>,
        budget: &SearchBudget,
        is_possible: impl Fn(&Rival) -> bool,
    ) -> Option<Diagnostic> {
        if is_tilde_layer(&self.name) {
            return None;
        }
        let is_nearer = |rival: &Rival| {
            matches!(rival.doubt, Doubt::NearerOfLaterKind | Doubt::NearerOfSameKind) && is_possible(rival)
        };
        others.take(MAX_SEARCHED_LAYERS).find_map(|rivals| {
            let name = &rivals.layer.name;
            let (_, doubt) = self.ambiguity_problem(text, found, &rivals, budget, is_nearer)?;
            let doubt = Diagnostic { message: &messages::NEARER_ON_OTHER_LAYER, ..doubt };
            Some(doubt.quoting("layer", &**name))
        })
    }

    /// Returns PB116 for a text that the CAD program shows in a place that is unknown.
    fn unknown_place_problem(
        &self,
        text: &FoundText<'_>,
        found: AssignedCandidate,
        obstacle: LayoutObstacle,
    ) -> Diagnostic {
        let reason = match obstacle {
            LayoutObstacle::Alignment => &words::SEVERAL_ALIGNMENTS,
            LayoutObstacle::Columns => &words::COLUMNS,
            LayoutObstacle::EmptyRows => &words::EMPTY_ROWS,
            LayoutObstacle::Heights => &words::SEVERAL_HEIGHTS,
            LayoutObstacle::Indent => &words::INDENT,
            LayoutObstacle::Stack => &words::STACKED_CHARACTERS,
            LayoutObstacle::Tab => &words::TAB,
        };
        let element = &self.candidates[found.candidate];
        let string = without_percent_codes(text.string());
        let mut problem = Diagnostic::new(&messages::PLACE_UNKNOWN)
            .quoting("text", string.replace('\n', " "))
            .with("element", element.word())
            .with("point", diagnostic_point(element.shape.point()))
            .with("reason", reason);
        problem.text = ParameterTexts::from(&*string).first().map(ParameterText::whole_text_fault);
        self.origin(text.source, text.anchor()).at(problem)
    }

    fn missing_element_problem<'a>(
        &self,
        text: &FoundText<'_>,
        elsewhere: impl Iterator<Item = &'a Self>,
        path: &PathCollector<'_>,
        budgets: &HintBudgets,
    ) -> Diagnostic
    where
        'd: 'a,
    {
        let (string, circle) = (without_percent_codes(text.string()), text.circle());
        if string.trim().is_empty() {
            let problem =
                Diagnostic::new(&messages::BLANK_TEXT).with("centre", diagnostic_point(circle.centre));
            return self.origin(text.source, text.anchor()).at(problem);
        }
        let mut diagnostic = Diagnostic::new(&messages::TEXT_WITHOUT_ELEMENT)
            .quoting("text", string.replace('\n', " "))
            .with("centre", diagnostic_point(circle.centre))
            .with("diameter", 2.0 * circle.radius);
        let texts = ParameterTexts::from(&*string);
        diagnostic.text = texts.first().map(ParameterText::whole_text_fault);
        // A start text is meant for the start marker, whatever it lies on.
        let has = |letter| texts.first().is_some_and(|text| text.letters.contains(letter));
        let is_start_text = has(Letter::O) && has(Letter::T) && !has(Letter::Embed);
        let silent = || self.textless_element_note(text, path, &budgets.silent).filter(|_| !is_start_text);
        let budget = &budgets.candidates;
        let taken = find_with_text(&circle, &self.candidates, &self.boxes, budget);
        if let Some(taken) = taken.map(|taken| &self.candidates[taken]) {
            let message = match path.text_of(taken.owner) {
                Some(text) if text.pieces().is_empty() => &messages::HAS_A_BLANK_TEXT,
                Some(text) if text.as_str().trim() == string.trim() => &messages::HAS_SAME_TEXT,
                _ if taken.group.is_some() => &messages::POLYLINE_HAS_A_TEXT,
                _ => &messages::HAS_A_TEXT,
            };
            diagnostic = diagnostic.note(
                message,
                vec![
                    ("element", taken.word().into()),
                    ("point", diagnostic_point(taken.shape.point()).into()),
                ],
            );
        } else if let Some((message, shape)) = silent() {
            let point = diagnostic_point(shape.point());
            diagnostic = diagnostic.note(message, vec![("point", point.into())]);
        } else if let Some(miss) = nearest_miss(&circle, &self.candidates, &self.boxes, budget) {
            let candidate = &self.candidates[miss.candidate];
            diagnostic = diagnostic.note(
                &messages::NEAREST_ELEMENT,
                vec![
                    ("element", candidate.word().into()),
                    ("point", diagnostic_point(candidate.shape.point()).into()),
                    ("distance", miss.distance.into()),
                ],
            );
        }
        let takers =
            elsewhere.take(MAX_SEARCHED_LAYERS).filter_map(|layer| layer.possible_owner(&circle, budget));
        let note = |diagnostic: Diagnostic, taker| diagnostic.note(&messages::ELEMENT_ON_OTHER_LAYER, taker);
        let diagnostic = takers.take(MAX_LISTED_LAYERS).fold(diagnostic, note);
        self.origin(text.source, text.anchor()).at(diagnostic)
    }

    /// Returns the note about the nearest HIDDEN element, end marker or turn marker that a text overlaps.
    fn textless_element_note(
        &self,
        text: &FoundText<'_>,
        path: &PathCollector<'_>,
        budget: &SearchBudget,
    ) -> Option<(&'static Message, Shape)> {
        let hidden = path.elements.iter().map(|element| {
            let is_silent = element.role == Role::SilentSweep && element.source.layer == text.source.layer;
            is_silent.then_some((&messages::HIDDEN_TAKES_NO_TEXT, element.shape))
        });
        let marker = |message: &'static Message, radius| {
            move |marker: &Marker| {
                let circle = Shape::Circle { centre: marker.at, radius };
                (marker.origin.layer == self.name).then_some((message, circle))
            }
        };
        let ends = path.ends.iter().map(marker(&messages::END_TAKES_NO_TEXT, END_RADIUS));
        let turns = path.turns.iter().map(marker(&messages::TURN_TAKES_NO_TEXT, TURN_RADIUS));
        let silent = hidden.chain(ends).chain(turns);
        let shapes = silent.clone().map(|found| found.map(|(_, shape)| shape));
        let nearest = find_shape(&text.circle(), shapes, budget)?;
        silent.clone().nth(nearest)?
    }

    /// Returns the element that a text with this circle would belong to on this layer.
    fn possible_owner(
        &self,
        circle: &TextCircle,
        budget: &SearchBudget,
    ) -> Option<Vec<(&'static str, Value)>> {
        let found = find(circle, &self.candidates, &self.boxes, budget)?;
        let candidate = &self.candidates[found.candidate];
        Some(vec![
            ("layer", Value::quoted(&self.name)),
            ("element", candidate.word().into()),
            ("point", diagnostic_point(candidate.shape.point()).into()),
        ])
    }
}

/// Whether two subpaths lie on each other, which is an error (PB501): the text names the path of both.
fn are_copies_of_subpath(owners: [Owner; 2], elements: &[Element]) -> bool {
    let curve = |owner| match owner {
        Owner::Element(element) if elements[element].role == Role::Subpath => match elements[element].shape {
            Shape::Curve(curve) => Some(curve),
            Shape::Circle { .. } => None,
        },
        Owner::Element(_) | Owner::Start | Owner::Probe(_) | Owner::Faulty => None,
    };
    let [Some(one), Some(other)] = owners.map(curve) else { return false };
    one.place_key() == other.place_key()
}

/// Whether an element does not accept one of the letters of a text (PB202).
fn refuses(owner: Owner, text: ParameterText<'_>, elements: &[Element]) -> bool {
    let Owner::Element(element) = owner else { return false };
    let class = elements[element].class(None);
    let mut letters = text.pieces().iter().filter_map(|piece| piece.letter);
    letters.any(|letter| matches!(class.use_of(letter), LetterUse::Unknown | LetterUse::PathOnly))
}

/// Rounds a difference of distances to micrometres, so that it is not shown as 0.
fn at_least_a_micrometre(difference: f64) -> f64 {
    (difference.abs() * 1000.0).round().max(1.0) / 1000.0
}
