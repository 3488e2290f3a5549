//! Ignore rules from .gitignore and .ignore files in a library. Patterns have the same meaning as in Git. Files outside the library, such
//! as a user's global excludes, are not read: results must not depend on the user.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use camino::Utf8Path;
use ignore::Match;
use ignore::gitignore::{Gitignore, GitignoreBuilder};
use pathbuild_db::System;
use pathbuild_db::system::{FileKind, ReadError, join};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::limits::line_too_long;
use pathbuild_diagnostic::messages::files as messages;

/// The rules that apply in a directory: those of its own files, and those from above.
#[derive(Debug)]
pub(super) struct Rules {
    git: Gitignore,
    own: Gitignore,
    /// Whether this is the root of a repository: .gitignore files above it do not apply.
    is_repository: bool,
    above: Option<Arc<Self>>,
}

/// Limits the size of ignore files: compiled rules take about two hundred times as much memory.
#[derive(Debug)]
pub(super) struct Budget {
    /// Upper bound on a file's size in bytes.
    each: u64,
    /// Total size in bytes of the files that were read.
    read: AtomicU64,
}

/// Upper bound on the total size of all ignore files, as a multiple of the limit for one.
const ALL: u64 = 16;

impl Budget {
    /// `each` is the value of `[limits] ignore-file-size`.
    pub(super) fn new(each: u64) -> Self {
        Self { each, read: AtomicU64::new(0) }
    }

    /// PB005 if the total was exceeded by any thread; rules are missing then.
    pub(super) fn exceeded(&self, root: &Utf8Path) -> Option<Box<Diagnostic>> {
        let problem = || {
            Diagnostic::new(&messages::TOO_MANY_RULES)
                .quoting("directory", root.as_str())
                .with("limit", self.all())
                .quoting("key", "ignore-file-size")
        };
        self.is_exceeded().then(|| Box::new(problem()))
    }

    fn is_exceeded(&self) -> bool {
        self.read.load(Ordering::Relaxed) > self.all()
    }

    fn all(&self) -> u64 {
        self.each.saturating_mul(ALL)
    }

    fn take(&self, bytes: usize) {
        self.read.fetch_add(bytes as u64, Ordering::Relaxed);
    }
}

/// Upper bound on the length of a line in bytes. Longer lines are not patterns of names, and nested patterns would need a deep stack.
const LONGEST_LINE: usize = 4096;

/// Names of files that contain ignore rules.
pub(crate) const IGNORE_FILES: [&str; 2] = [".gitignore", ".ignore"];

/// Whether files of this name contain ignore rules.
pub(crate) fn is_ignore_file(name: &str) -> bool {
    IGNORE_FILES.contains(&name)
}

/// Whether an entry of this name changes the rules: an ignore file, or a repository if there are rules already.
pub(super) fn changes_rules(name: &str, are_some: bool) -> bool {
    is_ignore_file(name) || are_some && name == ".git"
}

impl Rules {
    /// Reads the ignore files of a directory, within a budget.
    ///
    /// # Errors
    /// Why a file cannot be read. Without it, it is unknown what is ignored.
    pub(super) fn read(
        system: &dyn System,
        directory: &Utf8Path,
        above: Option<Arc<Self>>,
        budget: &Budget,
    ) -> Result<Arc<Self>, Box<Diagnostic>> {
        let read = |name| patterns(system, directory, name, budget);
        let is_repository = system.kind(&directory.join(".git")) != FileKind::Missing;
        Ok(Arc::new(Self { git: read(".gitignore")?, own: read(".ignore")?, is_repository, above }))
    }

    /// Whether an entry is ignored. Rules in `.ignore` files take precedence over those in `.gitignore`, and rules of a directory over
    /// those from above. Hidden entries are ignored unless a rule includes them.
    pub(super) fn exclude(&self, path: &Utf8Path, is_directory: bool) -> bool {
        let by_own = self.levels().map(|level| level.own.matched(path, is_directory));
        let by_git = self.git_levels().map(|level| level.git.matched(path, is_directory));
        match by_own.chain(by_git).find(|found| !found.is_none()) {
            Some(Match::Ignore(_)) => true,
            Some(_) => false,
            None => path.file_name().is_some_and(|name| name.starts_with('.')),
        }
    }

    fn levels(&self) -> impl Iterator<Item = &Self> {
        std::iter::successors(Some(self), |level| level.above.as_deref())
    }

    /// The levels up to the root of the repository.
    fn git_levels(&self) -> impl Iterator<Item = &Self> {
        std::iter::successors(Some(self), |level| level.above.as_deref().filter(|_| !level.is_repository))
    }
}

fn patterns(
    system: &dyn System,
    directory: &Utf8Path,
    name: &str,
    budget: &Budget,
) -> Result<Gitignore, Box<Diagnostic>> {
    let file = join(directory, name);
    let limit = budget.each;
    let bytes = match system.read(&file, limit) {
        Ok(bytes) => bytes,
        Err(ReadError::Missing | ReadError::IsDirectory) => return Ok(Gitignore::empty()),
        Err(error) => return Err(Box::new(error.diagnostic(limit, "ignore-file-size").in_file(&file))),
    };
    budget.take(bytes.len());
    if budget.is_exceeded() {
        return Ok(Gitignore::empty());
    }
    let text = String::from_utf8_lossy(&bytes);
    let mut builder = GitignoreBuilder::new(directory);
    for (number, line) in (1..).zip(text.trim_start_matches('\u{feff}').lines()) {
        if line.len() > LONGEST_LINE {
            let problem = Diagnostic::new(&messages::UNREADABLE).with("reason", line_too_long(LONGEST_LINE));
            return Err(Box::new(problem.in_file(&file).at_line(number, None)));
        }
        // Like Git, skip lines that are not valid patterns.
        _ = builder.add_line(None, line);
    }
    Ok(builder.build().unwrap_or_else(|_| Gitignore::empty()))
}
