//! Renders findings as an HTML page: by drawing, each with a picture of its place. It is a single file that loads nothing from the
//! network.

use std::fmt::Write;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_view::escaped;

use super::{RenderedText, View, view};
use pathbuild_workspace::findings::Findings;
use pathbuild_workspace::waivers::WaivedFinding;

/// Renders the page. `pictures` has one entry per finding; `None` if it has no picture.
pub(crate) fn page(findings: &Findings, pictures: &[Option<String>], view: &View) -> RenderedText {
    let title = view.choose("Findings", "Befunde");
    let mut text = format!("<!doctype html>\n<html lang=\"{}\">\n{HEAD}", view.choose("en", "de"));
    _ = writeln!(text, "<title>pathbuild: {title}</title>\n{STYLE}\n<h1>{title}</h1>");
    _ = writeln!(text, "<p>{}</p>", summary(findings, view));
    let mut file = None;
    for (diagnostic, picture) in findings.diagnostics.iter().zip(pictures) {
        if file != Some(&diagnostic.file) {
            if file.is_some() {
                text.push_str("</section>\n");
            }
            let name = view.raw_file(diagnostic);
            let name = name.as_deref().map_or_else(|| "pathbuild".to_owned(), escaped);
            _ = writeln!(text, "<section>\n<h2>{name}</h2>");
            file = Some(&diagnostic.file);
        }
        add_finding(&mut text, diagnostic, picture.as_deref(), view);
    }
    if file.is_some() {
        text.push_str("</section>\n");
    }
    add_accepted(&mut text, findings, view);
    RenderedText(text + "</html>\n")
}

/// Adds the findings that are accepted for a stated reason.
fn add_accepted(text: &mut String, findings: &Findings, view: &View) {
    let stated = findings.waived.iter().filter_map(|waived| Some((waived, waived.waiver.reason.as_deref()?)));
    let mut items = String::new();
    for (WaivedFinding { diagnostic, waiver }, reason) in stated {
        let place = view::location(diagnostic, view).unwrap_or_default();
        let until =
            waiver.until.map(|date| view.choose("until {}", "bis {}").replace("{}", &date.to_string()));
        let parts = [escaped(&place), escaped(&view::element(diagnostic, view)), until.unwrap_or_default()];
        let parts: Vec<String> = parts.into_iter().filter(|part| !part.is_empty()).collect();
        _ = writeln!(
            items,
            "<article>\n<div>\n<h3>{} <small>{}</small></h3>\n<p>{}</p>\n<p class=\"help\">{}</p>\n<p class=\"place\">{}</p>\n</div>\n</article>",
            diagnostic.code(),
            diagnostic.code().name(),
            lines(&diagnostic.text(view.lang)),
            lines(reason),
            parts.join(" · "),
        );
    }
    if !items.is_empty() {
        let title = view.choose("Accepted", "Hingenommen");
        _ = writeln!(text, "<section>\n<h2>{title}</h2>\n{items}</section>");
    }
}

fn summary(findings: &Findings, view: &View) -> String {
    let (errors, warnings) = (findings.error_count(), findings.warning_count());
    let (error, warning) = (view.choose("errors", "Fehler"), view.choose("warnings", "Warnungen"));
    let mut parts = vec![format!("{error}: {errors}"), format!("{warning}: {warnings}")];
    let paths: usize = findings.checked.iter().map(|file| file.paths.len()).sum();
    let checked = [
        (view.choose("paths", "Pfade"), paths),
        (view.choose("drawings", "Zeichnungen"), findings.checked.len()),
        (view.choose("programs", "Programme"), findings.programs.len()),
    ];
    parts.extend(
        checked.iter().filter(|(_, count)| *count > 0).map(|(noun, count)| format!("{noun}: {count}")),
    );
    parts.join(" · ")
}

/// Adds one finding: picture, code, message, help, place.
fn add_finding(text: &mut String, diagnostic: &Diagnostic, picture: Option<&str>, view: &View) {
    let severity = diagnostic.severity.word(view.lang);
    let class = if diagnostic.is_error() { "error" } else { "warning" };
    let (code, name) = (diagnostic.code(), diagnostic.code().name());
    _ = writeln!(text, "<article class=\"{class}\">");
    if let Some(picture) = picture {
        text.push_str(picture);
    }
    _ = writeln!(text, "<div>\n<h3>{severity} {code} <small>{name}</small></h3>");
    _ = writeln!(text, "<p>{}</p>", lines(&diagnostic.text(view.lang)));
    for line in view.help(diagnostic).iter().flat_map(|help| help.lines()) {
        _ = writeln!(text, "<p class=\"help\">{}</p>", escaped(line));
    }
    if let Some(fault) = &diagnostic.text {
        _ = writeln!(text, "<pre>{}</pre>", lines(&fault.text));
    }
    let location = view::location(diagnostic, view).unwrap_or_default();
    let parts = [location, view::element(diagnostic, view)];
    let parts: Vec<String> = parts.iter().filter(|part| !part.is_empty()).map(|part| escaped(part)).collect();
    _ = writeln!(text, "<p class=\"place\">{}</p>", parts.join(" · "));
    for step in &diagnostic.trace {
        _ = writeln!(text, "<p class=\"place\">{}</p>", escaped(&view::embedding(step, view)));
    }
    text.push_str("</div>\n</article>\n");
}

/// Escapes a text and separates its lines with `<br>`.
fn lines(text: &str) -> String {
    text.lines().map(escaped).collect::<Vec<_>>().join("<br>")
}

const HEAD: &str = "<meta charset=\"utf-8\">
<meta name=\"viewport\" content=\"width=device-width\">
<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'\">
";

const STYLE: &str = "<style>
body { font: 15px/1.45 'DejaVu Sans', Verdana, sans-serif; color: #14202b; max-width: 1080px; margin: 24px auto; padding: 0 16px }
h1 { font-size: 22px } h2 { font-size: 17px; border-bottom: 1px solid #b8bfc6; overflow-wrap: anywhere } h3 { font-size: 15px; margin: 0 }
small, .place { color: #4a5a68; font-weight: normal; font-size: 13px } p { margin: 4px 0; overflow-wrap: anywhere }
article { display: flex; flex-wrap: wrap; gap: 16px; margin: 14px 0; padding-left: 10px; border-left: 4px solid #b58900; break-inside: avoid }
article.error { border-color: #d55e00 } article > div { flex: 1 1 320px; min-width: 0 }
svg { border: 1px solid #d5dadf; max-width: 100%; height: auto } pre { background: #f1f4f6; padding: 4px 8px; overflow-x: auto }
.help { padding-left: 14px; border-left: 2px solid #d5dadf }
@media screen and (prefers-color-scheme: dark) {
  body { background: #11181f; color: #e4ebf1 } small, .place { color: #9dacba }
  h2, svg, .help { border-color: #4a5a68 } pre { background: #1f2a34 }
}
</style>";
