use std::collections::HashMap;
use std::sync::LazyLock;

use camino::{Utf8Path, Utf8PathBuf};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize};

use crate::message::{Arguments, deserialize_arguments, fill};
use crate::{
    Code, ElementId, EntityKind, Handle, Lang, Message, Place, Point, Severity, TextFault, Value, messages,
};

/// A finding: a message, the values in the message, and the place that it is about.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Diagnostic {
    /// Message, which determines the code, the texts and the help.
    #[serde(deserialize_with = "deserialize_message")]
    pub message: &'static Message,
    /// The default severity of the code, unless the stage that found the problem has changed it. The configuration may change it once more when
    /// the diagnostic is reported.
    pub severity: Severity,
    /// The values in the message and its help, by name.
    #[serde(deserialize_with = "deserialize_arguments")]
    pub arguments: Arguments,
    /// Further details, for example the nearest open end.
    pub notes: Vec<Note>,
    /// File that the diagnostic is about. Stages that know no files leave it empty, and their callers fill it in.
    pub file: Option<Utf8PathBuf>,
    /// Name of the milling path that the diagnostic is about, as written in the drawing.
    pub path: Option<Box<str>>,
    /// Position in `file`, as far as it is known.
    pub place: Place,
    /// Text that contains the fault, with the faulty range.
    pub text: Option<TextFault>,
    /// The embeddings through which the path is reached, outermost first.
    pub trace: Vec<TraceStep>,
}

/// An additional sentence about a diagnostic.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Note {
    /// Message, which determines the text of the note.
    #[serde(deserialize_with = "deserialize_message")]
    pub message: &'static Message,
    /// The values in the message, by name.
    #[serde(deserialize_with = "deserialize_arguments")]
    pub arguments: Arguments,
}

/// An embedding through which an erroneous path is reached.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct TraceStep {
    /// Drawing that contains the embedding path.
    pub file: Utf8PathBuf,
    /// Name of the embedding path.
    pub path: Box<str>,
    /// Start of the subpath segment that embeds the next path.
    pub point: Point,
}

impl Diagnostic {
    /// Creates a diagnostic without a place.
    pub fn new(message: &'static Message) -> Self {
        Self {
            message,
            severity: message.severity,
            arguments: Vec::new(),
            notes: Vec::new(),
            file: None,
            path: None,
            place: Place::default(),
            text: None,
            trace: Vec::new(),
        }
    }

    /// Returns the code of the diagnostic.
    pub fn code(&self) -> Code {
        self.message.code
    }

    /// Whether the diagnostic is an error, so that the path gets no program.
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }

    /// Returns this diagnostic with the severity of an error.
    pub fn as_error(self) -> Self {
        Self { severity: Severity::Error, ..self }
    }

    /// Returns this diagnostic with the severity of a warning.
    pub fn as_warning(self) -> Self {
        Self { severity: Severity::Warning, ..self }
    }

    /// Returns the message as a sentence, with its values.
    pub fn text(&self, lang: Lang) -> String {
        fill(self.message.text.in_lang(lang), &self.arguments, lang)
    }

    /// Returns advice on how to solve the problem; `None` if the message makes it obvious.
    pub fn help(&self, lang: Lang) -> Option<String> {
        let template = self.message.help.in_lang(lang);
        (!template.is_empty()).then(|| fill(template, &self.arguments, lang))
    }

    /// Sets a value of the message: a number, a point, or prose in every language.
    pub fn with(mut self, name: &'static str, value: impl Into<Value>) -> Self {
        self.arguments.push((name, value.into()));
        self
    }

    /// Sets a value of the message to a name or a piece of source text, which is the same in every language.
    pub fn quoting(self, name: &'static str, text: impl AsRef<str>) -> Self {
        self.with(name, Value::quoted(text))
    }

    /// Adds a note with the values of its arguments.
    pub fn note(mut self, message: &'static Message, arguments: Vec<(&'static str, Value)>) -> Self {
        self.notes.push(Note { message, arguments });
        self
    }

    /// Sets the file that the diagnostic is about.
    pub fn in_file(mut self, file: &Utf8Path) -> Self {
        self.file = Some(file.to_owned());
        self
    }

    /// Sets the name of the milling path that the diagnostic is about.
    pub fn in_path(mut self, path: &str) -> Self {
        self.path = Some(path.into());
        self
    }

    /// Sets the name of the milling path, unless the diagnostic already has one.
    pub fn or_in_path(self, path: &str) -> Self {
        if self.path.is_none() { self.in_path(path) } else { self }
    }

    /// Sets the line and the column, both counted from 1, as far as they are known.
    pub fn at_line(mut self, line: impl Into<Option<u32>>, column: Option<u32>) -> Self {
        if let Some(line) = line.into() {
            self.place.line = Some(line);
            self.place.column = column;
        }
        self
    }

    /// Sets the element by its number, with its type, layer and point. The line and the handle are only known from the source map: see
    /// [`locate`](Self::locate).
    pub fn at_element(mut self, element: ElementId, entity: EntityKind, layer: &str, point: Point) -> Self {
        self.place.element = Some(element);
        self.place.entity = Some(entity);
        self.place.layer = Some(layer.into());
        self.place.point = Some(point);
        self
    }

    /// Sets the point in the drawing at which the problem is.
    pub fn at_point(mut self, point: Point) -> Self {
        self.place.point = Some(point);
        self
    }

    /// Sets the text that contains the fault. If `text` is `None`, the previous one remains.
    pub fn with_text(mut self, text: impl Into<Option<TextFault>>) -> Self {
        self.text = text.into().or(self.text);
        self
    }

    /// Replaces the message by another one, with the argument `nearest`, if there is a similar name to suggest.
    pub fn suggest_nearest(mut self, message: &'static Message, nearest: Option<impl AsRef<str>>) -> Self {
        let Some(nearest) = nearest else { return self };
        self.message = message;
        self.quoting("nearest", nearest)
    }

    /// Returns the value of an argument of the message; `None` if it has not been set.
    pub fn argument(&self, name: &str) -> Option<&Value> {
        argument(&self.arguments, name)
    }

    /// Returns the text of an argument; `None` if its value is not [`Value::Quoted`].
    pub fn quoted(&self, name: &str) -> Option<&str> {
        match self.argument(name)? {
            Value::Quoted(text) => Some(text),
            _ => None,
        }
    }

    /// Sets the line at which the element begins in the file, and its handle. Both come from the source map.
    pub fn locate(&mut self, line: u32, handle: Option<Handle>) {
        self.place.line = Some(line);
        self.place.handle = handle;
    }

    /// Renames files wherever the diagnostic contains their names. `replacement` returns the new name of a file, or `None` to keep it.
    pub fn rename_files(&mut self, replacement: impl Fn(&str) -> Option<String>) {
        let notes = self.notes.iter_mut().flat_map(|note| &mut note.arguments);
        for (_, value) in self.arguments.iter_mut().chain(notes) {
            value.replace_texts(&replacement);
        }
        for file in self.file.iter_mut().chain(self.trace.iter_mut().map(|step| &mut step.file)) {
            if let Some(new) = replacement(file.as_str()) {
                *file = new.into();
            }
        }
    }

    /// Returns the key by which lists of diagnostics are sorted: file, path, place (first of all its line), code, the line among the arguments, and
    /// text.
    pub fn sort_key(&self) -> impl Ord + '_ {
        (
            &self.file,
            &self.path,
            self.place.line,
            &self.place,
            self.message.code,
            self.named_line(),
            &self.text,
        )
    }

    /// Returns the line that an argument of the message gives, unless the diagnostic itself has a line.
    fn named_line(&self) -> Option<u64> {
        match self.argument("line") {
            Some(Value::Count(line)) if self.place.line.is_none() => Some(*line),
            _ => None,
        }
    }
}

fn argument<'a>(arguments: &'a [(&'static str, Value)], name: &str) -> Option<&'a Value> {
    arguments.iter().find(|(known, _)| *known == name).map(|(_, value)| value)
}

impl Note {
    /// Returns the value of an argument of the note; `None` if it has not been set.
    pub fn argument(&self, name: &str) -> Option<&Value> {
        argument(&self.arguments, name)
    }

    /// Returns the note as a sentence, with its values.
    pub fn text(&self, lang: Lang) -> String {
        fill(self.message.text.in_lang(lang), &self.arguments, lang)
    }
}

/// Deserializes a message by its key. Fails if this version has no message with this key.
fn deserialize_message<'de, D: Deserializer<'de>>(deserializer: D) -> Result<&'static Message, D::Error> {
    static BY_KEY: LazyLock<HashMap<&str, &Message>> =
        LazyLock::new(|| messages::all().map(|message| (message.key, message)).collect());
    let key = <&str>::deserialize(deserializer)?;
    BY_KEY.get(key).copied().ok_or_else(|| D::Error::custom("no message of this program"))
}
