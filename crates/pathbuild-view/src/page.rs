//! The page that shows a scene: one self-contained HTML file. Its script is written in TypeScript (page/src) and built by esbuild; the
//! result is committed, and CI compares it with the source.

use pathbuild_diagnostic::Lang;

use crate::scene::Scene;
use crate::svg::{VisibleParts, escaped, svg};

const TEMPLATE: &str = include_str!("../page/page.html");
const LIVE_TEMPLATE: &str = include_str!("../page/live.html");
const VIEWER: &str = include_str!("../page/viewer.html");
const STYLE: &str = include_str!("../page/style.css");

/// The script of both the self-contained page and the live page.
pub const SCRIPT: &str = include_str!("../page/dist/page.js");

/// The style sheet of the live page.
pub const LIVE_STYLE: &str = concat!(include_str!("../page/style.css"), include_str!("../page/live.css"));

/// Renders a scene as a self-contained page.
pub fn page(scene: &Scene, lang: Lang) -> String {
    let title = escaped(&scene.title);
    // Rename the ids in the picture, because other elements of the page have the same ones.
    let still = svg(scene, VisibleParts::all(lang))
        .replace(" id=\"", " id=\"still-")
        .replace("=\"url(#frame)", "=\"url(#still-frame)");
    // Only `<` could end the script element that contains the data.
    let data = scene.to_json().replace('<', "\\u003c");
    let viewer = fill_placeholders(VIEWER, &|name| match name {
        "title" => &title,
        "svg" => &still,
        _ => "",
    });
    fill_placeholders(TEMPLATE, &|name| match name {
        "lang" => lang.choose("en", "de"),
        "title" => &title,
        "style" => STYLE,
        "viewer" => &viewer,
        "scene" => &data,
        "script" => SCRIPT,
        _ => "",
    })
}

/// Returns the live page, which requests its script ([`SCRIPT`]), its style ([`LIVE_STYLE`]) and its data from the server.
pub fn live_page(lang: Lang) -> String {
    let viewer = fill_placeholders(VIEWER, &|_| "");
    fill_placeholders(LIVE_TEMPLATE, &|name| match name {
        "lang" => lang.choose("en", "de"),
        "viewer" => &viewer,
        _ => "",
    })
}

/// Replaces the placeholders `{{name}}` of a template by their values.
fn fill_placeholders<'a>(template: &str, value: &dyn Fn(&str) -> &'a str) -> String {
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
