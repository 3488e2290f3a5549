use std::rc::Rc;
use std::sync::Arc;

use camino::Utf8PathBuf;
use pathbuild_cache::{Home, TreeStore};
use pathbuild_db::System;
use pathbuild_diagnostic::Lang;

use crate::config::{Origin, Settings};
use crate::reporter::{Reporter, Silent};
use crate::session::relative;

/// What a run works in.
#[derive(Debug)]
pub struct Workspace {
    /// What the configuration and the command line say.
    pub settings: Settings,
    /// The files.
    pub system: Arc<dyn System>,
    /// The language of everything that is said, where a person has chosen one for all trees.
    pub own_lang: Option<Lang>,
    /// The language of the system's locale, for messages where neither a person nor the configuration has chosen one.
    pub system_lang: Option<Lang>,
    /// The directory that relative names mean.
    pub working_directory: Utf8PathBuf,
    /// With how many threads to work; `None`: as many as there are cores.
    pub jobs: Option<u16>,
    /// Where results of runs are kept for later ones; `None`: nowhere.
    pub cache: Option<Home>,
    /// Who hears how the run goes on.
    pub reporter: Rc<dyn Reporter>,
}

impl Workspace {
    /// Whether the configuration says what to do without arguments.
    pub fn has_library(&self) -> bool {
        !self.settings.general.library.value.is_empty()
    }

    /// Whether results are kept for later runs: there must be a configuration.
    pub fn keeps_results(&self) -> bool {
        self.cache_place().is_some()
    }

    /// Where they are kept.
    pub fn cache_place(&self) -> Option<TreeStore> {
        Some(TreeStore::of_tree(self.cache.as_ref()?, self.settings.directory()?))
    }

    /// The configuration of the working directory, as an argument names it, where it does not hold because what is worked on lies outside
    /// of its tree.
    pub fn configuration_not_used(&self) -> Option<Utf8PathBuf> {
        let file = self.settings.not_used.as_deref()?;
        Some(relative(file, &self.working_directory))
    }

    /// The same with or without `compatible`. It keeps no results and reports nothing.
    pub fn in_mode(&self, is_compatible: bool) -> Self {
        let mut settings = self.settings.clone();
        settings.general.compatible.value = is_compatible;
        Self {
            settings,
            system: self.system.clone(),
            own_lang: self.own_lang,
            system_lang: self.system_lang,
            working_directory: self.working_directory.clone(),
            jobs: self.jobs,
            cache: None,
            reporter: Rc::new(Silent),
        }
    }

    /// The language of messages. Comments in programs have that of [`Settings::comment_lang`].
    pub fn lang(&self) -> Lang {
        let configured = &self.settings.general.lang;
        let fallback = self.system_lang.filter(|_| configured.origin == Origin::Default);
        self.own_lang.or(fallback).unwrap_or(configured.value)
    }

    /// One of two phrases.
    pub fn choose<'a>(&self, en: &'a str, de: &'a str) -> &'a str {
        match self.lang() {
            Lang::En => en,
            Lang::De => de,
        }
    }

    /// One of two phrases with a value where `{}` stands.
    pub fn phrase(&self, en: &str, de: &str, value: &str) -> String {
        self.choose(en, de).replace("{}", value)
    }
}
