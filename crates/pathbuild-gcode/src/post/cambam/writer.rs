//! Expanding templates into lines, and reading every line back into the state of the machine.

use pathbuild_diagnostic::{Diagnostic, messages::posts};

use super::lines::Lines;
use super::machine::Machine;
use super::macros::{Block, Choice, Code, Form, Macro, Register, State, coolant_section, spindle_section};
use super::plan::Plan;
use super::section::Section;
use super::template::{Piece, Template};
use super::words::{CommentMarks, words};
use crate::post::arcs::Polar;
use crate::post::holes;
use crate::post::job::{Operation, Plane, Spindle, Step, Tool, Units, VelocityMode};
use crate::post::number::NumberFormat;

/// Success, or the diagnostic that ends the writing.
pub(super) type Written = Result<(), Box<Diagnostic>>;

/// Sections and macros may contain each other so deep.
const MOST_DEPTH: usize = 16;

/// Writes one program.
pub(super) struct Writer<'a> {
    pub(super) plan: &'a Plan<'a>,
    pub(super) machine: Machine,
    /// The numbers of the present move, in the unit that is written.
    pub(super) move_values: MoveValues,
    /// Index of the present operation; the first in the header, the last in the footer.
    operation: usize,
    /// The tool that `{$tool.index}` means.
    pub(super) tool: &'a Tool,
    /// The tool is below the stock surface.
    pub(super) is_cutting: bool,
    /// A code macro whose section is empty was met since this was last reset.
    pub(super) empty_code: Option<Section>,
    pub(super) warnings: Vec<Diagnostic>,
    line: Line,
    lines: Lines<'a>,
    marks: CommentMarks,
    depth: usize,
    fuel: usize,
}

/// The numbers that registers have in a move.
#[derive(Debug, Default)]
pub(super) struct MoveValues {
    registers: [Option<f64>; Register::ALL.len()],
    /// The arc that the move is.
    pub(super) arc: Option<ArcValues>,
}

/// The numbers of an arc: a length in the unit that is written, and degrees.
#[derive(Clone, Copy, Debug)]
pub(super) struct ArcValues {
    pub(super) radius: f64,
    pub(super) start: f64,
    pub(super) end: f64,
    /// Clockwise is positive.
    pub(super) sweep: f64,
}

impl MoveValues {
    pub(super) fn get(&self, register: Register) -> Option<f64> {
        self.registers[register as usize]
    }

    pub(super) fn set(&mut self, register: Register, value: Option<f64>) {
        self.registers[register as usize] = value;
    }
}

/// The line that is being written.
#[derive(Debug, Default)]
struct Line {
    text: String,
    /// What did not come from macros of motion codes.
    rest: String,
    /// What is added comes from such a macro.
    is_in_code: bool,
    /// A register was asked for.
    asked: bool,
    /// A register was written.
    answered: bool,
    /// The motion that a macro stood for.
    code: Option<Code>,
    /// Something was left out at the end of the text; whether blanks stood before it.
    gap: Option<bool>,
}

impl<'a> Writer<'a> {
    /// A writer at the start of a program that has operations.
    pub(super) fn new(plan: &'a Plan<'a>) -> Self {
        let mut writer = Self {
            plan,
            machine: Machine::default(),
            move_values: MoveValues::default(),
            operation: 0,
            tool: &plan.job.operations[0].tool,
            is_cutting: false,
            empty_code: None,
            warnings: Vec::new(),
            line: Line::default(),
            lines: Lines::new(&plan.definition.options),
            marks: CommentMarks { open: String::new(), close: String::new() },
            depth: 0,
            fuel: fuel(plan),
        };
        writer.marks = CommentMarks {
            open: writer.marks_of(Section::Comment),
            close: writer.marks_of(Section::EndComment),
        };
        writer
    }

    fn marks_of(&self, section: Section) -> String {
        let literal = |piece: &Piece| match piece {
            Piece::Text(text) => text.to_string(),
            Piece::Macro { .. } => String::new(),
        };
        let text: String = self.plan.definition.section(section).pieces.iter().map(literal).collect();
        text.trim().to_owned()
    }

    /// The text of the whole file, and what is doubtful in it.
    pub(super) fn run(mut self) -> Result<(String, Vec<Diagnostic>), Box<Diagnostic>> {
        self.section(Section::PostFile)?;
        self.end_line();
        Ok((self.lines.finish(), self.warnings))
    }

    /// The present operation.
    pub(super) fn operation(&self) -> &'a Operation {
        &self.plan.job.operations[self.operation]
    }

    pub(super) fn number_format(&self) -> NumberFormat {
        self.plan.definition.options.number_format
    }

    /// A length or feed in the unit that is written.
    pub(super) fn scaled(&self, millimetres: f64) -> f64 {
        millimetres / self.plan.unit()
    }

    /// A length as it is written.
    pub(super) fn length(&self, millimetres: f64) -> String {
        self.number_format().format(self.scaled(millimetres))
    }

    pub(super) fn section(&mut self, section: Section) -> Written {
        self.template(self.plan.definition.section(section))
    }

    pub(super) fn template(&mut self, template: &'a Template) -> Written {
        if self.depth == MOST_DEPTH {
            let diagnostic = Diagnostic::new(&posts::MACRO_DEPTH).with("limit", MOST_DEPTH);
            return Err(Box::new(self.plan.locate(diagnostic, template.section, 0)));
        }
        self.depth += 1;
        for piece in &template.pieces {
            match piece {
                Piece::Text(text) => self.text(text)?,
                Piece::Macro { what, line } => self.expand(what, template.section, *line)?,
            }
        }
        self.depth -= 1;
        Ok(())
    }

    fn expand(&mut self, what: &'a Macro, section: Section, line: u32) -> Written {
        self.burn(1)?;
        match what {
            Macro::Section(text) => self.named_section(*text),
            Macro::Value(value) => match self.value(*value) {
                Some(text) => self.text(&text),
                None => self.without_value(*value, section, line),
            },
            Macro::Register(register, form) => self.register(*register, *form),
            Macro::Speed => self.speed(),
            Macro::Code { code, modal } => self.code(*code, *modal),
            Macro::Choice(choice) => self.section(self.chosen(*choice)),
            Macro::State(state) => self.state(*state),
            Macro::Block(block) => self.block(*block),
            Macro::Check(target) => self.check_macro(*target),
            Macro::Set(register, value) => {
                let text = value.map(|value| self.number_format().format(value));
                self.machine.set(*register, text);
                Ok(())
            }
            Macro::User(name) => match self.plan.user_macro(name) {
                Some(text) => self.template(text),
                None => Ok(()),
            },
        }
    }

    fn named_section(&mut self, section: Section) -> Written {
        match section {
            Section::SpindleCw => self.machine.spindle = Some(Spindle::Clockwise),
            Section::SpindleCcw => self.machine.spindle = Some(Spindle::CounterClockwise),
            Section::SpindleOff => self.machine.spindle = Some(Spindle::Off),
            _ => {}
        }
        self.section(section)
    }

    fn register(&mut self, register: Register, form: Form) -> Written {
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
        self.text(&format!("{}{text}", register.letter()))
    }

    fn speed(&mut self) -> Written {
        match self.operation().speed {
            Some(speed) => self.text(&format!("S{}", NumberFormat::decimals(0, 0).format(speed))),
            None => Ok(()),
        }
    }

    fn code(&mut self, code: Code, modal: bool) -> Written {
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

    fn chosen(&self, choice: Choice) -> Section {
        let options = &self.plan.definition.options;
        match choice {
            Choice::Units if self.plan.job.units == Units::Inches => Section::UnitsInches,
            Choice::Units => Section::UnitsMm,
            Choice::ArcCentre if options.absolute_centres => Section::ArcCenterAbsolute,
            Choice::ArcCentre => Section::ArcCenterIncremental,
            Choice::LatheX if options.lathe_diameter => Section::XModeDiameter,
            Choice::LatheX => Section::XModeRadius,
        }
    }

    fn state(&mut self, state: State) -> Written {
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

    fn block(&mut self, block: Block) -> Written {
        match block {
            Block::Mops => self.mops(),
            Block::Blocks => self.blocks(),
            Block::ToolTable => self.tool_table(),
            Block::ToolChange => self.tool_change(&self.operation().tool),
            Block::FirstToolChange => self.tool_change(&self.plan.job.operations[0].tool),
            Block::Clearance => self.clearance(),
            Block::FileHeader => self.template(&self.plan.texts.header),
            Block::FileFooter => self.template(&self.plan.texts.footer),
            Block::MopHeader => self.template(&self.plan.operation_texts[self.operation].header),
            Block::MopFooter => self.template(&self.plan.operation_texts[self.operation].footer),
        }
    }

    fn mops(&mut self) -> Written {
        for index in 0..self.plan.job.operations.len() {
            self.operation = index;
            self.tool = &self.operation().tool;
            self.section(Section::Mop)?;
            self.end_line();
        }
        Ok(())
    }

    fn tool_table(&mut self) -> Written {
        let present = self.tool;
        for tool in self.plan.job.tools() {
            self.tool = tool;
            self.section(Section::ToolTableItem)?;
            self.end_line();
        }
        self.tool = present;
        Ok(())
    }

    fn tool_change(&mut self, tool: &'a Tool) -> Written {
        if self.machine.tool == Some(tool.index) {
            return Ok(());
        }
        let present = std::mem::replace(&mut self.tool, tool);
        self.section(Section::ToolChange)?;
        self.tool = present;
        Ok(())
    }

    /// Adds text to the line; a line feed ends it.
    pub(super) fn text(&mut self, text: &str) -> Written {
        self.burn(text.len())?;
        let mut parts = text.split('\n');
        self.line.push(parts.next().unwrap_or(""));
        for part in parts {
            self.end_line();
            self.line.push(part);
        }
        Ok(())
    }

    /// Leaves something out, with the blanks round it.
    pub(super) fn leave_out(&mut self) {
        self.line.leave_out();
    }

    /// Writes the line, unless it is blank or a move that moves nothing, and reads it back.
    pub(super) fn end_line(&mut self) {
        let line = std::mem::take(&mut self.line);
        let text = collapse(&line.text);
        let is_idle = line.asked && !line.answered && self.is_motion_alone(&line.rest);
        if text.is_empty() || is_idle {
            return;
        }
        let found = words(&text, &self.marks);
        if found.has_more && !self.plan.definition.options.suppress_parser_errors {
            self.warn(Diagnostic::new(&posts::LINE_UNREADABLE).with("line", text.as_str()));
        }
        self.machine.read(&found, line.code, self.number_format());
        self.lines.push(&text);
    }

    /// Whether a line has nothing but words for motions.
    fn is_motion_alone(&self, rest: &str) -> bool {
        let found = words(rest, &self.marks);
        !found.has_more
            && found.words.iter().all(|word| word.letter == 'G' && (0.0..=3.0).contains(&word.number))
    }

    /// Says something once.
    pub(super) fn warn(&mut self, warning: Diagnostic) {
        let warning = warning.in_file(self.plan.file);
        if !self.warnings.contains(&warning) && self.warnings.len() < MOST_WARNINGS {
            self.warnings.push(warning);
        }
    }

    /// Pays for text, so that macros that multiply come to an end.
    fn burn(&mut self, cost: usize) -> Written {
        match self.fuel.checked_sub(cost) {
            Some(left) => {
                self.fuel = left;
                Ok(())
            }
            None => Err(Box::new(Diagnostic::new(&posts::MACRO_SIZE).in_file(self.plan.file))),
        }
    }
}

/// Bytes of text that a post may write whatever the program, and more for each of its moves.
const FUEL: usize = 1 << 20;
const FUEL_PER_MOVE: usize = 1 << 12;
/// Nobody reads more of them.
const MOST_WARNINGS: usize = 50;

fn fuel(plan: &Plan<'_>) -> usize {
    let moves = |operation: &Operation| -> usize {
        let of_steps: usize = operation.steps.iter().map(|step| moves_of(step, plan, operation.plane)).sum();
        of_steps + 1
    };
    let moves: usize = plan.job.operations.iter().map(moves).sum();
    FUEL + FUEL_PER_MOVE.saturating_mul(moves)
}

/// How many moves a step can become.
fn moves_of(step: &Step, plan: &Plan<'_>, plane: Plane) -> usize {
    match step {
        Step::Arc(arc) => Polar::of(arc, plane).chords(plan.arc_tolerance()).unwrap_or(1),
        Step::Hole(hole) => holes::moves(hole).map_or(1, |moves| moves.len()),
        _ => 1,
    }
}

impl Line {
    fn push(&mut self, text: &str) {
        if text.is_empty() {
            return;
        }
        let text = match self.gap.take() {
            Some(blank_before) => {
                let after = text.trim_start_matches([' ', '\t']);
                if blank_before && after.len() < text.len() {
                    self.text.push(' ');
                }
                after
            }
            None => text,
        };
        self.text.push_str(text);
        if !self.is_in_code {
            self.rest.push_str(text);
        }
    }

    fn leave_out(&mut self) {
        let length = self.text.trim_end_matches([' ', '\t']).len();
        self.gap = Some(length < self.text.len());
        self.text.truncate(length);
    }
}

/// One blank where there are several, none at the ends.
fn collapse(text: &str) -> String {
    text.split([' ', '\t', '\r']).filter(|part| !part.is_empty()).collect::<Vec<_>>().join(" ")
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
        Plane::Xz => Section::WorkPlaneXz,
        Plane::Yz => Section::WorkPlaneYz,
    }
}
