//! The page: one HTML file that asks the network for nothing. Its script is written in TypeScript (page/src) and built by esbuild; what is
//! built is committed, and CI holds it against its source.

use pathbuild_diagnostic::Lang;

use crate::scene::Scene;
use crate::svg::{Shown, escaped, svg};

const TEMPLATE: &str = include_str!("../page/page.html");
const LIVE_TEMPLATE: &str = include_str!("../page/live.html");
const VIEWER: &str = include_str!("../page/viewer.html");
const STYLE: &str = include_str!("../page/style.css");

/// The script of both pages.
pub const SCRIPT: &str = include_str!("../page/dist/page.js");

/// The style of the page that is live.
pub const LIVE_STYLE: &str = concat!(include_str!("../page/style.css"), include_str!("../page/live.css"));

/// The scene as a page.
pub fn page(scene: &Scene, lang: Lang) -> String {
    let title = escaped(&scene.title);
    // In the page other elements have these names.
    let still = svg(scene, Shown::all(lang))
        .replace(" id=\"", " id=\"still-")
        .replace("=\"url(#frame)", "=\"url(#still-frame)");
    // Within a script's text only `<` could end it.
    let data = scene.to_json().replace('<', "\\u003c");
    let viewer = filled(VIEWER, &|name| match name {
        "title" => &title,
        "svg" => &still,
        _ => "",
    });
    filled(TEMPLATE, &|name| match name {
        "lang" => code(lang),
        "title" => &title,
        "style" => STYLE,
        "viewer" => &viewer,
        "scene" => &data,
        "script" => SCRIPT,
        _ => "",
    })
}

/// The page that is live: it asks the server that gave it out for its script ([`SCRIPT`]), its style ([`LIVE_STYLE`]) and what it shows.
pub fn live_page(lang: Lang) -> String {
    let viewer = filled(VIEWER, &|_| "");
    filled(LIVE_TEMPLATE, &|name| match name {
        "lang" => code(lang),
        "viewer" => &viewer,
        _ => "",
    })
}

fn code(lang: Lang) -> &'static str {
    match lang {
        Lang::De => "de",
        Lang::En => "en",
    }
}

/// A template with something in the place of each `{{name}}`.
fn filled<'a>(template: &str, value: &dyn Fn(&str) -> &'a str) -> String {
    let mut page = String::with_capacity(template.len());
    let mut rest = template;
    while let Some((before, (name, after))) =
        rest.split_once("{{").and_then(|(before, behind)| Some((before, behind.split_once("}}")?)))
    {
        page.push_str(before);
        page.push_str(value(name));
        rest = after;
    }
    page.push_str(rest);
    page
}
