//! Baselines: text files with one known finding per line, which users can read, merge and shorten. Only the fingerprint at the beginning of
//! a line counts; the rest describes the finding. Empty lines and lines that begin with `#` are comments.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::{self, Write};

use camino::Utf8Path;
use pathbuild_db::System;
use pathbuild_db::system::ReadError;
use pathbuild_diagnostic::messages::configuration as messages;
use pathbuild_diagnostic::{Diagnostic, TextFault, Value, shown};
use pathbuild_workspace::files;

use super::Findings;
use crate::render::View;

/// Known findings, which are not reported.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Baseline {
    fingerprints: BTreeSet<String>,
}

/// Findings compared with a baseline.
pub(super) struct BaselineComparison {
    /// Findings that are not in the baseline.
    pub(super) new: Findings,
    /// Number of findings that are in the baseline.
    pub(super) known: usize,
    /// Number of entries in the baseline that match no finding.
    pub(super) gone: usize,
}

impl Baseline {
    /// Reads a baseline file of at most `limit` bytes.
    ///
    /// # Errors
    /// Why it cannot be read.
    pub fn read(system: &dyn System, file: &Utf8Path, limit: u64) -> Result<Self, Vec<Diagnostic>> {
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
    pub fn text(findings: &Findings, view: &View) -> String {
        let mut text = HEAD.to_owned();
        for (diagnostic, fingerprint) in
            findings.diagnostics.iter().zip(Fingerprint::of(&findings.diagnostics))
        {
            _ = writeln!(text, "{fingerprint} {}", description(diagnostic, view));
        }
        shown::lines(&text).into_owned()
    }

    pub(super) fn compare(&self, findings: Findings) -> BaselineComparison {
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

/// A 128-bit hash that identifies a finding, displayed as 32 hexadecimal digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Fingerprint(u128);

impl Fingerprint {
    /// Fingerprints of findings, in their order.
    pub fn of(diagnostics: &[Diagnostic]) -> Vec<Self> {
        let mut met: BTreeMap<u128, u32> = BTreeMap::new();
        let mut fingerprint = |diagnostic| {
            let hash = hash(diagnostic);
            let number = met.entry(hash.0).and_modify(|number| *number += 1).or_insert(0);
            Self(hash.and(&number.to_le_bytes()).0)
        };
        diagnostics.iter().map(&mut fingerprint).collect()
    }
}

impl fmt::Display for Fingerprint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:032x}", self.0)
    }
}

fn hash(diagnostic: &Diagnostic) -> Hash {
    let place = &diagnostic.place;
    let point = place.point.map(|point| format!("{:.3} {:.3}", point.x.0 + 0.0, point.y.0 + 0.0));
    let fault = diagnostic.text.as_ref().map(|fault| &fault.text[fault.span()]);
    Hash::NEW
        .and(diagnostic.code().to_string().as_bytes())
        .and(diagnostic.file.as_ref().and_then(|file| file.file_name()).unwrap_or_default().as_bytes())
        .and(diagnostic.path.as_deref().unwrap_or_default().to_uppercase().as_bytes())
        .and(place.entity.map_or("", |entity| entity.name()).as_bytes())
        .and(point.unwrap_or_default().as_bytes())
        .and(fault.unwrap_or_default().as_bytes())
}

/// 128-bit FNV-1a, which is the same on every machine and in every version.
#[derive(Clone, Copy)]
struct Hash(u128);

impl Hash {
    const NEW: Self = Self(0x6c62_272e_07bb_0142_62b8_2175_6295_c58d);
    const PRIME: u128 = 0x0000_0000_0100_0000_0000_0000_0000_013b;

    /// Adds bytes, followed by a separator that does not occur in UTF-8.
    fn and(self, bytes: &[u8]) -> Self {
        bytes
            .iter()
            .chain(&[0xff])
            .fold(self, |hash, byte| Self((hash.0 ^ u128::from(*byte)).wrapping_mul(Self::PRIME)))
    }
}
