//! Findings about cuts into the parts of a drawing, and about material that the cuts leave at them. (book: language/part)

use std::collections::BTreeSet;
use std::sync::Arc;

use pathbuild_diagnostic::messages::part as messages;
use pathbuild_diagnostic::{Code, Diagnostic};
use pathbuild_path::{Curve, Part, PartFindings, PathCuts, check_parts, parts as read_parts};

use crate::database::Db;
use crate::inputs::{Reading, Settings, SourceFile};
use crate::queries::embedding::{Instance, chains, path};
use crate::queries::index::{FileParts, cuts_of, file_index, lower_to_warnings, path_index};
use crate::queries::raw::read_layers_with_options;

/// Returns the parts and cuts of a drawing; `None` if the settings name no layers with parts, or if it has neither parts nor paths that embed others.
pub(super) fn file_parts(db: &dyn Db, file: SourceFile) -> Option<&FileParts> {
    // Most libraries have no parts; no query is needed then.
    Settings::get(db).language(db).part.as_ref()?;
    indexed_parts(db, file).as_deref()
}

/// Returns the parts and cuts in a drawing's index, unaffected by edits of anything else in it.
#[salsa::tracked]
fn indexed_parts(db: &dyn Db, file: SourceFile) -> Option<Arc<FileParts>> {
    file_index(db, file).parts.clone()
}

/// Returns the result of checking a drawing's parts, with example values for the variables of its paths. `None` if it has no parts.
pub(super) fn example_findings(db: &dyn Db, file: SourceFile) -> Option<&PartFindings> {
    let has_parts = file_parts(db, file).is_some_and(|found| !found.parts.is_empty());
    has_parts.then(|| checked_parts(db, file))
}

#[salsa::tracked]
fn checked_parts(db: &dyn Db, file: SourceFile) -> PartFindings {
    let (Some(settings), Some(found)) = (&Settings::get(db).language(db).part, file_parts(db, file)) else {
        return PartFindings::default();
    };
    let cuts: Vec<&PathCuts> = found.cuts.iter().collect();
    let mut findings = check_parts(&found.parts, &cuts, found.is_complete, settings);
    lower_to_warnings(db, findings.of_paths.iter_mut().flatten());
    findings
}

/// Returns the result of checking the parts of a path's drawing with the path's values, and with example values for the variables of the drawing's
/// other paths; and the path's index in that result. `None` if the drawing has no parts, or if the path's cuts are unknown.
pub(super) fn part_findings<'db>(
    db: &'db dyn Db,
    instance: Instance<'db>,
) -> Option<(&'db PartFindings, usize)> {
    let file = instance.file(db);
    let example = example_findings(db, file)?;
    let place = file_parts(db, file)?.index_of_path(&instance.name(db).name(db));
    if is_example(db, instance) {
        return Some((example, place?));
    }
    let findings = parts_checked_with_values(db, instance);
    (!findings.of_paths.is_empty()).then_some((findings, place.unwrap_or_default()))
}

#[salsa::tracked]
fn parts_checked_with_values<'db>(db: &'db dyn Db, instance: Instance<'db>) -> PartFindings {
    let (Some(settings), Some(found), Some(own)) =
        (&Settings::get(db).language(db).part, file_parts(db, instance.file(db)), path_cuts(db, instance))
    else {
        return PartFindings::default();
    };
    let mut findings = match found.index_of_path(&instance.name(db).name(db)) {
        Some(place) => {
            let mut cuts: Vec<&PathCuts> = found.cuts.iter().collect();
            cuts[place] = own;
            check_parts(&found.parts, &cuts, found.is_complete, settings)
        }
        None => check_parts(&found.parts, &[own], false, settings),
    };
    lower_to_warnings(db, findings.of_paths.iter_mut().flatten());
    findings
}

/// Returns the findings about the cuts of a path into the parts of its drawing, and about the material that it leaves at them.
pub(super) fn part_problems<'db>(db: &'db dyn Db, instance: Instance<'db>) -> &'db [Diagnostic] {
    let Some((findings, place)) = part_findings(db, instance) else { return &[] };
    if is_example(db, instance) { &findings.of_paths[place] } else { part_problems_with_values(db, instance) }
}

/// Returns the findings about a path with its values, and those about other paths of the drawing that its values cause: a part that becomes loose is
/// reported in the first of the paths that cut it out.
#[salsa::tracked]
fn part_problems_with_values<'db>(db: &'db dyn Db, instance: Instance<'db>) -> Vec<Diagnostic> {
    let (Some((findings, place)), Some(example)) =
        (part_findings(db, instance), example_findings(db, instance.file(db)))
    else {
        return Vec::new();
    };
    let of_path = |(path, found): (usize, &'db Vec<Diagnostic>)| {
        let is_new = move |problem: &&Diagnostic| path == place || !example.of_paths[path].contains(problem);
        found.iter().filter(is_new)
    };
    findings.of_paths.iter().enumerate().flat_map(of_path).cloned().collect()
}

/// Whether a finding about a path is PB212 for a ring in an opening of a part that may belong to the path. Such a ring encloses waste; whether the
/// part itself is held is checked with its outline (PB217).
pub(super) fn is_about_waste<'db>(db: &'db dyn Db, instance: Instance<'db>, problem: &Diagnostic) -> bool {
    let Some(at) = problem.place.point.filter(|_| problem.code() == Code::LostBars) else { return false };
    let path = instance.name(db).name(db);
    let is_opening = |part: &Part| part.may_belong_to(&path) && part.has_opening_at(at);
    file_parts(db, instance.file(db)).is_some_and(|found| found.parts.iter().any(is_opening))
}

/// Returns the cuts of a path with its values. `None` if the path has errors, or if the settings name no layers with parts.
pub(super) fn path_cuts<'db>(db: &'db dyn Db, instance: Instance<'db>) -> Option<&'db PathCuts> {
    let found = file_parts(db, instance.file(db)).filter(|_| is_example(db, instance));
    let known = found.and_then(|found| Some(&found.cuts[found.index_of_path(&instance.name(db).name(db))?]));
    known.or_else(|| cuts_with_values(db, instance).as_ref())
}

#[salsa::tracked]
fn cuts_with_values<'db>(db: &'db dyn Db, instance: Instance<'db>) -> Option<PathCuts> {
    cuts_of(db, path(db, instance).path.as_ref()?, chains(db, instance))
}

/// Returns the parts that a path cuts, among those of its drawing.
pub(super) fn parts_of<'db>(db: &'db dyn Db, instance: Instance<'db>) -> Vec<&'db Part> {
    let (Some(found), Some((findings, place))) =
        (file_parts(db, instance.file(db)), part_findings(db, instance))
    else {
        return Vec::new();
    };
    findings.parts[place].iter().map(|part| &found.parts[*part]).collect()
}

fn is_example<'db>(db: &'db dyn Db, instance: Instance<'db>) -> bool {
    let index = path_index(db, instance.file(db), instance.name(db));
    index.as_ref().is_some_and(|index| index.examples == *instance.bindings(db))
}

/// Returns the outlines of a drawing's parts that no path comes near (PB220).
pub fn uncut_rings(db: &dyn Db, file: SourceFile) -> Vec<&[Curve]> {
    let (Some(found), Some(findings)) = (file_parts(db, file), example_findings(db, file)) else {
        return Vec::new();
    };
    let ring = |(part, ring): &(usize, usize)| Some(&*found.parts.get(*part)?.rings.get(*ring)?.curves);
    findings.uncut.iter().filter_map(ring).collect()
}

/// Returns PB220 for each outline that no path comes near and each layer that names a missing path, and PB223 for each outline in an opening that is
/// cut as a part. The drawing is read again for the positions of the outlines.
pub(super) fn doubtful_outlines(db: &dyn Db, file: SourceFile) -> Vec<Diagnostic> {
    let Some(findings) = example_findings(db, file).filter(|findings| has_doubtful_outlines(findings)) else {
        return Vec::new();
    };
    let language = Settings::get(db).language(db);
    let reading = Reading { compatible: false, ..Settings::get(db).reading(db).clone() };
    let mut drawn =
        read_parts(&read_layers_with_options(db, file, &reading, &|layer| language.is_part(layer)), language);
    let (paths, is_complete) =
        file_parts(db, file).map_or((&[][..], false), |found| (&found.cuts[..], found.is_complete));
    drawn.judge_outlines(paths, is_complete);
    let place = |problem, (part, ring): &(usize, usize)| {
        let place = drawn.places.get(*part)?.get(*ring)?.clone();
        let mut problem = Diagnostic { place, ..problem };
        lower_to_warnings(db, [&mut problem]);
        Some(problem.in_file(file.path(db)))
    };
    // A layer that names a missing path is reported once, not for each of its outlines.
    let mut reported = BTreeSet::new();
    let uncut = findings.uncut.iter().filter_map(|ring| {
        let part = drawn.parts.get(ring.0)?;
        match part.missing_path(paths) {
            Some(problem) => reported.insert(&part.layer).then(|| place(problem, ring))?,
            None => place(Diagnostic::new(&messages::OUTLINE_NOT_CUT), ring),
        }
    });
    let inner =
        findings.inner.iter().filter_map(|ring| place(Diagnostic::new(&messages::PART_IN_OPENING), ring));
    uncut.chain(inner).collect()
}

pub(super) fn has_doubtful_outlines(findings: &PartFindings) -> bool {
    !findings.uncut.is_empty() || !findings.inner.is_empty()
}
