//! Registers and motion codes, the modal state of the machine.

use super::section::Section;

/// Letters with a number whose last value is remembered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Register {
    X,
    Y,
    Z,
    A,
    B,
    C,
    F,
    I,
    J,
    K,
    P,
    Q,
    R,
}

impl Register {
    /// All registers, in the order of the variants.
    pub(super) const ALL: [Self; 13] = [
        Self::X,
        Self::Y,
        Self::Z,
        Self::A,
        Self::B,
        Self::C,
        Self::F,
        Self::I,
        Self::J,
        Self::K,
        Self::P,
        Self::Q,
        Self::R,
    ];
    /// X, Y, Z.
    pub(super) const AXES: [Self; 3] = [Self::X, Self::Y, Self::Z];

    /// The register of a letter in either case.
    pub(super) fn of(letter: char) -> Option<Self> {
        Self::ALL.into_iter().find(|register| register.letter() == letter.to_ascii_uppercase())
    }

    /// The letter in upper case.
    pub(super) fn letter(self) -> char {
        char::from(b"XYZABCFIJKPQR"[self as usize])
    }
}

/// How the number of a register is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    /// `{$x}`: always.
    Always,
    /// `{$_x}`: only if it differs from the last one written.
    Changed,
    /// `{$-x}`: with reversed sign.
    Reversed,
    /// `{$+x}`: without sign.
    Positive,
}

/// Motions and cycles that have their own sections.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Code {
    G0,
    G1,
    G2,
    G3,
    G81,
    G82,
    G83,
}

impl Code {
    /// All codes.
    pub(super) const ALL: [Self; 7] =
        [Self::G0, Self::G1, Self::G2, Self::G3, Self::G81, Self::G82, Self::G83];

    /// The section that contains the word of the code.
    pub(super) fn section(self) -> Section {
        match self {
            Self::G0 => Section::G0,
            Self::G1 => Section::G1,
            Self::G2 => Section::G2,
            Self::G3 => Section::G3,
            Self::G81 => Section::G81,
            Self::G82 => Section::G82,
            Self::G83 => Section::G83,
        }
    }

    /// The number after G.
    pub(super) fn number(self) -> u32 {
        match self {
            Self::G0 => 0,
            Self::G1 => 1,
            Self::G2 => 2,
            Self::G3 => 3,
            Self::G81 => 81,
            Self::G82 => 82,
            Self::G83 => 83,
        }
    }
}
