//! Scenes of G-code programs.

use pathbuild_gcode::summary::Summary;
use pathbuild_motion::Step;

use crate::scene::{Move, ScenePath, Totals};

/// A G-code program that was read.
#[derive(Clone, Copy, Debug)]
pub struct GcodeSource<'a> {
    /// The display name of its file.
    pub file: &'a str,
    /// Its interpreted steps.
    pub steps: &'a [Step],
    /// Its text; invalid UTF-8 is replaced.
    pub text: &'a [u8],
    /// Cutter diameter in mm, if known.
    pub tool: Option<f64>,
    /// The value of `--rapid` in mm/min.
    pub rapid: Option<f64>,
}

/// Converts line ends to LF, so that lines are the ones that the reader counts.
pub(super) fn plain_lines(text: &[u8]) -> String {
    let text = String::from_utf8_lossy(text);
    if text.contains('\n') { text.replace("\r\n", "\n").replace('\r', " ") } else { text.replace('\r', "\n") }
}

/// The scene of a program, without elements.
pub fn gcode_path(source: &GcodeSource<'_>) -> ScenePath {
    let moves = source.steps.iter().filter_map(Step::as_move);
    let summary = Summary::of(source.steps, false).total;
    ScenePath {
        name: source.file.to_owned(),
        file: source.file.to_owned(),
        tool: source.tool,
        moves: moves.map(|(line, way)| Move::new(way, Some(line))).collect(),
        totals: Some(Totals {
            milling: summary.milling.total.length,
            drilling: summary.drilling.total.length,
            sweeps: summary.rapid.total.length,
            minutes: source
                .rapid
                .map(|rapid| summary.sum(rapid).minutes())
                .filter(|minutes| minutes.is_finite()),
        }),
        gcode: Some(plain_lines(source.text)),
        ..ScenePath::default()
    }
}
