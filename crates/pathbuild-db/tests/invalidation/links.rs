//! Links to drawings.
#![cfg(unix)]

use std::os::unix::fs::symlink;
use std::sync::Arc;

use camino::Utf8Path;
use pathbuild_db::system::OsSystem;
use pathbuild_db::{Database, Db, Role, System, check_target};

use crate::embedding::component;
use crate::world::{dxf, set_up};

fn codes(drawing: &Utf8Path, path: &str) -> Vec<String> {
    let db = Database::new(Arc::new(OsSystem));
    set_up(&db, &[]);
    let target = db.target(db.file(drawing), path, Role::Checked);
    check_target(&db, target).map(|found| found.code().to_string()).collect()
}

#[test]
fn a_link_to_a_drawing_is_no_second_definition() {
    let directory = tempfile::tempdir().unwrap();
    let root = Utf8Path::from_path(directory.path()).unwrap();
    let project = "layer 8001.1P\nstart 0,0 \"T5 O3 Mx\"\nsubpath 0,0 20,0 \">1111.1P\"\nend 20,0";
    let [drawing, other, link] = ["8001.1P.dxf", "1111.1P.dxf", "1111.dxf"].map(|name| root.join(name));
    OsSystem.write(&drawing, &dxf(project)).unwrap();
    OsSystem.write(&other, &dxf(&component("1111.1P", "0"))).unwrap();
    symlink(&other, &link).unwrap();
    assert_eq!(codes(&drawing, "8001.1P"), [""; 0]);
    OsSystem.remove(&link).unwrap();
    OsSystem.write(&link, &dxf(&component("1111.1P", "0"))).unwrap();
    assert_eq!(codes(&drawing, "8001.1P"), ["PB504"]);
}
