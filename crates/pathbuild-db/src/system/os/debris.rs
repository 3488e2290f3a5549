//! Temporary files of runs that were killed. Each directory is looked through once a run; one that was listed for something else is not
//! listed again.

#![expect(clippy::disallowed_methods, reason = "this is System's implementation: all IO comes here")]

use std::collections::HashMap;
use std::fs;
use std::sync::{LazyLock, Mutex, MutexGuard, PoisonError};

use camino::{Utf8Path, Utf8PathBuf};

use super::{directory, open};

/// The temporary files that were in a directory when it was first listed.
static LISTED: LazyLock<Mutex<HashMap<Utf8PathBuf, Vec<Utf8PathBuf>>>> = LazyLock::new(Mutex::default);

/// Remembers what there is in a directory that was just listed.
pub(super) fn listed(directory: &Utf8Path, temporary: Vec<Utf8PathBuf>) {
    known().entry(directory.to_owned()).or_insert(temporary);
}

/// Removes the temporary files of runs that are gone.
pub(super) fn remove(directory: &Utf8Path) {
    if !known().contains_key(directory) {
        // A directory that cannot be listed has no debris that could be removed.
        _ = directory::list_by_parts(directory, &mut drop);
    }
    let left = std::mem::take(known().entry(directory.to_owned()).or_default());
    for debris in left {
        let is_regular = debris.as_std_path().symlink_metadata().is_ok_and(|data| data.is_file());
        let is_left = || open::open(&debris).ok().filter(|file| file.try_lock().is_ok());
        if let Some(_locked) = is_regular.then(is_left).flatten() {
            // What cannot be removed harms nobody.
            _ = fs::remove_file(&debris);
        }
    }
}

fn known() -> MutexGuard<'static, HashMap<Utf8PathBuf, Vec<Utf8PathBuf>>> {
    LISTED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// `.NAME.123-0.tmp`
pub(super) fn is_temporary(name: &str) -> bool {
    let number = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    name.strip_prefix('.')
        .and_then(|name| name.strip_suffix(".tmp"))
        .and_then(|name| name.rsplit_once('.'))
        .and_then(|(name, numbers)| numbers.split_once('-').filter(|_| !name.is_empty()))
        .is_some_and(|(process, attempt)| number(process) && number(attempt))
}
