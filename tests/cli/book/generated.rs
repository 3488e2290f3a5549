//! Generates tables from the code, between `<!-- generated: NAME -->` and `<!-- end -->`.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use clap::{Arg, Command};
use pathbuild::german;
use pathbuild_diagnostic::{Code, Lang, Severity};
use pathbuild_path::{ElementClass, Letter, LetterUse, LineType};

use super::{Page, code, pages};

const BEGIN: &str = "<!-- generated: ";
const END: &str = "<!-- end -->";

/// Returns a page with regenerated tables.
pub(super) fn filled(page: &Page, text: &str) -> String {
    let mut now = String::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once(BEGIN) {
        let (name, after) = after.split_once(" -->\n").unwrap();
        let (_, after) = after.split_once(END).unwrap_or_else(|| panic!("{}: no {END}", page.file.display()));
        _ = write!(now, "{before}{BEGIN}{name} -->\n{}\n{END}", table(name, page.lang).trim_end());
        rest = after;
    }
    now + rest
}

fn table(name: &str, lang: Lang) -> String {
    match name {
        "letters" => letters(lang),
        "line-type-names" => line_type_names(),
        "commands" => commands(lang),
        "diagnostics" => diagnostics(lang),
        "configuration" => configuration(),
        _ => match name.strip_prefix("configuration-") {
            Some(section) => german_keys(section),
            None => posts(name, lang),
        },
    }
}

/// Returns a table about the languages of post-processor definitions, without the header, which is in the page.
fn posts(name: &str, lang: Lang) -> String {
    let rows = pathbuild_post::reference_table(name, lang);
    let rows = rows.unwrap_or_else(|| panic!("no table is called {name}"));
    let line = |row: &Vec<String>| {
        let cells: Vec<String> = row.iter().map(|cell| cell.replace('|', "\\|")).collect();
        format!("| {} |\n", cells.join(" | "))
    };
    let head = POST_HEADS
        .iter()
        .find(|(table, ..)| *table == name)
        .map(|(_, en, de)| if lang == Lang::De { de } else { en });
    let head = head.unwrap_or_else(|| panic!("the table {name} has no head"));
    let rule = "--- | ".repeat(head.split(" | ").count());
    format!("| {head} |\n| {}\n{}", rule.trim_end(), rows.iter().map(line).collect::<String>())
}

const POST_HEADS: [(&str, &str, &str); 10] = [
    ("post-keys", "key | takes | sets", "Schlüssel | nimmt | setzt"),
    ("control-texts", "text | called", "Text | wird aufgerufen"),
    ("control-variables", "variable | holds | has a value", "Variable | enthält | hat einen Wert"),
    ("control-statements", "statement | result", "Anweisung | Ergebnis"),
    ("control-operators", "operators", "Operatoren"),
    ("control-functions", "function | value", "Funktion | Wert"),
    ("cambam-sections", "element | | without it", "Element | | ohne es"),
    ("cambam-options", "element | takes | without it | sets", "Element | nimmt | ohne es | setzt"),
    ("cambam-macros", "macro | stands for", "Makro | steht für"),
    ("cambam-calls", "macro | takes", "Makro | nimmt"),
];

/// Letters in the order of the columns of their table, which is familiar to machinists. New letters follow.
const COLUMNS: &str = "OTSIFBDPUWCNQAHMZL>:ER@";

const ROWS: [ElementClass; 12] = [
    ElementClass::PathStart,
    ElementClass::Mill,
    ElementClass::Mark,
    ElementClass::Support,
    ElementClass::Sweep,
    ElementClass::DrilledHole,
    ElementClass::DrilledMark,
    ElementClass::HelicalCircle,
    ElementClass::HelicalMark,
    ElementClass::HelicalSupport,
    ElementClass::Subpath,
    ElementClass::Probe,
];

fn letters(lang: Lang) -> String {
    let element = if lang == Lang::De { "Element" } else { "element" };
    let familiar = COLUMNS.chars().map(|letter| Letter::new(letter).unwrap());
    let new = Letter::all().filter(|letter| !COLUMNS.contains(letter.as_char()));
    let columns: Vec<Letter> = familiar.chain(new).collect();
    let heads: Vec<String> = columns.iter().map(|letter| format!("`{}`", letter.as_char())).collect();
    let mut table =
        format!("| {element} | {} |\n| --- |{}\n", heads.join(" | "), " --- |".repeat(columns.len()));
    for class in ROWS {
        let word = class.word();
        let name = if lang == Lang::De { word.de } else { word.en };
        let name = name.split_once(' ').map_or(name, |(_, noun)| noun);
        let cells: Vec<&str> = columns.iter().map(|letter| mark(class.use_of(*letter))).collect();
        _ = writeln!(table, "| {name} | {} |", cells.join(" | "));
    }
    table
}

fn mark(usage: LetterUse) -> &'static str {
    match usage {
        LetterUse::Needed => "**!**",
        LetterUse::Allowed => "o",
        LetterUse::ChainNeeded => "**c!**",
        LetterUse::Chain => "c",
        LetterUse::Ignored => "-",
        LetterUse::PathOnly => "p",
        LetterUse::Unknown => "",
    }
}

/// Returns a table of the alternative names of each line type.
fn line_type_names() -> String {
    let mut table = String::from("| | |\n| --- | --- |\n");
    for (name, line_type) in LineType::NAMES {
        let names: Vec<String> = LineType::other_names(line_type).map(|name| format!("`{name}`")).collect();
        if !names.is_empty() {
            _ = writeln!(table, "| {name} | {} |", names.join(", "));
        }
    }
    table
}

fn commands(lang: Lang) -> String {
    let cli = german::command(lang);
    let mut text = String::new();
    let visible = cli.get_subcommands().filter(|it| !it.is_hide_set() && it.get_name() != "help");
    for command in visible {
        command_text(&mut text, "pathbuild", command);
    }
    let common = if lang == Lang::De { "Allgemeine Optionen" } else { "Common options" };
    format!("{text}## {common}\n\n{}", options(cli.get_arguments()))
}

fn command_text(text: &mut String, before: &str, command: &Command) {
    let name = format!("{before} {}", command.get_name());
    let about = command.get_about().map(ToString::to_string).unwrap_or_default();
    _ = writeln!(text, "## {name}\n\n{about}.\n");
    let arguments = command.get_arguments().filter(|it| !it.is_global_set() && it.get_id() != "help");
    let table = options(arguments);
    if !table.is_empty() {
        _ = writeln!(text, "{table}");
    }
    for inner in command.get_subcommands().filter(|inner| inner.get_name() != "help") {
        command_text(text, &name, inner);
    }
}

fn options<'a>(arguments: impl Iterator<Item = &'a Arg>) -> String {
    let mut table = String::new();
    for argument in arguments.filter(|argument| !argument.is_hide_set()) {
        let values: Vec<String> =
            argument.get_value_names().unwrap_or_default().iter().map(ToString::to_string).collect();
        let takes = argument.get_action().takes_values();
        let value = if takes { values.join(" ") } else { String::new() };
        let names = argument.get_short().map(|short| format!("-{short}"));
        let names = names.into_iter().chain(argument.get_long().map(|long| format!("--{long}")));
        let names: Vec<String> = names.collect();
        let shown = if names.is_empty() { value } else { format!("{} {value}", names.join(", ")) };
        let help = argument.get_help().map(ToString::to_string).unwrap_or_default().replace('|', "\\|");
        _ = writeln!(table, "| `{}` | {help} |", shown.trim().replace('|', "\\|"));
    }
    if table.is_empty() { table } else { format!("| | |\n| --- | --- |\n{table}") }
}

fn diagnostics(lang: Lang) -> String {
    let [code_head, name, severity, means] = match lang {
        Lang::En => ["code", "name", "severity", "means"],
        Lang::De => ["Code", "Name", "Schwere", "bedeutet"],
    };
    let mut table = format!("| {code_head} | {name} | {severity} | {means} |\n| --- | --- | --- | --- |\n");
    for found in Code::ALL {
        let severity = match (found.severity(), lang) {
            (Severity::Error, Lang::En) => "error",
            (Severity::Error, Lang::De) => "Fehler",
            (Severity::Warning, Lang::En) => "warning",
            (Severity::Warning, Lang::De) => "Warnung",
        };
        let link = format!("../../../../crates/pathbuild-diagnostic/src/pages/{found}.{}.md", code(lang));
        let first = first_sentence(found.page(lang)).replace('|', "\\|");
        _ = writeln!(table, "| [{found}]({link}) | {} | {severity} | {first} |", found.name());
    }
    table
}

/// Returns the first sentence below a page's heading.
fn first_sentence(page: &str) -> String {
    let paragraph = page.split("\n\n").nth(1).unwrap_or_default().replace('\n', " ");
    let is_end = |(at, _): &(usize, &str)| {
        let before = &paragraph[..*at];
        !before.ends_with("z. B") && !before.ends_with("e.g")
    };
    let end = paragraph.match_indices(". ").find(is_end).map_or(paragraph.len(), |(at, _)| at + 1);
    paragraph[..end].to_owned()
}

/// Returns the configuration that `init` writes, which contains every key.
fn configuration() -> String {
    format!("```toml\n{}```", pathbuild_workspace::config::template())
}

/// Returns the keys of a section of the configuration with their descriptions in German, and their defaults if any has one.
fn german_keys(section: &str) -> String {
    let rows = pathbuild_workspace::config::german_rows(section);
    assert!(!rows.is_empty(), "the configuration has no section {section}");
    let columns = if rows.iter().all(|[.., default]| default.is_empty()) { 2 } else { 3 };
    let line = |cells: &[String]| format!("| {} |\n", cells.join(" | ")).replace("  |", " |");
    let heads = ["Schlüssel", "Bedeutung", "Vorgabe"].map(str::to_owned);
    let rule = vec!["---".to_owned(); columns];
    let rows = rows.iter().map(|row| line(&row[..columns]));
    [line(&heads[..columns]), line(&rule)].into_iter().chain(rows).collect()
}

/// Returns every word in backticks in the first column of a page's tables.
fn first_column(text: &str) -> BTreeSet<String> {
    let rows = text.lines().filter_map(|line| line.strip_prefix("| ")?.split(" | ").next());
    rows.flat_map(|cell| cell.split('`').skip(1).step_by(2)).map(str::to_owned).collect()
}

#[test]
fn the_letters_of_the_book_are_those_of_the_code() {
    let known: BTreeSet<char> = Letter::all().map(Letter::as_char).collect();
    let positive: BTreeSet<char> = Letter::all().filter(|it| it.is_positive()).map(Letter::as_char).collect();
    for (lang, limit) in [(Lang::En, "must be greater than 0"), (Lang::De, "müssen größer als 0 sein")] {
        let text = pages(lang).into_iter().find(|page| page.name == "language/letters").unwrap().text();
        let (meanings, _) = text.split_once(BEGIN).unwrap();
        let explained = first_column(meanings).into_iter().filter_map(|cell| cell.chars().next());
        assert_eq!(known, explained.collect(), "{lang:?}");
        let (before, _) = text.split_once(limit).unwrap();
        let letters = before.lines().last().unwrap().split_whitespace().map(|word| word.trim_matches(','));
        let letters = letters.filter(|word| word.len() == 1).filter_map(|word| word.chars().next());
        assert_eq!(positive, letters.collect(), "{lang:?}");
    }
}

/// The tables of keys are generated, except for the keys within other tables, such as those of a tool.
#[test]
fn the_german_page_explains_every_key_of_the_configuration() {
    let template = pathbuild_workspace::config::template();
    let keys = template.lines().filter_map(|line| line.trim_start_matches('#').split_once(" = "));
    let is_key = |key: &str| key.bytes().all(|byte| byte.is_ascii_lowercase() || byte == b'-');
    let keys: BTreeSet<&str> = keys.map(|(key, _)| key).filter(|key| is_key(key)).collect();
    let text =
        pages(Lang::De).into_iter().find(|page| page.name == "reference/configuration").unwrap().text();
    let explained = first_column(&text);
    let missing: Vec<_> = keys.iter().filter(|key| !text.contains(&format!("`{key}`"))).collect();
    let unknown: Vec<_> =
        explained.iter().filter(|key| !keys.contains(key.as_str()) && is_key(key)).collect();
    assert!(missing.is_empty() && unknown.is_empty(), "missing {missing:?}, unknown {unknown:?}");
}
