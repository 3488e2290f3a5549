//! The operations of a setup sheet: a table that explains each number in the picture.

use pathbuild_diagnostic::{Lang, Noun, counted};
use pathbuild_path::has_diameter_of;

use super::data::{Sheet, SheetTool, localized_mm};
use crate::scene::{Element, ElementKind, MoveKind, ScenePath, Shape};
use crate::svg::canvas::mm;

/// Maximum number of rows. A longer table is of no use on paper.
const MAX_ROWS: usize = 300;

/// A range of consecutive element numbers with the same operation.
#[derive(Debug)]
struct Operation {
    numbers: [u32; 2],
    work: ElementOperation,
}

#[derive(Debug, PartialEq)]
struct ElementOperation {
    /// Occurrence of the path, as an index into [`ScenePath::embedded`].
    occurrence: u32,
    path: String,
    what: String,
    depth: String,
}

/// Returns the rows of the table, with five cells each: numbers, path, operation, depth, cutter.
pub(super) fn rows(sheet: &Sheet, lang: Lang) -> Vec<Vec<String>> {
    let paths = sheet.scene.paths.iter().zip(&sheet.path_tools);
    let mut rows: Vec<Vec<String>> = paths
        .flat_map(|(path, tool)| {
            let tool = cutter(&sheet.tools[*tool]);
            operations(path, lang).into_iter().map(move |operation| row(operation, tool.clone()))
        })
        .collect();
    let more = rows.len().saturating_sub(MAX_ROWS);
    if more > 0 {
        rows.truncate(MAX_ROWS);
        rows.push(vec![
            "…".to_owned(),
            String::new(),
            counted(more, MORE_OPERATIONS, lang),
            String::new(),
            String::new(),
        ]);
    }
    rows
}

const MORE_OPERATIONS: Noun =
    [["more operation", "more operations"], ["weiterer Arbeitsgang", "weitere Arbeitsgänge"]];

/// Names a cutter by its number in the machine, or else by its diameter.
fn cutter(tool: &SheetTool) -> String {
    tool.number.map_or_else(|| format!("Ø {}", mm(tool.diameter)), |number| format!("T{number}"))
}

fn row(operation: Operation, cutter: String) -> Vec<String> {
    let Operation { numbers: [first, last], work } = operation;
    let numbers = if first == last { first.to_string() } else { format!("{first}–{last}") };
    vec![numbers, work.path, work.what, work.depth, cutter]
}

fn operations(path: &ScenePath, lang: Lang) -> Vec<Operation> {
    let numbered = path.elements.iter().zip(path.depths(MoveKind::cuts));
    let mut numbered: Vec<(u32, ElementOperation)> = numbered
        .filter_map(|(element, depth)| Some((element.order?, element_operation(path, element, depth, lang))))
        .collect();
    numbered.sort_by_key(|(number, _)| *number);
    let mut operations: Vec<Operation> = Vec::new();
    for (number, work) in numbered {
        match operations.last_mut() {
            Some(last) if last.work == work && last.numbers[1] + 1 == number => last.numbers[1] = number,
            _ => operations.push(Operation { numbers: [number; 2], work }),
        }
    }
    operations
}

fn element_operation(
    path: &ScenePath,
    element: &Element,
    depth: Option<f64>,
    lang: Lang,
) -> ElementOperation {
    let name = path.embedded.get(element.path as usize).map_or(&path.name, |embedded| &embedded.name);
    ElementOperation {
        occurrence: element.path,
        path: name.clone(),
        what: operation_text(path, element, lang),
        depth: depth.map(|z| format!("Z {}", mm(z))).unwrap_or_default(),
    }
}

/// Describes the operation at an element. A circle as wide as the cutter is drilled.
fn operation_text(path: &ScenePath, element: &Element, lang: Lang) -> String {
    let work = match element.kind {
        ElementKind::Mark => lang.choose("marking", "Markieren"),
        ElementKind::Support => lang.choose("milling with support bars", "Fräsen mit Stützstegen"),
        _ => lang.choose("milling", "Fräsen"),
    };
    let Shape::Circle { radius, .. } = element.shape else { return work.to_owned() };
    let diameter = 2.0 * radius;
    if path.tool.is_some_and(|tool| has_diameter_of(radius, tool / 2.0)) {
        return lang.choose(
            format!("drilling Ø {}", mm(diameter)),
            format!("Bohren Ø {}", localized_mm(diameter, lang)),
        );
    }
    lang.choose(
        format!("{work}: circle Ø {}", mm(diameter)),
        format!("{work}: Kreis Ø {}", localized_mm(diameter, lang)),
    )
}
