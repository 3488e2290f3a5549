//! What every command is handed.

use std::ops::Deref;
use std::rc::Rc;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_workspace::Workspace;

use crate::args::Format;
use crate::exit::ExitStatus;
use crate::printer::{Printer, Stream};
use crate::render::{View, render};
use crate::report::{Findings, judge};
use crate::usage;

/// The surroundings of a run.
#[derive(Debug)]
pub struct Context {
    /// Where everything is printed.
    pub printer: Rc<Printer>,
    /// How diagnostics are shown.
    pub format: Format,
    /// What the run works in.
    pub workspace: Workspace,
}

impl Deref for Context {
    type Target = Workspace;

    fn deref(&self) -> &Workspace {
        &self.workspace
    }
}

impl Context {
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
        let advice = match self.settings.file {
            Some(_) => "or set `library` in pathbuild.toml",
            None => {
                "or write a pathbuild.toml: `pathbuild init`, or `pathbuild init --example` with a small library to learn on"
            }
        };
        self.usage(&format!("nothing to {command}: name drawings, paths or directories, {advice}"))
    }

    /// Says what is wrong with the command line.
    pub fn usage(&self, reason: &str) -> ExitStatus {
        usage::wrong(reason, &self.printer)
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
        self.printer.diagnostics(stream, &render(self.format, findings, &self.view(stream)));
    }
}
