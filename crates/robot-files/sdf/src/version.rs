//! Versions of the format.

/// A version such as 1.9.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Version {
    /// The number before the point.
    pub major: u32,
    /// The number after the point.
    pub minor: u32,
}

impl Version {
    /// Newest supported version.
    pub const NEWEST: Self = Self::new(12);

    /// Version `1.minor`.
    #[must_use]
    pub const fn new(minor: u32) -> Self {
        Self { major: 1, minor }
    }

    /// Reads `1.9`, or `1.9.0`.
    #[must_use]
    pub fn parse(text: &str) -> Option<Self> {
        let mut parts = text.trim().split('.');
        let major = parts.next()?.parse().ok()?;
        let minor = parts.next()?.parse().ok()?;
        let patch = parts.next().map_or(Ok(0), str::parse::<u32>);
        (patch.is_ok() && parts.next().is_none()).then_some(Self { major, minor })
    }
}

impl std::fmt::Display for Version {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}.{}", self.major, self.minor)
    }
}
