//! Hints at what is probably drawn on the wrong layer, searched only where a path breaks off, lacks a marker or has a stray text.

use std::cell::OnceCell;

use pathbuild_diagnostic::messages::{drawing, walk};
use pathbuild_diagnostic::{Code, Diagnostic, EntityKind, Note, Number, Point, Value};
use pathbuild_dxf::{Drawing, Entity, Geometry};
use pathbuild_path::{Arc, Curve, Language, Line, LineType, PathName, TextCircle, Xy, on_circle};

/// Everything on all layers of a drawing. The drawing is read again when it is first needed.
pub(super) struct LayerEnds<'a> {
    /// Reads all layers of the drawing.
    read: &'a dyn Fn() -> Drawing,
    all: OnceCell<Drawing>,
}

/// An end of a line or arc on any layer.
struct LayerEnd {
    layer: Box<str>,
    kind: EntityKind,
    point: Point,
}

/// Largest distance in mm at which an end on another layer is worth a hint.
const WORTH_NAMING: f64 = 1.0;

impl<'a> LayerEnds<'a> {
    pub(super) fn new(read: &'a dyn Fn() -> Drawing) -> Self {
        Self { read, all: OnceCell::new() }
    }

    /// Adds what is drawn on another layer and was probably meant: to PB401 an end, to PB101 and PB102 a circle, to PB107 an element.
    pub(super) fn with_hint(
        &self,
        path: &PathName,
        language: &Language,
        mut problem: Diagnostic,
    ) -> Diagnostic {
        let hint = match problem.code() {
            Code::NothingContinues if problem.message != &walk::DRAWN_TWICE => {
                self.end(path, language, &problem)
            }
            Code::MissingStart => self.marker(language, &problem, START, &drawing::START_ON_OTHER_LAYER),
            Code::MissingEnd => self.marker(language, &problem, END, &drawing::END_MARKER_ON_OTHER_LAYER),
            Code::TextWithoutElement => self.element(&problem),
            _ => None,
        };
        if let Some((note, distance)) = hint {
            // What is farther away on the path's own layer was hardly meant.
            problem.notes.retain(|other| distance_of(other).is_none_or(|other| other <= distance));
            let nearer = problem.notes.iter().take_while(|other| distance_of(other).is_some()).count();
            problem.notes.insert(nearer, note);
        }
        problem
    }

    fn entities(&self) -> impl Iterator<Item = (&str, &Entity)> {
        let all = self.all.get_or_init(self.read);
        all.entities.iter().map(|entity| (&*all.layers[entity.layer as usize].name, entity))
    }

    /// The nearest end on a layer of no or another path.
    fn end(&self, path: &PathName, language: &Language, problem: &Diagnostic) -> Option<(Note, f64)> {
        let point = problem.place.point?;
        let ends = all_ends(self.all.get_or_init(self.read));
        let is_other =
            |end: &&LayerEnd| language.path_pattern.layer(&end.layer).is_none_or(|layer| layer.path != *path);
        let distances = ends.iter().filter(is_other).map(|end| (end, distance(end.point, point)));
        let (end, distance) = distances.reduce(|best, other| if other.1 < best.1 { other } else { best })?;
        let arguments = vec![
            ("layer", (&*end.layer).into()),
            ("element", end.kind.name().into()),
            ("point", end.point.into()),
            ("distance", distance.into()),
        ];
        let note = Note { message: &walk::END_ON_OTHER_LAYER, arguments };
        (distance <= WORTH_NAMING).then_some((note, distance))
    }

    /// A marker of this radius on a layer of no path.
    fn marker(
        &self,
        language: &Language,
        problem: &Diagnostic,
        radius: f64,
        message: &'static pathbuild_diagnostic::Message,
    ) -> Option<(Note, f64)> {
        // Another circle was named already.
        if !problem.notes.is_empty() {
            return None;
        }
        let (layer, centre) = self.entities().find_map(|(layer, entity)| match &entity.geometry {
            Geometry::Circle(circle) if (circle.radius - radius).abs() < SAME_RADIUS => {
                let is_phantom =
                    LineType::of(&entity.line_type, &language.line_types) == Some(LineType::Phantom);
                let is_of_path = language.path_pattern.layer(layer).is_some();
                (is_phantom && !is_of_path).then_some((layer, Point::new(circle.centre.x, circle.centre.y)))
            }
            _ => None,
        })?;
        Some((Note { message, arguments: vec![("layer", layer.into()), ("point", centre.into())] }, 0.0))
    }

    /// The element on another layer that is nearest to a text.
    fn element(&self, problem: &Diagnostic) -> Option<(Note, f64)> {
        let argument =
            |wanted| problem.arguments.iter().find(|(name, _)| *name == wanted).map(|(_, value)| value);
        let (Some(Value::Point(centre)), Some(Value::Number(Number(diameter)))) =
            (argument("centre"), argument("diameter"))
        else {
            return None;
        };
        if problem.notes.iter().any(|note| note.message == &drawing::ELEMENT_ON_OTHER_LAYER) {
            return None;
        }
        let text = TextCircle { centre: Xy::new(centre.x.0, centre.y.0), radius: diameter / 2.0 };
        let own = problem.place.layer.as_deref();
        let others = self.entities().filter(|(layer, _)| Some(*layer) != own);
        let distances =
            others.filter_map(|(layer, entity)| Some((layer, entity, gap(&text, &entity.geometry)?)));
        let (layer, entity, gap) =
            distances.reduce(|best, other| if other.2 < best.2 { other } else { best })?;
        let arguments =
            vec![("layer", layer.into()), ("element", entity.kind.name().into()), ("distance", gap.into())];
        (gap <= WORTH_NAMING).then_some((Note { message: &drawing::NEAR_ON_OTHER_LAYER, arguments }, gap))
    }
}

/// The distance that a note names, in mm.
fn distance_of(note: &Note) -> Option<f64> {
    match note.arguments.iter().find(|(name, _)| *name == "distance")? {
        (_, Value::Number(Number(distance))) => Some(*distance),
        _ => None,
    }
}

/// Radii of the start and the end marker in mm, and how far others may be off.
const START: f64 = 0.5;
const END: f64 = 1.0;
const SAME_RADIUS: f64 = 0.001;

/// The distance of an element from the circle of a text; `None` for texts.
fn gap(text: &TextCircle, geometry: &Geometry) -> Option<f64> {
    let xy = |point: &pathbuild_dxf::Point3| Xy::new(point.x, point.y);
    Some(match geometry {
        Geometry::Line(line) => {
            text.gap_to(&Curve::Line(Line { start: xy(&line.start), end: xy(&line.end) }))
        }
        Geometry::Arc(arc) => {
            let centre = xy(&arc.centre);
            let curve = Arc::from_angles(centre, arc.radius, arc.start_angle, arc.end_angle, arc.clockwise);
            text.gap_to(&Curve::Arc(curve))
        }
        Geometry::Circle(circle) => {
            ((xy(&circle.centre) - text.centre).norm() - text.radius - circle.radius).max(0.0)
        }
        Geometry::Text(_) | Geometry::MText(_) => return None,
    })
}

fn all_ends(drawing: &Drawing) -> Vec<LayerEnd> {
    let mut ends = Vec::new();
    for entity in &drawing.entities {
        let layer = &drawing.layers[entity.layer as usize].name;
        let mut add = |point: Xy| {
            ends.push(LayerEnd {
                layer: layer.clone(),
                kind: entity.kind,
                point: Point::new(point.x, point.y),
            });
        };
        match &entity.geometry {
            Geometry::Line(line) => {
                add(Xy::new(line.start.x, line.start.y));
                add(Xy::new(line.end.x, line.end.y));
            }
            Geometry::Arc(arc) => {
                let centre = Xy::new(arc.centre.x, arc.centre.y);
                add(on_circle(centre, arc.radius, arc.start_angle));
                add(on_circle(centre, arc.radius, arc.end_angle));
            }
            Geometry::Circle(_) | Geometry::Text(_) | Geometry::MText(_) => {}
        }
    }
    ends
}

fn distance(a: Point, b: Point) -> f64 {
    let difference = |Number(a): Number, Number(b): Number| a - b;
    Xy::new(difference(a.x, b.x), difference(a.y, b.y)).coords.norm()
}
