//! The surroundings of the path in a typical drawing: a frame with a title block, a parts list, the part itself with holes, centre lines,
//! hatching and dimensions, and screws as blocks. None of it is on a path layer, and the same seed gives the same result.

mod frame;
mod part;
mod size;

use std::sync::{Arc, OnceLock};

use crate::random::Random;
use pathbuild_draw::model::{Entity, Layer, LineEnds, Point, Shape, Version};
use pathbuild_draw::{Block, Draft, DrawError, Sheet, Template};

/// Minimum size of a drawing in bytes of ASCII with CRLF in R2000, and the range above it.
const LEAST: usize = 38_500;
const SPAN: usize = 8_000;

/// Number of variants of furniture.
const VARIANTS: usize = 16;

/// Maximum number of hatch lines. Large paths get fewer.
const HATCH_LINES: usize = 160;

/// Cache of written furniture, since even a library of thousands of drawings uses only a few variants.
static KEPT: [[OnceLock<Arc<Template>>; VARIANTS]; Version::ALL.len()] =
    [const { [const { OnceLock::new() }; VARIANTS] }; Version::ALL.len()];

/// Finishes a drawing with the furniture of a seed, padded to a typical size.
///
/// # Errors
/// The errors of [`Draft::finish`].
pub(crate) fn finish(mut draft: Draft, seed: Option<u64>) -> Result<Sheet, Vec<DrawError>> {
    let Some(seed) = seed else { return draft.finish() };
    add_layers(&mut draft);
    let sheet = draft.finish()?;
    let mut random = Random::new(seed, 1);
    let variant = random.below(VARIANTS);
    let room = Room::of(variant);
    let blocks: Vec<&Block> = sheet.blocks().iter().chain(&room.blocks).collect();
    let inner = blocks.iter().flat_map(|block| &block.entities);
    let all = sheet.entities().iter().chain(&room.entities).chain(inner);
    let size = size::estimate(sheet.layers().len(), blocks.len(), all);
    let target = LEAST + random.below(SPAN);
    // The estimate assumes CRLF: with one byte less per line, more lines are needed for the same size.
    let target = if sheet.options().line_ends == LineEnds::CrLf { target } else { target * 20 / 17 };
    let hatch_lines = (target.saturating_sub(size) / size::HATCH_LINE).min(HATCH_LINES);
    let version = sheet.options().version;
    let template = KEPT[version as usize][variant].get_or_init(|| Arc::new(template(variant, version)));
    Ok(sheet.within(Arc::clone(template), HATCH_LINES - hatch_lines))
}

/// The furniture alone, with all hatch lines as its last entities. Entities are in the order in which a user draws: the frame first, then
/// the path, then what was added to it.
fn template(variant: usize, version: Version) -> Template {
    let mut room = Room::of(variant);
    part::hatch(&mut room);
    let mut draft = Draft::new();
    draft.options.version = version;
    add_layers(&mut draft);
    draft.blocks = room.blocks;
    draft.entities = room.entities;
    if version < Version::R13 {
        draft.entities.retain(|entity| !matches!(entity.shape, Shape::MText(_)));
    }
    let early = (draft.entities.len() - HATCH_LINES) / 3;
    let sheet =
        draft.finish().unwrap_or_else(|errors| unreachable!("the furniture has a fault: {}", errors[0]));
    Template::new(&sheet, early)
}

fn add_layers(draft: &mut Draft) {
    for (name, line_type, colour) in LAYERS {
        if !draft.layers.iter().any(|known| known.name.eq_ignore_ascii_case(name)) {
            draft.layers.push(Layer { line_type: line_type.to_owned(), colour, ..Layer::new(name) });
        }
    }
}

/// The layers with their line types and colours.
const LAYERS: [(&str, &str, u8); 9] = [
    (FRAME, "CONTINUOUS", 8),
    (TITLE, "CONTINUOUS", 7),
    (LIST, "CONTINUOUS", 7),
    (OUTLINE, "CONTINUOUS", 3),
    (HIDDEN, "HIDDEN", 2),
    (CENTRE, "DASHDOT", 1),
    (HATCH, "CONTINUOUS", 9),
    (MEASURES, "CONTINUOUS", 4),
    (NOTES, "DASHED", 6),
];

const FRAME: &str = "RAHMEN";
const TITLE: &str = "SCHRIFTFELD";
const LIST: &str = "STÜCKLISTE";
const OUTLINE: &str = "KONTUR";
const HIDDEN: &str = "VERDECKT";
const CENTRE: &str = "MITTELLINIEN";
const HATCH: &str = "SCHRAFFUR";
const MEASURES: &str = "MAßE";
const NOTES: &str = "HINWEISE 1-4";

/// The furniture under construction.
struct Room {
    random: Random,
    entities: Vec<Entity>,
    blocks: Vec<Block>,
}

impl Room {
    fn of(variant: usize) -> Self {
        let mut room =
            Self { random: Random::new(variant as u64, 2), entities: Vec::new(), blocks: Vec::new() };
        frame::draw(&mut room);
        part::draw(&mut room);
        room
    }

    fn add(&mut self, entity: Entity, layer: &str) {
        self.entities.push(by_layer(entity, layer));
    }

    fn line(&mut self, from: Point, to: Point, layer: &str) {
        self.add(Entity::line(from, to), layer);
    }

    fn rectangle(&mut self, low: Point, high: Point, layer: &str) {
        let corners = [low, Point::new(high.x, low.y), high, Point::new(low.x, high.y)];
        for (index, corner) in corners.iter().enumerate() {
            self.line(*corner, corners[(index + 1) % 4], layer);
        }
    }
}

/// An entity with BYLAYER colour and line type, like nearly all entities of CAD programs.
fn by_layer(entity: Entity, layer: &str) -> Entity {
    Entity { layer: Some(layer.to_owned()), line_type: None, ..entity }
}
