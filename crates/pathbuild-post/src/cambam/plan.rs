//! Combines a program, a definition and the macros of all sources, and checks them together.

use camino::Utf8Path;
use pathbuild_diagnostic::{Diagnostic, messages::posts, nearest};

use super::definition::{Definition, is_built_in, template_error};
use super::macros::Macro;
use super::section::Section;
use super::template::Template;
use crate::findings::MOST_FINDINGS;
use crate::job::{Job, Texts};
use crate::target::Target;
use crate::{PostMacro, PostOptions};

/// Maximum number of macro names that an undefined one is compared with, so that files with many undefined macros are still fast.
const MOST_COMPARED: usize = 1000;

/// Everything a writer needs to read.
pub(super) struct Plan<'a> {
    pub(super) file: &'a Utf8Path,
    pub(super) definition: &'a Definition,
    pub(super) job: &'a Job,
    pub(super) target: Option<&'a Target>,
    pub(super) options: &'a PostOptions<'a>,
    /// The macros of the configuration, which take precedence over those of the definition.
    macros: Vec<(Box<str>, Template)>,
    /// Custom texts of the program.
    pub(super) texts: CustomTexts,
    /// Custom texts of each operation.
    pub(super) operation_texts: Vec<CustomTexts>,
}

/// [`Texts`] parsed as templates.
pub(super) struct CustomTexts {
    pub(super) header: Template,
    pub(super) footer: Template,
}

impl<'a> Plan<'a> {
    /// Combines everything. Every undefined macro is reported, whether it is used or not.
    pub(super) fn new(
        definition: &'a Definition,
        file: &'a Utf8Path,
        job: &'a Job,
        target: Option<&'a Target>,
        options: &'a PostOptions<'a>,
    ) -> Result<Self, Vec<Diagnostic>> {
        let mut diagnostics = Vec::new();
        let mut template = |section: Section, text: &str| {
            Template::parse(section, text, 0).unwrap_or_else(|errors| {
                diagnostics.extend(errors.iter().map(|error| template_error(section, error, file)));
                Template { section, pieces: Vec::new() }
            })
        };
        let mut custom = |texts: &Texts| CustomTexts {
            header: template(Section::Custom, &texts.header),
            footer: template(Section::Custom, &texts.footer),
        };
        let texts = custom(&job.texts);
        let operation_texts = job.operations.iter().map(|operation| custom(&operation.texts)).collect();
        let own = options.macros.iter().filter(|own| !is_built_in(&own.name));
        let macros = own
            .map(|PostMacro { name, value }| (name.clone(), template(Section::UserMacro, value)))
            .collect();
        let plan = Self { file, definition, job, target, options, macros, texts, operation_texts };
        diagnostics.extend(plan.unknown_macros());
        if diagnostics.is_empty() { Ok(plan) } else { Err(diagnostics) }
    }

    /// The output unit, in mm.
    pub(super) fn unit(&self) -> f64 {
        self.job.units.millimetres()
    }

    /// Greatest distance between an arc and the lines that replace it, in mm.
    pub(super) fn arc_tolerance(&self) -> f64 {
        self.definition.options.arc_tolerance * self.unit()
    }

    /// The text of a user macro.
    pub(super) fn user_macro(&self, name: &str) -> Option<&Template> {
        let own = self.macros.iter().find(|(known, _)| **known == *name).map(|(_, text)| text);
        own.or_else(|| self.definition.macros.get(name))
    }

    /// All templates that may be expanded.
    pub(super) fn templates(&self) -> impl Iterator<Item = &Template> {
        let texts = std::iter::once(&self.texts).chain(&self.operation_texts);
        let custom = texts.flat_map(|texts| [&texts.header, &texts.footer]);
        self.definition.templates().chain(self.macros.iter().map(|(_, text)| text)).chain(custom)
    }

    fn unknown_macros(&self) -> Vec<Diagnostic> {
        let macros =
            self.templates().flat_map(|text| text.macros().map(move |(what, line)| (text, what, line)));
        let unknown = macros.filter_map(|(text, what, line)| match what {
            Macro::User(name) if self.user_macro(name).is_none() => Some((text, name, line)),
            _ => None,
        });
        let reported = unknown.take(MOST_FINDINGS);
        reported.map(|(text, name, line)| self.unknown_macro(name, text.section, line)).collect()
    }

    fn unknown_macro(&self, name: &str, section: Section, line: u32) -> Diagnostic {
        let users = self.macros.iter().map(|(name, _)| &**name).chain(self.definition.macros.names());
        let users = users.take(MOST_COMPARED);
        let bare = name.split('(').next().unwrap_or(name);
        let diagnostic = match nearest(bare, users).or_else(|| Macro::nearest(bare)) {
            Some(nearest) => {
                Diagnostic::new(&posts::UNKNOWN_MACRO_NEAREST).quoting("nearest", framed(nearest))
            }
            None => Diagnostic::new(&posts::UNKNOWN_MACRO),
        };
        self.locate(diagnostic.quoting("macro", framed(name)), section, line)
    }

    /// Adds the position in the definition to a diagnostic.
    pub(super) fn locate(&self, diagnostic: Diagnostic, section: Section, line: u32) -> Diagnostic {
        let diagnostic = diagnostic.quoting("section", section.name()).in_file(self.file);
        if line > 0 { diagnostic.at_line(line, None) } else { diagnostic }
    }
}

/// The notation of a macro in a template.
pub(super) fn framed(name: &str) -> String {
    format!("{{${name}}}")
}
