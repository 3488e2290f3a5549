//! The probes that a native program lists in its header, one comment for each. (book: program/gcode)

use std::fmt;
use std::sync::LazyLock;

use pathbuild_path::{Xy, parse_number};
use pathbuild_toolpath::ProbePoint;
use regex::Regex;

use super::number::three_decimals;

/// A probe, as the header lists it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ProgramProbe {
    /// Position in the coordinates of the drawing that contains the probe.
    pub(crate) drawn_at: Xy,
    /// Height at which the probe was drawn, in mm.
    pub(crate) height: f64,
    /// Position in the program's coordinates, if the header states it.
    pub(crate) at: Option<Xy>,
    /// Measured height in mm; only in adjusted programs.
    pub(crate) measured: Option<f64>,
}

impl From<&ProbePoint> for ProgramProbe {
    fn from(probe: &ProbePoint) -> Self {
        let ProbePoint { drawn_at, height, at, .. } = *probe;
        Self { drawn_at, height, at: Some(at), measured: None }
    }
}

/// Beginning of a comment about a probe; the number of the probe's parameter follows.
pub(super) const PROBE_COMMENT: &str = "Probe #";

/// Formats the position and the height of a probe as the header of a program lists them.
impl fmt::Display for ProgramProbe {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { drawn_at, height, .. } = self;
        write!(
            f,
            "[{} {}] T={}",
            three_decimals(drawn_at.x),
            three_decimals(drawn_at.y),
            three_decimals(*height)
        )?;
        self.at.map_or(Ok(()), |at| write!(f, " X{} Y{}", three_decimals(at.x), three_decimals(at.y)))
    }
}

/// Parses the probe listed in a comment, with its number; `None` if the comment lists none.
pub(crate) fn probe_entry(comment: &str) -> Option<(u32, ProgramProbe)> {
    if !comment.starts_with(PROBE_COMMENT) {
        return None;
    }
    let parts = HEADER_ENTRY.captures(comment)?;
    let number = |index: usize| parts.get(index).and_then(|part| parse_number(part.as_str()));
    let drawn_at = Xy::new(number(2)?, number(3)?);
    let at = number(5).zip(number(6)).map(|(x, y)| Xy::new(x, y));
    let probe = ProgramProbe { drawn_at, height: number(4)?, at, measured: number(7) };
    Some((parts[1].parse().ok()?, probe))
}

static HEADER_ENTRY: LazyLock<Regex> = LazyLock::new(|| {
    let number = r"(-?[0-9]+(?:\.[0-9]+)?)";
    let pattern = format!(
        r"^{PROBE_COMMENT}([0-9]+): \[{number} {number}\] T={number}(?: X{number} Y{number})?(?: Z{number})?$"
    );
    Regex::new(&pattern).expect("a constant pattern")
});
