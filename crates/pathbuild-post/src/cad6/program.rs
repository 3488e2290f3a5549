//! Writes a job through control texts: sets the variables of each call and executes it.

use std::collections::BTreeSet;

use camino::Utf8PathBuf;
use pathbuild_diagnostic::{Diagnostic, messages::posts};
use pathbuild_motion::{Coolant, Move, Turning};

use super::calls::{Call, CallContent, ContourPosition, Point, calls};
use super::control_text::ControlTextKind;
use super::definition::Definition;
use super::expand::{Expanded, names, path_below};
use super::runner::{RunResult, Runner};
use super::variables::{Variables, is_private};
use crate::job::{Feeds, Hole, HoleKind, Job, Operation, Units};
use crate::target::Target;
use crate::{PostMacro, PostOptions};

pub(super) struct Caller<'a, 'r> {
    job: &'a Job,
    /// The feeds of each operation, indexed like the job's operations.
    feeds: Vec<Feeds>,
    runner: &'r mut Runner<'a>,
    /// The output unit in mm: 1 or 25.4.
    unit: f64,
    at: Point,
    tool: Option<u32>,
    contours: u32,
    elements: u32,
    unchecked: bool,
    /// Whether tools are XpertMILL layers.
    has_layers: bool,
}

/// Runs all texts that a job calls.
pub(super) fn run<'a>(
    job: &'a Job,
    target: Option<&Target>,
    options: &PostOptions<'_>,
    runner: &mut Runner<'a>,
) -> RunResult {
    let calls = calls(job, runner.definition)?;
    let units = runner.definition.settings.units.unwrap_or(job.units);
    let unit = units.millimetres();
    let unchecked = options.unchecked;
    let feeds = job.feeds();
    let mut caller = Caller {
        job,
        feeds,
        runner,
        unit,
        at: [0.0; 3],
        tool: None,
        contours: 0,
        elements: 0,
        unchecked,
        has_layers: target.is_some_and(|target| target.reader.rules().layers),
    };
    caller.constants(units, options);
    caller.runner.call(ControlTextKind::ProgramStart)?;
    for remark in &job.remarks {
        caller.text("CommentText", remark);
        caller.runner.call(ControlTextKind::Comment)?;
    }
    calls.iter().try_for_each(|call| caller.execute_call(call))?;
    caller.runner.call(ControlTextKind::PrimaryRun)?;
    caller.runner.call(ControlTextKind::BeforeRepeat)?;
    caller.runner.call(ControlTextKind::ProgramEnd)
}

pub(super) fn assign_macros(variables: &mut Variables, macros: &[PostMacro]) {
    for own in macros {
        variables.assign(&own.name, &own.value.replace(is_private, "?"));
    }
}

/// Returns the files that control texts insert under fixed names, which contain only literal text and the user's macros.
pub(crate) fn inserted_files(definition: &Definition, macros: &[PostMacro]) -> BTreeSet<Utf8PathBuf> {
    let mut variables = Variables::new(definition.aliases.iter().map(|(other, own)| (&**other, &**own)));
    assign_macros(&mut variables, macros);
    // Texts that cannot be expanded cannot be part of a program.
    let texts = definition.texts().filter_map(|(_, text)| Expanded::new(&text.text, &variables).ok());
    texts.flat_map(|expanded| names(&expanded.text)).filter_map(|name| path_below(&name)).collect()
}

impl Caller<'_, '_> {
    fn set(&mut self, name: &str, value: f64) {
        self.runner.variables.set(name, value);
    }

    fn length(&mut self, name: &str, millimetres: f64) {
        self.set(name, millimetres / self.unit);
    }

    fn flag(&mut self, name: &str, is_set: bool) {
        self.set(name, f64::from(u8::from(is_set)));
    }

    fn text(&mut self, name: &str, text: &str) {
        self.runner.variables.set_text(name, text);
    }

    fn constants(&mut self, units: Units, options: &PostOptions<'_>) {
        assign_macros(&mut self.runner.variables, &options.macros);
        for axis in ["X", "Y", "Z"] {
            self.runner.variables.assign(&format!("{axis}Incr"), &format!("(~{axis}1~-~Prev{axis}~)"));
        }
        for (name, value) in
            [("LineNumber", 10.0), ("ToolChangeCommands", 1.0), ("MachinePosX", 0.0), ("MachinePosY", 0.0)]
        {
            self.set(name, value);
        }
        self.set("SpinUpTime", options.spin_up);
        self.set("Units", if units == Units::Inches { 2.0 } else { 0.0 });
        self.set("Decimals", self.runner.definition.settings.decimals as f64);
        self.text("PrgName", &self.job.name);
        self.text("SourceFile", &self.job.drawing);
        if let Some(date) = &options.date {
            self.text("Date", date);
        }
        self.operation(0);
        self.length("ZClearance", self.job.operations[0].clearance);
    }

    fn operation(&mut self, index: usize) {
        let operation = &self.job.operations[index];
        self.text("PathName", &operation.name);
        self.text("ToolName", &operation.tool.name);
        match operation.tool.index {
            index if operation.tool.is_named => self.set("MachineToolNo", f64::from(index)),
            // A program without a layer number uses the first layer.
            _ if self.has_layers => self.set("MachineToolNo", 1.0),
            _ => self.runner.variables.remove("MachineToolNo"),
        }
        self.length("ToolDiameter", operation.tool.diameter);
        self.flag("MillingSpindleDir", operation.spindle == Some(Turning::CounterClockwise));
        match operation.speed {
            Some(speed) => self.set("MillingSpindleRate", speed),
            None => self.runner.variables.remove("MillingSpindleRate"),
        }
        self.flag("ToolControl1", operation.coolant.is_some_and(Coolant::is_on));
        self.flag("ToolControl2", operation.coolant == Some(Coolant::MIST));
        self.length("ZWorking", operation.retract);
        let Feeds { plunge, cut } = self.feeds[index];
        for (name, feed) in [("LoweringVel", plunge), ("MovingVel", cut)] {
            if let Some(feed) = feed {
                self.length(name, feed);
            }
        }
    }

    fn execute_call(&mut self, call: &Call<'_>) -> RunResult {
        let operation = &self.job.operations[call.operation];
        self.operation(call.operation);
        match &call.content {
            CallContent::Start { at, clearance, working, feed } => {
                self.length("ZClearance", clearance.max(self.at[2]));
                self.change_tool(operation)?;
                self.require_move(ControlTextKind::ContourStart, operation)?;
                self.start(*at, *clearance, *working, *feed)
            }
            CallContent::Line { to, feed, place } => {
                self.change_tool(operation)?;
                self.require_move(ControlTextKind::Line, operation)?;
                self.element(*to, *feed, *place);
                self.runner.call(ControlTextKind::Line)
            }
            CallContent::Arc { movement, place } => {
                self.change_tool(operation)?;
                self.arc(movement);
                self.element(movement.to.at, movement.pace.stated_feed(), *place);
                self.runner.call(ControlTextKind::Arc)?;
                self.forget_arc();
                Ok(())
            }
            CallContent::End { clearance } => {
                self.length("ZClearance", *clearance);
                self.at[2] = *clearance;
                self.require_move(ControlTextKind::ContourEnd, operation)?;
                self.runner.call(ControlTextKind::ContourEnd)
            }
            CallContent::Hole { hole, clearance } => {
                self.length("ZClearance", *clearance);
                self.change_tool(operation)?;
                self.hole(hole)
            }
            CallContent::Rapid { to } => {
                self.length("ZClearance", operation.clearance.max(self.at[2]));
                self.change_tool(operation)?;
                self.move_to(*to);
                self.runner.call(ControlTextKind::Rapid)
            }
            CallContent::Dwell(seconds) => {
                self.set("DwellTime", *seconds);
                self.require(ControlTextKind::Dwell, operation)?;
                self.runner.call(ControlTextKind::Dwell)
            }
            CallContent::Stop => {
                self.require(ControlTextKind::Stop, operation)?;
                self.runner.call(ControlTextKind::Stop)
            }
            CallContent::Comment(text) => {
                self.text("CommentText", text);
                self.runner.call(ControlTextKind::Comment)
            }
        }
    }

    /// Checks that the definition has the text for a move. A missing text is an error, because the output would lack the move, unless the user has
    /// taken responsibility for unchecked output.
    fn require_move(&self, kind: ControlTextKind, operation: &Operation) -> RunResult {
        if self.unchecked { Ok(()) } else { self.require(kind, operation) }
    }

    fn require(&self, kind: ControlTextKind, operation: &Operation) -> RunResult {
        if self.runner.definition.text(kind).is_some() {
            return Ok(());
        }
        let diagnostic = Diagnostic::new(&posts::NO_TEXT_FOR).quoting("operation", &*operation.name);
        Err(Box::new(diagnostic.quoting("text", kind.name())))
    }

    fn change_tool(&mut self, operation: &Operation) -> RunResult {
        let is_new = self.tool != Some(operation.tool.index);
        self.flag("ToolChanged", is_new);
        self.tool = Some(operation.tool.index);
        if is_new { self.runner.call(ControlTextKind::ToolChange) } else { Ok(()) }
    }

    fn start(&mut self, at: Point, clearance: f64, working: f64, feed: Option<f64>) -> RunResult {
        self.contours += 1;
        self.elements = 0;
        self.set("ContourNo", f64::from(self.contours));
        self.flag("UpdateXYPosition", true);
        self.flag("UseAuxPoint", false);
        self.flag("UpdateCutterRotationOnly", false);
        self.length("ZClearance", clearance);
        self.length("ZWorking", working);
        if let Some(feed) = feed {
            self.length("LoweringVel", feed);
        }
        self.move_to(at);
        self.runner.call(ControlTextKind::ContourStart)
    }

    fn move_to(&mut self, to: Point) {
        for (axis, (from, to)) in ["X", "Y", "Z"].into_iter().zip(self.at.into_iter().zip(to)) {
            self.length(&format!("Prev{axis}"), from);
            self.length(&format!("{axis}1"), to);
        }
        self.at = to;
    }

    fn element(&mut self, to: Point, feed: Option<f64>, place: ContourPosition) {
        self.elements += 1;
        self.set("ElementNo", f64::from(self.elements));
        self.flag("FirstContourElement", place.is_first);
        self.flag("LastContourElement", place.is_last);
        if let Some(feed) = feed {
            self.length("MovingVel", feed);
        }
        self.move_to(to);
    }

    fn arc(&mut self, movement: &Move) {
        let Some(course) = movement.course() else { return };
        let arc = course.arc();
        let [start, end] = course.directions();
        let sweep = if arc.clockwise { -course.sweep() } else { course.sweep() };
        self.length("XC", arc.centre[0]);
        self.length("YC", arc.centre[1]);
        self.length("IRel", arc.centre[0] - movement.from.x());
        self.length("JRel", arc.centre[1] - movement.from.y());
        self.length("Radius", course.radius());
        self.set("StartAngle", start.to_degrees().rem_euclid(360.0));
        self.set("EndAngle", end.to_degrees().rem_euclid(360.0));
        self.set("SweepAngle", sweep.to_degrees());
        self.flag("ArcDir", !arc.clockwise);
    }

    /// Removes the variables of an arc so that the next element does not see them.
    fn forget_arc(&mut self) {
        for name in ["XC", "YC", "IRel", "JRel", "Radius", "StartAngle", "EndAngle", "SweepAngle", "ArcDir"] {
            self.runner.variables.remove(name);
        }
    }

    fn hole(&mut self, hole: &Hole) -> RunResult {
        let (peck, dwell) = match hole.kind {
            HoleKind::Plain => (0.0, 0.0),
            HoleKind::Dwell { seconds } => (0.0, seconds),
            HoleKind::Peck { depth } => (depth, 0.0),
        };
        self.length("PeckDepth", peck);
        self.set("DwellTime", dwell);
        self.length("ZWorking", hole.retract);
        if let Some(feed) = hole.feed {
            self.length("LoweringVel", feed);
        }
        self.move_to([hole.at[0], hole.at[1], hole.bottom]);
        let has_cycle = self.runner.definition.text(ControlTextKind::Cycle).is_some();
        self.runner.call(if has_cycle { ControlTextKind::Cycle } else { ControlTextKind::Point })?;
        self.at[2] = hole.exit;
        Ok(())
    }
}
