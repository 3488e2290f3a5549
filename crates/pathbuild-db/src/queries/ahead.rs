//! What a target will most likely ask for, for who has time while a directory is being listed. Nothing is found here; what was computed is
//! there when it is asked for.

use pathbuild_path::{Bindings, PathName, Segment};

use super::brief::{head, summary};
use super::instance::{Instance, chains, path};
use super::raw::NameKey;
use super::reach::root;
use crate::database::Db;
use crate::inputs::{SourceFile, Target};

/// The paths that a target's path names in its own subpath segments, before anybody has looked for them.
#[salsa::tracked]
pub fn mentioned(db: &dyn Db, target: Target) -> Vec<PathName> {
    let bound = root(db, target).and_then(|(root, _)| path(db, root).path.as_ref());
    let segments = bound.map_or(&[][..], |path| &path.segments);
    let mut names: Vec<PathName> = segments.iter().filter_map(Segment::embedded_name).cloned().collect();
    names.sort();
    names.dedup();
    names
}

/// Reads one of these from a file, and walks along it; whether the file holds it, it has no variables, and nothing is wrong.
#[salsa::tracked(returns(copy))]
pub fn try_mentioned(db: &dyn Db, target: Target, number: usize, file: SourceFile) -> bool {
    let Some(name) = mentioned(db, target).get(number) else { return false };
    let name = NameKey::of(db, name);
    let is_plain = head(db, file, name).is_some_and(|head| head.definitions.is_empty());
    if !is_plain {
        return false;
    }
    let instance = Instance::new(db, file, name, Bindings::default());
    // A program is made of both.
    summary(db, instance).brief.is_some() && chains(db, instance).diagnostics.is_empty()
}
