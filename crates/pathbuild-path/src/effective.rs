//! Effective parameters: the value of a letter on an element, and its provider. Binding, the fold, closures and the lists of parameters all use
//! this module, so that each rule has a single implementation. (book: language/letters)

use pathbuild_diagnostic::{Text, words};

use crate::letter::{ElementClass, Letter, LetterUse};
use crate::names::PathName;
use crate::values::{GivenNumber, Values};

/// Option values that apply if a drawing gives none. Feeds are in mm/min, lengths in mm.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PathOptions {
    /// `--feed`: F in mm/min. Paths that need it must not be folded without it.
    pub feed: Option<f64>,
    /// `--sweep-height`: S of the emitted path in mm. Paths that need it must not be folded without it.
    pub sweep_height: Option<f64>,
    /// `--probe-feed`: Z in mm/min. Without this option, Z defaults to a feed: F of the path (not in compatible mode) or `--feed`.
    pub probe_feed: Option<f64>,
    /// Whether to follow `PathDxf2GCode` even where it deviates from its manuals. (book: program/compatible)
    pub compatible: bool,
}

/// The use of a path, which determines its sweep height.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PathRole {
    /// A program is written for the path.
    Emitted,
    /// The path is embedded, or checked on its own.
    Embedded,
}

/// The parameters of a path from which defaults follow.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PathNumbers {
    /// Cutter diameter (O) in mm.
    pub tool: Option<f64>,
    /// Thickness of the material (T) in mm.
    pub thickness: Option<f64>,
    /// Feed (F) in mm/min.
    pub feed: Option<f64>,
}

/// The origin of a parameter's value.
#[derive(Clone, Debug, PartialEq)]
pub enum Provider {
    /// The element's own text.
    Own,
    /// The text of the first segment of the element's chain.
    Chain,
    /// The text of the path's start.
    Path,
    /// The text of the path named by @.
    Lender(PathName),
    /// An option, by its name without hyphens.
    Option(&'static str),
    /// The default of the language.
    Default,
}

/// The texts that can give an element its parameters.
#[derive(Clone, Copy)]
pub(crate) struct Texts<'v, 't> {
    pub(crate) class: ElementClass,
    pub(crate) own: &'v Values<'t>,
    /// The text of the first segment of the element's chain, if that is another element.
    pub(crate) chain: Option<&'v Values<'t>>,
    pub(crate) path: &'v Values<'t>,
}

impl PathNumbers {
    /// Returns the sweep height (S) for a path that does not give it: the value of `--sweep-height` for an emitted path, or the default for an
    /// embedded one. `None` if the option is needed but missing, or if O or T, from which the default follows, is unknown.
    pub(crate) fn sweep_height(self, options: &PathOptions, role: PathRole) -> Option<f64> {
        fallback(Letter::S, ElementClass::PathStart, self, options, role).map(|(height, _)| height)
    }
}

impl Provider {
    /// The name of the provider in JSON.
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

    /// The name of the provider in messages.
    pub fn word(&self) -> &'static Text {
        match self {
            Self::Own => &words::OWN_TEXT,
            Self::Chain => &words::CHAIN_TEXT,
            Self::Path => &words::PATH_TEXT,
            Self::Lender(_) => &words::LENDER_TEXT,
            Self::Option(_) => &words::OPTION,
            Self::Default => &words::DEFAULT,
        }
    }

    /// The name of the lending path or of the option, for providers that have a name.
    pub fn provider_name(&self) -> Option<&str> {
        match self {
            Self::Lender(path) => Some(path.as_str()),
            Self::Option(name) => Some(name),
            Self::Own | Self::Chain | Self::Path | Self::Default => None,
        }
    }
}

impl<'v, 't> Texts<'v, 't> {
    /// Returns the values that contain a letter, and their origin; `None` if no applicable text contains it.
    pub(crate) fn source(&self, letter: Letter) -> Option<(&'v Values<'t>, Provider)> {
        let own = match use_of(self.class, letter) {
            LetterUse::Unknown | LetterUse::Ignored => return None,
            LetterUse::PathOnly => None,
            // For the path's start, the element's own text is the path's text.
            LetterUse::Needed | LetterUse::Allowed if self.class == ElementClass::PathStart => None,
            LetterUse::ChainNeeded | LetterUse::Chain => {
                Some(self.chain.map_or((self.own, Provider::Own), |chain| (chain, Provider::Chain)))
            }
            LetterUse::Needed | LetterUse::Allowed => Some((self.own, Provider::Own)),
        };
        let path = || {
            let can_inherit =
                self.class == ElementClass::PathStart || !letter.is_text() || letter == Letter::M;
            can_inherit.then_some((self.path, Provider::Path))
        };
        let has = |(values, _): &(&Values<'_>, Provider)| values.may_give(letter);
        own.filter(has).or_else(|| path().filter(has))
    }

    #[inline]
    pub(crate) fn number(&self, letter: Letter) -> GivenNumber {
        self.source(letter).map_or(GivenNumber::Absent, |(values, _)| values.number(letter))
    }

    /// Returns the number that the texts give for a letter, or else the language's default. Options are not considered.
    pub(crate) fn number_or_default(&self, letter: Letter) -> Option<f64> {
        match self.number(letter) {
            GivenNumber::Absent => {
                let options = PathOptions::default();
                let path = PathNumbers::of(self.path);
                fallback(letter, self.class, path, &options, PathRole::Embedded).map(|(value, _)| value)
            }
            given => given.number(),
        }
    }
}

impl PathNumbers {
    pub(crate) fn of(path: &Values<'_>) -> Self {
        let number = |letter| path.number(letter).number();
        Self { tool: number(Letter::O), thickness: number(Letter::T), feed: number(Letter::F) }
    }
}

/// Returns the use of a letter on an element. Elements with an ignored text are swept at the path's height.
fn use_of(class: ElementClass, letter: Letter) -> LetterUse {
    match (class, letter) {
        (ElementClass::Unread, Letter::S) => LetterUse::PathOnly,
        (_, Letter::At) | (ElementClass::Unread, _) => LetterUse::Unknown,
        _ => class.use_of(letter),
    }
}

/// Returns the value of a letter that no text gives, and its origin: an option, [`Provider::Path`] where the path's F serves as Z, or
/// [`Provider::Default`], also where the default follows from the path's O and T.
pub fn fallback(
    letter: Letter,
    class: ElementClass,
    path: PathNumbers,
    options: &PathOptions,
    role: PathRole,
) -> Option<(f64, Provider)> {
    if matches!(use_of(class, letter), LetterUse::Unknown | LetterUse::Ignored) {
        return None;
    }
    let option = |value: Option<f64>, name| value.map(|value| (value, Provider::Option(name)));
    match (letter, class) {
        (Letter::F, _) => option(options.feed, "feed"),
        (Letter::S, _) => match role {
            PathRole::Emitted => option(options.sweep_height, "sweep-height"),
            PathRole::Embedded => Some((path.thickness? + path.tool?, Provider::Default)),
        },
        (Letter::A, ElementClass::PathStart) => None,
        (Letter::A, _) => Some((4.0 * path.tool?, Provider::Default)),
        (Letter::H, ElementClass::Subpath | ElementClass::Probe) => Some((0.0, Provider::Default)),
        (Letter::Z, ElementClass::Probe) => option(options.probe_feed, "probe-feed")
            .or_else(|| path.feed.filter(|_| !options.compatible).map(|feed| (feed, Provider::Path)))
            .or_else(|| option(options.feed, "feed")),
        _ => None,
    }
}
