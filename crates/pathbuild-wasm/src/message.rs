//! What is asked and answered.

use pathbuild_diagnostic::Lang;
use serde::Deserialize;
use serde_json::Value;

/// What the page asks. Paths of files are relative to the folder that it was given.
#[derive(Clone, Debug, Deserialize)]
#[serde(tag = "ask", rename_all = "kebab-case")]
pub enum Question {
    /// A file; its bytes follow. No answer.
    Put {
        /// Where it lies.
        file: String,
    },
    /// What the files are: `{ halted, problems, drawings, posts, seconds }`. Everything else is asked after that.
    Open {
        /// What the page says beside the configuration.
        #[serde(default)]
        options: Options,
        /// What was lost before.
        #[serde(default)]
        lost: Vec<Lost>,
    },
    /// The paths of a drawing: `{ rows }`, without their states; a row without a path where the drawing is wrong as a whole.
    Index {
        /// The drawing.
        file: String,
    },
    /// A path with its state, as `list` has it: `{ row }`.
    Check(Place),
    /// What all paths add up to that were checked, as `stats` has it: `{ statistics }`.
    Statistics,
    /// What there is to see of a path, or of all paths of a drawing. The scene follows.
    Scene(Place),
    /// The same as a picture; SVG follows.
    Picture(Place),
    /// Programs, as `emit` writes them: `{ refused, problems, files }`. Each file has a name and a size; their bytes follow one after the
    /// other.
    Emit {
        /// The paths.
        places: Vec<Place>,
    },
}

/// A path of a drawing; without its name all paths.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Deserialize)]
pub struct Place {
    /// The drawing.
    pub file: String,
    /// The path.
    pub path: Option<String>,
}

/// What the page says beside the configuration, as the command line would.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default, rename_all = "kebab-case")]
pub struct Options {
    /// F for paths without, in mm/min.
    pub feed: Option<String>,
    /// S for paths without, in mm.
    pub sweep_height: Option<String>,
    /// The speed of rapid moves in mm/min.
    pub rapid: Option<String>,
    /// The feed of probes in mm/min.
    pub probe_feed: Option<String>,
    /// The post; `None`: that of the configuration.
    pub post: Option<String>,
    /// `de` or `en`.
    pub lang: Language,
}

/// The language of what is answered in one language only.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Language {
    #[default]
    En,
    De,
}

/// A path that ended the compiler, or a drawing.
#[derive(Clone, Debug, Deserialize)]
pub struct Lost {
    /// Which one.
    #[serde(flatten)]
    pub place: Place,
    /// Why.
    #[serde(flatten)]
    pub why: Why,
}

/// Why the compiler ended.
#[derive(Clone, Debug, Deserialize)]
#[serde(tag = "why", rename_all = "kebab-case")]
pub enum Why {
    /// It took too long: PB005.
    Time,
    /// It showed a bug: PB006.
    Bug {
        /// What is known of that.
        reason: String,
    },
}

/// An answer: JSON, and what follows.
#[derive(Debug, Default)]
pub(crate) struct Answer {
    pub(crate) head: Value,
    pub(crate) bytes: Vec<u8>,
}

impl From<Language> for Lang {
    fn from(language: Language) -> Self {
        match language {
            Language::En => Self::En,
            Language::De => Self::De,
        }
    }
}

impl From<Value> for Answer {
    fn from(head: Value) -> Self {
        Self { head, bytes: Vec::new() }
    }
}

impl Answer {
    /// As one message.
    pub(crate) fn message(self) -> Vec<u8> {
        let mut message = self.head.to_string().into_bytes();
        message.push(b'\n');
        message.extend(self.bytes);
        message
    }
}
