//! Messages between the page and the compiler: questions and answers.

use pathbuild_diagnostic::Lang;
use pathbuild_workspace::program_view::Assumptions;
use serde::Deserialize;
use serde_json::Value;

/// A question from the page. File paths are relative to the folder that the page was given.
#[derive(Clone, Debug, Deserialize)]
#[serde(tag = "ask", rename_all = "kebab-case")]
pub enum Question {
    /// Adds a file, whose bytes follow the line of JSON. There is no answer.
    Put {
        /// Path of the file, relative to the folder.
        file: String,
    },
    /// Opens the files that were added. The answer is `{ halted, problems, drawings, posts, seconds }`. The questions below are only answered
    /// afterwards.
    Open {
        /// Options that override the configuration.
        #[serde(default)]
        options: Options,
        /// Paths and drawings that made earlier instances of the compiler end.
        #[serde(default)]
        lost: Vec<AbortedItem>,
    },
    /// Requests the paths of a drawing, without their states. The answer is `{ rows }`; a drawing with an error of its own has a row without a path.
    Index {
        /// Path of the drawing's file.
        file: String,
    },
    /// Requests a path with its state, as in `list`. The answer is `{ row }`.
    Check(Place),
    /// Requests totals over all checked paths, as in `stats`. The answer is `{ statistics }`.
    Statistics,
    /// Reads a G-code program, whose text follows the line of JSON. The answer is `{ seen }`, followed by the scene with the findings of `verify`.
    Program {
        /// Name of the program's file.
        name: String,
        /// Values assumed for what the program does not state.
        #[serde(flatten)]
        assumptions: Assumptions,
    },
    /// Requests the scene of a path, or of all paths of a drawing. The answer is `{ seen }`, followed by the scene as JSON.
    Scene(Place),
    /// Requests the picture of a path, or of all paths of a drawing. The answer is `{ seen }`, followed by the picture as SVG.
    Picture(Place),
    /// Writes the programs of paths as `emit` does. The answer is `{ refused, problems, files }`, where each file has a name and a size, followed by
    /// the bytes of all files in this order.
    Emit {
        /// Paths to write; a drawing without a path stands for all its paths.
        places: Vec<Place>,
    },
}

/// A path of a drawing, or all its paths.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Deserialize)]
pub struct Place {
    /// Path of the drawing's file.
    pub file: String,
    /// Name of the path; `None` for all paths.
    pub path: Option<String>,
}

/// Options that override the configuration, as on the command line.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default, rename_all = "kebab-case")]
pub struct Options {
    /// F in mm/min for paths that do not set it.
    pub feed: Option<String>,
    /// S in mm for paths that do not set it.
    pub sweep_height: Option<String>,
    /// Speed of rapid moves in mm/min.
    pub rapid: Option<String>,
    /// Feed of probing moves in mm/min, for probes that do not set it.
    pub probe_feed: Option<String>,
    /// The post; `None` for the one in the configuration.
    pub post: Option<String>,
    /// Language of the texts that answers contain in one language only.
    pub lang: Lang,
}

/// A path or drawing that took too long or triggered a bug, so that the instance of the compiler ended.
#[derive(Clone, Debug, Deserialize)]
pub struct AbortedItem {
    /// The path or drawing that was being processed.
    #[serde(flatten)]
    pub place: Place,
    /// The reason. In JSON, its fields are at the same level as those of the place.
    #[serde(flatten)]
    pub why: AbortReason,
}

/// The reason why the compiler ended.
#[derive(Clone, Debug, Deserialize)]
#[serde(tag = "why", rename_all = "kebab-case")]
pub enum AbortReason {
    /// The path took too long: PB005.
    Time,
    /// The path triggered a bug: PB006.
    Bug {
        /// Message of the panic, if known.
        reason: String,
    },
}

/// An answer: JSON, and bytes that follow.
#[derive(Debug, Default)]
pub(crate) struct Answer {
    pub(crate) head: Value,
    pub(crate) bytes: Vec<u8>,
}

impl From<Value> for Answer {
    fn from(head: Value) -> Self {
        Self { head, bytes: Vec::new() }
    }
}

impl Answer {
    pub(crate) fn message(self) -> Vec<u8> {
        let mut message = self.head.to_string().into_bytes();
        message.push(b'\n');
        message.extend(self.bytes);
        message
    }
}
