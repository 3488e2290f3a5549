//! Generates the pictures of the books: `pictures/FOLDER-PATH.svg` is the output of `view PATH` in a copy of the folder's drawings, or of
//! `view NAME.dxf` if a drawing has that name. `pictures/sheet-FOLDER-PATH.svg` is the output of `sheet PATH`, `pictures/stock-FOLDER-PATH.svg`
//! that of `view PATH --stock`. `pictures/drawn-NAME.svg` is drawn by hand and shows what `view` cannot.

use std::collections::BTreeSet;
use std::fs;

use pathbuild_diagnostic::Lang;
use rayon::prelude::*;

use super::{all_pages, assert_none, files_below, kept, links, scratch, source};
use crate::support::project;

#[test]
fn pictures_are_what_view_draws() {
    let shown: BTreeSet<String> = all_pages()
        .iter()
        .flat_map(|page| {
            let text = page.text();
            links::images(&text).into_iter().map(|link| links::target(page, link)).collect::<Vec<_>>()
        })
        .collect();
    let wrong: Vec<String> = shown.par_iter().filter_map(|file| wrong(file)).collect();
    assert_none(&wrong);
    for lang in [Lang::En, Lang::De] {
        let folder = source(lang).join("pictures");
        let there = files_below(&project().join(&folder));
        let unused: Vec<String> = there
            .iter()
            .map(|name| folder.join(name).to_string_lossy().into_owned())
            .filter(|file| !shown.contains(file))
            .collect();
        assert!(unused.is_empty(), "no page shows {unused:?}");
    }
}

fn wrong(file: &str) -> Option<String> {
    let lang =
        [Lang::En, Lang::De].into_iter().find(|lang| file.starts_with(&*source(*lang).to_string_lossy()));
    let name = file.rsplit('/').next().unwrap().strip_suffix(".svg");
    if name.is_some_and(|name| name.starts_with("drawn-")) && project().join(file).exists() {
        return None;
    }
    let (Some(lang), Some((folder, path))) = (lang, name.and_then(|name| name.rsplit_once('-'))) else {
        return Some(format!("{file}: not named pictures/FOLDER-PATH.svg"));
    };
    let (command, folder, options): (_, _, &[&str]) = match folder.split_once('-') {
        Some(("sheet", folder)) => ("sheet", folder, &[]),
        Some(("stock", folder)) => ("view", folder, &["--stock"]),
        _ => ("view", folder, &[]),
    };
    let place = scratch::place(folder, lang);
    let directory = if folder == "fixtures" { "fixtures/library" } else { "." };
    let picture = place.path().join("picture.svg");
    let drawing = format!("{path}.dxf");
    let what = if place.path().join(&drawing).exists() { &drawing } else { path };
    let picture_name = picture.to_string_lossy();
    let arguments = [&[command, what, "-o", &*picture_name], options].concat();
    let run = place.run_in(directory, &arguments);
    match fs::read(&picture) {
        Ok(drawn) => kept(&project().join(file), &drawn),
        Err(_) => Some(format!("{file}: nothing to see\n{run}")),
    }
}
