//! An error that is only a consequence of another one is not reported. (book: reference/diagnostics)

use crate::support::Place;

const OPTIONS: &str = "feed = 100\nlibrary = [\".\"]\n";

fn place(files: &[(&str, &str)]) -> Place {
    let dxf = |text: &str| pathbuild_testkit::sheet(text).unwrap().to_dxf();
    let place = Place::new().file("pathbuild.toml", OPTIONS);
    files.iter().fold(place, |place, (name, text)| place.file(&format!("{name}.dxf"), dxf(text)))
}

/// Returns the codes that `check` reports, with the files.
fn found(place: &Place) -> Vec<String> {
    let run = place.run("check --format concise --no-cache");
    let lines = run.stderr.lines().filter_map(|line| line.split_once("[PB"));
    lines.map(|(file, code)| format!("{} {}", &code[..3], file.split([':', '.']).next().unwrap())).collect()
}

fn path(name: &str, start: &str, elements: &str) -> String {
    format!("layer {name}\nstart 0,0 \"{start}\"\n{elements}\n")
}

fn embedding(name: &str, embedded: &str) -> String {
    path(name, "T5 O2 MX", &format!("subpath 0,0 40,0 \"{embedded}\"\nend 40,0"))
}

#[test]
fn a_letter_that_is_missing_on_all_elements_is_one_error() {
    let lines = |letters: &str| {
        let line = |x: i32| format!("mill {x},0 {},0 \"{letters}\"\n", x + 1);
        (0..20).map(line).collect::<String>()
    };
    let start = |start: &str, letters: &str| {
        let place = place(&[("1001.1P", &path("1001.1P", start, &(lines(letters) + "end 20,0")))]);
        place.run("check --format concise --no-cache --lang en")
    };
    let run = start("T5 O2 I1 MX", "N1");
    assert_eq!(run.stderr.matches("PB201").count(), 1, "{run}");
    assert!(run.stderr.contains("B is missing here; further elements of this kind without B: 19"), "{run}");
    // Two letters are two mistakes, and a single element is not a group.
    assert_eq!(start("T5 O2 MX", "N1").stderr.matches("PB201").count(), 2);
    let one = place(&[("1001.1P", &path("1001.1P", "T5 O2 I1 MX", "mill 0,0 9,0\nend 9,0"))]);
    assert!(one.run("check --format concise --lang en").stderr.contains("[PB201] B is missing (path"));
}

/// The texts of subpath segments give O and T too, but none of them is the missing text of the start.
#[test]
fn a_project_without_a_start_text_is_one_error() {
    let component = path("1001.1P", "T5 O2 I1 B0 MX", "mill 0,0 40,0\nend 40,0");
    let project = "layer 8001.1P\nstart 0,0\nsubpath 0,0 40,0 \">1001.1P MX T5 O2\"\nend 40,0\n";
    let place = place(&[("1001.1P", &component), ("8001.1P", project)]);
    assert_eq!(found(&place), ["207 8001"]);
}

#[test]
fn a_wrong_definition_of_a_variable_is_one_error() {
    let with = |definition: &str, value: &str| {
        let start = format!("T5 O2 I1 MX :B{definition}");
        let component = path("1001.1P", &start, "mill 0,0 40,0 \"B=B\"\nend 40,0");
        found(&place(&[
            ("1001.1P", &component),
            ("8001.1P", &embedding("8001.1P", &format!(">1001.1P :B{value}"))),
        ]))
    };
    assert_eq!(with("0~1", "1"), [""; 0]);
    assert_eq!(with("9", "9"), ["301 1001", "511 8001"]);
    assert_eq!(with(" 0~1", "1"), ["202 1001", "511 8001"]);
    assert_eq!(with("0 ~ 1", "1"), ["202 1001", "511 8001"]);
    assert_eq!(with("0 ~ x", "1").iter().filter(|found| found.starts_with("301")).count(), 1);
}

#[test]
fn a_component_whose_drawing_cannot_be_read_is_not_missing() {
    let component = format!("units inch\n{}", path("1001.1P", "T5 O2 I1 B0 MX", "mill 0,0 40,0\nend 40,0"));
    let project = embedding("8001.1P", ">1001.1P");
    let broken = place(&[("1001.1P", &component), ("8001.1P", &project)]);
    assert_eq!(found(&broken), ["113 1001", "511 8001"]);
    let run = broken.run("check 8001.1P.dxf --format concise --no-cache");
    assert!(run.stderr.contains("PB113") && run.stderr.contains("PB511"), "{run}");
    // The path may be missing although its drawing can be read.
    let other = component.replace("units inch\n", "").replace("1001.1P", "1002.1P");
    assert_eq!(found(&place(&[("1001-1002", &other), ("8001.1P", &project)])), ["503 8001"]);
}

#[test]
fn a_path_that_is_embedded_too_deep_harms_only_the_outermost() {
    let name = |number: usize| format!("{}.1P", 1000 + number);
    let chain = |length: usize| {
        let mut place = place(&[(&name(0), &path(&name(0), "T5 O2 I1 B0 MX", "mill 0,0 40,0\nend 40,0"))]);
        for number in 1..length {
            let drawing = embedding(&name(number), &format!(">{}", name(number - 1)));
            let dxf = pathbuild_testkit::sheet(&drawing).unwrap().to_dxf();
            place = place.file(&format!("{}.dxf", name(number)), dxf);
        }
        place
    };
    assert_eq!(found(&chain(11)), [""; 0]);
    assert_eq!(found(&chain(12)), ["508 1001"]);
}

#[test]
fn a_cycle_is_one_error_in_each_of_its_paths() {
    let ring = [("1001.1P", "1002.1P"), ("1002.1P", "1003.1P"), ("1003.1P", "1001.1P")];
    let ring: Vec<(&str, String)> =
        ring.iter().map(|(name, next)| (*name, embedding(name, &format!(">{next}")))).collect();
    let mut drawings: Vec<(&str, &str)> = ring.iter().map(|(name, text)| (*name, &**text)).collect();
    assert_eq!(found(&place(&drawings)), ["509 1001", "509 1002", "509 1003"]);
    // The error is reported only where the cycle is, not for a path that embeds it.
    let outside = embedding("8001.1P", ">1001.1P");
    drawings.push(("8001.1P", &outside));
    assert_eq!(found(&place(&drawings)), ["509 1001", "509 1002", "509 1003", "511 8001"]);
    let itself = path("1001.1P", "T5 O2 MX :B0~1", "subpath 0,0 40,0 \">1001.1P :B=B\"\nend 40,0");
    assert_eq!(found(&place(&[("1001.1P", &itself)])), ["509 1001"]);
}

#[test]
fn a_text_in_a_broken_outline_of_a_clamp_is_not_lost() {
    let clamp = |gap: &str, text: &str| {
        let cuts = path("1001.1P", "T5 O2 I1 B0 S30 MX", "mill 0,0 40,0\nend 40,0");
        let clamp = format!(
            "layer clamps\nline 0,20 30,20\nline 30,20 30,40\nline 30,40 0,40\nline 0,40 0,{gap}\ntext {text} \"Z25\"\n"
        );
        let options = format!("{OPTIONS}keep-out = \"clamps\"\n");
        found(&place(&[("1001.1P", &(cuts + &clamp))]).file("pathbuild.toml", options))
    };
    assert_eq!(clamp("20", "15,30"), [""; 0]);
    assert_eq!(clamp("20.1", "15,30"), ["117 1001"]);
    assert_eq!(clamp("20.1", "60,30"), ["117 1001", "117 1001"]);
}
