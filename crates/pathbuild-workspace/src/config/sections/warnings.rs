//! `[warnings]`: thresholds beyond which something allowed is doubtful.

use std::fmt::Debug;

use crate::config::kind::Key;
use crate::config::kinds::number::NOT_NEGATIVE;
use crate::config::origin::SourcedValue;
use crate::config::reader::Table;
use crate::config::result_kind::ResultKind;
use crate::config::show::ShownSetting;

section! {
    /// mm: how far B may be below the plate (PB211)
    below_plate: f64 = "below-plate", NOT_NEGATIVE, 0.5, "0.5", Check;
    /// how many times T an infeed I may be at most (PB211)
    infeed: f64 = "infeed", NOT_NEGATIVE, 1.0, "1", Check;
    /// how many times T a mark may be deep at most (PB211)
    mark_depth: f64 = "mark-depth", NOT_NEGATIVE, 0.5, "0.5", Check;
    /// mm: by how much a text must be nearer to its element than to another (PB116)
    text_margin: f64 = "text-margin", NOT_NEGATIVE, 0.1, "0.1", Check;
    /// mm: up to how much larger than the cutter a circle looks like a hole to be drilled (PB118)
    hole_margin: f64 = "hole-margin", NOT_NEGATIVE, 0.05, "0.05", Check;
}
