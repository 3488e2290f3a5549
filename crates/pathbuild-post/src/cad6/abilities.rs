//! What the control texts of a definition are able to express.

use super::control_text::ControlTextKind;
use super::definition::Definition;

/// Which control texts a definition has, and what they contain.
#[derive(Clone, Copy)]
#[expect(clippy::struct_excessive_bools, reason = "each is about a text of its own")]
pub(super) struct Abilities {
    /// Every rapid can be written exactly as it is.
    pub(super) rapid: bool,
    /// There is a text for holes.
    pub(super) hole: bool,
    /// The text for holes uses the peck depth.
    pub(super) peck: bool,
    /// The text for holes uses the dwell time at the bottom.
    pub(super) dwell: bool,
    pub(super) arc: bool,
    /// The text for arcs uses centres relative to the start of the arc.
    pub(super) has_relative_centres: bool,
    /// The text for arcs uses absolute centres.
    pub(super) has_absolute_centres: bool,
    /// Decimals of rounded numbers.
    pub(super) decimals: usize,
    /// Lines may change Z.
    pub(super) line_z: bool,
    /// Arcs may change Z.
    pub(super) arc_z: bool,
    pub(super) lift_between_passes: bool,
    /// Widest arc, in radians.
    pub(super) arc_sweep: f64,
    /// In mm.
    pub(super) arc_tolerance: f64,
}

impl Abilities {
    /// Determines the abilities of a definition.
    pub(super) fn of(definition: &Definition) -> Self {
        let has = |kind| definition.text(kind).is_some();
        let hole = if has(ControlTextKind::Cycle) { ControlTextKind::Cycle } else { ControlTextKind::Point };
        Self {
            rapid: has(ControlTextKind::Rapid),
            hole: has(hole),
            peck: definition.names(hole, &["PeckDepth"]),
            dwell: definition.names(hole, &["DwellTime"]),
            has_absolute_centres: definition.names(ControlTextKind::Arc, &["XC", "YC"]),
            has_relative_centres: definition.names(ControlTextKind::Arc, &["IRel", "JRel"]),
            decimals: definition.settings.decimals,
            arc: has(ControlTextKind::Arc),
            line_z: definition.names(ControlTextKind::Line, &["Z1", "ZIncr"]),
            arc_z: definition.names(ControlTextKind::Arc, &["Z1", "ZIncr"]),
            lift_between_passes: definition.settings.lift_between_passes,
            arc_sweep: definition.settings.arc_sweep.to_radians(),
            arc_tolerance: definition.settings.arc_tolerance,
        }
    }
}
