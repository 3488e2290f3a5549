use std::borrow::Cow;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::{Diagnostic, Lang, shown};
use pathbuild_workspace::config::clean;

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
    /// The directory that a program reads them relative to, which may lie above; `None`: as for people.
    pub root: Option<Utf8PathBuf>,
}

impl View {
    /// A file's name as people see it: relative to the base where it lies below, always with `/`, all that acts in it escaped.
    pub fn name<'a>(&self, file: &'a Utf8Path) -> Cow<'a, str> {
        match self.raw_name(file) {
            Cow::Borrowed(name) => shown::line(name),
            Cow::Owned(name) => shown::line(&name).into_owned().into(),
        }
    }

    /// The same as it is, for formats that have an escape of their own for every character.
    pub fn raw_name<'a>(&self, file: &'a Utf8Path) -> Cow<'a, str> {
        match &self.root {
            None => Cow::Borrowed(file.strip_prefix(&self.base).unwrap_or(file).as_str()),
            Some(root) => {
                let whole = clean(&self.base.join(file));
                Cow::Owned(whole.strip_prefix(root).unwrap_or(&whole).as_str().to_owned())
            }
        }
    }

    /// The name of a diagnostic's file, as it is shown.
    pub fn file<'a>(&self, diagnostic: &'a Diagnostic) -> Option<Cow<'a, str>> {
        diagnostic.file.as_deref().map(|file| self.name(file))
    }

    /// The same as it is.
    pub fn raw_file<'a>(&self, diagnostic: &'a Diagnostic) -> Option<Cow<'a, str>> {
        diagnostic.file.as_deref().map(|file| self.raw_name(file))
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
