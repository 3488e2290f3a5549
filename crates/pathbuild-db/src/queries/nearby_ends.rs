//! Hints at elements that were probably drawn on the wrong layer. They are searched only for findings that such an element explains: a path
//! that breaks off, a missing marker, a stray or missing text.

use std::cell::OnceCell;

use pathbuild_diagnostic::messages::{drawing, paths};
use pathbuild_diagnostic::{Code, Diagnostic, Message, Note, Number, Point, Value};
use pathbuild_dxf::{Drawing, Entity, Geometry};
use pathbuild_path::approx::{coincide, near};
use pathbuild_path::{
    AnyText, END_RADIUS, Language, Letter, LineType, ParameterTexts, PathName, START_RADIUS, Shape,
    TURN_RADIUS, TextCircle, Xy, near_layer,
};
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

/// Finds hints in the elements on all layers of a drawing. The drawing is read again when a hint is first searched.
pub(super) struct LayerHints<'a> {
    read: &'a dyn Fn() -> Drawing,
    all: OnceCell<AllLayers>,
    /// Indices of the first start marker and the first end marker on layers without a path.
    markers: OnceCell<[Option<usize>; 2]>,
}

/// A drawing with all its layers. Its entities are indexed by bounding box, so that not every one of thousands of problems scans them all.
struct AllLayers {
    drawing: Drawing,
    boxes: RTree<GeomWithData<Rectangle<[f64; 2]>, usize>>,
}

/// Messages about paths that break off or stop for a reason in the path itself: a copy, a gap or a branch.
const MESSAGES_WITH_KNOWN_CAUSE: [&Message; 11] = [
    &paths::DRAWN_TWICE,
    &paths::PART_DRAWN_TWICE,
    &paths::UNREACHED_CIRCLE,
    &paths::UNREACHED_TWICE,
    &paths::UNREACHED_PART_TWICE,
    &paths::UNREACHED_BESIDE,
    &paths::UNREACHED_BRANCH,
    &paths::NO_END_THERE,
    &paths::NO_END_THERE_ALIKE,
    &paths::END_NOT_REACHED_TWICE,
    &paths::END_NOT_REACHED_PART_TWICE,
];

/// Largest distance in mm at which an end or element on another layer is worth a hint.
const MAX_HINT_DISTANCE: f64 = 1.0;

impl<'a> LayerHints<'a> {
    pub(super) fn new(read: &'a dyn Fn() -> Drawing) -> Self {
        Self { read, all: OnceCell::new(), markers: OnceCell::new() }
    }

    /// Adds a note about the element on another layer that was probably meant: an end or a turn marker to PB401 to PB404, a circle to PB101 and
    /// PB102, an element to PB107, a text to PB207.
    pub(super) fn with_hint(
        &self,
        path: &PathName,
        language: &Language,
        mut problem: Diagnostic,
    ) -> Diagnostic {
        let hint = match problem.code() {
            Code::NothingContinues | Code::UnreachedSegments | Code::EndNotReached | Code::EmptyPath
                if !MESSAGES_WITH_KNOWN_CAUSE.contains(&problem.message) =>
            {
                self.nearest_end(path, language, &problem)
            }
            Code::MissingStart => {
                self.nearest_marker(language, &problem, START_MARKER, &drawing::START_ON_OTHER_LAYER)
            }
            Code::MissingEnd => {
                self.nearest_marker(language, &problem, END_MARKER, &drawing::END_MARKER_ON_OTHER_LAYER)
            }
            Code::TextWithoutElement => self.nearest_element(language, &problem),
            Code::MissingPathParameters => self.start_text(&problem),
            _ => None,
        };
        if let Some((note, distance)) = hint {
            // An element of the path's own layer that is farther away is an unlikely cause.
            problem.notes.retain(|other| distance_of(other).is_none_or(|other| other <= distance));
            let nearer = problem.notes.iter().take_while(|other| distance_of(other).is_some()).count();
            problem.notes.insert(nearer, note);
        }
        problem
    }

    /// Adds to PB501 a note about the text that was probably meant as the name.
    pub(super) fn with_name_hint(&self, language: &Language, mut problem: Diagnostic) -> Diagnostic {
        if problem.message == &paths::MISSING_NAME {
            problem.notes.extend(self.name_text(language, &problem));
        }
        problem
    }

    /// Adds to PB519 the layer with the most similar name.
    pub(super) fn with_near_layer(&self, mut problem: Diagnostic) -> Diagnostic {
        if problem.code() == Code::PromisedPath {
            let layers = self.all_layers().drawing.layers.iter().map(|layer| &*layer.name);
            let near = problem.quoted("name").and_then(|name| near_layer(name, layers));
            problem.notes.extend(near);
        }
        problem
    }

    fn all_layers(&self) -> &AllLayers {
        self.all.get_or_init(|| AllLayers::new((self.read)()))
    }

    /// Returns the nearest end or turn marker on another layer, whether or not that layer belongs to a path. It is searched where the path stops and
    /// where a segment that was not reached begins.
    fn nearest_end(&self, path: &PathName, language: &Language, problem: &Diagnostic) -> Option<(Note, f64)> {
        let begin = match problem.argument("point") {
            Some(Value::Point(point)) if problem.code() != Code::NothingContinues => Some(*point),
            _ => None,
        };
        let points = problem.place.point.into_iter().chain(begin);
        let points = points.map(|Point { x: Number(x), y: Number(y) }| Xy::new(x, y));
        let is_other = |layer: &str| {
            language.path_pattern.layer(layer).is_none_or(|layer| layer.path != *path)
                && is_drawn_for_paths(language, layer)
        };
        let near = points.flat_map(|point| {
            let near = self.all_layers().near(point, MAX_HINT_DISTANCE);
            near.filter(|(layer, _)| is_other(layer)).map(move |(layer, entity)| (layer, entity, point))
        });
        let ends = near.flat_map(|(layer, entity, point)| {
            let marker = Some(entity).filter(|entity| {
                problem.code() == Code::NothingContinues && is_phantom_circle(language, entity, TURN_RADIUS)
            });
            let marker = marker.and_then(|entity| centre_of(&entity.geometry));
            let ends = ends_of(&entity.geometry).into_iter().flatten();
            ends.chain(marker).map(move |end| (layer, entity, end, (end - point).norm()))
        });
        let (layer, entity, end, distance) =
            ends.reduce(|best, other| if other.3 < best.3 { other } else { best })?;
        let mut arguments = vec![
            ("layer", Value::quoted(layer)),
            ("point", Point::new(end.x, end.y).into()),
            ("distance", distance.into()),
        ];
        let message = if centre_of(&entity.geometry).is_some() {
            &paths::TURN_MARKER_ON_OTHER_LAYER
        } else {
            arguments.push(("element", Value::quoted(entity.kind.name())));
            &paths::END_ON_OTHER_LAYER
        };
        (distance <= MAX_HINT_DISTANCE).then_some((Note { message, arguments }, distance))
    }

    /// Returns a start or end marker on a layer without a path.
    fn nearest_marker(
        &self,
        language: &Language,
        problem: &Diagnostic,
        which: usize,
        message: &'static Message,
    ) -> Option<(Note, f64)> {
        // There is already a note about another circle.
        if problem.notes.iter().any(|note| note.message != &drawing::START_TEXT) {
            return None;
        }
        let markers = self.markers.get_or_init(|| {
            MARKER_RADII.map(|radius| {
                let mut entities = self.all_layers().entities();
                entities.position(|(layer, entity)| is_marker(language, layer, entity, radius))
            })
        });
        let (layer, entity) = self.all_layers().entity(markers[which]?)?;
        let centre = centre_of(&entity.geometry)?;
        let point = Point::new(centre.x, centre.y).into();
        Some((Note { message, arguments: vec![("layer", Value::quoted(layer)), ("point", point)] }, 0.0))
    }

    /// Returns the element on another layer that is nearest to a text.
    fn nearest_element(&self, language: &Language, problem: &Diagnostic) -> Option<(Note, f64)> {
        let (Some(Value::Point(centre)), Some(Value::Number(Number(diameter)))) =
            (problem.argument("centre"), problem.argument("diameter"))
        else {
            return None;
        };
        if problem.notes.iter().any(|note| note.message == &drawing::ELEMENT_ON_OTHER_LAYER) {
            return None;
        }
        let text = TextCircle { centre: Xy::new(centre.x.0, centre.y.0), radius: diameter / 2.0 };
        let own = problem.place.layer.as_deref();
        let near = self.all_layers().near(text.centre, text.radius + MAX_HINT_DISTANCE);
        let others = near.filter(|(layer, _)| Some(*layer) != own && is_drawn_for_paths(language, layer));
        let distances = others
            .filter_map(|(layer, entity)| Some((layer, entity, distance_to_text(&text, &entity.geometry)?)));
        let (layer, entity, gap) =
            distances.reduce(|best, other| if other.2 < best.2 { other } else { best })?;
        let arguments = vec![
            ("layer", Value::quoted(layer)),
            ("element", Value::quoted(entity.kind.name())),
            ("distance", gap.into()),
        ];
        (gap <= MAX_HINT_DISTANCE)
            .then_some((Note { message: &drawing::NEAR_ON_OTHER_LAYER, arguments }, gap))
    }
}

impl LayerHints<'_> {
    /// Returns a text with O and T on another layer that lies on a start marker without a text.
    fn start_text(&self, problem: &Diagnostic) -> Option<(Note, f64)> {
        let Point { x: Number(x), y: Number(y) } = problem.place.point?;
        let at = Xy::new(x, y);
        let is_of_start = |string: &str| {
            let texts = ParameterTexts::from(string);
            let has = |letter| texts.first().is_some_and(|text| text.piece(letter).is_some());
            has(Letter::O) && has(Letter::T) && !has(Letter::Embed)
        };
        let touches = |circle: &TextCircle| (circle.centre - at).norm() < circle.radius + START_RADIUS;
        let texts = self.all_layers().texts_near(at, START_RADIUS);
        let others = texts.filter(|(layer, ..)| Some(*layer) != problem.place.layer.as_deref());
        let mut found = others.filter(|(_, circle, string)| touches(circle) && is_of_start(string));
        let (layer, _, string) = found.next()?;
        Some((text_note(&drawing::START_TEXT_ON_OTHER_LAYER, layer, string), 0.0))
    }

    /// Returns a text with a path's name that touches a subpath without a name: on another layer, or belonging to another element.
    fn name_text(&self, language: &Language, problem: &Diagnostic) -> Option<Note> {
        let Point { x: Number(x), y: Number(y) } = problem.place.point?;
        let (start, own) = (Xy::new(x, y), problem.place.layer.as_deref());
        let is_subpath = |(layer, entity): &(&str, &Entity)| {
            Some(*layer) == own
                && LineType::of(&entity.line_type, &language.line_types) == Some(LineType::Dashdot)
                && ends_of(&entity.geometry).is_some_and(|[begin, _]| coincide(begin, start))
        };
        let (_, segment) = self.all_layers().near(start, MAX_HINT_DISTANCE).find(is_subpath)?;
        let names = self.all_layers().texts_in(box_of(&segment.geometry)?);
        let mut names = names.filter(|(_, circle, string)| {
            string.trim_start().starts_with('>')
                && distance_to_text(circle, &segment.geometry).is_some_and(|gap| gap <= 0.0)
        });
        let (layer, _, string) = names.next()?;
        let is_own = Some(layer) == own;
        let message = if is_own { &drawing::NAME_OF_OTHER_ELEMENT } else { &drawing::NAME_ON_OTHER_LAYER };
        Some(text_note(message, layer, string))
    }
}

fn text_note(message: &'static Message, layer: &str, string: &str) -> Note {
    let text = Value::quoted(string.replace('\n', " "));
    Note { message, arguments: vec![("layer", Value::quoted(layer)), ("text", text)] }
}

impl AllLayers {
    fn new(drawing: Drawing) -> Self {
        let boxes = drawing.entities.iter().zip(0..).filter_map(|(entity, index)| {
            Some(GeomWithData::new(Rectangle::from_aabb(box_of(&entity.geometry)?), index))
        });
        let boxes = RTree::bulk_load(boxes.collect());
        Self { drawing, boxes }
    }

    fn entities(&self) -> impl Iterator<Item = (&str, &Entity)> {
        (0..self.drawing.entities.len()).filter_map(|index| self.entity(index))
    }

    fn entity(&self, index: usize) -> Option<(&str, &Entity)> {
        let entity = self.drawing.entities.get(index)?;
        Some((&self.drawing.layers[entity.layer as usize].name, entity))
    }

    /// Returns the entities with bounding boxes within a distance of a point, in file order.
    fn near(&self, point: Xy, distance: f64) -> impl Iterator<Item = (&str, &Entity)> {
        self.touching(square(point, distance))
    }

    fn touching(&self, searched: AABB<[f64; 2]>) -> impl Iterator<Item = (&str, &Entity)> {
        let mut found: Vec<usize> =
            self.boxes.locate_in_envelope_intersecting(searched).map(|found| found.data).collect();
        found.sort_unstable();
        found.into_iter().filter_map(|index| self.entity(index))
    }

    /// Returns the texts with bounding boxes within a distance of a point, each with its layer and its circle.
    fn texts_near(&self, point: Xy, distance: f64) -> impl Iterator<Item = (&str, TextCircle, &str)> {
        self.texts_in(square(point, distance))
    }

    fn texts_in(&self, searched: AABB<[f64; 2]>) -> impl Iterator<Item = (&str, TextCircle, &str)> {
        self.touching(searched).filter_map(|(layer, entity)| {
            AnyText::of(&entity.geometry).map(|text| (layer, text.circle(), text.string()))
        })
    }
}

/// Whether a layer shows neither parts nor clamps.
fn is_drawn_for_paths(language: &Language, layer: &str) -> bool {
    !language.is_part(layer) && !language.is_keep_out(layer)
}

/// Whether an entity is a marker of this radius on a layer without a path.
fn is_marker(language: &Language, layer: &str, entity: &Entity, radius: f64) -> bool {
    is_phantom_circle(language, entity, radius) && language.path_pattern.layer(layer).is_none()
}

fn is_phantom_circle(language: &Language, entity: &Entity, radius: f64) -> bool {
    let Geometry::Circle(circle) = &entity.geometry else { return false };
    near(circle.radius, radius)
        && LineType::of(&entity.line_type, &language.line_types) == Some(LineType::Phantom)
}

fn centre_of(geometry: &Geometry) -> Option<Xy> {
    let Geometry::Circle(circle) = geometry else { return None };
    Some(Xy::new(circle.centre.x, circle.centre.y))
}

/// Returns the distance in mm that a note gives.
fn distance_of(note: &Note) -> Option<f64> {
    Some(note.argument("distance")?.number()?.0)
}

/// Radii of the start and the end marker in mm.
const MARKER_RADII: [f64; 2] = [START_RADIUS, END_RADIUS];
const START_MARKER: usize = 0;
const END_MARKER: usize = 1;

/// Returns the distance of an element from the circle of a text; `None` for texts.
fn distance_to_text(text: &TextCircle, geometry: &Geometry) -> Option<f64> {
    Shape::of(geometry).map(|shape| text.gap_to(&shape))
}

/// Returns the box around a circle.
fn square(centre: Xy, radius: f64) -> AABB<[f64; 2]> {
    Shape::Circle { centre, radius }.extent(0.0)
}

/// Returns the bounding box of an entity; a text gets that of its circle.
fn box_of(geometry: &Geometry) -> Option<AABB<[f64; 2]>> {
    let of_text = || AnyText::of(geometry).map(AnyText::circle);
    let shape = Shape::of(geometry).map(|shape| shape.extent(0.0));
    shape.or_else(|| of_text().map(|circle| square(circle.centre, circle.radius)))
}

fn ends_of(geometry: &Geometry) -> Option<[Xy; 2]> {
    match Shape::of(geometry)? {
        Shape::Curve(curve) => Some([curve.start(), curve.end()]),
        Shape::Circle { .. } => None,
    }
}
