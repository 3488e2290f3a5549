//! Builds scenes from the elements drawn on the layers of a path.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::{ptr, sync};

use pathbuild_diagnostic::{ElementId, EntityKind};
use pathbuild_dxf::{Drawing, Entity, Geometry};
use pathbuild_path::{
    Arc, AssignedText, Curve, END_RADIUS, ElementParameters, Marker, PROBE_RADIUS,
    Parameter as InForceParameter, PlacedPart, Placement, Position, RawPath, Role, START_RADIUS,
    Shape as DrawnShape, SourceMap, TURN_RADIUS, TextCircle, Xy, as_seen,
};

use super::corners;
use crate::scene::{
    ArcShape, Element, ElementKind, EmbeddedPath, FinishedPart, KeepOut, Label, LeftoverMaterial, OtherShape,
    Parameter, Point, ScenePath, Shape,
};

/// Everything needed to show a path as drawn: its elements and texts, and the parameters in force.
#[derive(Clone, Copy, Debug)]
pub struct DrawnSource<'a> {
    /// Display name of the drawing that contains the path.
    pub file: &'a str,
    /// Elements of the path as read from the drawing.
    pub raw: &'a RawPath,
    /// Positions of the elements in the drawing's file.
    pub positions: &'a SourceMap,
    /// All texts of the drawing, including those of other paths.
    pub texts: &'a [AssignedText],
    /// Effective parameters of each element.
    pub parameters: &'a [ElementParameters],
}

impl DrawnSource<'_> {
    /// Returns the number of elements and markers.
    pub(super) fn elements(&self) -> usize {
        let raw = self.raw;
        let ends = [&raw.start, &raw.end].into_iter().flatten().count();
        raw.drawn.elements.len() + raw.unclear_curves().len() + ends + raw.turns.len() + raw.probes.len()
    }
}

/// Returns a path without a program: only the drawn elements, in the coordinates of the drawing.
pub fn drawn_path(source: &DrawnSource<'_>) -> ScenePath {
    let mut scene = ScenePath {
        name: source.raw.name.as_str().to_owned(),
        file: source.file.to_owned(),
        ..ScenePath::default()
    };
    let placement = Placement::from_origin(Xy::origin());
    let end = |marker: &Option<Marker>| marker.as_ref().map_or(Xy::origin(), |marker| marker.at);
    let ends = [end(&source.raw.start), end(&source.raw.end)].map(pair);
    scene.embedded.push(EmbeddedPath {
        name: scene.name.clone(),
        file: scene.file.clone(),
        by: None,
        ends,
        raised: 0.0,
        thickness: 0.0,
        sweep_height: 0.0,
        material: None,
    });
    scene.tool = source.raw.tool();
    scene.draw(source, &placement);
    scene
}

impl ScenePath {
    /// Adds the elements of the path that was last added to [`ScenePath::embedded`]. Returns the index of the first one.
    pub(super) fn draw(&mut self, source: &DrawnSource<'_>, placement: &Placement) -> u32 {
        let path = number(self.embedded.len()).saturating_sub(1);
        let first = self.elements.len();
        let in_force = source
            .parameters
            .iter()
            .map(|parameters| (parameters.origin.id, &*parameters.parameters))
            .collect();
        let own = |text: &&AssignedText| text.path == *source.raw.name;
        let texts = || source.texts.iter().filter(own);
        let lines = texts().flat_map(|text| &text.elements).map(|element| element.position.line);
        let with_text = lines.map(|line| (line, Vec::new())).collect();
        let last = (&[][..], sync::Arc::default());
        let mut drawn = ElementBuilder { source, placement, path, in_force, last, with_text };
        drawn.add_elements(&mut self.elements);
        self.texts.extend(texts().map(|text| drawn.label(text)));
        number(first)
    }
}

/// The shapes of elements with texts as drawn, each with its index in [`ScenePath::elements`], by the lines at which their entities begin in the
/// file. A polyline is one entity with several elements.
type ShapesByLine = HashMap<u32, Vec<(u32, DrawnShape)>>;

struct ElementBuilder<'a> {
    source: &'a DrawnSource<'a>,
    placement: &'a Placement,
    path: u32,
    in_force: BTreeMap<ElementId, &'a [InForceParameter]>,
    /// The parameters of the previous element, and their form in the scene, which the next element shares if it has the same ones.
    last: (&'a [InForceParameter], sync::Arc<[Parameter]>),
    with_text: ShapesByLine,
}

impl ElementBuilder<'_> {
    fn add_elements(&mut self, elements: &mut Vec<Element>) {
        let raw = self.source.raw;
        for element in &raw.drawn.elements {
            let origin = raw.drawn.origin(element);
            let kind = element_kind(element.role);
            self.add(elements, kind, &origin, element.shape);
        }
        for element in raw.unclear_curves() {
            self.add(elements, ElementKind::Unclear, &raw.drawn.origin(element), element.shape);
        }
        let circle = |marker: &Marker, radius| DrawnShape::Circle { centre: marker.at, radius };
        let groups: [(&[Marker], ElementKind, f64); 4] = [
            (raw.start.as_slice(), ElementKind::Start, START_RADIUS),
            (raw.end.as_slice(), ElementKind::End, END_RADIUS),
            (&raw.turns, ElementKind::Turn, TURN_RADIUS),
            (&raw.probes, ElementKind::Probe, PROBE_RADIUS),
        ];
        for (markers, kind, radius) in groups {
            for marker in markers {
                self.add(elements, kind, &marker.origin, circle(marker, radius));
            }
        }
    }

    fn add(
        &mut self,
        elements: &mut Vec<Element>,
        kind: ElementKind,
        origin: &pathbuild_path::Origin,
        shape: DrawnShape,
    ) {
        let position = self.position(origin.id);
        if let Some(shapes) = position.and_then(|position| self.with_text.get_mut(&position.line)) {
            shapes.push((number(elements.len()), shape));
        }
        elements.push(Element {
            path: self.path,
            kind,
            entity: origin.entity.name(),
            layer: origin.layer.to_string(),
            handle: position.and_then(|position| position.handle).map(|handle| handle.to_string()),
            line: position.map(|position| position.line),
            shape: placed_shape(&shape, self.placement),
            order: None,
            parameters: self.parameters(origin.id),
        });
    }

    /// Returns the parameters of an element. Elements that share them in the path also share them in the scene.
    fn parameters(&mut self, id: ElementId) -> sync::Arc<[Parameter]> {
        let own = self.in_force.get(&id).copied().unwrap_or_default();
        if !ptr::eq(self.last.0, own) {
            self.last = (own, own.iter().map(parameter).collect());
        }
        sync::Arc::clone(&self.last.1)
    }

    fn position(&self, id: ElementId) -> Option<Position> {
        self.source.positions.positions().get(id.0 as usize).copied()
    }

    /// Returns the label for a text, with the elements that the text belongs to.
    fn label(&self, text: &AssignedText) -> Label {
        let owners = text.elements.iter().flat_map(|owner| {
            let shapes = self.with_text.get(&owner.position.line).into_iter().flatten();
            shapes.filter(|(_, shape)| is_same(&owner.shape, shape)).map(|(index, _)| *index)
        });
        Label {
            path: self.path,
            text: shown_text(&text.text),
            at: pair(self.placement.place(text.circle.centre)),
            radius: text.circle.radius,
            height: line_height(text),
            elements: owners.collect::<BTreeSet<_>>().into_iter().collect(),
        }
    }
}

/// Returns the height in mm of a line of a text, derived from the circle of the text. For a long MTEXT, the circle is smaller than the
/// text.
fn line_height(text: &AssignedText) -> f64 {
    let shown = as_seen(&text.text);
    let longest = shown.lines().map(|line| line.chars().count()).max().unwrap_or(0).max(1);
    let (rows, letters) = (shown.lines().count().max(1) as f64, 0.6 * longest as f64);
    let by_diagonal = 2.0 * text.circle.radius / libm::hypot(rows, letters);
    let by_height = text.circle.radius / (0.7 * rows);
    if text.entity == EntityKind::MText { by_diagonal.max(by_height) } else { by_diagonal }
}

/// Returns a text as CAD programs show it, with a blank for each tab.
fn shown_text(text: &str) -> String {
    as_seen(text).trim_end().replace('\t', " ")
}

fn parameter(known: &InForceParameter) -> Parameter {
    Parameter {
        letter: known.letter.as_char(),
        value: known.value.to_string(),
        from: known.from.name(),
        which: known.from.provider_name().map(str::to_owned),
        line: None,
    }
}

/// Converts a clamp, shifted so that the given point of the drawing becomes the origin.
pub fn keep_out(clamp: &pathbuild_path::KeepOut, [x, y]: Point) -> KeepOut {
    let placement = Placement::from_origin(Xy::new(-x, -y));
    KeepOut {
        layer: clamp.layer.to_string(),
        outline: clamp.outline.iter().map(|curve| curve_shape(&placement.place_curve(curve))).collect(),
        height: clamp.height,
    }
}

/// Converts a finished part to the coordinates of the program.
pub fn finished_part(part: &PlacedPart<'_>) -> FinishedPart {
    let PlacedPart { drawn, left, corners: unreached, is_loose, radius, top, tolerance, .. } = *part;
    let shapes = |curves: &[Curve]| -> Vec<Shape> {
        curves.iter().map(|curve| curve_shape(&part.placement.place_curve(curve))).collect()
    };
    let mut lost_bars = shapes(part.lost_bars);
    lost_bars.extend(outline(&part.bars_lost_to_neighbours));
    let rings: Vec<Vec<Shape>> = drawn.rings.iter().map(|ring| shapes(&ring.curves)).collect();
    FinishedPart {
        corners: corners::unreached_corners(&rings, &shapes(unreached), radius),
        rings,
        top,
        tolerance,
        left: left
            .iter()
            .map(|left| LeftoverMaterial { outline: shapes(&left.outline), reach: left.reach })
            .collect(),
        nests: (0..drawn.rings.len()).map(|ring| drawn.nest(ring)).collect(),
        gouges: outline(&part.gouges),
        lost_bars,
        radius,
        is_loose,
    }
}

/// Converts the curves of an outline to shapes.
pub fn outline(curves: &[Curve]) -> Vec<Shape> {
    curves.iter().map(curve_shape).collect()
}

/// Whether two shapes of the same entity are equal. Circles are compared by their centres only, because the circles of markers get a fixed radius.
fn is_same(a: &DrawnShape, b: &DrawnShape) -> bool {
    match (a, b) {
        (DrawnShape::Circle { centre: a, .. }, DrawnShape::Circle { centre: b, .. }) => a == b,
        (a, b) => a == b,
    }
}

fn element_kind(role: Role) -> ElementKind {
    use pathbuild_path::Cut;
    match role {
        Role::Cut(Cut::Mill) => ElementKind::Mill,
        Role::Cut(Cut::Mark) => ElementKind::Mark,
        Role::Cut(Cut::Support) => ElementKind::Support,
        Role::Sweep | Role::SilentSweep => ElementKind::Sweep,
        Role::SkippedSubpath => ElementKind::SkippedSubpath,
        Role::Subpath => ElementKind::Subpath,
    }
}

fn placed_shape(shape: &DrawnShape, placement: &Placement) -> Shape {
    match shape {
        DrawnShape::Curve(curve) => curve_shape(&placement.place_curve(curve)),
        DrawnShape::Circle { centre, radius } => {
            Shape::Circle { centre: pair(placement.place(*centre)), radius: *radius }
        }
    }
}

pub(super) fn curve_shape(curve: &Curve) -> Shape {
    match curve {
        Curve::Line(line) => Shape::Line { from: pair(line.start), to: pair(line.end) },
        Curve::Arc(arc) => Shape::Arc(ArcShape {
            from: pair(arc.start),
            to: pair(arc.end),
            centre: pair(arc.centre),
            radius: arc.radius,
            clockwise: arc.clockwise,
            degrees: arc.degrees,
        }),
    }
}

pub(super) fn pair(point: Xy) -> Point {
    [point.x, point.y]
}

pub(super) fn number(index: usize) -> u32 {
    u32::try_from(index).unwrap_or(u32::MAX)
}

/// Returns the shapes of a drawing on layers without a path. The drawing must have been read without its path layers.
pub fn other_layers(drawing: &Drawing) -> Vec<OtherShape> {
    drawing.entities.iter().map(|entity| other_shape(drawing, entity)).collect()
}

fn other_shape(drawing: &Drawing, entity: &Entity) -> OtherShape {
    let layer = drawing.layers[entity.layer as usize].name.to_string();
    let text = |circle: TextCircle, text: &str, height, rotation| OtherShape::Text {
        layer: layer.clone(),
        text: shown_text(text),
        at: pair(circle.centre),
        height,
        rotation,
    };
    match &entity.geometry {
        Geometry::Line(line) => {
            let [from, to] = [line.start, line.end].map(|end| [end.x, end.y]);
            OtherShape::Shape { layer, shape: Shape::Line { from, to } }
        }
        Geometry::Arc(arc) => {
            let centre = Xy::new(arc.centre.x, arc.centre.y);
            let arc = Arc::from_angles(centre, arc.radius, arc.start_angle, arc.end_angle, arc.clockwise);
            OtherShape::Shape { layer, shape: curve_shape(&Curve::Arc(arc)) }
        }
        Geometry::Circle(circle) => {
            let centre = [circle.centre.x, circle.centre.y];
            OtherShape::Shape { layer, shape: Shape::Circle { centre, radius: circle.radius } }
        }
        Geometry::Text(entity) => {
            text(TextCircle::of_text(entity), &entity.string, entity.height, entity.rotation)
        }
        Geometry::MText(entity) => {
            text(TextCircle::of_mtext(entity), &entity.plain, entity.height, entity.rotation)
        }
    }
}
