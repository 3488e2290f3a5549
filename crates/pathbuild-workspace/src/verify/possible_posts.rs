//! The posts that may have written the programs that `verify` reads. (book: program/reading)

use camino::Utf8Path;
use pathbuild_diagnostic::Diagnostic;
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::interpret::{EvidenceKind, Guess};

use super::VerifyOptions;
use crate::files;
use crate::post_processor::{PostArguments, PostProcessor};
use crate::program::DefinitionTranslation;
use crate::workspace::Workspace;

/// The posts that may have written the programs of a run.
#[derive(Debug)]
pub(super) struct PossiblePosts {
    /// The post named by `--post`.
    named: Option<PostProcessor>,
    /// The configured post, unless `--post` is given.
    configured: Option<PostProcessor>,
    dialect: Option<Dialect>,
}

impl PossiblePosts {
    /// Opens the posts of the command line and the configuration.
    ///
    /// # Errors
    /// If the post named by `--post` does not exist, or is broken.
    pub(super) fn new(workspace: &Workspace, options: &VerifyOptions) -> Result<Self, Vec<Diagnostic>> {
        let dialect = options.reading.dialect;
        let post = |name| {
            let dialect = dialect.map(|dialect| dialect.name().into());
            PostProcessor::for_run(workspace, name, PostArguments { dialect, ..PostArguments::default() })
        };
        let named = options.post.as_deref().map(|name| post(Some(name))).transpose()?.flatten();
        // Ignore a configured post that is broken: `emit` reports that.
        let configured = || {
            let own = PostProcessor::for_run(workspace, None, PostArguments::default()).ok().flatten()?;
            // A post that names its dialect has not written programs of another dialect.
            if own.reading_dialect().is_some() { Some(own) } else { post(None).ok().flatten() }
        };
        let configured = if named.is_some() { None } else { configured() };
        Ok(Self { named, configured, dialect })
    }

    /// Whether a file has a usual extension of programs, or that of one of the posts.
    pub(super) fn is_program(&self, file: &Utf8Path) -> bool {
        files::is_program(file)
            || self.named.iter().chain(&self.configured).any(|post| post.has_extension(file))
    }

    /// Returns the file and the identity of each post, which determine the words in its programs.
    pub(super) fn identities(&self) -> Vec<(Option<&Utf8Path>, String)> {
        let posts = self.named.iter().chain(&self.configured);
        posts.map(|post| (post.file(), blake3::hash(&post.identity()).to_string())).collect()
    }

    /// Returns the dialect that the command line names, directly or through the post.
    pub(super) fn dialect(&self) -> Option<Dialect> {
        self.dialect.or(self.named.as_ref().and_then(PostProcessor::reading_dialect))
    }

    /// Returns the post that wrote a program of this dialect, if known: the post named by `--post`, or else the configured one. A configured
    /// definition that names no dialect is assumed if the dialect was guessed without a header.
    pub(super) fn writer_of(
        &self,
        dialect: Dialect,
        evidence: Option<EvidenceKind>,
    ) -> Option<&PostProcessor> {
        let is_without_header = evidence.is_some_and(|kind| kind != EvidenceKind::Header);
        let may_have_written = |post: &&PostProcessor| match post.reading_dialect() {
            Some(reader) => reader == dialect,
            None => is_without_header && dialect != Dialect::Native,
        };
        self.named.as_ref().or(self.configured.as_ref().filter(may_have_written))
    }

    /// Translates a text by means of the post definition that wrote it; `None` if the definition is unknown or its programs are read in a dialect.
    pub(super) fn translate(&self, text: &[u8], guess: Option<&Guess>) -> Option<DefinitionTranslation> {
        let dialect = guess.map(|guess| guess.dialect).or(self.dialect)?;
        let writer = self.writer_of(dialect, guess.map(|guess| guess.evidence.kind))?;
        Some(DefinitionTranslation { name: writer.name(), translated: writer.translate(text)? })
    }
}
