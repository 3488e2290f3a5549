//! Putting together what is kept: results that still hold with what was known of their files, new ones with what is known now.

use std::collections::{BTreeSet, HashMap};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_cache::{Catalogue, Clock, DirectoryFact, FileFact, FileState, Record, Stamp};
use pathbuild_db::{Db, NameLookup, SourceFile};

use super::lookups::Lookups;
use super::seen::{Content, Seen};
use super::{FreshResult, FurtherFile, MadeOutput, ResultStore};
use crate::session::Session;

/// A catalogue while it is put together.
pub(super) struct Writing<'a> {
    result_store: &'a ResultStore,
    session: &'a Session<'a>,
    begun: Clock,
    catalogue: Catalogue,
    /// The number of each file of which nothing was kept.
    new_files: HashMap<Utf8PathBuf, usize>,
    directories: HashMap<Utf8PathBuf, usize>,
    lookups: Lookups,
    /// The new number of each kept file, directory and question.
    kept_files: Vec<Option<usize>>,
    kept_directories: Vec<Option<usize>>,
    kept_lookups: Vec<Option<usize>>,
    seen: Seen<'a>,
}

impl<'a> Writing<'a> {
    pub(super) fn new(
        result_store: &'a ResultStore,
        session: &'a Session<'a>,
        begun: Clock,
        made: &'a [FreshResult],
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
            seen: Seen::new(session, made),
        }
    }

    pub(super) fn finish(self) -> Catalogue {
        let Lookups { lists, all, .. } = self.lookups;
        Catalogue { directory_lists: lists, lookups: all, ..self.catalogue }
    }

    /// Takes over a record against which nothing was known, unless this run read something else in one of its drawings, or made one of
    /// its files of something else.
    pub(super) fn add_kept(&mut self, number: usize) {
        let record = self.result_store.kept.record(number);
        let has_written = |file: usize| self.seen.has_written(self.result_store.kept.file(file).path());
        if record.files().any(|file| self.is_other(file)) || record.outputs().any(has_written) {
            return;
        }
        let files = record.files().map(|file| self.kept_file(file)).collect();
        let lookups = record.lookups().map(|lookup| self.kept_lookup(lookup)).collect();
        let outputs = record.outputs().map(|file| self.kept_file(file)).collect();
        let (of, payload) = (record.of().into(), record.payload().to_vec());
        self.catalogue.records.push(Record { of, files, lookups, outputs, payload });
    }

    /// Adds a record that was made now; not where a drawing could not be read, or changed meanwhile: what follows from that passes with it.
    pub(super) fn add_made(&mut self, made: &FreshResult) {
        let Some(payload) = &made.payload else { return };
        let db = self.session.db();
        let mut drawings = made.traces.iter().flat_map(|trace| &trace.files);
        if drawings.any(|file| self.seen.content(file.path(db)).is_none()) {
            return;
        }
        let mut files = BTreeSet::new();
        let mut lookups = BTreeSet::new();
        for trace in &made.traces {
            files.extend(trace.files.iter().map(|file| self.drawing(*file)));
            lookups.extend(trace.lookups.iter().map(|sought| self.lookup(sought)));
        }
        files.extend(made.further.iter().map(|file| self.further_file(file)));
        let outputs = made.outputs.iter().map(|output| self.output(output)).collect();
        self.catalogue.records.push(Record {
            of: made.of.clone(),
            files: files.into_iter().collect(),
            lookups: lookups.into_iter().collect(),
            outputs,
            payload: payload.clone(),
        });
    }

    /// Whether this run read other bytes than those that are known of a file at which it did not look before.
    fn is_other(&self, number: usize) -> bool {
        let file = self.result_store.kept.file(number);
        self.result_store.verdict.files[number] == FileState::Unlooked
            && self.seen.is_other(file.path(), file.hash())
    }

    fn kept_file(&mut self, number: usize) -> usize {
        if let Some(new) = self.kept_files[number] {
            return new;
        }
        let file = self.result_store.kept.file(number);
        let mut fact = FileFact { path: file.path().to_owned(), stamp: file.stamp(), hash: file.hash() };
        match self.result_store.verdict.files[number] {
            FileState::Resting | FileState::Unlooked => {}
            FileState::Restored(stamp) => fact.stamp = stamp.settled(self.begun),
            // An output that is not what it should be: its hash is still that of what should be there.
            FileState::Changed => fact.stamp = Stamp::UNKNOWN,
        }
        // Were it read anew since it was compared, and were other bytes found, nobody could say which of them a result is of.
        if self.seen.is_other(&fact.path, fact.hash) {
            (fact.stamp, fact.hash) = (Stamp::UNKNOWN, None);
        }
        self.add_kept_file(number, fact)
    }

    /// A drawing that was read now.
    fn drawing(&mut self, file: SourceFile) -> usize {
        let path = file.path(self.session.db());
        let known = self.result_store.kept.file_of(path);
        let is_known = |number: &usize| {
            self.result_store.verdict.files[*number] != FileState::Changed && !self.is_other(*number)
        };
        match known.filter(is_known) {
            Some(number) => self.kept_file(number),
            None => self.new_file(path, self.seen.content(path)),
        }
    }

    /// A file beside drawings that was read for a result. Where others were made of other bytes, nobody can say which of them a result is of.
    fn further_file(&mut self, FurtherFile { path, hash }: &FurtherFile) -> usize {
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

    /// A file that was written, or compared, now.
    fn output(&mut self, MadeOutput { path, hash, is_there }: &MadeOutput) -> usize {
        let stamp = if *is_there { Stamp::of(path).settled(self.begun) } else { Stamp::UNKNOWN };
        // Were it gone by now, the hash would be of something else.
        let stamp = if stamp == Stamp::MISSING { Stamp::UNKNOWN } else { stamp };
        self.push_file(FileFact { path: path.clone(), stamp, hash: Some(*hash) })
    }

    /// What could not be read has neither stamp nor hash: whatever was made of it is made again.
    fn new_file(&mut self, path: &Utf8Path, content: Option<Content>) -> usize {
        let stamp = content.map_or(Stamp::UNKNOWN, |(_, stamp)| stamp.settled(self.begun));
        self.push_file(FileFact { path: path.to_owned(), stamp, hash: content.map(|(hash, _)| hash) })
    }

    fn push_file(&mut self, fact: FileFact) -> usize {
        if let Some(kept) = self.result_store.kept.file_of(&fact.path) {
            return self.add_kept_file(kept, fact);
        }
        if let Some(known) = self.new_files.get(&fact.path) {
            return *known;
        }
        self.new_files.insert(fact.path.clone(), self.catalogue.files.len());
        self.add_file(fact)
    }

    /// Of a file of which something was kept, what is known now; what came first holds.
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

    /// A question that was asked now.
    fn lookup(&mut self, sought: &NameLookup) -> usize {
        let list = sought.directories.iter().map(|directory| self.directory(directory)).collect();
        self.lookups.number(list, sought.name.as_str())
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

    /// A directory that was listed now, with the names that the database saw in it.
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
