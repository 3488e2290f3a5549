//! The tool table: cutter, spindle and coolant for programs with a given O. (`[tool.NAME]` in pathbuild.toml)

use pathbuild_diagnostic::{Diagnostic, messages::posts};
use pathbuild_motion::{Coolant, Turning};
use pathbuild_path::approx::near;
use regex::Regex;

use super::job::Tool;

/// The tools of the configuration.
#[derive(Clone, Debug, Default)]
pub struct ToolTable {
    /// In the order of the configuration; the first match is used.
    pub entries: Vec<ToolEntry>,
}

/// A tool of the configuration.
#[derive(Clone, Debug)]
pub struct ToolEntry {
    /// Name of its table.
    pub name: Box<str>,
    /// O in mm.
    pub diameter: f64,
    /// The paths it is for, if several cutters have the same diameter (S and T cutters). Matches anywhere in the name of the path, so use
    /// `T$`.
    pub paths: Option<Regex>,
    /// Number in T words; without one it gets the next free number, in order of use.
    pub index: Option<u32>,
    /// State of the spindle; `None` if the operator controls it.
    pub spindle: Option<Turning>,
    /// Spindle speed in 1/min.
    pub speed: Option<f64>,
    /// State of the coolant; `None` if the operator controls it.
    pub coolant: Option<Coolant>,
}

/// A cutter with its settings.
#[derive(Clone, Debug)]
pub(super) struct ToolAssignment {
    pub(super) tool: Tool,
    pub(super) spindle: Option<Turning>,
    pub(super) speed: Option<f64>,
    pub(super) coolant: Option<Coolant>,
}

/// Assigns a cutter to each path, and numbers to cutters without one.
pub(super) struct Fitter<'a> {
    table: &'a ToolTable,
    fitted: Vec<(Key, Tool)>,
    pub(super) warnings: Vec<Diagnostic>,
}

/// Identifies a cutter: an entry of the table, or a diameter that is not in the table.
#[derive(Clone, Copy, Debug)]
enum Key {
    Entry(usize),
    Diameter(f64),
}

impl ToolTable {
    /// Finds the tool for a path with the cutter diameter O. Entries that specify paths take precedence over those that do not.
    pub fn find(&self, path: &str, diameter: f64) -> Option<&ToolEntry> {
        self.position(path, diameter).map(|index| &self.entries[index])
    }

    fn position(&self, path: &str, diameter: f64) -> Option<usize> {
        let fits = |entry: &ToolEntry| near(entry.diameter, diameter);
        let is_named = |entry: &ToolEntry| entry.paths.as_ref().is_some_and(|paths| paths.is_match(path));
        let named = self.entries.iter().position(|entry| fits(entry) && is_named(entry));
        named.or_else(|| self.entries.iter().position(|entry| fits(entry) && entry.paths.is_none()))
    }
}

impl<'a> Fitter<'a> {
    pub(super) fn new(table: &'a ToolTable) -> Self {
        Self { table, fitted: Vec::new(), warnings: Vec::new() }
    }

    /// The cutter of a path.
    pub(super) fn fit(&mut self, path: &str, diameter: f64) -> ToolAssignment {
        let position = self.table.position(path, diameter);
        let entry = position.map(|index| &self.table.entries[index]);
        let key = position.map_or(Key::Diameter(diameter), Key::Entry);
        let tool = match self.fitted.iter().find(|(known, _)| known.is(key)) {
            Some((_, tool)) => tool.clone(),
            None => self.add(key, entry, path, diameter),
        };
        ToolAssignment {
            tool,
            spindle: entry.and_then(|entry| entry.spindle),
            speed: entry.and_then(|entry| entry.speed),
            coolant: entry.and_then(|entry| entry.coolant),
        }
    }

    fn add(&mut self, key: Key, entry: Option<&ToolEntry>, path: &str, diameter: f64) -> Tool {
        let index = entry.and_then(|entry| entry.index).unwrap_or_else(|| self.free_index());
        if entry.is_none() && !self.table.entries.is_empty() {
            let warning = Diagnostic::new(&posts::TOOL_UNKNOWN).with("diameter", diameter).in_path(path);
            self.warnings.push(warning.quoting("path", path).with("index", u64::from(index)));
        }
        let name = entry.map_or_else(
            || format!("{} mm", pathbuild_diagnostic::Number(diameter)),
            |entry| entry.name.to_string(),
        );
        let tool = Tool::new(index, diameter, &name);
        self.fitted.push((key, tool.clone()));
        tool
    }

    /// The smallest number used neither by the table nor by a cutter so far.
    fn free_index(&self) -> u32 {
        let is_free = |index: &u32| {
            self.table.entries.iter().all(|entry| entry.index != Some(*index))
                && self.fitted.iter().all(|(_, tool)| tool.index != *index)
        };
        (1..=u32::MAX).find(is_free).unwrap_or(0)
    }
}

impl Key {
    fn is(self, other: Self) -> bool {
        match (self, other) {
            (Self::Entry(a), Self::Entry(b)) => a == b,
            (Self::Diameter(a), Self::Diameter(b)) => near(a, b),
            _ => false,
        }
    }
}
