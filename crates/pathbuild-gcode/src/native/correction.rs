//! The formula that corrects a height by measured probes. (book: language/probes)

use pathbuild_toolpath::{Correction, Height, PlannedMove, ProbePoint, Program, ProgramStep, Surface};

use super::number::{push_exact, push_f3};

/// Number of the parameter for the first probe.
pub const FIRST_PARAMETER: usize = 51;

/// Writes formulas for the heights of a program with probes.
pub(super) struct Formulas<'a> {
    probes: &'a [ProbePoint],
    surface: Surface,
    /// Whether weights have three decimals, as in the original tool; that distorts planes.
    is_rounded: bool,
}

/// Weights below this are written as zero.
const NOTHING: f64 = 0.000_000_5;

impl<'a> Formulas<'a> {
    /// Returns `None` for a program without probes.
    pub(super) fn new(program: &'a Program, correction: Correction) -> Option<Self> {
        let places: Vec<_> = program.probes.iter().map(|probe| probe.at).collect();
        (!program.probes.is_empty()).then(|| Self {
            probes: &program.probes,
            surface: Surface::new(correction.model, &places),
            is_rounded: correction.is_compatible(),
        })
    }

    /// Appends `(=z+w*[#51-th]...)`.
    pub(super) fn push(&self, text: &mut String, height: Height) {
        text.push_str("(=");
        self.push_number(text, height.z);
        for (probe, weight) in self.surface.weights(height.at) {
            if !self.is_rounded && weight.abs() < NOTHING {
                continue;
            }
            text.push(if weight < 0.0 { '-' } else { '+' });
            self.push_number(text, weight.abs());
            text.push_str("*[#");
            text.push_str(&(FIRST_PARAMETER + probe).to_string());
            text.push('-');
            push_f3(text, self.probes[probe].height);
            text.push(']');
        }
        text.push(')');
    }

    /// The formula of a height, without its brackets.
    pub(super) fn text(&self, height: Height) -> String {
        let mut text = String::new();
        self.push(&mut text, height);
        text["(=".len()..text.len() - 1].to_owned()
    }

    /// Indices of the probes that do not correct any height of the given steps.
    pub(super) fn unused(&self, steps: &[ProgramStep]) -> Vec<usize> {
        let mut is_used = vec![false; self.probes.len()];
        for height in steps.iter().filter_map(height_of) {
            for (probe, weight) in self.surface.weights(height.at) {
                is_used[probe] |= self.is_rounded || weight.abs() >= NOTHING;
            }
        }
        (0..is_used.len()).filter(|probe| !is_used[*probe]).collect()
    }

    fn push_number(&self, text: &mut String, number: f64) {
        if self.is_rounded { push_f3(text, number) } else { push_exact(text, number) }
    }
}

/// The target height of a step, if it has one.
pub(super) fn height_of(step: &ProgramStep) -> Option<Height> {
    match step {
        ProgramStep::Move { to, .. } => match *to {
            PlannedMove::Sweep { .. } => None,
            PlannedMove::Lift { z }
            | PlannedMove::Drill { z, .. }
            | PlannedMove::Line { z, .. }
            | PlannedMove::Arc { z, .. } => Some(z),
        },
        ProgramStep::Comment(_) => None,
    }
}

/// Indices of the probes of a program that do not correct any height, because four others are nearer everywhere.
pub fn unused_probes(program: &Program, correction: Correction) -> Vec<usize> {
    let formulas = Formulas::new(program, correction);
    formulas.map_or_else(Vec::new, |formulas| formulas.unused(&correction.steps(program)))
}
