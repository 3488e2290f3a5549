//! Converts a parsed program to a job, to write it for another machine. (book: program/reading, `post FILE --post X`)

use pathbuild_diagnostic::messages::{gcode, posts};
use pathbuild_diagnostic::{Diagnostic, Value};
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::interpret::code_name;
use pathbuild_gcode::native::path_of_title;
use pathbuild_gcode::provenance::Provenance;
use pathbuild_motion::{
    Action, Axes, Change, Coolant, Move, MoveShape, Pace, Plane, Position, Spindle, Step, ToolLength,
    Turning, WorkSystem,
};

use crate::job::{Entry, Hole, HoleKind, Job, JobStep, Operation, Tool, derive_feeds_and_depths};

/// The meaning of a comment in the parsed program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Remark<'a> {
    /// An ordinary comment, which is kept.
    Stays,
    /// A comment that the post writes itself, so it is dropped here.
    Goes,
    /// Start of an operation with this name.
    Operation(&'a str),
    /// End of an operation; the following steps belong to the enclosing one.
    End,
}

/// Returns the meaning of a comment in a program of the native dialect.
pub fn native_remark(text: &str) -> Remark<'_> {
    let text = text.trim();
    match text.strip_prefix("START Subpath ") {
        Some(name) => Remark::Operation(name),
        None if text.starts_with("END Subpath ") => Remark::End,
        None if is_head_comment(text) => Remark::Goes,
        None => Remark::Stays,
    }
}

/// Whether a comment is the provenance or the title at the head of a program written by pathbuild. Such comments are dropped, because the
/// job's own comments repeat them.
pub fn is_head_comment(text: &str) -> bool {
    text.parse::<Provenance>().is_ok() || path_of_title(text).is_some()
}

impl Job {
    /// Converts the steps of a program in any dialect. A new operation begins where the tool, the spindle, the coolant or the plane of arcs changes
    /// between two cuts, after a stop or dwell with the spindle off, and where `remark` says so. Several moves in one line are combined into a
    /// drilled hole if they form one. The upper face of the material is assumed to be at Z 0, because programs do not contain it: see
    /// [`set_surface`](Self::set_surface).
    ///
    /// # Errors
    /// Things that a job cannot express: work offsets other than G54, zeros that the program sets where the position is unknown, tools without a
    /// number, lengths of another tool or only for some cuts of a tool, positions known only to the machine, cuts from or to an unknown position,
    /// arcs of several turns.
    pub fn from_steps(
        name: &str,
        steps: &[Step],
        dialect: Dialect,
        remark: &dyn Fn(&str) -> Remark<'_>,
    ) -> Result<Self, Vec<Diagnostic>> {
        let mut builder = Builder::new(name, steps, dialect);
        let mut rest = steps;
        // Number of a line whose beginning is not a hole: the rest of that line is not one either.
        let mut plain_line = None;
        while let Some((step, after)) = rest.split_first() {
            // Skip the word of a cycle: the moves of the cycle follow it.
            if matches!(step.action, Action::Word(_) | Action::ProgramNumber(_)) {
                rest = after;
                continue;
            }
            if plain_line != Some(step.line) && rises_to_hole(step, after) {
                builder.step(step, remark);
                rest = after;
                continue;
            }
            let hole = if plain_line == Some(step.line) { None } else { hole(rest) };
            plain_line = hole.is_none().then_some(step.line);
            rest = match hole {
                Some((hole, behind)) => {
                    builder.hole(hole);
                    behind
                }
                None if step.action == Action::End => &[],
                None => {
                    builder.step(step, remark);
                    after
                }
            };
        }
        builder.finish()
    }
}

/// The modal settings of the machine.
#[derive(Clone, Copy, Debug, PartialEq)]
struct State {
    /// Number of the tool; `None` until the program names one.
    tool: Option<u32>,
    spindle: Option<Turning>,
    speed: Option<f64>,
    coolant: Option<Coolant>,
    plane: Plane,
}

#[expect(clippy::struct_excessive_bools, reason = "facts that do not depend on each other")]
struct Builder {
    job: Job,
    state: State,
    /// Whether M6 changes tools. In programs without M6, T does.
    has_tool_changes: bool,
    /// Whether tools are layers of XpertMILL. Then the first layer applies from the beginning, and S alone starts the spindle.
    has_layers: bool,
    /// The line that changed to a tool without a number.
    unnamed_change: Option<u32>,
    /// Whether the tool was changed below the clearance plane and has neither moved in Z nor cut since.
    was_changed_low: bool,
    at: Position,
    clearance: f64,
    /// Whether the last operation has cut or probed.
    has_cut: bool,
    /// Names of the open operations, outermost first.
    names: Vec<Box<str>>,
    /// Whether the last operation has ended.
    has_ended: bool,
    /// Whether the last move was a rapid move to a known height, or the retract from a hole.
    is_raised: bool,
    /// Whether the last move was a probing move, so that only the machine knows the position.
    has_probed: bool,
    starts_spindle: bool,
    /// Whether the program has stopped or waited with the spindle off since the last operation began. From then on, the settings of the operation are
    /// final.
    is_spindle_kept_off: bool,
    /// Whether a tool length is in effect.
    has_length: bool,
    /// The number of the tool to which the length in effect belongs, if it is known.
    length_tool: Option<u32>,
    /// The line that last set or cancelled the tool length.
    length_line: u32,
    /// Whether the tool in the spindle has cut with a length (G43); `None` before its first cut.
    has_cut_with_length: Option<bool>,
    /// Whether the tool in the spindle has cut since it was inserted or the program last stopped: from then on, the interpreter takes changes of its
    /// length (G43.1) into account in the positions of the moves.
    has_cut_with_tool: bool,
    errors: Vec<Diagnostic>,
}

impl Builder {
    fn new(name: &str, steps: &[Step], dialect: Dialect) -> Self {
        let has_layers = dialect.rules().layers;
        let rapids =
            steps.iter().filter_map(Step::as_move).filter(|(_, movement)| movement.pace == Pace::Rapid);
        let heights = rapids
            .filter(|(_, movement)| movement.to.known.has(Axes::Z) && movement.named.is_none())
            .map(|(_, movement)| movement.to.z());
        let tool = has_layers.then_some(1);
        let state = State { tool, spindle: None, speed: None, coolant: None, plane: Plane::Xy };
        Self {
            job: Job { name: name.into(), ..Job::default() },
            state,
            has_tool_changes: steps.iter().any(|step| matches!(step.action, Action::ChangeTool(_))),
            has_layers,
            unnamed_change: None,
            was_changed_low: false,
            at: Position::default(),
            clearance: heights.reduce(f64::max).unwrap_or(0.0),
            has_cut: false,
            names: Vec::new(),
            has_ended: false,
            is_raised: false,
            has_probed: false,
            starts_spindle: steps
                .iter()
                .any(|step| matches!(&step.action, Action::Spindle(spindle) if spindle.turning.is_on())),
            is_spindle_kept_off: false,
            has_length: false,
            length_tool: None,
            length_line: 0,
            has_cut_with_length: None,
            has_cut_with_tool: false,
            errors: Vec::new(),
        }
    }

    fn step(&mut self, step: &Step, remark: &dyn Fn(&str) -> Remark<'_>) {
        match &step.action {
            Action::Move(movement) => self.add_move(step.line, movement),
            Action::Dwell(seconds) => {
                // A dwell after M5 waits until the spindle stands still.
                if self.state.spindle == Some(Turning::Off) {
                    self.keep_spindle_off();
                }
                self.push(JobStep::Dwell { seconds: *seconds });
            }
            Action::SelectTool(tool) if !self.has_tool_changes => self.change_tool(step.line, Some(*tool)),
            Action::ChangeTool(tool) => self.change_tool(step.line, *tool),
            Action::Spindle(spindle) => self.set_spindle(spindle),
            Action::Coolant(coolant) => self.set_coolant(*coolant),
            Action::System { system, .. } if *system != WorkSystem::default() => {
                self.refuse_word(step.line, &posts::JOB_SYSTEM, system.name());
            }
            Action::Change(Change::Offsets { code, is_followed: false, .. }) => {
                self.refuse_word(step.line, &posts::JOB_ZERO, code_name('G', *code));
            }
            Action::Change(Change::ToolLength(ToolLength::Off | ToolLength::OfTool(Some(0)))) => {
                (self.has_length, self.length_line) = (false, step.line);
            }
            Action::Change(Change::ToolLength(ToolLength::OfTool(entry))) => {
                (self.has_length, self.length_line) = (true, step.line);
                self.length_tool = entry.or(self.state.tool);
            }
            Action::Change(Change::ToolLength(ToolLength::Other(code))) if !self.has_cut_with_tool => {
                self.refuse_word(step.line, &posts::JOB_ZERO, code_name('G', *code));
            }
            Action::Comment(text) => match remark(text) {
                Remark::Stays => self.push(JobStep::Comment(text.trim().into())),
                Remark::Goes => {}
                Remark::Operation(name) => {
                    self.names.push(name.into());
                    self.begin(name);
                }
                Remark::End => {
                    self.names.pop();
                    self.has_ended = true;
                }
            },
            Action::Stop { .. } => self.stop(),
            Action::SelectTool(_)
            | Action::System { .. }
            | Action::Word(_)
            | Action::ProgramNumber(_)
            | Action::Change(_)
            | Action::End => {}
        }
    }

    /// Reports an error, but only for the first line of each kind, because further ones are mostly consequences.
    fn refuse(&mut self, line: u32, message: &'static pathbuild_diagnostic::Message) {
        if self.errors.iter().all(|error| error.message != message) {
            self.errors.push(Diagnostic::new(message).at_line(line, None));
        }
    }

    /// Reports a word that the post does not write. `message` says what the word sets.
    fn refuse_word(
        &mut self,
        line: u32,
        message: &'static pathbuild_diagnostic::Message,
        word: impl AsRef<str>,
    ) {
        self.refuse(line, message);
        if let Some(error) = self.errors.iter_mut().find(|error| error.message == message)
            && error.arguments.is_empty()
        {
            error.arguments.push(("word", Value::quoted(word)));
        }
    }

    /// Starts an operation at the current position. If the settings of the last operation are not final, the new one replaces it and takes over its
    /// steps.
    fn begin(&mut self, name: &str) {
        let mut operation = Operation::new(name, tool_with_number(self.state.tool));
        operation.part.clone_from(&self.job.name);
        operation.clearance = self.clearance;
        operation.entry = self.entry();
        if !self.is_settled()
            && let Some(idle) = self.job.operations.pop()
        {
            (operation.entry, operation.steps) = (idle.entry, idle.steps);
        }
        self.has_cut = false;
        self.has_ended = false;
        self.is_spindle_kept_off = false;
        self.job.operations.push(operation);
        self.update_operation();
    }

    fn entry(&self) -> Entry {
        if self.at.known == Axes::ALL { Entry::At(self.at.at) } else { Entry::Clearance }
    }

    /// Whether the settings of the last operation are final, because it has cut or probed, or has stopped or waited with the spindle off.
    fn is_settled(&self) -> bool {
        self.has_cut || self.is_spindle_kept_off
    }

    /// Updates the last operation to the settings of the machine, unless they are final.
    fn update_operation(&mut self) {
        let State { tool, spindle, speed, coolant, plane } = self.state;
        let is_settled = self.is_settled();
        if let Some(operation) = self.job.operations.last_mut().filter(|_| !is_settled) {
            operation.tool = tool_with_number(tool);
            operation.spindle = spindle;
            operation.speed = speed;
            operation.coolant = coolant;
            operation.plane = plane;
        }
    }

    fn operation(&mut self) -> &mut Operation {
        if self.has_ended || self.job.operations.is_empty() {
            let name = self.names.last().unwrap_or(&self.job.name).clone();
            self.begin(&name);
        }
        self.job.operations.last_mut().expect("one was begun if there was none")
    }

    /// Returns the operation for a cut, creating one if the settings have changed since the last cut.
    fn operation_for_cut(&mut self) -> &mut Operation {
        if let Some(change) = self.unnamed_change.take() {
            self.refuse(change, &posts::JOB_TOOL_UNNAMED);
        }
        self.check_length();
        let State { tool, spindle, speed, coolant, plane } = self.state;
        let is_same = |last: &Operation| {
            let set = (last.tool.index, last.spindle, last.speed, last.coolant, last.plane);
            set == (tool.unwrap_or(0), spindle, speed, coolant, plane)
        };
        self.operation();
        let is_over = |last| self.is_spindle_kept_off || self.has_cut && !is_same(last);
        if self.job.operations.last().is_some_and(is_over) {
            self.begin_same_operation();
        }
        (self.has_cut, self.has_cut_with_tool) = (true, true);
        self.operation()
    }

    /// Refuses a cut with the length of another tool, and cuts of one tool both with and without a length: a post writes G43 with the number of the
    /// tool, once for each tool.
    fn check_length(&mut self) {
        let is_other = self.length_tool.is_none() || self.length_tool != self.state.tool;
        let has_length = self.has_length;
        if has_length && is_other || *self.has_cut_with_length.get_or_insert(has_length) != has_length {
            self.refuse(self.length_line, &posts::JOB_LENGTH);
        }
    }

    /// Starts another operation with the name of the last one.
    fn begin_same_operation(&mut self) {
        let name = self.job.operations.last().map(|last| last.name.clone()).unwrap_or_default();
        self.begin(&name);
    }

    fn push(&mut self, step: JobStep) {
        self.operation().steps.push(step);
    }

    /// Handles a stop for the operator, who may insert another tool or set a new zero point. If the tool was raised before the stop, it is
    /// raised again before it next moves in the plane.
    fn stop(&mut self) {
        self.has_cut_with_tool = false;
        if !self.state.spindle.is_some_and(Turning::is_on) {
            self.keep_spindle_off();
        }
        self.push(JobStep::Stop);
        if self.is_raised {
            self.push(JobStep::rapid([None, None, Some(self.at.z())]));
        }
    }

    /// Keeps the spindle off during a stop or a dwell, if the program switches it on anywhere. The cuts after it belong to another operation, which
    /// switches it on again.
    fn keep_spindle_off(&mut self) {
        if !self.starts_spindle || self.is_spindle_kept_off {
            return;
        }
        let coolant = !self.state.coolant.is_some_and(Coolant::is_on);
        self.push(JobStep::SpindleOff { coolant });
        if let Some(operation) = self.job.operations.last_mut().filter(|_| !self.has_cut) {
            // Left unspecified, the spindle would be set from the tool table and start before the stop.
            operation.spindle = Some(Turning::Off);
            operation.coolant = operation.coolant.filter(|_| !coolant).or(coolant.then_some(Coolant::OFF));
        }
        self.is_spindle_kept_off = true;
    }

    /// Handles a tool change. Drops the rapid moves of an operation that has not cut yet, because they only led to the change.
    fn change_tool(&mut self, line: u32, tool: Option<u32>) {
        self.has_cut_with_tool &= self.has_layers;
        // At the start, M6 without T means the tool that is in the spindle; after a cut it means a manual change.
        let has_cut = || self.job.operations.iter().any(Operation::cuts);
        self.unnamed_change = (tool.is_none() && has_cut()).then_some(line);
        let is_new = std::mem::replace(&mut self.state.tool, tool) != tool;
        self.has_cut_with_length = self.has_cut_with_length.filter(|_| !is_new);
        if is_new && self.has_layers {
            // The next layer defines its own speed.
            (self.state.spindle, self.state.speed) = (None, None);
        }
        self.was_changed_low |= is_new && self.at.known.has(Axes::Z) && self.at.z() < self.clearance;
        if self.is_settled() {
            self.begin_same_operation();
        } else {
            self.update_operation();
            let entry = self.entry();
            if let Some(operation) = self.job.operations.last_mut() {
                operation.steps.retain(is_not_rapid);
                operation.entry = entry;
            }
        }
    }

    fn set_spindle(&mut self, spindle: &Spindle) {
        self.state.spindle = match spindle.turning {
            Turning::Unstated if self.has_layers => Some(Turning::Clockwise),
            Turning::Unstated => None,
            turning => Some(turning),
        };
        self.state.speed = spindle.speed.filter(|speed| *speed > 0.0);
        if self.is_spindle_kept_off && self.state.spindle.is_some_and(Turning::is_on) {
            self.begin_same_operation();
        }
        self.update_operation();
    }

    fn set_coolant(&mut self, coolant: Coolant) {
        // Posts have no word for flood and mist together.
        self.state.coolant = Some(if coolant.flood { Coolant::FLOOD } else { coolant });
        self.update_operation();
    }

    fn hole(&mut self, hole: Hole) {
        self.retract_after_change([Some(hole.at[0]), Some(hole.at[1])]);
        self.is_raised = true;
        self.at = Position::known(hole.at[0], hole.at[1], hole.exit);
        self.operation_for_cut().steps.push(JobStep::Hole(hole));
    }

    /// After a tool change below the clearance plane, continues above the next position, because the new tool does not return to where the
    /// old one stopped.
    fn retract_after_change(&mut self, [x, y]: [Option<f64>; 2]) {
        if !std::mem::take(&mut self.was_changed_low) {
            return;
        }
        let operation = self.operation();
        operation.entry = Entry::Clearance;
        operation.steps.push(JobStep::rapid([x, y, None]));
    }

    /// Lets the operation after a tool change begin with the program's own rapid move, if that move is above everything. Otherwise the post would
    /// first return to where the old tool stopped.
    fn enter_by_own_rapid(&mut self, movement: &Move) {
        let [.., before, operation] = self.job.operations.as_mut_slice() else { return };
        let is_high = movement.to.known == Axes::ALL && movement.to.z() >= self.clearance;
        let has_moved =
            operation.steps.iter().any(|step| matches!(step, JobStep::Move(_) | JobStep::Hole(_)));
        if is_high && !has_moved && before.tool.index != operation.tool.index {
            operation.entry = Entry::Clearance;
        }
    }

    fn add_move(&mut self, line: u32, movement: &Move) {
        if movement.named.is_some() {
            return self.refuse(line, &posts::JOB_NAMED_PLACE);
        }
        match (movement.shape, movement.pace) {
            (MoveShape::Line, Pace::Rapid | Pace::Feed(_) | Pace::Probe { toward: true, .. }) => {}
            (MoveShape::Arc(arc), _) if arc.extra_turns == 0 => {
                self.state.plane = arc.plane;
                self.update_operation();
            }
            _ => return self.refuse(line, &posts::JOB_MOVE),
        }
        let step = JobStep::Move(*movement);
        if movement.pace == Pace::Rapid {
            if moves_by_unknown_axis(movement) {
                return self.refuse(line, &posts::JOB_WAY_UNKNOWN);
            }
            if movement.to.z() != movement.from.z() {
                let [x, y, _] = movement.to.axes();
                self.retract_after_change([x, y]);
            }
            self.enter_by_own_rapid(movement);
            self.push(step);
        } else {
            if !is_known(movement, self.has_probed) {
                return self.refuse(line, &posts::JOB_PLACE_UNKNOWN);
            }
            self.was_changed_low = false;
            self.operation_for_cut().steps.push(step);
        }
        self.has_probed = matches!(movement.pace, Pace::Probe { .. });
        self.is_raised = movement.pace == Pace::Rapid && movement.to.known.has(Axes::Z);
        self.at = movement.to;
    }

    fn finish(mut self) -> Result<Job, Vec<Diagnostic>> {
        if !self.errors.is_empty() {
            return Err(self.errors);
        }
        if !self.is_settled() && self.job.operations.len() > 1 {
            self.drop_idle_end();
        }
        self.job.set_surface(0.0);
        self.job.has_no_surface = true;
        Ok(self.job)
    }

    /// Removes the last operation, which cuts nothing. If it has the tool of the last cut, its rapid moves, such as the last retract, become the end of
    /// the operation before.
    fn drop_idle_end(&mut self) {
        let Some(idle) = self.job.operations.pop() else { return };
        let last = self.job.operations.last_mut().filter(|last| last.tool.index == idle.tool.index);
        if let Some(last) = last {
            last.steps.extend(idle.steps.into_iter().filter(|step| !is_not_rapid(step)));
        }
    }
}

impl Job {
    /// Sets the height in mm of the upper face of the material, for all operations.
    pub fn set_surface(&mut self, surface: f64) {
        self.has_no_surface = false;
        for operation in &mut self.operations {
            operation.surface = surface;
            derive_feeds_and_depths(operation, surface);
            let retract = operation.holes().map(|hole| hole.retract).next();
            operation.retract = retract.unwrap_or(operation.retract);
        }
    }
}

fn is_not_rapid(step: &JobStep) -> bool {
    !matches!(step, JobStep::Move(Move { pace: Pace::Rapid, .. }))
}

/// Returns the tool with this number, or an unnamed tool if the program has not named any.
fn tool_with_number(tool: Option<u32>) -> Tool {
    tool.map_or_else(Tool::unnamed, |index| Tool::new(index, 0.0, ""))
}

/// Whether both ends of a cut are known. After a probing move, the start need not be.
fn is_known(movement: &Move, has_probed: bool) -> bool {
    movement.to.known == Axes::ALL && (movement.from.known == Axes::ALL || has_probed)
}

/// Whether a move is relative, along an axis, to a position that only the machine knows, as with G91 after a probe. A job has absolute
/// coordinates only.
fn moves_by_unknown_axis(movement: &Move) -> bool {
    let Move { from, to, .. } = movement;
    (0..3).any(|axis| !to.known.has(Axes::of(axis)) && to.at[axis] != from.at[axis])
}

/// Whether a step raises the tool to the level at which it then moves to a hole of the same line. The rise must remain a move of its own,
/// because the tool must not move there at an angle.
fn rises_to_hole(step: &Step, after: &[Step]) -> bool {
    let is_rise =
        step.as_move().is_some_and(|(_, movement)| movement.pace == Pace::Rapid && rises(&movement));
    is_rise && after.first().is_some_and(|next| next.line == step.line) && hole(after).is_some()
}

/// Whether a move goes straight up from a known height.
fn rises(movement: &Move) -> bool {
    movement.from.known.has(Axes::Z) && movement.keeps_xy() && movement.to.z() > movement.from.z()
}

/// Returns the hole at the beginning of `steps`, and the steps after it. The reader has expanded drilling cycles to moves; all moves of the hole must
/// come from one line. The rapid moves to the hole are combined into one. If one of them rises, the steps are not a hole, because the tool may be in
/// the material.
pub(super) fn hole(steps: &[Step]) -> Option<(Hole, &[Step])> {
    let [first, second, ..] = steps else { return None };
    if first.line != second.line {
        return None;
    }
    let mut moves = LineSteps { line: first.line, steps };
    let mut level = None;
    while let Some(way) = moves.take(|movement| movement.pace == Pace::Rapid && !rises(movement)) {
        level = Some(if way.to.z() < way.from.z() && way.keeps_xy() { way.from.z() } else { way.to.z() });
    }
    let first = moves.take(is_drilling)?;
    let (mut last, mut pecks) = (first, false);
    while let Some(next) = moves.peck(first.from.z()) {
        (last, pecks) = (next, true);
    }
    let dwell = moves.dwell();
    let retract = first.from.z();
    let exit = moves
        .take(|movement| movement.pace == Pace::Rapid && movement.keeps_xy() && movement.to.z() >= retract)?;
    let kind = match (pecks, dwell) {
        (false, None) => HoleKind::Plain,
        (false, Some(seconds)) => HoleKind::Dwell { seconds },
        (true, None) => HoleKind::Peck { depth: retract - first.to.z() },
        (true, Some(_)) => return None,
    };
    let hole = Hole {
        at: [first.to.x(), first.to.y()],
        level: level.unwrap_or(retract),
        retract,
        bottom: last.to.z(),
        exit: exit.to.z(),
        feed: first.pace.feed().filter(|feed| *feed > 0.0),
        kind,
    };
    Some((hole, moves.steps))
}

struct LineSteps<'a> {
    line: u32,
    steps: &'a [Step],
}

impl<'a> LineSteps<'a> {
    /// Takes the next move if it is straight, leads to a known position and satisfies the condition.
    fn take(&mut self, is_wanted: impl Fn(&Move) -> bool) -> Option<Move> {
        let (step, rest) = self.next()?;
        let Action::Move(movement) = step.action else { return None };
        let is_plain =
            movement.shape == MoveShape::Line && movement.named.is_none() && movement.to.known == Axes::ALL;
        (is_plain && is_wanted(&movement)).then(|| {
            self.steps = rest;
            movement
        })
    }

    /// Takes the moves of a peck: out of the hole, back down, and deeper. Takes nothing if they are not next.
    fn peck(&mut self, retract: f64) -> Option<Move> {
        let before = self.steps;
        let is_rapid = |movement: &Move| movement.pace == Pace::Rapid && movement.keeps_xy();
        let deeper = self.take(|movement| is_rapid(movement) && movement.to.z() == retract).and_then(|_| {
            self.take(|movement| is_rapid(movement) && movement.to.z() <= retract);
            self.take(is_drilling)
        });
        if deeper.is_none() {
            self.steps = before;
        }
        deeper
    }

    /// Returns the next step of the line, and the steps after it.
    fn next(&self) -> Option<(&'a Step, &'a [Step])> {
        self.steps.split_first().filter(|(step, _)| step.line == self.line)
    }

    fn dwell(&mut self) -> Option<f64> {
        let (step, rest) = self.next()?;
        let Action::Dwell(seconds) = step.action else { return None };
        self.steps = rest;
        Some(seconds)
    }
}

fn is_drilling(movement: &Move) -> bool {
    matches!(movement.pace, Pace::Feed(_))
        && movement.keeps_xy()
        && movement.to.z() < movement.from.z()
        && movement.from.known == Axes::ALL
}

/// Returns a warning for the first of each kind of word that the output of a post replaces: optional stops, stops with a change of the
/// pallet, probing without an alarm, and mist beside flood.
pub fn altered_word_warnings(steps: &[Step]) -> Vec<Diagnostic> {
    let mut found: Vec<Diagnostic> = Vec::new();
    for step in steps {
        let Some((word, written)) = replacement(&step.action) else { continue };
        let warning = Diagnostic::new(&gcode::WORD_ALTERED).quoting("word", word).quoting("written", written);
        if found.iter().all(|other| other.arguments != warning.arguments) {
            found.push(warning.at_line(step.line, None));
        }
    }
    found
}

/// Returns the word of an action that posts replace, and its replacement; `None` if posts write the action unchanged.
fn replacement(action: &Action) -> Option<(&'static str, &'static str)> {
    match action {
        Action::Stop { optional: true } => Some(("M1", "M0")),
        Action::Word(word) if (word.letter, word.code) == ('M', 600) => Some(("M60", "M0")),
        Action::Move(Move { pace: Pace::Probe { toward: true, must_answer: false, .. }, .. }) => {
            Some(("G38.3", "G38.2"))
        }
        Action::Coolant(Coolant { mist: true, flood: true }) => Some(("M7 M8", "M8")),
        _ => None,
    }
}
