use std::fmt::Write;

use pathbuild_workspace::list::{Stats, Total};

use super::row::word;
use crate::context::Context;
use crate::numbers::{count, decimal};
use crate::table::table;

pub(super) fn text(stats: &Stats, context: &Context) -> String {
    let lang = context.lang();
    let say = |en, de| context.choose(en, de);
    let mut text = format!(
        "{}: {}, {}: {}, {}: {} mm, {}: {}\n",
        say("drawings", "Zeichnungen"),
        count(stats.drawings, lang),
        say("paths", "Pfade"),
        count(stats.all.paths, lang),
        say("length", "Länge"),
        decimal(stats.all.length, 0, lang),
        say("minutes", "Minuten"),
        decimal(stats.all.minutes, 0, lang),
    );
    for (state, number) in &stats.states {
        _ = writeln!(text, "  {}: {}", word(*state, context), count(*number, lang));
    }
    _ = writeln!(
        text,
        "  {}: {}",
        say("paths with warnings", "Pfade mit Warnungen"),
        count(stats.warnings, lang)
    );
    let none = || say("none", "keins").to_owned();
    let materials =
        stats.materials.iter().map(|(name, total)| (name.as_deref().map_or_else(none, str::to_owned), total));
    text.push_str(&by(context, say("material M", "Material M"), materials));
    let cutters = stats.cutters.iter().map(|(tool, total)| {
        #[expect(clippy::cast_precision_loss, reason = "a diameter within a drawing's limits")]
        let shown = tool.map_or_else(none, |tool| decimal(tool as f64 / 1000.0, 3, lang));
        (shown, total)
    });
    text.push_str(&by(context, say("cutter O", "Fräser O"), cutters));
    text
}

fn by<'a>(context: &Context, heading: &str, totals: impl Iterator<Item = (String, &'a Total)>) -> String {
    let lang = context.lang();
    let columns = [
        (heading, false),
        (context.choose("paths", "Pfade"), true),
        (context.choose("length", "Länge"), true),
        ("min", true),
    ];
    let rows = totals.map(|(name, total)| {
        vec![name, count(total.paths, lang), decimal(total.length, 0, lang), decimal(total.minutes, 0, lang)]
    });
    format!("\n{}", table(&columns, rows))
}
