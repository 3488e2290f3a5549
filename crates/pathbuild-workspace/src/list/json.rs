//! JSON form of paths and totals. Lengths are in mm.

use serde_json::{Value, json};

use super::ProgramState;
use super::row::{Row, State};
use super::stats::{Stats, Total};
use crate::findings::Findings;

/// A path as a JSON object. `file` is the displayed name of its drawing.
pub fn path_json(file: &str, row: &Row) -> Value {
    let path = &row.path;
    let axis = |ends: Option<(f64, f64)>| ends.map(|(low, high)| [low, high]);
    let [x, y, z] = path.cutting_box.map(axis);
    json!({
        "path": path.name.as_str(),
        "file": file,
        "material": path.material,
        "thickness": path.thickness,
        "tool": path.tool,
        "size": row.size(),
        "cutting_box": { "x": x, "y": y, "z": z },
        "length": path.length,
        "minutes": path.minutes,
        "state": row.state().key(),
        "errors": row.errors,
        "warnings": row.warnings,
        "program": match path.program {
            ProgramState::None | ProgramState::Unknown => None,
            ProgramState::Current => Some("current"),
            ProgramState::Stale => Some("stale"),
        },
    })
}

/// A drawing with errors of its own, as a JSON object beside those of its paths; `None` if there are only warnings.
pub fn drawing_json(found: &Findings) -> Option<Value> {
    let (errors, warnings) = (found.errors(), found.warnings());
    (errors > 0).then(|| json!({ "path": null, "state": "errors", "errors": errors, "warnings": warnings }))
}

/// Totals as a JSON object.
pub fn stats_json(stats: &Stats) -> Value {
    let states =
        stats.states.iter().map(|(state, count): (&State, _)| (state.key().to_owned(), json!(count)));
    let materials = stats.materials.iter().map(|(name, total)| with(total, "material", json!(name)));
    #[expect(clippy::cast_precision_loss, reason = "a diameter within a drawing's limits")]
    let tool = |tool: &Option<u64>| tool.map(|tool| tool as f64 / 1000.0);
    let cutters = stats.cutters.iter().map(|(tool_, total)| with(total, "tool", json!(tool(tool_))));
    json!({
        "drawings": stats.drawings,
        "paths": stats.all.paths,
        "length": stats.all.length,
        "minutes": stats.all.minutes,
        "states": states.collect::<serde_json::Map<_, _>>(),
        "with_warnings": stats.warnings,
        "materials": materials.collect::<Vec<_>>(),
        "cutters": cutters.collect::<Vec<_>>(),
    })
}

fn with(total: &Total, key: &str, value: Value) -> Value {
    let mut object = json!({ "paths": total.paths, "length": total.length, "minutes": total.minutes });
    object[key] = value;
    object
}
