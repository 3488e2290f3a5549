//! Verifies programs of any origin.

use camino::Utf8PathBuf;
use pathbuild_workspace::Workspace;
use pathbuild_workspace::config::types::Requirement;
use pathbuild_workspace::program::ReadingOptions;
use pathbuild_workspace::verify::{self, CheckRecord, MoveComparison, Outcome, Verification};
use pathbuild_workspace::waivers::Coverage;

use crate::{Error, Finding};

/// Options for verifying programs.
#[derive(Clone, Debug, Default)]
pub struct VerifyOptions {
    against: Option<String>,
    cutter: Option<f64>,
    surface: Option<f64>,
    dialect: Option<String>,
    post: Option<String>,
    required: Vec<String>,
}

impl VerifyOptions {
    /// Creates the default options.
    pub fn new() -> Self {
        Self::default()
    }

    /// Compares the programs with the drawing of this path, which also gives the cutter and the material.
    pub fn against(mut self, path: impl Into<String>) -> Self {
        self.against = Some(path.into());
        self
    }

    /// Sets the diameter of the cutter in mm. Without it, the diameter is taken from the drawing, from `[tool]`, or from comments.
    pub fn cutter(mut self, diameter: f64) -> Self {
        self.cutter = Some(diameter);
        self
    }

    /// Sets the height of the material's upper face in mm.
    pub fn surface(mut self, height: f64) -> Self {
        self.surface = Some(height);
        self
    }

    /// Sets the dialect of the programs, such as `grbl`. Without it, the dialect is guessed.
    pub fn dialect(mut self, dialect: impl Into<String>) -> Self {
        self.dialect = Some(dialect.into());
        self
    }

    /// Sets the post-processor that wrote the programs: the name of a built-in one, or a definition's file.
    pub fn post(mut self, post: impl Into<String>) -> Self {
        self.post = Some(post.into());
        self
    }

    /// Makes it an error if this check cannot be made: `rapids`, `rapids=assumed`, `envelope`, `feeds`, `spindle`, `drawing`, `clamps` or
    /// `corners`. If this is never called, the configuration decides.
    pub fn require(mut self, check: impl Into<String>) -> Self {
        self.required.push(check.into());
        self
    }

    pub(crate) fn resolve(self, workspace: &Workspace) -> Result<verify::VerifyOptions, Error> {
        let reading = |name: &String| {
            ReadingOptions::in_dialect(name).ok_or_else(|| {
                let [en, de] = ["there is no dialect `{}`", "es gibt keinen Dialekt `{}`"];
                Error::Refused(workspace.phrase(en, de, name))
            })
        };
        let requirement = |name: &String| {
            Requirement::named(name).ok_or_else(|| {
                Error::Refused(workspace.phrase("there is no check `{}`", "es gibt keine Prüfung `{}`", name))
            })
        };
        let options = verify::VerifyOptions {
            reading: self.dialect.as_ref().map(reading).transpose()?.unwrap_or_default(),
            against: self.against,
            required: self.required.iter().map(requirement).collect::<Result<_, _>>()?,
            post: self.post,
            ..verify::VerifyOptions::default()
        };
        let [cutter, surface] =
            [self.cutter, self.surface].map(|number| number.map(|number| number.to_string()));
        let options = options.with_stock(cutter.as_deref(), surface.as_deref());
        options.map_err(|fault| Error::from_findings(workspace, vec![*fault]))
    }
}

/// The result of [`Library::verify`](crate::Library::verify).
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct VerifyReport {
    /// Errors and warnings, sorted by program.
    pub findings: Vec<Finding>,
    /// Findings that the baseline or `severity-in` accepts for a stated reason. (book: howto/ci)
    pub accepted: Vec<Finding>,
    /// The programs, in the order in which they were named.
    pub programs: Vec<VerifiedProgram>,
}

/// A verified program, with the checks that were made.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct VerifiedProgram {
    /// Name of the program's file.
    pub file: String,
    /// The checks, whether made or not; empty if the program could not be read.
    pub checks: Vec<ProgramCheck>,
    /// The comparison with the drawing; `None` if no drawing was named.
    pub comparison: Option<DrawingComparison>,
}

/// A check of a program, and whether it was made.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct ProgramCheck {
    /// Name of the check, as in [`VerifyOptions::require`].
    pub name: String,
    /// Whether the check was made.
    pub state: CheckState,
    /// The values with which the check was made, or the reason why it was not made, in the language of the library.
    pub detail: String,
}

/// State of a check: made, made with assumed values, or not made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CheckState {
    /// The check was made.
    Made,
    /// The check was made with values that only comments of the program state, or that only the machine knows.
    Assumed,
    /// The check was not made, or not for all moves.
    NotMade,
}

/// A comparison of a program with the program of a drawing.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct DrawingComparison {
    /// Name of the path with which the program was compared.
    pub path: String,
    /// File of the drawing that contains the path.
    pub drawing: String,
    /// Number of moves in the program of the drawing.
    pub moves: usize,
    /// Number of equal moves before the first difference.
    pub equal: usize,
}

impl VerifyReport {
    pub(crate) fn new(workspace: &Workspace, verification: Verification) -> Result<Self, Error> {
        let (mut diagnostics, mut programs) = (verification.problems, Vec::new());
        let files = verification.programs.iter().map(|(file, _)| file.clone()).collect();
        for (file, verified) in verification.programs {
            diagnostics.extend(verified.diagnostics);
            programs.push(VerifiedProgram {
                file: Utf8PathBuf::into_string(file),
                checks: verified.checks.iter().map(|record| ProgramCheck::new(workspace, record)).collect(),
                comparison: verified.comparison.map(DrawingComparison::new),
            });
        }
        let coverage = Coverage { files, ..Coverage::default() };
        let (findings, accepted) = Finding::from_settled(workspace, diagnostics, coverage)?;
        Ok(Self { findings, accepted, programs })
    }
}

impl ProgramCheck {
    fn new(workspace: &Workspace, record: &CheckRecord) -> Self {
        let lang = workspace.lang();
        let (state, detail) = match &record.outcome {
            Outcome::Made(values) => {
                (CheckState::Made, values.as_ref().map(|values| values.in_lang(lang)).unwrap_or_default())
            }
            Outcome::Assumed(values, _) => (CheckState::Assumed, values.in_lang(lang)),
            Outcome::Incomplete(_, blind) => (CheckState::NotMade, verify::blind_text(*blind, lang)),
            Outcome::NotMade(reason) => (CheckState::NotMade, reason.text().in_lang(lang).to_owned()),
        };
        Self { name: record.requirement.name().to_owned(), state, detail }
    }
}

impl DrawingComparison {
    fn new(comparison: MoveComparison) -> Self {
        let MoveComparison { path, drawing, moves, equal, .. } = comparison;
        Self { path, drawing: drawing.into_string(), moves, equal }
    }
}
