//! Groups changes by kind, for messages.

use super::identity::is_rapid;
use super::{Change, ChangeKind};
use crate::scene::{Move, Point};

/// All moves of a path that changed in the same way.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    /// The kind of change; `None` for rapid moves, of which only the number matters.
    pub kind: Option<ChangeKind>,
    /// Number of moves in the new program, or in the old one for removed moves.
    pub moves: usize,
    /// Their total length in mm.
    pub length: f64,
    /// The end of the first one, in the coordinates of the program.
    pub at: Option<Point>,
}

/// The changes by kind, in order of first occurrence. Rapid moves come last.
pub fn groups(changes: &[Change], old: &[Move], new: &[Move]) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    let mut rapids = Group { kind: None, moves: 0, length: 0.0, at: None };
    for change in changes {
        let moves = match change.kind {
            ChangeKind::Removed => &old[change.old.clone()],
            _ => &new[change.new.clone()],
        };
        for movement in moves {
            let group = if is_rapid(movement) { &mut rapids } else { of_kind(&mut groups, change.kind) };
            group.moves += 1;
            group.length += movement.length;
            if group.at.is_none() && movement.is_placed() {
                group.at = Some(movement.to());
            }
        }
    }
    groups.extend((rapids.moves > 0).then_some(rapids));
    groups
}

fn of_kind(groups: &mut Vec<Group>, kind: ChangeKind) -> &mut Group {
    let known = groups.iter().position(|group| group.kind == Some(kind));
    let index = known.unwrap_or_else(|| {
        groups.push(Group { kind: Some(kind), moves: 0, length: 0.0, at: None });
        groups.len() - 1
    });
    &mut groups[index]
}
