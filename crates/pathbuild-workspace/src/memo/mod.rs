//! The memo: cached results of earlier runs, for commands that process a whole library. Other modules access the cache through it only. (crate
//! pathbuild-cache)

mod builder;
mod store;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_cache::{Listings, Reason, decode};
use pathbuild_db::{Database, SourceFile};
use serde::de::DeserializeOwned;

use crate::config::ResultKind;
use crate::inputs::Inputs as Arguments;
use crate::session::{ArgumentMatches, Session};
use crate::workspace::Workspace;

use crate::memo::store::Scope;
pub use builder::{DrawingResult, NamedLayers, is_transient};
pub(crate) use builder::{find, read_drawings, read_named, subject};
use store::Store;
pub use store::{Answer, Dependencies, FreshResult, GeneratedFile, Inputs, OutputState, hash_output};
pub use store::{BUILD, Coverage, CoveredPaths};

/// Cached results of a command; `None` if the run uses no cache.
#[derive(Debug, Default)]
pub struct Memo(Option<Store>);

impl Memo {
    /// Loads the results of earlier runs, unless the session does not trace its inputs. `text` is the part of the cache key besides settings and
    /// files. Drawings without a cached result are read ahead.
    pub fn open(
        session: &Session<'_>,
        kind: ResultKind,
        text: &str,
        arguments: &Arguments,
        matches: &mut ArgumentMatches,
    ) -> Self {
        if !session.is_traced() {
            return Self(None);
        }
        let (scope, listings) = (Scope::of(session, matches), std::mem::take(&mut matches.listings));
        let memo = Self(Store::open(session.workspace(), kind, text, scope, listings));
        let is_known = |file: SourceFile| memo.knows(file.path(session.db()));
        session.prefetch(arguments, &is_known);
        memo
    }

    /// Loads the results of earlier checks with example values; `None` if results are not cached.
    pub fn of_checks(workspace: &Workspace) -> Option<Self> {
        let store =
            Store::open(workspace, ResultKind::Check, &check_query(false), Scope::All, Listings::new());
        store.map(|store| Self(Some(store)))
    }

    /// Loads the results of earlier verifications of these programs. `text` is the part of the cache key besides settings and files. `directories`
    /// were searched for programs.
    pub(crate) fn of_programs(
        session: &Session<'_>,
        text: &str,
        programs: &[Utf8PathBuf],
        directories: &[Utf8PathBuf],
    ) -> Self {
        if !session.is_traced() {
            return Self(None);
        }
        let names = |paths: &[Utf8PathBuf]| paths.iter().map(ToString::to_string).collect();
        let scope = Scope::Drawings { drawings: names(programs), directories: names(directories) };
        Self(Store::open(session.workspace(), ResultKind::Emit, text, scope, Listings::new()))
    }

    /// Returns the result for each item, in the order of the items: the cached one if it still holds and `accept` takes it, otherwise one that
    /// `build` computes. `build` gets all items without an accepted cached result at once. If it computes fewer results than it gets items, the last
    /// of these items are left out.
    pub fn get_or<K, T: DeserializeOwned>(
        &self,
        items: &[K],
        subject: impl Fn(&K) -> Box<str>,
        accept: impl Fn(&str, T) -> Option<T>,
        build: impl FnOnce(&[&K]) -> Vec<(T, Inputs)>,
    ) -> Vec<Answer<T>> {
        let subjects: Vec<Box<str>> = items.iter().map(subject).collect();
        let cached = |subject: &str| accept(subject, decode(self.0.as_ref()?.payload(subject)?).ok()?);
        let cached: Vec<Option<T>> = subjects.iter().map(|subject| cached(subject)).collect();
        let open = items.iter().zip(&cached).filter(|(_, cached)| cached.is_none());
        let open: Vec<&K> = open.map(|(item, _)| item).collect();
        let mut built = build(&open).into_iter();
        let answer = |(subject, cached): (Box<str>, Option<T>)| {
            let (value, inputs) = match cached {
                Some(value) => (value, None),
                None => built.next().map(|(value, inputs)| (value, Some(inputs)))?,
            };
            Some(Answer { subject, value, inputs })
        };
        let mut answers = Vec::with_capacity(items.len());
        answers.extend(subjects.into_iter().zip(cached).filter_map(answer));
        answers
    }

    /// Whether results of this run are cached.
    pub fn is_some(&self) -> bool {
        self.0.is_some()
    }

    /// Whether an earlier run's result about this subject still holds.
    pub fn holds(&self, subject: &str) -> bool {
        self.0.as_ref().is_some_and(|store| store.payload(subject).is_some())
    }

    /// Whether the names of a drawing's paths are cached.
    fn knows(&self, drawing: &Utf8Path) -> bool {
        self.holds(drawing.as_str()) || self.holds(&subject(drawing, Some(&[])))
    }

    /// Returns the states of the files that were generated from a cached result, in the order in which they were stored.
    pub fn outputs(&self, subject: &str) -> Vec<OutputState> {
        self.0.as_ref().map(|store| store.outputs(subject)).unwrap_or_default()
    }

    /// Returns the inputs of a result; `None` if they are unknown.
    pub fn dependencies<'a, T>(
        &'a self,
        db: &'a Database,
        answer: &'a Answer<T>,
    ) -> Option<Dependencies<'a>> {
        match &answer.inputs {
            Some(inputs) => Some(Dependencies::of(db, &inputs.traces)),
            None => self.0.as_ref()?.dependencies(&answer.subject),
        }
    }

    /// Returns the reasons why a cached result no longer holds: an empty list if it holds; `None` if there is no such result.
    pub fn invalidation_reasons(&self, subject: &str) -> Option<Vec<Reason>> {
        self.0.as_ref()?.invalidation_reasons(subject)
    }

    /// Stores new results together with cached results that still hold, including those of drawings outside this run. Writes nothing if nothing has
    /// changed.
    pub fn store_results<'a>(&self, session: &Session<'_>, fresh: impl Iterator<Item = FreshResult<'a>>) {
        if let Some(store) = &self.0 {
            store.store_results(session, &fresh.collect::<Vec<_>>());
        }
    }
}

/// Returns the part of the cache key of `check` besides drawings and settings.
pub(crate) fn check_query(with_all_values: bool) -> String {
    format!("check {with_all_values}")
}
