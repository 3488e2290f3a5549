//! The tool table: which cutter, spindle and coolant a program with a given O runs with. (`[tool.NAME]` in pathbuild.toml)

use regex::Regex;

use super::job::{Coolant, Spindle, Tool};

/// The tools of the configuration.
#[derive(Clone, Debug, Default)]
pub struct ToolTable {
    /// In the order of the configuration; the first that fits is taken.
    pub entries: Vec<ToolEntry>,
}

/// One tool of the configuration.
#[derive(Clone, Debug)]
pub struct ToolEntry {
    /// The cutter.
    pub tool: Tool,
    /// Which paths it is for, where several cutters have one diameter (S and T cutters): found anywhere in the path's name, so `T$`.
    pub paths: Option<Regex>,
    /// What the spindle does; `None` when the machine's operator sees to it.
    pub spindle: Option<Spindle>,
    /// Spindle speed in 1/min.
    pub speed: Option<f64>,
    /// What the coolant does; `None` when the machine's operator sees to it.
    pub coolant: Option<Coolant>,
}

impl ToolTable {
    /// The tool for a path milled with the cutter diameter O. An entry that names paths wins over one that does not.
    pub fn find(&self, path: &str, diameter: f64) -> Option<&ToolEntry> {
        let fitting = || self.entries.iter().filter(|entry| near(entry.tool.diameter, diameter));
        let named = |entry: &&ToolEntry| entry.paths.as_ref().is_some_and(|paths| paths.is_match(path));
        fitting().find(named).or_else(|| fitting().find(|entry| entry.paths.is_none()))
    }
}

/// `near()` of spec/00-overview.md.
pub(super) fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-6 * (a.abs().max(b.abs()) + 0.001)
}
