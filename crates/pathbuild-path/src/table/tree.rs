//! The binary tree over ranges that are in order of their beginnings. Node 1 is the root; below node n are 2n and 2n + 1; the leaves are a
//! power of two.

/// Takes the ranges before `begun`, by number, leaving out subtrees that `ends_before` says end before what is looked for.
pub(super) fn visit(
    leaves: usize,
    begun: usize,
    ends_before: &impl Fn(usize) -> bool,
    take: &mut impl FnMut(usize),
) {
    visit_below(1, 0..leaves, begun, ends_before, take);
}

fn visit_below(
    node: usize,
    ranges: std::ops::Range<usize>,
    begun: usize,
    ends_before: &impl Fn(usize) -> bool,
    take: &mut impl FnMut(usize),
) {
    if ranges.start >= begun || ends_before(node) {
        return;
    }
    if ranges.len() == 1 {
        return take(ranges.start);
    }
    let middle = usize::midpoint(ranges.start, ranges.end);
    visit_below(2 * node, ranges.start..middle, begun, ends_before, take);
    visit_below(2 * node + 1, middle..ranges.end, begun, ends_before, take);
}
