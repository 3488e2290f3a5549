//! What every command is handed.

use camino::Utf8PathBuf;
use pathbuild_diagnostic::{Diagnostic, Lang};

use crate::args::Format;
use crate::exit::ExitStatus;
use crate::printer::{Printer, Stream};
use crate::render::{View, render};
use crate::report::Findings;

/// The surroundings of a run.
#[derive(Debug)]
pub struct Context {
    /// Where everything is printed.
    pub printer: Printer,
    /// How diagnostics are shown.
    pub format: Format,
    /// The language of messages.
    pub lang: Lang,
    /// The directory that relative names mean.
    pub working_directory: Utf8PathBuf,
}

impl Context {
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

    /// The view of somebody who looks at that stream.
    pub fn view(&self, stream: Stream) -> View {
        View {
            lang: self.lang,
            color: self.printer.is_colored(stream),
            width: self.printer.width(stream),
            base: self.working_directory.clone(),
        }
    }

    fn show_on(&self, stream: Stream, findings: &Findings) {
        self.printer.diagnostics(stream, render(self.format, findings, &self.view(stream)));
    }
}
