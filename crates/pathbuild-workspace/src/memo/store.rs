//! The cached results of a query, verified against the files, and the cache key, which contains everything that they depend on besides files.

use std::cell::Cell;
use std::collections::HashSet;
use std::fmt::Write;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_cache::{
    CacheFault, Catalogue, FileState, Key, Listings, Lookup, Reason, TreeStore, Verdict, VerifyContext,
    encode, reasons, verify,
};
use pathbuild_db::system::{FileKind, System};
use pathbuild_db::{Database, Trace};
use pathbuild_diagnostic::reasons::IN_UNTRUSTED_TREE;
use pathbuild_files::{FileSystemTime, Stamp};
use pathbuild_path::{FilePattern, PathKey, PathPattern, RangeTable};
use serde::Serialize;

use crate::config::ResultKind;
use crate::files::ExtraInput;
use crate::session::{ArgumentMatches, OutputKind, Session, without_values};
use crate::workspace::Workspace;

/// A result with its subject, cached or computed by this run.
#[derive(Debug)]
pub struct Answer<T> {
    /// The subject of the result. It begins with the path of a drawing; anything more specific follows after a NUL.
    pub subject: Box<str>,
    /// The decoded result.
    pub value: T,
    /// The inputs from which this run computed the result; `None` if the result was cached.
    pub inputs: Option<Inputs>,
}

/// The inputs of a result of this run, and the files that were generated from it.
#[derive(Clone, Debug, Default)]
pub struct Inputs {
    /// The drawings and lookups that the result depends on.
    pub traces: Vec<Trace>,
    /// Other files that the result depends on.
    pub further: Vec<ExtraInput>,
    /// The files that were generated from the result.
    pub outputs: Vec<GeneratedFile>,
    /// Whether another run may get a different result although no input changes.
    pub is_transient: bool,
}

/// A result of this run, encoded for the cache.
#[derive(Debug)]
pub struct FreshResult<'a> {
    pub(super) subject: &'a str,
    pub(super) inputs: &'a Inputs,
    /// The encoded result; `None` if it must not be cached.
    pub(super) payload: Option<Vec<u8>>,
}

impl<T: Serialize> Answer<T> {
    /// Encodes the result for the cache; `None` if it was cached already.
    pub fn fresh(&self) -> Option<FreshResult<'_>> {
        let inputs = self.inputs.as_ref()?;
        let payload = if inputs.is_transient { None } else { encode(&self.value) };
        Some(FreshResult { subject: &self.subject, inputs, payload })
    }
}

/// The cached results of a query.
#[derive(Debug)]
pub(super) struct Store {
    pub(super) place: TreeStore,
    pub(super) key: Key,
    pub(super) base: Utf8PathBuf,
    pub(super) coverage: Coverage,
    pub(super) scope: Scope,
    /// Time of the file system before anything was read; `None` if the cache is not writable.
    pub(super) begun: Option<FileSystemTime>,
    pub(super) kept: Catalogue,
    pub(super) verdict: Verdict,
    /// Index of the record that is likely to be requested next, since requests come in order.
    pub(super) next: Cell<usize>,
}

/// A file that was generated from a result.
#[derive(Clone, Debug)]
pub struct GeneratedFile {
    /// Path of the file.
    pub path: Utf8PathBuf,
    /// Hash of its expected content, as computed by [`hash_output`].
    pub hash: [u8; 32],
    /// Whether the file on disk has the expected content.
    pub is_there: bool,
}

/// State of a generated file on disk.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OutputState {
    /// The file has the expected content.
    Current,
    /// The file has other content.
    Outdated,
    /// The file does not exist.
    Missing,
}

/// The inputs of a cached result.
#[derive(Clone, Debug)]
pub struct Dependencies<'a> {
    /// Paths of the files that were read.
    pub files: Vec<&'a Utf8Path>,
    /// Lookups of paths by name, each with the directory in which it was made.
    pub lookups: Vec<(&'a Utf8Path, &'a str)>,
}

impl<'a> Dependencies<'a> {
    pub(super) fn of(db: &'a Database, traces: &'a [Trace]) -> Self {
        let files = traces.iter().flat_map(|trace| &trace.files).map(|file| &**file.path(db));
        let lookups = traces.iter().flat_map(|trace| &trace.lookups).flat_map(|lookup| {
            lookup.directories.iter().map(|directory| (&**directory, lookup.name.as_str()))
        });
        Self { files: files.collect(), lookups: lookups.collect() }
    }
}

impl Store {
    /// Loads the cached results and verifies them against the files; `None` without a configuration, if caching is disabled, or if the cache
    /// directory must not be used.
    pub(super) fn open(
        context: &Workspace,
        kind: ResultKind,
        text: &str,
        scope: Scope,
        listings: Listings,
    ) -> Option<Self> {
        let base = context.settings.directory()?.to_owned();
        let place = context.cache_store()?;
        let confined = context.settings.confined.as_ref();
        let is_untrusted = confined.is_some_and(|confined| confined.may_hold(place.directory()));
        if let Some(reason) = is_untrusted.then_some(&IN_UNTRUSTED_TREE).or_else(|| place.refusal()) {
            let phrase =
                context.choose("no results are cached there", "dort werden keine Ergebnisse gespeichert");
            let reason = reason.in_lang(context.lang());
            context.reporter.status(&format!("{}: {phrase}: {reason}", place.directory()));
            return None;
        }
        // Best effort: without write access, cached results are still used, but no new ones are stored.
        if place.create().is_ok_and(|is_new| is_new) {
            report_old_cache(context, &base);
        }
        let key = Key::new(BUILD, &query_text(context, kind, text));
        // Take the time before any file is examined, so that later changes are detected.
        let begun = place.clock().ok();
        let kept = match place.load(&key) {
            Ok(kept) => kept.unwrap_or_default(),
            Err(reason) => {
                report_fault(context, reason);
                Catalogue::default()
            }
        };
        let coverage = Coverage::new(context);
        let verdict = verify_snapshot(context, &kept, &coverage, &scope, listings);
        Some(Self { place, key, base, coverage, scope, begun, kept, verdict, next: Cell::new(0) })
    }

    /// Returns the encoded result of a subject, if it still holds.
    pub(super) fn payload(&self, subject: &str) -> Option<&[u8]> {
        let number = self.record(subject)?;
        self.verdict.is_valid[number].then(|| &*self.kept.records[number].payload)
    }

    /// Returns the states of the files that were generated from a result, in the order in which they were stored.
    pub(super) fn outputs(&self, subject: &str) -> Vec<OutputState> {
        let Some(number) = self.record(subject) else { return Vec::new() };
        let state = |file: &usize| match self.verdict.files[*file] {
            FileState::Unchanged | FileState::Touched(_) => OutputState::Current,
            FileState::Changed | FileState::Unchecked
                if Stamp::of(&self.kept.files[*file].path) == Stamp::MISSING =>
            {
                OutputState::Missing
            }
            FileState::Changed | FileState::Unchecked => OutputState::Outdated,
        };
        self.kept.records[number].outputs.iter().map(state).collect()
    }

    pub(super) fn dependencies(&self, subject: &str) -> Option<Dependencies<'_>> {
        let record = &self.kept.records[self.record(subject)?];
        let files = record.files.iter().map(|file| &*self.kept.files[*file].path);
        let lookup = |lookup: &usize| {
            let Lookup { directories, name } = &self.kept.lookups[*lookup];
            let list = self.kept.directory_lists[*directories].iter();
            list.map(move |directory| (&*self.kept.directories[*directory].path, &**name))
        };
        Some(Dependencies {
            files: files.collect(),
            lookups: record.lookups.iter().flat_map(lookup).collect(),
        })
    }

    /// Returns the reasons why a cached result no longer holds: an empty list if it holds; `None` if there is no such result.
    pub(super) fn invalidation_reasons(&self, subject: &str) -> Option<Vec<Reason>> {
        let number = self.record(subject)?;
        let coverage = &self.coverage;
        Some(reasons(&self.kept, &self.verdict, number, &|file, path| coverage.may_hold(file, path)))
    }

    fn record(&self, subject: &str) -> Option<usize> {
        let number = self.kept.find(subject, self.next.get())?;
        self.next.set(number + 1);
        Some(number)
    }
}

/// Verifies the cached results against the files.
fn verify_snapshot(
    workspace: &Workspace,
    kept: &Catalogue,
    coverage: &Coverage,
    scope: &Scope,
    listings: Listings,
) -> Verdict {
    let base = workspace.settings.directory().unwrap_or(Utf8Path::new(""));
    let is_requested = |subject: &str| scope.holds(subject);
    let covers = |file: &str, path: &str| coverage.may_hold(file, path);
    let (system, limits) = (&*workspace.system, &workspace.settings.limits);
    let read = |file: &Utf8Path, is_output: bool| {
        let mut buffer = Vec::new();
        let limit = if is_output { limits.output_size.value } else { limits.file_size.value };
        let stamp = system.read_into(file, limit, &mut buffer).ok()?;
        Some((buffer, stamp))
    };
    let confined = workspace.settings.confined.as_ref();
    let is_allowed = |file: &Utf8Path| confined.is_none_or(|confined| confined.allows(file));
    let context = VerifyContext {
        base,
        covers: &covers,
        is_requested: &is_requested,
        is_allowed: &is_allowed,
        read: &read,
        hash_output: &hash_output,
    };
    verify(kept, context, listings)
}

/// Hashes the content of an output file. In a file of measured values, the values that users entered are left out.
pub fn hash_output(path: &Utf8Path, bytes: &[u8]) -> [u8; 32] {
    let is_values = path.as_str().ends_with(OutputKind::Values.suffix());
    let hash = if is_values { blake3::hash(without_values(bytes).as_bytes()) } else { blake3::hash(bytes) };
    *hash.as_bytes()
}

/// Tells users that the cache of earlier versions, beside the configuration, can be deleted.
fn report_old_cache(context: &Workspace, base: &Utf8Path) {
    if context.system.kind(&base.join(OLD_CACHE_DIRECTORY)) == FileKind::Directory {
        context.reporter.status(context.choose(
            "results are now cached in your cache directory: .pathbuild beside the configuration is no longer used and can be deleted",
            "Ergebnisse werden jetzt in Ihrem Cache-Verzeichnis gespeichert: .pathbuild neben der Konfiguration wird nicht mehr benutzt und kann gelöscht werden",
        ));
    }
}

const OLD_CACHE_DIRECTORY: &str = ".pathbuild";

fn report_fault(context: &Workspace, reason: CacheFault) {
    let phrase = match reason {
        CacheFault::Damaged => context.choose(
            "the cache is damaged and will be rebuilt",
            "der Cache ist beschädigt und wird neu angelegt",
        ),
        CacheFault::Foreign => context.choose(
            "the cache was written by another build of pathbuild and will be rebuilt",
            "der Cache stammt von einer anderen Fassung von pathbuild und wird neu angelegt",
        ),
    };
    context.reporter.status(phrase);
}

/// Identifier of this build of the program.
pub const BUILD: &str = env!("PATHBUILD_BUILD");

/// Returns the text of the cache key: the query with all settings that results depend on. Directories are relative to the configuration, so that
/// results in a named cache directory still hold when the tree is moved or copied as a whole.
pub(super) fn query_text(context: &Workspace, result_kind: ResultKind, query: &str) -> String {
    let mut text = query.to_owned();
    let base = context.settings.directory().map(|base| format!("\"{base}/")).unwrap_or_default();
    context.settings.visit_inputs(result_kind, &mut |name, value| {
        let value = format!("{value:?}");
        let value = if base.is_empty() { value } else { value.replace(&base, "\"./") };
        _ = write!(text, "\n{name} = {value}");
    });
    if result_kind == ResultKind::Emit {
        // These values depend on whether a key is set, not only on the key's value.
        _ = write!(text, "\n{:?}", (context.settings.comment_lang(), context.settings.z_split()));
    }
    // Untrusted trees are checked more strictly than the user's own.
    _ = write!(text, "\n{}\n{}", context.settings.confined.is_some(), relative_working_directory(context));
    text
}

/// Returns the working directory, relative to the configuration's directory if it is below it. It is part of the key because names in results are
/// relative to it.
fn relative_working_directory(context: &Workspace) -> &str {
    let directory = &context.working_directory;
    let base = context.settings.directory();
    base.and_then(|base| directory.strip_prefix(base).ok()).unwrap_or(directory).as_str()
}

/// The patterns of path names and of file names: they decide which drawings may contain which paths.
#[derive(Clone, Debug)]
pub struct Coverage {
    paths: PathPattern,
    files: FilePattern,
}

impl Coverage {
    /// Compiles the patterns of the configuration.
    pub fn new(context: &Workspace) -> Self {
        let general = &context.settings.general;
        Self {
            paths: PathPattern::new(&general.path_pattern.value).unwrap_or_default(),
            files: FilePattern::new(&general.file_pattern.value).unwrap_or_default(),
        }
    }

    /// Whether a drawing with the file name `file` may contain the path with the name `path`.
    pub fn may_hold(&self, file: &str, path: &str) -> bool {
        self.of_files([file]).may_hold(path)
    }

    /// Returns the set of paths that drawings with these file names may contain.
    pub fn of_files<'f>(&self, files: impl IntoIterator<Item = &'f str>) -> CoveredPaths<'_> {
        let stem = |file: &'f str| file.rsplit_once('.').map_or(file, |(stem, _)| stem);
        let ranges = files.into_iter().flat_map(|file| self.files.ranges(stem(file)));
        CoveredPaths { paths: &self.paths, ranges: ranges.map(|range| (range, 0)).collect() }
    }
}

/// The paths that some drawings may contain, judging by the drawings' file names.
#[derive(Debug)]
pub struct CoveredPaths<'a> {
    paths: &'a PathPattern,
    ranges: RangeTable,
}

impl CoveredPaths<'_> {
    /// Whether any of the drawings may contain the path with this name.
    pub fn may_hold(&self, path: &str) -> bool {
        PathKey::new(path, self.paths).is_some_and(|key| !self.ranges.files(&key).is_empty())
    }
}

/// The drawings that a run uses, or the programs that it verifies. The subject of a result begins with the path of such a file. If the result is
/// about a part of a drawing, the description of that part follows after a NUL.
#[derive(Debug)]
pub(super) enum Scope {
    All,
    Drawings {
        /// Paths of the drawings or programs that the run uses.
        drawings: HashSet<String>,
        /// Directories that were listed completely, so that they contain no other drawings.
        directories: HashSet<String>,
    },
}

impl Scope {
    /// Returns the drawings that the arguments may refer to.
    pub(super) fn of(session: &Session<'_>, found: &ArgumentMatches) -> Self {
        let named = found.named_drawings().map(|file| file.path(session.db()).to_string());
        let drawings = found.directories().flat_map(|directory| &directory.drawings);
        let directories = found.directories().flat_map(|directory| &directory.directories);
        Self::Drawings {
            drawings: drawings.map(ToString::to_string).chain(named).collect(),
            directories: directories.map(ToString::to_string).collect(),
        }
    }

    /// Whether the run uses the result with this subject.
    pub(super) fn holds(&self, subject: &str) -> bool {
        match self {
            Self::All => true,
            Self::Drawings { drawings, .. } => drawings.contains(drawing(subject)),
        }
    }

    /// Whether a result may be needed again, because its drawing still exists. A run on single drawings keeps the results of other drawings.
    pub(super) fn may_be_needed_again(&self, subject: &str, system: &dyn System) -> bool {
        let drawing = Utf8Path::new(drawing(subject));
        let is_file = || system.kind(drawing) == FileKind::File;
        match self {
            Self::All => is_file(),
            Self::Drawings { directories, .. } => {
                let is_below = |parent: &Utf8Path| directories.contains(parent.as_str());
                let was_listed = drawing.parent().is_some_and(is_below);
                self.holds(subject) || directories.is_empty() || !was_listed && is_file()
            }
        }
    }
}

fn drawing(subject: &str) -> &str {
    subject.split('\0').next().unwrap_or_default()
}
