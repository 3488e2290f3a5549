use std::collections::HashMap;
use std::sync::LazyLock;

use camino::{Utf8Path, Utf8PathBuf};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize};

use crate::message::{Arguments, fill, kept_arguments};
use crate::{
    Code, ElementId, EntityKind, Handle, Lang, Message, Place, Point, Severity, TextFault, Value, messages,
};

/// A finding: its message, the values in it, and its place.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Diagnostic {
    /// The message.
    #[serde(deserialize_with = "kept_message")]
    pub message: &'static Message,
    /// The default severity of the code. The configuration may change it when the diagnostic is reported.
    pub severity: Severity,
    /// The values in the message and its help, by name.
    #[serde(deserialize_with = "kept_arguments")]
    pub arguments: Arguments,
    /// Further details, for example the nearest open end.
    pub notes: Vec<Note>,
    /// The file. Stages that know no files leave it empty for their caller to fill in.
    pub file: Option<Utf8PathBuf>,
    /// The path, as spelt in the drawing.
    pub path: Option<Box<str>>,
    /// The place in the file.
    pub place: Place,
    /// The faulty text.
    pub text: Option<TextFault>,
    /// The embeddings that lead here, outermost first.
    pub trace: Vec<TraceStep>,
}

/// An additional sentence about a diagnostic.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Note {
    /// The message.
    #[serde(deserialize_with = "kept_message")]
    pub message: &'static Message,
    /// The values in it.
    #[serde(deserialize_with = "kept_arguments")]
    pub arguments: Arguments,
}

/// An embedding on the way to an erroneous path.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct TraceStep {
    /// The embedding drawing.
    pub file: Utf8PathBuf,
    /// The embedding path.
    pub path: Box<str>,
    /// The start of the subpath segment.
    pub point: Point,
}

impl Diagnostic {
    /// Creates a diagnostic without a place.
    pub fn new(message: &'static Message) -> Self {
        Self {
            message,
            severity: message.code.severity(),
            arguments: Vec::new(),
            notes: Vec::new(),
            file: None,
            path: None,
            place: Place::default(),
            text: None,
            trace: Vec::new(),
        }
    }

    /// The code under which it is reported.
    pub fn code(&self) -> Code {
        self.message.code
    }

    /// Whether it is an error, which prevents a program.
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }

    /// The message as a sentence.
    pub fn text(&self, lang: Lang) -> String {
        fill(self.message.text.in_lang(lang), &self.arguments, lang)
    }

    /// Advice on how to solve the problem; `None` if the message says it all.
    pub fn help(&self, lang: Lang) -> Option<String> {
        let template = self.message.help.in_lang(lang);
        (!template.is_empty()).then(|| fill(template, &self.arguments, lang))
    }

    /// Sets a value in the message: a number, a place, prose in every language.
    pub fn with(mut self, name: &'static str, value: impl Into<Value>) -> Self {
        self.arguments.push((name, value.into()));
        self
    }

    /// Sets a value of the message to a name or a piece of source text, which is the same in every language.
    pub fn quoting(self, name: &'static str, text: impl AsRef<str>) -> Self {
        self.with(name, Value::quoted(text))
    }

    /// Adds a note.
    pub fn note(mut self, message: &'static Message, arguments: Vec<(&'static str, Value)>) -> Self {
        self.notes.push(Note { message, arguments });
        self
    }

    /// Sets the file.
    pub fn in_file(mut self, file: &Utf8Path) -> Self {
        self.file = Some(file.to_owned());
        self
    }

    /// Sets the path.
    pub fn in_path(mut self, path: &str) -> Self {
        self.path = Some(path.into());
        self
    }

    /// Sets the line and the column, both counted from 1, if they are known.
    pub fn at_line(mut self, line: impl Into<Option<u32>>, column: Option<u32>) -> Self {
        if let Some(line) = line.into() {
            self.place.line = Some(line);
            self.place.column = column;
        }
        self
    }

    /// Sets the element by its number, with everything that is known without the source map.
    pub fn at_element(mut self, element: ElementId, entity: EntityKind, layer: &str, point: Point) -> Self {
        self.place.element = Some(element);
        self.place.entity = Some(entity);
        self.place.layer = Some(layer.into());
        self.place.point = Some(point);
        self
    }

    /// Sets the point in the drawing.
    pub fn at_point(mut self, point: Point) -> Self {
        self.place.point = Some(point);
        self
    }

    /// Sets the faulty text, if there is one.
    pub fn with_text(mut self, text: impl Into<Option<TextFault>>) -> Self {
        self.text = text.into().or(self.text);
        self
    }

    /// Says this instead, with the argument `nearest`, if there is a similar name.
    pub fn or_nearest(mut self, message: &'static Message, nearest: Option<impl AsRef<str>>) -> Self {
        let Some(nearest) = nearest else { return self };
        self.message = message;
        self.quoting("nearest", nearest)
    }

    /// The value of an argument of the message.
    pub fn argument(&self, name: &str) -> Option<&Value> {
        argument(&self.arguments, name)
    }

    /// The text of an argument that is quoted.
    pub fn quoted(&self, name: &str) -> Option<&str> {
        match self.argument(name)? {
            Value::Quoted(text) => Some(text),
            _ => None,
        }
    }

    /// Fills in the line and handle of the element from the source map.
    pub fn locate(&mut self, line: u32, handle: Option<Handle>) {
        self.place.line = Some(line);
        self.place.handle = handle;
    }

    /// Renames files wherever the diagnostic names them. `replacement` returns the new name of a file, if it gets one.
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

    /// The key for sorting diagnostics wherever several are shown: file, path, place, code.
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

    /// The line named by the message, if that concerns something other than a file.
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
    /// The value of an argument.
    pub fn argument(&self, name: &str) -> Option<&Value> {
        argument(&self.arguments, name)
    }

    /// The note as a sentence.
    pub fn text(&self, lang: Lang) -> String {
        fill(self.message.text.in_lang(lang), &self.arguments, lang)
    }
}

/// Deserializes a message by its key; an error if this version has no such message.
fn kept_message<'de, D: Deserializer<'de>>(deserializer: D) -> Result<&'static Message, D::Error> {
    static BY_KEY: LazyLock<HashMap<&str, &Message>> =
        LazyLock::new(|| messages::all().map(|message| (message.key, message)).collect());
    let key = <&str>::deserialize(deserializer)?;
    BY_KEY.get(key).copied().ok_or_else(|| D::Error::custom("no message of this program"))
}
