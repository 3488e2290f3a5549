//! Searches directories recursively for drawings, and obeys the .gitignore and .ignore files in them, and in the directories above them up to that of
//! the configuration. Patterns have the same meaning as in Git.
//! Files outside the library, such as a user's global excludes, are not read: results must not depend on the user. (book: howto/large-libraries)

use std::borrow::Cow;
use std::cmp;
use std::collections::HashSet;
use std::ops::ControlFlow;
use std::path::is_separator;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use camino::{Utf8Path, Utf8PathBuf};
use ignore::Match;
use ignore::gitignore::{Gitignore, GitignoreBuilder};
use pathbuild_cache::{Listing, Listings};
use pathbuild_db::system::{
    Entry, EntryKind, FileKind, Names, ReadError, clean, is_drawing, is_hidden, join, or_current_directory,
};
use pathbuild_db::{Db, System, catch_bugs, listing_error, unlistable_error};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::{files as messages, outputs};
use rayon::prelude::*;

use super::Session;
use crate::files::is_program;

/// The programs that arguments name, with the directories that were searched.
#[derive(Debug, Default)]
pub struct ProgramMatches {
    /// Paths of the programs, in the order of the arguments.
    pub programs: Vec<Utf8PathBuf>,
    /// The directories that were searched.
    pub directories: Vec<Utf8PathBuf>,
    /// Diagnostics of directories that cannot be listed or contain no programs.
    pub problems: Vec<Diagnostic>,
}

/// The contents of a directory and of all directories below it.
#[derive(Debug, Default)]
pub(super) struct WalkResult {
    /// All drawings, or all other files that [`Walk::is_wanted`] accepts, in the order of [`compare_paths`].
    pub(super) drawings: Vec<Utf8PathBuf>,
    /// The directory itself and all directories below it, in the order of [`compare_paths`].
    pub(super) directories: Vec<Utf8PathBuf>,
    /// Contents of the directories that could be listed.
    pub(super) listings: Listings,
    /// Errors for directories that cannot be listed. If the limit is exceeded, the result contains nothing but PB005: a partial result would be
    /// misleading.
    pub(super) problems: Vec<Diagnostic>,
}

/// Maximum number of directories that are listed one after the other, because starting threads would take longer.
const MAX_SEQUENTIAL_DIRECTORIES: usize = 4;

/// Decides by a file's name whether a search finds the file.
pub(super) type FileFilter<'a> = &'a (dyn Fn(&Utf8Path) -> bool + Sync);

/// Settings of a recursive search.
#[derive(Clone, Copy)]
pub(super) struct Walk<'a> {
    pub(super) system: &'a dyn System,
    /// Upper bound on the number of files and directories that are found.
    pub(super) limit: u64,
    /// Upper bound on the size of an ignore file in bytes.
    pub(super) rules_limit: u64,
    /// Whether to use all cores.
    pub(super) is_parallel: bool,
    pub(super) is_wanted: FileFilter<'a>,
    /// Whether .gitignore files apply, besides .ignore.
    pub(super) obeys_git: bool,
    /// The directory of the configuration: its ignore files, and those of the directories between it and the root of the search, apply too.
    pub(super) top: Option<&'a Utf8Path>,
    pub(super) working_directory: &'a Utf8Path,
}

impl Walk<'_> {
    /// Finds all files that `is_wanted` accepts in and below a directory, respecting .gitignore and .ignore files inside it. Symbolic links to
    /// directories are not followed: they may lead anywhere, even in circles. The resulting paths begin with `root` as given, so they are normal if
    /// `root` is.
    pub(super) fn search(self, root: &Utf8Path) -> WalkResult {
        let (mut walked, count) = match self.collect_levels(root) {
            Ok(walked) => walked,
            Err(problem) => return WalkResult { problems: vec![*problem], ..WalkResult::default() },
        };
        if count > self.limit.saturating_add(1) {
            return WalkResult {
                problems: vec![too_many_entries(or_current_directory(root), self.limit)],
                ..WalkResult::default()
            };
        }
        // The drawings of each directory are sorted already, so this is fast.
        walked.drawings.sort_by(|a, b| compare_paths(a, b));
        walked.directories.sort_by(|a, b| compare_paths(a, b));
        walked
    }

    /// Reads the ignore rules of a directory. Leaves out those in .gitignore if the search does not obey them.
    fn rules(
        self,
        directory: &Utf8Path,
        above: Option<Arc<Rules>>,
        budget: &Budget,
    ) -> Result<Arc<Rules>, Box<Diagnostic>> {
        let mut rules = Rules::read(self.system, directory, above, budget)?;
        if !self.obeys_git
            && let Some(rules) = Arc::get_mut(&mut rules)
        {
            rules.git = Gitignore::empty();
        }
        Ok(rules)
    }

    /// Returns the rules of the directories above the root of the search, if there are any.
    fn rules_above(self, root: &Utf8Path, budget: &Budget) -> Result<Option<Arc<Rules>>, Box<Diagnostic>> {
        let Some(top) = self.top else { return Ok(None) };
        let [top, place] = [top, root].map(|directory| clean(&self.working_directory.join(directory)));
        let above: Vec<&Utf8Path> =
            place.ancestors().skip(1).take_while(|directory| directory.starts_with(&top)).collect();
        let mut rules = None;
        for directory in above.into_iter().rev() {
            let mut level = self.rules(directory, rules, budget)?;
            if let Some(level) = Arc::get_mut(&mut level) {
                level.root = Some([root.to_owned(), place.clone()]);
            }
            rules = Some(level);
        }
        Ok(rules.filter(|rules| rules.levels().any(|level| !level.git.is_empty() || !level.own.is_empty())))
    }

    /// Collects the files and directories unsorted, and counts them. Stops once the limit is exceeded.
    fn collect_levels(self, root: &Utf8Path) -> Result<(WalkResult, u64), Box<Diagnostic>> {
        let mut walked = WalkResult::default();
        let budget = Budget::new(self.rules_limit);
        let mut open: Vec<(Utf8PathBuf, Option<Arc<Rules>>)> =
            vec![(root.to_owned(), self.rules_above(root, &budget)?)];
        let mut count = 1;
        while !open.is_empty() && count <= self.limit.saturating_add(1) {
            let list = |(directory, above): &(Utf8PathBuf, Option<Arc<Rules>>)| {
                let list = || Directory::list(directory, above.clone(), self, &budget);
                catch_bugs(list).unwrap_or_else(|bug| Ok(Some(Directory::unreadable(directory, *bug))))
            };
            let is_parallel = self.is_parallel && open.len() > MAX_SEQUENTIAL_DIRECTORIES;
            let listed: Vec<_> = if is_parallel {
                open.par_iter().map(list).collect()
            } else {
                open.iter().map(list).collect()
            };
            if let Some(problem) = budget.exceeded(or_current_directory(root)) {
                return Err(problem);
            }
            let mut next = Vec::new();
            for ((directory, _), listed) in open.into_iter().zip(listed) {
                match listed? {
                    Some(listed) => {
                        count += listed.count;
                        walked.drawings.extend(listed.drawings);
                        walked.problems.extend(listed.problems);
                        let rules = listed.rules;
                        next.extend(listed.directories.into_iter().map(|below| (below, rules.clone())));
                        walked.listings.insert(directory.clone(), listed.listing);
                    }
                    // The root itself may be a drawing.
                    None if directory == *root && self.system.kind(root) == FileKind::File => {
                        walked.drawings.extend((self.is_wanted)(root).then(|| root.to_owned()));
                        continue;
                    }
                    None => {}
                }
                walked.directories.push(directory);
            }
            open = next;
        }
        Ok((walked, count))
    }
}

/// The contents of a single directory.
#[derive(Default)]
struct Directory {
    drawings: Vec<Utf8PathBuf>,
    directories: Vec<Utf8PathBuf>,
    listing: Listing,
    /// Entries with names that are not UTF-8. Their names are lossy, so nothing can be opened under them.
    inexact: Listing,
    /// The ignore rules that apply in this directory and below, if there are any.
    rules: Option<Arc<Rules>>,
    /// Number of entries that are not ignored.
    count: u64,
    /// Errors of listing the directory, and diagnostics of names under which nothing can be read.
    problems: Vec<Diagnostic>,
}

impl Directory {
    /// Returns a directory whose contents are unknown because listing it triggered a bug.
    fn unreadable(directory: &Utf8Path, bug: Diagnostic) -> Self {
        let problems = vec![bug.in_file(or_current_directory(directory))];
        Self { problems, listing: Listing { is_doubtful: true, ..Listing::default() }, ..Self::default() }
    }

    /// Lists a directory; `None` if there is no such directory.
    fn list(
        directory: &Utf8Path,
        above: Option<Arc<Rules>>,
        walk: Walk<'_>,
        budget: &Budget,
    ) -> Result<Option<Self>, Box<Diagnostic>> {
        let mut found = Self { rules: above.clone(), ..Self::default() };
        let mut has_own = false;
        let mut listed = walk.system.each_entry(directory, &mut |entry| {
            has_own = entry.is_exact && changes_rules(entry.name, above.is_some());
            found.add(directory, entry, walk.is_wanted);
            if has_own || found.count > walk.limit {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        });
        if has_own {
            // Most directories have no ignore file, so they are first listed without rules. One that has such a file is listed again.
            found = Self { rules: Some(walk.rules(directory, above, budget)?), ..Self::default() };
            listed = walk.system.each_entry(directory, &mut |entry| {
                found.add(directory, entry, walk.is_wanted);
                if found.count > walk.limit { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            });
        }
        if let Err(error) = &listed {
            // The directory is gone, or is a file. Any other error, such as a path that is too long, is reported.
            let is_none = match walk.system.kind(directory) {
                FileKind::Directory => false,
                FileKind::Missing => *error == ReadError::Missing,
                FileKind::File => true,
            };
            if is_none {
                return Ok(None);
            }
            found.problems.push(unlistable_error(directory, error));
        }
        // Lookups must not rely on an incomplete listing.
        found.listing.is_doubtful |= listed.is_err();
        found.listing.names.sort_unstable();
        let drawings = found.listing.names.iter().filter(|name| found.is_in_library(directory, name, false));
        found.drawings = drawings.map(|name| join(directory, &**name)).collect();
        if !found.inexact.names.is_empty() {
            found.listing.links.append(&mut found.inexact.links);
            found.listing.names.append(&mut found.inexact.names);
            found.listing.names.sort_unstable();
        }
        Ok(Some(found))
    }

    fn add(
        &mut self,
        directory: &Utf8Path,
        Entry { name, is_exact, kind }: Entry<'_>,
        is_wanted: FileFilter<'_>,
    ) {
        if kind != EntryKind::Directory && is_wanted(Utf8Path::new(name)) {
            let listing = if is_exact { &mut self.listing } else { &mut self.inexact };
            listing.names.push(name.into());
            if kind == EntryKind::Link {
                listing.links.push(name.into());
            }
        }
        let is_directory = kind == EntryKind::Directory;
        if !is_exact {
            let is_meant = is_directory || is_wanted(Utf8Path::new(name));
            if is_meant && self.is_in_library(directory, name, is_directory) {
                let problem = Diagnostic::new(&messages::NAME_NOT_UTF_8).quoting("name", name);
                self.problems.push(problem.in_file(or_current_directory(directory)));
            }
        } else if self.is_in_library(directory, name, is_directory) {
            self.count += 1;
            if is_directory {
                self.directories.push(join(directory, name));
            }
        }
    }

    /// Whether a name is part of the library, which means that it is not ignored.
    fn is_in_library(&self, directory: &Utf8Path, name: &str, is_directory: bool) -> bool {
        match &self.rules {
            Some(rules) => !rules.exclude(&join(directory, name), is_directory),
            None => !is_hidden(name),
        }
    }
}

/// Compares names like `Ord`, but faster: first as numbers made of the first eight bytes.
pub fn compare_names(a: &str, b: &str) -> cmp::Ordering {
    let begin = |name: &str| name.as_bytes().first_chunk().map(|bytes| u64::from_be_bytes(*bytes));
    match (begin(a), begin(b)) {
        (Some(x), Some(y)) if x != y => x.cmp(&y),
        _ => a.cmp(b),
    }
}

/// Compares paths component by component. Equivalent to `Ord` of paths if no component is empty or `.`, but does not split the paths: for
/// ten thousand drawings, splitting takes longer than querying their metadata.
pub fn compare_paths(a: &Utf8Path, b: &Utf8Path) -> cmp::Ordering {
    let (a, b) = (a.as_str().as_bytes(), b.as_str().as_bytes());
    let rank = |byte: u8| if is_separator(char::from(byte)) { 0 } else { byte };
    // Skip the common prefix in chunks, because the paths in a directory begin alike.
    let (a_chunks, b_chunks) = (a.as_chunks::<COMPARED_BYTES>().0, b.as_chunks::<COMPARED_BYTES>().0);
    let same = COMPARED_BYTES * a_chunks.iter().zip(b_chunks).take_while(|(x, y)| x == y).count();
    let differing = a[same..].iter().zip(&b[same..]).find(|(x, y)| x != y);
    differing.map_or_else(|| a.len().cmp(&b.len()), |(x, y)| rank(*x).cmp(&rank(*y)))
}

const COMPARED_BYTES: usize = 8;

fn too_many_entries(directory: &Utf8Path, limit: u64) -> Diagnostic {
    Diagnostic::new(&messages::TOO_MANY_ENTRIES)
        .quoting("directory", directory.as_str())
        .with("limit", limit)
        .quoting("key", "library-entries")
}

impl Session<'_> {
    /// Returns the programs that these arguments name, each once, and the diagnostics of directories. A directory stands for the files in and below
    /// it that `is_program` accepts. A pattern that the shell passed on unexpanded stands for the files and directories that match its last
    /// component.
    pub(crate) fn match_programs(
        &self,
        arguments: &[Utf8PathBuf],
        is_program: FileFilter<'_>,
    ) -> ProgramMatches {
        let mut found = ProgramMatches::default();
        for argument in arguments {
            for place in self.expand_pattern(argument, is_program) {
                if self.is_directory(&place) {
                    self.add_directory(&place, is_program, &mut found);
                } else {
                    found.programs.push(place);
                }
            }
        }
        let mut seen = HashSet::new();
        found.programs.retain(|program| seen.insert(self.normalize(program)));
        found
    }

    fn add_directory(&self, directory: &Utf8Path, is_program: FileFilter<'_>, found: &mut ProgramMatches) {
        self.start_workers();
        let root = if directory == "." { Utf8Path::new("") } else { directory };
        // Programs are generated files, which .gitignore often excludes, so it is disregarded.
        let walked = Walk { obeys_git: false, ..self.walk(is_program) }.search(root);
        if walked.drawings.is_empty() && walked.problems.is_empty() {
            let problem = Diagnostic::new(&outputs::NO_PROGRAM);
            found.problems.push(problem.quoting("directory", or_current_directory(directory).as_str()));
        }
        found.programs.extend(walked.drawings);
        found.directories.extend(walked.directories);
        found.problems.extend(walked.problems);
    }

    /// Returns the drawings and programs in and below a directory, including those that .gitignore excludes.
    pub(crate) fn drawings_and_programs_below(&self, directory: &Utf8Path) -> Vec<Utf8PathBuf> {
        self.start_workers();
        let is_wanted = |file: &Utf8Path| is_drawing(file) || is_program(file);
        Walk { obeys_git: false, ..self.walk(&is_wanted) }.search(directory).drawings
    }

    /// Returns the directories that may have been the output directory: that of the configuration and those on the way from it to `out_dir`, each
    /// with those directly in it. Leaves out hidden ones, those that .ignore excludes, and those that cannot be listed.
    pub(crate) fn possible_output_directories(&self, out_dir: Option<&Utf8Path>) -> Vec<Utf8PathBuf> {
        let Some(mut place) = self.context.settings.directory().map(|top| self.normalize(top)) else {
            return Vec::new();
        };
        let walk = Walk { obeys_git: false, ..self.walk(&|_| false) };
        let budget = Budget::new(walk.rules_limit);
        let (mut directories, mut rules) = (Vec::new(), None);
        let way = out_dir.and_then(|out_dir| out_dir.strip_prefix(&place).ok().map(Utf8Path::to_owned));
        let mut way = way.iter().flat_map(|way| way.iter());
        directories.push(place.clone());
        while let Ok(Ok(Some(listed))) = catch_bugs(|| Directory::list(&place, rules.take(), walk, &budget)) {
            directories.extend_from_slice(&listed.directories);
            let Some(next) = way.next().map(|name| join(&place, name)) else { break };
            if !listed.directories.contains(&next) {
                break;
            }
            (place, rules) = (next, listed.rules);
        }
        directories
    }

    /// Queries the database about a directory.
    ///
    /// # Errors
    /// PB006 if this triggers a bug, PB001 if a drawing changed in the meantime or if the directory cannot be listed.
    pub(super) fn query_directory<R>(
        &self,
        directory: &Utf8Path,
        ask: impl Fn(pathbuild_db::Directory) -> R,
    ) -> Result<R, Box<Diagnostic>> {
        let input = self.db.directory(directory);
        let answer = self.db.run_guarded(self.limit(), || (ask(input), listing_error(&self.db, input)));
        match answer.map_err(|problem| problem.in_file(or_current_directory(directory)))? {
            (answer, None) => Ok(answer),
            (_, Some(problem)) => Err(Box::new(problem)),
        }
    }

    /// Returns the names of the entries of a directory that are not directories themselves; empty if the directory does not exist.
    ///
    /// # Errors
    /// PB001 if it cannot be listed, PB006 if this triggers a bug.
    pub fn file_names_in(&self, directory: &Utf8Path) -> Result<Names, Box<Diagnostic>> {
        let listed = catch_bugs(|| self.db.system().list(directory));
        match listed.map_err(|bug| Box::new(bug.in_file(or_current_directory(directory))))? {
            Ok(listing) => Ok(listing.files),
            Err(fault) if self.is_directory(directory) => Err(Box::new(unlistable_error(directory, &fault))),
            Err(_) => Ok(Names::default()),
        }
    }
}

/// The ignore rules that apply in a directory: those in its own files, and those from the directories above.
#[derive(Debug)]
pub(super) struct Rules {
    git: Gitignore,
    own: Gitignore,
    /// Whether the directory is the root of a repository: .gitignore files above it do not apply.
    is_repository: bool,
    /// For a directory above the root of the search, which has an absolute path: the root as it is named, and as an absolute path. `None` for other
    /// directories.
    root: Option<[Utf8PathBuf; 2]>,
    above: Option<Arc<Self>>,
}

/// A budget for the total size of ignore files. It is needed because compiled rules take about two hundred times as much memory as their files.
#[derive(Debug)]
pub(super) struct Budget {
    /// Upper bound on a file's size in bytes.
    file_limit: u64,
    /// Total size in bytes of the files that were read.
    read: AtomicU64,
}

/// Upper bound on the total size of all ignore files, as a multiple of the limit for one file.
const TOTAL_FACTOR: u64 = 16;

impl Budget {
    /// Creates a budget. `file_limit` is the value of `[limits] ignore-file-size`.
    pub(super) fn new(file_limit: u64) -> Self {
        Self { file_limit, read: AtomicU64::new(0) }
    }

    /// Returns PB005 if the files read by all threads exceed the total, so that rules are missing.
    pub(super) fn exceeded(&self, root: &Utf8Path) -> Option<Box<Diagnostic>> {
        let problem = || {
            Diagnostic::new(&messages::TOO_MANY_RULES)
                .quoting("directory", root.as_str())
                .with("limit", self.total_limit())
                .quoting("key", "ignore-file-size")
        };
        self.is_exceeded().then(|| Box::new(problem()))
    }

    fn is_exceeded(&self) -> bool {
        self.read.load(Ordering::Relaxed) > self.total_limit()
    }

    fn total_limit(&self) -> u64 {
        self.file_limit.saturating_mul(TOTAL_FACTOR)
    }

    fn spend(&self, bytes: usize) {
        self.read.fetch_add(bytes as u64, Ordering::Relaxed);
    }
}

/// Upper bound on the length of a line in bytes. Longer lines are not patterns of names, and nested patterns would need a deep stack.
const MAX_LINE_BYTES: usize = 4096;

pub(crate) const IGNORE_FILES: [&str; 2] = [".gitignore", ".ignore"];

pub(crate) fn is_ignore_file(name: &str) -> bool {
    IGNORE_FILES.contains(&name)
}

/// Whether an entry of this name changes the rules: an ignore file does; so does `.git`, which marks the root of a repository, if there already are
/// rules.
pub(super) fn changes_rules(name: &str, are_some: bool) -> bool {
    is_ignore_file(name) || are_some && name == ".git"
}

impl Rules {
    /// Reads the ignore files of a directory, within a budget.
    ///
    /// # Errors
    /// If a file cannot be read: without its rules, it is unknown which files are ignored.
    pub(super) fn read(
        system: &dyn System,
        directory: &Utf8Path,
        above: Option<Arc<Self>>,
        budget: &Budget,
    ) -> Result<Arc<Self>, Box<Diagnostic>> {
        let read = |name| patterns(system, directory, name, budget);
        let is_repository = system.kind(&directory.join(".git")) != FileKind::Missing;
        Ok(Arc::new(Self {
            git: read(".gitignore")?,
            own: read(".ignore")?,
            is_repository,
            root: None,
            above,
        }))
    }

    /// Whether an entry is ignored. Rules in `.ignore` files take precedence over those in `.gitignore`, and rules of a directory take precedence
    /// over those of directories above it. Hidden entries are ignored unless a rule includes them.
    pub(super) fn exclude(&self, path: &Utf8Path, is_directory: bool) -> bool {
        let by_own = self.levels().map(|level| level.own.matched(&*level.path(path), is_directory));
        let by_git = self.git_levels().map(|level| level.git.matched(&*level.path(path), is_directory));
        match by_own.chain(by_git).find(|found| !found.is_none()) {
            Some(Match::Ignore(_)) => true,
            Some(_) => false,
            None => path.file_name().is_some_and(is_hidden),
        }
    }

    /// Returns the path of an entry as the rules of this directory need it: absolute for a directory above the root of the search. `path` begins with
    /// the root as it is named.
    fn path<'p>(&self, path: &'p Utf8Path) -> Cow<'p, Utf8Path> {
        let below =
            self.root.as_ref().and_then(|[root, place]| Some(join(place, path.strip_prefix(root).ok()?)));
        below.map_or(Cow::Borrowed(path), Cow::Owned)
    }

    fn levels(&self) -> impl Iterator<Item = &Self> {
        std::iter::successors(Some(self), |level| level.above.as_deref())
    }

    /// Iterates over the directories from this one up to the root of its repository.
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
    let limit = budget.file_limit;
    let bytes = match system.read(&file, limit) {
        Ok(bytes) => bytes,
        Err(ReadError::Missing | ReadError::IsDirectory) => return Ok(Gitignore::empty()),
        Err(error) => return Err(Box::new(error.diagnostic(limit, "ignore-file-size").in_file(&file))),
    };
    budget.spend(bytes.len());
    if budget.is_exceeded() {
        return Ok(Gitignore::empty());
    }
    let text = String::from_utf8_lossy(&bytes);
    let mut builder = GitignoreBuilder::new(directory);
    for (number, line) in (1..).zip(text.trim_start_matches('\u{feff}').lines()) {
        if line.len() > MAX_LINE_BYTES {
            let problem = Diagnostic::new(&messages::LINE_TOO_LONG).with("limit", MAX_LINE_BYTES);
            return Err(Box::new(problem.in_file(&file).at_line(number, None)));
        }
        // Like Git, skip lines that are not valid patterns.
        _ = builder.add_line(None, line);
    }
    Ok(builder.build().unwrap_or_else(|_| Gitignore::empty()))
}
