//! The setup sheet of a program: A4 pages, the first with a picture and a checklist. (book: program/sheet)
//!
//! A [`Sheet`] contains the data. It is converted to blocks, which are laid out on pages and drawn as SVG.

mod blocks;
mod data;
mod flow;
mod operations;
mod page;
mod picture;
mod shims;

use std::fmt::Write;

use pathbuild_diagnostic::Lang;
#[cfg(not(feature = "pictures"))]
use pathbuild_diagnostic::{Value, reasons::WITHOUT_PICTURES};

use crate::svg::canvas::escaped;

use data::PAPER;
pub use data::{Sheet, SheetProbe, SheetTool};
pub(crate) use page::sheet_pages;

/// Returns all pages in one SVG file, stacked vertically.
pub fn sheet_svg(sheet: &Sheet, lang: Lang) -> String {
    let pages = sheet_pages(sheet, lang);
    let [width, height] = [PAPER[0], PAPER[1] * pages.len() as f64];
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}mm\" height=\"{height}mm\" viewBox=\"0 0 {width} {height}\">\n"
    );
    text.push_str(&metadata(&sheet.head));
    for (index, page) in pages.iter().enumerate() {
        let top = PAPER[1] * index as f64;
        text.push_str(&page.replacen("<svg ", &format!("<svg y=\"{top}\" "), 1).replace("mm\"", "\""));
    }
    text + "</svg>\n"
}

/// Returns all pages in one HTML file, for viewing and printing.
pub fn sheet_html(sheet: &Sheet, lang: Lang) -> String {
    let code = lang.choose("en", "de");
    let mut text = format!("<!doctype html>\n<html lang=\"{code}\">\n<meta charset=\"utf-8\">\n");
    text.push_str("<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'\">\n");
    _ = writeln!(text, "<title>{}</title>", escaped(&sheet.title));
    _ = writeln!(
        text,
        "<svg width=\"0\" height=\"0\" style=\"display:none\">{}</svg>",
        metadata(&sheet.head)
    );
    text.push_str(STYLE);
    for page in sheet_pages(sheet, lang) {
        text.push_str(&page);
    }
    text + "</html>\n"
}

/// Formats the two lines that identify a sheet, as in the header of a program, as SVG metadata.
pub(crate) fn metadata(head: &[String; 2]) -> String {
    let [provenance, title] = head.each_ref().map(|line| escaped(line));
    format!("<metadata>\n{provenance}\n{title}\n</metadata>\n")
}

/// Formats the two lines that identify a sheet, as in the header of a program, as XMP metadata of a PDF.
#[cfg(feature = "pictures")]
pub(crate) fn xmp(head: &[String; 2]) -> String {
    let [provenance, title] = head.each_ref().map(|line| escaped(line));
    format!(
        "<?xpacket begin=\"\" id=\"W5M0MpCehiHzreSzNTczkc9d\"?>\n<x:xmpmeta xmlns:x=\"adobe:ns:meta/\">\n<rdf:RDF xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">\n<rdf:Description rdf:about=\"\" xmlns:dc=\"http://purl.org/dc/elements/1.1/\">\n<dc:description><rdf:Alt><rdf:li xml:lang=\"x-default\">\n{provenance}\n{title}\n</rdf:li></rdf:Alt></dc:description>\n</rdf:Description>\n</rdf:RDF>\n</x:xmpmeta>\n<?xpacket end=\"r\"?>"
    )
}

/// Reports that PDF is not supported in this build.
///
/// # Errors
/// Always, because PDF requires the feature `pictures`.
#[cfg(not(feature = "pictures"))]
pub fn sheet_pdf(_: &Sheet, _: Lang) -> Result<Vec<u8>, Value> {
    Err((&WITHOUT_PICTURES).into())
}

const STYLE: &str = "<style>
@page { size: A4 portrait; margin: 0 }
body { margin: 0; background: #d5dadf }
svg { display: block; margin: 4mm auto; background: #fff }
@media print { body { background: none } svg { margin: 0; break-after: page } svg:last-of-type { break-after: auto } }
</style>
";
