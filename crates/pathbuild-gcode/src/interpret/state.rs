//! The modal state of a control.

use pathbuild_motion::{Axes, Coolant, Plane, Position, Spindle, Turning};

use super::codes::{FeedUnit, Motion};
use super::offsets::Offsets;
use super::options::MachineOffsets;
use crate::dialect::{Rules, StartMotion};

/// Length of an inch in mm.
pub(super) const INCH: f64 = 25.4;

/// The modal state.
#[derive(Debug)]
pub(super) struct State {
    pub(super) position: Position,
    /// The axes whose position has been specified since the last tool change; all of them before the first one.
    pub(super) stated_axes: Axes,
    /// Line and code (times ten) of a move to a machine position, which is unknown.
    pub(super) lost: Option<(u32, u16)>,
    pub(super) motion: Motion,
    /// Code of the motion (times ten), for messages.
    pub(super) motion_code: u16,
    pub(super) plane: Plane,
    pub(super) incremental: bool,
    pub(super) incremental_centres: bool,
    /// Length of the program's unit in mm.
    pub(super) unit: f64,
    pub(super) feed_unit: FeedUnit,
    /// F in the unit given by [`feed_unit`](Self::feed_unit), with lengths in mm.
    pub(super) feed: f64,
    /// Line and code (times ten) of the feed mode word that cleared F.
    pub(super) feed_cleared: Option<(u32, u16)>,
    pub(super) spindle: Spindle,
    pub(super) coolant: Coolant,
    /// T.
    pub(super) tool: Option<u32>,
    /// The layer (XpertMILL).
    pub(super) layer: u32,
    /// The speeds of the layers, by number.
    pub(super) layer_speeds: Vec<(u32, f64)>,
    /// Feed of the last rapid move in mm/min, if it depends on F.
    pub(super) rapid_feed: Option<f64>,
    pub(super) retract_to_r: bool,
    pub(super) cycle: CycleState,
    pub(super) offsets: Offsets,
    pub(super) stated: Stated,
}

/// The values of drilling cycles, which are kept until another motion.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct CycleState {
    /// Position before the first cycle of the series.
    pub(super) initial: [f64; 3],
    /// R and Z as heights, P and Q.
    pub(super) r: Option<f64>,
    pub(super) z: Option<f64>,
    pub(super) p: Option<f64>,
    pub(super) q: Option<f64>,
}

/// What the program has specified, and which omissions have been reported.
#[derive(Debug, Default)]
#[expect(clippy::struct_excessive_bools, reason = "independent facts, not states")]
pub(super) struct Stated {
    pub(super) units: bool,
    pub(super) distance: bool,
    pub(super) plane: bool,
    pub(super) feed_missing: bool,
    pub(super) program_number: bool,
}

impl State {
    pub(super) fn new(rules: &Rules, offsets: Option<&MachineOffsets>) -> Self {
        Self {
            position: Position::default(),
            stated_axes: Axes::ALL,
            lost: None,
            motion: match rules.start_motion {
                StartMotion::Rapid => Motion::Rapid,
                StartMotion::None => Motion::None,
            },
            motion_code: 0,
            plane: Plane::Xy,
            incremental: false,
            incremental_centres: true,
            unit: 1.0,
            feed_unit: FeedUnit::PerMinute,
            feed: 0.0,
            feed_cleared: None,
            spindle: Spindle { turning: Turning::Unstated, speed: 0.0 },
            coolant: Coolant::default(),
            tool: None,
            layer: 1,
            layer_speeds: Vec::new(),
            rapid_feed: None,
            retract_to_r: !rules.lifts_to_start,
            cycle: CycleState::default(),
            offsets: Offsets::new(offsets),
            stated: Stated::default(),
        }
    }
}
