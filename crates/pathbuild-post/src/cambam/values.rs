//! Macros that expand to a number or a name of the program, without a letter.

use pathbuild_diagnostic::{Diagnostic, messages::posts};

use super::macros::Value;
use super::move_values::ArcValues;
use super::plan::framed;
use super::registers::Register;
use super::section::Section;
use super::writer::{WriteResult, Writer};
use crate::job::Stock;
use crate::step::{Hole, HoleKind};

impl Writer<'_> {
    /// The text of a value, or `None` if the program does not have it.
    pub(super) fn value(&self, value: Value) -> Option<String> {
        let operation = self.operation();
        let tool = self.tool;
        match value {
            Value::FileName => Some(self.plan.job.name.to_string()),
            Value::ProgramNumber => {
                let number = self.plan.options.program_number.or_else(|| self.plan.job.number());
                number.map(|number| format!("{number:04}"))
            }
            Value::Date => self.plan.options.date.as_deref().map(str::to_owned),
            Value::OutFile => self.plan.options.output.as_deref().map(str::to_owned),
            Value::PartName => Some(operation.part.to_string()),
            Value::MopName => Some(operation.name.to_string()),
            Value::MopTag => Some(operation.tag.to_string()),
            Value::MopClearancePlane => Some(self.length(operation.clearance)),
            Value::MopRetractHeight => Some(self.length(operation.retract)),
            Value::MopPlungeFeedrate => self.feeds().plunge.map(|feed| self.length(feed)),
            Value::MopCutFeedrate => self.feeds().cut.map(|feed| self.length(feed)),
            Value::MopDepthIncrement => Some(self.length(operation.depth_increment.unwrap_or(0.0))),
            Value::MopDwell => {
                Some(self.number_format().format(operation.holes().find_map(dwell).unwrap_or(0.0)))
            }
            Value::MopHoleDiameter | Value::ToolDiameter => Some(self.length(tool.diameter)),
            Value::MopPeckDistance => Some(self.length(operation.holes().find_map(peck).unwrap_or(0.0))),
            Value::MopStockSurface => Some(self.length(operation.surface)),
            // Operations that do not cut leave the surface as it is.
            Value::MopTargetDepth => Some(self.length(operation.target_depth.unwrap_or(operation.surface))),
            Value::MopFirst(axis) => operation.first_point().axes()[axis as usize].map(|at| self.length(at)),
            Value::ToolIndex => Some(tool.index.to_string()),
            Value::ToolName => Some(tool.name.to_string()),
            Value::ToolRadius => Some(self.length(tool.radius)),
            Value::ToolLength => tool.length.map(|length| self.length(length)),
            Value::ToolProfile => Some(tool.profile.to_string()),
            Value::ToolComment => Some(tool.comment.to_string()),
            Value::ToolVeeAngle => tool.vee_angle.map(|angle| self.number_format().format(angle)),
            Value::MoveAxis(register) | Value::ArcOffset(register) => self.register_value(register),
            Value::ArcRadius => self.arc_value(|arc| arc.radius),
            Value::ArcStart => self.arc_value(|arc| arc.start),
            Value::ArcEnd => self.arc_value(|arc| arc.end),
            Value::ArcSweep => self.arc_value(|arc| arc.sweep),
            Value::StockSize(axis) => self.stock_value(|stock| stock.size[axis]),
            Value::StockCorner(axis) => self.stock_value(|stock| stock.corner[axis]),
            Value::StockCornerReversed(axis) => {
                let own = || self.own_number(Value::StockCorner(axis));
                self.stock_value(|stock| -stock.corner[axis]).or_else(own)
            }
        }
    }

    /// The value given by the definition or the configuration with reversed sign, if it is a number.
    fn own_number(&self, value: Value) -> Option<String> {
        let own = self.plan.user_macro(value.name())?;
        own.literal().trim().parse().ok().map(|number: f64| self.number_format().format(-number))
    }

    fn register_value(&self, register: Register) -> Option<String> {
        self.move_values.get(register).map(|value| self.number_format().format(value))
    }

    fn arc_value(&self, value: fn(&ArcValues) -> f64) -> Option<String> {
        self.move_values.arc.as_ref().map(|arc| self.number_format().format(value(arc)))
    }

    fn stock_value(&self, value: impl Fn(&Stock) -> f64) -> Option<String> {
        self.plan.job.stock.as_ref().map(|stock| self.length(value(stock)))
    }

    /// Handles a macro without a value: a date may be omitted, anything else would leave a gap in the program.
    pub(super) fn without_value(&mut self, value: Value, section: Section, line: u32) -> WriteResult {
        if value == Value::Date {
            self.line.leave_out();
            return Ok(());
        }
        let message = if value.is_open() { &posts::VALUE_MISSING_OPEN } else { &posts::VALUE_MISSING };
        let diagnostic = Diagnostic::new(message)
            .quoting("macro", framed(value.name()))
            .quoting("name", value.name())
            .quoting("operation", &*self.operation().name);
        Err(Box::new(self.plan.locate(diagnostic, section, line)))
    }
}

fn dwell(hole: &Hole) -> Option<f64> {
    match hole.kind {
        HoleKind::Dwell { seconds } => Some(seconds),
        _ => None,
    }
}

fn peck(hole: &Hole) -> Option<f64> {
    match hole.kind {
        HoleKind::Peck { depth } => Some(depth),
        _ => None,
    }
}
