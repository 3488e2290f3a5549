//! Limits of the machine, from the `[machine]` table.

use pathbuild_gcode::verify::{Machine, Travel};

use crate::config::types::Extent;
use crate::workspace::Workspace;

/// The machine of the configuration; `None` if nothing is configured.
pub fn machine(context: &Workspace) -> Option<Machine> {
    let settings = &context.settings.machine;
    let placed = [settings.x.value, settings.y.value, settings.z.value];
    let travel = if placed.iter().any(Option::is_some) {
        Some(Travel::Placed(placed.map(ends)))
    } else {
        settings.travel.value.map(Travel::Size)
    };
    let machine = Machine {
        travel,
        feed: settings.max_feed.value,
        rates: settings.rates.value.map_or([None; 3], |rates| rates.map(Some)),
        spindle: settings.spindle_speeds.value.map(|speeds| (speeds.from, speeds.to)),
    };
    (machine != Machine::default()).then_some(machine)
}

/// Lower and upper end of an axis; unlimited if not configured.
fn ends(extent: Option<Extent>) -> (f64, f64) {
    extent.map_or((f64::NEG_INFINITY, f64::INFINITY), |extent| (extent.from, extent.to))
}
