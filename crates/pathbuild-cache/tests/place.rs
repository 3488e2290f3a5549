//! Tests that the directory of cached results contains only the user's own files, and is never accessed through links.
#![cfg(unix)]
#![expect(
    clippy::unwrap_used,
    clippy::disallowed_methods,
    reason = "a test that cannot set up its files has failed"
)]

use std::fs;
use std::os::unix::fs::{PermissionsExt, symlink};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_cache::{CacheLocation, Catalogue, Key, TreeStore};
use tempfile::TempDir;

/// Creates a directory for caches, and two trees.
fn world() -> (TempDir, Utf8PathBuf) {
    let directory = TempDir::new().unwrap();
    let base = Utf8PathBuf::from_path_buf(directory.path().canonicalize().unwrap()).unwrap();
    for tree in ["one", "two"] {
        fs::create_dir(base.join(tree)).unwrap();
    }
    (directory, base)
}

fn store(place: &TreeStore) {
    place.store(&Key::new("build", "question"), Catalogue::default()).unwrap();
}

fn mode(path: &Utf8Path) -> u32 {
    fs::metadata(path).unwrap().permissions().mode() & 0o777
}

#[test]
fn each_tree_has_its_own_results_by_its_real_path() {
    let (_directory, base) = world();
    let home = CacheLocation::User(base.join("caches"));
    let one = TreeStore::of_tree(&home, &base.join("one"));
    assert_ne!(one, TreeStore::of_tree(&home, &base.join("two")));
    symlink("one", base.join("link")).unwrap();
    assert_eq!(one, TreeStore::of_tree(&home, &base.join("link")));
    let named = CacheLocation::Named(base.join("named"));
    assert_eq!(TreeStore::of_tree(&named, &base.join("one")), TreeStore::of_tree(&named, &base.join("two")));
}

#[test]
fn what_is_made_is_for_its_owner_only() {
    let (_directory, base) = world();
    let place = TreeStore::of_tree(&CacheLocation::User(base.join("caches")), &base.join("one"));
    store(&place);
    assert_eq!((mode(&base.join("caches")), mode(place.directory())), (0o700, 0o700));
    for entry in place.directory().read_dir_utf8().unwrap() {
        assert_eq!(mode(entry.unwrap().path()), 0o600);
    }
}

#[test]
fn a_link_a_file_and_what_everybody_may_write_into_are_refused() {
    let (_directory, base) = world();
    let place = TreeStore::of_tree(&CacheLocation::Named(base.join("named")), &base);
    assert_eq!(place.refusal(), None);
    symlink("one", place.directory()).unwrap();
    assert_eq!(place.refusal().map(|it| it.en), Some("it is a link"));
    fs::remove_file(place.directory()).unwrap();
    fs::write(place.directory(), "").unwrap();
    assert_eq!(place.refusal().map(|it| it.en), Some("it is not a directory"));
    fs::remove_file(place.directory()).unwrap();
    store(&place);
    assert_eq!(place.refusal(), None);
    fs::set_permissions(place.directory(), fs::Permissions::from_mode(0o777)).unwrap();
    assert_eq!(place.refusal().map(|it| it.en), Some("every user may write to it"));
}

#[test]
fn files_that_are_too_large_are_not_read() {
    let (_directory, base) = world();
    let place = TreeStore::of_tree(&CacheLocation::Named(base.join("named")), &base);
    store(&place);
    let key = Key::new("build", "question");
    // The files are sparse and take no space on disk.
    for name in [key.file_name(), "CACHEDIR.TAG".to_owned()] {
        fs::File::create(place.directory().join(name)).unwrap().set_len(1 << 42).unwrap();
    }
    assert!(place.load(&key).is_err());
    assert!(place.clean().is_err_and(|it| it.path.ends_with("CACHEDIR.TAG")));
}

#[test]
fn a_directory_of_other_things_is_refused_and_stays() {
    let (_directory, base) = world();
    let place = TreeStore::of_tree(&CacheLocation::Named(base.join("one")), &base);
    fs::write(base.join("one/.bashrc"), "precious").unwrap();
    assert_eq!(
        place.refusal().map(|it| it.en),
        Some("it contains other files, and no CACHEDIR.TAG of pathbuild")
    );
    assert!(place.clean().is_err());
    fs::remove_file(base.join("one/.bashrc")).unwrap();
    store(&place);
    fs::write(base.join("one/.bashrc"), "precious").unwrap();
    assert_eq!((place.refusal(), place.clean().unwrap()), (None, true));
    assert_eq!(fs::read_to_string(base.join("one/.bashrc")).unwrap(), "precious");
    assert_eq!(base.join("one").read_dir_utf8().unwrap().count(), 1);
}

#[test]
fn nothing_is_pruned_through_a_link_or_among_other_things() {
    let (_directory, base) = world();
    let build = Key::new("build", "question");
    let place = TreeStore::of_tree(&CacheLocation::Named(base.join("link")), &base);
    let old = base.join("one").join(build.file_name());
    fs::write(&old, "somebody's").unwrap();
    symlink("one", place.directory()).unwrap();
    assert!(place.prune(&build).is_err());
    fs::remove_file(place.directory()).unwrap();
    let place = TreeStore::of_tree(&CacheLocation::Named(base.join("one")), &base);
    fs::write(base.join("one/.bashrc"), "precious").unwrap();
    assert!(place.prune(&build).is_err() && old.exists());
    // Without other files in it, the directory may have been left by a killed run.
    fs::remove_file(base.join("one/.bashrc")).unwrap();
    assert!(place.prune(&build).unwrap() == 1 && !old.exists());
    assert_eq!(TreeStore::of_tree(&CacheLocation::Named(base.join("none")), &base).prune(&build).unwrap(), 0);
}

/// Other programs mark their caches with the same signature and may use any file names, so the signature does not suffice.
#[test]
fn only_what_pathbuild_makes_is_removed() {
    let (_directory, base) = world();
    let build = Key::new("build", "question");
    let place = TreeStore::of_tree(&CacheLocation::Named(base.join("one")), &base);
    store(&place);
    let own = place.directory().join(build.file_name());
    let of_others = [
        "probe1.results",
        "0123456789abcdef0123456g.results",
        "notes.tmp",
        ".x..tmp",
        ".thing.1-2.tmp",
        "tree",
    ];
    for name in of_others {
        fs::write(base.join("one").join(name), "mine").unwrap();
    }
    assert_eq!((place.refusal(), place.prune(&build)), (None, Ok(0)));
    let tag = base.join("one/CACHEDIR.TAG");
    let signature = fs::read_to_string(&tag).unwrap().lines().next().unwrap().to_owned();
    let own_tag = fs::read(&tag).unwrap();
    for maker in ["This file is a cache directory tag created by cargo.", "made by mypathbuilder"] {
        fs::write(&tag, format!("{signature}\n# {maker}\n")).unwrap();
        assert!(
            place.refusal().is_some()
                && place.prune(&build).is_err()
                && place.clean().is_err()
                && own.exists()
        );
    }
    fs::write(&tag, own_tag).unwrap();
    assert!(place.clean().unwrap() && !own.exists());
    assert!(of_others.iter().all(|name| base.join("one").join(name).exists()));
}

/// Without its cache tag, a directory belongs to pathbuild only if it contains nothing but files that pathbuild creates.
#[test]
fn a_directory_without_a_mark_may_be_anybodys() {
    let (_directory, base) = world();
    let home = CacheLocation::User(base.join("caches"));
    let place = TreeStore::of_tree(&home, &base);
    for name in ["tree", ".x..tmp", ".tree..tmp", ".clock.1.tmp", ".thing.1-2.tmp"] {
        fs::create_dir_all(place.directory()).unwrap();
        let file = place.directory().join(name);
        fs::write(&file, "mine").unwrap();
        assert!(place.refusal().is_some() && place.clean().is_err() && file.exists(), "{name}");
        fs::remove_file(&file).unwrap();
    }
    // A run may have been killed, or may be about to write the tag.
    let tree = base.canonicalize_utf8().unwrap();
    let made = [
        ("tree", tree.as_str()),
        (".clock.1-2.tmp", ""),
        (".CACHEDIR.TAG.12-0.tmp", ""),
        (".tree.1-0.tmp", ""),
    ];
    for (name, content) in made {
        fs::create_dir_all(place.directory()).unwrap();
        fs::write(place.directory().join(name), content).unwrap();
        assert_eq!((place.refusal(), place.clean()), (None, Ok(true)), "{name}");
        assert!(!place.directory().exists(), "{name}");
    }
}

#[test]
fn one_directory_that_is_refused_keeps_no_other_from_being_pruned() {
    let (_directory, base) = world();
    let home = CacheLocation::User(base.join("caches"));
    let [one, two] = ["one", "two"].map(|tree| TreeStore::of_tree(&home, &base.join(tree)));
    store(&one);
    store(&two);
    let open = [&one, &two].map(TreeStore::directory).into_iter().min().unwrap();
    fs::set_permissions(open, fs::Permissions::from_mode(0o777)).unwrap();
    fs::remove_dir(base.join("one")).unwrap();
    fs::remove_dir(base.join("two")).unwrap();
    assert!(home.prune().is_err_and(|it| it.path == open));
    assert_eq!([&one, &two].into_iter().filter(|it| it.directory().exists()).count(), 1);
}

#[test]
fn links_are_neither_read_nor_written_through() {
    let (_directory, base) = world();
    let place = TreeStore::of_tree(&CacheLocation::Named(base.join("named")), &base);
    store(&place);
    let key = Key::new("build", "question");
    let results = place.directory().join(key.file_name());
    fs::rename(&results, base.join("victim")).unwrap();
    symlink(base.join("victim"), &results).unwrap();
    assert!(place.load(&key).is_err());
    let before = fs::read(base.join("victim")).unwrap();
    for attempt in 0..3 {
        let name = format!(".clock.{}-{attempt}.tmp", std::process::id());
        symlink(base.join("victim"), place.directory().join(name)).unwrap();
    }
    place.clock().unwrap();
    store(&place);
    assert_eq!(fs::read(base.join("victim")).unwrap(), before);
    assert!(place.load(&key).unwrap().is_some());
}

#[test]
fn pruning_removes_the_results_of_trees_that_are_gone() {
    let (_directory, base) = world();
    let home = CacheLocation::User(base.join("caches"));
    let [one, two] = ["one", "two"].map(|tree| TreeStore::of_tree(&home, &base.join(tree)));
    store(&one);
    store(&two);
    assert_eq!(home.prune().unwrap(), 0);
    fs::remove_dir(base.join("two")).unwrap();
    assert_eq!(home.prune().unwrap(), 1);
    assert!(one.directory().is_dir() && !two.directory().exists());
}
