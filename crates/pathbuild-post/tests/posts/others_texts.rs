//! Inserts texts from drawings, file names and options in every place of every post. No control may interpret any of them as code.

use camino::Utf8Path;
use pathbuild_post::{BUILT_IN, Job, JobStep, Language, PostDefinition, PostOptions};

use crate::mutilated::program;
use crate::support::{DIN, read, real_definitions, texts, unchecked};

const HOSTILE: [&str; 31] = [
    "LOGOPEN,x",
    "log append, x",
    "MSG,x",
    "M S G , x",
    "DEBUG,#1",
    "PRINT,x",
    "PY,import os",
    "PYRUN,x",
    "PYRELOAD",
    "preview, hide",
    "PROBEOPEN x",
    "ABORT,x",
    ") G1 Z-99 (",
    "a (b) G1 Z-99",
    "; G1 Z-99",
    "// G1 Z-99",
    "% G1 Z-99",
    "!?~",
    "a\r\nG1 Z-99",
    "\\~0AG1 Z-99",
    "\\\\\\~0AG1 Z-99",
    "\\\\\\~*inj.txt*",
    "\\~*inj.txt*",
    "{$spindle(cw)}",
    "~X1~",
    "{=X1 {1}}",
    "{#1/0}",
    "L\u{d2}GOPEN,x",
    "\u{2028}G1 Z-99",
    "\u{202e}G1 Z-99",
    "\u{201e}\u{c4}\u{201c}",
];

#[test]
fn no_control_acts_on_a_text_of_others() {
    let built_in = BUILT_IN.iter().filter(|post| post.language != Language::Native);
    let own =
        built_in.map(|post| (format!("{}.{}", post.name, post.language.extension()), post.text.to_owned()));
    let own: Vec<(String, String)> = own.chain([("din.toml".into(), DIN.into())]).collect();
    for (name, text) in own.iter().chain(&real_definitions()) {
        let post = PostDefinition::read(text.as_bytes(), Utf8Path::new(name)).unwrap();
        let is_own = own.iter().any(|(own, _)| own == name);
        let bytes = (0..=255_u8).map(|byte| format!("a{}G1 Z-99", char::from(byte)));
        for hostile in bytes.chain(HOSTILE.map(str::to_owned)) {
            // Test each byte in all places together, and each known dangerous text in every single place.
            let first = if HOSTILE.contains(&hostile.as_str()) { 0 } else { PLACES - 1 };
            for place in first..PLACES {
                let one = |text: &str| written(&post, place, text, is_own);
                if let (Some(found), Some(harmless)) = (one(&hostile), one("x")) {
                    check(name, place, &hostile, &found, &harmless);
                }
            }
        }
    }
}

/// If the user takes responsibility for a definition, the texts that it puts into comments are nevertheless checked.
#[test]
fn no_text_ends_or_begins_a_comment_of_a_definition_s_own() {
    let marks = [
        ["{", "}"],
        ["&lt;", "&gt;"],
        ["'", "'"],
        ["/*", "*/"],
        ["[", "]"],
        ["$", "$"],
        ["--", " -"],
        ["//", ""],
    ];
    for [open, close] in marks {
        let definition = |mop: &str| {
            let comments = format!("<Comment>{open}</Comment><EndComment>{close}</EndComment>");
            let files = "<PostFile>{$mops}</PostFile>";
            read(&format!("<PostProcessor>{comments}{files}<MOP>{mop}</MOP></PostProcessor>")).unwrap()
        };
        let [open, close] = [open, close].map(|mark| mark.replace("&lt;", "<").replace("&gt;", ">"));
        let written = |definition: &PostDefinition, name: &str| {
            let mut job = program();
            job.operations.truncate(1);
            (job.operations[0].name, job.name) = (name.into(), format!("{close}G1 Z-99").into());
            unchecked(definition, &job, &PostOptions::default())
                .map(|output| String::from_utf8_lossy(&output.text).trim_end().to_owned())
        };
        let within = definition("{$comment}Path {$mop.name}{$cbfile.name}{$endcomment}");
        let halves = close.char_indices().map(|(at, _)| close[..at].to_owned());
        for name in halves.chain([format!("{close}G1 Z-99{open}"), format!("a{close}{close}b")]) {
            let line = written(&within, &name).unwrap();
            let inside = line.strip_prefix(&open).and_then(|line| line.strip_suffix(close.as_str()));
            let inside = inside.unwrap_or_else(|| panic!("{name:?}: {line:?}"));
            assert!(close.is_empty() || !inside.contains(&close), "{name:?}: {line:?}");
            assert!(inside.contains("99") && !line.contains('\n'), "{name:?}: {line:?}");
        }
        assert!(written(&definition("{$mop.name} G0 X1"), &open).is_err(), "{open} in front of words");
    }
}

/// Number of places for a text, plus one for all places together.
const PLACES: usize = 8;

fn written(post: &PostDefinition, place: usize, text: &str, is_own: bool) -> Option<String> {
    let mut job: Job = program();
    let mut options = PostOptions { unchecked: !is_own, ..PostOptions::default() };
    let is = |index: usize| place == index || place == PLACES - 1;
    for operation in &mut job.operations {
        if is(0) {
            operation.name = text.into();
            operation.part = text.into();
        }
        if is(1) {
            operation.tool.name = text.into();
        }
        if is(2) {
            operation.steps.insert(0, JobStep::Comment(text.into()));
        }
    }
    if is(3) {
        job.name = format!("8001 {text}").into();
    }
    if is(4) {
        job.drawing = text.into();
    }
    if is(5) {
        options.date = Some(text.into());
    }
    if is(6) {
        job.remarks = vec![text.into()];
    }
    match post.write(&job, &options) {
        Ok(output) => Some(String::from_utf8_lossy(&output.text).into_owned()),
        Err(errors) if is_own => panic!("{text:?} in {place}: {}", texts(&errors).join("\n")),
        Err(_) => None,
    }
}

fn check(name: &str, place: usize, hostile: &str, found: &str, harmless: &str) {
    let at = format!("{name}: {hostile:?} in place {place}");
    let is_control = |c: char| c.is_control() && !matches!(c, '\r' | '\n');
    assert!(!found.contains(is_control), "{at}: a control character");
    assert!(found.is_ascii(), "{at}: beyond ASCII");
    let marks: &[&str] = match name {
        "marlin.cbpp" => &[";"],
        "xpertmill.toml" => &["//"],
        _ => &["(", ";"],
    };
    let code = |text: &str| text.lines().map(|line| code_of(line, marks, &at)).collect::<Vec<_>>();
    assert_eq!(code(found), code(harmless), "{at}");
    if name == "grbl.cbpp" {
        assert!(!found.contains(['!', '?', '~', '%']), "{at}: acts at once");
    }
}

/// Returns a line without its comments, and asserts that none of the texts is active.
fn code_of(line: &str, marks: &[&str], at: &str) -> String {
    let mut code = String::new();
    let mut rest = line;
    while let Some((start, mark)) = marks.iter().filter_map(|mark| Some((rest.find(mark)?, *mark))).min() {
        code.push_str(&rest[..start]);
        let inside = &rest[start + mark.len()..];
        let (comment, after) = match mark {
            "(" => inside.split_once(')').unwrap_or_else(|| panic!("{at}: open in {line:?}")),
            _ => (inside, ""),
        };
        assert!(mark != "(" || !comment.contains('('), "{at}: nested in {line:?}");
        let word: String =
            comment.chars().filter(|c| !c.is_whitespace()).take(10).collect::<String>().to_uppercase();
        let active = [
            "MSG,", "DEBUG,", "PRINT,", "LOG", "PROBE", "PY,", "PYRUN,", "PYRELOAD", "ABORT,", "AXIS,",
            "PREVIEW,",
        ];
        assert!(!active.iter().any(|start| word.starts_with(start)), "{at}: active in {line:?}");
        rest = after;
    }
    code.push_str(rest);
    code
}
