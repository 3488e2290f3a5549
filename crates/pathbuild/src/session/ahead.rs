//! Reading ahead of a single project. To list a directory of ten thousand drawings takes longer than to read the ten of them that a project
//! embeds, so they are read meanwhile.

use std::thread;

use pathbuild_db::system::Kind;
use pathbuild_db::{Database, Db, Target, mentioned, name_table, search_directories, try_mentioned};
use pathbuild_path::PathName;

/// Reads what a target will ask for, on two threads. Only the database knows more afterwards: what the target's check finds is the same
/// without it.
pub(super) fn read_mentioned(db: &Database, target: Target) {
    let names = mentioned(db, target);
    if names.is_empty() {
        return;
    }
    let other = db.clone();
    thread::scope(|scope| {
        let listing = scope.spawn(move || list(&other, target));
        names.iter().enumerate().for_each(|(number, name)| read_likely(db, target, number, name));
        // A bug in there shows itself again when the check asks.
        _ = listing.join();
    });
}

fn list(db: &Database, target: Target) {
    for directory in search_directories(db, target.file(db)) {
        name_table(db, db.directory(&directory));
    }
}

/// Reads the drawing that most likely holds a path, the one of that name beside the target's, and walks along the path as it is without
/// values for variables. Where there is no such drawing, the path is in another.
fn read_likely(db: &Database, target: Target, number: usize, name: &PathName) {
    let likely = target.file(db).path(db).with_file_name(format!("{name}.dxf"));
    if db.system().kind(&likely) == Kind::File {
        try_mentioned(db, target, number, db.file(&likely));
    }
}
