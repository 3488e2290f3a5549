//! Embedding: the properties of a path that matter to embedding paths, and whether a path fits a subpath segment. These are pure functions
//! from values to diagnostics; callers provide the paths. (book: language/embedding, book: language/letters)

pub(crate) mod judge;

use std::iter;

use pathbuild_diagnostic::messages::parameters as messages;
use pathbuild_diagnostic::{Diagnostic, TextFault};
use regex::Regex;
use smol_str::SmolStr;

use crate::approx::above;
use crate::effective::{PathNumbers, PathOptions, PathRole};
use crate::element::Origin;
use crate::letter::{Letter, Letters};
use crate::names::{PathName, SpeltName};
use crate::path::{Path, Segment, SegmentKind, Subpath};
use crate::raw::RawPath;
use crate::text::TextId;
use crate::variables::{Bindings, Definition};

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
    /// Letters with values that are hidden by errors.
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

    /// S of the path in a role: its own, that of the option, or the default; `None` if the option is missing.
    pub fn sweep_height(&self, options: &PathOptions, role: PathRole) -> Option<f64> {
        let numbers = PathNumbers { tool: Some(self.tool), thickness: Some(self.thickness), feed: None };
        self.sweep_height.or_else(|| numbers.sweep_height(options, role))
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

    fn fault(&self, letter: Letter) -> Option<&TextFault> {
        self.faults.iter().find(|(known, _)| *known == letter).map(|(_, fault)| fault)
    }
}

/// A Z-probe, which the tool approaches at sweep height.
#[derive(Clone, Debug, PartialEq)]
pub struct ProbeTop {
    origin: Origin,
    /// T + H in mm, above the plane of the path.
    height: f64,
    fault: Option<TextFault>,
}

impl ProbeTop {
    /// The probes of a path that are raised by H. T of the others is checked together with S.
    fn raised(path: &Path) -> Vec<Self> {
        let top = |probe: &crate::path::Probe| {
            let fault = path.drawn.text(probe.text)?.fault_of(Letter::H)?;
            Some(Self { origin: probe.origin.clone(), height: probe.height, fault: Some(fault) })
        };
        path.probes.iter().filter_map(top).collect()
    }
}

impl PathSignature {
    /// Height in mm of the highest point of its own material and probes, above its plane.
    pub fn own_top(&self) -> f64 {
        self.raised_probes.iter().map(|probe| probe.height).fold(self.thickness, f64::max)
    }

    /// PB203 for each of its own probes that reaches the sweep height, in mm.
    pub fn raised_probe_problems(&self, sweep_height: f64) -> Vec<Diagnostic> {
        let too_high = self.raised_probes.iter().filter(|probe| !above(sweep_height, probe.height));
        let problem =
            |probe: &ProbeTop| self.reached(sweep_height, probe.height, probe.fault.clone(), &probe.origin);
        too_high.map(problem).collect()
    }

    /// PB203 if the path embedded by a segment reaches the sweep height. `top`: height in mm of everything embedded, above the plane of
    /// this path.
    pub fn raised_subpath_problem(
        &self,
        call: &SubpathCall,
        sweep_height: f64,
        top: f64,
    ) -> Option<Diagnostic> {
        let fault = call.fault(Letter::H).or_else(|| call.fault(Letter::Embed)).cloned();
        (!above(sweep_height, top)).then(|| self.reached(sweep_height, top, fault, &call.origin))
    }

    fn reached(&self, sweep_height: f64, top: f64, fault: Option<TextFault>, origin: &Origin) -> Diagnostic {
        let mut problem = Diagnostic::new(&messages::RAISED_INTO_SWEEPS)
            .with("value", sweep_height)
            .with("limit", top)
            .in_path(self.name.as_str());
        problem.text = fault;
        origin.at(problem)
    }
}

/// The upper faces that a path's sweeps must clear. Empty if the path gives its own S, which is checked together with its other values.
#[derive(Clone, Debug, PartialEq)]
pub struct SweepLimits {
    path: SpeltName,
    faces: Box<[Face]>,
}

/// An upper face of the material.
#[derive(Clone, Debug, PartialEq)]
struct Face {
    /// The element that gives T.
    origin: Origin,
    /// T in mm.
    thickness: f64,
    fault: Option<TextFault>,
}

impl SweepLimits {
    /// The limits of a path: T of the path itself, of its probes and of its subpath segments.
    pub fn of(path: &Path) -> Self {
        let Some(surface) = &path.surface else {
            return Self { path: path.name.clone(), faces: Box::default() };
        };
        let face = |origin: Origin, thickness: f64, text: Option<TextId>| {
            let fault = path.drawn.text(text).and_then(|text| text.fault_of(Letter::T));
            Face { origin, thickness, fault }
        };
        let own = iter::once(surface).chain(&path.probe_surfaces);
        let own = own.map(|surface| face(surface.origin.clone(), surface.thickness, surface.text));
        let of_segment = |segment: &Segment| match &segment.kind {
            SegmentKind::Subpath(subpath) if path.drawn.text(subpath.text)?.letters.contains(Letter::T) => {
                Some(face(path.origin(segment), subpath.thickness, subpath.text))
            }
            _ => None,
        };
        let faces = own.chain(path.segments.iter().filter_map(of_segment)).collect();
        Self { path: path.name.clone(), faces }
    }

    /// PB203 for each face that a sweep height in mm does not clear.
    pub fn check(&self, height: f64) -> Vec<Diagnostic> {
        let too_high = self.faces.iter().filter(|face| !above(height, face.thickness));
        let problem = |face: &Face| {
            let mut problem = Diagnostic::new(&messages::DEFAULT_SWEEP_TOO_LOW)
                .with("value", height)
                .with("limit", face.thickness)
                .in_path(self.path.as_str());
            problem.text.clone_from(&face.fault);
            face.origin.at(problem)
        };
        too_high.map(problem).collect()
    }
}

/// Paths whose names match PARENT may only embed paths whose names match CHILD.
#[derive(Clone, Debug)]
pub struct Restriction {
    /// Matched anywhere in the name of the embedding path.
    parent: Regex,
    /// Matched anywhere in the name of the embedded path.
    child: Regex,
}

impl Restriction {
    /// Creates a rule from two regular expressions.
    ///
    /// # Errors
    /// If one of them is not a valid regular expression.
    pub fn new(parent: &str, child: &str) -> Result<Self, regex::Error> {
        Ok(Self { parent: Regex::new(parent)?, child: Regex::new(child)? })
    }

    /// Whether the rule applies to the embeddings of this path.
    fn concerns(&self, parent: &PathName) -> bool {
        parent.is_match(&self.parent)
    }

    /// The expression that embedded names must match.
    fn child(&self) -> &Regex {
        &self.child
    }
}
