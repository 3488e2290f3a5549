//! The diagnostics of a run, ready for display: with the severities and waivers of the configuration, without duplicates, in an order independent of
//! threads.
//! (book: reference/diagnostics)

use std::collections::{BTreeMap, HashMap, HashSet};
use std::fmt;
use std::hash::Hash as Hashed;
use std::sync::atomic::{AtomicBool, Ordering};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::{FileKind, is_drawing};
use pathbuild_diagnostic::messages::{outputs, part};
use pathbuild_diagnostic::{Code, Diagnostic, Message};

use crate::check::CheckedFile;
use crate::config::types::{FileSeverities, Level, Pattern, level_in};
use crate::config::{Settings, clean};
use crate::waivers::{Coverage, WaivedFinding};
use crate::workspace::Workspace;

/// The diagnostics of a run, with the drawings that were checked.
#[derive(Clone, Debug, Default)]
pub struct Findings {
    /// Diagnostics that are not waived, sorted, without duplicates.
    pub diagnostics: Vec<Diagnostic>,
    /// The checked drawings, sorted by path; empty for commands that do not check drawings.
    pub checked: Vec<CheckedFile>,
    /// The programs that were verified, written or compared.
    pub programs: Vec<Utf8PathBuf>,
    /// Diagnostics that are waived, sorted, without duplicates.
    pub waived: Vec<WaivedFinding>,
}

impl Findings {
    /// Sorts diagnostics and drops duplicates. If several bindings or projects lead to the same fault, the diagnostic with the shortest trace is
    /// kept.
    pub fn new(mut diagnostics: Vec<Diagnostic>) -> Self {
        if diagnostics.iter().any(|diagnostic| !diagnostic.trace.is_empty()) {
            diagnostics
                .sort_by_cached_key(|diagnostic| (diagnostic.trace.len(), format!("{:?}", diagnostic.trace)));
        }
        diagnostics
            .sort_by(|a, b| a.sort_key().cmp(&b.sort_key()).then_with(|| a.message.key.cmp(b.message.key)));
        let mut is_first = first_occurrences(diagnostics.iter());
        diagnostics.retain(|_| is_first.next() == Some(true));
        Self { diagnostics, ..Self::default() }
    }

    /// Returns the number of errors.
    pub fn error_count(&self) -> usize {
        self.diagnostics.iter().filter(|diagnostic| diagnostic.is_error()).count()
    }

    /// Iterates over all findings, including waived ones.
    pub fn all(&self) -> impl Iterator<Item = &Diagnostic> {
        self.diagnostics.iter().chain(self.waived.iter().map(|waived| &waived.diagnostic))
    }

    /// Returns the number of warnings.
    pub fn warning_count(&self) -> usize {
        self.diagnostics.len() - self.error_count()
    }
}

impl Workspace {
    /// Applies the configured severities and their waivers to diagnostics, sorts them, and drops duplicates.
    pub fn findings(&self, diagnostics: Vec<Diagnostic>) -> Findings {
        let severities = self.severities();
        let mut waived: Vec<WaivedFinding> = Vec::new();
        let judge = |diagnostic: Diagnostic| match severities.apply_severity(diagnostic) {
            SeverityOutcome::Reported(diagnostic) => Some(diagnostic),
            SeverityOutcome::Ignored => None,
            SeverityOutcome::Waived(finding) => {
                waived.push(finding);
                None
            }
        };
        let findings = Findings::new(diagnostics.into_iter().filter_map(judge).collect());
        waived.sort_by(|a, b| a.diagnostic.sort_key().cmp(&b.diagnostic.sort_key()));
        let mut is_first = first_occurrences(waived.iter().map(|waived| &waived.diagnostic));
        waived.retain(|_| is_first.next() == Some(true));
        Findings { waived, ..findings }
    }

    /// Whether the configuration contains waivers.
    pub fn has_waivers(&self) -> bool {
        self.settings.tables.severity_in.value.iter().any(|entry| entry.waiver.is_stated())
    }

    /// Returns PB610 for each waiver of the configuration that matches nothing although the run covered its files.
    pub fn unused_waivers(&self, findings: &Findings, coverage: &Coverage) -> Vec<Diagnostic> {
        let Some(configuration) = &self.settings.file else { return Vec::new() };
        let severities = self.severities();
        let found: Vec<(Code, String)> = findings
            .all()
            .filter_map(|found| Some((found.code(), severities.configured_name(found.file.as_deref()?))))
            .collect();
        let covered: Vec<String> =
            coverage.files.iter().map(|file| severities.configured_name(file)).collect();
        let entries = self.settings.tables.severity_in.value.iter().filter(|entry| entry.waiver.is_stated());
        let is_covered = |entry: &FileSeverities, pattern: &Pattern| {
            let is_judged = |code: Code, file: &str| !is_drawing(file.as_ref()) || !code.is_about_programs();
            let are_judged = |file: &String| entry.levels.iter().all(|(code, _)| is_judged(*code, file));
            let is_covered = covered.iter().any(|file| pattern.matches(file) && are_judged(file));
            match pattern.literal() {
                Some(file) => is_covered || coverage.has_directories && !self.has_configured(file),
                None => is_covered && coverage.is_library,
            }
        };
        let is_used = |entry: &FileSeverities| {
            found.iter().any(|(code, file)| {
                entry.levels.iter().any(|(known, _)| known == code) && entry.concerns(file)
            })
        };
        let are_covered =
            |entry: &FileSeverities| entry.files.iter().all(|pattern| is_covered(entry, pattern));
        let unused = entries.filter(|entry| !is_used(entry) && are_covered(entry));
        unused.map(|entry| entry.waiver.unused_warning(configuration)).collect()
    }

    fn has_configured(&self, file: &str) -> bool {
        let directory = self.settings.directory().unwrap_or(&self.working_directory);
        self.system.kind(&directory.join(file)) != FileKind::Missing
    }
}

/// Returns, for each finding, whether it differs from all earlier ones in more than its trace and notes. Equal findings need not be adjacent, even
/// if they are sorted: others that differ only in their arguments may lie between them.
///
/// The check of a sheet within another sheet finds the same cuts into parts as that of the sheet alone, at other places of the program. Such findings
/// about an element are kept only if they have the trace of the first one.
fn first_occurrences<'d>(findings: impl Iterator<Item = &'d Diagnostic>) -> std::vec::IntoIter<bool> {
    let (mut met, mut traces) = (HashSet::new(), HashMap::new());
    let is_first: Vec<bool> = findings
        .map(|found| {
            let is_placed = MESSAGES_ABOUT_PLACED_PATHS.contains(&found.message);
            let element = (found.message, &found.file, &found.path, &found.place, found.quoted("other"));
            let has_first_trace =
                !is_placed || *traces.entry(element).or_insert(&found.trace) == &found.trace;
            has_first_trace && met.insert(identity(found))
        })
        .collect();
    is_first.into_iter()
}

/// Messages about the paths of a program, with arguments that depend on their places in it.
const MESSAGES_ABOUT_PLACED_PATHS: [&Message; 7] = [
    &part::GOUGED_NEIGHBOUR,
    &part::GOUGED_BY_PATH_WITHOUT_PART,
    &part::SEVERED_NEIGHBOUR,
    &part::NEIGHBOURS_BAR_CUT_AWAY,
    &part::DISPLACED_PATH,
    &part::RAISED_PATH,
    &part::CUT_IN_LOOSE_WASTE,
];

/// Returns the parts of a finding that distinguish it from others. The arguments of a finding about paths nested too deeply are left out: these paths
/// may be reached from several projects, each with different arguments.
pub(crate) fn identity(found: &Diagnostic) -> impl Eq + Hashed + '_ {
    let arguments = (found.code() != Code::NestingTooDeep).then_some(&found.arguments);
    (found.message, &found.file, &found.path, &found.place, &found.text, arguments)
}

/// The configured severities of a run. Unlike a workspace, they can be shared between threads.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Severities<'a> {
    settings: &'a Settings,
    working_directory: &'a Utf8Path,
    is_date_decisive: &'a AtomicBool,
}

/// The outcome of applying the configured severities and waivers to a diagnostic.
pub(crate) enum SeverityOutcome {
    /// The diagnostic is reported, with its configured severity.
    Reported(Diagnostic),
    /// The diagnostic is dropped.
    Ignored,
    /// The diagnostic is accepted for a stated reason.
    Waived(WaivedFinding),
}

impl Workspace {
    pub(crate) fn severities(&self) -> Severities<'_> {
        Severities {
            settings: &self.settings,
            working_directory: &self.working_directory,
            is_date_decisive: &self.is_date_decisive,
        }
    }

    /// Whether any of these diagnostics is an error under the configuration. A program with errors is not written.
    pub fn has_error<'d>(&self, diagnostics: impl IntoIterator<Item = &'d Diagnostic>) -> bool {
        self.severities().has_error(diagnostics)
    }

    /// Returns, as errors, the warnings that the configuration turns into errors.
    pub fn raised_to_errors(&self, mut diagnostics: Vec<Diagnostic>) -> Vec<Diagnostic> {
        diagnostics.retain(|diagnostic| !diagnostic.is_error() && self.has_error([diagnostic]));
        diagnostics.into_iter().map(Diagnostic::as_error).collect()
    }

    /// Returns PB524 if the configuration lowers all errors among these problems of a program that was not written. Without it, the user would see no
    /// reason why the program was not written.
    pub fn lowered_error<'d>(
        &self,
        problems: impl IntoIterator<Item = &'d Diagnostic> + Clone,
    ) -> Option<Diagnostic> {
        let error = problems.clone().into_iter().find(|problem| problem.is_error())?;
        if self.has_error(problems) {
            return None;
        }
        let problem = Diagnostic::new(&outputs::LOWERED_ERROR).quoting("code", error.code().to_string());
        Some(Diagnostic { file: error.file.clone(), path: error.path.clone(), ..problem })
    }
}

impl Severities<'_> {
    pub(crate) fn has_error<'d>(&self, diagnostics: impl IntoIterator<Item = &'d Diagnostic>) -> bool {
        let is_error = |diagnostic: &Diagnostic| match self.apply_severity(diagnostic.clone()) {
            SeverityOutcome::Reported(diagnostic) => diagnostic.is_error(),
            SeverityOutcome::Ignored | SeverityOutcome::Waived(..) => false,
        };
        diagnostics.into_iter().any(is_error)
    }

    /// Applies the configured severities and their waivers to a diagnostic.
    pub(crate) fn apply_severity(&self, diagnostic: Diagnostic) -> SeverityOutcome {
        let code = diagnostic.code();
        let run = self.settings.date;
        let file = diagnostic.file.as_deref().map(|file| self.configured_name(file));
        let entries = file.iter().flat_map(|file| self.levels_in(code, file));
        let mut ended = Vec::new();
        let mut level = level_in(&self.settings.tables.severity.value, code).map(|level| (level, None));
        for (entry, in_file) in entries {
            if entry.waiver.holds(run) {
                level = Some((in_file, Some(&entry.waiver)));
                break;
            }
            ended.push(&entry.waiver);
        }
        let place = self.settings.file.as_deref().and_then(Utf8Path::file_name).unwrap_or_default();
        let noted = |diagnostic| {
            ended.iter().fold(diagnostic, |diagnostic, waiver| waiver.note_end(diagnostic, place, run))
        };
        let Some((level, waiver)) = level else { return SeverityOutcome::Reported(noted(diagnostic)) };
        match (level.severity(), waiver.filter(|waiver| waiver.is_stated())) {
            (Some(severity), waiver) => {
                let diagnostic = noted(Diagnostic { severity, ..diagnostic });
                SeverityOutcome::Reported(match waiver {
                    Some(waiver) => waiver.note_severity(diagnostic, place, run),
                    None => diagnostic,
                })
            }
            (None, Some(waiver)) => {
                self.is_date_decisive.fetch_or(waiver.until.is_some(), Ordering::Relaxed);
                SeverityOutcome::Waived(WaivedFinding { diagnostic, waiver: waiver.clone() })
            }
            (None, None) => SeverityOutcome::Ignored,
        }
    }

    /// Returns the name of a file as patterns in the configuration see it: relative to the configuration's directory, with slashes.
    pub(crate) fn configured_name(&self, file: &Utf8Path) -> String {
        let file = clean(&self.working_directory.join(file));
        let below = self.settings.directory().and_then(|directory| file.strip_prefix(directory).ok());
        below.unwrap_or(&file).as_str().replace('\\', "/")
    }

    /// Iterates over the entries that set the level of a code in a file. If several apply, the last one of the configuration takes precedence, so
    /// it comes first.
    fn levels_in(&self, code: Code, file: &str) -> impl Iterator<Item = (&FileSeverities, Level)> {
        let entries = self.settings.tables.severity_in.value.iter().rev();
        let entries = entries.filter(move |entry| entry.concerns(file));
        entries.filter_map(move |entry| Some((entry, level_in(&entry.levels, code)?)))
    }
}

// Fingerprints of findings. The fingerprint of a finding is the same in every run, language and version.

/// A 128-bit hash that identifies a finding, displayed as 32 hexadecimal digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Fingerprint(u128);

impl Fingerprint {
    /// Returns the fingerprints of findings, in the order of the findings. They do not depend on the directories of the files. Equal findings are
    /// numbered, so that each fingerprint occurs once.
    pub fn of(diagnostics: &[Diagnostic]) -> Vec<Self> {
        let place = |file: &Utf8Path| file.file_name().unwrap_or_default().to_owned();
        Self::numbered(diagnostics, &place, |_| None)
    }

    /// Like [`of`](Self::of), but equal findings are numbered within each file, so that the fingerprints of a file do not depend on other files.
    /// `place` returns the name of a file to use in the fingerprint.
    pub(crate) fn within_files(diagnostics: &[Diagnostic], place: &dyn Fn(&Utf8Path) -> String) -> Vec<Self> {
        Self::numbered(diagnostics, place, |diagnostic| diagnostic.file.as_deref())
    }

    /// Numbers equal findings within each file that `group` returns.
    fn numbered<'d>(
        diagnostics: &'d [Diagnostic],
        place: &dyn Fn(&Utf8Path) -> String,
        group: impl Fn(&'d Diagnostic) -> Option<&'d Utf8Path>,
    ) -> Vec<Self> {
        let mut met: BTreeMap<(u128, Option<&Utf8Path>), u32> = BTreeMap::new();
        let mut fingerprint = |diagnostic: &'d Diagnostic| {
            let hash = fnv(diagnostic, &diagnostic.file.as_deref().map(place).unwrap_or_default());
            let met = met.entry((hash.0, group(diagnostic)));
            let number = met.and_modify(|number| *number += 1).or_insert(0);
            Self(hash.add_bytes(&number.to_le_bytes()).0)
        };
        diagnostics.iter().map(&mut fingerprint).collect()
    }
}

impl fmt::Display for Fingerprint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:032x}", self.0)
    }
}

fn fnv(diagnostic: &Diagnostic, file: &str) -> Fnv {
    let place = &diagnostic.place;
    let point = place.point.map(|point| format!("{:.3} {:.3}", point.x.0 + 0.0, point.y.0 + 0.0));
    let fault = diagnostic.text.as_ref().map(|fault| &fault.text[fault.span()]);
    let hash = Fnv::NEW
        .add_bytes(diagnostic.code().to_string().as_bytes())
        .add_bytes(file.as_bytes())
        .add_bytes(diagnostic.path.as_deref().unwrap_or_default().to_uppercase().as_bytes())
        .add_bytes(place.entity.map_or("", |entity| entity.name()).as_bytes())
        .add_bytes(point.unwrap_or_default().as_bytes())
        .add_bytes(fault.unwrap_or_default().as_bytes());
    if diagnostic.code() != Code::LayerNotVisible {
        return hash;
    }
    // The layer's name counts as well: accepting the finding about one hidden layer must not accept that about another one, hidden by mistake.
    let layers = [diagnostic.quoted("layer"), place.layer.as_deref()];
    layers.into_iter().flatten().fold(hash, |hash, layer| hash.add_bytes(layer.to_uppercase().as_bytes()))
}

/// State of the 128-bit FNV-1a hash, which is the same on every machine and in every version.
#[derive(Clone, Copy)]
struct Fnv(u128);

impl Fnv {
    const NEW: Self = Self(0x6c62_272e_07bb_0142_62b8_2175_6295_c58d);
    const PRIME: u128 = 0x0000_0000_0100_0000_0000_0000_0000_013b;

    /// Adds bytes, followed by a separator that does not occur in UTF-8.
    fn add_bytes(self, bytes: &[u8]) -> Self {
        bytes
            .iter()
            .chain(&[0xff])
            .fold(self, |hash, byte| Self((hash.0 ^ u128::from(*byte)).wrapping_mul(Self::PRIME)))
    }
}
