//! The context that is passed to every command.

use std::mem::ManuallyDrop;
use std::ops::Deref;
use std::sync::Arc;
use std::sync::atomic::Ordering;

use camino::Utf8Path;
use pathbuild_api::{Error, Finding, Library};
use pathbuild_db::system::OsSystem;
use pathbuild_diagnostic::messages::configuration as messages;
use pathbuild_diagnostic::{Diagnostic, Lang, escaping};
use pathbuild_workspace::config::{self, Overrides};
use pathbuild_workspace::findings::Findings;
use pathbuild_workspace::protected_files::replace_report;
use pathbuild_workspace::waivers::WaivedFinding;
use pathbuild_workspace::{Failure, Inputs, Workspace};
use serde_json::Value;

use crate::args::Cli;
use crate::{environment, german};

use crate::exit::ExitStatus;
use crate::output::Output;
use crate::printer::{Printer, Stream};
use crate::render::{Format, View, json as lines, render};

/// Everything that a command needs in addition to its arguments.
#[derive(Debug)]
pub struct Context {
    /// Printer for stdout and stderr, which nothing else may access.
    pub printer: Arc<Printer>,
    /// Format in which diagnostics are printed.
    pub format: Format,
    /// The machine-readable document and reports of the run.
    pub(crate) output: Output,
    /// Values from the command line that override the configuration.
    pub overrides: Overrides,
    /// Settings, files and directories of the run.
    pub workspace: Arc<Workspace>,
}

impl Deref for Context {
    type Target = Workspace;

    fn deref(&self) -> &Workspace {
        &self.workspace
    }
}

impl Context {
    /// Creates the context for a command line in this workspace.
    pub fn new(cli: &Cli, overrides: Overrides, printer: Arc<Printer>, workspace: Workspace) -> Self {
        let output = Output::new(&cli.command, &cli.common);
        Self { printer, format: output.format, output, overrides, workspace: Arc::new(workspace) }
    }

    /// Creates the context for a command line in the working directory. Also returns diagnostics of the configuration.
    pub fn of(cli: &Cli) -> (Self, Vec<Diagnostic>) {
        let Cli { command, common } = cli;
        let (user, mut faults) = environment::load_user_settings();
        let date = environment::date(command.date());
        let overrides = Overrides { trusted: user.trusted.clone(), date, ..common.overrides() };
        let (workspace, more) = environment::workspace(&overrides, &user, &command.inputs());
        faults.extend(more);
        let printer = Printer::new(common.verbosity(), common.color.unwrap_or_default());
        let printer = Arc::new(printer.with_stdout_taken(Output::new(command, common).takes_stdout()));
        let cache_home = || {
            environment::cache_home(common.cache_dir.as_deref(), user.cache_dir, &workspace.working_directory)
        };
        let workspace = Workspace {
            cache: if common.no_cache { None } else { cache_home() },
            own_lang: common.lang.map(Lang::from).or(workspace.own_lang),
            jobs: common.jobs,
            reporter: printer.clone(),
            ..workspace
        };
        (Self::new(cli, overrides, printer, workspace), faults)
    }

    /// Returns the reason why the options or the environment are invalid; `None` if they are valid.
    pub(crate) fn refusal(&self) -> Option<String> {
        self.output.refusal(self).or_else(|| environment::refusal(self))
    }

    /// Warns if the working directory's configuration does not apply to this run, or if a configuration has a wrong name.
    pub(crate) fn warn_about_unused_configuration(&self) {
        if let Some(file) = self.unused_configuration() {
            self.printer.status(self.phrase(
                "note: {} does not apply to files outside its tree (give --config {} to apply it); no other configuration was found",
                "Hinweis: {} gilt nicht für Dateien außerhalb ihres Verzeichnisbaums (mit --config {} gilt sie doch); eine andere Konfiguration wurde nicht gefunden",
                file.as_str(),
            ));
        }
        if let Some(file) = self.misnamed_configuration() {
            self.printer.status(self.phrase(
                "note: no configuration applies: {} must be named pathbuild.toml (Windows may hide the end of its name)",
                "Hinweis: keine Konfiguration gilt: {} muss pathbuild.toml heißen (Windows blendet das Ende des Namens vielleicht aus)",
                &escaping::line(file.as_str()),
            ));
        }
    }

    /// Returns a workspace for the tree of these inputs, with that tree's configuration and without a cache. Also returns diagnostics of that
    /// configuration.
    pub fn workspace_of_inputs(&self, inputs: &Inputs) -> (Workspace, Vec<Diagnostic>) {
        let (settings, faults) =
            config::load(&OsSystem::shared(), &self.overrides, inputs, &self.working_directory);
        let workspace = Workspace {
            system: settings.confine(OsSystem::shared()),
            settings,
            cache: None,
            ..Workspace::clone(self)
        };
        (workspace, faults)
    }

    /// Shows findings: on stderr as text, or as part of the document if the format is machine-readable.
    pub fn show(&self, findings: &Findings) {
        if let Some((stream, text)) = self.output.collect_findings(findings, |stream| self.view(stream)) {
            if self.format.is_for_machines() {
                self.printer.document(stream, &text);
            } else {
                self.printer.diagnostics(stream, &text);
            }
        }
    }

    /// Shows diagnostics with their configured severities, and returns the corresponding exit status.
    pub(crate) fn conclude(&self, diagnostics: Vec<Diagnostic>) -> ExitStatus {
        self.conclude_findings(&self.findings(diagnostics))
    }

    /// Shows findings, and returns the corresponding exit status.
    pub(crate) fn conclude_findings(&self, findings: &Findings) -> ExitStatus {
        self.show(findings);
        ExitStatus::of(findings)
    }

    /// Shows only `some` of the findings to users. Reports contain all of them.
    pub(crate) fn show_only(&self, findings: &Findings, some: &Findings) {
        _ = self.output.collect_findings(findings, |stream| self.view(stream));
        let view = self.view(Stream::Stderr);
        self.printer.diagnostics(Stream::Stderr, &render(self.format, some, &view));
    }

    /// Prints the beginning of the machine-readable document.
    pub(crate) fn begin(&self) {
        if let Some(header) = self.output.header() {
            self.printer.json(self.output.stream, header);
        }
    }

    /// Prints a result as a line of JSON in the document.
    #[expect(clippy::needless_pass_by_value, reason = "callers create the row just for this call")]
    pub(crate) fn row(&self, kind: &str, row: Value) {
        self.printer.json(self.output.stream, lines::serialize_with_type(kind, &row));
    }

    /// Like [`row`](Self::row), but prints the row only if the format is JSON, and also keeps it for JSON reports.
    pub(crate) fn json_row(&self, row: impl FnOnce() -> (&'static str, Value)) {
        if self.output.writes_json() {
            let (kind, row) = row();
            self.output.keep_row(&lines::serialize_with_type(kind, &row));
            if self.format == Format::Json {
                self.row(kind, row);
            }
        }
    }

    /// Shows fixed findings as lines of JSON, if JSON is the format.
    pub(crate) fn show_fixed(&self, fixed: &[Diagnostic]) {
        if self.format == Format::Json {
            let lines = lines::fixed(fixed, &self.machine_view());
            self.printer.diagnostics(self.output.stream, &lines);
        }
    }

    /// Returns the name of a file in the machine-readable document, relative to the repository's root.
    pub(crate) fn file(&self, file: &Utf8Path) -> String {
        self.machine_view().raw_name(file).into_owned()
    }

    /// Tells the user the date of the run if a waiver with an end date has accepted a finding since the last call.
    pub(crate) fn report_date(&self) {
        if self.is_date_decisive.swap(false, Ordering::Relaxed)
            && let Some(date) = self.settings.date
        {
            self.printer.status(self.phrase(
                "waivers with an end were compared with {}",
                "befristete Ausnahmen wurden mit {} verglichen",
                &date.text(self.lang()),
            ));
        }
    }

    /// Prints the end of the machine-readable document, and writes the reports. A report that cannot be written is an error. Reports the date of the
    /// run if the command has not done so.
    pub(crate) fn end(&self, status: ExitStatus) -> ExitStatus {
        self.report_date();
        let (status, view) = (self.write_reports(status), self.machine_view());
        if let Some(text) = self.output.end(status.code(), &view) {
            self.printer.document(self.output.stream, &text);
        }
        status
    }

    fn write_reports(&self, status: ExitStatus) -> ExitStatus {
        let mut failed = Vec::new();
        for report in &self.output.reports {
            let view = if report.format.is_for_machines() { self.machine_view() } else { self.plain_view() };
            let text = match report.format {
                Format::Html => self.output.page(self, &view),
                format => self.output.whole_report(format, status.code(), &view),
            };
            if report.is_stdout() {
                self.printer.document(Stream::Stdout, &text);
            } else {
                let file = self.working_directory.join(&report.file);
                failed.extend(replace_report(self, &file, text.as_str()).err().map(|fault| *fault));
            }
        }
        if failed.is_empty() { status } else { status.max(self.fail(failed)) }
    }

    /// Returns the view for machine-readable formats, in which file names are relative to the repository's root.
    fn machine_view(&self) -> View {
        let directory = self.settings.directory().unwrap_or(&self.working_directory);
        // A configuration outside of any repository may apply to drawings in the repository of the working directory.
        let of_configuration = config::repository(&OsSystem, directory);
        let root = of_configuration.or_else(|| config::repository(&OsSystem, &self.working_directory));
        View { root: Some(root.unwrap_or(directory).to_owned()), ..self.plain_view() }
    }

    /// Returns the view for text files, without colours and wrapping.
    fn plain_view(&self) -> View {
        View {
            lang: self.lang(),
            color: false,
            width: None,
            base: self.working_directory.clone(),
            root: None,
        }
    }

    /// Shows errors of the configuration or of options, which prevent the run.
    pub fn refuse(&self, diagnostics: Vec<Diagnostic>) -> ExitStatus {
        self.show(&Findings::new(diagnostics));
        ExitStatus::Usage
    }

    /// Shows errors, and returns the exit status of a run with errors.
    pub fn fail(&self, diagnostics: Vec<Diagnostic>) -> ExitStatus {
        self.show(&Findings::new(diagnostics));
        ExitStatus::Errors
    }

    /// Shows why a request failed, and returns the exit status.
    pub fn show_failure(&self, failure: Failure) -> ExitStatus {
        match failure {
            Failure::Usage(reason) => self.usage_error(&reason),
            Failure::Refused(faults) => self.refuse(faults),
            Failure::Post(problems) | Failure::Found(problems) => self.fail(problems),
        }
    }

    /// Opens the library of the run. It is never dropped, because freeing all query results takes longer than process exit.
    ///
    /// # Errors
    /// If the system cannot start a thread.
    pub(crate) fn library(&self) -> Result<ManuallyDrop<Library>, Error> {
        Library::of_workspace(Arc::clone(&self.workspace)).map(ManuallyDrop::new)
    }

    /// Shows why a request to the library failed, and returns the exit status.
    pub(crate) fn show_request_error(&self, error: Error) -> ExitStatus {
        match error {
            Error::Refused(reason) => self.usage_error(&reason),
            Error::Baseline(found) => self.refuse(for_rendering(found, Vec::new()).diagnostics),
            Error::Findings(found) | Error::Post(found) => {
                self.fail(for_rendering(found, Vec::new()).diagnostics)
            }
            error => self.usage_error(&error.to_string()),
        }
    }

    /// Reports a usage error: the command line names nothing to work on.
    pub fn refuse_empty_input(&self) -> ExitStatus {
        let advice = match self.settings.file {
            Some(_) => {
                self.choose("or set `library` in pathbuild.toml", "oder `library` in pathbuild.toml setzen")
            }
            None => self.choose(
                "or write a pathbuild.toml: `pathbuild init`, or `pathbuild init --example` with a small library to learn on",
                "oder eine pathbuild.toml schreiben: `pathbuild init`, oder `pathbuild init --example` mit einer kleinen Bibliothek zum Lernen",
            ),
        };
        let reason = self.phrase(
            "nothing to work on: name drawings, paths or directories after `{}`, ",
            "nichts zu tun: hinter `{}` Zeichnungen, Pfade oder Verzeichnisse nennen ",
            self.output.command,
        );
        self.usage_error(&(reason + advice))
    }

    /// Reports a usage error: on stderr, and as a finding in machine-readable output and reports, which would otherwise look like those of a run
    /// without findings.
    pub fn usage_error(&self, reason: &str) -> ExitStatus {
        let refused = Diagnostic::new(&messages::REFUSED).quoting("reason", reason);
        let findings = Findings::new(vec![refused]);
        if self.format.is_for_machines() {
            self.show(&findings);
        } else {
            self.show_only(&findings, &Findings::default());
        }
        german::print_usage_error(reason, self.lang(), &self.printer)
    }

    /// Returns the view for a stream in the chosen format.
    pub fn view(&self, stream: Stream) -> View {
        if self.format.is_for_machines() {
            return self.machine_view();
        }
        View {
            color: self.printer.is_colored(stream),
            width: self.printer.width(stream),
            ..self.plain_view()
        }
    }
}

/// Converts the reported and the accepted findings of a request to the library, for rendering.
pub(crate) fn for_rendering(findings: Vec<Finding>, accepted: Vec<Finding>) -> Findings {
    let diagnostics = findings.into_iter().map(|finding| finding.into_parts().0);
    let waived = accepted.into_iter().map(|finding| {
        let (diagnostic, waiver) = finding.into_parts();
        WaivedFinding { diagnostic, waiver: waiver.unwrap_or_default() }
    });
    Findings { diagnostics: diagnostics.collect(), waived: waived.collect(), ..Findings::default() }
}
