use std::collections::BTreeMap;

use super::row::{Row, State};

/// What paths add up to.
#[derive(Clone, Debug)]
pub struct Stats {
    /// How many drawings there are.
    pub drawings: usize,
    /// All paths together.
    pub all: Total,
    /// How many paths have warnings.
    pub warnings: usize,
    /// How many paths are in each state.
    pub states: BTreeMap<State, usize>,
    /// By M; `None`: paths that say none.
    pub materials: BTreeMap<Option<Box<str>>, Total>,
    /// By O in micrometres, which can be put in order.
    pub cutters: BTreeMap<Option<u64>, Total>,
}

/// Paths together. Those with errors have no length.
#[derive(Clone, Copy, Debug, Default)]
pub struct Total {
    /// How many.
    pub paths: usize,
    /// mm.
    pub length: f64,
    /// As far as they are known.
    pub minutes: f64,
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
    /// Of these paths, out of so many drawings.
    pub fn of<'a>(rows: impl IntoIterator<Item = &'a Row>, drawings: usize) -> Self {
        let mut stats = Self {
            drawings,
            all: Total::default(),
            warnings: 0,
            states: State::ALL.iter().map(|state| (*state, 0)).collect(),
            materials: BTreeMap::new(),
            cutters: BTreeMap::new(),
        };
        for row in rows {
            stats.all.add(row);
            stats.warnings += usize::from(row.warnings > 0);
            *stats.states.entry(row.state()).or_default() += 1;
            stats.materials.entry(row.path.material.clone()).or_default().add(row);
            stats.cutters.entry(row.path.tool.map(micrometres)).or_default().add(row);
        }
        stats
    }
}
