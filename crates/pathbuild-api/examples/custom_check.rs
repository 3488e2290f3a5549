//! A custom check in addition to pathbuild's: no feed above 200 mm/min in aluminium. `cargo run --example custom_check -- DIRECTORY`; the
//! exit status is 1 if there is an error or such a feed.
#![expect(clippy::print_stdout, reason = "printing is what this program is for")]

use std::process::ExitCode;

use pathbuild_api::{Element, Error, Lang, Library};

/// Highest allowed feed in mm/min.
const HIGHEST: f64 = 200.0;

fn main() -> Result<ExitCode, Error> {
    let directory = std::env::args().nth(1).unwrap_or_else(|| ".".to_owned());
    let library = Library::open(directory)?;
    let mut is_good = true;
    for finding in library.check(&[])?.findings {
        is_good &= !finding.is_error();
        println!("{}: {}", finding.file().unwrap_or_default(), finding.message(Lang::En));
    }
    for listed in library.paths(&[])?.paths {
        let path = library.path_in(&listed.file, &listed.name)?;
        let too_fast = path.moves.iter().filter(|it| it.feed.is_some_and(|feed| feed > HIGHEST));
        let mut elements: Vec<usize> = too_fast.filter_map(|it| it.element).collect();
        elements.dedup();
        elements.retain(|element| is_aluminium(&path.elements[*element]));
        is_good &= elements.is_empty();
        for element in elements.into_iter().map(|element| &path.elements[element]) {
            let line = element.line.unwrap_or_default();
            println!("{}, line {line}: {} is milled faster than {HIGHEST}", element.file, element.entity);
        }
    }
    Ok(if is_good { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// Whether the element's own material is aluminium. An embedded path may have another material than the path that embeds it.
fn is_aluminium(element: &Element) -> bool {
    element.parameter('M').is_some_and(|material| material.value.starts_with("Al"))
}
