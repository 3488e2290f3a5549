//! Numbers derived from moves and clamps.

use super::Sheet;
use crate::scene::{KeepOut, Move, MoveKind, Point, Shape};
use crate::svg::frame::widen;

/// Lower left and upper right corner.
pub(super) type Corners = [Point; 2];

/// The bounding box of the removed material seen from above; `None` without cuts.
pub(super) fn cleared(sheet: &Sheet) -> Option<Corners> {
    let mut corners = None;
    for path in &sheet.scene.paths {
        let radius = path.tool.unwrap_or_default() / 2.0;
        let cuts = path.moves.iter().filter(|movement| movement.kind.cuts()).filter_map(Move::extent);
        for [low, high] in cuts {
            widen(
                &mut corners,
                [low.map(|coordinate| coordinate - radius), high.map(|coordinate| coordinate + radius)],
            );
        }
    }
    corners
}

/// The bounding box of the picture.
pub(super) fn seen(sheet: &Sheet) -> Corners {
    let mut corners = cleared(sheet);
    widen(&mut corners, [[0.0; 2]; 2]);
    for path in &sheet.scene.paths {
        for extent in path.moves.iter().filter_map(Move::extent) {
            widen(&mut corners, extent);
        }
    }
    for at in sheet.probes.iter().map(|probe| probe.at) {
        widen(&mut corners, [at, at]);
    }
    for clamp in &sheet.scene.keep_outs {
        widen(&mut corners, outline(clamp));
    }
    corners.unwrap_or_default()
}

/// The bounding box of a clamp.
pub(super) fn outline(clamp: &KeepOut) -> Corners {
    let mut corners = None;
    for extent in clamp.outline.iter().map(Shape::extent) {
        widen(&mut corners, extent);
    }
    corners.unwrap_or_default()
}

/// The feeds in mm/min of some kinds of moves, in ascending order.
pub(super) fn feeds(sheet: &Sheet, is_meant: impl Fn(MoveKind) -> bool) -> Vec<f64> {
    let moves = sheet.scene.paths.iter().flat_map(|path| &path.moves);
    let mut feeds: Vec<f64> = moves
        .filter(|movement| is_meant(movement.kind))
        .filter_map(|movement| movement.way.pace.feed())
        .collect();
    feeds.sort_by(f64::total_cmp);
    feeds.dedup();
    feeds
}

/// Heights of rapid moves.
#[derive(Debug, PartialEq)]
pub(super) struct RapidHeights {
    /// Of moves in the plane, in ascending order.
    pub(super) across: Vec<f64>,
    /// The lowest end of moves straight down.
    pub(super) down: Option<f64>,
    /// The lowest end of moves straight up.
    up: Option<f64>,
}

impl RapidHeights {
    pub(super) fn lowest(&self) -> Option<f64> {
        self.across.iter().copied().chain(self.down).chain(self.up).reduce(f64::min)
    }
}

pub(super) fn rapid_heights(sheet: &Sheet) -> RapidHeights {
    let moves = || sheet.scene.paths.iter().flat_map(|path| &path.moves);
    let sweeps = moves().filter(|movement| movement.kind == MoveKind::Sweep);
    let mut across: Vec<f64> = sweeps.filter_map(Move::depth).collect();
    across.sort_by(f64::total_cmp);
    across.dedup();
    let lowest_end = |is_down: bool| {
        let lifts = moves().filter(|movement| movement.kind == MoveKind::Lift);
        let lifts = lifts.filter(|movement| (movement.way.to.z() < movement.way.from.z()) == is_down);
        lifts.map(|movement| movement.way.to.z()).reduce(f64::min)
    };
    RapidHeights { across, down: lowest_end(true), up: lowest_end(false) }
}

/// The values of all paths without duplicates, in order of the paths.
pub(super) fn distinct<T: PartialEq>(values: impl Iterator<Item = T>) -> Vec<T> {
    let mut distinct = Vec::new();
    for value in values {
        if !distinct.contains(&value) {
            distinct.push(value);
        }
    }
    distinct
}
