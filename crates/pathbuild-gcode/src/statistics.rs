//! Calculates the statistics of a program from its moves: their number, lengths and times, bounding box, tools, feeds. (book: program/gcode; book:
//! program/reading, `import`)

use std::collections::{HashMap, HashSet};

use pathbuild_diagnostic::{Code, Diagnostic};
use pathbuild_motion::{Action, Axes, Move, MoveShape, Pace, Spindle, Step};
use pathbuild_toolpath::{Program, Statistics, Total};

/// Calculates the statistics of a program from its moves; `rapid` is the rapid feed in mm/min. A compatible program gets the statistics that
/// PathDxf2GCode writes.
pub fn statistics(program: &Program, rapid: f64) -> Statistics {
    if program.compatible {
        return Statistics::of_reference(program, rapid);
    }
    let mut tally = Tally::default();
    for (_, movement) in program.moves() {
        tally.add(&movement, true);
    }
    Statistics {
        milling: tally.milling.total,
        drilling: tally.drilling.total,
        sweeps: tally.rapid_total(rapid),
        commands: tally.moves(),
    }
}

/// Filter for the moves of a parsed program whose length is included in totals: those between positions that are completely known and that the
/// program has specified since the last tool change.
#[derive(Clone, Copy, Debug, Default)]
pub struct LengthFilter {
    /// The axes specified before the current step.
    stated: Axes,
}

impl LengthFilter {
    /// Whether the length of the next step is included in totals. Must be called for every step.
    pub fn includes_length(&mut self, step: &Step) -> bool {
        let stated = std::mem::replace(&mut self.stated, step.stated);
        match &step.action {
            Action::Move(movement) => [stated, step.stated, movement.from.known, movement.to.known]
                .iter()
                .all(|axes| axes.has(Axes::ALL)),
            _ => false,
        }
    }
}

/// Totals by kind of move.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tally {
    /// Rapid moves. Their time depends on the rapid feed of the machine.
    pub rapid: MoveTotals,
    /// Cutting moves other than drilling.
    pub milling: MoveTotals,
    /// Straight cutting moves up or down.
    pub drilling: MoveTotals,
    /// Number of probing moves. Their length is not counted, because it is not known in advance how far they go.
    pub probing: u64,
    /// Number of arcs among all moves.
    pub arcs: u64,
}

/// The totals of one kind of move.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MoveTotals {
    /// Number of moves, including moves of unknown length.
    pub moves: u64,
    /// Length in mm, and length / feed in minutes, which is infinite if some feed is unknown.
    pub total: Total,
}

impl Tally {
    /// Returns the number of all moves, including probing moves.
    pub fn moves(&self) -> u64 {
        [self.rapid, self.milling, self.drilling].iter().map(|kind| kind.moves).sum::<u64>() + self.probing
    }

    /// Returns the length and the time of milling and drilling.
    pub fn cutting(&self) -> Total {
        self.milling.total + self.drilling.total
    }

    /// Returns the length and the time of all moves except probing moves; `rapid` is the rapid feed in mm/min.
    pub fn sum(&self, rapid: f64) -> Total {
        self.cutting() + self.rapid_total(rapid)
    }

    fn rapid_total(&self, rapid: f64) -> Total {
        let length = self.rapid.total.length;
        // Moves without length take no time, whatever the feed.
        Total { length, time: if length > 0.0 { length / rapid } else { 0.0 } }
    }

    /// Adds a move. `has_length` states whether its length is known and included.
    pub(crate) fn add(&mut self, movement: &Move, has_length: bool) {
        self.arcs += u64::from(matches!(movement.shape, MoveShape::Arc(_)));
        let kind = match movement.pace {
            Pace::Probe { .. } => {
                self.probing += 1;
                return;
            }
            Pace::Rapid => &mut self.rapid,
            Pace::Feed(_) if movement.is_vertical() => &mut self.drilling,
            Pace::Feed(_) => &mut self.milling,
        };
        kind.moves += 1;
        if has_length {
            let length = movement.length();
            kind.total.length += length;
            if let Some(feed) = movement.pace.feed()
                && length > 0.0
            {
                kind.total.time += if feed > 0.0 { length / feed } else { f64::INFINITY };
            }
        }
    }
}

/// The statistics of a program.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Summary {
    /// The totals of all moves of the program.
    pub total: Tally,
    /// The totals of each tool in order of first use; for XpertMILL, of each layer.
    pub tools: Vec<ToolTotals>,
    /// Least and greatest X, Y, Z in mm of all moves except those to named positions (G28, G30, G53); `None` for axes that never move to a known
    /// position.
    pub extent: AxisRanges,
    /// Least and greatest X, Y, Z of cutting moves in mm; `None` for axes that never cut at a known position.
    pub cut: AxisRanges,
    /// Total dwell time (G4) in seconds.
    pub dwell: f64,
    /// Number of stops for the operator.
    pub stops: u64,
    /// Number of tool changes.
    pub tool_changes: u64,
}

/// Least and greatest coordinate of each axis, in mm.
pub type AxisRanges = [Option<(f64, f64)>; 3];

/// The totals of a tool.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ToolTotals {
    /// Number of the tool; `None` before the program names one.
    pub tool: Option<u32>,
    /// Totals of the tool's moves.
    pub tally: Tally,
    /// Spindle speeds while cutting, in 1/min, in order of first use.
    pub speeds: Vec<f64>,
    /// Feeds in mm/min, in order of first use.
    pub feeds: Vec<f64>,
}

impl Summary {
    /// Summarizes steps. With `layers`, tools are XpertMILL layers, the first of which is active from the beginning, and S belongs to a
    /// layer.
    pub fn of(steps: &[Step], layers: bool) -> Self {
        let mut collector = Collector {
            summary: Self::default(),
            known: HashMap::new(),
            has_changes: steps.iter().any(|step| matches!(step.action, Action::ChangeTool(_))),
            layers,
            tool: layers.then_some(1),
            spindle: Spindle::UNSTATED,
            counting: LengthFilter::default(),
        };
        for step in steps {
            collector.step(step);
        }
        collector.summary
    }
}

struct Collector {
    summary: Summary,
    /// The tools by number, with the speeds and feeds that have been recorded for each.
    known: HashMap<Option<u32>, KnownTool>,
    /// Whether M6 changes tools; in programs without it, T does.
    has_changes: bool,
    layers: bool,
    tool: Option<u32>,
    spindle: Spindle,
    counting: LengthFilter,
}

struct KnownTool {
    /// Index of the tool in [`Summary::tools`].
    index: usize,
    feeds: HashSet<u64>,
    speeds: HashSet<u64>,
}

impl Collector {
    fn step(&mut self, step: &Step) {
        let has_length = self.counting.includes_length(step);
        match &step.action {
            Action::Move(movement) if !movement.is_standstill() => self.add_move(movement, has_length),
            Action::Dwell(seconds) => self.summary.dwell += seconds,
            Action::SelectTool(tool) if !self.has_changes => self.tool = Some(*tool),
            Action::ChangeTool(tool) => {
                self.tool = Some(tool.unwrap_or(0));
                self.summary.tool_changes += 1;
                if self.layers {
                    self.spindle.speed = None;
                }
            }
            Action::Spindle(spindle) => self.spindle = *spindle,
            Action::Stop { .. } => self.summary.stops += 1,
            _ => {}
        }
    }

    fn add_move(&mut self, movement: &Move, has_length: bool) {
        self.summary.total.add(movement, has_length);
        if movement.named.is_none() {
            widen(&mut self.summary.extent, movement);
        }
        if matches!(movement.pace, Pace::Feed(_)) {
            widen(&mut self.summary.cut, movement);
        }
        let speed = self.spindle.speed;
        let (used, known) = self.tool_in_use();
        used.tally.add(movement, has_length);
        if let Pace::Feed(feed) = movement.pace {
            add_distinct_value(&mut used.feeds, &mut known.feeds, feed);
            add_distinct_value(&mut used.speeds, &mut known.speeds, speed.unwrap_or_default());
        }
    }

    fn tool_in_use(&mut self) -> (&mut ToolTotals, &mut KnownTool) {
        let tools = &mut self.summary.tools;
        let known = self.known.entry(self.tool).or_insert_with(|| {
            tools.push(ToolTotals { tool: self.tool, ..ToolTotals::default() });
            KnownTool { index: tools.len() - 1, feeds: HashSet::new(), speeds: HashSet::new() }
        });
        (&mut tools[known.index], known)
    }
}

/// Adds a positive value unless it is already known. Positive numbers are equal if and only if their bits are.
fn add_distinct_value(values: &mut Vec<f64>, known: &mut HashSet<u64>, value: f64) {
    if value > 0.0 && known.insert(value.to_bits()) {
        values.push(value);
    }
}

fn widen(extent: &mut AxisRanges, movement: &Move) {
    for (known, more) in extent.iter_mut().zip(movement.extent()) {
        *known = match (*known, more) {
            (Some((low, high)), Some((least, most))) => Some((low.min(least), high.max(most))),
            (known, more) => known.or(more),
        };
    }
}

/// Returns the least and greatest X, Y, Z of the cutter tip in the cutting moves of a drawing's program, in mm; all `None` if nothing is cut.
pub fn cutting_box(program: &Program) -> AxisRanges {
    let mut extent = AxisRanges::default();
    for (_, movement) in program.moves().filter(|(_, movement)| matches!(movement.pace, Pace::Feed(_))) {
        widen(&mut extent, &movement);
    }
    extent
}

/// Whether a diagnostic reports an assumption about something that the program does not specify.
pub fn is_guess(diagnostic: &Diagnostic) -> bool {
    matches!(
        diagnostic.code(),
        Code::MachineValue
            | Code::UnknownOffset
            | Code::UnitsNotStated
            | Code::ModesNotStated
            | Code::MotionNotStated
    )
}
