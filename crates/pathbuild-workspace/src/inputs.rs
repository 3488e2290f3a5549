//! The inputs of a command: drawings, paths and directories.

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::is_drawing;

/// Drawings, paths and directories, in the order in which they were given.
#[derive(Clone, Debug, Default)]
pub struct Inputs {
    /// Each input as the user wrote it.
    pub inputs: Vec<String>,
}

impl Inputs {
    /// Creates inputs that name files, whatever their extensions.
    pub fn of_files<'a>(files: impl IntoIterator<Item = &'a Utf8PathBuf>) -> Self {
        let place = |file: &Utf8PathBuf| {
            if file.components().count() > 1 { file.to_string() } else { format!("./{file}") }
        };
        Self { inputs: files.into_iter().map(place).collect() }
    }

    /// Returns the inputs as the user wrote them.
    pub fn texts(&self) -> Vec<&str> {
        self.inputs.iter().map(String::as_str).collect()
    }

    /// Iterates over the inputs, each classified.
    pub fn iter(&self) -> impl Iterator<Item = Input<'_>> {
        self.inputs.iter().map(|text| Input::new(text))
    }
}

/// A drawing, path, program or directory that is given to a command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Input<'a> {
    /// A drawing, a program or a directory: the text ends in .dxf, contains a path separator, or is `.` or `..`.
    Place(&'a Utf8Path),
    /// The name of a path, of a drawing without its `.dxf`, or of a directory: it refers to the first of these that exists.
    Name(&'a str),
}

impl<'a> Input<'a> {
    /// Classifies the text of an input.
    pub fn new(text: &'a str) -> Self {
        let is_place = is_drawing(Utf8Path::new(text))
            || text.contains(std::path::is_separator)
            || matches!(text, "." | "..");
        if is_place { Self::Place(Utf8Path::new(text)) } else { Self::Name(text) }
    }

    /// Returns the directory or program at which the upward search for the configuration begins. For a name that is not that of a directory, this is
    /// the working directory (empty).
    pub(crate) fn search_start(self, is_directory: impl Fn(&Utf8Path) -> bool) -> &'a Utf8Path {
        match self {
            Self::Place(place) if is_drawing(place) => place.parent().unwrap_or(Utf8Path::new("")),
            Self::Place(place) => place,
            Self::Name(name) if is_directory(name.into()) => name.into(),
            Self::Name(_) => Utf8Path::new(""),
        }
    }

    /// Whether the input is a program, that is, a file other than a drawing. It may lie outside the tree of the configuration that applies to it.
    pub(crate) fn is_program(self, is_directory: impl Fn(&Utf8Path) -> bool) -> bool {
        matches!(self, Self::Place(place) if !is_drawing(place) && !is_directory(place))
    }
}
