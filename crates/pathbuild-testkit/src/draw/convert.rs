//! Converts a sheet to a drawing of the crate `dxf`.

use dxf::entities::{
    Arc as CrateArc, Circle as CrateCircle, DimensionBase, Ellipse as CrateEllipse, Entity as CrateEntity,
    EntityType, Insert as CrateInsert, Line as CrateLine, LwPolyline, MText as CrateMText, ModelPoint,
    Polyline as CratePolyline, RotatedDimension, Solid as CrateSolid, Spline as CrateSpline,
    Text as CrateText, Vertex as CrateVertex,
};
use dxf::enums::{
    AcadVersion, AttachmentPoint, DimensionType, HorizontalTextJustification, VerticalTextJustification,
};
use dxf::tables::{AppId, DimStyle, Layer as CrateLayer, LineType, Style, ViewPort};
use dxf::{Block as CrateBlock, Color, Drawing, Handle, LwPolylineVertex, Point as CratePoint, Vector};
use pathbuild_draw::pairs::{CHUNK, StringPlaceholders, chunks};

use super::draft::Sheet;
use super::model::{
    Arc, Attachment, Circle, Dimension, Direction, Ellipse, Entity, Horizontal, Insert, Layer, LayerState,
    MText, Orientation, Point, Polyline, PolylineKind, Shape, Spline, Text, Version, Vertical,
};
use super::text_positions::text_circle;

/// The tag of an entity, which is written in place of its handle, is this number plus the index of the entity.
pub(crate) const TAG_BASE: u64 = 1 << 60;

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

/// Converts a sheet to a drawing of the crate `dxf`. Tags number the entities of the drawing first, then those of the blocks.
pub(crate) fn drawing(sheet: &Sheet, tickets: &mut StringPlaceholders) -> Drawing {
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
        entity.common.handle = Handle(TAG_BASE + index as u64);
    }
    let blocks = drawing.blocks_mut().flat_map(|block| &mut block.entities);
    for (index, entity) in blocks.enumerate() {
        entity.common.handle = Handle(TAG_BASE + (inner + index) as u64);
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

fn add_tables(drawing: &mut Drawing, sheet: &Sheet, tickets: &mut StringPlaceholders) {
    drawing.add_view_port(ViewPort { name: "*ACTIVE".to_owned(), ..Default::default() });
    drawing.add_app_id(AppId { name: "ACAD".to_owned(), ..Default::default() });
    drawing.add_dim_style(DimStyle { name: "STANDARD".to_owned(), ..Default::default() });
    drawing.add_style(Style { name: "STANDARD".to_owned(), ..Default::default() });
    for (name, pattern) in LINE_TYPES {
        drawing.add_line_type(line_type(name.to_owned(), pattern));
    }
    for (name, pattern) in sheet.line_types() {
        drawing.add_line_type(line_type(tickets.placeholder_for(name), pattern));
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

fn crate_layer(layer: &Layer, tickets: &mut StringPlaceholders) -> CrateLayer {
    CrateLayer {
        name: tickets.placeholder_for(&layer.name),
        color: Color::from_index(layer.colour),
        line_type_name: tickets.placeholder_for(&layer.line_type),
        is_layer_on: !layer.is(LayerState::Off),
        ..Default::default()
    }
}

fn add_blocks(drawing: &mut Drawing, sheet: &Sheet, tickets: &mut StringPlaceholders) {
    if sheet.options().version >= Version::R13 {
        for name in ["*Model_Space", "*Paper_Space"] {
            drawing.add_block(CrateBlock { name: name.to_owned(), ..Default::default() });
        }
    }
    for block in sheet.blocks() {
        let inside = |entity| crate_entity(entity, sheet, drawing, tickets);
        let entities = block.entities.iter().map(inside).collect();
        let base = point(block.base);
        let name = tickets.placeholder_for(&block.name);
        let flags = i32::from(block.name.starts_with('*'));
        drawing.add_block(CrateBlock { name, flags, base_point: base, entities, ..Default::default() });
    }
}

fn crate_entity(
    entity: &Entity,
    sheet: &Sheet,
    drawing: &mut Drawing,
    tickets: &mut StringPlaceholders,
) -> CrateEntity {
    let version = sheet.options().version;
    let mut converted = CrateEntity::new(entity_type(entity, version, drawing, tickets));
    let layer = entity.layer.as_deref().unwrap_or("0");
    converted.common.layer = tickets.placeholder_for(layer);
    if let Some(line_type) = &entity.line_type {
        converted.common.line_type_name = tickets.placeholder_for(line_type);
    }
    if let Some(colour) = entity.colour {
        converted.common.color = Color::from_index(colour);
    }
    if let (EntityType::LwPolyline(_), Shape::Polyline(polyline)) = (&converted.specific, &entity.shape) {
        converted.common.elevation = elevation(polyline, entity.orientation);
    }
    converted.common.is_in_paper_space = entity.paper;
    converted.common.is_visible = !entity.invisible;
    converted.common.lineweight_enum_value = -1;
    converted
}

/// Converts an entity to the type of the crate `dxf`, in object coordinates.
fn entity_type(
    entity: &Entity,
    version: Version,
    drawing: &mut Drawing,
    tickets: &mut StringPlaceholders,
) -> EntityType {
    let plane = entity.orientation;
    match &entity.shape {
        Shape::Line(line) => {
            let mut converted = CrateLine::new(point(line.from), point(line.to));
            converted.extrusion_direction = normal(plane);
            EntityType::Line(converted)
        }
        Shape::Arc(shape) => EntityType::Arc(arc(shape, plane)),
        Shape::Circle(shape) => EntityType::Circle(circle(shape, plane)),
        Shape::Polyline(shape) if shape.kind == PolylineKind::Light && version >= Version::R14 => {
            EntityType::LwPolyline(light_polyline(shape, plane))
        }
        Shape::Polyline(shape) => EntityType::Polyline(heavy_polyline(shape, plane, drawing)),
        Shape::Ellipse(shape) => EntityType::Ellipse(ellipse(shape, plane)),
        Shape::Spline(shape) => EntityType::Spline(spline(shape, plane)),
        Shape::Insert(shape) => EntityType::Insert(insert(shape, plane, tickets)),
        Shape::Text(shape) => EntityType::Text(text(shape, entity, tickets)),
        Shape::MText(shape) => EntityType::MText(mtext(shape, entity, tickets)),
        Shape::Solid(corners) => EntityType::Solid(solid(corners, plane)),
        Shape::Dimension(shape) => EntityType::RotatedDimension(dimension(shape, tickets)),
        // A placeholder: its pairs are replaced.
        Shape::Raw(_) => EntityType::ModelPoint(ModelPoint::default()),
    }
}

/// Converts a point unchanged.
pub(crate) fn point(point: Point) -> CratePoint {
    CratePoint::new(point.x, point.y, point.z)
}

/// Converts a point to object coordinates.
fn object_point(at: Point, plane: Orientation) -> CratePoint {
    match plane {
        Orientation::Mirrored => CratePoint::new(0.0 - at.x, at.y, 0.0 - at.z),
        Orientation::Upright | Orientation::Tilted(_) => point(at),
    }
}

/// Returns the normal of the plane (group 210).
pub(crate) fn normal(plane: Orientation) -> Vector {
    match plane {
        Orientation::Upright => Vector::z_axis(),
        Orientation::Mirrored => Vector::new(0.0, 0.0, -1.0),
        Orientation::Tilted(normal) => Vector::new(normal.x, normal.y, normal.z),
    }
}

/// Returns the elevation of a flat polyline (group 38).
fn elevation(polyline: &Polyline, plane: Orientation) -> f64 {
    polyline.vertices.first().map_or(0.0, |first| object_point(first.point, plane).z)
}

fn is_mirrored(plane: Orientation) -> bool {
    plane == Orientation::Mirrored
}

fn arc(arc: &Arc, plane: Orientation) -> CrateArc {
    let (start, end) =
        if is_mirrored(plane) { (180.0 - arc.end, 180.0 - arc.start) } else { (arc.start, arc.end) };
    let turn = |angle: f64| if (0.0..=360.0).contains(&angle) { angle } else { angle.rem_euclid(360.0) };
    let mut converted = CrateArc::new(object_point(arc.centre, plane), arc.radius, turn(start), turn(end));
    converted.normal = normal(plane);
    converted
}

fn circle(circle: &Circle, plane: Orientation) -> CrateCircle {
    let mut converted = CrateCircle::new(object_point(circle.centre, plane), circle.radius);
    converted.normal = normal(plane);
    converted
}

fn light_polyline(polyline: &Polyline, plane: Orientation) -> LwPolyline {
    let sign = if is_mirrored(plane) { -1.0 } else { 1.0 };
    let vertices = polyline.vertices.iter().map(|vertex| LwPolylineVertex {
        x: sign * vertex.point.x,
        y: vertex.point.y,
        bulge: sign * vertex.bulge,
        ..Default::default()
    });
    LwPolyline {
        flags: i32::from(polyline.closed),
        vertices: vertices.collect(),
        extrusion_direction: normal(plane),
        ..Default::default()
    }
}

fn heavy_polyline(polyline: &Polyline, plane: Orientation, drawing: &mut Drawing) -> CratePolyline {
    let spatial = polyline.kind == PolylineKind::Spatial;
    let sign = if is_mirrored(plane) { -1.0 } else { 1.0 };
    let mut converted = CratePolyline {
        contains_vertices: true,
        flags: i32::from(polyline.closed) + if spatial { 8 } else { 0 },
        normal: normal(plane),
        ..Default::default()
    };
    if !spatial {
        converted.location.z = elevation(polyline, plane);
    }
    for vertex in &polyline.vertices {
        let mut corner = CrateVertex::new(object_point(vertex.point, plane));
        corner.bulge = sign * vertex.bulge;
        corner.flags = if spatial { 32 } else { 0 };
        converted.add_vertex(drawing, corner);
    }
    converted
}

/// Converts an ellipse. Centre and axis are always in world coordinates; seen from below, the parameters run in the opposite direction.
fn ellipse(ellipse: &Ellipse, plane: Orientation) -> CrateEllipse {
    let (start, end) =
        if is_mirrored(plane) { (-ellipse.end, -ellipse.start) } else { (ellipse.start, ellipse.end) };
    let major = ellipse.major;
    CrateEllipse {
        center: point(ellipse.centre),
        major_axis: Vector::new(major.x, major.y, major.z),
        normal: normal(plane),
        minor_axis_ratio: ellipse.ratio,
        start_parameter: start.to_radians(),
        end_parameter: end.to_radians(),
    }
}

fn spline(spline: &Spline, plane: Orientation) -> CrateSpline {
    let rational = if spline.weights.is_empty() { 0 } else { 4 };
    CrateSpline {
        normal: normal(plane),
        flags: 8 + rational + i32::from(spline.closed),
        degree_of_curve: i32::from(spline.degree),
        knot_values: spline.knots.clone(),
        weight_values: spline.weights.clone(),
        control_points: spline.control.iter().copied().map(point).collect(),
        fit_points: spline.fit.iter().copied().map(point).collect(),
        ..Default::default()
    }
}

fn insert(insert: &Insert, plane: Orientation, tickets: &mut StringPlaceholders) -> CrateInsert {
    let sign = if is_mirrored(plane) { -1.0 } else { 1.0 };
    CrateInsert {
        name: tickets.placeholder_for(&insert.block),
        location: object_point(insert.at, plane),
        x_scale_factor: sign * insert.scale.x,
        y_scale_factor: insert.scale.y,
        z_scale_factor: insert.scale.z,
        rotation: sign * insert.rotation,
        column_count: insert.count.0,
        row_count: insert.count.1,
        column_spacing: sign * insert.spacing.0,
        row_spacing: insert.spacing.1,
        extrusion_direction: normal(plane),
        ..Default::default()
    }
}

fn dimension(dimension: &Dimension, tickets: &mut StringPlaceholders) -> RotatedDimension {
    let dimension_base = DimensionBase {
        block_name: tickets.placeholder_for(&dimension.block),
        definition_point_1: point(dimension.line),
        text_mid_point: point(dimension.text),
        dimension_type: DimensionType::RotatedHorizontalOrVertical,
        attachment_point: AttachmentPoint::MiddleCenter,
        actual_measurement: (dimension.to.x - dimension.from.x).abs(),
        text: tickets.placeholder_for(&dimension.label),
        is_block_reference_referenced_by_this_block_only: true,
        ..Default::default()
    };
    RotatedDimension {
        dimension_base,
        definition_point_2: point(dimension.from),
        definition_point_3: point(dimension.to),
        ..Default::default()
    }
}

fn solid(corners: &[Point; 4], plane: Orientation) -> CrateSolid {
    let [a, b, c, d] = corners.map(|corner| object_point(corner, plane));
    let mut converted = CrateSolid::new(a, b, c, d);
    converted.extrusion_direction = normal(plane);
    converted
}

pub(crate) fn text(text: &Text, entity: &Entity, tickets: &mut StringPlaceholders) -> CrateText {
    let plane = entity.orientation;
    let (location, alignment) = points(text, entity);
    CrateText {
        location: object_point(location, plane),
        second_alignment_point: alignment.map_or_else(Default::default, |at| object_point(at, plane)),
        text_height: text.height,
        value: tickets.placeholder_for(&text.value),
        rotation: if plane == Orientation::Mirrored { -text.rotation } else { text.rotation },
        text_style_name: style(entity, tickets),
        text_generation_flags: i32::from(text.backwards) * 2 + i32::from(text.upside_down) * 4,
        horizontal_text_justification: horizontal(text.horizontal),
        vertical_text_justification: vertical(text.vertical),
        normal: normal(plane),
        ..Default::default()
    }
}

/// Returns the points of groups 10 and 11. For any alignment except left on the baseline, group 11 is the anchor, and group 10 is derived from it.
fn points(text: &Text, entity: &Entity) -> (Point, Option<Point>) {
    match text.horizontal {
        Horizontal::Aligned(other) | Horizontal::Fit(other) => (text.anchor, Some(other)),
        Horizontal::Left if text.vertical == Vertical::Baseline => (text.anchor, None),
        _ => (lower_left(text, entity), Some(text.anchor)),
    }
}

fn lower_left(text: &Text, entity: &Entity) -> Point {
    let width = 0.6 * text.height * text.value.chars().count() as f64;
    let corner = Point::new(-width / 2.0, -text.height / 2.0).rotated(text.rotation);
    text_circle(entity).map_or(text.anchor, |circle| circle.centre + corner)
}

fn style(entity: &Entity, tickets: &mut StringPlaceholders) -> String {
    tickets.placeholder_for(entity.style.as_deref().unwrap_or("STANDARD"))
}

fn horizontal(horizontal: Horizontal) -> HorizontalTextJustification {
    match horizontal {
        Horizontal::Left => HorizontalTextJustification::Left,
        Horizontal::Centre => HorizontalTextJustification::Center,
        Horizontal::Right => HorizontalTextJustification::Right,
        Horizontal::Aligned(_) => HorizontalTextJustification::Aligned,
        Horizontal::Middle => HorizontalTextJustification::Middle,
        Horizontal::Fit(_) => HorizontalTextJustification::Fit,
    }
}

fn vertical(vertical: Vertical) -> VerticalTextJustification {
    match vertical {
        Vertical::Baseline => VerticalTextJustification::Baseline,
        Vertical::Bottom => VerticalTextJustification::Bottom,
        Vertical::Middle => VerticalTextJustification::Middle,
        Vertical::Top => VerticalTextJustification::Top,
    }
}

pub(crate) fn mtext(text: &MText, entity: &Entity, tickets: &mut StringPlaceholders) -> CrateMText {
    let mut chunks = chunks(&text.value, text.chunk.unwrap_or(CHUNK));
    let last = chunks.pop().unwrap_or_default();
    let (rotation, direction) = match text.direction {
        Direction::Rotation(degrees) => (degrees, Point::new(1.0, 0.0)),
        Direction::Vector(vector) => (0.0, vector),
    };
    CrateMText {
        insertion_point: point(text.anchor),
        initial_text_height: text.height,
        reference_rectangle_width: text.width,
        attachment_point: attachment(text.attachment),
        extended_text: chunks.iter().map(|chunk| tickets.placeholder_for(chunk)).collect(),
        text: tickets.placeholder_for(&last),
        text_style_name: style(entity, tickets),
        extrusion_direction: normal(entity.orientation),
        x_axis_direction: Vector::new(direction.x, direction.y, direction.z),
        rotation_angle: rotation,
        ..Default::default()
    }
}

fn attachment(attachment: Attachment) -> AttachmentPoint {
    match attachment {
        Attachment::TopLeft => AttachmentPoint::TopLeft,
        Attachment::TopCentre => AttachmentPoint::TopCenter,
        Attachment::TopRight => AttachmentPoint::TopRight,
        Attachment::MiddleLeft => AttachmentPoint::MiddleLeft,
        Attachment::MiddleCentre => AttachmentPoint::MiddleCenter,
        Attachment::MiddleRight => AttachmentPoint::MiddleRight,
        Attachment::BottomLeft => AttachmentPoint::BottomLeft,
        Attachment::BottomCentre => AttachmentPoint::BottomCenter,
        Attachment::BottomRight => AttachmentPoint::BottomRight,
    }
}
