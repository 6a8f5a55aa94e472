//! Values of a node's parameters and the operations on them.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use periplus_msgs::rcl_interfaces::{
    Parameter as Named, ParameterDescriptor, ParameterEvent, ParameterType, ParameterValue,
};
use periplus_params::{ParamType, ParamValue, ParamValues};

use super::convert;
use crate::common::Common;

/// Parameter that every node has in addition to its table.
const USE_SIM_TIME: &str = "use_sim_time";

/// Parameter that every managed node has in addition to its table, as in Nav2.
const BOND_PERIOD: &str = "bond_heartbeat_period";

/// Default of `bond_heartbeat_period` \[s\].
const BOND_PERIOD_S: f64 = 0.1;

/// Parameters of a node: overrides given before declaration, and declared values.
pub(crate) struct Store {
    node: Arc<str>,
    common: Arc<Common>,
    /// Overrides from arguments, for parameters that may be declared later.
    given: BTreeMap<String, ParameterValue>,
    values: Option<ParamValues>,
    /// Undeclared parameters, for nodes that allow them.
    free: Option<BTreeMap<String, ParameterValue>>,
    /// Undeclared parameters that the program has read from the arguments.
    read: Vec<String>,
    generation: u64,
    /// True for a managed node.
    is_managed: bool,
}

impl Store {
    /// With `any`, all overrides and all parameters that other nodes set are declared.
    pub(crate) fn new(
        node: Arc<str>,
        common: Arc<Common>,
        given: BTreeMap<String, ParameterValue>,
        any: bool,
    ) -> Self {
        let free = any.then(|| {
            let given = given.iter().filter(|(name, _)| *name != USE_SIM_TIME);
            given.map(|(name, value)| (name.clone(), value.clone())).collect()
        });
        let (values, read) = (None, Vec::new());
        Self { node, common, given, values, free, read, generation: 0, is_managed: false }
    }

    /// With undeclared parameters that the program has read from the arguments.
    pub(crate) fn reading(self, read: Vec<String>) -> Self {
        Self { read, ..self }
    }

    pub(crate) fn values(&self) -> Option<&ParamValues> {
        self.values.as_ref()
    }

    pub(crate) fn generation(&self) -> u64 {
        self.generation
    }

    /// Declares a table and applies the overrides. Returns the reasons for the overrides that are
    /// not valid.
    pub(crate) fn declare(&mut self, mut values: ParamValues) -> Vec<String> {
        let mut unfit = Vec::new();
        for (name, value) in &self.given {
            let parameter = values.find(name).filter(|one| one.kind != ParamType::Group);
            let Some(parameter) = parameter else { continue };
            match convert::from_message(value)
                .and_then(|value| value.fit(parameter).map_err(|error| error.to_string()))
            {
                Ok(value) => {
                    values.set(name, value);
                }
                Err(reason) => unfit.push(format!("`{name}`: the value {reason}")),
            }
        }
        self.values = Some(values);
        unfit
    }

    /// Declares the parameters of managed nodes.
    pub(crate) fn manage(&mut self) {
        self.is_managed = true;
    }

    /// Heartbeat period of the node's bond \[s\]; no bond if not positive.
    pub(crate) fn bond_period_s(&self) -> f64 {
        self.get(BOND_PERIOD).map_or(BOND_PERIOD_S, |value| value.double_value)
    }

    /// The bond parameter, if no table declares it.
    fn bond(&self, name: &str) -> Option<ParameterValue> {
        let is_asked = self.is_managed && name == BOND_PERIOD;
        is_asked.then(|| {
            let given = self.given.get(name).filter(|given| {
                matches!(
                    given.r#type,
                    ParameterType::PARAMETER_DOUBLE | ParameterType::PARAMETER_INTEGER
                )
            });
            let period_s = match given {
                Some(given) if given.r#type == ParameterType::PARAMETER_DOUBLE => {
                    given.double_value
                }
                #[allow(clippy::cast_precision_loss, reason = "seconds")]
                Some(given) => given.integer_value as f64,
                None => BOND_PERIOD_S,
            };
            convert::to_message(ParamValue::Number(period_s))
        })
    }

    /// Names of the declared parameters, sorted.
    fn declared_names(&self) -> BTreeSet<String> {
        self.values.iter().flat_map(ParamValues::names).collect()
    }

    /// Returns true for a declared parameter.
    pub(crate) fn has(&self, name: &str) -> bool {
        let is_declared = |values: &ParamValues| {
            values.find(name).is_some_and(|parameter| parameter.kind != ParamType::Group)
        };
        name == USE_SIM_TIME
            || self.is_managed && name == BOND_PERIOD
            || self.values.as_ref().is_some_and(is_declared)
            || self.free.as_ref().is_some_and(|free| free.contains_key(name))
    }

    /// Returns true for a parameter that is used: declared, or read by the program.
    pub(crate) fn uses(&self, name: &str) -> bool {
        self.has(name) || self.read.iter().any(|read| read == name)
    }

    /// Names of all parameters, sorted.
    pub(super) fn names(&self) -> Vec<String> {
        let mut names = self.declared_names();
        names.insert(USE_SIM_TIME.to_owned());
        if self.is_managed {
            names.insert(BOND_PERIOD.to_owned());
        }
        names.extend(self.free.iter().flat_map(BTreeMap::keys).cloned());
        names.into_iter().collect()
    }

    pub(crate) fn get(&self, name: &str) -> Option<ParameterValue> {
        if name == USE_SIM_TIME {
            return Some(convert::to_message(ParamValue::Bool(self.common.clock.is_simulated())));
        }
        let declared = self.values.as_ref().and_then(|values| {
            values.find(name)?;
            values.get(name).map(convert::to_message)
        });
        declared.or_else(|| self.free.as_ref()?.get(name).cloned()).or_else(|| self.bond(name))
    }

    pub(super) fn named(&self, name: &str) -> Named {
        Named { name: name.to_owned(), value: self.get(name).unwrap_or_default() }
    }

    /// All parameters with their values.
    pub(crate) fn all(&self) -> Vec<Named> {
        self.names().iter().map(|name| self.named(name)).collect()
    }

    /// Parameters of the table.
    pub(super) fn declared(&self) -> Vec<Named> {
        self.declared_names().iter().map(|name| self.named(name)).collect()
    }

    /// Returns the values of the table with all of these set. The error is for the caller of the
    /// service.
    pub(crate) fn propose(&self, set: &[Named]) -> Result<Option<ParamValues>, String> {
        let mut values = self.values.clone();
        for Named { name, value } in set {
            if name == USE_SIM_TIME {
                self.check_sim_time(value)?;
                continue;
            }
            let parameter = self.values.as_ref().and_then(|values| values.find(name));
            match (parameter.filter(|one| one.kind != ParamType::Group), &mut values) {
                (Some(parameter), Some(values)) => {
                    let value = convert::from_message(value)
                        .and_then(|value| value.fit(parameter).map_err(|error| error.to_string()));
                    let value = value.map_err(|reason| format!("`{name}`: the value {reason}"))?;
                    values.set(name, value);
                }
                _ if self.free.is_some() => self.check_free(name, value)?,
                _ if self.is_managed && name == BOND_PERIOD => {
                    return Err(format!("`{name}` can only be set when the node starts"));
                }
                _ => return Err(self.unknown(name)),
            }
        }
        Ok(values)
    }

    fn unknown(&self, name: &str) -> String {
        let names = self.names();
        let near = periplus_diagnostics::closest(name, names.iter().map(String::as_str));
        let near = near.map(|near| format!(", did you mean `{near}`?")).unwrap_or_default();
        format!("{} has no parameter `{name}`{near}", self.node)
    }

    fn check_free(&self, name: &str, value: &ParameterValue) -> Result<(), String> {
        if name.is_empty() {
            return Err("a parameter needs a name".into());
        }
        match value.r#type {
            ParameterType::PARAMETER_NOT_SET if !self.has(name) => Err(self.unknown(name)),
            ParameterType::PARAMETER_NOT_SET..=ParameterType::PARAMETER_STRING_ARRAY => Ok(()),
            other => Err(format!(
                "`{name}`: the value has the unknown type {other}; ROS has the types 0 to {}",
                ParameterType::PARAMETER_STRING_ARRAY
            )),
        }
    }

    fn check_sim_time(&self, value: &ParameterValue) -> Result<(), String> {
        let is_simulated = self.common.clock.is_simulated();
        match convert::from_message(value) {
            Ok(ParamValue::Bool(set)) if set == is_simulated => return Ok(()),
            Ok(ParamValue::Bool(_)) => {}
            _ => return Err(format!("`{USE_SIM_TIME}`: the value is neither true nor false")),
        }
        let time = if is_simulated { "simulated time" } else { "system time" };
        Err(format!("`{USE_SIM_TIME}` is {is_simulated}: all nodes of this program run on {time}"))
    }

    /// Stores these values. Returns the parameter event to publish.
    pub(super) fn accept(&mut self, values: Option<ParamValues>, set: &[Named]) -> ParameterEvent {
        let mut event = ParameterEvent::default();
        let had: Vec<bool> = set.iter().map(|one| self.has(&one.name)).collect();
        self.values = values;
        self.generation += 1;
        let declared = self.declared_names();
        for Named { name, value } in set {
            let is_free = name != USE_SIM_TIME && !declared.contains(name);
            if let Some(free) = self.free.as_mut().filter(|_| is_free) {
                if value.r#type == ParameterType::PARAMETER_NOT_SET {
                    free.remove(name);
                } else {
                    free.insert(name.clone(), value.clone());
                }
            }
        }
        for (one, had) in set.iter().zip(had) {
            match (had, self.has(&one.name)) {
                (true, true) => event.changed_parameters.push(self.named(&one.name)),
                (false, true) => event.new_parameters.push(self.named(&one.name)),
                (true, false) => event.deleted_parameters.push(one.clone()),
                (false, false) => {}
            }
        }
        event
    }

    pub(super) fn describe(&self, name: &str) -> ParameterDescriptor {
        let blank = ParameterDescriptor { name: name.to_owned(), ..Default::default() };
        if name == USE_SIM_TIME {
            return ParameterDescriptor {
                r#type: ParameterType::PARAMETER_BOOL,
                description: "Use simulated time in all nodes of this program.".into(),
                read_only: true,
                ..blank
            };
        }
        if let Some(parameter) = self.values.as_ref().and_then(|values| values.find(name)) {
            return convert::describe(name, parameter);
        }
        if self.is_managed && name == BOND_PERIOD {
            return ParameterDescriptor {
                r#type: ParameterType::PARAMETER_DOUBLE,
                description:
                    "Period of the heartbeats to a lifecycle manager [s] (default 0.1); no \
                              bond is kept if this is not positive."
                        .into(),
                read_only: true,
                ..blank
            };
        }
        match self.free.as_ref().and_then(|free| free.get(name)) {
            Some(value) => {
                ParameterDescriptor { r#type: value.r#type, dynamic_typing: true, ..blank }
            }
            None => blank,
        }
    }
}
