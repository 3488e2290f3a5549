//! Tests `watch` in a working directory that is replaced.

use super::*;

/// Creates the library in a separate directory, which may be replaced while `watch` runs in it.
pub(super) fn library_in(directory: &str) -> Place {
    Place::new()
        .file(&format!("{directory}/pathbuild.toml"), CONFIGURATION)
        .file(&format!("{directory}/library/parts/1001.dxf"), dxf("1001.1P", 5, &[]))
        .file(&format!("{directory}/library/projects/8001.dxf"), dxf("8001.1P", 5, &["1001.1P"]))
}

/// Copies the library of another place into this directory, as Git or an unpacked archive does.
fn unpack(place: &Place, directory: &str) {
    let from = library_in(directory);
    for name in ["pathbuild.toml", "library/parts/1001.dxf", "library/projects/8001.dxf"] {
        let name = format!("{directory}/{name}");
        fs::create_dir_all(place.path().join(&name).parent().unwrap()).unwrap();
        fs::copy(from.path().join(&name), place.path().join(&name)).unwrap();
    }
}

/// The process stays in the directory in which it was started, even if that is renamed or removed. While the files are copied, `watch` may begin more
/// than once, so the edit that follows may be part of its first report.
#[test]
fn a_working_directory_that_is_replaced_is_watched() {
    for arguments in
        ["watch --format concise", "watch --poll --format concise", "watch library --format concise"]
    {
        let place = library_in("work");
        let watch = Watch::begin_in(&place, "work", program(), arguments);

        // The directory is renamed, and another one gets its name.
        watch.rename("work", "aside");
        unpack(&place, "work");
        watch.until("watching 2 paths");
        watch.write("work/library/parts/1001.dxf", dxf("1001.1P", 4, &[]));
        watch.until("PB506");

        // The directory is missing for a while.
        fs::remove_dir_all(place.path().join("work")).unwrap();
        watch.until("work is missing: nothing is checked until it is there again");
        unpack(&place, "work");
        watch.until("watching 2 paths");
        watch.write("work/library/parts/1001.dxf", dxf("1001.1P", 5, &["1999.1P"]));
        watch.until("PB503");
    }
}

/// The system reports the move in the parent directory, where the directory `shared` is watched, and then ends the watches of the moved one.
#[test]
fn a_working_directory_that_is_moved_and_moved_back_is_watched() {
    let search = CONFIGURATION.replace("search = [", "search = [\"../shared\", ");
    let place = library_in("work").file("work/pathbuild.toml", search).file("shared/readme.txt", "");
    let watch = Watch::begin_in(&place, "work", program(), "watch --format concise");
    watch.rename("work", "aside");
    std::thread::sleep(Duration::from_millis(500));
    watch.rename("aside", "work");
    watch.until("watching 2 paths");
    watch.write("work/library/parts/1001.dxf", dxf("1001.1P", 4, &[]));
    let said = watch.until("parts/1001.dxf: changed");
    assert!(said.iter().any(|line| line.contains("PB506")), "{said:#?}");
}

/// A parent of the working directory is replaced.
#[test]
fn what_leads_to_the_working_directory_may_be_replaced() {
    let place = library_in("above/work");
    let watch = Watch::begin_in(&place, "above/work", program(), "watch --format concise");
    watch.rename("above", "aside");
    watch.until("work is missing");
    watch.rename("aside", "above");
    watch.until("watching 2 paths");
    watch.write("above/work/library/parts/1001.dxf", dxf("1001.1P", 4, &[]));
    watch.until("parts/1001.dxf: changed");
}

/// If no argument is relative to the working directory, it may be removed.
#[test]
fn a_working_directory_that_nothing_is_named_from_may_go() {
    let place = library_in("work").file("elsewhere/a.txt", "");
    let arguments = format!("watch {} --format concise", place.path().join("work").display());
    let watch = Watch::begin_in(&place, "elsewhere", program(), &arguments);
    fs::remove_dir_all(place.path().join("elsewhere")).unwrap();
    watch.write("work/library/parts/1001.dxf", dxf("1001.1P", 4, &[]));
    watch.until("parts/1001.dxf: changed");
    watch.write("work/pathbuild.toml", format!("{CONFIGURATION}\n"));
    let said = watch.until("watching 2 paths");
    assert!(!said.iter().any(|line| line.contains("missing")), "{said:#?}");
}
