//! Pairs the elements of two versions of a path.

use std::cmp::Reverse;
use std::collections::{BTreeMap, HashMap, VecDeque};
use std::hash::Hash;

use nalgebra::Vector2;
use pathbuild_diagnostic::Handle;

use super::ElementKind;
use super::item::{Item, is_equal, is_negligible, middle};
use crate::element::Shape;
use crate::geometry::{Curve, Xy};

/// The frame of a comparison: how far the whole path was moved on its sheet.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    pub(super) shift: Vector2<f64>,
}

/// The paired elements, and the elements of either side that have no counterpart.
#[derive(Debug, Default)]
pub(super) struct PairedElements<'i> {
    pub(super) both: Vec<(&'i Item<'i>, &'i Item<'i>)>,
    pub(super) removed: Vec<&'i Item<'i>>,
    pub(super) added: Vec<&'i Item<'i>>,
}

impl PairedElements<'_> {
    /// Whether some paired elements are in a different order in the two files.
    pub(super) fn is_reordered(&self) -> bool {
        let elements = self.both.iter().filter(|(old, _)| old.role.is_some());
        let mut numbers: Vec<[usize; 2]> = elements.map(|(old, new)| [new.number, old.number]).collect();
        numbers.sort_unstable();
        !numbers.is_sorted_by_key(|[_, old]| *old)
    }
}

impl Frame {
    /// Determines the most frequent shift of elements if the start was moved and at least two elements share the shift. Otherwise there is no shift.
    pub(super) fn between(old: &[Item<'_>], new: &[Item<'_>]) -> Self {
        let start =
            |items: &[Item<'_>]| items.iter().find(|item| item.kind == ElementKind::Start).map(Item::at);
        let is_moved = match (start(old), start(new)) {
            (Some(old), Some(new)) => !is_negligible(new - old),
            _ => false,
        };
        let shift = is_moved.then(|| common_shift(old, new)).flatten();
        Self { shift: shift.unwrap_or_default() }
    }
}

/// Returns the most frequent shift between elements of the same kind, form and text, if at least two share it. Of equally frequent shifts, the
/// shortest is returned.
fn common_shift(old: &[Item<'_>], new: &[Item<'_>]) -> Option<Vector2<f64>> {
    let mut by_form: BTreeMap<_, [Vec<Xy>; 2]> = BTreeMap::new();
    for (side, items) in [old, new].into_iter().enumerate() {
        for item in items {
            let Outline { first, form } = Outline::from_shape(&item.shape);
            by_form.entry((item.kind, form, item.text.as_str())).or_default()[side].push(first);
        }
    }
    let mut votes: BTreeMap<Micrometres, (usize, Vector2<f64>)> = BTreeMap::new();
    for [mut old, mut new] in by_form.into_values() {
        if old.len() != new.len() {
            continue;
        }
        old.sort_by_key(|point| micrometres(point.coords));
        new.sort_by_key(|point| micrometres(point.coords));
        for (old, new) in old.iter().zip(&new) {
            let by = new - old;
            votes.entry(micrometres(by)).or_insert((0, by)).0 += 1;
        }
    }
    let by_count = |(count, by): &(usize, Vector2<f64>)| (*count, Reverse(length(*by)));
    votes.into_values().filter(|(count, _)| *count > 1).max_by_key(by_count).map(|(_, by)| by)
}

/// Pairs elements by one criterion after another, from the most to the least reliable.
pub(super) fn pair<'i>(old: &'i [Item<'i>], new: &'i [Item<'i>], frame: &Frame) -> PairedElements<'i> {
    let mut pairing = Pairing {
        old: old.iter().collect(),
        new: new.iter().collect(),
        both: Vec::with_capacity(old.len()),
        shift: frame.shift,
    };
    pairing.pair_by_key(|item, placed| Some((placed, item.effect())));
    pairing.pair_by_key(|_, placed| Some(placed));
    pairing.pair_by_rounded_place();
    if pairing.has_lasting_handles() {
        pairing.pair_by_handle();
    }
    pairing.pair_by_key(|item, _| {
        matches!(item.kind, ElementKind::Start | ElementKind::End).then_some(item.kind)
    });
    pairing.pair_by_form();
    pairing.pair_by_key(|item, placed| centre(item, placed));
    pairing.pair_by_key(|item, placed| ends(item, placed).map(|ends| (item.kind, ends)));
    pairing.pair_by_shared_end();
    PairedElements { both: pairing.both, removed: pairing.old, added: pairing.new }
}

/// The elements that are not paired yet, and the pairs.
struct Pairing<'i> {
    old: Vec<&'i Item<'i>>,
    new: Vec<&'i Item<'i>>,
    both: Vec<(&'i Item<'i>, &'i Item<'i>)>,
    shift: Vector2<f64>,
}

impl<'i> Pairing<'i> {
    /// Pairs elements with equal keys, each old one with the first new one that is left.
    fn pair_by_key<K: Eq + Hash>(&mut self, key: impl Fn(&'i Item<'i>, PlacedForm) -> Option<K>) {
        let mut known: HashMap<K, VecDeque<usize>> = HashMap::new();
        for (index, item) in self.new.iter().enumerate() {
            if let Some(key) = key(item, PlacedForm::new(item, Vector2::zeros())) {
                known.entry(key).or_default().push_back(index);
            }
        }
        let shift = self.shift;
        self.pair_with(|_, old| {
            let key = key(old, PlacedForm::new(old, shift))?;
            known.get_mut(&key)?.pop_front()
        });
    }

    /// Pairs each old element with the new element at the index that `find` returns. `find` must not return an index twice.
    fn pair_with(&mut self, mut find: impl FnMut(&[&'i Item<'i>], &'i Item<'i>) -> Option<usize>) {
        let mut is_taken = vec![false; self.new.len()];
        let (new, both) = (&self.new, &mut self.both);
        self.old.retain(|old| match find(new, old) {
            Some(index) => {
                is_taken[index] = true;
                both.push((old, new[index]));
                false
            }
            None => true,
        });
        let mut is_taken = is_taken.into_iter();
        self.new.retain(|_| !is_taken.next().unwrap_or_default());
    }

    /// Pairs elements that differ only because their coordinates were rounded.
    fn pair_by_rounded_place(&mut self) {
        let mut cells: HashMap<(ElementKind, [i64; 2]), Vec<usize>> = HashMap::new();
        for (index, item) in self.new.iter().enumerate() {
            cells.entry((item.kind, cell(middle(&item.shape)))).or_default().push(index);
        }
        let shift = self.shift;
        self.pair_with(|new, old| {
            let [x, y] = cell(middle(&old.shape) + shift);
            let around = [-1, 0, 1]
                .into_iter()
                .flat_map(|dx| [-1, 0, 1].map(|dy| [x.saturating_add(dx), y.saturating_add(dy)]));
            for cell in around {
                let Some(there) = cells.get_mut(&(old.kind, cell)) else { continue };
                let is_there = |index: &usize| is_equal(&old.shape, &new[*index].shape, shift);
                if let Some(found) = there.iter().take(MAX_CANDIDATES).position(is_there) {
                    return Some(there.swap_remove(found));
                }
            }
            None
        });
    }

    /// Whether the CAD program has kept the handles of elements: at least nine in ten elements that were not moved have their old handle. A few
    /// equal handles prove nothing: a program that renumbers elements does not change those before the first new one.
    fn has_lasting_handles(&self) -> bool {
        let handles = self.both.iter().filter_map(|(old, new)| Some((old.handle?, new.handle?)));
        let (kept, all) =
            handles.fold((0, 0), |(kept, all), (old, new)| (kept + usize::from(old == new), all + 1));
        all > 0 && 10 * kept >= 9 * all
    }

    /// Pairs elements with equal handles, unless they have another role and no end in common: then the CAD program has given the handle to another
    /// element.
    fn pair_by_handle(&mut self) {
        let mut known: HashMap<(ElementKind, Handle), usize> = HashMap::new();
        for (index, item) in self.new.iter().enumerate() {
            known.extend(item.handle.map(|handle| ((item.kind, handle), index)));
        }
        let shift = self.shift;
        self.pair_with(|new, old| {
            let key = (old.kind, old.handle?);
            let found = new[*known.get(&key)?];
            let is_same = found.role == old.role || has_common_end(old, found, shift);
            is_same.then(|| known.remove(&key)).flatten()
        });
    }

    /// Pairs elements of the same form, role and text that are at different places.
    fn pair_by_form(&mut self) {
        let mut groups: BTreeMap<_, [Vec<usize>; 2]> = BTreeMap::new();
        for (side, items) in [&self.old, &self.new].into_iter().enumerate() {
            for (index, item) in items.iter().enumerate() {
                let key = (item.kind, Outline::from_shape(&item.shape).form, item.role, item.text.as_str());
                groups.entry(key).or_default()[side].push(index);
            }
        }
        let mut counterparts = vec![None; self.old.len()];
        for [mut were, mut are] in groups.into_values() {
            let place = |item: &Item<'_>| micrometres(item.at().coords);
            if were.len() == are.len() {
                // Elements that have moved together have kept their order.
                were.sort_by_key(|index| place(self.old[*index]));
                are.sort_by_key(|index| place(self.new[*index]));
                were.into_iter().zip(are).for_each(|(was, is)| counterparts[was] = Some(is));
                continue;
            }
            for was in were {
                let from = self.old[was].at() + self.shift;
                let distance = |place: &usize| length(self.new[are[*place]].at() - from);
                let nearest = (0..are.len().min(MAX_CANDIDATES)).min_by_key(distance);
                counterparts[was] = nearest.map(|place| are.swap_remove(place));
            }
        }
        let mut counterparts = counterparts.into_iter();
        self.pair_with(|_, _| counterparts.next().flatten());
    }

    fn pair_by_shared_end(&mut self) {
        let mut at_end: HashMap<(ElementKind, Micrometres), Vec<usize>> = HashMap::new();
        for (index, item) in self.new.iter().enumerate() {
            for end in ends(item, PlacedForm::new(item, Vector2::zeros())).into_iter().flatten() {
                at_end.entry((item.kind, end)).or_default().push(index);
            }
        }
        let mut is_taken = vec![false; self.new.len()];
        let shift = self.shift;
        self.pair_with(|new, old| {
            let ends = ends(old, PlacedForm::new(old, shift))?;
            let candidates = ends.iter().filter_map(|end| at_end.get(&(old.kind, *end)));
            let open = candidates.flat_map(|indices| indices.iter().take(MAX_CANDIDATES));
            let open = open.filter(|index| !is_taken[**index] && new[**index].role == old.role);
            let distance = |index: &&usize| length(middle(&new[**index].shape) - middle(&old.shape) - shift);
            let nearest = *open.min_by_key(distance)?;
            is_taken[nearest] = true;
            Some(nearest)
        });
    }
}

/// Maximum number of candidates that are compared to find the nearest one, so that hostile drawings do not take quadratic time.
const MAX_CANDIDATES: usize = 64;

/// A vector rounded to whole micrometres, the last digit that programs show.
type Micrometres = [i64; 2];

/// The outline of an element: one of its points, and its form relative to that point. Neither depends on the direction in which it is drawn.
#[derive(Debug)]
struct Outline {
    first: Xy,
    form: Form,
}

/// The form of an element: its radius, and up to two further points relative to its first one. Unused values are 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
struct Form {
    radius: i64,
    points: [Micrometres; 2],
}

/// The kind, form and place of an element, as a key.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct PlacedForm {
    kind: ElementKind,
    form: Form,
    first: Micrometres,
}

impl Outline {
    fn from_shape(shape: &Shape) -> Self {
        let form = |radius: f64, points: [Vector2<f64>; 2]| Form {
            radius: micrometre(radius),
            points: points.map(micrometres),
        };
        match shape {
            Shape::Circle { centre, radius } => {
                Self { first: *centre, form: form(*radius, [Vector2::zeros(); 2]) }
            }
            Shape::Curve(Curve::Line(line)) => {
                let along = line.end - line.start;
                let is_backwards = micrometres(along) < [0, 0];
                let (first, along) = if is_backwards { (line.end, -along) } else { (line.start, along) };
                Self { first, form: form(0.0, [along, Vector2::zeros()]) }
            }
            Shape::Curve(Curve::Arc(arc)) => {
                let (first, last) = if arc.clockwise { (arc.end, arc.start) } else { (arc.start, arc.end) };
                Self { first, form: form(arc.radius, [last - first, arc.centre - first]) }
            }
        }
    }
}

impl PlacedForm {
    /// Returns the kind, form and place of an element after a shift.
    fn new(item: &Item<'_>, shift: Vector2<f64>) -> Self {
        let Outline { first, form } = Outline::from_shape(&item.shape);
        Self { kind: item.kind, form, first: micrometres(first.coords + shift) }
    }
}

/// Returns the centre of a circle; `None` for other elements.
fn centre(item: &Item<'_>, placed: PlacedForm) -> Option<Micrometres> {
    (item.kind == ElementKind::Circle).then_some(placed.first)
}

/// Returns both ends of a line or arc, in a fixed order.
fn ends(item: &Item<'_>, placed: PlacedForm) -> Option<[Micrometres; 2]> {
    matches!(item.kind, ElementKind::Line | ElementKind::Arc).then(|| {
        let ([x, y], [along, up]) = (placed.first, placed.form.points[0]);
        let mut ends = [[x, y], [x.saturating_add(along), y.saturating_add(up)]];
        ends.sort_unstable();
        ends
    })
}

/// Whether two lines or arcs have an end in common after a shift of the old one, or two circles their centre.
fn has_common_end(old: &Item<'_>, new: &Item<'_>, shift: Vector2<f64>) -> bool {
    let points = |item: &Item<'_>, shift| {
        let placed = PlacedForm::new(item, shift);
        ends(item, placed).unwrap_or([placed.first; 2])
    };
    let new = points(new, Vector2::zeros());
    points(old, shift).iter().any(|point| new.contains(point))
}

fn micrometres(vector: Vector2<f64>) -> Micrometres {
    [vector.x, vector.y].map(micrometre)
}

#[expect(clippy::cast_possible_truncation, reason = "saturates")]
fn micrometre(value: f64) -> i64 {
    (value * 1000.0).round() as i64
}

/// Returns the cell of a point in a grid of a hundredth of a millimetre.
#[expect(clippy::cast_possible_truncation, reason = "saturates")]
fn cell(point: Xy) -> [i64; 2] {
    [point.x, point.y].map(|value| (value * 100.0).floor() as i64)
}

fn length(by: Vector2<f64>) -> i64 {
    micrometre(by.norm())
}
