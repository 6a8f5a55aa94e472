//! Anchors of headings, by the rule that GitHub and mdbook share.

use std::collections::BTreeMap;

/// The anchors of one page.
#[derive(Default)]
pub(crate) struct Anchors {
    used: BTreeMap<String, usize>,
}

impl Anchors {
    /// The anchor of the next heading: lower case, spaces as `-`, no punctuation; a repeated anchor gets
    /// `-1`, `-2`, and so on.
    pub(crate) fn add(&mut self, heading: &str) -> String {
        let kept = heading.trim().chars().filter_map(|letter| match letter {
            ' ' => Some('-'),
            '-' | '_' => Some(letter),
            _ => letter.is_alphanumeric().then_some(letter),
        });
        let anchor: String = kept.flat_map(char::to_lowercase).collect();
        let count = self.used.entry(anchor.clone()).or_default();
        *count += 1;
        if *count == 1 { anchor } else { format!("{anchor}-{}", *count - 1) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn anchors_follow_the_common_rule() {
        let mut anchors = Anchors::default();
        assert_eq!(anchors.add("Who sees whom"), "who-sees-whom");
        assert_eq!(anchors.add("`/diagnostics`, and more"), "diagnostics-and-more");
        assert_eq!(anchors.add("--method graph"), "--method-graph");
        assert_eq!(anchors.add("use_sim_time"), "use_sim_time");
        assert_eq!(anchors.add("Who sees whom"), "who-sees-whom-1");
    }
}
