//! Reads Git revisions for `check --changed-since` and `diff`. The repository may be untrusted: Git only reads objects, and runs nothing
//! that the repository configures (filters, hooks, monitors, transports).

use std::io::{self, BufRead, BufReader, Read, Write};
use std::process::{ChildStdout, Command, Stdio};
use std::thread;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::is_windows_device;
use pathbuild_diagnostic::Text;

use crate::config;
use crate::workspace::Workspace;

/// A Git repository with its working tree.
#[derive(Debug)]
pub struct Repository<'a> {
    workspace: &'a Workspace,
    /// Real path of the working tree's root.
    pub root: Utf8PathBuf,
}

/// An entry of a revision's tree.
#[derive(Debug)]
pub struct Entry {
    /// Kind of the file.
    pub kind: EntryKind,
    /// Object id of the blob, or of a submodule's commit.
    pub id: String,
    /// Path relative to the root, as stored by Git. It may be hostile: check [`is_plain`](Entry::is_plain) before writing a file.
    pub name: String,
}

/// Kind of an entry, from its Git mode.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EntryKind {
    /// A regular file.
    File,
    /// A symbolic link.
    Link,
    /// A submodule: another repository, of which only the commit is known.
    Submodule,
}

/// Callback that gets the index of a blob and its bytes, or its size if that exceeds the limit.
pub type TakeBlob<'t> = &'t mut dyn FnMut(usize, Result<&mut dyn Read, u64>) -> io::Result<()>;

/// Maximum length in bytes of a `.git` file, and of a line in which Git lists a file or introduces a blob. Linux cannot open paths that are longer.
const MAX_LINE_BYTES: u64 = 4096;

/// Maximum total size in bytes of the blobs in a single request, because a few Git objects can expand to any size.
const MAX_TOTAL_BLOB_BYTES: u64 = 4 << 30;

static TOO_MANY_FILES: Text = Text {
    en: "the revision has more than {} files; if that is intended, raise `library-entries` under [limits] in pathbuild.toml",
    de: "die Revision hat mehr als {} Dateien; ist das gewollt, `library-entries` unter [limits] in pathbuild.toml erhöhen",
};

static LONG_NAME: Text = Text {
    en: "the name of a file in the revision is too long",
    de: "der Name einer Datei in der Revision ist zu lang",
};

/// Maximum length in bytes of a symbolic link's target.
const MAX_LINK_BYTES: u64 = 4096;

/// Environment variables that are removed because they could redirect Git to another repository, for example if a Git hook runs pathbuild.
const REMOVED_VARIABLES: [&str; 5] =
    ["GIT_DIR", "GIT_WORK_TREE", "GIT_COMMON_DIR", "GIT_INDEX_FILE", "GIT_PREFIX"];

/// Environment variables that prevent a partial clone from fetching missing objects with configured commands. Older versions of Git do not know the
/// first one.
const NO_FETCH_VARIABLES: [(&str, &str); 3] =
    [("GIT_NO_LAZY_FETCH", "1"), ("GIT_ALLOW_PROTOCOL", "none"), ("GIT_TERMINAL_PROMPT", "0")];

const OPTIONS: [&str; 10] = [
    "--no-pager",
    "--no-optional-locks",
    "-c",
    "core.fsmonitor=false",
    "-c",
    if cfg!(windows) { "core.hooksPath=NUL" } else { "core.hooksPath=/dev/null" },
    "-c",
    "protocol.allow=never",
    // Do not discover bare repositories, because files of a tree can look like one.
    "-c",
    "safe.bareRepository=explicit",
];

impl<'a> Repository<'a> {
    /// Returns the repository that contains a file or directory: the nearest directory at or above it with a `.git`. If there is none, Git itself
    /// will report the error.
    ///
    /// # Errors
    /// If the repository is untrusted and its `.git` refers to a directory outside of it.
    pub fn of(workspace: &'a Workspace, place: &Utf8Path) -> Result<Self, String> {
        let real = |place: &Utf8Path| workspace.system.canonical(&workspace.working_directory.join(place));
        let place = real(place);
        let directory = config::repository(&*workspace.system, &place);
        let root = directory.map_or_else(|| real(Utf8Path::new("")), Utf8Path::to_owned);
        let repository = Self { workspace, root };
        if workspace.settings.confined.is_some() && repository.leads_out() {
            return Err(workspace.phrase(
                "the .git in {} leads out of the untrusted repository",
                "das .git in {} führt aus dem nicht vertrauenswürdigen Repository hinaus",
                repository.root.as_str(),
            ));
        }
        Ok(repository)
    }

    /// Whether `.git` is a symbolic link out of the working tree, or refers to a repository elsewhere that does not list this tree. The repository of
    /// a tree made by `git worktree` lists the tree.
    fn leads_out(&self) -> bool {
        let system = &self.workspace.system;
        let git = self.root.join(".git");
        let text = |file: &Utf8Path| {
            let bytes = system.read(file, MAX_LINE_BYTES).ok()?;
            Some(String::from_utf8_lossy(&bytes).trim().to_owned())
        };
        let place = |text: &str| system.canonical(&self.root.join(text));
        if !system.canonical(&git).starts_with(&self.root) {
            return true;
        }
        let Some(link) = text(&git) else { return false };
        let directory = place(link.trim_start_matches("gitdir:").trim_start());
        let is_known = || text(&directory.join("gitdir")).is_some_and(|back| place(&back) == git);
        !directory.starts_with(&self.root) && !is_known()
    }

    /// Returns the object id of a revision's tree.
    ///
    /// # Errors
    /// Git's message if there is no such revision.
    pub fn tree(&self, revision: &str) -> Result<String, String> {
        let id = self.run(&["rev-parse", "--verify", "--end-of-options", &format!("{revision}^{{tree}}")])?;
        Ok(String::from_utf8_lossy(&id).trim().to_owned())
    }

    /// Whether the revision is the current branch, and that branch has no commits yet.
    pub fn is_unborn(&self, revision: &str) -> bool {
        let refs = |name: &[u8]| {
            let name = String::from_utf8_lossy(name).trim().to_owned();
            self.run(&["for-each-ref", "--count=1", "--format=%(refname)", &name]).ok()
        };
        let branch = || self.run(&["symbolic-ref", "--quiet", "HEAD"]).ok();
        matches!(revision, "HEAD" | "@")
            && branch().and_then(|name| refs(&name)).is_some_and(|output| output.is_empty())
    }

    /// Returns all entries of a tree and its subtrees.
    ///
    /// # Errors
    /// If there are more entries than the limit permits (a few objects can describe any number), or if Git cannot read the tree.
    pub fn entries(&self, tree: &str) -> Result<Vec<Entry>, String> {
        let most = self.workspace.settings.limits.library_entries.value;
        let arguments = ["ls-tree", "-r", "-z", "--full-tree", tree];
        let (entries, is_whole) =
            self.run_with_input(&arguments, "", |mut answers| entries(&mut answers, most))?;
        let entries = entries.map_err(|word| self.workspace.phrase(word.en, word.de, &most.to_string()))?;
        if is_whole { Ok(entries) } else { Err(self.failure_message("")) }
    }

    /// Passes the contents of blobs to `take`, in order. For a blob larger than `most` bytes, passes only its size.
    ///
    /// # Errors
    /// If a blob is missing, the total size is too large, or `take` fails.
    pub fn each_blob(&self, ids: &[&str], most: u64, take: TakeBlob<'_>) -> Result<(), String> {
        let lines = |ids: &mut dyn Iterator<Item = &str>| ids.flat_map(|id| [id, "\n"]).collect::<String>();
        let (sizes, _) = self.run_with_input(
            &["cat-file", "--batch-check"],
            &lines(&mut ids.iter().copied()),
            |mut answers| ids.iter().map(|_| read_size(&mut answers)).collect::<io::Result<Vec<u64>>>(),
        )?;
        if sizes.iter().filter(|size| **size <= most).sum::<u64>() > MAX_TOTAL_BLOB_BYTES {
            let (en, de) = ("the revision has more than 4 GiB", "die Revision hat mehr als 4 GiB");
            return Err(self.workspace.choose(en, de).to_owned());
        }
        let mut small = ids.iter().zip(&sizes).filter(|(_, size)| **size <= most).map(|(id, _)| *id);
        self.run_with_input(&["cat-file", "--batch"], &lines(&mut small), |mut answers| {
            sizes.iter().enumerate().try_for_each(|(index, size)| {
                if *size > most {
                    take(index, Err(*size))
                } else {
                    read_blob(&mut answers, &mut |bytes| take(index, Ok(bytes)))
                }
            })
        })
        .map(|_| ())
    }

    /// Returns the targets of symbolic links, which are given by the ids of their blobs; `None` for a target that is too long or not
    /// UTF-8.
    ///
    /// # Errors
    /// If a blob is missing.
    pub fn targets(&self, ids: &[&str]) -> Result<Vec<Option<String>>, String> {
        let mut targets = Vec::with_capacity(ids.len());
        self.each_blob(ids, MAX_LINK_BYTES, &mut |_, bytes| {
            let mut target = String::new();
            let is_read = bytes.is_ok_and(|bytes| bytes.read_to_string(&mut target).is_ok());
            targets.push(is_read.then_some(target));
            Ok(())
        })?;
        Ok(targets)
    }

    /// Returns the blob ids that the current contents of files would have. If a file cannot be read, the list ends before it. The files
    /// must be regular files without line breaks in their names.
    pub fn ids(&self, files: &[&Utf8Path]) -> Vec<String> {
        let lines: String = files.iter().flat_map(|file| [without_verbatim_prefix(file), "\n"]).collect();
        let arguments = ["hash-object", "--no-filters", "--stdin-paths"];
        let mut ids = Vec::new();
        // Errors are ignored, because callers treat files without an id as changed.
        _ = self.run_with_input(&arguments, &lines, |answers| {
            answers.lines().try_for_each(|line| line.map(|line| ids.push(line)))
        });
        ids
    }

    /// Returns advice for the user if the revision is missing because the clone is shallow.
    pub fn shallow_clone_advice(&self, revision: &str) -> Option<String> {
        let is_shallow = self.run(&["rev-parse", "--is-shallow-repository"]).ok()?;
        let is_there = self.run(&["cat-file", "-e", &format!("{revision}^{{commit}}")]).is_ok();
        (is_shallow.trim_ascii() == b"true" && !is_there).then(|| {
            self.workspace.phrase(
                "this clone is too shallow: it does not reach {}; fetch more (git fetch --unshallow, `fetch-depth: 0` of \
                 actions/checkout, GIT_DEPTH: \"0\" of GitLab)",
                "dieser Klon reicht nicht bis {}; mehr holen (git fetch --unshallow, `fetch-depth: 0` von \
                 actions/checkout, GIT_DEPTH: \"0\" von GitLab)",
                revision,
            )
        })
    }

    fn run(&self, arguments: &[&str]) -> Result<Vec<u8>, String> {
        let output = self.command(arguments).output().map_err(|error| self.git_not_run_message(&error))?;
        if output.status.success() {
            return Ok(output.stdout);
        }
        Err(self.failure_message(&String::from_utf8_lossy(&output.stderr)))
    }

    /// Returns the first line of Git's message, and the command by which Git accepts a repository of another user, if the message names it.
    fn failure_message(&self, message: &str) -> String {
        let nothing = self.workspace.choose("it failed", "fehlgeschlagen");
        let first = message.lines().next().unwrap_or(nothing);
        match message.lines().find(|line| line.contains("git config") && line.contains("safe.directory")) {
            Some(command) => format!("git: {first}; {}", command.trim()),
            None => format!("git: {first}"),
        }
    }

    /// Runs Git with input, and passes its output to `take`. Returns the result of `take` and whether Git succeeded.
    fn run_with_input<R>(
        &self,
        arguments: &[&str],
        lines: &str,
        take: impl FnOnce(BufReader<ChildStdout>) -> io::Result<R>,
    ) -> Result<(R, bool), String> {
        let mut command = self.command(arguments);
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::null());
        let mut child = command.spawn().map_err(|error| self.git_not_run_message(&error))?;
        let (stdin, stdout) = (child.stdin.take(), child.stdout.take());
        let answer = thread::scope(|scope| {
            // Git writes answers while it reads, so writing and reading must happen concurrently to avoid a deadlock.
            scope.spawn(move || stdin.map(|mut stdin| stdin.write_all(lines.as_bytes())));
            stdout.map(|stdout| take(BufReader::new(stdout)))
        });
        let has_succeeded = child.wait().is_ok_and(|status| status.success());
        answer
            .unwrap_or_else(|| Err(io::ErrorKind::BrokenPipe.into()))
            .map(|answer| (answer, has_succeeded))
            .map_err(|error| format!("git: {error}"))
    }

    fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new("git");
        if !self.root.as_str().is_empty() {
            command.current_dir(without_verbatim_prefix(&self.root));
        }
        for name in REMOVED_VARIABLES {
            command.env_remove(name);
        }
        // Git must not search for a repository above the root.
        let above = self.root.parent().map(without_verbatim_prefix).unwrap_or_default();
        command.env("GIT_CEILING_DIRECTORIES", above).envs(NO_FETCH_VARIABLES);
        command.args(OPTIONS).args(arguments).stdin(Stdio::null());
        command
    }

    fn git_not_run_message(&self, error: &io::Error) -> String {
        let (en, de) = ("cannot run git: {}", "git lässt sich nicht starten: {}");
        self.workspace.phrase(en, de, &error.to_string())
    }
}

impl Entry {
    /// Parses a line of the output of `ls-tree`.
    fn read(line: &str) -> Option<Self> {
        let (facts, name) = line.split_once('\t')?;
        let mut facts = facts.split(' ');
        let kind = match facts.next()? {
            "120000" => EntryKind::Link,
            "160000" => EntryKind::Submodule,
            _ => EntryKind::File,
        };
        Some(Self { kind, id: facts.nth(1)?.to_owned(), name: name.to_owned() })
    }

    /// Whether the name is a relative path that stays below the root on this system, and outside `.git`. A name that is not UTF-8 does not count as
    /// one.
    pub fn is_plain(&self) -> bool {
        let is_foreign = |part: &str| cfg!(windows) && is_other_on_windows(part);
        let is_special = |part: &str| matches!(part, "" | "." | "..") || part.eq_ignore_ascii_case(".git");
        !self.name.contains('\u{fffd}')
            && !self.name.split('/').any(|part| is_special(part) || is_foreign(part))
    }
}

/// Whether Windows would open something else under this name: it has two separators, drops final dots and blanks, has a short name for `.git`,
/// and opens devices.
fn is_other_on_windows(part: &str) -> bool {
    let is_short_name =
        part.split('.').next().is_some_and(|stem| stem.trim_end().eq_ignore_ascii_case("GIT~1"));
    part.contains(['\\', ':']) || part.ends_with(['.', ' ']) || is_short_name || is_windows_device(part)
}

/// Refuses the name of a revision that Git would take for an option.
///
/// # Errors
/// If the name begins with a hyphen.
pub fn revision<'a>(workspace: &Workspace, name: &'a str) -> Result<&'a str, String> {
    if name.starts_with('-') {
        return Err(workspace.phrase("{} is not a revision", "{} ist keine Revision", &format!("{name:?}")));
    }
    Ok(name)
}

/// Parses the output of `ls-tree -z`. Stops with a reason if a limit is exceeded.
fn entries(answers: &mut impl BufRead, most: u64) -> io::Result<Result<Vec<Entry>, &'static Text>> {
    let mut entries = Vec::new();
    let mut line = Vec::new();
    while answers.by_ref().take(MAX_LINE_BYTES).read_until(0, &mut line)? > 0 {
        if line.pop() != Some(0) {
            return Ok(Err(&LONG_NAME));
        }
        if entries.len() as u64 == most {
            return Ok(Err(&TOO_MANY_FILES));
        }
        entries.extend(Entry::read(&String::from_utf8_lossy(&line)));
        line.clear();
    }
    Ok(Ok(entries))
}

/// Reads the header line of a blob in the output of `cat-file`. Returns the size in bytes.
fn read_size(answers: &mut impl BufRead) -> io::Result<u64> {
    let mut head = String::new();
    answers.by_ref().take(MAX_LINE_BYTES).read_line(&mut head)?;
    let size = head.trim_end().split_once(" blob ").and_then(|(_, size)| size.parse().ok());
    size.ok_or_else(|| io::Error::other(head.trim_end()))
}

/// Reads one blob of `cat-file --batch`: a header line that ends in the size, the bytes, and a line break.
fn read_blob(
    answers: &mut BufReader<ChildStdout>,
    take: &mut dyn FnMut(&mut dyn Read) -> io::Result<()>,
) -> io::Result<()> {
    let size = read_size(answers)?;
    let mut bytes = answers.by_ref().take(size);
    take(&mut bytes)?;
    io::copy(&mut bytes, &mut io::sink())?;
    answers.read_exact(&mut [0])
}

/// Removes the prefix of long Windows paths, which Git does not understand.
fn without_verbatim_prefix(path: &Utf8Path) -> &str {
    path.as_str().strip_prefix(r"\\?\").unwrap_or(path.as_str())
}

#[cfg(test)]
mod tests {
    use super::is_other_on_windows;

    #[test]
    fn names_that_windows_gives_another_meaning() {
        for name in
            ["a\\b", "c:", ".git.", ".. ", "GIT~1", "git~1", "nul.dxf", "NUL", "aux .dxf", "com1.dxf", "LPT9"]
        {
            assert!(is_other_on_windows(name), "{name}");
        }
        for name in ["8001.1P.dxf", "a b.dxf", "null.dxf", "com.dxf", "com10.dxf", "console", "git~2"] {
            assert!(!is_other_on_windows(name), "{name}");
        }
    }
}
