//! Wrappers of a [`System`]: one is confined to given directories, so that links of untrusted repositories do not lead out of them; the other
//! resolves relative paths against a directory. (book: reference/configuration, `--untrusted`)

use std::io;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::Instant;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::Value;
use pathbuild_diagnostic::reasons::LEADS_OUT;

use super::{Entry, FileKind, FileLink, Listing, ReadError, Stamp, System, WriteOutcome, clean};

/// A wrapper that refuses to read or write through links that lead from inside one of the given directories to outside of it. A path that, as
/// written, lies outside of all of them is allowed: names from the repository itself are checked with [`ConfinedSystem::is_in_configured_root`]
/// first, so such a path was given by the user.
#[derive(Clone, Debug)]
pub struct ConfinedSystem {
    below: Arc<dyn System>,
    /// Directory that relative paths are resolved against.
    working_directory: Utf8PathBuf,
    /// The directories that links must not lead out of, starting with that of the configuration.
    roots: Vec<Root>,
}

/// A directory, as written and with links resolved.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Root {
    as_written: Utf8PathBuf,
    real: Utf8PathBuf,
}

impl ConfinedSystem {
    /// Creates a system that is confined to the directory `root`.
    pub fn new(below: Arc<dyn System>, root: &Utf8Path, working_directory: &Utf8Path) -> Self {
        let confined = Self { below, working_directory: working_directory.to_owned(), roots: Vec::new() };
        confined.with_root(root)
    }

    /// Adds a directory: links inside it must not lead out of it either.
    #[must_use]
    pub fn with_root(mut self, root: &Utf8Path) -> Self {
        let spelt = clean(&self.working_directory.join(root));
        let real = self.below.canonical(&spelt);
        let root = Root { as_written: spelt, real };
        if !self.roots.contains(&root) {
            self.roots.push(root);
        }
        self
    }

    /// Returns the directory of the configuration.
    pub fn root(&self) -> &Utf8Path {
        self.roots.first().map_or(Utf8Path::new(""), |root| &root.as_written)
    }

    /// Whether all the directories, with links resolved, lie in or below one of the `trusted` directories.
    pub fn lies_below(&self, trusted: &[Utf8PathBuf]) -> bool {
        let is_below =
            |root: &Root| trusted.iter().any(|trusted| root.real.starts_with(self.below.canonical(trusted)));
        self.roots.iter().all(is_below)
    }

    /// Whether a path lies in the directory of the configuration, both as written and with links resolved.
    pub fn is_in_configured_root(&self, path: &Utf8Path) -> bool {
        self.roots
            .first()
            .is_some_and(|root| self.contains_as_written(path, root) && self.leads_into(path, root))
    }

    /// Whether a path may lie in one of the directories: as written, with links resolved, or because its links cannot be resolved.
    pub fn may_hold(&self, path: &Utf8Path) -> bool {
        let contains_as_written = |root: &Root| self.contains_as_written(path, root);
        let leads = || match self.resolve_links(path) {
            Some(Ok(real)) => self.roots.iter().any(|root| real.starts_with(&root.real)),
            // A link that cannot be resolved may lead anywhere.
            Some(Err(_)) => true,
            None => false,
        };
        self.roots.iter().any(contains_as_written) || leads()
    }

    fn contains_as_written(&self, path: &Utf8Path, root: &Root) -> bool {
        let path = clean(&self.working_directory.join(path));
        path.starts_with(&root.as_written) || path.starts_with(&root.real)
    }

    fn leads_into(&self, path: &Utf8Path, root: &Root) -> bool {
        // A link that cannot be resolved may lead anywhere.
        self.resolve_links(path).is_none_or(|real| real.is_ok_and(|target| target.starts_with(&root.real)))
    }

    /// Returns the path with links resolved. If nothing exists at the path yet, resolves the nearest existing parent directory instead; `None` if no
    /// parent exists.
    fn resolve_links(&self, path: &Utf8Path) -> Option<io::Result<Utf8PathBuf>> {
        let path = self.working_directory.join(path);
        let mut ancestors = path.ancestors();
        let existing = ancestors.find(|path| self.below.kind(path) != FileKind::Missing)?;
        Some(existing.canonicalize_utf8())
    }

    /// Whether a path may be read or written: a path inside a directory must not lead out of it.
    pub fn allows(&self, path: &Utf8Path) -> bool {
        self.roots.iter().all(|root| !self.contains_as_written(path, root) || self.leads_into(path, root))
    }

    fn check_allowed(&self, path: &Utf8Path) -> Result<&dyn System, ReadError> {
        if self.allows(path) { Ok(&*self.below) } else { Err(ReadError::Other(Value::Prose(&LEADS_OUT))) }
    }

    /// Returns the wrapped system if the file at this path may be replaced or removed. Checks the parent directory, since writing replaces a link
    /// instead of following it.
    fn check_changeable(&self, path: &Utf8Path) -> Result<&dyn System, Value> {
        let directory = path.parent().unwrap_or(Utf8Path::new(""));
        if self.allows(directory) { Ok(&*self.below) } else { Err(Value::Prose(&LEADS_OUT)) }
    }
}

impl System for ConfinedSystem {
    fn read_into(&self, path: &Utf8Path, limit: u64, buffer: &mut Vec<u8>) -> Result<Stamp, ReadError> {
        self.check_allowed(path)?.read_into(path, limit, buffer)
    }

    fn read_head(&self, path: &Utf8Path, length: usize) -> Result<Vec<u8>, ReadError> {
        self.check_allowed(path)?.read_head(path, length)
    }

    fn read_tail(&self, path: &Utf8Path, length: usize) -> Result<Vec<u8>, ReadError> {
        self.check_allowed(path)?.read_tail(path, length)
    }

    fn list(&self, directory: &Utf8Path) -> Result<Listing, ReadError> {
        self.check_allowed(directory)?.list(directory)
    }

    fn each_entry(
        &self,
        directory: &Utf8Path,
        take: &mut dyn FnMut(Entry<'_>) -> ControlFlow<()>,
    ) -> Result<(), ReadError> {
        self.check_allowed(directory)?.each_entry(directory, take)
    }

    fn kind(&self, path: &Utf8Path) -> FileKind {
        self.below.kind(path)
    }

    fn canonical(&self, path: &Utf8Path) -> Utf8PathBuf {
        self.below.canonical(path)
    }

    fn link(&self, path: &Utf8Path) -> Option<FileLink> {
        self.check_allowed(path).ok()?.link(path)
    }

    fn write(&self, path: &Utf8Path, bytes: &[u8]) -> Result<WriteOutcome, Value> {
        self.check_changeable(path)?.write(path, bytes)
    }

    fn remove(&self, path: &Utf8Path) -> Result<(), Value> {
        self.check_changeable(path)?.remove(path)
    }

    fn now(&self) -> Option<Instant> {
        self.below.now()
    }
}

/// A wrapper that resolves relative paths against a fixed directory. The working directory of the process may change at any time, and a program that
/// embeds pathbuild chooses it for reasons of its own.
#[derive(Clone, Debug)]
pub struct FixedDirectorySystem {
    below: Arc<dyn System>,
    directory: Utf8PathBuf,
}

impl FixedDirectorySystem {
    /// Creates a system that resolves relative paths against `directory`, which is absolute.
    pub fn new(below: Arc<dyn System>, directory: Utf8PathBuf) -> Self {
        Self { below, directory }
    }

    fn resolve(&self, path: &Utf8Path) -> Utf8PathBuf {
        self.directory.join(path)
    }
}

impl System for FixedDirectorySystem {
    fn read_into(&self, path: &Utf8Path, limit: u64, buffer: &mut Vec<u8>) -> Result<Stamp, ReadError> {
        self.below.read_into(&self.resolve(path), limit, buffer)
    }

    fn read_head(&self, path: &Utf8Path, length: usize) -> Result<Vec<u8>, ReadError> {
        self.below.read_head(&self.resolve(path), length)
    }

    fn read_tail(&self, path: &Utf8Path, length: usize) -> Result<Vec<u8>, ReadError> {
        self.below.read_tail(&self.resolve(path), length)
    }

    fn list(&self, directory: &Utf8Path) -> Result<Listing, ReadError> {
        self.below.list(&self.resolve(directory))
    }

    fn each_entry(
        &self,
        directory: &Utf8Path,
        take: &mut dyn FnMut(Entry<'_>) -> ControlFlow<()>,
    ) -> Result<(), ReadError> {
        self.below.each_entry(&self.resolve(directory), take)
    }

    fn kind(&self, path: &Utf8Path) -> FileKind {
        self.below.kind(&self.resolve(path))
    }

    fn canonical(&self, path: &Utf8Path) -> Utf8PathBuf {
        self.below.canonical(&self.resolve(path))
    }

    fn link(&self, path: &Utf8Path) -> Option<FileLink> {
        self.below.link(&self.resolve(path))
    }

    fn write(&self, path: &Utf8Path, bytes: &[u8]) -> Result<WriteOutcome, Value> {
        self.below.write(&self.resolve(path), bytes)
    }

    fn remove(&self, path: &Utf8Path) -> Result<(), Value> {
        self.below.remove(&self.resolve(path))
    }

    fn now(&self) -> Option<Instant> {
        self.below.now()
    }
}
