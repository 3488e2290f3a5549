//! What every command is handed.

use camino::Utf8PathBuf;
use pathbuild_diagnostic::{Diagnostic, Lang};

use crate::args::Format;
use crate::config::Settings;
use crate::exit::ExitStatus;
use crate::printer::{Printer, Stream};
use crate::render::{View, render};
use crate::report::{Findings, judge};

/// The surroundings of a run.
#[derive(Debug)]
pub struct Context {
    /// Where everything is printed.
    pub printer: Printer,
    /// How diagnostics are shown.
    pub format: Format,
    /// What the configuration and the command line say.
    pub settings: Settings,
    /// The directory that relative names mean.
    pub working_directory: Utf8PathBuf,
    /// With how many threads to work; `None`: as many as there are cores.
    pub jobs: Option<u16>,
    /// Whether results of earlier runs may be used and this one's kept.
    pub use_cache: bool,
}

impl Context {
    /// Whether the configuration says what to do without arguments.
    pub fn has_library(&self) -> bool {
        !self.settings.general.library.value.is_empty()
    }

    /// Whether results are kept for later runs: there must be a configuration, beside which they lie.
    pub fn keeps_results(&self) -> bool {
        self.use_cache && self.settings.directory().is_some()
    }

    /// The language of everything that is said.
    pub fn lang(&self) -> Lang {
        self.settings.general.lang.value
    }

    /// One of two phrases.
    pub fn choose<'a>(&self, en: &'a str, de: &'a str) -> &'a str {
        match self.lang() {
            Lang::En => en,
            Lang::De => de,
        }
    }

    /// Findings with the severities of the configuration, in order, each once.
    pub fn findings(&self, diagnostics: Vec<Diagnostic>) -> Findings {
        Findings::new(judge(diagnostics, &self.settings, &self.working_directory))
    }

    /// Shows findings on stderr, as every command but `check` does.
    pub fn show(&self, findings: &Findings) {
        self.show_on(Stream::Stderr, findings);
    }

    /// Shows findings as the result of the run: what machines read goes to stdout.
    pub fn show_as_result(&self, findings: &Findings) {
        let stream = if self.format.is_for_machines() { Stream::Stdout } else { Stream::Stderr };
        self.show_on(stream, findings);
    }

    /// Shows why nothing can be done at all. `diagnostics` are those of the configuration or of options.
    pub fn refuse(&self, diagnostics: Vec<Diagnostic>) -> ExitStatus {
        self.show(&Findings::new(diagnostics));
        ExitStatus::Usage
    }

    /// Shows what went wrong and ends with that.
    pub fn fail(&self, diagnostics: Vec<Diagnostic>) -> ExitStatus {
        self.show(&Findings::new(diagnostics));
        ExitStatus::Errors
    }

    /// Refuses to run without anything to work on.
    pub fn nothing_named(&self, command: &str) -> ExitStatus {
        self.usage(&format!(
            "nothing to {command}: name drawings, paths or directories, or set `library` in pathbuild.toml"
        ))
    }

    /// Says what is wrong with the command line.
    pub fn usage(&self, reason: &str) -> ExitStatus {
        self.printer.usage(format_args!("error: {reason}\n\nFor more information, try '--help'.\n"));
        ExitStatus::Usage
    }

    /// The view of somebody who looks at that stream.
    pub fn view(&self, stream: Stream) -> View {
        View {
            lang: self.lang(),
            color: self.printer.is_colored(stream),
            width: self.printer.width(stream),
            base: self.working_directory.clone(),
        }
    }

    fn show_on(&self, stream: Stream, findings: &Findings) {
        self.printer.diagnostics(stream, render(self.format, findings, &self.view(stream)));
    }
}
