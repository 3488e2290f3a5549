//! Putting together what is kept: results that still hold with what was known of their files, new ones with what is known now.

use std::collections::{BTreeSet, HashMap};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_cache::{
    Catalogue, Clock, DirectoryFact, FileFact, FileState, ListingKind, Lookup, Record, Stamp,
};
use pathbuild_db::{Db, SourceFile, content_hash, drawing_names};

use super::{Content, Keeper, Made};
use crate::session::Session;

/// A catalogue while it is put together.
pub(super) struct Writing<'a> {
    keeper: &'a Keeper,
    session: &'a Session<'a>,
    begun: Clock,
    catalogue: Catalogue,
    files: HashMap<Utf8PathBuf, usize>,
    directories: HashMap<(ListingKind, Utf8PathBuf), usize>,
    /// The new number of each kept file and directory.
    kept_files: Vec<Option<usize>>,
    kept_directories: Vec<Option<usize>>,
    /// The drawings that this run read, with what it read.
    read: HashMap<Utf8PathBuf, Option<[u8; 32]>>,
}

impl<'a> Writing<'a> {
    pub(super) fn new(keeper: &'a Keeper, session: &'a Session<'a>, begun: Clock, made: &[Made]) -> Self {
        let kept = &keeper.kept;
        let db = session.db();
        let read = made.iter().flat_map(|made| &made.traces).flat_map(|trace| &trace.files);
        Self {
            keeper,
            session,
            begun,
            catalogue: Catalogue::default(),
            files: HashMap::new(),
            directories: HashMap::new(),
            kept_files: vec![None; kept.files()],
            kept_directories: vec![None; kept.directories()],
            read: read.map(|file| (file.path(db).clone(), content_hash(db, *file))).collect(),
        }
    }

    pub(super) fn finish(self) -> Catalogue {
        self.catalogue
    }

    /// Takes over a record that still holds.
    pub(super) fn add_kept(&mut self, number: usize) {
        let record = self.keeper.kept.record(number);
        let files = record.files().map(|file| self.kept_file(file)).collect();
        let lookup = |lookup: Lookup| Lookup { directory: self.kept_directory(lookup.directory), ..lookup };
        let lookups = record.lookups().map(lookup).collect();
        let (of, payload) = (record.of().into(), record.payload().to_vec());
        self.catalogue.records.push(Record { of, files, lookups, payload });
    }

    /// Adds a record that was made now.
    pub(super) fn add_made(&mut self, made: &Made) {
        let Some(payload) = &made.payload else { return };
        let mut files = BTreeSet::new();
        let mut lookups = BTreeSet::new();
        for trace in &made.traces {
            files.extend(trace.files.iter().map(|file| self.drawing(*file)));
            for sought in &trace.lookups {
                for directory in &sought.directories {
                    let directory = self.directory(directory, ListingKind::Drawings);
                    lookups.insert(Lookup { directory, name: sought.name.as_str().into() });
                }
            }
        }
        files.extend(made.programs.files.iter().map(|(file, content)| self.program(file, *content)));
        for directory in &made.programs.directories {
            let directory = self.directory(directory, ListingKind::Files);
            lookups.insert(Lookup { directory, name: "".into() });
        }
        self.catalogue.records.push(Record {
            of: made.of.clone(),
            files: files.into_iter().collect(),
            lookups: lookups.into_iter().collect(),
            payload: payload.clone(),
        });
    }

    fn kept_file(&mut self, number: usize) -> usize {
        if let Some(new) = self.kept_files[number] {
            return new;
        }
        let file = self.keeper.kept.file(number);
        let mut fact = FileFact { path: file.path().to_owned(), stamp: file.stamp(), hash: file.hash() };
        if self.keeper.verdict.files[number] != FileState::Resting {
            fact.stamp = Stamp::settled(&fact.path, self.begun);
        }
        // Were it read anew since it was compared, and were other bytes found, nobody could say which of them a result is of.
        if self.read.get(&fact.path).is_some_and(|hash| *hash != fact.hash) || self.is_torn(&fact.path) {
            (fact.stamp, fact.hash) = (Stamp::UNKNOWN, None);
        }
        let new = self.push_file(fact);
        self.kept_files[number] = Some(new);
        new
    }

    /// A drawing that was read now.
    fn drawing(&mut self, file: SourceFile) -> usize {
        let db = self.session.db();
        let path = file.path(db);
        let hash = content_hash(db, file);
        let known = self.keeper.kept.file_of(path);
        match known.filter(|number| self.keeper.verdict.files[*number] != FileState::Changed) {
            Some(number) => self.kept_file(number),
            None => self.new_file(path, hash),
        }
    }

    /// A program that was looked at now.
    fn program(&mut self, path: &Utf8Path, content: Content) -> usize {
        let number = match content {
            Content::Hashed(hash) => self.new_file(path, Some(hash)),
            Content::Missing | Content::Unknown => self.new_file(path, None),
        };
        let fact = &mut self.catalogue.files[number];
        // It may have come or gone since it was looked at.
        if (fact.stamp == Stamp::MISSING) != (content == Content::Missing) {
            fact.stamp = Stamp::UNKNOWN;
        }
        number
    }

    fn new_file(&mut self, path: &Utf8Path, hash: Option<[u8; 32]>) -> usize {
        if let Some(known) = self.files.get(path) {
            return *known;
        }
        let mut stamp = Stamp::settled(path, self.begun);
        // What was read was there.
        if hash.is_some() && stamp == Stamp::MISSING {
            stamp = Stamp::UNKNOWN;
        }
        let hash = hash.filter(|_| !self.is_torn(path));
        self.push_file(FileFact { path: path.to_owned(), stamp, hash })
    }

    /// Whether a drawing changed while this run went on, which may have read it twice.
    fn is_torn(&self, path: &Utf8Path) -> bool {
        self.read.contains_key(path) && Stamp::has_changed_since(path, self.begun)
    }

    fn push_file(&mut self, fact: FileFact) -> usize {
        if let Some(known) = self.files.get(&fact.path) {
            return *known;
        }
        let number = self.catalogue.files.len();
        self.files.insert(fact.path.clone(), number);
        self.catalogue.files.push(fact);
        number
    }

    fn kept_directory(&mut self, number: usize) -> usize {
        if let Some(new) = self.kept_directories[number] {
            return new;
        }
        let fact = self.keeper.verdict.directories[number].clone();
        let new = self.push_directory(fact);
        self.kept_directories[number] = Some(new);
        new
    }

    /// A directory that was listed now, with the names that the database saw in it.
    fn directory(&mut self, path: &Utf8Path, kind: ListingKind) -> usize {
        if let Some(known) = self.directories.get(&(kind, path.to_owned())) {
            return *known;
        }
        let fact = DirectoryFact::now(path, kind, &self.keeper.base);
        self.push_directory(fact)
    }

    fn push_directory(&mut self, mut fact: DirectoryFact) -> usize {
        let place = (fact.kind, fact.path.clone());
        if let Some(known) = self.directories.get(&place) {
            return *known;
        }
        fact.is_doubtful |= !self.is_what_was_seen(&fact);
        let number = self.catalogue.directories.len();
        self.directories.insert(place, number);
        self.catalogue.directories.push(fact);
        number
    }

    /// Whether the database found the same names, if it looked. That it looks now does no harm: then there is nothing that could differ.
    fn is_what_was_seen(&self, fact: &DirectoryFact) -> bool {
        if fact.kind == ListingKind::Files {
            return true;
        }
        let db = self.session.db();
        let mut seen: Vec<&str> = drawing_names(db, db.directory(&fact.path)).iter().collect();
        seen.sort_unstable();
        seen.into_iter().eq(fact.names.iter())
    }
}
