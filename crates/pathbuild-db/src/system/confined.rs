//! A system in which nothing leads out of one directory: for trees of strangers. (book: reference/configuration, `--untrusted`)

use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::{Instant, SystemTime};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_cache::Stamp;
use pathbuild_diagnostic::Value;
use pathbuild_diagnostic::reasons::LEADS_OUT;

use super::{Entry, FileKind, Listing, ReadError, System, Written, clean};

/// Another system, of which nothing is read or written through links that lead from inside a directory to outside. A name that lies
/// outside by itself is allowed: a tree can give none that is not held against [`Confined::holds`] first, so a person gave it.
#[derive(Clone, Debug)]
pub struct Confined {
    below: Arc<dyn System>,
    /// What relative names are relative to.
    working_directory: Utf8PathBuf,
    /// The directory as names spell it, and where it really is.
    root: Utf8PathBuf,
    real_root: Utf8PathBuf,
}

impl Confined {
    /// A system confined to a directory.
    pub fn new(below: Arc<dyn System>, root: &Utf8Path, working_directory: &Utf8Path) -> Self {
        let root = clean(&working_directory.join(root));
        let real_root = below.canonical(&root);
        Self { below, working_directory: working_directory.to_owned(), root, real_root }
    }

    /// The directory.
    pub fn root(&self) -> &Utf8Path {
        &self.root
    }

    /// Whether the directory really lies in or below one of these.
    pub fn lies_below(&self, roots: &[Utf8PathBuf]) -> bool {
        roots.iter().any(|root| self.real_root.starts_with(self.below.canonical(root)))
    }

    /// Whether a path lies in the directory, as it is spelt and where it leads.
    pub fn holds(&self, path: &Utf8Path) -> bool {
        self.spells_inside(path) && self.leads_inside(path)
    }

    fn spells_inside(&self, path: &Utf8Path) -> bool {
        let path = clean(&self.working_directory.join(path));
        path.starts_with(&self.root) || path.starts_with(&self.real_root)
    }

    /// Of what is not there yet, where it would be.
    fn leads_inside(&self, path: &Utf8Path) -> bool {
        let path = self.working_directory.join(path);
        let mut ancestors = path.ancestors();
        let there = ancestors.find(|path| self.below.kind(path) != FileKind::Missing);
        // What cannot be followed may lead anywhere.
        there.is_none_or(|there| there.canonicalize_utf8().is_ok_and(|it| it.starts_with(&self.real_root)))
    }

    /// Whether a path may be read or written: it does not lead from inside to outside.
    pub fn allows(&self, path: &Utf8Path) -> bool {
        !self.spells_inside(path) || self.leads_inside(path)
    }

    fn allowed(&self, path: &Utf8Path) -> Result<&dyn System, ReadError> {
        if self.allows(path) { Ok(&*self.below) } else { Err(ReadError::Other(Value::Word(&LEADS_OUT))) }
    }

    /// Writing replaces a link, so it is the directory that must not lead out.
    fn changeable(&self, path: &Utf8Path) -> Result<&dyn System, Value> {
        let directory = path.parent().unwrap_or(Utf8Path::new(""));
        if self.allows(directory) { Ok(&*self.below) } else { Err(Value::Word(&LEADS_OUT)) }
    }
}

impl System for Confined {
    fn read(&self, path: &Utf8Path, limit: u64) -> Result<Vec<u8>, ReadError> {
        self.allowed(path)?.read(path, limit)
    }

    fn read_into<'r>(
        &self,
        path: &Utf8Path,
        limit: u64,
        room: &'r mut Vec<u8>,
    ) -> Result<&'r [u8], ReadError> {
        self.allowed(path)?.read_into(path, limit, room)
    }

    fn read_stamped<'r>(
        &self,
        path: &Utf8Path,
        limit: u64,
        room: &'r mut Vec<u8>,
    ) -> Result<(&'r [u8], Stamp), ReadError> {
        self.allowed(path)?.read_stamped(path, limit, room)
    }

    fn head(&self, path: &Utf8Path, length: usize) -> Result<Vec<u8>, ReadError> {
        self.allowed(path)?.head(path, length)
    }

    fn tail(&self, path: &Utf8Path, length: usize) -> Result<Vec<u8>, ReadError> {
        self.allowed(path)?.tail(path, length)
    }

    fn modified(&self, path: &Utf8Path) -> Option<SystemTime> {
        self.allowed(path).ok()?.modified(path)
    }

    fn list(&self, directory: &Utf8Path) -> Result<Listing, ReadError> {
        self.allowed(directory)?.list(directory)
    }

    fn each_entry(
        &self,
        directory: &Utf8Path,
        take: &mut dyn FnMut(Entry<'_>) -> ControlFlow<()>,
    ) -> Result<(), ReadError> {
        self.allowed(directory)?.each_entry(directory, take)
    }

    fn kind(&self, path: &Utf8Path) -> FileKind {
        self.below.kind(path)
    }

    fn canonical(&self, path: &Utf8Path) -> Utf8PathBuf {
        self.below.canonical(path)
    }

    fn write(&self, path: &Utf8Path, bytes: &[u8]) -> Result<Written, Value> {
        self.changeable(path)?.write(path, bytes)
    }

    fn remove(&self, path: &Utf8Path) -> Result<(), Value> {
        self.changeable(path)?.remove(path)
    }

    fn now(&self) -> Option<Instant> {
        self.below.now()
    }
}
