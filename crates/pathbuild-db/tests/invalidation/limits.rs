//! Walks that exceed the time limit are repeated, since the machine may be less busy the next time.

use std::time::Duration;

use pathbuild_db::{Reading, Role, Settings};
use salsa::Setter;

use crate::embedding::component;
use crate::world::{READING, World};

const PATH: &str = "lib/1111.1P.dxf";
const OTHER: &str = "lib/1112.1P.dxf";
const PROJECT: &str = "layer 8001.1P\nstart 0,0 \"T5 O3 Mx\"\nsubpath 0,0 300,0 \">1114.1P :B1\"\nend 300,0";

/// Returns a path with so many segments that the walk checks the clock.
fn long(name: &str, values: &str) -> String {
    let lines: Vec<String> = (0..300).map(|x| format!("mill {x},0 {},0\n", x + 1)).collect();
    format!("layer {name}\nstart 0,0 \"T5 O3 I1 Mx {values}\"\n{}end 300,0", lines.concat())
}

#[test]
fn a_walk_that_was_given_up_is_tried_again_after_any_change() {
    let mut world = World::new(&[
        (PATH, &long("1111.1P", "B0")),
        (OTHER, &component("1112.1P", "0")),
        ("lib/1114.1P.dxf", &long("1114.1P", "B=B :B0,1")),
        ("lib/8001.1P.dxf", PROJECT),
    ]);
    let reading = Reading { walk_time: Duration::ZERO, ..READING };
    _ = Settings::get(&world.db).set_reading(&mut world.db).to(reading);
    assert_eq!(world.judge("path", PATH, "1111.1P", Role::Checked), ["PB005"]);
    let found = world.judge("project", "lib/8001.1P.dxf", "8001.1P", Role::Checked);
    assert!(found.contains(&"PB005".to_owned()), "{found:?}");
    let with_values = "summary_with_values project".to_owned();
    assert!(world.ran().contains(&with_values), "{:?}", world.ran());

    world.run_again();
    assert!(world.run_again().is_empty(), "nothing changed");
    world.draw(OTHER, &component("1112.1P", "1"));
    let ran = world.run_again();
    assert!(ran.contains("file_index path") && ran.contains(&with_values), "{ran:?}");
}
