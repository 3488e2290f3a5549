//! Surveyed drawings: what is known of them at once, and that it is what would be found path by path.

use pathbuild_db::{
    Clear, Limits, Role, Settings, SourceFile, Target, check_file, check_target, clear, locate, path_names,
    survey, trace,
};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_path::PathName;
use salsa::Setter;

use crate::embedding::component;
use crate::world::World;

/// Its second path has a variable, its third does not go on.
const SEVERAL: &str = "layer 1114.1P\nstart 0,50 \"T5 O3 I1 Mx B0\"\nmill 0,50 20,50\nend 20,50\n\
    layer 1114.2P\nstart 0,60 \"T5 O3 I1 Mx :B0,1\"\nmill 0,60 20,60 \"B=B\"\nend 20,60\n\
    layer 1114.3P\nstart 0,70 \"T5 O3 I1 Mx B0\"\nmill 0,70 10,70\nend 20,70";

/// Each drawing with its paths.
const DRAWINGS: [(&str, &[&str]); 11] = [
    ("lib/1111.1P.dxf", &["1111.1P"]),
    ("lib/1112.1P.dxf", &["1112.1P"]),
    ("lib/1114.1-1114.3P.dxf", &["1114.1P", "1114.2P", "1114.3P"]),
    ("lib/8001.1P.dxf", &["8001.1P"]),
    ("lib/8002.1P.dxf", &["8002.1P"]),
    ("lib/8003.1P.dxf", &["8003.1P"]),
    ("lib/8004.1P.dxf", &["8004.1P"]),
    ("lib/8005.1P.dxf", &["8005.1P"]),
    ("lib/8006.1P.dxf", &["8006.1P"]),
    ("lib/8007.1P.dxf", &["8007.1P"]),
    ("lib/8008.1P.dxf", &["8008.1P"]),
];

fn project(path: &str, embedded: &str, length: u32) -> String {
    format!("layer {path}\nstart 0,0 \"T5 O3 I1 Mx\"\nsubpath 0,0 {length},0 \"{embedded}\"\nend {length},0")
}

fn world(is_surveyed: bool) -> World {
    let mut world = World::new(&[
        ("lib/1111.1P.dxf", &component("1111.1P", "0")),
        ("lib/1112.1P.dxf", &component("1112.1P", "9")),
        ("lib/1114.1-1114.3P.dxf", SEVERAL),
        ("lib/8001.1P.dxf", &project("8001.1P", ">1111.1P", 20)),
        ("lib/8002.1P.dxf", &project("8002.1P", ">1119.1P", 20)),
        ("lib/8003.1P.dxf", &project("8003.1P", ">8001.1P", 20)),
        ("lib/8004.1P.dxf", &project("8004.1P", ">1111.1P", 21)),
        ("lib/8005.1P.dxf", &project("8005.1P", ">1114.2P :B1", 20)),
        ("lib/8006.1P.dxf", &project("8006.1P", ">1114.2P :B2", 20)),
        ("lib/8007.1P.dxf", &project("8007.1P", ">1114.3P", 20)),
        ("lib/8008.1P.dxf", &project("8008.1P", ">8008.1P", 20)),
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

fn traced(world: &World, file: SourceFile, name: &PathName) -> Option<Clear> {
    clear(&world.db, file, survey(&world.db, file), name, true)
}

fn clear_without_trace(world: &World, file: SourceFile, name: &PathName) -> Option<Clear> {
    clear(&world.db, file, survey(&world.db, file), name, false)
}

fn clear_paths(world: &World) -> Vec<&'static str> {
    let paths = DRAWINGS.iter().flat_map(|(file, paths)| paths.iter().map(move |path| (*file, *path)));
    let is_clear = |(file, path): &(&str, &str)| {
        let (file, name) = world.path(file, path);
        traced(world, file, &name).is_some()
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
    assert_eq!(wrong, ["1112.1P", "1114.3P", "8002.1P", "8004.1P", "8006.1P", "8007.1P", "8008.1P"]);
    assert!(found.iter().flat_map(|(_, found)| found).all(|found| found.place.line.is_some()), "{found:?}");
    let names = |world: &World| path_names(&world.db, world.path(DRAWINGS[2].0, "").0).to_vec();
    assert_eq!(names(&surveyed), names(&other));
}

/// What embeds a path that embeds others is looked at more closely.
#[test]
fn a_path_is_clear_if_nothing_is_found_in_it_or_what_it_embeds() {
    assert_eq!(clear_paths(&world(true)), ["1111.1P", "1114.1P", "1114.2P", "8001.1P", "8005.1P"]);
    let surveyed = world(true);
    let (file, name) = surveyed.path("lib/1111.1P.dxf", "1119.1P");
    assert!(traced(&surveyed, file, &name).is_none());
}

#[test]
fn a_clear_path_has_the_trace_that_it_would_have_else() {
    let world = world(true);
    for file in ["lib/1111.1P.dxf", "lib/8001.1P.dxf", "lib/8005.1P.dxf"] {
        let (file, name) = world.path(file, file.strip_prefix("lib/").unwrap().strip_suffix(".dxf").unwrap());
        let target = Target::new(&world.db, file, name.as_str().into(), Role::Checked);
        let clear = traced(&world, file, &name).unwrap();
        assert_eq!(clear.trace.as_ref(), Some(trace(&world.db, target)));
        let untraced = clear_without_trace(&world, file, &name);
        assert_eq!(untraced, Some(Clear { trace: None, ..clear }));
    }
}

#[test]
fn a_clear_path_knows_the_drawings_of_what_it_embeds_that_have_something_wrong_as_a_whole() {
    let mut world = world(true);
    let (project, name) = world.path("lib/8001.1P.dxf", "8001.1P");
    assert_eq!(clear_without_trace(&world, project, &name).unwrap().faulty, []);
    let mut bytes = world.bytes("lib/1111.1P.dxf");
    bytes.truncate(bytes.trim_ascii_end().len() - "EOF".len());
    world.put("lib/1111.1P.dxf", bytes);
    let (component, _) = world.path("lib/1111.1P.dxf", "");
    assert!(!check_file(&world.db, component).is_empty());
    assert_eq!(clear_without_trace(&world, project, &name).unwrap().faulty, [component]);
}

#[test]
fn a_path_beyond_a_limit_is_not_clear() {
    let most = Limits::default();
    let limits = [
        ("1111.1P", (|moves| Limits { moves, ..Limits::default() }) as fn(u64) -> Limits),
        ("8001.1P", |moves| Limits { moves, ..Limits::default() }),
        ("8001.1P", |paths| Limits { paths, ..Limits::default() }),
    ];
    for (path, limits) in limits {
        let mut world = world(true);
        let set = |world: &mut World, limits| Settings::get(&world.db).set_limits(&mut world.db).to(limits);
        let least = (0..1000).find(|least| {
            _ = set(&mut world, limits(*least));
            clear_paths(&world).contains(&path)
        });
        let is_refused = |world: &World| {
            let found = findings(world).into_iter().find(|(found, _)| found == path).unwrap().1;
            found.iter().any(|found| found.code().to_string() == "PB005")
        };
        assert!(!is_refused(&world), "{path}");
        _ = set(&mut world, limits(least.unwrap() - 1));
        assert!(is_refused(&world), "{path}");
        _ = set(&mut world, most);
        assert!(!is_refused(&world), "{path}");
    }
}

/// A library is gone through with one query for each drawing of which there is nothing to say.
#[test]
fn nothing_large_is_asked_of_what_is_clear() {
    let mut world = world(true);
    world.judge("nested", "lib/8003.1P.dxf", "8003.1P", Role::Checked);
    let ran = world.ran();
    assert!(ran.contains("survey nested") && ran.contains("closure nested"), "{ran:?}");
    for query in
        ["raw_file", "path", "path_names", "file_report", "head", "summary", "find_path", "files_for"]
    {
        assert!(!ran.contains(&format!("{query} nested")), "{query}: {ran:?}");
    }
}
