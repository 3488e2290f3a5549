//! What .gitignore and .ignore files in a library say does not count. Patterns mean what they mean to Git; files outside the library,
//! such as a person's global ones, are not asked: results must not depend on who asks.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use camino::Utf8Path;
use ignore::Match;
use ignore::gitignore::{Gitignore, GitignoreBuilder};
use pathbuild_db::System;
use pathbuild_db::system::{FileKind, ReadError, join};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::files as messages;

use crate::files::unreadable_by;

/// The rules that hold in a directory: those of its own files, and those from above.
#[derive(Debug)]
pub(super) struct Rules {
    git: Gitignore,
    own: Gitignore,
    /// Whether a repository begins here: .gitignore files above it do not count.
    is_repository: bool,
    above: Option<Arc<Self>>,
}

/// How much may be read of such files: what is kept of them takes two hundred times as much memory.
#[derive(Debug)]
pub(super) struct Budget {
    /// Bytes of a file.
    each: u64,
    /// Bytes of all of them that were read so far.
    read: AtomicU64,
}

/// All of them may have so many times the bytes of one.
const ALL: u64 = 16;

impl Budget {
    /// `each`: `[limits] ignore-file-size`.
    pub(super) fn new(each: u64) -> Self {
        Self { each, read: AtomicU64::new(0) }
    }

    /// PB005 where there was too much, whoever noticed it: then rules are missing.
    pub(super) fn exceeded(&self, root: &Utf8Path) -> Option<Box<Diagnostic>> {
        let problem = || {
            Diagnostic::new(&messages::TOO_MANY_RULES)
                .with("directory", root.as_str())
                .with("limit", self.all())
                .with("key", "ignore-file-size")
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

/// Bytes of a line of such a file. Longer ones are no names, and patterns in each other would need a stack of that depth.
const LONGEST_LINE: usize = 4096;

/// Whether other rules hold in a directory in which this name is: that of a file with rules, or of a repository where there are some already.
pub(super) fn changes_rules(name: &str, are_some: bool) -> bool {
    matches!(name, ".gitignore" | ".ignore") || are_some && name == ".git"
}

impl Rules {
    /// Reads the files of a directory, within a budget.
    ///
    /// # Errors
    /// Why one cannot be read: then nobody knows what counts.
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

    /// Whether something does not count. Rules of `.ignore` files come before those of `.gitignore`, rules of a directory before those from
    /// above. Hidden names do not count unless a rule says that they do.
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

    /// Up to the directory in which the repository begins.
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
        Err(error) => return Err(Box::new(unreadable_by(&file, &error, limit, "ignore-file-size"))),
    };
    budget.take(bytes.len());
    if budget.is_exceeded() {
        return Ok(Gitignore::empty());
    }
    let text = String::from_utf8_lossy(&bytes);
    let mut builder = GitignoreBuilder::new(directory);
    for (number, line) in (1..).zip(text.trim_start_matches('\u{feff}').lines()) {
        if line.len() > LONGEST_LINE {
            let reason = format!("a line is longer than {LONGEST_LINE} bytes");
            let problem = Diagnostic::new(&messages::UNREADABLE).with("reason", reason);
            return Err(Box::new(problem.in_file(&file).at_line(number, None)));
        }
        // Git passes over what is no pattern, too.
        _ = builder.add_line(None, line);
    }
    Ok(builder.build().unwrap_or_else(|_| Gitignore::empty()))
}
