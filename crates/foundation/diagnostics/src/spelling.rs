//! Search for similar names.

/// Returns the most similar known name, if at most a third of its letters differ, ignoring case and
/// separators.
pub fn closest<'a>(written: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    // Names in files are short; a hostile one must not cost quadratic time.
    if written.len() > 64 {
        return None;
    }
    let fold = |name: &str| name.replace(['_', '-', ' '], "").to_lowercase();
    let folded = fold(written);
    known
        .into_iter()
        .filter(|name| *name != written && name.len() <= 64)
        .map(|name| {
            let other = fold(name);
            let distance = strsim::damerau_levenshtein(&folded, &other);
            (distance, folded.chars().count().max(other.chars().count()), name)
        })
        .filter(|(distance, length, _)| distance * 3 <= *length)
        .min_by_key(|(distance, _, _)| *distance)
        .map(|(_, _, name)| name)
}

#[cfg(test)]
mod tests {
    use super::closest;

    #[test]
    fn slips_are_recognised_and_strangers_are_not() {
        let known = ["radius", "length", "min_depth", "remapping"];
        assert_eq!(closest("raduis", known), Some("radius"));
        assert_eq!(closest("minDepth", known), Some("min_depth"));
        assert_eq!(closest("remap", known), None);
        assert_eq!(closest("colour", known), None);
        assert_eq!(closest("radius", known), None);
    }
}
