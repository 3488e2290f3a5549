//! The summary of a program as a JSON object. Lengths are in mm, feeds in mm/min.

use pathbuild_diagnostic::Lang;
use pathbuild_gcode::statistics::{MoveTotals, Tally};
use pathbuild_gcode::summary::{Extent, Used};
use serde_json::{Value, json};

use super::facts::Facts;
use crate::context::Context;

pub(super) fn json(context: &Context, facts: &Facts<'_>) -> Value {
    let (program, summary) = (facts.program, &facts.summary);
    let taken =
        facts.taken.iter().map(|taken| json!({ "line": taken.place.line, "message": taken.text(Lang::En) }));
    let whole = |extent: &Extent| if facts.unfollowed.is_some() { Extent::default() } else { *extent };
    json!({
        "file": context.file(&program.file),
        "lines": program.lines(),
        "dialect": program.dialect.name(),
        "guessed": program.evidence.map(|evidence| json!({ "reason": evidence.reason.en, "line": evidence.line })),
        "moves": tally(&summary.total),
        "unfollowed_line": facts.unfollowed,
        "box": extent(&whole(&summary.extent)),
        "cutting_box": extent(&whole(&summary.cut)),
        "tools": summary.tools.iter().map(used).collect::<Vec<_>>(),
        "minutes": facts.minutes(),
        "rapid": facts.rapid,
        "machine_seconds": facts.machine_seconds,
        "dwell_seconds": summary.dwell,
        "stops": summary.stops,
        "tool_changes": summary.tool_changes,
        "taken": taken.collect::<Vec<_>>(),
    })
}

fn tally(tally: &Tally) -> Value {
    let kind = |kind: &MoveTotals| json!({ "count": kind.moves, "length": kind.total.length });
    json!({
        "count": tally.moves(),
        "arcs": tally.arcs,
        "rapid": kind(&tally.rapid),
        "milling": kind(&tally.milling),
        "drilling": kind(&tally.drilling),
        "probing": { "count": tally.probing },
    })
}

fn extent(extent: &Extent) -> Value {
    let axis = |ends: &Option<(f64, f64)>| ends.map(|(low, high)| [low, high]);
    json!({ "x": axis(&extent[0]), "y": axis(&extent[1]), "z": axis(&extent[2]) })
}

fn used(used: &Used) -> Value {
    json!({ "tool": used.tool, "moves": tally(&used.tally), "feeds": used.feeds, "speeds": used.speeds })
}
