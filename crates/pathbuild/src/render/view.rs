use std::borrow::Cow;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::{Diagnostic, Lang};

/// What depends on who looks: a person at a terminal of some width, or a program.
#[derive(Clone, Debug)]
pub struct View {
    /// The language of messages.
    pub lang: Lang,
    /// Whether escape sequences for colours are understood.
    pub color: bool,
    /// Columns to wrap at; `None`: lines are as long as they are.
    pub width: Option<usize>,
    /// The directory that names of files are shown relative to.
    pub base: Utf8PathBuf,
}

impl View {
    /// A file's name as it is shown: relative to the base where it lies below, always with `/`.
    pub fn name<'a>(&self, file: &'a Utf8Path) -> Cow<'a, str> {
        let name = file.strip_prefix(&self.base).unwrap_or(file).as_str();
        if cfg!(windows) { name.replace('\\', "/").into() } else { name.into() }
    }

    /// The name of a diagnostic's file, as it is shown.
    pub fn file<'a>(&self, diagnostic: &'a Diagnostic) -> Option<Cow<'a, str>> {
        diagnostic.file.as_deref().map(|file| self.name(file))
    }

    /// What to do about it, and what helps to see it, a line each.
    pub fn help(&self, diagnostic: &Diagnostic) -> Option<String> {
        let notes = diagnostic.notes.iter().map(|note| note.text(self.lang));
        let lines: Vec<String> = diagnostic.help(self.lang).into_iter().chain(notes).collect();
        (!lines.is_empty()).then(|| lines.join("\n"))
    }

    /// One of two phrases.
    pub fn choose<'a>(&self, en: &'a str, de: &'a str) -> &'a str {
        match self.lang {
            Lang::En => en,
            Lang::De => de,
        }
    }
}

/// Text from a drawing as it may be shown on a terminal: control characters, which could move the cursor or worse, are replaced.
pub(super) fn harmless(text: &str) -> Cow<'_, str> {
    let is_harmful = |c: char| c.is_control() && !matches!(c, '\n' | '\r' | '\t');
    if text.contains(is_harmful) { text.replace(is_harmful, "\u{fffd}").into() } else { text.into() }
}

/// The same on one line.
pub(super) fn one_line(text: &str) -> Cow<'_, str> {
    if text.contains(char::is_control) { text.replace(char::is_control, " ").into() } else { text.into() }
}
