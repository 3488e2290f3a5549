//! Summarizes a program in numbers: moves, lengths, times, bounding box, tools, feeds. (book: program/reading, `import`)

use std::collections::{HashMap, HashSet};

use pathbuild_diagnostic::{Code, Diagnostic};
use pathbuild_motion::{Action, Move, Pace, Spindle, Step, Turning};

use pathbuild_toolpath::Program;

use crate::statistics::{Counting, Tally};

/// A program in numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Summary {
    /// The totals of the program.
    pub total: Tally,
    /// The totals of each tool in order of first use; for XpertMILL, of each layer.
    pub tools: Vec<Used>,
    /// Least and greatest X, Y, Z of all moves in mm; `None` for axes that never move to a known position.
    pub extent: Extent,
    /// The same for cutting moves.
    pub cut: Extent,
    /// Total dwell time (G4) in seconds.
    pub dwell: f64,
    /// Number of stops for the operator.
    pub stops: u64,
    /// Number of tool changes.
    pub tool_changes: u64,
}

/// Least and greatest coordinate of each axis, in mm.
pub type Extent = [Option<(f64, f64)>; 3];

/// The totals of a tool.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Used {
    /// Number of the tool; `None` before the program names one.
    pub tool: Option<u32>,
    /// Totals of its moves.
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
            spindle: Spindle { turning: Turning::Unstated, speed: 0.0 },
            counting: Counting::default(),
        };
        for step in steps {
            collector.step(step);
        }
        collector.summary
    }
}

struct Collector {
    summary: Summary,
    /// The tools in order of use, with what has been recorded for each.
    known: HashMap<Option<u32>, KnownTool>,
    /// Whether M6 changes tools; in programs without it, T does.
    has_changes: bool,
    layers: bool,
    tool: Option<u32>,
    spindle: Spindle,
    counting: Counting,
}

/// A tool that was used.
struct KnownTool {
    /// Index among the tools used.
    index: usize,
    feeds: HashSet<u64>,
    speeds: HashSet<u64>,
}

impl Collector {
    fn step(&mut self, step: &Step) {
        let has_length = self.counting.counts(step);
        match &step.action {
            Action::Move(it) if !it.is_nothing() => self.go(it, has_length),
            Action::Dwell(seconds) => self.summary.dwell += seconds,
            Action::SelectTool(tool) if !self.has_changes => self.tool = Some(*tool),
            Action::ChangeTool(tool) => {
                self.tool = Some(tool.unwrap_or(0));
                self.summary.tool_changes += 1;
                if self.layers {
                    self.spindle.speed = 0.0;
                }
            }
            Action::Spindle(spindle) => self.spindle = *spindle,
            Action::Stop { .. } => self.summary.stops += 1,
            _ => {}
        }
    }

    fn go(&mut self, it: &Move, has_length: bool) {
        self.summary.total.add(it, has_length);
        if it.named.is_none() {
            widen(&mut self.summary.extent, it);
        }
        if matches!(it.pace, Pace::Feed(_)) {
            widen(&mut self.summary.cut, it);
        }
        let speed = self.spindle.speed;
        let (used, known) = self.used();
        used.tally.add(it, has_length);
        if let Pace::Feed(feed) = it.pace {
            note(&mut used.feeds, &mut known.feeds, feed);
            note(&mut used.speeds, &mut known.speeds, speed);
        }
    }

    fn used(&mut self) -> (&mut Used, &mut KnownTool) {
        let tools = &mut self.summary.tools;
        let known = self.known.entry(self.tool).or_insert_with(|| {
            tools.push(Used { tool: self.tool, ..Used::default() });
            KnownTool { index: tools.len() - 1, feeds: HashSet::new(), speeds: HashSet::new() }
        });
        (&mut tools[known.index], known)
    }
}

/// Adds a positive value unless it is already known. Positive numbers are equal if their bits are.
fn note(values: &mut Vec<f64>, known: &mut HashSet<u64>, value: f64) {
    if value > 0.0 && known.insert(value.to_bits()) {
        values.push(value);
    }
}

fn widen(extent: &mut Extent, it: &Move) {
    for (known, more) in extent.iter_mut().zip(it.extent()) {
        *known = match (*known, more) {
            (Some((low, high)), Some((least, most))) => Some((low.min(least), high.max(most))),
            (known, more) => known.or(more),
        };
    }
}

/// Least and greatest X, Y, Z of the cutter tip in the cutting moves of a drawn program, in mm; `None` if nothing is cut.
pub fn cutting_box(program: &Program) -> Extent {
    let mut extent = Extent::default();
    for (_, it) in program.moves().filter(|(_, it)| matches!(it.pace, Pace::Feed(_))) {
        widen(&mut extent, &it);
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
