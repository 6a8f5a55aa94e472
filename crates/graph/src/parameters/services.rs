//! The six services of parameters.

use std::collections::BTreeSet;
use std::sync::{Arc, Mutex};

use periplus_msgs::rcl_interfaces::{
    DescribeParameters, DescribeParametersResponse, GetParameterTypes, GetParameterTypesResponse,
    GetParameters, GetParametersResponse, ListParameters, ListParametersRequest,
    ListParametersResponse, ListParametersResult, Parameter as Named, ParameterDescriptor,
    ParameterType, SetParameters, SetParametersAtomically, SetParametersAtomicallyResponse,
    SetParametersResponse,
};
use periplus_params::Values;

use super::{Parameters, Store, USE_SIM_TIME, convert, result};
use crate::GraphError;
use crate::actor::{Actor, Io};
use crate::common::lock;

type Check<S> = dyn FnMut(&mut S, &Values, &mut Io<'_, S>) -> Result<(), String> + Send;

impl<S: Send + 'static> Actor<S> {
    /// Lets others read and set these parameters. When somebody sets some, and their kinds and
    /// ranges are right, `change` gets all values as they would be. If it agrees they hold, and it
    /// has put them to use; otherwise its reason is told to who sets.
    ///
    /// # Errors
    /// When the node has parameters already.
    pub fn parameters(
        &mut self,
        values: Values,
        change: impl FnMut(&mut S, &Values, &mut Io<'_, S>) -> Result<(), String> + Send + 'static,
    ) -> Result<Parameters, GraphError> {
        let store = Arc::new(Mutex::new(Store::new(self.node(), values)?));
        let change: Arc<Mutex<Check<S>>> = Arc::new(Mutex::new(change));

        let own = store.clone();
        self.serve::<GetParameters>("~/get_parameters", move |_, request, _| {
            let store = lock(&own);
            let values = request.names.iter().map(|name| store.named(name).value).collect();
            GetParametersResponse { values }
        })?;
        let own = store.clone();
        self.serve::<GetParameterTypes>("~/get_parameter_types", move |_, request, _| {
            let store = lock(&own);
            let types = request.names.iter().map(|name| store.named(name).value.r#type).collect();
            GetParameterTypesResponse { types }
        })?;
        let own = store.clone();
        self.serve::<DescribeParameters>("~/describe_parameters", move |_, request, _| {
            let store = lock(&own);
            let descriptors = request.names.iter().map(|name| store.describe(name)).collect();
            DescribeParametersResponse { descriptors }
        })?;
        let own = store.clone();
        self.serve::<ListParameters>("~/list_parameters", move |_, request, _| {
            ListParametersResponse { result: list(&lock(&own).names(), &request) }
        })?;
        let (own, check) = (store.clone(), change.clone());
        self.serve::<SetParameters>("~/set_parameters", move |state, request, io| {
            let each = request.parameters.iter();
            let set = |one| result(set(&own, &check, std::slice::from_ref(one), state, io));
            SetParametersResponse { results: each.map(set).collect() }
        })?;
        let own = store.clone();
        self.serve::<SetParametersAtomically>(
            "~/set_parameters_atomically",
            move |state, request, io| {
                let outcome = set(&own, &change, &request.parameters, state, io);
                SetParametersAtomicallyResponse { result: result(outcome) }
            },
        )?;
        Ok(Parameters { store, _answers: None })
    }
}

/// Sets all of these or none. The store is free while the node is asked, so that it may look at its
/// parameters.
fn set<S>(
    store: &Mutex<Store>,
    change: &Mutex<Check<S>>,
    set: &[Named],
    state: &mut S,
    io: &mut Io<'_, S>,
) -> Result<(), String> {
    let values = lock(store).propose(set)?;
    (*lock(change))(state, &values, io)?;
    lock(store).accept(values, set);
    Ok(())
}

impl Store {
    fn describe(&self, name: &str) -> ParameterDescriptor {
        if name == USE_SIM_TIME {
            return ParameterDescriptor {
                name: name.to_owned(),
                r#type: ParameterType::PARAMETER_BOOL,
                description: "Whether the nodes of this program run on simulated time.".into(),
                read_only: true,
                ..Default::default()
            };
        }
        match self.values.table().find(name) {
            Some(parameter) => convert::describe(parameter),
            None => ParameterDescriptor { name: name.to_owned(), ..Default::default() },
        }
    }
}

/// The names below the prefixes, at most `depth` levels deep (0 for any), and the groups they are in.
fn list(names: &[&str], request: &ListParametersRequest) -> ListParametersResult {
    let is_near = |rest: &str| {
        let levels = rest.matches('.').count() as u64;
        request.depth == ListParametersRequest::DEPTH_RECURSIVE || levels < request.depth
    };
    let is_below = |name: &str, prefix: &str| {
        let rest = name.strip_prefix(prefix).and_then(|rest| rest.strip_prefix('.'));
        name == prefix || rest.is_some_and(is_near)
    };
    let is_asked = |name: &&&str| {
        let prefixes = &request.prefixes;
        (prefixes.is_empty() && is_near(name)) || prefixes.iter().any(|p| is_below(name, p))
    };
    let names: Vec<String> = names.iter().filter(is_asked).map(|name| (*name).to_owned()).collect();
    let groups: BTreeSet<String> = names
        .iter()
        .filter_map(|name| name.rsplit_once('.'))
        .map(|(group, _)| group.into())
        .collect();
    ListParametersResult { names, prefixes: groups.into_iter().collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_listed_by_prefix_and_depth() {
        let names = ["a", "b.c", "b.d.e", "bc"];
        let check = |prefixes: &[&str], depth, expected: &[&str]| {
            let prefixes = prefixes.iter().map(|one| (*one).to_owned()).collect();
            let listed = list(&names, &ListParametersRequest { prefixes, depth });
            assert_eq!(listed.names, expected);
            listed.prefixes
        };
        assert_eq!(check(&[], 0, &names), ["b", "b.d"]);
        check(&[], 1, &["a", "bc"]);
        check(&[], 2, &["a", "b.c", "bc"]);
        check(&["b"], 1, &["b.c"]);
        check(&["b"], 0, &["b.c", "b.d.e"]);
        check(&["bc", "z"], 0, &["bc"]);
    }
}
