//! Where a person's configuration is, and where results are kept for later runs. (book: reference/configuration)
#![expect(
    clippy::disallowed_methods,
    reason = "the environment is asked where a person's own files are, which no result depends on"
)]

use std::env::{self, VarError};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::Lang;
use pathbuild_workspace::config::clean;
use pathbuild_workspace::{CacheHome, Workspace};

/// Names the directory of kept results, as `--cache-dir` does.
const CACHE_DIR: &str = "PATHBUILD_CACHE_DIR";

/// A person's `config.toml`, there or not; `None` where nobody says where it would be.
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

/// The language that a person has chosen by `PATHBUILD_LANG`: `de`, `en`, or the name of a locale such as `de_AT.UTF-8`.
pub(crate) fn lang() -> Option<Lang> {
    named_lang(&env::var("PATHBUILD_LANG").ok()?)
}

/// The language of the system's locale: by the variables of POSIX on every system, else the user's language on Windows and macOS.
pub(crate) fn system_lang() -> Option<Lang> {
    let variables = ["LC_ALL", "LC_MESSAGES", "LANG"].into_iter();
    let named = variables.filter_map(|variable| env::var(variable).ok()).find(|name| !name.is_empty());
    named_lang(&named.or_else(sys_locale::get_locale)?)
}

/// The language of a name such as `de`, `de-AT` or `de_DE.UTF-8`, where it is one of ours.
pub(crate) fn named_lang(name: &str) -> Option<Lang> {
    match name.split(['_', '-', '.', '@']).next()?.to_ascii_lowercase().as_str() {
        "de" => Some(Lang::De),
        "en" => Some(Lang::En),
        _ => None,
    }
}

/// Why the environment asks for what there is not: kept results would lie elsewhere than its owner believes.
pub(crate) fn refusal(workspace: &Workspace) -> Option<String> {
    let is_unreadable = matches!(env::var(CACHE_DIR), Err(VarError::NotUnicode(_)));
    is_unreadable.then(|| workspace.phrase("{}: it is not UTF-8", "{}: das ist nicht in UTF-8", CACHE_DIR))
}

/// The directory of `--cache-dir` or `PATHBUILD_CACHE_DIR`, else the person's own, which `config.toml` may name; `None` where nobody says
/// where it is.
pub(crate) fn cache_home(
    named: Option<&Utf8Path>,
    configured: Option<Utf8PathBuf>,
    working_directory: &Utf8Path,
) -> Option<CacheHome> {
    let named = named.map(Utf8Path::to_owned).or_else(|| directory(CACHE_DIR));
    match named {
        Some(named) => Some(CacheHome::Named(clean(&working_directory.join(named)))),
        None => configured.or_else(user_caches).map(CacheHome::User),
    }
}

/// As XDG says, or the system's own rules.
fn user_caches() -> Option<Utf8PathBuf> {
    if cfg!(windows) {
        return absolute("LOCALAPPDATA").map(|local| local.join("pathbuild").join("cache"));
    }
    let below_home = if cfg!(target_os = "macos") { "Library/Caches" } else { ".cache" };
    let caches = absolute("XDG_CACHE_HOME").or_else(|| absolute("HOME").map(|home| home.join(below_home)));
    caches.map(|caches| caches.join("pathbuild"))
}

/// XDG: what is not absolute does not count.
fn absolute(variable: &str) -> Option<Utf8PathBuf> {
    directory(variable).filter(|directory| directory.is_absolute())
}

fn directory(variable: &str) -> Option<Utf8PathBuf> {
    env::var(variable).ok().filter(|value| !value.is_empty()).map(Utf8PathBuf::from)
}
