use camino::{Utf8Path, Utf8PathBuf};

use serde::{Deserialize, Serialize};

use crate::message::fill;
use crate::{
    Code, ElementId, EntityKind, Handle, Lang, Message, Place, Point, Severity, TextFault, Value, kept,
};

type Arguments = Vec<(&'static str, Value)>;

/// One thing that is wrong, or doubtful: which message, with which values, where.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Diagnostic {
    /// What is said.
    #[serde(deserialize_with = "kept::message")]
    pub message: &'static Message,
    /// The catalogue's severity of the code; the configuration can change it when it is reported.
    pub severity: Severity,
    /// The values in the message and its help, by name.
    #[serde(deserialize_with = "kept::arguments")]
    pub arguments: Arguments,
    /// More that helps: the nearest open end, where a path was searched.
    pub notes: Vec<Note>,
    /// The file it is in. Stages that know no files leave it empty; their caller fills it in.
    pub file: Option<Utf8PathBuf>,
    /// The path it is in, spelt as in the drawing.
    pub path: Option<Box<str>>,
    /// Where in the file.
    pub place: Place,
    /// The text that is at fault.
    pub text: Option<TextFault>,
    /// The embeddings that led here, outermost first.
    pub trace: Vec<TraceStep>,
}

/// A further sentence under a diagnostic.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Note {
    /// What is said.
    #[serde(deserialize_with = "kept::message")]
    pub message: &'static Message,
    /// The values in it.
    #[serde(deserialize_with = "kept::arguments")]
    pub arguments: Arguments,
}

/// One embedding on the way to an erroneous path.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct TraceStep {
    /// The drawing that embeds.
    pub file: Utf8PathBuf,
    /// The path that embeds.
    pub path: Box<str>,
    /// Where the subpath segment begins.
    pub point: Point,
}

impl Diagnostic {
    /// A diagnostic that knows no place yet.
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

    /// The code it is reported under.
    pub fn code(&self) -> Code {
        self.message.code
    }

    /// Whether it stops the path or file it is in.
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }

    /// What is wrong, in one sentence.
    pub fn text(&self, lang: Lang) -> String {
        fill(self.message.text.template(lang), &self.arguments, lang)
    }

    /// What to do about it; `None` when the message says all.
    pub fn help(&self, lang: Lang) -> Option<String> {
        let template = self.message.help.template(lang);
        (!template.is_empty()).then(|| fill(template, &self.arguments, lang))
    }

    /// Sets a value of the message.
    pub fn with(mut self, name: &'static str, value: impl Into<Value>) -> Self {
        self.arguments.push((name, value.into()));
        self
    }

    /// Adds a further sentence.
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

    /// Sets the line, and the column where it is known (both from 1).
    pub fn at_line(mut self, line: u32, column: Option<u32>) -> Self {
        self.place.line = Some(line);
        self.place.column = column;
        self
    }

    /// Sets the element by number, with what is known of it without the source map.
    pub fn at_element(mut self, element: ElementId, entity: EntityKind, layer: &str, point: Point) -> Self {
        self.place.element = Some(element);
        self.place.entity = Some(entity);
        self.place.layer = Some(layer.into());
        self.place.point = Some(point);
        self
    }

    /// Sets the place in the drawing.
    pub fn at_point(mut self, point: Point) -> Self {
        self.place.point = Some(point);
        self
    }

    /// Sets the faulty text.
    pub fn with_text(mut self, text: TextFault) -> Self {
        self.text = Some(text);
        self
    }

    /// Fills in the line and handle of the element, once it is known which.
    pub fn locate(&mut self, line: u32, handle: Option<Handle>) {
        self.place.line = Some(line);
        self.place.handle = handle;
    }

    /// What diagnostics are ordered by wherever several are shown: file, path, place, code.
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

    /// The line that the message names, of something that is no file.
    fn named_line(&self) -> Option<u64> {
        let line = self.arguments.iter().find(|(name, _)| *name == "line").map(|(_, value)| value);
        match line {
            Some(Value::Count(line)) if self.place.line.is_none() => Some(*line),
            _ => None,
        }
    }
}

impl Note {
    /// The sentence.
    pub fn text(&self, lang: Lang) -> String {
        fill(self.message.text.template(lang), &self.arguments, lang)
    }
}
