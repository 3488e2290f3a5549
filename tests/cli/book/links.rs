//! Checks pages, links and anchors: both books have the same pages, and every link is valid.

use std::collections::BTreeSet;
use std::fs;

use pathbuild_diagnostic::{Code, Lang};

use super::{Page, all_pages, assert_none, pages};
use crate::support::project;

/// Returns the parts of a text outside of code blocks.
fn prose(text: &str) -> Vec<&str> {
    let mut is_code = false;
    let is_prose = |line: &&str| {
        let is_fence = line.trim_start().starts_with("```");
        is_code ^= is_fence;
        !is_code && !is_fence
    };
    text.lines().filter(is_prose).collect()
}

/// Returns the targets of `[text](target)`, `![text](target)` and `[text]: target`.
fn links(text: &str) -> Vec<&str> {
    let mut links = Vec::new();
    for line in prose(text) {
        links.extend(line.split("](").skip(1).filter_map(|rest| rest.split(')').next()));
        links.extend(line.strip_prefix('[').and_then(|line| line.split_once("]: ")).map(|(_, to)| to));
    }
    links
}

/// Returns the targets of `![text](target)`.
pub(super) fn images(text: &str) -> Vec<&str> {
    let images = prose(text).into_iter().flat_map(|line| line.split("![").skip(1));
    images.filter_map(|rest| rest.split_once("](")?.1.split(')').next()).collect()
}

/// Returns the file to which a link on a page points, relative to the project's directory.
pub(super) fn target(page: &Page, link: &str) -> String {
    let folder = page.file.parent().unwrap().to_string_lossy().replace('\\', "/");
    let mut parts: Vec<&str> = folder.split('/').filter(|part| !part.is_empty()).collect();
    for part in link.split('/') {
        match part {
            "." => {}
            ".." => _ = parts.pop(),
            part => parts.push(part),
        }
    }
    parts.join("/")
}

/// Converts a heading to an anchor: lower case, spaces as hyphens, other characters dropped.
fn anchor(heading: &str) -> String {
    let kept = heading.trim_start_matches('#').trim().to_lowercase();
    let kept = kept.chars().filter(|sign| sign.is_alphanumeric() || matches!(sign, ' ' | '-' | '_'));
    kept.map(|sign| if sign == ' ' { '-' } else { sign }).collect()
}

fn names(lang: Lang) -> BTreeSet<String> {
    pages(lang).into_iter().map(|page| page.name).collect()
}

#[test]
fn both_languages_have_the_same_pages() {
    let english = names(Lang::En);
    assert!(english.len() > 30, "{english:?}");
    assert_eq!(english, names(Lang::De));
}

#[test]
fn every_page_is_listed_in_the_same_order() {
    let listed = [Lang::En, Lang::De].map(|lang| {
        let summary = pages(lang).into_iter().find(|page| page.name == "SUMMARY").unwrap().text();
        links(&summary).into_iter().map(|link| link.replace(".md", "")).collect::<Vec<_>>()
    });
    assert_eq!(listed[0], listed[1]);
    let listed: BTreeSet<String> = listed[0].iter().cloned().chain(["SUMMARY".to_owned()]).collect();
    assert_eq!(listed, names(Lang::En));
}

#[test]
fn links_lead_to_files_and_headings() {
    let mut wrong = Vec::new();
    for page in all_pages() {
        let text = page.text();
        for link in links(&text).into_iter().filter(|link| !link.contains("://")) {
            let (file, heading) = link.split_once('#').unwrap_or((link, ""));
            let file = if file.is_empty() { page.path() } else { project().join(target(&page, file)) };
            let found = heading.is_empty() && file.exists()
                || fs::read_to_string(&file).is_ok_and(|text| {
                    let headings = prose(&text).into_iter().filter(|line| line.starts_with('#'));
                    headings.map(anchor).any(|anchor| anchor == heading)
                });
            if !found {
                wrong.push(format!("{}: {link}", page.file.display()));
            }
        }
    }
    assert_none(&wrong);
}

#[test]
fn both_languages_name_the_same_codes_and_all_exist() {
    let known: BTreeSet<String> = Code::ALL.iter().map(ToString::to_string).collect();
    for (english, german) in pages(Lang::En).iter().zip(pages(Lang::De)) {
        let named = codes(&english.text());
        assert_eq!(named, codes(&german.text()), "{}", english.name);
        let unknown: Vec<_> = named.difference(&known).collect();
        assert!(unknown.is_empty(), "{}: {unknown:?}", english.name);
    }
}

/// Both languages show the same pictures and drawings, so links to files other than pages are equal.
#[test]
fn both_languages_show_the_same() {
    for (english, german) in pages(Lang::En).iter().zip(pages(Lang::De)) {
        let shown = |page: &Page| {
            let text = page.text();
            let links =
                links(&text).into_iter().filter(|link| link.ends_with(".svg") || link.ends_with(".dxf"));
            links.map(str::to_owned).collect::<Vec<_>>()
        };
        assert_eq!(shown(english), shown(&german), "{}", english.name);
    }
}

/// Returns every `PBnnn` in a text.
fn codes(text: &str) -> BTreeSet<String> {
    let places = text.match_indices("PB").map(|(place, _)| &text[place..]);
    let codes = places.filter_map(|rest| rest.get(..5));
    let is_code = |code: &&str| code[2..].bytes().all(|byte| byte.is_ascii_digit());
    codes.filter(is_code).map(str::to_owned).collect()
}
