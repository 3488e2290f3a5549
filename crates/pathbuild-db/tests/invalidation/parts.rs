//! Finished parts: only edits of outlines and cuts check them again. (book: language/part)

use std::sync::Arc;

use pathbuild_db::{Role, Settings};
use pathbuild_path::{Language, LayerPattern, PartSettings, SlotPaths};
use salsa::Setter;

use crate::world::World;

const FILE: &str = "lib/1111.1P.dxf";

/// A path beside a plate whose upper edge it may enter.
fn drawing(feed: &str, top: &str) -> String {
    format!(
        "layer 1111.1P\nstart 0,-1 \"T5 O2 I1 B0 F{feed} Mx\"\nmill 0,-1 40,-1\nsweep 40,-1 40,21\nmill 40,21 0,21\n\
         end 0,21\nlayer Part\npolyline 0,0 40,0 40,{top} 0,{top} closed"
    )
}

fn name_parts(world: &mut World) {
    let settings = Settings::get(&world.db);
    let pattern = LayerPattern::new("Part").unwrap();
    let part = Some(PartSettings {
        pattern,
        tolerance: 0.02,
        is_held_otherwise: false,
        slots: SlotPaths::default(),
    });
    let language = Language { part, ..Language::clone(settings.language(&world.db)) };
    settings.set_language(&mut world.db).to(Arc::new(language));
}

#[test]
fn an_edit_beside_cuts_and_outlines_checks_no_part_again() {
    let mut world = World::new(&[(FILE, &drawing("100", "20"))]);
    name_parts(&mut world);
    let mut ran = |text: &str, codes: &[&str]| {
        world.draw(FILE, text);
        assert_eq!(world.judge("path", FILE, "1111.1P", Role::Checked), codes);
        assert!(world.ran().contains("file_index path"), "{:?}", world.ran());
        world.ran().contains("checked_parts path")
    };
    assert!(ran(&drawing("100", "20"), &[]));
    assert!(!ran(&drawing("120", "20"), &[]), "another feed");
    let other = format!("{}\nlayer Notes\nline 0,0 1,1", drawing("120", "20"));
    assert!(!ran(&other, &[]), "another layer");
    assert!(ran(&drawing("120", "20.5"), &["PB213"]), "the outline");
    assert!(ran(&drawing("120", "20.5").replace("21", "21.5"), &[]), "the cuts");
}
