//! Access to parameters that some tables lack.

use periplus_params::ParamValues;

fn has(values: &ParamValues, name: &str) -> bool {
    values.table().find(name).is_some()
}

pub(crate) fn flag(values: &ParamValues, name: &str) -> Option<bool> {
    has(values, name).then(|| values.flag(name)).flatten()
}

pub(crate) fn number(values: &ParamValues, name: &str) -> Option<f64> {
    has(values, name).then(|| values.number(name)).flatten()
}

pub(crate) fn integer(values: &ParamValues, name: &str) -> Option<i64> {
    has(values, name).then(|| values.integer(name)).flatten()
}

pub(crate) fn text(values: &ParamValues, name: &str) -> Option<String> {
    has(values, name).then(|| values.text(name)).flatten()
}

pub(crate) fn numbers(values: &ParamValues, name: &str) -> Vec<f64> {
    if has(values, name) { values.numbers(name) } else { Vec::new() }
}

pub(crate) fn is_given(values: &ParamValues, name: &str) -> bool {
    has(values, name) && values.is_given(name)
}
