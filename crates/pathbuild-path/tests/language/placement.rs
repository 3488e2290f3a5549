//! Tests the placement of an embedded path. (book: language/embedding)

use pathbuild_path::{Placement, Xy};

const ORIGIN: Xy = Xy::new(0.0, 0.0);
const THERE: Xy = Xy::new(5.0, 7.0);

/// The embedded path or the segment may be the only one without a direction, because their lengths may differ by up to 0.001 mm.
#[test]
fn without_a_direction_a_path_is_turned_as_what_is_around_it() {
    let east = (ORIGIN, Xy::new(1.0, 0.0));
    let turned = Placement::aligning(east, (ORIGIN, Xy::new(0.0, 1.0)), &Placement::from_origin(ORIGIN));
    let beside = Xy::new(THERE.x - 0.0005, THERE.y);
    for (own, onto) in [
        ((ORIGIN, ORIGIN), (THERE, THERE)),
        ((ORIGIN, ORIGIN), (THERE, beside)),
        ((ORIGIN, Xy::new(0.0005, 0.0)), (THERE, THERE)),
    ] {
        let placed = Placement::aligning(own, onto, &turned).place(Xy::new(3.0, 1.0));
        assert!((placed - Xy::new(4.0, 10.0)).norm() < 1e-12, "{own:?} {onto:?}: {placed}");
    }
    let placed = Placement::aligning(east, (THERE, Xy::new(4.0, 7.0)), &turned).place(Xy::new(3.0, 1.0));
    assert!((placed - Xy::new(2.0, 6.0)).norm() < 1e-12, "{placed}");
}
