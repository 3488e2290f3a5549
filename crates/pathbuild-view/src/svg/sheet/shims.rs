//! The shims under raised material (H), and the pieces of material that lie at different heights. (book: program/sheet)

use pathbuild_diagnostic::Lang;

use super::data::{Sheet, distinct, localized_mm};
use crate::scene::{EmbeddedPath, MoveKind, ScenePath};
use crate::svg::canvas::mm;
use crate::svg::legend::ranges;

/// Maximum number of runs of numbers in one step of the checklist, which must fit on a page.
const MAX_RUNS: usize = 40;

/// Minimum depth in mm of a reported cut into shims. Smaller depths are only rounding errors.
const MIN_CUT: f64 = 0.0005;

/// Consecutive numbers of elements of one piece of material: an embedded path, with the paths in it that lie at the same height.
#[derive(Debug)]
struct Run<'s> {
    /// Height of the shims and Z of the material's upper face in mm.
    heights: [f64; 2],
    /// Name of the piece's path.
    name: &'s str,
    /// Name of the material (M).
    material: Option<&'s str>,
    numbers: Vec<u32>,
    /// Lowest Z of the cuts in mm.
    lowest: f64,
}

/// Describes the shims, with the numbers of the elements whose material lies on them: one sentence for each height and upper face.
pub(super) fn checks(sheet: &Sheet, lang: Lang) -> Vec<String> {
    let mut raised: Vec<Run<'_>> = sheet.scene.paths.iter().flat_map(runs).collect();
    raised.retain(|run| run.heights[0] > 0.0);
    let sentences = |heights| {
        let runs: Vec<&Run<'_>> = raised.iter().filter(|run| run.heights == heights).collect();
        runs.chunks(MAX_RUNS).map(|runs| sentence(runs, heights, lang)).collect::<Vec<_>>()
    };
    distinct(raised.iter().map(|run| run.heights)).into_iter().flat_map(sentences).collect()
}

/// Returns the number of different positions of milled material in Z, each given by the heights of its lower and its upper face.
pub(super) fn height_count(sheet: &Sheet) -> usize {
    distinct(sheet.scene.paths.iter().flat_map(runs).map(|run| run.heights)).len()
}

/// Returns the materials (M) of the paths and of the milled pieces, each once.
pub(super) fn materials(sheet: &Sheet) -> Vec<&str> {
    distinct(materials_with_thickness(sheet).into_iter().filter_map(|(material, _)| material))
}

/// Returns the distinct thicknesses (T) in mm of the paths and of the milled pieces, in ascending order: only those of this material, or all if
/// `material` is `None`.
pub(super) fn thicknesses(sheet: &Sheet, material: Option<&str>) -> Vec<f64> {
    let sheets = materials_with_thickness(sheet).into_iter();
    let of_material = sheets.filter(|(other, _)| material.is_none() || *other == material);
    let mut thicknesses = distinct(of_material.filter_map(|(_, thickness)| thickness));
    thicknesses.sort_by(f64::total_cmp);
    thicknesses
}

/// Returns M and T in mm of the paths and of the milled pieces.
fn materials_with_thickness(sheet: &Sheet) -> Vec<(Option<&str>, Option<f64>)> {
    let paths = sheet.scene.paths.iter();
    let pieces = paths.clone().flat_map(runs);
    let pieces = pieces.map(|run| (run.material, Some(rounded(run.heights[1] - run.heights[0]))));
    paths.map(|path| (path.material.as_deref(), path.thickness.map(rounded))).chain(pieces).collect()
}

/// Rounds a length to a thousandth of a millimetre.
fn rounded(length: f64) -> f64 {
    (length * 1000.0).round() / 1000.0
}

/// Returns the distinct Z of the upper faces of milled material in ascending order; `None` if no material lies on shims.
pub(super) fn upper_faces(sheet: &Sheet) -> Option<Vec<f64>> {
    let runs: Vec<Run<'_>> = sheet.scene.paths.iter().flat_map(runs).collect();
    let mut tops = distinct(runs.iter().map(|run| run.heights[1]));
    tops.sort_by(f64::total_cmp);
    runs.iter().any(|run| run.heights[0] > 0.0).then_some(tops)
}

fn sentence(runs: &[&Run<'_>], [height, top]: [f64; 2], lang: Lang) -> String {
    let piece = |name: &str| {
        let numbers = runs.iter().filter(|run| run.name == name).flat_map(|run| &run.numbers);
        let numbers = ranges(&numbers.copied().collect::<Vec<_>>());
        lang.choose(format!("{name} (No. {numbers})"), format!("{name} (Nr. {numbers})"))
    };
    let pieces =
        distinct(runs.iter().map(|run| run.name)).into_iter().map(piece).collect::<Vec<_>>().join(", ");
    let depth = height - runs.iter().map(|run| run.lowest).fold(f64::INFINITY, f64::min);
    let cut = (depth > MIN_CUT).then(|| localized_mm(depth, lang)).map(|depth| {
        lang.choose(
            format!("; they are cut {depth} mm deep"),
            format!("; sie werden {depth} mm tief angefräst"),
        )
    });
    let (height, top, cut) = (localized_mm(height, lang), mm(top), cut.unwrap_or_default());
    lang.choose(
        format!("Shims of {height} mm lie under the material of {pieces}, whose upper face is at Z {top}{cut}"),
        format!("{height} mm hohe Unterlagen liegen unter dem Material von {pieces}, dessen Oberseite bei Z {top} ist{cut}"),
    )
}

/// Returns the numbers of a path's elements by pieces of material, in ascending order.
fn runs(path: &ScenePath) -> Vec<Run<'_>> {
    let elements = path.elements.iter().zip(path.depths(MoveKind::cuts));
    let mut numbered: Vec<(u32, &EmbeddedPath, f64)> = elements
        .filter_map(|(element, lowest)| Some((element.order?, piece(path, element.path as usize)?, lowest?)))
        .collect();
    numbered.sort_by_key(|(number, ..)| *number);
    let mut runs: Vec<Run<'_>> = Vec::new();
    for (number, piece, lowest) in numbered {
        let heights = [piece.raised, piece.thickness].map(rounded);
        let material = piece.material.as_deref();
        match runs.last_mut() {
            Some(last) if (last.name, last.heights, last.material) == (&piece.name, heights, material) => {
                last.numbers.push(number);
                last.lowest = last.lowest.min(lowest);
            }
            _ => runs.push(Run { heights, name: &piece.name, material, numbers: vec![number], lowest }),
        }
    }
    runs
}

/// Returns the outermost path whose material an embedded path shares: all paths between the two lie at the same height, are as thick, and have the
/// same M.
fn piece(path: &ScenePath, occurrence: usize) -> Option<&EmbeddedPath> {
    let mut piece = path.embedded.get(occurrence)?;
    while let Some(by) = piece.by {
        let embedder = path.embedded.get(path.elements.get(by as usize)?.path as usize)?;
        let is_same_sheet = (embedder.raised, embedder.thickness) == (piece.raised, piece.thickness)
            && embedder.material == piece.material;
        if !is_same_sheet {
            break;
        }
        piece = embedder;
    }
    Some(piece)
}
