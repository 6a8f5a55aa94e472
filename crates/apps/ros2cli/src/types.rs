//! Types available to a verb, and help for unknown ones.

use std::sync::Arc;

use periplus_diagnostics::closest;
use periplus_msgs::{Layout, TypeRegistry};
use periplus_rosidl::{InterfaceKind, TypeName};

use crate::{Failure, Outcome};

/// Types by name: built-in ones, and those of the user's packages.
pub enum Types {
    /// Built-in types only.
    Builtin,
    /// Built-in and user types.
    With(Box<TypeRegistry>),
}

impl Types {
    /// All types.
    #[must_use]
    pub fn registry(&self) -> &TypeRegistry {
        match self {
            Self::Builtin => TypeRegistry::builtin(),
            Self::With(types) => types,
        }
    }

    /// Looks up a message type, written as `std_msgs/msg/String` or `std_msgs/String`.
    ///
    /// # Errors
    /// When it is unknown.
    pub fn message(&self, name: &str) -> Outcome<&Arc<Layout>> {
        let full = full_type(name, InterfaceKind::Message)?;
        self.registry().layout(&full).ok_or_else(|| self.unknown("message", &full))
    }

    /// Looks up request and response of a service type: `std_srvs/srv/Trigger` or
    /// `std_srvs/Trigger`.
    ///
    /// # Errors
    /// When it is unknown.
    pub fn service(&self, name: &str) -> Outcome<(String, &Arc<Layout>, &Arc<Layout>)> {
        let full = full_type(name, InterfaceKind::Service)?;
        let part = |part: &str| self.registry().layout(&format!("{full}_{part}"));
        match (part("Request"), part("Response")) {
            (Some(request), Some(response)) => Ok((full, request, response)),
            _ => Err(self.unknown("service", &full)),
        }
    }

    /// Looks up a type that is part of an action, such as `nav2_msgs/action/Wait_Goal`.
    ///
    /// # Errors
    /// When it is unknown.
    pub fn action(&self, name: &str, part: &str) -> Outcome<(String, &Arc<Layout>)> {
        let full = full_type(name, InterfaceKind::Action)?;
        match self.registry().layout(&format!("{full}_{part}")) {
            Some(layout) => Ok((full, layout)),
            None => Err(self.unknown("action", &full)),
        }
    }

    fn unknown(&self, what: &str, name: &str) -> Failure {
        // Types of the same package, or of the same name in another package.
        let parts = |name: &str| {
            let mut parts = name.split('/').map(str::to_owned);
            (parts.next(), parts.next_back())
        };
        let (package, last) = parts(name);
        let alike = |known: &String| {
            let (other_package, other_last) = parts(known);
            package == other_package || last == other_last
        };
        let known = self.registry().registry().interfaces().map(|one| one.name.to_string());
        let known: Vec<String> = known.filter(alike).collect();
        let near = closest(name, known.iter().map(String::as_str));
        let near = near.map_or(String::new(), |near| format!("Did you mean `{near}`? "));
        let package = package.unwrap_or_default();
        Failure::failed(format!(
            "the {what} type `{name}` is unknown. {near}If it is in a package of yours, give its \
             folder with `--interfaces DIR`, or add the install prefix of `{package}` \
             to AMENT_PREFIX_PATH"
        ))
    }
}

/// Full name of a type that may be written without its kind.
pub(crate) fn full_type(name: &str, kind: InterfaceKind) -> Outcome<String> {
    let parts: Vec<&str> = name.split('/').collect();
    let full = match parts[..] {
        [package, name] => format!("{package}/{}/{name}", kind.word()),
        _ => name.to_owned(),
    };
    match TypeName::read(&full) {
        Some(known) if known.kind == kind => Ok(full),
        _ => Err(Failure::Usage(format!(
            "`{name}` is not a valid {} type; write `package/{}/Name`",
            match kind {
                InterfaceKind::Message => "message",
                InterfaceKind::Service => "service",
                InterfaceKind::Action => "action",
            },
            kind.word()
        ))),
    }
}
