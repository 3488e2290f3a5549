//! Tests that no definition causes panics, hangs or unbounded growth.

use camino::Utf8Path;
use pathbuild_motion::Turning;
use pathbuild_post::{HoleKind, Job, JobStep, PostDefinition, PostMacro, PostOptions};
use proptest::prelude::*;

use crate::support::{arc, definition, feed, job, rapid};

/// Returns a program with every kind of move.
fn program() -> Job {
    let arc = arc(true, [10.0, 0.0, -1.0], [0.0; 2], [10.0, 0.0, -2.0], Some(100.0));
    let hole = pathbuild_post::Hole {
        at: [1.0, 2.0],
        level: 5.0,
        retract: 1.0,
        bottom: -3.0,
        exit: 5.0,
        feed: None,
        kind: HoleKind::Peck { depth: 1.0 },
    };
    let mut job = job(vec![
        rapid(10.0, 0.0, 5.0),
        feed(10.0, 0.0, -1.0),
        arc,
        JobStep::Hole(hole),
        JobStep::Comment("{$x} ~X1~ )".into()),
        JobStep::Dwell { seconds: 1.0 },
    ]);
    job.operations[0].spindle = Some(Turning::Clockwise);
    job
}

/// Generates templates from valid parts and parts that break them.
fn template() -> impl Strategy<Value = String> {
    let pieces = prop::sample::select(vec![
        "{$x}",
        "{$_y}",
        "{$-z}",
        "{$g1}",
        "{$_g81}",
        "{$blocks}",
        "{$mops}",
        "{$header}",
        "{$toolchange}",
        "{$clearance}",
        "{$check(1,2,3)}",
        "{$check(x,,-9)}",
        "{$set(z,NaN)}",
        "$set(x,1)",
        "{$a}",
        "{$b}",
        "{$date}",
        "{$tool.name}",
        "{$arc.radius}",
        "G91 ",
        "G53 ",
        "G28 ",
        "T1 M6",
        "Z-3 ",
        "(",
        ")",
        "\n",
        " ",
        "{$",
        "}",
        "%",
        "ä",
        "G81 ",
        "R2 ",
    ]);
    prop::collection::vec(pieces, 0..12).prop_map(|pieces| pieces.concat())
}

/// Generates control texts from valid parts and parts that break them.
fn control_text() -> impl Strategy<Value = String> {
    let pieces = prop::sample::select(vec![
        "{",
        "}",
        "{=Q1",
        "{?",
        "{!Q1",
        "{\"",
        "{$",
        "{*",
        "{.",
        "{#",
        "{02d ",
        "~X1~",
        "~Q1~",
        "~Q2~",
        "~",
        "\\",
        "\\\\\\~1B",
        "\\\\\\~*a*",
        "1",
        "+",
        "-",
        "*",
        "/",
        "^^",
        "&",
        "&&",
        "(",
        ")",
        "sin(",
        ",",
        " ",
        "\n",
        "ä",
        "§",
        "==",
        "pi",
    ]);
    prop::collection::vec(pieces, 0..16).prop_map(|pieces| pieces.concat())
}

fn write(bytes: &[u8]) {
    let macros = [("a", "{$b}{$b}"), ("b", "{$x}"), ("Q1", "~Q2~+1"), ("Q2", "2")];
    let macros = macros.map(|(name, value)| PostMacro { name: name.into(), value: value.into() }).to_vec();
    let options = PostOptions { macros, cycles: true, ..PostOptions::default() };
    if let Ok(post) = PostDefinition::read(bytes, Utf8Path::new("any"))
        && let Ok(output) = post.write(&program(), &options)
    {
        assert!(output.text.len() < 1 << 24, "{} bytes", output.text.len());
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn templates_of_any_shape(templates in prop::array::uniform5(template())) {
        let names = ["PostFile", "MOP", "Rapid", "ArcCW", "DrillPeck"];
        let escape = |text: &str| text.replace('&', "&amp;").replace('<', "&lt;");
        let elements = names.iter().zip(&templates).map(|(name, text)| format!("<{name}>{}</{name}>", escape(text)));
        write(definition(&elements.collect::<String>()).as_bytes());
    }

    #[test]
    fn control_texts_of_any_shape(texts in prop::array::uniform4(control_text())) {
        let names = ["program-start", "line", "contour-start", "line-number"];
        let texts = names.iter().zip(&texts).map(|(name, text)| format!("{name} = '''\n{}'''\n", text.replace("'''", "")));
        write(format!("[text]\n{}", texts.collect::<String>()).as_bytes());
    }

    #[test]
    fn bytes_of_any_kind(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        write(&bytes);
        write(&[b"<PostProcessor><MOP>", bytes.as_slice(), b"</MOP></PostProcessor>"].concat());
        write(&[b"[text]\nline = '", bytes.as_slice(), b"'"].concat());
    }
}
