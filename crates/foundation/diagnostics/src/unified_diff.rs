//! Unified diff of two texts.

use std::fmt::Write as _;

/// Lines of context.
const CONTEXT_LINE_COUNT: usize = 3;

/// Maximum number of added and removed lines for which the smallest diff is computed; texts that differ more are shown as one
/// replaced block. The computation needs memory for the square of it.
const MAX_DIFFERENCE_LINE_COUNT: usize = 1000;

/// Line of a diff, by its index in the texts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Line {
    Same { before: usize, after: usize },
    Removed { before: usize },
    Added { after: usize },
}

/// Returns the unified diff of two texts; empty for equal ones. `patch -p1` and `git apply` read it.
#[must_use]
pub fn unified_diff(name: &str, before: &str, after: &str) -> String {
    if before == after {
        return String::new();
    }
    let old: Vec<&str> = before.split_inclusive('\n').collect();
    let new: Vec<&str> = after.split_inclusive('\n').collect();
    let lines = compare(&old, &new);
    let name = name.trim_start_matches('/');
    let mut diff = format!("--- a/{name}\n+++ b/{name}\n");
    let is_change = |line: &Line| !matches!(line, Line::Same { .. });
    let mut at = 0;
    while let Some(first) = lines[at..].iter().position(is_change).map(|it| at + it) {
        let from = first.saturating_sub(CONTEXT_LINE_COUNT).max(at);
        // A hunk ends where more same lines follow than two contexts have.
        let mut end = first + 1;
        let mut same = 0;
        for (index, line) in lines.iter().enumerate().skip(first) {
            if is_change(line) {
                (end, same) = (index + 1, 0);
            } else {
                same += 1;
                if same > 2 * CONTEXT_LINE_COUNT {
                    break;
                }
            }
        }
        let to = (end + CONTEXT_LINE_COUNT).min(lines.len());
        write_hunk(&lines[..from], &lines[from..to], &old, &new, &mut diff);
        at = to;
    }
    diff
}

fn write_hunk(previous: &[Line], hunk: &[Line], old: &[&str], new: &[&str], diff: &mut String) {
    let count_of = |lines: &[Line], omitted: fn(&Line) -> bool| {
        lines.iter().filter(|line| !omitted(line)).count()
    };
    let is_added: fn(&Line) -> bool = |line| matches!(line, Line::Added { .. });
    let is_removed: fn(&Line) -> bool = |line| matches!(line, Line::Removed { .. });
    let range = |omitted| {
        let count = count_of(hunk, omitted);
        // A range without lines is after the line of its number.
        let start = count_of(previous, omitted) + usize::from(count > 0);
        format!("{start},{count}")
    };
    let _ = writeln!(diff, "@@ -{} +{} @@", range(is_added), range(is_removed));
    for line in hunk {
        let (mark, text) = match *line {
            Line::Same { before, .. } => (' ', old[before]),
            Line::Removed { before } => ('-', old[before]),
            Line::Added { after } => ('+', new[after]),
        };
        diff.push(mark);
        diff.push_str(text);
        if !text.ends_with('\n') {
            diff.push_str("\n\\ No newline at end of file\n");
        }
    }
}

/// Compares two lists of lines: first what is equal at both ends, then the middle.
fn compare(old: &[&str], new: &[&str]) -> Vec<Line> {
    let head = old.iter().zip(new).take_while(|(a, b)| a == b).count();
    let (old_rest, new_rest) = (&old[head..], &new[head..]);
    let tail = old_rest.iter().rev().zip(new_rest.iter().rev()).take_while(|(a, b)| a == b).count();
    let old_middle = &old_rest[..old_rest.len() - tail];
    let new_middle = &new_rest[..new_rest.len() - tail];
    let mut lines: Vec<Line> =
        (0..head).map(|index| Line::Same { before: index, after: index }).collect();
    lines.extend(middle(old_middle, new_middle).into_iter().map(|line| match line {
        Line::Same { before, after } => Line::Same { before: before + head, after: after + head },
        Line::Removed { before } => Line::Removed { before: before + head },
        Line::Added { after } => Line::Added { after: after + head },
    }));
    let (old_tail, new_tail) = (old.len() - tail, new.len() - tail);
    lines.extend(
        (0..tail).map(|index| Line::Same { before: old_tail + index, after: new_tail + index }),
    );
    lines
}

/// Shortest edit script (Myers, *An O(ND) Difference Algorithm and Its Variations*, 1986, section 4).
fn middle(old: &[&str], new: &[&str]) -> Vec<Line> {
    let max = (old.len() + new.len()).min(MAX_DIFFERENCE_LINE_COUNT);
    // `reached[max + k]` is the number of old lines consumed on diagonal k = old lines - new lines.
    let mut reached = vec![0_usize; 2 * max + 2];
    let mut history: Vec<Vec<usize>> = Vec::new();
    for edits in 0..=max {
        // Diagonals -edits to edits, with both neighbours.
        history.push(reached[max - edits..(max + edits + 2).min(2 * max + 2)].to_vec());
        let mut diagonal = max - edits;
        while diagonal <= max + edits {
            let is_addition = diagonal == max - edits
                || (diagonal != max + edits && reached[diagonal - 1] < reached[diagonal + 1]);
            let mut x = if is_addition { reached[diagonal + 1] } else { reached[diagonal - 1] + 1 };
            // Beyond the ends there are no lines; such paths are never the result.
            let mut y = (x + max).saturating_sub(diagonal);
            while x < old.len() && y < new.len() && old[x] == new[y] {
                (x, y) = (x + 1, y + 1);
            }
            reached[diagonal] = x;
            if x >= old.len() && y >= new.len() {
                return trace(old.len(), new.len(), max, &history);
            }
            diagonal += 2;
        }
    }
    let removed = (0..old.len()).map(|before| Line::Removed { before });
    removed.chain((0..new.len()).map(|after| Line::Added { after })).collect()
}

/// Follows the path of [`middle`] from the end to the start.
fn trace(mut x: usize, mut y: usize, max: usize, history: &[Vec<usize>]) -> Vec<Line> {
    let mut lines = Vec::new();
    for (edits, reached) in history.iter().enumerate().rev() {
        let offset = max - edits;
        let at = |diagonal: usize| reached[diagonal - offset];
        let diagonal = max + x - y;
        let (from_x, from_y) = if edits == 0 {
            (0, 0)
        } else if diagonal == max - edits
            || (diagonal != max + edits && at(diagonal - 1) < at(diagonal + 1))
        {
            let from = at(diagonal + 1);
            (from, from + max - (diagonal + 1))
        } else {
            let from = at(diagonal - 1);
            (from, from + max - (diagonal - 1))
        };
        while x > from_x && y > from_y {
            (x, y) = (x - 1, y - 1);
            lines.push(Line::Same { before: x, after: y });
        }
        if edits > 0 {
            if x > from_x {
                x -= 1;
                lines.push(Line::Removed { before: x });
            } else {
                y -= 1;
                lines.push(Line::Added { after: y });
            }
        }
    }
    lines.reverse();
    lines
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

    #[test]
    fn lines_are_added_and_removed() {
        assert_eq!(
            unified_diff("/a", "1\n2\n3\n", "1\n3\n4\n"),
            "--- a/a\n+++ b/a\n@@ -1,3 +1,3 @@\n 1\n-2\n 3\n+4\n"
        );
        assert_eq!(
            unified_diff("a", "", "1"),
            "--- a/a\n+++ b/a\n@@ -0,0 +1,1 @@\n+1\n\\ No newline at end of file\n"
        );
    }

    /// Applies the edit script: it must give the new lines from the old ones.
    fn check(old: &str, new: &str, count: usize) {
        let (old, new): (Vec<&str>, Vec<&str>) =
            (old.split_inclusive("").collect(), new.split_inclusive("").collect());
        let lines = compare(&old, &new);
        let made: Vec<&str> = lines
            .iter()
            .filter_map(|line| match *line {
                Line::Same { before, after } => {
                    assert_eq!(old[before], new[after]);
                    Some(old[before])
                }
                Line::Added { after } => Some(new[after]),
                Line::Removed { .. } => None,
            })
            .collect();
        assert_eq!(made, new);
        let kept = lines.iter().filter(|line| !matches!(line, Line::Added { .. })).count();
        assert_eq!(kept, old.len());
        let changes = lines.iter().filter(|line| !matches!(line, Line::Same { .. })).count();
        assert_eq!(changes, count);
    }

    #[test]
    fn the_script_is_the_shortest() {
        // The example of Myers' paper has five edits.
        check("abcabba", "cbabac", 5);
        check("abc", "abc", 0);
        check("", "abc", 3);
        check("abc", "", 3);
        check("xaby", "abxy", 2);
        check("a", "b", 2);
    }

    #[test]
    fn very_different_texts_are_one_block() {
        let lines =
            |from: usize| (from..from + 800).map(|it| format!("{it}\n")).collect::<String>();
        let diff = unified_diff("a", &lines(0), &lines(10_000));
        assert!(diff.contains("@@ -1,800 +1,800 @@\n-0\n-1\n"));
    }
}
