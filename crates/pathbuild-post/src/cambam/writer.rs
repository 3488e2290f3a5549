//! Expanding templates into lines, and reading every line back into the state of the machine.

use pathbuild_diagnostic::{Diagnostic, messages::posts};

use super::fuel::fuel;
use super::line::{Line, collapse};
use super::lines::Lines;
use super::machine::Machine;
use super::macros::{Block, Macro};
use super::move_values::MoveValues;
use super::plan::Plan;
use super::section::Section;
use super::template::{Piece, Template};
use super::words::{CommentMarks, words};
use crate::job::{Operation, Tool};
use crate::number::NumberFormat;

/// Success, or the diagnostic that ends the writing.
pub(super) type Written = Result<(), Box<Diagnostic>>;

/// User macros may contain each other so deep, and sections as well.
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
    warnings: Vec<Diagnostic>,
    pub(super) line: Line,
    lines: Lines<'a>,
    marks: CommentMarks,
    /// Sections that contain each other at this moment, and user macros.
    depth: [usize; 2],
    fuel: usize,
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
            depth: [0; 2],
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
        let kind = usize::from(template.section == Section::UserMacro);
        if self.depth[kind] == MOST_DEPTH {
            let diagnostic = Diagnostic::new(&posts::MACRO_DEPTH).with("limit", MOST_DEPTH);
            return Err(Box::new(self.plan.locate(diagnostic, template.section, 0)));
        }
        self.depth[kind] += 1;
        for piece in &template.pieces {
            match piece {
                Piece::Text(text) => self.text(text)?,
                Piece::Macro { what, line } => self.expand(what, template.section, *line)?,
            }
        }
        self.depth[kind] -= 1;
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
            Macro::SetTool => {
                self.machine.change_tool(self.tool.index);
                Ok(())
            }
            Macro::User(name) => match self.plan.user_macro(name) {
                Some(text) => self.template(text),
                None => Ok(()),
            },
        }
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

    /// Whether a line has nothing but words for motions, and a feed that the template itself has.
    fn is_motion_alone(&self, rest: &str) -> bool {
        let found = words(rest, &self.marks);
        !found.has_more
            && found.words.iter().all(|word| match word.letter {
                'G' => (0.0..=3.0).contains(&word.number),
                letter => letter == 'F',
            })
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

/// Nobody reads more of them.
const MOST_WARNINGS: usize = 50;
