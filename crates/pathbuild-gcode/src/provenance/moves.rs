//! A hash of moves and formulas as they are printed, so that differences beyond the third decimal have no effect.

use blake3::{Hash, Hasher};
use pathbuild_toolpath::{Comment, Height, PlannedMove, ProbePoint, Program, ProgramStep, Xy};

/// The hash of the programs in a file. Comments are ignored, except those of the drawing for the operator.
pub(super) fn hash<'a>(programs: impl Iterator<Item = &'a Program>) -> Hash {
    let mut hasher = Hasher::new();
    for program in programs {
        let mut bytes = Bytes(Vec::with_capacity(48 * program.steps.len()));
        bytes.number(program.tool);
        bytes.number(program.sweep_height);
        program.steps.iter().for_each(|step| bytes.step(program, step));
        program.probes.iter().for_each(|probe| bytes.probe(probe));
        hasher.update(&(bytes.0.len() as u64).to_le_bytes());
        hasher.update(&bytes.0);
    }
    hasher.finalize()
}

struct Bytes(Vec<u8>);

impl Bytes {
    /// Adds a number in thousandths.
    #[expect(clippy::cast_possible_truncation, reason = "saturates far beyond any machine")]
    fn number(&mut self, number: f64) {
        let thousandths = (number * 1000.0).round_ties_even() as i64;
        self.0.extend(thousandths.to_le_bytes());
    }

    fn point(&mut self, point: Xy) {
        self.number(point.x);
        self.number(point.y);
    }

    /// Adds a height with the point that its formula is for.
    fn height(&mut self, height: Height) {
        self.number(height.z);
        self.point(height.at);
    }

    fn text(&mut self, text: &str) {
        self.0.extend((text.len() as u64).to_le_bytes());
        self.0.extend(text.as_bytes());
    }

    fn step(&mut self, program: &Program, step: &ProgramStep) {
        match *step {
            ProgramStep::Move { to, .. } => self.step_to(to),
            ProgramStep::Comment(Comment::Question(text)) => {
                self.0.push(b'Q');
                self.text(program.names.get(text));
            }
            ProgramStep::Comment(_) => {}
        }
    }

    fn step_to(&mut self, to: PlannedMove) {
        match to {
            PlannedMove::Sweep { to } => {
                self.0.push(b'S');
                self.point(to);
            }
            PlannedMove::Lift { z } => {
                self.0.push(b'Z');
                self.height(z);
            }
            PlannedMove::Drill { feed, z } => {
                self.0.push(b'D');
                self.number(feed);
                self.height(z);
            }
            PlannedMove::Line { feed, to, z } => {
                self.0.push(b'L');
                self.number(feed);
                self.point(to);
                self.height(z);
            }
            PlannedMove::Arc { feed, clockwise, centre, to, z, is_spiral } => {
                self.0.extend([b'A', clockwise.into(), is_spiral.into()]);
                self.number(feed);
                self.point(centre);
                self.point(to);
                self.height(z);
            }
        }
    }

    /// Adds a probe without its feed, which only affects the probing program.
    fn probe(&mut self, probe: &ProbePoint) {
        self.0.push(b'P');
        self.point(probe.at);
        self.point(probe.drawn_at);
        self.number(probe.height);
        self.text(probe.label.as_deref().unwrap_or_default());
    }
}
