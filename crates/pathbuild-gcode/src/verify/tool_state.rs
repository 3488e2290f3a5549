//! Tracks the tool in the spindle, its length, and the state of the spindle. (book: program/reading, "verify")
//!
//! `verify`, `verify --against` and the check of a post's output use the rules of this module.

use pathbuild_motion::{Action, Change, Spindle, Step, ToolLength, Turning};

use crate::dialect::Dialect;

/// The state set so far by the tool words and spindle words of a program: pass every step to [`step`](Self::step).
#[derive(Clone, Debug)]
pub struct ToolState {
    dialect: Dialect,
    /// Number of the tool selected by the last T.
    selected: Option<u32>,
    /// Number of the tool inserted by the last M6; `None` before the first M6, or if the number of that tool is unknown.
    inserted: Option<u32>,
    /// H of the last G43 with an H, which some controls reuse for a G43 without H.
    entry: Option<u32>,
    length: Option<ActiveLength>,
    spindle: Spindle,
    /// Number of the tool that was selected at the last cut; `None` before the first cut.
    cutting: Option<u32>,
    /// Whether the program has stopped for the operator since the last cut, whatever the switches of the machine.
    has_stopped: bool,
}

#[derive(Clone, Copy, Debug)]
struct ActiveLength {
    length: ToolLength,
    line: u32,
    /// The tool that was inserted when the length was set.
    tool: Option<u32>,
    /// Whether M6 was executed after the length was set.
    is_before_change: bool,
}

/// Relation between the active tool length and the tool in the spindle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LengthFit {
    /// The program has not set any length.
    Unstated,
    /// The length was switched off by G49 or G43 H0.
    Off,
    /// The active length is that of the tool.
    Fits,
    /// The length was set before M6 inserted the tool.
    Outdated,
    /// The length was set for this tool, but it is that of the H with the given number, which is not the number of the tool.
    OfEntry(u32),
    /// The tool or the length is unknown.
    Unknown,
}

impl ToolState {
    /// Creates the state at the beginning of a program.
    pub fn new(dialect: Dialect) -> Self {
        Self {
            dialect,
            selected: None,
            inserted: None,
            entry: None,
            length: None,
            spindle: Spindle::UNSTATED,
            cutting: None,
            has_stopped: false,
        }
    }

    /// Processes the next step of the program.
    pub fn step(&mut self, step: &Step) {
        match &step.action {
            Action::SelectTool(number) => self.selected = Some(*number),
            Action::ChangeTool(number) => {
                self.selected = number.or(self.selected);
                self.inserted = *number;
                if let Some(active) = &mut self.length {
                    active.is_before_change = true;
                }
            }
            Action::Change(Change::ToolLength(length)) => self.set_length(step.line, *length),
            Action::Spindle(spindle) => self.spindle = *spindle,
            Action::Stop { optional: false } => self.has_stopped = true,
            _ => {}
        }
    }

    fn set_length(&mut self, line: u32, length: ToolLength) {
        let length = match length {
            ToolLength::OfTool(None) if self.keeps_entry() => ToolLength::OfTool(self.entry),
            other => other,
        };
        if let ToolLength::OfTool(Some(entry)) = length {
            self.entry = Some(entry);
        }
        self.length = Some(ActiveLength { length, line, tool: self.inserted, is_before_change: false });
    }

    /// Returns the number of the tool selected by the last T; `None` before the first one.
    pub fn selected(&self) -> Option<u32> {
        self.selected
    }

    /// Returns the number of the tool inserted by the last M6; `None` if it is unknown.
    pub fn inserted(&self) -> Option<u32> {
        self.inserted
    }

    /// Records that the program has made a cut.
    pub fn cut(&mut self) {
        (self.cutting, self.has_stopped) = (self.selected, false);
    }

    /// Whether the program has stopped for the operator since the last cut, whatever the switches of the machine.
    pub fn has_stopped(&self) -> bool {
        self.has_stopped
    }

    /// Whether the program has selected another tool than that of the last cut without a stop since then, on a control where T alone changes no tool.
    /// Without M6, the previous tool is still in the spindle.
    pub fn lacks_stop(&self) -> bool {
        let is_other = self.cutting.is_some() && self.cutting != self.selected;
        is_other && self.dialect.rules().t_only_selects && !self.has_stopped
    }

    /// The state of the spindle.
    pub fn spindle(&self) -> Spindle {
        self.spindle
    }

    /// Returns the line that set the active tool length; `None` if the program has set none.
    pub fn length_line(&self) -> Option<u32> {
        self.length.map(|active| active.line)
    }

    /// Returns how the active length fits the tool that M6 inserted.
    pub fn length_fit(&self) -> LengthFit {
        self.length_fit_for(self.inserted)
    }

    /// Returns how the active length fits a tool, which need not have been inserted by M6.
    pub fn length_fit_for(&self, tool: Option<u32>) -> LengthFit {
        let Some(active) = self.length else { return LengthFit::Unstated };
        let is_outdated = active.is_before_change && (active.tool.is_none() || active.tool != self.inserted);
        match active.length {
            ToolLength::Off | ToolLength::OfTool(Some(0)) => LengthFit::Off,
            ToolLength::OfTool(Some(entry)) if Some(entry) == tool => LengthFit::Fits,
            _ if is_outdated => LengthFit::Outdated,
            ToolLength::OfTool(Some(entry)) if tool.is_some() => LengthFit::OfEntry(entry),
            ToolLength::OfTool(None) if tool.is_some() && !self.keeps_entry() => LengthFit::Fits,
            ToolLength::OfTool(_) | ToolLength::Other(_) => LengthFit::Unknown,
        }
    }

    fn keeps_entry(&self) -> bool {
        self.dialect.rules().lengths.keeps_entry
    }

    /// Whether the state that the program has set for the spindle differs from the expected one, or is missing. Nothing is compared where `None` is
    /// expected. Speeds may differ by `slack` in 1/min.
    pub fn has_other_spindle_state(&self, turning: Option<Turning>, speed: Option<f64>, slack: f64) -> bool {
        // XpertMILL switches the spindle by events of its own, and the speed belongs to the layer.
        let is_tied = self.dialect.rules().layers;
        let differs = turning.is_some_and(|turning| turning != self.spindle.turning) && !is_tied;
        let speed = speed.filter(|_| turning != Some(Turning::Unstated));
        differs
            || speed
                .is_some_and(|speed| self.spindle.speed.is_none_or(|found| libm::fabs(speed - found) > slack))
    }
}
