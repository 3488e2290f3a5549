//! Checks the positions of parameter texts independently, by sampling points on text circles and elements.

use pathbuild_testkit::{Entity, Shape, Sheet, sheet, text_circle};

/// Returns points on an element, so dense that no text circle fits between them.
fn samples(shape: &Shape) -> Vec<(f64, f64)> {
    let steps = (0..=2000).map(|i| f64::from(i) / 2000.0);
    match shape {
        Shape::Line(line) => {
            let (from, to) = (line.from, line.to);
            steps.map(|t| (from.x + t * (to.x - from.x), from.y + t * (to.y - from.y))).collect()
        }
        Shape::Arc(arc) => {
            let sweep = (arc.end - arc.start).rem_euclid(360.0);
            let at = |t: f64| libm::sincos((arc.start + t * sweep).to_radians());
            steps
                .map(at)
                .map(|(sin, cos)| (arc.centre.x + arc.radius * cos, arc.centre.y + arc.radius * sin))
                .collect()
        }
        // A text may also overlap a circle from inside, so sample the whole disc.
        Shape::Circle(circle) => {
            let rings = (0..=20).map(|i| circle.radius * f64::from(i) / 20.0);
            let around = |r: f64| (0..72).map(move |i| (r, libm::sincos(f64::from(i * 5).to_radians())));
            rings
                .flat_map(around)
                .map(|(r, (sin, cos))| (circle.centre.x + r * cos, circle.centre.y + r * sin))
                .collect()
        }
        _ => Vec::new(),
    }
}

fn overlapped<'a>(text: &Entity, sheet: &'a Sheet) -> Vec<&'a Entity> {
    let circle = text_circle(text).unwrap();
    let touches = |(x, y): (f64, f64)| libm::hypot(x - circle.centre.x, y - circle.centre.y) < circle.radius;
    let is_candidate =
        |entity: &&Entity| entity.line_type.as_deref() != Some("HIDDEN") && entity.layer == text.layer;
    sheet
        .entities()
        .iter()
        .filter(is_candidate)
        .filter(|entity| samples(&entity.shape).into_iter().any(touches))
        .collect()
}

fn is_text(entity: &Entity) -> bool {
    matches!(entity.shape, Shape::Text(_) | Shape::MText(_))
}

#[track_caller]
fn assert_each_text_overlaps_its_element_only(text: &str) {
    let sheet = sheet(text).unwrap();
    let entities = sheet.entities();
    let mut texts = 0;
    for (index, entity) in entities.iter().enumerate().filter(|(_, entity)| is_text(entity)) {
        let found = overlapped(entity, &sheet);
        let own = &entities[index - 1];
        assert_eq!(found, [own], "the text of line {}", entity.line);
        texts += 1;
    }
    assert!(texts > 0);
}

pub(crate) const PART: &str = r#"
layer 1234.1P
start 0,0 "T5 O3 I1 F200 M20x2"
mill 0,0 10,0 20,0 20,3 24,3 "B0 I0.5"
mark arc to 44,3 r 10 cw "D1 Q(remark)"
bars 44,3 44,20 "B0 D1 P3 U10"
sweep to 60,20 "S12"
circle 60,20 d 3 "B0"
circle 60,27 d 3 "B-0.5"
circle DIVIDE 66,20 d 8 "D1 I1"
subpath 60,20 90,20 ">1234.2P T5 O3 M20x2"
arc to 90,24 r 2 "B1"
probe 50,40 "T5 LZA"
sweep to 100,24
end 100,24
"#;

#[test]
fn a_text_overlaps_its_element_and_no_other() {
    assert_each_text_overlaps_its_element_only(PART);
    assert_each_text_overlaps_its_element_only(&format!("notes as text height 1\n{PART}"));
    assert_each_text_overlaps_its_element_only(&format!(
        "version R12\n{}",
        PART.replace("O3 M20x2\"", "O3\"")
    ));
}

#[test]
fn letters_shrink_only_where_there_is_no_room() {
    let heights = |text: &str| -> Vec<f64> {
        let sheet = sheet(text).unwrap();
        let height = |entity: &Entity| match &entity.shape {
            Shape::MText(text) => Some(text.height),
            _ => None,
        };
        sheet.entities().iter().filter_map(height).collect()
    };
    assert_eq!(heights("line 0,0 40,0 \"B0\""), [2.0]);
    assert_eq!(heights("notes height 3\nline 0,0 40,0 \"B0\""), [3.0]);
    let narrow = heights("line 0,0 1,0 \"B0\"\nline 0,0.8 1,0.8\nline 0,-0.8 1,-0.8\nline -0.1,-1 -0.1,1");
    assert!(narrow[0] < 2.0);
    let said = heights("line 0,0 1,0 \"B0\" height 2\nline 0,0.8 1,0.8\nline 0,-0.8 1,-0.8");
    assert_eq!(said, [2.0]);
}

#[test]
fn elements_of_other_layers_and_those_without_texts_are_no_obstacle() {
    let alone = sheet("layer A\nline 0,0 9,0 \"B0\"").unwrap();
    for other in ["layer B\nline 0,1 9,1", "line HIDDEN 0,1 9,1", "end 4,1", "turn 4,1", "line 0,1 9,1 paper"]
    {
        let sheet = sheet(&format!("layer A\nline 0,0 9,0 \"B0\"\n{other}")).unwrap();
        assert_eq!(sheet.entities()[1], alone.entities()[1], "{other}");
    }
    for other in ["line 0,1 9,1", "layer a\nline 0,1 9,1", "start 4,1"] {
        let sheet = sheet(&format!("layer A\nline 0,0 9,0 \"B0\"\n{other}")).unwrap();
        assert_ne!(sheet.entities()[1].shape, alone.entities()[1].shape, "{other}");
    }
}

#[test]
fn what_a_block_brings_is_an_obstacle() {
    let block = "block B\nlayer 0\nline -9,0 9,0\nendblock\nlayer A\nline 0,0 9,0 \"B0\"\n";
    let place = |rest: &str| sheet(&format!("{block}{rest}")).unwrap().entities()[1].shape.clone();
    let free = place("");
    assert_ne!(place("insert B at 4,1"), free);
    assert_ne!(place("insert B at 4,-99 rows 2 100"), free);
    assert_eq!(place("insert B at 4,99"), free);
    assert_eq!(place("insert B at 4,1 layer C"), free);
}

#[test]
fn circles_in_each_other_have_texts_in_any_order() {
    for text in
        ["circle 0,0 d 10 \"B0\"\ncircle 0,0 d 20 \"B1\"", "circle 0,0 d 20 \"B1\"\ncircle 0,0 d 10 \"B0\""]
    {
        assert!(sheet(text).is_ok());
    }
    let line_inside = "circle 0,0 d 40 \"B1\"\nline -9,0 9,0 \"B0\"";
    assert!(sheet(line_inside).is_ok(), "the circle has its own text by then");
}

#[test]
fn polylines_ellipses_and_splines_take_texts() {
    assert!(sheet("polyline 0,0 40,0 40,40 \"B0\"\nline 0,2 38,2 \"B1\"").is_ok());
    assert!(sheet("ellipse centre 0,0 major 20,0 ratio 0.5 \"B0\"").is_ok());
    assert!(sheet("spline control 0,0 10,10 20,0 30,10 \"B0\"").is_ok());
    assert!(sheet("spline fit 0,0 10,10 20,0 \"B0\"").is_ok());
}

/// The circles are those of book: language/parameter-texts, computed by hand for letters of 10 mm; a TEXT of five characters has w = 30 and h = 10.
#[test]
fn the_text_circle_follows_the_anchor() {
    let circle = |text: &str| {
        let circle = text_circle(&sheet(text).unwrap().entities()[0]).unwrap();
        [circle.centre.x, circle.centre.y, circle.radius].map(|value| libm::round(value * 1000.0) / 1000.0)
    };
    let r = 15.811;
    assert_eq!(circle("text 100,100 \"abcde\" height 10"), [115.0, 105.0, r]);
    assert_eq!(circle("text 100,100 \"abcde\" height 10 align right top"), [85.0, 95.0, r]);
    assert_eq!(circle("text 100,100 \"abcde\" height 10 align centre middle"), [100.0, 100.0, r]);
    assert_eq!(circle("text 100,100 \"abcde\" height 10 align middle top"), [100.0, 100.0, r]);
    assert_eq!(circle("text 100,100 \"abcde\" height 10 align fit 200,100"), [150.0, 105.0, r]);
    assert_eq!(circle("text 100,100 \"abcde\" height 10 rotate 90"), [95.0, 115.0, r]);
    assert_eq!(circle("text 100,100 \"abcde\" height 10 backwards"), [85.0, 105.0, r]);
    assert_eq!(circle("text 100,100 \"abcde\" height 10 mirrored"), [85.0, 105.0, r]);
    assert_eq!(circle("mtext 100,100 \"abcde\" height 10"), [115.0, 95.0, 7.0]);
    assert_eq!(
        circle("mtext 100,100 \"ab\\Pcde\\P{\\W1.1;f}\" height 10 align bottom right"),
        [91.0, 115.0, 17.493]
    );
    assert_eq!(
        circle("mtext 100,100 \"\\S1^ 2;\\~^Jb\" height 10 align middle centre"),
        [100.0, 100.0, 11.662]
    );
}
