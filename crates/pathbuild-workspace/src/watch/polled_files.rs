//! Changes that polling for events cannot notice: it compares modification times in whole seconds, and only notices later ones. A file may change
//! twice within a second, or be replaced by an older one. (book: reference/decisions)

use std::collections::HashMap;
use std::time::{Duration, Instant};

use camino::Utf8PathBuf;
use pathbuild_db::system::{Clock, Stamp};
use pathbuild_db::{Db, SourceFile, content};

use crate::session::Session;

/// The files on which results depend, each with the state in which polling last found it.
#[derive(Debug, Default)]
pub(super) struct PolledFiles(HashMap<SourceFile, PolledFile>);

#[derive(Debug)]
struct PolledFile {
    stamp: Stamp,
    /// Time at which the file was first found with this stamp.
    since: Instant,
    /// Whether the file was compared since then, or needs no comparison.
    is_compared: bool,
}

/// Time for which a file must keep its stamp before it is compared: a change after that time alters the stamp, because the times of all file systems
/// in use have a resolution of at most two seconds.
const REST: Duration = Duration::from_millis(2100);

impl PolledFiles {
    /// Returns the files whose contents are not those that their results were computed from. A file is read only once after each change of its stamp.
    pub(super) fn changed(
        &mut self,
        session: &Session<'_>,
        files: impl Iterator<Item = SourceFile>,
    ) -> Vec<Utf8PathBuf> {
        let (db, now) = (session.db(), Instant::now());
        let mut changed = Vec::new();
        for file in files {
            let path = file.path(db);
            let stamp = Stamp::of(path);
            let polled = self.0.entry(file).or_insert_with(|| PolledFile {
                stamp,
                since: now,
                is_compared: stamp.for_storing(Clock::an_hour_ago()) != Stamp::UNKNOWN
                    && content(db, file).is_some_and(|(_, read)| read == stamp),
            });
            if polled.stamp != stamp {
                *polled = PolledFile { stamp, since: now, is_compared: false };
            }
            if !polled.is_compared && now.duration_since(polled.since) >= REST {
                polled.is_compared = true;
                if !is_as_read(session, file) {
                    changed.push(path.clone());
                }
            }
        }
        changed
    }
}

/// Whether a file still has the contents that its results were computed from, or could be read neither then nor now.
fn is_as_read(session: &Session<'_>, file: SourceFile) -> bool {
    let db = session.db();
    let limit = session.workspace().settings.limits.file_size.value;
    let hash = db.system().read(file.path(db), limit).ok().map(|bytes| *blake3::hash(&bytes).as_bytes());
    hash == content(db, file).map(|(read, _)| read)
}
