//! Tests the messages about mistakes of draughtsmen, word for word and in both languages.

use insta::assert_snapshot;
use pathbuild_testkit::sheet;

use crate::support::Place;

const CONFIGURATION: &str = "sweep-height = 20\nfeed = 100\npart = 'Part'\nkeep-out = 'Clamp'\n";

/// Returns the output of `check` for a drawing, in both languages.
fn check_output(drawing: &str) -> String {
    let drawing = sheet(drawing).unwrap_or_else(|faults| panic!("{faults:?} in\n{drawing}"));
    let place = Place::new().file("pathbuild.toml", CONFIGURATION).file("1234.1P.dxf", drawing.to_dxf());
    ["en", "de"].map(|lang| place.run(&format!("check . --lang {lang}")).to_string()).join("\n")
}

/// Returns the drawing of a path that mills a groove with this text.
fn groove(text: &str) -> String {
    format!("version R2010\nlayer 1234.1P\nstart 0,0 \"T4 O2 I1 B0\"\nmill 0,0 40,0 \"{text}\"\nend 40,0\n")
}

/// Returns the drawing of a path without a text at its start, followed by further statements.
fn without_start_text(other: &str) -> String {
    format!("layer 1234.1P\nstart 0,0\nmill 0,0 40,0\nend 40,0\n{other}\n")
}

const START: &str = "layer 1234.1P\nstart 0,0 \"T4 O2 I1 B0\"\n";

#[test]
fn numbers_and_letters() {
    for (name, text) in [
        ("minus", "B\u{2212}0.3"),
        ("full_width_digit", "B\u{ff12}"),
        ("cyrillic_letter", "\u{412}2"),
        ("letter_for_zero", "BO,3"),
        ("letter_for_one", "Bl.5"),
        ("no_space", "B2F100"),
        ("semicolon", "B2;F100"),
        ("word", "B2 tief"),
        ("diameter_sign", "%%c3"),
        ("count", "3x M3"),
        ("as_deep_as_thick", "B-4"),
        ("unknown_and_out_of_range", "Z-2"),
        ("unused_and_out_of_range", "S3"),
        ("name_on_groove", ">1234.2P"),
    ] {
        assert_snapshot!(name, check_output(&groove(text)));
    }
    assert_snapshot!(
        "start_without_spaces",
        check_output(
            "layer 1234.1P\nstart 0,0 \"O3T4I1F200B-0.3\"\nmill 0,0 40,0\nmill to 40,20\nend 40,20\n"
        )
    );
}

#[test]
fn texts_in_the_wrong_place() {
    for (name, drawing) in [
        ("start_text_on_layer_0", without_start_text("layer 0\ntext -1,-1 \"T4 O2 I1 B0\"")),
        ("start_text_on_line", without_start_text("text 3,0 \"T4 O2 I1 B0\"")),
        (
            "markers_swapped",
            "layer 1234.1P\nend 0,0\nmill 0,0 40,0\nstart 40,0\ntext -0.5,-0.5 \"T4 O2 I1 B0\" height 1\n"
                .to_owned(),
        ),
        ("start_missing", "layer 1234.1P\nmill 0,0 40,0\nend 40,0\ntext -1,-1 \"T4 O2 I1 B0\"\n".to_owned()),
        (
            "text_near_part",
            format!(
                "{START}mill 0,0 40,0\nend 40,0\ntext 80,50 \"T4 O2 I1 B0\"\nlayer Part\ncircle 80,50 d 1\n"
            ),
        ),
        (
            "name_on_layer_0",
            format!("{START}mill 0,0 40,0\nsubpath 40,0 60,0\nend 60,0\nlayer 0\ntext 45,0 \">1234.2P\"\n"),
        ),
        (
            "name_at_circle",
            format!(
                "{START}mill 0,0 40,0\nsubpath 40,0 60,0\nend 60,0\nprobe 50,4\ntext 48,1 \">1234.2P\"\n"
            ),
        ),
        ("variable_apart", format!("{START}mill 0,0 40,0\nsubpath 40,0 60,0 \":B 1 >1234.2P\"\nend 60,0\n")),
        ("blank_text", format!("{START}mill 0,0 40,0\ntext 20,0 \"   \"\ntext 18,0.2 \"B1\"\nend 40,0\n")),
        ("blank_text_far", format!("{START}mill 0,0 40,0\ntext 20,30 \"   \"\nend 40,0\n")),
    ] {
        assert_snapshot!(name, check_output(&drawing));
    }
}

#[test]
fn layers_blocks_and_line_types() {
    for (name, drawing) in [
        (
            "missing_block",
            format!(
                "block X\nlayer 1234.1P\nline 0,0 1,1\nendblock\n{START}mill 0,0 40,0\nend 40,0\nlayer 0\ninsert X at 5,5\nset 2 Plate\n"
            ),
        ),
        (
            "line_type_with_hyphen",
            format!("linetype STRICH-PUNKT\n{START}line STRICH-PUNKT 0,0 40,0\nend 40,0\n"),
        ),
        (
            "cyrillic_layer",
            format!("{START}mill 0,0 40,0\nend 40,0\nlayer \"1234.1\u{420}\"\nline 5,5 20,5\n")
                .replace("layer 1234.1P", "version R2010\nlayer 1234.1P"),
        ),
        ("cyrillic_layer_alone", "version R2010\nlayer \"1234.1\u{420}\"\nline 5,5 20,5\n".to_owned()),
        (
            "cut_into_clamp",
            format!(
                "{START}mill 0,0 40,0\nend 40,0\nlayer Clamp\ncircle 20,0 d 6\ntext 19,-1 \"Z10\" height 1\n"
            ),
        ),
        (
            "equally_near",
            format!(
                "{START}mill 0,0 40,0\nmill 40,0 40,10\nmill to 0,10\nend 0,10\ntext 20,5 \"B1\" align middle middle height 9\n"
            ),
        ),
        ("no_end_there", format!("{START}mill 0,0 40,0\nmill 20,0 20,10\nend 40,0\n")),
    ] {
        assert_snapshot!(name, check_output(&drawing));
    }
}

#[test]
fn outlines_of_parts() {
    let path = "layer 1234.1P\nstart -5,-5 \"T2 O2 I0.5 B-0.2 D0.8 P3 U8 A20\"\nsweep -5,-5 11,13\nmill circle 11,13 d 10\n\
        sweep 11,13 0,0\nbars 0,0 42,0\nbars to 42,27 0,27 0,0\nsweep 0,0 50,-5\nend 50,-5\nlayer Part\ncircle 11,13 d 10\n";
    for (name, outline) in [
        ("gap", "line 1,1 41,1\nline 41,1 41,26\nline 41,26 1,26\nline 1,26 1,2"),
        ("overlong", "line 0.5,1 41,1\nline 41,1 41,26\nline 41,26 1,26\nline 1,26 1,0.5"),
        ("eight", "polyline 1,1 41,26 41,1 1,26 closed"),
        ("circle_across_rim", "polyline 1,1 41,1 41,26 1,26 closed\ncircle 41,13 d 4"),
    ] {
        assert_snapshot!(name, check_output(&format!("{path}{outline}\n")));
    }
}
