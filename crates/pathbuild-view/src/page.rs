//! The page: one HTML file that asks the network for nothing. Its script is written in TypeScript (page/src) and built by esbuild; what is
//! built is committed, and CI holds it against its source.

use pathbuild_diagnostic::Lang;

use crate::scene::Scene;
use crate::svg::{Shown, escaped, svg};

const TEMPLATE: &str = include_str!("../page/page.html");
const STYLE: &str = include_str!("../page/style.css");
const SCRIPT: &str = include_str!("../page/dist/page.js");

/// The scene as a page.
pub fn page(scene: &Scene, lang: Lang) -> String {
    let title = escaped(&scene.title);
    // In the page other elements have these names.
    let still =
        svg(scene, Shown::all(lang)).replace(" id=\"", " id=\"still-").replace("(#frame)", "(#still-frame)");
    // Within a script's text only `<` could end it.
    let data = scene.to_json().replace('<', "\\u003c");
    let mut page = String::with_capacity(TEMPLATE.len() + SCRIPT.len() + data.len() + still.len());
    let mut rest = TEMPLATE;
    while let Some((before, (name, after))) =
        rest.split_once("{{").and_then(|(before, behind)| Some((before, behind.split_once("}}")?)))
    {
        page.push_str(before);
        page.push_str(match name {
            "lang" if lang == Lang::De => "de",
            "lang" => "en",
            "title" => &title,
            "style" => STYLE,
            "svg" => &still,
            "scene" => &data,
            "script" => SCRIPT,
            _ => "",
        });
        rest = after;
    }
    page.push_str(rest);
    page
}
