//! Tests the inheritance of values: an element has its own value, or else the path's. (book: language/letters)

use pathbuild_path::{
    CutParameters, ElementClass, Letter, Path, PathNumbers, PathOptions, PathRole, Provider, SegmentKind,
    fallback,
};

use crate::letters::{LETTERS, WITH_DEFAULT};
use crate::support::{compile, path, read, wrong};

/// Returns the text of a start that gives every value of the path, one of them changed.
fn parameters(changed: Option<char>) -> String {
    let given = LETTERS.iter().filter(|(_, [value, _])| !value.is_empty());
    let piece = |(letter, [value, other]): &(char, [&str; 2])| {
        format!("{letter}{}", if changed == Some(*letter) { other } else { value })
    };
    given.map(piece).collect::<Vec<_>>().join(" ")
}

/// Returns the parameters of a path's first segment and its probe, without their origins.
fn known(parameters: &str, statements: &str) -> String {
    let compiled = compile(&path(parameters, statements));
    let errors: Vec<_> = compiled.found.iter().filter(|found| found.is_error()).collect();
    assert!(errors.is_empty(), "{errors:?} with {parameters}\n{statements}");
    let path: Path = compiled.path.unwrap();
    let segment = match path.segments[0].kind.clone() {
        SegmentKind::Cut(cut) => {
            format!("{:?}", CutParameters { chain_letters: None, ..path.cuts[cut as usize].clone() })
        }
        SegmentKind::Subpath(subpath) => {
            format!("{} {} {:?}", subpath.thickness, subpath.tool, subpath.material)
        }
        SegmentKind::Hole(hole) => format!("{:?}", path.holes[hole as usize]),
        SegmentKind::Helix(helix) => format!("{:?}", path.helices[helix as usize]),
        SegmentKind::Sweep { height } => format!("{height:?}"),
    };
    let probe = path.probes.first().map(|probe| (probe.height, probe.feed));
    format!("{segment} {probe:?}")
}

/// Checks that each letter that both the path and an element of this class may give comes from the element, or else from the path.
fn check(class: ElementClass, statement: impl Fn(&str) -> String) {
    // The values of variables are those of the embedded path.
    let is_inherited = |letter: &Letter| {
        let counts = |class: ElementClass| class.use_of(*letter).counts();
        counts(class) && counts(ElementClass::PathStart) && *letter != Letter::Variable
    };
    for letter in Letter::all().filter(is_inherited).map(Letter::as_char) {
        let (_, [value, other]) = LETTERS.into_iter().find(|(known, _)| *known == letter).unwrap();
        let plain = known(&parameters(None), &statement(""));
        let from_element = known(&parameters(None), &statement(&format!("{letter}{other}")));
        let from_path = known(&parameters(Some(letter)), &statement(""));
        assert_ne!(plain, from_path, "{letter} of the path matters");
        assert_eq!(from_element, from_path, "{letter} of the element is as good as the path's");
        let over = known(&parameters(Some(letter)), &statement(&format!("{letter}{value}")));
        assert_eq!(over, plain, "{letter} of the element wins over the path's");
    }
}

fn on_line(kind: &'static str) -> impl Fn(&str) -> String {
    move |text| format!("{kind} 0,0 40,0 \"Q1 {text}\"\nend 40,0")
}

fn on_circle(circle: &'static str) -> impl Fn(&str) -> String {
    move |text| format!("sweep 0,0 40,0\ncircle {circle} \"Q1 {text}\"\nend 40,0")
}

#[test]
fn segments_of_chains() {
    check(ElementClass::Mill, on_line("mill"));
    check(ElementClass::Mark, on_line("mark"));
    check(ElementClass::Support, on_line("bars"));
}

#[test]
fn sweeps() {
    check(ElementClass::Sweep, |text| format!("line DASHED 0,0 40,0 \"N1 {text}\"\nend 40,0"));
}

#[test]
fn subpaths_and_probes() {
    check(ElementClass::Subpath, |text| format!("subpath 0,0 40,0 \">1111.1P {text}\"\nend 40,0"));
    check(ElementClass::Probe, |text| format!("mill 0,0 40,0\nprobe 20,40 \"Lx {text}\"\nend 40,0"));
}

#[test]
fn circles() {
    check(ElementClass::DrilledHole, on_circle("40,0 d 3"));
    check(ElementClass::DrilledMark, on_circle("DIVIDE 40,0 d 3"));
    check(ElementClass::HelicalCircle, on_circle("40,0 d 8"));
    check(ElementClass::HelicalMark, on_circle("DIVIDE 40,0 d 8"));
    check(ElementClass::HelicalSupport, on_circle("BORDER 40,0 d 10"));
}

#[test]
fn h_and_n_and_s_have_no_value_of_the_path() {
    let compiled =
        compile(&path("T5 O3 I1 B1", "subpath 0,0 40,0 \">1111.1P\"\nprobe 20,40 \"H2\"\nend 40,0"));
    let path_without = compiled.path.unwrap();
    let SegmentKind::Subpath(subpath) = &path_without.segments[0].kind else { panic!() };
    assert_eq!((subpath.height, path_without.probes[0].height), (0.0, 7.0));
    let compiled = compile(&path("T5 O3 I1 B1", "subpath 0,0 40,0 \">1111.1P H1,5\"\nend 40,0"));
    let path_with = compiled.path.unwrap();
    let SegmentKind::Subpath(subpath) = &path_with.segments[0].kind else { panic!() };
    assert_eq!(subpath.height, 1.5);
}

#[test]
fn the_default_s_of_an_embedded_or_checked_path_is_t_and_o() {
    let path_of = |parameters: &str| compile(&path(parameters, "mill 0,0 40,0\nend 40,0")).path.unwrap();
    let (none, options) =
        (PathOptions::default(), PathOptions { sweep_height: Some(30.0), ..PathOptions::default() });
    let without = path_of("T5 O3 I1 B0");
    assert_eq!(without.embedded_sweep_height(), 8.0);
    assert_eq!(
        (without.sweep_height(&options, PathRole::Emitted), without.sweep_height(&none, PathRole::Emitted)),
        (Some(30.0), None)
    );
    let with = path_of("T5 O3 I1 B0 S20");
    assert_eq!(with.embedded_sweep_height(), 20.0);
    assert_eq!(with.sweep_height(&options, PathRole::Emitted), Some(20.0));
}

/// Everything that is milled or drilled needs a feed. Even if all segments have their own, a chain needs the path's feed, but other elements do
/// not.
#[test]
fn a_path_needs_the_option_for_a_feed_where_it_gives_none() {
    let needs = |parameters: &str, statements: &str| {
        compile(&path(&format!("T5 O3 I1 B0 {parameters}"), statements)).path.unwrap().needs_feed()
    };
    assert!(needs("", "mill 0,0 40,0\nend 40,0"));
    assert!(needs("", "mill 0,0 40,0 \"F100\"\nend 40,0"));
    assert!(!needs("F100", "mill 0,0 40,0\nend 40,0"));
    assert!(!needs("", "sweep 0,0 40,0\nend 40,0"));
    assert!(needs("", "sweep 0,0 40,0\ncircle 40,0 d 3\nend 40,0"));
    assert!(!needs("", "sweep 0,0 40,0\ncircle 40,0 d 3 \"F100\"\nend 40,0"));
    assert!(needs("", "sweep 0,0 40,0\ncircle 40,0 d 8\nend 40,0"));
    assert!(!needs("", "sweep 0,0 40,0\ncircle 40,0 d 8 \"F100\"\nend 40,0"));
    assert!(!needs("", "subpath 0,0 40,0 \">1111.1P\"\nend 40,0"));
}

const GIVER: &str = "layer 1234.2P\nstart 0,100 \"T5 O3 I1 B1\"\nmill 0,100 40,100\nend 40,100";

/// Returns the findings about a path that borrows by @, next to a path that lends.
fn at(text: &str, giver: &str) -> Vec<String> {
    wrong(&format!("{}\n{giver}", path(text, "mill 0,0 40,0\nend 40,0")))
}

#[test]
fn at_takes_the_parameters_of_another_path_of_the_drawing() {
    assert_eq!(at("@1234.2P", GIVER), [""; 0]);
    assert_eq!(at("@1234.2p", GIVER), [""; 0]);
    assert_eq!(at("@1234.3P", GIVER), ["PB208"]);
    assert_eq!(at("@1234.2P F100", GIVER), ["PB208"]);
    assert_eq!(at("@1234.2P", &GIVER.replace("\"T5 O3 I1 B1\"", "\"@1234.1P\"")), ["PB208"]);
    assert_eq!(at("@1234.1P", GIVER), ["PB208"]);
    assert_eq!(at("@1234.2P", "layer 1234.2P\nmill 0,100 40,100\nend 40,100"), ["PB208"]);
}

#[test]
fn at_takes_everything_that_the_other_start_says() {
    let drawing = |text: &str, giver: &str| {
        format!("{}\n{}", path(text, "mill 0,0 40,0\nend 40,0"), GIVER.replace("T5 O3 I1 B1", giver))
    };
    let all = "T5 O3 I1 B1 F100 S20 My Rz E1111 W4 C2";
    let (own, borrowed) = (compile(&drawing(all, all)), compile(&drawing("@1234.2P", all)));
    assert!(own.found.is_empty() && borrowed.found.is_empty());
    let show = |compiled: crate::support::Compiled| {
        let path = compiled.path.unwrap();
        let of_path = (
            path.tool,
            path.thickness,
            path.sweep_height,
            path.material,
            path.feed,
            path.output_suffix,
            path.embeds_only,
        );
        format!("{of_path:?} {:?} {:?}", path.segments[0].kind, path.cuts)
    };
    assert_eq!(show(own), show(borrowed));
}

#[test]
fn faults_of_borrowed_parameters_are_reported_with_the_path_they_belong_to() {
    let file =
        read(&format!("{}\n{}", path("@1234.2P", "mill 0,0 40,0\nend 40,0"), GIVER.replace("B1", "B1 X1")));
    for (path, _) in &file.paths {
        let found: Vec<_> =
            path.diagnostics.iter().map(|found| (found.code().to_string(), found.path.as_deref())).collect();
        assert_eq!(found, [("PB202".to_owned(), Some("1234.2P"))], "{:?}", path.name);
    }
}

/// Tests each letter if no text gives it, for a path with O2, T5 and F90.
#[test]
fn defaults_follow_from_one_function() {
    use ElementClass::{
        DrilledHole, DrilledMark, HelicalCircle, HelicalMark, HelicalSupport, Mark, Mill, PathStart, Probe,
        Subpath, Support, Sweep, UnknownCircle,
    };

    let path = PathNumbers { tool: Some(2.0), thickness: Some(5.0), feed: Some(90.0) };
    let options =
        PathOptions { feed: Some(99.0), sweep_height: Some(20.0), probe_feed: None, compatible: false };
    let compatible = PathOptions { compatible: true, ..options };
    let probing = PathOptions { probe_feed: Some(7.0), ..options };
    let (emitted, embedded) = (PathRole::Emitted, PathRole::Embedded);
    let option = |value, name| Some((value, Provider::Option(name)));
    let default = |value| Some((value, Provider::Default));
    for (letter, class, options, role, expected) in [
        (Letter::F, Mill, &options, emitted, option(99.0, "feed")),
        (Letter::S, PathStart, &options, emitted, option(20.0, "sweep-height")),
        (Letter::S, PathStart, &options, embedded, default(7.0)),
        (Letter::A, HelicalCircle, &options, emitted, default(8.0)),
        (Letter::A, PathStart, &options, emitted, None),
        (Letter::H, Subpath, &options, emitted, default(0.0)),
        (Letter::H, Mill, &options, emitted, None),
        (Letter::Z, Probe, &probing, emitted, option(7.0, "probe-feed")),
        (Letter::Z, Probe, &options, emitted, Some((90.0, Provider::Path))),
        (Letter::Z, Probe, &compatible, emitted, option(99.0, "feed")),
        (Letter::B, Mill, &options, emitted, None),
    ] {
        assert_eq!(fallback(letter, class, path, options, role), expected, "{letter:?} {class:?} {role:?}");
    }
    let has_default = |letter: &Letter| {
        let default = |class| fallback(*letter, class, path, &options, embedded);
        let lines = [Mill, Mark, Support, Sweep, Subpath].into_iter();
        let circles = [DrilledHole, DrilledMark, HelicalCircle, HelicalMark, HelicalSupport, UnknownCircle];
        lines.chain(circles).chain([PathStart, Probe]).any(|class| default(class).is_some())
    };
    assert_eq!(Letter::all().filter(has_default).map(Letter::as_char).collect::<String>(), WITH_DEFAULT);
}
