//! The environment of a run, and the interface through which it tells a waiting user about its progress. Results are returned and not reported.

use std::fmt::Debug;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use camino::{Utf8Component, Utf8Path, Utf8PathBuf};
use pathbuild_cache::{CacheLocation, TreeStore};
use pathbuild_db::System;
use pathbuild_db::system::with_forward_slashes;
use pathbuild_diagnostic::{Diagnostic, Lang};

use crate::config::{Origin, Settings};

/// The environment of a run: settings, files, languages and directories.
#[derive(Clone, Debug)]
pub struct Workspace {
    /// Settings from the configuration and the command line.
    pub settings: Settings,
    /// The file system that all commands use.
    pub system: Arc<dyn System>,
    /// Language of messages that the user has chosen: with `--lang`, with `PATHBUILD_LANG`, or in the configuration of the user. The configuration of
    /// a library does not change it.
    pub own_lang: Option<Lang>,
    /// Language of the system's locale, used for messages if neither the user nor the configuration chooses one.
    pub system_lang: Option<Lang>,
    /// Directory against which relative paths are resolved.
    pub working_directory: Utf8PathBuf,
    /// Number of worker threads; `None` means one per core.
    pub jobs: Option<u16>,
    /// Place where results are cached; `None` disables the cache.
    pub cache: Option<CacheLocation>,
    /// Receives messages about the progress of the run.
    pub reporter: Arc<dyn Reporter>,
    /// Whether a waiver with an end date has accepted a finding, so the result depends on the date of the run.
    pub is_date_decisive: Arc<AtomicBool>,
}

impl Workspace {
    /// Whether the configuration names a library, so that commands work without arguments.
    pub fn has_library(&self) -> bool {
        !self.settings.general.library.value.is_empty()
    }

    /// Whether results are cached for later runs; this requires a configuration.
    pub fn caches_results(&self) -> bool {
        self.cache_store().is_some()
    }

    /// Returns the cache of this tree; `None` without a configuration, or if caching is disabled.
    pub fn cache_store(&self) -> Option<TreeStore> {
        Some(TreeStore::of_tree(self.cache.as_ref()?, self.settings.directory()?))
    }

    /// Returns the path of the working directory's configuration, relative to that directory, if the configuration does not apply to this run because
    /// the inputs lie outside its tree.
    pub fn unused_configuration(&self) -> Option<Utf8PathBuf> {
        let file = self.settings.not_used.as_deref()?;
        Some(relative(file, &self.working_directory))
    }

    /// Returns the path, relative to the working directory, of a file that was probably meant as the configuration, if there is none.
    pub fn misnamed_configuration(&self) -> Option<Utf8PathBuf> {
        Some(relative(self.settings.misnamed.as_deref()?, &self.working_directory))
    }

    /// Returns the path of the configuration, relative to the working directory, if it applies to a program unexpectedly.
    pub fn unexpected_configuration(&self) -> Option<Utf8PathBuf> {
        let file = self.settings.file.as_deref().filter(|_| self.settings.is_unexpected)?;
        Some(relative(file, &self.working_directory))
    }

    /// Returns a copy with `compatible` switched on or off, which caches nothing and reports nothing.
    pub fn with_compatible_mode(&self, is_compatible: bool) -> Self {
        let mut settings = self.settings.clone();
        settings.general.compatible.value = is_compatible;
        Self { settings, cache: None, reporter: Arc::new(SilentReporter), ..self.clone() }
    }

    /// Returns the language of messages. Comments in programs use [`Settings::comment_lang`].
    pub fn lang(&self) -> Lang {
        let configured = &self.settings.general.lang;
        let fallback = self.system_lang.filter(|_| configured.origin == Origin::Default);
        self.own_lang.or(fallback).unwrap_or(configured.value)
    }

    /// Returns the phrase in the language of messages.
    pub fn choose<'a>(&self, en: &'a str, de: &'a str) -> &'a str {
        self.lang().choose(en, de)
    }

    /// Returns the phrase in the language of messages, with `value` in place of `{}`.
    pub fn phrase(&self, en: &str, de: &str, value: &str) -> String {
        self.choose(en, de).replace("{}", value)
    }

    /// Reports for how many subjects, which are named in English and German, results of earlier runs are used.
    pub(crate) fn report_cached(&self, [en, de]: [&str; 2], known: usize, all: usize) {
        let subjects = self.choose(en, de);
        let phrase = self.choose("with valid cached results", "mit gültigen gespeicherten Ergebnissen");
        self.reporter.detail(&format!("{subjects} {phrase}: {known} / {all}"));
    }
}

/// A receiver of progress messages of a run, which may come from any thread.
pub trait Reporter: Debug + Send + Sync {
    /// Reports a line about the progress of the run.
    fn status(&self, line: &str);
    /// Reports a line of detail, which is shown only on request.
    fn detail(&self, line: &str);
    /// Starts a progress display for `total` items. It ends when the returned value is dropped.
    fn progress(&self, total: usize) -> Box<dyn ProgressCounter>;
}

/// A counter of the finished items of a progress display.
pub trait ProgressCounter: Debug + Send + Sync {
    /// Counts one more finished item. May be called from any thread.
    fn advance(&self);
}

/// A reporter that discards all messages.
#[derive(Clone, Copy, Debug, Default)]
pub struct SilentReporter;

impl Reporter for SilentReporter {
    fn status(&self, _: &str) {}

    fn detail(&self, _: &str) {}

    fn progress(&self, _: usize) -> Box<dyn ProgressCounter> {
        Box::new(Self)
    }
}

impl ProgressCounter for SilentReporter {
    fn advance(&self) {}
}

/// Returns the path to a directory relative to another, both absolute. Returns the directory itself if there is no relative path, as between
/// drives.
pub fn relative(directory: &Utf8Path, base: &Utf8Path) -> Utf8PathBuf {
    let (target, start): (Vec<_>, Vec<_>) = (directory.components().collect(), base.components().collect());
    let common = target.iter().zip(&start).take_while(|(a, b)| a == b).count();
    if common == 0 {
        return directory.to_owned();
    }
    let up = start[common..].iter().map(|_| Utf8Component::ParentDir);
    let relative: Utf8PathBuf = up.chain(target[common..].iter().copied()).collect();
    if relative.as_str().is_empty() { Utf8PathBuf::from(".") } else { with_forward_slashes(relative) }
}

/// The reason why a request cannot be answered.
#[derive(Debug)]
pub enum Failure {
    /// The request is invalid, for this reason in the language of messages.
    Usage(String),
    /// A file that the request depends on, such as a configuration or a baseline, cannot be read or has these errors.
    Refused(Vec<Diagnostic>),
    /// The post-processor does not exist, or is broken.
    Post(Vec<Diagnostic>),
    /// The subject of the request is unknown or has these errors.
    Found(Vec<Diagnostic>),
}

impl Failure {
    /// Returns the errors; empty if the request itself is invalid.
    pub fn into_diagnostics(self) -> Vec<Diagnostic> {
        match self {
            Self::Usage(_) => Vec::new(),
            Self::Refused(found) | Self::Post(found) | Self::Found(found) => found,
        }
    }
}
