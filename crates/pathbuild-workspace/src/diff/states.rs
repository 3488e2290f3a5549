//! Differences between two programs in what they state besides moves: tools, spindle, work offsets, stops and the like. (book: program/comparing)

use pathbuild_diagnostic::{Number, Text};
use pathbuild_gcode::adjust;
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::interpret::code_name;
use pathbuild_motion::{
    Action, Change, Coolant, Corners, Move, Pace, Spindle, Step, ToolLength, Turning, WorkSystem,
};
use pathbuild_toolpath::{ProbePoint, Xy, ZModel};
use serde::Serialize;

use crate::config::types::Choice;
use crate::program::Program;

/// A kind of state change or event in a program, besides moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
#[expect(missing_docs, reason = "the names say it")]
pub enum StateKind {
    PostProcessor,
    Tool,
    Cutter,
    ToolLength,
    Spindle,
    Coolant,
    WorkOffset,
    Corners,
    Peck,
    Zero,
    Probe,
    /// The correction of heights by Z-probes.
    Correction,
    Stop,
    Dwell,
    /// Any other line of the written program, compared only if nothing else differs.
    OtherLine,
}

/// The first difference between two programs in one [`StateKind`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StateChange {
    /// The kind of the difference.
    pub kind: StateKind,
    /// The words of the old and of the new program, such as `T1`; empty if there are none.
    pub words: [String; 2],
    /// The line at which the new program begins to differ; `None` if the new program has no line for the difference.
    pub line: Option<u32>,
}

impl StateKind {
    /// All kinds with their names in messages, in the order in which they are shown.
    const ALL: &[(Self, Text)] = &[
        (Self::PostProcessor, Text { en: "post-processor", de: "Postprozessor" }),
        (Self::Tool, Text { en: "tool", de: "Werkzeug" }),
        (Self::Cutter, Text { en: "cutter", de: "Fräser" }),
        (Self::ToolLength, Text { en: "tool length", de: "Werkzeuglänge" }),
        (Self::Spindle, Text { en: "spindle", de: "Spindel" }),
        (Self::Coolant, Text { en: "coolant", de: "Kühlung" }),
        (Self::WorkOffset, Text { en: "work offset", de: "Nullpunktverschiebung" }),
        (Self::Corners, Text { en: "corners", de: "Ecken" }),
        (Self::Peck, Text { en: "peck depth", de: "Tiefe je Bohrstufe" }),
        (Self::Zero, Text { en: "zero set by the program", de: "vom Programm gesetzter Nullpunkt" }),
        (Self::Probe, Text { en: "probe", de: "Antasten" }),
        (Self::Correction, Text { en: "height correction", de: "Höhenkorrektur" }),
        (Self::Stop, Text { en: "stop", de: "Halt" }),
        (Self::Dwell, Text { en: "dwell", de: "Wartezeit" }),
        (Self::OtherLine, Text { en: "line of the program", de: "Zeile des Programms" }),
    ];

    /// Iterates over all kinds, in the order in which they are shown.
    fn all() -> impl Iterator<Item = Self> {
        Self::ALL.iter().map(|(kind, _)| *kind)
    }

    /// Returns the name of the kind in messages.
    pub fn text(self) -> &'static Text {
        &Self::ALL[self as usize].1
    }

    /// Whether words of this kind act once, at their position in the program. Words of other kinds apply to all cuts that follow.
    fn is_event(self) -> bool {
        matches!(self, Self::Zero | Self::Probe | Self::Stop | Self::Dwell)
    }

    /// Whether words of this kind are taken from the steps of a program.
    fn is_in_steps(self) -> bool {
        !matches!(self, Self::PostProcessor | Self::Cutter | Self::Peck | Self::Correction | Self::OtherLine)
    }
}

/// The states of a machine while it runs a program.
#[derive(Debug, Default)]
pub struct MachineStates {
    /// Number of cuts; `None` if it is unknown.
    cuts: Option<usize>,
    /// The states in effect at cuts, and the events, by kind; `None` for a kind about which nothing is known, which is not compared.
    stated: [Option<Vec<StatedWords>>; StateKind::ALL.len()],
    /// The dialect of a program in a file.
    dialect: Option<Dialect>,
    /// Whether the program has an M6.
    has_tool_change: bool,
}

/// Words of a program, with the cut from which they apply.
#[derive(Clone, Debug, PartialEq, Eq)]
struct StatedWords {
    /// Number of cuts before the words.
    cut: usize,
    words: String,
    line: u32,
}

impl MachineStates {
    /// Returns the states of a program, with the cutters that its comments state.
    pub fn of(program: &Program) -> Self {
        let mut states = Self::of_steps(&program.read.steps);
        states.dialect = Some(program.dialect);
        for (line, at, height) in adjust::listed_probes(&program.text) {
            let words = probe_words(at, height);
            let probe = StatedWords { cut: 0, words, line };
            states.stated[StateKind::Probe as usize].get_or_insert_default().push(probe);
        }
        let corrections = adjust::corrections(&program.text);
        if !corrections.is_empty() {
            states.set(StateKind::Correction, corrections);
        }
        let tools = program.header().tools;
        let cutters = tools.iter().map(|tool| Some((tool.line, cutter_words(tool.cutter?.diameter))));
        let cutters: Option<Vec<(u32, String)>> = cutters.collect();
        if let Some(cutters) = cutters.filter(|cutters| !cutters.is_empty()) {
            states.set(StateKind::Cutter, cutters);
        }
        states
    }

    /// Returns what the drawing of a path states: only the diameter of its cutter.
    pub fn of_drawing(cutter: Option<f64>) -> Self {
        Self::default().with_drawn_cutter(cutter)
    }

    /// Replaces the cutters that comments state by that of the drawing, which applies to every program of the path.
    pub(super) fn with_drawn_cutter(mut self, cutter: Option<f64>) -> Self {
        self.stated[StateKind::Cutter as usize] = None;
        if let Some(diameter) = cutter {
            self.set(StateKind::Cutter, vec![(0, cutter_words(diameter))]);
        }
        self
    }

    /// Adds the name of the post-processor that writes the program.
    pub(super) fn set_post_processor(&mut self, name: &str) {
        self.set(StateKind::PostProcessor, vec![(0, name.to_owned())]);
    }

    /// Adds the peck depths of the drilled elements, in the order of the elements; `None` for an element that is drilled without pecks.
    pub(super) fn set_pecks(&mut self, pecks: impl Iterator<Item = Option<f64>>) {
        let depth = |depth| format!("C{}", Number(depth));
        let words = pecks.map(|peck| (0, peck.map_or_else(String::new, depth))).collect();
        self.set(StateKind::Peck, words);
    }

    /// Sets the drawn probes, in the order in which they are probed.
    pub(super) fn set_probes(&mut self, probes: &[ProbePoint]) {
        let words = probes.iter().map(|probe| {
            let feed = Number(probe.feed);
            (0, format!("{} F{feed}", probe_words(probe.at, probe.height)))
        });
        self.set(StateKind::Probe, words.collect());
    }

    /// Sets the configuration of the height correction.
    pub(super) fn set_correction(&mut self, model: ZModel, longest: f64) {
        let name = ZModel::ALL.iter().find(|(_, known)| *known == model).map_or("", |(name, _)| *name);
        let words = format!("z-model {name}, z-split {}", Number(longest));
        self.set(StateKind::Correction, vec![(0, words)]);
    }

    /// Sets the words of a kind, in their order, with their lines; 0 stands for no line. Words that repeat the previous ones change nothing.
    fn set(&mut self, kind: StateKind, mut words: Vec<(u32, String)>) {
        words.dedup_by(|next, previous| next.1 == previous.1);
        let stated =
            words.into_iter().enumerate().map(|(cut, (line, words))| StatedWords { cut, words, line });
        self.stated[kind as usize] = Some(stated.collect());
    }

    fn of_steps(steps: &[Step]) -> Self {
        let mut states = Self { cuts: Some(0), ..Self::default() };
        for kind in StateKind::all().filter(|kind| kind.is_in_steps()) {
            states.stated[kind as usize] = Some(Vec::new());
        }
        let mut cuts = 0;
        let mut current = CurrentState::default();
        for step in steps {
            match &step.action {
                Action::Move(Move { pace: Pace::Feed(_), .. }) => {
                    states.add_cut(&current);
                    cuts += 1;
                    states.cuts = Some(cuts);
                }
                Action::Move(Move { pace: Pace::Probe { toward, must_answer, .. }, .. }) => {
                    states.add(StateKind::Probe, step.line, probe_word(*toward, *must_answer).to_owned());
                }
                // Positions after the word are relative to a zero that only the machine knows.
                Action::Change(Change::Offsets { code, is_followed: false, .. }) => {
                    states.add(StateKind::Zero, step.line, code_name('G', *code));
                }
                Action::Stop { optional } => {
                    states.add(StateKind::Stop, step.line, if *optional { "M1" } else { "M0" }.into());
                }
                Action::Dwell(seconds) => states.add(StateKind::Dwell, step.line, format!("{seconds} s")),
                action => current.apply(action, step.line),
            }
        }
        states.has_tool_change = current.has_changed;
        states
    }

    /// Adds the words in effect at a cut, as far as they changed since the previous cut, with the lines on which they stand.
    fn add_cut(&mut self, current: &CurrentState) {
        for (kind, words) in current.words() {
            let last = self.stated[kind as usize].as_ref().and_then(|stated| stated.last());
            if last.is_none_or(|last| last.words != words) {
                self.add(kind, current.lines[kind as usize], words);
            }
        }
    }

    fn add(&mut self, kind: StateKind, line: u32, words: String) {
        let stated = StatedWords { cut: self.cuts.unwrap_or_default(), words, line };
        self.stated[kind as usize].get_or_insert_default().push(stated);
    }

    /// Returns the first difference of each kind that is known on both sides. If the programs have different numbers of cuts, their words are
    /// compared in order, regardless of the cuts to which they apply.
    pub fn changes(&self, new: &Self) -> Vec<StateChange> {
        StateKind::all().filter_map(|kind| self.first_change(new, kind)).collect()
    }

    /// Whether the program inserts no tool: in its dialect, T only selects a tool, and it lacks the M6 that the other program has.
    fn lacks_change(&self, other: &Self) -> bool {
        let is_needed = self.dialect.is_some_and(|dialect| dialect.rules().t_only_selects);
        is_needed && self.dialect == other.dialect && !self.has_tool_change && other.has_tool_change
    }

    fn first_change(&self, new: &Self, kind: StateKind) -> Option<StateChange> {
        let has_same_cuts = self.cuts.is_some() && self.cuts == new.cuts;
        let without = Vec::new();
        let mut sides = [self.stated[kind as usize].as_ref()?, new.stated[kind as usize].as_ref()?];
        for (side, has_no_tool) in sides.iter_mut().zip([self.lacks_change(new), new.lacks_change(self)]) {
            if kind == StateKind::Tool && has_no_tool {
                *side = &without;
            }
        }
        let differs = |at: &usize| match sides.map(|side| side.get(*at)) {
            [Some(old), Some(new)] => old.words != new.words || has_same_cuts && old.cut != new.cut,
            _ => true,
        };
        let most = sides[0].len().max(sides[1].len());
        let at = (0..most).find(differs)?;
        let cut = sides.iter().filter_map(|side| side.get(at)).map(|stated| stated.cut).min();
        let found = sides.map(|side| side.get(at).filter(|stated| !has_same_cuts || Some(stated.cut) == cut));
        let words = [0, 1].map(|side| match found[side] {
            Some(stated) => stated.words.clone(),
            None if kind.is_event() => String::new(),
            // The previous words of this side still apply.
            None => at.checked_sub(1).map_or_else(String::new, |before| sides[side][before].words.clone()),
        });
        let line = found[1].map(|stated| stated.line).filter(|line| *line > 0);
        Some(StateChange { kind, words, line })
    }
}

/// Returns the word for a probing move. Without contact, only G38.2 and G38.4 are alarms.
fn probe_word(toward: bool, must_answer: bool) -> &'static str {
    match (toward, must_answer) {
        (true, true) => "G38.2",
        (true, false) => "G38.3",
        (false, true) => "G38.4",
        (false, false) => "G38.5",
    }
}

/// The words in effect at a position in a program.
#[derive(Debug)]
struct CurrentState {
    selected: Option<u32>,
    /// Whether the program has had an M6. Before the first one, T names the tool in the spindle.
    has_changed: bool,
    /// The tool of the last M6.
    inserted: Option<u32>,
    length: String,
    spindle: Spindle,
    coolant: Option<Coolant>,
    system: String,
    /// The words for the behaviour at corners. A program without any depends on the settings of the control.
    corners: String,
    /// The line on which the words of each kind stand; 0 if there are none.
    lines: [u32; StateKind::ALL.len()],
}

impl Default for CurrentState {
    fn default() -> Self {
        Self {
            selected: None,
            has_changed: false,
            inserted: None,
            length: String::new(),
            spindle: Spindle::UNSTATED,
            coolant: None,
            // Controls start in G54.
            system: WorkSystem::default().name().into_owned(),
            corners: String::new(),
            lines: [0; StateKind::ALL.len()],
        }
    }
}

impl CurrentState {
    fn apply(&mut self, action: &Action, line: u32) {
        let kind = match action {
            Action::SelectTool(number) => {
                self.selected = Some(*number);
                if self.has_changed {
                    return;
                }
                StateKind::Tool
            }
            Action::ChangeTool(number) => {
                (self.has_changed, self.inserted) = (true, *number);
                StateKind::Tool
            }
            Action::Spindle(spindle) => {
                self.spindle = *spindle;
                StateKind::Spindle
            }
            Action::Coolant(coolant) => {
                self.coolant = Some(*coolant);
                StateKind::Coolant
            }
            Action::System { system, .. } => {
                self.system = system.name().into_owned();
                StateKind::WorkOffset
            }
            Action::Change(Change::ToolLength(length)) => {
                self.length = length_words(*length);
                StateKind::ToolLength
            }
            Action::Change(Change::Corners(corners)) => {
                self.corners = corner_words(*corners);
                StateKind::Corners
            }
            _ => return,
        };
        self.lines[kind as usize] = line;
    }

    fn words(&self) -> [(StateKind, String); 6] {
        let tool = if self.has_changed { self.inserted } else { self.selected };
        [
            (StateKind::Tool, tool.map_or_else(String::new, |number| format!("T{number}"))),
            (StateKind::ToolLength, self.length.clone()),
            (StateKind::Spindle, spindle_words(self.spindle)),
            (StateKind::Coolant, self.coolant.map_or_else(String::new, coolant_words)),
            (StateKind::WorkOffset, self.system.clone()),
            (StateKind::Corners, self.corners.clone()),
        ]
    }
}

fn cutter_words(diameter: f64) -> String {
    format!("O{}", rounded(diameter))
}

/// The words for a probe: its place, and the expected height.
fn probe_words(at: Xy, height: f64) -> String {
    format!("X{} Y{} T{}", rounded(at.x), rounded(at.y), rounded(height))
}

/// Rounds a length to thousandths, as programs have them.
fn rounded(length: f64) -> Number {
    Number((length * 1000.0).round() / 1000.0)
}

fn corner_words(corners: Corners) -> String {
    match corners {
        Corners::Exact => "G61".to_owned(),
        Corners::Rounded(None) => "G64".to_owned(),
        Corners::Rounded(Some(tolerance)) => format!("G64 P{}", Number(tolerance)),
    }
}

fn length_words(length: ToolLength) -> String {
    match length {
        ToolLength::Off => "G49".to_owned(),
        ToolLength::OfTool(None) => "G43".to_owned(),
        ToolLength::OfTool(Some(number)) => format!("G43 H{number}"),
        ToolLength::Other(code) => code_name('G', code),
    }
}

/// Returns the words for a state of the spindle. The speed of a stopped spindle does not matter.
fn spindle_words(spindle: Spindle) -> String {
    let speed = spindle.speed.map(|speed| format!("S{speed}"));
    let turning = match spindle.turning {
        Turning::Off => return "M5".to_owned(),
        Turning::Unstated => None,
        Turning::Clockwise => Some("M3".to_owned()),
        Turning::CounterClockwise => Some("M4".to_owned()),
    };
    turning.into_iter().chain(speed).collect::<Vec<_>>().join(" ")
}

fn coolant_words(coolant: Coolant) -> String {
    let words = match (coolant.mist, coolant.flood) {
        (false, false) => "M9",
        (true, false) => "M7",
        (false, true) => "M8",
        (true, true) => "M7 M8",
    };
    words.to_owned()
}
