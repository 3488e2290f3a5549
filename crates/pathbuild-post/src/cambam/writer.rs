//! Expands templates to lines. Each line is read back to update the state of the machine.

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::posts;
use pathbuild_gcode::native::output_too_large_error;

use super::definition::{Plan, macro_in_braces};
use super::machine::{Code, Machine, MoveValues, Register};
use super::macros::{Block, Macro, Value};
use super::options::Options;
use super::section::Section;
use super::template::{Template, TemplatePart};
use crate::arcs::chords;
use crate::findings::{EngineOutput, LineOrigin, OutputBudget};
use crate::job::{Feeds, JobStep, Operation, Tool};
use crate::line_words::{CommentMarks, LineWords, Word, words};
use crate::number::NumberFormat;
use crate::rs274_translation::{MAX_WARNINGS, Rs274Translation};
use crate::target::TextInserter;

/// Success, or the diagnostic that aborts writing.
pub(super) type WriteResult = Result<(), Box<Diagnostic>>;

/// Maximum nesting depth of user macros, and also of sections.
const MAX_DEPTH: usize = 16;

pub(super) struct Writer<'a> {
    pub(super) plan: &'a Plan<'a>,
    pub(super) machine: Machine,
    /// Register values of the current move, in the output unit.
    pub(super) move_values: MoveValues,
    /// Index of the current operation: the first one while the header is written, the last one in the footer.
    operation: usize,
    /// The feeds of each operation, indexed like the job's operations.
    feeds: Vec<Feeds>,
    /// The tool whose number `{$tool.index}` writes.
    pub(super) tool: &'a Tool,
    /// Whether the tool is below the stock surface.
    pub(super) is_cutting: bool,
    /// Section of the last code macro that wrote nothing because this section is empty; `None` if there was no such macro since the current canned
    /// cycle began.
    pub(super) empty_code: Option<Section>,
    warnings: Vec<Diagnostic>,
    pub(super) line: Line,
    lines: Lines<'a>,
    marks: CommentMarks,
    inserter: TextInserter<'a>,
    /// Translation of the lines written so far to the words of RS274.
    translation: Rs274Translation,
    /// For each axis, whether the definition reverses its sign; `None` until the axis has been written.
    reversed: [Option<bool>; 3],
    /// For each axis, the position that the program intends, in the output unit, and the text that was last written for the axis when the
    /// tool reached this position.
    pub(super) intended: [Option<(f64, Option<Box<str>>)>; 3],
    /// The part of the definition being written: a section and a line of its file.
    place: (Section, u32),
    origins: Vec<LineOrigin>,
    /// Least and greatest angle in degrees of paths wrapped around a cylinder.
    pub(super) angles: Option<[f64; 2]>,
    /// The first error found in a line already written. It is returned at the end of the run.
    fault: Option<Box<Diagnostic>>,
    /// Current nesting depth of sections and of user macros, respectively.
    depth: [usize; 2],
    /// The blocks `{$mops}` and `{$blocks}` that are being expanded.
    open: Vec<Block>,
    fuel: OutputBudget,
}

impl<'a> Writer<'a> {
    /// Creates a writer at the start of a program, which must contain operations.
    pub(super) fn new(plan: &'a Plan<'a>) -> Self {
        let marks = plan.definition.comment_marks();
        Self {
            plan,
            machine: Machine::default(),
            move_values: MoveValues::default(),
            operation: 0,
            feeds: plan.job.feeds(),
            tool: &plan.job.operations[0].tool,
            is_cutting: false,
            empty_code: None,
            warnings: Vec::new(),
            line: Line::default(),
            lines: Lines::new(&plan.definition.options),
            inserter: TextInserter::new(plan.target, marks.clone(), plan.options.charset),
            marks,
            translation: Rs274Translation::new(
                plan.job.units,
                plan.definition.options.suppress_parser_errors,
            ),
            reversed: [None; 3],
            intended: [None, None, None],
            place: (Section::PostFile, 0),
            origins: Vec::new(),
            angles: None,
            fault: None,
            depth: [0; 2],
            open: Vec::new(),
            fuel: output_limit(plan),
        }
    }

    /// Writes the whole program. Returns its text, its translation to RS274, and warnings about doubtful constructs.
    pub(super) fn run(mut self) -> Result<EngineOutput, Box<Diagnostic>> {
        self.write_section(Section::PostFile)?;
        self.end_line();
        if let Some(fault) = self.fault {
            return Err(fault);
        }
        if let Some([least, most]) = self.angles.filter(|[least, most]| most - least > FULL_TURN) {
            self.warn(Diagnostic::new(&posts::WRAPPED_TWICE).with("degrees", most - least));
        }
        if self.angles.is_some() {
            self.warn(Diagnostic::new(&posts::WRAPPED_FEED));
        }
        for (axis, _) in
            Register::AXES.into_iter().zip(self.reversed).filter(|(_, reversed)| *reversed == Some(true))
        {
            self.warn(Diagnostic::new(&posts::AXIS_REVERSED).quoting("axis", axis.letter().to_string()));
        }
        let Self { lines, translation, origins, warnings, .. } = self;
        let (text, translation) = (lines.finish().into_bytes(), translation.finish());
        Ok(EngineOutput { text, translation, origins, warnings, ..EngineOutput::default() })
    }

    pub(super) fn feeds(&self) -> Feeds {
        self.feeds[self.operation]
    }

    pub(super) fn operation(&self) -> &'a Operation {
        &self.plan.job.operations[self.operation]
    }

    pub(super) fn number_format(&self) -> NumberFormat {
        self.plan.definition.options.number_format
    }

    pub(super) fn scaled(&self, millimetres: f64) -> f64 {
        millimetres / self.plan.unit()
    }

    pub(super) fn length(&self, millimetres: f64) -> String {
        self.number_format().format(self.scaled(millimetres))
    }

    pub(super) fn write_section(&mut self, section: Section) -> WriteResult {
        self.write_template(self.plan.definition.section(section))
    }

    pub(super) fn write_template(&mut self, template: &'a Template) -> WriteResult {
        let kind = usize::from(matches!(template.section, Section::UserMacro | Section::ConfiguredMacro));
        if self.depth[kind] == MAX_DEPTH {
            let diagnostic = Diagnostic::new(&posts::MACRO_DEPTH).with("limit", MAX_DEPTH);
            return Err(Box::new(self.plan.locate(diagnostic, template.section, 0)));
        }
        self.depth[kind] += 1;
        for piece in &template.pieces {
            match piece {
                TemplatePart::Text { text, line } => {
                    self.record_origin(template.section, *line);
                    self.write_text(text)?;
                }
                TemplatePart::Macro { what, line } => {
                    self.record_origin(template.section, *line);
                    self.write_macro(what, template.section, *line)?;
                }
            }
        }
        self.depth[kind] -= 1;
        Ok(())
    }

    /// Records which part of the definition is being written. Words within a line are attributed to the section that contains the line.
    fn record_origin(&mut self, section: Section, line: u32) {
        if section.holds_lines() {
            self.place = (section, line);
        }
    }

    fn write_macro(&mut self, what: &'a Macro, section: Section, line: u32) -> WriteResult {
        self.fuel.spend(1, self.plan.file)?;
        match what {
            Macro::Section(text) => self.write_named_section(*text),
            Macro::Value(value) if value.may_be_missing() && self.plan.user_macro(value.name()).is_some() => {
                self.plan.user_macro(value.name()).map_or(Ok(()), |own| self.write_template(own))
            }
            Macro::Value(Value::ToolIndex) if !self.tool.is_named => {
                self.line.lacks_tool_number = true;
                Ok(())
            }
            Macro::Value(value) => match self.value(*value) {
                Some(text) if value.is_text() => self.write_foreign_text(&text, value.name(), section, line),
                Some(text) => self.write_text(&text),
                None => self.handle_missing_value(*value, section, line),
            },
            Macro::Register(register, form) => self.write_register(*register, *form),
            Macro::Speed => self.write_speed(),
            Macro::SpindleUp => self.spindle_up(),
            Macro::Code { code, modal } => self.write_code(*code, *modal),
            Macro::Choice(choice) => self.write_section(self.section_of_choice(*choice)),
            Macro::State(state) => self.write_state(*state),
            Macro::Block(block @ (Block::Mops | Block::Blocks)) => self.write_program(*block, section, line),
            Macro::Block(block) => self.write_block(*block),
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
                Some(text) => self.write_template(text),
                None => Ok(()),
            },
        }
    }

    /// Expands `{$mops}` to all operations, or `{$blocks}` to the moves of the current one. Neither may occur within its own expansion.
    fn write_program(&mut self, block: Block, section: Section, line: u32) -> WriteResult {
        if self.open.contains(&block) {
            let name = if block == Block::Mops { "mops" } else { "blocks" };
            let diagnostic =
                Diagnostic::new(&posts::BLOCK_WITHIN_ITSELF).quoting("macro", macro_in_braces(name));
            return Err(Box::new(self.plan.locate(diagnostic, section, line)));
        }
        self.open.push(block);
        let written = self.write_block(block);
        self.open.pop();
        written
    }

    fn write_block(&mut self, block: Block) -> WriteResult {
        match block {
            Block::Mops => self.write_operations(),
            Block::Blocks => self.blocks(),
            Block::ToolTable => self.write_tool_table(),
            Block::ToolChange => self.write_tool_change(&self.operation().tool),
            Block::FirstToolChange => self.write_tool_change(&self.plan.job.operations[0].tool),
            Block::Clearance => self.move_to_clearance(),
            Block::FileHeader => {
                let remarks = &self.plan.job.remarks;
                remarks.iter().try_for_each(|remark| self.write_comment(remark, ""))
            }
            Block::FileFooter | Block::MopHeader | Block::MopFooter => Ok(()),
        }
    }

    fn write_operations(&mut self) -> WriteResult {
        for index in 0..self.plan.job.operations.len() {
            self.operation = index;
            self.tool = &self.operation().tool;
            self.write_section(Section::Mop)?;
            self.end_line();
        }
        Ok(())
    }

    fn write_tool_table(&mut self) -> WriteResult {
        let present = self.tool;
        for tool in self.plan.job.tools().into_iter().filter(|tool| tool.is_named) {
            self.tool = tool;
            self.write_section(Section::ToolTableItem)?;
            self.end_line();
        }
        self.tool = present;
        Ok(())
    }

    fn write_tool_change(&mut self, tool: &'a Tool) -> WriteResult {
        if self.machine.tool == Some(tool.index) || !tool.is_named {
            return Ok(());
        }
        let present = std::mem::replace(&mut self.tool, tool);
        self.write_section(Section::ToolChange)?;
        self.tool = present;
        Ok(())
    }

    /// Adds text to the current line. A line break in the text ends the line.
    pub(super) fn write_text(&mut self, text: &str) -> WriteResult {
        self.fuel.spend(text.len(), self.plan.file)?;
        let most = self.plan.options.most_bytes;
        // The exact length is not known yet, because blanks of the current line may still be removed.
        if self.lines.length().max(self.line.text.len() + text.len()) > most {
            return Err(output_too_large_error(most));
        }
        let mut parts = text.split('\n');
        self.push(parts.next().unwrap_or(""));
        for part in parts {
            self.end_line();
            if self.place.1 > 0 {
                self.place.1 += 1;
            }
            self.push(part);
        }
        Ok(())
    }

    fn push(&mut self, text: &str) {
        if self.line.origin.is_none() && !text.trim().is_empty() {
            self.line.origin = Some(self.place);
        }
        self.line.push(text);
    }

    /// Adds a text from a drawing, file name or option in such a way that no control executes any part of it.
    pub(super) fn write_foreign_text(
        &mut self,
        text: &str,
        name: &str,
        section: Section,
        line: u32,
    ) -> WriteResult {
        let Some(text) = self.inserter.inserted_form(&self.line.text, text) else {
            let diagnostic = Diagnostic::new(&posts::TEXT_AMONG_WORDS)
                .quoting("macro", macro_in_braces(name))
                .quoting("text", text);
            return Err(Box::new(self.plan.locate(diagnostic, section, line)));
        };
        self.write_text(&text)
    }

    /// Writes a comment on a line of its own.
    pub(super) fn write_comment(&mut self, text: &str, blank: &str) -> WriteResult {
        self.place = (Section::Comment, 0);
        self.write_section(Section::Comment)?;
        self.write_text(blank)?;
        self.write_foreign_text(text, "endcomment", Section::Comment, 0)?;
        self.write_text(blank)?;
        self.write_section(Section::EndComment)?;
        self.end_line();
        Ok(())
    }

    /// Ends the current line. A line that is blank, requires a tool number that the program lacks, or is a move that moves nothing is dropped; any
    /// other line is read back and added to the output.
    pub(super) fn end_line(&mut self) {
        let line = std::mem::take(&mut self.line);
        let text = collapse(&line.text);
        let is_idle = line.has_register_macro && !line.has_register_word && self.is_motion_alone(&line.rest);
        if text.is_empty() || is_idle || line.lacks_tool_number {
            return;
        }
        let code = self.plan.target.map_or(text.len(), |target| target.code_length(&text));
        let found = words(&text[..code], &self.marks);
        self.check_replaced(&found, &text);
        self.machine.read(&found, line.code, self.number_format());
        let unusual_number_prefix =
            self.lines.is_numbered(&text).then(|| self.lines.options.numbering.unusual_number_prefix());
        let program_words = LineWords {
            unusual_number_prefix: unusual_number_prefix.flatten().or(found.unusual_number_prefix),
            words: found.words.iter().map(|word| self.program_word(*word, &line)).collect(),
            ..found
        };
        let has_word = |(_, section): &Code| !self.plan.definition.section(*section).is_blank();
        self.translation.line(
            &text,
            &program_words,
            line.code.filter(has_word).map(|(number, _)| number),
            self.reversed[0] != self.reversed[1],
        );
        let (section, line) = line.origin.unwrap_or(self.place);
        self.origins.push(LineOrigin { section: section.name(), line });
        self.lines.push(&text);
    }

    /// Checks that a line does not move an axis that the definition replaces by an angle.
    fn check_replaced(&mut self, found: &LineWords, line: &str) {
        let rotary = self.plan.definition.options.rotary;
        let axis = Register::AXES[1 - rotary.along].letter();
        if rotary.wrap && self.fault.is_none() && found.words.iter().any(|word| word.letter == axis) {
            let diagnostic = Diagnostic::new(&posts::REPLACED_AXIS_WRITTEN).quoting("axis", axis.to_string());
            let diagnostic = diagnostic.quoting("angle", ROTARY[rotary.letter].letter().to_string());
            self.fault = Some(Box::new(diagnostic.quoting("line", line).in_file(self.plan.file)));
        }
    }

    /// Converts a word back to the axis and sign that it had in the program before the template wrapped or reversed it. The first line that writes an
    /// axis decides whether the axis, with the centres of arcs along it, is reversed in all lines: a definition that reverses it only in some lines
    /// would move the machine to both sides. Feeds, dwells and pecks are left as they are, because no machine has them with the opposite sign.
    fn program_word(&mut self, word: Word, line: &Line) -> Word {
        let Some(register) = Register::of(word.letter) else { return word };
        let rotary = self.plan.definition.options.rotary;
        if rotary.wrap && register == ROTARY[rotary.letter] {
            let across = word.number.to_radians() * self.scaled(self.operation().surface);
            return Word { letter: Register::AXES[1 - rotary.along].letter(), number: across };
        }
        let is_reversed = line.reversed.contains(&register);
        let is_reversed = match register {
            Register::X | Register::I => *self.reversed[0].get_or_insert(is_reversed),
            Register::Y | Register::J => *self.reversed[1].get_or_insert(is_reversed),
            Register::Z | Register::K => *self.reversed[2].get_or_insert(is_reversed),
            // In a cycle, R is a height.
            Register::R => is_reversed && self.reversed[2] == Some(true),
            _ => false,
        };
        Word { number: if is_reversed { -word.number } else { word.number }, ..word }
    }

    /// Whether `rest`, the part of a line outside code macros, contains nothing but motion words and feeds.
    fn is_motion_alone(&self, rest: &str) -> bool {
        let found = words(rest, &self.marks);
        found.foreign.is_none()
            && found.words.iter().all(|word| match word.letter {
                'G' => (0.0..=3.0).contains(&word.number),
                letter => letter == 'F',
            })
    }

    /// Adds a warning, unless the same one was added before.
    pub(super) fn warn(&mut self, warning: Diagnostic) {
        let warning = warning.in_file(self.plan.file);
        if !self.warnings.contains(&warning) && self.warnings.len() < MAX_WARNINGS {
            self.warnings.push(warning);
        }
    }
}

/// Registers of the angles around X, Y and Z.
pub(super) const ROTARY: [Register; 3] = [Register::A, Register::B, Register::C];

/// Maximum angle in degrees of a path wrapped around a cylinder; wider paths would overlap themselves. It allows for rounding: a closed
/// ring may exceed a full turn slightly.
const FULL_TURN: f64 = 360.001;

/// The line that is being written.
#[derive(Debug, Default)]
#[expect(clippy::struct_excessive_bools, reason = "facts that do not depend on each other")]
pub(super) struct Line {
    pub(super) text: String,
    /// The part of `text` that does not come from macros of motion codes.
    pub(super) rest: String,
    /// Whether the text being added comes from a macro of a motion code.
    pub(super) is_in_code: bool,
    /// Whether a register macro was expanded in the line, even to nothing.
    pub(super) has_register_macro: bool,
    /// Whether a register macro wrote a word. If none did although one was expanded, the line moves nothing.
    pub(super) has_register_word: bool,
    /// Registers written with reversed sign.
    pub(super) reversed: Vec<Register>,
    /// The motion of a code macro in this line.
    pub(super) code: Option<Code>,
    /// Section and line of the definition's file where the line begins.
    pub(super) origin: Option<(Section, u32)>,
    /// Whether the line requires a tool number that the program does not have. Such lines are not written.
    lacks_tool_number: bool,
    /// Set if something was omitted at the end of `text`; the value is whether blanks preceded it.
    gap: Option<bool>,
}

impl Line {
    /// Adds text without line breaks.
    pub(super) fn push(&mut self, text: &str) {
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

    /// Removes the blanks at the end of the line, where a macro was omitted. The blanks after the macro are dropped as well; one blank remains if
    /// there were blanks on both sides.
    pub(super) fn omit_value(&mut self) {
        let length = self.text.trim_end_matches([' ', '\t']).len();
        self.gap = Some(length < self.text.len());
        self.text.truncate(length);
    }
}

/// Replaces each run of blanks by one blank and removes those at both ends.
fn collapse(text: &str) -> String {
    text.split([' ', '\t', '\r']).filter(|part| !part.is_empty()).collect::<Vec<_>>().join(" ")
}

/// The lines of the output, with their numbers and line ends.
#[derive(Debug)]
pub(super) struct Lines<'a> {
    options: &'a Options,
    text: String,
    next_number: u64,
}

impl<'a> Lines<'a> {
    pub(super) fn new(options: &'a Options) -> Self {
        Self { options, text: String::new(), next_number: options.numbering.start.into() }
    }

    /// Adds a line, which must not be blank.
    pub(super) fn push(&mut self, line: &str) {
        if self.is_numbered(line) {
            self.push_number();
        }
        self.text.push_str(line);
        self.text.push_str(&self.options.end_of_line);
    }

    fn is_numbered(&self, line: &str) -> bool {
        self.options.add_line_numbers
            && !line.starts_with(|first| self.options.numbering.skip.contains(first))
    }

    fn push_number(&mut self) {
        let numbering = &self.options.numbering;
        self.text.push_str(&numbering.prefix);
        self.text.push_str(&numbering.format.format(self.next_number as f64));
        if numbering.space_after {
            self.text.push(' ');
        }
        self.next_number += u64::from(numbering.increment);
    }

    /// Returns the length of the text written so far in bytes.
    pub(super) fn length(&self) -> usize {
        self.text.len()
    }

    pub(super) fn finish(self) -> String {
        if self.options.upper_case { self.text.to_uppercase() } else { self.text }
    }
}

/// Returns the limit on the number of bytes written, which depends on the number of moves. Each expansion of a macro counts as one more byte, so that
/// macros that write nothing are limited as well.
fn output_limit(plan: &Plan<'_>) -> OutputBudget {
    let moves = |operation: &Operation| -> usize {
        let of_steps: usize = operation.steps.iter().map(|step| moves_of(step, plan)).sum();
        of_steps + 1
    };
    OutputBudget::new(plan.job.operations.iter().map(moves).sum())
}

/// Returns the maximum number of moves that a step of the job can become.
fn moves_of(step: &JobStep, plan: &Plan<'_>) -> usize {
    match step {
        JobStep::Move(movement) => {
            let count = movement.course().and_then(|course| chords(&course, plan.arc_tolerance()));
            count.map_or(1, |count| count as usize)
        }
        JobStep::Hole(hole) => hole.moves().map_or(1, |moves| moves.len()),
        _ => 1,
    }
}
