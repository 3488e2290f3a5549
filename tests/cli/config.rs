//! Tests the configuration: discovery, strict parsing, precedence of the command line. (book: reference/configuration)

use crate::support::{Place, Run, runs};
use insta::assert_snapshot;
use pathbuild_testkit::sheet;

fn show(text: &str, arguments: &str) -> Run {
    Place::new().file("pathbuild.toml", text).run(&format!("config show --origin {arguments}"))
}

/// Returns the findings about this configuration in concise form.
fn complaints(text: &str) -> String {
    let run = Place::new().file("pathbuild.toml", text).run("config show --format concise");
    assert_eq!((run.status, run.stdout.as_str()), (Some(2), ""), "{run}");
    run.stderr
}

/// Returns the line that `config show` prints for a key.
fn line(run: &Run, key: &str) -> String {
    let lines = run.stdout.lines();
    lines
        .filter(|line| line.contains(key))
        .map(str::to_owned)
        .next()
        .unwrap_or_else(|| panic!("no {key} in {run}"))
}

#[test]
fn without_a_configuration_defaults_hold() {
    assert_snapshot!(Place::new().run("config show"));
}

#[test]
fn every_value_is_shown_with_where_it_comes_from() {
    let text = r#"
feed = 150
rapid = 1_000.5
library = ["components", "../projects"]
restrict = ["^8:P$"]
search = []
units = "mm"
out-dir = "out"
z-model = "tin"

[line-types]
"MITTE" = "CENTER"

[emit]
targets = ["8*"]

[severity]
PB210 = "ignore"
turn-marker-without-effect = "error"

[[severity-in]]
files = ["old/**"]
PB112 = "ignore"

[limits]
file-size = "2 MB"

[machine]
x = [0, 300.5]

[watch]
debounce = "1 s"

[tool."T 2"]
diameter = 2
shape = "slot"
coolant = "mist"
"#;
    assert_snapshot!(show(text, "--feed 120,5 --search parts --restrict a:b --lang=de"));
}

#[test]
fn what_would_be_escaped_is_shown_where_escapes_are_read() {
    let shown = |pattern: &str| {
        let place = Place::new().file("pathbuild.toml", format!("keep-out = '{pattern}'\n"));
        line(&place.run("config show"), "keep-out")
    };
    assert_eq!(shown("#[ab]"), "keep-out = '#[ab]'");
    assert_eq!(shown("##[ab]"), "keep-out = \"#\\u0023[ab]\"");
}

#[test]
fn what_is_shown_is_a_configuration_that_says_the_same() {
    let text = "feed = 150\n[severity]\nPB210 = \"ignore\"\n[[severity-in]]\nfiles = ['a\"b']\nPB112 = \"error\"\n[tool.a]\ndiameter = 2\n";
    let first = Place::new().file("pathbuild.toml", text).run("config show");
    let second = Place::new().file("pathbuild.toml", &first.stdout).run("config show");
    assert_eq!(first, second);
    assert_eq!(first.status, Some(0), "{first}");
}

#[test]
fn init_writes_a_configuration_that_changes_nothing_but_the_library() {
    let place = Place::new();
    assert_snapshot!(format!("{}\n{}", place.run("init"), place.read("pathbuild.toml")));
    let run = place.run("config show --origin");
    let set: Vec<_> = run.stdout.lines().filter(|line| line.contains("  # line ")).collect();
    let (library, line) = set.first().and_then(|set| set.rsplit_once("# line ")).unwrap_or_default();
    assert!(set.len() == 1 && library == "library = [\"<PLACE>\"]  " && line.parse::<u32>().is_ok(), "{run}");
}

#[test]
fn init_shows_every_key_with_a_right_value() {
    let place = Place::new();
    assert_eq!(place.run("init").status, Some(0));
    let all: String = place
        .read("pathbuild.toml")
        .lines()
        .map(|line| match line.strip_prefix('#') {
            Some(value) if !value.starts_with(' ') => format!("{value}\n"),
            _ => format!("{line}\n"),
        })
        .collect();
    let run = Place::new().file("pathbuild.toml", &all).run("config show --origin");
    assert_eq!(run.status, Some(0), "{run}\n{all}");
    assert!(!run.stdout.contains("# default") && !run.stdout.contains("is not set"), "{run}");
    let schema: serde_json::Value = serde_json::from_str(&place.run("config schema").stdout).unwrap();
    let read: toml::Table = toml::from_str(&all).unwrap();
    let read = serde_json::to_value(read).unwrap();
    assert_eq!(jsonschema::validate(&schema, &read).map_err(|error| error.to_string()), Ok(()));
    for (table, keys) in schema["properties"].as_object().unwrap() {
        assert!(read.get(table).is_some(), "init lacks {table}");
        for key in keys["properties"].as_object().into_iter().flat_map(serde_json::Map::keys) {
            assert!(read[table].get(key).is_some(), "init lacks {table}.{key}");
        }
    }
}

/// Patterns are limited in number, since each takes far more memory than its text. Exceeding the limit is reported once.
#[test]
fn patterns_are_counted() {
    let list = |pattern: &str, count: usize| vec![format!("'{pattern}'"); count].join(", ");
    for (inside, outside, what) in [
        (
            format!("restrict = [{}]", list("a:b", 200)),
            format!("restrict = [{}]", list("a:b", 300)),
            "400 regular",
        ),
        (
            format!("[emit]\ntargets = [{}]", list("a", 10_000)),
            format!("[emit]\ntargets = [{}]", list("a", 10_100)),
            "10000 patterns",
        ),
    ] {
        let run = Place::new().file("pathbuild.toml", inside).run("config show");
        assert_eq!(run.status, Some(0), "{what}: {}", run.stderr);
        let complaints = complaints(&outside);
        assert_eq!(
            (complaints.matches("PB003").count(), complaints.contains(what)),
            (1, true),
            "{complaints}"
        );
    }
}

#[test]
fn init_leaves_a_configuration_alone() {
    let place = Place::new().file("pathbuild.toml", "feed = 1\n");
    let run = place.run("init");
    assert_snapshot!(run);
    assert_eq!(place.read("pathbuild.toml"), "feed = 1\n");
}

#[test]
fn the_schema_refuses_what_the_reader_refuses() {
    let schema: serde_json::Value = serde_json::from_str(&Place::new().run("config schema").stdout).unwrap();
    let wrong = [
        "feed = 0",
        "feed = \"1\"",
        "fed = 1",
        "library = \"a\"",
        "lang = \"fr\"",
        "units = 1",
        "join-tolerance = -1",
        "cycles = 1",
        "[limits]\nentities = 0",
        "[limits]\nentity = 1",
        "[limits]\nfile-size = \"2 XB\"",
        "[watch]\ndebounce = \"50\"",
        "[severity]\nPB999 = \"error\"",
        "[severity]\nPB210 = \"info\"",
        "[line-types]\nA = \"B\"",
        "[tool.a]\nnumber = 1",
        "[tool.a]\ndiameter = 2\ncolor = 1",
        "[machine]\nx = [1]",
        "[[severity-in]]\nPB112 = \"ignore\"",
        "restrict = [\"a\"]",
    ];
    for text in wrong {
        let read = serde_json::to_value(toml::from_str::<toml::Table>(text).unwrap()).unwrap();
        assert!(jsonschema::validate(&schema, &read).is_err(), "the schema takes {text}");
        assert_ne!(complaints(text), "", "{text}");
    }
}

#[test]
fn a_line_type_is_named_once_in_whatever_case() {
    let twice = complaints("[line-types]\nfoo = \"DIVIDE\"\nbar = \"CENTER\"\nFOO = \"BORDER\"");
    assert!(
        twice.contains("`line-types` has both FOO and foo")
            || twice.contains("`line-types` has both foo and FOO"),
        "{twice}"
    );
    let different = "[line-types]\nfoo = \"DIVIDE\"\nfo = \"BORDER\"";
    let run = Place::new().file("pathbuild.toml", different).run("config show");
    assert_eq!(run.status, Some(0), "{run}");
}

#[test]
fn a_line_type_of_the_layer_has_no_meaning_of_its_own() {
    for name in ["BYLAYER", "ByBlock"] {
        let found = complaints(&format!("[line-types]\n{name} = \"DIVIDE\""));
        assert!(found.contains(&format!("`line-types` has {name}")), "{found}");
    }
    let run = Place::new().file("pathbuild.toml", "[line-types]\nBYLAYER2 = \"DIVIDE\"").run("config show");
    assert_eq!(run.status, Some(0), "{run}");
}

#[test]
fn everything_that_is_wrong_is_said_at_once() {
    let text = r#"fed = 1
rapid = "fast"
probe-feed = -1
join-tolerance = -0.1
approximate-curves = inf
library = "parts"
search = [1]
path-pattern = '('
restrict = ["8", "(:a", "a:)"]
lang = "fr"
units = "header "
charset = 8
cycles = "yes"
post = ""
[emit]
targets = ["[8"]
target = []
[limits]
file-size = "256 QiB"
entities = 2.5
seconds-per-path = 0
[line-types]
MITTE = "CENTRE"
[severity]
PB203 = "warning"
PB210 = "off"
PB21 = "error"
parameter-out-of-rnge = "error"
[tool.2mm]
number = 1
paths = "("
[machine]
x = [300, 0]
[watch]
debounce = "fast"
[remote]
url = "x"
"#;
    assert_snapshot!(complaints(text));
    let german = Place::new().file("pathbuild.toml", text).run("config show --format concise --lang de");
    assert_eq!(german.stderr.lines().count(), complaints(text).lines().count());
    assert_snapshot!(german);
}

#[test]
fn broken_toml_is_shown_where_it_breaks() {
    assert_snapshot!(complaints("feed = 150\nrapid = \nlibrary = [\"a\"\n[limits\n"));
    assert_snapshot!(Place::new().file("pathbuild.toml", "feed = 150\nfeed = 1\n").run("config show"));
}

#[test]
fn a_key_that_is_refused_is_not_suggested() {
    assert!(complaints("remotes = 1\n").contains("unknown key"));
    let help = |text: &str| Place::new().file("pathbuild.toml", text).run("config show").stderr;
    assert!(!help("remotes = 1\n").contains("`remote`") && !help("zzzq = 1\n").contains("remote"));
}

#[test]
fn an_empty_list_of_files_is_named_by_its_key() {
    let complaint = complaints("[[severity-in]]\nfiles = []\nPB107 = \"error\"\n");
    assert!(complaint.contains("`severity-in.files` must be patterns of names, not []"), "{complaint}");
}

#[test]
fn numbers_and_paths_as_windows_users_write_them_are_explained() {
    for (written, is_understood, help) in [
        ("feed = 150,5", false, "numbers in this file have a decimal point"),
        ("[tool.2mm]\ndiameter = 2,0", false, "numbers in this file have a decimal point"),
        (r#"out-dir = "D:\gcode""#, false, "write the text in single quotes, or a path with `/`"),
        (r#"out-dir = "C:\temp\new""#, false, "write the path with `/`, or, on Windows, in single quotes"),
        (r#"search = ["parts\neu"]"#, false, "write the path with `/`, or, on Windows, in single quotes"),
        ("feed = 150.5", true, ""),
        (r"out-dir = 'temp\new'", cfg!(windows), ""),
        (r#"out-dir = "temp/new""#, true, ""),
    ] {
        let run = Place::new().file("pathbuild.toml", written).run("config show");
        assert_eq!(run.status == Some(0), is_understood, "{written}: {run}");
        assert!(run.stderr.contains(help), "{written}: {run}");
    }
}

#[test]
fn a_configuration_that_is_no_text_is_refused() {
    let place = Place::new().file("pathbuild.toml", b"feed = 1 # \xff");
    assert_snapshot!(place.run("config show --format concise"));
}

#[test]
fn limits_of_values_are_where_the_page_says() {
    let cases = [
        ("feed = 0.001", "feed = 0.0"),
        ("approximate-curves = 0", "approximate-curves = -0.001"),
        ("part-tolerance = 0.005", "part-tolerance = 0.00499"),
        ("[limits]\nentities = 1", "[limits]\nentities = 0"),
        ("[limits]\nfile-size = \"1 B\"", "[limits]\nfile-size = \"0 B\""),
        ("[limits]\nfile-size = 1", "[limits]\nfile-size = 0"),
        ("[limits]\nfile-size = \"17179869183 GiB\"", "[limits]\nfile-size = \"17179869184 GiB\""),
        ("[machine]\nz = [0, 0.1]", "[machine]\nz = [0, 0]"),
        ("[severity]\nPB112 = \"ignore\"", "[severity]\nPB113 = \"ignore\""),
        ("[severity]\nPB612 = \"warning\"", "[severity]\nPB609 = \"warning\""),
        ("[severity]\nPB203 = \"error\"", "[severity]\nPB203 = \"warning\""),
    ];
    for (inside, outside) in cases {
        assert_eq!(show(inside, "").status, Some(0), "{inside}");
        assert_eq!(complaints(outside).lines().count(), 1, "{outside}");
    }
}

#[test]
fn sizes_are_read_in_both_kinds_of_units() {
    for (text, shown) in [
        ("\"1 kB\"", "1000"),
        ("\"1 KiB\"", "\"1 KiB\""),
        ("\"3GiB\"", "\"3 GiB\""),
        ("2_000_000", "2000000"),
    ] {
        let run = show(&format!("[limits]\nfile-size = {text}"), "");
        assert_eq!(line(&run, "file-size"), format!("file-size = {shown}  # line 2"));
    }
}

#[test]
fn options_take_point_or_comma_and_nothing_else() {
    for (text, shown) in [("120.5", "120.5"), ("120,5", "120.5"), ("+7", "7"), (",5", "0.5")] {
        let run = show("feed = 1", &format!("--feed {text}"));
        assert_eq!(line(&run, "feed"), format!("feed = {shown}  # --feed"));
    }
    for text in ["0", "-1", "1e3", "1.000,5", "", "x", "nan", "inf", "1 2", "."] {
        let run = Place::new().run_with(&["config", "show", "--format=concise", &format!("--feed={text}")]);
        assert_eq!((run.status, run.stderr.lines().count()), (Some(2), 1), "{run}");
    }
}

#[test]
fn values_of_options_that_are_wrong_are_underlined() {
    let arguments = [
        "config",
        "show",
        "--feed=-1",
        "--rapid=1,2,3",
        "--path-pattern=(",
        "--restrict=a",
        "--restrict=[:b",
    ];
    assert_snapshot!(Place::new().run_with(&arguments));
    assert_snapshot!(Place::new().run_with(&["config", "show", "--feed=x", "--format=json"]));
}

#[test]
fn the_configuration_is_that_of_the_first_argument() {
    let place = Place::new()
        .file("a/pathbuild.toml", "feed = 1")
        .file("a/b/x.dxf", "")
        .file("pathbuild.toml", "feed = 2");
    let feed = |arguments: &str| line(&place.run(&format!("config show {arguments}")), "feed");
    assert_eq!(feed(""), "feed = 2");
    assert_eq!(feed("a/b/x.dxf"), "feed = 1");
    assert_eq!(feed("a/b/X.DXF"), "feed = 1");
    assert_eq!(feed("a/b/"), "feed = 1");
    assert_eq!(feed("a/b/../b/.."), "feed = 1");
    assert_eq!(feed("a"), "feed = 1");
    assert_eq!(feed("2913.1P"), "feed = 2");
    assert_eq!(feed("--config pathbuild.toml a/b/x.dxf"), "feed = 2");
    assert_eq!(line(&place.run_in("a/b", &["config", "show", "x.dxf"]), "feed"), "feed = 1");
}

#[test]
fn an_argument_under_another_configuration_is_wrong() {
    let place = Place::new().file("a/pathbuild.toml", "").file("b/pathbuild.toml", "").file("c/x.dxf", "");
    let lines = [
        "config show --format concise a/x.dxf b/x.dxf b/y.dxf c/x.dxf",
        "config show --format concise c/x.dxf a/x.dxf",
        "config show --format concise a/x.dxf c/x.dxf c",
        "config show --format concise --config a/pathbuild.toml a/x.dxf b/x.dxf",
    ];
    let shown = runs(&place, lines);
    assert_snapshot!(
        shown.lines().take_while(|line| !line.starts_with("path-pattern")).collect::<Vec<_>>().join("\n")
    );
}

/// A configuration below the run's own is reported once, however many drawings are beside it.
#[test]
fn configurations_below_that_of_the_run_are_warnings() {
    let place = Place::new().file("a/pathbuild.toml", "").file("a/b/pathbuild.toml", "").file("c/none", "");
    let place = ["a/b/1.dxf", "a/b/2.dxf", "a/3.dxf"].iter().fold(place, |place, file| place.file(file, ""));
    let found = |line: &str| {
        let stderr = place.run(&format!("{line} --format concise")).stderr;
        let lines = stderr.lines().filter(|line| line.contains("[PB526]"));
        lines.map(|line| line.split(':').next().unwrap().to_owned()).collect::<Vec<_>>()
    };
    for command in ["check", "emit", "emit --join all --post grbl"] {
        assert_eq!(found(&format!("{command} a")), ["a/b/pathbuild.toml"]);
        assert_eq!(found(&format!("{command} .")), ["a/b/pathbuild.toml", "a/pathbuild.toml"]);
        assert_eq!(found(&format!("{command} a/b")), [""; 0]);
        assert_eq!(found(&format!("{command} a/b/1.dxf")), [""; 0]);
        assert_eq!(found(&format!("{command} a --config c/other.toml")), [""; 0]);
    }
    let place = place.file("pathbuild.toml", "library = [\"a\"]\n[emit]\ntargets = [\"1*\"]\n");
    let run = place.run("emit --check --format concise");
    assert_eq!(run.stderr.matches("[PB526]").count(), 2, "{run}");
}

/// The working directory itself has a name in messages.
#[test]
fn a_directory_is_no_configuration() {
    let run = |format: &str| Place::new().run(&format!("check --config . --format {format}"));
    let [concise, full] = [run("concise"), run("full")];
    assert!(concise.status == Some(2) && concise.stderr.starts_with(".: error[PB003]"), "{concise}");
    assert!(full.stderr.starts_with("error[PB003] invalid-configuration · .\n"), "{full}");
}

/// A program may be outside of the tree whose configuration applies to it.
#[test]
fn a_program_without_a_configuration_of_its_own_takes_that_of_the_drawing() {
    let place = Place::new().file("a/pathbuild.toml", "feed = 3").file("c/x.nc", "");
    assert_eq!(line(&place.run("config show a/x.dxf c/x.nc"), "feed"), "feed = 3");
    assert_eq!(line(&place.run("config show c/x.nc a/x.dxf"), "feed"), "feed = 3");
}

#[test]
fn a_configuration_that_is_named_must_be_there() {
    assert_snapshot!(Place::new().run("config show --config other.toml"));
}

#[test]
fn names_in_the_configuration_are_relative_to_it() {
    let place = Place::new()
        .file("a/pathbuild.toml", "search = [\"../parts\", \"./x/./y\"]\nout-dir = \"out\"")
        .file("a/b/x.dxf", "");
    let run = place.run_in("a/b", &["config", "show", "x.dxf"]);
    assert_eq!(line(&run, "search"), "search = [\"<PLACE>/a/../parts\", \"<PLACE>/a/x/y\"]");
    assert_eq!(line(&run, "out-dir"), "out-dir = \"<PLACE>/a/out\"");
    let run = place.run_in("a/b", &["config", "show", "x.dxf", "--out-dir=o", "--search=s", "--search=t"]);
    assert_eq!(
        line(&run, "search"),
        "search = [\"<PLACE>/a/../parts\", \"<PLACE>/a/x/y\", \"<PLACE>/a/b/s\", \"<PLACE>/a/b/t\"]"
    );
    assert_eq!(line(&run, "out-dir"), "out-dir = \"<PLACE>/a/b/o\"");
}

#[test]
fn a_key_of_an_earlier_version_names_its_successor() {
    let run = Place::new().file("pathbuild.toml", "support-bars = \"solid\"\n").run("config show");
    assert_eq!(run.status, Some(2), "{run}");
    assert!(run.stderr.contains("PB003") && run.stderr.contains("`compatible = true`"), "{run}");
}

/// To TOML, 12.000 is 12: a spindle would turn at 12 rotations a minute.
#[test]
fn a_speed_with_a_separator_of_thousands_is_refused() {
    let run = |text: &str, options: &str| {
        let run = Place::new().file("pathbuild.toml", text).run(&format!("config show {options}"));
        assert_eq!(run.status == Some(2), run.stderr.contains("1200 instead of 1.200"), "{text}: {run}");
        run.status == Some(2)
    };
    for text in [
        "feed = ",
        "rapid = ",
        "probe-feed = ",
        "[machine]\nmaximum-feed = ",
        "[tool.a]\ndiameter = 2\nspindle = ",
    ] {
        assert!(run(&format!("{text}12.000\n"), ""), "{text}");
        assert!(run(&format!("{text}99.999\n"), ""), "{text}");
        assert!(!run(&format!("{text}100.000\n"), ""), "{text}");
        assert!(!run(&format!("{text}12.00\n"), ""), "{text}");
        assert!(run(&format!("{text}0.100\n"), ""), "{text}");
        assert!(!run(&format!("{text}0.099\n"), ""), "{text}");
        assert!(!run(&format!("{text}12000\n"), ""), "{text}");
    }
    assert!(run("", "--feed 1,200"));
    assert!(run("", "--probe-feed 1.200"));
    assert!(!run("", "--feed 1200"));
    assert!(!run("", "--sweep-height 1.200"));
}

#[test]
fn a_wait_in_milliseconds_is_refused() {
    for (seconds, is_wrong) in [("3000", true), ("60.1", true), ("60", false), ("0", false)] {
        let text = format!("[machine]\nspin-up = {seconds}\n");
        let run = Place::new().file("pathbuild.toml", text).run("config show");
        let is_reported =
            run.stderr.contains("error[PB003]") && run.stderr.contains("such as 3 instead of 3000 ms");
        assert_eq!((run.status == Some(2), is_reported), (is_wrong, is_wrong), "{run}");
    }
}

/// Only a shell replaces `~` and variables: here they would be names of directories.
#[test]
fn a_directory_with_an_abbreviation_of_shells_is_refused() {
    for (path, is_wrong) in [
        ("~/gcode", true),
        ("~", true),
        ("$HOME/gcode", true),
        ("%USERPROFILE%\\gcode", true),
        ("./~/gcode", false),
        ("~gcode", false),
        ("100%", false),
        ("%%", false),
    ] {
        let run = Place::new().file("pathbuild.toml", format!("out-dir = '{path}'\n")).run("config show");
        let is_reported = run.stderr.contains("which only a shell replaces");
        assert_eq!((run.status == Some(2), is_reported), (is_wrong, is_wrong), "{path}: {run}");
    }
}

/// Outside of Windows, a backslash would be part of a name.
#[cfg(not(windows))]
#[test]
fn a_directory_with_a_backslash_is_refused() {
    for (path, is_wrong) in [("..\\nc", true), ("nc\\", true), ("../nc", false)] {
        let run = Place::new().file("pathbuild.toml", format!("out-dir = '{path}'\n")).run("config show");
        let is_reported = run.stderr.contains("error[PB003]") && run.stderr.contains("contains a backslash");
        assert_eq!((run.status == Some(2), is_reported), (is_wrong, is_wrong), "{path}: {run}");
    }
}

/// A TOML table extends to the next one: a key added at the end belongs to the last table.
#[test]
fn a_key_in_the_wrong_table_is_told_where_it_belongs() {
    let says = |text: &str, lang: &str, expected: &str| {
        let run = Place::new().file("pathbuild.toml", text).run(&format!("config show --lang {lang}"));
        assert_eq!(run.status, Some(2), "{run}");
        assert!(run.stderr.contains(expected), "{text}: {run}");
    };
    for (text, english, german) in [
        ("travel = [1, 1, 1]\n", "`travel` belongs in [machine]", "`travel` gehört in [machine]"),
        ("coolant = \"off\"\n", "`coolant` belongs in [tool.NAME]", "`coolant` gehört in [tool.NAME]"),
        (
            "[emit]\nlibrary = []\n",
            "`library` belongs at the top of the file",
            "`library` gehört an den Anfang",
        ),
        // Tables with names of the user's own know no other keys.
        ("[line-types]\npart = 'part'\n", "`part` belongs at the top", "`part` gehört an den Anfang"),
        ("[severity]\nlang = 'de'\n", "`lang` belongs at the top", "`lang` gehört an den Anfang"),
        ("[tool]\nunits = 'mm'\n", "`units` belongs at the top", "`units` gehört an den Anfang"),
        ("[post]\ndebounce = \"1 s\"\n", "`debounce` belongs in [watch]", "`debounce` gehört in [watch]"),
        (
            "acelerations = [1, 1, 1]\n",
            "did you mean `accelerations`? It belongs in",
            "Das gehört in [machine]",
        ),
        (
            "[emit]\nlibary = []\n",
            "did you mean `library`? It belongs at the top",
            "Das gehört an den Anfang",
        ),
        // A misspelt key is compared with the keys of its own table first.
        ("[emit]\ntarget = []\n", "did you mean `targets`?\n", "ist `targets` gemeint?\n"),
        (
            "[watch]\nsomething = 1\n",
            "use one of the keys known here: debounce, poll",
            "einen der hier bekannten Schlüssel verwenden: debounce, poll",
        ),
    ] {
        says(text, "en", english);
        says(text, "de", german);
    }
    // A line type of this name can be written in capitals.
    let run = Place::new().file("pathbuild.toml", "[line-types]\nPART = 'CENTER'\n").run("config show");
    assert_eq!(run.status, Some(0), "{run}");
}

#[test]
fn the_option_compatible_wins_over_the_key() {
    assert_eq!(
        line(&show("compatible = false\n", "--compatible"), "compatible"),
        "compatible = true  # --compatible"
    );
}

/// The configuration is a directory. A user who created it expects it to be used, so this is an error.
#[test]
fn a_configuration_that_is_a_directory_cannot_be_read() {
    let drawing =
        sheet("layer 1301.1P\nstart 0,0 \"T5 O2 I1 B0 MX\"\nmill 0,0 40,0\nend 40,0").unwrap().to_dxf();
    let place = Place::new().file("pathbuild.toml/a.txt", "").file("1301.1P.dxf", drawing);
    let run = place.run("check 1301.1P.dxf");
    assert!(run.status != Some(0) && run.stderr.contains("PB00"), "{run}");
}

/// The name of a path becomes a file name, which must be valid on every system and unambiguous.
#[test]
fn names_of_paths_that_no_file_may_have_are_refused() {
    let emitted = |name: &str| {
        let text = format!(
            "layer {name}\nstart 0,0 \"T5 O2 I1 B0 MX\"\nmill 0,0 40,0\nend 40,0\nlayer other\nstart 0,9 \"T5 O2 I1 B0 MX\"\nmill 0,9 40,9\nend 40,9"
        );
        let configuration =
            "path-pattern = '.+'\nfeed = 150\nrapid = 1000\nsweep-height = 20\nspindle = \"manual\"\n";
        let place = Place::new().file("pathbuild.toml", configuration);
        place.file("a.dxf", sheet(&text).unwrap().to_dxf()).run_with(&["emit", ".", "--format", "concise"])
    };
    for name in [
        "x:y",
        "x<y",
        "x>y",
        "x?y",
        "x*y",
        "x/y",
        "x\\y",
        "x\u{202e}y",
        "CON.1P",
        "aux.x",
        "com1.1P",
        "Nul.1P",
    ] {
        let run = emitted(name);
        let said = [&*run.stdout, &*run.stderr].concat();
        assert_eq!(run.status, Some(1), "{name}: {run}");
        let shown = name.replace('\u{202e}', "\\u{202e}");
        let told = said.lines().any(|line| line.contains("error[PB004]") && line.contains(&shown));
        assert!(told, "{name}: {run}");
    }
    // CAD programs write a vertical bar between the name of an external reference and the name of its layer: it is never part of a name.
    let run = emitted("x|y");
    assert!(
        run.status == Some(0) && run.stdout.contains("y_Milling.gcode: written")
            || run.stderr.contains("y_Milling.gcode: written"),
        "{run}"
    );
    assert!(!run.stderr.contains("x|y"), "{run}");
    for name in ["x-y(z)", "CONE.1P", "com10.1P", "CON", "x.CON", "x#&%'y"] {
        let run = emitted(name);
        assert_eq!(run.status, Some(0), "{name}: {run}");
    }
}

/// A program names its cutter by the number alone, so two cutters must not have the same number.
#[test]
fn a_number_is_that_of_one_cutter() {
    let tools = |other: &str| {
        format!("[tool.a]\ndiameter = 2\nnumber = 5\nspindle = 12000\n[tool.b]\nnumber = 5\n{other}")
    };
    for other in ["diameter = 3", "diameter = 2\ncorner-radius = 1", "diameter = 2\nshape = \"other\""] {
        let said = complaints(&tools(other));
        assert!(said.contains("PB003") && said.contains("`tool.b.number` is 5, but [tool.a]"), "{said}");
    }
    let same = tools("diameter = 2\npaths = 'S$'\nspindle = 3000");
    assert_eq!(Place::new().file("pathbuild.toml", same).run("config show").status, Some(0));
    let others = tools("diameter = 3").replace("number = 5\ndiameter = 3", "number = 6\ndiameter = 3");
    assert_eq!(Place::new().file("pathbuild.toml", others).run("config show").status, Some(0));
}

/// `check` of directories reports a post that does not exist, `check` of a drawing does not need one.
#[test]
fn check_reports_a_misspelled_post() {
    let drawing = "layer 1234.1P\nstart 0,0 \"T5 O2 I5 B0 F150 S20 MPlate\"\nmill 0,0 40,0\nend 40,0\n";
    for (post, status) in [("GRBL", 1), ("grbl", 0), ("native", 0), ("missing.cbpp", 0)] {
        let place = Place::new().file("pathbuild.toml", format!("library = ['.']\npost = \"{post}\"\n"));
        let place = place.file("1234.dxf", sheet(drawing).unwrap().to_dxf());
        for arguments in ["", "."] {
            let run = place.run(&format!("check {arguments}"));
            assert_eq!(
                (run.status, run.stderr.contains("PB766")),
                (Some(status), status == 1),
                "{post}: {run}"
            );
        }
        assert_eq!(place.run("check 1234.dxf").status, Some(0));
    }
}

#[test]
fn options_accept_no_exponents() {
    let place = Place::new();
    for (value, lang, help) in [("1e3", "en", "help: write 1000"), ("2.5E-1", "de", "Tipp: 0.25 schreiben")] {
        let run = place.run(&format!("check . --feed {value} --lang {lang}"));
        assert!(run.status == Some(2) && run.stderr.contains(help), "{run}");
    }
    for value in ["1e7", "e3", "nine"] {
        let run = place.run(&format!("check . --feed {value}"));
        assert!(run.stderr.contains("must be a number from 0.001 to 1000000"), "{run}");
    }
}
