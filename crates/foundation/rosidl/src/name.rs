//! Names of types.

use std::fmt;

/// Folder of the package in which an interface is defined.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum InterfaceKind {
    /// `action`: goal, result and feedback.
    Action,
    /// `msg`: one message.
    Message,
    /// `srv`: request and response.
    Service,
}

impl InterfaceKind {
    /// Folder, file extension and middle part of a type's name: `msg`, `srv`, `action`.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Action => "action",
            Self::Message => "msg",
            Self::Service => "srv",
        }
    }

    /// Kind with this [`InterfaceKind::word`].
    #[must_use]
    pub fn from_word(word: &str) -> Option<Self> {
        [Self::Action, Self::Message, Self::Service].into_iter().find(|kind| kind.word() == word)
    }
}

/// Full name of a type, such as `sensor_msgs/msg/LaserScan`.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct TypeName {
    /// Such as `sensor_msgs`.
    pub package: String,
    /// Such as [`InterfaceKind::Message`].
    pub kind: InterfaceKind,
    /// Such as `LaserScan`, or `Trigger_Request` for an implied type of a service.
    pub name: String,
}

impl TypeName {
    /// Name of a message.
    #[must_use]
    pub fn message(package: &str, name: &str) -> Self {
        Self { package: package.into(), kind: InterfaceKind::Message, name: name.into() }
    }

    /// Parses `package/kind/Name`, or `package/Name` for a message; `None` for other text.
    #[must_use]
    pub fn read(text: &str) -> Option<Self> {
        let parts: Vec<&str> = text.split('/').collect();
        let (package, kind, name) = match parts[..] {
            [package, name] => (package, InterfaceKind::Message, name),
            [package, kind, name] => (package, InterfaceKind::from_word(kind)?, name),
            _ => return None,
        };
        let stem = name.split('_').all(is_type_name);
        (is_package_name(package) && stem).then(|| Self {
            package: package.into(),
            kind,
            name: name.into(),
        })
    }

    /// Name of a type implied by this one: `Trigger` and `Request` give `Trigger_Request`.
    #[must_use]
    pub fn implied(&self, suffix: &str) -> Self {
        Self { name: format!("{}_{suffix}", self.name), ..self.clone() }
    }

    /// `package/Name`, as in schema texts.
    #[must_use]
    pub fn short(&self) -> String {
        format!("{}/{}", self.package, self.name)
    }
}

impl fmt::Display for TypeName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}/{}", self.package, self.kind.word(), self.name)
    }
}

/// Rules of the ROS 2 design article "Interface definition using .msg/.srv/.action files", as in
/// `rosidl_adapter`.
pub(crate) fn is_package_name(name: &str) -> bool {
    starts_with(name, |c| c.is_ascii_lowercase())
        && name.bytes().all(|b| b.is_ascii_lowercase() || b.is_ascii_digit() || b == b'_')
}

pub(crate) fn is_type_name(name: &str) -> bool {
    starts_with(name, |c| c.is_ascii_uppercase()) && name.bytes().all(|b| b.is_ascii_alphanumeric())
}

pub(crate) fn is_field_name(name: &str) -> bool {
    is_package_name(name) && !name.contains("__") && !name.ends_with('_')
}

pub(crate) fn is_constant_name(name: &str) -> bool {
    starts_with(name, |c| c.is_ascii_uppercase())
        && name.bytes().all(|b| b.is_ascii_uppercase() || b.is_ascii_digit() || b == b'_')
        && !name.contains("__")
        && !name.ends_with('_')
}

fn starts_with(name: &str, test: impl Fn(char) -> bool) -> bool {
    name.chars().next().is_some_and(test)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_in_both_lengths() {
        let scan = TypeName::message("sensor_msgs", "LaserScan");
        assert_eq!(TypeName::read("sensor_msgs/msg/LaserScan"), Some(scan.clone()));
        assert_eq!(TypeName::read("sensor_msgs/LaserScan"), Some(scan.clone()));
        assert_eq!(scan.to_string(), "sensor_msgs/msg/LaserScan");
        let request = TypeName::read("std_srvs/srv/Trigger_Request").unwrap();
        assert_eq!(request.to_string(), "std_srvs/srv/Trigger_Request");
        for wrong in ["LaserScan", "sensor_msgs/lib/LaserScan", "a/b/c/D", "a/", "A/B", ""] {
            assert_eq!(TypeName::read(wrong), None, "{wrong}");
        }
    }
}
