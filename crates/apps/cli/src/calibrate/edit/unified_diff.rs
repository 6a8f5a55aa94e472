//! Unified diff of a text in which lines were replaced.

use std::fmt::Write as _;

/// Lines of context.
const CONTEXT_LINE_COUNT: usize = 3;

/// Returns the unified diff of two texts with the same number of lines; empty for equal ones.
pub(in crate::calibrate) fn unified_diff(name: &str, before: &str, after: &str) -> String {
    let (old, new): (Vec<&str>, Vec<&str>) =
        (before.split('\n').collect(), after.split('\n').collect());
    let changed: Vec<usize> =
        (0..old.len().min(new.len())).filter(|it| old[*it] != new[*it]).collect();
    let mut hunks: Vec<(usize, usize)> = Vec::new();
    // The part after the last line break is no line if it is empty.
    let end = if before.ends_with('\n') { old.len() - 1 } else { old.len() };
    for line in changed {
        let (from, to) =
            (line.saturating_sub(CONTEXT_LINE_COUNT), (line + CONTEXT_LINE_COUNT + 1).min(end));
        match hunks.last_mut() {
            Some(last) if from <= last.1 => last.1 = to,
            _ => hunks.push((from, to)),
        }
    }
    let mut diff = String::new();
    let name = name.trim_start_matches('/');
    if !hunks.is_empty() {
        let _ = write!(diff, "--- a/{name}\n+++ b/{name}\n");
    }
    for (from, to) in hunks {
        let _ = writeln!(diff, "@@ -{},{} +{},{} @@", from + 1, to - from, from + 1, to - from);
        let mut at = from;
        while at < to {
            let first = at;
            while at < to && old[at] != new[at] {
                at += 1;
            }
            old[first..at].iter().for_each(|it| diff.push_str(&format!("-{it}\n")));
            new[first..at].iter().for_each(|it| diff.push_str(&format!("+{it}\n")));
            if at < to {
                diff.push_str(&format!(" {}\n", old[at]));
                at += 1;
            }
        }
    }
    diff
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_changes_share_a_hunk() {
        let before = "1\n2\n3\n4\n5\n6\n7\n8\n9\n10\n11\n12\n";
        let after = before.replace("\n2\n3\n", "\ntwo\nthree\n").replace("12", "twelve");
        assert_eq!(
            unified_diff("a.urdf", before, &after),
            "--- a/a.urdf\n+++ b/a.urdf\n@@ -1,6 +1,6 @@\n 1\n-2\n-3\n+two\n+three\n 4\n 5\n 6\n\
             @@ -9,4 +9,4 @@\n 9\n 10\n 11\n-12\n+twelve\n"
        );
        assert_eq!(unified_diff("a.urdf", before, before), "");
    }
}
