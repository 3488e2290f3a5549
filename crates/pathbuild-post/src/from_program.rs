//! Converts finished programs to a job. Embedded paths become operations, drilled holes become holes, and cutters get the tools of the
//! tool table.

use std::borrow::Borrow;
use std::collections::HashSet;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::posts;
use pathbuild_motion as motion;
use pathbuild_motion::{Coolant, MoveShape, Pace, Turning};
use pathbuild_path::approx::{at_least, near};
use pathbuild_toolpath::{Comment, ElementKind, Names, PlannedMove, Program, ProgramStep, ToolTip};
use regex::Regex;

use crate::job::{Entry, Hole, HoleKind, Job, JobStep, Operation, Tool, derive_feeds_and_depths};

/// Length in mm below which arcs are written as lines. A post might print the same coordinates for both ends of such an arc, which would
/// be a full circle that cuts off the adjacent support bars. The line differs from the arc by less than any machine can resolve.
const MIN_ARC_LENGTH: f64 = 0.002;

impl Job {
    /// Joins programs in the given order into one job. The tool is changed between two programs if O differs or the tool table requires
    /// it.
    ///
    /// With `pecks`, holes with C are drilled in pecks of that depth, otherwise in one go as in the native program. Returns the job and
    /// warnings about the tools.
    pub fn from_programs(
        name: &str,
        programs: &[impl Borrow<Program>],
        tools: &ToolTable,
        pecks: bool,
    ) -> (Self, Vec<Diagnostic>) {
        let mut assigner = ToolAssigner::new(tools);
        let operations = programs.iter().map(Borrow::borrow).flat_map(|program| {
            let assignment = assigner.assign_tool(&program.path, program.tool);
            Builder::new(program, assignment, pecks).run()
        });
        let mut operations: Vec<Operation> = operations.collect();
        // All operations get the greatest clearance of any program, because between two programs the tool must be above everything in
        // both.
        let clearance =
            operations.iter().map(|operation| operation.clearance).fold(f64::NEG_INFINITY, f64::max);
        for operation in &mut operations {
            operation.clearance = clearance;
        }
        let drawing = programs.first().map_or("", |program| &program.borrow().drawing);
        (
            Self { name: name.into(), drawing: drawing.into(), operations, ..Self::default() },
            assigner.warnings,
        )
    }

    /// Assigns the cutter of native programs to all operations, as in a job that is made from their paths. Native programs always say T1, whatever
    /// the cutter. Returns warnings about the tool.
    ///
    /// # Errors
    /// PB765 if the programs need different tools, or if one does not name its path and several tools have its diameter O.
    pub fn set_cutter(
        &mut self,
        programs: &[NativeCutter],
        tools: &ToolTable,
    ) -> Result<Vec<Diagnostic>, Box<Diagnostic>> {
        let mut assigner = ToolAssigner::new(tools);
        let mut first = None;
        for NativeCutter { line, path, diameter } in programs {
            let alike = tools.positions_where(*diameter, |_| path.is_none());
            if let [first, second, ..] = *alike {
                let [first, second] = [first, second].map(|index| &*tools.entries[index].name);
                let problem = Diagnostic::new(&posts::CUTTER_OF_UNNAMED_PATH).with("diameter", *diameter);
                let problem = problem.quoting("first", first).quoting("second", second);
                return Err(Box::new(problem.at_line(*line, None)));
            }
            let tool = assigner.assign_tool(path.as_deref().unwrap_or_default(), *diameter).tool;
            let expected = &*first.get_or_insert_with(|| tool.clone());
            if expected.index != tool.index {
                let problem = Diagnostic::new(&posts::SEVERAL_NATIVE_PROGRAMS).quoting("tool", &*tool.name);
                return Err(Box::new(problem.quoting("first", &*expected.name).at_line(*line, None)));
            }
        }
        if let Some(tool) = first {
            self.operations.iter_mut().for_each(|operation| operation.tool = tool.clone());
        }
        Ok(assigner.warnings)
    }
}

/// The cutter that the head of a native program states.
#[derive(Clone, Debug, PartialEq)]
pub struct NativeCutter {
    /// The line of the head's comment that states the cutter.
    pub line: u32,
    /// The path of the program; `None` if the head does not name it.
    pub path: Option<String>,
    /// O in mm.
    pub diameter: f64,
}

struct Builder<'a> {
    program: &'a Program,
    assignment: ToolAssignment,
    pecks: bool,
    /// The embedded paths that contain the current step, outermost first.
    embedded: Vec<&'a str>,
    operations: Vec<Operation>,
    tool: ToolTip,
    /// Height in mm of the highest upper face of the material at the elements announced since the last step.
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
                ProgramStep::Comment(comment) => self.handle_comment(comment, after),
                ProgramStep::Move { to, count } => {
                    self.add_planned_move(to, count.length);
                    after
                }
            };
        }
        let last = self.tool.lift(self.program.sweep_height);
        self.push(last);
        let thickness = self.program.thickness;
        self.operations.iter_mut().for_each(|operation| derive_feeds_and_depths(operation, thickness));
        self.operations
    }

    /// Handles a comment and returns the remaining steps. If the comment announces a hole, the steps of the hole are consumed as well.
    fn handle_comment(&mut self, comment: &Comment, after: &'a [ProgramStep]) -> &'a [ProgramStep] {
        let names: &'a Names = &self.program.names;
        match *comment {
            Comment::StartSubpath(name) => self.embedded.push(names.get(name)),
            Comment::EndSubpath(_) => _ = self.embedded.pop(),
            Comment::Question(text) => {
                let text = format!("Q:{}", names.get(text)).into();
                self.operation().steps.push(JobStep::Comment(text));
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

    /// Combines the steps that drill a hole into a single one and returns the steps after it. Returns `None` if they do not form a hole: the tool
    /// must come from above the material, and must be retracted from the bottom.
    fn hole(&mut self, peck: Option<f64>, steps: &'a [ProgramStep]) -> Option<&'a [ProgramStep]> {
        let (remarks, steps) = comments(steps);
        let (retract, steps) = match steps.split_first()? {
            (ProgramStep::Move { to: PlannedMove::Lift { z }, .. }, rest) => (z.z, rest),
            _ => (self.tool.at.z(), steps),
        };
        let (ProgramStep::Move { to: PlannedMove::Drill { feed, z: bottom }, .. }, rest) =
            steps.split_first()?
        else {
            return None;
        };
        // The retract remains in the steps after the hole, where it has no effect: the tool is already at its end.
        let exit = match comments(rest).1.first() {
            None => self.program.sweep_height,
            Some(ProgramStep::Move { to: PlannedMove::Lift { z }, .. }) => z.z,
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
            self.handle_comment(remark, &[]);
        }
        let hole = Hole { at: [x, y], level, retract, bottom: bottom.z, exit, feed: Some(*feed), kind };
        let operation = self.operation();
        drop_rapid_between_holes(&mut operation.steps, &hole);
        operation.steps.push(JobStep::Hole(hole));
        self.tool.lift(exit);
        Some(rest)
    }

    /// Adds a planned move of this length in mm. A very short arc becomes a line.
    fn add_planned_move(&mut self, to: &PlannedMove, length: f64) {
        let mut movement = self.tool.make_move(to, length);
        if length < MIN_ARC_LENGTH {
            movement.shape = MoveShape::Line;
        }
        self.push(movement);
    }

    /// Adds a move, unless it is a rapid move to the current position.
    fn push(&mut self, movement: motion::Move) {
        if movement.pace != Pace::Rapid || !movement.is_standstill() {
            self.operation_from(movement.from.at).steps.push(JobStep::Move(movement));
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

/// Splits `steps` into the comments at the beginning and the remaining steps.
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

/// Removes a rapid move between two holes at the same level, because drilling the second hole includes this move.
fn drop_rapid_between_holes(steps: &mut Vec<JobStep>, next: &Hole) {
    if let [.., JobStep::Hole(before), JobStep::Move(way)] = steps.as_slice() {
        let [x, y] = next.at;
        let leads_there = way.pace == Pace::Rapid && way.to.at == [x, y, next.level];
        if near(before.exit, next.level) && leads_there {
            steps.pop();
        }
    }
}

/// The table of tools in the configuration (`[tool.NAME]` in pathbuild.toml): cutter, spindle and coolant for programs with a given O.
#[derive(Clone, Debug, Default)]
pub struct ToolTable {
    /// The tools in the order of the configuration. The first one that matches is used, with a warning if another one matches as well.
    pub entries: Vec<ToolEntry>,
}

/// An entry of the tool table in the configuration.
#[derive(Clone, Debug)]
pub struct ToolEntry {
    /// Name of the entry: NAME in `[tool.NAME]`.
    pub name: Box<str>,
    /// Cutter diameter (O) in mm.
    pub diameter: f64,
    /// The paths that the tool is for, by their names, if several cutters have the same diameter. The pattern may match anywhere in a name: `S$`
    /// matches names that end in S.
    pub paths: Option<Regex>,
    /// Number in T words. Entries without one get the free numbers, in the order of the entries.
    pub index: Option<u32>,
    /// State of the spindle; `None` if the operator controls it.
    pub spindle: Option<Turning>,
    /// Spindle speed in 1/min.
    pub speed: Option<f64>,
    /// State of the coolant; `None` if the operator controls it.
    pub coolant: Option<Coolant>,
}

/// A cutter, with the settings of spindle and coolant for it.
#[derive(Clone, Debug)]
pub(super) struct ToolAssignment {
    pub(super) tool: Tool,
    pub(super) spindle: Option<Turning>,
    pub(super) speed: Option<f64>,
    pub(super) coolant: Option<Coolant>,
}

/// Assignment of cutters to paths, and of numbers to cutters that have none.
pub(super) struct ToolAssigner<'a> {
    table: &'a ToolTable,
    /// Tool number of each entry of the table.
    numbers: Vec<u32>,
    assigned: Vec<(Key, Tool)>,
    pub(super) warnings: Vec<Diagnostic>,
}

/// Identity of a cutter: an entry of the table, or a diameter that is not in the table.
#[derive(Clone, Copy, Debug)]
enum Key {
    Entry(usize),
    Diameter(f64),
}

impl ToolTable {
    /// Finds the tool for a path with the cutter diameter O. Entries that specify paths take precedence over those that do not.
    pub fn find(&self, path: &str, diameter: f64) -> Option<&ToolEntry> {
        self.position(path, diameter).map(|index| &self.entries[index])
    }

    /// Returns the number of each entry. Entries without one get the free numbers in the order of the table, not of use, so
    /// that a cutter has the same number, and the same length in the control, in each program.
    fn numbers(&self) -> Vec<u32> {
        let stated: HashSet<u32> = self.entries.iter().filter_map(|entry| entry.index).collect();
        let mut free = (1..=u32::MAX).filter(|number| !stated.contains(number));
        self.entries.iter().map(|entry| entry.index.or_else(|| free.next()).unwrap_or(0)).collect()
    }

    /// Returns the same table with a number for each entry.
    pub fn with_numbers(&self) -> Self {
        let entries = self.entries.iter().zip(self.numbers());
        Self {
            entries: entries
                .map(|(entry, number)| ToolEntry { index: Some(number), ..entry.clone() })
                .collect(),
        }
    }

    /// Returns the index of the tool that [`find`](Self::find) returns.
    pub fn position(&self, path: &str, diameter: f64) -> Option<usize> {
        self.positions(path, diameter).first().copied()
    }

    /// Returns the indices of all tools that fit a path equally well.
    fn positions(&self, path: &str, diameter: f64) -> Vec<usize> {
        let is_named = |entry: &ToolEntry| entry.paths.as_ref().is_some_and(|paths| paths.is_match(path));
        let named = self.positions_where(diameter, is_named);
        if named.is_empty() { self.positions_where(diameter, |entry| entry.paths.is_none()) } else { named }
    }

    fn positions_where(&self, diameter: f64, is_meant: impl Fn(&ToolEntry) -> bool) -> Vec<usize> {
        let entries = self.entries.iter().enumerate();
        let fitting = entries.filter(|(_, entry)| near(entry.diameter, diameter) && is_meant(entry));
        fitting.map(|(index, _)| index).collect()
    }
}

impl<'a> ToolAssigner<'a> {
    pub(super) fn new(table: &'a ToolTable) -> Self {
        Self { table, numbers: table.numbers(), assigned: Vec::new(), warnings: Vec::new() }
    }

    /// Returns the cutter and settings for a path with diameter O, and remembers the cutter for later paths.
    pub(super) fn assign_tool(&mut self, path: &str, diameter: f64) -> ToolAssignment {
        let positions = self.table.positions(path, diameter);
        let position = positions.first().copied();
        let entry = position.map(|index| &self.table.entries[index]);
        let key = position.map_or(Key::Diameter(diameter), Key::Entry);
        let tool = match self.assigned.iter().find(|(known, _)| known.is_same(key)) {
            Some((_, tool)) => tool.clone(),
            None => self.add(key, entry, path, diameter),
        };
        if let [first, second, ..] = *positions {
            let [first, second] = [first, second].map(|index| &*self.table.entries[index].name);
            let problem = Diagnostic::new(&posts::TOOLS_ALIKE).with("diameter", diameter);
            let problem = problem.quoting("first", first).quoting("second", second);
            if !self.warnings.contains(&problem) {
                self.warnings.push(problem);
            }
        }
        ToolAssignment {
            tool,
            spindle: entry.and_then(|entry| entry.spindle),
            speed: entry.and_then(|entry| entry.speed),
            coolant: entry.and_then(|entry| entry.coolant),
        }
    }

    fn add(&mut self, key: Key, entry: Option<&ToolEntry>, path: &str, diameter: f64) -> Tool {
        let index = match key {
            Key::Entry(position) => self.numbers[position],
            Key::Diameter(_) => self.free_index(),
        };
        if entry.is_none() && !self.table.entries.is_empty() {
            let warning = Diagnostic::new(&posts::TOOL_UNKNOWN).with("diameter", diameter).in_path(path);
            self.warnings.push(warning.quoting("path", path).with("index", u64::from(index)));
        }
        let name = entry.map_or_else(
            || format!("{} mm", pathbuild_diagnostic::Number(diameter)),
            |entry| entry.name.to_string(),
        );
        let is_for_other_paths =
            entry.is_none() && !self.table.positions_where(diameter, |_| true).is_empty();
        let tool = Tool { is_for_other_paths, ..Tool::new(index, diameter, &name) };
        self.assigned.push((key, tool.clone()));
        tool
    }

    /// Returns the smallest number used neither by the table nor by a cutter assigned before.
    fn free_index(&self) -> u32 {
        let is_free = |index: &u32| {
            !self.numbers.contains(index) && self.assigned.iter().all(|(_, tool)| tool.index != *index)
        };
        (1..=u32::MAX).find(is_free).unwrap_or(0)
    }
}

impl Key {
    fn is_same(self, other: Self) -> bool {
        match (self, other) {
            (Self::Entry(a), Self::Entry(b)) => a == b,
            (Self::Diameter(a), Self::Diameter(b)) => near(a, b),
            _ => false,
        }
    }
}
