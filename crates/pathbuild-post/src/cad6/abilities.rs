//! What the control texts of a definition can say.

use super::control_text::Kind;
use super::definition::Definition;

/// Which texts there are, and what they hold.
#[derive(Clone, Copy)]
#[expect(clippy::struct_excessive_bools, reason = "each is about a text of its own")]
pub(super) struct Abilities {
    /// Every rapid can be written as it is.
    pub(super) rapid: bool,
    /// Holes have a text of their own.
    pub(super) hole: bool,
    pub(super) arc: bool,
    /// Lines may go up and down.
    pub(super) line_z: bool,
    /// Arcs may go up and down.
    pub(super) arc_z: bool,
    pub(super) lift_between_passes: bool,
    /// The widest arc, radians.
    pub(super) arc_sweep: f64,
    /// mm.
    pub(super) arc_tolerance: f64,
}

impl Abilities {
    /// Looks through a definition.
    pub(super) fn of(definition: &Definition) -> Self {
        let has = |kind| definition.text(kind).is_some();
        Self {
            rapid: has(Kind::Rapid),
            hole: has(Kind::Point) || has(Kind::Cycle),
            arc: has(Kind::Arc),
            line_z: definition.names_z(Kind::Line),
            arc_z: definition.names_z(Kind::Arc),
            lift_between_passes: definition.settings.lift_between_passes,
            arc_sweep: definition.settings.arc_sweep.to_radians(),
            arc_tolerance: definition.settings.arc_tolerance,
        }
    }
}
