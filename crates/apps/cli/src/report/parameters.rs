//! Parameters that differ from their defaults.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use periplus_diagnostics::Diagnostics;
use periplus_localization::AMCL;
use periplus_msgs::rcl_interfaces::{ParameterEvent, ParameterType, ParameterValue};
use periplus_nav_nodes::slam_toolbox::Program;
use periplus_params::{ParamValue, ParamValues, Table};
use periplus_session::recorded::{each, has_type};

use super::OpenRun;
use super::html::{Section, escape, paragraph, table};
use crate::error::CliError;

/// Maximum number of rows.
const MAX_ROW_COUNT: usize = 1000;

pub(super) fn section(run: &OpenRun) -> Result<Section, CliError> {
    let title = run.heading("Parameters");
    let topics: Vec<&str> = run
        .bag
        .topics()
        .iter()
        .filter(|topic| has_type(topic, "ParameterEvent"))
        .map(|topic| topic.name.as_str())
        .collect();
    let mut values: BTreeMap<(String, String), ParameterValue> = BTreeMap::new();
    each::<ParameterEvent>(&run.bag, &topics, |_, event| {
        for parameter in event.new_parameters.into_iter().chain(event.changed_parameters) {
            values.insert((event.node.clone(), parameter.name), parameter.value);
        }
    })?;
    if values.is_empty() {
        let why = "The recording has no parameters (/parameter_events).";
        return Ok(Section { title, body: paragraph(why) });
    }
    let (mut different, mut unknown) = (Vec::new(), Vec::new());
    let mut equal = 0_usize;
    for ((node, name), value) in &values {
        let text = text_of(value);
        match default_of(node, name) {
            Some(default) if default == text => equal += 1,
            Some(default) => different.push([node.clone(), name.clone(), text, default]),
            None => unknown.push([node.clone(), name.clone(), text, String::new()]),
        }
    }
    let mut body = if different.is_empty() {
        paragraph(&format!("All {equal} parameters with a known default have it."))
    } else {
        let caption =
            format!("{} parameters differ from their defaults; {equal} are equal", different.len());
        table(&caption, &["node", "parameter", "value", "default"], &rows_of(&different, true))
    };
    if !unknown.is_empty() {
        let caption = format!("{} parameters without a known default", unknown.len());
        let head = ["node", "parameter", "value"];
        let inner = table(&caption, &head, &rows_of(&unknown, false));
        body.push_str(&format!("<details><summary>{caption}</summary>\n{inner}</details>\n"));
    }
    Ok(Section { title, body })
}

fn rows_of(parameters: &[[String; 4]], has_default: bool) -> String {
    let mut rows = String::new();
    for [node, name, text, default] in parameters.iter().take(MAX_ROW_COUNT) {
        let _ = write!(
            rows,
            "<tr><td>{}</td><th scope=\"row\">{}</th><td>{}</td>",
            escape(node),
            escape(name),
            escape(text)
        );
        if has_default {
            let _ = write!(rows, "<td class=\"quiet\">{}</td>", escape(default));
        }
        rows.push_str("</tr>\n");
    }
    if parameters.len() > MAX_ROW_COUNT {
        let more = parameters.len() - MAX_ROW_COUNT;
        let _ = writeln!(rows, "<tr><td colspan=\"4\">and {more} others</td></tr>");
    }
    rows
}

/// Returns the default of a parameter of a node that this program knows, as YAML.
fn default_of(node: &str, name: &str) -> Option<String> {
    let table: &'static Table = match node.rsplit('/').next()? {
        "amcl" => &AMCL,
        "slam_toolbox" => Program::Async.table(),
        "slam_gmapping" => Program::Gmapping.table(),
        _ => return None,
    };
    let defaults: ParamValues = table.check_given([], &mut Diagnostics::new());
    defaults.get(name).map(|value| value.to_string())
}

/// Returns a value as YAML.
fn text_of(value: &ParameterValue) -> String {
    let list = |items: Vec<String>| format!("[{}]", items.join(", "));
    match value.r#type {
        ParameterType::PARAMETER_BOOL => ParamValue::Bool(value.bool_value).to_string(),
        ParameterType::PARAMETER_INTEGER => ParamValue::Integer(value.integer_value).to_string(),
        ParameterType::PARAMETER_DOUBLE => ParamValue::Number(value.double_value).to_string(),
        ParameterType::PARAMETER_STRING => ParamValue::Text(value.string_value.clone()).to_string(),
        ParameterType::PARAMETER_BYTE_ARRAY => format!("{} bytes", value.byte_array_value.len()),
        ParameterType::PARAMETER_BOOL_ARRAY => {
            list(value.bool_array_value.iter().map(ToString::to_string).collect())
        }
        ParameterType::PARAMETER_INTEGER_ARRAY => {
            list(value.integer_array_value.iter().map(ToString::to_string).collect())
        }
        ParameterType::PARAMETER_DOUBLE_ARRAY => {
            ParamValue::Numbers(value.double_array_value.clone()).to_string()
        }
        ParameterType::PARAMETER_STRING_ARRAY => {
            ParamValue::Texts(value.string_array_value.clone()).to_string()
        }
        _ => "not set".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn defaults_of_known_nodes_are_found() {
        assert_eq!(default_of("/robot/amcl", "max_particles").as_deref(), Some("2000"));
        assert_eq!(default_of("/slam_toolbox", "resolution").as_deref(), Some("0.05"));
        assert_eq!(default_of("/talker", "resolution"), None);
        let value = ParameterValue {
            r#type: ParameterType::PARAMETER_DOUBLE,
            double_value: 0.05,
            ..ParameterValue::default()
        };
        assert_eq!(text_of(&value), "0.05");
    }
}
