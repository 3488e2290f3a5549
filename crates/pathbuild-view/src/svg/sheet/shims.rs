//! The shims under raised material (H), and the pieces of material that lie at different heights. (book: program/sheet)

use super::data::{Sheet, Words, distinct};
use crate::scene::{EmbeddedPath, ScenePath};
use crate::svg::canvas::mm;
use crate::svg::legend::ranges;

/// Maximum number of runs of numbers in one step of the checklist, which must fit on a page.
const MAX_RUNS: usize = 40;

/// Consecutive numbers of elements of one piece of material: an embedded path, with the paths in it that lie at the same height.
#[derive(Debug)]
struct Run<'s> {
    /// Height of the shims and Z of the material's upper face in mm.
    heights: [f64; 2],
    /// Name of the piece's path.
    name: &'s str,
    numbers: Vec<u32>,
}

/// Describes the shims, with the numbers of the elements whose material lies on them: one sentence for each height and upper face.
pub(super) fn checks(sheet: &Sheet, words: Words) -> Vec<String> {
    let paths = &sheet.scene.paths;
    let of_path = |path| {
        let raised: Vec<Run<'_>> = runs(path).into_iter().filter(|run| run.heights[0] > 0.0).collect();
        let within = (paths.len() > 1).then_some(path.name.as_str());
        let sentences = |heights| {
            let runs: Vec<&Run<'_>> = raised.iter().filter(|run| run.heights == heights).collect();
            runs.chunks(MAX_RUNS).map(|runs| sentence(runs, heights, within, words)).collect::<Vec<_>>()
        };
        distinct(raised.iter().map(|run| run.heights)).into_iter().flat_map(sentences).collect::<Vec<_>>()
    };
    paths.iter().flat_map(of_path).collect()
}

/// Returns the number of different heights at which milled material lies.
pub(super) fn height_count(sheet: &Sheet) -> usize {
    distinct(sheet.scene.paths.iter().flat_map(runs).map(|run| run.heights[0])).len()
}

fn sentence(runs: &[&Run<'_>], [height, top]: [f64; 2], within: Option<&str>, words: Words) -> String {
    let piece = |name: &str| {
        let numbers = runs.iter().filter(|run| run.name == name).flat_map(|run| &run.numbers);
        let numbers = ranges(&numbers.copied().collect::<Vec<_>>());
        words.choose(format!("{name} (No. {numbers})"), format!("{name} (Nr. {numbers})"))
    };
    let pieces =
        distinct(runs.iter().map(|run| run.name)).into_iter().map(piece).collect::<Vec<_>>().join(", ");
    let within = within.map(|name| format!(" in {name}")).unwrap_or_default();
    let (height, top) = (words.mm(height), mm(top));
    words.choose(
        format!("Shims of {height} mm lie under the material of {pieces}{within}; its upper face is at Z {top}"),
        format!("{height} mm hohe Unterlagen liegen unter dem Material von {pieces}{within}; dessen Oberseite ist bei Z {top}"),
    )
}

/// Returns the numbers of a path's elements by pieces of material, in ascending order.
fn runs(path: &ScenePath) -> Vec<Run<'_>> {
    let mut numbered: Vec<(u32, &EmbeddedPath)> = path
        .elements
        .iter()
        .filter_map(|element| Some((element.order?, piece(path, element.path as usize)?)))
        .collect();
    numbered.sort_by_key(|(number, _)| *number);
    let mut runs: Vec<Run<'_>> = Vec::new();
    for (number, piece) in numbered {
        let heights = [piece.raised, piece.thickness].map(|height| (height * 1000.0).round() / 1000.0);
        match runs.last_mut() {
            Some(last) if (last.name, last.heights) == (&piece.name, heights) => last.numbers.push(number),
            _ => runs.push(Run { heights, name: &piece.name, numbers: vec![number] }),
        }
    }
    runs
}

/// Returns the outermost path whose material an embedded path shares: all paths between the two lie at the same height.
fn piece(path: &ScenePath, occurrence: usize) -> Option<&EmbeddedPath> {
    let mut piece = path.embedded.get(occurrence)?;
    while let Some(by) = piece.by {
        let embedder = path.embedded.get(path.elements.get(by as usize)?.path as usize)?;
        if embedder.raised != piece.raised {
            break;
        }
        piece = embedder;
    }
    Some(piece)
}
