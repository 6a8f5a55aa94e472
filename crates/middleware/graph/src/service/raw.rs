//! Services whose types are known only by name, for transports.

use std::sync::Arc;

use periplus_msgs::EncodeError;

use super::{CallError, Caller, OwnServer, Reply, Request, ServerReaction};
use crate::GraphError;
use crate::actor::Once;
use crate::event_queue::{Key, Rank};
use crate::node::Node;
use crate::payload::Payload;
use crate::registry::TypeOf;

/// A serialized request or response. Clones share it.
#[derive(Clone)]
pub struct RawMessage(Arc<Payload>);

impl RawMessage {
    /// Returns the message as CDR, with the four-byte encapsulation header.
    ///
    /// # Errors
    /// When a string or list is longer than its type allows.
    pub fn cdr(&self) -> Result<&[u8], EncodeError> {
        self.0.cdr()
    }
}

/// Service client on behalf of a remote client.
pub struct RawClient {
    caller: Caller,
}

impl RawClient {
    /// Sends a request. `answered` gets the response, once, on the thread of the server.
    pub fn call(
        &self,
        cdr: Vec<u8>,
        answered: impl FnOnce(Result<RawMessage, CallError>) + Send + 'static,
    ) {
        let reply = Reply::new(self.caller.name.clone(), |answer| answered(answer.map(RawMessage)));
        self.caller.call(Payload::raw(cdr), reply);
    }

    /// Same as [`RawClient::call`], but `answered` runs as a callback of the client's node, in the
    /// order of the graph's events.
    pub fn call_in_order(
        &self,
        cdr: Vec<u8>,
        answered: impl FnOnce(Result<RawMessage, CallError>) + Send + 'static,
    ) {
        let name = self.caller.name.clone();
        let node = Arc::downgrade(&self.caller.node);
        let ordinal = self.caller.node.next_ordinal();
        let event_queue = self.caller.node.event_queue();
        let reply = Reply::new(name.clone(), move |answer| {
            // The node may have been dropped.
            let Some(node) = node.upgrade() else { return };
            let key = Key {
                time_ns: node.core.common.clock.now_ns(),
                node: node.full_name.clone(),
                rank: Rank::Answer,
                name,
                sequence: ordinal,
                ordinal: 0,
            };
            let event = Once::new(move || answered(answer.map(RawMessage)));
            event_queue.add(key, Arc::new(event));
        });
        self.caller.call(Payload::raw(cdr), reply);
    }

    /// True if a server is available.
    #[must_use]
    pub fn is_ready(&self) -> bool {
        self.caller.server().is_some()
    }
}

/// Requests to a service with a remote server.
pub struct RawCalls {
    own: OwnServer,
}

impl RawCalls {
    /// Returns the oldest request.
    #[must_use]
    pub fn take(&self) -> Option<RawCall> {
        let Request { payload, reply } = self.own.server.take()?;
        Some(RawCall { request: RawMessage(payload), reply })
    }

    /// True if a request waits.
    #[must_use]
    pub fn has_requests(&self) -> bool {
        self.own.server.has_requests()
    }

    /// Sets a callback that runs once for each new request, on the thread of the client; it must
    /// not block. Only the first callback is kept.
    pub fn on_call(&self, wake: impl Fn() + Send + Sync + 'static) {
        let _ = self.own.server.wake.set(Box::new(wake));
    }
}

/// A request that waits for its response. Dropping it gives the caller an error.
#[must_use]
pub struct RawCall {
    /// The request message.
    pub request: RawMessage,
    reply: Reply,
}

impl RawCall {
    /// Sends the response as CDR.
    pub fn answer(self, cdr: Vec<u8>) {
        self.reply.send(Ok(Arc::new(Payload::raw(cdr))));
    }
}

impl Node {
    /// Creates a client of a service whose type is known only by name and optional hash.
    ///
    /// # Errors
    /// As [`Node::client`].
    pub fn raw_client(
        &self,
        name: &str,
        type_name: &str,
        type_hash: Option<&str>,
    ) -> Result<RawClient, GraphError> {
        Ok(RawClient { caller: self.0.caller(name, TypeOf::new(type_name, type_hash))? })
    }

    /// Creates a server of a service whose type is known only by name and optional hash.
    ///
    /// # Errors
    /// As [`Node::server`].
    pub fn raw_server(
        &self,
        name: &str,
        type_name: &str,
        type_hash: Option<&str>,
    ) -> Result<RawCalls, GraphError> {
        Ok(RawCalls { own: self.0.server(name, TypeOf::new(type_name, type_hash), None)? })
    }

    /// Same as [`Node::raw_server`], with a callback for the requests, in the order of the graph's
    /// events. The server leaves the graph when the result is dropped.
    ///
    /// # Errors
    /// As [`Node::server`].
    pub fn raw_server_with(
        &self,
        name: &str,
        type_name: &str,
        type_hash: Option<&str>,
        react: impl Fn(RawCall) + Send + Sync + 'static,
    ) -> Result<RawCalls, GraphError> {
        let react = move |Request { payload, reply }: Request| {
            react(RawCall { request: RawMessage(payload), reply });
        };
        let node = Arc::downgrade(&self.0);
        let reaction = ServerReaction { node, react: Box::new(react) };
        let type_of = TypeOf::new(type_name, type_hash);
        Ok(RawCalls { own: self.0.server(name, type_of, Some(reaction))? })
    }
}
