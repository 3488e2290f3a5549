//! What a program is, in numbers: moves, lengths, times, the box it needs, tools, feeds. (book: program/reading, `import`)

use std::collections::{HashMap, HashSet};

use pathbuild_diagnostic::{Code, Diagnostic};
use pathbuild_motion::{Action, Move, Pace, Spindle, Step, Turning};

use pathbuild_toolpath::Program;

use crate::interpret::each_move_of;
use crate::statistics::{Counting, Tally};

/// A program in numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Summary {
    /// All of it.
    pub total: Tally,
    /// The same for each tool, in order of first use; of XpertMILL, for each layer.
    pub tools: Vec<Used>,
    /// Lowest and highest X, Y, Z of all moves, in mm; `None` for an axis that never moves to a known place.
    pub extent: Extent,
    /// The same of those that cut.
    pub cut: Extent,
    /// Seconds of G4.
    pub dwell: f64,
    /// How often it waits for a person.
    pub stops: u64,
    /// How often the tool is changed.
    pub tool_changes: u64,
}

/// Lowest and highest coordinate of each axis, in mm.
pub type Extent = [Option<(f64, f64)>; 3];

/// What a tool does.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Used {
    /// Its number; `None` before the program names one.
    pub tool: Option<u32>,
    /// Its moves.
    pub tally: Tally,
    /// The spindle's speeds while it cuts, in turns a minute, in order of first use.
    pub speeds: Vec<f64>,
    /// Its feeds in mm/min, in order of first use.
    pub feeds: Vec<f64>,
}

impl Summary {
    /// Adds up steps. `layers`: tools are XpertMILL's layers, of which the first is there from the beginning, and S belongs to each.
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
    /// Where the tools are in it, with what is noted of each.
    known: HashMap<Option<u32>, Known>,
    /// M6 changes tools; in programs without it, T does.
    has_changes: bool,
    layers: bool,
    tool: Option<u32>,
    spindle: Spindle,
    counting: Counting,
}

/// A tool that was used.
struct Known {
    /// Its place among the used ones.
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

    fn used(&mut self) -> (&mut Used, &mut Known) {
        let tools = &mut self.summary.tools;
        let known = self.known.entry(self.tool).or_insert_with(|| {
            tools.push(Used { tool: self.tool, ..Used::default() });
            Known { index: tools.len() - 1, feeds: HashSet::new(), speeds: HashSet::new() }
        });
        (&mut tools[known.index], known)
    }
}

/// Adds a value that is new and says something. Numbers above 0 are equal where their bits are.
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

/// Lowest and highest X, Y, Z of the cutter's tip in a drawn program's cutting moves, in mm; `None` where it cuts nothing.
pub fn cutting_box(program: &Program) -> Extent {
    let mut extent = Extent::default();
    for (_, it) in each_move_of(program).filter(|(_, it)| matches!(it.pace, Pace::Feed(_))) {
        widen(&mut extent, &it);
    }
    extent
}

/// Whether a diagnostic says that something was taken for granted that the program does not say.
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
