//! Directories for the commands of a page, with a copy of its drawings.

use std::fs;
use std::path::{Path, PathBuf};

use pathbuild_diagnostic::Lang;
use pathbuild_testkit::sheet;

use super::{code, files_below};
use crate::support::{Place, project};

/// Returns the directory of the book's drawings, with a folder for each page that shows some.
pub(super) fn drawings() -> PathBuf {
    project().join("docs/drawings")
}

/// Creates a copy of the named folder; messages are in the language of the page.
pub(super) fn place(name: &str, lang: Lang) -> Place {
    let place = Place::new().users(&format!("lang = \"{}\"\n", code(lang)));
    match name {
        "empty" => place,
        "example" => {
            let run = place.run("init --example");
            assert_eq!(run.status, Some(0), "{run}");
            place
        }
        "fixtures" => copied(place, &project().join("fixtures/library"), "fixtures/library/"),
        "recorded" => {
            let case = project().join("fixtures/conformance/cases/support_line_four");
            let program = fs::read(case.join("expected/0/1234.1P_Milling.gcode")).unwrap();
            place
                .file("1234.1P.dxf", fs::read(case.join("1234.1P.dxf")).unwrap())
                .file("1234.1P_Milling.gcode", program)
        }
        _ => {
            let folder = drawings().join(name);
            assert!(folder.is_dir(), "docs/drawings/{name} is missing");
            copied(place, &folder, "")
        }
    }
}

fn copied(place: Place, folder: &Path, prefix: &str) -> Place {
    let files = files_below(folder).into_iter().filter(|name| !name.ends_with(".draw"));
    files.fold(place, |place, name| {
        place.file(&format!("{prefix}{name}"), fs::read(folder.join(&name)).unwrap())
    })
}

/// Returns a drawing in text form as DXF.
pub(super) fn drawn(file: &Path) -> Vec<u8> {
    let text = fs::read_to_string(file).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
    sheet(&text).unwrap_or_else(|errors| panic!("{}: {}", file.display(), errors[0])).to_dxf()
}
