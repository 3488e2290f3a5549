//! Reads the clamps of a drawing: closed rings of lines and arcs, each with a text for its height. (book: language/keep-outs)

use std::collections::HashSet;

use pathbuild_diagnostic::messages::{configuration, drawing as messages};
use pathbuild_diagnostic::{Code, Diagnostic, EntityKind, Place, Point, Value};
use pathbuild_dxf::{Drawing, Entity, Geometry, Layer, Point3};
use rstar::primitives::GeomWithData;
use rstar::{AABB, Envelope, RTree};
use smol_str::SmolStr;

use crate::approx::{above, coincide, near};
use crate::boxes::{square, widened_box};
use crate::element::diagnostic_point;
use crate::geometry::{Arc, Curve, Line, Xy};
use crate::keep_out::{KeepOut, KeepOutMap, KeepOuts, TipMove};
use crate::language::Language;
use crate::letter::Letter;
use crate::read::entities::{AnyText, TextCircle, at_entity, curve, xy};
use crate::read::likely_parameters::parameters_between_words;
use crate::text::{
    ParameterText, ParameterTexts, ValueKind, is_special_space, with_visible_spaces, without_percent_codes,
};

/// Finds the clamps of a drawing. At least the layers with clamps must have been read.
pub fn keep_outs(drawing: &Drawing, language: &Language) -> KeepOuts {
    let mut found = KeepOuts::default();
    let Some(pattern) = &language.keep_out else { return found };
    let of_layers = by_layer(drawing);
    for ((number, layer), entities) in (0..).zip(&drawing.layers).zip(of_layers) {
        if !pattern.is_layer(&layer.name) {
            continue;
        }
        let mut reading = ClampReader { drawing, language, layer, number, problems: Vec::new() };
        if language.path_pattern.is_layer(&layer.name) {
            reading.report_path();
        } else {
            found.all.extend(reading.clamps(&entities));
        }
        found.problems.append(&mut reading.problems);
    }
    let is_clamp = |layer: &str| pattern.is_layer(layer) && !language.path_pattern.is_layer(layer);
    let hidden = drawing.diagnostics.iter().filter(|problem| problem.code() == Code::LayerNotVisible);
    found
        .problems
        .extend(hidden.filter(|problem| problem.place.layer.as_deref().is_some_and(is_clamp)).cloned());
    // If an outline has an error, a hatch may belong to that outline.
    if !found.problems.iter().any(Diagnostic::is_error) {
        found.problems.extend(lone_hatch_problems(drawing, language, &found.all));
    }
    found
}

/// Returns PB117 for each hatch on a layer with clamps that fills no outline of a clamp.
fn lone_hatch_problems(drawing: &Drawing, language: &Language, clamps: &[KeepOut]) -> Vec<Diagnostic> {
    let is_clamp = |place: &&Place| {
        let is_on = |layer: &str| language.is_keep_out(layer) && !language.path_pattern.is_layer(layer);
        place.layer.as_deref().is_some_and(is_on)
    };
    let mut hatches = drawing.hatches.iter().filter(is_clamp).peekable();
    if hatches.peek().is_none() {
        return Vec::new();
    }
    let map = outline_map(clamps.iter().map(|clamp| &*clamp.outline));
    let fills = |place: &Place| {
        let touches =
            |point: Point| !outlines_at(&map, Xy::new(point.x.0, point.y.0), END_SEARCH_RADIUS).is_empty();
        place.point.is_some_and(touches)
    };
    let problem = |place: &Place| {
        let problem = Diagnostic::new(&messages::NO_OUTLINE).quoting("entity", EntityKind::Hatch.name());
        Diagnostic { place: place.clone(), ..problem }
    };
    hatches.filter(|place| !fills(place)).map(problem).collect()
}

/// Returns PB119 for closed outlines with the height of a clamp on layers that hold neither paths nor clamps: one for each layer, and only if
/// layers with clamps are configured. `is_other`: whether a layer is to be searched.
pub(super) fn unread_clamps(
    drawing: &Drawing,
    language: &Language,
    is_other: impl Fn(u32) -> bool,
) -> Vec<Diagnostic> {
    if language.keep_out.is_none() {
        return Vec::new();
    }
    let height_at = |entity: &usize| {
        let text = AnyText::of(&drawing.entities[*entity].geometry)?;
        let texts = ParameterTexts::from(&*parameters_between_words(&without_percent_codes(text.string())));
        texts.first().and_then(height).map(|_| (*entity, text))
    };
    let mut found = Vec::new();
    for ((number, layer), entities) in (0..).zip(&drawing.layers).zip(by_layer(drawing)) {
        let heights: Vec<_> =
            if is_other(number) { entities.iter().filter_map(height_at).collect() } else { Vec::new() };
        if heights.is_empty() {
            continue;
        }
        let (outlines, _) =
            ClampReader { drawing, language, layer, number, problems: Vec::new() }.outlines(&entities);
        let map = outline_map(outlines.iter().map(|closed| &*closed.outline));
        let is_inside = |(_, text): &&(usize, AnyText<'_>)| {
            let TextCircle { centre, radius } = text.circle();
            !outlines_at(&map, centre, radius).is_empty()
        };
        found.extend(heights.iter().find(is_inside).map(|(entity, text)| {
            let problem = Diagnostic::new(&messages::HEIGHT_ON_OTHER_LAYER)
                .quoting("text", one_line(*text))
                .quoting("layer", &*layer.name);
            at_entity(drawing, *entity, text.anchor(), problem)
        }));
    }
    found
}

/// Creates a map of outlines for [`outlines_at`].
fn outline_map<'k>(outlines: impl Iterator<Item = &'k [Curve]>) -> KeepOutMap {
    KeepOutMap::new(outlines.map(|outline| (1.0, outline)))
}

/// Returns the numbers of the outlines that a disc around a point overlaps. `radius` in mm.
fn outlines_at(map: &KeepOutMap, centre: Xy, radius: f64) -> Vec<usize> {
    let way = TipMove { curve: Curve::Line(Line { start: centre, end: centre }), from_z: 0.0, to_z: 0.0 };
    map.entered_clamps(&way, radius, 0.0)
}

/// Returns the indices of the entities on each layer.
fn by_layer(drawing: &Drawing) -> Vec<Vec<usize>> {
    let mut layers = vec![Vec::new(); drawing.layers.len()];
    for (number, entity) in drawing.entities.iter().enumerate() {
        layers[entity.layer as usize].push(number);
    }
    layers
}

/// Reads the clamps on one layer.
struct ClampReader<'d> {
    drawing: &'d Drawing,
    language: &'d Language,
    layer: &'d Layer,
    number: u32,
    problems: Vec<Diagnostic>,
}

/// The texts inside an outline or overlapping it.
#[derive(Clone, Default)]
struct OutlineTexts<'d> {
    /// The first few texts, with the indices of their entities.
    first: Vec<(usize, AnyText<'d>)>,
    count: usize,
}

/// Maximum number of an outline's texts that are listed: in a dense drawing, each outline may contain all texts.
const MAX_LISTED_TEXTS: usize = 3;

/// Height in mm below which a clamp is doubtful, because it would be lower than the head of any screw.
const MIN_PLAUSIBLE_HEIGHT: f64 = 1.0;

/// The closed outline of a clamp, before its height is known.
struct ClosedOutline {
    outline: Vec<Curve>,
    /// The index of the outline's first entity.
    entity: usize,
    at: Xy,
}

impl ClampReader<'_> {
    /// Returns the clamps on the layer; none if an entity of the layer could not be read.
    fn clamps(&mut self, entities: &[usize]) -> Vec<KeepOut> {
        if self.layer.hidden {
            self.report(on_layer(&self.layer.name, Diagnostic::new(&messages::CLAMPS_NOT_VISIBLE)));
        }
        self.check_unreadable();
        if self.problems.iter().any(Diagnostic::is_error) {
            // The entity that could not be read may belong to an outline, or be its text.
            return Vec::new();
        }
        self.check_plane(entities);
        let (outlines, broken) = self.outlines(entities);
        let heights = self.heights(entities, &outlines, &broken);
        let clamp = |(closed, height): (ClosedOutline, Option<f64>)| {
            let (layer, height) = (SmolStr::new(&self.layer.name), height?);
            Some(KeepOut { layer, at: closed.at, height, outline: closed.outline })
        };
        outlines.into_iter().zip(heights).filter_map(clamp).collect()
    }

    fn report(&mut self, problem: Diagnostic) {
        self.problems.push(problem);
    }

    /// Reports PB003 if the layer is also a path layer.
    fn report_path(&mut self) {
        let problem = Diagnostic::new(&configuration::KEEP_OUT_IS_PATH).quoting("layer", &*self.layer.name);
        self.report(on_layer(&self.layer.name, problem));
    }

    /// Reports entities of the layer that could not be read, since they may be part of a clamp.
    fn check_unreadable(&mut self) {
        let faults = self.drawing.faults.iter().filter(|fault| fault.layer == self.number);
        let mut problems: Vec<Diagnostic> = faults.map(|fault| fault.diagnostic.clone()).collect();
        for left_out in self.language.left_out(self.drawing).filter(|left_out| left_out.layer == self.number)
        {
            let message = match left_out.kind {
                EntityKind::Attrib | EntityKind::AttDef => &messages::NO_HEIGHT_TEXT,
                _ if left_out.diagnostic.message == &messages::BLOCK_ELSEWHERE => &messages::CLAMP_ELSEWHERE,
                _ => &messages::NO_OUTLINE,
            };
            // The arguments come from the reader's diagnostic: the kind of entity and the name of a block.
            let Diagnostic { arguments, place, .. } = left_out.diagnostic.clone();
            problems.push(Diagnostic { arguments, place, ..Diagnostic::new(message) });
        }
        let name = Some(&*self.layer.name);
        let widths = self.drawing.diagnostics.iter().filter(|found| {
            found.message == &messages::WIDTH_IGNORED && found.place.layer.as_deref() == name
        });
        problems.extend(widths.cloned());
        self.problems.append(&mut problems);
    }

    /// Reports PB110 at the first entity outside of the plane, but not at the others: a polyline consists of many entities.
    fn check_plane(&mut self, entities: &[usize]) {
        let off_plane = |entity: &usize| Some((*entity, self.point_off_plane(*entity)?));
        let off_plane: Vec<(usize, Point3)> = entities.iter().filter_map(off_plane).collect();
        let Some((entity, point)) = off_plane.first() else { return };
        let problem = Diagnostic::new(&messages::OFF_PLANE).with("z", point.z).with("count", off_plane.len());
        let problem = self.at(*entity, xy(*point), problem);
        self.report(problem);
    }

    /// Returns a point of the entity that is not at Z 0.
    fn point_off_plane(&self, entity: usize) -> Option<Point3> {
        let points: &[Point3] = match &self.drawing.entities[entity].geometry {
            Geometry::Line(line) => &[line.start, line.end],
            Geometry::Arc(arc) => &[arc.centre],
            Geometry::Circle(circle) => &[circle.centre],
            Geometry::Text(_) | Geometry::MText(_) => &[],
        };
        points.iter().find(|point| !near(point.z, 0.0)).copied()
    }

    /// Returns the closed outlines, and the boxes around the open ones. Reports PB117 for open outlines and for branches.
    fn outlines(&mut self, entities: &[usize]) -> (Vec<ClosedOutline>, Vec<AABB<[f64; 2]>>) {
        let (mut outlines, mut parts, mut broken) = (Vec::new(), Vec::new(), Vec::new());
        for number in entities {
            let Entity { group, geometry, .. } = &self.drawing.entities[*number];
            parts.extend(curve(geometry).map(|curve| RingPart { curve, group: *group, entity: *number }));
            if let Geometry::Circle(circle) = geometry {
                let at = xy(circle.centre);
                let arc = Arc::from_angles(at, circle.radius, 0.0, 360.0, false);
                outlines.push(ClosedOutline { outline: vec![Curve::Arc(arc)], entity: *number, at });
            }
        }
        let mut branches = HashSet::new();
        for ring in rings(&parts) {
            match ring {
                Ring::Closed(ring) => outlines.push(ClosedOutline {
                    at: ring[0].curve.start(),
                    entity: ring[0].entity,
                    outline: ring.iter().map(|part| part.curve).collect(),
                }),
                Ring::Open { part, curves } => {
                    broken.extend(
                        curves
                            .iter()
                            .map(|curve| widened_box(curve, 0.0))
                            .reduce(|one, other| one.merged(&other)),
                    );
                    if let ([first, ..], [.., last]) = (&curves[..], &curves[..]) {
                        self.report_open(&part, last.end(), first.start());
                    }
                }
                Ring::Branch { part, at } if branches.insert(diagnostic_point(at)) => {
                    let problem =
                        Diagnostic::new(&messages::OUTLINE_BRANCHES).with("point", diagnostic_point(at));
                    let problem = self.at(part.entity, at, problem);
                    self.report(problem);
                }
                // This point was reported for another curve that ends there.
                Ring::Branch { .. } => {}
            }
        }
        (outlines, broken)
    }

    fn report_open(&mut self, part: &RingPart, end: Xy, other: Xy) {
        let problem = Diagnostic::new(&messages::OUTLINE_OPEN)
            .with("point", diagnostic_point(end))
            .with("other", diagnostic_point(other))
            .with("distance", (other - end).norm());
        let problem = self.at(part.entity, end, problem);
        self.report(problem);
    }

    /// Returns the height of each outline, from the single text inside or overlapping it. Reports PB117 if there is no text, if there are several, or
    /// if the text gives no height. A text in the box around a broken outline probably belongs to that outline.
    fn heights(
        &mut self,
        entities: &[usize],
        outlines: &[ClosedOutline],
        broken: &[AABB<[f64; 2]>],
    ) -> Vec<Option<f64>> {
        let map = outline_map(outlines.iter().map(|closed| &*closed.outline));
        let mut texts = vec![OutlineTexts::default(); outlines.len()];
        for number in entities {
            let Some(text) = AnyText::of(&self.drawing.entities[*number].geometry) else { continue };
            let TextCircle { centre, radius } = text.circle();
            let over = outlines_at(&map, centre, radius);
            if over.is_empty() && !broken.iter().any(|extent| extent.intersects(&square(centre, radius))) {
                let problem = Diagnostic::new(&messages::TEXT_OUTSIDE_CLAMPS).quoting("text", one_line(text));
                let problem = self.at(*number, centre, problem);
                self.report(problem);
            }
            for outline in over {
                texts[outline].add(*number, text);
            }
        }
        outlines.iter().zip(texts).map(|(closed, texts)| self.height(closed, &texts)).collect()
    }

    fn height(&mut self, closed: &ClosedOutline, texts: &OutlineTexts<'_>) -> Option<f64> {
        let problem = match &texts.first[..] {
            [(number, text)] => return self.height_in(*number, *text),
            [] => Diagnostic::new(&messages::CLAMP_WITHOUT_TEXT),
            several => {
                let strings: Value = several.iter().map(|(_, text)| one_line(*text)).collect();
                if several.len() == texts.count {
                    Diagnostic::new(&messages::CLAMP_WITH_TEXTS).with("texts", strings)
                } else {
                    let problem = Diagnostic::new(&messages::CLAMP_WITH_MANY_TEXTS).with("texts", strings);
                    problem.with("count", texts.count)
                }
            }
        };
        let problem = self.at(closed.entity, closed.at, problem);
        self.report(problem);
        None
    }

    /// Returns the height given by a text. Reports a text that gives none, and a height that is doubtful.
    fn height_in(&mut self, number: usize, text: AnyText<'_>) -> Option<f64> {
        let texts = ParameterTexts::from(&*without_percent_codes(text.string()));
        let read = texts.first().unwrap_or_default();
        let height = height(read);
        let problem = match height {
            None if text.string().contains(is_special_space) => {
                let visible = with_visible_spaces(&without_percent_codes(text.string()));
                Diagnostic::new(&messages::CLAMP_WITH_SPECIAL_SPACE)
                    .quoting("text", visible.trim_end().replace('\n', " "))
            }
            None => Diagnostic::new(&messages::NO_CLAMP_HEIGHT).quoting("text", one_line(text)),
            Some(height) if above(MIN_PLAUSIBLE_HEIGHT, height) => {
                Diagnostic::new(&messages::LOW_CLAMP).with("height", height)
            }
            Some(_) => return height,
        };
        let problem = self.at(number, text.anchor(), problem.with_text(read.whole_text_fault()));
        self.report(problem);
        height
    }

    fn at(&self, entity: usize, point: Xy, problem: Diagnostic) -> Diagnostic {
        at_entity(self.drawing, entity, point, problem)
    }
}

impl<'d> OutlineTexts<'d> {
    fn add(&mut self, number: usize, text: AnyText<'d>) {
        self.count += 1;
        if self.first.len() < MAX_LISTED_TEXTS {
            self.first.push((number, text));
        }
    }
}

/// Returns the height in a text of the form `Z25`.
fn height(text: ParameterText<'_>) -> Option<f64> {
    let [piece] = text.pieces() else { return None };
    match (piece.letter, piece.written) {
        (Some(Letter::Z), ValueKind::Number(height)) if height > 0.0 => Some(height),
        _ => None,
    }
}

fn one_line(text: AnyText<'_>) -> String {
    without_percent_codes(text.string()).trim_end().replace('\n', " ")
}

fn on_layer(layer: &str, mut problem: Diagnostic) -> Diagnostic {
    problem.place.layer = Some(layer.into());
    problem
}

/// A curve that may be part of a ring.
#[derive(Clone, Copy)]
struct RingPart {
    curve: Curve,
    /// Number of the curve's polyline; the parts of a polyline are consecutive.
    group: Option<u32>,
    /// The index of the curve's entity.
    entity: usize,
}

/// The result of joining curves.
enum Ring {
    /// A closed sequence of curves.
    Closed(Vec<RingPart>),
    /// An open sequence of curves, from one end to the other, and the curve at its last end.
    Open { part: RingPart, curves: Vec<Curve> },
    /// A point where more than two curves end.
    Branch { part: RingPart, at: Xy },
}

/// Returns the rings formed by curves: first polylines that are closed themselves, then everything else.
fn rings(parts: &[RingPart]) -> Vec<Ring> {
    let (mut rings, mut loose) = (Vec::new(), Vec::new());
    for polyline in parts.chunk_by(|one, other| one.group.is_some() && one.group == other.group) {
        if is_closed(polyline) {
            rings.push(Ring::Closed(polyline.to_vec()));
        } else {
            loose.extend_from_slice(polyline);
        }
    }
    rings.extend(RingBuilder::new(&loose).rings());
    rings
}

/// Whether the curves form a closed sequence. A line without length encloses nothing.
fn is_closed(parts: &[RingPart]) -> bool {
    let next = parts.iter().cycle().skip(1);
    let is_whole = |part: &RingPart| matches!(part.curve, Curve::Arc(Arc { degrees: 360.0, .. }));
    (parts.len() > 1 || parts.iter().all(is_whole))
        && parts.iter().zip(next).all(|(one, next)| coincide(one.curve.end(), next.curve.start()))
}

/// The end of a curve: twice the index of the curve, plus one for its second end.
type CurveEnd = usize;

/// The other ends that an end coincides with.
#[derive(Clone, Copy, PartialEq)]
enum Junction {
    Nothing,
    One(CurveEnd),
    Several,
}

struct RingBuilder<'p> {
    parts: &'p [RingPart],
    /// For each end, the other ends that it coincides with.
    junctions: Vec<Junction>,
    is_done: Vec<bool>,
}

/// Search distance in mm: for ends that may coincide, and for outlines that a point of a hatch may touch.
const END_SEARCH_RADIUS: f64 = 1e-3;

impl<'p> RingBuilder<'p> {
    fn new(parts: &'p [RingPart]) -> Self {
        let ends = || (0..2 * parts.len()).map(|end| (end, end_point(parts, end)));
        let tree = RTree::bulk_load(ends().map(|(end, at)| GeomWithData::new([at.x, at.y], end)).collect());
        let junctions = |(end, place): (CurveEnd, Xy)| {
            let near = tree
                .locate_within_distance([place.x, place.y], END_SEARCH_RADIUS * END_SEARCH_RADIUS)
                .map(|other| other.data);
            let mut others = near.filter(|other| *other != end && coincide(place, end_point(parts, *other)));
            match (others.next(), others.next()) {
                (None, _) => Junction::Nothing,
                (Some(other), None) => Junction::One(other),
                (Some(_), Some(_)) => Junction::Several,
            }
        };
        Self { parts, junctions: ends().map(junctions).collect(), is_done: vec![false; parts.len()] }
    }

    fn rings(mut self) -> Vec<Ring> {
        let mut rings = Vec::new();
        for first in 0..self.parts.len() {
            if !self.is_done[first] {
                rings.push(self.ring(first));
            }
        }
        rings
    }

    /// Follows curves from an end until the ring closes, or until no curve or several curves continue.
    fn ring(&mut self, first: usize) -> Ring {
        let start = 2 * first;
        let (ring, last) = self.follow_curves(start + 1);
        match self.next(last) {
            Some(next) if next == start => return Ring::Closed(ring),
            _ => {}
        }
        // Follow the curves in the other direction as well, so that the whole open sequence is reported once.
        let (back, other) = self.follow_curves(start);
        let several = [last, other].into_iter().find(|end| self.junctions[*end] != Junction::Nothing);
        let (end, part) = (several.unwrap_or(last), self.parts[several.unwrap_or(last) / 2]);
        if several.is_some() {
            return Ring::Branch { part, at: end_point(self.parts, end) };
        }
        // Both sequences begin with the first curve.
        let back = back.iter().skip(1).rev().map(|part| part.curve.reversed());
        Ring::Open { part, curves: back.chain(ring.iter().map(|part| part.curve)).collect() }
    }

    /// Follows the sequence of curves that leaves through this end. Returns its curves, beginning with that of `from`, and the end at which it stops.
    fn follow_curves(&mut self, from: CurveEnd) -> (Vec<RingPart>, CurveEnd) {
        let mut ring = vec![self.take_towards(from)];
        let mut end = from;
        while let Some(next) = self.next(end).filter(|next| !self.is_done[next / 2]) {
            end = next ^ 1;
            ring.push(self.take_towards(end));
        }
        (ring, end)
    }

    /// Returns the only end that this end meets, if that end meets no further end.
    fn next(&self, end: CurveEnd) -> Option<CurveEnd> {
        let Junction::One(next) = self.junctions[end] else { return None };
        (self.junctions[next] == Junction::One(end)).then_some(next)
    }

    /// Marks a curve as done and returns it in the direction towards this end.
    fn take_towards(&mut self, end: CurveEnd) -> RingPart {
        let part = self.parts[end / 2];
        self.is_done[end / 2] = true;
        RingPart { curve: if end % 2 == 1 { part.curve } else { part.curve.reversed() }, ..part }
    }
}

fn end_point(parts: &[RingPart], end: CurveEnd) -> Xy {
    let curve = &parts[end / 2].curve;
    if end % 2 == 1 { curve.end() } else { curve.start() }
}
