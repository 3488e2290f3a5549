use super::plain;
use crate::model::{Entity, Horizontal, MText, Orientation, Point, Shape, Text, Vertical};

/// The circle by which a text is matched with its element.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct TextCircle {
    pub centre: Point,
    pub radius: f64,
}

/// The circle of a TEXT or MTEXT; `None` for other entities. (book: language/parameter-texts)
pub fn text_circle(entity: &Entity) -> Option<TextCircle> {
    match &entity.shape {
        Shape::Text(text) => Some(of_text(text, entity.orientation == Orientation::Mirrored)),
        Shape::MText(text) => Some(of_mtext(text)),
        _ => None,
    }
}

/// Width, height and circle radius of a note.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Extent {
    pub(crate) width: f64,
    pub(crate) height: f64,
    pub(crate) radius: f64,
}

impl Extent {
    pub(crate) fn of_text(value: &str, height: f64) -> Self {
        let width = 0.6 * height * value.chars().count() as f64;
        Self { width, height, radius: libm::hypot(width, height) / 2.0 }
    }

    pub(crate) fn of_mtext(value: &str, letters: f64) -> Self {
        let lines = plain::lines(value);
        let longest = lines.iter().map(|line| line.chars().count()).max().unwrap_or(0);
        let width = 0.6 * letters * longest as f64;
        let height = letters * lines.len() as f64;
        Self { width, height, radius: (libm::hypot(width, height) / 2.0).min(0.7 * height) }
    }
}

fn of_text(text: &Text, mirrored: bool) -> TextCircle {
    let extent = Extent::of_text(&text.value, text.height);
    let (anchor, across) = match text.horizontal {
        Horizontal::Left => (text.anchor, 0.5),
        Horizontal::Right => (text.anchor, -0.5),
        Horizontal::Centre | Horizontal::Middle => (text.anchor, 0.0),
        Horizontal::Aligned(other) | Horizontal::Fit(other) => ((text.anchor + other) * 0.5, 0.0),
    };
    let up = match text.vertical {
        _ if text.horizontal == Horizontal::Middle => 0.0,
        Vertical::Baseline | Vertical::Bottom => 0.5,
        Vertical::Middle => 0.0,
        Vertical::Top => -0.5,
    };
    let across = if mirrored == text.backwards { across } else { -across };
    let up = if text.upside_down { -up } else { up };
    let offset = Point::new(across * extent.width, up * extent.height);
    TextCircle { centre: anchor + offset.turned(text.rotation), radius: extent.radius }
}

fn of_mtext(text: &MText) -> TextCircle {
    let extent = Extent::of_mtext(&text.value, text.height);
    let index = text.attachment.number() - 1;
    let across = f64::from(1 - index % 3) / 2.0;
    let up = f64::from(index / 3 - 1) / 2.0;
    let offset = Point::new(across * extent.width, up * extent.height);
    TextCircle { centre: text.anchor + offset.turned(text.direction.degrees()), radius: extent.radius }
}
