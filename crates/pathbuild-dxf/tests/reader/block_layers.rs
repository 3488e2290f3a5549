//! Tests that insertions matter only if they draw on a wanted layer, and that problems of all others are ignored. (book: language/layers-and-names)

use std::time::{Duration, Instant};

use pathbuild_diagnostic::Code;
use pathbuild_dxf::{Options, read};

use crate::support::{file, file_codes, file_faults, options};

/// Inserts a block on a layer, with different scales in x and y, so that contents on layer P are left out. Returns the number of entities left out on
/// layer P.
fn left_out(blocks: &str, layer: &str) -> usize {
    let insert = format!("0 INSERT\n8 {layer}\n2 B\n10 0\n20 0\n41 2\n42 3");
    let options = Options { keep_layer: &|name| name == "P", ..options() };
    let drawing = read(file("", "", blocks, &insert).as_bytes(), &options);
    assert!(drawing.entities.is_empty() && drawing.faults.is_empty() && drawing.diagnostics.is_empty());
    drawing.left_out.len()
}

fn block(name: &str, content: &str) -> String {
    format!("0 BLOCK\n8 0\n{name}\n10 0\n20 0\n{content}\n0 ENDBLK\n8 0\n")
}

/// Returns a LINE with these groups before its points.
fn line(groups: &str) -> String {
    format!("0 LINE\n{groups}\n10 0\n20 0\n11 1\n21 0\n")
}

/// Returns the result of [`left_out`] for inserting a block with this content on layer X.
fn left_out_with(content: &str) -> usize {
    left_out(&block("2 B", content), "X")
}

#[test]
fn the_layers_of_all_its_entities_count() {
    assert_eq!(left_out_with(&line("8 P")), 1);
    assert_eq!(left_out_with(&line("8 X")), 0);
    assert_eq!(left_out_with(&(line("8 X") + &line("8 P") + &line("8 X"))), 1);
}

#[test]
fn layer_0_is_that_of_the_insertion() {
    let named = block("2 B", &line("8 0"));
    assert_eq!((left_out(&named, "P"), left_out(&named, "X")), (1, 0));
    let unnamed = block("2 B", &line("62 1"));
    assert_eq!((left_out(&unnamed, "P"), left_out(&unnamed, "X")), (1, 0));
}

#[test]
fn texts_and_insertions_in_it_count() {
    assert_eq!(left_out_with("0 TEXT\n8 P\n1 A\n10 0\n20 0\n40 1"), 1);
    assert_eq!(left_out_with("0 TEXT\n8 X\n1 A\n10 0\n20 0\n40 1"), 0);
    let outer = |layer| block("2 B", "0 INSERT\n8 X\n2 C") + &block("2 C", &line(layer));
    assert_eq!((left_out(&outer("8 P"), "X"), left_out(&outer("8 X"), "X")), (1, 0));
}

#[test]
fn what_is_no_entity_of_model_space_does_not_count() {
    assert_eq!(left_out_with(&line("8 P\n67 0")), 1);
    assert_eq!(left_out_with(&line("8 P\n67 1")), 0);
    assert_eq!(left_out_with(&line("67 1\n8 P")), 0);
    assert_eq!(left_out_with("0 DIMENSION\n8 P"), 0);
    assert_eq!(left_out_with("0 VERTEX\n8 P"), 0);
}

#[test]
fn a_layer_in_the_group_of_an_application_does_not_count() {
    assert_eq!(left_out_with(&line("102 {X\n8 P\n102 }\n8 X")), 0);
    assert_eq!(left_out_with(&line("102 {X\n8 X\n102 }\n8 P")), 1);
}

#[test]
fn an_entity_that_names_two_layers_counts_if_both_are_wanted() {
    assert_eq!(left_out_with(&line("8 P\n8 P")), 1);
    assert_eq!(left_out_with(&line("8 P\n8 X")), 0);
    assert_eq!(left_out_with(&line("8 X\n8 P")), 0);
}

#[test]
fn a_block_without_a_name_changes_nothing_about_others() {
    let [wanted, other] = [line("8 P"), line("8 X")];
    assert_eq!(left_out(&(block("2 B", &wanted) + &block("70 0", &other)), "X"), 1);
    assert_eq!(left_out(&(block("70 0", &other) + &block("2 B", &wanted)), "X"), 1);
    assert_eq!(left_out(&(block("2 B", &other) + &block("70 0", &wanted)), "X"), 0);
}

/// If two blocks have the same name and either draws on a wanted layer, an insertion is a fault.
#[test]
fn of_two_blocks_of_a_name_each_counts() {
    let faults = |blocks: &str| {
        let file = file("", "", blocks, "0 INSERT\n8 X\n2 B\n10 0\n20 0");
        read(file.as_bytes(), &Options { keep_layer: &|name| name == "P", ..options() }).faults.len()
    };
    let [wanted, other] = [block("2 B", &line("8 P")), block("2 b", &line("8 X"))];
    assert_eq!(faults(&(wanted.clone() + &other)), 1);
    assert_eq!(faults(&(other.clone() + &wanted)), 1);
    assert_eq!(faults(&(other.clone() + &other)), 0, "neither draws anything wanted");
}

/// Returns the drawing with this block content inserted on layer X, while layers named P are wanted.
fn drawing(content: &str) -> String {
    file("", "", &block("2 B", content), "0 INSERT\n8 X\n2 B\n10 0\n20 0\n41 2\n42 3")
}

/// Returns the number of entities left out, and the codes of the findings about the file.
fn found(drawing: impl AsRef<[u8]>) -> (usize, Vec<Code>) {
    let drawing = read(drawing.as_ref(), &Options { keep_layer: &|name| name == "P", ..options() });
    (drawing.left_out.len(), file_codes(&drawing))
}

#[test]
fn a_layer_counts_however_its_code_and_lines_are_written() {
    // Test each offset within the bytes that are examined together.
    for before in 0..20 {
        let drawing = drawing(&(line(&format!("999 {:before$}\n8 X", "")) + &line("8 P")));
        for code in ["8", " 8", "  8", "   8", "8 ", "\t8\t", "008", " 08", "+8"] {
            let drawing = drawing.replace("  8\nP\n", &format!("{code}\nP\n"));
            for line_end in ["\n", "\r\n", "\r\r\n", "\r"] {
                assert_eq!(found(drawing.replace('\n', line_end)), (1, vec![]), "{code:?} {line_end:?}");
            }
        }
    }
}

#[test]
fn a_layer_that_has_to_be_decoded_counts() {
    assert_eq!(found(drawing(&line("8 \\U+0050"))), (1, vec![]));
    assert_eq!(found(drawing(&line("8 X|P"))), (1, vec![]));
}

/// There are very many layers, and line numbers must not be counted from the start of the file for each.
#[test]
fn blocks_that_name_very_many_layers_are_looked_at_in_time() {
    let many: String = (0..60_000).map(|number| line(&format!("8 L{number}\u{e4}"))).collect();
    let start = Instant::now();
    assert_eq!(found(drawing(&many)), (0, vec![]));
    assert_eq!(found(drawing(&(many + &line("8 P")))), (1, vec![]));
    assert!(start.elapsed() < Duration::from_secs(10), "{:?}", start.elapsed());
}

/// Damage in blocks is reported only if a block may draw on a wanted layer: otherwise the blocks are not read, like other unused sections.
#[test]
fn what_is_broken_in_blocks_is_told_if_they_may_hold_something_wanted() {
    let broken = |content: &str| drawing(content).replace(" 62\n1\n", " 6x\n1\n");
    assert_eq!(found(broken(&line("8 X\n62 1"))), (0, vec![]));
    assert_eq!(found(broken(&(line("8 X\n62 1") + &line("8 P")))), (0, vec![Code::InvalidDxf]));
    // A missing line turns each code into a value and each value into a code.
    let shifted = |content: &str| drawing(content).replace(" 62\n1\n", " 62\n");
    assert_eq!(found(shifted(&(line("8 X\n62 1") + &line("8 P")))), (0, vec![Code::InvalidDxf]));
}

/// Returns the findings about the file and the number of insertions left out, for these layers, blocks and entities. Layer P is wanted.
fn missing(tables: &str, blocks: &str, entities: &str) -> (Vec<String>, usize) {
    let file = file("", tables, blocks, entities);
    let drawing = read(file.as_bytes(), &Options { keep_layer: &|name| name == "P", ..options() });
    assert!(drawing.faults.is_empty());
    (file_faults(&drawing), drawing.left_out.len())
}

fn insert(layer: &str, block: &str) -> String {
    format!("0 INSERT\n8 {layer}\n2 {block}\n10 0\n20 0\n")
}

#[test]
fn a_missing_block_is_reported_once_whatever_the_layer_of_its_insertion() {
    let codes = |blocks: &str, entities: &str| {
        let (found, left_out) = missing("", blocks, entities);
        let text = "is left out: the file does not contain it";
        assert!(found.iter().all(|found| found.starts_with("PB111") && found.ends_with(text)), "{found:?}");
        (found.len(), left_out)
    };
    let other = block("2 B", &line("8 X"));
    assert_eq!(codes("", &insert("X", "N")), (1, 0));
    assert_eq!(codes(&other, &insert("X", "N")), (1, 0));
    assert_eq!(codes(&other, &(insert("X", "N") + &insert("0", "n"))), (1, 0));
    assert_eq!(codes(&other, &(insert("X", "N") + &insert("X", "M"))), (2, 0));
    assert_eq!(codes(&other, &insert("X", "B")), (0, 0));
    let reference = |content: &str| block("2 N\n70 4", content);
    assert_eq!(codes(&reference(""), &insert("X", "N")), (1, 0));
    assert_eq!(codes(&reference(&line("8 X")), &insert("X", "N")), (0, 0));
    // A missing block counts if a block that inserts it is inserted.
    let nested = block("2 B", &insert("Y", "N"));
    assert_eq!(codes(&nested, &insert("X", "B")), (1, 0));
    assert_eq!(codes(&nested, &(insert("X", "B") + &insert("X", "B"))), (1, 0));
    assert_eq!(codes(&(block("2 C", &insert("Z", "B")) + &nested), &insert("X", "C")), (1, 0));
    assert_eq!(codes(&(nested + &block("2 C", &line("8 X"))), &insert("X", "C")), (0, 0));
    // The rest of the block is left out all the same.
    let both = block("2 B", &(line("8 Y") + &insert("Y", "N")));
    assert_eq!(codes(&both, &insert("P", "B")), (1, 1));
}

#[test]
fn a_missing_block_on_a_frozen_layer_is_not_reported() {
    let tables = |flags: &str| format!("0 TABLE\n2 LAYER\n0 LAYER\n2 X\n{flags}\n0 ENDTAB");
    let nested = block("2 B", &insert("Y", "N"));
    for entities in [insert("X", "N"), insert("X", "B")] {
        assert_eq!(missing(&tables("70 1"), &nested, &entities), (vec![], 0));
        assert_eq!(missing(&tables("70 0\n62 -7"), &nested, &entities).0.len(), 1);
    }
}
