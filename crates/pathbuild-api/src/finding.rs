//! Findings about drawings, and the errors of requests.

use std::fmt;
use std::ops::Range;

use pathbuild_diagnostic::{Diagnostic, EntityKind, Lang};
use pathbuild_workspace::findings::Findings;
use pathbuild_workspace::waivers::Waiver;
use pathbuild_workspace::{Failure, Workspace};

/// An error or a warning, with its place. (book: reference/diagnostics)
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    diagnostic: Diagnostic,
    waiver: Option<Waiver>,
}

/// A place where a project embeds a path.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Embedding {
    /// File of the drawing that embeds the path, relative to the library's directory if it lies below it.
    pub file: String,
    /// Name of the embedding path in that drawing.
    pub path: String,
    /// Position of the embedding in that drawing, in mm.
    pub position: [f64; 2],
}

impl Finding {
    /// Returns the code, for example `PB107`; `pathbuild explain PB107` explains it.
    pub fn code(&self) -> String {
        self.diagnostic.code().to_string()
    }

    /// Returns the readable name of the code, for example `unknown-letter`.
    pub fn name(&self) -> &str {
        self.diagnostic.code().name()
    }

    /// Whether the finding is an error; otherwise it is a warning. The configuration can change the severity of a code.
    pub fn is_error(&self) -> bool {
        self.diagnostic.is_error()
    }

    /// Returns the message, which says what is wrong.
    pub fn message(&self, lang: Lang) -> String {
        self.diagnostic.text(lang)
    }

    /// Returns the help, which says what to do; `None` if there is none.
    pub fn help(&self, lang: Lang) -> Option<String> {
        self.diagnostic.help(lang)
    }

    /// Returns further facts, for example where else a name is defined.
    pub fn notes(&self, lang: Lang) -> Vec<String> {
        self.diagnostic.notes.iter().map(|note| note.text(lang)).collect()
    }

    /// Returns the file, relative to the directory of the library if it lies below it; `None` if the finding concerns no file.
    pub fn file(&self) -> Option<&str> {
        self.diagnostic.file.as_ref().map(|file| file.as_str())
    }

    /// Returns the name of the path; `None` if the finding concerns no single path.
    pub fn path(&self) -> Option<&str> {
        self.diagnostic.path.as_deref()
    }

    /// Returns the line in the file, counted from 1, if it is known.
    pub fn line(&self) -> Option<u32> {
        self.diagnostic.place.line
    }

    /// Returns the layer, as the drawing spells it; `None` if the finding concerns no layer.
    pub fn layer(&self) -> Option<&str> {
        self.diagnostic.place.layer.as_deref()
    }

    /// Returns the handle of the element in the drawing, in hexadecimal digits, if it is known.
    pub fn handle(&self) -> Option<String> {
        self.diagnostic.place.handle.map(|handle| handle.to_string())
    }

    /// Returns the type of the element, for example `LINE`; `None` if the finding concerns no element.
    pub fn entity(&self) -> Option<&str> {
        self.diagnostic.place.entity.map(EntityKind::name)
    }

    /// Returns the point in the drawing, in mm, if there is one.
    pub fn position(&self) -> Option<[f64; 2]> {
        self.diagnostic.place.point.map(|point| [point.x.0, point.y.0])
    }

    /// Returns the text with the fault, or an excerpt if it is long; `None` if the fault is not in a text.
    pub fn text(&self) -> Option<&str> {
        self.diagnostic.text.as_ref().map(|fault| &*fault.text)
    }

    /// Returns the range of the faulty bytes in [`text`](Self::text).
    pub fn span(&self) -> Option<Range<usize>> {
        self.diagnostic.text.as_ref().map(pathbuild_diagnostic::TextFault::span)
    }

    /// Returns the embeddings through which the path was reached, outermost first.
    pub fn trace(&self) -> Vec<Embedding> {
        let embedding = |step: &pathbuild_diagnostic::TraceStep| Embedding {
            file: step.file.to_string(),
            path: step.path.to_string(),
            position: [step.point.x.0, step.point.y.0],
        };
        self.diagnostic.trace.iter().map(embedding).collect()
    }

    /// Returns the reason for which the finding is accepted; `None` if it is not accepted, or if no reason is stated.
    pub fn reason(&self) -> Option<&str> {
        self.waiver.as_ref()?.reason.as_deref()
    }

    /// Returns the last day, such as `2026-12-31`, on which the finding is accepted; `None` if it is not accepted, or if it is accepted without an
    /// end.
    pub fn until(&self) -> Option<String> {
        Some(self.waiver.as_ref()?.until?.to_string())
    }

    /// Converts the diagnostics of a run, with the configured severities, sorted and without duplicates. Accepted findings are left out.
    pub(crate) fn from_diagnostics(workspace: &Workspace, diagnostics: Vec<Diagnostic>) -> Vec<Self> {
        Self::reported_and_accepted(workspace.findings(diagnostics)).0
    }

    pub(crate) fn reported_and_accepted(findings: Findings) -> (Vec<Self>, Vec<Self>) {
        let accepted = findings.waived.into_iter();
        let accepted =
            accepted.map(|waived| Self { waiver: Some(waived.waiver), ..Self::new(waived.diagnostic) });
        (findings.diagnostics.into_iter().map(Self::new).collect(), accepted.collect())
    }

    /// Returns the parts from which pathbuild's command line renders the finding.
    #[doc(hidden)]
    pub fn into_parts(self) -> (Diagnostic, Option<Waiver>) {
        (self.diagnostic, self.waiver)
    }

    fn new(diagnostic: Diagnostic) -> Self {
        Self { diagnostic, waiver: None }
    }
}

/// Formats the code, followed by the message in English.
impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.code(), self.message(Lang::En))
    }
}

/// The reason why a request has no result.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Error {
    /// The configuration, or an input of the request, has these errors; warnings may be among them.
    Findings(Vec<Finding>),
    /// The post-processor does not exist, or has these errors.
    Post(Vec<Finding>),
    /// The baseline cannot be read, or has these errors.
    Baseline(Vec<Finding>),
    /// The request is invalid, for this reason in the language of the library.
    Refused(String),
}

impl Error {
    pub(crate) fn from_failure(failure: Failure) -> Self {
        match failure {
            Failure::Usage(reason) => Self::Refused(reason),
            Failure::Refused(faults) => Self::Baseline(with_own_severities(faults)),
            Failure::Post(found) => Self::Post(with_own_severities(found)),
            Failure::Found(found) => Self::Findings(with_own_severities(found)),
        }
    }

    pub(crate) fn from_findings(workspace: &Workspace, diagnostics: Vec<Diagnostic>) -> Self {
        Self::Findings(Finding::from_diagnostics(workspace, diagnostics))
    }

    pub(crate) fn internal_error(diagnostic: Diagnostic) -> Self {
        Self::Findings(vec![Finding::new(diagnostic)])
    }
}

/// Converts the errors that prevent a result, whose severities the configuration cannot change.
fn with_own_severities(diagnostics: Vec<Diagnostic>) -> Vec<Finding> {
    Finding::reported_and_accepted(Findings::new(diagnostics)).0
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Refused(reason) => f.write_str(reason),
            Self::Findings(found) | Self::Post(found) | Self::Baseline(found) => {
                let lines: Vec<String> = found.iter().map(Finding::to_string).collect();
                f.write_str(&lines.join("\n"))
            }
        }
    }
}

impl std::error::Error for Error {}
