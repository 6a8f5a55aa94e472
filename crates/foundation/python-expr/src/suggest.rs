//! Suggestions of similar names.

/// Most similar candidate, if it is similar enough.
pub(super) fn closest<'a>(
    name: &str,
    candidates: impl Iterator<Item = &'a str>,
) -> Option<&'a str> {
    // Longer names are not compared, because the comparison takes quadratic time.
    if name.len() > 100 {
        return None;
    }
    let limit = (name.chars().count() / 3).clamp(1, 3);
    let (distance, candidate) = candidates
        .filter(|candidate| candidate.len().abs_diff(name.len()) <= 4 * limit)
        .map(|candidate| (edits(name, candidate), candidate))
        .min()?;
    (distance <= limit && candidate.chars().count() > 1).then_some(candidate)
}

/// Number of letters to change, insert, delete or swap; case is ignored.
fn edits(a: &str, b: &str) -> usize {
    let a: Vec<char> = a.to_lowercase().chars().collect();
    let b: Vec<char> = b.to_lowercase().chars().collect();
    // Rows of the table of distances between prefixes: before last, last, current.
    let mut before: Vec<usize> = Vec::new();
    let mut last: Vec<usize> = (0..=b.len()).collect();
    for row in 1..=a.len() {
        let mut current = vec![row];
        for column in 1..=b.len() {
            let changed = last[column - 1] + usize::from(a[row - 1] != b[column - 1]);
            let mut best = changed.min(last[column] + 1).min(current[column - 1] + 1);
            if row > 1 && column > 1 && a[row - 1] == b[column - 2] && a[row - 2] == b[column - 1] {
                best = best.min(before[column - 2] + 1);
            }
            current.push(best);
        }
        before = std::mem::replace(&mut last, current);
    }
    last[b.len()]
}
