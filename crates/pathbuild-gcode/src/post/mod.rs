//! Post-processors: programs in the words of another machine. (spec/85-post-processors.md)
//!
//! A [`Job`] is what a post reads, made from finished programs or from a program that was read. A [`Post`] is a definition in one
//! of two languages, CamBam's or CAD6's; [`Post::write`] makes the text. Nothing here does IO.

mod arcs;
mod cad6;
mod cambam;
mod from_program;
mod holes;
mod job;
mod number;
mod step;
mod suggest;
mod tools;

use std::fmt;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::{Diagnostic, Note, Value, messages::posts};

pub use job::{Coolant, Entry, Job, Operation, Plane, Spindle, Stock, Texts, Tool, Units, VelocityMode};
pub use step::{Arc, Hole, HoleKind, Position, Step};
pub use tools::{ToolEntry, ToolTable};

/// A definition that was read, ready to write programs.
#[derive(Clone, Debug)]
pub struct Post {
    file: Utf8PathBuf,
    engine: Engine,
    warnings: Vec<Diagnostic>,
}

#[derive(Clone, Debug)]
enum Engine {
    CamBam(Box<cambam::Definition>),
    Cad6(Box<cad6::Definition>),
}

/// What a post is told beside the program.
#[derive(Clone, Debug)]
pub struct PostOptions<'a> {
    /// The text of `{$date}`; without it the date is left out, so that output depends on input only.
    pub date: Option<Box<str>>,
    /// User macros of the configuration; they win over the definition's.
    pub macros: Vec<PostMacro>,
    /// Holes become canned cycles.
    pub cycles: bool,
    /// The name of the file that will be written, for the post's own command.
    pub output: Option<Box<str>>,
    /// The post's own command will be run: it is handed out instead of a note that it was skipped.
    pub run_post_build: bool,
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
            files: &NoFiles,
        }
    }
}

/// The files below the directory of a definition.
pub trait PostFiles: fmt::Debug {
    /// The content of a file. The path is relative and leads nowhere but down; links that lead elsewhere are the implementation's to
    /// refuse.
    ///
    /// # Errors
    /// Why there is none, as the system says it.
    fn read(&self, path: &Utf8Path) -> Result<Vec<u8>, String>;
}

/// No files at all.
#[derive(Clone, Copy, Debug)]
pub struct NoFiles;

impl PostFiles for NoFiles {
    fn read(&self, _: &Utf8Path) -> Result<Vec<u8>, String> {
        Err("this post has no directory".to_owned())
    }
}

/// A user macro: `{$name}` stands for `value`, which may use macros itself.
#[derive(Clone, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the type says it")]
pub struct PostMacro {
    pub name: Box<str>,
    pub value: Box<str>,
}

/// What a post wrote.
#[derive(Clone, Debug)]
pub struct Output {
    /// The content of the file.
    pub text: Vec<u8>,
    /// The extension of its name, without point.
    pub extension: Box<str>,
    /// What the user should know.
    pub notes: Vec<Note>,
    /// What is doubtful in the definition or the text.
    pub warnings: Vec<Diagnostic>,
    /// The command that the definition wants to be run on the file: the program, then its arguments, for no shell.
    pub post_build: Option<Vec<String>>,
    /// The files that are part of the text, relative to the definition's directory: the text must be made again when they change.
    pub inserted: Vec<Box<str>>,
}

/// Larger definitions are refused unread.
const LARGEST_DEFINITION: usize = 1 << 20;

impl Post {
    /// Reads a definition. `file` is where it comes from, for diagnostics.
    ///
    /// # Errors
    /// Everything that is wrong in it, with lines.
    pub fn read(bytes: &[u8], file: &Utf8Path) -> Result<Self, Vec<Diagnostic>> {
        if bytes.len() > LARGEST_DEFINITION {
            let diagnostic = Diagnostic::new(&posts::POST_TOO_LARGE).with("size", bytes.len());
            return Err(vec![diagnostic.with("limit", LARGEST_DEFINITION).in_file(file)]);
        }
        let text = std::str::from_utf8(bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes))
            .map_err(|_| vec![Diagnostic::new(&posts::POST_NOT_UTF8).in_file(file)])?;
        let (engine, warnings) = if text.trim_start().starts_with('<') {
            let (definition, warnings) = cambam::Definition::parse(text, file)?;
            (Engine::CamBam(Box::new(definition)), warnings)
        } else {
            let (definition, warnings) = cad6::Definition::parse(text, file)?;
            (Engine::Cad6(Box::new(definition)), warnings)
        };
        Ok(Self { file: file.to_owned(), engine, warnings })
    }

    /// Writes a program.
    ///
    /// # Errors
    /// Every macro that nobody defines, else the first thing that would make the text wrong.
    pub fn write(&self, job: &Job, options: &PostOptions<'_>) -> Result<Output, Vec<Diagnostic>> {
        job.check().map_err(|error| vec![*error])?;
        match &self.engine {
            Engine::CamBam(definition) => {
                let mut written = cambam::write(definition, &self.file, job, options)?;
                let mut notes = Vec::new();
                if written.leaves_out_coolant {
                    let name = Value::from("{$coolant}");
                    notes.push(Note {
                        message: &posts::COOLANT_NOT_WRITTEN,
                        arguments: vec![("macro", name)],
                    });
                }
                if let Some(command) = written.post_build.take_if(|_| !options.run_post_build) {
                    let command = Value::from(command.join(" "));
                    notes.push(Note {
                        message: &posts::POST_BUILD_SKIPPED,
                        arguments: vec![("command", command)],
                    });
                }
                Ok(Output {
                    text: written.text.into_bytes(),
                    extension: definition.extension().into(),
                    notes,
                    warnings: self.warnings.iter().cloned().chain(written.warnings).collect(),
                    post_build: written.post_build,
                    inserted: Vec::new(),
                })
            }
            Engine::Cad6(definition) => {
                let written = cad6::write(definition, &self.file, job, options)?;
                Ok(Output {
                    text: written.text,
                    extension: definition.extension().into(),
                    notes: Vec::new(),
                    warnings: self.warnings.iter().cloned().chain(written.warnings).collect(),
                    post_build: None,
                    inserted: written.inserted,
                })
            }
        }
    }
}

/// A file name's extension, without point.
fn extension(text: &str) -> Option<Box<str>> {
    let text = text.trim_start_matches('.');
    let is_extension =
        !text.is_empty() && text.len() <= 16 && text.chars().all(|c| c.is_ascii_alphanumeric());
    is_extension.then(|| text.into())
}
