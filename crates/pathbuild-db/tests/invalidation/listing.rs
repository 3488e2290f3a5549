//! Tests directories that are listed before a query needs their names.

use crate::embedding::component;
use crate::world::World;

const PROJECT: &str = "lib/8001.1P.dxf";

/// Creates a project that embeds one path from a drawing named after it, and one from a drawing named after a range.
fn world() -> World {
    let project = "layer 8001.1P\nstart 0,0 \"T5 O3 Mx\"\nsubpath 0,0 20,0 \">1111.1P\"\n\
                   subpath 20,0 40,0 \">2222.1P\"\nend 40,0";
    World::new(&[
        ("lib/1111.1P.dxf", &component("1111.1P", "0")),
        ("lib/2000-2999.dxf", &component("2222.1P", "1")),
        (PROJECT, project),
    ])
}

fn is_made(world: &World) -> bool {
    world.outcome("project").program.is_some()
}

#[test]
fn names_that_another_thread_lists_are_waited_for() {
    let mut world = world();
    let pending = world.db.list_ahead("lib".into());
    let listing = std::thread::spawn(move || pending.run());
    world.ask("project", PROJECT, "8001.1P");
    assert!(is_made(&world), "{:?}", world.codes("project"));
    listing.join().unwrap();
}

/// The query uses the names of the listing and does not list the directory itself.
#[test]
fn the_names_are_those_of_the_listing() {
    let mut world = world();
    let pending = world.db.list_ahead("lib".into());
    pending.run();
    world.put_unnoticed("lib/1111.dxf", &component("1111.1P", "0"));
    world.ask("project", PROJECT, "8001.1P");
    assert!(is_made(&world));
    world.db.touch_directory("lib".into());
    assert_eq!(world.codes("project"), ["PB504"]);
}

#[test]
fn a_listing_that_never_runs_keeps_nobody_waiting() {
    let mut world = world();
    drop(world.db.list_ahead("lib".into()));
    world.ask("project", PROJECT, "8001.1P");
    assert!(is_made(&world));
}

/// A listing is valid only in the revision in which it began.
#[test]
fn names_that_change_before_they_are_wanted_are_listed_again() {
    let mut world = world();
    world.db.list_ahead("lib".into()).run();
    world.db.provide_names("parts".into(), ["1111.1P.dxf"].into_iter().collect());
    world.remove("lib/2000-2999.dxf");
    world.ask("project", PROJECT, "8001.1P");
    assert_eq!(world.codes("project"), ["PB503"]);
}

/// A caller that has walked the library can provide the names.
#[test]
fn names_that_are_known_are_not_listed_until_they_change() {
    let mut world = world();
    world.db.provide_names("lib".into(), ["1111.1P.dxf", "8001.1P.dxf"].into_iter().collect());
    world.ask("project", PROJECT, "8001.1P");
    assert_eq!(world.codes("project"), ["PB503"]);
    world.db.touch_directory("lib".into());
    assert!(is_made(&world));
}

/// A prefetched file is indexed, which does not affect where paths are found.
#[test]
fn prefetching_indexes_the_drawings_of_the_names_that_are_embedded() {
    let mut world = world();
    let file = world.file(PROJECT);
    pathbuild_db::prefetch(&world.db, file);
    world.ask("project", PROJECT, "8001.1P");
    assert!(is_made(&world));
    let indexed: Vec<&str> =
        world.ran().iter().map(String::as_str).filter(|query| query.starts_with("file_index")).collect();
    assert_eq!(indexed, ["file_index project"], "only the drawing of a range is still to be read");
}
