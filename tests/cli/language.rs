//! Tests the language of messages, which does not affect programs. (book: reference/configuration)

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
fn the_language_of_comments_is_shown_as_it_applies() {
    let shown = |keys: &str| {
        let run = Place::new().file("pathbuild.toml", keys).run("config show --origin");
        run.stdout.lines().find(|line| line.starts_with("comment-lang")).unwrap().to_owned()
    };
    assert_eq!(shown(""), "comment-lang = \"en\"  # default");
    assert_eq!(shown("lang = \"de\""), "comment-lang = \"de\"  # default");
    assert_eq!(shown("lang = \"de\"\ncomment-lang = \"en\""), "comment-lang = \"en\"  # line 2");
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
    assert!(said("", "").contains("1 path in 1 drawing"));
    assert!(said("en_GB", "").contains("1 path in 1 drawing"));
    for other in ["fr", "C"] {
        let refusal = format!("PATHBUILD_LANG={other}: the language must be en or de");
        assert!(said(other, "").contains(&refusal), "{other}");
    }
}

/// The system's locale has the lowest priority, and only affects messages.
#[test]
fn the_systems_locale_is_the_last_that_is_asked() {
    let run = |keys: &str, variables: &[(&str, &str)], arguments: &str| {
        let place = Place::of(PATH).users(keys);
        let mut program = program();
        program.env("LC_ALL", "").env("XDG_CONFIG_HOME", place.configurations());
        program.envs(variables.iter().copied()).current_dir(place.path());
        let output = program.args(arguments.split_whitespace()).output().unwrap();
        let messages = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap()).concat();
        let written = std::fs::read_to_string(place.path().join(PROGRAM)).unwrap_or_default();
        (messages, written)
    };
    let is_german = |keys: &str, variables: &[(&str, &str)], option: &str| {
        let (messages, _) = run(keys, variables, &format!("check 1234.1P.dxf {option}"));
        let (de, en) = (messages.contains("1 Pfad in"), messages.contains("1 path in"));
        assert_ne!(de, en, "{variables:?}: {messages}");
        de
    };
    for german in ["de", "de_DE.UTF-8", "de_AT@euro", "DE-CH"] {
        assert!(is_german("", &[("LANG", german)], ""), "{german}");
    }
    for other in ["C", "C.UTF-8", "POSIX", "fr_FR.UTF-8", "den_CA", "en_US.UTF-8"] {
        assert!(!is_german("", &[("LANG", other)], ""), "{other}");
    }
    assert!(is_german("", &[("LC_MESSAGES", "de_DE.UTF-8"), ("LANG", "C")], ""));
    assert!(!is_german("", &[("LC_MESSAGES", "en_GB"), ("LANG", "de_DE.UTF-8")], ""));
    assert!(is_german("", &[("LC_ALL", "de_DE.UTF-8"), ("LC_MESSAGES", "C"), ("LANG", "C")], ""));
    assert!(!is_german("", &[("LC_ALL", "C"), ("LANG", "de_DE.UTF-8")], ""));
    let german = [("LANG", "de_DE.UTF-8")];
    assert!(!is_german("", &german, "--lang en"));
    assert!(!is_german("lang = \"en\"\n", &german, ""));
    assert!(!is_german("", &[("LANG", "de_DE.UTF-8"), ("PATHBUILD_LANG", "en")], ""));
    for options in ["", "--compatible"] {
        let (messages, written) = run("", &german, &format!("emit 1234.1P {options}"));
        assert!(messages.contains("geschrieben"), "{messages}");
        assert!(written.contains("Milling length"), "{written}");
    }
    let (messages, _) = run("", &german, "--help");
    assert!(messages.contains("Aufruf") || messages.contains("Befehle"), "{messages}");
}

/// A language in the configuration applies to all users of that tree.
#[test]
fn the_configurations_language_comes_before_the_systems_locale() {
    let place = Place::of(PATH).file("pathbuild.toml", "lang = \"en\"\nfeed = 100\n");
    let mut program = program();
    program.env("LC_ALL", "de_DE.UTF-8").args(["check", "1234.1P.dxf"]).current_dir(place.path());
    let messages = String::from_utf8(program.output().unwrap().stderr).unwrap();
    assert!(messages.contains("1 path in 1 drawing"), "{messages}");
}
