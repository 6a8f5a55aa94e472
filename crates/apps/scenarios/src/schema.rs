//! JSON schema of scenario files.

use periplus_faults::FaultKind;
use periplus_params::{Default as ParamDefault, ParamType, ParamValue, Parameter, Table};
use serde_json::{Map, Value, json};

use crate::tables::{ASSERTIONS, EVENTS, FAULT_EVENT, NODES, ROBOT, SCENARIO, TRIGGER};

/// JSON schema (draft 2020-12) of scenario files, from the declarations that the reader uses. Editors complete and check
/// YAML files by it.
#[must_use]
pub fn json_schema() -> Value {
    let mut top = object(&SCENARIO);
    let robot = {
        let mut robot = object(&ROBOT);
        robot["properties"]["arguments"] = json!({
            "description": "Arguments of the xacro of the robot.",
            "type": "object",
            "additionalProperties": { "type": ["string", "number", "boolean"] },
        });
        robot
    };
    let node_properties: Map<String, Value> = NODES
        .iter()
        .map(|table| {
            let section = json!({ "anyOf": [object(table), { "type": ["boolean", "null"] }] });
            (table.name.to_owned(), section)
        })
        .collect();
    let node_words: Vec<&str> = NODES.iter().map(|table| table.name).collect();
    let sections = [
        ("robot", robot),
        (
            "nodes",
            json!({
                "description": "Nodes beside the robot.",
                "anyOf": [
                    { "type": "array", "items": { "enum": node_words } },
                    { "type": "object", "properties": node_properties, "additionalProperties": false },
                ],
            }),
        ),
        (
            "parameters",
            json!({
                "description": "Parameters by node.",
                "type": "object",
                "additionalProperties": { "type": "object" },
            }),
        ),
        (
            "variables",
            json!({
                "description": "Values for $(name) anywhere in the file; `--set name=value` replaces them.",
                "type": "object",
                "additionalProperties": { "type": ["string", "number", "boolean", "array"] },
            }),
        ),
        ("faults", json!({ "description": "Faults by time.", "type": "array", "items": fault() })),
        (
            "drive",
            json!({
                "description": "Scripted driving: velocities by time, or points to drive to.",
                "type": "array",
                "items": { "type": "object" },
            }),
        ),
        ("events", json!({ "description": "Events.", "type": "array", "items": event() })),
        (
            "assertions",
            json!({ "description": "Assertions.", "type": "array", "minItems": 1, "items": assertion() }),
        ),
    ];
    for (name, section) in sections {
        top["properties"][name] = section;
    }
    if let Some(required) = top["required"].as_array_mut() {
        required.push(json!("assertions"));
    }
    top["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    top["title"] = json!("Periplus scenario");
    top
}

fn fault() -> Value {
    one_of(FaultKind::tables(), &[])
}

fn event() -> Value {
    let triggers = object(&TRIGGER);
    let mut properties = triggers["properties"].clone();
    for table in EVENTS {
        properties[table.name] = with_short_form(table);
    }
    properties["publish"]["anyOf"][0]["properties"]["message"] =
        json!({ "description": "Fields of the message.", "type": "object" });
    properties[FAULT_EVENT] = fault();
    let words: Vec<&str> = EVENTS.iter().map(|table| table.name).chain([FAULT_EVENT]).collect();
    let required: Vec<Value> = words.iter().map(|word| json!({ "required": [word] })).collect();
    json!({
        "type": "object",
        "properties": properties,
        "additionalProperties": false,
        "oneOf": required,
    })
}

fn assertion() -> Value {
    let needs_nothing = |table: &&&Table| {
        table.parameters.iter().all(|parameter| parameter.default != ParamDefault::Required)
    };
    let words: Vec<&str> = ASSERTIONS.iter().filter(needs_nothing).map(|it| it.name).collect();
    one_of(&ASSERTIONS, &words)
}

/// An object with one of the words as its only property, or one of the words that may be alone.
fn one_of(tables: &[&'static Table], alone: &[&str]) -> Value {
    let properties: Map<String, Value> =
        tables.iter().map(|table| (table.name.to_owned(), with_short_form(table))).collect();
    let object = json!({
        "type": "object",
        "properties": properties,
        "additionalProperties": false,
        "minProperties": 1,
        "maxProperties": 1,
    });
    if alone.is_empty() { object } else { json!({ "anyOf": [object, { "enum": alone }] }) }
}

/// Object of a table, or the value of its main parameter.
fn with_short_form(table: &'static Table) -> Value {
    let is_required = |parameter: &&Parameter| parameter.default == ParamDefault::Required;
    let main = table.parameters.iter().find(is_required).or(table.parameters.first());
    let mut forms = vec![object(table)];
    match main {
        Some(main) => forms.push(value(main)),
        None => forms.push(json!({ "type": "null" })),
    }
    json!({ "description": table.doc, "anyOf": forms })
}

fn object(table: &Table) -> Value {
    let properties: Map<String, Value> =
        table.parameters.iter().map(|it| (it.name.to_owned(), value(it))).collect();
    let is_required = |it: &&Parameter| it.default == ParamDefault::Required;
    let required: Vec<&str> =
        table.parameters.iter().filter(is_required).map(|it| it.name).collect();
    json!({
        "description": table.doc,
        "type": "object",
        "properties": properties,
        "required": required,
        "additionalProperties": false,
    })
}

fn value(parameter: &Parameter) -> Value {
    let unit = parameter.unit.map(|unit| format!(" [{unit}]")).unwrap_or_default();
    let mut schema = match parameter.kind {
        ParamType::Bool => json!({ "type": "boolean" }),
        ParamType::Integer => json!({ "type": "integer" }),
        ParamType::Number => json!({ "type": "number" }),
        ParamType::Text => json!({ "type": ["string", "number", "boolean"] }),
        ParamType::NumberList => json!({ "type": "array", "items": { "type": "number" } }),
        ParamType::TextList => json!({ "type": "array", "items": { "type": "string" } }),
        ParamType::Choice(words) => json!({ "enum": words }),
        ParamType::Group => json!({ "type": "object" }),
    };
    schema["description"] = json!(format!("{}{unit}", parameter.doc));
    if let ParamDefault::Value(text) = parameter.default {
        schema["default"] = match ParamValue::read(parameter, text) {
            Ok(ParamValue::Bool(value)) => json!(value),
            Ok(ParamValue::Integer(value)) => json!(value),
            Ok(ParamValue::Number(value)) => json!(value),
            Ok(ParamValue::Text(value)) => json!(value),
            Ok(ParamValue::Numbers(values)) => json!(values),
            Ok(ParamValue::Texts(values)) => json!(values),
            Err(_) => Value::Null,
        };
    }
    if let Some(range) = parameter.range.filter(|_| parameter.kind != ParamType::NumberList) {
        let least = if range.above { "exclusiveMinimum" } else { "minimum" };
        if range.min.is_finite() {
            schema[least] = json!(range.min);
        }
        if range.max.is_finite() {
            schema["maximum"] = json!(range.max);
        }
    }
    schema
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_word_of_the_reader_is_in_the_schema() {
        let schema = json_schema();
        let assertions = &schema["properties"]["assertions"]["items"]["anyOf"][0]["properties"];
        for table in ASSERTIONS {
            assert!(assertions[table.name].is_object(), "{}", table.name);
        }
        let faults = &schema["properties"]["faults"]["items"]["properties"];
        for table in FaultKind::tables() {
            let own = &faults[table.name]["anyOf"][0]["properties"];
            for parameter in table.parameters {
                assert!(own[parameter.name]["description"].is_string(), "{}", parameter.name);
            }
        }
        assert_eq!(schema["properties"]["timeout"]["default"], json!(60.0));
        assert_eq!(schema["required"], json!(["world", "assertions"]));
    }
}
