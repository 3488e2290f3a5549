//! Executes control texts: replaces variables, then statements, and collects the resulting lines. The caller sets the variables.

use std::ops::Range;

use camino::Utf8Path;
use pathbuild_diagnostic::messages::posts;
use pathbuild_diagnostic::{Diagnostic, Lang, nearest};
use pathbuild_gcode::native::output_too_large_error;

use super::control_text::{ControlText, ControlTextKind};
use super::definition::Definition;
use super::evaluate::{Environment, EvaluatedText, ResultLine, run};
use super::expand::Expanded;
use super::variables::{VARIABLES, Variable, Variables, byte_of};
use crate::PostFiles;
use crate::cad6::control_text::locate;
use crate::cad6::term::Fault;
use crate::findings::{EngineOutput, LineOrigin, OutputBudget};
use crate::job::Units;
use crate::rs274_translation::MAX_WARNINGS;
use crate::target::TextInserter;

/// Success, or the diagnostic that aborts writing.
pub(super) type RunResult = Result<(), Box<Diagnostic>>;

/// Control text that prefixes each line if the definition has none for line numbers.
const LINE_NUMBER: &str = "N{#~LineNumber~} {=LineNumber{#~LineNumber~+10}}";

pub(super) struct Runner<'a> {
    pub(super) definition: &'a Definition,
    file: &'a Utf8Path,
    files: &'a dyn PostFiles,
    pub(super) variables: Variables,
    line_number: ControlText,
    inserter: TextInserter<'a>,
    text: Vec<u8>,
    most_bytes: usize,
    /// Number of bytes that texts may still produce, not counting inserted files.
    fuel: OutputBudget,
    pub(super) warnings: Vec<Diagnostic>,
    pub(super) called: Vec<ControlTextKind>,
    origins: Vec<LineOrigin>,
}

impl<'a> Runner<'a> {
    pub(super) fn new(
        definition: &'a Definition,
        file: &'a Utf8Path,
        files: &'a dyn PostFiles,
        inserter: TextInserter<'a>,
        most_bytes: usize,
    ) -> Self {
        let aliases = definition.aliases.iter().map(|(other, own)| (&**other, &**own));
        let default = ControlText { text: LINE_NUMBER.to_owned(), begins: None };
        Self {
            definition,
            file,
            files,
            variables: Variables::new(aliases),
            line_number: definition.text(ControlTextKind::LineNumber).cloned().unwrap_or(default),
            inserter,
            text: Vec::new(),
            most_bytes,
            fuel: OutputBudget::new(0),
            warnings: Vec::new(),
            called: Vec::new(),
            origins: Vec::new(),
        }
    }

    /// Calls a control text, if the definition has it, and adds the resulting lines.
    pub(super) fn call(&mut self, kind: ControlTextKind) -> RunResult {
        let Some(text) = self.definition.text(kind) else { return Ok(()) };
        self.fuel.add_steps(1);
        if !self.called.contains(&kind) {
            self.called.push(kind);
        }
        for line in self.evaluate(kind, text)? {
            let before = self.text.len();
            self.line(&line, kind)?;
            let origin = LineOrigin { section: kind.name(), line: line.origin };
            let count = line_ends(&self.text[before..]);
            self.origins.extend(std::iter::repeat_n(origin, count));
        }
        Ok(())
    }

    fn line(&mut self, line: &ResultLine, kind: ControlTextKind) -> RunResult {
        let text =
            if self.definition.settings.trim { line.text.trim_end_matches([' ', '\t']) } else { &line.text };
        if line.has_statement && text.is_empty() {
            return Ok(());
        }
        self.fuel.spend(if line.is_inserted { 0 } else { text.len() }, self.file)?;
        let has_text = text.chars().any(|c| byte_of(c).is_none());
        if self.definition.settings.number_lines && (has_text || !line.is_inserted) && !text.is_empty() {
            self.write_line_number()?;
        }
        self.push(text, kind)?;
        self.text.extend_from_slice(self.definition.settings.end_of_line.as_bytes());
        if self.text.len() > self.most_bytes { Err(output_too_large_error(self.most_bytes)) } else { Ok(()) }
    }

    fn write_line_number(&mut self) -> RunResult {
        let text = self.line_number.clone();
        for line in self.evaluate(ControlTextKind::LineNumber, &text)? {
            self.fuel.spend(line.text.len(), self.file)?;
            self.push(&line.text, ControlTextKind::LineNumber)?;
        }
        Ok(())
    }

    /// Adds a line. Texts from drawings and options are inserted in such a way that no control acts on them.
    fn push(&mut self, line: &str, kind: ControlTextKind) -> RunResult {
        let mut before = String::new();
        for c in line.chars() {
            if let Some(text) = self.variables.text(c) {
                let Some(text) = self.inserter.inserted_form(&before, text) else {
                    let diagnostic =
                        Diagnostic::new(&posts::TEXT_AMONG_WORDS).quoting("section", kind.name());
                    return Err(Box::new(
                        diagnostic.quoting("macro", "~").quoting("text", text).in_file(self.file),
                    ));
                };
                self.text.extend_from_slice(text.as_bytes());
                before.push_str(&text);
            } else if let Some(byte) = byte_of(c) {
                self.text.push(byte);
            } else {
                self.text.extend_from_slice(c.encode_utf8(&mut [0; 4]).as_bytes());
                before.push(c);
            }
        }
        Ok(())
    }

    /// Expands and evaluates a control text, the two phases of a call.
    fn evaluate(
        &mut self,
        kind: ControlTextKind,
        text: &ControlText,
    ) -> Result<Vec<ResultLine>, Box<Diagnostic>> {
        let expanded =
            Expanded::new(&text.text, &self.variables).map_err(|fault| self.report(*fault, kind, text))?;
        let environment = Environment {
            variables: &mut self.variables,
            decimals: self.definition.settings.decimals,
            files: self.files,
        };
        let EvaluatedText { lines, doubts } = run(&expanded, environment).map_err(|mut fault| {
            fault.span = range_in_control_text(&expanded, &fault.span, text.text.len());
            self.report(*fault, kind, text)
        })?;
        for (at, doubt) in doubts {
            let at = expanded.origin(at);
            self.warn(locate(Diagnostic::new(doubt), kind, text, at..at + 1, self.file));
        }
        Ok(with_origins(lines, &expanded, text))
    }

    fn warn(&mut self, doubt: Diagnostic) {
        if self.warnings.len() < MAX_WARNINGS && !self.warnings.contains(&doubt) {
            self.warnings.push(doubt);
        }
    }

    fn report(&self, fault: Fault, kind: ControlTextKind, text: &ControlText) -> Box<Diagnostic> {
        let Fault { span, mut diagnostic } = fault;
        if diagnostic.message == &posts::VARIABLE_UNDEFINED
            && let Some((_, name)) = diagnostic.arguments.first()
        {
            let name = name.render(Lang::En);
            let others = VARIABLES.iter().map(|known| known.name).filter(|known| *known != name);
            diagnostic =
                diagnostic.suggest_nearest(&posts::VARIABLE_UNDEFINED_NEAREST, nearest(&name, others));
            if text.text.contains(&format!("{{={name}")) {
                diagnostic.message = &posts::VARIABLE_UNDEFINED_YET;
            } else if let Some(variable) = Variable::by_name(self.variables.own_name(&name)) {
                diagnostic.message = &posts::VARIABLE_WITHOUT_VALUE;
                diagnostic = diagnostic.with("reason", variable.reason());
            }
        }
        Box::new(locate(diagnostic, kind, text, span, self.file))
    }

    /// Returns the output. `units` are the units of the job.
    pub(super) fn finish(self, units: Units) -> EngineOutput {
        let Self { text, origins, warnings, .. } = self;
        let translation = super::translate(self.definition, &text, units);
        EngineOutput { text, translation, origins, warnings, ..EngineOutput::default() }
    }
}

/// Adds to each line of a result the number of the definition's line that produced it.
fn with_origins(mut lines: Vec<ResultLine>, expanded: &Expanded, text: &ControlText) -> Vec<ResultLine> {
    let Some((first, _)) = text.begins else { return lines };
    let ends: Vec<usize> = text.text.match_indices('\n').map(|(at, _)| at).collect();
    for line in &mut lines {
        let at = expanded.origin(line.begins);
        let before = ends.partition_point(|end| *end < at);
        line.origin = first + u32::try_from(before).unwrap_or(0);
    }
    lines
}

fn line_ends(text: &[u8]) -> usize {
    memchr::memchr_iter(b'\n', text).count()
}

/// Converts a range of the expanded text to one of the control text.
fn range_in_control_text(expanded: &Expanded, span: &Range<usize>, length: usize) -> Range<usize> {
    let start = expanded.origin(span.start).min(length);
    let end = expanded.origin(span.end.max(span.start + 1) - 1).min(length);
    start..(end + 1).max(start)
}
