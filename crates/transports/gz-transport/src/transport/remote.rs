//! Advertisements of remote programs, and their liveliness.

use std::collections::BTreeMap;
use std::time::Duration;

use periplus_gz_msgs::DiscoveryPublisher;
use periplus_transport::Since;

use crate::Name;

/// Timeout of a program without heartbeat; the heartbeat period is one second.
const SILENCE: Duration = Duration::from_secs(3);

/// Maximum number of advertisements and programs stored; typical networks have some hundred.
const MOST_OFFERS: usize = 20_000;
const MOST_PROCESSES: usize = 4_000;

/// An advertised topic or service.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Advertisement {
    /// Name of the topic or service.
    pub name: String,
    /// Address of the server or publisher.
    pub address: String,
    /// Message type, or request and response types.
    pub types: Vec<String>,
    /// Id of the process.
    pub process: String,
    /// Id of the node.
    pub node: String,
}

#[derive(Debug, Default)]
pub(super) struct Remote {
    offers: BTreeMap<Name, Vec<DiscoveryPublisher>>,
    count: usize,
    processes: BTreeMap<String, Since>,
}

impl Remote {
    /// Records a sign of life of a program.
    pub(super) fn note(&mut self, process: &str) {
        if let Some(since) = self.processes.get_mut(process) {
            *since = Since::now();
        } else if self.processes.len() < MOST_PROCESSES {
            self.processes.insert(process.to_owned(), Since::now());
        }
    }

    /// Adds an advertisement; true if it is new.
    pub(super) fn add(&mut self, name: Name, offer: DiscoveryPublisher) -> bool {
        if !self.processes.contains_key(&offer.process_uuid) || self.count == MOST_OFFERS {
            return false;
        }
        let offers = self.offers.entry(name).or_default();
        let is_same = |known: &DiscoveryPublisher| {
            known.address == offer.address
                && known.node_uuid == offer.node_uuid
                && known.srv_pub == offer.srv_pub
                && type_of(known) == type_of(&offer)
        };
        let is_new = !offers.iter().any(is_same);
        if is_new {
            offers.push(offer);
            self.count += 1;
        }
        is_new
    }

    /// Keeps matching advertisements; true if some were removed.
    fn keep(&mut self, mut stays: impl FnMut(&Name, &DiscoveryPublisher) -> bool) -> bool {
        let before = self.count;
        let mut count = 0;
        self.offers.retain(|name, offers| {
            offers.retain(|offer| stays(name, offer));
            count += offers.len();
            !offers.is_empty()
        });
        self.count = count;
        count != before
    }

    /// Removes an advertisement; true if it existed.
    pub(super) fn remove(&mut self, name: &Name, process: &str, node: &str) -> bool {
        self.keep(|known, offer| {
            known != name || offer.process_uuid != process || offer.node_uuid != node
        })
    }

    /// Removes a program; true if it had advertisements.
    pub(super) fn bye(&mut self, process: &str) -> bool {
        self.processes.remove(process);
        self.keep(|_, offer| offer.process_uuid != process)
    }

    /// Removes programs that have timed out; true if one of them had advertisements.
    pub(super) fn forget_silent(&mut self) -> bool {
        let silent = |since: &Since| since.elapsed() > SILENCE;
        let before = self.processes.len();
        self.processes.retain(|_, since| !silent(since));
        if self.processes.len() == before {
            return false;
        }
        let processes = std::mem::take(&mut self.processes);
        let is_news = self.keep(|_, offer| processes.contains_key(&offer.process_uuid));
        self.processes = processes;
        is_news
    }

    pub(super) fn of(&self, name: &Name) -> &[DiscoveryPublisher] {
        self.offers.get(name).map(Vec::as_slice).unwrap_or_default()
    }

    pub(super) fn offered(&self) -> Vec<Advertisement> {
        let all = self.offers.iter().flat_map(|(name, offers)| {
            offers.iter().map(|offer| Advertisement {
                name: name.topic().to_owned(),
                address: offer.address.clone(),
                types: types(offer),
                process: offer.process_uuid.clone(),
                node: offer.node_uuid.clone(),
            })
        });
        all.collect()
    }
}

fn type_of(offer: &DiscoveryPublisher) -> Option<&str> {
    offer.msg_pub.as_ref().map(|told| told.msg_type.as_str())
}

fn types(offer: &DiscoveryPublisher) -> Vec<String> {
    let message = offer.msg_pub.iter().map(|told| told.msg_type.clone());
    let service = offer.srv_pub.iter();
    let service = service.flat_map(|told| [told.request_type.clone(), told.response_type.clone()]);
    message.chain(service).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use periplus_gz_msgs::MessagePublisher;

    fn offer(process: &str, node: &str) -> DiscoveryPublisher {
        DiscoveryPublisher {
            process_uuid: process.into(),
            node_uuid: node.into(),
            address: "tcp://127.0.0.1:1".into(),
            msg_pub: Some(MessagePublisher::default()),
            ..DiscoveryPublisher::default()
        }
    }

    #[test]
    fn offers_come_and_go() {
        let mut remote = Remote::default();
        let name = Name::new("p", "/scan").expect("a name");
        assert!(
            !remote.add(name.clone(), offer("a", "1")),
            "a program without heartbeat has no advertisements"
        );
        remote.note("a");
        remote.note("b");
        assert!(remote.add(name.clone(), offer("a", "1")));
        assert!(!remote.add(name.clone(), offer("a", "1")));
        assert!(remote.add(name.clone(), offer("a", "2")));
        assert!(remote.add(name.clone(), offer("b", "3")));
        assert_eq!(remote.of(&name).len(), 3);
        assert!(remote.remove(&name, "a", "2"));
        assert!(!remote.remove(&name, "a", "2"));
        assert!(remote.bye("b"));
        assert!(!remote.bye("b"));
        assert_eq!(remote.offered().len(), 1);
        assert!(!remote.forget_silent());
    }

    #[test]
    fn who_offers_without_end_is_not_heard_to_the_end() {
        let mut remote = Remote::default();
        remote.note("a");
        for index in 0..MOST_OFFERS + 10 {
            let name = Name::new("p", &format!("/t{index}")).expect("a name");
            remote.add(name, offer("a", "1"));
        }
        assert_eq!(remote.offered().len(), MOST_OFFERS);
        for index in 0..MOST_PROCESSES + 10 {
            remote.note(&format!("p{index}"));
        }
        assert_eq!(remote.processes.len(), MOST_PROCESSES);
    }
}
