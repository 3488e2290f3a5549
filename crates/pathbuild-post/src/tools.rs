//! Checks that a text makes each cut with the tool, the tool length and the spindle of the job, and that the spindle does not turn
//! where the operator changes the tool. (book: program/posts, "Before a program is written")

use pathbuild_diagnostic::messages::{gcode, posts};
use pathbuild_diagnostic::{Diagnostic, Message};
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::verify::{LengthFit, TipHeight, ToolState};
use pathbuild_motion::{Action, Change, Coolant, Move, Pace, Step, ToolLength, Turning};

use crate::job::{Job, JobStep, Operation};
use crate::read_back_options::ReadBackOptions;
use crate::traverse::MatchedCut;

/// Difference in spindle speed, in 1/min, that is attributed to rounding. Some definitions write whole numbers.
const SPEED_TOLERANCE: f64 = 0.5 * (1.0 + 1e-6);

/// Returns the first problem of each kind. `cuts` are the cuts of the text, in order.
pub(super) fn check(
    steps: &[Step],
    job: &Job,
    cuts: &[MatchedCut],
    expected: &ReadBackOptions<'_>,
) -> Vec<Diagnostic> {
    let mut checker = ToolChecker::new(steps, job, expected);
    let mut rest = cuts;
    let mut current: Option<MatchedCut> = None;
    for step in steps {
        checker.step(step);
        let Action::Move(movement) = &step.action else { continue };
        if movement.pace == Pace::Rapid {
            continue;
        }
        if let Some((next, after)) = rest.split_first().filter(|((line, _), _)| *line == step.line) {
            (current, rest) = (Some(*next), after);
        }
        if let Some((_, number)) = current.filter(|(line, _)| *line == step.line) {
            checker.check_stops_before(number);
            checker.check_cut(step.line, movement, number);
        }
    }
    checker.check_stops_before(u32::MAX);
    checker.problems
}

/// Whether a text switches coolant on.
pub(super) fn switches_coolant_on(steps: &[Step]) -> bool {
    steps.iter().any(|step| matches!(step.action, Action::Coolant(coolant) if coolant.is_on()))
}

struct ToolChecker<'j> {
    /// The operations to which the steps of the job belong, one for each step.
    operations: Vec<&'j Operation>,
    tools: ToolState,
    words: ToolWords,
    is_manual: bool,
    is_for_beam: bool,
    /// State of the coolant; `None` if it is not compared.
    coolant: Option<Coolant>,
    /// Height in mm above which cuts are moves in the air.
    surface: f64,
    /// Number of the tool that made the last cut.
    last: Option<u32>,
    /// Line of the first stop since the last cut, in a text without M6, if the spindle turned there: the operator changes the tool at it.
    spinning: Option<u32>,
    tip_height: TipHeight,
    /// Line of the first move in the plane after a stop since the last cut, if the text states no height between the stop and the move.
    moved_low: Option<u32>,
    /// For each step of the job, whether the spindle may turn during it if it is a stop; `None` for other steps.
    stops: Vec<Option<bool>>,
    /// Number of the job's steps up to and including the one to which the last cut belongs.
    reached: usize,
    /// Lines of the stops since the last cut at which the spindle turns.
    turning_stops: Vec<u32>,
    problems: Vec<Diagnostic>,
}

/// The kinds of tool words that a text contains.
#[derive(Clone, Copy, Debug)]
#[expect(clippy::struct_excessive_bools, reason = "independent facts, not states")]
struct ToolWords {
    /// Whether there are words that select or change a tool: T or M6.
    has_selection: bool,
    /// Whether there are M6 words.
    has_change: bool,
    /// Whether the text sets tool lengths with G43. G43 H0 counts as well: it cancels the length, so no tool may cut with it.
    has_length: bool,
    /// Whether the target is XpertMILL, where M6 selects a layer instead of a tool. The first layer applies from the beginning.
    has_layers: bool,
    /// Whether a control is named and the text has no M6, so that the operator may have to change the tool at a stop.
    is_changed_by_hand: bool,
}

impl ToolWords {
    fn new(steps: &[Step], target: Option<Dialect>) -> Self {
        let any = |is_such: fn(&Action) -> bool| steps.iter().any(|step| is_such(&step.action));
        let has_change = any(|action| matches!(action, Action::ChangeTool(_)));
        Self {
            has_selection: any(|action| matches!(action, Action::SelectTool(_) | Action::ChangeTool(_))),
            has_change,
            has_length: any(|action| {
                matches!(action, Action::Change(Change::ToolLength(ToolLength::OfTool(_))))
            }),
            has_layers: target.is_some_and(|target| target.rules().layers),
            is_changed_by_hand: target.is_some() && !has_change,
        }
    }
}

/// Returns for each step of a job whether the spindle may turn there, if the step is a stop.
fn stops(job: &Job) -> Vec<Option<bool>> {
    let mut is_on = job.operations.iter().all(|operation| operation.spindle.is_none());
    let mut stops = Vec::new();
    for operation in &job.operations {
        is_on = operation.spindle.map_or(is_on, Turning::is_on);
        for step in &operation.steps {
            is_on &= !matches!(step, JobStep::SpindleOff { .. });
            stops.push(matches!(step, JobStep::Stop).then_some(is_on));
        }
    }
    stops
}

impl<'j> ToolChecker<'j> {
    fn new(steps: &[Step], job: &'j Job, expected: &ReadBackOptions<'_>) -> Self {
        let ReadBackOptions { wording, is_manual, is_for_beam, follows_coolant, .. } = *expected;
        let cutting = job.operations.iter().filter(|operation| operation.cuts());
        let surface = cutting.map(|operation| operation.surface).reduce(f64::max);
        Self {
            operations: job.operations_by_step(),
            tools: ToolState::new(wording.reader()),
            words: ToolWords::new(steps, wording.control().map(|control| control.reader)),
            is_manual,
            is_for_beam,
            coolant: (follows_coolant && switches_coolant_on(steps)).then(Coolant::default),
            surface: surface.filter(|_| !job.has_no_surface && !is_for_beam).unwrap_or(f64::INFINITY),
            last: None,
            spinning: None,
            tip_height: TipHeight::new(wording.reader()),
            moved_low: None,
            stops: stops(job),
            reached: 0,
            turning_stops: Vec::new(),
            problems: Vec::new(),
        }
    }

    fn step(&mut self, step: &Step) {
        self.moved_low = self.moved_low.or(self.tip_height.first_move_since_stop());
        self.tip_height.step(step);
        if let (Action::Coolant(coolant), Some(now)) = (&step.action, &mut self.coolant) {
            *now = *coolant;
        }
        if matches!(step.action, Action::Stop { .. }) {
            // The tool is changed at M6 or, in a text without M6, at the first stop after a cut. Further stops before the next cut are pauses.
            let changes = !self.tools.has_stopped() && !self.words.has_change;
            let is_on = self.tools.spindle().turning.is_on();
            self.turning_stops.extend(is_on.then_some(step.line));
            self.spinning = self.spinning.or((changes && is_on).then_some(step.line));
        }
        self.tools.step(step);
    }

    /// Compares the stops between the last cut and the step with this number (from 1) of the job. If the spindle stands still at one of
    /// them in the job, the text must not have more stops with a turning spindle than the job has.
    fn check_stops_before(&mut self, number: u32) {
        let end = usize::try_from(number).unwrap_or(usize::MAX).min(self.stops.len());
        let stops = self.stops.get(self.reached..end).unwrap_or_default();
        let count = |turns: bool| stops.iter().filter(|stop| **stop == Some(turns)).count();
        let (turning, still) = (count(true), count(false));
        self.reached = self.reached.max(end);
        let turning_stops = std::mem::take(&mut self.turning_stops);
        if let Some(line) = turning_stops.get(turning).filter(|_| still > 0 && !self.is_manual) {
            self.report(&posts::SPINDLE_TURNS_AT_STOP, *line, |d| d);
        }
    }

    /// Handles a cut that belongs to the step with this number (from 1) of the job.
    fn check_cut(&mut self, line: u32, movement: &Move, number: u32) {
        let index = usize::try_from(number).unwrap_or(usize::MAX).wrapping_sub(1);
        let Some(operation) = self.operations.get(index).copied() else { return };
        let is_low = movement.lowest() < self.surface;
        if !movement.is_cut() || !is_low {
            return;
        }
        if let Some(tool) = operation.tool.is_named.then_some(operation.tool.index) {
            self.check_tool(line, tool);
            self.check_length(line, tool);
            self.last = Some(tool);
        }
        self.check_spindle(line, operation);
        self.check_coolant(line, operation);
        self.tools.cut();
        (self.spinning, self.moved_low) = (None, None);
    }

    fn report(
        &mut self,
        message: &'static Message,
        line: u32,
        values: impl FnOnce(Diagnostic) -> Diagnostic,
    ) {
        if self.problems.iter().all(|problem| problem.message != message) {
            self.problems.push(values(Diagnostic::new(message)).at_line(line, None));
        }
    }

    fn check_tool(&mut self, line: u32, expected: u32) {
        let is_changed = self.last.is_some_and(|last| last != expected);
        if let Some(stop) = self.spinning.filter(|_| is_changed) {
            self.report(&gcode::SPINNING_AT_CHANGE, stop, |d| d);
        }
        let is_by_hand = is_changed && !self.words.has_change && !self.is_for_beam;
        if let Some(line) = self.moved_low.filter(|_| is_by_hand) {
            self.report(&gcode::CHANGE_NOT_RAISED, line, |d| d);
        }
        let first = self.words.has_layers.then_some(1);
        let selected = self.tools.selected().filter(|_| !self.words.has_change);
        match self.tools.inserted().or(selected).or(first) {
            Some(found) if found != expected => self.report(&posts::TOOL_OTHER, line, |d| {
                d.with("found", u64::from(found)).with("expected", u64::from(expected))
            }),
            // In a text without any T, the operator inserts the first tool before the start, and each further tool where the program
            // stops.
            None if self.words.has_selection || is_changed && !self.tools.has_stopped() => {
                self.report(&posts::TOOL_NOT_SELECTED, line, |d| d.with("expected", u64::from(expected)));
            }
            Some(_) if self.words.is_changed_by_hand && self.tools.lacks_stop() => {
                self.report(&posts::TOOL_NOT_CHANGED, line, |d| d.with("expected", u64::from(expected)));
            }
            _ => {}
        }
    }

    fn check_length(&mut self, line: u32, expected: u32) {
        let fits = match self.tools.length_fit_for(Some(expected)) {
            LengthFit::Fits | LengthFit::Unknown => true,
            LengthFit::Unstated | LengthFit::Off => !self.words.has_length,
            LengthFit::Outdated | LengthFit::OfEntry(_) => false,
        };
        if !fits {
            self.report(&posts::LENGTH_OTHER, line, |d| d.with("expected", u64::from(expected)));
        }
    }

    /// Compares whether any coolant flows. Definitions may write one word for flood and mist.
    fn check_coolant(&mut self, line: u32, operation: &Operation) {
        let Some((expected, found)) = operation.coolant.zip(self.coolant) else { return };
        match (expected.is_on(), found.is_on()) {
            (true, false) => self.report(&posts::COOLANT_OFF, line, |d| d),
            (false, true) => self.report(&posts::COOLANT_ON, line, |d| d),
            _ => {}
        }
    }

    /// Compares the spindle with the operation: its direction, if the program must switch it on, and its speed, if both the job and the text state
    /// it.
    fn check_spindle(&mut self, line: u32, operation: &Operation) {
        let found = self.tools.spindle();
        let turning = operation.spindle.filter(|turning| turning.is_on() && !self.is_manual);
        // In a layer of XpertMILL without an S of its own, the spindle does not turn at the speed of another layer.
        let speed = operation.speed.filter(|_| found.speed.is_some() || self.words.has_layers);
        // Cuts with a spindle that does not turn are reported by the rules of `verify`.
        if found.turning == Turning::Off
            || !self.tools.has_other_spindle_state(turning, speed, SPEED_TOLERANCE)
        {
            return;
        }
        match (turning, found.turning) {
            (Some(_), Turning::Unstated) => self.report(&posts::SPINDLE_NOT_STARTED, line, |d| d),
            (Some(expected), now) if now != expected => self.report(&posts::SPINDLE_OTHER_WAY, line, |d| d),
            _ => {
                let (found, expected) = (found.speed.unwrap_or_default(), speed.unwrap_or_default());
                self.report(&posts::SPINDLE_OTHER_SPEED, line, |d| {
                    d.with("found", found).with("expected", expected)
                });
            }
        }
    }
}
