//! Tests that each query depends on only one field of the settings.

use camino::Utf8PathBuf;
use pathbuild_db::Settings;
use pathbuild_path::{PathOptions, Restriction};
use salsa::Setter;

use crate::embedding::component;
use crate::world::World;

const PROJECT: &str = "layer 8001.1P\nstart 0,0 \"T5 O3 Mx\"\nsubpath 0,0 20,0 \">1111.1P\"\nend 20,0";

fn world() -> World {
    let mut world =
        World::new(&[("lib/1111.1P.dxf", &component("1111.1P", "0")), ("lib/8001.1P.dxf", PROJECT)]);
    world.ask("component", "lib/1111.1P.dxf", "1111.1P");
    world.ask("project", "lib/8001.1P.dxf", "8001.1P");
    world
}

const READING: [&str; 6] = [
    "file_index component",
    "file_index project",
    "raw_file component",
    "raw_file project",
    "raw_path component",
    "raw_path project",
];

const VALUES: [&str; 4] = ["path component", "path project", "chains component", "chains project"];

#[test]
fn another_feed_reads_no_drawing_again() {
    let mut world = world();
    let before = world.outcome("project");
    let fold = PathOptions { feed: Some(101.0), sweep_height: Some(20.0), ..PathOptions::default() };
    let settings = Settings::get(&world.db);
    settings.set_fold(&mut world.db).to(fold);
    world.expect(
        &["closure component", "closure project", "program component", "program project"],
        &[&READING[..], &VALUES, &["embeddings project", "resolve_path project", "name_table project"]]
            .concat(),
    );
    assert_ne!(world.outcome("project").program, before.program);
}

#[test]
fn a_restriction_runs_only_the_embedding() {
    let mut world = world();
    let settings = Settings::get(&world.db);
    settings.set_restrictions(&mut world.db).to(vec![Restriction::new("^8", "^2").unwrap()]);
    world.expect(
        &["embeddings project", "closure project", "program project"],
        &[&READING[..], &VALUES, &["resolve_path project", "closure component", "program component"]]
            .concat(),
    );
    assert_eq!(world.codes("project"), ["PB507"]);
}

#[test]
fn a_search_directory_runs_only_lookups() {
    let mut world = world();
    let settings = Settings::get(&world.db);
    settings.set_search(&mut world.db).to(vec![Utf8PathBuf::from("parts")]);
    world.expect(
        &["search_path project", "name_table new", "resolve_path project"],
        &[
            &READING[..],
            &VALUES,
            &["name_table project", "embeddings project", "closure project", "program project"],
        ]
        .concat(),
    );
}
