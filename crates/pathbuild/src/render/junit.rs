//! Renders findings as `JUnit` XML: a test suite per drawing or program, and a test case per path, which fails if the path has errors. Errors of
//! a drawing itself fail a test case named after it. A program is a single test case. Warnings are the output of their test case.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::time::Duration;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::{Diagnostic, escaping};
use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};

use super::{View, concise};
use pathbuild_workspace::findings::Findings;

pub(super) fn render(findings: &Findings, view: &View) -> String {
    let mut report = Report::new("pathbuild");
    for (file, cases) in suites(findings) {
        let name = file.map_or_else(|| "pathbuild".into(), |file| view.name(file));
        let mut suite = TestSuite::new(&*name);
        for (path, case) in cases {
            let path = path.map_or_else(|| name.clone(), escaping::line);
            suite.add_test_case(case.test_case(&path, &name, view));
        }
        report.add_test_suite(suite);
    }
    report.to_string().unwrap_or_else(|error| error.to_string())
}

type SuitesByFile<'a> = BTreeMap<Option<&'a Utf8Path>, BTreeMap<Option<&'a str>, TestOutcome<'a>>>;

#[derive(Default)]
struct TestOutcome<'a> {
    errors: Vec<&'a Diagnostic>,
    warnings: Vec<&'a Diagnostic>,
}

/// Returns all checked paths and programs, and all files and paths with findings, as test suites.
fn suites(findings: &Findings) -> SuitesByFile<'_> {
    let mut suites = SuitesByFile::new();
    for file in &findings.checked {
        let suite = suites.entry(Some(&file.file)).or_default();
        suite.extend(file.paths.iter().map(|path| (Some(path.as_str()), TestOutcome::default())));
    }
    let programs: BTreeSet<&Utf8Path> = findings.programs.iter().map(Utf8PathBuf::as_path).collect();
    for program in &programs {
        suites.entry(Some(program)).or_default().insert(None, TestOutcome::default());
    }
    for diagnostic in &findings.diagnostics {
        let file = diagnostic.file.as_deref();
        let path = diagnostic.path.as_deref().filter(|_| file.is_none_or(|file| !programs.contains(file)));
        let case = suites.entry(file).or_default().entry(path).or_default();
        if diagnostic.is_error() { case.errors.push(diagnostic) } else { case.warnings.push(diagnostic) }
    }
    suites.retain(|_, cases| !cases.is_empty());
    suites
}

impl TestOutcome<'_> {
    fn test_case(&self, name: &str, file: &str, view: &View) -> TestCase {
        let mut shown = TestCase::new(name, self.status(view));
        shown.set_classname(file);
        shown.extra.insert("file".into(), file.into());
        // Surefire's schema requires a time. It is zero, because results must not depend on the clock.
        shown.set_time(Duration::ZERO);
        if !self.warnings.is_empty() {
            shown.set_system_out(lines(&self.warnings, view));
        }
        shown
    }

    fn status(&self, view: &View) -> TestCaseStatus {
        let [first, others @ ..] = &*self.errors else { return TestCaseStatus::success() };
        let mut status = TestCaseStatus::non_success(NonSuccessKind::Failure);
        let more = if others.is_empty() { String::new() } else { format!(" (+{})", others.len()) };
        status.set_type(first.code().to_string());
        status.set_message(escaping::lines(&format!("{}{more}", first.text(view.lang))));
        status.set_description(lines(&self.errors, view));
        status
    }
}

fn lines(diagnostics: &[&Diagnostic], view: &View) -> String {
    let lines: String = diagnostics.iter().map(|diagnostic| body(diagnostic, view)).collect();
    escaping::lines(lines.trim_end()).into()
}

/// Returns the text of a failure: a line as in the concise format, followed by the help.
fn body(diagnostic: &Diagnostic, view: &View) -> String {
    let mut body = concise::line(diagnostic, view);
    for line in view.help(diagnostic).iter().flat_map(|help| help.lines()) {
        _ = writeln!(body, "  {line}");
    }
    body
}
