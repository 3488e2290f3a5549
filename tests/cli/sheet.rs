//! Tests setup sheets for the machine operator. (book: program/sheet)

use std::fs;

use insta::assert_snapshot;
use serde_json::Value;

use crate::support::{self, Place, dxf};

const OPTIONS: &str = "feed = 150\nrapid = 1000\nsweep-height = 20\n";

/// Drawing of a path with four lines around a rectangle of 40 by 20 mm.
const DRAWING: &str = "layer 1234.1P\nstart 0,0 \"T2 O2 I1 B-0.2 MAl<3>&\"\nmill 0,0 40,0\nmill 40,0 40,20\n\
    mill 40,20 0,20\nmill 0,20 0,0\nend 0,0\n";

fn place(options: &str) -> Place {
    Place::new().file("pathbuild.toml", format!("{OPTIONS}{options}")).file("1234.1P.dxf", dxf(DRAWING))
}

fn library() -> Place {
    let library = support::project().join("fixtures/library");
    let copy = |place: Place, name: &str| place.file(name, fs::read(library.join(name)).unwrap());
    let place = copy(Place::new(), "pathbuild.toml");
    ["components", "projects"].into_iter().fold(place, |place, folder| {
        let names = fs::read_dir(library.join(folder)).unwrap().map(|it| it.unwrap().file_name());
        names.fold(place, |place, name| copy(place, &format!("{folder}/{}", name.to_str().unwrap())))
    })
}

/// Returns the texts of a page in order.
fn texts(svg: &str) -> Vec<&str> {
    let parts = svg.split("<text ").skip(1);
    parts.map(|part| part.split_once('>').unwrap().1.split_once("</text>").unwrap().0).collect()
}

/// Returns the value after a name in the column of facts.
fn fact<'s>(texts: &[&'s str], name: &str) -> &'s str {
    let is_axis = ["X", "Y", "Z"].contains(&name);
    let mut found = texts.iter().zip(&texts[1..]).filter(|(it, _)| **it == name);
    found
        .find(|(_, value)| !is_axis || value.contains(" to "))
        .unwrap_or_else(|| panic!("no {name} in {texts:?}"))
        .1
}

#[test]
fn every_sheet_says_what_the_program_adds_up_to() {
    let place = library();
    let listed = place.run("list --format json").stdout;
    let mut seen = 0;
    for row in listed.lines().map(|line| serde_json::from_str::<Value>(line).unwrap()) {
        let Some(name) = row["path"].as_str().or(row["name"].as_str()) else { continue };
        let run = place.run(&format!("sheet {name} -o sheet.svg"));
        if run.status != Some(0) {
            continue;
        }
        seen += 1;
        let svg = place.read("sheet.svg");
        let texts = texts(&svg);
        assert_eq!(fact(&texts, "length"), format!("{:.0} mm", row["length"].as_f64().unwrap()), "{name}");
        assert_eq!(fact(&texts, "time"), format!("{:.0} min", row["minutes"].as_f64().unwrap()), "{name}");
        for axis in ["x", "y", "z"] {
            let ends = fact(&texts, &axis.to_uppercase()).split_once(" to ").unwrap();
            let ends = [ends.0, ends.1].map(|end| end.parse::<f64>().unwrap());
            let expected = &row["cutting_box"][axis];
            for (end, index) in ends.into_iter().zip(0..) {
                let expected = expected[index].as_f64().unwrap();
                assert!((end - expected).abs() < 0.0006, "{name} {axis}: {end}, not {expected}");
            }
        }
        let low = row["cutting_box"]["z"][0].as_f64().unwrap();
        let deepest = fact(&texts, "deepest").strip_prefix("Z ").unwrap().parse::<f64>().unwrap();
        assert!((deepest - low).abs() < 0.0006, "{name}: {deepest}, not {low}");
    }
    assert!(seen > 30, "{seen} sheets only\n{listed}");
}

#[test]
fn a_page_has_picture_measures_checklist_and_facts() {
    let place = library();
    place.run("sheet 2068.1P -o sheet.svg --lang de");
    assert_snapshot!(place.read("sheet.svg"));
    place.run("sheet 8003.1P -o sheet.svg");
    assert_snapshot!(texts(&place.read("sheet.svg")).join("\n"));
}

/// Returns the texts of the sheet of a project that embeds a path twice, each time with a text. The path embeds another one.
fn sheet_of_two(components: [&str; 2]) -> String {
    let [first, second] = components;
    let project = format!(
        "layer 8001.1P\nstart 0,0 \"T2 O2 S30 MX\"\nsubpath 0,0 50,0 \"{first}\"\nsubpath 50,0 100,0 \"{second}\"\nend 100,0"
    );
    let outer = "layer 1300.1P\nstart 0,0 \"T2 O2 I1 B0 MX\"\nmill 0,0 40,0\nsubpath 40,0 50,0 \">1301.1P\"\nend 50,0";
    let inner = "layer 1301.1P\nstart 0,0 \"T2 O2 I1 B0 MX\"\nmill 0,0 10,0\nend 10,0";
    let place = place("").file("8001.1P.dxf", dxf(&project)).file("1300.1P.dxf", dxf(outer));
    let place = place.file("1301.1P.dxf", dxf(inner));
    let run = place.run("sheet 8001.1P -o sheet.svg");
    assert_eq!(run.status, Some(0), "{run}");
    texts(&place.read("sheet.svg")).join(" ")
}

/// Material on shims (H) lies higher than on the plate: without the shims, the cutter would mill air, or would not cut through.
/// Numbers tell which pieces lie on which shims, also those of paths that a raised path embeds.
#[test]
fn shims_are_in_the_checklist() {
    let sheet = sheet_of_two([">1300.1P", ">1300.1P H5"]);
    let expected = "Shims of 5 mm lie under the material of 1300.1P (No. 3, 4), whose upper face is at Z 7";
    assert!(sheet.contains(expected) && !sheet.contains("they are cut"), "{sheet}");
    let sheet = sheet_of_two([">1300.1P H1.5", ">1300.1P H5"]);
    for expected in ["Shims of 1.5 mm lie under the material of 1300.1P (No. 1, 2)", expected] {
        assert!(sheet.contains(expected), "{sheet}");
    }
    assert!(!sheet_of_two([">1300.1P", ">1300.1P"]).contains("Shims"));
}

/// The lower end of the cut is at B, above the face that raised material lies on.
#[test]
fn cuts_into_shims_are_in_the_checklist() {
    let cut = |bottom: &str| {
        let component =
            format!("layer 1300.1P\nstart 0,0 \"T2 O2 I1 B{bottom} MX\"\nmill 0,0 40,0\nend 40,0");
        let project = "layer 8001.1P\nstart 0,0 \"T2 O2 S30 MX\"\nsubpath 0,0 40,0 \">1300.1P H3\"\nend 40,0";
        let place = place("").file("8001.1P.dxf", dxf(project)).file("1300.1P.dxf", dxf(&component));
        let run = place.run("sheet 8001.1P -o sheet.svg");
        assert_eq!(run.status, Some(0), "{run}");
        texts(&place.read("sheet.svg")).join(" ")
    };
    assert!(cut("-0.2").contains("is at Z 5; they are cut 0.2 mm deep"), "{}", cut("-0.2"));
    assert!(!cut("0").contains("they are cut"), "{}", cut("0"));
}

/// Material on shims does not lie on the face where Z is 0.
#[test]
fn zero_is_under_the_shims() {
    for (components, expected) in [
        ([">1300.1P", ">1300.1P"], "on the face that the material lies on; its upper face is at Z 2"),
        ([">1300.1P", ">1300.1P H5"], "on the face under the shims; the material's upper face is at Z 2 / 7"),
        ([">1300.1P H5", ">1300.1P H5"], "on the face under the shims; the material's upper face is at Z 7"),
    ] {
        let sheet = sheet_of_two(components).replace("&#39;", "'");
        assert!(sheet.contains(&format!("Z0 is set {expected} Air run")), "{sheet}");
    }
}

/// Only the posts of controls with work offsets write G54.
#[test]
fn the_work_offset_is_that_of_the_program() {
    for (post, has_offset) in
        [("native", true), ("grbl", true), ("marlin", false), ("estlcam", false), ("din", false)]
    {
        let place = place("[tool.two]\ndiameter = 2\nspindle = 9000\n");
        let run = place.run(&format!("sheet 1234.1P --post {post} -o sheet.svg"));
        assert_eq!(run.status, Some(0), "{run}");
        let svg = place.read("sheet.svg");
        let text = texts(&svg).join(" ");
        assert_eq!(text.contains("X0 Y0 is set (G54): "), has_offset, "{post}: {text}");
        assert_eq!(text.contains("X0 Y0 is set: "), !has_offset, "{post}: {text}");
    }
}

/// One plate cannot lie at two heights.
#[test]
fn material_at_several_heights_is_several_pieces() {
    let pieces = "2 mm thick, in separate pieces for 2 heights, which cover 102 × 2 mm together";
    let plate = "2 mm thick, at least 102 × 2 mm";
    for (components, expected) in [
        ([">1300.1P", ">1300.1P H5"], pieces),
        ([">1300.1P H5", ">1300.1P H5"], plate),
        ([">1300.1P", ">1300.1P"], plate),
    ] {
        let sheet = sheet_of_two(components);
        assert!(sheet.contains(&format!("Material is ready: X, {expected}")), "{sheet}");
    }
}

/// Sheets of different thickness lie side by side if they are of different materials.
#[test]
fn all_materials_and_thicknesses_are_in_the_checklist() {
    let sheet = |outer: &str, second: &str| {
        let project = format!(
            "layer 8001.1P\nstart 0,0 \"{outer} O2 S30\"\nsubpath 0,0 40,0 \">1300.1P T3 MX\"\nsubpath 40,0 80,0 \">1301.1P {second}\"\nend 80,0"
        );
        let component = |name: &str, text: &str| {
            dxf(&format!("layer {name}\nstart 0,0 \"{text} O2 I1 B0\"\nmill 0,0 40,0\nend 40,0"))
        };
        let place = place("").file("8001.1P.dxf", dxf(&project));
        let place = place.file("1300.1P.dxf", component("1300.1P", "T3 MX"));
        let place = place.file("1301.1P.dxf", component("1301.1P", second));
        let run = place.run("sheet 8001.1P -o sheet.svg");
        assert_eq!(run.status, Some(0), "{run}");
        texts(&place.read("sheet.svg")).join(" ")
    };
    let found = sheet("T3 MX", "T2 MY");
    let expected = "Material is ready: X, 3 mm thick; Y, 2 mm thick, in separate pieces for 2 heights";
    assert!(found.contains(expected) && found.contains("its upper face is at Z 2 / 3"), "{found}");
    let found = sheet("T3 MX", "T3 MY");
    let expected = "X, 3 mm thick; Y, 3 mm thick, in separate pieces, which cover 82 × 2 mm together";
    assert!(found.contains(expected) && found.contains("X / Y"), "{found}");
    let found = sheet("T3 MX", "T3 MX");
    assert!(found.contains("Material is ready: X, 3 mm thick, at least 82 × 2 mm"), "{found}");
    // Without M, the project does not say that the sheets are different ones: that is a warning.
    let found = sheet("T3", "T2 MX");
    assert!(found.contains("Material is ready: X, 2 / 3 mm thick"), "{found}");
}

/// The sheet follows the program, which drills a circle whose diameter differs from the cutter's by at most 0.001 mm.
#[test]
fn a_circle_is_drilled_on_the_sheet_as_in_the_program() {
    for (diameter, work) in [("4.001", "drilling Ø 4.001"), ("4.002", "milling: circle Ø 4.002")] {
        let drawn = format!(
            "layer 1234.1P\nstart 0,0 \"T5 O4 I1 B0 F100\"\nsweep 0,0 20,0\ncircle 20,0 d {diameter}\nend 20,0\n"
        );
        let place = Place::new().file("1234.1P.dxf", dxf(&drawn));
        let run = place.run("sheet 1234.1P -o sheet.svg --feed 100 --rapid 1000 --sweep-height 9");
        assert_eq!(run.status, Some(0), "{run}");
        assert!(texts(&place.read("sheet.svg")).contains(&work), "{diameter}");
    }
}

/// Each number of the picture is explained, or listed as one that does not fit. A table that continues on a new page repeats its title.
#[test]
fn operations_are_listed_and_no_number_is_lost() {
    let place = library();
    place.run("view 8001.1P -o x.json --no-cache");
    let scene: Value = serde_json::from_str(&place.read("x.json")).unwrap();
    let elements = scene["paths"][0]["elements"].as_array().unwrap();
    let mut numbers: Vec<u64> = elements.iter().filter_map(|element| element["order"].as_u64()).collect();
    numbers.sort_unstable();
    place.run("sheet 8001.1P -o sheet.svg");
    let svg = place.read("sheet.svg");
    let picture = svg.split_once("id=\"order\"").unwrap().1.split_once("</g>").unwrap().0;
    let drawn: Vec<u64> = texts(picture).iter().map(|text| text.parse().unwrap()).collect();
    let all = texts(&svg);
    let ranges = |text: &str| -> Vec<u64> {
        let range = |range: &str| {
            let (first, last) = range.split_once('–').unwrap_or((range, range));
            Some(first.parse().ok()?..=last.parse().ok()?)
        };
        text.split(", ").filter_map(range).flatten().collect()
    };
    let hidden =
        all.iter().find_map(|text| text.strip_prefix("no room for: ")).map(ranges).unwrap_or_default();
    let mut found = [drawn, hidden].concat();
    found.sort_unstable();
    assert_eq!(found, numbers);
    let head = all.iter().position(|text| *text == "down to").unwrap();
    let end = all.iter().position(|text| *text == "Embedded paths").unwrap();
    let listed: Vec<u64> = all[head + 1..end].iter().flat_map(|text| ranges(text)).collect();
    assert_eq!(listed, numbers, "{all:?}");
    assert!(all.contains(&"drilling Ø 2") && all.contains(&"milling with support bars"), "{all:?}");
    assert!(
        all.contains(&"Operations (continued)") || all.contains(&"Embedded paths (continued)"),
        "{all:?}"
    );
    assert_eq!(fact(&all, "rapid across"), "Z 4 / 15");
}

/// A long path is rotated on a separate page; a small one is enlarged beside its picture at full size.
#[test]
fn long_and_small_ones_are_seen() {
    for (name, drawing) in [
        ("long", "mill 0,0 200,0\nmill 200,0 200,20\nend 200,20\n"),
        ("small", "mill 0,0 9,0\nsweep 9,0 4,5\nmill circle 4,5 d 2\nsweep 4,5 9,9\nend 9,9\n"),
    ] {
        let drawing = format!("layer 1234.1P\nstart 0,0 \"T2 O2 I1 B0\"\n{drawing}");
        let place = Place::new().file("pathbuild.toml", OPTIONS).file("1234.1P.dxf", dxf(&drawing));
        place.run("sheet 1234.1P -o sheet.svg");
        let svg = place.read("sheet.svg");
        let pictures =
            svg.split("id=\"drawing\"").skip(1).map(|text| text.split_once("id=\"legend\"").unwrap().0);
        assert_snapshot!(name, pictures.collect::<Vec<_>>().join("\n\n"));
    }
}

#[test]
fn what_a_drawing_says_is_no_markup() {
    let place = place("");
    for file in ["sheet.svg", "sheet.html"] {
        let run = place.run(&format!("sheet 1234.1P -o {file}"));
        assert_eq!(run.status, Some(0), "{run}");
        let text = place.read(file);
        assert!(text.contains("Al&lt;3&gt;&amp;") && !text.contains("<3>"), "{text}");
    }
    let html = place.read("sheet.html");
    assert!(html.contains("default-src 'none'") && !html.contains("http://www.w3.org/1999/xlink"));
}

#[test]
#[cfg(feature = "pictures")]
fn a_pdf_has_all_pages_with_letters_and_the_same_bytes_each_time() {
    let place = library();
    let made = ["a.pdf", "b.pdf"].map(|file| {
        let run = place.run(&format!("sheet 8003.1P --lang de -o {file}"));
        assert_eq!((run.status, run.stderr.as_str()), (Some(0), &*format!("{file}: geschrieben\n")), "{run}");
        fs::read(place.path().join(file)).unwrap()
    });
    assert!(made[0] == made[1], "not the same bytes");
    let text = String::from_utf8_lossy(&made[0]);
    assert_eq!(text.matches("/MediaBox [0 0 595.27563 841.8898]").count(), 3, "pages");
    assert_eq!(text.matches("/FontFile2").count(), 1, "fonts");
    assert!(text.contains("DejaVuSans") && text.contains("/ToUnicode"));
    assert!(text.contains("\nPath 8003.1P, drawing 8003.1P.dxf\n"));
}

/// Tests a drawn circle of 52 mm: the PDF contains the circle that the axis of the cutter describes inside it, and the ruler at the foot of
/// the page.
#[test]
#[cfg(feature = "pictures")]
fn a_pdf_is_true_to_scale() {
    let drawing = "layer 1234.1P\nstart 0,0 \"T2 O2 I1 B0 A60\"\nsweep 0,0 30,30\nmill circle 30,30 d 52\nsweep 30,30 60,0\nend 60,0\n";
    let place = Place::new().file("pathbuild.toml", OPTIONS).file("1234.1P.dxf", dxf(drawing));
    let run = place.run("sheet 1234.1P -o sheet.pdf");
    assert_eq!(run.status, Some(0), "{run}");
    let extents = drawn_extents(&fs::read(place.path().join("sheet.pdf")).unwrap());
    let has = |size: [f64; 2]| {
        extents.iter().any(|extent| (0..2).all(|axis| (extent[axis] - size[axis]).abs() < 0.01))
    };
    assert!(has([50.0, 50.0]), "no circle in {extents:?}");
    assert!(has([52.0, 52.0]), "no rectangle around the removed material in {extents:?}");
    assert!(has([50.0, 8.0 / 3.0]), "no ruler in {extents:?}");
}

/// Returns width and height in mm of every path that the first page of a PDF draws, by the ends of its segments.
#[cfg(feature = "pictures")]
fn drawn_extents(pdf: &[u8]) -> Vec<[f64; 2]> {
    const MM_PER_POINT: f64 = 25.4 / 72.0;
    let (mut transforms, mut transform) = (Vec::new(), [1.0, 0.0, 0.0, 1.0, 0.0, 0.0]);
    let (mut numbers, mut points, mut extents) = (Vec::new(), Vec::new(), Vec::new());
    for word in first_content(pdf).split_ascii_whitespace() {
        match word {
            "q" => transforms.push(transform),
            "Q" => transform = transforms.pop().expect("q and Q match"),
            "cm" => transform = product(numbers[..6].try_into().unwrap(), transform),
            "m" | "l" | "c" => {
                let [x, y]: [f64; 2] = numbers[numbers.len() - 2..].try_into().unwrap();
                let [a, b, c, d, e, f] = transform;
                points.push([a * x + c * y + e, b * x + d * y + f].map(|points| points * MM_PER_POINT));
            }
            "S" | "f" | "n" => {
                let extent = |axis: usize| {
                    let values = points.iter().map(|point: &[f64; 2]| point[axis]);
                    values.clone().fold(f64::MIN, f64::max) - values.fold(f64::MAX, f64::min)
                };
                extents.push([extent(0), extent(1)]);
                points.clear();
            }
            _ => {}
        }
        match word.parse::<f64>() {
            Ok(number) => numbers.push(number),
            Err(_) => numbers.clear(),
        }
    }
    extents
}

/// Returns the drawing instructions of the first page, which are the first stream that begins with a transform.
#[cfg(feature = "pictures")]
fn first_content(pdf: &[u8]) -> String {
    use std::io::Read;

    let starts =
        pdf.windows(8).enumerate().filter(|(_, window)| window == b"\nstream\n").map(|(at, _)| at + 8);
    let inflated = |at: usize| {
        let mut text = String::new();
        flate2::read::ZlibDecoder::new(&pdf[at..]).read_to_string(&mut text).ok().map(|_| text)
    };
    starts
        .filter_map(inflated)
        .find(|text| text.lines().next().is_some_and(|line| line.ends_with(" cm")))
        .unwrap()
}

/// Returns the transform that applies `first` and then `second`.
#[cfg(feature = "pictures")]
fn product(first: [f64; 6], second: [f64; 6]) -> [f64; 6] {
    let ([a, b, c, d, e, f], [g, h, i, j, k, l]) = (first, second);
    [a * g + b * i, a * h + b * j, c * g + d * i, c * h + d * j, e * g + f * i + k, e * h + f * j + l]
}

#[test]
fn the_scale_is_true_where_the_paper_holds_it_and_else_round() {
    let scale = |width: u32| {
        let drawing = format!(
            "layer 1234.1P\nstart 0,0 \"T2 O2 I1 B0\"\nmill 0,0 {width},0\nmill {width},0 {width},20\nend {width},20\n"
        );
        let place = Place::new().file("pathbuild.toml", OPTIONS).file("1234.1P.dxf", dxf(&drawing));
        place.run("sheet 1234.1P -o sheet.svg");
        let svg = place.read("sheet.svg");
        let scales = texts(&svg).into_iter().filter_map(|it| it.strip_prefix("scale "));
        scales.map(str::to_owned).collect::<Vec<_>>()
    };
    // A length of 150 mm fits on the first page, and one of 223 mm on a rotated page.
    assert_eq!(scale(40), ["2:1"]);
    assert_eq!(scale(100), ["1:1"]);
    assert_eq!(scale(148), ["1:1"]);
    assert_eq!(scale(155), ["1:2", "1:1"]);
    assert_eq!(scale(220), ["1:2", "1:1"]);
    assert_eq!(scale(228), ["1:2"]);
    assert_eq!(scale(700), ["1:5", "1:5"][..1]);
}

/// `output-size` limits all files of a program: written files are current, and nothing is written if the program cannot be compared.
#[test]
fn what_belongs_to_a_program_is_limited_too() {
    let probes = (0..100).map(|index| format!("probe {index},30\n")).collect::<Vec<_>>().concat();
    for (sheet, drawing, file) in [
        ("html", DRAWING.to_owned(), "1234.1P_Sheet.html"),
        ("svg", DRAWING.to_owned(), "1234.1P_Sheet.svg"),
        ("pdf", DRAWING.to_owned(), "1234.1P_Sheet.pdf"),
        ("none", format!("{DRAWING}{probes}"), "1234.1P_Probing.gcode"),
    ] {
        let sheet = if sheet == "none" { String::new() } else { format!("[emit]\nsheet = \"{sheet}\"\n") };
        let place = |limits: &str| {
            let place = place(&format!("probe-feed = 40\n{sheet}{limits}"));
            place.file("1234.1P.dxf", dxf(&drawing))
        };
        let whole = place("");
        let run = whole.run("emit 1234.1P");
        assert_eq!(run.status, Some(0), "{run}");
        let size = whole.path().join(file).metadata().unwrap().len();
        let inside = place(&format!("[limits]\noutput-size = {size}\n"));
        for command in ["emit 1234.1P", "emit 1234.1P --check", "emit 1234.1P --check --no-cache"] {
            let run = inside.run(command);
            assert_eq!(run.status, Some(0), "{file}: {run}");
        }
        let outside = place(&format!("[limits]\noutput-size = {}\n", size - 1));
        let run = outside.run("emit 1234.1P");
        assert!(run.status == Some(1) && run.stderr.contains("PB005") && run.stderr.contains(file), "{run}");
        let programs = fs::read_dir(outside.path()).unwrap().map(|entry| entry.unwrap().file_name());
        assert_eq!(programs.filter(|name| name.to_string_lossy().contains('_')).count(), 0, "{run}");
    }
}

#[test]
fn a_sheet_is_of_one_path_without_errors() {
    let drawing = DRAWING.replace("mill 0,20 0,0\n", "");
    let place = place("").file("1235.1P.dxf", dxf(&drawing.replace("1234.1P", "1235.1P")));
    let run = place.run("sheet 1235.1P -o sheet.svg");
    assert!(run.status == Some(1) && run.stderr.contains("[PB403]"), "{run}");
    let run = place.run("sheet . -o sheet.svg");
    assert!(run.status == Some(2) && run.stderr.contains("a setup sheet shows a single path"), "{run}");
    let run = place.run("sheet 1234.1P -o sheet.txt");
    assert!(run.status == Some(2) && run.stderr.contains("must end in .pdf, .html or .svg"), "{run}");
    assert!(!place.path().join("sheet.svg").exists());
    let run = Place::new().file("1234.1P.dxf", dxf(DRAWING)).run("sheet 1234.1P -o sheet.svg");
    assert!(run.status == Some(2) && run.stderr.contains("the sweep height in mm"), "{run}");
}

#[test]
fn emit_writes_sheets_and_keeps_them_current() {
    let place = place("lang = \"de\"\n[emit]\nsheet = \"html\"\n");
    let emit = |rest: &str| place.run(&format!("emit . --lang en{rest}"));
    let sheet = place.path().join("1234.1P_Sheet.html");
    let first = emit("");
    assert!(first.stderr.contains("1234.1P_Sheet.html: written"), "{first}");
    // For every user, the sheet is in the language of comments in programs.
    let text = place.read("1234.1P_Sheet.html");
    assert!(text.contains("Vor dem Start"), "{text}");
    place.run("sheet 1234.1P -o own.html --lang de");
    assert_eq!(place.read("own.html"), text);
    assert!(emit("").stderr.contains("1234.1P_Sheet.html: unchanged"));
    assert_eq!(emit(" --check").status, Some(0));
    fs::remove_file(&sheet).unwrap();
    let run = emit(" --check");
    assert!(run.status == Some(1) && run.stdout.contains("1234.1P_Sheet.html: missing"), "{run}");
    assert_eq!(emit(" --check --moves").status, Some(0));
    assert!(emit("").stderr.contains("1234.1P_Sheet.html: written"));
    fs::write(&sheet, text.replace("2 mm", "3 mm")).unwrap();
    let run = emit(" --check");
    assert!(run.status == Some(1) && run.stdout.contains("1234.1P_Sheet.html: not current"), "{run}");
    assert!(emit("").stderr.contains("1234.1P_Sheet.html: written"));
    assert_eq!(place.read("1234.1P_Sheet.html"), text);
    let printed = place.run("emit 1234.1P -o -");
    assert!(printed.status == Some(0) && !printed.stdout.contains("<svg"), "{printed}");
}

#[test]
fn a_sheet_changes_with_its_drawing_and_is_stale_without_its_key() {
    let place = place("[emit]\nsheet = \"svg\"\n");
    place.run("emit .");
    let before = place.read("1234.1P_Sheet.svg");
    let place = place.file("1234.1P.dxf", dxf(&DRAWING.replace("B-0.2", "B-0.3")));
    let run = place.run("emit . --check");
    assert!(run.stdout.contains("1234.1P_Sheet.svg: not current"), "{run}");
    place.run("emit .");
    assert_ne!(place.read("1234.1P_Sheet.svg"), before);
    let place = place.file("pathbuild.toml", OPTIONS);
    for inputs in [".", "1234.1P"] {
        let run = place.run(&format!("emit {inputs}"));
        assert!(run.stderr.contains("PB520") && run.stderr.contains("1234.1P_Sheet.svg"), "{run}");
    }
    place.run("emit . --remove-stale");
    assert!(!place.path().join("1234.1P_Sheet.svg").exists());
}

#[test]
fn another_version_of_pathbuild_makes_no_sheet_outdated() {
    let place = place("[emit]\nsheet = \"svg\"\n");
    place.run("emit .");
    let sheet = place.path().join("1234.1P_Sheet.svg");
    let version = format!("pathbuild {}", env!("CARGO_PKG_VERSION"));
    let older = place.read("1234.1P_Sheet.svg").replace(&version, "pathbuild 0.0.9");
    fs::write(&sheet, &older).unwrap();
    let run = place.run("emit . --check");
    assert_eq!(run.status, Some(0), "{run}");
    assert!(older.contains("pathbuild 0.0.9"));
}

/// Paths with two cutters, which are configured.
fn place_with_two_cutters() -> Place {
    let second = DRAWING.replace("1234.1P", "1235.1P").replace("O2", "O3");
    let tools = "spindle = \"tool\"\n[emit]\nsheet = \"svg\"\n[tool.two]\ndiameter = 2\nspindle = 12000\nnumber = 1\nflutes = 2\nlength = 8\n[tool.three]\ndiameter = 3\nspindle = 9000\nnumber = 4\n";
    place(tools)
        .file("1235.1P.dxf", dxf(&second))
        .file("1236.1P.dxf", dxf(&DRAWING.replace("1234.1P", "1236.1P")))
}

/// A control without a tool changer and tool lengths starts with the cutter that is in, and needs a new Z0 after each change.
#[test]
fn the_sheet_tells_of_changes_by_hand() {
    let place = place_with_two_cutters();
    for (post, has_manual_changes) in
        [("grbl", true), ("marlin", true), ("estlcam", true), ("linuxcnc", false), ("mach3", false)]
    {
        for (paths, first, changes) in [
            ("1235.1P 1234.1P", "T4 Ø 3 mm (three), 9000 rpm", "(1): T1 Ø 2 mm (two);"),
            (
                "1234.1P 1235.1P 1236.1P",
                "T1 Ø 2 mm (two), 2 flutes",
                "(2): T4 Ø 3 mm (three), T1 Ø 2 mm (two);",
            ),
        ] {
            place.run(&format!("emit {paths} --post {post} --join all"));
            let svg = place.read("all_Sheet.svg");
            let text = texts(&svg).join(" ");
            assert_eq!(
                text.contains(&format!("First cutter is in and sharp: {first}")),
                has_manual_changes,
                "{text}"
            );
            let changes = format!("changes of the cutter by hand {changes} Z0 is set again after each");
            assert_eq!(text.contains(&changes), has_manual_changes, "{text}");
            assert_eq!(
                text.contains("Cutters (2) are in the places of the table"),
                !has_manual_changes,
                "{text}"
            );
        }
        place.run(&format!("emit 1234.1P 1236.1P --post {post} --join all"));
        let svg = place.read("all_Sheet.svg");
        let text = texts(&svg).join(" ");
        assert!(text.contains("Cutter is in and sharp: T1") && !text.contains("by hand"), "{text}");
    }
}

#[test]
fn joined_paths_have_one_sheet_with_all_cutters() {
    let place = place_with_two_cutters();
    let run = place.run("emit 1234.1P 1235.1P --post linuxcnc --join both");
    assert!(run.stderr.contains("both_Sheet.svg: written"), "{run}");
    let svg = place.read("both_Sheet.svg");
    let texts = texts(&svg);
    for text in [
        "two",
        "three",
        "2 flutes, cuts 8 mm deep",
        "12000 rpm clockwise",
        "9000 rpm clockwise",
        "1234.1P",
        "1235.1P",
    ] {
        assert!(texts.contains(&text), "{text} in {texts:?}");
    }
    assert!(!svg.contains("started by hand"));
    // Numbers are unique in the picture of all paths.
    for row in [["1–4", "1234.1P", "milling", "Z -0.2", "T1"], ["5–8", "1235.1P", "milling", "Z -0.2", "T4"]]
    {
        assert!(texts.windows(5).any(|cells| cells == row), "{row:?} in {texts:?}");
    }
}

/// A title is on the page of the first row of its table, however high that row is.
#[test]
fn no_title_of_a_table_stands_alone() {
    let place = place_with_two_cutters();
    let configuration = place.read("pathbuild.toml");
    for letters in (2..44).step_by(3) {
        let name = format!("[tool.{}]", "two-".repeat(letters));
        fs::write(place.path().join("pathbuild.toml"), configuration.replace("[tool.two]", &name)).unwrap();
        place.run("emit 1234.1P 1235.1P --post linuxcnc --join both");
        let svg = place.read("both_Sheet.svg");
        let texts = texts(&svg);
        assert!(texts.windows(2).any(|pair| pair == ["Cutters", "T"]), "{letters}: {texts:?}");
    }
}

/// The positions of clamps are relative to the program's zero, which is the path's start.
#[test]
fn clamps_are_listed_from_the_start() {
    let drawing = "layer 1234.1P\nstart 100,50 \"T2 O2 I1 B0\"\nmill 100,50 140,50\nend 140,50\n\
        layer clamps\npolyline 120,60 130,60 130,75 120,75 closed\ntext 121,64 \"Z20\"\n";
    let place = Place::new()
        .file("pathbuild.toml", format!("{OPTIONS}keep-out = 'clamps'\n"))
        .file("1234.1P.dxf", dxf(drawing));
    let run = place.run("sheet 1234.1P -o sheet.svg");
    let svg = place.read("sheet.svg");
    let texts = texts(&svg);
    let row = texts.windows(4).any(|row| row == ["clamps", "20 to 30", "10 to 25", "20"]);
    assert!(row, "{texts:?} {run}");
}

/// The rapid move that raises the tool onto a bar is considered as well.
#[test]
fn the_lowest_rapid_may_be_one_that_rises() {
    let drawing = "layer 1234.1P\nstart 0,20 \"T5 O3 I2 B0.5 D2 P6 U30\"\nmill 0,20 300,20\n\
                   bars 300,20 300,120\nend 300,120\n";
    let place = Place::new().file("pathbuild.toml", OPTIONS).file("1234.1P.dxf", dxf(drawing));
    assert_eq!(place.run("emit 1234.1P").status, Some(0));
    let program = place.read("1234.1P_Milling.gcode");
    let heights = program.lines().filter_map(|line| line.strip_prefix("G00 Z")?.parse::<f64>().ok());
    assert_eq!(heights.reduce(f64::min), Some(2.0));
    assert_eq!(place.run("sheet 1234.1P -o sheet.svg").status, Some(0));
    assert_eq!(fact(&texts(&place.read("sheet.svg")), "lowest rapid"), "Z 2");
}
