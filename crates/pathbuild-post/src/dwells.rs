//! Compares the dwells of a text with those of the job, because a time in the wrong unit would be a thousand times too short or too long.

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::posts;
use pathbuild_motion::{Action, Step};

use crate::job::{HoleKind, Job, JobStep};
use crate::rs274_translation::TranslatedText;

/// Finds the first dwell of the job that the text lacks. The text may contain further dwells, such as those that wait for the spindle.
/// `slack` is the permitted deviation in seconds; shorter dwells need not be written.
///
/// If no dialect is named (`translated` is given), a text without any G4 passes, because it may use another word, and numbers may be in
/// milliseconds.
pub(super) fn check(
    steps: &[Step],
    translated: Option<&TranslatedText>,
    job: &Job,
    slack: f64,
) -> Option<Diagnostic> {
    let dwells = steps.iter().filter_map(|step| match step.action {
        Action::Dwell(seconds) => Some((step.line, seconds)),
        _ => None,
    });
    let left_out = translated.iter().flat_map(|translated| translated.dwells.iter().copied());
    let mut found: Vec<(u32, f64)> = dwells.chain(left_out).collect();
    if translated.is_some() && found.is_empty() {
        return None;
    }
    found.sort_by_key(|(line, _)| *line);
    found.reverse();
    let units: &[f64] = if translated.is_some() { &[1.0, 1000.0] } else { &[1.0] };
    let needed = job.operations.iter().flat_map(|operation| &operation.steps).filter_map(dwell_seconds);
    for seconds in needed.filter(|seconds| *seconds > slack) {
        let lasts = |found: f64| units.iter().any(|unit| (found / unit - seconds).abs() <= slack);
        let Some(at) = found.iter().rposition(|(_, found)| lasts(*found)) else {
            return Some(difference(seconds, found.last().copied(), steps));
        };
        found.truncate(at);
    }
    None
}

/// Returns the time in seconds that a step waits; `None` if it does not wait.
fn dwell_seconds(step: &JobStep) -> Option<f64> {
    match step {
        JobStep::Dwell { seconds } => Some(*seconds),
        JobStep::Hole(hole) => match hole.kind {
            HoleKind::Dwell { seconds } => Some(seconds),
            HoleKind::Plain | HoleKind::Peck { .. } => None,
        },
        JobStep::Move(_) | JobStep::Stop | JobStep::SpindleOff { .. } | JobStep::Comment(_) => None,
    }
}

fn difference(seconds: f64, next: Option<(u32, f64)>, steps: &[Step]) -> Diagnostic {
    if let Some((line, found)) = next {
        let diagnostic = Diagnostic::new(&posts::DWELL_DIFFERS).with("seconds", seconds);
        return diagnostic.with("found", found).at_line(line, None);
    }
    let last = steps.last().map_or(0, |step| step.line);
    Diagnostic::new(&posts::DWELL_LOST).with("seconds", seconds).at_line(last, None)
}
