//! Bugs that show while nobody works on a target: they are said of the directory that shows them, and keep nothing else from being done.

use camino::Utf8Path;
use pathbuild_db::system::Names;
use pathbuild_db::{Db, Directory, catch_bugs};
use pathbuild_diagnostic::Diagnostic;

use super::Session;
use super::library::readable;

impl Session<'_> {
    /// Asks the database about a directory.
    ///
    /// # Errors
    /// PB006 where that shows a bug, PB001 where a drawing changed meanwhile.
    pub(super) fn of_directory<R>(
        &self,
        directory: &Utf8Path,
        ask: impl Fn(Directory) -> R,
    ) -> Result<R, Box<Diagnostic>> {
        let ask = || ask(self.db.directory(directory));
        self.db.guarded(self.limit(), ask).map_err(|problem| Box::new(problem.in_file(readable(directory))))
    }

    /// The names of what is no directory in a directory; none where it cannot be listed.
    ///
    /// # Errors
    /// PB006 where that shows a bug.
    pub fn names_in(&self, directory: &Utf8Path) -> Result<Names, Box<Diagnostic>> {
        let listed = catch_bugs(|| self.db.system().list(directory).unwrap_or_default());
        listed.map(|listing| listing.files).map_err(|bug| Box::new(bug.in_file(readable(directory))))
    }
}
