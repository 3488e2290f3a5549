//! Tests commands about embeddings and the locations of paths. (book: reference/commands, book: language/layers-and-names)

use std::fs;

use crate::support::{Place, Run, dxf, project, runs};
use insta::assert_snapshot;

/// A library of components, a project, a fixture project with names as variables, a variable project, and a project with a missing component.
const LIBRARY: &str = r#"
== pathbuild.toml ==
library = ["components", "projects"]
search = ["components"]
== components/1234.dxf ==
layer 1234.1P
start 0,0 "T5 O2 I1 B0 MPlate"
mill 0,0 40,0
end 40,0
layer 1234.2P
start 0,20 "T5 O2 I1 B0 MPlate"
mill 0,20 40,20
end 40,20
== components/2051.dxf ==
layer 2051.1P
start 0,0 "T5 O2 I1 MPlate :B0~1"
mill 0,0 40,0 "B=B"
end 40,0
== projects/8001.dxf ==
layer 8001.1P
start 0,0 "T5 O2 MPlate"
subpath 0,0 40,0 ">1234.1P"
subpath 40,0 80,0 ">1234.1P"
subpath 80,0 120,0 ">2051.1P :B0,5"
end 120,0
== projects/8100.dxf ==
layer 8100.1P
start 0,0 "T5 O2 MPlate :X1234.1P,1234.2P"
subpath 0,0 40,0 ">=X"
end 40,0
== projects/8101.dxf ==
layer 8101.1P
start 0,0 "T5 O2 MPlate"
subpath 0,0 40,0 ">8100.1P :X1234.2P"
end 40,0
== projects/8900.dxf ==
layer 8900.1P
start 0,0 "T5 O2 MPlate"
subpath 0,0 40,0 ">9999.1P"
subpath 40,0 80,0 ">1234.1P"
end 80,0
layer 8900.2P
start 0,50 "T5 MPlate"
subpath 0,50 40,50 ">1234.1P"
end 40,50
"#;

/// The groove of one component cuts into the part of another on the same sheet, and through one of its support bars. The sheet's own check says so
/// once, however many projects embed the sheet.
#[test]
fn cuts_between_the_components_of_a_nested_sheet_are_reported_once() {
    let folder = project().join("docs/drawings/part");
    let groove = "layer 1129.1P\nstart 0,0 \"O2 T2 M20x2 I0.5 F150 B-0.2\"\nmill 0,0 0,-20\nend 0,-20\n";
    let sheet = "layer 7122.1P\nstart 0,0 \"O2 T2 M20x2 S10\"\nsubpath 0,0 40,0 \">1121.1P\"\n\
                 sweep 40,0 13,32\nsubpath 13,32 13,12 \">1129.1P\"\nend 13,12\n";
    // The end of the sheet is 17.692 mm from its start. The sheet is turned.
    let around = |name: &str| {
        format!(
            "layer {name}\nstart 0,0 \"O2 T2 M20x2 S10\"\nsubpath 0,0 17.692,0 \">7122.1P\"\nend 17.692,0\n"
        )
    };
    let place = Place::new()
        .file("pathbuild.toml", fs::read(folder.join("pathbuild.toml")).unwrap())
        .file("1121.1P.dxf", fs::read(folder.join("1121.1P.dxf")).unwrap())
        .file("1129.1P.dxf", dxf(groove))
        .file("7122.1P.dxf", dxf(sheet))
        .file("8122.1P.dxf", dxf(&around("8122.1P")))
        .file("8123.1P.dxf", dxf(&around("8123.1P")));
    let findings = |paths: &str| {
        let run = place.run(&format!("check {paths} --format concise --no-cache"));
        let found = ["PB214", "PB218"].map(|code| run.stderr.matches(&format!("[{code}]")).count());
        assert!(
            run.stderr.lines().all(|line| line.starts_with("7122.1P.dxf") || line.contains("drawing")),
            "{run}"
        );
        found
    };
    let alone = findings("7122.1P");
    assert_eq!(alone, [1, 1]);
    for paths in ["8122.1P", "8122.1P 8123.1P", "."] {
        assert_eq!(findings(paths), alone, "{paths}");
    }
}

#[test]
fn graph_lists_every_embedding_with_its_values() {
    assert_snapshot!(Place::of(LIBRARY).run("graph"));
}

/// A path that has the parameters of another one changes with it.
#[test]
fn parameters_that_are_borrowed_are_shown_as_well() {
    let place = Place::of(&format!(
        "{LIBRARY}== components/2301.dxf ==\nlayer 2301.1P\nstart 0,0 \"T5 O2 I1 MPlate :B0~1\"\n\
         mill 0,0 40,0 \"B=B\"\nend 40,0\nlayer 2301.2P\nstart 0,20 \"@2301.1P\"\nmill 0,20 40,20 \"B=B\"\n\
         end 40,20\n== projects/8301.dxf ==\nlayer 8301.1P\nstart 0,0 \"T5 O2 MPlate\"\n\
         subpath 0,0 40,0 \">2301.2P :B0.5\"\nend 40,0\n\
         == projects/8302.dxf ==\nlayer 8302.1P\nstart 0,0 \"T5 O2 MPlate\"\n\
         subpath 0,0 40,0 \">2301.1P :B1\"\nend 40,0\n"
    ));
    let lines = [
        "rdeps 2301.1P",
        "rdeps 2301.2P --lang de",
        "deps 8301.1P",
        "graph 8301.1P",
        "graph 8301.1P --format json",
        "graph 8301.1P --format dot",
        "graph 8301.1P --format mermaid",
    ];
    assert_snapshot!(runs(&place, lines));
}

/// Hidden drawings are left out of the library, and of the search for embedded paths.
#[test]
fn a_hidden_drawing_defines_no_path_for_others() {
    let hidden = |name: &str| LIBRARY.replace("components/1234.dxf", &format!("components/{name}"));
    assert_eq!(codes(&Place::of(&hidden("1234.dxf")), ""), [""; 0]);
    assert_eq!(codes(&Place::of(&hidden(".1234.dxf")), ""), ["503", "503"]);
    let both = format!("{LIBRARY}== components/.1234.dxf ==\n{SECOND}");
    assert_eq!(codes(&Place::of(&both), ""), [""; 0]);
    let ignored = format!("{LIBRARY}== components/.ignore ==\n1234.dxf\n");
    assert_eq!(codes(&Place::of(&ignored), ""), [""; 0], "an embedded path is named");
}

/// Two half circles embed a closed path nowhere, so nothing is milled twice.
#[test]
fn a_segment_that_does_not_fit_embeds_nothing_twice() {
    let with = |ends: &str| {
        codes(
            &Place::of(&format!(
                "== projects/1111.1P.dxf ==\nlayer 1111.1P\nstart 0,0 \"T5 O2 I1 B0 MPlate\"\nmill 0,0 {ends}\n\
                 == projects/8001.dxf ==\nlayer 8001.1P\nstart 0,0 \"T5 O2 MPlate\"\n\
                 subpath arc centre 0,5 r 5 from 270 to 90 \">1111.1P\"\n\
                 subpath arc centre 0,5 r 5 from 90 to 270 \">1111.1P\"\nend 0,0\n"
            )),
            "",
        )
    };
    assert_eq!(with("10,0\nend 10,0"), ["121"]);
    assert_eq!(with("10,0 10,9 0,0\nend 0,0"), ["505", "505"]);
}

/// The rules beside pathbuild.toml apply to the directories of the library, from wherever pathbuild runs.
#[test]
fn ignore_files_beside_the_configuration_apply() {
    let drawing = |name: &str| format!("layer {name}\nstart 0,0 \"T5 O2 I1 B0\"\nmill 0,0 40,0\nend 40,0\n");
    let paths = |rules: &str, file: &str| {
        let place = Place::of(&format!(
            "== pathbuild.toml ==\nlibrary = [\"parts\"]\n== {file} ==\n{rules}\n== parts/a/1001.dxf ==\n{}\
             == parts/copy 1002.dxf ==\n{}",
            drawing("1001.1P"),
            drawing("1002.1P")
        ));
        let count = |run: Run| run.stderr.lines().last().unwrap()[..1].to_owned();
        let all = count(place.run("check"));
        assert_eq!(count(place.run("check parts")), all);
        assert_eq!(count(place.run_in("parts", &["check"])), all);
        all
    };
    assert_eq!(paths("", ".ignore"), "2");
    for file in [".ignore", ".gitignore"] {
        assert_eq!(paths("copy*", file), "1");
        assert_eq!(paths("/parts/copy*", file), "1");
        assert_eq!(paths("/copy*", file), "2", "it is not beside the file");
        assert_eq!(paths("a/", file), "1");
        assert_eq!(paths("/parts/", file), "2", "the library names it");
    }
}

/// Returns the codes that `check projects/8001.dxf` reports with these options.
fn codes(place: &Place, options: &str) -> Vec<String> {
    let run = place.run(&format!("check projects/8001.dxf --format concise {options}"));
    run.stderr.split("[PB").skip(1).map(|rest| rest[..3].to_owned()).collect()
}

/// `--search` adds directories after those of the configuration, so a second definition is noticed.
#[test]
fn directories_of_the_command_line_are_searched_as_well() {
    let definition = |layer: &str| {
        Place::of(&format!(
            "{LIBRARY}== more/2051.dxf ==\nlayer {layer}\nstart 0,0 \"T5 O2 I1 MPlate :B0~1\"\nmill 0,0 40,0 \"B=B\"\nend 40,0\n"
        ))
    };
    assert_eq!(codes(&definition("2051.2P"), "--search more"), [""; 0]);
    assert_eq!(codes(&definition("2051.1P"), "--search components"), [""; 0]);
    assert_eq!(codes(&definition("2051.1P"), "--search more"), ["504"]);
}

const SECOND: &str = "layer 1234.1P\nstart 0,0 \"T5 O2 I1 B0 MPlate\"\nmill 0,0 40,0\nend 40,0\n";

/// Whether `check` reports PB504, once, with and without cached results.
fn is_ambiguous(place: &Place, arguments: &str) -> bool {
    let check = || {
        let run = place.run(&format!("check --format concise {arguments}"));
        let count = run.stderr.matches("error[PB504]").count();
        assert!(count < 2 && run.status == Some(i32::try_from(count).unwrap()), "{run}");
        count == 1
    };
    let is_ambiguous = check();
    assert_eq!(is_ambiguous, check());
    is_ambiguous
}

/// `check` reports a second definition of a path that no project embeds, if a project would find both.
#[test]
fn a_second_definition_is_noticed_although_nothing_embeds_the_path() {
    let place = |directories: &str, search: &str, file: &str| {
        let library =
            LIBRARY.replace("library = [\"components\", \"projects\"]", &format!("library = {directories}"));
        let library = library.replace("search = [\"components\"]", &format!("search = {search}"));
        Place::of(&format!("{library}== {file} ==\n{SECOND}"))
    };
    let beside = |file: &str| is_ambiguous(&place("['components']", "[]", file), "");
    assert!(beside("components/1234 old.dxf"));
    assert!(!beside("components/5678.dxf"), "its file name does not cover the path");
    let apart = |search: &str| is_ambiguous(&place("['components', 'more']", search, "more/1234.dxf"), "");
    assert!(apart("['components']") && apart("['more']"));
    assert!(!apart("[]"), "nothing finds both");
}

/// `emit` of a directory or the library writes no program of a path that two of the drawings define, as `emit NAME` does not.
#[test]
fn a_path_that_is_defined_twice_is_not_emitted() {
    let emit = |file: &str, arguments: &str| {
        let place = Place::of(&format!("{LIBRARY}== {file} ==\n{SECOND}"));
        let config = fs::read_to_string(place.path().join("pathbuild.toml")).unwrap();
        let place =
            place.file("pathbuild.toml", format!("{config}[emit]\ntargets = ['1234.1P', '8001.1P']\n"));
        let run = place
            .run(&format!("emit --format concise {arguments} --feed 150 --rapid 1000 --sweep-height 20"));
        let programs = |directory: &str| {
            let files = fs::read_dir(place.path().join(directory)).unwrap();
            files.filter(|file| file.as_ref().unwrap().path().extension().unwrap() == "gcode").count()
        };
        (run.stderr.matches("error[PB504]").count(), programs("components"), programs("projects"))
    };
    let written = |file: &str| emit(file, "components").1;
    assert_eq!(emit("components/1234 old.dxf", "components").0, 1);
    assert_eq!(
        written("components/5678.dxf"),
        written("components/1234 old.dxf") + 2,
        "its file name does not cover the path"
    );
    let (problems, components, _) = emit("components/1234 old.dxf", "");
    assert!(problems > 0 && components == 0);
    let (problems, components, _) = emit("components/5678.dxf", "");
    assert_eq!((problems, components), (0, 2));
    let three = format!("components/1234 old.dxf ==\n{SECOND}== components/1234 older.dxf");
    let (problems, components, _) = emit(&three, "components");
    let expected = (2, written("components/1234 old.dxf"));
    assert_eq!((problems, components), expected, "each drawing but the first is named");
}

/// Two drawings in different directories may define one path, unless their programs are written into one directory.
#[test]
fn a_path_that_is_defined_twice_is_not_emitted_into_one_directory() {
    for (out_dir, file, is_twice) in [
        ("out-dir = 'nc'", "more/1234 old.dxf", true),
        ("", "more/1234 old.dxf", false),
        ("out-dir = 'nc'", "more/5678.dxf", false),
    ] {
        let library = LIBRARY.replace("[\"components\", \"projects\"]", "[\"components\", \"more\"]");
        let library = library.replace("search = [\"components\"]", "search = []");
        let place = Place::of(&format!("{library}== {file} ==\n{SECOND}"));
        let config = place.read("pathbuild.toml");
        let values = "feed = 150\nrapid = 1000\nsweep-height = 20\n";
        let config = format!("{out_dir}\n{values}{config}\n[emit]\ntargets = ['1234.1P']\n");
        let place = place.file("pathbuild.toml", config);
        assert!(!is_ambiguous(&place, ""));
        for arguments in ["", "--check"] {
            let run = place.run(&format!("emit --format concise {arguments}"));
            assert_eq!(run.stderr.matches("error[PB504]").count(), usize::from(is_twice), "{file}: {run}");
            let is_written = !run.stderr.contains("PB528") && run.status == Some(0);
            assert_eq!(is_written, !is_twice, "{file}: {run}");
        }
    }
}

/// A second definition is reported only if both drawings are checked.
#[test]
fn a_second_definition_is_noticed_among_the_drawings_that_are_checked() {
    let place = Place::of(&format!("{LIBRARY}== components/1234-1235.dxf ==\n{SECOND}"));
    let both = "components/1234.dxf components/1234-1235.dxf";
    assert!(is_ambiguous(&place, "components") && is_ambiguous(&place, both));
    assert!(!is_ambiguous(&place, "components/1234.dxf"));
}

/// The finding is at the first of the drawings, and comes and goes with the other one.
#[test]
fn a_second_definition_is_reported_at_the_first() {
    let place = Place::of(&format!("{LIBRARY}== components/1234 old.dxf ==\n{SECOND}"));
    assert_snapshot!(runs(&place, ["check components", "check components --lang de"]));
    fs::remove_file(place.path().join("components/1234 old.dxf")).unwrap();
    assert_eq!(place.run("check components").status, Some(0));
}

/// `--restrict` adds rules: it cannot switch off those of the configuration.
#[test]
fn rules_of_the_command_line_follow_those_of_the_configuration() {
    let rules =
        |rules: &str| Place::of(&LIBRARY.replace("library =", &format!("restrict = [{rules}]\nlibrary =")));
    assert_eq!(codes(&rules(""), "--restrict ^8:^1"), ["507"]);
    assert_eq!(codes(&rules("'^9:^1'"), "--restrict ^8:^1"), ["507"]);
    assert_eq!(codes(&rules("'^8:^[12]'"), "--restrict ^8:^1"), [""; 0]);
    assert_eq!(codes(&rules("'^8:^1'"), "--restrict .:."), ["507"]);
}

#[test]
fn graph_of_a_path_is_what_it_reaches() {
    assert_snapshot!(runs(&Place::of(LIBRARY), ["graph 8101.1P", "graph projects/8001.dxf"]));
}

#[test]
fn graphs_for_other_programs() {
    let lines = ["graph --format dot", "graph --format mermaid", "graph --format json"];
    assert_snapshot!(runs(&Place::of(LIBRARY), lines));
}

#[test]
fn deps_are_a_tree_of_what_is_embedded() {
    let lines =
        ["deps 8001.1P", "deps 8101.1P 1234.1P", "deps projects/8900.dxf", "deps 8101.1P --format dot"];
    assert_snapshot!(runs(&Place::of(LIBRARY), lines));
}

#[test]
fn rdeps_are_a_tree_of_what_embeds_over_the_library() {
    let lines = ["rdeps 1234.1P", "rdeps 1234.2P", "rdeps components/2051.dxf", "rdeps 8001.1P", "rdeps"];
    assert_snapshot!(runs(&Place::of(LIBRARY), lines));
}

/// A path with variables is listed once for each set of values.
#[test]
fn rdeps_show_what_embeds_each_set_of_values() {
    let second = "subpath 80,0 120,0 \">2051.1P :B0,5\"\nsubpath 120,0 160,0 \">2051.1P :B0\"\nend 160,0";
    let library = LIBRARY.replace("subpath 80,0 120,0 \">2051.1P :B0,5\"\nend 120,0", second);
    let run = Place::of(&library).run("rdeps 2051.1P");
    let expected = "2051.1P :B0  components/2051.dxf\n  8001.1P  projects/8001.dxf\n\
        2051.1P :B0,5  components/2051.dxf\n  8001.1P  projects/8001.dxf\n";
    assert_eq!(run.stdout, expected);
}

#[test]
fn rdeps_of_a_part_of_the_graph_for_other_programs() {
    assert_snapshot!(runs(
        &Place::of(LIBRARY),
        ["rdeps 1234.2P --format json", "rdeps 2051.1P --format mermaid"]
    ));
}

#[test]
fn graph_commands_speak_german() {
    assert_snapshot!(runs(
        &Place::of(LIBRARY),
        ["graph --lang de", "deps --lang de", "rdeps --lang de 1234.1P"]
    ));
}

#[test]
fn graph_commands_say_what_they_cannot_find() {
    let place = Place::of(LIBRARY).file("broken.dxf", "no drawing");
    assert_snapshot!(runs(&place, ["deps 7777.1P", "rdeps broken.dxf", "graph gone.dxf"]));
}

#[test]
fn without_a_library_rdeps_looks_below_the_working_directory() {
    let place = Place::of(&LIBRARY.replace("library = [\"components\", \"projects\"]", ""));
    assert_snapshot!(runs(&place, ["rdeps 2051.1P", "graph"]));
}

/// The output of a cycle ends where it began, and repeated embeddings are not expanded again.
#[test]
fn cycles_and_repetitions_end() {
    let place = Place::of(
        r#"
== 8000.dxf ==
layer 8000.1P
start 0,0 "T5 O2 MPlate"
subpath 0,0 40,0 ">8000.2P"
subpath 40,0 80,0 ">8000.3P"
end 80,0
layer 8000.2P
start 0,20 "T5 O2 MPlate"
subpath 0,20 40,20 ">8000.3P"
end 40,20
layer 8000.3P
start 0,40 "T5 O2 MPlate"
subpath 0,40 40,40 ">8000.2P"
end 40,40
"#,
    );
    assert_snapshot!(runs(&place, ["deps 8000.1P", "rdeps 8000.3P", "graph 8000.dxf"]));
}

#[test]
fn where_says_file_line_layer_and_start() {
    let place = Place::of(LIBRARY);
    let lines =
        ["where 1234.1P", "where components/1234.dxf 8101.1p", "where --format json 2051.1P", "where 7.1P"];
    assert_snapshot!(runs(&place, lines));
}

/// A copy in the project's own drawing would be milled even after the component changes.
#[test]
fn a_second_definition_is_noticed_even_in_the_drawing_that_embeds_it() {
    let component =
        |layer: &str| format!("layer {layer}\nstart 0,0 \"T5 O2 I1 B0 MPlate\"\nmill 0,0 40,0\nend 40,0\n");
    let project = "layer 8001.1P\nstart 0,0 \"T5 O2 MPlate\"\nsubpath 0,0 40,0 \">1234.1P\"\nend 40,0\n";
    let check = |beside: &str, layer: &str| {
        let (own, other) = (component("1234.1P"), component(layer));
        let place = Place::of(&format!("== 8001.dxf ==\n{project}{own}== {beside} ==\n{other}"));
        place.run("check 8001.dxf --feed 1 --rapid 1 --sweep-height 20 --format concise")
    };
    let run = check("1234.dxf", "1234.1P");
    let expected = "path 1234.1P exists twice: in 8001.dxf and in 1234.dxf";
    assert!(run.status == Some(1) && run.stderr.contains(expected), "{run}");
    // Another path in a drawing of that name is no second definition; nor is a path in a drawing whose name does not admit it.
    for (beside, layer) in [("1234.dxf", "1234.2P"), ("1300.dxf", "1234.1P")] {
        let run = check(beside, layer);
        assert_eq!(run.status, Some(0), "{run}");
    }
}

/// `where` helps to resolve PB504.
#[test]
fn where_lists_every_definition_of_a_path_that_has_two() {
    let second = "== projects/1234.1.dxf ==\nlayer 1234_1P\nstart 0,0 \"T5 O2\"\nend 0,0\n";
    assert_snapshot!(Place::of(&format!("{LIBRARY}{second}")).run("where 1234.1P --lang de"));
}

/// One text of each kind: at a marker, a line, an arc, a circle and a polyline; one with a continuation, and one without an element.
const TEXTS: &str = r#"
== 1234.dxf ==
layer 1234.1P
start 0,0 "T5 O2 I1 MPlate~\P  X" as mtext
mill 0,0 40,0 "B0 %%c" as text
mill arc 40,0 60,0 r 10 "B1"
circle 60,0 d 2 "B2"
polyline 60,0 80,0 80,20 "B3"
end 80,20
text 200,200 "B4"
layer 1234.2P~A
start 0,50 "@1234.1P"
end 0,50
== broken.dxf verbatim ==
nothing
"#;

#[test]
fn texts_show_the_element_that_each_belongs_to() {
    assert_snapshot!(runs(&Place::of(TEXTS), ["texts 1234.dxf", "texts 1234.dxf --lang de --match B[13]"]));
}

#[test]
fn texts_of_one_path_or_for_programs() {
    assert_snapshot!(runs(&Place::of(TEXTS), ["texts 1234.2P", "texts 1234.dxf --format json"]));
}

#[test]
fn texts_need_a_drawing_and_a_regular_expression() {
    assert_snapshot!(runs(&Place::of(TEXTS), ["texts", "texts 1234.dxf --match (", "texts broken.dxf"]));
}

/// Faults that occur with a single value that is not among the examples, with some combinations, and with all.
const VALUES: &str = r#"
== 2051.dxf ==
layer 2051.1P
start 0,0 "T5 O2 I1 MPlate :A0,1,2,6 :B1~9 :C?XY"
mill 0,0 40,0 "B=A"
mill 40,0 40,20 "B=B"
mill 40,20 80,20 "B7"
end 80,20
layer 2051.2P
start 0,50 "T5 O2 I1 MPlate :X1~2"
mill 0,50 40,50 "B=X"
end 40,50
layer 2051.3P
start 0,80 "T5 O2 I1 B0 MPlate"
mill 0,80 40,80
end 40,80
"#;

#[test]
fn all_values_of_variables_are_checked() {
    let lines = ["check 2051.dxf", "check --all-bindings 2051.dxf", "check --all-bindings 2051.2P"];
    assert_snapshot!(without_times(&runs(&Place::of(VALUES), lines)));
}

/// Ten digits for each of three variables give as many combinations as are checked at most.
#[test]
fn combinations_beyond_a_thousand_are_cut_with_a_warning() {
    let place = |definitions: &str| {
        Place::of(&format!(
            "== 2051.dxf ==\nlayer 2051.1P\nstart 0,0 \"T20 O2 I1 MPlate {definitions}\"\n\
             mill 0,0 40,0 \"B=A\"\nmill 40,0 80,0 \"B=B\"\nmill 80,0 80,40 \"B=C\"\nend 80,40\n"
        ))
    };
    let all = place(":A?0123456789 :B?0123456789 :C?0123456789").run("check --all-bindings 2051.dxf");
    assert!(!all.stderr.contains("PB005"), "{all}");
    // The faulty value comes last, but is among those that are checked.
    let cut = place(":A?0123456789 :B?0123456789 :C0,1,2,3,4,5,6,7,8,9,21")
        .run("check --all-bindings 2051.dxf --lang de");
    assert_snapshot!(without_times(&cut.to_string()));
    for (count, is_each_checked) in [(1000, true), (1001, false)] {
        let values: Vec<String> =
            (0..count).map(|number| format!("{}", f64::from(number) / 1000.0)).collect();
        let definitions = format!(":A{} :B?01 :C?01", values.join(","));
        let cut = place(&definitions).run("check --all-bindings 2051.dxf");
        assert_eq!(!cut.stderr.contains("not even every value"), is_each_checked, "{cut}");
    }
}

/// Removes the durations, which vary between runs.
fn without_times(text: &str) -> String {
    let lines = text.lines().map(|line| match line.rfind(" (") {
        Some(at) if line.ends_with(" s)") => &line[..at],
        _ => line,
    });
    lines.collect::<Vec<_>>().join("\n")
}

/// The searched drawing often contains the intended path. A misspelling is suggested; for another number, the note lists the existing paths.
#[test]
fn names_like_one_that_is_not_found_are_named() {
    let place = Place::of(LIBRARY).file("projects/8009.dxf", {
        let drawn = "layer 8009.1P\nstart 0,0 \"T5 O2 MPlate\"\nsubpath 0,0 40,0 \">1234.9P\"\n\
                     subpath 40,0 80,0 \">1234.1Q\"\nend 80,0";
        pathbuild_testkit::sheet(drawn).unwrap().to_dxf()
    });
    let run = place.run("check 8009.1P");
    for note in ["the searched drawings contain these paths: 1234.1P, 1234.2P", "similar names: 1234.1P"] {
        assert!(run.stderr.lines().any(|line| line.ends_with(note)), "{note} in {run}");
    }
    // Every command that looks for a path gives the same message.
    for command in ["view", "texts", "sheet", "where", "emit", "check", "deps"] {
        let run = place.run(&format!("{command} 1234.1Q"));
        assert!(
            run.stderr.contains("similar names: 1234.1P\n") && !run.stderr.contains("did you mean"),
            "{run}"
        );
    }
}

/// `emit` reports the second definition of a path beside the errors of both definitions, as `check` does.
#[test]
fn a_path_with_errors_in_both_of_its_drawings_is_defined_twice() {
    for (drawing, problems) in
        [(SECOND.to_owned(), 0), (SECOND.replace("mill 0,0 40,0", "mill 0,0 40,0 \"X3\""), 2)]
    {
        let place = Place::of(&format!("== 1234.dxf ==\n{drawing}== 1234 old.dxf ==\n{drawing}"));
        for command in [
            "check",
            "emit --feed 150 --rapid 1000 --sweep-height 20",
            "emit --check --feed 150 --rapid 1000 --sweep-height 20",
        ] {
            let run = place.run(&format!("{command} . --format concise"));
            let count = |code: &str| run.stderr.matches(&format!("error[{code}]")).count();
            assert_eq!((count("PB504"), count("PB202")), (1, problems), "{command}: {run}");
        }
    }
}
