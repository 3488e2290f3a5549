//! Which language is spoken, and that it changes no program. (book: reference/configuration)

use crate::support::{Place, program};

const PATH: &str = r#"
== pathbuild.toml ==
feed = 100
rapid = 1000
sweep-height = 20
== 1234.1P.dxf ==
layer 1234.1P
start 0,0 "T5 O2 I5 B0 MPlate"
mill 0,0 40,0
end 40,0
"#;

const PROGRAM: &str = "1234.1P_Milling.gcode";

#[test]
fn messages_in_another_language_change_no_program() {
    let place = Place::of(PATH);
    assert_eq!(place.run("emit 1234.1P").status, Some(0));
    let written = place.read(PROGRAM);
    assert_eq!(place.run("emit 1234.1P --check --lang de").status, Some(0));
    assert_eq!(place.run("emit 1234.1P --lang de").status, Some(0));
    assert_eq!(place.read(PROGRAM), written);
    assert!(written.contains("Milling length"), "{written}");
}

#[test]
fn comments_are_of_the_language_of_the_configuration_or_its_own_key() {
    let written = |keys: &str, options: &str| {
        let place = Place::of(PATH);
        let place =
            place.file("pathbuild.toml", format!("feed = 100\nrapid = 1000\nsweep-height = 20\n{keys}"));
        let run = place.run(&format!("emit 1234.1P {options}"));
        assert_eq!(run.status, Some(0), "{run}");
        place.read(PROGRAM).contains("Milling length")
    };
    assert!(written("", ""));
    assert!(!written("lang = \"de\"\n", ""));
    assert!(!written("lang = \"de\"\n", "--lang en"), "an option for messages");
    assert!(written("lang = \"de\"\ncomment-lang = \"en\"\n", ""));
    assert!(!written("comment-lang = \"de\"\n", ""));
    assert!(!written("", "--compatible --lang de"), "the other program has one option for both");
}

#[test]
fn the_environment_comes_between_the_option_and_the_configurations() {
    let said = |variable: &str, option: &str| {
        let place = Place::of(PATH).users("lang = \"en\"\n");
        let mut program = program();
        program.env("PATHBUILD_LANG", variable).env("XDG_CONFIG_HOME", place.path());
        let output =
            program.args(["check", "1234.1P.dxf"]).args(option.split_whitespace()).current_dir(place.path());
        String::from_utf8(output.output().unwrap().stderr).unwrap()
    };
    assert!(said("de", "").contains("1 Pfad in 1 Zeichnung"));
    assert!(said("de_AT.UTF-8", "").contains("1 Pfad in 1 Zeichnung"));
    assert!(said("de", "--lang en").contains("1 path in 1 drawing"));
    for other in ["", "fr", "C"] {
        assert!(said(other, "").contains("1 path in 1 drawing"), "{other}");
    }
}
