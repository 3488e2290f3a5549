//! Items to the entities, faults and left-out curves of a [`Drawing`].

use std::collections::HashMap;

use pathbuild_diagnostic::messages::files::LIMIT;
use pathbuild_diagnostic::messages::reading::INVISIBLE;
use pathbuild_diagnostic::{Diagnostic, Message, Point, Word};

use crate::item::{Item, Shape, Traits};
use crate::layers::{CONTINUOUS, Layers, UsedLayer};
use crate::line_types::{LineType, LineTypes};
use crate::placement::Placement;
use crate::trouble::{Trouble, tilted};
use crate::{Drawing, Entity, Fault, Geometry, Layer, LeftOut};

/// Gathers a drawing.
pub(crate) struct Collector {
    drawing: Drawing,
    /// Numbers of [`Drawing::layers`] by folded name.
    layers: HashMap<Box<str>, u32>,
    /// For each of them, whether an invisible entity was found.
    has_invisible: Vec<bool>,
    /// The layer that the last item was on.
    last: Option<(crate::layers::LayerId, u32)>,
    groups: u32,
    limits: Limits,
}

/// The configured limits.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Limits {
    pub(crate) entities: usize,
    pub(crate) text: usize,
}

/// Names that items refer to by number.
pub(crate) struct Names<'b, 'a, 'o> {
    pub(crate) layers: &'b Layers<'a, 'o>,
    pub(crate) line_types: &'b LineTypes<'a>,
}

impl Collector {
    /// Nothing is gathered yet.
    pub(crate) fn new(limits: Limits) -> Self {
        Self {
            drawing: Drawing::default(),
            layers: HashMap::new(),
            has_invisible: Vec::new(),
            last: None,
            groups: 0,
            limits,
        }
    }

    /// What was gathered.
    pub(crate) fn finish(self) -> Drawing {
        self.drawing
    }

    /// Adds an item of model space.
    pub(crate) fn add(
        &mut self,
        item: Item<'_>,
        placement: Option<&Placement>,
        names: &Names<'_, '_, '_>,
    ) -> Result<(), Box<Diagnostic>> {
        let traits = item.traits;
        let used = names.layers.get(traits.layer);
        let layer = self.layer(&traits, used);
        if traits.is_invisible {
            self.note_invisible(&traits, layer);
        }
        match item.shape {
            Ok(Shape::Plain(geometry)) => self.push(&traits, layer, None, geometry, placement, names),
            Ok(Shape::Parts(parts)) => {
                let group = Some(self.groups);
                self.groups += 1;
                parts
                    .into_iter()
                    .try_for_each(|part| self.push(&traits, layer, group, part, placement, names))
            }
            Err(trouble) => self.refuse(&traits, layer, &trouble),
        }
    }

    fn push(
        &mut self,
        traits: &Traits,
        layer: u32,
        group: Option<u32>,
        mut geometry: Geometry,
        placement: Option<&Placement>,
        names: &Names<'_, '_, '_>,
    ) -> Result<(), Box<Diagnostic>> {
        self.count()?;
        if let Some(placement) = placement {
            placement.apply(&mut geometry);
        }
        let line_type = match traits.line_type {
            LineType::ByLayer => &names.layers.get(traits.layer).line_type,
            LineType::ByBlock => CONTINUOUS,
            LineType::Named(number) => names.line_types.name(number),
        };
        self.drawing.origins.push(traits.origin);
        self.drawing.entities.push(Entity {
            layer,
            line_type: line_type.into(),
            kind: traits.kind,
            group,
            geometry,
        });
        Ok(())
    }

    fn refuse(&mut self, traits: &Traits, layer: u32, trouble: &Trouble<'_>) -> Result<(), Box<Diagnostic>> {
        self.count()?;
        match trouble {
            Trouble::Group(group) => self.fault(traits, layer, group.diagnostic(traits.kind)),
            Trouble::Tilted => self.fault(traits, layer, tilted(traits.kind)),
            Trouble::LeftOut { message, point } => self.leave_out(traits, layer, message, *point),
            Trouble::TextTooLong => {
                let diagnostic = limit(&TEXT_LENGTH, self.limits.text, "text-length");
                return Err(Box::new(self.located(diagnostic, traits, layer)));
            }
        }
        Ok(())
    }

    fn fault(&mut self, traits: &Traits, layer: u32, diagnostic: Diagnostic) {
        let diagnostic = self.located(diagnostic, traits, layer);
        self.drawing.faults.push(Fault { layer, diagnostic });
    }

    fn leave_out(&mut self, traits: &Traits, layer: u32, message: &'static Message, point: Option<Point>) {
        let mut diagnostic = Diagnostic::new(message).with("entity", traits.kind.name());
        diagnostic.place.point = point;
        let diagnostic = self.located(diagnostic, traits, layer);
        self.drawing.left_out.push(LeftOut { layer, kind: traits.kind, point, diagnostic });
    }

    fn note_invisible(&mut self, traits: &Traits, layer: u32) {
        if !std::mem::replace(&mut self.has_invisible[layer as usize], true) {
            let diagnostic = Diagnostic::new(&INVISIBLE).with("entity", traits.kind.name());
            let diagnostic = self.located(diagnostic, traits, layer);
            self.drawing.diagnostics.push(diagnostic);
        }
    }

    /// Fills in where an entity is; a line that is there already is that of the faulty value.
    fn located(&self, mut diagnostic: Diagnostic, traits: &Traits, layer: u32) -> Diagnostic {
        let place = &mut diagnostic.place;
        place.line = place.line.or(Some(traits.origin.line));
        place.handle = traits.origin.handle;
        place.entity = Some(traits.kind);
        place.layer = Some(self.drawing.layers[layer as usize].name.clone());
        diagnostic
    }

    /// The number in the drawing of the layer that an item is on.
    #[inline]
    fn layer(&mut self, traits: &Traits, used: &UsedLayer) -> u32 {
        if let Some((id, layer)) = self.last
            && id == traits.layer
        {
            return layer;
        }
        let layer = self.layers.get(&used.folded).copied().unwrap_or_else(|| self.new_layer(used));
        self.drawing.layers[layer as usize].hidden |= used.hidden;
        self.last = Some((traits.layer, layer));
        layer
    }

    fn new_layer(&mut self, used: &UsedLayer) -> u32 {
        let layer = u32::try_from(self.drawing.layers.len()).unwrap_or(u32::MAX);
        self.layers.insert(used.folded.clone(), layer);
        self.drawing.layers.push(Layer { name: used.name.clone(), hidden: used.hidden });
        self.has_invisible.push(false);
        layer
    }

    /// Counts one more entity, or what became of it.
    #[inline]
    fn count(&self) -> Result<(), Box<Diagnostic>> {
        let drawing = &self.drawing;
        let count = drawing.entities.len() + drawing.faults.len() + drawing.left_out.len();
        if count < self.limits.entities {
            return Ok(());
        }
        let diagnostic = limit(&ENTITIES, self.limits.entities, "entities");
        Err(Box::new(diagnostic))
    }
}

static ENTITIES: Word = Word { en: "the number of entities", de: "die Zahl der Elemente" };
static TEXT_LENGTH: Word =
    Word { en: "the length of a text in bytes", de: "die Länge eines Textes in Bytes" };

fn limit(what: &'static Word, limit: usize, key: &'static str) -> Diagnostic {
    Diagnostic::new(&LIMIT).with("what", what).with("limit", limit).with("key", key)
}
