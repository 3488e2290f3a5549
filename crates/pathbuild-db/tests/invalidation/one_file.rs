//! Tests edits of a drawing with two paths, and of a drawing beside it.

use crate::world::World;

const FILE: &str = "lib/1111.dxf";

/// A drawing of two paths. The first one has a letter without effect, which gives a warning with a position.
const DRAWING: &str = r#"
layer 1111.1P
start 0,0 "T5 O3 I1 B0"
mill 0,0 20,0 "S10"
mill 20,0 20,10
end 20,10
layer 1111.2P
start 0,50 "T5 O3 I1 B0"
mill 0,50 20,50
end 20,50
"#;

const OTHER: &str = "layer 1112.1P\nstart 0,0 \"T5 O3 I1 B0\"\nmill 0,0 20,0\nend 20,0";

fn world() -> World {
    let mut world = World::new(&[(FILE, DRAWING), ("lib/1112.dxf", OTHER)]);
    world.ask("sibling", FILE, "1111.2P");
    world.ask("path", FILE, "1111.1P");
    world.ask("other", "lib/1112.dxf", "1112.1P");
    assert_eq!(world.codes("path"), ["PB210"]);
    assert!(["path", "sibling", "other"].iter().all(|label| world.outcome(label).program.is_some()));
    world
}

/// The queries that depend on the first path.
const OF_PATH: [&str; 4] = ["path path", "chains path", "closure path", "program path"];

const OF_SIBLING: [&str; 4] = ["path sibling", "chains sibling", "closure sibling", "program sibling"];

/// The queries that read the drawing and extract its paths.
const READING: [&str; 4] = ["file_index sibling", "raw_file sibling", "raw_path path", "raw_path sibling"];

/// The queries that extract the paths from the drawing's index.
const INDEX: [&str; 2] = ["path_index path", "path_index sibling"];

const OF_OTHER: [&str; 8] = [
    "file_index other",
    "path_index other",
    "raw_file other",
    "raw_path other",
    "path other",
    "chains other",
    "closure other",
    "program other",
];

fn all_of(parts: &[&[&'static str]]) -> Vec<&'static str> {
    parts.concat()
}

#[test]
fn a_remark_before_the_first_element_runs_only_the_reader() {
    let mut world = world();
    let (before, outcome) = (world.place("path"), world.outcome("path"));
    world.draw(FILE, &format!("layer REMARKS\ntext 0,90 \"a remark\"\n{DRAWING}"));
    world.expect(&READING, &all_of(&[&INDEX, &OF_PATH, &OF_SIBLING, &OF_OTHER]));
    assert_eq!(world.outcome("path"), outcome);
    let after = world.place("path");
    assert!(after.line > before.line, "{before:?} {after:?}");
    assert!(after.handle > before.handle, "{before:?} {after:?}");
}

#[test]
fn a_comment_in_the_file_runs_only_the_reader() {
    let mut world = world();
    let (before, outcome) = (world.place("path"), world.outcome("path"));
    let text = String::from_utf8(world.bytes(FILE)).unwrap();
    let with_comment = text.replacen("ENTITIES\r\n", "ENTITIES\r\n999\r\na remark\r\n", 1);
    assert_ne!(text, with_comment);
    world.put(FILE, with_comment.into_bytes());
    world.expect(&READING, &all_of(&[&INDEX, &OF_PATH, &OF_SIBLING, &OF_OTHER]));
    assert_eq!(world.outcome("path"), outcome);
    let after = world.place("path");
    assert_eq!(after.line, before.line.map(|line| line + 2));
    assert_eq!(after.handle, before.handle);
}

#[test]
fn a_file_that_was_saved_without_a_change_runs_only_the_reader() {
    let mut world = world();
    world.draw(FILE, DRAWING);
    world.expect(&READING, &all_of(&[&INDEX, &OF_PATH, &OF_SIBLING, &OF_OTHER]));
}

/// If the walk cannot continue, all layers of the drawing are searched for the cause.
#[test]
fn a_remark_in_a_drawing_with_a_gap_runs_only_the_reader() {
    let gap = DRAWING.replace("mill 20,0 20,10", "mill 20,1 20,10");
    let mut world = World::new(&[(FILE, &gap)]);
    world.ask("path", FILE, "1111.1P");
    assert!(world.codes("path").contains(&"PB401".to_owned()));
    world.draw(FILE, &format!("layer REMARKS\ntext 0,90 \"a remark\"\n{gap}"));
    world.expect(&["file_index path"], &["path_index path", "closure path", "program path"]);
}

#[test]
fn a_moved_line_runs_the_stages_of_its_path() {
    let mut world = world();
    let before = world.outcome("path").program;
    let moved = DRAWING.replace("20,0 20,10", "20,0 20,11").replace("end 20,10", "end 20,11");
    world.draw(FILE, &moved);
    world.expect(&all_of(&[&READING, &INDEX, &OF_PATH]), &all_of(&[&OF_SIBLING, &OF_OTHER]));
    assert_ne!(world.outcome("path").program, before);
}

#[test]
fn a_changed_parameter_text_runs_the_stages_of_its_path() {
    let mut world = world();
    let before = world.outcome("path").program;
    world.draw(FILE, &DRAWING.replacen("B0", "B1", 1));
    world.expect(&all_of(&[&READING, &INDEX, &OF_PATH]), &all_of(&[&OF_SIBLING, &OF_OTHER]));
    assert_ne!(world.outcome("path").program, before);
}

#[test]
fn an_edited_sibling_runs_nothing_of_the_path() {
    let mut world = world();
    let before = world.outcome("path");
    world.draw(FILE, &DRAWING.replace("mill 0,50 20,50", "mill 0,50 10,60\nmill 10,60 20,50"));
    world.expect(&all_of(&[&READING, &INDEX, &OF_SIBLING]), &all_of(&[&OF_PATH, &OF_OTHER]));
    assert_eq!(world.outcome("path"), before);
}

/// Renaming a layer renames its path: the path is no longer found under the old name, and the other path is not affected.
#[test]
fn a_renamed_sibling_runs_nothing_of_the_path() {
    let mut world = world();
    world.draw(FILE, &DRAWING.replace("layer 1111.2P", "layer 1111.3P"));
    world.expect(
        &all_of(&[&READING[..3], &INDEX, &["closure sibling", "program sibling"]]),
        &all_of(&[&OF_PATH, &OF_OTHER]),
    );
    assert_eq!(world.outcome("sibling").program, None);
}

#[test]
fn an_edit_of_another_file_runs_nothing_here() {
    let mut world = world();
    world.draw("lib/1112.dxf", &OTHER.replace("B0", "B1"));
    world.expect(&OF_OTHER, &all_of(&[&READING, &OF_PATH, &OF_SIBLING]));
}
