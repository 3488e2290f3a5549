//! Tests entities on a path's layer that are left out (PB111): programs, sheets and the last line of `emit` mention them.
//! (book: language/layers-and-names)

use crate::support::{Place, Run};

/// For each kind of entity that is left out: a block definition if one is needed, a statement that draws the entity, and its name in messages.
const KINDS: [(&str, &str, &str); 6] = [
    ("", "spline CONTINUOUS control 10,10 15,20 25,10 30,20", "SPLINE"),
    ("", "ellipse CONTINUOUS centre 20,30 major 5,0 ratio 0.5", "ELLIPSE"),
    ("", "polyline spatial 7,50,0 10,50,5 20,50,0", "POLYLINE"),
    ("block HOLE\nlayer 1234.1P\ncircle 0,0 d 2\nendblock\n", "insert HOLE at 20,60 scale 1,2", "INSERT"),
    ("block TITLE\nlayer Frame\ncircle 0,0 d 2\nendblock\n", "insert TITLE at 20,60", "INSERT"),
    (
        "block ODD\nlayer 1234.1P\nspline CONTINUOUS control 0,0 5,5 9,0 12,3\nendblock\n",
        "insert ODD at 20,60",
        "SPLINE",
    ),
];

fn place(blocks: &str, shapes: &str) -> Place {
    let drawing = format!(
        "{blocks}layer 1234.1P\nstart 0,0 \"T5 O2 I1 B0 MPlate\"\nmill 0,0 40,0\n{shapes}\nend 40,0\n"
    );
    let sheet =
        pathbuild_testkit::sheet(&drawing).unwrap_or_else(|faults| panic!("{faults:?} in\n{drawing}"));
    let configuration = "feed = 100\nrapid = 1000\nsweep-height = 20\nspindle = \"manual\"\n";
    Place::new().file("1234.1P.dxf", sheet.to_dxf()).file("pathbuild.toml", configuration)
}

fn last_line(run: &Run) -> &str {
    run.stderr.trim_end().lines().last().unwrap_or_default()
}

/// Returns the first lines of a program, in lower case.
fn header(program: &str) -> String {
    program.lines().take(12).collect::<Vec<_>>().join("\n").to_lowercase()
}

#[test]
fn each_kind_is_told_by_program_sheet_and_last_line() {
    for (blocks, shape, kind) in KINDS {
        let place = place(blocks, shape);
        let run = place.run("emit 1234.1P");
        assert_eq!(run.status, Some(0), "{run}");
        assert_eq!(last_line(&run), format!("not milled: 1 {kind} (1234.1P)"), "{run}");
        let program = place.read("1234.1P_Milling.gcode");
        let line = program.lines().nth(3).unwrap_or_default();
        assert_eq!(line, format!("(Not milled: 1 {kind} of path 1234.1P)"), "{program}");
        let verified = place.run("verify 1234.1P_Milling.gcode --against 1234.1P --format concise");
        assert!(verified.status == Some(0) && verified.stderr.contains("PB111"), "{verified}");
        // An unchanged program still lacks the entity, so the message is repeated.
        assert_eq!(last_line(&place.run("emit 1234.1P")), last_line(&run));
        assert!(last_line(&place.run("emit 1234.1P --lang de")).starts_with("nicht gefräst: 1 "));
        for (lang, text) in [("en", "Not milled: 1 "), ("de", "Nicht gefräst: 1 ")] {
            place.run(&format!("sheet 1234.1P -o sheet.svg --lang {lang}"));
            assert!(place.read("sheet.svg").contains(text), "{lang}: {shape}");
        }
    }
}

#[test]
fn a_whole_drawing_says_nothing() {
    let place = place("", "mill 40,0 40,20\nmill 40,20 40,0");
    let run = place.run("emit 1234.1P");
    assert!(!run.stderr.contains("not milled"), "{run}");
    assert!(!place.read("1234.1P_Milling.gcode").contains("Not milled"));
    assert!(!place.run("verify 1234.1P_Milling.gcode --against 1234.1P").stderr.contains("PB111"));
    place.run("sheet 1234.1P -o sheet.svg");
    assert!(!place.read("sheet.svg").contains("Not milled"));
}

#[test]
fn the_programs_of_all_posts_say_it() {
    let (blocks, shape, _) = KINDS[3];
    let place = place(blocks, &format!("{shape}\n{}\n{}", KINDS[0].1, KINDS[1].1));
    let listed = place.run("post list");
    let posts = listed.stdout.lines().filter_map(|line| line.split_whitespace().next());
    let mut seen = 0;
    for post in posts.filter(|post| *post != "native") {
        let run = place.run(&format!("emit 1234.1P --post {post} -o -"));
        assert_eq!(run.status, Some(0), "{post}: {run}");
        let header = header(&run.stdout);
        assert!(
            header.contains("not milled: 1 ellipse, 1 spline, 1 insert of path 1234.1p"),
            "{post}:\n{header}"
        );
        seen += 1;
    }
    assert!(seen >= 9, "{listed}");
}

/// A program that is translated by a post later keeps the line.
#[test]
fn a_program_that_is_written_for_another_machine_says_it_as_well() {
    let place = place("", KINDS[0].1);
    place.run("emit 1234.1P");
    for post in ["grbl", "xpertmill"] {
        let run = place.run(&format!("post 1234.1P_Milling.gcode --post {post}"));
        assert!(run.stdout.contains("Not milled: 1 SPLINE of path 1234.1P"), "{post}: {run}");
    }
}

#[test]
fn a_polyline_in_space_is_where_its_first_vertex_is() {
    let (_, shape, _) = KINDS[2];
    let run = place("", shape).run("check 1234.1P --format concise");
    assert!(run.stderr.contains("at (7, 50)"), "{run}");
}
