//! Reproduces console blocks. The blocks of a page run one after the other in one directory: a copy of the folder of docs/drawings that has the
//! page's name (its last part), or else an empty directory. Comments in the page, which readers do not see, give instructions:
//!
//! - `<!-- place: FOLDER -->`: switch to a new copy of this folder. `empty`, `example` (created by `init --example`),
//!   `fixtures` (fixtures/library) and `recorded` (a drawing with the program that PathDxf2GCode made of it) also work;
//! - `<!-- put: DRAWING as FILE -->`: add a drawing in text form from docs/drawings;
//! - `<!-- file: FILE -->`: write the next block into this file.
//!
//! Besides `pathbuild`, a block may use `cat FILE`, `head -n N FILE`, `mkdir DIRECTORY` and `cd DIRECTORY`. `...` on a line of its own
//! stands for any number of lines.

use std::fmt::Write as _;
use std::fs;

use super::{Page, scratch};
use crate::support::Place;

/// Returns the page with the current output of its commands.
pub(super) fn replayed(page: &Page, text: &str) -> String {
    let mut session = Session { page, place: None, directory: String::new(), file: None };
    let mut now = String::new();
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        _ = writeln!(now, "{line}");
        if let Some(remark) = line.strip_prefix("<!-- ").and_then(|line| line.strip_suffix(" -->")) {
            session.obey(remark);
        } else if let Some(language) = line.trim_start().strip_prefix("```") {
            let indent = &line[..line.len() - line.trim_start().len()];
            let block: Vec<&str> = lines
                .by_ref()
                .take_while(|line| line.trim() != "```")
                .map(|line| line.strip_prefix(indent).unwrap_or(line))
                .collect();
            let block = session.block(language, &block);
            block.lines().for_each(|line| _ = writeln!(now, "{}", format!("{indent}{line}").trim_end()));
            _ = writeln!(now, "{indent}```");
        }
    }
    now
}

struct Session<'p> {
    page: &'p Page,
    place: Option<Place>,
    directory: String,
    /// File into which the next block is written, if any.
    file: Option<String>,
}

impl Session<'_> {
    fn place(&mut self) -> &Place {
        let page = self.page;
        let name = page.name.rsplit('/').next().unwrap();
        let folder = if scratch::drawings().join(name).is_dir() { name } else { "empty" };
        self.place.get_or_insert_with(|| scratch::place(folder, page.lang))
    }

    fn obey(&mut self, remark: &str) {
        let Some((what, rest)) = remark.split_once(": ") else { return };
        match what {
            "place" => {
                self.place = Some(scratch::place(rest, self.page.lang));
                self.directory.clear();
            }
            "put" => {
                let (drawing, file) = rest.split_once(" as ").unwrap();
                let drawn = scratch::drawn(&scratch::drawings().join(drawing));
                self.write(file, &drawn);
            }
            "file" => self.file = Some(rest.to_owned()),
            "generated" => {}
            _ => panic!("{}: {remark}?", self.page.file.display()),
        }
    }

    fn write(&mut self, file: &str, content: &[u8]) {
        let directory = self.directory.clone();
        let file = self.place().path().join(directory).join(file);
        fs::create_dir_all(file.parent().unwrap()).unwrap();
        fs::write(file, content).unwrap();
    }

    /// Returns a block with the current output of its commands.
    fn block(&mut self, language: &str, lines: &[&str]) -> String {
        let text = lines.join("\n");
        if let Some(file) = self.file.take() {
            self.write(&file, format!("{text}\n").as_bytes());
        }
        if language != "console" {
            return text;
        }
        let mut now = String::new();
        for shown in text.split_inclusive('\n').fold(Vec::<String>::new(), commands) {
            let (command, shown) = shown.split_once('\n').unwrap_or((&shown, ""));
            let printed = self.typed(command);
            let printed = if stands_for(shown.trim_end(), &printed) { shown.trim_end() } else { &printed };
            let newline = if printed.is_empty() { "" } else { "\n" };
            _ = write!(now, "{command}\n{printed}{newline}");
        }
        now
    }

    /// Returns the output of a command.
    fn typed(&mut self, line: &str) -> String {
        let page = self.page.file.display().to_string();
        let command = line.strip_prefix("$ ").unwrap_or_else(|| panic!("{page}: a block begins with {line}"));
        let command = command.replace("cargo run --release --locked -- ", "pathbuild ");
        let directory = self.directory.clone();
        let words = words(&command);
        match &words[..] {
            ["pathbuild", arguments @ ..] => {
                let arguments: Vec<&str> = arguments.iter().map(|word| word.trim_matches('\'')).collect();
                let run = self.place().run_in(&directory, &arguments);
                assert!(matches!(run.status, Some(0..=2)), "{page}: {run}");
                format!("{}{}", run.stdout, run.stderr).trim_end().to_owned()
            }
            ["cargo", "test", ..] => String::new(),
            ["cat", file] => self.read(file, usize::MAX),
            ["head", "-n", lines, file] => self.read(file, lines.parse().unwrap()),
            ["mkdir", name] => {
                fs::create_dir(self.place().path().join(&directory).join(name)).unwrap();
                String::new()
            }
            ["cd", name] => {
                self.directory = format!("{directory}{name}/");
                String::new()
            }
            _ => panic!("{page}: the test cannot run `{command}`; use another language than console"),
        }
    }

    fn read(&mut self, file: &str, lines: usize) -> String {
        let directory = self.directory.clone();
        let text = self.place().read(&format!("{directory}{file}"));
        text.lines().take(lines).collect::<Vec<_>>().join("\n")
    }
}

/// Splits a block before each `$ `.
fn commands(mut found: Vec<String>, line: &str) -> Vec<String> {
    match found.last_mut() {
        Some(last) if !line.starts_with("$ ") => last.push_str(line),
        _ => found.push(line.to_owned()),
    }
    found
}

/// Whether the shown output, in which `...` stands for any number of lines, matches the printed output.
fn stands_for(shown: &str, printed: &str) -> bool {
    let shown: Vec<&str> = shown.lines().collect();
    let parts: Vec<&[&str]> = shown.split(|line| *line == "...").collect();
    let [first, others @ ..] = &parts[..] else { return false };
    let printed: Vec<&str> = printed.lines().map(str::trim_end).collect();
    let Some(mut rest) = printed.strip_prefix(*first) else { return false };
    let Some((last, inner)) = others.split_last() else { return rest.is_empty() };
    for part in inner.iter().filter(|part| !part.is_empty()) {
        let Some(at) = rest.windows(part.len()).position(|window| window == *part) else { return false };
        rest = &rest[at + part.len()..];
    }
    rest.ends_with(last)
}

#[test]
fn three_points_stand_for_any_lines() {
    assert!(stands_for("a\n...\nd", "a\nb\nc\nd"));
    assert!(stands_for("...\nb\n...", "a\nb\nc"));
    assert!(stands_for("a\n...", "a"));
    assert!(!stands_for("a\n...\nc", "a\nb\nc\nd"));
    assert!(!stands_for("...\nx\n...", "a\nb\nc"));
    assert!(!stands_for("a", "a\nb"));
}

/// Splits a command into words; those with spaces are in double quotes.
fn words(command: &str) -> Vec<&str> {
    let parts = command.split('"').enumerate();
    let words = parts.flat_map(|(index, part)| {
        let is_quoted = index % 2 == 1;
        let plain = if is_quoted { "" } else { part };
        plain.split_whitespace().chain(is_quoted.then_some(part))
    });
    words.collect()
}
