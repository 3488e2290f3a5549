use std::collections::BTreeMap;

use super::row::{Row, State};

/// Totals of paths.
#[derive(Clone, Debug)]
pub struct Stats {
    /// Number of drawings.
    pub drawings: usize,
    /// Totals of all paths.
    pub all: Total,
    /// Number of paths with warnings.
    pub warnings: usize,
    /// Number of paths in each state.
    pub states: BTreeMap<State, usize>,
    /// Totals by M; `None` for paths without M.
    pub materials: BTreeMap<Option<Box<str>>, Total>,
    /// Totals by O in micrometres, an integer so that it can be a key.
    pub cutters: BTreeMap<Option<u64>, Total>,
}

/// Totals of some paths. Paths with errors have no length.
#[derive(Clone, Copy, Debug, Default)]
pub struct Total {
    /// Number of paths.
    pub paths: usize,
    /// Length in mm.
    pub length: f64,
    /// Time in minutes, as far as it is known.
    pub minutes: f64,
}

impl Total {
    fn add(&mut self, row: &Row) {
        self.paths += 1;
        self.length += row.path.length.unwrap_or_default();
        self.minutes += row.path.minutes.unwrap_or_default();
    }
}

/// A diameter in whole micrometres; 0 for a negative one.
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
    /// Totals of these paths, which were found in `drawings` drawings.
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
