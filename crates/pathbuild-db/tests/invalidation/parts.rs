//! Tests finished parts: only edits of outlines and cuts check them again. (book: language/part)

use std::sync::Arc;

use pathbuild_db::{Role, Settings};
use pathbuild_path::{Language, LayerPattern, PartSettings};
use salsa::Setter;

use crate::world::World;

const FILE: &str = "lib/1111.1P.dxf";
const SIBLING: &str = "lib/1112.1P.dxf";
const PROJECT: &str = "lib/8001.1P.dxf";

/// Returns a path beside a plate. It may enter the upper edge of the plate, depending on `top`.
fn drawing(feed: &str, top: &str) -> String {
    component("1111.1P", feed, top)
}

fn component(name: &str, feed: &str, top: &str) -> String {
    format!(
        "layer {name}\nstart 0,-1 \"T5 O2 I1 B0 F{feed} Mx\"\nmill 0,-1 40,-1\nsweep 40,-1 40,21\nmill 40,21 0,21\n\
         end 0,21\nlayer Part\npolyline 0,0 40,0 40,{top} 0,{top} closed"
    )
}

/// Returns a project that embeds both components, far enough apart.
fn project() -> String {
    "layer 8001.1P\nstart 0,0 \"T5 O2 Mx\"\nsubpath 0,0 0,22 \">1111.1P\"\nsweep 0,22 100,0\n\
     subpath 100,0 100,22 \">1112.1P\"\nend 100,22"
        .to_owned()
}

fn name_parts(world: &mut World) {
    let settings = Settings::get(&world.db);
    let pattern = LayerPattern::new("Part").unwrap();
    let part = Some(PartSettings { pattern, tolerance: 0.02, is_held_otherwise: false });
    let language = Language { part, ..Language::clone(settings.language(&world.db)) };
    settings.set_language(&mut world.db).to(Arc::new(language));
}

#[test]
fn an_edit_beside_cuts_and_outlines_checks_no_part_again() {
    let mut world = World::new(&[(FILE, &drawing("100", "20"))]);
    name_parts(&mut world);
    let mut ran = |text: &str, codes: &[&str]| {
        world.draw(FILE, text);
        assert_eq!(world.judge("path", FILE, "1111.1P", Role::Checked), codes);
        assert!(world.ran().contains("file_index path"), "{:?}", world.ran());
        world.ran().contains("checked_parts path")
    };
    assert!(ran(&drawing("100", "20"), &[]));
    assert!(!ran(&drawing("120", "20"), &[]), "another feed");
    let other = format!("{}\nlayer Notes\nline 0,0 1,1", drawing("120", "20"));
    assert!(!ran(&other, &[]), "another layer");
    assert!(ran(&drawing("120", "20.5"), &["PB213"]), "the outline");
    assert!(ran(&drawing("120", "20.5").replace("21", "21.5"), &[]), "the cuts");
}

/// Creates two components with parts, and a project that embeds both.
fn world() -> World {
    let mut world = World::new(&[
        (FILE, &drawing("100", "20")),
        (SIBLING, &component("1112.1P", "100", "20")),
        (PROJECT, &project()),
    ]);
    name_parts(&mut world);
    world.ask("component", FILE, "1111.1P");
    world.ask("sibling", SIBLING, "1112.1P");
    world.ask("project", PROJECT, "8001.1P");
    for label in ["component", "sibling", "project"] {
        assert_eq!(world.codes(label), [""; 0], "{label}");
    }
    world
}

#[test]
fn an_edit_asks_for_the_parts_that_depend_on_it_and_no_others() {
    let of = |label: &str, queries: &str| -> Vec<String> {
        queries.split(' ').map(|query| format!("{query} {label}")).collect()
    };
    let mut world = world();
    let mut edit = |text: &str, component: &str, project: &str, spared: &[Vec<String>]| {
        world.draw(FILE, text);
        let ran = [
            of("component", "file_index raw_file raw_path"),
            of("component", component),
            of("project", project),
        ];
        let others = of("sibling", "file_index indexed_parts checked_parts closure program");
        let spared = [&[others], spared].concat().concat();
        let ran: Vec<&str> = ran.iter().flatten().map(String::as_str).collect();
        let spared: Vec<&str> = spared.iter().map(String::as_str).collect();
        world.expect(&ran, &spared);
    };
    // The outline is still correct, so no program is built again.
    let built = [of("component", "path chains program"), of("project", "program")];
    let judged = "path_index indexed_parts checked_parts closure";
    edit(&drawing("100", "19.99"), judged, "cuts_into_neighbours closure", &built);
    // The cut is still correct.
    let cut = drawing("100", "19.99").replace("40,-1", "40.5,-1");
    let built = format!("{judged} path chains program");
    edit(&cut, &built, "cuts_into_neighbours closure program", &[]);
    // The part check does not depend on the comment.
    let judged = [of("component", judged), of("project", "cuts_into_neighbours closure")];
    let comment = cut.replace("mill 40,21 0,21", "mill 40,21 0,21 \"Q(last)\"");
    edit(&comment, "path chains program", "program", &judged);
}
