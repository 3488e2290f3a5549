//! Combines the descriptions of several files, and finds tools that are described twice.

use camino::Utf8Path;
use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::import as say;

use super::{DescribedTool, DescribedValue, Description, Target};

/// Combines the values of all descriptions, in the order of the files. Tools with the same number that contradict each other are left out and
/// reported with both places. Two tools of one file contradict each other unless they are equal.
pub fn merge(descriptions: &[(&Utf8Path, Description)]) -> (Vec<DescribedValue>, Vec<Diagnostic>) {
    let mut values = Vec::new();
    let mut tools: Vec<ToolEntry<'_>> = Vec::new();
    let mut problems = Vec::new();
    for (file, description) in descriptions {
        values.extend(description.values.iter().cloned());
        for tool in &description.tools {
            let mut entry = ToolEntry { file, tool, is_taken: true };
            let mut earlier = tools.iter_mut().filter(|earlier| earlier.contradicts(&entry));
            if let Some(first) = earlier.next() {
                problems.push(entry.problem(first));
                first.is_taken = false;
                entry.is_taken = false;
            }
            tools.push(entry);
        }
    }
    let mut names = Vec::new();
    for entry in tools.iter().filter(|entry| entry.is_taken) {
        let target = Target::Tool { number: entry.tool.number, name: unique_name(entry.tool, &mut names) };
        let with_target = |value: &DescribedValue| DescribedValue { target: target.clone(), ..value.clone() };
        for value in entry.tool.values.iter().map(with_target) {
            let is_known = |other: &DescribedValue| other.target == value.target && other.key == value.key;
            if !values.iter().any(is_known) {
                values.push(value);
            }
        }
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

/// Returns the name for a tool: that of an earlier tool with the same number, or else its own, with a number appended if the name is taken.
fn unique_name<'d>(tool: &'d DescribedTool, names: &mut Vec<(String, &'d DescribedTool)>) -> String {
    let number = tool.number.map(|number| format!("T{number}"));
    let own = Some(tool.name.clone()).filter(|name| !name.is_empty()).or(number.clone());
    let own = own.unwrap_or_else(|| "tool".to_owned());
    let is_same = |other: &DescribedTool| tool.number.is_some() && other.number == tool.number;
    if let Some((name, _)) = names.iter().find(|(_, other)| is_same(other)) {
        return name.clone();
    }
    let is_known = names.iter().any(|(known, _)| *known == own);
    let suffix = number.unwrap_or_else(|| names.len().to_string());
    let name = if is_known { format!("{own} ({suffix})") } else { own };
    names.push((name.clone(), tool));
    name
}
