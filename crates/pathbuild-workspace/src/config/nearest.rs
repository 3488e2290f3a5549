/// The known name that is nearest to a misspelt one, if one is near: at most a third of its letters differ.
pub(crate) fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    // All that is known is shorter: two thirds of such a name would be others.
    if name.len() > LONGEST {
        return None;
    }
    let name: Vec<char> = name.to_lowercase().chars().collect();
    let (most, own) = (name.len().div_ceil(3), letters(&name));
    let near = |candidate: &'a str| {
        // A letter more or less is one that differs.
        if candidate.chars().count().abs_diff(name.len()) > most {
            return None;
        }
        let other: Vec<char> = candidate.to_lowercase().chars().collect();
        let others = letters(&other);
        // Each letter that only one of them has is one that differs: nearly all names are told apart by this.
        if (own & !others).count_ones().max((others & !own).count_ones()) as usize > most {
            return None;
        }
        let distance = distance(&name, &other);
        (distance <= most).then_some((distance, candidate))
    };
    known.into_iter().filter_map(near).min_by_key(|(distance, _)| *distance).map(|(_, candidate)| candidate)
}

/// Which letters there are, a bit for each; some share theirs.
fn letters(name: &[char]) -> u32 {
    name.iter().fold(0, |found, letter| found | 1 << (u32::from(*letter) % 32))
}

/// Bytes of a name that may be a known one misspelt.
const LONGEST: usize = 200;

/// How many letters must be changed, put in, left out or swapped with their neighbour (optimal string alignment).
fn distance(a: &[char], b: &[char]) -> usize {
    let mut before: Vec<usize> = Vec::new();
    let mut above: Vec<usize> = (0..=b.len()).collect();
    for i in 1..=a.len() {
        let mut row = vec![i];
        for j in 1..=b.len() {
            let change = above[j - 1] + usize::from(a[i - 1] != b[j - 1]);
            let mut least = change.min(above[j] + 1).min(row[j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                least = least.min(before[j - 2] + 1);
            }
            row.push(least);
        }
        before = std::mem::replace(&mut above, row);
    }
    above[b.len()]
}
