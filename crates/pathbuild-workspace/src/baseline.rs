//! Baselines: text files with one accepted finding per line, which users can read, merge and shorten. A line begins with the fingerprint of the
//! finding; `depth=` in mm, `until=` with a date, `reason=` with a text in double quotes and `severity=warning` may follow. The remainder of the
//! line describes the finding. Empty lines and lines that begin with `#` are comments. (book: howto/ci)

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::sync::atomic::Ordering;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::System;
use pathbuild_db::system::{FileKind, ReadError, is_drawing};
use pathbuild_diagnostic::messages::configuration as messages;
use pathbuild_diagnostic::{Code, Diagnostic, Lang, Message, Severity, TextFault, Value, escaping};

use crate::config::clean;
use crate::files;
use crate::findings::{Findings, Fingerprint};
use crate::waivers::{Coverage, WaivedFinding, Waiver};
use crate::workspace::Workspace;

/// File name of the default baseline, which lies beside `pathbuild.toml`.
const FILE_NAME: &str = "pathbuild-baseline.txt";

/// The accepted findings in a baseline file. They are not reported.
#[derive(Clone, Debug, Default)]
pub struct Baseline {
    file: Utf8PathBuf,
    /// Text of the file, unchanged.
    text: String,
    /// The entries by their fingerprints. Drawings of the same name may have entries with the same fingerprint.
    entries: BTreeMap<String, Vec<Entry>>,
}

/// The content of a line after its fingerprint, and the line itself.
#[derive(Clone, Debug)]
struct Entry {
    waiver: Waiver,
    /// Depth in mm up to which the finding is accepted, for findings with a depth.
    depth: Option<f64>,
    /// Whether the accepted finding was a warning although its code is that of an error.
    is_for_warning: bool,
    description: String,
    line: String,
}

/// Fingerprints by which a baseline may identify a finding.
struct FindingKey {
    fingerprint: String,
    /// The finding's fingerprint in the form that versions up to 0.2.0 wrote into baselines.
    earlier: String,
    /// Whether the fingerprint contains only the name of the file, without its directory.
    has_name_only: bool,
}

impl Baseline {
    /// Creates a baseline without entries for this file.
    pub fn new(file: &Utf8Path) -> Self {
        Self { file: file.to_owned(), text: HEADER_TEXT.to_owned(), entries: BTreeMap::new() }
    }

    /// Reads a baseline file of at most `limit` bytes. Also returns diagnostics of its lines.
    ///
    /// # Errors
    /// If the file cannot be read, with the reason.
    pub fn read(
        system: &dyn System,
        file: &Utf8Path,
        limit: u64,
    ) -> Result<(Self, Vec<Diagnostic>), Vec<Diagnostic>> {
        let text = files::read(system, file, limit).map_err(|reason| {
            vec![match system.read(file, limit) {
                // Name the configuration key of the limit, as for other files.
                Err(error @ ReadError::TooLarge { .. }) => error.diagnostic(limit, "file-size").in_file(file),
                _ => Diagnostic::new(&messages::BASELINE_UNREADABLE).in_file(file).with("reason", reason),
            }]
        })?;
        // Some editors begin a file with a byte order mark.
        let text = text.trim_start_matches('\u{feff}').to_owned();
        let mut baseline = Self { text, ..Self::new(file) };
        let faults = baseline.parse();
        Ok((baseline, faults))
    }

    /// Whether the baseline has no entries.
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// Whether a baseline may accept a finding. Errors because of which something was not checked are never accepted: unreadable files, programs
    /// without G-code, an invalid configuration, empty searches, exceeded limits, required checks that were not made, and errors that name no file,
    /// such as those about the arguments.
    pub fn may_accept(finding: &Diagnostic) -> bool {
        let is_unchecked = match finding.code() {
            Code::UnreadableFile => true,
            Code::InvalidConfiguration
            | Code::NothingFound
            | Code::LimitReached
            | Code::UnmadeCheck
            | Code::NotGCode => finding.is_error(),
            _ => finding.is_error() && finding.file.is_none(),
        };
        !is_unchecked
    }

    /// Returns the text of a baseline that contains all these findings. Entries that still match keep their reasons and dates. Entries for files that
    /// the run did not cover stay as they are. Lines keep their order, so that a version control system shows what was added or removed.
    pub fn rewritten_text(
        &self,
        findings: &[Diagnostic],
        workspace: &Workspace,
        coverage: &Coverage,
    ) -> String {
        let run = RunCoverage::new(workspace, coverage);
        let mut lines: Vec<(u32, String)> = Vec::new();
        let mut found = BTreeSet::new();
        for (diagnostic, key) in findings.iter().zip(self.keys(findings, &workspace.working_directory)) {
            let none = Waiver::default();
            let known = self.entries(diagnostic, &key, workspace);
            let waiver = known.last().map_or(&none, |entry| &entry.waiver);
            let place = known.last().map_or(u32::MAX, |entry| entry.waiver.line);
            lines
                .push((place, self.line(&key.fingerprint, waiver, diagnostic, &workspace.working_directory)));
            found.extend(known.iter().map(|entry| entry.waiver.line));
        }
        let others = self.entries.values().flatten();
        let others = others.filter(|entry| !found.contains(&entry.waiver.line) && !run.covers(self, entry));
        lines.extend(others.map(|entry| (entry.waiver.line, format!("{}\n", entry.line))));
        lines.sort_by_key(|(place, _)| *place);
        let mut text = HEADER_TEXT.to_owned();
        text.extend(lines.into_iter().map(|(_, line)| line));
        escaping::lines(&text).into_owned()
    }

    /// Returns the text of this baseline, extended by a waiver for each finding with `code`, and the number of these findings.
    pub fn text_accepting(
        &self,
        findings: &[Diagnostic],
        code: Code,
        waiver: &Waiver,
        workspace: &Workspace,
    ) -> (String, usize) {
        let base = &workspace.working_directory;
        let (mut accepted, mut replaced) = (BTreeSet::new(), BTreeSet::new());
        let keyed = findings.iter().zip(self.keys(findings, base));
        for (diagnostic, key) in keyed.filter(|(diagnostic, _)| diagnostic.code() == code) {
            replaced.extend(self.entries(diagnostic, &key, workspace).iter().map(|entry| entry.waiver.line));
            accepted.insert(self.line(&key.fingerprint, waiver, diagnostic, base));
        }
        let lines = (1..).zip(self.text.lines());
        let kept = lines.filter(|(number, _)| !replaced.contains(number));
        let mut text: String = kept.flat_map(|(_, line)| [line, "\n"]).collect();
        text.extend(accepted.iter().map(String::as_str));
        (escaping::lines(&text).into_owned(), accepted.len())
    }

    /// Moves the findings that this baseline accepts to the waived findings. If the entry for a finding has expired or accepts only a smaller depth
    /// or a warning, the finding stays and gets a note about that.
    fn apply(&self, mut findings: Findings, workspace: &Workspace) -> Findings {
        let keys = self.keys(&findings.diagnostics, &workspace.working_directory);
        let (place, run) = (self.file.file_name().unwrap_or_default(), workspace.settings.date);
        for (diagnostic, key) in std::mem::take(&mut findings.diagnostics).into_iter().zip(keys) {
            let entry = self.entries(&diagnostic, &key, workspace).pop();
            let Some(entry) = entry.filter(|_| Self::may_accept(&diagnostic)) else {
                findings.diagnostics.push(diagnostic);
                continue;
            };
            if let Some((message, measures)) = entry.refusal(&diagnostic) {
                let place = ("place", Value::quoted(format!("{place}:{}", entry.waiver.line)));
                let arguments = [place].into_iter().chain(measures).collect();
                findings.diagnostics.push(diagnostic.note(message, arguments));
            } else if entry.waiver.holds(run) {
                findings.waived.push(WaivedFinding { diagnostic, waiver: entry.waiver.clone() });
            } else {
                findings.diagnostics.push(entry.waiver.note_end(diagnostic, place, run));
            }
        }
        findings
    }

    /// Returns a warning (PB610) for each entry that matches none of these findings although the run covered its file.
    fn unused_entry_warnings(&self, findings: &[Diagnostic], run: &RunCoverage<'_>) -> Vec<Diagnostic> {
        let keyed = findings.iter().zip(self.keys(findings, &run.workspace.working_directory));
        let used = keyed.flat_map(|(diagnostic, key)| self.entries(diagnostic, &key, run.workspace));
        let used: BTreeSet<u32> = used.map(|entry| entry.waiver.line).collect();
        let entries = self.entries.values().flatten();
        let unused = entries.filter(|entry| !used.contains(&entry.waiver.line) && run.covers(self, entry));
        let unused = unused.map(|entry| {
            let text = TextFault::new(&entry.line, 0..entry.line.len());
            Diagnostic { notes: Vec::new(), ..entry.waiver.unused_warning(&self.file) }.with_text(text)
        });
        unused.collect()
    }

    /// Returns the fingerprints of the findings, in the order of the findings. `base` is the directory that the findings' file names are relative to.
    fn keys(&self, findings: &[Diagnostic], base: &Utf8Path) -> Vec<FindingKey> {
        let place = |file: &Utf8Path| match self.name_below(file, base) {
            // Programs in different directories often have the same name, so the directory counts. For drawings it does not, so that their entries
            // still match after a drawing is moved.
            Some(below) if !is_drawing(file) => format!("./{below}"),
            _ => file.file_name().unwrap_or_default().to_owned(),
        };
        let has_name_only = |file: &Utf8Path| is_drawing(file) || self.name_below(file, base).is_none();
        let now = Fingerprint::within_files(findings, &place);
        let keys = findings.iter().zip(now).zip(Fingerprint::of(findings));
        let key = |((diagnostic, now), earlier): ((&Diagnostic, Fingerprint), Fingerprint)| FindingKey {
            fingerprint: now.to_string(),
            earlier: earlier.to_string(),
            has_name_only: diagnostic.file.as_deref().is_some_and(has_name_only),
        };
        keys.map(key).collect()
    }

    /// Returns the path of a file relative to the directory of the baseline, with slashes; `None` if the file is outside of it. `file` is relative to
    /// `base`.
    fn name_below(&self, file: &Utf8Path, base: &Utf8Path) -> Option<String> {
        let directory = clean(self.file.parent().unwrap_or(base));
        let full = clean(&base.join(file));
        Some(full.strip_prefix(&directory).ok()?.as_str().replace('\\', "/"))
    }

    /// Returns the entries for a finding; the last one applies. A fingerprint that contains only the name of a file could be that of another file, so
    /// an entry with it applies to the file that its description names, or, if that file no longer exists, to any file of the same name.
    fn entries(&self, diagnostic: &Diagnostic, key: &FindingKey, workspace: &Workspace) -> Vec<&Entry> {
        let find = |fingerprint: &String| self.entries.get(fingerprint).into_iter().flatten();
        let Some(file) = &diagnostic.file else { return find(&key.fingerprint).collect() };
        let base = &workspace.working_directory;
        let file = clean(&base.join(file));
        let named = |entry: &Entry| entry.possible_files([base, self.file.parent().unwrap_or(base)]);
        let is_own = |entry: &&Entry| named(entry).is_some_and(|named| named.contains(&file));
        let own: Vec<&Entry> = find(&key.earlier).chain(find(&key.fingerprint)).filter(is_own).collect();
        if !own.is_empty() {
            return own;
        }
        let is_missing = |file: &Utf8PathBuf| workspace.system.kind(file) == FileKind::Missing;
        let may_be_own = |entry: &&Entry| {
            !key.has_name_only || named(entry).is_none_or(|named| named.iter().all(is_missing))
        };
        find(&key.fingerprint).filter(may_be_own).collect()
    }

    fn line(&self, fingerprint: &str, waiver: &Waiver, diagnostic: &Diagnostic, base: &Utf8Path) -> String {
        let mut line = fingerprint.to_owned();
        if let Some(depth) = depth(diagnostic) {
            _ = write!(line, " depth={depth}");
        }
        if let Some(until) = waiver.until {
            _ = write!(line, " until={until}");
        }
        if let Some(reason) = &waiver.reason {
            _ = write!(line, " reason={}", serde_json::Value::from(&**reason));
        }
        if diagnostic.code().severity() == Severity::Error && !diagnostic.is_error() {
            line.push_str(" severity=warning");
        }
        _ = writeln!(line, " {}", self.description(diagnostic, base));
        line
    }

    /// Describes a finding without details that change whenever the CAD program saves the drawing, and always in English, so that the file does not
    /// depend on the user's language. File names are relative to the directory of the baseline if possible, otherwise to `base`.
    fn description(&self, diagnostic: &Diagnostic, base: &Utf8Path) -> String {
        let name = |file: &Utf8Path| {
            let name = self.name_below(file, base);
            name.unwrap_or_else(|| file.strip_prefix(base).unwrap_or(file).as_str().to_owned())
        };
        let file = diagnostic.file.as_deref().map(name).unwrap_or_default();
        let path = diagnostic.path.as_deref().unwrap_or_default();
        let point =
            diagnostic.place.point.map(|point| Value::from(point).render(Lang::En)).unwrap_or_default();
        let code = diagnostic.code().to_string();
        let words = [&code, &*file, path, &point, &diagnostic.text(Lang::En)];
        let words: Vec<&str> = words.into_iter().filter(|word| !word.is_empty()).collect();
        escaping::line(&words.join(" ")).into_owned()
    }

    fn parse(&mut self) -> Vec<Diagnostic> {
        let mut faults = Vec::new();
        for (number, line) in (1..).zip(self.text.lines()) {
            if line.trim().is_empty() || line.starts_with('#') {
                continue;
            }
            match entry(line) {
                Ok((fingerprint, mut entry)) => {
                    entry.waiver.line = number;
                    self.entries.entry(fingerprint.to_owned()).or_default().push(entry);
                }
                Err(fault) => faults.push(fault.in_file(&self.file, number, line)),
            }
        }
        faults
    }
}

impl Workspace {
    /// Returns the path of the baseline file: `named` if given; otherwise it lies beside the configuration or, without a configuration, in the
    /// working directory.
    pub fn baseline_file(&self, named: Option<&Utf8Path>) -> Utf8PathBuf {
        match named {
            Some(file) => self.working_directory.join(file),
            None => self.settings.directory().unwrap_or(&self.working_directory).join(FILE_NAME),
        }
    }

    /// Reads the named baseline, or the default one if it exists.
    ///
    /// # Errors
    /// If the baseline cannot be read or has faulty lines.
    pub(crate) fn read_baseline(
        &self,
        named: Option<&Utf8Path>,
    ) -> Result<Option<Baseline>, Vec<Diagnostic>> {
        let file = self.baseline_file(named);
        if named.is_none() && self.system.kind(&file) != FileKind::File {
            return Ok(None);
        }
        let (baseline, faults) = Baseline::read(&*self.system, &file, self.settings.limits.file_size.value)?;
        if faults.is_empty() { Ok(Some(baseline)) } else { Err(faults) }
    }

    /// Moves the findings that a baseline accepts to the waived findings. Adds warnings about waivers that no longer match any finding.
    pub(crate) fn without_accepted(
        &self,
        mut findings: Findings,
        baseline: Option<&Baseline>,
        coverage: impl FnOnce() -> Coverage,
    ) -> Findings {
        if baseline.is_none() && !self.has_waivers() {
            return findings;
        }
        let mut coverage = coverage();
        if !findings.diagnostics.iter().all(Baseline::may_accept) {
            // Something was not checked, so a file that was not found may still exist: only the checked files count as covered.
            coverage = Coverage { files: coverage.files, ..Coverage::default() };
        }
        let mut unused = self.unused_waivers(&findings, &coverage);
        if let Some(baseline) = baseline {
            unused.extend(
                baseline.unused_entry_warnings(&findings.diagnostics, &RunCoverage::new(self, &coverage)),
            );
            findings = baseline.apply(findings, self);
            let has_end = findings.waived.iter().any(|waived| waived.waiver.until.is_some());
            self.is_date_decisive.fetch_or(has_end, Ordering::Relaxed);
        }
        if !unused.is_empty() {
            findings.diagnostics.extend(self.findings(unused).diagnostics);
            findings.diagnostics = Findings::new(findings.diagnostics).diagnostics;
        }
        findings
    }
}

/// What a run covered, which decides whether an entry without a match is no longer needed.
struct RunCoverage<'a> {
    workspace: &'a Workspace,
    checked: BTreeSet<Utf8PathBuf>,
    has_directories: bool,
}

impl<'a> RunCoverage<'a> {
    fn new(workspace: &'a Workspace, coverage: &Coverage) -> Self {
        let checked = coverage.files.iter().map(|file| clean(&workspace.working_directory.join(file)));
        Self { workspace, checked: checked.collect(), has_directories: coverage.has_directories }
    }

    /// Whether a run covered the file of an entry. If so, an entry without a match is no longer needed.
    fn covers(&self, baseline: &Baseline, entry: &Entry) -> bool {
        let Workspace { system, working_directory, .. } = self.workspace;
        let bases = [working_directory, baseline.file.parent().unwrap_or(working_directory)];
        let Some(files) = entry.possible_files(bases) else { return false };
        files.iter().any(|file| self.checked.contains(file))
            || self.has_directories && files.iter().all(|file| system.kind(file) == FileKind::Missing)
    }
}

/// A note about a finding that an entry does not accept, with its arguments except for the place of the entry.
type Refusal = (&'static Message, Vec<(&'static str, Value)>);

impl Entry {
    /// Returns the reason why the entry does not accept a finding: it is deeper than stated, the depth is not stated, or a warning has become an
    /// error.
    fn refusal(&self, diagnostic: &Diagnostic) -> Option<Refusal> {
        match (depth(diagnostic), self.accepted_depth()) {
            (Some(depth), Some(accepted)) if depth > accepted => {
                let measures = vec![("accepted", Value::from(accepted)), ("depth", Value::from(depth))];
                Some((&messages::WAIVER_DEEPER, measures))
            }
            (Some(_), None) if must_state_depth(diagnostic.code()) => {
                Some((&messages::WAIVER_WITHOUT_DEPTH, Vec::new()))
            }
            _ if self.is_for_warning && diagnostic.is_error() => {
                Some((&messages::WAIVER_OF_WARNING, Vec::new()))
            }
            _ => None,
        }
    }

    /// Returns the depth up to which the entry accepts a finding. Versions up to 0.2.0 wrote the depth of a cut into a part only in the description.
    /// It must not be ignored, because it decided whether the finding was a warning.
    fn accepted_depth(&self) -> Option<f64> {
        let described = || {
            let (depth, _) = self.description.split_once(" mm into the part")?;
            depth.rsplit(' ').next()?.parse().ok()
        };
        self.depth.or_else(|| described().map(rounded_up))
    }

    /// Returns the files that the description may name after the code. There are several, because it is unclear where a name with spaces ends. `None`
    /// if the description does not begin with a code.
    fn possible_files(&self, bases: [&Utf8Path; 2]) -> Option<Vec<Utf8PathBuf>> {
        let (code, rest) = self.description.split_once(' ')?;
        code.parse::<Code>().ok()?;
        let ends = rest.match_indices(' ').map(|(end, _)| end).chain([rest.len()]);
        let files = ends.flat_map(|end| bases.map(|base| clean(&base.join(&rest[..end]))));
        Some(files.collect())
    }
}

const HEADER_TEXT: &str = "\
# Known findings of pathbuild. `pathbuild check --baseline FILE --update-baseline` rewrites this file.
# Only the fingerprint at the beginning of a line counts, with until=DATE and reason=\"TEXT\" after it; the rest describes the finding.
";

/// Returns the measure in mm by which a finding can become worse at the same place, rounded up to 0.01 mm: the depth of the tool in the material, in
/// a part or in a clamp, the distance beyond the machine's travel, the lost part of a support bar, the material that remains at a part, or the excess
/// over the length of the cutting edges. `None` for other findings.
fn depth(diagnostic: &Diagnostic) -> Option<f64> {
    let number = |name| Some(diagnostic.argument(name)?.number()?.0);
    let depth = match diagnostic.code() {
        Code::RapidInMaterial
        | Code::RapidPlunge
        | Code::EndNotRaised
        | Code::DiagonalRapid
        | Code::ToolChangeAtDepth
        | Code::StopAtDepth
        | Code::InsideKeepOut => number("height").or_else(|| number("surface"))? - number("z")?,
        Code::OutsideMachine => match (number("value"), number("size")) {
            (Some(value), _) => (number("least")? - value).max(value - number("most")?),
            (None, size) => size? - number("most")?,
        },
        Code::GougedPart | Code::GougedNeighbour => number("depth")?,
        Code::BarCutAway => number("lost")?,
        Code::LeftoverAtPart => number("thickness").or_else(|| number("height"))?,
        Code::CutDeeperThanEdges => number("depth")? - number("length")?,
        _ => return None,
    };
    Some(rounded_up(depth))
}

/// Rounds a depth up to 0.01 mm, after rounding it to 0.001 mm as in messages.
fn rounded_up(depth: f64) -> f64 {
    ((depth * 1000.0).round() / 10.0).ceil() / 100.0
}

/// Whether entries for a finding with this code must state its depth. Entries for other findings may lack it, because versions up to 0.2.0 did not
/// write it.
fn must_state_depth(code: Code) -> bool {
    matches!(
        code,
        Code::RapidInMaterial
            | Code::RapidPlunge
            | Code::EndNotRaised
            | Code::DiagonalRapid
            | Code::ToolChangeAtDepth
            | Code::OutsideMachine
    )
}

/// A fault in a line, with the part of the line that is wrong.
struct LineFault {
    message: &'static Message,
    part: std::ops::Range<usize>,
}

impl LineFault {
    fn in_file(self, file: &Utf8Path, number: u32, line: &str) -> Diagnostic {
        let column = line[..self.part.start].chars().count() + 1;
        let found = line[self.part.clone()].trim_start_matches("until=").trim_start_matches("depth=");
        Diagnostic::new(self.message)
            .quoting("found", found)
            .in_file(file)
            .at_line(number, u32::try_from(column).ok())
            .with_text(TextFault::new(line, self.part))
    }
}

fn entry(line: &str) -> Result<(&str, Entry), LineFault> {
    let Some(fingerprint) = fingerprint(line) else {
        let start = line.len() - line.trim_start().len();
        let end = start + line.split_whitespace().next().unwrap_or_default().len();
        return Err(LineFault { message: &messages::BASELINE_LINE, part: start..end });
    };
    let (mut waiver, mut depth, mut is_for_warning) = (Waiver::default(), None, false);
    let mut rest = line[fingerprint.len()..].trim_start();
    loop {
        let start = line.len() - rest.len();
        let word = rest.split_whitespace().next().unwrap_or_default();
        if let Some(date) = word.strip_prefix("until=") {
            let fault = |()| LineFault { message: &messages::BASELINE_DATE, part: start..start + word.len() };
            waiver.until = Some(date.parse().map_err(fault)?);
            rest = rest[word.len()..].trim_start();
        } else if let Some(number) = word.strip_prefix("depth=") {
            let number: Option<f64> = number.parse().ok().filter(|number: &f64| number.is_finite());
            let fault = || LineFault { message: &messages::BASELINE_DEPTH, part: start..start + word.len() };
            depth = Some(number.ok_or_else(fault)?);
            rest = rest[word.len()..].trim_start();
        } else if let Some(text) = rest.strip_prefix("reason=") {
            let fault = LineFault { message: &messages::BASELINE_REASON, part: start..start + word.len() };
            let mut texts = serde_json::Deserializer::from_str(text).into_iter::<Box<str>>();
            let Some(Ok(reason)) = texts.next() else { return Err(fault) };
            waiver.reason = Some(reason);
            rest = text[texts.byte_offset()..].trim_start();
        } else if word == "severity=warning" {
            is_for_warning = true;
            rest = rest[word.len()..].trim_start();
        } else if let Some(message) = misspelt_field(word) {
            return Err(LineFault { message, part: start..start + word.len() });
        } else {
            let (description, line) = (rest.trim_end().to_owned(), line.to_owned());
            return Ok((fingerprint, Entry { waiver, depth, is_for_warning, description, line }));
        }
    }
}

/// Returns the message about a word that begins with the name of a field but is not a valid field, such as `until:2026-12-31`. Without this check,
/// the word would count as the beginning of the description, and the waiver would never end.
fn misspelt_field(word: &str) -> Option<&'static Message> {
    let name = word.split(['=', ':']).next().unwrap_or_default();
    let fields = [
        ("until", &messages::BASELINE_DATE),
        ("depth", &messages::BASELINE_DEPTH),
        ("reason", &messages::BASELINE_REASON),
        ("severity", &messages::BASELINE_SEVERITY),
    ];
    fields.into_iter().find_map(|(field, message)| name.eq_ignore_ascii_case(field).then_some(message))
}

fn fingerprint(line: &str) -> Option<&str> {
    let word = line.split_whitespace().next()?;
    let is_hexadecimal = |c: char| c.is_ascii_digit() || ('a'..='f').contains(&c);
    (word.len() == 32 && line.starts_with(word) && word.chars().all(is_hexadecimal)).then_some(word)
}
