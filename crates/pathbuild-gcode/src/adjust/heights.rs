//! Compares the heights of a corrected program with the plate and with the measured surface. (book: language/probes)

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::probes as messages;
use pathbuild_path::approx::above;
use pathbuild_toolpath::ZModel;

use super::check::{MIN_DIFFERENCE, Values};
use super::scan::{FormulaSpan, Line, formula_spans, lines, plain_height, value_of};
use super::surface::{AppliedCorrection, MeasuredSurface};
use super::values::{ProbeTable, ProgramProbe};
use super::{MeasuredHeights, Source, is_height};

/// Evaluates the formulas of a program that lists measured heights in its header, and returns findings about the resulting heights. `below_plate` is
/// the depth in mm below the plate beyond which a lowered height is reported, and `model` the model of the surface between the probes.
pub fn corrected_heights(program: Source<'_>, below_plate: f64, model: ZModel) -> Vec<Diagnostic> {
    let stated = ProbeTable::read(program).probes;
    let measured = |(number, probe): (&u32, &ProgramProbe)| Some((*number, probe.measured?));
    let measured: Values = stated.iter().filter_map(measured).collect();
    if measured.is_empty() {
        return Vec::new();
    }
    let drawn: Values = stated.iter().map(|(number, probe)| (*number, probe.height)).collect();
    let surface = MeasuredSurface::new(&stated, &measured, model);
    let mut rules = HeightRules::new(below_plate, measured.values().copied());
    for line in lines(program) {
        rules.line(line);
        for spot in formula_spans(line.content()).filter(|spot| is_height(line.content(), spot)) {
            let Some(formula) = line.content()[spot.formula.clone()].strip_prefix(b"=") else { continue };
            let value = |heights| value_of(formula, &mut MeasuredHeights(heights)).ok();
            if let Some((drawn, height)) = value(&drawn).zip(value(&measured)) {
                rules.check_corrected_height(line, &spot, drawn, height);
            }
        }
    }
    rules.finish(program, surface.as_ref())
}

/// The rules about corrected heights: pass every line and every corrected height of a program, then call [`finish`](Self::finish).
pub(super) struct HeightRules {
    /// Depth in mm below the plate beyond which a lowered height is reported.
    below_plate: f64,
    /// The highest measured surface in mm; `None` if nothing was measured.
    surface: Option<f64>,
    /// Whether the program has had its start height, which is not corrected.
    has_started: bool,
    /// The error of a start height that is not above the measured surface.
    in_material: Option<Diagnostic>,
    /// The greatest height above the plate of a cut that was drawn down to the plate or below it, with its warning.
    raised: Option<(f64, Diagnostic)>,
    /// The least height that a correction lowered too far below the plate, with its warning.
    lowered: Option<(f64, Diagnostic)>,
    /// All corrections, in the order of their lines.
    applied: Vec<AppliedCorrection>,
}

impl HeightRules {
    pub(super) fn new(below_plate: f64, measured: impl Iterator<Item = f64>) -> Self {
        let surface = measured.reduce(f64::max);
        Self {
            below_plate,
            surface,
            has_started: false,
            in_material: None,
            raised: None,
            lowered: None,
            applied: Vec::new(),
        }
    }

    /// Checks the first height without a formula, at which the tool moves before the first and after the last cut.
    pub(super) fn line(&mut self, line: Line<'_>) {
        let Some(surface) = self.surface.filter(|_| !self.has_started) else { return };
        let Some(span) = plain_height(line.content()) else { return };
        self.has_started = true;
        let height = str::from_utf8(&line.content()[span.clone()]).ok().and_then(|text| text.parse().ok());
        if let Some(height) = height.filter(|height| !above(*height, surface)) {
            let problem = line.fault(&messages::SWEEP_BELOW_MEASURED, span).with("z", height);
            self.in_material = Some(problem.with("surface", surface));
        }
    }

    /// Records a corrected height. Warns about a cut that was drawn through the material but no longer goes through it, and about a height that is
    /// lowered too far below the plate.
    pub(super) fn check_corrected_height(
        &mut self,
        line: Line<'_>,
        spot: &FormulaSpan,
        drawn: f64,
        height: f64,
    ) {
        self.applied.push(AppliedCorrection { line: line.number, correction: height - drawn });
        let warning = |message| {
            let problem = line.fault(message, spot.number.start..spot.formula.end).with("z", height);
            Some((height, problem.with("depth", -height).with("limit", self.below_plate)))
        };
        if drawn <= 0.0
            && height > MIN_DIFFERENCE
            && self.raised.as_ref().is_none_or(|(most, _)| height > *most)
        {
            self.raised = warning(&messages::RAISED_ABOVE_PLATE);
        }
        if height < drawn
            && above(-height, self.below_plate)
            && self.lowered.as_ref().is_none_or(|(least, _)| height < *least)
        {
            self.lowered = warning(&messages::LOWERED_BELOW_PLATE);
        }
    }

    /// Returns PB606 for a cut that ends with a correction other than the one measured at its end.
    pub(super) fn stale_correction(
        &self,
        program: Source<'_>,
        surface: Option<&MeasuredSurface>,
    ) -> Option<Diagnostic> {
        surface?.stale_correction(program, &self.applied)
    }

    /// Returns the findings about the corrected program. `surface` is `None` if the places of its probes are not known.
    pub(super) fn finish(self, program: Source<'_>, surface: Option<&MeasuredSurface>) -> Vec<Diagnostic> {
        let below = || surface?.rapid_below(program, &self.applied);
        let extremes = [self.raised, self.lowered].into_iter().flatten().map(|(_, warning)| warning);
        self.in_material.or_else(below).into_iter().chain(extremes).collect()
    }
}
