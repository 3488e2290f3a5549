//! Classifies G codes by their effect.

use pathbuild_motion::{Group, Plane, WordEffect, WorkSystem};

/// The effect of a G code.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Command {
    Motion(Motion),
    Dwell,
    SetOffsets,
    Plane(Plane),
    Inches(bool),
    Home(usize),
    StoreHome(usize),
    /// Moves axes to their reference switches.
    Reference,
    /// G40, G43, G49, G61, G64 and others that do not change the programmed position of the tool tip.
    NoEffect(Group),
    /// G43.1, which sets the tool length by the coordinates in its line.
    LengthByNumber,
    LocalOffset,
    MachineCoordinates,
    System(WorkSystem),
    /// G54.1, G154: the additional system with the number P.
    NumberedSystem,
    Incremental(bool),
    IncrementalCentres(bool),
    /// G92, which sets the coordinates of the current position.
    SetOrigin,
    Origin(Origin),
    FeedMode(FeedUnit),
    RetractToR(bool),
    NotFollowed(Group),
}

/// The effect of coordinates without a G word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Motion {
    None,
    Rapid,
    Feed,
    Arc {
        clockwise: bool,
    },
    Probe {
        toward: bool,
        must_answer: bool,
    },
    Cycle(Cycle),
    /// An unsupported motion, which has been reported.
    Unfollowed,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cycle {
    /// G73: in pecks, with a small retraction to break the chip.
    ChipBreaking,
    /// G81: drills to the bottom in one move.
    Plain,
    /// G82: dwells at the bottom.
    Dwelling,
    /// G83: in pecks, with full retraction after each.
    Pecking,
    /// G85: retracts at feed.
    Boring,
    /// G89: dwells at the bottom and retracts at feed.
    BoringDwelling,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum FeedUnit {
    /// G94: mm or inches per minute.
    #[default]
    PerMinute,
    /// G93: the reciprocal of a move's duration, in 1/min.
    InverseTime,
    /// G95: mm or inches per spindle revolution.
    PerTurn,
}

/// The effects of G92.1, G92.2 and G92.3 on the offset that G92 has set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Origin {
    /// G92.1: clears the offset.
    Clear,
    /// G92.2: suspends the offset.
    Suspend,
    /// G92.3: restores the offset.
    Resume,
}

/// The word to which coordinates, F and other values of a block belong. On controls that obey one command per line, they belong to that command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ValueOwner {
    /// A word that can move the machine or uses coordinates. On all other controls, the motion in effect.
    Move,
    /// A word that the interpreter executes, and that never moves the machine.
    Command,
    /// A word that the interpreter does not execute: its values are ignored.
    NotFollowed,
}

impl Command {
    pub(super) fn group(self) -> Group {
        match self {
            Self::Motion(_) => Group::Motion,
            Self::Dwell => Group::Dwell,
            Self::SetOffsets
            | Self::Home(_)
            | Self::StoreHome(_)
            | Self::Reference
            | Self::LocalOffset
            | Self::SetOrigin
            | Self::Origin(_) => Group::NonModal,
            Self::Plane(_) => Group::Plane,
            Self::LengthByNumber => Group::ToolLength,
            Self::Inches(_) => Group::Units,
            Self::MachineCoordinates => Group::MachineCoordinates,
            Self::System(_) | Self::NumberedSystem => Group::System,
            Self::Incremental(_) => Group::Distance,
            Self::IncrementalCentres(_) => Group::ArcDistance,
            Self::FeedMode(_) => Group::FeedMode,
            Self::RetractToR(_) => Group::Retract,
            Self::NoEffect(group) | Self::NotFollowed(group) => group,
        }
    }

    /// Returns how far the interpreter executes the command; `Followed` also for unsupported commands, which have been reported already.
    pub(super) fn effect(self) -> WordEffect {
        match self {
            Self::NoEffect(Group::ToolLength | Group::PathControl) => WordEffect::Followed,
            Self::NoEffect(_) => WordEffect::NotFollowed,
            Self::System(_) | Self::NumberedSystem => WordEffect::System,
            Self::Home(_) | Self::Reference | Self::MachineCoordinates => WordEffect::Place,
            _ => WordEffect::Followed,
        }
    }

    /// Whether the command can move the machine, or uses the coordinates of its line.
    pub(super) fn may_move(self) -> bool {
        matches!(self.group(), Group::Motion | Group::NonModal | Group::MachineCoordinates)
    }

    /// Whether the command consumes the coordinates of the line.
    pub(super) fn takes_coordinates(self) -> bool {
        match self {
            Self::SetOffsets
            | Self::Home(_)
            | Self::Reference
            | Self::LengthByNumber
            | Self::LocalOffset
            | Self::SetOrigin => true,
            Self::Motion(motion) => motion != Motion::None,
            _ => false,
        }
    }

    /// Returns the effect of a G code (times ten). Unit words depend on the dialect and are looked up beforehand.
    pub(super) fn of(code: u16) -> Self {
        use Group::{CutterCompensation, LatheMode, PathControl, SpindleMode, ToolLength, Transform};
        let system =
            |index| WorkSystem::from_number(index).map_or(Self::NotFollowed(Group::System), Self::System);
        match code {
            40 => Self::Dwell,
            100 => Self::SetOffsets,
            170 => Self::Plane(Plane::Xy),
            180 => Self::Plane(Plane::Zx),
            190 => Self::Plane(Plane::Yz),
            171 | 181 | 191 => Self::NotFollowed(Group::Plane),
            200 => Self::Inches(true),
            210 => Self::Inches(false),
            280 => Self::Home(0),
            281 => Self::StoreHome(0),
            300 => Self::Home(1),
            301 => Self::StoreHome(1),
            400 => Self::NoEffect(CutterCompensation),
            410 | 411 | 420 | 421 | 390 | 1410 => Self::NotFollowed(CutterCompensation),
            1430 => Self::NotFollowed(ToolLength),
            430 | 432 | 490 => Self::NoEffect(ToolLength),
            431 => Self::LengthByNumber,
            520 => Self::LocalOffset,
            530 => Self::MachineCoordinates,
            540 | 550 | 560 | 570 | 580 | 590 => system(u32::from(code - 540) / 10 + 1),
            591..=593 => system(u32::from(code - 591) + 7),
            541 | 1540 => Self::NumberedSystem,
            // Haas: G110 to G129 are G154 P1 to P20.
            1100..=1290 if code.is_multiple_of(10) => {
                let additional = WorkSystem::additional(u32::from(code - 1090) / 10);
                additional.map_or(Self::NotFollowed(Group::System), Self::System)
            }
            90 | 610 | 611 | 640 => Self::NoEffect(PathControl),
            // G15, G50 and G69 switch polar coordinates, scaling, mirroring and rotation off. They have no effect, because the words that switch
            // these on are reported and not executed.
            150 | 500 | 690 => Self::NoEffect(Transform),
            // Fanuc: G07.1 and G51.1; Haas: G101, G107, G234 and G254.
            160 | 510 | 680 | 71 | 511 | 1010 | 1070 | 2340 | 2540 => Self::NotFollowed(Transform),
            70 => Self::NotFollowed(LatheMode),
            80 => Self::NoEffect(LatheMode),
            900 => Self::Incremental(false),
            910 => Self::Incremental(true),
            901 => Self::IncrementalCentres(false),
            911 => Self::IncrementalCentres(true),
            920 => Self::SetOrigin,
            921 => Self::Origin(Origin::Clear),
            922 => Self::Origin(Origin::Suspend),
            923 => Self::Origin(Origin::Resume),
            930 => Self::FeedMode(FeedUnit::InverseTime),
            940 => Self::FeedMode(FeedUnit::PerMinute),
            950 => Self::FeedMode(FeedUnit::PerTurn),
            960 => Self::NotFollowed(SpindleMode),
            970 => Self::NoEffect(SpindleMode),
            980 => Self::RetractToR(false),
            990 => Self::RetractToR(true),
            _ => motion(code).map_or(Self::NotFollowed(Group::Motion), Self::Motion),
        }
    }
}

fn motion(code: u16) -> Option<Motion> {
    Some(match code {
        0 => Motion::Rapid,
        10 => Motion::Feed,
        20 => Motion::Arc { clockwise: true },
        30 => Motion::Arc { clockwise: false },
        382 => Motion::Probe { toward: true, must_answer: true },
        // G31 ("skip") is like G38.3: if the probe makes no contact, the program continues.
        310 | 383 => Motion::Probe { toward: true, must_answer: false },
        384 => Motion::Probe { toward: false, must_answer: true },
        385 => Motion::Probe { toward: false, must_answer: false },
        730 => Motion::Cycle(Cycle::ChipBreaking),
        800 => Motion::None,
        810 => Motion::Cycle(Cycle::Plain),
        820 => Motion::Cycle(Cycle::Dwelling),
        830 => Motion::Cycle(Cycle::Pecking),
        850 => Motion::Cycle(Cycle::Boring),
        890 => Motion::Cycle(Cycle::BoringDwelling),
        _ => return None,
    })
}

/// Whether a G code is a cycle, for drilling, tapping, boring or threads, in all dialects that have this code.
pub(super) fn is_cycle(code: u16) -> bool {
    matches!(code, 730 | 740 | 760 | 810 | 820 | 830 | 840 | 850 | 860 | 870 | 880 | 890)
}

/// Returns the name of a G or M code, given ten times its number: `G1`, `G38.2`. For an O word, which has the code 0, it is the letter alone.
pub fn name(letter: char, code: u16) -> String {
    match code % 10 {
        0 if letter == 'O' => letter.to_string(),
        0 => format!("{letter}{}", code / 10),
        tenth => format!("{letter}{}.{tenth}", code / 10),
    }
}
