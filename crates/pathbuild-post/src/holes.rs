//! Converts drilled holes to moves, for controls without canned cycles.

use pathbuild_diagnostic::{Diagnostic, Point, messages::posts};

use crate::job::{Hole, HoleKind, JobStep};

/// Holes with more pecks than this are taken for errors.
const MOST_PECKS: usize = 1_000;
/// Height in mm above the depth already drilled at which the tool changes from rapid to feed; the same as in LinuxCNC's G83.
const PECK_GAP: f64 = 0.254;

/// The moves of a hole: to its position at the start level, down, and up to its exit level.
pub(crate) fn moves(hole: &Hole) -> Result<Vec<JobStep>, Box<Diagnostic>> {
    let [x, y] = hole.at;
    let to = |z| [x, y, z];
    let mut steps = vec![JobStep::rapid(to(hole.level))];
    if hole.retract < hole.level {
        steps.push(JobStep::rapid(to(hole.retract)));
    }
    let depths = depths(hole)?;
    for (index, &depth) in depths.iter().enumerate() {
        if index > 0 {
            let reached = depths[index - 1];
            steps.push(JobStep::rapid(to(hole.retract)));
            steps.push(JobStep::rapid(to((reached + PECK_GAP).min(hole.retract))));
        }
        steps.push(JobStep::feed(to(depth), hole.feed));
    }
    if let HoleKind::Dwell { seconds } = hole.kind {
        steps.push(JobStep::Dwell { seconds });
    }
    steps.push(JobStep::rapid(to(hole.exit)));
    Ok(steps)
}

/// The depths reached by successive pecks; the last is the bottom.
fn depths(hole: &Hole) -> Result<Vec<f64>, Box<Diagnostic>> {
    let HoleKind::Peck { depth } = hole.kind else { return Ok(vec![hole.bottom]) };
    let mut depths = Vec::new();
    let mut z = hole.retract - depth;
    while z > hole.bottom {
        if depths.len() == MOST_PECKS {
            let place = Point::new(hole.at[0], hole.at[1]);
            let diagnostic =
                Diagnostic::new(&posts::TOO_MANY_PECKS).with("limit", MOST_PECKS).with("place", place);
            return Err(Box::new(diagnostic));
        }
        depths.push(z);
        z -= depth;
    }
    depths.push(hole.bottom);
    Ok(depths)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn heights(kind: HoleKind) -> Vec<f64> {
        heights_from(20.0, kind)
    }

    fn heights_from(level: f64, kind: HoleKind) -> Vec<f64> {
        let hole =
            Hole { at: [1.0, 2.0], level, retract: 10.0, bottom: 4.0, exit: 20.0, feed: Some(60.0), kind };
        let z = |step: &JobStep| match step {
            JobStep::Move(movement) => Some(movement.to.z()),
            _ => None,
        };
        moves(&hole).unwrap().iter().filter_map(z).collect()
    }

    #[test]
    fn a_plain_hole_is_drilled_in_one_go() {
        assert_eq!(heights(HoleKind::Plain), [20.0, 10.0, 4.0, 20.0]);
        assert_eq!(heights_from(10.0, HoleKind::Plain), [10.0, 4.0, 20.0], "it is there already");
    }

    #[test]
    fn pecks_leave_the_hole_and_come_back_just_above_where_they_were() {
        let expected = [20.0, 10.0, 7.0, 10.0, 7.254, 4.0, 20.0];
        assert_eq!(heights(HoleKind::Peck { depth: 3.0 }), expected, "exactly two goes");
        assert_eq!(heights(HoleKind::Peck { depth: 2.9 }).len(), 10, "a third for the rest");
        let shallow = heights(HoleKind::Peck { depth: 0.2 });
        assert!(shallow[1..shallow.len() - 1].iter().all(|z| *z <= 10.0), "no higher than it goes up");
    }

    #[test]
    fn endless_pecks_are_refused() {
        let hole = |bottom: f64| Hole {
            at: [0.0, 0.0],
            level: 1.0,
            retract: 0.0,
            bottom,
            exit: 1.0,
            feed: None,
            kind: HoleKind::Peck { depth: 1.0 },
        };
        assert!(moves(&hole(-1001.0)).is_ok());
        assert!(moves(&hole(-1002.0)).is_err());
        let kind = HoleKind::Peck { depth: 0.0 };
        assert!(moves(&Hole { kind, ..hole(-1.0) }).is_err());
    }
}
