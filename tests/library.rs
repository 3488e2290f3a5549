//! The example library: its drawings are made from their text form, all furniture included, and are what the README's first command
//! works on. `PATHBUILD_UPDATE=1 cargo test --test library` writes them anew.

use std::fs;
use std::path::{Path, PathBuf};

use pathbuild_draw::Sheet;

/// The three folders of the library.
const FOLDERS: [&str; 3] = ["components", "projects", "mistakes"];

fn library() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/library")
}

/// The text forms of a folder, in order of name.
fn sources(folder: &str) -> Vec<PathBuf> {
    let listed = fs::read_dir(library().join("sources").join(folder)).expect("the library has its sources");
    let mut files: Vec<PathBuf> = listed.map(|entry| entry.expect("it can be listed").path()).collect();
    files.sort();
    files
}

fn drawing(source: &Path) -> Vec<u8> {
    let text = fs::read_to_string(source).expect("a source can be read");
    let sheet = Sheet::parse(&text).unwrap_or_else(|errors| panic!("{}: {errors:?}", source.display()));
    sheet.to_dxf()
}

#[test]
fn drawings_are_what_their_text_form_says() {
    let is_update = std::env::var_os("PATHBUILD_UPDATE").is_some();
    for folder in FOLDERS {
        for source in sources(folder) {
            let name = source.file_stem().expect("a source has a name").to_string_lossy().into_owned();
            let file = library().join(folder).join(format!("{name}.dxf"));
            let made = drawing(&source);
            if is_update {
                fs::create_dir_all(library().join(folder)).expect("folders can be made");
                fs::write(&file, &made).expect("drawings can be written");
            }
            let present = fs::read(&file).unwrap_or_default();
            assert!(
                present == made,
                "{} is not what its source says; see the first lines of this test",
                file.display()
            );
        }
    }
}
