//! Discovery of remote programs, topics and services.

use std::net::UdpSocket;
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::Duration;

use periplus_gz_msgs::{
    Discovery, DiscoveryKind, DiscoveryPublisher, DiscoveryScope, MessagePublisher,
};
use periplus_transport::Since;

use super::shared::{Kind, Shared, thread};
use super::{packet, subscribe};
use crate::Name;

/// Heartbeat period; a tool that has just started waits for one.
const HEARTBEAT: Duration = Duration::from_millis(1000);

/// Maximum size of a UDP packet \[bytes\].
const LARGEST: usize = 65_536;

pub(super) fn start(shared: &Arc<Shared>, kind: Kind, socket: UdpSocket) -> JoinHandle<()> {
    let shared = shared.clone();
    thread("gz-discovery", move || run(&shared, kind, &socket))
}

fn run(shared: &Arc<Shared>, kind: Kind, socket: &UdpSocket) {
    let mut packet = vec![0; LARGEST];
    let mut last = None;
    while !shared.is_closing() {
        if last.is_none_or(|since: Since| since.elapsed() >= HEARTBEAT) {
            last = Some(Since::now());
            beat(shared, kind);
            if shared.remote(kind).forget_silent() {
                tell_news(shared, kind);
            }
        }
        let Ok((length, from)) = socket.recv_from(&mut packet) else { continue };
        if !shared.ways.is_for(from) {
            continue;
        }
        if let Some(told) = packet::read(&packet[..length])
            && told.process_uuid != shared.process
        {
            hear(shared, kind, told);
        }
    }
}

fn beat(shared: &Shared, kind: Kind) {
    shared.tell(kind, DiscoveryKind::HEARTBEAT, |_| {});
    for offer in shared.offers(kind) {
        shared.tell(kind, DiscoveryKind::ADVERTISE, |told| told.r#pub = Some(offer));
    }
}

fn tell_news(shared: &Arc<Shared>, kind: Kind) {
    shared.news.notify_all();
    if kind == Kind::Topics {
        subscribe::follow(shared);
    }
}

fn hear(shared: &Arc<Shared>, kind: Kind, told: Discovery) {
    let process = &told.process_uuid;
    if told.r#type != DiscoveryKind::BYE {
        shared.remote(kind).note(process);
    }
    let is_news = match told.r#type {
        DiscoveryKind::BYE => shared.remote(kind).bye(process),
        DiscoveryKind::ADVERTISE => match sound(shared, kind, told.r#pub) {
            Some((name, offer)) => shared.remote(kind).add(name, offer),
            None => false,
        },
        DiscoveryKind::UNADVERTISE => match sound(shared, kind, told.r#pub) {
            Some((name, offer)) => {
                shared.remote(kind).remove(&name, &offer.process_uuid, &offer.node_uuid)
            }
            None => false,
        },
        DiscoveryKind::SUBSCRIBE => {
            let wanted = told.sub.map(|sub| sub.topic).unwrap_or_default();
            for offer in shared.offers(kind) {
                if offer.topic == wanted {
                    shared.tell(kind, DiscoveryKind::ADVERTISE, |told| told.r#pub = Some(offer));
                }
            }
            false
        }
        DiscoveryKind::SUBSCRIBERS_REQ if kind == Kind::Topics => {
            for (name, type_name) in shared.ears.all() {
                let ear = subscriber(shared, &name, type_name, String::new());
                shared.tell(kind, DiscoveryKind::SUBSCRIBERS_REP, |told| told.r#pub = Some(ear));
            }
            false
        }
        _ => false,
    };
    if is_news {
        tell_news(shared, kind);
    }
}

/// Sends the subscription of a local subscriber; `publisher` is the program it is for, if any.
pub(super) fn subscriber(
    shared: &Shared,
    name: &Name,
    type_name: String,
    publisher: String,
) -> DiscoveryPublisher {
    DiscoveryPublisher {
        topic: name.full().to_owned(),
        address: shared.publishing.clone(),
        process_uuid: shared.process.clone(),
        node_uuid: shared.node.clone(),
        scope: DiscoveryScope::ALL,
        msg_pub: Some(MessagePublisher {
            ctrl: publisher,
            msg_type: type_name,
            ..MessagePublisher::default()
        }),
        srv_pub: None,
    }
}

/// Checks that an advertisement is complete, for this program, and in its partition.
fn sound(
    shared: &Shared,
    kind: Kind,
    offer: Option<DiscoveryPublisher>,
) -> Option<(Name, DiscoveryPublisher)> {
    let offer = offer?;
    let name = packet::name_of(&offer)?;
    let is_kind = match kind {
        Kind::Topics => offer.msg_pub.is_some(),
        Kind::Services => offer.srv_pub.is_some(),
    };
    let own = Name::new(&shared.settings.partition, "/own").ok()?;
    let is_for_us = offer.scope != DiscoveryScope::PROCESS && name.is_beside(&own);
    (is_kind && is_for_us && offer.process_uuid != shared.process).then_some((name, offer))
}
