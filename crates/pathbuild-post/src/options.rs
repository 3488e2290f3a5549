//! Options for writing a program through a post.

use std::fmt;

use camino::Utf8Path;
use pathbuild_diagnostic::Value;
use pathbuild_diagnostic::reasons::NO_DIRECTORY_OF_POST;
use pathbuild_gcode::dialect::Charset;
use pathbuild_gcode::verify::Machine;

/// Options for writing a program through a post.
#[derive(Clone, Debug)]
#[expect(clippy::struct_excessive_bools, reason = "each is a switch of its own")]
pub struct PostOptions<'a> {
    /// Value of `{$date}`. If it is `None`, the date is omitted, so that the output depends only on the input.
    pub date: Option<Box<str>>,
    /// User macros of the configuration, which take precedence over those of the definition. Control texts use them as variables.
    pub macros: Vec<PostMacro>,
    /// Whether holes become canned cycles, if the target supports them.
    pub cycles: bool,
    /// Name of the output file, for the macro that expands to it and for the command that the definition asks to run.
    pub output: Option<Box<str>>,
    /// Whether the caller will run the command of the definition. If so, the command is returned; otherwise a note says that it was
    /// skipped.
    pub run_post_build: bool,
    /// Characters that the output may contain. If the target acts on bytes outside ASCII, the output is always ASCII.
    pub charset: Charset,
    /// Dialect of the output. It takes precedence over the one that the definition declares.
    pub dialect: Option<Box<str>>,
    /// Maximum size of the text in bytes. (`[limits] output-size`)
    pub most_bytes: usize,
    /// Whether the user takes responsibility for the output, so that it is written even if it cannot be read back or differs from the job.
    pub unchecked: bool,
    /// Number of the program; `None` means the first number in its name.
    pub program_number: Option<u32>,
    /// Whether the operator switches the spindle, so that the spindle macros of the definition write nothing.
    pub manual_spindle: bool,
    /// Whether a definition that switches the spindle requires a speed, without which the spindle would not turn.
    pub needs_speed: bool,
    /// Whether the machine counts P of dwells in milliseconds. Only for controls where this is a setting.
    pub milliseconds: bool,
    /// Time in seconds that the spindle needs to reach its speed.
    pub spin_up: f64,
    /// Capabilities of the machine, if they are known.
    pub machine: Option<Machine>,
    /// Maximum distance in mm by which cuts may miss the outline of a part. (`part-tolerance`)
    pub part_tolerance: f64,
    /// Access to the files that the definition inserts.
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
            part_tolerance: 0.0,
            files: &RefusedFiles,
        }
    }
}

/// A user macro. `{$name}`, or `~name~` in control texts, expands to `value`, which may contain macros.
#[derive(Clone, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the type says it")]
pub struct PostMacro {
    pub name: Box<str>,
    pub value: Box<str>,
}

/// Access to the files below the directory of a definition.
pub trait PostFiles: fmt::Debug + Sync {
    /// Reads a file. The path is relative and never contains `..`. Implementations must refuse links that point outside the directory.
    ///
    /// # Errors
    /// The reason why the file cannot be read.
    fn read(&self, path: &Utf8Path) -> Result<Vec<u8>, Value>;
}

/// An implementation of [`PostFiles`] that refuses to read any file.
#[derive(Clone, Copy, Debug)]
pub struct RefusedFiles;

impl PostFiles for RefusedFiles {
    fn read(&self, _: &Utf8Path) -> Result<Vec<u8>, Value> {
        Err(Value::Prose(&NO_DIRECTORY_OF_POST))
    }
}
