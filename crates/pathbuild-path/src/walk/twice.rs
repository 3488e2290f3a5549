//! Finds segments that are drawn twice.

use std::collections::BTreeMap;

use super::ends::{Ends, Square, Squares, square};
use crate::approx::{coincide, near};
use crate::path::{Path, SegmentKind};

/// Milled curves and sweeps, indexed by their ends.
pub(super) struct Curves<'a> {
    path: &'a Path,
    ends: &'a Ends,
    known: BTreeMap<[Square; 2], Vec<(f64, usize)>>,
}

impl<'a> Curves<'a> {
    /// Collects the milled curves and sweeps among these segments.
    pub(super) fn new(path: &'a Path, ends: &'a Ends, segments: impl Iterator<Item = usize>) -> Self {
        let mut known: BTreeMap<_, Vec<(f64, usize)>> = BTreeMap::new();
        for segment in segments {
            if let Some(length) = length(path, segment) {
                known.entry(ends.of(segment).map(square)).or_default().push((length, segment));
            }
        }
        for curves in known.values_mut() {
            curves.sort_unstable_by(|(a, _), (b, _)| a.total_cmp(b));
        }
        Self { path, ends, known }
    }

    /// Whether another one of the curves coincides with a segment, in either direction.
    pub(super) fn have_another(&self, segment: usize) -> bool {
        let [start, end] = self.ends.of(segment);
        length(self.path, segment).is_some_and(|length| {
            [[start, end], [end, start]].iter().any(|ends| {
                let others = Squares::around(ends[0]).each().flat_map(|first| {
                    Squares::around(ends[1]).each().filter_map(move |second| self.known.get(&[first, second]))
                });
                others.flat_map(|curves| near_in(curves, length)).any(|other| {
                    let drawn = self.ends.of(other);
                    other != segment
                        && self.is_sweep(other) == self.is_sweep(segment)
                        && coincide(drawn[0], ends[0])
                        && coincide(drawn[1], ends[1])
                })
            })
        })
    }
}

impl Curves<'_> {
    fn is_sweep(&self, segment: usize) -> bool {
        matches!(self.path.segments[segment].kind, SegmentKind::Sweep { .. })
    }
}

/// The curves of a given length in a list sorted by length.
fn near_in(curves: &[(f64, usize)], length: f64) -> impl Iterator<Item = usize> {
    let first = curves.partition_point(|(other, _)| *other < length && !near(*other, length));
    curves[first..].iter().take_while(move |(other, _)| near(*other, length)).map(|(_, segment)| *segment)
}

fn length(path: &Path, segment: usize) -> Option<f64> {
    let segment = &path.segments[segment];
    match segment.kind {
        SegmentKind::Cut(_) | SegmentKind::Sweep { .. } => path.curve(segment).map(|curve| curve.length()),
        _ => None,
    }
}
