//! Embedding: the properties of a path that matter to embedding paths, and whether a path fits a subpath segment. These are pure functions
//! from values to diagnostics; callers provide the paths. (book: language/embedding, book: language/letters)

use std::iter;

use pathbuild_diagnostic::messages::{parameters, paths as messages};
use pathbuild_diagnostic::{Diagnostic, Message, TextFault, Value, is_typo};
use regex::Regex;
use smol_str::SmolStr;

use crate::approx::{above, at_least, is_written_above, near};
use crate::effective::{PathNumbers, PathOptions, PathRole};
use crate::element::Origin;
use crate::language::Language;
use crate::letter::{Letter, Letters};
use crate::names::{CaseSensitiveName, PathName, name_regex};
use crate::path::{Path, Segment, SegmentKind, Subpath, SubpathName, SubpathValue};
use crate::raw::RawPath;
use crate::text::TextId;
use crate::variables::{AllowedValues, Bindings, Definition};

/// A path before its variables are bound.
#[derive(Clone, Debug, PartialEq)]
pub struct PathHeader {
    /// Name of the path, in the spelling of its layer.
    pub name: CaseSensitiveName,
    /// Whether the drawing of the path has no errors, regardless of errors in values.
    pub is_sound: bool,
    /// The definitions of the path's variables, in the order written.
    pub definitions: Vec<Definition>,
    /// The path of the same drawing that @ names and whose parameters this path borrows.
    pub lender: Option<PathName>,
}

/// The properties of a bound path that others depend on. An edit that leaves them unchanged does not affect other paths. Lengths are in mm.
#[derive(Clone, Debug, PartialEq)]
pub struct PathSignature {
    /// Name of the path, in the spelling of its layer.
    pub name: CaseSensitiveName,
    /// Cutter diameter (O).
    pub tool: f64,
    /// Thickness of the material (T).
    pub thickness: f64,
    /// Sweep height (S), if the path gives it.
    pub sweep_height: Option<f64>,
    /// The upper faces of the material that S must clear. Empty if the path gives its own S, which is checked together with its other values.
    upper_faces: Box<[StatedHeight]>,
    /// Name of the material (M).
    pub material: Option<SmolStr>,
    /// Suffix of the output file's name (R).
    pub output_suffix: SmolStr,
    /// E: the regular expression for names of embedded paths.
    pub embeds_only: Option<SmolStr>,
    /// The distance from the path's start to its end.
    pub size: f64,
    /// Whether the path needs `--feed`: it gives no F, and at least one of its elements uses the path's F.
    pub needs_feed: bool,
    /// Whether the path has Z-probes of its own.
    pub has_probes: bool,
    /// The probes raised by H.
    raised_probes: Vec<StatedHeight>,
    /// T + H of the highest probe; 0 without probes.
    pub highest_probe: f64,
    /// The sweeps with their own S.
    own_sweeps: Vec<StatedHeight>,
    /// Letters with values that are hidden by errors.
    pub(crate) unknown: Letters,
    /// The path's subpath segments in order.
    pub subpaths: Box<[SubpathCall]>,
}

/// A subpath segment, with details for messages.
#[derive(Clone, Debug, PartialEq)]
pub struct SubpathCall {
    /// Index of the segment in [`Path::segments`].
    pub segment: usize,
    /// The location of the segment's element.
    pub origin: Origin,
    /// The parameters of the segment.
    pub subpath: Subpath,
    /// The segment's own text with a letter underlined, for each compared letter that the text gives.
    faults: Box<[(Letter, TextFault)]>,
}

/// The letters of a subpath segment that are compared with the embedding path and with the embedded path.
const COMPARED_LETTERS: [Letter; 5] = [Letter::Embed, Letter::T, Letter::O, Letter::M, Letter::H];

/// Adds a note to a finding about two texts that differ if one of them has a character that is drawn over the letter before it: a with U+0308
/// looks like ä.
pub(crate) fn with_note_on_combined_letters(problem: Diagnostic) -> Diagnostic {
    let is_combining_mark = |character| ('\u{300}'..='\u{36f}').contains(&character);
    let is_combined = ["here", "there", "segment", "path"]
        .iter()
        .any(|name| problem.quoted(name).is_some_and(|text| text.contains(is_combining_mark)));
    if is_combined { problem.note(&messages::COMBINED_LETTERS, Vec::new()) } else { problem }
}

impl PathHeader {
    /// Creates the header of a path.
    pub fn of(raw: &RawPath) -> Self {
        Self {
            name: raw.name.clone(),
            is_sound: raw.is_sound(),
            definitions: raw.definitions.clone(),
            lender: raw.borrowed_from.as_ref().map(|lender| lender.0.clone()),
        }
    }
}

impl PathSignature {
    /// Creates the signature of a path.
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
            upper_faces: StatedHeight::upper_faces(path),
            material: path.material.clone(),
            output_suffix: path.output_suffix.clone(),
            embeds_only: path.embeds_only.clone(),
            size: (path.end - path.start).norm(),
            needs_feed: path.needs_feed(),
            has_probes: !path.probes.is_empty(),
            raised_probes: path
                .probes
                .iter()
                .filter_map(|probe| StatedHeight::of_raised_probe(path, probe))
                .collect(),
            highest_probe: path.probes.iter().map(|probe| probe.height).fold(0.0, f64::max),
            own_sweeps: path
                .segments
                .iter()
                .filter_map(|segment| StatedHeight::of_own_sweep(path, segment))
                .collect(),
            unknown: path.unknown_letters(),
            subpaths: path.segments.iter().enumerate().filter_map(call).collect(),
        }
    }

    /// The sweep height (S) of the path in a role: its own, or else the value of `--sweep-height` for an emitted path, or the default for an embedded
    /// one. `None` if the option is required but missing.
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
            faults: COMPARED_LETTERS.into_iter().filter_map(fault).collect(),
        }
    }

    /// Returns the values that the segment gives to the variables of the embedded path.
    pub fn bindings(&self) -> Bindings {
        let values = self.subpath.values.iter();
        Bindings::new(values.filter_map(|given| Some((given.variable?, given.value.clone()))))
    }

    fn fault(&self, letter: Letter) -> Option<&TextFault> {
        self.faults.iter().find(|(known, _)| *known == letter).map(|(_, fault)| fault)
    }
}

/// A height that a text of the path states, in mm above the plane of the path: the top of a raised Z-probe, the height of a sweep, or the upper face
/// of the material.
#[derive(Clone, Debug, PartialEq)]
struct StatedHeight {
    origin: Origin,
    height: f64,
    fault: Option<TextFault>,
}

impl StatedHeight {
    /// Returns the top (T + H) of a probe that H raises. T of all other probes is checked together with S.
    fn of_raised_probe(path: &Path, probe: &crate::path::Probe) -> Option<Self> {
        let fault = path.drawn.text(probe.text)?.fault_of(Letter::H)?;
        Some(Self { origin: probe.origin.clone(), height: probe.height, fault: Some(fault) })
    }

    /// Returns the height of a sweep with its own S; `None` if it has the S of the path.
    fn of_own_sweep(path: &Path, segment: &Segment) -> Option<Self> {
        let SegmentKind::Sweep { height: Some(height) } = segment.kind else { return None };
        let fault = path.drawn.text(path.element(segment).text)?.fault_of(Letter::S)?;
        Some(Self { origin: path.origin(segment), height, fault: Some(fault) })
    }

    /// Returns the upper faces that the path's sweeps must clear: T of the path itself, of its probes and of its subpath segments.
    fn upper_faces(path: &Path) -> Box<[Self]> {
        let Some(surface) = &path.surface else { return Box::default() };
        let face = |origin: Origin, height: f64, text: Option<TextId>| {
            let fault = path.drawn.text(text).and_then(|text| text.fault_of(Letter::T));
            Self { origin, height, fault }
        };
        let own = iter::once(surface).chain(&path.probe_surfaces);
        let own = own.map(|surface| face(surface.origin.clone(), surface.thickness, surface.text));
        let of_segment = |segment: &Segment| match &segment.kind {
            SegmentKind::Subpath(subpath) if path.drawn.text(subpath.text)?.letters.contains(Letter::T) => {
                Some(face(path.origin(segment), subpath.thickness, subpath.text))
            }
            _ => None,
        };
        own.chain(path.segments.iter().filter_map(of_segment)).collect()
    }

    /// Returns PB203 at this height: `value` is not above `limit`, and one of the two is this height.
    fn problem(&self, message: &'static Message, value: f64, limit: f64) -> Diagnostic {
        let problem = Diagnostic::new(message).with("value", value).with("limit", limit);
        self.origin.at(problem.with_text(self.fault.clone()))
    }
}

impl PathSignature {
    /// Returns PB203 for each sweep that gives its own S, but does not clear one of the path's probes or `top`, the height in mm of the highest
    /// point of the path and everything that it embeds. The extent of raised material is not drawn, so it does not matter where the sweep is.
    pub fn own_sweep_problems(&self, top: f64) -> Vec<Diagnostic> {
        let top = top.max(self.highest_probe);
        let too_low = self.own_sweeps.iter().filter(|sweep| !is_written_above(sweep.height, top));
        let problem =
            |sweep: &StatedHeight| sweep.problem(&parameters::SWEEP_BELOW_RAISED, sweep.height, top);
        too_low.map(|sweep| problem(sweep).in_path(self.name.as_str())).collect()
    }

    /// Returns PB203 for each upper face that a sweep height in mm does not clear. The path gives no S of its own; `role` is the use for which it gets
    /// this height.
    pub fn low_sweep_problems(&self, height: f64, role: PathRole) -> Vec<Diagnostic> {
        let message = match role {
            PathRole::Emitted => &parameters::DEFAULT_SWEEP_TOO_LOW,
            PathRole::Embedded => &parameters::EMBEDDED_SWEEP_TOO_LOW,
        };
        let too_high = self.upper_faces.iter().filter(|face| !is_written_above(height, face.height));
        let problem = |face: &StatedHeight| face.problem(message, height, face.height);
        too_high.map(|face| problem(face).in_path(self.name.as_str())).collect()
    }

    /// Returns the height in mm, above the path's plane, of the highest point of its own material and raised probes.
    pub fn own_top(&self) -> f64 {
        self.raised_probes.iter().map(|probe| probe.height).fold(self.thickness, f64::max)
    }

    /// Whether heights of the path's own probes must be compared with a sweep height.
    pub fn compares_probes(&self) -> bool {
        !self.raised_probes.is_empty() || (self.highest_probe > 0.0 && !self.own_sweeps.is_empty())
    }

    /// Returns PB203 for each of the path's own probes that reaches the sweep height, in mm.
    pub fn raised_probe_problems(&self, sweep_height: f64) -> Vec<Diagnostic> {
        let too_high =
            self.raised_probes.iter().filter(|probe| !is_written_above(sweep_height, probe.height));
        too_high.map(|probe| self.reached_problem(sweep_height, probe)).collect()
    }

    /// Returns PB203 if the path embedded by a segment reaches the sweep height. `top` is the height in mm of the highest point of that path and
    /// everything that it embeds, above the plane of this path.
    pub fn raised_subpath_problem(
        &self,
        call: &SubpathCall,
        sweep_height: f64,
        top: f64,
    ) -> Option<Diagnostic> {
        let fault = call.fault(Letter::H).or_else(|| call.fault(Letter::Embed)).cloned();
        let reached = StatedHeight { origin: call.origin.clone(), height: top, fault };
        (!is_written_above(sweep_height, top)).then(|| self.reached_problem(sweep_height, &reached))
    }

    fn reached_problem(&self, sweep_height: f64, reached: &StatedHeight) -> Diagnostic {
        let problem = reached.problem(&parameters::RAISED_INTO_SWEEPS, sweep_height, reached.height);
        problem.in_path(self.name.as_str())
    }
}

/// A rule of `--restrict`: paths with names that match PARENT may only embed paths with names that match CHILD.
#[derive(Clone, Debug)]
pub struct Restriction {
    /// Expression that must match somewhere in the name of the embedding path.
    parent: Regex,
    /// Expression that must match somewhere in the name of the embedded path.
    child: Regex,
}

impl Restriction {
    /// Creates a rule from two regular expressions.
    ///
    /// # Errors
    /// If one of them is not a valid regular expression.
    pub fn new(parent: &str, child: &str) -> Result<Self, regex::Error> {
        Ok(Self { parent: name_regex(parent)?, child: name_regex(child)? })
    }

    fn child(&self) -> &Regex {
        &self.child
    }
}

/// Checks the subpath segments of one path. All diagnostics carry the path and the place of the segment.
#[derive(Debug)]
pub struct SubpathChecker<'a> {
    outer: &'a PathSignature,
    language: &'a Language,
    rule: Rule<'a>,
    /// Whether embeddings that `PathDxf2GCode` accepts in spite of its manual are warnings instead of errors.
    is_compatible: bool,
}

/// The rule that names of embedded paths must satisfy.
#[derive(Debug)]
enum Rule<'a> {
    /// E of the path; `None` if it is not a valid regular expression, so that nothing matches.
    Own(&'a str, Option<Regex>),
    /// `--restrict`: the first restriction that applies to the path.
    Restriction(&'a Regex),
    Any,
}

/// Largest permitted difference in mm between the length of a segment and the size of the path that it embeds.
pub(crate) const CHORD_TOLERANCE: f64 = 0.001;

impl<'a> SubpathChecker<'a> {
    /// Creates a checker for the embeddings of a path. The path's E decides which names are allowed, or these restrictions if it has no E.
    pub fn new(
        outer: &'a PathSignature,
        restrictions: &'a [Restriction],
        language: &'a Language,
        is_compatible: bool,
    ) -> Self {
        let restriction = || restrictions.iter().find(|rule| outer.name.is_match(&rule.parent));
        let rule = match &outer.embeds_only {
            Some(own) => Rule::Own(own, name_regex(own).ok()),
            None if outer.unknown.contains(Letter::E) => Rule::Any,
            None => restriction().map_or(Rule::Any, |rule| Rule::Restriction(rule.child())),
        };
        Self { outer, language, rule, is_compatible }
    }

    /// Returns PB502 as a warning if `>` is followed by more than a name.
    pub fn warnings(&self, call: &SubpathCall) -> Vec<Diagnostic> {
        let SubpathName::Found { name, whole_value: Some(value) } = &call.subpath.name else {
            return Vec::new();
        };
        if self.is_part_of_longer_name(name, value) {
            return Vec::new();
        }
        let warning = Diagnostic::new(&messages::MORE_THAN_NAME).quoting("value", &**value);
        vec![self.at_name(call, warning.quoting("name", name.as_str())).as_warning()]
    }

    /// Whether the name is only part of a longer word, so that another path is meant.
    fn is_part_of_longer_name(&self, name: &PathName, value: &str) -> bool {
        !self.is_compatible && name.is_part_of(value)
    }

    /// Returns the path that a segment names.
    ///
    /// # Errors
    /// PB501, PB502 and PB507: the segment names no path, or one that must not be embedded.
    pub fn name<'c>(&self, call: &'c SubpathCall) -> Result<&'c PathName, Box<Diagnostic>> {
        let problem = match &call.subpath.name {
            SubpathName::Missing { text, is_point } => {
                let message =
                    if *is_point { &messages::SUBPATH_WITHOUT_LENGTH } else { &messages::MISSING_NAME };
                self.at(call, Diagnostic::new(message), text.as_ref())
            }
            SubpathName::Invalid { value } => {
                let pattern = &self.language.path_pattern;
                let problem = match pattern.corrected_name(value) {
                    Some(meant) => {
                        Diagnostic::new(&messages::NAME_WITHOUT_POINT).quoting("meant", meant.as_str())
                    }
                    None => Diagnostic::new(&messages::INVALID_NAME).quoting("pattern", pattern.as_str()),
                };
                self.at_name(call, problem.quoting("value", &**value))
            }
            SubpathName::Found { name, whole_value: Some(value) }
                if self.is_part_of_longer_name(name, value) =>
            {
                let problem = Diagnostic::new(&messages::NAME_GOES_ON).quoting("value", &**value);
                self.at_name(call, problem.quoting("name", name.as_str()))
            }
            SubpathName::Found { name, .. } => match self.broken_rule(name) {
                None => return Ok(name),
                Some(rule) => {
                    let problem = Diagnostic::new(&messages::FORBIDDEN).quoting("name", name.as_str());
                    self.at_name(call, problem.quoting("rule", rule))
                }
            },
        };
        Err(Box::new(problem))
    }

    fn broken_rule(&self, name: &PathName) -> Option<&str> {
        let (rule, is_kept) = match &self.rule {
            Rule::Own(rule, pattern) => {
                (*rule, pattern.as_ref().is_some_and(|pattern| name.is_match(pattern)))
            }
            Rule::Restriction(child) => (child.as_str(), name.is_match(child)),
            Rule::Any => return None,
        };
        (!is_kept).then_some(rule)
    }

    /// Returns PB503: no file defines the path. `known` are the paths of the searched files.
    pub fn not_found_problem(
        &self,
        call: &SubpathCall,
        name: &PathName,
        directories: Value,
        files: Value,
        known: Vec<PathName>,
    ) -> Diagnostic {
        let problem = Diagnostic::new(&messages::NOT_FOUND)
            .quoting("name", name.as_str())
            .with("directories", directories)
            .with("files", files);
        self.at_name(call, with_near_names(problem, name, known))
    }

    /// Returns PB511: errors of a drawing hide its paths.
    pub fn hidden_by_errors_problem(&self, call: &SubpathCall, name: &PathName, file: &str) -> Diagnostic {
        let problem = Diagnostic::new(&messages::HAS_ERRORS).quoting("name", name.as_str());
        self.at_name(call, problem.quoting("file", file))
    }

    /// Returns PB504: two files define the path.
    pub fn defined_twice_problem(
        &self,
        call: &SubpathCall,
        name: &PathName,
        first: &str,
        second: &str,
    ) -> Diagnostic {
        let problem = Diagnostic::new(&messages::DEFINED_TWICE).quoting("name", name.as_str());
        self.at_name(call, problem.quoting("first", first).quoting("second", second))
    }

    /// Returns PB302 to PB304: problems with the values that a segment gives the variables of the embedded path. Nothing is reported if the drawing
    /// of that path has errors.
    pub fn binding_problems(&self, call: &SubpathCall, inner: &PathHeader) -> Vec<Diagnostic> {
        if !inner.is_sound {
            return Vec::new();
        }
        let values = &call.subpath.values;
        let wrong = values.iter().filter_map(|given| self.wrong_value_problem(call, given, inner));
        let is_given = |known: &Definition| values.iter().any(|given| given.variable == Some(known.name));
        let is_known =
            |given: &SubpathValue| inner.definitions.iter().any(|known| given.variable == Some(known.name));
        let unknown = values.iter().filter(|given| !is_known(given)).count();
        // An unknown variable may be a misspelling of a missing one, so one missing variable is not reported for each unknown one.
        let missing = inner.definitions.iter().filter(|known| !is_given(known)).skip(unknown);
        let missing = missing.map(|definition| {
            let problem = Diagnostic::new(&parameters::MISSING_VALUE_HERE)
                .with("variable", definition.name)
                .quoting("example", definition.check_value(0).as_str())
                .quoting("name", inner.name.as_str());
            self.at_name(call, problem.quoting("definition", definition.to_string()))
        });
        wrong.chain(missing).collect()
    }

    fn wrong_value_problem(
        &self,
        call: &SubpathCall,
        given: &SubpathValue,
        inner: &PathHeader,
    ) -> Option<Diagnostic> {
        let definition = inner.definitions.iter().find(|known| Some(known.name) == given.variable);
        let problem = match definition {
            None => {
                let known = inner.definitions.iter().map(|known| known.name.to_string()).collect::<Value>();
                let message = if inner.definitions.is_empty() {
                    &parameters::VALUE_WITHOUT_VARIABLES
                } else {
                    &parameters::VALUE_WITHOUT_DEFINITION
                };
                Diagnostic::new(message).with("known", known)
            }
            Some(definition) if !definition.allows(&given.value) => {
                let is_list = matches!(definition.values, AllowedValues::List(_));
                let message = if is_list && given.value.contains(',') {
                    &parameters::VALUE_WITH_COMMA
                } else {
                    &parameters::VALUE_NOT_ALLOWED
                };
                Diagnostic::new(message)
                    .quoting("value", &*given.value)
                    .quoting("definition", definition.to_string())
            }
            Some(_) => return None,
        };
        let variable = given.variable.map(String::from).unwrap_or_default();
        let problem = problem.quoting("variable", variable).quoting("name", inner.name.as_str());
        Some(self.at(call, problem, Some(&given.text)))
    }

    /// Returns the mismatches in M, T, O and size between a segment and the path that it embeds (PB201, PB505, PB506, PB510).
    pub fn mismatches(&self, call: &SubpathCall, inner: &PathSignature) -> Vec<Diagnostic> {
        let subpath = &call.subpath;
        let mut problems: Vec<Diagnostic> = self.material_mismatch(call, inner).into_iter().collect();
        for (letter, here, there) in
            [(Letter::T, subpath.thickness, inner.thickness), (Letter::O, subpath.tool, inner.tool)]
        {
            if !subpath.hides(letter) && !near(here, there) {
                problems.push(self.mismatch(call, letter, &here.into(), &there.into(), inner));
            }
        }
        let differs_here = !subpath.hides(Letter::O) && !near(subpath.tool, inner.tool);
        let is_known = !self.outer.unknown.union(inner.unknown).contains(Letter::O);
        if is_known && !differs_here {
            let is_same = near(self.outer.tool, inner.tool);
            let problem =
                if is_same { self.other_tool_problem(inner) } else { Some(self.other_cutter_problem(inner)) };
            let at = |problem| self.at(call, problem, call.fault(Letter::O));
            let soften =
                |problem: Diagnostic| if self.is_compatible { problem.as_warning() } else { problem };
            problems.extend(problem.map(at).map(soften));
        }
        let is_known = !self.outer.unknown.union(subpath.unknown).contains(Letter::T);
        if is_known && !at_least(self.outer.thickness, subpath.thickness) {
            let problem = Diagnostic::new(&messages::T_BELOW)
                .with("path", self.outer.thickness)
                .with("segment", subpath.thickness);
            problems.push(self.at(call, problem, call.fault(Letter::T)));
        } else if near(subpath.thickness, inner.thickness) {
            problems.extend(self.other_thickness_problem(call, inner));
        }
        let (here, there) = ((subpath.end - subpath.start).norm(), inner.size);
        if (here - there).abs() > CHORD_TOLERANCE {
            let is_closed = there <= CHORD_TOLERANCE;
            let message = if is_closed { &messages::SIZE_OF_CLOSED_PATH } else { &messages::SIZE_DIFFERS };
            let problem = Diagnostic::new(message)
                .with("segment", here)
                .with("path", there)
                .quoting("name", inner.name.as_str());
            problems.push(self.at(call, problem, None));
        }
        problems
    }

    /// Returns the finding about a path that is drawn for another cutter. A program has a single cutter, that of the emitted path, whatever O a
    /// segment gives.
    fn other_cutter_problem(&self, inner: &PathSignature) -> Diagnostic {
        Diagnostic::new(&messages::CUTTER_OF_PROJECT)
            .quoting("outer", self.outer.name.as_str())
            .with("here", self.outer.tool)
            .quoting("name", inner.name.as_str())
            .with("there", inner.tool)
    }

    /// Returns the finding about an embedded path that another tool of the same diameter mills, because the name of either path selects its tool. If
    /// only the embedding path's name does, its tool may be chosen on purpose, unless just one of the tools is a slot cutter.
    fn other_tool_problem(&self, inner: &PathSignature) -> Option<Diagnostic> {
        let tool = |path: &PathSignature| self.language.tools.of(path.name.as_str(), path.tool);
        let (here, there) = (tool(self.outer)?, tool(inner)?);
        let is_other = here.name != there.name && (here.is_named || there.is_named);
        let message = if there.is_named { &messages::TOOL_OF_PROJECT } else { &messages::TOOL_OF_COMPONENT };
        let is_doubt = !there.is_named && here.is_slot_cutter == there.is_slot_cutter;
        let problem = || {
            let problem = Diagnostic::new(message)
                .quoting("outer", self.outer.name.as_str())
                .quoting("here", here.name.as_str())
                .quoting("name", inner.name.as_str())
                .quoting("there", there.name.as_str());
            if is_doubt { problem.as_warning() } else { problem }
        };
        is_other.then(problem)
    }

    /// Returns the finding about a path that is drawn for a thinner sheet, although the drawings do not say that it lies in a sheet of its own: its
    /// rapid moves go down to its T, below the upper face of the embedding path's material. It is a warning if the embedding path names no material.
    fn other_thickness_problem(&self, call: &SubpathCall, inner: &PathSignature) -> Option<Diagnostic> {
        let unknown = self.outer.unknown.union(call.subpath.unknown);
        let is_known = ![Letter::T, Letter::M, Letter::H].into_iter().any(|letter| unknown.contains(letter));
        let is_thinner = is_known && !at_least(inner.thickness, self.outer.thickness);
        if !is_thinner || call.subpath.material.is_none() || self.is_own_sheet(call) {
            return None;
        }
        let problem = Diagnostic::new(&messages::THICKNESS_OF_PROJECT)
            .quoting("outer", self.outer.name.as_str())
            .with("here", self.outer.thickness)
            .quoting("name", inner.name.as_str())
            .with("there", inner.thickness)
            .with("lowest", inner.thickness + call.subpath.height);
        let problem = match self.materials(call) {
            Some((outer, segment)) if outer != segment => problem.note(
                &messages::MATERIALS_DIFFER_IN_CASE,
                vec![("outer_material", Value::quoted(outer)), ("material", Value::quoted(segment))],
            ),
            _ => problem,
        };
        let problem = self.at(call, problem, call.fault(Letter::T));
        let is_doubt = self.is_compatible || self.outer.material.is_none();
        Some(if is_doubt { problem.as_warning() } else { problem })
    }

    /// Whether the embedded path is milled from a sheet of its own, not from that of the embedding path: one that lies on shims (a positive H), or
    /// one of another material (M, compared without regard to case).
    fn is_own_sheet(&self, call: &SubpathCall) -> bool {
        let is_other =
            |(outer, segment): (&SmolStr, &SmolStr)| outer.to_lowercase() != segment.to_lowercase();
        above(call.subpath.height, 0.0) || self.materials(call).is_some_and(is_other)
    }

    /// Returns M of the path and M of a segment.
    fn materials<'s>(&'s self, call: &'s SubpathCall) -> Option<(&'s SmolStr, &'s SmolStr)> {
        self.outer.material.as_ref().zip(call.subpath.material.as_ref())
    }

    fn material_mismatch(&self, call: &SubpathCall, inner: &PathSignature) -> Option<Diagnostic> {
        if call.subpath.hides(Letter::M) {
            return None;
        }
        let place = match (&call.subpath.material, &inner.material) {
            (Some(here), Some(there)) => {
                let differs = || {
                    let (here, there) = (Value::quoted(here), Value::quoted(there));
                    with_note_on_combined_letters(self.mismatch(call, Letter::M, &here, &there, inner))
                };
                return (here != there).then(differs);
            }
            (None, None) => format!("{} / {}", self.outer.name, inner.name),
            (None, Some(_)) => self.outer.name.to_string(),
            (Some(_), None) => inner.name.to_string(),
        };
        Some(self.at(call, Diagnostic::new(&parameters::MISSING_MATERIAL).quoting("where", place), None))
    }

    fn mismatch(
        &self,
        call: &SubpathCall,
        letter: Letter,
        here: &Value,
        there: &Value,
        inner: &PathSignature,
    ) -> Diagnostic {
        // If the path around the segment suits the embedded path, only the segment's own text is wrong.
        let is_own = call.fault(letter).is_some();
        let is_own_sheet = self.is_own_sheet(call) && at_least(self.outer.thickness, inner.thickness);
        let message = match letter {
            Letter::O if !is_own || !near(self.outer.tool, inner.tool) => &messages::CUTTER_DIFFERS,
            Letter::T if !is_own_sheet && !near(self.outer.thickness, inner.thickness) => {
                &messages::THICKNESS_DIFFERS
            }
            _ => &messages::PARAMETER_DIFFERS,
        };
        let problem = Diagnostic::new(message)
            .with("letter", letter.as_char())
            .with("segment", here.clone())
            .with("path", there.clone())
            .quoting("name", inner.name.as_str());
        self.at(call, problem, call.fault(letter))
    }

    fn at(&self, call: &SubpathCall, diagnostic: Diagnostic, text: Option<&TextFault>) -> Diagnostic {
        call.origin.at(diagnostic.in_path(self.outer.name.as_str())).with_text(text.cloned())
    }

    /// Places a diagnostic at a segment, with the name underlined.
    fn at_name(&self, call: &SubpathCall, diagnostic: Diagnostic) -> Diagnostic {
        self.at(call, diagnostic, call.fault(Letter::Embed))
    }
}

const MAX_NAMES_IN_NOTE: usize = 5;

/// Adds a note to a finding about a path that none of the searched drawings defines. It lists some of the names that `name` may be a misspelling of,
/// or else some of the names in these drawings.
pub fn with_near_names(problem: Diagnostic, name: &PathName, mut known: Vec<PathName>) -> Diagnostic {
    known.sort();
    known.dedup();
    let similar = known.iter().filter(|other| is_typo(name.as_str(), other.as_str()));
    let similar: Vec<&PathName> = similar.take(MAX_NAMES_IN_NOTE).collect();
    match (similar.as_slice(), known.as_slice()) {
        ([], []) => problem,
        ([], known) => {
            let others = (known.len() > MAX_NAMES_IN_NOTE).then_some("...");
            let known =
                known.iter().take(MAX_NAMES_IN_NOTE).map(PathName::as_str).chain(others).collect::<Value>();
            problem.note(&messages::NAMES_THERE, vec![("names", known)])
        }
        (similar, _) => {
            let similar = similar.iter().map(|name| name.as_str()).collect::<Value>();
            problem.note(&messages::NEAR_NAMES, vec![("names", similar)])
        }
    }
}
