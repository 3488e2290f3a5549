//! Tests `watch` with drawings, directories and configurations that are links.

use std::os::unix::fs::symlink;
use std::path::Path;

use super::replaced::library_in;
use super::*;

/// Creates a library whose component 1001 is a link to a file elsewhere.
fn linked(link: impl FnOnce(&Path)) -> Place {
    let place = library().file("master/1001.dxf", dxf("1001.1P", 5, &[]));
    let component = place.path().join("library/parts/1001.dxf");
    fs::remove_file(&component).unwrap();
    link(place.path());
    assert!(component.exists());
    place
}

/// Edits the file to which the component points, and asserts that the component and the program that embeds it are processed.
fn is_noticed(watch: &Watch<'_>, file: &str) {
    watch.write(file, dxf("1001.1P", 4, &[]));
    let said = watch.until("library/parts/1001.dxf: changed");
    assert!(said.iter().any(|line| line.contains("PB506")), "{file}: {said:#?}");
    watch.write(file, dxf("1001.1P", 5, &[]));
    watch.until("library/parts/1001.dxf: changed");
}

#[test]
fn a_file_behind_a_link_is_watched() {
    let place = linked(|at| symlink("../../master/1001.dxf", at.join("library/parts/1001.dxf")).unwrap());
    for arguments in [
        "watch --format concise",
        "watch library --format concise",
        "watch library/projects --format concise",
    ] {
        is_noticed(&Watch::begin(&place, arguments), "master/1001.dxf");
    }
    // Most editors save by renaming a new file.
    let watch = Watch::begin(&place, "watch --format concise");
    watch.write("master/new.tmp", dxf("1001.1P", 4, &[]));
    watch.rename("master/new.tmp", "master/1001.dxf");
    let said = watch.until("library/parts/1001.dxf: changed");
    assert!(said.iter().any(|line| line.contains("PB506")), "{said:#?}");
    // The directory of the file may be replaced later.
    watch.rename("master", "before");
    watch.until("watching ");
    fs::create_dir(place.path().join("master")).unwrap();
    watch.write("master/1001.dxf", dxf("1001.1P", 5, &[]));
    watch.until("watching ");
    is_noticed(&watch, "master/1001.dxf");
}

/// The component is a link to a link, through a directory that is a link, to a file without the name of a drawing.
#[test]
fn every_link_on_the_way_is_watched() {
    let place = linked(|at| {
        fs::create_dir_all(at.join("store")).unwrap();
        fs::copy(at.join("master/1001.dxf"), at.join("store/a.bin")).unwrap();
        fs::copy(at.join("master/1001.dxf"), at.join("store/b.bin")).unwrap();
        symlink("store", at.join("current")).unwrap();
        fs::remove_file(at.join("master/1001.dxf")).unwrap();
        symlink("../current/a.bin", at.join("master/1001.dxf")).unwrap();
        symlink("../../master/1001.dxf", at.join("library/parts/1001.dxf")).unwrap();
    });
    let watch = Watch::begin(&place, "watch --format concise");
    is_noticed(&watch, "store/a.bin");
    // The link in the middle now points elsewhere.
    watch.write("store/b.bin", dxf("1001.1P", 4, &[]));
    fs::remove_file(place.path().join("master/1001.dxf")).unwrap();
    symlink("../current/b.bin", place.path().join("master/1001.dxf")).unwrap();
    watch.until("PB506");
    watch.write("store/b.bin", dxf("1001.1P", 5, &[]));
    let said = watch.until(" 0 new findings");
    assert!(said.last().unwrap().contains("library/parts/1001.dxf: changed"), "{said:#?}");
    // The directory link now points elsewhere, too.
    fs::create_dir(place.path().join("other")).unwrap();
    watch.write("other/b.bin", dxf("1001.1P", 4, &[]));
    fs::remove_file(place.path().join("current")).unwrap();
    symlink("other", place.path().join("current")).unwrap();
    watch.until("PB506");
    watch.until("watching ");
    watch.write("other/b.bin", dxf("1001.1P", 5, &[]));
    let said = watch.until(" 0 new findings");
    assert!(said.last().unwrap().contains("library/parts/1001.dxf: changed"), "{said:#?}");
}

/// A team's ignore rules are often a link to a file that several libraries share.
#[test]
fn an_ignore_file_behind_a_link_is_watched() {
    for name in [".gitignore", ".ignore"] {
        let place = library().file("rules", "").file("old/1009.dxf", dxf("1009.1P", 5, &[]));
        fs::rename(place.path().join("old"), place.path().join("library/old")).unwrap();
        symlink("../rules", place.path().join("library").join(name)).unwrap();
        let watch = Watch::begin(&place, "watch library --format concise");
        watch.write("rules", "old/\n");
        watch.until("library/old/1009.dxf: ");
        watch.write("rules", "");
        watch.until("library/old/1009.dxf: ");
        // With these rules, the library has no drawings, but its ignore file must still be watched.
        watch.write("rules", "*.dxf\n");
        watch.until("library/old/1009.dxf: ");
        watch.write("rules", "");
        watch.until("library/old/1009.dxf: ");
    }
}

/// A hard link is a second name of the same file: writing the file under either name changes the drawing.
#[cfg(target_os = "linux")]
#[test]
fn a_file_with_another_name_is_watched() {
    let place = linked(|at| {
        fs::hard_link(at.join("master/1001.dxf"), at.join("library/parts/1001.dxf")).unwrap();
    });
    for arguments in ["watch --format concise", "watch library/projects --format concise"] {
        is_noticed(&Watch::begin(&place, arguments), "master/1001.dxf");
    }
    let watch = Watch::begin(&place, "watch --format concise");
    is_noticed(&watch, "library/parts/1001.dxf");
    // A file that replaces the other name is no longer the drawing.
    watch.write("master/new.tmp", dxf("1001.1P", 4, &[]));
    watch.rename("master/new.tmp", "master/1001.dxf");
    watch.write("library/parts/1001.dxf", dxf("1001.1P", 4, &[]));
    watch.until("PB506");
}

/// Two hard links to one file are in the library; the system watches the file only once.
#[cfg(target_os = "linux")]
#[test]
fn two_drawings_that_are_one_file_change_together() {
    let place = library();
    let place = place.file("library/again/1001.dxf", "");
    let [one, two] = ["library/parts/1001.dxf", "library/again/1001.dxf"];
    fs::remove_file(place.path().join(two)).unwrap();
    fs::hard_link(place.path().join(one), place.path().join(two)).unwrap();
    for file in [one, two] {
        let watch = Watch::begin(&place, "watch --format concise");
        watch.write(file, dxf("1001.1P", 5, &["1999.1P"]));
        let said = [watch.until("1001.dxf: changed"), watch.until("1001.dxf: changed")].concat();
        assert!(said.iter().any(|line| line.contains(&format!("{one}: changed"))), "{said:#?}");
        assert!(said.iter().any(|line| line.contains(&format!("{two}: changed"))), "{said:#?}");
        watch.write(file, dxf("1001.1P", 5, &[]));
        watch.until("1001.dxf: changed");
    }
}

/// The system watches a directory once, under the last of the names given to it.
#[test]
fn a_directory_with_two_names_is_watched_by_both() {
    for (configuration, link) in [
        (CONFIGURATION.to_owned(), "library/zz"),
        (CONFIGURATION.replace("\"library/parts\"", "\"linked\""), "linked"),
        (CONFIGURATION.replace("\"library/parts\"", "\"zz/parts\""), "zz"),
    ] {
        let place = library().file("pathbuild.toml", configuration);
        let target = if link == "zz" { "library" } else { "library/parts" };
        symlink(place.path().join(target), place.path().join(link)).unwrap();
        let watch = Watch::begin(&place, "watch --format concise");
        is_noticed(&watch, "library/parts/1001.dxf");
    }
}

/// The real directory is replaced, and the link stays as it is.
#[test]
fn a_directory_behind_a_link_that_is_replaced_is_watched() {
    let place = library();
    watch_rename(&place, "library", "real/library");
    symlink("real/library", place.path().join("library")).unwrap();
    let watch = Watch::begin(&place, "watch --format concise");
    watch.rename("real", "aside");
    watch.until("watching 0 paths");
    watch.rename("aside", "real");
    watch.until("watching 4 paths");
    is_noticed(&watch, "real/library/parts/1001.dxf");
}

fn watch_rename(place: &Place, from: &str, to: &str) {
    let to = place.path().join(to);
    fs::create_dir_all(to.parent().unwrap()).unwrap();
    fs::rename(place.path().join(from), to).unwrap();
}

/// The configuration is a link to a file that several libraries share.
#[test]
fn a_configuration_that_is_a_link_is_watched() {
    let place = library().file("shared/all.toml", CONFIGURATION);
    fs::remove_file(place.path().join("pathbuild.toml")).unwrap();
    symlink("shared/all.toml", place.path().join("pathbuild.toml")).unwrap();
    let watch = Watch::begin(&place, "watch --format concise");
    watch.write("shared/all.toml", format!("restrict = [\"8001*:9\"]\n{CONFIGURATION}"));
    let said = watch.until("watching ");
    assert!(said.iter().any(|line| line.contains("PB507")), "{said:#?}");
}

/// The target of a link in an untrusted tree is neither read nor watched.
#[test]
fn a_link_out_of_a_strangers_tree_is_not_watched() {
    let place = library_in("tree").file("secret/1003.dxf", dxf("1003.1P", 5, &[]));
    fs::create_dir(place.path().join("tree/.git")).unwrap();
    symlink("../../../secret/1003.dxf", place.path().join("tree/library/parts/1003.dxf")).unwrap();
    let watch = Watch::begin_in(&place, "tree", program(), "watch --untrusted --format concise");
    assert!(watch.beginning.iter().any(|line| line.contains("1003.dxf: error[PB001]")));
    watch.write("secret/1003.dxf", dxf("1003.1P", 4, &[]));
    std::thread::sleep(Duration::from_millis(700));
    watch.write("tree/library/parts/1001.dxf", dxf("1001.1P", 4, &[]));
    let said = watch.until("1001.dxf: changed");
    assert!(!said.iter().any(|line| line.contains("1003.dxf: changed")), "{said:#?}");
}
