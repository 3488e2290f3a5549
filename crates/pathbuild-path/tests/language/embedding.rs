//! Tests whether a path fits the subpath segment that names it. (book: language/embedding)

use std::sync::LazyLock;

use pathbuild_diagnostic::{Diagnostic, Lang};
use pathbuild_path::{
    Language, PathHeader, PathName, PathSignature, PathTool, PathTools, Restriction, SubpathCall,
    SubpathChecker,
};

use crate::support::{codes, compile, language, path, raw};

/// Returns a path with one subpath segment of 20 mm.
fn project(parameters: &str, segment: &str) -> PathSignature {
    signature(&path(parameters, &format!("subpath 0,0 20,0 \"{segment}\"\nend 20,0")))
}

/// Returns a path of 20 mm to be embedded.
fn component(parameters: &str) -> PathSignature {
    component_of(parameters, "20")
}

fn component_of(parameters: &str, length: &str) -> PathSignature {
    signature(&path(parameters, &format!("mill 0,0 {length},0\nend {length},0")))
}

fn signature(drawing: &str) -> PathSignature {
    PathSignature::of(&compile(drawing).path.expect("the path is right"))
}

/// Returns the result of calling `judge` with the checker of a path and the path's only segment.
fn judged<R>(
    outer: &PathSignature,
    restrictions: &[Restriction],
    judge: impl FnOnce(SubpathChecker<'_>, &SubpathCall) -> R,
) -> R {
    judge(SubpathChecker::new(outer, restrictions, &LANGUAGE, false), &outer.subpaths[0])
}

/// Returns the mismatches with their letters.
fn misfits(outer: &PathSignature, inner: &PathSignature) -> Vec<String> {
    judged(outer, &[], |judge, call| codes(&judge.mismatches(call, inner)))
}

/// Returns the code that prevents a path from embedding the one named by its segment.
fn refused(outer: &PathSignature, restrictions: &[Restriction]) -> Option<String> {
    judged(outer, restrictions, |judge, call| {
        judge.name(call).err().map(|problem| problem.code().to_string())
    })
}

fn restriction(parent: &str, child: &str) -> Restriction {
    Restriction::new(parent, child).unwrap()
}

static LANGUAGE: LazyLock<Language> = LazyLock::new(language);

const RIGHT: [&str; 0] = [];

#[test]
fn the_segment_is_as_long_as_the_path() {
    let outer = project("T5 O3 I1 B0 Mx", ">1111.1P");
    let of_length = |length: &str| misfits(&outer, &component_of("T5 O3 I1 B0 Mx", length));
    assert_eq!(of_length("20"), RIGHT);
    assert_eq!(of_length("20.00099"), RIGHT);
    assert_eq!(of_length("19.99901"), RIGHT);
    assert_eq!(of_length("20.00101"), ["PB505"]);
    assert_eq!(of_length("19.99899"), ["PB505"]);
    // A closed path needs a full circle instead.
    let help = |end: &str| {
        let inner = signature(&path("T5 O3 I1 B0 Mx", &format!("mill 0,0 9,0 9,9 {end}\nend {end}")));
        judged(&outer, &[], |judge, call| judge.mismatches(call, &inner))[0].help(Lang::En).unwrap()
    };
    assert!(help("0,0.001").starts_with("replace the segment by a full circle"));
    assert!(help("0,0.00101").starts_with("draw the segment from where"));
}

#[test]
fn t_and_o_are_those_of_the_path() {
    let inner = component("T5 O3 I1 B0 Mx");
    let with = |text: &str| misfits(&project("T6 O3 I1 B0 My", &format!(">1111.1P Mx {text}")), &inner);
    assert_eq!(with("T5"), RIGHT);
    assert_eq!(with("T5.000005"), RIGHT);
    assert_eq!(with("T5.00001"), ["PB506 T"]);
    assert_eq!(with(""), ["PB506 T"]);
    assert_eq!(with("T5 O3.000003"), RIGHT);
    assert_eq!(with("T5 O3.00001"), ["PB506 O"]);
}

/// A text of the segment is corrected there if the embedding path suits the embedded one.
#[test]
fn the_advice_is_about_the_text_that_is_wrong() {
    let help = |outer: &str, segment: &str| {
        let outer = project(&format!("{outer} I1 B0 Mx"), &format!(">1111.1P {segment}"));
        let found = judged(&outer, &[], |judge, call| judge.mismatches(call, &component("T5 O3 I1 B0 Mx")));
        found[0].help(Lang::En).unwrap_or_default()
    };
    assert!(help("T5 O3", "O2").contains("write its O on the segment"));
    assert!(help("T5 O2", "O2").contains("give both paths the same O"));
    assert!(help("T5 O2", "").contains("give both paths the same O"));
    assert!(help("T5 O3", "T4").contains("write its T on the segment"));
    assert!(help("T4 O3", "T4").contains("give both paths the same T"));
    assert!(help("T6 O3", "").contains("give both paths the same T"));
    // The T of the path would be wrong on the segment as well, unless the path lies in a sheet of its own.
    assert!(help("T6 O3", "T4").contains("give both paths the same T"));
    assert!(help("T6 O3", "T4 H1").contains("write its T on the segment"));
    assert!(help("T6 O3", "H1").contains("write its T on the segment"));
    assert!(help("T4 O3", "H1").contains("give both paths the same T"));
}

/// A program has a single cutter, regardless of the text of a segment.
#[test]
fn o_is_that_of_the_embedding_path() {
    let with = |outer: &str, segment: &str, inner: &str, is_compatible| {
        let outer = project(&format!("T5 O{outer} I1 B0 Mx"), &format!(">1111.1P {segment}"));
        let inner = component(&format!("T5 O{inner} I1 B0 Mx"));
        let judge = SubpathChecker::new(&outer, &[], &LANGUAGE, is_compatible);
        let found = judge.mismatches(&outer.subpaths[0], &inner);
        found.into_iter().map(|problem| (problem.code().to_string(), problem.is_error())).collect::<Vec<_>>()
    };
    let error = [("PB506".to_owned(), true)];
    let warning = [("PB506".to_owned(), false)];
    assert_eq!(with("3", "O2", "2", false), error);
    assert_eq!(with("3", "O3.00001", "3.00001", false), error);
    assert_eq!(with("3", "O3.000003", "3.000003", false), []);
    assert_eq!(with("3", "", "3", false), []);
    assert_eq!(with("3", "O2", "2", true), warning);
    // The segment contradicts even the path that contains it, which also gives a single error.
    assert_eq!(with("3", "O2", "3", false), error);
    assert_eq!(with("3", "O2", "3", true), error);
    assert_eq!(with("3", "O2", "1", false), error);
}

/// There is a tool for 1111.1P and another one for all other paths, both of the same diameter.
#[test]
fn the_tool_is_that_of_the_embedding_path() {
    let found = |of_inner: &'static str, is_named, inner_tool: &str, is_compatible| {
        let tools = PathTools::new(move |path, _| {
            let is_inner = path == "1111.1P";
            let name = if is_inner { of_inner } else { "mill" };
            let (name, is_named) = (name.into(), is_named && is_inner);
            Some(PathTool {
                name,
                is_named,
                chip_load: None,
                cutting_length: None,
                is_slot_cutter: false,
                corner_radius: 0.0,
            })
        });
        let outer = project("T5 O3 I1 B0 Mx", &format!(">1111.1P O{inner_tool}"));
        let inner = path(&format!("T5 O{inner_tool} I1 B0 Mx"), "mill 0,0 20,0\nend 20,0");
        let inner = signature(&inner.replace("1234.1P", "1111.1P"));
        let language = Language { tools, ..language() };
        let judge = SubpathChecker::new(&outer, &[], &language, is_compatible);
        let found = judge.mismatches(&outer.subpaths[0], &inner);
        found.into_iter().map(|problem| (problem.text(Lang::En), problem.is_error())).collect::<Vec<_>>()
    };
    let said = "path 1111.1P is for the tool slot ([tool] in pathbuild.toml), but path 1234.1P is milled with the tool mill, of the same diameter";
    assert_eq!(found("slot", true, "3", false), [(said.to_owned(), true)]);
    assert_eq!(found("slot", true, "3", true), [(said.to_owned(), false)]);
    assert_eq!(found("mill", true, "3", false), []);
    // For a path that no tool names, any tool of its diameter suffices.
    assert_eq!(found("slot", false, "3", false), []);
    // A tool of another diameter is a different tool, which is reported.
    let [(text, true)] = &found("slot", true, "2", false)[..] else { panic!() };
    assert!(text.contains("is drawn for a cutter of 2 mm"), "{text}");
}

/// There is a tool for 1234.1P, the embedding path, and another one for all other paths, both of the same diameter.
#[test]
fn a_project_may_have_its_own_cutter_of_the_same_shape() {
    let found = |is_outer_slot, is_inner_slot, name: &'static str, is_compatible| {
        let tools = PathTools::new(move |path, _| {
            let is_outer = path == "1234.1P";
            let name = if is_outer { name } else { "mill" };
            let is_slot_cutter = if is_outer { is_outer_slot } else { is_inner_slot };
            Some(PathTool {
                name: name.into(),
                is_named: is_outer,
                chip_load: None,
                cutting_length: None,
                is_slot_cutter,
                corner_radius: 0.0,
            })
        });
        let outer = project("T5 O3 I1 B0 Mx", ">1111.1P O3");
        let inner = path("T5 O3 I1 B0 Mx", "mill 0,0 20,0\nend 20,0");
        let inner = signature(&inner.replace("1234.1P", "1111.1P"));
        let language = Language { tools, ..language() };
        let judge = SubpathChecker::new(&outer, &[], &language, is_compatible);
        let found = judge.mismatches(&outer.subpaths[0], &inner);
        found.into_iter().map(|problem| (problem.code().to_string(), problem.is_error())).collect::<Vec<_>>()
    };
    let (error, warning) = ([("PB506".to_owned(), true)], [("PB506".to_owned(), false)]);
    assert_eq!(found(true, false, "own", false), error);
    assert_eq!(found(false, true, "own", false), error);
    assert_eq!(found(false, false, "own", false), warning);
    assert_eq!(found(true, true, "own", false), warning);
    assert_eq!(found(true, false, "own", true), warning);
    assert_eq!(found(false, false, "mill", false), []);
}

/// An embedded path lies in the material of the embedding path, so it must not be thicker.
#[test]
fn t_of_a_segment_is_no_more_than_that_of_its_path() {
    let with = |own: &str, segment: &str| {
        let outer = project(&format!("T{own} O3 I1 B0 Mx"), &format!(">1111.1P T{segment}"));
        misfits(&outer, &component(&format!("T{segment} O3 I1 B0 Mx")))
    };
    assert_eq!(with("5", "5"), RIGHT);
    assert_eq!(with("5", "5.000004"), RIGHT);
    assert_eq!(with("5", "5.00001"), ["PB510"]);
    assert_eq!(with("5", "4"), ["PB506"]);
}

/// Rapid moves of an embedded path go down to its T, which must not be inside the material of the embedding path.
#[test]
fn a_thinner_sheet_has_another_m_or_lies_on_shims() {
    let found = |outer: &str, segment: &str, inner: &str, is_compatible| {
        let outer = project(&format!("O3 I1 B0 {outer}"), &format!(">1111.1P {segment}"));
        let inner = component(&format!("O3 I1 B0 {inner}"));
        let judge = SubpathChecker::new(&outer, &[], &LANGUAGE, is_compatible);
        let found = judge.mismatches(&outer.subpaths[0], &inner);
        found.into_iter().map(|problem| (problem.code().to_string(), problem.is_error())).collect::<Vec<_>>()
    };
    let error = [("PB506".to_owned(), true)];
    let warning = [("PB506".to_owned(), false)];
    assert_eq!(found("T5 Mx", "T4", "T4 Mx", false), error);
    assert_eq!(found("T5 Mx", "T4", "T4 Mx", true), warning);
    assert_eq!(found("T5 Mx", "T4 H0", "T4 Mx", false), error);
    assert_eq!(found("T5 Mx", "T4.999996", "T4.999996 Mx", false), []);
    assert_eq!(found("T5 Mx", "T4.99999", "T4.99999 Mx", false), error);
    // Sheets of their own.
    assert_eq!(found("T5 Mx", "T4 My", "T4 My", false), []);
    assert_eq!(found("T5 Mx", "T4 H0.5", "T4 Mx", false), []);
    // A sheet that lies lower is none of its own, nor is one with an M that differs in case only.
    assert_eq!(found("T5 Mx", "T4 H-0.5", "T4 Mx", false), error);
    assert_eq!(found("T5 MX", "T4 Mx", "T4 Mx", false), error);
    // The path may be one for several sheets, but it does not say so.
    assert_eq!(found("T5", "T4 Mx", "T4 Mx", false), warning);
    assert_eq!(found("T5", "T5 Mx", "T5 Mx", false), []);
    // Any other mismatch of T is reported alone.
    assert_eq!(found("T5 Mx", "T4", "T3 Mx", false), error);
}

#[test]
fn m_is_that_of_the_path_and_both_say_it() {
    let with = |own: &str, segment: &str, inner: &str| {
        let outer = project(&format!("T5 O3 I1 B0 {own}"), &format!(">1111.1P {segment}"));
        misfits(&outer, &component(&format!("T5 O3 I1 B0 {inner}")))
    };
    assert_eq!(with("Mx", "", "Mx"), RIGHT);
    assert_eq!(with("Mx", "My", "My"), RIGHT);
    assert_eq!(with("Mx", "", "My"), ["PB506 M"]);
    assert_eq!(with("", "", "Mx"), ["PB201"]);
    assert_eq!(with("Mx", "", ""), ["PB201"]);
    assert_eq!(with("", "", ""), ["PB201"]);
}

/// E is matched anywhere in the name, and replaces all restrictions.
#[test]
fn e_says_what_may_be_embedded() {
    let with = |rule: &str| project(&format!("T5 O3 I1 B0 Mx E{rule}"), ">1111.1P");
    assert_eq!(refused(&with("11P"), &[]).as_deref(), Some("PB507"));
    assert_eq!(refused(&with("11.1P"), &[]), None);
    assert_eq!(refused(&with("^2"), &[]).as_deref(), Some("PB507"));
    assert_eq!(refused(&with("^1"), &[restriction("", "^2")]), None);
    assert_eq!(refused(&with("1p$"), &[]), None);
}

/// The first restriction that applies to a path decides.
#[test]
fn restrictions_say_what_may_be_embedded() {
    let outer = project("T5 O3 I1 B0 Mx", ">1111.1P");
    assert_eq!(refused(&outer, &[]), None);
    assert_eq!(refused(&outer, &[restriction("^8", "^2")]), None);
    assert_eq!(refused(&outer, &[restriction("^1", "^2")]).as_deref(), Some("PB507"));
    assert_eq!(refused(&outer, &[restriction("^1", "^1"), restriction("^1", "^2")]), None);
    assert_eq!(refused(&outer, &[restriction("^8", "^1"), restriction("", "^2")]).as_deref(), Some("PB507"));
    // Names do not differ by case.
    assert_eq!(refused(&outer, &[restriction("p$", "l$")]).as_deref(), Some("PB507"));
    assert_eq!(refused(&outer, &[restriction("p$", "p$")]), None);
}

#[test]
fn a_segment_names_a_path_and_no_more() {
    let named = |segment: &str| {
        let outer = project("T5 O3 I1 B0 Mx", segment);
        let found = judged(&outer, &[], |judge, call| {
            let warnings = judge.warnings(call);
            assert!(!warnings.iter().any(Diagnostic::is_error), "{warnings:?}");
            judge.name(call).err().map(|it| *it).into_iter().chain(warnings).collect::<Vec<_>>()
        });
        codes(&found)
    };
    assert_eq!(named(">1111.1P"), RIGHT);
    assert_eq!(named(">1111.1P,"), ["PB502"]);
    assert_eq!(named(">x"), ["PB502"]);
    assert_eq!(named("Mx"), ["PB501"]);
}

/// No text can belong to a segment without length. A closed path is embedded by a full circle.
#[test]
fn a_segment_without_length_cannot_name_a_path() {
    let named = |segment: &str| {
        let outer = signature(&path("T5 O3 I1 B0 Mx", &format!("{segment}\nmill 0,0 40,0\nend 40,0")));
        judged(&outer, &[], |judge, call| judge.name(call).err().map(|problem| problem.text(Lang::En)))
    };
    let without_text = Some("the subpath does not say which path to embed".to_owned());
    assert_eq!(named("subpath arc centre 0,5 r 5 from 270 to 270"), without_text);
    let without_length = Some("this subpath has no length, so no text can belong to it".to_owned());
    assert_eq!(named("subpath 0,0 0,0"), without_length);
}

/// An underscore is a point in names of layers only. The help names the path that was meant.
#[test]
fn a_name_with_an_underscore_is_corrected() {
    let help = |segment: &str| {
        let outer = project("T5 O3 I1 B0 Mx", segment);
        let (judge, call) = (SubpathChecker::new(&outer, &[], &LANGUAGE, false), &outer.subpaths[0]);
        judge.name(call).err().and_then(|problem| problem.help(Lang::En)).unwrap_or_default()
    };
    for name in [">1111_1P", ">1111,1P"] {
        assert!(help(name).contains("write \">1111.1P\""), "{name}: {}", help(name));
    }
    assert!(help(">1111;1P").contains("write a name that matches"));
}

/// A text with letters or digits beside a name means another name, or a parameter; PathDxf2GCode ignores them.
#[test]
fn a_name_that_goes_on_is_another() {
    let named = |segment: &str, is_compatible| {
        let outer = project("T5 O3 I1 B0 Mx", segment);
        let (judge, call) = (SubpathChecker::new(&outer, &[], &LANGUAGE, is_compatible), &outer.subpaths[0]);
        let error = judge.name(call).err().map(|problem| problem.code().to_string());
        (error, codes(&judge.warnings(call)))
    };
    let (error, warning) = (Some("PB502".to_owned()), vec!["PB502".to_owned()]);
    for name in [
        ">1111.1PA",
        ">1111.1P2",
        ">1111.1Pä",
        ">91111.1P",
        ">A1111.1P",
        ">1111.1P,H3",
        ">1111.1P;:D2",
        ">1111.1P\u{a0}H3",
        ">1111.1P(A)",
    ] {
        assert_eq!(named(name, false), (error.clone(), vec![]), "{name}");
        assert_eq!(named(name, true), (None, warning.clone()), "{name}");
    }
    for name in [">1111.1P,", ">1111.1P.", ">'1111.1P'"] {
        assert_eq!(named(name, false), (None, warning.clone()), "{name}");
    }
    assert_eq!(named(">1111.1P Mx", false), (None, vec![]));
}

/// An umlaut may be one character or two, which look the same.
#[test]
fn materials_that_only_look_the_same_are_told_apart() {
    let notes = |here: &str, there: &str| {
        let outer = project(&format!("T5 O3 {here}"), ">1111.1P");
        let inner = component(&format!("T5 O3 I1 B0 {there}"));
        let found = judged(&outer, &[], |judge, call| judge.mismatches(call, &inner));
        found.iter().map(|found| found.notes.len()).collect::<Vec<_>>()
    };
    assert_eq!(notes("Mbl\u{e4}ch", "Mbl\u{e4}ch"), [0; 0]);
    assert_eq!(notes("Mbl\u{e4}ch", "Mbla\u{308}ch"), [1]);
    assert_eq!(notes("Mbl\u{e4}ch", "Mblech"), [0]);
}

#[test]
fn values_fit_the_definitions_of_the_path() {
    let inner = PathHeader::of(&raw(&path("T5 O3 I1 Mx :B0~1", "mill 0,0 20,0 \"B=B\"\nend 20,0")));
    let with = |text: &str| {
        let outer = project("T5 O3 I1 B0 Mx", &format!(">1111.1P {text}"));
        judged(&outer, &[], |judge, call| codes(&judge.binding_problems(call, &inner)))
    };
    assert_eq!(with(":B1"), RIGHT);
    assert_eq!(with(":B1.1"), ["PB304"]);
    assert_eq!(with(""), ["PB302"]);
    assert_eq!(with(":B1 :C1"), ["PB303"]);
    // C may be what B was meant to be.
    assert_eq!(with(":C1"), ["PB303"]);
    let two = PathHeader::of(&raw(&path("T5 O3 I1 Mx :B0~1 :D0~1", "mill 0,0 20,0 \"B=B D=D\"\nend 20,0")));
    let outer = project("T5 O3 I1 B0 Mx", ">1111.1P :C1");
    let found = judged(&outer, &[], |judge, call| codes(&judge.binding_problems(call, &two)));
    assert_eq!(found, ["PB303", "PB302"]);
    let unsound = PathHeader { is_sound: false, ..inner.clone() };
    let outer = project("T5 O3 I1 B0 Mx", ">1111.1P");
    assert_eq!(judged(&outer, &[], |judge, call| codes(&judge.binding_problems(call, &unsound))), RIGHT);
}

/// In a list, the comma separates the values, so that a decimal comma is none of them.
#[test]
fn a_decimal_comma_in_the_value_of_a_list_is_explained() {
    let advice = |definition: &str| {
        let inner = format!("T5 O3 I1 Mx {definition}");
        let inner = PathHeader::of(&raw(&path(&inner, "mill 0,0 20,0 \"B=B\"\nend 20,0")));
        let outer = project("T5 O3 I1 B0 Mx", ">1111.1P :B0,8");
        let found = judged(&outer, &[], |judge, call| judge.binding_problems(call, &inner));
        found
            .iter()
            .map(|found| found.help(Lang::En).is_some_and(|help| help.contains("with a point")))
            .collect::<Vec<_>>()
    };
    assert_eq!(advice(":B0,5,0.8"), [true]);
    assert_eq!(advice(":B?08"), [false]);
    assert_eq!(advice(":B0~0,7"), [false]);
    assert_eq!(advice(":B0~0,8"), [false; 0]);
}

#[test]
fn what_is_not_found_names_what_is_near() {
    let outer = project("T5 O3 I1 B0 Mx", ">1111.1P");
    let notes = |known: &[&str]| {
        let known = known.iter().map(|name| PathName::new(name)).collect();
        let name = PathName::new("1111.1P");
        let problem = judged(&outer, &[], |judge, call| {
            judge.not_found_problem(
                call,
                &name,
                ["."].into_iter().collect(),
                ["a.dxf"].into_iter().collect(),
                known,
            )
        });
        assert_eq!(problem.code().to_string(), "PB503");
        problem.notes.iter().map(|note| note.text(Lang::En)).collect::<Vec<_>>()
    };
    assert!(notes(&[]).is_empty());
    assert_eq!(notes(&["1111.2P", "111.1P", "1111.1Q"]), ["similar names: 111.1P, 1111.1Q"]);
    // The next path of the same drawing is a different path and not a misspelling.
    let there = "the searched drawings contain these paths: ";
    assert_eq!(notes(&["1111.3P", "1111.2P"]), [format!("{there}1111.2P, 1111.3P")]);
    let many = ["1111.2P", "1111.3P", "1111.4P", "1111.5P", "1111.6P", "1111.7P"];
    assert_eq!(notes(&many), [format!("{there}1111.2P, 1111.3P, 1111.4P, 1111.5P, 1111.6P, ...")]);
}
