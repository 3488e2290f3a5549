//! The post that wrote a program. (book: program/reading, "Programs of a definition of your own")

use pathbuild_diagnostic::Diagnostic;
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::interpret::{EvidenceKind, Guess};
use pathbuild_workspace::posting::{PostArguments, PostProcessor};

use crate::args::VerifyArgs;
use crate::commands::program::ByDefinition;
use crate::context::Context;

/// The posts that may have written the programs of a run.
pub(super) struct Writers {
    /// `--post`.
    named: Option<PostProcessor>,
    /// The one of the configuration.
    configured: Option<PostProcessor>,
    dialect: Option<Dialect>,
}

impl Writers {
    /// Those of the command line and the configuration.
    ///
    /// # Errors
    /// The named post does not exist, or is broken.
    pub(super) fn new(context: &Context, args: &VerifyArgs) -> Result<Self, Vec<Diagnostic>> {
        let dialect = args.reading.dialect;
        let post = |name| {
            let dialect = dialect.map(|dialect| dialect.name().into());
            PostProcessor::for_run(context, name, PostArguments { dialect, ..PostArguments::default() })
        };
        let named = args.post.as_deref().map(|name| post(Some(name))).transpose()?.flatten();
        // Of a broken one `emit` tells.
        let configured = if named.is_some() { None } else { post(None).ok().flatten() };
        Ok(Self { named, configured, dialect })
    }

    /// The dialect that the command line says, by itself or by the post.
    pub(super) fn dialect(&self) -> Option<Dialect> {
        self.dialect.or(self.named.as_ref().and_then(PostProcessor::reader))
    }

    /// The post that wrote a program of this dialect, as far as it is known. A program that shows no dialect by its header is one of a
    /// configured definition that names none.
    pub(super) fn of(&self, dialect: Dialect, evidence: Option<EvidenceKind>) -> Option<&PostProcessor> {
        let is_without_header = evidence.is_some_and(|kind| kind != EvidenceKind::Header);
        let may_have_written = |post: &&PostProcessor| match post.reader() {
            Some(reader) => reader == dialect,
            None => is_without_header && dialect != Dialect::Native,
        };
        self.named.as_ref().or(self.configured.as_ref().filter(may_have_written))
    }

    /// A text as the definition reads it that wrote it, where that names no dialect.
    pub(super) fn translate(&self, text: &[u8], guess: Option<&Guess>) -> Option<ByDefinition> {
        let dialect = guess.map(|guess| guess.dialect).or(self.dialect)?;
        let writer = self.of(dialect, guess.map(|guess| guess.evidence.kind))?;
        Some(ByDefinition { name: writer.name(), translated: writer.translate(text)? })
    }
}
