use std::collections::BTreeMap;
use std::fmt::Write;

use super::row::{Row, State};
use crate::context::Context;
use crate::numbers::{count, decimal};
use crate::table::table;

/// What paths add up to.
pub(super) struct Stats {
    pub(super) drawings: usize,
    pub(super) all: Total,
    pub(super) warnings: usize,
    pub(super) states: BTreeMap<State, usize>,
    /// By M; `None`: paths that say none.
    pub(super) materials: BTreeMap<Option<Box<str>>, Total>,
    /// By O in micrometres, which can be put in order.
    pub(super) cutters: BTreeMap<Option<u64>, Total>,
}

/// Paths together. Those with errors have no length.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Total {
    pub(super) paths: usize,
    /// mm.
    pub(super) length: f64,
    pub(super) minutes: f64,
}

impl Total {
    fn add(&mut self, row: &Row) {
        self.paths += 1;
        self.length += row.path.length.unwrap_or_default();
        self.minutes += row.path.minutes.unwrap_or_default();
    }
}

/// A diameter in whole micrometres; one that is no length there is none of.
fn micrometres(tool: f64) -> u64 {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a diameter within a drawing's limits"
    )]
    let rounded = (tool * 1000.0).round().max(0.0) as u64;
    rounded
}

impl Stats {
    pub(super) fn of(rows: &[Row], drawings: usize) -> Self {
        let mut stats = Self {
            drawings,
            all: Total::default(),
            warnings: rows.iter().filter(|row| row.warnings > 0).count(),
            states: State::ALL.iter().map(|state| (*state, 0)).collect(),
            materials: BTreeMap::new(),
            cutters: BTreeMap::new(),
        };
        for row in rows {
            stats.all.add(row);
            *stats.states.entry(row.state()).or_default() += 1;
            stats.materials.entry(row.path.material.clone()).or_default().add(row);
            stats.cutters.entry(row.path.tool.map(micrometres)).or_default().add(row);
        }
        stats
    }

    pub(super) fn text(&self, context: &Context) -> String {
        let lang = context.lang();
        let say = |en, de| context.choose(en, de);
        let mut text = format!(
            "{}: {}, {}: {}, {}: {} mm, {}: {}\n",
            say("drawings", "Zeichnungen"),
            count(self.drawings, lang),
            say("paths", "Pfade"),
            count(self.all.paths, lang),
            say("length", "Länge"),
            decimal(self.all.length, 0, lang),
            say("minutes", "Minuten"),
            decimal(self.all.minutes, 0, lang),
        );
        for (state, number) in &self.states {
            _ = writeln!(text, "  {}: {}", state.word(context), count(*number, lang));
        }
        _ = writeln!(
            text,
            "  {}: {}",
            say("paths with warnings", "Pfade mit Warnungen"),
            count(self.warnings, lang)
        );
        let none = || say("none", "keins").to_owned();
        let materials = self
            .materials
            .iter()
            .map(|(name, total)| (name.as_deref().map_or_else(none, str::to_owned), total));
        text.push_str(&Self::table(context, say("material M", "Material M"), materials));
        let cutters = self.cutters.iter().map(|(tool, total)| {
            #[expect(clippy::cast_precision_loss, reason = "a diameter within a drawing's limits")]
            let shown = tool.map_or_else(none, |tool| decimal(tool as f64 / 1000.0, 3, lang));
            (shown, total)
        });
        text.push_str(&Self::table(context, say("cutter O", "Fräser O"), cutters));
        text
    }

    fn table<'a>(
        context: &Context,
        heading: &str,
        totals: impl Iterator<Item = (String, &'a Total)>,
    ) -> String {
        let lang = context.lang();
        let columns = [
            (heading, false),
            (context.choose("paths", "Pfade"), true),
            (context.choose("length", "Länge"), true),
            ("min", true),
        ];
        let rows = totals.map(|(name, total)| {
            vec![
                name,
                count(total.paths, lang),
                decimal(total.length, 0, lang),
                decimal(total.minutes, 0, lang),
            ]
        });
        format!("\n{}", table(&columns, rows))
    }
}
