//! Macros that depend on the state of the machine: registers, codes, and words written only on changes.

use pathbuild_motion::{Coolant, Plane, Turning};

use super::macros::{Choice, State};
use super::registers::{Code, Form, Register};
use super::section::{Section, coolant_section, spindle_section};
use super::writer::{WriteResult, Writer};
use crate::job::{Units, VelocityMode};
use crate::number::NumberFormat;
use crate::step::Step;

impl Writer<'_> {
    pub(super) fn register(&mut self, register: Register, form: Form) -> WriteResult {
        self.line.asked = true;
        let Some(value) = self.move_values.get(register) else { return Ok(()) };
        let value = match form {
            Form::Always | Form::Changed => value,
            Form::Reversed => -value,
            Form::Positive => value.abs(),
        };
        let text = self.number_format().format(value);
        if form == Form::Changed && self.machine.written(register) == Some(text.as_str()) {
            return Ok(());
        }
        self.line.answered = true;
        if form == Form::Reversed {
            self.line.turned.push(register);
        }
        self.text(&format!("{}{text}", register.letter()))
    }

    pub(super) fn speed(&mut self) -> WriteResult {
        match self.operation().speed.filter(|_| !self.plan.options.manual_spindle) {
            Some(speed) => self.text(&format!("S{}", NumberFormat::decimals(0, 0).format(speed))),
            None => Ok(()),
        }
    }

    /// Switches the spindle on and waits for it, unless it already turns as the operation requires.
    pub(super) fn spindle_up(&mut self) -> WriteResult {
        let operation = self.operation();
        let Some(spindle) = operation.spindle.filter(|_| !self.plan.options.manual_spindle) else {
            return Ok(());
        };
        let turns_so = self.machine.speed.is_some() || operation.speed.is_none();
        if self.machine.spindle == Some(spindle)
            && turns_so
            && self.machine.speed == operation.speed.map(f64::round)
        {
            return Ok(());
        }
        self.section(spindle_section(spindle))?;
        if spindle != Turning::Off {
            self.text(" ")?;
            self.speed()?;
        }
        self.end_line();
        self.machine.spindle = Some(spindle);
        let wait = self.plan.options.spin_up;
        if wait > 0.0 && spindle != Turning::Off { self.step(&Step::Dwell { seconds: wait }) } else { Ok(()) }
    }

    pub(super) fn code(&mut self, code: Code, modal: bool) -> WriteResult {
        self.line.code = Some(code);
        if self.plan.definition.section(code.section()).is_blank() {
            self.empty_code = Some(code.section());
        }
        if modal && self.machine.is_in(code) {
            return Ok(());
        }
        self.line.is_in_code = true;
        self.section(code.section())?;
        self.line.is_in_code = false;
        Ok(())
    }

    pub(super) fn named_section(&mut self, section: Section) -> WriteResult {
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
        self.section(section)
    }

    pub(super) fn chosen(&self, choice: Choice) -> Section {
        let options = &self.plan.definition.options;
        match choice {
            Choice::Units if self.plan.job.units == Units::Inches => Section::UnitsInches,
            Choice::Units => Section::UnitsMm,
            Choice::ArcCentre if options.absolute_centres => Section::ArcCenterAbsolute,
            Choice::ArcCentre => Section::ArcCenterIncremental,
            Choice::LatheX => Section::XModeRadius,
        }
    }

    pub(super) fn state(&mut self, state: State) -> WriteResult {
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
        self.section(section)
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
