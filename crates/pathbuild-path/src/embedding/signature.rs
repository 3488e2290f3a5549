//! The interface of a path to other paths.

use pathbuild_diagnostic::TextFault;
use smol_str::SmolStr;

use super::raised::ProbeTop;
use super::sweep::SweepLimits;
use crate::definition::Definition;
use crate::effective::{PathNumbers, PathOptions, PathRole, fallback};
use crate::element::Origin;
use crate::letter::{Letter, Letters};
use crate::matrix::ElementClass;
use crate::names::SpeltName;
use crate::path::{Path, Segment, SegmentKind, Subpath};
use crate::raw::RawPath;
use crate::variables::Bindings;

/// A path before its variables are bound.
#[derive(Clone, Debug, PartialEq)]
pub struct PathHeader {
    /// The name as spelt by its layer.
    pub name: SpeltName,
    /// Whether the drawing of the path has no errors, apart from its values.
    pub is_sound: bool,
    /// Its variables.
    pub definitions: Vec<Definition>,
}

/// The properties of a bound path that others depend on. An edit that leaves them unchanged does not affect other paths. Lengths are in mm.
#[derive(Clone, Debug, PartialEq)]
pub struct PathSignature {
    /// The name as spelt by its layer.
    pub name: SpeltName,
    /// Cutter diameter (O).
    pub tool: f64,
    /// T.
    pub thickness: f64,
    /// S, if the path gives it.
    pub sweep_height: Option<f64>,
    /// The faces that S must clear.
    pub sweep_limits: SweepLimits,
    /// M.
    pub material: Option<SmolStr>,
    /// R.
    pub output_suffix: SmolStr,
    /// E: the regular expression for names of embedded paths.
    pub embeds_only: Option<SmolStr>,
    /// The distance from its start to its end.
    pub size: f64,
    /// Whether any milling uses the feed of the options.
    pub needs_feed: bool,
    /// Whether it has Z-probes of its own.
    pub has_probes: bool,
    /// The probes raised by H.
    pub raised_probes: Vec<ProbeTop>,
    /// Letters whose values are hidden by errors.
    pub(crate) unknown: Letters,
    /// Its subpath segments in order.
    pub subpaths: Box<[SubpathCall]>,
}

/// A subpath segment, with details for messages.
#[derive(Clone, Debug, PartialEq)]
pub struct SubpathCall {
    /// Index into [`Path::segments`].
    pub segment: usize,
    /// The location of its element.
    pub origin: Origin,
    /// Its parameters.
    pub subpath: Subpath,
    /// Its own text with a letter underlined, for each compared letter that it gives.
    faults: Box<[(Letter, TextFault)]>,
}

/// The letters of a subpath segment that are compared with the paths on both sides.
const COMPARED: [Letter; 5] = [Letter::Embed, Letter::T, Letter::O, Letter::M, Letter::H];

impl PathHeader {
    /// The header of a path.
    pub fn of(raw: &RawPath) -> Self {
        Self { name: raw.name.clone(), is_sound: raw.is_sound(), definitions: raw.definitions.clone() }
    }
}

impl PathSignature {
    /// The signature of a path.
    pub fn of(path: &Path) -> Self {
        let call = |(index, segment): (usize, &Segment)| match &segment.kind {
            SegmentKind::Subpath(subpath) => Some(SubpathCall::new(path, index, segment, subpath)),
            _ => None,
        };
        Self {
            name: path.name.clone(),
            tool: path.tool,
            thickness: path.thickness,
            sweep_height: path.sweep_height,
            sweep_limits: SweepLimits::of(path),
            material: path.material.clone(),
            output_suffix: path.output_suffix.clone(),
            embeds_only: path.embeds_only.clone(),
            size: (path.end - path.start).norm(),
            needs_feed: path.needs_feed(),
            has_probes: !path.probes.is_empty(),
            raised_probes: ProbeTop::raised(path),
            unknown: path.unknown_letters(),
            subpaths: path.segments.iter().enumerate().filter_map(call).collect(),
        }
    }
}

impl PathSignature {
    /// S of the path in a role: its own, that of the option, or the default; `None` if the option is missing.
    pub fn sweep_height(&self, options: &PathOptions, role: PathRole) -> Option<f64> {
        self.sweep_height.or_else(|| {
            let numbers = PathNumbers { tool: Some(self.tool), thickness: Some(self.thickness), feed: None };
            let height = fallback(Letter::S, ElementClass::PathStart, numbers, options, role);
            height.map(|(height, _)| height)
        })
    }
}

impl SubpathCall {
    fn new(path: &Path, segment_index: usize, segment: &Segment, subpath: &Subpath) -> Self {
        let fault = |letter| Some((letter, path.fault(subpath, letter)?));
        Self {
            segment: segment_index,
            origin: path.origin(segment),
            subpath: subpath.clone(),
            faults: COMPARED.into_iter().filter_map(fault).collect(),
        }
    }

    /// The values that it gives the variables of the embedded path.
    pub fn bindings(&self) -> Bindings {
        let values = self.subpath.values.iter();
        Bindings::new(values.filter_map(|given| Some((given.variable?, given.value.clone()))))
    }

    pub(super) fn fault(&self, letter: Letter) -> Option<&TextFault> {
        self.faults.iter().find(|(known, _)| *known == letter).map(|(_, fault)| fault)
    }
}
