//! Scenes from programs, drawings and G-code.

mod drawn;
mod program;

use pathbuild_diagnostic::{Diagnostic, Lang, shown};

use crate::scene::{BilingualText, Finding, Label, Point, Scene, ScenePath};

pub use drawn::{DrawnSource, PartSource, drawn_path, finished_part, keep_out, other_layers, outline};
pub use program::{EmittedText, GcodeSource, ProgramSource, gcode_path, program_path};

// Findings with their places.

impl Scene {
    /// Sets the findings. `file` is the drawing shown. A finding about a parameter text is placed on that text.
    pub fn set_findings(&mut self, diagnostics: &[Diagnostic], file: &str) {
        self.findings = findings(diagnostics, file);
        for (finding, diagnostic) in self.findings.iter_mut().zip(diagnostics) {
            let text = text_at(&self.paths, diagnostic, file);
            finding.at = text.or(finding.at);
        }
    }
}

/// The centre of the parameter text that a diagnostic quotes, in the drawing shown.
fn text_at(paths: &[ScenePath], diagnostic: &Diagnostic, file: &str) -> Option<Point> {
    let (fault, line) = (diagnostic.text.as_ref()?, diagnostic.place.line?);
    diagnostic.file.as_ref().filter(|found| *found == file)?;
    paths.iter().find_map(|path| {
        let is_faulty = |index: u32| {
            let element = &path.elements[index as usize];
            element.line == Some(line) && path.embedded[element.path as usize].file == file
        };
        let is_quoted = |label: &&Label| {
            label.text.contains(fault.text.trim()) && label.elements.iter().any(|index| is_faulty(*index))
        };
        let [x, y] = path.texts.iter().find(is_quoted)?.at;
        Some([x + path.zero[0], y + path.zero[1]])
    })
}

/// Numbers findings. `file` is the drawing shown: a finding in another drawing is placed where that is embedded.
pub fn findings(diagnostics: &[Diagnostic], file: &str) -> Vec<Finding> {
    (1..).zip(diagnostics).map(|(number, diagnostic)| finding(number, diagnostic, file)).collect()
}

fn finding(number: usize, diagnostic: &Diagnostic, file: &str) -> Finding {
    let is_here = diagnostic.file.as_ref().is_some_and(|found| found == file);
    let outermost = diagnostic.trace.first().filter(|step| step.file == file).map(|step| step.point);
    let own = diagnostic.place.point.filter(|_| is_here);
    let help = |lang| diagnostic.help(lang).unwrap_or_default();
    Finding {
        number,
        code: diagnostic.code().to_string(),
        is_error: diagnostic.is_error(),
        message: BilingualText { en: diagnostic.text(Lang::En), de: diagnostic.text(Lang::De) },
        help: BilingualText { en: help(Lang::En), de: help(Lang::De) },
        notes: diagnostic
            .notes
            .iter()
            .map(|note| BilingualText { en: note.text(Lang::En), de: note.text(Lang::De) })
            .collect(),
        file: diagnostic.file.as_ref().map(|file| shown::line(file.as_str()).into_owned()),
        path: diagnostic.path.as_deref().map(str::to_owned),
        line: diagnostic.place.line,
        at: own.or(outermost).map(|point| [point.x.0, point.y.0]),
    }
}
