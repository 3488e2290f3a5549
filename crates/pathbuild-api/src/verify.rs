//! Verifies programs of any origin.

use camino::Utf8PathBuf;
use pathbuild_workspace::config::types::Requirement;
use pathbuild_workspace::program::UnitCodes;
use pathbuild_workspace::verify::{self, CheckRecord, MoveComparison, Outcome, Verification};
use pathbuild_workspace::waivers::Coverage;
use pathbuild_workspace::{Workspace, settle};

use crate::baseline::SettledFindings;
use crate::{BaselineOptions, Error, Finding, Lang, WrittenBaseline};

/// Options for verifying programs.
#[derive(Clone, Debug, Default)]
pub struct VerifyOptions {
    /// The options, except for the dialect and the required checks, which are given by their names.
    options: verify::VerifyOptions,
    dialect: Option<String>,
    required: Vec<String>,
    /// A program that is not in a file, with its name.
    pub(crate) text: Option<(Utf8PathBuf, Vec<u8>)>,
    pub(crate) baseline: BaselineOptions,
}

impl VerifyOptions {
    /// Creates the default options.
    pub fn new() -> Self {
        Self::default()
    }

    /// Compares the programs with the drawing of this path, which also gives the cutter and the material.
    pub fn against(mut self, path: impl Into<String>) -> Self {
        self.options.against = Some(path.into());
        self
    }

    /// Sets the diameter of the cutter in mm. Without it, the diameter is taken from the drawing, from `[tool]`, or from comments.
    pub fn cutter(mut self, diameter: f64) -> Self {
        self.options.cutter = Some(diameter);
        self
    }

    /// Sets the height of the material's upper face in mm.
    pub fn surface(mut self, height: f64) -> Self {
        self.options.surface = Some(height);
        self
    }

    /// Sets the dialect of the programs, such as `grbl`. Without it, the dialect of the [`post`](Self::post) applies if it names one; otherwise the
    /// dialect is guessed.
    pub fn dialect(mut self, dialect: impl Into<String>) -> Self {
        self.dialect = Some(dialect.into());
        self
    }

    /// Sets the post-processor that wrote the programs: the name of a built-in one, or a definition's file.
    pub fn post(mut self, post: impl Into<String>) -> Self {
        self.options.post = Some(post.into());
        self
    }

    /// Makes it an error if this check cannot be made: `rapids`, `rapids=assumed`, `envelope`, `feeds`, `spindle`, `drawing`, `clamps` or
    /// `corners`. The checks that the configuration requires are required as well.
    pub fn require(mut self, check: impl Into<String>) -> Self {
        self.required.push(check.into());
        self
    }

    /// Also verifies this program, which is not in a file. Findings name it by `name`.
    pub fn text(mut self, name: impl Into<String>, text: Vec<u8>) -> Self {
        self.text = Some((name.into().into(), text));
        self
    }

    /// In programs for `XpertMILL`, reads G70 as millimetres and G71 as inches, which is the reverse of DIN 66025.
    pub fn table_unit_codes(mut self) -> Self {
        self.options.reading.unit_codes = UnitCodes::Table;
        self
    }

    /// In programs for `XpertMILL`, reads I and J as the centre of an arc itself, not as its distance from the start of the arc.
    pub fn absolute_arc_centres(mut self) -> Self {
        self.options.reading.absolute_arc_centres = true;
        self
    }

    /// In programs for `XpertMILL`, ignores F and uses the feeds of the layers.
    pub fn ignore_feed(mut self) -> Self {
        self.options.reading.ignore_feed = true;
        self
    }

    /// Sets the baseline, and whether it is applied or written.
    pub fn baseline(mut self, baseline: BaselineOptions) -> Self {
        self.baseline = baseline;
        self
    }

    pub(crate) fn resolve(self, workspace: &Workspace) -> Result<verify::VerifyOptions, Error> {
        let mut options = self.options;
        let dialect = |name: &String| {
            name.parse().map_err(|()| {
                let [en, de] = ["there is no dialect `{}`", "es gibt keinen Dialekt `{}`"];
                Error::Refused(workspace.phrase(en, de, name))
            })
        };
        options.reading.dialect = self.dialect.as_ref().map(dialect).transpose()?;
        let requirement = |name: &String| {
            Requirement::named(name).ok_or_else(|| {
                Error::Refused(workspace.phrase("there is no check `{}`", "es gibt keine Prüfung `{}`", name))
            })
        };
        options.required = self.required.iter().map(requirement).collect::<Result<_, _>>()?;
        let [cutter, surface] =
            [options.cutter, options.surface].map(|number| number.map(|number| number.to_string()));
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
    /// The baseline that was written instead of reporting the findings; `None` if that was not requested.
    pub baseline: Option<WrittenBaseline>,
}

/// A verified program, with the checks that were made.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct VerifiedProgram {
    /// Name of the program's file.
    pub file: String,
    /// The checks, whether made or not; empty if the program could not be read.
    pub checks: Vec<ProgramCheck>,
    /// The checks in one line, in the language of the library; empty if the program could not be read.
    pub summary: String,
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
    /// The values with which the check was made, even if not for all moves; `None` for a check without values.
    pub values: Option<String>,
    /// Advice on how to make the check possible; `None` if it was made.
    pub advice: Option<String>,
    /// Number of moves for which a check with values was not made; `None` if it was made for all moves, or for none.
    pub open_moves: Option<usize>,
}

/// State of a check: made, made with assumed values, or not made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CheckState {
    /// The check was made.
    Made,
    /// The check was made with a cutter or material that only the program itself states, or although moves depend on values that only the
    /// machine knows.
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
    /// Name of the dialect, or of the post-processor's definition, by which the program was read.
    pub dialect: String,
    /// The dialect or the definition with the evidence for it, in the language of the library.
    pub read_as: String,
    /// Number of moves in the program of the drawing.
    pub moves: usize,
    /// Number of equal moves before the first difference.
    pub equal: usize,
}

impl VerifyReport {
    pub(crate) fn new(
        workspace: &Workspace,
        verification: Verification,
        baseline: &settle::BaselineOptions,
    ) -> Result<Self, Error> {
        let Verification { programs, diagnostics } = verification;
        let files = || programs.iter().map(|(file, _)| file.clone()).collect();
        let coverage = || Coverage { files: files(), ..Coverage::default() };
        let SettledFindings { findings, accepted, baseline } =
            SettledFindings::new(workspace, diagnostics, baseline, coverage)?;
        let programs = programs.into_iter().map(|program| VerifiedProgram::new(workspace, program));
        Ok(Self { findings, accepted, programs: programs.collect(), baseline })
    }
}

impl VerifiedProgram {
    fn new(workspace: &Workspace, (file, program): (Utf8PathBuf, verify::VerifiedProgram)) -> Self {
        let (lang, checks) = (workspace.lang(), program.checks);
        Self {
            file: file.into_string(),
            summary: if checks.is_empty() { String::new() } else { verify::summary(&checks, lang) },
            checks: checks.iter().map(|record| ProgramCheck::new(record, lang)).collect(),
            comparison: program.comparison.map(DrawingComparison::new),
        }
    }
}

impl ProgramCheck {
    fn new(record: &CheckRecord, lang: Lang) -> Self {
        let values = record.values().map(|values| values.in_lang(lang));
        let made = || values.clone().unwrap_or_default();
        let (state, detail, advice, open_moves) = match &record.outcome {
            Outcome::Made(_) => (CheckState::Made, made(), None, None),
            Outcome::Assumed(..) => (CheckState::Assumed, made(), None, None),
            Outcome::Incomplete(_, blind) => {
                let (reason, count) = (verify::blind_text(*blind, lang), blind.count);
                (CheckState::NotMade, reason, Some(&verify::APPROACH_ABOVE_MATERIAL), Some(count))
            }
            Outcome::NotMade(reason) => {
                let (text, option) = (reason.text().in_lang(lang).to_owned(), record.option(*reason));
                (CheckState::NotMade, text, Some(option), None)
            }
        };
        let advice = advice.map(|text| text.in_lang(lang).to_owned());
        Self { name: record.requirement.name().to_owned(), state, detail, values, advice, open_moves }
    }
}

impl DrawingComparison {
    fn new(comparison: MoveComparison) -> Self {
        let MoveComparison { path, drawing, dialect, read_as, moves, equal } = comparison;
        Self { path, drawing: drawing.into_string(), dialect, read_as, moves, equal }
    }
}
