//! Tests drawings that change without notice: bytes that are read again must be those from which the index was built.

use pathbuild_db::{Role, check_target, program};

use crate::embedding::component;
use crate::world::{World, dxf};

const FILE: &str = "lib/1111.1P.dxf";

/// Returns the codes of the located findings, whether there is a program, and the number of rounds. Repeats the work until no drawing has
/// changed in the meantime.
fn settled(world: &mut World, role: &Role) -> (Vec<String>, bool, u32) {
    let mut rounds = 0;
    loop {
        rounds += 1;
        let target = world.db.target(world.file(FILE), "1111.1P", role.clone());
        let found = world.guarded(|db| {
            let located = check_target(db, target).cloned().map(|it| pathbuild_db::locate(db, it));
            let codes = located.map(|found| found.code().to_string()).collect::<Vec<_>>();
            (codes, program(db, target).is_some())
        });
        let has_changes = world.db.apply_noted_changes();
        assert_eq!(found.is_err(), has_changes, "{found:?}");
        if let Ok((codes, is_made)) = found {
            return (codes, is_made, rounds);
        }
    }
}

#[test]
fn a_program_is_made_of_the_drawing_that_was_checked() {
    let mut world = World::new(&[(FILE, &component("1111.1P", "0"))]);
    assert!(world.judge("path", FILE, "1111.1P", Role::Emitted).is_empty());
    // The cut now ends above the material, and the database is not notified.
    world.put_unnoticed(FILE, &component("1111.1P", "9"));
    assert_eq!(settled(&mut world, &Role::Emitted), (vec!["PB203".to_owned()], false, 2));
}

#[test]
fn a_finding_is_located_in_the_drawing_that_it_was_found_in() {
    let mut world = World::new(&[(FILE, &component("1111.1P", "9"))]);
    assert_eq!(world.judge("path", FILE, "1111.1P", Role::Checked), ["PB203"]);
    world.put_unnoticed(FILE, &component("1111.1P", "0"));
    assert_eq!(settled(&mut world, &Role::Checked), (Vec::new(), true, 2));
}

#[test]
fn a_drawing_that_went_or_came_has_changed_too() {
    let mut world = World::new(&[(FILE, &component("1111.1P", "9"))]);
    assert_eq!(world.judge("path", FILE, "1111.1P", Role::Checked), ["PB203"]);
    world.remove_unnoticed(FILE);
    assert_eq!(settled(&mut world, &Role::Checked), (Vec::new(), false, 2));
    assert!(!world.db.apply_noted_changes());
    world.put_unnoticed(FILE, &component("1111.1P", "9"));
    // The drawing is read only once, so nothing can differ.
    assert_eq!(settled(&mut world, &Role::Checked), (Vec::new(), false, 1));
}

#[test]
fn a_drawing_that_was_saved_without_a_change_has_not_changed() {
    let mut world = World::new(&[(FILE, &component("1111.1P", "0"))]);
    assert!(world.judge("path", FILE, "1111.1P", Role::Emitted).is_empty());
    world.put_unnoticed(FILE, &component("1111.1P", "0"));
    assert_eq!(settled(&mut world, &Role::Emitted), (Vec::new(), true, 1));
    assert!(!dxf(&component("1111.1P", "0")).is_empty());
}
