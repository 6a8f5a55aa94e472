//! Environment variables common to all transports.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_resources::Host;

/// Highest domain id with valid ports: 7400 + 250 per domain, below 65536.
const HIGHEST_DOMAIN: u32 = 232;

/// Returns the value of a variable that is set and not empty.
#[must_use]
pub fn variable(host: &dyn Host, name: &str) -> Option<String> {
    host.variable(name).filter(|value| !value.trim().is_empty())
}

/// Reads `ROS_DOMAIN_ID`; programs in another domain are invisible. Invalid values give 0.
pub fn domain_id(host: &dyn Host, findings: &mut Diagnostics) -> u32 {
    let Some(value) = variable(host, "ROS_DOMAIN_ID") else { return 0 };
    match value.trim().parse() {
        Ok(id) if id <= HIGHEST_DOMAIN => id,
        _ => {
            findings.push(
                not_used("ROS_DOMAIN_ID", &value).help(format!(
                    "it must be a number from 0 to {HIGHEST_DOMAIN}; domain 0 is used"
                )),
            );
            0
        }
    }
}

/// Warning that the value of a variable is invalid.
#[must_use]
pub fn not_used(name: &str, value: &str) -> Diagnostic {
    let message = format!("the environment variable {name} is `{value}` and is not used");
    Diagnostic::warning("ros-environment", message)
}

#[cfg(test)]
mod tests {
    use super::*;
    use periplus_resources::MemoryHost;

    #[track_caller]
    fn check(value: &str, expected: u32, is_told: bool) {
        let host = MemoryHost::default().with_variable("ROS_DOMAIN_ID", value);
        let mut findings = Diagnostics::default();
        assert_eq!(domain_id(&host, &mut findings), expected);
        assert_eq!(findings.iter().count(), usize::from(is_told), "{value}");
    }

    #[test]
    fn the_domain_is_a_number_that_has_ports() {
        check("", 0, false);
        check(" 42 ", 42, false);
        check("232", 232, false);
        check("233", 0, true);
        check("-1", 0, true);
        check("home", 0, true);
    }
}
