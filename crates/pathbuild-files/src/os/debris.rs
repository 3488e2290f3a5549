//! Removes temporary files left by killed runs. Each directory is searched at most once per run; if it has been listed for another reason
//! already, that listing is used.

#![expect(clippy::disallowed_methods, reason = "this is System's implementation: all IO comes here")]

use std::collections::HashMap;
use std::fs;
use std::sync::{LazyLock, Mutex, MutexGuard, PoisonError};

use camino::{Utf8Path, Utf8PathBuf};

use super::{directory, open};

/// Temporary files found when a directory was first listed.
static LISTED: LazyLock<Mutex<HashMap<Utf8PathBuf, Vec<Utf8PathBuf>>>> = LazyLock::new(Mutex::default);

/// Records the temporary files found while listing a directory.
pub(super) fn listed(directory: &Utf8Path, temporary: Vec<Utf8PathBuf>) {
    known().entry(directory.to_owned()).or_insert(temporary);
}

/// Removes temporary files whose process no longer runs.
pub(super) fn remove(directory: &Utf8Path) {
    if !known().contains_key(directory) {
        // Nothing can be removed from a directory that cannot be listed.
        _ = directory::list_by_parts(directory, &mut drop);
    }
    let leftovers = std::mem::take(known().entry(directory.to_owned()).or_default());
    for debris in leftovers {
        let is_regular = debris.as_std_path().symlink_metadata().is_ok_and(|data| data.is_file());
        let is_left = || open::open(&debris).ok().filter(|file| file.try_lock().is_ok());
        if let Some(_locked) = is_regular.then(is_left).flatten() {
            // Best effort: a leftover temporary file does no harm.
            _ = fs::remove_file(&debris);
        }
    }
}

fn known() -> MutexGuard<'static, HashMap<Utf8PathBuf, Vec<Utf8PathBuf>>> {
    LISTED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Whether a name has the form `.NAME.123-0.tmp` of a temporary file.
pub(super) fn is_temporary(name: &str) -> bool {
    let number = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    name.strip_prefix('.')
        .and_then(|name| name.strip_suffix(".tmp"))
        .and_then(|name| name.rsplit_once('.'))
        .and_then(|(name, numbers)| numbers.split_once('-').filter(|_| !name.is_empty()))
        .is_some_and(|(process, attempt)| number(process) && number(attempt))
}
