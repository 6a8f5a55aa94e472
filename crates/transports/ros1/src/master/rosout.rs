//! The node `/rosout`: what all nodes log on `/rosout` is published again on `/rosout_agg`.

use std::collections::BTreeSet;
use std::net::IpAddr;
use std::sync::{Arc, Mutex, Weak};
use std::time::Duration;

use periplus_transport::lock;

use crate::error::Ros1Error;
use crate::names::{Ros1Type, message_definition};
use crate::node::{NodeEvents, NodePort, Place, SubscriptionReport};
use crate::rpc;
use crate::tcpros::{Header, Publication, Receive, Receiver, Subscription};

const NODE: &str = "/rosout";
const TOPIC: &str = "/rosout";
const COLLECTED: &str = "/rosout_agg";

/// Queue depth of a subscriber.
const DEPTH: usize = 100;

/// Timeout of a call to the master in this program.
const PATIENCE: Duration = Duration::from_secs(5);

pub(super) struct Rosout {
    _port: NodePort,
    _events: Arc<Events>,
}

struct Events {
    subscription: Mutex<Option<Subscription>>,
}

struct Collector(Weak<Publication>);

impl Receiver for Collector {
    fn begin(&self, _: &str, _: &Header) -> Result<Receive, String> {
        let publication = self.0.clone();
        Ok(Box::new(move |message| {
            let Some(publication) = publication.upgrade() else { return };
            if publication.is_wanted() {
                publication.send(&Arc::new(framed(message)));
            }
        }))
    }

    fn complain(&self, _: &str, _: &str) {
        // A node whose log has another type is not collected.
    }
}

/// A message with its length before it.
fn framed(message: &[u8]) -> Vec<u8> {
    let length = u32::try_from(message.len()).unwrap_or(u32::MAX);
    [&length.to_le_bytes(), message].concat()
}

impl NodeEvents for Events {
    fn publishers(&self, topic: &str, publishers: Vec<String>) {
        if topic == TOPIC
            && let Some(subscription) = &*lock(&self.subscription)
        {
            subscription.update(&publishers.into_iter().collect());
        }
    }

    fn shutdown(&self, _: &str, _: &str) {
        // It ends with the master.
    }

    fn subscriptions(&self, _: &str) -> Vec<SubscriptionReport> {
        let subscription = lock(&self.subscription);
        let report = subscription.iter().map(|one| SubscriptionReport {
            topic: TOPIC.to_owned(),
            of: log_type().name,
            sources: one.report(),
        });
        report.collect()
    }
}

fn log_type() -> Ros1Type {
    message_definition("rosgraph_msgs/Log").unwrap_or(Ros1Type {
        name: "rosgraph_msgs/Log".into(),
        md5: "*".into(),
        definition: String::new(),
    })
}

impl Rosout {
    pub(super) fn open(address: IpAddr, host: &str, master_uri: &str) -> Result<Self, Ros1Error> {
        let events = Arc::new(Events { subscription: Mutex::default() });
        let place = Place { address, host: host.to_owned(), master_uri: master_uri.to_owned() };
        let port = NodePort::open(&place, NODE, events.clone())?;
        let wake = Box::new(|| {});
        let publication = Publication::new(NODE, COLLECTED, log_type(), false, DEPTH, wake);
        port.publish(publication.clone());
        let collector = Arc::new(Collector(Arc::downgrade(&publication)));
        let subscription = Subscription::new(NODE, TOPIC, log_type(), collector);
        *lock(&events.subscription) = Some(subscription);
        let uri = port.uri();
        let register = |method: &str, topic: &str| {
            let params = [NODE, topic, "rosgraph_msgs/Log", &uri];
            rpc::ask(master_uri, method, params.map(Into::into).into(), PATIENCE)
                .map_err(|why| Ros1Error::Master { uri: master_uri.to_owned(), why })
        };
        register("registerPublisher", COLLECTED)?;
        let known = register("registerSubscriber", TOPIC)?;
        let known = known.list().unwrap_or_default().iter();
        let known: BTreeSet<String> =
            known.filter_map(|one| one.text()).map(str::to_owned).collect();
        events.publishers(TOPIC, known.into_iter().collect());
        Ok(Self { _port: port, _events: events })
    }
}
