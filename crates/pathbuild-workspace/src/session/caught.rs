//! Bugs that show while nobody works on a target: they are said of the directory that shows them, and keep nothing else from being done.

use camino::Utf8Path;
use pathbuild_db::system::Names;
use pathbuild_db::{Db, Directory, catch_bugs, unlistable, unlisted};
use pathbuild_diagnostic::Diagnostic;

use super::Session;
use super::library::readable;

impl Session<'_> {
    /// Asks the database about a directory.
    ///
    /// # Errors
    /// PB006 where that shows a bug, PB001 where a drawing changed meanwhile, and where the directory cannot be listed.
    pub(super) fn of_directory<R>(
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

    /// The names of what is no directory in a directory; none where there is no such directory.
    ///
    /// # Errors
    /// PB001 where it cannot be listed, PB006 where that shows a bug.
    pub fn names_in(&self, directory: &Utf8Path) -> Result<Names, Box<Diagnostic>> {
        let listed = catch_bugs(|| self.db.system().list(directory));
        match listed.map_err(|bug| Box::new(bug.in_file(readable(directory))))? {
            Ok(listing) => Ok(listing.files),
            Err(fault) if self.is_directory(directory) => Err(Box::new(unlistable(directory, &fault))),
            Err(_) => Ok(Names::default()),
        }
    }
}
