use dxf::entities::{Entity as CrateEntity, EntityType};
use dxf::enums::AcadVersion;
use dxf::tables::{AppId, DimStyle, Layer as CrateLayer, LineType, Style, ViewPort};
use dxf::{Block as CrateBlock, Color, Drawing, Handle};

use super::crate_entity::entity_type;
use super::tickets::Tickets;
use crate::model::{Entity, Layer, LayerState, Shape, Version};
use crate::sheet::Sheet;

/// Added to the index of an entity to form its tag, which stands in for the handle.
pub(crate) const TAG: u64 = 1 << 60;

/// The usual line types with their patterns in mm: dashes positive, gaps negative, dots 0.
pub const LINE_TYPES: [(&str, &[f64]); 11] = [
    ("BYBLOCK", &[]),
    ("BYLAYER", &[]),
    ("CONTINUOUS", &[]),
    ("BORDER", &[12.7, -6.35, 12.7, -6.35, 0.0, -6.35]),
    ("CENTER", &[31.75, -6.35, 6.35, -6.35]),
    ("DASHDOT", &[12.7, -6.35, 0.0, -6.35]),
    ("DASHED", &[12.7, -6.35]),
    ("DIVIDE", &[12.7, -6.35, 0.0, -6.35, 0.0, -6.35]),
    ("DOT", &[0.0, -6.35]),
    ("HIDDEN", &[6.35, -3.175]),
    ("PHANTOM", &[31.75, -6.35, 6.35, -6.35, 6.35, -6.35]),
];

/// Converts a sheet to a drawing of the crate `dxf`. Tags are counted through the entities of the drawing, then those of the blocks.
pub(crate) fn drawing(sheet: &Sheet, tickets: &mut Tickets) -> Drawing {
    let mut drawing = Drawing::new();
    drawing.clear();
    drawing.header.version = version(sheet.options().version);
    drawing.header.handles_enabled = true;
    add_tables(&mut drawing, sheet, tickets);
    for entity in sheet.entities() {
        let entity = crate_entity(entity, sheet, &mut drawing, tickets);
        drawing.add_entity(entity);
    }
    add_blocks(&mut drawing, sheet, tickets);
    let inner = sheet.entities().len();
    for (index, entity) in drawing.entities_mut().enumerate() {
        entity.common.handle = Handle(TAG + index as u64);
    }
    let blocks = drawing.blocks_mut().flat_map(|block| &mut block.entities);
    for (index, entity) in blocks.enumerate() {
        entity.common.handle = Handle(TAG + (inner + index) as u64);
    }
    drawing
}

fn version(version: Version) -> AcadVersion {
    match version {
        Version::R10 => AcadVersion::R10,
        Version::R12 => AcadVersion::R12,
        Version::R13 => AcadVersion::R13,
        Version::R14 => AcadVersion::R14,
        Version::R2000 => AcadVersion::R2000,
        Version::R2004 => AcadVersion::R2004,
        Version::R2007 => AcadVersion::R2007,
        Version::R2010 => AcadVersion::R2010,
        Version::R2013 => AcadVersion::R2013,
        Version::R2018 => AcadVersion::R2018,
    }
}

fn add_tables(drawing: &mut Drawing, sheet: &Sheet, tickets: &mut Tickets) {
    drawing.add_view_port(ViewPort { name: "*ACTIVE".to_owned(), ..Default::default() });
    drawing.add_app_id(AppId { name: "ACAD".to_owned(), ..Default::default() });
    drawing.add_dim_style(DimStyle { name: "STANDARD".to_owned(), ..Default::default() });
    drawing.add_style(Style { name: "STANDARD".to_owned(), ..Default::default() });
    for (name, pattern) in LINE_TYPES {
        drawing.add_line_type(line_type(name.to_owned(), pattern));
    }
    for (name, pattern) in sheet.line_types() {
        drawing.add_line_type(line_type(tickets.ticket(name), pattern));
    }
    for layer in sheet.layers() {
        let layer = crate_layer(layer, tickets);
        drawing.add_layer(layer);
    }
}

fn line_type(name: String, pattern: &[f64]) -> LineType {
    LineType {
        description: if pattern.is_empty() { String::new() } else { name.clone() },
        name,
        element_count: i32::try_from(pattern.len()).unwrap_or(i32::MAX),
        total_pattern_length: pattern.iter().map(|part| part.abs()).sum(),
        dash_dot_space_lengths: pattern.to_vec(),
        ..Default::default()
    }
}

fn crate_layer(layer: &Layer, tickets: &mut Tickets) -> CrateLayer {
    CrateLayer {
        name: tickets.ticket(&layer.name),
        color: Color::from_index(layer.colour),
        line_type_name: tickets.ticket(&layer.line_type),
        is_layer_on: !layer.is(LayerState::Off),
        ..Default::default()
    }
}

fn add_blocks(drawing: &mut Drawing, sheet: &Sheet, tickets: &mut Tickets) {
    if sheet.options().version >= Version::R13 {
        for name in ["*Model_Space", "*Paper_Space"] {
            drawing.add_block(CrateBlock { name: name.to_owned(), ..Default::default() });
        }
    }
    for block in sheet.blocks() {
        let inside = |entity| crate_entity(entity, sheet, drawing, tickets);
        let entities = block.entities.iter().map(inside).collect();
        let base = super::crate_entity::point(block.base);
        let name = tickets.ticket(&block.name);
        let flags = i32::from(block.name.starts_with('*'));
        drawing.add_block(CrateBlock { name, flags, base_point: base, entities, ..Default::default() });
    }
}

fn crate_entity(entity: &Entity, sheet: &Sheet, drawing: &mut Drawing, tickets: &mut Tickets) -> CrateEntity {
    let version = sheet.options().version;
    let mut converted = CrateEntity::new(entity_type(entity, version, drawing, tickets));
    let layer = entity.layer.as_deref().unwrap_or("0");
    converted.common.layer = tickets.ticket(layer);
    if let Some(line_type) = &entity.line_type {
        converted.common.line_type_name = tickets.ticket(line_type);
    }
    if let Some(colour) = entity.colour {
        converted.common.color = Color::from_index(colour);
    }
    if let (EntityType::LwPolyline(_), Shape::Polyline(polyline)) = (&converted.specific, &entity.shape) {
        converted.common.elevation = super::crate_entity::elevation(polyline, entity.orientation);
    }
    converted.common.is_in_paper_space = entity.paper;
    converted.common.is_visible = !entity.invisible;
    converted.common.lineweight_enum_value = -1;
    converted
}
