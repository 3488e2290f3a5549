//! Reads the outlines of finished parts. (book: language/part)

use std::collections::BTreeMap;

use pathbuild_diagnostic::messages::part as messages;
use pathbuild_diagnostic::{Diagnostic, Place};
use pathbuild_dxf::{Drawing, Geometry};
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};
use smol_str::SmolStr;

use crate::element::shown;
use crate::geometry::{Arc, Curve, Xy};
use crate::keep_out::Outline;
use crate::language::Language;
use crate::line_type::{LineType, LineTypes};
use crate::names::LayerPattern;
use crate::part::{DrawnParts, Part, PartRing};
use crate::read::entities::{AnyText, at_entity, begin, curve, xy};
use crate::read::stray::may_be_stray_text;

/// Largest distance in mm of ends that join.
const JOINED: f64 = 0.01;

/// Largest distance in mm of two loose ends that were probably meant to meet.
const NEARLY_JOINED: f64 = 0.5;

/// The parts of a drawing. At least the layers with parts must have been read.
pub fn parts(drawing: &Drawing, language: &Language) -> DrawnParts {
    let mut found = DrawnParts::default();
    let Some(settings) = &language.part else { return found };
    let layers = OutlineLayers::read(drawing, language, &settings.pattern);
    found.problems.extend(layers.unreadable());
    for (paths, curves) in &layers.curves {
        let graph = Graph::new(curves.iter().map(|drawn| drawn.curve).collect());
        for (end, other) in graph.near_misses() {
            let problem = Diagnostic::new(&messages::OUTLINE_GAP)
                .with("point", shown(end.1))
                .with("other", shown(other))
                .with("distance", (other - end.1).norm());
            found.problems.push(at_entity(drawing, curves[end.0].entity, end.1, problem));
        }
        layers.add_parts(paths.as_ref(), curves, graph.rings(), &mut found);
    }
    found.problems.extend(layers.without_rings(&found));
    found
}

/// Whether a text on a layer with parts may be one of a path. Texts on layers that are not read are noted by the reader.
pub fn has_text_on_part(drawing: &Drawing, language: &Language) -> bool {
    let is_part = |layer: u32| language.is_part(&drawing.layers[layer as usize].name);
    let is_stray = |text: AnyText<'_>| may_be_stray_text(text.string().as_bytes());
    language.part.is_some()
        && drawing
            .entities
            .iter()
            .any(|entity| is_part(entity.layer) && AnyText::of(&entity.geometry).is_some_and(is_stray))
}

/// A curve on a layer with parts.
struct OutlineCurve {
    curve: Curve,
    /// The index of its entity.
    entity: usize,
}

/// The curves of outlines.
struct OutlineLayers<'d> {
    drawing: &'d Drawing,
    /// The layers with parts.
    layers: Vec<bool>,
    /// The curves, by the name that the pattern captures in that of their layer.
    curves: BTreeMap<Option<SmolStr>, Vec<OutlineCurve>>,
}

impl<'d> OutlineLayers<'d> {
    fn read(drawing: &'d Drawing, language: &Language, pattern: &LayerPattern) -> Self {
        let layers: Vec<bool> = drawing.layers.iter().map(|layer| language.is_part(&layer.name)).collect();
        let path = |name: &str| Some(pattern.captured(name)?.replace('_', ".").to_uppercase().into());
        let paths: Vec<_> = drawing.layers.iter().map(|layer| path(&layer.name)).collect();
        let mut line_types = LineTypes::new(&language.line_types);
        let mut curves: BTreeMap<_, Vec<OutlineCurve>> = BTreeMap::new();
        for (number, entity) in drawing.entities.iter().enumerate() {
            let layer = entity.layer as usize;
            if !layers[layer] || line_types.get(&entity.line_type) != Some(LineType::Continuous) {
                continue;
            }
            let curve = match &entity.geometry {
                Geometry::Circle(circle) => {
                    Some(Curve::Arc(Arc::from_angles(xy(circle.centre), circle.radius, 0.0, 360.0, false)))
                }
                geometry => curve(geometry),
            };
            if let Some(curve) = curve.filter(|curve| curve.length() > JOINED) {
                curves.entry(paths[layer].clone()).or_default().push(OutlineCurve { curve, entity: number });
            }
        }
        Self { drawing, layers, curves }
    }

    /// PB219 for curves that may be part of an outline and could not be read.
    fn unreadable(&self) -> impl Iterator<Item = Diagnostic> {
        let left_out = self.drawing.left_out.iter().map(|left_out| (left_out.layer, &left_out.diagnostic));
        let faults = self.drawing.faults.iter().map(|fault| (fault.layer, &fault.diagnostic));
        let on_layer = left_out.chain(faults).filter(|(layer, _)| self.layers[*layer as usize]);
        on_layer.map(|(_, cause)| {
            let entity = cause.place.entity.map_or("?", |entity| entity.name());
            let problem = Diagnostic::new(&messages::OUTLINE_UNREADABLE).quoting("entity", entity);
            Diagnostic { place: cause.place.clone(), ..problem }
        })
    }

    /// PB219 for layers of which no curve belongs to a closed ring.
    fn without_rings(&self, found: &DrawnParts) -> Vec<Diagnostic> {
        let closed: Vec<&str> =
            found.places.iter().flatten().filter_map(|place| place.layer.as_deref()).collect();
        let layers = self.drawing.layers.iter().zip(&self.layers).enumerate();
        let without = layers.filter(|(_, (layer, is_part))| **is_part && !closed.contains(&&*layer.name));
        let problem = |(number, (layer, _)): (usize, (&pathbuild_dxf::Layer, _))| {
            let is_curve = |geometry: &Geometry| !matches!(geometry, Geometry::Text(_) | Geometry::MText(_));
            let mut entities = (0..).zip(&self.drawing.entities);
            let first =
                entities.find(|(_, entity)| entity.layer as usize == number && is_curve(&entity.geometry))?.0;
            let problem = Diagnostic::new(&messages::NO_CLOSED_OUTLINE).quoting("layer", &*layer.name);
            Some(at_entity(self.drawing, first, begin(&self.drawing.entities[first].geometry), problem))
        };
        without.filter_map(problem).collect()
    }

    /// Adds the parts that rings form: each ring in no other one, with all rings inside it.
    fn add_parts(
        &self,
        paths: Option<&SmolStr>,
        curves: &[OutlineCurve],
        mut rings: Vec<Vec<(usize, Curve)>>,
        found: &mut DrawnParts,
    ) {
        rings.sort_by_key(|ring| ring[0].0);
        let bare: Vec<Vec<Curve>> =
            rings.iter().map(|ring| ring.iter().map(|(_, curve)| *curve).collect()).collect();
        let nesting = nesting(&bare);
        let place = |ring: usize| {
            let (number, curve) = &rings[ring][0];
            let point = curve.start();
            at_entity(
                self.drawing,
                curves[*number].entity,
                point,
                Diagnostic::new(&messages::OUTLINE_NOT_CUT),
            )
            .place
        };
        for outer in (0..bare.len()).filter(|ring| nesting[*ring].is_none()) {
            let mut part = Part {
                layer: place(outer).layer.unwrap_or_default().into(),
                paths: paths.cloned(),
                rings: vec![PartRing { curves: bare[outer].clone(), nest: 0 }],
            };
            let mut places: Vec<Place> = vec![place(outer)];
            let mut numbers: BTreeMap<usize, usize> = BTreeMap::new();
            let openings: Vec<usize> =
                (0..bare.len()).filter(|ring| nesting[*ring].is_some_and(|(own, _)| own == outer)).collect();
            numbers.extend(openings.iter().copied().zip(1..));
            for opening in openings {
                let top = nesting[opening].map_or(opening, |(_, top)| top);
                let curves = bare[opening].iter().rev().map(|curve| curve.reversed()).collect();
                part.rings.push(PartRing { curves, nest: numbers[&top] });
                places.push(place(opening));
            }
            found.parts.push(part);
            found.places.push(places);
        }
    }
}

/// For each ring inside others: the outermost of them, and the second outermost, or itself if there is no other.
fn nesting(rings: &[Vec<Curve>]) -> Vec<Option<(usize, usize)>> {
    if rings.len() == 1 {
        return vec![None];
    }
    let outlines: Vec<Outline> = rings.iter().map(|ring| Outline::new(ring)).collect();
    let boxes = outlines.iter().enumerate();
    let boxes = boxes.map(|(n, outline)| GeomWithData::new(Rectangle::from_aabb(outline.extent()), n));
    let boxes: RTree<GeomWithData<Rectangle<[f64; 2]>, usize>> = RTree::bulk_load(boxes.collect());
    let around: Vec<Vec<usize>> = (0..rings.len())
        .map(|ring| {
            let curve = &rings[ring][0];
            let point = curve.section(0.0, curve.length() / 2.0).end();
            let near = boxes.locate_in_envelope_intersecting(AABB::from_point([point.x, point.y]));
            let others = near.map(|near| near.data).filter(|other| *other != ring);
            let mut around: Vec<usize> = others.filter(|other| outlines[*other].contains(point)).collect();
            around.sort_unstable();
            around
        })
        .collect();
    let outermost = |ring: usize| {
        let outer = *around[ring].iter().min_by_key(|other| around[**other].len())?;
        let mut between: Vec<usize> = around[ring].iter().copied().filter(|other| *other != outer).collect();
        between.push(ring);
        Some((outer, *between.iter().min_by_key(|other| around[**other].len())?))
    };
    (0..rings.len()).map(outermost).collect()
}

/// Curves that meet at nodes. Half-edge `2 * n` runs along curve n, `2 * n + 1` against it.
struct Graph {
    curves: Vec<Curve>,
    /// The node at which each half-edge begins.
    tails: Vec<usize>,
    /// Indices of the curves that have not been dropped.
    numbers: Vec<usize>,
}

impl Graph {
    fn new(curves: Vec<Curve>) -> Self {
        let ends: Vec<Xy> = curves.iter().flat_map(|curve| [curve.start(), curve.end()]).collect();
        let numbered = ends.iter().enumerate().map(|(end, at)| GeomWithData::new([at.x, at.y], end));
        let tree = RTree::bulk_load(numbered.collect());
        let mut tails = vec![usize::MAX; ends.len()];
        for first in 0..ends.len() {
            if tails[first] != usize::MAX {
                continue;
            }
            tails[first] = first;
            let mut open = vec![first];
            while let Some(end) = open.pop() {
                let near = tree.locate_within_distance([ends[end].x, ends[end].y], JOINED * JOINED);
                for other in near.map(|near| near.data) {
                    if tails[other] == usize::MAX {
                        tails[other] = first;
                        open.push(other);
                    }
                }
            }
        }
        let mut graph = Self { numbers: (0..curves.len()).collect(), curves, tails };
        graph.drop_duplicates();
        graph
    }

    /// Drops curves that are drawn twice: curves are equal if their nodes and their middles are.
    fn drop_duplicates(&mut self) {
        let middle = |curve: &Curve| curve.section(0.0, curve.length() / 2.0).end();
        let mut known: BTreeMap<(usize, usize), Vec<Xy>> = BTreeMap::new();
        self.numbers.retain(|number| {
            let (one, other) = (self.tails[2 * number], self.tails[2 * number + 1]);
            let at = middle(&self.curves[*number]);
            let middles = known.entry((one.min(other), one.max(other))).or_default();
            let is_new = middles.iter().all(|middle| (middle - at).norm() > JOINED);
            if is_new {
                middles.push(at);
            }
            is_new
        });
    }

    fn end(&self, half_edge: usize) -> Xy {
        let curve = &self.curves[half_edge / 2];
        if half_edge.is_multiple_of(2) { curve.start() } else { curve.end() }
    }

    /// Pairs of loose ends that almost meet: the curve and the position of one end, and the position of the other.
    fn near_misses(&self) -> Vec<((usize, Xy), Xy)> {
        let mut degrees = vec![0; self.tails.len()];
        let ends = || self.numbers.iter().flat_map(|number| [2 * number, 2 * number + 1]);
        for end in ends() {
            degrees[self.tails[end]] += 1;
        }
        let loose: Vec<usize> = ends().filter(|end| degrees[self.tails[*end]] == 1).collect();
        let numbered = loose.iter().map(|end| GeomWithData::new([self.end(*end).x, self.end(*end).y], *end));
        let tree = RTree::bulk_load(numbered.collect());
        let nearest = |end: usize| {
            let at = self.end(end);
            let near = tree.locate_within_distance([at.x, at.y], NEARLY_JOINED * NEARLY_JOINED);
            let others = near.map(|near| near.data).filter(|other| *other != end);
            let distance = |other: &usize| (self.end(*other) - at).norm();
            others.min_by(|one, other| distance(one).total_cmp(&distance(other)).then(one.cmp(other)))
        };
        let pairs = loose.iter().filter_map(|end| Some((*end, nearest(*end)?)));
        let mut pairs: Vec<(usize, usize)> =
            pairs.map(|(one, other)| (one.min(other), one.max(other))).collect();
        pairs.sort_unstable();
        pairs.dedup();
        pairs.into_iter().map(|(one, other)| ((one / 2, self.end(one)), self.end(other))).collect()
    }

    /// The outer rings of all connected curves, counterclockwise, each curve with its number. Curves with the same area on both sides are
    /// dropped: dangling chains, and lines from one ring to another.
    fn rings(&self) -> Vec<Vec<(usize, Curve)>> {
        let faces = self.faces(&self.numbers);
        let mut face_of = vec![0; 2 * self.curves.len()];
        for (number, face) in faces.iter().enumerate() {
            for half_edge in face {
                face_of[*half_edge] = number;
            }
        }
        let divides = |curve: &usize| face_of[2 * curve] != face_of[2 * curve + 1];
        let kept: Vec<usize> = self.numbers.iter().copied().filter(divides).collect();
        let outer = self.faces(&kept).into_iter().filter(|face| self.area(face) < -JOINED * JOINED);
        let ring = |face: Vec<usize>| {
            let backwards = face.into_iter().rev().map(|half_edge| half_edge ^ 1);
            backwards.map(|half_edge| (half_edge / 2, self.directed(half_edge))).collect()
        };
        outer.map(ring).collect()
    }

    fn directed(&self, half_edge: usize) -> Curve {
        let curve = self.curves[half_edge / 2];
        if half_edge.is_multiple_of(2) { curve } else { curve.reversed() }
    }

    /// The faces of the kept curves, each on the left of its half-edges.
    fn faces(&self, curves: &[usize]) -> Vec<Vec<usize>> {
        let half_edges = || curves.iter().flat_map(|curve| [2 * curve, 2 * curve + 1]);
        let mut outgoing: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for half_edge in half_edges() {
            outgoing.entry(self.tails[half_edge]).or_default().push(half_edge);
        }
        for edges in outgoing.values_mut() {
            let shortest =
                edges.iter().map(|edge| self.curves[edge / 2].length()).fold(10.0 * JOINED, f64::min);
            let angle = |half_edge: usize| {
                let curve = self.directed(half_edge);
                let way = curve.section(0.0, shortest / 2.0).end() - curve.start();
                libm::atan2(way.y, way.x)
            };
            edges.sort_by(|one, other| angle(*one).total_cmp(&angle(*other)).then(one.cmp(other)));
        }
        let next = |half_edge: usize| {
            let back = half_edge ^ 1;
            let edges = &outgoing[&self.tails[back]];
            let place = edges.iter().position(|edge| *edge == back).unwrap_or_default();
            edges[(place + edges.len() - 1) % edges.len()]
        };
        let mut is_done = vec![false; self.tails.len()];
        let mut faces = Vec::new();
        for first in half_edges() {
            let mut face = Vec::new();
            let mut half_edge = first;
            while !std::mem::replace(&mut is_done[half_edge], true) {
                face.push(half_edge);
                half_edge = next(half_edge);
            }
            if !face.is_empty() {
                faces.push(face);
            }
        }
        faces
    }

    /// The area inside half-edges in mm², positive if they run counterclockwise.
    fn area(&self, face: &[usize]) -> f64 {
        let origin = self.end(face[0]);
        let area = |half_edge: &usize| {
            let curve = self.directed(*half_edge);
            let below = (curve.start() - origin).perp(&(curve.end() - origin)) / 2.0;
            let Curve::Arc(arc) = curve else { return below };
            let angle = arc.degrees.to_radians();
            let segment = arc.radius * arc.radius * (angle - libm::sin(angle)) / 2.0;
            below + if arc.clockwise { -segment } else { segment }
        };
        face.iter().map(area).sum()
    }
}
