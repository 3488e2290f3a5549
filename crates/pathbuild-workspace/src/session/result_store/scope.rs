//! The results that a run uses.

use std::collections::HashSet;

use camino::Utf8Path;
use pathbuild_db::system::{FileKind, System};

use crate::session::{ArgumentMatches, Session};

/// The drawings of a run. The subject of a result is a drawing, or something in it whose description follows the drawing's path after a
/// NUL.
#[derive(Debug)]
pub enum Scope {
    /// All drawings.
    All,
    /// Certain drawings.
    Drawings {
        /// Paths of the drawings.
        drawings: HashSet<String>,
        /// Directories that were listed completely: they contain no other drawings.
        directories: HashSet<String>,
    },
}

impl Scope {
    /// The drawings that the arguments may refer to.
    pub fn of(session: &Session<'_>, found: &ArgumentMatches) -> Self {
        let named = found.named().map(|file| file.path(session.db()).to_string());
        let drawings = found.directories().flat_map(|directory| &directory.drawings);
        let directories = found.directories().flat_map(|directory| &directory.directories);
        Self::Drawings {
            drawings: drawings.map(ToString::to_string).chain(named).collect(),
            directories: directories.map(ToString::to_string).collect(),
        }
    }

    /// Whether the run uses a result.
    pub(super) fn holds(&self, subject: &str) -> bool {
        match self {
            Self::All => true,
            Self::Drawings { drawings, .. } => drawings.contains(drawing(subject)),
        }
    }

    /// Whether a result may be needed again because its drawing still exists. A run over single drawings keeps the results of others.
    pub(super) fn may_return(&self, subject: &str, system: &dyn System) -> bool {
        let drawing = Utf8Path::new(drawing(subject));
        let is_file = || system.kind(drawing) == FileKind::File;
        match self {
            Self::All => is_file(),
            Self::Drawings { directories, .. } => {
                let is_below = |parent: &Utf8Path| directories.contains(parent.as_str());
                let was_looked_through = drawing.parent().is_some_and(is_below);
                self.holds(subject) || directories.is_empty() || !was_looked_through && is_file()
            }
        }
    }
}

fn drawing(subject: &str) -> &str {
    subject.split('\0').next().unwrap_or_default()
}
