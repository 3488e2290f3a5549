//! Baselines: text files with one known finding per line, which users can read, merge and shorten. Only the fingerprint at the beginning of
//! a line counts; the rest describes the finding. Empty lines and lines that begin with `#` are comments.

use std::collections::BTreeSet;
use std::fmt::Write;

use camino::Utf8Path;
use pathbuild_db::System;
use pathbuild_db::system::ReadError;
use pathbuild_diagnostic::messages::configuration as messages;
use pathbuild_diagnostic::{Diagnostic, TextFault, Value, shown};
use pathbuild_workspace::files;
use pathbuild_workspace::findings::Findings;

use crate::render::{Fingerprint, View};

/// Known findings, which are not reported.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Baseline {
    fingerprints: BTreeSet<String>,
}

/// Findings compared with a baseline.
pub(crate) struct BaselineComparison {
    /// Findings that are not in the baseline.
    pub(crate) new: Findings,
    /// Number of findings that are in the baseline.
    pub(crate) known: usize,
    /// Number of entries in the baseline that match no finding.
    pub(crate) gone: usize,
}

impl Baseline {
    /// Reads a baseline file of at most `limit` bytes.
    ///
    /// # Errors
    /// Why it cannot be read.
    pub(crate) fn read(system: &dyn System, file: &Utf8Path, limit: u64) -> Result<Self, Vec<Diagnostic>> {
        let text = files::read(system, file, limit).map_err(|reason| {
            vec![match system.read(file, limit) {
                // Reports the configuration key of the limit, as for other files.
                Err(error @ ReadError::TooLarge { .. }) => error.diagnostic(limit, "file-size").in_file(file),
                _ => Diagnostic::new(&messages::BASELINE_UNREADABLE).in_file(file).with("reason", reason),
            }]
        })?;
        Self::parse(file, &text)
    }

    /// The text of a baseline that contains all these findings.
    pub(crate) fn text(findings: &Findings, view: &View) -> String {
        let mut text = HEAD.to_owned();
        for (diagnostic, fingerprint) in
            findings.diagnostics.iter().zip(Fingerprint::of(&findings.diagnostics))
        {
            _ = writeln!(text, "{fingerprint} {}", description(diagnostic, view));
        }
        shown::lines(&text).into_owned()
    }

    pub(crate) fn compare(&self, findings: Findings) -> BaselineComparison {
        let fingerprints = Fingerprint::of(&findings.diagnostics);
        let found = findings.diagnostics.len();
        let is_new =
            |(_, fingerprint): &(_, Fingerprint)| !self.fingerprints.contains(&fingerprint.to_string());
        let new: Vec<_> = findings
            .diagnostics
            .into_iter()
            .zip(fingerprints)
            .filter(is_new)
            .map(|(diagnostic, _)| diagnostic)
            .collect();
        let known = found - new.len();
        BaselineComparison {
            known,
            gone: self.fingerprints.len() - known,
            new: Findings { diagnostics: new, checked: findings.checked },
        }
    }

    fn parse(file: &Utf8Path, text: &str) -> Result<Self, Vec<Diagnostic>> {
        let mut baseline = Self::default();
        let mut faults = Vec::new();
        for (number, line) in
            (1..).zip(text.lines()).filter(|(_, line)| !line.trim().is_empty() && !line.starts_with('#'))
        {
            match fingerprint(line) {
                Some(fingerprint) => _ = baseline.fingerprints.insert(fingerprint.to_owned()),
                None => faults.push(fault(file, number, line)),
            }
        }
        if faults.is_empty() { Ok(baseline) } else { Err(faults) }
    }
}

const HEAD: &str = "\
# Known findings of pathbuild. `pathbuild check --baseline FILE --update-baseline` rewrites this file.
# Only the fingerprint at the beginning of a line counts; the rest describes the finding.
";

/// Describes the finding without details that change whenever the CAD program saves the drawing.
fn description(diagnostic: &Diagnostic, view: &View) -> String {
    let file = view.file(diagnostic).unwrap_or_default();
    let path = diagnostic.path.as_deref().unwrap_or_default();
    let point = diagnostic.place.point.map(|point| Value::from(point).render(view.lang)).unwrap_or_default();
    let words = [&*diagnostic.code().to_string(), &file, path, &point, &diagnostic.text(view.lang)];
    let words: Vec<&str> = words.into_iter().filter(|word| !word.is_empty()).collect();
    shown::line(&words.join(" ")).into_owned()
}

fn fingerprint(line: &str) -> Option<&str> {
    let word = line.split_whitespace().next()?;
    let is_hexadecimal = |c: char| c.is_ascii_digit() || ('a'..='f').contains(&c);
    (word.len() == 32 && line.starts_with(word) && word.chars().all(is_hexadecimal)).then_some(word)
}

fn fault(file: &Utf8Path, number: u32, line: &str) -> Diagnostic {
    let word =
        line.len() - line.trim_start().len() + line.split_whitespace().next().unwrap_or_default().len();
    Diagnostic::new(&messages::BASELINE_LINE)
        .in_file(file)
        .at_line(number, Some(1))
        .with_text(TextFault::new(line, 0..word))
}
