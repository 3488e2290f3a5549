//! Checks out the drawings of a Git revision into a temporary directory.
#![expect(clippy::disallowed_methods, reason = "the files are in our own temporary directory")]

use std::collections::BTreeSet;
use std::fs::{self, DirEntry, File, TryLockError};
use std::io::{self, Read};
use std::path::Path;

use camino::{Utf8Component, Utf8Path, Utf8PathBuf};
use pathbuild_db::system::is_drawing;
use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::configuration;
use pathbuild_workspace::files::FILE_NAME;
use pathbuild_workspace::git::{self, Entry, EntryKind, Repository};
use pathbuild_workspace::post_processor::{PostArguments, PostProcessor};
use pathbuild_workspace::relative;
use tempfile::TempDir;

use crate::context::Context;

/// A checked-out revision; its files are removed when it is dropped.
pub(super) struct Revision {
    /// Name of the revision as given.
    pub(super) name: String,
    /// Directory that corresponds to the working directory in the revision.
    pub(super) root: Utf8PathBuf,
    /// The submodules: their directories in the checkout, which are empty, and in the working tree.
    pub(super) submodules: Vec<[Utf8PathBuf; 2]>,
    /// Root directories of the checkout and of the repository.
    roots: [Utf8PathBuf; 2],
    /// An empty directory, for a drawing that the revision lacks.
    empty: Utf8PathBuf,
    _files: TemporaryDirectory,
}

/// A temporary directory with a locked file. A killed run loses its lock, so that the next run recognises and removes the directory.
struct TemporaryDirectory {
    directory: TempDir,
    _lock: File,
}

/// Beginning of the names of temporary directories.
const PREFIX: &str = "pathbuild-revision-";

/// Name of the locked file in a temporary directory.
const LOCK: &str = "lock";

impl TemporaryDirectory {
    /// Creates a directory, and removes those that killed runs left behind.
    fn new() -> io::Result<Self> {
        remove_leftovers(&std::env::temp_dir());
        loop {
            let directory = tempfile::Builder::new().prefix(PREFIX).tempdir()?;
            let lock = File::create_new(directory.path().join(LOCK))?;
            match lock.try_lock() {
                // On file systems without locks, no directory is ever taken for a leftover.
                Ok(()) | Err(TryLockError::Error(_)) if directory.path().join(LOCK).exists() => {
                    return Ok(Self { directory, _lock: lock });
                }
                // Another run mistook the directory for a leftover before it was locked.
                _ => {}
            }
        }
    }
}

/// Removes the directories of killed runs. Best effort: another user's directories cannot be removed.
fn remove_leftovers(temporary: &Path) {
    let entries = fs::read_dir(temporary).into_iter().flatten().flatten();
    let is_ours = |entry: &DirEntry| entry.file_name().to_string_lossy().starts_with(PREFIX);
    for directory in entries.filter(is_ours).map(|entry| entry.path()) {
        let lock = directory.join(LOCK);
        // Follow no links, and open no special file, which might block.
        let is_plain = |path: &Path, is_kind: fn(&fs::Metadata) -> bool| {
            fs::symlink_metadata(path).is_ok_and(|data| is_kind(&data))
        };
        if is_plain(&directory, fs::Metadata::is_dir)
            && is_plain(&lock, fs::Metadata::is_file)
            && let Ok(file) = File::open(&lock)
            && file.try_lock().is_ok()
        {
            _ = fs::remove_dir_all(&directory);
        }
    }
}

/// Checks out a revision of the working directory's repository. Touches neither the working tree nor the index.
///
/// # Errors
/// A message if there is no such revision, or if its files cannot be read or written.
pub(super) fn check_out(context: &Context, name: &str) -> Result<Revision, String> {
    let name = git::revision(context, name)?;
    let repository = Repository::of(context, Utf8Path::new(""))?;
    let tree = repository.tree(name).map_err(|reason| {
        let neither = context.phrase(
            "{} is neither a directory nor a program nor a revision; to compare a path, name its drawing (.dxf)",
            "{} ist weder ein Verzeichnis noch ein Programm noch eine Revision; für einen Pfad dessen Zeichnung (.dxf) nennen",
            &format!("{name:?}"),
        );
        repository.shallow_clone_advice(name).unwrap_or_else(|| format!("{neither} ({reason})"))
    })?;
    let entries = repository.entries(&tree)?;
    let files = TemporaryDirectory::new().map_err(|error| error.to_string())?;
    let place = temporary_directory_path(context, &files.directory)?;
    let whole = place.join("tree");
    // Mark the directory as the root of a repository, so that ignore files apply and no link points out of it.
    fs::create_dir_all(whole.join(".git")).map_err(|error| error.to_string())?;
    // An empty configuration ends the search for one, because the directories above are unrelated.
    File::create_new(place.join(FILE_NAME)).map_err(|error| error.to_string())?;
    let largest = context.settings.limits.file_size.value.max(MIN_SIZE_LIMIT);
    let post_files = post_files(context);
    let mut checkout =
        Checkout { repository: &repository, whole: &whole, largest, post_files, left_out: Vec::new() };
    checkout.write_all(&entries)?;
    report_left_out(context, &checkout.left_out);
    let directory = context.system.canonical(&context.working_directory);
    let below = directory.strip_prefix(&repository.root).unwrap_or(Utf8Path::new(""));
    let submodules = entries.iter().filter(|entry| entry.kind == EntryKind::Submodule && entry.is_plain());
    let submodules =
        submodules.map(|entry| [whole.join(&entry.name), repository.root.join(&entry.name)]).collect();
    let root = if below.as_str().is_empty() { whole.clone() } else { whole.join(below) };
    let empty = place.join("empty");
    fs::create_dir_all(&empty).map_err(|error| error.to_string())?;
    // The revision may lack the working directory: then it has no drawings.
    fs::create_dir_all(&root).map_err(|error| error.to_string())?;
    let roots = [whole, repository.root.clone()];
    Ok(Revision { name: name.to_owned(), root, submodules, roots, empty, _files: files })
}

/// Returns the names of the files that the configured post-processor inserts into programs, without directories. In the revision, they may lie in other
/// directories.
fn post_files(context: &Context) -> BTreeSet<String> {
    let post_processor = PostProcessor::for_run(context, None, PostArguments::default()).ok().flatten();
    let sources = post_processor.map(|post_processor| post_processor.sources()).unwrap_or_default();
    sources.iter().filter_map(|file| file.file_name()).map(str::to_owned).collect()
}

impl Revision {
    /// Returns the place of a drawing in the checkout; an empty directory if the revision lacks it; `None` if the drawing is not in the repository.
    pub(super) fn place_of(&self, context: &Context, drawing: &Utf8Path) -> Option<Utf8PathBuf> {
        let [checkout, repository] = &self.roots;
        let drawing = context.working_directory.join(drawing);
        let directory = context.system.canonical(drawing.parent()?);
        let place = checkout.join(directory.strip_prefix(repository).ok()?).join(drawing.file_name()?);
        Some(if place.is_file() { place } else { self.empty.clone() })
    }

    /// Renames the revision's files and directories in diagnostics to `REVISION:NAME`, as Git does, including those in the temporary directory that
    /// lie outside of the checkout.
    pub(super) fn name_files(&self, context: &Context, problems: &mut [Diagnostic]) {
        let [checkout, _] = &self.roots;
        let temporary = checkout.parent().unwrap_or(checkout);
        let renamed = |name: &str| {
            let place = context.working_directory.join(name);
            place.starts_with(temporary).then(|| format!("{}:{}", self.name, relative(&place, &self.root)))
        };
        for problem in problems {
            let is_ours = problem.quoted("directory").and_then(renamed).is_some();
            if *problem.message == configuration::NO_DIRECTORY && is_ours {
                problem.message = &configuration::NO_DIRECTORY_IN_REVISION;
            }
            problem.rename_files(renamed);
        }
    }
}

fn temporary_directory_path(context: &Context, files: &TempDir) -> Result<Utf8PathBuf, String> {
    let place = Utf8Path::from_path(files.path()).ok_or_else(|| {
        let reason = context.choose(
            "the directory for temporary files has no UTF-8 name",
            "der Name des Verzeichnisses für temporäre Dateien ist kein UTF-8",
        );
        reason.to_owned()
    })?;
    place.canonicalize_utf8().map_err(|error| error.to_string())
}

fn report_left_out(context: &Context, left_out: &[String]) {
    if let Some(first) = left_out.first() {
        let reason = context.choose(
            "drawings left out because their names or links lead out of the tree",
            "Zeichnungen weggelassen, weil ihre Namen oder Links aus dem Verzeichnisbaum hinausführen",
        );
        let more = if left_out.len() > 1 { ", ..." } else { "" };
        context.printer.status(format!("{reason}: {} ({first}{more})", left_out.len()));
    }
}

/// Size in bytes up to which files are written even if the current limit is lower, because the revision's configuration may permit more.
const MIN_SIZE_LIMIT: u64 = 1 << 30;

/// A checkout in progress, which writes the files of a tree into a directory.
struct Checkout<'a> {
    repository: &'a Repository<'a>,
    whole: &'a Utf8Path,
    /// Maximum size of a file in bytes. A larger file is created with its length but without its content, so that reading it fails with the
    /// error that it is too large.
    largest: u64,
    /// Names of the files that the post-processor inserts, without directories.
    post_files: BTreeSet<String>,
    /// Names of drawings that could not be written.
    left_out: Vec<String>,
}

impl Checkout<'_> {
    /// Writes all needed files. Links are written last, so that no file is written through a link.
    fn write_all(&mut self, entries: &[Entry]) -> Result<(), String> {
        let (plain, hostile): (Vec<&Entry>, Vec<&Entry>) = entries.iter().partition(|entry| entry.is_plain());
        for entry in hostile {
            self.leave_out(entry);
        }
        self.directories(&plain).map_err(|error| error.to_string())?;
        let of_kind = |kind| plain.iter().copied().filter(move |entry| entry.kind == kind);
        let links: Vec<&Entry> = of_kind(EntryKind::Link).collect();
        let targets = self.repository.targets(&ids(&links))?;
        let links: Vec<(&Entry, Option<String>)> = links.into_iter().zip(targets).collect();
        // If a drawing is a link to a file of another kind, all files are checked out, since any of them may be the target.
        let leads_elsewhere = |(entry, target): &(&Entry, Option<String>)| {
            is_drawing(Utf8Path::new(&entry.name)) && !target.as_deref().is_some_and(is_needed)
        };
        let is_all_needed = links.iter().any(leads_elsewhere);
        let is_of_post = |entry: &Entry| {
            Utf8Path::new(&entry.name).file_name().is_some_and(|name| self.post_files.contains(name))
        };
        let files: Vec<&Entry> = of_kind(EntryKind::File)
            .filter(|entry| is_all_needed || is_needed(&entry.name) || is_of_post(entry))
            .collect();
        self.files(&files)?;
        for (entry, target) in &links {
            self.link(entry, target.as_deref());
        }
        Ok(())
    }

    /// Creates all directories, even those without needed files, because a configuration may refer to them.
    fn directories(&self, entries: &[&Entry]) -> io::Result<()> {
        let directory = |entry: &&Entry| match entry.kind {
            EntryKind::Submodule => Some(Utf8PathBuf::from(&entry.name)),
            EntryKind::File | EntryKind::Link => Utf8Path::new(&entry.name).parent().map(Utf8Path::to_owned),
        };
        let directories: BTreeSet<Utf8PathBuf> = entries.iter().filter_map(directory).collect();
        directories.iter().try_for_each(|directory| fs::create_dir_all(self.whole.join(directory)))
    }

    fn files(&mut self, entries: &[&Entry]) -> Result<(), String> {
        let (repository, largest) = (self.repository, self.largest);
        repository.each_blob(&ids(entries), largest, &mut |index, bytes| self.file(entries[index], bytes))
    }

    fn file(&mut self, entry: &Entry, bytes: Result<&mut dyn Read, u64>) -> io::Result<()> {
        match File::create_new(self.whole.join(&entry.name)) {
            Ok(mut file) => match bytes {
                Ok(bytes) => io::copy(bytes, &mut file).map(|_| ()),
                Err(size) => file.set_len(size),
            },
            // On systems that ignore case, two names may refer to the same file.
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {
                self.leave_out(entry);
                Ok(())
            }
            Err(error) => Err(error),
        }
    }

    fn link(&mut self, entry: &Entry, target: Option<&str>) {
        let link = self.whole.join(&entry.name);
        let is_made = |target| stays_inside(&entry.name, target) && link_to(target, &link).is_ok();
        if !target.is_some_and(is_made) {
            self.leave_out(entry);
        }
    }

    fn leave_out(&mut self, entry: &Entry) {
        if is_drawing(Utf8Path::new(&entry.name)) {
            self.left_out.push(entry.name.clone());
        }
    }
}

fn ids<'e>(entries: &[&'e Entry]) -> Vec<&'e str> {
    entries.iter().map(|entry| &*entry.id).collect()
}

#[cfg(unix)]
fn link_to(target: &str, link: &Utf8Path) -> io::Result<()> {
    std::os::unix::fs::symlink(target, link)
}

#[cfg(not(unix))]
fn link_to(_: &str, _: &Utf8Path) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}

/// Whether the name of a file alone shows that the file is needed: a drawing, a configuration or definition of a post-processor, or an ignore file.
/// Most other files, of which a large repository may contain many, are not checked out.
fn is_needed(name: &str) -> bool {
    let name = Utf8Path::new(name);
    let is_text =
        |extension: &str| ["cbpp", "toml"].iter().any(|known| extension.eq_ignore_ascii_case(known));
    is_drawing(name)
        || name.extension().is_some_and(is_text)
        || matches!(name.file_name(), Some(".gitignore" | ".ignore"))
}

/// Whether a link points to something below the root, even if its target passes through other links. The target must first go up, through real
/// directories, and then only down.
fn stays_inside(link: &str, target: &str) -> bool {
    let depth = Utf8Path::new(link).components().count() - 1;
    let mut parts =
        Utf8Path::new(target).components().filter(|part| *part != Utf8Component::CurDir).peekable();
    let mut up = 0;
    while parts.next_if_eq(&Utf8Component::ParentDir).is_some() {
        up += 1;
    }
    up <= depth && parts.all(|part| matches!(part, Utf8Component::Normal(_)))
}
