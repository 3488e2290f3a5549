//! The differences between controls: spelling, words, arcs, order. (book: program/reading)
//!
//! A dialect is data, described by its [`Rules`]. Reader and interpreter only look at the rules, never at the dialect itself.

mod codes;
mod comment;
mod rules;

use std::fmt;
use std::str::FromStr;

pub use codes::{Acceptance, Letters, Words};
pub(crate) use comment::beginning_of;
pub use comment::{Charset, ascii, is_active_comment, within_comment};
pub use rules::{
    ArcRules, Blanks, DwellRules, DwellUnit, FeedMode, Grammar, LineLength, Operators, Percent,
    RadiusTolerance, Rules, Slash, Spelling, StartMotion, Style,
};

/// The supported kinds of G-code.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, serde::Serialize, serde::Deserialize)]
pub enum Dialect {
    /// RS274/NGC version 3 of the NIST, the common ancestor.
    Rs274,
    /// LinuxCNC 2.9.
    LinuxCnc,
    /// GRBL 1.1.
    Grbl,
    /// The import filter of XpertMILL (STEP-FOUR).
    Xpertmill,
    /// Mach3 and Mach4, for milling.
    Mach3,
    /// Fanuc and similar controls, for milling.
    Fanuc,
    /// Haas mills.
    Haas,
    /// Marlin 2 on a milling machine.
    Marlin,
    /// The CNC controller of Estlcam.
    Estlcam,
    /// DIN 66025, as in the CAD6 manual.
    Din,
    /// The output of pathbuild and its predecessor (book: program/gcode), with correction formulas as data (book: language/probes).
    Native,
}

impl Dialect {
    /// All dialects, in listing order.
    pub const ALL: &[Self] = &[
        Self::Native,
        Self::Rs274,
        Self::LinuxCnc,
        Self::Grbl,
        Self::Xpertmill,
        Self::Mach3,
        Self::Fanuc,
        Self::Haas,
        Self::Marlin,
        Self::Estlcam,
        Self::Din,
    ];

    /// Name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rs274 => "rs274",
            Self::LinuxCnc => "linuxcnc",
            Self::Grbl => "grbl",
            Self::Xpertmill => "xpertmill",
            Self::Mach3 => "mach3",
            Self::Fanuc => "fanuc",
            Self::Haas => "haas",
            Self::Marlin => "marlin",
            Self::Estlcam => "estlcam",
            Self::Din => "din",
            Self::Native => "native",
        }
    }

    /// The rules of the dialect.
    pub fn rules(self) -> &'static Rules {
        match self {
            Self::Rs274 => &rules::RS274,
            Self::LinuxCnc => &rules::LINUXCNC,
            Self::Grbl => &rules::GRBL,
            Self::Xpertmill => &rules::XPERTMILL,
            Self::Mach3 => &rules::MACH3,
            Self::Fanuc => &rules::FANUC,
            Self::Haas => &rules::HAAS,
            Self::Marlin => &rules::MARLIN,
            Self::Estlcam => &rules::ESTLCAM,
            Self::Din => &rules::DIN,
            Self::Native => &rules::NATIVE,
        }
    }
}

impl fmt::Display for Dialect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Parses a [`name`](Dialect::name).
impl FromStr for Dialect {
    type Err = ();

    fn from_str(name: &str) -> Result<Self, ()> {
        Self::ALL.iter().find(|dialect| dialect.name() == name).copied().ok_or(())
    }
}
