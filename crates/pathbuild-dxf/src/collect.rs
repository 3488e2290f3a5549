//! Collects placed entities into the entities, faults and left-out curves of a [`Drawing`].

#![expect(
    clippy::inline_always,
    reason = "an entity is made where it ends up, without copies from function to function"
)]

use std::collections::{BTreeMap, BTreeSet, HashSet};
use std::sync::Arc;

use pathbuild_diagnostic::limits::{ENTITIES, TEXT_LENGTH, limit_error};
use pathbuild_diagnostic::messages::drawing::{
    BLOCK_MISSING, BLOCK_NESTED, BLOCK_TWICE, CURVE_WITHOUT_LENGTH, INSERTED_FROZEN, INVISIBLE,
    NOT_COMPATIBLE, TILTED, TOO_LARGE, WIDTH_IGNORED,
};
use pathbuild_diagnostic::words::{ELEMENTS_LIKE_THIS, TEXTS_LIKE_THIS};
use pathbuild_diagnostic::{Diagnostic, EntityKind, Place, Point, Value};
use smol_str::SmolStr;

use crate::entities::Shape;
use crate::faults::{EntityError, FatalError};
use crate::layers::{LayerId, LayerProperties};
use crate::names::case_folded;
use crate::placement::Placement;
use crate::shapes::Polyline;
use crate::shapes::curves::{ApproximationFailure, Tolerance};
use crate::{Circle, Drawing, Entity, Fault, Geometry, Label, Layer, OmittedCurve, Options, Origin, Point3};

pub(crate) struct Collector<'d> {
    drawing: &'d mut Drawing,
    /// Indices into [`Drawing::layers`] by folded name.
    layers: BTreeMap<SmolStr, u32>,
    /// The notes already given, with the number of entities that each is about.
    noted: BTreeMap<(u32, LayerNote), CountedNote>,
    /// The folded names of missing blocks that are inserted on layers that are not read, to report each of them once.
    missing_blocks: BTreeSet<SmolStr>,
    /// Layer of the previous entity, as a cache.
    last: Option<(LayerId, u32)>,
    /// Number of entities and faults added. Hatches and blank texts do not count, because they show nothing that could be milled.
    pub(crate) drawn: usize,
    /// Lines of broken entities and contradictory records, with the layers on which they were reported.
    faulty: HashSet<(u32, u32)>,
    /// The faults about entities that are too far from the origin, by layer.
    far: BTreeMap<u32, CountedNote>,
    groups: u32,
    has_ignored: bool,
    options: &'d Options<'d>,
}

/// A finding about entities of a layer that is reported once, for the first of them.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
enum LayerNote {
    /// An entity, or else a text, is marked invisible.
    Invisible { is_text: bool },
    /// An entity, or else a text, is in a block that is inserted on a frozen layer.
    Frozen { is_text: bool, layer: SmolStr },
    /// A polyline has a width.
    Wide,
    /// A polyline or curve is a single point.
    WithoutLength,
}

struct CountedNote {
    /// Index into [`Drawing::diagnostics`], or into [`Drawing::faults`].
    index: usize,
    /// Number of entities that the note is about.
    count: usize,
}

/// Number of entities for which memory is reserved in advance.
const RESERVED_ENTITIES: usize = 64;

/// Number of faults and left-out curves that count as one entity each. No real drawing has more, but a broken insertion repeats its fault
/// on each layer of its block, so that a few kilobytes of such insertions could take gigabytes.
const MAX_CHEAP_FAULTS: usize = 10_000;

/// Weight of each fault beyond [`MAX_CHEAP_FAULTS`]: about that many entities take the same memory.
const FAULT_WEIGHT: usize = 20;

/// An entity and its place in the drawing.
#[derive(Clone, Copy)]
pub(crate) struct PlacedEntity<'p> {
    pub(crate) kind: EntityKind,
    pub(crate) layer_id: LayerId,
    pub(crate) layer: &'p LayerProperties,
    /// The line type after resolving BYLAYER and BYBLOCK.
    pub(crate) line_type: &'p SmolStr,
    /// The entity's own place in the file, for diagnostics about it.
    pub(crate) own: Origin,
    /// The place of the outermost insertion that draws the entity, or the entity's own place.
    pub(crate) origin: Origin,
    pub(crate) is_invisible: bool,
    /// The frozen layer on which a block that contains the entity is inserted; `None` if no such block is on a frozen layer.
    pub(crate) frozen: Option<&'p SmolStr>,
    pub(crate) placement: Option<&'p Placement>,
}

impl PlacedEntity<'_> {
    /// Transforms a point from the coordinates of the entity's space to those of the drawing.
    fn point(&self, point: Point) -> Point {
        let Some(placement) = self.placement else { return point };
        let placed = placement.point(Point3 { x: point.x.0, y: point.y.0, z: 0.0 });
        Point::new(placed.x, placed.y)
    }
}

impl<'d> Collector<'d> {
    /// Creates a collector that fills this empty drawing.
    pub(crate) fn new(drawing: &'d mut Drawing, options: &'d Options<'d>) -> Self {
        drawing.entities.reserve(RESERVED_ENTITIES);
        drawing.origins.reserve(RESERVED_ENTITIES);
        Self {
            drawing,
            layers: BTreeMap::new(),
            noted: BTreeMap::new(),
            missing_blocks: BTreeSet::new(),
            last: None,
            drawn: 0,
            faulty: HashSet::new(),
            far: BTreeMap::new(),
            groups: 0,
            has_ignored: false,
            options,
        }
    }

    /// Adds an entity with this shape, or records the fault if the shape is an error.
    #[inline(always)]
    pub(crate) fn add(
        &mut self,
        placed: &PlacedEntity<'_>,
        shape: Result<Shape<'_>, EntityError<'_>>,
    ) -> Result<(), FatalError> {
        let layer = self.layer(placed);
        self.drawn += usize::from(!matches!(&shape, Ok(Shape::Plain(geometry)) if geometry.is_blank()));
        if let Some(trouble) = placed.layer.fault() {
            self.refuse(placed, layer, &trouble)?;
        }
        if placed.is_invisible && shape.is_ok() {
            self.note_hidden(placed, layer, None);
        }
        if let Some(frozen) = placed.frozen.filter(|_| shape.is_ok() && !placed.layer.hidden) {
            self.note_hidden(placed, layer, Some(frozen));
        }
        match shape {
            Ok(Shape::Plain(mut geometry)) => {
                if let Some(placement) = placed.placement {
                    placement.apply(&mut geometry);
                }
                if !geometry.is_sound() {
                    return self.refuse(placed, layer, &EntityError::TooLarge);
                }
                self.push(placed, layer, None, geometry)
            }
            Ok(shape) => self.add_parts(placed, layer, shape),
            Err(trouble) => self.refuse(placed, layer, &trouble),
        }
    }

    fn add_parts(
        &mut self,
        placed: &PlacedEntity<'_>,
        layer: u32,
        shape: Shape<'_>,
    ) -> Result<(), FatalError> {
        let placement = placed.placement.unwrap_or(&Placement::IDENTITY);
        let tolerance =
            Tolerance { distance: self.options.approximate_curves, most_pieces: self.options.max_entities };
        let parts = match shape {
            Shape::Polyline(Polyline { mut pieces, is_wide }) => {
                if is_wide {
                    self.note(placed, layer, LayerNote::Wide, Diagnostic::new(&WIDTH_IGNORED));
                }
                for piece in &mut pieces {
                    placement.apply(piece);
                }
                Ok(pieces)
            }
            Shape::Ellipse(ellipse) => ellipse.pieces(placement, tolerance),
            Shape::Spline(spline) => spline.pieces(placement, tolerance),
            Shape::Plain(_) | Shape::Insert(_) | Shape::Hatch(_) | Shape::Label(_) => Ok(Vec::new()),
        };
        let parts = match parts {
            Ok(parts) if parts.iter().all(Geometry::is_sound) => parts,
            Ok(_) | Err(ApproximationFailure::TooFar) => {
                return self.refuse(placed, layer, &EntityError::TooLarge);
            }
            Err(ApproximationFailure::TooMany) => return Err(self.entity_limit_error()),
        };
        if parts.is_empty() {
            let problem = Diagnostic::new(&CURVE_WITHOUT_LENGTH);
            self.note(placed, layer, LayerNote::WithoutLength, problem);
        }
        let group = Some(self.groups);
        self.groups += 1;
        parts.into_iter().try_for_each(|part| self.push(placed, layer, group, part))
    }

    #[inline(always)]
    fn push(
        &mut self,
        placed: &PlacedEntity<'_>,
        layer: u32,
        group: Option<u32>,
        geometry: Geometry,
    ) -> Result<(), FatalError> {
        self.count()?;
        let line_type = placed.line_type.clone();
        self.drawing.origins.push(placed.origin);
        let is_mirrored = placed.placement.is_some_and(Placement::is_mirrored);
        let entity = Entity { layer, line_type, kind: placed.kind, group, is_mirrored, geometry };
        self.drawing.entities.push(entity);
        Ok(())
    }

    /// Records a fault of an entity. Copies of a block repeat the same fault, which is reported once.
    fn refuse(
        &mut self,
        placed: &PlacedEntity<'_>,
        layer: u32,
        trouble: &EntityError<'_>,
    ) -> Result<(), FatalError> {
        let diagnostic = match trouble {
            EntityError::Group(group) => group.diagnostic(placed.kind),
            EntityError::Tilted => Diagnostic::new(&TILTED).quoting("entity", placed.kind.name()),
            EntityError::TooLarge => Diagnostic::new(&TOO_LARGE).quoting("entity", placed.kind.name()),
            EntityError::DefinedTwice(block) => Diagnostic::new(&BLOCK_TWICE).quoting("block", &**block),
            EntityError::Layer(problem) => (**problem).clone(),
            EntityError::Nested(block) => Diagnostic::new(&BLOCK_NESTED).quoting("block", &**block),
            EntityError::LeftOut { message, point, block, layers } => {
                self.count()?;
                let problem = Diagnostic::new(message).quoting("entity", placed.kind.name());
                self.omit(placed, layer, *point, with_block(problem, block.as_deref(), layers), layers);
                return Ok(());
            }
            EntityError::TooManyParts => return Err(self.entity_limit_error()),
            EntityError::TextTooLong => {
                let diagnostic = limit_error(&TEXT_LENGTH, self.options.max_text, "text-length");
                return Err(Box::new(self.located(diagnostic, placed, layer)));
            }
        };
        let line = match trouble {
            EntityError::Layer(problem) => problem.place.line.unwrap_or_default(),
            _ => placed.own.line,
        };
        if self.faulty.insert((line, layer)) {
            self.count()?;
            // A drawing far from the origin has this fault everywhere.
            if let EntityError::TooLarge = trouble {
                let index = self.drawing.faults.len();
                let far = self.far.entry(layer).or_insert(CountedNote { index, count: 0 });
                far.count += 1;
                if far.count > 1 {
                    return Ok(());
                }
            }
            let diagnostic = self.located(diagnostic, placed, layer);
            self.drawing.faults.push(Fault { layer, diagnostic });
        }
        Ok(())
    }

    fn omit(
        &mut self,
        placed: &PlacedEntity<'_>,
        layer: u32,
        point: Option<Point>,
        mut diagnostic: Diagnostic,
        layers: &Arc<[SmolStr]>,
    ) {
        let point = point.map(|point| placed.point(point));
        diagnostic.place.point = point;
        let diagnostic = self.located(diagnostic, placed, layer);
        let (kind, layers) = (placed.kind, layers.clone());
        self.drawing.left_out.push(OmittedCurve { layer, kind, point, layers, diagnostic });
    }

    /// Records a hatch. It does not count as an entity of its layer.
    pub(crate) fn add_hatch(
        &mut self,
        placed: &PlacedEntity<'_>,
        point: Option<Point>,
    ) -> Result<(), FatalError> {
        self.count()?;
        self.drawing.hatches.push(place_of(placed, point));
        Ok(())
    }

    /// Records the text of a multileader or dimension, unless it is invisible. It does not count as an entity of its layer.
    pub(crate) fn add_label(
        &mut self,
        placed: &PlacedEntity<'_>,
        text: SmolStr,
        tip: Circle,
    ) -> Result<(), FatalError> {
        if placed.is_invisible {
            return Ok(());
        }
        self.count()?;
        let place = place_of(placed, Some(Point::new(tip.centre.x, tip.centre.y)));
        let mut tip = Geometry::Circle(tip);
        if let Some(placement) = placed.placement {
            placement.apply(&mut tip);
        }
        if let Geometry::Circle(tip) = tip {
            let layer = self.layer(placed);
            self.drawing.labels.push(Label { layer, text, tip, place });
        }
        Ok(())
    }

    /// Skips an entity that PathDxf2GCode does not know, in compatible mode. This is reported once per drawing.
    pub(crate) fn ignore(&mut self, placed: &PlacedEntity<'_>) {
        let layer = self.layer(placed);
        if !std::mem::replace(&mut self.has_ignored, true) {
            let diagnostic = Diagnostic::new(&NOT_COMPATIBLE).quoting("entity", placed.kind.name());
            let diagnostic = self.located(diagnostic, placed, layer);
            self.drawing.diagnostics.push(diagnostic);
        }
    }

    /// Reports a missing block that is inserted on a layer that is not read: the block may draw on layers that are read.
    pub(crate) fn note_missing_block(
        &mut self,
        placed: &PlacedEntity<'_>,
        block: &str,
        point: Option<Point>,
    ) {
        if self.missing_blocks.insert(case_folded(block)) {
            let mut diagnostic = Diagnostic::new(&BLOCK_MISSING).quoting("block", block);
            diagnostic.place = place_of(placed, point);
            self.drawing.diagnostics.push(diagnostic);
        }
    }

    /// Reports an entity, or only counts it if another entity of its layer was reported for the same reason.
    fn note(&mut self, placed: &PlacedEntity<'_>, layer: u32, note: LayerNote, problem: Diagnostic) {
        let index = self.drawing.diagnostics.len();
        let note = self.noted.entry((layer, note)).or_insert(CountedNote { index, count: 0 });
        note.count += 1;
        if note.count == 1 {
            let diagnostic = self.located(problem.quoting("entity", placed.kind.name()), placed, layer);
            self.drawing.diagnostics.push(diagnostic);
        }
    }

    /// Reports an entity that is invisible, or that is in a block inserted on a frozen layer. Texts are reported separately from elements, because a
    /// text that the user does not see may still change a visible element.
    fn note_hidden(&mut self, placed: &PlacedEntity<'_>, layer: u32, frozen: Option<&SmolStr>) {
        let is_text = matches!(placed.kind, EntityKind::Text | EntityKind::MText);
        let (note, problem) = match frozen {
            Some(frozen) => (
                LayerNote::Frozen { is_text, layer: frozen.clone() },
                Diagnostic::new(&INSERTED_FROZEN).quoting("layer", frozen),
            ),
            None => (LayerNote::Invisible { is_text }, Diagnostic::new(&INVISIBLE)),
        };
        let alike = if is_text { &TEXTS_LIKE_THIS } else { &ELEMENTS_LIKE_THIS };
        self.note(placed, layer, note, problem.with("alike", alike));
    }

    /// Fills in the number of entities that each note is about.
    pub(crate) fn fill_in_counts(&mut self) {
        for note in std::mem::take(&mut self.noted).into_values() {
            self.drawing.diagnostics[note.index].arguments.push(("count", note.count.into()));
        }
        for far in std::mem::take(&mut self.far).into_values() {
            self.drawing.faults[far.index].diagnostic.arguments.push(("count", far.count.into()));
        }
    }

    /// Fills in the entity's place. A line that the diagnostic already has is kept: it is the line of the faulty value.
    fn located(&self, mut diagnostic: Diagnostic, placed: &PlacedEntity<'_>, layer: u32) -> Diagnostic {
        let place = &mut diagnostic.place;
        place.line = place.line.or(Some(placed.own.line));
        place.handle = placed.own.handle;
        place.entity = Some(placed.kind);
        place.layer = Some(self.drawing.layers[layer as usize].name.clone());
        diagnostic
    }

    /// Returns the index of the entity's layer in [`Drawing::layers`].
    #[inline]
    fn layer(&mut self, placed: &PlacedEntity<'_>) -> u32 {
        if let Some((id, layer)) = self.last
            && id == placed.layer_id
        {
            return layer;
        }
        let used = placed.layer;
        let layer = self.layers.get(&used.folded).copied().unwrap_or_else(|| self.new_layer(used));
        self.drawing.layers[layer as usize].hidden |= used.hidden;
        self.last = Some((placed.layer_id, layer));
        layer
    }

    fn new_layer(&mut self, used: &LayerProperties) -> u32 {
        let layer = u32::try_from(self.drawing.layers.len()).unwrap_or(u32::MAX);
        self.layers.insert(used.folded.clone(), layer);
        self.drawing.layers.push(Layer { name: used.name.as_str().into(), hidden: used.hidden });
        layer
    }

    /// Checks that the limit allows one more entity, fault or left-out curve.
    #[inline]
    fn count(&self) -> Result<(), FatalError> {
        let drawing = &self.drawing;
        let troubles = drawing.faults.len() + drawing.left_out.len();
        let surcharge = (FAULT_WEIGHT - 1) * troubles.saturating_sub(MAX_CHEAP_FAULTS);
        if drawing.entities.len() + drawing.hatches.len() + drawing.labels.len() + troubles + surcharge
            < self.options.max_entities
        {
            return Ok(());
        }
        Err(self.entity_limit_error())
    }

    #[cold]
    fn entity_limit_error(&self) -> FatalError {
        too_many_entities(self.options.max_entities)
    }
}

/// Returns the place of an entity. `point` is in the coordinates of the entity's space.
fn place_of(placed: &PlacedEntity<'_>, point: Option<Point>) -> Place {
    Place {
        line: Some(placed.own.line),
        handle: placed.own.handle,
        entity: Some(placed.kind),
        layer: Some(placed.layer.name.as_str().into()),
        point: point.map(|point| placed.point(point)),
        ..Place::default()
    }
}

/// Maximum number of layers of a block's contents that a message lists.
const MAX_LISTED_LAYERS: usize = 3;

/// Adds a block to a problem: its name, and the layers of its contents.
fn with_block(mut problem: Diagnostic, block: Option<&str>, layers: &[SmolStr]) -> Diagnostic {
    problem.arguments.extend(block.map(|block| ("block", Value::quoted(block))));
    if layers.is_empty() {
        return problem;
    }
    problem.with("layers", layers.iter().take(MAX_LISTED_LAYERS).map(SmolStr::to_string).collect::<Value>())
}

#[cold]
pub(crate) fn too_many_entities(most: usize) -> FatalError {
    Box::new(limit_error(&ENTITIES, most, "entities"))
}
