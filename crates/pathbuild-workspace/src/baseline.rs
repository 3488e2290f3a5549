//! Baselines: text files with one accepted finding per line, which users can read, merge and shorten. A line begins with the fingerprint of the
//! finding; `depth=` in mm, `until=` with a date and `reason=` with a text in double quotes may follow. The remainder of the line describes the
//! finding. Empty lines and lines that begin with `#` are comments. (book: howto/ci)

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::sync::atomic::Ordering;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::System;
use pathbuild_db::system::{FileKind, ReadError, is_drawing};
use pathbuild_diagnostic::messages::configuration as messages;
use pathbuild_diagnostic::{Code, Diagnostic, Lang, Message, TextFault, Value, shown};

use crate::config::clean;
use crate::files;
use crate::findings::{Findings, Fingerprint};
use crate::waivers::{Coverage, RunDate, WaivedFinding, Waiver};
use crate::workspace::Workspace;

/// File name of the default baseline, which lies beside `pathbuild.toml`.
const FILE_NAME: &str = "pathbuild-baseline.txt";

/// The accepted findings in a baseline file. They are not reported.
#[derive(Clone, Debug, Default)]
pub struct Baseline {
    file: Utf8PathBuf,
    /// Text of the file, unchanged.
    text: String,
    entries: BTreeMap<String, Entry>,
}

/// The content of a line after its fingerprint, and the line itself.
#[derive(Clone, Debug)]
struct Entry {
    waiver: Waiver,
    /// Depth in mm up to which the finding is accepted, for findings about a tool in the material or outside the machine's travel.
    depth: Option<f64>,
    description: String,
    line: String,
}

/// Fingerprints by which a baseline may identify a finding.
struct FindingKey {
    fingerprint: String,
    /// The finding's fingerprint in the form that versions up to 0.2.0 wrote into baselines.
    earlier: String,
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
        let mut baseline = Self { text, ..Self::new(file) };
        let faults = baseline.parse();
        Ok((baseline, faults))
    }

    /// Whether a baseline may accept a finding: nothing is known about a file that cannot be read.
    pub fn may_accept(finding: &Diagnostic) -> bool {
        finding.code() != Code::UnreadableFile
    }

    /// Returns the text of a baseline that contains all these findings. Entries that still match keep their reasons and dates. Entries for files that
    /// the run did not cover stay as they are.
    pub fn rewritten_text(
        &self,
        findings: &[Diagnostic],
        workspace: &Workspace,
        coverage: &Coverage,
    ) -> String {
        let run = Run::new(workspace, coverage);
        let mut text = HEADER_TEXT.to_owned();
        let mut found = BTreeSet::new();
        for (diagnostic, key) in findings.iter().zip(self.keys(findings, &workspace.working_directory)) {
            let none = Waiver::default();
            let known = self.entry(diagnostic, &key, &workspace.working_directory);
            let waiver = known.map_or(&none, |(_, entry)| &entry.waiver);
            text.push_str(&line(&key.fingerprint, waiver, diagnostic, &workspace.working_directory));
            found.extend(known.map(|(fingerprint, _)| fingerprint.to_owned()));
            found.insert(key.fingerprint);
        }
        let others =
            self.entries.iter().filter(|(known, entry)| !found.contains(*known) && !run.covers(self, entry));
        text.extend(others.flat_map(|(_, entry)| [&*entry.line, "\n"]));
        shown::lines(&text).into_owned()
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
        let (mut accepted, mut replaced) = (BTreeMap::new(), BTreeSet::new());
        let keyed = findings.iter().zip(self.keys(findings, base));
        for (diagnostic, key) in keyed.filter(|(diagnostic, _)| diagnostic.code() == code) {
            replaced.extend(self.entry(diagnostic, &key, base).map(|(known, _)| known));
            let line = line(&key.fingerprint, waiver, diagnostic, base);
            accepted.insert(key.fingerprint, line);
        }
        let is_kept = |line: &&str| {
            fingerprint(line).is_none_or(|known| !accepted.contains_key(known) && !replaced.contains(known))
        };
        let mut text: String = self.text.lines().filter(is_kept).flat_map(|line| [line, "\n"]).collect();
        text.extend(accepted.values().map(String::as_str));
        (shown::lines(&text).into_owned(), accepted.len())
    }

    /// Moves the findings that this baseline accepts to the waived findings. If the entry for a finding has expired or accepts only a smaller depth,
    /// the finding stays and gets a note about that.
    fn apply(&self, mut findings: Findings, run: Option<RunDate>, base: &Utf8Path) -> Findings {
        let keys = self.keys(&findings.diagnostics, base);
        let place = self.file.file_name().unwrap_or_default();
        for (diagnostic, key) in std::mem::take(&mut findings.diagnostics).into_iter().zip(keys) {
            let entry = self.entry(&diagnostic, &key, base).map(|(_, entry)| entry);
            let entry = entry.filter(|_| Self::may_accept(&diagnostic));
            match entry.map(|entry| &entry.waiver) {
                None => findings.diagnostics.push(diagnostic),
                Some(_) if entry.is_some_and(|entry| !entry.is_deep_enough(&diagnostic)) => {
                    findings.diagnostics.extend(entry.map(|entry| entry.note_depth(diagnostic, place)));
                }
                Some(waiver) if waiver.holds(run) => {
                    findings.waived.push(WaivedFinding { diagnostic, waiver: waiver.clone() });
                }
                Some(waiver) => findings.diagnostics.push(waiver.note_end(diagnostic, place, run)),
            }
        }
        findings
    }

    /// Returns a warning (PB610) for each entry that matches none of these findings although the run covered its file.
    fn unused(&self, findings: &[Diagnostic], run: &Run<'_>) -> Vec<Diagnostic> {
        let base = run.working_directory;
        let keyed = findings.iter().zip(self.keys(findings, base));
        let found: BTreeSet<&str> = keyed
            .filter_map(|(diagnostic, key)| self.entry(diagnostic, &key, base).map(|(known, _)| known))
            .collect();
        let unused = self
            .entries
            .iter()
            .filter(|(known, entry)| !found.contains(known.as_str()) && run.covers(self, entry));
        let unused = unused.map(|(_, entry)| {
            let text = TextFault::new(&entry.line, 0..entry.line.len());
            Diagnostic { notes: Vec::new(), ..entry.waiver.unused_warning(&self.file) }.with_text(text)
        });
        unused.collect()
    }

    /// Returns the fingerprints of the findings, in the order of the findings. `base` is the directory that the findings' file names are relative to.
    fn keys(&self, findings: &[Diagnostic], base: &Utf8Path) -> Vec<FindingKey> {
        let now = Fingerprint::with_places(findings, &|file| self.place(file, base));
        let keys = now.iter().zip(Fingerprint::of(findings));
        let text = |(now, earlier): (&Fingerprint, Fingerprint)| FindingKey {
            fingerprint: now.to_string(),
            earlier: earlier.to_string(),
        };
        keys.map(text).collect()
    }

    /// Returns the name of a file in fingerprints. A program is identified by its path from the directory of the baseline, because different
    /// programs often have the same name. A drawing is identified by its name alone, so that its findings stay the same when it is moved.
    fn place(&self, file: &Utf8Path, base: &Utf8Path) -> String {
        let name = file.file_name().unwrap_or_default();
        let directory = clean(self.file.parent().unwrap_or(base));
        let full = clean(&base.join(file));
        let below = full.strip_prefix(&directory).ok().filter(|_| !is_drawing(file));
        below.map_or(name.to_owned(), |below| format!("./{}", below.as_str().replace('\\', "/")))
    }

    /// Returns the entry for a finding, and the fingerprint in that entry. Entries of earlier versions identify a program by its file name alone, so
    /// they apply only to the file that their description names.
    fn entry(&self, diagnostic: &Diagnostic, key: &FindingKey, base: &Utf8Path) -> Option<(&str, &Entry)> {
        let find = |fingerprint: &String| self.entries.get_key_value(fingerprint);
        let is_of_file = |entry: &Entry| {
            let bases = [base, self.file.parent().unwrap_or(base)];
            let file = diagnostic.file.as_deref().map(|file| clean(&base.join(file)));
            file.is_none_or(|file| entry.possible_files(bases).is_some_and(|named| named.contains(&file)))
        };
        let known = find(&key.fingerprint);
        let known = known.or_else(|| find(&key.earlier).filter(|(_, entry)| is_of_file(entry)));
        known.map(|(fingerprint, entry)| (fingerprint.as_str(), entry))
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
                    self.entries.insert(fingerprint.to_owned(), entry);
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
        let coverage = coverage();
        let mut unused = self.unused_waivers(&findings, &coverage);
        if let Some(baseline) = baseline {
            unused.extend(baseline.unused(&findings.diagnostics, &Run::new(self, &coverage)));
            findings = baseline.apply(findings, self.settings.date, &self.working_directory);
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

struct Run<'a> {
    system: &'a dyn System,
    working_directory: &'a Utf8Path,
    checked: BTreeSet<Utf8PathBuf>,
    has_directories: bool,
}

impl<'a> Run<'a> {
    fn new(workspace: &'a Workspace, coverage: &Coverage) -> Self {
        let working_directory = &workspace.working_directory;
        let checked = coverage.files.iter().map(|file| clean(&working_directory.join(file))).collect();
        let system = &*workspace.system;
        Self { system, working_directory, checked, has_directories: coverage.has_directories }
    }

    /// Whether a run covered the file of an entry. If so, an entry without a match is no longer needed.
    fn covers(&self, baseline: &Baseline, entry: &Entry) -> bool {
        let bases = [self.working_directory, baseline.file.parent().unwrap_or(self.working_directory)];
        let Some(files) = entry.possible_files(bases) else { return false };
        files.iter().any(|file| self.checked.contains(file))
            || self.has_directories && files.iter().all(|file| self.system.kind(file) == FileKind::Missing)
    }
}

impl Entry {
    /// Whether the entry accepts the depth of a finding. Findings without a depth always pass.
    fn is_deep_enough(&self, diagnostic: &Diagnostic) -> bool {
        depth(diagnostic).is_none_or(|depth| self.depth.is_some_and(|accepted| depth <= accepted))
    }

    /// Adds a note to a finding that is not accepted because the entry states a smaller depth, or none.
    fn note_depth(&self, diagnostic: Diagnostic, file: &str) -> Diagnostic {
        let place = ("place", Value::quoted(format!("{file}:{}", self.waiver.line)));
        match (self.depth, depth(&diagnostic)) {
            (Some(accepted), Some(depth)) => {
                let depths = [("accepted", Value::from(accepted)), ("depth", Value::from(depth))];
                diagnostic.note(&messages::WAIVER_DEEPER, [place].into_iter().chain(depths).collect())
            }
            _ => diagnostic.note(&messages::WAIVER_WITHOUT_DEPTH, vec![place]),
        }
    }

    /// Returns the files that the description may name after the code, several because file names may contain spaces; `None` if the description
    /// does not begin with a code.
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

/// Returns how deep the tool is in the material, or how far it leaves the machine's travel, in mm, rounded up to 0.01 mm; `None` for findings without
/// such a depth.
fn depth(diagnostic: &Diagnostic) -> Option<f64> {
    let number = |name| match diagnostic.arguments.iter().find(|(key, _)| *key == name) {
        Some((_, Value::Number(number))) => Some(number.0),
        _ => None,
    };
    let depth = match diagnostic.code() {
        Code::RapidInMaterial
        | Code::RapidPlunge
        | Code::EndNotRaised
        | Code::DiagonalRapid
        | Code::ToolChangeAtDepth => number("height").or_else(|| number("surface"))? - number("z")?,
        Code::OutsideMachine => match (number("value"), number("size")) {
            (Some(value), _) => (number("least")? - value).max(value - number("most")?),
            (None, size) => size? - number("most")?,
        },
        _ => return None,
    };
    Some((depth * 100.0 - ROUNDING_SHARE).ceil() / 100.0)
}

/// Fraction of 0.01 mm that is ignored as a rounding error instead of being rounded up.
const ROUNDING_SHARE: f64 = 1e-6;

fn line(fingerprint: &str, waiver: &Waiver, diagnostic: &Diagnostic, base: &Utf8Path) -> String {
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
    _ = writeln!(line, " {}", description(diagnostic, base));
    line
}

/// Describes a finding without details that change whenever the CAD program saves the drawing, and always in English, so that the file does not
/// depend on the user's language. File names are relative to `base`.
fn description(diagnostic: &Diagnostic, base: &Utf8Path) -> String {
    let file = diagnostic.file.as_deref().map(|file| file.strip_prefix(base).unwrap_or(file).as_str());
    let path = diagnostic.path.as_deref().unwrap_or_default();
    let point = diagnostic.place.point.map(|point| Value::from(point).render(Lang::En)).unwrap_or_default();
    let code = diagnostic.code().to_string();
    let words = [&code, file.unwrap_or_default(), path, &point, &diagnostic.text(Lang::En)];
    let words: Vec<&str> = words.into_iter().filter(|word| !word.is_empty()).collect();
    shown::line(&words.join(" ")).into_owned()
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
    let (mut waiver, mut depth) = (Waiver::default(), None);
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
        } else {
            let description = rest.trim_end().to_owned();
            return Ok((fingerprint, Entry { waiver, depth, description, line: line.to_owned() }));
        }
    }
}

fn fingerprint(line: &str) -> Option<&str> {
    let word = line.split_whitespace().next()?;
    let is_hexadecimal = |c: char| c.is_ascii_digit() || ('a'..='f').contains(&c);
    (word.len() == 32 && line.starts_with(word) && word.chars().all(is_hexadecimal)).then_some(word)
}
