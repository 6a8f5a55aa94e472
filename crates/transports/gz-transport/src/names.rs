//! Names of topics and services, and their partitions.

use crate::GzTransportError;

/// Maximum length of a name \[bytes\].
pub const MOST_NAME: usize = 65_535;

/// A name with its partition. On the network it is `@/partition@/topic`.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Name {
    full: String,
    /// Start of the topic.
    topic: usize,
}

impl Name {
    /// Creates a name from user input; the leading slash is optional.
    ///
    /// # Errors
    /// When it is not a valid name.
    pub fn new(partition: &str, topic: &str) -> Result<Self, GzTransportError> {
        let wrong = |why| Err(GzTransportError::Name { name: topic.to_owned(), why });
        let bare = topic.trim_end_matches('/');
        if bare.is_empty() {
            return wrong("it is empty");
        }
        if topic.len() + partition.len() + 4 > MOST_NAME {
            return wrong("it is too long");
        }
        if topic.contains([' ', '~', '@']) || topic.contains("//") || topic.contains(":=") {
            return wrong("spaces, `~`, `@`, `//` and `:=` are not allowed");
        }
        let partition = partition.trim_matches('/');
        let slash = if partition.is_empty() { "" } else { "/" };
        let first = if bare.starts_with('/') { "" } else { "/" };
        let full = format!("@{slash}{partition}@{first}{bare}");
        Ok(Self { topic: full.len() - bare.len() - first.len(), full })
    }

    /// Parses a name from the network; none if it is invalid.
    #[must_use]
    pub fn read(full: &str) -> Option<Self> {
        let rest = full.strip_prefix('@')?;
        let (partition, topic) = rest.split_once('@')?;
        let is_name = topic.len() > 1 && topic.starts_with('/') && !topic.contains('@');
        (is_name && full.len() <= MOST_NAME)
            .then(|| Self { full: full.to_owned(), topic: partition.len() + 2 })
    }

    /// Full name as on the network.
    #[must_use]
    pub fn full(&self) -> &str {
        &self.full
    }

    /// Name without partition.
    #[must_use]
    pub fn topic(&self) -> &str {
        &self.full[self.topic..]
    }

    /// True if both are in one partition.
    #[must_use]
    pub fn is_beside(&self, other: &Self) -> bool {
        self.full[..self.topic] == other.full[..other.topic]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(partition: &str, topic: &str, full: &str, bare: &str) {
        let name = Name::new(partition, topic).expect("a name");
        assert_eq!((name.full(), name.topic()), (full, bare));
        assert_eq!(Name::read(full), Some(name));
    }

    #[test]
    fn names_have_their_partition_in_front() {
        check("host:me", "/scan", "@/host:me@/scan", "/scan");
        check("host:me", "scan/", "@/host:me@/scan", "/scan");
        check("", "/world/w/stats", "@@/world/w/stats", "/world/w/stats");
        check("/p/", "a", "@/p@/a", "/a");
    }

    #[test]
    fn what_gazebo_refuses_is_refused() {
        for topic in ["", "/", "a b", "~/a", "/a//b", "a@b", "a:=b", &"x".repeat(70_000)] {
            assert!(Name::new("p", topic).is_err(), "{topic}");
        }
        for full in ["", "@", "@p@", "@p@/", "p@/a", "@/p@a", "@/p@/a@b"] {
            assert_eq!(Name::read(full), None, "{full}");
        }
    }
}
