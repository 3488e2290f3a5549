//! The environment of a run: the working directory, the user's configuration, cache and language. (book: reference/configuration)
#![expect(
    clippy::disallowed_methods,
    reason = "the environment tells where the user's own files are; no result depends on them"
)]

use std::env::{self, VarError};
use std::sync::Arc;
use std::time::SystemTime;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::{OsSystem, with_forward_slashes};
use pathbuild_diagnostic::{Diagnostic, Lang, escaping};
use pathbuild_workspace::config::{self, Overrides, UserSettings, clean};
use pathbuild_workspace::waivers::{Date, DateSource, RunDate};
use pathbuild_workspace::{CacheHome, Inputs, SilentReporter, Workspace};

/// Environment variable with the time, in seconds since 1970, to use as the current one, so that results can be reproduced
/// (reproducible-builds.org).
const EPOCH_VARIABLE: &str = "SOURCE_DATE_EPOCH";

const LANG_VARIABLE: &str = "PATHBUILD_LANG";

/// Environment variable that names the cache directory, like `--cache-dir`.
const CACHE_DIR_VARIABLE: &str = "PATHBUILD_CACHE_DIR";

/// Loads the user's own settings. Also returns diagnostics of their file.
pub(crate) fn load_user_settings() -> (UserSettings, Vec<Diagnostic>) {
    user_configuration().map(|file| UserSettings::load(&OsSystem, &file)).unwrap_or_default()
}

/// Returns a workspace in the working directory for these inputs, without a cache and without output. Also returns diagnostics of the
/// configuration.
pub(crate) fn workspace(
    overrides: &Overrides,
    user: &UserSettings,
    inputs: &Inputs,
) -> (Workspace, Vec<Diagnostic>) {
    let working_directory = working_directory();
    let (settings, faults) = config::load(&OsSystem::shared(), overrides, inputs, &working_directory);
    let workspace = Workspace {
        system: settings.confine(OsSystem::shared()),
        settings,
        own_lang: lang().or(user.lang),
        system_lang: system_lang(),
        working_directory,
        jobs: None,
        cache: None,
        reporter: Arc::new(SilentReporter),
        is_date_decisive: Arc::default(),
    };
    (workspace, faults)
}

/// Returns the working directory; empty if it is unknown or not UTF-8, so that relative names remain relative.
pub(crate) fn working_directory() -> Utf8PathBuf {
    let directory = env::current_dir().ok();
    directory
        .and_then(|directory| Utf8PathBuf::from_path_buf(directory).ok())
        .map(with_forward_slashes)
        .unwrap_or_default()
}

/// Returns the path of the user's `config.toml`, whether the file exists or not; `None` if its directory is unknown.
pub(crate) fn user_configuration() -> Option<Utf8PathBuf> {
    let below_home = |directory: &str| absolute("HOME").map(|home| home.join(directory));
    let directory = if cfg!(windows) {
        absolute("APPDATA")
    } else if cfg!(target_os = "macos") {
        absolute("XDG_CONFIG_HOME").or_else(|| below_home("Library/Application Support"))
    } else {
        absolute("XDG_CONFIG_HOME").or_else(|| below_home(".config"))
    };
    directory.map(|directory| directory.join("pathbuild").join("config.toml"))
}

/// Returns the language chosen by `PATHBUILD_LANG`: `de`, `en`, or the name of a locale such as `de_AT.UTF-8`.
fn lang() -> Option<Lang> {
    named_lang(&env::var(LANG_VARIABLE).ok()?)
}

/// Returns the language of the system's locale: from the POSIX variables on every system, or else the user's language on Windows and
/// macOS.
fn system_lang() -> Option<Lang> {
    let variables = ["LC_ALL", "LC_MESSAGES", "LANG"].into_iter();
    let named = variables.filter_map(|variable| env::var(variable).ok()).find(|name| !name.is_empty());
    named_lang(&named.or_else(sys_locale::get_locale)?)
}

/// Returns the language of a name such as `de`, `de-AT` or `de_DE.UTF-8`, if it is supported.
pub(crate) fn named_lang(name: &str) -> Option<Lang> {
    match name.split(['_', '-', '.', '@']).next()?.to_ascii_lowercase().as_str() {
        "de" => Some(Lang::De),
        "en" => Some(Lang::En),
        _ => None,
    }
}

/// Returns the date of a run: the given one, or else that of `SOURCE_DATE_EPOCH`, or else the current date in UTC. `None` if
/// `SOURCE_DATE_EPOCH` is not a time.
pub(crate) fn date(given: Option<Date>) -> Option<RunDate> {
    if let Some(date) = given {
        return Some(RunDate { date, source: DateSource::Given });
    }
    if env::var_os(EPOCH_VARIABLE).is_some() {
        return Some(RunDate { date: date_of_epoch()?, source: DateSource::Epoch });
    }
    let now = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).ok()?;
    Some(RunDate { date: Date::of_unix_time(now.as_secs())?, source: DateSource::Clock })
}

/// Returns the date of `SOURCE_DATE_EPOCH`; `None` if the variable is missing or not a time.
fn date_of_epoch() -> Option<Date> {
    Date::of_unix_time(env::var(EPOCH_VARIABLE).ok()?.parse().ok()?)
}

/// Returns an error for an environment variable that is set but invalid. Ignoring it would put the cache in another place than the user
/// expects, compare waivers with another date, or answer in another language.
pub(crate) fn refusal(workspace: &Workspace) -> Option<String> {
    if env::var_os(EPOCH_VARIABLE).is_some() && date_of_epoch().is_none() {
        return Some(workspace.phrase(
            "{} is not a number of seconds since 1970",
            "{} ist keine Anzahl von Sekunden seit 1970",
            EPOCH_VARIABLE,
        ));
    }
    if let Some(name) = env::var_os(LANG_VARIABLE).filter(|name| !name.is_empty() && lang().is_none()) {
        let name = format!("{LANG_VARIABLE}={}", escaping::line(&name.to_string_lossy()));
        return Some(workspace.phrase(
            "{}: the language must be en or de",
            "{}: die Sprache muss en oder de sein",
            &name,
        ));
    }
    let is_unreadable = matches!(env::var(CACHE_DIR_VARIABLE), Err(VarError::NotUnicode(_)));
    is_unreadable
        .then(|| workspace.phrase("{}: it is not UTF-8", "{}: das ist kein UTF-8", CACHE_DIR_VARIABLE))
}

/// Returns the directory of `--cache-dir` or `PATHBUILD_CACHE_DIR`, or else the user's cache directory, which `config.toml` may name; `None` if no
/// such directory is known.
pub(crate) fn cache_home(
    named: Option<&Utf8Path>,
    configured: Option<Utf8PathBuf>,
    working_directory: &Utf8Path,
) -> Option<CacheHome> {
    let named = named.map(Utf8Path::to_owned).or_else(|| directory(CACHE_DIR_VARIABLE));
    match named {
        Some(named) => Some(CacheHome::Named(clean(&working_directory.join(named)))),
        None => configured.or_else(user_caches).map(CacheHome::User),
    }
}

/// Returns the user's cache directory, according to XDG or the conventions of the system.
fn user_caches() -> Option<Utf8PathBuf> {
    if cfg!(windows) {
        return absolute("LOCALAPPDATA").map(|local| local.join("pathbuild").join("cache"));
    }
    let below_home = if cfg!(target_os = "macos") { "Library/Caches" } else { ".cache" };
    let caches = absolute("XDG_CACHE_HOME").or_else(|| absolute("HOME").map(|home| home.join(below_home)));
    caches.map(|caches| caches.join("pathbuild"))
}

/// Returns the directory in an environment variable if it is absolute. XDG requires that relative ones are ignored.
fn absolute(variable: &str) -> Option<Utf8PathBuf> {
    directory(variable).filter(|directory| directory.is_absolute())
}

fn directory(variable: &str) -> Option<Utf8PathBuf> {
    env::var(variable).ok().filter(|value| !value.is_empty()).map(Utf8PathBuf::from)
}
