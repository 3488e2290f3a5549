//! Finds the known name most similar to an unknown one.

/// Longer names are not compared, because they are no typing errors.
const LONGEST: usize = 64;

/// The candidate that requires the fewest changed, added, omitted or swapped letters, if it is similar enough. Of several equally similar
/// ones, the first is returned.
pub(crate) fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    if name.len() > LONGEST {
        return None;
    }
    let name = name.to_lowercase();
    let tolerance = (name.chars().count() / 3).max(1);
    let distances =
        known.into_iter().map(|candidate| (distance(&name, &candidate.to_lowercase()), candidate));
    distances
        .filter(|(distance, _)| *distance <= tolerance)
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, known)| known)
}

/// Number of changed, added or omitted letters; two swapped letters count once. (Optimal string alignment)
fn distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
    let mut before: Vec<usize> = Vec::new();
    let mut previous: Vec<usize> = (0..=b.len()).collect();
    for i in 0..a.len() {
        let mut row = vec![i + 1];
        for j in 0..b.len() {
            let changed = previous[j] + usize::from(a[i] != b[j]);
            let mut cost = changed.min(previous[j + 1] + 1).min(row[j] + 1);
            if i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j] {
                cost = cost.min(before[j - 1] + 1);
            }
            row.push(cost);
        }
        before = std::mem::replace(&mut previous, row);
    }
    previous[b.len()]
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn a_slip_finds_the_name() {
        let known = ["toolchange", "tooltable", "spindle"];
        assert_eq!(nearest("toolchnage", known), Some("toolchange"));
        assert_eq!(nearest("Spindel", known), Some("spindle"));
        assert_eq!(nearest("coolant", known), None);
    }
}
