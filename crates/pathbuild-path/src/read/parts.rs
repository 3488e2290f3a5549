//! Reads the outlines of finished parts. (book: language/part)

use std::collections::BTreeMap;

use pathbuild_diagnostic::messages::{drawing, part as messages};
use pathbuild_diagnostic::{Diagnostic, Place};
use pathbuild_dxf::{Drawing, Geometry};
use smol_str::SmolStr;

use crate::geometry::{Arc, Curve};
use crate::language::Language;
use crate::line_type::{LineType, LineTypes};
use crate::names::{LayerPattern, with_points};
use crate::part::{DrawnParts, OpenOutline, Part, PartRing};
use crate::read::broken_outlines::{SortedOutlines, ends_of_chain, gap_problem};
use crate::read::entities::{AnyText, anchor_of, at_entity, curve, xy};
use crate::read::likely_parameters::may_be_stray_text;
use crate::read::outline_graph::Graph;
use crate::read::rings::{JOIN_DISTANCE, curves_of};

/// Finds the parts of a drawing. At least the layers with parts must have been read.
pub fn parts(drawing: &Drawing, language: &Language) -> DrawnParts {
    let mut found = DrawnParts::default();
    let Some(settings) = &language.part else { return found };
    let layers = OutlineLayers::read(drawing, language, &settings.pattern);
    found.problems.extend(layers.hidden_layer_problems());
    found.problems.extend(layers.unreadable_curve_problems());
    for (paths, curves) in &layers.curves {
        let graph = Graph::new(curves.iter().map(|drawn| drawn.curve).collect());
        let outlines = SortedOutlines::new(&graph);
        for (end, other) in graph.near_misses() {
            let (at, other) = (graph.end(end), graph.end(other));
            if !outlines.are_overlong(at, other) {
                found.problems.push(at_entity(drawing, curves[end / 2].entity, at, gap_problem(at, other)));
            }
        }
        for broken in &outlines.broken {
            let problem = broken.problem.clone();
            let place = |problem| at_entity(drawing, curves[broken.curve].entity, broken.at, problem);
            found.problems.extend(problem.map(place));
        }
        let open = outlines.open.iter().filter(|_| !outlines.rings.is_empty());
        found.open.extend(open.filter_map(|chain| {
            let (curve, at, other) = ends_of_chain(chain)?;
            let problem = at_entity(drawing, curves[curve].entity, at, gap_problem(at, other));
            Some(OpenOutline { paths: paths.clone(), curves: curves_of(chain), problem })
        }));
        layers.add_parts(paths.as_ref(), curves, &outlines, &mut found);
    }
    found.problems.extend(layers.without_rings(&found));
    found
}

/// Whether a text on a layer with parts may be a parameter text of a path. Texts on layers that are not read are noted by the reader.
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
    /// The index of the curve's entity.
    entity: usize,
}

/// The curves on the layers with parts, grouped by the name that the pattern captures.
struct OutlineLayers<'d> {
    drawing: &'d Drawing,
    language: &'d Language,
    /// For each layer of the drawing, whether it holds parts.
    layers: Vec<bool>,
    curves: BTreeMap<Option<SmolStr>, Vec<OutlineCurve>>,
}

impl<'d> OutlineLayers<'d> {
    fn read(drawing: &'d Drawing, language: &'d Language, pattern: &LayerPattern) -> Self {
        let layers: Vec<bool> = drawing.layers.iter().map(|layer| language.is_part(&layer.name)).collect();
        let path = |name: &str| Some(with_points(pattern.captured_text(name)?).to_uppercase().into());
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
            if let Some(curve) = curve.filter(|curve| curve.length() > JOIN_DISTANCE) {
                curves.entry(paths[layer].clone()).or_default().push(OutlineCurve { curve, entity: number });
            }
        }
        Self { drawing, language, layers, curves }
    }

    /// Returns PB112 for layers that are frozen or off.
    fn hidden_layer_problems(&self) -> impl Iterator<Item = Diagnostic> {
        let layers = self.drawing.layers.iter().zip(&self.layers);
        layers.filter(|(layer, is_part)| **is_part && layer.hidden).map(|(layer, _)| {
            let place = Place { layer: Some(layer.name.clone()), ..Place::default() };
            let problem = Diagnostic::new(&drawing::PART_NOT_VISIBLE).quoting("layer", &*layer.name);
            Diagnostic { place, ..problem }
        })
    }

    /// Returns PB219 for curves that may be part of an outline and could not be read.
    fn unreadable_curve_problems(&self) -> impl Iterator<Item = Diagnostic> {
        let is_read = |layer: u32| self.layers[layer as usize];
        let problem = |message, cause: &Diagnostic| {
            let entity = cause.place.entity.map_or("?", |entity| entity.name());
            let problem = Diagnostic::new(message).quoting("entity", entity);
            Diagnostic { place: cause.place.clone(), ..problem }
        };
        let left_out = self.language.left_out(self.drawing).filter(move |left_out| is_read(left_out.layer));
        let left_out =
            left_out.map(move |left_out| problem(&messages::OUTLINE_UNREADABLE, &left_out.diagnostic));
        let faults = self.drawing.faults.iter().filter(move |fault| is_read(fault.layer));
        left_out.chain(faults.map(move |fault| {
            let cause = &fault.diagnostic;
            problem(&messages::OUTLINE_FAULTY, cause).note(cause.message, cause.arguments.clone())
        }))
    }

    /// Returns PB219 for layers on which no curve belongs to a closed ring, unless something other than an unreadable curve is reported there.
    fn without_rings(&self, found: &DrawnParts) -> Vec<Diagnostic> {
        let is_unread = |problem: &&Diagnostic| {
            [&messages::OUTLINE_UNREADABLE, &messages::OUTLINE_FAULTY].contains(&problem.message)
        };
        let reported = found.problems.iter().filter(|problem| !is_unread(problem));
        let places = found.places.iter().flatten().chain(reported.map(|problem| &problem.place));
        let closed: Vec<&str> = places.filter_map(|place| place.layer.as_deref()).collect();
        let layers = self.drawing.layers.iter().zip(&self.layers).enumerate();
        let without = layers.filter(|(_, (layer, is_part))| **is_part && !closed.contains(&&*layer.name));
        let problem = |(number, (layer, _)): (usize, (&pathbuild_dxf::Layer, _))| {
            let is_curve = |geometry: &Geometry| !matches!(geometry, Geometry::Text(_) | Geometry::MText(_));
            let mut entities = (0..).zip(&self.drawing.entities);
            let first =
                entities.find(|(_, entity)| entity.layer as usize == number && is_curve(&entity.geometry))?.0;
            let problem = Diagnostic::new(&messages::NO_CLOSED_OUTLINE).quoting("layer", &*layer.name);
            Some(at_entity(self.drawing, first, anchor_of(&self.drawing.entities[first].geometry), problem))
        };
        without.filter_map(problem).collect()
    }

    /// Adds the parts that rings form: each ring that lies in no other one, with all rings inside it. Rings inside a broken outline are
    /// openings of a part that is not known.
    fn add_parts(
        &self,
        paths: Option<&SmolStr>,
        curves: &[OutlineCurve],
        outlines: &SortedOutlines,
        found: &mut DrawnParts,
    ) {
        let SortedOutlines { rings, around, .. } = outlines;
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
        let is_rim = |ring: &usize| around[*ring].is_empty() && !outlines.is_enclosed(&rings[*ring]);
        for outer in (0..rings.len()).filter(is_rim) {
            let openings: Vec<usize> =
                (0..rings.len()).filter(|ring| around[*ring].first() == Some(&outer)).collect();
            let number = |ring: &usize| Some(openings.binary_search(ring).ok()? + 1);
            let opening = |opening: &usize| PartRing {
                curves: rings[*opening].iter().rev().map(|(_, curve)| curve.reversed()).collect(),
                // Where openings cross each other, the outer one may be in another part.
                around: around[*opening].iter().filter_map(number).collect(),
            };
            let rim = PartRing { curves: curves_of(&rings[outer]), around: Vec::new() };
            let places: Vec<Place> = [outer].iter().chain(&openings).copied().map(place).collect();
            found.parts.push(Part {
                layer: places[0].layer.as_deref().unwrap_or_default().into(),
                paths: paths.cloned(),
                rings: [rim].into_iter().chain(openings.iter().map(opening)).collect(),
            });
            found.places.push(places);
        }
    }
}
