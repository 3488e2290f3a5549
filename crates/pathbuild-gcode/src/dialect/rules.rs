//! The rules of each dialect.

use pathbuild_motion::{MAX_RADIUS_DIFFERENCE_INCHES, MAX_RADIUS_DIFFERENCE_MM};

use super::Dialect;
use super::codes::{self, Words};

/// All properties in which dialects differ.
#[derive(Debug)]
#[expect(clippy::struct_excessive_bools, reason = "independent facts, not states")]
pub struct Rules {
    /// The dialect that these rules describe.
    pub dialect: Dialect,
    /// Spelling of words and comments.
    pub spelling: Spelling,
    /// The words that the dialect accepts.
    pub words: &'static Words,
    /// Rules for reading arcs.
    pub arcs: ArcRules,
    /// The effect of G93, G94 and G95 on the previous feed.
    pub feed_mode: FeedMode,
    /// The meaning of coordinates before the first motion word.
    pub start_motion: StartMotion,
    /// The words that switch to inches and to millimetres (G codes times ten).
    pub unit_words: [u16; 2],
    /// G codes (times ten) that switch to inches and to millimetres besides `unit_words`.
    pub unit_synonyms: Option<[u16; 2]>,
    /// The effect of a change of the unit on lengths stated before it.
    pub units: UnitChange,
    /// Whether M6 selects a layer, to which the moves and the S after it belong.
    pub layers: bool,
    /// Whether a motion word applies only to its own line. A line that has coordinates but no motion word repeats the last motion, with a warning.
    pub motion_is_stated: bool,
    /// Rules for the time of G4.
    pub dwell: DwellRules,
    /// Whether the control obeys only the first G, M or T word of a line, which must be its first word. All other words are values of that command.
    pub one_command: bool,
    /// Whether a line may have only one G and one M word.
    pub one_word_each: bool,
    /// Number of M codes that a line may have.
    pub m_limit: MCodeLimit,
    /// Whether M0 and M1 also switch spindle and coolant off, which then stay off.
    pub stop_is_complete: bool,
    /// Whether the control runs the lines after M2 and M30, because it has no program memory and takes each line as it is sent.
    pub runs_past_end: bool,
    /// Rules for words that reference the machine.
    pub reference: ReferenceRules,
    /// Words that only controls built with a special setting obey; all other controls ignore them.
    pub unusual: OptionalWords,
    /// Whether G53 counts from the machine's zero even with G91. Other controls refuse G53 with G91.
    pub absolute_machine_coordinates: bool,
    /// Whether rapid moves are straight. Otherwise each axis moves at its own speed, and an axis with less distance to cover arrives early.
    pub straight_rapids: bool,
    /// When the M codes for the spindle and the coolant take effect: before or after the move in their line.
    pub m_order: MCodeOrder,
    /// Whether the control or the operator changes the tool at M6.
    pub changer: ToolChanger,
    /// Whether most machines with this control have neither a tool changer nor stored tool lengths: the operator changes the tool and sets Z again.
    pub manual_changes: bool,
    /// Whether T alone is known to change no tool, so that the operator must change it where a program has no M6.
    pub t_only_selects: bool,
    /// Whether rapid moves use the feed F, as all other moves do.
    pub rapids_at_feed: bool,
    /// Whether `O1234` at the beginning of a file is the program number.
    pub program_numbers: bool,
    /// Whether a number without a decimal point counts least increments on some machines, so that `X10` is 0.010 mm.
    pub least_increments: bool,
    /// Whether the control stores H and D, so that both may accompany any word for the tool length.
    pub keeps_offsets: bool,
    /// Whether G10 needs an axis word.
    pub offsets_need_axis: bool,
    /// The letter of the word for the number of repetitions of a drilling cycle.
    pub repeats: u8,
    /// Whether a line of a drilling cycle with 0 repetitions drills nothing: it stores the cycle for the lines after it, and moves to its X and Y.
    pub stores_cycles: bool,
    /// Rules by which P selects coordinate systems besides G54 to G59; `None` if P does not select any.
    pub systems: Option<SystemNumbers>,
    /// Whether P of G30 selects the reference point by its number, counted from 2.
    pub numbers_references: bool,
    /// Whether the control refuses lines that the interpreter of RS274/NGC refuses: G53 that moves nothing unless G0 or G1 is in its line, a motion
    /// word beside G10, G28, G30, G52 or G92 even without coordinates, and P or Q that the drilling cycle does not use.
    pub refuses_idle_words: bool,
    /// Whether a drilling cycle that begins below R first rises to it and then goes to the hole, as in RS274/NGC, 3.5.16.1.
    pub rises_before_holes: bool,
    /// Whether a hole with G98 is approached at the initial height even after holes with G99, so that the tool rises on a slant. Other controls move
    /// in the plane at the current height.
    pub rises_on_way_to_holes: bool,
    /// Whether a program must state whether holes retract to the initial height (G98) or to R (G99), because the control keeps the mode of the
    /// previous program.
    pub keeps_retract_mode: bool,
    /// Whether G80 is allowed on a line with a motion word, which then applies.
    pub ends_cycles_beside_motion: bool,
    /// Whether drilling cycles and G80 are a modal group of their own, so that G80 restores the motion that was in effect before the cycle.
    pub cycles_are_apart: bool,
    /// Rules for the tool length in effect where the program does not set one.
    pub lengths: LengthRules,
}

/// The moment at which M codes for the spindle and the coolant take effect, relative to the move in their line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MCodeOrder {
    /// The M codes take effect before the move.
    First,
    /// M5 and M9 take effect after the move, the others before it.
    StopsLast,
    /// The M codes take effect after the move.
    Last,
}

/// The number of M codes that a line may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MCodeLimit {
    /// Any number.
    Unlimited,
    /// One on older controls, which ignore further M codes.
    OneOnSome,
    /// One: the control refuses lines with more.
    One,
}

/// The effect of a change of the unit on F, G52 and G92.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnitChange {
    /// The values keep their lengths: the control stores them in a unit of its own, or converts them.
    Converts,
    /// The values keep their numbers, or the effect is not known.
    Unknown,
    /// The control refuses any unit other than the one that it is set to.
    Refused,
}

/// Whether the control or the operator changes the tool at M6.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ToolChanger {
    /// The machine, which raises the tool above everything.
    Machine,
    /// The operator, who may set the zero as well.
    Operator,
    /// One or the other: the operator may change the tool where it is.
    Either,
}

/// Rules for the tool length that a control retains from earlier lines and programs.
#[derive(Clone, Copy, Debug)]
pub struct LengthRules {
    /// Whether G43 without H uses the last H, even one of the previous program; otherwise it uses the number of the tool in the spindle.
    pub keeps_entry: bool,
    /// Whether the length set by the previous program remains in effect until this program sets one.
    pub keeps_length: bool,
}

/// Rules for words that reference the machine, that is, move it to its reference switches.
#[derive(Debug)]
pub struct ReferenceRules {
    /// G codes (times ten) that move axes to their reference switches.
    pub g: &'static [u16],
    /// Whether the control afterwards measures coordinates from the switches and no longer from the workpiece zero.
    pub loses_zero: bool,
}

/// Words that a control supports only if it was built with a special setting.
#[derive(Debug)]
pub struct OptionalWords {
    /// G codes (times ten) that need a special setting.
    pub g: &'static [u16],
    /// Whether the number of turns of an arc (P) needs a special setting too.
    pub turns: bool,
}

/// Rules by which P numbers coordinate systems besides G54 to G59.
#[derive(Debug)]
pub struct SystemNumbers {
    /// G code, times ten, with which P selects a system.
    pub code: u16,
    /// Number of values of P, from 1, that select G54 and the systems after it.
    pub regular: u32,
    /// Maximum value of P.
    pub most: u32,
}

/// Rules for the time of a dwell (G4).
#[derive(Debug)]
pub struct DwellRules {
    /// Unit of the time in P.
    pub p: DwellUnit,
    /// Letters other than P that specify seconds.
    pub seconds: &'static [u8],
    /// Whether S gives the length of the dwell in turns of the spindle.
    pub counts_turns: bool,
}

/// Unit of the time P in G4.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DwellUnit {
    /// Seconds.
    Seconds,
    /// Milliseconds.
    Milliseconds,
    /// Seconds with a decimal point, milliseconds without it.
    ByPoint,
    /// Seconds or milliseconds, depending on a setting of the machine.
    BySetting,
}

/// Rules by which a dialect reads arcs. (book: program/reading)
#[derive(Debug)]
#[expect(clippy::struct_excessive_bools, reason = "independent facts, not states")]
pub struct ArcRules {
    /// Permitted difference between the radii at both ends of an arc.
    pub radius: RadiusTolerance,
    /// Whether an axis word in the plane of the arc is required even if its value does not change.
    pub axis_word: bool,
    /// Amount in mm by which half the chord of an arc given by R may exceed R.
    pub short_radius: f64,
    /// Whether P is the number of turns.
    pub turns: bool,
    /// Whether a third coordinate (a helix) is supported.
    pub helix: bool,
    /// Whether the centre word of the third axis is ignored, as K in the XY plane.
    pub ignores_third_centre: bool,
    /// Whether a setting of the control says what I and J count from, unless the program does (G90.1, G91.1).
    pub centres_by_setting: bool,
}

/// Permitted difference of the radii at both ends of an arc, in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RadiusTolerance {
    /// One tolerance for programs in millimetres and another for programs in inches.
    Fixed {
        /// Tolerance for programs in millimetres.
        mm: f64,
        /// Tolerance in mm for programs in inches.
        inch: f64,
    },
    /// The greater of `least` and the given share of the radius, but at most `most`.
    Relative {
        /// Upper limit in mm.
        most: f64,
        /// Differences below this, in mm, are always permitted.
        least: f64,
        /// Permitted difference as a share of the radius.
        share: f64,
    },
}

/// The effect of a feed mode word (G93, G94, G95) on F.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FeedMode {
    /// F keeps its value.
    KeepsFeed,
    /// F is 0 until the next F, even if the mode does not change.
    ClearsFeed,
}

/// The meaning of coordinates before the first motion word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StartMotion {
    /// Coordinates are a rapid move.
    Rapid,
    /// Coordinates are an error.
    None,
}

/// Permitted difference of radii in the NIST interpreter, from which Mach3 is derived.
const NIST_RADIUS: RadiusTolerance =
    RadiusTolerance::Fixed { mm: MAX_RADIUS_DIFFERENCE_MM, inch: MAX_RADIUS_DIFFERENCE_INCHES * 25.4 };
const GRBL_RADIUS: RadiusTolerance = RadiusTolerance::Relative { most: 0.5, least: 0.005, share: 0.001 };

const BASE_SPELLING: Spelling = Spelling {
    small_letters: true,
    round_comments: NotationSupport::Usual,
    nested_comments: false,
    semicolon_comments: NotationSupport::Unknown,
    slash_comments: NotationSupport::Unknown,
    bang_comments: NotationSupport::Unknown,
    blanks: Blanks::Ignored,
    percent: Percent::Frame,
    slash: Slash::Optional,
    slash_numbers: false,
    line_length: None,
    block_numbers: Some(99_999),
    fractional_block_numbers: false,
    checksums: false,
    grammar: None,
    macros: false,
    decimal_comma: false,
    formulas: false,
    bare_tool_number: false,
    real_time_bytes: false,
    active_comments: &[],
    message_codes: &[],
    flags: false,
};

const BASE: Rules = Rules {
    dialect: Dialect::Rs274,
    spelling: BASE_SPELLING,
    words: &codes::RS274,
    arcs: ArcRules {
        radius: GRBL_RADIUS,
        axis_word: true,
        short_radius: 0.0,
        turns: false,
        helix: true,
        ignores_third_centre: false,
        centres_by_setting: false,
    },
    feed_mode: FeedMode::KeepsFeed,
    start_motion: StartMotion::Rapid,
    unit_words: [200, 210],
    unit_synonyms: None,
    units: UnitChange::Unknown,
    layers: false,
    motion_is_stated: false,
    dwell: DwellRules { p: DwellUnit::Seconds, seconds: b"", counts_turns: false },
    one_command: false,
    one_word_each: false,
    m_limit: MCodeLimit::Unlimited,
    stop_is_complete: false,
    runs_past_end: false,
    reference: ReferenceRules { g: &[], loses_zero: false },
    unusual: OptionalWords { g: &[], turns: false },
    absolute_machine_coordinates: false,
    straight_rapids: true,
    m_order: MCodeOrder::First,
    changer: ToolChanger::Either,
    manual_changes: false,
    t_only_selects: false,
    rapids_at_feed: false,
    program_numbers: false,
    least_increments: false,
    keeps_offsets: false,
    offsets_need_axis: false,
    repeats: b'L',
    stores_cycles: false,
    systems: None,
    numbers_references: false,
    refuses_idle_words: false,
    rises_before_holes: true,
    // interp_cycles.cc of LinuxCNC traverses to X and Y at `old_cc`, which with G98 is the height before the series.
    rises_on_way_to_holes: true,
    keeps_retract_mode: false,
    ends_cycles_beside_motion: false,
    cycles_are_apart: false,
    lengths: LengthRules { keeps_entry: false, keeps_length: false },
};

/// Rules of RS274, and of the controls that follow it, for retaining tool lengths.
const RS274_LENGTHS: LengthRules = LengthRules { keeps_entry: false, keeps_length: true };

pub(super) static RS274: Rules = Rules {
    spelling: Spelling {
        line_length: Some(LineLength::Whole(256)),
        grammar: Some(Grammar {
            operators: Operators::Nist,
            has_names: false,
            has_signs: false,
            parameters: 5399,
            o_words: false,
        }),
        ..BASE_SPELLING
    },
    arcs: ArcRules { radius: NIST_RADIUS, ..BASE.arcs },
    start_motion: StartMotion::None,
    refuses_idle_words: true,
    lengths: RS274_LENGTHS,
    ..BASE
};

pub(super) static LINUXCNC: Rules = Rules {
    dialect: Dialect::LinuxCnc,
    t_only_selects: true,
    spelling: Spelling {
        semicolon_comments: NotationSupport::Usual,
        line_length: Some(LineLength::Whole(255)),
        block_numbers: Some(u32::MAX),
        fractional_block_numbers: true,
        grammar: Some(Grammar {
            operators: Operators::LinuxCnc,
            has_names: true,
            has_signs: true,
            parameters: 5602,
            o_words: true,
        }),
        active_comments: OBEYED_COMMENTS,
        ..BASE_SPELLING
    },
    // interp_convert.cc, convert_length_units: G92 is converted; the feed was passed on in mm/min when F was read.
    units: UnitChange::Converts,
    words: &codes::LINUXCNC,
    arcs: ArcRules {
        radius: RadiusTolerance::Relative { most: 2.83, least: 0.0283, share: 0.001 },
        axis_word: false,
        short_radius: 0.001_27,
        turns: true,
        helix: true,
        ignores_third_centre: false,
        centres_by_setting: false,
    },
    feed_mode: FeedMode::ClearsFeed,
    start_motion: StartMotion::None,
    refuses_idle_words: true,
    lengths: RS274_LENGTHS,
    ..BASE
};

pub(super) static GRBL: Rules = Rules {
    dialect: Dialect::Grbl,
    manual_changes: true,
    t_only_selects: true,
    spelling: Spelling {
        nested_comments: true,
        semicolon_comments: NotationSupport::Usual,
        percent: Percent::Refused,
        slash: Slash::Dropped,
        line_length: Some(LineLength::Bare(79)),
        block_numbers: Some(10_000_000),
        real_time_bytes: true,
        ..BASE_SPELLING
    },
    // gcode.c: "Always store feed rate in mm/min" when F is read, "Push last state feed rate" otherwise; G92 is stored in mm.
    units: UnitChange::Converts,
    words: &codes::GRBL,
    // gcode.c: "bit_false(value_words,(bit(WORD_I)|bit(WORD_J)|bit(WORD_K)))". FreeCAD's grbl_post writes `K0.000` in every arc.
    arcs: ArcRules { ignores_third_centre: true, ..BASE.arcs },
    lengths: RS274_LENGTHS,
    // gcode.c, M2 and M30: "gc_state.modal.program_flow = PROGRAM_FLOW_RUNNING; // Reset program flow."
    runs_past_end: true,
    // gcode.c, G10: "if (!axis_words) { FAIL(STATUS_GCODE_NO_AXIS_WORDS) }; // [No axis words]".
    offsets_need_axis: true,
    // From memory of gcode.c: "Update specified value according to distance mode or ignore if absolute override is active."
    absolute_machine_coordinates: true,
    ..BASE
};

pub(super) static XPERTMILL: Rules = Rules {
    dialect: Dialect::Xpertmill,
    spelling: Spelling {
        round_comments: NotationSupport::Doubtful,
        nested_comments: true,
        semicolon_comments: NotationSupport::Doubtful,
        slash_comments: NotationSupport::Usual,
        bang_comments: NotationSupport::Doubtful,
        blanks: Blanks::Separate,
        percent: Percent::Start,
        slash: Slash::Unknown,
        block_numbers: None,
        decimal_comma: true,
        bare_tool_number: true,
        small_letters: false,
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
        semicolon_comments: NotationSupport::Usual,
        block_numbers: Some(10_000_000),
        formulas: true,
        active_comments: OBEYED_COMMENTS,
        ..BASE_SPELLING
    },
    words: &codes::NATIVE,
    lengths: RS274_LENGTHS,
    ..BASE
};

pub(super) static MACH3: Rules = Rules {
    dialect: Dialect::Mach3,
    t_only_selects: true,
    // From memory of "Using Mach3Mill": parameters and expressions are those of RS274/NGC, with 10320 parameters. O numbers a subprogram.
    spelling: Spelling {
        grammar: Some(Grammar {
            operators: Operators::Nist,
            has_names: false,
            has_signs: false,
            parameters: 10_320,
            o_words: false,
        }),
        ..BASE_SPELLING
    },
    words: &codes::MACH3,
    // Using Mach3Mill, "Reference axes G28.1": "The axes will move at the current feed rate towards the home switch(es)".
    reference: ReferenceRules { g: &[281], loses_zero: false },
    // Mach3's General Config, "IJ Mode": absolute or inc.
    arcs: ArcRules { radius: NIST_RADIUS, axis_word: false, centres_by_setting: true, ..BASE.arcs },
    dwell: DwellRules { p: DwellUnit::BySetting, seconds: b"", counts_turns: false },
    program_numbers: true,
    keeps_offsets: true,
    // From memory of "Using Mach3Mill", as in RS274/NGC: "a straight traverse parallel to the XY-plane to the given XY-position".
    rises_on_way_to_holes: false,
    keeps_retract_mode: true,
    // From memory of "Using Mach3Mill": G59 P1 to P253 select a system; P1 to P6 are G54 to G59.
    systems: Some(SystemNumbers { code: 590, regular: 6, most: 253 }),
    // Vectric's post for Mach3 begins programs with `G00G21G17G90G40G49G80` and `G71G91.1`.
    unit_synonyms: Some([700, 710]),
    ends_cycles_beside_motion: true,
    ..BASE
};

/// Common rules of Fanuc, Haas and DIN 66025.
const ISO: Rules = Rules {
    arcs: ArcRules { radius: RadiusTolerance::Fixed { mm: 0.02, inch: 0.02 }, axis_word: false, ..BASE.arcs },
    start_motion: StartMotion::None,
    program_numbers: true,
    least_increments: true,
    keeps_offsets: true,
    // From memory of the operator's manual: operation 1 of a canned cycle is the positioning of X and Y, operation 2 the rapid move to R, and the
    // return to the initial height (G98) comes after the hole.
    rises_before_holes: false,
    rises_on_way_to_holes: false,
    keeps_retract_mode: true,
    // G80 is in a modal group of its own (09), so its line may contain another motion word.
    ends_cycles_beside_motion: true,
    cycles_are_apart: true,
    lengths: LengthRules { keeps_entry: true, keeps_length: false },
    ..BASE
};

pub(super) static FANUC: Rules = Rules {
    dialect: Dialect::Fanuc,
    // From memory of the operator's manual: `/1` to `/9` are block skips, each with its own switch; the control has Custom Macro B.
    spelling: Spelling { slash_numbers: true, macros: true, ..BASE_SPELLING },
    words: &codes::FANUC,
    dwell: DwellRules { p: DwellUnit::Milliseconds, seconds: b"X", counts_turns: false },
    repeats: b'K',
    // From memory of the operator's manual: with K0 the drilling data are stored, and nothing is drilled.
    stores_cycles: true,
    // From memory: G54.1 P1 to P48, or P300 with an option; G30 P2, P3 and P4 are the second to fourth reference points.
    systems: Some(SystemNumbers { code: 541, regular: 0, most: 247 }),
    numbers_references: true,
    // From memory: up to three M codes with parameter 3404#7 (M3B), otherwise one.
    m_limit: MCodeLimit::OneOnSome,
    // Parameter 1401#1 (LRP) is 0 by default: positioning is not linear.
    straight_rapids: false,
    changer: ToolChanger::Machine,
    ..ISO
};

pub(super) static HAAS: Rules = Rules {
    dialect: Dialect::Haas,
    t_only_selects: true,
    spelling: Spelling { macros: true, ..BASE_SPELLING },
    // From memory of the operator's manual: G20 and G21 only check Setting 9, and alarm if it differs.
    units: UnitChange::Refused,
    words: &codes::HAAS,
    dwell: DwellRules { p: DwellUnit::ByPoint, seconds: b"", counts_turns: false },
    // Haas Mill Operator's Manual, M00: "It stops the axes, spindle, and turns off the coolant".
    stop_is_complete: true,
    // Haas Mill Operator's Manual, M codes: "All M-codes take effect at the end of the block."
    m_order: MCodeOrder::Last,
    // Haas Mill Operator's Manual, M codes: "Only one M-code is allowed per line of code."
    m_limit: MCodeLimit::One,
    // Haas Mill Operator's Manual, program O60811: `X5.5 L0` between holes avoids a corner. From memory: without X and Y, L0 defines a cycle.
    stores_cycles: true,
    // From memory of the operator's manual: G154 P1 to P99 selects work coordinates.
    systems: Some(SystemNumbers { code: 1540, regular: 0, most: 99 }),
    // Haas Mill Operator's Manual, G00: "Generally, rapid motion will not be in a single straight line."
    straight_rapids: false,
    changer: ToolChanger::Machine,
    ..ISO
};

pub(super) static MARLIN: Rules = Rules {
    dialect: Dialect::Marlin,
    manual_changes: true,
    spelling: Spelling {
        small_letters: false,
        round_comments: NotationSupport::Unknown,
        semicolon_comments: NotationSupport::Usual,
        // Marlin's parser.h, value_float: a number ends at a blank. Its parser.cpp skips blanks between a letter and its number.
        blanks: Blanks::EndNumbers,
        percent: Percent::Refused,
        slash: Slash::Unknown,
        // Marlin's queue.cpp, process_stream_char: what follows `;` is dropped while the line is received.
        line_length: Some(LineLength::BeforeSemicolon(96)),
        block_numbers: Some(u32::MAX),
        // Marlin's queue.cpp: "No Checksum with line number", unless the file is on the SD card.
        checksums: true,
        message_codes: &[0, 1, 117, 118],
        flags: true,
        ..BASE_SPELLING
    },
    // G0_G1 stores F as mm/s, and position shifts are in mm.
    units: UnitChange::Converts,
    words: &codes::MARLIN,
    // G28 sets the position to the position of the switches, and the shift by G92 to 0 (set_axis_is_at_home).
    reference: ReferenceRules { g: &[280], loses_zero: true },
    // Options that Configuration_adv.h leaves off: `//#define INCH_MODE_SUPPORT`, `//#define CNC_WORKSPACE_PLANES`, `//#define ARC_P_CIRCLES`.
    unusual: OptionalWords { g: &[180, 190, 200], turns: true },
    arcs: ArcRules { axis_word: false, turns: true, ..BASE.arcs },
    start_motion: StartMotion::None,
    motion_is_stated: true,
    dwell: DwellRules { p: DwellUnit::Milliseconds, seconds: b"S", counts_turns: false },
    one_command: true,
    rapids_at_feed: true,
    ..BASE
};

pub(super) static ESTLCAM: Rules = Rules {
    dialect: Dialect::Estlcam,
    spelling: Spelling {
        semicolon_comments: NotationSupport::Usual,
        percent: Percent::Refused,
        slash: Slash::Unknown,
        ..BASE_SPELLING
    },
    words: &codes::ESTLCAM,
    arcs: ArcRules { axis_word: false, ..BASE.arcs },
    start_motion: StartMotion::None,
    motion_is_stated: true,
    one_word_each: true,
    changer: ToolChanger::Operator,
    manual_changes: true,
    ..BASE
};

pub(super) static DIN: Rules = Rules {
    dialect: Dialect::Din,
    spelling: Spelling { percent: Percent::Title, block_numbers: Some(99_999_999), ..BASE_SPELLING },
    words: &codes::DIN,
    start_motion: StartMotion::None,
    unit_words: [700, 710],
    // Controls for DIN 66025 take F or X for seconds and S for turns of the main spindle: Beckhoff TF5100, "Dwell Time (G04)", and TF5200,
    // "Dwell time (G04), (#TIME)".
    dwell: DwellRules { p: DwellUnit::Seconds, seconds: b"XF", counts_turns: true },
    program_numbers: false,
    least_increments: false,
    keeps_retract_mode: false,
    m_order: MCodeOrder::StopsLast,
    ..ISO
};

/// The lexical rules of a dialect.
#[derive(Debug)]
#[expect(clippy::struct_excessive_bools, reason = "independent facts, not states")]
pub struct Spelling {
    /// Whether words may have lower-case letters.
    pub small_letters: bool,
    /// Support for comments in `( )`.
    pub round_comments: NotationSupport,
    /// Whether `(` within a round comment is an ordinary character; otherwise it is an error.
    pub nested_comments: bool,
    /// Support for comments from `;` to the end of the line.
    pub semicolon_comments: NotationSupport,
    /// Support for comments from `//` to the end of the line.
    pub slash_comments: NotationSupport,
    /// Support for comments from `!` to the end of the line.
    pub bang_comments: NotationSupport,
    /// Whether blanks separate words or are ignored.
    pub blanks: Blanks,
    /// Meaning of a line that begins with `%`.
    pub percent: Percent,
    /// Meaning of `/` at the beginning of a line.
    pub slash: Slash,
    /// Whether a digit after `/` at the beginning of a line numbers the switch, as in `/2 G0 Z5.`.
    pub slash_numbers: bool,
    /// Maximum length of a line; `None` if the dialect has none.
    pub line_length: Option<LineLength>,
    /// Largest block number N; `None` if there are no block numbers.
    pub block_numbers: Option<u32>,
    /// Whether block numbers may have decimals.
    pub fractional_block_numbers: bool,
    /// Whether hosts append `*` and a checksum to lines that have a block number.
    pub checksums: bool,
    /// The syntax of `[ ]` and `#`, if they are supported.
    pub grammar: Option<Grammar>,
    /// Whether the control has macros (`#1=0`, `IF[#1LT3]GOTO10`), which are reported and not executed.
    pub macros: bool,
    /// Whether numbers may have a decimal comma, which causes a warning.
    pub decimal_comma: bool,
    /// Whether `(=...)` after a number is its correction formula. (book: language/probes)
    pub formulas: bool,
    /// Whether a number without a letter after M6 is the tool number.
    pub bare_tool_number: bool,
    /// Whether the control takes `!`, `?`, `~`, 0x18 and all bytes above 127 out of the text, even inside comments. It acts on many of them at once
    /// and discards the others.
    pub real_time_bytes: bool,
    /// Beginnings of comments that the control obeys: it writes files, runs programs or stops.
    pub active_comments: &'static [&'static str],
    /// M codes after which the rest of the line, except for S and P, is a message for the operator.
    pub message_codes: &'static [u16],
    /// Whether letters after G28 and M words may have no number, as in `G28 X Y` and `M84 Z`.
    pub flags: bool,
}

/// Degree to which a dialect supports a notation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NotationSupport {
    /// The dialect supports the notation.
    Usual,
    /// The notation is read with a warning, because the dialect is not known to support it.
    Doubtful,
    /// The dialect does not support the notation.
    Unknown,
}

/// Meaning of blanks between words and within numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Blanks {
    /// Blanks are ignored, even inside a number: `X1 2` is X12.
    Ignored,
    /// A blank ends a number, but may precede it: `X1 2` is X1 and 2, `X 1` is X1.
    EndNumbers,
    /// Blanks separate words: `M06 05` is M6 and 5.
    Separate,
}

/// Meaning of a line that begins with `%`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Percent {
    /// The first `%` begins the program, the second one ends it.
    Frame,
    /// `%` begins the program.
    Start,
    /// The first `%` begins the program, even after a block number, and the rest of its line is the name of the program; the second one ends it.
    Title,
    /// The control rejects `%`.
    Refused,
}

/// Meaning of `/` at the beginning of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slash {
    /// A switch on the machine decides whether the line is executed.
    Optional,
    /// The `/` is discarded, and the line is executed.
    Dropped,
    /// `/` is not supported.
    Unknown,
}

/// Maximum length of a line, in bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LineLength {
    /// Limits the whole line in the file, except for its line break.
    Whole(usize),
    /// Limits the part in front of the first `;`.
    BeforeSemicolon(usize),
    /// Limits the line without its blanks and comments, see [`Self::bare`].
    Bare(usize),
}

impl LineLength {
    /// Returns the length of the part of a line in front of the first `;`.
    pub fn before_semicolon(line: &[u8]) -> usize {
        memchr::memchr(b';', line).unwrap_or(line.len())
    }

    /// Returns the number of characters of a line that GRBL stores: it drops blanks, `/`, comments in `( )` and what follows `;`.
    pub fn bare(line: &[u8]) -> usize {
        let (mut count, mut is_comment) = (0, false);
        for byte in line {
            match byte {
                b')' if is_comment => is_comment = false,
                _ if is_comment => {}
                b'(' => is_comment = true,
                b';' => break,
                b'\0'..=b' ' | b'/' => {}
                _ => count += 1,
            }
        }
        count
    }
}

/// The syntax of expressions and parameters, which may replace numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Grammar {
    /// The operators and their precedence.
    pub operators: Operators,
    /// Whether there are named parameters, as in `#<name>`.
    pub has_names: bool,
    /// Whether a sign may precede `[`, `#` or a function.
    pub has_signs: bool,
    /// Largest number of a parameter; the smallest is 1.
    pub parameters: u32,
    /// Whether there are O words (subroutines, branches).
    pub o_words: bool,
}

/// The precedence of operators, listed from those that bind tightest. All are left-associative.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operators {
    /// `**`, then `* / MOD`, then `+ - AND OR XOR`.
    Nist,
    /// `**`, then `* / MOD`, then `+ -`, then comparisons, then `AND OR XOR`.
    LinuxCnc,
}

/// First words of comments that LinuxCNC acts on: it writes files, runs programs or stops. A comma is included if the word only has an effect with
/// it.
pub(super) const OBEYED_COMMENTS: &[&str] = &[
    "LOG,",
    "LOGOPEN,",
    "LOGAPPEND,",
    "LOGCLOSE",
    "PROBEOPEN",
    "PROBECLOSE",
    "PY,",
    "PYRUN,",
    "PYRELOAD",
    "ABORT,",
];
