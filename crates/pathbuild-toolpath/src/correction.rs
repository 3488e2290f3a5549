//! Which moves are corrected by probes, and how they are split for that. (book: language/probes)

use std::borrow::Cow;

use pathbuild_path::Xy;

use crate::pieces::{Cut, Tool};
use crate::program::{Class, Count, Height, Move, Program, Step};
use crate::z_model::{Tin, ZModel};

/// How the heights of a program with probes are corrected.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Correction {
    /// Model of the surface between the probes.
    pub model: ZModel,
    /// Maximum length in mm of a part that is corrected as a whole; with 0, moves are never split.
    pub longest: f64,
}

/// A point outside the probes at which the program mills.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outside {
    /// The point in program coordinates.
    pub at: Xy,
    /// Distance from the convex hull of the probes, in mm.
    pub distance: f64,
}

/// Milling less than this far outside the probes, in mm, is not reported. Numbers in programs are not more precise.
const NEGLIGIBLE: f64 = 0.001;

/// Part length used for [`Correction::outside`] if moves are not split.
const LOOKED_AT: f64 = 20.0;

impl Correction {
    /// Whether the correction is that of the original tool, which corrects a move by the value at its start, and a helical circle by the
    /// value at its centre.
    pub fn is_compatible(self) -> bool {
        self.model == ZModel::Idw4 && self.longest <= 0.0
    }

    /// The steps of a program with probes, split and with each height corrected at the end of its move. Programs without probes, and those
    /// corrected as by the original tool, are returned unchanged.
    pub fn steps(self, program: &Program) -> Cow<'_, [Step]> {
        if program.probes.is_empty() || self.is_compatible() {
            return Cow::Borrowed(&program.steps);
        }
        Cow::Owned(cut(program, self.longest).collect())
    }

    /// Number of steps returned by [`steps`](Self::steps), without computing them; saturates.
    pub fn count(self, program: &Program) -> u64 {
        if program.probes.is_empty() || self.is_compatible() {
            return program.steps.len() as u64;
        }
        let steps = walk(program, self.longest).map(|(before, cut)| {
            u64::from(before.is_some()).saturating_add(cut.map_or(0, |cut| cut.pieces()))
        });
        steps.fold(0, u64::saturating_add)
    }

    /// The point at which the program mills farthest outside the probes, if there is one. Only for models whose values there are
    /// unreliable.
    pub fn outside(self, program: &Program) -> Option<Outside> {
        if program.probes.is_empty() || self.model == ZModel::Idw4 {
            return None;
        }
        let places: Vec<Xy> = program.probes.iter().map(|probe| probe.at).collect();
        let hull = Tin::new(&places);
        let longest = if self.longest > 0.0 { self.longest } else { LOOKED_AT };
        let milled = cut(program, longest).filter_map(|step| milled(&step));
        let distances = milled.map(|at| Outside { at, distance: hull.distance(at) });
        let farthest = distances.reduce(|far, other| if other.distance > far.distance { other } else { far });
        farthest.filter(|outside| outside.distance > NEGLIGIBLE)
    }
}

/// The steps of a program after splitting.
fn cut(program: &Program, longest: f64) -> impl Iterator<Item = Step> + '_ {
    walk(program, longest).flat_map(|(before, cut)| {
        let pieces = cut.into_iter().flat_map(|cut| (1..=cut.pieces()).map(move |number| cut.piece(number)));
        before.into_iter().chain(pieces)
    })
}

/// Yields each step, either as it is or as a move to be split.
fn walk(program: &Program, longest: f64) -> impl Iterator<Item = (Option<Step>, Option<Cut>)> {
    let mut tool = Tool { at: Xy::origin(), z: program.start_height() };
    let mut is_settled = true;
    program.steps.iter().map(move |step| match step {
        Step::Comment(_) => (Some(*step), None),
        Step::Move { to, count } => {
            let begins_here = matches!(to, Move::Line { .. } | Move::Arc { .. });
            let settling = (begins_here && !is_settled).then(|| settle(tool));
            is_settled = !matches!(to, Move::Sweep { .. });
            let cut = Cut::new(tool, *to, *count, longest);
            tool = cut.end();
            (settling, Some(cut))
        }
    })
}

/// After a sweep the tool is still at the corrected height of its previous position. A step that mills at once, such as a helical
/// circle, must begin at the height corrected for its own position.
fn settle(tool: Tool) -> Step {
    let count = Count { class: Class::Sweep, length: 0.0, feed: None };
    Step::Move { to: Move::Lift { z: Height { z: tool.z, at: tool.at } }, count }
}

/// The point at which a step cuts material.
fn milled(step: &Step) -> Option<Xy> {
    match step {
        Step::Move { to: Move::Line { to, .. } | Move::Arc { to, .. }, .. } => Some(*to),
        Step::Move { to: Move::Drill { z: Height { at, .. }, .. }, .. } => Some(*at),
        _ => None,
    }
}
