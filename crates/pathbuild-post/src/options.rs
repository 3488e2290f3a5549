//! What a post is told beside the program.

use std::fmt;

use camino::Utf8Path;
use pathbuild_diagnostic::Value;
use pathbuild_diagnostic::reasons::NO_DIRECTORY_OF_POST;

use pathbuild_gcode::native::Charset;
use pathbuild_gcode::verify::Machine;

/// How a program is written through a post.
#[derive(Clone, Debug)]
#[expect(clippy::struct_excessive_bools, reason = "each is a switch of its own")]
pub struct PostOptions<'a> {
    /// The text of `{$date}`; without it the date is left out, so that output depends on input only.
    pub date: Option<Box<str>>,
    /// User macros of the configuration; they win over the definition's. In control texts they are variables.
    pub macros: Vec<PostMacro>,
    /// Holes become canned cycles, where the target knows them.
    pub cycles: bool,
    /// The name of the file that will be written, for the post's own command.
    pub output: Option<Box<str>>,
    /// The post's own command will be run: it is handed out instead of a note that it was skipped.
    pub run_post_build: bool,
    /// Characters that are written; targets that act on other bytes get ASCII in any case.
    pub charset: Charset,
    /// The dialect of the output, where the definition does not name one or names another.
    pub dialect: Option<Box<str>>,
    /// The most bytes of the text. (`[limits] output-size`)
    pub most_bytes: usize,
    /// Somebody answers for what cannot be read back.
    pub unchecked: bool,
    /// The number of the program; `None`: the first number in the program's name.
    pub program_number: Option<u32>,
    /// The operator sees to the spindle: no word of the definition's spindle macros is written.
    pub manual_spindle: bool,
    /// A definition that switches the spindle needs its speed: without one it would not turn.
    pub needs_speed: bool,
    /// The machine counts P of dwells in milliseconds, where its control may count them either way.
    pub milliseconds: bool,
    /// The time in seconds that the spindle takes to reach its speed.
    pub spin_up: f64,
    /// What the machine can do, where that is known.
    pub machine: Option<Machine>,
    /// Where files are that the definition inserts.
    pub files: &'a dyn PostFiles,
}

impl Default for PostOptions<'_> {
    fn default() -> Self {
        Self {
            date: None,
            macros: Vec::new(),
            cycles: false,
            output: None,
            run_post_build: false,
            charset: Charset::Ascii,
            most_bytes: usize::MAX,
            dialect: None,
            unchecked: false,
            program_number: None,
            manual_spindle: false,
            needs_speed: false,
            milliseconds: false,
            spin_up: 0.0,
            machine: None,
            files: &NoFiles,
        }
    }
}

/// A user macro: `{$name}`, or `~name~` in control texts, stands for `value`, which may use macros itself.
#[derive(Clone, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the type says it")]
pub struct PostMacro {
    pub name: Box<str>,
    pub value: Box<str>,
}

/// The files below the directory of a definition.
pub trait PostFiles: fmt::Debug {
    /// The content of a file. The path is relative and leads nowhere but down; links that lead elsewhere are the implementation's to
    /// refuse.
    ///
    /// # Errors
    /// Why there is none.
    fn read(&self, path: &Utf8Path) -> Result<Vec<u8>, Value>;
}

/// No files at all.
#[derive(Clone, Copy, Debug)]
pub struct NoFiles;

impl PostFiles for NoFiles {
    fn read(&self, _: &Utf8Path) -> Result<Vec<u8>, Value> {
        Err(Value::Prose(&NO_DIRECTORY_OF_POST))
    }
}
