//! The book in docs/: both languages have the same pages, every page is listed, links lead somewhere, and codes exist.
#![expect(clippy::disallowed_methods, reason = "it reads the book, which is no drawing")]
#![expect(clippy::unwrap_used, reason = "a book that cannot be read fails the test")]

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use pathbuild_diagnostic::Code;

const LANGUAGES: [&str; 2] = ["en", "de"];

fn source(language: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs").join(language).join("src")
}

fn pages_below(directory: &Path, root: &Path, pages: &mut BTreeSet<String>) {
    for entry in fs::read_dir(directory).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            pages_below(&path, root, pages);
        } else {
            let name = path.strip_prefix(root).unwrap().components();
            let parts: Vec<_> = name.map(|part| part.as_os_str().to_string_lossy()).collect();
            pages.insert(parts.join("/"));
        }
    }
}

fn pages(language: &str) -> BTreeSet<String> {
    let mut pages = BTreeSet::new();
    pages_below(&source(language), &source(language), &mut pages);
    pages
}

fn text(language: &str, page: &str) -> String {
    fs::read_to_string(source(language).join(page)).unwrap()
}

/// The targets of `[text](target)` and `[text]: target`.
fn links(text: &str) -> Vec<&str> {
    let inline = text.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    let defined = text.lines().filter_map(|line| line.strip_prefix('[')?.split_once("]: ").map(|(_, to)| to));
    inline.chain(defined).collect()
}

/// A heading as links name it: lower case, blanks as hyphens, other signs dropped.
fn anchor(heading: &str) -> String {
    let kept = heading.trim_start_matches('#').trim().to_lowercase();
    let kept = kept.chars().filter(|sign| sign.is_alphanumeric() || matches!(sign, ' ' | '-' | '_'));
    kept.map(|sign| if sign == ' ' { '-' } else { sign }).collect()
}

#[test]
fn both_languages_have_the_same_pages() {
    let [english, german] = LANGUAGES.map(pages);
    assert!(english.len() > 15, "{english:?}");
    assert_eq!(english, german);
}

#[test]
fn every_page_is_listed_in_the_same_order() {
    let listed = LANGUAGES.map(|language| {
        let summary = text(language, "SUMMARY.md");
        links(&summary).into_iter().map(str::to_owned).collect::<Vec<_>>()
    });
    assert_eq!(listed[0], listed[1]);
    let listed: BTreeSet<String> = listed[0].iter().cloned().chain(["SUMMARY.md".to_owned()]).collect();
    assert_eq!(listed, pages("en"));
}

#[test]
fn links_lead_to_pages_and_headings() {
    for language in LANGUAGES {
        for page in pages(language) {
            let text = text(language, &page);
            for link in links(&text).into_iter().filter(|link| !link.contains("://")) {
                let (file, heading) = link.split_once('#').unwrap_or((link, ""));
                let target = source(language).join(&page).parent().unwrap().join(file);
                let found =
                    fs::read_to_string(&target).unwrap_or_else(|_| panic!("{language}/{page}: {link}"));
                let has_heading =
                    found.lines().filter(|line| line.starts_with('#')).any(|line| anchor(line) == heading);
                assert!(heading.is_empty() || has_heading, "{language}/{page}: {link}");
            }
        }
    }
}

#[test]
fn both_languages_name_the_same_codes_and_all_exist() {
    let known: BTreeSet<String> = Code::ALL.iter().map(ToString::to_string).collect();
    for page in pages("en") {
        let [english, german] = LANGUAGES.map(|language| codes(&text(language, &page)));
        assert_eq!(english, german, "{page}");
        let unknown: Vec<_> = english.difference(&known).collect();
        assert!(unknown.is_empty(), "{page}: {unknown:?}");
    }
}

/// Every `PBnnn` in a text.
fn codes(text: &str) -> BTreeSet<String> {
    let places = text.match_indices("PB").map(|(place, _)| &text[place..]);
    let codes = places.filter_map(|rest| rest.get(..5));
    let is_code = |code: &&str| code[2..].bytes().all(|byte| byte.is_ascii_digit());
    codes.filter(is_code).map(str::to_owned).collect()
}
