use dxf::entities::{
    Arc as CrateArc, Circle as CrateCircle, DimensionBase, Ellipse as CrateEllipse, EntityType,
    Insert as CrateInsert, Line as CrateLine, LwPolyline, ModelPoint, Polyline as CratePolyline,
    RotatedDimension, Solid as CrateSolid, Spline as CrateSpline, Vertex as CrateVertex,
};
use dxf::enums::{AttachmentPoint, DimensionType};
use dxf::{Drawing, LwPolylineVertex, Point as CratePoint, Vector};

use super::crate_text::{mtext, text};
use super::tickets::Tickets;
use crate::model::{
    Arc, Circle, Dimension, Ellipse, Entity, Insert, Orientation, Point, Polyline, PolylineKind, Shape,
    Spline, Version,
};

/// Converts an entity to the type of the crate `dxf`, in object coordinates.
pub(crate) fn entity_type(
    entity: &Entity,
    version: Version,
    drawing: &mut Drawing,
    tickets: &mut Tickets,
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
        // Only a placeholder: its pairs are replaced.
        Shape::Raw(_) => EntityType::ModelPoint(ModelPoint::default()),
    }
}

/// Converts a point unchanged.
pub(crate) fn point(point: Point) -> CratePoint {
    CratePoint::new(point.x, point.y, point.z)
}

/// Converts a point to object coordinates.
pub(crate) fn object_point(at: Point, plane: Orientation) -> CratePoint {
    match plane {
        Orientation::Mirrored => CratePoint::new(0.0 - at.x, at.y, 0.0 - at.z),
        Orientation::Upright | Orientation::Tilted(_) => point(at),
    }
}

/// The normal (group 210).
pub(crate) fn normal(plane: Orientation) -> Vector {
    match plane {
        Orientation::Upright => Vector::z_axis(),
        Orientation::Mirrored => Vector::new(0.0, 0.0, -1.0),
        Orientation::Tilted(normal) => Vector::new(normal.x, normal.y, normal.z),
    }
}

/// The elevation (group 38).
pub(crate) fn elevation(polyline: &Polyline, plane: Orientation) -> f64 {
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

/// Centre and axis are always in world coordinates; seen from below, the parameters run in the opposite direction.
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

fn insert(insert: &Insert, plane: Orientation, tickets: &mut Tickets) -> CrateInsert {
    let sign = if is_mirrored(plane) { -1.0 } else { 1.0 };
    CrateInsert {
        name: tickets.ticket(&insert.block),
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

fn dimension(dimension: &Dimension, tickets: &mut Tickets) -> RotatedDimension {
    let dimension_base = DimensionBase {
        block_name: tickets.ticket(&dimension.block),
        definition_point_1: point(dimension.line),
        text_mid_point: point(dimension.text),
        dimension_type: DimensionType::RotatedHorizontalOrVertical,
        attachment_point: AttachmentPoint::MiddleCenter,
        actual_measurement: (dimension.to.x - dimension.from.x).abs(),
        text: tickets.ticket(&dimension.label),
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
