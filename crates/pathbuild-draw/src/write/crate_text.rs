use dxf::Vector;
use dxf::entities::{MText as CrateMText, Text as CrateText};
use dxf::enums::{AttachmentPoint, HorizontalTextJustification, VerticalTextJustification};

use super::crate_entity::{normal, object_point, point};
use super::tickets::Tickets;
use crate::model::{Attachment, Direction, Entity, Horizontal, MText, Orientation, Point, Text, Vertical};
use crate::place::text_circle;

/// Default length in characters of an MTEXT's chunks.
const CHUNK: usize = 250;

pub(crate) fn text(text: &Text, entity: &Entity, tickets: &mut Tickets) -> CrateText {
    let plane = entity.orientation;
    let (location, alignment) = points(text, entity);
    CrateText {
        location: object_point(location, plane),
        second_alignment_point: alignment.map_or_else(Default::default, |at| object_point(at, plane)),
        text_height: text.height,
        value: tickets.ticket(&text.value),
        rotation: if plane == Orientation::Mirrored { -text.rotation } else { text.rotation },
        text_style_name: style(entity, tickets),
        text_generation_flags: i32::from(text.backwards) * 2 + i32::from(text.upside_down) * 4,
        horizontal_text_justification: horizontal(text.horizontal),
        vertical_text_justification: vertical(text.vertical),
        normal: normal(plane),
        ..Default::default()
    }
}

/// Groups 10 and 11: for any alignment but left on the baseline, 11 is the anchor and 10 is derived from it.
fn points(text: &Text, entity: &Entity) -> (Point, Option<Point>) {
    match text.horizontal {
        Horizontal::Aligned(other) | Horizontal::Fit(other) => (text.anchor, Some(other)),
        Horizontal::Left if text.vertical == Vertical::Baseline => (text.anchor, None),
        _ => (lower_left(text, entity), Some(text.anchor)),
    }
}

fn lower_left(text: &Text, entity: &Entity) -> Point {
    let width = 0.6 * text.height * text.value.chars().count() as f64;
    let corner = Point::new(-width / 2.0, -text.height / 2.0).turned(text.rotation);
    text_circle(entity).map_or(text.anchor, |circle| circle.centre + corner)
}

fn style(entity: &Entity, tickets: &mut Tickets) -> String {
    tickets.ticket(entity.style.as_deref().unwrap_or("STANDARD"))
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

pub(crate) fn mtext(text: &MText, entity: &Entity, tickets: &mut Tickets) -> CrateMText {
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
        extended_text: chunks.iter().map(|chunk| tickets.ticket(chunk)).collect(),
        text: tickets.ticket(&last),
        text_style_name: style(entity, tickets),
        extrusion_direction: normal(entity.orientation),
        x_axis_direction: Vector::new(direction.x, direction.y, direction.z),
        rotation_angle: rotation,
        ..Default::default()
    }
}

fn chunks(value: &str, size: usize) -> Vec<String> {
    let chars: Vec<char> = value.chars().collect();
    chars.chunks(size.max(1)).map(|chunk| chunk.iter().collect()).collect()
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
