//! `[machine]`: capabilities of the machine, for `emit`, `verify` and time estimates. (book: program/reading)

use std::fmt::Debug;

use crate::config::kind::Key;
use crate::config::kinds::number::{AXES, EXTENT, NOT_NEGATIVE, POSITIVE};
use crate::config::kinds::text::choice;
use crate::config::origin::SourcedValue;
use crate::config::reader::Table;
use crate::config::result_kind::ResultKind;
use crate::config::show::ShownSetting;
use crate::config::types::{DwellTime, Extent};

section! {
    /// s: how long the spindle takes to reach its speed; posts wait this long after M3
    spin_up: f64 = "spin-up", NOT_NEGATIVE, 0.0, "0", Emit;
    /// unit of P in G4 on a controller where it can be set (Mach3: Config > Logic): "seconds" or "milliseconds"
    dwell: DwellTime = "dwell", choice::<DwellTime>(), DwellTime::Seconds, r#""seconds""#, Emit;
    /// mm: smallest and largest X, in the program's coordinates; without it, X is not limited
    x: Option<Extent> = "x", EXTENT, None, "[0, 300]", Emit;
    /// mm: the same for the Y axis
    y: Option<Extent> = "y", EXTENT, None, "[0, 200]", Emit;
    /// mm: the same for the Z axis
    z: Option<Extent> = "z", EXTENT, None, "[0, 60]", Emit;
    /// mm/min: largest feed
    max_feed: Option<f64> = "maximum-feed", POSITIVE, None, "1500", Check;
    /// mm: travel of X, Y and Z, wherever the part is clamped; x, y and z are more specific
    travel: Option<[f64; 3]> = "travel", AXES, None, "[300, 200, 60]", Emit;
    /// 1/min: the spindle's slowest and fastest speed
    spindle_speeds: Option<Extent> = "spindle-speeds", EXTENT, None, "[3000, 24000]", Emit;
    /// mm/min: highest speeds of X, Y and Z; with accelerations, times are those of the machine
    rates: Option<[f64; 3]> = "rates", AXES, None, "[3000, 3000, 1000]", Neither;
    /// mm/s²: largest accelerations of X, Y and Z
    accelerations: Option<[f64; 3]> = "accelerations", AXES, None, "[200, 200, 50]", Neither;
    /// mm: how far the controller may cut a corner (GRBL's $11); 0: full stop
    junction_deviation: f64 = "junction-deviation", NOT_NEGATIVE, 0.01, "0.01", Neither;
}
