//! Internal errors outside of any target: they are reported for the directory that triggers them, and other work goes on.

use camino::Utf8Path;
use pathbuild_db::system::Names;
use pathbuild_db::{Db, Directory, catch_bugs, unlistable, unlisted};
use pathbuild_diagnostic::Diagnostic;

use super::Session;
use super::library::readable;

impl Session<'_> {
    /// Queries the database about a directory.
    ///
    /// PB006 if this triggers a bug, PB001 if a drawing changed in the meantime or if the directory cannot be listed.
    /// PB006 where that shows a bug, PB001 where a drawing changed meanwhile, and where the directory cannot be listed.
    pub(super) fn query_directory<R>(
        &self,
        directory: &Utf8Path,
        ask: impl Fn(Directory) -> R,
    ) -> Result<R, Box<Diagnostic>> {
        let input = self.db.directory(directory);
        let answer = self.db.guarded(self.limit(), || (ask(input), unlisted(&self.db, input)));
        match answer.map_err(|problem| problem.in_file(readable(directory)))? {
            (answer, None) => Ok(answer),
            (_, Some(problem)) => Err(Box::new(problem)),
        }
    }

    /// Names of the entries of a directory that are not directories themselves; empty if the directory does not exist.
    ///
    /// # Errors
    /// PB001 if it cannot be listed, PB006 if this triggers a bug.
    pub fn file_names_in(&self, directory: &Utf8Path) -> Result<Names, Box<Diagnostic>> {
        let listed = catch_bugs(|| self.db.system().list(directory));
        match listed.map_err(|bug| Box::new(bug.in_file(readable(directory))))? {
            Ok(listing) => Ok(listing.files),
            Err(fault) if self.is_directory(directory) => Err(Box::new(unlistable(directory, &fault))),
            Err(_) => Ok(Names::default()),
        }
    }
}
