//! Finds cuts and rapid moves with the length of another tool or without any length, and cuts with a tool that was not replaced by the one that T had
//! selected. (book: program/reading, "Tool lengths")
//!
//! On every control with G43 the length in effect survives M6, so a program must set the length of each tool. A program that never uses G43 works
//! with one zero per tool and is not checked.

use std::collections::BTreeSet;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_motion::{Action, Axes, Change, Move, Pace, Step, ToolLength};

use super::material::Stock;
use super::rules::is_cut_in_stock;
use super::tool_state::{LengthFit, ToolState};
use crate::dialect::Dialect;
use crate::read::Problems;

/// Rule that finds cuts with a wrong tool length: pass every step of a program, then call [`finish`](Self::finish).
#[derive(Debug)]
#[expect(clippy::struct_excessive_bools, reason = "independent facts, not states")]
pub struct LengthRules<'c> {
    stock: Option<&'c Stock>,
    tools: ToolState,
    /// The first line that applied a length.
    first: Option<u32>,
    /// The line and the tool of the first cut with a known tool before any length was applied.
    bare: Option<(u32, u32)>,
    /// The cuts with the length of an H number other than that of the tool.
    cuts_with_other_entry: Vec<MismatchedLength>,
    /// The rapid moves that state Z with the length in an H whose number is not that of the tool.
    rapids_with_other_entry: Vec<MismatchedLength>,
    tools_with_own_length: BTreeSet<u32>,
    /// The line and the tool of the first rapid move that states Z with a known tool before any length was applied.
    bare_rapid: Option<(u32, u32)>,
    /// Whether the current combination of tool and length has been checked at a cut.
    is_cut_checked: bool,
    /// Whether the current combination of tool and length has been checked at a rapid move that states Z.
    is_rapid_checked: bool,
    /// A rapid move with a wrong length, until a cut with the same length is reported instead.
    wrong_rapid: Problems,
    /// Whether M6 has inserted a tool.
    has_changed: bool,
    /// The tool that the first M6 inserted.
    first_inserted: Option<u32>,
    /// Whether the program has cut since the last M6.
    has_cut_since_change: bool,
    waiting: Option<PreselectedTool>,
    /// The line of the last T word.
    selected_line: u32,
    /// Problems of tools that T selects without a stop before the next cut. They are reported only if the program has no M6.
    unchanged: Problems,
    problems: Problems,
}

/// A tool that has cut, or made a rapid move, with the length in an H whose number is not that of the tool.
#[derive(Clone, Copy, Debug)]
struct MismatchedLength {
    /// The line that set the length, or that of the rapid move.
    line: u32,
    tool: u32,
    entry: u32,
}

/// A tool that T has selected but M6 has not inserted.
#[derive(Clone, Copy, Debug)]
struct PreselectedTool {
    /// The line of the T word.
    line: u32,
    number: u32,
    /// Whether the program has cut since the T word.
    has_cut: bool,
    /// Whether T may prepare the changer for the next run: it names the tool of the first operation, and follows M6 before any cut. A forgotten M6 would
    /// follow the cuts of the tool before.
    may_be_for_next_run: bool,
}

impl<'c> LengthRules<'c> {
    /// Creates the rule for the beginning of a program; `stock` is `None` if the material is unknown.
    pub fn new(dialect: Dialect, stock: Option<&'c Stock>) -> Self {
        Self {
            stock,
            tools: ToolState::new(dialect),
            first: None,
            bare: None,
            bare_rapid: None,
            cuts_with_other_entry: Vec::new(),
            rapids_with_other_entry: Vec::new(),
            tools_with_own_length: BTreeSet::new(),
            is_cut_checked: false,
            is_rapid_checked: false,
            wrong_rapid: Problems::default(),
            has_changed: false,
            first_inserted: None,
            has_cut_since_change: false,
            waiting: None,
            selected_line: 0,
            unchanged: Problems::default(),
            problems: Problems::default(),
        }
    }

    /// Processes the next step of the program.
    pub fn step(&mut self, step: &Step) {
        self.tools.step(step);
        match &step.action {
            Action::SelectTool(number) => self.check_selected_tool(step.line, *number),
            Action::ChangeTool(number) => {
                self.begin_length();
                if !std::mem::replace(&mut self.has_changed, true) {
                    self.first_inserted = *number;
                }
                self.has_cut_since_change = false;
                self.report_abandoned_tool(*number);
            }
            Action::Change(Change::ToolLength(length)) => {
                self.begin_length();
                if !matches!(length, ToolLength::Off | ToolLength::OfTool(Some(0))) {
                    self.first.get_or_insert(step.line);
                }
            }
            Action::Move(movement) => {
                self.check_move(step, movement);
                let states_z = step.stated_since_stop.has(Axes::Z) && movement.to.known.has(Axes::Z);
                if states_z && movement.pace == Pace::Rapid && movement.named.is_none() {
                    self.check_rapid(step.line);
                }
            }
            _ => {}
        }
    }

    /// Begins another combination of tool and length.
    fn begin_length(&mut self) {
        self.is_cut_checked = false;
        self.is_rapid_checked = false;
        self.problems.append(std::mem::take(&mut self.wrong_rapid));
    }

    fn check_move(&mut self, step: &Step, movement: &Move) {
        if is_cut_in_stock(step.order, movement, self.stock) {
            self.waiting.iter_mut().for_each(|waiting| waiting.has_cut = true);
            self.has_cut_since_change = true;
            self.check_stop();
        }
        if !self.is_cut_checked {
            self.check_cut(step, movement);
        }
    }

    /// Checks at a cut that the program has stopped for a tool that T alone has selected.
    fn check_stop(&mut self) {
        if let Some(tool) = self.tools.selected().filter(|_| self.tools.lacks_stop()) {
            self.unchanged.add_at_line(&say::TOOL_WITHOUT_STOP, self.selected_line, |d| {
                d.with("tool", u64::from(tool))
            });
        }
        self.tools.cut();
    }

    /// Handles a T word, which on controls with a tool changer may only prepare the next change.
    fn check_selected_tool(&mut self, line: u32, number: u32) {
        self.selected_line = line;
        self.report_abandoned_tool(Some(number));
        let is_new = self.has_changed && self.tools.inserted() != Some(number);
        let may_be_for_next_run = self.first_inserted == Some(number) && !self.has_cut_since_change;
        self.waiting =
            is_new.then_some(PreselectedTool { line, number, has_cut: false, may_be_for_next_run });
    }

    /// Reports the preselected tool if another one takes its place after cuts that were probably meant for it.
    fn report_abandoned_tool(&mut self, next: Option<u32>) {
        let Some(waiting) = self.waiting.take().filter(|waiting| waiting.has_cut) else { return };
        if next == Some(waiting.number) {
            return;
        }
        self.problems.add_at_line(&say::TOOL_NOT_INSERTED, waiting.line, |d| {
            d.with("tool", u64::from(waiting.number))
        });
    }

    /// Checks the first rapid move that states Z with the current tool and length. Whether it hits anything depends on lengths that only the machine
    /// knows.
    fn check_rapid(&mut self, line: u32) {
        if std::mem::replace(&mut self.is_rapid_checked, true) {
            return;
        }
        let set = u64::from(self.tools.length_line().unwrap_or(line));
        match (self.tools.length_fit(), self.tools.inserted(), self.first) {
            (LengthFit::Outdated, tool, _) => {
                self.wrong_rapid.add_at_line(&say::RAPID_WITH_OLD_LENGTH, line, |d| {
                    d.quoting("change", change_word(tool)).with("set", set)
                });
            }
            (LengthFit::Off, _, Some(_)) => {
                self.wrong_rapid.add_at_line(&say::RAPID_WITHOUT_LENGTH, line, |d| d.with("set", set));
            }
            (LengthFit::OfEntry(entry), Some(tool), _) => {
                add_once(&mut self.rapids_with_other_entry, MismatchedLength { line, tool, entry });
            }
            (LengthFit::Off | LengthFit::Unstated, Some(tool), None) => {
                self.bare_rapid.get_or_insert((line, tool));
            }
            _ => {}
        }
    }

    /// Drops the finding about a rapid move with the current tool and length, and checks no further one, because a cut is reported instead.
    fn drop_rapid_finding(&mut self) {
        self.wrong_rapid = Problems::default();
        self.is_rapid_checked = true;
    }

    fn check_cut(&mut self, step: &Step, movement: &Move) {
        let rises = movement.keeps_xy() && movement.to.z() > movement.from.z();
        if movement.named.is_some() || rises || !is_cut_in_stock(step.order, movement, self.stock) {
            return;
        }
        self.is_cut_checked = true;
        let (tool, set) = (self.tools.inserted(), self.tools.length_line().unwrap_or(step.line));
        match (self.tools.length_fit(), tool, self.first) {
            (LengthFit::Outdated, ..) => {
                self.drop_rapid_finding();
                let change = change_word(tool);
                self.problems.add_at_line(&say::LENGTH_BEFORE_CHANGE, step.line, |d| {
                    d.quoting("change", change).with("set", u64::from(set))
                });
            }
            (LengthFit::Off, _, Some(first)) => {
                self.drop_rapid_finding();
                self.problems.add_at_line(&say::LENGTH_SWITCHED_OFF, step.line, |d| {
                    d.with("set", u64::from(set)).with("first", u64::from(first))
                });
            }
            (LengthFit::Off | LengthFit::Unstated, Some(tool), _) => {
                self.bare.get_or_insert((step.line, tool));
            }
            (LengthFit::OfEntry(entry), Some(tool), _) => {
                add_once(&mut self.cuts_with_other_entry, MismatchedLength { line: set, tool, entry });
            }
            (LengthFit::Fits, Some(tool), _) => _ = self.tools_with_own_length.insert(tool),
            _ => {}
        }
    }

    /// Returns all problems, ordered by line.
    pub fn finish(mut self) -> Vec<Diagnostic> {
        self.waiting = self.waiting.filter(|waiting| !waiting.may_be_for_next_run);
        self.report_abandoned_tool(None);
        self.begin_length();
        if !self.has_changed {
            self.problems.append(std::mem::take(&mut self.unchanged));
        }
        if let Some(((line, tool), first)) = self.bare_rapid.filter(|_| self.bare.is_none()).zip(self.first) {
            self.problems.add_at_line(&say::RAPID_BEFORE_LENGTH, line, |d| {
                d.with("tool", u64::from(tool)).with("first", u64::from(first))
            });
        }
        if let Some(((line, tool), first)) = self.bare.zip(self.first) {
            self.problems.add_at_line(&say::LENGTH_OF_FIRST_TOOL, line, |d| {
                d.with("tool", u64::from(tool)).with("first", u64::from(first))
            });
        }
        for MismatchedLength { line, tool, entry } in std::mem::take(&mut self.rapids_with_other_entry) {
            // Some shops number H independently of T, but then neither the tool cuts with its own H, nor another tool with this one.
            let is_wrong = [tool, entry].iter().any(|number| self.tools_with_own_length.contains(number));
            let is_reported =
                self.cuts_with_other_entry.iter().any(|cut| (cut.tool, cut.entry) == (tool, entry));
            if is_wrong && !is_reported {
                self.problems.add_at_line(&say::RAPID_WITH_OTHER_LENGTH, line, |d| {
                    d.with("tool", u64::from(tool)).with("entry", u64::from(entry))
                });
            }
        }
        for MismatchedLength { line, tool, entry } in std::mem::take(&mut self.cuts_with_other_entry) {
            // Some shops number H independently of T, but then no other tool cuts with this H.
            let is_taken = self.tools_with_own_length.contains(&entry);
            let message = if is_taken { &say::LENGTH_OF_OTHER_TOOL } else { &say::LENGTH_OF_OTHER_NUMBER };
            self.problems.add_at_line(message, line, |d| {
                d.with("tool", u64::from(tool)).with("entry", u64::from(entry))
            });
        }
        self.problems.into_diagnostics()
    }
}

/// Adds an entry unless there is one with the same tool and H.
fn add_once(entries: &mut Vec<MismatchedLength>, new: MismatchedLength) {
    if !entries.iter().any(|known| (known.tool, known.entry) == (new.tool, new.entry)) {
        entries.push(new);
    }
}

/// Returns the words that inserted a tool, for messages.
fn change_word(tool: Option<u32>) -> String {
    tool.map_or("M6".to_owned(), |tool| format!("T{tool} M6"))
}
