//! Which parameters hold for each element, and where each comes from. (book: language/letters)

use std::collections::BTreeMap;

use pathbuild_diagnostic::{Number, Word, words};
use smol_str::{SmolStr, ToSmolStr};

use crate::bind::bind;
use crate::chain::Item;
use crate::element::{Element, Origin};
use crate::letter::Letter;
use crate::matrix::{ElementClass, Use};
use crate::name::PathName;
use crate::raw::{Language, RawPath};
use crate::text::TextId;
use crate::values::{Given, Values};
use crate::variables::{Bindings, Interpolation};
use crate::walk::walk;

/// An element with the parameters that hold for it.
#[derive(Clone, Debug, PartialEq)]
pub struct InForce {
    /// Where it is drawn.
    pub origin: Origin,
    /// What it is called.
    pub what: &'static Word,
    /// Letter by letter, in the order of the alphabet.
    pub parameters: Vec<Parameter>,
}

/// A parameter that holds.
#[derive(Clone, Debug, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct Parameter {
    pub letter: Letter,
    /// With variables put in.
    pub value: SmolStr,
    pub from: Provider,
}

/// Where a parameter comes from.
#[derive(Clone, Debug, PartialEq)]
pub enum Provider {
    /// The element's own text.
    Own,
    /// The text of the first segment of its chain.
    Chain,
    /// The text of the path's start.
    Path,
    /// The text of the path that @ names.
    Lender(PathName),
    /// An option, by its name without hyphens.
    Option(&'static str),
    /// What holds where nobody says anything.
    Default,
}

/// What options say where a drawing says nothing; feeds in mm/min, S in mm.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct Fallbacks {
    pub feed: Option<f64>,
    /// Of a path that is emitted. Where it is embedded S is T + O.
    pub sweep_height: Option<f64>,
    pub probe_feed: Option<f64>,
}

impl Provider {
    /// A word for machines.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Own => "own",
            Self::Chain => "chain",
            Self::Path => "path",
            Self::Lender(_) => "lender",
            Self::Option(_) => "option",
            Self::Default => "default",
        }
    }

    /// The same for people.
    pub fn word(&self) -> &'static Word {
        match self {
            Self::Own => &words::OWN_TEXT,
            Self::Chain => &words::CHAIN_TEXT,
            Self::Path => &words::PATH_TEXT,
            Self::Lender(_) => &words::LENDER_TEXT,
            Self::Option(_) => &words::OPTION,
            Self::Default => &words::DEFAULT,
        }
    }

    /// Which path, or which option.
    pub fn which(&self) -> Option<&str> {
        match self {
            Self::Lender(path) => Some(path.as_str()),
            Self::Option(name) => Some(name),
            Self::Own | Self::Chain | Self::Path | Self::Default => None,
        }
    }
}

/// The parameters of a path's start, of its elements in their order, and of its probes. What is wrong with them is no matter here.
pub fn parameters_in_force(
    raw: &RawPath,
    bindings: &Bindings,
    fallbacks: &Fallbacks,
    language: &Language,
) -> Vec<InForce> {
    let table = Table::new(raw, bindings, fallbacks, language);
    let start = raw.start.iter().map(|start| table.row(start.origin.clone(), ElementClass::PathStart, None));
    let elements = (0_u32..).zip(&raw.drawn.elements).map(|(number, element)| table.element(number, element));
    let probe =
        |probe: &crate::element::Marker| table.row(probe.origin.clone(), ElementClass::Probe, probe.text);
    start.chain(elements).chain(raw.probes.iter().map(probe)).collect()
}

struct Table<'a> {
    raw: &'a RawPath,
    interpolation: Interpolation<'a>,
    fallbacks: &'a Fallbacks,
    /// The path's own.
    values: Values<'a>,
    /// The first elements of the chains that others are in.
    chains: BTreeMap<u32, u32>,
}

impl<'a> Table<'a> {
    fn new(raw: &'a RawPath, bindings: &'a Bindings, fallbacks: &'a Fallbacks, language: &Language) -> Self {
        let interpolation = Interpolation { bindings, limit: language.text_limit };
        let values = Values::of_path(raw.parameters(), &interpolation);
        let chains = chains(raw, bindings, language);
        Self { raw, interpolation, fallbacks, values, chains }
    }

    fn element(&self, number: u32, element: &Element) -> InForce {
        let class = element.class(self.raw.tool());
        let mut row = self.row(self.raw.drawn.origin(element), class, element.text);
        let Some(first) = self.chains.get(&number) else { return row };
        let first = &self.raw.drawn.elements[*first as usize];
        let of_first = self.row(self.raw.drawn.origin(first), first.class(self.raw.tool()), first.text);
        let is_chains = |letter: Letter| matches!(class.use_of(letter), Use::Chain | Use::ChainNeeded);
        row.parameters.retain(|own| !is_chains(own.letter));
        row.parameters.extend(of_first.parameters.into_iter().filter(|of| is_chains(of.letter)).map(|of| {
            let from = if of.from == Provider::Own { Provider::Chain } else { of.from };
            Parameter { from, ..of }
        }));
        row.parameters.sort_by_key(|parameter| parameter.letter);
        row
    }

    fn row(&self, origin: Origin, class: ElementClass, text: Option<TextId>) -> InForce {
        let text = self.raw.drawn.text(text).filter(|_| class != ElementClass::Unread);
        let own = text.map(|text| Values::of(text, &self.interpolation)).unwrap_or_default();
        let letters = Letter::ALL.into_iter().map(|(_, letter)| letter);
        let parameter = |letter| {
            let (value, from) = self.parameter(class, &own, letter)?;
            Some(Parameter { letter, value, from })
        };
        // All of which no text is read are swept along.
        let what = if class == ElementClass::Unread { &words::SWEEP } else { class.word() };
        InForce { origin, what, parameters: letters.filter_map(parameter).collect() }
    }

    /// What a letter says on an element, by the table of letters.
    fn parameter(
        &self,
        class: ElementClass,
        own: &Values<'_>,
        letter: Letter,
    ) -> Option<(SmolStr, Provider)> {
        let usage = match class {
            // Its text is not read: it is swept at the path's height.
            ElementClass::Unread if letter == Letter::S => Use::PathOnly,
            ElementClass::Unread => return None,
            _ => class.use_of(letter),
        };
        let is_start = class == ElementClass::PathStart;
        match usage {
            Use::Unknown | Use::Ignored => return None,
            Use::PathOnly => {}
            _ if is_start => {}
            _ => {
                if own.has(letter) {
                    return Some((said(own, letter)?, Provider::Own));
                }
                // What only the element itself can say.
                if letter.is_text() && letter != Letter::M {
                    return None;
                }
            }
        }
        if letter == Letter::At {
            return None;
        }
        if self.values.has(letter) {
            return Some((said(&self.values, letter)?, self.path()));
        }
        let (value, from) = self.fallback(class, letter)?;
        Some((Number(value).to_smolstr(), from))
    }

    fn path(&self) -> Provider {
        self.raw.borrowed_from.as_ref().map_or(Provider::Path, |lender| Provider::Lender(lender.0.clone()))
    }

    /// What holds where neither the element nor the path says anything.
    fn fallback(&self, class: ElementClass, letter: Letter) -> Option<(f64, Provider)> {
        let number = |letter| self.values.number(letter).number();
        let Fallbacks { feed, sweep_height, probe_feed } = *self.fallbacks;
        let option = |value: Option<f64>, name| value.map(|value| (value, Provider::Option(name)));
        let tool = number(Letter::O);
        match (letter, class) {
            (Letter::F, _) => option(feed, "feed"),
            (Letter::S, _) => option(sweep_height, "sweep-height")
                .or_else(|| Some((number(Letter::T)? + tool?, Provider::Default))),
            (Letter::A, ElementClass::PathStart) => None,
            (Letter::A, _) => Some((4.0 * tool?, Provider::Default)),
            (Letter::H, ElementClass::Subpath | ElementClass::Probe) => Some((0.0, Provider::Default)),
            (Letter::Z, ElementClass::Probe) => option(probe_feed, "probe-feed")
                .or_else(|| Some((number(Letter::F)?, self.path())))
                .or_else(|| option(feed, "feed")),
            _ => None,
        }
    }
}

/// What a text says of a letter; `None` where that is no value.
fn said(values: &Values<'_>, letter: Letter) -> Option<SmolStr> {
    match values.number(letter) {
        _ if letter == Letter::Variable => {
            let all: Vec<&str> = values.variables().map(|(value, _)| value).collect();
            Some(all.join(" ").into())
        }
        Given::Number(number) => Some(Number(number).to_smolstr()),
        _ => values.text(letter).map(SmolStr::from),
    }
}

/// For each element behind the first of a chain that first one. None where the path has errors.
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
