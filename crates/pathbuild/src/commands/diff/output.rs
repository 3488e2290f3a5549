//! Writes a comparison to a file, besides printing it.

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::WriteOutcome;
use pathbuild_diagnostic::{Diagnostic, shown};
use pathbuild_workspace::diff::Comparison;
use pathbuild_workspace::files::cannot_write;

use super::{markdown, page};
use crate::context::Context;

/// A file to write with its format, if any.
pub(super) struct Output(Option<(Format, Utf8PathBuf)>);

#[derive(Clone, Copy, PartialEq, Eq)]
enum Format {
    Html,
    Markdown,
}

impl Output {
    /// Chooses the format by the extension.
    ///
    /// # Errors
    /// If the extension is unknown.
    pub(super) fn of(context: &Context, file: Option<&Utf8Path>) -> Result<Self, String> {
        let Some(file) = file else { return Ok(Self(None)) };
        let format = match file.extension().unwrap_or_default().to_ascii_lowercase().as_str() {
            "html" => Format::Html,
            "md" => Format::Markdown,
            _ => {
                return Err(context.phrase(
                    "-o {}: the name must end in .html or .md",
                    "-o {}: der Name muss auf .html oder .md enden",
                    &shown::line(file.as_str()),
                ));
            }
        };
        Ok(Self(Some((format, file.to_owned()))))
    }

    /// Whether the format shows pictures.
    pub(super) fn has_pictures(&self) -> bool {
        matches!(self.0, Some((Format::Html, _)))
    }

    /// Writes the file.
    ///
    /// # Errors
    /// If it cannot be written.
    pub(super) fn deliver(&self, context: &Context, comparison: &Comparison) -> Result<(), Box<Diagnostic>> {
        let Some((format, file)) = &self.0 else { return Ok(()) };
        let text = match format {
            Format::Html => page::page(comparison, context.lang()),
            Format::Markdown => markdown::markdown(comparison, context.lang()),
        };
        let refused = |reason| Box::new(cannot_write(file, reason));
        let state = match context.system.write(file, text.as_bytes()).map_err(refused)? {
            WriteOutcome::Changed => context.choose("written", "geschrieben"),
            WriteOutcome::Unchanged => context.choose("unchanged", "unverändert"),
        };
        context.printer.status(format_args!("{}: {state}", shown::line(file.as_str())));
        Ok(())
    }
}
