//! Converts finished programs to a job: embedded paths become operations, drilled holes become holes.

use std::borrow::Borrow;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_motion as motion;
use pathbuild_motion::{Pace, Path};
use pathbuild_path::approx::{at_least, near};
use pathbuild_toolpath::{Comment, ElementKind, Move, Names, Program, Step as ProgramStep, ToolTip};

use super::job::{Entry, Job, Operation, describe};
use super::step::{Hole, HoleKind, Step};
use super::tools::{Fitter, ToolAssignment, ToolTable};

/// Arcs shorter than this, in mm, are written as lines. A post might print the same coordinates for both ends, which would be a full circle
/// that
/// cuts off the adjacent support bars. As a line the difference is less than any machine can resolve.
const SHORTEST_ARC: f64 = 0.002;

impl Job {
    /// Joins programs in the given order into one job. The tool is changed between them if O differs or the tool table requires it.
    ///
    /// With `pecks`, holes with C are drilled in pecks of that depth, otherwise in one go as in the native program. Warnings about the
    /// tools
    /// are returned with the job.
    pub fn from_programs(
        name: &str,
        programs: &[impl Borrow<Program>],
        tools: &ToolTable,
        pecks: bool,
    ) -> (Self, Vec<Diagnostic>) {
        let mut fitter = Fitter::new(tools);
        let operations = programs.iter().map(Borrow::borrow).flat_map(|program| {
            let assignment = fitter.fit(&program.path, program.tool);
            Builder::new(program, assignment, pecks).run()
        });
        let mut operations: Vec<Operation> = operations.collect();
        // Between two programs the tool is above everything in both.
        let clearance =
            operations.iter().map(|operation| operation.clearance).fold(f64::NEG_INFINITY, f64::max);
        for operation in &mut operations {
            operation.clearance = clearance;
        }
        let drawing = programs.first().map_or("", |program| &program.borrow().drawing);
        (Self { name: name.into(), drawing: drawing.into(), operations, ..Self::default() }, fitter.warnings)
    }
}

/// Converts a program to operations.
struct Builder<'a> {
    program: &'a Program,
    assignment: ToolAssignment,
    pecks: bool,
    /// The embedded paths that are open, outermost first.
    embedded: Vec<&'a str>,
    operations: Vec<Operation>,
    tool: ToolTip,
    /// Upper face of the material at the elements since the last step.
    surface: Option<f64>,
}

impl<'a> Builder<'a> {
    fn new(program: &'a Program, assignment: ToolAssignment, pecks: bool) -> Self {
        let tool = ToolTip::new(program.sweep_height);
        let (embedded, operations) = (Vec::new(), Vec::new());
        Self { program, assignment, pecks, embedded, operations, tool, surface: None }
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
        let last = self.tool.lift(self.program.sweep_height);
        self.push(last);
        let thickness = self.program.thickness;
        self.operations.iter_mut().for_each(|operation| describe(operation, thickness));
        self.operations
    }

    /// Handles a comment and returns the remaining steps. The steps of a hole are consumed together.
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

    /// Combines the steps that drill a hole and returns those after it. It is not a hole if the tool does not come from above the
    /// material, or continues from the bottom.
    fn hole(&mut self, peck: Option<f64>, steps: &'a [ProgramStep]) -> Option<&'a [ProgramStep]> {
        let (remarks, steps) = comments(steps);
        let (retract, steps) = match steps.split_first()? {
            (ProgramStep::Move { to: Move::Lift { z }, .. }, rest) => (z.z, rest),
            _ => (self.tool.at.z(), steps),
        };
        let (ProgramStep::Move { to: Move::Drill { feed, z: bottom }, .. }, rest) = steps.split_first()?
        else {
            return None;
        };
        // The lift itself is left to the next step, for which the tool is then already at its target.
        let exit = match comments(rest).1.first() {
            None => self.program.sweep_height,
            Some(ProgramStep::Move { to: Move::Lift { z }, .. }) => z.z,
            Some(_) => return None,
        };
        let [x, y, level] = self.tool.at.at;
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
        self.tool.lift(exit);
        Some(rest)
    }

    /// Adds a move whose length is given in mm.
    fn go(&mut self, to: &Move, length: f64) {
        let mut movement = self.tool.go(to, length);
        if length < SHORTEST_ARC {
            movement.path = Path::Line;
        }
        self.push(movement);
    }

    /// Adds a move; a rapid one only if it leads somewhere.
    fn push(&mut self, movement: motion::Move) {
        if movement.pace != Pace::Rapid || !movement.is_nothing() {
            self.operation_from(movement.from.at).steps.push(Step::Move(movement));
        }
    }

    fn operation(&mut self) -> &mut Operation {
        self.operation_from(self.tool.at.at)
    }

    /// Returns the operation of the current embedded path, creating it if the last one belongs to another path.
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
        let ToolAssignment { tool, spindle, speed, coolant } = self.assignment.clone();
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

/// Splits the comments at the beginning off some steps.
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

/// Removes the way between two holes at the same level, which is part of drilling the second one.
fn drop_way_between_holes(steps: &mut Vec<Step>, next: &Hole) {
    if let [.., Step::Hole(before), Step::Move(way)] = steps.as_slice() {
        let [x, y] = next.at;
        let leads_there = way.pace == Pace::Rapid && way.to.at == [x, y, next.level];
        if near(before.exit, next.level) && leads_there {
            steps.pop();
        }
    }
}
