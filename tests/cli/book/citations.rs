//! Comments cite pages of the book: `(book: language/letters)` is docs/en/src/language/letters.md. They must not cite pages outside of the
//! repository.

use std::path::Path;

use regex::Regex;

use super::{assert_none, files_below};
use crate::support::project;

#[test]
fn comments_cite_pages_that_are_there() {
    let cited = Regex::new("book: ([a-z0-9-]+/[a-z0-9-]+)").unwrap();
    // Split, so that this file itself contains no citation.
    let elsewhere = Regex::new(&["spe", "c/[0-9]|[Pp]age", " [0-9]{2}[^0-9]"].concat()).unwrap();
    let (mut wrong, mut count) = (Vec::new(), 0);
    for folder in ["crates", "tests", "benches", "fuzz"] {
        for name in sources(&project().join(folder)) {
            let text = std::fs::read_to_string(project().join(folder).join(&name)).unwrap();
            for (number, line) in text.lines().enumerate() {
                let pages = cited.captures_iter(line).map(|found| found[1].to_owned());
                let is_missing = |page: &String| !project().join(format!("docs/en/src/{page}.md")).exists();
                let (missing, there): (Vec<_>, Vec<_>) = pages.partition(is_missing);
                count += there.len();
                if !missing.is_empty() || elsewhere.is_match(line) {
                    wrong.push(format!("{folder}/{name}:{}: {line}", number + 1));
                }
            }
        }
    }
    assert!(count > 200, "{count} citations: the rule for them has changed");
    assert_none(&wrong);
}

fn sources(folder: &Path) -> Vec<String> {
    let is_built = |name: &String| name.contains("node_modules/") || name.contains("target/");
    let files = files_below(folder).into_iter().filter(|name| !is_built(name));
    files.filter(|name| name.ends_with(".rs") || name.ends_with(".ts")).collect()
}
