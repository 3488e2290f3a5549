//! Lists the effective parameters of each element and their providers. (book: language/letters)

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::sync::Arc;

use pathbuild_diagnostic::{Number, Text, words};
use smol_str::{SmolStr, ToSmolStr};

use crate::bind::bind;
use crate::chain::Item;
use crate::effective::{PathNumbers, PathOptions, PathRole, Provider, Texts, fallback};
use crate::element::{Element, Origin};
use crate::language::Language;
use crate::letter::{ElementClass, Letter};
use crate::raw::RawPath;
use crate::text::TextId;
use crate::values::{GivenNumber, Values};
use crate::variables::{Bindings, Interpolation};
use crate::walk::walk;

/// An element with its effective parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct ElementParameters {
    /// The location of the element.
    pub origin: Origin,
    /// The element's name in messages.
    pub what: &'static Text,
    /// The parameters in alphabetical order of their letters. Consecutive elements with the same parameters share one list.
    pub parameters: Arc<[Parameter]>,
}

/// A letter with its effective value and the provider of that value.
#[derive(Clone, Debug, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct Parameter {
    pub letter: Letter,
    /// The value with variables substituted.
    pub value: SmolStr,
    pub from: Provider,
}

/// Returns the effective parameters of a path's start, of its elements in their order, and of its probes. Errors in them are not reported
/// here.
pub fn element_parameters(
    raw: &RawPath,
    bindings: &Bindings,
    options: &PathOptions,
    role: PathRole,
    language: &Language,
) -> Vec<ElementParameters> {
    let interpolation =
        Interpolation { bindings, limit: language.text_limit, unknown: &raw.uncertainty.variables };
    let values = Values::of(raw.parameters(), ElementClass::PathStart, &interpolation);
    let chains = chains(raw, bindings, language);
    let table =
        ParameterTable { raw, interpolation, options, role, values, chains, last: RefCell::default() };
    let start =
        raw.start.iter().map(|start| table.row(start.origin.clone(), ElementClass::PathStart, None, None));
    let elements = (0_u32..).zip(&raw.drawn.elements).map(|(number, element)| table.element(number, element));
    let probe = |probe: &crate::element::Marker| {
        table.row(probe.origin.clone(), ElementClass::Probe, probe.text, None)
    };
    start.chain(elements).chain(raw.probes.iter().map(probe)).collect()
}

struct ParameterTable<'a> {
    raw: &'a RawPath,
    interpolation: Interpolation<'a>,
    options: &'a PathOptions,
    role: PathRole,
    /// The values of the path's own text.
    values: Values<'a>,
    /// For each element of a chain except the first: the first element of that chain.
    chains: BTreeMap<u32, u32>,
    /// The parameters of the previous row.
    last: RefCell<Arc<[Parameter]>>,
}

impl ParameterTable<'_> {
    fn element(&self, number: u32, element: &Element) -> ElementParameters {
        let class = element.class(self.raw.tool());
        let first = self.chains.get(&number).map(|first| &self.raw.drawn.elements[*first as usize]);
        self.row(self.raw.drawn.origin(element), class, element.text, first)
    }

    fn row(
        &self,
        origin: Origin,
        class: ElementClass,
        text: Option<TextId>,
        first: Option<&Element>,
    ) -> ElementParameters {
        let own = self.values_of(text, class);
        let chain = first.map(|first| self.values_of(first.text, first.class(self.raw.tool())));
        let texts = Texts { class, own: &own, chain: chain.as_ref(), path: &self.values };
        let parameter = |letter| {
            let (value, from) = self.parameter(&texts, letter)?;
            Some(Parameter { letter, value, from })
        };
        // Elements that accept no parameter text are traversed as sweeps.
        let what = if class == ElementClass::Unread { &words::SWEEP } else { class.word() };
        ElementParameters {
            origin,
            what,
            parameters: self.share_parameters(Letter::all().filter_map(parameter).collect()),
        }
    }

    /// Returns the list of the previous row if its parameters are the same. This saves memory: the parameters of a row take more of it than its element.
    fn share_parameters(&self, parameters: Vec<Parameter>) -> Arc<[Parameter]> {
        let mut last = self.last.borrow_mut();
        if **last != *parameters {
            *last = parameters.into();
        }
        Arc::clone(&last)
    }

    fn values_of(&self, text: Option<TextId>, class: ElementClass) -> Values<'_> {
        let text = self.raw.drawn.text(text);
        text.map(|text| Values::of(text, class, &self.interpolation)).unwrap_or_default()
    }

    fn parameter(&self, texts: &Texts<'_, '_>, letter: Letter) -> Option<(SmolStr, Provider)> {
        if let Some((values, provider)) = texts.source(letter) {
            return Some((display_value(values, letter)?, self.with_lender(provider)));
        }
        let path = PathNumbers::of(&self.values);
        let (value, provider) = fallback(letter, texts.class, path, self.options, self.role)?;
        Some((Number(value).to_smolstr(), self.with_lender(provider)))
    }

    fn with_lender(&self, provider: Provider) -> Provider {
        match (&self.raw.borrowed_from, provider) {
            (Some(lender), Provider::Path) => Provider::Lender(lender.0.clone()),
            (_, provider) => provider,
        }
    }
}

/// Returns the value that a text gives a letter, for display; `None` if it is faulty.
fn display_value(values: &Values<'_>, letter: Letter) -> Option<SmolStr> {
    match values.number(letter) {
        _ if letter == Letter::Variable => {
            let all: Vec<&str> = values.variables().map(|(value, _)| value).collect();
            Some(all.join(" ").into())
        }
        GivenNumber::Number(number) => Some(Number(number).to_smolstr()),
        _ => values.text(letter).map(SmolStr::from),
    }
}

/// Maps each element of a chain, except the first, to the first element of that chain. Empty if the path has errors.
fn chains(raw: &RawPath, bindings: &Bindings, language: &Language) -> BTreeMap<u32, u32> {
    let mut firsts = BTreeMap::new();
    let path = raw.is_sound().then(|| bind(raw, bindings, language).0).flatten();
    let Some(path) = path else { return firsts };
    let walked = walk(&path, language.join_tolerance);
    for item in &walked.items {
        let Item::Chain(chain) = item else { continue };
        let mut members = walked.members(chain).iter().map(|member| member.element(&path));
        let Some(first) = members.next() else { continue };
        for member in members.filter(|member| *member != first) {
            firsts.entry(member).or_insert(first);
        }
    }
    firsts
}
