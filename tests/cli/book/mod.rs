//! Tests of the books in docs/en and docs/de, and of the README: their output is reproduced and compared. Commands run in a copy of the book's
//! drawings, pictures are drawn by `view`, tables are generated from the code, and links are checked. `PATHBUILD_UPDATE=1` rewrites everything that
//! differs. (CONTRIBUTING.md, "The books")
#![allow(clippy::case_sensitive_file_extension_comparisons, reason = "the files are ours")]

mod citations;
mod console;
mod drawings;
mod examples;
mod generated;
mod html;
mod links;
mod pictures;
mod scratch;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use pathbuild_diagnostic::Lang;
use rayon::prelude::*;

use crate::support::project;

/// A page of a book, or the README.
struct Page {
    /// Path relative to the project's directory.
    file: PathBuf,
    /// Path relative to the book's `src`, without `.md`.
    name: String,
    lang: Lang,
}

impl Page {
    fn path(&self) -> PathBuf {
        project().join(&self.file)
    }

    /// Returns the page's text, after a pending update of all pages.
    fn text(&self) -> String {
        if is_updating() {
            LazyLock::force(&DIFFERENCES);
        }
        fs::read_to_string(self.path()).unwrap()
    }
}

/// Returns the code of a language in configurations and file names.
fn code(lang: Lang) -> &'static str {
    match lang {
        Lang::En => "en",
        Lang::De => "de",
    }
}

fn source(lang: Lang) -> PathBuf {
    PathBuf::from("docs").join(code(lang)).join("src")
}

/// Returns the pages of a book, including its summary.
fn pages(lang: Lang) -> Vec<Page> {
    let mut pages: Vec<Page> = files_below(&project().join(source(lang)))
        .into_iter()
        .filter_map(|name| {
            let page = name.strip_suffix(".md")?.to_owned();
            Some(Page { file: source(lang).join(&name), name: page, lang })
        })
        .collect();
    pages.sort_by(|a, b| a.name.cmp(&b.name));
    pages
}

fn all_pages() -> Vec<Page> {
    let readme = Page { file: "README.md".into(), name: "README".to_owned(), lang: Lang::En };
    pages(Lang::En).into_iter().chain(pages(Lang::De)).chain([readme]).collect()
}

/// Returns the names of the files below a directory, with `/` as the separator.
pub(crate) fn files_below(directory: &Path) -> BTreeSet<String> {
    let mut files = BTreeSet::new();
    for entry in fs::read_dir(directory).into_iter().flatten() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if path.is_dir() {
            files.extend(files_below(&path).into_iter().map(|file| format!("{name}/{file}")));
        } else {
            files.insert(name);
        }
    }
    files
}

/// Compares a file with the expected content, or writes it. Returns the difference.
pub(crate) fn kept(file: &Path, now: &[u8]) -> Option<String> {
    if fs::read(file).is_ok_and(|content| content == now) {
        return None;
    }
    if is_updating() {
        fs::create_dir_all(file.parent().unwrap()).unwrap();
        fs::write(file, now).unwrap();
        return None;
    }
    let shown = file.strip_prefix(project()).unwrap_or(file).display();
    Some(format!("{shown} differs from what is made now (PATHBUILD_UPDATE=1 writes it: read what changed)"))
}

fn is_updating() -> bool {
    std::env::var_os("PATHBUILD_UPDATE").is_some()
}

fn assert_none(wrong: &[String]) {
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

/// Differences between the pages and what is generated now; an updating run writes the pages instead.
static DIFFERENCES: LazyLock<Vec<String>> =
    LazyLock::new(|| all_pages().par_iter().filter_map(difference).collect());

/// Compares a page with what is generated now. Tables are regenerated before commands are run, so that both changes are written together.
fn difference(page: &Page) -> Option<String> {
    let text = fs::read_to_string(page.path()).unwrap();
    let now = console::replayed(page, &generated::filled(page, &text));
    let difference = first_difference(&text, &now);
    kept(&page.path(), now.as_bytes()).map(|wrong| format!("{wrong}\n{difference}"))
}

#[test]
fn pages_show_what_is_printed_and_what_the_code_says() {
    assert_none(&DIFFERENCES);
}

fn first_difference(text: &str, now: &str) -> String {
    let lines = text.lines().zip(now.lines()).enumerate();
    let different = lines.into_iter().find(|(_, (old, new))| old != new);
    different.map_or_else(String::new, |(at, (old, new))| {
        format!("line {}:\n  stands: {old}\n  now:    {new}", at + 1)
    })
}
