//! Single table of all parameters of a costmap node.

use std::sync::Mutex;

use periplus_costmap::{CostmapConfig, LayerConfig, tables};
use periplus_diagnostics::Diagnostics;
use periplus_params::{ParamValues, Parameter, Table};

/// Cache of created tables. A table lives as long as the program, so equal tables are shared.
static MADE: Mutex<Vec<&'static Table>> = Mutex::new(Vec::new());

/// Returns the parts of the table: name prefixes and values.
fn parts(config: &CostmapConfig) -> Vec<(String, &ParamValues)> {
    fn layers<'a>(list: &'a [LayerConfig], parts: &mut Vec<(String, &'a ParamValues)>) {
        for layer in list {
            parts.push((format!("{}.", layer.name), &layer.values));
            for source in &layer.sources {
                parts.push((format!("{}.{}.", layer.name, source.name), &source.values));
            }
            layers(&layer.children, parts);
        }
    }
    let mut parts = vec![(String::new(), &config.node)];
    layers(&config.layers, &mut parts);
    layers(&config.filters, &mut parts);
    parts
}

/// Returns all parameters of a costmap in one table, with names such as
/// `obstacle_layer.scan.topic`.
#[must_use]
pub fn node_values(config: &CostmapConfig) -> ParamValues {
    let parts = parts(config);
    let mut parameters: Vec<(String, Parameter)> = Vec::new();
    for (prefix, values) in &parts {
        for parameter in values.table().parameters {
            parameters.push((format!("{prefix}{}", parameter.name), *parameter));
        }
    }
    let mut values = table(parameters).check([], None, &mut Diagnostics::new());
    for (prefix, part) in &parts {
        for parameter in part.table().parameters {
            if let Some(value) = part.get(parameter.name) {
                values.set(&format!("{prefix}{}", parameter.name), value);
            }
        }
    }
    values
}

/// Returns a table of these parameters, shared with an equal one.
fn table(parameters: Vec<(String, Parameter)>) -> &'static Table {
    let mut made = MADE.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    let is_same = |table: &&&'static Table| {
        table.parameters.len() == parameters.len()
            && table.parameters.iter().zip(&parameters).all(|(made, (name, parameter))| {
                made.name == name && Parameter { name: parameter.name, ..*made } == bare(parameter)
            })
    };
    if let Some(table) = made.iter().find(is_same) {
        return table;
    }
    let named = parameters.into_iter().map(|(name, parameter)| {
        let name: &'static str = String::leak(name);
        Parameter { name, ..bare(&parameter) }
    });
    let table: &'static Table = Box::leak(Box::new(Table {
        name: tables::COSTMAP.name,
        doc: tables::COSTMAP.doc,
        parameters: Vec::leak(named.collect()),
    }));
    made.push(table);
    table
}

/// Removes alternative names, which are for files only.
fn bare(parameter: &Parameter) -> Parameter {
    Parameter { aliases: &[], ..*parameter }
}

/// Returns the parameters of one table from all parameters; `prefix` is the prefix of its names,
/// such as `inflation_layer.`.
#[must_use]
pub fn split(all: &ParamValues, prefix: &str, usual: &ParamValues) -> ParamValues {
    let mut values = usual.clone();
    for parameter in usual.table().parameters {
        let name = format!("{prefix}{}", parameter.name);
        if all.table().find(&name).is_some()
            && let Some(value) = all.get(&name)
            && usual.get(parameter.name).as_ref() != Some(&value)
        {
            values.set(parameter.name, value);
        }
    }
    values
}
