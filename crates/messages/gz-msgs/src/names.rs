//! Names of message types.

/// Naming scheme of types: it changed between releases, while the meaning did not.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Dialect {
    /// `gz.msgs.LaserScan`: Garden, Harmonic and later.
    #[default]
    Gz,
    /// `ignition.msgs.LaserScan`: Fortress and before, which is also what Debian has.
    Ignition,
}

impl Dialect {
    /// Full name of a type.
    #[must_use]
    pub fn full_name(self, bare: &str) -> String {
        match self {
            Self::Gz => format!("gz.msgs.{bare}"),
            Self::Ignition => format!("ignition.msgs.{bare}"),
        }
    }

    /// Naming scheme of a full name.
    #[must_use]
    pub fn of(full: &str) -> Option<Self> {
        match bare_name(full) {
            Some(_) if full.contains("ignition") || full.contains("ign_msgs") => {
                Some(Self::Ignition)
            }
            Some(_) => Some(Self::Gz),
            None => None,
        }
    }
}

/// Name of a type without its package; `None` for other packages.
///
/// A generated Python or C++ name such as `gz_msgs.LaserScan` or `.gz.msgs.LaserScan` is accepted too, as
/// in Gazebo's own tools.
#[must_use]
pub fn bare_name(full: &str) -> Option<&str> {
    let full = full.strip_prefix('.').unwrap_or(full);
    let fronts = ["gz.msgs.", "ignition.msgs.", "gz_msgs.", "ign_msgs."];
    fronts.iter().find_map(|front| full.strip_prefix(front)).filter(|bare| !bare.is_empty())
}

#[test]
fn names_of_all_releases_are_understood() {
    for (full, dialect) in [
        ("gz.msgs.LaserScan", Dialect::Gz),
        (".gz.msgs.LaserScan", Dialect::Gz),
        ("gz_msgs.LaserScan", Dialect::Gz),
        ("ignition.msgs.LaserScan", Dialect::Ignition),
        ("ign_msgs.LaserScan", Dialect::Ignition),
    ] {
        assert_eq!(bare_name(full), Some("LaserScan"), "{full}");
        assert_eq!(Dialect::of(full), Some(dialect), "{full}");
    }
    assert_eq!(bare_name("gz.msgs."), None);
    assert_eq!(bare_name("google.protobuf.Any"), None);
    assert_eq!(Dialect::of("google.protobuf.Any"), None);
    assert_eq!(Dialect::Ignition.full_name("Pose_V"), "ignition.msgs.Pose_V");
}
