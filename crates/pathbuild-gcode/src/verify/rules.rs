//! Rules about the position of the tool and the state of the spindle.

use std::fmt;

use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_diagnostic::{Diagnostic, Message};
use pathbuild_motion::{
    Action, Arc, Axes, Change, Move, MoveShape, NamedPosition, Pace, Plane, Position, Spindle, Step, Turning,
};

use super::frames::Frames;
use super::material::Stock;
use super::tip_height::TipHeight;
use crate::dialect::{Dialect, ToolChanger};
use crate::interpret::code_name;
use crate::native::announces_probe;
use crate::read::Problems;

/// Tolerance in mm within which heights are equal.
pub(super) const HEIGHT_TOLERANCE: f64 = 0.002;

/// The rules that need no map of the material: pass every step of a program, then call [`finish`](Self::finish). The cost is
/// proportional to the number of steps.
#[expect(clippy::struct_excessive_bools, reason = "independent facts, which may hold together")]
pub struct Rules<'c> {
    stock: Option<&'c Stock>,
    problems: Problems,
    at: Position,
    /// The last line with a move.
    line: u32,
    /// Position of the current step in the order of execution.
    order: u32,
    tip_height: TipHeight,
    spindle: Spindle,
    /// The line of the first cut before any spindle word.
    cut_before_spindle: Option<u32>,
    /// Whether it has been reported that the spindle does not turn.
    is_spindle_reported: bool,
    /// Whether it has been reported that the spindle turns in a probing move.
    is_turning_probe_reported: bool,
    /// The line that last switched the spindle.
    spindle_line: u32,
    /// Whether the last move probed downwards.
    has_probed: bool,
    /// The height in mm at which the last probe would have stopped without contact; `None` once the program states a height.
    probe_end: Option<f64>,
    /// The line of a comment that announces the next probe.
    announced_probe: Option<u32>,
    has_cut: bool,
    /// Whether a cut at an unknown position has been reported.
    is_position_reported: bool,
    /// Whether the last move in Z went to a machine position, whose height in the program's coordinates is unknown.
    is_height_homed: bool,
    directions: ArcDirections,
    /// Whether the operator changes the tool at M6.
    has_manual_change: bool,
    /// The words of a tool change by hand since the last move: T and a stop.
    by_hand: ChangeByHand,
    /// The line of the first stop since the last move, if the tool is in the material there.
    stop_at_depth: Option<u32>,
    frames: Frames,
    /// Whether the next move begins in another frame.
    changes_frame: bool,
    /// Line and code (times ten) of the active G52 or G92, and whether it came after the first cut.
    shifted: Option<(u32, u16, bool)>,
}

impl fmt::Debug for Rules<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Rules").field("line", &self.line).finish_non_exhaustive()
    }
}

impl<'c> Rules<'c> {
    /// Creates the rules for the beginning of a program; `stock` is `None` if the material is unknown.
    pub fn new(stock: Option<&'c Stock>) -> Self {
        Self {
            stock,
            problems: Problems::default(),
            at: Position::default(),
            line: 0,
            order: 0,
            tip_height: TipHeight::new(Dialect::Rs274),
            spindle: Spindle::UNSTATED,
            cut_before_spindle: None,
            is_spindle_reported: false,
            is_turning_probe_reported: false,
            spindle_line: 0,
            has_probed: false,
            probe_end: None,
            announced_probe: None,
            has_cut: false,
            is_position_reported: false,
            is_height_homed: false,
            directions: ArcDirections::default(),
            has_manual_change: false,
            by_hand: ChangeByHand::default(),
            stop_at_depth: None,
            frames: Frames::default(),
            changes_frame: false,
            shifted: None,
        }
    }

    /// Adapts the rules to the dialect of the program.
    pub fn in_dialect(mut self, dialect: Dialect) -> Self {
        self.tip_height = TipHeight::new(dialect);
        self.has_manual_change = dialect.rules().changer == ToolChanger::Operator;
        self
    }

    /// Processes the next step of the program.
    pub fn step(&mut self, step: &Step) {
        let line = step.line;
        self.order = step.order;
        let zero_moves = self.frames.current().zero_moves;
        // If the operator has set the zero, the tool has been moved by hand, and the rule for the tip's height checks the moves that follow.
        self.changes_frame |= self.frames.step(step) && self.frames.current().zero_moves == zero_moves;
        if let Some((line, message)) = self.tip_height.step(step) {
            self.problems.add_at_line(message, line, |d| d);
        }
        match &step.action {
            Action::Move(movement) => self.check_move(line, movement),
            Action::Spindle(spindle) => self.check_spindle_switch(line, *spindle),
            Action::Change(Change::Offsets { code, are_shifted: Some(are_shifted), .. }) => {
                self.shifted = are_shifted.then_some((line, *code, self.has_cut));
            }
            Action::End => self.spindle.turning = Turning::Unstated,
            Action::Comment(text) if announces_probe(text) => {
                self.check_announced_probe(None);
                self.announced_probe = Some(line);
            }
            Action::Comment(text) if tool_to_insert(text).is_some() => self.select_tool(line),
            Action::ChangeTool(_) => {
                if self.has_manual_change && self.spindle.turning.is_on() {
                    self.problems.add_at_line(&say::SPINNING_AT_CHANGE, line, |d| d);
                }
                self.check_tool_change(line);
            }
            Action::SelectTool(_) => self.select_tool(line),
            Action::Stop { optional } => {
                if self.at.known.has(Axes::Z) && self.surface_above(self.at.z()).is_some() {
                    self.stop_at_depth.get_or_insert(line);
                }
                if !optional {
                    self.by_hand.is_stopped = true;
                    self.by_hand.spinning = self.spindle.turning.is_on().then_some(line);
                    self.check_change_by_hand(line);
                }
            }
            _ => {}
        }
    }

    /// Returns all problems, ordered by line.
    pub fn finish(mut self) -> Vec<Diagnostic> {
        self.check_announced_probe(None);
        self.check_end();
        self.problems.into_diagnostics()
    }

    fn check_move(&mut self, line: u32, movement: &Move) {
        self.line = line;
        self.by_hand = ChangeByHand::default();
        self.report_stop();
        self.check_diagonal(line, movement);
        self.check_home_move(line, movement);
        self.check_first_move_in_frame(line, movement);
        let replaces_probe =
            movement.pace != Pace::Rapid && self.check_announced_probe(Some((line, movement)));
        check_probe_direction(line, movement, &mut self.problems);
        self.check_turning_probe(line, movement);
        self.check_after_probe(line, movement);
        if !replaces_probe {
            self.check_cutting(line, movement);
        }
        self.directions.add(line, movement, &mut self.problems);
        self.is_height_homed =
            !movement.to.known.has(Axes::Z) && (self.is_height_homed || movement.homes_z());
        self.at = movement.to;
    }

    /// Checks moves to machine positions, which are straight rapid moves from the position of the tool.
    fn check_home_move(&mut self, line: u32, movement: &Move) {
        let stays = movement.to.known.has(Axes::XY) && movement.keeps_xy();
        if movement.named.is_some() && !stays {
            self.report_if_below_surface(&say::HOME_FROM_DEPTH, line, movement.from);
        }
    }

    /// Checks the first move in another coordinate system. The direction of this move is unknown.
    fn check_first_move_in_frame(&mut self, line: u32, movement: &Move) {
        let leaves = std::mem::take(&mut self.changes_frame);
        let rises = movement.keeps_xy() && movement.to.z() >= movement.from.z();
        if leaves && !rises && movement.named.is_none() {
            self.report_if_below_surface(&say::SYSTEM_FROM_DEPTH, line, self.at);
        }
    }

    fn check_spindle_switch(&mut self, line: u32, spindle: Spindle) {
        let before = std::mem::replace(&mut self.spindle, spindle);
        if spindle.turning == Turning::Unstated {
            return;
        }
        if let Some(line) = self.cut_before_spindle.take() {
            self.problems.add_at_line(&say::SPINDLE_OFF, line, |d| d);
        }
        if before != spindle {
            self.is_spindle_reported = false;
            self.is_turning_probe_reported = false;
        }
        self.spindle_line = line;
    }

    /// Returns the height of the material's surface at the current step in mm if it is above `z`, the height of the tool's tip.
    fn surface_above(&self, z: f64) -> Option<f64> {
        let surface = self.stock?.at(self.order)?.surface;
        (z < surface - HEIGHT_TOLERANCE).then_some(surface)
    }

    /// Reports a tool below the surface of the material; nothing if its height is unknown.
    fn report_if_below_surface(&mut self, message: &'static Message, line: u32, at: Position) {
        if !at.known.has(Axes::Z) {
            return;
        }
        if let Some(surface) = self.surface_above(at.z()) {
            self.problems.add_at_line(message, line, |d| d.with("z", at.z()).with("surface", surface));
        }
    }

    fn check_diagonal(&mut self, line: u32, movement: &Move) {
        let is_diagonal = !movement.keeps_xy() && movement.to.z() < movement.from.z();
        if movement.pace == Pace::Rapid && movement.is_known() && is_diagonal {
            self.report_if_below_surface(&say::DIAGONAL_RAPID, line, movement.to);
        }
    }

    /// Checks that the spindle turns, but only in programs that switch it: on many machines the operator switches the spindle.
    fn check_cutting(&mut self, line: u32, movement: &Move) {
        if !is_cut_after_approach(movement) {
            return;
        }
        self.has_cut = true;
        self.check_cut_position(line, movement);
        if is_above_stock(self.order, movement, self.stock) {
            return;
        }
        let message = match (self.spindle.turning, self.spindle.speed) {
            (Turning::Unstated, _) => {
                self.cut_before_spindle.get_or_insert(line);
                return;
            }
            (Turning::Off, _) => &say::SPINDLE_OFF,
            (Turning::Clockwise | Turning::CounterClockwise, Some(0.0)) => &say::SPINDLE_AT_ZERO,
            // The control may have kept a speed from the previous program.
            (Turning::Clockwise | Turning::CounterClockwise, None) => &say::SPINDLE_WITHOUT_SPEED,
            (Turning::Clockwise | Turning::CounterClockwise, Some(_)) => return,
        };
        if !std::mem::replace(&mut self.is_spindle_reported, true) {
            self.problems.add_at_line(message, line, |d| d);
        }
    }

    /// Checks that a probe which a comment announces is made by `next`, the next move that is not rapid; `None` if there is none before the next such
    /// comment. Any other move would not stop at the material. Returns whether the probe is missing.
    fn check_announced_probe(&mut self, next: Option<(u32, &Move)>) -> bool {
        let Some(comment) = self.announced_probe.take() else { return false };
        let is_missing = !next.is_some_and(|(_, movement)| movement.probes_down());
        if is_missing {
            let line = next.map_or(comment, |(line, _)| line);
            self.problems.add_at_line(&say::PROBE_MISSING, line, |d| d.with("comment", u64::from(comment)));
        }
        is_missing
    }

    fn check_turning_probe(&mut self, line: u32, movement: &Move) {
        let is_probe = matches!(movement.pace, Pace::Probe { .. });
        if is_probe
            && self.spindle.turning.is_on()
            && !std::mem::replace(&mut self.is_turning_probe_reported, true)
        {
            self.problems.add_at_line(&say::PROBE_WITH_SPINDLE_ON, line, |d| d);
        }
    }

    /// Reports the first cut at an unknown position in the plane, because other checks ignore such moves, and a cut at the height of a machine
    /// position.
    fn check_cut_position(&mut self, line: u32, movement: &Move) {
        // Programs for a rotary axis use only X or Y, so one known axis suffices.
        let is_unknown = movement.from.known.and(movement.to.known).and(Axes::XY).is_empty();
        if is_unknown && movement.named.is_none() && !std::mem::replace(&mut self.is_position_reported, true)
        {
            self.problems.add_at_line(&say::UNKNOWN_POSITION, line, |d| d);
        }
        let is_homed = self.is_height_homed && !movement.to.known.has(Axes::Z) && movement.named.is_none();
        if is_homed && std::mem::take(&mut self.is_height_homed) {
            self.problems.add_at_line(&say::HEIGHT_OF_MACHINE, line, |d| d);
        }
    }

    /// Checks the move after a probe, when the touched material is still below the tool.
    fn check_after_probe(&mut self, line: u32, movement: &Move) {
        let stays_in_plane = movement.keeps_xy();
        let is_known = movement.from.known.and(movement.to.known).and(Axes::XY) == Axes::XY;
        let homed = movement.named.map_or(Axes::NONE, NamedPosition::axes);
        let goes_home = !homed.and(Axes::XY).is_empty();
        if self.has_probed && (is_known && !stays_in_plane || goes_home) {
            self.problems.add_at_line(&say::PROBE_NOT_RAISED, line, |d| d);
        }
        self.check_below_contact(line, movement);
        self.has_probed = matches!(movement.pace, Pace::Probe { toward: true, .. }) && stays_in_plane;
    }

    /// Checks rapid moves after a downward probe: the material that the probe touched cannot be below the end of its move.
    fn check_below_contact(&mut self, line: u32, movement: &Move) {
        let end = self.probe_end.take().filter(|_| !movement.from.known.has(Axes::Z) && !movement.homes_z());
        let is_probe = matches!(movement.pace, Pace::Probe { toward: true, .. });
        if let Some(end) = end.filter(|end| movement.pace == Pace::Rapid && movement.to.z() < *end) {
            self.problems
                .add_at_line(&say::RAPID_BELOW_CONTACT, line, |d| d.with("below", end - movement.to.z()));
        }
        self.probe_end = if is_probe && movement.keeps_xy() && movement.to.known.has(Axes::Z) {
            Some(movement.to.z())
        } else {
            end.filter(|_| !movement.to.known.has(Axes::Z))
        };
    }

    fn select_tool(&mut self, line: u32) {
        self.by_hand.is_selected = true;
        self.check_change_by_hand(line);
    }

    /// Checks a tool change by hand: T, or a message that names the tool, and a stop, in any order, without a move between them.
    fn check_change_by_hand(&mut self, line: u32) {
        if self.by_hand.is_selected && self.by_hand.is_stopped {
            let ChangeByHand { spinning, .. } = std::mem::take(&mut self.by_hand);
            if let Some(stop) = spinning {
                self.problems.add_at_line(&say::SPINNING_AT_CHANGE, stop, |d| d);
            }
            self.check_tool_change(line);
        }
    }

    /// Reports a stop with the tool in the material. At the end of a program, [`check_end`](Self::check_end) reports it instead.
    fn report_stop(&mut self) {
        if let Some(line) = self.stop_at_depth.take() {
            self.report_if_below_surface(&say::STOP_AT_DEPTH, line, self.at);
        }
    }

    fn check_tool_change(&mut self, line: u32) {
        self.stop_at_depth = None;
        self.report_if_below_surface(&say::TOOL_CHANGE_AT_DEPTH, line, self.at);
    }

    fn check_end(&mut self) {
        if !matches!(self.spindle.turning, Turning::Off | Turning::Unstated) {
            self.problems.add_at_line(&say::SPINDLE_LEFT_ON, self.spindle_line, |d| d);
        }
        if let Some((line, code, is_late)) = self.shifted {
            self.problems.add_at_line(&say::OFFSET_LEFT_ON, line, |d| {
                let found = d.quoting("word", code_name('G', code));
                if is_late { found.as_error() } else { found }
            });
        }
        self.report_if_below_surface(&say::END_NOT_RAISED, self.line, self.at);
    }
}

/// Returns the number of the tool that a message of the built-in post for Marlin, which has no T, tells the operator to insert.
pub(crate) fn tool_to_insert(comment: &str) -> Option<u32> {
    comment.trim().strip_prefix("Insert T")?.split_once(", ")?.0.parse().ok()
}

/// Progress of a tool change by hand on a machine without M6: which of its two signs, a selected tool and a stop, have occurred since the last move.
#[derive(Clone, Copy, Debug, Default)]
struct ChangeByHand {
    is_selected: bool,
    is_stopped: bool,
    /// The line of the stop, if the spindle turned there.
    spinning: Option<u32>,
}

/// Rule that finds arcs at whose two ends the direction of travel reverses, between straight cuts. The arc in the other direction would
/// continue both cuts, so G2 and G3 are probably exchanged.
#[derive(Debug, Default)]
struct ArcDirections {
    /// The direction of the straight cut at the current position.
    straight: Option<[f64; 2]>,
    /// An arc that turns back from the cut before it, with its line and the direction at its end.
    arc: Option<(u32, Arc, [f64; 2])>,
}

impl ArcDirections {
    fn add(&mut self, line: u32, movement: &Move, problems: &mut Problems) {
        let (from, to) = (&movement.from, &movement.to);
        let before = std::mem::take(self);
        let is_level = from.known.and(to.known) == Axes::ALL && from.z() == to.z();
        if !is_level || !movement.is_cut() {
            return;
        }
        match movement.shape {
            MoveShape::Line => {
                let way = [to.x() - from.x(), to.y() - from.y()];
                let length = libm::hypot(way[0], way[1]);
                let direction = way.map(|share| share / length);
                self.straight = Some(direction);
                if let Some((line, arc, _)) = before.arc.filter(|(.., end)| is_opposite(*end, direction)) {
                    let word = if arc.clockwise { "G3" } else { "G2" };
                    problems.add_at_line(&say::ARC_DOUBLES_BACK, line, |d| d.quoting("word", word));
                }
            }
            MoveShape::Arc(arc) => {
                let is_back = |straight| is_opposite(straight, arc.tangent(&from.at));
                if arc.plane == Plane::Xy && before.straight.is_some_and(is_back) {
                    self.arc = Some((line, arc, arc.tangent(&to.at)));
                }
            }
        }
    }
}

/// Whether two directions are opposite, within about 10 degrees.
fn is_opposite(one: [f64; 2], other: [f64; 2]) -> bool {
    one[0] * other[0] + one[1] * other[1] < -0.985
}

/// Whether a move cuts, and does not stay above the material.
pub(super) fn is_cut_in_stock(order: u32, movement: &Move, stock: Option<&Stock>) -> bool {
    is_cut_after_approach(movement) && !is_above_stock(order, movement, stock)
}

fn is_cut_after_approach(movement: &Move) -> bool {
    movement.is_cut() && !is_first_height(movement)
}

/// Whether a move stays above the material; false if that is unknown.
fn is_above_stock(order: u32, movement: &Move, stock: Option<&Stock>) -> bool {
    let surface = stock.and_then(|stock| stock.at(order)).map(|piece| piece.surface);
    movement.is_known() && surface.is_some_and(|surface| movement.lowest() >= surface)
}

/// Whether a move sets the height at the beginning of a program, as Easel does with `G1 Z0.15` before it starts the spindle.
fn is_first_height(movement: &Move) -> bool {
    let stays = movement.keeps_xy() && matches!(movement.shape, MoveShape::Line);
    stays && !movement.from.known.has(Axes::Z) && movement.to.known.has(Axes::Z)
}

/// Checks that a probe moves towards the material, which is below.
fn check_probe_direction(line: u32, movement: &Move, problems: &mut Problems) {
    let Pace::Probe { toward: true, .. } = movement.pace else { return };
    let stays_in_plane = movement.keeps_xy();
    if !movement.is_known() || !stays_in_plane {
        return;
    }
    if movement.to.z() == movement.from.z() {
        problems.add_at_line(&say::PROBE_WITHOUT_WAY, line, |d| d);
    } else if movement.to.z() > movement.from.z() {
        problems.add_at_line(&say::USELESS_PROBE, line, |d| d);
    }
}
