use std::borrow::Cow;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::{Diagnostic, Lang, shown};
use pathbuild_workspace::config::clean;

/// Properties of the output device: language, colours, width, and how file names are shown.
#[derive(Clone, Debug)]
pub struct View {
    /// Language of messages.
    pub lang: Lang,
    /// Whether colour escape sequences are supported.
    pub color: bool,
    /// Column to wrap at; `None` disables wrapping.
    pub width: Option<usize>,
    /// Directory that displayed file names are relative to.
    pub base: Utf8PathBuf,
    /// Directory that file names in machine-readable formats are relative to, possibly above `base`; `None` uses `base`.
    pub root: Option<Utf8PathBuf>,
}

impl View {
    /// A file name for users: relative to the base if inside it, with `/` as separator, and with control characters escaped.
    pub fn name<'a>(&self, file: &'a Utf8Path) -> Cow<'a, str> {
        match self.raw_name(file) {
            Cow::Borrowed(name) => shown::line(name),
            Cow::Owned(name) => shown::line(&name).into_owned().into(),
        }
    }

    /// A file name for formats that escape characters themselves.
    pub fn raw_name<'a>(&self, file: &'a Utf8Path) -> Cow<'a, str> {
        match &self.root {
            None => Cow::Borrowed(file.strip_prefix(&self.base).unwrap_or(file).as_str()),
            Some(root) => {
                let whole = clean(&self.base.join(file));
                Cow::Owned(whole.strip_prefix(root).unwrap_or(&whole).as_str().to_owned())
            }
        }
    }

    /// Name of a diagnostic's file for users.
    pub fn file<'a>(&self, diagnostic: &'a Diagnostic) -> Option<Cow<'a, str>> {
        diagnostic.file.as_deref().map(|file| self.name(file))
    }

    /// Name of a diagnostic's file for formats that escape characters themselves.
    pub fn raw_file<'a>(&self, diagnostic: &'a Diagnostic) -> Option<Cow<'a, str>> {
        diagnostic.file.as_deref().map(|file| self.raw_name(file))
    }

    /// Help and notes of a diagnostic, one per line.
    pub fn help(&self, diagnostic: &Diagnostic) -> Option<String> {
        let notes = diagnostic.notes.iter().map(|note| note.text(self.lang));
        let lines: Vec<String> = diagnostic.help(self.lang).into_iter().chain(notes).collect();
        (!lines.is_empty()).then(|| lines.join("\n"))
    }

    /// Picks the phrase in the view's language.
    pub fn choose<'a>(&self, en: &'a str, de: &'a str) -> &'a str {
        self.lang.choose(en, de)
    }
}
