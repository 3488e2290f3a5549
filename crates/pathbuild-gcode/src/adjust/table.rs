//! The probe table in the header of a program, which lists its probes and the heights measured at them.
//! (`(Probe #51: [5.000 -15.000] T=2.000 X12.000 Y3.000 Z2.050)`, where Z was added by `adjust`.)

use std::collections::BTreeMap;
use std::fmt;
use std::sync::LazyLock;

use pathbuild_path::{Xy, parse_number};
use regex::Regex;

use super::Source;
use super::lines::{Line, lines};
use crate::native::f3;

/// The probes of a program. Programs of the original tool have no such table.
#[derive(Debug, Default)]
pub(super) struct ProbeTable {
    pub(super) probes: BTreeMap<u32, ProgramProbe>,
}

/// A probe listed in a program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ProgramProbe {
    pub(super) place: ProbePoint,
    /// Height at which it was drawn, in mm.
    pub(crate) height: f64,
    /// Position in the program.
    pub(super) at: Option<Xy>,
    /// Measured height in mm; only in adjusted programs.
    pub(crate) measured: Option<f64>,
}

/// Formats its position as in the drawing.
impl fmt::Display for ProgramProbe {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y] = self.place;
        write!(f, "[{} {}] T={}", f3(x), f3(y), f3(self.height))?;
        self.at.map_or(Ok(()), |at| write!(f, " X{} Y{}", f3(at.x), f3(at.y)))
    }
}

/// Position of a probe in its own drawing.
pub(super) type ProbePoint = [f64; 2];

static ENTRY: LazyLock<Regex> = LazyLock::new(|| {
    let number = r"(-?[0-9]+(?:\.[0-9]+)?)";
    let pattern = format!(
        r"^Probe #([0-9]+): \[{number} {number}\] T={number}(?: X{number} Y{number})?(?: Z{number})?$"
    );
    Regex::new(&pattern).expect("a constant pattern")
});

impl ProbeTable {
    /// Reads the comments before the first block of the program.
    pub(super) fn read(program: Source<'_>) -> Self {
        let mut table = Self::default();
        for line in lines(program).map(Line::content).take_while(|line| is_header(line)) {
            if let Some((probe, made)) = entry_of_line(line) {
                table.probes.entry(probe).or_insert(made);
            }
        }
        table
    }
}

/// Whether a line can be part of the header, which ends with the first word of the program.
pub(super) fn is_header(line: &[u8]) -> bool {
    matches!(line.first(), None | Some(b'(' | b'%' | b';'))
}

/// The probe listed in a line of the header.
pub(super) fn entry_of_line(line: &[u8]) -> Option<(u32, ProgramProbe)> {
    let comment = line.trim_ascii_end().strip_prefix(b"(")?.strip_suffix(b")")?;
    probe_entry(str::from_utf8(comment).ok()?)
}

/// The probe listed in a comment, with its number.
pub(crate) fn probe_entry(comment: &str) -> Option<(u32, ProgramProbe)> {
    if !comment.starts_with("Probe #") {
        return None;
    }
    let parts = ENTRY.captures(comment)?;
    let number = |index: usize| parts.get(index).and_then(|part| parse_number(part.as_str()));
    let at = number(5).zip(number(6)).map(|(x, y)| Xy::new(x, y));
    let probe = ProgramProbe { place: [number(2)?, number(3)?], height: number(4)?, at, measured: number(7) };
    Some((parts[1].parse().ok()?, probe))
}
