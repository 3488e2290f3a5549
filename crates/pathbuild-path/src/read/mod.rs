//! Converts the entities of a drawing to raw paths: groups them by layer, determines their meaning and assigns the texts. (book:
//! reference/dxf)

mod checked;
mod collect;
mod found_text;
mod keep_outs;
mod layers;
mod listing;
mod markers;
mod meaning;
mod parameters;
mod proxies;
mod rings;
mod stray;
mod texts;

use std::collections::BTreeMap;

use pathbuild_diagnostic::{Diagnostic, Place};
use pathbuild_dxf::Drawing;

use crate::element::{Origin, shown};
use crate::geometry::Xy;
use crate::letter::Letter;
use crate::names::PathName;
use crate::raw::{Language, RawFile};

use collect::PathCollector;

pub(crate) use collect::Owner;
pub(crate) use rings::{Part, Ring, rings};

pub use keep_outs::keep_outs;
pub use listing::{AssignedElement, AssignedText, assigned_texts};
pub use proxies::{ProxyLine, proxy_lines};
pub use stray::{NearNames, may_be_stray_text, stray_findings};

/// Finds the paths of a drawing; none if the drawing itself has errors.
pub fn raw_file(drawing: &Drawing, language: &Language) -> RawFile {
    let mut collected = collect::paths(drawing, language);
    let without_elements = collected.extract_if(.., |path| !path.has_elements()).collect::<Vec<_>>();
    let mut diagnostics = drawing.diagnostics.clone();
    for path in without_elements {
        diagnostics.extend(path.orphans());
    }
    for path in &mut collected {
        path.assign_texts(language);
    }
    let starts = starts(&collected);
    RawFile { paths: collected.into_iter().map(|path| path.finish(&starts)).collect(), diagnostics }
}

/// Places a problem at an entity of a drawing.
fn at_entity(drawing: &Drawing, entity: usize, point: Xy, problem: Diagnostic) -> Diagnostic {
    let (kind, origin) = (drawing.entities[entity].kind, drawing.origins[entity]);
    let layer = &drawing.layers[drawing.entities[entity].layer as usize];
    let place = Place {
        line: Some(origin.line),
        handle: origin.handle,
        entity: Some(kind),
        layer: Some(layer.name.clone()),
        point: Some(shown(point)),
        ..Place::default()
    };
    Diagnostic { place, ..problem }
}

/// The start texts of all paths, for references by @; empty if there are no references.
type Starts = BTreeMap<PathName, Start>;

struct Start {
    text: Box<str>,
    /// Whether it refers to another path itself.
    borrows: bool,
    origin: Origin,
}

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
