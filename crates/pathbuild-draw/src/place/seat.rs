use super::candidate::Candidate;
use super::circle::{Extent, text_circle};
use crate::error::DrawError;
use crate::model::{
    Attachment, Direction, Entity, Horizontal, MText, Note, NoteKind, Options, Point, Shape, Text, Version,
    Vertical,
};

/// Factors by which the letters are reduced if there is no room.
const SHRINK: [f64; 7] = [1.0, 0.7, 0.5, 0.35, 0.25, 0.15, 0.1];

/// Positions every note: each entity with a note is followed by its TEXT or MTEXT.
pub(crate) fn seat_notes(
    entities: Vec<Entity>,
    candidates: &[Candidate],
    options: &Options,
    errors: &mut Vec<DrawError>,
) -> Vec<Entity> {
    let mut seats = Seats { candidates, taken: vec![false; candidates.len()], errors };
    let mut texts: Vec<Option<Entity>> = entities.iter().map(|_| None).collect();
    for kind in [NoteKind::Text, NoteKind::MText] {
        for (index, entity) in entities.iter().enumerate() {
            seats.take_for_text(entity, kind);
            if let Some(note) = entity.note.as_ref().filter(|note| kind_of(note, options) == kind) {
                texts[index] = seats.seat(index, entity, note, options);
            }
        }
    }
    entities.into_iter().zip(texts).flat_map(|(entity, text)| std::iter::once(entity).chain(text)).collect()
}

fn kind_of(note: &Note, options: &Options) -> NoteKind {
    match note.kind {
        Some(kind) => kind,
        None if options.version < Version::R13 => NoteKind::Text,
        None => options.note_kind,
    }
}

/// A test of whether a text circle with this centre and radius suits the target on this layer.
type Rule<'a> = fn(&Seats<'a>, usize, &str, Point, f64) -> bool;

struct Seats<'a> {
    candidates: &'a [Candidate],
    taken: Vec<bool>,
    errors: &'a mut Vec<DrawError>,
}

impl<'a> Seats<'a> {
    /// Marks the element that an ordinary text of the drawing belongs to.
    fn take_for_text(&mut self, entity: &Entity, kind: NoteKind) {
        let is_kind = match entity.shape {
            Shape::Text(_) => kind == NoteKind::Text,
            Shape::MText(_) => kind == NoteKind::MText,
            _ => false,
        };
        if let Some(circle) = text_circle(entity).filter(|_| is_kind && !entity.paper) {
            let layer = layer_of(entity);
            if let Some(found) = self.found(&layer, circle.centre, circle.radius) {
                self.taken[found] = true;
            }
        }
    }

    fn seat(&mut self, index: usize, entity: &Entity, note: &Note, options: &Options) -> Option<Entity> {
        let layer = layer_of(entity);
        let kind = kind_of(note, options);
        let target = self.candidates.iter().position(|candidate| candidate.entity == Some(index));
        let target = target.filter(|target| !self.taken[*target]);
        let place = target.and_then(|target| self.place(target, &layer, note, kind, options));
        let (Some(target), Some((centre, height))) = (target, place) else {
            self.errors.push(no_room(entity, note));
            return None;
        };
        self.taken[target] = true;
        Some(written(entity, note, kind, centre, height))
    }

    /// A centre and a letter height for a note: preferably far from all other elements, otherwise anywhere that the rules assign to the
    /// target.
    fn place(
        &self,
        target: usize,
        layer: &str,
        note: &Note,
        kind: NoteKind,
        options: &Options,
    ) -> Option<(Point, f64)> {
        let heights: Vec<f64> = match note.height {
            Some(height) => vec![height],
            None => SHRINK.iter().map(|factor| factor * options.note_height).collect(),
        };
        let rules: [Rule<'a>; 2] = [Self::is_alone, Self::is_given];
        rules.iter().find_map(|rule| {
            heights.iter().find_map(|height| {
                let radius = extent(note, kind, *height).radius;
                let seats = self.candidates[target].pieces.iter().flat_map(|piece| piece.seats(radius));
                let mut good = seats.filter(|seat| rule(self, target, layer, *seat, radius));
                good.next().map(|seat| (seat, *height))
            })
        })
    }

    /// Whether the circle overlaps the target and keeps well clear of everything else.
    fn is_alone(&self, target: usize, layer: &str, centre: Point, radius: f64) -> bool {
        let others = self
            .candidates
            .iter()
            .enumerate()
            .filter(|(index, other)| *index != target && other.takes_text && other.layer == layer);
        let mut pieces = others.flat_map(|(_, other)| &other.pieces);
        overlaps(&self.candidates[target], centre, 0.9 * radius)
            && pieces.all(|piece| piece.clearance(centre) > 1.1 * radius + 0.05)
    }

    /// Whether the rules assign the text to the target when its turn comes, even if lengths are slightly off.
    fn is_given(&self, target: usize, layer: &str, centre: Point, radius: f64) -> bool {
        let near = |factor: f64| self.found(layer, centre, factor * radius);
        if self.candidates[target].takes_text {
            [0.95, 1.0, 1.05].into_iter().all(|factor| near(factor) == Some(target))
        } else {
            overlaps(&self.candidates[target], centre, 0.9 * radius) && near(1.05).is_none()
        }
    }

    /// The element that a text circle matches among those that have no text yet.
    fn found(&self, layer: &str, centre: Point, radius: f64) -> Option<usize> {
        let free = self.candidates.iter().enumerate().filter(|(index, candidate)| {
            candidate.takes_text && !self.taken[*index] && candidate.layer == layer
        });
        let overlapped = free.flat_map(|(index, candidate)| {
            let ranks = candidate.pieces.iter().filter_map(|piece| piece.overlapped(centre, radius));
            ranks.map(move |(rank, distance)| (rank, distance, index))
        });
        overlapped.min_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))).map(|(.., index)| index)
    }
}

fn overlaps(candidate: &Candidate, centre: Point, radius: f64) -> bool {
    candidate.pieces.iter().any(|piece| piece.overlapped(centre, radius).is_some())
}

fn layer_of(entity: &Entity) -> String {
    entity.layer.as_deref().unwrap_or("0").trim().to_lowercase()
}

fn extent(note: &Note, kind: NoteKind, height: f64) -> Extent {
    match kind {
        NoteKind::Text => Extent::of_text(&note.value, height),
        NoteKind::MText => Extent::of_mtext(&note.value, height),
    }
}

/// The entity for a note, anchored at the lower left (TEXT) or upper left (MTEXT), as CAD programs do.
fn written(entity: &Entity, note: &Note, kind: NoteKind, centre: Point, height: f64) -> Entity {
    let extent = extent(note, kind, height);
    let corner = |up: f64| Point::new(centre.x - extent.width / 2.0, centre.y + up * extent.height / 2.0);
    let shape = match kind {
        NoteKind::Text => Shape::Text(Text {
            value: note.value.clone(),
            anchor: corner(-1.0),
            height,
            rotation: 0.0,
            horizontal: Horizontal::Left,
            vertical: Vertical::Baseline,
            backwards: false,
            upside_down: false,
        }),
        NoteKind::MText => Shape::MText(MText {
            value: note.value.clone(),
            anchor: corner(1.0),
            height,
            attachment: Attachment::TopLeft,
            direction: Direction::Rotation(0.0),
            chunk: None,
            width: 0.0,
        }),
    };
    Entity { layer: entity.layer.clone(), paper: entity.paper, line: entity.line, ..Entity::new(shape) }
}

fn no_room(entity: &Entity, note: &Note) -> DrawError {
    let message = format!(
        "no place found where the text {:?} would belong to this element and to no other; \
         give the neighbours texts of their own first, move them apart, or write a `text` or `mtext` line",
        note.value
    );
    DrawError::new(entity.line, 0, message)
}
