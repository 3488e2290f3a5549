//! Tests that texts on unwanted layers are noted without being decoded.

use pathbuild_dxf::{Options, read};

use crate::support::{file, options};

/// Whether a drawing with layer P as its only wanted layer has a text that contains "B2".
fn is_noted(blocks: &str, entities: &str) -> bool {
    is_noted_with(blocks, entities, false)
}

fn is_noted_with(blocks: &str, entities: &str, compatible: bool) -> bool {
    let is_noted = |text: &[u8]| text.windows(2).any(|pair| pair == b"B2");
    let options =
        Options { keep_layer: &|name| name == "P", note_text: Some(&is_noted), compatible, ..options() };
    read(file("", "", blocks, entities).as_bytes(), &options).has_noted_text
}

#[test]
fn texts_on_unwanted_layers_are_noted() {
    assert!(is_noted("", "0 TEXT\n8 0\n10 0\n20 0\n40 2\n1 B2"));
    assert!(is_noted("", "0 TEXT\n1 B2\n10 0\n20 0\n40 2\n8 0"), "the text before the layer");
    assert!(is_noted("", "0 TEXT\n10 0\n20 0\n40 2\n1 B2"), "without a layer it is on 0");
    assert!(is_noted("", "0 MTEXT\n8 0\n10 0\n20 0\n40 2\n3 F1\n1 {B2}"));
    assert!(is_noted("", "0 TEXT\n8 0\n1 B1\n0 TEXT\n8 0\n1 B2\n0 TEXT\n8 0\n1 B3"));
    assert!(!is_noted("", "0 TEXT\n8 0\n1 B1\n0 TEXT\n8 0\n0 LINE\n8 0\n1 B2"));
    assert!(!is_noted("", "0 TEXT\n8 P\n10 0\n20 0\n40 2\n1 B2"), "a wanted layer");
    assert!(!is_noted("", "0 TEXT\n67 1\n8 0\n1 B2"), "paper space");
}

#[test]
fn texts_in_blocks_are_noted_where_a_block_is_inserted() {
    let block = "0 BLOCK\n8 0\n2 A\n70 0\n10 0\n20 0\n0 TEXT\n8 0\n10 0\n20 0\n40 2\n1 B2\n0 ENDBLK\n8 0";
    let insertion = "0 INSERT\n8 0\n2 A\n10 0\n20 0";
    assert!(is_noted(block, insertion));
    assert!(is_noted(block, &insertion.replace("8 0", "8 P")));
    assert!(!is_noted(block, "0 LINE\n8 0"));
    assert!(!is_noted(&block.replace("1 B2", "5 B2"), insertion), "a handle");
    assert!(!is_noted(&block.replace("0 TEXT\n8 0", "0 TEXT\n8 P"), insertion), "a wanted layer");
    assert!(is_noted(&block.replace("0 TEXT\n8 0", "0 TEXT"), insertion), "without a layer");
    assert!(!is_noted_with(block, insertion, true), "blocks do not count");
}

#[test]
fn labels_are_noted_on_any_layer() {
    for layer in ["0", "P"] {
        assert!(is_noted("", &format!("0 DIMENSION\n8 {layer}\n11 0\n21 0\n1 B2")), "{layer}");
        let leader = format!(
            "0 MULTILEADER\n8 {layer}\n300 CONTEXT_DATA{{\n10 0\n20 0\n304 B2\n304 LEADER_LINE{{\n305 }}\n301 }}"
        );
        assert!(is_noted("", &leader), "{layer}");
        assert!(!is_noted("", &leader.replace("304 B2", "304 B1")), "{layer}");
        assert!(!is_noted("", &leader.replace("304 B2", "305 B2")), "{layer}");
    }
}
