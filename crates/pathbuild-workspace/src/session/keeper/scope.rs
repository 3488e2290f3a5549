//! Which results a run is about.

use std::collections::HashSet;

use camino::Utf8Path;
use pathbuild_db::system::{Kind, System};

use crate::session::Found;

/// The drawings of a run. A result is of a drawing, or of something in it: then what follows the drawing stands behind a NUL.
#[derive(Debug)]
pub enum Scope {
    /// Whatever there is.
    All,
    /// Those of some directories.
    Drawings {
        /// The drawings.
        drawings: HashSet<String>,
        /// Every directory that was looked through: there are no others in them.
        directories: HashSet<String>,
    },
}

impl Scope {
    /// That of drawings that were found in directories.
    pub fn of(found: &Found) -> Self {
        Self::Drawings {
            drawings: found.drawings.iter().map(|drawing| drawing.as_str().to_owned()).collect(),
            directories: found.directories.iter().map(|directory| directory.as_str().to_owned()).collect(),
        }
    }

    /// Whether the run is about a result.
    pub(super) fn holds(&self, of: &str) -> bool {
        match self {
            Self::All => true,
            Self::Drawings { drawings, .. } => drawings.contains(drawing(of)),
        }
    }

    /// Whether a result may be asked for another time: its drawing is there.
    pub(super) fn may_return(&self, of: &str, system: &dyn System) -> bool {
        let drawing = Utf8Path::new(drawing(of));
        let was_looked_through = match self {
            Self::All => false,
            Self::Drawings { directories, .. } => {
                drawing.parent().is_some_and(|parent| directories.contains(parent.as_str()))
            }
        };
        self.holds(of) && was_looked_through || !was_looked_through && system.kind(drawing) == Kind::File
    }
}

fn drawing(of: &str) -> &str {
    of.split('\0').next().unwrap_or_default()
}
