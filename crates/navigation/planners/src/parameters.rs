//! Parameters of a plugin that can change between two plans.

use periplus_diagnostics::closest;
use periplus_params::{ParamType, ParamValue, ParamValues};

use crate::ParameterRejected;

/// Rules of Nav2 for changes while the node runs.
#[derive(Debug)]
pub(crate) struct ChangeRules {
    /// Parameters that are read once.
    pub(crate) fixed: &'static [&'static str],
    /// True if numbers may be 0.
    pub(crate) allows_zero: bool,
    /// Integers that may be 0 or negative, which means without a limit.
    pub(crate) unlimited: &'static [&'static str],
}

/// Values with the rules for their changes.
#[derive(Debug)]
pub(crate) struct ParameterStore {
    values: ParamValues,
    rules: &'static ChangeRules,
}

impl ParameterStore {
    pub(crate) fn new(values: ParamValues, rules: &'static ChangeRules) -> Self {
        Self { values, rules }
    }

    pub(crate) fn values(&self) -> &ParamValues {
        &self.values
    }

    /// Changes a value.
    ///
    /// # Errors
    /// When Nav2 would reject it, or ignore it because it reads the parameter only once.
    pub(crate) fn change(
        &mut self,
        name: &str,
        value: &ParamValue,
    ) -> Result<(), ParameterRejected> {
        let table = self.values.table();
        let Some(parameter) = table.find(name).filter(|it| it.kind != ParamType::Group) else {
            let near = closest(name, table.names());
            return Err(ParameterRejected::Unknown(name.to_owned(), near));
        };
        if self.rules.fixed.contains(&parameter.name) {
            return Err(ParameterRejected::Fixed(parameter.name));
        }
        let rejected = |reason: String| ParameterRejected::Value(parameter.name, reason);
        let value =
            value.clone().fit(parameter).map_err(|error| rejected(format!("the value {error}")))?;
        let is_unlimited = self.rules.unlimited.contains(&parameter.name);
        match value {
            ParamValue::Number(number) if number < 0.0 => {
                return Err(rejected(format!("{number} must not be negative")));
            }
            ParamValue::Number(0.0) if !self.rules.allows_zero => {
                return Err(rejected("it must be above 0 while the node runs".to_owned()));
            }
            ParamValue::Integer(..=0) if !is_unlimited => {
                return Err(rejected("it must be above 0".to_owned()));
            }
            _ => {}
        }
        self.values.set(parameter.name, value);
        Ok(())
    }
}
