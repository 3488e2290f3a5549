//! The last step of a run with findings: applies the baseline to them, or writes it. (book: howto/ci)

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::FileKind;
use pathbuild_diagnostic::messages::configuration as messages;
use pathbuild_diagnostic::reasons::{IS_BASELINE, NO_BASELINE};
use pathbuild_diagnostic::{Code, Diagnostic};

use crate::baseline::Baseline;
use crate::files;
use crate::findings::Findings;
use crate::protected_files::{reason_to_keep, replace_error};
use crate::waivers::{Coverage, Waiver};
use crate::workspace::{Failure, Workspace};

/// The baseline of a run, and its use.
#[derive(Clone, Debug, Default)]
pub struct BaselineOptions {
    /// File of the baseline; `None` for the default one, if it exists.
    pub file: Option<Utf8PathBuf>,
    /// Whether the baseline is applied to the findings, or written.
    pub task: BaselineTask,
}

/// The use of a baseline.
#[derive(Clone, Debug, Default)]
pub enum BaselineTask {
    /// Accepts the findings that are in the baseline.
    #[default]
    Apply,
    /// Writes all findings into the baseline.
    Update,
    /// Writes the findings with this code into the baseline, with the reason and the end of the waiver.
    Accept(Code, Waiver),
}

/// The outcome of a run.
#[derive(Clone, Debug)]
pub enum BaselineOutcome {
    /// The findings to report, and those that are accepted.
    Findings(Findings),
    /// The baseline was written.
    Written(WrittenBaseline),
}

/// A baseline that was written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WrittenBaseline {
    /// Path of the file.
    pub file: Utf8PathBuf,
    /// Number of findings that were written.
    pub findings: usize,
}

impl Workspace {
    /// Splits findings into those to report and those that are accepted, and adds warnings about waivers that match nothing any more; or writes the
    /// baseline instead.
    ///
    /// # Errors
    /// If the baseline cannot be read or written, has errors, or would accept nothing, if a file could not be read whose findings are to be written
    /// into it, or if the options are invalid.
    pub fn apply_baseline_options(
        &self,
        findings: Findings,
        options: &BaselineOptions,
        coverage: impl FnOnce() -> Coverage,
    ) -> Result<BaselineOutcome, Failure> {
        let named = options.file.as_deref();
        let (file, diagnostics) = (self.baseline_file(named), &findings.diagnostics);
        let unread = diagnostics.iter().filter(|finding| !Baseline::may_accept(finding));
        let unread: Vec<Diagnostic> = unread.cloned().collect();
        match &options.task {
            BaselineTask::Update | BaselineTask::Accept(..) if !unread.is_empty() => {
                Err(Failure::Found(unread))
            }
            BaselineTask::Apply => {
                let baseline = self.read_baseline(named).map_err(Failure::Refused)?;
                Ok(BaselineOutcome::Findings(self.without_accepted(findings, baseline.as_ref(), coverage)))
            }
            BaselineTask::Update => self.update_baseline(&file, diagnostics, &coverage()),
            BaselineTask::Accept(code, waiver) => self.accept(&file, *code, waiver, diagnostics),
        }
    }

    /// Rewrites the baseline. Lines without a fingerprint are dropped, but a file with only such lines is not a baseline and is not overwritten. A
    /// baseline, depth, reason or date that cannot be read is an error.
    fn update_baseline(
        &self,
        file: &Utf8Path,
        findings: &[Diagnostic],
        coverage: &Coverage,
    ) -> Result<BaselineOutcome, Failure> {
        let (baseline, mut faults) = self.read_or_new_baseline(file).map_err(Failure::Refused)?;
        let has_faults = !faults.is_empty();
        faults.retain(|fault| fault.message.key != messages::BASELINE_LINE.key);
        if !faults.is_empty() {
            return Err(Failure::Refused(faults));
        }
        if has_faults && baseline.is_empty() {
            return Err(Failure::Found(vec![replace_error(file, &NO_BASELINE)]));
        }
        self.write_baseline(file, &baseline.rewritten_text(findings, self, coverage), findings.len())
    }

    /// Adds waivers for all findings with a code to the baseline.
    fn accept(
        &self,
        file: &Utf8Path,
        code: Code,
        waiver: &Waiver,
        findings: &[Diagnostic],
    ) -> Result<BaselineOutcome, Failure> {
        if let Some(reason) = self.waiver_refusal(waiver) {
            return Err(Failure::Usage(reason));
        }
        let baseline = match self.read_or_new_baseline(file) {
            Ok((baseline, faults)) if faults.is_empty() => baseline,
            Ok((_, faults)) | Err(faults) => return Err(Failure::Refused(faults)),
        };
        let (text, count) = baseline.text_accepting(findings, code, waiver, self);
        if count == 0 {
            return Err(Failure::Usage(self.phrase(
                "there is no finding {} to accept",
                "es gibt keinen Befund {}, der hinzunehmen wäre",
                &code.to_string(),
            )));
        }
        self.write_baseline(file, &text, count)
    }

    /// Reads the baseline that is to be changed, or returns an empty one if the file does not exist yet.
    fn read_or_new_baseline(&self, file: &Utf8Path) -> Result<(Baseline, Vec<Diagnostic>), Vec<Diagnostic>> {
        match self.system.kind(file) {
            FileKind::File => Baseline::read(&*self.system, file, self.settings.limits.file_size.value),
            _ => Ok((Baseline::new(file), Vec::new())),
        }
    }

    /// Returns the reason why a waiver is refused: its reason is empty, or it ends before the date of the run. `None` if it is valid.
    fn waiver_refusal(&self, waiver: &Waiver) -> Option<String> {
        if waiver.reason.as_ref().is_some_and(|reason| reason.trim().is_empty()) {
            let reason = self.choose("--reason must not be empty", "--reason darf nicht leer sein");
            return Some(reason.to_owned());
        }
        let run = self.settings.date;
        let date = run.filter(|_| !waiver.holds(run))?.text(self.lang());
        Some(self.phrase(
            "--until lies before the date of this run, {}",
            "--until liegt vor dem Datum dieses Laufs, {}",
            &date,
        ))
    }

    fn write_baseline(
        &self,
        file: &Utf8Path,
        text: &str,
        findings: usize,
    ) -> Result<BaselineOutcome, Failure> {
        let reason = reason_to_keep(self, None, file);
        if let Some(reason) = reason.filter(|reason| **reason != IS_BASELINE) {
            return Err(Failure::Found(vec![replace_error(file, reason)]));
        }
        files::replace(self, file, text).map_err(|fault| Failure::Found(vec![*fault]))?;
        Ok(BaselineOutcome::Written(WrittenBaseline { file: file.to_owned(), findings }))
    }
}
