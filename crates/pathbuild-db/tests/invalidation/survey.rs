//! Surveyed drawings: what is known of them at once, and that it is what would be found path by path.

use pathbuild_db::{Limits, Role, Settings, Target, check_target, is_clear, locate, path_names};
use pathbuild_diagnostic::Diagnostic;
use salsa::Setter;

use crate::embedding::component;
use crate::world::World;

const PROJECT: &str = "layer 8001.1P\nstart 0,0 \"T5 O3 I1 Mx\"\nsubpath 0,0 20,0 \">1111.1P\"\nend 20,0";
/// Its second path has a variable, its third does not go on.
const SEVERAL: &str = "layer 1114.1P\nstart 0,50 \"T5 O3 I1 B0\"\nmill 0,50 20,50\nend 20,50\n\
    layer 1114.2P\nstart 0,60 \"T5 O3 I1 :B0,1\"\nmill 0,60 20,60 \"B=B\"\nend 20,60\n\
    layer 1114.3P\nstart 0,70 \"T5 O3 I1 B0\"\nmill 0,70 10,70\nend 20,70";
/// It embeds a path that is nowhere.
const ASTRAY: &str = "layer 8002.1P\nstart 0,0 \"T5 O3 I1 Mx\"\nsubpath 0,0 20,0 \">1119.1P\"\nend 20,0";

const DRAWINGS: [(&str, &[&str]); 5] = [
    ("lib/1111.1P.dxf", &["1111.1P"]),
    ("lib/1112.1P.dxf", &["1112.1P"]),
    ("lib/1114.1P.dxf", &["1114.1P", "1114.2P", "1114.3P"]),
    ("lib/8001.1P.dxf", &["8001.1P"]),
    ("lib/8002.1P.dxf", &["8002.1P"]),
];

fn world(is_surveyed: bool) -> World {
    let mut world = World::new(&[
        ("lib/1111.1P.dxf", &component("1111.1P", "0")),
        ("lib/1112.1P.dxf", &component("1112.1P", "9")),
        ("lib/1114.1P.dxf", SEVERAL),
        ("lib/8001.1P.dxf", PROJECT),
        ("lib/8002.1P.dxf", ASTRAY),
    ]);
    if is_surveyed {
        world.db.survey_drawings();
    }
    world
}

/// What a check finds in each path, located.
fn findings(world: &World) -> Vec<(String, Vec<Diagnostic>)> {
    let mut found = Vec::new();
    for (file, paths) in DRAWINGS {
        for path in paths {
            let (file, name) = world.path(file, path);
            let target = Target::new(&world.db, file, name.as_str().into(), Role::Checked);
            let located = check_target(&world.db, target).iter().cloned();
            found.push(((*path).to_owned(), located.map(|found| locate(&world.db, found)).collect()));
        }
    }
    found
}

fn clear(world: &World) -> Vec<&'static str> {
    let paths = DRAWINGS.iter().flat_map(|(file, paths)| paths.iter().map(move |path| (*file, *path)));
    let is_clear = |(file, path): &(&str, &str)| {
        let (file, name) = world.path(file, path);
        is_clear(&world.db, file, &name)
    };
    paths.filter(is_clear).map(|(_, path)| path).collect()
}

#[test]
fn what_is_found_in_surveyed_drawings_is_what_is_found_in_others() {
    let (surveyed, other) = (world(true), world(false));
    let found = findings(&surveyed);
    assert_eq!(found, findings(&other));
    let wrong: Vec<&str> =
        found.iter().filter(|(_, found)| !found.is_empty()).map(|(path, _)| path.as_str()).collect();
    assert_eq!(wrong, ["1112.1P", "1114.3P", "8002.1P"]);
    assert!(found.iter().flat_map(|(_, found)| found).all(|found| found.place.line.is_some()), "{found:?}");
    let names = |world: &World| path_names(&world.db, world.path("lib/1114.1P.dxf", "").0).to_vec();
    assert_eq!(names(&surveyed), names(&other));
}

#[test]
fn a_path_is_clear_if_nothing_is_found_in_it_and_it_embeds_nothing() {
    assert_eq!(clear(&world(true)), ["1111.1P", "1114.1P", "1114.2P"]);
    assert!(clear(&world(false)).is_empty());
    let surveyed = world(true);
    let (file, name) = surveyed.path("lib/1111.1P.dxf", "1119.1P");
    assert!(!is_clear(&surveyed.db, file, &name));
}

#[test]
fn a_path_beyond_the_limit_of_moves_is_not_clear() {
    let mut world = world(true);
    let moves = |world: &mut World, moves| {
        let limits = Limits { moves, ..Limits::default() };
        Settings::get(&world.db).set_limits(&mut world.db).to(limits);
    };
    let least = (0..1000).find(|least| {
        moves(&mut world, *least);
        clear(&world).contains(&"1111.1P")
    });
    let least = least.expect("some number of moves is enough");
    let too_many =
        |world: &World| findings(world)[0].1.iter().any(|found| found.code().to_string() == "PB005");
    assert!(!too_many(&world));
    moves(&mut world, least - 1);
    assert!(too_many(&world));
}

/// A library is gone through with one query for each drawing that embeds nothing.
#[test]
fn nothing_large_is_asked_of_what_is_clear() {
    let mut world = world(true);
    world.judge("project", "lib/8001.1P.dxf", "8001.1P");
    let ran = world.ran();
    assert!(ran.contains("survey project") && ran.contains("closure project"), "{ran:?}");
    for query in ["raw_file", "path_names", "file_report", "head", "summary", "find_path", "files_for"] {
        assert!(!ran.contains(&format!("{query} project")), "{query}: {ran:?}");
    }
}
