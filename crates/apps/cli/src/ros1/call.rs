//! `periplus ros1 call`: a service with values as `rosservice call` takes them.

use std::process::ExitCode;

use clap::Args;
use periplus_msgs::{Layout, TypeRegistry};
use periplus_ros1::ros2_service_type;
use periplus_ros2cli::service;

use super::{client, failed, full};
use crate::error::CliError;
use crate::run_options::LiveNetworkOptions;
use crate::verbs::{Common, with_session};

/// Call a service of ROS 1; its type comes from its server
///
/// The values are one dictionary as YAML, or one word for each field of the request.
#[derive(Debug, Args)]
pub(crate) struct CallOptions {
    /// Service
    service: String,
    /// Request
    #[arg(allow_negative_numbers = true, trailing_var_arg = true)]
    values: Vec<String>,
}

pub(super) fn run(options: &CallOptions) -> Result<ExitCode, CliError> {
    let client = client()?;
    let name = full(&options.service);
    let of = client.service_type(&name).map_err(|error| failed(&client, error))?;
    let of = ros2_service_type(&of)
        .ok_or_else(|| CliError::failed(format!("{name} has the type `{of}`, which is none")))?;
    let layout = TypeRegistry::ros1().layout(&format!("{of}_Request"));
    let layout = layout.ok_or_else(|| CliError::failed(format!("the type {of} is unknown")))?;
    let values = request(layout, &options.values).map_err(CliError::usage)?;
    let common = Common { network: LiveNetworkOptions::ROS1, ..Common::default() };
    with_session(&common, |session| service::call(session, &name, &of, &values, None))
}

/// YAML of a request.
fn request(layout: &Layout, words: &[String]) -> Result<String, String> {
    let fields: Vec<&str> = layout.fields().collect();
    match words {
        [] => return Ok("{}".to_owned()),
        [one]
            if one.trim_start().starts_with('{')
                || fields.iter().any(|field| one.contains(&format!("{field}:"))) =>
        {
            return Ok(one.clone());
        }
        _ => {}
    }
    if words.len() != fields.len() {
        return Err(format!(
            "the request has {} fields ({}), and {} values are given",
            fields.len(),
            fields.join(", "),
            words.len()
        ));
    }
    let pairs = fields.iter().zip(words).map(|(field, word)| format!("{field}: {word}"));
    Ok(format!("{{{}}}", pairs.collect::<Vec<_>>().join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_belong_to_the_fields_in_their_order() {
        let layout = TypeRegistry::ros1().layout("std_srvs/srv/SetBool_Request").expect("a type");
        let words = |words: &[&str]| -> Vec<String> {
            words.iter().map(|word| (*word).to_owned()).collect()
        };
        assert_eq!(request(layout, &words(&["true"])).as_deref(), Ok("{data: true}"));
        assert_eq!(request(layout, &words(&["data: true"])).as_deref(), Ok("data: true"));
        assert_eq!(request(layout, &[]).as_deref(), Ok("{}"));
        assert!(request(layout, &words(&["1", "2"])).is_err());
    }
}
