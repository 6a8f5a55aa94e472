//! A connected client.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use periplus_graph::{Qos, RawPublisher};
use periplus_msgs::TypeRegistry;
use periplus_transport::lock;

use crate::foxglove::frame::WebSocketFrame;
use crate::foxglove::hub::Shared;
use crate::foxglove::mesh_requests::MeshRequests;
use crate::foxglove::outbox::Outbox;
use crate::foxglove::protocol::{
    self, ClientBinary, ClientChannel, ClientText, Malformed, StatusLevel,
};
use crate::foxglove::recordings::RecordingClient;

/// A connected client. It is removed when this is dropped.
pub struct ClientSession {
    id: u64,
    shared: Arc<Shared>,
    outbox: Arc<Outbox>,
    /// Publishers of its channels, by the client's channel id.
    publishing: BTreeMap<u32, RawPublisher>,
    /// Number of pending calls.
    calls: Arc<AtomicUsize>,
    meshes: MeshRequests,
    /// Its requests about recordings, since the first one.
    recordings: Option<RecordingClient>,
}

/// Answer of a server without files.
pub(crate) const NO_FILES: &str = "this server has no files";

/// Refusal of requests about recordings.
const NO_RECORDINGS: &str = "this server has no recordings";

impl ClientSession {
    pub(crate) fn new(id: u64, shared: Arc<Shared>, outbox: Arc<Outbox>) -> Self {
        let limit = shared.settings.limits.entries;
        let meshes = MeshRequests::new(outbox.clone(), limit);
        Self {
            id,
            shared,
            outbox,
            meshes,
            publishing: BTreeMap::new(),
            calls: Arc::default(),
            recordings: None,
        }
    }

    /// Send queue of this client.
    #[must_use]
    pub fn outbox(&self) -> &Arc<Outbox> {
        &self.outbox
    }

    /// Processes a JSON message. Errors are sent to the client.
    pub fn text(&mut self, text: &str) {
        match ClientText::read(text) {
            Ok(said) => self.hear(said),
            Err(Malformed(why)) => self.refuse(&why),
        }
    }

    /// Processes a binary message. Errors are sent to the client.
    pub fn binary(&mut self, bytes: &[u8]) {
        match ClientBinary::read(bytes) {
            Ok(ClientBinary::Message { channel_id, payload }) => self.publish(channel_id, payload),
            Ok(ClientBinary::Upload { upload, bytes }) => match self.recordings() {
                Some(recordings) => recordings.upload(upload, bytes),
                None => self.refuse(NO_RECORDINGS),
            },
            Ok(ClientBinary::Call { service_id, call_id, encoding, payload }) => {
                self.call(service_id, call_id, encoding, payload);
            }
            Err(Malformed(why)) => self.refuse(&why),
        }
    }

    fn refuse(&self, why: &str) {
        self.outbox.push(protocol::status(StatusLevel::Error, why, None));
    }

    fn say(&self, frame: WebSocketFrame) {
        self.outbox.push(frame);
    }

    fn hear(&mut self, said: ClientText) {
        match said {
            ClientText::Subscribe { subscriptions } => {
                let mut state = lock(&self.shared.state);
                let refused = state.subscribe(&self.shared, self.id, &subscriptions);
                drop(state);
                refused.iter().for_each(|why| self.refuse(why));
            }
            ClientText::Unsubscribe { subscription_ids } => {
                lock(&self.shared.state).unsubscribe(&self.shared, self.id, &subscription_ids);
            }
            ClientText::Advertise { channels } => {
                channels.iter().for_each(|channel| self.advertise(channel));
            }
            ClientText::Unadvertise { channel_ids } => {
                self.publishing.retain(|id, _| !channel_ids.contains(id));
            }
            ClientText::FetchAsset { uri, request_id } => self.fetch(&uri, request_id),
            ClientText::FetchMesh { uri, request_id } => {
                let assets = lock(&self.shared.assets).clone();
                self.meshes.request(uri, request_id, assets);
            }
            ClientText::FetchSchema { request_id, schema_name } => {
                let types = TypeRegistry::builtin();
                let text = types.schema_text(&full_type(&schema_name));
                let names: Vec<&str> = match schema_name.as_str() {
                    "" => types.type_names().filter(|name| name.contains("/msg/")).collect(),
                    _ => Vec::new(),
                };
                self.say(protocol::schema(request_id, &schema_name, text, &names));
            }
            ClientText::RepairQos { id, topic, publisher, subscription } => {
                let mut state = lock(&self.shared.state);
                let outcome = state.repair(&self.shared, &topic, &publisher, &subscription);
                drop(state);
                self.say(protocol::repair_result(id, &outcome));
            }
            ClientText::GetParameters { parameter_names, id } => {
                let mut state = lock(&self.shared.state);
                state.get_parameters(&self.shared, self.id, &parameter_names, id);
            }
            ClientText::SetParameters { parameters, id } => {
                lock(&self.shared.state).set_parameters(&self.shared, self.id, parameters, id);
            }
            ClientText::SubscribeParameterUpdates { parameter_names } => {
                let mut state = lock(&self.shared.state);
                state.follow_parameters(&self.shared, self.id, parameter_names);
            }
            ClientText::UnsubscribeParameterUpdates { parameter_names } => {
                lock(&self.shared.state).unfollow_parameters(self.id, &parameter_names);
            }
            ClientText::SubscribeConnectionGraph => self.want_connections(true),
            ClientText::UnsubscribeConnectionGraph => self.want_connections(false),
            ClientText::Recording(request) => {
                let graph = self.shared.graph.clone();
                match self.recordings() {
                    Some(recordings) => recordings.request(request, &graph),
                    None => match request.request_id() {
                        Some(id) => self.say(protocol::fetch_failure(id, NO_RECORDINGS)),
                        None => self.refuse(NO_RECORDINGS),
                    },
                }
            }
        }
    }

    /// Requests about recordings; none if the server has no recordings.
    fn recordings(&mut self) -> Option<&mut RecordingClient> {
        if self.recordings.is_none() {
            let recordings = self.shared.recordings.get()?.clone();
            let client = RecordingClient::new(self.id, recordings, self.outbox.clone());
            self.recordings = Some(client);
        }
        self.recordings.as_mut()
    }

    fn want_connections(&self, wants: bool) {
        lock(&self.shared.state).want_connections(&self.shared, self.id, wants);
    }

    fn advertise(&mut self, channel: &ClientChannel) {
        let ClientChannel { id, topic, encoding, schema_name, is_latched } = channel;
        if encoding != "cdr" {
            return self.refuse(&format!(
                "`{topic}` is advertised with encoding {encoding}; only cdr is supported"
            ));
        }
        if self.publishing.contains_key(id) {
            return self.refuse(&format!("channel {id} is in use"));
        }
        if self.publishing.len() >= self.shared.settings.limits.entries {
            return self.refuse("there are too many channels");
        }
        let type_name = full_type(schema_name);
        let hash = TypeRegistry::builtin().hash(&type_name);
        let qos = if *is_latched { Qos::latched(1) } else { Qos::reliable(10) };
        let made = self.shared.node.raw_publisher(topic, &type_name, hash.as_deref(), qos);
        match made {
            Ok(publisher) => {
                self.publishing.insert(*id, publisher);
            }
            Err(error) => self.refuse(&error.to_string()),
        }
    }

    fn publish(&self, channel_id: u32, payload: &[u8]) {
        match self.publishing.get(&channel_id) {
            Some(publisher) => publisher.publish(payload.to_vec()),
            None => self.refuse(&format!("channel {channel_id} was not advertised")),
        }
    }

    fn call(&self, service_id: u32, call_id: u32, encoding: &str, payload: &[u8]) {
        let fail = |why: &str| self.say(protocol::service_failure(service_id, call_id, why));
        if encoding != "cdr" {
            return fail(&format!("the request has encoding {encoding}; only cdr is supported"));
        }
        if self.calls.load(Ordering::Relaxed) >= self.shared.settings.limits.entries {
            return fail("too many calls are pending");
        }
        let mut state = lock(&self.shared.state);
        let Some(name) = state.service(service_id) else {
            return fail(&format!("there is no service {service_id}"));
        };
        self.calls.fetch_add(1, Ordering::Relaxed);
        let (outbox, calls) = (self.outbox.clone(), self.calls.clone());
        let answered = move |answer: Result<&[u8], String>| {
            calls.fetch_sub(1, Ordering::Relaxed);
            outbox.push(match answer {
                Ok(cdr) => protocol::service_answer(service_id, call_id, cdr),
                Err(why) => protocol::service_failure(service_id, call_id, &why),
            });
        };
        state.call(&self.shared, &name, payload.to_vec(), Box::new(answered));
    }

    fn fetch(&self, uri: &str, request_id: u32) {
        let assets = lock(&self.shared.assets).clone();
        let answer = match assets {
            Some(assets) => assets(uri),
            None => Err(NO_FILES.into()),
        };
        self.say(protocol::asset(request_id, &answer));
    }
}

impl Drop for ClientSession {
    fn drop(&mut self) {
        self.outbox.end("");
        lock(&self.shared.state).leave(&self.shared, self.id);
    }
}

impl std::fmt::Debug for ClientSession {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Session").field("id", &self.id).finish_non_exhaustive()
    }
}

/// Returns `pkg/msg/T` for the short form `pkg/T`.
fn full_type(name: &str) -> String {
    match name.split('/').collect::<Vec<_>>().as_slice() {
        [package, name] => format!("{package}/msg/{name}"),
        _ => name.to_owned(),
    }
}
