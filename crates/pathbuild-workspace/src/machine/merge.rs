//! Combines the descriptions of several files, and finds tools that are described twice.

use camino::Utf8Path;
use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::import as say;
use rustc_hash::{FxHashMap, FxHashSet};

use super::{DescribedTool, DescribedValue, Description, Target};

/// Combines the values of all descriptions, in the order of the files, each with its table of the configuration. Tools with the same number that
/// contradict each other are left out and reported with both places. Two tools of one file contradict each other unless they are equal.
pub fn merge(descriptions: &[(&Utf8Path, Description)]) -> (Vec<(Target, DescribedValue)>, Vec<Diagnostic>) {
    let mut values = Vec::new();
    let mut tools: Vec<ToolEntry<'_>> = Vec::new();
    let mut by_number: FxHashMap<u32, Vec<usize>> = FxHashMap::default();
    let mut problems = Vec::new();
    for (file, description) in descriptions {
        values.extend(description.values.iter().map(|value| (Target::Machine, value.clone())));
        for tool in &description.tools {
            let mut entry = ToolEntry { file, tool, is_taken: true };
            if let Some(number) = tool.number {
                let same_number = by_number.entry(number).or_default();
                if let Some(first) = same_number.iter().find(|index| tools[**index].contradicts(&entry)) {
                    problems.push(entry.problem(&tools[*first]));
                    tools[*first].is_taken = false;
                    entry.is_taken = false;
                }
                same_number.push(tools.len());
            }
            tools.push(entry);
        }
    }
    let mut names = ToolNames::default();
    let mut known: FxHashSet<(Target, &str)> =
        values.iter().map(|(target, value)| (target.clone(), value.key)).collect();
    for entry in tools.iter().filter(|entry| entry.is_taken) {
        let target = Target::Tool { number: entry.tool.number, name: names.unique_name(entry.tool) };
        let new = entry.tool.values.iter().filter(|value| known.insert((target.clone(), value.key)));
        values.extend(new.map(|value| (target.clone(), value.clone())));
    }
    (values, problems)
}

struct ToolEntry<'d> {
    file: &'d Utf8Path,
    tool: &'d DescribedTool,
    is_taken: bool,
}

impl ToolEntry<'_> {
    fn contradicts(&self, other: &Self) -> bool {
        if self.tool.number.is_none() || self.tool.number != other.tool.number {
            return false;
        }
        let is_other = |one: &DescribedValue| {
            other.tool.values.iter().any(|value| value.key == one.key && value.value != one.value)
        };
        let has_lone_key = |one: &DescribedTool, another: &DescribedTool| {
            one.values.iter().any(|value| another.values.iter().all(|other| other.key != value.key))
        };
        let is_of_one_file = self.file == other.file;
        let is_unequal = self.tool.name != other.tool.name
            || has_lone_key(self.tool, other.tool)
            || has_lone_key(other.tool, self.tool);
        self.tool.values.iter().any(is_other) || is_of_one_file && is_unequal
    }

    fn problem(&self, earlier: &Self) -> Diagnostic {
        let message = match earlier.tool.line {
            Some(_) => &say::TOOL_TWICE_AT_LINE,
            None => &say::TOOL_TWICE,
        };
        let problem = Diagnostic::new(message).quoting("name", &*self.tool.name);
        let problem = problem.with("number", u64::from(self.tool.number.unwrap_or_default()));
        let problem = problem.quoting("earlier", &*earlier.tool.name).quoting("file", earlier.file);
        let problem = problem.with("line", u64::from(earlier.tool.line.unwrap_or_default()));
        problem.at_line(self.tool.line, None).in_file(self.file)
    }
}

/// The names that tools have been given.
#[derive(Default)]
struct ToolNames {
    by_number: FxHashMap<u32, String>,
    taken: FxHashSet<String>,
}

impl ToolNames {
    /// Returns the name for a tool: that of an earlier tool with the same number, or else its own, with a number appended if the name is taken.
    fn unique_name(&mut self, tool: &DescribedTool) -> String {
        if let Some(name) = tool.number.and_then(|number| self.by_number.get(&number)) {
            return name.clone();
        }
        let number = tool.number.map(|number| format!("T{number}"));
        let own = Some(tool.name.clone()).filter(|name| !name.is_empty()).or(number.clone());
        let own = own.unwrap_or_else(|| "tool".to_owned());
        let suffix = number.unwrap_or_else(|| self.taken.len().to_string());
        let name = if self.taken.contains(&own) { format!("{own} ({suffix})") } else { own };
        self.taken.insert(name.clone());
        self.by_number.extend(tool.number.map(|number| (number, name.clone())));
        name
    }
}
