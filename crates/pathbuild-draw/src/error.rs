use std::fmt;

/// An error in a drawing in text form.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DrawError {
    /// The line, counted from 1; 0 if the drawing was not read from a text.
    pub line: u32,
    /// The column in characters, counted from 1; 0 for errors that concern the whole line.
    pub column: u32,
    /// One sentence that says what is wrong and what was expected.
    pub message: String,
}

impl DrawError {
    /// Creates an error at a place.
    pub fn new(line: u32, column: u32, message: impl Into<String>) -> Self {
        Self { line, column, message: message.into() }
    }
}

impl fmt::Display for DrawError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.line, self.column) {
            (0, _) => write!(f, "{}", self.message),
            (line, 0) => write!(f, "line {line}: {}", self.message),
            (line, column) => write!(f, "line {line}, column {column}: {}", self.message),
        }
    }
}

impl std::error::Error for DrawError {}
