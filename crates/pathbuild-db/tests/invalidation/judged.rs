//! Tests the values and roles that checks depend on, and duplicate findings.

use pathbuild_db::{Limits, Role, Settings};
use pathbuild_path::Bindings;
use salsa::Setter;

use crate::embedding::component;
use crate::world::{LIMITS, World};

/// A path that is correct with B0. B9 is above the upper face of the material (T5), which is an error.
const WITH_VARIABLE: &str = "layer 1114.1P\nstart 0,0 \"T5 O3 I1 Mx :B0,9\"\nmill 0,0 20,0 \"B=B\"\nend 20,0";

fn project(path: &str, segment: &str) -> String {
    format!("layer {path}\nstart 0,0 \"T5 O3 Mx\"\nsubpath 0,0 20,0 \"{segment}\"\nend 20,0")
}

fn codes(files: &[(&str, &str)], file: &str, path: &str, role: Role) -> Vec<String> {
    World::new(files).judge("path", file, path, role)
}

/// The index covers the example values only.
#[test]
fn a_path_is_judged_with_the_values_that_it_is_given() {
    let component = ("lib/1114.1P.dxf", WITH_VARIABLE);
    let with = |values: &str| {
        let project = project("8001.1P", &format!(">1114.1P {values}"));
        codes(&[component, ("lib/8001.1P.dxf", &project)], "lib/8001.1P.dxf", "8001.1P", Role::Checked)
    };
    assert_eq!(with(":B0"), [""; 0]);
    assert_eq!(with(":B9"), ["PB203", "PB511"]);
    let checked = |role| codes(&[component], "lib/1114.1P.dxf", "1114.1P", role);
    assert_eq!(checked(Role::Checked), [""; 0]);
    assert_eq!(checked(Role::CheckedWith(Bindings::new([('B', "9".into())]))), ["PB203"]);
    assert_eq!(checked(Role::Emitted), ["PB302"]);
}

/// A path with errors is judged with the example values, so a variable without a value causes no further error.
#[test]
fn a_path_with_errors_is_judged_with_example_values() {
    let with_error = |error: &str| {
        let drawing = format!(
            "layer 1114.1P\nstart 0,0 \"T5 O3 I1 Mx :B0,9\"\nmill 0,0 20,0 \"B=B\"\nmill 20,0 40,0 \"{error}\"\n\
             end 40,0"
        );
        codes(&[("lib/1114.1P.dxf", &drawing)], "lib/1114.1P.dxf", "1114.1P", Role::Emitted)
    };
    assert_eq!(with_error("B1 X5"), ["PB202"]);
    assert_eq!(with_error("B=C"), ["PB302"]);
    assert_eq!(with_error("B1"), ["PB302"]);
}

/// The sweep height depends on the role, and is checked even if a path embeds nothing.
#[test]
fn the_sweep_height_of_a_role_is_checked() {
    let drawing = |t: &str| {
        format!("layer 1111.1P\nstart 0,0 \"T5 O3 I1 Mx B0\"\nmill 0,0 20,0\nprobe 10,30 \"T{t}\"\nend 20,0")
    };
    let checked = |t: &str, role| codes(&[("lib/1111.dxf", &drawing(t))], "lib/1111.dxf", "1111.1P", role);
    // S is T + O if the path is checked, and the option's 20 mm if it is emitted.
    assert_eq!(checked("7.9", Role::Checked), [""; 0]);
    assert_eq!(checked("8", Role::Checked), ["PB203"]);
    assert_eq!(checked("19.9", Role::Emitted), [""; 0]);
    assert_eq!(checked("20", Role::Emitted), ["PB203"]);
}

/// Heights that H adds are checked in any role if the path has an S, otherwise only if S is given elsewhere.
#[test]
fn what_h_raises_is_checked_where_a_path_embeds_nothing() {
    let checked = |s: &str, h: &str| {
        let drawn = format!(
            "layer 1111.1P\nstart 0,0 \"T5 O3 I1 Mx B0 {s}\"\nmill 0,0 20,0\nprobe 10,30 \"{h}\"\nend 20,0"
        );
        codes(&[("lib/1111.dxf", &drawn)], "lib/1111.dxf", "1111.1P", Role::Checked)
    };
    assert_eq!(checked("S12", "H6.9"), [""; 0]);
    assert_eq!(checked("S12", "H7"), ["PB203"]);
    assert_eq!(checked("", "H7"), [""; 0]);
}

/// A sweep's own S is compared with raised material in any role, whether or not the path has an S.
#[test]
fn the_s_of_a_sweep_clears_what_the_path_embeds() {
    let component = component("1111.1P", "0");
    let checked = |path: &str, s: &str, role| {
        let drawn = format!(
            "layer 8001.1P\nstart 0,0 \"T5 O3 Mx {path}\"\nsubpath 0,0 20,0 \">1111.1P H10\"\n\
             sweep 20,0 40,0 \"{s}\"\nend 40,0"
        );
        codes(
            &[("lib/1111.1P.dxf", &component), ("lib/8001.1P.dxf", &drawn)],
            "lib/8001.1P.dxf",
            "8001.1P",
            role,
        )
    };
    for (path, role) in [("S30", Role::Checked), ("S30", Role::Emitted), ("", Role::Checked)] {
        assert_eq!(checked(path, "S15.1", role.clone()), [""; 0]);
        assert_eq!(checked(path, "S15", role.clone()), ["PB203"]);
        assert_eq!(checked(path, "", role), [""; 0]);
    }
    // One PB203, at the segment: the sweep has no S that could be removed.
    assert_eq!(checked("S15", "", Role::Checked), ["PB203"]);
    assert_eq!(checked("S15", "S15", Role::Checked), ["PB203", "PB203"]);
}

#[test]
fn the_s_of_a_sweep_clears_the_probes() {
    let checked = |s: &str| {
        let drawn = format!(
            "layer 1111.1P\nstart 0,0 \"T5 O3 I1 Mx B0 S20\"\nmill 0,0 20,0\nprobe 10,30 \"T9.9\"\n\
             sweep 20,0 40,0 \"{s}\"\nend 40,0"
        );
        codes(&[("lib/1111.dxf", &drawn)], "lib/1111.dxf", "1111.1P", Role::Checked)
    };
    assert_eq!(checked("S10"), [""; 0]);
    assert_eq!(checked("S9.9"), ["PB203"]);
}

#[test]
fn a_path_that_two_drawings_define_is_in_neither() {
    let files = [
        ("lib/1111.1P.dxf", component("1111.1P", "0")),
        ("lib/1111.dxf", component("1111.1P", "0")),
        ("lib/8001.1P.dxf", project("8001.1P", ">1111.1P")),
    ];
    let files: Vec<(&str, &str)> = files.iter().map(|(file, text)| (*file, text.as_str())).collect();
    assert_eq!(codes(&files, "lib/8001.1P.dxf", "8001.1P", Role::Checked), ["PB504"]);
    assert_eq!(codes(&files[1..], "lib/8001.1P.dxf", "8001.1P", Role::Checked), [""; 0]);
}

/// Limits also apply to a path that embeds nothing.
#[test]
fn limits_hold_for_every_path() {
    let project = project("8001.1P", ">1111.1P");
    let component = component("1111.1P", "0");
    let mut world = World::new(&[("lib/1111.1P.dxf", &component), ("lib/8001.1P.dxf", &project)]);
    for (file, path) in [("lib/1111.1P.dxf", "1111.1P"), ("lib/8001.1P.dxf", "8001.1P")] {
        let mut refused = |limits: Limits| {
            _ = Settings::get(&world.db).set_limits(&mut world.db).to(limits);
            world.judge("path", file, path, Role::Checked).contains(&"PB005".to_owned())
        };
        let moves = |moves| Limits { moves, ..LIMITS };
        let least = (0..1000).find(|least| !refused(moves(*least))).unwrap();
        assert!(least > 0 && refused(moves(least - 1)), "{path}: {least}");
        let paths = |paths| Limits { paths, ..LIMITS };
        let count = if path == "8001.1P" { 2 } else { 1 };
        assert!(!refused(paths(count)) && refused(paths(count - 1)), "{path}");
    }
}

/// Drawings without findings need no expensive query, so they are read once.
#[test]
fn a_check_reads_each_drawing_once() {
    let project = project("8001.1P", ">1111.1P");
    let component = component("1111.1P", "0");
    let mut world = World::new(&[("lib/1111.1P.dxf", &component), ("lib/8001.1P.dxf", &project)]);
    world.judge("component", "lib/1111.1P.dxf", "1111.1P", Role::Checked);
    assert_eq!(
        world.ran().iter().map(String::as_str).collect::<Vec<_>>(),
        ["closure component", "file_index component", "path_index component"]
    );
    world.judge("project", "lib/8001.1P.dxf", "8001.1P", Role::Checked);
    let large = ["raw_file", "raw_path", "path", "chains", "summary_with_values"];
    assert!(
        large.iter().all(|query| !world.ran().contains(&format!("{query} project"))),
        "{:?}",
        world.ran()
    );
}
