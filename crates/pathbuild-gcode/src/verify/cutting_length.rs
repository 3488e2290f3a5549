//! Checks the depth of a program's cuts against the cutting edges of its tools. (book: reference/configuration, `[tool]`)

use pathbuild_diagnostic::Diagnostic;
use pathbuild_motion::{Action, Step, check_cutting_length};

use super::{ByTool, Stock, tool_at};
use crate::read::Problems;

/// Rule that finds cuts deeper than the cutting edges of their tools are long: pass every step of a program, then call [`finish`](Self::finish). The
/// deepest cut of each tool is reported.
#[derive(Debug)]
pub struct CuttingLengthRules<'s> {
    /// The material; `None` if its height is unknown, so that nothing is checked.
    stock: Option<&'s Stock>,
    /// The lengths in mm of the tools' cutting edges, if known.
    tools: ByTool<Option<f64>>,
    /// For each tool, the deepest cut.
    deepest: Vec<Option<DeepestCut>>,
}

#[derive(Clone, Copy, Debug)]
struct DeepestCut {
    line: u32,
    bottom: f64,
    surface: f64,
}

impl<'s> CuttingLengthRules<'s> {
    /// Creates the rule for the lengths in mm of the tools' cutting edges, if known.
    pub fn new(tools: ByTool<Option<f64>>, stock: Option<&'s Stock>) -> Self {
        Self { stock, deepest: vec![None; tools.len()], tools }
    }

    /// Processes the next step of the program.
    pub fn step(&mut self, step: &Step) {
        let Action::Move(movement) = &step.action else { return };
        let (true, [.., Some((bottom, _))]) = (movement.pace.feed().is_some(), movement.extent()) else {
            return;
        };
        let tool = tool_at(&self.tools, step.order);
        let surface = self.stock.and_then(|stock| stock.at(step.order)).map(|span| span.surface);
        let (Some(tool), Some(surface)) = (tool, surface) else { return };
        let deepest = &mut self.deepest[tool];
        if deepest.is_none_or(|deepest| surface - bottom > deepest.surface - deepest.bottom) {
            *deepest = Some(DeepestCut { line: step.line, bottom, surface });
        }
    }

    /// Returns all findings, ordered by line.
    pub fn finish(self) -> Vec<Diagnostic> {
        let mut problems = Problems::default();
        for ((_, length), deepest) in self.tools.into_iter().zip(self.deepest) {
            let Some((length, DeepestCut { line, bottom, surface })) = length.zip(deepest) else { continue };
            if let Some(problem) = check_cutting_length(length, bottom, surface) {
                problems.add_at_line(problem.message, line, |_| problem);
            }
        }
        problems.into_diagnostics()
    }
}
