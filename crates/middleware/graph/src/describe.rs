//! The service `~/get_type_description` of a node: the definitions of the types that it uses.
//!
//! Source: `rcl_node_type_description_service_handle_request` (hashes, reasons of failure) and the texts of
//! `type_description_interfaces/srv/GetTypeDescription`.

use std::sync::Arc;

use periplus_msgs::TypeRegistry;
use periplus_msgs::type_description_interfaces::{
    GetTypeDescription, GetTypeDescriptionRequest, GetTypeDescriptionResponse, KeyValue,
};

use crate::GraphError;
use crate::common::lock;
use crate::node::NodeCore;
use crate::registry::TypeOf;
use crate::service::Server;
use crate::standard::server;

/// Creates the service.
pub(crate) fn serve(node: &Arc<NodeCore>) -> Result<Arc<Server>, GraphError> {
    server::<GetTypeDescription>(node, "~/get_type_description", |node, request| {
        respond(node, request).unwrap_or_else(|reason| GetTypeDescriptionResponse {
            failure_reason: reason,
            ..GetTypeDescriptionResponse::default()
        })
    })
}

fn respond(
    node: &NodeCore,
    request: &GetTypeDescriptionRequest,
) -> Result<GetTypeDescriptionResponse, String> {
    if !is_hash(&request.type_hash) {
        return Err("Failed to parse type hash".to_owned());
    }
    let types = TypeRegistry::builtin();
    let used = lock(&node.core.registry).types_of(&node.full_name);
    let is_asked = |one: &TypeOf| match &one.hash {
        Some(hash) => *hash == request.type_hash,
        None => types.hash(&one.name).is_some_and(|hash| hash == request.type_hash),
    };
    let Some(found) = used.into_iter().find(is_asked) else {
        return Err("Type not currently in use by this node".to_owned());
    };
    // A type of a foreign package may share its name with one of ours.
    let description = types
        .type_description(&found.name)
        .filter(|_| types.hash(&found.name).is_some_and(|hash| hash == request.type_hash));
    let Some(type_description) = description else {
        return Err(format!("The definition of `{}` is not known to this program", found.name));
    };
    let mut response = GetTypeDescriptionResponse {
        successful: true,
        type_description,
        ..GetTypeDescriptionResponse::default()
    };
    if request.include_type_sources {
        response.type_sources = types.type_sources(&found.name);
        response.extra_information.push(KeyValue {
            key: "type_sources".to_owned(),
            value: "definitions of Periplus; comments differ from those of the ROS package"
                .to_owned(),
        });
    }
    Ok(response)
}

/// True for `RIHS01_` and 64 hexadecimal digits.
fn is_hash(text: &str) -> bool {
    let digits = text.strip_prefix("RIHS01_").unwrap_or_default();
    digits.len() == 64 && digits.bytes().all(|byte| byte.is_ascii_hexdigit())
}
