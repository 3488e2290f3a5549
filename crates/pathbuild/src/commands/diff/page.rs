//! A comparison as a single HTML file that loads nothing from the network.

use std::fmt::Write;

use pathbuild_diagnostic::Lang;
use pathbuild_view::escaped;
use pathbuild_workspace::diff::{Comparison, Outcome, PathDiff, PictureSet};

use super::text::{details, outcome, place, problems, summary};

const TEMPLATE: &str = include_str!("page.html");

/// Renders the page.
pub(super) fn page(comparison: &Comparison, lang: Lang) -> String {
    let (before, behind) = TEMPLATE.split_once("{{paths}}").unwrap_or((TEMPLATE, ""));
    let code = lang.choose("en", "de");
    let title = format!("pathbuild diff: {}", summary(comparison, lang));
    let mut page = before.replace("{{lang}}", code).replace("{{title}}", &escaped(&title));
    for problem in problems(comparison, lang) {
        _ = writeln!(page, "<p>{}</p>", escaped(&problem));
    }
    for path in &comparison.paths {
        section(&mut page, path, comparison, lang);
    }
    page.push_str(behind);
    page
}

fn section(page: &mut String, path: &PathDiff, comparison: &Comparison, lang: Lang) {
    _ = writeln!(
        page,
        "<section>\n<h2>{} <small>{}</small></h2>\n<p>{}</p>",
        escaped(&path.name),
        escaped(&place(path)),
        outcome(path, comparison, lang)
    );
    if let Outcome::Changed(program) = &path.outcome {
        page.push_str("<ul>\n");
        for line in details(program, lang) {
            _ = writeln!(page, "<li>{}</li>", escaped(&line));
        }
        page.push_str("</ul>\n");
        if let Some(pictures) = &program.pictures {
            show(page, pictures, lang);
        }
    }
    page.push_str("</section>\n");
}

/// Shows the pictures in three ways. Without scripts, only the changes are visible.
fn show(page: &mut String, PictureSet { changes, old, new }: &PictureSet, lang: Lang) {
    let button = |way: &str, en, de| format!("<button data-way=\"{way}\">{}</button>", lang.choose(en, de));
    let label = lang.choose("old to new", "alt bis neu");
    _ = writeln!(
        page,
        "<div class=\"pictures\" data-way=\"changes\">\n<nav>{}{}{}</nav>\n<div class=\"changes\">{changes}</div>\n\
         <div class=\"beside\"><div>{old}</div><div>{new}</div></div>\n\
         <div class=\"over\"><input type=\"range\" min=\"0\" max=\"100\" value=\"50\" aria-label=\"{label}\">\
         <div class=\"stack\"><div>{old}</div><div class=\"new\">{new}</div></div></div>\n</div>",
        button("changes", "changes", "Änderungen"),
        button("beside", "side by side", "nebeneinander"),
        button("over", "overlaid", "übereinander"),
    );
}
