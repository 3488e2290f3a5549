//! Converts elements to segments, with their parameters.

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::parameters as messages;
use smol_str::SmolStr;

use super::{Binder, FaultSite};
use crate::effective::Texts;
use crate::element::{Element, Role, Shape};
use crate::geometry::Curve;
use crate::letter::{Letter, Letters};
use crate::matrix::{ElementClass, Use};
use crate::path::{Segment, SegmentKind, Subpath, SubpathName, SubpathValue};
use crate::text::{LetterValue, ParameterText};
use crate::values::{GivenNumber, Values};

/// Order of elements without N. (book: language/chains-and-passes)
pub(super) const UNNUMBERED: f64 = 9998.0;

impl Binder<'_> {
    pub(super) fn bind_segments(&mut self, tool: Option<f64>) {
        let raw = self.raw;
        let mut segments = std::mem::take(&mut self.segments);
        segments.reserve(raw.drawn.elements.len());
        self.cuts.reserve(raw.drawn.elements.len());
        for (number, element) in (0_u32..).zip(&raw.drawn.elements) {
            let segment = |order, kind| Segment { element: number, order, kind };
            match (element.role, &element.shape) {
                (Role::Cut(cut), Shape::Curve(curve)) => {
                    let (order, parameters) = self.cut(element, cut, curve, tool);
                    segments.push(segment(order, SegmentKind::Cut(parameters)));
                }
                (Role::Cut(cut), Shape::Circle { centre, radius }) => {
                    let (order, kind) = self.circle(element, cut, *centre, *radius, tool);
                    segments.push(segment(order, kind));
                }
                // Their texts are ignored.
                (Role::SilentSweep | Role::SkippedSubpath, _) => {
                    segments.push(segment(UNNUMBERED, SegmentKind::Sweep { height: None }));
                }
                _ => segments.extend(self.other(element).map(|(order, kind)| segment(order, kind))),
            }
        }
        self.segments = segments;
    }

    /// The segment for any other element, with its order at a star.
    fn other(&mut self, element: &Element) -> Option<(f64, SegmentKind)> {
        let Shape::Curve(curve) = element.shape else { return None };
        let class = element.class(None);
        let values =
            self.element_values(FaultSite::Element(element), self.raw.drawn.text(element.text), class);
        let scope = Scope { at: FaultSite::Element(element), class, values: &values };
        let order = self.order(&scope);
        if element.role != Role::Subpath {
            return Some((order, SegmentKind::Sweep { height: self.value(&scope, Letter::S) }));
        }
        // A faulty text may hide the name of the embedded path, so it is not required.
        if values.is_unknown(Letter::Embed) || values.text(Letter::Embed) == Some("") && has_unread(&values) {
            return Some((order, SegmentKind::Sweep { height: None }));
        }
        let subpath = self.subpath(element, &scope, curve);
        Some((order, SegmentKind::Subpath(Box::new(subpath))))
    }

    /// N of an element, or the default order.
    pub(super) fn order(&mut self, scope: &Scope<'_>) -> f64 {
        self.unknown.order |=
            scope.values.number(Letter::N) == GivenNumber::Faulty && scope.values.has(Letter::N);
        self.value(scope, Letter::N).unwrap_or(UNNUMBERED)
    }

    fn subpath(&mut self, element: &Element, scope: &Scope<'_>, curve: Curve) -> Subpath {
        let values = scope.values;
        let [thickness, tool] = [Letter::T, Letter::O].map(|letter| self.value(scope, letter));
        let is_material_unknown = values.is_unknown(Letter::M)
            || values.text(Letter::M).is_none() && self.values.is_unknown(Letter::M);
        let unknown =
            [(Letter::T, thickness.is_none()), (Letter::O, tool.is_none()), (Letter::M, is_material_unknown)];
        let unknown = unknown.into_iter().filter(|(_, is_unknown)| *is_unknown);
        let own_text = |letter| values.text(letter).map(SmolStr::from);
        let value = |(value, piece): (&str, &LetterValue)| {
            let mut characters = value.chars();
            let variable = characters.next();
            let text = values.underlined(piece);
            SubpathValue { variable, value: characters.as_str().into(), text }
        };
        Subpath {
            start: curve.start(),
            end: curve.end(),
            name: self.subpath_name(values, self.raw.drawn.text(element.text)),
            thickness: thickness.unwrap_or_default(),
            tool: tool.unwrap_or_default(),
            unknown: unknown.fold(Letters::default(), |all, (letter, _)| all.and(Letters::of(&[letter]))),
            material: own_text(Letter::M).or_else(|| self.path_text(Letter::M)),
            height: scope.texts(&self.values).number_or_default(Letter::H).unwrap_or_default(),
            values: values.variables().map(value).collect(),
            text: element.text,
        }
    }

    fn subpath_name(&self, values: &Values<'_>, text: Option<ParameterText<'_>>) -> SubpathName {
        let Some(value) = values.text(Letter::Embed) else {
            return SubpathName::Missing { text: text.map(ParameterText::whole) };
        };
        match self.language.path_pattern.find(value) {
            None => SubpathName::Invalid { value: value.into() },
            Some((name, range)) => {
                let has_more = range.len() < value.len();
                SubpathName::Found { name: name.into(), has_more: has_more.then(|| value.into()) }
            }
        }
    }

    /// The value of a letter for an element by the table of letters: its own or the path's. PB201 if it is required and neither gives it.
    pub(super) fn value(&mut self, scope: &Scope<'_>, letter: Letter) -> Option<f64> {
        let given = scope.texts(&self.values).number(letter);
        // A letter that every path must have is reported once, at the path's start.
        let is_missing_here = || ElementClass::PathStart.use_of(letter) != Use::Needed;
        if scope.class.use_of(letter) == Use::Needed && given == GivenNumber::Absent && is_missing_here() {
            let problem = Diagnostic::new(&messages::MISSING)
                .with("letter", letter.as_char())
                .with("element", scope.class.word());
            self.report(scope.at, problem);
        }
        self.unknown.needed |= scope.class.use_of(letter) == Use::Needed && given.number().is_none();
        self.unknown.infeed |= letter == Letter::I && given == GivenNumber::Faulty;
        given.number()
    }
}

/// Whether a text contains pieces that do not begin with a letter.
fn has_unread(values: &Values<'_>) -> bool {
    values.unread != Letters::default()
}

/// The element whose values are looked up.
pub(super) struct Scope<'a> {
    pub(super) at: FaultSite<'a>,
    pub(super) class: ElementClass,
    pub(super) values: &'a Values<'a>,
}

impl<'a> Scope<'a> {
    /// The texts that can give the element its parameters. Chains are not known yet, so the letters of chains come from the element itself.
    pub(super) fn texts(&self, path: &'a Values<'a>) -> Texts<'a, 'a> {
        Texts { class: self.class, own: self.values, chain: None, path }
    }
}

/// Appends an item and returns its index.
pub(super) fn pushed<T>(list: &mut Vec<T>, thing: T) -> u32 {
    list.push(thing);
    u32::try_from(list.len() - 1).unwrap_or(u32::MAX)
}
