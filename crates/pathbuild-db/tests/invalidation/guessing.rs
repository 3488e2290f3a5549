//! Asking before a directory is listed: what is guessed, and what becomes of it when the names are known.

use pathbuild_db::{Insight, Lister};

use crate::embedding::component;
use crate::world::World;

const PROJECT: &str = "lib/8001.1P.dxf";

/// A project that embeds a path of a drawing of its name, and one of a drawing of a range.
fn world() -> World {
    let project = "layer 8001.1P\nstart 0,0 \"T5 O3 I1 Mx\"\nsubpath 0,0 20,0 \">1111.1P\"\n\
                   subpath 20,0 40,0 \">2222.1P\"\nend 40,0";
    World::new(&[
        ("lib/1111.1P.dxf", &component("1111.1P", "0")),
        ("lib/2000-2999.dxf", &component("2222.1P", "1")),
        (PROJECT, project),
    ])
}

fn guess(world: &mut World) -> Lister {
    world.db.begin_guessing("lib".into())
}

fn is_made(world: &World) -> bool {
    world.outcome("project").program.is_some()
}

fn list(world: &mut World, insight: Insight) {
    world.db.set_insight("lib".into(), insight);
}

#[test]
fn a_path_is_guessed_to_be_in_the_drawing_of_its_name_and_nowhere_else() {
    let mut world = world();
    let _lister = guess(&mut world);
    world.ask("project", PROJECT, "8001.1P");
    assert_eq!(world.codes("project"), ["PB503"]);
    assert!(!world.ran().contains("name_table project"), "{:?}", world.ran());
}

#[test]
fn where_no_drawing_has_its_name_the_names_are_waited_for() {
    let mut world = world();
    let lister = guess(&mut world);
    list(&mut world, Insight::Coming);
    let listing = std::thread::spawn(move || lister.run());
    world.ask("project", PROJECT, "8001.1P");
    assert!(is_made(&world), "{:?}", world.codes("project"));
    listing.join().unwrap();
}

/// Else all would be for nothing.
#[test]
fn a_right_guess_is_not_made_again() {
    let mut world = world();
    guess(&mut world).run();
    list(&mut world, Insight::Coming);
    world.ask("project", PROJECT, "8001.1P");
    assert!(is_made(&world));
    list(&mut world, Insight::Listed);
    world.expect(
        &["name_table new", "files_for project"],
        &["find_path project", "closure project", "program project"],
    );
    assert!(is_made(&world));
}

#[test]
fn a_wrong_guess_is_corrected() {
    let mut world = world();
    world.draw("lib/1111.dxf", &component("1111.1P", "0"));
    guess(&mut world).run();
    list(&mut world, Insight::Coming);
    world.ask("project", PROJECT, "8001.1P");
    assert!(is_made(&world));
    list(&mut world, Insight::Listed);
    assert_eq!(world.codes("project"), ["PB504"]);
}

#[test]
fn a_lister_that_never_runs_keeps_nobody_waiting() {
    let mut world = world();
    drop(guess(&mut world));
    list(&mut world, Insight::Coming);
    world.ask("project", PROJECT, "8001.1P");
    assert_eq!(world.codes("project"), ["PB503"]);
    list(&mut world, Insight::Listed);
    assert!(is_made(&world));
}

/// A listing is that of the revision in which it began.
#[test]
fn names_that_change_later_are_listed_again() {
    let mut world = world();
    guess(&mut world).run();
    list(&mut world, Insight::Listed);
    world.ask("project", PROJECT, "8001.1P");
    assert!(is_made(&world));
    world.remove("lib/2000-2999.dxf");
    assert_eq!(world.codes("project"), ["PB503"]);
}

/// Whoever has walked through a library knows the names already.
#[test]
fn names_that_somebody_knows_are_not_listed_until_they_change() {
    let mut world = world();
    world.db.know_names("lib".into(), ["1111.1P.dxf", "8001.1P.dxf"].into_iter().collect());
    world.ask("project", PROJECT, "8001.1P");
    assert_eq!(world.codes("project"), ["PB503"]);
    world.db.touch_directory("lib".into());
    assert!(is_made(&world));
}
