//! The memo: results of earlier runs, for commands that process a whole library. No other module accesses them. (crate pathbuild-cache)
//!
//! Only results of the database are cached, not what the configuration derives from them (severities, baselines, output formats).

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
pub use builder::{DrawingResult, is_transient};
pub(crate) use builder::{find, read_drawings, subject};
use store::Store;
pub use store::{Answer, Dependencies, FreshResult, GeneratedFile, Inputs, OutputState, hash_output};
pub use store::{BUILD, Coverage, CoveredPaths};

/// Results of earlier runs of a command, if there are any.
#[derive(Debug, Default)]
pub struct Memo(Option<Store>);

impl Memo {
    /// Loads the results of earlier runs. `text` is what they depend on besides settings and files. No results are known if the session does
    /// not trace its inputs. Drawings that have to be read are read ahead.
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

    /// Results of the last checks; `None` if no results are cached.
    pub fn of_checks(workspace: &Workspace) -> Option<Self> {
        let store =
            Store::open(workspace, ResultKind::Check, &check_query(false), Scope::All, Listings::new());
        store.map(|store| Self(Some(store)))
    }

    /// Results of earlier verifications of these programs. `text` is what they depend on besides settings and files. `directories` were
    /// searched for programs.
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

    /// The result for each item: that of an earlier run if it still holds and `accept` takes it, otherwise the one that `build` computes. It
    /// gets all open items at once, and may compute fewer results than it gets items. The results are in the order of the items.
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

    /// Whether there is any cache.
    pub fn is_some(&self) -> bool {
        self.0.is_some()
    }

    /// Whether an earlier run's result about this subject still holds.
    pub fn holds(&self, subject: &str) -> bool {
        self.0.as_ref().is_some_and(|store| store.payload(subject).is_some())
    }

    /// Whether the paths of a drawing are known.
    fn knows(&self, drawing: &Utf8Path) -> bool {
        self.holds(drawing.as_str()) || self.holds(&subject(drawing, Some(&[])))
    }

    /// States of the files that were generated from a cached result, in the order in which they were stored.
    pub fn outputs(&self, subject: &str) -> Vec<OutputState> {
        self.0.as_ref().map(|store| store.outputs(subject)).unwrap_or_default()
    }

    /// The inputs of a result; `None` if they are unknown.
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

    /// Why a cached result no longer holds: empty if it holds, `None` if there is none.
    pub fn why(&self, subject: &str) -> Option<Vec<Reason>> {
        self.0.as_ref()?.why(subject)
    }

    /// Stores new results together with those that still hold, including results of other drawings. Writes nothing if nothing has changed.
    pub fn keep<'a>(&self, session: &Session<'_>, fresh: impl Iterator<Item = FreshResult<'a>>) {
        if let Some(store) = &self.0 {
            store.keep(session, &fresh.collect::<Vec<_>>());
        }
    }
}

/// Everything that results of `check` depend on besides drawings and settings.
pub(crate) fn check_query(with_all_values: bool) -> String {
    format!("check {with_all_values}")
}
