//! Changes of one kind together, as people are told of them.

use super::identity::is_rapid;
use super::{Change, ChangeKind};
use crate::scene::{Move, Point};

/// All moves of a path that changed in the same way.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    /// How; `None`: only rapid moves, of which it is enough to know that they are others.
    pub kind: Option<ChangeKind>,
    /// How many moves: of the new program, of those that are gone the old.
    pub moves: usize,
    /// Their length in mm.
    pub length: f64,
    /// Where the first of them ends, in the program's coordinates.
    pub at: Option<Point>,
}

/// The changes by kind, in the order in which the kinds are first met. Rapid moves come last.
pub fn groups(changes: &[Change], old: &[Move], new: &[Move]) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    let mut rapids = Group { kind: None, moves: 0, length: 0.0, at: None };
    for change in changes {
        let moves = match change.kind {
            ChangeKind::Removed => &old[change.old.clone()],
            _ => &new[change.new.clone()],
        };
        for it in moves {
            let group = if is_rapid(it) { &mut rapids } else { of_kind(&mut groups, change.kind) };
            group.moves += 1;
            group.length += it.length;
            if group.at.is_none() && it.is_placed() {
                group.at = Some(it.to());
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
