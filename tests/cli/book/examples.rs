//! Generates the last part of each page of `explain`: its example, described for a draughtsman. Drawings are shown as tables of their elements with
//! the faults marked, followed by pathbuild's output. The source is PBnnn.draw next to the page.

use std::fmt::Write as _;
use std::fs;

use pathbuild_diagnostic::{Code, Handle, Lang};
use pathbuild_testkit::model::{LayerState, MText, Part, Text};
use pathbuild_testkit::{Command, Content, Entity, Fixture, Layer, Point, Shape, Sheet};
use rayon::prelude::*;
use serde_json::Value;

use super::{assert_none, code, kept};
use crate::support::fixture::findings;
use crate::support::{Place, project};

fn say<'t>(lang: Lang, en: &'t str, de: &'t str) -> &'t str {
    match lang {
        Lang::En => en,
        Lang::De => de,
    }
}

/// Width of a page in characters.
const WIDTH: usize = 100;

#[test]
fn pages_of_explain_show_their_examples() {
    let pages: Vec<_> = Code::ALL.iter().flat_map(|code| [(*code, Lang::En), (*code, Lang::De)]).collect();
    let wrong: Vec<String> = pages.par_iter().filter_map(|(code, lang)| fault(*code, *lang)).collect();
    assert_none(&wrong);
}

fn fault(of: Code, lang: Lang) -> Option<String> {
    let file = project().join(format!("crates/pathbuild-diagnostic/src/pages/{of}.{}.md", code(lang)));
    let heading = format!("\n## {}\n", say(lang, "Example", "Beispiel"));
    let text = fs::read_to_string(&file).unwrap();
    let written = text.split(&heading).next().unwrap();
    let Some(example) = of.example() else { return kept(&file, written.as_bytes()) };
    kept(&file, format!("{written}{heading}{}", shown(of, example, lang)).as_bytes())
}

/// Describes an example: its files and the output of its commands.
fn shown(of: Code, example: &str, lang: Lang) -> String {
    let fixture = Fixture::parse(example).unwrap_or_else(|errors| panic!("{of}: {errors:?}"));
    let place = Place::of(example);
    let options = ["--format=json", "--no-cache", "--lang", code(lang)];
    let run = |command: &Command| {
        let arguments = command.arguments.iter().map(String::as_str);
        findings(&place.run_with(&options.into_iter().chain(arguments).collect::<Vec<_>>()))
    };
    let runs: Vec<_> =
        fixture.commands.iter().map(|command| (command.arguments.join(" "), run(command))).collect();
    let all: Vec<&Value> = runs.iter().flat_map(|(_, findings)| findings).collect();
    let files = fixture.files.iter().map(|file| match &file.content {
        Content::Drawing(sheet) => drawing(&file.name, sheet, &all, lang),
        Content::Verbatim(content) => format!("\n{}:\n\n```text\n{}\n```\n", file.name, content.trim_end()),
    });
    let files: String = files.collect();
    let said: String =
        runs.iter().map(|(command, findings)| output_of_code(of, command, findings, lang)).collect();
    assert!(!said.is_empty(), "{of} is not said");
    let means = match lang {
        Lang::En => format!("\n{of} concerns the part in « ».\n"),
        Lang::De => format!("\n{of} betrifft den Teil in « ».\n"),
    };
    let picture: String = runs.iter().map(|(command, _)| picture(of, command, lang)).collect();
    format!("{files}{}{said}{picture}", if files.contains('«') { means } else { String::new() })
}

/// Returns a sentence with the command that shows the finding in a picture of the stock, because a page in the terminal has no pictures; empty for
/// codes other than those of the part check.
fn picture(of: Code, command: &str, lang: Lang) -> String {
    let is_of_part = (Code::GougedPart..=Code::OutlineNotCut).contains(&of);
    let Some(drawing) = command.strip_prefix("check ").filter(|_| is_of_part) else { return String::new() };
    let shows = say(lang, "shows it in a picture of the stock.", "zeigt es in einem Bild des Rohteils.");
    format!("\n`pathbuild view {drawing} --stock -o stock.png` {shows}\n")
}

/// Returns the output of a command that belongs to a code, without duplicates.
fn output_of_code(of: Code, command: &str, findings: &[Value], lang: Lang) -> String {
    let own = findings.iter().filter(|finding| finding["code"] == of.to_string());
    let items = own.map(|finding| {
        wrapped(&format!("{of}{}: {}", place_of(finding, lang), finding["message"].as_str().unwrap()))
    });
    let mut said: Vec<String> = Vec::new();
    for item in items {
        if !said.contains(&item) {
            said.push(item);
        }
    }
    let head = format!("\n`pathbuild {command}` {}:\n\n", say(lang, "says", "sagt"));
    if said.is_empty() { String::new() } else { head + &said.concat() }
}

/// Describes the position of a finding, in a drawing or in a text.
fn place_of(finding: &Value, lang: Lang) -> String {
    let is_drawing = finding["file"].as_str().is_some_and(|file| file.ends_with(".dxf"));
    match (finding["x"].as_f64(), finding["y"].as_f64(), finding["line"].as_u64()) {
        (Some(x), Some(y), _) if is_drawing => {
            format!(" {} {}", say(lang, "at", "bei"), point(Point::new(x, y)))
        }
        (_, _, Some(line)) if !is_drawing => format!(", {} {line}", say(lang, "line", "Zeile")),
        _ => String::new(),
    }
}

/// Describes a drawing by its unusual properties and a table for each layer.
fn drawing(name: &str, sheet: &Sheet, findings: &[&Value], lang: Lang) -> String {
    let own: Vec<&Value> = findings.iter().copied().filter(|finding| finding["file"] == name).collect();
    let mut text = String::new();
    let is_on = |entity: &&Entity, layer: &str| entity.layer.as_deref() == Some(layer);
    let layers =
        sheet.layers().iter().filter(|layer| sheet.entities().iter().any(|it| is_on(&it, &layer.name)));
    for (index, layer) in layers.enumerate() {
        let states = states(layer, lang);
        let mut head = vec![format!("{name}, {} {}{states}", say(lang, "layer", "Layer"), layer.name)];
        if index == 0 {
            head.extend(unusual(sheet, lang));
        }
        _ = writeln!(text, "\n{}:\n", head.join(", "));
        text += &table(sheet.entities().iter().filter(|entity| is_on(entity, &layer.name)), &own, lang);
    }
    text
}

fn states(layer: &Layer, lang: Lang) -> String {
    let states = layer.states.iter().map(|state| match state {
        LayerState::Off => say(lang, "off", "ausgeschaltet"),
        LayerState::Frozen => say(lang, "frozen", "gefroren"),
        LayerState::Locked => say(lang, "locked", "gesperrt"),
        LayerState::Unlisted => say(lang, "not in the list of layers", "nicht in der Layerliste"),
    });
    states.flat_map(|state| [" (", state, ")"]).collect()
}

/// Lists the properties in which the drawing differs from a usual file.
fn unusual(sheet: &Sheet, lang: Lang) -> Vec<String> {
    let options = sheet.options();
    let units =
        (options.units != Some(4)).then(|| format!("$INSUNITS {}", options.units.unwrap_or_default()));
    let header = options.header.iter().map(|(name, pair)| format!("{name} {}", pair.value));
    let ends = options.left_out.contains(&Part::Eof);
    let ends = ends.then(|| say(lang, "without EOF at its end", "ohne EOF am Ende").to_owned());
    units.into_iter().chain(header).chain(ends).collect()
}

/// Returns a table of the elements of a layer, one per row; a parameter text is in the row of its element.
fn table<'e>(entities: impl Iterator<Item = &'e Entity>, findings: &[&Value], lang: Lang) -> String {
    let head = [
        ("", ""),
        ("element", "Element"),
        ("line type", "Linientyp"),
        ("from, at", "von, bei"),
        ("to", "bis"),
        ("text", "Text"),
    ];
    let mut rows = vec![head.map(|(en, de)| say(lang, en, de).to_owned())];
    for row in Row::all(entities, findings) {
        let (element, from, to, own) = described(row.entity, lang);
        let text = row.found.iter().fold(row.text.unwrap_or(own), |text, finding| marked(&text, finding));
        let mut codes: Vec<&str> = row.found.iter().filter_map(|finding| finding["code"].as_str()).collect();
        codes.dedup();
        let line_type = row.entity.line_type.clone().unwrap_or_default();
        rows.push([codes.join(" "), element, line_type, from, to, text]);
    }
    aligned(&rows)
}

/// An element with its parameter text and the findings about both.
struct Row<'e, 'f> {
    entity: &'e Entity,
    text: Option<String>,
    found: Vec<&'f Value>,
}

impl<'e, 'f> Row<'e, 'f> {
    /// Combines elements with their parameter texts, which follow them and come from the same line of the text form.
    fn all(entities: impl Iterator<Item = &'e Entity>, findings: &[&'f Value]) -> Vec<Self> {
        let mut rows: Vec<Self> = Vec::new();
        for entity in entities {
            let is_about = |finding: &&Value| entity.handle.is_some_and(|handle| is_about(finding, handle));
            let found = findings.iter().copied().filter(is_about);
            match (&entity.shape, rows.last_mut().filter(|row| row.entity.line == entity.line)) {
                (Shape::Text(Text { value, .. }) | Shape::MText(MText { value, .. }), Some(row)) => {
                    row.text = Some(value.clone());
                    row.found.extend(found);
                }
                _ => rows.push(Self { entity, text: None, found: found.collect() }),
            }
        }
        rows
    }
}

fn is_about(finding: &Value, handle: Handle) -> bool {
    finding["handle"].as_str() == Some(&handle.to_string())
}

/// Returns a text with its faulty part in « ».
fn marked(text: &str, finding: &Value) -> String {
    let span = finding["span"].as_array().filter(|_| finding["text"].as_str() == Some(text));
    let Some(span) = span else { return text.to_owned() };
    let [start, end] = [0, 1].map(|index| usize::try_from(span[index].as_u64().unwrap()).unwrap());
    let part = |skipped: usize, taken: usize| text.chars().skip(skipped).take(taken).collect::<String>();
    format!("{}«{}»{}", part(0, start), part(start, end - start), part(end, usize::MAX))
}

/// Returns the type of an entity, its start or position, its end, and its text.
fn described(entity: &Entity, lang: Lang) -> (String, String, String, String) {
    let at = point;
    let name = |en: &str, de: &str| say(lang, en, de).to_owned();
    let none = String::new;
    match &entity.shape {
        Shape::Line(line) => (name("line", "Linie"), at(line.from), at(line.to), none()),
        Shape::Circle(circle) => {
            (circle_name(entity, circle.radius * 2.0, lang), at(circle.centre), none(), none())
        }
        Shape::Polyline(it) => {
            let points: Vec<String> = it.vertices.iter().map(|vertex| at(vertex.point)).collect();
            let closed = if it.closed { name(", closed", ", geschlossen") } else { none() };
            (
                format!("{}{closed}", name("polyline", "Polylinie")),
                points[0].clone(),
                points[1..].join(" "),
                none(),
            )
        }
        Shape::Ellipse(ellipse) => (name("ellipse", "Ellipse"), at(ellipse.centre), none(), none()),
        Shape::Text(text) => (name("text", "Text"), at(text.anchor), none(), text.value.clone()),
        Shape::MText(text) => (name("text", "Text"), at(text.anchor), none(), text.value.clone()),
        other => panic!("an example has {other:?}: say here how it is described"),
    }
}

fn circle_name(entity: &Entity, diameter: f64, lang: Lang) -> String {
    let circle = format!("{} {} mm", say(lang, "circle of", "Kreis von"), decimal(diameter, lang));
    let is_marker = entity.line_type.as_deref() == Some("PHANTOM");
    let meaning =
        [(1.0, "start", "Anfang"), (1.5, "turn", "Wende"), (2.0, "end", "Ende"), (6.0, "probe", "Z-Probe")];
    let meaning = meaning.iter().find(|(marker, ..)| is_marker && (marker - diameter).abs() < 1e-9);
    meaning.map_or(circle.clone(), |(_, en, de)| format!("{}: {circle}", say(lang, en, de)))
}

/// Formats a point as in messages, in the same form in both languages.
fn point(point: Point) -> String {
    let parts = [point.x, point.y, point.z].map(number);
    format!("({})", if point.z == 0.0 { &parts[..2] } else { &parts }.join(", "))
}

fn number(value: f64) -> String {
    format!("{}", (value * 1000.0).round() / 1000.0 + 0.0)
}

fn decimal(value: f64, lang: Lang) -> String {
    if lang == Lang::De { number(value).replace('.', ",") } else { number(value) }
}

/// Formats rows as an aligned Markdown table, which is readable as plain text.
fn aligned(rows: &[[String; 6]]) -> String {
    let used: Vec<usize> =
        (0..6).filter(|column| rows[1..].iter().any(|row| !row[*column].is_empty())).collect();
    let width =
        |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or_default().max(3);
    let line = |row: &[String; 6]| {
        let cells = used.iter().map(|column| format!(" {:width$} |", row[*column], width = width(*column)));
        format!("|{}\n", cells.collect::<String>())
    };
    let rule = used.iter().map(|column| "-".repeat(width(*column) + 2)).collect::<Vec<_>>().join("|");
    format!("{}|{rule}|\n{}", line(&rows[0]), rows[1..].iter().map(line).collect::<String>())
}

/// Formats a list item, with wrapped lines.
fn wrapped(text: &str) -> String {
    let mut lines = vec!["-".to_owned()];
    for word in text.split_whitespace() {
        let line = lines.last_mut().unwrap();
        if line.chars().count() + 1 + word.chars().count() > WIDTH {
            lines.push(format!("  {word}"));
        } else {
            _ = write!(line, " {word}");
        }
    }
    lines.join("\n") + "\n"
}
