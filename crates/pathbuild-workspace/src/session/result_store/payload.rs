//! Results as bytes.

use pathbuild_cache::{Corrupt, decode, encode};
use pathbuild_diagnostic::{Code, Diagnostic, Value};
use pathbuild_path::PathName;

/// What is known of a drawing whose paths were checked.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DrawingResult {
    /// Its paths.
    pub names: Vec<PathName>,
    /// What is wrong with it, with its paths, and with what they embed.
    pub diagnostics: Vec<Diagnostic>,
}

impl DrawingResult {
    /// Its paths, and what is wrong.
    pub fn parts(&self) -> (&[PathName], &[Diagnostic]) {
        (&self.names, &self.diagnostics)
    }

    /// As bytes; `None` where another run may find something else.
    pub fn encode(&self) -> Option<Vec<u8>> {
        if self.diagnostics.iter().any(is_passing) {
            return None;
        }
        let names: Vec<&str> = self.names.iter().map(PathName::as_str).collect();
        encode(&(names, &self.diagnostics))
    }

    /// From bytes.
    ///
    /// # Errors
    /// When they are of something else.
    pub fn decode(payload: &[u8]) -> Result<Self, Corrupt> {
        let (names, diagnostics): (Vec<&str>, _) = decode(payload)?;
        Ok(Self { names: names.into_iter().map(PathName::new).collect(), diagnostics })
    }
}

/// Whether a finding may pass though nothing changes: a file that somebody else had open, a machine that was busy, a bug.
pub fn is_passing(diagnostic: &Diagnostic) -> bool {
    match diagnostic.code() {
        Code::UnreadableFile | Code::InternalError => true,
        Code::LimitReached => {
            let seconds = ("key", Value::from("seconds-per-path"));
            diagnostic.arguments.contains(&seconds)
        }
        _ => false,
    }
}
