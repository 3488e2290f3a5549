use std::fmt;

/// What is wrong with a drawing in text form.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DrawError {
    /// The line, from 1; 0 for what was not read from a text.
    pub line: u32,
    /// The column in characters, from 1; 0 for what concerns the whole line.
    pub column: u32,
    /// What is wrong and what was expected, in one sentence.
    pub message: String,
}

impl DrawError {
    /// An error at a place.
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
