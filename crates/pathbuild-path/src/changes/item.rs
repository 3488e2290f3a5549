//! The items that are compared: the elements and markers of a path, each with its own text and its effective parameters.

use std::collections::BTreeSet;

use nalgebra::Vector2;
use pathbuild_diagnostic::{ElementId, Handle};

use super::{DrawnSide, ElementChange, ElementKind};
use crate::effective::Provider;
use crate::element::{END_RADIUS, Element, Marker, PROBE_RADIUS, Role, START_RADIUS, Shape, TURN_RADIUS};
use crate::element_parameters::{ElementParameters, Parameter};
use crate::geometry::{Arc, Curve, Xy};
use crate::letter::{Letter, LetterEffect};
use crate::line_type::LineType;
use crate::text::{LetterValue, ParameterText};

/// An element or marker of one version of a path, with the text and the effective parameters that are compared.
#[derive(Debug)]
pub(super) struct Item<'a> {
    pub(super) kind: ElementKind,
    pub(super) shape: Shape,
    /// Role of the element; `None` for markers.
    pub(super) role: Option<Role>,
    pub(super) text: ParameterText<'a>,
    /// Effective parameters that can change moves.
    parameters: Vec<&'a Parameter>,
    pub(super) handle: Option<Handle>,
    /// Index of the element among the drawn elements of the path; 0 for markers.
    pub(super) number: usize,
}

/// A role, and the effective parameters that can change moves.
type Effect<'i> = (Option<Role>, Vec<(Letter, &'i str)>);

pub(super) fn items(side: DrawnSide<'_>) -> Vec<Item<'_>> {
    let raw = side.raw;
    let first = usize::from(raw.start.is_some());
    let elements = raw.drawn.elements.iter().enumerate();
    let mut items: Vec<Item<'_>> =
        elements.map(|(number, element)| element_item(side, element, number, first + number)).collect();
    let marker = |kind, radius, marker: &Marker| {
        let shape = Shape::Circle { centre: marker.at, radius };
        let handle = handle(side, marker.origin.id);
        let (text, parameters) = (ParameterText::default(), Vec::new());
        Item { kind, shape, role: None, text, parameters, handle, number: 0 }
    };
    items.extend(raw.start.iter().map(|start| marker(ElementKind::Start, START_RADIUS, start)));
    items.extend(raw.end.iter().map(|end| marker(ElementKind::End, END_RADIUS, end)));
    items.extend(raw.turns.iter().map(|turn| marker(ElementKind::Turn, TURN_RADIUS, turn)));
    let rows = side.parameters.iter().skip(first + raw.drawn.elements.len());
    for (probe, row) in raw.probes.iter().zip(rows) {
        let text = raw.drawn.text(probe.text).unwrap_or_default();
        let marker = marker(ElementKind::Probe, PROBE_RADIUS, probe);
        items.push(Item { text, parameters: moving_parameters(row).collect(), ..marker });
    }
    items
}

fn element_item<'a>(side: DrawnSide<'a>, element: &Element, number: usize, row: usize) -> Item<'a> {
    Item {
        kind: match element.shape {
            Shape::Circle { .. } => ElementKind::Circle,
            Shape::Curve(Curve::Line(_)) => ElementKind::Line,
            Shape::Curve(Curve::Arc(_)) => ElementKind::Arc,
        },
        shape: element.shape,
        role: Some(element.role),
        text: side.raw.drawn.text(element.text).unwrap_or_default(),
        parameters: side.parameters.get(row).into_iter().flat_map(moving_parameters).collect(),
        handle: handle(side, element.source.id),
        number,
    }
}

fn handle(side: DrawnSide<'_>, element: ElementId) -> Option<Handle> {
    side.positions.positions().get(element.0 as usize)?.handle
}

fn moving_parameters(row: &ElementParameters) -> impl Iterator<Item = &Parameter> {
    row.parameters.iter().filter(|parameter| can_move(parameter.letter))
}

/// Whether the value of a letter can change moves. @ itself cannot: the borrowed parameters are compared instead.
fn can_move(letter: Letter) -> bool {
    letter.effect() != LetterEffect::Nothing && letter != Letter::At
}

impl Item<'_> {
    /// Returns the start of a line or arc, or the centre of a circle.
    pub(super) fn at(&self) -> Xy {
        self.shape.point()
    }

    /// Returns the end of a line or arc.
    pub(super) fn end(&self) -> Option<Xy> {
        match self.shape {
            Shape::Curve(curve) => Some(curve.end()),
            Shape::Circle { .. } => None,
        }
    }

    /// Returns the effect of the element on the moves, apart from its shape. It is equal for elements that are treated alike.
    pub(super) fn effect(&self) -> Effect<'_> {
        let values = self.parameters.iter().map(|parameter| (parameter.letter, parameter.value.as_str()));
        (self.role.map(comparable_role), values.collect())
    }

    /// Returns the line types of both versions, if they have different meanings, or if nothing else explains a different effect on the moves.
    pub(super) fn line_type_change(&self, new: &Self) -> Option<[&'static str; 2]> {
        let (old_role, new_role) = (self.role?, new.role?);
        let is_changed = comparable_role(old_role) != comparable_role(new_role)
            || old_role != new_role && self.effect() != new.effect() && self.text_change(new).is_none();
        is_changed.then(|| [old_role, new_role].map(|role| line_type(role).name()))
    }

    /// Returns the pieces in which the old and the new text of the element differ. Only letters with a different effective value are compared, and
    /// only those that at least one of the texts gives. `None` if the new or the old line type takes no text: the change of the line type explains
    /// the lost or added text.
    pub(super) fn text_change(&self, new: &Self) -> Option<[String; 2]> {
        if self.role != new.role && [self.role, new.role].iter().flatten().any(|role| !takes_text(*role)) {
            return None;
        }
        let is_changed = |letter| self.value(letter) != new.value(letter);
        let gives = |item: &Self, letter| item.parameter(letter).is_some_and(|own| own.from == Provider::Own);
        let letters: Vec<Letter> = Letter::all()
            .filter(|letter| is_changed(*letter) && (gives(self, *letter) || gives(new, *letter)))
            .collect();
        differing_pieces(self.text, new.text, &letters)
    }

    fn parameter(&self, letter: Letter) -> Option<&Parameter> {
        self.parameters.iter().copied().find(|parameter| parameter.letter == letter)
    }

    fn value(&self, letter: Letter) -> Option<&str> {
        Some(&self.parameter(letter)?.value)
    }
}

/// Returns the change of the path's own parameters, if it can change its moves.
pub(super) fn start_text(old: DrawnSide<'_>, new: DrawnSide<'_>) -> Option<ElementChange> {
    // The cutter, the thickness, the path's own feed and its sweep height are used even if every element gives its own values.
    let is_used = |letter: Letter| {
        let takes = |row: &ElementParameters| {
            let is_from_path = |from: &Provider| matches!(from, Provider::Path | Provider::Lender(_));
            row.parameters.iter().any(|own| own.letter == letter && is_from_path(&own.from))
        };
        let is_taken = |side: DrawnSide<'_>| {
            side.parameters.iter().skip(usize::from(side.raw.start.is_some())).any(takes)
        };
        matches!(letter, Letter::F | Letter::O | Letter::S | Letter::T) || is_taken(old) || is_taken(new)
    };
    let value = |side: DrawnSide<'_>, letter| {
        let row = side.parameters.first().filter(|_| side.raw.start.is_some())?;
        let own = row.parameters.iter().find(|own| own.letter == letter)?;
        matches!(own.from, Provider::Path | Provider::Lender(_)).then(|| own.value.clone())
    };
    let letters = Letter::all().filter(|letter| can_move(*letter) && *letter != Letter::Variable);
    let letters: Vec<Letter> =
        letters.filter(|letter| value(old, *letter) != value(new, *letter) && is_used(*letter)).collect();
    differing_pieces(old.raw.parameters(), new.raw.parameters(), &letters).map(ElementChange::Text)
}

/// Returns the pieces of each text that begin with one of these letters and are missing from the other text. `None` if there are none.
fn differing_pieces(
    old: ParameterText<'_>,
    new: ParameterText<'_>,
    letters: &[Letter],
) -> Option<[String; 2]> {
    let pieces = |text: ParameterText<'_>, other: ParameterText<'_>| {
        let known: BTreeSet<&str> = other.pieces().iter().map(|piece| other.piece_text(piece)).collect();
        let has_letter = |piece: &&LetterValue| piece.letter.is_some_and(|letter| letters.contains(&letter));
        let own = text.pieces().iter().filter(has_letter).map(|piece| text.piece_text(piece));
        excerpt(&own.filter(|piece| !known.contains(piece)).collect::<Vec<_>>().join(" "))
    };
    let texts = [pieces(old, new), pieces(new, old)];
    texts.iter().any(|text| !text.is_empty()).then_some(texts)
}

const MAX_SHOWN_CHARACTERS: usize = 200;

fn excerpt(text: &str) -> String {
    match text.char_indices().nth(MAX_SHOWN_CHARACTERS) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text.to_owned(),
    }
}

/// Returns the role by which an element is compared: all sweeps are alike, whatever their line type.
fn comparable_role(role: Role) -> Role {
    match role {
        Role::SilentSweep | Role::SkippedSubpath => Role::Sweep,
        Role::Cut(_) | Role::Sweep | Role::Subpath => role,
    }
}

fn takes_text(role: Role) -> bool {
    role != Role::SilentSweep
}

/// Returns the usual line type for a role.
fn line_type(role: Role) -> LineType {
    let is_role = |line_type: &LineType| crate::element::curve_role(*line_type) == Some(role);
    let line_types = LineType::NAMES.into_iter().map(|(_, line_type)| line_type);
    line_types.into_iter().find(is_role).unwrap_or(LineType::Continuous)
}

/// Difference in mm up to which places and lengths are equal. CAD programs write at least four decimals.
pub(super) const EQUALITY_TOLERANCE: f64 = 1e-4;

/// Returns the changes from one shape to another, apart from a move by `shift`. The drawn directions do not matter.
pub(super) fn shape_changes(
    old: &Shape,
    new: &Shape,
    shift: Vector2<f64>,
) -> impl Iterator<Item = ElementChange> + use<> {
    let changes = match (old, new) {
        (
            Shape::Circle { centre: old_centre, radius: old },
            Shape::Circle { centre: new_centre, radius: new },
        ) => {
            let diameters = [2.0 * *old, 2.0 * *new];
            let radius = (!is_same(*old, *new)).then_some(ElementChange::Diameter(diameters));
            [radius, move_change(new_centre - old_centre - shift)]
        }
        (Shape::Curve(old), Shape::Curve(new)) => [curve_change(old, new, shift), None],
        _ => [Some(ElementChange::Reshaped), None],
    };
    changes.into_iter().flatten()
}

/// Whether the shapes are equal up to rounding.
pub(super) fn is_equal(old: &Shape, new: &Shape, shift: Vector2<f64>) -> bool {
    shape_changes(old, new, shift).next().is_none()
}

fn move_change(by: Vector2<f64>) -> Option<ElementChange> {
    (!is_negligible(by)).then(|| ElementChange::Moved(by.into()))
}

fn curve_change(old: &Curve, new: &Curve, shift: Vector2<f64>) -> Option<ElementChange> {
    let new = in_same_direction(old, new, shift);
    let ends @ [first, second] = [new.start() - old.start() - shift, new.end() - old.end() - shift];
    match (old, new) {
        (Curve::Line(_), Curve::Line(_)) => ends_change(first, second),
        (Curve::Arc(old), Curve::Arc(new)) => arc_change(old, &new, shift, ends),
        _ => Some(ElementChange::Reshaped),
    }
}

fn ends_change(first: Vector2<f64>, second: Vector2<f64>) -> Option<ElementChange> {
    match (is_negligible(first), is_negligible(second)) {
        (true, true) => None,
        _ if is_negligible(first - second) => Some(ElementChange::Moved(first.into())),
        (true, false) => Some(ElementChange::EndMoved(second.into())),
        (false, true) => Some(ElementChange::EndMoved(first.into())),
        (false, false) => Some(ElementChange::Reshaped),
    }
}

/// Returns the change between two arcs that turn the same way; their centres and ends determine it.
fn arc_change(
    old: &Arc,
    new: &Arc,
    shift: Vector2<f64>,
    [first, second]: [Vector2<f64>; 2],
) -> Option<ElementChange> {
    let centre = new.centre - old.centre - shift;
    let has_same_ends = is_negligible(first) && is_negligible(second);
    if !is_same(old.radius, new.radius) {
        let is_concentric = is_negligible(centre);
        let radii = [old.radius, new.radius];
        return Some(if is_concentric || has_same_ends {
            ElementChange::Radius(radii)
        } else {
            ElementChange::Reshaped
        });
    }
    match ends_change(first, second) {
        Some(ElementChange::Moved(by)) if is_negligible(centre - first) => Some(ElementChange::Moved(by)),
        change @ (None | Some(ElementChange::EndMoved(_))) if is_negligible(centre) => change,
        _ => Some(ElementChange::Reshaped),
    }
}

/// Returns the new curve, reversed if necessary to run in the direction of the old one: both arcs run clockwise or both counterclockwise, and the
/// ends of a line are nearer to those of the old line than if the line were reversed.
fn in_same_direction(old: &Curve, new: &Curve, shift: Vector2<f64>) -> Curve {
    let distance = |curve: &Curve| {
        (curve.start() - old.start() - shift).norm() + (curve.end() - old.end() - shift).norm()
    };
    let reversed = new.reversed();
    let is_reversed = match (old, new) {
        (Curve::Arc(old), Curve::Arc(new)) => old.clockwise != new.clockwise,
        _ => distance(&reversed) < distance(new),
    };
    if is_reversed { reversed } else { *new }
}

/// Returns the point midway between the ends of a curve, or the centre of a circle. It does not depend on the drawn direction.
pub(super) fn middle(shape: &Shape) -> Xy {
    match shape {
        Shape::Circle { centre, .. } => *centre,
        Shape::Curve(curve) => nalgebra::center(&curve.start(), &curve.end()),
    }
}

fn is_same(old: f64, new: f64) -> bool {
    (new - old).abs() <= EQUALITY_TOLERANCE
}

pub(super) fn is_negligible(by: Vector2<f64>) -> bool {
    by.norm() <= EQUALITY_TOLERANCE
}
