//! Converts the entities of a drawing to raw paths: groups them by layer, determines their meaning and assigns the texts. (book:
//! reference/dxf)

mod assign;
mod broken_outlines;
mod candidates;
mod collect;
mod entities;
mod keep_outs;
mod likely_parameters;
mod listing;
mod near_names;
mod outline_graph;
mod parameters;
mod parts;
mod rings;
mod stray;
mod texts;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::drawing::BLOCK_MISSING;
use pathbuild_dxf::Drawing;

use crate::element::Origin;
use crate::language::Language;
use crate::letter::Letter;
use crate::raw::RawFile;
use crate::read::assign::check_other_paths;
use crate::read::collect::PathCollector;
use crate::read::parameters::{Start, Starts};

pub use entities::{AnyText, TextCircle};
pub use keep_outs::keep_outs;
pub use likely_parameters::may_be_stray_text;
pub use listing::{AssignedElement, AssignedText, ProxyLine, assigned_texts, proxy_lines};
pub use near_names::{NearNames, is_near_clamps_or_parts};
pub use parts::{has_text_on_part, parts};
pub use stray::stray_findings;

/// Finds the paths of a drawing; none if the drawing itself has errors.
pub fn raw_file(drawing: &Drawing, language: &Language) -> RawFile {
    let mut collected = collect::paths(drawing, language);
    let without_elements = collected.extract_if(.., |path| !path.has_elements).collect::<Vec<_>>();
    // PB117 reports missing blocks among the clamps.
    let is_clamp = |found: &&Diagnostic| {
        found.message == &BLOCK_MISSING
            && found.place.layer.as_deref().is_some_and(|layer| language.is_keep_out(layer))
    };
    let mut diagnostics: Vec<_> =
        drawing.diagnostics.iter().filter(|found| !is_clamp(found)).cloned().collect();
    for path in without_elements {
        diagnostics.extend(path.orphan_findings());
    }
    for path in &mut collected {
        path.assign_texts(language);
    }
    check_other_paths(&mut collected, language.doubts.text_margin);
    let starts = starts(&collected);
    RawFile { paths: collected.into_iter().map(|path| path.finish(&starts)).collect(), diagnostics }
}

/// Returns the start texts of all paths; empty if no start refers to another path with @.
fn starts(paths: &[PathCollector<'_>]) -> Starts {
    let texts = paths.iter().filter_map(|path| {
        let start = path.start.as_ref()?;
        let text = path.given.get(start.text?)?;
        Some((path, text, text.letters.contains(Letter::At), &start.origin))
    });
    if !texts.clone().any(|(_, _, borrows, _)| borrows) {
        return Starts::new();
    }
    let start =
        |text: &str, borrows, origin: &Origin| Start { text: text.into(), borrows, origin: origin.clone() };
    texts
        .map(|(path, text, borrows, origin)| (path.name.clone(), start(text.as_str(), borrows, origin)))
        .collect()
}
