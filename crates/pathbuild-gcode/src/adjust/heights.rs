//! Compares the heights of a corrected program with the plate and with the measured surface. (book: language/probes)

use std::ops::Range;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::probes as messages;
use pathbuild_path::THROUGH_HEIGHT;
use pathbuild_path::approx::above;
use pathbuild_toolpath::ZModel;

use super::check::Values;
use super::scan::{FormulaSpan, Line, formula_spans, lines, plain_height, value_of};
use super::surface::{AppliedCorrection, CutDepths, MeasuredSurface};
use super::values::probe_table;
use super::{MeasuredHeights, Source, is_height};
use crate::native::ProgramProbe;

/// Evaluates the formulas of a program that lists measured heights in its header, and returns findings about the resulting heights. `below_plate` is
/// the depth in mm below the plate beyond which a lowered height is reported, `model` the model of the surface between the probes, and `shims` those
/// of [`Inputs`](super::Inputs).
pub fn corrected_heights(
    program: Source<'_>,
    below_plate: f64,
    model: ZModel,
    shims: &[f64],
) -> Vec<Diagnostic> {
    let stated = probe_table(program.bytes);
    let measured = |(number, probe): (&u32, &ProgramProbe)| Some((*number, probe.measured?));
    let measured: Values = stated.iter().filter_map(measured).collect();
    if measured.is_empty() {
        return Vec::new();
    }
    let drawn: Values = stated.iter().map(|(number, probe)| (*number, probe.height)).collect();
    let surface = MeasuredSurface::new(&stated, &measured, model);
    let mut rules = HeightRules::new(below_plate, measured.values().copied(), shims);
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
pub(super) struct HeightRules<'a> {
    /// Depth in mm below the plate beyond which a lowered height is reported.
    below_plate: f64,
    /// The heights in mm by which embedded paths are raised, in the order of the comments where they begin.
    shims: &'a [f64],
    /// The number of embedded paths that have begun.
    embedded: usize,
    /// The heights in mm of the embedded paths around the current line, from the outermost.
    levels: Vec<f64>,
    /// The highest measured surface in mm; `None` if nothing was measured.
    surface: Option<f64>,
    /// Whether the program has had its start height, which is not corrected.
    has_started: bool,
    /// The error of a start height that is not above the measured surface.
    in_material: Option<Diagnostic>,
    /// The cuts that were drawn down to the plate or below it, but end above it.
    raised: Vec<RaisedCut<'a>>,
    /// The greatest depth in mm below the plate, or below the shims on it, to which a correction lowered a cut beyond the limit, with its warning.
    lowered: Option<(f64, Diagnostic)>,
    /// All corrections, in the order of their lines.
    pub(super) applied: Vec<AppliedCorrection>,
}

/// A cut that was drawn down to the plate or below it, but ends above it.
struct RaisedCut<'a> {
    line: Line<'a>,
    /// The place of the height in the line.
    span: Range<usize>,
    /// The corrected height in mm.
    height: f64,
    /// Height in mm of the plate, or of the shims on it.
    level: f64,
}

impl<'a> HeightRules<'a> {
    pub(super) fn new(below_plate: f64, measured: impl Iterator<Item = f64>, shims: &'a [f64]) -> Self {
        let surface = measured.reduce(f64::max);
        Self {
            below_plate,
            shims,
            embedded: 0,
            levels: Vec::new(),
            surface,
            has_started: false,
            in_material: None,
            raised: Vec::new(),
            lowered: None,
            applied: Vec::new(),
        }
    }

    /// Notes where embedded paths begin and end, and checks the first height without a formula, at which the tool moves before the first and after
    /// the last cut.
    pub(super) fn line(&mut self, line: Line<'_>) {
        if line.content().starts_with(b"(START Subpath ") {
            self.levels.push(self.shims.get(self.embedded).copied().unwrap_or_default());
            self.embedded += 1;
        } else if line.content().starts_with(b"(END Subpath ") {
            self.levels.pop();
        }
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
        line: Line<'a>,
        spot: &FormulaSpan,
        drawn: f64,
        height: f64,
    ) {
        self.applied.push(AppliedCorrection { line: line.number, correction: height - drawn });
        let level = self.levels.last().copied().unwrap_or_default();
        let span = spot.number.start..spot.formula.end;
        let depth = level - height;
        let is_through = |z: f64| z <= level + THROUGH_HEIGHT;
        if is_through(drawn) && !is_through(height) {
            self.raised.push(RaisedCut { line, span, height, level });
        } else if height < drawn
            && above(depth, self.below_plate)
            && self.lowered.as_ref().is_none_or(|(most, _)| depth > *most)
        {
            let problem = line.fault(&messages::LOWERED_BELOW_PLATE, span).with("z", height);
            self.lowered = Some((depth, problem.with("depth", depth).with("limit", self.below_plate)));
        }
    }

    /// Returns PB602 for the cut that ends highest above the plate. A cut that a deeper one at the same place follows or precedes, such as that of an
    /// earlier pass, does not count.
    fn raised_cut<'s>(&'s self, program: Source<'_>) -> Option<Diagnostic> {
        if self.raised.is_empty() {
            return None;
        }
        let depths = CutDepths::of(program);
        let remaining = self.raised.iter().filter(|cut| !depths.is_deeper(cut.line.number, cut.height));
        let highest = |best: &'s RaisedCut<'a>, next: &'s RaisedCut<'a>| {
            if next.height - next.level > best.height - best.level { next } else { best }
        };
        let RaisedCut { line, span, height, level } = remaining.reduce(highest)?;
        let problem = line.fault(&messages::RAISED_ABOVE_PLATE, span.clone());
        Some(problem.with("z", *height).with("level", *level))
    }

    /// Returns the findings about the corrected program. `surface` is `None` if the places of its probes are not known.
    pub(super) fn finish(self, program: Source<'_>, surface: Option<&MeasuredSurface>) -> Vec<Diagnostic> {
        let below = || surface?.rapid_below_surface_problem(program, &self.applied);
        let raised = self.raised_cut(program);
        let lowered = self.lowered.as_ref().map(|(_, warning)| warning.clone());
        self.in_material.clone().or_else(below).into_iter().chain(raised).chain(lowered).collect()
    }
}
