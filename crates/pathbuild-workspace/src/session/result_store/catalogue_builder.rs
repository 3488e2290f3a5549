//! Builds the catalogue to be stored: results that still hold keep their facts, new results get current ones.

use std::collections::{BTreeSet, HashMap};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_cache::{Catalogue, DirectoryFact, FileFact, FileState, Record};
use pathbuild_db::{Db, NameLookup, SourceFile};
use pathbuild_files::{Clock, Stamp};

use super::lookups::Lookups;
use super::run_facts::{Content, RunFacts};
use super::{ExtraInput, FreshResult, GeneratedFile, ResultStore};
use crate::session::Session;

/// A catalogue under construction.
pub(super) struct CatalogueBuilder<'a> {
    result_store: &'a ResultStore,
    session: &'a Session<'a>,
    begun: Clock,
    catalogue: Catalogue,
    /// Indices of files that were not in the snapshot.
    new_files: HashMap<Utf8PathBuf, usize>,
    directories: HashMap<Utf8PathBuf, usize>,
    lookups: Lookups,
    /// New index of each file, directory and lookup of the snapshot.
    kept_files: Vec<Option<usize>>,
    kept_directories: Vec<Option<usize>>,
    kept_lookups: Vec<Option<usize>>,
    seen: RunFacts<'a>,
}

impl<'a> CatalogueBuilder<'a> {
    pub(super) fn new(
        result_store: &'a ResultStore,
        session: &'a Session<'a>,
        begun: Clock,
        fresh: &'a [FreshResult],
    ) -> Self {
        let kept = &result_store.kept;
        Self {
            result_store,
            session,
            begun,
            catalogue: Catalogue::default(),
            new_files: HashMap::new(),
            directories: HashMap::new(),
            lookups: Lookups::default(),
            kept_files: vec![None; kept.files()],
            kept_directories: vec![None; kept.directories()],
            kept_lookups: vec![None; kept.lookups()],
            seen: RunFacts::new(session, fresh),
        }
    }

    pub(super) fn finish(self) -> Catalogue {
        let Lookups { lists, all, .. } = self.lookups;
        Catalogue { directory_lists: lists, lookups: all, ..self.catalogue }
    }

    /// Carries over a record that was not invalidated, unless this run read other bytes from one of its drawings or generated one of its
    /// files from other inputs.
    pub(super) fn add_kept(&mut self, number: usize) {
        let record = self.result_store.kept.record(number);
        let has_written = |file: usize| self.seen.has_written(self.result_store.kept.file(file).path());
        if record.files().any(|file| self.is_other(file)) || record.outputs().any(has_written) {
            return;
        }
        let files = record.files().map(|file| self.kept_file(file)).collect();
        let lookups = record.lookups().map(|lookup| self.kept_lookup(lookup)).collect();
        let outputs = record.outputs().map(|file| self.kept_file(file)).collect();
        let (subject, payload) = (record.subject().into(), record.payload().to_vec());
        self.catalogue.records.push(Record { subject, files, lookups, outputs, payload });
    }

    /// Adds a new result, unless one of its drawings could not be read or changed during the run: such a result is not stable.
    pub(super) fn add_fresh(&mut self, result: &FreshResult) {
        let Some(payload) = &result.payload else { return };
        let db = self.session.db();
        let mut drawings = result.traces.iter().flat_map(|trace| &trace.files);
        if drawings.any(|file| self.seen.content(file.path(db)).is_none()) {
            return;
        }
        let mut files = BTreeSet::new();
        let mut lookups = BTreeSet::new();
        for trace in &result.traces {
            files.extend(trace.files.iter().map(|file| self.drawing(*file)));
            lookups.extend(trace.lookups.iter().map(|lookup| self.lookup(lookup)));
        }
        files.extend(result.further.iter().map(|file| self.further_file(file)));
        let outputs = result.outputs.iter().map(|output| self.output(output)).collect();
        self.catalogue.records.push(Record {
            subject: result.subject.clone(),
            files: files.into_iter().collect(),
            lookups: lookups.into_iter().collect(),
            outputs,
            payload: payload.clone(),
        });
    }

    /// Whether this run read other bytes than the snapshot has for a file that was not verified.
    fn is_other(&self, number: usize) -> bool {
        let file = self.result_store.kept.file(number);
        self.result_store.verdict.files[number] == FileState::Unchecked
            && self.seen.is_other(file.path(), file.hash())
    }

    fn kept_file(&mut self, number: usize) -> usize {
        if let Some(new) = self.kept_files[number] {
            return new;
        }
        let file = self.result_store.kept.file(number);
        let mut fact = FileFact { path: file.path().to_owned(), stamp: file.stamp(), hash: file.hash() };
        match self.result_store.verdict.files[number] {
            FileState::Unchanged | FileState::Unchecked => {}
            FileState::Touched(stamp) => fact.stamp = stamp.settled(self.begun),
            // The output is out of date. The hash stays, because it describes the expected content.
            FileState::Changed => fact.stamp = Stamp::UNKNOWN,
        }
        // If the file has changed since it was compared, it is unclear which content a result belongs to.
        if self.seen.is_other(&fact.path, fact.hash) {
            (fact.stamp, fact.hash) = (Stamp::UNKNOWN, None);
        }
        self.add_kept_file(number, fact)
    }

    /// Adds a drawing that was read in this run.
    fn drawing(&mut self, file: SourceFile) -> usize {
        let path = file.path(self.session.db());
        let number = self.result_store.kept.find_file(path);
        let is_known = |number: &usize| {
            self.result_store.verdict.files[*number] != FileState::Changed && !self.is_other(*number)
        };
        match number.filter(is_known) {
            Some(number) => self.kept_file(number),
            None => self.new_file(path, self.seen.content(path)),
        }
    }

    /// Adds a file other than a drawing. If results were computed from different contents, it is unclear which content a result belongs to.
    fn further_file(&mut self, ExtraInput { path, hash }: &ExtraInput) -> usize {
        let mut room = Vec::new();
        let limit = self.session.workspace().settings.limits.file_size.value;
        let now = self.session.db().system().read_stamped(path, limit, &mut room);
        let stamp = now.ok().filter(|(bytes, _)| Some(*blake3::hash(bytes).as_bytes()) == *hash);
        let stamp = stamp.map_or(Stamp::UNKNOWN, |(_, stamp)| stamp);
        let number = self.new_file(path, hash.map(|hash| (hash, stamp)));
        let fact = &mut self.catalogue.files[number];
        if fact.hash != *hash {
            (fact.stamp, fact.hash) = (Stamp::UNKNOWN, None);
        }
        number
    }

    /// Records an output file written or compared in this run.
    fn output(&mut self, GeneratedFile { path, hash, is_there }: &GeneratedFile) -> usize {
        let stamp = if *is_there { Stamp::of(path).settled(self.begun) } else { Stamp::UNKNOWN };
        // If the file has vanished meanwhile, the stamp does not belong to the hash.
        let stamp = if stamp == Stamp::MISSING { Stamp::UNKNOWN } else { stamp };
        self.push_file(FileFact { path: path.clone(), stamp, hash: Some(*hash) })
    }

    /// Adds a file. One that could not be read gets neither stamp nor hash, so that its results are recomputed.
    fn new_file(&mut self, path: &Utf8Path, content: Option<Content>) -> usize {
        let stamp = content.map_or(Stamp::UNKNOWN, |(_, stamp)| stamp.settled(self.begun));
        self.push_file(FileFact { path: path.to_owned(), stamp, hash: content.map(|(hash, _)| hash) })
    }

    fn push_file(&mut self, fact: FileFact) -> usize {
        if let Some(kept) = self.result_store.kept.find_file(&fact.path) {
            return self.add_kept_file(kept, fact);
        }
        if let Some(known) = self.new_files.get(&fact.path) {
            return *known;
        }
        self.new_files.insert(fact.path.clone(), self.catalogue.files.len());
        self.add_file(fact)
    }

    /// Adds a fact about a file that is already in the snapshot; the first fact wins.
    fn add_kept_file(&mut self, number: usize, fact: FileFact) -> usize {
        if let Some(known) = self.kept_files[number] {
            return known;
        }
        let new = self.add_file(fact);
        self.kept_files[number] = Some(new);
        new
    }

    fn add_file(&mut self, fact: FileFact) -> usize {
        self.catalogue.files.push(fact);
        self.catalogue.files.len() - 1
    }

    fn kept_lookup(&mut self, number: usize) -> usize {
        if let Some(new) = self.kept_lookups[number] {
            return new;
        }
        let kept = &self.result_store.kept;
        let (directories, name) = kept.lookup(number);
        let list = kept.directory_list(directories).map(|directory| self.kept_directory(directory)).collect();
        let new = self.lookups.number(list, name);
        self.kept_lookups[number] = Some(new);
        new
    }

    /// Adds a lookup made in this run.
    fn lookup(&mut self, lookup: &NameLookup) -> usize {
        let list = lookup.directories.iter().map(|directory| self.directory(directory)).collect();
        self.lookups.number(list, lookup.name.as_str())
    }

    fn kept_directory(&mut self, number: usize) -> usize {
        if let Some(new) = self.kept_directories[number] {
            return new;
        }
        let fact = self.result_store.verdict.directories[number].clone();
        let new = self.push_directory(fact);
        self.kept_directories[number] = Some(new);
        new
    }

    /// Adds a directory with its current names.
    fn directory(&mut self, path: &Utf8Path) -> usize {
        if let Some(known) = self.directories.get(path) {
            return *known;
        }
        let fact = DirectoryFact::now(path, &self.result_store.base);
        self.push_directory(fact)
    }

    fn push_directory(&mut self, mut fact: DirectoryFact) -> usize {
        if let Some(known) = self.directories.get(&fact.path) {
            return *known;
        }
        fact.is_doubtful |= !self.seen.agrees(&fact);
        let number = self.catalogue.directories.len();
        self.directories.insert(fact.path.clone(), number);
        self.catalogue.directories.push(fact);
        number
    }
}
