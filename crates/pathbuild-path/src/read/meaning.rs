//! Determines the meaning of each entity of a path. (book: language/line-types, book: language/markers)

use pathbuild_diagnostic::messages::drawing as messages;
use pathbuild_diagnostic::{Diagnostic, Value};
use pathbuild_dxf::{Arc as DxfArc, Entity, Geometry, Point3};

use super::collect::{Owner, PathCollector, UnclearCircle};
use crate::approx::near;
use crate::assign::Candidate;
use crate::element::{
    CircleMeaning, Element, Marker, MeantMarker, Origin, Role, Shape, Source, circle_meaning, curve_role,
};
use crate::geometry::{Arc, Curve, Line, Xy};
use crate::line_type::{LineType, LineTypes};
use crate::raw::Position;

/// An entity on one of a path's layers.
#[derive(Clone, Copy)]
struct LayerEntity<'d> {
    source: Source,
    entity: &'d Entity,
    line_type: Option<LineType>,
}

impl<'d> PathCollector<'d> {
    /// Adds the next entity in file order.
    pub(super) fn add(
        &mut self,
        entity: &'d Entity,
        layer: u32,
        position: Position,
        line_types: &mut LineTypes<'_, 'd>,
    ) {
        let source = Source { id: self.next_id(position), entity: entity.kind, layer };
        let found = |line_type| LayerEntity { source, entity, line_type };
        match &entity.geometry {
            Geometry::Text(text) => self.texts.add_text(text, source),
            Geometry::MText(text) => self.texts.add_mtext(text, source),
            Geometry::Circle(circle) => {
                self.check_plane(source, &[circle.centre], xy(circle.centre));
                let found = found(line_types.get(&entity.line_type));
                self.add_circle(&found, xy(circle.centre), circle.radius);
            }
            Geometry::Line(line) => {
                let curve = Curve::Line(Line { start: xy(line.start), end: xy(line.end) });
                self.check_plane(source, &[line.start, line.end], curve.start());
                self.add_curve(&found(line_types.get(&entity.line_type)), curve);
            }
            Geometry::Arc(arc) => {
                let curve = Curve::Arc(plane_arc(arc));
                self.check_plane(source, &[arc.centre], curve.start());
                self.add_curve(&found(line_types.get(&entity.line_type)), curve);
            }
        }
    }

    fn origin(&self, source: Source, point: Xy) -> Origin {
        self.texts.origin(source, point)
    }

    fn check_plane(&mut self, source: Source, points: &[Point3], begin: Xy) {
        self.has_elements = true;
        // The usual case.
        if points.iter().all(|point| point.z == 0.0) {
            return;
        }
        if let Some(point) = points.iter().find(|point| !near(point.z, 0.0)) {
            let problem = Diagnostic::new(&messages::OFF_PLANE).with("z", point.z);
            self.report_shared("", self.origin(source, begin).at(problem));
        }
    }

    fn add_curve(&mut self, found: &LayerEntity<'_>, curve: Curve) {
        let shape = Shape::Curve(curve);
        let Some(role) = found.line_type.and_then(curve_role) else {
            self.add_unknown(found, shape);
            let element = Element { source: found.source, shape, role: Role::SilentSweep, text: None };
            return self.faults.unclear_curves.push(element);
        };
        self.add_element(found, shape, role);
    }

    fn add_circle(&mut self, found: &LayerEntity<'_>, centre: Xy, radius: f64) {
        let shape = Shape::Circle { centre, radius };
        let Some(line_type) = found.line_type else {
            let like = LineType::like(&found.entity.line_type).unwrap_or(LineType::Phantom);
            self.add_unclear(found, shape, MeantMarker::of(like, radius));
            return self.add_unknown(found, shape);
        };
        match circle_meaning(line_type, radius) {
            CircleMeaning::Cut(cut) => self.add_element(found, shape, Role::Cut(cut)),
            CircleMeaning::Start => self.add_start(found, shape),
            CircleMeaning::End => self.ends.push(self.marker(found, centre)),
            CircleMeaning::Turn => self.turns.push(self.marker(found, centre)),
            CircleMeaning::IgnoredProbe => self.candidate(found, shape, Owner::Faulty),
            CircleMeaning::Probe => {
                self.candidate(found, shape, Owner::Probe(self.probes.len()));
                self.probes.push(self.marker(found, centre));
            }
            CircleMeaning::UnknownLineType => self.add_unknown(found, shape),
            CircleMeaning::UnknownDiameter => {
                let diagnostic = Diagnostic::new(&messages::UNKNOWN_SPECIAL_CIRCLE)
                    .quoting("line_type", &*found.entity.line_type)
                    .with("diameter", exact(2.0 * radius));
                self.report(self.origin(found.source, centre).at(diagnostic));
                let is_phantom = line_type == LineType::Phantom;
                let meant = if is_phantom { MeantMarker::of_radius(radius) } else { MeantMarker::Other };
                self.add_unclear(found, shape, meant);
                self.candidate(found, shape, Owner::Faulty);
            }
        }
    }

    fn add_unclear(&mut self, found: &LayerEntity<'_>, shape: Shape, meant: MeantMarker) {
        let marker = self.marker(found, shape.point());
        self.faults.unclear_circles.push(marker.at);
        self.unclear.push(UnclearCircle { marker, shape, meant });
    }

    fn marker(&self, found: &LayerEntity<'_>, at: Xy) -> Marker {
        Marker { origin: self.origin(found.source, at), at, text: None }
    }

    fn add_start(&mut self, found: &LayerEntity<'_>, shape: Shape) {
        let marker = self.marker(found, shape.point());
        if let Some(first) = &self.start {
            let diagnostic = Diagnostic::new(&messages::TWO_STARTS)
                .quoting("name", self.name.as_str())
                .with("first", first.origin.point);
            self.candidate(found, shape, Owner::Faulty);
            self.faults.has_second_start = true;
            return self.report(marker.origin.at(diagnostic));
        }
        self.candidate(found, shape, Owner::Start);
        self.start = Some(marker);
    }

    /// Adds an element with a meaningless line type. It still takes its text, which would otherwise be reported as belonging to nothing.
    fn add_unknown(&mut self, found: &LayerEntity<'_>, shape: Shape) {
        let known: Value = LineType::NAMES.iter().map(|(name, _)| *name).collect();
        let name = &*found.entity.line_type;
        let like = LineType::like(name);
        let (message, shown) = match (found.line_type, like) {
            (Some(_), _) => (&messages::LINE_TYPE_ON_ENTITY, None),
            (None, Some(like)) => (&messages::LINE_TYPE_LIKE_ANOTHER, Some(like.name())),
            (None, None) => (&messages::UNKNOWN_LINE_TYPE, None),
        };
        let mut diagnostic = Diagnostic::new(message)
            .quoting("line_type", name)
            .with("element", shape.word())
            .with("known", known);
        if let Some(like) = shown {
            diagnostic = diagnostic.quoting("like", like);
        }
        self.report_shared(name, self.origin(found.source, shape.point()).at(diagnostic));
        self.candidate(found, shape, Owner::Faulty);
    }

    fn add_element(&mut self, found: &LayerEntity<'_>, shape: Shape, role: Role) {
        if role != Role::SilentSweep {
            self.candidate(found, shape, Owner::Element(self.elements.len()));
        }
        self.elements.push(Element { source: found.source, shape, role, text: None });
    }

    fn candidate(&mut self, found: &LayerEntity<'_>, shape: Shape, owner: Owner) {
        let LayerEntity { source, entity, .. } = *found;
        let candidate = Candidate { id: source.id, shape, group: entity.group, owner, is_taken: false };
        self.texts.add_candidate(source.layer, candidate);
    }
}

/// A length with enough digits to distinguish it from a similar one: 1.0001, not 1.
fn exact(length: f64) -> Value {
    let is_shown = (length * 1000.0 - (length * 1000.0).round()).abs() <= 1e-6;
    if is_shown { length.into() } else { Value::quoted(format!("{length:.9}").trim_end_matches('0')) }
}

pub(super) fn xy(point: Point3) -> Xy {
    Xy::new(point.x, point.y)
}

pub(super) fn plane_arc(arc: &DxfArc) -> Arc {
    Arc::from_angles(xy(arc.centre), arc.radius, arc.start_angle, arc.end_angle, arc.clockwise)
}
