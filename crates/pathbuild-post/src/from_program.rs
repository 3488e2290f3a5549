//! Finished programs as a job: embedded paths become operations, drilled holes become holes.

use std::borrow::Borrow;
use std::f64::consts::PI;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_motion::{Arc, Pace, Path, Plane};
use pathbuild_path::approx::{at_least, near};
use pathbuild_toolpath::{Comment, ElementKind, Move, Names, Program, Step as ProgramStep};

use super::job::{Entry, Job, Operation, describe};
use super::step::{Hole, HoleKind, Step};
use super::tools::{Fitted, Fitter, ToolTable};

/// An arc that is shorter, in mm, may end, as a post prints it, where it begins: that would be a full circle, which cuts off the support
/// bars beside it. As a line it is the same but for less than any machine can tell.
const SHORTEST_ARC: f64 = 0.002;

impl Job {
    /// The programs one after the other, as one. Where O differs, or the tool table says so, the tool is changed in between.
    ///
    /// `pecks`: holes with C are drilled in goes of that depth; else in one, as the native program has it. What is doubtful about the
    /// tools is returned beside the job.
    pub fn from_programs(
        name: &str,
        programs: &[impl Borrow<Program>],
        tools: &ToolTable,
        pecks: bool,
    ) -> (Self, Vec<Diagnostic>) {
        let mut fitter = Fitter::new(tools);
        let operations = programs.iter().map(Borrow::borrow).flat_map(|program| {
            let fitted = fitter.fit(&program.path, program.tool);
            Builder::new(program, fitted, pecks).run()
        });
        let mut operations: Vec<Operation> = operations.collect();
        // On the way from one program to the next the tool is above everything that either is.
        let clearance =
            operations.iter().map(|operation| operation.clearance).fold(f64::NEG_INFINITY, f64::max);
        for operation in &mut operations {
            operation.clearance = clearance;
        }
        let drawing = programs.first().map_or("", |program| &program.borrow().drawing);
        (Self { name: name.into(), drawing: drawing.into(), operations, ..Self::default() }, fitter.warnings)
    }
}

/// Goes through a program and collects its operations.
struct Builder<'a> {
    program: &'a Program,
    fitted: Fitted,
    pecks: bool,
    /// The embedded paths that have begun, outermost first.
    embedded: Vec<&'a str>,
    operations: Vec<Operation>,
    at: [f64; 3],
    /// Upper face of the material of the elements since the last step.
    surface: Option<f64>,
}

impl<'a> Builder<'a> {
    fn new(program: &'a Program, fitted: Fitted, pecks: bool) -> Self {
        let at = [0.0, 0.0, program.sweep_height];
        let (embedded, operations) = (Vec::new(), Vec::new());
        Self { program, fitted, pecks, embedded, operations, at, surface: None }
    }

    fn run(mut self) -> Vec<Operation> {
        let mut rest = self.program.steps.as_slice();
        while let Some((step, after)) = rest.split_first() {
            rest = match step {
                ProgramStep::Comment(comment) => self.comment(comment, after),
                ProgramStep::Move { to, count } => {
                    self.go(to, count.length);
                    after
                }
            };
        }
        self.lift(self.program.sweep_height);
        let thickness = self.program.thickness;
        self.operations.iter_mut().for_each(|operation| describe(operation, thickness));
        self.operations
    }

    /// Returns the steps that are left: those of a hole are taken together.
    fn comment(&mut self, comment: &Comment, after: &'a [ProgramStep]) -> &'a [ProgramStep] {
        let names: &'a Names = &self.program.names;
        match *comment {
            Comment::StartSubpath(name) => self.embedded.push(names.get(name)),
            Comment::EndSubpath(_) => _ = self.embedded.pop(),
            Comment::Question(text) => {
                let text = format!("Q:{}", names.get(text)).into();
                self.operation().steps.push(Step::Comment(text));
            }
            Comment::Element { kind, surface, peck, .. } => {
                self.surface = Some(self.surface.map_or(surface, |known| known.max(surface)));
                if kind == ElementKind::DrilledHole {
                    return self.hole(peck, after).unwrap_or(after);
                }
            }
            Comment::Pass { .. } => {}
        }
        after
    }

    /// Takes the steps that drill a hole together and returns those behind them. There is no hole when the tool does not come from
    /// above the material, or goes on from the bottom.
    fn hole(&mut self, peck: Option<f64>, steps: &'a [ProgramStep]) -> Option<&'a [ProgramStep]> {
        let (remarks, steps) = comments(steps);
        let (retract, steps) = match steps.split_first()? {
            (ProgramStep::Move { to: Move::Lift { z }, .. }, rest) => (z.z, rest),
            _ => (self.at[2], steps),
        };
        let (ProgramStep::Move { to: Move::Drill { feed, z: bottom }, .. }, rest) = steps.split_first()?
        else {
            return None;
        };
        // The lift itself is left to whoever comes next: a step to where the tool is already.
        let exit = match comments(rest).1.first() {
            None => self.program.sweep_height,
            Some(ProgramStep::Move { to: Move::Lift { z }, .. }) => z.z,
            Some(_) => return None,
        };
        let [x, y, level] = self.at;
        let surface = self.surface.unwrap_or(self.program.thickness);
        if !(at_least(level, retract)
            && at_least(retract, surface)
            && at_least(exit, retract)
            && bottom.z < retract)
        {
            return None;
        }
        let kind = match peck {
            Some(depth) if self.pecks => HoleKind::Peck { depth },
            _ => HoleKind::Plain,
        };
        for remark in remarks {
            self.comment(remark, &[]);
        }
        let hole = Hole { at: [x, y], level, retract, bottom: bottom.z, exit, feed: Some(*feed), kind };
        let operation = self.operation();
        drop_way_between_holes(&mut operation.steps, &hole);
        operation.steps.push(Step::Hole(hole));
        self.at[2] = exit;
        Some(rest)
    }

    /// Makes a move that is so long in mm.
    fn go(&mut self, to: &Move, length: f64) {
        let from = self.at;
        let step = match *to {
            Move::Sweep { to } => return self.rapid([to.x, to.y, from[2]]),
            Move::Lift { z } => return self.lift(z.z),
            Move::Drill { feed, z } => {
                self.at[2] = z.z;
                Step::feed(self.at, Some(feed))
            }
            Move::Line { feed, to, z } => {
                self.at = [to.x, to.y, z.z];
                Step::feed(self.at, Some(feed))
            }
            Move::Arc { feed, to, z, .. } if length < SHORTEST_ARC => {
                self.at = [to.x, to.y, z.z];
                Step::feed(self.at, Some(feed))
            }
            Move::Arc { feed, clockwise, centre, to, z, .. } => {
                self.at = [to.x, to.y, z.z];
                let centre = [from[0] + centre.x, from[1] + centre.y];
                let arc = Arc { plane: Plane::Xy, centre, clockwise, extra_turns: 0 };
                let (from, to, path) = (from.into(), self.at.into(), Path::Arc(arc));
                let it = whole(
                    pathbuild_motion::Move { from, to, path, pace: Pace::Feed(feed), named: None },
                    length,
                );
                self.at = it.to.at;
                Step::Move(it)
            }
        };
        self.operation_from(from).steps.push(step);
    }

    fn lift(&mut self, z: f64) {
        self.rapid([self.at[0], self.at[1], z]);
    }

    fn rapid(&mut self, to: [f64; 3]) {
        let from = std::mem::replace(&mut self.at, to);
        if from != to {
            self.operation_from(from).steps.push(Step::rapid(to));
        }
    }

    fn operation(&mut self) -> &mut Operation {
        self.operation_from(self.at)
    }

    /// The operation of the embedded path that is under way; a new one when the last one is another path's.
    fn operation_from(&mut self, at: [f64; 3]) -> &mut Operation {
        let name = self.embedded.last().copied().unwrap_or(&self.program.path);
        if self.operations.last().is_none_or(|last| *last.name != *name) {
            let operation = self.new_operation(name, at);
            self.operations.push(operation);
        }
        let operation = self.operations.last_mut().expect("one was pushed if there was none");
        operation.surface = operation.surface.max(self.surface.take().unwrap_or(f64::NEG_INFINITY));
        operation
    }

    fn new_operation(&self, name: &str, at: [f64; 3]) -> Operation {
        let Fitted { tool, spindle, speed, coolant } = self.fitted.clone();
        Operation {
            part: self.program.path.clone(),
            spindle,
            speed,
            coolant,
            clearance: self.program.sweep_height,
            surface: f64::NEG_INFINITY,
            entry: Entry::At(at),
            ..Operation::new(name, tool)
        }
    }
}

/// An arc that is so long in mm. A full circle ends where it begins, also where the numbers of both come from two drawn elements and differ
/// by next to nothing: its angle would be nothing.
fn whole(it: pathbuild_motion::Move, length: f64) -> pathbuild_motion::Move {
    let is_whole = it.course().is_some_and(|course| length > (course.sweep() + PI) * course.radius());
    let [x, y, _] = it.from.at;
    if is_whole { pathbuild_motion::Move { to: [x, y, it.to.z()].into(), ..it } } else { it }
}

/// The comments at the beginning of some steps, and the steps after them.
fn comments(steps: &[ProgramStep]) -> (Vec<&Comment>, &[ProgramStep]) {
    let comments: Vec<&Comment> = steps.iter().map_while(as_comment).collect();
    let rest = &steps[comments.len()..];
    (comments, rest)
}

fn as_comment(step: &ProgramStep) -> Option<&Comment> {
    match step {
        ProgramStep::Comment(comment) => Some(comment),
        ProgramStep::Move { .. } => None,
    }
}

/// The way from one hole to the next at one level is part of drilling the next.
fn drop_way_between_holes(steps: &mut Vec<Step>, next: &Hole) {
    if let [.., Step::Hole(before), way] = steps.as_slice() {
        let [x, y] = next.at;
        if near(before.exit, next.level) && *way == Step::rapid([x, y, next.level]) {
            steps.pop();
        }
    }
}
