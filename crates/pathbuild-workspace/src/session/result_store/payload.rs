//! Encoding of check results for the cache.

use pathbuild_cache::{CorruptPayload, decode, encode};
use pathbuild_diagnostic::{Code, Diagnostic, Value};
use pathbuild_path::PathName;

/// The result of checking a drawing, or only of reading it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DrawingResult {
    /// Names of its paths.
    pub names: Vec<PathName>,
    /// Diagnostics of the drawing, of its paths, and of what they embed.
    pub diagnostics: Vec<Diagnostic>,
}

impl DrawingResult {
    /// Both fields as slices.
    pub fn parts(&self) -> (&[PathName], &[Diagnostic]) {
        (&self.names, &self.diagnostics)
    }

    /// Encodes the result; `None` if another run may get a different result.
    pub fn encode(&self) -> Option<Vec<u8>> {
        if self.diagnostics.iter().any(is_transient) {
            return None;
        }
        let names: Vec<&str> = self.names.iter().map(PathName::as_str).collect();
        encode(&(names, &self.diagnostics))
    }

    /// Decodes what [`encode`](Self::encode) wrote.
    ///
    /// # Errors
    /// If the bytes are not a result.
    pub fn decode(payload: &[u8]) -> Result<Self, CorruptPayload> {
        let (names, diagnostics): (Vec<&str>, _) = decode(payload)?;
        Ok(Self { names: names.into_iter().map(PathName::new).collect(), diagnostics })
    }
}

/// Whether a diagnostic may disappear although no input changes: a file that another process had locked, a busy machine, a bug.
pub fn is_transient(diagnostic: &Diagnostic) -> bool {
    match diagnostic.code() {
        Code::UnreadableFile | Code::InternalError => true,
        Code::LimitReached => {
            let seconds = ("key", Value::quoted("seconds-per-path"));
            diagnostic.arguments.contains(&seconds)
        }
        _ => false,
    }
}
