//! `[machine]`: what the machine can do, for `verify`. (spec/90-gcode-import.md)

use crate::config::kind::Key;
use crate::config::kinds::number::{EXTENT, POSITIVE};
use crate::config::origin::Sourced;
use crate::config::reader::Table;
use crate::config::show::Shown;
use crate::config::types::Extent;

section! {
    /// mm: from where to where the X axis goes, in the program's coordinates; without it any X is right
    x: Option<Extent> = "x", EXTENT, None, "[0, 300]";
    /// mm: the same for the Y axis
    y: Option<Extent> = "y", EXTENT, None, "[0, 200]";
    /// mm: the same for the Z axis
    z: Option<Extent> = "z", EXTENT, None, "[0, 60]";
    /// mm/min: largest feed
    max_feed: Option<f64> = "max-feed", POSITIVE, None, "1500";
}
