//! Tests edits of a library with two components, and a project that embeds one of them.

use crate::world::World;

/// Returns a component from (0, 0) to (20, 0).
pub(crate) fn component(name: &str, bottom: &str) -> String {
    format!("layer {name}\nstart 0,0 \"T5 O3 I1 Mx\"\nmill 0,0 20,0 \"B{bottom}\"\nend 20,0")
}

fn project(name: &str, embedded: &str) -> String {
    format!("layer {name}\nstart 0,0 \"T5 O3 Mx\"\nsubpath 0,0 20,0 \">{embedded}\"\nend 20,0")
}

const COMPONENT: &str = "lib/1111.1P.dxf";
const SIBLING: &str = "lib/1112.1P.dxf";
const PROJECT: &str = "lib/8001.1P.dxf";
const OUTER: &str = "lib/8002.1P.dxf";

/// Creates a library in which `outer` embeds `project`, which embeds `component`; `sibling` is not embedded.
fn world() -> World {
    let mut world = World::new(&[
        (COMPONENT, &component("1111.1P", "0")),
        (SIBLING, &component("1112.1P", "0")),
        (PROJECT, &project("8001.1P", "1111.1P")),
        (OUTER, &project("8002.1P", "8001.1P")),
    ]);
    world.ask("sibling", SIBLING, "1112.1P");
    world.ask("component", COMPONENT, "1111.1P");
    world.ask("project", PROJECT, "8001.1P");
    world.ask("outer", OUTER, "8002.1P");
    for label in ["sibling", "component", "project", "outer"] {
        assert!(world.outcome(label).program.is_some(), "{label}: {:?}", world.codes(label));
    }
    world
}

const OF_SIBLING: [&str; 8] = [
    "file_index sibling",
    "path_index sibling",
    "raw_file sibling",
    "raw_path sibling",
    "path sibling",
    "chains sibling",
    "closure sibling",
    "program sibling",
];

/// Queries that run for a project itself, apart from the paths it embeds.
const OF_PROJECT: [&str; 7] = [
    "file_index project",
    "path_index project",
    "raw_file project",
    "raw_path project",
    "path project",
    "chains project",
    "resolve_path project",
];

/// The range of [`OF_PROJECT`] that runs again after a change in the drawing: all except the look-up.
const DRAWN: std::ops::RangeTo<usize> = ..6;

#[test]
fn an_edited_component_runs_its_stages_and_the_placing_in_its_users() {
    let mut world = world();
    let before = ["project", "outer", "sibling"].map(|label| world.outcome(label));
    world.draw(COMPONENT, &component("1111.1P", "1"));
    world.expect(
        &[
            "file_index component",
            "raw_file component",
            "raw_path component",
            "path_index component",
            "path component",
            "chains component",
            "closure component",
            "program component",
            "resolve_path project",
            "embeddings project",
            "closure project",
            "program project",
            "closure outer",
            "program outer",
        ],
        &[
            &OF_SIBLING[..],
            &OF_PROJECT[DRAWN],
            &["name_table project", "path outer", "chains outer", "embeddings outer", "resolve_path outer"],
        ]
        .concat(),
    );
    let [project, outer, sibling] = before;
    assert_ne!(world.outcome("project").program, project.program);
    assert_ne!(world.outcome("outer").program, outer.program);
    assert_eq!(world.outcome("sibling"), sibling);
}

#[test]
fn a_remark_in_a_component_runs_only_the_reader() {
    let mut world = world();
    world.draw(COMPONENT, &format!("layer REMARKS\ntext 0,90 \"a remark\"\n{}", component("1111.1P", "0")));
    world.expect(
        &["file_index component", "raw_file component", "raw_path component"],
        &[
            &OF_PROJECT[..],
            &[
                "path_index component",
                "path component",
                "embeddings project",
                "closure project",
                "program outer",
            ],
        ]
        .concat(),
    );
}

#[test]
fn a_new_unrelated_file_runs_only_lookups() {
    let mut world = world();
    world.draw("lib/3000.1P.dxf", &component("3000.1P", "0"));
    world.expect(
        &["name_table project", "resolve_path project", "resolve_path outer"],
        &[
            &OF_SIBLING[..],
            &OF_PROJECT[DRAWN],
            &["embeddings project", "closure project", "program project", "program outer"],
        ]
        .concat(),
    );
}

/// A new file that may define the path according to its name is read; if it does not define the path, nothing else runs.
#[test]
fn a_new_file_that_could_hold_the_path_is_read() {
    let mut world = world();
    let before = world.outcome("project");
    world.draw("lib/1111 new.dxf", &component("1111.2P", "0"));
    world.expect(
        &[
            "name_table project",
            "resolve_path project",
            "resolve_path outer",
            "file_index new",
            "path_index new",
            "embeddings project",
        ],
        &[&OF_SIBLING[..], &["closure project", "program project", "program outer"]].concat(),
    );
    assert_eq!(world.outcome("project"), before);
}

#[test]
fn a_file_that_makes_a_path_ambiguous_makes_its_users_fail_and_removing_it_mends_them() {
    let mut world = world();
    let before = ["component", "project", "outer"].map(|label| world.outcome(label));
    world.draw("lib/1111 copy.dxf", &component("1111.1P", "0"));
    let of_users = [
        "name_table project",
        "resolve_path project",
        "resolve_path outer",
        "embeddings project",
        "closure project",
        "program project",
        "closure outer",
        "program outer",
    ];
    let spared = [
        &OF_SIBLING[..],
        &OF_PROJECT[DRAWN],
        &["path component", "closure component", "program component", "path outer"],
    ]
    .concat();
    world.expect(&[&of_users[..], &["file_index new", "path_index new"]].concat(), &spared);
    assert_eq!(world.codes("project"), ["PB504"]);
    assert_eq!(world.codes("outer"), ["PB504", "PB511"]);
    assert_eq!(world.outcome("component"), before[0]);
    world.remove("lib/1111 copy.dxf");
    world.expect(&of_users, &spared);
    assert_eq!(["component", "project", "outer"].map(|label| world.outcome(label)), before);
}

#[test]
fn a_component_that_is_gone_makes_its_users_fail_and_putting_it_back_mends_them() {
    let mut world = world();
    let before = ["component", "project", "outer"].map(|label| world.outcome(label));
    let bytes = world.bytes(COMPONENT);
    world.remove(COMPONENT);
    world.expect(
        &[
            "file_index component",
            "path_index component",
            "closure component",
            "program component",
            "name_table project",
            "resolve_path project",
            "resolve_path outer",
            "embeddings project",
            "closure project",
            "program project",
            "closure outer",
            "program outer",
        ],
        &[&OF_SIBLING[..], &OF_PROJECT[DRAWN], &["path outer", "raw_file component"]].concat(),
    );
    assert_eq!(world.codes("project"), ["PB503"]);
    assert_eq!(world.codes("outer"), ["PB503", "PB511"]);
    assert_eq!(world.outcome("component").program, None);
    world.put(COMPONENT, bytes);
    assert_eq!(["component", "project", "outer"].map(|label| world.outcome(label)), before);
}

#[test]
fn a_cycle_is_found_when_it_is_made_and_forgotten_when_it_is_mended() {
    let mut world = world();
    let before = ["component", "project", "outer"].map(|label| world.outcome(label));
    world.draw(COMPONENT, &project("1111.1P", "8001.1P"));
    assert_eq!(world.codes("project"), ["PB509"]);
    assert_eq!(world.codes("component"), ["PB509"]);
    assert_eq!(world.codes("outer"), ["PB509", "PB511"]);
    world.draw(COMPONENT, &component("1111.1P", "0"));
    world.expect(
        &[
            "file_index component",
            "raw_file component",
            "raw_path component",
            "path_index component",
            "closure component",
            "program component",
            "resolve_path project",
            "embeddings project",
            "closure project",
            "program project",
            "closure outer",
            "program outer",
        ],
        &[&OF_SIBLING[..], &OF_PROJECT[DRAWN], &["path outer", "embeddings outer"]].concat(),
    );
    assert_eq!(["component", "project", "outer"].map(|label| world.outcome(label)), before);
}
