//! The probe table in a program's header: what the program was made with. (`(Probe #51: [5.000 -15.000] T=2.000 X12.000 Y3.000)`)

use std::collections::BTreeMap;
use std::sync::LazyLock;

use pathbuild_path::{Xy, parse_number};
use regex::Regex;

use super::Source;
use super::lines::{Line, lines};

/// A program's probes. Programs of the original tool have no such table.
#[derive(Debug, Default)]
pub(super) struct ProbeTable {
    pub(super) probes: BTreeMap<u32, ProgramProbe>,
}

/// A probe that the program was made with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ProgramProbe {
    pub(super) place: ProbePoint,
    /// th.
    pub(super) height: f64,
    /// Where it is in the program.
    pub(super) at: Option<Xy>,
}

/// A probe's place in its own drawing.
pub(super) type ProbePoint = [f64; 2];

static ENTRY: LazyLock<Regex> = LazyLock::new(|| {
    let number = r"(-?[0-9]+(?:\.[0-9]+)?)";
    let pattern =
        format!(r"^\(Probe #([0-9]+): \[{number} {number}\] T={number}(?: X{number} Y{number})?\)\s*$");
    Regex::new(&pattern).expect("a constant pattern")
});

impl ProbeTable {
    /// Reads the comments before the first block of the program.
    pub(super) fn read(program: Source<'_>) -> Self {
        let mut table = Self::default();
        let is_header = |line: &[u8]| matches!(line.first(), None | Some(b'(' | b'%' | b';'));
        for line in lines(program).map(Line::content).take_while(|line| is_header(line)) {
            if let Some((probe, made)) = entry(&String::from_utf8_lossy(line)) {
                table.probes.entry(probe).or_insert(made);
            }
        }
        table
    }
}

fn entry(line: &str) -> Option<(u32, ProgramProbe)> {
    let parts = ENTRY.captures(line)?;
    let number = |index: usize| parts.get(index).and_then(|part| parse_number(part.as_str()));
    let at = number(5).zip(number(6)).map(|(x, y)| Xy::new(x, y));
    let made = ProgramProbe { place: [number(2)?, number(3)?], height: number(4)?, at };
    Some((parts[1].parse().ok()?, made))
}
