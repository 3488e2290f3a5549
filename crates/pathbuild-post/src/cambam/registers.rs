//! Letters with numbers, and codes of motions: what a machine remembers.

use super::section::Section;

/// Letters whose last written number is remembered.
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
    /// Every register, in the order of the variants.
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

    /// The register of a letter of any case.
    pub(super) fn of(letter: char) -> Option<Self> {
        Self::ALL.into_iter().find(|register| register.letter() == letter.to_ascii_uppercase())
    }

    /// The letter, upper case.
    pub(super) fn letter(self) -> char {
        char::from(b"XYZABCFIJKPQR"[self as usize])
    }
}

/// How a register's number is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    /// `{$x}`: always.
    Always,
    /// `{$_x}`: when its text is not the last one written.
    Changed,
    /// `{$-x}`: with the other sign.
    Reversed,
    /// `{$+x}`: without sign.
    Positive,
}

/// Motions and cycles that have a section of their own.
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
    /// Every code.
    pub(super) const ALL: [Self; 7] =
        [Self::G0, Self::G1, Self::G2, Self::G3, Self::G81, Self::G82, Self::G83];

    /// The section with its word.
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

    /// The number behind G.
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
