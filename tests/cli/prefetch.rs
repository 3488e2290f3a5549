//! Tests prefetching: the drawings that a single drawing or path most likely needs are read while directories are listed. The results must not
//! depend on the number of threads or on how the project is named.

use std::collections::BTreeMap;
use std::fs;

use crate::support::{Place, Run};

const LIBRARY: &str = r#"
== 1234.1P.dxf ==
layer 1234.1P
start 0,0 "T5 O2 I1 B0 MPlate"
mill 0,0 40,0
end 40,0
== 1300-1399.dxf ==
layer 1300.1P
start 0,0 "T5 O2 MPlate"
subpath 0,0 40,0 ">1234.1P"
end 40,0
== 8001.1P.dxf ==
layer 8001.1P
start 0,0 "T5 O2 MPlate"
subpath 0,0 40,0 ">1234.1P"
subpath 40,0 80,0 ">1300.1P"
end 80,0
"#;

const SECOND_COMPONENT: &str = r#"
== 1234.dxf ==
layer 1234.1P
start 0,0 "T5 O2 I1 B1 MPlate"
mill 0,0 40,0
end 40,0
"#;

const SECOND_PROJECT: &str = r#"
== 8000-8100.dxf ==
layer 8001.1P
start 0,0 "T5 O2 I1 B1 MPlate"
mill 0,0 40,0
end 40,0
"#;

/// The exit status, the output on both streams, and the files of a run.
type Outcome = (Option<i32>, String, String, BTreeMap<String, String>);

fn outcome(library: &str, command: &str, threads: u32, input: &str) -> Outcome {
    let place = Place::of(library);
    let options = "--feed 150 --rapid 1000 --sweep-height 20";
    let Run { status, stdout, stderr, .. } = place.run(&format!("{command} {options} -j {threads} {input}"));
    let entries = fs::read_dir(place.path()).unwrap().map(|entry| entry.unwrap().file_name());
    let names = entries.map(|name| name.into_string().unwrap()).filter(|name| name.contains("_Milling."));
    (status, stdout, stderr, names.map(|name| (name.clone(), place.read(&name))).collect())
}

/// Returns the outcomes of `emit` and `check`, after asserting that they do not depend on the number of threads or on how the project is named.
#[track_caller]
fn only_outcome(library: &str, input: &str) -> (Outcome, Outcome) {
    let both = |command: &str| {
        let parallel = outcome(library, command, 2, input);
        assert_eq!(parallel, outcome(library, command, 1, input), "{command} {input}");
        parallel
    };
    (both("emit"), both("check"))
}

#[test]
fn a_project_that_is_found_by_file_names() {
    for input in ["8001.1P.dxf", "./8001.1P.dxf", "8001.1P", "8001.1p", "8001"] {
        let ((status, _, _, files), (checked, ..)) = only_outcome(LIBRARY, input);
        let is_known = input != "8001";
        assert_eq!(
            (status, checked),
            if is_known { (Some(0), Some(0)) } else { (Some(1), Some(1)) },
            "{input}"
        );
        assert_eq!(files.contains_key("8001.1P_Milling.gcode"), is_known, "{input}");
    }
}

#[test]
fn a_path_that_is_in_another_drawing_too() {
    let library = LIBRARY.to_owned() + SECOND_COMPONENT;
    for input in ["8001.1P.dxf", "8001.1P"] {
        let ((status, _, stderr, files), _) = only_outcome(&library, input);
        assert_eq!((status, files.len()), (Some(1), 0));
        assert!(stderr.contains("1234.1P.dxf") && stderr.contains("1234.dxf"), "{stderr}");
    }
}

#[test]
fn a_path_that_is_asked_for_and_in_two_drawings() {
    let library = LIBRARY.to_owned() + SECOND_PROJECT;
    let ((status, _, stderr, files), _) = only_outcome(&library, "8001.1P");
    assert_eq!((status, files.len()), (Some(1), 0));
    assert!(stderr.contains("8000-8100.dxf"), "{stderr}");
    let ((status, ..), _) = only_outcome(&library, "8001.1P.dxf");
    assert_eq!(status, Some(0));
}

#[test]
fn a_path_that_is_nowhere() {
    let library = LIBRARY.replace("1300-1399.dxf", "1400-1499.dxf");
    for input in ["8001.1P.dxf", "8001.1P"] {
        let ((status, _, stderr, files), _) = only_outcome(&library, input);
        assert_eq!((status, files.len()), (Some(1), 0));
        assert!(stderr.contains("1300.1P"), "{stderr}");
    }
}

#[test]
fn a_drawing_that_embeds_nothing_and_one_that_is_not_there() {
    let ((status, ..), _) = only_outcome(LIBRARY, "1234.1P.dxf");
    assert_eq!(status, Some(0));
    let ((status, ..), _) = only_outcome(LIBRARY, "9999.1P.dxf");
    assert_eq!(status, Some(1));
}
