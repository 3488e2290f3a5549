//! Where moves are corrected, and how they are cut for it. (book: language/probes)

use std::borrow::Cow;

use pathbuild_path::Xy;

use crate::pieces::{Cut, Tool};
use crate::program::{Class, Count, Height, Move, Program, Step};
use crate::z_model::{Tin, ZModel};

/// How the heights of a program with probes are corrected.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Correction {
    /// What the material is taken for between the probes.
    pub model: ZModel,
    /// The longest piece in mm that is corrected as one; 0: moves are never cut.
    pub longest: f64,
}

/// A place that is milled outside the probes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outside {
    /// Where, in the program.
    pub at: Xy,
    /// How far outside their hull, in mm.
    pub distance: f64,
}

/// Milling so little outside the probes, in mm, is not worth a word: the program's numbers have no more digits.
const NEGLIGIBLE: f64 = 0.001;

/// The piece length that is looked at for [`Correction::outside`], where moves are not cut.
const LOOKED_AT: f64 = 20.0;

impl Correction {
    /// Whether it is that of the original tool, which corrects a move by what holds where the move begins, and a helical circle by what
    /// holds at its centre.
    pub fn is_compatible(self) -> bool {
        self.model == ZModel::Idw4 && self.longest <= 0.0
    }

    /// The steps of a program with probes as they are corrected: cut, and each height corrected at its own move's end. Other programs,
    /// and those that are corrected as the original tool does, stay as they are.
    pub fn steps(self, program: &Program) -> Cow<'_, [Step]> {
        if program.probes.is_empty() || self.is_compatible() {
            return Cow::Borrowed(&program.steps);
        }
        Cow::Owned(cut(program, self.longest).collect())
    }

    /// How many steps [`steps`](Self::steps) gives, without making them; saturates.
    pub fn count(self, program: &Program) -> u64 {
        if program.probes.is_empty() || self.is_compatible() {
            return program.steps.len() as u64;
        }
        let steps = walk(program, self.longest).map(|(before, cut)| {
            u64::from(before.is_some()).saturating_add(cut.map_or(0, |cut| cut.pieces()))
        });
        steps.fold(0, u64::saturating_add)
    }

    /// Where the program mills farthest outside the probes, if it does. Only for models to which that matters.
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

/// The steps of a program, cut.
fn cut(program: &Program, longest: f64) -> impl Iterator<Item = Step> + '_ {
    walk(program, longest).flat_map(|(before, cut)| {
        let pieces = cut.into_iter().flat_map(|cut| (1..=cut.pieces()).map(move |number| cut.piece(number)));
        before.into_iter().chain(pieces)
    })
}

/// What becomes of each step: a step as it is written, and a move that may be cut.
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

/// After a sweep the tool still has the height of where it came from. What is milled from there on at once, as a helical circle is, has to
/// begin at the height of where it begins.
fn settle(tool: Tool) -> Step {
    let count = Count { class: Class::Sweep, length: 0.0, feed: None };
    Step::Move { to: Move::Lift { z: Height { z: tool.z, at: tool.at } }, count }
}

/// Where a step cuts material.
fn milled(step: &Step) -> Option<Xy> {
    match step {
        Step::Move { to: Move::Line { to, .. } | Move::Arc { to, .. }, .. } => Some(*to),
        Step::Move { to: Move::Drill { z: Height { at, .. }, .. }, .. } => Some(*at),
        _ => None,
    }
}
