//! Tests that memory is bounded: some values are evicted and others stay, and eviction does not change results.

use pathbuild_db::Role;

use crate::embedding::component;
use crate::world::World;

const PROJECT: &str = "layer 8001.1P\nstart 0,0 \"T5 O3 Mx\"\nsubpath 0,0 20,0 \">1111.1P\"\nend 20,0";
const OTHER: &str = "layer 8002.1P\nstart 0,0 \"T5 O3 Mx\"\nsubpath 0,0 20,0 \">1111.1P\"\nend 20,0";

/// The queries with large values: the entities of a drawing, and the stages of a path.
const LARGE: [&str; 4] = ["raw_file component", "raw_path component", "path component", "chains component"];

/// Number of drawings, which is greater than the number whose large values stay in memory.
const MANY: usize = 300;

fn world() -> World {
    let mut world = World::new(&[
        ("lib/1111.1P.dxf", &component("1111.1P", "0")),
        ("lib/1112.1P.dxf", &component("1112.1P", "9")),
        ("lib/8001.1P.dxf", PROJECT),
        ("lib/8002.1P.dxf", OTHER),
    ]);
    let template = crate::world::dxf(&component("5000.1P", "0"));
    let template = String::from_utf8(template).unwrap();
    for number in 5000..5000 + MANY {
        world.put(
            &format!("lib/{number}.1P.dxf"),
            template.replace("5000.1P", &format!("{number}.1P")).into(),
        );
    }
    world.ask("component", "lib/1111.1P.dxf", "1111.1P");
    world.ask("project", "lib/8001.1P.dxf", "8001.1P");
    world.ask("wrong", "lib/1112.1P.dxf", "1112.1P");
    for number in 5000..5000 + MANY {
        world.ask("many", &format!("lib/{number}.1P.dxf"), &format!("{number}.1P"));
    }
    world
}

#[test]
fn a_project_is_judged_without_the_paths_it_embeds() {
    let mut world = world();
    world.db.drop_unused();
    let codes = world.judge("other", "lib/8002.1P.dxf", "8002.1P", Role::Emitted);
    assert!(codes.is_empty(), "{codes:?}");
    let ran = world.ran();
    assert!(ran.contains("closure other") && ran.contains("embeddings other"), "{ran:?}");
    assert!(LARGE.iter().all(|query| !ran.contains(*query)), "{ran:?}");
}

/// The program needs the paths, which were evicted and are therefore computed again.
#[test]
fn what_was_dropped_is_made_again_and_is_the_same() {
    let mut world = world();
    let labels = ["component", "wrong", "project"];
    let before = labels.map(|label| world.outcome(label));
    assert_eq!(world.codes("wrong"), ["PB203"]);
    let place = world.place("wrong");
    for number in 5000..5000 + MANY {
        world.ask("many", &format!("lib/{number}.1P.dxf"), &format!("{number}.1P"));
    }
    world.db.drop_unused();
    world.ask("other", "lib/8002.1P.dxf", "8002.1P");
    let ran = world.ran();
    assert!(LARGE[1..].iter().any(|query| ran.contains(*query)), "{ran:?}");
    assert_eq!(world.place("wrong"), place);
    assert_eq!(labels.map(|label| world.outcome(label)), before);
}

#[test]
fn an_edit_after_values_were_dropped_is_seen() {
    let mut world = world();
    world.db.drop_unused();
    world.draw("lib/1111.1P.dxf", &component("1111.1P", "9"));
    assert_eq!(world.codes("project"), ["PB203", "PB511"]);
    world.db.drop_unused();
    world.draw("lib/1111.1P.dxf", &component("1111.1P", "0"));
    assert!(world.codes("project").is_empty());
}
