//! A comparison as JSON lines of the document.

use camino::Utf8Path;
use pathbuild_view::{ChangeKind, Group};
use pathbuild_workspace::diff::{Comparison, Outcome, PathDiff};
use serde_json::{Value, json};

use crate::context::Context;

/// Prints a line for each changed path, and one for the whole comparison.
pub(super) fn rows(context: &Context, comparison: &Comparison) {
    for changed in &comparison.paths {
        context.row("path_change", path(changed));
    }
    context.row("comparison", json!({ "paths": comparison.looked_at, "changed": comparison.paths.len() }));
}

fn path(path: &PathDiff) -> Value {
    let outcome = match &path.outcome {
        Outcome::Added => "added",
        Outcome::Removed => "removed",
        Outcome::Broken => "broken",
        Outcome::Mended => "mended",
        Outcome::StillBroken => "still-broken",
        Outcome::OtherDrawing => "other-drawing",
        Outcome::Changed(_) => "changed",
    };
    let [old, new] = path.files.each_ref().map(|file| file.as_deref().map(Utf8Path::as_str));
    let mut value = json!({ "path": path.name, "old_file": old, "new_file": new, "outcome": outcome });
    if let Outcome::Changed(program) = &path.outcome {
        value["changes"] = program.groups.iter().map(group).collect();
        value["old"] = json!(program.totals[0]);
        value["new"] = json!(program.totals[1]);
    }
    value
}

fn group(group: &Group) -> Value {
    let mut value =
        json!({ "moves": group.moves, "length": thousandths(group.length), "first_to": group.at });
    let kind = match group.kind {
        None => "rapids",
        Some(ChangeKind::Added) => "added",
        Some(ChangeKind::Removed) => "removed",
        Some(ChangeKind::Reordered) => "reordered",
        Some(ChangeKind::Shifted(by)) => {
            value["by"] = json!(by.map(thousandths));
            "shifted"
        }
        Some(ChangeKind::Altered { raised, feed, passes }) => {
            value["raised"] = json!(raised);
            value["feed"] = json!(feed);
            value["passes"] = json!(passes);
            "altered"
        }
    };
    value["kind"] = kind.into();
    value
}

fn thousandths(value: f64) -> f64 {
    (value * 1000.0).round() / 1000.0
}
