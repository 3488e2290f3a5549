//! Translates the configured tools for post-processors.

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::posts;
use pathbuild_motion::{Coolant, Turning};
use pathbuild_post::{Job, Operation, Tool, ToolEntry, ToolTable};
use regex::Regex;
use rustc_hash::{FxHashMap, FxHashSet};

use crate::config::types;
use crate::workspace::Workspace;

/// The tools of `[tool.NAME]`. Their patterns compile, because the configuration has no errors.
pub fn tool_table(context: &Workspace) -> ToolTable {
    ToolTable { entries: context.settings.tables.tools.value.iter().map(entry).collect() }
}

fn entry(tool: &types::Tool) -> ToolEntry {
    let direction = tool.direction.or_else(|| tool.spindle.map(|_| types::Direction::Clockwise));
    ToolEntry {
        name: tool.name.clone(),
        diameter: tool.diameter,
        paths: tool.paths.as_deref().and_then(|pattern| Regex::new(pattern).ok()),
        index: tool.number,
        spindle: direction.map(|direction| match direction {
            types::Direction::Clockwise => Turning::Clockwise,
            types::Direction::Counterclockwise => Turning::CounterClockwise,
        }),
        speed: tool.spindle,
        coolant: tool.coolant.map(|coolant| match coolant {
            types::Coolant::Off => Coolant::OFF,
            types::Coolant::Mist => Coolant::MIST,
            types::Coolant::Flood => Coolant::FLOOD,
        }),
    }
}

/// Completes the operations of a program that was read with the table's data about their tools, unless the program itself has them. Warns
/// about unknown tool numbers. The spindle stands still while probing, and in a program that cuts nothing.
pub fn complete_tools(job: &mut Job, table: &ToolTable) -> Vec<Diagnostic> {
    let (mut unknown, mut reported) = (Vec::new(), FxHashSet::default());
    let mut entries: FxHashMap<u32, &ToolEntry> = FxHashMap::default();
    for entry in &table.entries {
        if let Some(index) = entry.index {
            entries.entry(index).or_insert(entry);
        }
    }
    let has_cuts = job.operations.iter().any(Operation::cuts);
    for operation in &mut job.operations {
        if !operation.tool.is_named {
            continue;
        }
        let index = operation.tool.index;
        let Some(entry) = entries.get(&index) else {
            if reported.insert(index) {
                unknown.push(index);
            }
            continue;
        };
        operation.tool = Tool::new(index, entry.diameter, &entry.name);
        if !has_cuts || operation.only_probes() {
            operation.spindle = operation.spindle.or(Some(Turning::Off));
            operation.coolant = operation.coolant.or(Some(Coolant::OFF));
            continue;
        }
        operation.spindle = operation.spindle.or(entry.spindle);
        operation.speed = operation.speed.or(entry.speed);
        operation.coolant = operation.coolant.or(entry.coolant);
    }
    let warning = |index| Diagnostic::new(&posts::TOOL_NUMBER_UNKNOWN).with("index", u64::from(index));
    unknown.into_iter().map(warning).collect()
}
