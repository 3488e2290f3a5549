//! Binds the variables of a raw path to values, which gives a [`Path`] with every parameter resolved, inherited and checked.
//! (book: language/letters, book: language/variables)

mod cuts;
mod uncut_runs;

use std::cell::OnceCell;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::sync::Arc;

use pathbuild_diagnostic::messages::{drawing, parameters as messages, paths};
use pathbuild_diagnostic::{Code, Diagnostic, Value};
use pathbuild_motion::{ChipLoad, check_cutting_length};
use smol_str::SmolStr;

use crate::approx::{above, grid_square, is_negligible};
use crate::bind::uncut_runs::{CutDepths, SupportSegment, drop_copies, first_uncut, uncut_runs};
use crate::effective::Texts;
use crate::element::{Cut, Element, Marker, Origin, Role, Shape, diagnostic_point};
use crate::geometry::{Curve, PlaceKey};
use crate::language::{Language, PathTool};
use crate::letter::{ElementClass, Letter, LetterEffect, LetterUse, Letters};
use crate::names::name_regex;
use crate::part::first_enclosing;
use crate::path::{
    CutParameters, Helix, Hole, Path, Probe, Segment, SegmentKind, Subpath, SubpathName, SubpathValue,
    Surface, Turn,
};
use crate::raw::{DrawingUncertainty, PathUncertainty, RawPath, WalkCertainty};
use crate::text::{LetterValue, ParameterText, TextId};
use crate::values::{GivenNumber, Values, check_doubts, check_limits, check_mark};
use crate::variables::{Bindings, Interpolation};

/// The outcome of binding a path that may have errors: as much of the path as is known, and the problems with its values.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PartiallyBoundPath {
    /// The path; one with [faults](Path::has_faults) serves only to find further problems. `None` if nothing is drawn.
    pub path: Option<Path>,
    /// Problems with the path's values, unless they merely follow from errors in the drawing.
    pub problems: Vec<Diagnostic>,
}

/// Binds a raw path to values. Returns the path, unless there are errors, and the diagnostics.
///
/// The bindings must match the path's variable definitions.
pub fn bind(raw: &RawPath, bindings: &Bindings, language: &Language) -> (Option<Path>, Vec<Diagnostic>) {
    let PartiallyBoundPath { path, problems } = bind_leniently(raw, bindings, language);
    (path.filter(|path| !path.has_faults()), problems)
}

/// Binds a raw path to values, even if the path has errors, and reports problems with the values.
pub fn bind_leniently(raw: &RawPath, bindings: &Bindings, language: &Language) -> PartiallyBoundPath {
    let mut binder = Binder::new(raw, bindings, language);
    let path = binder.path();
    let mut problems = binder.problems;
    group_missing(&mut problems);
    PartiallyBoundPath { path, problems }
}

struct Binder<'a> {
    raw: &'a RawPath,
    language: &'a Language,
    interpolation: Interpolation<'a>,
    /// The values in the path's own text.
    values: Values<'a>,
    /// The configured tool of the path.
    tool: Option<PathTool>,
    segments: Vec<Segment>,
    cuts: Vec<CutParameters>,
    holes: Vec<Hole>,
    helices: Vec<Helix>,
    problems: Vec<Diagnostic>,
    /// For each text, the indices of the diagnostics about it in `problems`.
    by_text: HashMap<TextId, Vec<usize>>,
    /// The texts of subpaths that name a path. Built for the first subpath without a text.
    named_subpaths: OnceCell<BTreeMap<PlaceKey, TextId>>,
    /// Keys of the messages that doubt values of the path itself: each is reported only once.
    doubted_at_start: Vec<&'static str>,
    unknown: UnknownValues,
    /// Whether the text of some segment may have been meant to give N.
    may_hide_order: bool,
}

/// Kinds of values that errors leave unknown.
#[derive(Default)]
struct UnknownValues {
    /// Whether I of some segment is unknown.
    infeed: bool,
    /// Whether N of some segment is unknown, and therefore its order among the segments that meet at a point.
    order: bool,
    /// Whether a value that the path or one of its elements requires is unknown.
    needed: bool,
}

/// The element or marker that a finding is about.
#[derive(Clone, Copy)]
enum FaultSite<'a> {
    Element(&'a Element),
    Marker(&'a Marker),
}

impl FaultSite<'_> {
    fn text(self) -> Option<TextId> {
        match self {
            FaultSite::Element(element) => element.text,
            FaultSite::Marker(marker) => marker.text,
        }
    }
}

impl<'a> Binder<'a> {
    fn new(raw: &'a RawPath, bindings: &'a Bindings, language: &'a Language) -> Self {
        let interpolation =
            Interpolation { bindings, limit: language.text_limit, unknown: &raw.uncertainty.variables };
        let mut values = Values::of(raw.parameters(), ElementClass::PathStart, &interpolation);
        let has_text = raw.parameters.is_some() && !raw.uncertainty.has_second_start;
        // Letters that the path's own text lacks may be in a text without an element. If the path's own text is missing or uncertain, any letter
        // may be given.
        let hidden = if has_text && !raw.uncertainty.has_broken_entity {
            raw.uncertainty.stray_letters
        } else {
            Letters::ALL
        };
        values.unread = values.unread.union(hidden);
        Self {
            raw,
            language,
            interpolation,
            values,
            tool: None,
            segments: Vec::new(),
            cuts: Vec::new(),
            holes: Vec::new(),
            helices: Vec::new(),
            problems: Vec::new(),
            by_text: HashMap::new(),
            named_subpaths: OnceCell::new(),
            doubted_at_start: Vec::new(),
            unknown: UnknownValues::default(),
            may_hide_order: false,
        }
    }

    fn path(&mut self) -> Option<Path> {
        self.check_path_values();
        let positive = |number: &f64| above(*number, 0.0);
        let tool = self.path_number(Letter::O).filter(positive);
        let thickness = self.path_number(Letter::T).filter(positive);
        let sweep_height = self.path_number(Letter::S);
        self.bind_segments(tool);
        self.report_missing_gaps();
        self.check_bars(tool);
        let turns = self.raw.turns.iter();
        let start = self.marker(self.raw.start.as_ref())?;
        let end = self.marker(self.raw.end.as_ref())?;
        let mut path = Path {
            name: self.raw.name.clone(),
            tool: tool.unwrap_or_default(),
            may_be_slot_cutter: self.tool.as_ref().is_none_or(|tool| tool.is_slot_cutter),
            thickness: thickness.unwrap_or_default(),
            sweep_height,
            material: self.path_text(Letter::M),
            feed: self.path_number(Letter::F),
            output_suffix: self.path_text(Letter::R).unwrap_or_default(),
            embeds_only: self.path_text(Letter::E).filter(|own| name_regex(own).is_ok()),
            start: start.at,
            end: end.at,
            turns: turns.map(|turn| Turn { origin: turn.origin.clone(), at: turn.at }).collect(),
            drawn: Arc::clone(&self.raw.drawn),
            segments: std::mem::take(&mut self.segments),
            cuts: std::mem::take(&mut self.cuts),
            holes: std::mem::take(&mut self.holes),
            helices: std::mem::take(&mut self.helices),
            probes: Vec::new(),
            surface: sweep_height.is_none().then(|| self.surface(&start, thickness.unwrap_or_default())),
            probe_surfaces: Vec::new(),
            start_origin: start.origin.clone(),
            end_origin: end.origin.clone(),
            left_out: self.raw.left_out.clone(),
            uncertainty: None,
        };
        self.add_probes(&mut path);
        self.unknown.needed |= tool.is_none() || thickness.is_none();
        let has_errors = !self.raw.is_sound() || self.problems.iter().any(Diagnostic::is_error);
        if has_errors || self.unknown.needed {
            self.add_uncertainty(&mut path);
        }
        Some(path)
    }

    /// Returns a marker, or a substitute for a missing one, so that the rest of the path can be checked.
    fn marker(&self, marker: Option<&Marker>) -> Option<Marker> {
        let raw = self.raw;
        let any = marker.or(raw.start.as_ref()).or(raw.end.as_ref()).cloned();
        any.or_else(|| {
            let element = raw.drawn.elements.first()?;
            Some(Marker { origin: raw.drawn.origin(element), at: element.shape.point(), text: None })
        })
    }

    /// Records in the path which of its properties errors leave unknown.
    fn add_uncertainty(&self, path: &mut Path) {
        let DrawingUncertainty { has_broken_entity, has_second_start, other_ends, unclear_circles, .. } =
            &self.raw.uncertainty;
        let is_unknown = |letter: &Letter| match letter {
            Letter::O | Letter::T => self.path_number(*letter).is_none(),
            _ => self.values.is_unknown(*letter),
        };
        let ends = self.raw.end.iter().map(|end| end.at).chain(other_ends.iter().copied());
        let is_walk_unknown =
            self.raw.start.is_none() || *has_broken_entity || *has_second_start || self.unknown.order;
        let walk = if is_walk_unknown {
            WalkCertainty::Unknown
        } else if self.may_hide_order || self.raw.uncertainty.stray_letters.contains(Letter::N) {
            WalkCertainty::MayHideOrder
        } else {
            WalkCertainty::Known
        };
        path.uncertainty = Some(Box::new(PathUncertainty {
            letters: Letter::all().filter(is_unknown).collect(),
            is_infeed_unknown: self.unknown.infeed || self.values.is_unknown(Letter::I),
            are_cuts_known: self.are_cuts_known(),
            walk,
            ends: ends.collect(),
            unclear_circles: unclear_circles.clone(),
        }));
        self.add_unclear_curves(path);
    }

    fn are_cuts_known(&self) -> bool {
        let mut errors = self.raw.diagnostics.iter().chain(&self.problems).filter(|found| found.is_error());
        !self.unknown.needed
            && !self.raw.uncertainty.stray_letters.iter().any(|letter| letter.effect() == LetterEffect::Cuts)
            && errors.all(|error| error.code() == Code::TextWithoutElement)
    }

    /// Adds lines and arcs of unknown line types as sweeps, since the path runs along them too.
    fn add_unclear_curves(&self, path: &mut Path) {
        let unclear = &self.raw.uncertainty.unclear_curves;
        if unclear.is_empty() {
            return;
        }
        let drawn = Arc::make_mut(&mut path.drawn);
        for element in unclear {
            let number = u32::try_from(drawn.elements.len()).unwrap_or(u32::MAX);
            drawn.elements.push(element.clone());
            let kind = SegmentKind::Sweep { height: None };
            path.segments.push(Segment { element: number, order: ORDER_WITHOUT_N, kind });
        }
    }

    /// Returns the upper face of the material that sweeps must clear, for a path that does not give S.
    fn surface(&self, start: &Marker, thickness: f64) -> Surface {
        let origin = self.raw.borrowed_from.as_ref().map_or(&start.origin, |lender| &lender.1).clone();
        Surface { origin, thickness, text: self.raw.parameters }
    }

    /// Adds to PB201 the text that was probably meant for the start marker, which has another one.
    fn with_path_text(&self, problem: Diagnostic) -> Diagnostic {
        let Some((text, at)) = &self.raw.uncertainty.path_text else { return problem };
        let text = Value::quoted(text.replace('\n', " "));
        problem.note(
            &messages::PATH_TEXT_ELSEWHERE,
            vec![("text", text), ("point", diagnostic_point(*at).into())],
        )
    }

    fn check_path_values(&mut self) {
        let mut problems = std::mem::take(&mut self.values.problems);
        let is_missing = |letter: &Letter| !self.values.may_give(*letter);
        for letter in ElementClass::PathStart.needed_letters().filter(is_missing) {
            let missing = Diagnostic::new(&messages::MISSING_AT_START).with("letter", letter.as_char());
            problems.push(self.with_path_text(missing.with_text(self.raw.parameters().whole_text_fault())));
        }
        if let Some(Err(error)) = self.values.text(Letter::E).map(name_regex) {
            let problem = Diagnostic::new(&messages::INVALID_REGEX).with("reason", regex_reason(&error));
            problems.push(self.values.underline(Letter::E, problem));
        }
        problems.extend(check_limits(&self.values, &self.values, ElementClass::PathStart));
        self.tool = self
            .values
            .number(Letter::O)
            .number()
            .and_then(|diameter| self.language.tools.of(self.raw.name.as_str(), diameter));
        let doubts = &self.language.doubts;
        let class = ElementClass::PathStart;
        problems.extend(check_doubts(&self.values, &self.values, class, doubts, self.chip_load()));
        for problem in problems {
            self.report_at_start(problem);
        }
    }

    /// Reports a problem with the path's own values.
    fn report_at_start(&mut self, problem: Diagnostic) {
        let problem = self.raw.at_parameters(problem);
        self.problems.push(problem.or_in_path(self.raw.name.as_str()));
    }

    /// Returns the bottom of a cut, from its own text or the path's. Reports doubtful marks, and cuts deeper than the cutting edges of the tool.
    fn bottom(&mut self, scope: &Scope<'_>, cut: Cut) -> Option<f64> {
        let bottom = self.value(scope, cut.depth())?;
        let doubts = &self.language.doubts;
        let doubt = (cut == Cut::Mark).then(|| check_mark(bottom, scope.values, &self.values, doubts));
        self.report_doubt(scope, Letter::D, doubt.flatten());
        let length = self.tool.as_ref().and_then(|tool| tool.cutting_length);
        let depth = length.zip(self.values.thickness().number());
        let doubt = depth.and_then(|(length, thickness)| check_cutting_length(length, bottom, thickness));
        self.report_doubt(scope, cut.depth(), doubt);
        Some(bottom)
    }

    /// Reports a doubt about the value of a letter, at the element or, if only the path gives the letter, once at the start.
    fn report_doubt(&mut self, scope: &Scope<'_>, letter: Letter, doubt: Option<Diagnostic>) {
        let Some(problem) = doubt else { return };
        if scope.values.has(letter) {
            self.report(scope.at, scope.values.underline(letter, problem));
        } else if !self.doubted_at_start.contains(&problem.message.key) {
            self.doubted_at_start.push(problem.message.key);
            self.report_at_start(self.values.underline(letter, problem));
        }
    }

    fn chip_load(&self) -> Option<ChipLoad> {
        self.tool.as_ref()?.chip_load
    }

    fn path_number(&self, letter: Letter) -> Option<f64> {
        self.values.number(letter).number()
    }

    fn path_text(&self, letter: Letter) -> Option<SmolStr> {
        self.values.text(letter).map(Into::into)
    }

    /// Returns the checked values of an element's text. Problems are reported at the element.
    fn element_values(
        &mut self,
        at: FaultSite<'_>,
        text: Option<ParameterText<'a>>,
        class: ElementClass,
    ) -> Values<'a> {
        let Some(text) = text else { return Values::default() };
        if self.raw.may_be_start_text(text) {
            return Values::default();
        }
        let mut values = Values::of(text, class, &self.interpolation);
        let mut problems = std::mem::take(&mut values.problems);
        problems.append(&mut check_limits(&values, &self.values, class));
        let doubts = &self.language.doubts;
        problems.append(&mut check_doubts(&values, &self.values, class, doubts, self.chip_load()));
        for problem in problems {
            self.report(at, problem);
        }
        values
    }

    fn origin(&self, at: FaultSite<'_>) -> Origin {
        match at {
            FaultSite::Element(element) => self.raw.drawn.origin(element).clone(),
            FaultSite::Marker(marker) => marker.origin.clone(),
        }
    }

    /// Reports a problem, but only once for the parts of a polyline, which share a text. The same problem in another text is reported again.
    fn report(&mut self, at: FaultSite<'_>, problem: Diagnostic) {
        let problem = self.origin(at).at(problem.in_path(self.raw.name.as_str()));
        if let (Some(text), true) = (at.text(), problem.text.is_some()) {
            let known = self.by_text.entry(text).or_default();
            let is_same = |known: &usize| {
                let known = &self.problems[*known];
                (known.message, &known.text, &known.arguments)
                    == (problem.message, &problem.text, &problem.arguments)
            };
            if known.iter().any(is_same) {
                return;
            }
            known.push(self.problems.len());
        }
        self.problems.push(problem);
    }

    fn add_probes(&mut self, path: &mut Path) {
        for marker in &self.raw.probes {
            let (at, class) = (FaultSite::Marker(marker), ElementClass::Probe);
            let values = self.element_values(at, self.raw.drawn.text(marker.text), class);
            if let (Some(_), GivenNumber::Number(thickness)) = (&path.surface, values.number(Letter::T)) {
                let origin = marker.origin.clone();
                path.probe_surfaces.push(Surface { origin, thickness, text: marker.text });
            }
            let scope = Scope { at, class, values: &values };
            let thickness = self.value(&scope, Letter::T).unwrap_or_default();
            path.probes.push(Probe {
                origin: marker.origin.clone(),
                at: marker.at,
                height: thickness
                    + scope.texts(&self.values).number_or_default(Letter::H).unwrap_or_default(),
                feed: self.value(&scope, Letter::Z),
                label: values.text(Letter::L).map(Into::into),
                text: marker.text,
            });
        }
        self.report_repeated_probes(&path.probes);
    }

    /// Reports probes at the position of an earlier probe, or with its label (L).
    fn report_repeated_probes(&mut self, probes: &[Probe]) {
        let (mut places, mut labels) = (BTreeSet::new(), BTreeMap::new());
        for (marker, probe) in self.raw.probes.iter().zip(probes) {
            let place = [probe.at.x, probe.at.y].map(|coordinate| (coordinate + 0.0).to_bits());
            if !places.insert(place) {
                self.report(FaultSite::Marker(marker), Diagnostic::new(&drawing::PROBE_TWICE));
                continue;
            }
            let Some(label) = &probe.label else { continue };
            if let Some(first) = labels.insert(label.clone(), probe.at) {
                let text = self.raw.drawn.text(marker.text);
                let problem = Diagnostic::new(&messages::PROBE_NAME_TWICE)
                    .quoting("label", &**label)
                    .with("point", diagnostic_point(first))
                    .with_text(text.and_then(|text| text.fault_of(Letter::L)));
                self.report(FaultSite::Marker(marker), problem);
            }
        }
    }
}

/// Returns the last line of a regular expression error, which gives the reason. The lines before it show the position, as pathbuild's own message
/// does.
pub fn regex_reason(error: &regex::Error) -> Value {
    let text = error.to_string();
    let last = text.lines().rfind(|line| !line.trim().is_empty()).unwrap_or_default();
    Value::foreign(last.trim().trim_start_matches("error: "))
}

/// Order of elements without N among the segments that meet at a point. (book: language/chains-and-passes)
const ORDER_WITHOUT_N: f64 = 9998.0;

impl Binder<'_> {
    fn bind_segments(&mut self, tool: Option<f64>) {
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
                // The texts of sweeps and disabled subpaths with these line types are ignored.
                (Role::SilentSweep | Role::SkippedSubpath, _) => {
                    segments.push(segment(ORDER_WITHOUT_N, SegmentKind::Sweep { height: None }));
                }
                _ => segments
                    .extend(self.bind_other_element(element).map(|(order, kind)| segment(order, kind))),
            }
        }
        self.segments = segments;
    }

    /// Returns the segment for a sweep or subpath, with its order among the segments that meet at a point.
    fn bind_other_element(&mut self, element: &Element) -> Option<(f64, SegmentKind)> {
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
        if values.is_unknown(Letter::Embed)
            || values.text(Letter::Embed) == Some("") && values.unread != Letters::default()
        {
            return Some((order, SegmentKind::Sweep { height: None }));
        }
        if let Some(text) = self.text_of_copy(element, &curve) {
            let problem = Diagnostic::new(&paths::COPY_OF_SUBPATH).quoting("text", text);
            self.report(scope.at, problem);
            return None;
        }
        let subpath = self.subpath(element, &scope, curve);
        Some((order, SegmentKind::Subpath(Box::new(subpath))))
    }

    /// Returns the text of another subpath that lies on this one, if that one names a path and this one has no text.
    fn text_of_copy(&self, element: &Element, curve: &Curve) -> Option<String> {
        if element.text.is_some() {
            return None;
        }
        let drawn = &self.raw.drawn;
        let named_subpaths = self.named_subpaths.get_or_init(|| {
            let subpaths = drawn.elements.iter().filter(|other| other.role == Role::Subpath);
            let named = subpaths.filter_map(|other| match (other.shape, drawn.text(other.text)) {
                (Shape::Curve(curve), Some(text)) if text.letters.contains(Letter::Embed) => {
                    Some((curve.place_key(), other.text?))
                }
                _ => None,
            });
            named.collect()
        });
        let text = drawn.text(named_subpaths.get(&curve.place_key()).copied());
        text.map(|text| text.as_str().replace('\n', " "))
    }

    /// Returns N of an element, or else the default order.
    fn order(&mut self, scope: &Scope<'_>) -> f64 {
        self.unknown.order |=
            scope.values.number(Letter::N) == GivenNumber::Faulty && scope.values.has(Letter::N);
        self.may_hide_order |= scope.values.unread.contains(Letter::N);
        self.value(scope, Letter::N).unwrap_or(ORDER_WITHOUT_N)
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
            name: self.subpath_name(values, self.raw.drawn.text(element.text), curve),
            thickness: thickness.unwrap_or_default(),
            tool: tool.unwrap_or_default(),
            unknown: unknown.fold(Letters::default(), |all, (letter, _)| all.union(Letters::of(&[letter]))),
            material: own_text(Letter::M).or_else(|| self.path_text(Letter::M)),
            height: scope.texts(&self.values).number_or_default(Letter::H).unwrap_or_default(),
            values: values.variables().map(value).collect(),
            text: element.text,
        }
    }

    fn subpath_name(
        &self,
        values: &Values<'_>,
        text: Option<ParameterText<'_>>,
        curve: Curve,
    ) -> SubpathName {
        let Some(value) = values.text(Letter::Embed) else {
            let text = text.map(ParameterText::whole_text_fault);
            return SubpathName::Missing { text, is_point: is_negligible(curve.length()) };
        };
        match self.language.path_pattern.first_in(value) {
            None => SubpathName::Invalid { value: value.into() },
            Some((name, range)) => {
                let has_more = range.len() < value.len();
                SubpathName::Found { name: name.into(), whole_value: has_more.then(|| value.into()) }
            }
        }
    }

    /// Returns the value of a letter for an element: from its own text or the path's, as the table of letters permits. Reports PB201 if a required
    /// letter is in neither text.
    fn value(&mut self, scope: &Scope<'_>, letter: Letter) -> Option<f64> {
        let given = scope.texts(&self.values).number(letter);
        // A letter that every path must have is reported once, at the path's start.
        let is_missing_here = || ElementClass::PathStart.use_of(letter) != LetterUse::Needed;
        if scope.class.use_of(letter) == LetterUse::Needed
            && given == GivenNumber::Absent
            && is_missing_here()
        {
            let problem = Diagnostic::new(&messages::MISSING)
                .with("letter", letter.as_char())
                .with("element", scope.class.word());
            self.report(scope.at, problem);
        }
        self.unknown.needed |= scope.class.use_of(letter) == LetterUse::Needed && given.number().is_none();
        self.unknown.infeed |= letter == Letter::I && given == GivenNumber::Faulty;
        given.number()
    }
}

/// Combines the reports that a letter is missing on several elements of one kind into one report at the first of these elements, since the letter
/// was probably forgotten in the path's own text.
pub(crate) fn group_missing(problems: &mut Vec<Diagnostic>) {
    let mut kept: Vec<Diagnostic> = Vec::with_capacity(problems.len());
    let mut groups: Vec<(usize, u64)> = Vec::new();
    for problem in problems.drain(..) {
        if problem.message == &messages::MISSING {
            match groups.iter_mut().find(|(first, _)| kept[*first].arguments == problem.arguments) {
                Some((_, further)) => {
                    *further += 1;
                    continue;
                }
                None => groups.push((kept.len(), 0)),
            }
        }
        kept.push(problem);
    }
    for (first, further) in groups.into_iter().filter(|(_, further)| *further > 0) {
        kept[first].message = &messages::MISSING_ON_SEVERAL;
        kept[first].arguments.push(("count", further.into()));
    }
    *problems = kept;
}

/// An element for which values are looked up.
struct Scope<'a> {
    at: FaultSite<'a>,
    class: ElementClass,
    values: &'a Values<'a>,
}

impl<'a> Scope<'a> {
    /// Returns the texts that can give the element its parameters. Chains are not known yet, so the letters of chains come from the element itself.
    fn texts(&self, path: &'a Values<'a>) -> Texts<'a, 'a> {
        Texts { class: self.class, own: self.values, chain: None, path }
    }
}

fn push_indexed<T>(list: &mut Vec<T>, thing: T) -> u32 {
    list.push(thing);
    u32::try_from(list.len() - 1).unwrap_or(u32::MAX)
}

const BAR_LETTERS: [Letter; 2] = [Letter::P, Letter::U];

impl Binder<'_> {
    /// Reports support segments that are nowhere cut through. Short edges of rounded corners are between longer sides with gaps, so single ones are
    /// only doubtful if no segment of the path has a gap.
    fn report_missing_gaps(&mut self) {
        if self.raw.uncertainty.is_in_other_unit {
            return;
        }
        let elements = &self.raw.drawn.elements;
        let (mut segments, mut depths) = (Vec::new(), CutDepths::new());
        for segment in &self.segments {
            let element = &elements[segment.element as usize];
            let (SegmentKind::Cut(cut), Shape::Curve(curve)) = (&segment.kind, element.shape) else {
                continue;
            };
            let CutParameters { cut, bottom, bars, .. } = self.cuts[*cut as usize];
            segments.extend(bars.map(|bars| SupportSegment { element, curve, bottom, bars }));
            for end in [curve.start(), curve.end()].iter().filter(|_| cut == Cut::Mill) {
                let lowest = depths.entry(grid_square(*end)).or_insert(bottom);
                *lowest = lowest.min(bottom);
            }
        }
        drop_copies(&mut segments);
        let runs = uncut_runs(&segments);
        let uncut = first_uncut(&segments, &depths).filter(|_| runs.is_empty());
        let runs = runs.iter().map(|run| (run.first.element, run.problem()));
        let uncut = uncut.map(|segment| (segment.element, segment.problem()));
        for (element, problem) in runs.chain(uncut).collect::<Vec<_>>() {
            self.report(FaultSite::Element(element), problem);
        }
    }

    /// Reports PB212 if P or U is given, but there are no bars and the cuts through the material form a ring, so that the part would come loose.
    /// Parts that are held otherwise need no bars.
    fn check_bars(&mut self, tool: Option<f64>) {
        let elements = &self.raw.drawn.elements;
        let has_letters = BAR_LETTERS.into_iter().any(|letter| self.values.has(letter));
        let is_held_otherwise = self.language.part.as_ref().is_some_and(|part| part.is_held_otherwise);
        let has_bars = || elements.iter().any(|element| element.role == Role::Cut(Cut::Support));
        if !has_letters || is_held_otherwise || has_bars() {
            return;
        }
        let outline = self.segments.iter().filter_map(|segment| {
            let SegmentKind::Cut(cut) = segment.kind else { return None };
            let cut = &self.cuts[cut as usize];
            let Shape::Curve(curve) = elements[segment.element as usize].shape else { return None };
            (cut.cut == Cut::Mill && !above(cut.bottom, 0.0)).then_some((segment.element, curve))
        });
        let radius = tool.unwrap_or_default() / 2.0;
        let (numbers, cuts): (Vec<u32>, Vec<_>) =
            outline.map(|(element, curve)| (element, (curve, radius))).unzip();
        let Some(first) = first_enclosing(&cuts) else { return };
        let letters = BAR_LETTERS.into_iter().filter(|letter| self.values.has(*letter));
        let letters: Value = letters.map(|letter| letter.as_char().to_string()).collect();
        let problem = Diagnostic::new(&messages::LOST_BARS).with("letters", letters);
        let problem = problem.in_path(self.raw.name.as_str());
        self.problems.push(self.raw.drawn.origin(&elements[numbers[first] as usize]).at(problem));
    }
}
