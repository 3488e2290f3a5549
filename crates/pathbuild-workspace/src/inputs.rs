//! What a command is asked to work on.

use camino::{Utf8Path, Utf8PathBuf};

/// Drawings, paths and directories, in the order in which they were given.
#[derive(Clone, Debug, Default)]
pub struct Inputs {
    /// Each, as it was written.
    pub inputs: Vec<String>,
}

impl Inputs {
    /// Names of files, whatever they end in.
    pub fn places<'a>(files: impl IntoIterator<Item = &'a Utf8PathBuf>) -> Self {
        let place = |file: &Utf8PathBuf| {
            if file.components().count() > 1 { file.to_string() } else { format!("./{file}") }
        };
        Self { inputs: files.into_iter().map(place).collect() }
    }

    /// Each of them.
    pub fn iter(&self) -> impl Iterator<Item = Input<'_>> {
        self.inputs.iter().map(|text| Input::new(text))
    }

    /// The directory from which the configuration is looked for: that of the first argument, else the working directory (empty).
    pub fn first_directory(&self) -> Utf8PathBuf {
        match self.iter().next() {
            Some(Input::Place(place)) if is_drawing(place) => {
                place.parent().unwrap_or(Utf8Path::new("")).to_owned()
            }
            Some(Input::Place(place)) => place.to_owned(),
            Some(Input::Name(_)) | None => Utf8PathBuf::new(),
        }
    }
}

/// One of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Input<'a> {
    /// A drawing or directory: it ends in .dxf, contains a path separator, or is `.` or `..`.
    Place(&'a Utf8Path),
    /// The name of a path; if there is none, of a drawing without its .dxf.
    Name(&'a str),
}

impl<'a> Input<'a> {
    /// Tells which one a text means.
    pub fn new(text: &'a str) -> Self {
        let is_place = is_drawing(Utf8Path::new(text))
            || text.contains(std::path::is_separator)
            || matches!(text, "." | "..");
        if is_place { Self::Place(Utf8Path::new(text)) } else { Self::Name(text) }
    }
}

fn is_drawing(place: &Utf8Path) -> bool {
    place.as_str().to_ascii_lowercase().ends_with(".dxf")
}
