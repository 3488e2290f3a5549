//! Reads the files with our own reader, which shares no code with the test kit's writer.

use pathbuild_dxf::{Drawing, Geometry, Options, Point3, Units, read};
use pathbuild_path::{Language, RawPath, raw_file};
use pathbuild_testkit::model::{Direction, Horizontal};
use pathbuild_testkit::{Entity, Point, Shape, Sheet, Version, sheet};

use crate::placement::PART;

pub(crate) fn drawing(bytes: &[u8]) -> Drawing {
    read(
        bytes,
        &Options {
            keep_layer: &|_| true,
            note_text: None,
            units: Units::Header,
            approximate_curves: 0.0,
            max_entities: 100_000,
            max_text: 65_536,
            compatible: false,
        },
    )
}

pub(crate) fn language() -> Language {
    Language {
        path_pattern: pathbuild_path::PathPattern::default(),
        keep_out: None,
        part: None,
        line_types: pathbuild_path::LineTypeAliases::default(),
        join_tolerance: 0.0,
        text_limit: 65_536,
        doubts: pathbuild_path::DoubtThresholds::default(),
        tools: pathbuild_path::PathTools::default(),
    }
}

const SHAPES: &str = r#"
layer "Länge 1" DASHED
line 1,2,3 4.5,-6,7
line BYLAYER 1,2 3,4 mirrored
arc centre 10,5 r 5 from 20 to 60
arc centre 10,5 r 5 from 20 to 60 mirrored z 2
circle 7,8 d 9
circle 7,8 d 9 mirrored
text 1,2 "T3\PO2 größe %%c" height 3 rotate 30
text 1,2 "x" align right top
text 0,0 "x" align centre
text 5,6 "x" align middle
text 5,6 "x" rotate 20 mirrored
text 5,6 "x" backwards upside-down
polyline 0,0 10,0 bulge 0.5 10,10 closed
polyline heavy 0,0 10,0 bulge -0.5 10,10 mirrored
block B base 1,1
line 1,1 3,1
arc centre 1,1 r 2 from 0 to 90
endblock
insert B at 20,30 scale 2,-2 rotate 90
"#;

const MTEXTS: &str = r#"
mtext 1,2 "T3\PO2 größe \S1^ 2; \~" height 3 align bottom right rotate 45
mtext 1,2 "abcdefghij" chunks 3 direction 0,1
"#;

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-9
}

fn is_at(read: Point3, drawn: Point) -> bool {
    close(read.x, drawn.x) && close(read.y, drawn.y) && close(read.z, drawn.z)
}

fn is_same_angle(a: f64, b: f64) -> bool {
    let turn = (a - b).rem_euclid(360.0);
    turn.min(360.0 - turn) < 1e-9
}

/// Whether an entity that was read matches the drawn one.
fn agrees(read: &Geometry, drawn: &Entity) -> bool {
    match (read, &drawn.shape) {
        (Geometry::Line(read), Shape::Line(line)) => is_at(read.start, line.from) && is_at(read.end, line.to),
        (Geometry::Circle(read), Shape::Circle(circle)) => {
            is_at(read.centre, circle.centre) && close(read.radius, circle.radius)
        }
        (Geometry::Arc(read), Shape::Arc(arc)) => {
            let (start, end) = if read.clockwise { (arc.end, arc.start) } else { (arc.start, arc.end) };
            is_at(read.centre, arc.centre)
                && close(read.radius, arc.radius)
                && is_same_angle(read.start_angle, start)
                && is_same_angle(read.end_angle, end)
        }
        (Geometry::Text(read), Shape::Text(text)) => {
            let mirrored = drawn.orientation == pathbuild_testkit::model::Orientation::Mirrored;
            *read.string == text.value
                && (is_at(read.anchor, text.anchor) || matches!(text.horizontal, Horizontal::Fit(_)))
                && close(read.height, text.height)
                && is_same_angle(read.rotation, text.rotation)
                && read.backwards == (text.backwards != mirrored)
                && read.upside_down == text.upside_down
        }
        (Geometry::MText(read), Shape::MText(text)) => {
            let rotation = match text.direction {
                Direction::Rotation(degrees) => degrees,
                Direction::Vector(vector) => Point::default().direction(vector),
            };
            *read.plain == without_formatting(&text.value)
                && is_at(read.anchor, text.anchor)
                && close(read.height, text.height)
                && is_same_angle(read.rotation, rotation)
        }
        _ => false,
    }
}

/// Returns the plain text of the texts that these tests draw.
fn without_formatting(text: &str) -> String {
    text.replace("\\P", "\n").replace("\\S1^ 2;", "12").replace("\\~", "\u{a0}")
}

/// Returns the sheets of a drawing for each version of DXF and each form of its files, with the options that choose them.
fn written(text: &str) -> Vec<(String, Sheet)> {
    let options =
        ["", "binary\n", "lineends lf\n", "lineends cr\n", "bom\n", "encoding utf-8\n", "encoding escaped\n"];
    let all = Version::ALL.into_iter().flat_map(|version| options.map(|option| (version, option)));
    all.map(|(version, option)| {
        let mtexts = if version < Version::R13 { "" } else { MTEXTS };
        let options = format!("version {}\n{option}", version.name());
        let sheet = sheet(&format!("{options}{text}{mtexts}")).unwrap();
        (options, sheet)
    })
    .collect()
}

#[test]
fn every_entity_is_read_as_it_was_drawn() {
    for (options, sheet) in written(SHAPES) {
        let found = drawing(&sheet.to_dxf());
        assert_eq!(found.diagnostics, [], "{options}");
        assert!(found.faults.is_empty() && found.left_out.is_empty(), "{options}");
        let simple = |entity: &&Entity| !matches!(entity.shape, Shape::Polyline(_) | Shape::Insert(_));
        for drawn in sheet.entities().iter().filter(simple) {
            let at = found.origins.iter().position(|origin| origin.handle == drawn.handle).unwrap();
            let read = &found.entities[at];
            assert!(agrees(&read.geometry, drawn), "{options}{:?}\n{:?}", read.geometry, drawn.shape);
            assert_eq!(*found.layers[read.layer as usize].name, *"Länge 1", "{options}");
        }
    }
}

#[test]
fn polylines_and_blocks_are_read_as_their_parts() {
    let parts = |found: &Drawing| -> Vec<Geometry> {
        let from_parts = |(entity, _): &(&pathbuild_dxf::Entity, _)| {
            matches!(entity.kind.name(), "LWPOLYLINE" | "POLYLINE" | "INSERT") || entity.group.is_some()
        };
        let all = found.entities.iter().zip(&found.origins).filter(from_parts);
        all.map(|(entity, _)| entity.geometry.clone()).collect()
    };
    let reference = parts(&drawing(&sheet(SHAPES).unwrap().to_dxf()));
    assert!(reference.len() >= 5, "{reference:?}");
    for (options, sheet) in written(SHAPES) {
        let found = parts(&drawing(&sheet.to_dxf()));
        assert_eq!(found.len(), reference.len(), "{options}");
        assert!(
            format!("{found:.6?}") == format!("{reference:.6?}"),
            "{options}{found:.6?}\n{reference:.6?}"
        );
    }
}

/// Returns the texts that were read for a path's start and elements, in the order of the path.
fn texts_found(path: &RawPath) -> Vec<String> {
    let text = |index| path.drawn.text(index).map(|text| text.as_str().to_owned()).unwrap_or_default();
    let markers = path.start.iter().chain(&path.probes).map(|marker| text(marker.text));
    markers.chain(path.drawn.elements.iter().map(|element| text(element.text))).collect()
}

/// Returns the texts of a sheet in the order of [`texts_found`]: markers first, then elements.
fn texts_drawn(sheet: &Sheet) -> Vec<String> {
    let note = |entity: &Entity| entity.note.as_ref().map_or(String::new(), |note| note.value.clone());
    let special = |diameter: f64| move |entity: &&Entity| matches!(&entity.shape, Shape::Circle(circle) if close(circle.radius * 2.0, diameter) && entity.line_type.as_deref() == Some("PHANTOM"));
    let is_circle = |entity: &&Entity| {
        matches!(entity.shape, Shape::Circle(_)) && entity.line_type.as_deref() != Some("PHANTOM")
    };
    let is_line = |entity: &&Entity| matches!(entity.shape, Shape::Line(_));
    let is_arc = |entity: &&Entity| matches!(entity.shape, Shape::Arc(_));
    let all = || sheet.entities().iter();
    let markers = all().filter(special(1.0)).chain(all().filter(special(6.0)));
    let elements = all().filter(is_circle).chain(all().filter(is_line)).chain(all().filter(is_arc));
    markers.chain(elements).map(note).collect()
}

#[test]
fn each_text_goes_to_the_element_it_was_drawn_with() {
    for options in ["", "notes as text height 1\n", "version R12\n", "binary\nversion R2018\n"] {
        let sheet = sheet(&format!("{options}{PART}")).unwrap();
        let file = raw_file(&drawing(&sheet.to_dxf()), &language());
        let (path, _) = &file.paths[0];
        assert_eq!(path.diagnostics, [], "{options}");
        assert_eq!(texts_found(path), texts_drawn(&sheet), "{options}");
    }
}

#[test]
fn text_circles_are_those_of_the_reader() {
    for (options, sheet) in written(SHAPES) {
        let found = drawing(&sheet.to_dxf());
        for drawn in sheet.entities() {
            let Some(circle) = pathbuild_testkit::text_circle(drawn) else { continue };
            let at = found.origins.iter().position(|origin| origin.handle == drawn.handle).unwrap();
            let read = match &found.entities[at].geometry {
                Geometry::Text(text) => pathbuild_path::TextCircle::of_text(text),
                Geometry::MText(text) => pathbuild_path::TextCircle::of_mtext(text),
                other => panic!("{other:?}"),
            };
            assert!(
                close(read.centre.x, circle.centre.x) && close(read.centre.y, circle.centre.y),
                "{options}{drawn:?}"
            );
            assert!(close(read.radius, circle.radius), "{options}{drawn:?}");
        }
    }
}
