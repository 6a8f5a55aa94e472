//! Edits of a text at byte positions that leave all other bytes as they are.

use std::ops::Range;

/// Replacement of a range of bytes; an empty range is an insertion.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextEdit {
    /// Replaced bytes.
    pub range: Range<usize>,
    /// New text.
    pub text: String,
}

/// Applies edits whose ranges are in `text`, on character boundaries, and do not overlap. Insertions at one position keep
/// their order. Returns `None` if a range does not fit.
#[must_use]
pub fn apply_edits(text: &str, mut edits: Vec<TextEdit>) -> Option<String> {
    edits.sort_by_key(|edit| (edit.range.start, edit.range.end));
    let mut out = String::with_capacity(text.len());
    let mut at = 0;
    for edit in &edits {
        out.push_str(text.get(at..edit.range.start)?);
        out.push_str(&edit.text);
        // Checks the replaced range too.
        text.get(edit.range.clone())?;
        at = edit.range.end;
    }
    out.push_str(text.get(at..)?);
    Some(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn edit(range: Range<usize>, text: &str) -> TextEdit {
        TextEdit { range, text: text.to_owned() }
    }

    #[test]
    fn only_the_ranges_change() {
        let edits = vec![edit(6..6, "!"), edit(1..2, "BB"), edit(6..6, "?"), edit(3..5, "")];
        assert_eq!(apply_edits("abcdef", edits).as_deref(), Some("aBBcf!?"));
    }

    #[test]
    fn ranges_that_overlap_or_split_a_character_are_refused() {
        assert_eq!(apply_edits("abc", vec![edit(0..2, ""), edit(1..3, "")]), None);
        assert_eq!(apply_edits("č", vec![edit(1..2, "")]), None);
        assert_eq!(apply_edits("abc", vec![edit(2..9, "")]), None);
    }
}
