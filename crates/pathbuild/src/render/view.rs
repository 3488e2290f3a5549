use std::borrow::Cow;
use std::fmt::Write;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::or_current_directory;
use pathbuild_diagnostic::{Diagnostic, Lang, TraceStep, Value, escaping};
use pathbuild_workspace::config::clean;

/// Properties of an output device: language, colours, width, and form of file names.
#[derive(Clone, Debug)]
pub struct View {
    /// Language of messages.
    pub lang: Lang,
    /// Whether colour escape sequences are supported.
    pub color: bool,
    /// Column at which text is wrapped; `None` disables wrapping.
    pub width: Option<usize>,
    /// Directory that file names shown to users are relative to.
    pub base: Utf8PathBuf,
    /// Directory that file names in machine-readable formats are relative to, possibly above `base`; `None` means `base`.
    pub root: Option<Utf8PathBuf>,
}

impl View {
    /// Returns a file name for users: relative to the base if it is inside, with `/` as separator, and with control characters escaped.
    pub fn name<'a>(&self, file: &'a Utf8Path) -> Cow<'a, str> {
        match self.raw_name(file) {
            Cow::Borrowed(name) => escaping::line(name),
            Cow::Owned(name) => escaping::line(&name).into_owned().into(),
        }
    }

    /// Returns a file name for formats that escape characters themselves.
    pub fn raw_name<'a>(&self, file: &'a Utf8Path) -> Cow<'a, str> {
        match &self.root {
            None => {
                let below = file.strip_prefix(&self.base).unwrap_or(file);
                Cow::Borrowed(or_current_directory(below).as_str())
            }
            Some(root) => {
                let whole = clean(&self.base.join(file));
                let below = whole.strip_prefix(root).unwrap_or(&whole);
                Cow::Owned(or_current_directory(below).as_str().to_owned())
            }
        }
    }

    /// Returns the name of a diagnostic's file for users.
    pub fn file<'a>(&self, diagnostic: &'a Diagnostic) -> Option<Cow<'a, str>> {
        diagnostic.file.as_deref().map(|file| self.name(file))
    }

    /// Returns the name of a diagnostic's file for formats that escape characters themselves.
    pub fn raw_file<'a>(&self, diagnostic: &'a Diagnostic) -> Option<Cow<'a, str>> {
        diagnostic.file.as_deref().map(|file| self.raw_name(file))
    }

    /// Returns the help and the notes of a diagnostic, one per line.
    pub fn help(&self, diagnostic: &Diagnostic) -> Option<String> {
        let notes = diagnostic.notes.iter().map(|note| note.text(self.lang));
        let lines: Vec<String> = diagnostic.help(self.lang).into_iter().chain(notes).collect();
        (!lines.is_empty()).then(|| lines.join("\n"))
    }

    /// Returns the phrase in the view's language.
    pub fn choose<'a>(&self, en: &'a str, de: &'a str) -> &'a str {
        self.lang.choose(en, de)
    }
}

/// Formats the location of a diagnostic as far as it is known, so that editors can open it: `parts/2913.dxf:1234:5`.
pub(super) fn location(diagnostic: &Diagnostic, view: &View) -> Option<String> {
    let mut location = view.file(diagnostic)?.into_owned();
    for number in [diagnostic.place.line, diagnostic.place.column].into_iter().flatten() {
        _ = write!(location, ":{number}");
    }
    Some(location)
}

/// Formats the element that a diagnostic is about, as far as it is known: `path 2913.1P, LINE 4A1 on layer 2913.1P~A at (12.5, 30)`. May
/// be empty.
pub(super) fn element(diagnostic: &Diagnostic, view: &View) -> String {
    let place = &diagnostic.place;
    let mut parts = Vec::new();
    if let Some(path) = &diagnostic.path {
        parts.push(format!("{} {}", view.choose("path", "Pfad"), escaping::line(path)));
    }
    let mut words = Vec::new();
    words.extend(place.entity.map(|kind| kind.name().to_owned()));
    words.extend(place.handle.map(|handle| handle.to_string()));
    words.extend(
        place
            .layer
            .as_deref()
            .map(|layer| format!("{} {}", view.choose("on layer", "auf Layer"), escaping::line(layer))),
    );
    words.extend(
        place
            .point
            .map(|point| format!("{} {}", view.choose("at", "bei"), Value::from(point).render(view.lang))),
    );
    if !words.is_empty() {
        parts.push(words.join(" "));
    }
    parts.join(", ")
}

/// Returns the message with the help and the element, for viewers that would show neither otherwise.
pub(super) fn message(diagnostic: &Diagnostic, view: &View) -> String {
    let element = Some(element(diagnostic, view)).filter(|element| !element.is_empty());
    let parts = [Some(diagnostic.text(view.lang)), view.help(diagnostic), element];
    parts.into_iter().flatten().collect::<Vec<_>>().join("\n")
}

/// Formats an embedding: `embedded by 8001.1P at (10, 20), projects/8001.dxf`.
pub(super) fn embedding(step: &TraceStep, view: &View) -> String {
    let (by, at) = (view.choose("embedded by", "eingebettet von"), view.choose("at", "bei"));
    format!(
        "{by} {} {at} {}, {}",
        escaping::line(&step.path),
        Value::from(step.point).render(view.lang),
        view.name(&step.file)
    )
}
