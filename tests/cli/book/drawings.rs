//! Each drawing of the books exists twice: as text, which is edited, and as DXF, which any CAD program can open.

use std::path::PathBuf;

use super::{assert_none, files_below, kept, scratch};
use crate::support::project;

/// Returns the folders with drawings in text form.
fn folders() -> [PathBuf; 2] {
    [scratch::drawings(), project().join("crates/pathbuild/example")]
}

#[test]
fn drawings_are_what_their_text_form_says() {
    let mut wrong = Vec::new();
    for folder in folders() {
        let files = files_below(&folder);
        for name in files.iter().filter(|name| name.ends_with(".draw")) {
            let file = folder.join(name);
            wrong.extend(kept(&file.with_extension("dxf"), &scratch::drawn(&file)));
        }
        let drawings = files.iter().filter_map(|name| name.strip_suffix(".dxf"));
        let alone = drawings.filter(|name| !files.contains(&format!("{name}.draw")));
        wrong.extend(alone.map(|name| format!("{name}.dxf has no text form in {}", folder.display())));
    }
    assert_none(&wrong);
}
