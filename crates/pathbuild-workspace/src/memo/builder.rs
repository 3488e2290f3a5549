//! Builds the catalogue of results that is stored in the cache. Results that still hold keep their facts about files; new results get the facts of
//! this run. Also returns the path names and the diagnostics of drawings, from the cache or newly read.

use std::collections::hash_map::Entry;
use std::collections::{BTreeSet, HashMap, HashSet};
use std::hash::Hash;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_cache::{Catalogue, DirectoryFact, FileFact, FileState, Lookup, Record};
use pathbuild_db::{
    Database, Db, NameLookup, SourceFile, Trace, check_file, content, drawing_names, has_clamp_layer,
    has_part_layer, path_names,
};
use pathbuild_diagnostic::{Code, Diagnostic, Value};
use pathbuild_files::{FileSystemTime, Stamp};
use pathbuild_path::PathName;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::Memo;
use super::store::{Answer, FreshResult, GeneratedFile, Inputs, Store};
use crate::files::ExtraInput;
use crate::session::{MAX_READ_FOR_NAMES, Session};

impl Store {
    /// Stores new results together with cached results that still hold, including those of drawings outside this run. Writes nothing if nothing has
    /// changed.
    pub(super) fn store_results(&self, session: &Session<'_>, fresh: &[FreshResult<'_>]) {
        let is_as_it_was = fresh.is_empty() && self.verdict.is_current;
        let Some(begun) = self.begun.filter(|_| !is_as_it_was) else { return };
        let fresh_subjects: HashSet<&str> = fresh.iter().map(|fresh| fresh.subject).collect();
        let mut builder = CatalogueBuilder::new(self, session, begun, fresh);
        for (record, _) in
            self.kept.records.iter().zip(&self.verdict.is_sound).filter(|(_, is_sound)| **is_sound)
        {
            let subject = &*record.subject;
            if !fresh_subjects.contains(subject)
                && self.scope.may_be_needed_again(subject, session.db().system())
            {
                builder.carry_over_record(record);
            }
        }
        for fresh in fresh {
            builder.add_fresh(fresh);
        }
        // Best effort: without write access, results are not cached.
        _ = self.place.store(&self.key, builder.finish());
    }
}

struct CatalogueBuilder<'a> {
    store: &'a Store,
    session: &'a Session<'a>,
    begun: FileSystemTime,
    catalogue: Catalogue,
    /// Index of each file in the new catalogue, by path. The next three maps hold the indices of directories, lists of directories, and lookups.
    files: HashMap<Utf8PathBuf, usize>,
    directories: HashMap<Utf8PathBuf, usize>,
    lists: HashMap<Vec<usize>, usize>,
    lookups: HashMap<Lookup, usize>,
    /// For each lookup of the old catalogue, its index in the new one; `None` until it is carried over.
    kept_lookups: Vec<Option<usize>>,
    /// Index of each file in the old catalogue.
    kept_files: HashMap<&'a Utf8Path, usize>,
    run: RunFacts<'a>,
}

impl<'a> CatalogueBuilder<'a> {
    fn new(
        store: &'a Store,
        session: &'a Session<'a>,
        begun: FileSystemTime,
        fresh: &'a [FreshResult<'a>],
    ) -> Self {
        let kept = &store.kept;
        Self {
            store,
            session,
            begun,
            catalogue: Catalogue::default(),
            files: HashMap::new(),
            directories: HashMap::new(),
            lists: HashMap::new(),
            lookups: HashMap::new(),
            kept_lookups: vec![None; kept.lookups.len()],
            kept_files: kept.files.iter().map(|file| &*file.path).zip(0..).collect(),
            run: RunFacts::new(session, fresh),
        }
    }

    fn finish(self) -> Catalogue {
        self.catalogue
    }

    /// Carries over a record that was not invalidated, unless this run read other bytes from one of its drawings, or wrote or compared one of its
    /// output files for a new result.
    fn carry_over_record(&mut self, record: &Record) {
        let kept = &self.store.kept;
        let has_written = |file: &usize| self.run.written.contains(&*kept.files[*file].path);
        if record.files.iter().any(|file| self.has_other_content(*file))
            || record.outputs.iter().any(has_written)
        {
            return;
        }
        let files = record.files.iter().map(|file| self.carry_over_file(*file)).collect();
        let lookups = record.lookups.iter().map(|lookup| self.carry_over_lookup(*lookup)).collect();
        let outputs = record.outputs.iter().map(|file| self.carry_over_file(*file)).collect();
        let (subject, payload) = (record.subject.clone(), record.payload.clone());
        self.catalogue.records.push(Record { subject, files, lookups, outputs, payload });
    }

    /// Adds a new result, unless it must not be cached. Leaves it out as well if one of its drawings could not be read or changed during the run,
    /// because such a result may not be reproducible.
    fn add_fresh(&mut self, result: &FreshResult<'_>) {
        let Some(payload) = &result.payload else { return };
        let db = self.session.db();
        let inputs = result.inputs;
        let mut drawings = inputs.traces.iter().flat_map(|trace| &trace.files);
        if drawings.any(|file| self.run.content(file.path(db)).is_none()) {
            return;
        }
        let mut files = BTreeSet::new();
        let mut lookups = BTreeSet::new();
        for trace in &inputs.traces {
            files.extend(trace.files.iter().map(|file| self.drawing(*file)));
            lookups.extend(trace.lookups.iter().map(|lookup| self.lookup(lookup)));
        }
        files.extend(inputs.further.iter().map(|file| self.add_extra_input(file)));
        let outputs = inputs.outputs.iter().map(|output| self.output(output)).collect();
        self.catalogue.records.push(Record {
            subject: result.subject.into(),
            files: files.into_iter().collect(),
            lookups: lookups.into_iter().collect(),
            outputs,
            payload: payload.clone(),
        });
    }

    /// Whether a file of the old catalogue was not verified, and this run read other bytes from it or could not read it.
    fn has_other_content(&self, number: usize) -> bool {
        let file = &self.store.kept.files[number];
        self.store.verdict.files[number] == FileState::Unchecked
            && self.run.has_other_content(&file.path, file.hash)
    }

    fn carry_over_file(&mut self, number: usize) -> usize {
        let file = &self.store.kept.files[number];
        if let Some(new) = self.files.get(&file.path) {
            return *new;
        }
        let mut fact = file.clone();
        match self.store.verdict.files[number] {
            FileState::Unchanged | FileState::Unchecked => {}
            FileState::Touched(stamp) => fact.stamp = stamp.for_storing(self.begun),
            // An output file that is out of date: its hash stays, because it describes the expected content.
            FileState::Changed => fact.stamp = Stamp::UNKNOWN,
        }
        // If the file has changed since it was compared, it is unclear which content a result belongs to.
        if self.run.has_other_content(&fact.path, fact.hash) {
            (fact.stamp, fact.hash) = (Stamp::UNKNOWN, None);
        }
        self.add_file(fact)
    }

    /// Adds a drawing that was read in this run, and returns its index.
    fn drawing(&mut self, file: SourceFile) -> usize {
        let path = file.path(self.session.db());
        let is_known = |number: &usize| {
            self.store.verdict.files[*number] != FileState::Changed && !self.has_other_content(*number)
        };
        match self.kept_files.get(&**path).copied().filter(is_known) {
            Some(number) => self.carry_over_file(number),
            None => self.new_file(path, self.run.content(path)),
        }
    }

    /// Adds a file other than a drawing, and returns its index. If results were computed from different contents of the file, it is unclear to which
    /// content a result belongs, so the file gets neither stamp nor hash.
    fn add_extra_input(&mut self, ExtraInput { path, hash }: &ExtraInput) -> usize {
        let mut buffer = Vec::new();
        let limit = self.session.workspace().settings.limits.file_size.value;
        let stamp = self.session.db().system().read_into(path, limit, &mut buffer).ok();
        let stamp =
            stamp.filter(|_| Some(*blake3::hash(&buffer).as_bytes()) == *hash).unwrap_or(Stamp::UNKNOWN);
        let number = self.new_file(path, hash.map(|hash| (hash, stamp)));
        let fact = &mut self.catalogue.files[number];
        if fact.hash != *hash {
            (fact.stamp, fact.hash) = (Stamp::UNKNOWN, None);
        }
        number
    }

    /// Adds an output file that was written or compared in this run, and returns its index.
    fn output(&mut self, GeneratedFile { path, hash, is_there }: &GeneratedFile) -> usize {
        let stamp = if *is_there { Stamp::of(path).for_storing(self.begun) } else { Stamp::UNKNOWN };
        // If the file has been removed in the meantime, the stamp of a missing file must not be stored with the hash.
        let stamp = if stamp == Stamp::MISSING { Stamp::UNKNOWN } else { stamp };
        self.add_file(FileFact { path: path.clone(), stamp, hash: Some(*hash) })
    }

    /// Adds a file, and returns its index. A file that could not be read gets neither stamp nor hash, so that its results are recomputed.
    fn new_file(&mut self, path: &Utf8Path, content: Option<Content>) -> usize {
        let stamp = content.map_or(Stamp::UNKNOWN, |(_, stamp)| stamp.for_storing(self.begun));
        self.add_file(FileFact { path: path.to_owned(), stamp, hash: content.map(|(hash, _)| hash) })
    }

    /// Adds a fact about a file, and returns its index; the first fact about a file wins.
    fn add_file(&mut self, fact: FileFact) -> usize {
        if let Some(known) = self.files.get(&fact.path) {
            return *known;
        }
        self.files.insert(fact.path.clone(), self.catalogue.files.len());
        self.catalogue.files.push(fact);
        self.catalogue.files.len() - 1
    }

    fn carry_over_lookup(&mut self, number: usize) -> usize {
        if let Some(new) = self.kept_lookups[number] {
            return new;
        }
        let kept = &self.store.kept;
        let Lookup { directories, name } = &kept.lookups[number];
        let list = &kept.directory_lists[*directories];
        let list = list.iter().map(|directory| self.carry_over_directory(*directory)).collect();
        let new = self.add_lookup(list, name);
        self.kept_lookups[number] = Some(new);
        new
    }

    /// Adds a lookup made in this run, and returns its index.
    fn lookup(&mut self, lookup: &NameLookup) -> usize {
        let list = lookup.directories.iter().map(|directory| self.directory(directory)).collect();
        self.add_lookup(list, lookup.name.as_str())
    }

    fn add_lookup(&mut self, list: Vec<usize>, name: &str) -> usize {
        let Catalogue { directory_lists, lookups, .. } = &mut self.catalogue;
        let directories = index_or_push(&mut self.lists, directory_lists, list);
        index_or_push(&mut self.lookups, lookups, Lookup { directories, name: name.into() })
    }

    fn carry_over_directory(&mut self, number: usize) -> usize {
        let fact = &self.store.verdict.directories[number];
        match self.directories.get(&fact.path) {
            Some(known) => *known,
            None => self.add_directory(fact.clone()),
        }
    }

    /// Returns the index of a directory. If it is new, adds it with its current names.
    fn directory(&mut self, path: &Utf8Path) -> usize {
        match self.directories.get(path) {
            Some(known) => *known,
            None => self.add_directory(DirectoryFact::read_current(path, &self.store.base)),
        }
    }

    fn add_directory(&mut self, mut fact: DirectoryFact) -> usize {
        fact.is_doubtful |= !self.run.agrees_with_database(&fact);
        self.directories.insert(fact.path.clone(), self.catalogue.directories.len());
        self.catalogue.directories.push(fact);
        self.catalogue.directories.len() - 1
    }
}

/// Returns the index of a value in a list without duplicates, and appends the value if it is new.
fn index_or_push<T: Clone + Eq + Hash>(numbers: &mut HashMap<T, usize>, all: &mut Vec<T>, value: T) -> usize {
    match numbers.entry(value) {
        Entry::Occupied(known) => *known.get(),
        Entry::Vacant(new) => {
            all.push(new.key().clone());
            *new.insert(all.len() - 1)
        }
    }
}

/// Files and directories that the run accessed.
struct RunFacts<'a> {
    db: &'a Database,
    /// The drawings that were read; `None` for one that could not be read or that changed during the run.
    read: HashMap<Utf8PathBuf, Option<Content>>,
    /// The directories in which lookups were made.
    searched: HashSet<&'a Utf8Path>,
    /// The files that were written or compared.
    written: HashSet<&'a Utf8Path>,
}

/// Hash of a file's bytes, and the stamp under which they were read.
type Content = ([u8; 32], Stamp);

impl<'a> RunFacts<'a> {
    fn new(session: &'a Session<'a>, fresh: &'a [FreshResult<'a>]) -> Self {
        let db = session.db();
        let traces = || fresh.iter().flat_map(|fresh| &fresh.inputs.traces);
        let read = traces().flat_map(|trace| &trace.files);
        let searched = traces().flat_map(|trace| &trace.lookups).flat_map(|lookup| &lookup.directories);
        Self {
            db,
            read: read
                .map(|file| (file.path(db).clone(), content(db, *file).filter(|_| !db.has_drifted(*file))))
                .collect(),
            searched: searched.map(|directory| &**directory).collect(),
            written: fresh
                .iter()
                .flat_map(|fresh| &fresh.inputs.outputs)
                .map(|output| &*output.path)
                .collect(),
        }
    }

    /// Returns the content that was read from a drawing; `None` if it was not read, or not stable.
    fn content(&self, path: &Utf8Path) -> Option<Content> {
        self.read.get(path).copied().flatten()
    }

    /// Whether this run accessed a drawing and got a hash other than this one. A drawing that could not be read, or changed during the run, has the
    /// hash `None`.
    fn has_other_content(&self, path: &Utf8Path, hash: Option<[u8; 32]>) -> bool {
        self.read.get(path).is_some_and(|content| content.map(|(read, _)| read) != hash)
    }

    /// Whether the names in a directory are those that the database saw. Also true if no new result depends on lookups there.
    fn agrees_with_database(&self, fact: &DirectoryFact) -> bool {
        if !self.searched.contains(&*fact.path) {
            return true;
        }
        let mut names: Vec<&str> = drawing_names(self.db, self.db.directory(&fact.path)).iter().collect();
        names.sort_unstable();
        names.into_iter().eq(fact.names.iter().map(|name| &**name))
    }
}

/// The result of checking a drawing, or only of reading it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct DrawingResult {
    /// Names of the drawing's paths.
    #[serde(serialize_with = "serialize_names", deserialize_with = "deserialize_names")]
    pub names: Vec<PathName>,
    /// Diagnostics of the drawing; those of a check also include its paths and everything that they embed.
    pub diagnostics: Vec<Diagnostic>,
    /// Whether the drawing has layers that the configuration names.
    pub layers: NamedLayers,
}

/// Whether a drawing has layers that the configuration names.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct NamedLayers {
    /// Whether the drawing has a layer with clamps.
    pub has_clamps: bool,
    /// Whether the drawing has a layer with finished parts.
    pub has_parts: bool,
}

impl NamedLayers {
    /// Returns which of these layers a drawing has.
    pub fn of(db: &Database, file: SourceFile) -> Self {
        Self { has_clamps: has_clamp_layer(db, file), has_parts: has_part_layer(db, file) }
    }
}

impl DrawingResult {
    /// Whether an error kept the drawing, or a part of it, from being read.
    pub fn is_unread(&self) -> bool {
        self.diagnostics.iter().any(|problem| problem.is_error() && problem.code().number() < 100)
    }

    /// Returns the names and the diagnostics as slices.
    pub fn parts(&self) -> (&[PathName], &[Diagnostic]) {
        (&self.names, &self.diagnostics)
    }

    /// Combines this result with the inputs from which it was computed.
    pub fn with_inputs(self, traces: Vec<Trace>) -> (Self, Inputs) {
        let is_transient = self.diagnostics.iter().any(is_transient);
        (self, Inputs { traces, is_transient, ..Inputs::default() })
    }
}

impl Answer<DrawingResult> {
    /// Returns the path of the drawing that the result is about.
    pub fn drawing(&self) -> &Utf8Path {
        Utf8Path::new(self.subject.split('\0').next().unwrap_or_default())
    }
}

/// Returns the cache subject of a drawing's result, or of the result of some of its paths.
pub(crate) fn subject(drawing: &Utf8Path, paths: Option<&[PathName]>) -> Box<str> {
    let Some(paths) = paths else { return drawing.as_str().into() };
    let names: String = paths.iter().flat_map(|path| ["\0", path.as_str()]).collect();
    format!("{drawing}\0{names}").into()
}

/// Returns the path names of drawings and the diagnostics of reading them, in the order of `paths`. Drawings without a cached result for their
/// `subject` are read.
pub(crate) fn read_drawings(
    session: &Session<'_>,
    memo: &Memo,
    paths: &[Utf8PathBuf],
    subject: impl Fn(&Utf8PathBuf) -> Box<str>,
) -> Vec<Answer<DrawingResult>> {
    let db = session.db();
    let read = |open: &[&Utf8PathBuf]| {
        let files = db.files(open.iter().map(|path| (*path).clone()).collect());
        session.parse_ahead(&files);
        let read = |file: SourceFile| {
            let (names, diagnostics) = (path_names(db, file).to_vec(), check_file(db, file).to_vec());
            let trace = Trace { files: vec![file], lookups: Vec::new() };
            DrawingResult { names, diagnostics, layers: NamedLayers::of(db, file) }.with_inputs(vec![trace])
        };
        files.into_iter().map(read).collect()
    };
    memo.get_or(paths, subject, |_, result| Some(result), read)
}

/// Like [`read_drawings`], for drawings that arguments name. The results are sorted by path, as [`find`] requires.
pub(crate) fn read_named(
    session: &Session<'_>,
    memo: &Memo,
    files: impl Iterator<Item = SourceFile>,
    subject: impl Fn(&Utf8PathBuf) -> Box<str>,
) -> Vec<Answer<DrawingResult>> {
    let mut paths: Vec<Utf8PathBuf> = files.map(|file| file.path(session.db()).clone()).collect();
    paths.sort_unstable_by(|a, b| a.as_str().cmp(b.as_str()));
    paths.dedup();
    read_drawings(session, memo, &paths, subject)
}

impl Session<'_> {
    /// Returns the names of the paths in the library, or below the working directory if there is no library; sorted, without duplicates. At most
    /// `MAX_READ_FOR_NAMES` drawings without a cached result are read.
    pub fn names_of_library(&self) -> Vec<PathName> {
        let paths = self.paths_of_library(MAX_READ_FOR_NAMES);
        let mut names: Vec<PathName> = paths.into_iter().map(|(name, _)| name).collect();
        names.dedup();
        names
    }

    /// Like [`names_of_library`](Self::names_of_library), with the drawings that define the paths. A drawing with a cached result of `check` is not
    /// read again; of the remaining drawings, only the first `most_unknown` are read.
    pub(crate) fn paths_of_library(&self, most_unknown: usize) -> Vec<(PathName, SourceFile)> {
        let (files, _) = self.all_drawings();
        let memo = Memo::of_checks(self.workspace()).unwrap_or_default();
        let read = |open: &[&SourceFile]| {
            let open: Vec<SourceFile> = open.iter().take(most_unknown).map(|file| **file).collect();
            self.parse_ahead(&open);
            let read = |file: SourceFile| {
                let names = path_names(self.db(), file).to_vec();
                (DrawingResult { names, ..DrawingResult::default() }, Inputs::default())
            };
            open.into_iter().map(read).collect()
        };
        let path = |file: &SourceFile| file.path(self.db()).as_str().into();
        let drawings = memo.get_or(&files, path, |_, result| Some(result), read);
        let paths = drawings.into_iter().flat_map(|answer| {
            let file = self.file(answer.drawing());
            answer.value.names.into_iter().map(move |name| (name, file))
        });
        let mut paths: Vec<(PathName, SourceFile)> = paths.collect();
        paths.sort_by(|(a, one), (b, other)| {
            a.cmp(b).then_with(|| one.path(self.db()).cmp(other.path(self.db())))
        });
        paths
    }
}

/// Finds a drawing in answers that are sorted by path.
pub(crate) fn find<'a>(
    answers: &'a [Answer<DrawingResult>],
    drawing: &Utf8Path,
) -> Option<&'a Answer<DrawingResult>> {
    let place = answers.binary_search_by(|answer| answer.drawing().as_str().cmp(drawing.as_str()));
    place.ok().map(|place| &answers[place])
}

/// Whether a diagnostic may disappear although no input changes: another process had locked a file, the machine was busy, or there was a bug.
pub fn is_transient(diagnostic: &Diagnostic) -> bool {
    match diagnostic.code() {
        Code::UnreadableFile | Code::InternalError => true,
        Code::LimitReached => {
            let seconds = ("key", Value::quoted("seconds-per-path"));
            diagnostic.arguments.contains(&seconds)
        }
        _ => false,
    }
}

fn serialize_names<S: Serializer>(names: &[PathName], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(names.iter().map(PathName::as_str))
}

fn deserialize_names<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<PathName>, D::Error> {
    Ok(<Vec<&str>>::deserialize(deserializer)?.into_iter().map(PathName::new).collect())
}
