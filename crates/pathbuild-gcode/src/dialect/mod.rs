//! The differences between controls: spelling, words, arcs, order. (book: program/reading)
//!
//! A dialect is data, described by its [`Rules`]. Reader and interpreter only look at the rules, never at the dialect itself.

mod codes;
mod comment;
mod rules;

use std::fmt;
use std::str::FromStr;

pub use codes::{InertWord, Letters, Words};
pub(crate) use comment::leading_word;
pub use comment::{Charset, ascii, comment_safe_text, is_active_comment};
pub use rules::{
    ArcRules, Blanks, DwellRules, DwellUnit, FeedMode, Grammar, LengthRules, LineLength, MCodeLimit,
    MCodeOrder, NotationSupport, Operators, Percent, RadiusTolerance, Rules, Slash, Spelling, StartMotion,
    SystemNumbers, ToolChanger, UnitChange,
};

macro_rules! dialects {
    ($(#[$doc:meta] $dialect:ident $name:literal $rules:ident;)*) => {
        /// The supported kinds of G-code.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, serde::Serialize, serde::Deserialize)]
        pub enum Dialect {
            $(#[$doc] $dialect,)*
        }

        impl Dialect {
            /// All dialects, in the order in which they are listed to users.
            pub const ALL: &[Self] = &[$(Self::$dialect,)*];

            /// Returns the name of the dialect on the command line.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$dialect => $name,)*
                }
            }

            /// Returns the rules by which the dialect's programs are read and written.
            pub fn rules(self) -> &'static Rules {
                match self {
                    $(Self::$dialect => &rules::$rules,)*
                }
            }
        }
    };
}

dialects! {
    /// The output of pathbuild and of its predecessor PathDxf2GCode (book: program/gcode), with correction formulas as data (book: language/probes).
    Native "native" NATIVE;
    /// RS274/NGC version 3 of the NIST, the common ancestor of most other dialects.
    Rs274 "rs274" RS274;
    /// LinuxCNC 2.9.
    LinuxCnc "linuxcnc" LINUXCNC;
    /// GRBL 1.1.
    Grbl "grbl" GRBL;
    /// The import filter of XpertMILL (STEP-FOUR).
    Xpertmill "xpertmill" XPERTMILL;
    /// Mach3 and Mach4, for milling.
    Mach3 "mach3" MACH3;
    /// Fanuc and similar controls, for milling.
    Fanuc "fanuc" FANUC;
    /// Haas mills.
    Haas "haas" HAAS;
    /// Marlin 2 on a milling machine.
    Marlin "marlin" MARLIN;
    /// The CNC controller of Estlcam.
    Estlcam "estlcam" ESTLCAM;
    /// DIN 66025, as in the CAD6 manual.
    Din "din" DIN;
}

impl fmt::Display for Dialect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Parses the [`name`](Dialect::name) of a dialect.
impl FromStr for Dialect {
    type Err = ();

    fn from_str(name: &str) -> Result<Self, ()> {
        Self::ALL.iter().find(|dialect| dialect.name() == name).copied().ok_or(())
    }
}
