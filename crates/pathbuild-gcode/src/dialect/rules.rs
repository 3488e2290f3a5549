//! The rules of each dialect, side by side.

use super::Dialect;
use super::codes::{self, Words};
use super::comment::OBEYED;
use super::spelling::{Blanks, Grammar, LineLength, Operators, Percent, Slash, Spelling, Style};

/// Everything in which a dialect differs from the others.
#[derive(Debug)]
#[expect(clippy::struct_excessive_bools, reason = "independent facts, not states")]
pub struct Rules {
    /// Whose rules these are.
    pub dialect: Dialect,
    /// How it is spelt.
    pub spelling: Spelling,
    /// Which words it takes.
    pub words: &'static Words,
    /// How it reads arcs.
    pub arcs: ArcRules,
    /// What G93, G94 and G95 do to the feed that was set before.
    pub feed_mode: FeedMode,
    /// What a line of coordinates means before any motion word.
    pub start_motion: StartMotion,
    /// The words that switch to inches and to millimetres (G codes times ten).
    pub unit_words: [u16; 2],
    /// Moves go to layers by M6, and S belongs to the layer.
    pub layers: bool,
    /// A motion word holds only for its own line; repeating it by coordinates alone is read with a warning.
    pub motion_is_stated: bool,
    /// How G4 says its time.
    pub dwell: DwellRules,
    /// The control obeys one G, M or T word a line, the first, and every line begins with one. Other words are values of that one.
    pub one_command: bool,
    /// Of G and of M words, one each in a line.
    pub one_word_each: bool,
    /// M5 and M9 take effect behind the move of their line.
    pub stops_last: bool,
    /// Rapid moves are as fast as F says, like any other.
    pub rapids_at_feed: bool,
    /// `O1234` at the beginning is the program's number.
    pub program_numbers: bool,
    /// A number without a decimal point counts least increments on some machines: `X10` is 0.010 mm.
    pub least_increments: bool,
    /// The letter that repeats a drilling cycle.
    pub repeats: u8,
    /// Drilling cycles lift to where they began (G98) unless the program says otherwise.
    pub lifts_to_start: bool,
}

/// How a dialect's G4 says its time.
#[derive(Debug)]
pub struct DwellRules {
    /// What P counts.
    pub p: DwellUnit,
    /// Letters that count seconds instead of P.
    pub seconds: &'static [u8],
}

/// What P of G4 counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DwellUnit {
    /// Seconds.
    Seconds,
    /// Milliseconds.
    Milliseconds,
    /// Seconds with a decimal point, milliseconds without.
    ByPoint,
    /// Seconds, or milliseconds where the machine is set so.
    BySetting,
}

/// How a dialect reads arcs. (book: program/reading)
#[derive(Debug)]
pub struct ArcRules {
    /// How much the radius at the end may differ from that at the start.
    pub radius: RadiusTolerance,
    /// An axis word of the arc's plane has to be there even when its value does not change.
    pub axis_word: bool,
    /// By how many mm half the chord of an arc in R form may exceed the radius.
    pub short_radius: f64,
    /// P counts turns.
    pub turns: bool,
    /// A third coordinate (a helix) is the dialect's own.
    pub helix: bool,
}

/// How much the radius at the end of an arc may differ from that at its start, in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RadiusTolerance {
    /// In millimetres programs `mm`; in inch programs `inch` (in mm, too).
    Fixed {
        /// Tolerance where the program is in millimetres.
        mm: f64,
        /// Tolerance where it is in inches, in mm.
        inch: f64,
    },
    /// Never more than `most`, nor more than both `least` and this share of the radius.
    Relative {
        /// The most, in mm.
        most: f64,
        /// Less than this, in mm, is never too much.
        least: f64,
        /// The share of the radius.
        share: f64,
    },
}

/// What a feed mode word (G93, G94, G95) does to F.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FeedMode {
    /// F stays as it is.
    KeepsFeed,
    /// F is 0 until the next F, even when the mode does not change.
    ClearsFeed,
}

/// What a line of coordinates means before any motion word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StartMotion {
    /// A rapid move.
    Rapid,
    /// An error.
    None,
}

/// How much radii may differ on the NIST's interpreter, from which Mach3 comes.
const NIST_RADIUS: RadiusTolerance = RadiusTolerance::Fixed { mm: 0.002, inch: 0.0002 * 25.4 };
const GRBL_RADIUS: RadiusTolerance = RadiusTolerance::Relative { most: 0.5, least: 0.005, share: 0.001 };

const BASE_SPELLING: Spelling = Spelling {
    small_letters: true,
    round_comments: Style::Usual,
    nested_comments: false,
    semicolon_comments: Style::Unknown,
    slash_comments: Style::Unknown,
    bang_comments: Style::Unknown,
    blanks: Blanks::Ignored,
    percent: Percent::Frame,
    slash: Slash::Optional,
    line_length: None,
    block_numbers: Some(99_999),
    fractional_block_numbers: false,
    grammar: None,
    decimal_comma: false,
    formulas: false,
    bare_tool_number: false,
    real_time_bytes: false,
    active_comments: &[],
    message_codes: &[],
};

const BASE: Rules = Rules {
    dialect: Dialect::Rs274,
    spelling: BASE_SPELLING,
    words: &codes::RS274,
    arcs: ArcRules { radius: GRBL_RADIUS, axis_word: true, short_radius: 0.0, turns: false, helix: true },
    feed_mode: FeedMode::KeepsFeed,
    start_motion: StartMotion::Rapid,
    unit_words: [200, 210],
    layers: false,
    motion_is_stated: false,
    dwell: DwellRules { p: DwellUnit::Seconds, seconds: b"" },
    one_command: false,
    one_word_each: false,
    stops_last: false,
    rapids_at_feed: false,
    program_numbers: false,
    least_increments: false,
    repeats: b'L',
    lifts_to_start: false,
};

pub(super) static RS274: Rules = Rules {
    spelling: Spelling {
        line_length: Some(LineLength::Whole(256)),
        grammar: Some(Grammar {
            operators: Operators::Nist,
            names: false,
            signs: false,
            parameters: 5399,
            o_words: false,
        }),
        ..BASE_SPELLING
    },
    arcs: ArcRules { radius: NIST_RADIUS, ..BASE.arcs },
    start_motion: StartMotion::None,
    ..BASE
};

pub(super) static LINUXCNC: Rules = Rules {
    dialect: Dialect::LinuxCnc,
    spelling: Spelling {
        semicolon_comments: Style::Usual,
        line_length: Some(LineLength::Whole(255)),
        block_numbers: Some(u32::MAX),
        fractional_block_numbers: true,
        grammar: Some(Grammar {
            operators: Operators::LinuxCnc,
            names: true,
            signs: true,
            parameters: 5602,
            o_words: true,
        }),
        active_comments: OBEYED,
        ..BASE_SPELLING
    },
    words: &codes::LINUXCNC,
    arcs: ArcRules {
        radius: RadiusTolerance::Relative { most: 2.83, least: 0.0283, share: 0.001 },
        axis_word: false,
        short_radius: 0.001_27,
        turns: true,
        helix: true,
    },
    feed_mode: FeedMode::ClearsFeed,
    start_motion: StartMotion::None,
    ..BASE
};

pub(super) static GRBL: Rules = Rules {
    dialect: Dialect::Grbl,
    spelling: Spelling {
        nested_comments: true,
        semicolon_comments: Style::Usual,
        percent: Percent::Refused,
        slash: Slash::Dropped,
        line_length: Some(LineLength::Bare(79)),
        block_numbers: Some(10_000_000),
        real_time_bytes: true,
        ..BASE_SPELLING
    },
    words: &codes::GRBL,
    ..BASE
};

pub(super) static XPERTMILL: Rules = Rules {
    dialect: Dialect::Xpertmill,
    spelling: Spelling {
        round_comments: Style::Doubtful,
        nested_comments: true,
        semicolon_comments: Style::Doubtful,
        slash_comments: Style::Usual,
        bang_comments: Style::Usual,
        blanks: Blanks::Separate,
        percent: Percent::Start,
        slash: Slash::Unknown,
        block_numbers: None,
        decimal_comma: true,
        bare_tool_number: true,
        ..BASE_SPELLING
    },
    words: &codes::XPERTMILL,
    arcs: ArcRules { axis_word: false, helix: false, ..BASE.arcs },
    unit_words: [700, 710],
    layers: true,
    motion_is_stated: true,
    ..BASE
};

pub(super) static NATIVE: Rules = Rules {
    dialect: Dialect::Native,
    spelling: Spelling {
        nested_comments: true,
        semicolon_comments: Style::Usual,
        block_numbers: Some(10_000_000),
        formulas: true,
        active_comments: OBEYED,
        ..BASE_SPELLING
    },
    words: &codes::NATIVE,
    ..BASE
};

pub(super) static MACH3: Rules = Rules {
    dialect: Dialect::Mach3,
    words: &codes::MACH3,
    arcs: ArcRules { radius: NIST_RADIUS, axis_word: false, ..BASE.arcs },
    dwell: DwellRules { p: DwellUnit::BySetting, seconds: b"" },
    program_numbers: true,
    lifts_to_start: true,
    ..BASE
};

/// What Fanuc and Haas have in common.
const ISO: Rules = Rules {
    arcs: ArcRules { radius: RadiusTolerance::Fixed { mm: 0.02, inch: 0.02 }, axis_word: false, ..BASE.arcs },
    start_motion: StartMotion::None,
    program_numbers: true,
    least_increments: true,
    lifts_to_start: true,
    ..BASE
};

pub(super) static FANUC: Rules = Rules {
    dialect: Dialect::Fanuc,
    words: &codes::FANUC,
    dwell: DwellRules { p: DwellUnit::Milliseconds, seconds: b"X" },
    repeats: b'K',
    ..ISO
};

pub(super) static HAAS: Rules = Rules {
    dialect: Dialect::Haas,
    words: &codes::HAAS,
    dwell: DwellRules { p: DwellUnit::ByPoint, seconds: b"" },
    ..ISO
};

pub(super) static MARLIN: Rules = Rules {
    dialect: Dialect::Marlin,
    spelling: Spelling {
        small_letters: false,
        round_comments: Style::Unknown,
        semicolon_comments: Style::Usual,
        percent: Percent::Refused,
        slash: Slash::Unknown,
        line_length: Some(LineLength::Whole(96)),
        block_numbers: Some(u32::MAX),
        message_codes: &[0, 1, 117, 118],
        ..BASE_SPELLING
    },
    words: &codes::MARLIN,
    arcs: ArcRules { axis_word: false, turns: true, ..BASE.arcs },
    start_motion: StartMotion::None,
    motion_is_stated: true,
    dwell: DwellRules { p: DwellUnit::Milliseconds, seconds: b"S" },
    one_command: true,
    rapids_at_feed: true,
    ..BASE
};

pub(super) static ESTLCAM: Rules = Rules {
    dialect: Dialect::Estlcam,
    spelling: Spelling {
        semicolon_comments: Style::Usual,
        percent: Percent::Refused,
        slash: Slash::Unknown,
        ..BASE_SPELLING
    },
    words: &codes::ESTLCAM,
    arcs: ArcRules { axis_word: false, ..BASE.arcs },
    start_motion: StartMotion::None,
    motion_is_stated: true,
    one_word_each: true,
    ..BASE
};

pub(super) static DIN: Rules = Rules {
    dialect: Dialect::Din,
    spelling: Spelling { percent: Percent::Title, block_numbers: Some(99_999_999), ..BASE_SPELLING },
    words: &codes::DIN,
    start_motion: StartMotion::None,
    unit_words: [700, 710],
    dwell: DwellRules { p: DwellUnit::Seconds, seconds: b"X" },
    program_numbers: false,
    least_increments: false,
    stops_last: true,
    ..ISO
};
