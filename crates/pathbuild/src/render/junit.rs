//! `JUnit` XML: a suite for each drawing, a test case for each of its paths, which fails when the path has errors. Errors of the file
//! itself fail a case named after the file. Warnings are output of their case.

use std::collections::BTreeMap;
use std::fmt::Write;

use camino::Utf8Path;
use pathbuild_diagnostic::{Diagnostic, shown};

use super::{View, concise};
use crate::report::Findings;

pub(super) fn render(findings: &Findings, view: &View) -> String {
    let suites = suites(findings);
    let mut text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n".to_owned();
    let all = || suites.values().flat_map(BTreeMap::values);
    _ = writeln!(text, "<testsuites name=\"pathbuild\"{}>", totals(all()));
    for (file, cases) in &suites {
        let name = file.map_or_else(|| "pathbuild".into(), |file| view.name(file));
        _ = writeln!(text, "  <testsuite name=\"{}\"{}>", escaped(&name), totals(cases.values()));
        for (path, case) in cases {
            let path = path.map_or_else(|| name.clone(), shown::line);
            write_case(&mut text, &path, &name, case, view);
        }
        text.push_str("  </testsuite>\n");
    }
    text.push_str("</testsuites>\n");
    text
}

type Suites<'a> = BTreeMap<Option<&'a Utf8Path>, BTreeMap<Option<&'a str>, Case<'a>>>;

#[derive(Default)]
struct Case<'a> {
    errors: Vec<&'a Diagnostic>,
    warnings: Vec<&'a Diagnostic>,
}

/// Every path that was checked, and every file or path that something is wrong with.
fn suites(findings: &Findings) -> Suites<'_> {
    let mut suites = Suites::new();
    for file in &findings.checked {
        let suite = suites.entry(Some(&file.file)).or_default();
        suite.extend(file.paths.iter().map(|path| (Some(path.as_str()), Case::default())));
    }
    for diagnostic in &findings.diagnostics {
        let suite = suites.entry(diagnostic.file.as_deref()).or_default();
        let case = suite.entry(diagnostic.path.as_deref()).or_default();
        if diagnostic.is_error() { case.errors.push(diagnostic) } else { case.warnings.push(diagnostic) }
    }
    suites.retain(|_, cases| !cases.is_empty());
    suites
}

fn totals<'a, 'b: 'a>(cases: impl Iterator<Item = &'a Case<'b>>) -> String {
    let (mut tests, mut failures) = (0, 0);
    for case in cases {
        tests += 1;
        failures += usize::from(!case.errors.is_empty());
    }
    format!(" tests=\"{tests}\" failures=\"{failures}\" errors=\"0\"")
}

fn write_case(text: &mut String, name: &str, file: &str, case: &Case<'_>, view: &View) {
    let (name, file) = (escaped(name), escaped(file));
    // Surefire's schema wants a time; what is found does not depend on the clock.
    _ = write!(text, "    <testcase name=\"{name}\" classname=\"{file}\" file=\"{file}\" time=\"0\"");
    if case.errors.is_empty() && case.warnings.is_empty() {
        text.push_str("/>\n");
        return;
    }
    text.push_str(">\n");
    if let [first, others @ ..] = &*case.errors {
        let more = if others.is_empty() { String::new() } else { format!(" (+{})", others.len()) };
        let message = escaped(&format!("{}{more}", first.text(view.lang)));
        _ = writeln!(
            text,
            "      <failure type=\"{}\" message=\"{message}\">{}</failure>",
            first.code(),
            lines(&case.errors, view)
        );
    }
    if !case.warnings.is_empty() {
        _ = writeln!(text, "      <system-out>{}</system-out>", lines(&case.warnings, view));
    }
    text.push_str("    </testcase>\n");
}

fn lines(diagnostics: &[&Diagnostic], view: &View) -> String {
    let lines: String = diagnostics.iter().map(|diagnostic| body(diagnostic, view)).collect();
    escaped(lines.trim_end())
}

/// A line as in a log, and below it what to do.
fn body(diagnostic: &Diagnostic, view: &View) -> String {
    let mut body = concise::line(diagnostic, view);
    for line in view.help(diagnostic).iter().flat_map(|help| help.lines()) {
        _ = writeln!(body, "  {line}");
    }
    body
}

/// Text in XML 1.0, which has no way to write most control characters: none is left when what acts is escaped.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len() + 16);
    for c in shown::lines(text).chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&apos;"),
            '\n' => escaped.push_str("&#10;"),
            c => escaped.push(c),
        }
    }
    escaped
}
