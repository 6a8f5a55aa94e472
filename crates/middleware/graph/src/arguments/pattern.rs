//! Patterns for full node names.

/// A pattern such as `/a/*/b/**`: `*` matches one part of a name, `**` any number of parts,
/// including none.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Pattern {
    written: String,
}

impl Pattern {
    /// Parses a pattern; the leading slash is optional. The error is the rest of "the pattern ...".
    pub(super) fn read(written: &str) -> Result<Self, String> {
        let parts = written.trim_matches('/').split('/');
        for part in parts {
            let is_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
            if part.is_empty() {
                return Err("has an empty part".into());
            }
            if part == "*" || part == "**" || part.chars().all(is_name) {
                continue;
            }
            return Err(if part.contains('*') {
                format!(
                    "has a wildcard inside `{part}`; `*` matches a whole part of a name, `**` any \
                     number of parts"
                )
            } else {
                format!(
                    "has `{part}`, which is not a node name: only letters, digits and `_` are allowed"
                )
            });
        }
        Ok(Self { written: format!("/{}", written.trim_matches('/')) })
    }

    /// Matches all nodes.
    pub(super) fn all() -> Self {
        Self { written: "/**".into() }
    }

    pub(super) fn written(&self) -> &str {
        &self.written
    }

    pub(super) fn fits(&self, node: &str) -> bool {
        let parts: Vec<&str> = self.written[1..].split('/').collect();
        let names: Vec<&str> = node.trim_start_matches('/').split('/').collect();
        // `open[k]`: the parts so far match the first `k` names.
        let mut open = vec![false; names.len() + 1];
        open[0] = true;
        for part in parts {
            let mut next = vec![false; names.len() + 1];
            for at in 0..=names.len() {
                next[at] = match part {
                    "**" => open[at] || (0 < at && next[at - 1]),
                    "*" => 0 < at && open[at - 1],
                    name => 0 < at && open[at - 1] && names[at - 1] == name,
                };
            }
            open = next;
        }
        open[names.len()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wildcards_are_whole_parts() {
        let fits = |pattern: &str, node: &str| Pattern::read(pattern).unwrap().fits(node);
        assert!(fits("/**", "/a") && fits("/**", "/a/b/c") && fits("**", "/a"));
        assert!(fits("/*/b", "/a/b") && !fits("/*/b", "/b") && !fits("/*/b", "/a/x/b"));
        assert!(fits("/**/b", "/b") && fits("/**/b", "/a/x/b") && !fits("/**/b", "/b/c"));
        assert!(fits("/a/**", "/a") && fits("/a/**", "/a/b") && !fits("/a/**", "/ab"));
        assert!(fits("b", "/b") && !fits("b", "/a/b"));
        assert!(fits("/a/**/c/*", "/a/b/c/c/d") && !fits("/a/**/c/*", "/a/c"));
        for wrong in ["/foo*", "", "/", "a//b", "a b", "/***"] {
            assert!(Pattern::read(wrong).is_err(), "{wrong}");
        }
    }
}
