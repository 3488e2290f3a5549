//! Differences between two programs in what they state besides moves: tools, spindle, work offsets, stops and the like. (book: program/comparing)

use pathbuild_diagnostic::Text;
use pathbuild_gcode::interpret::code_name;
use pathbuild_motion::{Action, Change, Coolant, Move, Pace, Spindle, Step, ToolLength, Turning, WorkSystem};

/// A kind of state change or event in a program, besides moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum StateKind {
    Tool,
    ToolLength,
    Spindle,
    Coolant,
    WorkOffset,
    Zero,
    Probe,
    Stop,
    Dwell,
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
    /// All kinds, in the order in which they are shown.
    pub const ALL: [Self; 9] = [
        Self::Tool,
        Self::ToolLength,
        Self::Spindle,
        Self::Coolant,
        Self::WorkOffset,
        Self::Zero,
        Self::Probe,
        Self::Stop,
        Self::Dwell,
    ];

    /// Returns the name of the kind in messages.
    pub fn text(self) -> &'static Text {
        match self {
            Self::Tool => &Text { en: "tool", de: "Werkzeug" },
            Self::ToolLength => &Text { en: "tool length", de: "Werkzeuglänge" },
            Self::Spindle => &Text { en: "spindle", de: "Spindel" },
            Self::Coolant => &Text { en: "coolant", de: "Kühlung" },
            Self::WorkOffset => &Text { en: "work offset", de: "Nullpunktverschiebung" },
            Self::Zero => &Text { en: "zero set by the program", de: "vom Programm gesetzter Nullpunkt" },
            Self::Probe => &Text { en: "probe", de: "Antasten" },
            Self::Stop => &Text { en: "stop", de: "Halt" },
            Self::Dwell => &Text { en: "dwell", de: "Wartezeit" },
        }
    }

    /// Returns the name of the kind in JSON.
    pub fn name(self) -> &'static str {
        match self {
            Self::Tool => "tool",
            Self::ToolLength => "tool-length",
            Self::Spindle => "spindle",
            Self::Coolant => "coolant",
            Self::WorkOffset => "work-offset",
            Self::Zero => "zero",
            Self::Probe => "probe",
            Self::Stop => "stop",
            Self::Dwell => "dwell",
        }
    }

    /// Whether words of this kind act once, at their position in the program. Words of other kinds apply to all cuts that follow.
    fn is_event(self) -> bool {
        matches!(self, Self::Zero | Self::Probe | Self::Stop | Self::Dwell)
    }
}

/// The states of a machine while it runs a program.
#[derive(Debug, Default)]
pub struct MachineStates {
    cuts: usize,
    /// The states in effect at cuts, and the events, by kind.
    stated: [Vec<StatedWords>; StateKind::ALL.len()],
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
    /// Returns the states of a program.
    pub fn of(steps: &[Step]) -> Self {
        let mut states = Self::default();
        let mut current = CurrentState::default();
        for step in steps {
            match &step.action {
                Action::Move(Move { pace: Pace::Feed(_), .. }) => {
                    states.add_cut(step.line, &current);
                    states.cuts += 1;
                }
                Action::Move(Move { pace: Pace::Probe { .. }, .. }) => {
                    states.add(StateKind::Probe, step.line, PROBE.to_owned());
                }
                // Positions after the word are relative to a zero that only the machine knows.
                Action::Change(Change::Offsets { code, is_followed: false, .. }) => {
                    states.add(StateKind::Zero, step.line, code_name('G', *code));
                }
                Action::Stop { optional } => {
                    states.add(StateKind::Stop, step.line, if *optional { "M1" } else { "M0" }.into());
                }
                Action::Dwell(seconds) => states.add(StateKind::Dwell, step.line, format!("{seconds} s")),
                action => current.apply(action),
            }
        }
        states
    }

    /// Adds the words in effect at a cut, as far as they changed since the cut before.
    fn add_cut(&mut self, line: u32, current: &CurrentState) {
        for (kind, words) in current.words() {
            let last = self.stated[kind as usize].last();
            if last.is_none_or(|last| last.words != words) {
                self.add(kind, line, words);
            }
        }
    }

    fn add(&mut self, kind: StateKind, line: u32, words: String) {
        self.stated[kind as usize].push(StatedWords { cut: self.cuts, words, line });
    }

    /// Returns the first difference of each kind. If the programs have different numbers of cuts, their words are compared in order, regardless of
    /// the cuts to which they apply.
    pub fn changes(&self, new: &Self) -> Vec<StateChange> {
        StateKind::ALL.into_iter().filter_map(|kind| self.first_change(new, kind)).collect()
    }

    fn first_change(&self, new: &Self, kind: StateKind) -> Option<StateChange> {
        let has_same_cuts = self.cuts == new.cuts;
        let sides = [&self.stated[kind as usize], &new.stated[kind as usize]];
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
        Some(StateChange { kind, words, line: found[1].map(|stated| stated.line) })
    }
}

/// The word for a probing move, whatever its kind.
const PROBE: &str = "G38";

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
        }
    }
}

impl CurrentState {
    fn apply(&mut self, action: &Action) {
        match action {
            Action::SelectTool(number) => self.selected = Some(*number),
            Action::ChangeTool(number) => (self.has_changed, self.inserted) = (true, *number),
            Action::Spindle(spindle) => self.spindle = *spindle,
            Action::Coolant(coolant) => self.coolant = Some(*coolant),
            Action::System { system, .. } => self.system = system.name().into_owned(),
            Action::Change(Change::ToolLength(length)) => self.length = length_words(*length),
            _ => {}
        }
    }

    fn words(&self) -> [(StateKind, String); 5] {
        let tool = if self.has_changed { self.inserted } else { self.selected };
        [
            (StateKind::Tool, tool.map_or_else(String::new, |number| format!("T{number}"))),
            (StateKind::ToolLength, self.length.clone()),
            (StateKind::Spindle, spindle_words(self.spindle)),
            (StateKind::Coolant, self.coolant.map_or_else(String::new, coolant_words)),
            (StateKind::WorkOffset, self.system.clone()),
        ]
    }
}

fn length_words(length: ToolLength) -> String {
    match length {
        ToolLength::Off => "G49".to_owned(),
        ToolLength::OfTool(None) => "G43".to_owned(),
        ToolLength::OfTool(Some(number)) => format!("G43 H{number}"),
        ToolLength::Other => "G43.1".to_owned(),
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
