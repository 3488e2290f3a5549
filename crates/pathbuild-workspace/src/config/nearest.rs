/// The known name most similar to a misspelled one, if at most a third of its letters differ.
pub(crate) fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    // All known names are shorter, so more than a third of the letters would differ.
    if name.len() > LONGEST {
        return None;
    }
    let name: Vec<char> = name.to_lowercase().chars().collect();
    let (most, own) = (name.len().div_ceil(3), letters(&name));
    let near = |candidate: &'a str| {
        // Each letter more or less counts as a difference.
        if candidate.chars().count().abs_diff(name.len()) > most {
            return None;
        }
        let other: Vec<char> = candidate.to_lowercase().chars().collect();
        let others = letters(&other);
        // Each letter that occurs in only one of the names counts as a difference. This rules out nearly all names without computing the
        // distance.
        if (own & !others).count_ones().max((others & !own).count_ones()) as usize > most {
            return None;
        }
        let distance = distance(&name, &other);
        (distance <= most).then_some((distance, candidate))
    };
    known.into_iter().filter_map(near).min_by_key(|(distance, _)| *distance).map(|(_, candidate)| candidate)
}

/// A bit set of the letters in a name; some letters share a bit.
fn letters(name: &[char]) -> u32 {
    name.iter().fold(0, |found, letter| found | 1 << (u32::from(*letter) % 32))
}

/// Upper bound on the length in bytes of a name that may be a misspelled one.
const LONGEST: usize = 200;

/// Number of letters to change, insert, delete or swap with a neighbour (optimal string alignment distance).
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
