//! Reads a CamBam definition, an XML file whose elements are templates and options.

use std::collections::{HashMap, HashSet};

use camino::Utf8Path;
use indexmap::IndexMap;
use pathbuild_diagnostic::messages::posts;
use pathbuild_diagnostic::{Diagnostic, Text, nearest};
use roxmltree::{Document, Node, ParsingOptions};

use super::machine::{CODES_WITH_SECTION, Form, Register};
use super::macros::{Macro, MacroArguments, State, Value};
use super::options::{OptionError, Options};
use super::section::Section;
use super::template::{Fault, Template, TemplateError};
use crate::arcs::MAX_CHORD_DISTANCE;
use crate::findings::{Findings, LineStarts, MAX_FINDINGS};
use crate::job::{Job, Units};
use crate::line_words::{CommentMarks, words};
use crate::number::StatedOption;
use crate::target::Target;
use crate::{PostMacro, PostOptions};

#[derive(Clone, Debug)]
pub(crate) struct Definition {
    /// Template of each section; `None` if the file lacks the element, which is different from an empty element.
    sections: Vec<Option<Template>>,
    defaults: Vec<Template>,
    pub(super) options: Options,
    /// The text and the line of each option in the file, by the name of its element.
    stated: HashMap<Box<str>, (Box<str>, u32)>,
    /// User macros by name, in order of definition. The last definition of a name applies.
    macros: IndexMap<Box<str>, Template>,
}

/// Maximum number of XML nodes in a definition. Larger files are refused, because they can only be malicious.
const MAX_XML_ELEMENTS: u32 = 10_000;

impl Definition {
    /// Parses a definition. Also returns warnings, for example about unknown elements.
    pub(crate) fn parse(text: &str, file: &Utf8Path) -> Result<(Self, Vec<Diagnostic>), Vec<Diagnostic>> {
        let limits = ParsingOptions { nodes_limit: MAX_XML_ELEMENTS, ..ParsingOptions::default() };
        let document =
            Document::parse_with_options(text, limits).map_err(|error| vec![syntax_error(&error, file)])?;
        let root = document.root_element();
        if root.tag_name().name() != "PostProcessor" {
            let found = root.tag_name().name();
            return Err(vec![Diagnostic::new(&posts::POST_WRONG_ROOT).quoting("found", found).in_file(file)]);
        }
        let mut reader = CbppReader::new(file, LineStarts::of(text));
        root.children().filter(Node::is_element).for_each(|element| reader.element(element));
        reader.finish()
    }

    pub(crate) fn extension(&self) -> &str {
        &self.options.extension
    }

    pub(crate) fn dialect(&self) -> Option<&str> {
        self.options.dialect.as_deref()
    }

    pub(crate) fn switches_spindle(&self) -> bool {
        let is_spindle =
            |what: &Macro| matches!(what, Macro::State(State::Spindle) | Macro::SpindleUp | Macro::Speed);
        self.templates().flat_map(Template::macros).any(|(what, _)| is_spindle(what))
    }

    pub(crate) fn waits_for_spindle(&self) -> bool {
        self.templates().flat_map(Template::macros).any(|(what, _)| *what == Macro::SpindleUp)
    }

    /// Whether the output axes differ from those of the drawing: wrapped around a cylinder, or with reversed sign.
    pub(crate) fn has_own_axes(&self) -> bool {
        let is_reversed = |what: &Macro| matches!(what, Macro::Register(register, Form::Reversed) if Register::AXES.contains(register));
        self.options.rotary.wrap
            || self.templates().flat_map(Template::macros).any(|(what, _)| is_reversed(what))
    }

    pub(crate) fn writes_absolute_centres(&self) -> bool {
        self.options.absolute_centres
    }

    pub(crate) fn is_wrapped(&self) -> bool {
        self.options.rotary.wrap
    }

    /// Whether the definition never moves in Z but switches a beam on where a cut starts and off where it ends.
    pub(crate) fn is_for_beam(&self) -> bool {
        // A macro of another kind may expand to anything, including a move in Z.
        let is_without_z = |what: &Macro| match what {
            Macro::Register(register, _) | Macro::Value(Value::MoveAxis(register)) => {
                *register != Register::Z
            }
            Macro::Code { .. } | Macro::Speed | Macro::Value(_) => true,
            _ => false,
        };
        let is_for_beam = |section: Section| {
            let text = self.section(section);
            text.macros().all(|(what, _)| is_without_z(what)) && !text.literal().contains(['Z', 'z'])
        };
        [Section::Rapid, Section::FeedMove, Section::ArcCw, Section::ArcCcw].into_iter().all(is_for_beam)
            && [Section::StartCut, Section::EndCut]
                .into_iter()
                .all(|section| !self.section(section).is_blank())
    }

    pub(crate) fn decimals(&self) -> u8 {
        self.options.number_format.most_decimals()
    }

    /// Returns the name of the section for rapid moves, or else of that for feed moves, if its text is empty or only a comment; `None` if both
    /// sections write something.
    pub(crate) fn empty_motion(&self) -> Option<&'static str> {
        let is_mark = |what: &Macro| matches!(what, Macro::Section(Section::Comment | Section::EndComment));
        let is_empty = |section: &Section| {
            let text = self.section(*section);
            let marks = text.macros().filter(|(what, _)| is_mark(what)).count();
            let found = words(&text.literal(), &self.comment_marks());
            marks == text.macros().count() && found.words.is_empty() && (marks > 0 || found.foreign.is_none())
        };
        [Section::Rapid, Section::FeedMove].into_iter().find(is_empty).map(Section::name)
    }

    pub(crate) fn always_writes_point(&self) -> bool {
        self.options.number_format.always_has_point()
    }

    /// Returns the option that determines how numbers are written, for messages.
    pub(crate) fn format_option(&self) -> StatedOption {
        self.option("NumberFormat", "0.0###")
    }

    /// Returns the option that determines how far lines may be from the arc that they replace, for messages.
    pub(crate) fn chord_option(&self) -> StatedOption {
        self.option("ArcToLinesTolerance", "0.01")
    }

    fn option(&self, name: &'static str, default: &str) -> StatedOption {
        let stated = self.stated.get(name);
        let value = stated.map_or(default, |(text, _)| text).to_owned();
        StatedOption { name, value, line: stated.map(|(_, line)| *line), column: None }
    }

    /// Maximum distance in mm between an arc and the lines that replace it.
    pub(crate) fn chord(&self, units: Units) -> f64 {
        self.stated_chord(units).min(MAX_CHORD_DISTANCE)
    }

    /// Distance that the file states, converted to mm, which [`chord`](Self::chord) limits.
    pub(crate) fn stated_chord(&self, units: Units) -> f64 {
        self.options.arc_tolerance * units.millimetres()
    }

    pub(crate) fn writes_cycles(&self) -> bool {
        !self.section(Section::G81).is_blank()
    }

    /// Returns the template of a section: the one in the file, or the default if the file lacks the element.
    pub(super) fn section(&self, section: Section) -> &Template {
        let index = section as usize;
        self.sections[index].as_ref().unwrap_or(&self.defaults[index])
    }

    /// Returns the signs that begin and end a comment in the output.
    pub(crate) fn comment_marks(&self) -> CommentMarks {
        let mark = |section| self.section(section).literal().trim().to_owned();
        CommentMarks { open: mark(Section::Comment), close: mark(Section::EndComment) }
    }

    /// Returns the definition's own words for motions that are not G words, each with the number of the G word that it stands for.
    pub(super) fn own_motions(&self) -> Vec<(u32, String)> {
        let is_own = |word: &str| !word.is_empty() && words(word, &CommentMarks::default()).words.is_empty();
        let all = CODES_WITH_SECTION
            .map(|(number, section)| (number, self.section(section).literal().trim().to_owned()));
        all.into_iter().filter(|(_, word)| is_own(word)).collect()
    }

    /// Returns all templates that the definition uses: those of the file, and the defaults of absent elements.
    pub(super) fn templates(&self) -> impl Iterator<Item = &Template> {
        Section::ALL.iter().map(|&section| self.section(section)).chain(self.macros.values())
    }
}

fn syntax_error(error: &roxmltree::Error, file: &Utf8Path) -> Diagnostic {
    let at = error.pos();
    Diagnostic::new(&posts::POST_SYNTAX)
        .with("reason", pathbuild_diagnostic::Value::foreign(error))
        .in_file(file)
        .at_line(at.row, Some(at.col))
}

struct CbppReader<'a> {
    file: &'a Utf8Path,
    lines: LineStarts,
    definition: Definition,
    seen: HashSet<String>,
    findings: Findings,
}

impl<'a> CbppReader<'a> {
    fn new(file: &'a Utf8Path, lines: LineStarts) -> Self {
        let default = |&section: &Section| {
            Template::parse(section, section.default_text(), 0).expect("the built-in sections are templates")
        };
        let definition = Definition {
            sections: vec![None; Section::ALL.len()],
            defaults: Section::ALL.iter().map(default).collect(),
            options: Options::initial(),
            stated: HashMap::new(),
            macros: IndexMap::new(),
        };
        Self { file, lines, definition, seen: HashSet::new(), findings: Findings::default() }
    }

    fn element(&mut self, element: Node<'_, '_>) {
        let name = element.tag_name().name();
        let (text, start) = text_of(element);
        let line = self.lines.line(start);
        self.report_repetition(name, line);
        self.report_nested(element);
        if let Some(&section) = Section::ALL.iter().find(|section| section.name() == name) {
            let template = self.template(section, &text, line);
            self.check_comment(section, template.as_ref(), line);
            self.definition.sections[section as usize] = template;
        } else if name == Section::UserMacro.name() {
            self.user_macros(&text, line);
        } else {
            self.option(name, &text, line);
        }
    }

    /// Refuses `/` as the mark of comments: controls run such lines, unless a switch at the machine skips them.
    fn check_comment(&mut self, section: Section, template: Option<&Template>, line: u32) {
        let mark =
            template.filter(|_| section == Section::Comment).map(Template::literal).unwrap_or_default();
        let mark = mark.trim();
        if mark == "/" {
            let expected = &Text {
                en: "a mark that begins a comment on controls, such as ( or ;",
                de: "ein Zeichen, mit dem bei Steuerungen ein Kommentar beginnt, etwa ( oder ;",
            };
            let diagnostic = Diagnostic::new(&posts::POST_OPTION).quoting("option", section.name());
            self.report(diagnostic.quoting("value", mark).with("expected", expected), line);
        }
    }

    fn report_repetition(&mut self, name: &str, line: u32) {
        // `AxisOfSpin` and `AxisOfRotation` are two names of the same setting.
        let setting = if name == "AxisOfSpin" { "AxisOfRotation" } else { name };
        if !self.seen.insert(setting.to_owned()) {
            self.report(Diagnostic::new(&posts::POST_REPEATED_ELEMENT).quoting("element", name), line);
        }
    }

    /// Reports the elements within an element of the definition. They and their texts are ignored.
    fn report_nested(&mut self, element: Node<'_, '_>) {
        for nested in element.children().filter(Node::is_element) {
            let line = self.lines.line(nested.range().start);
            let name = nested.tag_name().name();
            let nested = Diagnostic::new(&posts::POST_NESTED_ELEMENT).quoting("element", name);
            self.report(nested.quoting("outer", element.tag_name().name()), line);
        }
    }

    fn template(&mut self, section: Section, text: &str, line: u32) -> Option<Template> {
        match Template::parse(section, text, line) {
            Ok(template) => {
                self.report_bare_macros(&template);
                Some(template)
            }
            Err(errors) => {
                for error in &errors {
                    self.findings.add(template_error(section, error, self.file));
                }
                None
            }
        }
    }

    /// Warns about macros without a dollar sign, such as `{units}`, which would be written literally.
    fn report_bare_macros(&mut self, template: &Template) {
        if matches!(template.section, Section::Comment | Section::EndComment) {
            return;
        }
        for (name, line) in template.texts_in_braces() {
            if is_built_in(name) {
                let diagnostic = Diagnostic::new(&posts::MACRO_WITHOUT_SIGN);
                let diagnostic = diagnostic
                    .quoting("macro", format!("{{{name}}}"))
                    .quoting("nearest", format!("{{${name}}}"));
                self.report(diagnostic.quoting("section", template.section.name()), line);
            }
        }
    }

    fn user_macros(&mut self, text: &str, first_line: u32) {
        for (line, definition) in (first_line..).zip(text.lines()).filter(|(_, line)| !line.trim().is_empty())
        {
            match user_macro(definition) {
                None => {
                    self.report(
                        Diagnostic::new(&posts::POST_MACRO_LINE).quoting("text", definition.trim()),
                        line,
                    );
                }
                Some((name, _)) if is_built_in(name) => {
                    self.report(
                        Diagnostic::new(&posts::POST_SHADOWED_MACRO).quoting("macro", format!("${name}")),
                        line,
                    );
                }
                Some((name, value)) => {
                    if let Some(value) = self.template(Section::UserMacro, value, line) {
                        self.definition.macros.insert(name.into(), value);
                    }
                }
            }
        }
    }

    fn option(&mut self, name: &str, text: &str, line: u32) {
        self.definition.stated.insert(name.into(), (text.trim().into(), line));
        match self.definition.options.set(name, text) {
            Ok(()) => {}
            Err(OptionError::Unknown) => {
                self.report(Diagnostic::new(&posts::POST_UNKNOWN_ELEMENT).quoting("element", name), line);
            }
            Err(OptionError::Expected(expected)) => {
                let diagnostic = Diagnostic::new(&posts::POST_OPTION).quoting("option", name);
                self.report(diagnostic.quoting("value", text.trim()).with("expected", expected), line);
            }
        }
    }

    fn report(&mut self, diagnostic: Diagnostic, line: u32) {
        self.findings.add(diagnostic.in_file(self.file).at_line(line, None));
    }

    fn finish(self) -> Result<(Definition, Vec<Diagnostic>), Vec<Diagnostic>> {
        self.findings.into_result().map(|warnings| (self.definition, warnings))
    }
}

/// Returns the text of an element, and the offset of the text in the file.
fn text_of(element: Node<'_, '_>) -> (String, usize) {
    let first = element.children().find(Node::is_text);
    let start = first.map_or(element.range().start, |text| text.range().start);
    let text = element.children().filter_map(|child| child.is_text().then(|| child.text())?).collect();
    (text, start)
}

/// Parses a line of the form `$name=value`.
fn user_macro(line: &str) -> Option<(&str, &str)> {
    let (name, value) = line.trim().strip_prefix('$')?.split_once('=')?;
    let name = name.trim();
    (!name.is_empty() && !name.contains(['{', '}', '(', ')', '$'])).then_some((name, value.trim()))
}

/// Whether a macro with this name is built in and cannot be redefined. Built-in values that may be missing can be defined by the user.
pub(super) fn is_built_in(name: &str) -> bool {
    match Macro::parse(name) {
        Ok(Macro::User(_)) => false,
        Ok(Macro::Value(value)) => !value.may_be_missing(),
        _ => true,
    }
}

fn template_error(section: Section, error: &TemplateError, file: &Utf8Path) -> Diagnostic {
    let diagnostic = match &error.fault {
        Fault::Unclosed => Diagnostic::new(&posts::POST_UNCLOSED_MACRO),
        Fault::Arguments(MacroArguments { call, expected }) => Diagnostic::new(&posts::POST_MACRO_ARGUMENTS)
            .quoting("macro", format!("{{${call}}}"))
            .with("expected", *expected),
    };
    in_section(diagnostic, section, file, error.line)
}

/// Adds a section to a finding, and its place in the definition unless it is a macro of the configuration.
fn in_section(diagnostic: Diagnostic, section: Section, file: &Utf8Path, line: u32) -> Diagnostic {
    let diagnostic = diagnostic.quoting("section", section.name());
    match section {
        Section::ConfiguredMacro => diagnostic,
        _ => diagnostic.in_file(file).at_line((line > 0).then_some(line), None),
    }
}

/// Maximum number of macro names that an undefined macro is compared with to suggest one, so that files with many undefined macros are
/// still processed quickly.
const MAX_COMPARED_NAMES: usize = 1000;

/// Input of a writer: a job, a definition and the macros of all sources, checked together.
pub(super) struct Plan<'a> {
    pub(super) file: &'a Utf8Path,
    pub(super) definition: &'a Definition,
    pub(super) job: &'a Job,
    pub(super) target: Option<&'a Target>,
    pub(super) options: &'a PostOptions<'a>,
    /// The user macros of the configuration, which take precedence over those of the definition.
    macros: Vec<(Box<str>, Template)>,
}

impl<'a> Plan<'a> {
    /// Combines a job, a definition and options. Reports every undefined macro, even if it is not used.
    pub(super) fn new(
        definition: &'a Definition,
        file: &'a Utf8Path,
        job: &'a Job,
        target: Option<&'a Target>,
        options: &'a PostOptions<'a>,
    ) -> Result<Self, Vec<Diagnostic>> {
        let mut diagnostics = Vec::new();
        let section = Section::ConfiguredMacro;
        let mut macros = Vec::new();
        for PostMacro { name, value } in options.macros.iter().filter(|own| !is_built_in(&own.name)) {
            match Template::parse(section, value, 0) {
                Ok(template) => macros.push((name.clone(), template)),
                Err(errors) => {
                    diagnostics.extend(errors.iter().map(|error| template_error(section, error, file)));
                }
            }
        }
        let plan = Self { file, definition, job, target, options, macros };
        diagnostics.extend(plan.unknown_macros());
        if diagnostics.is_empty() { Ok(plan) } else { Err(diagnostics) }
    }

    /// The output unit in mm: 1 or 25.4.
    pub(super) fn unit(&self) -> f64 {
        self.job.units.millimetres()
    }

    /// Maximum distance in mm between an arc and the lines that replace it.
    pub(super) fn arc_tolerance(&self) -> f64 {
        self.definition.chord(self.job.units)
    }

    /// Returns the text of a user macro, which the configuration or the definition provides.
    pub(super) fn user_macro(&self, name: &str) -> Option<&Template> {
        let own = self.macros.iter().find(|(known, _)| **known == *name).map(|(_, text)| text);
        own.or_else(|| self.definition.macros.get(name))
    }

    /// Returns all templates that may be expanded: those of the definition and those of the configuration.
    pub(super) fn templates(&self) -> impl Iterator<Item = &Template> {
        self.definition.templates().chain(self.macros.iter().map(|(_, text)| text))
    }

    /// Whether the output states the plane of arcs. This is assumed without a dialect, because the definition may do so in words of its own.
    pub(super) fn states_plane(&self) -> bool {
        let is_plane = |(what, _): (&Macro, u32)| *what == Macro::State(State::WorkPlane);
        self.target.is_none() || self.templates().flat_map(Template::macros).any(is_plane)
    }

    fn unknown_macros(&self) -> Vec<Diagnostic> {
        let macros =
            self.templates().flat_map(|text| text.macros().map(move |(what, line)| (text, what, line)));
        let unknown = macros.filter_map(|(text, what, line)| match what {
            Macro::User(name) if self.user_macro(name).is_none() => Some((text, name, line)),
            _ => None,
        });
        let reported = unknown.take(MAX_FINDINGS);
        reported.map(|(text, name, line)| self.unknown_macro(name, text.section, line)).collect()
    }

    fn unknown_macro(&self, name: &str, section: Section, line: u32) -> Diagnostic {
        let users = self.macros.iter().map(|(name, _)| name).chain(self.definition.macros.keys());
        let users = users.map(|name| &**name).take(MAX_COMPARED_NAMES);
        let bare = name.split('(').next().unwrap_or(name);
        let nearest = nearest(bare, users).or_else(|| Macro::nearest(bare)).map(macro_in_braces);
        let diagnostic =
            Diagnostic::new(&posts::UNKNOWN_MACRO).suggest_nearest(&posts::UNKNOWN_MACRO_NEAREST, nearest);
        self.locate(diagnostic.quoting("macro", macro_in_braces(name)), section, line)
    }

    /// Adds the position in the definition to a diagnostic.
    pub(super) fn locate(&self, diagnostic: Diagnostic, section: Section, line: u32) -> Diagnostic {
        in_section(diagnostic, section, self.file, line)
    }
}

/// Formats the name of a macro as in a template: `{$name}`.
pub(super) fn macro_in_braces(name: &str) -> String {
    format!("{{${name}}}")
}
