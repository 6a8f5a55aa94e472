//! Parameters of tables that do not have all of them.

use periplus_params::Values;

fn has(values: &Values, name: &str) -> bool {
    values.table().find(name).is_some()
}

pub(crate) fn flag(values: &Values, name: &str) -> Option<bool> {
    has(values, name).then(|| values.flag(name)).flatten()
}

pub(crate) fn number(values: &Values, name: &str) -> Option<f64> {
    has(values, name).then(|| values.number(name)).flatten()
}

pub(crate) fn integer(values: &Values, name: &str) -> Option<i64> {
    has(values, name).then(|| values.integer(name)).flatten()
}

pub(crate) fn text(values: &Values, name: &str) -> Option<String> {
    has(values, name).then(|| values.text(name)).flatten()
}

pub(crate) fn numbers(values: &Values, name: &str) -> Vec<f64> {
    if has(values, name) { values.numbers(name) } else { Vec::new() }
}

pub(crate) fn is_given(values: &Values, name: &str) -> bool {
    has(values, name) && values.is_given(name)
}
