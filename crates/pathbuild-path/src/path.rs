//! Paths: raw paths with their variables bound and every parameter known. (book: language/letters, book: language/chains-and-passes)

use std::sync::Arc;

use pathbuild_diagnostic::{EntityKind, Point, TextFault, Word, words};
use smol_str::SmolStr;

use crate::effective::{PathNumbers, PathOptions, PathRole, fallback};
use crate::element::{Cut, Element, Origin, Shape};
use crate::faults::Faults;
use crate::geometry::{Curve, Xy};
use crate::letter::{Letter, Letters};
use crate::matrix::ElementClass;
use crate::name::{PathName, SpeltName};
use crate::raw::Drawn;
use crate::text::TextId;

/// A path whose parameters are all there and within their limits.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// As its layer spells it.
    pub name: SpeltName,
    /// O in mm.
    pub tool: f64,
    /// T in mm.
    pub thickness: f64,
    /// S in mm, where the path gives one; what holds else depends on its role: [`Path::embedded_sweep_height`].
    pub sweep_height: Option<f64>,
    /// M.
    pub material: Option<SmolStr>,
    /// F in mm/min.
    pub feed: Option<f64>,
    /// R.
    pub output_suffix: SmolStr,
    /// E: the regular expression that names of embedded paths must match.
    pub embeds_only: Option<SmolStr>,
    /// Where it starts.
    pub start: Xy,
    /// Where it ends.
    pub end: Xy,
    /// Turn markers.
    pub turns: Vec<Turn>,
    /// What is drawn, shared with the raw path.
    pub drawn: Arc<Drawn>,
    /// Segments in their order: circles, lines, arcs.
    pub segments: Vec<Segment>,
    /// How its milling, marking and support segments are milled.
    pub cuts: Vec<CutParameters>,
    /// How its drilled holes and marks are drilled.
    pub holes: Vec<Hole>,
    /// Its helical circles.
    pub helices: Vec<Helix>,
    /// Z-probes in file order.
    pub probes: Vec<Probe>,
    /// The upper face that S must be above, and those of its probes that have their own T. None where S is its own, which is checked with
    /// its other values.
    pub(crate) surface: Option<Surface>,
    pub(crate) probe_surfaces: Vec<Surface>,
    /// The start marker.
    pub start_origin: Origin,
    /// The end marker.
    pub end_origin: Origin,
    /// Curves that are no part of it.
    pub left_out: Vec<(EntityKind, Option<Point>)>,
    /// What is not known of it because it has errors.
    pub(crate) faults: Option<Box<Faults>>,
}

/// An upper face of the material.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Surface {
    /// What says so.
    pub(crate) origin: Origin,
    /// T in mm.
    pub(crate) thickness: f64,
    /// The text that may say so, see [`Drawn::texts`].
    pub(crate) text: Option<TextId>,
}

/// A turn marker.
#[derive(Clone, Debug, PartialEq)]
#[expect(missing_docs, reason = "a point")]
pub struct Turn {
    pub origin: Origin,
    pub at: Xy,
}

/// A Z-probe. (book: language/probes)
#[derive(Clone, Debug, PartialEq)]
pub struct Probe {
    /// The circle.
    pub origin: Origin,
    /// Its centre.
    pub at: Xy,
    /// T + H: the height that is expected there, before what the path is raised by. mm.
    pub height: f64,
    /// Z: probing feed in mm/min.
    pub feed: Option<f64>,
    /// L.
    pub label: Option<Box<str>>,
    /// Its own text, see [`Drawn::texts`].
    pub(crate) text: Option<TextId>,
}

/// What the walk goes along.
#[derive(Clone, Debug, PartialEq)]
pub struct Segment {
    /// What is drawn: index into [`Drawn::elements`].
    pub element: u32,
    /// Order at a star: N, or what its kind has.
    pub order: f64,
    /// What it is.
    pub kind: SegmentKind,
}

/// The kinds of segments.
#[derive(Clone, Debug, PartialEq)]
#[expect(missing_docs, reason = "glossary in book: reference/glossary")]
pub enum SegmentKind {
    /// Member of a milling chain: index into [`Path::cuts`].
    Cut(u32),
    /// Index into [`Path::holes`].
    Hole(u32),
    /// Index into [`Path::helices`].
    Helix(u32),
    /// Its own S in mm; else the path's.
    Sweep {
        height: Option<f64>,
    },
    Subpath(Box<Subpath>),
}

/// How a milling, marking or support segment is milled. Lengths in mm, feeds in mm/min.
#[derive(Clone, Debug, PartialEq)]
pub struct CutParameters {
    /// What it leaves.
    pub cut: Cut,
    /// F.
    pub feed: Option<f64>,
    /// Z of the bottom: B, or D of a mark.
    pub bottom: f64,
    /// Bars along it, for [`Cut::Support`].
    pub bars: Option<Bars>,
    /// I, C and W, which count where it is the first of its chain.
    pub chain: ChainParameters,
    /// Its own text, where that gives I, C or W, see [`Drawn::texts`].
    pub chain_letters: Option<TextId>,
    /// Q.
    pub comment: Option<SmolStr>,
}

/// Parameters of a whole chain.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ChainParameters {
    /// I: infeed per pass.
    pub infeed: Option<f64>,
    /// C: peck depth.
    pub peck: Option<f64>,
    /// W: first depth of sweepless milling.
    pub first_depth: Option<f64>,
}

/// Support bars of 45 degree slopes, cut to their number along a segment. (book: program/gcode)
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bars {
    /// D: Z of their top.
    pub top: f64,
    /// P: length of a bar.
    pub length: f64,
    /// U: least distance between bars.
    pub distance: f64,
}

/// How a hole or mark is drilled.
#[derive(Clone, Debug, PartialEq)]
#[expect(missing_docs, reason = "as in CutParameters; peck is C")]
pub struct Hole {
    pub bottom: f64,
    pub feed: Option<f64>,
    pub peck: Option<f64>,
    pub comment: Option<SmolStr>,
}

/// A helical circle, mark or circle with bars.
#[derive(Clone, Debug, PartialEq)]
pub struct Helix {
    /// Centre.
    pub centre: Xy,
    /// Of the drawn circle: the outer one.
    pub radius: f64,
    /// Z down to which it is milled whole: B, or D of a mark and with bars.
    pub bottom: f64,
    /// B below, and the bars, for circles with bars.
    pub bars: Option<(f64, Bars)>,
    /// F.
    pub feed: Option<f64>,
    /// I.
    pub infeed: f64,
    /// Q.
    pub comment: Option<SmolStr>,
}

/// A path to embed.
#[derive(Clone, Debug, PartialEq)]
pub struct Subpath {
    /// Where the embedded path's start comes to lie.
    pub start: Xy,
    /// The direction in which its end lies.
    pub end: Xy,
    /// Which path.
    pub name: SubpathName,
    /// T, own or the path's.
    pub thickness: f64,
    /// O.
    pub tool: f64,
    /// Of these letters errors hide the values.
    pub(crate) unknown: Letters,
    /// M.
    pub material: Option<SmolStr>,
    /// H: how much it is raised.
    pub height: f64,
    /// Values of its variables, in the order written.
    pub values: Vec<SubpathValue>,
    /// Its own text, see [`Drawn::texts`]. See [`Path::fault`].
    pub text: Option<TextId>,
}

/// What a subpath's text says of the name.
#[derive(Clone, Debug, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum SubpathName {
    Missing {
        text: Option<TextFault>,
    },
    Invalid {
        value: Box<str>,
    },
    /// `has_more`: the whole value, where there is more in it than the name.
    Found {
        name: SpeltName,
        has_more: Option<Box<str>>,
    },
}

/// A value for a variable of the embedded path.
#[derive(Clone, Debug, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct SubpathValue {
    pub variable: Option<char>,
    pub value: SmolStr,
    pub text: TextFault,
}

impl Path {
    /// Whether it has errors: it is judged further, but no program is made of it.
    pub fn has_faults(&self) -> bool {
        self.faults.is_some()
    }

    /// Whether the path or any of its segments says I.
    pub(crate) fn gives_infeed(&self) -> bool {
        self.cuts.iter().any(|cut| cut.chain.infeed.is_some())
    }

    /// Whether errors hide what the path says of a letter.
    pub fn hides(&self, letter: Letter) -> bool {
        self.unknown_letters().contains(letter)
    }

    /// The letters of which errors hide what the path says.
    pub(crate) fn unknown_letters(&self) -> Letters {
        self.faults.as_ref().map_or_else(Letters::default, |faults| faults.letters)
    }

    /// S of the path where it is embedded or checked: its own, else the default.
    pub fn embedded_sweep_height(&self) -> f64 {
        self.sweep_height(&PathOptions::default(), PathRole::Embedded).unwrap_or_default()
    }

    /// S of the path in a role: its own, else that of the option or the default; `None` where an option is missing.
    pub fn sweep_height(&self, options: &PathOptions, role: PathRole) -> Option<f64> {
        self.sweep_height.or_else(|| {
            let height = fallback(Letter::S, ElementClass::PathStart, self.numbers(), options, role);
            height.map(|(height, _)| height)
        })
    }

    /// The numbers from which fallbacks follow.
    pub fn numbers(&self) -> PathNumbers {
        PathNumbers { tool: Some(self.tool), thickness: Some(self.thickness), feed: self.feed }
    }

    /// Whether anything in it is milled at the feed of the options.
    pub fn needs_feed(&self) -> bool {
        self.feed.is_none()
            && self.segments.iter().any(|segment| match &segment.kind {
                // Coming down to a chain's edge is reckoned with the path's feed, whatever its segments say.
                SegmentKind::Cut(_) => true,
                SegmentKind::Hole(hole) => self.holes[*hole as usize].feed.is_none(),
                SegmentKind::Helix(helix) => self.helices[*helix as usize].feed.is_none(),
                SegmentKind::Sweep { .. } | SegmentKind::Subpath(_) => false,
            })
    }

    /// Where a segment of it is drawn.
    pub fn origin(&self, segment: &Segment) -> Origin {
        self.drawn.origin(self.element(segment))
    }

    /// A subpath's own text with a letter underlined, where it gives that.
    pub fn fault(&self, subpath: &Subpath, letter: Letter) -> Option<TextFault> {
        self.drawn.text(subpath.text)?.fault_of(letter)
    }

    /// Where a segment of it starts and where it ends, as drawn.
    pub fn ends(&self, segment: &Segment) -> [Xy; 2] {
        match &self.element(segment).shape {
            Shape::Curve(curve) => [curve.start(), curve.end()],
            Shape::Circle { centre, .. } => [*centre; 2],
        }
    }

    /// What a segment of it is drawn as; `None` for circles.
    pub(crate) fn curve(&self, segment: &Segment) -> Option<Curve> {
        match self.element(segment).shape {
            Shape::Curve(curve) => Some(curve),
            Shape::Circle { .. } => None,
        }
    }

    fn element(&self, segment: &Segment) -> &Element {
        &self.drawn.elements[segment.element as usize]
    }
}

impl Subpath {
    /// Whether errors hide T, O or M of the segment.
    pub fn hides(&self, letter: Letter) -> bool {
        self.unknown.contains(letter)
    }
}

impl Segment {
    /// The path that it names, where it is a subpath segment that names one.
    pub fn embedded_name(&self) -> Option<&PathName> {
        match &self.kind {
            SegmentKind::Subpath(subpath) => match &subpath.name {
                SubpathName::Found { name, .. } => Some(name),
                SubpathName::Missing { .. } | SubpathName::Invalid { .. } => None,
            },
            _ => None,
        }
    }

    /// What of several segments at a point comes first when their orders are equal.
    pub(crate) fn preference(&self) -> u8 {
        match self.kind {
            SegmentKind::Hole(_) => 1,
            SegmentKind::Helix(_) => 2,
            SegmentKind::Subpath(_) => 3,
            SegmentKind::Cut(_) => 4,
            SegmentKind::Sweep { .. } => 5,
        }
    }
}

impl CutParameters {
    /// What a segment of this kind is called.
    pub(crate) fn word(&self) -> &'static Word {
        match self.cut {
            Cut::Mill => &words::MILLING_SEGMENT,
            Cut::Mark => &words::MARKING_SEGMENT,
            Cut::Support => &words::SUPPORT_SEGMENT,
        }
    }
}

impl Bars {
    /// How many bars a segment of this length gets.
    pub fn count(&self, length: f64) -> f64 {
        (length / (self.distance + self.length)).floor()
    }
}
