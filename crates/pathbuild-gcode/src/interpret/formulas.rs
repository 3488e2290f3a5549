//! Compares correction formulas of native programs with the numbers that are executed. (book: language/probes)

use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_toolpath::LAST_DIGIT_SLACK;

use super::evaluate::{NoValue, ProbeHeight};
use super::execute::Interpreter;
use crate::native::probe_entry;
use crate::provenance::Provenance;
use crate::read::{Block, Formula, Span};

impl Interpreter<'_> {
    /// Stores the probes and the provenance that comments state before the first word of a native program.
    pub(super) fn take_stated(&mut self, block: &Block<'_>, text: Span) {
        if !self.rules.spelling.formulas || self.stated_probes.has_begun {
            return;
        }
        let comment = block.text_of(text);
        if let Some((number, probe)) = probe_entry(&comment) {
            self.stated_probes.is_ours = true;
            if self.stated_probes.probes.insert(number, probe).is_some_and(|known| known != probe) {
                self.report(block, &say::PROBE_STATED_TWICE, text, |d| d.with("probe", u64::from(number)));
            }
        } else if !self.stated_probes.is_ours {
            self.stated_probes.is_ours = comment.trim().parse::<Provenance>().is_ok();
        }
    }

    /// Records that a block has words: comments after the first such block list no probes.
    pub(super) fn begin_words(&mut self, block: &Block<'_>) {
        self.stated_probes.has_begun |= !block.words.is_empty();
    }

    /// Returns how much of a number is probe correction, according to its formula. The machine executes the number and not the formula, so a formula
    /// with a different result is reported.
    pub(super) fn correction(&mut self, block: &Block<'_>, formula: &Formula, number: f64) -> f64 {
        if self.stated_probes.is_ours && self.stated_probes.probes.is_empty() {
            self.report(block, &say::FORMULA_WITHOUT_PROBES, formula.span, |d| d);
            return 0.0;
        }
        let code = block.code(formula.code);
        let drawn = match self.stated_probes.evaluate(code, ProbeHeight::Drawn) {
            Ok(drawn) => drawn,
            Err(fault) => return self.report_no_value(block, formula, &fault),
        };
        if !formula.applied {
            self.compare(block, formula, number, drawn);
            if self.stated_probes.has_measured() {
                self.report(block, &say::FORMULA_NOT_APPLIED, formula.span, |d| d);
            }
            return 0.0;
        }
        match self.stated_probes.evaluate(code, ProbeHeight::Measured) {
            Ok(value) => {
                self.compare(block, formula, number, value);
                value - drawn
            }
            Err(NoValue::UnknownProbe(_)) if !self.stated_probes.is_ours => {
                // Other software wrote the program and did not list measured heights, which `verify` reports.
                number - drawn
            }
            Err(fault) => self.report_no_value(block, formula, &fault),
        }
    }

    fn report_no_value(&mut self, block: &Block<'_>, formula: &Formula, fault: &NoValue) -> f64 {
        let (message, probe) = match fault {
            NoValue::UnknownProbe(probe) => (&say::PROBE_NOT_STATED, *probe),
            NoValue::Unmeasured(probe) => (&say::HEIGHT_NOT_MEASURED, *probe),
            NoValue::Infinite => (&say::FORMULA_WITHOUT_VALUE, 0),
        };
        self.report(block, message, formula.span, |d| d.with("probe", u64::from(probe)));
        0.0
    }

    fn compare(&mut self, block: &Block<'_>, formula: &Formula, number: f64, value: f64) {
        if libm::fabs(number - value) > LAST_DIGIT_SLACK {
            self.report(block, &say::FORMULA_DIFFERS, formula.span, |d| {
                d.with("number", number).with("value", libm::round(value * 1000.0) / 1000.0)
            });
        }
    }

    /// Reports a height without a formula. In a program with probes, only the start height S0 has none.
    pub(super) fn height_without_formula(&mut self, block: &Block<'_>, span: Span, number: f64) {
        if self.stated_probes.probes.is_empty() {
            return;
        }
        let start = *self.stated_probes.start_height.get_or_insert(number);
        if libm::fabs(number - start) > LAST_DIGIT_SLACK {
            self.report(block, &say::HEIGHT_WITHOUT_FORMULA, span, |d| d);
        }
    }
}
