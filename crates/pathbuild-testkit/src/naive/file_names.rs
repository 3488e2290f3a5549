//! Compares file names with the paths that they announce. (book: language/layers-and-names)

use std::sync::LazyLock;

use pathbuild_diagnostic::Diagnostic;
use regex::Regex;

use super::names::{may_hold, pattern, stem};
use super::{Drawing, Finding};

static FULL: LazyLock<Regex> =
    LazyLock::new(|| pattern(r"(?i)\b([0-9]{4})[.]([0-9]+)([A-Z])(?:[^0-9A-Z]|$)"));
static END: LazyLock<Regex> =
    LazyLock::new(|| pattern(r"(?i)[0-9]{4}(?:[.][0-9]+)?[A-Z]? *[-\u{2013}] *[0-9]{4}(?:[.][0-9]+)?[A-Z]?"));

impl Drawing {
    /// Findings about the name of the drawing.
    pub(super) fn name_faults(&self) -> Vec<Finding> {
        let stem = stem(&self.path);
        if stem.to_lowercase().ends_with("_q") || self.content.diagnostics.iter().any(Diagnostic::is_error) {
            return Vec::new();
        }
        let held: Vec<String> =
            self.content.paths.iter().map(|(raw, _)| raw.name.to_string().to_uppercase()).collect();
        // Commas keep the parts before and after a range separate.
        let singles = END.replace_all(stem, ",");
        let finding = |code: &str, name: &str, path: Option<String>| Finding {
            code: code.to_owned(),
            file: self.path.clone(),
            path,
            words: vec![name.to_owned()],
            ..Finding::default()
        };
        let mut found = Vec::new();
        for promised in FULL.captures_iter(&singles) {
            let same = |name: &String| {
                let number = |text: &str| text.trim_start_matches('0').to_owned();
                let Some((first, rest)) = name.split_once('.') else { return false };
                let (second, letter) = rest.split_at(rest.len() - 1);
                first == &promised[1]
                    && number(second) == number(&promised[2])
                    && letter == promised[3].to_uppercase()
            };
            if !held.iter().any(same) {
                let name = format!("{}.{}{}", &promised[1], &promised[2], &promised[3]);
                found.push(finding("PB519", &name, None));
            }
        }
        for (raw, _) in &self.content.paths {
            if !may_hold(stem, raw.name.as_str()) {
                found.push(finding("PB521", raw.name.as_str(), Some(raw.name.to_string())));
            }
        }
        found
    }
}
