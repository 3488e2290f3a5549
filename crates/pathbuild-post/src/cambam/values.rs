//! Expands macros to values of the job, such as numbers and names, or to words that depend on the state of the machine.

use pathbuild_diagnostic::{Diagnostic, messages::posts};
use pathbuild_motion::{Coolant, Plane, Turning};

use super::definition::macro_in_braces;
use super::machine::{ArcValues, Code, Form, Register};
use super::macros::{Choice, State, Value};
use super::section::{Section, coolant_section, spindle_section};
use super::writer::{WriteResult, Writer};
use crate::job::{Hole, HoleKind, JobStep, Units, VelocityMode};
use crate::number::NumberFormat;

impl Writer<'_> {
    /// Returns the text of a value, or `None` if the program does not have this value.
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
            // An operation that does not cut leaves the material up to its surface.
            Value::MopTargetDepth => Some(self.length(operation.target_depth.unwrap_or(operation.surface))),
            Value::MopFirst(axis) => operation.first_point().axes()[axis as usize].map(|at| self.length(at)),
            Value::ToolIndex => Some(tool.index.to_string()),
            Value::ToolName => Some(tool.name.to_string()),
            Value::ToolRadius => Some(self.length(tool.diameter / 2.0)),
            Value::ToolProfile => Some("EndMill".to_owned()),
            Value::MopTag | Value::ToolComment => Some(String::new()),
            Value::MoveAxis(register) | Value::ArcOffset(register) => {
                self.move_values.get(register).map(|value| self.number_format().format(value))
            }
            Value::ArcRadius => self.arc_value(|arc| arc.radius),
            Value::ArcStart => self.arc_value(|arc| arc.start),
            Value::ArcEnd => self.arc_value(|arc| arc.end),
            Value::ArcSweep => self.arc_value(|arc| arc.sweep),
            Value::StockCornerReversed(axis) => {
                let corner = self.plan.user_macro(Value::StockCorner(axis).name())?;
                let number: f64 = corner.literal().trim().parse().ok()?;
                Some(self.number_format().format(-number))
            }
            Value::StockSize(_) | Value::StockCorner(_) | Value::ToolLength | Value::ToolVeeAngle => None,
        }
    }

    fn arc_value(&self, value: fn(&ArcValues) -> f64) -> Option<String> {
        self.move_values.arc.as_ref().map(|arc| self.number_format().format(value(arc)))
    }

    /// Handles a macro without a value. A date may be omitted; any other missing value is an error, because it would leave a gap in
    /// the program.
    pub(super) fn handle_missing_value(&mut self, value: Value, section: Section, line: u32) -> WriteResult {
        if value == Value::Date {
            self.line.omit_value();
            return Ok(());
        }
        let message = match value {
            Value::ProgramNumber => &posts::PROGRAM_NUMBER_MISSING,
            _ if value.may_be_missing() => &posts::VALUE_MISSING_OPEN,
            _ => &posts::VALUE_MISSING,
        };
        let diagnostic = Diagnostic::new(message)
            .quoting("macro", macro_in_braces(value.name()))
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

impl Writer<'_> {
    pub(super) fn write_register(&mut self, register: Register, form: Form) -> WriteResult {
        self.line.has_register_macro = true;
        let Some(value) = self.move_values.get(register) else { return Ok(()) };
        let value = match form {
            Form::Always | Form::Changed => value,
            Form::Reversed => -value,
            Form::Positive => value.abs(),
        };
        let text = match register {
            // Fanuc does not accept a decimal point in P (alarm 007).
            Register::P if self.counts_milliseconds() => NumberFormat::decimals(0, 0).format(1000.0 * value),
            _ => self.number_format().format(value),
        };
        if form == Form::Changed && self.machine.last_text(register) == Some(text.as_str()) {
            return Ok(());
        }
        self.line.has_register_word = true;
        if form == Form::Reversed {
            self.line.reversed.push(register);
        }
        self.write_text(&format!("{}{text}", register.letter()))
    }

    pub(super) fn write_speed(&mut self) -> WriteResult {
        match self.operation().speed.filter(|_| !self.plan.options.manual_spindle) {
            Some(speed) => self.write_text(&format!("S{}", NumberFormat::decimals(0, 0).format(speed))),
            None => Ok(()),
        }
    }

    /// Switches the spindle as the operation requires and, if it turns then, waits until it is up to speed. Writes nothing if the spindle is in this
    /// state already.
    pub(super) fn spindle_up(&mut self) -> WriteResult {
        let operation = self.operation();
        let Some(spindle) = operation.spindle.filter(|_| !self.plan.options.manual_spindle) else {
            return Ok(());
        };
        let is_speed_known = self.machine.speed.is_some() || operation.speed.is_none();
        if self.machine.spindle == Some(spindle)
            && is_speed_known
            && self.machine.speed == operation.speed.map(f64::round)
        {
            return Ok(());
        }
        self.write_section(spindle_section(spindle))?;
        if spindle != Turning::Off {
            self.write_text(" ")?;
            self.write_speed()?;
        }
        self.end_line();
        self.machine.spindle = Some(spindle);
        let wait = self.plan.options.spin_up;
        if wait > 0.0 && spindle != Turning::Off {
            self.step(&JobStep::Dwell { seconds: wait })
        } else {
            Ok(())
        }
    }

    pub(super) fn write_code(&mut self, code: Code, modal: bool) -> WriteResult {
        let (_, section) = code;
        self.line.code = Some(code);
        if self.plan.definition.section(section).is_blank() {
            self.empty_code = Some(section);
        }
        if modal && self.machine.is_active(code) {
            return Ok(());
        }
        self.line.is_in_code = true;
        self.write_section(section)?;
        self.line.is_in_code = false;
        Ok(())
    }

    pub(super) fn write_named_section(&mut self, section: Section) -> WriteResult {
        let is_spindle = matches!(section, Section::SpindleCw | Section::SpindleCcw | Section::SpindleOff);
        if is_spindle && self.plan.options.manual_spindle {
            return Ok(());
        }
        match section {
            Section::SpindleCw => self.machine.spindle = Some(Turning::Clockwise),
            Section::SpindleCcw => self.machine.spindle = Some(Turning::CounterClockwise),
            Section::SpindleOff => self.machine.spindle = Some(Turning::Off),
            Section::CoolantFlood => self.machine.coolant = Some(Coolant::FLOOD),
            Section::CoolantMist => self.machine.coolant = Some(Coolant::MIST),
            Section::CoolantOff => self.machine.coolant = Some(Coolant::OFF),
            _ => {}
        }
        self.write_section(section)
    }

    pub(super) fn section_of_choice(&self, choice: Choice) -> Section {
        let options = &self.plan.definition.options;
        match choice {
            Choice::Units if self.plan.job.units == Units::Inches => Section::UnitsInches,
            Choice::Units => Section::UnitsMm,
            Choice::ArcCentre if options.absolute_centres => Section::ArcCenterAbsolute,
            Choice::ArcCentre => Section::ArcCenterIncremental,
            Choice::LatheX => Section::XModeRadius,
        }
    }

    pub(super) fn write_state(&mut self, state: State) -> WriteResult {
        let operation = self.operation();
        let section = match state {
            State::Velocity
                if self.machine.velocity.replace(operation.velocity) != Some(operation.velocity) =>
            {
                velocity_section(operation.velocity)
            }
            State::WorkPlane if self.machine.plane.replace(operation.plane) != Some(operation.plane) => {
                plane_section(operation.plane)
            }
            State::Spindle if self.plan.options.manual_spindle => return Ok(()),
            State::Spindle if operation.spindle.is_some() && self.machine.spindle != operation.spindle => {
                self.machine.spindle = operation.spindle;
                operation.spindle.map_or(Section::SpindleOff, spindle_section)
            }
            State::Coolant if operation.coolant.is_some() && self.machine.coolant != operation.coolant => {
                self.machine.coolant = operation.coolant;
                operation.coolant.map_or(Section::CoolantOff, coolant_section)
            }
            _ => return Ok(()),
        };
        self.write_section(section)
    }
}

fn velocity_section(mode: VelocityMode) -> Section {
    match mode {
        VelocityMode::ExactStop => Section::VelocityModeExactStop,
        VelocityMode::ConstantVelocity => Section::VelocityModeConstantVelocity,
    }
}

fn plane_section(plane: Plane) -> Section {
    match plane {
        Plane::Xy => Section::WorkPlaneXy,
        Plane::Zx => Section::WorkPlaneXz,
        Plane::Yz => Section::WorkPlaneYz,
    }
}
