//! Paths: raw paths with bound variables and all parameters resolved. (book: language/letters, book: language/chains-and-passes)

use std::sync::Arc;

use pathbuild_diagnostic::{EntityKind, Point, Text, TextFault, words};
use smol_str::SmolStr;

use crate::approx::near;
use crate::effective::{PathNumbers, PathOptions, PathRole};
use crate::element::{Cut, Element, Origin, Shape};
use crate::geometry::{Curve, Xy};
use crate::letter::{Letter, Letters};
use crate::names::CaseSensitiveName;
use crate::raw::{DrawnElements, PathUncertainty};
use crate::text::TextId;

/// A path with all parameters present and within their limits, unless it has [faults](Self::has_faults).
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// Name of the path, in the spelling of its layer.
    pub name: CaseSensitiveName,
    /// Cutter diameter (O) in mm.
    pub tool: f64,
    /// Whether the cutter may be wider than its shank, so that it must not rise in its groove: it is configured as a slot cutter, or
    /// not configured.
    pub may_be_slot_cutter: bool,
    /// Thickness of the material (T) in mm.
    pub thickness: f64,
    /// S in mm, if the path gives it; the default depends on its role: [`Path::embedded_sweep_height`].
    pub sweep_height: Option<f64>,
    /// Name of the material (M).
    pub material: Option<SmolStr>,
    /// Feed (F) in mm/min.
    pub feed: Option<f64>,
    /// Suffix of the output file's name (R).
    pub output_suffix: SmolStr,
    /// E: the regular expression for names of embedded paths.
    pub embeds_only: Option<SmolStr>,
    /// Centre of the start marker.
    pub start: Xy,
    /// Centre of the end marker.
    pub end: Xy,
    /// Turn markers.
    pub turns: Vec<Turn>,
    /// The drawn elements, shared with the raw path.
    pub drawn: Arc<DrawnElements>,
    /// Segments in order: circles, lines, arcs.
    pub segments: Vec<Segment>,
    /// Parameters of the milling, marking and support segments.
    pub cuts: Vec<CutParameters>,
    /// Parameters of the drilled holes and drilled marks.
    pub holes: Vec<Hole>,
    /// Parameters of the helical circles.
    pub helices: Vec<Helix>,
    /// Z-probes in file order.
    pub probes: Vec<Probe>,
    /// The upper face that S must clear; probes with their own T have further ones. `None` if the path gives its own S, which is checked
    /// together with its other values.
    pub(crate) surface: Option<Surface>,
    pub(crate) probe_surfaces: Vec<Surface>,
    /// Location of the start marker.
    pub start_origin: Origin,
    /// Location of the end marker.
    pub end_origin: Origin,
    /// Curves on the path's layers that do not belong to it, with their start points if known.
    pub left_out: Vec<(EntityKind, Option<Point>)>,
    /// Properties that errors leave unknown; `None` for a path without errors and with all needed values.
    pub(crate) uncertainty: Option<Box<PathUncertainty>>,
}

/// An upper face of the material.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Surface {
    /// The element that gives T.
    pub(crate) origin: Origin,
    /// Thickness of the material (T) in mm.
    pub(crate) thickness: f64,
    /// The text that may give T, see [`DrawnElements::texts`].
    pub(crate) text: Option<TextId>,
}

/// A turn marker, at which the tool goes back.
#[derive(Clone, Debug, PartialEq)]
#[expect(missing_docs, reason = "a point")]
pub struct Turn {
    pub origin: Origin,
    pub at: Xy,
}

/// A Z-probe. (book: language/probes)
#[derive(Clone, Debug, PartialEq)]
pub struct Probe {
    /// Location of the probe's circle.
    pub origin: Origin,
    /// Centre of the circle.
    pub at: Xy,
    /// T + H: the expected height in mm, without the height that the path is raised by.
    pub height: f64,
    /// Z: probing feed in mm/min.
    pub feed: Option<f64>,
    /// Label (L).
    pub label: Option<Box<str>>,
    /// The probe's own text, see [`DrawnElements::texts`].
    pub(crate) text: Option<TextId>,
}

/// A segment of a path: an element that the walk traverses.
#[derive(Clone, Debug, PartialEq)]
pub struct Segment {
    /// The segment's element, as an index into [`DrawnElements::elements`].
    pub element: u32,
    /// Order among the segments that meet at a point: N, or the default for the kind of segment.
    pub order: f64,
    /// The kind of segment, with its parameters or their index.
    pub kind: SegmentKind,
}

/// The kind of a segment, with its parameters or their index.
#[derive(Clone, Debug, PartialEq)]
#[expect(missing_docs, reason = "glossary in book: reference/glossary")]
pub enum SegmentKind {
    /// Member of a milling chain, as an index into [`Path::cuts`].
    Cut(u32),
    /// A drilled hole or drilled mark, as an index into [`Path::holes`].
    Hole(u32),
    /// A helical circle, as an index into [`Path::helices`].
    Helix(u32),
    /// A sweep. `height`: its own S in mm; `None` if the path's S applies.
    Sweep {
        height: Option<f64>,
    },
    Subpath(Box<Subpath>),
}

/// Parameters of a milling, marking or support segment. Lengths are in mm, feeds in mm/min.
#[derive(Clone, Debug, PartialEq)]
pub struct CutParameters {
    /// The kind of cut.
    pub cut: Cut,
    /// Feed (F).
    pub feed: Option<f64>,
    /// Z of the bottom: B, or D of a mark.
    pub bottom: f64,
    /// Support bars, for [`Cut::Support`].
    pub bars: Option<Bars>,
    /// I and W, which apply if the segment is the first of its chain.
    pub chain: ChainParameters,
    /// The segment's own text, if it gives I or W; see [`DrawnElements::texts`].
    pub chain_letters: Option<TextId>,
    /// Comment for the program (Q).
    pub comment: Option<SmolStr>,
}

/// Parameters of a whole chain.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ChainParameters {
    /// I: infeed per pass.
    pub infeed: Option<f64>,
    /// W: Z of the first pass of a chain that is milled without lifting. (book: language/sweepless)
    pub first_depth: Option<f64>,
}

/// Support bars with slopes at their ends, spread along a segment. (book: program/gcode)
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bars {
    /// D: Z of the top.
    pub top: f64,
    /// P: length of a bar.
    pub length: f64,
    /// U: minimum distance between bars.
    pub distance: f64,
}

/// Parameters of a drilled hole or drilled mark.
#[derive(Clone, Debug, PartialEq)]
#[expect(missing_docs, reason = "as in CutParameters; peck is C")]
pub struct Hole {
    pub bottom: f64,
    pub feed: Option<f64>,
    pub peck: Option<f64>,
    pub comment: Option<SmolStr>,
}

/// A helical circle, possibly a mark or with bars.
#[derive(Clone, Debug, PartialEq)]
pub struct Helix {
    /// Centre of the circle.
    pub centre: Xy,
    /// Radius of the drawn circle, which is the outer one.
    pub radius: f64,
    /// Z down to which the whole circle is milled: B, or D for marks and circles with bars.
    pub bottom: f64,
    /// For circles with bars: Z down to which the circle is milled between the bars (B), and the bars.
    pub bars: Option<(f64, Bars)>,
    /// Feed (F) in mm/min.
    pub feed: Option<f64>,
    /// I: greatest depth of a turn, in mm.
    pub infeed: f64,
    /// Q: comment for the program.
    pub comment: Option<SmolStr>,
}

/// Parameters of a subpath segment.
#[derive(Clone, Debug, PartialEq)]
pub struct Subpath {
    /// The position of the embedded path's start.
    pub start: Xy,
    /// The point that determines the direction to the embedded path's end.
    pub end: Xy,
    /// The name of the embedded path, as far as the text gives one.
    pub name: SubpathName,
    /// T in mm, from the segment or the path.
    pub thickness: f64,
    /// O in mm, from the segment or the path.
    pub tool: f64,
    /// Letters with values that are hidden by errors.
    pub(crate) unknown: Letters,
    /// M, from the segment or the path.
    pub material: Option<SmolStr>,
    /// H in mm: the height that the embedded path is raised by.
    pub height: f64,
    /// Values for the variables of the embedded path, in the order written.
    pub values: Vec<SubpathValue>,
    /// The segment's own text, see [`DrawnElements::texts`] and [`Path::fault`].
    pub text: Option<TextId>,
}

/// The name in a subpath's text.
#[derive(Clone, Debug, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum SubpathName {
    /// `is_point`: the segment has no length, so no text can belong to it.
    Missing {
        text: Option<TextFault>,
        is_point: bool,
    },
    Invalid {
        value: Box<str>,
    },
    /// `whole_value`: the whole value, if it contains more than the name.
    Found {
        name: CaseSensitiveName,
        whole_value: Option<Box<str>>,
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
    /// Returns B of a segment with support bars: Z in mm down to which it mills between its bars. `None` without bars.
    pub fn bottom_between_bars(&self, segment: &Segment) -> Option<f64> {
        match segment.kind {
            SegmentKind::Cut(cut) => {
                let cut = &self.cuts[cut as usize];
                cut.bars.as_ref().map(|_| cut.bottom)
            }
            SegmentKind::Helix(helix) => {
                self.helices[helix as usize].bars.as_ref().map(|(bottom, _)| *bottom)
            }
            _ => None,
        }
    }

    /// Whether the path has errors, or a value that it needs is unknown. Such a path is checked further, but gives no program.
    pub fn has_faults(&self) -> bool {
        self.uncertainty.is_some()
    }

    /// Whether it is known where and how deep the path cuts, despite any errors.
    pub fn are_cuts_known(&self) -> bool {
        self.uncertainty.as_ref().is_none_or(|uncertainty| uncertainty.are_cuts_known)
    }

    /// Whether the path or any of its segments gives I.
    pub(crate) fn gives_infeed(&self) -> bool {
        self.cuts.iter().any(|cut| cut.chain.infeed.is_some())
    }

    /// Whether errors hide the value of a letter.
    pub fn hides(&self, letter: Letter) -> bool {
        self.unknown_letters().contains(letter)
    }

    /// Returns the letters with values that are hidden by errors.
    pub(crate) fn unknown_letters(&self) -> Letters {
        self.uncertainty.as_ref().map_or_else(Letters::default, |uncertainty| uncertainty.letters)
    }

    /// S of the path when embedded or checked: its own, or the default.
    pub fn embedded_sweep_height(&self) -> f64 {
        self.sweep_height(&PathOptions::default(), PathRole::Embedded).unwrap_or_default()
    }

    /// The sweep height (S) of the path in a role: its own, or else the value of `--sweep-height` for an emitted path, or the default for an embedded
    /// one. `None` if the option is required but missing.
    pub fn sweep_height(&self, options: &PathOptions, role: PathRole) -> Option<f64> {
        self.sweep_height.or_else(|| self.numbers().sweep_height(options, role))
    }

    /// Returns the values of the path from which defaults follow.
    pub fn numbers(&self) -> PathNumbers {
        PathNumbers { tool: Some(self.tool), thickness: Some(self.thickness), feed: self.feed }
    }

    /// Whether the path needs `--feed`: it gives no F, and at least one of its elements uses the path's F.
    pub fn needs_feed(&self) -> bool {
        self.feed.is_none()
            && self.segments.iter().any(|segment| match &segment.kind {
                // The plunge into a chain may use the path's feed, whatever feeds its segments give.
                SegmentKind::Cut(_) => true,
                SegmentKind::Hole(hole) => self.holes[*hole as usize].feed.is_none(),
                SegmentKind::Helix(helix) => self.helices[*helix as usize].feed.is_none(),
                SegmentKind::Sweep { .. } | SegmentKind::Subpath(_) => false,
            })
    }

    /// Returns the location of a segment's element.
    pub fn origin(&self, segment: &Segment) -> Origin {
        self.drawn.origin(self.element(segment))
    }

    /// Returns a subpath's own text with a letter underlined, if it gives that letter.
    pub fn fault(&self, subpath: &Subpath, letter: Letter) -> Option<TextFault> {
        self.drawn.text(subpath.text)?.fault_of(letter)
    }

    /// Returns the drawn start and end of a segment.
    pub fn ends(&self, segment: &Segment) -> [Xy; 2] {
        match &self.element(segment).shape {
            Shape::Curve(curve) => [curve.start(), curve.end()],
            Shape::Circle { centre, .. } => [*centre; 2],
        }
    }

    /// Returns the drawn curve of a segment; `None` for circles.
    pub(crate) fn curve(&self, segment: &Segment) -> Option<Curve> {
        match self.element(segment).shape {
            Shape::Curve(curve) => Some(curve),
            Shape::Circle { .. } => None,
        }
    }

    pub(crate) fn element(&self, segment: &Segment) -> &Element {
        &self.drawn.elements[segment.element as usize]
    }
}

impl Subpath {
    /// Whether errors hide the value of a letter: T, O or M.
    pub fn hides(&self, letter: Letter) -> bool {
        self.unknown.contains(letter)
    }
}

impl Segment {
    /// Rank among segments with the same order at a point; the segment with the smallest rank comes first.
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
    /// Returns the name of a segment with these parameters in messages.
    pub(crate) fn word(&self) -> &'static Text {
        match self.cut {
            Cut::Mill => &words::MILLING_SEGMENT,
            Cut::Mark => &words::MARKING_SEGMENT,
            Cut::Support => &words::SUPPORT_SEGMENT,
        }
    }
}

impl Helix {
    /// Radius of the circle on which the axis of a cutter of diameter `tool` moves, to mill a circle of radius `drawn`.
    pub(crate) fn radius_of_axis(drawn: f64, tool: f64) -> f64 {
        drawn - tool / 2.0
    }

    /// Radius of the circle on which the axis of a cutter of this diameter moves.
    pub fn axis_radius(&self, tool: f64) -> f64 {
        Self::radius_of_axis(self.radius, tool)
    }
}

impl Bars {
    /// Returns the number of bars on a segment of this length: as many as fit. A length that is nearly a multiple of U + P is treated as that
    /// multiple, so that rounding does not make the number depend on the direction of the segment.
    pub fn count(&self, length: f64) -> f64 {
        let spacing = self.distance + self.length;
        let nearest = (length / spacing).round();
        if near(length, nearest * spacing) { nearest } else { (length / spacing).floor() }
    }
}
