//! Estimates the number of moves of a path before they are computed, so that limits can be checked first.

use std::ptr;

use pathbuild_path::{Bars, Chain, ChainSegment, CutParameters, Helix, Item, Path, WalkedPath};

use crate::program::Step;

/// Approximate number of moves of a path without its embedded paths: never less than half the real number; saturates.
pub fn own_moves(path: &Path, walked: &WalkedPath) -> u64 {
    walked.items.iter().map(|item| moves(path, walked, item)).fold(0, u64::saturating_add)
}

/// Approximate memory in bytes for this number of moves in a program, each with a comment.
pub fn memory(moves: u64) -> u64 {
    moves.saturating_mul(2 * size_of::<Step>() as u64)
}

fn moves(path: &Path, walked: &WalkedPath, item: &Item) -> u64 {
    match item {
        Item::Chain(chain) => chain_moves(path, chain, walked.members(chain)),
        Item::Helix { helix, .. } => helix_moves(path, &path.helices[*helix as usize]),
        Item::Hole { .. } | Item::Sweep(_) | Item::Subpath(_) => 4,
    }
}

fn chain_moves(path: &Path, chain: &Chain, members: &[ChainSegment]) -> u64 {
    let first = chain.first_depth.unwrap_or(path.thickness);
    // Consecutive segments usually share their parameters.
    let mut last: Option<(&CutParameters, u64)> = None;
    let segments = members.iter().map(|member| {
        let cut = member.cut(path);
        let known = last.filter(|(known, _)| ptr::eq(*known, cut));
        let (_, passes) =
            *last.insert(known.unwrap_or_else(|| (cut, passes(first - cut.bottom, chain.infeed))));
        let sections = cut.bars.map_or(1, |bars| sections(&bars, member.curve(path).length()));
        passes.saturating_mul(sections.saturating_add(1))
    });
    let once = segments.fold(0, u64::saturating_add);
    if chain.first_depth.is_some() { once.saturating_mul(2) } else { once }
}

fn helix_moves(path: &Path, helix: &Helix) -> u64 {
    let spiral = passes(path.thickness - helix.bottom, helix.infeed).saturating_mul(2);
    let with_bars = helix.bars.map_or(0, |(depth, bars)| {
        let length = std::f64::consts::TAU * helix.axis_radius(path.tool);
        passes(helix.bottom - depth, helix.infeed).saturating_mul(sections(&bars, length))
    });
    spiral.saturating_add(with_bars)
}

/// The sections of a segment with bars: each gap is a slope, a low section, a slope and the next bar.
fn sections(bars: &Bars, length: f64) -> u64 {
    whole(4.0 * bars.count(length) + 1.0)
}

fn passes(depth: f64, infeed: f64) -> u64 {
    whole((depth / infeed).ceil().max(0.0)).saturating_add(1)
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "saturates, and is never negative"
)]
fn whole(number: f64) -> u64 {
    number as u64
}
