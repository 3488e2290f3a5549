//! Groups of connected things. Each member points to an earlier member of its group, or to itself if it is the first.

/// Unites the groups of two members. Returns whether they were different.
pub(crate) fn unite(groups: &mut [usize], one: usize, other: usize) -> bool {
    let (one, other) = (root(groups, one), root(groups, other));
    groups[one.max(other)] = one.min(other);
    one != other
}

/// Returns the first member of a group.
pub(crate) fn root(groups: &mut [usize], node: usize) -> usize {
    let mut root = node;
    while groups[root] != root {
        groups[root] = groups[groups[root]];
        root = groups[root];
    }
    root
}
