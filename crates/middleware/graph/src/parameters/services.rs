//! The six parameter services.

use std::collections::BTreeSet;
use std::sync::Arc;

use periplus_msgs::rcl_interfaces::{
    DescribeParameters, DescribeParametersResponse, GetParameterTypes, GetParameterTypesResponse,
    GetParameters, GetParametersResponse, ListParameters, ListParametersRequest,
    ListParametersResponse, ListParametersResult, Parameter as Named, SetParameters,
    SetParametersAtomically, SetParametersAtomicallyResponse, SetParametersResponse,
    SetParametersResult,
};

use crate::GraphError;
use crate::common::lock;
use crate::node::NodeCore;
use crate::service::Server;
use crate::standard::server;

/// Creates the services of a node.
pub(crate) fn serve(node: &Arc<NodeCore>, made: &mut Vec<Arc<Server>>) -> Result<(), GraphError> {
    made.push(server::<GetParameters>(node, "~/get_parameters", |node, request| {
        let store = lock(&node.standard().store);
        let values = request.names.iter().map(|name| store.named(name).value).collect();
        GetParametersResponse { values }
    })?);
    made.push(server::<GetParameterTypes>(node, "~/get_parameter_types", |node, request| {
        let store = lock(&node.standard().store);
        let types = request.names.iter().map(|name| store.named(name).value.r#type).collect();
        GetParameterTypesResponse { types }
    })?);
    made.push(server::<DescribeParameters>(node, "~/describe_parameters", |node, request| {
        let store = lock(&node.standard().store);
        let descriptors = request.names.iter().map(|name| store.describe(name)).collect();
        DescribeParametersResponse { descriptors }
    })?);
    made.push(server::<ListParameters>(node, "~/list_parameters", |node, request| {
        let store = lock(&node.standard().store);
        ListParametersResponse { result: list(&store.names(), request) }
    })?);
    made.push(server::<SetParameters>(node, "~/set_parameters", |node, request| {
        let each = request.parameters.iter();
        let results = each.map(|one| set(node, std::slice::from_ref(one))).collect();
        SetParametersResponse { results }
    })?);
    made.push(server::<SetParametersAtomically>(
        node,
        "~/set_parameters_atomically",
        |node, request| SetParametersAtomicallyResponse { result: set(node, &request.parameters) },
    )?);
    Ok(())
}

fn set(node: &NodeCore, parameters: &[Named]) -> SetParametersResult {
    // Unlocked before the callback: the node may be dropped meanwhile.
    let change = lock(&node.standard().change).as_ref().map(|change| change.apply.clone());
    match node.set_parameters(parameters, change) {
        Ok(()) => SetParametersResult { successful: true, reason: String::new() },
        Err(reason) => SetParametersResult { successful: false, reason },
    }
}

/// Names below the prefixes, at most `depth` levels deep (0 for no limit), and their groups.
fn list(names: &[String], request: &ListParametersRequest) -> ListParametersResult {
    let is_near = |rest: &str| {
        let levels = rest.matches('.').count() as u64;
        request.depth == ListParametersRequest::DEPTH_RECURSIVE || levels < request.depth
    };
    let is_below = |name: &str, prefix: &str| {
        let rest = name.strip_prefix(prefix).and_then(|rest| rest.strip_prefix('.'));
        name == prefix || rest.is_some_and(is_near)
    };
    let is_asked = |name: &str| {
        let prefixes = &request.prefixes;
        (prefixes.is_empty() && is_near(name)) || prefixes.iter().any(|p| is_below(name, p))
    };
    let names: Vec<String> = names.iter().filter(|name| is_asked(name)).cloned().collect();
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
        let names = ["a", "b.c", "b.d.e", "bc"].map(str::to_owned);
        let check = |prefixes: &[&str], depth, expected: &[&str]| {
            let prefixes = prefixes.iter().map(|one| (*one).to_owned()).collect();
            let listed = list(&names, &ListParametersRequest { prefixes, depth });
            assert_eq!(listed.names, expected);
            listed.prefixes
        };
        assert_eq!(check(&[], 0, &["a", "b.c", "b.d.e", "bc"]), ["b", "b.d"]);
        check(&[], 1, &["a", "bc"]);
        check(&[], 2, &["a", "b.c", "bc"]);
        check(&["b"], 1, &["b.c"]);
        check(&["b"], 0, &["b.c", "b.d.e"]);
        check(&["bc", "z"], 0, &["bc"]);
    }
}
